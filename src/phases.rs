//! Phases of the unilateral contacts in a run, from one change to the next.

use std::string::String;
use std::vec::Vec;

use crate::ContactMode;
use crate::balance::ContactShare;
use crate::constraints::Constraints;
use crate::contact::{Impact, SteppedContacts, UnilateralState};
use crate::stepper::Cause;
use crate::{ContactEnergies, ContactEvent, ContactImpact, ContactTally, System, Warning};

/// The states of the contacts from some instant on.
#[derive(Clone, Debug)]
pub(crate) struct Phase<V> {
    pub since: f64,
    /// The end of what is known of it, where later phases were forgotten; infinite if it lasts up to the next.
    pub until: f64,
    pub touching: UnilateralState,
    /// The change with which it began, and its cause.
    pub change: Change,
    /// The constraints that hold the closed contacts.
    pub constraints: Option<Constraints<V>>,
}

/// The energies of each contact up to an instant, and their rates there.
#[derive(Clone, Debug, Default)]
pub(crate) struct EnergyEntry {
    pub of_each: Vec<ContactEnergies>,
    pub powers: Vec<ContactShare>,
}

impl EnergyEntry {
    /// The energies of a contact at the fraction `share` of the time `h` to another instant, if nothing
    /// jumps in between.
    pub fn towards(
        &self,
        next: &EnergyEntry,
        contact: usize,
        h: f64,
        share: f64,
    ) -> ContactEnergies {
        let [from, to] = [self, next].map(|energy_entry| energy_entry.of_each[contact]);
        let power = |energy_entry: &EnergyEntry| {
            energy_entry
                .powers
                .get(contact)
                .copied()
                .unwrap_or_default()
        };
        let [begins, ends] = [power(self), power(next)];
        // Cubic Hermite interpolation.
        let between = |[from, to]: [f64; 2], [begins, ends]: [f64; 2]| {
            let rest = 1.0 - share;
            let of_powers = h * share * rest * (rest * begins - share * ends);
            from + share * share * (1.0 + 2.0 * rest) * (to - from) + of_powers
        };
        ContactEnergies {
            impact_loss: from.impact_loss,
            friction_loss: between(
                [from.friction_loss, to.friction_loss],
                [begins.friction, ends.friction],
            ),
            damping_loss: between(
                [from.damping_loss, to.damping_loss],
                [begins.compliance_loss, ends.compliance_loss],
            ),
            crushing_work: between(
                [from.crushing_work, to.crushing_work],
                [begins.compliance_loss, ends.compliance_loss],
            ),
            work: between([from.work, to.work], [begins.work, ends.work]),
        }
    }
}

/// A change of contacts at an instant, and its cause.
#[derive(Clone, Debug, Default)]
pub(crate) struct Change {
    pub cause: Option<Cause>,
    pub impacts: Vec<Impact>,
    /// Contacts whose bounces ended.
    pub ended: Vec<usize>,
}

/// Unilateral contacts between two changes of their states in a run.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ContactPhase<'s> {
    /// When it began, in s.
    pub since: f64,
    /// The state of each contact.
    pub modes: &'s [ContactMode],
    /// For each contact whether it is a layer under increasing load.
    pub loaded: Vec<bool>,
    /// Why it began, and which contact is the cause, if one is.
    pub cause: PhaseCause,
    /// The impacts with which it began, in their order, each with the index of its contact.
    pub impacts: Vec<(usize, ContactImpact)>,
    /// Contacts whose bounces ended there.
    pub ended: &'s [usize],
}

/// Why the states of contacts change.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum PhaseCause {
    /// The run began, or gaps closed.
    Asked,
    /// The force of a contact vanished.
    Lifts(usize),
    /// The slip of a contact stopped.
    Stops(usize),
    /// The friction of a contact was used up.
    Breaks(usize),
    /// A compliant contact began to press.
    Presses(usize),
    /// The reaction of a guide changed its sign.
    Switches(usize),
    /// A layer turned from loading to unloading, or came back to its greatest depth.
    Turns(usize),
    /// A step of time stepping.
    Stepped,
}

impl<V> Phase<V> {
    /// Its public view.
    pub fn public_view(&self) -> ContactPhase<'_> {
        let impact = |of: &Impact| {
            let impact = ContactImpact {
                gap_rate: of.gap_rate,
                slip: of.slip,
                impulse: of.impulse,
                loss: of.loss,
                // Here the second tangent of a contact has an impact of its own.
                across: None,
            };
            (of.contact, impact)
        };
        ContactPhase {
            since: self.since,
            modes: self.touching.modes(),
            loaded: self.touching.loaded().collect(),
            cause: match self.change.cause {
                Some(Cause::Unspecified) => PhaseCause::Asked,
                Some(Cause::Lifts(k) | Cause::Leaves(k)) => PhaseCause::Lifts(k),
                Some(Cause::Stops(k)) => PhaseCause::Stops(k),
                Some(Cause::Breaks(k, _)) => PhaseCause::Breaks(k),
                Some(Cause::Presses(k)) => PhaseCause::Presses(k),
                Some(Cause::Switches(k)) => PhaseCause::Switches(k),
                Some(Cause::Turns(k)) => PhaseCause::Turns(k),
                None => PhaseCause::Stepped,
            },
            impacts: self.change.impacts.iter().map(impact).collect(),
            ended: &self.change.ended,
        }
    }
}

