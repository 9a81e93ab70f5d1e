//! Measured against computed values: for each quantity the motion with its measurements, and the residuals below it.

use lagrangian_fit::motion::{ConstraintFindings, Experiment, Fit};
use plotters::coord::Shift;
use plotters::prelude::*;

use super::{Fitted, stopped};
use crate::failure::Failure;
use crate::plot::{COLOURS, Drawing, PANEL, UNIT, WIDTH, axes, font, range, svg_of, tick};

/// The height of the residuals below a panel.
const BELOW: u32 = 130 * UNIT;

/// The width of the legend with the names of the files.
const LEGEND: u32 = 130 * UNIT;

/// The radius of a measurement's dot.
const POINT: u32 = UNIT * 5 / 4;

/// The number of points of a curve.
const POINTS: usize = 800;

/// A quantity in one experiment.
struct Curve {
    name: String,
    measured: Vec<(f64, f64)>,
    residuals: Vec<(f64, f64)>,
    computed: Vec<(f64, f64)>,
}

/// The drawing as SVG text.
///
/// # Errors
/// If there is no motion, or the drawing library fails.
pub fn svg(result: &mut Fitted<'_, '_>, x: &[f64]) -> Result<String, Failure> {
    let figures = figures(result, x)?;
    let count = figures.len() as u32;
    let height = 48 * UNIT + (PANEL + BELOW) * count;
    let title = lagrangian::Machine::name(result.machine).to_owned();
    svg_of(height, |backend| draw(&title, &figures, backend)).map_err(Failure::Run)
}

fn figures(result: &mut Fitted<'_, '_>, x: &[f64]) -> Result<Vec<(String, Vec<Curve>)>, Failure> {
    let labels: Vec<String> = result
        .classes
        .iter()
        .map(|class| match class.unit.as_str() {
            "1" => class.name.clone(),
            unit => format!("{} [{unit}]", class.name),
        })
        .collect();
    let mut figures: Vec<(String, Vec<Curve>)> = labels
        .into_iter()
        .map(|label| (label, Vec::new()))
        .collect();
    for e in 0..result.fit.experiments.len() {
        let at_rows = result.fit.computed(e, x).map_err(stopped)?;
        let dense = densely(result.fit, e, x)?;
        let experiment = &result.fit.experiments[e];
        for (c, column) in experiment.columns.iter().enumerate() {
            let rows = experiment.times.iter().zip(&column.values).enumerate();
            let rows: Vec<(f64, f64, f64)> = rows
                .filter_map(|(row, (t, value))| Some((*t, (*value)?, at_rows[row][c])))
                .collect();
            figures[column.sigma].1.push(Curve {
                name: experiment.name.clone(),
                measured: rows.iter().map(|(t, y, _)| (*t, *y)).collect(),
                residuals: rows.iter().map(|(t, y, at)| (*t, y - at)).collect(),
                computed: dense.iter().map(|(t, values)| (*t, values[c])).collect(),
            });
        }
    }
    Ok(figures)
}

/// The motion of an experiment at closely spaced times, and at those of its measurements.
fn densely(fit: &Fit<'_>, e: usize, x: &[f64]) -> Result<Vec<(f64, Vec<f64>)>, Failure> {
    let experiment = &fit.experiments[e];
    let last = experiment.times.last().copied().unwrap_or(0.0);
    let mut times: Vec<f64> = (0..=POINTS)
        .map(|k| last * k as f64 / POINTS as f64)
        .collect();
    times.extend(&experiment.times);
    times.sort_by(f64::total_cmp);
    times.dedup();
    let experiment = Experiment {
        times: times.clone(),
        ..experiment.clone()
    };
    let sought = fit.sought.iter().zip(x).map(|(one, x)| {
        let mut one = one.clone();
        one.from = *x;
        one
    });
    // Starts refer to experiments by index, so the others stay in the list, but are not run.
    let mut experiments = fit.experiments.clone();
    experiments[e] = experiment;
    let mut dense = Fit {
        experiments,
        sought: sought.collect(),
        sigmas: fit.sigmas.clone(),
        running: fit.running.clone(),
        refusal: fit.refusal,
        runs: [0, 0],
        held: ConstraintFindings::default(),
    };
    let values = dense.computed(e, x).map_err(stopped)?;
    Ok(times.into_iter().zip(values).collect())
}

