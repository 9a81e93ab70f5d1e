//! Steps by Taylor series as machine code: the coefficients of the motion.
//!
//! | file | contents |
//! | --- | --- |
//! | `series/record.rs`, `series/recurrences.rs`, `series/solution.rs` | the operations of the interpreter of series, recorded |
//! | `series/memory.rs` | the places of numbers |
//! | `emit/orders.rs` | the loop over orders, and the sums over orders in registers |
//! | `series/several.rs` | calls of several states |
//!
//! The code consists of three parts, and the matrices of the unknowns are factored between the first two by the same function as in the
//! interpreter. It does the operations of the interpreter in the same order, so coefficients have the same bits. Only sums and products with numbers that
//! are zero in every step are left out, which decide on nothing but the sign of a zero; so coefficients that are 0 are made positive.

pub(crate) mod memory;
mod record;
mod recurrences;
mod several;
mod solution;

use std::sync::Arc;

use lagrangian_native::Number;
use lagrangian_program::series::{Expander, RowId, Series};
use lagrangian_scalar::{Kernel, Scalar, series as steps};

use super::Level;
use super::code::{Executable, Layout, Workspace};
use super::emit::{HEADER, Orders, assemble, assemble_orders};
use super::library::Library;
use super::lower::Arithmetic;
use super::unavailable::Unavailable;
use super::work::{Work, operations_of_series};
use memory::NUMBERS;
use record::{Factored, Recorded, record};
pub use several::SeriesSeveral;

/// The largest number of operations that are recorded.
const MOST: usize = 100_000;

/// The series of a machine as machine code, for one state or several, any parameters and any number of orders.
#[derive(Debug)]
pub struct SeriesCode {
    layout: Layout,
    /// Values, first accelerations, later orders.
    parts: [Executable; 3],
    blocks: Vec<Factored>,
    /// The constants, and where each is.
    constants: Vec<(RowId, u32)>,
    /// Where the time, the coordinates, their rates and the inputs begin, and how many there are of each.
    arguments: [(usize, usize); 4],
    /// Where the records begin, and their length.
    records: usize,
    stride: usize,
    /// Where the coefficients of coordinates begin in a record.
    motion: usize,
    /// The bytes of the workspace.
    workspace: usize,
    work: Work,
}

impl SeriesCode {
    /// Compiles a series.
    ///
    /// # Errors
    /// If machine code is not available here, or the series is too long.
    pub fn new(series: &Series) -> Result<SeriesCode, Unavailable> {
        let level = Level::here().ok_or(Unavailable::Processor)?;
        SeriesCode::at(series, level)
    }

    /// Compiles a series for a processor of this level.
    ///
    /// # Errors
    /// If the processor lacks the level, or the series is too long.
    pub fn at(series: &Series, level: Level) -> Result<SeriesCode, Unavailable> {
        SeriesCode::of(series, Library::one(level))
    }

    /// Compiles a series for 4 or 8 states at once, each with its own parameters.
    ///
    /// # Errors
    /// If machine code is not available here, or not for this number of states, or the series is too long.
    pub fn for_lanes(series: &Series, lanes: usize) -> Result<SeriesCode, Unavailable> {
        let level = Level::here().ok_or(Unavailable::Processor)?;
        let layout = Library::several(level, lanes, false).ok_or(Unavailable::Processor)?;
        SeriesCode::of(series, layout)
    }

    /// Compiles a series for a layout that [`Library::one`] or [`Library::several`] returned, where each state has its own parameters.
    ///
    /// # Errors
    /// If the processor lacks the level, or the series is too long.
    pub fn of(series: &Series, layout: Layout) -> Result<SeriesCode, Unavailable> {
        let level = layout.level;
        if layout.known_stride != layout.stride || !Level::all().any(|own| own == level) {
            return Err(Unavailable::Processor);
        }
        if operations_of_series(series) > MOST {
            return Err(Unavailable::TooLong);
        }
        let width = match level {
            _ if layout.lanes > 1 => 1,
            Level::Avx512 => 8,
            Level::Avx2 => 4,
        };
        let Recorded {
            parts: [values, first, later],
            memory,
            blocks,
        } = record(series, width);
        let [positions, others, rates] = &memory.packs;
        let packs = [positions.as_slice(), others.as_slice()].concat();
        let (records, stride) = (memory.records(), memory.stride());
        let orders = Orders {
            packs: [&packs, rates],
            second: records + 2 * stride,
            stride,
        };
        let assembled = [
            assemble(&values, Arithmetic::Fused, layout),
            assemble(&first, Arithmetic::Fused, layout),
            assemble_orders(&later, &orders, layout),
        ];
        let (mut work, mut slots) = (Work::default(), 0);
        let mut parts = Vec::new();
        for part in assembled {
            let part = part.map_err(|error| Unavailable::Encoding(error.to_string()))?;
            work.instructions += part.work.instructions;
            work.evictions += part.work.evictions;
            work.looks += part.work.looks;
            slots = slots.max(part.workspace);
            parts.push(Executable::new(&part)?);
        }
        let [values, first, later] = <[Executable; 3]>::try_from(parts)
            .map_err(|_| Unavailable::Encoding("three parts".to_owned()))?;
        let n = series.dimension();
        let inputs = [
            (memory.time(), 2),
            (memory.coordinates(), n),
            (memory.velocities(), n),
            (memory.inputs(), series.inputs),
        ];
        Ok(SeriesCode {
            layout,
            parts: [values, first, later],
            blocks,
            arguments: inputs.map(|(at, count)| (at as usize, count)),
            records: records as usize,
            stride: stride as usize,
            motion: memory.motion() as usize,
            workspace: HEADER + slots * layout.width(),
            work,
            constants: memory.constants,
        })
    }

