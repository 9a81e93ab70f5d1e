//! Reductions of a motion to numbers while it runs: extremes, integrals, end values.

use std::cell::RefCell;

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named};
use lagrangian::{Error, StepMotion, System, extremes};

use crate::plan::Function;

/// Nodes and weights of the Gauss formula with five nodes on [−1, 1], exact up to degree 9; the motion within a step has degree 7.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// A Taylor step has a much higher degree, so its integral is computed in this many parts.
const PARTS_OF_SERIES: u32 = 4;

/// A formula of the plan.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Formula {
    /// The index of the output that computes it.
    pub output: usize,
    /// Whether it depends on accelerations.
    pub reads_accelerations: bool,
}

/// The state of a reduction during a run.
#[derive(Clone, Debug)]
pub(crate) struct Tracker {
    function: Function,
    formula: Formula,
    /// Whether the absolute value of the formula is reduced.
    of_size: bool,
    /// The least and the greatest value so far, with their times.
    extent: [Option<(f64, f64)>; 2],
    integral: f64,
    /// The time from which the integral is taken.
    since: Option<f64>,
    until: f64,
    first: Option<f64>,
    last: Option<f64>,
}

impl Tracker {
    pub fn new(function: Function, formula: Formula, of_size: bool) -> Tracker {
        Tracker {
            function,
            formula,
            of_size,
            extent: [None; 2],
            integral: 0.0,
            since: None,
            until: 0.0,
            first: None,
            last: None,
        }
    }

    /// Updates the reduction with the last step, starting at a fraction of it.
    pub fn take(&mut self, step: &Looks<'_, '_>, from: f64) -> Result<(), Error> {
        let [start, end] = step.span;
        let value = |theta: f64| step.value(theta, self.formula);
        match self.function {
            Function::Max
            | Function::Min
            | Function::Range
            | Function::WhenMax
            | Function::WhenMin => {
                let wanted = match self.function {
                    _ if self.of_size => [true; 2],
                    Function::Max | Function::WhenMax => [false, true],
                    Function::Min | Function::WhenMin => [true, false],
                    _ => [true; 2],
                };
                let mut extent = self.extent;
                // Values from earlier steps have no position in this step.
                for (_, place) in extent.iter_mut().flatten() {
                    *place = f64::NAN;
                }
                extremes(value, [from, 1.0], &mut extent, wanted)?;
                for (known, found) in self.extent.iter_mut().zip(extent) {
                    if let Some((value, theta)) = found
                        && !theta.is_nan()
                    {
                        *known = Some((value, start + theta * (end - start)));
                    }
                }
            }
            Function::Mean | Function::Rms | Function::Integral => {
                let from_t = start + from * (end - start);
                let is_square = self.function == Function::Rms;
                self.since.get_or_insert(from_t);
                self.until = end;
                let parts = if step.is_series { PARTS_OF_SERIES } else { 1 };
                let half = 0.5 * (1.0 - from) / f64::from(parts);
                let mut sum = 0.0;
                for part in 0..parts {
                    for (node, weight) in GAUSS {
                        let theta = from + half * (f64::from(2 * part) + 1.0 + node);
                        let value = value(theta)?;
                        sum += weight * if is_square { value * value } else { value };
                    }
                }
                self.integral += (end - start) * half * sum;
            }
            Function::First => {
                if self.first.is_none() {
                    self.first = Some(value(from)?);
                }
            }
            Function::Last => self.last = Some(value(1.0)?),
            Function::Count
            | Function::FirstEvent
            | Function::LastEvent
            | Function::Frequency
            | Function::Power => {}
        }
        Ok(())
    }

