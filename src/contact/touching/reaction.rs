//! Accelerations and forces while every contact stays as it is.

use std::vec;
use std::vec::Vec;

use super::super::delassus::{Inertia, write_matrix};
use super::super::drives::DrivesMemory;
use super::super::guides::Guides;
use super::super::kinematics::ContactKinematics;
use super::super::undetermined::{self, OpenForces};
use super::super::{ContactTrouble, lcp};
use super::compliant::{Clearance, ComplianceState};
use super::forces_of_step::ForcesOfStep;
use super::{Mode, ROUNDING_OF_FORCES, UnilateralState};
use crate::at::At;
use crate::balance::ContactShare;
use crate::{Singular, StepError, System, Vector};

/// Accelerations, and the forces in contacts that go with them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reaction {
    pub a: Vec<f64>,
    /// Along normal and tangent, of every contact.
    pub forces: Vec<[f64; 2]>,
    /// What forces of a contact are made of, for their rounding.
    pub(super) sizes: Vec<f64>,
    /// For each closed contact the size of the terms of its tangential acceleration without the forces of contacts, in m/s².
    pub(super) slip_terms: Vec<f64>,
    /// Whether the forces are the only ones that go with the accelerations.
    pub is_only: bool,
    /// What they leave undetermined without a change of the accelerations, if anything.
    pub(super) open_equations: Option<OpenEquations>,
    /// Which contacts press nothing because others that they depend on carry the whole load, (E79).
    pub(super) unloaded: Vec<bool>,
}

/// Forces that the motion leaves undetermined.
#[derive(Clone, Debug)]
pub(super) struct OpenEquations {
    /// The closed contacts.
    pub closed: Vec<usize>,
    /// The contact of each unknown force, as its position in `closed`, and the direction: normal (0) or tangent (1).
    pub unknowns: Vec<(usize, usize)>,
    /// The change of all unknowns for a unit of each undetermined one, none of which changes the accelerations.
    pub of_unit: Vec<Vec<f64>>,
    /// The changes of the reactions of all closed contacts, of those that are guides; nothing if none is.
    pub of_reactions: Vec<Vec<f64>>,
}

impl Reaction {
    /// The reaction if the forces are known.
    pub(in crate::contact) fn from_known_forces(a: Vec<f64>, forces: Vec<[f64; 2]>) -> Self {
        let mut reaction = Self::default();
        reaction.reset(&a, forces.len());
        reaction.forces = forces;
        reaction
    }

    /// Without any forces of contacts.
    fn reset(&mut self, a: &[f64], contacts: usize) {
        self.a.clear();
        self.a.extend_from_slice(a);
        refill(&mut self.forces, contacts, [0.0; 2]);
        refill(&mut self.sizes, contacts, 0.0);
        refill(&mut self.slip_terms, contacts, 0.0);
        refill(&mut self.unloaded, contacts, false);
        self.is_only = true;
        self.open_equations = None;
    }

    fn accelerate(&mut self, by: &[f64]) {
        for (a, by) in self.a.iter_mut().zip(by) {
            *a += by;
        }
    }
}

/// So many times this value.
fn refill<T: Clone>(values: &mut Vec<T>, count: usize, value: T) {
    values.clear();
    values.resize(count, value);
}

/// Memory for evaluations of a machine with contacts: with forces that are determined, they allocate nothing after the first one.
#[derive(Clone, Debug)]
pub(crate) struct ContactMemory<V, M> {
    pub(super) here: ContactKinematics,
    /// The closed contacts, of which alone the forces ask.
    closed: Vec<usize>,
    pub(super) equations: ContactEquations<V, M>,
    pub(super) drives: DrivesMemory<V>,
    pub(super) shares: Vec<ContactShare>,
    /// Whether forces are known, and of what state of the contacts.
    is_evaluated: bool,
    evaluated_for: StateOfContacts,
    /// The forces of a step of time stepping.
    forces_of_step: ForcesOfStep<M>,
}

