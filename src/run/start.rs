//! The start of a run: its settings are checked, and its state is projected onto the constraints.

use std::string::String;
use std::vec::Vec;

use super::reasons::{contradiction, dependences};
use crate::constraints::{Constraints, Violation, closest};
use crate::error::{KeptContradiction, constraint_name};
use crate::names::rate_name;
use crate::settings::{Settings, Subject};
use crate::stages::Point;
use crate::step_error::StepError;
use crate::tolerance::Tolerance;
use crate::{Error, Machine, Pivot, System, Vector, Warning};

/// Moves of the start below this, relative to the size of a number, are not reported: they are about as large as the round-off in a formula
/// for a start value.
const ROUNDING_OF_START: f64 = 1e-12;

/// Warnings about the start of a run, and the constraints there, if they are known.
type ProjectedStart<V> = (Vec<Warning>, Option<Constraints<V>>);

/// Projects the start of a run onto the constraints. Returns warnings, how far each number was moved and which constraints are redundant; and what a
/// stepper that begins there would find of the constraints, unless the start was moved.
pub(super) fn project_start<S: System>(
    system: &S,
    t: f64,
    q: &mut S::Vector,
    v: &mut S::Vector,
    kept: Option<[S::Vector; 2]>,
) -> Result<ProjectedStart<S::Vector>, Error> {
    let keeps = kept.is_some();
    let requested = [q.clone(), v.clone()];
    let mut known = Constraints::new(system, q, v);
    let mut start = Point::new(t, q.clone(), v.clone());
    let mut projected = known.begin(system, &mut start.place(), kept.clone());
    if let (Err(_), Some(kept)) = (&projected, kept) {
        start = Point::new(t, q.clone(), v.clone());
        let violations = closest(system, &mut start.place(), &kept);
        if let Some(error) = contradicts_kept(system, &start, &kept, &violations) {
            return Err(error);
        }
        // The projection converges from here, since this start is near the constraints.
        known = Constraints::new(system, q, v);
        projected = known.begin(system, &mut start.place(), Some(kept));
    }
    projected.map_err(|error| match error {
        // At rest in a state in which rows are dependent that are independent next to it.
        StepError::Singular { singular, t } => match singular.at {
            Pivot::Constraint(row) => Error::Fork {
                constraint: constraint_name(system, row),
                left: 0.0,
                t,
            },
            _ => contradiction(error, system, q, v),
        },
        _ => contradiction(error, system, q, v),
    })?;
    (*q, *v) = (start.q, start.v);
    let is_moved = keeps || *q != requested[0] || *v != requested[1];

    let mut found = Vec::new();
    for (constraint, with) in dependences(&known, system, t, q) {
        found.push(Warning::RedundantConstraint { constraint, with });
    }
    for (level, now) in [&*q, &*v].into_iter().enumerate() {
        for (j, coordinate) in system.coordinates().enumerate() {
            let (from, to) = (requested[level].as_slice()[j], now.as_slice()[j]);
            if (to - from).abs() <= ROUNDING_OF_START * known.sizes(j)[level] {
                continue;
            }
            let name = coordinate_or_rate_name(coordinate.name, level);
            found.push(Warning::StartMoved { name, from, to });
        }
    }
    Ok((found, (!is_moved).then_some(known)))
}

/// The error of a start whose kept numbers contradict the constraints; `best` is the state that violates them least. `None` if no kept
/// number takes part in a constraint that is violated.
fn contradicts_kept<S: System>(
    system: &S,
    best: &Point<S::Vector>,
    kept: &[S::Vector; 2],
    violations: &[Violation],
) -> Option<Error> {
    let n = best.q.as_slice().len();
    let m = system.constraints().len();
    let mut rows = std::vec![0.0; m * n];
    system.constraint_matrix(best.t, &best.q, &mut rows);
    let contradiction = |&(row, level, residual): &Violation| {
        let is_kept = |j: usize| kept[level].as_slice()[j] != 0.0 && rows[row * n + j] != 0.0;
        let coordinates = system.coordinates().enumerate();
        let kept = coordinates.filter(|(j, _)| is_kept(*j));
        let constraint = system.constraints().nth(row)?;
        let of_rates = level == 1 && constraint.holonomic;
        Some(KeptContradiction {
            constraint: constraint.name.into(),
            of_rates,
            kept: kept
                .map(|(_, of)| coordinate_or_rate_name(of.name, level))
                .collect(),
            residual,
            unit: if of_rates {
                std::format!("{}/s", constraint.unit)
            } else {
                constraint.unit.into()
            },
        })
    };
    let contradictions: Vec<_> = violations.iter().filter_map(contradiction).collect();
    let is_kept = contradictions.iter().any(|of| !of.kept.is_empty());
    is_kept.then_some(Error::KeptStart {
        contradictions,
        t: best.t,
    })
}

/// The name of a coordinate or of its rate.
fn coordinate_or_rate_name(coordinate: &str, level: usize) -> String {
    match level {
        0 => coordinate.into(),
        _ => rate_name(coordinate),
    }
}

