//! The quantities that a call differentiates, and the variables by which it does.

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Machine, State, System};
use lagrangian_linear::starts::Cause;
use lagrangian_spec::model::Model;
use lagrangian_symbolic::Expr;
use lagrangian_units::{integral_name, rate_name, rate_unit, state_of};

use crate::call;
use crate::failure::{Failure, help_with};
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

/// The names and units of what a machine has.
struct Known {
    parameters: Vec<(String, String)>,
    inputs: Vec<(String, String)>,
    outputs: Vec<(String, String)>,
    coordinates: Vec<(String, String)>,
}

impl Known {
    fn of(machine: &InterpretedMachine) -> Known {
        let program = machine.program();
        let slots = |slots: &[lagrangian_program::Slot]| -> Vec<(String, String)> {
            let slots = slots.iter();
            slots
                .map(|slot| (slot.name.to_string(), slot.label()))
                .collect()
        };
        Known {
            parameters: slots(&program.parameters),
            inputs: slots(&program.inputs),
            outputs: slots(&program.outputs),
            coordinates: machine
                .prepare()
                .coordinates()
                .map(|q| (q.name.to_owned(), q.unit.to_owned()))
                .collect(),
        }
    }

    fn start(&self, k: usize) -> Variation {
        let (name, unit) = &self.coordinates[k];
        Variation {
            by: By::Start(k),
            name: format!("start({name})"),
            unit: unit.clone(),
        }
    }

    fn start_rate(&self, k: usize) -> Variation {
        let (name, unit) = &self.coordinates[k];
        Variation {
            by: By::StartRate(k),
            name: format!("rate({name})"),
            unit: rate_unit(name, unit),
        }
    }

    /// The start of a state, which is the rate of its integral.
    fn start_of_state(&self, k: usize) -> Variation {
        let (name, unit) = &self.coordinates[k];
        Variation {
            by: By::StartRate(k),
            name: format!("start({})", rate_name(name, "")),
            unit: rate_unit(name, unit),
        }
    }

    /// The parameters and inputs of this name, or the members of the family of this name.
    fn constants(&self, name: &str) -> impl Iterator<Item = Variation> {
        let lists = [
            (&self.parameters, By::Parameter as fn(usize) -> By),
            (&self.inputs, By::Input),
        ];
        lists.into_iter().flat_map(move |(list, by)| {
            named(list, name).map(move |k| Variation {
                by: by(k),
                name: list[k].0.clone(),
                unit: list[k].1.clone(),
            })
        })
    }

    /// What one word of `--by` names.
    fn variations(&self, name: &str, start: &State<Named>) -> Vec<Variation> {
        let inner = |function: &str| {
            let inner = name.strip_prefix(function)?.strip_prefix('(')?;
            Some(inner.strip_suffix(')')?.trim())
        };
        let state = inner("start").map(integral_name);
        let of_state = state.map_or_else(Vec::new, |integral| places(&start.q, &integral));
        if !of_state.is_empty() {
            let all = of_state.into_iter().map(|k| self.start_of_state(k));
            return all.collect();
        }
        if let Some(coordinate) = inner("start").filter(|name| !is_integral(name)) {
            let all = places(&start.q, coordinate).into_iter();
            return all.map(|k| self.start(k)).collect();
        }
        if let Some(coordinate) = inner("rate").filter(|name| !is_integral(name)) {
            let all = places(&start.q, coordinate).into_iter();
            return all.map(|k| self.start_rate(k)).collect();
        }
        self.constants(name).collect()
    }

    fn coordinate(&self, k: usize) -> Observed {
        let (name, unit) = &self.coordinates[k];
        Observed {
            of: Of::Coordinate(k),
            name: name.clone(),
            unit: unit.clone(),
        }
    }

    fn rate(&self, k: usize) -> Observed {
        let (name, unit) = &self.coordinates[k];
        Observed {
            of: Of::Rate(k),
            name: rate_name(name, ""),
            unit: rate_unit(name, unit),
        }
    }

    fn output(&self, k: usize) -> Observed {
        let (name, unit) = &self.outputs[k];
        Observed {
            of: Of::Output(k),
            name: name.clone(),
            unit: unit.clone(),
        }
    }

