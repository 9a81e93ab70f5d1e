//! Records the operations of a step by series, as the interpreter of series (`program/src/series/expand.rs`) does them.
//!
//! ```text
//! Part::Values    orders 0 to 2 of positions, 0 and 1 of rates, 0 of forces, and the gradients: up to the matrices of the unknowns
//! Part::First     from the factored matrices: how unknowns are composed, the first accelerations, what these change
//! Part::Later     one order of all later ones, of positions with the order n: sums over orders are given, and all else is recorded
//! ```
//!
//! A part reads what an earlier one has computed from the memory of the step. In the last one, orders are relative: its code begins with `n` = 3,
//! and so orders are counted here; what belongs to an earlier order is read from the [record](super::memory::Memory) of that order.

use std::collections::{HashMap, HashSet};

use lagrangian_program::Contracted;
use lagrangian_program::series::{
    Arithmetic as _, Coefficient, Composition, Convolution, Level, Order, Row, RowId, Series,
    Source, Stream, TermOrder,
};

use super::memory::{Memory, NUMBERS, Place};
use crate::lower::{Base, Builder, CallKind, Id, Instruction, Location, Lowered, Matrix, Node};

/// The parts of the code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    Values,
    First,
    Later,
}

/// A number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum X {
    /// The bits of a constant.
    Literal(u64),
    /// A number in memory before the part begins.
    Stored(Place),
    /// The index of a computed value.
    Made(u32),
}

pub const ZERO: X = X::Literal(0);
pub const ONE: X = X::Literal(1.0_f64.to_bits());
pub const MINUS_ONE: X = X::Literal((-1.0_f64).to_bits());

/// An operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Op {
    Binary(Instruction, X, X),
    MulAdd(X, X, X),
    NegMulAdd(X, X, X),
    Negative(X),
    ProductError(X, X),
    SumError(X, X),
}

/// A value, where it was made, and where it is stored for other parts.
struct Made {
    part: Part,
    id: Id,
    place: Option<Place>,
}

/// A group of coupled unknowns.
pub struct Block {
    pub members: Vec<u32>,
    /// Where its matrix begins.
    pub matrix: u32,
    pub composition: Option<(Composition, Vec<Vec<X>>)>,
}

/// A block as the runtime factors it: the number of its unknowns, of those among them that are coordinates, and where its matrix begins.
#[derive(Clone, Copy, Debug)]
pub struct Factored {
    pub count: usize,
    pub held: usize,
    pub matrix: u32,
}

/// Everything that was recorded.
pub struct Recorded {
    /// In the order of [`Part`].
    pub parts: [Lowered; 3],
    pub memory: Memory,
    pub blocks: Vec<Factored>,
}

pub struct Recorder<'s> {
    pub series: &'s Series,
    parts: [Builder; 3],
    results: [Vec<(Id, Place)>; 3],
    pub part: Part,
    made: Vec<Made>,
    known: HashMap<(Part, Op), X>,
    pub memory: Memory,
    /// The order that is computed, and the level of its rows.
    pub m: usize,
    pub level: Level,
    /// For each row its coefficients of the orders 0, 1 and 2.
    pub first: Vec<[Option<X>; 3]>,
    /// The same, multiplied by their orders.
    pub weighted_first: Vec<[Option<X>; 3]>,
    /// For each row its newest coefficient in [`Part::Later`].
    newest: Vec<Option<X>>,
    /// For each row its newest coefficient times the order.
    pub scaled: Vec<Option<X>>,
    /// Final coefficients of an order times the order.
    weighted: Vec<Option<X>>,
    /// The rounding errors of values.
    pub low: Vec<Option<X>>,
    is_scaled: Vec<bool>,
    has_weighted: Vec<bool>,
    pub gradients: Vec<Vec<X>>,
    /// Sums over orders that are sources.
    pub kept_sums: Vec<Option<X>>,
    /// The newest rates of coordinates.
    pub rates: Vec<X>,
    /// The effect of accelerations on forces, if it is a product.
    pub matrix_of_forces: Option<Matrix>,
    /// How many sums over orders a register holds.
    pub width: u32,
}

