//! Combinations of numbers that can be estimated where the single numbers cannot.
//!
//! Along a null direction no residual changes, so the data determine only what is orthogonal to it. In the logarithms of the
//! numbers that is a product of powers, `k/m`; in the numbers themselves a sum, `m1 + m2`. Both solve the linear problem at the
//! minimum, so each is tested: the numbers are moved far along the direction with the product or the sum held constant, from
//! the minimum and from a point beside it, and the combination is reported only if no residual changes. If neither passes, a
//! sum is reported that holds for small changes.

use nalgebra::DMatrix;

/// The form of a combination.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CombinationForm {
    /// A product of powers.
    Product,
    /// A sum of multiples.
    Sum,
    /// A sum of multiples, valid for small changes only.
    Local,
}

/// A combination that the residuals determine.
#[derive(Clone, Debug, PartialEq)]
pub struct Combination {
    /// Its form.
    pub kind: CombinationForm,
    /// The numbers in it with their exponents or factors.
    pub terms: Vec<(usize, f64)>,
}

/// How far the numbers are moved for the test: by this power of e, and by this fraction of their size.
const FAR: f64 = 0.2;

/// The distance of the second test point from the minimum, relative to the sizes of the numbers.
const BESIDE: f64 = 0.05;

/// An exponent within this distance of a fraction with a denominator up to 6, plus the error of the derivatives, is
/// taken to be that fraction.
const NEAR: f64 = 1e-6;

/// The combinations of the entangled numbers that the residuals determine. `null` holds the null directions as columns, with a
/// row for each number; `is_same` tests whether the residuals are the same at two points.
pub fn combinations(
    x: &[f64],
    sizes: &[f64],
    null: &DMatrix<f64>,
    exact: f64,
    is_same: &mut dyn FnMut(&[f64], &[f64]) -> bool,
) -> Vec<Combination> {
    let involved: Vec<usize> = (0..x.len()).filter(|j| null.row(*j).norm() > 0.0).collect();
    if involved.is_empty() {
        return Vec::new();
    }
    let near = NEAR.max(exact.sqrt());
    // A combination that is constant on one of the surfaces of equal residuals need not be constant on the next.
    let mut beside = x.to_vec();
    for (a, j) in involved.iter().enumerate() {
        beside[*j] += BESIDE * sizes[*j] * (a + 1) as f64 / involved.len() as f64;
    }
    if involved.iter().all(|j| x[*j] != 0.0) {
        let logs = DMatrix::from_fn(involved.len(), null.ncols(), |a, i| {
            null[(involved[a], i)] / x[involved[a]]
        });
        let rows = across(&logs, &vec![1.0; involved.len()]);
        let rows: Option<Vec<Vec<f64>>> = rows
            .iter()
            .map(|row| row.iter().map(|e| fraction(*e, near)).collect())
            .collect();
        if let Some(rows) = rows {
            let still = along(&rows, involved.len());
            let moves = still.iter().all(|direction| {
                let most = direction.iter().fold(0.0, |most: f64, d| most.max(d.abs()));
                [x, &beside[..]].into_iter().all(|from| {
                    let mut to = from.to_vec();
                    for (j, d) in involved.iter().zip(direction) {
                        to[*j] *= (FAR * d / most).exp();
                    }
                    is_same(from, &to)
                })
            });
            if moves {
                return combinations_of_kind(CombinationForm::Product, &rows, &involved);
            }
        }
    }
    let plain = DMatrix::from_fn(involved.len(), null.ncols(), |a, i| null[(involved[a], i)]);
    let units: Vec<f64> = involved.iter().map(|j| sizes[*j]).collect();
    let rows = across(&plain, &units);
    let rows: Vec<Vec<f64>> = rows
        .iter()
        .map(|row| {
            let tidy = |c: &f64| fraction(*c, near).unwrap_or(*c);
            row.iter().map(tidy).collect()
        })
        .collect();
    let still = along(&rows, involved.len());
    let moves = still.iter().all(|direction| {
        let shares = direction
            .iter()
            .zip(&units)
            .map(|(d, unit)| (d / unit).abs());
        let most = shares.fold(0.0, f64::max);
        [x, &beside[..]].into_iter().all(|from| {
            let mut to = from.to_vec();
            for (j, d) in involved.iter().zip(direction) {
                to[*j] += FAR * d / most;
            }
            is_same(from, &to)
        })
    });
    let kind = if moves {
        CombinationForm::Sum
    } else {
        CombinationForm::Local
    };
    combinations_of_kind(kind, &rows, &involved)
}

