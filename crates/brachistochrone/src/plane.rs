//! The plane problem in closed form: Ashby's particle on a rough wire, to which every machine with two
//! coordinates is equivalent.
//!
//! N. Ashby, W. E. Brittin, W. F. Love, W. Wyss, *Brachistochrone with Coulomb friction*, Am. J. Phys. 43 (1975) 902;
//! this form avoids cancellation.
//!
//! Let x be the angle of the motion from the steepest descent R, so that `V̇ = R cos x − κ V ẋ`. With the angle
//! `u = x − x₀` from the first direction, `tan x₀ = κ`, and δ its last value, every extremal is
//!
//! ```text
//! V     = S sin u / (1 − κ p)                        p = 2 sin u sin(δ − u) / sin δ
//! dt/du = S (1 + κ p) / (R cos x₀ (1 − κ p)²)
//! λ     = sin(δ − u) / (R cos x₀ sin δ (1 − κ p))
//! ```
//!
//! with a scale S. All are positive as long as |κ| p < 1, that is |κ| tan(δ/2) < 1. At κ = 0 this is the cycloid.
//! Angles are counted such that δ > 0; for a turn to the other side, κ has the other sign.

use std::f64::consts::{FRAC_PI_2, PI};

use super::quadrature::Gauss;

/// A turn below this counts as none: sin u = u, and squares of it do not underflow.
const STRAIGHT: f64 = 1e-120;

/// How close to the greatest turn extremals are searched for, relative to it. For κ > 0 the speed has a pole there, and
/// in the last 1e-9 of the turn the direction of the end determines it to no more than half of the digits.
const NEAREST: f64 = 1e-9;

/// One extremal, up to its scale.
#[derive(Clone, Debug)]
pub struct Arc {
    kappa: f64,
    delta: f64,
    gauss: Gauss,
    /// `∫ (V dt/du cos u, V dt/du sin u, dt/du) du` from 0 to the end of each stretch, in units of `S²/(R cos x₀)`
    /// and `S/(R cos x₀)`.
    stretches: Vec<(f64, [f64; 3])>,
}

/// The error that the end lies outside the directions that extremals reach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfReach {
    /// The greatest angle between the first direction and the end, in rad.
    pub reach: f64,
}

impl Arc {
    /// The extremal to an end at `angle ≥ 0` from the first direction.
    ///
    /// The angle grows with δ, so there is at most one extremal.
    ///
    /// # Errors
    /// If the angle is not below the greatest one. For κ = 0 the greatest angle itself is reached, by a whole arch.
    pub fn to(angle: f64, kappa: f64) -> Result<Arc, OutOfReach> {
        let gauss = Gauss::new();
        if angle <= STRAIGHT {
            return Ok(Arc::new(gauss, kappa, STRAIGHT));
        }
        let widest = PI - 2.0 * kappa.abs().atan();
        if kappa == 0.0 && (angle - FRAC_PI_2).abs() <= 4.0 * f64::EPSILON {
            return Ok(Arc::new(gauss, kappa, PI));
        }
        let polar_angle = |delta: f64| {
            let [ahead, aside, _] = gauss.integrate(&|u| integrands(kappa, delta, u), 0.0, delta);
            aside.atan2(ahead)
        };
        // The angle of the end is a mean of directions, and so less than the last one.
        let (mut low, mut high) = (angle, widest * (1.0 - NEAREST));
        let reach = if kappa >= 0.0 {
            FRAC_PI_2 - kappa.atan()
        } else {
            polar_angle(high)
        };
        if angle.is_nan() || angle >= reach || low >= high {
            return Err(OutOfReach { reach });
        }
        let (mut below, mut above) = (polar_angle(low) - angle, polar_angle(high) - angle);
        if above < 0.0 {
            return Err(OutOfReach { reach });
        }
        // The Illinois method, G. Dahlquist and Å. Björck, *Numerical Methods* (1974), ch. 6, with bisection
        // where it stalls.
        for step in 0..200 {
            if below == 0.0 || high - low <= 2.0 * f64::EPSILON * high {
                break;
            }
            let between = match step % 5 {
                4 => low + (high - low) / 2.0,
                _ => low - below * (high - low) / (above - below),
            };
            let at = between.clamp(low, high);
            let value = polar_angle(at) - angle;
            if value < 0.0 {
                (low, below) = (at, value);
                above /= 2.0;
            } else {
                (high, above) = (at, value);
                below /= 2.0;
            }
            if value == 0.0 {
                low = at;
                break;
            }
        }
        Ok(Arc::new(gauss, kappa, low))
    }

    fn new(gauss: Gauss, kappa: f64, delta: f64) -> Arc {
        let stretches = gauss.stretches(&|u| integrands(kappa, delta, u), 0.0, delta);
        Arc {
            kappa,
            delta,
            gauss,
            stretches,
        }
    }

    /// The total turn of the direction, in rad.
    pub fn turn(&self) -> f64 {
        self.delta
    }

