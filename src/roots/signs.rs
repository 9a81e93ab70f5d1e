//! The number of sign changes of a function within a step, from eight of its values.

use super::greatest_magnitude;

/// Fractions of a step at which [`sign_changes`] takes its values: the Chebyshev nodes of degree 4, in order of time, and three places
/// beside nodes, which test the slopes there.
pub(crate) const FRACTIONS: [f64; 8] = [
    0.0,
    0.5 - 0.5 * core::f64::consts::FRAC_1_SQRT_2,
    0.5,
    0.5 + 0.5 * core::f64::consts::FRAC_1_SQRT_2,
    1.0,
    PROBE_DISTANCE,
    0.5 + PROBE_DISTANCE,
    1.0 - PROBE_DISTANCE,
];

/// Distance of those three places from their nodes, as a fraction of the step.
pub(super) const PROBE_DISTANCE: f64 = 0.01;

/// Allowance for rounding when values beside the nodes are compared with the interpolant, relative to the largest value. A function
/// that varies by less than this fraction of its size has no root.
pub(super) const ROUNDING_OF_VALUES: f64 = 1e-6;

/// Safety factor on the estimated truncation error of the interpolant of degree 4,
/// which also covers the error of the quintic along which the values are taken.
///
/// A motion of frequency `ω` has the coefficients `2 Jₖ(z)` with `z = ωh/2`, which fall by `z/10` or faster after the last one. The error of its
/// quintic through the ends of a step is `(ωh)⁶/46 080`, which is `(ωh)²/15` times the last one. So the factor suffices for `ωh ≤ 10`, and
/// steps of explicit methods are shorter than that.
const TRUNCATION_FACTOR: f64 = 8.0;

/// At least this fraction of the last but one coefficient counts, since the last may be 0 by chance.
const LEAST_SHARE_OF_PREVIOUS: f64 = 1.0 / 16.0;

/// Bound on the derivative of the truncated terms, as a multiple of the bound on the terms. The derivative is at most `Σ k² |cₖ|`, for a motion with
/// `ωh = 10` 40 times the last coefficient, which is five times [`TRUNCATION_FACTOR`] times that coefficient.
const DERIVATIVE_FACTOR: f64 = 5.5;

/// How many times a step is bisected in which the interpolant of degree 4 is neither far from zero nor monotone.
const MOST_BISECTIONS: u32 = 5;

/// Counts the sign changes of a function within a step from its values at the [`FRACTIONS`], taken along the motion or along the quintic through
/// both ends of the step. Returns `None` if they do not decide it, because the function has an extreme too near to zero or is not as smooth
/// as a motion.
///
/// The interpolant of degree 4 and the decay of its coefficients bound the function. A function that
/// oscillates many times in the step can look smooth at the nodes (aliasing); that it also has the slopes
/// of the interpolant at the three places beside them happens in less than one step of ten thousand.
pub(crate) fn sign_changes(values: &[f64; FRACTIONS.len()]) -> Option<usize> {
    let [v0, v1, v2, v3, v4, ref beside @ ..] = *values;
    let (ends, odd_ends) = (0.5 * (v0 + v4), 0.5 * (v4 - v0));
    let (inner, odd_inner) = (v1 + v3, core::f64::consts::FRAC_1_SQRT_2 * (v3 - v1));
    // Coefficients in Chebyshev polynomials.
    let c0 = 0.25 * (ends + inner + v2);
    let c1 = 0.5 * (odd_ends + odd_inner);
    let c2 = 0.5 * (ends - v2);
    let c3 = 0.5 * (odd_ends - odd_inner);
    let c4 = 0.25 * (ends - inner + v2);
    let falls = c3.abs() / c1.abs();
    let of_third = match c3 {
        0.0 => 0.0,
        _ => c3.abs() * falls.clamp(LEAST_SHARE_OF_PREVIOUS, 1.0),
    };
    let beyond = TRUNCATION_FACTOR * of_third.max(c4.abs());
    // The coefficients of the interpolant in the monomial basis.
    let p = [
        c0 - c2 + c4,
        c1 - 3.0 * c3,
        2.0 * c2 - 8.0 * c4,
        4.0 * c3,
        8.0 * c4,
    ];
    let differs = DERIVATIVE_FACTOR * beyond * 2.0 * PROBE_DISTANCE
        + ROUNDING_OF_VALUES * greatest_magnitude(values);
    let is_followed = FRACTIONS[5..].iter().zip(beside).all(|(theta, value)| {
        let x = 2.0 * theta - 1.0;
        let expected = p.iter().rev().fold(0.0, |sum, p| sum * x + p);
        (value - expected).abs() <= differs
    });
    if !is_followed {
        return None;
    }
    let mut signs = Signs {
        latest: if v0 == 0.0 { 0.0 } else { v0.signum() },
        changes: 0,
    };
    if !signs.count_along_polynomial(&p, [0.0, 1.0], beyond, MOST_BISECTIONS) {
        return None;
    }
    signs.take(if v4 == 0.0 { 0.0 } else { v4.signum() });
    Some(signs.changes)
}

