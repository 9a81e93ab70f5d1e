//! Proves bounds that contain the motion.
//!
//! The set of all states at a time is represented as `c + B s`: a point, a matrix with nearly orthogonal columns, and a box of intervals. A
//! step encloses, one after the other:
//!
//! 1. The motion during the step in a box `Z` with `Y + [0, h] f(Z) ⊆ Z`, where `Y` contains the set and `f` is the right-hand side: by
//!    the Picard–Lindelöf theorem the motion then exists and stays in `Z`.
//! 2. The end of the motion from `c`: `φ(c) = Σ cⱼ hʲ` up to order p, and the remainder `h^(p+1) c₍p+1₎(Z)`, with the coefficient that
//!    the recurrences give for all states in `Z` (R. E. Moore, *Interval Analysis*, 1966, chapter 11).
//! 3. The ends from the other states, by the mean value theorem, `φ(c) + Dφ(Y) (B s)`, with derivatives from the same recurrences over
//!    dual numbers.
//! 4. Their set in new axes, where `B'` is the orthogonal factor of the midpoint of `Dφ(Y) B`, so that boxes that turn do not grow (R.
//!    J. Lohner, *Einschließung der Lösung gewöhnlicher Anfangs- und Randwertaufgaben und Anwendungen*, 1988; N. S. Nedialkov, K. R.
//!    Jackson, G. F. Corliss, *Validated solutions of initial value problems for ordinary differential equations*, Appl. Math. Comput. 105
//!    (1999) 21–68, sections 5 and 6).
//!
//! All computations are in intervals that are rounded outward.

use std::string::String;
use std::sync::Arc;
use std::vec;
use std::vec::Vec;

use core::fmt;

use lagrangian_program::series::{Expander, Series};
use lagrangian_program::{Arguments, Interpreter, Program, Role};
use lagrangian_scalar::{Dual, Interval, Scalar};

use super::InterpretedMachine;
use crate::error::NoNumbers;
use crate::taylor::{bound, larger_ratio, length, size_of_rate};

/// Number of coefficients of the accelerations in a step.
const ORDER: usize = 24;

/// The largest size of the last terms of a step. The remainder is bounded for all states of a box, so it is larger than these.
const LAST_TERMS: f64 = 1e-19;

/// How many times a step is halved if no box is found for its motion.
const HALVINGS: usize = 60;

/// How many times a box is widened for one length of a step.
const WIDENINGS: usize = 6;

/// Before a box is tried it is widened on both sides by this fraction of its width.
const WIDENED: f64 = 0.1;

/// The remainder of a step may be this fraction of the width of the set.
const REMAINDER_SHARE: f64 = 1e-3;

/// A set whose widest number is wider than this is of no use, and steps from it could become arbitrarily short.
const WIDEST: f64 = 1e3;

/// Advances a set of states of a machine, and proves that it contains the motion.
///
/// For machines that have a series ([`InterpretedMachine::with_series`]) and no constraints, with constant inputs. Parameters, inputs
/// and start are the `f64` of the machine: the proof is about the motion of that machine, and not of one whose numbers are the
/// decimals of a spec.
///
/// ```
/// use lagrangian::interpreted::{Enclosure, InterpretedMachine};
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
/// let mut enclosure = Enclosure::new(&machine)?;
/// enclosure.advance_to(10.0)?;
/// // x = cos 2t
/// let x = enclosure.q()[0];
/// assert!(x.contains(20.0_f64.cos()) && x.width() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Enclosure {
    program: Arc<Program>,
    assumptions: Interpreter<Interval>,
    inputs: Vec<Interval>,
    of_states: Expander<Interval>,
    of_derivatives: Expander<Dual<Interval>>,
    t: f64,
    /// The longest next step, in s.
    longest: f64,
    /// The set, and a box around it.
    middle: Vec<f64>,
    axes: Vec<f64>,
    along: Vec<Interval>,
    states: Vec<Interval>,
    steps: usize,
    max_steps: usize,
}

