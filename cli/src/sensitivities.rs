//! `lagrangian sensitivities`: the derivatives of a motion by parameters, inputs and starts.

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named, Signals};
use lagrangian::methods::{Method, TAYLOR};
use lagrangian::{Machine, Sensitive, Simulation, State, System, Varied};
use lagrangian_linear::across::{self, NoDerivatives};
use lagrangian_linear::starts::{self, Cause, Change};
use lagrangian_linear::varied::Direction;
use lagrangian_program::{Arguments, Interpreter, Role};
use lagrangian_scalar::Dual;
use lagrangian_spec::diagnostic::most_similar;
use lagrangian_spec::model::{Model, Variable};
use lagrangian_spec::unit::{self, integral_name, state_of};
use lagrangian_sweep::verdict;
use lagrangian_symbolic::{Dag, Expr};
use serde_json::{Value, json};

use crate::call;
use crate::drawing::{self, Curve, Pane};
use crate::evaluate::set_start;
use crate::failure::Failure;
use crate::modes::{self, number};
use crate::orbit::differentiate;
use crate::output::{self, Destination, SVG, TABLE, keep_apart};
use crate::reading::{self, Reading, places};
use crate::runs::{header, warn};
use crate::simulate::check_samples;
use crate::{methods, progress, table};

/// The default number of recorded samples of a run.
const SAMPLES: f64 = 1000.0;

/// A variable of differentiation.
enum By {
    /// A parameter, by its index.
    Parameter(usize),
    /// An input.
    Input(usize),
    /// The start of a coordinate.
    Start(usize),
    /// The start of its rate.
    StartRate(usize),
}

impl By {
    /// The corresponding cause of a change of the start.
    fn cause(&self) -> Cause {
        match self {
            By::Parameter(index) => Cause::Parameter(*index),
            By::Input(_) => Cause::Input,
            By::Start(k) => Cause::Start(*k),
            By::StartRate(k) => Cause::Rate(*k),
        }
    }
}

/// A variable of differentiation, with its name and unit.
struct Variation {
    by: By,
    name: String,
    unit: String,
}

/// A differentiated quantity.
enum Of {
    Coordinate(usize),
    Rate(usize),
    Output(usize),
}

/// A differentiated quantity, with its name and unit.
struct Observed {
    of: Of,
    name: String,
    unit: String,
}

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
    let files = [
        Destination::of("--out", call.out.as_ref(), TABLE)?,
        Destination::of("--plot", call.plot.as_ref(), SVG)?,
    ];
    let all: Vec<&Destination> = files.iter().flatten().collect();
    output::keep_document_apart(all.iter().copied(), call.spec.json)?;
    keep_apart(all.iter().copied(), &[(&call.spec.path, "the spec")])?;
    let dag = Dag::new();
    let reading = Reading::open(&call.spec)?;
    let wanted = call::names_of(&call.by).map_err(Failure::Call)?;
    let compiled = modes::compiled_with(reading, &dag, all, "sensitivities", |model| {
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
        Ok(())
    })?;
    let machine = reading::machine(&compiled, &call.start)?;
    reading::check_parameters(&machine)?;
    let mut start = machine.start();
    set_start(&mut start, &call.start)?;
    reading::check_kept(&start, &call.keep)?;
    let variations = variations((&compiled.model, &machine), &start, &wanted)?;
    let observed = observed(&machine, &start, &call.of)?;
    let (times, columns) = run_with_derivatives(call, &machine, &start, &variations, &observed)?;
    if let Some(file) = &files[0] {
        let columns = columns.iter().map(|column| {
            (
                header(&column.name, Some(&column.unit)),
                column.values.as_slice(),
            )
        });
        let time = ("t [s]".to_owned(), times.as_slice());
        table::write_columns(
            &std::iter::once(time).chain(columns).collect::<Vec<_>>(),
            file,
        )?;
    }
    if let Some(file) = &files[1] {
        let panes: Vec<Pane> = columns
            .iter()
            .skip(observed.len())
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

/// The parameters on which one depends that the spec computes from others, if `name` is one.
fn followed(model: &Model<'_>, name: &str) -> Option<Vec<String>> {
    let mut derived = model.derived_parameters.iter();
    let derived = derived.find(|of| of.name.to_string() == name)?;
    let parameters = model.parameters.iter();
    let is_followed = |symbol: Expr<'_>| {
        let symbol = symbol.as_symbol();
        symbol.is_some_and(|symbol| derived.value.depends_on(symbol))
    };
    let followed = parameters.filter(|parameter| is_followed(parameter.symbol));
    Some(followed.map(|of| format!("`{}`", of.name)).collect())
}

