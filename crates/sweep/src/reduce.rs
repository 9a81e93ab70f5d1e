//! Reductions of a motion to numbers while it runs: extremes, integrals, end values.

use std::cell::RefCell;
use std::f64::consts::FRAC_1_SQRT_2;

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named};
use lagrangian::{Error, StepMotion, System, extremes};

use crate::plan::Function;

/// Nodes of the formula of Clenshaw and Curtis of degree 16 on [−1, 1], each with its weight there and in the formula of degree 8, 0 if that has
/// no such node. Both ends are nodes, so that a kink or a jump next to an end is not overlooked.
const NODES: [(f64, f64, f64); 17] = [
    (-1.0, 0.003_921_568_627_450_98, 0.015_873_015_873_015_872),
    (-0.980_785_280_403_230_4, 0.037_368_702_837_205_61, 0.0),
    (
        -0.923_879_532_511_286_7,
        0.075_482_331_543_151_83,
        0.146_218_649_216_018_15,
    ),
    (-0.831_469_612_302_545_2, 0.108_905_552_581_890_93, 0.0),
    (
        -FRAC_1_SQRT_2,
        0.138_956_468_368_233_08,
        0.279_365_079_365_079_37,
    ),
    (-0.555_570_233_019_602_2, 0.163_172_664_281_703_3, 0.0),
    (
        -0.382_683_432_365_089_8,
        0.181_473_784_236_493_35,
        0.361_717_858_720_489_8,
    ),
    (-0.195_090_322_016_128_28, 0.192_513_864_612_925_63, 0.0),
    (0.0, 0.196_410_125_821_890_52, 0.393_650_793_650_793_64),
    (0.195_090_322_016_128_28, 0.192_513_864_612_925_63, 0.0),
    (
        0.382_683_432_365_089_8,
        0.181_473_784_236_493_35,
        0.361_717_858_720_489_8,
    ),
    (0.555_570_233_019_602_2, 0.163_172_664_281_703_3, 0.0),
    (
        FRAC_1_SQRT_2,
        0.138_956_468_368_233_08,
        0.279_365_079_365_079_37,
    ),
    (0.831_469_612_302_545_2, 0.108_905_552_581_890_93, 0.0),
    (
        0.923_879_532_511_286_7,
        0.075_482_331_543_151_83,
        0.146_218_649_216_018_15,
    ),
    (0.980_785_280_403_230_4, 0.037_368_702_837_205_61, 0.0),
    (1.0, 0.003_921_568_627_450_98, 0.015_873_015_873_015_872),
];

/// An interval whose integral may be wrong by more than this fraction of the integral of the size so far is bisected.
const TOLERANCE: f64 = 1e-11;

/// [`TOLERANCE`] for a part of a step that has been bisected: at a kink the two formulas may agree by chance to some hundredths of the error.
const TOLERANCE_OF_PART: f64 = 1e-13;

/// The shortest interval that is bisected, as a fraction of a step: what it contributes does not matter, even if the formula jumps there.
const SHORTEST: f64 = 1.0 / (1u64 << 40) as f64;

/// How many intervals an integral may look at in one step: enough for a thousand turns of a shaft in a step.
const MOST_INTERVALS: usize = 32_768;

/// How many of these each further step allows. The rounding of a formula that cancels, as of an energy less its start, cannot be resolved:
/// it costs this many intervals a step. A jump costs about 80.
const INTERVALS_OF_STEP: usize = 32;

