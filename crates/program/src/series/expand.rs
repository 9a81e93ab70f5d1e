//! The coefficients of a series at a state, over any number.
//!
//! Round k computes the accelerations of order k. Rows of positions are carried to order k + 2 as if `q` had no coefficient
//! there; rates and forces to order k; the residuals then lack the accelerations of order k, which stand in them with the
//! mass matrix at the start. These are solved for, and what they change in rows that later rounds read is added: to
//! rows of positions their gradient by `q` times `q₍k₊₂₎`, to forces their gradient by `a` times `aₖ`. Gradients are
//! those at the start, since what multiplies the newest coefficient is of order 0.

use std::sync::Arc;

use lagrangian_scalar::Scalar;
use lagrangian_symbolic::Function as Call;

use super::{Level, Row, RowId, Series};
use crate::Singular;
use crate::interpret::{binary, unary};

/// A series ready to be expanded over numbers that are kept as `T`. Nothing is allocated after [`Expander::new`].
#[derive(Clone, Debug)]
pub struct Expander<T> {
    series: Arc<Series>,
    parameters: Vec<T>,
    /// How many accelerations are found.
    order: usize,
    /// Coefficients of a row: `order + 2`.
    width: usize,
    /// The rows that change, by their levels.
    by_level: [Vec<u32>; 3],
    /// Rows of positions and forces that the newest accelerations change.
    repaired: [Vec<u32>; 2],
    /// Whether a row knows what rounding took from it at order 0.
    has_low: Vec<bool>,
    coefficients: Vec<T>,
    low: Vec<T>,
    /// Where the gradient of each row begins.
    places: Vec<usize>,
    gradients: Vec<T>,
    /// Coefficients of the coordinates, one coordinate after another.
    motion: Vec<T>,
    inputs: Vec<T>,
    /// Coefficients of the multipliers, one constraint after another.
    multipliers: Vec<T>,
    /// The lower triangle of L and the reciprocals of D, of the matrix of what is solved for.
    factors: Vec<T>,
    right: Vec<T>,
    /// 0, 1, 2 … and their reciprocals, the first of which is not read.
    numbers: Vec<[T; 2]>,
}

impl<T: Scalar<Stored = T>> Expander<T> {
    /// A series with parameters, to be expanded to `order` coefficients of the accelerations.
    ///
    /// # Panics
    /// If there are not as many parameters as the series has.
    pub fn new(series: Arc<Series>, parameters: &[T], order: usize) -> Expander<T> {
        assert_eq!(parameters.len(), series.parameters, "one number for each");
        let (rows, n, width) = (series.rows.len(), series.dimension(), order + 2);
        let unknowns = series.unknowns();
        let at_level = |level: Level| -> Vec<u32> {
            let levels = (0..).zip(&series.levels);
            levels
                .filter(|(_, l)| **l == level)
                .map(|(i, _)| i)
                .collect()
        };
        let mut is_factor = vec![false; rows];
        for row in &series.rows {
            if let Row::Product(a, b) | Row::Quotient(a, b) = row {
                (is_factor[a.index()], is_factor[b.index()]) = (true, true);
            }
        }
        let changes = |row: &u32| !series.depends[*row as usize].is_empty();
        let mut repaired = [at_level(Level::Position), at_level(Level::Acceleration)];
        repaired[0].retain(changes);
        repaired[1].retain(|row| changes(row) && is_factor[*row as usize]);
        let mut has_low: Vec<bool> = Vec::with_capacity(rows);
        for row in &series.rows {
            has_low.push(match row {
                Row::Time => true,
                Row::Sum(terms) => terms.iter().any(|(_, row)| has_low[row.index()]),
                _ => false,
            });
        }
        let mut places = Vec::with_capacity(rows);
        let mut length = 0;
        for depends in &series.depends {
            places.push(length);
            length += depends.len();
        }
        let number = |j: usize| {
            let j = j as i64;
            [T::from_ratio(j, 1), T::from_ratio(1, j.max(1))]
        };
        let mut expander = Expander {
            by_level: [Level::Position, Level::Rate, Level::Acceleration].map(at_level),
            repaired,
            has_low,
            parameters: parameters.to_vec(),
            order,
            width,
            coefficients: vec![T::ZERO; rows * width],
            low: vec![T::ZERO; rows],
            places,
            gradients: vec![T::ZERO; length],
            motion: vec![T::ZERO; n * width],
            inputs: vec![T::ZERO; series.inputs],
            multipliers: vec![T::ZERO; (unknowns - n) * order],
            factors: vec![T::ZERO; unknowns * unknowns],
            right: vec![T::ZERO; unknowns],
            numbers: (0..=width).map(number).collect(),
            series,
        };
        expander.prepare();
        expander
    }

