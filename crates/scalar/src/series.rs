//! Arithmetic for every Taylor series of a motion: sums of products over orders, and the linear system at each order.
//!
//! The interpreter of series and compiled machines both call it, so that their numbers have the same bits. All of it
//! computes in registers `N` and stores numbers as `N::Stored`.

use crate::Scalar;

/// With more unknowns the matrix is not inverted, but solved by substitution: an inverse takes n³ operations a step, and
/// shortens the dependency chain at each order.
const MOST_INVERTED: usize = 24;

/// `L` pairs of lists of coefficients that are multiplied with each other.
///
/// `Σ aⱼ b₍k+2−j₎` over `2 ≤ j ≤ k`. The newest coefficients are not among these terms but are added afterwards, so that the sum can run while the
/// last order is still being solved for.
///
/// A row of `a` and of `b` holds what [`keep`] wrote for an order: a number for each pair or, with [`PAIRS_AT_ONCE`](Scalar::PAIRS_AT_ONCE), one
/// for each list, at the given index of the pair. Sums beyond those of the pairs are meaningless.
#[inline(always)]
pub fn sweep<N: Scalar, const P: usize, const L: usize>(
    [a, b]: [&[[N::Stored; P]]; 2],
    k: usize,
    places: [&[usize; L]; 2],
) -> [N; P] {
    const { assert!(L <= P && L <= 24, "a pack of lists") };
    let (Some(a), Some(b)) = (a.get(2..=k), b.get(2..=k)) else {
        return [N::ZERO; P];
    };
    let mut sums = [N::ZERO; P];
    // The starts of groups are literals, so the compiler knows all indices, and loads each list once.
    macro_rules! groups {
        ($size:literal: $($start:literal)*) => {{$(
            if const { $start < L } {
                convolve_some::<N, $size, P, L>([a, b], $start, places, &mut sums);
            }
        )*}};
    }
    match N::PAIRS_AT_ONCE {
        0 => return N::convolve_all(a, b),
        1..8 => groups!(4: 0 4 8 12 16 20),
        _ => groups!(8: 0 8 16),
    }
    sums
}

/// Stores the coefficients of an order for [`sweep`]: `numbers` has one for each of `L` pairs, which is stored at the index of its list.
#[inline(always)]
pub fn keep<N: Scalar, const P: usize, const L: usize>(
    rows: &mut [[N::Stored; P]],
    order: usize,
    numbers: [N::Stored; P],
    places: &[usize; L],
) {
    let Some(row) = rows.get_mut(order) else {
        return;
    };
    if N::PAIRS_AT_ONCE == 0 {
        N::store_all(row, numbers);
        return;
    }
    for p in 0..L {
        row[places[p]] = numbers[p];
    }
}

/// `Σⱼ aⱼ b₍n−1−j₎` for `P` pairs of lists of `n` numbers each, stored side by side.
///
/// Summed from the middle outwards, in two independent sums, one towards either end: both ends of the lists were computed last, in
/// one factor or the other, so the sums begin with the oldest numbers.
#[inline(always)]
pub fn convolve_all<N: Scalar, const P: usize>(
    a: &[[N::Stored; P]],
    b: &[[N::Stored; P]],
) -> [N; P] {
    let count = a.len().min(b.len());
    let half = count / 2;
    let (a, b) = (&a[..count], &b[..count]);
    let (mut down, mut up) = ([N::ZERO; P], [N::ZERO; P]);
    if count % 2 == 1 {
        for p in 0..P {
            down[p] = N::load(a[half][p]).mul_add(N::load(b[half][p]), N::ZERO);
        }
    }
    // Indices, since functions of iterators would be called, for which all registers would be saved.
    for step in 0..half {
        let [low, high] = [half - 1 - step, count - half + step];
        for p in 0..P {
            down[p] = N::load(a[low][p]).mul_add(N::load(b[high][p]), down[p]);
            up[p] = N::load(a[high][p]).mul_add(N::load(b[low][p]), up[p]);
        }
    }
    for p in 0..P {
        down[p] = down[p] + up[p];
    }
    down
}

