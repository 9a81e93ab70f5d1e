//! Tables of reference values: each line holds a time and decimal numbers
//! with more digits than `f64` has.

use lagrangian_scalar::DoubleDouble;
use lagrangian_symbolic::Rational;

/// One line of a table.
pub struct Row {
    pub t: f64,
    /// Each number to 30 digits.
    pub exact: Vec<DoubleDouble>,
    /// Each number rounded to the nearest `f64`.
    pub values: Vec<f64>,
}

impl Row {
    /// A row of values that were computed in `f64` from a formula.
    pub fn of(t: f64, values: &[f64]) -> Self {
        Self {
            t,
            exact: values.iter().map(|&x| x.into()).collect(),
            values: values.to_vec(),
        }
    }
}

/// Reads a table; `#` starts a comment.
pub fn table(text: &str) -> Vec<Row> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.map(row).collect()
}

fn row(line: &str) -> Row {
    let mut words = line.split_whitespace();
    let t = words
        .next()
        .and_then(|t| t.parse().ok())
        .expect("a line starts with the time");
    let exact: Vec<DoubleDouble> = words
        .map(|digits| {
            Rational::parse_decimal(digits)
                .expect("a decimal number")
                .evaluate()
        })
        .collect();
    Row {
        t,
        values: exact.iter().map(|number| number.hi()).collect(),
        exact,
    }
}

/// The greatest of `|yᵢ − refᵢ| / (sᵢ + |refᵢ|)`.
pub fn error(y: &[f64], reference: &Row, scales: &[f64]) -> f64 {
    assert_eq!(y.len(), reference.exact.len());
    assert_eq!(y.len(), scales.len());
    let errors = y
        .iter()
        .zip(&reference.exact)
        .zip(scales)
        .map(|((&y, &exact), scale)| {
            let difference = DoubleDouble::from(y) - exact;
            difference.hi().abs() / (scale + exact.hi().abs())
        });
    greatest(errors)
}

/// The largest of some numbers, or NaN if one of them is NaN.
pub fn greatest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |a: f64, b: f64| if b <= a { a } else { b };
    numbers.into_iter().fold(0.0, larger)
}
