//! Isolates all roots of a smooth function within a step.
//!
//! A function of the state may vanish several times within a step. It is as smooth as the motion, so its Chebyshev interpolant
//! represents it to rounding, and the coefficients bound it: if `|c₀| > Σ |cⱼ|` there is no root, and if the same holds of the
//! derivative there is at most one. Where neither holds the interval is bisected. L. N. Trefethen, *Approximation Theory and
//! Approximation Practice*, 2013, ch. 3, 8 and 18. A body that turns uniformly takes long steps in which functions of its angle
//! oscillate many times: such a step is divided into parts that the interpolant resolves.
//!
//! For most steps of a Runge–Kutta method eight values along the quintic through the ends of the step suffice
//! ([`sign_changes`]); they cost no evaluation of the machine.

mod extent;
mod signs;

use std::vec::Vec;

use lagrangian_scalar::Scalar;

use crate::Error;
use signs::{PROBE_DISTANCE, ROUNDING_OF_VALUES};

pub use extent::extremes;
pub(crate) use signs::{FRACTIONS, sign_changes};

/// Degrees of the interpolants, tried in this order.
const DEGREES: [usize; 3] = [16, 32, 64];

/// Degree of the interpolant that only decides whether the function is far from zero.
const COARSE: usize = 8;

/// An interpolant resolves a function if its last coefficients are below this fraction of the largest.
const CONVERGED: f64 = 1e-12;

/// Rounding of the coefficients, relative to the largest.
const ROUNDING: f64 = 1e-14;

/// How many times an interval is bisected that no interpolant resolves. If there is a kink, all nodes are looked at in the end.
const HALVINGS: u32 = 2;

/// A function oscillates too fast for an interpolant if a coefficient in the upper half exceeds this fraction of the largest. For a
/// jump the fraction is a fortieth, for a kink it is smaller.
const OSCILLATES: f64 = 0.1;

/// How many times in total an interval is bisected because the function oscillates too fast.
const HALVINGS_OF_OSCILLATION: u32 = 14;

/// [`CONVERGED`] for such a function: a function of an angle of 10⁵ rad is only accurate to 10⁻¹¹.
const CONVERGED_WITH_NOISE: f64 = 1e-7;

/// The most values of a function in the search for its roots within one step: those of interpolants of the highest degree in as many equal parts as there may be, with
/// the two that test the slopes of each, and those of the first parts on which the lengths of parts are tried. A function that takes more is not resolved by the finest division:
/// it is noise, as the difference of numbers that are far larger than it, or has thousands of kinks.
pub(crate) const MOST_VALUES: usize = {
    let [.., degree] = DEGREES;
    (1 << HALVINGS_OF_OSCILLATION) * (degree + 1 + 2)
        + HALVINGS_OF_OSCILLATION as usize * (degree + 1)
};

/// After so many values of a function at a time a search asks whether it may continue. Steps in which a function does not oscillate take fewer.
const VALUES_BETWEEN_ASKING: usize = 4096;

/// Two roots closer than this fraction of the step count as one that does not change the sign.
const NARROWEST: f64 = 1.0 / (1u64 << 40) as f64;

/// Why the roots of a function within a step are not isolated.
#[derive(Debug)]
pub(crate) enum NotIsolated<E> {
    /// The function has no value somewhere, or the search was not to continue.
    Failed(E),
    /// It would take more values than [`MOST_VALUES`].
    TooManyValues,
}

impl<E: From<Error>> NotIsolated<E> {
    /// The error of a function with this name, or this text, in a step that begins at the time `t`.
    pub fn explain(self, watched: &str, t: f64) -> E {
        match self {
            Self::Failed(error) => error,
            Self::TooManyValues => E::from(Error::ZerosNotIsolated {
                watched: watched.into(),
                t,
                values: MOST_VALUES,
            }),
        }
    }
}

/// Returns increasing fractions of a step, the last of which is 1, such that the function changes its sign at most once between
/// neighbours, and between 0 and the first. A long search asks from time to time whether it may continue.
///
/// # Errors
/// The errors of both functions, and where the function takes too many values.
pub(crate) fn isolating_fractions<E>(
    mut f: impl FnMut(f64) -> Result<f64, E>,
    mut may_continue: impl FnMut() -> Result<(), E>,
) -> Result<Vec<f64>, NotIsolated<E>> {
    let mut looks = Vec::new();
    let mut values = 0;
    let mut counted = |theta: f64| {
        if values == MOST_VALUES {
            return Err(NotIsolated::TooManyValues);
        }
        values += 1;
        if values % VALUES_BETWEEN_ASKING == 0 {
            may_continue().map_err(NotIsolated::Failed)?;
        }
        f(theta).map_err(NotIsolated::Failed)
    };
    interpolate(&mut counted, [0.0, 1.0], Effort::FIRST, &mut looks)?;
    looks.retain(|theta| *theta > 0.0);
    if looks.last() != Some(&1.0) {
        looks.push(1.0);
    }
    looks.dedup();
    Ok(looks)
}