/// [`convolve_all`] for up to `G` pairs from `start` on, with lists at the given indices: the same arithmetic.
#[inline(always)]
fn convolve_some<N: Scalar, const G: usize, const P: usize, const L: usize>(
    [a, b]: [&[[N::Stored; P]]; 2],
    start: usize,
    [of_a, of_b]: [&[usize; L]; 2],
    sums: &mut [N; P],
) {
    let count = a.len().min(b.len());
    let half = count / 2;
    let (a, b) = (&a[..count], &b[..count]);
    let (mut down, mut up) = ([N::ZERO; G], [N::ZERO; G]);
    let end = G.min(L - start);
    if count % 2 == 1 {
        for p in 0..end {
            let [i, k] = [of_a[start + p], of_b[start + p]];
            down[p] = N::load(a[half][i]).mul_add(N::load(b[half][k]), N::ZERO);
        }
    }
    for step in 0..half {
        let [low, high] = [half - 1 - step, count - half + step];
        let ([low_a, high_a], [low_b, high_b]) = ([&a[low], &a[high]], [&b[low], &b[high]]);
        for p in 0..end {
            let [i, k] = [of_a[start + p], of_b[start + p]];
            down[p] = N::load(low_a[i]).mul_add(N::load(high_b[k]), down[p]);
            up[p] = N::load(high_a[i]).mul_add(N::load(low_b[k]), up[p]);
        }
    }
    for p in 0..end {
        sums[start + p] = down[p] + up[p];
    }
}

/// A pivot that is zero up to round-off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vanished<N> {
    /// Its row.
    pub row: usize,
    /// The value of the pivot.
    pub pivot: N,
    /// The size of the terms whose sum it is.
    pub scale: N,
}

/// Checks that the pivot of a row, which is negative if the row is that of a constraint, is more than this part of the size of the terms whose sum it is.
#[inline(always)]
fn check_pivot<N: Scalar>(
    row: usize,
    is_constraint: bool,
    [pivot, scale]: [N; 2],
    tolerance: N,
) -> Result<(), Vanished<N>> {
    let pivot = if is_constraint { -pivot } else { pivot };
    if pivot.exceeds(scale * tolerance) {
        return Ok(());
    }
    Err(Vanished { row, pivot, scale })
}

/// Factors a symmetric matrix of `n` rows, given by its lower triangle, for [`solve`]. Rows from `held` on are those of
/// constraints, whose pivots are negative.
///
/// # Errors
/// If a pivot vanishes.
#[inline(always)]
pub fn factor<N: Scalar>(
    n: usize,
    held: usize,
    matrix: &mut [N::Stored],
) -> Result<(), Vanished<N>> {
    // A constant, so that for other numbers builds without optimization contain none of these functions either.
    if const { N::PAIRS_AT_ONCE == 0 && size_of::<N::Stored>() == size_of::<f64>() } {
        match n {
            9..=12 => return factor_in_registers::<N, 12>(n, held, matrix),
            13..=16 => return factor_in_registers::<N, 16>(n, held, matrix),
            17..=MOST_INVERTED => {
                return factor_in_registers::<N, MOST_INVERTED>(n, held, matrix);
            }
            _ => {}
        }
    }
    let m = &mut matrix[..n * n];
    let tolerance = N::from_f64(n as f64 * f64::EPSILON);
    for i in 0..n {
        let diagonal = N::load(m[i * n + i]);
        let is_constraint = i >= held;
        let (mut pivot, mut scale) = (diagonal, diagonal);
        for j in 0..i {
            // Holds L D until the row is complete.
            let mut entry = N::load(m[i * n + j]);
            for k in 0..j {
                let other = N::load(m[j * n + k]);
                entry = N::load(m[i * n + k]).neg_mul_add(other, entry);
            }
            m[i * n + j] = entry.store();
        }
        for j in 0..i {
            let entry = N::load(m[i * n + j]);
            let scaled = entry * N::load(m[j * n + j]);
            pivot = entry.neg_mul_add(scaled, pivot);
            if is_constraint && j < held {
                scale = entry.mul_add(scaled, scale);
            }
            m[i * n + j] = scaled.store();
        }
        check_pivot(i, is_constraint, [pivot, scale], tolerance)?;
        m[i * n + i] = (N::ONE / pivot).store();
    }
    if n <= MOST_INVERTED {
        invert::<N>(n, m);
    }
    Ok(())
}

/// Computes the transpose of the inverse of a matrix that need not be symmetric and whose result [is an inverse](is_inverse), in place, for [`solve`]. Rows from `held` on are
/// those of constraints and contacts, whose pivots are negative.
///
/// Gauss–Jordan elimination without exchange of rows: those before `held` are positive definite, and each contact that does not jam keeps its sign.
///
/// # Errors
/// If a pivot vanishes, or has the other sign.
///
/// # Panics
/// If the matrix has too many rows.
#[inline(always)]
pub fn invert_unsymmetric<N: Scalar>(
    n: usize,
    held: usize,
    matrix: &mut [N::Stored],
) -> Result<(), Vanished<N>> {
    let m = &mut matrix[..n * n];
    let tolerance = N::from_f64(n as f64 * f64::EPSILON);
    // The sizes of the terms whose sums pivots are.
    let mut scales = [N::ZERO; MOST_INVERTED];
    for (i, scale) in scales.iter_mut().enumerate().take(n) {
        *scale = N::load(m[i * n + i]).abs();
    }
    for k in 0..n {
        let pivot = N::load(m[k * n + k]);
        check_pivot(k, k >= held, [pivot, scales[k]], tolerance)?;
        let reciprocal = N::ONE / pivot;
        for j in 0..n {
            if j != k {
                m[k * n + j] = (N::load(m[k * n + j]) * reciprocal).store();
            }
        }
        m[k * n + k] = reciprocal.store();
        for i in 0..n {
            if i == k {
                continue;
            }
            let factor = N::load(m[i * n + k]);
            if k < held && i >= held {
                scales[i] = scales[i] + (factor * N::load(m[k * n + i])).abs();
            }
            for j in 0..n {
                if j != k {
                    let row = N::load(m[k * n + j]);
                    let entry = factor.neg_mul_add(row, N::load(m[i * n + j]));
                    m[i * n + j] = entry.store();
                }
            }
            m[i * n + k] = (-(factor * reciprocal)).store();
        }
    }
    for i in 0..n {
        for j in 0..i {
            m.swap(i * n + j, j * n + i);
        }
    }
    Ok(())
}

