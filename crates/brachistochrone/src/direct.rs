//! The fastest motion of a machine whose masses, forces and friction depend on where it is and how fast: outside of the
//! conditions (17).
//!
//! With `A(q) = a + d` and everything else that resists in `R(q, v)` (inertia forces, less applied ones, friction of what
//! presses without accelerations), control forces that do no work leave
//!
//! ```text
//! v·A(q) v̇ + v·R(q, v) = 0                                                                    (8)
//! ```
//!
//! A transcription whose unknowns are speeds could gain from turns that it does not resolve: `v·A v̇` contains the change of
//! the direction. So the speed is measured by what a sudden turn leaves alone (`hamiltonian`), the direction becomes a
//! control without a rate, and Pontryagin's conditions, a boundary value problem, are collocated at Gauss points
//! (`collocation`): with s of them the error at the ends of stretches is of the order 2 s.
//!
//! The way to the answer begins at several starts: the straight way, ways to either side of it, and guesses. Each becomes the
//! fastest way of straight pieces near it (`descent`), for which nothing but energy has to be known, and if that is a new one, it is where
//! Newton's method on the conditions starts. Where none leads to a motion, or a way of straight pieces is faster than all of them, the
//! motions of the machine without friction are followed while friction grows (`followed`); and where that gives none, there is the machine with
//! frozen coefficients, whose closed form is followed to the machine itself (`frozen`). The stretches are halved until the time settles, and of the motions that obey the
//! conditions of Legendre and of Jacobi the fastest is taken. What was tried is told ([`Trial`]); how much may be done is counted
//! (`budget`).

mod budget;
mod collocation;
mod descent;
mod followed;
mod frozen;
mod hamiltonian;
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
pub use motion::Sought;
pub use search::Search;

/// `½ (A_αβ − A_βα)` below this part of the inertia of both is rounding.
const SKEW: f64 = 1e-13;

/// A machine without constraints and without explicit time.
///
/// Over any numbers, as derivatives are taken with dual ones.
pub trait Terrain {
    /// How many coordinates there are.
    fn coordinates(&self) -> usize;

    /// `A(q) = a + d` by rows: inertia, and friction that grows with the accelerations.
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N>;

    /// `R(q, v)`: what resists without accelerations, a covector.
    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N>;

    /// `a(q)` by rows, where that is not the symmetric part of `A`.
    fn mass(&self, q: &[f64]) -> Vec<f64> {
        let (n, inertia) = (self.coordinates(), self.inertia(q));
        let even = |k: usize| 0.5 * (inertia[k] + inertia[k % n * n + k / n]);
        (0..n * n).map(even).collect()
    }

    /// This machine with every coefficient of friction multiplied by `share`, from 0 to 1; 1 is the machine itself. A search
    /// that finds no motion follows those of the machine without friction to the machine itself. `None` where friction is not
    /// known apart, or there is none.
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

    /// What the guides do, and the power of their friction, in W.
    fn contacts(&self, _q: &[f64], _v: &[f64], _a: &[f64]) -> (Vec<Contact>, f64) {
        (Vec::new(), 0.0)
    }
}

/// The fastest motion of a machine from rest at one place to another, by a [`Search`] as it is unless something is said.
///
/// # Errors
/// Why there is none, or none that was found; see [`Unsolved`].
pub fn solve<T: Terrain>(terrain: T, from: &[f64], to: &[f64]) -> Result<Sought<T>, Unsolved> {
    Search::new().solve(terrain, from, to)
}

/// [`solve`] on a given number of equal stretches of time, for studies of the error.
///
/// # Errors
/// As [`solve`].
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
