//! Steps by Taylor series of an interpreted machine, in numbers of any kind.

use std::string::String;
use std::vec;
use std::vec::Vec;

use lagrangian_program::series::Expander;

use super::system::singular_row;
use super::{InterpretedMachine, InterpretedSystem};
use crate::control::{MAX_STEPS, Work, check_count, shortest_step};
use crate::error::NoNumbers;
use crate::math::rough_log2;
use crate::roots;
use crate::step_error::StepError;
use crate::taylor::{
    GREATEST_DEFECT, ROUNDING_UNITS, ROUNDINGS, SHORTEST_STEPS, bound, defect, is_slow,
    larger_ratio, length, length_in_slow_motion, size_of_rate, state,
};
use crate::{Error, Machine, Real, System};

/// The smallest and the largest order of steps.
const ORDERS: [f64; 2] = [12.0, 40.0];

/// Number of coefficients for each factor of e in the tolerance. With more coefficients steps are longer and cost more, since the cost of
/// products of series grows with the square of the order.
const FOR_EACH_FACTOR: f64 = 0.55;

/// The length of the next attempt after a step that was rejected, relative to it.
const SHORTER: f64 = 0.1;

/// The least number of coefficients of a step, where further ones are too large.
const LEAST_ORDER: usize = 6;

/// Coefficients above this are not used: what they are multiplied by may exceed all numbers.
const GREATEST_COEFFICIENT: f64 = 1e200;

/// The series through the end of a step, beside the series of the step.
enum Expansion {
    /// The motion is that of the series of the step, and the expander holds its series from there on.
    Continues,
    /// The motion is another one.
    Differs,
    /// Nothing is known against the step, and the expander holds another series.
    Unknown,
}

/// Advances an interpreted machine by Taylor series, in numbers of any kind: in double-doubles to some 30 digits.
///
/// For machines that have a series ([`InterpretedMachine::with_series`]) and no constraints, with constant inputs. Parameters, inputs and
/// the start are the `f64` of the machine, so the motion is the one that runs in `f64` approximate.
///
/// ```
/// use lagrangian::interpreted::{InterpretedMachine, SeriesStepper};
/// use lagrangian::scalar::{DoubleDouble, Scalar};
/// use lagrangian_mechanics::{Compiled, series::ProvedSeries};
/// use lagrangian_spec::{diagnostic::Report, source::{InMemory, Sources}};
///
/// let text = "machine Oscillator in plane {
///     parameters { m: kg = 2, k: N/m = 8 }
///     coordinates { x: m = 1 }
///     bodies { block { mass: m, at: (x, 0) } }
///     springs { spring { stiffness: k, stretch: x } }
/// }";
/// let (dag, mut sources, mut report) = (Default::default(), Sources::new(), Report::new());
/// let files = &mut InMemory::new();
/// let model = lagrangian_spec::model(&dag, "oscillator", text, &[], files, &mut sources, &mut report);
/// let Some(compiled) = model.and_then(|model| Compiled::new(model, &mut report)) else {
///     panic!("{}", report.render_short(&sources));
/// };
/// let machine = InterpretedMachine::new(compiled.program.clone())
///     .with_series(ProvedSeries::derive(&compiled.model));
/// let mut stepper = SeriesStepper::<DoubleDouble>::new(&machine, 1e-28)?;
/// stepper.advance_to(DoubleDouble::ONE)?;
/// // x = cos √(k/m) t
/// let exact = DoubleDouble::from_f64(2.0).cos();
/// assert!((stepper.q()[0] - exact).abs().to_f64() < 1e-28);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct SeriesStepper<N: Real> {
    expander: Expander<N>,
    /// The system in `f64`, for names and for assumptions of the description.
    system: InterpretedSystem,
    tolerance: f64,
    inputs: Vec<N>,
    t: N,
    q: Vec<N>,
    v: Vec<N>,
    /// Coefficients of all coordinates, order by order; 0 beyond `last`.
    coefficients: Vec<Vec<N>>,
    /// The last order of the coefficients in use.
    last: usize,
    /// Whether the expander holds the series through the present state.
    is_expanded: bool,
    work: Work,
    max_steps: usize,
}

impl<N: Real + lagrangian_scalar::Scalar<Stored = N>> SeriesStepper<N> {
    /// A stepper at the start of the machine, at `t = 0`. Each step keeps its error in a number `y` below `tolerance · (1 + |y|)`; the
    /// tolerance is at least ten roundings of the numbers.
    ///
    /// # Errors
    /// The reason why the machine has no such steps.
    pub fn new(machine: &InterpretedMachine, tolerance: f64) -> Result<Self, NoNumbers> {
        let start = machine.start();
        Self::from_state(machine, tolerance, (0.0, &start.q.values, &start.v.values))
    }

