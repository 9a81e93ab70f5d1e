//! The equations of motion in the momenta `p = M(q, t) v`.
//!
//! Symplectic methods preserve areas in positions and momenta, not in positions and rates, unless the mass matrix is constant. With the
//! kinetic energy `T = ½ vᵀ M v + mᵀ v + T₀` the bias is a polynomial in the rates, `h(v) = b₂(v, v) + B v + b₀`, and
//!
//! ```text
//! dp/dt = Q − b₀ − ½ (B − Bᵀ) v + vᵀ b₂(v, ·)
//! ```
//!
//! since the last term is `½ ∂(vᵀ M v)/∂q`, the symmetric part of `B` is `∂M/∂t`, and `M a = Q − h`. Without explicit time only the first
//! and the last term remain: the canonical equations. Finite differences of the bias, which is of the second degree, give these terms
//! exactly to rounding:
//!
//! ```text
//! dpᵢ/dt = Qᵢ − hᵢ(0) − ¼ (hᵢ(v) − hᵢ(−v)) + vᵀ (h(v + s eᵢ) − h(v − s eᵢ)) / (4 s)
//! ```
//!
//! If the base turns, `½ (B − Bᵀ) v` is the Coriolis force, and `p` are not Hamilton's momenta: then a step keeps its order and its
//! symmetry, but is not symplectic.

use std::vec::Vec;

use crate::at::At;
use crate::constraints::algebra::{backward, cholesky, forward};
use crate::{Singular, StepError, System, Vector};

/// The mass matrix at a configuration, and memory for the forces.
#[derive(Clone, Debug)]
pub(super) struct Canonical<V, M> {
    matrix: M,
    /// Its Cholesky factor.
    factor: M,
    shares: Vec<f64>,
    /// For each coordinate, the first one of the same unit; and the largest rate of that unit.
    first_of_unit: Vec<usize>,
    greatest_rates: Vec<f64>,
    rates: V,
    ahead: V,
    behind: V,
}

impl<V: Vector, M: Vector> Canonical<V, M> {
    /// Allocates the memory, if the mass matrix is known and there are no contact forces.
    pub fn new<S: System<Vector = V, Matrix = M>>(
        system: &S,
        (t, q): (f64, &V),
    ) -> Result<Self, StepError> {
        let n = q.as_slice().len();
        let unsuited = |reason| Err(StepError::Unsuited { reason, t });
        if system.contacts().len() + system.unilateral_contacts().len() != 0 {
            return unsuited("it has contacts, which `dop853` and `radau5` support");
        }
        if system.equations() != n {
            return unsuited("its mass matrix does not cover all its coordinates");
        }
        let first = |unit: &str| system.coordinates().position(|other| other.unit == unit);
        let units = system.coordinates().enumerate();
        let mut canonical = Self {
            matrix: M::zeros(n * n),
            factor: M::zeros(n * n),
            shares: std::vec![0.0; n],
            first_of_unit: units.map(|(i, one)| first(one.unit).unwrap_or(i)).collect(),
            greatest_rates: std::vec![0.0; n],
            rates: q.zeros_like(),
            ahead: q.zeros_like(),
            behind: q.zeros_like(),
        };
        let unknown = "its mass matrix and its bias are not known";
        if canonical.matrix.as_slice().len() != n * n {
            return unsuited(unknown);
        }
        system.mass_matrix(t, q, &mut canonical.matrix);
        system.bias(t, q, &canonical.rates, &mut canonical.ahead);
        let known = canonical.matrix.as_slice().iter();
        let mut known = known.chain(canonical.ahead.as_slice());
        if known.all(|x| x.is_finite()) {
            Ok(canonical)
        } else {
            unsuited(unknown)
        }
    }

    /// Evaluates the mass matrix at a configuration, and its factor.
    pub fn go_to<S: System<Vector = V, Matrix = M>>(
        &mut self,
        system: &S,
        t: f64,
        q: &V,
    ) -> Result<(), Singular> {
        system.mass_matrix(t, q, &mut self.matrix);
        self.factor.clone_from(&self.matrix);
        cholesky(self.factor.as_mut_slice(), &mut self.shares)
    }

