//! `lagrangian map`: the results of a sweep as a drawing.

mod page;

use std::cell::RefCell;
use std::path::{Path, PathBuf};

use lagrangian_sweep::samples_beside;
use lagrangian_sweep::table::{cells, csv_cells};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::call;
use crate::failure::{Failure, help_with};
use crate::output::{self, Destination, PAGE, SVG, keep_apart};
use crate::plot::{COLOURS, Drawing, PANEL, UNIT, WIDTH, axes, font, range, short, svg_of, tick};
use crate::recording::parts;
use crate::report::base64;

/// The most cells; more would give an image of more than 16 MB.
const MOST_CELLS: usize = 1 << 24;

/// Up to this number of cells are drawn as rectangles, more as an image: viewers of drawings take seconds for some
/// ten thousand shapes.
const MOST_RECTANGLES: usize = 20_000;

/// The number of pixels of an image whose cells have different widths.
const PIXELS: usize = 2000;

/// The most curves of one quantity.
const MOST_CURVES: usize = 12;

/// The most dots of a drawing, and of a page.
const MOST_DOTS: [usize; 2] = [200_000, 4_000_000];

/// How far the values of a grid are from those of its formula, relative to the greatest: a few units of round-off.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// The height of a heat map, and the width of its color scale.
const HEAT: u32 = 480 * UNIT;
const SCALE: u32 = 120 * UNIT;

/// Colours from the least value to the greatest, perceptually uniform, in print and for colour-blind readers: viridis, by S. van
/// der Walt and N. Smith (2015), at nine points.
const VIRIDIS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

/// The colour of missing values: runs that failed.
const MISSING: RGBColor = RGBColor(190, 190, 190);

/// Axes with labels, as in the drawings of runs; `$spans` are those of the axes.
macro_rules! mesh {
    ($chart:expr, $x:expr, $y:expr, $spans:expr) => {
        axes!($chart)
            .x_desc($x.as_str())
            .y_desc($y)
            .x_label_formatter(&|x| tick(*x, $spans[0]))
            .y_label_formatter(&|y| tick(*y, $spans[1]))
            .draw()?
    };
}

/// The rows of a sweep: names of columns, how many of them were varied, and the cells.
struct Rows {
    names: Vec<String>,
    varied: usize,
    rows: Vec<Vec<String>>,
}

/// Runs the command.
///
/// # Errors
/// If the table or the call is invalid, or the drawing cannot be written.
pub fn run(call: &call::Map) -> Result<(), Failure> {
    let files = [
        Destination::of("--plot", call.plot.as_ref(), SVG)?,
        Destination::of("--report", call.report.as_ref(), PAGE)?,
    ];
    let samples = samples_beside(&call.table);
    let mut read = vec![(call.table.as_path(), "the table")];
    if call.samples {
        read.push((&samples, "the samples beside the table"));
    }
    keep_apart(files.iter().flatten(), &read)?;
    for (option, list) in [("--of", &call.of), ("--over", &call.over)] {
        call::refuse_twice(option, list.iter().map(String::as_str)).map_err(Failure::Call)?;
    }
    let mut rows = Rows::read(&call.table)?;
    if call.samples {
        rows = rows.with_samples(&samples)?;
    }
    for only in &call.only {
        rows.keep_only(&only.name, &only.value)?;
    }
    if rows.rows.is_empty() {
        return Err(Failure::Call("no row is left to plot".into()));
    }
    let over: Vec<String> = if call.over.is_empty() {
        rows.names[1..=rows.varied].to_vec()
    } else {
        call.over.clone()
    };
    let quantities = call
        .of
        .iter()
        .map(|name| Ok((name.as_str(), rows.numbers(name)?)));
    let quantities = quantities.collect::<Result<Vec<_>, Failure>>()?;
    let over: Vec<&str> = over.iter().map(String::as_str).collect();
    let drawing = Picture::new(&rows, &over, &quantities, call.samples)?;
    let [plot, report] = &files;
    if let Some(plot) = plot {
        let text = match &drawing {
            Picture::Curves(curves) => curves.svg()?,
            Picture::Heat(heat) => heat.svg()?,
        };
        plot.write_text(&text)?;
    }
    if let Some(report) = report {
        let name = call.table.file_name().unwrap_or_default();
        let title = format!("{} over {}", call.of.join(", "), over.join(" and "));
        report.write_text(&page::text(&title, &name.to_string_lossy(), &drawing))?;
    }
    let written: Vec<String> = [&call.plot, &call.report]
        .into_iter()
        .flatten()
        .map(|path: &PathBuf| path.display().to_string())
        .collect();
    output::line(format_args!(
        "{} of {} {} over {}, {}",
        call.of.join(", "),
        rows.rows.len(),
        if call.samples { "samples" } else { "rows" },
        over.join(" and "),
        written.join(", ")
    ));
    Ok(())
}

