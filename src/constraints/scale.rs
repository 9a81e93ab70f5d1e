//! Scales of the residuals of constraints.
//!
//! A residual is small if rounding alone could have caused it. Round-off has three sources (N. J. Higham,
//! *Accuracy and Stability of Numerical Algorithms*, 2nd ed., sections 1.5 and 3.3), and the scale of a row is
//! the sum of their contributions:
//!
//! * The state is rounded: `Σⱼ |Gₖⱼ| |qⱼ|` and `Σⱼ |Gₖⱼ| |vⱼ| + |∂gₖ/∂t|`, with the largest values in the run
//!   so far, since terms may vanish on the way.
//! * A rate is the integral of accelerations, and these come from the mass matrix, which mixes all
//!   coordinates. So a rate that the constraints keep at 0 is as inexact as the others, in the metric of
//!   inertia: `|Gₖ| |v|`, with `|v|² = Σ Mⱼⱼ vⱼ²` and `|Gₖ|² = Σ Gₖⱼ²/Mⱼⱼ`. By the Cauchy–Schwarz inequality
//!   this is never less than `Σⱼ |Gₖⱼ| |vⱼ|`, and it is 0 only if the machine is at rest.
//! * The constraint is evaluated from terms that do not depend on the state (lengths in parameters that
//!   cancel each other). Their size is not known beforehand: it is measured when Newton's method stagnates.
//!   Of rates these are also velocities by explicit time: two parts that move along with one belt have none
//!   relative to each other. Then a chosen row loses a small rate by rounding, which another row sees. The
//!   length of all these velocities in the metric of inertia is `√(2 T)` with the kinetic energy T at v = 0.

use super::algebra::{root, share};
use super::{REDUCTION_THRESHOLD, RESIDUAL, ROUNDOFF};
use crate::math::{larger, sqrt};
use crate::{System, Vector};

/// The number of rows for each coordinate whose largest terms are remembered without an allocator.
const REMEMBERED: usize = 4;

/// A number of each row, 0 at first.
#[derive(Clone, Debug)]
struct OfRows<V> {
    first: [V; REMEMBERED],
    /// Those of further rows: contacts may close in any number.
    #[cfg(feature = "std")]
    beyond: std::vec::Vec<f64>,
}

impl<V: Vector> OfRows<V> {
    fn new(zeros: &V) -> Self {
        Self {
            first: zeros.several_zeros_like(),
            #[cfg(feature = "std")]
            beyond: std::vec::Vec::new(),
        }
    }

    /// How many rows the vectors have room for, by the number of coordinates.
    #[inline(always)]
    fn coordinates(&self) -> usize {
        self.first[0].as_slice().len().max(1)
    }

    /// The number of a row; 0 for a row that is not remembered.
    #[inline(always)]
    fn get(&self, k: usize) -> f64 {
        let n = self.coordinates();
        if let Some(column) = self.first.get(k / n) {
            return column.as_slice().get(k % n).copied().unwrap_or_default();
        }
        #[cfg(feature = "std")]
        return (self.beyond.get(k - REMEMBERED * n).copied()).unwrap_or_default();
        #[cfg(not(feature = "std"))]
        0.0
    }

    /// Replaces the number of a row that is remembered.
    fn set(&mut self, k: usize, to: f64) {
        let n = self.coordinates();
        let known = match self.first.get_mut(k / n) {
            Some(column) => column.as_mut_slice().get_mut(k % n),
            #[cfg(feature = "std")]
            None => self.beyond.get_mut(k - REMEMBERED * n),
            #[cfg(not(feature = "std"))]
            None => None,
        };
        if let Some(known) = known {
            *known = to;
        }
    }

