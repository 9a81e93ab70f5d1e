//! The formulas and the columns of a sweep.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{Machine, System};
use lagrangian_spec::model::Model;
use lagrangian_spec::resolve::Formula as OutputFormula;
use lagrangian_spec::unit::{rate_name, rate_unit};

use super::ReductionSource;
use super::varied::unit_of;
use crate::plan::{AUTO, Function, Plan, Reduction};
use crate::reduce::{Formula, Tracker};
use crate::rows::{Column, ColumnType};

/// The argument of a reduction, and whether its absolute value is reduced.
pub(super) fn subject(reduction: &Reduction) -> (&str, bool) {
    let text = reduction.of.trim();
    let is_extreme = matches!(reduction.function, Function::Max | Function::WhenMax);
    let inner = text.strip_prefix("abs").map(str::trim_start);
    let inner = inner.and_then(|text| text.strip_prefix('(')?.strip_suffix(')'));
    match inner.filter(|_| is_extreme) {
        Some(inner) if is_closed(inner) => (inner, true),
        _ => (text, false),
    }
}

/// Whether every closing bracket has been opened before.
fn is_closed(text: &str) -> bool {
    let mut depth = 0_i32;
    let mut closed = text.chars().map(|c| {
        depth += match c {
            '(' => 1,
            ')' => -1,
            _ => 0,
        };
        depth >= 0
    });
    closed.all(|is_open| is_open)
}

/// A formula of a plan: its name as an output of the model, its name for messages, its text and, if that is known, its unit.
pub(super) struct AskedFormula {
    name: String,
    source_name: String,
    text: String,
    unit: Option<String>,
}

impl AskedFormula {
    pub(super) fn as_output(&self) -> OutputFormula<'_> {
        OutputFormula {
            name: &self.name,
            source_name: &self.source_name,
            text: &self.text,
            unit: self.unit.as_deref(),
        }
    }
}

/// Every formula of a plan, in the order inputs, events, reductions.
pub(super) fn asked_formulas(plan: &Plan, model: &Model<'_>) -> Vec<AskedFormula> {
    let mut all = Vec::new();
    for (name, law) in &plan.inputs {
        if let Some(text) = law.formula() {
            let input = model
                .inputs
                .iter()
                .find(|input| input.name.to_string() == *name);
            let unit = input.map(|input| input.unit_text.clone());
            all.push(AskedFormula {
                name: format!("input {name}"),
                source_name: format!("--input {name}"),
                text: text.to_owned(),
                unit,
            });
        }
    }
    for watch in &plan.events {
        let option = if watch.ends {
            "--until-event"
        } else {
            "--event"
        };
        let name = &watch.name;
        all.push(AskedFormula {
            name: format!("event {name}"),
            source_name: format!("{option} {name}"),
            text: watch.formula.clone(),
            unit: None,
        });
    }
    for reduction in plan
        .reduce
        .iter()
        .filter(|reduction| reduction.function.is_of_formula())
    {
        let name = &reduction.name;
        let (text, _) = subject(reduction);
        all.push(AskedFormula {
            name: format!("reduction {name}"),
            source_name: format!("--reduce {name}"),
            text: text.to_owned(),
            unit: None,
        });
    }
    all
}

/// What computes each reduction of a plan, and its unit; `next` is the formula of the next one that has one.
pub(super) fn reductions(
    plan: &Plan,
    model: &Model<'_>,
    mut next: impl FnMut() -> Formula,
) -> (Vec<ReductionSource>, Vec<String>) {
    let mut units = Vec::new();
    let mut reductions = Vec::new();
    for reduction in &plan.reduce {
        if !reduction.function.is_of_formula() {
            let unit = match reduction.function {
                Function::Count => "1",
                Function::Frequency => "1/s",
                Function::Power => "W",
                _ => "s",
            };
            units.push(unit.to_owned());
            reductions.push(ReductionSource::Of(
                reduction.function,
                reduction.of.clone(),
            ));
            continue;
        }
        let formula = next();
        let (_, of_size) = subject(reduction);
        let unit = &model.outputs[formula.output].unit_text;
        units.push(match reduction.function {
            Function::WhenMax | Function::WhenMin => "s".to_owned(),
            Function::Integral if unit == "1" => "s".to_owned(),
            Function::Integral => format!("({unit})*s"),
            _ => unit.clone(),
        });
        reductions.push(ReductionSource::Along(Tracker::new(
            reduction.function,
            formula,
            of_size,
        )));
    }
    (reductions, units)
}

/// The columns of rows and those of samples.
pub(super) fn columns(
    plan: &Plan,
    model: &Model<'_>,
    machine: &InterpretedMachine,
    units: &[String],
) -> (Vec<Column>, Option<Vec<Column>>) {
    let number = |name: String, unit: &str| Column {
        name,
        unit: Some(unit.to_owned()),
        kind: ColumnType::Number,
    };
    let other = |name: &str, kind| Column {
        name: name.into(),
        unit: None,
        kind,
    };
    let system = machine.prepare();
    let state = |suffix: &str| {
        let positions = system
            .coordinates()
            .map(|c| number(format!("{}{suffix}", c.name), c.unit));
        let rates = system.coordinates().map(|c| {
            let name = format!("{}{suffix}", rate_name(c.name, ""));
            number(name, &rate_unit(c.name, c.unit))
        });
        positions.chain(rates).collect::<Vec<_>>()
    };
    let mut columns = vec![other("run", ColumnType::Count)];
    for name in plan.varied() {
        let unit = unit_of(model, name).unwrap_or_default();
        columns.push(number(name.to_owned(), &unit));
    }
    columns.extend([
        other("status", ColumnType::Text),
        other("error", ColumnType::Text),
        number("t".into(), "s"),
    ]);
    columns.extend(state(""));
    for t in &plan.at {
        columns.extend(state(&format!("@{t}")));
    }
    for (reduction, unit) in plan.reduce.iter().zip(units) {
        columns.push(number(reduction.name.clone(), unit));
    }
    columns.push(other("steps", ColumnType::Count));
    columns.push(number("energy residual".into(), "J"));
    if plan.method == AUTO {
        columns.push(other("methods", ColumnType::Text));
    }
    let samples = plan.has_samples().then(|| {
        let mut columns = vec![other("run", ColumnType::Count), number("t".into(), "s")];
        columns.extend(state(""));
        if !plan.at_events.is_empty() {
            columns.push(other("event", ColumnType::Text));
        }
        columns
    });
    (columns, samples)
}
