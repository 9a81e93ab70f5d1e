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

use std::vec::Vec;

use lagrangian_scalar::Scalar;

use crate::Error;

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

/// Two roots closer than this fraction of the step count as one that does not change the sign.
const NARROWEST: f64 = 1.0 / (1u64 << 40) as f64;

/// Returns increasing fractions of a step, the last of which is 1, such that the function changes its sign at most once between
/// neighbours, and between 0 and the first.
pub(crate) fn isolating_fractions(
    mut f: impl FnMut(f64) -> Result<f64, Error>,
) -> Result<Vec<f64>, Error> {
    let mut looks = Vec::new();
    interpolate(&mut f, [0.0, 1.0], Effort::FIRST, &mut looks)?;
    looks.retain(|theta| *theta > 0.0);
    if looks.last() != Some(&1.0) {
        looks.push(1.0);
    }
    looks.dedup();
    Ok(looks)
}

/// How many times an interval with a kink is bisected in the search for extremes.
const HALVINGS_TO_EXTREMES: u32 = 40;

/// The highest degree of an interpolant in the search for extremes.
const EXTREMES_DEGREE: usize = 32;

/// How many intervals of one step the search for extremes looks at.
const MOST_INTERVALS: usize = 400;

/// Extremes are found to this fraction of the range of the function.
const EXTREMES: f64 = 1e-10;

/// Finds the least and the greatest value of a function between two fractions.
///
/// On entry `extent` holds the least and the greatest value known so far, each with its place, or `None`;
/// on return also those of this step, with fractions of it as places. `wanted` says which of the two
/// matter. The coefficients of a Chebyshev interpolant bound the function between the nodes, so an interval
/// that cannot contain a new extreme is discarded after few values. An interval with a kink is bisected.
///
/// # Errors
/// The errors of the function.
pub fn extremes(
    mut f: impl FnMut(f64) -> Result<f64, Error>,
    [from, to]: [f64; 2],
    extent: &mut [Option<(f64, f64)>; 2],
    wanted: [bool; 2],
) -> Result<(), Error> {
    let mut take = |extent: &mut [Option<(f64, f64)>; 2], theta: f64| {
        let value = f(theta)?;
        let [least, greatest] = extent;
        if least.is_none_or(|(known, _)| value < known || value.is_nan()) {
            *least = Some((value, theta));
        }
        if greatest.is_none_or(|(known, _)| value > known || value.is_nan()) {
            *greatest = Some((value, theta));
        }
        Ok::<f64, Error>(value)
    };
    // Intervals that are still to be searched after the first. Most steps need only the first and allocate nothing.
    let mut open = Vec::new();
    let mut next = Some(([from, to], HALVINGS_TO_EXTREMES));
    let mut looked_at = 0;
    let (mut values, mut c) = ([0.0; EXTREMES_DEGREE + 1], [0.0; EXTREMES_DEGREE + 1]);
    'open: while let Some((ends @ [a, b], halvings)) = next.take().or_else(|| open.pop()) {
        looked_at += 1;
        for degree in [COARSE, 16, EXTREMES_DEGREE] {
            let (values, c) = (&mut values[..=degree], &mut c[..=degree]);
            for node in (0..=degree).rev() {
                values[node] = take(extent, chebyshev_node(node, degree, ends))?;
            }
            let [Some((low, _)), Some((high, _))] = *extent else {
                continue;
            };
            if low.is_nan() || high.is_nan() {
                return Ok(());
            }
            interpolate_into(values, c);
            let enough = EXTREMES * (high - low);
            let rounding = 64.0 * f64::EPSILON * greatest_magnitude(c);
            let rest: f64 = c[1..].iter().map(|c| c.abs()).sum();
            let last = c[degree].abs().max(c[degree - 1].abs());
            let beyond = rest + 4.0 * c.len() as f64 * last;
            let may_be_lower = wanted[0] && c[0] - beyond < low - enough;
            let may_be_higher = wanted[1] && c[0] + beyond > high + enough;
            if !may_be_lower && !may_be_higher {
                continue 'open;
            }
            let tail = &c[degree - 2..];
            if tail.iter().any(|c| c.abs() > (0.01 * enough).max(rounding)) {
                continue;
            }
            let slopes = derivative(c);
            let mut looks = Vec::new();
            let noise = ROUNDING * self::greatest_magnitude(&slopes);
            isolate(&slopes, ([-1.0, 1.0], noise), &mut looks);
            for pair in looks.chunks(2) {
                let &[mut one, mut other] = pair else {
                    continue;
                };
                let rises = evaluate(&slopes, one) > 0.0;
                while other - one > 1e-14 {
                    let middle = 0.5 * (one + other);
                    let is_before = (evaluate(&slopes, middle) > 0.0) == rises;
                    if is_before && middle > one {
                        one = middle;
                    } else if !is_before && middle < other {
                        other = middle;
                    } else {
                        break;
                    }
                }
                take(extent, a + (b - a) * 0.5 * (1.0 + 0.5 * (one + other)))?;
            }
            continue 'open;
        }
        if halvings > 0 && looked_at < MOST_INTERVALS {
            let middle = 0.5 * (a + b);
            open.push(([middle, b], halvings - 1));
            open.push(([a, middle], halvings - 1));
        }
    }
    Ok(())
}

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
const PROBE_DISTANCE: f64 = 0.01;