/// What the forces of contacts depend on, besides place and rates.
#[derive(Clone, Debug, Default)]
struct StateOfContacts {
    modes: Vec<Mode>,
    sides: Vec<f64>,
    compliance: Vec<Option<ComplianceState>>,
    beginning_slips: Vec<f64>,
    continues_through_rest: bool,
}

impl StateOfContacts {
    fn set(&mut self, touching: &UnilateralState) {
        self.modes.clone_from(&touching.modes);
        self.sides.clone_from(&touching.sides);
        self.compliance.clone_from(&touching.compliance);
        self.beginning_slips.clone_from(&touching.beginning_slips);
        self.continues_through_rest = touching.continues_through_rest;
    }

    fn is_of(&self, touching: &UnilateralState) -> bool {
        self.modes == touching.modes
            && self.sides == touching.sides
            && self.compliance == touching.compliance
            && self.beginning_slips == touching.beginning_slips
            && self.continues_through_rest == touching.continues_through_rest
    }
}

impl<V: Vector, M: Vector> ContactMemory<V, M> {
    /// For the contacts of a machine.
    pub fn new(touching: &UnilateralState, q: &V) -> Self {
        ContactMemory {
            here: touching.memory_for_kinematics(),
            closed: Vec::new(),
            equations: ContactEquations::new(q),
            drives: DrivesMemory::new(q),
            shares: Vec::new(),
            is_evaluated: false,
            evaluated_for: StateOfContacts::default(),
            forces_of_step: ForcesOfStep::new(q.as_slice().len()),
        }
    }

    /// Which derivatives of the gap of any contact by a coordinate are not 0 at a place.
    pub fn gap_depends_on<S: System<Vector = V, Matrix = M>>(
        &mut self,
        system: &S,
        (t, q): (f64, &V),
    ) -> impl Fn(usize) -> bool {
        let here = self.kinematics();
        here.evaluate_rows(system, (t, q));
        let here = &*here;
        |i: usize| (0..here.gaps.len()).any(|contact| here.row(2 * contact)[i] != 0.0)
    }

    /// Memory for what is known of contacts at a state; what it held is given up.
    pub(super) fn kinematics(&mut self) -> &mut ContactKinematics {
        self.is_evaluated = false;
        &mut self.here
    }
}

/// The equations of the forces of closed contacts, and their solution.
///
/// With the accelerations `a₀` without these forces, `W (a₀ + M⁻¹ Wᵀ λ) + b = 0` for each direction that is held.
#[derive(Clone, Debug)]
pub(super) struct ContactEquations<V, M> {
    free: V,
    mass_matrix: M,
    inertia: Inertia,
    guides: Guides,
    /// The closed contacts, and the ratio of the tangential to the normal force of each.
    closed: Vec<usize>,
    ratios: Vec<f64>,
    /// Images of their rows, two each, and possibly more; their products.
    images: Vec<Vec<f64>>,
    g: Vec<f64>,
    nonzero_entries: Vec<usize>,
    /// The contact of each unknown force, as its position in `closed`, and the direction: normal (0) or tangent (1).
    unknowns: Vec<(usize, usize)>,
    /// The units of the unknowns: 1, or powers of two for torques that resist rolling.
    units: Vec<f64>,
    left: Vec<f64>,
    right: Vec<f64>,
    values: Vec<f64>,
    order: lcp::Order,
    /// Forces of the closed contacts, and their effect.
    found: Vec<[f64; 2]>,
    response: Vec<f64>,
    pub reaction: Reaction,
}

