//! Exact sums and products of two `f64`: the rounded result and its rounding error.

/// (s, e) with s = fl(a + b) and s + e = a + b.
///
/// D. E. Knuth, *The Art of Computer Programming* vol. 2, 3rd ed., section 4.2.2, theorem B.
#[inline]
pub fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let b_part = s - a;
    let a_part = s - b_part;
    (s, (a - a_part) + (b - b_part))
}

/// [`two_sum`] for |a| ≥ |b|.
///
/// T. J. Dekker, *A floating-point technique for extending the available precision*, Numer. Math.
/// 18 (1971) 224–242.
#[inline]
pub fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// (p, e) with p = fl(ab) and p + e = ab, provided that p is finite and |ab| ≥ 2⁻⁹⁶⁸ (below that,
/// bits of e underflow).
///
/// Dekker's product: each factor is split into halves of 26 bits, whose products are exact.
/// (`f64::mul_add` would need only one operation, but is a slow call unless the processor is known
/// to support it.)
#[inline]
pub fn two_product(a: f64, b: f64) -> (f64, f64) {
    // Splitting multiplies by 2²⁷ + 1: scale numbers that would overflow. Powers of 2 are exact.
    const LARGE: f64 = 1e299;
    const DOWN: f64 = 1.0 / (1u64 << 32) as f64;
    const UP: f64 = (1u64 << 32) as f64;
    let p = a * b;
    if a.abs() > LARGE {
        return (p, product_error(a * DOWN, b, p * DOWN) * UP);
    }
    if b.abs() > LARGE {
        return (p, product_error(a, b * DOWN, p * DOWN) * UP);
    }
    (p, product_error(a, b, p))
}

/// ab − p for p = fl(ab).
#[inline]
fn product_error(a: f64, b: f64, p: f64) -> f64 {
    let (a_high, a_low) = split(a);
    let (b_high, b_low) = split(b);
    ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low
}

/// Two halves of 26 bits; G. W. Veltkamp's trick, described by Dekker.
#[inline]
fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a; // 2²⁷ + 1
    let high = c - (c - a);
    (high, a - high)
}
