//! One contact alone, with the forces of all others as they are.

use std::vec::Vec;

use super::super::lcp;
use super::{dot, norm};

/// Directions in which the friction of one contact is looked for first.
const DIRECTIONS: usize = 48;

/// The cosine and the sine of the angle between two of these.
const TURN: [f64; 2] = [0.991_444_861_373_810_4, 0.130_526_192_220_051_57];

/// The most estimates of a direction between two of these.
const MOST_ESTIMATES: usize = 60;

/// The most corrections of a direction by Newton's method, and the greatest correction, in rad.
const MOST_CORRECTIONS: usize = 10;
const GREATEST_CORRECTION: f64 = 0.5;

/// Directions of a contact of whose inertia elimination leaves less than this depend on each other.
const DEPENDENT: f64 = 1e-9;

/// The directions of one contact: rates without their forces, what these change, and what the forces are now.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Local {
    pub dimension: usize,
    pub w: [[f64; 3]; 3],
    pub q: [f64; 3],
    pub z: [f64; 3],
}

impl Local {
    /// The forces that solve the problem of a contact whose first direction is its normal.
    pub fn forces(&self, friction: f64, known_normal: f64) -> [f64; 3] {
        let Local { w, q, .. } = self;
        let m = self.dimension;
        if m == 1 {
            return [(-q[0] / w[0][0]).max(0.0), 0.0, 0.0];
        }
        if known_normal <= 0.0 {
            if q[0] >= 0.0 {
                return [0.0; 3];
            }
        } else {
            // The friction of what is beside the normal force acts even where the contact opens, and may open it.
            let rest = self.without_normal().on_disc(friction * known_normal);
            let found = [0.0, rest[0], rest[1]];
            if q[0] + dot(&w[0], &found) >= 0.0 {
                return found;
            }
        }
        // Nothing slips.
        let held = self.held();
        let most = friction * (held[0] + known_normal);
        if held[0] >= 0.0 && norm(&held[1..]) <= most {
            return held;
        }
        self.slipping(friction, known_normal).unwrap_or_else(|| {
            // None is found: a small step towards one.
            let towards = |k: usize| self.z[k] - 0.5 * (q[k] + dot(&w[k], &self.z));
            let normal = towards(0).max(0.0);
            let radius = friction * (normal + known_normal);
            let mut found = [normal, 0.0, 0.0];
            (1..m).for_each(|k| found[k] = towards(k));
            let length = norm(&found[1..]);
            if length > radius {
                let factor = radius / length;
                found[1..].iter_mut().for_each(|y| *y *= factor);
            }
            found
        })
    }

    /// The same tangents alone.
    fn without_normal(&self) -> Local {
        let moved = |x: [f64; 3]| [x[1], x[2], 0.0];
        Local {
            dimension: self.dimension - 1,
            w: [moved(self.w[1]), moved(self.w[2]), [0.0; 3]],
            q: moved(self.q),
            z: moved(self.z),
        }
    }

    /// The forces with which none of the directions moves.
    fn held(&self) -> [f64; 3] {
        let m = self.dimension;
        // The matrix is a symmetric one with rows that are multiplied, so that no rows need to be exchanged.
        let mut u = self.w;
        let mut held = self.q.map(|q| -q);
        let is_regular = (0..m).all(|k| {
            let (pivot, of_pivot) = (u[k], held[k]);
            for (row, right) in u[k + 1..m].iter_mut().zip(&mut held[k + 1..m]) {
                let factor = row[k] / pivot[k];
                for (x, above) in row.iter_mut().zip(pivot).skip(k + 1) {
                    *x -= factor * above;
                }
                *right -= factor * of_pivot;
            }
            pivot[k] > DEPENDENT * self.w[k][k]
        });
        if is_regular {
            held[m..].fill(0.0);
            for i in (0..m).rev() {
                let known = dot(&u[i][i + 1..m], &held[i + 1..m]);
                held[i] = (held[i] - known) / u[i][i];
            }
            return held;
        }
        let mut left: Vec<f64> = (0..m * m).map(|k| self.w[k / m][k % m]).collect();
        let (found, _) = lcp::solve(&mut left, &mut self.q.map(|q| -q)[..m]);
        held = [0.0; 3];
        held[..m].copy_from_slice(&found);
        held
    }

