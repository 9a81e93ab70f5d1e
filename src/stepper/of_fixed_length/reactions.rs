//! Constraints of positions in steps of a fixed length: their rows and multipliers at the nodes of a step.

use std::vec::Vec;

use super::canonical::{Canonical, dot};
use crate::constraints::algebra::{backward, cholesky, forward};
use crate::stages::Point;
use crate::{StepError, System, Vector};

/// The constraints at several nodes of a step, and the matrix from which they determine their multipliers.
#[derive(Clone, Debug)]
pub(super) struct Reactions {
    /// `G` at each node, row after row.
    pub rows: Vec<Vec<f64>>,
    /// The multipliers at each node.
    pub multipliers: Vec<Vec<f64>>,
    /// Residuals of the constraints at each node, then the changes of multipliers that remove them.
    pub residuals: Vec<Vec<f64>>,
    /// `G M⁻¹`.
    by_force: Vec<f64>,
    /// The Cholesky factor of `G M⁻¹ Gᵀ`.
    matrix: Vec<f64>,
    shares: Vec<f64>,
}

impl Reactions {
    /// Memory for this number of nodes, if the constraints are independent and of positions.
    pub fn new<S: System>(
        system: &S,
        now: &Point<S::Vector>,
        (redundant, nodes): (bool, usize),
    ) -> Result<Self, StepError> {
        let unsuited = |reason| Err(StepError::Unsuited { reason, t: now.t });
        if !system.constraints().all(|constraint| constraint.holonomic) {
            return unsuited(
                "it has constraints on rates that are not constraints on positions; `generalized-alpha` enforces them in steps of a fixed length",
            );
        }
        if redundant {
            return unsuited(
                "it has constraints that depend on each other; `generalized-alpha` enforces them in steps of a fixed length",
            );
        }
        let (n, m) = (now.q.as_slice().len(), system.constraints().len());
        let numbers = |count: usize| std::vec![0.0; count];
        let at_nodes = |count: usize| std::vec![numbers(count); nodes];
        Ok(Self {
            rows: at_nodes(m * n),
            multipliers: at_nodes(m),
            residuals: at_nodes(m),
            by_force: numbers(m * n),
            matrix: numbers(m * m),
            shares: numbers(m),
        })
    }

    pub fn is_empty(&self) -> bool {
        self.shares.is_empty()
    }

    /// Factorizes `scale G M⁻¹ Gᵀ` with the rows at a node and the mass matrix of `canonical`. Returns whether it is invertible.
    pub fn factor<V: Vector, M: Vector>(
        &mut self,
        node: usize,
        canonical: &Canonical<V, M>,
        scale: f64,
    ) -> bool {
        let m = self.shares.len();
        let n = self.by_force.len() / m;
        let rows = &self.rows[node];
        self.by_force.copy_from_slice(rows);
        for row in self.by_force.chunks_exact_mut(n) {
            canonical.to_rates(row);
        }
        for (i, by_force) in self.by_force.chunks_exact(n).enumerate() {
            for (j, row) in rows.chunks_exact(n).enumerate() {
                let product: f64 = row.iter().zip(by_force).map(|(a, b)| a * b).sum();
                self.matrix[i * m + j] = scale * product;
            }
        }
        cholesky(&mut self.matrix, &mut self.shares).is_ok()
    }

    /// Computes from the residuals of a node, in place, the multipliers whose reactions have them as effect.
    pub fn solve(&mut self, node: usize) {
        let residuals = &mut self.residuals[node];
        forward(&self.matrix, residuals);
        backward(&self.matrix, residuals);
    }

    /// Adds `scale Gᵀ x` to `p`, with the rows at a node.
    pub fn add<V: Vector>(&self, node: usize, scale: f64, x: &[f64], p: &mut V) {
        let p = p.as_mut_slice();
        for (row, x) in self.rows[node].chunks_exact(p.len()).zip(x) {
            for (p, g) in p.iter_mut().zip(row) {
                *p += scale * g * x;
            }
        }
    }

    /// Subtracts the reactions of the multipliers in the residuals of a node from the rates: with the residuals of the rates there and the matrix
    /// of that place, the rates obey the constraints.
    pub fn subtract_rates<V: Vector, M: Vector>(
        &self,
        node: usize,
        canonical: &Canonical<V, M>,
        scratch: &mut V,
        mut subtract: impl FnMut(usize, f64),
    ) {
        scratch.as_mut_slice().fill(0.0);
        self.add(node, 1.0, &self.residuals[node], scratch);
        canonical.to_rates(scratch.as_mut_slice());
        for (j, by) in scratch.as_slice().iter().enumerate() {
            subtract(j, *by);
        }
    }

    /// The effect of round-off in the constraints on the rates of a step of length `h`, in the metric of inertia: they change however slow they
    /// are, and from rest it is their only change.
    pub fn rounding<V: Vector, M: Vector>(
        &self,
        canonical: &Canonical<V, M>,
        (before, h): (&Point<V>, f64),
        scratch: &mut V,
    ) -> f64 {
        if self.is_empty() {
            return 0.0;
        }
        scratch.as_mut_slice().fill(0.0);
        canonical.add_momenta(1.0, &before.q, scratch);
        16.0 * f64::EPSILON * f64::EPSILON * dot(scratch, &before.q).abs() / (h * h)
    }
}