    /// Whether this is a whole arch of a cycloid, which comes to rest at the end and has infinite multipliers.
    pub fn is_arch(&self) -> bool {
        self.delta >= PI
    }

    /// `V/S` and its derivative by u.
    pub fn speed(&self, u: f64) -> (f64, f64) {
        let (sin, cos) = u.sin_cos();
        let [left, _] = self.factors(u);
        // `p′ = 2 sin(δ − 2u)/sin δ`, which is infinite for a whole arch and not needed without friction.
        let steeper = if self.kappa == 0.0 {
            0.0
        } else {
            2.0 * self.kappa * (self.delta - 2.0 * u).sin() / self.delta.sin()
        };
        (sin / left, (cos * left + steeper * sin) / (left * left))
    }

    /// `dt/du` in units of `S/(R cos x₀)`.
    pub fn slowness(&self, u: f64) -> f64 {
        {
            let [minus, plus] = self.factors(u);
            plus / (minus * minus)
        }
    }

    /// λ in units of `1/(R cos x₀)`.
    pub fn multiplier(&self, u: f64) -> f64 {
        if self.is_arch() {
            return f64::INFINITY;
        }
        let [left, _] = self.factors(u);
        (self.delta - u).sin() / (self.delta.sin() * left)
    }

    /// The displacement so far, along the first direction and across it, in units of `S²/(R cos x₀)`, and the time
    /// so far, in units of `S/(R cos x₀)`.
    pub fn so_far(&self, u: f64) -> [f64; 3] {
        let after = self.stretches.partition_point(|(end, _)| *end <= u);
        let (from, before) = self.stretches[after.saturating_sub(1)];
        if from == u {
            return before;
        }
        let more = self
            .gauss
            .stretch(&|u| integrands(self.kappa, self.delta, u), from, u);
        core::array::from_fn(|k| before[k] + more[k])
    }

    /// Displacement and time of the whole arc.
    pub fn whole(&self) -> [f64; 3] {
        self.stretches[self.stretches.len() - 1].1
    }

    /// The turn at a fraction of the total time: the inverse of the time so far.
    pub fn turned_after(&self, part: f64) -> f64 {
        let time = part.clamp(0.0, 1.0) * self.whole()[2];
        let after = self
            .stretches
            .partition_point(|(_, so_far)| so_far[2] <= time);
        if after == self.stretches.len() {
            return self.delta;
        }
        let (mut low, mut high) = (
            self.stretches[after.saturating_sub(1)].0,
            self.stretches[after].0,
        );
        let mut u = low + (high - low) / 2.0;
        // Newton's method on a smooth, increasing function, with bisection where it leaves the bracket.
        for _ in 0..100 {
            let ahead = self.so_far(u)[2] - time;
            if ahead > 0.0 {
                high = u;
            } else {
                low = u;
            }
            let next = u - ahead / self.slowness(u);
            let next = if next > low && next < high {
                next
            } else {
                low + (high - low) / 2.0
            };
            let moved = (next - u).abs();
            u = next;
            if moved <= 2.0 * f64::EPSILON * self.delta {
                break;
            }
        }
        u
    }

    /// The range of sudden turns, between −π and π, that gain nothing at any moment: Weierstrass' condition, here
    /// equivalent to Pontryagin's. A jump of the direction by z leaves `V e^{κx}` unchanged; relative to the motion
    /// without a jump its value at u is
    ///
    /// ```text
    /// B(z) = [sin u cos(u + z − δ − x₀) e^{−κz} + sin(δ − u) cos(u + z + x₀) e^{κz}] / (sin δ cos x₀ (1 − κ p))
    /// ```
    ///
    /// with a gain where B > 1. At κ = 0, `B = cos z`. The turns are checked in steps of half a degree, at 33 moments.
    pub fn best_among_turns(&self) -> [f64; 2] {
        const STEPS: u32 = 360;
        const MOMENTS: u32 = 32;
        if self.kappa == 0.0 {
            return [-PI, PI];
        }
        let first = self.kappa.atan();
        let gains = |z: f64| {
            (0..=MOMENTS).any(|moment| {
                let u = self.delta * f64::from(moment) / f64::from(MOMENTS);
                let bound = self.delta.sin() * first.cos() * self.factors(u)[0];
                let end = u.sin() * (u + z - self.delta - first).cos() * (-self.kappa * z).exp();
                let now = (self.delta - u).sin() * (u + z + first).cos() * (self.kappa * z).exp();
                // About twenty operations have rounded.
                end + now > bound * (1.0 + 32.0 * f64::EPSILON)
            })
        };
        [-1.0, 1.0].map(|side| {
            let good = (1..=STEPS)
                .take_while(|step| !gains(side * PI * f64::from(*step) / f64::from(STEPS)));
            side * PI * good.count() as f64 / f64::from(STEPS)
        })
    }