    /// The forces of a contact that slips: with `Λₜ = −r e` and `γₙ = 0` its slip is along the direction e. There may be several, of which the one in the direction
    /// of now is taken, or else the one with the least normal force.
    ///
    /// With `R = Λₙ + Λ₀` and `c = wₙₙ − μ wₙₜ·e > 0` the normal condition is `R c = wₙₙ Λ₀ − qₙ`, and c times the slip is an affine function of e.
    fn slipping(&self, friction: f64, known_normal: f64) -> Option<[f64; 3]> {
        let Local { w, q, .. } = self;
        let lift = q[0] - w[0][0] * known_normal;
        let side = [1, 2].map(|i| q[i] - w[i][0] * known_normal);
        let slip = AffineSlip {
            constant: [0, 1].map(|i| side[i] * w[0][0] - lift * w[i + 1][0]),
            linear: [0, 1].map(|i| {
                [0, 1].map(|j| friction * (lift * w[i + 1][j + 1] - side[i] * w[0][j + 1]))
            }),
        };
        let share = |e: [f64; 2]| w[0][0] - friction * (w[0][1] * e[0] + w[0][2] * e[1]);
        let forces = |e: [f64; 2]| {
            let own = share(e);
            let sum = -lift / own;
            let normal = sum - known_normal;
            (own > 0.0 && normal >= 0.0)
                .then(|| [normal, -friction * sum * e[0], -friction * sum * e[1]])
        };
        slip.along_itself(self.dimension - 1, [self.z[1], self.z[2]], true, forces)
    }

    /// Tangential forces of which is known how large they may be together.
    pub fn on_disc(&self, radius: f64) -> [f64; 3] {
        let held = self.held();
        if norm(&held) <= radius {
            return held;
        }
        let Local { w, q, .. } = self;
        let slip = AffineSlip {
            constant: [q[0], q[1]],
            linear: [0, 1].map(|i| [0, 1].map(|j| -radius * w[i][j])),
        };
        let forces = |e: [f64; 2]| Some([-radius * e[0], -radius * e[1], 0.0]);
        slip.along_itself(self.dimension, [self.z[0], self.z[1]], false, forces)
            .unwrap_or_else(|| {
                let length = norm(&held);
                held.map(|held| held * radius / length)
            })
    }
}

/// The slip of a contact, or a positive multiple of it, as a function of a direction: friction acts against that.
struct AffineSlip {
    constant: [f64; 2],
    linear: [[f64; 2]; 2],
}

