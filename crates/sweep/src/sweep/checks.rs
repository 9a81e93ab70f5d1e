//! Checks of a plan against its machine.

use lagrangian::{ContactEventKind, LEAST_RELATIVE_TOLERANCE};
use lagrangian_spec::diagnostic::most_similar;
use lagrangian_spec::model::{Contact, Model};

use super::varied::{VariedQuantity, unit_of};
use super::{MOST_INSTANTS, PlanError};
use crate::design;
use crate::plan::{Function, Plan};
use crate::signals;
use crate::sobol::MOST_VARIABLES;

/// Checks names and numbers of a plan; returns what each varied name stands for.
pub(super) fn check(plan: &Plan, model: &Model<'_>) -> Result<Vec<VariedQuantity>, PlanError> {
    check_design(plan)?;
    check_times(plan)?;
    check_events(plan, model)?;
    check_names(plan, model)?;
    check_kept(plan, model)?;
    check_powers(plan, model)?;
    let varied = plan.varied().into_iter();
    Ok(varied.map(|name| VariedQuantity::of(name, model)).collect())
}

fn check_design(plan: &Plan) -> Result<(), PlanError> {
    let wrong = |message: String| Err(PlanError::Plan(message));
    if design::runs(&plan.design).is_none() {
        return wrong("there are more than 2^40 runs".into());
    }
    if plan.runs() == 0 {
        return wrong("there are no runs: a factor of the design has no values".into());
    }
    if let Some(fault) = plan.design.iter().find_map(design::Factor::fault) {
        return wrong(fault);
    }
    for factor in &plan.design {
        if let design::Factor::Sample {
            design: design::Sampling::Sobol,
            variables,
            ..
        } = factor
            && variables.len() > MOST_VARIABLES
        {
            return wrong(format!(
                "a Sobol design has at most {MOST_VARIABLES} variables; --design latin has no such limit"
            ));
        }
    }
    Ok(())
}

/// Checks how long runs last, and when they are recorded.
fn check_times(plan: &Plan) -> Result<(), PlanError> {
    let wrong = |message: String| Err(PlanError::Plan(message));
    if !(LEAST_RELATIVE_TOLERANCE..1.0).contains(&plan.tolerance) {
        return wrong(format!(
            "--tolerance {}: a tolerance must be less than 1, and at least {LEAST_RELATIVE_TOLERANCE:.1e}, which is the limit of round-off",
            plan.tolerance
        ));
    }
    if plan.max_steps == 0 {
        return wrong("--max-steps 0: a run needs at least one step".into());
    }
    if !(plan.until.is_finite() && plan.until != 0.0) {
        return wrong("a sweep needs a duration: --until must be a number other than 0".into());
    }
    let is_within = |t: f64| t * plan.until.signum() >= 0.0 && t.abs() <= plan.until.abs();
    if let Some(t) = plan.at.iter().find(|t| !is_within(**t)) {
        return wrong(format!(
            "--record at={t}: that is not within the run, which lasts until {} s",
            plan.until
        ));
    }
    let mut recorded = plan.at.iter().enumerate();
    if let Some((_, t)) = recorded.find(|(k, t)| plan.at[..*k].contains(t)) {
        return wrong(format!("--record at={t}: {t} s is given more than once"));
    }
    if let Some(after) = plan
        .after
        .filter(|after| !is_within(*after) || *after == plan.until)
    {
        return wrong(format!(
            "--after {after}: that is not within the run, which lasts until {} s",
            plan.until
        ));
    }
    if plan
        .every
        .is_some_and(|every| !(every > 0.0 && plan.until.abs() / every <= MOST_INSTANTS))
    {
        return wrong(format!(
            "--record every: more than {MOST_INSTANTS:e} instants of each run, or none"
        ));
    }
    if plan.every.is_some() && !plan.at_events.is_empty() {
        return wrong(
            "--record every and --record event: all samples must be drawn in one way".into(),
        );
    }
    Ok(())
}

/// Checks the names of events that runs are recorded at, or that are reduced.
fn check_events(plan: &Plan, model: &Model<'_>) -> Result<(), PlanError> {
    let wrong = |message: String| Err(PlanError::Plan(message));
    let of_contacts = contact_events(model);
    let known = || {
        let own = plan.events.iter().map(|watch| watch.name.as_str());
        own.chain(of_contacts.iter().map(String::as_str))
    };
    if let Some(name) = plan
        .at_events
        .iter()
        .find(|name| !known().any(|known| known == *name))
    {
        let help = match most_similar(name, known()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("`--event {name}=FORMULA` defines it"),
        };
        return wrong(format!(
            "--record event={name}: there is no such event; {help}"
        ));
    }
    let mut recorded = plan.at_events.iter().enumerate();
    if let Some((_, name)) = recorded.find(|(k, name)| plan.at_events[..*k].contains(name)) {
        return wrong(format!(
            "--record event={name}: `{name}` is given more than once"
        ));
    }
    for reduction in plan
        .reduce
        .iter()
        .filter(|reduction| reduction.function.is_of_event())
    {
        if !known().any(|name| name == reduction.of) {
            let help = match most_similar(&reduction.of, known()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => "name it by --event NAME=FORMULA".into(),
            };
            return wrong(format!(
                "--reduce {}: no event named `{}`; {help}",
                reduction.name, reduction.of
            ));
        }
    }
    Ok(())
}

