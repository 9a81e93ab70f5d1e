//! Sweeps: many runs of one machine, over parameters, inputs and starts.
//!
//! A [`Plan`] holds everything on which the rows of a sweep depend. [`Sweep`] derives its machine once and computes any chunk of its
//! runs: row i depends only on the plan and on i, and not on the thread, the host or the order of execution. [`Folder`] stores chunks on
//! disk, so that a sweep that was killed can be resumed.

pub mod charts;
pub mod design;
mod folder;
mod normal;
mod numbers;
mod philox;
pub mod plan;
mod reduce;
pub mod rows;
pub mod signals;
mod sobol;
mod sweep;
pub mod table;
mod threads;
pub mod verdict;

pub use folder::{Contents, Folder, FolderError, Summary, contents, samples_beside};
pub use numbers::shortest;
pub use plan::Plan;
pub use sobol::MOST_VARIABLES;
pub use sweep::{Chunk, PlanError, Sweep, unit_of};
pub use threads::{Progress, chunk_length, cores, run_all};
