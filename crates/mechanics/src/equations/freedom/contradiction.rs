//! Finds constraints that contradict each other at the start of a machine.
//!
//! The sum of the squares of all residuals is minimized. If its minimum is not 0 and no displacement
//! decreases it, the residuals are a linear combination of the rows that vanishes, `Gᵀ r = 0` with
//! `r ≠ 0`: the constraints in that combination cannot be satisfied together. Constraints of rates
//! contradict each other if such a combination of `G v = −b` leaves a part of `b`.

use lagrangian_scalar::{DoubleDouble, Scalar};
use lagrangian_spec::diagnostic::{Code, Diagnostic, Report};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::evaluate;

use super::{Configurations, MOST_ENTRIES, Row, dot, length};
use crate::equations::Equations;
use crate::equations::constraints::{rates_at_rest, spans};

/// The largest number of steps of the minimization: each gains one bit if the minimum is not 0.
const STEPS: usize = 300;

/// Residuals at least this large, as distances relative to the largest coordinate or 1, are a contradiction.
/// Numbers of a spec are rounded at 2e-16.
const MIN_CONTRADICTION: f64 = 1e-11;

/// The residuals cannot be decreased if `Gᵀ r` is at most this fraction of them. At places that satisfy the constraints,
/// even tangentially like two touching circles, it decreases no faster than the square root of the residuals.
const STATIONARY: f64 = 1e-8;

/// A constraint takes part in a contradiction if its residual is at least this fraction of the largest one.
const PARTICIPATION: f64 = 1e-4;

/// Warns if constraints contradict each other at the start, with the default parameters. Machines with a
/// parameter without a default are skipped, and so are those too large for counting their freedom.
pub fn contradictions<'d>(model: &Model<'d>, equations: &Equations<'d>, report: &mut Report) {
    let constraints = &equations.constraints;
    let is_known = model.parameters.iter().all(|p| p.default.is_some());
    let entries = model.coordinates.len() * constraints.len();
    if !is_known || entries == 0 || entries > MOST_ENTRIES {
        return;
    }
    let places = Configurations::new(model, constraints);
    let Some(start) = places.start() else {
        return;
    };
    // Constraints of positions come first.
    let of_places = (0..constraints.len()).filter(|k| constraints[*k].position.is_some());
    let of_rates = (0..constraints.len()).filter(|k| constraints[*k].position.is_none());
    let order: Vec<usize> = of_places.chain(of_rates).collect();
    let found = match places.consistent_configuration(start.clone()) {
        Some(place) => places.contradicting_rates(&place, {
            let at_rest = rates_at_rest(model, constraints);
            let values = places.symbol_values(&place);
            let zero = DoubleDouble::from_f64(0.0);
            let value = |symbol| values.get(&symbol).copied().unwrap_or(zero);
            let rates = evaluate(model.dag, &at_rest, value);
            order.iter().map(|k| rates[*k]).collect()
        }),
        None => places.contradicting_positions(start),
    };
    let Some(mut found) = found else {
        return;
    };
    found.residuals.sort_unstable_by_key(|miss| order[miss.0]);
    let Some(&(last, miss)) = found.residuals.last() else {
        return;
    };
    let name = |k: usize| format!("`{}`", constraints[order[k]].name);
    let spans = spans(model);
    let unit = if found.of_rates {
        constraints[order[last]].rate_unit()
    } else {
        constraints[order[last]].unit
    };
    let others: Vec<String> = found.residuals.iter().map(|(k, _)| name(*k)).collect();
    let others = &others[..others.len() - 1];
    let miss = format!("{:.2e} {}", miss.abs(), unit);
    let miss = miss.trim_end_matches(" 1");
    let (message, help) = match others {
        [] => (
            format!(
                "the constraint {} cannot be met near the start: its residual is {miss} at best",
                name(last)
            ),
            "give a start from which it can be met, or other parameters",
        ),
        _ => (
            format!(
                "the constraint {} contradicts {} near the start: its residual is {miss} where all constraints are best satisfied",
                name(last),
                others.join(", ")
            ),
            "leave one of them out, or give a start or parameters with which all can be met",
        ),
    };
    let mut warning = Diagnostic::new(Code::Contradiction, spans[order[last]], message).help(help);
    for (k, _) in &found.residuals[..others.len()] {
        if spans[order[*k]] != spans[order[last]] {
            warning = warning.note(spans[order[*k]], "what it contradicts");
        }
    }
    report.push(warning);
}

/// Constraints that cannot be satisfied together.
struct Contradiction {
    of_rates: bool,
    /// Constraints, those of positions first, and their residuals, each in its unit.
    residuals: Vec<(usize, f64)>,
}

