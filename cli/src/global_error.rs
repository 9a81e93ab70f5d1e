//! `lagrangian simulate --global-error`: how exact the end of a run is.
//!
//! The errors of steps add up, and a motion that amplifies makes more of them: the tolerance of a step bounds neither. So the run is held
//! against one that is far more exact: in double-doubles by Taylor series, where the machine has one; else by the same method at a
//! hundredth of the tolerance. What rounding has part in it is seen by a run from a start that is moved by a rounding.

use std::iter;

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{LEAST_RELATIVE_TOLERANCE, State};
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_program::series::NoSeries;
use lagrangian_units::state_of;
use serde_json::{Map, Value, json};

use crate::numbers::shortest;
use crate::precise::{self, worst};

/// The tolerance of runs in double-doubles.
const WIDE_TOLERANCE: f64 = 1e-26;

/// The finer run has a tolerance of this part.
const FINER: f64 = 1e-2;

/// Where what a rounding at the start makes of the end is this part of the error, a finer tolerance gains little.
const ROUNDING: f64 = 0.3;

/// What is known of a run.
pub struct Asked<'a> {
    pub machine: &'a InterpretedMachine,
    /// None where inputs change.
    pub series: Option<Result<ProvedSeries, NoSeries>>,
    pub tolerance: f64,
    pub has_fixed_steps: bool,
    pub max_steps: usize,
}

/// The error of the end of a run, as it is estimated.
pub struct Estimate {
    /// Of coordinates, then of rates, in their units.
    errors: Vec<f64>,
    /// What a start that is moved by a rounding makes of the end, in the same order.
    rounding: Option<Vec<f64>>,
    how: How,
}

/// What a run was held against.
enum How {
    /// A run in double-doubles.
    Wide,
    /// A run at this tolerance.
    Finer(f64),
}

/// Estimates the error of a run from a start to its end. `again` makes it at another tolerance, or from another start.
///
/// # Errors
/// Why there is no estimate.
pub fn estimate(
    asked: Asked<'_>,
    (start, end): (&State<Named>, &State<Named>),
    again: impl Fn(f64, State<Named>) -> Option<State<Named>>,
) -> Result<Estimate, String> {
    let Asked {
        machine,
        series,
        tolerance,
        has_fixed_steps,
        max_steps,
    } = asked;
    let rounding = again(tolerance, moved(start)).map(|other| differences(&other, end));
    let wide = series.and_then(|series| {
        let machine = machine.clone().with_series(series);
        let to = (start, end.t);
        let by = &lagrangian::TAYLOR;
        precise::run_to(&machine, to, by, (WIDE_TOLERANCE, max_steps)).ok()
    });
    if let Some(wide) = wide {
        return Ok(Estimate {
            errors: wide.errors(end),
            rounding,
            how: How::Wide,
        });
    }
    if has_fixed_steps {
        return Err(
            "--global-error: the method has no tolerance, and the machine no run in double-double; halve --longest-step and compare"
                .into(),
        );
    }
    let finer = (FINER * tolerance).max(LEAST_RELATIVE_TOLERANCE);
    if finer > 0.5 * tolerance {
        return Err(format!(
            "--global-error: no run is finer than one at {}, and the machine has none in double-double",
            shortest(tolerance)
        ));
    }
    let Some(exact) = again(finer, start.clone()) else {
        return Err(format!(
            "--global-error: the run at a tolerance of {} did not come to the end",
            shortest(finer)
        ));
    };
    let mut errors = differences(&exact, end);
    // The finer run has the rounding in it as well.
    if let Some(rounding) = &rounding {
        for (error, rounding) in errors.iter_mut().zip(rounding) {
            *error = error.max(*rounding);
        }
    }
    Ok(Estimate {
        errors,
        rounding,
        how: How::Finer(finer),
    })
}

/// A start of which every number is moved by a rounding, up and down in turn; what is 0 stays.
fn moved(start: &State<Named>) -> State<Named> {
    let mut moved = start.clone();
    let numbers = moved.q.values.iter_mut().chain(&mut moved.v.values);
    for (i, x) in numbers.enumerate().filter(|(_, x)| **x != 0.0) {
        *x = match i % 2 {
            0 => x.next_up(),
            _ => x.next_down(),
        };
    }
    moved
}

/// Coordinates, then rates.
fn numbers(state: &State<Named>) -> impl Iterator<Item = f64> {
    state.q.values.iter().chain(&state.v.values).copied()
}

fn differences(one: &State<Named>, other: &State<Named>) -> Vec<f64> {
    let pairs = numbers(one).zip(numbers(other));
    pairs.map(|(a, b)| (a - b).abs()).collect()
}

/// Names of coordinates, then of rates; of states of first order their own in place of their rates, and none for their integrals.
fn names(end: &State<Named>) -> Vec<Option<String>> {
    let own = |name: &str| (state_of(name).is_none()).then(|| name.to_owned());
    let rate = |name: &str| match state_of(name) {
        Some(state) => Some(state.to_owned()),
        None => Some(format!("der({name})")),
    };
    let coordinates = end.q.iter().map(|(name, _)| own(name));
    coordinates
        .chain(end.v.iter().map(|(name, _)| rate(name)))
        .collect()
}

impl Estimate {
    fn how(&self) -> String {
        match self.how {
            How::Wide => "an estimate, by a run in double-double".into(),
            How::Finer(tolerance) => format!(
                "an estimate, by a run at a tolerance of {}",
                shortest(tolerance)
            ),
        }
    }

    /// The greatest error, relative to 1 + |y|, and the place of its number.
    fn greatest(&self, end: &State<Named>) -> (usize, f64) {
        let pairs = self.errors.iter().zip(numbers(end));
        let relative: Vec<f64> = pairs.map(|(error, y)| error / (1.0 + y.abs())).collect();
        worst(&relative)
    }

    /// Whether a finer tolerance would gain little.
    fn is_rounding(&self, at: usize) -> bool {
        let rounding = self.rounding.as_ref();
        rounding.is_some_and(|rounding| rounding[at] >= ROUNDING * self.errors[at])
    }

    /// For the summary.
    pub fn lines(&self, end: &State<Named>) -> Vec<String> {
        let (at, greatest) = self.greatest(end);
        let head = format!("error at the end, {}", self.how());
        let names = names(end);
        let told = names.iter().zip(&self.errors);
        let told =
            told.filter_map(|(name, error)| Some(format!("  {} {error:.1e}", name.as_ref()?)));
        let most = format!("  the greatest is {greatest:.1e} (1 + |y|)");
        let rounding = self.is_rounding(at).then(|| {
            "  a start moved by a rounding ends as far away: the limit of rounding is reached, and a finer tolerance gains little".to_owned()
        });
        iter::once(head)
            .chain(told)
            .chain([most])
            .chain(rounding)
            .collect()
    }

    /// For programs.
    pub fn json(&self, end: &State<Named>) -> Value {
        let (at, greatest) = self.greatest(end);
        let names = names(end).into_iter().zip(&self.errors);
        let named = names.filter_map(|(name, error)| Some((name?, (*error).into())));
        json!({
            "kind": "estimate",
            "by": match self.how {
                How::Wide => "a run in double-double".to_owned(),
                How::Finer(tolerance) => format!("a run at a tolerance of {}", shortest(tolerance)),
            },
            "errors": Value::Object(named.collect::<Map<_, _>>()),
            "greatest": greatest,
            "is_rounding": self.is_rounding(at),
        })
    }
}