    /// Computes what depends on parameters alone.
    fn prepare(&mut self) {
        for index in 0..self.series.rows.len() {
            if self.series.levels[index] == Level::Constant {
                let (value, _) = self.value::<T>(index, T::ZERO);
                self.coefficients[index * self.width] = value;
            }
        }
    }
}

impl<T: Copy> Expander<T> {
    /// How many coefficients of the accelerations there are.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The coefficients of a coordinate, `order + 2` many.
    pub fn of_coordinate(&self, coordinate: usize) -> &[T] {
        &self.motion[coordinate * self.width..][..self.width]
    }

    /// The coefficients of the multiplier of a constraint, `order` many.
    pub fn of_multiplier(&self, constraint: usize) -> &[T] {
        &self.multipliers[constraint * self.order..][..self.order]
    }

    /// Expands the motion through a state in arithmetic on numbers `N`. The time is the sum of the two.
    ///
    /// An error where the mass matrix cannot be inverted.
    #[inline(always)]
    pub fn expand<N: Scalar<Stored = T>>(
        &mut self,
        t: [T; 2],
        q: &[T],
        v: &[T],
        u: &[T],
    ) -> Result<(), Singular> {
        let (n, width) = (self.series.dimension(), self.width);
        self.inputs.copy_from_slice(u);
        for i in 0..n {
            let motion = &mut self.motion[i * width..][..width];
            motion.fill(N::ZERO.store());
            motion[0] = q[i];
            motion[1] = v[i];
        }
        for at in 0..self.by_level[0].len() {
            let index = self.by_level[0][at] as usize;
            let (value, low) = match self.series.rows[index] {
                Row::Time => (N::load(t[0]), N::load(t[1])),
                _ => self.value::<N>(index, N::load(t[0])),
            };
            self.coefficients[index * width] = value.store();
            self.low[index] = low.store();
        }
        for at in 0..self.by_level[0].len() {
            let index = self.by_level[0][at] as usize;
            self.coefficients[index * width + 1] = self.coefficient::<N>(index, 1).store();
        }
        for round in 0..self.order {
            for at in 0..self.by_level[0].len() {
                let index = self.by_level[0][at] as usize;
                let value = self.coefficient::<N>(index, round + 2);
                self.coefficients[index * width + round + 2] = value.store();
            }
            for level in 1..3 {
                for at in 0..self.by_level[level].len() {
                    let index = self.by_level[level][at] as usize;
                    let value = match round {
                        0 => self.value::<N>(index, N::ZERO).0,
                        _ => self.coefficient::<N>(index, round),
                    };
                    self.coefficients[index * width + round] = value.store();
                }
            }
            if round == 0 {
                self.differentiate::<N>();
                self.factor::<N>()?;
            }
            self.solve::<N>(round);
        }
        Ok(())
    }

    #[inline(always)]
    fn read<N: Scalar<Stored = T>>(&self, row: RowId, k: usize) -> N {
        N::load(self.coefficients[row.index() * self.width + k])
    }

    #[inline(always)]
    fn first<N: Scalar<Stored = T>>(&self, row: RowId) -> N {
        self.read(row, 0)
    }

    #[inline(always)]
    fn number<N: Scalar<Stored = T>>(&self, j: usize) -> N {
        N::load(self.numbers[j][0])
    }

    #[inline(always)]
    fn over<N: Scalar<Stored = T>>(&self, j: usize) -> N {
        N::load(self.numbers[j][1])
    }

    /// The coefficients `from..=to` of a row.
    #[inline(always)]
    fn range(&self, row: RowId, from: usize, to: usize) -> &[T] {
        &self.coefficients[row.index() * self.width..][from..to + 1]
    }

