//! A machine with its closed contacts as further constraints.

use std::vec::Vec;

use super::super::kinematics::{OnFace, write_some};
use super::{Mode, UnilateralState};
use crate::forward::forward;
use crate::shared_workspace::SharedWorkspace;
use crate::{Constraint, ContactQuantity, ContactTrouble, StepError, System, Vector};

/// A machine whose closed contacts are constraints: a gap that stays 0, and where a contact sticks, a slip that does.
#[derive(Clone, Copy)]
pub(crate) struct Held<'a, S> {
    system: &'a S,
    /// Which directions of contacts are held: two of each contact.
    directions: &'a [usize],
    with_face: &'a [usize],
    memory: &'a SharedWorkspace<HeldMemory>,
}

/// Memory for values of contacts, of which those along the directions that are held are taken.
#[derive(Debug, Default)]
pub(super) struct HeldMemory {
    which: Vec<usize>,
    all: Vec<f64>,
    numbers: Vec<f64>,
    faces: Vec<f64>,
    workspace: Vec<f64>,
}

impl Clone for HeldMemory {
    /// New memory: states of contacts that a run keeps are seldom evaluated.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl<'a, S: System> Held<'a, S> {
    pub fn new(system: &'a S, touching: &'a UnilateralState) -> Self {
        Held {
            system,
            directions: touching.held(),
            with_face: &touching.with_face,
            memory: &touching.held_memory,
        }
    }

    fn wrapped(&self) -> &S {
        self.system
    }

    fn own<'v>(&self, vector: &'v S::Vector) -> &'v S::Vector {
        vector
    }

    fn put(&self, to: &mut S::Vector, write: impl FnOnce(&mut S::Vector)) {
        write(to);
    }

    fn put_matrix(&self, to: &mut S::Matrix, write: impl FnOnce(&mut S::Matrix)) {
        write(to);
    }

    /// Writes what the machine says of its own constraints, and behind it what is picked of a quantity of its contacts, which has so
    /// many numbers along each direction.
    fn with_contacts(
        &self,
        width: usize,
        to: &mut [f64],
        own: impl FnOnce(&mut [f64]),
        (quantity, state): (ContactQuantity, (f64, &S::Vector, &S::Vector)),
        sign: f64,
    ) {
        let at = self.system.constraints().len() * width;
        let (first, rest) = to.split_at_mut(at.min(to.len()));
        own(first);
        if self.directions.is_empty() {
            return;
        }
        let mut memory = self.memory.lock();
        let HeldMemory {
            which,
            all,
            numbers,
            faces,
            ..
        } = &mut *memory;
        which.clear();
        which.extend(self.directions.iter().map(|direction| direction / 2));
        which.dedup();
        write_some(self.system, quantity, which, state, all, numbers);
        if quantity == ContactQuantity::Gap {
            self.replace_gaps_of_corners(which, state, (all, faces), numbers);
        }
        let mut place = 0;
        for (to, &direction) in rest.chunks_mut(width.max(1)).zip(self.directions) {
            // The directions of a contact follow each other.
            if which[place] != direction / 2 {
                place += 1;
            }
            // A gap is a number along the normal only.
            let from = match (quantity, direction % 2) {
                (ContactQuantity::Gap, 0) => &numbers[place..][..width],
                (ContactQuantity::Gap, _) => &[0.0][..width],
                (_, part) => &numbers[(2 * place + part) * width..][..width],
            };
            for (to, from) in to.iter_mut().zip(from) {
                *to = sign * from;
            }
        }
    }

    /// A corner stays on the line of its face, wherever that ends: that it does is for the run to see. Its gap is replaced by its height over that line.
    fn replace_gaps_of_corners(
        &self,
        which: &[usize],
        state: (f64, &S::Vector, &S::Vector),
        (all, faces): (&mut Vec<f64>, &mut Vec<f64>),
        gaps: &mut [f64],
    ) {
        if self.with_face.is_empty() {
            return;
        }
        let is_single = self.system.single_contacts().is_some();
        let held: Vec<usize> = (self.with_face.iter().copied())
            .filter(|k| !is_single || which.contains(k))
            .collect();
        write_some(self.system, ContactQuantity::Face, &held, state, all, faces);
        for (k, face) in held.iter().zip(faces.chunks_exact(3)) {
            if let Some(place) = which.iter().position(|own| own == k) {
                gaps[place] = OnFace::new(face).height;
            }
        }
    }
}

/// The largest displacement of a state onto the closed contacts: the first number times their largest gap, and the second number times the rounding of a gap. If it moves
/// further, gaps hardly depend on it, as those of a body that is wedged in between almost parallel faces.
const MOST_DISPLACED: [f64; 2] = [1e3, 1e6];

