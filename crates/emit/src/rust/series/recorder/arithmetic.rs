//! The operations of the recurrences, recorded.

use lagrangian_program::series::{Arithmetic, Level, Row, RowId, Stream, TermOrder};
use lagrangian_symbolic::{Function as Call, Rational};

use super::super::code::{Op, Operand, Part};
use super::super::{Carried, SUMS, WIDTH};
use super::Recorder;
use crate::rust::language;

impl Arithmetic for Recorder<'_> {
    type X = Operand;

    fn zero(&mut self) -> Operand {
        Operand::Zero
    }
    fn one(&mut self) -> Operand {
        Operand::One
    }
    fn rational(&mut self, value: &Rational) -> Operand {
        if value.is_zero() {
            Operand::Zero
        } else if value.is_one() {
            Operand::One
        } else if *value == Rational::MINUS_ONE {
            Operand::MinusOne
        } else {
            let text = language::rational(self.code.number(), value).text;
            self.existing_value(text)
        }
    }
    fn pi(&mut self) -> Operand {
        self.constructed("pi()")
    }
    fn parameter(&mut self, index: u32) -> Operand {
        let names = self.parameters.as_ref();
        let name = names.map_or("", |names| names[index as usize].as_str());
        self.existing_value(format!("self.{name}"))
    }
    fn input(&mut self, index: u32) -> Operand {
        let text = format!("n(u.{})", self.inputs[index as usize]);
        self.existing_value(text)
    }
    fn time(&mut self) -> Operand {
        self.existing_value("n(t[0])".into())
    }
    fn motion(&mut self, coordinate: u32, is_rate: bool) -> Operand {
        match (self.m, is_rate) {
            (0, false) => self.existing_value(format!("n(q[{coordinate}])")),
            (0, true) | (1, false) => self.existing_value(format!("n(v[{coordinate}])")),
            (_, true) if self.lead == 0 => self.rate_before(coordinate),
            _ => Operand::Zero,
        }
    }
    fn first(&mut self, row: RowId) -> Operand {
        if let Some(known) = self.first[row.index()] {
            return known;
        }
        if self.series.varies(row) {
            // No row needs a value before it is known.
            return Operand::Zero;
        }
        let value = match (&self.series.rows[row.index()], &self.parameters) {
            (Row::Number(number), _) if is_plain(number) => self.rational(number),
            (_, Some(_)) => self.series.value(row, self),
            (_, None) => {
                let at = self.constants.len();
                self.constants.push(row);
                let part = std::mem::replace(&mut self.part, Part::Start);
                let read = self.existing_value(format!("n(p.series[{at}])"));
                self.part = part;
                read
            }
        };
        self.first[row.index()] = Some(value);
        value
    }
    fn newest(&mut self, row: RowId) -> Operand {
        match self.series.level(row) {
            Level::Constant => Operand::Zero,
            // Its own order is higher.
            _ if self.series.lead(row) > self.lead => match self.m {
                0 => self.first(row),
                m => self.of_order_before(row, false, m),
            },
            _ => self.newest[row.index()].unwrap_or(Operand::Zero),
        }
    }
    fn before(&mut self, row: RowId) -> Operand {
        match self.m {
            1 => self.first(row),
            2 => self.linear[row.index()].unwrap_or(Operand::Zero),
            _ => self.variable(Carried::Plain(row)),
        }
    }
    fn weighted(&mut self, row: RowId) -> Operand {
        match self.scaled[row.index()] {
            _ if self.series.lead(row) > self.lead => self.of_order_before(row, true, self.m),
            Some(scaled) => scaled,
            None => {
                let (order, newest) = (self.order(0), self.newest(row));
                self.multiply(order, newest)
            }
        }
    }
    fn derivative(&mut self, row: RowId) -> Operand {
        let coefficient = match self.m {
            // It was just computed.
            _ if self.series.rates_are_ahead => self.newest[row.index()].unwrap_or(Operand::Zero),
            0 => self.linear[row.index()].unwrap_or(Operand::Zero),
            _ => self.variable(Carried::Plain(row)),
        };
        let order = self.order(1);
        self.multiply(order, coefficient)
    }
    fn derivative_factors(&mut self, row: RowId) -> [Operand; 2] {
        let coefficient = self.newest[row.index()].unwrap_or(Operand::Zero);
        [self.order(1), coefficient]
    }
    fn second_derivative(&mut self, row: RowId) -> Operand {
        // The row was computed at an order higher by two.
        let scaled = match self.scaled[row.index()] {
            Some(scaled) => scaled,
            None => {
                let newest = self.newest[row.index()].unwrap_or(Operand::Zero);
                let order = self.order(2);
                self.multiply(order, newest)
            }
        };
        let order = self.order(1);
        self.multiply(order, scaled)
    }
    fn second_factors(&mut self, row: RowId) -> [Operand; 2] {
        let order = self.order(1);
        if self.series.is_integral(row) {
            [order, self.scaled[row.index()].unwrap_or(Operand::Zero)]
        } else {
            let two = self.order(2);
            let factor = self.multiply(order, two);
            [factor, self.newest[row.index()].unwrap_or(Operand::Zero)]
        }
    }
    fn convolution(&mut self, row: RowId, number: usize) -> Operand {
        let convolution = self.series.convolutions(row)[number];
        let [a, b] = convolution.factors;
        if self.m < 3 {
            // Of positions one term of the second order, none of the first, and none of rates, which have no second order here.
            let of =
                |symbolic: &Self, stream: Stream| match symbolic.series.rows[stream.row.index()] {
                    _ if symbolic.m < 2 => Operand::Zero,
                    _ => symbolic.linear[stream.row.index()].unwrap_or(Operand::Zero),
                };
            let [a, b] = [a, b].map(|stream| of(self, stream));
            return self.multiply(a, b);
        }
        let (kind, lane) = self.places[&convolution];
        let letter = SUMS[kind];
        let sum = self.existing_value(format!("{letter}{}[{}]", lane / WIDTH, lane % WIDTH));
        let carried = |Stream { row, weighted }: Stream| {
            if weighted {
                Carried::Weighted(row)
            } else {
                Carried::Plain(row)
            }
        };
        let linear = |symbolic: &Self, stream: Stream| {
            symbolic.linear[stream.row.index()].unwrap_or(Operand::Zero)
        };
        match convolution.along {
            TermOrder::Other => sum,
            TermOrder::Force => {
                let (a, b) = (self.variable(carried(a)), linear(self, b));
                self.multiply_add(a, b, sum)
            }
            TermOrder::Position => {
                let [first_a, first_b] = [linear(self, a), linear(self, b)];
                let a = self.variable(carried(a));
                let sum = self.multiply_add(a, first_b, sum);
                let b = self.variable(carried(b));
                self.multiply_add(first_a, b, sum)
            }
        }
    }
    fn sin_cos(&mut self, row: RowId) -> [Operand; 2] {
        if let Some(known) = self.circular.get(&row) {
            return *known;
        }
        let angle = self.first(row);
        let pair = self.push(Op::Circular(vec![angle]));
        let sin_cos = [false, true].map(|cos| self.push(Op::Member(pair, 0, cos)));
        let turned = self.corrected_sin_cos(row, sin_cos);
        self.circular.insert(row, turned);
        turned
    }
    fn call(&mut self, call: Call, a: Operand, b: Operand) -> Operand {
        match call {
            Call::Pow => self.push(Op::Method("powf", vec![a, b])),
            Call::Atan2 => self.push(Op::Method("atan2", vec![a, b])),
            Call::Min => self.push(Op::Method("min", vec![a, b])),
            Call::Max => self.push(Op::Method("max", vec![a, b])),
            _ => self.push(Op::Method(call.name(), vec![a])),
        }
    }
    fn exact_sum(&mut self, row: RowId, terms: &[(Option<RowId>, RowId)]) -> Operand {
        let (mut sum, mut low) = (Operand::Zero, Operand::Zero);
        for (coefficient, of) in terms {
            let x = self.first(*of);
            let x_low = if self.series.exact[of.index()] {
                self.low[of.index()].unwrap_or(Operand::Zero)
            } else {
                Operand::Zero
            };
            let (term, term_low) = match coefficient {
                None => (x, x_low),
                Some(c) => {
                    let c = self.first(*c);
                    let error = match (c, x) {
                        (Operand::Value(_), Operand::Value(_)) => {
                            self.push(Op::Method("product_error", vec![c, x]))
                        }
                        _ => Operand::Zero,
                    };
                    let low = self.multiply_add(c, x_low, error);
                    (self.multiply(c, x), low)
                }
            };
            let error = match (sum, term) {
                (Operand::Zero, _) | (_, Operand::Zero) => Operand::Zero,
                _ => self.push(Op::Method("sum_error", vec![sum, term])),
            };
            let more = self.add(term_low, error);
            low = self.add(low, more);
            sum = self.add(sum, term);
        }
        self.low[row.index()] = Some(low);
        sum
    }
    fn over_order(&mut self) -> Operand {
        match (self.m, self.lead) {
            (1, _) => Operand::One,
            (2, _) => self.constructed("from_f64(0.5)"),
            (_, 2) => self.constructed("from_ratio(1, order as i64)"),
            (_, lead) => self.constructed(&format!("from_ratio(1, order as i64 - {})", 2 - lead)),
        }
    }

    fn add(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Zero, x) | (x, Operand::Zero) => x,
            (x, Operand::MinusOne) => self.push(Op::Infix("-", x, Operand::One)),
            _ => self.push(Op::Infix("+", a, b)),
        }
    }
    fn subtract(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (x, Operand::Zero) => x,
            (Operand::Zero, x) => self.negate(x),
            (x, Operand::MinusOne) => self.push(Op::Infix("+", x, Operand::One)),
            _ => self.push(Op::Infix("-", a, b)),
        }
    }
    fn multiply(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Zero, _) | (_, Operand::Zero) => Operand::Zero,
            (Operand::One, x) | (x, Operand::One) => x,
            (Operand::MinusOne, x) | (x, Operand::MinusOne) => self.negate(x),
            _ => self.push(Op::Infix("*", a, b)),
        }
    }
    fn divide(&mut self, a: Operand, b: Operand) -> Operand {
        match (a, b) {
            (Operand::Zero, _) => Operand::Zero,
            (x, Operand::One) => x,
            (x, Operand::MinusOne) => self.negate(x),
            _ => self.push(Op::Infix("/", a, b)),
        }
    }
    fn negate(&mut self, a: Operand) -> Operand {
        match a {
            Operand::Zero => Operand::Zero,
            Operand::One => Operand::MinusOne,
            Operand::MinusOne => Operand::One,
            _ => self.push(Op::Negative(a)),
        }
    }
    fn multiply_add(&mut self, a: Operand, b: Operand, c: Operand) -> Operand {
        match (a, b, c) {
            (Operand::Zero, _, c) | (_, Operand::Zero, c) => c,
            (a, b, Operand::Zero) => self.multiply(a, b),
            (Operand::One, x, c) | (x, Operand::One, c) => self.add(x, c),
            (Operand::MinusOne, x, c) | (x, Operand::MinusOne, c) => self.subtract(c, x),
            (a, b, Operand::MinusOne) => self.push(Op::Method("mul_sub", vec![a, b, Operand::One])),
            _ => self.push(Op::Method("mul_add", vec![a, b, c])),
        }
    }
}

/// Whether a number is written as a literal: 0 or ±1.
fn is_plain(number: &Rational) -> bool {
    number.is_zero() || number.is_one() || *number == Rational::MINUS_ONE
}
