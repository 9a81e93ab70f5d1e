//! The paper's figures: the path in normal coordinates, and the power of friction over the direction; and
//! the control forces.

use plotters::prelude::*;

use super::found::FastestResult;
use crate::plot::{COLOURS, PANEL, UNIT, WIDTH, axes, font, range, tick};

/// One figure.
struct Figure {
    across: String,
    along: String,
    curves: Vec<(String, Vec<(f64, f64)>)>,
}

/// The drawing as SVG text.
///
/// # Errors
/// An error of the drawing library, as a sentence.
pub fn svg(title: &str, found: &FastestResult<'_>) -> Result<String, String> {
    let figures = figures(found);
    let height = 48 * UNIT + PANEL * figures.len() as u32;
    let mut text = String::new();
    draw(
        title,
        &figures,
        SVGBackend::with_string(&mut text, (WIDTH, height)),
    )
    .map_err(|error| error.to_string())?;
    let drawn = format!("width=\"{WIDTH}\" height=\"{height}\"");
    let shown = format!("width=\"{}\" height=\"{}\"", WIDTH / UNIT, height / UNIT);
    Ok(text.replacen(&drawn, &shown, 1))
}

fn figures(found: &FastestResult<'_>) -> Vec<Figure> {
    let moments = &found.moments;
    let mut figures = Vec::new();
    if let (Some(angles), Some(problem)) = (&found.angles, found.motion.problem()) {
        let normal = moments.iter().map(|moment| problem.to_normal(&moment.q));
        figures.push(Figure {
            across: "normal coordinate 1".into(),
            along: "normal coordinate 2".into(),
            curves: vec![(String::new(), normal.map(|q| (q[0], q[1])).collect())],
        });
        let power = angles.iter().zip(moments);
        figures.push(Figure {
            across: "ε [rad]".into(),
            along: "power of friction [W]".into(),
            curves: vec![(
                String::new(),
                power
                    .map(|(e, moment)| (*e, moment.friction_power))
                    .collect(),
            )],
        });
    }
    if let ([first, second], None) = (found.names.as_slice(), &found.angles) {
        let points = moments.iter().map(|moment| (moment.q[0], moment.q[1]));
        figures.push(Figure {
            across: first.clone(),
            along: second.clone(),
            curves: vec![(String::new(), points.collect())],
        });
    }
    let controls = found.names.iter().enumerate().map(|(i, name)| {
        let values = moments
            .iter()
            .map(|moment| (moment.time, moment.control[i]));
        (name.clone(), values.collect())
    });
    figures.push(Figure {
        across: "t [s]".into(),
        along: "control forces [N]".into(),
        curves: controls.collect(),
    });
    figures
}

type Drawing<T> = Result<T, Box<dyn std::error::Error>>;

fn draw(title: &str, figures: &[Figure], backend: SVGBackend) -> Drawing<()> {
    let sheet = backend.into_drawing_area();
    sheet.fill(&WHITE)?;
    let sheet = sheet.margin(8 * UNIT, 0, 0, 0).titled(title, font(18))?;
    for (area, figure) in sheet.split_evenly((figures.len(), 1)).iter().zip(figures) {
        draw_figure(figure, area)?;
    }
    sheet.present()?;
    Ok(())
}

fn draw_figure(
    figure: &Figure,
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
) -> Drawing<()> {
    let points = || figure.curves.iter().flat_map(|(_, points)| points);
    let across = range(points().map(|(x, _)| *x));
    let along = range(points().map(|(_, y)| *y));
    let (width, height) = (across.end - across.start, along.end - along.start);
    let mut chart = ChartBuilder::on(area)
        .margin(6 * UNIT)
        .margin_right(20 * UNIT)
        .x_label_area_size(34 * UNIT)
        .y_label_area_size(72 * UNIT)
        .build_cartesian_2d(across, along)?;
    axes!(chart)
        .x_desc(figure.across.as_str())
        .y_desc(figure.along.as_str())
        .y_labels(5)
        .x_label_formatter(&|x| tick(*x, width))
        .y_label_formatter(&|y| tick(*y, height))
        .draw()?;
    for ((name, points), colour) in figure.curves.iter().zip(COLOURS.iter().cycle()) {
        let line = LineSeries::new(points.iter().copied(), colour.stroke_width(UNIT + UNIT / 4));
        let drawn = chart.draw_series(line)?;
        if !name.is_empty() {
            let colour = *colour;
            drawn.label(name.as_str()).legend(move |(x, y)| {
                PathElement::new(
                    [(x, y), (x + 12 * UNIT as i32, y)],
                    colour.stroke_width(2 * UNIT),
                )
            });
        }
    }
    if figure.curves.len() > 1 {
        chart
            .configure_series_labels()
            .label_font(font(12))
            .legend_area_size(20 * UNIT)
            .background_style(WHITE)
            .border_style(BLACK)
            .draw()?;
    }
    Ok(())
}
