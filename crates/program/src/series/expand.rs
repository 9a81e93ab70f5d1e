//! Computes the coefficients of a series at a state, over any type of number.
//!
//! Round k computes the accelerations of order k. Rows of positions are advanced to order k + 2 as if the coefficient of
//! `q` were 0 there; rates and forces to order k. The residuals then lack only the accelerations of order k, whose matrix
//! is the mass matrix at the start. These are solved for, and their effect is added to the rows that later rounds read: for
//! rows of positions their gradient by `q` times `q₍k₊₂₎`, for forces their gradient by `a` times `aₖ`. The gradients are
//! those at the start, since the factor of the newest coefficient is of order 0. Where a row of rates is differentiated, rates are
//! computed to order k + 1, as if the coefficient of `v` were 0 there, and their gradient by `v` times `v₍k₊₁₎` is added afterwards.

mod order;
mod plan;

use std::marker::PhantomData;
use std::sync::Arc;

use lagrangian_scalar::{Scalar, series as steps};

use super::{
    Arithmetic, Coefficient, Composition, Level, MOST_IN_ONE_SUM, Order, Row, RowId, Series, Source,
};
use crate::Singular;
use order::{OrderArithmetic, convolve};
use plan::{Plan, Sum};

/// A series ready to be expanded over numbers that are stored as `T`. Nothing is allocated after [`Expander::new`].
#[derive(Clone, Debug)]
pub struct Expander<T> {
    series: Arc<Series>,
    parameters: Vec<T>,
    /// The number of coefficients of the accelerations.
    order: usize,
    /// The number of coefficients of a row: `order + 2`.
    width: usize,
    /// The rows that vary, by level.
    by_level: [Vec<u32>; 3],
    /// The forces of which later coefficients are needed, or their [sums over orders](Source::Sum).
    later_forces: Vec<u32>,
    /// For each row whether its later coefficients are needed, and whether its sums over orders are.
    later: Vec<[bool; 2]>,
    /// The newest of these sums.
    kept_sums: Vec<T>,
    /// Whether the effect of accelerations on a force is [added to the rest](Series::adds_to_forces) term by term.
    adds_to_forces: bool,
    /// How the unknowns of each block are computed without residuals.
    compositions: Arc<[Option<Composition>]>,
    /// Workspace for the coefficients of sources.
    derivatives: Vec<T>,
    /// Rows of positions, of rates and of forces that the newest accelerations change.
    changed_by_newest: [Vec<u32>; 3],
    /// Rows whose coefficients are needed multiplied by their orders.
    scaled: Vec<bool>,
    /// Where these multiples begin for each row, if sums need them.
    weighted_places: Vec<Option<usize>>,
    /// For each row its sums over orders, at most three.
    sums: Vec<Vec<Sum>>,
    /// The sums of the row that is computed.
    sums_of_row: [T; 3],
    coefficients: Vec<T>,
    /// `j cⱼ` for some rows.
    weighted: Vec<T>,
    /// The newest coefficient of a row, times its order.
    newest: Vec<T>,
    /// The rounding error of the coefficient of order 0.
    low: Vec<T>,
    /// Where the gradient of each row begins.
    places: Vec<usize>,
    gradients: Vec<T>,
    /// Coefficients of the coordinates, one coordinate after another.
    motion: Vec<T>,
    /// Coefficients of their rates, in the same places.
    rates: Vec<T>,
    inputs: Vec<T>,
    /// Coefficients of the multipliers, one constraint after another.
    multipliers: Vec<T>,
    /// Groups of coupled unknowns, with the factors of their matrices.
    blocks: Vec<Block<T>>,
    /// The latest solution.
    unknowns: Vec<T>,
    /// Workspace for the unknowns of one block, twice.
    scratch: [Vec<T>; 2],
    /// 0, 1, 2 … and their reciprocals; the first reciprocal is not read.
    numbers: Vec<[T; 2]>,
}

