//! Sweeps over the contacts, each of which is solved exactly with the others as they are.

use super::single::Local;
use super::{Part, Problem};

impl Problem {
    /// Solves every contact once, with the others as they are. By how much that changes the forces.
    pub(super) fn sweep(&self, z: &mut [f64]) -> f64 {
        let mut moved = 0.0_f64;
        let mut replace = |z: &mut [f64], places: &[usize], found: &[f64]| {
            for (&i, value) in places.iter().zip(found) {
                moved = moved.max((value - z[i]).abs());
                z[i] = *value;
            }
        };
        // The disc that belongs to the normal force before it, which is solved with that.
        let mut solved = None;
        for (index, part) in self.parts.iter().enumerate() {
            match *part {
                Part::Normal(i) => {
                    let mut all = [i; 3];
                    let (mut count, mut law) = (1, (0.0, 0.0));
                    if let Some(Part::Disc(disc)) = self.parts.get(index + 1)
                        && disc.on == Some(i)
                    {
                        all[1..].copy_from_slice(&disc.places);
                        (count, law) = (1 + disc.count, (disc.friction, disc.known_normal));
                        solved = Some(index + 1);
                    }
                    let found = self.single_contact_forces(&all[..count], law, z);
                    replace(z, &all[..count], &found);
                }
                Part::Disc(_) if solved == Some(index) => {}
                Part::Disc(disc) => {
                    let found = self.local(disc.places(), z).on_disc(disc.radius(z));
                    replace(z, disc.places(), &found[..disc.count]);
                }
            }
        }
        moved
    }

    /// The problem of up to three directions alone.
    fn local(&self, places: &[usize], z: &[f64]) -> Local {
        let mut local = Local {
            dimension: places.len(),
            ..Local::default()
        };
        for (k, &i) in places.iter().enumerate() {
            let row = self.row(i);
            let mut own = 0.0;
            for (l, &j) in places.iter().enumerate() {
                local.w[k][l] = row[j];
                own += row[j] * z[j];
            }
            local.q[k] = self.rate(i, z) - own;
            local.z[k] = z[i];
        }
        local
    }

    /// The forces of one contact, normal and tangents, with all others as they are: as many as it has places.
    pub(super) fn single_contact_forces(
        &self,
        places: &[usize],
        (friction, known_normal): (f64, f64),
        z: &[f64],
    ) -> [f64; 3] {
        self.local(places, z).forces(friction, known_normal)
    }
}
