//! Drawings of modes along a range of values: frequencies (a Campbell diagram), growth rates, and the root locus.

use plotters::prelude::*;

use super::vary::Trace;
use crate::plot::{COLOURS, Drawing, PANEL, UNIT, WIDTH, axes, font, range, svg_of, tick};

/// The radius of a point.
const POINT: u32 = UNIT * 5 / 4;

/// One of the drawings, arranged vertically.
struct Figure {
    across: String,
    along: &'static str,
    /// Points, each with whether the motion grows.
    points: Vec<(f64, f64, bool)>,
    /// Values to mark on the horizontal axis.
    marks: Vec<f64>,
}

/// The drawing as SVG text.
///
/// # Errors
/// An error of the drawing library, as a sentence.
pub fn svg(title: &str, trace: &Trace) -> Result<String, String> {
    let figures = figures(trace);
    let height = 48 * UNIT + PANEL * figures.len() as u32;
    svg_of(height, |backend| draw(title, &figures, backend))
}

fn figures(trace: &Trace) -> Vec<Figure> {
    let unit = match trace.unit.as_str() {
        "1" => String::new(),
        unit => format!(" [{unit}]"),
    };
    let found = trace.points.iter().filter_map(|point| {
        let motion = point.motion.as_ref().ok()?;
        Some((point.value, motion))
    });
    let all: Vec<_> = found
        .flat_map(|(value, motion)| {
            let modes = motion.modes.modes.iter();
            modes.map(move |mode| (value, mode.lambda))
        })
        .collect();
    let marks: Vec<f64> = trace
        .critical
        .iter()
        .map(|critical| critical.value)
        .collect();
    let across = format!("{}{unit}", trace.name);
    let oscillations = all.iter().filter(|(_, lambda)| lambda.im > 0.0);
    vec![
        Figure {
            across: across.clone(),
            along: "frequency [Hz]",
            points: oscillations
                .map(|(value, lambda)| (*value, lambda.im / std::f64::consts::TAU, lambda.re > 0.0))
                .collect(),
            marks: marks.clone(),
        },
        Figure {
            across,
            along: "growth [1/s]",
            points: all
                .iter()
                .map(|(value, lambda)| (*value, lambda.re, lambda.re > 0.0))
                .collect(),
            marks,
        },
        Figure {
            across: "Re λ [1/s]".to_owned(),
            along: "Im λ [1/s]",
            points: all
                .iter()
                .map(|(_, lambda)| (lambda.re, lambda.im, lambda.re > 0.0))
                .collect(),
            marks: Vec::new(),
        },
    ]
}

fn draw(title: &str, figures: &[Figure], backend: SVGBackend<'_>) -> Drawing<()> {
    let sheet = backend.into_drawing_area();
    sheet.fill(&WHITE)?;
    let sheet = sheet.margin(8 * UNIT, 0, 0, 0).titled(title, font(18))?;
    for (area, figure) in sheet.split_evenly((figures.len(), 1)).iter().zip(figures) {
        let across = range(
            figure
                .points
                .iter()
                .map(|(x, ..)| *x)
                .chain(figure.marks.iter().copied()),
        );
        let along = range(figure.points.iter().map(|(_, y, _)| *y).chain([0.0]));
        let (width, height) = (across.end - across.start, along.end - along.start);
        let (low, high) = (along.start, along.end);
        let (area, _) = area.split_horizontally(WIDTH - 30 * UNIT);
        let mut chart = ChartBuilder::on(&area)
            .margin(6 * UNIT)
            .margin_right(2 * UNIT)
            .x_label_area_size(34 * UNIT)
            .y_label_area_size(72 * UNIT)
            .build_cartesian_2d(across, along)?;
        axes!(chart)
            .x_desc(figure.across.as_str())
            .y_desc(figure.along)
            .y_labels(5)
            .x_label_formatter(&|x| tick(*x, width))
            .y_label_formatter(&|y| tick(*y, height))
            .draw()?;
        for mark in &figure.marks {
            let line = [(*mark, low), (*mark, high)];
            chart.draw_series(LineSeries::new(line, BLACK.stroke_width(UNIT)))?;
        }
        chart.draw_series(figure.points.iter().map(|(x, y, grows)| {
            let colour = COLOURS[usize::from(*grows)];
            Circle::new((*x, *y), POINT, colour.filled())
        }))?;
    }
    sheet.present()?;
    Ok(())
}
