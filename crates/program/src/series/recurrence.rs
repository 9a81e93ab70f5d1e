//! The recurrences for one coefficient of a row, over an abstract arithmetic.
//!
//! They are written once, over an [`Arithmetic`]: the interpreter computes with them, and an emitter writes the same operations as
//! code, in the same order.

use lagrangian_symbolic::{Function as Call, Rational};

use super::{Level, Row, RowId, Series};

/// A factor of a [`Convolution`]: the coefficients of a row, or each multiplied by its order, `j aⱼ`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Stream {
    /// The row.
    pub row: RowId,
    /// Whether its coefficients are multiplied by their orders.
    pub weighted: bool,
}

/// The sum of products over the orders strictly between 0 and the one that is computed, `Σ aⱼ b₍m−j₎`.
///
/// The terms of the orders 0 and m are not included: each recurrence adds them in its own way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Convolution {
    /// The factors; if they are added up [by force](TermOrder::Force), the one that depends on accelerations comes first.
    pub factors: [Stream; 2],
    /// The order in which the terms are added.
    pub along: TermOrder,
}

/// The order in which the terms of a sum over orders are added: the latest known comes last.
///
/// Each is a sum from the middle outwards ([`convolve_all`](lagrangian_scalar::series::convolve_all)), followed by the
/// terms listed after it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TermOrder {
    /// For positions: `2 ≤ j ≤ m − 2`, then `j = m − 1`, then `j = 1`.
    Position,
    /// For a force and a position: `0 ≤ j ≤ m − 2`, then `j = m − 1`, including the term of order 0.
    Force,
    /// For everything else: `1 ≤ j ≤ m − 1`.
    Other,
}

/// The operations of recurrences. `m` is the order of the coefficient that is computed.
pub trait Arithmetic {
    /// A number.
    type X: Copy;

    /// 0.
    fn zero(&mut self) -> Self::X;
    /// 1.
    fn one(&mut self) -> Self::X;
    /// A rational number.
    fn rational(&mut self, value: &Rational) -> Self::X;
    /// π.
    fn pi(&mut self) -> Self::X;
    /// A parameter.
    fn parameter(&mut self, index: u32) -> Self::X;
    /// An input.
    fn input(&mut self, index: u32) -> Self::X;
    /// The time at the start.
    fn time(&mut self) -> Self::X;
    /// Coefficient `m` of a coordinate, or of its rate.
    fn motion(&mut self, coordinate: u32, is_rate: bool) -> Self::X;
    /// Coefficient 0 of a row.
    fn first(&mut self, row: RowId) -> Self::X;
    /// Coefficient `m` of a row at the same level, which was just computed.
    fn newest(&mut self, row: RowId) -> Self::X;
    /// Coefficient `m − 1` of a row.
    fn before(&mut self, row: RowId) -> Self::X;
    /// `m` times coefficient `m` of a row at the same level, which was just computed.
    fn weighted(&mut self, row: RowId) -> Self::X;
    /// Coefficient `m + 1` of a row of positions, or of rates, times `m + 1`.
    fn derivative(&mut self, row: RowId) -> Self::X;
    /// The [derivative](Self::derivative) of a row of rates as two factors: `m + 1`, and the coefficient, which was just computed.
    fn derivative_factors(&mut self, row: RowId) -> [Self::X; 2];
    /// Coefficient `m + 2` of a row of positions, which was just computed, times `(m + 1)(m + 2)`.
    fn second_derivative(&mut self, row: RowId) -> Self::X;
    /// The second derivative as two factors: one that depends on the order alone, and one that was just computed.
    fn second_factors(&mut self, row: RowId) -> [Self::X; 2];
    /// One of the sums of this row.
    fn convolution(&mut self, row: RowId, number: usize) -> Self::X;
    /// Sine and cosine of a row at order 0, corrected by the row's rounding error.
    fn sin_cos(&mut self, row: RowId) -> [Self::X; 2];
    /// A function of numbers, at order 0.
    fn call(&mut self, call: Call, a: Self::X, b: Self::X) -> Self::X;
    /// A sum at order 0 whose rounding error is tracked.
    fn exact_sum(&mut self, row: RowId, terms: &[(Option<RowId>, RowId)]) -> Self::X;
    /// 1/m.
    fn over_order(&mut self) -> Self::X;

