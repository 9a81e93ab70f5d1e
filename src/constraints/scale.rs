//! By what residuals are measured.
//!
//! A residual is small if rounding alone could have made it. What rounding makes has three sources
//! (N. J. Higham, *Accuracy and Stability of Numerical Algorithms*, 2nd ed., sections 1.5 and 3.3), and
//! the scale of a row is the sum of what each allows:
//!
//! * The state is rounded: `Σⱼ |Gₖⱼ| |qⱼ|` and `Σⱼ |Gₖⱼ| |vⱼ| + |∂gₖ/∂t|`, with the greatest values in the
//!   run so far, since terms may vanish on the way.
//! * A rate is what accelerations add up to, and these come out of the mass matrix, which mixes all
//!   coordinates. So a rate that the constraints keep at 0 is as inexact as the others are, by inertia:
//!   `|Gₖ| |v|`, with `|v|² = Σ Mⱼⱼ vⱼ²` and `|Gₖ|² = Σ Gₖⱼ²/Mⱼⱼ`. By Cauchy and Schwarz this is never less
//!   than `Σⱼ |Gₖⱼ| |vⱼ|`, and it is 0 only where the machine is at rest.
//! * The constraint is evaluated from terms that the state knows nothing of (lengths in parameters that
//!   cancel each other). That is not known beforehand: it is measured, where Newton's method stands.

use super::algebra::{root, share};
use super::{RESIDUAL, ROUNDOFF, WORKED_OFF};
use crate::math::sqrt;
use crate::{System, Vector};

/// Of how many rows the greatest terms are remembered, for each coordinate.
const REMEMBERED: usize = 4;

/// How much of the inertial scale counts: so much that what is worked off is some roundoffs of it.
pub(super) const OF_INERTIA: f64 = ROUNDOFF / WORKED_OFF;

/// What the run has seen of sizes.
#[derive(Clone, Debug)]
pub(crate) struct Scales<V> {
    /// The greatest `|qⱼ|` and `|vⱼ|` so far.
    pub sizes: [V; 2],
    /// 1 for a coordinate that is an angle, else 0.
    angles: V,
    /// For each row the greatest sum of terms so far, of positions and of rates.
    terms: [[V; REMEMBERED]; 2],
    /// For each row, by how much its terms would change with the coordinates' sizes, at the start.
    bends: [V; REMEMBERED],
    /// `√Mⱼⱼ`.
    inertia: V,
    /// What rounding was seen to leave of positions and rates, as a length in the metric of inertia,
    /// relative to the roundoff.
    grain: [f64; 2],
}

/// A row's residual, of positions or rates, relative to sizes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relative {
    /// To the terms as they are now: what is worked on.
    pub now: f64,
    /// To the greatest that they have been: what is promised.
    pub promised: f64,
}