/// Why the enclosure of a motion ends.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum NotEnclosed {
    /// No step is short enough to find a box that contains its motion.
    NoBox {
        /// Where the enclosure ends, in s.
        t: f64,
    },
    /// The set has become too wide for useful bounds.
    TooWide {
        /// Where the enclosure ends, in s.
        t: f64,
    },
    /// An assumption of the description could not be proved to hold.
    Assumption {
        /// The assumption.
        assumption: String,
        /// Where the enclosure ends, in s.
        t: f64,
    },
    /// More steps are needed than allowed.
    TooManySteps {
        /// Where the enclosure ends, in s.
        t: f64,
    },
    /// The end time is not a finite number.
    NoTime,
}

impl fmt::Display for NotEnclosed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoBox { t } => write!(
                f,
                "the motion is enclosed up to t = {t} s, and from there no step, however short, could be verified"
            ),
            Self::TooWide { t } => write!(
                f,
                "the motion is enclosed up to t = {t} s, where the bounds have become too wide to continue"
            ),
            Self::Assumption { assumption, t } => write!(
                f,
                "the motion is enclosed up to t = {t} s; the machine's assumption `{assumption}` could not be shown to hold beyond that"
            ),
            Self::TooManySteps { t } => write!(
                f,
                "the motion is enclosed up to t = {t} s; more steps would be needed than are allowed"
            ),
            Self::NoTime => f.write_str("the end time is not a finite number"),
        }
    }
}

impl core::error::Error for NotEnclosed {}

impl Enclosure {
    /// Encloses the motion from the start of the machine, exactly, at `t = 0`.
    ///
    /// # Errors
    /// The reason why the motion cannot be enclosed.
    pub fn new(machine: &InterpretedMachine) -> Result<Self, NoNumbers> {
        let start = crate::Machine::start(machine);
        let exactly = |values: &[f64]| -> Vec<Interval> {
            values.iter().map(|x| Interval::from(*x)).collect()
        };
        let (q, v) = (exactly(&start.q.values), exactly(&start.v.values));
        Self::from_states(machine, 0.0, [&q, &v])
    }

    /// Encloses the motion from all states in a box, at a time in s: coordinates and rates.
    ///
    /// # Errors
    /// As [`new`](Self::new); and if a bound is not a finite number.
    ///
    /// # Panics
    /// If the numbers of coordinates and rates are not those of the machine.
    pub fn from_states(
        machine: &InterpretedMachine,
        t: f64,
        [q, v]: [&[Interval]; 2],
    ) -> Result<Self, NoNumbers> {
        let n = machine.program.dimension();
        assert_eq!([q.len(), v.len()], [n, n], "one number for each coordinate");
        machine.check_numbers()?;
        let series = machine.series.known().series.as_ref();
        let series: Arc<Series> = series
            .map_err(|why| NoNumbers { why: why.clone() })?
            .clone();
        let numbers = [&machine.parameters[..], &machine.inputs[..], &[t]].concat();
        let states: Vec<Interval> = [q, v].concat();
        let are_finite = states.iter().all(|y| y.is_finite());
        if !are_finite || !numbers.iter().all(|x| x.is_finite()) {
            return Err(NoNumbers {
                why: "a parameter, an input or a number of its start is not finite".into(),
            });
        }
        let exactly = |values: &[f64]| -> Vec<Interval> {
            values.iter().map(|x| Interval::from(*x)).collect()
        };
        let parameters = exactly(&machine.parameters);
        let constants: Vec<_> = parameters.iter().map(|p| Dual::constant(*p)).collect();
        let middle: Vec<f64> = states.iter().map(|y| y.to_f64()).collect();
        let along = states.iter().zip(&middle);
        let along = along
            .map(|(y, middle)| *y - Interval::from(*middle))
            .collect();
        Ok(Self {
            assumptions: Interpreter::new(&machine.program, &parameters),
            program: machine.program.clone(),
            inputs: exactly(&machine.inputs),
            of_states: Expander::new(series.clone(), &parameters, ORDER).with_residuals(),
            of_derivatives: Expander::new(series, &constants, ORDER).with_residuals(),
            t,
            longest: f64::INFINITY,
            middle,
            axes: identity(2 * n),
            along,
            states,
            steps: 0,
            max_steps: 100_000,
        })
    }

    /// Time, in s.
    pub fn t(&self) -> f64 {
        self.t
    }