    /// `a + b`.
    fn add(&mut self, a: Self::X, b: Self::X) -> Self::X;
    /// `a − b`.
    fn subtract(&mut self, a: Self::X, b: Self::X) -> Self::X;
    /// `a b`.
    fn multiply(&mut self, a: Self::X, b: Self::X) -> Self::X;
    /// `a/b`.
    fn divide(&mut self, a: Self::X, b: Self::X) -> Self::X;
    /// `−a`.
    fn negate(&mut self, a: Self::X) -> Self::X;
    /// `a b + c`, rounded once if the type of number supports it.
    fn multiply_add(&mut self, a: Self::X, b: Self::X, c: Self::X) -> Self::X;
}

/// A coefficient of a row, and the same multiplied by its order if that is computed first at no extra cost.
pub struct Coefficient<X> {
    /// Coefficient `m`.
    pub plain: X,
    /// `m` times it.
    pub weighted: Option<X>,
}

/// 1/m of a sum or of its negative, together with that itself, its multiple by m.
#[inline(always)]
fn over_order<A: Arithmetic>(sum: A::X, is_negative: bool, to: &mut A) -> Coefficient<A::X> {
    let sum = if is_negative { to.negate(sum) } else { sum };
    let over = to.over_order();
    Coefficient {
        plain: to.multiply(over, sum),
        weighted: Some(sum),
    }
}

impl Series {
    /// The sums that a coefficient of a row needs.
    pub fn convolutions(&self, row: RowId) -> Vec<Convolution> {
        let plain = |row: RowId| Stream {
            row,
            weighted: false,
        };
        let weighted = |row: RowId| Stream {
            row,
            weighted: true,
        };
        let pairs = match self.rows[row.index()] {
            _ if self.level(row) == Level::Constant => Vec::new(),
            Row::Product(a, b) if self.varies(a) && self.varies(b) => vec![[plain(a), plain(b)]],
            Row::Square(a) | Row::TanhSlope(a) => vec![[plain(a), plain(a)]],
            Row::Quotient(_, b) if self.varies(b) => vec![[plain(b), plain(row)]],
            Row::Sqrt(_) => vec![[plain(row), plain(row)]],
            Row::Sin(a, other) | Row::Cos(a, other) if self.phase(a).is_none() => {
                vec![[weighted(a), plain(other)]]
            }
            Row::Sinh(a, other) | Row::Cosh(a, other) | Row::Tanh(a, other) => {
                vec![[weighted(a), plain(other)]]
            }
            Row::Exp(a) => vec![[weighted(a), plain(row)]],
            Row::Power(a, _) => vec![[weighted(a), plain(row)], [weighted(row), plain(a)]],
            Row::Primitive(_, _, slope) => vec![[weighted(row), plain(slope)]],
            Row::Atan2(y, x, slope) => vec![
                [weighted(y), plain(x)],
                [weighted(x), plain(y)],
                [weighted(row), plain(slope)],
            ],
            _ => Vec::new(),
        };
        let level = self.level(row);
        let sum = |factors: [Stream; 2]| {
            let levels = factors.map(|stream| self.level(stream.row));
            match (level, &self.rows[row.index()], levels) {
                (Level::Position, ..) => Convolution {
                    factors,
                    along: TermOrder::Position,
                },
                (_, Row::Product(..), [Level::Acceleration, Level::Position]) => Convolution {
                    factors,
                    along: TermOrder::Force,
                },
                (_, Row::Product(..), [Level::Position, Level::Acceleration]) => Convolution {
                    factors: [factors[1], factors[0]],
                    along: TermOrder::Force,
                },
                _ => Convolution {
                    factors,
                    along: TermOrder::Other,
                },
            }
        };
        pairs.into_iter().map(sum).collect()
    }

    /// The level of a row.
    pub fn level(&self, row: RowId) -> Level {
        self.levels[row.index()]
    }

    /// Whether a row depends on more than parameters.
    pub fn varies(&self, row: RowId) -> bool {
        self.level(row) > Level::Constant
    }

    /// The constant rate of a row that grows with time alone: `ω` for `ω t`, the inner `None` standing for 1, the rate of the time itself.
    pub fn phase(&self, row: RowId) -> Option<Option<RowId>> {
        match &self.rows[row.index()] {
            Row::Time => Some(None),
            Row::Sum(terms) => {
                let mut rate = None;
                for (coefficient, term) in terms {
                    match self.rows[term.index()] {
                        Row::Time if rate.is_none() => rate = Some(*coefficient),
                        _ if !self.varies(*term) => {}
                        _ => return None,
                    }
                }
                rate
            }
            _ => None,
        }
    }

