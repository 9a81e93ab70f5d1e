//! The unknowns of an order as sums of the numbers that are computed first at that order, without residuals.
//!
//! At each order the residuals are sums of [`Source`]s, with the same coefficients except for factors that depend on the order alone, and the
//! unknowns are sums of the residuals. If there are few unknowns, the product of both matrices is computed once, at the start: the
//! dependency chain from one order to the next then contains one short sum instead of forces, residuals and a solution.
//!
//! The coefficients of an unknown are the derivatives of its sum by the sources. One pass through the rows, from the residuals
//! backwards, gives all of them, as for any reverse derivative (A. Griewank and A. Walther, *Evaluating Derivatives*, 2nd ed., 2008, ch. 3).

use std::collections::HashMap;

use super::recurrence::Arithmetic;
use super::{Level, MOST_IN_ONE_SUM, Row, RowId, Series};

/// Something that an order begins with, and that residuals are sums of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The newest coefficient of a row of positions or rates.
    Known(RowId),
    /// The sum over orders of a row that is the product of a force and a position.
    Sum(RowId),
    /// The second derivative of a row of positions, or the derivative of a row of rates.
    Derivative(RowId),
}

/// `derivatives[to] += factor·derivatives[from]`, with the value of a row at the start as the factor, or 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChainStep {
    /// The index of the derivative by a row.
    pub from: usize,
    /// That of the derivative by one of its operands.
    pub to: usize,
    /// The derivative of the row by the operand; 1 if absent.
    pub factor: Option<RowId>,
}

/// How the coefficients of the sources in a group of unknowns are computed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Composition {
    /// The sources, the latest known last. Those with the same coefficients, which are added before they are multiplied, are together.
    pub sources: Vec<Vec<Source>>,
    /// For each of these groups the index of the derivative.
    pub places: Vec<usize>,
    /// The steps of the pass, in order.
    pub steps: Vec<ChainStep>,
    /// For each unknown of the group the index of the derivative by its residual, where the pass begins.
    pub residuals: Vec<usize>,
    /// The number of derivatives.
    pub derivatives: usize,
}

impl Series {
    /// The composition for a [group](Series::blocks) of unknowns; `None` if its residuals are not such sums, or if its sums would have more terms
    /// than residuals and solution together.
    pub fn composition(&self, members: &[u32]) -> Option<Composition> {
        if members.len() > MOST_IN_ONE_SUM {
            return None;
        }
        let residuals = members.iter().map(|i| self.residuals[*i as usize]);
        let residuals: Vec<RowId> = residuals.collect();
        let mut pass = Pass::new(self, &residuals)?;
        // Operands precede their users.
        for index in (0..self.rows.len()).rev() {
            if pass.is_reached[index] {
                pass.visit(RowId(index as u32))?;
            }
        }
        let (sources, places) = pass.groups(&residuals);
        let residuals = residuals.into_iter().map(|row| pass.place(row)).collect();
        let count = members.len();
        (count * sources.len() <= pass.steps.len() + count * count).then_some(Composition {
            sources,
            places,
            steps: pass.steps,
            residuals,
            derivatives: pass.derivatives,
        })
    }

    /// The rows of forces whose coefficients of later orders are needed: all except those that only residuals of
    /// [compositions](Composition) read.
    pub fn later_forces(&self) -> Vec<bool> {
        let mut needed = vec![false; self.rows.len()];
        for (row, streams) in self.streams().iter().enumerate() {
            needed[row] = *streams != [false; 2] && self.levels[row] == Level::Acceleration;
        }
        for members in self.blocks() {
            if self.composition(&members).is_none() {
                for member in members {
                    needed[self.residuals[member as usize].index()] = true;
                }
            }
        }
        for index in (0..self.rows.len()).rev() {
            if needed[index] {
                self.rows[index].for_each_operand(|operand| {
                    needed[operand.index()] |= self.level(operand) == Level::Acceleration;
                });
            }
        }
        needed
    }
}

impl Composition {
    /// The coefficients of the sources of an unknown, to be written or compiled: `element` gives the element of the inverse matrix in the column of the unknown
    /// and in the row of a residual.
    pub fn coefficients<A: Arithmetic>(
        &self,
        to: &mut A,
        mut element: impl FnMut(&mut A, usize) -> A::X,
    ) -> Vec<A::X> {
        let mut derivatives = vec![to.zero(); self.derivatives];
        for (i, place) in self.residuals.iter().enumerate() {
            let element = element(to, i);
            derivatives[*place] = to.negate(element);
        }
        for step in &self.steps {
            let [from, onto] = [step.from, step.to].map(|at| derivatives[at]);
            derivatives[step.to] = match step.factor {
                None => to.add(onto, from),
                Some(row) => {
                    let factor = to.first(row);
                    to.multiply_add(factor, from, onto)
                }
            };
        }
        self.places
            .iter()
            .map(|place| derivatives[*place])
            .collect()
    }

    /// An unknown with these coefficients at the present order: two sums of its sources, of every second one. `sum` gives the sum over orders of a product.
    pub fn unknown<A: Arithmetic>(
        &self,
        series: &Series,
        to: &mut A,
        coefficients: &[A::X],
        mut sum: impl FnMut(&mut A, RowId) -> A::X,
    ) -> A::X {
        let mut sums = [to.zero(), to.zero()];
        for (i, (sources, c)) in self.sources.iter().zip(coefficients).enumerate() {
            let (mut c, mut x) = (*c, to.zero());
            for source in sources {
                let more = match *source {
                    Source::Known(row) => to.newest(row),
                    Source::Sum(row) => sum(to, row),
                    Source::Derivative(row) => {
                        let [factor, x] = match series.rows[row.index()] {
                            Row::Second(of) => to.second_factors(of),
                            Row::First(of) => to.derivative_factors(of),
                            _ => continue,
                        };
                        c = to.multiply(c, factor);
                        x
                    }
                };
                x = to.add(x, more);
            }
            sums[i % 2] = to.multiply_add(c, x, sums[i % 2]);
        }
        let [even, odd] = sums;
        to.add(even, odd)
    }
}