    /// Bounds of the coordinates, in the order of the description.
    pub fn q(&self) -> &[Interval] {
        &self.states[..self.states.len() / 2]
    }

    /// Bounds of their rates.
    pub fn v(&self) -> &[Interval] {
        &self.states[self.states.len() / 2..]
    }

    /// The number of steps taken.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Sets the largest number of steps in total; 100 000 by default.
    pub fn set_max_steps(&mut self, steps: usize) {
        self.max_steps = steps;
    }

    /// Advances to time `t`, in s, later or earlier than now, and stops there.
    ///
    /// # Errors
    /// The reason why the enclosure ends; it stays at that time.
    pub fn advance_to(&mut self, t: f64) -> Result<(), NotEnclosed> {
        if !t.is_finite() {
            return Err(NotEnclosed::NoTime);
        }
        while self.t != t {
            if self.steps == self.max_steps {
                return Err(NotEnclosed::TooManySteps { t: self.t });
            }
            self.step(t)?;
        }
        Ok(())
    }

    /// Takes one step, which ends at `end` or before it.
    ///
    /// # Errors
    /// As for [`advance_to`](Self::advance_to).
    pub fn step(&mut self, end: f64) -> Result<(), NotEnclosed> {
        let t = self.t;
        if self.t == end {
            return Ok(());
        }
        let no_box = NotEnclosed::NoBox { t };
        let is_wide = |y: &Interval| y.width().is_nan() || y.width() >= WIDEST;
        if self.states.iter().any(is_wide) {
            return Err(NotEnclosed::TooWide { t });
        }
        let start = Interval::from(t);
        let middle: Vec<Interval> = self.middle.iter().map(|x| Interval::from(*x)).collect();
        let of_middle = self.expand(start, &middle).ok_or(no_box.clone())?;
        let states = self.states.clone();
        let of_states = self.expand(start, &states).ok_or(no_box.clone())?;
        let mut h = self.tolerable_length(&of_states).min(self.longest);
        for _ in 0..HALVINGS {
            // The step from one floating-point time to another, and its enclosed length.
            let is_last = h >= (end - t).abs();
            let to = if is_last {
                end
            } else {
                t + h.copysign(end - t)
            };
            let step = Interval::from(to) - start;
            if to == t {
                break;
            }
            if let Some(within) = self.enclose_step(step)
                && let Some(advanced) = self.advance(step, &of_middle, &within)
            {
                self.check_assumptions(step, &within)?;
                (self.middle, self.axes, self.along, self.states) = advanced;
                self.t = to;
                self.steps += 1;
                // After a successful step the next one may be a little longer.
                self.longest = if is_last { self.longest } else { 1.5 * h };
                return Ok(());
            }
            h *= 0.5;
        }
        Err(no_box)
    }

    /// The coefficients of all coordinates for all states of a box.
    fn expand(&mut self, t: Interval, states: &[Interval]) -> Option<Vec<Vec<Interval>>> {
        let n = states.len() / 2;
        let (q, v) = states.split_at(n);
        let time = [t, Interval::ZERO];
        self.of_states.expand(time, q, v, &self.inputs).ok()?;
        let rows: Vec<Vec<Interval>> = (0..n)
            .map(|i| self.of_states.coordinate(i).to_vec())
            .collect();
        let are_finite = rows.iter().flatten().all(|c| c.is_finite());
        are_finite.then_some(rows)
    }

    /// The length of a step whose last terms are tolerable for all states of the set, including the widths of their bounds. These widths
    /// grow from order to order like the terms of a series whose products are sums of absolute values. That series has a smaller radius of
    /// convergence than the motion, and in longer steps the bounds of high orders would dominate.
    fn tolerable_length(&self, of_states: &[Vec<Interval>]) -> f64 {
        let n = of_states.len();
        let powers = [ORDER, ORDER + 1];
        let mut worst = [0.0_f64; 2];
        for (i, row) in of_states.iter().enumerate() {
            let size = size_of_rate(self.middle[i], self.middle[n + i]);
            let over = 1.0 / bound(size, LAST_TERMS, LAST_TERMS);
            for (worst, j) in worst.iter_mut().zip(powers) {
                let most = row[j].lo().abs().max(row[j].hi().abs());
                *worst = larger_ratio(*worst, most, j as f64, over);
            }
        }
        length(worst, powers)
    }

