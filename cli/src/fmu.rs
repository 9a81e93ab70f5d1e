//! `lagrangian fmu`: a machine as a functional mock-up unit, for tools that import FMI 3.0 or 2.0.
//!
//! The machine's own C file is that of `derive --as c` followed by functions with uniform names. The interface and the
//! integrator are generic texts (`fmu/c`). The C compiler compiles all of it as one translation unit, and the result is packed
//! with its description.

mod archive;
mod compile;
mod dependencies;
mod description;
mod run;
mod tables;
mod units;
mod variables;
mod xml;

use std::path::Path;

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Machine, Simulation, System, Warning};
use lagrangian_emit::names::word;
use lagrangian_languages::c::uniform::{self, Derivatives};
use lagrangian_mechanics::{Compiled, Unproved};
use lagrangian_program::Program;
use lagrangian_spec::model::stage;
use lagrangian_symbolic::Dag;
use serde_json::json;

use crate::call::{self, Assignment, Engine, Running, UnitKind, UnitMethod};
use crate::evaluate::set_start;
use crate::failure::{Failure, help_with};
use crate::output::{self, Destination, UNIT, keep_apart, keep_document_apart};
use crate::progress;
use crate::reading::{self, Reading};
use archive::Entry;
use variables::{Variables, is_word};

/// A version of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Version {
    Two,
    Three,
}

impl Version {
    fn name(self) -> &'static str {
        match self {
            Version::Two => "2.0",
            Version::Three => "3.0",
        }
    }

    /// The file that is compiled; it includes the others.
    fn source(self) -> &'static str {
        match self {
            Version::Two => "fmi2.c",
            Version::Three => "fmi3.c",
        }
    }

    /// The files that this version adds to the machine's own: the interface, and the headers of the standard.
    fn files(self) -> Vec<(&'static str, &'static str)> {
        let interface: [(&str, &str); 4] = match self {
            Version::Two => [
                ("fmi2.c", include_str!("fmu/c/fmi2.c")),
                (
                    "fmi2Functions.h",
                    include_str!("fmu/headers/fmi2Functions.h"),
                ),
                (
                    "fmi2FunctionTypes.h",
                    include_str!("fmu/headers/fmi2FunctionTypes.h"),
                ),
                (
                    "fmi2TypesPlatform.h",
                    include_str!("fmu/headers/fmi2TypesPlatform.h"),
                ),
            ],
            Version::Three => [
                ("fmi3.c", include_str!("fmu/c/fmi3.c")),
                (
                    "fmi3Functions.h",
                    include_str!("fmu/headers/fmi3Functions.h"),
                ),
                (
                    "fmi3FunctionTypes.h",
                    include_str!("fmu/headers/fmi3FunctionTypes.h"),
                ),
                (
                    "fmi3PlatformTypes.h",
                    include_str!("fmu/headers/fmi3PlatformTypes.h"),
                ),
            ],
        };
        let runtime = ("runtime.c", include_str!("fmu/c/runtime.c"));
        interface.into_iter().chain([runtime]).collect()
    }
}

impl UnitMethod {
    /// The stages and coefficients of the method, as a C file.
    fn tableau(self) -> &'static str {
        match self {
            UnitMethod::Dop853 => include_str!("fmu/c/dop853.c"),
            UnitMethod::Dopri5 => include_str!("fmu/c/dopri5.c"),
        }
    }
}

/// The data from which a unit is made.
struct Unit<'a> {
    version: Version,
    kinds: &'a [UnitKind],
    program: &'a Program,
    /// The machine with the parameters of the call.
    machine: &'a InterpretedMachine,
    /// The inputs with the values of the call.
    inputs: Vec<f64>,
    /// For each state, coordinates before rates, its start value, and whether the call gives it.
    start: Vec<(f64, bool)>,
    tolerance: f64,
    method: UnitMethod,
    /// The name of library and archive, as a C identifier.
    identifier: String,
    variables: Variables,
    /// Events that the call requests; their formulas are the last outputs of the program.
    events: &'a [Assignment],
    /// Whether directional derivatives are available, forward and adjoint.
    has_derivatives: bool,
    /// A token that differs between machines.
    token: String,
    /// The run in the unit, if the machine moves only by one.
    run: Option<UnitRun>,
}

