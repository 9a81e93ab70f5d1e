//! The time of an expansion, counted.
//!
//! The recurrences are walked through once for the start of a step and a few times for an order, in an arithmetic whose numbers are the times at which they are known.
//! It counts operations, with the figures of [`Cost`](crate::Cost): the time of an order is its work, or the time for which it waits for the order before, whichever
//! is longer.

use std::collections::BTreeSet;

use lagrangian_scalar::series::is_inverse;
use lagrangian_symbolic::{Function as Call, Rational};

use super::recurrence::{Arithmetic, Order, TermOrder};
use super::{Composition, Convolution, Level, MOST_IN_ONE_SUM, Row, RowId, Series, Stream};

/// The work and the latency of operations, in tenths of a cycle: those of [`Cost`](crate::Cost).
const ARITHMETIC: [u64; 2] = [4, 40];
const DIVISION: [u64; 2] = [45, 130];
const CALL: [u64; 2] = [120, 450];

/// The work of a fused multiplication of four numbers side by side: two start in a cycle if one factor is in memory, and two in three cycles if both
/// are, since three registers are read in a cycle at most.
const OF_FOUR: u64 = 5;
const OF_FOUR_IN_MEMORY: u64 = 7;

/// The same of factors that the fastest cache does not hold, and the numbers that it does hold, of which the rest of a step needs a quarter.
const OF_FOUR_FAR_AWAY: u64 = 20;
const NUMBERS_AT_HAND: u64 = 3072;

/// The work of moving four numbers into one register or out of it: besides loads and stores two shuffles, which one unit does.
const MOVES_OF_FOUR: u64 = 20;

/// The work of an operation of the factorization of the matrix of the unknowns, in short loops whose lengths vary, and what each pivot adds: its quotient
/// waits for the one before.
const IN_SHORT_LOOPS: u64 = 7;
const PIVOT: u64 = DIVISION[1] + 4 * ARITHMETIC[1];

/// The latency of a sum over orders after the latest of its factors: it is stored, read, multiplied and added, and both halves of the sum are added.
const LATENCY_OF_SUM: u64 = 130;

/// The orders after which the time between one and the next no longer changes.
const ORDERS_UNTIL_STEADY: usize = 4;

/// A number, known to be 0 or ±1, or the time at which it is known.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Number {
    Zero,
    One,
    MinusOne,
    At(u64),
}

impl Number {
    fn time(self) -> u64 {
        match self {
            Number::At(time) => time,
            _ => 0,
        }
    }
}

/// The counted work of an expansion, in tenths of a cycle.
pub(super) struct Expansion {
    /// Everything before the loop over orders.
    start: u64,
    /// Of each order, besides its sums over orders, the work, and the time for which it waits for the one before.
    work: u64,
    waits: u64,
    /// The registers that its sums over orders take.
    registers: u64,
}

impl Expansion {
    /// The time to so many coefficients of the accelerations, in cycles.
    pub fn cycles(&self, orders: usize) -> f64 {
        let orders = orders as u64;
        let are_at_hand = 8 * self.registers * (orders + 2) <= NUMBERS_AT_HAND;
        let of_term = if are_at_hand {
            OF_FOUR_IN_MEMORY
        } else {
            OF_FOUR_FAR_AWAY
        };
        // Both factors of each term, and what is stored and taken out.
        let of_sums = |order: u64| self.registers * (of_term * order + 3 * MOVES_OF_FOUR);
        let of_orders = (1..orders).map(|order| (self.work + of_sums(order)).max(self.waits));
        (self.start + of_orders.sum::<u64>()) as f64 / 10.0
    }
}

impl Series {
    /// Counts the work of an expansion.
    pub(super) fn expansion(&self) -> Expansion {
        Counter::of(self).expansion()
    }
}

/// A group of coupled unknowns.
struct Block {
    members: Vec<u32>,
    /// How later orders are composed of sources, with the coefficients of these for each unknown.
    composition: Option<(Composition, Vec<Vec<Number>>)>,
}

/// Walks through an expansion.
struct Counter<'s> {
    series: &'s Series,
    work: u64,
    /// The order being computed: 0, 1, 2, or 3 for any later one.
    m: usize,
    lead: usize,
    first: Vec<Option<Number>>,
    linear: Vec<Option<Number>>,
    newest: Vec<Option<Number>>,
    scaled: Vec<Option<Number>>,
    /// Coefficients of the order before, corrected by its accelerations.
    before: Vec<Number>,
    accelerations: Vec<Number>,
    sines: Vec<Option<[Number; 2]>>,
    streams: Vec<[bool; 2]>,
    gradients: Vec<Vec<Number>>,
}

