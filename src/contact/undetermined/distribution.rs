//! Normal forces of contacts whose states are known, by the rule (E79).
//!
//! All forces are `λ = λ⁰ + B x`, where each column of B leaves the equations of motion as they are, and the normal forces κ of the columns of K keep each other in
//! equilibrium. With `c = λ − s` the rule is a linear complementarity problem:
//!
//! ```text
//! Kᵀ (λ − s) = 0,   0 ≤ λ ⊥ s ≥ 0      ⇔      λ = (λ⁰ − P λ⁰) + P s,   P = B (Kᵀ B)⁺ Kᵀ
//! ```
//!
//! If all contacts stick or slip without friction, the columns of B are those of K and P is the orthogonal projection onto these. So P is symmetric and positive
//! semidefinite, and Lemke's method with lexicographic pivoting ends: with forces that obey the rule, or, if no distribution presses with all contacts, without (R. W.
//! Cottle, J.-S. Pang, R. E. Stone, *The Linear Complementarity Problem*, 1992, theorems 4.4.12 and 4.9.8). The forces are then those of the quadratic program
//! `min λ·λ` of all admissible ones. Where friction follows normal forces, P is another projection, along other directions; the residual tells whether forces
//! were found.

use std::vec;
use std::vec::Vec;

use super::super::lcp;
use super::{dot, greatest, in_equilibrium};

/// Forces below this, relative to the greatest one, press nothing.
const PRESSES: f64 = 1e-12;

/// How large the residual of a distribution may be, relative to the greatest force.
const TOLERABLE: f64 = 1e-9;

/// The equations of forces of contacts whose states are known, which leave some of them undetermined.
pub(in crate::contact) struct OpenForces<'a> {
    /// The change of all forces for each undetermined one.
    pub by: &'a [Vec<f64>],
    /// `Wᵀ M⁻¹ W` for the directions of the forces, whatever friction follows them.
    pub g: &'a [f64],
    /// Which of them are normal forces.
    pub is_normal: &'a [bool],
}