/// The kind of drawing.
enum Picture<'a> {
    Curves(Curves<'a>),
    Heat(Heat<'a>),
}

impl<'a> Picture<'a> {
    /// Quantities over one parameter, or one quantity over two.
    fn new(
        rows: &Rows,
        over: &[&'a str],
        quantities: &'a [(&'a str, Vec<f64>)],
        are_samples: bool,
    ) -> Result<Picture<'a>, Failure> {
        match *over {
            [x] => Ok(Picture::Curves(Curves::new(
                rows,
                x,
                quantities,
                are_samples,
            )?)),
            [x, y] if are_samples => Err(Failure::Call(format!(
                "samples are plotted over one parameter, --over {x} or --over {y}: over two, many would coincide"
            ))),
            [x, y] => {
                let [(name, values)] = quantities else {
                    return Err(Failure::Call(
                        "a map over two parameters shows one quantity: --of NAME".into(),
                    ));
                };
                Ok(Picture::Heat(Heat::new(rows, [x, y], (name, values))?))
            }
            _ => Err(Failure::Call(format!(
                "a map is plotted over one or two parameters, as in --over {}; the varied parameters are {}",
                rows.names.get(1).map_or("NAME", String::as_str),
                rows.names[1..=rows.varied].join(", ")
            ))),
        }
    }
}

/// The cells of a table, with the header first.
fn table(path: &Path) -> Result<Vec<Vec<String>>, Failure> {
    let wrong = |why: String| Failure::Call(format!("{}: {why}", path.display()));
    if path.extension().is_some_and(|ending| ending == "parquet") {
        return cells(path).map_err(|error| wrong(error.to_string()));
    }
    let text = std::fs::read_to_string(path).map_err(|error| wrong(error.to_string()))?;
    // Some programs write this mark before the first name.
    let text = text.strip_prefix('\u{feff}').unwrap_or(&text);
    let header = text.lines().next().unwrap_or_default();
    let mut others = [(';', "semicolons"), ('\t', "tabs")].into_iter();
    let other = others.find(|(letter, _)| !header.contains(',') && header.contains(*letter));
    if let Some((_, separators)) = other {
        return Err(wrong(format!(
            "the columns of a sweep are separated by commas, not by {separators}"
        )));
    }
    csv_cells(text).map_err(wrong)
}

impl Rows {
    fn read(path: &Path) -> Result<Rows, Failure> {
        let wrong = |why: String| Failure::Call(format!("{}: {why}", path.display()));
        let mut all = table(path)?.into_iter();
        let names = all.next().unwrap_or_default();
        let varied = names.iter().position(|name| name == "status");
        let varied = varied.filter(|_| names.first().is_some_and(|name| name == "run"));
        let Some(varied) = varied else {
            return Err(wrong(
                "it is not the table of a sweep: it has no columns `run` and `status`".into(),
            ));
        };
        let rows: Vec<Vec<String>> = all.collect();
        if let Some(row) = rows.iter().position(|row| row.len() != names.len()) {
            return Err(wrong(format!(
                "row {} does not have as many cells as there are columns",
                row + 1
            )));
        }
        Ok(Rows {
            varied: varied - 1,
            names,
            rows,
        })
    }

