//! `modelDescription.xml`, in both versions, and `buildDescription.xml`.

use lagrangian_program::Slot;
use lagrangian_units::{Unit as PhysicalUnit, state_of};

use super::dependencies::Dependencies;
use super::units::Units;
use super::variables::{Variable, VariableKind};
use super::xml::Document;
use super::{Unit, Version};
use crate::call::{Assignment, UnitKind};

/// The stop time of the default experiment, in s.
const STOP: &str = "5";

/// The attributes of one variable.
struct Row {
    causality: &'static str,
    variability: &'static str,
    initial: &'static str,
    start: String,
    /// The reference of the variable of which it is the derivative.
    derivative: Option<usize>,
    unit: String,
    docs: String,
}

/// The description of a unit.
pub fn text(unit: &Unit<'_>) -> String {
    let program = unit.program;
    let mut units = Units::default();
    let variables = &unit.variables.all;
    let rows = variables
        .iter()
        .map(|variable| row(unit, variable, &mut units));
    let rows: Vec<Row> = rows.collect();
    let mut document = Document::new();
    let docs = words(&program.docs);
    let convention = if unit.variables.is_structured {
        "structured"
    } else {
        "flat"
    };
    let indicators = (program.assumptions.len() + unit.events.len()).to_string();
    let (token, count) = match unit.version {
        Version::Two => ("guid", indicators.as_str()),
        Version::Three => ("instantiationToken", ""),
    };
    let tool = format!("lagrangian {}", env!("CARGO_PKG_VERSION"));
    document.open(
        "fmiModelDescription",
        &[
            ("fmiVersion", unit.version.name()),
            ("modelName", &program.name),
            (token, &unit.token),
            ("description", &docs),
            ("generationTool", &tool),
            ("variableNamingConvention", convention),
            ("numberOfEventIndicators", count),
        ],
    );
    for kind in [UnitKind::ModelExchange, UnitKind::CoSimulation] {
        if unit.kinds.contains(&kind) {
            of_kind(&mut document, unit, kind);
        }
    }
    units.write(&mut document);
    document.open("LogCategories", &[]);
    for name in [
        "logEvents",
        "logStatusWarning",
        "logStatusDiscard",
        "logStatusError",
    ] {
        document.leaf("Category", &[("name", name)]);
    }
    document.close();
    let tolerance = format!("{:?}", unit.tolerance);
    document.leaf(
        "DefaultExperiment",
        &[
            ("startTime", "0"),
            ("stopTime", STOP),
            ("tolerance", &tolerance),
        ],
    );
    document.open("ModelVariables", &[]);
    for (reference, (variable, row)) in variables.iter().zip(&rows).enumerate() {
        match unit.version {
            Version::Three => variable_of_version_3(&mut document, reference, variable, row),
            Version::Two => variable_of_version_2(&mut document, reference, variable, row),
        }
    }
    document.close();
    structure(&mut document, unit);
    document.finish()
}