    /// Whether the remainder of a step, for all states of the box that encloses its motion, is small relative to the width of the set or to
    /// rounding. That box is as wide as the motion within the step, so its coefficients are wider than those of the set, and the step may
    /// have to be shorter than the last terms of the series require.
    fn is_negligible(&self, step: Interval, rest: &[Vec<Interval>]) -> bool {
        let n = rest.len();
        let most = |y: Interval| y.lo().abs().max(y.hi().abs());
        let h = most(step);
        (0..n).all(|i| {
            let size = 1.0 + self.middle[i].abs().max(self.middle[n + i].abs());
            let allowed =
                |at: usize| f64::EPSILON * size + REMAINDER_SHARE * self.states[at].width();
            let last = most(rest[i][ORDER + 1]) * h.powi(ORDER as i32);
            last * h <= allowed(i) && last * (ORDER + 1) as f64 <= allowed(n + i)
        })
    }

    /// A box that contains the motion during a step from all states of the set.
    fn enclose_step(&mut self, step: Interval) -> Option<Vec<Interval>> {
        let span = hull(Interval::ZERO, step);
        let t = Interval::from(self.t) + span;
        let states = self.states.clone();
        let picard = |this: &mut Self, within: &[Interval]| -> Option<Vec<Interval>> {
            let slopes = this.slopes(t, within)?;
            let image = states.iter().zip(slopes);
            let image: Vec<Interval> = image.map(|(y, slope)| *y + span * slope).collect();
            image.iter().all(|y| y.is_finite()).then_some(image)
        };
        let mut tried = picard(self, &states)?;
        for _ in 0..WIDENINGS {
            let wider: Vec<Interval> = tried.iter().map(|y| widened(*y)).collect();
            let image = picard(self, &wider)?;
            let is_within = |(inner, outer): (&Interval, &Interval)| {
                outer.lo() <= inner.lo() && inner.hi() <= outer.hi()
            };
            if image.iter().zip(&wider).all(is_within) {
                return Some(image);
            }
            let pairs = tried.iter().zip(&image);
            tried = pairs.map(|(one, other)| hull(*one, *other)).collect();
        }
        None
    }

    /// Rates and accelerations of all states of a box.
    fn slopes(&mut self, t: Interval, states: &[Interval]) -> Option<Vec<Interval>> {
        let n = states.len() / 2;
        let (q, v) = states.split_at(n);
        let mut slopes = [v, v].concat();
        let arguments = Arguments {
            t,
            q,
            v,
            u: &self.inputs,
            a: &[],
        };
        let a = &mut slopes[n..];
        self.assumptions
            .call(Role::Accelerations, arguments, a)
            .ok()?;
        slopes.iter().all(|y| y.is_finite()).then_some(slopes)
    }

    /// The set at the end of a step: midpoint, axes, the box along these, and an enclosing box.
    #[expect(clippy::type_complexity, reason = "the four fields of the set")]
    fn advance(
        &mut self,
        step: Interval,
        of_middle: &[Vec<Interval>],
        within: &[Interval],
    ) -> Option<(Vec<f64>, Vec<f64>, Vec<Interval>, Vec<Interval>)> {
        let n = of_middle.len();
        let m = 2 * n;
        let t = Interval::from(self.t);
        let rest = self.expand(t + hull(Interval::ZERO, step), within)?;
        if !self.is_negligible(step, &rest) {
            return None;
        }
        // The end of the motion from the midpoint.
        let mut ends = vec![Interval::ZERO; m];
        for i in 0..n {
            let (mut q, mut v) = (
                rest[i][ORDER + 1] * step,
                order(ORDER + 1) * rest[i][ORDER + 1],
            );
            for j in (1..=ORDER).rev() {
                q = (q + of_middle[i][j]) * step;
                v = v * step + order(j) * of_middle[i][j];
            }
            (ends[i], ends[n + i]) = (q + of_middle[i][0], v);
        }
        // The derivative of the end with respect to the start: of φ, without the contribution of `rest`.
        let slopes = self.derivatives(step)?;
        let turned = product(&slopes, &exact(&self.axes), m);
        let moved = apply(&turned, &self.along);
        let middle: Vec<f64> = ends.iter().map(|y| y.to_f64()).collect();
        let left: Vec<Interval> = ends
            .iter()
            .zip(&middle)
            .map(|(y, c)| *y - Interval::from(*c))
            .collect();
        let axes = orthogonal(&turned, &self.along, m);
        let inverse = inverse_of_orthogonal(&axes, m)?;
        let along: Vec<Interval> = apply(&product(&inverse, &turned, m), &self.along)
            .into_iter()
            .zip(apply(&inverse, &left))
            .map(|(turned, left)| turned + left)
            .collect();
        let by_axes = apply(&exact(&axes), &along);
        let states: Vec<Interval> = (0..m)
            .map(|i| {
                let one = ends[i] + moved[i];
                let other = Interval::from(middle[i]) + by_axes[i];
                // The motion is in both. The mean value theorem needs the midpoint as well.
                let intersection =
                    Interval::new(one.lo().max(other.lo()), one.hi().min(other.hi()));
                hull(intersection, Interval::from(middle[i]))
            })
            .collect();
        let all = along.iter().chain(&states);
        all.into_iter()
            .all(|y| y.is_finite())
            .then_some((middle, axes, along, states))
    }

