//! Linear complementarity problems: `w = M z + q`, `w ≥ 0`, `z ≥ 0`, `wᵀz = 0`.
//!
//! C. E. Lemke, *Bimatrix equilibrium points and mathematical programming*, Management Science 11 (1965) 681–689.
//! Ties in the ratio test are broken lexicographically, so that degenerate problems do not cycle (R. W. Cottle,
//! J.-S. Pang, R. E. Stone, *The Linear Complementarity Problem*, 1992, section 4.9). The numbers of the last basis
//! are solved for once more from the problem itself, so that rounding of the pivots does not add up.

use std::vec;
use std::vec::Vec;

/// A solution.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Solution {
    pub z: Vec<f64>,
    /// By how much it misses any of the conditions, relative to the size of the terms.
    pub residual: f64,
}

/// Why there is no solution here: the path of pivots goes to infinity, or does not end in as many pivots as any
/// problem of that size takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Unsolved;

/// What counts as zero in a tableau of numbers about as large as 1.
const ZERO: f64 = 1e-12;

/// How small the residual of a solution is that is not looked for once more along another path.
const GOOD: f64 = 1e-12;

/// How many paths are tried.
const PATHS: usize = 8;

/// How many pivots a path takes at most, for each number and beyond two hundred: those of contacts take some three, and one that rounding has led astray goes on and on.
const MOST_PIVOTS: usize = 12;

/// How often in succession a guess which numbers are positive is corrected without fewer wrong ones than ever before.
const IN_VAIN: usize = 1;

/// Memory for the search for a solution.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    /// The solution.
    pub z: Vec<f64>,
    /// The best of what was found along several paths, and what was found before.
    best: Vec<f64>,
    first: Vec<f64>,
    /// The constants without rounding.
    rounded: Vec<f64>,
    wrong: Vec<bool>,
    in_basis: Vec<bool>,
    equations: Equations,
    sums: Vec<f64>,
    tableau: Tableau,
}

/// Memory for the equations of the numbers that are positive.
#[derive(Clone, Debug, Default)]
struct Equations {
    chosen: Vec<usize>,
    left: Vec<f64>,
    right: Vec<f64>,
    values: Vec<f64>,
    order: Order,
}

/// Solves the problem of the matrix `m`, row after row, whose entries are about as large as 1.
///
/// Where contacts depend on each other, most bases are singular, and rounding may lead a path of pivots astray. Then
/// others are tried, each with its own covering vector, and the solution with the least residual is taken; so what is
/// called unsolved has been tried along all of them.
pub(crate) fn lemke(m: &[f64], q: &[f64]) -> Result<Solution, Unsolved> {
    let mut memory = Memory::default();
    let residual = lemke_into(m, q, &mut memory)?;
    Ok(Solution {
        z: memory.z,
        residual,
    })
}

/// Like [`lemke`], in memory that is there: writes the solution to it, and says its residual.
pub(crate) fn lemke_into(m: &[f64], q: &[f64], memory: &mut Memory) -> Result<f64, Unsolved> {
    let n = q.len();
    memory.z.clear();
    memory.z.resize(n, 0.0);
    let size = q.iter().fold(0.0_f64, |size, q| size.max(q.abs()));
    if q.iter().all(|q| *q >= 0.0) {
        return Ok(0.0);
    }
    if !size.is_finite() || m.iter().any(|m| !m.is_finite()) {
        return Err(Unsolved);
    }
    let found = along_paths(m, q, size, memory);
    core::mem::swap(&mut memory.first, &mut memory.best);
    // Numbers of q that are rounding, where they are negative, may lead every path to infinity: as where contacts that
    // stick lift together.
    let mut rounded = core::mem::take(&mut memory.rounded);
    rounded.clear();
    rounded.extend((q.iter()).map(|q| if q.abs() <= ZERO * size { 0.0 } else { *q }));
    let mut other = None;
    if found.is_none_or(|found| found > GOOD) && rounded != q {
        if rounded.iter().all(|q| *q >= 0.0) {
            memory.best.clear();
            memory.best.resize(n, 0.0);
            other = Some(());
        } else {
            other = along_paths(m, &rounded, size, memory).map(|_| ());
        }
    }
    memory.rounded = rounded;
    let other = other.map(|()| residual(m, q, &memory.best, &mut memory.sums));
    let (z, residual) = match (found, other) {
        (Some(found), Some(other)) if other < found => (&memory.best, other),
        (Some(found), _) => (&memory.first, found),
        (None, Some(other)) => (&memory.best, other),
        (None, None) => return Err(Unsolved),
    };
    memory.z.copy_from_slice(z);
    Ok(residual)
}

