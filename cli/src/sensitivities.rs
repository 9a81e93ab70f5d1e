//! `lagrangian sensitivities`: the derivatives of a motion by parameters, inputs and starts.

mod asked;
mod chart;
mod continued;

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named};
use lagrangian::methods::{Method, TAYLOR};
use lagrangian::{Machine, Sensitive, Simulation, State, System, Varied};
use lagrangian_linear::starts::{self, Change};
use lagrangian_program::{Arguments, Interpreter, Role};
use lagrangian_scalar::Dual;
use lagrangian_spec::model::{Model, Variable};
use lagrangian_spec::unit::integral_name;
use lagrangian_sweep::verdict;
use lagrangian_symbolic::Dag;
use serde_json::{Value, json};

use crate::call;
use crate::drawing::{self, Curve, Pane};
use crate::evaluate::set_start;
use crate::failure::Failure;
use crate::modes::{self, number};
use crate::orbit::differentiate;
use crate::output::{self, Destination, TABLE, keep_apart};
use crate::reading::{self, Reading, places};
use crate::runs::{header, warn};
use crate::simulate::check_samples;
use crate::{methods, progress, table};
use asked::{By, Observed, Of, Variation, observed, per, variations};
use chart::Chart;

/// The default number of recorded samples of a run.
const SAMPLES: f64 = 1000.0;

/// A column of the results.
struct Column {
    name: String,
    unit: String,
    values: Vec<f64>,
}

/// Runs the command.
///
/// # Errors
/// If the spec or the call is invalid, or the run fails.
pub fn run(call: &call::Sensitivities) -> Result<(), Failure> {
    let out = (call.out.as_ref(), TABLE);
    let files = Destination::out_and_plot(out, call.plot.as_ref(), call.spec.json)?;
    let all: Vec<&Destination> = files.iter().flatten().collect();
    keep_apart(all.iter().copied(), &[(&call.spec.path, "the spec")])?;
    let dag = Dag::new();
    let reading = Reading::open(&call.spec)?.with_values(&call.start);
    let wanted = call::names_of_option("--by", &call.by)?;
    let mut cartesian = None;
    let (compiled, sources) = modes::compiled_with(reading, &dag, all, "sensitivities", |model| {
        cartesian = model.cartesian.take();
        ask_derivatives(model, &wanted);
        Ok(())
    })?;
    let machine = reading::machine(&compiled, &call.start)?;
    reading::check_parameters(&machine)?;
    let mut start = machine.start();
    set_start(&mut start, &call.start)?;
    reading::check_kept(&start, &call.keep)?;
    let variations = variations((&compiled.model, &machine), &start, &wanted)?;
    let observed = observed(&machine, &start, &call.of)?;
    let chart = match cartesian {
        Some(cartesian) => Chart::of(&compiled, *cartesian, (call, &start))?,
        None => None,
    };
    let machines = (&machine, chart.as_ref());
    let ran = run_with_derivatives(call, machines, &start, &variations, &observed);
    let (times, columns) = ran.map_err(|failure| failure.placed(&compiled.model, &sources))?;
    write(&files, &machine, (&times, &columns), observed.len())?;
    if call.spec.json {
        output::line(format_args!(
            "{:#}",
            as_json(&times, &columns, observed.len())
        ))
    } else {
        output::text(&text(&times, &columns))
    }
    Ok(())
}

/// Asks the model for the derivatives by its state, and by the parameters and inputs of these names.
fn ask_derivatives(model: &mut Model<'_>, wanted: &[String]) {
    let n = model.coordinates.len();
    differentiate(&mut model.derivatives, Variable::of_state(n));
    let is_asked = |name: &str| {
        let base = name.split('[').next().unwrap_or(name);
        wanted.iter().any(|wanted| wanted == name || wanted == base)
    };
    let parameters = model.parameters.iter().enumerate();
    let parameters = parameters.filter(|(_, slot)| is_asked(&slot.name.to_string()));
    let parameters: Vec<Variable> = parameters.map(|(k, _)| Variable::Parameter(k)).collect();
    let inputs = model.inputs.iter().enumerate();
    let inputs = inputs.filter(|(_, slot)| is_asked(&slot.name.to_string()));
    let inputs: Vec<Variable> = inputs.map(|(k, _)| Variable::Input(k)).collect();
    differentiate(&mut model.derivatives, parameters.into_iter().chain(inputs));
}

