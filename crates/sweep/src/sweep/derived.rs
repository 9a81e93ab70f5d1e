//! What is derived from a plan before its runs: the model, its machines, and the method.

use lagrangian::interpreted::{Engine, InterpretedMachine};
use lagrangian::methods::{Method, TAYLOR};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::series::{ProvedSeries, SeriesText};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::{Model, stage};
use lagrangian_spec::resolve::Formula as OutputFormula;
use lagrangian_spec::source::{Sources, Span};
use lagrangian_symbolic::{Dag, Rational};

use super::PlanError;
use super::varied::VariedQuantity;
use crate::charts::ChartedPoints;
use crate::plan::{AUTO, Plan, RecordedFiles};
use crate::reduce::Formula;

/// A machine in Cartesian coordinates, in which runs are made that are shown in the coordinates of the spec.
#[derive(Debug)]
pub(super) struct Cartesian {
    pub(super) machine: InterpretedMachine,
    pub(super) points: ChartedPoints,
}

/// The model of the plan's spec, with its formulas added.
pub(super) fn model<'d>(
    plan: &Plan,
    constants: &[(String, Rational)],
    dag: &'d Dag,
    formulas: &[OutputFormula<'_>],
    sources: &mut Sources,
    report: &mut Report,
) -> Option<Model<'d>> {
    let text = &plan.spec;
    let spec = lagrangian_spec::parse(sources, &text.name, &text.text, report);
    let spec = spec.with_given(plan.spec.given.iter().cloned().chain(plan.given()));
    let files = &mut RecordedFiles(&text.files);
    Model::resolve_with(spec, dag, constants, formulas, files, sources, report)
}