/// Computes the whole inverse, `L⁻ᵀ D⁻¹ L⁻¹`, from L and the reciprocals of D, in place.
#[inline(always)]
fn invert<N: Scalar>(n: usize, m: &mut [N::Stored]) {
    // L⁻¹ row by row, below the diagonal.
    for i in 1..n {
        for j in 0..i {
            let mut sum = -N::load(m[i * n + j]);
            for k in j + 1..i {
                sum = N::load(m[i * n + k]).neg_mul_add(N::load(m[k * n + j]), sum);
            }
            // Elements of this row to the right are no longer read by those to the left.
            m[j * n + i] = sum.store();
        }
        for j in 0..i {
            m[i * n + j] = m[j * n + i];
        }
    }
    // Σ over rows k of L⁻¹: element (i, j) reads rows from max(i, j) on, so the first rows may be overwritten first.
    for i in 0..n {
        for j in 0..=i {
            let below = |k: usize, j: usize| {
                if k == j {
                    N::ONE
                } else {
                    N::load(m[k * n + j])
                }
            };
            let mut sum = N::ZERO;
            for k in i..n {
                let pivot = N::load(m[k * n + k]);
                sum = (below(k, i) * pivot).mul_add(below(k, j), sum);
            }
            m[j * n + i] = sum.store();
        }
    }
    for i in 0..n {
        for j in 0..i {
            m[i * n + j] = m[j * n + i];
        }
    }
}

/// The number of columns that are computed together.
const COLUMNS: usize = 4;

/// [`factor`] with the inverse for a matrix with at most `P` rows, a multiple of [`COLUMNS`]: each number is the result of the same operations in the same order,
/// but rows are computed along registers. 16 rows take half as long. The loops over registers are written with `while`: the compiler puts the numbers of an
/// iterator with steps into no register.
#[inline(always)]
fn factor_in_registers<N: Scalar, const P: usize>(
    n: usize,
    held: usize,
    matrix: &mut [N::Stored],
) -> Result<(), Vanished<N>> {
    const { assert!(P.is_multiple_of(COLUMNS), "whole registers") };
    let zero = N::ZERO.store();
    let matrix = &mut matrix[..n * n];
    let tolerance = N::from_f64(n as f64 * f64::EPSILON);
    // The rows of the upper triangle after elimination, L row by row, and the reciprocals of D.
    let (mut left, mut lower, mut over) = ([[zero; P]; P], [[zero; P]; P], [zero; P]);
    let mut scales = [zero; P];
    for i in 0..n {
        for j in 0..=i {
            left[j][i] = matrix[i * n + j];
        }
        scales[i] = left[i][i];
    }
    for k in 0..n {
        let row = left[k];
        let pivot = N::load(row[k]);
        check_pivot(k, k >= held, [pivot, N::load(scales[k])], tolerance)?;
        let reciprocal = N::ONE / pivot;
        over[k] = reciprocal.store();
        let mut scaled = [zero; P];
        for j in 0..P {
            scaled[j] = (N::load(row[j]) * reciprocal).store();
        }
        for i in k + 1..n {
            let factor = N::load(scaled[i]);
            if k < held && i >= held {
                let sum = N::load(row[i]).mul_add(factor, N::load(scales[i]));
                scales[i] = sum.store();
            }
            lower[i][k] = scaled[i];
            let to = &mut left[i];
            // Columns before the diagonal are not read.
            let mut start = i / COLUMNS * COLUMNS;
            while start < P {
                for j in start..start + COLUMNS {
                    let entry = N::load(row[j]).neg_mul_add(factor, N::load(to[j]));
                    to[j] = entry.store();
                }
                start += COLUMNS;
            }
        }
    }
    invert_in_registers::<N, P>(n, &mut lower);
    for i in 0..n {
        // Σ over rows k of L⁻¹.
        let mut sums = [zero; P];
        for k in i..n {
            let row = &lower[k];
            let factor = N::load(row[i]) * N::load(over[k]);
            let mut start = 0;
            while start <= i {
                for j in start..start + COLUMNS {
                    let sum = factor.mul_add(N::load(row[j]), N::load(sums[j]));
                    sums[j] = sum.store();
                }
                start += COLUMNS;
            }
        }
        for j in 0..=i {
            matrix[i * n + j] = sums[j];
            matrix[j * n + i] = sums[j];
        }
    }
    Ok(())
}

