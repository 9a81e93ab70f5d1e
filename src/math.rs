//! Functions that `core` lacks, the same bits on every platform.

use lagrangian_scalar::Scalar;

#[inline]
pub(crate) fn sqrt(x: f64) -> f64 {
    Scalar::sqrt(x)
}

/// `x` to a real power, `x ≥ 0`.
pub(crate) fn power(x: f64, exponent: f64) -> f64 {
    Scalar::powf(x, exponent)
}

/// The binary logarithm of a positive number, to 2e-5: more than the root of a high order needs.
#[cfg(feature = "std")]
#[inline]
pub(crate) fn rough_log2(x: f64) -> f64 {
    // Below the smallest normal number exponents say nothing.
    let (x, shift) = match x < f64::MIN_POSITIVE {
        true => (x * 2_f64.powi(54), -54.0),
        false => (x, 0.0),
    };
    let bits = x.to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as f64 - 1023.0;
    let mantissa = f64::from_bits((bits & ((1 << 52) - 1)) | (1023 << 52));
    // The interpolant of degree 5 in Chebyshev's nodes between 1 and 2: no division to wait for.
    let x = 2.0 * (mantissa - 1.5);
    let low = 0.584_950_50 + x * (0.480_910_61 - x * 0.079_937_27);
    let high = 0.017_714_77 + x * (x * 0.001_372_77 - 0.005_000_68);
    exponent + shift + (low + (x * x * x) * high)
}

/// 2 to a power, to 1e-5; 0 and infinity where that is beyond `f64`.
#[cfg(feature = "std")]
#[inline]
pub(crate) fn rough_exp2(x: f64) -> f64 {
    let x = x.clamp(-1100.0, 1100.0);
    let towards_0 = x as i64 as f64;
    let whole = if towards_0 > x {
        towards_0 - 1.0
    } else {
        towards_0
    };
    let y = (x - whole - 0.5) * core::f64::consts::LN_2;
    let series = 1.0 + y * (1.0 + y * (0.5 + y * (1.0 / 6.0 + y * (1.0 / 24.0))));
    // In two factors, each of which has an exponent.
    let half = (whole as i64 >> 1) as f64;
    let power = |n: f64| f64::from_bits(((n + 1023.0) as u64) << 52);
    series * core::f64::consts::SQRT_2 * power(half) * power(whole - half)
}

/// `x` to a real power, `x ≥ 0`, to the seven digits of `f32`: more than the choice of a step
/// needs, at a third of the price. 0 and infinity stay what they are, or become each other.
#[inline]
pub(crate) fn rough_power(x: f64, exponent: f64) -> f64 {
    f64::from(Scalar::powf(x as f32, exponent as f32))
}