    /// The value of a row at the start, and what rounding took from it where that is known.
    #[inline(always)]
    fn value<N: Scalar<Stored = T>>(&self, index: usize, t: N) -> (N, N) {
        let x = |row: RowId| self.first::<N>(row);
        let value = match self.series.rows[index] {
            Row::Number(ref number) => number.evaluate(),
            Row::Pi => N::pi(),
            Row::Parameter(i) => N::load(self.parameters[i as usize]),
            Row::Input(i) => N::load(self.inputs[i as usize]),
            Row::Time => t,
            Row::Coordinate(i) => N::load(self.motion[i as usize * self.width]),
            Row::Rate(i) => N::load(self.motion[i as usize * self.width + 1]),
            Row::Acceleration(_) => N::ZERO,
            Row::First(p) => self.read(p, 1),
            Row::Second(p) => self.number::<N>(2) * self.read(p, 2),
            Row::Sum(ref terms) => return self.sum_with_low(terms, self.has_low[index]),
            Row::Product(a, b) => x(a) * x(b),
            Row::Square(a) => x(a) * x(a),
            Row::Quotient(a, b) => x(a) / x(b),
            Row::Sqrt(a) => x(a).sqrt(),
            Row::Sin(a, _) => self.sin_cos::<N>(a).0,
            Row::Cos(a, _) => self.sin_cos::<N>(a).1,
            Row::Sinh(a, _) => x(a).sinh(),
            Row::Cosh(a, _) => x(a).cosh(),
            Row::Tanh(a, _) => x(a).tanh(),
            Row::TanhSlope(a) => N::ONE - x(a) * x(a),
            Row::Exp(a) => x(a).exp(),
            Row::Power(a, r) => x(a).powf(x(r)),
            Row::Primitive(call, a, _) => unary(call, x(a)),
            Row::Atan2(y, over, _) => x(y).atan2(x(over)),
            Row::Constant(call, a, b) => match call {
                Call::Sin => x(a).sin(),
                Call::Cos => x(a).cos(),
                Call::Atan2 | Call::Min | Call::Max | Call::Pow => binary(call, x(a), x(b)),
                _ => unary(call, x(a)),
            },
        };
        (value, N::ZERO)
    }

    /// A sum at order 0. With what rounding took from its terms and from itself, so that a phase is exact.
    #[inline(always)]
    fn sum_with_low<N: Scalar<Stored = T>>(
        &self,
        terms: &[(Option<RowId>, RowId)],
        has_low: bool,
    ) -> (N, N) {
        let (mut sum, mut low) = (N::ZERO, N::ZERO);
        for (coefficient, row) in terms {
            let x = self.first::<N>(*row);
            if !has_low {
                sum = match coefficient {
                    None => sum + x,
                    Some(c) => self.first::<N>(*c).mul_add(x, sum),
                };
                continue;
            }
            let x_low = N::load(self.low[row.index()]);
            let (term, term_low) = match coefficient {
                None => (x, x_low),
                Some(c) => {
                    let c = self.first::<N>(*c);
                    (c * x, c.product_error(x) + c * x_low)
                }
            };
            low = low + (term_low + sum.sum_error(term));
            sum = sum + term;
        }
        (sum, low)
    }

    /// Sine and cosine of a row at order 0, turned by what rounding took from it.
    #[inline(always)]
    fn sin_cos<N: Scalar<Stored = T>>(&self, a: RowId) -> (N, N) {
        let (sin, cos) = self.first::<N>(a).sin_cos();
        if !self.has_low[a.index()] {
            return (sin, cos);
        }
        let low = N::load(self.low[a.index()]);
        (sin + low * cos, cos - low * sin)
    }

