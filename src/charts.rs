//! Machines whose description names Cartesian coordinates for points in polar ones, and their runs in these.
//!
//! At a distance of 0 the angle of polar coordinates is undefined and the mass matrix is singular. A run in Cartesian coordinates passes
//! such a point like any other; only its results are converted. The distance and the angle up to whole turns follow from the
//! components at each instant. The number of turns does not, so it is followed through every step.

mod maps;
#[cfg(feature = "std")]
mod solution;
#[cfg(feature = "std")]
mod turns;

pub use maps::{to_cartesian, to_polar};
#[cfg(feature = "std")]
pub use solution::ChartedSolution;
#[cfg(feature = "std")]
pub use turns::Turns;

use crate::Machine;

/// A machine whose description names Cartesian coordinates beside polar ones, `charts { p: polar(s, phi) | cartesian(x, y) }`.
///
/// [`Simulation::run_in_charts`](crate::Simulation::run_in_charts) makes its runs in the Cartesian ones, so that a point may pass the
/// centre or rest there, and shows them in the polar ones.
#[diagnostic::on_unimplemented(
    message = "the description of `{Self}` names no second chart",
    label = "needs `charts`",
    note = "name Cartesian coordinates for its polar ones in the description: `charts {{ p: polar(s, phi) | cartesian(x, y) }}`"
)]
pub trait Charted: Machine {
    /// The same machine in Cartesian coordinates, with equations of its own. Its coordinates are in the same order; in the places of a
    /// distance and its angle it has the two components.
    type Cartesian: Machine;

    /// The machine in Cartesian coordinates with the same parameters.
    fn in_cartesian(&self) -> Self::Cartesian;

    /// For each point the indices of its distance and of its angle among the coordinates.
    fn points(&self) -> &[[usize; 2]];
}
