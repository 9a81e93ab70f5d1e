//! The state of contacts between two events: which are closed, which slip, and which stick.

mod compliant;
mod forces_of_step;
mod held;
mod margins;
mod powers;
mod reaction;
mod settled;
mod shared;

use core::cmp::Ordering;
use std::string::String;
use std::sync::Arc;
use std::vec;
use std::vec::Vec;

use super::kinematics::{ContactKinematics, ROUNDING, contacts_with_face, least_sizes};
use super::nearby::{Nearby, StateBox};
use super::{ContactTrouble, ImpactLaw, ImpactOrder, Mode, Painleve};
use crate::at::At;
use crate::shared_workspace::SharedWorkspace;
use crate::{Pivot, Singular, StepError, System, Vector};
pub(crate) use compliant::Clearance;
use compliant::ComplianceState;
pub(crate) use held::Held;
use held::HeldMemory;
pub(crate) use margins::Margins;
pub(crate) use reaction::ContactMemory;
pub(super) use settled::Settled;

/// Forces and accelerations below this, relative to the terms that they are the sum of, are rounding.
const ROUNDING_OF_FORCES: f64 = 1e-11;

/// A slip that began from rest has the direction of the force that began it until it is this many times what it began with: from then on its own
/// differs from that by no more than a thousandth.
const BEGUN: f64 = 1e3;

pub(crate) use crate::contact_law::Margin;

/// What a run knows of its unilateral contacts.
#[derive(Debug)]
pub(crate) struct UnilateralState {
    modes: Vec<Mode>,
    has_friction: Vec<bool>,
    /// How many contacts are guides, the last ones; and to which side each contact presses when it slides, 1 or −1. Only guides press to both. Before the first step of
    /// a run in time stepping, their sides are 0.
    guides: usize,
    sides: Vec<f64>,
    /// The contacts in the order in which problems are written: see [`order_of_problems`].
    order_of_problems: Arc<[usize]>,
    /// How large each coordinate is at least as part of a gap.
    least_sizes: Arc<[f64]>,
    /// The contacts with faces of polygons.
    with_face: Arc<[usize]>,
    /// Which contacts may close around the present state, if that is known.
    nearby: Option<Nearby>,
    /// What was evaluated last.
    latest: SharedWorkspace<LatestKinematics>,
    /// For the rolling resistance and the second tangent of a contact, that contact: they have its gap and its normal force, and are open if
    /// it is.
    carrier: Vec<Option<usize>>,
    /// Which of these are second tangents. What a contact does along one tangent it does along both.
    across: Vec<bool>,
    /// For compliant contacts, their law and its history.
    compliance: Vec<Option<ComplianceState>>,
    pub(super) law: ImpactLaw,
    pub(super) order: ImpactOrder,
    pub(super) painleve: Vec<Painleve>,
    held: Vec<usize>,
    held_memory: SharedWorkspace<HeldMemory>,
    /// The greatest rate at which any gap closed so far.
    pub(super) speed: f64,
    /// The greatest slip with which anything began to slip so far.
    pub(super) slip: f64,
    /// The greatest rate at which anything rolled against its resistance so far, in rad/s.
    pub(super) turning: f64,
    /// How fast each contact opened after its last impact.
    pub(super) openings: Vec<f64>,
    /// The slip with which each contact last began to slip from rest, which is what rounding made of none.
    beginning_slips: Vec<f64>,
    /// Whether a direction is followed through rest, within a step: see [`Mode::SlidesAlong`].
    continues_through_rest: bool,
    /// When a contact was last taken not to slip although its friction was used up, and which: what is found again at this instant does slip.
    taken_back: Option<(f64, usize)>,
    /// In time stepping the mean forces of the last step along normal and tangent, in N.
    stepped: Option<Vec<[f64; 2]>>,
}

clone_into_memory!(UnilateralState {
    modes,
    has_friction,
    guides,
    sides,
    order_of_problems,
    least_sizes,
    with_face,
    nearby,
    latest,
    carrier,
    across,
    compliance,
    law,
    order,
    painleve,
    held,
    held_memory,
    speed,
    slip,
    turning,
    openings,
    beginning_slips,
    continues_through_rest,
    taken_back,
    stepped,
});

