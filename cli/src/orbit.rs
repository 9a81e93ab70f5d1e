//! `lagrangian orbit`: periodic motions, their multipliers, and their continuation in a parameter.

mod along;

use std::fmt::Write as _;

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, Simulation, State, System};
use lagrangian_linear::DMatrix;
use lagrangian_linear::orbit::{self, Multiplier, NoOrbit, Orbit, Period, Sought, Stability};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::model::{Model, Variable, stage};
use lagrangian_spec::source::Sources;
use lagrangian_symbolic::Dag;
use lagrangian_units::{integral_name, rate_name, rate_unit, state_of};
use serde_json::{Value, json};

use crate::call;
use crate::evaluate::set_start;
use crate::failure::Failure;
use crate::linearize::arrays::{Array, Content};
use crate::linearize::{mat, npz};
use crate::modes::{self, number};
use crate::numbers::{self, after_number, by_name, shortest};
use crate::other_chart::{self, OtherChart};
use crate::output::{self, Destination, ORBIT, TABLE, keep_apart};
use crate::reading::{self, Reading, name_error, places};
use crate::recording::Run;
use crate::runs;
use crate::{inputs, plot, progress, simulate, table};
use along::along;

/// The number of recorded samples per period.
const SAMPLES: f64 = 400.0;

/// The fewest steps per period in the recorded run.
const STEPS: f64 = 50.0;

/// How many periods of a motion within the one that was found are recognized.
const MOST_PERIODS: u32 = 12;

/// The instants in half of a period at which it is measured how far each number moves.
const INSTANTS: u32 = 24;

/// How close a motion returns in a part of the period, relative to how far it moves: far above the error of a run, and far below the
/// distance of an orbit of twice the period, except next to where its period doubles.
const SAME: f64 = 1e-5;

/// A machine with its period.
struct Ready<'d> {
    compiled: Compiled<'d>,
    /// The source texts of the spec, for errors of runs.
    sources: Sources,
    machine: InterpretedMachine,
    /// The formula of the period, and the index of its output.
    period: Option<(String, usize)>,
    /// The start of the call.
    start: State<Named>,
}

/// Runs the command.
///
/// # Errors
/// If the spec or the call is invalid, or there is no orbit near the start.
pub fn run(call: &call::Orbit) -> Result<(), Failure> {
    let endings = if call.along.is_some() { TABLE } else { ORBIT };
    let out = (call.out.as_ref(), endings);
    let files = Destination::out_and_plot(out, call.plot.as_ref(), call.spec.json)?;
    let all: Vec<&Destination> = files.iter().flatten().collect();
    keep_apart(all.iter().copied(), &[(&call.spec.path, "the spec")])?;
    let dag = Dag::new();
    let (ready, cartesian) = prepare(call, &dag, &all)?;
    let placed = |failure: Failure| failure.placed(&ready.compiled.model, &ready.sources);
    progress::now("searching for the orbit");
    if let Some(vary) = &call.along {
        let sought = sought(call, &ready).map_err(placed)?;
        return along(call, &ready, &sought, vary, &files).map_err(placed);
    }
    let mut in_other = None;
    let found = other_chart::search(search(call, &ready), || {
        let given = (&call.start, &call.keep);
        let chart = OtherChart::of(&ready.compiled, cartesian, given, &ready.start)?;
        let other = Ready {
            compiled: chart.compiled,
            sources: ready.sources.clone(),
            machine: chart.machine,
            period: ready.period.clone(),
            start: chart.start,
        };
        let found = search(call, &other);
        in_other = Some(other);
        Some(found)
    });
    let (orbit, motion) = found.map_err(placed)?;
    show(
        call,
        in_other.as_ref().unwrap_or(&ready),
        &files,
        (&orbit, &motion),
    )
    .map_err(placed)
}

/// The orbit near the start of a call, and one period of its motion.
fn search(call: &call::Orbit, ready: &Ready<'_>) -> Result<(Orbit, Run), Failure> {
    let sought = sought(call, ready)?;
    let orbit = orbit::find(&ready.machine, &sought).map_err(|none| {
        no_orbit_failure(
            &none,
            call,
            &coordinates_that_must_return(&ready.machine, &sought),
        )
    })?;
    let motion = motion(&ready.machine, &orbit, call)?;
    Ok((orbit, motion))
}

