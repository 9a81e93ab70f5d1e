//! Removes the penetrations at the end of a step of time stepping.

use std::vec::Vec;

use super::super::UnilateralState;
use super::super::delassus::{Inertia, write_matrix};
use super::super::kinematics::ContactKinematics;
use super::super::problem::{self, Answer, ContactUnknowns};
use super::SteppingMemory;
use crate::{StepError, System, Vector};

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
    /// For each contact the first one that inertia couples with it; multipliers of one such group, and what they do.
    groups: Vec<usize>,
    along: Vec<f64>,
    response: Vec<f64>,
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
        (q, v): (&mut S::Vector, &mut S::Vector),
        h: f64,
        penetrated: &mut Vec<usize>,
        memory: &mut SteppingMemory<S::Vector, S::Matrix>,
    ) -> Result<(), StepError> {
        penetrated.clear();
        for _ in 0..CORRECTIONS {
            let here = self.kinematics(system, (t, q, v));
            if !self.write_penetrated(&here, q.as_slice(), &mut memory.penetration) {
                break;
            }
            penetrated.extend_from_slice(&memory.penetration.deep);
            let SteppingMemory {
                matrix,
                penetration,
                of_forces,
                paid,
                ..
            } = memory;
            let inertia = &mut penetration.inertia;
            inertia
                .evaluate(system, (t, q), matrix)
                .map_err(|singular| StepError::Singular { singular, t })?;
            if !self.write_displacement(&here, penetration) {
                break;
            }
            penetration.brake(&here, (of_forces, h), paid, v.as_mut_slice());
            for (q, by) in q.as_mut_slice().iter_mut().zip(&penetration.displacement) {
                *q += by;
            }
        }
        penetrated.sort_unstable();
        penetrated.dedup();
        Ok(())
    }

    /// Writes which contacts are penetrated, and which are near these; whether there are any.
    fn write_penetrated(
        &self,
        here: &ContactKinematics,
        q: &[f64],
        memory: &mut PenetrationMemory,
    ) -> bool {
        let PenetrationMemory { deep, touching, .. } = memory;
        let is_deep = |k: &usize| {
            let gap = here.gaps[*k];
            self.carrier(*k).is_none()
                && gap < 0.0
                && gap < -0.5 * here.gap_rounding(*k)
                && here.is_within(*k, q)
        };
        deep.clear();
        deep.extend((0..here.gaps.len()).filter(is_deep));
        if deep.is_empty() {
            return false;
        }
        let depths = deep.iter().map(|k| -here.gaps[*k]);
        let deepest = depths.fold(0.0, f64::max);
        // Contacts that are near take part, lest a body that is moved out of one penetrates the other.
        touching.clear();
        touching.extend(
            self.in_order()
                .filter(|k| self.carrier(*k).is_none() && !self.is_guide(*k))
                .filter(|k| here.gaps[*k] <= NEAR * deepest || here.is_gap_closed(*k))
                .filter(|k| here.is_within(*k, q)),
        );
        true
    }

    /// Writes the displacement out of what is penetrated; whether there is one.
    fn write_displacement(&self, here: &ContactKinematics, memory: &mut PenetrationMemory) -> bool {
        let PenetrationMemory {
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
            ..
        } = memory;
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
            return false;
        }
        let along = answer.forces.iter().flatten().copied();
        inertia.write_response(&images[..width], along, displacement);
        true
    }
}

impl PenetrationMemory {
    /// Takes the energy that forces lose in the displacement out of the rates along it, as far as these have as much, and as impulses of the same contacts have not `paid` for it: what would have met something a little
    /// earlier was slower then.
    ///
    /// With the multipliers κ of contacts that inertia couples, the displacement is `δq = M⁻¹ Wᵀ κ`, and forces with the accelerations a lose `A = −κ·W a`. Rates `v + s δq`
    /// have the rates `p' = p + s D` along it, with `p = κ·γ` and `D = κ·G κ`, and `(p'² − p²)/(2 D)` more energy: `p' = ± √(p² − 2 A D)`, with the sign of p.
    fn brake(
        &mut self,
        here: &ContactKinematics,
        (of_forces, h): (&[f64], f64),
        paid: &mut [f64],
        v: &mut [f64],
    ) {
        let Self {
            touching,
            inertia,
            images,
            g,
            answer,
            along,
            groups,
            response,
            ..
        } = self;
        let width = 2 * touching.len();
        let multiplier = |place: usize| answer.forces[place][0];
        groups.clear();
        groups.extend(0..touching.len());
        for place in 0..touching.len() {
            for other in 0..place {
                let is_coupled = g[2 * place * width + 2 * other] != 0.0;
                let (from, to) = (groups[other], groups[place]);
                if multiplier(place) > 0.0 && multiplier(other) > 0.0 && is_coupled && from != to {
                    let (least, most) = (from.min(to), from.max(to));
                    let own = groups.iter_mut().filter(|group| **group == most);
                    own.for_each(|group| *group = least);
                }
            }
        }
        for group in 0..touching.len() {
            let (mut lost, mut rate, mut size) = (0.0, 0.0, 0.0);
            along.clear();
            along.resize(width, 0.0);
            for place in (0..touching.len()).filter(|place| groups[*place] == group) {
                along[2 * place] = multiplier(place);
            }
            for (place, &k) in touching.iter().enumerate() {
                let own = along[2 * place];
                let row = here.row(2 * k).iter().zip(of_forces);
                if own > 0.0 {
                    lost -= core::mem::take(&mut paid[k]);
                }
                lost -= own * row.map(|(w, by)| w * by).sum::<f64>() / h;
                rate += own * here.rates[2 * k];
                let row = g[2 * place * width..][..width].iter().zip(&*along);
                size += own * row.map(|(g, other)| g * other).sum::<f64>();
            }
            if lost > 0.0 && size > 0.0 {
                let slower = (rate * rate - 2.0 * lost * size).max(0.0).sqrt();
                let by = (slower.copysign(rate) - rate) / size;
                inertia.write_response(&images[..width], along.iter().copied(), response);
                v.iter_mut()
                    .zip(&*response)
                    .for_each(|(v, change)| *v += by * change);
            }
        }
    }
}