/// How far an interval may be divided.
#[derive(Clone, Copy)]
struct Effort {
    /// How many more times it may be bisected if no interpolant resolves the function.
    halvings: u32,
    /// How many more times it may be bisected if the function oscillates too fast.
    of_oscillation: u32,
    /// The last coefficients have to be below this fraction of the largest.
    converged: f64,
}

impl Effort {
    const FIRST: Self = Self {
        halvings: HALVINGS,
        of_oscillation: HALVINGS_OF_OSCILLATION,
        converged: CONVERGED,
    };

    /// Whether an interpolant with these coefficients resolves the function.
    fn resolves(&self, coefficients: &[f64]) -> bool {
        let greatest = greatest_magnitude(coefficients);
        greatest <= CONVERGED * f64::MAX
            && greatest_of_last_three(coefficients) <= self.converged * greatest
    }

    /// Coefficients below this are noise.
    fn noise(&self, coefficients: &[f64]) -> f64 {
        let rounding = ROUNDING * greatest_magnitude(coefficients);
        if self.converged > CONVERGED {
            rounding.max(coefficients.len() as f64 * greatest_of_last_three(coefficients))
        } else {
            rounding
        }
    }
}

/// Interpolates a function between two fractions and isolates its roots there.
fn interpolate<E>(
    f: &mut impl FnMut(f64) -> Result<f64, E>,
    [a, b]: [f64; 2],
    effort: Effort,
    looks: &mut Vec<f64>,
) -> Result<(), E> {
    let mut values = Vec::new();
    for node in 0..=COARSE {
        values.push(f(chebyshev_node(node, COARSE, [a, b]))?);
    }
    let coarse = coefficients(&values);
    if is_far_from_zero(&coarse) && is_followed(f, &coarse, [a, b])? {
        return Ok(());
    }
    for degree in DEGREES {
        // Every second node was a node of the lower degree.
        let before = core::mem::take(&mut values);
        for node in 0..=degree {
            let known = before.get(node / 2).filter(|_| node % 2 == 0);
            values.push(match known {
                Some(value) => *value,
                None => f(chebyshev_node(node, degree, [a, b]))?,
            });
        }
        let coefficients = coefficients(&values);
        if effort.resolves(&coefficients) {
            let noise = effort.noise(&coefficients);
            isolate(&coefficients, ([a, b], noise), looks);
            return Ok(());
        }
    }
    let degree = values.len() - 1;
    let all = coefficients(&values);
    let swings = greatest_magnitude(&all[degree / 2..]) > OSCILLATES * greatest_magnitude(&all);
    if swings && interpolate_parts(f, [a, b], effort, looks)? {
        return Ok(());
    }
    let Effort { halvings, .. } = effort;
    if halvings == 0 {
        // Nodes are numbered from the end to the beginning.
        looks.extend(
            (0..degree)
                .rev()
                .map(|node| chebyshev_node(node, degree, [a, b])),
        );
        return Ok(());
    }
    let middle = 0.5 * (a + b);
    let of_half = Effort {
        halvings: halvings - 1,
        ..effort
    };
    interpolate(f, [a, middle], of_half, looks)?;
    looks.push(middle);
    interpolate(f, [middle, b], of_half, looks)
}

/// Divides an interval in which the function oscillates too fast for one interpolant into the fewest equal parts that are resolved, and isolates
/// the roots there. Returns whether there are such parts; noise has none.
fn interpolate_parts<E>(
    f: &mut impl FnMut(f64) -> Result<f64, E>,
    [a, b]: [f64; 2],
    effort: Effort,
    looks: &mut Vec<f64>,
) -> Result<bool, E> {
    let [.., degree] = DEGREES;
    for cuts in 1..=effort.of_oscillation {
        let parts = 2_u32.pow(cuts);
        let cut = |part: u32| {
            if part == parts {
                b
            } else {
                a + (b - a) * f64::from(part) / f64::from(parts)
            }
        };
        let of_part = Effort {
            of_oscillation: effort.of_oscillation - cuts,
            converged: CONVERGED_WITH_NOISE,
            ..effort
        };
        // Whether parts of this length are resolved is tested on the first.
        let first: Result<Vec<f64>, E> = (0..=degree)
            .map(|node| f(chebyshev_node(node, degree, [a, cut(1)])))
            .collect();
        if !of_part.resolves(&coefficients(&first?)) {
            continue;
        }
        for part in 0..parts {
            if part > 0 {
                looks.push(cut(part));
            }
            interpolate(f, [cut(part), cut(part + 1)], of_part, looks)?;
        }
        return Ok(true);
    }
    Ok(false)
}