/// Writes and prints an orbit.
fn show(
    call: &call::Orbit,
    ready: &Ready<'_>,
    files: &[Option<Destination>; 2],
    (orbit, motion): (&Orbit, &Run),
) -> Result<(), Failure> {
    runs::warn(motion);
    let periods = periods_within(&ready.machine, orbit, call)?;
    let mut document = as_json(&ready.machine, orbit);
    document["periods"] = json!(periods);
    if let Some(file) = &files[0] {
        match file.ending() {
            "npz" => file.write(|to| to.write_all(&npz::bytes(&arrays(&ready.machine, orbit))?))?,
            "mat" => file.write(|to| to.write_all(&mat::bytes(&arrays(&ready.machine, orbit))))?,
            "json" => file.write_text(&format!("{document:#}\n"))?,
            _ => table::write(&simulate::record(motion), file)?,
        }
    }
    if let Some(file) = &files[1] {
        let recording = simulate::record(motion);
        file.write_text(&plot::svg(ready.machine.name(), &recording).map_err(Failure::Run)?)?;
    }
    if call.spec.json {
        output::line(format_args!("{document:#}"))
    } else {
        output::text(&text(orbit, periods))
    }
    Ok(())
}

/// The reason why there is no orbit, with the options that may help.
fn no_orbit_failure(none: &NoOrbit, call: &call::Orbit, left_in: &[String]) -> Failure {
    let help = match none {
        NoOrbit::Driven(_) if call.near.is_some() => {
            "; --near is for machines that nothing drives, --period gives one"
        }
        NoOrbit::Driven(_) => "; --period gives it, as in --period 2*pi/omega",
        NoOrbit::NoReturn => " (--near)",
        NoOrbit::Constraints => " (--keep, --start)",
        NoOrbit::Lost(..) => " (--start, --rate, --settle)",
        NoOrbit::Rest => " (--start, --keep)",
        NoOrbit::OtherPlace(_) => {
            "; --advance must be whole turns of the angles on which the machine depends"
        }
        NoOrbit::Depends(_) => "; --advance gives it",
        _ => "",
    };
    let shift = match none {
        NoOrbit::Lost(..) | NoOrbit::NoReturn | NoOrbit::Refused(_) | NoOrbit::Rest
            if !left_in.is_empty() =>
        {
            format!(
                "; nothing depends on `{}`: with --shift {} it need not return",
                left_in.join("`, `"),
                left_in.join(",")
            )
        }
        _ => String::new(),
    };
    Failure::Run(format!("{none}{help}{shift}"))
}

/// The coordinates on which nothing depends but which must return nevertheless.
fn coordinates_that_must_return(machine: &InterpretedMachine, sought: &Sought) -> Vec<String> {
    let system = machine.prepare();
    let free = orbit::shifting(machine);
    let all = system.coordinates().zip(free.iter().zip(&sought.shifts));
    all.filter(|(of, (free, shifts))| **free && !**shifts && state_of(of.name).is_none())
        .map(|(of, _)| of.name.to_owned())
        .collect()
}

/// The machine of a call, with the derivatives that the variational equations need, and its model in the other chart if its spec names one.
fn prepare<'d>(
    call: &call::Orbit,
    dag: &'d Dag,
    files: &[&Destination],
) -> Result<(Ready<'d>, Option<Box<Model<'d>>>), Failure> {
    let mut reading = Reading::open(&call.spec)?.with_values(&call.start);
    if let Some(period) = &call.period {
        reading.add_formula("--period TIME", period, Some("s"));
    }
    let mut cartesian = None;
    let compiled = modes::compiled_with(
        reading,
        dag,
        files.iter().copied(),
        "periodic orbit",
        |model| {
            if let Some(period) = &call.period
                && let Some(output) = model.outputs.last()
                && output.value.stage() > stage::PARAMETER
            {
                return Err(Failure::Call(format!(
                    "--period {period}: a period can depend only on numbers and parameters"
                )));
            }
            cartesian = model.cartesian.take();
            let n = model.coordinates.len();
            for model in [Some(&mut *model), cartesian.as_deref_mut()]
                .into_iter()
                .flatten()
            {
                differentiate(&mut model.derivatives, Variable::of_state(n));
            }
            Ok(())
        },
    );
    let (compiled, sources) = compiled.map_err(inputs::as_call_failure)?;
    let mut machine = reading::machine(&compiled, &call.start)?;
    reading::set_first(&mut machine, &call.start, ("--along", call.along.as_ref()))?;
    reading::check_parameters(&machine)?;
    reading::check_kept(&machine.start(), &call.keep)?;
    let period = call
        .period
        .clone()
        .map(|formula| (formula, compiled.model.outputs.len() - 1));
    let mut start = machine.start();
    set_start(&mut start, &call.start)?;
    let ready = Ready {
        compiled,
        sources,
        machine,
        period,
        start,
    };
    Ok((ready, cartesian))
}