fn combinations_of_kind(
    kind: CombinationForm,
    rows: &[Vec<f64>],
    involved: &[usize],
) -> Vec<Combination> {
    let combination = |row: &Vec<f64>| Combination {
        kind,
        terms: involved
            .iter()
            .copied()
            .zip(row.iter().copied())
            .filter(|(_, c)| *c != 0.0)
            .collect(),
    };
    rows.iter().map(combination).collect()
}

/// A basis of the orthogonal complement of the columns. Each vector has a 1 at a pivot of its own and 0 at the
/// pivots of the others. The pivots of the columns are the rows of greatest size, so those of the complement are
/// the remaining ones.
fn across(columns: &DMatrix<f64>, units: &[f64]) -> Vec<Vec<f64>> {
    let count = columns.nrows();
    let mut rest = DMatrix::from_fn(count, columns.ncols(), |a, i| columns[(a, i)] / units[a]);
    let mut pivots: Vec<usize> = Vec::new();
    for i in 0..columns.ncols() {
        let open: Vec<usize> = (0..count).filter(|a| !pivots.contains(a)).collect();
        // The remaining column with the largest entry is eliminated next.
        let weight = |k: usize| open.iter().map(|a| rest[(*a, k)].abs()).fold(0.0, f64::max);
        let best = (i..columns.ncols()).max_by(|a, b| weight(*a).total_cmp(&weight(*b)));
        rest.swap_columns(i, best.unwrap_or(i));
        let most = weight_of(&rest, &open, i);
        let Some(pivot) = open
            .iter()
            .rev()
            .copied()
            .find(|a| rest[(*a, i)].abs() >= 0.3 * most && most > 0.0)
        else {
            break;
        };
        pivots.push(pivot);
        let by = rest[(pivot, i)];
        for a in 0..count {
            rest[(a, i)] /= by;
        }
        for k in (0..columns.ncols()).filter(|k| *k != i) {
            let factor = rest[(pivot, k)];
            for a in 0..count {
                let value = rest[(a, i)];
                rest[(a, k)] -= factor * value;
            }
        }
    }
    // Each column has a 1 at its own pivot and 0 at those of others, so the complement can be read off.
    let others = (0..count).filter(|a| !pivots.contains(a));
    others
        .map(|a| {
            let mut row = vec![0.0; count];
            row[a] = 1.0;
            for (i, pivot) in pivots.iter().enumerate() {
                row[*pivot] = -rest[(a, i)] * units[a] / units[*pivot];
            }
            row
        })
        .collect()
}

fn weight_of(rest: &DMatrix<f64>, open: &[usize], column: usize) -> f64 {
    open.iter()
        .map(|a| rest[(*a, column)].abs())
        .fold(0.0, f64::max)
}

/// A basis of the null space of rows as [`across`] makes them.
fn along(rows: &[Vec<f64>], count: usize) -> Vec<Vec<f64>> {
    // Each row has a 1 at a place where all others have a 0.
    let pivots: Vec<usize> = rows
        .iter()
        .enumerate()
        .filter_map(|(r, row)| {
            (0..count).find(|a| {
                row[*a] == 1.0
                    && rows
                        .iter()
                        .enumerate()
                        .all(|(o, row)| o == r || row[*a] == 0.0)
            })
        })
        .collect();
    let others = (0..count).filter(|a| !pivots.contains(a));
    others
        .map(|a| {
            let mut direction = vec![0.0; count];
            direction[a] = 1.0;
            for (row, place) in rows.iter().zip(&pivots) {
                direction[*place] = -row[a];
            }
            direction
        })
        .collect()
}

/// The fraction with a small denominator nearest to a number, if it is within `near`.
fn fraction(value: f64, near: f64) -> Option<f64> {
    let fractions = (1..=6).map(|below| {
        let below = f64::from(below);
        (value * below).round() / below
    });
    let mut close = fractions.filter(|f| (f - value).abs() <= near * value.abs().max(1.0));
    close.next().map(|f| f + 0.0)
}