/// The contacts of a list, each once.
fn in_order(contacts: &[usize]) -> Vec<usize> {
    let mut contacts = contacts.to_vec();
    contacts.sort_unstable();
    contacts.dedup();
    contacts
}

/// Memory for the record of a step of time stepping: what happened in it, the states of the contacts before and after it, and the impacts of contacts that were
/// open.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepRecord {
    pub stepped: SteppedContacts,
    pub before: Vec<ContactMode>,
    pub after: Vec<ContactMode>,
    pub hits: Vec<Impact>,
}

/// The record of the unilateral contacts of a run.
#[derive(Clone, Debug)]
pub(crate) struct UnilateralRecord<C, V> {
    pub phases: Vec<Phase<V>>,
    pub events: Vec<ContactEvent<C>>,
    /// What is known of each contact without its events.
    pub tallies: Vec<ContactTally>,
    /// The time of the last event of a contact, if there was one.
    pub last_event: Option<f64>,
    /// The time of the last event of a watched function.
    pub last_watched: f64,
    /// For each contact the energy lost in its impacts, in J.
    pub losses: Vec<f64>,
    /// The energies of each contact, at the same instants as the energies of the machine.
    pub energy_entries: Vec<EnergyEntry>,
    /// In time stepping, for each contact whether it is closed permanently.
    pub last: Vec<bool>,
    pub of_step: StepRecord,
    /// Impacts that created energy: their number, and the worst.
    pub energy_gains: usize,
    pub worst: Option<(usize, f64, f64)>,
    /// Instants at which contacts shared their load in another way than by the rule for undetermined forces, although the motion depends on it.
    pub shared_otherwise: InstantsOfContacts,
    /// Instants at which the friction of contacts admitted no motion with their slips or with their restitution.
    pub jammed: InstantsOfContacts,
    /// Steps of time stepping in which only contacts that were closed in their middle gave impulses, and the other ones that touched.
    pub left_out: InstantsOfContacts,
}

/// Instants at which something was so of some contacts: their number, the first, and the contacts there.
#[derive(Clone, Debug, Default)]
pub(crate) struct InstantsOfContacts {
    pub count: usize,
    pub first: Option<(f64, Vec<usize>)>,
}

impl InstantsOfContacts {
    /// Notes that it is so of these contacts at an instant, if there are any.
    pub fn note(&mut self, t: f64, contacts: &[usize]) {
        if contacts.is_empty() {
            return;
        }
        self.count += 1;
        (self.first).get_or_insert_with(|| (t, in_order(contacts)));
    }
}

impl<C, V> Default for UnilateralRecord<C, V> {
    fn default() -> Self {
        UnilateralRecord {
            phases: Vec::new(),
            events: Vec::new(),
            tallies: Vec::new(),
            last_event: None,
            last_watched: f64::NEG_INFINITY,
            losses: Vec::new(),
            energy_entries: Vec::new(),
            last: Vec::new(),
            of_step: StepRecord::default(),
            energy_gains: 0,
            worst: None,
            shared_otherwise: InstantsOfContacts::default(),
            jammed: InstantsOfContacts::default(),
            left_out: InstantsOfContacts::default(),
        }
    }
}

impl<C, V> UnilateralRecord<C, V> {
    /// Forgets the last phase, other than the first, before another one begins, unless it `keeps_all` or something needs it: a sample or event since it began, of
    /// which the last was at `last_needed`.
    pub fn forget_phase(&mut self, keeps_all: bool, last_needed: f64) -> Option<Phase<V>> {
        if keeps_all || self.phases.len() < 2 {
            return None;
        }
        let forgotten = self.phases.pop_if(|last| last_needed < last.since)?;
        let known = self.phases.last_mut()?;
        known.until = known.until.min(forgotten.since);
        Some(forgotten)
    }

    /// The warnings to be reported.
    pub fn warnings<S: System>(&self, system: &S) -> impl Iterator<Item = Warning> {
        let name = |contact: usize| {
            let mut contacts = system.unilateral_contacts();
            String::from(contacts.nth(contact).map_or("?", |of| of.name))
        };
        let gains = self.worst.map(|(contact, t, gain)| Warning::ImpactGains {
            contact: name(contact),
            t,
            gain,
            impacts: self.energy_gains,
        });
        let named = |of: &InstantsOfContacts| {
            let (t, contacts) = of.first.as_ref()?;
            let contacts: Vec<String> = contacts.iter().map(|contact| name(*contact)).collect();
            Some((*t, contacts, of.count))
        };
        let shared = named(&self.shared_otherwise);
        let shared = shared.map(|(t, contacts, instants)| Warning::LoadShared {
            t,
            contacts,
            instants,
        });
        let jammed = named(&self.jammed);
        let jammed = jammed.map(|(t, contacts, instants)| Warning::ContactsJammed {
            t,
            contacts,
            instants,
        });
        let left_out = named(&self.left_out);
        let left_out =
            left_out.map(|(t, contacts, steps)| Warning::ContactsLeftOut { t, contacts, steps });
        (gains.into_iter().chain(shared).chain(jammed)).chain(left_out)
    }
}
