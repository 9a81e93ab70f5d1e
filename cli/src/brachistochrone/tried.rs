//! The trials of a search, as text and as JSON.

use lagrangian_brachistochrone::Unsolved;
use lagrangian_brachistochrone::direct::{Outcome, Start, Trial};
use serde_json::{Map, Value, json};

use super::problem::reason;
use crate::failure::Failure;

/// The failure that there is no fastest motion, with all trials.
pub fn failure(unsolved: &Unsolved, names: &[String]) -> Failure {
    let Unsolved::NotFound { tried } = unsolved else {
        return Failure::Run(reason(unsolved, names));
    };
    let lines = tried.iter().enumerate();
    let lines = lines.map(|(number, trial)| format!("\n  {}. {}", number + 1, line(trial, names)));
    let message = format!(
        "no fastest motion was found from {} starts; the end may be out of reach, or a `--guess` may help:{}",
        tried.len(),
        lines.collect::<String>()
    );
    let fields = [("tried".to_owned(), document(tried, names))];
    Failure::Detailed(message, fields.into_iter().collect())
}

/// A start and its outcome, with the names of coordinates.
pub fn line(trial: &Trial, names: &[String]) -> String {
    match &trial.start {
        Start::Bowed { by } => {
            let parts = names.iter().zip(by).filter(|(_, by)| **by != 0.0);
            let parts: Vec<String> = parts
                .map(|(name, by)| format!("{name} by {by:.3}"))
                .collect();
            format!(
                "a path displaced in {}: {}",
                parts.join(", "),
                trial.outcome
            )
        }
        _ => trial.to_string(),
    }
}

/// All trials as JSON.
pub fn document(tried: &[Trial], names: &[String]) -> Value {
    tried.iter().map(|trial| entry(trial, names)).collect()
}

fn entry(trial: &Trial, names: &[String]) -> Value {
    let mut aside = Value::Null;
    let start = match &trial.start {
        Start::Guess => "guess",
        Start::Straight => "straight",
        Start::Bowed { by } => {
            let pairs = names.iter().zip(by);
            let pairs = pairs.map(|(name, by)| (name.clone(), json!(by + 0.0)));
            aside = pairs.collect::<Map<_, _>>().into();
            "aside"
        }
        Start::Frictionless { .. } => "without friction",
        _ => "constant coefficients",
    };
    let (outcome, time) = match trial.outcome {
        Outcome::Found { time } => ("found", Some(time)),
        Outcome::Same { .. } => ("same", None),
        Outcome::NotLeast { time, .. } => ("not least", Some(time)),
        Outcome::NotSmooth { time } => ("not smooth", Some(time)),
        Outcome::Lacks { .. } => ("lacks energy", None),
        Outcome::Lost { .. } => ("lost", None),
        Outcome::Nothing => ("nothing to follow", None),
        _ => ("unfinished", None),
    };
    let same = match trial.outcome {
        Outcome::Same { trial } => Some(trial),
        _ => None,
    };
    json!({
        "start": start,
        "aside": aside,
        "outcome": outcome,
        "time": time,
        "same": same,
        "words": line(trial, names),
    })
}