impl OpenForces<'_> {
    /// Adds what the rule adds to the forces; the answer is which of them are normal forces that it sets to 0.
    pub fn distribute(&self, forces: &mut [f64]) -> Vec<bool> {
        let n = forces.len();
        let opens = vec![false; n];
        let pressing = self.pressing(&opens);
        if pressing.is_empty() {
            return opens;
        }
        let given = forces.to_vec();
        self.put(forces, &pressing, &opens);
        if !self.pulls(forces, &pressing) {
            return opens;
        }
        let opens = self.opening(&given, &pressing);
        if let Some(opens) = &opens {
            forces.copy_from_slice(&given);
            self.put(forces, &self.pressing(opens), opens);
            if !self.pulls(forces, &pressing) {
                return opens.clone();
            }
        }
        // No distribution presses with all of them: some contact lifts, and its force is to say so.
        forces.copy_from_slice(&given);
        self.lifting(forces, &given)
    }

    /// Whether a normal force that is shared pulls.
    fn pulls(&self, forces: &[f64], pressing: &[Vec<f64>]) -> bool {
        let size = greatest(forces);
        let is_shared = |i: usize| pressing.iter().any(|kappa| kappa[i] != 0.0);
        let pulls = |i: &usize| self.is_normal[*i] && forces[*i] < -PRESSES * size;
        (0..forces.len()).filter(pulls).any(is_shared)
    }

    /// Which contacts the rule opens, by the complementarity problem; none if that has no solution.
    fn opening(&self, given: &[f64], pressing: &[Vec<f64>]) -> Option<Vec<bool>> {
        let n = given.len();
        let is_shared = |i: &usize| pressing.iter().any(|kappa| kappa[*i] != 0.0);
        let shared: Vec<usize> = (0..n).filter(is_shared).collect();
        let (m, d) = (shared.len(), self.by.len());
        // Rows of Kᵀ B and of Kᵀ are in units in which the greatest entry of each κ and of each column of B is 1.
        let kappas: Vec<Vec<f64>> = (pressing.iter())
            .map(|kappa| {
                let scale = 1.0 / greatest(kappa);
                kappa.iter().map(|x| scale * x).collect()
            })
            .collect();
        let of_by: Vec<Vec<f64>> = (self.by.iter())
            .map(|by| {
                let scale = 1.0 / greatest(by);
                by.iter().map(|x| scale * x).collect()
            })
            .collect();
        let rows: Vec<Vec<f64>> = (kappas.iter())
            .map(|kappa| of_by.iter().map(|by| dot(kappa, by)).collect())
            .collect();
        let products: Vec<f64> = (0..d * d)
            .map(|k| rows.iter().map(|row| row[k / d] * row[k % d]).sum())
            .collect();
        // This is what `x` makes of the forces that are shared where Kᵀ B x is to be this, by least squares.
        let response = |wanted: &[f64]| -> Vec<f64> {
            let (mut left, mut right) = (products.clone(), vec![0.0; d]);
            for (row, wanted) in rows.iter().zip(wanted) {
                (right.iter_mut().zip(row)).for_each(|(sum, x)| *sum += x * wanted);
            }
            let (x, _) = lcp::solve(&mut left, &mut right);
            let force = |i: &usize| of_by.iter().zip(&x).map(|(by, x)| by[*i] * x).sum();
            shared.iter().map(force).collect()
        };
        let mut matrix = vec![0.0; m * m];
        for (column, &i) in shared.iter().enumerate() {
            let wanted: Vec<f64> = kappas.iter().map(|kappa| kappa[i]).collect();
            for (row, entry) in response(&wanted).into_iter().enumerate() {
                matrix[row * m + column] = entry;
            }
        }
        let wanted: Vec<f64> = kappas.iter().map(|kappa| -dot(kappa, given)).collect();
        let constants: Vec<f64> = (shared.iter().zip(response(&wanted)))
            .map(|(i, by)| given[*i] + by)
            .collect();
        let found = lcp::lemke(&matrix, &constants).ok()?;
        if found.residual > TOLERABLE {
            return None;
        }
        let size = greatest(&found.z);
        let mut opens = vec![false; n];
        for (&i, z) in shared.iter().zip(&found.z) {
            opens[i] = *z > PRESSES * size;
        }
        Some(opens)
    }

    /// As [`distribute`](Self::distribute) where no distribution presses with all contacts: corrects one contact at a time, the worst one, a limited number of times.
    fn lifting(&self, forces: &mut [f64], given: &[f64]) -> Vec<bool> {
        let n = forces.len();
        let mut opens = vec![false; n];
        let mut pressing = self.pressing(&opens);
        for _ in 0..4 * n + 8 {
            forces.copy_from_slice(given);
            self.put(forces, &pressing, &opens);
            let size = greatest(forces);
            let is_shared = |i: &usize| pressing.iter().any(|kappa| kappa[*i] != 0.0);
            let pulling = (0..n)
                .filter(|i| self.is_normal[*i] && !opens[*i])
                .filter(is_shared)
                .min_by(|a, b| forces[*a].total_cmp(&forces[*b]));
            if let Some(i) = pulling.filter(|i| forces[*i] < -PRESSES * size) {
                opens[i] = true;
                pressing = self.pressing(&opens);
                continue;
            }
            // This is what the small motion of the others makes of the penetration of an open one.
            let penetration = |i: usize| {
                let mut others = opens.clone();
                others[i] = false;
                let pressing = self.pressing(&others);
                let kappa = pressing.iter().find(|kappa| kappa[i] != 0.0)?;
                let rest: f64 = (0..n)
                    .filter(|j| *j != i && self.is_normal[*j] && !opens[*j])
                    .map(|j| kappa[j] * forces[j])
                    .sum();
                Some(-rest / kappa[i])
            };
            let pressed = (0..n)
                .filter(|i| opens[*i])
                .filter_map(|i| Some((penetration(i)?, i)))
                .max_by(|a, b| a.0.total_cmp(&b.0));
            match pressed {
                Some((depth, i)) if depth > PRESSES * size => {
                    opens[i] = false;
                    pressing = self.pressing(&opens);
                }
                _ => break,
            }
        }
        opens
    }

    /// Forces in equilibrium in which normal forces take part, without those of some contacts.
    fn pressing(&self, opens: &[bool]) -> Vec<Vec<f64>> {
        let n = opens.len();
        let kept: Vec<usize> = (0..n).filter(|i| !opens[*i]).collect();
        let g: Vec<f64> = kept
            .iter()
            .flat_map(|i| kept.iter().map(move |j| self.g[i * n + j]))
            .collect();
        let basis = in_equilibrium(&g, kept.len()).into_iter().map(|vector| {
            let mut whole = vec![0.0; n];
            for (i, x) in kept.iter().zip(vector) {
                whole[*i] = if self.is_normal[*i] { x } else { 0.0 };
            }
            whole
        });
        basis
            .filter(|vector| vector.iter().any(|x| *x != 0.0))
            .collect()
    }

    /// Adds to the forces what makes them fulfil the conditions: `κₙ·λ = 0`, and none of those that open.
    fn put(&self, forces: &mut [f64], pressing: &[Vec<f64>], opens: &[bool]) {
        let conditions =
            pressing
                .iter()
                .cloned()
                .chain((0..opens.len()).filter(|i| opens[*i]).map(|i| {
                    (0..opens.len())
                        .map(|j| f64::from(u8::from(i == j)))
                        .collect()
                }));
        let d = self.by.len();
        let (mut left, mut right) = (vec![0.0; d * d], vec![0.0; d]);
        for condition in conditions {
            let scale = 1.0 / greatest(&condition);
            let row: Vec<f64> = (self.by.iter())
                .map(|by| scale * dot(&condition, by) / greatest(by))
                .collect();
            let missed = scale * dot(&condition, forces);
            for (i, x) in row.iter().enumerate() {
                right[i] -= x * missed;
                for (j, y) in row.iter().enumerate() {
                    left[i * d + j] += x * y;
                }
            }
        }
        let (added, _) = lcp::solve(&mut left, &mut right);
        for (added, by) in added.iter().zip(self.by) {
            let size = greatest(by);
            for (force, by) in forces.iter_mut().zip(by) {
                *force += added * by / size;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between −1 and 1 that look drawn at random.
    fn drawn(seed: &mut u64) -> f64 {
        *seed ^= *seed << 13;
        *seed ^= *seed >> 7;
        *seed ^= *seed << 17;
        (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// A rigid body on feet at random places, each with a normal force and perhaps two that stick: the products of their rows, and which of them are normal.
    fn feet(seed: &mut u64, count: usize, sticks: bool) -> (Vec<f64>, Vec<bool>) {
        let mut rows: Vec<[f64; 6]> = Vec::new();
        let mut is_normal = Vec::new();
        let height = -0.4;
        for _ in 0..count {
            let [x, y] = [0; 2].map(|_| drawn(seed));
            // These are forces along z, x and y, and their moments about the centre of mass.
            rows.push([0.0, 0.0, 1.0, y, -x, 0.0]);
            is_normal.push(true);
            if sticks {
                rows.push([1.0, 0.0, 0.0, 0.0, height, -y]);
                rows.push([0.0, 1.0, 0.0, -height, 0.0, x]);
                is_normal.extend([false; 2]);
            }
        }
        let inverse = [1.0, 1.0, 1.0, 3.0, 2.0, 4.0];
        let product =
            |a: &[f64; 6], b: &[f64; 6]| (0..6).map(|i| a[i] * b[i] * inverse[i]).sum::<f64>();
        let g = (rows.iter()).flat_map(|a| rows.iter().map(move |b| product(a, b)));
        (g.collect(), is_normal)
    }

    /// The least sum of squares of normal forces `λ⁰ + B x ≥ 0`, by trying which of them are 0: for each choice the equations `λᵢ = 0` and `κ·λ = 0` for all κ without
    /// these contacts.
    fn by_enumeration(open_forces: &OpenForces<'_>, given: &[f64]) -> Option<Vec<f64>> {
        let n = given.len();
        let normals: Vec<usize> = (0..n).filter(|i| open_forces.is_normal[*i]).collect();
        let mut best: Option<(f64, Vec<f64>)> = None;
        for choice in 0..1_usize << normals.len() {
            let mut opens = vec![false; n];
            for (bit, i) in normals.iter().enumerate() {
                opens[*i] = choice >> bit & 1 == 1;
            }
            let mut forces = given.to_vec();
            open_forces.put(&mut forces, &open_forces.pressing(&opens), &opens);
            let is_zero = |i: &usize| !opens[*i] || forces[*i].abs() < 1e-9;
            let presses = |i: &usize| forces[*i] > -1e-9;
            if normals.iter().all(|i| is_zero(i) && presses(i)) {
                let sum: f64 = normals.iter().map(|i| forces[*i] * forces[*i]).sum();
                if best.as_ref().is_none_or(|(least, _)| sum < *least) {
                    best = Some((sum, forces));
                }
            }
        }
        best.map(|(_, forces)| forces)
    }

    /// The distribution is that of the quadratic program, whose solution is unique: of bodies on up to seven feet, loaded near their edges so that some feet press
    /// nothing, sticking or not.
    #[test]
    fn the_least_sum_of_squares_is_found() {
        let mut seed = 0x2545_f491_4f6c_dd1d;
        let (mut some_open, mut all_lift) = (0, 0);
        for case in 0..600 {
            let count = 4 + case % 4;
            let (g, is_normal) = feet(&mut seed, count, case % 3 == 0);
            let n = is_normal.len();
            let by = in_equilibrium(&g, n);
            let open_forces = OpenForces {
                by: &by,
                g: &g,
                is_normal: &is_normal,
            };
            // Most forces press, and so can be distributed, and some may not.
            let mut given: Vec<f64> = (0..n)
                .map(|i| {
                    if is_normal[i] {
                        drawn(&mut seed).max(0.0)
                    } else {
                        drawn(&mut seed)
                    }
                })
                .collect();
            if case % 10 == 9 {
                given.iter_mut().for_each(|x| *x -= 0.7);
            }
            // Any other solution of the equations may be given.
            for by in &by {
                let share = 3.0 * drawn(&mut seed);
                given
                    .iter_mut()
                    .zip(by)
                    .for_each(|(x, by)| *x += share * by);
            }
            let mut forces = given.clone();
            let opens = open_forces.distribute(&mut forces);
            let Some(expected) = by_enumeration(&open_forces, &given) else {
                // Nothing presses with all feet, and a force says so.
                all_lift += 1;
                let least = (0..n).filter(|i| is_normal[*i]).map(|i| forces[i]);
                assert!(
                    least.fold(f64::INFINITY, f64::min) < 0.0,
                    "case {case}: {forces:?}"
                );
                continue;
            };
            some_open += usize::from(opens.contains(&true));
            for i in (0..n).filter(|i| is_normal[*i]) {
                let error = (forces[i] - expected[i]).abs();
                assert!(error < 1e-8, "case {case}: {forces:?} and not {expected:?}");
            }
        }
        assert!(some_open > 100 && all_lift > 5, "{some_open} {all_lift}");
    }
}
