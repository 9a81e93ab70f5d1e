//! What is told of a run: in words, or as JSON.

use lagrangian::interpreted::Named;
use lagrangian::methods::TAYLOR;
use lagrangian::{EnergyBalance, Machine, MethodChoice, MethodReason, State, System};
use lagrangian_units::state_of;
use serde_json::{Value, json};

use super::Prepared;
use crate::call;
use crate::collisions;
use crate::contacts::{self, ContactSummary};
use crate::numbers::{by_name, shortest, states, width_of_names};
use crate::output;
use crate::recording::Run;

/// A run as JSON.
pub(super) fn document(
    call: &call::Simulate,
    prepared: &Prepared<'_>,
    run: &Run,
    contacts: &[ContactSummary],
    (interruption, errors): (&Option<String>, &[String]),
) -> Value {
    let statistics = run.statistics();
    let end = prepared.shown(run.end());
    let events: Vec<Value> = contacts::other_events(run.events(), contacts)
        .map(|event| json!({ "t": event.state.t, "name": event.name }))
        .collect();
    let warnings = prepared.other_method.clone().into_iter();
    let warnings = warnings.chain(run.warnings().iter().map(ToString::to_string));
    let warnings = warnings.chain(contacts.iter().flat_map(ContactSummary::warnings));
    let warnings = warnings.chain(interruption.iter().cloned());
    let warnings: Vec<String> = warnings.collect();
    let mut document = json!({
        "t": end.t,
        "q": by_name(&end.q),
        "v": by_name(&end.v),
        "steps": statistics.steps,
        "rejected": statistics.rejected,
        "evaluations": statistics.evaluations,
        "seconds": statistics.seconds,
        "energy_residual": run.energy_balance().map(|balance| balance.residual()),
        "constraint_residual": statistics.constraint_residual,
        "events": events,
        "warnings": warnings,
    });
    if let Value::Object(fields) = &mut document {
        if let Some(states) = states(&end.v) {
            fields.insert("states".into(), states);
        }
        if !call.inputs.is_empty() {
            let inputs = call.inputs.iter();
            let inputs = inputs.map(|input| (input.name.clone(), input.value.clone().into()));
            fields.insert("inputs".into(), Value::Object(inputs.collect()));
        }
        if !contacts.is_empty() {
            let contacts = contacts.iter().map(ContactSummary::json);
            fields.insert("contacts".into(), contacts.collect());
        }
        if !run.choices().is_empty() {
            let choice = |choice: &MethodChoice| {
                json!({
                    "t": choice.t,
                    "method": choice.method.tableau.name,
                    "reason": choice.reason.to_string(),
                })
            };
            let methods = run.choices().iter().map(choice);
            fields.insert("methods".into(), methods.collect());
        }
        for (name, value) in collisions::fields(run, &|state| prepared.shown(state)) {
            fields.insert(name.into(), value);
        }
        if interruption.is_some() {
            fields.insert("interrupted".into(), true.into());
        }
        if !errors.is_empty() {
            fields.insert("error".into(), errors.join("; ").into());
        }
    }
    document
}

/// Prints a run in words.
pub(super) fn print(
    call: &call::Simulate,
    prepared: &Prepared<'_>,
    run: &Run,
    contacts: &[ContactSummary],
) {
    let statistics = run.statistics();
    let (start, end) = (run.start(), prepared.shown(run.end()));
    output::line(format_args!(
        "{}: t = {} s to {} s, {}",
        prepared.machine.name(),
        shortest(start.t),
        shortest(end.t),
        prepared.method.tableau.title
    ));
    output::line(format_args!(
        "  {} steps, {} rejected, {} evaluations, {:.3} s",
        statistics.steps, statistics.rejected, statistics.evaluations, statistics.seconds
    ));
    print_choices(run);
    if !call.inputs.is_empty() {
        output::line(format_args!("  inputs"));
    }
    for input in &call.inputs {
        output::line(format_args!("    {} = {}", input.name, input.value));
    }
    print_end(&end);
    if let Some(balance) = run.energy_balance() {
        print_energies(&balance);
    }
    if run.system().constraints().len() > 0 {
        output::line(format_args!(
            "  constraints: residual {:.1e}, relative to their terms",
            statistics.constraint_residual
        ));
    }
    print_contacts(run, contacts);
    let events = contacts::other_events(run.events(), contacts);
    for event in events.filter(|event| !collisions::is_of_contact(run, event)) {
        output::line(format_args!(
            "  event {} at t = {} s",
            event.name, event.state.t
        ));
    }
    for warning in run.warnings() {
        output::line(format_args!("  warning: {warning}"));
    }
    for warning in contacts.iter().flat_map(ContactSummary::warnings) {
        output::line(format_args!("  warning: {warning}"));
    }
}

