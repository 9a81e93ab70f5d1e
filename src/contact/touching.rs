//! What is closed, slips and sticks: the state of contacts between two events.

mod compliant;
mod held;

use std::vec;
use std::vec::Vec;

use super::delassus::{Inertia, matrix};
use super::drives::{ActingContact, Drives};
use super::kinematics::{ContactKinematics, ROUNDING};
use super::lcp;
use super::problem::{ContactUnknowns, SATURATED};
use super::undetermined::{self, OpenForces};
use super::{ContactTrouble, ImpactLaw, ImpactOrder, Painleve};
use crate::at::At;
use crate::balance::ContactShare;
use crate::{Pivot, Singular, StepError, System, Vector};
use compliant::ComplianceState;
pub(crate) use held::Held;

/// Forces and accelerations below this, relative to the terms that they are the sum of, are rounding.
const ROUNDING_OF_FORCES: f64 = 1e-11;

/// A slip that began from rest has the direction of the force that began it until it is this many times what it began with: from then on its own
/// differs from that by no more than a thousandth.
const BEGUN: f64 = 1e3;

/// What a closed contact does, or that it is open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// It does not touch.
    Open,
    /// It touches and slips, forward or backward; 0 where it has no friction.
    Slides(f64),
    /// It touches and slips in space, in this direction, of length 1: that of the slip when the step began. A slip that passes through
    /// rest is continued as if it went backwards along it.
    SlidesAlong([f64; 2]),
    /// It touches and does not slip.
    Sticks,
}

impl Mode {
    /// Whether contacts do the same, in whatever direction they slip.
    pub fn is_like(self, other: Mode) -> bool {
        match (self, other) {
            (Mode::SlidesAlong(_), Mode::SlidesAlong(_)) => true,
            _ => self == other,
        }
    }

    /// The direction of the slip along both tangents; 0 where there is none.
    pub fn direction(self) -> [f64; 2] {
        match self {
            Mode::Slides(sign) => [sign, 0.0],
            Mode::SlidesAlong(heading) => heading,
            Mode::Open | Mode::Sticks => [0.0; 2],
        }
    }
}

pub(crate) use crate::friction::Margin;
use crate::friction::shares::{self, Limit, PARTS, Sharer};

/// What a run knows of its unilateral contacts.
#[derive(Clone, Debug)]
pub(crate) struct UnilateralState {
    modes: Vec<Mode>,
    has_friction: Vec<bool>,
    /// Of the rolling of a contact, and of its second tangent, that contact: it has its gap and its normal force, and is open where
    /// that is.
    carrier: Vec<Option<usize>>,
    /// Which of these are second tangents. What a contact does along one tangent it does along both.
    across: Vec<bool>,
    /// Of contacts that yield, their law and what it remembers.
    compliance: Vec<Option<ComplianceState>>,
    pub(super) law: ImpactLaw,
    pub(super) order: ImpactOrder,
    pub(super) painleve: Vec<Painleve>,
    held: Vec<usize>,
    /// The greatest rate at which any gap closed so far.
    pub(super) speed: f64,
    /// The greatest slip with which anything began to slip so far.
    pub(super) slip: f64,
    /// How fast each contact opened after its last impact.
    pub openings: Vec<f64>,
    /// The slip with which each contact last began to slip from rest, which is what rounding made of none.
    beginning_slips: Vec<f64>,
    /// Whether a direction is followed through rest, within a step: see [`Mode::SlidesAlong`].
    continues_through_rest: bool,
    /// In time stepping the mean forces of the last step along normal and tangent, in N.
    stepped: Option<Vec<[f64; 2]>>,
}

/// Accelerations, and the forces in contacts that go with them.
pub(crate) struct Reaction {
    pub a: Vec<f64>,
    /// Along normal and tangent, of every contact.
    pub forces: Vec<[f64; 2]>,
    /// What forces of a contact are made of, for their rounding.
    sizes: Vec<f64>,
    /// For each closed contact the size of the terms of its tangential acceleration without the forces of contacts, in m/s².
    slip_terms: Vec<f64>,
    /// Whether the forces are the only ones that go with the accelerations.
    pub is_only: bool,
    /// What they leave undetermined without a change of the accelerations, if anything.
    open_equations: Option<OpenEquations>,
    /// Which contacts press nothing because others that they depend on carry the whole load, (E79).
    unloaded: Vec<bool>,
}

/// Forces that the motion leaves undetermined.
struct OpenEquations {
    /// The closed contacts.
    closed: Vec<usize>,
    /// The contact of each unknown force, as its position in `closed`, and the direction: normal (0) or tangent (1).
    unknowns: Vec<(usize, usize)>,
    /// The change of all unknowns for a unit of each undetermined one, none of which changes the accelerations.
    of_unit: Vec<Vec<f64>>,
}

/// The distribution of forces among contacts at which the least margin is greatest.
struct SharedLoad {
    /// The margin of each contact that shares forces, and nothing for the others. Both tangents of a contact have that of the first.
    margins: Vec<Option<ShareOfLoad>>,
    /// Along normal and tangent, of every contact.
    forces: Vec<[f64; 2]>,
}

/// The margin of a contact that shares forces with others.
struct ShareOfLoad {
    margin: Margin,
    /// Whether its normal force is undetermined.
    shares_normal: bool,
    /// Whether the margin is that of its friction as well.
    shares_friction: bool,
    /// Whether and how this contact limits the margin.
    limit: Option<Limit>,
}

impl Reaction {
    /// Of forces that are known.
    pub(super) fn from_known_forces(a: Vec<f64>, forces: Vec<[f64; 2]>) -> Self {
        Self {
            a,
            sizes: vec![0.0; forces.len()],
            slip_terms: vec![0.0; forces.len()],
            unloaded: vec![false; forces.len()],
            forces,
            is_only: true,
            open_equations: None,
        }
    }
}

/// By how much the states of closed contacts hold.
pub(crate) struct Margins {
    /// For each contact: that it presses, that it slips as it does or sticks, and that a layer is loaded or unloaded
    /// as it is; that a corner of a polygon is on its face.
    pub each: Vec<[Margin; 4]>,
    /// Which contacts have forces that the equations of motion leave undetermined.
    pub shares: Vec<bool>,
}