impl<V: Vector, M: Vector> ContactEquations<V, M> {
    fn new(q: &V) -> Self {
        let n = q.as_slice().len();
        ContactEquations {
            free: q.zeros_like(),
            mass_matrix: M::zeros(n * n),
            inertia: Inertia::default(),
            guides: Guides::default(),
            closed: Vec::new(),
            ratios: Vec::new(),
            images: Vec::new(),
            g: Vec::new(),
            nonzero_entries: Vec::new(),
            unknowns: Vec::new(),
            units: Vec::new(),
            left: Vec::new(),
            right: Vec::new(),
            values: Vec::new(),
            order: lcp::Order::default(),
            found: Vec::new(),
            response: Vec::new(),
            reaction: Reaction::default(),
        }
    }

    /// What forces of a closed contact, along normal and tangent, add to the accelerations.
    pub fn response_to(&mut self, contact: usize, forces: [f64; 2]) -> &[f64] {
        let place = self.closed.iter().position(|k| *k == contact);
        let images = place.map_or(&[][..], |place| &self.images[2 * place..2 * place + 2]);
        self.inertia
            .write_response(images, forces, &mut self.response);
        &self.response
    }

    fn width(&self) -> usize {
        2 * self.closed.len()
    }

    fn entry(&self, row: usize, column: usize) -> f64 {
        self.g[row * self.width() + column]
    }

    /// Adds the effect of forces of the closed contacts in `found` to the accelerations.
    fn add_response(&mut self) {
        let images = &self.images[..2 * self.closed.len()];
        let forces = self.found.iter().flatten().copied();
        self.inertia
            .write_response(images, forces, &mut self.response);
        self.reaction.accelerate(&self.response);
    }

    /// Evaluates the closed contacts of a machine and their products.
    fn evaluate<S: System<Vector = V, Matrix = M>>(
        &mut self,
        touching: &UnilateralState,
        system: &S,
        at: At<'_, S>,
        here: &ContactKinematics,
    ) -> Result<(), Singular> {
        let At { t, q, .. } = at;
        self.inertia
            .evaluate(system, (t, q), &mut self.mass_matrix)?;
        self.closed.clear();
        let is_closed = |k: &usize| touching.modes[*k] != Mode::Open;
        self.closed.extend(touching.in_order().filter(is_closed));
        self.ratios.clear();
        let ratio = |k: &usize| touching.share(here, *k);
        self.ratios.extend(self.closed.iter().map(ratio));
        let width = self.width();
        if self.images.len() < width {
            self.images.resize_with(width, Vec::new);
        }
        let directions = self.closed.iter().flat_map(|k| [2 * k, 2 * k + 1]);
        for (image, direction) in self.images.iter_mut().zip(directions) {
            self.inertia.write_image(here.row(direction), image);
        }
        let images = &self.images[..width];
        write_matrix(images, &mut self.g, &mut self.nonzero_entries);
        if touching.has_guides() {
            self.guides
                .evaluate(system, (t, q), |direction| here.row(direction))?;
            self.guides.evaluate_loads(system, at);
            (self.guides).complete(&self.inertia, &self.closed, images, &mut self.g);
        }
        Ok(())
    }

    /// Sorts the forces of the closed contacts into those that are known and those that are not. Of what slides the tangential force is a share of
    /// the normal one; what sticks has two unknowns, but for a guide, whose reaction follows from all others. The answer is whether any is known.
    fn sort_forces(&mut self, touching: &UnilateralState, here: &ContactKinematics) -> bool {
        let reaction = &mut self.reaction;
        self.unknowns.clear();
        let mut is_any_known = false;
        for (place, &k) in self.closed.iter().enumerate() {
            let ratio = self.ratios[place];
            if let Some(pressed) = touching.compliant_force(here, k) {
                let normal = pressed.force;
                reaction.forces[k] = [normal, ratio * normal];
                reaction.sizes[k] = normal.abs();
                is_any_known = true;
            } else if let Some(on) = touching.carrier[k] {
                if touching.is_compliant(on) {
                    reaction.forces[k] = [0.0, ratio * reaction.forces[on][0]];
                    reaction.sizes[k] = reaction.sizes[on];
                }
            } else if !touching.is_guide(k) || ratio != 0.0 {
                self.unknowns.push((place, 0));
            }
            if touching.modes[k] == Mode::Sticks && touching.has_friction[k] {
                self.unknowns.push((place, 1));
            }
        }
        is_any_known
    }

