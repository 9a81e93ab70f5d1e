//! Drawings of a run for print: coordinates, energies, and the residual of the energy balance.

use plotters::prelude::*;
use plotters::style::FontFamily;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::recording::{ColumnKind, Panel, Recording, extent, panels, thin};

/// Drawing units per 1/96 inch: the library rounds to whole units, and rounding to 1/96 inch would be visible as steps.
pub const UNIT: u32 = 8;

/// The width of the drawing (that of a page), of the legend, and the height of a panel.
pub const WIDTH: u32 = 760 * UNIT;
const LEGEND: u32 = 130 * UNIT;
pub const PANEL: u32 = 210 * UNIT;

/// The number of names that fit beside a panel.
const NAMES: usize = 12;

/// The number of points to which curves are thinned: more than a printer can resolve.
const POINTS: usize = 1500;

/// Colours that are distinct in print and for colour-blind readers: M. Okabe and K. Ito, *Color universal design* (2008).
pub const COLOURS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
    RGBColor(140, 140, 60),
];

/// The axes of a chart in the common style, as an expression; the caller adds their names.
macro_rules! axes {
    ($chart:expr) => {
        $chart
            .configure_mesh()
            .light_line_style(TRANSPARENT)
            .bold_line_style(RGBColor(225, 225, 225).stroke_width(UNIT))
            .axis_style(BLACK.stroke_width(UNIT))
            .set_all_tick_mark_size(4 * UNIT)
            .label_style(font(12))
            .axis_desc_style(font(13))
    };
}
pub(crate) use axes;

/// Draws a thinned curve with its gaps, as an expression; a point between two gaps is a dot.
macro_rules! curve {
    ($chart:expr, $points:expr, $colour:expr) => {
        for part in $crate::recording::parts($points) {
            match part {
                [alone] => $chart.draw_series([Circle::new(*alone, UNIT, $colour.filled())])?,
                _ => $chart.draw_series(LineSeries::new(
                    part.iter().copied(),
                    $colour.stroke_width(UNIT + UNIT / 4),
                ))?,
            };
        }
    };
}
pub(crate) use curve;

/// The quantities that are drawn, from top to bottom.
const KINDS: [ColumnKind; 7] = [
    ColumnKind::Coordinate,
    ColumnKind::Output,
    ColumnKind::Input,
    ColumnKind::Multiplier,
    ColumnKind::Contact,
    ColumnKind::Energy,
    ColumnKind::Residual,
];

/// The drawing as SVG text, titled with the machine's name.
///
/// # Errors
/// An error of the drawing library, as a sentence.
pub fn svg(title: &str, recording: &Recording) -> Result<String, String> {
    let panels = panels(recording, &KINDS);
    let height = 48 * UNIT + PANEL * panels.len().max(1) as u32;
    svg_of(height, |backend| draw(title, recording, &panels, backend))
}

/// A drawing on a sheet of this height, as SVG text in whole units.
///
/// # Errors
/// An error of the drawing library, as a sentence.
pub fn svg_of(
    height: u32,
    draw: impl FnOnce(SVGBackend<'_>) -> Drawing<()>,
) -> Result<String, String> {
    let mut text = String::new();
    draw(SVGBackend::with_string(&mut text, (WIDTH, height))).map_err(|error| error.to_string())?;
    let drawn = format!("width=\"{WIDTH}\" height=\"{height}\"");
    let shown = format!("width=\"{}\" height=\"{}\"", WIDTH / UNIT, height / UNIT);
    Ok(text.replacen(&drawn, &shown, 1))
}

/// The result of drawing.
pub type Drawing<T> = Result<T, Box<dyn std::error::Error>>;

fn draw(title: &str, recording: &Recording, panels: &[Panel], backend: SVGBackend) -> Drawing<()> {
    let sheet = backend.into_drawing_area();
    sheet.fill(&WHITE)?;
    let sheet = sheet.margin(8 * UNIT, 0, 0, 0).titled(title, font(18))?;
    for (area, panel) in sheet
        .split_evenly((panels.len().max(1), 1))
        .iter()
        .zip(panels)
    {
        draw_panel(recording, panel, area)?;
    }
    sheet.present()?;
    Ok(())
}

/// The font of all texts.
pub fn font(size: u32) -> TextStyle<'static> {
    (FontFamily::SansSerif, size * UNIT)
        .into_font()
        .color(&BLACK)
}

fn draw_panel(
    recording: &Recording,
    panel: &Panel,
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
) -> Drawing<()> {
    let times = range(recording.times.iter().copied());
    let columns = panel.columns.iter();
    let values = columns.flat_map(|column| column.values.iter().copied());
    let values = range_beyond(panel.rounding(), values);
    let (area, beside) = area.split_horizontally(WIDTH - LEGEND);
    let (across, along) = (values.end - values.start, times.end - times.start);
    let mut chart = ChartBuilder::on(&area)
        .margin(6 * UNIT)
        .margin_right(2 * UNIT)
        .x_label_area_size(34 * UNIT)
        .y_label_area_size(72 * UNIT)
        .build_cartesian_2d(times, values)?;
    axes!(chart)
        .x_desc("t [s]")
        .y_desc(panel.label())
        .y_labels(5)
        .x_label_formatter(&|x| tick(*x, along))
        .y_label_formatter(&|y| tick(*y, across))
        .draw()?;
    let colours = COLOURS.iter().cycle();
    for (column, colour) in panel.columns.iter().zip(colours.clone()) {
        curve!(
            chart,
            &thin(&recording.times, &column.values, POINTS),
            colour
        );
    }
    let place = |row: usize| (row as i32 * 17 + 16) * UNIT as i32;
    for (row, (column, colour)) in panel.columns.iter().zip(colours).take(NAMES).enumerate() {
        let (left, y) = (4 * UNIT as i32, place(row));
        let line = [(left, y), (left + 16 * UNIT as i32, y)];
        beside.draw(&PathElement::new(line, colour.stroke_width(2 * UNIT)))?;
        let middle = font(12).pos(Pos::new(HPos::Left, VPos::Center));
        beside.draw(&Text::new(
            column.name.clone(),
            (left + 22 * UNIT as i32, y),
            middle,
        ))?;
    }
    if panel.columns.len() > NAMES {
        let more = format!("and {} more", panel.columns.len() - NAMES);
        beside.draw(&Text::new(more, (4 * UNIT as i32, place(NAMES)), font(12)))?;
    }
    Ok(())
}