impl<'s> Recorder<'s> {
    fn new(series: &'s Series, width: u32) -> Recorder<'s> {
        let count = series.rows.len();
        let streams = series.streams();
        let mut is_scaled: Vec<bool> = streams.iter().map(|[_, weighted]| *weighted).collect();
        for row in &series.rows {
            if let Row::Second(of) = row {
                is_scaled[of.index()] = true;
            }
        }
        Recorder {
            series,
            parts: Default::default(),
            results: Default::default(),
            part: Part::Values,
            made: Vec::new(),
            known: HashMap::new(),
            memory: Memory::new(series, width),
            m: 0,
            level: Level::Position,
            first: vec![[None; 3]; count],
            weighted_first: vec![[None; 3]; count],
            newest: vec![None; count],
            scaled: vec![None; count],
            weighted: vec![None; count],
            low: vec![None; count],
            is_scaled,
            has_weighted: streams.iter().map(|[_, weighted]| *weighted).collect(),
            gradients: vec![Vec::new(); count],
            kept_sums: vec![None; count],
            rates: Vec::new(),
            matrix_of_forces: None,
            width,
        }
    }

    // Values.

    /// A number as a value of the part that is recorded.
    pub fn here(&mut self, x: X) -> Id {
        let part = self.part;
        let place = match x {
            X::Literal(bits) => return self.builder().number(f64::from_bits(bits)),
            X::Stored(place) => place,
            X::Made(index) => {
                let made = &self.made[index as usize];
                if made.part == part {
                    return made.id;
                }
                self.stored(index)
            }
        };
        self.builder().leaf(place.to_location())
    }

    fn builder(&mut self) -> &mut Builder {
        &mut self.parts[self.part as usize]
    }

    /// Where a value is stored for other parts.
    fn stored(&mut self, index: u32) -> Place {
        let made = &mut self.made[index as usize];
        *made.place.get_or_insert_with(|| {
            let place = Place::Fixed(self.memory.take(1));
            self.results[made.part as usize].push((made.id, place));
            place
        })
    }

    /// A value that this part has made.
    pub fn make(&mut self, id: Id) -> X {
        self.made.push(Made {
            part: self.part,
            id,
            place: None,
        });
        X::Made(self.made.len() as u32 - 1)
    }

    /// Stores a number at the end of the part.
    pub fn store(&mut self, x: X, place: Place) {
        let id = self.here(x);
        self.results[self.part as usize].push((id, place));
    }

    fn push(&mut self, op: Op) -> X {
        if let Some(known) = self.known.get(&(self.part, op)) {
            return *known;
        }
        let id = match op {
            Op::Binary(instruction, a, b) => {
                let [a, b] = [a, b].map(|x| self.here(x));
                self.builder().binary(instruction, a, b)
            }
            Op::MulAdd(a, b, c) | Op::NegMulAdd(a, b, c) => {
                let kind = match op {
                    Op::MulAdd(..) => Contracted::Add,
                    _ => Contracted::SubFrom,
                };
                let [a, b, c] = [a, b, c].map(|x| self.here(x));
                self.builder().add(Node::Contracted(kind, [a, b], c))
            }
            Op::Negative(a) => {
                let a = self.here(a);
                self.builder().negative(a)
            }
            Op::ProductError(a, b) => {
                let [a, b] = [a, b].map(|x| self.here(x));
                self.builder()
                    .product_error(crate::lower::Arithmetic::Fused, a, b)
            }
            Op::SumError(a, b) => {
                let [a, b] = [a, b].map(|x| self.here(x));
                self.builder().sum_error(a, b)
            }
        };
        let x = self.make(id);
        self.known.insert((self.part, op), x);
        x
    }

    /// An instruction, without any simplification.
    pub fn binary(&mut self, instruction: Instruction, a: X, b: X) -> X {
        self.push(Op::Binary(instruction, a, b))
    }

    /// `a b + c`, without any simplification.
    pub fn mul_add(&mut self, a: X, b: X, c: X) -> X {
        self.push(Op::MulAdd(a, b, c))
    }

    /// `c − a b`.
    pub fn neg_mul_add(&mut self, a: X, b: X, c: X) -> X {
        self.push(Op::NegMulAdd(a, b, c))
    }

    /// `−a`, without any simplification.
    pub fn negative(&mut self, a: X) -> X {
        self.push(Op::Negative(a))
    }

    /// The rounding error of a product.
    pub fn product_error(&mut self, a: X, b: X) -> X {
        self.push(Op::ProductError(a, b))
    }

    /// The rounding error of a sum.
    pub fn sum_error(&mut self, a: X, b: X) -> X {
        self.push(Op::SumError(a, b))
    }

    /// An operation of the builder on numbers.
    pub fn built<const K: usize>(
        &mut self,
        of: [X; K],
        build: impl FnOnce(&mut Builder, [Id; K]) -> Id,
    ) -> X {
        let of = of.map(|x| self.here(x));
        let id = build(self.builder(), of);
        self.make(id)
    }

    /// The product of a matrix among the numbers of the step and a vector.
    pub fn product(&mut self, matrix: Matrix, of: &[X]) -> Vec<X> {
        let of = of.iter().map(|x| self.here(*x)).collect();
        let kind = CallKind::Matrix(matrix);
        let found = self.builder().call(kind, of, matrix.rows as usize);
        found.into_iter().map(|id| self.make(id)).collect()
    }

    // Orders.

    /// The number of an order.
    pub fn number(&mut self, m: usize) -> X {
        match self.part {
            Part::Later => X::Stored(Place::Record(3 - m as u32, NUMBERS[0])),
            _ => X::Literal((m as f64).to_bits()),
        }
    }

    /// Its reciprocal.
    pub fn reciprocal(&mut self, m: usize) -> X {
        match self.part {
            Part::Later => X::Stored(Place::Record(3 - m as u32, NUMBERS[1])),
            _ => X::Literal((1.0 / m as f64).to_bits()),
        }
    }

    /// The coefficient of order `m` of a row.
    pub fn read(&mut self, row: RowId, m: usize) -> X {
        let index = row.index();
        if !self.series.varies(row) {
            return if m == 0 { self.constant(row) } else { ZERO };
        }
        if self.part != Part::Later {
            return self.first[index][m].unwrap_or(ZERO);
        }
        match self.back(row, m) {
            0 => self.newest[index].unwrap_or(ZERO),
            back => {
                let slot = self.memory.of_row(row, false);
                X::Stored(Place::Record(back, slot))
            }
        }
    }

    /// The coefficient of order `m` of a row, times the order, once it is final.
    pub fn read_weighted(&mut self, row: RowId, m: usize) -> X {
        if self.part != Part::Later {
            return self.weighted_first[row.index()][m].unwrap_or(ZERO);
        }
        match self.back(row, m) {
            0 => self.weighted[row.index()].unwrap_or(ZERO),
            back => {
                let slot = self.memory.of_row(row, true);
                X::Stored(Place::Record(back, slot))
            }
        }
    }

    /// How many orders ago a coefficient was computed.
    fn back(&self, row: RowId, m: usize) -> u32 {
        (1 + self.series.lead(row) - m) as u32
    }

    /// A coefficient that a sum over orders reads.
    pub fn of_stream(&mut self, Stream { row, weighted }: Stream, m: usize) -> X {
        if weighted {
            self.read_weighted(row, m)
        } else {
            self.read(row, m)
        }
    }

    /// The value of a row of the start.
    pub fn value_of(&mut self, row: RowId) -> X {
        if !self.series.varies(row) {
            return self.constant(row);
        }
        self.first[row.index()][0].unwrap_or(ZERO)
    }

    /// The value of a row that depends on parameters alone.
    fn constant(&mut self, row: RowId) -> X {
        if let Row::Number(number) = &self.series.rows[row.index()] {
            return X::Literal(number.evaluate::<f64>().to_bits());
        }
        X::Stored(Place::Fixed(self.memory.constant(row)))
    }

    /// Whether the coefficients of a row, times their orders, are kept, and whether those are of a level that is further ahead.
    pub fn has_final_weighted(&self, row: RowId) -> bool {
        self.has_weighted[row.index()] && self.series.lead(row) > self.lead()
    }

    /// How many orders the computed rows are ahead of the accelerations.
    pub fn lead(&self) -> usize {
        match self.level {
            Level::Constant | Level::Position => 2,
            Level::Rate => usize::from(self.series.rates_are_ahead),
            Level::Acceleration => 0,
        }
    }

    /// The sum over the orders strictly between 0 and that of a row.
    pub fn sum_over_orders(&mut self, convolution: Convolution) -> X {
        let [a, b] = convolution.factors;
        if self.part != Part::Later {
            // One term of the second order, and none of the first.
            if convolution.along != TermOrder::Position || self.m < 2 {
                return ZERO;
            }
            let [a, b] = [a, b].map(|stream| self.of_stream(stream, 1));
            return self.multiply(a, b);
        }
        let sum = X::Stored(self.memory.sum(&convolution));
        let m = self.m;
        let first = |to: &Self, Stream { row, weighted }: Stream| {
            let of = if weighted {
                &to.weighted_first
            } else {
                &to.first
            };
            of[row.index()][1].unwrap_or(ZERO)
        };
        match convolution.along {
            TermOrder::Other => sum,
            TermOrder::Force => {
                let (a, b) = (self.of_stream(a, m - 1), first(self, b));
                self.multiply_add(a, b, sum)
            }
            TermOrder::Position => {
                let [first_a, first_b] = [first(self, a), first(self, b)];
                let a = self.of_stream(a, m - 1);
                let sum = self.multiply_add(a, first_b, sum);
                let b = self.of_stream(b, m - 1);
                self.multiply_add(first_a, b, sum)
            }
        }
    }

    /// Computes the coefficient of order `m` of a row.
    fn advance(&mut self, row: RowId, m: usize) {
        let series = self.series;
        let index = row.index();
        (self.m, self.level) = (m, series.level(row));
        let Coefficient { plain, weighted } = if m == 0 {
            if let Row::Time = series.rows[index] {
                self.low[index] = Some(X::Stored(Place::Fixed(self.memory.time() + 1)));
            }
            Coefficient {
                plain: series.value(row, self),
                weighted: Some(ZERO),
            }
        } else {
            let order = if m == 1 && self.part != Part::Later {
                Order::First
            } else {
                Order::Later
            };
            series.coefficient(row, order, self)
        };
        self.set(row, m, plain);
        if self.is_scaled[index] {
            let number = self.number(m);
            let weighted = weighted.unwrap_or_else(|| self.multiply(number, plain));
            self.scaled[index] = Some(weighted);
        }
    }

    /// Sets the newest coefficient of a row.
    pub fn set(&mut self, row: RowId, m: usize, x: X) {
        match self.part {
            Part::Later => self.newest[row.index()] = Some(x),
            _ => self.first[row.index()][m] = Some(x),
        }
    }

    fn rows_at(&self, level: Level) -> Vec<RowId> {
        let rows = (0..self.series.rows.len() as u32).map(RowId);
        rows.filter(|row| self.series.level(*row) == level)
            .collect()
    }

    /// Multiplies final coefficients of an order by the order.
    fn weigh(&mut self, level: Level, m: usize) {
        for row in self.rows_at(level) {
            let index = row.index();
            if !self.has_weighted[index] {
                continue;
            }
            let weighted = match self.series.rows[index] {
                Row::Coordinate(i) => self.rates[i as usize],
                _ => {
                    let (number, x) = (self.number(m), self.read(row, m));
                    self.multiply(number, x)
                }
            };
            match self.part {
                Part::Later => self.weighted[index] = Some(weighted),
                _ => self.weighted_first[index][m] = Some(weighted),
            }
        }
    }
}

/// Records a series for registers of this number of sums over orders: 1 for several states, each with a register for itself.
pub fn record(series: &Series, width: u32) -> Recorded {
    let mut to = Recorder::new(series, width);
    let [positions, rates, forces] =
        [Level::Position, Level::Rate, Level::Acceleration].map(|level| to.rows_at(level));
    let ahead = usize::from(series.rates_are_ahead);

    // The values, and what follows from the rates: orders 1 and 2 of positions as far as accelerations do not change them.
    let velocities = to.memory.velocities();
    let n = series.dimension() as u32;
    to.rates = (velocities..velocities + n)
        .map(|at| X::Stored(Place::Fixed(at)))
        .collect();
    for m in 0..2 {
        positions.iter().for_each(|row| to.advance(*row, m));
    }
    if ahead == 1 {
        rates.iter().for_each(|row| to.advance(*row, 0));
    }
    to.weigh(Level::Position, 1);
    positions.iter().for_each(|row| to.advance(*row, 2));
    rates.iter().for_each(|row| to.advance(*row, ahead));
    forces.iter().for_each(|row| to.advance(*row, 0));
    to.differentiate();
    let mut blocks = to.matrices();
    to.store_matrix_of_forces();

    to.part = Part::First;
    to.compose(&mut blocks);
    to.solve(&blocks, 0);
    to.weigh(Level::Rate, ahead);
    to.weigh(Level::Acceleration, 0);
    to.weigh(Level::Position, 2);

    to.part = Part::Later;
    positions.iter().for_each(|row| to.advance(*row, 3));
    rates.iter().for_each(|row| to.advance(*row, 1 + ahead));
    let needed = series.later_forces();
    let is_source = to.sources(&blocks);
    for row in &forces {
        if is_source[row.index()] {
            (to.m, to.level) = (1, Level::Acceleration);
            let sum = to.convolution(*row, 0);
            to.kept_sums[row.index()] = Some(sum);
        }
        if needed[row.index()] {
            to.advance(*row, 1);
        }
    }
    to.solve(&blocks, 1);
    to.weigh(Level::Rate, 1 + ahead);
    to.weigh(Level::Acceleration, 1);
    to.weigh(Level::Position, 3);
    to.store_lists();
    to.store_rows();
    to.finished(&blocks)
}

impl Recorder<'_> {
    /// The rows whose sums over orders are sources of unknowns.
    fn sources(&self, blocks: &[Block]) -> Vec<bool> {
        let mut is_source = vec![false; self.series.rows.len()];
        let compositions = blocks.iter().filter_map(|block| block.composition.as_ref());
        for source in compositions.flat_map(|(of, _)| of.sources.iter().flatten()) {
            if let Source::Sum(row) = source {
                is_source[row.index()] = true;
            }
        }
        is_source
    }

