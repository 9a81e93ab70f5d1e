//! Calls of the functions of a program, by machine code or by the interpreter.

use lagrangian_program as program;
use lagrangian_program::{Arguments, Interpreter, Role};
use lagrangian_scalar::{Kernel, Scalar};

use super::engine;
use crate::Number;

/// Executes the functions of a system.
#[derive(Clone, Debug)]
pub(super) struct Running {
    /// The interpreter with its registers.
    pub(super) interpreter: Interpreter<f64>,
    /// Machine code that replaces the interpreter where there is any.
    pub(super) compiled: engine::Compiled,
}

impl Running {
    pub(super) fn call(
        &mut self,
        role: Role,
        arguments: Arguments<'_, f64>,
        results: &mut [f64],
    ) -> Result<(), program::Singular> {
        let Self {
            interpreter,
            compiled,
        } = self;
        if compiled.call(role, arguments, results) {
            return Ok(());
        }
        if role.is_fast() {
            // In the arithmetic of compiled machines, with the same bits.
            f64::run(Call {
                interpreter,
                role,
                arguments,
                results,
            })
        } else {
            interpreter.call(role, arguments, results)
        }
    }
}

/// A call of the interpreter, executed with the instructions that the processor supports.
struct Call<'a> {
    interpreter: &'a mut Interpreter<f64>,
    role: Role,
    arguments: Arguments<'a, f64>,
    results: &'a mut [f64],
}

impl Kernel<f64> for Call<'_> {
    type Output = Result<(), program::Singular>;

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) -> Self::Output {
        self.interpreter
            .call_in::<N>(self.role, self.arguments, self.results)
    }
}

/// The arguments of a call without accelerations.
pub(super) fn at<'a>(t: f64, q: &'a [f64], v: &'a [f64], u: &'a [f64]) -> Arguments<'a, f64> {
    Arguments { t, q, v, u, a: &[] }
}