/// The kinematics that were evaluated last, and whether only of the near contacts, or whether they are no longer valid.
#[derive(Debug, Default)]
struct LatestKinematics {
    here: Option<Arc<ContactKinematics>>,
    of_near: Option<bool>,
    /// Memory for the box of a step.
    step: StateBox,
}

impl Clone for LatestKinematics {
    /// Nothing: states of contacts that a run keeps are seldom evaluated.
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// The contacts of a machine in the order of their names, each followed by its rolling resistance and its second tangent. A problem of several contacts may have several solutions, and which of
/// them is found depends on the order of its unknowns. In this order it does not depend on the order in which a spec lists the contacts.
fn order_of_problems<S: System>(system: &S) -> Arc<[usize]> {
    let contacts: Vec<_> = system.unilateral_contacts().collect();
    let is_carried = |k: usize| contacts[k].is_rolling_resistance || contacts[k].is_second_tangent;
    let mut own: Vec<usize> = (0..contacts.len()).filter(|k| !is_carried(*k)).collect();
    own.sort_by(|a, b| by_words_and_numbers(contacts[*a].name, contacts[*b].name));
    let with_carried = |k: usize| {
        let end = (k + 1..contacts.len()).find(|next| !is_carried(*next));
        k..end.unwrap_or(contacts.len())
    };
    own.into_iter().flat_map(with_carried).collect()
}

/// Compares names, with the numbers in them by their values: members of a family are in their order.
fn by_words_and_numbers(a: &str, b: &str) -> Ordering {
    let parts = |name: &'_ str| -> Vec<(usize, String)> {
        let is_digit = |c: char| c.is_ascii_digit();
        let mut parts = Vec::new();
        let mut rest = name;
        while let Some(first) = rest.chars().next() {
            let end = rest.find(|c| is_digit(c) != is_digit(first));
            let (part, next) = rest.split_at(end.unwrap_or(rest.len()));
            // A longer number without leading zeros is greater.
            let part = if is_digit(first) {
                part.trim_start_matches('0')
            } else {
                part
            };
            let length = if is_digit(first) { part.len() } else { 0 };
            parts.push((length, part.into()));
            rest = next;
        }
        parts
    };
    parts(a).cmp(&parts(b)).then_with(|| a.cmp(b))
}

impl UnilateralState {
    /// All contacts open.
    pub fn new<S: System>(system: &S) -> UnilateralState {
        let has_friction: Vec<bool> = system
            .unilateral_contacts()
            .map(|c| c.has_friction)
            .collect();
        let carrier = system.unilateral_contacts().enumerate();
        let carrier = carrier.map(|(k, c)| {
            if c.is_rolling_resistance || c.is_second_tangent {
                k.checked_sub(1)
            } else {
                None
            }
        });
        let carrier = carrier.collect();
        let across = system
            .unilateral_contacts()
            .map(|c| c.is_second_tangent)
            .collect();
        let mut bouncing = system.unilateral_contacts();
        let bouncing = bouncing.find(|c| c.compliance.is_none());
        let (law, order) = (bouncing.map(|c| c.law), bouncing.map(|c| c.order));
        let painleve = system.unilateral_contacts().map(|c| c.painleve).collect();
        let compliance = system.unilateral_contacts();
        let compliance = compliance
            .map(|c| c.compliance.map(ComplianceState::new))
            .collect();
        UnilateralState {
            modes: vec![Mode::Open; has_friction.len()],
            law: law.unwrap_or_default(),
            order: order.unwrap_or_default(),
            painleve,
            compliance,
            held: Vec::new(),
            held_memory: SharedWorkspace::default(),
            speed: 0.0,
            slip: 0.0,
            turning: 0.0,
            openings: vec![0.0; has_friction.len()],
            beginning_slips: vec![0.0; has_friction.len()],
            order_of_problems: order_of_problems(system),
            carrier,
            across,
            guides: system.guides().min(has_friction.len()),
            sides: vec![1.0; has_friction.len()],
            has_friction,
            least_sizes: least_sizes(system),
            with_face: contacts_with_face(system),
            nearby: None,
            latest: SharedWorkspace::default(),
            continues_through_rest: true,
            taken_back: None,
            stepped: None,
        }
    }