/// Writes table and drawing of the columns at these times, of which the first are `values` and the others their derivatives, which are drawn.
fn write(
    files: &[Option<Destination>; 2],
    machine: &InterpretedMachine,
    (times, columns): (&[f64], &[Column]),
    values: usize,
) -> Result<(), Failure> {
    if let Some(file) = &files[0] {
        let columns = columns.iter().map(|column| {
            (
                header(&column.name, Some(&column.unit)),
                column.values.as_slice(),
            )
        });
        let time = ("t [s]".to_owned(), times);
        table::write_columns(
            &std::iter::once(time).chain(columns).collect::<Vec<_>>(),
            file,
        )?;
    }
    if let Some(file) = &files[1] {
        let panes: Vec<Pane> = columns
            .iter()
            .skip(values)
            .map(|column| Pane {
                along: ["t [s]".to_owned(), header("derivative", Some(&column.unit))],
                curves: vec![Curve {
                    name: column.name.clone(),
                    points: times
                        .iter()
                        .copied()
                        .zip(column.values.iter().copied())
                        .collect(),
                }],
                are_points: false,
            })
            .collect();
        file.write_text(&drawing::svg(machine.name(), &panes).map_err(Failure::Run)?)?;
    }
    Ok(())
}

/// The run with its derivatives: instants, then values, then the derivative of each value by each variable.
fn run_with_derivatives(
    call: &call::Sensitivities,
    (machine, chart): (&InterpretedMachine, Option<&Chart>),
    start: &State<Named>,
    variations: &[Variation],
    observed: &[Observed],
) -> Result<(Vec<f64>, Vec<Column>), Failure> {
    let method = methods::named(&call.method)?;
    if std::ptr::eq(method, &TAYLOR) {
        return Err(Failure::Call(
            "--method taylor: derivatives of a motion have no Taylor series".into(),
        ));
    }
    let is_held = machine.prepare().constraints().len() > 0;
    let collides = machine.prepare().unilateral_contacts().len() > 0;
    // If contacts open and close, no variational equations hold for the whole run, and in another chart there are others.
    let is_continued = collides || chart.is_some();
    let varied: &[Variation] = if is_continued { &[] } else { variations };
    let sensitive = sensitive(machine, varied)?;
    let start = if is_held {
        let start = start_on_constraints(call, machine, start.clone())?;
        if let Some(constraint) = starts::dependent_constraint(machine, &start) {
            return Err(Failure::Run(format!(
                "the constraint `{constraint}` follows from others, so that accelerations have no derivatives: leave it out"
            )));
        }
        start
    } else {
        start.clone()
    };
    let mut from = sensitive.start_from(start.clone());
    if is_continued {
        vary_start(&mut from, &start, variations);
    }
    set_derivatives_of_start(call, machine, (&start, &mut from), variations)?;
    let interval = call.every.unwrap_or(call.until.abs() / SAMPLES);
    let of_each = observed.len() + 2 * start.q.values.len();
    let width = 1 + of_each * (1 + variations.len());
    check_samples("--every", interval, call.until, width)?;
    progress::run(call.until);
    if is_continued {
        let machines = (machine, chart);
        return continued::run(call, machines, method, &from, variations, observed);
    }
    let mut simulation = Simulation::new(&sensitive)
        .tolerance(call.tolerance)
        .method(method)
        .until(call.until)
        .max_steps(call.max_steps)
        .forget_steps();
    if call.until != 0.0 {
        simulation = simulation.every(interval);
    }
    let run = simulation
        .run_interpreted(from.clone())
        .map_err(|error| Failure::Run(verdict::message_of(&error)))?;
    warn(&run);
    if is_held {
        check_drift(machine, run.end(), variations)?;
    }
    check_differences(call, (machine, method), variations, &from, run.end())?;
    let states = match run.samples() {
        [] => std::slice::from_ref(run.start()),
        states => states,
    };
    let mut columns = columns(variations, observed);
    let system = machine.prepare();
    let mut interpreters: Vec<Interpreter<Dual<f64>>> = variations
        .iter()
        .map(|variation| interpreter(machine, variation))
        .collect();
    for state in states {
        let rows = row(&system, &mut interpreters, variations, observed, state);
        for (column, value) in columns.iter_mut().zip(rows) {
            column.values.push(value);
        }
    }
    Ok((states.iter().map(|state| state.t).collect(), columns))
}

