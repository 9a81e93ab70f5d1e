//! `lagrangian map`: a sweep as a drawing.

use std::path::Path;

use lagrangian_sweep::table::{cells, csv_cells};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::call;
use crate::failure::Failure;
use crate::output::{self, Destination, SVG, keep_apart};
use crate::plot::{COLOURS, Drawing, PANEL, UNIT, WIDTH, axes, font, range, short, svg_of};

/// More cells than this no drawing shows apart, and no viewer opens.
const MOST_CELLS: usize = 160_000;

/// The most curves of one quantity.
const MOST_CURVES: usize = 12;

/// The height of a heat map, and the width of its scale.
const HEAT: u32 = 480 * UNIT;
const SCALE: u32 = 120 * UNIT;

/// Colours from the least value to the greatest, equally far apart to the eye, in print and for the colour-blind: viridis, by S. van
/// der Walt and N. Smith (2015), at nine places.
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

/// What is no number: a run that failed.
const MISSING: RGBColor = RGBColor(190, 190, 190);

/// Axes with labels, as in the drawings of runs.
macro_rules! mesh {
    ($chart:expr, $x:expr, $y:expr) => {
        axes!($chart)
            .x_desc($x.as_str())
            .y_desc($y)
            .x_label_formatter(&|x| short(*x))
            .y_label_formatter(&|y| short(*y))
            .draw()?
    };
}

/// The rows of a sweep: names of columns, which of them were varied, and the cells.
struct Rows {
    names: Vec<String>,
    varied: usize,
    rows: Vec<Vec<String>>,
}

/// Runs the command.
///
/// # Errors
/// If the table or the call is at fault, or the drawing cannot be written.
pub fn run(call: &call::Map) -> Result<(), Failure> {
    let to = Destination::new("--plot", &call.plot, SVG)?;
    keep_apart([&to], &[(&call.table, "the table")])?;
    let mut rows = Rows::read(&call.table)?;
    for only in &call.only {
        rows.keep_only(&only.name, &only.value)?;
    }
    if rows.rows.is_empty() {
        return Err(Failure::Call("no row is left to be drawn".into()));
    }
    let over: Vec<String> = match call.over.is_empty() {
        true => rows.names[1..=rows.varied].to_vec(),
        false => call.over.clone(),
    };
    let quantities = call
        .of
        .iter()
        .map(|name| Ok((name.as_str(), rows.numbers(name)?)));
    let quantities = quantities.collect::<Result<Vec<_>, Failure>>()?;
    let text = match over.as_slice() {
        [x] => curves(&rows, x, &quantities)?,
        [x, y] => {
            let [(name, values)] = quantities.as_slice() else {
                return Err(Failure::Call(
                    "a map over two parameters shows one quantity: --of NAME".into(),
                ));
            };
            heat(&rows, [x, y], (name, values))?
        }
        _ => {
            return Err(Failure::Call(format!(
                "a map is drawn over one or two parameters, as in --over {}; varied are {}",
                rows.names.get(1).map_or("NAME", String::as_str),
                rows.names[1..=rows.varied].join(", ")
            )));
        }
    };
    to.write_text(&text)?;
    output::line(format_args!(
        "{} of {} rows over {}, {}",
        call.of.join(", "),
        rows.rows.len(),
        over.join(" and "),
        call.plot.display()
    ));
    Ok(())
}

impl Rows {
    fn read(path: &Path) -> Result<Rows, Failure> {
        let wrong = |why: String| Failure::Call(format!("{}: {why}", path.display()));
        let all = match path.extension().is_some_and(|ending| ending == "parquet") {
            true => cells(path).map_err(|error| wrong(error.to_string()))?,
            false => {
                let text =
                    std::fs::read_to_string(path).map_err(|error| wrong(error.to_string()))?;
                csv_cells(&text).map_err(wrong)?
            }
        };
        let mut all = all.into_iter();
        let names = all.next().unwrap_or_default();
        let varied = names.iter().position(|name| name == "status");
        let varied = varied.filter(|_| names.first().is_some_and(|name| name == "run"));
        let Some(varied) = varied else {
            return Err(wrong(
                "it is no table of a sweep: it has no columns `run` and `status`".into(),
            ));
        };
        let rows: Vec<Vec<String>> = all.collect();
        if let Some(row) = rows.iter().position(|row| row.len() != names.len()) {
            return Err(wrong(format!(
                "row {row} has another number of cells than there are columns"
            )));
        }
        Ok(Rows {
            varied: varied - 1,
            names,
            rows,
        })
    }