    /// Makes the number of a row at least as great as this, if that is finite and the row is remembered.
    #[inline(always)]
    fn raise(&mut self, k: usize, to: f64) {
        let n = self.coordinates();
        let known = match self.first.get_mut(k / n) {
            Some(column) => column.as_mut_slice().get_mut(k % n),
            #[cfg(feature = "std")]
            None => {
                let place = k - REMEMBERED * n;
                if self.beyond.len() <= place {
                    self.beyond.resize(place + 1, 0.0);
                }
                self.beyond.get_mut(place)
            }
            #[cfg(not(feature = "std"))]
            None => None,
        };
        if let Some(known) = known
            && to.is_finite()
        {
            *known = known.max(to);
        }
    }
}

/// Weight of the inertial scale, such that the bound of the residuals is some round-offs of it.
pub(super) const OF_INERTIA: f64 = ROUNDOFF / REDUCTION_THRESHOLD;

/// The largest values and terms seen during a run.
#[derive(Clone, Debug)]
pub(crate) struct Scales<V> {
    /// The largest `|qⱼ|` and `|vⱼ|` so far.
    pub sizes: [V; 2],
    /// 1 for a coordinate that is an angle, else 0.
    angles: V,
    /// For each row the largest sum of terms so far, of positions and of rates.
    terms: [OfRows<V>; 2],
    /// For each row, the change of its terms over the sizes of the coordinates, at the start.
    curvatures: OfRows<V>,
    /// `Mⱼⱼ`, and its reciprocal; 0 for both of a coordinate without inertia.
    inertia: [V; 2],
    /// The observed round-off of positions and rates, as a length in the metric of inertia, relative to the round-off unit.
    observed_roundoff: [f64; 2],
}

/// What a residual of a row is relative to.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowScale {
    /// The size of the present terms.
    pub now: f64,
    /// That of the largest terms so far.
    pub guaranteed: f64,
}

/// A row's residual, of positions or rates, relative to its scale.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relative {
    /// Relative to the present terms; Newton's method reduces this.
    pub now: f64,
    /// Relative to the largest terms so far; this is what the bound guarantees.
    pub guaranteed: f64,
}

impl<V: Vector> Scales<V> {
    /// The size of an angle is at least 1. At the start the size of a coordinate is at least that of any other
    /// with the same unit.
    pub fn new<S: System<Vector = V>>(system: &S, q: &V, v: &V) -> Self {
        let zeros = q.zeros_like();
        let mut sizes = [zeros.clone(), zeros.clone()];
        let mut angles = zeros.clone();
        for (j, coordinate) in system.coordinates().enumerate() {
            for (size, of) in sizes.iter_mut().zip([q, v]) {
                let of_same_unit = system.coordinates().zip(of.as_slice());
                let of_same_unit = of_same_unit.filter(|(other, _)| other.unit == coordinate.unit);
                size.as_mut_slice()[j] = of_same_unit.fold(0.0, |size, (_, x)| x.abs().max(size));
            }
            if coordinate.unit == "rad" {
                let size = &mut sizes[0].as_mut_slice()[j];
                *size = size.max(1.0);
                angles.as_mut_slice()[j] = 1.0;
            }
        }
        Self {
            sizes,
            angles,
            terms: [OfRows::new(&zeros), OfRows::new(&zeros)],
            curvatures: OfRows::new(&zeros),
            inertia: [zeros.clone(), zeros.clone()],
            observed_roundoff: [0.0; 2],
        }
    }

    /// Records a state.
    pub fn accept(&mut self, q: &V, v: &V) {
        for (size, of) in self.sizes.iter_mut().zip([q, v]) {
            for (size, x) in size.as_mut_slice().iter_mut().zip(of.as_slice()) {
                *size = size.max(x.abs());
            }
        }
    }

