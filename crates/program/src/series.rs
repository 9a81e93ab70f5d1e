//! Taylor series of the motion, by recurrences on their coefficients.
//!
//! A [`Series`] is a list of [`Row`]s, each a quantity along the motion: a coordinate, a sine, a force. A row is
//! represented by its Taylor coefficients in time at the start of a step, and each operation has a recurrence that
//! computes one coefficient from those before it. The last rows are residuals of the equations of motion,
//!
//! ```text
//! Rᵢ = Σ w ∂p/∂qᵢ p̈ − Qᵢ
//! ```
//!
//! in which the coefficient of order k of the accelerations occurs linearly and with the same matrix at every order: the
//! mass matrix at the start of the step. So the accelerations follow order by order from one factored matrix, and velocity
//! products, which the recurrences produce, are never written out. [`Expander`] computes the coefficients over any type of
//! number; the rows are derived from a machine, and proved to obey its equations, in `lagrangian-mechanics`.
//!
//! Sources of the recurrences: R. E. Moore, *Interval Analysis*, 1966, ch. 11; A. Griewank and A. Walther, *Evaluating
//! Derivatives*, 2nd ed., 2008, ch. 13.

mod closed;
mod composition;
mod expand;
mod gradients;
mod recurrence;
mod rows;
mod work;

use std::fmt;

use lagrangian_symbolic::{Function as Call, Rational};

use crate::{Cost, Program, Role};

pub use closed::{ContactRows, ContactSeries, ContactState};
pub use composition::{ChainStep, Composition, Source};
pub use expand::Expander;
pub use lagrangian_scalar::series::{MOST_IN_ONE_SUM, is_inverse};
pub use recurrence::{Arithmetic, Coefficient, Convolution, Order, Stream, TermOrder};

/// The index of a row in [`Series::rows`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RowId(pub u32);

impl RowId {
    /// Its index in the list.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A quantity along the motion. Operands are earlier rows, except for the partner of a pair, which may follow.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Row {
    /// A rational number.
    Number(Rational),
    /// π.
    Pi,
    /// A parameter.
    Parameter(u32),
    /// A function of constants, computed once for given parameters.
    Constant(Call, RowId, RowId),
    /// An input, which is constant during a step.
    Input(u32),
    /// The time.
    Time,
    /// A coordinate.
    Coordinate(u32),
    /// The rate of a coordinate.
    Rate(u32),
    /// An unknown: the acceleration of a coordinate; indices beyond the coordinates are the multipliers of constraints.
    Acceleration(u32),
    /// The derivative with respect to time of a row of positions, or of rates.
    First(RowId),
    /// The second derivative.
    Second(RowId),
    /// Σ coefficient·row; the coefficients are constant, and 1 if absent.
    Sum(Vec<(Option<RowId>, RowId)>),
    /// a·b.
    Product(RowId, RowId),
    /// a².
    Square(RowId),
    /// a/b.
    Quotient(RowId, RowId),
    /// √a.
    Sqrt(RowId),
    /// sin a, with the row of cos a.
    Sin(RowId, RowId),
    /// cos a, with the row of sin a.
    Cos(RowId, RowId),
    /// sinh a, with the row of cosh a.
    Sinh(RowId, RowId),
    /// cosh a, with the row of sinh a.
    Cosh(RowId, RowId),
    /// tanh a, with the row of 1 − tanh² a, which follows.
    Tanh(RowId, RowId),
    /// 1 − y² of the row of a hyperbolic tangent.
    TanhSlope(RowId),
    /// e to a power.
    Exp(RowId),
    /// a to a constant power.
    Power(RowId, RowId),
    /// A function `f` of the first row whose derivative is 1 over the second: ln, asin, acos, atan.
    Primitive(Call, RowId, RowId),
    /// atan2(y, x), with the row of x² + y².
    Atan2(RowId, RowId, RowId),
}

/// The variables that a row depends on, by the latest of all its operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Level {
    /// Parameters.
    Constant,
    /// Time, coordinates, inputs.
    Position,
    /// Rates.
    Rate,
    /// Accelerations.
    Acceleration,
}

