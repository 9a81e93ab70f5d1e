//! `lagrangian modes`: where a machine stays, and how it moves about that place.

mod constrained;
mod equilibrium;
mod precise;
mod rank;
mod spectrum;

use std::f64::consts::TAU;
use std::fmt::Write as _;

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named};
use lagrangian::{Machine, System};
use lagrangian_spec::compile::Compiled;
use lagrangian_spec::model::Variable;
use lagrangian_spec::program::Role;
use lagrangian_symbolic::Dag;
use nalgebra::Complex;
use serde_json::{Map, Value, json};

use crate::call;
use crate::evaluate::set_start;
use crate::failure::Failure;
use crate::output;
use crate::reading::{self, Reading};
use equilibrium::{Equilibrium, Lost, Statics};
use spectrum::{Mode, Modes};

/// Runs the command.
///
/// # Errors
/// If the spec or the call is at fault, or the machine has no equilibrium near its start.
pub fn run(call: &call::Modes) -> Result<(), Failure> {
    let dag = Dag::new();
    let machine = reading::machine(&compiled(&call.spec, &dag)?, &call.start)?;
    machine.check_parameters().map_err(|missing| {
        Failure::Run(format!(
            "{missing}; set them with --set {}=…",
            missing.names.join("=… --set ")
        ))
    })?;
    let mut start = machine.start();
    set_start(&mut start, &call.start)?;
    let steady = steady(call, &mut start.v)?;
    let q = start.q.values;
    let v: Vec<f64> = start
        .v
        .values
        .iter()
        .zip(&steady)
        .map(|(rate, is_steady)| if *is_steady { *rate } else { 0.0 })
        .collect();
    let system = machine.prepare();
    let u = system.default_inputs();
    refuse_drives(&machine, &system, &q, &v, &u)?;
    refuse_unsteady(&system, &q, &v, &u, &steady)?;
    let found = match system.constraints().len() {
        0 => {
            let found = Statics::new(&machine, &system, &v, &u).find(&q);
            found.map(|found| {
                let modes = spectrum::modes(&found.by_coordinates, &found.by_rates);
                (found, modes)
            })
        }
        _ if steady.contains(&true) => {
            let unknown = "steady rotation of a machine with constraints is not known yet";
            return Err(Failure::run(unknown));
        }
        _ => constrained::find(&machine, &system, &q, &u),
    };
    let (found, modes) = found.map_err(|lost| failure(&system, &lost))?;
    let modes = modes.ok_or_else(|| Failure::run("the eigenvalues cannot be found"))?;
    let names: Vec<&str> = system.coordinates().map(|q| q.name).collect();
    if call.spec.json {
        let result = as_json(&names, &found, &v, &modes);
        output::line(format_args!("{result:#}"));
    } else {
        let units: Vec<&str> = system.coordinates().map(|q| q.unit).collect();
        output::text(&text(&names, &units, &q, &v, &found, &modes));
    }
    Ok(())
}

/// The program with derivatives by all coordinates and rates, whatever the spec asks for.
fn compiled<'d>(spec: &call::Spec, dag: &'d Dag) -> Result<Compiled<'d>, Failure> {
    let mut reading = Reading::open(spec)?;
    let model = reading.model(dag);
    if model
        .as_ref()
        .is_some_and(|model| !model.sliding.is_empty())
    {
        return Err(Failure::run(
            "what sticks does not oscillate, and friction has no linearization: a machine with `sliding` has no modes",
        ));
    }
    let model = model.map(|mut model| {
        model.derivatives = Variable::of_state(model.coordinates.len());
        model
    });
    let compiled = model.and_then(|model| Compiled::new(model, &mut reading.report));
    match compiled {
        Some(compiled) => {
            reading.warn();
            Ok(compiled)
        }
        None => Err(reading.failure()),
    }
}

/// Which coordinates turn steadily, and with which rates.
fn steady(call: &call::Modes, rates: &mut Named) -> Result<Vec<bool>, Failure> {
    let mut steady = vec![false; rates.values.len()];
    for call::Steady { name, rate } in &call.steady {
        let mut probe = rates.clone();
        probe.values.fill(0.0);
        let unknown = |unknown| reading::name_error("coordinate", &unknown);
        probe.set(name, 1.0).map_err(unknown)?;
        if let Some(rate) = rate {
            rates.set(name, *rate).map_err(unknown)?;
        }
        for (is_steady, probed) in steady.iter_mut().zip(&probe.values) {
            *is_steady |= *probed != 0.0;
        }
    }
    Ok(steady)
}

/// The start, and two states beside it that have nothing in common.
fn states(q: &[f64], v: &[f64]) -> [(Vec<f64>, Vec<f64>); 3] {
    let beside = |list: &[f64], seed: usize| -> Vec<f64> {
        let shift = |k: usize| 0.01 + ((seed + 7 * k) * 29 % 97) as f64 / 997.0;
        list.iter()
            .enumerate()
            .map(|(k, x)| x + shift(k) * x.abs().max(1.0))
            .collect()
    };
    [
        (q.to_vec(), v.to_vec()),
        (beside(q, 1), beside(v, 2)),
        (beside(q, 3), beside(v, 4)),
    ]
}