impl Series {
    /// The matrix of a [group](Self::blocks) of unknowns, row by row, from the gradients of all rows: the gradients of its residuals by its unknowns. `None` is 0.
    pub fn matrix<X: Copy>(&self, members: &[u32], gradients: &[Vec<X>]) -> Vec<Option<X>> {
        let mut entries = Vec::with_capacity(members.len() * members.len());
        for member in members {
            let row = self.residuals[*member as usize];
            let is_solved_for = self.level(row) == Level::Acceleration;
            entries.extend(members.iter().map(|column| {
                let at = self.depends[row.index()].binary_search(column).ok()?;
                is_solved_for.then(|| gradients[row.index()][at])
            }));
        }
        entries
    }
}

impl Source {
    /// The row whose derivative is the coefficient.
    pub fn row(self) -> RowId {
        match self {
            Source::Known(row) | Source::Sum(row) | Source::Derivative(row) => row,
        }
    }
}

/// A pass through the rows, from residuals backwards.
struct Pass<'s> {
    series: &'s Series,
    /// Whether residuals depend on a row.
    is_reached: Vec<bool>,
    /// The index of the derivative by a row.
    places: Vec<Option<usize>>,
    derivatives: usize,
    steps: Vec<ChainStep>,
    /// Rows of positions and rates, products, and derivatives; the last row first.
    sources: [Vec<Source>; 3],
}

impl<'s> Pass<'s> {
    /// A pass that begins at these rows; `None` if they are not all different rows that depend on accelerations.
    fn new(series: &'s Series, residuals: &[RowId]) -> Option<Pass<'s>> {
        let mut is_reached = vec![false; series.rows.len()];
        for row in residuals {
            if series.level(*row) != Level::Acceleration || is_reached[row.index()] {
                return None;
            }
            is_reached[row.index()] = true;
        }
        Some(Pass {
            series,
            is_reached,
            places: vec![None; series.rows.len()],
            derivatives: 0,
            steps: Vec::new(),
            sources: [(); 3].map(|()| Vec::new()),
        })
    }

    /// The index of the derivative by a row.
    fn place(&mut self, row: RowId) -> usize {
        *self.places[row.index()].get_or_insert_with(|| {
            self.derivatives += 1;
            self.derivatives - 1
        })
    }

    /// Goes from a row to its operands; `None` if it is no sum of sources and of rows that depend on accelerations.
    fn visit(&mut self, row: RowId) -> Option<()> {
        let series = self.series;
        let [known, sums, derivatives] = &mut self.sources;
        if series.level(row) != Level::Acceleration {
            known.push(Source::Known(row));
            return Some(());
        }
        let operands = match &series.rows[row.index()] {
            Row::Acceleration(_) => Vec::new(),
            Row::Second(of) => {
                // The newest coefficient of a coordinate is 0 until the unknowns are known.
                if !matches!(series.rows[of.index()], Row::Coordinate(_)) {
                    derivatives.push(Source::Derivative(row));
                }
                Vec::new()
            }
            Row::First(_) => {
                derivatives.push(Source::Derivative(row));
                Vec::new()
            }
            Row::Sum(terms) => terms.clone(),
            Row::Product(a, b) => {
                let [force, factor] = match series.level(*a) {
                    Level::Acceleration => [*a, *b],
                    _ => [*b, *a],
                };
                if series.is_force(row) {
                    sums.push(Source::Sum(row));
                } else if series.varies(factor) {
                    return None;
                }
                vec![(Some(factor), force)]
            }
            _ => return None,
        };
        for (factor, of) in operands {
            if series.varies(of) {
                self.is_reached[of.index()] = true;
                let [from, to] = [row, of].map(|row| self.place(row));
                self.steps.push(ChainStep { from, to, factor });
            }
        }
        Some(())
    }

    /// The sources in groups with the same coefficients, and the index of the derivative of each group.
    fn groups(&mut self, residuals: &[RowId]) -> (Vec<Vec<Source>>, Vec<usize>) {
        // Where each derivative comes from.
        let mut origins: HashMap<usize, Vec<(usize, Option<RowId>)>> = HashMap::new();
        for step in &self.steps {
            let origin = origins.entry(step.to).or_default();
            origin.push((step.from, step.factor));
        }
        let (mut groups, mut places): (Vec<Vec<Source>>, _) = (Vec::new(), Vec::new());
        let mut known: HashMap<&[(usize, Option<RowId>)], usize> = HashMap::new();
        let sources = std::mem::take(&mut self.sources);
        for source in sources.iter().flat_map(|sources| sources.iter().rev()) {
            let place = self.place(source.row());
            // What enters the same rows with the same factors has the same derivative, unless the pass begins there. Factors of
            // derivatives depend on the order.
            let is_alone =
                matches!(source, Source::Derivative(_)) || residuals.contains(&source.row());
            let origin = origins.get(&place).filter(|_| !is_alone);
            match origin.and_then(|origin| known.get(origin.as_slice())) {
                Some(same) => groups[*same].push(*source),
                None => {
                    if let Some(origin) = origin {
                        known.insert(origin, groups.len());
                    }
                    groups.push(vec![*source]);
                    places.push(place);
                }
            }
        }
        (groups, places)
    }
}
