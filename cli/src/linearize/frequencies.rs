//! Frequency responses as drawings: Bode plots of gain and phase, and Nyquist curves.

use std::f64::consts::{PI, TAU};

use lagrangian_linear::Complex;
use lagrangian_linear::response::response;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::Linearization;
use crate::plot::{COLOURS, Drawing, PANEL, UNIT, WIDTH, axes, font, range, short, svg_of, tick};

/// The width of the legend beside a panel, and the number of names that fit.
const LEGEND: u32 = 170 * UNIT;
const NAMES: usize = 11;

/// The number of logarithmically spaced frequencies; further ones are added near poles and zeros.
const POINTS: usize = 600;

/// A Nyquist curve is cut off at this multiple of its distance from 0 at medium frequencies, because poles on the imaginary
/// axis make it infinite.
const FAR: f64 = 30.0;

/// The response from one input to one output.
struct Curve {
    name: String,
    /// Frequency in rad/s, and G.
    points: Vec<(f64, Complex<f64>)>,
}

/// The pieces of a drawn curve.
type Line = Vec<Vec<(f64, f64)>>;

/// Frequencies in rad/s that cover everything: from a tenth of the slowest pole or zero to ten times the fastest.
fn frequencies(result: &Linearization) -> Vec<f64> {
    let poles = result.poles.iter().map(|pole| pole.lambda);
    let all: Vec<Complex<f64>> = poles.chain(result.zeros.iter().copied()).collect();
    let sizes = all.iter().map(|x| x.norm()).filter(|x| *x > 0.0);
    let (low, high) = sizes.fold((f64::INFINITY, 0.0_f64), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    let (low, high) = if low <= high {
        (low / 10.0, high * 10.0)
    } else {
        (0.01 * TAU, 100.0 * TAU)
    };
    // Whole decades of Hz.
    let decade = |omega: f64, round: fn(f64) -> f64| round((omega / TAU).log10());
    let (low, high) = (decade(low, f64::floor), decade(high, f64::ceil));
    let step = (high - low) / POINTS as f64;
    let even = (0..=POINTS).map(|k| TAU * 10.0_f64.powf(low + step * k as f64));
    let ends = TAU * 10.0_f64.powf(low)..=TAU * 10.0_f64.powf(high);
    let near = all.iter().filter(|x| x.im > 0.0).flat_map(|x| {
        let im = x.im;
        (0..=32).flat_map(move |k| {
            let by = 10.0_f64.powf(-f64::from(k) / 8.0);
            [im * (1.0 - by), im * (1.0 + by)]
        })
    });
    let mut list: Vec<f64> = even.chain(near).filter(|x| ends.contains(x)).collect();
    list.sort_by(f64::total_cmp);
    list.dedup();
    list
}

/// All finite responses.
fn curves(result: &Linearization) -> Vec<Curve> {
    let model = &result.model;
    let mut curves: Vec<Curve> = Vec::new();
    for output in &model.outputs {
        for input in &model.inputs {
            curves.push(Curve {
                name: format!("{} / {}", output.name, input.name),
                points: Vec::new(),
            });
        }
    }
    for omega in frequencies(result) {
        let Some(found) = response(model, omega) else {
            continue;
        };
        let entries = found.row_iter();
        let entries = entries.flat_map(|row| row.iter().copied().collect::<Vec<_>>());
        for (curve, value) in curves.iter_mut().zip(entries) {
            curve.points.push((omega, value));
        }
    }
    curves
}

/// The responses, or why there are none.
fn finite_curves(result: &Linearization) -> Result<Vec<Curve>, String> {
    if result.model.inputs.is_empty() || result.model.outputs.is_empty() {
        return Err(
            "there is no frequency response: the model has no inputs, or no outputs".to_owned(),
        );
    }
    Ok(curves(result))
}

/// Gain in dB and phase in degrees over the frequency in Hz, as SVG text.
///
/// # Errors
/// If there is nothing to draw, or the drawing library fails.
pub fn bode(title: &str, result: &Linearization) -> Result<String, String> {
    let curves = finite_curves(result)?;
    let names: Vec<&str> = curves.iter().map(|curve| curve.name.as_str()).collect();
    let hertz = |omega: f64| (omega / TAU).log10();
    let gains: Vec<Line> = curves
        .iter()
        .map(|curve| {
            let points = curve.points.iter().filter(|(_, g)| g.norm() > 0.0);
            let points = points.map(|(omega, g)| (hertz(*omega), 20.0 * g.norm().log10()));
            vec![points.collect()]
        })
        .collect();
    let phases: Vec<Line> = curves
        .iter()
        .map(|curve| {
            let mut before: Option<f64> = None;
            let points = curve.points.iter().filter(|(_, g)| g.norm() > 0.0);
            let points = points.map(|(omega, g)| {
                // The phase is continued: the angle nearest to the previous one.
                let angle = match before {
                    Some(before) => g.arg() - TAU * ((g.arg() - before) / TAU).round(),
                    None => g.arg(),
                };
                before = Some(angle);
                (hertz(*omega), angle * 180.0 / PI)
            });
            vec![points.collect()]
        })
        .collect();
    let decades = |x: f64, _: f64| short(10.0_f64.powf(x));
    svg_of(48 * UNIT + 2 * PANEL * 5 / 4, |backend| {
        let sheet = sheet(title, backend)?;
        let areas = sheet.split_evenly((2, 1));
        let panels = [("gain [dB]", &gains), ("phase [°]", &phases)];
        for (area, (along, lines)) in areas.iter().zip(panels) {
            let across = lines.iter().flatten().flatten().map(|(x, _)| *x);
            let [low, high] = across.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| {
                [low.min(x), high.max(x)]
            });
            let across = if low < high { low..high } else { -2.0..2.0 };
            let axes = Axes {
                marks: (across.end - across.start).round() as usize + 1,
                across,
                upwards: range(lines.iter().flatten().flatten().map(|(_, y)| *y)),
                names: ["frequency [Hz]", along],
            };
            panel(area, axes, &decades, lines, &names)?;
        }
        sheet.present()?;
        Ok(())
    })
}