/// Adds variables of differentiation, in the order of declarations.
pub fn differentiate(
    derivatives: &mut Vec<Variable>,
    variables: impl IntoIterator<Item = Variable>,
) {
    derivatives.extend(variables);
    derivatives.sort_unstable();
    derivatives.dedup();
}

/// The search that the call describes.
fn sought(call: &call::Orbit, ready: &Ready<'_>) -> Result<Sought, Failure> {
    let machine = &ready.machine;
    let start = ready.start.clone();
    let period = match (&ready.period, call.near) {
        (Some((formula, output)), _) => Period::Given(runs::period_of(
            machine, &start, *output, "--period", formula,
        )?),
        (None, Some(near)) => Period::Near(near),
        (None, None) => Period::Sought,
    };
    let n = start.q.values.len();
    let mut advance = start.q.clone();
    advance.values.fill(0.0);
    for set in reading::families_first(&call.advance) {
        if !places(&start.q, &integral_name(&set.name)).is_empty() || state_of(&set.name).is_some()
        {
            return Err(Failure::Call(format!(
                "--advance {}: a state of first order returns to its value; only coordinates can advance",
                set.name
            )));
        }
        let unit = advance.unit(&set.name).unwrap_or("1").to_owned();
        reading::assign(&mut advance, set, "--advance", &unit)?;
    }
    let shifts = shifts(call, machine, &start.q)?;
    let mut kept = vec![false; 2 * n];
    for name in reading::kept_names(&call.keep).unwrap_or_default() {
        let rate = name
            .strip_prefix("der(")
            .and_then(|rate| rate.strip_suffix(')'));
        let shift = if rate.is_some() { n } else { 0 };
        for place in places(&start.q, rate.unwrap_or(name)) {
            kept[shift + place] = true;
        }
        for place in places(&start.q, &integral_name(name)) {
            kept[n + place] = true;
        }
    }
    let mut sought = Sought {
        period,
        kept,
        advance: advance.values,
        shifts,
        tolerance: call.tolerance,
        ..Sought::near(start, period)
    };
    if let Some(settle) = call.settle {
        let t = match period {
            Period::Given(period) => (settle / period).ceil() * period,
            _ => settle,
        };
        integrate_to_phase(machine, &mut sought, t)?;
    }
    Ok(sought)
}

/// Which coordinates may shift: those that `--shift` names or, if the call mentions no advance, all on which nothing depends.
fn shifts(
    call: &call::Orbit,
    machine: &InterpretedMachine,
    q: &Named,
) -> Result<Vec<bool>, Failure> {
    if call.shift.is_empty() && call.advance.is_empty() {
        let system = machine.prepare();
        let is_coordinate = system
            .coordinates()
            .map(|of| state_of(of.name).is_none())
            .collect::<Vec<_>>();
        let free = orbit::shifting(machine);
        return Ok(free
            .iter()
            .zip(is_coordinate)
            .map(|(free, is_coordinate)| *free && is_coordinate)
            .collect());
    }
    let mut shifts = vec![false; q.values.len()];
    for name in &call.shift {
        if let Err(unknown) = q.clone().set(name, 0.0) {
            return Err(name_error("coordinate", &unknown));
        }
        if call.advance.iter().any(|set| set.name == *name) {
            return Err(Failure::Call(format!(
                "--shift {name}: --advance already specifies how far it advances"
            )));
        }
        for place in places(q, name) {
            shifts[place] = true;
        }
    }
    Ok(shifts)
}

/// Integrates from the start for a time, and makes the end the new start, at the original time: the same
/// phase of the period.
fn integrate_to_phase(
    machine: &InterpretedMachine,
    sought: &mut Sought,
    time: f64,
) -> Result<(), Failure> {
    let start = sought.start.clone();
    let t = start.t;
    let run = Simulation::new(machine)
        .tolerance(sought.tolerance.max(1e-10))
        .until(t + time)
        .forget_steps()
        .run_interpreted(start)
        .map_err(Failure::run)?;
    sought.start = State {
        t,
        ..run.end().clone()
    };
    // Coordinates that have advanced are not shifted back: their positions are equivalent.
    Ok(())
}

/// One period of the motion.
fn motion(machine: &InterpretedMachine, orbit: &Orbit, call: &call::Orbit) -> Result<Run, Failure> {
    let start = orbit.start.clone();
    let signals = lagrangian::interpreted::Signals::new(machine, []).map_err(Failure::run)?;
    let run = signals
        .drive(Simulation::new(machine), machine)
        .tolerance(call.tolerance)
        .until(start.t + orbit.period)
        .every(orbit.period / SAMPLES)
        // If the orbit is a state at rest, steps would be arbitrarily long, and too coarse to integrate the work
        // of the excitation.
        .longest_step(orbit.period / STEPS)
        .energy_balance(true)
        .forget_steps()
        .run_interpreted(start);
    run.map_err(Failure::run)
}

