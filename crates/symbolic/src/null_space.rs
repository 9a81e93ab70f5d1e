//! Linear algebra over the prime field, where nothing is rounded and rank does not depend on a tolerance.

use lagrangian_scalar::{Residue, Scalar};

/// A basis of the vectors of `width` numbers that all rows map to 0, each with a 1 where the others have a 0.
pub fn null_space(mut rows: Vec<Vec<Residue>>, width: usize) -> Vec<Vec<Residue>> {
    // Gauss–Jordan elimination: each remaining row has a 1 in a column of its own.
    let mut pivots: Vec<(usize, Vec<Residue>)> = Vec::new();
    while let Some(mut row) = rows.pop() {
        for (column, known) in &pivots {
            let factor = row[*column];
            subtract(&mut row, factor, known);
        }
        let Some(column) = row.iter().position(|x| *x != Residue::ZERO) else {
            continue;
        };
        let pivot = row[column];
        row.iter_mut().for_each(|x| *x = *x / pivot);
        for (_, known) in &mut pivots {
            let factor = known[column];
            subtract(known, factor, &row);
        }
        pivots.push((column, row));
    }
    let is_free = |j: &usize| pivots.iter().all(|(column, _)| column != j);
    let direction = |j: usize| {
        let mut direction = vec![Residue::ZERO; width];
        direction[j] = Residue::ONE;
        for (column, row) in &pivots {
            direction[*column] = -row[j];
        }
        direction
    };
    (0..width).filter(is_free).map(direction).collect()
}

fn subtract(row: &mut [Residue], factor: Residue, other: &[Residue]) {
    if factor != Residue::ZERO {
        for (x, y) in row.iter_mut().zip(other) {
            if *y != Residue::ZERO {
                *x = *x - factor * *y;
            }
        }
    }
}
