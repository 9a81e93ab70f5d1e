//! Reading of a spec: from its file to its machine.

use std::path::Path;

use lagrangian::interpreted::{Engine, InterpretedMachine, InterpretedSystem, Named, UnknownName};
use lagrangian::{InputLaw, Machine, Simulation, State};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::series::SeriesText;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::{Coordinate, Model, Name};
use lagrangian_spec::resolve::Formula;
use lagrangian_spec::source::{Files, ReadTexts, Recorder, SourceId, Sources};
use lagrangian_spec::unit::{Unit, integral_name, rate_unit};
use lagrangian_sweep::plan::Law;
use lagrangian_sweep::signals::InputArgument;
use lagrangian_symbolic::{Dag, Rational};

use crate::call::{self, Assignment};
use crate::diagnostics;
use crate::failure::{Failure, help_with};
use crate::host::Specs;
use crate::inputs;
use crate::output::{Destination, keep_apart};
use crate::placed::Placed;

/// A spec that was read, with its diagnostics.
pub struct Reading {
    name: String,
    text: String,
    constants: Vec<(String, Rational)>,
    /// The parameters to which the call gives values.
    given: Vec<String>,
    /// Formulas of the call besides those of the spec: the option, the text, and the required unit if any.
    formulas: Vec<(String, String, Option<String>)>,
    /// What was read for the model.
    files: ReadTexts,
    /// The source texts for messages.
    pub sources: Sources,
    /// The diagnostics.
    pub report: Report,
    /// Whether the warnings of this spec have been printed.
    is_warned: bool,
    /// The values that the call gives.
    values: Vec<Given>,
    /// A value that does not fit its declaration.
    misfit: Option<Box<Placed>>,
}

/// A value that a call gives to a name of the spec.
#[derive(Clone, Debug)]
struct Given {
    option: &'static str,
    set: Assignment,
}

/// A machine that was compiled for a run.
pub struct InCharts<'d> {
    /// The machine of the spec.
    pub compiled: Compiled<'d>,
    /// The same machine in the other charts, if the spec names any and the run is made in them.
    pub cartesian: Option<Compiled<'d>>,
    /// The texts from which the series of the machine that runs can be derived.
    pub series: SeriesText,
    /// The source texts, for what a run reports about them.
    pub sources: Sources,
}

/// Whether a run has to be made in the other charts that a spec names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChartUse {
    /// What they cannot express is an error.
    Required,
    /// What they cannot express is run in the coordinates of the spec.
    IfPossible,
}

impl Reading {
    /// Reads the file of a spec.
    ///
    /// # Errors
    /// If there is no such file, the call is invalid.
    pub fn open(spec: &call::Spec) -> Result<Reading, Failure> {
        let path = spec.path.to_string_lossy();
        if spec.path.to_str().is_none() {
            // Specs name each other in text.
            return Err(Failure::Call(format!(
                "cannot read {path}: the name of a spec must be UTF-8; rename the file, or link it under another name"
            )));
        }
        let read = Specs.read(&path, None);
        let (_, text) =
            read.map_err(|error| Failure::Call(format!("cannot read {path}: {error}")))?;
        Ok(Reading {
            name: path.into_owned(),
            text,
            constants: spec.constants.clone(),
            given: spec.given.clone(),
            formulas: Vec::new(),
            files: ReadTexts::default(),
            sources: Sources::new(),
            report: Report::new(),
            is_warned: false,
            values: Vec::new(),
            misfit: None,
        })
    }

    /// The same spec without formulas of the call, from the text that was read.
    pub fn without_formulas(&self) -> Reading {
        Reading {
            name: self.name.clone(),
            text: self.text.clone(),
            constants: self.constants.clone(),
            given: self.given.clone(),
            formulas: Vec::new(),
            files: ReadTexts::default(),
            sources: Sources::new(),
            report: Report::new(),
            is_warned: self.is_warned,
            values: self.values.clone(),
            misfit: None,
        }
    }