/// The range of finite values with a margin of 1/20; a constant is centred in a range around it.
pub fn range(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    range_beyond(0.0, values)
}

/// The range of finite values with a margin, where values that vary by round-off only are a constant.
fn range_beyond(rounding: f64, values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let Some([low, high]) = extent(values) else {
        return 0.0..1.0;
    };
    let largest = low.abs().max(high.abs());
    let margin = match high - low {
        span if span > rounding => 0.05 * span,
        _ if largest <= rounding => 1.0,
        _ => 0.1 * largest,
    };
    (low - margin)..(high + margin)
}

/// The label of a tick on an axis of this span: the short one, or with as many digits as the tick needs to be where it is.
pub fn tick(x: f64, span: f64) -> String {
    // Ticks are multiples of a step, and round-off turns the one at zero into 7e-18.
    let x = if x.abs() < 1e-9 * span { 0.0 } else { x };
    let is_there = |label: &String| {
        let read = label.parse::<f64>();
        read.is_ok_and(|read| (read - x).abs() <= 0.01 * span)
    };
    let longer = |digits: usize| {
        if (1e-3..1e7).contains(&x.abs()) {
            format!("{x:.digits$}")
        } else {
            format!("{x:.digits$e}")
        }
    };
    let mut labels = std::iter::once(short(x)).chain((0..=17).map(longer));
    labels.find(is_there).unwrap_or_else(|| short(x))
}

/// A number for reading: in plain notation if short, otherwise with an exponent.
pub fn short(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e5).contains(&size) {
        let text = format!("{x:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        let text = format!("{x:.2e}");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let digits = digits.trim_end_matches('0').trim_end_matches('.');
        format!("{digits}e{exponent}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::Column;

    #[test]
    fn labels_are_short() {
        assert_eq!(short(0.25), "0.25");
        assert_eq!(short(12000.0), "12000");
        assert_eq!(short(1.5e-9), "1.5e-9");
        assert_eq!(short(-2e6), "-2e6");
    }

    #[test]
    fn ticks_that_differ_have_different_labels() {
        for (ticks, span, labels) in [
            (
                [199_800.0, 200_000.0, 200_200.0],
                660.0,
                ["199800", "2e5", "200200"],
            ),
            ([2.99998, 3.0, 3.00002], 6.6e-5, ["2.99998", "3", "3.00002"]),
            (
                [-1.234_5e9, -1.234_4e9, 7e-9],
                3e5,
                ["-1.2345e9", "-1.2344e9", "0"],
            ),
            ([0.1, 0.1 + 0.2, 0.4], 0.5, ["0.1", "0.3", "0.4"]),
        ] {
            assert_eq!(ticks.map(|x| tick(x, span)), labels);
        }
    }

    #[test]
    fn what_is_rounding_is_drawn_flat() {
        let of = |values: [f64; 2]| {
            let range = range_beyond(1e-12, values.into_iter());
            (range.start, range.end)
        };
        let near = |(a, b): (f64, f64), (c, d): (f64, f64)| {
            assert!((a - c).abs() < 1e-9 && (b - d).abs() < 1e-9, "{a} {b}")
        };
        near(of([-1e-16, 2e-17]), (-1.0, 1.0));
        near(of([2.0, 2.0 + 1e-15]), (1.8, 2.2));
        near(of([0.0, 1.0]), (-0.05, 1.05));
        // Without a bound on round-off every difference counts.
        let end = range([3e-17, 3e-17].into_iter()).end;
        assert!((end / 3.3e-17 - 1.0).abs() < 1e-15, "{end:e}");
    }

    /// A curve is not drawn where it has no values: beside the line in the legend there are its two parts.
    #[test]
    fn a_gap_in_a_curve_is_not_drawn() {
        let recording = Recording {
            times: vec![0.0, 1.0, 2.0, 3.0, 4.0],
            columns: vec![Column {
                name: "x".into(),
                unit: "m".into(),
                kind: ColumnKind::Output,
                values: vec![0.0, 1.0, f64::NAN, 1.0, 0.0],
            }],
        };
        let text = svg("Gap", &recording).unwrap();
        let lines = text.lines().filter(|line| line.starts_with("<polyline"));
        let count = lines.filter(|line| line.contains("#0072B2")).count();
        assert_eq!(count, 3, "{text}");
    }

    #[test]
    fn a_run_that_stands_still_can_be_drawn() {
        let column = |values| Column {
            name: "x".into(),
            unit: "m".into(),
            kind: ColumnKind::Coordinate,
            values,
        };
        for values in [
            vec![2.0, 2.0],
            vec![0.0, 0.0],
            vec![f64::NAN, f64::INFINITY],
            vec![1e300, -1e300],
        ] {
            let recording = Recording {
                times: vec![0.0, 1.0],
                columns: vec![column(values)],
            };
            assert!(svg("Still", &recording).unwrap().contains("</svg>"));
        }
        assert!(svg("Empty", &Recording::default()).is_ok());
    }
}