/// The variables that `--by` names.
fn variations(
    (model, machine): (&Model<'_>, &InterpretedMachine),
    start: &State<Named>,
    wanted: &[String],
) -> Result<Vec<Variation>, Failure> {
    let program = machine.program();
    let slots = |slots: &[lagrangian_program::Slot]| -> Vec<(String, String)> {
        let slots = slots.iter();
        slots
            .map(|slot| (slot.name.to_string(), slot.label()))
            .collect()
    };
    let (parameters, inputs) = (slots(&program.parameters), slots(&program.inputs));
    let coordinates: Vec<(String, String)> = {
        let system = machine.prepare();
        let coordinates = system.coordinates();
        coordinates
            .map(|q| (q.name.to_owned(), q.unit.to_owned()))
            .collect()
    };
    let mut all = Vec::new();
    for name in wanted {
        let before = all.len();
        let inner = |function: &str| {
            let inner = name.strip_prefix(function)?.strip_prefix('(')?;
            Some(inner.strip_suffix(')')?.trim())
        };
        let member = format!("{name}[");
        let is_meant = |known: &str| known == name || known.starts_with(&member);
        let state = inner("start").map(integral_name);
        let of_state = state.map_or_else(Vec::new, |integral| places(&start.q, &integral));
        if !of_state.is_empty() {
            // A state is the rate of its integral.
            all.extend(of_state.into_iter().map(|k| Variation {
                by: By::StartRate(k),
                name: format!("start({})", shown_rate(&coordinates[k].0)),
                unit: unit::rate_unit(&coordinates[k].0, &coordinates[k].1),
            }));
        } else if let Some(coordinate) = inner("start").filter(|name| !is_integral(name)) {
            all.extend(places(&start.q, coordinate).into_iter().map(|k| Variation {
                by: By::Start(k),
                name: format!("start({})", coordinates[k].0),
                unit: coordinates[k].1.clone(),
            }));
        } else if let Some(coordinate) = inner("rate").filter(|name| !is_integral(name)) {
            all.extend(places(&start.q, coordinate).into_iter().map(|k| Variation {
                by: By::StartRate(k),
                name: format!("rate({})", coordinates[k].0),
                unit: rate_unit(&coordinates[k].1),
            }));
        } else {
            let of_list = |list: &[(String, String)], by: fn(usize) -> By| -> Vec<Variation> {
                let list = list
                    .iter()
                    .enumerate()
                    .filter(|(_, (of_list, _))| is_meant(of_list));
                list.map(|(k, (name, unit))| Variation {
                    by: by(k),
                    name: name.clone(),
                    unit: unit.clone(),
                })
                .collect()
            };
            all.extend(of_list(&parameters, By::Parameter));
            all.extend(of_list(&inputs, By::Input));
        }
        if all.len() == before
            && let Some(others) = followed(model, name)
        {
            return Err(Failure::Call(format!(
                "--by {name}: the spec computes it from {}: ask by these, or replace its formula by a value, --set {name}=…",
                others.join(", ")
            )));
        }
        if all.len() == before {
            let known: Vec<String> = parameters
                .iter()
                .chain(&inputs)
                .map(|(name, _)| name.clone())
                .chain(
                    coordinates
                        .iter()
                        .flat_map(|(name, _)| match state_of(name) {
                            Some(state) => vec![format!("start({state})")],
                            None => vec![format!("start({name})"), format!("rate({name})")],
                        }),
                )
                .collect();
            let help = match most_similar(name, known.iter().map(String::as_str)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("there are: {}", known.join(", ")),
            };
            return Err(Failure::Call(format!(
                "--by {name}: no parameter, input or start of that name; {help}"
            )));
        }
    }
    call::refuse_twice("--by", all.iter().map(|one| one.name.as_str())).map_err(Failure::Call)?;
    Ok(all)
}

/// The quantities that `--of` names.
fn observed(
    machine: &InterpretedMachine,
    start: &State<Named>,
    lists: &[String],
) -> Result<Vec<Observed>, Failure> {
    let system = machine.prepare();
    let coordinates: Vec<(String, String)> = system
        .coordinates()
        .map(|q| (q.name.to_owned(), q.unit.to_owned()))
        .collect();
    let outputs: Vec<(String, String)> = machine
        .program()
        .outputs
        .iter()
        .map(|slot| (slot.name.to_string(), slot.label()))
        .collect();
    let coordinate = |k: usize| Observed {
        of: Of::Coordinate(k),
        name: coordinates[k].0.clone(),
        unit: coordinates[k].1.clone(),
    };
    let rate = |k: usize| Observed {
        of: Of::Rate(k),
        name: shown_rate(&coordinates[k].0),
        unit: if is_integral(&coordinates[k].0) {
            unit::rate_unit(&coordinates[k].0, &coordinates[k].1)
        } else {
            rate_unit(&coordinates[k].1)
        },
    };
    // The state itself is shown, not its integral, on which nothing depends.
    let shown = |k: usize| {
        if is_integral(&coordinates[k].0) {
            rate(k)
        } else {
            coordinate(k)
        }
    };
    let output = |k: usize| Observed {
        of: Of::Output(k),
        name: outputs[k].0.clone(),
        unit: outputs[k].1.clone(),
    };
    let wanted = call::names_of(lists).map_err(Failure::Call)?;
    if wanted.is_empty() {
        return Ok(if outputs.is_empty() {
            (0..coordinates.len()).map(shown).collect()
        } else {
            (0..outputs.len()).map(output).collect()
        });
    }
    let mut all = Vec::new();
    for name in &wanted {
        let before = all.len();
        let member = format!("{name}[");
        let matching = (0..outputs.len()).filter(|k| {
            let output_name = &outputs[*k].0;
            output_name == name || output_name.starts_with(&member)
        });
        all.extend(matching.map(output));
        if all.len() == before {
            match name
                .strip_prefix("der(")
                .and_then(|inner| inner.strip_suffix(')'))
            {
                Some(inner) => all.extend(places(&start.q, inner.trim()).into_iter().map(rate)),
                None => {
                    let states = places(&start.q, &integral_name(name));
                    all.extend(states.into_iter().map(rate));
                    all.extend(places(&start.q, name).into_iter().map(coordinate));
                }
            }
        }
        if all.len() == before {
            let known: Vec<String> = outputs
                .iter()
                .map(|(name, _)| name.clone())
                .chain(
                    coordinates
                        .iter()
                        .flat_map(|(name, _)| match state_of(name) {
                            Some(state) => vec![state],
                            None => vec![name.clone(), format!("der({name})")],
                        }),
                )
                .collect();
            let help = match most_similar(name, known.iter().map(String::as_str)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("there are: {}", known.join(", ")),
            };
            return Err(Failure::Call(format!(
                "--of {name}: no coordinate, rate or output of that name; {help}"
            )));
        }
    }
    call::refuse_twice("--of", all.iter().map(|one| one.name.as_str())).map_err(Failure::Call)?;
    Ok(all)
}

/// Whether a coordinate is the integral of a state of first order.
fn is_integral(coordinate: &str) -> bool {
    state_of(coordinate).is_some()
}

/// The name of the rate of a coordinate: `der(x)`, or the name of a state.
fn shown_rate(coordinate: &str) -> String {
    state_of(coordinate).unwrap_or_else(|| format!("der({coordinate})"))
}

/// The unit of the rate of a quantity with this unit.
fn rate_unit(unit: &str) -> String {
    match unit {
        "1" => "1/s".to_owned(),
        unit => format!("{unit}/s"),
    }
}

/// The quotient of two units.
fn per(unit: &str, other: &str) -> String {
    let is_simple = |unit: &str| !unit.contains(['*', '/', ' ']);
    match (unit, other) {
        (unit, "1") => unit.to_owned(),
        (unit, other) if is_simple(other) => format!("{unit}/{other}"),
        (unit, other) => format!("{unit}/({other})"),
    }
}

/// The run with its derivatives: instants, then values, then the derivative of each value by each variable.
fn run_with_derivatives(
    call: &call::Sensitivities,
    machine: &InterpretedMachine,
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
    let coordinates: Vec<String> = machine
        .prepare()
        .coordinates()
        .map(|q| q.name.to_owned())
        .collect();
    let is_held = machine.prepare().constraints().len() > 0;
    let collides = machine.prepare().unilateral_contacts().len() > 0;
    // If contacts open and close, no variational equations hold for the whole run.
    let varied: &[Variation] = if collides { &[] } else { variations };
    let mut sensitive = Sensitive::new(machine);
    if is_held {
        sensitive = sensitive.with_start_on_constraints();
    }
    for variation in varied {
        sensitive = match variation.by {
            By::Parameter(_) | By::Input(_) => sensitive.by(&variation.name),
            By::Start(k) => sensitive.by_start(&coordinates[k]),
            By::StartRate(k) => sensitive.by_start_rate(&coordinates[k]),
        }
        .map_err(Failure::run)?;
    }
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
    if collides {
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
    for (k, variation) in variations.iter().enumerate() {
        if is_held {
            [from.q.by[k].values, from.v.by[k].values] = change_of_start(call, machine, variation)?;
            continue;
        }
        // A start that the spec computes from a parameter changes with it, unless the call sets it.
        if let By::Parameter(index) = variation.by {
            let (q, v) = start_by(machine, index);
            let [q_set, v_set] = set_by_call(&start, call);
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
    let interval = call.every.unwrap_or(call.until.abs() / SAMPLES);
    let of_each = observed.len() + 2 * start.q.values.len();
    let width = 1 + of_each * (1 + variations.len());
    check_samples("--every", interval, call.until, width)?;
    progress::run(call.until);
    if collides {
        return across_impacts(call, machine, method, &from, variations, observed);
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
    let end_at = |h: f64| -> Option<Vec<f64>> {
        let mut changed = machine.clone();
        let mut start = State {
            t: from.t,
            q: from.q.value.clone(),
            v: from.v.value.clone(),
        };
        for (k, (variation, share)) in variations.iter().zip(&shares).enumerate() {
            let change = h * share;
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
            .tolerance(tolerance)
            .method(method)
            .until(call.until)
            .max_steps(call.max_steps)
            .forget_steps()
            .run_interpreted(start)
            .ok()?;
        let State { q, v, .. } = run.end();
        Some(q.values.iter().chain(&v.values).copied().collect())
    };
    let difference = |h: f64| -> Option<Vec<f64>> {
        let (after, before) = (end_at(h)?, end_at(-h)?);
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

/// The run of a machine with unilateral contacts, with derivatives continued across each impact and each change of closed contacts.
fn across_impacts(
    call: &call::Sensitivities,
    machine: &InterpretedMachine,
    method: &'static Method,
    from: &State<Varied<Named>>,
    variations: &[Variation],
    observed: &[Observed],
) -> Result<(Vec<f64>, Vec<Column>), Failure> {
    // Derivatives by variables scaled to size 1, so that one tolerance suits all of them.
    let sizes = sizes(machine, variations);
    let direction = |(variation, size): (&Variation, &f64)| {
        let mut direction = Direction::of_start(machine);
        match variation.by {
            By::Parameter(index) => direction.parameters[index] = *size,
            By::Input(index) => direction.inputs[index] = *size,
            By::Start(_) | By::StartRate(_) => {}
        }
        direction
    };
    let all = |list: &Varied<Named>| -> Vec<f64> {
        let by = list.by.iter().zip(&sizes);
        let by = by.flat_map(|(by, size)| by.values.iter().map(move |by| by * size));
        list.value.values.iter().copied().chain(by).collect()
    };
    let start = State {
        t: from.t,
        q: all(&from.q),
        v: all(&from.v),
    };
    let signals = Signals::default();
    let wanted = across::Wanted {
        machine,
        signals: &signals,
        directions: variations.iter().zip(&sizes).map(direction).collect(),
        method,
        tolerance: call.tolerance,
        until: call.until,
        most_steps: call.max_steps,
    };
    let failed = |error: lagrangian::Error| Failure::Run(verdict::message_of(&error));
    let run = across::run(&wanted, &start).map_err(|why| match why {
        NoDerivatives::Run(error) => failed(error),
        // The run itself may continue where its derivatives do not.
        broken => Failure::Run(format!(
            "{broken}; use differences of runs instead, by `lagrangian compare` with `--set-second`, or by `lagrangian sweep`"
        )),
    })?;
    let n = machine.program().dimension();
    let split = |list: &[f64]| Varied {
        value: with_values(&from.q.value, &list[..n]),
        by: (list[n..].chunks(n).zip(&sizes))
            .map(|(by, size)| {
                let by: Vec<f64> = by.iter().map(|by| by / size).collect();
                with_values(&from.q.value, &by)
            })
            .collect(),
    };
    let end = run.end();
    let end = State {
        t: end.t,
        q: split(&end.q),
        v: split(&end.v),
    };
    if machine.prepare().constraints().len() > 0 {
        check_drift(machine, &end, variations)?;
    }
    check_differences(call, (machine, method), variations, from, &end)?;
    let interval = call.every.unwrap_or(call.until.abs() / SAMPLES);
    let count = if call.until == from.t {
        0
    } else {
        ((call.until - from.t) / interval * (1.0 - 1e-9)).floor() as usize
    };
    let mut times: Vec<f64> = (0..=count).map(|k| from.t + k as f64 * interval).collect();
    if call.until != from.t {
        times.push(call.until);
    }
    let system = machine.prepare();
    let mut columns = columns(variations, observed);
    for t in &times {
        let State { q, v, .. } = run.at(*t).map_err(failed)?;
        let there = run.observe(*t, (&q, &v)).map_err(failed)?;
        let u = &there.inputs.own.values;
        let without_derivatives = |list: &Vec<f64>| list[..n].to_vec();
        let value = |observed: &Observed| match observed.of {
            Of::Coordinate(i) => q[i],
            Of::Rate(i) => v[i],
            Of::Output(i) => system.output(
                i,
                *t,
                &without_derivatives(&q),
                &without_derivatives(&v),
                &without_derivatives(&there.a),
                u,
            ),
        };
        let by = |observed: &Observed| -> Vec<f64> {
            let part = |list: &[f64], i: usize| list[n..].chunks(n).map(|by| by[i]).collect();
            let scaled: Vec<f64> = match observed.of {
                Of::Coordinate(i) => part(&q, i),
                Of::Rate(i) => part(&v, i),
                Of::Output(i) => (there.system).output(i, *t, [&q, &v, &there.a], &there.inputs),
            };
            scaled
                .iter()
                .zip(&sizes)
                .map(|(by, size)| by / size)
                .collect()
        };
        let row = observed
            .iter()
            .map(value)
            .chain(observed.iter().flat_map(by));
        let row: Vec<f64> = row.collect();
        for (column, value) in columns.iter_mut().zip(row) {
            column.values.push(value);
        }
    }
    Ok((times, columns))
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