/// Writes the best of what is found along several paths of pivots, and says its residual.
fn along_paths(m: &[f64], q: &[f64], size: f64, memory: &mut Memory) -> Option<f64> {
    let mut best: Option<f64> = None;
    for path in 0..PATHS {
        let Ok(found) = along((m, q, size), path, memory) else {
            continue;
        };
        if best.is_none_or(|best| found < best) {
            best = Some(found);
            core::mem::swap(&mut memory.best, &mut memory.z);
        }
        if best.is_some_and(|best| best <= GOOD) {
            break;
        }
    }
    memory.z.clear();
    memory.z.resize(q.len(), 0.0);
    best
}

/// Solves the problem of [`lemke`] from a guess which numbers of `z` are positive, by principal pivoting of all wrong ones at once: writes the solution to the
/// memory and says its residual; none if that does not end soon, or if the numbers miss the conditions by more than rounding. `correct` is told which places are
/// wrong, and changes the guess. Where a similar problem has been solved before, this takes a few eliminations in place of as many pivots as there are numbers.
///
/// (J. J. Júdice, F. M. Pires, *A block principal pivoting algorithm for large-scale strictly monotone linear complementarity problems*, Comput.
/// Oper. Res. 21 (1994) 587–596.)
pub(crate) fn from_guess(
    m: &[f64],
    q: &[f64],
    is_positive: &mut [bool],
    mut correct: impl FnMut(&[bool], &mut [bool]),
    memory: &mut Memory,
) -> Option<f64> {
    let n = q.len();
    let Memory {
        z,
        wrong,
        equations,
        sums,
        ..
    } = memory;
    let (mut fewest, mut in_vain) = (usize::MAX, 0);
    while in_vain < IN_VAIN {
        equations.with_positive(m, q, is_positive, z);
        let greatest = z.iter().fold(0.0_f64, |most, z| most.max(z.abs()));
        let is_wrong = |(i, row): (usize, &[f64])| {
            if is_positive[i] {
                return z[i] < -ZERO * greatest;
            }
            let terms = row.iter().zip(&*z).map(|(m, z)| m * z);
            let [sum, size] = terms.fold([q[i], q[i].abs()], |[sum, size], term| {
                [sum + term, size.max(term.abs())]
            });
            sum < -ZERO * size
        };
        wrong.clear();
        wrong.extend(m.chunks_exact(n).enumerate().map(is_wrong));
        let count = wrong.iter().filter(|wrong| **wrong).count();
        if count == 0 {
            z.iter_mut().for_each(|z| *z = z.max(0.0));
            let residual = residual(m, q, z, sums);
            return (residual <= GOOD).then_some(residual);
        }
        correct(wrong, is_positive);
        in_vain = if count < fewest { 0 } else { in_vain + 1 };
        fewest = fewest.min(count);
    }
    None
}