#[derive(Clone, Debug)]
struct Block<T> {
    /// The unknowns.
    members: Vec<u32>,
    /// For each unknown its index among the members.
    place: Vec<u32>,
    matrix: Vec<T>,
    /// For each unknown the coefficients of the sources, if it is [composed](Composition) of them.
    sources: Vec<T>,
}

impl<T: Scalar<Stored = T>> Expander<T> {
    /// A series with parameters, to be expanded to `order` coefficients of the accelerations.
    ///
    /// # Panics
    /// If the number of parameters differs from that of the series.
    pub fn new(series: Arc<Series>, parameters: &[T], order: usize) -> Expander<T> {
        assert_eq!(parameters.len(), series.parameters, "one number for each");
        let (rows, n, width) = (series.rows.len(), series.dimension(), order + 2);
        let unknowns = series.unknowns();
        let plan = Plan::of(&series, width);
        let mut blocks = Vec::with_capacity(plan.blocks.len());
        let mut derivatives = 0;
        for ([members, place], composition) in plan.blocks.into_iter().zip(&plan.compositions) {
            let sources = composition.as_ref().map_or(0, |of| of.sources.len());
            derivatives = derivatives.max(composition.as_ref().map_or(0, |of| of.derivatives));
            blocks.push(Block {
                matrix: vec![T::ZERO; members.len() * members.len()],
                sources: vec![T::ZERO; members.len() * sources],
                place,
                members,
            });
        }
        let mut numbers = Vec::with_capacity(width + 1);
        for j in 0..=width as i64 {
            numbers.push([T::from_ratio(j, 1), T::from_ratio(1, j.max(1))]);
        }
        let is_later = |row: &u32| plan.later[*row as usize] != [false; 2];
        let mut expander = Expander {
            later_forces: plan.by_level[2].iter().copied().filter(is_later).collect(),
            by_level: plan.by_level,
            kept_sums: vec![T::ZERO; rows],
            adds_to_forces: series.adds_to_forces(),
            later: plan.later,
            compositions: plan.compositions.into(),
            derivatives: vec![T::ZERO; derivatives],
            changed_by_newest: plan.changed_by_newest,
            scaled: plan.scaled,
            sums: plan.sums,
            sums_of_row: [T::ZERO; 3],
            parameters: parameters.to_vec(),
            order,
            width,
            coefficients: vec![T::ZERO; rows * width],
            weighted: vec![T::ZERO; plan.weighted],
            weighted_places: plan.weighted_places,
            newest: vec![T::ZERO; rows],
            low: vec![T::ZERO; rows],
            places: plan.places,
            gradients: vec![T::ZERO; plan.gradients],
            motion: vec![T::ZERO; n * width],
            rates: vec![T::ZERO; n * width],
            inputs: vec![T::ZERO; series.inputs],
            multipliers: vec![T::ZERO; (unknowns - n) * order],
            blocks,
            unknowns: vec![T::ZERO; unknowns],
            scratch: [vec![T::ZERO; unknowns], vec![T::ZERO; unknowns]],
            numbers,
            series,
        };
        expander.prepare();
        expander
    }

    /// [`expand_in`](Self::expand_in) its own numbers; compiled once, however often it is called.
    #[inline(never)]
    pub fn expand(&mut self, t: [T; 2], q: &[T], v: &[T], u: &[T]) -> Result<(), Singular> {
        self.expand_in::<T>(t, q, v, u)
    }

    /// Computes the rows that depend on parameters alone.
    fn prepare(&mut self) {
        let series = self.series.clone();
        for index in 0..series.rows.len() {
            if series.levels[index] == Level::Constant {
                let row = RowId(index as u32);
                let value = series.value(row, &mut self.at::<T>(0, 0, T::ZERO));
                self.coefficients[index * self.width] = value;
            }
        }
    }
}

impl<T: Copy> Expander<T> {
    /// This expander without [compositions](Composition): it solves for the unknowns of every order from residuals. It serves intervals: terms that
    /// cancel in a residual do so before it is multiplied by the inverse, which is a matrix of intervals as well.
    #[must_use]
    pub fn with_residuals(mut self) -> Self {
        self.compositions = vec![None; self.compositions.len()].into();
        self.later_forces = self.by_level[2].clone();
        for row in &self.later_forces {
            self.later[*row as usize] = [true, false];
        }
        self
    }