impl<'s> Counter<'s> {
    fn of(series: &'s Series) -> Self {
        let count = series.rows.len();
        Self {
            series,
            work: 0,
            m: 0,
            lead: 2,
            first: vec![None; count],
            linear: vec![None; count],
            newest: vec![None; count],
            scaled: vec![None; count],
            before: vec![Number::Zero; count],
            accelerations: vec![Number::At(0); series.unknowns()],
            sines: vec![None; count],
            streams: series.streams(),
            gradients: Vec::new(),
        }
    }

    fn rows_at(&self, level: Level) -> Vec<RowId> {
        let rows = (0..self.series.rows.len() as u32).map(RowId);
        rows.filter(|row| self.series.level(*row) == level)
            .collect()
    }

    /// An operation with a work and a latency that begins when all of these are known.
    fn operation(&mut self, [work, latency]: [u64; 2], of: &[Number]) -> Number {
        self.work += work;
        let ready = of.iter().map(|x| x.time()).max().unwrap_or(0);
        Number::At(ready + latency)
    }

    /// When the latest of the unknowns of an order is known.
    fn latest(&self) -> u64 {
        self.accelerations
            .iter()
            .map(|x| x.time())
            .max()
            .unwrap_or(0)
    }

    fn expansion(mut self) -> Expansion {
        let series = self.series;
        let [positions, rates, forces] =
            [Level::Position, Level::Rate, Level::Acceleration].map(|level| self.rows_at(level));
        let blocks = self.start([&positions, &rates, &forces]);
        let start = self.work.max(self.latest());

        let later = series.later_forces();
        let forces: Vec<RowId> = (forces.into_iter())
            .filter(|row| later[row.index()])
            .collect();
        let (mut waits, mut work) = (0, 0);
        for _ in 0..ORDERS_UNTIL_STEADY {
            let before = (self.latest(), self.work);
            self.order([&positions, &rates, &forces], &blocks);
            waits = self.latest().saturating_sub(before.0);
            work = self.work - before.1;
        }
        Expansion {
            start,
            work,
            waits,
            registers: self.registers(),
        }
    }

    /// Everything before the loop over orders.
    fn start(&mut self, [positions, rates, forces]: [&[RowId]; 3]) -> Vec<Block> {
        let series = self.series;
        (self.m, self.lead) = (0, 2);
        self.sines_of(positions);
        for row in positions {
            self.value(*row);
        }
        self.begin(1, 2, Level::Position);
        for row in positions {
            self.coefficient(*row, Order::First);
        }
        self.linear = self.newest.clone();
        let lead_of_rates = usize::from(series.rates_are_ahead);
        if series.rates_are_ahead {
            self.begin(0, lead_of_rates, Level::Rate);
            rates.iter().for_each(|row| self.value(*row));
        }
        self.begin(2, 2, Level::Position);
        for row in positions {
            self.coefficient(*row, Order::Later);
        }
        self.begin(lead_of_rates, lead_of_rates, Level::Rate);
        for row in rates {
            match lead_of_rates {
                0 => self.value(*row),
                _ => self.coefficient(*row, Order::First),
            }
        }
        self.begin(0, 0, Level::Acceleration);
        forces.iter().for_each(|row| self.value(*row));
        self.gradients = series.gradients(self, |to, [a, b, c]| to.multiply_add(a, b, c));
        let blocks = self.blocks();
        self.unknowns(&blocks, false);
        self.corrected();
        blocks
    }

    /// Sines of four angles are computed together.
    fn sines_of(&mut self, positions: &[RowId]) {
        let mut angles: Vec<RowId> = Vec::new();
        for row in positions {
            if let Row::Sin(a, _) | Row::Cos(a, _) = self.series.rows[row.index()]
                && !angles.contains(&a)
            {
                angles.push(a);
            }
        }
        self.work += CALL[0] * angles.len().div_ceil(4) as u64;
    }