    /// Records the terms of a row at a state; `by_time` is `|∂gₖ/∂t|`.
    #[inline(always)]
    pub fn record_terms(&mut self, k: usize, row: &[f64], by_time: f64) {
        let (sizes_q, sizes_v) = (self.sizes[0].as_slice(), self.sizes[1].as_slice());
        let sum = |sizes: &[f64]| row.iter().zip(sizes).map(|(g, y)| g.abs() * y).sum::<f64>();
        let terms = [sum(sizes_q), sum(sizes_v) + by_time];
        for (greatest, now) in self.terms.iter_mut().zip(terms) {
            greatest.raise(k, now);
        }
    }

    /// Records the size of the terms of the rate of a row.
    #[cfg(feature = "std")]
    pub fn record_rate(&mut self, k: usize, rate: f64) {
        self.terms[1].raise(k, rate);
    }

    /// Records how the terms of a row bend.
    pub fn record_curvature(&mut self, k: usize, curvature: f64) {
        self.curvatures.raise(k, curvature);
    }

    /// Replaces how the terms of a row bend by what they become where it has bent, `there`, if that is less than this share of it.
    pub fn limit_curvature(&mut self, k: usize, there: f64, share: f64) {
        if there < share * self.curvatures.get(k) {
            self.curvatures.set(k, there);
        }
    }

    /// The displacement with index `part`, of the size of the coordinates (1 rad for angles), in a direction
    /// that no symmetry of a machine has.
    pub fn displacement(&self, part: u32, q: &mut V) {
        let ratio = 0.618_033_988_749_894_9;
        let of_same_unit = self.angles.as_slice().iter().zip(self.sizes[0].as_slice());
        for (j, (q, (is_angle, size))) in q.as_mut_slice().iter_mut().zip(of_same_unit).enumerate()
        {
            let turns = ratio * (j as f64 + 1.0) * f64::from(2 * part + 1);
            let within = turns - turns as u64 as f64;
            *q = (if *is_angle > 0.0 { 1.0 } else { *size }) * (0.5 + within);
        }
    }

    /// The largest rate, in sizes of the coordinates per second; the size of an angle is 1 rad however far
    /// it has turned.
    pub fn rate(&self, v: &V) -> f64 {
        let of_same_unit = self.angles.as_slice().iter().zip(self.sizes[0].as_slice());
        let sizes = of_same_unit.map(|(is_angle, size)| if *is_angle > 0.0 { 1.0 } else { *size });
        let rates = v.as_slice().iter().zip(sizes);
        let rates = rates.filter(|(_, size)| *size > 0.0);
        rates.map(|(v, size)| v.abs() / size).fold(0.0, f64::max)
    }

    /// The size of a row's terms in a pose, and the largest.
    #[inline(always)]
    pub fn sizes_of_terms(&self, k: usize, row: &[f64], q: &V) -> [f64; 2] {
        let now = self.sum(row, q, 0);
        [now, self.greatest_terms(k, now)]
    }

    /// The largest size of a row's terms, which now is this.
    #[inline(always)]
    pub fn greatest_terms(&self, k: usize, now: f64) -> f64 {
        larger(now, larger(self.terms[0].get(k), self.curvatures.get(k)))
    }

    /// Writes the largest coordinates and rates so far, those of a state included.
    #[inline(always)]
    pub fn write_sizes(&self, state: [&V; 2], to: &mut [&mut [f64]; 2]) {
        for ((to, sizes), y) in to.iter_mut().zip(&self.sizes).zip(state) {
            let known = sizes.as_slice().iter().zip(y.as_slice());
            for (to, (size, y)) in to.iter_mut().zip(known) {
                *to = larger(*size, y.abs());
            }
        }
    }

    /// [`roundoff_of_rates`](Self::roundoff_of_rates) for [these sizes](Self::write_sizes) of rates.
    #[inline(always)]
    pub fn roundoff_of_sizes(&self, of_rates: &[f64]) -> f64 {
        let by = self.inertia[0].as_slice().iter().zip(of_rates);
        let squares = by.map(|(inertia, size)| inertia * size * size);
        self.observed_roundoff[1] + sqrt(squares.sum())
    }

