//! Symmetric matrices, each entry stored once.

/// A symmetric matrix: the lower triangle, row by row.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Symmetric<T> {
    dimension: usize,
    lower: Vec<T>,
}

impl<T> Symmetric<T> {
    /// The matrix with these entries; `entry` is called row by row for `i ≥ j`.
    pub fn from_lower(dimension: usize, mut entry: impl FnMut(usize, usize) -> T) -> Symmetric<T> {
        let mut lower = Vec::with_capacity(dimension * (dimension + 1) / 2);
        for i in 0..dimension {
            for j in 0..=i {
                lower.push(entry(i, j));
            }
        }
        Symmetric { dimension, lower }
    }

    /// The number of rows.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The entry in row `i` and column `j`, which equals that in row `j` and column `i`.
    ///
    /// # Panics
    /// If there is no such row or column.
    pub fn get(&self, i: usize, j: usize) -> &T {
        let (row, column) = (i.max(j), i.min(j));
        assert!(
            row < self.dimension,
            "row {row} of a matrix of {}",
            self.dimension
        );
        &self.lower[row * (row + 1) / 2 + column]
    }

    /// The entries `i ≥ j`, row by row.
    pub fn lower(&self) -> &[T] {
        &self.lower
    }

    /// The entries `i ≥ j`, row by row, mutable.
    pub fn lower_mut(&mut self) -> &mut [T] {
        &mut self.lower
    }

    /// The entries `i ≥ j` with their indices, row by row.
    pub fn entries(&self) -> impl Iterator<Item = (usize, usize, &T)> {
        let places = (0..self.dimension).flat_map(|i| (0..=i).map(move |j| (i, j)));
        places.zip(&self.lower).map(|((i, j), entry)| (i, j, entry))
    }

    /// The matrix with every entry replaced.
    pub fn map<U>(&self, change: impl FnMut(&T) -> U) -> Symmetric<U> {
        Symmetric {
            dimension: self.dimension,
            lower: self.lower.iter().map(change).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_entry_is_found_from_both_sides() {
        let matrix = Symmetric::from_lower(4, |i, j| 10 * i + j);
        assert_eq!(*matrix.get(3, 1), 31);
        assert_eq!(*matrix.get(1, 3), 31);
        assert_eq!(matrix.lower().len(), 10);
        assert!(matrix.entries().all(|(i, j, entry)| *entry == 10 * i + j));
    }
}
