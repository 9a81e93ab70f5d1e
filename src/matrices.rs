//! Vectors and matrices of `nalgebra` at the interface.
//!
//! ```
//! # mod by_hand { include!("../tests/by_hand/double_pendulum.rs"); }
//! # use by_hand::DoublePendulum;
//! use lagrangian::matrices::Matrices;
//! use lagrangian::{Machine, System};
//!
//! let pendulum = DoublePendulum::default();
//! let (system, state) = (pendulum.prepare(), pendulum.start());
//! let inertia = system.mass_matrix_of(&state);
//! let forces = system.forces_of(&state, &system.default_inputs());
//! let accelerations = inertia.cholesky().unwrap().solve(&forces);
//! # let exact = system.accelerations_of(&state, &system.default_inputs()).unwrap();
//! # assert!((accelerations - exact).norm() < 1e-14);
//! ```

use nalgebra::{DMatrix, DVector};

use crate::{Singular, State, System, Vector};

/// The equations of motion `M a = f`, in matrices; for every [`System`].
pub trait Matrices: System {
    /// Mass matrix `M`.
    fn mass_matrix_of(&self, state: &State<Self::Coordinates>) -> DMatrix<f64> {
        let n = self.coordinates().len();
        let mut matrix = Self::Matrix::zeros(n * n);
        self.mass_matrix(state.t, &self.to_vector(&state.q), &mut matrix);
        DMatrix::from_row_slice(n, n, matrix.as_slice())
    }

    /// Bias `h`.
    fn bias_of(&self, state: &State<Self::Coordinates>) -> DVector<f64> {
        let (q, v) = (self.to_vector(&state.q), self.to_vector(&state.v));
        let mut bias = q.zeros_like();
        self.bias(state.t, &q, &v, &mut bias);
        DVector::from_column_slice(bias.as_slice())
    }

    /// Applied generalized forces `Q`.
    fn applied_of(&self, state: &State<Self::Coordinates>, u: &Self::Inputs) -> DVector<f64> {
        let (q, v) = (self.to_vector(&state.q), self.to_vector(&state.v));
        let mut applied = q.zeros_like();
        self.applied(state.t, &q, &v, u, &mut applied);
        DVector::from_column_slice(applied.as_slice())
    }

    /// The right-hand side `f = Q − h`.
    fn forces_of(&self, state: &State<Self::Coordinates>, u: &Self::Inputs) -> DVector<f64> {
        let (q, v) = (self.to_vector(&state.q), self.to_vector(&state.v));
        let mut forces = q.zeros_like();
        self.forces(state.t, &q, &v, u, &mut forces);
        DVector::from_column_slice(forces.as_slice())
    }

    /// Accelerations `a`.
    fn accelerations_of(
        &self,
        state: &State<Self::Coordinates>,
        u: &Self::Inputs,
    ) -> Result<DVector<f64>, Singular> {
        let (q, v) = (self.to_vector(&state.q), self.to_vector(&state.v));
        let mut a = q.zeros_like();
        self.accelerations(state.t, &q, &v, u, &mut a)?;
        Ok(DVector::from_column_slice(a.as_slice()))
    }

    /// Coordinates, then rates, in one vector.
    fn state_vector(&self, state: &State<Self::Coordinates>) -> DVector<f64> {
        let (q, v) = (self.to_vector(&state.q), self.to_vector(&state.v));
        let numbers = q.as_slice().iter().chain(v.as_slice()).copied();
        DVector::from_iterator(2 * q.as_slice().len(), numbers)
    }

    /// The state at time `t` with coordinates, then rates, in one vector; `None` if its
    /// length is wrong.
    fn state_from_vector(&self, t: f64, vector: &DVector<f64>) -> Option<State<Self::Coordinates>> {
        let n = self.coordinates().len();
        if vector.len() != 2 * n {
            return None;
        }
        let (mut q, mut v) = (Self::Vector::zeros(n), Self::Vector::zeros(n));
        q.as_mut_slice().copy_from_slice(&vector.as_slice()[..n]);
        v.as_mut_slice().copy_from_slice(&vector.as_slice()[n..]);
        Some(State {
            t,
            q: self.to_coordinates(&q),
            v: self.to_coordinates(&v),
        })
    }

    /// States as rows of a table: time, coordinates, rates.
    fn state_table(&self, states: &[State<Self::Coordinates>]) -> DMatrix<f64> {
        let n = self.coordinates().len();
        let mut table = DMatrix::zeros(states.len(), 1 + 2 * n);
        for (mut row, state) in table.row_iter_mut().zip(states) {
            row[0] = state.t;
            for (i, y) in self.state_vector(state).iter().enumerate() {
                row[1 + i] = *y;
            }
        }
        table
    }
}

impl<S: System> Matrices for S {}
