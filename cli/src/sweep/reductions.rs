//! The results of each motion that a sweep keeps: `--record`, `--reduce`.

use lagrangian::ContactEventKind;
use lagrangian_sweep::plan::{Function, Reduction, Watch};

use crate::call::{self, Assignment};
use crate::failure::Failure;

/// A parsed `--record`.
#[derive(Default)]
pub struct Recorded {
    /// Instants, in s.
    pub at: Vec<f64>,
    /// The sampling interval, in s.
    pub every: Option<f64>,
    /// Events at which samples are recorded.
    pub events: Vec<String>,
}

/// Reads `--record`.
///
/// # Errors
/// If the call is invalid.
pub fn recorded(given: &[String]) -> Result<Recorded, Failure> {
    let Recorded {
        mut at,
        mut every,
        mut events,
    } = Recorded::default();
    for text in given {
        let wrong = |why: String| Failure::Call(format!("--record {text}: {why}"));
        match text
            .split_once('=')
            .map(|(what, value)| (what.trim(), value))
        {
            None if text.trim() == "end" => {} // the end is always recorded
            Some(("at", times)) => {
                for time in times.split(',') {
                    let time = call::number(time).map_err(wrong)?;
                    if at.contains(&time) {
                        return Err(wrong(format!("{time} s is given more than once")));
                    }
                    at.push(time);
                }
            }
            Some(("every", interval)) => {
                let interval = call::number(interval).map_err(wrong)?;
                if interval <= 0.0 {
                    return Err(wrong("an interval must be greater than 0".into()));
                }
                if every.replace(interval).is_some() {
                    return Err(wrong("an interval is given more than once".into()));
                }
            }
            Some(("event", names)) => {
                for name in names.split(',').map(str::trim) {
                    if events.iter().any(|known| known == name) {
                        return Err(wrong(format!("`{name}` is given more than once")));
                    }
                    events.push(name.to_owned());
                }
            }
            _ => {
                return Err(wrong(
                    "expected end, at=T,…, every=T or event=NAME,…".into(),
                ));
            }
        }
    }
    Ok(Recorded { at, every, events })
}

/// The reductions of a call.
///
/// # Errors
/// If the call is invalid.
pub fn reductions(given: &[Assignment], events: &[Watch]) -> Result<Vec<Reduction>, Failure> {
    given.iter().map(|one| reduction(one, events)).collect()
}

fn reduction(given: &Assignment, events: &[Watch]) -> Result<Reduction, Failure> {
    let Assignment { name, value } = given;
    let functions = || Function::NAMES.iter().map(|(name, _)| *name);
    let wrong = |why: String| Failure::Call(format!("--reduce '{name} = {value}': {why}"));
    let wanted = || {
        let functions: Vec<_> = functions().collect();
        wrong(format!(
            "expected FUNCTION(FORMULA), where a function is {}",
            functions.join(", ")
        ))
    };
    let (function, rest) = value.split_once('(').ok_or_else(wanted)?;
    let of = rest.trim_end().strip_suffix(')').ok_or_else(wanted)?.trim();
    let function = function.trim();
    let known = Function::NAMES.iter().find(|(name, _)| *name == function);
    let Some((_, known)) = known else {
        return Err(
            match lagrangian_spec::diagnostic::most_similar(function, functions()) {
                Some(near) => wrong(format!(
                    "no function named `{function}`; did you mean `{near}`?"
                )),
                None => wanted(),
            },
        );
    };
    if of.is_empty() {
        return Err(wanted());
    }
    // An event of a contact has a name of two words, unlike any formula.
    let is_of_contact = of.rsplit_once(' ').is_some_and(|(_, word)| {
        let mut kinds = ContactEventKind::ALL.into_iter();
        kinds.any(|kind| kind.word() == word)
    });
    let is_event = is_of_contact || events.iter().any(|event| event.name == of);
    let function = match known {
        Function::First if is_event => Function::FirstEvent,
        Function::Last if is_event => Function::LastEvent,
        other => *other,
    };
    Ok(Reduction {
        name: name.clone(),
        function,
        of: of.to_owned(),
    })
}
