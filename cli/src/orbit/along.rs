//! Periodic orbits along a parameter.

use std::fmt::Write as _;

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Machine, System};
use lagrangian_linear::orbit::{self, Multiplier, NoOrbit, Orbit, Sought, Trace};
use lagrangian_units::{rate_name, rate_unit, state_of};
use serde_json::{Value, json};

use super::{Ready, as_json, coordinates_that_must_return, no_orbit_failure};
use crate::call;
use crate::drawing::{self, Curve, Pane};
use crate::failure::Failure;
use crate::modes::number;
use crate::numbers::{after_number, shortest};
use crate::output::{self, Destination};
use crate::reading;
use crate::runs::{self, header};
use crate::table;

/// Continues the orbit, writes the files and prints the results.
pub(super) fn along(
    call: &call::Orbit,
    ready: &Ready<'_>,
    sought: &Sought,
    vary: &call::Vary,
    files: &[Option<Destination>; 2],
) -> Result<(), Failure> {
    let machine = &ready.machine;
    let unit = unit_of(machine, &vary.name)?;
    let mut set = call.start.parameters.iter();
    if set.any(|set| set.name == vary.name) {
        return Err(Failure::Call(format!(
            "--set {0}=… and --along {0} both give `{0}` a value: leave out the first",
            vary.name
        )));
    }
    let values = vary.values("--along", &unit).map_err(Failure::Call)?;
    let make = |value: f64| machine_at(call, ready, &vary.name, value);
    let trace = orbit::follow(make, sought, &values).map_err(|stop| match stop {
        Stop::Failed(failure) => failure,
        Stop::None(none) => no_orbit_failure(
            &none,
            call,
            &coordinates_that_must_return(&ready.machine, sought),
        ),
    })?;
    let label = header(&vary.name, Some(&unit));
    if let Some(file) = &files[0] {
        let columns = columns(machine, &trace, &label);
        let columns: Vec<(String, &[f64])> = columns
            .iter()
            .map(|(name, values)| (name.clone(), values.as_slice()))
            .collect();
        table::write_columns(&columns, file)?;
    }
    if let Some(file) = &files[1] {
        let drawn = drawing::svg(machine.name(), &panes(&trace, &label));
        file.write_text(&drawn.map_err(Failure::Run)?)?;
    }
    if call.spec.json {
        let document = document(machine, &trace, &vary.name, &unit);
        output::line(format_args!("{document:#}"));
    } else {
        output::text(&text_of_trace(&trace, &vary.name, &unit))
    }
    Ok(())
}

/// The unit of the parameter or input along which orbits are continued.
fn unit_of(machine: &InterpretedMachine, name: &str) -> Result<String, Failure> {
    if let Some(unit) = machine.unit(name) {
        return Ok(unit.to_owned());
    }
    let Err(unknown) = machine.clone().set(name, 1.0) else {
        return Err(Failure::Call(format!("--along {name}: it has no unit")));
    };
    Err(match reading::name_error("parameter or input", &unknown) {
        Failure::Call(message) => Failure::Call(format!("--along {name}: {message}")),
        other => other,
    })
}

/// The machine at a value of the parameter, and the period of its drive, if the call gives it.
fn machine_at(
    call: &call::Orbit,
    ready: &Ready<'_>,
    name: &str,
    value: f64,
) -> Result<(InterpretedMachine, Option<f64>), Stop> {
    let mut machine = ready.machine.clone();
    machine
        .set(name, value)
        .map_err(|wrong| Stop::Failed(Failure::run(wrong)))?;
    reading::set_members(&mut machine, &call.start, name);
    let diagnostics = ready
        .compiled
        .model
        .parameter_diagnostics(machine.parameter_values());
    crate::diagnostics::check(&diagnostics)
        .map_err(|message| Stop::Failed(Failure::Call(message)))?;
    let period = match &ready.period {
        None => None,
        Some((formula, output)) => {
            let start = machine.start();
            let period = runs::period_of(&machine, &start, *output, "--period", formula);
            Some(period.map_err(Stop::Failed)?)
        }
    };
    Ok((machine, period))
}

/// The orbits as JSON.
fn document(machine: &InterpretedMachine, trace: &Trace, name: &str, unit: &str) -> Value {
    let points = trace.points.iter().map(|point| match &point.orbit {
        Ok(orbit) => {
            let mut document = as_json(machine, orbit);
            document["value"] = json!(point.value);
            document
        }
        Err(none) => json!({"value": point.value, "error": none.to_string()}),
    });
    let changes = trace.changes.iter().map(|changed| {
        json!({
            "between": changed.between,
            "change": changed.change.name(),
            "multiplier": {"re": changed.multiplier.re, "im": changed.multiplier.im},
        })
    });
    json!({
        "along": {"name": name, "unit": unit},
        "points": points.collect::<Vec<Value>>(),
        "changes": changes.collect::<Vec<Value>>(),
    })
}