    /// Coefficient 0 of a row.
    #[inline(always)]
    pub fn value<A: Arithmetic>(&self, row: RowId, to: &mut A) -> A::X {
        match self.rows[row.index()] {
            Row::Number(ref number) => to.rational(number),
            Row::Pi => to.pi(),
            Row::Parameter(i) => to.parameter(i),
            Row::Input(i) => to.input(i),
            Row::Time => to.time(),
            Row::Coordinate(i) => to.motion(i, false),
            Row::Rate(i) => to.motion(i, true),
            Row::Acceleration(_) => to.zero(),
            Row::First(p) => to.derivative(p),
            Row::Second(p) => to.second_derivative(p),
            Row::Sum(ref terms) => {
                if self.has_phase(row) {
                    to.exact_sum(row, terms)
                } else {
                    self.sum_of(terms, to, A::first)
                }
            }
            Row::Product(a, b) => {
                let [a, b] = [a, b].map(|row| to.first(row));
                to.multiply(a, b)
            }
            Row::Square(a) => {
                let a = to.first(a);
                to.multiply(a, a)
            }
            Row::Quotient(a, b) => {
                let [a, b] = [a, b].map(|row| to.first(row));
                to.divide(a, b)
            }
            Row::Sin(a, _) => to.sin_cos(a)[0],
            Row::Cos(a, _) => to.sin_cos(a)[1],
            Row::Sqrt(a) => self.call(Call::Sqrt, a, a, to),
            Row::Sinh(a, _) => self.call(Call::Sinh, a, a, to),
            Row::Cosh(a, _) => self.call(Call::Cosh, a, a, to),
            Row::Tanh(a, _) => self.call(Call::Tanh, a, a, to),
            Row::Exp(a) => self.call(Call::Exp, a, a, to),
            Row::Power(a, r) => self.call(Call::Pow, a, r, to),
            Row::Primitive(call, a, _) => self.call(call, a, a, to),
            Row::Atan2(y, x, _) => self.call(Call::Atan2, y, x, to),
            Row::Constant(call, a, b) => self.call(call, a, b, to),
            Row::TanhSlope(a) => {
                let [one, a] = [to.one(), to.first(a)];
                let square = to.multiply(a, a);
                to.subtract(one, square)
            }
        }
    }

    #[inline(always)]
    fn call<A: Arithmetic>(&self, call: Call, a: RowId, b: RowId, to: &mut A) -> A::X {
        let [a, b] = [a, b].map(|row| to.first(row));
        to.call(call, a, b)
    }

    /// Whether a change of one row at its own level changes another: positions and rates also change their derivatives;
    /// rows of other levels stay.
    pub fn propagates(&self, to: RowId, of: RowId) -> bool {
        let is_derivative = matches!(self.rows[to.index()], Row::First(_) | Row::Second(_));
        self.level(of) == self.level(to) || is_derivative
    }

    /// Whether a row is a sum that grows with time, so that its rounding error is worth tracking.
    pub fn has_phase(&self, row: RowId) -> bool {
        self.exact[row.index()]
    }

    /// `Σ c x`.
    #[inline(always)]
    fn sum_of<A: Arithmetic>(
        &self,
        terms: &[(Option<RowId>, RowId)],
        to: &mut A,
        x: impl Fn(&mut A, RowId) -> A::X,
    ) -> A::X {
        let mut sum = to.zero();
        for (coefficient, row) in terms {
            let x = x(to, *row);
            sum = match coefficient {
                None => to.add(sum, x),
                Some(c) => {
                    let c = to.first(*c);
                    to.multiply_add(c, x, sum)
                }
            };
        }
        sum
    }

    /// `Σ c x` of coefficients that were just computed. Factors that depend on the order alone are multiplied first, so that
    /// nothing waits for them.
    #[inline(always)]
    fn sum_of_newest<A: Arithmetic>(&self, terms: &[(Option<RowId>, RowId)], to: &mut A) -> A::X {
        let mut sum = to.zero();
        for (coefficient, row) in terms {
            let (order, x) = match self.rows[row.index()] {
                Row::Second(p) => {
                    let [order, x] = to.second_factors(p);
                    (Some(order), x)
                }
                Row::First(p) if self.level(*row) == Level::Acceleration => {
                    let [order, x] = to.derivative_factors(p);
                    (Some(order), x)
                }
                _ => (None, to.newest(*row)),
            };
            let coefficient = coefficient.map(|c| to.first(c));
            let coefficient = match (coefficient, order) {
                (Some(c), Some(order)) => Some(to.multiply(c, order)),
                (c, order) => c.or(order),
            };
            sum = match coefficient {
                None => to.add(sum, x),
                Some(c) => to.multiply_add(c, x, sum),
            };
        }
        sum
    }