/// The machine with the derivatives of its motion.
fn sensitive<'m>(
    machine: &'m InterpretedMachine,
    variations: &[Variation],
) -> Result<Sensitive<'m, InterpretedMachine>, Failure> {
    let system = machine.prepare();
    let coordinates: Vec<&str> = system.coordinates().map(|q| q.name).collect();
    let mut sensitive = Sensitive::new(machine);
    if system.constraints().len() > 0 {
        sensitive = sensitive.with_start_on_constraints();
    }
    for variation in variations {
        sensitive = match variation.by {
            By::Parameter(_) | By::Input(_) => sensitive.by(&variation.name),
            By::Start(k) => sensitive.by_start(coordinates[k]),
            By::StartRate(k) => sensitive.by_start_rate(coordinates[k]),
        }
        .map_err(Failure::run)?;
    }
    Ok(sensitive)
}

/// Gives a start its derivative in each direction: 1 for the number that the direction varies, otherwise 0.
fn vary_start(from: &mut State<Varied<Named>>, start: &State<Named>, variations: &[Variation]) {
    from.q.by = vec![start.q.clone(); variations.len()];
    from.v.by = vec![start.v.clone(); variations.len()];
    for (k, variation) in variations.iter().enumerate() {
        from.q.by[k].values.fill(0.0);
        from.v.by[k].values.fill(0.0);
        match variation.by {
            By::Start(i) => from.q.by[k].values[i] = 1.0,
            By::StartRate(i) => from.v.by[k].values[i] = 1.0,
            By::Parameter(_) | By::Input(_) => {}
        }
    }
}

/// Adds to the derivatives of a start how it changes with the parameters that the spec computes it from, and on constraints.
fn set_derivatives_of_start(
    call: &call::Sensitivities,
    machine: &InterpretedMachine,
    (start, from): (&State<Named>, &mut State<Varied<Named>>),
    variations: &[Variation],
) -> Result<(), Failure> {
    let is_held = machine.prepare().constraints().len() > 0;
    for (k, variation) in variations.iter().enumerate() {
        if is_held {
            [from.q.by[k].values, from.v.by[k].values] = change_of_start(call, machine, variation)?;
            continue;
        }
        // A start that the spec computes from a parameter changes with it, unless the call sets it.
        if let By::Parameter(index) = variation.by {
            let (q, v) = start_by(machine, index);
            let [q_set, v_set] = set_by_call(start, call);
            for (j, (q, v)) in q.into_iter().zip(v).enumerate() {
                if !q_set[j] {
                    from.q.by[k].values[j] = q;
                }
                if !v_set[j] {
                    from.v.by[k].values[j] = v;
                }
            }
        }
    }
    Ok(())
}

/// The distance of runs whose differences are compared with the derivatives, relative to the sizes of the variables.
const DISTANCE: f64 = 1e-4;

/// The tolerance of these runs, or that of the call if it is finer.
const FINE: f64 = 1e-12;

