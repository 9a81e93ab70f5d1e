//! Writes positive rational numbers as a person would.

use crate::rational::Rational;

/// The form in which a positive number is written.
#[derive(Debug, PartialEq)]
pub(super) enum Shape {
    /// `600`, `9.81`.
    Decimal(String),
    /// `1.5`, `-7` for 1.5·10⁻⁷.
    Scientific(String, i64),
    /// `1/3`.
    Fraction(String, String),
}

/// Fractions with these denominators stay fractions: ½ m v², and not 0.5 m v².
const SMALL_DENOMINATORS: [i64; 10] = [2, 3, 4, 5, 6, 7, 8, 9, 12, 16];
/// Decimals with more digits than this after the point are written as fractions, since they were
/// probably written so.
const MOST_PLACES: usize = 12;

/// The form of a nonnegative number.
pub(super) fn shape(number: &Rational) -> Shape {
    let fraction = || {
        let text = number.to_string();
        match text.split_once('/') {
            Some((above, below)) => Shape::Fraction(above.to_owned(), below.to_owned()),
            None => Shape::Decimal(text),
        }
    };
    if number.is_integer() {
        let digits = number.to_string();
        let significant = digits.trim_end_matches('0').len();
        if digits.len() > 6 && digits.len() >= significant + 6 {
            return scientific(&digits[..significant], digits.len() as i64);
        }
        return Shape::Decimal(digits);
    }
    let (Some(above), Some(below)) = (number.numerator(), number.denominator()) else {
        return fraction();
    };
    if SMALL_DENOMINATORS.contains(&below) {
        return fraction();
    }
    let Some(places) = (1..=MOST_PLACES).find(|&n| 10i64.pow(n as u32) % below == 0) else {
        return fraction();
    };
    let digits = i128::from(above) * i128::from(10i64.pow(places as u32) / below);
    let digits = format!("{digits:0>width$}", width = places + 1);
    let (integer, rest) = digits.split_at(digits.len() - places);
    let leading_zeros = rest.len() - rest.trim_start_matches('0').len();
    if integer == "0" && leading_zeros >= 3 {
        return scientific(&rest[leading_zeros..], -(leading_zeros as i64));
    }
    Shape::Decimal(format!("{integer}.{rest}"))
}

/// `d.ddd·10^n` for `0.ddd·10^point`.
fn scientific(digits: &str, point: i64) -> Shape {
    let (first, rest) = digits.split_at(1);
    let mantissa = if rest.is_empty() {
        first.to_owned()
    } else {
        format!("{first}.{rest}")
    };
    Shape::Scientific(mantissa, point - 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(number: &str) -> String {
        match shape(&Rational::parse_decimal(number).expect("a number")) {
            Shape::Decimal(text) => text,
            Shape::Scientific(mantissa, exponent) => format!("{mantissa}e{exponent}"),
            Shape::Fraction(above, below) => format!("{above}/{below}"),
        }
    }

    #[test]
    fn numbers_look_as_they_were_typed() {
        for typed in [
            "0",
            "600",
            "9.81",
            "9.225",
            "0.05",
            "300000",
            "2.1e11",
            "1e-7",
            "1.25e-5",
            "0.001",
            "123456.789",
        ] {
            assert_eq!(text(typed), typed);
        }
        assert_eq!(text("0.5"), "1/2");
        assert_eq!(text("0.0001"), "1e-4");
        assert_eq!(text("1e7"), "1e7");
        assert_eq!(
            shape(&Rational::new(22, 21).expect("a number")),
            Shape::Fraction("22".into(), "21".into())
        );
    }
}
