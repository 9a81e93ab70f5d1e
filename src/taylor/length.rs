//! The length of a step by series: its last terms are tolerable.

use crate::Vector;
use crate::math::{larger, rough_exp2, rough_exp2_within, rough_log2};
use crate::tolerance::Tolerance;

/// The largest ratios of both last terms of rates to their bounds, which are this part of the tolerable errors; `None` unless both are positive and finite.
/// The arithmetic is that of [`larger_ratio`], without branches.
#[inline(always)]
pub(super) fn usual_ratios<V: Vector>(
    [q, v]: [&[f64]; 2],
    rows: [&[f64]; 2],
    powers: [usize; 2],
    (tolerance, part): (&Tolerance<V>, f64),
) -> Option<[f64; 2]> {
    let powers = powers.map(|power| power as f64);
    // The sum is not finite if a ratio is not; a maximum may lose it.
    let (mut worst, mut sum) = ([0.0_f64; 2], 0.0);
    for (i, absolute) in tolerance.absolute.as_slice().iter().enumerate() {
        let size = size_of_rate(q[i], v[i]);
        let over = 1.0 / (part * (absolute + tolerance.relative * size));
        for k in 0..2 {
            let ratio = (powers[k] * rows[k][i].abs()) * over;
            sum += ratio;
            worst[k] = larger(worst[k], ratio);
        }
    }
    (worst[0] > 0.0 && worst[1] > 0.0 && sum.is_finite()).then_some(worst)
}

/// The size of a rate in the bound on its last terms: that of a coordinate counts up to 1, so that a rate that is just 0 does not shorten the
/// step. A coordinate may be far larger than its rate, such as an angle after many turns or the radius of a planet's orbit.
#[inline(always)]
pub(crate) fn size_of_rate(q: f64, v: f64) -> f64 {
    let of_coordinate = if q.abs() < 1.0 { q.abs() } else { 1.0 };
    // Its own where the rate is not a number.
    larger(of_coordinate, v.abs())
}

/// Whether the coordinates limit a step, too, whose length follows from the rates and whose last power of time is `last`. The last terms of a
/// coordinate are those of its rate times `h/j`, so in shorter steps they are smaller.
#[inline(always)]
pub(crate) fn is_slow(by_rates: f64, last: usize) -> bool {
    by_rates > (last - 1) as f64 && by_rates.is_finite()
}

/// The length of a step in which the last terms of coordinates are tolerable as well, for a step [that is slow](is_slow). Of each coordinate it
/// takes `[q, v, c₍last−1₎, c₍last₎, absolute tolerance]`. Its size is that within the step.
#[cold]
pub(crate) fn length_in_slow_motion(
    by_rates: f64,
    last: usize,
    coordinates: impl Iterator<Item = [f64; 5]>,
    relative: f64,
) -> f64 {
    let mut worst = [0.0_f64; 2];
    for [q, v, one, other, absolute] in coordinates {
        let size = q.abs() + v.abs() * by_rates;
        let over = 1.0 / bound(size, absolute, relative);
        worst = [
            larger_ratio(worst[0], one, 1.0, over),
            larger_ratio(worst[1], other, 1.0, over),
        ];
    }
    // The terms of rates have one power less, and so have those that `length` expects.
    length(worst, [last, last + 1]).min(by_rates)
}

/// The bound on the last terms of a step, for a coordinate or a rate of this size: a tenth of the tolerance from 1e-8 on, and a hundredth
/// below 1e-14.
#[inline(always)]
pub(crate) fn bound(size: f64, absolute: f64, relative: f64) -> f64 {
    let tolerable = absolute + relative * size;
    match 1.0 + size {
        // Not at round numbers, which tolerances are: there the rounding of these sums would decide.
        whole if tolerable > 0.5e-8 * whole => 0.1 * tolerable,
        whole if tolerable < 0.5e-14 * whole => 0.01 * tolerable,
        _ => tolerable,
    }
}