    /// This reading with the values that the call gives to parameters, inputs, coordinates and rates, so that one that does not fit its
    /// declaration is an error that shows it.
    pub fn with_values(mut self, start: &call::Start) -> Reading {
        let lists = [
            ("--set", &start.parameters),
            ("--start", &start.coordinates),
            ("--rate", &start.rates),
        ];
        for (option, list) in lists {
            let given = list.iter().cloned();
            self.values.extend(given.map(|set| Given { option, set }));
        }
        self
    }

    /// A variant of a spec that has an input for each of its coordinates, a generalized force on it.
    ///
    /// # Errors
    /// The errors of [`open`](Self::open).
    pub fn controlled(
        spec: &call::Spec,
        coordinates: &[Coordinate<'_>],
    ) -> Result<Reading, Failure> {
        let (mut inputs, mut forces) = (String::new(), String::new());
        for (index, coordinate) in coordinates.iter().enumerate() {
            // A name that does not occur in the spec.
            let name = format!("control_force_on_coordinate_{index}");
            let unit = Unit::JOULE.over(coordinate.unit);
            let on = &coordinate.name;
            inputs.push_str(&format!("{name}: {unit}, "));
            forces.push_str(&format!("{name} {{ on: {on}, value: {name} }}, "));
        }
        let file = spec.path.file_name().unwrap_or_default();
        let base = file.to_string_lossy();
        let base = base.replace('\\', "\\\\").replace('"', "\\\"");
        let variant = spec.path.with_file_name("controlled.machine");
        let mut reading = Reading::open(spec)?;
        reading.is_warned = true;
        reading.name = variant.to_string_lossy().into_owned();
        reading.text = format!(
            "machine Controlled extends \"{base}\" {{ inputs {{ {inputs} }} forces {{ {forces} }} }}"
        );
        Ok(reading)
    }

    /// The model of the spec, as far as it is valid; errors are in the report.
    pub fn model<'d>(&mut self, dag: &'d Dag) -> Option<Model<'d>> {
        let Reading {
            name,
            text,
            constants,
            given,
            formulas,
            files,
            sources,
            report,
            ..
        } = self;
        let requested = formulas.iter().map(|(option, text, unit)| Formula {
            name: option,
            source_name: option,
            text,
            unit: unit.as_deref(),
        });
        let requested: Vec<Formula<'_>> = requested.collect();
        let spec = lagrangian_spec::parse(sources, name, text, report);
        let spec = spec.with_given(given.iter().cloned());
        let mut specs = Specs;
        let mut recorder = Recorder::new(&mut specs);
        let model = Model::resolve_with(
            spec,
            dag,
            constants,
            &requested,
            &mut recorder,
            sources,
            report,
        );
        *files = recorder.read;
        let model = model?;
        self.misfit = self
            .values
            .iter()
            .find_map(|given| self.misfit_of(given, &model));
        self.misfit.is_none().then_some(model)
    }

    /// The error of a value that does not fit the declaration of its name; `None` also where the spec does not have the name.
    fn misfit_of(&self, Given { option, set }: &Given, model: &Model<'_>) -> Option<Box<Placed>> {
        let is_named = |name: &Name| {
            let name = name.to_string();
            let member = name.strip_prefix(&set.name);
            member.is_some_and(|index| index.is_empty() || index.starts_with('['))
        };
        let (unit, span) = if *option == "--set" {
            let parameters = model.parameters.iter();
            let parameters = parameters.map(|of| (&of.name, &of.unit_text, of.span));
            let inputs = model.inputs.iter();
            let mut all = parameters.chain(inputs.map(|of| (&of.name, &of.unit_text, of.span)));
            let (_, unit, span) = all.find(|(name, ..)| is_named(name))?;
            (unit.clone(), span)
        } else {
            // States of first order have units of their own, and are left to the check of all values.
            let mut coordinates = model.coordinates.iter().filter(|of| of.rate.is_none());
            let coordinate = coordinates.find(|of| is_named(&of.name))?;
            let unit = &coordinate.unit_text;
            let unit = match *option {
                "--start" => unit.clone(),
                _ => format!("({unit})/s"),
            };
            (unit, coordinate.span)
        };
        let message = set.value(option, &unit).err()?;
        let note = match *option {
            "--rate" => "the coordinate is declared here",
            _ => "declared here",
        };
        Some(Box::new(Placed {
            message,
            note: Some(note.to_owned()),
            span,
            sources: self.sources.clone(),
        }))
    }

    /// Adds the formulas that drive inputs, as outputs after those of the spec.
    ///
    /// # Errors
    /// If there is no such input, or a table or the spec is invalid.
    pub fn drive(
        &mut self,
        written: &[(String, InputArgument)],
    ) -> Result<Vec<(String, Law)>, Failure> {
        if written.is_empty() {
            return Ok(Vec::new());
        }
        let dag = Dag::new();
        let mut plain = self.without_formulas();
        let Some(model) = plain.model(&dag) else {
            return Err(plain.failure());
        };
        let laws = inputs::laws(written, &model)?;
        for (name, law) in &laws {
            let mut known = model.inputs.iter();
            let input = known.find(|input| input.name.to_string() == *name);
            if let (Some(formula), Some(input)) = (law.formula(), input) {
                let option = format!("--input {name}");
                self.formulas
                    .push((option, formula.to_owned(), Some(input.unit_text.clone())));
            }
        }
        Ok(laws)
    }

    /// Adds a formula of the call, as an output after all others. `said` is the option that contains it, followed by a space, so
    /// that the output is left out of tables.
    pub fn add_formula(&mut self, option: &str, formula: &str, unit: Option<&str>) {
        self.formulas.push((
            option.to_owned(),
            formula.to_owned(),
            unit.map(str::to_owned),
        ));
    }

    /// The number of formulas of the call, which are the last outputs.
    pub fn formulas(&self) -> usize {
        self.formulas.len()
    }

    /// Compiles the machine through all stages.
    ///
    /// # Errors
    /// If the spec is invalid.
    pub fn compile(self, dag: &Dag) -> Result<Compiled<'_>, Failure> {
        self.compile_beside(dag, [])
    }

    /// Compiles for a command that writes files, which must not be among those that are read.
    ///
    /// # Errors
    /// If the spec or the call is invalid.
    pub fn compile_beside<'d, 'a>(
        mut self,
        dag: &'d Dag,
        destinations: impl IntoIterator<Item = &'a Destination>,
    ) -> Result<Compiled<'d>, Failure> {
        let model = self.model(dag);
        self.keep_from(destinations)?;
        let compiled = model.and_then(|model| Compiled::new(model, &mut self.report));
        if compiled.is_some() {
            self.warn();
        }
        compiled.ok_or_else(|| self.failure())
    }

    /// Compiles for code that another program runs: the machine, and if the spec names other charts, the machine in these too, proved to be
    /// the same.
    ///
    /// # Errors
    /// As [`compile_beside`](Self::compile_beside).
    pub fn compile_to_emit<'d, 'a>(
        mut self,
        dag: &'d Dag,
        destinations: impl IntoIterator<Item = &'a Destination>,
    ) -> Result<(Compiled<'d>, Option<Compiled<'d>>), Failure> {
        let model = self.model(dag);
        self.keep_from(destinations)?;
        let compiled = model.and_then(|model| Compiled::in_charts(model, &mut self.report));
        if compiled.is_some() {
            self.warn();
        }
        compiled.ok_or_else(|| self.failure())
    }

    /// Compiles for a run: the machine, and if the spec names other charts, the machine in these too.
    ///
    /// # Errors
    /// As [`compile_beside`](Self::compile_beside), and where the other charts are [required](ChartUse::Required), if they cannot express
    /// a formula of the call.
    pub fn compile_in_charts<'d, 'a>(
        mut self,
        dag: &'d Dag,
        destinations: impl IntoIterator<Item = &'a Destination>,
        chart_use: ChartUse,
    ) -> Result<InCharts<'d>, Failure> {
        let model = self.model(dag);
        self.keep_from(destinations)?;
        let Some(mut model) = model else {
            return Err(self.failure());
        };
        let mut cartesian = model.cartesian.take();
        let refused = cartesian.take_if(|machine| !machine.uncharted.is_empty());
        if let (Some(machine), ChartUse::Required) = (refused, chart_use) {
            for diagnostic in machine.uncharted {
                self.report.push(diagnostic);
            }
            return Err(self.failure());
        }
        let Some(compiled) = Compiled::for_runs(model, &mut self.report) else {
            return Err(self.failure());
        };
        self.warn();
        let Some(cartesian) = cartesian else {
            let sources = self.sources.clone();
            let series = self.text_of_series(false);
            return Ok(InCharts {
                compiled,
                cartesian: None,
                series,
                sources,
            });
        };
        // Its warnings would be those of the spec, which are printed.
        let mut report = Report::new();
        let cartesian = Compiled::for_runs(*cartesian, &mut report);
        let is_same = |other: &Compiled<'_>| compiled.check_chart(other, &mut report).is_some();
        let cartesian = cartesian.filter(is_same);
        if cartesian.is_none() && chart_use == ChartUse::Required {
            self.report = report;
            return Err(self.failure());
        }
        let sources = self.sources.clone();
        let series = self.text_of_series(cartesian.is_some());
        Ok(InCharts {
            compiled,
            cartesian,
            series,
            sources,
        })
    }

    /// The texts from which the series of the machine is derived, after its model was made.
    fn text_of_series(self, in_charts: bool) -> SeriesText {
        SeriesText {
            name: self.name,
            text: self.text,
            constants: self.constants,
            given: self.given,
            files: self.files,
            in_charts,
        }
    }

    /// Prints the warnings of a valid spec.
    pub fn warn(&mut self) {
        if !std::mem::replace(&mut self.is_warned, true) {
            diagnostics::print(&self.report, &self.sources);
        }
    }

    /// Refuses to write a file from which the spec is made: its own, or one that it extends. It must be called after the
    /// model was made, which reads these files.
    ///
    /// # Errors
    /// If there is such a file, the call is invalid.
    pub fn keep_from<'a>(
        &self,
        destinations: impl IntoIterator<Item = &'a Destination>,
    ) -> Result<(), Failure> {
        let spec = (Path::new(&self.name), "the spec");
        let files = 0..self.sources.len();
        let files = files.filter_map(|index| u16::try_from(index).ok());
        let names = files.map(|index| self.sources.name(SourceId(index)));
        let is_file = |name: &&str| *name != "the unit" && !name.starts_with("--");
        let bases = names.filter(|name| **name != self.name).filter(is_file);
        let bases = bases.map(|name| (Path::new(name), read_as(Path::new(name))));
        let read: Vec<_> = std::iter::once(spec).chain(bases).collect();
        keep_apart(destinations, &read)
    }

    /// The diagnostics as a failure, or the value of the call that does not fit its declaration.
    pub fn failure(self) -> Failure {
        if let Some(misfit) = self.misfit {
            return Failure::PlacedCall(misfit);
        }
        Failure::Spec(Box::new((self.report, self.sources)))
    }
}