    /// Whether a coefficient of a row is computed multiplied by its order first.
    pub fn is_integral(&self, row: RowId) -> bool {
        matches!(
            self.rows[row.index()],
            Row::Sin(..)
                | Row::Cos(..)
                | Row::Sinh(..)
                | Row::Cosh(..)
                | Row::Tanh(..)
                | Row::Exp(_)
        )
    }

    /// Coefficient `m ≥ 1` of a row that varies, given its earlier ones and those of its operands.
    #[inline(always)]
    pub fn coefficient<A: Arithmetic>(
        &self,
        row: RowId,
        m: Order,
        to: &mut A,
    ) -> Coefficient<A::X> {
        let plain = |plain: A::X| Coefficient {
            plain,
            weighted: None,
        };
        match self.rows[row.index()] {
            Row::Number(_)
            | Row::Pi
            | Row::Parameter(_)
            | Row::Constant(..)
            | Row::Input(_)
            | Row::Acceleration(_) => plain(to.zero()),
            Row::Time => plain(match m {
                Order::First => to.one(),
                _ => to.zero(),
            }),
            Row::Coordinate(i) => plain(to.motion(i, false)),
            Row::Rate(i) => plain(to.motion(i, true)),
            Row::First(p) => plain(to.derivative(p)),
            Row::Second(p) => plain(to.second_derivative(p)),
            Row::Sum(ref terms) => plain(self.sum_of_newest(terms, to)),
            Row::Product(a, b) => plain(self.product(row, [a, b], to)),
            Row::Square(a) => plain(self.square(row, a, to)),
            Row::TanhSlope(a) => {
                let square = self.square(row, a, to);
                plain(to.negate(square))
            }
            Row::Quotient(a, b) => plain(self.quotient(row, [a, b], to)),
            Row::Sqrt(a) => plain(self.root(row, a, to)),
            Row::Sin(a, cosine) => self.circular(row, a, (cosine, false), to),
            Row::Cos(a, sine) => self.circular(row, a, (sine, true), to),
            Row::Sinh(a, slope) | Row::Cosh(a, slope) | Row::Tanh(a, slope) => {
                self.integral(row, a, (slope, false), to)
            }
            Row::Exp(a) => self.integral(row, a, (row, false), to),
            Row::Power(a, r) => plain(self.power(row, [a, r], to)),
            Row::Primitive(_, a, slope) => plain(self.primitive(row, a, slope, to)),
            Row::Atan2(y, x, slope) => plain(self.angle(row, [y, x], slope, to)),
        }
    }

    /// Whether a row is a product of a row that depends on accelerations and a position.
    pub fn is_force(&self, row: RowId) -> bool {
        match self.rows[row.index()] {
            Row::Product(a, b) if self.level(row) == Level::Acceleration => {
                let mut levels = [self.level(a), self.level(b)];
                levels.sort_unstable();
                levels == [Level::Position, Level::Acceleration]
            }
            _ => false,
        }
    }

    /// `p = a b`: `pₘ = aₘ b₀ + a₀ bₘ + Σ aⱼ bₘ₋ⱼ`.
    #[inline(always)]
    fn product<A: Arithmetic>(&self, row: RowId, [a, b]: [RowId; 2], to: &mut A) -> A::X {
        match [self.varies(a), self.varies(b)] {
            [true, true] if self.is_force(row) && self.level(a) < self.level(b) => {
                self.convolved(row, [b, a], to)
            }
            [true, true] => self.convolved(row, [a, b], to),
            [false, _] => {
                let (a, b) = (to.first(a), to.newest(b));
                to.multiply(a, b)
            }
            [_, false] => {
                let (a, b) = (to.newest(a), to.first(b));
                to.multiply(a, b)
            }
        }
    }