/// Allowance for rounding when values beside the nodes are compared with the interpolant, relative to the largest value. A function
/// that varies by less than this fraction of its size has no root.
const ROUNDING_OF_VALUES: f64 = 1e-6;

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
fn interpolate(
    f: &mut impl FnMut(f64) -> Result<f64, Error>,
    [a, b]: [f64; 2],
    effort: Effort,
    looks: &mut Vec<f64>,
) -> Result<(), Error> {
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
fn interpolate_parts(
    f: &mut impl FnMut(f64) -> Result<f64, Error>,
    [a, b]: [f64; 2],
    effort: Effort,
    looks: &mut Vec<f64>,
) -> Result<bool, Error> {
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
        let first: Result<Vec<f64>, Error> = (0..=degree)
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
fn is_followed(
    f: &mut impl FnMut(f64) -> Result<f64, Error>,
    c: &[f64],
    [a, b]: [f64; 2],
) -> Result<bool, Error> {
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
        let looks = isolating_fractions(|theta| Ok(f(theta))).unwrap();
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

    #[test]
    fn noise_is_given_up() {
        let mut state = 1_u64;
        let mut calls = 0;
        let noise = |_: f64| {
            calls += 1;
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1);
            Ok((state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5)
        };
        isolating_fractions(noise).unwrap();
        // Seven intervals, in each of which parts of fourteen sizes are tried.
        assert!(calls < 7 * 16 * 65, "{calls}");
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

    /// Least and greatest value between 0 and 1.
    fn extent(f: impl Fn(f64) -> f64) -> [(f64, f64); 2] {
        let mut extent = [None; 2];
        extremes(|theta| Ok(f(theta)), [0.0, 1.0], &mut extent, [true; 2]).unwrap();
        extent.map(|found| found.unwrap())
    }

    #[test]
    fn extremes_lie_between_the_nodes() {
        use core::f64::consts::TAU;
        let [low, high] = extent(|x| (9.0 * x).sin());
        assert!((low.0 + 1.0).abs() < 1e-10 && (high.0 - 1.0).abs() < 1e-10);
        // The first of two equal ones or the second; both are flat there.
        let phase = 9.0 * high.1 / TAU - 0.25;
        assert!((phase - phase.round()).abs() < 1e-5, "{high:?}");
        // A narrow hump, and a kink as the least value and as the greatest.
        let [low, high] = extent(|x| (-400.0 * (x - 0.317) * (x - 0.317)).exp());
        assert!(low.0 < 1e-10 && (high.0 - 1.0).abs() < 1e-10 && (high.1 - 0.317).abs() < 1e-5);
        let [low, high] = extent(|x| (x - 0.3217).abs());
        assert!(low.0 < 1e-10 && (low.1 - 0.3217).abs() < 1e-9, "{low:?}");
        assert!((high.0 - 0.6783).abs() < 1e-15);
        let [_, high] = extent(|x| 1.0 - (x - 0.3217).abs());
        assert!((high.0 - 1.0).abs() < 1e-10, "{high:?}");
        assert_eq!(extent(|_| 3.0).map(|(value, _)| value), [3.0; 2]);
        assert!(extent(|x| if x > 0.9 { f64::NAN } else { x })[1].0.is_nan());
    }

    /// Sums of three sines against ten thousand samples, whose neighbours differ from the extreme by no more than half the
    /// greatest second derivative times the square of half their distance.
    #[test]
    fn extremes_of_random_functions_are_no_less_than_samples() {
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut random = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        for case in 0..200 {
            let terms: [[f64; 3]; 3] =
                core::array::from_fn(|_| [random() - 0.5, 12.0 * random(), 6.0 * random()]);
            let f = |x: f64| {
                terms
                    .iter()
                    .map(|[a, w, p]| a * (w * x + p).sin())
                    .sum::<f64>()
            };
            let bend: f64 = terms.iter().map(|[a, w, _]| (a * w * w).abs()).sum();
            let [low, high] = extent(f);
            let samples = (0..=10_000).map(|k| f(f64::from(k) / 1e4));
            let (least, greatest) =
                samples.fold((f64::MAX, f64::MIN), |(l, g), x| (l.min(x), g.max(x)));
            let enough = 1e-10 * (greatest - least) + 1e-15;
            let between = 0.5 * bend * 0.25e-8 + enough;
            assert!(
                high.0 >= greatest - enough && high.0 <= greatest + between,
                "{case}: {high:?} {greatest}"
            );
            assert!(
                low.0 <= least + enough && low.0 >= least - between,
                "{case}: {low:?} {least}"
            );
            assert!(f(high.1) == high.0 && f(low.1) == low.0);
        }
    }
}