    /// Takes note of what contacts did in a step of time stepping: none is a constraint.
    pub(super) fn set_stepped(&mut self, modes: &[Mode], forces: &[[f64; 2]]) {
        self.modes.copy_from_slice(modes);
        let stepped = self.stepped.get_or_insert_default();
        stepped.clear();
        stepped.extend_from_slice(forces);
    }

    /// In time stepping the mean forces of the last step along normal and tangent, in N.
    pub(super) fn stepped(&self) -> Option<&[[f64; 2]]> {
        self.stepped.as_deref()
    }

    /// What is closed goes on in time stepping, where none of it is a constraint.
    pub fn begin_stepping(&mut self) {
        self.held = Vec::new();
        self.stepped = Some(vec![[0.0; 2]; self.modes.len()]);
    }

    /// Begins a run in time stepping with its guides, which are closed before the first step: they stick where nothing slips. To which side they press is not known yet, which is
    /// a side of 0.
    pub fn close_guides<S: System>(&mut self, system: &S, place: (f64, &S::Vector, &S::Vector)) {
        if !self.has_guides() {
            return;
        }
        let here = self.kinematics(system, place);
        for k in self.modes.len() - self.guides..self.modes.len() {
            let slip = here.rates[2 * k + 1];
            self.modes[k] = if !self.has_friction[k] {
                Mode::Slides(0.0)
            } else if slip.abs() <= here.rate_rounding(2 * k + 1) {
                Mode::Sticks
            } else {
                Mode::Slides(slip.signum())
            };
            self.sides[k] = 0.0;
        }
        self.begin_stepping();
    }

    /// What was closed in the last step of time stepping goes on as constraints, slips and sticks being known when contacts meet.
    pub fn end_stepping(&mut self) {
        self.stepped = None;
        for side in self.sides.iter_mut().filter(|side| **side == 0.0) {
            *side = 1.0;
        }
        let held = self.held_directions(&self.modes);
        self.held = held;
    }

