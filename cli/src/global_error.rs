//! `lagrangian simulate --global-error`: the error at the end of a run.
//!
//! The errors of steps accumulate, and an unstable motion amplifies them: the tolerance of a step bounds neither effect. So the
//! run is compared with a far more accurate one: in double-doubles by Taylor series if the machine has one, otherwise by the
//! same method with a hundredth of the tolerance. The effect of round-off is measured by a run from a start that is perturbed
//! by its rounding.

use std::iter;

use lagrangian::interpreted::{InterpretedMachine, Named, PreciseRun};
use lagrangian::{Error, LEAST_RELATIVE_TOLERANCE, State};
use lagrangian_mechanics::series::ProvedSeries;
use lagrangian_program::series::NoSeries;
use lagrangian_units::state_of;
use serde_json::{Map, Value, json};

use crate::numbers::shortest;
use crate::precise::{self, worst};

/// The tolerance of runs in double-doubles.
const WIDE_TOLERANCE: f64 = 1e-26;

/// The finer run has the tolerance times this.
const FINER: f64 = 1e-2;

/// Why Ctrl-C leaves no estimate.
const INTERRUPTED: &str = "--global-error: the estimate was interrupted";

/// If round-off at the start causes this fraction of the error or more, a finer tolerance gains little.
const ROUNDING: f64 = 0.3;

/// A run whose error is estimated.
pub struct EstimatedRun<'a> {
    pub machine: &'a InterpretedMachine,
    /// `None` where inputs vary.
    pub series: Option<Result<ProvedSeries, NoSeries>>,
    pub tolerance: f64,
    pub has_fixed_steps: bool,
    pub max_steps: usize,
}

/// The estimated error of the end of a run.
pub struct Estimate {
    /// For coordinates, then rates, in their units.
    errors: Vec<f64>,
    /// The effect of perturbing the start by its rounding, in the same order.
    rounding: Option<Vec<f64>>,
    how: Reference,
}

/// The reference of the comparison.
enum Reference {
    /// A run in double-doubles.
    Wide,
    /// A run at this tolerance.
    Finer(f64),
}

/// Estimates the error at the end of a run from a start. `again` repeats the run with another tolerance, or
/// from another start; `is_stopped` is polled between the steps of a run in double-doubles.
///
/// # Errors
/// Why there is no estimate.
pub fn estimate(
    asked: EstimatedRun<'_>,
    (start, end): (&State<Named>, &State<Named>),
    again: impl Fn(f64, State<Named>) -> Option<State<Named>>,
    is_stopped: &dyn Fn() -> bool,
) -> Result<Estimate, String> {
    let EstimatedRun {
        machine,
        series,
        tolerance,
        has_fixed_steps,
        max_steps,
    } = asked;
    let rounding = again(tolerance, perturbed(start)).map(|other| differences(&other, end));
    let wide = series.and_then(|series| {
        let machine = machine.clone().with_series(series);
        let run = PreciseRun {
            method: &lagrangian::TAYLOR,
            tolerance: WIDE_TOLERANCE,
            max_steps,
        };
        let poll = || match is_stopped() {
            true => Err(Error::Stepper {
                message: INTERRUPTED.into(),
            }),
            false => Ok(()),
        };
        run.polled_end(&machine, start, end.t, &poll).ok()
    });
    if is_stopped() {
        return Err(INTERRUPTED.into());
    }
    if let Some(wide) = wide {
        return Ok(Estimate {
            errors: precise::errors(&wide, end),
            rounding,
            how: Reference::Wide,
        });
    }
    if has_fixed_steps {
        return Err(
            "--global-error: the method has no tolerance, and the machine cannot be run in double-double; halve --longest-step and compare"
                .into(),
        );
    }
    let finer = (FINER * tolerance).max(LEAST_RELATIVE_TOLERANCE);
    if finer > 0.5 * tolerance {
        return Err(format!(
            "--global-error: a tolerance of {} is too fine for a comparison with a finer run, and the machine cannot be run in double-double",
            shortest(tolerance)
        ));
    }
    let exact = again(finer, start.clone());
    if is_stopped() {
        return Err(INTERRUPTED.into());
    }
    let Some(exact) = exact else {
        return Err(format!(
            "--global-error: the run at a tolerance of {} did not reach the end",
            shortest(finer)
        ));
    };
    let mut errors = differences(&exact, end);
    // The finer run is also affected by round-off.
    if let Some(rounding) = &rounding {
        for (error, rounding) in errors.iter_mut().zip(rounding) {
            *error = error.max(*rounding);
        }
    }
    Ok(Estimate {
        errors,
        rounding,
        how: Reference::Finer(finer),
    })
}

/// A start with every number perturbed by its rounding, alternately up and down; zeros stay.
fn perturbed(start: &State<Named>) -> State<Named> {
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

/// Names of coordinates, then of rates. States of first order have their own names instead of those of rates, and
/// their integrals have none.
fn names(end: &State<Named>) -> Vec<Option<String>> {
    let coordinate = |name: &str| (state_of(name).is_none()).then(|| name.to_owned());
    let rate = |name: &str| match state_of(name) {
        Some(state) => Some(state.to_owned()),
        None => Some(format!("der({name})")),
    };
    let coordinates = end.q.iter().map(|(name, _)| coordinate(name));
    coordinates
        .chain(end.v.iter().map(|(name, _)| rate(name)))
        .collect()
}

impl Estimate {
    fn how(&self) -> String {
        match self.how {
            Reference::Wide => "estimated from a run in double-double".into(),
            Reference::Finer(tolerance) => format!(
                "estimated from a run at a tolerance of {}",
                shortest(tolerance)
            ),
        }
    }

    /// The index of the number with the greatest error relative to 1 + |y|, and that error.
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

    /// The lines of the summary.
    pub fn lines(&self, end: &State<Named>) -> Vec<String> {
        let (at, greatest) = self.greatest(end);
        let head = format!("error at the end, {}", self.how());
        let names = names(end);
        let errors = names.iter().zip(&self.errors);
        let errors =
            errors.filter_map(|(name, error)| Some(format!("  {} {error:.1e}", name.as_ref()?)));
        let most = format!("  the greatest is {greatest:.1e} (1 + |y|)");
        let rounding = self.is_rounding(at).then(|| {
            "  a start perturbed by a rounding error ends as far away: the limit of round-off is reached, and a finer tolerance gains little".to_owned()
        });
        iter::once(head)
            .chain(errors)
            .chain([most])
            .chain(rounding)
            .collect()
    }

    /// The estimate as JSON.
    pub fn json(&self, end: &State<Named>) -> Value {
        let (at, greatest) = self.greatest(end);
        let names = names(end).into_iter().zip(&self.errors);
        let named = names.filter_map(|(name, error)| Some((name?, (*error).into())));
        json!({
            "kind": "estimate",
            "by": match self.how {
                Reference::Wide => "a run in double-double".to_owned(),
                Reference::Finer(tolerance) => format!("a run at a tolerance of {}", shortest(tolerance)),
            },
            "errors": Value::Object(named.collect::<Map<_, _>>()),
            "greatest": greatest,
            "is_rounding": self.is_rounding(at),
        })
    }
}