/// Checks that runs differ as the derivatives predict, along a generic direction. Variational equations do not hold where a force jumps, so this is
/// examined for machines with a sign in their equations.
fn check_differences(
    call: &call::Sensitivities,
    (machine, method): (&InterpretedMachine, &'static Method),
    variations: &[Variation],
    from: &State<Varied<Named>>,
    end: &State<Varied<Named>>,
) -> Result<(), Failure> {
    if !machine.program().may_jump() {
        return Ok(());
    }
    let shares = shares(machine, variations);
    let tolerance = call.tolerance.min(FINE);
    let changed_end = ChangedEnd {
        call,
        machine,
        method,
        tolerance,
        variations,
        shares: &shares,
        from,
    };
    let difference = |h: f64| -> Option<Vec<f64>> {
        let (after, before) = (changed_end.at(h)?, changed_end.at(-h)?);
        let pairs = after.iter().zip(&before);
        Some(
            pairs
                .map(|(after, before)| (after - before) / (2.0 * h))
                .collect(),
        )
    };
    // Where such a run fails there is nothing to compare with.
    let (Some(coarse), Some(fine)) = (difference(2.0 * DISTANCE), difference(DISTANCE)) else {
        return Ok(());
    };
    let values = end.q.value.values.iter().chain(&end.v.value.values);
    for (i, value) in values.enumerate() {
        let n = end.q.value.values.len();
        let parts = shares.iter().enumerate().map(|(k, share)| {
            share
                * match i.checked_sub(n) {
                    None => end.q.by[k].values[i],
                    Some(i) => end.v.by[k].values[i],
                }
        });
        let (sum, size) = parts.fold((0.0, 0.0), |(sum, size): (f64, f64), part| {
            (sum + part, size + part.abs())
        });
        // The error of the finer difference is a third of the difference between the two, and round-off and tolerance come on top; derivatives are
        // as accurate as the call asks.
        let known =
            4.0 * (coarse[i] - fine[i]).abs() + 1e3 * tolerance * (1.0 + value.abs()) / DISTANCE;
        let significant = (1e3 * call.tolerance).max(1e-3) * size.max(fine[i].abs());
        if (sum - fine[i]).abs() > known.max(significant) {
            return Err(Failure::Run(format!(
                "the variational equations do not describe how runs differ ({sum:.3e} in place of {:.3e}), as where a force jumps; make it smooth, or \
                 use differences of runs, by `lagrangian compare` with `--set-second`, or by `lagrangian sweep`",
                fine[i]
            )));
        }
    }
    Ok(())
}

/// The ends of runs whose variables are changed along a generic direction.
struct ChangedEnd<'a> {
    call: &'a call::Sensitivities,
    machine: &'a InterpretedMachine,
    method: &'static Method,
    tolerance: f64,
    variations: &'a [Variation],
    /// The direction.
    shares: &'a [f64],
    from: &'a State<Varied<Named>>,
}

impl ChangedEnd<'_> {
    /// Coordinates and rates at the end, at this distance along the direction; `None` if the run fails.
    fn at(&self, distance: f64) -> Option<Vec<f64>> {
        let (machine, from) = (self.machine, self.from);
        let mut changed = machine.clone();
        let mut start = State {
            t: from.t,
            q: from.q.value.clone(),
            v: from.v.value.clone(),
        };
        for (k, (variation, share)) in self.variations.iter().zip(self.shares).enumerate() {
            let change = distance * share;
            let value = match variation.by {
                By::Parameter(index) => Some(machine.parameter_values()[index]),
                By::Input(index) => Some(machine.prepare().default_inputs().values[index]),
                By::Start(_) | By::StartRate(_) => None,
            };
            if let Some(value) = value {
                changed.set(&variation.name, value + change).ok()?;
            }
            for (numbers, by) in [(&mut start.q, &from.q.by[k]), (&mut start.v, &from.v.by[k])] {
                for (number, by) in numbers.values.iter_mut().zip(&by.values) {
                    *number += change * by;
                }
            }
        }
        let run = Simulation::new(&changed)
            .tolerance(self.tolerance)
            .method(self.method)
            .until(self.call.until)
            .max_steps(self.call.max_steps)
            .forget_steps()
            .run_interpreted(start)
            .ok()?;
        let State { q, v, .. } = run.end();
        Some(q.values.iter().chain(&v.values).copied().collect())
    }
}

/// The share of each variable in a generic direction, in its unit.
fn shares(machine: &InterpretedMachine, variations: &[Variation]) -> Vec<f64> {
    let sizes = sizes(machine, variations);
    let sizes = sizes.iter().enumerate();
    sizes
        .map(|(k, size)| (((3 + 7 * k) * 29 % 97) as f64 / 97.0 - 0.4) * size)
        .collect()
}

/// The sizes of the variables of differentiation, in their units; 1 for those that are 0, and for starts.
fn sizes(machine: &InterpretedMachine, variations: &[Variation]) -> Vec<f64> {
    let inputs = machine.prepare().default_inputs().values;
    let size = |variation: &Variation| {
        let size = match variation.by {
            By::Parameter(index) => machine.parameter_values()[index].abs(),
            By::Input(index) => inputs[index].abs(),
            By::Start(_) | By::StartRate(_) => 1.0,
        };
        if size > 0.0 { size } else { 1.0 }
    };
    variations.iter().map(size).collect()
}