fn draw(title: &str, figures: &[(String, Vec<Curve>)], backend: SVGBackend<'_>) -> Drawing<()> {
    let sheet = backend.into_drawing_area();
    sheet.fill(&WHITE)?;
    let mut rest = sheet.margin(8 * UNIT, 0, 0, 0).titled(title, font(18))?;
    for (label, curves) in figures {
        let (above, others) = rest.split_vertically(PANEL);
        let (below, others) = others.split_vertically(BELOW);
        rest = others;
        let times = range(
            curves
                .iter()
                .flat_map(|curve| curve.computed.iter().map(|(t, _)| *t)),
        );
        draw_motion(label, curves, times.clone(), &above)?;
        draw_residuals(label, curves, times, &below)?;
    }
    sheet.present()?;
    Ok(())
}

fn draw_motion(
    name: &str,
    curves: &[Curve],
    times: std::ops::Range<f64>,
    area: &DrawingArea<SVGBackend<'_>, Shift>,
) -> Drawing<()> {
    let values = curves
        .iter()
        .flat_map(|curve| curve.computed.iter().chain(&curve.measured));
    let values = range(values.map(|(_, y)| *y));
    let (area, beside) = area.split_horizontally(WIDTH - LEGEND);
    let (along, across) = (times.end - times.start, values.end - values.start);
    let mut chart = ChartBuilder::on(&area)
        .margin(6 * UNIT)
        .margin_right(2 * UNIT)
        .x_label_area_size(20 * UNIT)
        .y_label_area_size(72 * UNIT)
        .build_cartesian_2d(times, values)?;
    axes!(chart)
        .y_desc(name)
        .y_labels(5)
        .x_label_formatter(&|x| tick(*x, along))
        .y_label_formatter(&|y| tick(*y, across))
        .draw()?;
    for (curve, colour) in curves.iter().zip(COLOURS.iter().cycle()) {
        let line = colour.stroke_width(UNIT + UNIT / 4);
        chart.draw_series(LineSeries::new(curve.computed.iter().copied(), line))?;
        chart.draw_series(
            curve
                .measured
                .iter()
                .map(|at| Circle::new(*at, POINT, colour.filled())),
        )?;
    }
    for (row, (curve, colour)) in curves
        .iter()
        .zip(COLOURS.iter().cycle())
        .enumerate()
        .take(10)
    {
        let (left, y) = (4 * UNIT as i32, (row as i32 * 17 + 16) * UNIT as i32);
        let line = [(left, y), (left + 16 * UNIT as i32, y)];
        beside.draw(&PathElement::new(line, colour.stroke_width(2 * UNIT)))?;
        let middle = (left + 8 * UNIT as i32, y);
        beside.draw(&Circle::new(middle, 2 * UNIT, colour.filled()))?;
        let name = curve.name.rsplit('/').next().unwrap_or_default().to_owned();
        let place = (left + 22 * UNIT as i32, y - 6 * UNIT as i32);
        beside.draw(&Text::new(name, place, font(12)))?;
    }
    Ok(())
}

fn draw_residuals(
    name: &str,
    curves: &[Curve],
    times: std::ops::Range<f64>,
    area: &DrawingArea<SVGBackend<'_>, Shift>,
) -> Drawing<()> {
    let values = curves.iter().flat_map(|curve| &curve.residuals);
    let values = range(values.map(|(_, y)| *y).chain([0.0]));
    let (area, _) = area.split_horizontally(WIDTH - LEGEND);
    let (along, across) = (times.end - times.start, values.end - values.start);
    let ends = [(times.start, 0.0), (times.end, 0.0)];
    let mut chart = ChartBuilder::on(&area)
        .margin(6 * UNIT)
        .margin_right(2 * UNIT)
        .x_label_area_size(34 * UNIT)
        .y_label_area_size(72 * UNIT)
        .build_cartesian_2d(times, values)?;
    let unit = name
        .rsplit_once(" [")
        .map_or(String::new(), |(_, unit)| format!(" [{unit}"));
    axes!(chart)
        .x_desc("t [s]")
        .y_desc(format!("residual{unit}"))
        .y_labels(3)
        .x_label_formatter(&|x| tick(*x, along))
        .y_label_formatter(&|y| tick(*y, across))
        .draw()?;
    chart.draw_series(LineSeries::new(ends, BLACK.stroke_width(UNIT / 2)))?;
    for (curve, colour) in curves.iter().zip(COLOURS.iter().cycle()) {
        let points = curve.residuals.iter();
        chart.draw_series(points.map(|at| Circle::new(*at, POINT, colour.filled())))?;
    }
    Ok(())
}