    /// Coefficient `k ≥ 1` of a row, those before it and those of its operands being known.
    #[inline(always)]
    fn coefficient<N: Scalar<Stored = T>>(&self, index: usize, k: usize) -> N {
        let row = RowId(index as u32);
        let x = |row: RowId| self.read::<N>(row, k);
        let varies = |row: RowId| self.series.levels[row.index()] > Level::Constant;
        let dot = |a: RowId, b: RowId, from: usize, to: usize| -> N {
            dot(self.range(a, from, to), self.range(b, k - to, k - from))
        };
        // Σ j a_j b_{k−j}
        let weighted = |a: RowId, b: RowId, to: usize| -> N {
            let pairs = self
                .range(a, 1, to)
                .iter()
                .zip(self.range(b, k - to, k - 1).iter().rev());
            let numbers = &self.numbers[1..=to];
            pairs.zip(numbers).fold(N::ZERO, |sum, ((&a, &b), j)| {
                (N::load(j[0]) * N::load(a)).mul_add(N::load(b), sum)
            })
        };
        match self.series.rows[index] {
            Row::Number(_) | Row::Pi | Row::Parameter(_) | Row::Constant(..) | Row::Input(_) => {
                N::ZERO
            }
            Row::Time => match k {
                1 => N::ONE,
                _ => N::ZERO,
            },
            Row::Coordinate(i) => N::load(self.motion[i as usize * self.width + k]),
            Row::Rate(i) => {
                self.number::<N>(k + 1) * N::load(self.motion[i as usize * self.width + k + 1])
            }
            Row::Acceleration(_) => N::ZERO,
            Row::First(p) => self.number::<N>(k + 1) * self.read(p, k + 1),
            Row::Second(p) => {
                self.number::<N>(k + 1) * (self.number::<N>(k + 2) * self.read::<N>(p, k + 2))
            }
            Row::Sum(ref terms) => terms.iter().fold(N::ZERO, |sum, (c, row)| match c {
                None => sum + x(*row),
                Some(c) => self.first::<N>(*c).mul_add(x(*row), sum),
            }),
            Row::Product(a, b) => match [varies(a), varies(b)] {
                [true, true] => dot(a, b, 0, k),
                [false, _] => self.first::<N>(a) * x(b),
                [_, false] => x(a) * self.first::<N>(b),
            },
            Row::Square(a) => self.square(a, k, 0),
            Row::Quotient(a, b) if !varies(b) => x(a) / self.first(b),
            Row::Quotient(a, b) => (x(a) - dot(b, row, 1, k)) / self.first(b),
            Row::Sqrt(a) => {
                let root = self.first::<N>(row);
                (x(a) - self.square::<N>(row, k, 1)) / (root + root)
            }
            Row::Sin(a, other) | Row::Sinh(a, other) | Row::Cosh(a, other) => {
                self.over::<N>(k) * weighted(a, other, k)
            }
            Row::Cos(a, other) => -(self.over::<N>(k) * weighted(a, other, k)),
            Row::Tanh(a, slope) => self.over::<N>(k) * weighted(a, slope, k),
            Row::TanhSlope(a) => -self.square::<N>(a, k, 0),
            Row::Exp(a) => self.over::<N>(k) * weighted(a, row, k),
            Row::Power(a, r) => {
                let r = self.first::<N>(r);
                let mut sum = N::ZERO;
                for j in 0..k {
                    let weight = r * self.number(k - j) - self.number::<N>(j);
                    let product = self.read::<N>(a, k - j) * self.read(row, j);
                    sum = weight.mul_add(product, sum);
                }
                self.over::<N>(k) * sum / self.first(a)
            }
            Row::Primitive(_, a, slope) => {
                let known = match k {
                    1 => N::ZERO,
                    _ => weighted(row, slope, k - 1),
                };
                (x(a) - self.over::<N>(k) * known) / self.first(slope)
            }
            Row::Atan2(y, x, slope) => {
                let known = match k {
                    1 => N::ZERO,
                    _ => weighted(row, slope, k - 1),
                };
                let area = weighted(y, x, k) - weighted(x, y, k);
                self.over::<N>(k) * (area - known) / self.first(slope)
            }
        }
    }

    /// `Σ a_j a_{k−j}` over `from ≤ j ≤ k − from`, each pair once.
    #[inline(always)]
    fn square<N: Scalar<Stored = T>>(&self, a: RowId, k: usize, from: usize) -> N {
        let mut sum = N::ZERO;
        for j in from..k.div_ceil(2) {
            sum = self.read::<N>(a, j).mul_add(self.read(a, k - j), sum);
        }
        sum = sum + sum;
        if k.is_multiple_of(2) && k >= 2 * from {
            let middle = self.read::<N>(a, k / 2);
            sum = middle.mul_add(middle, sum);
        }
        sum
    }