    fn factors(&self, u: f64) -> [f64; 2] {
        factors(self.kappa, self.delta, u)
    }
}

/// `1 − κ p` and `1 + κ p`.
///
/// The one that may become small is a sum of two positive terms, with `w = π − 2 |x₀|`:
///
/// ```text
/// 1 − |κ| p = (2 sin(δ/2) sin((w − δ)/2) / cos x₀ + 2 |κ| sin²(δ/2 − u)) / sin δ
/// ```
fn factors(kappa: f64, delta: f64, u: f64) -> [f64; 2] {
    if kappa == 0.0 {
        return [1.0, 1.0]; // For a whole arch p is infinite.
    }
    let (size, first) = (kappa.abs(), kappa.abs().atan());
    let (sin, half) = (delta.sin(), delta / 2.0);
    let gap = (PI / 2.0 - first - half).sin();
    let small = 2.0 * (half.sin() * gap / first.cos() + size * (half - u).sin().powi(2)) / sin;
    let great = 1.0 + 2.0 * size * u.sin() * (delta - u).sin() / sin;
    if kappa > 0.0 {
        [small, great]
    } else {
        [great, small]
    }
}

/// `(V dt/du cos u, V dt/du sin u, dt/du)`.
fn integrands(kappa: f64, delta: f64, u: f64) -> [f64; 3] {
    let (sin, cos) = u.sin_cos();
    let [minus, plus] = factors(kappa, delta, u);
    let slowness = plus / (minus * minus);
    let distance = sin * slowness / minus;
    [distance * cos, distance * sin, slowness]
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRICTIONS: [f64; 11] = [
        -10.0, -3.0, -1.0, -0.5, -0.1, -0.01, 0.01, 0.1, 0.5, 1.0, 3.0,
    ];

    /// So `Arc::to` has one root, and there is no conjugate point at the start.
    #[test]
    fn the_angle_of_the_end_grows_with_the_turn() {
        for kappa in FRICTIONS {
            let widest = PI - 2.0 * kappa.abs().atan();
            let angles = (1..200).map(|step| {
                let [ahead, aside, _] =
                    Arc::new(Gauss::new(), kappa, widest * f64::from(step) / 200.0).whole();
                aside.atan2(ahead)
            });
            let angles: Vec<f64> = angles.collect();
            assert!(angles.is_sorted_by(|a, b| a < b), "κ = {kappa}: {angles:?}");
        }
    }

    /// Jacobi's condition: extremals to one end, whatever their state, do not intersect before it. Their family has
    /// three parameters, as many as the state (V e^{κu}, x, y); its Jacobian vanishes nowhere on the way.
    #[test]
    fn extremals_to_one_end_do_not_meet_before_it() {
        for kappa in FRICTIONS {
            let widest = PI - 2.0 * kappa.abs().atan();
            for part in [0.1, 0.3, 0.5, 0.7, 0.9, 0.97] {
                let delta = widest * part;
                // The remaining displacement, in the frame of the first direction, and V e^{κu}, with S = 1.
                let state = |delta: f64, u: f64| {
                    let arc = Arc::new(Gauss::new(), kappa, delta);
                    let (total, so_far) = (arc.whole(), arc.so_far(u));
                    let speed = arc.speed(u).0 * (kappa * u).exp();
                    [speed, total[0] - so_far[0], total[1] - so_far[1]]
                };
                let mut signs = Vec::new();
                for step in 1..20 {
                    let u = delta * f64::from(step) / 20.0;
                    let h = 1e-5 * delta.min(widest - delta);
                    let by = |plus: [f64; 3], minus: [f64; 3]| -> [f64; 3] {
                        core::array::from_fn(|k| (plus[k] - minus[k]) / (2.0 * h))
                    };
                    let a = by(state(delta, u + h), state(delta, u - h));
                    let b = by(state(delta + h, u), state(delta - h, u));
                    let [speed, ahead, aside] = state(delta, u);
                    let c = [speed, 2.0 * ahead, 2.0 * aside]; // by ln S
                    let det = a[0] * (b[1] * c[2] - b[2] * c[1])
                        - a[1] * (b[0] * c[2] - b[2] * c[0])
                        + a[2] * (b[0] * c[1] - b[1] * c[0]);
                    signs.push(det > 0.0);
                }
                assert!(
                    signs.iter().all(|sign| *sign == signs[0]),
                    "κ = {kappa}, δ = {delta}: {signs:?}"
                );
            }
        }
    }

    #[test]
    fn a_level_end_is_reached_by_a_whole_arch_without_friction_and_never_with_it() {
        let arch = Arc::to(FRAC_PI_2, 0.0).unwrap();
        assert_eq!(arch.turn(), PI);
        assert!(arch.speed(PI).0.abs() < 2.0 * f64::EPSILON);
        assert!(Arc::to(FRAC_PI_2 - 0.1_f64.atan(), 0.1).is_err());
    }
}
