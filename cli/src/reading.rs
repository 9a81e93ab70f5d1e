//! A spec from its file to its machine.

use lagrangian::interpreted::{InterpretedMachine, UnknownName};
use lagrangian_spec::compile::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::{Coordinate, Model};
use lagrangian_spec::program::Program;
use lagrangian_spec::source::{Disk, Files, Sources};
use lagrangian_spec::unit::Unit;
use lagrangian_symbolic::{Dag, Rational};

use crate::call;
use crate::failure::Failure;

/// A spec that was read, and what is wrong with it.
pub struct Reading {
    name: String,
    text: String,
    constants: Vec<(String, Rational)>,
    /// The texts that messages point into.
    pub sources: Sources,
    /// What is wrong.
    pub report: Report,
}

impl Reading {
    /// Reads the file of a spec.
    ///
    /// # Errors
    /// The call is at fault if there is no such file.
    pub fn open(spec: &call::Spec) -> Result<Reading, Failure> {
        let path = spec.path.to_string_lossy();
        let read = Disk.read(&path, None);
        let (_, text) =
            read.map_err(|error| Failure::Call(format!("cannot read {path}: {error}")))?;
        Ok(Reading {
            name: path.into_owned(),
            text,
            constants: spec.constants.clone(),
            sources: Sources::new(),
            report: Report::new(),
        })
    }

    /// A variant of a spec that has an input for each of its coordinates, a generalized force on it.
    ///
    /// # Errors
    /// As [`open`](Self::open).
    pub fn controlled(
        spec: &call::Spec,
        coordinates: &[Coordinate<'_>],
    ) -> Result<Reading, Failure> {
        let (mut inputs, mut forces) = (String::new(), String::new());
        for (index, coordinate) in coordinates.iter().enumerate() {
            // Whatever the spec calls its own.
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
        reading.name = variant.to_string_lossy().into_owned();
        reading.text = format!(
            "machine Controlled extends \"{base}\" {{ inputs {{ {inputs} }} forces {{ {forces} }} }}"
        );
        Ok(reading)
    }

    /// What the spec means, as far as nothing is wrong; the report says what is.
    pub fn model<'d>(&mut self, dag: &'d Dag) -> Option<Model<'d>> {
        let Reading {
            name,
            text,
            constants,
            sources,
            report,
        } = self;
        lagrangian_spec::model(dag, name, text, constants, &mut Disk, sources, report)
    }

    /// The machine through every stage.
    ///
    /// # Errors
    /// If the spec is wrong.
    pub fn compile(mut self, dag: &Dag) -> Result<Compiled<'_>, Failure> {
        let model = self.model(dag);
        let compiled = model.and_then(|model| Compiled::new(model, &mut self.report));
        compiled.ok_or_else(|| self.failure())
    }

    /// What is wrong, as a failure.
    pub fn failure(self) -> Failure {
        Failure::Spec(Box::new((self.report, self.sources)))
    }
}

/// The program of a spec.
///
/// # Errors
/// If there is no such file or the spec is wrong.
pub fn program(spec: &call::Spec) -> Result<Program, Failure> {
    let dag = Dag::new();
    Ok(Reading::open(spec)?.compile(&dag)?.program)
}

/// The machine with the parameters of a call.
///
/// # Errors
/// If the call names a parameter that the machine does not have.
pub fn machine(program: Program, start: &call::Start) -> Result<InterpretedMachine, Failure> {
    let mut machine = InterpretedMachine::new(program);
    for set in &start.parameters {
        let unknown = |unknown: UnknownName| name_error("parameter or input", &unknown);
        machine.set(&set.name, set.value).map_err(unknown)?;
    }
    Ok(machine)
}

/// A name that does not exist, with the near one or all there are.
pub fn name_error(what: &str, unknown: &UnknownName) -> Failure {
    let known = || unknown.known.iter().map(String::as_str);
    let help = match lagrangian_spec::diagnostic::nearest(&unknown.name, known()) {
        Some(near) => format!("did you mean `{near}`?"),
        None if unknown.known.is_empty() => "there are none".into(),
        None => format!("there are: {}", unknown.known.join(", ")),
    };
    Failure::Call(format!("no {what} named `{}`; {help}", unknown.name))
}