    /// The samples that belong to these rows, each preceded by its varied values.
    fn with_samples(self, path: &Path) -> Result<Rows, Failure> {
        let wrong = |why: &str| Failure::Call(format!("{}: {why}", path.display()));
        let missing = |failure: Failure| {
            if path.exists() {
                failure
            } else {
                Failure::Call(format!(
                    "the table has no file of samples, {}: a sweep writes one with --record every=T or --record event=NAME",
                    path.display()
                ))
            }
        };
        let mut all = table(path).map_err(missing)?.into_iter();
        let names = all.next().unwrap_or_default();
        if names.first().is_none_or(|name| name != "run") {
            return Err(wrong(
                "these are not the samples of a sweep: the first column is not `run`",
            ));
        }
        let of_run: std::collections::HashMap<&str, &[String]> = self
            .rows
            .iter()
            .map(|row| (row[0].as_str(), &row[1..=self.varied]))
            .collect();
        let joined = all.map(|sample| {
            let varied = sample.first().and_then(|run| of_run.get(run.as_str()));
            let varied = varied
                .ok_or_else(|| wrong("a sample belongs to a run that is not in the table"))?;
            if sample.len() == names.len() {
                Ok([&sample[..1], varied, &sample[1..]].concat())
            } else {
                Err(wrong(
                    "a row does not have as many cells as there are columns",
                ))
            }
        });
        Ok(Rows {
            rows: joined.collect::<Result<_, _>>()?,
            varied: self.varied,
            names: [&names[..1], &self.names[1..=self.varied], &names[1..]].concat(),
        })
    }

    fn place(&self, name: &str) -> Result<usize, Failure> {
        let found = self.names.iter().position(|known| known == name);
        found.ok_or_else(|| {
            let help = help_with(name, self.names.iter().map(String::as_str));
            Failure::Call(format!("no column named `{name}`; {help}"))
        })
    }

    /// The numbers of a column; other entries become NaN.
    fn numbers(&self, name: &str) -> Result<Vec<f64>, Failure> {
        let place = self.place(name)?;
        let cells = self.rows.iter().map(|row| row[place].as_str());
        let numbers: Vec<f64> = cells.map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
        if numbers.iter().any(|number| number.is_finite()) {
            Ok(numbers)
        } else {
            Err(Failure::Call(format!(
                "column `{name}` does not contain numbers"
            )))
        }
    }

    /// Removes all rows with a different value. Values of a grid are rounded, so that 0.3 may stand as 0.30000000000000004.
    fn keep_only(&mut self, name: &str, value: &str) -> Result<(), Failure> {
        let place = self.place(name)?;
        let wanted = call::number(value)
            .map_err(|why| Failure::Call(format!("--only {name}={value}: {why}")))?;
        let number = |row: &Vec<String>| row[place].parse::<f64>().ok();
        let numbers = || self.rows.iter().filter_map(number);
        let greatest = numbers().fold(0.0, |greatest: f64, x| greatest.max(x.abs()));
        let nearest = numbers().min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs()));
        let Some(nearest) = nearest.filter(|x| (x - wanted).abs() <= ROUNDING * greatest) else {
            return Err(Failure::Call(format!(
                "--only {name}={value}: no row has this value"
            )));
        };
        self.rows.retain(|row| number(row) == Some(nearest));
        Ok(())
    }

    /// The varied columns with several values, except some of them.
    fn others(&self, but: &[&str]) -> Vec<usize> {
        let places = 1..=self.varied;
        let differs = |place: &usize| {
            self.rows
                .iter()
                .any(|row| row[*place] != self.rows[0][*place])
        };
        places
            .filter(|place| !but.contains(&self.names[*place].as_str()))
            .filter(differs)
            .collect()
    }
}

/// Curves over one parameter, with a panel for each quantity and a curve for each set of the other parameters;
/// dots for samples.
struct Curves<'a> {
    x: &'a str,
    along: Vec<f64>,
    quantities: &'a [(&'a str, Vec<f64>)],
    /// The legends of the curves, and the curve to which each row belongs.
    legends: Vec<String>,
    set_of: Vec<usize>,
    are_dots: bool,
}