impl Configurations<'_, '_> {
    /// The contradiction at the minimum of the sum of squares, if that is not 0.
    fn contradicting_positions(&self, mut place: Row) -> Option<Contradiction> {
        let look = |place: &Row| {
            let (residuals, mut rows) = self.at(place)?;
            rows.truncate(self.position_constraints);
            Some((residuals, rows))
        };
        let (mut residuals, mut rows) = look(&place)?;
        let sizes: Vec<DoubleDouble> = rows.iter().map(size).collect();
        let scale = |residuals: &mut Row, rows: &mut [Row]| {
            for ((residual, row), &size) in residuals.iter_mut().zip(rows).zip(&sizes) {
                *residual = *residual / size;
                row.iter_mut().for_each(|entry| *entry = *entry / size);
            }
        };
        scale(&mut residuals, &mut rows);
        let mut damping = 1e-3;
        for _ in 0..STEPS {
            let squares = dot(&residuals, &residuals);
            let gradient = transposed_times(&rows, &residuals);
            let off = length(&residuals);
            if length(&gradient) <= STATIONARY * off {
                let reach = place.iter().map(|q| q.to_f64().abs()).fold(1.0, f64::max);
                let most = largest(&residuals);
                let misses = residuals.iter().zip(&sizes).enumerate();
                let misses = misses.filter(|(_, (r, _))| r.to_f64().abs() > PARTICIPATION * most);
                let misses = misses.map(|(k, (&r, &size))| (k, (r * size).to_f64()));
                return (most > MIN_CONTRADICTION * reach).then(|| Contradiction {
                    of_rates: false,
                    residuals: misses.collect(),
                });
            }
            // K. Levenberg, A method for the solution of certain non-linear problems in least squares, 1944.
            let step = damped_step(&rows, &residuals, &gradient, damping)?;
            let there: Row = place.iter().zip(step).map(|(&q, d)| q - d).collect();
            let scaled = look(&there).map(|(mut residuals, mut rows)| {
                scale(&mut residuals, &mut rows);
                (residuals, rows)
            });
            match scaled {
                Some(seen) if dot(&seen.0, &seen.0) < squares => {
                    (residuals, rows) = seen;
                    place = there;
                    damping = (0.1 * damping).max(1e-20);
                }
                _ if damping > 1e12 => return None,
                _ => damping *= 10.0,
            }
        }
        None
    }

    /// The contradiction in the rates: the part of `at_rest` that dependent rows leave, at a place that
    /// satisfies the constraints.
    fn contradicting_rates(&self, place: &Row, at_rest: Row) -> Option<Contradiction> {
        let (_, rows) = self.at(place)?;
        let sizes: Vec<DoubleDouble> = rows.iter().map(size).collect();
        let rates: Row = at_rest.iter().zip(&sizes).map(|(&b, &s)| b / s).collect();
        let most = largest(&rates);
        // Vanishing combinations of the rows are orthogonal to the columns of G.
        let width = place.len();
        let column = |j: usize| {
            let entries = rows.iter().zip(&sizes);
            entries.map(|(row, &size)| row[j] / size).collect::<Row>()
        };
        let columns: Vec<Row> = (0..width).map(column).collect();
        let left = super::orthogonal_part(&super::orthonormalized(&columns), rates);
        let worst = largest(&left);
        // Places are known to 1e-14 if rows depend on each other only there.
        (worst > 1e-9 * most).then(|| {
            let misses = left.iter().zip(&sizes).enumerate();
            let misses = misses.filter(|(_, (r, _))| r.to_f64().abs() > PARTICIPATION * worst);
            Contradiction {
                of_rates: true,
                residuals: misses.map(|(k, (&r, &s))| (k, (r * s).to_f64())).collect(),
            }
        })
    }
}

fn largest(row: &Row) -> f64 {
    row.iter().map(|x| x.to_f64().abs()).fold(0.0, f64::max)
}

/// The divisor that normalizes a row.
fn size(row: &Row) -> DoubleDouble {
    let length = length(row);
    DoubleDouble::from_f64(if length > 0.0 { length } else { 1.0 })
}

/// `Gᵀ r`.
fn transposed_times(rows: &[Row], residuals: &Row) -> Row {
    let width = rows.first().map_or(0, Vec::len);
    let zero = DoubleDouble::from_f64(0.0);
    let entry = |j: usize| {
        let terms = rows.iter().zip(residuals);
        terms.fold(zero, |sum, (row, &r)| sum + row[j] * r)
    };
    (0..width).map(entry).collect()
}

/// `(Gᵀ G + μ)⁻¹ Gᵀ r`, or the equal `Gᵀ (G Gᵀ + μ)⁻¹ r` if there are fewer rows than columns.
fn damped_step(rows: &[Row], residuals: &Row, gradient: &Row, damping: f64) -> Option<Row> {
    if rows.len() < gradient.len() {
        let weights = solved(rows, residuals, damping)?;
        return Some(transposed_times(rows, &weights));
    }
    let column = |j: usize| rows.iter().map(|row| row[j]).collect::<Row>();
    let columns: Vec<Row> = (0..gradient.len()).map(column).collect();
    solved(&columns, gradient, damping)
}

/// `(R Rᵀ + μ)⁻¹ b`, by Cholesky factorization.
fn solved(rows: &[Row], right: &Row, damping: f64) -> Option<Row> {
    let count = rows.len();
    let mut lower = vec![vec![DoubleDouble::from_f64(0.0); count]; count];
    let mut solved = right.clone();
    for i in 0..count {
        for j in 0..=i {
            let mut left = dot(&rows[i], &rows[j]) - dot(&lower[i][..j], &lower[j][..j]);
            if i == j {
                left = left + DoubleDouble::from_f64(damping);
                if !(left.to_f64() > 0.0 && left.is_finite()) {
                    return None;
                }
                lower[i][i] = left.sqrt();
            } else {
                lower[i][j] = left / lower[j][j];
            }
        }
        solved[i] = (solved[i] - dot(&lower[i][..i], &solved[..i])) / lower[i][i];
    }
    for i in (0..count).rev() {
        let mut left = solved[i];
        for k in i + 1..count {
            left = left - lower[k][i] * solved[k];
        }
        solved[i] = left / lower[i][i];
    }
    Some(solved)
}