/// Whether an interpolant that may not resolve the function is certainly far from zero. The coefficients of a smooth function fall
/// geometrically, so the truncation error is a small multiple of the last two.
fn is_far_from_zero(c: &[f64]) -> bool {
    let rest: f64 = c[1..].iter().map(|c| c.abs()).sum();
    let last = c[c.len() - 1].abs().max(c[c.len() - 2].abs());
    c[0].abs() > rest + 4.0 * c.len() as f64 * last
}

/// Whether a function has the slopes of its interpolant at both ends. A function that oscillates many times can look smooth at the nodes.
fn is_followed<E>(
    f: &mut impl FnMut(f64) -> Result<f64, E>,
    c: &[f64],
    [a, b]: [f64; 2],
) -> Result<bool, E> {
    let count = c.len() as f64;
    let last = c[c.len() - 1].abs().max(c[c.len() - 2].abs());
    // The derivative of the truncation error that `is_far_from_zero` assumes.
    let differs = 2.0 * PROBE_DISTANCE * 4.0 * count * count * last
        + ROUNDING_OF_VALUES * greatest_magnitude(c);
    for theta in [PROBE_DISTANCE, 1.0 - PROBE_DISTANCE] {
        let off = f(a + (b - a) * theta)? - evaluate(c, 2.0 * theta - 1.0);
        if off.is_nan() || off.abs() > differs {
            return Ok(false);
        }
    }
    Ok(true)
}

/// Chebyshev node number `node` of this degree between two fractions, numbered from the end to the beginning.
fn chebyshev_node(node: usize, degree: usize, [a, b]: [f64; 2]) -> f64 {
    match node {
        0 => b,
        _ if node == degree => a,
        _ => a + (b - a) * 0.5 * (1.0 + cosine(node, degree)),
    }
}

/// `cos(π m/n)`, from a table if `n` divides 64, since most steps need some.
fn cosine(m: usize, n: usize) -> f64 {
    match parts(n) {
        Some(parts) => COSINES[m * parts % COSINES.len()],
        None => Scalar::cos(core::f64::consts::PI * (m % (2 * n)) as f64 / n as f64),
    }
}

/// The angle `π/n` in 128ths of the circle, if that is a whole number.
fn parts(n: usize) -> Option<usize> {
    (n != 0 && 64_usize.is_multiple_of(n)).then(|| 64 / n)
}

/// Cosines of the multiples of a 128th of the circle.
const COSINES: [f64; 128] = {
    let mut all = [0.0; 128];
    let mut part = 0;
    while part < 128 {
        let to_middle = if part < 64 { part } else { 128 - part };
        all[part] = match to_middle {
            ..=32 => QUARTER[to_middle],
            _ => -QUARTER[64 - to_middle],
        };
        part += 1;
    }
    all
};

/// `cos(π k/64)` to the middle, rounded from 50 digits.
const QUARTER: [f64; 33] = [
    1.0,
    0.9987954562051724,
    0.9951847266721969,
    0.989176509964781,
    0.9807852804032304,
    0.970031253194544,
    0.9569403357322088,
    0.9415440651830208,
    0.9238795325112867,
    0.9039892931234433,
    0.881921264348355,
    0.8577286100002721,
    0.8314696123025452,
    0.8032075314806449,
    0.773010453362737,
    0.7409511253549591,
    core::f64::consts::FRAC_1_SQRT_2,
    0.6715589548470184,
    0.6343932841636455,
    0.5956993044924334,
    0.5555702330196022,
    0.5141027441932218,
    0.47139673682599764,
    0.4275550934302821,
    0.3826834323650898,
    0.33688985339222005,
    0.2902846772544624,
    0.2429801799032639,
    0.19509032201612828,
    0.14673047445536175,
    0.0980171403295606,
    0.049067674327418015,
    0.0,
];

/// Coefficients of the interpolant through values at the nodes.
fn coefficients(values: &[f64]) -> Vec<f64> {
    let mut c = std::vec![0.0; values.len()];
    interpolate_into(values, &mut c);
    c
}

