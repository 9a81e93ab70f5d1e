//! The least and the greatest value of a function within a step.

use std::vec::Vec;

use super::{
    COARSE, ROUNDING, chebyshev_node, derivative, evaluate, greatest_magnitude, interpolate_into,
    isolate,
};
use crate::Error;

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
            match seen(c, [low, high], wanted) {
                Seen::Nothing => continue 'open,
                Seen::Roughly => {}
                Seen::Exactly => {
                    for x in turning_points(c) {
                        take(extent, a + (b - a) * 0.5 * (1.0 + x))?;
                    }
                    continue 'open;
                }
            }
        }
        if halvings > 0 && looked_at < MOST_INTERVALS {
            let middle = 0.5 * (a + b);
            open.push(([middle, b], halvings - 1));
            open.push(([a, middle], halvings - 1));
        }
    }
    Ok(())
}

/// What a Chebyshev interpolant shows of the extremes of its function.
enum Seen {
    /// There is no new extreme between the nodes.
    Nothing,
    /// There may be one, and the interpolant is not accurate enough to say where.
    Roughly,
    /// There may be one, at a turning point of the interpolant.
    Exactly,
}

/// What the interpolant with the coefficients `c` shows beside the least and the greatest value known so far.
fn seen(c: &[f64], [low, high]: [f64; 2], wanted: [bool; 2]) -> Seen {
    let degree = c.len() - 1;
    let enough = EXTREMES * (high - low);
    let rounding = 64.0 * f64::EPSILON * greatest_magnitude(c);
    let rest: f64 = c[1..].iter().map(|c| c.abs()).sum();
    let last = c[degree].abs().max(c[degree - 1].abs());
    let beyond = rest + 4.0 * c.len() as f64 * last;
    let may_be_lower = wanted[0] && c[0] - beyond < low - enough;
    let may_be_higher = wanted[1] && c[0] + beyond > high + enough;
    if !may_be_lower && !may_be_higher {
        return Seen::Nothing;
    }
    let tail = &c[degree - 2..];
    if tail.iter().any(|c| c.abs() > (0.01 * enough).max(rounding)) {
        return Seen::Roughly;
    }
    Seen::Exactly
}

/// Where between -1 and 1 the slope of a Chebyshev interpolant changes its sign.
fn turning_points(c: &[f64]) -> impl Iterator<Item = f64> + use<> {
    let slopes = derivative(c);
    let mut looks = Vec::new();
    let noise = ROUNDING * greatest_magnitude(&slopes);
    isolate(&slopes, ([-1.0, 1.0], noise), &mut looks);
    (0..looks.len() / 2).map(move |pair| {
        let [mut one, mut other] = [looks[2 * pair], looks[2 * pair + 1]];
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
        0.5 * (one + other)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

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