    /// The gradients of all rows at the start, by the chain rule.
    #[inline(always)]
    fn differentiate<N: Scalar<Stored = T>>(&mut self) {
        for index in 0..self.series.rows.len() {
            if self.series.depends[index].is_empty() {
                continue;
            }
            let row = RowId(index as u32);
            let place = self.places[index];
            let count = self.series.depends[index].len();
            self.gradients[place..place + count].fill(N::ZERO.store());
            let x = |row: RowId| self.first::<N>(row);
            let one = N::ONE;
            let two = |x: N| x + x;
            // The operands and the derivatives by them.
            let parts: [Option<(RowId, N)>; 2] = match self.series.rows[index] {
                Row::Coordinate(_) | Row::Acceleration(_) => {
                    self.gradients[place] = N::ONE.store();
                    continue;
                }
                Row::Sum(_) => {
                    let length = match &self.series.rows[index] {
                        Row::Sum(terms) => terms.len(),
                        _ => 0,
                    };
                    for term in 0..length {
                        let Row::Sum(terms) = &self.series.rows[index] else {
                            continue;
                        };
                        let (c, of) = terms[term];
                        let c = c.map_or(N::ONE, |c| self.first::<N>(c));
                        self.add_gradient(index, of, c);
                    }
                    continue;
                }
                Row::Second(p) => [Some((p, one)), None],
                Row::Product(a, b) => [Some((a, x(b))), Some((b, x(a)))],
                Row::Square(a) => [Some((a, two(x(a)))), None],
                Row::Quotient(a, b) => {
                    let slope = one / x(b);
                    [Some((a, slope)), Some((b, -(x(row) * slope)))]
                }
                Row::Sqrt(a) => [Some((a, one / two(x(row)))), None],
                Row::Sin(a, cos) => [Some((a, x(cos))), None],
                Row::Cos(a, sin) => [Some((a, -x(sin))), None],
                Row::Sinh(a, other) | Row::Cosh(a, other) => [Some((a, x(other))), None],
                Row::Tanh(a, slope) => [Some((a, x(slope))), None],
                Row::TanhSlope(a) => [Some((a, -two(x(a)))), None],
                Row::Exp(a) => [Some((a, x(row))), None],
                Row::Power(a, r) => [Some((a, x(r) * x(row) / x(a))), None],
                Row::Primitive(_, a, slope) => [Some((a, one / x(slope))), None],
                Row::Atan2(y, over, slope) => [
                    Some((y, x(over) / x(slope))),
                    Some((over, -(x(y) / x(slope)))),
                ],
                _ => [None, None],
            };
            for (of, slope) in parts.into_iter().flatten() {
                self.add_gradient(index, of, slope);
            }
        }
    }

    /// Adds a multiple of the gradient of one row to that of another. What changes at another level does not count.
    #[inline(always)]
    fn add_gradient<N: Scalar<Stored = T>>(&mut self, to: usize, of: RowId, slope: N) {
        let of = of.index();
        let (levels, depends) = (&self.series.levels, &self.series.depends);
        let is_second = matches!(self.series.rows[to], Row::Second(_));
        if levels[of] != levels[to] && !is_second {
            return;
        }
        let mut at = 0;
        for (j, coordinate) in depends[of].iter().enumerate() {
            while depends[to][at] != *coordinate {
                at += 1;
            }
            let place = self.places[to] + at;
            let sum = slope.mul_add(
                N::load(self.gradients[self.places[of] + j]),
                N::load(self.gradients[place]),
            );
            self.gradients[place] = sum.store();
        }
    }

