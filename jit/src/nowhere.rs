//! Placeholders for machine code on unsupported processors: types without values.

use std::convert::Infallible;
use std::marker::PhantomData;
use std::sync::Arc;

use lagrangian_native::Lanes;
use lagrangian_program::series::{Expander, Series};
use lagrangian_program::{Arguments, Function};

use super::Level;
use super::arguments::SeveralArguments;
use super::unavailable::Unavailable;
use super::work::Work;

/// A function as machine code, which cannot exist here.
#[derive(Debug)]
pub struct Code(Infallible);

/// The number of states that code evaluates at once, and the arrangement of their numbers in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Layout {
    /// The instructions that the processor has.
    pub level: Level,
    /// The number of states that an instruction processes.
    pub lanes: usize,
    /// The distance from a number of a state to its next, in numbers.
    pub stride: usize,
    /// The distance from a prepared value to the next, in numbers.
    pub known_stride: usize,
}

/// Memory for values that do not fit into registers.
#[derive(Clone, Debug, Default)]
pub struct Workspace(());

/// The arguments of a call.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a>(PhantomData<&'a f64>);

impl<'a> Rows<'a> {
    /// The arguments for one state.
    pub fn of_one(_: &'a Arguments<'a, f64>, _: &'a [f64], _: [&'a [f64]; 2]) -> Rows<'a> {
        Rows(PhantomData)
    }

    /// The arguments for N states.
    pub fn of_several<const N: usize>(
        _: &'a SeveralArguments<'a, N>,
        _: &'a [f64],
        _: usize,
        _: [&'a [Lanes<N>]; 2],
    ) -> Rows<'a> {
        Rows(PhantomData)
    }
}

/// Memory for the results of one or several states.
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

    /// The amount of work of compiling it.
    pub fn work(&self) -> Work {
        match self.0 {}
    }

    /// Its length in bytes.
    pub fn length(&self) -> usize {
        match self.0 {}
    }

    /// Its addresses in memory.
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

/// A series as machine code, which cannot exist here.
#[derive(Debug)]
pub struct SeriesCode(Infallible);

impl SeriesCode {
    /// Compiles a series.
    ///
    /// # Errors
    /// Always.
    pub fn new(_: &Series) -> Result<SeriesCode, Unavailable> {
        Err(Unavailable::Processor)
    }

    /// Compiles a series for a processor of this level.
    ///
    /// # Errors
    /// Always.
    pub fn at(_: &Series, _: Level) -> Result<SeriesCode, Unavailable> {
        Err(Unavailable::Processor)
    }

    /// Compiles a series for several states at once.
    ///
    /// # Errors
    /// Always.
    pub fn for_lanes(_: &Series, _: usize) -> Result<SeriesCode, Unavailable> {
        Err(Unavailable::Processor)
    }

    /// Compiles a series for a layout.
    ///
    /// # Errors
    /// Always.
    pub fn of(_: &Series, _: Layout) -> Result<SeriesCode, Unavailable> {
        Err(Unavailable::Processor)
    }

    /// The amount of work of compiling it.
    pub fn work(&self) -> Work {
        match self.0 {}
    }

    /// Its length in bytes.
    pub fn length(&self) -> usize {
        match self.0 {}
    }

    /// The addresses of its parts in memory.
    pub fn addresses(&self) -> [std::ops::Range<usize>; 3] {
        match self.0 {}
    }
}

/// A series with the values of parameters, which cannot exist here.
#[derive(Clone, Debug)]
pub struct SeriesRunning(Arc<SeriesCode>);

impl SeriesRunning {
    /// The series of an expander.
    pub fn new(code: Arc<SeriesCode>, _: &Expander<f64>) -> SeriesRunning {
        SeriesRunning(code)
    }

    /// The number of coefficients of a coordinate.
    pub fn width(&self) -> usize {
        match self.0.0 {}
    }

    /// Expands the motion through a state.
    pub fn expand<V: AsMut<[f64]>>(&mut self, _: [f64; 2], _: [&[f64]; 3], _: &mut [V]) -> bool {
        match self.0.0 {}
    }
}

/// A series of several states, which cannot exist here.
#[derive(Clone, Debug)]
pub struct SeriesSeveral<const N: usize>(Arc<SeriesCode>);

impl<const N: usize> SeriesSeveral<N> {
    /// The series of an expander.
    pub fn new(code: Arc<SeriesCode>, _: &Expander<f64>) -> Option<Self> {
        Some(SeriesSeveral(code))
    }

    /// The number of coefficients of a coordinate.
    pub fn width(&self) -> usize {
        match self.0.0 {}
    }

    /// Replaces the parameters of a state.
    pub fn put(&mut self, _: usize, _: &Expander<f64>) {
        match self.0.0 {}
    }

    /// Expands the motions through states.
    pub fn expand(
        &mut self,
        _: [Lanes<N>; 2],
        _: [&[Lanes<N>]; 3],
        _: &mut [Vec<Lanes<N>>],
    ) -> u32 {
        match self.0.0 {}
    }
}