impl AffineSlip {
    fn at(&self, e: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.constant[i] + self.linear[i][0] * e[0] + self.linear[i][1] * e[1])
    }

    /// How far the slip is to the left of the direction: 0 where it is along it, or against it.
    fn aside(&self, e: [f64; 2]) -> f64 {
        let slip = self.at(e);
        e[0] * slip[1] - e[1] * slip[0]
    }

    /// The forces, which may exclude a direction, where the slip is along the direction. Of several solutions it is that near the friction force of now, or else
    /// that with the least of the first force, if this `has_normal`.
    fn along_itself(
        &self,
        dimension: usize,
        now: [f64; 2],
        has_normal: bool,
        forces: impl Fn([f64; 2]) -> Option<[f64; 3]>,
    ) -> Option<[f64; 3]> {
        let is_along = |e: [f64; 2]| {
            let slip = self.at(e);
            e[0] * slip[0] + e[1] * slip[1] >= 0.0
        };
        if dimension == 1 {
            let along = |sign: f64| {
                let found = forces([sign, 0.0])?;
                is_along([sign, 0.0]).then_some(found)
            };
            return along(1.0).or_else(|| along(-1.0));
        }
        if let Some(e) = self.near(now).filter(|e| is_along(*e))
            && let Some(found) = forces(e)
        {
            return Some(found);
        }
        let mut best: Option<[f64; 3]> = None;
        let mut from = [1.0, 0.0];
        let mut before = self.aside(from);
        for _ in 0..DIRECTIONS {
            let to = [
                from[0] * TURN[0] - from[1] * TURN[1],
                from[0] * TURN[1] + from[1] * TURN[0],
            ];
            let after = self.aside(to);
            let (sector, [low, high]) = ([from, to], [before, after]);
            (from, before) = (to, after);
            if low != 0.0 && (low > 0.0) == (high > 0.0) {
                continue;
            }
            let e = zero_between(sector, [low, high], |e| self.aside(e));
            let Some(found) = forces(e).filter(|_| is_along(e)) else {
                continue;
            };
            let is_less = best.as_ref().is_none_or(|best| found[0] < best[0]);
            if !has_normal || is_less {
                best = Some(found);
            }
        }
        best
    }

    /// The direction of a friction force, corrected by Newton's method so that the slip is along it or against it; none if that fails.
    fn near(&self, force: [f64; 2]) -> Option<[f64; 2]> {
        let length = norm(&force);
        if length == 0.0 {
            return None;
        }
        let mut e = force.map(|x| -x / length);
        let [[a, b], [c, d]] = self.linear;
        for _ in 0..MOST_CORRECTIONS {
            let slip = self.at(e);
            let value = e[0] * slip[1] - e[1] * slip[0];
            // A turn to the left changes the direction by `(−e₁, e₀)`.
            let turned = [-e[1], e[0]];
            let change = [a * turned[0] + b * turned[1], c * turned[0] + d * turned[1]];
            let slope =
                turned[0] * slip[1] - turned[1] * slip[0] + e[0] * change[1] - e[1] * change[0];
            let angle = -value / slope;
            if angle.is_nan() || angle.abs() > GREATEST_CORRECTION {
                return None;
            }
            e = [e[0] + angle * turned[0], e[1] + angle * turned[1]];
            let length = norm(&e);
            e = e.map(|x| x / length);
            if angle.abs() <= 4.0 * f64::EPSILON {
                return Some(e);
            }
        }
        None
    }
}

/// The direction between two, at which a function has these values of different signs, where it is 0. By the regula falsi, in which the value at an end that
/// stays twice is halved (M. Dowell, P. Jarratt, BIT 11 (1971) 168–174), to rounding: what is found is the start of Newton's method, or a contact alone.
fn zero_between(
    ends: [[f64; 2]; 2],
    [mut low, mut high]: [f64; 2],
    function: impl Fn([f64; 2]) -> f64,
) -> [f64; 2] {
    let [from, to] = ends;
    let direction = |part: f64| {
        let e = [0, 1].map(|i| (1.0 - part) * from[i] + part * to[i]);
        let length = (e[0] * e[0] + e[1] * e[1]).sqrt();
        e.map(|e| e / length)
    };
    if low == 0.0 {
        return from;
    }
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    let mut found = 0.5;
    let mut replaced_first = None;
    for _ in 0..MOST_ESTIMATES {
        let estimate = first + (last - first) * (low / (low - high));
        let estimate = if estimate > first && estimate < last {
            estimate
        } else {
            0.5 * (first + last)
        };
        let moved = (estimate - found).abs();
        found = estimate;
        let value = function(direction(found));
        if value == 0.0 || moved <= f64::EPSILON || last - first <= f64::EPSILON {
            break;
        }
        let is_first = (value > 0.0) == (low > 0.0);
        if is_first {
            (first, low) = (found, value);
        } else {
            (last, high) = (found, value);
        }
        if replaced_first == Some(is_first) {
            let kept = if is_first { &mut high } else { &mut low };
            *kept *= 0.5;
        }
        replaced_first = Some(is_first);
    }
    direction(found)
}
