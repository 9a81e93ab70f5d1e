//! Tables of values at instants, interpolated between them: they drive inputs that were measured or drawn by hand.

use core::fmt::{self, Display};
use std::string::String;
use std::sync::Arc;
use std::vec::Vec;

use crate::inputs::InputLaw;
use crate::piece::{NoPiece, Piece};
use crate::{Error, System};

/// How a table interpolates between its rows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Interpolation {
    /// The value of the row before, which holds until the next.
    Hold,
    /// A straight line.
    #[default]
    Linear,
    /// A cubic spline with two continuous derivatives and the not-a-knot condition at its ends: it reproduces cubic polynomials.
    /// C. de Boor, *A Practical Guide to Splines*, rev. ed., 2001, chapter IV.
    Cubic,
}

/// The values of a table before its first row and after its last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Extrapolation {
    /// The value of the first row, or of the last.
    #[default]
    Hold,
    /// No value: a run that goes there ends with an error.
    Error,
    /// The table repeats; its last row is at the instant of the first row of the next period.
    Repeat,
}

/// A function of time given by its values at instants, for [`Simulation::table`](crate::Simulation::table).
///
/// ```
/// use lagrangian::{Extrapolation, Table};
///
/// let torque = Table::linear([0.0, 1.0, 3.0], [0.0, 5.0, 0.0])?;
/// assert_eq!([-1.0, 0.5, 2.0, 9.0].map(|t| torque.value(t)), [0.0, 2.5, 2.5, 0.0]);
/// let again = torque.with_extrapolation(Extrapolation::Repeat)?;
/// assert_eq!(again.value(3.5), 2.5);
/// # Ok::<(), lagrangian::TableError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    name: String,
    between: Interpolation,
    beyond: Extrapolation,
    /// The first instant and the last.
    ends: [f64; 2],
    /// Increasing instants. For values that hold, only the first instant and those at which they change.
    times: Vec<f64>,
    values: Vec<f64>,
    /// The slope of a cubic at each instant.
    slopes: Vec<f64>,
    /// The instants at which it is not smooth enough for methods of high order, and for those of low order; in the first period
    /// if it repeats.
    breaks: [Vec<f64>; 2],
    /// The shortest time between two instants.
    finest: f64,
}

/// Why values at instants do not form a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TableError {
    /// There are no rows.
    Empty,
    /// The numbers of values and times differ.
    Lengths {
        /// The number of times.
        times: usize,
        /// The number of values.
        values: usize,
    },
    /// A time or a value is infinite or not a number.
    NotFinite {
        /// The index of its row.
        row: usize,
    },
    /// A time is not later than the one before it.
    NotLater {
        /// The index of its row.
        row: usize,
    },
    /// A table with one row cannot be repeated.
    NoPeriod,
    /// A cubic spline that is to be repeated does not end where it begins.
    NotPeriodic,
    /// The slopes of a cubic spline overflow.
    TooSteep,
}

impl Display for TableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "a table must have at least one row"),
            Self::Lengths { times, values } => {
                write!(f, "there are {times} times and {values} values")
            }
            Self::NotFinite { row } => {
                write!(f, "row {row} contains a value that is not a finite number")
            }
            Self::NotLater { row } => {
                write!(f, "the time of row {row} is not later than the one before")
            }
            Self::NoPeriod => write!(f, "a table that repeats must have at least two rows"),
            Self::NotPeriodic => write!(
                f,
                "a cubic spline that repeats must end with the value with which it begins"
            ),
            Self::TooSteep => write!(f, "its slopes are too large for floating-point numbers"),
        }
    }
}

impl core::error::Error for TableError {}

/// For methods of at least this order, steps end at every knot of a cubic spline. There the third derivative of the input jumps:
/// a step of length h across it has an error of h⁴, a smooth step of a method of order p one of h^(p + 1), and there are as many
/// such steps as knots, however short the steps are; so up to order 4 nothing is lost.
const ORDER_OF_SPLINES: u32 = 5;

impl Table {
    /// A table of values that hold until the next row.
    ///
    /// # Errors
    /// If the times do not increase, or some number is not finite.
    pub fn hold(
        times: impl Into<Vec<f64>>,
        values: impl Into<Vec<f64>>,
    ) -> Result<Self, TableError> {
        Self::new(Interpolation::Hold, Extrapolation::Hold, times, values)
    }

