//! Where the command runs: in a process of its own, or inside another program that holds a spec in memory.
//!
//! What that program provides (texts instead of files, buffers for output, a flag instead of Ctrl-C) is thread-local, and all input
//! and output of the command consults this module first.

use std::cell::RefCell;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use lagrangian_spec::source::{Disk, Files};
use lagrangian_sweep::plan::{RecordedFiles, SpecText};

use crate::call::Call;

/// The result of a command.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Answer {
    /// The exit status that it would have as a process.
    pub status: u8,
    /// What it would write to standard output.
    pub out: String,
    /// What it would write to standard error.
    pub err: String,
}

/// What the surrounding program provides.
struct HostContext {
    spec: SpecText,
    stop: Arc<AtomicBool>,
    answer: Answer,
}

thread_local! {
    static HOST_CONTEXT: RefCell<Option<HostContext>> = const { RefCell::new(None) };
}

/// Runs a command on a spec in memory with its constants, given the name of the command and its options. Files that the call names
/// are read and written. The standard streams and Ctrl-C are not used: `stop` interrupts the command.
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
    let context = HostContext {
        spec: spec.clone(),
        stop: stop.clone(),
        answer: Answer::default(),
    };
    HOST_CONTEXT.set(Some(context));
    let json = call.command.arguments().json();
    let status = crate::status(&call, json);
    let answer = HOST_CONTEXT
        .take()
        .map(|context| context.answer)
        .unwrap_or_default();
    Answer { status, ..answer }
}

/// Captures output for the surrounding program; returns whether there is one.
pub fn captures(text: &str, is_error: bool) -> bool {
    HOST_CONTEXT.with_borrow_mut(|context| {
        let Some(HostContext { answer, .. }) = context else {
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

/// The flag with which the surrounding program interrupts the command, if there is one.
pub fn stop() -> Option<Arc<AtomicBool>> {
    HOST_CONTEXT.with_borrow(|context| Some(context.as_ref()?.stop.clone()))
}

/// The files from which specs are read: on disk, or held by the surrounding program.
#[derive(Clone, Copy, Debug, Default)]
pub struct Specs;

impl Files for Specs {
    fn read(&mut self, path: &str, from: Option<&str>) -> Result<(String, String), String> {
        HOST_CONTEXT.with_borrow(|context| {
            let Some(HostContext { spec, .. }) = context else {
                return Disk.read(path, from);
            };
            // A variant in the same folder refers to the spec by its file name.
            let spec_path = Path::new(&spec.name);
            let beside = |from: &str| Path::new(from).parent() == spec_path.parent();
            let is_own = match from {
                None => path == spec.name,
                Some(from) => {
                    beside(from) && spec_path.file_name().is_some_and(|name| name == path)
                }
            };
            if is_own {
                Ok((spec.name.clone(), spec.text.clone()))
            } else {
                RecordedFiles(&spec.files).read(path, from)
            }
        })
    }
}