    /// The factored matrices of coupled unknowns.
    fn blocks(&mut self) -> Vec<Block> {
        let series = self.series;
        let mut blocks = Vec::new();
        for members in series.blocks() {
            let n = members.len() as u64;
            let entries = series.matrix(&members, &self.gradients);
            let ready = entries.iter().flatten().map(|x| x.time()).max();
            // L D Lᵀ takes n³/6 fused multiplications and two operations for each element. The inverse of L takes as many, and L⁻ᵀ D⁻¹ L⁻¹ two for each.
            let cubes = if is_inverse(members.len()) { 4 } else { 1 };
            self.work += PIVOT * n + IN_SHORT_LOOPS * (cubes * n * n * n / 6 + n * n);
            let waits = PIVOT * n;
            let element = Number::At(ready.unwrap_or(0) + waits);
            let composition = series.composition(&members).map(|composition| {
                let each = (0..members.len())
                    .map(|_| composition.coefficients(self, |_, _| element))
                    .collect();
                (composition, each)
            });
            blocks.push(Block {
                members,
                composition,
            });
        }
        blocks
    }

    /// One order.
    fn order(&mut self, [positions, rates, forces]: [&[RowId]; 3], blocks: &[Block]) {
        self.begin(3, 2, Level::Position);
        for row in positions {
            self.coefficient(*row, Order::Later);
        }
        self.begin(3, usize::from(self.series.rates_are_ahead), Level::Rate);
        for row in rates {
            self.coefficient(*row, Order::Later);
        }
        self.begin(3, 0, Level::Acceleration);
        for row in forces {
            self.coefficient(*row, Order::Later);
        }
        self.unknowns(blocks, true);
        self.corrected();
    }

    fn begin(&mut self, m: usize, lead: usize, level: Level) {
        (self.m, self.lead) = (m, lead);
        for (index, of_row) in self.series.levels.iter().enumerate() {
            if *of_row == level {
                (self.newest[index], self.scaled[index]) = (None, None);
            }
        }
    }

    fn value(&mut self, row: RowId) {
        let value = self.series.value(row, self);
        self.first[row.index()] = Some(value);
        self.newest[row.index()] = Some(value);
    }

    fn coefficient(&mut self, row: RowId, order: Order) {
        let found = self.series.coefficient(row, order, self);
        self.newest[row.index()] = Some(found.plain);
        self.scaled[row.index()] = found.weighted;
    }

    /// Solves for the unknowns of an order.
    fn unknowns(&mut self, blocks: &[Block], is_later: bool) {
        let series = self.series;
        for block in blocks {
            let count = block.members.len();
            if let (Some((composition, coefficients)), true) = (&block.composition, is_later) {
                for (member, coefficients) in block.members.iter().zip(coefficients) {
                    let sum = |to: &mut Self, row| to.convolution(row, 0);
                    let found = composition.unknown(series, self, coefficients, sum);
                    self.accelerations[*member as usize] = found;
                }
                continue;
            }
            let mut ready = 0;
            for member in &block.members {
                let residual = self.newest(series.residuals[*member as usize]);
                ready = ready.max(residual.time());
            }
            let n = count as u64;
            let (work, terms) = match count {
                // Numbers in one register each.
                ..=MOST_IN_ONE_SUM => (ARITHMETIC[0] * n * n, n),
                // Columns in registers of four, in two sums.
                _ if is_inverse(count) => {
                    let moves = 2 * MOVES_OF_FOUR * n.div_ceil(4);
                    (OF_FOUR * n * n.div_ceil(4) + moves, n / 2 + 2)
                }
                // Forwards and backwards, where each unknown waits for the one before.
                _ => (ARITHMETIC[0] * n * n, 2 * n),
            };
            self.work += work;
            let found = Number::At(ready + ARITHMETIC[1] * terms);
            for member in &block.members {
                self.accelerations[*member as usize] = found;
            }
        }
    }

    /// The coefficients of an order with the effect of its accelerations, where later orders read them, and their rates.
    fn corrected(&mut self) {
        let series = self.series;
        // The coefficients of rates and of coordinates, which are quotients, in registers of four.
        let registers = series.dimension().div_ceil(4) as u64;
        self.work += registers * (MOVES_OF_FOUR + OF_FOUR + 2 * DIVISION[0]);
        for index in 0..series.rows.len() {
            let row = RowId(index as u32);
            if self.series.level(row) == Level::Constant || self.streams[index] == [false; 2] {
                continue;
            }
            let known = self.newest[index].unwrap_or(Number::Zero);
            if let Row::Coordinate(i) | Row::Rate(i) = series.rows[index] {
                let a = self.accelerations[i as usize];
                self.before[index] = self.operation(ARITHMETIC, &[a]);
                continue;
            }
            let depends = &series.depends[index];
            self.before[index] = match depends[..] {
                [] => known,
                // The slope is multiplied by the reciprocal of the order before.
                [i] if series.lead(row) > 0 => {
                    let a = self.accelerations[i as usize];
                    self.multiply_add(Number::At(0), a, known)
                }
                _ => {
                    let mut sum = Number::Zero;
                    for (at, unknown) in depends.iter().enumerate() {
                        let slope = self.gradients[index][at];
                        let a = self.accelerations[*unknown as usize];
                        sum = self.multiply_add(slope, a, sum);
                    }
                    match series.lead(row) {
                        0 => self.add(known, sum),
                        _ => self.multiply_add(Number::At(0), sum, known),
                    }
                }
            };
        }
    }