    /// A table of values with straight lines between them.
    ///
    /// # Errors
    /// As [`hold`](Self::hold).
    pub fn linear(
        times: impl Into<Vec<f64>>,
        values: impl Into<Vec<f64>>,
    ) -> Result<Self, TableError> {
        Self::new(Interpolation::Linear, Extrapolation::Hold, times, values)
    }

    /// A table of values with a cubic spline through them.
    ///
    /// # Errors
    /// As [`hold`](Self::hold).
    pub fn cubic(
        times: impl Into<Vec<f64>>,
        values: impl Into<Vec<f64>>,
    ) -> Result<Self, TableError> {
        Self::new(Interpolation::Cubic, Extrapolation::Hold, times, values)
    }

    /// This table with another rule before its first row and after its last.
    ///
    /// # Errors
    /// If it is to be repeated and cannot be.
    pub fn with_extrapolation(self, beyond: Extrapolation) -> Result<Self, TableError> {
        let name = self.name;
        // For values that hold, the last row may only state when the table ends.
        let (mut times, mut values) = (self.times, self.values);
        if let (Some(time), Some(value)) = (times.last().copied(), values.last().copied())
            && time < self.ends[1]
        {
            times.push(self.ends[1]);
            values.push(value);
        }
        Ok(Self::new(self.between, beyond, times, values)?.named(name))
    }

    /// A table.
    ///
    /// # Errors
    /// If the times do not increase, if some number is not finite, or if it is to be repeated and cannot be.
    pub fn new(
        between: Interpolation,
        beyond: Extrapolation,
        times: impl Into<Vec<f64>>,
        values: impl Into<Vec<f64>>,
    ) -> Result<Self, TableError> {
        let (times, values): (Vec<f64>, Vec<f64>) = (times.into(), values.into());
        if times.len() != values.len() {
            return Err(TableError::Lengths {
                times: times.len(),
                values: values.len(),
            });
        }
        for (row, (time, value)) in times.iter().zip(&values).enumerate() {
            if !(time.is_finite() && value.is_finite()) {
                return Err(TableError::NotFinite { row });
            }
            if row > 0 && *time <= times[row - 1] {
                return Err(TableError::NotLater { row });
            }
        }
        let [Some(first), Some(last)] = [times.first().copied(), times.last().copied()] else {
            return Err(TableError::Empty);
        };
        if beyond == Extrapolation::Repeat {
            if first == last {
                return Err(TableError::NoPeriod);
            }
            if between == Interpolation::Cubic && values.first() != values.last() {
                return Err(TableError::NotPeriodic);
            }
        }
        let gaps = times.windows(2).map(|pair| pair[1] - pair[0]);
        let mut table = Self {
            name: "the table of an input".into(),
            between,
            beyond,
            ends: [first, last],
            finest: gaps.fold(f64::INFINITY, f64::min),
            times,
            values,
            slopes: Vec::new(),
            breaks: [Vec::new(), Vec::new()],
        };
        match between {
            Interpolation::Hold => table.keep_changes(),
            Interpolation::Linear => {}
            Interpolation::Cubic => {
                table.slopes = match beyond {
                    Extrapolation::Repeat => periodic_slopes(&table.times, &table.values),
                    _ => slopes(&table.times, &table.values),
                };
                if table.slopes.iter().any(|slope| !slope.is_finite()) {
                    return Err(TableError::TooSteep);
                }
            }
        }
        table.breaks = table.find_breaks();
        Ok(table)
    }