/// Why a continuation is stopped.
pub(super) enum Stop {
    Failed(Failure),
    None(NoOrbit),
}

impl From<NoOrbit> for Stop {
    fn from(none: NoOrbit) -> Stop {
        Stop::None(none)
    }
}

/// A row for each multiplier of each orbit.
fn columns(machine: &InterpretedMachine, trace: &Trace, label: &str) -> Vec<(String, Vec<f64>)> {
    let found: Vec<(f64, &Orbit, &Multiplier)> = trace
        .points
        .iter()
        .filter_map(|point| point.orbit.as_ref().ok().map(|orbit| (point.value, orbit)))
        .flat_map(|(value, orbit)| orbit.multipliers.iter().map(move |one| (value, orbit, one)))
        .collect();
    let column = |name: &str, of: &dyn Fn(&(f64, &Orbit, &Multiplier)) -> f64| {
        (name.to_owned(), found.iter().map(of).collect())
    };
    let mut columns = vec![
        column(label, &|row| row.0),
        column("period [s]", &|row| row.1.period),
        column("re", &|row| row.2.value.re),
        column("im", &|row| row.2.value.im),
        column("modulus", &|row| row.2.value.norm()),
        column("error", &|row| row.2.error),
        column("trivial", &|row| f64::from(u8::from(row.2.is_trivial))),
    ];
    let system = machine.prepare();
    for (k, coordinate) in system.coordinates().enumerate() {
        if state_of(coordinate.name).is_some() {
            continue;
        }
        let name = header(coordinate.name, Some(coordinate.unit));
        columns.push(column(&name, &|row| row.1.start.q.values[k]));
    }
    for (k, coordinate) in system.coordinates().enumerate() {
        let unit = rate_unit(coordinate.name, coordinate.unit);
        let name = header(&rate_name(coordinate.name, ""), Some(&unit));
        columns.push(column(&name, &|row| row.1.start.v.values[k]));
    }
    columns
}

/// The period and the moduli of the multipliers.
fn panes(trace: &Trace, label: &str) -> Vec<Pane> {
    let found: Vec<(f64, &Orbit)> = trace
        .points
        .iter()
        .filter_map(|point| point.orbit.as_ref().ok().map(|orbit| (point.value, orbit)))
        .collect();
    let most = found
        .iter()
        .map(|(_, orbit)| orbit.multipliers.len())
        .max()
        .unwrap_or(0);
    // Multipliers are sorted by modulus.
    let moduli = (0..most).map(|k| Curve {
        name: format!("multiplier {}", k + 1),
        points: found
            .iter()
            .filter_map(|(value, orbit)| {
                let mut moduli: Vec<f64> = orbit
                    .multipliers
                    .iter()
                    .map(|one| one.value.norm())
                    .collect();
                moduli.sort_by(|a, b| b.total_cmp(a));
                moduli.get(k).map(|modulus| (*value, *modulus))
            })
            .collect(),
    });
    let periods = found.iter().map(|(value, orbit)| (*value, orbit.period));
    let mut panes = vec![Pane {
        along: [label.to_owned(), "modulus".to_owned()],
        curves: moduli.collect(),
        are_points: false,
    }];
    // The period of a driven machine is given, and not plotted.
    if found.iter().any(|(_, orbit)| orbit.is_autonomous) {
        panes.push(Pane {
            along: [label.to_owned(), "period [s]".to_owned()],
            curves: vec![Curve {
                name: "period".to_owned(),
                points: periods.collect(),
            }],
            are_points: false,
        });
    }
    panes
}

fn text_of_trace(trace: &Trace, name: &str, unit: &str) -> String {
    let unit = after_number(unit);
    let orbits = trace
        .points
        .iter()
        .filter(|point| point.orbit.is_ok())
        .count();
    let mut text = format!(
        "{orbits} orbits at {} values of {name}\n",
        trace.points.len()
    );
    let mut before: Option<&'static str> = None;
    for point in &trace.points {
        let now = point
            .orbit
            .as_ref()
            .map_or("lost", |orbit| orbit.stability().name());
        if before.replace(now) != Some(now) {
            let why = point.orbit.as_ref().err().map(|none| format!(": {none}"));
            // Writing to a String cannot fail.
            let _ = writeln!(
                text,
                "  from {name} = {}{unit} on: {now}{}",
                number(point.value),
                why.unwrap_or_default()
            );
        }
    }
    for changed in &trace.changes {
        let [from, to] = changed.between;
        let (re, im) = (number(changed.multiplier.re), changed.multiplier.im);
        let value = if im == 0.0 {
            re
        } else {
            format!("{re} ± {}i", number(im.abs()))
        };
        let _ = writeln!(
            text,
            "  {} between {name} = {}{unit} and {}{unit}: a multiplier of {value}",
            changed.change.name(),
            shortest(from),
            shortest(to)
        );
    }
    text
}