    /// Factors the mass matrix, bordered by the rows of constraints, which is the gradient of the residuals: L D Lᵀ. Of
    /// the pivots those of constraints are negative, as long as these do not depend on each other.
    #[inline(always)]
    fn factor<N: Scalar<Stored = T>>(&mut self) -> Result<(), Singular> {
        let n = self.series.unknowns();
        self.factors.fill(N::ZERO.store());
        for i in 0..n {
            let row = self.series.residuals[i].index();
            if self.series.levels[row] != Level::Acceleration {
                continue;
            }
            let place = self.places[row];
            for (j, column) in self.series.depends[row].iter().enumerate() {
                self.factors[i * n + *column as usize] = self.gradients[place + j];
            }
        }
        let tolerance = N::from_f64(n as f64 * f64::EPSILON);
        for i in 0..n {
            let diagonal = N::load(self.factors[i * n + i]);
            let is_constraint = i >= self.series.dimension();
            let (mut pivot, mut scale) = (diagonal, diagonal);
            for j in 0..i {
                // Holds L D until the row is done.
                let mut entry = N::load(self.factors[i * n + j]);
                for k in 0..j {
                    let other = N::load(self.factors[j * n + k]);
                    entry = N::load(self.factors[i * n + k]).neg_mul_add(other, entry);
                }
                self.factors[i * n + j] = entry.store();
            }
            for j in 0..i {
                let entry = N::load(self.factors[i * n + j]);
                let scaled = entry * N::load(self.factors[j * n + j]);
                pivot = entry.neg_mul_add(scaled, pivot);
                if is_constraint && j < self.series.dimension() {
                    scale = entry.mul_add(scaled, scale);
                }
                self.factors[i * n + j] = scaled.store();
            }
            let left = if is_constraint { -pivot } else { pivot };
            if !left.exceeds(scale * tolerance) {
                return Err(Singular {
                    coordinate: i,
                    ratio: (left / scale).to_f64(),
                });
            }
            self.factors[i * n + i] = (N::ONE / pivot).store();
        }
        Ok(())
    }

    /// Finds the accelerations of order `round`, and adds what they change.
    #[inline(always)]
    fn solve<N: Scalar<Stored = T>>(&mut self, round: usize) {
        let (n, width) = (self.series.unknowns(), self.width);
        for i in 0..n {
            let mut sum = -self.read::<N>(self.series.residuals[i], round);
            for j in 0..i {
                let known = N::load(self.right[j]);
                sum = N::load(self.factors[i * n + j]).neg_mul_add(known, sum);
            }
            self.right[i] = sum.store();
        }
        for i in (0..n).rev() {
            let mut sum = N::load(self.right[i]) * N::load(self.factors[i * n + i]);
            for j in i + 1..n {
                let known = N::load(self.right[j]);
                sum = N::load(self.factors[j * n + i]).neg_mul_add(known, sum);
            }
            self.right[i] = sum.store();
        }
        let share = self.over::<N>(round + 1) * self.over::<N>(round + 2);
        for at in 0..self.repaired[1].len() {
            let index = self.repaired[1][at] as usize;
            let change = self.change::<N>(index);
            let place = &mut self.coefficients[index * width + round];
            *place = (N::load(*place) + change).store();
        }
        let coordinates = self.series.dimension();
        for (k, multiplier) in self.right[coordinates..].iter().enumerate() {
            self.multipliers[k * self.order + round] = *multiplier;
        }
        for i in 0..coordinates {
            let q = N::load(self.right[i]) * share;
            self.motion[i * width + round + 2] = q.store();
        }
        for at in 0..self.repaired[0].len() {
            let index = self.repaired[0][at] as usize;
            let change = self.change::<N>(index);
            let place = &mut self.coefficients[index * width + round + 2];
            *place = share.mul_add(change, N::load(*place)).store();
        }
    }

    /// The gradient of a row times the newest accelerations.
    #[inline(always)]
    fn change<N: Scalar<Stored = T>>(&self, index: usize) -> N {
        let depends = &self.series.depends[index];
        let gradient = &self.gradients[self.places[index]..][..depends.len()];
        let pairs = depends.iter().zip(gradient);
        pairs.fold(N::ZERO, |sum, (i, g)| {
            N::load(*g).mul_add(N::load(self.right[*i as usize]), sum)
        })
    }
}

/// `Σ a_j b_{n−j}`, the newest coefficients last, in two sums that do not wait for each other.
#[inline(always)]
fn dot<T: Copy, N: Scalar<Stored = T>>(a: &[T], b: &[T]) -> N {
    let (mut even, mut odd) = (N::ZERO, N::ZERO);
    let mut pairs = a.iter().zip(b.iter().rev());
    while let Some((&a, &b)) = pairs.next() {
        even = N::load(a).mul_add(N::load(b), even);
        if let Some((&a, &b)) = pairs.next() {
            odd = N::load(a).mul_add(N::load(b), odd);
        }
    }
    even + odd
}