    /// The derivatives of `φ(y) = Σ cⱼ(y) hʲ`, up to order p, with respect to the start, for all starts in the set; row after row.
    fn derivatives(&mut self, step: Interval) -> Option<Vec<Interval>> {
        let m = self.states.len();
        let n = m / 2;
        let constants =
            |values: &[Interval]| -> Vec<_> { values.iter().map(|x| Dual::constant(*x)).collect() };
        let inputs = constants(&self.inputs);
        let time = [Dual::constant(Interval::from(self.t)), Dual::ZERO];
        let mut slopes = vec![Interval::ZERO; m * m];
        for column in 0..m {
            let mut states = constants(&self.states);
            states[column].derivative = Interval::ONE;
            let (q, v) = states.split_at(n);
            let expander = &mut self.of_derivatives;
            expander.expand(time, q, v, &inputs).ok()?;
            for i in 0..n {
                let row = expander.coordinate(i);
                let (mut q, mut v) = (Interval::ZERO, Interval::ZERO);
                for j in (1..=ORDER).rev() {
                    let c = row[j].derivative;
                    q = (q + c) * step;
                    v = v * step + order(j) * c;
                }
                slopes[i * m + column] = q + row[0].derivative;
                slopes[(n + i) * m + column] = v;
            }
        }
        slopes.iter().all(|x| x.is_finite()).then_some(slopes)
    }

    /// Checks that all assumptions of the description hold for all states in a box.
    fn check_assumptions(
        &mut self,
        step: Interval,
        within: &[Interval],
    ) -> Result<(), NotEnclosed> {
        let (q, v) = within.split_at(within.len() / 2);
        let t = Interval::from(self.t) + hull(Interval::ZERO, step);
        for (index, assumption) in self.program.assumptions.iter().enumerate() {
            let mut margin = [Interval::UNKNOWN];
            let arguments = Arguments {
                t,
                q,
                v,
                u: &self.inputs,
                a: &[],
            };
            let called = self
                .assumptions
                .call(Role::Assumption(index), arguments, &mut margin);
            if called.is_err() || !margin[0].exceeds(Interval::ZERO) {
                return Err(NotEnclosed::Assumption {
                    assumption: assumption.text.clone(),
                    t: self.t,
                });
            }
        }
        Ok(())
    }
}

/// A number as an interval.
fn order(j: usize) -> Interval {
    Interval::from(j as f64)
}

fn hull(one: Interval, other: Interval) -> Interval {
    Interval::new(one.lo().min(other.lo()), one.hi().max(other.hi()))
}

/// An interval that is widened on both sides and is never a point.
fn widened(y: Interval) -> Interval {
    let by =
        WIDENED * y.width() + f64::EPSILON * y.lo().abs().max(y.hi().abs()) + f64::MIN_POSITIVE;
    Interval::new(y.lo() - by, y.hi() + by)
}

fn identity(m: usize) -> Vec<f64> {
    (0..m * m)
        .map(|at| if at / m == at % m { 1.0 } else { 0.0 })
        .collect()
}