/// The run of a unit.
struct UnitRun {
    /// The text of its crate.
    text: String,
    /// The names of its contacts.
    contacts: Vec<String>,
}

impl UnitRun {
    fn new(compiled: &Compiled<'_>, machine: &InterpretedMachine, method: UnitMethod) -> UnitRun {
        let contacts = run::contacts(&machine.prepare());
        UnitRun {
            text: run::text(compiled, method, contacts.len()),
            contacts,
        }
    }
}

/// The variables of a unit, with the outputs of the call.
fn variables(
    call: &call::Fmu,
    program: &Program,
    run: Option<&UnitRun>,
) -> Result<Variables, Failure> {
    let contacts = run.map_or(&[][..], |run| &run.contacts);
    let variables = Variables::new(program, &call.events, contacts);
    match &call.outputs {
        None => Ok(variables),
        Some(call::Names(names)) => variables.with_outputs(names, unknown_output),
    }
}

/// Refuses options that have no effect.
fn check_options(call: &call::Fmu) -> Result<(), Failure> {
    let kinds = call.kind.iter().flatten().map(|kind| kind.name());
    call::refuse_twice("--kind", kinds).map_err(Failure::Call)?;
    if let Some(call::Names(names)) = &call.outputs {
        let names = names.iter().map(String::as_str);
        call::refuse_twice("--outputs", names).map_err(Failure::Call)?;
    }
    let is_without = |kinds: &Vec<UnitKind>| !kinds.contains(&UnitKind::CoSimulation);
    if call.method.is_some() && call.kind.as_ref().is_some_and(is_without) {
        return Err(Failure::Call(
            "--method is that of co-simulation; in model exchange the importer integrates".into(),
        ));
    }
    Ok(())
}

/// Runs the command.
///
/// # Errors
/// If the spec is invalid or uses a feature that a unit does not support, a file cannot be written, or there
/// is no C compiler.
pub fn run(call: &call::Fmu) -> Result<(), Failure> {
    let out = Destination::new("--out", &call.out, UNIT)?;
    keep_document_apart([&out], call.spec.json)?;
    keep_apart([&out], &[(&call.spec.path, "the spec")])?;
    check_options(call)?;
    let version = match call.fmi {
        2 => Version::Two,
        _ => Version::Three,
    };
    let dag = Dag::new();
    let start_options = call::Start {
        parameters: call.parameters.clone(),
        coordinates: call.coordinates.clone(),
        rates: call.rates.clone(),
        running: Running {
            engine: Engine::Interpreter,
        },
    };
    let mut reading = Reading::open(&call.spec)?.with_values(&start_options);
    for event in &call.events {
        check_name(&event.name)?;
        reading.add_formula(&format!("--event {}", event.name), &event.value, None);
    }
    let compiled = reading.compile_beside(&dag, [&out])?;
    let has_run = run::is_needed(&compiled.program);
    let kinds = kinds(call, has_run)?;
    check_events(&compiled, &call.events)?;
    let machine = reading::machine(&compiled, &start_options)?;
    let start = start(&machine, &start_options)?;
    check_defaults(&compiled.program, &machine)?;
    if !has_run {
        check_constraints(&machine, &start_options, &call.spec.path)?;
    }
    let method = call.method.unwrap_or(UnitMethod::Dop853);
    let run = has_run.then(|| UnitRun::new(&compiled, &machine, method));
    let variables = variables(call, &compiled.program, run.as_ref())?;
    let derivatives = if has_run {
        None
    } else {
        derivatives(&compiled)?
    };
    let text = machine_text(&compiled, derivatives.as_ref(), call);
    let mut unit = Unit {
        version,
        kinds: &kinds,
        program: &compiled.program,
        machine: &machine,
        inputs: machine.prepare().default_inputs().values,
        start,
        tolerance: call.tolerance,
        method,
        identifier: identifier(&call.out),
        variables,
        events: &call.events,
        has_derivatives: derivatives.is_some(),
        token: String::new(),
        run,
    };
    let tables = tables::text(&unit);
    let of_run = unit.run.as_ref().map_or("", |run| &run.text);
    unit.token = tables::token(&[&text, &tables, unit.method.tableau(), of_run]);
    let sources = sources(&unit, &format!("{text}{tables}"));
    let libraries = if call.sources_only {
        Vec::new()
    } else {
        progress::now("compiling the unit");
        compile::libraries(&unit, &sources, call.cc.as_deref(), &call.target)?
    };
    let entries = entries(&unit, &sources, &libraries);
    let bytes = archive::bytes(&entries).map_err(Failure::run)?;
    out.write(|to| to.write_all(&bytes))?;
    let folders: Vec<&str> = libraries.iter().map(|(p, _)| p.folder).collect();
    print_summary(call, &unit, &folders);
    Ok(())
}

