//! The arguments of a program: parameters, coordinates, inputs and outputs.

use super::Lowering;
use lagrangian_program::formula::formula;
use lagrangian_program::{Default, Fact, Slot, Source};
use lagrangian_spec::model::{Model, Name, Variable};
use lagrangian_spec::unit::Unit;
use lagrangian_symbolic::{Expr, nearest};
use lagrangian_units::rate_name;

/// The coordinates at the start, and behind them their rates if any of these is not 0.
pub(super) fn start_values<'d>(model: &Model<'d>) -> Vec<Expr<'d>> {
    let mut starts: Vec<Expr<'d>> = model.coordinates.iter().map(|c| c.start).collect();
    if model.coordinates.iter().any(|c| !c.start_rate.is_zero()) {
        starts.extend(model.coordinates.iter().map(|c| c.start_rate));
    }
    starts
}

/// The named numbers that a program takes and gives.
pub(super) struct Slots {
    pub parameters: Vec<Slot>,
    pub coordinates: Vec<Slot>,
    pub inputs: Vec<Slot>,
    pub outputs: Vec<Slot>,
}

impl Slots {
    pub fn of(lowering: &mut Lowering<'_, '_>) -> Slots {
        let model = lowering.model;
        let mut default = |constant| default(lowering, constant);
        let (parameters, inputs) = (model.parameters.iter(), model.inputs.iter());
        let parameters = parameters.map(|p| {
            let default = p.default.map(&mut default);
            slot(&p.name, &p.docs, p.unit, &p.unit_text, default)
        });
        let parameters = parameters.collect();
        let inputs = inputs.map(|i| {
            let default = Some(default(i.default));
            slot(&i.name, &i.docs, i.unit, &i.unit_text, default)
        });
        let inputs = inputs.collect();
        let (coordinates, outputs) = (model.coordinates.iter(), model.outputs.iter());
        let coordinates = coordinates.map(|c| slot(&c.name, &c.docs, c.unit, &c.unit_text, None));
        let outputs = outputs.map(|o| slot(&o.name, &o.docs, o.unit, &o.unit_text, None));
        Slots {
            parameters,
            coordinates: coordinates.collect(),
            inputs,
            outputs: outputs.collect(),
        }
    }
}

/// The name of a start value: the name of its coordinate, or `der(phi)`.
pub(super) fn start_name(model: &Model<'_>, of: Variable) -> String {
    match of {
        Variable::Rate(i) => rate_name(&model.coordinates[i].name.to_string(), ""),
        Variable::Coordinate(i) => model.coordinates[i].name.to_string(),
        Variable::Parameter(i) => model.parameters[i].name.to_string(),
        Variable::Input(i) => model.inputs[i].name.to_string(),
    }
}

pub(super) fn facts(model: &Model<'_>) -> Vec<Fact> {
    let assumptions = model.assumptions.iter();
    assumptions
        .map(|a| Fact {
            text: a.text.clone(),
            strict: a.strict,
        })
        .collect()
}

fn slot(name: &Name, docs: &str, unit: Unit, unit_text: &str, default: Option<Default>) -> Slot {
    Slot {
        name: name.clone(),
        docs: docs.to_owned(),
        unit,
        unit_text: unit_text.to_owned(),
        default,
    }
}

/// A constant, as a number and as text.
fn default<'d>(lowering: &mut Lowering<'_, 'd>, constant: Expr<'d>) -> Default {
    let value = nearest(constant);
    lowering.lower(&[constant]);
    let text = formula(
        &mut lowering.graph,
        lowering.values[&constant.id()],
        &|source| name_of(lowering.model, source),
    );
    Default { value, text }
}

/// The name of an argument.
pub(super) fn name_of(model: &Model<'_>, source: Source) -> String {
    let coordinate = |index: u32| model.coordinates[index as usize].name.to_string();
    match source {
        Source::Parameter(index) => model.parameters[index as usize].name.to_string(),
        Source::Prepared(index) => format!("prepared {index}"),
        Source::Time => "t".into(),
        Source::Coordinate(index) => coordinate(index),
        Source::Velocity(index) => rate_name(&coordinate(index), ""),
        Source::Acceleration(index) => rate_name(&rate_name(&coordinate(index), ""), ""),
        Source::Input(index) => model.inputs[index as usize].name.to_string(),
        Source::AtTime(index) => format!("at time {index}"),
        Source::AtPosition(index) => format!("at position {index}"),
    }
}