/// [`coefficients`], as many as there are values, into a list that is there.
fn interpolate_into(values: &[f64], c: &mut [f64]) {
    let n = values.len() - 1;
    if n == 0 {
        c.copy_from_slice(values);
        return;
    }
    let half_ends = |j: usize| if j == 0 || j == n { 0.5 } else { 1.0 };
    for (k, c) in c.iter_mut().enumerate() {
        let mut sum = 0.0;
        for (j, value) in values.iter().enumerate() {
            sum += half_ends(j) * value * cosine(j * k, n);
        }
        *c = 2.0 / n as f64 * half_ends(k) * sum;
    }
}

fn greatest_magnitude(coefficients: &[f64]) -> f64 {
    let sizes = coefficients.iter().map(|c| c.abs());
    sizes.fold(0.0, |most, size| {
        if size > most || size.is_nan() {
            size
        } else {
            most
        }
    })
}

/// The largest of the last three coefficients, which decides whether the interpolant resolves the function.
fn greatest_of_last_three(coefficients: &[f64]) -> f64 {
    greatest_magnitude(&coefficients[coefficients.len() - 3..])
}

/// Appends the ends of intervals that contain one root each.
fn isolate(coefficients: &[f64], (whole, noise): ([f64; 2], f64), looks: &mut Vec<f64>) {
    let mut open = Vec::from([(coefficients.to_vec(), whole)]);
    while let Some((mut c, [a, b])) = open.pop() {
        while c.len() > 1 && c.last().is_some_and(|c| c.abs() <= noise) {
            c.pop();
        }
        let rest: f64 = c[1..].iter().map(|c| c.abs()).sum();
        if c[0].abs() > rest + noise || rest + c[0].abs() <= noise {
            continue;
        }
        let slopes = derivative(&c);
        let bends: f64 = slopes.iter().skip(1).map(|c| c.abs()).sum();
        let is_monotone = slopes.first().is_none_or(|slope| slope.abs() > bends);
        if is_monotone || b - a <= NARROWEST {
            looks.extend([a, b]);
            continue;
        }
        let middle = 0.5 * (a + b);
        let half = |from: f64, to: f64| {
            let degree = c.len() - 1;
            let values: Vec<f64> = (0..=degree)
                .map(|node| evaluate(&c, chebyshev_node(node, degree, [from, to])))
                .collect();
            self::coefficients(&values)
        };
        // The first half is popped first.
        open.push((half(0.0, 1.0), [middle, b]));
        open.push((half(-1.0, 0.0), [a, middle]));
    }
}

/// The coefficients of the derivative.
fn derivative(c: &[f64]) -> Vec<f64> {
    let n = c.len() - 1;
    let mut slopes = std::vec![0.0; n + 2];
    for k in (1..=n).rev() {
        slopes[k - 1] = slopes[k + 1] + 2.0 * k as f64 * c[k];
    }
    slopes[0] *= 0.5;
    slopes.truncate(n);
    slopes
}