    /// The place among the closed contacts of what the contact at this place carries, and its share of the normal force.
    fn carried(&self, touching: &UnilateralState, place: usize) -> Option<(usize, f64)> {
        let next = self.closed.get(place + 1)?;
        let is_carried = touching.carrier[*next] == Some(self.closed[place]);
        is_carried.then(|| (place + 1, self.ratios[place + 1]))
    }

    /// The contact that its own friction would press the more the more it is pressed, if there is one.
    fn paradox(&self, touching: &UnilateralState) -> Option<usize> {
        let is_paradox = |(place, k): (usize, usize)| {
            if touching.is_compliant(k) || touching.carrier[k].is_some() {
                return false;
            }
            let own = self.entry(2 * place, 2 * place);
            let by_rolling = self.carried(touching, place).map_or(0.0, |(other, share)| {
                share * self.entry(2 * place, 2 * other + 1)
            });
            let coupled = self.ratios[place] * self.entry(2 * place, 2 * place + 1) + by_rolling;
            // With the opposite sign a guide would press to the other side.
            let coupled = if touching.is_guide(k) {
                -coupled.abs()
            } else {
                coupled
            };
            own + coupled <= ROUNDING_OF_FORCES * own && coupled < 0.0
        };
        let mut closed = self.closed.iter().copied().enumerate();
        closed.find(|own| is_paradox(*own)).map(|(_, k)| k)
    }

    /// Rates of rotation and torques are compared with those of the contact that rolls, whatever the units of length: a unit of each does as much.
    fn write_units(&mut self, touching: &UnilateralState) {
        self.units.clear();
        for &(place, part) in &self.unknowns {
            let k = self.closed[place];
            let turns = part == 1 && touching.carrier[k].is_some() && !touching.across[k];
            let own = self.entry(2 * place + 1, 2 * place + 1);
            // The contact that carries it comes before it.
            let of_carrier = if turns {
                self.entry(2 * place - 2, 2 * place - 2)
            } else {
                own
            };
            let ratio = of_carrier / own;
            let is_scaled = turns && ratio.is_normal() && ratio > 0.0;
            // A power of two changes no digit.
            let unit = if is_scaled {
                (0.5 * ratio.log2()).round().exp2()
            } else {
                1.0
            };
            self.units.push(unit);
        }
    }

    /// Writes the equations of the unknown forces.
    fn write_equations(&mut self, touching: &UnilateralState, here: &ContactKinematics) {
        let size = self.unknowns.len();
        refill(&mut self.left, size * size, 0.0);
        refill(&mut self.right, size, 0.0);
        self.write_units(touching);
        for i in 0..size {
            let (place, part) = self.unknowns[i];
            let k = self.closed[place];
            let row = 2 * place + part;
            for j in 0..size {
                let (other, other_part) = self.unknowns[j];
                let column = |part: usize| self.entry(row, 2 * other + part);
                let entry = match other_part {
                    // Its own force is what a guide presses with.
                    0 if touching.is_guide(self.closed[other]) => {
                        self.ratios[other] * column(1) - column(0)
                    }
                    0 => {
                        let own = column(0) + self.ratios[other] * column(1);
                        self.carried(touching, other)
                            .map_or(own, |(carried, share)| {
                                own + share * self.entry(row, 2 * carried + 1)
                            })
                    }
                    _ => column(1),
                };
                self.left[i * size + j] = self.units[i] * entry * self.units[j];
            }
            let own = self.entry(row, row);
            let (of_rates, [value, terms]) = if touching.is_guide(k) && part == 0 {
                let reaction = self
                    .guides
                    .reaction(k, &self.reaction.a, &self.reaction.forces);
                (0.0, reaction.map(|of| own * of))
            } else {
                let of_rates = here.acceleration_rounding(k, touching.greatest_rate());
                (of_rates, here.acceleration(2 * k + part, &self.reaction.a))
            };
            self.right[i] = -value * self.units[i];
            if own > 0.0 {
                let terms = terms + of_rates / ROUNDING_OF_FORCES;
                let known = &mut self.reaction.sizes[k];
                *known = known.max(terms / own);
            }
        }
    }