    /// This table under a name, for messages: `the table drive.csv of input u`.
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            ..self
        }
    }

    /// Its name in messages.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// How it interpolates between its rows.
    pub fn interpolation(&self) -> Interpolation {
        self.between
    }

    /// Removes rows whose value is already held.
    fn keep_changes(&mut self) {
        let changes = |row: &usize| *row == 0 || self.values[*row] != self.values[row - 1];
        let kept: Vec<usize> = (0..self.times.len()).filter(changes).collect();
        self.times = kept.iter().map(|row| self.times[*row]).collect();
        self.values = kept.iter().map(|row| self.values[*row]).collect();
    }

    /// The instants at which steps end, for methods of high order and of low order.
    fn find_breaks(&self) -> [Vec<f64>; 2] {
        let [first, last] = self.ends;
        let of_round = || self.times.iter().copied().filter(|time| *time < last);
        let is_one = first == last;
        match (self.between, self.beyond) {
            (_, Extrapolation::Hold) if is_one => [Vec::new(), Vec::new()],
            // The first value also holds before its instant.
            (Interpolation::Hold, Extrapolation::Hold) => {
                let changes: Vec<f64> = self.times.iter().copied().skip(1).collect();
                [changes.clone(), changes]
            }
            (Interpolation::Hold | Interpolation::Linear, Extrapolation::Repeat) => {
                [of_round().collect(), of_round().collect()]
            }
            (Interpolation::Cubic, Extrapolation::Repeat) => [of_round().collect(), Vec::new()],
            (Interpolation::Hold, Extrapolation::Error) => {
                let mut breaks: Vec<f64> = of_round().collect();
                breaks.push(last);
                [breaks.clone(), breaks]
            }
            (Interpolation::Linear, _) => [self.times.clone(), self.times.clone()],
            (Interpolation::Cubic, _) => [self.times.clone(), std::vec![first, last]],
        }
    }

    /// The value at a time in s, in the unit of the table's values; at a jump, the value after it. NaN where it is unknown.
    pub fn value(&self, t: f64) -> f64 {
        self.value_in(Piece::ALL, t)
    }

    /// The value at a time in s within a piece, and at the ends of the piece the limits from within.
    pub fn value_in(&self, piece: Piece, t: f64) -> f64 {
        // A cubic spline is continuous, and may have knots within the piece.
        let within = match self.between {
            Interpolation::Cubic => t,
            _ => piece.within(t),
        };
        let [first, last] = self.ends;
        let round = match self.beyond {
            Extrapolation::Repeat => ((within - first) / (last - first)).floor(),
            _ => 0.0,
        };
        let mut shift = match round {
            0.0 => 0.0,
            round => round * (last - first),
        };
        // Rounding may have put it into the next or the previous period.
        if self.beyond == Extrapolation::Repeat {
            if within - shift >= last {
                shift += last - first;
            } else if within - shift < first {
                shift -= last - first;
            }
        }
        let (within, t) = (within - shift, t - shift);
        if !(first..=last).contains(&within) {
            match self.beyond {
                Extrapolation::Hold if within < first => return self.values[0],
                Extrapolation::Hold => return self.values[self.values.len() - 1],
                Extrapolation::Error => return f64::NAN,
                Extrapolation::Repeat => {} // it is within the table except for rounding
            }
        }
        let row = self.times.partition_point(|time| *time <= within);
        let row = row.saturating_sub(1);
        if self.between == Interpolation::Hold {
            return self.values[row];
        }
        let row = row.min(self.times.len().saturating_sub(2));
        let (Some(to), Some(next)) = (self.times.get(row + 1), self.values.get(row + 1)) else {
            return self.values[row];
        };
        let (from, value) = (self.times[row], self.values[row]);
        let (h, share) = (to - from, (t - from) / (to - from));
        if self.between == Interpolation::Linear {
            return value + share * (next - value);
        }
        // Hermite's form: values and slopes at both ends.
        let slopes = [self.slopes[row], self.slopes[row + 1]].map(|slope| slope * h);
        let rise = next - value;
        let [bend, twist] = [
            3.0 * rise - 2.0 * slopes[0] - slopes[1],
            slopes[0] + slopes[1] - 2.0 * rise,
        ];
        value + share * (slopes[0] + share * (bend + share * twist))
    }

    /// The piece of time that a run enters at `t`, in which the table is smooth enough for a method of this order.
    ///
    /// # Errors
    /// If the table has no value there, or changes more often than the resolution of time.
    pub fn piece(&self, t: f64, forward: bool, order: u32) -> Result<Piece, NoPiece<'_>> {
        let [first, last] = self.ends;
        if self.beyond == Extrapolation::Error {
            let is_known = if forward {
                (first..last).contains(&t)
            } else {
                first < t && t <= last
            };
            if !is_known {
                return Err(NoPiece::Ended(&self.name));
            }
        }
        let breaks = &self.breaks[usize::from(order < ORDER_OF_SPLINES)];
        if breaks.is_empty() {
            return Ok(Piece::ALL);
        }
        // The instant of a break in a period, always computed with the same bits.
        let count = breaks.len();
        let at = |round: f64, number: usize| match round {
            0.0 => breaks[number],
            round => round * (last - first) + breaks[number],
        };
        let is_passed = |time: f64| if forward { time <= t } else { time < t };
        let rounds = match self.beyond {
            Extrapolation::Repeat => {
                if self.finest < 16.0 * f64::EPSILON * t.abs() {
                    return Err(NoPiece::TooFine(&self.name));
                }
                let round = ((t - first) / (last - first)).floor();
                [-2.0, -1.0, 0.0, 1.0, 2.0].map(|more| round + more)
            }
            _ => [0.0; 5],
        };
        let mut from = None;
        let mut to = None;
        for round in rounds {
            let passed = first_of(count, |number| !is_passed(at(round, number)));
            if passed > 0 {
                from = Some((at(round, passed - 1), passed - 1));
            }
            if passed < count {
                to = Some((at(round, passed), passed));
                break;
            }
        }
        let entered = if forward { from } else { to };
        Ok(Piece {
            from: from.map_or(f64::NEG_INFINITY, |(time, _)| time),
            to: to.map_or(f64::INFINITY, |(time, _)| time),
            jumps: entered.is_some_and(|(_, number)| self.jumps(number)),
        })
    }

    /// Whether it jumps at the break with this index.
    fn jumps(&self, number: usize) -> bool {
        match self.between {
            Interpolation::Hold => true,
            Interpolation::Linear | Interpolation::Cubic => {
                self.beyond == Extrapolation::Repeat
                    && number == 0
                    && self.values.first() != self.values.last()
            }
        }
    }
}

