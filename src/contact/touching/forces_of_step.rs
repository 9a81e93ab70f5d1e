//! Accelerations by the mean forces of a step of time stepping.

use std::vec::Vec;

use super::super::delassus::Inertia;
use super::super::kinematics::ContactKinematics;
use crate::{Singular, StepError, System, Vector};

/// Memory for the accelerations by the forces of the last step.
#[derive(Clone, Debug)]
pub(super) struct ForcesOfStep<M> {
    inertia: Inertia,
    matrix: M,
    /// The directions in which forces act, these forces, and the images of the directions.
    directions: Vec<usize>,
    acting: Vec<f64>,
    images: Vec<Vec<f64>>,
    response: Vec<f64>,
}

impl<M: Vector> ForcesOfStep<M> {
    pub fn new(coordinates: usize) -> Self {
        Self {
            inertia: Inertia::default(),
            matrix: M::zeros(coordinates * coordinates),
            directions: Vec::new(),
            acting: Vec::new(),
            images: Vec::new(),
            response: Vec::new(),
        }
    }

    /// Adds to accelerations what forces along normals and tangents make of them.
    ///
    /// # Errors
    /// Where the mass matrix is singular.
    pub fn add_accelerations<S: System<Matrix = M>>(
        &mut self,
        system: &S,
        (t, q): (f64, &S::Vector),
        here: &ContactKinematics,
        forces: &[[f64; 2]],
        a: &mut [f64],
    ) -> Result<(), StepError> {
        let all = forces.as_flattened();
        self.directions.clear();
        (self.directions).extend((0..all.len()).filter(|direction| all[*direction] != 0.0));
        if self.directions.is_empty() {
            return Ok(());
        }
        self.acting.clear();
        self.acting.extend(self.directions.iter().map(|d| all[*d]));
        let singular = |singular: Singular| StepError::Singular { singular, t };
        let inertia = &mut self.inertia;
        (inertia.evaluate(system, (t, q), &mut self.matrix)).map_err(singular)?;
        if self.images.len() < self.directions.len() {
            self.images.resize_with(self.directions.len(), Vec::new);
        }
        for (direction, image) in self.directions.iter().zip(&mut self.images) {
            inertia.write_image(here.row(*direction), image);
        }
        let acting = self.acting.iter().copied();
        inertia.write_response(&self.images, acting, &mut self.response);
        for (a, by) in a.iter_mut().zip(&self.response) {
            *a += by;
        }
        Ok(())
    }
}
