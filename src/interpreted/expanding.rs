//! The coefficients of a motion, by the interpreter of series or by machine code.

use std::vec::Vec;

use lagrangian_program::Singular;
use lagrangian_program::series::Expander;

use super::engine::{CompiledSeries, MachineCode};
use super::motion_series::Known;
use crate::Number;
use crate::scalar::{Kernel, Scalar};

/// The memory of expansions, and what executes them.
#[derive(Clone, Debug)]
pub(super) struct Expanding {
    /// The interpreter of the series, for the number of orders of the last expansion.
    expander: Option<Expander<f64>>,
    engine: MachineCode,
    /// Its machine code with parameters; `None` before the first expansion.
    compiled: Option<CompiledSeries>,
}

/// The expansion of a series, executed with the instructions that the processor supports.
struct Expand<'a> {
    expander: &'a mut Expander<f64>,
    at: ([f64; 2], [&'a [f64]; 3]),
}

impl Kernel<f64> for Expand<'_> {
    type Output = Result<(), Singular>;

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) -> Self::Output {
        let (t, [q, v, u]) = self.at;
        self.expander.expand_in::<N>(t, q, v, u)
    }
}

impl Expanding {
    pub(super) fn new(engine: MachineCode) -> Expanding {
        Expanding {
            expander: None,
            engine,
            compiled: None,
        }
    }

    /// The interpreter of the series with the parameters of the machine, after the first expansion.
    #[cfg(feature = "jit")]
    pub(super) fn expander(&self) -> Option<&Expander<f64>> {
        self.expander.as_ref()
    }

    /// Expands the motion of a machine with these parameters through a state: time in two parts, coordinates, rates and inputs.
    pub(super) fn expand(
        &mut self,
        (known, parameters): (&Known, impl FnOnce() -> Vec<f64>),
        at: ([f64; 2], [&[f64]; 3]),
        coefficients: &mut [Vec<f64>],
    ) -> Result<(), Singular> {
        let (Ok(series), Some(order)) = (&known.series, coefficients.len().checked_sub(2)) else {
            return Ok(());
        };
        if self
            .expander
            .as_ref()
            .is_some_and(|last| last.order() != order)
        {
            (self.expander, self.compiled) = (None, None);
        }
        let begin = || Expander::new(series.clone(), &parameters(), order);
        let expander = self.expander.get_or_insert_with(begin);
        let prepare = || known.code.prepared(&self.engine);
        let compiled = self.compiled.get_or_insert_with(prepare);
        if compiled.expand(expander, at, coefficients) {
            return Ok(());
        }
        f64::run(Expand { expander, at })?;
        let [q, v, _] = at.1;
        for (row, start) in coefficients.iter_mut().zip([q, v]) {
            row.copy_from_slice(start);
        }
        for i in 0..q.len() {
            for (row, c) in coefficients.iter_mut().zip(expander.coordinate(i)).skip(2) {
                // Machine code leaves out sums with 0, which decide on the sign of a zero.
                row[i] = *c + 0.0;
            }
        }
        Ok(())
    }
}