/// Computes L⁻¹, with its diagonal, in place of L without it.
#[inline(always)]
fn invert_in_registers<N: Scalar, const P: usize>(n: usize, lower: &mut [[N::Stored; P]; P]) {
    for i in 0..n {
        let of = lower[i];
        let mut row = of;
        for x in &mut row {
            *x = (-N::load(*x)).store();
        }
        for k in 1..i {
            let (above, factor) = (&lower[k], N::load(of[k]));
            // Beyond its diagonal a row above is 0, except for the diagonal itself, which is set at the end.
            let mut start = 0;
            while start < k {
                for j in start..start + COLUMNS {
                    let x = factor.neg_mul_add(N::load(above[j]), N::load(row[j]));
                    row[j] = x.store();
                }
                start += COLUMNS;
            }
        }
        lower[i] = row;
    }
    for (i, row) in lower.iter_mut().enumerate().take(n) {
        row[i] = N::ONE.store();
    }
}

/// Up to this number of unknowns, a solution is a product with the inverse in which each unknown is one sum.
pub const MOST_IN_ONE_SUM: usize = 3;

/// Whether the result of [`factor`] for this number of unknowns is an inverse.
pub const fn is_inverse(unknowns: usize) -> bool {
    unknowns <= MOST_INVERTED
}

/// [`solve`] for a number of unknowns that is known when it is compiled and whose matrix [is an inverse](is_inverse): the same
/// arithmetic, in registers.
///
/// Each unknown is two sums, of the columns with even and with odd indices, so that the dependency chain is half as long.
#[inline(always)]
pub fn solved<N: Scalar, const K: usize>(inverse: &[N::Stored], right: [N; K]) -> [N; K] {
    let m = &inverse[..K * K];
    let (mut even, mut odd) = ([N::ZERO; K], [N::ZERO; K]);
    for j in 0..K {
        let sums = if j % 2 == 0 { &mut even } else { &mut odd };
        for i in 0..K {
            sums[i] = N::load(m[j * K + i]).mul_add(right[j], sums[i]);
        }
    }
    for i in 0..K {
        even[i] = even[i] + odd[i];
    }
    even
}

/// Solves for `x`, which initially holds the right-hand side, with the result of [`factor`]; `scratch` has the same length.
#[inline(always)]
pub fn solve<N: Scalar>(
    n: usize,
    matrix: &[N::Stored],
    x: &mut [N::Stored],
    scratch: &mut [N::Stored],
) {
    let (m, x, scratch) = (&matrix[..n * n], &mut x[..n], &mut scratch[..n]);
    if n <= MOST_INVERTED {
        for i in 0..n {
            let (mut even, mut odd) = (N::ZERO, N::ZERO);
            for j in 0..n {
                let (element, known) = (N::load(m[j * n + i]), N::load(x[j]));
                if n <= MOST_IN_ONE_SUM || j % 2 == 0 {
                    even = element.mul_add(known, even);
                } else {
                    odd = element.mul_add(known, odd);
                }
            }
            let sum = if n <= MOST_IN_ONE_SUM {
                even
            } else {
                even + odd
            };
            scratch[i] = sum.store();
        }
        x.copy_from_slice(scratch);
        return;
    }
    for i in 0..n {
        let mut sum = N::load(x[i]);
        for j in 0..i {
            sum = N::load(m[i * n + j]).neg_mul_add(N::load(x[j]), sum);
        }
        x[i] = sum.store();
    }
    for i in (0..n).rev() {
        let mut sum = N::load(x[i]) * N::load(m[i * n + i]);
        for j in i + 1..n {
            sum = N::load(m[j * n + i]).neg_mul_add(N::load(x[j]), sum);
        }
        x[i] = sum.store();
    }
}

/// A matrix, column by column, times a vector.
#[inline(always)]
pub fn apply<N: Scalar, const R: usize, const C: usize>(
    columns: &[[N::Stored; R]; C],
    x: &[N; C],
) -> [N; R] {
    let mut sums = [N::ZERO; R];
    for c in 0..C {
        let column = &columns[c];
        for r in 0..R {
            sums[r] = N::load(column[r]).mul_add(x[c], sums[r]);
        }
    }
    sums
}