/// The Taylor series of a machine's motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// The rows, operands before their users.
    pub rows: Vec<Row>,
    /// The level of each row.
    pub levels: Vec<Level>,
    /// For each row the unknowns that change it at its own level: coordinates for positions, accelerations for rows
    /// that depend on these.
    pub depends: Vec<Vec<u32>>,
    /// For each row whether it is the time or a sum that grows with it, so that its rounding error is tracked.
    pub exact: Vec<bool>,
    /// The rows of the residuals, one for each coordinate and one for each constraint, in the order of the unknowns.
    pub residuals: Vec<RowId>,
    /// The number of coordinates.
    pub coordinates: usize,
    /// The number of parameters.
    pub parameters: usize,
    /// The number of inputs.
    pub inputs: usize,
    /// Whether a row of rates is differentiated. Then all of them are computed one order ahead of the accelerations, and like positions they are
    /// corrected once these are known.
    pub rates_are_ahead: bool,
    /// Whether the matrix of the unknowns is symmetric: that of a machine with a contact that slips is not, and [`Expander`] alone computes such a series.
    pub is_symmetric: bool,
}

impl Series {
    /// The number of coordinates.
    pub fn dimension(&self) -> usize {
        self.coordinates
    }

    /// The number of unknowns at each order: accelerations, and multipliers of constraints.
    pub fn unknowns(&self) -> usize {
        self.residuals.len()
    }

    /// Whether it is short enough for straight-line code that compiles in seconds.
    pub fn is_short(&self) -> bool {
        let gradients: usize = self.depends.iter().map(Vec::len).sum();
        gradients + 4 * self.rows.len() <= MOST_STRAIGHT
    }

    /// Whether a root or a power of a row that varies occurs: it may pass zero, where the series continues on another branch.
    pub fn has_roots(&self) -> bool {
        let rows = self.rows.iter().zip(&self.levels);
        let mut varying = rows.filter(|(_, level)| **level > Level::Constant);
        varying.any(|(row, _)| matches!(row, Row::Sqrt(_) | Row::Power(..)))
    }

    /// How many orders a row is ahead of the accelerations of a round.
    pub fn lead(&self, row: RowId) -> usize {
        match self.level(row) {
            Level::Constant | Level::Position => 2,
            Level::Rate if self.rates_are_ahead => 1,
            Level::Rate | Level::Acceleration => 0,
        }
    }

    /// The time of a step with 20 coefficients in processor cycles, by which one of several forms of the equations is chosen.
    ///
    /// A product of series with 20 coefficients takes 210 multiplications. The matrix of the unknowns is made from the gradients of
    /// rows: 5 cycles for each entry of a gradient. It is inverted once, by as many multiplications as the cube of the unknowns.
    pub fn cycles(&self) -> f64 {
        let gradients: usize = self.depends.iter().map(Vec::len).sum();
        let unknowns = self.unknowns() as f64;
        CYCLES_OF_PRODUCT * self.products()
            + CYCLES_OF_GRADIENT * gradients as f64
            + CYCLES_OF_MULTIPLICATION * unknowns * unknowns * unknowns
    }

    /// Whether the sums for the effect of accelerations on forces begin with the rest of the force: the dependency chain, which bounds short series, is an
    /// addition shorter. Several trajectories of a machine with more of them run faster if these sums do not wait for anything.
    pub fn adds_to_forces(&self) -> bool {
        let rows = self
            .streams()
            .into_iter()
            .zip(&self.levels)
            .zip(&self.depends);
        let rows = rows.filter(|((streams, level), _)| {
            **level == Level::Acceleration && *streams != [false; 2]
        });
        rows.map(|(_, depends)| depends.len()).sum::<usize>() <= MOST_ADDED
    }