    /// The registers that the sums over orders take, four in each, by the order of their terms.
    fn registers(&self) -> u64 {
        let rows = (0..self.series.rows.len() as u32).map(RowId);
        let all: BTreeSet<Convolution> =
            rows.flat_map(|row| self.series.convolutions(row)).collect();
        let of_kind = |along: TermOrder| all.iter().filter(|sum| sum.along == along).count();
        let kinds = [TermOrder::Position, TermOrder::Force, TermOrder::Other].map(of_kind);
        kinds.map(|count| count.div_ceil(4) as u64).iter().sum()
    }
}

impl Arithmetic for Counter<'_> {
    type X = Number;

    fn zero(&mut self) -> Number {
        Number::Zero
    }
    fn one(&mut self) -> Number {
        Number::One
    }
    fn rational(&mut self, value: &Rational) -> Number {
        match value {
            zero if zero.is_zero() => Number::Zero,
            one if one.is_one() => Number::One,
            less if *less == Rational::MINUS_ONE => Number::MinusOne,
            _ => Number::At(0),
        }
    }
    fn pi(&mut self) -> Number {
        Number::At(0)
    }
    fn parameter(&mut self, _: u32) -> Number {
        Number::At(0)
    }
    fn input(&mut self, _: u32) -> Number {
        Number::At(0)
    }
    fn time(&mut self) -> Number {
        Number::At(0)
    }
    fn motion(&mut self, coordinate: u32, is_rate: bool) -> Number {
        match (self.m, is_rate) {
            (0, _) | (1, false) => Number::At(0),
            (_, true) if self.lead == 0 => {
                let a = self.accelerations[coordinate as usize];
                self.operation(ARITHMETIC, &[a])
            }
            _ => Number::Zero,
        }
    }
    fn first(&mut self, row: RowId) -> Number {
        if let Some(known) = self.first[row.index()] {
            return known;
        }
        match &self.series.rows[row.index()] {
            Row::Number(number) if !self.series.varies(row) => self.rational(number),
            _ if self.series.varies(row) => Number::Zero,
            _ => Number::At(0),
        }
    }
    fn newest(&mut self, row: RowId) -> Number {
        match self.series.level(row) {
            Level::Constant => Number::Zero,
            _ if self.series.lead(row) > self.lead => match self.m {
                0 => self.first(row),
                m => self.of_order_before(row, m),
            },
            _ => self.newest[row.index()].unwrap_or(Number::Zero),
        }
    }
    fn before(&mut self, row: RowId) -> Number {
        match self.m {
            1 => self.first(row),
            m => self.of_order_before(row, m),
        }
    }
    fn weighted(&mut self, row: RowId) -> Number {
        match self.scaled[row.index()] {
            _ if self.series.lead(row) > self.lead => self.of_order_before(row, self.m),
            Some(scaled) => scaled,
            None => {
                let newest = self.newest(row);
                self.multiply(Number::At(0), newest)
            }
        }
    }
    fn derivative(&mut self, row: RowId) -> Number {
        let coefficient = match self.m {
            _ if self.series.rates_are_ahead => self.newest[row.index()].unwrap_or(Number::Zero),
            m => self.of_order_before(row, m.max(1)),
        };
        self.multiply(Number::At(0), coefficient)
    }
    fn derivative_factors(&mut self, row: RowId) -> [Number; 2] {
        let newest = self.newest[row.index()].unwrap_or(Number::Zero);
        [Number::At(0), newest]
    }
    fn second_derivative(&mut self, row: RowId) -> Number {
        let [factor, newest] = self.second_factors(row);
        self.multiply(factor, newest)
    }
    fn second_factors(&mut self, row: RowId) -> [Number; 2] {
        let newest = if self.series.is_integral(row) {
            self.scaled[row.index()]
        } else {
            self.newest[row.index()]
        };
        [Number::At(0), newest.unwrap_or(Number::Zero)]
    }
    fn convolution(&mut self, row: RowId, number: usize) -> Number {
        let Convolution {
            factors: [a, b],
            along,
        } = self.series.convolutions(row)[number];
        let of = |to: &Self, stream: Stream| to.linear[stream.row.index()].unwrap_or(Number::Zero);
        let [first_a, first_b] = [a, b].map(|stream| of(self, stream));
        if self.m < 3 {
            return match self.m {
                2 => self.multiply(first_a, first_b),
                _ => Number::Zero,
            };
        }
        let [a, b] = [a, b].map(|stream| self.before[stream.row.index()]);
        match along {
            TermOrder::Other => {
                let ready = a.time().max(b.time());
                Number::At(ready + LATENCY_OF_SUM)
            }
            TermOrder::Force => self.multiply_add(a, first_b, Number::At(0)),
            TermOrder::Position => {
                let sum = self.multiply_add(a, first_b, Number::At(0));
                self.multiply_add(first_a, b, sum)
            }
        }
    }
    fn sin_cos(&mut self, row: RowId) -> [Number; 2] {
        if let Some(known) = self.sines[row.index()] {
            return known;
        }
        let angle = self.first(row);
        let found = [self.operation([0, CALL[1]], &[angle]); 2];
        self.sines[row.index()] = Some(found);
        found
    }
    fn call(&mut self, call: Call, a: Number, b: Number) -> Number {
        let time = match call {
            Call::Sqrt => [45, 180],
            _ => CALL,
        };
        self.operation(time, &[a, b])
    }
    fn exact_sum(&mut self, _: RowId, terms: &[(Option<RowId>, RowId)]) -> Number {
        // Each term with its rounding error.
        self.work += 6 * ARITHMETIC[0] * terms.len() as u64;
        Number::At(2 * ARITHMETIC[1])
    }
    fn over_order(&mut self) -> Number {
        match self.m {
            1 => Number::One,
            _ => Number::At(0),
        }
    }

    fn add(&mut self, a: Number, b: Number) -> Number {
        match (a, b) {
            (Number::Zero, x) | (x, Number::Zero) => x,
            _ => self.operation(ARITHMETIC, &[a, b]),
        }
    }
    fn subtract(&mut self, a: Number, b: Number) -> Number {
        match (a, b) {
            (x, Number::Zero) => x,
            (Number::Zero, x) => self.negate(x),
            _ => self.operation(ARITHMETIC, &[a, b]),
        }
    }
    fn multiply(&mut self, a: Number, b: Number) -> Number {
        match (a, b) {
            (Number::Zero, _) | (_, Number::Zero) => Number::Zero,
            (Number::One, x) | (x, Number::One) => x,
            (Number::MinusOne, x) | (x, Number::MinusOne) => self.negate(x),
            _ => self.operation(ARITHMETIC, &[a, b]),
        }
    }
    fn divide(&mut self, a: Number, b: Number) -> Number {
        match (a, b) {
            (Number::Zero, _) => Number::Zero,
            (x, Number::One) => x,
            (x, Number::MinusOne) => self.negate(x),
            _ => self.operation(DIVISION, &[a, b]),
        }
    }
    fn negate(&mut self, a: Number) -> Number {
        match a {
            Number::Zero => Number::Zero,
            Number::One => Number::MinusOne,
            Number::MinusOne => Number::One,
            _ => self.operation([ARITHMETIC[0], 10], &[a]),
        }
    }
    fn multiply_add(&mut self, a: Number, b: Number, c: Number) -> Number {
        match (a, b, c) {
            (Number::Zero, _, c) | (_, Number::Zero, c) => c,
            (a, b, Number::Zero) => self.multiply(a, b),
            (Number::One, x, c) | (x, Number::One, c) => self.add(x, c),
            (Number::MinusOne, x, c) | (x, Number::MinusOne, c) => self.subtract(c, x),
            _ => self.operation(ARITHMETIC, &[a, b, c]),
        }
    }
}

impl Counter<'_> {
    /// The final coefficient of a row that is further ahead than the present ones, at their order.
    fn of_order_before(&self, row: RowId, m: usize) -> Number {
        match m {
            ..3 => self.linear[row.index()].unwrap_or(Number::Zero),
            _ => self.before[row.index()],
        }
    }
}