/// The machine with the parameters of a call.
///
/// # Errors
/// If the call names a parameter or a coordinate that the machine lacks, or gives a value that the spec refuses.
pub fn machine(
    compiled: &Compiled<'_>,
    start: &call::Start,
) -> Result<InterpretedMachine, Failure> {
    let mut machine = InterpretedMachine::new(compiled.program.clone());
    let engine = match start.running.engine {
        call::Engine::Auto => Engine::Auto,
        call::Engine::Interpreter => Engine::Interpreter,
        call::Engine::Jit => Engine::Jit,
    };
    machine.set_engine(engine).map_err(|none| {
        Failure::Call(format!(
            "--engine jit: {none}; without it the machine is interpreted, with bitwise the same results"
        ))
    })?;
    for set in families_first(&start.parameters) {
        let value = match machine.unit(&set.name) {
            Some(unit) => set.value("--set", unit).map_err(Failure::Call)?,
            None => 0.0, // the name does not exist; the error is reported here
        };
        if let Err(unknown) = machine.set(&set.name, value) {
            let is_coordinate = is_named(&machine.start().q, &set.name);
            let other = is_coordinate.then_some("it is a coordinate, which --start sets");
            return Err(unknown_name("parameter or input", &unknown, other));
        }
    }
    let is_state = |set: &&Assignment| state_named(&machine.start().v, &set.name).is_some();
    let coordinates = start.coordinates.iter().filter(|set| !is_state(set));
    for set in coordinates.chain(&start.rates) {
        let mut coordinates = machine.start().q;
        let Err(unknown) = coordinates.set(&set.name, 0.0) else {
            continue;
        };
        let rate = set.name.strip_prefix("der(");
        let rate = rate.and_then(|name| name.strip_suffix(')'));
        let is_parameter = machine.unit(&set.name).is_some();
        let other = if rate.is_some_and(|name| is_named(&coordinates, name)) {
            Some("--rate sets the rate of a coordinate, under the coordinate's name")
        } else {
            is_parameter.then_some("it is a parameter or an input, which --set sets")
        };
        return Err(unknown_name("coordinate", &unknown, other));
    }
    if !start.parameters.is_empty() {
        let diagnostics = compiled
            .model
            .parameter_diagnostics(machine.parameter_values());
        diagnostics::check(&diagnostics).map_err(Failure::Call)?;
    }
    Ok(machine)
}

