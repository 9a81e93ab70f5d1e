//! The page of the fastest motion: the machine on its fastest path beside the machine without control.

use lagrangian::interpreted::{InterpretedMachine, Signals};
use lagrangian::{Machine, Simulation};
use lagrangian_mechanics::Compiled;
use serde_json::{Value, json};

use super::figures;
use super::found::FastestResult;
use crate::failure::Failure;
use crate::numbers::shortest;
use crate::recording::{self, Column, ColumnKind, Recording};
use crate::report::html::{self, Cell, text as safe};
use crate::report::{self, DRAWING, STYLE, Samples, encoded, script};
use crate::simulate::record;

const PAGE: &str = include_str!("page.html");
const RACE: &str = include_str!("race.js");

/// The number of equal time intervals that are recorded for a page; where motions are smooth the page keeps only some.
const INSTANTS: u32 = 1024;

/// The page as one HTML file.
///
/// # Errors
/// An error of the drawing library.
pub fn page(
    found: &FastestResult<'_>,
    compiled: &Compiled<'_>,
    machine: &InterpretedMachine,
) -> Result<String, Failure> {
    let (free, broken) = motion_without_control(found, machine);
    let fastest = found.at_equal_times(INSTANTS);
    let mut start = machine.start();
    start.q.values.clone_from(&found.moments[0].q);
    let scene = report::scene(compiled, machine, &start);
    let runner = |recording: &Recording| {
        let samples = Samples::new(recording);
        report::motion(recording, &samples, machine, &scene)
    };
    let data = json!({
        "fastest": runner(&fastest),
        "free": free.as_ref().map(runner),
        "picture": scene.picture,
        "panels": panels(&fastest, free.as_ref()),
    });
    let figures = figures::svg("", found).map_err(Failure::Run)?;
    let model = &compiled.model;
    let kinematics = script::kinematics(model, &scene.values);
    let warnings = found.warnings().into_iter().chain(broken);
    let alert = |warning: String| {
        let warning = safe(&warning);
        format!("<p class=\"alert\"><strong>Warning:</strong> {warning}</p>\n")
    };
    Ok(html::fill(PAGE, |part| match part {
        "name" => safe(&model.name),
        "docs" => format!("<p class=\"docs\">{}</p>\n", html::docs(&model.docs)),
        "alert" => warnings.clone().map(alert).collect(),
        "time" => shortest(rounded(found.motion.time())),
        "figures" => figures.clone(),
        "result" => result(found),
        "style" => STYLE.to_owned(),
        "data" => html::json(&data),
        "script" => [&kinematics, &DRAWING.concat(), RACE].join("\n"),
        _ => String::new(),
    }))
}

/// The motion from rest at the same position for the same time without control forces; and why it ended early, if it did.
fn motion_without_control(
    found: &FastestResult<'_>,
    machine: &InterpretedMachine,
) -> (Option<Recording>, Option<String>) {
    let mut start = machine.start();
    start.q.values.clone_from(&found.moments[0].q);
    start.v.values.fill(0.0);
    let until = found.motion.time();
    let run = Signals::default()
        .drive(Simulation::new(machine), machine)
        .until(until)
        .every(until / f64::from(INSTANTS))
        .forget_steps()
        .run_interpreted_as_far_as_possible(start);
    let broken =
        |error| format!("without control forces the motion cannot be followed to the end: {error}");
    match run {
        Ok((run, error)) => (Some(record(&run)), error.map(broken)),
        Err(error) => (None, Some(broken(error))),
    }
}

/// The plots over time: coordinates of both motions, then the quantities of the fastest motion alone.
fn panels(fastest: &Recording, free: Option<&Recording>) -> Vec<Value> {
    let curve = |column: &Column, name: String, times: &[f64]| {
        json!({
            "name": name,
            "times": encoded(times.iter().copied()),
            "values": encoded(column.values.iter().copied()),
        })
    };
    let drawn = recording::panels(fastest, &[ColumnKind::Coordinate, ColumnKind::Output]);
    let panel = |panel: &crate::recording::Panel<'_>| {
        let columns = panel.columns.iter();
        let mut curves: Vec<Value> = columns
            .map(|column| curve(column, column.name.clone(), &fastest.times))
            .collect();
        if let (ColumnKind::Coordinate, Some(free)) = (panel.kind, free) {
            let same = free
                .of_kind(ColumnKind::Coordinate)
                .filter(|c| c.unit == panel.unit);
            let beside = |column| {
                curve(
                    column,
                    format!("{}, without control forces", column.name),
                    &free.times,
                )
            };
            curves.extend(same.map(beside));
        }
        json!({ "label": panel.label(), "unit": panel.unit, "curves": curves })
    };
    drawn.iter().map(panel).collect()
}

/// Ends, constants and extremes as tables.
fn result(found: &FastestResult<'_>) -> String {
    let last = found.moments.len() - 1;
    let ends = found.names.iter().enumerate().map(|(i, name)| {
        vec![
            Cell::Raw(format!("<code>{}</code>", safe(name))),
            figure(found.moments[0].q[i]),
            figure(found.moments[last].q[i]),
            figure(found.moments[last].v[i]),
        ]
    });
    let ends: Vec<Vec<Cell>> = ends.collect();
    let head = ["coordinate", "from", "to", "rate at the end"];
    let numbers = found.numbers().into_iter();
    let numbers = numbers.map(|(name, value)| vec![Cell::Words(name), figure(value)]);
    let numbers: Vec<Vec<Cell>> = numbers.collect();
    [
        html::table("Ends", &head, &ends),
        html::table("Numbers", &["what", "value"], &numbers),
    ]
    .concat()
}

fn figure(x: f64) -> Cell {
    Cell::Figure(shortest(rounded(x)).replace('-', "−"))
}

/// A number with twelve digits, for display.
fn rounded(x: f64) -> f64 {
    format!("{:.11e}", x + 0.0).parse().unwrap_or(x)
}