    /// Writes the forces along all directions of the closed contacts that belong to values of the unknowns.
    fn write_found(&self, touching: &UnilateralState, values: &[f64], found: &mut Vec<[f64; 2]>) {
        refill(found, self.closed.len(), [0.0; 2]);
        for (&(place, part), value) in self.unknowns.iter().zip(values) {
            found[place][part] += value;
            if part == 0 {
                found[place][1] += self.ratios[place] * value;
                if let Some((carried, share)) = self.carried(touching, place) {
                    found[carried][1] += share * value;
                }
            }
        }
    }

    /// Adds what guides press with, where it was no unknown: where they stick, or have no friction.
    fn add_reactions(&mut self, touching: &UnilateralState) {
        if !touching.has_guides() {
            return;
        }
        let Reaction {
            a, forces, sizes, ..
        } = &mut self.reaction;
        for (place, &k) in self.closed.iter().enumerate() {
            if !touching.is_guide(k) {
                continue;
            }
            let [normal, terms] = self.guides.reaction(k, a, forces);
            sizes[k] = sizes[k].max(terms);
            if self.ratios[place] == 0.0 {
                forces[k][0] = normal;
            }
        }
    }

    /// Distributes forces that the equations leave undetermined, and returns the changes of all unknowns that change no acceleration.
    fn distribute(&mut self, touching: &UnilateralState) -> Vec<Vec<f64>> {
        let width = self.width();
        let mut of_unit = self.order.null_space(&self.left);
        for own in &mut of_unit {
            undetermined::without_rounding(own);
            for (x, unit) in own.iter_mut().zip(&self.units) {
                *x *= unit;
            }
        }
        let directions = self.unknowns.iter().map(|(place, part)| 2 * place + part);
        let directions: Vec<usize> = directions.collect();
        let rows = directions.iter().map(|row| &self.g[row * width..][..width]);
        let among: Vec<f64> = rows
            .flat_map(|row| directions.iter().map(|column| row[*column]))
            .collect();
        let is_normal: Vec<bool> = self.unknowns.iter().map(|(_, part)| *part == 0).collect();
        let open_forces = OpenForces {
            by: &of_unit,
            g: &among,
            is_normal: &is_normal,
        };
        let unloaded = open_forces.distribute(&mut self.values);
        for ((place, _), unloaded) in self.unknowns.iter().zip(unloaded) {
            self.reaction.unloaded[self.closed[*place]] |= unloaded;
        }
        let mut found = Vec::new();
        let effects: Vec<(Vec<f64>, f64)> = (of_unit.iter())
            .map(|own| {
                self.write_found(touching, own, &mut found);
                undetermined::effect(&self.images[..width], found.as_flattened())
            })
            .collect();
        undetermined::without_effect(of_unit, &effects)
    }

    /// The changes of the reactions of all closed contacts, of those that are guides, for each of these changes of the unknowns.
    fn changes_of_reactions(
        &self,
        touching: &UnilateralState,
        of_unit: &[Vec<f64>],
    ) -> Vec<Vec<f64>> {
        let mut found = Vec::new();
        let mut of_reactions = Vec::new();
        for own in of_unit.iter().filter(|_| touching.has_guides()) {
            self.write_found(touching, own, &mut found);
            let change = |k: &usize| self.guides.change(*k, &self.closed, &found);
            of_reactions.push(self.closed.iter().map(change).collect());
        }
        of_reactions
    }