    /// [`of_positions`](Self::of_positions) for the sum of the terms of the row now.
    #[inline(always)]
    pub fn of_position_terms(&self, k: usize, row: &[f64], now: f64) -> RowScale {
        self.scale((k, 0), row, now, self.observed_roundoff[0])
    }

    /// [`of_rates`](Self::of_rates) for the sum of the terms of the row now, that of explicit time included.
    #[inline(always)]
    pub fn of_rate_terms(&self, k: usize, row: &[f64], now: f64, inertial: f64) -> RowScale {
        self.scale((k, 1), row, now, inertial)
    }

    /// The size of a row's terms in a pose relative to the largest: where it is small, the row is weak.
    pub fn strength(&self, k: usize, row: &[f64], q: &V) -> f64 {
        let [now, greatest] = self.sizes_of_terms(k, row, q);
        if greatest > 0.0 { now / greatest } else { 1.0 }
    }

    #[inline(always)]
    fn sum(&self, row: &[f64], y: &V, level: usize) -> f64 {
        let sizes = self.sizes[level].as_slice().iter().zip(y.as_slice());
        let terms = row.iter().zip(sizes);
        terms
            .map(|(g, (size, y))| g.abs() * larger(*size, y.abs()))
            .sum()
    }

    /// Records the metric from its factor `L`.
    pub fn record_metric(&mut self, l: &[f64]) {
        let n = root(l.len());
        let [inertias, yields] = &mut self.inertia;
        let both = inertias
            .as_mut_slice()
            .iter_mut()
            .zip(yields.as_mut_slice());
        for (j, (inertia, yields)) in both.enumerate() {
            *inertia = l[j * n..][..=j].iter().map(|x| x * x).sum();
            *yields = if *inertia > 0.0 { 1.0 / *inertia } else { 0.0 };
        }
    }

    /// Records the diagonal of the metric.
    #[inline(always)]
    pub fn record_inertias(&mut self, diagonal: &[f64]) {
        let [inertias, yields] = &mut self.inertia;
        let both = inertias
            .as_mut_slice()
            .iter_mut()
            .zip(yields.as_mut_slice());
        for ((inertia, yields), of_metric) in both.zip(diagonal) {
            *inertia = *of_metric;
            *yields = if *inertia > 0.0 { 1.0 / *inertia } else { 0.0 };
        }
    }

    /// `√Σⱼ Gₖⱼ²/Mⱼⱼ`.
    #[inline(always)]
    fn length(&self, row: &[f64]) -> f64 {
        let by = row.iter().zip(self.inertia[1].as_slice());
        sqrt(by.map(|(g, yields)| g * g * yields).sum())
    }

    /// `√Σⱼ Mⱼⱼ vⱼ²` with the largest rates so far.
    #[inline(always)]
    fn speed(&self, v: &V) -> f64 {
        let by = (self.inertia[0].as_slice().iter()).zip(self.sizes[1].as_slice());
        let by = by.zip(v.as_slice());
        let squares = by.map(|((inertia, size), v)| {
            let most = larger(*size, v.abs());
            inertia * most * most
        });
        sqrt(squares.sum())
    }

    /// The residuals of a row, of positions and rates, relative to their scales.
    pub fn relative(&self, k: usize, row: &[f64], left: [f64; 2], q: &V, v: &V) -> [Relative; 2] {
        [
            self.relative_of_positions(k, row, left[0], q),
            self.relative_of_rates(k, row, left[1], v),
        ]
    }

    /// The round-off of rates as a length in the metric of inertia, relative to the round-off unit: the same for all rows.
    #[inline(always)]
    pub fn roundoff_of_rates(&self, v: &V) -> f64 {
        self.observed_roundoff[1] + self.speed(v)
    }

    /// The residual of the positions of a row, relative to its scale.
    #[inline(always)]
    pub fn relative_of_positions(&self, k: usize, row: &[f64], left: f64, q: &V) -> Relative {
        self.of_positions(k, row, q).of(left)
    }