/// Which coordinates and which rates start at values of the call. A state of first order is the rate of its integral.
fn set_by_call(start: &State<Named>, call: &call::Sensitivities) -> [Vec<bool>; 2] {
    let mut set = [&start.q, &start.v].map(|numbers| vec![false; numbers.values.len()]);
    for assignment in &call.start.coordinates {
        for place in places(&start.q, &assignment.name) {
            set[0][place] = true;
        }
        for place in places(&start.v, &integral_name(&assignment.name)) {
            set[1][place] = true;
        }
    }
    for assignment in &call.start.rates {
        for place in places(&start.v, &assignment.name) {
            set[1][place] = true;
        }
    }
    set
}

/// Empty columns: for each value, then for its derivatives.
fn columns(variations: &[Variation], observed: &[Observed]) -> Vec<Column> {
    let of_values = observed.iter().map(|observed| Column {
        name: observed.name.clone(),
        unit: observed.unit.clone(),
        values: Vec::new(),
    });
    let derivatives = observed.iter().flat_map(|observed| {
        variations.iter().map(|variation| Column {
            name: format!("{} by {}", observed.name, variation.name),
            unit: per(&observed.unit, &variation.unit),
            values: Vec::new(),
        })
    });
    of_values.chain(derivatives).collect()
}

fn with_values(like: &Named, values: &[f64]) -> Named {
    let mut named = like.clone();
    named.values.copy_from_slice(values);
    named
}

/// The projected start of a run from a state.
fn start_on_constraints(
    call: &call::Sensitivities,
    machine: &InterpretedMachine,
    start: State<Named>,
) -> Result<State<Named>, Failure> {
    let simulation = Simulation::new(machine).until(start.t);
    let run = reading::keep(simulation, &call.keep).run_interpreted(start);
    Ok(run.map_err(Failure::run)?.start().clone())
}

/// The derivative of the projected start by a variable.
fn change_of_start(
    call: &call::Sensitivities,
    machine: &InterpretedMachine,
    variation: &Variation,
) -> Result<Change, Failure> {
    let from = |machine: &InterpretedMachine| {
        let mut from = machine.start();
        // The assignments of the call have been checked against the same names and units.
        let _ = set_start(&mut from, &call.start);
        from
    };
    let brought = |machine: &InterpretedMachine, from: State<Named>| {
        start_on_constraints(call, machine, from).map_err(|failure| match failure {
            Failure::Call(message) | Failure::Run(message) => message,
            _ => "there is no start".to_owned(),
        })
    };
    starts::change(machine, variation.by.cause(), from, brought)
        .map_err(|why| Failure::Run(format!("--by {}: {why}", variation.name)))
}

/// Checks that integration has not moved the motion or its derivatives off the constraints.
fn check_drift(
    machine: &InterpretedMachine,
    end: &State<Varied<Named>>,
    variations: &[Variation],
) -> Result<(), Failure> {
    let at = State {
        t: end.t,
        q: end.q.value.clone(),
        v: end.v.value.clone(),
    };
    let changes = variations.iter().enumerate().map(|(k, variation)| {
        let change = [end.q.by[k].values.clone(), end.v.by[k].values.clone()];
        (variation.by.cause(), change)
    });
    match starts::drifted(machine, &at, changes) {
        None => Ok(()),
        Some((k, off)) => Err(Failure::Run(format!(
            "integration errors have moved the motion and its derivative by {} off the constraints, by a relative amount of {off:.1e}: a \
             smaller --tolerance keeps them closer",
            variations[k].name
        ))),
    }
}

/// The derivative of the spec's start by a parameter.
fn start_by(machine: &InterpretedMachine, index: usize) -> (Vec<f64>, Vec<f64>) {
    let parameters = duals(machine.parameter_values(), Some(index));
    let n = machine.program().dimension();
    let (mut q, mut v) = (vec![Dual::constant(0.0); n], vec![Dual::constant(0.0); n]);
    Interpreter::new(machine.program(), &parameters).start(&mut q, &mut v);
    let slopes = |list: Vec<Dual<f64>>| list.iter().map(|x| x.derivative).collect();
    (slopes(q), slopes(v))
}

fn duals(values: &[f64], varied: Option<usize>) -> Vec<Dual<f64>> {
    let mut duals: Vec<Dual<f64>> = values.iter().copied().map(Dual::constant).collect();
    if let Some(varied) = varied.and_then(|varied| duals.get_mut(varied)) {
        varied.derivative = 1.0;
    }
    duals
}

