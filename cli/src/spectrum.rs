//! `lagrangian spectrum`: the frequencies in a run.

use std::fmt::Write as _;

use lagrangian_analysis::spectrum::{LEAST, Line, Spectrum, Window};
use serde_json::{Value, json};

use crate::call;
use crate::drawing::{self, Curve, Pane};
use crate::failure::Failure;
use crate::modes::number;
use crate::output::{self, Destination, TABLE};
use crate::runs::{self, Columns, Quantity, header};
use crate::table;

/// A quantity with its spectrum.
struct SpectrumOf<'a> {
    quantity: &'a Quantity,
    spectrum: Spectrum,
    lines: Vec<Line>,
}

/// Runs the command.
///
/// # Errors
/// If the spec, the table or the call is invalid, or the run fails.
pub fn run(call: &call::Spectrum) -> Result<(), Failure> {
    let out = (call.out.as_ref(), TABLE);
    let files = Destination::out_and_plot(out, call.plot.as_ref(), call.part.runs.json)?;
    let all: Vec<&Destination> = files.iter().flatten().collect();
    let columns = runs::one(&call.part, &all)?;
    let chosen = columns.chosen(&call.part.of, &call.part.run)?;
    let samples = Samples::of(&columns)?;
    for quantity in &chosen {
        columns.warn_if_undersampled(quantity);
    }
    let window = match call.window {
        call::Windows::Hann => Window::Hann,
        call::Windows::None => Window::None,
        call::Windows::BlackmanHarris => Window::BlackmanHarris,
    };
    let mut spectra = Vec::new();
    for quantity in chosen {
        let values = samples.values(&columns, quantity);
        let spectrum = Spectrum::new(&values, samples.step, window).ok_or_else(|| {
            Failure::Run(format!(
                "`{}` has instants without a value, so it has no spectrum; --after excludes an early part of the run",
                quantity.name
            ))
        })?;
        spectra.push(SpectrumOf {
            lines: spectrum.lines(
                usize::try_from(call.lines).unwrap_or(usize::MAX),
                call.least,
            ),
            quantity,
            spectrum,
        });
    }
    let frequencies: &[f64] = spectra.first().map_or(&[], |one| &one.spectrum.frequencies);
    if let Some(file) = &files[0] {
        let columns = spectra
            .iter()
            .map(|one| (one.quantity.header(), one.spectrum.amplitudes.as_slice()));
        let first = ("frequency [Hz]".to_owned(), frequencies);
        table::write_columns(
            &std::iter::once(first).chain(columns).collect::<Vec<_>>(),
            file,
        )?;
    }
    if let Some(file) = &files[1] {
        let title = call
            .part
            .run
            .file_name()
            .unwrap_or_default()
            .to_string_lossy();
        let svg = drawing::svg(&title, &panes(&spectra, frequencies));
        file.write_text(&svg.map_err(Failure::Run)?)?;
    }
    let resolution = spectra
        .first()
        .map_or(f64::NAN, |one| one.spectrum.resolution);
    if call.part.runs.json {
        let result = json!({
            "samples": samples.count,
            "step": samples.step,
            "resampled": samples.is_resampled,
            "resolution": resolution,
            "window": window.name(),
            "quantities": spectra.iter().map(as_json).collect::<Vec<Value>>(),
        });
        output::line(format_args!("{result:#}"));
    } else {
        output::text(&text(&samples, resolution, window, &spectra))
    }
    Ok(())
}

/// The samples of a run.
struct Samples {
    from: f64,
    step: f64,
    count: usize,
    /// Whether rows are unevenly spaced, so that samples are interpolated.
    is_resampled: bool,
}