    /// The residual of the rates of a row, relative to its scale.
    #[inline(always)]
    pub fn relative_of_rates(&self, k: usize, row: &[f64], left: f64, v: &V) -> Relative {
        let at = (v, self.roundoff_of_rates(v));
        self.of_rates(k, row, left, at).of(left)
    }

    /// What the residual of the positions of a row is relative to.
    #[inline(always)]
    pub fn of_positions(&self, k: usize, row: &[f64], q: &V) -> RowScale {
        self.of_position_terms(k, row, self.sum(row, q, 0))
    }

    /// What the residual of the rates of a row, `left`, is relative to, for this [round-off](Self::roundoff_of_rates) of the rates.
    #[inline(always)]
    pub fn of_rates(&self, k: usize, row: &[f64], left: f64, (v, inertial): (&V, f64)) -> RowScale {
        let by_rates: f64 = row.iter().zip(v.as_slice()).map(|(g, v)| g * v).sum();
        let rates = self.sum(row, v, 1) + (left - by_rates).abs();
        self.of_rate_terms(k, row, rates, inertial)
    }

    /// The sum of the terms of a row now, and the largest so far, each with the round-off in the metric of inertia.
    #[inline(always)]
    fn scale(&self, (k, level): (usize, usize), row: &[f64], now: f64, inertial: f64) -> RowScale {
        let greatest = larger(now, self.terms[level].get(k));
        let floor = if inertial == 0.0 {
            0.0
        } else {
            // Relative to the largest size of the row.
            let reach = if now > 0.0 { greatest / now } else { 1.0 };
            self.length(row) * OF_INERTIA * reach * inertial
        };
        RowScale {
            now: now + floor,
            guaranteed: greatest + floor,
        }
    }

    /// Records the observed round-off of a row.
    pub fn record_rounding(&mut self, level: usize, row: &[f64], left: f64) {
        let length = self.length(row);
        if length > 0.0 && left.is_finite() {
            let observed_roundoff = left.abs() / (length * ROUNDOFF);
            self.observed_roundoff[level] = self.observed_roundoff[level].max(observed_roundoff);
        }
    }

    /// Takes the velocities by explicit time into account as terms that may cancel each other. Returns whether their round-off was
    /// unknown.
    pub fn record_drive<S: System<Vector = V>>(&mut self, system: &S, t: f64, q: &V) -> bool {
        let energy = system.kinetic_energy(t, q, &q.zeros_like());
        let speed = sqrt(2.0 * energy);
        // Not so for NaN, of a system that gives no energy.
        let is_new = speed > self.observed_roundoff[1] && speed.is_finite();
        if is_new {
            self.observed_roundoff[1] = speed;
        }
        is_new
    }

    /// Whether a move is within the bound of residuals, relative to the numbers that it moves.
    pub fn is_roundoff(&self, level: usize, by: &[f64], y: &V) -> bool {
        let sizes = self.sizes[level].as_slice();
        let mut of = by.iter().zip(sizes).zip(y.as_slice());
        of.all(|((by, size), y)| by.abs() <= RESIDUAL * size.max(y.abs()))
    }

    /// The relative change of the residuals of positions and rates by rounding alone. The rows that map rates
    /// turn by the round-off of angles.
    #[inline(always)]
    pub fn roundoff(&self) -> [f64; 2] {
        let angles = self.angles.as_slice().iter().zip(self.sizes[0].as_slice());
        let greatest = angles.fold(1.0_f64, |most, (is_angle, size)| most.max(is_angle * size));
        [ROUNDOFF, ROUNDOFF * greatest]
    }
}

impl RowScale {
    /// A residual relative to it.
    #[inline(always)]
    fn of(self, left: f64) -> Relative {
        Relative {
            now: share(left, self.now),
            guaranteed: share(left, self.guaranteed),
        }
    }
}