    /// A stepper at a state: time in s, coordinates and rates.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    ///
    /// # Panics
    /// If the numbers of coordinates and rates are not those of the machine.
    pub fn from_state(
        machine: &InterpretedMachine,
        tolerance: f64,
        (t, q, v): (f64, &[f64], &[f64]),
    ) -> Result<Self, NoNumbers> {
        let n = machine.program.dimension();
        assert_eq!([q.len(), v.len()], [n, n], "one number for each coordinate");
        machine.check_numbers()?;
        let series = machine.series.known().series.as_ref();
        let series = series.map_err(|why| NoNumbers { why: why.clone() })?;
        let numbers = |values: &[f64]| values.iter().map(|x| N::from_f64(*x)).collect();
        let tolerance = tolerance.max(10.0 * N::EPSILON);
        let factors = -rough_log2(tolerance) * core::f64::consts::LN_2;
        let order = (factors * FOR_EACH_FACTOR).round();
        let order = order.clamp(ORDERS[0], ORDERS[1]) as usize;
        let parameters: Vec<N> = numbers(&machine.parameters);
        Ok(Self {
            expander: Expander::new(series.clone(), &parameters, order),
            system: machine.prepare(),
            tolerance,
            inputs: numbers(&machine.inputs),
            t: N::from_f64(t),
            q: numbers(q),
            v: numbers(v),
            coefficients: vec![vec![N::ZERO; n]; order + 2],
            last: order + 1,
            is_expanded: false,
            work: Work::default(),
            max_steps: MAX_STEPS,
        })
    }

    /// Sets the largest number of steps of one [`advance_to`](Self::advance_to); ten million by default.
    pub fn set_max_steps(&mut self, steps: usize) {
        self.max_steps = steps;
    }

    /// Time, in s.
    pub fn t(&self) -> N {
        self.t
    }

    /// Coordinates, in the order of the description.
    pub fn q(&self) -> &[N] {
        &self.q
    }

    /// Their rates.
    pub fn v(&self) -> &[N] {
        &self.v
    }

    /// The work done so far. An expansion of the series counts as one evaluation.
    pub fn work(&self) -> Work {
        self.work
    }

    /// The number of coefficients of the accelerations in a step.
    pub fn order(&self) -> usize {
        self.expander.order()
    }

    /// The tolerance of a step: the requested one, but at least ten roundings.
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Steps to time `t`, in s, later or earlier than now, and stops there.
    ///
    /// # Errors
    /// If a step cannot be taken; the state is then the end of the last one. If `t` is not a finite number; then nothing happens.
    pub fn advance_to(&mut self, t: N) -> Result<(), Error> {
        if !lagrangian_scalar::Scalar::is_finite(t) {
            return Err(self.to_error(StepError::NoTime { t: t.to_f64() }));
        }
        let mut taken = 0;
        while self.t != t {
            check_count(taken, self.max_steps, self.t.to_f64())
                .map_err(|error| self.to_error(error))?;
            self.step(t)?;
            taken += 1;
        }
        Ok(())
    }

    /// Takes one step, which ends at `end` or before it. It is shortened if the motion is not its series at the end: a root of squares, such
    /// as a distance or a speed, passes zero within it.
    ///
    /// # Errors
    /// As for [`advance_to`](Self::advance_to).
    pub fn step(&mut self, end: N) -> Result<(), Error> {
        let (mut h, is_last) = self.choose(end).map_err(|error| self.to_error(error))?;
        let mut next = if is_last { end } else { self.t + h };
        let is_expanded = loop {
            match self.expansion_at(next, h) {
                Expansion::Continues => break true,
                Expansion::Unknown => break false,
                Expansion::Differs => {
                    self.work.rejected += 1;
                    h = N::from_f64(SHORTER * h.to_f64());
                    next = self.t + h;
                }
            }
        };
        let t = self.t.to_f64();
        for theta in self.isolating_fractions(h)? {
            let tau = N::from_f64(theta) * h;
            let (q, v) = state(&self.coefficients, tau);
            let mut numbers = q.iter().zip(&v);
            let is_finite = |x: &N| lagrangian_scalar::Scalar::is_finite(*x);
            if let Some(coordinate) = numbers.position(|(q, v)| !is_finite(q) || !is_finite(v)) {
                return Err(self.to_error(StepError::NotFinite { coordinate, t }));
            }
            let t = (self.t + tau).to_f64();
            if let Some(assumption) = self.ended_assumption(t, [&q, &v]) {
                return Err(Error::AssumptionEnded { assumption, t });
            }
            if theta == 1.0 {
                (self.q, self.v) = (q, v);
            }
        }
        self.t = next;
        self.is_expanded = is_expanded;
        self.work.steps += 1;
        Ok(())
    }