/// The first index below `count` for which `holds` is true, if it is true for all following ones; `count` if there is none.
fn first_of(count: usize, holds: impl Fn(usize) -> bool) -> usize {
    let (mut from, mut to) = (0, count);
    while from < to {
        let middle = from + (to - from) / 2;
        if holds(middle) {
            to = middle
        } else {
            from = middle + 1
        }
    }
    from
}

/// Lengths and slopes of the straight lines between rows.
fn lines(times: &[f64], values: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let lengths: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let rises = values.windows(2).map(|pair| pair[1] - pair[0]);
    let slopes = rises.zip(&lengths).map(|(rise, length)| rise / length);
    let slopes = slopes.collect();
    (lengths, slopes)
}

/// The slopes of the cubic spline whose third derivative is continuous at the second and the last but one knot. With three rows
/// they are those of the parabola, with two that of the line.
///
/// C. de Boor, *A Practical Guide to Splines*, rev. ed., 2001, chapter IV, eqs. (4)–(7).
fn slopes(times: &[f64], values: &[f64]) -> Vec<f64> {
    let (h, line) = lines(times, values);
    let n = times.len();
    match n {
        0 | 1 => return std::vec![0.0; n],
        2 => return std::vec![line[0]; 2],
        3 => {
            let bend = (line[1] - line[0]) / (times[2] - times[0]);
            return std::vec![
                line[0] - bend * h[0],
                line[0] + bend * h[0],
                line[1] + bend * h[1]
            ];
        }
        _ => {}
    }
    // below·s₍ᵢ₋₁₎ + middle·sᵢ + above·s₍ᵢ₊₁₎ = right, eliminated from the first row on.
    let (mut middle, mut above, mut right) = (Vec::new(), Vec::new(), Vec::new());
    let sum = h[0] + h[1];
    middle.push(h[1]);
    above.push(sum);
    right.push(((h[0] + 2.0 * sum) * h[1] * line[0] + h[0] * h[0] * line[1]) / sum);
    for i in 1..n {
        let (below, own, over, known) = if i < n - 1 {
            let known = 3.0 * (h[i] * line[i - 1] + h[i - 1] * line[i]);
            (h[i], 2.0 * (h[i - 1] + h[i]), h[i - 1], known)
        } else {
            let [before, last] = [h[n - 3], h[n - 2]];
            let sum = before + last;
            let known = last * last * line[n - 3] + (2.0 * sum + last) * before * line[n - 2];
            (sum, before, 0.0, known / sum)
        };
        let factor = below / middle[i - 1];
        middle.push(own - factor * above[i - 1]);
        above.push(over);
        right.push(known - factor * right[i - 1]);
    }
    let mut solution = right;
    solution[n - 1] /= middle[n - 1];
    for i in (0..n - 1).rev() {
        solution[i] = (solution[i] - above[i] * solution[i + 1]) / middle[i];
    }
    solution
}

