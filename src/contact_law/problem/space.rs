//! Contacts with a second tangent, as a problem on cones.

use std::vec::Vec;

use super::super::cone::{self, Part};
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
    let (m, all_contacts) = (contacts.len(), contacts);
    let entry = |i: usize, j: usize| g[i * 2 * m + j];
    let rate = b.iter().fold(0.0_f64, |size, b| size.max(b.abs()));
    if rate == 0.0 {
        return Ok(0.0);
    }
    memory.unknowns.clear();
    memory.terms.clear();
    memory.normals.clear();
    memory.normals.resize(m, None);
    memory.problem.parts.clear();
    for (k, contacts) in contacts.iter().enumerate() {
        match *contacts {
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
    for (k, contacts) in contacts.iter().enumerate() {
        let (friction, on, known_normal) = match *contacts {
            ContactUnknowns::Both {
                friction,
                known_normal,
            } => (friction, memory.normals[k], known_normal),
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
            | ContactUnknowns::SecondTangent => {
                let normal = memory.normals[k].map(Part::Normal);
                memory.problem.parts.extend(normal);
                continue;
            }
        };
        if matches!(contacts, ContactUnknowns::Both { .. }) {
            let normal = memory.normals[k].map(Part::Normal);
            memory.problem.parts.extend(normal);
        }
        if friction <= 0.0 || (on.is_none() && known_normal <= 0.0) {
            continue;
        }
        let mut places = [memory.push_unknown(2 * k + 1); 2];
        let mut count = 1;
        if let Some(ContactUnknowns::SecondTangent) = all_contacts.get(k + 1) {
            places[1] = memory.push_unknown(2 * k + 3);
            count = 2;
        }
        memory.problem.parts.push(Part::Disc {
            places,
            count,
            friction,
            on,
            known_normal,
        });
    }
    let SpaceMemory {
        unknowns,
        terms,
        problem,
        z,
        work,
        ..
    } = memory;
    let n = unknowns.len();
    let units = &mut problem.units;
    units.clear();
    units.extend(
        unknowns
            .iter()
            .map(|direction| entry(*direction, *direction)),
    );
    // Both tangents of a contact have one unit of impulse, so that its disc stays one.
    for part in &problem.parts {
        if let Part::Disc { places, .. } = part {
            let greatest = places.iter().fold(0.0_f64, |most, i| most.max(units[*i]));
            places.iter().for_each(|i| units[*i] = greatest);
        }
    }
    for unit in units.iter_mut() {
        *unit = if *unit > 0.0 { 1.0 / *unit } else { 1.0 };
    }
    problem.b.clear();
    problem
        .b
        .extend(unknowns.iter().map(|direction| b[*direction] / rate));
    problem.matrix.clear();
    problem.matrix.resize(n * n, 0.0);
    for (&direction, row) in unknowns.iter().zip(problem.matrix.chunks_exact_mut(n)) {
        for &(place, along, share) in terms.iter() {
            row[place] += share * entry(direction, along);
        }
        for (entry, unit) in row.iter_mut().zip(&*units) {
            *entry *= unit;
        }
    }
    for part in &mut problem.parts {
        if let Part::Disc {
            places,
            friction,
            on,
            known_normal,
            ..
        } = part
        {
            let own = units[places[0]];
            let pressing = on.map_or(own, |on| units[on]);
            *friction *= pressing / own;
            *known_normal /= pressing * rate;
        }
    }
    z.clear();
    match near {
        Some(near) => z.extend(
            (unknowns.iter().zip(&*units))
                .map(|(direction, unit)| near[direction / 2][direction % 2] / (unit * rate)),
        ),
        None => z.resize(n, 0.0),
    }
    let residual = cone::solve(problem, z, work)?;
    for &(place, direction, share) in terms.iter() {
        forces[direction / 2][direction % 2] += share * z[place] * problem.units[place] * rate;
    }
    Ok(residual)
}