impl<'a> Curves<'a> {
    fn new(
        rows: &Rows,
        x: &'a str,
        quantities: &'a [(&'a str, Vec<f64>)],
        are_dots: bool,
    ) -> Result<Curves<'a>, Failure> {
        let along = rows.numbers(x)?;
        if along.len() * quantities.len() > MOST_DOTS[1] {
            return Err(Failure::Call(format!(
                "more than {} values would be plotted: select some by --only NAME=VALUE",
                MOST_DOTS[1]
            )));
        }
        let others = rows.others(&[x]);
        let mut sets: Vec<Vec<&str>> = Vec::new();
        let mut set_of = Vec::with_capacity(rows.rows.len());
        for row in &rows.rows {
            let set: Vec<&str> = others.iter().map(|place| row[*place].as_str()).collect();
            let place = sets.iter().position(|known| *known == set);
            let place = place.unwrap_or_else(|| {
                sets.push(set);
                sets.len() - 1
            });
            if sets.len() > MOST_CURVES {
                let names = others.iter().map(|place| rows.names[*place].as_str());
                let names: Vec<&str> = names.collect();
                return Err(Failure::Call(format!(
                    "more than {MOST_CURVES} curves over {x}, one for each value of {}: select some by --only {}=VALUE",
                    names.join(", "),
                    names[0]
                )));
            }
            set_of.push(place);
        }
        let legend = |set: &Vec<&str>| {
            let named = others.iter().zip(set);
            let named = named.map(|(place, value)| {
                let value = value.parse().map_or((*value).to_owned(), short);
                format!("{} = {value}", rows.names[*place])
            });
            named.collect::<Vec<_>>().join(", ")
        };
        Ok(Curves {
            x,
            along,
            quantities,
            legends: sets.iter().map(legend).collect(),
            set_of,
            are_dots,
        })
    }

    /// The points of a set. Those of a curve are sorted, and where a run failed their value is NaN, a gap in the curve.
    fn points(&self, set: usize, values: &[f64]) -> Vec<(f64, f64)> {
        let mut points: Vec<(f64, f64)> = (0..self.along.len())
            .filter(|row| self.set_of[*row] == set)
            .map(|row| (self.along[row], values[row]))
            .map(|(x, y)| (x, if y.is_finite() { y } else { f64::NAN }))
            .filter(|(x, y)| x.is_finite() && (y.is_finite() || !self.are_dots))
            .collect();
        if !self.are_dots {
            points.sort_by(|one, other| one.0.total_cmp(&other.0));
        }
        points
    }

    fn svg(&self) -> Result<String, Failure> {
        let Curves {
            x,
            along,
            quantities,
            ..
        } = self;
        if along.len() * quantities.len() > MOST_DOTS[0] {
            return Err(Failure::Call(format!(
                "there are more than {} dots, too many for viewers of drawings: --report FILE.html shows them",
                MOST_DOTS[0]
            )));
        }
        let x = (*x).to_owned();
        let height = PANEL * quantities.len() as u32 + 8 * UNIT;
        let draw = |backend: SVGBackend<'_>| -> Drawing<()> {
            let sheet = backend.into_drawing_area();
            sheet.fill(&WHITE)?;
            let areas = sheet.split_evenly((quantities.len(), 1));
            for (area, (name, values)) in areas.iter().zip(*quantities) {
                let (left, beside) = area.split_horizontally(WIDTH - 2 * SCALE);
                let ranges =
                    [along.as_slice(), values.as_slice()].map(|all| range(all.iter().copied()));
                let spans = ranges.each_ref().map(|range| range.end - range.start);
                let [across, upwards] = ranges;
                let mut chart = ChartBuilder::on(&left)
                    .margin(6 * UNIT)
                    .x_label_area_size(34 * UNIT)
                    .y_label_area_size(72 * UNIT)
                    .build_cartesian_2d(across, upwards)?;
                mesh!(chart, x, *name, spans);
                for (number, legend) in self.legends.iter().enumerate() {
                    let colour = COLOURS[number % COLOURS.len()];
                    let points = self.points(number, values);
                    if !self.are_dots {
                        for part in parts(&points) {
                            let line = part.iter().copied();
                            chart.draw_series(LineSeries::new(line, colour.stroke_width(UNIT)))?;
                        }
                    }
                    // The density of many samples must be visible.
                    let radius = if self.are_dots { UNIT / 2 } else { UNIT };
                    let dots = parts(&points)
                        .flatten()
                        .map(|point| Circle::new(*point, radius as i32, colour.filled()));
                    chart.draw_series(dots)?;
                    if legend.is_empty() {
                        continue;
                    }
                    let y = (number as i32 * 15 + 16) * UNIT as i32;
                    let line = [(4 * UNIT as i32, y), (20 * UNIT as i32, y)];
                    beside.draw(&PathElement::new(line, colour.stroke_width(2 * UNIT)))?;
                    let style = font(11).pos(Pos::new(HPos::Left, VPos::Center));
                    let at = (26 * UNIT as i32, y);
                    beside.draw(&Text::new(legend.clone(), at, style))?;
                }
            }
            sheet.present()?;
            Ok(())
        };
        svg_of(height, draw).map_err(Failure::Run)
    }
}