/// The part of the tolerable error that is the [`bound`], if it is the same for numbers of every size: neither tolerance is at one of the limits, where
/// rounding decides.
pub(crate) fn part_for_all_sizes(absolute: f64, relative: f64) -> Option<f64> {
    let part = |tolerance: f64| {
        let is_within = |low: f64, high: f64| low < tolerance && tolerance < high;
        if is_within(0.500_001e-8, f64::INFINITY) {
            Some(0.1)
        } else if is_within(0.500_001e-14, 0.499_999e-8) {
            Some(1.0)
        } else if is_within(1e-200, 0.499_999e-14) {
            Some(0.01)
        } else {
            None
        }
    };
    let found = part(absolute);
    found.filter(|_| part(relative) == found)
}

/// The larger of `worst` and a term's size over its bound; the term is that of the rate, v = Σ (j + 1) cⱼ₊₁ τʲ, in a step of 1 s.
#[inline(always)]
pub(crate) fn larger_ratio(worst: f64, c: f64, j: f64, over_bound: f64) -> f64 {
    let ratio = if c == 0.0 {
        0.0
    } else {
        (j * c.abs()) * over_bound
    };
    // NaN must not count as zero.
    if ratio > worst || ratio.is_nan() {
        ratio
    } else {
        worst
    }
}

/// The power of the size of a rate's term, in a step of 1 s, that the tolerable length of a step is, for this power of the time in the coordinate's
/// term. Known before the series is, so that its division delays nothing.
#[inline(always)]
fn exponent(j: usize) -> f64 {
    1.0 / (1.0 - j as f64)
}

/// The length of a step in which the terms of these two powers are at most their bounds, from their values in a step of 1 s;
/// infinite if both are 0.
#[inline(always)]
pub(crate) fn length(worst: [f64; 2], powers: [usize; 2]) -> f64 {
    // The logarithm of the length.
    let mut length = f64::INFINITY;
    for (worst, j) in worst.into_iter().zip(powers) {
        if worst == f64::INFINITY {
            return 0.0;
        } else if worst > 0.0 {
            length = length.min(rough_log2(worst) * exponent(j));
        } else if worst.is_nan() {
            return f64::NAN;
        }
    }
    match length {
        f64::INFINITY => length,
        _ => rough_exp2(length),
    }
}

/// [`length`] of several steps whose terms are positive and finite: the same arithmetic without branches. In a loop for each function, the compiler puts
/// all of them into one register.
#[inline(always)]
pub(crate) fn usual_lengths<const W: usize>(
    [mut one, mut other]: [[f64; W]; 2],
    powers: [usize; 2],
) -> [f64; W] {
    for one in &mut one {
        *one = rough_log2(*one) * exponent(powers[0]);
    }
    for other in &mut other {
        *other = rough_log2(*other) * exponent(powers[1]);
    }
    for (one, other) in one.iter_mut().zip(other) {
        *one = if *one < other { *one } else { other };
    }
    // A root of at least the tenth order of a number that is positive and finite.
    for one in &mut one {
        *one = rough_exp2_within(*one);
    }
    one
}

#[cfg(test)]
mod tests {
    use super::{bound, part_for_all_sizes};

    #[test]
    fn the_bound_does_not_depend_on_the_rounding_of_sizes() {
        for (tolerance, part) in [
            (1e-7, 0.1),
            (1e-8, 0.1),
            (1e-9, 1.0),
            (1e-14, 1.0),
            (3e-15, 0.01),
        ] {
            for k in 0..1000 {
                let size = 0.01 * f64::from(k);
                let expected = part * (tolerance + tolerance * size);
                assert_eq!(bound(size, tolerance, tolerance), expected);
            }
            assert_eq!(part_for_all_sizes(tolerance, tolerance), Some(part));
        }
        let at_limits = [[0.5e-8; 2], [0.5e-14; 2], [1e-15, 1e-14], [1e-7, 1e-9]];
        for [absolute, relative] in at_limits {
            assert_eq!(part_for_all_sizes(absolute, relative), None);
        }
    }
}
