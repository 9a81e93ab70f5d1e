//! Rational numbers of 64 bits, for values that are known exactly.

/// numerator / denominator in lowest terms, denominator > 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ratio {
    pub numerator: i64,
    pub denominator: i64,
}

impl Ratio {
    pub const ZERO: Ratio = Ratio::integer(0);
    pub const ONE: Ratio = Ratio::integer(1);

    pub const fn integer(n: i64) -> Ratio {
        Ratio {
            numerator: n,
            denominator: 1,
        }
    }

    /// In lowest terms; none if it does not fit or if the denominator is 0.
    pub fn new(mut numerator: i128, mut denominator: i128) -> Option<Ratio> {
        if denominator < 0 {
            numerator = numerator.checked_neg()?;
            denominator = denominator.checked_neg()?;
        }
        let divisor = greatest_common_divisor(numerator.unsigned_abs(), denominator.unsigned_abs());
        if denominator == 0 {
            return None;
        }
        let divisor = divisor as i128;
        Some(Ratio {
            numerator: i64::try_from(numerator / divisor).ok()?,
            denominator: i64::try_from(denominator / divisor).ok()?,
        })
    }

    pub fn is_zero(self) -> bool {
        self.numerator == 0
    }

    /// −self; none for the only number whose negative does not fit.
    pub fn negative(self) -> Option<Ratio> {
        Some(Ratio {
            numerator: self.numerator.checked_neg()?,
            ..self
        })
    }

    pub fn plus(self, other: Ratio) -> Option<Ratio> {
        if self.denominator == 1 && other.denominator == 1 {
            // Most are whole.
            return self
                .numerator
                .checked_add(other.numerator)
                .map(Ratio::integer);
        }
        let (a, b) = (self.numerator as i128, self.denominator as i128);
        let (c, d) = (other.numerator as i128, other.denominator as i128);
        // |ad|, |bc| ≤ 2¹²⁶.
        Ratio::new(a * d + c * b, b * d)
    }

    pub fn times(self, other: Ratio) -> Option<Ratio> {
        if self.denominator == 1 && other.denominator == 1 {
            return self
                .numerator
                .checked_mul(other.numerator)
                .map(Ratio::integer);
        }
        Ratio::new(
            self.numerator as i128 * other.numerator as i128,
            self.denominator as i128 * other.denominator as i128,
        )
    }

    pub fn inverse(self) -> Option<Ratio> {
        Ratio::new(self.denominator as i128, self.numerator as i128)
    }

    /// Whether self < other.
    pub fn less_than(self, other: Ratio) -> bool {
        (self.numerator as i128) * (other.denominator as i128)
            < (other.numerator as i128) * (self.denominator as i128)
    }
}

fn greatest_common_divisor(mut a: u128, mut b: u128) -> u128 {
    while b != 0 {
        // 128-bit division is slow, and most numbers are short.
        let remainder = match (u64::try_from(a), u64::try_from(b)) {
            (Ok(a), Ok(b)) => (a % b) as u128,
            _ => a % b,
        };
        (a, b) = (b, remainder);
    }
    a.max(1)
}
