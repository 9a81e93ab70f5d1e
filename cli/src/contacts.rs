//! Checks rolling contacts for feasibility. A rolling contact is a bilateral constraint: it pulls where its force
//! `N` is negative, and requires the friction coefficient `|T|/N`. Neither changes the computed motion, so the
//! command reports from which time on a real contact could not roll.

use std::sync::{Mutex, MutexGuard, PoisonError};

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named, Signals};
use lagrangian::{
    Crossing, Event, Machine, Observation, Pivot, Simulation, State, System, least_multipliers,
};
use lagrangian_spec::model::Model;
use lagrangian_symbolic::evaluate;
use serde_json::{Map, Value, json};

use crate::numbers::shortest;
use crate::recording::Run;

/// The rolling contacts of a machine, and what a run has shown of each.
pub struct Contacts {
    system: InterpretedSystem,
    contacts: Vec<Contact>,
    seen: Mutex<PreviousState>,
}

/// A rolling contact.
struct Contact {
    name: String,
    /// The indices of the multipliers of its normal force `N` and its tangential force `T`.
    multipliers: [usize; 2],
    /// The available coefficient of friction, if the spec gives one.
    friction: Option<f64>,
}

/// What is stored from one evaluated state to the next.
#[derive(Default)]
struct PreviousState {
    /// The last state, and the multipliers there.
    last: Option<(State<Named>, Vec<f64>)>,
    /// The record of each contact.
    tracks: Vec<Track>,
}

/// The friction that a contact needed.
#[derive(Clone, Default)]
struct Track {
    /// The time of the first evaluation, with `N` and `T`.
    start: Option<(f64, [f64; 2])>,
    /// The time of the last evaluation, with `N` and `T`.
    last: f64,
    forces: [f64; 2],
    /// Whether inputs vary, so that forces may jump.
    is_driven: bool,
    /// The last two required coefficients with their times.
    before: [Option<(f64, f64)>; 2],
    /// The greatest required coefficient with its time.
    greatest: Option<(f64, f64)>,
}

/// What a run has shown of a contact.
pub struct ContactSummary {
    /// Its name.
    pub name: String,
    /// The available coefficient of friction.
    pub friction: Option<f64>,
    /// The time from which it pulls, in s.
    pub pulls: Option<f64>,
    /// The time, in s, from which it needs more friction than is available while it presses.
    pub slips: Option<f64>,
    /// The greatest |T|/N while it presses, and its time in s. It is accurate to about three digits, because it is
    /// evaluated only a few times in each step.
    pub greatest: Option<(f64, f64)>,
}

/// Normal force, tangential force and their ratio for each rolling contact, by the names of constraints; the ratio
/// is null where the contact does not press.
pub fn forces(system: &InterpretedSystem, multipliers: &[f64]) -> Map<String, Value> {
    let pairs = rolling_contacts(system).into_iter().map(|(name, at)| {
        let [normal, tangential] = at.map(|k| multipliers[k]);
        let forces = json!({
            "normal": normal,
            "tangential": tangential,
            "friction_needed": demand([normal, tangential]),
        });
        (name, forces)
    });
    pairs.collect()
}

/// The pairs of constraints that are rolling contacts: both are named after the contact.
fn rolling_contacts(system: &InterpretedSystem) -> Vec<(String, [usize; 2])> {
    let names: Vec<&str> = system.constraints().map(|c| c.name).collect();
    let place = |name: String| names.iter().position(|other| **other == name);
    let pair = |name: &str| {
        let contact = name.strip_suffix(".gap")?;
        let places = [place(name.to_owned())?, place(format!("{contact}.slip"))?];
        Some((contact.to_owned(), places))
    };
    names.iter().filter_map(|name| pair(name)).collect()
}

/// The required coefficient |T|/N, if the contact presses.
fn demand([normal, tangential]: [f64; 2]) -> Option<f64> {
    (normal > 0.0).then(|| tangential.abs() / normal)
}

impl Contacts {
    /// The contacts of a machine with its parameters.
    pub fn new(model: &Model<'_>, machine: &InterpretedMachine) -> Contacts {
        let system = machine.prepare();
        let values = || model.parameters.iter().zip(machine.parameter_values());
        let friction = |name: &str| {
            let rolling = model
                .rolling()
                .into_iter()
                .find(|r| r.name.to_string() == name)?;
            let known = |symbol| {
                let parameter = values().find(|(p, _)| p.symbol.as_symbol() == Some(symbol));
                parameter.map_or(f64::NAN, |(_, value)| *value)
            };
            Some(evaluate(model.dag, &[rolling.friction?], known)[0])
        };
        let contacts = rolling_contacts(&system)
            .into_iter()
            .map(|(name, multipliers)| Contact {
                friction: friction(&name),
                name,
                multipliers,
            });
        let contacts: Vec<Contact> = contacts.collect();
        let seen = PreviousState {
            last: None,
            tracks: vec![Track::default(); contacts.len()],
        };
        Contacts {
            system,
            contacts,
            seen: Mutex::new(seen),
        }
    }