    /// Finds accelerations and forces; nothing is asked of the contacts if all are open.
    fn solve<S: System<Vector = V, Matrix = M>>(
        &mut self,
        touching: &UnilateralState,
        system: &S,
        at: At<'_, S>,
        here: &ContactKinematics,
    ) -> Result<(), StepError> {
        let t = at.t;
        UnilateralState::write_free(system, at, &mut self.free)?;
        self.reaction
            .reset(self.free.as_slice(), touching.modes.len());
        if touching.is_free() {
            return Ok(());
        }
        self.evaluate(touching, system, at, here)
            .map_err(|singular| StepError::Singular { singular, t })?;
        for &k in &self.closed {
            let [_, terms] = here.acceleration(2 * k + 1, &self.reaction.a);
            self.reaction.slip_terms[k] = terms;
        }
        if self.sort_forces(touching, here) {
            self.found.clear();
            let known = self.closed.iter().map(|k| self.reaction.forces[*k]);
            self.found.extend(known);
            self.add_response();
        }
        if let Some(contact) = self.paradox(touching) {
            let trouble = ContactTrouble::Paradox;
            return Err(StepError::Contact {
                contact,
                trouble,
                t,
            });
        }
        self.write_equations(touching, here);
        let solution = (&mut self.values, &mut self.order);
        lcp::eliminate_into(&mut self.left, &mut self.right, solution);
        for (value, unit) in self.values.iter_mut().zip(&self.units) {
            *value *= unit;
        }
        self.reaction.is_only = self.order.rank == self.unknowns.len();
        let of_unit = if self.reaction.is_only {
            Vec::new()
        } else {
            self.distribute(touching)
        };
        let mut found = core::mem::take(&mut self.found);
        self.write_found(touching, &self.values, &mut found);
        for (&k, found) in self.closed.iter().zip(&found) {
            let [normal, tangential] = &mut self.reaction.forces[k];
            *normal += found[0];
            *tangential += found[1];
        }
        self.found = found;
        self.add_response();
        self.add_reactions(touching);
        if !of_unit.is_empty() {
            self.reaction.open_equations = Some(OpenEquations {
                closed: self.closed.clone(),
                unknowns: self.unknowns.clone(),
                of_reactions: self.changes_of_reactions(touching, &of_unit),
                of_unit,
            });
        }
        Ok(())
    }
}

