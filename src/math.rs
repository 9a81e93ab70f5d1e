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

/// `x` to a real power, `x ≥ 0`, to the seven digits of `f32`: more than the choice of a step
/// needs, at a third of the price. 0 and infinity stay what they are, or become each other.
#[inline]
pub(crate) fn rough_power(x: f64, exponent: f64) -> f64 {
    f64::from(Scalar::powf(x as f32, exponent as f32))
}