fn of_kind(document: &mut Document, unit: &Unit<'_>, kind: UnitKind) {
    let derivatives = if unit.has_derivatives {
        "true"
    } else {
        "false"
    };
    let (name, steps) = match kind {
        UnitKind::ModelExchange => ("ModelExchange", ""),
        UnitKind::CoSimulation => ("CoSimulation", "true"),
    };
    let (get, serialize, provides) = match unit.version {
        Version::Three => (
            "canGetAndSetFMUState",
            "canSerializeFMUState",
            "providesDirectionalDerivatives",
        ),
        Version::Two => (
            "canGetAndSetFMUstate",
            "canSerializeFMUstate",
            "providesDirectionalDerivative",
        ),
    };
    // Version 2.0 has no function for adjoint derivatives.
    let adjoint = match unit.version {
        Version::Three => derivatives,
        Version::Two => "",
    };
    let saves = if unit.has_run() { "false" } else { "true" };
    let interpolates = match (unit.version, kind) {
        _ if unit.has_run() => "",
        (Version::Two, UnitKind::CoSimulation) if !unit.program.inputs.is_empty() => "true",
        _ => "",
    };
    let has_events = !unit.events.is_empty();
    let needs = has_events || !unit.program.constraints.is_empty();
    let needs_steps = match (unit.version, kind) {
        (Version::Three, UnitKind::ModelExchange) if needs => "true",
        _ => "",
    };
    let event_mode = match (unit.version, kind) {
        (Version::Three, UnitKind::CoSimulation) if has_events => "true",
        _ => "",
    };
    let attributes = [
        ("modelIdentifier", unit.identifier.as_str()),
        ("needsCompletedIntegratorStep", needs_steps),
        (get, saves),
        (serialize, saves),
        (provides, derivatives),
        ("providesAdjointDerivatives", adjoint),
        ("canHandleVariableCommunicationStepSize", steps),
        ("canInterpolateInputs", interpolates),
        ("hasEventMode", event_mode),
    ];
    match unit.version {
        Version::Three => document.leaf(name, &attributes),
        // A unit with a run has no sources.
        Version::Two if unit.has_run() => document.leaf(name, &attributes),
        Version::Two => {
            document.open(name, &attributes);
            document.open("SourceFiles", &[]);
            document.leaf("File", &[("name", unit.version.source())]);
            document.close();
            document.close();
        }
    }
}

/// The attributes of a variable.
fn row(unit: &Unit<'_>, variable: &Variable, units: &mut Units) -> Row {
    let n = unit.program.coordinates.len();
    let state = |i: usize| unit.start.get(i).map_or(0.0, |(x, _)| *x);
    let (physical, docs) = unit_and_docs(unit, variable.kind, units);
    let row = Row {
        causality: if variable.is_output {
            "output"
        } else {
            "local"
        },
        variability: "continuous",
        initial: "calculated",
        start: String::new(),
        derivative: None,
        unit: physical,
        docs,
    };
    match variable.kind {
        VariableKind::Time => Row {
            causality: "independent",
            initial: "",
            ..row
        },
        VariableKind::Coordinate(i) => row.starting_at(state(i)),
        VariableKind::Rate(i) => Row {
            derivative: Some(1 + i),
            ..row.starting_at(state(n + i))
        },
        VariableKind::Acceleration(i) => Row {
            derivative: Some(1 + n + i),
            ..row
        },
        VariableKind::Parameter(i) => Row {
            causality: "parameter",
            // The run of a unit is made for its parameters.
            variability: if unit.has_run() { "fixed" } else { "tunable" },
            ..row.starting_at(unit.machine.parameter_values()[i])
        },
        VariableKind::Input(i) => Row {
            causality: "input",
            // The causality implies it.
            initial: "",
            ..row.starting_at(unit.inputs[i])
        },
        VariableKind::Count(_) => Row {
            variability: "discrete",
            ..row
        },
        VariableKind::Output(_)
        | VariableKind::Multiplier(_)
        | VariableKind::KineticEnergy
        | VariableKind::PotentialEnergy
        | VariableKind::Fact(_)
        | VariableKind::Event(_)
        | VariableKind::OfContact(..) => row,
    }
}

impl Row {
    /// This variable with a start value that is exact.
    fn starting_at(self, start: f64) -> Row {
        Row {
            initial: "exact",
            start: format!("{start:?}"),
            ..self
        }
    }
}

