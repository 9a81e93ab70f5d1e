//! Where the command is at work: in a process of its own, or within another program, which asks it about a spec that it holds in
//! memory.
//!
//! What that program lends it (texts instead of files, a place for what is said, a flag instead of Ctrl-C) belongs to the thread that
//! answers, and everything that leaves the command or enters it asks here first.

use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use lagrangian_spec::source::{Disk, Files};
use lagrangian_sweep::plan::{Kept, SpecText};

use crate::call::Call;

/// What a command has answered.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Answer {
    /// The exit status that it would have.
    pub status: u8,
    /// What it would write to standard output.
    pub out: String,
    /// What it would write to standard error.
    pub err: String,
}

/// What the program around lends.
struct Lent {
    spec: SpecText,
    stop: Arc<AtomicBool>,
    answer: Answer,
}

thread_local! {
    static LENT: RefCell<Option<Lent>> = const { RefCell::new(None) };
}

/// Answers a call about a spec in memory, with its constants: the name of the command, then its options. Files that the call names are
/// read and written; the standard streams are left alone, and so is Ctrl-C: `stop` ends what is under way.
///
/// # Example
///
/// ```
/// use lagrangian_cli::answer;
/// use lagrangian_sweep::plan::SpecText;
///
/// let text = "machine Ball in plane { coordinates { y: m } bodies { ball { mass: 1, at: (0, y) } } gravity (0, -9.81); }";
/// let spec = SpecText { name: "ball.machine".into(), text: text.into(), ..SpecText::default() };
/// let said = answer(&spec, "check", &["--json".into()], &Default::default());
/// assert_eq!(said.status, 0);
/// assert!(said.out.contains("degrees_of_freedom"));
/// ```
pub fn answer(
    spec: &SpecText,
    command: &str,
    options: &[String],
    stop: &Arc<AtomicBool>,
) -> Answer {
    let constants = spec.constants.iter();
    let constants = constants.map(|(name, value)| format!("--const={name}={value}"));
    let call = ["lagrangian", command, &spec.name].map(str::to_owned);
    let call = call.into_iter().chain(constants);
    let call = match Call::read(call.chain(options.iter().cloned())) {
        Ok(call) => call,
        Err(message) => {
            return Answer {
                status: message.exit_code() as u8, // 2, or 0
                err: message.to_string(),
                ..Answer::default()
            };
        }
    };
    let lent = Lent {
        spec: spec.clone(),
        stop: stop.clone(),
        answer: Answer::default(),
    };
    LENT.set(Some(lent));
    let json = call.command.json();
    let status = crate::status(&call, json);
    let answer = LENT.take().map(|lent| lent.answer).unwrap_or_default();
    Answer { status, ..answer }
}

/// Keeps what is said for the program around; whether there is one.
pub fn keeps(text: &str, is_error: bool) -> bool {
    LENT.with_borrow_mut(|lent| {
        let Some(Lent { answer, .. }) = lent else {
            return false;
        };
        if is_error {
            answer.err.push_str(text)
        } else {
            answer.out.push_str(text)
        }
        true
    })
}

/// The flag that the program around ends the work by, if there is one.
pub fn stop() -> Option<Arc<AtomicBool>> {
    LENT.with_borrow(|lent| Some(lent.as_ref()?.stop.clone()))
}

/// The files that specs are read from: those on the disk, or those that the program around holds.
#[derive(Clone, Copy, Debug, Default)]
pub struct Specs;

impl Files for Specs {
    fn read(&mut self, path: &str, from: Option<&str>) -> Result<(String, String), String> {
        LENT.with_borrow(|lent| {
            let Some(Lent { spec, .. }) = lent else {
                return Disk.read(path, from);
            };
            // A variant that stands beside the spec calls it by the last part of its name.
            let own = Path::new(&spec.name);
            let beside = |from: &str| Path::new(from).parent() == own.parent();
            let is_own = match from {
                None => path == spec.name,
                Some(from) => beside(from) && own.file_name().is_some_and(|name| name == path),
            };
            if is_own {
                Ok((spec.name.clone(), spec.text.clone()))
            } else {
                Kept(&spec.files).read(path, from)
            }
        })
    }
}