    /// Adds observers of the contacts to a simulation; without contacts it is unchanged.
    pub fn watch<'a>(
        &'a self,
        mut simulation: Simulation<'a, InterpretedMachine, Signals>,
        is_driven: bool,
    ) -> Simulation<'a, InterpretedMachine, Signals> {
        for (index, contact) in self.contacts.iter().enumerate() {
            if is_driven {
                simulation = self.watch_driven(simulation, index);
                continue;
            }
            let pulls = move |state: &State<Named>| self.contact_forces(index, state)[0];
            simulation = simulation.event(&pulling(&contact.name), Crossing::Falling, pulls);
            if let Some(friction) = contact.friction {
                let reserve = move |state: &State<Named>| {
                    let [normal, tangential] = self.contact_forces(index, state);
                    friction * normal - tangential.abs()
                };
                simulation = simulation.event(&slipping(&contact.name), Crossing::Falling, reserve);
            }
        }
        simulation
    }

    /// Observes a run with varying inputs, whose values the run provides.
    fn watch_driven<'a>(
        &'a self,
        simulation: Simulation<'a, InterpretedMachine, Signals>,
        index: usize,
    ) -> Simulation<'a, InterpretedMachine, Signals> {
        let contact = &self.contacts[index];
        self.previous_state().tracks[index].is_driven = true;
        let look = move |seen: &Observation<InterpretedMachine>| {
            let of = |k: usize| seen.multipliers.get(k).copied().unwrap_or(0.0);
            let mut all = self.previous_state();
            all.tracks[index].take(seen.t, contact.multipliers.map(of))
        };
        let pulls = move |seen: &Observation<InterpretedMachine>| look(seen)[0];
        let simulation = simulation.event_on(&pulling(&contact.name), Crossing::Falling, pulls);
        let Some(friction) = contact.friction else {
            return simulation;
        };
        let reserve = move |seen: &Observation<InterpretedMachine>| {
            let [normal, tangential] = look(seen);
            friction * normal - tangential.abs()
        };
        simulation.event_on(&slipping(&contact.name), Crossing::Falling, reserve)
    }

    fn previous_state(&self) -> MutexGuard<'_, PreviousState> {
        self.seen.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// `N` and `T` at a state. If they are undefined they count as 0: an observer must not end a run.
    fn contact_forces(&self, index: usize, state: &State<Named>) -> [f64; 2] {
        let mut seen = self.previous_state();
        if seen.last.as_ref().is_none_or(|(last, _)| last != state) {
            seen.last = Some((state.clone(), self.multipliers(state)));
        }
        let multipliers = seen.last.as_ref().map(|(_, multipliers)| multipliers);
        let of = |k: usize| multipliers.map_or(0.0, |multipliers| multipliers[k]);
        let forces = self.contacts[index].multipliers.map(of);
        seen.tracks[index].take(state.t, forces)
    }

    fn multipliers(&self, state: &State<Named>) -> Vec<f64> {
        let State { t, q, v } = state;
        let (t, q, v) = (*t, &q.values, &v.values);
        let u = self.system.default_inputs();
        let mut multipliers = vec![0.0; self.system.constraints().len()];
        let mut a = vec![0.0; q.len()];
        let known = self.system.multipliers(t, q, v, &u, &mut multipliers);
        if matches!(known, Err(singular) if matches!(singular.at, Pivot::Constraint(_))) {
            // If the multipliers are undefined, forces stay unknown.
            let _ = least_multipliers(&self.system, t, q, v, &u, &mut a, &mut multipliers);
        }
        multipliers
    }

    /// The results for a run that was observed.
    pub fn results(&self, run: &Run) -> Vec<ContactSummary> {
        let first = |name: &str| {
            let mut events = run.events().iter();
            events.find(|e| e.name == name).map(|e| e.state.t)
        };
        let seen = self.previous_state();
        let results = self.contacts.iter().zip(&seen.tracks);
        let results = results.map(|(contact, track)| {
            let at_start = |is_wrong: &dyn Fn([f64; 2]) -> bool| {
                let start = track.start.filter(|(_, forces)| is_wrong(*forces));
                start.map(|(t, _)| t)
            };
            let exceeds = |[n, t]: [f64; 2]| contact.friction.is_some_and(|mu| t.abs() > mu * n);
            ContactSummary {
                name: contact.name.clone(),
                friction: contact.friction,
                pulls: at_start(&|[n, _]| n < 0.0).or_else(|| first(&pulling(&contact.name))),
                slips: at_start(&exceeds).or_else(|| first(&slipping(&contact.name))),
                greatest: track.greatest,
            }
        });
        results.collect()
    }
}

