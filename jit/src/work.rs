//! When compiling pays off.

use lagrangian_program::Function;

/// The amount of work of compiling a function, in counts that do not depend on the processor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Instructions written.
    pub instructions: usize,
    /// Values that were evicted from a register before their last use.
    pub evictions: usize,
    /// Registers examined in the search for one to evict.
    pub looks: usize,
}

impl Work {
    /// Both together.
    pub(crate) fn and(self, other: Work) -> Work {
        Work {
            instructions: self.instructions + other.instructions,
            evictions: self.evictions + other.evictions,
            looks: self.looks + other.looks,
        }
    }
}

/// The time to interpret an operation, in ns: 1 to 2 are measured (`cargo bench -p lagrangian-jit --bench engines`).
const INTERPRETING: f64 = 1.0;
/// The time to compile an operation, and the additional time per function for allocating pages, in ns.
const COMPILING: f64 = 200.0;
const PAGES: f64 = 10_000.0;

/// The number of calls after which compiling pays off.
///
/// The number of future calls is unknown, so it is assumed to equal that of past calls: a function is compiled when interpreting it
/// has cost as much as compiling it will. Whatever the number of calls, the total time is then at most twice that of the better
/// choice (A. R. Karlin, M. S. Manasse, L. Rudolph, D. D. Sleator, *Competitive snoopy caching*, Algorithmica 3 (1988) 79–119).
pub fn calls_until_it_pays(function: &Function) -> u32 {
    let operations = function.code.len().max(1) as f64;
    ((PAGES + COMPILING * operations) / (INTERPRETING * operations)).ceil() as u32
}