    /// What is observed where nothing is named: the outputs, or the coordinates of a machine without any. Of a state the state itself
    /// is shown, not its integral, on which nothing depends.
    fn observed_by_default(&self) -> Vec<Observed> {
        if !self.outputs.is_empty() {
            let all = 0..self.outputs.len();
            return all.map(|k| self.output(k)).collect();
        }
        let shown = |k: usize| {
            if is_integral(&self.coordinates[k].0) {
                self.rate(k)
            } else {
                self.coordinate(k)
            }
        };
        (0..self.coordinates.len()).map(shown).collect()
    }

    /// What one word of `--of` names.
    fn observed(&self, name: &str, start: &State<Named>) -> Vec<Observed> {
        let outputs: Vec<Observed> = named(&self.outputs, name).map(|k| self.output(k)).collect();
        if !outputs.is_empty() {
            return outputs;
        }
        let rates = |of: &str| places(&start.q, of).into_iter().map(|k| self.rate(k));
        let inner = name.strip_prefix("der(");
        if let Some(inner) = inner.and_then(|inner| inner.strip_suffix(')')) {
            return rates(inner.trim()).collect();
        }
        let coordinates = places(&start.q, name).into_iter();
        rates(&integral_name(name))
            .chain(coordinates.map(|k| self.coordinate(k)))
            .collect()
    }
}

/// The places of the entries of this name, or of the members of the family of this name.
fn named(list: &[(String, String)], name: &str) -> impl Iterator<Item = usize> {
    let member = format!("{name}[");
    let is_meant = move |known: &str| known == name || known.starts_with(&member);
    (0..list.len()).filter(move |k| is_meant(&list[*k].0))
}

/// The error of an option that names nothing, with the name that was probably meant; `what` it could have named.
fn no_such(option: &str, name: &str, what: &str, known: &[String]) -> Failure {
    let help = help_with(name, known.iter().map(String::as_str));
    Failure::Call(format!("{option} {name}: no {what} of that name; {help}"))
}

/// The variables that `--by` names.
pub(super) fn variations(
    (model, machine): (&Model<'_>, &InterpretedMachine),
    start: &State<Named>,
    wanted: &[String],
) -> Result<Vec<Variation>, Failure> {
    let known = Known::of(machine);
    let mut all = Vec::new();
    for name in wanted {
        let meant = known.variations(name, start);
        if meant.is_empty()
            && let Some(others) = followed(model, name)
        {
            return Err(Failure::Call(format!(
                "--by {name}: the spec computes it from {}: ask by these, or replace its formula by a value, --set {name}=…",
                others.join(", ")
            )));
        }
        if meant.is_empty() {
            let constants = known.parameters.iter().chain(&known.inputs);
            let constants = constants.map(|(name, _)| name.clone());
            let starts = (known.coordinates.iter()).flat_map(|(name, _)| match state_of(name) {
                Some(state) => vec![format!("start({state})")],
                None => vec![format!("start({name})"), format!("rate({name})")],
            });
            let known: Vec<String> = constants.chain(starts).collect();
            return Err(no_such("--by", name, "parameter, input or start", &known));
        }
        all.extend(meant);
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
    let known = Known::of(machine);
    let wanted = call::names_of_option("--of", lists)?;
    if wanted.is_empty() {
        return Ok(known.observed_by_default());
    }
    let mut all = Vec::new();
    for name in &wanted {
        let meant = known.observed(name, start);
        if meant.is_empty() {
            let outputs = known.outputs.iter().map(|(name, _)| name.clone());
            let motion = (known.coordinates.iter()).flat_map(|(name, _)| match state_of(name) {
                Some(state) => vec![state],
                None => vec![name.clone(), format!("der({name})")],
            });
            let known: Vec<String> = outputs.chain(motion).collect();
            return Err(no_such("--of", name, "coordinate, rate or output", &known));
        }
        all.extend(meant);
    }
    call::refuse_twice("--of", all.iter().map(|one| one.name.as_str())).map_err(Failure::Call)?;
    Ok(all)
}

/// Whether a coordinate is the integral of a state of first order.
pub(super) fn is_integral(coordinate: &str) -> bool {
    state_of(coordinate).is_some()
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