impl Combination {
    /// Its value.
    pub fn value(&self, x: &[f64]) -> f64 {
        let terms = self.terms.iter();
        match self.kind {
            CombinationForm::Product => terms.map(|(j, e)| x[*j].abs().powf(*e)).product(),
            CombinationForm::Sum | CombinationForm::Local => terms.map(|(j, c)| c * x[*j]).sum(),
        }
    }

    /// Its derivatives by all numbers.
    pub fn gradient(&self, x: &[f64]) -> Vec<f64> {
        let mut gradient = vec![0.0; x.len()];
        let value = self.value(x);
        for (j, c) in &self.terms {
            gradient[*j] = match self.kind {
                CombinationForm::Product => value * c / x[*j],
                CombinationForm::Sum | CombinationForm::Local => *c,
            };
        }
        gradient
    }

    /// As a formula in names: `k/m`, `m1 + 2*m2`.
    pub fn formula(&self, names: &[String]) -> String {
        match self.kind {
            CombinationForm::Product => product(&self.terms, names),
            CombinationForm::Sum | CombinationForm::Local => sum(&self.terms, names),
        }
    }

    /// Its unit in terms of the units of the numbers; `None` if the terms of a sum have different units.
    pub fn unit(&self, units: &[String]) -> Option<String> {
        match self.kind {
            CombinationForm::Product => {
                let with: Vec<(usize, f64)> = self
                    .terms
                    .iter()
                    .copied()
                    .filter(|(j, _)| units[*j] != "1")
                    .collect();
                let bracketed: Vec<String> = units.iter().map(|unit| bracketed(unit)).collect();
                Some(product(&with, &bracketed))
            }
            CombinationForm::Sum | CombinationForm::Local => {
                let first = self.terms.first().map(|(j, _)| units[*j].clone())?;
                let alike = self.terms.iter().all(|(j, _)| units[*j] == first);
                alike.then_some(first)
            }
        }
    }
}

/// A unit in parentheses if it is needed as a factor.
fn bracketed(unit: &str) -> String {
    if unit.contains(['*', '/', '^']) {
        format!("({unit})")
    } else {
        unit.to_owned()
    }
}

fn power(name: &str, exponent: f64) -> String {
    let below = (1..=6).find(|below| (exponent * f64::from(*below)).fract().abs() < 1e-9);
    match (exponent == 1.0, below) {
        (true, _) => name.to_owned(),
        (_, Some(1)) => format!("{name}^{exponent}"),
        (_, Some(below)) => {
            let above = (exponent * f64::from(below)).round();
            format!("{name}^({above}/{below})")
        }
        _ => format!("{name}^{exponent}"),
    }
}

fn product(terms: &[(usize, f64)], names: &[String]) -> String {
    let side = |sign: f64| -> Vec<String> {
        let of_sign = terms.iter().filter(|(_, e)| e * sign > 0.0);
        of_sign.map(|(j, e)| power(&names[*j], e.abs())).collect()
    };
    let (above, below) = (side(1.0), side(-1.0));
    let above = if above.is_empty() {
        "1".to_owned()
    } else {
        above.join("*")
    };
    match below.as_slice() {
        [] => above,
        [one] => format!("{above}/{one}"),
        _ => format!("{above}/({})", below.join("*")),
    }
}

fn sum(terms: &[(usize, f64)], names: &[String]) -> String {
    let mut text = String::new();
    for (place, (j, c)) in terms.iter().enumerate() {
        let sign = match (place, *c < 0.0) {
            (0, false) => "",
            (0, true) => "-",
            (_, false) => " + ",
            (_, true) => " - ",
        };
        text.push_str(sign);
        let size = c.abs();
        if size != 1.0 {
            let digits = format!("{size:.5e}");
            // The shortest form of six digits, without trailing zeros.
            let digits = digits.parse::<f64>().map_or(digits, |x| format!("{x}"));
            text.push_str(&format!("{digits}*"));
        }
        text.push_str(&names[*j]);
    }
    text
}