    /// The amount of work of compiling it.
    pub fn work(&self) -> Work {
        self.work
    }

    /// Its length in bytes, including constants.
    pub fn length(&self) -> usize {
        self.parts.iter().map(Executable::length).sum()
    }

    /// The addresses of its parts in memory.
    pub fn addresses(&self) -> [std::ops::Range<usize>; 3] {
        std::array::from_fn(|part| self.parts[part].addresses())
    }
}

/// A series with the values of parameters, to be expanded to a number of orders.
#[derive(Clone, Debug)]
pub struct SeriesRunning {
    code: Arc<SeriesCode>,
    /// The number of coefficients of a coordinate.
    width: usize,
    memory: Workspace,
    workspace: Workspace,
}

/// Numbers that follow from an order `n`: `n`, `1/n`, and `n (n − 1)` as a divisor.
struct OfOrder(usize);

impl Kernel<f64> for OfOrder {
    type Output = [f64; 4];

    #[inline(always)]
    fn run<N: Scalar<Stored = f64>>(self) -> [f64; 4] {
        let n = self.0 as i64;
        let [high, low] = N::divisor((n * (n - 1)).max(1));
        let numbers = [N::from_ratio(n, 1), N::from_ratio(1, n.max(1)), high, low];
        numbers.map(|x| x.store())
    }
}

/// Factors the matrices of the unknowns, of one state or of several; false if one is singular.
struct Factor<'a, T> {
    blocks: &'a [Factored],
    numbers: &'a mut [T],
}

impl<T: Copy> Kernel<T> for Factor<'_, T> {
    type Output = bool;

    #[inline(always)]
    fn run<N: Scalar<Stored = T>>(self) -> bool {
        for block in self.blocks {
            let matrix = &mut self.numbers[block.matrix as usize..][..block.count * block.count];
            if steps::factor::<N>(block.count, block.held, matrix).is_err() {
                return false;
            }
        }
        true
    }
}

impl SeriesRunning {
    /// The series of an expander, with its parameters and its number of orders.
    ///
    /// # Panics
    /// If the code is for several states.
    pub fn new(code: Arc<SeriesCode>, expander: &Expander<f64>) -> SeriesRunning {
        assert_eq!(code.layout.stride, 1, "code for one state");
        let width = expander.order() + 2;
        let mut memory = Workspace::default();
        let numbers = memory.numbers(code.records + code.stride * width);
        for (row, at) in &code.constants {
            numbers[*at as usize] = expander.value(*row);
        }
        for n in 0..width {
            let record = &mut numbers[code.records + code.stride * n..];
            for (at, x) in NUMBERS.into_iter().zip(f64::run(OfOrder(n))) {
                record[at as usize] = x;
            }
        }
        let mut workspace = Workspace::default();
        workspace.at_least(code.workspace);
        SeriesRunning {
            code,
            width,
            memory,
            workspace,
        }
    }

    /// The number of coefficients of a coordinate.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Expands the motion through a state, at a time that is the sum of two numbers. Row `j` of `coefficients` becomes the coefficients of order `j` of all
    /// coordinates; from the second one on, a zero is positive. Returns false if a coefficient is not finite, or the mass matrix cannot be inverted, or lengths do not fit; the caller
    /// must then use the interpreter, for the coefficients or for the error.
    pub fn expand<V: AsMut<[f64]>>(
        &mut self,
        t: [f64; 2],
        [q, v, u]: [&[f64]; 3],
        coefficients: &mut [V],
    ) -> bool {
        let code = &*self.code;
        let numbers = self.memory.numbers(code.records + code.stride * self.width);
        for ((at, count), values) in code.arguments.into_iter().zip([&t, q, v, u]) {
            if values.len() != count {
                return false;
            }
            numbers[at..at + count].copy_from_slice(values);
        }
        if coefficients.len() != self.width || self.width < 4 {
            return false;
        }
        let first = code.records + code.stride;
        let workspace = self.workspace.at_least(code.workspace);
        let run = |part: usize, numbers: &mut [f64], orders: usize| {
            let at = numbers.as_mut_ptr();
            // SAFETY: the code of a part is a function of this signature, written by `assemble` and `assemble_orders`. It reads and writes numbers of the
            // step, which are before the records, and records from the first one on: up to the second one, and with each later order up to
            // the next one, of which there are `width`, the first being that of order 0. The memory has that many, with the alignment of
            // registers, and so has the workspace. It calls only functions of `external.rs`.
            unsafe {
                let entry = code.parts[part].series_entry();
                entry(at, at, at.add(first), orders, at, workspace);
            }
        };
        run(0, numbers, 0);
        let factored = f64::run(Factor {
            blocks: &code.blocks,
            numbers: &mut *numbers,
        });
        if !factored {
            return false;
        }
        run(1, numbers, 0);
        run(2, numbers, self.width - 3);
        let n = q.len();
        let mut zero = 0.0;
        for (j, row) in coefficients.iter_mut().enumerate() {
            let row = row.as_mut();
            if row.len() != n {
                return false;
            }
            let start = code.records + code.stride * j + code.motion;
            match j {
                0 => row.copy_from_slice(q),
                1 => row.copy_from_slice(v),
                _ => {
                    for (to, x) in row.iter_mut().zip(&numbers[start..start + n]) {
                        *to = x + 0.0;
                    }
                }
            }
            // A product with 0 is not 0 if the factor is not finite.
            zero = row.iter().fold(zero, |sum, x| sum + 0.0 * x);
        }
        zero == 0.0
    }
}
