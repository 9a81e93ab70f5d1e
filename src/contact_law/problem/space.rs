//! Contacts with a second tangent, as a problem on cones.

use std::vec::Vec;

use super::super::cone::{self, Disc, Part};
use super::super::lcp::Unsolved;
use super::ContactUnknowns;

/// Memory for problems in space.
#[derive(Clone, Debug, Default)]
pub(super) struct SpaceMemory {
    /// The direction of each unknown force.
    unknowns: Vec<usize>,
    /// For each contact the place of its normal force among the unknowns.
    normals: Vec<Option<usize>>,
    /// The directions in which unknown forces act: the place of the force, the direction, and by what it is multiplied there. What slips in a known direction is a
    /// share of the normal force.
    terms: Vec<(usize, usize, f64)>,
    problem: cone::Problem,
    z: Vec<f64>,
    work: cone::Workspace,
}

impl SpaceMemory {
    fn clear(&mut self, contacts: usize) {
        self.unknowns.clear();
        self.terms.clear();
        self.normals.clear();
        self.normals.resize(contacts, None);
        self.problem.parts.clear();
    }

    fn push_unknown(&mut self, direction: usize) -> usize {
        let place = self.unknowns.len();
        self.unknowns.push(direction);
        self.terms.push((place, direction, 1.0));
        place
    }
}

/// As [`solve_into`](super::solve_into), where some contacts have a second tangent: adds to the forces, and says the residual.
pub(super) fn in_space(
    contacts: &[ContactUnknowns],
    (g, b): (&[f64], &[f64]),
    near: Option<&[[f64; 2]]>,
    (forces, memory): (&mut [[f64; 2]], &mut SpaceMemory),
) -> Result<f64, Unsolved> {
    // In space a guide has no sides.
    if contacts.iter().any(ContactUnknowns::is_guide) {
        return Err(Unsolved);
    }
    let rate = b.iter().fold(0.0_f64, |size, b| size.max(b.abs()));
    if rate == 0.0 {
        return Ok(0.0);
    }
    memory.clear(contacts.len());
    let mut problem = SpaceProblem {
        contacts,
        g,
        b,
        rate,
        memory,
    };
    problem.find_normals();
    problem.find_parts();
    if problem.memory.unknowns.is_empty() {
        return Ok(0.0);
    }
    problem.write_units();
    problem.write_equations();
    problem.write_friction_in_units();
    problem.write_start(near);
    let SpaceMemory {
        problem: on_cones,
        z,
        work,
        ..
    } = &mut *problem.memory;
    let residual = cone::solve(on_cones, z, work)?;
    problem.add_forces(forces);
    Ok(residual)
}

/// A problem with second tangents, which becomes one on cones step by step.
struct SpaceProblem<'a> {
    contacts: &'a [ContactUnknowns],
    g: &'a [f64],
    b: &'a [f64],
    /// The unit of rates.
    rate: f64,
    memory: &'a mut SpaceMemory,
}