/// Checks the names of what is varied, set and driven: each is given once.
fn check_names(plan: &Plan, model: &Model<'_>) -> Result<(), PlanError> {
    let wrong = |message: String| Err(PlanError::Plan(message));
    let varied = plan.varied();
    let mut set: Vec<&str> = plan.set.iter().map(|(name, _)| name.as_str()).collect();
    set.extend(plan.inputs.iter().map(|(name, _)| name.as_str()));
    let starts = plan.start.iter().map(|(name, _)| format!("start({name})"));
    let rates = plan.rate.iter().map(|(name, _)| format!("rate({name})"));
    let starts_and_rates: Vec<String> = starts.chain(rates).collect();
    let mut seen = std::collections::BTreeSet::new();
    for name in &varied {
        unit_of(model, name).map_err(PlanError::Plan)?;
        if !seen.insert(*name) {
            return wrong(format!("`{name}` is varied more than once"));
        }
        if set.contains(name) || starts_and_rates.iter().any(|given| given == name) {
            return wrong(format!(
                "`{name}` is varied, but also has one value for all runs"
            ));
        }
    }
    let mut values = std::collections::BTreeSet::new();
    for name in plan
        .set
        .iter()
        .map(|(name, _)| name.as_str())
        .chain(starts_and_rates.iter().map(String::as_str))
    {
        unit_of(model, name).map_err(PlanError::Plan)?;
        if !values.insert(name) {
            return wrong(format!("`{name}` is set more than once"));
        }
    }
    let reductions = plan.reduce.iter().map(|of| ("--reduce", &of.name));
    let mut named = reductions.chain(plan.events.iter().map(|of| ("--event", &of.name)));
    if let Some((option, _)) = named.find(|(_, name)| name.trim().is_empty()) {
        return wrong(format!("{option}: a name is empty"));
    }
    for (name, _) in &plan.inputs {
        let mut inputs = model.inputs.iter();
        if !inputs.any(|input| input.name.to_string() == *name) {
            return wrong(signals::unknown_input(name, model));
        }
        if plan.set.iter().any(|(set, _)| set == name) {
            return wrong(format!(
                "`{name}` is driven by --input, and has one value by --set too"
            ));
        }
    }
    Ok(())
}

/// Checks the names of start values that the projection onto the constraints keeps: each is given once.
fn check_kept(plan: &Plan, model: &Model<'_>) -> Result<(), PlanError> {
    let names = plan.keep.as_deref().unwrap_or_default();
    for (k, name) in names.iter().enumerate() {
        let rate = name.strip_prefix("der(");
        let coordinate = rate.and_then(|rate| rate.strip_suffix(')')).unwrap_or(name);
        unit_of(model, &format!("start({coordinate})"))
            .map_err(|why| PlanError::Plan(format!("--keep {name}: {why}")))?;
        if names[..k].contains(name) {
            return Err(PlanError::Plan(format!(
                "--keep names `{name}` more than once"
            )));
        }
    }
    Ok(())
}

/// Checks the names of contacts whose powers are asked for.
fn check_powers(plan: &Plan, model: &Model<'_>) -> Result<(), PlanError> {
    let wrong = |message: String| Err(PlanError::Plan(message));
    let mut powers = plan.reduce.iter();
    if let Some(reduction) = powers.find(|reduction| {
        let is_named = |contact: &Contact<'_>| contact.name.to_string() == reduction.of;
        reduction.function == Function::Power && !model.contacts.iter().any(is_named)
    }) {
        let names: Vec<String> = model
            .contacts
            .iter()
            .map(|of| of.name.to_string())
            .collect();
        let help = match most_similar(&reduction.of, names.iter().map(String::as_str)) {
            Some(near) => format!("did you mean `{near}`?"),
            None if names.is_empty() => "the machine has no `contacts`".into(),
            None => format!("there are: {}", names.join(", ")),
        };
        return wrong(format!(
            "--reduce {}: no contact named `{}`; {help}",
            reduction.name, reduction.of
        ));
    }
    Ok(())
}

/// The events of the unilateral contacts of a machine, as runs name them: `floor impact`.
pub(super) fn contact_events(model: &Model<'_>) -> Vec<String> {
    let of_contact = |contact: &Contact<'_>| {
        let kinds = ContactEventKind::ALL.into_iter();
        let name = contact.name.to_string();
        kinds
            .map(move |kind| format!("{name} {}", kind.word()))
            .collect::<Vec<_>>()
    };
    model.contacts.iter().flat_map(of_contact).collect()
}