    /// The sum over all orders of a product of two rows that vary. The sum of a [force](TermOrder::Force) includes the term of order 0.
    #[inline(always)]
    fn convolved<A: Arithmetic>(&self, row: RowId, [a, b]: [RowId; 2], to: &mut A) -> A::X {
        let sum = to.convolution(row, 0);
        let (b_0, a_m) = (to.first(b), to.newest(a));
        if self.is_force(row) {
            to.multiply_add(a_m, b_0, sum)
        } else {
            let (a_0, b_m) = (to.first(a), to.newest(b));
            let sum = to.multiply_add(a_m, b_0, sum);
            to.multiply_add(a_0, b_m, sum)
        }
    }

    /// `p = a²`: `pₘ = aₘ a₀ + a₀ aₘ + Σ aⱼ aₘ₋ⱼ`.
    #[inline(always)]
    fn square<A: Arithmetic>(&self, row: RowId, a: RowId, to: &mut A) -> A::X {
        let sum = to.convolution(row, 0);
        let (a_0, a_m) = (to.first(a), to.newest(a));
        let sum = to.multiply_add(a_m, a_0, sum);
        to.multiply_add(a_0, a_m, sum)
    }

    /// `p = a/b`, so `b p = a`: `pₘ = (aₘ − Σ bⱼ pₘ₋ⱼ − bₘ p₀)/b₀`.
    #[inline(always)]
    fn quotient<A: Arithmetic>(&self, row: RowId, [a, b]: [RowId; 2], to: &mut A) -> A::X {
        if !self.varies(b) {
            let (a, b) = (to.newest(a), to.first(b));
            return to.divide(a, b);
        }
        let sum = to.convolution(row, 0);
        let a = to.newest(a);
        let left = to.subtract(a, sum);
        let (b_m, p_0, b_0) = (to.newest(b), to.first(row), to.first(b));
        let known = to.multiply(b_m, p_0);
        let left = to.subtract(left, known);
        to.divide(left, b_0)
    }

    /// `p = √a`, so `p² = a`: `pₘ = (aₘ − Σ pⱼ pₘ₋ⱼ)/(2 p₀)`.
    #[inline(always)]
    fn root<A: Arithmetic>(&self, row: RowId, a: RowId, to: &mut A) -> A::X {
        let sum = to.convolution(row, 0);
        let (a, root) = (to.newest(a), to.first(row));
        let (left, twice) = (to.subtract(a, sum), to.add(root, root));
        to.divide(left, twice)
    }

    /// `p = ∫ s da`, with the slope `s = dp/da` or its negative: `m pₘ = Σ j aⱼ sₘ₋ⱼ`, whose last term is `m aₘ s₀`.
    #[inline(always)]
    fn integral<A: Arithmetic>(
        &self,
        row: RowId,
        a: RowId,
        (slope, is_negative): (RowId, bool),
        to: &mut A,
    ) -> Coefficient<A::X> {
        let sum = to.convolution(row, 0);
        let (a_m, s_0) = (to.weighted(a), to.first(slope));
        let sum = to.multiply_add(a_m, s_0, sum);
        over_order(sum, is_negative, to)
    }

    /// Sine or cosine, of which the other one is the slope or its negative; of `a = ω t + φ` it is `m pₘ = ω sₘ₋₁`.
    #[inline(always)]
    fn circular<A: Arithmetic>(
        &self,
        row: RowId,
        a: RowId,
        (slope, is_negative): (RowId, bool),
        to: &mut A,
    ) -> Coefficient<A::X> {
        let Some(rate) = self.phase(a) else {
            return self.integral(row, a, (slope, is_negative), to);
        };
        let before = to.before(slope);
        let sum = match rate {
            None => before,
            Some(rate) => {
                let rate = to.first(rate);
                to.multiply(rate, before)
            }
        };
        over_order(sum, is_negative, to)
    }

    /// `p = aʳ`, so `a dp = r p da`: `m a₀ pₘ = r Σ j aⱼ pₘ₋ⱼ − Σ j pⱼ aₘ₋ⱼ`.
    #[inline(always)]
    fn power<A: Arithmetic>(&self, row: RowId, [a, r]: [RowId; 2], to: &mut A) -> A::X {
        let sums = [to.convolution(row, 0), to.convolution(row, 1)];
        let (a_m, p_0, r) = (to.weighted(a), to.first(row), to.first(r));
        let rising = to.multiply_add(a_m, p_0, sums[0]);
        let rising = to.multiply(r, rising);
        let left = to.subtract(rising, sums[1]);
        let (over, a_0) = (to.over_order(), to.first(a));
        let left = to.multiply(over, left);
        to.divide(left, a_0)
    }

