//! Gaussian elimination with complete pivoting, of one equation for each contact.

use super::super::per_contact::{FEW_CONTACTS, PerContact, Values};
use super::{Each, SAME};

/// A pivot is zero below this, relative to the entries of its row.
pub(super) const SINGULAR: f64 = 1e-12;

/// As many linear equations as unknowns: rows of coefficients, each followed by its right-hand side.
#[derive(Clone, Debug)]
pub(in crate::friction) struct Equations {
    count: usize,
    numbers: Values<f64, { FEW_CONTACTS * (FEW_CONTACTS + 1) }>,
}

impl Equations {
    /// So many equations whose numbers are 0.
    pub fn new(count: usize) -> Self {
        Self {
            count,
            numbers: Values::new(count * (count + 1), 0.0),
        }
    }

    /// The rows, whose last entry is the right-hand side.
    pub fn rows(&self) -> impl Iterator<Item = &[f64]> {
        self.numbers.chunks_exact(self.count + 1)
    }

    /// The rows, to write them.
    pub fn rows_mut(&mut self) -> impl Iterator<Item = &mut [f64]> {
        self.numbers.chunks_exact_mut(self.count + 1)
    }

    /// Solves them by Gaussian elimination with complete pivoting. Undetermined unknowns become 0; `None` if the equations contradict each
    /// other.
    pub fn solve(&mut self) -> Option<Each> {
        self.eliminate().map(|(solution, _)| solution)
    }

    /// Eliminates like [`solve`](Self::solve), and returns the unknown for which each row has been solved.
    pub(super) fn eliminate(&mut self) -> Option<(Each, PerContact<Option<usize>>)> {
        let count = self.count;
        let width = count + 1;
        let rows = &mut self.numbers;
        for row in rows.chunks_exact_mut(width) {
            let most = row[..count]
                .iter()
                .fold(0.0_f64, |most, x| most.max(x.abs()));
            if most > 0.0 {
                row.iter_mut().for_each(|x| *x /= most);
            }
        }
        let largest = rows
            .chunks_exact(width)
            .fold(0.0_f64, |most, row| most.max(row[count].abs()));
        let mut column_of = PerContact::new(count, None);
        for done in 0..count {
            let mut pivot = (0.0, 0, 0);
            for (i, row) in rows.chunks_exact(width).enumerate().skip(done) {
                for (j, x) in row[..count].iter().enumerate() {
                    if x.abs() > pivot.0 {
                        pivot = (x.abs(), i, j);
                    }
                }
            }
            let (size, i, j) = pivot;
            if size <= SINGULAR || size.is_nan() {
                let open = rows.chunks_exact(width).skip(done);
                let open = open.map(|row| row[count].abs());
                if open.fold(0.0_f64, f64::max) > SAME * largest {
                    return None;
                }
                break;
            }
            if i != done {
                let (before, after) = rows.split_at_mut(i * width);
                before[done * width..][..width].swap_with_slice(&mut after[..width]);
            }
            column_of[done] = Some(j);
            let (before, from_own) = rows.split_at_mut(done * width);
            let (own, after) = from_own.split_at_mut(width);
            for row in before
                .chunks_exact_mut(width)
                .chain(after.chunks_exact_mut(width))
            {
                let factor = row[j] / own[j];
                for (x, y) in row.iter_mut().zip(&*own) {
                    *x -= factor * y;
                }
                row[j] = 0.0;
            }
        }
        let mut solution = Each::new(count, 0.0);
        for (row, column) in rows.chunks_exact(width).zip(&*column_of) {
            if let Some(j) = column {
                solution[*j] = row[count] / row[*j];
            }
        }
        let is_finite = solution.iter().all(|x| x.is_finite());
        is_finite.then_some((solution, column_of))
    }
}