/// A quantity as colours over two parameters.
struct Heat<'a> {
    names: [&'a str; 2],
    name: &'a str,
    /// The values of the parameters, sorted.
    columns: Vec<f64>,
    lines: Vec<f64>,
    /// The values line by line; NaN for a run that failed.
    cells: Vec<f64>,
}

impl<'a> Heat<'a> {
    fn new(
        rows: &Rows,
        [x, y]: [&'a str; 2],
        (name, values): (&'a str, &[f64]),
    ) -> Result<Heat<'a>, Failure> {
        let [across, up] = [rows.numbers(x)?, rows.numbers(y)?];
        let [columns, lines] = [&across, &up].map(|values| distinct(values));
        if columns.len().saturating_mul(lines.len()) > MOST_CELLS {
            return Err(Failure::Call(format!(
                "{} times {} cells are more than the maximum of {MOST_CELLS}",
                columns.len(),
                lines.len()
            )));
        }
        if let Some(place) = rows.others(&[x, y]).first() {
            return Err(Failure::Call(format!(
                "several runs are at the same place, with different values of {}: select one by --only {}=VALUE",
                rows.names[*place], rows.names[*place]
            )));
        }
        let place = |all: &[f64], value: f64| all.partition_point(|known| *known < value);
        let mut cells = vec![f64::NAN; columns.len() * lines.len()];
        for ((x, y), value) in across.iter().zip(&up).zip(values) {
            if x.is_finite() && y.is_finite() {
                cells[place(&lines, *y) * columns.len() + place(&columns, *x)] = *value;
            }
        }
        Ok(Heat {
            names: [x, y],
            name,
            columns,
            lines,
            cells,
        })
    }

    /// The least and the greatest value.
    fn scale(&self) -> [f64; 2] {
        let finite = self.cells.iter().copied().filter(|value| value.is_finite());
        let low = finite.clone().fold(f64::INFINITY, f64::min);
        [low, finite.fold(f64::NEG_INFINITY, f64::max)]
    }

    fn svg(&self) -> Result<String, Failure> {
        let Heat {
            columns,
            lines,
            cells,
            ..
        } = self;
        let (x, scale) = (self.names[0].to_owned(), self.scale());
        let [x_edges, y_edges] = [columns, lines].map(|values| edges(values));
        let is_image = cells.len() > MOST_RECTANGLES;
        let placed = RefCell::new([0_i32; 4]);
        let draw = |backend: SVGBackend<'_>| -> Drawing<()> {
            let sheet = backend.into_drawing_area();
            sheet.fill(&WHITE)?;
            let (left, beside) = sheet.split_horizontally(WIDTH - SCALE);
            let ends = |edges: &[f64]| edges[0]..edges[edges.len() - 1];
            let spans = [&x_edges, &y_edges].map(|edges| edges[edges.len() - 1] - edges[0]);
            let mut chart = ChartBuilder::on(&left)
                .margin(8 * UNIT)
                .x_label_area_size(34 * UNIT)
                .y_label_area_size(72 * UNIT)
                .build_cartesian_2d(ends(&x_edges), ends(&y_edges))?;
            mesh!(chart, x, self.names[1], spans);
            if is_image {
                let (across, down) = chart.plotting_area().get_pixel_range();
                *placed.borrow_mut() = [
                    across.start,
                    down.start,
                    across.end - across.start,
                    down.end - down.start,
                ];
            } else {
                let rectangles = cells.iter().enumerate().map(|(cell, value)| {
                    let (column, line) = (cell % columns.len(), cell / columns.len());
                    let corners = [
                        (x_edges[column], y_edges[line]),
                        (x_edges[column + 1], y_edges[line + 1]),
                    ];
                    Rectangle::new(corners, colour(*value, scale).filled())
                });
                chart.draw_series(rectangles)?;
            }
            legend(&beside, self.name, scale)?;
            sheet.present()?;
            Ok(())
        };
        let svg = svg_of(HEAT, draw).map_err(Failure::Run)?;
        if !is_image {
            return Ok(svg);
        }
        let [left, top, width, height] = placed.into_inner();
        let png = self.png([&x_edges, &y_edges]).map_err(Failure::run)?;
        let image = format!(
            "<image x=\"{left}\" y=\"{top}\" width=\"{width}\" height=\"{height}\" preserveAspectRatio=\"none\" \
             style=\"image-rendering:pixelated\" href=\"data:image/png;base64,{}\"/>\n</svg>",
            base64(&png)
        );
        Ok(svg.replace("</svg>", &image))
    }