    /// Adds `scale M v` to `p`.
    pub fn add_momenta(&self, scale: f64, v: &V, p: &mut V) {
        let n = v.as_slice().len().max(1);
        let rows = self.matrix.as_slice().chunks_exact(n);
        for (p, row) in p.as_mut_slice().iter_mut().zip(rows) {
            let of_row: f64 = row.iter().zip(v.as_slice()).map(|(m, v)| m * v).sum();
            *p += scale * of_row;
        }
    }

    /// Computes `M⁻¹ p` in place.
    pub fn to_rates(&self, p: &mut [f64]) {
        forward(self.factor.as_slice(), p);
        backward(self.factor.as_slice(), p);
    }

    /// `dp/dt` at a state, without the forces of constraints.
    pub fn force<S: System<Vector = V, Matrix = M>>(
        &mut self,
        system: &S,
        At { t, q, v, u }: At<'_, S>,
        force: &mut V,
    ) {
        let Self {
            first_of_unit,
            greatest_rates,
            rates,
            ahead,
            behind,
            ..
        } = self;
        system.applied(t, q, v, u, force);
        rates.as_mut_slice().fill(0.0);
        system.bias(t, q, rates, ahead);
        for (force, bias) in force.as_mut_slice().iter_mut().zip(ahead.as_slice()) {
            *force -= bias;
        }
        greatest_rates.fill(0.0);
        for (v, &first) in v.as_slice().iter().zip(&*first_of_unit) {
            greatest_rates[first] = greatest_rates[first].max(v.abs());
        }
        if greatest_rates.iter().all(|x| *x == 0.0) {
            return;
        }
        for (rate, v) in rates.as_mut_slice().iter_mut().zip(v.as_slice()) {
            *rate = -v;
        }
        system.bias(t, q, v, ahead);
        system.bias(t, q, rates, behind);
        for (i, force) in force.as_mut_slice().iter_mut().enumerate() {
            *force -= 0.25 * (ahead.as_slice()[i] - behind.as_slice()[i]);
        }
        rates.clone_from(v);
        for (i, &first) in first_of_unit.iter().enumerate() {
            let here = v.as_slice()[i];
            // The increment has the size of the rates; any is exact except for rounding.
            let by = match greatest_rates[first] {
                0.0 => 1.0,
                size => size,
            };
            let [forward, backward] = [here + by, here - by];
            rates.as_mut_slice()[i] = forward;
            system.bias(t, q, rates, ahead);
            rates.as_mut_slice()[i] = backward;
            system.bias(t, q, rates, behind);
            rates.as_mut_slice()[i] = here;
            let pairs = ahead.as_slice().iter().zip(behind.as_slice());
            let products = pairs.zip(v.as_slice()).map(|((a, b), v)| v * (a - b));
            let sum: f64 = products.sum();
            force.as_mut_slice()[i] += sum / (2.0 * (forward - backward));
        }
    }
}

/// Detects when an iteration has converged to rounding, from the squares of its changes in the metric of inertia.
#[derive(Clone, Copy, Debug)]
pub(super) struct ConvergenceTest {
    count: usize,
    before: f64,
}

/// An iteration that has not converged after this many rounds converges too slowly: the step is too long.
const MOST_ITERATIONS: usize = 100;

/// The iteration may end once the square of a change is below this relative to the rates; it ends when changes no longer decrease.
const CONVERGED: f64 = 1e-22;

impl ConvergenceTest {
    pub const START: Self = Self {
        count: 0,
        before: f64::INFINITY,
    };

    /// Whether that was the last iteration, given its change, the size of the changed quantity, and the change by rounding alone; `None` if the
    /// change is not finite or there were too many iterations.
    pub fn is_last(&mut self, change: f64, (size, rounding): (f64, f64)) -> Option<bool> {
        self.count += 1;
        let before = core::mem::replace(&mut self.before, change);
        let is_close = change <= CONVERGED * size + rounding;
        if !change.is_finite() {
            return None;
        }
        if change == 0.0 || (is_close && change >= before) {
            return Some(true);
        }
        if self.count < MOST_ITERATIONS {
            Some(false)
        } else {
            is_close.then_some(true)
        }
    }
}

/// `x · y`: with rates and momenta, a square in the metric of inertia.
pub(super) fn dot<V: Vector>(x: &V, y: &V) -> f64 {
    let pairs = x.as_slice().iter().zip(y.as_slice());
    pairs.map(|(x, y)| x * y).sum()
}