/// Prints which methods a run chose, and why. If stiffness was never found, the choice is not mentioned.
fn print_choices(run: &Run) {
    let follows_contacts = |reason: &MethodReason| {
        matches!(
            reason,
            MethodReason::Open | MethodReason::Closed | MethodReason::ClosedInSeries
        )
    };
    let (with_contacts, others): (Vec<&MethodChoice>, Vec<_>) =
        (run.choices().iter()).partition(|choice| follows_contacts(&choice.reason));
    if others.len() > 1 {
        for choice in others {
            output::line(format_args!(
                "  {} from t = {} s: {}",
                choice.method.tableau.name,
                shortest(choice.t),
                choice.reason
            ));
        }
    }
    if !with_contacts.is_empty() {
        print_flights(run);
    }
}

/// Prints how long a run with contacts went by series, and otherwise.
fn print_flights(run: &Run) {
    let choices = run.choices();
    let ends = (choices.iter().skip(1).map(|choice| choice.t)).chain([run.end().t]);
    let first = choices
        .iter()
        .position(|choice| std::ptr::eq(choice.method, &TAYLOR));
    let (mut in_series, mut otherwise) = (0.0, 0.0);
    for (choice, end) in choices.iter().zip(ends).skip(first.unwrap_or(0)) {
        if std::ptr::eq(choice.method, &TAYLOR) {
            in_series += end - choice.t;
        } else {
            otherwise += end - choice.t;
        }
    }
    if otherwise == 0.0 {
        output::line(format_args!("  taylor with contacts open and closed"));
        return;
    }
    output::line(format_args!(
        "  taylor for {in_series:.6} s; dop853 for {otherwise:.6} s, while a contact was closed"
    ));
}

/// Prints coordinates with their rates, and states of first order, at the end of a run.
fn print_end(end: &State<Named>) {
    let width = width_of_names(end.q.iter().map(|(name, _)| name));
    output::line(format_args!("  at the end"));
    for ((name, q), (_, v)) in end.q.iter().zip(end.v.iter()) {
        if let Some(state) = state_of(name) {
            output::line(format_args!("    {state:width$} = {}", shortest(v)));
            continue;
        }
        let rate = format!("der({name})");
        let rate_width = width + "der()".len();
        output::line(format_args!(
            "    {name:width$} = {:<24} {rate:rate_width$} = {}",
            shortest(q),
            shortest(v)
        ));
    }
}

fn print_energies(balance: &EnergyBalance) {
    output::line(format_args!("  energy [J]"));
    output::line(format_args!(
        "    at the start {:.6e}, at the end {:.6e}",
        balance.start, balance.end
    ));
    output::line(format_args!(
        "    work of drives and forces {:.6e}, dissipated {:.6e}",
        balance.work, balance.dissipated
    ));
    output::line(format_args!(
        "    residual {:.3e}, {:.1e} of the energy exchanged",
        balance.residual(),
        balance.relative()
    ));
}

fn print_contacts(run: &Run, contacts: &[ContactSummary]) {
    if !contacts.is_empty() {
        output::line(format_args!("  rolling contacts"));
    }
    for contact in contacts {
        output::line(format_args!("    {}", contact.line()));
    }
    let collisions = collisions::lines(run);
    if !collisions.is_empty() {
        output::line(format_args!("  unilateral contacts"));
    }
    for line in collisions {
        output::line(format_args!("    {line}"));
    }
}