/// The name of the event at which a contact begins to pull.
fn pulling(contact: &str) -> String {
    format!("{contact} pulls")
}

/// The name of the event at which a contact begins to need more friction than is available.
fn slipping(contact: &str) -> String {
    format!("{contact} would slip")
}

/// The events of a run that do not belong to rolling contacts.
pub fn other_events<'r>(
    events: &'r [Event<Named>],
    contacts: &'r [ContactSummary],
) -> impl Iterator<Item = &'r Event<Named>> {
    events.iter().filter(|event| {
        let mut names = contacts.iter().map(|contact| &contact.name);
        !names.any(|name| event.name == pulling(name) || event.name == slipping(name))
    })
}

impl Track {
    /// Records forces; undefined ones count as 0.
    fn take(&mut self, t: f64, forces: [f64; 2]) -> [f64; 2] {
        let forces = forces.map(|force| if force.is_finite() { force } else { 0.0 });
        self.add(t, forces);
        forces
    }

    /// Records forces, unless time goes backwards, as in the search for an event.
    fn add(&mut self, t: f64, forces: [f64; 2]) {
        let Some((begin, _)) = self.start else {
            self.start = Some((t, forces));
            (self.last, self.forces) = (t, forces);
            self.follow(t, demand(forces));
            return;
        };
        if self.is_driven && t == self.last && forces != self.forces {
            // The inputs have jumped: earlier forces must not be used for interpolation.
            self.before = [None; 2];
            self.forces = forces;
            self.follow(t, demand(forces));
        }
        if (t - begin).abs() > (self.last - begin).abs() {
            (self.last, self.forces) = (t, forces);
            self.follow(t, demand(forces));
        }
    }

    fn follow(&mut self, t: f64, demand: Option<f64>) {
        let now = demand.map(|demand| (t, demand));
        let [first, second] = self.before;
        if let (Some(a), Some(b), Some(c)) = (first, second, now)
            && b.1 >= a.1
            && b.1 >= c.1
        {
            self.raise_demand(vertex(a, b, c));
        }
        if let Some(now) = now {
            self.raise_demand(now);
        }
        self.before = [second, now];
    }

    fn raise_demand(&mut self, (t, demand): (f64, f64)) {
        if self.greatest.is_none_or(|(most, _)| demand > most) {
            self.greatest = Some((demand, t));
        }
    }
}

/// The vertex of the parabola through three points, of which the second is the highest.
fn vertex(a: (f64, f64), b: (f64, f64), c: (f64, f64)) -> (f64, f64) {
    let (left, right) = (a.0 - b.0, c.0 - b.0);
    let [slope_left, slope_right] = [(a.1 - b.1) / left, (c.1 - b.1) / right];
    // y = b + s x + k x² at both ends.
    let curvature = (slope_right - slope_left) / (right - left);
    let slope = slope_left - curvature * left;
    let x = -slope / (2.0 * curvature);
    if x.is_finite() {
        (b.0 + x, b.1 + x * slope / 2.0)
    } else {
        b
    }
}

impl ContactSummary {
    /// The violations of a contact, in words.
    pub fn warnings(&self) -> Vec<String> {
        let ContactSummary { name, .. } = self;
        let mut warnings = Vec::new();
        if let Some(t) = self.pulls {
            warnings.push(format!(
                "the contact `{name}` pulls from t = {} s on, where it would open",
                shortest(t)
            ));
        }
        if let (Some(t), Some(friction)) = (self.slips, self.friction) {
            warnings.push(format!(
                "the contact `{name}` needs more friction than its {} from t = {} s on, where it would slip",
                shortest(friction),
                shortest(t)
            ));
        }
        warnings
    }

    /// The line of a contact in the summary.
    pub fn line(&self) -> String {
        let needs = match (self.pulls, self.greatest) {
            (Some(t), _) => format!("pulls from t = {} s on", shortest(t)),
            (None, Some((demand, t))) => {
                format!("presses, and needs friction of {demand:.3} at t = {t:.4} s")
            }
            (None, None) => "carries no load".into(),
        };
        format!("{}: {needs}", self.name)
    }

    /// The summary as JSON. A contact that pulls needs more friction than any coefficient provides.
    pub fn json(&self) -> Value {
        let greatest = self.greatest.filter(|_| self.pulls.is_none());
        json!({
            "name": self.name,
            "friction": self.friction,
            "friction_needed": greatest.map(|(demand, _)| demand),
            "friction_needed_at": greatest.map(|(_, t)| t),
            "slips_from": self.slips,
            "pulls_from": self.pulls,
        })
    }
}