/// One path of pivots, by a covering vector of its own: writes the solution and says its residual.
fn along(
    (m, q, size): (&[f64], &[f64], f64),
    path: usize,
    memory: &mut Memory,
) -> Result<f64, Unsolved> {
    let n = q.len();
    let Memory {
        z,
        in_basis,
        equations,
        sums,
        tableau,
        ..
    } = memory;
    tableau.begin(m, q, size, path);
    // The covering variable goes in where q is least.
    let mut leaving = tableau.least(2 * n);
    let mut entering = 2 * n;
    for _ in 0..MOST_PIVOTS * n + 200 {
        let left = tableau.basis[leaving];
        tableau.pivot(leaving, entering);
        if left == 2 * n {
            // The numbers of the basis, from the problem itself, unless rounding has made it singular.
            in_basis.clear();
            in_basis.resize(n, false);
            (tableau.basis.iter())
                .filter(|variable| (n..2 * n).contains(*variable))
                .for_each(|variable| in_basis[variable - n] = true);
            if equations.with_positive(m, q, in_basis, z) {
                z.iter_mut().for_each(|z| *z = z.max(0.0));
            } else {
                tableau.write_z(size, z);
            }
            return Ok(residual(m, q, z, sums));
        }
        // What has left is followed by its complement.
        entering = if left < n { left + n } else { left - n };
        leaving = tableau.blocking(entering).ok_or(Unsolved)?;
    }
    Err(Unsolved)
}

/// Rows `w − M z − d z₀ = q`, `d` the covering vector, solved for what is in the basis: columns of `w`, of `z`, of `z₀` and of `q`.
#[derive(Clone, Debug, Default)]
struct Tableau {
    n: usize,
    width: usize,
    numbers: Vec<f64>,
    /// Memory for a row.
    pivot: Vec<f64>,
    /// Which variable each row is solved for: `w` from 0, `z` from n, `z₀` last.
    basis: Vec<usize>,
}

impl Tableau {
    fn begin(&mut self, m: &[f64], q: &[f64], size: f64, path: usize) {
        let n = q.len();
        let width = 2 * n + 2;
        self.numbers.clear();
        self.numbers.resize(n * width, 0.0);
        for (i, row) in self.numbers.chunks_exact_mut(width).enumerate() {
            row[i] = 1.0;
            for (to, m) in row[n..2 * n].iter_mut().zip(&m[i * n..][..n]) {
                *to = -m;
            }
            // All ones first; then fractions of multiples of the golden ratio, between 1 and 2.
            let cover = (path * (i + 1)) as f64 * 0.618_033_988_749_895;
            row[2 * n] = -(1.0 + cover.fract());
            row[2 * n + 1] = q[i] / size;
        }
        (self.n, self.width) = (n, width);
        self.basis.clear();
        self.basis.extend(0..n);
    }

    fn row(&self, i: usize) -> &[f64] {
        &self.numbers[i * self.width..][..self.width]
    }

    /// Compares two rows divided by their entries in a column: what they are solved for, then what the first
    /// variables have done to them.
    fn is_before(&self, i: usize, j: usize, column: usize) -> bool {
        let (a, b) = (self.row(i), self.row(j));
        let (by_a, by_b) = (a[column], b[column]);
        let first = [2 * self.n + 1];
        for k in first.into_iter().chain(0..self.n) {
            let (x, y) = (a[k] / by_a, b[k] / by_b);
            if (x - y).abs() > ZERO * (1.0 + x.abs().max(y.abs())) {
                return x < y;
            }
        }
        false
    }

    /// The row in which the covering variable goes in: the lexicographically least.
    fn least(&self, column: usize) -> usize {
        let mut least = 0;
        for i in 1..self.n {
            // Divided by what is negative, the greatest is the least.
            if self.is_before(least, i, column) {
                least = i;
            }
        }
        least
    }