    /// Expands the motion through the end of a step of length `h`, at the time `next`, and compares its accelerations with those of the
    /// series of the step.
    fn expansion_at(&mut self, next: N, h: N) -> Expansion {
        let (q, v) = state(&self.coefficients, h);
        let mut numbers = q.iter().chain(&v);
        if !numbers.all(|x| lagrangian_scalar::Scalar::is_finite(*x)) {
            return Expansion::Unknown;
        }
        let Some(found) = self.accelerations_at(next, &q, &v) else {
            return Expansion::Unknown;
        };
        let by_series: Vec<N> = (0..q.len())
            .map(|i| {
                let powers = (2..self.coefficients.len()).rev();
                powers.fold(N::ZERO, |sum, j| {
                    sum * h + N::from_f64((j * (j - 1)) as f64) * self.coefficients[j][i]
                })
            })
            .collect();
        let end = [q.as_slice(), v.as_slice()];
        let greatest = self.defect(
            h,
            end,
            [&found[..], &by_series[..]],
            ROUNDING_UNITS * N::EPSILON,
        );
        let shortest = shortest_step::<N>(next.to_f64());
        if greatest <= GREATEST_DEFECT || h.to_f64().abs() <= SHORTEST_STEPS * shortest {
            return Expansion::Continues;
        }
        // Round-off may change the accelerations as much, where large forces cancel.
        let beside = |numbers: &[N], sign: f64| -> Vec<N> {
            let changed = |x: &N| *x + *x * N::from_f64(sign * N::EPSILON);
            numbers.iter().map(changed).collect()
        };
        let changed = self.accelerations_at(next, &beside(&q, 1.0), &beside(&v, -1.0));
        let is_rounding = changed.is_none_or(|changed| {
            greatest <= ROUNDINGS * self.defect(h, end, [&found[..], &changed[..]], 0.0)
        });
        if is_rounding {
            Expansion::Unknown
        } else {
            Expansion::Differs
        }
    }

    /// How far two lists of accelerations at the end of a step of length `h` are apart, as a [`defect`], without this fraction of them.
    fn defect(&self, h: N, end: [&[N]; 2], [one, other]: [&[N]; 2], rounding: f64) -> f64 {
        let coordinates = (0..one.len()).map(|i| {
            let size = |[q, v]: [&[N]; 2]| size_of_rate(q[i].to_f64(), v[i].to_f64());
            let size = size([&self.q[..], &self.v[..]]).max(size(end));
            // Their difference has more digits than the difference of their nearest `f64`.
            let (one, difference) = (one[i].to_f64(), (one[i] - other[i]).to_f64());
            [size, one, difference, self.tolerance]
        });
        defect(h.to_f64(), coordinates, [self.tolerance, rounding])
    }

    /// The accelerations at a state, by an expansion of the motion through it. `None` if there are none.
    fn accelerations_at(&mut self, t: N, q: &[N], v: &[N]) -> Option<Vec<N>> {
        self.work.evaluations += 1;
        (self.expander)
            .expand([t, N::ZERO], q, v, &self.inputs)
            .ok()?;
        let second = |i: usize| self.expander.coordinate(i)[2];
        Some((0..q.len()).map(|i| second(i) + second(i)).collect())
    }

    /// The fractions of a step of length `h` at which to evaluate the assumptions of the description, in order and ending at 1: between
    /// neighbours none of them fails and holds again.
    fn isolating_fractions(&self, h: N) -> Result<Vec<f64>, Error> {
        let inputs = self.system.default_inputs();
        let margin = |theta: f64, index: usize| {
            let tau = N::from_f64(theta) * h;
            let (q, v) = state(&self.coefficients, tau);
            let [q, v] = [q, v].map(|of| of.iter().map(|x| x.to_f64()).collect::<Vec<f64>>());
            let t = (self.t + tau).to_f64();
            let margin = self.system.assumptions(t, &q, &v, &inputs).nth(index);
            margin.map_or(0.0, |assumption| assumption.margin)
        };
        let mut looks = vec![1.0];
        for index in 0..self.system.program.assumptions.len() {
            let found = roots::isolating_fractions(|theta| Ok(margin(theta, index)), || Ok(()));
            looks.extend(found.map_err(|why: roots::NotIsolated<Error>| {
                let t = self.t.to_f64();
                let [q, v] = [&self.q, &self.v]
                    .map(|of| of.iter().map(|x| x.to_f64()).collect::<Vec<f64>>());
                let mut assumptions = self.system.assumptions(t, &q, &v, &inputs);
                let text = assumptions
                    .nth(index)
                    .map_or("?", |assumption| assumption.text);
                why.explain(text, t)
            })?);
        }
        looks.sort_by(f64::total_cmp);
        looks.dedup();
        Ok(looks)
    }

