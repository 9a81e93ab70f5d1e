//! Coefficients to more digits than `f64` has, parsed from their decimals at compile time.
//!
//! A coefficient is published as a decimal or as a fraction. The tableau holds the nearest `f64`; this module computes the remainder, so
//! that the two together have some 31 digits.

/// A number as the unevaluated sum of two `f64`, the second at most half a unit in the last place of the first. The operations are the ones
/// on double-doubles that are possible in constants.
#[derive(Clone, Copy)]
pub(super) struct Pair(pub f64, pub f64);

/// `a + b` exactly.
const fn two_sum(a: f64, b: f64) -> Pair {
    let sum = a + b;
    let b_seen = sum - a;
    let a_seen = sum - b_seen;
    Pair(sum, (a - a_seen) + (b - b_seen))
}

/// Splits a number into two halves of 26 bits, whose products are exact. T. J. Dekker, *A floating-point technique for extending the
/// available precision*, Numer. Math. 18 (1971) 224–242.
const fn halves(x: f64) -> [f64; 2] {
    let far = 134_217_729.0 * x; // 2²⁷ + 1
    let high = far - (far - x);
    [high, x - high]
}

/// `a b` exactly.
const fn two_product(a: f64, b: f64) -> Pair {
    let product = a * b;
    let ([a1, a2], [b1, b2]) = (halves(a), halves(b));
    Pair(product, ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2)
}

impl Pair {
    /// The sum.
    pub const fn plus(self, other: Self) -> Self {
        let (high, low) = (two_sum(self.0, other.0), two_sum(self.1, other.1));
        let high = two_sum(high.0, high.1 + low.0);
        two_sum(high.0, high.1 + low.1)
    }

    /// The product.
    pub const fn times(self, other: Self) -> Self {
        let product = two_product(self.0, other.0);
        two_sum(product.0, product.1 + (self.0 * other.1 + self.1 * other.0))
    }

    /// The quotient, by long division with three digits of 53 bits.
    const fn over(self, other: Self) -> Self {
        let mut rest = self;
        let mut quotient = Pair(0.0, 0.0);
        let mut digits = 0;
        while digits < 3 {
            let digit = rest.0 / other.0;
            rest = rest.plus(other.times(Pair(-digit, 0.0)));
            quotient = quotient.plus(Pair(digit, 0.0));
            digits += 1;
        }
        quotient
    }

    /// The remainder of this number after `high`.
    pub const fn beyond(self, high: f64) -> f64 {
        (self.0 - high) + self.1
    }

    /// An integer below 2¹⁰⁶, or one whose nonzero bits span at most 106, exactly.
    const fn integer(n: u128) -> Self {
        let high = n as f64;
        Pair(high, (n as i128 - high as i128) as f64)
    }
}

/// The remainder after the `f64` of a coefficient that is written as `-0.25` or as `44.0 / 45.0`.
pub(super) const fn beyond(text: &str, high: f64) -> f64 {
    let text = text.as_bytes();
    let (mut number, mut divided, mut is_negative) = (None, None, false);
    let (mut digits, mut places, mut behind_point) = (0_u128, 0, false);
    let mut i = 0;
    while i <= text.len() {
        let letter = if i < text.len() { text[i] } else { b'/' };
        match letter {
            b'-' => is_negative = !is_negative,
            b'.' => behind_point = true,
            b'0'..=b'9' => {
                digits = 10 * digits + (letter - b'0') as u128;
                places += behind_point as u32;
            }
            b'/' => {
                let scale = 10_u128.pow(places);
                // The nonzero bits of a power of ten are few enough for a pair.
                assert!(digits >> 106 == 0 && scale >> 126 == 0);
                let read = Pair::integer(digits).over(Pair::integer(scale));
                match number {
                    None => number = Some(read),
                    Some(_) => divided = Some(read),
                }
                (digits, places, behind_point) = (0, 0, false);
            }
            b' ' => {}
            _ => panic!("a coefficient is a decimal or a fraction"),
        }
        i += 1;
    }
    let exact = match (number, divided) {
        (Some(number), Some(divided)) => number.over(divided),
        (Some(number), None) => number,
        (None, _) => panic!("a coefficient has digits"),
    };
    let sign = if is_negative { -1.0 } else { 1.0 };
    Pair(sign * exact.0, sign * exact.1).beyond(high)
}

/// The remainders after the `f64` of a tableau, if they are known.
#[derive(Clone, Copy)]
pub(crate) struct Beyond {
    /// One for each node.
    pub c: &'static [f64],
    /// One for each entry of the rows.
    pub a: &'static [&'static [f64]],
    /// Those of the error estimate, whose weights sum to 0 in all digits.
    pub error: &'static [f64],
    /// Those of the coarser estimate.
    pub coarse_error: &'static [f64],
    /// Those of the rows of dense output.
    pub dense: &'static [&'static [f64]],
}

/// Defines nodes, rows, error estimates and dense output as the constants `C`, `A`, `ERROR`, `COARSE` and `DENSE`, and the remainders after
/// these as `BEYOND`.
macro_rules! coefficients {
    (
        c: [$($c:expr),* $(,)?],
        a: [$([$($a:expr),* $(,)?]),* $(,)?],
        error: [$($error:expr),* $(,)?],
        coarse_error: [$($coarse:expr),* $(,)?],
        dense: [$([$($dense:expr),* $(,)?]),* $(,)?] $(,)?
    ) => {
        const C: &[f64] = &[$($c),*];
        const A: &[&[f64]] = &[$(&[$($a),*]),*];
        const ERROR: &[f64] = &[$($error),*];
        #[allow(dead_code, reason = "only some methods have a coarser estimate")]
        const COARSE: &[f64] = &[$($coarse),*];
        const DENSE: &[&[f64]] = &[$(&[$($dense),*]),*];
        pub(super) const BEYOND: super::digits::Beyond = super::digits::Beyond {
            c: &[$(super::digits::beyond(stringify!($c), $c)),*],
            a: &[$(&[$(super::digits::beyond(stringify!($a), $a)),*]),*],
            error: &[$(super::digits::beyond(stringify!($error), $error)),*],
            coarse_error: &[$(super::digits::beyond(stringify!($coarse), $coarse)),*],
            dense: &[$(&[$(super::digits::beyond(stringify!($dense), $dense)),*]),*],
        };
    };
}
pub(super) use coefficients;