    /// The row that stops a variable from growing; none if nothing does.
    fn blocking(&self, column: usize) -> Option<usize> {
        let greatest = (0..self.n).fold(0.0_f64, |greatest, i| {
            greatest.max(self.row(i)[column].abs())
        });
        let mut found: Option<usize> = None;
        for i in 0..self.n {
            if self.row(i)[column] <= ZERO * greatest.max(1.0) {
                continue;
            }
            let is_better = match found {
                None => true,
                Some(best) => {
                    let ratio = |i: usize| self.row(i)[2 * self.n + 1] / self.row(i)[column];
                    let is_tie = (ratio(i) - ratio(best)).abs()
                        <= ZERO * (1.0 + ratio(i).abs().max(ratio(best).abs()));
                    // The covering variable leaves as soon as it may.
                    match (is_tie, self.basis[i] == 2 * self.n) {
                        (true, true) => true,
                        (true, false) if self.basis[best] == 2 * self.n => false,
                        _ => self.is_before(i, best, column),
                    }
                }
            };
            if is_better {
                found = Some(i);
            }
        }
        found
    }

    fn pivot(&mut self, row: usize, column: usize) {
        let width = self.width;
        let by = self.numbers[row * width + column];
        let mut pivot = core::mem::take(&mut self.pivot);
        pivot.clear();
        pivot.extend(self.row(row).iter().map(|x| x / by));
        for (i, own) in self.numbers.chunks_exact_mut(width).enumerate() {
            let factor = own[column];
            if i == row {
                own.copy_from_slice(&pivot);
            } else if factor != 0.0 {
                for (to, from) in own.iter_mut().zip(&pivot) {
                    *to -= factor * from;
                }
                own[column] = 0.0;
            }
        }
        self.pivot = pivot;
        self.basis[row] = column;
    }

    fn write_z(&self, size: f64, z: &mut Vec<f64>) {
        z.clear();
        z.resize(self.n, 0.0);
        for (i, &variable) in self.basis.iter().enumerate() {
            if (self.n..2 * self.n).contains(&variable) {
                z[variable - self.n] = (size * self.row(i)[2 * self.n + 1]).max(0.0);
            }
        }
    }
}

impl Equations {
    /// Writes the numbers `z` with `w = 0` for those that are called positive, and 0 for the rest; whether they are the only ones.
    fn with_positive(
        &mut self,
        m: &[f64],
        q: &[f64],
        is_positive: &[bool],
        z: &mut Vec<f64>,
    ) -> bool {
        let n = q.len();
        let Self {
            chosen,
            left,
            right,
            values,
            order,
        } = self;
        chosen.clear();
        chosen.extend((0..n).filter(|i| is_positive[*i]));
        left.clear();
        right.clear();
        for &i in &*chosen {
            left.extend(chosen.iter().map(|j| m[i * n + j]));
            right.push(-q[i]);
        }
        eliminate_into(left, right, (values, order));
        z.clear();
        z.resize(n, 0.0);
        for (&i, value) in chosen.iter().zip(&*values) {
            z[i] = *value;
        }
        order.rank == chosen.len()
    }
}

/// By how much numbers miss `M z + q ≥ 0 ⊥ z ≥ 0`, relative to the greatest term of all: a row of which nothing is
/// left but rounding is not held against terms of its own.
fn residual(m: &[f64], q: &[f64], z: &[f64], sums: &mut Vec<f64>) -> f64 {
    let n = q.len();
    let greatest = z
        .iter()
        .fold(f64::MIN_POSITIVE, |size, z| size.max(z.abs()));
    let mut size = q
        .iter()
        .fold(f64::MIN_POSITIVE, |size, q| size.max(q.abs()));
    sums.clear();
    sums.extend_from_slice(q);
    for (sum, row) in sums.iter_mut().zip(m.chunks_exact(n)) {
        for (m, z) in row.iter().zip(z) {
            *sum += m * z;
            size = size.max((m * z).abs());
        }
    }
    let missed = |(sum, z): (&f64, &f64)| (-sum / size).max((sum.abs() / size).min(z / greatest));
    sums.iter().zip(z).map(missed).fold(0.0, f64::max)
}