    /// The first assumption of the description that does not hold at a state.
    fn ended_assumption(&self, t: f64, state: [&[N]; 2]) -> Option<String> {
        let [q, v] = state.map(|of| of.iter().map(|x| x.to_f64()).collect());
        let inputs = self.system.default_inputs();
        let mut assumptions = self.system.assumptions(t, &q, &v, &inputs);
        let ended = assumptions.find(|assumption| !assumption.holds())?;
        Some(ended.text.into())
    }

    fn to_error(&self, error: StepError) -> Error {
        Error::of_step(error, &self.system)
    }

    /// Expands the motion through the present state, and returns the length of the step and whether it is the last.
    fn choose(&mut self, end: N) -> Result<(N, bool), StepError> {
        let at = self.t.to_f64();
        if !std::mem::take(&mut self.is_expanded) {
            self.work.evaluations += 1;
            let expanded =
                (self.expander).expand([self.t, N::ZERO], &self.q, &self.v, &self.inputs);
            expanded.map_err(|singular| StepError::Singular {
                singular: singular_row(&self.system.program, singular),
                t: at,
            })?;
        }
        for i in 0..self.q.len() {
            let of_coordinate = self.expander.coordinate(i);
            for (row, c) in self.coefficients.iter_mut().zip(of_coordinate) {
                row[i] = *c;
            }
        }
        self.truncate()?;
        let left = (end - self.t).to_f64();
        let length = self.tolerable_length();
        let is_last = 1.01 * length >= left.abs();
        let h = if is_last {
            end - self.t
        } else {
            N::from_f64(length.copysign(left))
        };
        if h.to_f64().abs() <= shortest_step::<N>(at).min(0.9 * left.abs()) {
            return Err(StepError::StepTooSmall {
                coordinate: 0,
                t: at,
                step: length,
            });
        }
        Ok((h, is_last))
    }

    /// Leaves out the coefficients of the orders from the first that is too large. Next to a zero of a distance or a speed, at δ from it,
    /// rounding errors of coefficients grow as δ⁻ʲ; the steps are as short there, so that few terms are enough.
    fn truncate(&mut self) -> Result<(), StepError> {
        let is_below = |bound: f64| move |c: &N| c.to_f64().abs() < bound;
        let rows = self.coefficients.iter().enumerate();
        let usable = rows.take_while(|(j, row)| {
            let bound = if *j < LEAST_ORDER {
                f64::INFINITY
            } else {
                GREATEST_COEFFICIENT
            };
            row.iter().all(is_below(bound))
        });
        let finite = usable.count();
        if finite < LEAST_ORDER {
            let row = &self.coefficients[finite];
            let coordinate = row.iter().position(|c| !is_below(f64::INFINITY)(c));
            return Err(StepError::NotFinite {
                coordinate: coordinate.unwrap_or(0),
                t: self.t.to_f64(),
            });
        }
        self.last = finite - 1;
        for row in &mut self.coefficients[finite..] {
            row.fill(N::ZERO);
        }
        Ok(())
    }

    /// The length of a step whose last two terms are tolerable.
    fn tolerable_length(&self) -> f64 {
        let last = self.last;
        let powers = [last - 1, last];
        let mut worst = [0.0_f64; 2];
        for i in 0..self.q.len() {
            let size = size_of_rate(self.q[i].to_f64(), self.v[i].to_f64());
            let over = 1.0 / bound(size, self.tolerance, self.tolerance);
            for (worst, j) in worst.iter_mut().zip(powers) {
                let c = self.coefficients[j][i].to_f64();
                *worst = larger_ratio(*worst, c, j as f64, over);
            }
        }
        let by_rates = length(worst, powers);
        if !is_slow(by_rates, last) {
            return by_rates;
        }
        let of = |i: usize| {
            let of_power = |j: usize| self.coefficients[j][i].to_f64();
            let [q, v] = [self.q[i].to_f64(), self.v[i].to_f64()];
            [q, v, of_power(last - 1), of_power(last), self.tolerance]
        };
        let all = (0..self.q.len()).map(of);
        length_in_slow_motion(by_rates, last, all, self.tolerance)
    }
}