impl Settings {
    /// Checks all settings and returns the end of the run.
    pub(super) fn check(&self) -> Result<f64, Error> {
        let until = self.until.ok_or(Error::NoEnd)?;
        let check = |setting, value: f64, is_good: bool, needed| {
            if is_good {
                Ok(())
            } else {
                Err(Error::InvalidSetting {
                    setting,
                    value,
                    needed,
                })
            }
        };
        let positive = |value: f64| value > 0.0 && value.is_finite();
        check("until", until, until.is_finite(), "a finite time")?;
        let is_good = self.relative >= 0.0 && self.relative < 1.0;
        if self.one_tolerance {
            let is_good = is_good && positive(self.absolute);
            let needed = "greater than 0 and less than 1";
            check("tolerance", self.absolute, is_good, needed)?;
        }
        check(
            "relative",
            self.relative,
            is_good,
            "at least 0 and less than 1",
        )?;
        check(
            "absolute",
            self.absolute,
            positive(self.absolute),
            "greater than 0",
        )?;
        for (_, value) in &self.absolute_of {
            check("absolute_of", *value, positive(*value), "greater than 0")?;
        }
        if let Some(step) = self.first_step {
            check("first_step", step, positive(step), "greater than 0")?;
        }
        check(
            "longest_step",
            self.longest_step,
            self.longest_step > 0.0,
            "greater than 0",
        )?;
        if let Some(interval) = self.every {
            check("every", interval, positive(interval), "greater than 0")?;
        }
        for interval in &self.observed_every {
            check("observe", *interval, positive(*interval), "greater than 0")?;
        }
        Ok(until)
    }

    /// Whether the call names numbers of the start to be kept.
    pub(super) fn keeps_by_name(&self) -> bool {
        self.kept.as_ref().is_some_and(|names| !names.is_empty())
    }

    /// Which numbers of the start are kept, coordinates and rates: those that are not 0 in the result.
    pub(super) fn kept_start_values<S: System>(
        &self,
        system: &S,
        is_resumed: bool,
    ) -> Result<Option<[S::Vector; 2]>, Error> {
        let names = match &self.kept {
            Some(names) => names.clone(),
            // The description's choice refers to its own start.
            None if is_resumed => Vec::new(),
            None => system.kept_at_start().map(String::from).collect(),
        };
        if names.is_empty() {
            return Ok(None);
        }
        let zeros = || S::Vector::zeros(system.coordinates().len());
        let mut kept = [zeros(), zeros()];
        for name in &names {
            let rate = name
                .strip_prefix("der(")
                .and_then(|rest| rest.strip_suffix(')'));
            let (level, asked) = rate.map_or((0, name.as_str()), |rate| (1, rate));
            let mut is_known = false;
            let is_meant = |own: &str| {
                let member = own.strip_prefix(asked);
                member.is_some_and(|member| member.is_empty() || member.starts_with('['))
            };
            for (j, coordinate) in system.coordinates().enumerate() {
                // A state of first order is the rate of its integral.
                let is_state = rate.is_none() && is_meant(&rate_name(coordinate.name));
                if is_state || is_meant(coordinate.name) {
                    let level = if is_state { 1 } else { level };
                    kept[level].as_mut_slice()[j] = 1.0;
                    is_known = true;
                }
            }
            if !is_known {
                return Err(Error::UnknownCoordinate { name: name.clone() });
            }
        }
        Ok(Some(kept))
    }

    pub(super) fn tolerance<S: System>(&self, system: &S) -> Result<Tolerance<S::Vector>, Error> {
        let mut absolute = S::Vector::zeros(system.coordinates().len());
        absolute.as_mut_slice().fill(self.absolute);
        for (name, tolerance) in &self.absolute_of {
            let index = system
                .coordinates()
                .position(|coordinate| coordinate.name == name)
                .ok_or_else(|| Error::UnknownCoordinate { name: name.clone() })?;
            absolute.as_mut_slice()[index] = *tolerance;
        }
        Ok(Tolerance {
            relative: self.relative,
            absolute,
        })
    }
}

/// The equations of motion of what is to be run, for parameters that are finite.
pub(super) fn prepared<M: Machine>(subject: Subject<'_, M>) -> Result<M::System, Error> {
    match subject {
        Subject::Machine(machine) => {
            check_parameters(machine)?;
            Ok(machine.prepare())
        }
        // These equations were checked when the run began that this one resumes.
        Subject::System(system) => Ok(system),
    }
}

fn check_parameters<M: Machine>(machine: &M) -> Result<(), Error> {
    let mut parameters = machine.parameters();
    match parameters.find(|(_, value)| !value.is_finite()) {
        Some((parameter, value)) => Err(Error::ParameterNotFinite {
            parameter: parameter.name.into(),
            value,
        }),
        None => Ok(()),
    }
}

pub(super) fn check_start<S: System>(
    system: &S,
    t: f64,
    q: &S::Vector,
    v: &S::Vector,
) -> Result<(), Error> {
    if !t.is_finite() {
        return Err(Error::StartNotFinite {
            name: "t".into(),
            value: t,
        });
    }
    let (q, v) = (q.as_slice().iter(), v.as_slice().iter());
    for (coordinate, (&q, &v)) in system.coordinates().zip(q.zip(v)) {
        let name = coordinate.name;
        if !q.is_finite() {
            return Err(Error::StartNotFinite {
                name: name.into(),
                value: q,
            });
        }
        if !v.is_finite() {
            return Err(Error::StartNotFinite {
                name: rate_name(name),
                value: v,
            });
        }
    }
    Ok(())
}
