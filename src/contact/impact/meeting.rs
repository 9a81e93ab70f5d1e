//! Contacts that meet in an impact, and what inertia makes of their impulses.

use std::vec::Vec;

use super::super::delassus::{Inertia, write_matrix};
use super::super::drives::{ActingContact, Drives, DrivesMemory};
use super::super::guides::Guides;
use super::super::kinematics::ContactKinematics;
use super::Impact;
use crate::{Singular, StepError, System, Vector};

/// Contacts that meet, and what inertia makes of their impulses.
#[derive(Clone, Debug, Default)]
pub(in crate::contact) struct Meeting {
    /// Which contacts, and their directions: two each.
    pub contacts: Vec<usize>,
    pub directions: Vec<usize>,
    pub inertia: Inertia,
    /// The images of these, and perhaps others that were needed before.
    pub images: Vec<Vec<f64>>,
    pub guides: Guides,
    /// The products of the images, row after row.
    pub g: Vec<f64>,
    /// The rates along the directions before they meet.
    pub before: Vec<f64>,
}

impl Meeting {
    pub fn new<S: System>(
        system: &S,
        (t, q): (f64, &S::Vector),
        here: &ContactKinematics,
        contacts: Vec<usize>,
    ) -> Result<Self, StepError> {
        let mut meeting = Self {
            contacts,
            ..Self::default()
        };
        let n = q.as_slice().len();
        let memory = (&mut S::Matrix::zeros(n * n), &mut Vec::new());
        meeting.evaluate(system, (t, q), here, memory)?;
        Ok(meeting)
    }

    /// Evaluates all of it for its contacts, which are known. `matrix` and `entries` are memory.
    pub fn evaluate<S: System>(
        &mut self,
        system: &S,
        (t, q): (f64, &S::Vector),
        here: &ContactKinematics,
        (matrix, entries): (&mut S::Matrix, &mut Vec<usize>),
    ) -> Result<(), StepError> {
        let Self {
            contacts,
            directions,
            inertia,
            images,
            guides,
            g,
            before,
        } = self;
        let singular = |singular: Singular| StepError::Singular { singular, t };
        inertia.evaluate(system, (t, q), matrix).map_err(singular)?;
        directions.clear();
        directions.extend(contacts.iter().flat_map(|k| [2 * k, 2 * k + 1]));
        if images.len() < directions.len() {
            images.resize_with(directions.len(), Vec::new);
        }
        for (direction, image) in directions.iter().zip(&mut *images) {
            inertia.write_image(here.row(*direction), image);
        }
        write_matrix(&images[..directions.len()], g, entries);
        (guides.evaluate(system, (t, q), |direction| here.row(direction))).map_err(singular)?;
        guides.complete(inertia, contacts, images, g);
        before.clear();
        before.extend(directions.iter().map(|d| here.rates[*d]));
        Ok(())
    }

    /// By how much impulses change the rate of a direction. A guide has none along its normal.
    pub fn change(&self, row: usize, impulses: &[[f64; 2]]) -> f64 {
        if row.is_multiple_of(2) && self.guides.has(self.contacts[row / 2]) {
            return 0.0;
        }
        let width = self.directions.len();
        let own = self.g[row * width..][..width].iter();
        let terms = own.zip(impulses.iter().flatten());
        terms.map(|(g, impulse)| g * impulse).sum()
    }

    /// Writes the reactions of guides in place of what presses on their far sides. `of_forces` are those to forces that act meanwhile, each times `G_nn` of its guide,
    /// at the place of its normal.
    pub fn write_reactions(&self, of_forces: &[f64], impulses: &mut [[f64; 2]]) {
        if !self.guides.are_there() {
            return;
        }
        let width = self.directions.len();
        for (place, &k) in self.contacts.iter().enumerate() {
            if self.guides.has(k) {
                let row = &self.g[2 * place * width..][..width];
                let unit = row[2 * place];
                // No reaction depends on the normal impulse of another guide.
                let terms = row.iter().zip(impulses.as_flattened()).enumerate();
                let others = terms.filter(|(column, _)| *column != 2 * place);
                let by = others.map(|(_, (g, impulse))| g * impulse).sum::<f64>();
                impulses[place][0] = (of_forces.get(2 * place).copied().unwrap_or(0.0) + by) / unit;
            }
        }
    }

    /// Sets the rates along the normals of guides, where nothing moves, to 0.
    pub fn clear_rates_of_guides(&self, rates: &mut [f64]) {
        if !self.guides.are_there() {
            return;
        }
        for (place, &k) in self.contacts.iter().enumerate() {
            if self.guides.has(k) {
                rates[2 * place] = 0.0;
            }
        }
    }

    /// The impacts that these impulses are, and by how much they change the rates of coordinates.
    pub fn impacts<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        here: &ContactKinematics,
        impulses: &[[f64; 2]],
    ) -> (Vec<Impact>, Vec<f64>) {
        let mut with_reactions = Vec::new();
        if self.guides.are_there() {
            with_reactions.extend_from_slice(impulses);
            self.write_reactions(&[], &mut with_reactions);
        }
        let impulses = if with_reactions.is_empty() {
            impulses
        } else {
            &with_reactions[..]
        };
        let change = (self.inertia).response(&self.images, impulses.iter().flatten().copied());
        let mean = between(v, &change);
        let mut memory = DrivesMemory::new(q);
        let mut drives = Drives::new(system, (t, q), &mut memory);
        let mut impacts = Vec::with_capacity(self.contacts.len());
        for (place, (&k, &impulse)) in self.contacts.iter().zip(impulses).enumerate() {
            let [gap_rate, slip] = [0, 1].map(|part| {
                let row = 2 * place + part;
                let before = self.before[row];
                [before, before + self.change(row, impulses)]
            });
            let loss = -0.5
                * (impulse[0] * (gap_rate[0] + gap_rate[1]) + impulse[1] * (slip[0] + slip[1]));
            let acting = ActingContact {
                contact: k,
                forces: impulse,
                rates: [gap_rate, slip].map(|[before, after]| 0.5 * (before + after)),
            };
            let response = || (self.inertia).response(&self.images[2 * place..][..2], impulse);
            impacts.push(Impact {
                contact: k,
                gap_rate,
                slip,
                impulse,
                loss,
                work: drives.work(here, &acting, &mean, response),
            });
        }
        impacts.sort_by_key(|impact| impact.contact);
        (impacts, change)
    }
}

/// The mean of rates before a change and after it.
pub(super) fn between<V: Vector>(v: &V, change: &[f64]) -> V {
    let mut mean = v.clone();
    for (v, by) in mean.as_mut_slice().iter_mut().zip(change) {
        *v += 0.5 * by;
    }
    mean
}
