//! When compiling pays off.

use lagrangian_program::Function;
use lagrangian_program::series::{Row, Series};

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

/// The time to interpret an operation, in ns: 1 to 2 are measured (`cargo bench -p lagrangian-jit --bench engines`).
const INTERPRETING: f64 = 1.0;
/// The time to compile an operation, and the additional time per function for allocating pages, in ns.
const COMPILING: f64 = 200.0;
const PAGES: f64 = 10_000.0;

/// The time to interpret an operation of a series at 20 orders, and to compile it, in ns (`cargo bench -p lagrangian-jit --bench series`).
const EXPANDING: f64 = 80.0;
const COMPILING_SERIES: f64 = 1000.0;

/// The number of calls after which compiling pays off.
///
/// The number of future calls is unknown, so it is assumed to equal that of past calls: a function is compiled when interpreting it
/// has cost as much as compiling it will. Whatever the number of calls, the total time is then at most twice that of the better
/// choice (A. R. Karlin, M. S. Manasse, L. Rudolph, D. D. Sleator, *Competitive snoopy caching*, Algorithmica 3 (1988) 79–119).
pub fn calls_until_it_pays(function: &Function) -> u32 {
    let operations = function.code.len().max(1) as f64;
    ((PAGES + COMPILING * operations) / (INTERPRETING * operations)).ceil() as u32
}

/// About how many operations the code of a series has: those of the start, and those of one order.
pub(crate) fn operations_of_series(series: &Series) -> usize {
    let gradients: usize = series.depends.iter().map(Vec::len).sum();
    let blocks = series.blocks();
    let solved: usize = blocks.iter().map(|members| members.len().pow(2)).sum();
    let sums = series.rows.iter().map(|row| match row {
        Row::Sum(terms) => terms.len(),
        _ => 1,
    });
    2 * gradients + 2 * solved + 5 * sums.sum::<usize>()
}

/// The number of expansions after which compiling a series pays off, by the rule of [`calls_until_it_pays`].
pub(crate) fn expansions_until_it_pays(series: &Series) -> u32 {
    let operations = operations_of_series(series).max(1) as f64;
    let compiling = 3.0 * PAGES + COMPILING_SERIES * operations;
    (compiling / (EXPANDING * operations)).ceil() as u32
}