/// The slopes of the periodic cubic spline with two continuous derivatives; the last row is the first of the next period.
///
/// The equations are those of [`slopes`] in a ring. They are solved as a tridiagonal system with a rank-one correction: J.
/// Sherman and W. J. Morrison, *Adjustment of an inverse matrix corresponding to a change in one element of a given matrix*,
/// Ann. Math. Stat. 21 (1950) 124.
fn periodic_slopes(times: &[f64], values: &[f64]) -> Vec<f64> {
    let (h, line) = lines(times, values);
    let m = h.len();
    let before = |i: usize| (i + m - 1) % m;
    let known = |i: usize| 3.0 * (h[i] * line[before(i)] + h[before(i)] * line[i]);
    let own = |i: usize| 2.0 * (h[before(i)] + h[i]);
    let mut solution = match m {
        1 => std::vec![0.0],
        2 => {
            // Each row is the neighbour of the other on both sides.
            let across = h[0] + h[1];
            let determinant = own(0) * own(1) - across * across;
            std::vec![
                (known(0) * own(1) - across * known(1)) / determinant,
                (own(0) * known(1) - across * known(0)) / determinant,
            ]
        }
        _ => {
            // The corner entries, h₀ at the end of the first row and h₍ₘ₋₂₎ at the beginning of the last one, are the product of
            // the vectors (γ, 0, …, last) and (1, 0, …, first/γ).
            let [first, last] = [h[0], h[m - 2]];
            let gamma = -own(0);
            let diagonal = |i: usize| match i {
                0 => own(0) - gamma,
                i if i == m - 1 => own(i) - first * last / gamma,
                i => own(i),
            };
            let solve = |mut right: Vec<f64>| {
                let mut middle = std::vec![diagonal(0)];
                for i in 1..m {
                    let factor = h[i] / middle[i - 1];
                    middle.push(diagonal(i) - factor * h[before(i - 1)]);
                    right[i] -= factor * right[i - 1];
                }
                right[m - 1] /= middle[m - 1];
                for i in (0..m - 1).rev() {
                    right[i] = (right[i] - h[before(i)] * right[i + 1]) / middle[i];
                }
                right
            };
            let plain = solve((0..m).map(known).collect());
            let mut column = std::vec![0.0; m];
            (column[0], column[m - 1]) = (gamma, last);
            let column = solve(column);
            let along = |x: &[f64]| x[0] + first / gamma * x[m - 1];
            let share = along(&plain) / (1.0 + along(&column));
            let pairs = plain.iter().zip(&column);
            pairs
                .map(|(plain, column)| plain - share * column)
                .collect()
        }
    };
    solution.push(solution[0]);
    solution
}

/// Inputs of which one is driven by a table, and the others by a law; created
/// by [`Simulation::table`](crate::Simulation::table).
#[derive(Clone, Debug)]
pub struct TableInputs<L, F> {
    law: L,
    table: Arc<Table>,
    set: F,
}

impl<L, F> TableInputs<L, F> {
    /// Inputs of the law, some of which `set` replaces.
    pub fn new(law: L, table: Table, set: F) -> Self {
        Self {
            law,
            table: Arc::new(table),
            set,
        }
    }
}

impl<S, L, F> InputLaw<S> for TableInputs<L, F>
where
    S: System,
    L: InputLaw<S>,
    F: Fn(&mut S::Inputs, f64),
{
    fn set(&self, system: &S, t: f64, q: &S::Vector, v: &S::Vector, inputs: &mut S::Inputs) {
        self.set_in(Piece::ALL, system, t, q, v, inputs);
    }

    fn piece(&self, t: f64, forward: bool, order: u32) -> Result<Piece, NoPiece<'_>> {
        let of_law = self.law.piece(t, forward, order)?;
        Ok(of_law.and(self.table.piece(t, forward, order)?, forward))
    }

    fn set_in(
        &self,
        piece: Piece,
        system: &S,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
        inputs: &mut S::Inputs,
    ) {
        self.law.set_in(piece, system, t, q, v, inputs);
        (self.set)(inputs, self.table.value_in(piece, t));
    }

    fn is_constant_in_pieces(&self) -> bool {
        self.table.is_constant_in_pieces() && self.law.is_constant_in_pieces()
    }

    fn is_partial(&self) -> bool {
        self.law.is_partial()
    }
}

impl Table {
    /// Whether it has one value within each piece.
    pub fn is_constant_in_pieces(&self) -> bool {
        self.between == Interpolation::Hold || self.values.len() == 1
    }
}

impl NoPiece<'_> {
    /// The error of a run that reaches `t`.
    pub(crate) fn error(self, t: f64) -> Error {
        let (input, why) = match self {
            NoPiece::Ended(name) => (
                name,
                "covers only a part of the run: it has no value next to",
            ),
            NoPiece::TooFine(name) => (name, "changes more often than times can resolve at"),
        };
        Error::InputEnded {
            input: input.into(),
            why,
            t,
        }
    }
}
