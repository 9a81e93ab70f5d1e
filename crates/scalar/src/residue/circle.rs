//! The points of the unit circle and the roots of unity in the field, and the angles that belong to them.

use super::field::{Field, P};
use super::ratio::Ratio;
use super::two_adic::TwoAdic;

/// log₂ of the order of the circle group.
pub(super) const CIRCLE_BITS: u32 = 61;

/// A logarithm on the circle that this power of 2 divides is taken for a fraction of π, whose denominator is then at most 2¹².
const SIMPLE_TURN_BITS: u32 = 48;

/// ((4 + i)/(4 − i))⁷: a point of order 2⁶¹, chosen among its odd powers such that g^(2⁵⁹) = i, the
/// right angle, and g^(2⁵⁸) = (1 + i)/√2.
pub(super) const GENERATOR: Field = Field {
    re: 508_119_004_661_630_789,
    im: 1_119_946_030_696_053_400,
};

/// An element of GF(p) of order (p − 1)/2 = 3²·5²·7·11·13·31·41·61·151·331·1321, 109², chosen
/// such that the third root of unity made from it is (−1 + i√3)/2 and the fifth has the real part
/// (√5 − 1)/4.
pub(super) const ODD_ROOT: Field = Field::real(11_881);

/// The order of [`ODD_ROOT`].
pub(super) const ODD_ORDER: i64 = (P / 2) as i64;

/// ζ(b) = e^{iπb} and its inverse, if the field has roots of unity of that order.
///
/// With b/2 = n/(2^k m), m odd, the root is a product of one of order 2^k, a power of the circle's
/// generator, and one of order m, a power of [`ODD_ROOT`], by 1/(2^k m) ≡ u/2^k + w/m (mod 1), u =
/// 1/m mod 2^k, w = 1/2^k mod m.
pub(super) fn root_of_unity(b: Ratio) -> Option<(Field, Field)> {
    let k = b.denominator.trailing_zeros() + 1;
    let m = b.denominator >> (k - 1);
    if k > CIRCLE_BITS || ODD_ORDER % m != 0 {
        return None;
    }
    let n = b.numerator;
    let on_circle = (TwoAdic::integer(n) / TwoAdic::integer(m))
        .modulo_power_of_two(CIRCLE_BITS)
        .map(|power| GENERATOR.pow(power << (CIRCLE_BITS - k)))?;
    // 1/2 mod m is (m + 1)/2.
    let mut w = 1 % m;
    for _ in 0..k {
        w = (w as i128 * ((m + 1) / 2) as i128 % m as i128) as i64;
    }
    let power = n.rem_euclid(m) as i128 * w as i128 % m as i128;
    let odd = ODD_ROOT.pow(power as u64 * (ODD_ORDER / m) as u64);
    let odd_inverse = ODD_ROOT.pow((m - power as i64) as u64 * (ODD_ORDER / m) as u64);
    Some((on_circle * odd, on_circle.conjugate() * odd_inverse))
}

/// n of a point gⁿ of the circle, bit by bit from the lowest: gⁿ raised to the power 2⁶⁰ is −1 if n
/// is odd, 1 if even.
///
/// S. Pohlig and M. Hellman, *An improved algorithm for computing logarithms over GF(p)*, IEEE
/// Trans. Inf. Theory 24 (1978) 106–110.
pub(super) fn circle_logarithm(mut point: Field) -> u64 {
    let mut log = 0;
    // g^(−2^k)
    let mut step = GENERATOR.conjugate();
    for k in 0..CIRCLE_BITS {
        let last = (k + 1..CIRCLE_BITS).fold(point, |x, _| x * x);
        if last != Field::ONE {
            log |= 1 << k;
            point = point * step;
        }
        step = step * step;
    }
    log
}

/// b ∈ (−1, 1] with g^log = e^{iπb}, if b has at most 12 halvings.
pub(super) fn simple_turn(log: u64) -> Option<Ratio> {
    let half_turn = 1i64 << (CIRCLE_BITS - 1);
    let mut signed = log as i64;
    if signed > half_turn {
        signed -= 2 * half_turn;
    }
    if signed.trailing_zeros() < SIMPLE_TURN_BITS {
        return None;
    }
    Ratio::new(signed as i128, half_turn as i128)
}