/// Gives a parameter that an option varies its first value, unless the call sets it: it may have no other.
///
/// # Errors
/// If the value is not one in the unit of the parameter.
pub fn set_first(
    machine: &mut InterpretedMachine,
    start: &call::Start,
    (option, vary): (&str, Option<&call::Vary>),
) -> Result<(), Failure> {
    if let Some(vary) = vary
        && let Some(unit) = machine.unit(&vary.name).map(str::to_owned)
        && start.parameters.iter().all(|set| set.name != vary.name)
    {
        let first = vary.ends[0].value(option, &unit).map_err(Failure::Call)?;
        // A name that is neither a parameter nor an input is refused later.
        let _ = machine.set(&vary.name, first);
        set_members(machine, start, &vary.name);
    }
    Ok(())
}

/// Sets the members of a family that the call sets to values of their own, after an option has given a value to the whole family.
pub fn set_members(machine: &mut InterpretedMachine, start: &call::Start, family: &str) {
    let member = format!("{family}[");
    let members = start.parameters.iter();
    for set in members.filter(|set| set.name.starts_with(&member)) {
        // Names and values were checked when the machine was made.
        let unit = machine.unit(&set.name).map(str::to_owned);
        if let Ok(value) = set.value("--set", &unit.unwrap_or_default()) {
            let _ = machine.set(&set.name, value);
        }
    }
}