/// The unit of a variable, and what it is in words.
fn unit_and_docs(unit: &Unit<'_>, kind: VariableKind, units: &mut Units) -> (String, String) {
    let program = unit.program;
    let of_state = |i: usize| state_of(&program.coordinates[i].name.to_string());
    match kind {
        VariableKind::Time => (units.of(PhysicalUnit::SECOND), "Time".into()),
        VariableKind::Coordinate(i) => {
            let slot = &program.coordinates[i];
            let docs = match of_state(i) {
                Some(state) => format!("Integral of {state} over time, on which nothing depends"),
                None => words(&slot.docs),
            };
            (units.of(slot.unit), docs)
        }
        VariableKind::Rate(i) => {
            let slot = &program.coordinates[i];
            let docs = of_state(i).map_or_else(String::new, |_| words(&slot.docs));
            (units.of(slot.unit.rate()), docs)
        }
        VariableKind::Acceleration(i) => {
            let slot = &program.coordinates[i];
            (units.of(slot.unit.rate().rate()), String::new())
        }
        VariableKind::Parameter(i) => of_slot(&program.parameters[i], units),
        VariableKind::Input(i) => of_slot(&program.inputs[i], units),
        VariableKind::Output(i) => of_slot(&program.outputs[i], units),
        VariableKind::Multiplier(i) => {
            let constraint = &program.constraints[i];
            let unit = &constraint.multiplier_unit;
            let docs = format!("Lagrange multiplier of {}, in {unit}", constraint.name);
            (String::new(), docs)
        }
        VariableKind::KineticEnergy => (units.of(PhysicalUnit::JOULE), "Kinetic energy".into()),
        VariableKind::PotentialEnergy => (units.of(PhysicalUnit::JOULE), "Potential energy".into()),
        VariableKind::Fact(i) => {
            let text = &program.assumptions[i].text;
            (String::new(), format!("Positive as long as {text}"))
        }
        VariableKind::Event(i) => {
            let slot = &program.outputs[program.outputs.len() - unit.events.len() + i];
            let Assignment { name, value } = &unit.events[i];
            let docs = format!("Changes sign at the event {name}: {}", words(value));
            (units.of_slot(slot), docs)
        }
        VariableKind::OfContact(contact, quantity) => {
            let name = unit.run.as_ref().map_or("", |run| &run.contacts[contact]);
            let what = ["Gap", "Normal force", "Friction", "Slip"][quantity];
            (String::new(), format!("{what} of {name}"))
        }
        VariableKind::Count(i) => {
            let name = &unit.events[i].name;
            (
                String::new(),
                format!("How often the event {name} happened"),
            )
        }
    }
}

fn of_slot(slot: &Slot, units: &mut Units) -> (String, String) {
    (units.of_slot(slot), words(&slot.docs))
}

fn variable_of_version_3(
    document: &mut Document,
    reference: usize,
    variable: &Variable,
    row: &Row,
) {
    let reference = reference.to_string();
    let derivative = row.derivative.map(|k| k.to_string()).unwrap_or_default();
    let of_type = match variable.kind {
        VariableKind::Count(_) => "Int32",
        _ => "Float64",
    };
    document.leaf(
        of_type,
        &[
            ("name", variable.name.as_str()),
            ("valueReference", &reference),
            ("description", &row.docs),
            ("causality", row.causality),
            ("variability", row.variability),
            ("initial", row.initial),
            ("unit", &row.unit),
            ("start", &row.start),
            ("derivative", &derivative),
        ],
    );
}

fn variable_of_version_2(
    document: &mut Document,
    reference: usize,
    variable: &Variable,
    row: &Row,
) {
    let number = reference.to_string();
    document.open(
        "ScalarVariable",
        &[
            ("name", variable.name.as_str()),
            ("valueReference", &number),
            ("description", &row.docs),
            ("causality", row.causality),
            ("variability", row.variability),
            ("initial", row.initial),
        ],
    );
    // The description counts variables from 1, in their order.
    let derivative = row.derivative.map(|k| (k + 1).to_string());
    let derivative = derivative.unwrap_or_default();
    let of_type = match variable.kind {
        VariableKind::Count(_) => "Integer",
        _ => "Real",
    };
    document.leaf(
        of_type,
        &[
            ("unit", row.unit.as_str()),
            ("start", &row.start),
            ("derivative", &derivative),
        ],
    );
    document.close();
}

