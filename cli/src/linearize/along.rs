//! `--along`: eigenvalues along a range of values, the table of a Campbell diagram.

use std::f64::consts::TAU;

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Machine, System};
use lagrangian_linear::motion::SteadyMotion;
use lagrangian_linear::spectrum::{Mode, damping};
use lagrangian_linear::{Complex, DMatrix, DVector};
use serde_json::json;

use super::files::Files;
use crate::call;
use crate::failure::Failure;
use crate::modes::{number, vary::Trace};
use crate::numbers::after_number;
use crate::output;
use crate::table;

/// An eigenvalue; of a conjugate pair the one above the real axis.
struct Row {
    value: f64,
    /// The number of its mode, from 1, which stays the same along the range.
    mode: usize,
    lambda: Complex<f64>,
}

/// Writes the table and prints a summary.
///
/// # Errors
/// If it cannot be written.
pub fn show(
    call: &call::Linearize,
    machine: &InterpretedMachine,
    trace: &Trace,
    files: &Files,
) -> Result<(), Failure> {
    let rows = rows(machine, trace);
    if let Some(file) = &files.table {
        let column = |of: &dyn Fn(&Row) -> f64| rows.iter().map(of).collect::<Vec<f64>>();
        let header = match trace.unit.as_str() {
            "1" => trace.name.clone(),
            unit => format!("{} [{unit}]", trace.name),
        };
        let columns = [
            (header, column(&|row| row.value)),
            ("mode".to_owned(), column(&|row| row.mode as f64)),
            ("re [1/s]".to_owned(), column(&|row| row.lambda.re)),
            ("im [1/s]".to_owned(), column(&|row| row.lambda.im)),
            (
                "frequency [Hz]".to_owned(),
                column(&|row| row.lambda.im / TAU),
            ),
            (
                "damping".to_owned(),
                column(&|row| damping(row.lambda).unwrap_or(f64::NAN)),
            ),
        ];
        let columns: Vec<(String, &[f64])> = columns
            .iter()
            .map(|(header, values)| (header.clone(), values.as_slice()))
            .collect();
        table::write_columns(&columns, file)?;
    }
    let lost = trace.points.iter().filter(|point| point.motion.is_err());
    let (lost, modes) = (lost.count(), rows.iter().map(|row| row.mode).max());
    if call.spec.json {
        let rows = rows.iter().map(|row| {
            json!({
                "value": row.value,
                "mode": row.mode,
                "re": row.lambda.re,
                "im": row.lambda.im,
                "frequency": row.lambda.im / TAU,
                "damping": damping(row.lambda),
            })
        });
        let result = json!({
            "along": {"name": trace.name, "unit": trace.unit},
            "rows": rows.collect::<Vec<_>>(),
            "lost": lost,
        });
        output::line(format_args!("{result:#}"));
        return Ok(());
    }
    let [first, last] = [trace.points.first(), trace.points.last()];
    let [first, last] = [first, last].map(|point| point.map_or(0.0, |point| point.value));
    let unit = after_number(&trace.unit);
    let mut text = format!(
        "{} eigenvalues of {} modes along {} from {} to {}{unit}, {} values\n",
        rows.len(),
        modes.unwrap_or(0),
        trace.name,
        number(first),
        number(last),
        trace.points.len()
    );
    if lost > 0 {
        text.push_str(&format!("no solution was found at {lost} values: "));
        let why = trace.points.iter().find_map(|p| p.motion.as_ref().err());
        text.push_str(why.map_or("", String::as_str));
        text.push('\n');
    }
    output::text(&text);
    Ok(())
}

/// All eigenvalues, with the numbers of modes continued from value to value.
fn rows(machine: &InterpretedMachine, trace: &Trace) -> Vec<Row> {
    let system = machine.prepare();
    let mut rows = Vec::new();
    let mut before: Option<(&SteadyMotion, Vec<usize>)> = None;
    let mut next = 1;
    for point in &trace.points {
        let Ok(motion) = &point.motion else { continue };
        let modes = &motion.modes.modes;
        let q = motion.found.place.q();
        let mut mass = vec![0.0; q.len() * q.len()];
        system.mass_matrix(0.0, &q, &mut mass);
        let mass = DMatrix::from_row_slice(q.len(), q.len(), &mass);
        let mut numbers = vec![0; modes.len()];
        if let Some((older, older_numbers)) = &before {
            for (k, j) in matching_modes(&older.modes.modes, modes, &mass) {
                numbers[j] = older_numbers[k];
            }
        }
        for number in numbers.iter_mut().filter(|number| **number == 0) {
            (*number, next) = (next, next + 1);
        }
        for (mode, number) in modes.iter().zip(&numbers) {
            rows.push(Row {
                value: point.value,
                mode: *number,
                lambda: mode.lambda,
            });
        }
        before = Some((motion, numbers));
    }
    rows
}

/// Matches modes, the most similar ones first.
fn matching_modes(older: &[Mode], newer: &[Mode], mass: &DMatrix<f64>) -> Vec<(usize, usize)> {
    let mut all: Vec<(f64, usize, usize)> = Vec::with_capacity(older.len() * newer.len());
    for (k, one) in older.iter().enumerate() {
        let likeness = newer.iter().enumerate();
        all.extend(likeness.map(|(j, other)| (similarity(one, other, mass), k, j)));
    }
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (mut is_taken, mut is_given) = (vec![false; older.len()], vec![false; newer.len()]);
    let mut pairs = Vec::new();
    for (_, k, j) in all {
        if !is_taken[k] && !is_given[j] {
            (is_taken[k], is_given[j]) = (true, true);
            pairs.push((k, j));
        }
    }
    pairs
}

/// The similarity of two modes, from 0 to 1: of their shapes in the metric of inertia (the modal assurance criterion; R. J.
/// Allemang, *The modal assurance criterion*, Sound and Vibration 37 (2003) 14–21) and, for equal shapes, of their eigenvalues.
fn similarity(one: &Mode, other: &Mode, mass: &DMatrix<f64>) -> f64 {
    let vector = |mode: &Mode| DVector::from_column_slice(&mode.shape);
    let mass = mass.map(|x| Complex::new(x, 0.0));
    let (x, y) = (vector(one), vector(other));
    let product = |x: &DVector<Complex<f64>>, y: &DVector<Complex<f64>>| x.dotc(&(&mass * y));
    let sizes = product(&x, &x).re * product(&y, &y).re;
    let shapes = if sizes > 0.0 {
        product(&x, &y).norm_sqr() / sizes
    } else {
        0.0
    };
    let apart = (one.lambda - other.lambda).norm();
    let sum = one.lambda.norm() + other.lambda.norm();
    let apart = if sum > 0.0 { apart / sum } else { 0.0 };
    shapes * (1.0 - 0.5 * apart)
}
