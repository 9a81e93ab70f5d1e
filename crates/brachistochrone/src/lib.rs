//! Brachistochronic motion: from rest at one configuration to another in the least time, under control forces that do
//! no work, with Coulomb friction whose reactions depend on the accelerations.
//!
//! ```
//! use lagrangian_brachistochrone::Problem;
//!
//! // A bead of 1 kg on a smooth wire that may have any form: x to the right, y downwards, V = −m g y.
//! let bead = Problem::new(&[vec![1.0, 0.0], vec![0.0, 1.0]], &[0.0, -9.81])?;
//! let fastest = bead.solve(&[0.0, 0.0], &[1.0, 1.0])?;
//! assert!((fastest.time() - 0.582895463154743).abs() < 1e-14); // along a cycloid
//! # Ok::<(), lagrangian_brachistochrone::Unsolved>(())
//! ```
//!
//! [`direct`] solves the same problem for machines whose coefficients are not constant.
//!
//! # What is solved
//!
//! The machine has a constant mass matrix `a`, potential energy `c·q`, and guides that slide ([`Guide`]). So friction has
//! the power `P = −b·v − v·d v̇`, and because the control forces `u` do no work (`u·v = 0`), the energy balance is
//!
//! ```text
//! v·(a + d) v̇ + r·v = 0        r = b + c
//! ```
//!
//! These are the conditions (17) of D. Đurić, *On Brachistochronic Motion of a Multibody System with Real Constraints*.
//! `docs/brachistochrone.md` derives what follows, and shows that it is the paper's solution.
//!
//! # How
//!
//! Split `d` into a symmetric part, which acts like a mass, and a skew one, `Ω`. In the metric `A = a + sym d`, with
//! `v = V e`, `|e| = 1`, the equation is `V̇ + r·e + V Ω(e, ė) = 0`.
//!
//! *Two coordinates.* `Ω(e, ė) = κ ẋ` with one constant κ, where x is the angle of `e` from the steepest descent: every
//! such machine is Ashby's particle on a rough wire. All its extremals have a closed form with two numbers in it, κ and
//! the angle δ through which the direction turns ([`plane`]); δ is the one root of one equation.
//!
//! *More coordinates.* If `Ω = 0` the motion stays in the plane through the steepest descent and the end, and is a
//! cycloid there. Otherwise a small loop of directions, traversed in no time, multiplies the speed, and there is no
//! fastest motion ([`Unsolved::LoopsFeed`]).

pub mod direct;
mod error;
mod linear;
pub mod plane;
mod problem;
mod quadrature;
mod solution;
mod trial;

pub use error::Unsolved;
pub use problem::{Guide, Problem};
pub use solution::{Brachistochrone, Contact, Lapse, Moment};
