//! Contacts that depend on each other, and those that do not.

use std::vec;
use std::vec::Vec;

use super::elimination::SINGULAR;
use super::{Layout, Parts};
use crate::scalar::friction::{FrictionLayout, FrictionPart};

impl Parts<'_> {
    /// Groups of contacts of which none has an effect on a slip or on a reaction in another group, each in the order of the contacts.
    pub(super) fn blocks(&self) -> Vec<Vec<usize>> {
        let count = self.layout.contacts();
        let mut block_of: Vec<usize> = (0..count).collect();
        for i in 0..count {
            for j in 0..i {
                if (self.depend(i, j) || self.layout.is_second(i) && j + 1 == i)
                    && block_of[i] != block_of[j]
                {
                    let [to, from] = [block_of[i].min(block_of[j]), block_of[i].max(block_of[j])];
                    let of_block = block_of.iter_mut().filter(|block| **block == from);
                    of_block.for_each(|block| *block = to);
                }
            }
        }
        let firsts = (0..count).filter(|k| block_of[*k] == *k);
        let members = |first: usize| (0..count).filter(|k| block_of[*k] == first).collect();
        firsts.map(members).collect()
    }

    /// Whether the friction of one of two contacts has an effect on the other that is more than rounding.
    fn depend(&self, i: usize, j: usize) -> bool {
        let own = [i, j].map(|k| self.at(1 + k, self.slip_rate(k)).abs());
        let between = [(i, j), (j, i)];
        between.into_iter().any(|(k, by)| {
            self.at(1 + by, self.slip_rate(k)).abs() > SINGULAR * own[0].max(own[1])
                || self.presses_by_unit(k, by) > SINGULAR
        })
    }

    /// The response of some of the contacts to their friction forces.
    pub(super) fn of_block(&self, block: &[usize]) -> (Vec<f64>, Layout) {
        let response = FrictionLayout {
            contacts: block.len(),
            constraints: 0,
            ..self.layout.response
        };
        let seconds = block.iter().enumerate();
        let seconds = seconds.filter(|(_, k)| self.layout.is_second(**k));
        let layout = Layout {
            response,
            seconds: seconds.fold(0, |all, (place, _)| all | 1 << place),
        };
        let part = |part: usize| {
            let normals = block.iter().flat_map(|k| self.components(*k));
            FrictionPart {
                accelerations: (0..response.coordinates)
                    .map(|i| self.at(part, i))
                    .collect(),
                multipliers: vec![],
                slip_rates: (block.iter().map(|k| self.at(part, self.slip_rate(*k)))).collect(),
                normals: normals.map(|i| self.at(part, i)).collect(),
            }
        };
        let parts = core::iter::once(0).chain(block.iter().map(|k| 1 + k));
        let coefficients: [Vec<f64>; 2] = [
            block.iter().map(|k| self.friction(*k)).collect(),
            block.iter().map(|k| self.static_friction(*k)).collect(),
        ];
        let directions = block.iter().flat_map(|k| self.response().direction(*k));
        let directions: Vec<f64> = directions.copied().collect();
        let values = FrictionLayout::arrange(parts.map(part), coefficients, directions);
        (values.collect(), layout)
    }
}