    /// What is known of the contacts at a state: of the near ones, if these are known. It is evaluated once for calls that follow each other.
    pub(super) fn kinematics<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
    ) -> Arc<ContactKinematics> {
        let near = self.near_at(t, q.as_slice());
        let mut latest = self.latest.lock();
        if latest.of_near == Some(near.is_some())
            && let Some(here) = &latest.here
            && here.is_at(t, q.as_slice(), v.as_slice())
        {
            return here.clone();
        }
        latest.of_near = Some(near.is_some());
        // Its memory serves again if nothing else refers to it.
        let known = latest.here.take();
        let mut here = known.unwrap_or_else(|| Arc::new(self.memory_for_kinematics()));
        if Arc::get_mut(&mut here).is_none() {
            here = Arc::new(self.memory_for_kinematics());
        }
        if let Some(memory) = Arc::get_mut(&mut here) {
            memory.evaluate(system, (t, q, v), near);
        }
        latest.here = Some(here.clone());
        here
    }

    /// What is known of all contacts at a state, however far they are.
    pub(super) fn kinematics_of_all<S: System>(
        &self,
        system: &S,
        place: (f64, &S::Vector, &S::Vector),
    ) -> ContactKinematics {
        let mut here = self.memory_for_kinematics();
        here.evaluate(system, place, None);
        here
    }

    fn memory_for_kinematics(&self) -> ContactKinematics {
        ContactKinematics::new(&self.least_sizes, &self.with_face, self.modes.len())
    }

    /// The contacts that are near at a state, if these are known. A closed one is near.
    pub(super) fn near_at(&self, t: f64, q: &[f64]) -> Option<&[usize]> {
        let near = self.nearby.as_ref()?.at(t, q)?;
        let is_open = |k: usize| self.modes[k] == Mode::Open;
        let mut closed = (0..self.modes.len()).filter(|k| !is_open(*k));
        let all_are_near = closed.all(|k| near.binary_search(&k).is_ok());
        all_are_near.then_some(near)
    }

    /// Finds out which contacts are near in a step that stays in the box that `write_box` writes, and after it; and in what surrounds it by so many times its
    /// greatest width. A layer presses only where its gap is not positive, however much of it has been crushed: the surface of it recedes.
    pub fn keep_near<S: System>(
        &mut self,
        system: &S,
        surroundings: f64,
        write_box: impl FnOnce(&mut StateBox),
    ) {
        let Some(gap_arguments) = system.single_contacts() else {
            return;
        };
        if self.nearby.as_mut().is_some_and(Nearby::pauses) {
            return;
        }
        let mut latest = self.latest.lock();
        let step = &mut latest.step;
        write_box(step);
        if surroundings > 0.0 {
            step.widen(system, gap_arguments, surroundings);
        }
        self.nearby = Some(Nearby::of_step(
            (system, gap_arguments),
            self.nearby.take(),
            step,
        ));
        latest.of_near = None;
    }

    /// The greatest rate of a contact so far, at which gaps closed or something began to slip: rates within rounding of it are rest.
    pub(super) fn greatest_rate(&self) -> f64 {
        self.speed.max(self.slip)
    }

    /// Below which the rates of all contacts that touch are rest: the rounding of the greatest rate `so_far`, and of the terms of their
    /// present rates. A run that continues from a state of another one has only the latter to compare with, and what rests in it
    /// beside a moving contact has rates that are only as small as the rounding of that one.
    pub(super) fn rest(
        &self,
        here: &ContactKinematics,
        so_far: f64,
        touches: impl Fn(usize) -> bool,
    ) -> f64 {
        let terms = (0..self.modes.len())
            .filter(|k| touches(*k) && !self.is_turning(*k))
            .flat_map(|k| [2 * k, 2 * k + 1])
            .map(|direction| here.rate_terms(direction));
        ROUNDING * terms.fold(so_far, f64::max)
    }

    /// Up to which rate of rotation, in rad/s, contacts with rolling resistance are at rest.
    pub(super) fn rest_of_turning(
        &self,
        here: &ContactKinematics,
        touches: impl Fn(usize) -> bool,
    ) -> f64 {
        let terms = (0..self.modes.len())
            .filter(|k| touches(*k) && self.is_turning(*k))
            .map(|k| here.rate_terms(2 * k + 1));
        ROUNDING * terms.fold(self.turning, f64::max)
    }

    /// Whether it is the rolling of a contact, which turns and does not slip.
    pub(super) fn is_turning(&self, contact: usize) -> bool {
        self.carrier[contact].is_some() && !self.across[contact]
    }

    /// The fastest rate at which any gap closed so far, in m/s.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// The largest acceleration at which the present forces would close a gap if no contact were closed, in m/s²; 0 if they close none.
    pub fn pull<S: System>(&self, system: &S, at: At<'_, S>) -> f64 {
        let At { t, q, v, .. } = at;
        let Ok(free) = Self::free(system, at) else {
            return 0.0;
        };
        let here = self.kinematics_of_all(system, (t, q, v));
        let falls = (0..self.modes.len()).map(|k| -here.acceleration(2 * k, &free)[0]);
        falls.fold(0.0, f64::max)
    }

    /// Whether a contact is a guide.
    pub fn is_guide(&self, contact: usize) -> bool {
        contact + self.guides >= self.modes.len()
    }

    /// Whether any contact is a guide.
    pub fn has_guides(&self) -> bool {
        self.guides > 0
    }

    /// What a contact presses with, of its normal force: a guide presses to either side.
    pub(super) fn pressing(&self, contact: usize, normal: f64) -> f64 {
        if self.is_guide(contact) {
            normal.abs()
        } else {
            normal
        }
    }

    /// The side to which each contact presses.
    pub fn sides(&self) -> &[f64] {
        &self.sides
    }

    /// Takes the sides to which guides press from a step of time stepping.
    pub(super) fn set_sides(&mut self, sides: &[f64]) {
        self.sides.copy_from_slice(sides);
    }

    /// The guides that slide as they did, and press to other sides than they did.
    pub fn switched(&self, modes: &[Mode], sides: &[f64]) -> Vec<usize> {
        let slides = |k: usize| matches!(modes[k], Mode::Slides(_)) && modes[k] == self.modes[k];
        let is_switched = |k: &usize| slides(*k) && sides[*k] != self.sides[*k];
        (0..self.modes.len()).filter(is_switched).collect()
    }

    /// Takes the sides to which guides press from their normal reactions, unless these are rounding. A reaction that has just changed its sign is 0, and its guide
    /// presses to the other side from now on: one that has `switched`.
    pub fn take_sides(&mut self, settled: &Settled, switched: Option<usize>) {
        let first = self.modes.len() - self.guides;
        for (k, side) in self.sides.iter_mut().enumerate().skip(first) {
            let ([normal, _], size) = (settled.forces[k], settled.sizes_of_guides[k]);
            if switched == Some(k) {
                *side = -*side;
            } else if normal.abs() > ROUNDING_OF_FORCES * size {
                *side = normal.signum();
            }
        }
    }

    /// Whether impacts of touching contacts follow each other, instead of being one.
    pub fn takes_impacts_in_sequence(&self) -> bool {
        self.order == ImpactOrder::Sequence
    }

    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    /// The contacts in the order in which problems are written.
    pub fn in_order(&self) -> impl Iterator<Item = usize> + '_ {
        self.order_of_problems.iter().copied()
    }

    pub fn set_modes(&mut self, modes: Vec<Mode>) {
        self.held = self.held_directions(&modes);
        self.modes = modes;
    }

    /// Which directions are constraints now.
    pub(super) fn held(&self) -> &[usize] {
        &self.held
    }

    /// The direction that this one of the constraints is now, if there are so many.
    pub fn held_by(&self, constraint: usize) -> Option<usize> {
        self.held.get(constraint).copied()
    }

    /// For each direction that is a constraint now the greatest rate of a contact so far, and 0 for rates in other units: what resists rolling.
    pub fn rates_of_held(&self) -> impl Iterator<Item = f64> {
        let rate = self.greatest_rate();
        let of = move |d: &usize| if self.is_turning(d / 2) { 0.0 } else { rate };
        self.held.iter().map(of)
    }

    /// Whether nothing touches.
    pub fn is_free(&self) -> bool {
        self.modes.iter().all(|mode| *mode == Mode::Open)
    }

    /// Whether the accelerations are those without contacts.
    pub fn leaves_accelerations(&self) -> bool {
        self.is_free() && self.stepped.is_none()
    }

    /// The contact that carries this one, if this is the rolling resistance or the second tangent of another.
    pub fn carrier(&self, contact: usize) -> Option<usize> {
        self.carrier[contact]
    }

    /// The second tangent of a contact, if it has one.
    pub fn second(&self, contact: usize) -> Option<usize> {
        let next = contact + 1;
        (self.across.get(next) == Some(&true)).then_some(next)
    }

    /// The contact of which this is one of two tangents, or the contact itself.
    pub fn first(&self, contact: usize) -> usize {
        contact - usize::from(self.across[contact])
    }

    /// Whether it is one of two tangents of a contact.
    pub(super) fn has_two_tangents(&self, contact: usize) -> bool {
        self.across[contact] || self.second(contact).is_some()
    }

    /// The slip of a contact along both of its tangents, and the rounding of each.
    pub(super) fn slip(&self, here: &ContactKinematics, contact: usize) -> [[f64; 2]; 2] {
        let first = self.first(contact);
        let directions = [2 * first + 1, 2 * first + 3];
        [
            directions.map(|direction| here.rates[direction]),
            directions.map(|direction| here.rate_rounding(direction)),
        ]
    }

    /// The direction of a slip along both tangents; none where rounding could have made it.
    fn known_direction(&self, here: &ContactKinematics, contact: usize) -> Option<[f64; 2]> {
        let [slip, rounding] = self.slip(here, contact);
        let speed = slip[0].hypot(slip[1]);
        let beginning = self.beginning_slips[self.first(contact)];
        let rounding = rounding[0].hypot(rounding[1]);
        (speed > rounding.max(BEGUN * beginning)).then(|| slip.map(|slip| slip / speed))
    }

    /// The component along this tangent of the direction in which a contact slides. Where it has come through rest since the step
    /// began it is taken to slip backwards, so that its friction changes smoothly through there: that it has is found, and the
    /// step ends there.
    fn slip_direction(&self, here: &ContactKinematics, contact: usize) -> f64 {
        let Mode::SlidesAlong(heading) = self.modes[contact] else {
            return 0.0;
        };
        let part = usize::from(self.across[contact]);
        let Some(direction) = self.known_direction(here, contact) else {
            return heading[part];
        };
        let ahead = heading[0] * direction[0] + heading[1] * direction[1];
        if self.continues_through_rest && ahead < 0.0 {
            -direction[part]
        } else {
            direction[part]
        }
    }

    /// Takes note of the slips of contacts that begin to slip from rest.
    pub fn record_beginning_slips<S: System>(
        &mut self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        resting: &[bool],
    ) {
        let begins = |k: &usize| resting[*k] && matches!(self.modes[*k], Mode::SlidesAlong(_));
        let beginning: Vec<usize> = (0..self.modes.len()).filter(begins).collect();
        if beginning.is_empty() {
            return;
        }
        let here = self.kinematics(system, (t, q, v));
        for k in beginning {
            let [slip, _] = self.slip(&here, k);
            self.beginning_slips[k] = slip[0].hypot(slip[1]);
        }
    }

    /// The state for observation after the run, at any time until a contact changes: until then the direction of a slip may have changed.
    pub fn for_later_observation(&self) -> UnilateralState {
        UnilateralState {
            continues_through_rest: false,
            ..self.clone()
        }
    }

    /// The same, in memory that is there.
    pub fn clone_for_later_observation(&mut self, now: &UnilateralState) {
        self.clone_from(now);
        self.continues_through_rest = false;
    }

    /// Takes note of the directions in which contacts slide where a step begins, and of how fast.
    pub fn record_headings<S: System>(
        &mut self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        memory: &mut ContactMemory<S::Vector, S::Matrix>,
    ) {
        if !self
            .modes
            .iter()
            .any(|mode| matches!(mode, Mode::SlidesAlong(_)))
        {
            return;
        }
        let here = memory.kinematics();
        here.evaluate(system, (t, q, v), self.near_at(t, q.as_slice()));
        for k in 0..self.modes.len() {
            if let Mode::SlidesAlong(_) = self.modes[k]
                && let Some(direction) = self.known_direction(here, k)
            {
                self.modes[k] = Mode::SlidesAlong(direction);
                let [slip, _] = self.slip(here, k);
                // What starts from rest slips no faster than rounding at the instants at which contacts change.
                self.slip = self.slip.max(slip[0].hypot(slip[1]));
            }
        }
    }

    /// Records that a contact is taken not to slip although its friction is used up; whether it was so at this instant before.
    pub fn take_back(&mut self, t: f64, contact: usize) -> bool {
        self.taken_back.replace((t, contact)) == Some((t, contact))
    }

    /// The error where contacts that are asked together have no answer.
    pub(super) fn unsolved(&self, solved_contacts: &[usize], t: f64) -> StepError {
        let trouble = if solved_contacts.iter().any(|k| self.across[*k]) {
            ContactTrouble::Unsolved
        } else if solved_contacts.iter().any(|k| self.has_friction[*k]) {
            let own = |k: &&usize| self.carrier[**k].is_none();
            match solved_contacts.iter().filter(own).count() {
                0 | 1 => ContactTrouble::Paradox,
                _ => ContactTrouble::Jammed,
            }
        } else {
            ContactTrouble::NotHeld
        };
        StepError::Contact {
            contact: solved_contacts[0],
            trouble,
            t,
        }
    }

    /// An error of the machine with its closed contacts as constraints, with the contact to which the constraint belongs.
    pub fn explain<S: System>(&self, system: &S, error: StepError) -> StepError {
        let (StepError::Inconsistent { constraint, t, .. }
        | StepError::Singular {
            singular:
                Singular {
                    at: Pivot::Constraint(constraint),
                    ..
                },
            t,
        }) = error
        else {
            return error;
        };
        let held = constraint.checked_sub(system.constraints().len());
        match held.and_then(|place| self.held.get(place)) {
            None => error,
            Some(direction) => StepError::Contact {
                contact: self.first(direction / 2),
                trouble: ContactTrouble::NotHeld,
                t,
            },
        }
    }

    /// Gives rolling resistances and second tangents the value of the contact that carries them.
    pub fn copy_from_carriers<T: Copy>(&self, values: &mut [T]) {
        for (k, on) in self.carrier.iter().enumerate() {
            if let Some(on) = on {
                values[k] = values[*on];
            }
        }
    }

    /// Whether a contact has friction.
    pub(super) fn has_friction(&self, contact: usize) -> bool {
        self.has_friction[contact]
    }

    /// The machine with what is closed as constraints.
    pub fn machine<'a, S: System>(&'a self, system: &'a S) -> Held<'a, S> {
        Held::new(system, self)
    }
}
