//! Executable code in memory, and calls of it.

use std::marker::PhantomData;

use lagrangian_native::Lanes;
use lagrangian_program::{Arguments, Function};
use memmap2::{Mmap, MmapMut};

use super::arguments::SeveralArguments;
pub use super::emit::Layout;
use super::emit::{Assembled, HEADER, assemble};
use super::lower::{Arithmetic, Base, Lowered};
use super::unavailable::Unavailable;
use super::work::Work;

/// The signature of the code: time, coordinates, velocities, inputs, prepared values, the workspace. The result has a bit for
/// each lane, which is set if its guards hold.
type Entry = unsafe extern "sysv64" fn(
    *const f64,
    *const f64,
    *const f64,
    *const f64,
    *const f64,
    *mut u8,
) -> u32;

/// The signature of the parts of a series: unused, numbers of the step, a record, the number of orders, unused, the workspace.
pub(super) type SeriesEntry =
    unsafe extern "sysv64" fn(*const f64, *mut f64, *mut f64, usize, *const f64, *mut u8) -> u32;

/// A function as machine code.
#[derive(Debug)]
pub struct Code {
    bytes: Executable,
    layout: Layout,
    /// How many numbers of each argument the code reads.
    reads: [usize; READ],
    results: usize,
    workspace: usize,
    work: Work,
}

/// The arguments of a call, as rows of numbers of one state, or of several side by side.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a> {
    /// In the order of `Base`, without the results.
    addresses: [*const f64; READ],
    /// The length of each row, in numbers per state.
    lens: [usize; READ],
    /// The number of states side by side; for prepared values how many numbers there are for each.
    width: usize,
    known_width: usize,
    numbers: PhantomData<&'a [f64]>,
}

/// The number of arguments that are read.
const READ: usize = Base::COUNT - 1;

impl<'a> Rows<'a> {
    /// The arguments for one state.
    #[inline(always)]
    pub fn of_one(
        arguments: &'a Arguments<'a, f64>,
        known: &'a [f64],
        [at_time, at_position]: [&'a [f64]; 2],
    ) -> Rows<'a> {
        let Arguments { t, q, v, u, a } = arguments;
        let rows = [
            std::slice::from_ref(t),
            q,
            v,
            u,
            known,
            a,
            at_time,
            at_position,
        ];
        Rows {
            addresses: rows.map(<[f64]>::as_ptr),
            lens: rows.map(<[f64]>::len),
            width: 1,
            known_width: 1,
            numbers: PhantomData,
        }
    }

    /// The arguments for N states, with this number of values for each prepared value.
    #[inline(always)]
    pub fn of_several<const N: usize>(
        arguments: &'a SeveralArguments<'a, N>,
        known: &'a [f64],
        known_width: usize,
        [at_time, at_position]: [&'a [Lanes<N>]; 2],
    ) -> Rows<'a> {
        let SeveralArguments { t, q, v, u, a } = arguments;
        let nothing: &[Lanes<N>] = &[];
        let rows = [
            std::slice::from_ref(t),
            q,
            v,
            u,
            nothing,
            a,
            at_time,
            at_position,
        ];
        let mut addresses = rows.map(|row| row.as_ptr().cast::<f64>());
        let mut lens = rows.map(<[Lanes<N>]>::len);
        addresses[Base::Known as usize] = known.as_ptr();
        lens[Base::Known as usize] = known.len() / known_width.max(1);
        Rows {
            addresses,
            lens,
            width: N,
            known_width,
            numbers: PhantomData,
        }
    }
}

/// Memory for the results of one or several states.
pub struct Results<'a> {
    address: *mut f64,
    len: usize,
    width: usize,
    numbers: PhantomData<&'a mut [f64]>,
}

impl<'a> From<&'a mut [f64]> for Results<'a> {
    #[inline(always)]
    fn from(numbers: &'a mut [f64]) -> Results<'a> {
        Results {
            address: numbers.as_mut_ptr(),
            len: numbers.len(),
            width: 1,
            numbers: PhantomData,
        }
    }
}

impl<'a, const N: usize> From<&'a mut [Lanes<N>]> for Results<'a> {
    #[inline(always)]
    fn from(numbers: &'a mut [Lanes<N>]) -> Results<'a> {
        Results {
            address: numbers.as_mut_ptr().cast(),
            len: numbers.len(),
            width: N,
            numbers: PhantomData,
        }
    }
}

/// Memory for values that do not fit into registers.
#[derive(Clone, Debug, Default)]
pub struct Workspace(Vec<Line>);

#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Line([u64; 8]);

impl Workspace {
    #[inline(always)]
    pub(super) fn at_least(&mut self, bytes: usize) -> *mut u8 {
        let lines = bytes.div_ceil(size_of::<Line>());
        if self.0.len() < lines {
            self.0.resize(lines, Line([0; 8]));
        }
        self.0.as_mut_ptr().cast()
    }

    /// The workspace as so many numbers, which stay what they were.
    pub(super) fn numbers(&mut self, count: usize) -> &mut [f64] {
        let numbers = self.at_least(count * size_of::<f64>()).cast::<f64>();
        // SAFETY: the lines hold at least this many numbers, for which any bits are valid, and are borrowed as long as the result.
        unsafe { std::slice::from_raw_parts_mut(numbers, count) }
    }
}