impl<V: Vector> Scales<V> {
    /// A coordinate's size is at least 1 if it is an angle, and at the start at least that of any
    /// other of its unit.
    pub fn new<S: System<Vector = V>>(system: &S, q: &V, v: &V) -> Self {
        let zeros = q.zeros_like();
        let mut sizes = [zeros.clone(), zeros.clone()];
        let mut angles = zeros.clone();
        for (j, coordinate) in system.coordinates().enumerate() {
            for (size, of) in sizes.iter_mut().zip([q, v]) {
                let alike = system.coordinates().zip(of.as_slice());
                let alike = alike.filter(|(other, _)| other.unit == coordinate.unit);
                size.as_mut_slice()[j] = alike.fold(0.0, |size, (_, x)| x.abs().max(size));
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
            terms: [zeros.several_zeros_like(), zeros.several_zeros_like()],
            bends: zeros.several_zeros_like(),
            inertia: zeros.clone(),
            grain: [0.0; 2],
        }
    }

    /// Takes note of a state.
    pub fn accept(&mut self, q: &V, v: &V) {
        for (size, of) in self.sizes.iter_mut().zip([q, v]) {
            for (size, x) in size.as_mut_slice().iter_mut().zip(of.as_slice()) {
                *size = size.max(x.abs());
            }
        }
    }

    /// Takes note of the terms of a row at a state, `by_time` being `|∂gₖ/∂t|`.
    pub fn note_terms(&mut self, k: usize, row: &[f64], by_time: f64) {
        let (sizes_q, sizes_v) = (self.sizes[0].as_slice(), self.sizes[1].as_slice());
        let sum = |sizes: &[f64]| row.iter().zip(sizes).map(|(g, y)| g.abs() * y).sum::<f64>();
        let terms = [sum(sizes_q), sum(sizes_v) + by_time];
        for (greatest, now) in self.terms.iter_mut().zip(terms) {
            if let Some(greatest) = slot_mut(greatest, k)
                && now > *greatest
                && now.is_finite()
            {
                *greatest = now;
            }
        }
    }

    /// Takes note of how the terms of a row bend.
    pub fn note_bend(&mut self, k: usize, bend: f64) {
        if let Some(known) = slot_mut(&mut self.bends, k)
            && bend.is_finite()
        {
            *known = known.max(bend);
        }
    }

    /// The `part`th of some displacements, of the size of the coordinates, an angle's being 1 rad: in
    /// directions that no symmetry of a machine has.
    pub fn displacement(&self, part: u32, q: &mut V) {
        let ratio = 0.618_033_988_749_894_9;
        let alike = self.angles.as_slice().iter().zip(self.sizes[0].as_slice());
        for (j, (q, (is_angle, size))) in q.as_mut_slice().iter_mut().zip(alike).enumerate() {
            let turns = ratio * (j as f64 + 1.0) * f64::from(2 * part + 1);
            let within = turns - turns as u64 as f64;
            *q = (if *is_angle > 0.0 { 1.0 } else { *size }) * (0.5 + within);
        }
    }

    /// The greatest rate, in coordinates' sizes per second, an angle's being 1 rad however often it has turned.
    pub fn rate(&self, v: &V) -> f64 {
        let alike = self.angles.as_slice().iter().zip(self.sizes[0].as_slice());
        let sizes = alike.map(|(is_angle, size)| if *is_angle > 0.0 { 1.0 } else { *size });
        let rates = v.as_slice().iter().zip(sizes);
        let rates = rates.filter(|(_, size)| *size > 0.0);
        rates.map(|(v, size)| v.abs() / size).fold(0.0, f64::max)
    }

    /// How much of its greatest terms a row has in a pose: where it is small, so is the hold of the row.
    pub fn strength(&self, k: usize, row: &[f64], q: &V) -> f64 {
        let now = self.sum(row, q, 0);
        let greatest = now.max(slot(&self.terms[0], k)).max(slot(&self.bends, k));
        if greatest > 0.0 { now / greatest } else { 1.0 }
    }

    fn sum(&self, row: &[f64], y: &V, level: usize) -> f64 {
        let sizes = self.sizes[level].as_slice().iter().zip(y.as_slice());
        let terms = row.iter().zip(sizes);
        terms
            .map(|(g, (size, y))| g.abs() * size.max(y.abs()))
            .sum()
    }

    /// Takes note of the metric from its factor `L`.
    pub fn note_metric(&mut self, l: &[f64]) {
        let n = root(l.len());
        for (j, inertia) in self.inertia.as_mut_slice().iter_mut().enumerate() {
            *inertia = sqrt(l[j * n..][..=j].iter().map(|x| x * x).sum());
        }
    }

    /// `√Σⱼ Gₖⱼ²/Mⱼⱼ`.
    fn length(&self, row: &[f64]) -> f64 {
        let by = row.iter().zip(self.inertia.as_slice());
        let by = by.filter(|(_, inertia)| **inertia > 0.0);
        sqrt(by.map(|(g, inertia)| (g / inertia) * (g / inertia)).sum())
    }

    /// `√Σⱼ Mⱼⱼ vⱼ²`, with the greatest rates so far.
    fn speed(&self, v: &V) -> f64 {
        let by = self.inertia.as_slice().iter().zip(self.sizes[1].as_slice());
        let by = by.zip(v.as_slice());
        let squares = by.map(|((inertia, size), v)| {
            let part = inertia * size.max(v.abs());
            part * part
        });
        sqrt(squares.sum())
    }

    /// The residuals of a row, of positions and rates, relative to their scales.
    pub fn relative(&self, k: usize, row: &[f64], left: [f64; 2], q: &V, v: &V) -> [Relative; 2] {
        let by_rates: f64 = row.iter().zip(v.as_slice()).map(|(g, v)| g * v).sum();
        let positions = self.sum(row, q, 0);
        let rates = self.sum(row, v, 1) + (left[1] - by_rates).abs();
        let within = self.length(row) * OF_INERTIA;
        let inertial = [self.grain[0], self.grain[1] + self.speed(v)];
        let of = |level: usize, now: f64| {
            let greatest = now.max(slot(&self.terms[level], k));
            // As long as the row has been.
            let reach = if now > 0.0 { greatest / now } else { 1.0 };
            let floor = within * reach * inertial[level];
            Relative {
                now: share(left[level], now + floor),
                promised: share(left[level], greatest + floor),
            }
        };
        [of(0, positions), of(1, rates)]
    }

    /// Takes note that rounding leaves as much of a row.
    pub fn note_grain(&mut self, level: usize, row: &[f64], left: f64) {
        let length = self.length(row);
        if length > 0.0 && left.is_finite() {
            let grain = left.abs() / (length * ROUNDOFF);
            self.grain[level] = self.grain[level].max(grain);
        }
    }

    /// Whether a move is no more than the residual anyway, relative to the numbers that it moves.
    pub fn is_roundoff(&self, level: usize, by: &[f64], y: &V) -> bool {
        let sizes = self.sizes[level].as_slice();
        let mut of = by.iter().zip(sizes).zip(y.as_slice());
        of.all(|((by, size), y)| by.abs() <= RESIDUAL * size.max(y.abs()))
    }

    /// What rounding alone may change in the residuals of positions and rates, relative to their scale.
    /// The rows that rates go through turn by as much as angles are rounded.
    pub fn roundoff(&self) -> [f64; 2] {
        let angles = self.angles.as_slice().iter().zip(self.sizes[0].as_slice());
        let greatest = angles.fold(1.0_f64, |most, (is_angle, size)| most.max(is_angle * size));
        [ROUNDOFF, ROUNDOFF * greatest]
    }
}

/// The number of a row, 0 for one that is not remembered.
fn slot<V: Vector>(of: &[V; REMEMBERED], k: usize) -> f64 {
    let n = of[0].as_slice().len().max(1);
    let column = of.get(k / n).map(V::as_slice).unwrap_or_default();
    column.get(k % n).copied().unwrap_or_default()
}

fn slot_mut<V: Vector>(of: &mut [V; REMEMBERED], k: usize) -> Option<&mut f64> {
    let n = of[0].as_slice().len().max(1);
    of.get_mut(k / n)?.as_mut_slice().get_mut(k % n)
}
