//! The values of options: assignments, numbers, tolerances.

use lagrangian::LEAST_RELATIVE_TOLERANCE;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::resolve::value_in;
use lagrangian_spec::source::Sources;
use lagrangian_spec::token::normalized;
use lagrangian_symbolic::Rational;

/// `name=value`.
#[derive(Clone, Debug, PartialEq)]
pub struct Assignment {
    /// The name, possibly of a member of a family: `q[3]`.
    pub name: String,
    /// The value: an expression of numbers and units in the syntax of a spec.
    pub value: String,
}

impl Assignment {
    /// The value in a unit, interpreted like the default of a parameter with that unit in a spec.
    ///
    /// # Errors
    /// If the value is invalid, with the message that a spec would give.
    pub fn value(&self, option: &str, unit: &str) -> Result<f64, String> {
        // Most values are plain numbers.
        if let Ok(value) = self.value.parse::<f64>()
            && value.is_finite()
        {
            return Ok(value);
        }
        let (mut sources, mut report) = (Sources::new(), Report::new());
        let value = value_in(&self.value, unit, &mut sources, &mut report);
        value.ok_or_else(|| {
            let wrong = report
                .diagnostics()
                .into_iter()
                .map(|wrong| match &wrong.help {
                    Some(help) => format!("{}; {help}", wrong.message),
                    None => wrong.message.clone(),
                });
            let wrong: Vec<String> = wrong.collect();
            format!(
                "{option} {}={}: {}",
                self.name,
                self.value,
                wrong.join("; ")
            )
        })
    }
}

/// Reads `name=value`.
pub fn assignment(text: &str) -> Result<Assignment, String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=VALUE")?;
    let name = name.trim();
    if name.is_empty() {
        return Err("expected a name before `=`".into());
    }
    if value.trim().is_empty() {
        return Err("expected a value after `=`".into());
    }
    Ok(Assignment {
        name: normalized(name).into_owned(),
        value: value.trim().to_owned(),
    })
}

/// Reads `name=value` for a constant, exactly.
pub(super) fn constant(text: &str) -> Result<(String, Rational), String> {
    let (name, value) = text.split_once('=').ok_or("expected NAME=VALUE")?;
    let (sign, digits) = match value.trim().strip_prefix('-') {
        Some(digits) => (Rational::from(-1), digits),
        None => (Rational::ONE, value.trim()),
    };
    let name = name.trim();
    if name.is_empty() {
        return Err("expected a name before `=`".into());
    }
    match Rational::parse_decimal(digits) {
        Some(value) => Ok((normalized(name).into_owned(), &value * &sign)),
        None => Err(format!("`{value}` is not a number (as in 8, 2.5, 1e-3)")),
    }
}

/// Parses the number of states that a function evaluates at once.
pub(super) fn lanes(text: &str) -> Result<u8, String> {
    match text.trim() {
        "2" => Ok(2),
        "4" => Ok(4),
        "8" => Ok(8),
        _ => Err("expected 2, 4 or 8".into()),
    }
}

/// Parses a tolerance, which must be larger than round-off.
pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    let tolerance = number(text)?;
    let least = LEAST_RELATIVE_TOLERANCE;
    match tolerance {
        _ if tolerance <= 0.0 => Err("a tolerance must be greater than 0".into()),
        _ if tolerance < least => Err(format!(
            "the least tolerance is {least:.1e}, which is the limit of round-off"
        )),
        _ if tolerance >= 1.0 => Err("a tolerance must be less than 1".into()),
        _ => Ok(tolerance),
    }
}

/// Parses a tolerance for numbers that may have more digits than `f64`.
pub(super) fn wide_tolerance(text: &str) -> Result<f64, String> {
    match number(text)? {
        least if least > 0.0 && least < LEAST_WIDE_TOLERANCE => Err(format!(
            "the least tolerance in double-double is {LEAST_WIDE_TOLERANCE:.1e}, which is the limit of round-off"
        )),
        wide if wide > 0.0 && wide < LEAST_RELATIVE_TOLERANCE => Ok(wide),
        _ => tolerance(text),
    }
}

/// Ten roundings of a sum of double-doubles.
const LEAST_WIDE_TOLERANCE: f64 = 10.0 * f64::EPSILON * f64::EPSILON;

/// Parses the recording interval.
pub(super) fn interval(text: &str) -> Result<f64, String> {
    let interval = number(text)?;
    if interval > 0.0 {
        Ok(interval)
    } else {
        Err("an interval must be greater than 0".into())
    }
}

/// Parses a positive number.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    let value = number(text)?;
    if value > 0.0 {
        Ok(value)
    } else {
        Err("expected a number greater than 0".into())
    }
}

/// Parses a limit of steps.
pub(super) fn steps(text: &str) -> Result<usize, String> {
    // `1e8` is accepted as an integer.
    let steps = number(text)?;
    if (1.0..=1e15).contains(&steps) && steps.fract() == 0.0 {
        Ok(steps as usize)
    } else {
        Err("expected a whole number from 1 to 1e15".into())
    }
}

/// Parses a count.
pub fn count(text: &str) -> Result<u64, String> {
    let count = number(text)?;
    if (1.0..=(1u64 << 40) as f64).contains(&count) && count.fract() == 0.0 {
        Ok(count as u64)
    } else {
        Err("expected a whole number from 1 to 2^40".into())
    }
}

/// Parses a finite number, or a product or quotient of numbers and `pi`: `50*pi`, `-pi/2`.
pub fn number(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let value = product(text)
        .ok_or_else(|| format!("`{text}` is not a number (as in 2.5, 1e-3, 50*pi, -pi/2)"))?;
    if value.is_finite() {
        Ok(value)
    } else {
        Err(format!("`{text}` is not a finite number"))
    }
}

fn product(text: &str) -> Option<f64> {
    let (sign, mut rest) = match text.strip_prefix('-') {
        Some(rest) if rest.starts_with('-') => return None,
        Some(rest) => (-1.0, rest),
        None => (1.0, text),
    };
    let mut value = sign;
    let mut divide = false;
    loop {
        let end = rest.find(['*', '/']).unwrap_or(rest.len());
        let factor = match rest.get(..end)?.trim() {
            "pi" => std::f64::consts::PI,
            other => other.parse().ok()?,
        };
        value = if divide {
            value / factor
        } else {
            value * factor
        };
        match rest.get(end..).and_then(|rest| rest.chars().next()) {
            None => return Some(value),
            Some(operator) => divide = operator == '/',
        }
        rest = rest.get(end + 1..)?;
    }
}