/// How many states of a step are kept for other formulas.
const MOST_STATES: usize = 256;

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
    /// The integral of the absolute value.
    size: f64,
    /// How many intervals the integral may still look at.
    allowed: usize,
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
            size: 0.0,
            allowed: MOST_INTERVALS,
            since: None,
            until: 0.0,
            first: None,
            last: None,
        }
    }

    /// Updates the reduction with the last step, starting at a fraction of it.
    pub fn add_step(&mut self, step: &StepStates<'_, '_>, from: f64) -> Result<(), Error> {
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
                let length = end - start;
                let power = |theta: f64| {
                    let value = value(theta)?;
                    Ok(if is_square { value * value } else { value })
                };
                let known = self.size / length.abs();
                self.allowed = (self.allowed + INTERVALS_OF_STEP).min(MOST_INTERVALS);
                let allowed = &mut self.allowed;
                let [sum, size] = integral(power, [from, 1.0], parts, (known, allowed))?;
                self.integral += length * sum;
                self.size += length.abs() * size;
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

/// The integrals of a function and of its absolute value between two fractions of a step.
///
/// The formulas of Clenshaw and Curtis of two degrees are compared in each interval, first in this many equal parts, and an interval is bisected
/// in which they differ: at a kink, at a jump, or where the function oscillates many times, as in the long steps of a body that turns
/// uniformly. `known` is the integral of the absolute value before this step, by which errors are measured too: otherwise round-off of a
/// function that has died down would be resolved. `allowed` is reduced by the number of intervals.
fn integral(
    mut f: impl FnMut(f64) -> Result<f64, Error>,
    [from, to]: [f64; 2],
    parts: u32,
    (known, allowed): (f64, &mut usize),
) -> Result<[f64; 2], Error> {
    let cut = |part: u32| match part {
        _ if part == parts => to,
        _ => from + (to - from) * f64::from(part) / f64::from(parts),
    };
    let first = (0..parts).rev();
    let first = first.map(|part| ([cut(part), cut(part + 1)], TOLERANCE));
    let mut open: Vec<([f64; 2], f64)> = first.collect();
    let (mut sum, mut size) = (0.0, 0.0);
    let mut scale = known;
    while let Some(([a, b], enough)) = open.pop() {
        *allowed = allowed.saturating_sub(1);
        let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
        let (mut fine, mut coarse, mut own) = (0.0, 0.0, 0.0);
        for (node, weight, of_coarse) in NODES {
            let value = f((middle + half * node).clamp(a, b))?;
            fine += half * weight * value;
            coarse += half * of_coarse * value;
            own += half * weight * value.abs();
        }
        scale = (size + own).max(scale);
        let error = (fine - coarse).abs();
        // A value that is not a number is a result.
        let is_enough = own == 0.0 || !own.is_finite() || error <= enough * scale;
        if is_enough || b - a < SHORTEST || *allowed <= open.len() {
            sum += fine;
            size += own;
        } else {
            open.push(([middle, b], TOLERANCE_OF_PART));
            open.push(([a, middle], TOLERANCE_OF_PART));
        }
    }
    Ok([sum, size])
}

/// Time, state and inputs at a fraction of a step, and accelerations if they were needed.
#[derive(Debug)]
struct StepState {
    theta: f64,
    t: f64,
    q: Vec<f64>,
    v: Vec<f64>,
    u: Named,
    a: Vec<f64>,
    has_accelerations: bool,
}

/// The states evaluated within a step, up to [`MOST_STATES`]; kept from one step to the next to avoid allocation.
#[derive(Debug, Default)]
pub(crate) struct StateCache {
    /// The first `of_step` entries belong to the current step.
    states: Vec<StepState>,
    of_step: usize,
}

/// A step that several formulas evaluate at the same points, so that each state is computed once.
pub(crate) struct StepStates<'s, 'm> {
    pub span: [f64; 2],
    pub is_series: bool,
    system: &'s InterpretedSystem,
    motion: RefCell<&'s mut (dyn StepMotion<InterpretedMachine> + 'm)>,
    cache: RefCell<&'s mut StateCache>,
}

impl<'s, 'm> StepStates<'s, 'm> {
    pub fn new(
        system: &'s InterpretedSystem,
        motion: &'s mut (dyn StepMotion<InterpretedMachine> + 'm),
        cache: &'s mut StateCache,
    ) -> Self {
        cache.of_step = 0;
        StepStates {
            span: motion.span(),
            is_series: motion.is_series(),
            system,
            motion: RefCell::new(motion),
            cache: RefCell::new(cache),
        }
    }

    /// The value of a formula at a fraction of the step.
    pub fn value(&self, theta: f64, formula: Formula) -> Result<f64, Error> {
        let mut motion = self.motion.borrow_mut();
        let mut cache = self.cache.borrow_mut();
        let StateCache { states, of_step } = &mut **cache;
        let known = states[..*of_step]
            .iter()
            .position(|state| state.theta == theta);
        let place = match known {
            Some(place) => place,
            None => {
                // The last place is used again and again when there are no more.
                *of_step = (*of_step).min(MOST_STATES - 1);
                if states.len() == *of_step {
                    let zeros = || vec![0.0; self.system.coordinates().len()];
                    states.push(StepState {
                        theta,
                        t: 0.0,
                        q: zeros(),
                        v: zeros(),
                        u: self.system.default_inputs(),
                        a: zeros(),
                        has_accelerations: false,
                    });
                }
                let state = &mut states[*of_step];
                state.theta = theta;
                state.t = motion.state_at(theta, &mut state.q, &mut state.v)?;
                state.u = motion.inputs(state.t, &state.q, &state.v);
                state.has_accelerations = false;
                *of_step += 1;
                *of_step - 1
            }
        };
        let state = &mut states[place];
        if formula.reads_accelerations && !state.has_accelerations {
            motion.accelerations((state.t, &state.q, &state.v), &state.u, &mut state.a)?;
            state.has_accelerations = true;
        }
        let StepState { t, q, v, u, a, .. } = state;
        // Outputs that do not depend on accelerations get none.
        let a = if state.has_accelerations { &a[..] } else { &[] };
        Ok(self.system.output(formula.output, *t, q, v, a, &u.values))
    }
}