impl Samples {
    fn of(columns: &Columns) -> Result<Samples, Failure> {
        let times = &columns.times;
        let too_few = || {
            Failure::Run(format!(
                "a spectrum needs at least {LEAST} instants, and there are {}",
                times.len()
            ))
        };
        let [first, second, .., last] = times.as_slice() else {
            return Err(too_few());
        };
        let step = second - first;
        // The times are rounded too.
        let rounding = 1e-9 * step + 4.0 * f64::EPSILON * last.abs().max(first.abs());
        let is_even = |pair: &[f64]| (pair[1] - pair[0] - step).abs() <= rounding;
        let even = times.windows(2).take_while(|pair| is_even(pair)).count() + 1;
        // An end that is not at a sampling instant is left out.
        let samples = if even + 1 >= times.len() {
            Samples {
                from: *first,
                step: (times[even - 1] - first) / (even - 1) as f64,
                count: even,
                is_resampled: false,
            }
        } else {
            Samples {
                from: *first,
                step: (last - first) / (times.len() - 1) as f64,
                count: times.len(),
                is_resampled: true,
            }
        };
        if samples.count < LEAST {
            Err(too_few())
        } else {
            Ok(samples)
        }
    }

    fn values(&self, columns: &Columns, quantity: &Quantity) -> Vec<f64> {
        if !self.is_resampled {
            return quantity.values[..self.count].to_vec();
        }
        let rates = columns.rates(&quantity.name);
        let curve = columns.curve(quantity, rates.as_deref(), call::Interpolation::Cubic);
        let last = columns.times[columns.times.len() - 1];
        let times = (0..self.count).map(|k| (self.from + k as f64 * self.step).min(last));
        times.map(|t| curve.at(t)).collect()
    }
}

fn text(samples: &Samples, resolution: f64, window: Window, found: &[SpectrumOf]) -> String {
    let mut text = format!(
        "{} samples, {} s apart, window {}; frequencies are {} Hz apart, up to {} Hz\n",
        samples.count,
        number(samples.step),
        window.name(),
        number(resolution),
        number(0.5 / samples.step)
    );
    if samples.is_resampled {
        text.push_str(
            "the rows are not evenly spaced: samples are interpolated by cubics between them\n",
        );
    }
    for one in found {
        let unit = one.quantity.unit.as_deref().filter(|unit| *unit != "1");
        let unit = unit.map_or_else(String::new, |unit| format!(" {unit}"));
        // Writing to a String cannot fail.
        let _ = writeln!(
            text,
            "{}: mean {}{unit}",
            one.quantity.name,
            number(one.spectrum.mean)
        );
        if one.lines.is_empty() {
            text.push_str("  no lines\n");
        }
        for line in &one.lines {
            let _ = writeln!(
                text,
                "  {} Hz: amplitude {}{unit}",
                number(line.frequency),
                number(line.amplitude)
            );
        }
    }
    text
}

fn as_json(one: &SpectrumOf) -> Value {
    let lines = one.lines.iter().map(|line| {
        json!({"frequency": line.frequency, "amplitude": line.amplitude, "phase": line.phase})
    });
    json!({
        "name": one.quantity.name,
        "unit": one.quantity.unit,
        "mean": one.spectrum.mean,
        "lines": lines.collect::<Vec<Value>>(),
    })
}

/// A pane for each unit, up to the highest frequency with a visible amplitude.
fn panes(found: &[SpectrumOf], frequencies: &[f64]) -> Vec<Pane> {
    let mut panes: Vec<(Option<&str>, Pane)> = Vec::new();
    let greatest = |one: &SpectrumOf| one.spectrum.amplitudes.iter().copied().fold(0.0, f64::max);
    let last = found.iter().map(|one| {
        let least = 1e-3 * greatest(one);
        one.spectrum
            .amplitudes
            .iter()
            .rposition(|x| *x > least)
            .unwrap_or(0)
    });
    let shown = (last.max().unwrap_or(0) + 5).min(frequencies.len());
    for one in found {
        let unit = one.quantity.unit.as_deref();
        let place = panes.iter().position(|(other, _)| *other == unit);
        let place = place.unwrap_or_else(|| {
            let pane = Pane {
                along: ["frequency [Hz]".to_owned(), header("amplitude", unit)],
                curves: Vec::new(),
                are_points: false,
            };
            panes.push((unit, pane));
            panes.len() - 1
        });
        let points = frequencies.iter().zip(&one.spectrum.amplitudes).take(shown);
        panes[place].1.curves.push(Curve {
            name: one.quantity.name.clone(),
            points: points.map(|(x, y)| (*x, *y)).collect(),
        });
    }
    panes.into_iter().map(|(_, pane)| pane).collect()
}