/// Signs of a function, collected in order of time.
struct Signs {
    latest: f64,
    changes: usize,
}

impl Signs {
    /// Adds a sign. The function changes its sign at most once between it and the one before.
    fn take(&mut self, sign: f64) {
        self.changes += usize::from(self.latest != 0.0 && self.latest != sign);
        self.latest = sign;
    }

    /// Follows a polynomial of degree 4 from `m − r` to `m + r`, each value of which may be wrong by `beyond`. Returns whether its signs are known:
    /// in a piece that is far from zero the sign is constant, and in adjacent monotone pieces it changes at most once.
    fn count_along_polynomial(
        &mut self,
        p: &[f64; 5],
        [m, r]: [f64; 2],
        beyond: f64,
        halvings: u32,
    ) -> bool {
        let [p0, p1, p2, p3, p4] = *p;
        let value = p0 + m * (p1 + m * (p2 + m * (p3 + m * p4)));
        let slope = r * (p1 + m * (2.0 * p2 + m * (3.0 * p3 + m * 4.0 * p4)));
        let second = (r * r * (p2 + m * (3.0 * p3 + m * 6.0 * p4))).abs();
        let third = (r * r * r * (p3 + m * 4.0 * p4)).abs();
        let fourth = (r * r * r * r * p4).abs();
        if value.abs() > slope.abs() + second + third + fourth + beyond {
            self.take(value.signum());
            return true;
        }
        let bends = 2.0 * second + 3.0 * third + 4.0 * fourth;
        if slope.abs() > bends + r * DERIVATIVE_FACTOR * beyond {
            return true;
        }
        let half = 0.5 * r;
        halvings > 0
            && self.count_along_polynomial(p, [m - half, half], beyond, halvings - 1)
            && self.count_along_polynomial(p, [m + half, half], beyond, halvings - 1)
    }
}

#[cfg(test)]
mod tests {
    use std::vec::Vec;

    use super::*;

    /// [`sign_changes`] of a function on the unit interval.
    fn counted_sign_changes(f: impl Fn(f64) -> f64) -> Option<usize> {
        sign_changes(&FRACTIONS.map(f))
    }

