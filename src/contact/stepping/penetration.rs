//! Removes the penetrations at the end of a step of time stepping.

use std::vec::Vec;

use super::super::UnilateralState;
use super::super::delassus::{Inertia, write_matrix};
use super::super::problem::{self, Answer, ContactUnknowns};
use super::SteppingMemory;
use crate::{Singular, StepError, System, Vector};

/// How often a penetration is moved out of, at most: each time squares the remainder.
const CORRECTIONS: usize = 16;

/// Contacts that are open by no more than so many times the deepest penetration are near it.
const NEAR: f64 = 8.0;

/// How large the residual of a displacement may be.
const MOST_RESIDUAL: f64 = 1e-8;

/// Memory for displacements.
#[derive(Clone, Debug, Default)]
pub(super) struct PenetrationMemory {
    deep: Vec<usize>,
    touching: Vec<usize>,
    inertia: Inertia,
    /// An image for each normal, each followed by that of a tangent, which is none.
    images: Vec<Vec<f64>>,
    gaps: Vec<f64>,
    g: Vec<f64>,
    entries: Vec<usize>,
    unknowns: Vec<ContactUnknowns>,
    answer: Answer,
    problem: problem::Memory,
    displacement: Vec<f64>,
}

impl UnilateralState {
    /// Moves the end of a step out of what it has penetrated. Writes which contacts have been penetrated. Where no displacement leads out of all of them, as where a
    /// body is wedged in, the remaining penetration stays until a later step.
    ///
    /// # Errors
    /// Where the mass matrix is singular.
    pub fn resolve_penetration<S: System>(
        &self,
        system: &S,
        t: f64,
        (q, v): (&mut S::Vector, &S::Vector),
        penetrated: &mut Vec<usize>,
        memory: &mut SteppingMemory<S::Vector, S::Matrix>,
    ) -> Result<(), StepError> {
        let SteppingMemory {
            matrix,
            penetration,
            ..
        } = memory;
        let PenetrationMemory {
            deep,
            touching,
            inertia,
            images,
            gaps,
            g,
            entries,
            unknowns,
            answer,
            problem,
            displacement,
        } = penetration;
        penetrated.clear();
        for _ in 0..CORRECTIONS {
            let here = self.kinematics(system, (t, q, v));
            let is_deep = |k: &usize| {
                let gap = here.gaps[*k];
                self.carrier(*k).is_none()
                    && gap < 0.0
                    && gap < -0.5 * here.gap_rounding(*k)
                    && here.is_within(*k, q.as_slice())
            };
            deep.clear();
            deep.extend((0..here.gaps.len()).filter(is_deep));
            if deep.is_empty() {
                break;
            }
            let deepest = deep
                .iter()
                .fold(0.0, |most, k| f64::max(most, -here.gaps[*k]));
            penetrated.extend_from_slice(deep);
            // Contacts that are near take part, lest a body that is moved out of one penetrates the other.
            touching.clear();
            touching.extend(
                self.in_order()
                    .filter(|k| self.carrier(*k).is_none())
                    .filter(|k| here.gaps[*k] <= NEAR * deepest || here.is_gap_closed(*k))
                    .filter(|k| here.is_within(*k, q.as_slice())),
            );
            let singular = |singular: Singular| StepError::Singular { singular, t };
            inertia.evaluate(system, (t, q), matrix).map_err(singular)?;
            // The tangents have rows and columns of zeros: nothing is asked of them.
            let width = 2 * touching.len();
            if images.len() < width {
                images.resize_with(width, Vec::new);
            }
            gaps.clear();
            for (&k, pair) in touching.iter().zip(images.chunks_exact_mut(2)) {
                inertia.write_image(here.row(2 * k), &mut pair[0]);
                pair[1].clear();
                pair[1].resize(here.n, 0.0);
                gaps.extend([here.height(k), 0.0]);
            }
            write_matrix(&images[..width], g, entries);
            unknowns.clear();
            unknowns.resize(touching.len(), ContactUnknowns::Normal { share: 0.0 });
            // Where to move does not depend on how contacts share the displacement.
            let solved = problem::solve_into(unknowns, (g, gaps), None, (&mut *answer, problem));
            if solved.is_err() || answer.residual > MOST_RESIDUAL {
                break;
            }
            let along = answer.forces.iter().flatten().copied();
            inertia.write_response(&images[..width], along, displacement);
            for (q, by) in q.as_mut_slice().iter_mut().zip(&*displacement) {
                *q += by;
            }
        }
        penetrated.sort_unstable();
        penetrated.dedup();
        Ok(())
    }
}
