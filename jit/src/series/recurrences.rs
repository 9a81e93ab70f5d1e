//! The recurrences of series as recorded operations.

use lagrangian_program::series::{Arithmetic, RowId};
use lagrangian_symbolic::{Function as Call, Rational};

use super::memory::Place;
use super::record::{MINUS_ONE, ONE, Part, Recorder, X, ZERO};
use crate::lower::Instruction::{Add, Div, Mul, Sub};

impl Recorder<'_> {
    /// Whether zeros are added and multiplied like any other number: in values at the start, where the sign of a zero may decide on a function.
    fn is_literal(&self) -> bool {
        self.part == Part::Values && self.m == 0
    }

    /// `a b + c`, where products with 0 and sums with 0 are left out.
    pub fn simplified(&mut self, a: X, b: X, c: X) -> X {
        match (a, b, c) {
            (ZERO, _, c) | (_, ZERO, c) => c,
            (ONE, x, ZERO) | (x, ONE, ZERO) => x,
            (ONE, x, c) | (x, ONE, c) => self.binary(Add, x, c),
            (MINUS_ONE, x, ZERO) | (x, MINUS_ONE, ZERO) => self.negative(x),
            (MINUS_ONE, x, c) | (x, MINUS_ONE, c) => self.binary(Sub, c, x),
            (a, b, ZERO) => self.binary(Mul, a, b),
            _ => self.mul_add(a, b, c),
        }
    }
}

impl Arithmetic for Recorder<'_> {
    type X = X;

    fn zero(&mut self) -> X {
        ZERO
    }
    fn one(&mut self) -> X {
        ONE
    }
    fn rational(&mut self, value: &Rational) -> X {
        X::Literal(value.evaluate::<f64>().to_bits())
    }
    fn pi(&mut self) -> X {
        X::Literal(std::f64::consts::PI.to_bits())
    }
    fn parameter(&mut self, _: u32) -> X {
        // Rows that depend on parameters alone are read from memory.
        ZERO
    }
    fn input(&mut self, index: u32) -> X {
        X::Stored(Place::Fixed(self.memory.inputs() + index))
    }
    fn time(&mut self) -> X {
        X::Stored(Place::Fixed(self.memory.time()))
    }
    fn motion(&mut self, coordinate: u32, is_rate: bool) -> X {
        let [q, v] = [self.memory.coordinates(), self.memory.velocities()]
            .map(|at| X::Stored(Place::Fixed(at + coordinate)));
        match (self.part, self.m, is_rate) {
            (Part::Later, _, true) if self.lead() == 0 => {
                X::Stored(Place::Record(1, self.memory.rates() + coordinate))
            }
            (Part::Later, ..) => ZERO,
            (_, 0, false) => q,
            (_, 0, true) | (_, 1, false) => v,
            _ => ZERO,
        }
    }
    fn first(&mut self, row: RowId) -> X {
        self.value_of(row)
    }
    fn newest(&mut self, row: RowId) -> X {
        self.read(row, self.m)
    }
    fn before(&mut self, row: RowId) -> X {
        self.read(row, self.m - 1)
    }
    fn weighted(&mut self, row: RowId) -> X {
        if self.has_final_weighted(row) {
            self.read_weighted(row, self.m)
        } else {
            self.scaled[row.index()].unwrap_or(ZERO)
        }
    }
    fn derivative(&mut self, row: RowId) -> X {
        let [number, x] = self.derivative_factors(row);
        self.multiply(number, x)
    }
    fn derivative_factors(&mut self, row: RowId) -> [X; 2] {
        let m = self.m + 1;
        [self.number(m), self.read(row, m)]
    }
    fn second_derivative(&mut self, row: RowId) -> X {
        let number = self.number(self.m + 1);
        let scaled = self.scaled[row.index()].unwrap_or(ZERO);
        self.multiply(number, scaled)
    }
    fn second_factors(&mut self, row: RowId) -> [X; 2] {
        let m = self.m + 1;
        let order = self.number(m);
        if self.series.is_integral(row) {
            return [order, self.scaled[row.index()].unwrap_or(ZERO)];
        }
        let next = self.number(m + 1);
        [self.multiply(order, next), self.read(row, m + 1)]
    }
    fn convolution(&mut self, row: RowId, number: usize) -> X {
        let convolution = self.series.convolutions(row)[number];
        self.sum_over_orders(convolution)
    }
    fn sin_cos(&mut self, row: RowId) -> [X; 2] {
        let angle = self.first(row);
        let [sin, cos] = [0, 1].map(|at| self.built([angle], |to, [angle]| to.circular(angle)[at]));
        if !self.series.exact[row.index()] {
            return [sin, cos];
        }
        let low = self.low[row.index()].unwrap_or(ZERO);
        [self.mul_add(low, cos, sin), self.neg_mul_add(low, sin, cos)]
    }
    fn call(&mut self, call: Call, a: X, b: X) -> X {
        match call {
            Call::Atan2 | Call::Min | Call::Max | Call::Pow => {
                self.built([a, b], |to, [a, b]| to.pair(call, a, b))
            }
            _ => self.built([a], |to, [a]| to.unary(call, a)),
        }
    }
    fn exact_sum(&mut self, row: RowId, terms: &[(Option<RowId>, RowId)]) -> X {
        let (mut sum, mut low) = (ZERO, ZERO);
        for (coefficient, of) in terms {
            let x = self.first(*of);
            let x_low = if self.series.exact[of.index()] {
                self.low[of.index()].unwrap_or(ZERO)
            } else {
                ZERO
            };
            let (term, term_low) = match coefficient {
                None => (x, x_low),
                Some(c) => {
                    let c = self.first(*c);
                    let error = self.product_error(c, x);
                    (self.binary(Mul, c, x), self.mul_add(c, x_low, error))
                }
            };
            let error = self.sum_error(sum, term);
            let more = self.binary(Add, term_low, error);
            low = self.binary(Add, low, more);
            sum = self.binary(Add, sum, term);
        }
        self.low[row.index()] = Some(low);
        sum
    }
    fn over_order(&mut self) -> X {
        self.reciprocal(self.m)
    }

    fn add(&mut self, a: X, b: X) -> X {
        match (a, b) {
            (ZERO, x) | (x, ZERO) if !self.is_literal() => x,
            _ => self.binary(Add, a, b),
        }
    }
    fn subtract(&mut self, a: X, b: X) -> X {
        match (a, b) {
            (x, ZERO) => x,
            (ZERO, x) if !self.is_literal() => self.negate(x),
            _ => self.binary(Sub, a, b),
        }
    }
    fn multiply(&mut self, a: X, b: X) -> X {
        match (a, b) {
            (ZERO, _) | (_, ZERO) if !self.is_literal() => ZERO,
            (ONE, x) | (x, ONE) => x,
            _ => self.binary(Mul, a, b),
        }
    }
    fn divide(&mut self, a: X, b: X) -> X {
        match (a, b) {
            (ZERO, _) if !self.is_literal() => ZERO,
            (x, ONE) => x,
            _ => self.binary(Div, a, b),
        }
    }
    fn negate(&mut self, a: X) -> X {
        match a {
            ZERO => ZERO,
            ONE => MINUS_ONE,
            MINUS_ONE => ONE,
            _ => self.negative(a),
        }
    }
    fn multiply_add(&mut self, a: X, b: X, c: X) -> X {
        if self.is_literal() {
            return self.mul_add(a, b, c);
        }
        self.simplified(a, b, c)
    }
}