    /// `p` of `s dp = da` with `s` given: `s₀ pₘ = aₘ − Σ j pⱼ sₘ₋ⱼ/m`.
    #[inline(always)]
    fn primitive<A: Arithmetic>(&self, row: RowId, a: RowId, slope: RowId, to: &mut A) -> A::X {
        let known = to.convolution(row, 0);
        let (over, a, slope) = (to.over_order(), to.newest(a), to.first(slope));
        let known = to.multiply(over, known);
        let left = to.subtract(a, known);
        to.divide(left, slope)
    }

    /// `p = atan2(y, x)`, so `s dp = x dy − y dx` with `s = x² + y²`: `m s₀ pₘ = Σ j yⱼ xₘ₋ⱼ − Σ j xⱼ yₘ₋ⱼ − Σ j pⱼ sₘ₋ⱼ`.
    #[inline(always)]
    fn angle<A: Arithmetic>(
        &self,
        row: RowId,
        [y, x]: [RowId; 2],
        slope: RowId,
        to: &mut A,
    ) -> A::X {
        let sums = [0, 1, 2].map(|number| to.convolution(row, number));
        let [y_m, x_m] = [y, x].map(|row| to.weighted(row));
        let [y_0, x_0, slope] = [y, x, slope].map(|row| to.first(row));
        let rising = to.multiply_add(y_m, x_0, sums[0]);
        let falling = to.multiply_add(x_m, y_0, sums[1]);
        let area = to.subtract(rising, falling);
        let left = to.subtract(area, sums[2]);
        let over = to.over_order();
        let left = to.multiply(over, left);
        to.divide(left, slope)
    }

    /// The operands of a row at its own level, with its derivatives by these at the start. Sums are excluded: their
    /// coefficients are the derivatives.
    #[inline(always)]
    pub fn slopes<A: Arithmetic>(&self, row: RowId, to: &mut A) -> [Option<(RowId, A::X)>; 2] {
        match self.rows[row.index()] {
            Row::First(p) | Row::Second(p) => [Some((p, to.one())), None],
            Row::Product(a, b) => {
                let [x_a, x_b] = [a, b].map(|row| to.first(row));
                [Some((a, x_b)), Some((b, x_a))]
            }
            Row::Square(a) => {
                let x = to.first(a);
                [Some((a, to.add(x, x))), None]
            }
            Row::Quotient(a, b) => {
                let (one, x_b, x) = (to.one(), to.first(b), to.first(row));
                let slope = to.divide(one, x_b);
                let other = to.multiply(x, slope);
                [Some((a, slope)), Some((b, to.negate(other)))]
            }
            Row::Sqrt(a) => {
                let (one, x) = (to.one(), to.first(row));
                let twice = to.add(x, x);
                [Some((a, to.divide(one, twice))), None]
            }
            Row::Sin(a, other)
            | Row::Sinh(a, other)
            | Row::Cosh(a, other)
            | Row::Tanh(a, other) => [Some((a, to.first(other))), None],
            Row::Cos(a, sin) => {
                let sin = to.first(sin);
                [Some((a, to.negate(sin))), None]
            }
            Row::TanhSlope(a) => {
                let x = to.first(a);
                let twice = to.add(x, x);
                [Some((a, to.negate(twice))), None]
            }
            Row::Exp(a) => [Some((a, to.first(row))), None],
            Row::Power(a, r) => {
                let (r, x, x_a) = (to.first(r), to.first(row), to.first(a));
                let product = to.multiply(r, x);
                [Some((a, to.divide(product, x_a))), None]
            }
            Row::Primitive(_, a, slope) => {
                let (one, slope) = (to.one(), to.first(slope));
                [Some((a, to.divide(one, slope))), None]
            }
            Row::Atan2(y, x, slope) => {
                let [y_0, x_0, slope] = [y, x, slope].map(|row| to.first(row));
                let rising = to.divide(x_0, slope);
                let falling = to.divide(y_0, slope);
                [Some((y, rising)), Some((x, to.negate(falling)))]
            }
            _ => [None, None],
        }
    }
}

/// The order of a coefficient, as far as it matters to a recurrence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// 1.
    First,
    /// 2 or more.
    Later,
}