/// How many times the motion returns in the period that was given or found: more than once if that is a multiple of its period.
fn periods_within(
    machine: &InterpretedMachine,
    orbit: &Orbit,
    call: &call::Orbit,
) -> Result<u32, Failure> {
    let start = &orbit.start;
    // After a part of a given advance, the machine need not be the same.
    let is_given = |(by, shifts): (&f64, &bool)| *by != 0.0 && !shifts;
    if orbit.advance.iter().zip(&orbit.shifts).any(is_given) {
        return Ok(1);
    }
    let run = Simulation::new(machine)
        .tolerance(call.tolerance)
        .until(start.t + 0.5 * orbit.period)
        .longest_step(orbit.period / STEPS)
        .run_interpreted(start.clone())
        .map_err(Failure::run)?;
    let states = (1..=INSTANTS).map(|k| f64::from(k) / f64::from(2 * INSTANTS) * orbit.period);
    let states = run
        .at_each(states.map(|t| start.t + t))
        .map_err(Failure::run)?;
    let numbers = |state: &State<Named>| [&state.q.values[..], &state.v.values[..]].concat();
    let from = numbers(start);
    let names: Vec<&str> = start.q.iter().map(|(name, _)| name).collect();
    let n = names.len();
    // How far each number moves.
    let mut ranges = vec![0.0_f64; 2 * n];
    for state in &states {
        for (range, (x, y)) in ranges.iter_mut().zip(numbers(state).iter().zip(&from)) {
            *range = range.max((x - y).abs());
        }
    }
    for count in (2..=MOST_PERIODS).rev() {
        let part = 1.0 / f64::from(count);
        let state = run
            .at(start.t + part * orbit.period)
            .map_err(Failure::run)?;
        let returns = numbers(&state).iter().enumerate().all(|(k, x)| {
            let advance = orbit.advance.get(k).map_or(0.0, |by| part * by);
            let error = 10.0 * call.tolerance * from[k].abs().max(1.0);
            // The integral of a state of first order need not return.
            let is_integral = k < n && state_of(names[k]).is_some();
            is_integral || (x - from[k] - advance).abs() <= SAME * ranges[k] + error
        });
        let moves = ranges.iter().any(|range| *range > 1e3 * call.tolerance);
        if returns && moves {
            return Ok(count);
        }
    }
    Ok(1)
}

/// The names of the coordinates and rates in the monodromy matrix.
fn states(machine: &InterpretedMachine, orbit: &Orbit) -> Vec<String> {
    let system = machine.prepare();
    let names: Vec<String> = system.coordinates().map(|q| q.name.to_owned()).collect();
    let rates = names.iter().map(|name| rate_name(name, ""));
    let all: Vec<String> = names.iter().cloned().chain(rates).collect();
    orbit.states.iter().map(|k| all[*k].clone()).collect()
}

fn arrays(machine: &InterpretedMachine, orbit: &Orbit) -> Vec<Array> {
    let vector = |name, values: Vec<f64>| Array {
        name,
        content: Content::Vector(values),
    };
    let of = |part: fn(&Multiplier) -> f64| orbit.multipliers.iter().map(part).collect();
    vec![
        vector("period", vec![orbit.period]),
        vector("t", vec![orbit.start.t]),
        vector("q", orbit.start.q.values.clone()),
        vector("v", orbit.start.v.values.clone()),
        vector("advance", orbit.advance.clone()),
        Array {
            name: "monodromy",
            content: Content::Matrix(orbit.monodromy.clone()),
        },
        vector("multipliers_re", of(|one| one.value.re)),
        vector("multipliers_im", of(|one| one.value.im)),
        vector("multipliers_error", of(|one| one.error)),
        Array {
            name: "states",
            content: Content::Text(states(machine, orbit)),
        },
    ]
}

fn rows(matrix: &DMatrix<f64>) -> Vec<Vec<f64>> {
    matrix
        .row_iter()
        .map(|row| row.iter().copied().collect())
        .collect()
}

fn multiplier_json(one: &Multiplier) -> Value {
    json!({
        "re": one.value.re,
        "im": one.value.im,
        "modulus": one.value.norm(),
        "error": one.error,
        "trivial": one.is_trivial,
    })
}

