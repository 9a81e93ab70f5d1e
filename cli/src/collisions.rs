//! Reports on unilateral contacts: impacts, closing, lifting, slipping and sticking, and the energy taken.

use lagrangian::interpreted::{InterpretedSystem, Named};
use lagrangian::{
    Compliance, ContactEnergies, ContactEvent, ContactEventKind, Event, State, System,
    UnilateralContact, UnilateralForce,
};
use serde_json::{Value, json};

use crate::numbers::{by_name, shortest, states};
use crate::recording::Run;

/// What a run has shown about a contact.
struct Account {
    name: String,
    impacts: usize,
    /// The energy that it took. Without an energy balance only impacts and layers are known.
    energies: ContactEnergies,
    has_balance: bool,
    /// Whether it has friction.
    has_friction: bool,
    /// Whether it is compliant, and whether it is a layer that is crushed.
    is_compliant: bool,
    is_layer: bool,
    /// Whether it is the rolling friction of another contact.
    rolls: bool,
    /// The last time it closed with the uncertainty of that time, and whether it is closed at the end.
    closed_at: Option<(f64, f64)>,
    is_closed: bool,
}

/// From so many contacts on, the summary counts those that were never closed in one line.
const MANY: usize = 32;

impl Account {
    /// Whether the contact was never closed. Of a compliant one only an energy balance tells.
    fn was_open_throughout(&self) -> bool {
        let is_known = self.has_balance || !self.is_compliant;
        is_known
            && self.impacts == 0
            && self.closed_at.is_none()
            && !self.is_closed
            && self.energies == ContactEnergies::default()
    }
}

fn accounts(run: &Run) -> Vec<Account> {
    let closed = run.closed_contacts(run.end().t);
    let crushing = run.crushing_work();
    let books = run.contact_energies();
    let contacts = run.system().unilateral_contacts().enumerate();
    let of_contact = |(k, contact): (usize, UnilateralContact<'_>)| {
        let tally = run.contact_tallies().get(k).copied().unwrap_or_default();
        Account {
            name: contact.name.to_owned(),
            impacts: tally.impacts,
            energies: books.get(k).copied().unwrap_or_else(|| {
                let mut energies = ContactEnergies::default();
                energies.impact_loss = run.impact_losses().get(k).copied().unwrap_or(0.0);
                energies.crushing_work = crushing.get(k).copied().unwrap_or(0.0);
                energies
            }),
            has_balance: k < books.len(),
            has_friction: contact.has_friction,
            is_compliant: contact.compliance.is_some(),
            is_layer: contact.compliance == Some(Compliance::Layer),
            rolls: contact.is_rolling_resistance,
            closed_at: tally.closed_at.map(|t| (t, tally.time_error)),
            is_closed: closed.get(k).copied().unwrap_or(false),
        }
    };
    let mut accounts: Vec<Account> = Vec::new();
    for (k, contact) in contacts {
        let account = of_contact((k, contact));
        // The energy lost along the second tangent belongs to the same contact.
        match accounts.last_mut().filter(|_| contact.is_second_tangent) {
            Some(first) => add(&mut first.energies, &account.energies),
            None => accounts.push(account),
        }
    }
    accounts
}

/// Adds the energies of one account to another.
fn add(sum: &mut ContactEnergies, other: &ContactEnergies) {
    sum.impact_loss += other.impact_loss;
    sum.friction_loss += other.friction_loss;
    sum.damping_loss += other.damping_loss;
    sum.crushing_work += other.crushing_work;
    sum.work += other.work;
}