    /// The number of products of series at one order: a square counts half, a sine with its cosine two.
    pub fn products(&self) -> f64 {
        let of_row = |row: &Row| match row {
            Row::Product(a, b) | Row::Quotient(a, b) => {
                let varies = |row: &RowId| self.levels[row.index()] > Level::Constant;
                f64::from(varies(a) && varies(b))
            }
            Row::Square(_) | Row::Sqrt(_) | Row::TanhSlope(_) => 0.5,
            Row::Sin(..) | Row::Cos(..) | Row::Sinh(..) | Row::Cosh(..) => 1.0,
            Row::Tanh(..) | Row::Exp(_) | Row::Primitive(..) => 1.0,
            Row::Power(..) => 2.0,
            Row::Atan2(..) => 3.0,
            _ => 0.0,
        };
        let varying = self.rows.iter().zip(&self.levels);
        let varying = varying.filter(|(_, level)| **level > Level::Constant);
        varying.map(|(row, _)| of_row(row)).sum()
    }

    /// The cost of a step by this series, with 12 and with 20 coefficients of the accelerations, in twelfths of a step of `dop853`, which has twelve
    /// evaluations of the accelerations. `None` if the program has no accelerations.
    ///
    /// Both are estimated from counts of operations, with the projection onto constraints and all else that happens once in a step. Measured
    /// costs are in `docs/benchmarks.md`, with the method that a run chooses.
    pub fn cost(&self, program: &Program) -> Option<[f64; 2]> {
        let expansion = self.expansion();
        let of_order = |order: usize| {
            let of_step = expansion.cycles(order) + self.rest_of_step(program, order);
            Some(of_step / self.evaluation(program, order)?)
        };
        let [coarse, fine] = ORDERS.map(of_order);
        Some([coarse?, fine?])
    }

    /// What the powers of an energy balance add, in the same unit: to an evaluation, in which they are computed once, and to a step by this series with 12 and with
    /// 20 coefficients, within which they are integrated by a quadrature.
    ///
    /// At each of its nodes the quadrature also needs the state and the accelerations there.
    pub fn cost_of_powers(&self, program: &Program) -> Option<[f64; 3]> {
        let powers = program.costs_of_powers().map(cycles_alone);
        let powers = CYCLES_OF_CALL + powers.sum::<f64>();
        let of_step = |order: usize| {
            let state = CYCLES_OF_TERM * order as f64 * self.coordinates as f64;
            let of_nodes = NODES * (CYCLES_OF_NODE + state + powers);
            Some(of_nodes / self.evaluation(program, order)?)
        };
        let [coarse, fine] = ORDERS.map(of_step);
        Some([
            powers / self.evaluation(program, ORDERS[1])?,
            coarse?,
            fine?,
        ])
    }

    /// The time of a step by this series besides its expansion to so many coefficients of the accelerations, in processor cycles.
    fn rest_of_step(&self, program: &Program, order: usize) -> f64 {
        let n = self.coordinates as f64;
        let end = CYCLES_OF_TERM * n * (order + 2) as f64;
        end + CYCLES_OF_END * n + CYCLES_OF_STEP + projection(program, order)
    }

    /// The time of a twelfth of a step of `dop853`, in processor cycles, at the tolerances at which series have so many coefficients.
    fn evaluation(&self, program: &Program, order: usize) -> Option<f64> {
        let accelerations = program.function(Role::Accelerations)?.cost();
        let n = self.coordinates as f64;
        let of_stage = CYCLES_OF_STAGE + CYCLES_OF_STAGE_SUMS * n;
        Some(cycles_alone(accelerations) + of_stage + projection(program, order) / STAGES)
    }
}

/// The time of a single call, in processor cycles.
fn cycles_alone(cost: Cost) -> f64 {
    cost.single_call() as f64 / 10.0
}

/// The time of the projection of the end of a step, in processor cycles: calls of its function, and the comparison of residuals with the terms of their rows.
fn projection(program: &Program, order: usize) -> f64 {
    let m = program.constraints.len();
    if m == 0 {
        return 0.0;
    }
    let function = program.function(Role::Projection);
    // Without one, the same elimination is done by loops.
    let function = function.or_else(|| program.function(Role::Accelerations));
    let once = function.map_or(0.0, |function| cycles_alone(function.cost()));
    // One at the end, and one after each correction of the coordinates, which leaves about the square of their error.
    let calls = if order == ORDERS[0] { 3.0 } else { 2.0 };
    let elements = (m * program.dimension()) as f64;
    let residuals = CYCLES_OF_ELEMENT * elements + CYCLES_OF_ROW * m as f64;
    calls * once + residuals + CYCLES_OF_PROJECTION
}