    /// The number of coefficients of the accelerations.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The value of a row: one that depends on parameters alone has it before the first expansion.
    pub fn value(&self, row: RowId) -> T {
        self.coefficients[row.index() * self.width]
    }

    /// The `order + 2` coefficients of a coordinate.
    pub fn coordinate(&self, coordinate: usize) -> &[T] {
        &self.motion[coordinate * self.width..][..self.width]
    }

    /// The `order` coefficients of the multiplier of a constraint.
    pub fn multiplier(&self, constraint: usize) -> &[T] {
        &self.multipliers[constraint * self.order..][..self.order]
    }

    #[inline(always)]
    fn at<N: Scalar<Stored = T>>(
        &mut self,
        level: usize,
        m: usize,
        t: N,
    ) -> OrderArithmetic<'_, T, N> {
        OrderArithmetic {
            expander: self,
            level,
            m,
            t,
            numbers: PhantomData,
        }
    }

    /// Expands the motion through a state in the arithmetic of numbers `N`. The time is the sum of the
    /// two given numbers.
    ///
    /// An error if the mass matrix cannot be inverted.
    #[inline(always)]
    pub fn expand_in<N: Scalar<Stored = T>>(
        &mut self,
        t: [T; 2],
        q: &[T],
        v: &[T],
        u: &[T],
    ) -> Result<(), Singular> {
        let series = self.series.clone();
        let (n, width) = (series.dimension(), self.width);
        let lead_of_rates = usize::from(series.rates_are_ahead);
        self.inputs.copy_from_slice(u);
        self.motion.fill(N::ZERO.store());
        self.rates.fill(N::ZERO.store());
        for i in 0..n {
            self.motion[i * width] = q[i];
            self.motion[i * width + 1] = v[i];
            self.rates[i * width] = v[i];
        }
        // All that a round does is in one place: the recurrences are copied in where they are called, once for each kind of processor.
        for round in 0..=self.order {
            // Positions are two orders ahead of forces, and begin with two orders.
            let ahead = if round == 0 {
                0..2
            } else {
                round + 1..round + 2
            };
            let positions = ahead.map(|m| (0, m));
            let order_of_rates = (round + lead_of_rates).checked_sub(1);
            let rates = order_of_rates.into_iter().map(|m| (1, m));
            let forces = round.checked_sub(1).into_iter().map(|m| (2, m));
            for (level, m) in positions.chain(rates).chain(forces) {
                self.advance::<N>(&series, level, m, t);
            }
            if let Some(order) = round.checked_sub(1) {
                if order == 0 {
                    self.differentiate::<N>(&series);
                    self.factor::<N>(&series)?;
                    self.compose::<N>();
                }
                self.solve::<N>(&series, order);
                self.store_weighted::<N>(1, order + lead_of_rates);
                self.store_weighted::<N>(2, order);
            }
            self.store_weighted::<N>(0, round + 1);
        }
        Ok(())
    }

    /// Computes the coefficients of one order for all rows of a level. The time is the sum of the two given numbers.
    #[inline(always)]
    fn advance<N: Scalar<Stored = T>>(
        &mut self,
        series: &Series,
        level: usize,
        m: usize,
        t: [T; 2],
    ) {
        let order = if m == 1 { Order::First } else { Order::Later };
        let is_later = level == 2 && m > 0;
        let count = if is_later {
            self.later_forces.len()
        } else {
            self.by_level[level].len()
        };
        for at in 0..count {
            let row = RowId(if is_later {
                self.later_forces[at]
            } else {
                self.by_level[level][at]
            });
            let Coefficient { plain, weighted } = if m == 0 {
                if let Row::Time = series.rows[row.index()] {
                    self.low[row.index()] = t[1];
                }
                Coefficient {
                    plain: series.value(row, &mut self.at::<N>(level, 0, N::load(t[0]))),
                    weighted: Some(N::ZERO),
                }
            } else {
                self.sum_over_orders::<N>(row, m);
                if is_later {
                    let [is_needed, is_source] = self.later[row.index()];
                    if is_source {
                        self.kept_sums[row.index()] = self.sums_of_row[0];
                    }
                    if !is_needed {
                        continue;
                    }
                }
                series.coefficient(row, order, &mut self.at::<N>(level, m, N::ZERO))
            };
            self.coefficients[row.index() * self.width + m] = plain.store();
            if self.scaled[row.index()] {
                let weighted = weighted.unwrap_or_else(|| self.number::<N>(m) * plain);
                self.newest[row.index()] = weighted.store();
            }
        }
    }

    /// Computes the sums over orders of a row, all of them here, since recurrences of most operations have one.
    #[inline(always)]
    fn sum_over_orders<N: Scalar<Stored = T>>(&mut self, row: RowId, m: usize) {
        for (sum, place) in self.sums[row.index()].iter().zip(&mut self.sums_of_row) {
            let [a, b] = sum.factors.map(|(place, weighted)| {
                if weighted {
                    &self.weighted[place..place + self.width]
                } else {
                    &self.coefficients[place..place + self.width]
                }
            });
            *place = convolve::<T, N>(a, b, m, sum.along).store();
        }
    }

    /// Multiplies final coefficients of one order by the order.
    #[inline(always)]
    fn store_weighted<N: Scalar<Stored = T>>(&mut self, level: usize, m: usize) {
        for at in 0..self.by_level[level].len() {
            let index = self.by_level[level][at] as usize;
            let Some(place) = self.weighted_places[index] else {
                continue;
            };
            self.weighted[place + m] = match self.series.rows[index] {
                Row::Coordinate(i) if m > 0 => self.rates[i as usize * self.width + m - 1],
                _ => {
                    let x = N::load(self.coefficients[index * self.width + m]);
                    (self.number::<N>(m) * x).store()
                }
            };
        }
    }

    #[inline(always)]
    fn number<N: Scalar<Stored = T>>(&self, j: usize) -> N {
        N::load(self.numbers[j][0])
    }

    #[inline(always)]
    fn reciprocal<N: Scalar<Stored = T>>(&self, j: usize) -> N {
        N::load(self.numbers[j][1])
    }

    /// The gradients of all rows at the start, by the chain rule.
    #[inline(always)]
    fn differentiate<N: Scalar<Stored = T>>(&mut self, series: &Series) {
        for index in 0..series.rows.len() {
            if series.depends[index].is_empty() {
                continue;
            }
            let row = RowId(index as u32);
            let place = self.places[index];
            let count = series.depends[index].len();
            self.gradients[place..place + count].fill(N::ZERO.store());
            match &series.rows[index] {
                Row::Coordinate(_) | Row::Rate(_) | Row::Acceleration(_) => {
                    self.gradients[place] = N::ONE.store();
                }
                Row::Sum(terms) => {
                    for (c, of) in terms {
                        let slope = match c {
                            Some(c) => self.at::<N>(0, 0, N::ZERO).first(*c),
                            None => N::ONE,
                        };
                        self.add_gradient(series, row, *of, slope);
                    }
                }
                _ => {
                    let slopes = series.slopes(row, &mut self.at::<N>(0, 0, N::ZERO));
                    for (of, slope) in slopes.into_iter().flatten() {
                        self.add_gradient(series, row, of, slope);
                    }
                }
            }
        }
    }

    /// Adds a multiple of the gradient of one row to that of another; changes at another level do not count.
    #[inline(always)]
    fn add_gradient<N: Scalar<Stored = T>>(
        &mut self,
        series: &Series,
        to: RowId,
        of: RowId,
        slope: N,
    ) {
        if !series.propagates(to, of) {
            return;
        }
        let (to, of) = (to.index(), of.index());
        let depends = &series.depends;
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

    /// Factors the mass matrix, bordered by the rows of constraints, which is the gradient of the residuals: L D Lᵀ; with friction of a contact that slips it is
    /// inverted. The pivots of constraints are negative as long as the constraints are independent.
    #[inline(always)]
    fn factor<N: Scalar<Stored = T>>(&mut self, series: &Series) -> Result<(), Singular> {
        for block in &mut self.blocks {
            let count = block.members.len();
            block.matrix.fill(N::ZERO.store());
            for (i, member) in block.members.iter().enumerate() {
                let row = series.residuals[*member as usize];
                if series.level(row) != Level::Acceleration {
                    continue;
                }
                let place = self.places[row.index()];
                for (j, column) in series.depends[row.index()].iter().enumerate() {
                    let column = block.place[*column as usize] as usize;
                    block.matrix[i * count + column] = self.gradients[place + j];
                }
            }
            let is_held = |member: &u32| *member as usize >= series.dimension();
            let held = block.members.iter().position(is_held).unwrap_or(count);
            let factored = if series.is_symmetric {
                steps::factor::<N>(count, held, &mut block.matrix)
            } else {
                steps::invert_unsymmetric::<N>(count, held, &mut block.matrix)
            };
            factored.map_err(|vanished| {
                let (pivot, scale) = (vanished.pivot.to_f64(), vanished.scale.to_f64());
                Singular {
                    coordinate: block.members[vanished.row] as usize,
                    // As in the programs of accelerations, 0/0 is reported as 0.
                    ratio: if pivot == 0.0 { 0.0 } else { pivot / scale },
                }
            })?;
        }
        Ok(())
    }

    /// The coefficients of the sources of composed unknowns: the inverse of the matrix times the derivatives of the residuals.
    #[inline(always)]
    fn compose<N: Scalar<Stored = T>>(&mut self) {
        let compositions = self.compositions.clone();
        for (block, composition) in self.blocks.iter_mut().zip(&*compositions) {
            let Some(composition) = composition else {
                continue;
            };
            let count = block.members.len();
            for unknown in 0..count {
                self.derivatives.fill(N::ZERO.store());
                for (i, place) in composition.residuals.iter().enumerate() {
                    let element = N::load(block.matrix[i * count + unknown]);
                    self.derivatives[*place] = (-element).store();
                }
                for step in &composition.steps {
                    let [from, to] = [step.from, step.to].map(|at| N::load(self.derivatives[at]));
                    let sum = match step.factor {
                        None => to + from,
                        Some(row) => {
                            N::load(self.coefficients[row.index() * self.width]).mul_add(from, to)
                        }
                    };
                    self.derivatives[step.to] = sum.store();
                }
                for (i, place) in composition.places.iter().enumerate() {
                    let at = unknown * composition.places.len() + i;
                    block.sources[at] = self.derivatives[*place];
                }
            }
        }
    }

    /// The unknowns of a block of order `round`, composed of its sources. Each is two sums, of every second source, so that the dependency
    /// chain is half as long.
    #[inline(always)]
    fn sum_sources<N: Scalar<Stored = T>>(
        &mut self,
        series: &Series,
        (block, composition): (usize, &Composition),
        round: usize,
    ) {
        let mut sums = [[N::ZERO; 2]; MOST_IN_ONE_SUM];
        for (i, sources) in composition.sources.iter().enumerate() {
            let (mut factor, mut x) = (None, N::ZERO);
            for source in sources {
                x = x + match *source {
                    Source::Known(row) => self.at::<N>(2, round, N::ZERO).newest(row),
                    Source::Sum(row) => N::load(self.kept_sums[row.index()]),
                    Source::Derivative(row) => {
                        let mut at = self.at::<N>(2, round, N::ZERO);
                        let [order, x] = match series.rows[row.index()] {
                            Row::Second(of) => at.second_factors(of),
                            Row::First(of) => at.derivative_factors(of),
                            _ => continue,
                        };
                        factor = Some(order);
                        x
                    }
                };
            }
            let coefficients = &self.blocks[block].sources;
            for unknown in 0..self.blocks[block].members.len() {
                let c = N::load(coefficients[unknown * composition.sources.len() + i]);
                let c = factor.map_or(c, |factor| c * factor);
                let sum = &mut sums[unknown][i % 2];
                *sum = c.mul_add(x, *sum);
            }
        }
        for (member, [even, odd]) in self.blocks[block].members.iter().zip(sums) {
            self.unknowns[*member as usize] = (even + odd).store();
        }
    }

    /// Solves for the accelerations of order `round`, and adds their effect.
    #[inline(always)]
    fn solve<N: Scalar<Stored = T>>(&mut self, series: &Series, round: usize) {
        let width = self.width;
        let compositions = self.compositions.clone();
        for (at, composition) in compositions.iter().enumerate() {
            if let Some(composition) = composition
                && round > 0
            {
                self.sum_sources::<N>(series, (at, composition), round);
                continue;
            }
            let block = &self.blocks[at];
            let [x, scratch] = &mut self.scratch;
            for (at, member) in block.members.iter().enumerate() {
                let row = series.residuals[*member as usize].index();
                x[at] = (-N::load(self.coefficients[row * width + round])).store();
            }
            steps::solve::<N>(block.members.len(), &block.matrix, x, scratch);
            for (at, member) in block.members.iter().enumerate() {
                self.unknowns[*member as usize] = x[at];
            }
        }
        let [over_v, over_q] = [
            self.reciprocal::<N>(round + 1),
            self.reciprocal::<N>(round + 2),
        ];
        let share = over_v * over_q;
        let product = N::divisor((round as i64 + 1) * (round as i64 + 2));
        for at in 0..self.changed_by_newest[2].len() {
            let index = self.changed_by_newest[2][at] as usize;
            let known = N::load(self.coefficients[index * width + round]);
            let sum = if self.adds_to_forces {
                self.change::<N>(index, known)
            } else {
                known + self.change::<N>(index, N::ZERO)
            };
            self.coefficients[index * width + round] = sum.store();
        }
        let coordinates = series.dimension();
        for (k, multiplier) in self.unknowns[coordinates..].iter().enumerate() {
            self.multipliers[k * self.order + round] = *multiplier;
        }
        for i in 0..coordinates {
            let acceleration = N::load(self.unknowns[i]);
            self.rates[i * width + round + 1] = (acceleration * over_v).store();
            // A quotient: products with rounded reciprocals have errors of a fixed sign, which add up over the steps of a long run.
            self.motion[i * width + round + 2] = acceleration.over(product).store();
        }
        for (level, lead, share) in [(0, 2, share), (1, 1, over_v)] {
            for at in 0..self.changed_by_newest[level].len() {
                let index = self.changed_by_newest[level][at] as usize;
                let place = index * width + round + lead;
                let known = N::load(self.coefficients[place]);
                let changed = match (&series.rows[index], &series.depends[index][..]) {
                    (Row::Coordinate(i), _) => {
                        N::load(self.motion[*i as usize * width + round + 2])
                    }
                    (Row::Rate(i), _) => N::load(self.rates[*i as usize * width + round + 1]),
                    // This shortens the dependency chain by one product.
                    (_, [i]) => {
                        let slope = N::load(self.gradients[self.places[index]]) * share;
                        slope.mul_add(N::load(self.unknowns[*i as usize]), known)
                    }
                    _ => share.mul_add(self.change::<N>(index, N::ZERO), known),
                };
                self.coefficients[place] = changed.store();
            }
        }
    }

    /// The gradient of a row times the newest accelerations, added to a number.
    #[inline(always)]
    fn change<N: Scalar<Stored = T>>(&self, index: usize, known: N) -> N {
        let depends = &self.series.depends[index];
        let gradient = &self.gradients[self.places[index]..][..depends.len()];
        let pairs = depends.iter().zip(gradient);
        pairs.fold(known, |sum, (i, g)| {
            N::load(*g).mul_add(N::load(self.unknowns[*i as usize]), sum)
        })
    }
}