/// The files of a unit: its description, its sources, and its libraries.
fn entries(
    unit: &Unit<'_>,
    sources: &[(&'static str, String)],
    libraries: &[(compile::Platform, Vec<u8>)],
) -> Vec<Entry> {
    let mut entries = vec![Entry::text("modelDescription.xml", description::text(unit))];
    // An importer cannot compile a run.
    let sources = if unit.has_run() { &[] } else { sources };
    for (name, content) in sources {
        entries.push(Entry::text(&format!("sources/{name}"), content.clone()));
    }
    if unit.version == Version::Three && !unit.has_run() {
        entries.push(Entry::text(
            "sources/buildDescription.xml",
            description::of_build(unit),
        ));
    }
    for (platform, library) in libraries {
        let name = format!(
            "binaries/{}/{}.{}",
            platform.folder, unit.identifier, platform.ending
        );
        entries.push(Entry {
            name,
            content: library.clone(),
        });
    }
    entries
}

/// Prints a summary of a unit.
fn print_summary(call: &call::Fmu, unit: &Unit<'_>, platforms: &[&str]) {
    let Program {
        coordinates,
        parameters,
        inputs,
        ..
    } = unit.program;
    let outputs = unit.variables.outputs().count();
    if call.spec.json {
        output::line(format_args!(
            "{:#}",
            json!({
                "unit": call.out.to_string_lossy(),
                "fmi": unit.version.name(),
                "kinds": unit.kinds.iter().map(|kind| kind.name()).collect::<Vec<_>>(),
                "platforms": platforms,
                "token": unit.token,
                "states": 2 * coordinates.len(),
                "parameters": parameters.len(),
                "inputs": inputs.len(),
                "outputs": outputs,
                "events": call.events.len(),
            })
        ));
        return;
    }
    let kinds: Vec<&str> = unit.kinds.iter().map(|kind| kind.words()).collect();
    output::line(format_args!(
        "{}: FMI {}, {}, {}; {}, {}, {}, {}{}",
        call.out.display(),
        unit.version.name(),
        kinds.join(" and "),
        match platforms {
            [] => "sources only".to_owned(),
            platforms => platforms.join(" and "),
        },
        count(2 * coordinates.len(), "state"),
        count(parameters.len(), "parameter"),
        count(inputs.len(), "input"),
        count(outputs, "output"),
        match call.events.len() {
            0 => String::new(),
            events => format!(", {}", count(events, "event")),
        },
    ));
}

fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

/// The interfaces of a unit. Of a machine with contacts or guides, whose motion depends on more than its state, it has only co-simulation, in which it
/// makes a run.
fn kinds(call: &call::Fmu, has_run: bool) -> Result<Vec<UnitKind>, Failure> {
    let default = || [UnitKind::ModelExchange, UnitKind::CoSimulation].to_vec();
    if !has_run {
        return Ok(call.kind.clone().unwrap_or_else(default));
    }
    let why = "which contacts are closed and what sticks is a state of a run, which a unit of a machine with `contacts` or `sliding` makes itself";
    if call
        .kind
        .iter()
        .flatten()
        .any(|kind| *kind == UnitKind::ModelExchange)
    {
        return Err(Failure::run(format!(
            "--kind me: {why}; leave it out, or write --kind cs for co-simulation"
        )));
    }
    if call.sources_only {
        return Err(Failure::run(format!(
            "--sources-only: {why}, and the run is no C that an importer could compile; leave it out"
        )));
    }
    if let Some(target) = call.target.first() {
        return Err(Failure::run(format!(
            "--target {target}: {why}, and the run is compiled only for the platform of the command; leave it out, or call the command there"
        )));
    }
    if let Some(event) = call.events.first() {
        return Err(Failure::run(format!(
            "--event {}: {why}, and the run watches its contacts only; make the formula an output, whose sign the importer can watch at communication points",
            event.name
        )));
    }
    Ok(vec![UnitKind::CoSimulation])
}

/// Refuses a name that cannot be part of a variable name: the count of an event is `event.NAME`.
fn check_name(name: &str) -> Result<(), Failure> {
    if is_word(name) {
        Ok(())
    } else {
        Err(Failure::Call(format!(
            "--event {name}: the name of an event consists of the letters a to z, digits and `_`, since it is part of the name of a variable: \
             event.NAME"
        )))
    }
}

/// Refuses formulas that depend on accelerations, and constant formulas.
fn check_events(compiled: &Compiled<'_>, events: &[Assignment]) -> Result<(), Failure> {
    let outputs = &compiled.model.outputs;
    let formulas = &outputs[outputs.len() - events.len()..];
    for (event, formula) in events.iter().zip(formulas) {
        let why = match formula.value.stage() {
            stage::ACCELERATION => "depends on accelerations, which may jump",
            known if known <= stage::PARAMETER => "does not change while the machine moves",
            _ => continue,
        };
        let Assignment { name, value } = event;
        return Err(Failure::Call(format!("--event {name}: `{value}` {why}")));
    }
    Ok(())
}

/// Refuses parameters and inputs without values: every variable of a unit has a start value.
fn check_defaults(program: &Program, machine: &InterpretedMachine) -> Result<(), Failure> {
    let inputs = machine.prepare().default_inputs().values;
    let slots = program.parameters.iter().zip(machine.parameter_values());
    let slots = slots.chain(program.inputs.iter().zip(&inputs));
    let mut missing = slots.filter(|(_, value)| !value.is_finite());
    match missing.next() {
        None => Ok(()),
        Some((slot, _)) => Err(Failure::Call(format!(
            "`{0}` has no default value, and a unit needs one: give it by --set {0}=VALUE",
            slot.name
        ))),
    }
}

/// Refuses dependent constraints: their multipliers are not unique, and a unit solves for all of them.
fn check_constraints(
    machine: &InterpretedMachine,
    given: &call::Start,
    spec: &Path,
) -> Result<(), Failure> {
    if machine.prepare().constraints().len() == 0 {
        return Ok(());
    }
    let mut start = machine.start();
    set_start(&mut start, given)?;
    let simulation = Simulation::new(machine).until(start.t);
    // Other errors of the start are reported by the unit itself at initialization.
    let Ok(run) = simulation.run_interpreted(start) else {
        return Ok(());
    };
    let mut redundant = run.warnings().iter().filter_map(|warning| match warning {
        Warning::RedundantConstraint { constraint, .. } => Some((constraint, warning)),
        _ => None,
    });
    let Some((constraint, warning)) = redundant.next() else {
        return Ok(());
    };
    let file = spec.file_name().unwrap_or_default().to_string_lossy();
    Err(Failure::run(format!(
        "no unit can be built of this machine: {warning}; a unit solves for the multipliers of all constraints, so if \
         the others imply it everywhere, leave it out in a variant: `machine {}Unit extends \"{file}\" {{ remove constraints.{constraint}; }}`",
        machine.name()
    )))
}

/// The start values of the states, and which of them the call gives.
fn start(machine: &InterpretedMachine, given: &call::Start) -> Result<Vec<(f64, bool)>, Failure> {
    let usual = machine.start();
    let mut start = usual.clone();
    set_start(&mut start, given)?;
    // A given value may equal the default, so defaults are first replaced by a marker.
    let mut marked = usual;
    for numbers in [&mut marked.q, &mut marked.v] {
        numbers.values.fill(f64::NAN);
    }
    set_start(&mut marked, given)?;
    let values = start.q.values.iter().chain(&start.v.values);
    let marks = marked.q.values.iter().chain(&marked.v.values);
    let states = values.zip(marks);
    let states: Vec<(f64, bool)> = states.map(|(x, mark)| (*x, !mark.is_nan())).collect();
    if states.iter().all(|(x, _)| x.is_finite()) {
        Ok(states)
    } else {
        Err(Failure::Call(
            "the start is not finite for these parameters: give it by --start".into(),
        ))
    }
}

fn unknown_output(name: &str, known: &[&str]) -> Failure {
    let help = help_with(name, known.iter().copied());
    Failure::Call(format!(
        "--outputs {name}: no variable has this name; {help}"
    ))
}

/// The proved derivatives; `None` for a machine that is too large for them.
fn derivatives(compiled: &Compiled<'_>) -> Result<Option<Derivatives>, Failure> {
    let Compiled { program, model, .. } = compiled;
    if !uniform::may_have_derivatives(program) {
        return Ok(None);
    }
    progress::now("proving derivatives");
    let to_failure = |unproved: Unproved| {
        Failure::run(format!("no unit can be built of this machine: {unproved}"))
    };
    Ok(Some(Derivatives {
        tangent: program.tangent(model).map_err(to_failure)?,
        adjoint: program.adjoint(model).map_err(to_failure)?,
    }))
}

/// The machine's own C file.
fn machine_text(
    compiled: &Compiled<'_>,
    derivatives: Option<&Derivatives>,
    call: &call::Fmu,
) -> String {
    let file = call.spec.path.file_name().unwrap_or_default();
    let origin = format!(
        "@generated from {} by `lagrangian fmu`.",
        file.to_string_lossy()
    );
    uniform::file(
        &compiled.program,
        derivatives,
        &[origin],
        &compiled.formulas(),
    )
}

/// All C files, by name.
fn sources(unit: &Unit<'_>, machine: &str) -> Vec<(&'static str, String)> {
    let machine_file = format!(
        "{machine}\n/* Which machine this is. */\n#define TOKEN \"{}\"\n",
        unit.token
    );
    let method = ("method.c", unit.method.tableau());
    let files = unit.version.files().into_iter().chain([method]);
    let files = files.map(|(name, text)| (name, text.to_owned()));
    [("machine.c", machine_file)]
        .into_iter()
        .chain(files)
        .collect()
}

/// The name of a file as a C identifier.
fn identifier(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let letters = word(&stem, |c| c.is_ascii_alphanumeric());
    if letters.starts_with(|c: char| c.is_ascii_digit()) || letters.is_empty() {
        format!("_{letters}")
    } else {
        letters
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers of a C array, one row after the other as written.
    fn array(text: &str, name: &str) -> Vec<Vec<f64>> {
        let (_, rest) = text.split_once(&format!(" {name}[")).expect(name);
        let (_, rest) = rest.split_once("= {").expect(name);
        let (inside, _) = rest.split_once("};").expect(name);
        let rows = if inside.contains('{') {
            inside.split('{').skip(1).collect()
        } else {
            vec![inside]
        };
        let number = |word: &str| {
            let parts: Vec<f64> = word
                .split('/')
                .map(|part| part.trim().parse().expect(word))
                .collect();
            parts[0] / parts.get(1).unwrap_or(&1.0)
        };
        let row = |row: &str| {
            let words = row.trim_end_matches(['}', ',', ' ', '\n']).split(',');
            let words = words.map(str::trim).filter(|word| !word.is_empty());
            words
                .map(|word| number(word.trim_matches(['{', '}'])))
                .collect()
        };
        rows.into_iter().map(row).collect()
    }

    /// Butcher's conditions for tall and for bushy trees: Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*,
    /// section II.1. A wrong digit violates one of them.
    #[test]
    fn methods_have_their_orders() {
        for (method, order) in [(UnitMethod::Dop853, 8), (UnitMethod::Dopri5, 5)] {
            let text = method.tableau();
            let nodes = array(text, "NODES").remove(0);
            let rows = array(text, "COEFFICIENTS");
            assert_eq!(rows.len(), nodes.len() + 1);
            for (row, node) in rows.iter().zip(&nodes) {
                // Twelve roundings of numbers up to 44.
                assert!((row.iter().sum::<f64>() - node).abs() < 1e-13, "{node}");
            }
            let weights = &rows[nodes.len()];
            let along = |row: &[f64], values: &[f64]| -> f64 {
                row.iter().zip(values).map(|(a, x)| a * x).sum()
            };
            let powers = |power: i32| -> Vec<f64> { nodes.iter().map(|c| c.powi(power)).collect() };
            for power in 0..order {
                let sum = along(weights, &powers(power));
                assert!((sum * f64::from(power + 1) - 1.0).abs() < 1e-13, "{power}");
            }
            // 1/n! for the tallest tree with n nodes.
            let mut tall = vec![1.0; nodes.len()];
            let mut factorial = 1.0;
            for nodes_of_tree in 1..=order {
                factorial *= f64::from(nodes_of_tree);
                let sum = along(weights, &tall);
                assert!((sum * factorial - 1.0).abs() < 1e-11, "{nodes_of_tree}");
                tall = rows[..nodes.len()]
                    .iter()
                    .map(|row| along(row, &tall))
                    .collect();
            }
            // Error weights are the difference to another method of this kind: they vanish for everything that both integrate exactly.
            for name in ["ERROR_WEIGHTS", "COARSE_ERROR_WEIGHTS"] {
                let errors = array(text, name).remove(0);
                for power in 0..3 {
                    assert!(
                        along(&errors, &powers(power)).abs() < 1e-14,
                        "{name} {power}"
                    );
                }
            }
        }
    }

    /// The dense output has its order: the weights of slopes at a fraction x of the step satisfy the conditions of bushy and of
    /// tall trees with x instead of 1. *Solving Ordinary Differential Equations I*, section II.6.
    #[test]
    fn dense_output_has_its_order() {
        for (method, order, end) in [(UnitMethod::Dop853, 7, 12), (UnitMethod::Dopri5, 4, 6)] {
            let text = method.tableau();
            let mut nodes = array(text, "NODES").remove(0);
            let mut rows = array(text, "COEFFICIENTS");
            let slopes = array(text, "DENSE").iter().map(Vec::len).max();
            let slopes = slopes.expect("rows");
            if end == nodes.len() {
                nodes.push(1.0);
            }
            rows.truncate(nodes.len());
            nodes.extend(array(text, "FURTHER_NODES").remove(0));
            rows.extend(array(text, "FURTHER_COEFFICIENTS"));
            nodes.truncate(slopes);
            rows.truncate(slopes);
            for (row, node) in rows.iter().zip(&nodes) {
                assert!((row.iter().sum::<f64>() - node).abs() < 1e-13, "{node}");
            }
            let weight_at = |x: f64, slope: usize| {
                let unit = |k: usize| f64::from(u8::from(k == slope));
                let rise = array(text, "COEFFICIENTS")
                    .pop()
                    .and_then(|row| row.get(slope).copied())
                    .unwrap_or_default();
                let bend = unit(0) - rise;
                let mut all = vec![rise, bend, rise - unit(end) - bend];
                let dense = array(text, "DENSE");
                all.extend(
                    dense
                        .iter()
                        .map(|row| row.get(slope).copied().unwrap_or(0.0)),
                );
                let of = |power: usize| if power.is_multiple_of(2) { x } else { 1.0 - x };
                let all = all.iter().enumerate().rev();
                all.fold(0.0, |sum, (power, c)| of(power) * (c + sum))
            };
            for x in [0.2, 0.55, 0.9, 1.0] {
                let weights: Vec<f64> = (0..slopes).map(|k| weight_at(x, k)).collect();
                let along = |row: &[f64], values: &[f64]| -> f64 {
                    row.iter().zip(values).map(|(a, x)| a * x).sum()
                };
                let (mut tall, mut factorial) = (vec![1.0; slopes], 1.0);
                for power in 1..=order {
                    let values: Vec<f64> = nodes.iter().map(|c| c.powi(power - 1)).collect();
                    let known = x.powi(power) / f64::from(power);
                    // Sixteen roundings of numbers up to 530.
                    assert!(
                        (along(&weights, &values) - known).abs() < 2e-12,
                        "{x} {power}"
                    );
                    factorial *= f64::from(power);
                    let known = x.powi(power) / factorial;
                    assert!(
                        (along(&weights, &tall) - known).abs() < 2e-12,
                        "{x} {power}"
                    );
                    tall = rows.iter().map(|row| along(row, &tall)).collect();
                }
            }
        }
    }

    #[test]
    fn a_file_name_becomes_an_identifier() {
        for (path, name) in [
            ("DoublePendulum.fmu", "DoublePendulum"),
            ("a/b-c 2.fmu", "b_c_2"),
            ("2nd.fmu", "_2nd"),
            ("größe.fmu", "gr__e"),
        ] {
            assert_eq!(identifier(Path::new(path)), name);
        }
    }
}
