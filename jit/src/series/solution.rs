//! Gradients, the composition of unknowns, and the solution at each order: the operations of the interpreter of series, recorded.

use lagrangian_program::series::{Arithmetic as _, Level, MOST_IN_ONE_SUM, Row, RowId, is_inverse};

use super::memory::{NUMBERS, Place};
use super::record::{Block, Part, Recorder, X, ZERO};
use crate::lower::Matrix;

/// What a [`Matrix`] may read behind its end.
const BEHIND: u32 = 8;

impl Recorder<'_> {
    /// The gradients of all rows at the start.
    pub fn differentiate(&mut self) {
        (self.m, self.level) = (0, Level::Position);
        let series = self.series;
        self.gradients = series.gradients(self, |to, [a, b, c]| to.simplified(a, b, c));
    }

    /// Stores the matrices of coupled unknowns.
    pub fn matrices(&mut self) -> Vec<Block> {
        let series = self.series;
        let mut blocks = Vec::new();
        for members in series.blocks() {
            let count = members.len() as u32;
            let matrix = self.memory.take(count * count + BEHIND);
            let entries = series.matrix(&members, &self.gradients);
            for (at, entry) in (matrix..).zip(entries) {
                self.store(entry.unwrap_or(ZERO), Place::Fixed(at));
            }
            blocks.push(Block {
                composition: series
                    .composition(&members)
                    .map(|composition| (composition, Vec::new())),
                members,
                matrix,
            });
        }
        blocks
    }

    /// The coefficients of the sources of composed unknowns.
    pub fn compose(&mut self, blocks: &mut [Block]) {
        for block in blocks {
            let (count, matrix) = (block.members.len() as u32, block.matrix);
            let Some((composition, coefficients)) = &mut block.composition else {
                continue;
            };
            for unknown in 0..count {
                let element = |_: &mut Self, residual: usize| {
                    X::Stored(Place::Fixed(matrix + residual as u32 * count + unknown))
                };
                coefficients.push(composition.coefficients(self, element));
            }
        }
    }

    /// The solution for the unknowns of a block from its residuals.
    fn solution(&mut self, block: &Block, m: usize) -> Vec<X> {
        let n = block.members.len();
        let mut right = Vec::with_capacity(n);
        for member in &block.members {
            let residual = self.read(self.series.residuals[*member as usize], m);
            right.push(self.negate(residual));
        }
        let element =
            |i: usize, j: usize| X::Stored(Place::Fixed(block.matrix + (i * n + j) as u32));
        let is_split = n > MOST_IN_ONE_SUM;
        if is_inverse(n) && is_split && self.width > 1 {
            let matrix = Matrix {
                place: block.matrix,
                stride: n as u32,
                rows: n as u32,
                is_split: true,
            };
            return self.product(matrix, &right);
        }
        if is_inverse(n) {
            return (0..n)
                .map(|i| {
                    let mut sums = [ZERO; 2];
                    for (j, known) in right.iter().enumerate() {
                        let sum = &mut sums[usize::from(is_split) * (j % 2)];
                        *sum = self.multiply_add(element(j, i), *known, *sum);
                    }
                    self.add(sums[0], sums[1])
                })
                .collect();
        }
        let mut x = right;
        for i in 0..n {
            for j in 0..i {
                x[i] = self.neg_mul_add(element(i, j), x[j], x[i]);
            }
        }
        for i in (0..n).rev() {
            x[i] = self.multiply(x[i], element(i, i));
            for j in i + 1..n {
                x[i] = self.neg_mul_add(element(j, i), x[j], x[i]);
            }
        }
        x
    }

    /// Solves for the accelerations of order `m`, and adds their effect.
    pub fn solve(&mut self, blocks: &[Block], m: usize) {
        let series = self.series;
        (self.m, self.level) = (m, Level::Acceleration);
        let mut unknowns = vec![ZERO; series.unknowns()];
        for block in blocks {
            let found = match &block.composition {
                Some((composition, coefficients)) if self.part == Part::Later => coefficients
                    .iter()
                    .map(|of| {
                        let sum =
                            |to: &mut Self, row: RowId| to.kept_sums[row.index()].unwrap_or(ZERO);
                        composition.unknown(series, self, of, sum)
                    })
                    .collect(),
                _ => self.solution(block, m),
            };
            for (member, x) in block.members.iter().zip(found) {
                unknowns[*member as usize] = x;
            }
        }
        let [over_v, over_q] = [m + 1, m + 2].map(|order| self.reciprocal(order));
        let share = self.multiply(over_v, over_q);
        self.change_forces(&unknowns, m);
        let motion = self.store_motion(&unknowns, over_v);
        for index in 0..series.rows.len() {
            let row = RowId(index as u32);
            let (lead, level) = (series.lead(row), series.level(row));
            if level > Level::Rate || lead == 0 || series.depends[index].is_empty() {
                continue;
            }
            let share = [over_v, share][lead - 1];
            let changed = match series.rows[index] {
                Row::Coordinate(i) => motion[i as usize],
                Row::Rate(i) => self.rates[i as usize],
                _ => {
                    let known = self.read(row, m + lead);
                    match series.depends[index][..] {
                        [i] => {
                            let slope = self.multiply(self.gradients[index][0], share);
                            self.multiply_add(slope, unknowns[i as usize], known)
                        }
                        _ => {
                            let change = self.change(row, &unknowns, ZERO);
                            self.multiply_add(share, change, known)
                        }
                    }
                }
            };
            self.set(row, m + lead, changed);
        }
    }

    /// Adds the effect of accelerations on the forces that sums over orders read.
    fn change_forces(&mut self, unknowns: &[X], m: usize) {
        let adds_to_forces = self.series.adds_to_forces();
        let together = match self.matrix_of_forces {
            Some(matrix) => self.product(matrix, unknowns).into_iter(),
            None => Vec::new().into_iter(),
        };
        let mut together = together.fuse();
        for row in self.forces_in_sums() {
            let known = self.read(row, m);
            let sum = if adds_to_forces {
                self.change(row, unknowns, known)
            } else {
                let change = match together.next() {
                    Some(change) => change,
                    None => self.change(row, unknowns, ZERO),
                };
                self.add(known, change)
            };
            self.set(row, m, sum);
        }
    }

    /// The forces that sums over orders read and accelerations change.
    fn forces_in_sums(&self) -> Vec<RowId> {
        let streams = self.series.streams();
        let rows = (0..self.series.rows.len() as u32).map(RowId);
        rows.filter(|row| {
            let index = row.index();
            streams[index] != [false; 2]
                && !self.series.depends[index].is_empty()
                && self.series.level(*row) == Level::Acceleration
        })
        .collect()
    }

    /// Stores the effect of accelerations on forces as a matrix, if that takes fewer operations than each force by itself.
    pub fn store_matrix_of_forces(&mut self) {
        let (series, width) = (self.series, self.width);
        if width == 1 {
            return;
        }
        let forces = self.forces_in_sums();
        let gradients = forces.iter().map(|row| series.depends[row.index()].len());
        let (gradients, rows) = (gradients.sum::<usize>(), forces.len() as u32);
        let (unknowns, stride) = (series.unknowns() as u32, rows.next_multiple_of(8));
        let together = unknowns * (rows.div_ceil(width) + 1);
        if series.adds_to_forces() || together as usize >= gradients {
            return;
        }
        let place = self.memory.take(unknowns * stride + BEHIND);
        for (at, row) in (0..).zip(forces) {
            for (j, unknown) in series.depends[row.index()].iter().enumerate() {
                let gradient = self.gradients[row.index()][j];
                self.store(gradient, Place::Fixed(place + unknown * stride + at));
            }
        }
        self.matrix_of_forces = Some(Matrix {
            place,
            stride,
            rows,
            is_split: false,
        });
    }

    /// Stores the coefficients of coordinates, which are returned, and of their rates.
    fn store_motion(&mut self, unknowns: &[X], over_v: X) -> Vec<X> {
        let back = if self.part == Part::Later { 0 } else { 1 };
        let parts = [2, 3].map(|at| X::Stored(Place::Record(back, NUMBERS[at])));
        let [to_motion, to_rates] = [self.memory.motion(), self.memory.rates()];
        let mut motion = Vec::new();
        for (i, a) in (0..).zip(&unknowns[..self.series.dimension()]) {
            let rate = self.multiply(*a, over_v);
            self.rates[i as usize] = rate;
            let rest = self.multiply(*a, parts[1]);
            let x = self.multiply_add(*a, parts[0], rest);
            motion.push(x);
            self.store(rate, Place::Record(back, to_rates + i));
            self.store(x, Place::Record(back, to_motion + i));
        }
        motion
    }

    /// The gradient of a row times the newest accelerations, added to a number.
    fn change(&mut self, row: RowId, unknowns: &[X], known: X) -> X {
        let depends = &self.series.depends[row.index()];
        let mut sum = known;
        for (at, i) in depends.iter().enumerate() {
            let g = self.gradients[row.index()][at];
            sum = self.multiply_add(g, unknowns[*i as usize], sum);
        }
        sum
    }
}