impl Workspace {
    /// The workspace as so many numbers of each of N states, which stay what they were.
    pub(super) fn lanes<const N: usize>(&mut self, count: usize) -> &mut [Lanes<N>] {
        let numbers = self
            .at_least(count * size_of::<Lanes<N>>())
            .cast::<Lanes<N>>();
        // SAFETY: the lines hold at least this many rows of N numbers, for which any bits are valid, are aligned to more than these, and are borrowed as long as
        // the result.
        unsafe { std::slice::from_raw_parts_mut(numbers, count) }
    }
}

/// Bytes of code that can be executed.
#[derive(Debug)]
pub(super) struct Executable {
    /// Never writable while executable.
    pages: Mmap,
    entry: usize,
    length: usize,
}

impl Executable {
    /// Copies code to pages of its own.
    pub(super) fn new(assembled: &Assembled) -> Result<Executable, Unavailable> {
        let length = assembled.bytes.len();
        let mut writable = MmapMut::map_anon(length).map_err(Unavailable::Pages)?;
        writable.copy_from_slice(&assembled.bytes);
        Ok(Executable {
            pages: writable.make_exec().map_err(Unavailable::Pages)?,
            entry: assembled.entry,
            length,
        })
    }

    /// Its length in bytes, including constants.
    pub(super) fn length(&self) -> usize {
        self.length
    }

    /// Its addresses in memory.
    pub(super) fn addresses(&self) -> std::ops::Range<usize> {
        let start = self.pages.as_ptr() as usize;
        start..start + self.pages.len()
    }

    /// The code of a part of a series as a function.
    ///
    /// # Safety
    /// The code must be such a part.
    pub(super) unsafe fn series_entry(&self) -> SeriesEntry {
        // SAFETY: the pages are executable and contain a function at `entry`, of this signature as the caller guarantees.
        unsafe { std::mem::transmute::<*const u8, SeriesEntry>(self.start()) }
    }

    fn start(&self) -> *const u8 {
        self.pages.as_ptr().wrapping_add(self.entry)
    }
}

impl Code {
    /// Compiles a function.
    ///
    /// # Errors
    /// If the system provides no executable pages.
    pub fn new(function: &Function, is_fused: bool, layout: Layout) -> Result<Code, Unavailable> {
        let arithmetic = if is_fused {
            Arithmetic::Fused
        } else {
            Arithmetic::Plain
        };
        let lowered = Lowered::new(function, arithmetic);
        let assembled = assemble(&lowered, arithmetic, layout);
        let assembled = assembled.map_err(|error| Unavailable::Encoding(error.to_string()))?;
        Ok(Code {
            bytes: Executable::new(&assembled)?,
            layout,
            reads: std::array::from_fn(|base| lowered.reads[base] as usize),
            results: lowered.results.len(),
            workspace: HEADER + assembled.workspace * layout.width(),
            work: assembled.work,
        })
    }

    /// The amount of work of compiling it.
    pub fn work(&self) -> Work {
        self.work
    }

    /// Its length in bytes, including constants.
    pub fn length(&self) -> usize {
        self.bytes.length()
    }

    /// Its addresses in memory.
    pub fn addresses(&self) -> std::ops::Range<usize> {
        self.bytes.addresses()
    }

    /// Runs the code; the result has a bit for each lane, which is set if its guards hold. Returns `None` without running if an
    /// argument is too short, if `results` does not have exactly the number of results, or if any of these has a
    /// different number of states than the layout.
    ///
    /// Of the states side by side, as many as the code has lanes are evaluated, starting at `first`.
    #[inline(always)]
    pub(crate) fn run(
        &self,
        workspace: &mut Workspace,
        rows: &Rows<'_>,
        first: usize,
        results: &mut Results<'_>,
    ) -> Option<u32> {
        let Layout {
            lanes,
            stride,
            known_stride,
            ..
        } = self.layout;
        let mut is_other = first + lanes > stride;
        is_other |= rows.width != stride || rows.known_width != known_stride;
        is_other |= results.width != stride || results.len != self.results;
        for (len, least) in rows.lens.iter().zip(&self.reads) {
            is_other |= len < least;
        }
        if is_other {
            return None;
        }
        let workspace = workspace.at_least(self.workspace);
        let at = |base: Base| rows.addresses[base as usize].wrapping_add(first);
        let known = if known_stride < stride {
            // All lanes share one address.
            rows.addresses[Base::Known as usize]
        } else {
            at(Base::Known)
        };
        // SAFETY: the pages are executable and contain a function of this signature at `entry`, written by `assemble`. It reads
        // as many numbers of each argument as `reads` says, a stride apart, and the argument has that many; it writes as many
        // results as there is space for. The workspace has the length that the code requires, and the alignment of its
        // registers. Addresses of arguments that are not read may be arbitrary. It calls only functions of `external.rs`.
        unsafe {
            let entry = std::mem::transmute::<*const u8, Entry>(self.bytes.start());
            let header = workspace.cast::<*const f64>();
            for base in [Base::Accelerations, Base::AtTime, Base::AtPosition] {
                header.add(base as usize).write(at(base));
            }
            let to = workspace.cast::<*mut f64>().add(Base::Results as usize);
            to.write(results.address.wrapping_add(first));
            let held = entry(
                at(Base::Time),
                at(Base::Coordinates),
                at(Base::Velocities),
                at(Base::Inputs),
                known,
                workspace,
            );
            Some(held & ((1 << lanes) - 1))
        }
    }
}