/// Refuses a machine whose equations change with time: it is at rest nowhere.
fn refuse_drives(
    machine: &InterpretedMachine,
    system: &InterpretedSystem,
    q: &[f64],
    v: &[f64],
    u: &Named,
) -> Result<(), Failure> {
    let reads_time = |role| {
        let function = machine.program().function(role);
        function.is_some_and(|function| function.reads().time)
    };
    if !reads_time(Role::Accelerations) && !reads_time(Role::Derivatives) {
        return Ok(());
    }
    // A drive that parameters hold still, `cos(0*t)`, gives the same numbers at all times. What has none is no answer.
    let stands_still = |system: &InterpretedSystem| {
        states(q, v).iter().all(|(q, v)| {
            let at = |t| equilibrium::linearize(system, t, q, v, u).ok();
            let first = at(0.0);
            first.is_some() && [0.37, 1.13, 29.7].into_iter().all(|t| at(t) == first)
        })
    };
    if stands_still(system) {
        return Ok(());
    }
    let stops = |name: &&str| {
        let mut still = machine.clone();
        still.set(name, 0.0).is_ok() && stands_still(&still.prepare())
    };
    let names: Vec<String> = machine
        .parameters()
        .map(|(parameter, _)| parameter.name.to_owned())
        .collect();
    let names: Vec<&str> = names.iter().map(String::as_str).filter(stops).collect();
    let help = match names.is_empty() {
        true => "give the drive a parameter that stops it, or a coordinate of its own".to_owned(),
        false => format!(
            "it stands still with --set {}=0",
            names.join("=0, or --set ")
        ),
    };
    Err(Failure::Run(format!(
        "the machine is driven: its equations change with time, so that it is at rest nowhere; {help}"
    )))
}

/// Refuses steady coordinates on which the equations depend: what they turn past pulls now here, now there.
fn refuse_unsteady(
    system: &InterpretedSystem,
    q: &[f64],
    v: &[f64],
    u: &Named,
    steady: &[bool],
) -> Result<(), Failure> {
    for (q, v) in states(q, v) {
        let Ok([_, by_q, _]) = equilibrium::linearize(system, 0.0, &q, &v, u) else {
            continue;
        };
        for (k, coordinate) in system.coordinates().enumerate() {
            let mut column = by_q.iter().skip(k).step_by(q.len());
            if steady[k] && column.any(|x| *x != 0.0) {
                let name = coordinate.name;
                return Err(Failure::Run(format!(
                    "`{name}` cannot turn steadily: the equations of motion depend on where it is"
                )));
            }
        }
    }
    Ok(())
}

fn failure(system: &InterpretedSystem, lost: &Lost) -> Failure {
    let name = |index: usize| {
        let coordinate = system.coordinates().nth(index);
        coordinate.map_or_else(|| "?".to_owned(), |coordinate| coordinate.name.to_owned())
    };
    Failure::Run(match lost {
        Lost::Singular(singular) => format!(
            "the mass matrix is singular in `{}` on the way to an equilibrium; --start sets another place to look from",
            singular.name(system)
        ),
        Lost::NotFinite(index) => format!(
            "the acceleration of `{}`, or a derivative of it, is not finite on the way to an equilibrium; --start sets another \
             place to look from",
            name(*index)
        ),
        Lost::Accelerates(index, left) => format!(
            "there is no equilibrium near the start: nothing takes the acceleration {left:.3e} of `{}` away; --start sets \
             another place to look from",
            name(*index)
        ),
        Lost::Constraints(why) => {
            format!("{why}; --start sets another place to look from")
        }
        Lost::NoEnd(steps) => format!(
            "no equilibrium was found in {steps} steps from the start; --start sets another place to look from"
        ),
    })
}

/// What a mode is.
fn kind(mode: &Mode) -> &'static str {
    let Complex { re, im } = mode.lambda;
    match (re > 0.0, re < 0.0, im > 0.0) {
        (false, false, false) => "free",
        (true, _, true) => "growing oscillation",
        (true, _, false) => "growing",
        (_, true, false) => "decaying",
        _ => "oscillation",
    }
}

/// Of an oscillation `−Re λ/|λ|`; a motion without one has no ratio.
fn damping(mode: &Mode) -> Option<f64> {
    (mode.lambda.im > 0.0).then(|| 0.0 - mode.lambda.re / mode.lambda.norm())
}