    /// The cells as an image: one pixel for each if all are equally wide, starting with the highest line.
    fn png(&self, edges: [&[f64]; 2]) -> Result<Vec<u8>, png::EncodingError> {
        let [across, up] = edges.map(pixels);
        let [low, high] = self.scale();
        // The last colour is that of missing values.
        const MISSING_INDEX: u8 = 255;
        let index = |value: f64| {
            if !value.is_finite() {
                MISSING_INDEX
            } else if high > low {
                ((value - low) / (high - low) * 254.0).round() as u8
            } else {
                127
            }
        };
        let mut image = Vec::with_capacity(across.len() * up.len());
        for line in up.iter().rev() {
            let row = &self.cells[line * self.columns.len()..][..self.columns.len()];
            image.extend(across.iter().map(|column| index(row[*column])));
        }
        let palette = (0..=255_u8).flat_map(|index| {
            let RGBColor(r, g, b) = match index {
                MISSING_INDEX => MISSING,
                index => colour(f64::from(index) / 254.0, [0.0, 1.0]),
            };
            [r, g, b]
        });
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, across.len() as u32, up.len() as u32);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_palette(palette.collect::<Vec<u8>>());
        encoder.write_header()?.write_image_data(&image)?;
        Ok(bytes)
    }
}

/// The cell that each pixel shows: one pixel per cell if all are equally wide.
fn pixels(edges: &[f64]) -> Vec<usize> {
    let cells = edges.len() - 1;
    let (first, length) = (edges[0], edges[cells] - edges[0]);
    let even = |k: usize| first + length * k as f64 / cells as f64;
    let width = length / cells as f64;
    if (0..=cells).all(|k| (edges[k] - even(k)).abs() < 0.01 * width) {
        return (0..cells).collect();
    }
    let pixels = PIXELS.max(cells);
    let centre = |k: usize| first + length * (k as f64 + 0.5) / pixels as f64;
    let cell = |k: usize| edges.partition_point(|edge| *edge <= centre(k)) - 1;
    (0..pixels).map(|k| cell(k).min(cells - 1)).collect()
}

/// The color scale with its values.
fn legend(
    area: &DrawingArea<SVGBackend<'_>, plotters::coord::Shift>,
    name: &str,
    [low, high]: [f64; 2],
) -> Drawing<()> {
    let unit = UNIT as i32;
    let (top, bottom) = (40 * unit, HEAT as i32 - 60 * unit);
    const STEPS: i32 = 64;
    let at = |step: i32| bottom - (bottom - top) * step / STEPS;
    for step in 0..STEPS {
        let share = (f64::from(step) + 0.5) / f64::from(STEPS);
        let corners = [(10 * unit, at(step + 1)), (28 * unit, at(step))];
        area.draw(&Rectangle::new(corners, colour(share, [0.0, 1.0]).filled()))?;
    }
    area.draw(&Text::new(
        name.to_owned(),
        (10 * unit, 16 * unit),
        font(13),
    ))?;
    for mark in 0..=4 {
        let value = low + (high - low) * f64::from(mark) / 4.0;
        let style = font(12).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(
            tick(value, high - low),
            (34 * unit, at(mark * STEPS / 4)),
            style,
        ))?;
    }
    Ok(())
}