/// The formulas of a plan as outputs of the model, which come after its own.
///
/// # Errors
/// If one that may not depend on accelerations does.
pub(super) fn formulas(
    model: &Model<'_>,
    asked: &[OutputFormula<'_>],
) -> Result<Vec<Formula>, PlanError> {
    let own = model.outputs.len() - asked.len();
    let outputs = (own..).zip(&model.outputs[own..]);
    let formulas = outputs.zip(asked).map(|((output, formula), asked)| {
        if formula.value.stage() < stage::TIME && is_of_event(asked) {
            return Err(PlanError::Plan(format!(
                "{}: `{}` depends only on numbers and parameters, so that it never changes its sign; give a formula in coordinates, rates or the time `t`",
                asked.source_name, asked.text
            )));
        }
        let reads_accelerations = formula.value.stage() == stage::ACCELERATION;
        if reads_accelerations && !asked.source_name.starts_with("--reduce") {
            return Err(PlanError::Plan(format!(
                "{}: `{}` depends on accelerations, which depend on it in turn or jump where contacts change; only reductions may",
                asked.source_name, asked.text
            )));
        }
        Ok(Formula {
            output,
            reads_accelerations,
        })
    });
    formulas.collect()
}

/// Whether a formula is that of an event.
fn is_of_event(asked: &OutputFormula<'_>) -> bool {
    ["--event", "--until-event"]
        .iter()
        .any(|option| asked.source_name.starts_with(option))
}

/// For each fact that the spec assumes its text and its place in the spec.
pub(super) fn places_of_assumptions(model: &Model<'_>, sources: &Sources) -> Vec<(String, String)> {
    let place = |span: Span| {
        let (line, column) = sources.line_column(span);
        format!("{}:{line}:{column}", sources.name(span.source))
    };
    let stated = model.assumptions.iter();
    stated
        .map(|stated| (stated.text.clone(), place(stated.span)))
        .collect()
}

/// The machine of a plan with its series, the method of its runs, and a warning if that is not the one that the plan asks for.
pub(super) fn machine(
    plan: &Plan,
    compiled: &Compiled<'_>,
    engine: Engine,
) -> Result<(InterpretedMachine, &'static Method, Option<String>), PlanError> {
    let mut machine = InterpretedMachine::new(compiled.program.clone());
    machine
        .set_engine(engine)
        .map_err(|none| PlanError::Plan(none.to_string()))?;
    let mut method = method(plan)?;
    let mut warning = None;
    if plan.method == AUTO {
        let text = text_of_series(plan, false).map_err(PlanError::Plan)?;
        machine = machine.with_series_on_demand(move || text.derive());
    }
    if std::ptr::eq(method, &TAYLOR) {
        let series = ProvedSeries::derive(&compiled.model);
        if let Err(reason) = &series {
            method = <&Method>::default();
            warning = Some(without(method, reason));
        }
        let text = text_of_series(plan, false).map_err(PlanError::Plan)?;
        machine = machine
            .with_series(series)
            .with_contact_series_on_demand(move || text.derive_with_contacts());
    }
    Ok((machine, method, warning))
}

/// The machine of a plan in Cartesian coordinates; `None` if they cannot express the plan.
pub(super) fn in_cartesian(
    plan: &Plan,
    polar: &Compiled<'_>,
    (model, points): (Model<'_>, ChartedPoints),
    engine: Engine,
    method: &Method,
) -> Option<Cartesian> {
    let keeps = plan.keep.as_ref();
    if keeps.is_some_and(|names| points.check_kept(names).is_err()) || !model.uncharted.is_empty() {
        return None;
    }
    let mut report = Report::new();
    let compiled = Compiled::for_runs(model, &mut report)?;
    polar.check_chart(&compiled, &mut report)?;
    let mut machine = InterpretedMachine::new(compiled.program.clone());
    machine.set_engine(engine).ok()?;
    if std::ptr::eq(method, &TAYLOR) {
        let series = ProvedSeries::derive(&compiled.model);
        if series.is_err() {
            return None;
        }
        let text = text_of_series(plan, true).ok()?;
        machine = machine
            .with_series(series)
            .with_contact_series_on_demand(move || text.derive_with_contacts());
    }
    if plan.method == AUTO {
        let text = text_of_series(plan, true).ok()?;
        machine = machine.with_series_on_demand(move || text.derive());
    }
    set_all(&mut machine, &plan.set).ok()?;
    Some(Cartesian { machine, points })
}

/// The texts from which the series of a plan's machine is derived, or of that in Cartesian coordinates.
fn text_of_series(plan: &Plan, in_charts: bool) -> Result<SeriesText, String> {
    let mut text = plan.spec.of_series(in_charts)?;
    text.given.extend(plan.given());
    Ok(text)
}

/// The method of a plan; the default one if the sweep is to choose it.
fn method(plan: &Plan) -> Result<&'static Method, PlanError> {
    if plan.method == AUTO {
        return Ok(<&Method>::default());
    }
    let Some(method) = Method::named(&plan.method) else {
        let mut names: Vec<_> = Method::all().map(|method| method.tableau.name).collect();
        names.insert(0, AUTO);
        let message = format!(
            "no method named `{}`; there are: {}",
            plan.method,
            names.join(", ")
        );
        return Err(PlanError::Plan(message));
    };
    if method.has_fixed_steps() {
        let name = method.tableau.name;
        let message = format!(
            "the method `{name}` takes steps of a fixed length, which a plan does not have"
        );
        return Err(PlanError::Plan(message));
    }
    Ok(method)
}

/// The warning that another method is used, since there is no series for this reason.
pub(super) fn without(method: &Method, reason: impl std::fmt::Display) -> String {
    let name = method.tableau.name;
    format!("no Taylor series: {reason}; {name} is used")
}

/// Sets values, families before their members.
pub(super) fn set_all(
    machine: &mut InterpretedMachine,
    all: &[(String, f64)],
) -> Result<(), String> {
    for is_member in [false, true] {
        for (name, value) in all
            .iter()
            .filter(|(name, _)| name.contains('[') == is_member)
        {
            machine
                .set(name, *value)
                .map_err(|unknown| unknown.to_string())?;
        }
    }
    Ok(())
}

/// Checks that every parameter has a value, or is varied.
pub(super) fn check_parameters(
    machine: &InterpretedMachine,
    varied: &[VariedQuantity],
) -> Result<(), PlanError> {
    let mut probe = machine.clone();
    for place in varied {
        if let VariedQuantity::Set(name) = place {
            let _ = probe.set(name, 1.0); // the name was checked
        }
    }
    probe.check_parameters().map_err(|missing| {
        PlanError::Plan(format!(
            "{missing}; set them with --set {}=…",
            missing.names.join("=… --set ")
        ))
    })
}