impl UnilateralState {
    /// Checks that a state has been moved onto the contacts that are closed by no more than their gaps explain.
    ///
    /// # Errors
    /// The contact along whose gap it has been moved further.
    pub fn check_displacement<S: System>(
        &self,
        system: &S,
        t: f64,
        (from, to): (&S::Vector, &S::Vector),
        v: &S::Vector,
    ) -> Result<(), StepError> {
        if from.as_slice() == to.as_slice() {
            return Ok(());
        }
        let here = self.kinematics(system, (t, from, v));
        let closed = || {
            let normals = self
                .held
                .iter()
                .filter(|direction| direction.is_multiple_of(2));
            normals.map(|direction| direction / 2)
        };
        let greatest = closed().fold(0.0_f64, |most, k| most.max(here.height(k).abs()));
        let [times, roundings] = MOST_DISPLACED;
        let is_far = |k: &usize| {
            let by = from.as_slice().iter().zip(to.as_slice());
            let terms = here.row(2 * k).iter().zip(by);
            let moved: f64 = terms.map(|(w, (from, to))| (w * (to - from)).abs()).sum();
            moved > times * greatest + roundings * here.gap_rounding(*k)
        };
        match closed().find(is_far) {
            None => Ok(()),
            Some(contact) => Err(StepError::Contact {
                contact,
                trouble: ContactTrouble::NotHeld,
                t,
            }),
        }
    }

    /// Which directions are held: 2k for the normal of the contact k, and 2k + 1 for its tangent.
    pub(super) fn held_directions(&self, modes: &[Mode]) -> Vec<usize> {
        let mut held = Vec::new();
        for k in self.in_order() {
            let mode = modes[k];
            let has_normal =
                !self.is_compliant(k) && self.carrier(k).is_none() && !self.is_guide(k);
            if mode != Mode::Open && has_normal {
                held.push(2 * k);
            }
            if mode == Mode::Sticks && self.has_friction(k) {
                held.push(2 * k + 1);
            }
        }
        held
    }
}

impl<S: System> System for Held<'_, S> {
    type Vector = S::Vector;
    type Matrix = S::Matrix;
    type Coordinates = S::Coordinates;
    type Inputs = S::Inputs;
    type Outputs = S::Outputs;
    // Contacts that touch are among the constraints.
    const MAY_SLIDE: bool = false;
    const MAY_COLLIDE: bool = false;

    forward!(
        coordinates,
        to_coordinates,
        to_vector,
        accelerations,
        mass_matrix,
        bias,
        applied,
        forces,
        observed,
        work_rate,
        default_inputs,
        input_values,
        outputs,
        output_values,
        assumptions,
    );

    fn constraints(&self) -> impl ExactSizeIterator<Item = Constraint<'_>> {
        // The number of constraints is asked for often, and their names seldom.
        let mut own = self.system.constraints();
        let mut held = self.directions.iter();
        (0..own.len() + held.len()).map(move |_| {
            if let Some(constraint) = own.next() {
                return constraint;
            }
            let direction = held.next().copied().unwrap_or(0);
            let contact = self.system.unilateral_contacts().nth(direction / 2);
            let rolls = contact.is_some_and(|contact| contact.is_rolling_resistance);
            Constraint {
                name: contact.map_or("", |contact| contact.name),
                unit: match direction % 2 {
                    0 => "m",
                    _ if rolls => "rad/s",
                    _ => "m/s",
                },
                multiplier_unit: if rolls { "N*m" } else { "N" },
                holonomic: direction % 2 == 0,
            }
        })
    }

    fn constraint_positions(&self, t: f64, q: &S::Vector, residuals: &mut [f64]) {
        let own = |to: &mut [f64]| self.system.constraint_positions(t, q, to);
        // Positions do not depend on rates.
        let gaps = (ContactQuantity::Gap, (t, q, q));
        self.with_contacts(1, residuals, own, gaps, 1.0);
    }

    fn constraint_rates(&self, t: f64, q: &S::Vector, v: &S::Vector, residuals: &mut [f64]) {
        let own = |to: &mut [f64]| self.system.constraint_rates(t, q, v, to);
        let rates = (ContactQuantity::Rates, (t, q, v));
        self.with_contacts(1, residuals, own, rates, 1.0);
    }

    fn constraint_matrix(&self, t: f64, q: &S::Vector, matrix: &mut [f64]) {
        let own = |to: &mut [f64]| self.system.constraint_matrix(t, q, to);
        let rows = (ContactQuantity::Rows, (t, q, q));
        self.with_contacts(q.as_slice().len(), matrix, own, rows, 1.0);
    }

    fn constraint_bias(&self, t: f64, q: &S::Vector, v: &S::Vector, drift: &mut [f64]) {
        let own = |to: &mut [f64]| self.system.constraint_bias(t, q, v, to);
        let biases = (ContactQuantity::Bias, (t, q, v));
        // A constraint says what `G a` is to be, and a contact says what its rate is without it.
        self.with_contacts(1, drift, own, biases, -1.0);
    }

    fn with_workspace<R>(&self, length: usize, work: impl FnOnce(Option<&mut [f64]>) -> R) -> R {
        // It is not locked meanwhile: the constraints are evaluated.
        let mut workspace = core::mem::take(&mut self.memory.lock().workspace);
        workspace.clear();
        workspace.resize(length, 0.0);
        let result = work(Some(&mut workspace));
        self.memory.lock().workspace = workspace;
        result
    }
}
