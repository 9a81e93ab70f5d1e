//! Steps by series of 4 or 8 states at once.

use std::sync::Arc;

use lagrangian_native::{Lanes, Number};
use lagrangian_program::series::Expander;

use super::memory::NUMBERS;
use super::{Factor, OfOrder, SeriesCode};
use crate::code::Workspace;

/// A series of N states, 4 or 8, each with its own parameters, to be expanded to one number of orders.
///
/// The coefficients of a state are those of [`SeriesRunning`](super::SeriesRunning), bit for bit, whatever the other states are.
#[derive(Clone, Debug)]
pub struct SeriesSeveral<const N: usize> {
    code: Arc<SeriesCode>,
    /// The number of coefficients of a coordinate.
    width: usize,
    memory: Workspace,
    workspace: Workspace,
}

impl<const N: usize> SeriesSeveral<N>
where
    Lanes<N>: Number,
{
    /// All states have the parameters of an expander, until [`put`](Self::put) replaces them, and its number of orders. `None` if the code is for
    /// another number of states, or there are fewer orders than the code computes at once.
    pub fn new(code: Arc<SeriesCode>, expander: &Expander<f64>) -> Option<Self> {
        let width = expander.order() + 2;
        if code.layout.stride != N || width < 4 {
            return None;
        }
        let mut memory = Workspace::default();
        let numbers = memory.lanes::<N>(code.records + code.stride * width);
        for n in 0..width {
            let record = &mut numbers[code.records + code.stride * n..];
            for (at, x) in NUMBERS.into_iter().zip(f64::run(OfOrder(n))) {
                record[at as usize] = Lanes::splat(x);
            }
        }
        let mut workspace = Workspace::default();
        workspace.at_least(code.workspace);
        let mut several = SeriesSeveral {
            code,
            width,
            memory,
            workspace,
        };
        for lane in 0..N {
            several.put(lane, expander);
        }
        Some(several)
    }

    /// The number of coefficients of a coordinate.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Replaces the parameters of a state by those of an expander of the same series.
    ///
    /// # Panics
    /// If there is no such state.
    pub fn put(&mut self, lane: usize, expander: &Expander<f64>) {
        let code = &*self.code;
        let numbers = (self.memory).lanes::<N>(code.records + code.stride * self.width);
        for (row, at) in &code.constants {
            numbers[*at as usize][lane] = expander.value(*row);
        }
    }

    /// Expands the motions through these states, at times that are the sums of two numbers, with inputs. Row `j` of `coefficients` becomes the coefficients
    /// of order `j` of all coordinates; from the second one on, a zero is positive.
    ///
    /// The result has a bit for each state, the lowest for the first, which is set if the state has coefficients. Others have meaningless ones: their
    /// motion has to be expanded alone, which gives its coefficients or the error. It is 0 if the mass matrix of any of them cannot be inverted, or
    /// lengths do not fit.
    pub fn expand(
        &mut self,
        t: [Lanes<N>; 2],
        [q, v, u]: [&[Lanes<N>]; 3],
        coefficients: &mut [Vec<Lanes<N>>],
    ) -> u32 {
        let code = &*self.code;
        let numbers = (self.memory).lanes::<N>(code.records + code.stride * self.width);
        for ((at, count), values) in code.arguments.into_iter().zip([&t, q, v, u]) {
            if values.len() != count {
                return 0;
            }
            numbers[at..at + count].copy_from_slice(values);
        }
        let n = q.len();
        if coefficients.len() != self.width || coefficients.iter().any(|row| row.len() != n) {
            return 0;
        }
        self.run(0, 0);
        let code = &*self.code;
        let numbers = (self.memory).lanes::<N>(code.records + code.stride * self.width);
        let factored = Lanes::<N>::run(Factor {
            blocks: &code.blocks,
            numbers: &mut *numbers,
        });
        if !factored {
            return 0;
        }
        self.run(1, 0);
        self.run(2, self.width - 3);
        let code = &*self.code;
        let numbers = (self.memory).lanes::<N>(code.records + code.stride * self.width);
        let mut zero = Lanes::<N>::splat(0.0);
        for (j, row) in coefficients.iter_mut().enumerate() {
            let start = code.records + code.stride * j + code.motion;
            match j {
                0 => row.copy_from_slice(q),
                1 => row.copy_from_slice(v),
                _ => {
                    for (to, x) in row.iter_mut().zip(&numbers[start..start + n]) {
                        for lane in 0..N {
                            to[lane] = x[lane] + 0.0;
                        }
                    }
                }
            }
            for x in row.iter() {
                for lane in 0..N {
                    // A product with 0 is not 0 if the factor is not finite.
                    zero[lane] += 0.0 * x[lane];
                }
            }
        }
        let lanes = zero.0.iter().enumerate();
        lanes.fold(0, |mask, (lane, zero)| {
            mask | u32::from(*zero == 0.0) << lane
        })
    }

    /// Runs a part of the code for all states.
    fn run(&mut self, part: usize, orders: usize) {
        let code = &*self.code;
        let numbers = (self.memory).lanes::<N>(code.records + code.stride * self.width);
        let at = numbers.as_mut_ptr().cast::<f64>();
        let workspace = self.workspace.at_least(code.workspace);
        for first in (0..N).step_by(code.layout.lanes) {
            // SAFETY: as in `SeriesRunning::expand`, with N numbers side by side wherever there is one, of which the code uses as many as it has lanes from the
            // first one on; N is the stride of its layout.
            unsafe {
                let entry = code.parts[part].series_entry();
                let own = at.add(first);
                let record = own.add(N * (code.records + code.stride));
                entry(own, own, record, orders, own, workspace);
            }
        }
    }
}