/// The colour of a value on a scale.
fn colour(value: f64, [low, high]: [f64; 2]) -> RGBColor {
    if !value.is_finite() {
        return MISSING;
    }
    let share = if high > low {
        ((value - low) / (high - low)).clamp(0.0, 1.0)
    } else {
        0.5
    };
    let place = share * (VIRIDIS.len() - 1) as f64;
    let before = (place as usize).min(VIRIDIS.len() - 2);
    let part = place - before as f64;
    let [r, g, b] = std::array::from_fn(|k| {
        let [from, to] = [VIRIDIS[before][k], VIRIDIS[before + 1][k]].map(f64::from);
        (from + part * (to - from)).round() as u8
    });
    RGBColor(r, g, b)
}

/// The finite values that occur, in order.
fn distinct(values: &[f64]) -> Vec<f64> {
    let mut all: Vec<f64> = values
        .iter()
        .copied()
        .filter(|value| value.is_finite())
        .collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// The edges of cells around values: half-way to the neighbours, and as far beyond the ends.
fn edges(values: &[f64]) -> Vec<f64> {
    let between = values.windows(2).map(|pair| 0.5 * (pair[0] + pair[1]));
    let between: Vec<f64> = between.collect();
    let (first, last) = (values[0], values[values.len() - 1]);
    let alone = if first == 0.0 { 0.5 } else { 0.5 * first.abs() };
    let start = between
        .first()
        .map_or(first - alone, |edge| 2.0 * first - edge);
    let end = between
        .last()
        .map_or(last + alone, |edge| 2.0 * last - edge);
    std::iter::once(start).chain(between).chain([end]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_meet_half_way() {
        assert_eq!(edges(&[1.0, 2.0, 4.0]), [0.5, 1.5, 3.0, 5.0]);
        assert_eq!(edges(&[2.0]), [1.0, 3.0]);
        assert_eq!(edges(&[0.0]), [-0.5, 0.5]);
    }

    #[test]
    fn pixels_show_the_cell_that_they_lie_in() {
        assert_eq!(pixels(&[0.0, 1.0, 2.0, 3.0]), [0, 1, 2]);
        let shown = pixels(&[0.0, 1.0, 4.0]);
        assert_eq!(shown.len(), PIXELS);
        // The first cell has a quarter of the width.
        assert_eq!(shown.iter().filter(|cell| **cell == 0).count(), PIXELS / 4);
    }

    #[test]
    fn an_image_has_the_colours_of_its_cells() {
        let heat = Heat {
            names: ["x", "y"],
            name: "z",
            columns: vec![0.0, 1.0],
            lines: vec![0.0, 1.0],
            cells: vec![0.0, 1.0, f64::NAN, 1.0],
        };
        let png = heat.png([&[-0.5, 0.5, 1.5]; 2]).expect("an image");
        let mut reader = png::Decoder::new(std::io::Cursor::new(&png))
            .read_info()
            .expect("an image");
        let palette = reader.info().palette.clone().expect("colours");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
        reader.next_frame(&mut pixels).expect("an image");
        let shown = |pixel: usize| &palette[3 * usize::from(pixels[pixel])..][..3];
        // The upper line comes first.
        assert_eq!(shown(0), [190, 190, 190]);
        assert_eq!(shown(1), [253, 231, 37]);
        assert_eq!(shown(2), [68, 1, 84]);
        assert_eq!(shown(3), [253, 231, 37]);
    }

    #[test]
    fn colours_go_from_end_to_end() {
        assert_eq!(colour(0.0, [0.0, 2.0]), RGBColor(68, 1, 84));
        assert_eq!(colour(2.0, [0.0, 2.0]), RGBColor(253, 231, 37));
        assert_eq!(colour(1.0, [0.0, 2.0]), RGBColor(33, 144, 141));
        assert_eq!(colour(f64::NAN, [0.0, 2.0]), MISSING);
        assert_eq!(colour(3.0, [3.0, 3.0]), RGBColor(33, 144, 141));
    }
}