/// What contacts do and take, in W.
#[derive(Clone, Debug, Default)]
pub(crate) struct Powers {
    /// The work that what moves by itself does through them.
    pub work: f64,
    /// What friction takes, and what yields.
    pub lost: f64,
    /// The part of each contact; none where none has one.
    pub of_each: Vec<ContactShare>,
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
            speed: 0.0,
            slip: 0.0,
            openings: vec![0.0; has_friction.len()],
            beginning_slips: vec![0.0; has_friction.len()],
            carrier,
            across,
            has_friction,
            continues_through_rest: true,
            stepped: None,
        }
    }

    /// Takes note of what contacts did in a step of time stepping: none is a constraint.
    pub(super) fn set_stepped(&mut self, modes: Vec<Mode>, forces: Vec<[f64; 2]>) {
        self.modes = modes;
        self.stepped = Some(forces);
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

    /// What was closed in the last step of time stepping goes on as constraints, slips and sticks being known when contacts meet.
    pub fn end_stepping(&mut self) {
        self.stepped = None;
        let held = self.held_directions(&self.modes);
        self.held = held;
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
        // The rate of what resists rolling is in other units.
        let is_counted = |k: &usize| touches(*k) && (self.carrier[*k].is_none() || self.across[*k]);
        let terms = (0..self.modes.len())
            .filter(is_counted)
            .flat_map(|k| [2 * k, 2 * k + 1])
            .map(|direction| here.rate_terms(direction));
        ROUNDING * terms.fold(so_far, f64::max)
    }

    /// The fastest rate at which any gap closed so far, in m/s.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// By how much the forces of now speed up the closing of gaps at the most, were nothing closed, in m/s²; 0 where they close none.
    pub fn pull<S: System>(&self, system: &S, at: At<'_, S>) -> f64 {
        let At { t, q, v, .. } = at;
        let Ok(free) = Self::free(system, at) else {
            return 0.0;
        };
        let here = ContactKinematics::of(system, t, q, v);
        let falls = (0..self.modes.len()).map(|k| -here.acceleration(2 * k, &free)[0]);
        falls.fold(0.0, f64::max)
    }

    pub fn modes(&self) -> &[Mode] {
        &self.modes
    }

    pub fn set_modes(&mut self, modes: Vec<Mode>) {
        self.held = self.held_directions(&modes);
        self.modes = modes;
    }

    /// Which directions are constraints now.
    pub(super) fn held(&self) -> &[usize] {
        &self.held
    }

    /// For each direction that is a constraint now the greatest rate of a contact so far, and 0 for rates in other units: what resists rolling.
    pub fn rates_of_held(&self) -> impl Iterator<Item = f64> {
        let is_length = |k: usize| self.carrier[k].is_none() || self.across[k];
        let rate = self.greatest_rate();
        let of = move |d: &usize| if is_length(d / 2) { rate } else { 0.0 };
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

    /// The contact on which another leans, if that is the rolling of one.
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
        let here = ContactKinematics::of(system, t, q, v);
        for k in beginning {
            let [slip, _] = self.slip(&here, k);
            self.beginning_slips[k] = slip[0].hypot(slip[1]);
        }
    }

    /// As it is looked at after the run, at any time until something changes: by then a slip may have turned anywhere.
    pub fn for_later_observation(&self) -> UnilateralState {
        UnilateralState {
            continues_through_rest: false,
            ..self.clone()
        }
    }

    /// Takes note of the directions in which contacts slide where a step begins, and of how fast.
    pub fn record_headings<S: System>(&mut self, system: &S, t: f64, q: &S::Vector, v: &S::Vector) {
        if !self
            .modes
            .iter()
            .any(|mode| matches!(mode, Mode::SlidesAlong(_)))
        {
            return;
        }
        let here = ContactKinematics::of(system, t, q, v);
        for k in 0..self.modes.len() {
            if let Mode::SlidesAlong(_) = self.modes[k]
                && let Some(direction) = self.known_direction(&here, k)
            {
                self.modes[k] = Mode::SlidesAlong(direction);
                let [slip, _] = self.slip(&here, k);
                // What starts from rest slips no faster than rounding at the instants at which contacts change.
                self.slip = self.slip.max(slip[0].hypot(slip[1]));
            }
        }
    }

    /// The error where contacts that are asked together have no answer.
    pub(super) fn unsolved(&self, solved_contacts: &[usize], t: f64) -> StepError {
        let trouble = if solved_contacts.iter().any(|k| self.across[*k]) {
            ContactTrouble::Unsolved
        } else if solved_contacts.iter().any(|k| self.has_friction[*k]) {
            ContactTrouble::Paradox
        } else {
            ContactTrouble::NotHeld
        };
        StepError::Contact {
            contact: solved_contacts[0],
            trouble,
            t,
        }
    }

    /// An error of the machine with what is closed as constraints: of such a one it is said which contact it is.
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

    /// The direction in which a contact that sticks would slip without its friction, if that is more than rounding.
    pub fn pull_along<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        contact: usize,
    ) -> Result<Option<[f64; 2]>, StepError> {
        let reaction = self.reaction(system, at)?;
        let along = |contact: usize| reaction.forces[contact][1];
        let pull = [-along(contact), -self.second(contact).map_or(0.0, along)];
        let size = pull[0].hypot(pull[1]);
        let is_more = size > ROUNDING_OF_FORCES * reaction.sizes[contact];
        Ok(is_more.then(|| pull.map(|part| part / size)))
    }

    /// Says of what leans what is said of the contact that it leans on.
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

    /// What the machine would do without any contact.
    pub(super) fn free<S: System>(
        system: &S,
        At { t, q, v, u }: At<'_, S>,
    ) -> Result<Vec<f64>, StepError> {
        let mut a = q.zeros_like();
        Self::free_into(system, At { t, q, v, u }, &mut a)?;
        Ok(a.as_slice().to_vec())
    }

    /// [`free`](Self::free), into a vector.
    fn free_into<S: System>(
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        a: &mut S::Vector,
    ) -> Result<(), StepError> {
        match system.accelerations(t, q, v, u, a) {
            Ok(()) => Ok(()),
            Err(singular) if system.constraints().len() == 0 => {
                Err(StepError::Singular { singular, t })
            }
            Err(_) => {
                let mut multipliers = vec![0.0; system.constraints().len()];
                crate::least_multipliers(system, t, q, v, u, a, &mut multipliers)
            }
        }
    }

    /// Accelerations and forces while everything stays as it is.
    pub fn reaction<S: System>(&self, system: &S, at: At<'_, S>) -> Result<Reaction, StepError> {
        let At { t, q, v, .. } = at;
        let is_asked = !self.is_free() && self.stepped.is_none();
        let here = is_asked.then(|| ContactKinematics::of(system, t, q, v));
        self.reaction_here(system, at, here.as_ref())
    }

    /// The same, with what is known of the contacts at this state: nothing is needed of them where all are open, or in time stepping.
    fn reaction_here<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        here: Option<&ContactKinematics>,
    ) -> Result<Reaction, StepError> {
        let At { t, q, .. } = at;
        let a = Self::free(system, at)?;
        if let Some(forces) = &self.stepped {
            return Self::reaction_stepped(system, at, a, forces);
        }
        let mut reaction = Reaction {
            forces: vec![[0.0; 2]; self.modes.len()],
            sizes: vec![0.0; self.modes.len()],
            slip_terms: vec![0.0; self.modes.len()],
            is_only: true,
            open_equations: None,
            unloaded: vec![false; self.modes.len()],
            a,
        };
        let Some(here) = here.filter(|_| !self.is_free()) else {
            return Ok(reaction);
        };
        let singular = |singular: Singular| StepError::Singular { singular, t };
        let inertia = Inertia::new(system, t, q).map_err(singular)?;
        let closed: Vec<usize> = (0..self.modes.len())
            .filter(|k| self.modes[*k] != Mode::Open)
            .collect();
        let images: Vec<Vec<f64>> = (closed.iter())
            .flat_map(|k| [2 * k, 2 * k + 1])
            .map(|direction| inertia.image(here.row(direction)))
            .collect();
        let g = matrix(&images);
        let width = images.len();
        for &k in &closed {
            [_, reaction.slip_terms[k]] = here.acceleration(2 * k + 1, &reaction.a);
        }
        // Of what slides the tangential force is a share of the normal one; what sticks has two unknowns.
        let share = |k: usize| self.share(here, k);
        let mut unknowns: Vec<(usize, usize)> = Vec::new();
        for (place, &k) in closed.iter().enumerate() {
            if let Some(pressed) = self.compliant_force(here, k) {
                let normal = pressed.force;
                reaction.forces[k] = [normal, share(k) * normal];
                reaction.sizes[k] = normal.abs();
            } else if let Some(on) = self.carrier[k] {
                if self.is_compliant(on) {
                    reaction.forces[k] = [0.0, share(k) * reaction.forces[on][0]];
                    reaction.sizes[k] = reaction.sizes[on];
                }
            } else {
                unknowns.push((place, 0));
            }
            if self.modes[k] == Mode::Sticks && self.has_friction[k] {
                unknowns.push((place, 1));
            }
        }
        if closed.iter().any(|k| self.is_compliant(*k)) {
            let known = closed.iter().flat_map(|k| reaction.forces[*k]);
            let response = inertia.response(&images, known);
            for (a, by) in reaction.a.iter_mut().zip(response) {
                *a += by;
            }
        }
        // Of what leans on a contact, where it stands among the closed ones and its share of the normal force.
        let carried = |place: usize| {
            let next = closed.get(place + 1).copied();
            let leaning = next.filter(|next| self.carrier[*next] == Some(closed[place]));
            leaning.map(|k| (place + 1, share(k)))
        };
        for (place, &k) in closed.iter().enumerate() {
            if self.is_compliant(k) || self.carrier[k].is_some() {
                continue;
            }
            let own = g[2 * place * width + 2 * place];
            let by_rolling = carried(place).map_or(0.0, |(other, share)| {
                share * g[2 * place * width + 2 * other + 1]
            });
            let coupled = share(k) * g[2 * place * width + 2 * place + 1] + by_rolling;
            if own + coupled <= ROUNDING_OF_FORCES * own && coupled < 0.0 {
                let trouble = ContactTrouble::Paradox;
                return Err(StepError::Contact {
                    contact: k,
                    trouble,
                    t,
                });
            }
        }
        let size = unknowns.len();
        let (mut left, mut right) = (vec![0.0; size * size], vec![0.0; size]);
        for (i, &(place, part)) in unknowns.iter().enumerate() {
            let row = 2 * place + part;
            for (j, &(other, other_part)) in unknowns.iter().enumerate() {
                let column = |part: usize| g[row * width + 2 * other + part];
                left[i * size + j] = match other_part {
                    0 => {
                        let own = column(0) + share(closed[other]) * column(1);
                        carried(other).map_or(own, |(leaning, share)| {
                            own + share * g[row * width + 2 * leaning + 1]
                        })
                    }
                    _ => column(1),
                };
            }
            let [value, terms] = here.acceleration(2 * closed[place] + part, &reaction.a);
            right[i] = -value;
            let own = g[row * width + row];
            if own > 0.0 {
                let of_rates = here.acceleration_rounding(closed[place], self.greatest_rate());
                let terms = terms + of_rates / ROUNDING_OF_FORCES;
                let known = &mut reaction.sizes[closed[place]];
                *known = known.max(terms / own);
            }
        }
        let (mut values, order) = lcp::eliminate(&mut left, &mut right);
        reaction.is_only = order.rank == size;
        let along_directions = |values: &[f64]| {
            let mut found = vec![[0.0; 2]; closed.len()];
            for (&(place, part), value) in unknowns.iter().zip(values) {
                found[place][part] += value;
                if part == 0 {
                    found[place][1] += share(closed[place]) * value;
                    if let Some((leaning, share)) = carried(place) {
                        found[leaning][1] += share * value;
                    }
                }
            }
            found
        };
        let mut of_unit = Vec::new();
        if !reaction.is_only {
            of_unit = order.null_space(&left);
            of_unit
                .iter_mut()
                .for_each(|own| undetermined::without_rounding(own));
            let directions = unknowns.iter().map(|(place, part)| 2 * place + part);
            let directions: Vec<usize> = directions.collect();
            let rows = directions.iter().map(|row| &g[row * width..][..width]);
            let among: Vec<f64> = rows
                .flat_map(|row| directions.iter().map(|column| row[*column]))
                .collect();
            let is_normal: Vec<bool> = unknowns.iter().map(|(_, part)| *part == 0).collect();
            let open_forces = OpenForces {
                by: &of_unit,
                g: &among,
                is_normal: &is_normal,
            };
            let unloaded = open_forces.distribute(&mut values);
            for ((place, _), unloaded) in unknowns.iter().zip(unloaded) {
                reaction.unloaded[closed[*place]] |= unloaded;
            }
            let effects: Vec<(Vec<f64>, f64)> = (of_unit.iter())
                .map(|own| undetermined::effect(&images, along_directions(own).as_flattened()))
                .collect();
            of_unit = undetermined::without_effect(of_unit, &effects);
        }
        let found = along_directions(&values);
        for (&k, found) in closed.iter().zip(&found) {
            let [normal, tangential] = &mut reaction.forces[k];
            *normal += found[0];
            *tangential += found[1];
        }
        let response = inertia.response(&images, found.into_iter().flatten());
        for (a, by) in reaction.a.iter_mut().zip(response) {
            *a += by;
        }
        if !of_unit.is_empty() {
            reaction.open_equations = Some(OpenEquations {
                closed,
                unknowns,
                of_unit,
            });
        }
        Ok(reaction)
    }

    /// The ratio of the tangential to the normal force of a contact that slips; 0 for others.
    fn share(&self, here: &ContactKinematics, contact: usize) -> f64 {
        match self.modes[contact] {
            Mode::Slides(sign) => -sign * here.friction(contact)[0],
            Mode::SlidesAlong(_) => -self.slip_direction(here, contact) * here.friction(contact)[0],
            Mode::Open | Mode::Sticks => 0.0,
        }
    }

    /// Which contacts have forces that the equations of motion leave undetermined.
    fn sharing(&self, reaction: &Reaction) -> Vec<bool> {
        let mut shares = vec![false; self.modes.len()];
        let Some(equations) = &reaction.open_equations else {
            return shares;
        };
        let of_unit = &equations.of_unit;
        for (unknown, (place, _)) in equations.unknowns.iter().enumerate() {
            shares[equations.closed[*place]] |= of_unit.iter().any(|own| own[unknown] != 0.0);
        }
        // What leans on a contact is limited by its normal force, and both tangents of a contact by one.
        for (k, on) in self.carrier.iter().enumerate() {
            if let Some(on) = *on {
                shares[k] |= shares[on];
                shares[on] |= shares[k] && self.across[k];
            }
        }
        shares
    }

    /// The distribution of undetermined forces at which the least margin of the contacts is greatest, (E78); nothing if none is undetermined.
    fn shared_load(
        &self,
        here: &ContactKinematics,
        reaction: &Reaction,
        t: f64,
    ) -> Result<Option<SharedLoad>, StepError> {
        let Some(equations) = &reaction.open_equations else {
            return Ok(None);
        };
        let closed = &equations.closed;
        let free = equations.of_unit.len();
        let (sharers, by) = self.sharers(here, reaction, equations);
        let mut groups = vec![0; free];
        shares::group(&by, &mut groups);
        let mut load = SharedLoad {
            margins: self.modes.iter().map(|_| None).collect(),
            forces: reaction.forces.clone(),
        };
        let mut numbers = vec![0.0; shares::numbers_length(closed.len(), free)];
        let mut places = vec![0; shares::places_length(closed.len(), free)];
        let (mut undetermined, mut limits) = (vec![0.0; free], vec![None; closed.len()]);
        for group in (0..free).filter(|group| groups[*group] == *group) {
            let by_place = |place: usize| &by[PARTS * free * place..][..PARTS * free];
            let of_group = |place: &usize| shares::is_in(by_place(*place), &groups, group);
            let members = || (0..closed.len()).filter(of_group);
            undetermined.fill(0.0);
            let shared = shares::share(
                &sharers,
                (&by, &groups, group),
                (&mut numbers, &mut places),
                (&mut undetermined, &mut limits),
            );
            let Some(shared) = shared else {
                return Err(StepError::Contact {
                    contact: self.first(members().next().map_or(closed[0], |place| closed[place])),
                    trouble: ContactTrouble::Unsolved,
                    t,
                });
            };
            let size = |place: usize| {
                let own = reaction.sizes[closed[place]];
                match sharers[place].static_friction {
                    Some(friction) if friction > 0.0 => own * (1.0 + 1.0 / friction),
                    _ => own,
                }
            };
            let size = members().map(size).fold(0.0, f64::max);
            let margin = Margin {
                value: shared.value,
                rounding: (ROUNDING_OF_FORCES * size).max(shared.residual),
            };
            for place in members() {
                let k = closed[place];
                let added = |part: usize| {
                    let own = &by_place(place)[part * free..][..free];
                    let terms = own.iter().zip(&undetermined);
                    terms.map(|(x, y)| x * y).sum::<f64>()
                };
                let normal = added(0);
                if self.carrier[k].is_none() {
                    load.forces[k][0] += normal;
                }
                load.forces[k][1] += added(1) + self.share(here, k) * normal;
                if let Some(second) = self.second(k) {
                    load.forces[second][1] += added(2) + self.share(here, second) * normal;
                }
                let depends = |part: usize| {
                    by_place(place)[part * free..][..free]
                        .iter()
                        .any(|x| *x != 0.0)
                };
                load.margins[k] = Some(ShareOfLoad {
                    margin,
                    shares_normal: depends(0),
                    // A friction force of a contact without friction that depends on nothing shared has a margin of its own.
                    shares_friction: here.friction(k)[1] > 0.0 || depends(1) || depends(2),
                    limit: limits[place],
                });
            }
        }
        Ok(Some(load))
    }

    /// The closed contacts as those that may share forces, and what each undetermined force adds to theirs. The second tangent of a contact
    /// belongs to the first.
    fn sharers(
        &self,
        here: &ContactKinematics,
        reaction: &Reaction,
        OpenEquations {
            closed,
            unknowns,
            of_unit,
        }: &OpenEquations,
    ) -> (Vec<Sharer>, Vec<f64>) {
        let free = of_unit.len();
        let mut by = vec![0.0; PARTS * free * closed.len()];
        let mut sharers = vec![Sharer::default(); closed.len()];
        for (place, (&k, own)) in (closed.iter().zip(by.chunks_exact_mut(PARTS * free))).enumerate()
        {
            if self.across[k] {
                continue;
            }
            // A contact with a carrier has the normal force of its carrier, which precedes it.
            let pressing = place - usize::from(self.carrier[k].is_some());
            let second = self.second(k);
            let across = second.map(|_| (place + 1, 1));
            let parts = [Some((pressing, 0)), Some((place, 1)), across];
            for (row, part) in own.chunks_exact_mut(free).zip(parts) {
                let unknown = part.and_then(|part| unknowns.iter().position(|u| *u == part));
                if let Some(unknown) = unknown {
                    for (x, of_unit) in row.iter_mut().zip(of_unit) {
                        *x = of_unit[unknown];
                    }
                }
            }
            let sticks = self.modes[k] == Mode::Sticks && self.has_friction[k];
            sharers[place] = Sharer {
                static_friction: sticks.then(|| here.friction(k)[1]),
                presses: self.carrier[k].is_none() && !self.is_compliant(k),
                normal: reaction.forces[closed[pressing]][0],
                tangential: [
                    reaction.forces[k][1],
                    second.map_or(0.0, |second| reaction.forces[second][1]),
                ],
            };
        }
        (sharers, by)
    }

    /// The states and forces with which all contacts at rest stay at rest, if some distribution of the forces that they share permits it. The
    /// solution of the complementarity problem is one distribution, and may release some of them.
    fn rests_together<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        here: &ContactKinematics,
        resting: &[bool],
        modes: &[Mode],
    ) -> Option<(Vec<Mode>, Vec<[f64; 2]>)> {
        let at_rest = |k: usize| {
            if self.has_friction[k] {
                Mode::Sticks
            } else {
                Mode::Slides(0.0)
            }
        };
        let held: Vec<Mode> = (modes.iter().enumerate())
            .map(|(k, mode)| if resting[k] { at_rest(k) } else { *mode })
            .collect();
        let mut touching = self.clone();
        touching.set_modes(held);
        let reaction = touching.reaction_here(system, at, Some(here)).ok()?;
        let load = touching.shared_load(here, &reaction, at.t).ok()??;
        let free = Self::free(system, at).ok()?;
        let is_still = |direction: &usize| {
            // Its round-off is that of the terms that the forces cancel.
            let [rate, terms] = here.acceleration(*direction, &reaction.a);
            let [_, of_free] = here.acceleration(*direction, &free);
            rate.abs() <= ROUNDING_OF_FORCES * (terms + of_free)
        };
        let holds = |k: usize| match &load.margins[k] {
            Some(ShareOfLoad { margin, .. }) => margin.value > margin.rounding,
            None if touching.modes[k] == Mode::Open || self.across[k] => true,
            None => {
                let normal = load.forces[self.carrier[k].unwrap_or(k)][0];
                let rounding = ROUNDING_OF_FORCES * reaction.sizes[k];
                let used = match (touching.modes[k], self.second(k)) {
                    (Mode::Sticks, None) => load.forces[k][1].abs(),
                    (Mode::Sticks, Some(second)) => load.forces[k][1].hypot(load.forces[second][1]),
                    _ => 0.0,
                };
                normal >= -rounding && used <= here.friction(k)[1] * normal + rounding
            }
        };
        let is_held = touching.held.iter().all(is_still) && (0..modes.len()).all(holds);
        is_held.then_some((touching.modes, load.forces))
    }

    /// The new states of contacts that share forces and no longer hold: of those that limit the shared margin.
    pub fn let_go<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
    ) -> Result<Vec<(usize, Mode)>, StepError> {
        let At { t, q, v, .. } = at;
        let here = ContactKinematics::of(system, t, q, v);
        let reaction = self.reaction_here(system, at, Some(&here))?;
        let shared = self.shared_load(&here, &reaction, t)?;
        let shared = shared.map_or_else(Vec::new, |load| load.margins);
        let limits = |(k, shared): (usize, Option<ShareOfLoad>)| {
            let ShareOfLoad { margin, limit, .. } = shared?;
            let mode = match limit? {
                Limit::Friction([along, across]) if self.second(k).is_some() => {
                    Mode::SlidesAlong([-along, -across])
                }
                Limit::Friction([along, _]) => Mode::Slides(-along),
                Limit::Pressing => Mode::Open,
            };
            (margin.value < 0.0).then_some((k, mode))
        };
        let mut known: Vec<(usize, Mode)> =
            shared.into_iter().enumerate().filter_map(limits).collect();
        // If some slip, contacts whose normal force has vanished move with them, or lift later.
        if known.iter().any(|(_, mode)| *mode != Mode::Open) {
            known.retain(|(_, mode)| *mode != Mode::Open);
        }
        Ok(known)
    }

    /// These states, but open for those of some contacts that press no more than rounding, and for what leans on these.
    pub fn without_unpressed<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        mut modes: Vec<Mode>,
        may_open: impl Fn(usize) -> bool,
    ) -> Result<Vec<Mode>, StepError> {
        let closing: Vec<usize> = (0..modes.len())
            .filter(|k| modes[*k] != Mode::Open && self.carrier[*k].is_none() && may_open(*k))
            .collect();
        if closing.is_empty() {
            return Ok(modes);
        }
        let mut touching = self.clone();
        touching.set_modes(modes.clone());
        let margins = touching.margins(system, at)?.each;
        for k in closing {
            let [presses, ..] = margins[k];
            if presses.value <= presses.rounding {
                modes[k] = Mode::Open;
            }
        }
        self.copy_openings_from_carriers(&mut modes);
        Ok(modes)
    }

    /// Opens what leans on an open contact.
    fn copy_openings_from_carriers(&self, modes: &mut [Mode]) {
        for (k, on) in self.carrier.iter().enumerate() {
            if on.is_some_and(|on| modes[on] == Mode::Open) {
                modes[k] = Mode::Open;
            }
        }
    }

    /// The multipliers of the constraints of the machine, with what the contacts press.
    ///
    /// They are those of `M a = f + Σ wᵀλ + Gᵀ λ_G`; of constraints that depend on each other, one of the sets that do.
    pub fn multipliers<S: System>(&self, system: &S, at: At<'_, S>) -> Result<Vec<f64>, StepError> {
        let At { t, q, v, u } = at;
        let m = system.constraints().len();
        if m == 0 {
            return Ok(Vec::new());
        }
        let n = q.as_slice().len();
        let reaction = self.reaction(system, at)?;
        let here = ContactKinematics::of(system, t, q, v);
        let (mut mass, mut forces) = (S::Matrix::zeros(n * n), q.zeros_like());
        let mut rows = vec![0.0; m * n];
        system.mass_matrix(t, q, &mut mass);
        system.forces(t, q, v, u, &mut forces);
        system.constraint_matrix(t, q, &mut rows);
        // What of `M a − f` the contacts do not carry.
        let mut open: Vec<f64> = (mass.as_slice().chunks_exact(n).zip(forces.as_slice()))
            .map(|(row, f)| row.iter().zip(&reaction.a).map(|(m, a)| m * a).sum::<f64>() - f)
            .collect();
        for (direction, force) in reaction.forces.iter().flatten().enumerate() {
            for (open, w) in open.iter_mut().zip(here.row(direction)) {
                *open -= w * force;
            }
        }
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let row = |k: usize| &rows[k * n..][..n];
        let mut left: Vec<f64> = (0..m * m).map(|k| dot(row(k / m), row(k % m))).collect();
        let mut right: Vec<f64> = (0..m).map(|k| dot(row(k), &open)).collect();
        Ok(lcp::solve(&mut left, &mut right).0)
    }

    /// Accelerations while everything stays as it is.
    pub fn accelerations<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        a: &mut S::Vector,
    ) -> Result<(), StepError> {
        if self.leaves_accelerations() {
            return Self::free_into(system, at, a);
        }
        let reaction = self.reaction(system, at)?;
        a.as_mut_slice().copy_from_slice(&reaction.a);
        Ok(())
    }

    /// What the contacts do and take.
    pub fn powers<S: System>(&self, system: &S, at: At<'_, S>) -> Powers {
        let At { t, q, v, .. } = at;
        // What impulses did is booked with each step.
        if self.is_free() || self.stepped.is_some() {
            return Powers::default();
        }
        let here = ContactKinematics::of(system, t, q, v);
        let Ok(reaction) = self.reaction_here(system, at, Some(&here)) else {
            return Powers {
                work: f64::NAN,
                lost: f64::NAN,
                of_each: Vec::new(),
            };
        };
        // What the forces do to the coordinates, what they take from both sides of the contacts, and what of that is
        // lost and not stored.
        let (mut on_coordinates, mut taken, mut lost) = (0.0, 0.0, 0.0);
        let mut of_each = vec![ContactShare::default(); self.modes.len()];
        let drives = Drives::new(system, (t, q));
        let inertia = drives.is_moving.then(|| Inertia::new(system, t, q));
        let inertia = inertia.and_then(Result::ok);
        let parts = reaction.forces.iter().zip(&mut of_each).enumerate();
        for (k, (force, own)) in parts.filter(|(k, _)| self.modes[*k] != Mode::Open) {
            let acting = ActingContact {
                contact: k,
                forces: *force,
                rates: [here.rates[2 * k], here.rates[2 * k + 1]],
            };
            own.work = drives.work(&here, &acting, v, || match &inertia {
                Some(inertia) => {
                    let images = [2 * k, 2 * k + 1].map(|d| inertia.image(here.row(d)));
                    inertia.response(&images, *force)
                }
                None => vec![f64::NAN; here.n],
            });
            for (part, force) in force.iter().enumerate() {
                let row = here.row(2 * k + part).iter().zip(v.as_slice());
                on_coordinates += force * row.map(|(w, v)| w * v).sum::<f64>();
            }
            if let Mode::Slides(_) | Mode::SlidesAlong(_) = self.modes[k] {
                own.friction = -force[1] * here.rates[2 * k + 1];
                taken += own.friction;
            }
            if let Some(pressed) = self.compliant_force(&here, k) {
                own.compliance_loss = pressed.lost;
                taken -= pressed.force * here.rates[2 * k];
            }
            lost += own.friction + own.compliance_loss;
        }
        // Where constraints move by themselves, the machine counts as work whatever changes its energy.
        let m = system.constraints().len();
        let mut moving = vec![0.0; m];
        if m > 0 {
            system.constraint_rates(t, q, &v.zeros_like(), &mut moving);
        }
        let work = if moving.iter().any(|rate| *rate != 0.0) {
            taken
        } else {
            on_coordinates + taken
        };
        Powers {
            work,
            lost,
            of_each,
        }
    }

    /// By how much the states of closed contacts hold: whether they press, and whether what slips does so still,
    /// or what sticks has friction left.
    pub fn margins<S: System>(&self, system: &S, at: At<'_, S>) -> Result<Margins, StepError> {
        let mut margins = vec![[Margin::ENDLESS; 4]; self.modes.len()];
        if self.is_free() {
            return Ok(Margins {
                each: margins,
                shares: vec![false; self.modes.len()],
            });
        }
        let At { t, q, v, .. } = at;
        let here = ContactKinematics::of(system, t, q, v);
        let reaction = self.reaction_here(system, at, Some(&here))?;
        // The same allowance as in `resting`: a contact that is at rest there does not stop once more here.
        let rest = self.rest(&here, self.greatest_rate(), |k| self.modes[k] != Mode::Open);
        for (k, margin) in margins.iter_mut().enumerate() {
            let tangential = reaction.forces[k][1];
            // Where a torque resists rolling, the normal force is that of the contact, which says itself whether it presses.
            let pressed = self.carrier[k].unwrap_or(k);
            let normal = reaction.forces[pressed][0];
            let size = if pressed == k {
                reaction.sizes[k]
            } else {
                reaction.sizes[k].max(here.friction(k)[1] * reaction.sizes[pressed])
            };
            let rounding = ROUNDING_OF_FORCES * size;
            let stays = match here.on_face(k) {
                None => Margin::ENDLESS,
                Some(face) => Margin {
                    value: -face.beyond,
                    rounding: here.gap_rounding(k),
                },
            };
            let [presses, loads] = if pressed == k {
                self.margins_of_compliance(&here, k).unwrap_or([
                    Margin {
                        value: normal,
                        rounding,
                    },
                    Margin::ENDLESS,
                ])
            } else {
                [Margin::ENDLESS; 2]
            };
            *margin = match self.modes[k] {
                Mode::Open => continue,
                // What a contact does along both tangents is asked of the first.
                _ if self.across[k] => continue,
                Mode::SlidesAlong(heading) => {
                    let [slip, _] = self.slip(&here, k);
                    let rounding = [k, k + 1].map(|tangent| {
                        here.rate_rounding_in_time(2 * tangent + 1, reaction.slip_terms[tangent])
                    });
                    let slips = Margin {
                        value: heading[0] * slip[0] + heading[1] * slip[1],
                        rounding: rounding[0].hypot(rounding[1]).max(rest),
                    };
                    [presses, slips, loads, stays]
                }
                Mode::Slides(0.0) => [presses, Margin::ENDLESS, loads, stays],
                Mode::Slides(sign) => {
                    let rounding = here.rate_rounding_in_time(2 * k + 1, reaction.slip_terms[k]);
                    let slips = Margin {
                        value: sign * here.rates[2 * k + 1],
                        rounding: rounding.max(rest),
                    };
                    [presses, slips, loads, stays]
                }
                Mode::Sticks if !self.has_friction[k] => [presses, Margin::ENDLESS, loads, stays],
                Mode::Sticks => {
                    let friction = here.friction(k)[1];
                    let used = match self.second(k) {
                        Some(second) => tangential.hypot(reaction.forces[second][1]),
                        None => tangential.abs(),
                    };
                    let reserve = Margin {
                        value: friction * normal - used,
                        rounding: rounding * (1.0 + friction),
                    };
                    [presses, reserve, loads, stays]
                }
            };
        }
        let shares = self.sharing(&reaction);
        // A contact whose load others carry lifts when these do: its force is 0 until then, and says nothing.
        for (k, margin) in margins.iter_mut().enumerate() {
            if reaction.unloaded[k] && !shares[k] {
                margin[0] = Margin::ENDLESS;
            }
        }
        let is_doubtful = |(k, margin): (usize, &[Margin; 4])| {
            let shared = match (shares[k], self.is_compliant(k)) {
                (false, _) => 0..0,
                (true, true) => 1..2,
                (true, false) => 0..2,
            };
            // A margin of 0 counts as well: the search for an instant would end where it is 0 with these forces.
            margin[shared].iter().any(|m| m.value <= m.rounding)
        };
        let shared_kinds = |k: usize| {
            let kinds = [!self.is_compliant(k), self.modes[k] == Mode::Sticks];
            kinds.map(|is_shared| is_shared && shares[k])
        };
        if reaction.is_only {
            // Each margin is that of the contact.
        } else if !margins.iter().enumerate().any(is_doubtful) {
            // Every contact holds with these forces. One whose share of them is 0 does not let go for that reason.
            for (k, margin) in margins.iter_mut().enumerate() {
                let kinds = margin.iter_mut().zip(shared_kinds(k));
                for (margin, _) in kinds.filter(|(_, shared)| *shared) {
                    if margin.value <= margin.rounding {
                        *margin = Margin::ENDLESS;
                    }
                }
            }
        } else if let Some(load) = self.shared_load(&here, &reaction, t)? {
            // Contacts hold as long as all of them can hold with some distribution of the forces.
            for (k, (margin, shared)) in margins.iter_mut().zip(load.margins).enumerate() {
                let Some(shared) = shared else {
                    continue;
                };
                if shared.shares_normal && self.carrier[k].is_none() && !self.is_compliant(k) {
                    margin[0] = shared.margin;
                }
                if self.modes[k] == Mode::Sticks && self.has_friction[k] && shared.shares_friction {
                    margin[1] = shared.margin;
                }
            }
        }
        Ok(Margins {
            each: margins,
            shares,
        })
    }

    /// What contacts that touch do next: which of `closed` stay so, and what those of them that are at rest do.
    ///
    /// A contact that slips has a direction, and friction along it. One at rest sticks if it can with its static
    /// friction; if not it slips, with its friction, in the direction in which it is pulled. Of some contacts it may
    /// be known what they do: where a force has just vanished, or friction is used up, nothing else says so.
    pub fn settled<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        closed: &[bool],
        resting: &[bool],
        known: &[(usize, Mode)],
    ) -> Result<Vec<Mode>, StepError> {
        let settled = self.settled_by_forces(system, at, closed, resting, known);
        settled.map(|(modes, _)| modes)
    }

    /// The same, with the forces by which they do it, along normal and tangent: where a load may be shared in several ways, in one that
    /// every contact allows.
    pub fn settled_by_forces<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        closed: &[bool],
        resting: &[bool],
        known_modes: &[(usize, Mode)],
    ) -> Result<(Vec<Mode>, Vec<[f64; 2]>), StepError> {
        let At { t, q, v, .. } = at;
        let mut modes = vec![Mode::Open; closed.len()];
        let mut forces = vec![[0.0; 2]; closed.len()];
        let solved_contacts: Vec<usize> = (0..closed.len())
            .filter(|k| {
                let pressing = self.carrier[*k].unwrap_or(*k);
                closed[*k] && !known_modes.contains(&(pressing, Mode::Open))
            })
            .collect();
        let known_mode = |k: usize| {
            let own = known_modes.iter().find(|(contact, _)| *contact == k);
            own.map(|(_, mode)| *mode)
        };
        // Where among them what a contact leans on stands: before it.
        let carrier = |place: usize| self.carrier[solved_contacts[place]].map(|_| place - 1);
        if solved_contacts.is_empty() {
            return Ok((modes, forces));
        }
        let free = Self::free(system, at)?;
        let here = ContactKinematics::of(system, t, q, v);
        let singular = |singular: Singular| StepError::Singular { singular, t };
        let inertia = Inertia::new(system, t, q).map_err(singular)?;
        let directions: Vec<usize> = solved_contacts
            .iter()
            .flat_map(|k| [2 * k, 2 * k + 1])
            .collect();
        let images: Vec<Vec<f64>> = (directions.iter())
            .map(|direction| inertia.image(here.row(*direction)))
            .collect();
        let g = matrix(&images);
        let width = images.len();
        let accelerations: Vec<[f64; 2]> = (directions.iter())
            .map(|direction| here.acceleration(*direction, &free))
            .collect();
        // The normal forces that are known, of contacts that yield.
        let pressing: Vec<Option<f64>> = (solved_contacts.iter())
            .map(|k| {
                self.compliant_force_at_closing(&here, self.carrier[*k].unwrap_or(*k))
                    .map(|pressed| pressed.force.max(0.0))
            })
            .collect();
        let trouble = |contact: usize, trouble| StepError::Contact {
            contact,
            trouble,
            t,
        };
        // How each slips: from its rate, or found out below; none where it may stick.
        let mut slipping: Vec<Option<f64>> = solved_contacts
            .iter()
            .enumerate()
            .map(|(place, &k)| match (self.has_friction[k], resting[k]) {
                (false, _) => Some(0.0),
                _ if known_mode(k).is_some() => match known_mode(k) {
                    Some(Mode::Slides(sign)) => Some(sign),
                    _ => None,
                },
                (true, true) => None,
                (true, false) if self.has_two_tangents(k) => {
                    let [slip, _] = self.slip(&here, k);
                    Some(slip[usize::from(self.across[k])] / slip[0].hypot(slip[1]))
                }
                (true, false) => {
                    let slip = here.rates[2 * k + 1];
                    let [_, terms] = accelerations[2 * place + 1];
                    match self.modes[k] {
                        // The sign of a slip that is rounding says nothing: it slips as it did.
                        Mode::Slides(sign)
                            if sign != 0.0
                                && slip.abs() <= here.rate_rounding_in_time(2 * k + 1, terms) =>
                        {
                            Some(sign)
                        }
                        _ => Some(slip.signum()),
                    }
                }
            })
            .collect();
        // Which contacts with two tangents are at rest and will slide: in which direction is for their friction to say.
        let mut breaks: Vec<bool> = (solved_contacts.iter())
            .map(|&k| matches!(known_mode(k), Some(Mode::SlidesAlong(_))))
            .collect();
        let mut unsettled = solved_contacts[0];
        for _ in 0..=solved_contacts.len() {
            let mut unknowns = Vec::with_capacity(solved_contacts.len());
            for (place, &k) in solved_contacts.iter().enumerate() {
                let [friction, static_friction] = here.friction(k);
                let static_friction = if breaks[place] {
                    friction
                } else {
                    static_friction
                };
                if self.across[k] && slipping[place].is_none() {
                    unknowns.push(ContactUnknowns::SecondTangent);
                    continue;
                }
                if let (Some(on), None) = (carrier(place), pressing[place]) {
                    unknowns.push(match slipping[place] {
                        Some(sign) => ContactUnknowns::ShareOfCarrier {
                            share: -sign * friction,
                            on,
                        },
                        None => ContactUnknowns::OnCarrier {
                            friction: static_friction,
                            known_normal: 0.0,
                            on,
                        },
                    });
                    continue;
                }
                unknowns.push(match (slipping[place], pressing[place]) {
                    (Some(_), Some(_)) => ContactUnknowns::Nothing,
                    (None, Some(normal)) => ContactUnknowns::Tangent {
                        friction: static_friction,
                        normal,
                    },
                    (None, None) => ContactUnknowns::Both {
                        friction: static_friction,
                        known_normal: 0.0,
                    },
                    (Some(sign), None) => {
                        let share = -sign * friction;
                        let own = g[2 * place * width + 2 * place];
                        let mut coupled = share * g[2 * place * width + 2 * place + 1];
                        if let (Some(_), Some(Some(sign))) =
                            (self.second(k), slipping.get(place + 1))
                        {
                            coupled -= sign * friction * g[2 * place * width + 2 * place + 3];
                        }
                        if own == 0.0 {
                            return Err(trouble(k, ContactTrouble::NotHeld));
                        }
                        // Pressed, it would be pressed the more: none or several motions.
                        if own + coupled <= ROUNDING_OF_FORCES * own {
                            return Err(trouble(k, ContactTrouble::Paradox));
                        }
                        ContactUnknowns::Normal { share }
                    }
                });
            }
            let known = |place: usize| {
                let normal = pressing[place].unwrap_or(0.0);
                let share = slipping[place]
                    .map_or(0.0, |sign| -sign * here.friction(solved_contacts[place])[0]);
                match carrier(place) {
                    None => [normal, share * normal],
                    Some(_) => [0.0, share * normal],
                }
            };
            let known: Vec<[f64; 2]> = (0..solved_contacts.len()).map(known).collect();
            let b: Vec<f64> = (accelerations.iter().enumerate())
                .map(|(row, [value, _])| {
                    let by = g[row * width..][..width].iter().zip(known.iter().flatten());
                    by.fold(*value, |sum, (g, force)| sum + g * force)
                })
                .collect();
            let answer = undetermined::solve(&unknowns, &g, &b)
                .map_err(|_| self.unsolved(&solved_contacts, t))?;
            if answer.residual > 1e-8 {
                return Err(self.unsolved(&solved_contacts, t));
            }
            let mut breaks_away = false;
            for (place, &k) in solved_contacts.iter().enumerate() {
                let after = |part: usize| {
                    let row = 2 * place + part;
                    let of = |forces: &[[f64; 2]]| {
                        let terms = g[row * width..][..width].iter().zip(forces.as_flattened());
                        terms.fold([0.0; 2], |[sum, size], (g, force)| {
                            [sum + g * force, size + (g * force).abs()]
                        })
                    };
                    let ([by, size], [_, of_known]) = (of(&answer.forces), of(&known));
                    let size = accelerations[row][1] + size + of_known;
                    (b[row] + by, ROUNDING_OF_FORCES * size)
                };
                let (opens, rounding) = after(0);
                let rounding = rounding + here.acceleration_rounding(k, self.greatest_rate());
                // One of both is 0, as far as the problem could be solved: what is pressed more than it opens is closed.
                let row = 2 * place;
                let pressed = g[row * width + row] * answer.forces[place][0];
                modes[k] = match slipping[place] {
                    _ if carrier(place)
                        .is_some_and(|on| modes[solved_contacts[on]] == Mode::Open) =>
                    {
                        Mode::Open
                    }
                    _ if carrier(place).is_none()
                        && opens > rounding.max(pressed)
                        && pressing[place].is_none() =>
                    {
                        Mode::Open
                    }
                    // It is said with the first tangent what is done along both.
                    _ if self.across[k] => modes[k - 1],
                    Some(sign) if self.second(k).is_some() => {
                        Mode::SlidesAlong([sign, slipping[place + 1].unwrap_or(0.0)])
                    }
                    Some(sign) => Mode::Slides(sign),
                    None if self.second(k).is_some() => {
                        let used = [0, 1].map(|part| answer.forces[place + part][1]);
                        let normal = pressing[place].unwrap_or(answer.forces[place][0]);
                        let [kinetic, at_rest] = here.friction(k);
                        let most = normal * if breaks[place] { kinetic } else { at_rest };
                        let slips = [1, 3].map(&after);
                        let size = used[0].hypot(used[1]);
                        let speeds_up = slips[0].0.hypot(slips[1].0);
                        let is_still = speeds_up <= slips[0].1.hypot(slips[1].1);
                        // What does not begin to slip sticks, also where others could hold it: contacts that share a load may
                        // share it so that the friction of one is used up.
                        let is_held = size < most * (1.0 - SATURATED) || is_still;
                        // Without any friction that is used up, only who says that it begins to slip can say in which direction.
                        let known_direction = match known_mode(k) {
                            Some(Mode::SlidesAlong(direction)) => direction,
                            _ => [0.0; 2],
                        };
                        let is_unknown = known_direction == [0.0; 2];
                        // What would let go with others may have friction left once these slip, as where a body begins to turn about it.
                        let has_friction_left =
                            kinetic < at_rest && size < most * (1.0 - SATURATED) && is_still;
                        let sticks = if breaks[place] {
                            has_friction_left && most > 0.0
                        } else {
                            is_held
                        };
                        if sticks || (size == 0.0 && is_still && is_unknown) {
                            Mode::Sticks
                        } else {
                            if kinetic != at_rest && !breaks[place] {
                                (breaks[place], breaks_away) = (true, true);
                                unsettled = k;
                                breaks[place + 1] = true;
                            }
                            if size > 0.0 {
                                Mode::SlidesAlong(used.map(|used| -used / size))
                            } else if is_still {
                                Mode::SlidesAlong(known_direction)
                            } else {
                                Mode::SlidesAlong(slips.map(|(slip, _)| slip / speeds_up))
                            }
                        }
                    }
                    None => {
                        let tangential = answer.forces[place][1];
                        let normal = answer.forces[carrier(place).unwrap_or(place)][0];
                        let normal = pressing[place].unwrap_or(normal);
                        let [kinetic, at_rest] = here.friction(k);
                        let most = at_rest * normal;
                        let (slips, rounding) = after(1);
                        // What does not begin to slip sticks, although its friction is used up: contacts that share a load may share it so
                        // while others hold it; and if it has just stopped, or starts exactly at its limit, what follows decides. A slip
                        // that begins later is found by its friction, one that is assumed here and does not begin would stop at once.
                        let is_held = slips.abs() <= rounding;
                        // What has friction left sticks, whatever rounding makes of its slip.
                        let sign = if is_held || tangential.abs() < most * (1.0 - SATURATED) {
                            0.0
                        } else if most > 0.0 {
                            -tangential.signum()
                        } else if slips.abs() > rounding {
                            slips.signum()
                        } else {
                            0.0
                        };
                        match sign {
                            0.0 => Mode::Sticks,
                            sign => {
                                slipping[place] = Some(sign);
                                if kinetic != at_rest {
                                    (breaks_away, unsettled) = (true, k);
                                }
                                Mode::Slides(sign)
                            }
                        }
                    }
                };
            }
            if !breaks_away {
                let parts = known.iter().zip(&answer.forces);
                for (&k, (known, found)) in solved_contacts.iter().zip(parts) {
                    forces[k] = [known[0] + found[0], known[1] + found[1]];
                }
                let lets_go = |k: usize| match modes[k] {
                    Mode::Open => closed[k],
                    Mode::Slides(sign) => self.has_friction[k] && sign != 0.0,
                    Mode::SlidesAlong(_) => true,
                    Mode::Sticks => false,
                };
                let is_asked = known_modes.is_empty();
                let some_let_go = is_asked && (0..modes.len()).any(|k| resting[k] && lets_go(k));
                if some_let_go
                    && let Some(held) = self.rests_together(system, at, &here, resting, &modes)
                {
                    return Ok(held);
                }
                return Ok((modes, forces));
            }
        }
        Err(StepError::Contact {
            contact: self.first(unsettled),
            trouble: ContactTrouble::Unsettled,
            t,
        })
    }
}