    fn place(&self, name: &str) -> Result<usize, Failure> {
        let found = self.names.iter().position(|known| known == name);
        found.ok_or_else(|| {
            let names = self.names.iter().map(String::as_str);
            let help = match lagrangian_spec::diagnostic::nearest(name, names) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("there are: {}", self.names.join(", ")),
            };
            Failure::Call(format!("no column named `{name}`; {help}"))
        })
    }

    /// The numbers of a column; what is none is not a number.
    fn numbers(&self, name: &str) -> Result<Vec<f64>, Failure> {
        let place = self.place(name)?;
        let cells = self.rows.iter().map(|row| row[place].as_str());
        let numbers: Vec<f64> = cells.map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
        match numbers.iter().any(|number| number.is_finite()) {
            true => Ok(numbers),
            false => Err(Failure::Call(format!("column `{name}` holds no numbers"))),
        }
    }

    /// Leaves out all rows with another value.
    fn keep_only(&mut self, name: &str, value: &str) -> Result<(), Failure> {
        let place = self.place(name)?;
        let wanted = call::number(value)
            .map_err(|why| Failure::Call(format!("--only {name}={value}: {why}")))?;
        let is_wanted = |row: &Vec<String>| row[place].parse() == Ok(wanted);
        if !self.rows.iter().any(is_wanted) {
            return Err(Failure::Call(format!(
                "--only {name}={value}: no row has this value"
            )));
        }
        self.rows.retain(is_wanted);
        Ok(())
    }

    /// What of the varied columns takes several values, but for some of them.
    fn others(&self, but: &[&String]) -> Vec<usize> {
        let places = 1..=self.varied;
        let differs = |place: &usize| {
            self.rows
                .iter()
                .any(|row| row[*place] != self.rows[0][*place])
        };
        places
            .filter(|place| !but.contains(&&self.names[*place]))
            .filter(differs)
            .collect()
    }
}

/// Curves over one parameter, a panel for each quantity, a curve for each set of the other parameters.
fn curves(rows: &Rows, x: &String, quantities: &[(&str, Vec<f64>)]) -> Result<String, Failure> {
    let along = rows.numbers(x)?;
    let others = rows.others(&[x]);
    let mut sets: Vec<Vec<&str>> = Vec::new();
    let mut set_of = Vec::with_capacity(rows.rows.len());
    for row in &rows.rows {
        let set: Vec<&str> = others.iter().map(|place| row[*place].as_str()).collect();
        let place = sets
            .iter()
            .position(|known| *known == set)
            .unwrap_or_else(|| {
                sets.push(set);
                sets.len() - 1
            });
        if sets.len() > MOST_CURVES {
            let names: Vec<&str> = others
                .iter()
                .map(|place| rows.names[*place].as_str())
                .collect();
            return Err(Failure::Call(format!(
                "more than {MOST_CURVES} curves over {x}, one for each value of {}: choose some by --only {}=VALUE",
                names.join(", "),
                names[0]
            )));
        }
        set_of.push(place);
    }
    let legend = |set: &[&str]| {
        let named = others.iter().zip(set);
        let named = named.map(|(place, value)| {
            let value = value.parse().map_or((*value).to_owned(), short);
            format!("{} = {value}", rows.names[*place])
        });
        named.collect::<Vec<_>>().join(", ")
    };
    let height = PANEL * quantities.len() as u32 + 8 * UNIT;
    let draw = |backend: SVGBackend<'_>| -> Drawing<()> {
        let sheet = backend.into_drawing_area();
        sheet.fill(&WHITE)?;
        let areas = sheet.split_evenly((quantities.len(), 1));
        for (area, (name, values)) in areas.iter().zip(quantities) {
            let (left, beside) = area.split_horizontally(WIDTH - 2 * SCALE);
            let mut chart = ChartBuilder::on(&left)
                .margin(6 * UNIT)
                .x_label_area_size(34 * UNIT)
                .y_label_area_size(72 * UNIT)
                .build_cartesian_2d(range(along.iter().copied()), range(values.iter().copied()))?;
            mesh!(chart, x, *name);
            for (number, set) in sets.iter().enumerate() {
                let colour = COLOURS[number % COLOURS.len()];
                let mut points: Vec<(f64, f64)> = (0..along.len())
                    .filter(|row| set_of[*row] == number)
                    .map(|row| (along[row], values[row]))
                    .filter(|(x, y)| x.is_finite() && y.is_finite())
                    .collect();
                points.sort_by(|one, other| one.0.total_cmp(&other.0));
                chart.draw_series(LineSeries::new(
                    points.iter().copied(),
                    colour.stroke_width(UNIT),
                ))?;
                let dots = points
                    .iter()
                    .map(|point| Circle::new(*point, UNIT as i32, colour.filled()));
                chart.draw_series(dots)?;
                if others.is_empty() {
                    continue;
                }
                let y = (number as i32 * 15 + 16) * UNIT as i32;
                let line = [(4 * UNIT as i32, y), (20 * UNIT as i32, y)];
                beside.draw(&PathElement::new(line, colour.stroke_width(2 * UNIT)))?;
                let style = font(11).pos(Pos::new(HPos::Left, VPos::Center));
                beside.draw(&Text::new(legend(set), (26 * UNIT as i32, y), style))?;
            }
        }
        sheet.present()?;
        Ok(())
    };
    svg_of(height, draw).map_err(Failure::Run)
}