/// The advance of coordinates in a period, by name.
fn advance(orbit: &Orbit) -> Value {
    let all = orbit.start.q.iter().zip(&orbit.advance).zip(&orbit.shifts);
    let going = all.filter(|((_, by), shifts)| **by != 0.0 || **shifts);
    let named = going.map(|(((name, _), by), _)| (name.to_owned(), json!(by)));
    Value::Object(named.collect())
}

fn as_json(machine: &InterpretedMachine, orbit: &Orbit) -> Value {
    let multipliers: Vec<Value> = orbit.multipliers.iter().map(multiplier_json).collect();
    let mut at = json!({
        "t": orbit.start.t,
        "q": by_name(&orbit.start.q),
        "v": by_name(&orbit.start.v),
    });
    if let Some(states) = numbers::states(&orbit.start.v) {
        at["states"] = states;
    }
    json!({
        "period": orbit.period,
        "at": at,
        "advance": advance(orbit),
        "autonomous": orbit.is_autonomous,
        "states": states(machine, orbit),
        "monodromy": rows(&orbit.monodromy),
        "multipliers": multipliers,
        "stability": orbit.stability().name(),
        "family": orbit.family,
        "residual": orbit.residual,
        "rounds": orbit.rounds,
    })
}

fn verdict(orbit: &Orbit) -> &'static str {
    match orbit.stability() {
        Stability::Attracting => "stable: neighbouring motions converge to it",
        Stability::Unstable => "unstable: neighbouring motions diverge from it",
        Stability::Undecided => {
            "undecided: some neighbouring motions neither converge nor diverge, as far as the multipliers show"
        }
    }
}

fn text(orbit: &Orbit, periods: u32) -> String {
    let drive = if orbit.is_autonomous {
        "nothing drives the machine"
    } else {
        "the machine is driven"
    };
    let mut text = format!("period {} s; {drive}\n", number(orbit.period));
    if periods > 1 {
        let _ = writeln!(
            text,
            "the motion returns already after {} s: these are {periods} of its periods, and the multipliers are those of all of them",
            number(orbit.period / f64::from(periods))
        );
    }
    text.push_str("a start of the orbit:\n");
    let start = &orbit.start;
    let width = numbers::width_of_names(start.q.iter().map(|(name, _)| name));
    let unit_of = |name: &str| after_number(start.q.unit(name).unwrap_or("1"));
    // Writing to a String cannot fail.
    for ((name, q), v) in start.q.iter().zip(&start.v.values) {
        if let Some(state) = state_of(name) {
            let unit = after_number(&rate_unit(name, start.q.unit(name).unwrap_or("s")));
            let _ = writeln!(text, "  {state:width$} = {}{unit}", shortest(*v));
            continue;
        }
        let unit = unit_of(name);
        let _ = writeln!(
            text,
            "  {name:width$} = {}{unit}, der({name}) = {}{unit}/s",
            shortest(q),
            shortest(*v)
        );
    }
    for (k, (name, _)) in start.q.iter().enumerate().filter(|(k, _)| orbit.shifts[*k]) {
        let unit = unit_of(name);
        let _ = writeln!(
            text,
            "nothing depends on {name}, which advances by {}{unit} in a period",
            number(orbit.advance[k])
        );
    }
    let rounds = match orbit.rounds {
        1 => "1 iteration".to_owned(),
        rounds => format!("{rounds} iterations"),
    };
    let _ = writeln!(
        text,
        "it closes to within {:.1e}, after {rounds}",
        orbit.residual
    );
    match orbit.family {
        0 => {}
        1 => text.push_str(
            "it is one of a family, for example of different energies: the one nearest to the start; --keep, --start or --period select another\n",
        ),
        family => {
            let _ = writeln!(
                text,
                "it is one of a family with {family} parameters: the one nearest to the start; --keep, --start or --period select another"
            );
        }
    }
    text.push_str("Floquet multipliers:\n");
    for one in orbit.multipliers.iter().filter(|one| one.value.im >= 0.0) {
        let value = text_of_multiplier(one);
        let _ = writeln!(text, "  {value}, accurate to {:.1e}", one.error);
    }
    let _ = writeln!(text, "{}", verdict(orbit));
    text
}

/// A multiplier, of a pair both at once.
fn text_of_multiplier(one: &Multiplier) -> String {
    let (re, im) = (number(one.value.re), number(one.value.im));
    match (one.value.im != 0.0, one.is_trivial) {
        (_, true) => "1 along the motion".to_owned(),
        (true, _) => format!("{re} ± {im}i, modulus {}", number(one.value.norm())),
        (false, _) => re,
    }
}