    /// Stores the coefficients that sums over orders read.
    fn store_lists(&mut self) {
        let mut stored = HashSet::new();
        for (convolution, lane) in self.memory.lanes() {
            for (side, stream) in convolution.factors.into_iter().enumerate() {
                let slot = lane.slots[side];
                if !stored.insert(slot) {
                    continue;
                }
                // The order of the coefficient, and how many records ahead of the first one that the part reads it stands.
                let lead = self.series.lead(stream.row);
                let (m, record) = match lane.kind {
                    0 => (1 + lead, 2),
                    1 => (1, 1),
                    _ => (2, 2),
                };
                self.part = Part::Later;
                let x = self.of_stream(stream, m);
                self.store(x, Place::Record(2 - record, slot));
                if lane.kind != 1 {
                    self.part = Part::First;
                    let x = self.of_stream(stream, m - 1);
                    self.store(x, Place::Record(1, slot));
                }
            }
        }
    }

    /// Stores the coefficients of coordinates and rates, and of rows that later orders read.
    fn store_rows(&mut self) {
        for (row, weighted, slot) in self.memory.rows() {
            let lead = self.series.lead(row);
            let stream = Stream { row, weighted };
            self.part = Part::Later;
            let x = self.of_stream(stream, 1 + lead);
            self.store(x, Place::Record(0, slot));
            self.part = Part::First;
            for back in [1, 2] {
                if let Some(m) = (2 + lead).checked_sub(back + 1) {
                    let x = self.of_stream(stream, m);
                    self.store(x, Place::Record(back as u32, slot));
                }
            }
        }
    }

    fn finished(self, blocks: &[Block]) -> Recorded {
        let stride = self.memory.stride();
        let lowered = self.parts.into_iter().zip(self.results);
        let mut lowered = lowered.map(|(mut builder, results)| {
            builder.relocate(|location| match location {
                Location::Argument(Base::Velocities, code) => {
                    Place::of_record(code).to_argument(stride).into()
                }
                other => other,
            });
            let place = |(id, place): (Id, Place)| {
                let (base, index) = place.to_argument(stride);
                (id, base, index)
            };
            builder.in_phases(results.into_iter().map(place).collect())
        });
        let parts = std::array::from_fn(|_| lowered.next().unwrap_or_default());
        let factored = |block: &Block| Factored {
            count: block.members.len(),
            held: {
                let dimension = self.series.dimension();
                let is_held = |member: &u32| *member as usize >= dimension;
                let held = block.members.iter().position(is_held);
                held.unwrap_or(block.members.len())
            },
            matrix: block.matrix,
        };
        Recorded {
            parts,
            memory: self.memory,
            blocks: blocks.iter().map(factored).collect(),
        }
    }
}
