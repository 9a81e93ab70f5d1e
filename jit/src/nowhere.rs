//! What stands for code on processors for which there is none: types without values.

use std::convert::Infallible;
use std::marker::PhantomData;

use lagrangian_native::Lanes;
use lagrangian_program::{Arguments, Function};

use super::Level;
use super::arguments::SeveralArguments;
use super::unavailable::Unavailable;
use super::work::Work;

/// A function as machine code: there is none.
#[derive(Debug)]
pub struct Code(Infallible);

/// For how many states at once code is, and how their numbers lie in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Layout {
    /// The instructions that the processor has.
    pub level: Level,
    /// How many states an instruction works on.
    pub lanes: usize,
    /// From a number of a state to its next, in numbers.
    pub stride: usize,
    /// From a prepared value to the next, in numbers.
    pub known_stride: usize,
}

/// Where code keeps what its registers have no place for.
#[derive(Clone, Debug, Default)]
pub struct Workspace(());

/// What a call reads.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a>(PhantomData<&'a f64>);

impl<'a> Rows<'a> {
    /// Those of one state.
    pub fn of_one(_: &'a Arguments<'a, f64>, _: &'a [f64], _: [&'a [f64]; 2]) -> Rows<'a> {
        Rows(PhantomData)
    }

    /// Those of N states.
    pub fn of_several<const N: usize>(
        _: &'a SeveralArguments<'a, N>,
        _: &'a [f64],
        _: usize,
        _: [&'a [Lanes<N>]; 2],
    ) -> Rows<'a> {
        Rows(PhantomData)
    }
}

/// Workspace for the results of one or several states.
pub struct Results<'a>(PhantomData<&'a mut f64>);

impl<'a> From<&'a mut [f64]> for Results<'a> {
    fn from(_: &'a mut [f64]) -> Results<'a> {
        Results(PhantomData)
    }
}

impl<'a, const N: usize> From<&'a mut [Lanes<N>]> for Results<'a> {
    fn from(_: &'a mut [Lanes<N>]) -> Results<'a> {
        Results(PhantomData)
    }
}

impl Code {
    /// Compiles a function.
    ///
    /// # Errors
    /// Always.
    pub fn new(_: &Function, _: bool, _: Layout) -> Result<Code, Unavailable> {
        Err(Unavailable::Processor)
    }

    /// How much work compiling was.
    pub fn work(&self) -> Work {
        match self.0 {}
    }

    /// How many bytes it has.
    pub fn length(&self) -> usize {
        match self.0 {}
    }

    /// Where it is in memory.
    pub fn addresses(&self) -> std::ops::Range<usize> {
        match self.0 {}
    }

    pub(crate) fn run(
        &self,
        _: &mut Workspace,
        _: &Rows<'_>,
        _: usize,
        _: &mut Results<'_>,
    ) -> Option<u32> {
        match self.0 {}
    }
}