    /// The result; `None` if no step was taken.
    pub fn result(&self) -> Option<f64> {
        let [least, greatest] = self.extent;
        let mean = || {
            let since = self.since?;
            Some(self.integral / (self.until - since))
        };
        match self.function {
            Function::Max if self.of_size => {
                let (least, greatest) = (least?.0, greatest?.0);
                // `f64::max` would ignore NaN.
                Some(if least.abs() > greatest.abs() || least.is_nan() {
                    least.abs()
                } else {
                    greatest.abs()
                })
            }
            Function::WhenMax if self.of_size => {
                let (least, greatest) = (least?, greatest?);
                Some(if least.0.abs() > greatest.0.abs() {
                    least.1
                } else {
                    greatest.1
                })
            }
            Function::Max => greatest.map(|(value, _)| value),
            Function::Min => least.map(|(value, _)| value),
            Function::Range => Some(greatest?.0 - least?.0),
            Function::WhenMax => greatest.map(|(_, t)| t),
            Function::WhenMin => least.map(|(_, t)| t),
            Function::Mean => mean(),
            Function::Rms => mean().map(f64::sqrt),
            Function::Integral => self.since.map(|_| self.integral),
            Function::First => self.first,
            Function::Last => self.last,
            Function::Count
            | Function::FirstEvent
            | Function::LastEvent
            | Function::Frequency
            | Function::Power => None,
        }
    }
}

/// Time, state and inputs at a fraction of a step, and accelerations if they were needed.
#[derive(Debug)]
struct Look {
    theta: f64,
    t: f64,
    q: Vec<f64>,
    v: Vec<f64>,
    u: Named,
    a: Vec<f64>,
    has_accelerations: bool,
}

/// The states evaluated within a step; kept from one step to the next to avoid allocation.
#[derive(Debug, Default)]
pub(crate) struct Seen {
    /// The first `of_step` entries belong to the current step.
    looks: Vec<Look>,
    of_step: usize,
}

/// A step that several formulas evaluate at the same points, so that each state is computed once.
pub(crate) struct Looks<'s, 'm> {
    pub span: [f64; 2],
    pub is_series: bool,
    system: &'s InterpretedSystem,
    motion: RefCell<&'s mut (dyn StepMotion<InterpretedMachine> + 'm)>,
    seen: RefCell<&'s mut Seen>,
}

impl<'s, 'm> Looks<'s, 'm> {
    pub fn new(
        system: &'s InterpretedSystem,
        motion: &'s mut (dyn StepMotion<InterpretedMachine> + 'm),
        seen: &'s mut Seen,
    ) -> Self {
        seen.of_step = 0;
        Looks {
            span: motion.span(),
            is_series: motion.is_series(),
            system,
            motion: RefCell::new(motion),
            seen: RefCell::new(seen),
        }
    }

    /// The value of a formula at a fraction of the step.
    pub fn value(&self, theta: f64, formula: Formula) -> Result<f64, Error> {
        let mut motion = self.motion.borrow_mut();
        let mut seen = self.seen.borrow_mut();
        let Seen { looks, of_step } = &mut **seen;
        let known = looks[..*of_step]
            .iter()
            .position(|look| look.theta == theta);
        let place = match known {
            Some(place) => place,
            None => {
                if looks.len() == *of_step {
                    let zeros = || vec![0.0; self.system.coordinates().len()];
                    looks.push(Look {
                        theta,
                        t: 0.0,
                        q: zeros(),
                        v: zeros(),
                        u: self.system.default_inputs(),
                        a: zeros(),
                        has_accelerations: false,
                    });
                }
                let look = &mut looks[*of_step];
                look.theta = theta;
                look.t = motion.state_at(theta, &mut look.q, &mut look.v)?;
                look.u = motion.inputs(look.t, &look.q, &look.v);
                look.has_accelerations = false;
                *of_step += 1;
                *of_step - 1
            }
        };
        let look = &mut looks[place];
        if formula.reads_accelerations && !look.has_accelerations {
            motion.accelerations((look.t, &look.q, &look.v), &look.u, &mut look.a)?;
            look.has_accelerations = true;
        }
        let Look { t, q, v, u, a, .. } = look;
        // Outputs that do not depend on accelerations get none.
        let a = if look.has_accelerations { &a[..] } else { &[] };
        Ok(self.system.output(formula.output, *t, q, v, a, &u.values))
    }
}
