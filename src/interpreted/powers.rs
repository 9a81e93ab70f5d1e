//! Which powers of a machine there are: a conservative one without drives has neither work nor losses.

use lagrangian_program::{Function, Op, Program, Role};

/// Whether all results of a function are 0.
fn is_zero(function: &Function) -> bool {
    let zero = |op: &Op| matches!(op, Op::Constant(constant) if constant.is_zero());
    function.guards.is_empty()
        && function
            .results
            .iter()
            .all(|value| function.code.get(value.index()).is_some_and(zero))
}

/// For work and losses: whether the program has a function for them that is not identically 0.
pub(super) fn has_powers(program: &Program) -> [bool; 2] {
    [Role::WorkRate, Role::DissipationRate].map(|role| {
        let function = program.function(role);
        function.is_some_and(|function| !is_zero(function))
    })
}