/// The program over dual numbers, with derivatives by a variable.
fn interpreter(machine: &InterpretedMachine, variation: &Variation) -> Interpreter<Dual<f64>> {
    let varied = match variation.by {
        By::Parameter(index) => Some(index),
        _ => None,
    };
    Interpreter::new(
        machine.program(),
        &duals(machine.parameter_values(), varied),
    )
}

/// The values at a state, then the derivative of each value by each variable.
fn row(
    system: &InterpretedSystem,
    interpreters: &mut [Interpreter<Dual<f64>>],
    variations: &[Variation],
    observed: &[Observed],
    state: &State<Varied<Named>>,
) -> Vec<f64> {
    let (q, v) = (&state.q.value.values, &state.v.value.values);
    let inputs = system.default_inputs();
    let n = q.len();
    let mut a = vec![f64::NAN; n];
    if system
        .accelerations(state.t, q, v, &inputs, &mut a)
        .is_err()
    {
        a.fill(f64::NAN);
    }
    let mut values: Vec<f64> = observed
        .iter()
        .map(|observed| match observed.of {
            Of::Coordinate(k) => q[k],
            Of::Rate(k) => v[k],
            Of::Output(k) => system.output(k, state.t, q, v, &a, &inputs.values),
        })
        .collect();
    let needs_outputs = observed
        .iter()
        .any(|observed| matches!(observed.of, Of::Output(_)));
    let mut slopes: Vec<Vec<f64>> = Vec::with_capacity(variations.len());
    for (k, variation) in variations.iter().enumerate() {
        let along = |list: &[f64], by: &[f64]| -> Vec<Dual<f64>> {
            let pairs = list.iter().zip(by);
            pairs
                .map(|(value, derivative)| Dual {
                    value: *value,
                    derivative: *derivative,
                })
                .collect()
        };
        let (by_q, by_v) = (&state.q.by[k].values, &state.v.by[k].values);
        let (q, v) = (along(q, by_q), along(v, by_v));
        let varied = match variation.by {
            By::Input(index) => Some(index),
            _ => None,
        };
        let u = duals(&inputs.values, varied);
        let mut a = vec![Dual::constant(f64::NAN); n];
        let interpreter = &mut interpreters[k];
        let arguments = |a| Arguments {
            t: Dual::constant(state.t),
            q: &q,
            v: &v,
            u: &u,
            a,
        };
        if needs_outputs {
            let _ = interpreter.call(Role::Accelerations, arguments(&[]), &mut a);
        }
        let slope = |observed: &Observed| match observed.of {
            Of::Coordinate(j) => by_q[j],
            Of::Rate(j) => by_v[j],
            Of::Output(j) => {
                let mut result = [Dual::constant(f64::NAN)];
                match interpreter.call(Role::Output(j), arguments(&a), &mut result) {
                    Ok(()) => result[0].derivative,
                    Err(_) => f64::NAN,
                }
            }
        };
        slopes.push(observed.iter().map(slope).collect());
    }
    for k in 0..observed.len() {
        values.extend(slopes.iter().map(|by| by[k]));
    }
    values
}

fn text(times: &[f64], columns: &[Column]) -> String {
    let end = times.last().copied().unwrap_or(0.0);
    let mut text = format!("at t = {} s\n", number(end));
    let width = columns
        .iter()
        .map(|column| column.name.chars().count())
        .max()
        .unwrap_or(0);
    for column in columns {
        let value = column.values.last().copied().unwrap_or(f64::NAN);
        let unit = if column.unit == "1" {
            String::new()
        } else {
            format!(" {}", column.unit)
        };
        text.push_str(&format!(
            "  {:width$}  {}{unit}\n",
            column.name,
            number(value)
        ));
    }
    text
}

fn as_json(times: &[f64], columns: &[Column], of_values: usize) -> Value {
    let list = |columns: &[Column]| -> Vec<Value> {
        let columns = columns.iter();
        columns
            .map(
                |column| json!({"name": column.name, "unit": column.unit, "values": column.values}),
            )
            .collect()
    };
    json!({"t": times, "values": list(&columns[..of_values]), "derivatives": list(&columns[of_values..])})
}