    #[test]
    fn eight_values_count_sign_changes() {
        assert_eq!(counted_sign_changes(|_| 1.0), Some(0));
        assert_eq!(counted_sign_changes(|x| 2.0 + x.cos()), Some(0));
        assert_eq!(counted_sign_changes(|x| x - 0.3), Some(1));
        assert_eq!(counted_sign_changes(|x| (2.0 * x - 1.0).sin()), Some(1));
        assert_eq!(counted_sign_changes(|x| (x - 0.3) * (x - 0.4)), Some(2));
        assert_eq!(counted_sign_changes(|x| x * (x - 0.4)), Some(1));
        // Only the sixth of these is decided.
        assert_eq!(counted_sign_changes(|x| (x - 0.3) * (x - 0.3 - 1e-9)), None);
        assert_eq!(counted_sign_changes(|x| (x - 0.3) * (x - 0.3) + 1e-9), None);
        assert_eq!(
            counted_sign_changes(|x| (x - 0.3) * (x - 0.3) + 1e-2),
            Some(0)
        );
        assert_eq!(
            counted_sign_changes(|x| if x < 0.7 { -1.0 } else { 1.0 }),
            None
        );
        assert_eq!(counted_sign_changes(|_| 0.0), None);
        assert_eq!(counted_sign_changes(|_| f64::NAN), None);
        assert_eq!(
            counted_sign_changes(|x| if x < 0.3 { 1.0 } else { f64::INFINITY }),
            None
        );
    }

    /// Sums of three sines of up to 5 rad a step and a level near one of their extremes, against dense samples. The quintic is wrong by up to a
    /// fiftieth, and yet the count is never less than the number of sign changes of the samples.
    #[test]
    fn eight_values_miss_no_root_of_random_motions() {
        let mut state = 0x2545_f491_4f6c_dd1d_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut count = 0;
        for case in 0..10_000 {
            let longest = 0.2 + 4.8 * random();
            let mut terms: [[f64; 3]; 3] =
                core::array::from_fn(|_| [random() - 0.5, longest * random(), 7.0 * random()]);
            for term in &mut terms[1 + case % 3..] {
                term[0] = 0.0;
            }
            let sum = |f: &dyn Fn(f64, f64, f64) -> f64| -> f64 {
                terms.iter().map(|[a, w, p]| f(*a, *w, *p)).sum()
            };
            let q = |x: f64| sum(&|a, w, p| a * (w * x + p).sin());
            let v = |x: f64| sum(&|a, w, p| a * w * (w * x + p).cos());
            let b = |x: f64| sum(&|a, w, p| -a * w * w * (w * x + p).sin());
            let samples: Vec<f64> = (0..=400).map(|k| q(f64::from(k) / 400.0)).collect();
            let greatest = samples.iter().fold(f64::MIN, |most, x| most.max(*x));
            let below = [0.0, 1e-9, 1e-6, 1e-3, 0.1][case % 5] * random();
            let level = if case % 2 == 0 {
                greatest - below
            } else {
                q(random()) + below
            };
            let quintic = |x: f64| {
                let (ends, rates) = ([[q(0.0)], [q(1.0)]], [[v(0.0)], [v(1.0)]]);
                let bends = [[b(0.0)], [b(1.0)]];
                let found = crate::interpolant::hermite(
                    1.0,
                    [&ends[0], &ends[1]],
                    [&rates[0], &rates[1]],
                    [&bends[0], &bends[1]],
                    x,
                );
                found.0[0] - level
            };
            let Some(changes) = counted_sign_changes(quintic) else {
                continue;
            };
            let signs = samples
                .windows(2)
                .filter(|pair| (pair[0] - level) * (pair[1] - level) < 0.0);
            assert!(signs.count() <= changes, "{case}: {terms:?} {level}");
            count += 1;
        }
        // Most of them are decided.
        assert!(count > 7000, "{count}");
    }

    /// Fast oscillations through a level are hardly ever taken to be smooth: at most 3 of 30 000 with random frequencies and phases.
    #[test]
    fn fast_oscillations_are_not_taken_to_be_smooth() {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut deceived = 0;
        for _ in 0..30_000 {
            let (frequency, phase) = (20.0 * 50.0_f64.powf(random()), 7.0 * random());
            let level = 1.98 * (random() - 0.5);
            deceived += usize::from(
                counted_sign_changes(|x| (frequency * x + phase).cos() - level).is_some(),
            );
        }
        // With the values at the nodes alone there would be a thousand.
        assert!(deceived <= 3, "{deceived}");
    }
}
