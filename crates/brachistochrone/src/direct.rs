//! The fastest motion of a machine whose masses, forces and friction depend on position and velocity, and which
//! therefore does not satisfy the conditions (17).
//!
//! Let `A(q) = a + d`, and let `R(q, v)` hold all other resistance: inertia forces, minus applied forces, plus friction
//! from reactions that do not depend on accelerations. Control forces that do no work leave
//!
//! ```text
//! v·A(q) v̇ + v·R(q, v) = 0                                                                    (8)
//! ```
//!
//! A transcription whose unknowns are velocities could gain time from turns that it does not resolve, because `v·A v̇`
//! contains the change of direction. So speed is measured by a quantity that a sudden turn does not change (`hamiltonian`),
//! the direction becomes a control without a rate, and Pontryagin's conditions, a boundary value problem, are collocated at
//! Gauss points (`collocation`): with s points the error at the ends of stretches is of order 2 s.
//!
//! The search has several starts: the straight path, paths to either side of it, and guesses. Each is improved to the fastest
//! polygon near it (`descent`), for which the energy balance suffices, and every distinct polygon is a start of Newton's method for
//! the conditions. If none leads to a motion, or a polygon is faster than all motions found, motions of the machine without
//! friction are continued while friction grows (`continuation`). If that fails too, the machine with frozen coefficients is used, whose
//! closed form is continued to the machine itself (`frozen`). The stretches are halved until the time converges, and the fastest
//! motion that satisfies the conditions of Legendre and of Jacobi is the result. All attempts are reported ([`Trial`]), and the
//! work is limited by counting evaluations (`budget`).

mod budget;
mod collocation;
mod continuation;
mod descent;
mod frozen;
mod hamiltonian;
pub mod landscape;
mod motion;
mod pontryagin;
mod rule;
mod search;
mod ways;

use lagrangian_scalar::Scalar;

use super::error::Unsolved;
use super::linear::Matrix;
use super::solution::Contact;

pub use super::trial::{Outcome, Start, Trial};
pub use landscape::{FastestMotion, Landscape};
pub use motion::Sought;
pub use search::Search;

/// A skew part `½ (A_αβ − A_βα)` below this fraction of the inertia of both coordinates is round-off.
const SKEW: f64 = 1e-13;

/// A machine without constraints and without explicit time.
///
/// Its functions are generic over the number, because derivatives are computed with dual numbers.
pub trait Terrain {
    /// The number of coordinates.
    fn coordinates(&self) -> usize;

    /// `A(q) = a + d` by rows: inertia plus the friction that grows with accelerations.
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N>;

    /// `R(q, v)`, a covector: the resistance that does not depend on accelerations.
    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N>;

    /// `a(q)` by rows; by default the symmetric part of `A`.
    fn mass(&self, q: &[f64]) -> Vec<f64> {
        let (n, inertia) = (self.coordinates(), self.inertia(q));
        let even = |k: usize| 0.5 * (inertia[k] + inertia[k % n * n + k / n]);
        (0..n * n).map(even).collect()
    }

    /// This machine with every coefficient of friction multiplied by `share`, from 0 to 1; 1 is the machine itself. A search
    /// that finds no motion continues motions of the machine without friction to the machine itself. `None` where friction
    /// cannot be separated, or there is none.
    fn with_friction(&self, _share: f64) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// Names of the guides.
    fn guides(&self) -> Vec<String> {
        Vec::new()
    }

    /// The slips and reactions of the guides, and the power of their friction, in W.
    fn contacts(&self, _q: &[f64], _v: &[f64], _a: &[f64]) -> (Vec<Contact>, f64) {
        (Vec::new(), 0.0)
    }
}

/// The fastest motion of a machine from rest at one position to another, by a [`Search`] with default settings.
///
/// # Errors
/// Why there is no fastest motion, or none was found; see [`Unsolved`].
pub fn solve<T: Terrain>(terrain: T, from: &[f64], to: &[f64]) -> Result<Sought<T>, Unsolved> {
    Search::new().solve(terrain, from, to)
}

/// [`solve`] with a given number of equal time stretches, for studies of the error.
///
/// # Errors
/// The errors of [`solve`].
pub fn solve_on<T: Terrain>(
    terrain: T,
    from: &[f64],
    to: &[f64],
    stretches: usize,
) -> Result<Sought<T>, Unsolved> {
    Search::new().stretches(stretches).solve(terrain, from, to)
}

fn between(from: &[f64], to: &[f64], part: f64) -> Vec<f64> {
    let ends = from.iter().zip(to);
    ends.map(|(from, to)| from + part * (to - from)).collect()
}

fn symmetric(matrix: Vec<f64>, n: usize) -> Vec<f64> {
    let even = |k: usize| 0.5 * (matrix[k] + matrix[k % n * n + k / n]);
    (0..n * n).map(even).collect()
}

fn rows(matrix: &[f64], n: usize) -> Matrix {
    matrix.chunks(n).map(<[f64]>::to_vec).collect()
}
