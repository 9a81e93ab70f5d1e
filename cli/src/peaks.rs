//! `lagrangian peaks`: maxima and minima of a run, with the period and the decrement of oscillations.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use lagrangian::ContactEventKind;
use lagrangian_analysis::extremes::{Extreme, extremes};
use serde_json::{Value, json};

use crate::call;
use crate::exactness::Exactness;
use crate::failure::Failure;
use crate::modes::number;
use crate::output::{self, Destination, TABLE};
use crate::runs::{self, Columns, Quantity, TOLERANCE};
use crate::table;

/// The number of extremes that are printed.
const SHOWN: usize = 10;

/// Errors of the curve between rows above this fraction of its range are reported.
const LEAST_ERROR: f64 = 1e-3;

/// A quantity with its extremes.
struct PeaksOf<'a> {
    quantity: &'a Quantity,
    extremes: Vec<Extreme>,
    /// Extremes up to this height are ripples, in the unit of the quantity.
    ripple: f64,
    /// The number of extremes left out as ripples.
    left_out: usize,
}

impl PeaksOf<'_> {
    /// The mean time between successive maxima, and between successive minima.
    fn period(&self) -> Option<f64> {
        let count = self.extremes.len();
        match self.extremes.as_slice() {
            // An odd number of extremes, so that the last is of the kind of the first: whole periods.
            [first, .., last] if count > 2 => {
                let last = if count % 2 == 1 {
                    last
                } else {
                    &self.extremes[count - 2]
                };
                let halves = (count - 1) / 2 * 2;
                Some(2.0 * (last.t - first.t) / halves as f64)
            }
            _ => None,
        }
    }

    /// The logarithmic decrement: of the ratio of two swings that are one period apart, averaged over all. A swing is the
    /// difference between successive extremes, so the centre of the oscillation does not matter.
    fn decrement(&self) -> Option<f64> {
        let swings = self.extremes.windows(2);
        let swings: Vec<f64> = swings
            .map(|pair| (pair[1].value - pair[0].value).abs())
            .collect();
        match swings.as_slice() {
            [first, .., last] if *first > 0.0 && *last > 0.0 => {
                Some(2.0 * (first / last).ln() / (swings.len() - 1) as f64)
            }
            _ => None,
        }
    }

    /// The damping ratio of a linear oscillation with this decrement.
    fn damping(&self) -> Option<f64> {
        self.decrement()
            .map(|decrement| decrement / decrement.hypot(TAU))
    }
}

/// Runs the command.
///
/// # Errors
/// If the spec, the table or the call is invalid, or the run fails.
pub fn run(call: &call::Peaks) -> Result<(), Failure> {
    let file = Destination::of("--out", call.out.as_ref(), TABLE)?;
    output::keep_document_apart(&file, call.part.runs.json)?;
    let all: Vec<&Destination> = file.iter().collect();
    let (columns, exactness) = runs::one_with_run(&call.part, &all)?;
    if let Some(exactness) = &exactness {
        warn_of_impacts(exactness, call.part.after);
    }
    let chosen = columns.chosen(&call.part.of, &call.part.run)?;
    for quantity in &chosen {
        columns.warn_of_gaps(quantity);
        warn_of_sparse_rows(&columns, quantity);
    }
    let errors = match (&exactness, call.ripple) {
        (Some(exactness), None) => {
            exactness.of_columns(chosen.iter().map(|quantity| quantity.name.as_str()))
        }
        _ => vec![0.0; chosen.len()],
    };
    let chosen = chosen.into_iter().zip(errors);
    let peaks: Vec<PeaksOf> = chosen
        .map(|(quantity, error)| {
            let rates = columns.rates(&quantity.name);
            let curve = columns.curve(quantity, rates.as_deref(), call::Interpolation::Cubic);
            let finite = quantity.values.iter().filter(|value| value.is_finite());
            let largest = finite.fold(0.0_f64, |most, x| most.max(x.abs()));
            // Differences below the errors of both values, or below round-off, are not significant.
            let least = (2.0 * error).max(64.0 * f64::EPSILON * largest);
            let ripple = call.ripple.unwrap_or(least);
            let all = extremes(&curve, rates.as_deref(), 0.0).len();
            let extremes = extremes(&curve, rates.as_deref(), ripple);
            PeaksOf {
                quantity,
                left_out: all - extremes.len(),
                extremes,
                ripple,
            }
        })
        .collect();
    if let Some(file) = &file {
        write(&peaks, file)?;
    }
    if call.part.runs.json {
        let quantities: Vec<Value> = peaks.iter().map(as_json).collect();
        output::line(format_args!("{:#}", json!({ "quantities": quantities })));
    } else {
        output::text(&text(&peaks))
    }
    Ok(())
}