/// The energies taken by contacts by cause, as texts with values in J, as far as each contact has them.
pub fn losses(system: &InterpretedSystem, energies: &[ContactEnergies]) -> Vec<(String, f64)> {
    let mut contacts: Vec<(UnilateralContact<'_>, ContactEnergies)> = Vec::new();
    for (contact, of) in system.unilateral_contacts().zip(energies) {
        match contacts.last_mut().filter(|_| contact.is_second_tangent) {
            Some((_, first)) => add(first, of),
            None => contacts.push((contact, *of)),
        }
    }
    let of_contact = |(contact, of): &(UnilateralContact<'_>, ContactEnergies)| {
        let is_layer = contact.compliance == Some(Compliance::Layer);
        let is_compliant = contact.compliance.is_some();
        [
            ("impacts", of.impact_loss, !is_compliant),
            ("friction", of.friction_loss, contact.has_friction),
            ("damping", of.damping_loss, is_compliant && !is_layer),
            ("crushing", of.crushing_work, is_layer),
        ]
        .into_iter()
        .filter(|(.., has)| *has)
        .map(|(how, taken, _)| (format!("dissipated by `{}`, {how}", contact.name), taken))
        .collect::<Vec<_>>()
    };
    contacts.iter().flat_map(of_contact).collect()
}

/// Whether an event belongs to a contact.
pub fn is_of_contact(run: &Run, event: &Event<Named>) -> bool {
    let Some((contact, word)) = event.name.rsplit_once(' ') else {
        return false;
    };
    let mut kinds = ContactEventKind::ALL.into_iter();
    let mut contacts = run.system().unilateral_contacts();
    kinds.any(|kind| kind.word() == word) && contacts.any(|known| known.name == contact)
}

/// The lines of the summary.
pub fn lines(run: &Run) -> Vec<String> {
    // Where nothing moves as prescribed, this work is round-off.
    let exchanged = run
        .energy_balance()
        .map_or(0.0, |balance| balance.exchanged);
    let rounding = 1e-12 * exchanged;
    let line = |account: Account| {
        let Account {
            name,
            impacts,
            energies,
            has_balance,
            has_friction,
            is_compliant,
            is_layer,
            rolls,
            closed_at,
            is_closed,
        } = account;
        let loss = energies.impact_loss;
        let mut line = match impacts {
            _ if is_layer => format!("{name}: crushed by {:.6e} J", energies.crushing_work),
            _ if is_compliant => format!("{name}: compliant"),
            _ if rolls => format!("{name}: impacts dissipated {loss:.6e} J"),
            1 => format!("{name}: 1 impact, which dissipated {loss:.6e} J"),
            _ => format!("{name}: {impacts} impacts, which dissipated {loss:.6e} J"),
        };
        if has_balance && (has_friction || rolls) {
            line.push_str(&format!(
                "; friction dissipated {:.6e} J",
                energies.friction_loss
            ));
        }
        if has_balance && is_compliant && !is_layer {
            line.push_str(&format!(
                "; damping dissipated {:.6e} J",
                energies.damping_loss
            ));
        }
        if energies.work.abs() > rounding {
            line.push_str(&format!(
                "; prescribed motion did {:.6e} J of work",
                energies.work
            ));
        }
        if rolls {
            return line;
        }
        if let Some((t, error)) = closed_at {
            line.push_str(&format!("; closed at t = {} s", shortest(t)));
            if error > 0.0 {
                line.push_str(&format!(" within {error:.1e} s, where its bounces end"));
            }
        }
        line.push_str(if is_closed {
            "; closed at the end"
        } else {
            "; open at the end"
        });
        line
    };
    let all = accounts(run);
    let are_many = all.len() >= MANY;
    let (open, told): (Vec<Account>, Vec<Account>) = all
        .into_iter()
        .partition(|account| are_many && account.was_open_throughout());
    let mut lines: Vec<String> = told.into_iter().map(line).collect();
    match open.iter().filter(|account| !account.rolls).count() {
        0 => {}
        1 => lines.push("1 contact was open throughout".to_owned()),
        count => lines.push(format!("{count} contacts were open throughout")),
    }
    lines
}

/// The fields of the contacts in a JSON document; empty if there are none. `shown` gives the coordinates in which a state is shown.
pub fn fields(
    run: &Run,
    shown: &dyn Fn(&State<Named>) -> State<Named>,
) -> Vec<(&'static str, Value)> {
    if run.system().unilateral_contacts().len() == 0 {
        return Vec::new();
    }
    let accounts = accounts(run);
    let has_layers = accounts.iter().any(|account| account.is_layer);
    let all: Vec<ContactEnergies> = accounts.iter().map(|account| account.energies).collect();
    let sum = |part: fn(&ContactEnergies) -> f64| all.iter().map(part).sum::<f64>();
    let accounts: Vec<Value> = accounts
        .into_iter()
        .map(|account| {
            let mut document = json!({
                "name": account.name,
                "impacts": account.impacts,
                "impact_loss": account.energies.impact_loss,
                "closed_at": account.closed_at.map(|(t, _)| t),
                "closed_at_error": account.closed_at.map(|(_, error)| error),
                "closed": account.is_closed,
            });
            if let Value::Object(fields) = &mut document {
                let ContactEnergies {
                    friction_loss,
                    damping_loss,
                    crushing_work,
                    work,
                    ..
                } = account.energies;
                if account.has_balance {
                    fields.insert("friction_loss".into(), friction_loss.into());
                    fields.insert("damping_loss".into(), damping_loss.into());
                    fields.insert("work".into(), work.into());
                }
                if account.is_layer {
                    fields.insert("crushing_work".into(), crushing_work.into());
                }
            }
            document
        })
        .collect();
    let slips_across = |contact: &str| {
        let second = format!("{contact}.across");
        run.system()
            .unilateral_contacts()
            .any(|known| known.is_second_tangent && known.name == second)
    };
    let events = run.contact_events().iter();
    let events = events.map(|contact_event| {
        let state = shown(&contact_event.state);
        event(contact_event, &state, slips_across(&contact_event.contact))
    });
    let mut fields = vec![
        ("contact_events", events.collect()),
        ("unilateral_contacts", accounts.into()),
        ("impact_loss", sum(|of| of.impact_loss).into()),
    ];
    if !run.handovers().is_empty() {
        let handovers = run.handovers().iter().map(|handover| match handover.step {
            Some(step) => json!({ "t": handover.t, "to": "moreau", "step": step }),
            None => json!({ "t": handover.t, "to": "events" }),
        });
        fields.push(("handovers", handovers.collect()));
    }
    if let Some(balance) = run.energy_balance() {
        fields.push(("work", balance.work.into()));
        fields.push(("dissipated", balance.dissipated.into()));
        fields.push(("friction_loss", sum(|of| of.friction_loss).into()));
        // The remainder was dissipated by the dampers of the machine.
        let otherwise = sum(|of| of.lost() - of.damping_loss);
        fields.push(("damping_loss", (balance.dissipated - otherwise).into()));
    }
    if has_layers {
        fields.push(("crushing_work", sum(|of| of.crushing_work).into()));
    }
    fields
}

/// The report on an event of a contact, which has one or two tangents, with its state as it is shown.
fn event(event: &ContactEvent<Named>, state: &State<Named>, slips_across: bool) -> Value {
    let mut document = json!({
        "t": event.state.t,
        "contact": event.contact,
        "kind": event.kind.word(),
        "q": by_name(&state.q),
        "v": by_name(&state.v),
    });
    let Value::Object(fields) = &mut document else {
        return document;
    };
    if let Some(states) = states(&state.v) {
        fields.insert("states".into(), states);
    }
    if let Some(impact) = event.impact {
        fields.insert("gap_rate".into(), json!(impact.gap_rate));
        fields.insert("slip".into(), json!(impact.slip));
        fields.insert("impulse".into(), json!(impact.impulse));
        if let Some(across) = impact.across {
            fields.insert("slip_across".into(), json!(across.slip));
            let [normal, tangential] = impact.impulse;
            let impulse = [normal, tangential, across.impulse];
            fields.insert("impulse".into(), json!(impulse));
        }
        fields.insert("loss".into(), json!(impact.loss));
    }
    if slips_across && event.kind == ContactEventKind::Slips {
        let direction = [event.direction, event.across];
        fields.insert("direction".into(), json!(direction));
    } else if event.direction != 0.0 {
        fields.insert("direction".into(), json!(event.direction));
    }
    if event.time_error > 0.0 {
        fields.insert("time_error".into(), json!(event.time_error));
    }
    document
}

/// Gap, rates and forces of each contact at a state.
pub fn forces(system: &InterpretedSystem, forces: &[UnilateralForce]) -> Vec<(String, Value)> {
    let pairs = system.unilateral_contacts().zip(forces);
    let entry = |(contact, force): (UnilateralContact<'_>, &UnilateralForce)| {
        let force = json!({
            "gap": force.gap,
            "gap_rate": force.gap_rate,
            "slip": force.slip,
            "normal": force.normal,
            "friction": force.friction,
            "closed": force.closed,
            "sticks": force.sticks,
        });
        (contact.name.to_owned(), force)
    };
    pairs.map(entry).collect()
}
