//! Sine and cosine of up to eight angles at once.
//!
//! For |x| ≤ 100 000 both results are within 0.96 units in the last place of the exact value, also next to
//! multiples of π/2, where one of them vanishes; the largest measured error is 0.76
//! (`cargo test -p lagrangian-native --test sines -- --nocapture`). Beyond, and for NaN, the results are those of
//! the scalar library.
//!
//! **Reduction** (W. J. Cody and W. Waite, *Software Manual for the Elementary Functions*, 1980; here with fused
//! operations). k is the integer nearest to 2x/π, |k| ≤ 63 662 < 2¹⁶, and x − kπ/2 = r − l, |r| ≤ π/4·(1 + 2⁻³⁶).
//! π/2 is split into three parts, P₁ of 53 bits, P₂ of 36 and P₃ of 53. The following holds for x ≥ 0; −x takes the
//! same steps with all signs reversed, even those of zeros, because rounding is symmetric:
//!
//! * x − kP₁ is exact. For k ≥ 1, x ≥ π/4 and P₁ are multiples of 2⁻⁵³, so is the difference, and it is below 1.
//! * kP₂ is exact in 52 bits, and a multiple of 2⁻⁸⁹ below 2⁻³⁷·⁹. r is x − kP₁ − kP₂, rounded, and its rounding
//!   error is computed exactly: if x − kP₁ is above 2kP₂, it differs from r by a factor of at most 2, so their
//!   difference is exact (Sterbenz); otherwise r, a multiple of 2⁻⁸⁹ below 2⁻³⁶, was not rounded at all.
//! * l is the rounded sum of that error and kP₃: |l| ≤ ulp(r)/2 + 2⁻⁷⁵. Its error and that of P₁ + P₂ + P₃, 2⁻¹⁴⁵,
//!   times k, are below 2⁻¹²⁶, while no number of 53 bits up to 10⁵ comes closer to a multiple of π/2 than 2⁻⁶¹ (a
//!   test checks every multiple).
//!
//! **Polynomials** in z = r²: sin r = r + r·z·S(z), cos r = 1 − z/2 + z²·C(z), both of degree 5. They are minimax
//! for the relative errors of sin r and cos r, by the algorithm of Remez in 300 bits: after computing all
//! coefficients, the first was rounded to 53 bits and the others were computed again for it, and so on. Relative
//! errors: 2⁻⁵⁷·⁸ and 2⁻⁶³·⁹ (a test verifies both). They are evaluated by the scheme of G. Estrin (*Organization
//! of computer systems*, 1960), whose dependency chain has three operations instead of five.
//!
//! **Low part**: sin(r − l) = sin r − l(1 − z/2) and cos(r − l) = cos r + l·r, with errors up to 2⁻⁶⁰ and 2⁻⁵⁷·⁶.
//!
//! **Rounding**, u = 2⁻⁵³. In sin = r − c the correction c is at most 0.111 of the sine and has an error of 5.3u
//! (z, r·z and c itself 1 each, S 2.3): 0.59u of the sine, which is largest at √½, where it is 0.42 ulp. The
//! polynomial adds 0.02, l 0.01, the sum half an ulp: 0.95. In the cosine, 1 − z/2 is w + e, a number and its
//! rounding error, and z is not rounded before; z²C(z) ≤ 0.016 has an error of 6u: 0.1 ulp. Adding it takes 0.02, l
//! 0.04, the last sum half an ulp: 0.66.

use core::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use crate::vector::Vector;

/// The largest angle for which the polynomials are used.
pub const MOST: f64 = 100_000.0;

/// 1.5·2⁵²: the last place of numbers of this size is 1, so adding it rounds to an integer. The lowest bits of the
/// sum are those of the integer, for k < 0 in two's complement.
const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// P₁, P₂ and P₃.
const QUARTER: [f64; 3] = [FRAC_PI_2, 6.123233995707727e-17, 2.9038559739793605e-28];

/// S(z).
pub(crate) const SIN: [f64; 6] = [
    -0.1666666666666663,
    0.00833333333332184,
    -0.00019841269829358528,
    2.755731353851423e-6,
    -2.5050734389255114e-8,
    1.589543328902531e-10,
];

/// C(z).
pub(crate) const COS: [f64; 6] = [
    0.041666666666666595,
    -0.0013888888888873342,
    2.480158728900208e-5,
    -2.755731421703886e-7,
    2.0875705396029095e-9,
    -1.1358749239913932e-11,
];

/// Which angles are within the range of the polynomials.
#[inline(always)]
pub fn is_near<V: Vector>(x: V) -> V::Mask {
    x.abs().at_most(V::splat(MOST))
}

/// Sine and cosine of angles that are [near](is_near); the results for others are arbitrary.
#[inline(always)]
pub fn sin_cos_near<V: Vector>(x: V) -> (V, V) {
    let shifted = x.mul_add(V::splat(FRAC_2_PI), V::splat(ROUNDER));
    let k = shifted.sub(V::splat(ROUNDER));
    let [p1, p2, p3] = QUARTER.map(V::splat);
    let first = k.neg_mul_add(p1, x);
    let r = k.neg_mul_add(p2, first);
    let l = k.mul_add(p3, k.mul_add(p2, r.sub(first)));

    let one = V::ONE;
    let half_r = r.mul(V::splat(0.5));
    let z = r.mul(r);
    let z2 = z.mul(z);
    let w = r.neg_mul_add(half_r, one);
    let e = r.neg_mul_add(half_r, one.sub(w));
    // Signs are chosen such that the sine of −0 is −0: l is +0 there.
    let sin = r.sub(r.mul(z).neg_mul_add(polynomial(SIN, z, z2), l.mul(w)));
    let cos = w.add(e.add(z2.mul_add(polynomial(COS, z, z2), l.mul(r))));

    // Quadrants 0 to 3: (sin, cos), (cos, −sin), (−sin, −cos), (−cos, sin). The lowest bits of k, moved to the sign bit:
    let second = shifted.shift_left::<62>().and(V::splat(-0.0));
    let lowest = shifted.shift_left::<63>();
    let odd = shifted.is_odd();
    let sine = V::select(odd, cos, sin).xor(second);
    let cosine = V::select(odd, sin, cos).xor(second.xor(lowest));
    (sine, cosine)
}

/// c₀ + c₁z + … + c₅z⁵.
#[inline(always)]
fn polynomial<V: Vector>(c: [f64; 6], z: V, z2: V) -> V {
    let pair = |i: usize| z.mul_add(V::splat(c[i + 1]), V::splat(c[i]));
    z2.mul_add(z2.mul_add(pair(4), pair(2)), pair(0))
}
