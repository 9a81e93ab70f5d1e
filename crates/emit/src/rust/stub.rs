//! The placeholder for a machine whose spec has errors.

use lagrangian_symbolic::Rational;

use super::chart::ChartOf;
use super::{Options, unproved_expansion};
use lagrangian_program as program;
use lagrangian_program::quantity::{Needs, Sizes};
use lagrangian_program::{Function, Op, Program, Role, Shape, Slot, Value};
use lagrangian_spec::model::{Name, Stages};
use lagrangian_spec::syntax::{
    Charts, Expression, ExpressionKind, Ident, Index, Item, Quantity, Spec,
};
use lagrangian_spec::unit::Unit;

/// The placeholder for a machine whose spec has errors: it has every name that user code may refer to, and no motion.
/// So the errors of the spec are not buried under others.
pub fn stub(spec: &Spec, options: &Options) -> String {
    if spec.name.text.is_empty() {
        String::new()
    } else {
        let program = placeholder_program(spec);
        let chart = placeholder_chart(spec, &program);
        let chart = chart.as_ref().map(|(program, points)| ChartOf {
            program,
            options: options.without_chart(),
            points,
        });
        unproved_expansion(&program, chart.as_ref(), options)
    }
}

/// The placeholder in Cartesian coordinates with the places of its points, if the spec names any that it has.
fn placeholder_chart(spec: &Spec, program: &Program) -> Option<(Program, Vec<[usize; 2]>)> {
    let mut program = program.clone();
    let mut points = Vec::new();
    for item in &spec.charts {
        let Charts { polar, cartesian } = &item.content;
        let place = |ident: &Ident| {
            let mut slots = program.coordinates.iter();
            slots.position(|slot| slot.name.base == ident.text && slot.name.index.is_none())
        };
        let [Some(s), Some(phi)] = [place(&polar[0]), place(&polar[1])] else {
            continue;
        };
        let is_free = |ident: &Ident| {
            let mut slots = program.coordinates.iter();
            slots.all(|slot| slot.name.base != ident.text)
        };
        if cartesian.iter().all(is_free) && cartesian[0].text != cartesian[1].text {
            for (index, ident) in [s, phi].into_iter().zip(cartesian) {
                program.coordinates[index].name.base.clone_from(&ident.text);
            }
            points.push([s, phi]);
        }
    }
    (!points.is_empty()).then_some((program, points))
}

/// A machine with the names of a spec, as far as they can be determined, that does not move.
fn placeholder_program(spec: &Spec) -> Program {
    let slots = |items: &[Item<Quantity>]| all_slots(spec, items);
    let mut coordinates = slots(&spec.coordinates);
    let states = slots(&spec.states).into_iter();
    coordinates.extend(states.map(|slot| Slot {
        name: slot.name.integral(),
        ..slot
    }));
    let n = coordinates.len();
    let outputs = slots(&spec.outputs);
    let sizes = Sizes {
        coordinates: n,
        ..Sizes::default()
    };
    let everywhere = Role::all().filter(|role| role.row().needs == Needs::Nothing);
    let mut functions: Vec<Function> = everywhere
        .filter_map(|role| Some(zeros(role, role.row().extent.shape(sizes)?)))
        .collect();
    let asks = |stage: &str| spec.stages.iter().any(|item| item.name.base.text == stage);
    let stages = Stages {
        time: asks("time"),
        coordinates: asks("coordinates"),
    };
    if stages.time {
        functions.push(zeros(Role::AtTime, Shape::Vector(0)));
    }
    if stages.coordinates {
        functions.push(zeros(Role::AtPosition, Shape::Vector(0)));
    }
    if !stages.is_empty() {
        functions.push(zeros(Role::AccelerationsAt, Shape::Vector(n)));
    }
    functions.extend((0..outputs.len()).map(|i| zeros(Role::Output(i), Shape::Scalar)));
    Program {
        name: spec.name.text.clone(),
        docs: "The description of this machine has errors.".into(),
        parameters: slots(&spec.parameters),
        coordinates,
        quaternions: Vec::new(),
        inputs: slots(&spec.inputs),
        outputs,
        assumptions: Vec::new(),
        constraints: Vec::new(),
        contacts: Vec::new(),
        reaction_axes: 1,
        second_tangents: 0,
        unilateral: Vec::new(),
        kept: Vec::new(),
        derivatives: Vec::new(),
        stages,
        prepare: zeros(Role::Prepare, Shape::Vector(0)),
        prepared: Vec::new(),
        start: zeros(Role::Start, Shape::Vector(n)),
        functions,
        choices: Vec::new(),
    }
}

/// The members of all items of a section, each name once.
fn all_slots(spec: &Spec, items: &[Item<Quantity>]) -> Vec<Slot> {
    let mut slots: Vec<Slot> = Vec::new();
    for slot in items.iter().flat_map(|item| placeholder_slots(spec, item)) {
        // A duplicate declaration is one of the reported errors.
        let clashes = |known: &Slot| {
            known.name == slot.name
                || (known.name.base == slot.name.base
                    && known.name.index.is_some() != slot.name.index.is_some())
        };
        if !slots.iter().any(clashes) {
            slots.push(slot);
        }
    }
    slots
}

/// A function whose results are zero.
fn zeros(role: Role, shape: Shape) -> Function {
    let (code, results) = if shape.is_empty() {
        (Vec::new(), Vec::new())
    } else {
        (
            vec![Op::Constant(Rational::ZERO)],
            vec![Value(0); shape.len()],
        )
    };
    Function {
        role,
        code,
        shape,
        results,
        guards: Vec::new(),
        steps: Vec::new(),
    }
}

/// The members of an item, if their number is evident; otherwise one.
fn placeholder_slots(spec: &Spec, item: &Item<Quantity>) -> Vec<Slot> {
    /// The most members of a family in a placeholder.
    const MOST: i64 = 1000;
    let number = |expression: &Expression| integer(spec, expression);
    let indices: Vec<Option<i64>> = match &item.name.index {
        Index::None => vec![None],
        Index::One(index) => vec![Some(number(index).unwrap_or(1))],
        Index::Range(range) => {
            let (low, high) = (
                number(&range.low).unwrap_or(1),
                number(&range.high).unwrap_or(1),
            );
            (low..=high.clamp(low, low.saturating_add(MOST)))
                .map(Some)
                .collect()
        }
    };
    let slot = |index| Slot {
        name: Name {
            base: item.name.base.text.clone(),
            index,
        },
        docs: String::new(),
        unit: Unit::ONE,
        unit_text: item
            .content
            .unit
            .as_ref()
            .map_or_else(|| "1".into(), ToString::to_string),
        default: Some(program::Default {
            value: 0.0,
            text: "0".into(),
        }),
    };
    indices.into_iter().map(slot).collect()
}

/// The value of an expression that is a number or the name of a numeric constant.
fn integer(spec: &Spec, expression: &Expression) -> Option<i64> {
    match &expression.kind {
        ExpressionKind::Number(text) => text.parse().ok(),
        ExpressionKind::Name(name) => {
            let constant = spec
                .constants
                .iter()
                .find(|constant| constant.name.base.text == name.base.text)?;
            match &constant.content.value.as_ref()?.kind {
                ExpressionKind::Number(text) => text.parse().ok(),
                _ => None,
            }
        }
        _ => None,
    }
}