/// Solves `A x = b` by elimination with a full search for pivots. What depends on the rest is 0; the second result
/// is how much does not.
pub(crate) fn solve(a: &mut [f64], b: &mut [f64]) -> (Vec<f64>, usize) {
    let (x, order) = eliminate(a, b);
    (x, order.rank)
}

/// The order of the unknowns after [`eliminate`]: first those that are determined, then the undetermined ones, which have been set to 0.
#[derive(Clone, Debug, Default)]
pub(crate) struct Order {
    columns: Vec<usize>,
    pub rank: usize,
    /// Memory for the greatest entry of each row.
    greatest: Vec<f64>,
}

impl Order {
    /// A basis of the null space of the matrix: the change of all unknowns for a unit of each undetermined one. `a` is the triangular matrix.
    pub fn null_space(&self, a: &[f64]) -> Vec<Vec<f64>> {
        let n = self.columns.len();
        let of_unit = |free: usize| {
            let mut x = vec![0.0; n];
            x[self.columns[free]] = 1.0;
            for i in (0..self.rank).rev() {
                let known = (i + 1..self.rank).map(|j| a[i * n + j] * x[self.columns[j]]);
                x[self.columns[i]] = -(a[i * n + free] + known.sum::<f64>()) / a[i * n + i];
            }
            x
        };
        (self.rank..n).map(of_unit).collect()
    }
}

/// Eliminates `A x = b` like [`solve`], and returns the order of the unknowns in the triangular matrix that `a` then holds.
pub(crate) fn eliminate(a: &mut [f64], b: &mut [f64]) -> (Vec<f64>, Order) {
    let (mut x, mut order) = (Vec::new(), Order::default());
    eliminate_into(a, b, (&mut x, &mut order));
    (x, order)
}

/// The greatest entry of a row, by its size.
fn greatest_entry(row: &[f64]) -> f64 {
    row.iter()
        .fold(0.0, |most, x| if x.abs() > most { x.abs() } else { most })
}