impl SpaceProblem<'_> {
    /// The unknown normal forces, with the tangential forces that are shares of them.
    fn find_normals(&mut self) {
        let memory = &mut *self.memory;
        for (k, contact) in self.contacts.iter().enumerate() {
            match *contact {
                ContactUnknowns::Both { .. } => {
                    memory.normals[k] = Some(memory.push_unknown(2 * k));
                }
                ContactUnknowns::Normal { share } => {
                    let place = memory.push_unknown(2 * k);
                    memory.normals[k] = Some(place);
                    memory.terms.push((place, 2 * k + 1, share));
                }
                ContactUnknowns::ShareOfCarrier { share, on } => {
                    if let Some(normal) = memory.normals[on] {
                        memory.terms.push((normal, 2 * k + 1, share));
                    }
                }
                _ => {}
            }
        }
    }

    /// The conditions of the contacts: a normal direction or a disc of friction for each, in the units of the contacts.
    fn find_parts(&mut self) {
        let memory = &mut *self.memory;
        for (k, contact) in self.contacts.iter().enumerate() {
            let own = memory.normals[k];
            memory.problem.parts.extend(own.map(Part::Normal));
            let (friction, on, known_normal) = match *contact {
                ContactUnknowns::Both {
                    friction,
                    known_normal,
                } => (friction, own, known_normal),
                ContactUnknowns::Tangent { friction, normal } => (friction, None, normal),
                ContactUnknowns::OnCarrier {
                    friction,
                    known_normal,
                    on,
                } => (friction, memory.normals[on], known_normal),
                ContactUnknowns::Normal { .. }
                | ContactUnknowns::ShareOfCarrier { .. }
                | ContactUnknowns::Nothing
                | ContactUnknowns::Guide { .. }
                | ContactUnknowns::SlidingGuide { .. }
                | ContactUnknowns::SecondTangent => continue,
            };
            if friction <= 0.0 || (on.is_none() && known_normal <= 0.0) {
                continue;
            }
            let mut places = [memory.push_unknown(2 * k + 1); 2];
            let mut count = 1;
            if let Some(ContactUnknowns::SecondTangent) = self.contacts.get(k + 1) {
                places[1] = memory.push_unknown(2 * k + 3);
                count = 2;
            }
            memory.problem.parts.push(Part::Disc(Disc {
                places,
                count,
                friction,
                on,
                known_normal,
            }));
        }
    }

    /// An entry of `G`.
    fn entry(&self, i: usize, j: usize) -> f64 {
        self.g[i * 2 * self.contacts.len() + j]
    }

    /// The unit of impulse of each direction, in which the diagonal of the matrix is 1.
    fn write_units(&mut self) {
        let mut units = core::mem::take(&mut self.memory.problem.units);
        units.clear();
        let directions = self.memory.unknowns.iter();
        units.extend(directions.map(|direction| self.entry(*direction, *direction)));
        // Both tangents of a contact have one unit of impulse, so that its disc stays one.
        for part in &self.memory.problem.parts {
            if let Part::Disc(Disc { places, .. }) = part {
                let greatest = places.iter().fold(0.0_f64, |most, i| most.max(units[*i]));
                places.iter().for_each(|i| units[*i] = greatest);
            }
        }
        for unit in &mut units {
            *unit = if *unit > 0.0 { 1.0 / *unit } else { 1.0 };
        }
        self.memory.problem.units = units;
    }

    /// The matrix and the rates without unknown forces.
    fn write_equations(&mut self) {
        let mut matrix = core::mem::take(&mut self.memory.problem.matrix);
        let mut b = core::mem::take(&mut self.memory.problem.b);
        let (unknowns, units) = (&self.memory.unknowns, &self.memory.problem.units);
        let n = unknowns.len();
        b.clear();
        b.extend(
            unknowns
                .iter()
                .map(|direction| self.b[*direction] / self.rate),
        );
        matrix.clear();
        matrix.resize(n * n, 0.0);
        for (&direction, row) in unknowns.iter().zip(matrix.chunks_exact_mut(n)) {
            for &(place, along, share) in &self.memory.terms {
                row[place] += share * self.entry(direction, along);
            }
            for (entry, unit) in row.iter_mut().zip(units) {
                *entry *= unit;
            }
        }
        (self.memory.problem.matrix, self.memory.problem.b) = (matrix, b);
    }

    /// Friction and known normal forces in these units.
    fn write_friction_in_units(&mut self) {
        let rate = self.rate;
        let cone::Problem { parts, units, .. } = &mut self.memory.problem;
        for part in parts {
            if let Part::Disc(disc) = part {
                let own = units[disc.places[0]];
                let pressing = disc.on.map_or(own, |on| units[on]);
                disc.friction *= pressing / own;
                disc.known_normal /= pressing * rate;
            }
        }
    }

    /// Where the search begins.
    fn write_start(&mut self, near: Option<&[[f64; 2]]>) {
        let rate = self.rate;
        let SpaceMemory {
            unknowns,
            problem,
            z,
            ..
        } = &mut *self.memory;
        z.clear();
        match near {
            Some(near) => z.extend(
                (unknowns.iter().zip(&problem.units))
                    .map(|(direction, unit)| near[direction / 2][direction % 2] / (unit * rate)),
            ),
            None => z.resize(unknowns.len(), 0.0),
        }
    }

    /// Adds the forces of the solution.
    fn add_forces(&self, forces: &mut [[f64; 2]]) {
        let SpaceMemory {
            terms, problem, z, ..
        } = &*self.memory;
        for &(place, direction, share) in terms {
            forces[direction / 2][direction % 2] +=
                share * z[place] * problem.units[place] * self.rate;
        }
    }
}
