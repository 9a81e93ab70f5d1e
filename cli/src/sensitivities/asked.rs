//! The quantities that a call differentiates, and the variables by which it does.

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, State, System};
use lagrangian_linear::starts::Cause;
use lagrangian_spec::diagnostic::most_similar;
use lagrangian_spec::model::Model;
use lagrangian_spec::unit::{self, integral_name, state_of};
use lagrangian_symbolic::Expr;

use crate::call;
use crate::failure::Failure;
use crate::reading::places;

/// A variable of differentiation.
pub(super) enum By {
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
    pub fn cause(&self) -> Cause {
        match self {
            By::Parameter(index) => Cause::Parameter(*index),
            By::Input(_) => Cause::Input,
            By::Start(k) => Cause::Start(*k),
            By::StartRate(k) => Cause::Rate(*k),
        }
    }
}

/// A variable of differentiation, with its name and unit.
pub(super) struct Variation {
    pub by: By,
    pub name: String,
    pub unit: String,
}

/// A differentiated quantity.
pub(super) enum Of {
    Coordinate(usize),
    Rate(usize),
    Output(usize),
}

/// A differentiated quantity, with its name and unit.
pub(super) struct Observed {
    pub of: Of,
    pub name: String,
    pub unit: String,
}

/// The parameters on which one depends that the spec computes from others, if `name` is one.
pub(super) fn followed(model: &Model<'_>, name: &str) -> Option<Vec<String>> {
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
pub(super) fn variations(
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
pub(super) fn observed(
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
pub(super) fn is_integral(coordinate: &str) -> bool {
    state_of(coordinate).is_some()
}

/// The name of the rate of a coordinate: `der(x)`, or the name of a state.
pub(super) fn shown_rate(coordinate: &str) -> String {
    state_of(coordinate).unwrap_or_else(|| format!("der({coordinate})"))
}

/// The unit of the rate of a quantity with this unit.
pub(super) fn rate_unit(unit: &str) -> String {
    match unit {
        "1" => "1/s".to_owned(),
        unit => format!("{unit}/s"),
    }
}

/// The quotient of two units.
pub(super) fn per(unit: &str, other: &str) -> String {
    let is_simple = |unit: &str| !unit.contains(['*', '/', ' ']);
    match (unit, other) {
        (unit, "1") => unit.to_owned(),
        (unit, other) if is_simple(other) => format!("{unit}/{other}"),
        (unit, other) => format!("{unit}/({other})"),
    }
}