/// The numbers of coefficients of the accelerations for which costs are estimated.
const ORDERS: [usize; 2] = [12, 20];

/// The number of evaluations in a step of `dop853`.
const STAGES: f64 = 12.0;

/// The time of a multiplication, in processor cycles.
const CYCLES_OF_MULTIPLICATION: f64 = 0.4;

/// The time of a product of series with 20 coefficients.
const CYCLES_OF_PRODUCT: f64 = 210.0 * CYCLES_OF_MULTIPLICATION;

/// The time that an entry of a gradient takes in a step, fitted to measured steps.
const CYCLES_OF_GRADIENT: f64 = 5.0;

/// The number of evaluations of powers in a step by series: the nodes of the quadrature but the first, and the end.
const NODES: f64 = 15.0;

/// The time of a node besides: its powers wait for its state, and that for its sums. And the time to call the functions of powers.
const CYCLES_OF_NODE: f64 = 100.0;
const CYCLES_OF_CALL: f64 = 45.0;

/// The time that a term of a coordinate takes for the sums of its value, its rate and its acceleration: six instructions for four coordinates.
const CYCLES_OF_TERM: f64 = 0.75;

/// The time of a step by series for each coordinate besides these sums, and what it takes besides: its length from the last coefficients, the end
/// as a compensated sum, and the comparison of the accelerations there. Most of it waits for what was just computed.
const CYCLES_OF_END: f64 = 20.0;
const CYCLES_OF_STEP: f64 = 400.0;

/// The time of a stage of `dop853`, with a twelfth of what happens once in a step: the sums of a stage wait for the accelerations of the one before, and these
/// for the sums. And the time of its sums for each coordinate.
const CYCLES_OF_STAGE: f64 = 130.0;
const CYCLES_OF_STAGE_SUMS: f64 = 12.0;

/// The time of the projection of a step besides the calls of its function, for each element of the matrix of the constraints, for each row, and
/// altogether: residuals are compared with the terms of their rows before and after.
const CYCLES_OF_ELEMENT: f64 = 10.0;
const CYCLES_OF_ROW: f64 = 100.0;
const CYCLES_OF_PROJECTION: f64 = 100.0;

/// Why the motion of a machine has no Taylor series here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoSeries {
    /// A function that has no recurrence, or whose recurrence does not hold on both sides of a kink.
    Function(Call),
    /// Coordinates that are approximated.
    Approximations,
    /// Constraints of velocities.
    Constraints,
    /// Contacts with friction.
    Friction,
    /// Accelerations that do not occur linearly in the forces.
    NotLinear,
    /// All contacts yield, or are those of polygons: the motion has no series while one is closed.
    Contacts,
    /// More rows than allowed.
    TooLarge,
    /// The series was not proved to obey the equations of motion.
    Unproved,
}

impl fmt::Display for NoSeries {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            NoSeries::Function(call) => {
                write!(
                    f,
                    "`{}` of the motion has no Taylor series here",
                    call.name()
                )
            }
            NoSeries::Approximations => f.write_str("it has coordinates that are approximated"),
            NoSeries::Constraints => f.write_str("it has constraints of velocities"),
            NoSeries::Friction => f.write_str("it has contacts with friction"),
            NoSeries::Contacts => f.write_str("its contacts yield, or have gaps with kinks"),
            NoSeries::NotLinear => f.write_str("its forces depend on accelerations"),
            NoSeries::TooLarge => write!(f, "its series has more than {MOST_ROWS} rows"),
            NoSeries::Unproved => {
                f.write_str("its series could not be proved to obey the equations of motion")
            }
        }
    }
}

impl std::error::Error for NoSeries {}

/// The largest number of derivatives of forces for which their sums [begin with the rest](Series::adds_to_forces).
const MOST_ADDED: usize = 16;

/// The largest number of operations of a series that is written as straight-line code.
const MOST_STRAIGHT: usize = 20_000;

/// The largest number of rows of a series.
pub const MOST_ROWS: usize = 100_000;
