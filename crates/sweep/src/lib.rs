//! One machine, many runs: over parameters, inputs and starts.
//!
//! A [`Plan`] says everything that the rows of a sweep depend on. [`Sweep`] derives its machine once and makes any chunk of
//! its runs: row i depends on the plan and on i alone, whatever thread, host or order it is made in. [`Folder`] keeps chunks on a
//! disk, so that a sweep that was killed goes on where it was.

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

pub use folder::{Contents, Folder, Summary, Trouble, contents, samples_beside};
pub use numbers::shortest;
pub use plan::Plan;
pub use sobol::MOST_VARIABLES;
pub use sweep::{Chunk, Sweep, Wrong, unit_of};
pub use threads::{Progress, chunk_length, cores, run_all};