/// The model structure: outputs, derivatives of states, initial unknowns, and event indicators, with their dependencies.
fn structure(document: &mut Document, unit: &Unit<'_>) {
    let outputs: Vec<usize> = unit.variables.outputs().map(|(k, _)| k).collect();
    let of = |is_wanted| unit.variables.of(is_wanted).map(|(k, _)| k);
    let derivatives: Vec<usize> = of(|kind| matches!(kind, VariableKind::Rate(_)))
        .chain(of(|kind| matches!(kind, VariableKind::Acceleration(_))))
        .collect();
    let is_calculated = |k: &usize| {
        !matches!(
            unit.variables.all[*k].kind,
            VariableKind::Coordinate(_) | VariableKind::Rate(_)
        )
    };
    let unknown = outputs.iter().chain(&derivatives).copied();
    let mut unknown: Vec<usize> = unknown.filter(is_calculated).collect();
    unknown.sort_unstable();
    unknown.dedup();
    let indicators = of(|kind| matches!(kind, VariableKind::Fact(_) | VariableKind::Event(_)));
    let indicators: Vec<usize> = indicators.collect();
    let dependencies = (!unit.has_run()).then(|| Dependencies::new(unit));
    // Forces of contacts make everything depend on everything, as a missing list of dependencies says.
    let attributes = |reference: usize, is_at_start: bool| {
        let dependencies = dependencies.as_ref()?;
        let of = dependencies.of(reference, is_at_start);
        let kinds = joined(of.iter().map(|(_, kind)| (*kind).to_owned()));
        // Version 2.0 counts variables from 1.
        let first = match unit.version {
            Version::Three => 0,
            Version::Two => 1,
        };
        let on = joined(of.iter().map(|(k, _)| (k + first).to_string()));
        Some([on, kinds])
    };
    document.open("ModelStructure", &[]);
    match unit.version {
        Version::Three => {
            for (name, references) in [
                ("Output", &outputs),
                ("ContinuousStateDerivative", &derivatives),
                ("InitialUnknown", &unknown),
                ("EventIndicator", &indicators),
            ] {
                for reference in references {
                    let named = ("valueReference", reference.to_string());
                    let of = attributes(*reference, name == "InitialUnknown");
                    unknown_element(document, name, named, of);
                }
            }
        }
        Version::Two => {
            for (name, references) in [
                ("Outputs", &outputs),
                ("Derivatives", &derivatives),
                ("InitialUnknowns", &unknown),
            ] {
                if references.is_empty() {
                    continue;
                }
                document.open(name, &[]);
                for reference in references {
                    let named = ("index", (reference + 1).to_string());
                    let of = attributes(*reference, name == "InitialUnknowns");
                    unknown_element(document, "Unknown", named, of);
                }
                document.close();
            }
        }
    }
    document.close();
}

/// An element of the model structure, with its dependencies if they are known.
fn unknown_element(
    document: &mut Document,
    name: &str,
    (attribute, value): (&str, String),
    dependencies: Option<[String; 2]>,
) {
    match dependencies {
        None => document.leaf(name, &[(attribute, &value)]),
        Some([on, kinds]) => document.element_with_empty(
            name,
            &[
                (attribute, &value),
                ("dependencies", &on),
                ("dependenciesKind", &kinds),
            ],
        ),
    }
}

fn joined(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(" ")
}

/// The build description, with which an importer of 3.0 compiles the sources.
pub fn of_build(unit: &Unit<'_>) -> String {
    let mut document = Document::new();
    document.open(
        "fmiBuildDescription",
        &[("fmiVersion", unit.version.name())],
    );
    document.open(
        "BuildConfiguration",
        &[("modelIdentifier", unit.identifier.as_str())],
    );
    document.open("SourceFileSet", &[("language", "C99")]);
    document.leaf("SourceFile", &[("name", unit.version.source())]);
    document.finish()
}

/// A text on one line.
fn words(docs: &str) -> String {
    docs.split_whitespace().collect::<Vec<_>>().join(" ")
}
