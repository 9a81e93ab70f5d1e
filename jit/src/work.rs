//! What compiling is worth.

use lagrangian_program::Function;

/// How much work compiling was, in what does not depend on the processor's mood.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Instructions written.
    pub instructions: usize,
    /// Values that had to leave a register before their last use.
    pub evictions: usize,
    /// Registers looked at while looking for one.
    pub looks: usize,
}

/// What an operation takes to interpret, in ns: 1 to 2 are measured (`cargo bench -p lagrangian-jit --bench engines`).
const INTERPRETING: f64 = 1.0;
/// What an operation takes to compile, and a function beyond its operations, in ns: pages are asked of the system.
const COMPILING: f64 = 200.0;
const PAGES: f64 = 10_000.0;

/// After how many calls compiling pays.
///
/// How many calls will come nobody knows. As many as there have been are expected: so a function is compiled when
/// interpreting it has cost as much as compiling it will, and however many calls come, the whole takes no more than twice as long as
/// by the better of the two ways (A. R. Karlin, M. S. Manasse, L. Rudolph, D. D. Sleator, *Competitive snoopy caching*,
/// Algorithmica 3 (1988) 79–119).
pub fn calls_until_it_pays(function: &Function) -> u32 {
    let operations = function.code.len().max(1) as f64;
    ((PAGES + COMPILING * operations) / (INTERPRETING * operations)).ceil() as u32
}