fn exact(numbers: &[f64]) -> Vec<Interval> {
    numbers.iter().map(|x| Interval::from(*x)).collect()
}

fn sum(terms: impl Iterator<Item = Interval>) -> Interval {
    terms.fold(Interval::ZERO, |sum, term| sum + term)
}

/// The product of two square matrices, row after row.
fn product(a: &[Interval], b: &[Interval], m: usize) -> Vec<Interval> {
    let entry = |at: usize| {
        let (i, j) = (at / m, at % m);
        sum((0..m).map(|k| a[i * m + k] * b[k * m + j]))
    };
    (0..m * m).map(entry).collect()
}

/// A square matrix times a vector.
fn apply(a: &[Interval], x: &[Interval]) -> Vec<Interval> {
    let rows = a.chunks_exact(x.len().max(1));
    rows.map(|row| sum(row.iter().zip(x).map(|(a, x)| *a * *x)))
        .collect()
}

/// Nearly orthogonal axes along the midpoint of a matrix: its columns, orthogonalized in the order of decreasing extent of the box. Their
/// round-off has no effect on the proof, since their inverse is enclosed.
fn orthogonal(a: &[Interval], along: &[Interval], m: usize) -> Vec<f64> {
    let column = |j: usize| -> Vec<f64> { (0..m).map(|i| a[i * m + j].to_f64()).collect() };
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let mut columns: Vec<(f64, Vec<f64>)> = (0..m)
        .map(|j| {
            let column = column(j);
            (dot(&column, &column).sqrt() * along[j].width(), column)
        })
        .collect();
    columns.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut axes: Vec<Vec<f64>> = Vec::new();
    // A column that depends on the others is replaced by a coordinate axis.
    let spare = (0..m).map(|j| {
        let mut unit = vec![0.0; m];
        unit[j] = 1.0;
        unit
    });
    for mut axis in columns.into_iter().map(|(_, column)| column).chain(spare) {
        if axes.len() == m {
            break;
        }
        let before = dot(&axis, &axis).sqrt();
        // Two passes suffice: W. Kahan and B. Parlett, in B. N. Parlett, The Symmetric Eigenvalue Problem, 1980, section 6.9.
        for _ in 0..2 {
            for other in &axes {
                let share = dot(&axis, other);
                for (x, y) in axis.iter_mut().zip(other) {
                    *x -= share * y;
                }
            }
        }
        let left = dot(&axis, &axis).sqrt();
        if left > 1e-10 * before && left > 0.0 && left.is_finite() {
            axes.push(axis.into_iter().map(|x| x / left).collect());
        }
    }
    let mut matrix = identity(m);
    for (j, axis) in axes.iter().enumerate() {
        for (i, x) in axis.iter().enumerate() {
            matrix[i * m + j] = *x;
        }
    }
    matrix
}

/// The inverse of a nearly orthogonal matrix B. With `E = I − Bᵀ B`, `B⁻¹ = (I − E)⁻¹ Bᵀ`, and `E + E² + …` is bounded by `e/(1 − e)` in
/// the sum of each row, where `e = ‖E‖∞ < 1`.
fn inverse_of_orthogonal(b: &[f64], m: usize) -> Option<Vec<Interval>> {
    let transposed: Vec<Interval> = (0..m * m)
        .map(|at| Interval::from(b[at % m * m + at / m]))
        .collect();
    let nearly_one = product(&transposed, &exact(b), m);
    let size = |x: Interval| Interval::from(x.lo().abs().max(x.hi().abs()));
    let error = (0..m).map(|i| {
        let entries = (0..m).map(|j| {
            let one = if i == j {
                Interval::ONE
            } else {
                Interval::ZERO
            };
            size(one - nearly_one[i * m + j])
        });
        sum(entries).hi()
    });
    let error = Interval::from(error.fold(0.0, f64::max));
    let greatest = b.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let beyond = error / (Interval::ONE - error) * Interval::from(greatest);
    let is_near = error.hi() < 0.5 && beyond.is_finite();
    let around = Interval::new(-beyond.hi(), beyond.hi());
    is_near.then(|| transposed.into_iter().map(|x| x + around).collect())
}