impl UnilateralState {
    /// Writes what the accelerations would be without any contact.
    fn write_free<S: System>(
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
                a.as_mut_slice().fill(0.0);
                crate::least_multipliers(system, t, q, v, u, a, &mut multipliers)
            }
        }
    }

    /// What the machine would do without any contact.
    pub(in crate::contact) fn free<S: System>(
        system: &S,
        at: At<'_, S>,
    ) -> Result<Vec<f64>, StepError> {
        let mut a = at.q.zeros_like();
        Self::write_free(system, at, &mut a)?;
        Ok(a.as_slice().to_vec())
    }

    /// Accelerations and forces while everything stays as it is.
    pub fn reaction<S: System>(&self, system: &S, at: At<'_, S>) -> Result<Reaction, StepError> {
        if let Some(forces) = &self.stepped {
            let mut a = Self::free(system, at)?;
            let here = self.kinematics(system, (at.t, at.q, at.v));
            let mut forces_of_step = ForcesOfStep::new(a.len());
            forces_of_step.add_accelerations(system, (at.t, at.q), &here, forces, &mut a)?;
            return Ok(Reaction::from_known_forces(a, forces.clone()));
        }
        let mut memory = ContactMemory::new(self, at.q);
        self.react(system, at, &mut memory)?;
        Ok(memory.equations.reaction)
    }

    /// Accelerations and forces with closed contacts whose kinematics at this state are known, outside of time stepping.
    pub(super) fn reaction_here<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        here: &ContactKinematics,
    ) -> Result<Reaction, StepError> {
        let mut equations = ContactEquations::<S::Vector, S::Matrix>::new(at.q);
        equations.solve(self, system, at, here)?;
        Ok(equations.reaction)
    }

    /// Evaluates contacts, accelerations and forces outside of time stepping, in memory that is there.
    pub(super) fn react<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        memory: &mut ContactMemory<S::Vector, S::Matrix>,
    ) -> Result<(), StepError> {
        memory.is_evaluated = false;
        if !self.is_free() {
            let is_closed = |k: &usize| self.modes[*k] != Mode::Open;
            let ContactMemory { here, closed, .. } = memory;
            closed.clear();
            closed.extend((0..self.modes.len()).filter(is_closed));
            let is_single = system.single_contacts().is_some();
            here.evaluate(system, (at.t, at.q, at.v), is_single.then_some(&**closed));
        }
        memory.equations.solve(self, system, at, &memory.here)?;
        memory.evaluated_for.set(self);
        memory.is_evaluated = true;
        Ok(())
    }

    /// As [`react`](Self::react), unless the memory holds the forces of this state: where inputs jump, accelerations are evaluated first with the new ones,
    /// which renews it.
    pub(super) fn react_or_recall<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        memory: &mut ContactMemory<S::Vector, S::Matrix>,
    ) -> Result<(), StepError> {
        let is_known = memory.is_evaluated
            && memory.here.is_at(at.t, at.q.as_slice(), at.v.as_slice())
            && memory.evaluated_for.is_of(self);
        if is_known {
            return Ok(());
        }
        self.react(system, at, memory)
    }

    /// Writes how far every contact is from closing at a state, in memory that is there.
    pub fn write_clearances<S: System>(
        &self,
        system: &S,
        place: (f64, &S::Vector, &S::Vector),
        memory: &mut ContactMemory<S::Vector, S::Matrix>,
        all: &mut Vec<Clearance>,
    ) {
        self.write_clearances_with(system, place, memory.kinematics(), all);
    }

    /// The ratio of the tangential to the normal force of a contact that slips; 0 for others.
    pub(super) fn share(&self, here: &ContactKinematics, contact: usize) -> f64 {
        match self.modes[contact] {
            Mode::Slides(sign) => -sign * self.sides[contact] * here.friction(contact)[0],
            Mode::SlidesAlong(_) => -self.slip_direction(here, contact) * here.friction(contact)[0],
            Mode::Open | Mode::Sticks => 0.0,
        }
    }

    /// Accelerations while everything stays as it is.
    pub fn accelerations<S: System>(
        &self,
        system: &S,
        at: At<'_, S>,
        memory: &mut ContactMemory<S::Vector, S::Matrix>,
        a: &mut S::Vector,
    ) -> Result<(), StepError> {
        if let Some(forces) = &self.stepped {
            Self::write_free(system, at, a)?;
            let here = self.kinematics(system, (at.t, at.q, at.v));
            let (place, a) = ((at.t, at.q), a.as_mut_slice());
            let of_step = &mut memory.forces_of_step;
            return of_step.add_accelerations(system, place, &here, forces, a);
        }
        if self.is_free() {
            return Self::write_free(system, at, a);
        }
        self.react(system, at, memory)?;
        a.as_mut_slice()
            .copy_from_slice(&memory.equations.reaction.a);
        Ok(())
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
        let here = self.kinematics(system, (t, q, v));
        let (mut mass, mut forces) = (S::Matrix::zeros(n * n), q.zeros_like());
        let mut rows = vec![0.0; m * n];
        system.mass_matrix(t, q, &mut mass);
        system.forces(t, q, v, u, &mut forces);
        system.constraint_matrix(t, q, &mut rows);
        // This is the part of `M a − f` that the contacts do not carry.
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
}