/// Warns if a quantity is not known well between rows, where its extremes are.
fn warn_of_sparse_rows(columns: &Columns, quantity: &Quantity) {
    if columns.warn_if_undersampled(quantity) {
        return;
    }
    let Some(rates) = columns.rates(&quantity.name) else {
        return;
    };
    let curve = columns.curve(quantity, Some(&rates), call::Interpolation::Cubic);
    let error = curve.interpolation_error();
    if error > (LEAST_ERROR * curve.range()).max(TOLERANCE) {
        let unit = quantity.unit.as_deref().filter(|unit| *unit != "1");
        output::print_error(format_args!(
            "warning: between rows `{}` is known to some {error:.1e}{}{}, and so are its extremes; with rows half as far apart the error is a sixteenth",
            quantity.name,
            if unit.is_some() { " " } else { "" },
            unit.unwrap_or_default()
        ));
    }
}

/// Warns if rates jump in the part of the run that is examined: the curve through the rows is smooth there, unlike the motion.
fn warn_of_impacts(exactness: &Exactness, after: Option<f64>) {
    let events = exactness.run.contact_events().iter();
    let impacts = events.filter(|event| event.kind == ContactEventKind::Impact);
    let instants = impacts.map(|event| event.state.t);
    let count = instants
        .filter(|t| after.is_none_or(|after| *t >= after))
        .count();
    if count > 0 {
        let (plural, are) = if count == 1 { ("", "is") } else { ("s", "are") };
        output::print_error(format_args!(
            "warning: there {are} {count} impact{plural}, at which rates jump: extremes next to an impact are those of the smooth \
             curve through the rows; the reductions min and max of `lagrangian sweep` are those of the motion"
        ));
    }
}

/// One row for each extreme: the index of the quantity, the time, the value, and 1 for a maximum or −1 for a minimum.
fn write(found: &[PeaksOf], file: &Destination) -> Result<(), Failure> {
    let rows: Vec<(usize, &Extreme)> = found
        .iter()
        .enumerate()
        .flat_map(|(k, one)| one.extremes.iter().map(move |extreme| (k + 1, extreme)))
        .collect();
    let column = |of: &dyn Fn(&(usize, &Extreme)) -> f64| rows.iter().map(of).collect::<Vec<f64>>();
    let side = |is_maximum| if is_maximum { 1.0 } else { -1.0 };
    let columns = [
        ("quantity", column(&|row| row.0 as f64)),
        ("t [s]", column(&|row| row.1.t)),
        ("value", column(&|row| row.1.value)),
        ("maximum", column(&|row| side(row.1.is_maximum))),
    ];
    let columns: Vec<(String, &[f64])> = columns
        .iter()
        .map(|(name, values)| ((*name).to_owned(), values.as_slice()))
        .collect();
    table::write_columns(&columns, file)
}

fn text(found: &[PeaksOf]) -> String {
    let mut text = String::new();
    for one in found {
        let unit = one.quantity.unit.as_deref().filter(|unit| *unit != "1");
        let unit = unit.map_or_else(String::new, |unit| format!(" {unit}"));
        let maxima = one
            .extremes
            .iter()
            .filter(|extreme| extreme.is_maximum)
            .count();
        // Writing to a String cannot fail.
        let _ = write!(
            text,
            "{}: {maxima} maxima, {} minima",
            one.quantity.name,
            one.extremes.len() - maxima
        );
        if let Some(period) = one.period() {
            let _ = write!(text, "; period {} s", number(period));
        }
        if let (Some(decrement), Some(damping)) = (one.decrement(), one.damping()) {
            let (decrement, damping) = (number(decrement), number(damping));
            let _ = write!(
                text,
                ", logarithmic decrement {decrement}, damping ratio {damping}"
            );
        }
        if one.left_out > 0 {
            let (left_out, ripple) = (one.left_out, number(one.ripple));
            let plural = if left_out == 1 { "" } else { "s" };
            let _ = write!(
                text,
                "; {left_out} ripple{plural} of no more than {ripple}{unit} left out"
            );
        }
        text.push('\n');
        for extreme in one.extremes.iter().take(SHOWN) {
            let kind = if extreme.is_maximum {
                "maximum"
            } else {
                "minimum"
            };
            let (value, t) = (number(extreme.value), number(extreme.t));
            let _ = writeln!(text, "  {kind} {value}{unit} at t = {t} s");
        }
        if one.extremes.len() > SHOWN {
            let _ = writeln!(
                text,
                "  and {} more, with --json or --out",
                one.extremes.len() - SHOWN
            );
        }
    }
    text
}

fn as_json(one: &PeaksOf) -> Value {
    let extremes = one.extremes.iter().map(|extreme| {
        let kind = if extreme.is_maximum {
            "maximum"
        } else {
            "minimum"
        };
        json!({"t": extreme.t, "value": extreme.value, "kind": kind})
    });
    json!({
        "name": one.quantity.name,
        "unit": one.quantity.unit,
        "period": one.period(),
        "decrement": one.decrement(),
        "damping": one.damping(),
        "ripple": one.ripple,
        "left_out": one.left_out,
        "extremes": extremes.collect::<Vec<Value>>(),
    })
}
