//! Numbers with the digits with which a file gives them.

use std::f64::consts::PI;
use std::fmt;

/// Angles are compared with multiples of π/12.
const TWELFTH: f64 = PI / 12.0;

/// Larger multiples are not recognized.
const MOST_TWELFTHS: f64 = 24.0;

/// With fewer digits than these, an agreement with π may be accidental.
const DIGITS_OF_PI: i32 = 13;

/// The longest number that keeps its digits.
const LONGEST: usize = 40;

/// A number as written in a spec.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Its value, rounded once.
    pub value: f64,
    text: String,
    /// The number of significant digits, and the exponent of the last one.
    digits: i32,
    last: i32,
}

impl Number {
    /// Zero.
    pub fn zero() -> Number {
        Number {
            value: 0.0,
            text: "0".to_owned(),
            digits: 0,
            last: 0,
        }
    }

    /// Its negative, with the same digits.
    pub fn negated(&self) -> Number {
        let text = match self.text.strip_prefix('-') {
            Some(text) => text.to_owned(),
            None if self.is_zero() => self.text.clone(),
            None => format!("-{}", self.text),
        };
        Number {
            value: -self.value,
            text,
            ..*self
        }
    }

    /// A computed number, with the fewest digits that read back to it.
    pub fn computed(value: f64) -> Number {
        let text = format!("{value:?}");
        let short = text.strip_suffix(".0").unwrap_or(&text);
        Number::read(short).unwrap_or_else(|_| Number::zero())
    }

    /// Reads a number as XML files write it: a sign, decimal digits with an optional point, and an exponent.
    ///
    /// # Errors
    /// If the text is not a number: what is wrong with it.
    pub fn read(text: &str) -> Result<Number, String> {
        let malformed = || format!("`{text}` is not a number: write it like -0.25 or 2.5e-3");
        let (is_negative, unsigned) = match text.as_bytes().first() {
            Some(b'-') => (true, &text[1..]),
            Some(b'+') => (false, &text[1..]),
            _ => (false, text),
        };
        let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, Some(exponent)),
            None => (unsigned, None),
        };
        let (integer, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let is_decimal = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        if !is_decimal(integer) || !is_decimal(fraction) || integer.len() + fraction.len() == 0 {
            return Err(malformed());
        }
        let exponent: i32 = match exponent {
            None => 0,
            Some(exponent) => exponent.parse().map_err(|_| malformed())?,
        };
        let value: f64 = text.parse().map_err(|_| malformed())?;
        let has_digits = mantissa.bytes().any(|byte| matches!(byte, b'1'..=b'9'));
        if !has_digits {
            return Ok(Number::zero());
        }
        if !value.is_normal() {
            return Err(format!(
                "`{text}` is beyond the range of floating-point numbers: 2.2e-308 to 1.8e308"
            ));
        }
        let integer = integer.trim_start_matches('0');
        let digits = if fraction.is_empty() {
            integer.to_owned()
        } else if integer.is_empty() {
            format!("0.{fraction}")
        } else {
            format!("{integer}.{fraction}")
        };
        let digits = match exponent {
            0 => digits,
            _ => format!("{digits}e{exponent}"),
        };
        let sign = if is_negative { "-" } else { "" };
        let text = if digits.len() <= LONGEST {
            format!("{sign}{digits}")
        } else {
            format!("{value:?}")
        };
        let all = [integer, fraction].concat();
        let counted = all.trim_start_matches('0').len();
        let length = |text: &str| i32::try_from(text.len()).unwrap_or(i32::MAX);
        Ok(Number {
            value,
            text,
            digits: i32::try_from(counted).unwrap_or(i32::MAX),
            last: exponent.saturating_sub(length(fraction)),
        })
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        self.value == 0.0
    }

    /// Its text as the angle of a coordinate, a limit or an offset. Beyond a turn the unit is written, since a bare number
    /// of that size might be taken for degrees.
    pub fn in_radians(&self) -> String {
        if self.value.abs() > 2.0 * PI {
            format!("{}*rad", self.text)
        } else {
            self.text.clone()
        }
    }
}

