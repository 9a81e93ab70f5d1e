//! Functions that `core` lacks, with the same bits on every platform.

use lagrangian_scalar::Scalar;

#[inline]
pub(crate) fn sqrt(x: f64) -> f64 {
    Scalar::sqrt(x)
}

/// `x` to a real power, `x ≥ 0`.
pub(crate) fn power(x: f64, exponent: f64) -> f64 {
    Scalar::powf(x, exponent)
}

/// 2⁵²: adding it to a number leaves the digits of the nearest integer in the low bits.
const WHOLE: f64 = 4_503_599_627_370_496.0;

/// The binary logarithm of a positive number, to 1e-7, which is more than sufficient for a root of high order.
///
/// This function and [`rough_exp2`] use only sums, products and bit operations,
/// which lanes have as well, and which give the same bits everywhere.
#[inline(always)]
pub(crate) fn rough_log2(x: f64) -> f64 {
    // Subnormal numbers are scaled first, since their exponent bits are zero.
    let is_small = x < f64::MIN_POSITIVE;
    let (scale, shift) = if is_small {
        (1.801_439_850_948_198_4e16, 1023.0 + 54.0)
    } else {
        (1.0, 1023.0)
    };
    let bits = (x * scale).to_bits();
    let exponent = f64::from_bits(((bits >> 52) & 0x7ff) | WHOLE.to_bits()) - WHOLE;
    // Twice the mantissa, which is between 1 and 2.
    let twice = f64::from_bits((bits & ((1 << 52) - 1)) | (1024 << 52));
    // The interpolant of degree 8 at Chebyshev nodes, whose error is 5.7e-8. It needs no division, and pairs of terms are independent of each other.
    let x = twice - 3.0;
    let square = x * x;
    let fourth = square * square;
    let low = (0.584_962_500_721 + x * 0.480_897_992_692)
        + square * (x * 0.017_815_741_053_9 - 0.080_149_617_794_2);
    let high = (x * 0.001_170_827_821_25 - 0.004_454_175_193_17)
        + square * (x * 0.000_115_395_087_159 - 0.000_324_844_268_652);
    exponent - shift + (low + fourth * (high - fourth * 0.000_033_850_387_969_1))
}

/// 2 to a power, with a relative error of 2e-7; 0 or infinity outside of the range of `f64`.
#[inline(always)]
pub(crate) fn rough_exp2(x: f64) -> f64 {
    let x = if x < -1100.0 { -1100.0 } else { x };
    let x = if x > 1100.0 { 1100.0 } else { x };
    let (series, whole) = part_and_whole(x);
    // Split into two factors whose exponents are in range.
    let half = whole >> 1;
    let power = |n: u64| f64::from_bits((n + 1023 - BIAS / 2) << 52);
    series * power(half) * power(whole - half)
}

/// [`rough_exp2`] for powers between −1000 and 1000: the same bits, sooner.
#[cfg(any(feature = "std", test))]
#[inline(always)]
pub(crate) fn rough_exp2_within(x: f64) -> f64 {
    let (series, whole) = part_and_whole(x);
    series * f64::from_bits((whole.wrapping_sub(BIAS - 1023)) << 52)
}

/// Makes the whole numbers in powers of 2 positive.
const BIAS: u64 = 2200;

/// 2 to the difference between a power and the nearest whole number, and that number plus [`BIAS`].
#[inline(always)]
fn part_and_whole(x: f64) -> (f64, u64) {
    const SHIFT: f64 = WHOLE + BIAS as f64;
    // The low bits of this sum are the nearest integer.
    let whole = x + SHIFT;
    let y = (x - (whole - SHIFT)) * core::f64::consts::LN_2;
    let square = y * y;
    let high = (1.0 / 24.0 + y * (1.0 / 120.0)) + square * (1.0 / 720.0);
    let series = (1.0 + y) + square * ((0.5 + y * (1.0 / 6.0)) + square * high);
    (series, whole.to_bits() & 0xffff)
}

/// `x` to a real power, `x ≥ 0`, to six digits for exponents of at most 1: sufficient for the choice of a step, in a tenth of the time of a
/// correctly rounded function. 0 and infinity are kept, or exchanged for negative exponents.
#[inline]
pub(crate) fn rough_power(x: f64, exponent: f64) -> f64 {
    let logarithm = match x {
        0.0 => f64::NEG_INFINITY,
        f64::INFINITY => f64::INFINITY,
        _ => rough_log2(x),
    };
    match exponent {
        0.0 => 1.0,
        _ => rough_exp2(exponent * logarithm),
    }
}

/// The larger of two numbers, the first where the second is not one: a single instruction, which `f64::max` is not.
#[inline(always)]
pub(crate) fn larger(x: f64, y: f64) -> f64 {
    if y > x { y } else { x }
}

#[cfg(test)]
mod tests {
    use super::{rough_exp2, rough_exp2_within, rough_log2, rough_power};

    #[test]
    fn rough_powers_are_within_their_bounds() {
        // Compared with the functions of the standard library, over all exponents and between them.
        let mut x = 5e-324_f64;
        while x.is_finite() {
            let error = rough_log2(x) - x.log2();
            assert!(error.abs() < 1e-7, "log2 {x:e}: {error:e}");
            x *= if x < 1e-300 { 2.0 } else { 1.37 };
        }
        for i in -10_700..10_230 {
            let x = f64::from(i) * 0.1 + 0.03;
            let exact = x.exp2();
            // Subnormal numbers are rounded more coarsely.
            let bound = 2e-7 * exact + 5e-324;
            assert!((rough_exp2(x) - exact).abs() <= bound, "exp2 {x}");
            if x.abs() < 1000.0 {
                assert_eq!(rough_exp2_within(x), rough_exp2(x), "exp2 {x}");
            }
        }
        assert_eq!([-5e3, 5e3].map(rough_exp2), [0.0, f64::INFINITY]);
        assert_eq!(
            [f64::NEG_INFINITY, f64::INFINITY].map(rough_exp2),
            [0.0, f64::INFINITY]
        );
        for i in 1..400 {
            let x = f64::from(i) * 0.37;
            for exponent in [-0.125, -0.2, 0.04, 0.8] {
                let exact = x.powf(exponent);
                assert!(
                    (rough_power(x, exponent) - exact).abs() < 3e-7 * exact,
                    "{x} {exponent}"
                );
            }
        }
        let ends = [0.0, f64::INFINITY];
        assert_eq!(ends.map(|x| rough_power(x, 0.125)), ends);
        assert_eq!(ends.map(|x| rough_power(x, -0.125)), [ends[1], ends[0]]);
        assert_eq!(ends.map(|x| rough_power(x, 0.0)), [1.0; 2]);
    }
}