/// Like [`eliminate`], into memory that is there.
pub(crate) fn eliminate_into(
    a: &mut [f64],
    b: &mut [f64],
    (x, order): (&mut Vec<f64>, &mut Order),
) {
    let n = b.len();
    let Order {
        columns,
        greatest: greatest_of,
        ..
    } = order;
    columns.clear();
    columns.extend(0..n);
    let greatest = a.iter().fold(0.0_f64, |size, a| size.max(a.abs()));
    // Of many contacts each depends on a few others: the search looks again at no row that an elimination has left as it was.
    greatest_of.clear();
    greatest_of.extend(a.chunks_exact(n.max(1)).map(greatest_entry));
    let mut rank = 0;
    while rank < n {
        let mut best = (rank, rank, 0.0_f64);
        for (i, &most) in greatest_of.iter().enumerate().skip(rank) {
            if most > best.2 {
                best = (i, rank, most);
            }
        }
        let place = |x: &f64| x.abs() == best.2;
        let found = a[best.0 * n..][rank..n].iter().position(place);
        best.1 = rank + found.unwrap_or(0);
        let (row, column, size) = best;
        if size <= 1e-11 * greatest || size.is_nan() {
            break;
        }
        for j in 0..n {
            a.swap(rank * n + j, row * n + j);
        }
        b.swap(rank, row);
        greatest_of.swap(rank, row);
        for i in 0..n {
            a.swap(i * n + rank, i * n + column);
        }
        columns.swap(rank, column);
        let (above, below) = a.split_at_mut((rank + 1) * n);
        let pivot = &above[rank * n..][rank..];
        for (i, row) in below.chunks_exact_mut(n).enumerate() {
            let row = &mut row[rank..];
            let factor = row[0] / pivot[0];
            if row[0] == 0.0 {
                continue;
            }
            if factor != 0.0 {
                for (x, above) in row.iter_mut().zip(pivot) {
                    *x -= factor * above;
                }
                b[rank + 1 + i] -= factor * b[rank];
            }
            greatest_of[rank + 1 + i] = greatest_entry(&row[1..]);
        }
        rank += 1;
    }
    x.clear();
    x.resize(n, 0.0);
    for i in (0..rank).rev() {
        let known: f64 = (i + 1..rank).map(|j| a[i * n + j] * x[columns[j]]).sum();
        x[columns[i]] = (b[i] - known) / a[i * n + i];
    }
    order.rank = rank;
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers between −1 and 1 that look drawn at random.
    fn drawn(seed: &mut u64) -> f64 {
        *seed ^= *seed << 13;
        *seed ^= *seed >> 7;
        *seed ^= *seed << 17;
        (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Elimination that searches all of the rest for each pivot, and changes every row.
    fn eliminate_all(a: &mut [f64], b: &mut [f64]) -> Vec<f64> {
        let n = b.len();
        let mut columns: Vec<usize> = (0..n).collect();
        let greatest = a.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let mut rank = 0;
        while rank < n {
            let mut best = (rank, rank, 0.0);
            for i in rank..n {
                for j in rank..n {
                    if a[i * n + j].abs() > best.2 {
                        best = (i, j, a[i * n + j].abs());
                    }
                }
            }
            if best.2 <= 1e-11 * greatest {
                break;
            }
            (0..n).for_each(|j| a.swap(rank * n + j, best.0 * n + j));
            (0..n).for_each(|i| a.swap(i * n + rank, i * n + best.1));
            b.swap(rank, best.0);
            columns.swap(rank, best.1);
            for i in rank + 1..n {
                let factor = a[i * n + rank] / a[rank * n + rank];
                for j in rank..n {
                    a[i * n + j] -= factor * a[rank * n + j];
                }
                b[i] -= factor * b[rank];
            }
            rank += 1;
        }
        let mut x = vec![0.0; n];
        for i in (0..rank).rev() {
            let known: f64 = (i + 1..rank).map(|j| a[i * n + j] * x[columns[j]]).sum();
            x[columns[i]] = (b[i] - known) / a[i * n + i];
        }
        x
    }

    /// Matrices of a heap, most of whose entries are 0, of every rank.
    #[test]
    fn rows_that_are_not_searched_again_change_no_bit() {
        let mut seed = 0x2545_f491_4f6c_dd1d;
        for case in 0..500 {
            let n = 1 + case % 40;
            let bodies = 1 + case % 13;
            // Each contact moves two bodies.
            let rows: Vec<Vec<f64>> = (0..n)
                .map(|k| {
                    let mut row = vec![0.0; bodies];
                    row[k % bodies] = drawn(&mut seed);
                    row[(7 * k + 3) % bodies] = drawn(&mut seed);
                    row
                })
                .collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let a: Vec<f64> = (0..n * n)
                .map(|k| dot(&rows[k / n], &rows[k % n]))
                .collect();
            let b: Vec<f64> = (0..n).map(|_| drawn(&mut seed)).collect();
            let (found, _) = eliminate(&mut a.clone(), &mut b.clone());
            let expected = eliminate_all(&mut a.clone(), &mut b.clone());
            assert_eq!(found, expected, "case {case}");
        }
    }

    #[test]
    fn random_problems_of_every_rank_are_solved_to_rounding() {
        let mut seed = 0x9e37_79b9_7f4a_7c15;
        for case in 0..3000 {
            let n = 1 + case % 30;
            let rank = 1 + case % n.max(1);
            let rows: Vec<Vec<f64>> = (0..n)
                .map(|_| (0..rank).map(|_| drawn(&mut seed)).collect())
                .collect();
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let m: Vec<f64> = (0..n * n)
                .map(|k| dot(&rows[k / n], &rows[k % n]) / rank as f64)
                .collect();
            // Rates of a body that exists: then there is a solution, for any rank.
            let v: Vec<f64> = (0..rank).map(|_| drawn(&mut seed)).collect();
            let q: Vec<f64> = rows.iter().map(|row| dot(row, &v)).collect();
            let found = lemke(&m, &q);
            let Ok(solution) = found else {
                panic!("case {case} of {n} contacts and rank {rank} was not solved");
            };
            assert!(solution.residual < 1e-11, "case {case}: {solution:?}");
        }
    }

    #[test]
    fn every_state_is_looked_at_and_none_other_than_the_one_found_holds() {
        // Positive definite problems have one solution: found by trying all sets of three.
        let mut seed = 7;
        for _ in 0..100 {
            let n = 3;
            let rows: Vec<f64> = (0..9).map(|_| drawn(&mut seed)).collect();
            let mut m = vec![0.0; 9];
            for i in 0..n {
                for j in 0..n {
                    m[i * n + j] = (0..n)
                        .map(|k| rows[i * n + k] * rows[j * n + k])
                        .sum::<f64>();
                }
                m[i * n + i] += 0.1;
            }
            let q: Vec<f64> = (0..n).map(|_| drawn(&mut seed)).collect();
            let mut truth = Vec::new();
            for set in 0..1 << n {
                let inside: Vec<usize> = (0..n).filter(|i| set >> i & 1 == 1).collect();
                let k = inside.len();
                let mut a = vec![0.0; k * k];
                let mut b = vec![0.0; k];
                for (r, &i) in inside.iter().enumerate() {
                    for (c, &j) in inside.iter().enumerate() {
                        a[r * k + c] = m[i * n + j];
                    }
                    b[r] = -q[i];
                }
                let (x, _) = solve(&mut a, &mut b);
                let mut z = vec![0.0; n];
                for (&i, x) in inside.iter().zip(&x) {
                    z[i] = *x;
                }
                let w = |i: usize| q[i] + (0..n).map(|j| m[i * n + j] * z[j]).sum::<f64>();
                if z.iter().all(|z| *z >= 0.0) && (0..n).all(|i| w(i) > -1e-12) {
                    truth = z;
                }
            }
            let found = lemke(&m, &q).map(|found| found.z).unwrap_or_default();
            assert_eq!(found.len(), n);
            for (found, truth) in found.iter().zip(&truth) {
                assert!((found - truth).abs() < 1e-10);
            }
        }
    }

    /// A level rod that is about to lift at both ends, which stick: friction along the rod depends on the other one, and its
    /// rates are rounding.
    #[test]
    fn rates_that_are_rounding_leave_a_solution() {
        for (opens, slips) in [(0.84, 1e-28), (0.84, -1e-28), (1e-8, -1e-21)] {
            // Unknowns: normal, forward, backward and slip of both ends, by inertia of translation and of rotation.
            let (across, along, turn) = (1.0, 1.0, 0.7);
            let row = |normal: [f64; 2], tangent: f64, slip: [f64; 2]| {
                let part = |k: usize| [normal[k], tangent, -tangent, slip[k]];
                [part(0), part(1)].concat()
            };
            let end = |k: usize| {
                let is = |i: usize| f64::from(u8::from(i == k));
                let normal = [0, 1].map(|i| across + if i == k { turn } else { -turn });
                [
                    row(normal, 0.0, [0.0; 2]),
                    row([0.0; 2], along, [0, 1].map(is)),
                    row([0.0; 2], -along, [0, 1].map(is)),
                    [0, 1].map(|i| [0.3 * is(i), -is(i), -is(i), 0.0]).concat(),
                ]
                .concat()
            };
            let m = [end(0), end(1)].concat();
            let q = [opens, slips, -slips, 0.0].repeat(2);
            let solution = lemke(&m, &q).expect("nothing presses");
            assert!(solution.residual <= 1e-12, "{solution:?}");
            assert!(solution.z.iter().all(|z| *z <= 1e-12), "{solution:?}");
        }
    }

    #[test]
    fn what_has_no_solution_is_not_solved() {
        assert_eq!(lemke(&[-1.0], &[-1.0]), Err(Unsolved));
    }
}
