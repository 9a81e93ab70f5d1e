//! Drawings of curves and points over any quantity, in the common style of all drawings.

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::plot::{COLOURS, Drawing, PANEL, UNIT, WIDTH, axes, curve, font, range, svg_of, tick};
use crate::recording::thin;

/// The width of the legend beside a pane, the number of names that fit, and the number of points to which a
/// curve is thinned.
const LEGEND: u32 = 150 * UNIT;
const NAMES: usize = 11;
const POINTS: usize = 1500;

/// A rectangle with axes of its own.
pub struct Pane {
    /// The names of the axes, with units.
    pub along: [String; 2],
    /// The curves.
    pub curves: Vec<Curve>,
    /// Whether curves are drawn as separate points.
    pub are_points: bool,
}

/// A curve, or a set of points.
pub struct Curve {
    pub name: String,
    pub points: Vec<(f64, f64)>,
}

/// Panes from top to bottom, as SVG text.
///
/// # Errors
/// An error of the drawing library.
pub fn svg(title: &str, panes: &[Pane]) -> Result<String, String> {
    let height = 48 * UNIT + PANEL * panes.len().max(1) as u32;
    svg_of(height, |backend| {
        let sheet = backend.into_drawing_area();
        sheet.fill(&WHITE)?;
        let sheet = sheet.margin(8 * UNIT, 0, 0, 0).titled(title, font(18))?;
        let areas = sheet.split_evenly((panes.len().max(1), 1));
        for (area, pane) in areas.iter().zip(panes) {
            draw(area, pane)?;
        }
        sheet.present()?;
        Ok(())
    })
}

fn draw(area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>, pane: &Pane) -> Drawing<()> {
    let points = || pane.curves.iter().flat_map(|curve| curve.points.iter());
    let across = range(points().map(|(x, _)| *x));
    let upwards = range(points().map(|(_, y)| *y));
    let (area, beside) = area.split_horizontally(WIDTH - LEGEND);
    let [width, height] = [&across, &upwards].map(|range| range.end - range.start);
    let mut chart = ChartBuilder::on(&area)
        .margin(6 * UNIT)
        .margin_right(2 * UNIT)
        .x_label_area_size(34 * UNIT)
        .y_label_area_size(72 * UNIT)
        .build_cartesian_2d(across, upwards)?;
    axes!(chart)
        .x_desc(pane.along[0].as_str())
        .y_desc(pane.along[1].as_str())
        .y_labels(5)
        .x_label_formatter(&|x| tick(*x, width))
        .y_label_formatter(&|y| tick(*y, height))
        .draw()?;
    let colours = COLOURS.iter().cycle();
    for (curve, colour) in pane.curves.iter().zip(colours.clone()) {
        let is_finite = |(x, y): &(f64, f64)| x.is_finite() && y.is_finite();
        let points = curve.points.iter().copied();
        if pane.are_points {
            let finite = points.filter(is_finite);
            let dots = finite.map(|point| Circle::new(point, UNIT, colour.filled()));
            chart.draw_series(dots)?;
        } else {
            let or_gap = |point: (f64, f64)| {
                if is_finite(&point) {
                    point
                } else {
                    (point.0, f64::NAN)
                }
            };
            let (x, y): (Vec<f64>, Vec<f64>) = points.map(or_gap).unzip();
            curve!(chart, &thin(&x, &y, POINTS), colour);
        }
    }
    let place = |row: usize| (row as i32 * 17 + 16) * UNIT as i32;
    for (row, (curve, colour)) in pane.curves.iter().zip(colours).take(NAMES).enumerate() {
        let (left, y) = (4 * UNIT as i32, place(row));
        let line = [(left, y), (left + 16 * UNIT as i32, y)];
        beside.draw(&PathElement::new(line, colour.stroke_width(2 * UNIT)))?;
        let middle = font(12).pos(Pos::new(HPos::Left, VPos::Center));
        let text = Text::new(curve.name.clone(), (left + 22 * UNIT as i32, y), middle);
        beside.draw(&text)?;
    }
    if pane.curves.len() > NAMES {
        let more = format!("and {} more", pane.curves.len() - NAMES);
        beside.draw(&Text::new(more, (4 * UNIT as i32, place(NAMES)), font(12)))?;
    }
    Ok(())
}
