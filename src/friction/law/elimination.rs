//! Gaussian elimination with complete pivoting, for as many equations as there can be contacts.

use super::super::MOST_CONTACTS;
use super::{Each, SAME};

/// A pivot is zero below this, relative to the entries of its row.
pub(super) const SINGULAR: f64 = 1e-12;

/// Solves `count` equations, whose right-hand sides are in the last column, by Gaussian elimination with complete pivoting.
/// Undetermined unknowns become 0; `None` if the equations contradict each other.
pub(in crate::friction) fn solve(
    rows: &mut [[f64; MOST_CONTACTS + 1]; MOST_CONTACTS],
    count: usize,
) -> Option<Each> {
    eliminate(rows, count).map(|(solution, _)| solution)
}

/// Eliminates like [`solve`], and returns the unknown for which each row has been solved.
pub(super) fn eliminate(
    rows: &mut [[f64; MOST_CONTACTS + 1]; MOST_CONTACTS],
    count: usize,
) -> Option<(Each, [Option<usize>; MOST_CONTACTS])> {
    let rows = &mut rows[..count];
    for row in rows.iter_mut() {
        let most = row[..count]
            .iter()
            .fold(0.0_f64, |most, x| most.max(x.abs()));
        if most > 0.0 {
            row[..=count].iter_mut().for_each(|x| *x /= most);
        }
    }
    let largest = rows
        .iter()
        .fold(0.0_f64, |most, row| most.max(row[count].abs()));
    let mut column_of = [None; MOST_CONTACTS];
    for done in 0..count {
        let mut pivot = (0.0, 0, 0);
        for (i, row) in rows.iter().enumerate().skip(done) {
            for (j, x) in row[..count].iter().enumerate() {
                if x.abs() > pivot.0 {
                    pivot = (x.abs(), i, j);
                }
            }
        }
        let (size, i, j) = pivot;
        if size <= SINGULAR || size.is_nan() {
            let open = rows[done..].iter().map(|row| row[count].abs());
            if open.fold(0.0_f64, f64::max) > SAME * largest {
                return None;
            }
            break;
        }
        rows.swap(done, i);
        column_of[done] = Some(j);
        let own = rows[done];
        for (other, row) in rows.iter_mut().enumerate() {
            if other == done {
                continue;
            }
            let factor = row[j] / own[j];
            for (x, y) in row[..=count].iter_mut().zip(own) {
                *x -= factor * y;
            }
            row[j] = 0.0;
        }
    }
    let mut solution = [0.0; MOST_CONTACTS];
    for (row, column) in rows.iter().zip(column_of) {
        if let Some(j) = column {
            solution[j] = row[count] / row[j];
        }
    }
    let is_finite = solution.iter().all(|x| x.is_finite());
    is_finite.then_some((solution, column_of))
}