impl Default for Number {
    fn default() -> Number {
        Number::zero()
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// A constant angle.
#[derive(Clone, Debug, PartialEq)]
pub enum Angle {
    /// An exact multiple of π/12.
    Twelfths(i32),
    /// Any other.
    Radians(Number),
}

impl Angle {
    /// The angle that a file gives. If it agrees with a multiple of 15° in 13 digits or more, it is taken to
    /// be that multiple.
    pub fn of(number: &Number) -> Angle {
        let unit = 10_f64.powi(number.last);
        // The last digit may be rounded or truncated, and the double that represents it is rounded too.
        let tolerance = unit.max(2.0 * f64::EPSILON * number.value.abs());
        if number.digits >= DIGITS_OF_PI || number.is_zero() {
            Angle::named(number, tolerance)
        } else {
            Angle::Radians(number.clone())
        }
    }

    /// An angle that was computed with a few roundings.
    pub fn computed(value: f64) -> Angle {
        Angle::named(&Number::computed(value), 4.0 * f64::EPSILON * value.abs())
    }

    fn named(number: &Number, tolerance: f64) -> Angle {
        let twelfths = (number.value / TWELFTH).round();
        let is_close = (number.value - twelfths * TWELFTH).abs() <= tolerance;
        let is_other_than_zero = twelfths != 0.0 || number.is_zero();
        if is_close && is_other_than_zero && twelfths.abs() <= MOST_TWELFTHS {
            Angle::Twelfths(twelfths as i32)
        } else {
            Angle::Radians(number.clone())
        }
    }

    /// Its value in radians.
    pub fn value(&self) -> f64 {
        match self {
            Angle::Twelfths(k) => f64::from(*k) * TWELFTH,
            Angle::Radians(number) => number.value,
        }
    }

    /// An angle in degrees; multiples of 15 are exact.
    pub fn of_degrees(number: &Number) -> Angle {
        let twelfths = number.value / 15.0;
        let is_whole = twelfths.fract() == 0.0 && twelfths.abs() <= MOST_TWELFTHS;
        if is_whole {
            Angle::Twelfths(twelfths as i32)
        } else {
            Angle::Radians(Number::computed(number.value.to_radians()))
        }
    }

    /// Whether it is zero.
    pub fn is_zero(&self) -> bool {
        *self == Angle::Twelfths(0)
    }

    /// The opposite angle.
    pub fn negated(&self) -> Angle {
        match self {
            Angle::Twelfths(k) => Angle::Twelfths(-k),
            Angle::Radians(number) => Angle::Radians(number.negated()),
        }
    }
}

impl fmt::Display for Angle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let k = match self {
            Angle::Radians(number) => return f.write_str(&number.in_radians()),
            Angle::Twelfths(k) => *k,
        };
        let mut common = 12;
        while 12 % common != 0 || k % common != 0 {
            common -= 1;
        }
        let sign = if k < 0 { "-" } else { "" };
        match (k.abs() / common, 12 / common) {
            (0, _) => f.write_str("0"),
            (1, 1) => write!(f, "{sign}pi"),
            (1, below) => write!(f, "{sign}pi/{below}"),
            (above, 1) => write!(f, "{sign}{above}*pi"),
            (above, below) => write!(f, "{sign}{above}*pi/{below}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_stay_as_they_are() {
        for (text, written) in [
            ("0.50", "0.50"),
            (".5", "0.5"),
            ("5.", "5"),
            ("+1E-3", "1e-3"),
            ("-007.250", "-7.250"),
            ("-0.0", "0"),
            ("0e99", "0"),
            ("1e+05", "1e5"),
            ("2.5e0", "2.5"),
        ] {
            let number = Number::read(text).expect(text);
            assert_eq!(number.to_string(), written);
            assert_eq!(number.value, text.parse::<f64>().expect(text));
            let again = Number::read(written).expect(written);
            assert_eq!(
                (again.to_string(), again.value),
                (written.into(), number.value)
            );
        }
        for text in [
            "",
            "-",
            ".",
            "1,5",
            "nan",
            "inf",
            "1e",
            "e5",
            "0x10",
            "1e999",
            "1e-999",
            "--1",
            "1 2",
            "٣",
            "1e99999999999",
        ] {
            assert!(Number::read(text).is_err(), "{text}");
        }
    }

    #[test]
    fn digits_of_pi_are_pi() {
        for (text, written) in [
            ("1.5707963267948966", "pi/2"),
            ("-1.570796326794", "-pi/2"),
            ("-1.570796326795", "-pi/2"),
            ("3.141592653589793", "pi"),
            ("0.78539816339744830961", "pi/4"),
            ("-2.0943951023931953", "-2*pi/3"),
            ("6.283185307179586", "2*pi"),
            // Too few digits, or different ones.
            ("1.5708", "1.5708"),
            ("1.570796327", "1.570796327"),
            ("1.57079632679", "1.57079632679"),
            ("1.570796326797", "1.570796326797"),
            ("7.5", "7.5*rad"),
            ("0", "0"),
            ("1e-12", "1e-12"),
        ] {
            let number = Number::read(text).expect(text);
            let angle = Angle::of(&number);
            assert_eq!(angle.to_string(), written);
            assert_eq!(angle.negated().negated(), angle);
        }
        assert_eq!(Angle::computed(1_f64.atan2(-1.0)).to_string(), "3*pi/4");
        assert_eq!(Angle::computed(1e-300).to_string(), "1e-300");
    }
}
