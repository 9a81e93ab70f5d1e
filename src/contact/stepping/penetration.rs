//! Moves the end of a step of time stepping out of what it has penetrated.

use std::vec;
use std::vec::Vec;

use super::super::UnilateralState;
use super::super::delassus::{Inertia, matrix};
use super::super::problem::{self, ContactUnknowns};
use crate::{Singular, StepError, System, Vector};

/// How often a penetration is moved out of, at most: each time squares the remainder.
const CORRECTIONS: usize = 16;

/// Contacts that are open by no more than so many times the deepest penetration are near it.
const NEAR: f64 = 8.0;

/// How large the residual of a displacement may be.
const MOST_RESIDUAL: f64 = 1e-8;

impl UnilateralState {
    /// Moves the end of a step out of what it has penetrated. Says which contacts have been penetrated. Where no displacement leads out of all of them, as where a
    /// body is wedged in, what is left stays until a later step.
    ///
    /// # Errors
    /// Where the mass matrix is singular.
    pub fn resolve_penetration<S: System>(
        &self,
        system: &S,
        t: f64,
        q: &mut S::Vector,
        v: &S::Vector,
    ) -> Result<Vec<usize>, StepError> {
        let mut penetrated = Vec::new();
        for _ in 0..CORRECTIONS {
            let here = self.kinematics(system, (t, q, v));
            let is_deep = |k: &usize| {
                let gap = here.gaps[*k];
                self.carrier(*k).is_none()
                    && gap < 0.0
                    && gap < -0.5 * here.gap_rounding(*k)
                    && here.is_within(*k, q.as_slice())
            };
            let deep: Vec<usize> = (0..here.gaps.len()).filter(is_deep).collect();
            if deep.is_empty() {
                break;
            }
            let deepest = deep
                .iter()
                .fold(0.0, |most, k| f64::max(most, -here.gaps[*k]));
            penetrated.extend(deep);
            // What is near takes part, lest what is moved out of one penetrates the other.
            let touching: Vec<usize> = self
                .in_order()
                .filter(|k| self.carrier(*k).is_none())
                .filter(|k| here.gaps[*k] <= NEAR * deepest || here.is_gap_closed(*k))
                .filter(|k| here.is_within(*k, q.as_slice()))
                .collect();
            let singular = |singular: Singular| StepError::Singular { singular, t };
            let inertia = Inertia::new(system, t, q).map_err(singular)?;
            // The tangents have rows and columns of zeros: nothing is asked of them.
            let none = vec![0.0; here.n];
            let images: Vec<Vec<f64>> = (touching.iter())
                .flat_map(|k| [inertia.image(here.row(2 * k)), none.clone()])
                .collect();
            let gaps: Vec<f64> = touching
                .iter()
                .flat_map(|k| [here.height(*k), 0.0])
                .collect();
            let unknowns = vec![ContactUnknowns::Normal { share: 0.0 }; touching.len()];
            // Where to move does not depend on how contacts share the displacement.
            let answer = problem::solve(&unknowns, &matrix(&images), &gaps, None).ok();
            let Some(answer) = answer.filter(|answer| answer.residual <= MOST_RESIDUAL) else {
                break;
            };
            let by = inertia.response(&images, answer.forces.iter().flatten().copied());
            for (q, by) in q.as_mut_slice().iter_mut().zip(by) {
                *q += by;
            }
        }
        penetrated.sort_unstable();
        penetrated.dedup();
        Ok(penetrated)
    }
}