fn as_json(names: &[&str], found: &Equilibrium, v: &[f64], modes: &Modes) -> Value {
    let by_name = |values: &[f64]| -> Map<String, Value> {
        let pairs = names.iter().zip(values);
        pairs
            .map(|(name, x)| ((*name).to_owned(), json!(x)))
            .collect()
    };
    let Modes {
        modes,
        lost,
        lost_below,
    } = modes;
    let modes: Vec<Value> = modes
        .iter()
        .map(|mode| {
            let shape = names.iter().zip(&mode.shape);
            let shape: Map<String, Value> = shape
                .map(|(name, x)| ((*name).to_owned(), json!([x.re, x.im])))
                .collect();
            json!({
                "kind": kind(mode),
                "re": mode.lambda.re,
                "im": mode.lambda.im,
                "error": mode.error,
                "frequency": mode.lambda.im / TAU,
                "damping": damping(mode),
                "shape": shape,
            })
        })
        .collect();
    json!({
        "equilibrium": {
            "q": by_name(&found.q),
            "v": by_name(v),
            "steps": found.steps,
            "free": found.free,
        },
        "modes": modes,
        "lost": {"modes": lost, "below": lost_below},
    })
}

fn text(
    names: &[&str],
    units: &[&str],
    start: &[f64],
    v: &[f64],
    found: &Equilibrium,
    modes: &Modes,
) -> String {
    let mut text = String::new();
    let width = names.iter().map(|name| name.chars().count()).max();
    let width = width.unwrap_or(0);
    let times = if found.steps == 1 { "step" } else { "steps" };
    // Writing to a String cannot fail.
    let _ = writeln!(text, "equilibrium, {} {times} from the start:", found.steps);
    for (k, name) in names.iter().enumerate() {
        // What is nothing but rounding, in rad or m, is not shown.
        let q = if found.q[k].abs() <= 1e-12 {
            0.0
        } else {
            found.q[k]
        };
        let (moved, unit) = (found.q[k] - start[k], units[k]);
        let moved = if moved.abs() <= 1e-12 { 0.0 } else { moved };
        let unit = if unit == "1" {
            String::new()
        } else {
            format!(" {unit}")
        };
        let _ = write!(text, "  {name:width$}  {}{unit}", number(q));
        if v[k] != 0.0 {
            let _ = write!(text, ", turning at {}{unit}/s", number(v[k]));
        }
        if moved != 0.0 {
            let _ = write!(text, ", moved by {}", number(moved));
        }
        text.push('\n');
    }
    if found.free > 0 {
        let ways = if found.free == 1 { "way" } else { "ways" };
        let _ = writeln!(
            text,
            "it may stand elsewhere as well, in {} {ways}",
            found.free
        );
    }
    for (index, mode) in modes.modes.iter().enumerate() {
        let Complex { re, im } = mode.lambda;
        let _ = write!(text, "\nmode {}: ", index + 1);
        let _ = match (kind(mode), damping(mode)) {
            ("free", _) => {
                let _ = write!(text, "free, nothing brings it back");
                match mode.error > 0.0 {
                    true => writeln!(text, " faster than {} rad/s", number(mode.error)),
                    false => writeln!(text),
                }
            }
            ("growing", _) => writeln!(text, "unstable, grows by e in {} s", number(1.0 / re)),
            ("decaying", _) => writeln!(text, "decays by e in {} s", number(-1.0 / re)),
            (_, Some(ratio)) => {
                let _ = write!(text, "{} Hz, {} rad/s, ", number(im / TAU), number(im));
                if re > 0.0 {
                    let _ = write!(text, "unstable, grows by e in {} s, ", number(1.0 / re));
                }
                writeln!(text, "damping ratio {}", number(ratio))
            }
            _ => writeln!(text),
        };
        // Of six digits that are printed, all are right.
        if mode.error > 0.5e-6 * mode.lambda.norm() && kind(mode) != "free" {
            let error = number(mode.error);
            let _ = writeln!(text, "  known no better than to {error} rad/s");
        }
        for (name, x) in names.iter().zip(&mode.shape) {
            // Beside an amplitude of 1, in rad or m, the rest is nothing to look at; with --json it is there.
            if x.norm() > 1e-12 {
                let _ = writeln!(text, "  {name:width$}  {}", amplitude(*x));
            }
        }
    }
    let Modes {
        lost, lost_below, ..
    } = modes;
    if *lost > 0 {
        let (motions, are) = if *lost == 1 {
            ("motion", "is")
        } else {
            ("motions", "are")
        };
        let below = number(*lost_below);
        let _ = writeln!(
            text,
            "\n{lost} more {motions} {are} slower than {below} rad/s, too slow beside the others to be told from rest"
        );
    }
    text
}

/// Six digits, or fewer where they say as much.
fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(x);
    match rounded.abs() {
        0.0 => "0".into(),
        1e-3..1e6 => format!("{rounded}"),
        _ => format!("{rounded:e}"),
    }
}

/// A real amplitude with its sign, any other with its phase in degrees.
fn amplitude(x: Complex<f64>) -> String {
    // Rounding leaves no phase.
    if x.im.abs() <= 1e-9 * x.norm() {
        return number(x.re);
    }
    let degrees = format!("{:.1}", x.arg().to_degrees());
    format!("{} at {degrees}°", number(x.norm()))
}