/// A quantity as colours over two parameters.
fn heat(
    rows: &Rows,
    [x, y]: [&String; 2],
    (name, values): (&str, &[f64]),
) -> Result<String, Failure> {
    let [across, up] = [rows.numbers(x)?, rows.numbers(y)?];
    let [columns, lines] = [&across, &up].map(|values| distinct(values));
    if columns.len() * lines.len() > MOST_CELLS {
        return Err(Failure::Call(format!(
            "{} times {} cells are more than {MOST_CELLS}",
            columns.len(),
            lines.len()
        )));
    }
    let others = rows.others(&[x, y]);
    if let Some(place) = others.first() {
        return Err(Failure::Call(format!(
            "several runs are at one place, with other values of {}: choose one by --only {}=VALUE",
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
    let scale = {
        let finite = values.iter().copied().filter(|value| value.is_finite());
        let low = finite.clone().fold(f64::INFINITY, f64::min);
        let high = finite.fold(f64::NEG_INFINITY, f64::max);
        [low, high]
    };
    let [x_edges, y_edges] = [&columns, &lines].map(|values| edges(values));
    let draw = |backend: SVGBackend<'_>| -> Drawing<()> {
        let sheet = backend.into_drawing_area();
        sheet.fill(&WHITE)?;
        let (left, beside) = sheet.split_horizontally(WIDTH - SCALE);
        let ends = |edges: &[f64]| edges[0]..edges[edges.len() - 1];
        let mut chart = ChartBuilder::on(&left)
            .margin(8 * UNIT)
            .x_label_area_size(34 * UNIT)
            .y_label_area_size(72 * UNIT)
            .build_cartesian_2d(ends(&x_edges), ends(&y_edges))?;
        mesh!(chart, x, y.as_str());
        let rectangles = cells.iter().enumerate().map(|(cell, value)| {
            let (column, line) = (cell % columns.len(), cell / columns.len());
            let corners = [
                (x_edges[column], y_edges[line]),
                (x_edges[column + 1], y_edges[line + 1]),
            ];
            Rectangle::new(corners, colour(*value, scale).filled())
        });
        chart.draw_series(rectangles)?;
        legend(&beside, name, scale)?;
        sheet.present()?;
        Ok(())
    };
    svg_of(HEAT, draw).map_err(Failure::Run)
}

/// The colours with the values that they stand for.
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
    for tick in 0..=4 {
        let value = low + (high - low) * f64::from(tick) / 4.0;
        let style = font(12).pos(Pos::new(HPos::Left, VPos::Center));
        area.draw(&Text::new(
            short(value),
            (34 * unit, at(tick * STEPS / 4)),
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
    let share = match high > low {
        true => ((value - low) / (high - low)).clamp(0.0, 1.0),
        false => 0.5,
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

/// The edges of cells around values: half way to the next, and as far beyond the ends.
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
    fn colours_go_from_end_to_end() {
        assert_eq!(colour(0.0, [0.0, 2.0]), RGBColor(68, 1, 84));
        assert_eq!(colour(2.0, [0.0, 2.0]), RGBColor(253, 231, 37));
        assert_eq!(colour(1.0, [0.0, 2.0]), RGBColor(33, 144, 141));
        assert_eq!(colour(f64::NAN, [0.0, 2.0]), MISSING);
        assert_eq!(colour(3.0, [3.0, 3.0]), RGBColor(33, 144, 141));
    }
}