/// The curves of G(iω) and, mirrored at the real axis, of G(−iω), as SVG text; −1 is marked.
///
/// # Errors
/// The errors of [`bode`].
pub fn nyquist(title: &str, result: &Linearization) -> Result<String, String> {
    let curves = finite_curves(result)?;
    let names: Vec<&str> = curves.iter().map(|curve| curve.name.as_str()).collect();
    let mut sizes: Vec<f64> = curves
        .iter()
        .flat_map(|curve| curve.points.iter().map(|(_, g)| g.norm()))
        .collect();
    sizes.sort_by(f64::total_cmp);
    let middle = sizes.get(sizes.len() / 2).copied().unwrap_or(0.0);
    let far = (FAR * middle).max(2.0);
    let lines: Vec<Line> = curves
        .iter()
        .map(|curve| {
            let pieces = curve.points.split(|(_, g)| g.norm() > far);
            let pieces = pieces.filter(|piece| !piece.is_empty());
            let parts = pieces.flat_map(|piece| {
                let part = |sign: f64| {
                    piece
                        .iter()
                        .map(move |(_, g)| (g.re, sign * g.im))
                        .collect()
                };
                [part(1.0), part(-1.0)]
            });
            parts.collect()
        })
        .collect();
    svg_of(48 * UNIT + 2 * PANEL, |backend| {
        let sheet = sheet(title, backend)?;
        let points = || lines.iter().flatten().flatten();
        let axes = Axes {
            marks: 7,
            across: range(points().map(|(x, _)| *x).chain([-1.0])),
            upwards: range(points().map(|(_, y)| *y).chain([0.0])),
            names: ["Re G", "Im G"],
        };
        panel(&sheet, axes, &tick, &lines, &names)?;
        sheet.present()?;
        Ok(())
    })
}

fn sheet<'a>(title: &str, backend: SVGBackend<'a>) -> Drawing<DrawingArea<SVGBackend<'a>, Shift>> {
    let sheet = backend.into_drawing_area();
    sheet.fill(&WHITE)?;
    Ok(sheet.margin(8 * UNIT, 0, 0, 0).titled(title, font(18))?)
}

/// The ranges and names of the axes of a panel.
struct Axes {
    across: std::ops::Range<f64>,
    upwards: std::ops::Range<f64>,
    /// The approximate number of ticks on the first axis.
    marks: usize,
    names: [&'static str; 2],
}

/// Draws curves with a legend.
fn panel(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    axes: Axes,
    label: &dyn Fn(f64, f64) -> String,
    lines: &[Line],
    names: &[&str],
) -> Drawing<()> {
    let (area, beside) = area.split_horizontally(WIDTH - LEGEND);
    let [width, height] = [&axes.across, &axes.upwards].map(|range| range.end - range.start);
    let is_plane = axes.names[0] == "Re G";
    let mut chart = ChartBuilder::on(&area)
        .margin(6 * UNIT)
        .margin_right(4 * UNIT)
        .x_label_area_size(34 * UNIT)
        .y_label_area_size(72 * UNIT)
        .build_cartesian_2d(axes.across, axes.upwards)?;
    axes!(chart)
        .x_desc(axes.names[0])
        .y_desc(axes.names[1])
        .x_labels(axes.marks)
        .y_labels(7)
        .x_label_formatter(&|x| label(*x, width))
        .y_label_formatter(&|y| tick(*y, height))
        .draw()?;
    let colours = COLOURS.iter().cycle();
    for (line, colour) in lines.iter().zip(colours.clone()) {
        for piece in line {
            let points = piece.iter().copied();
            let style = colour.stroke_width(UNIT + UNIT / 4);
            chart.draw_series(LineSeries::new(points, style))?;
        }
    }
    if is_plane {
        chart.draw_series([Cross::new((-1.0, 0.0), 5 * UNIT, BLACK.stroke_width(UNIT))])?;
    }
    let place = |row: usize| (row as i32 * 17 + 16) * UNIT as i32;
    for (row, (name, colour)) in names.iter().zip(colours).take(NAMES).enumerate() {
        let (left, y) = (4 * UNIT as i32, place(row));
        let line = [(left, y), (left + 16 * UNIT as i32, y)];
        beside.draw(&PathElement::new(line, colour.stroke_width(2 * UNIT)))?;
        let middle = font(12).pos(Pos::new(HPos::Left, VPos::Center));
        beside.draw(&Text::new(
            (*name).to_owned(),
            (left + 22 * UNIT as i32, y),
            middle,
        ))?;
    }
    if names.len() > NAMES {
        let more = format!("and {} more", names.len() - NAMES);
        beside.draw(&Text::new(more, (4 * UNIT as i32, place(NAMES)), font(12)))?;
    }
    Ok(())
}