/// Applies `--start` and `--rate`.
///
/// # Errors
/// If a coordinate does not exist.
pub fn set_start(start: &mut State<Named>, call: &call::Start) -> Result<(), Failure> {
    for set in families_first(&call.coordinates) {
        if let Some((integral, unit)) = state_named(&start.v, &set.name) {
            let set = Assignment {
                name: integral,
                value: set.value.clone(),
            };
            assign(&mut start.v, &set, "--start", &unit)?;
            continue;
        }
        let unit = start.q.unit(&set.name).map(str::to_owned);
        assign(&mut start.q, set, "--start", &unit.unwrap_or_default())?;
    }
    for set in families_first(&call.rates) {
        let unit = start.v.unit(&set.name).map(|unit| format!("({unit})/s"));
        assign(&mut start.v, set, "--rate", &unit.unwrap_or_default())?;
    }
    Ok(())
}

/// The name of the rate that is a state of first order, or a family of such, and its unit.
pub fn state_named(rates: &Named, name: &str) -> Option<(String, String)> {
    let integral = integral_name(name);
    let unit = rate_unit(&integral, rates.unit(&integral)?);
    Some((integral, unit))
}

/// Sets a coordinate or a rate to a value of the call, in a unit.
///
/// # Errors
/// If there is no such coordinate, or the value does not have that unit.
pub fn assign(
    numbers: &mut Named,
    set: &Assignment,
    option: &str,
    unit: &str,
) -> Result<(), Failure> {
    let unknown = |unknown: UnknownName| name_error("coordinate", &unknown);
    numbers.clone().set(&set.name, 0.0).map_err(unknown)?;
    let value = set.value(option, unit).map_err(Failure::Call)?;
    numbers.set(&set.name, value).map_err(unknown)
}