/// The value at `x` in [−1, 1], by Clenshaw's recurrence.
fn evaluate(c: &[f64], x: f64) -> f64 {
    let (mut one, mut two) = (0.0, 0.0);
    for c in c[1..].iter().rev() {
        (one, two) = (c + 2.0 * x * one - two, one);
    }
    c[0] + x * one - two
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The roots between looks, by bisection.
    fn roots(f: fn(f64) -> f64) -> Vec<f64> {
        let looks = isolating_fractions(|theta| Ok::<_, ()>(f(theta)), || Ok(())).unwrap();
        let ends = core::iter::once(0.0).chain(looks.iter().copied());
        let pairs = ends.zip(looks.iter().copied());
        let crossing = pairs.filter(|(a, b)| (f(*a) < 0.0) != (f(*b) < 0.0));
        let root = |(mut a, mut b): (f64, f64)| {
            for _ in 0..60 {
                let middle = 0.5 * (a + b);
                if (f(middle) < 0.0) == (f(a) < 0.0) {
                    a = middle;
                } else {
                    b = middle;
                }
            }
            b
        };
        crossing.map(root).collect()
    }

    #[track_caller]
    fn are_near(found: &[f64], expected: &[f64]) {
        assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{found} {expected}");
        }
    }

    #[test]
    fn what_swings_thousands_of_times_has_all_its_roots() {
        let far = |x: f64| (0.1 + 5000.0 * x).sin();
        let expected: Vec<f64> = (1..=1591)
            .map(|k| (f64::from(k) * core::f64::consts::PI - 0.1) / 5000.0)
            .collect();
        are_near(&roots(far), &expected);
        // The frequency of this function increases.
        let rising = |x: f64| (0.5 + 900.0 * x * x).sin();
        let expected: Vec<f64> = (1..=286)
            .map(|k| ((f64::from(k) * core::f64::consts::PI - 0.5) / 900.0).sqrt())
            .collect();
        are_near(&roots(rising), &expected);
    }

    #[test]
    fn noise_is_given_up() {
        let mut state = 1_u64;
        let mut calls = 0;
        let noise = |_: f64| {
            calls += 1;
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            Ok::<_, ()>((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5)
        };
        isolating_fractions(noise, || Ok(())).unwrap();
        // Seven intervals, in each of which parts of fourteen sizes are tried.
        assert!(calls < 7 * 16 * 65, "{calls}");
    }

    /// As round-off of large numbers: jumps between neighbouring numbers, at places without an order. It is constant in the first part of the finest division, from which nothing
    /// follows for the others.
    fn round_off(theta: f64) -> f64 {
        if theta < 1e-4 {
            return 0.5;
        }
        let hash = theta.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15);
        (hash >> 62) as f64 - 1.5
    }

    #[test]
    fn a_function_that_is_not_resolved_is_refused_within_a_budget() {
        let mut calls = 0;
        let counted = |theta| {
            calls += 1;
            Ok::<_, ()>(round_off(theta))
        };
        let found = isolating_fractions(counted, || Ok(()));
        assert!(
            matches!(found, Err(NotIsolated::TooManyValues)),
            "{found:?}"
        );
        assert_eq!(calls, MOST_VALUES);
    }

    #[test]
    fn what_the_finest_division_resolves_is_within_the_budget() {
        // The coefficients of 8 turns in a part fall as the Bessel functions J_k(8 π), below 1e-12 at k = 62; those of 16 turns do not.
        let turns = 8.0 * f64::from(1 << HALVINGS_OF_OSCILLATION);
        let fast = |x: f64| (0.1 + core::f64::consts::TAU * turns * x).sin();
        let mut calls = 0;
        let counted = |theta| {
            calls += 1;
            Ok::<_, ()>(fast(theta))
        };
        let looks = isolating_fractions(counted, || Ok(())).unwrap();
        let signs = core::iter::once(&0.0)
            .chain(&looks)
            .map(|theta| fast(*theta) < 0.0);
        let changes = signs.clone().zip(signs.skip(1)).filter(|(a, b)| a != b);
        // One in every half turn.
        assert_eq!(changes.count(), (2.0 * turns) as usize, "{calls} values");
    }

    #[test]
    fn a_long_search_is_stopped() {
        let mut calls = 0;
        let counted = |theta| {
            calls += 1;
            Ok(round_off(theta))
        };
        let mut asked = 0;
        let may_continue = || {
            asked += 1;
            if asked == 3 { Err("stopped") } else { Ok(()) }
        };
        let found = isolating_fractions(counted, may_continue);
        assert!(
            matches!(found, Err(NotIsolated::Failed("stopped"))),
            "{found:?}"
        );
        // The value before which it is stopped is not asked for.
        assert_eq!(calls, 3 * VALUES_BETWEEN_ASKING - 1);
    }

    #[test]
    fn none_is_missed_between_the_ends() {
        // Between two equal signs at the ends and in the middle.
        are_near(&roots(|x| (x - 0.30) * (x - 0.31)), &[0.30, 0.31]);
        are_near(&roots(|x| (x - 0.3) * (x - 0.3 - 1e-6)), &[0.3, 0.3 + 1e-6]);
        let many: Vec<f64> = (1..8).map(|k| f64::from(k) / 8.0).collect();
        are_near(
            &roots(|x| (8.0 * core::f64::consts::PI * x).sin() + 0.0 * x),
            &many,
        );
        are_near(&roots(|x| (40.0 * x).exp() - 1e10), &[1e10_f64.ln() / 40.0]);
    }

    #[test]
    fn a_touch_is_no_crossing() {
        are_near(&roots(|x| (x - 0.3) * (x - 0.3)), &[]);
        are_near(&roots(|x| (x - 0.3) * (x - 0.3) + 1e-9), &[]);
        are_near(&roots(|_| 0.0), &[]);
        are_near(&roots(|_| 1.0), &[]);
    }

    #[test]
    fn a_triple_root_is_one_crossing() {
        let found = roots(|x| (x - 0.625).powi(3));
        assert_eq!(found.len(), 1);
        assert!((found[0] - 0.625).abs() < 1e-5, "{found:?}");
    }

    #[test]
    fn kinks_are_looked_at_closely() {
        let found = roots(|x| (x - 0.37).abs() - 0.01);
        are_near(&found, &[0.36, 0.38]);
        let found = roots(|x| if x < 0.7 { -1.0 } else { 1.0 });
        are_near(&found, &[0.7]);
    }
}