/// The indices of the numbers that a name stands for: one, or a family.
pub fn places(numbers: &Named, name: &str) -> Vec<usize> {
    let mut probe = numbers.clone();
    probe.values.fill(0.0);
    match probe.set(name, 1.0) {
        Ok(()) => (0..probe.values.len())
            .filter(|k| probe.values[*k] != 0.0)
            .collect(),
        Err(_) => Vec::new(),
    }
}

/// Checks that everything that `--keep` names exists.
///
/// # Errors
/// If a name does not exist, the call is invalid.
pub fn check_kept(start: &State<Named>, keep: &call::Keep) -> Result<(), Failure> {
    check_kept_once(keep)?;
    for name in kept_names(keep).unwrap_or_default() {
        let rate = name.strip_prefix("der(");
        let rate = rate.and_then(|rate| rate.strip_suffix(')'));
        if rate.is_none() && state_named(&start.v, name).is_some() {
            continue;
        }
        let mut numbers = start.q.clone();
        if let Err(unknown) = numbers.set(rate.unwrap_or(name), 0.0) {
            let Failure::Call(message) = name_error("coordinate", &unknown) else {
                continue;
            };
            return Err(Failure::Call(format!("--keep {name}: {message}")));
        }
    }
    Ok(())
}

/// Checks that `--keep` names everything only once.
///
/// # Errors
/// If a name is repeated, the call is invalid.
pub fn check_kept_once(keep: &call::Keep) -> Result<(), Failure> {
    let names = &keep.names;
    let mut repeated = names.iter().enumerate();
    match repeated.find(|(k, name)| names[..*k].contains(name)) {
        None => Ok(()),
        Some((_, name)) => Err(Failure::Call(format!(
            "--keep names `{name}` more than once"
        ))),
    }
}

/// Checks that every parameter has a value.
///
/// # Errors
/// If parameters have none: which, and how to set them.
pub fn check_parameters(machine: &InterpretedMachine) -> Result<(), Failure> {
    machine.check_parameters().map_err(|missing| {
        Failure::Run(format!(
            "{missing}; set them with --set {}=…",
            missing.names.join("=… --set ")
        ))
    })
}

/// Tells a run which numbers of its start to keep, if the call says so.
pub fn keep<'a, L: InputLaw<InterpretedSystem>>(
    simulation: Simulation<'a, InterpretedMachine, L>,
    keep: &call::Keep,
) -> Simulation<'a, InterpretedMachine, L> {
    let Some(names) = kept_names(keep) else {
        return simulation;
    };
    let keep = |simulation: Simulation<'a, _, L>, name: &String| simulation.keep(name);
    names.iter().fold(simulation.keep_none(), keep)
}

/// The numbers that a call keeps; `None` if it says nothing.
pub fn kept_names(keep: &call::Keep) -> Option<&[String]> {
    match keep.names.as_slice() {
        [] => None,
        [only] if only == "none" => Some(&[]),
        names => Some(names),
    }
}

/// Assignments sorted such that those of whole families precede those of members, wherever they are in the call.
pub fn families_first(assignments: &[Assignment]) -> impl Iterator<Item = &Assignment> {
    let of = |members: bool| {
        let sets = assignments.iter();
        sets.filter(move |set| set.name.contains('[') == members)
    };
    of(false).chain(of(true))
}

/// Whether there is a number or a family with this name.
fn is_named(numbers: &Named, name: &str) -> bool {
    numbers.clone().set(name, 0.0).is_ok()
}

/// The failure for a name that does not exist, with a similar name or all names.
pub fn name_error(noun: &str, unknown: &UnknownName) -> Failure {
    unknown_name(noun, unknown, None)
}

/// The failure for an unknown name, optionally with a note about the same name elsewhere.
fn unknown_name(noun: &str, unknown: &UnknownName, other: Option<&str>) -> Failure {
    let name = &unknown.name;
    let help = match other {
        Some(other) => other.to_owned(),
        None => help_with(name, unknown.known.iter().map(String::as_str)),
    };
    Failure::Call(format!("no {noun} named `{name}`; {help}"))
}

/// The description of a file from which a spec is made.
pub fn read_as(file: &Path) -> &'static str {
    if file.extension().is_some_and(|ending| ending == "machine") {
        "which the spec extends"
    } else {
        "which the spec reads"
    }
}
