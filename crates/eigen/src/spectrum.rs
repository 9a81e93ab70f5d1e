//! The eigenvalues and shapes of `ẍ = K x + C ẋ`, and of coordinates that follow such motions by constraints on rates.
//!
//! First the causes of lost digits are removed. Uncoupled coordinates are treated separately. Time and coordinates are scaled.
//! Directions without restoring force, `K z = 0`, are eigenvectors of 0 and are removed from the matrix, in which they would form
//! Jordan blocks whose eigenvalues come out as ±√ε. The eigenvalues of the remaining matrix are computed in twice the digits, so
//! that a slow decay is as accurate as a fast one. Each gets a bound on the effect of rounding in K and C, from its left and right
//! eigenvectors (G. H. Golub and C. F. Van Loan, *Matrix Computations*, 4th ed. 2013, section 7.2.2).

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, DMatrix, DVector};

use crate::precise::{self, Pair};
use crate::rank;

type Vector = DVector<Complex<f64>>;

/// One mode `x(t) = Re(shape e^{λt})`; of a conjugate pair the one with positive imaginary part.
#[derive(Clone)]
pub struct Mode {
    /// λ, in 1/s: set to exactly real, imaginary or zero where it is so within its error.
    pub lambda: Complex<f64>,
    /// Bound on the error of λ, in 1/s. For a free mode: anything slower cannot be distinguished from it.
    pub error: f64,
    /// The amplitudes of the coordinates, the largest of them 1.
    pub shape: Vec<Complex<f64>>,
}

impl Mode {
    /// The kind: `oscillation`, `growing oscillation`, `decaying`, `growing` or `free`.
    pub fn kind(&self) -> &'static str {
        let Complex { re, im } = self.lambda;
        match (re > 0.0, re < 0.0, im > 0.0) {
            (false, false, false) => "free",
            (true, _, true) => "growing oscillation",
            (true, _, false) => "growing",
            (_, true, false) => "decaying",
            _ => "oscillation",
        }
    }
}

/// The damping ratio of an oscillation, `−Re λ/|λ|`; `None` for a mode that does not oscillate.
pub fn damping(lambda: Complex<f64>) -> Option<f64> {
    (lambda.im != 0.0).then(|| 0.0 - lambda.re / lambda.norm())
}

/// All modes about an equilibrium.
#[derive(Clone, Default)]
pub struct Modes {
    /// Slow ones first.
    pub modes: Vec<Mode>,
    /// The number of independent directions to other equilibria.
    pub free: usize,
    /// The number of independent motions at other constant rates.
    pub drifts: usize,
    /// How many further modes have a λ that is 0 within round-off, although no free direction accounts for them.
    pub lost: usize,
    /// These are slower than this, in 1/s.
    pub lost_below: f64,
}

/// `ẍ = K x + C ẋ` for coordinates x₁ that may move, and `ẏ = P x + B ẋ₁` for those that only follow, with x = (x₁,
/// y) on the right.
pub struct Linear {
    /// K, with a column for each coordinate.
    pub k: DMatrix<f64>,
    /// C.
    pub c: DMatrix<f64>,
    /// P, with a column for each coordinate.
    pub p: DMatrix<f64>,
    /// B.
    pub b: DMatrix<f64>,
    /// Bounds on the effect of rounding on each entry of K over P.
    pub k_bounds: DMatrix<f64>,
    /// Bounds on the effect of rounding on each entry of C.
    pub c_bounds: DMatrix<f64>,
}

impl Linear {
    /// A system without following coordinates, with exact matrices.
    #[cfg(test)]
    fn of(k: &DMatrix<f64>, c: &DMatrix<f64>) -> Linear {
        let n = k.nrows();
        Linear {
            k: k.clone(),
            c: c.clone(),
            p: DMatrix::zeros(0, n),
            b: DMatrix::zeros(0, n),
            k_bounds: DMatrix::zeros(n, n),
            c_bounds: DMatrix::zeros(n, n),
        }
    }

    /// The number of coordinates, and the number of those that may move.
    fn len(&self) -> (usize, usize) {
        (self.k.ncols(), self.c.ncols())
    }

    /// The absolute values of all entries, each row divided by the number given for K, C, and P.
    fn sizes(&self, [from_k, from_c, from_p]: [f64; 3]) -> DMatrix<f64> {
        let (n, moving) = self.len();
        DMatrix::from_fn(n, n, |i, j| {
            if i < moving {
                let rates = if j < moving {
                    self.c[(i, j)].abs() / from_c
                } else {
                    0.0
                };
                self.k[(i, j)].abs() / from_k + rates
            } else {
                let i = i - moving;
                let rates = if j < moving {
                    self.b[(i, j)].abs()
                } else {
                    0.0
                };
                self.p[(i, j)].abs() / from_p + rates
            }
        })
    }

    /// K over P.
    fn by_places(&self) -> DMatrix<f64> {
        let (n, moving) = self.len();
        DMatrix::from_fn(n, n, |i, j| {
            if i < moving {
                self.k[(i, j)]
            } else {
                self.p[(i - moving, j)]
            }
        })
    }

    /// 1 over B: the rates of all coordinates for those of the moving ones.
    fn along(&self) -> DMatrix<f64> {
        let (n, moving) = self.len();
        DMatrix::from_fn(n, moving, |i, j| {
            if i < moving {
                f64::from(u8::from(i == j))
            } else {
                self.b[(i - moving, j)]
            }
        })
    }

    /// 0 over P: the rates of followers by coordinates.
    fn driven(&self) -> DMatrix<f64> {
        let (n, moving) = self.len();
        DMatrix::from_fn(n, n, |i, j| {
            if i < moving {
                0.0
            } else {
                self.p[(i - moving, j)]
            }
        })
    }

    /// The subsystem of some coordinates, in ascending order.
    fn part(&self, part: &[usize]) -> Linear {
        let (_, moving) = self.len();
        let split = part.partition_point(|i| *i < moving);
        let (first, rest) = part.split_at(split);
        let rest: Vec<usize> = rest.iter().map(|i| i - moving).collect();
        let pick = |m: &DMatrix<f64>, rows: &[usize], columns: &[usize]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| m[(rows[i], columns[j])])
        };
        Linear {
            k: pick(&self.k, first, part),
            c: pick(&self.c, first, first),
            p: pick(&self.p, &rest, part),
            b: pick(&self.b, &rest, first),
            k_bounds: pick(&self.k_bounds, part, part),
            c_bounds: pick(&self.c_bounds, first, first),
        }
    }
}

/// The modes; `None` where the iterations do not converge.
pub fn modes(linear: &Linear) -> Option<Modes> {
    let (n, _) = linear.len();
    let mut all = Modes::default();
    for part in rank::parts(&linear.sizes([1.0; 3])) {
        let modes = connected(linear.part(&part))?;
        all.free += modes.free;
        all.drifts += modes.drifts;
        all.lost += modes.lost;
        all.lost_below = all.lost_below.max(modes.lost_below);
        all.modes.extend(modes.modes.into_iter().map(|mode| {
            let mut shape = vec![Complex::new(0.0, 0.0); n];
            for (place, x) in part.iter().zip(&mode.shape) {
                shape[*place] = *x;
            }
            Mode { shape, ..mode }
        }));
    }
    all.modes.sort_by(|a, b| {
        let key = |mode: &Mode| (mode.lambda.im, mode.lambda.norm(), mode.lambda.re);
        let ((a1, a2, a3), (b1, b2, b3)) = (key(a), key(b));
        a1.total_cmp(&b1)
            .then(a2.total_cmp(&b2))
            .then(a3.total_cmp(&b3))
    });
    Some(all)
}

/// The modes of one coupled set of coordinates, in any order.
fn connected(linear: Linear) -> Option<Modes> {
    let Scaled {
        linear,
        scales,
        rate,
    } = Scaled::of(linear);
    let Split {
        free,
        count,
        bound,
        drifts,
    } = Split::of(&linear)?;
    let [a, bounds] = of_first_order(&linear, &bound);
    let mut modes = Modes {
        free: count,
        drifts,
        ..Modes::default()
    };
    for Free { direction, slowest } in free {
        modes.modes.push(Mode {
            lambda: Complex::new(0.0, 0.0),
            error: slowest * rate,
            shape: shape(&direction.map(|x| Complex::new(x, 0.0)), &scales),
        });
    }
    let mut zeros = 0;
    // The entries of K and C are typically sums of as many terms as there are coordinates.
    let roundings = 8.0 * a.nrows() as f64;
    for pair in precise::pairs(&a, &(bounds / roundings))? {
        let Pair {
            lambda: raw, right, ..
        } = &pair;
        let error = roundings * pair.error;
        let settle = |x: f64| if x.abs() <= error { 0.0 } else { x };
        let lambda = Complex::new(settle(raw.re), settle(raw.im));
        // A pair that is real within its error is a double eigenvalue.
        let times = if raw.im > 0.0 && lambda.im == 0.0 {
            2
        } else {
            1
        };
        if lambda == Complex::new(0.0, 0.0) {
            zeros += times;
            // A drift along a direction that is counted already.
            if zeros > drifts {
                modes.lost = zeros - drifts;
                modes.lost_below = modes.lost_below.max(error * rate);
            }
            continue;
        }
        for _ in 0..times {
            let amplitudes = amplitudes(&linear, *raw, right, &bound);
            modes.modes.push(Mode {
                lambda: lambda * rate,
                error: error * rate,
                shape: shape(&amplitudes, &scales),
            });
        }
    }
    Some(modes)
}

/// The matrix of the equations of first order, with bounds on its entries. With `x = Σ z a + W w`, `v = ẋ₁`:
/// `w' = Wᵀ P W w + Wᵀ B v`, `v' = K W w + C v`.
fn of_first_order(linear: &Linear, bound: &DMatrix<f64>) -> [DMatrix<f64>; 2] {
    let (m, (_, n)) = (bound.ncols(), linear.len());
    let assembled = |p: &DMatrix<f64>,
                     b: &DMatrix<f64>,
                     k: &DMatrix<f64>,
                     c: &DMatrix<f64>,
                     w: &DMatrix<f64>| {
        let mut a = DMatrix::zeros(m + n, m + n);
        a.view_mut((0, 0), (m, m))
            .copy_from(&(w.transpose() * p * w));
        a.view_mut((0, m), (m, n)).copy_from(&(w.transpose() * b));
        a.view_mut((m, 0), (n, m)).copy_from(&(k * w));
        a.view_mut((m, m), (n, n)).copy_from(c);
        a
    };
    let along = linear.along();
    let a = assembled(&linear.driven(), &along, &linear.k, &linear.c, bound);
    let k_bounds = linear.k_bounds.rows(0, n).into_owned();
    let mut p_bounds = linear.k_bounds.clone();
    p_bounds.rows_mut(0, n).fill(0.0);
    let none = DMatrix::zeros(along.nrows(), n);
    let bounds = assembled(&p_bounds, &none, &k_bounds, &linear.c_bounds, &bound.abs());
    [a, bounds]
}

/// The amplitudes of all coordinates, up to a factor, from an eigenvector `(w, v)`: those of moving coordinates are
/// `v/λ`, and followers obey `(λ − P) y = P x₁ + B v`.
fn amplitudes(
    linear: &Linear,
    lambda: Complex<f64>,
    right: &Vector,
    bound: &DMatrix<f64>,
) -> Vector {
    let (n, moving) = linear.len();
    let m = bound.ncols();
    let rates = right.rows(m, moving).into_owned();
    if n == moving {
        return rates;
    }
    let complex = |m: DMatrix<f64>| m.map(|x| Complex::new(x, 0.0));
    let rate_dependent = n - moving;
    let own = complex(linear.p.columns(moving, rate_dependent).into_owned());
    let from_places = complex(linear.p.columns(0, moving).into_owned()) * &rates;
    // The equation multiplied by λ.
    let pull = from_places + complex(linear.b.clone()) * &rates * lambda;
    let matrix = DMatrix::from_diagonal_element(rate_dependent, rate_dependent, lambda) - own;
    let solved = matrix.lu().solve(&pull);
    match solved.filter(|y| y.iter().all(|y| y.is_finite()) && rates.norm() > 1e-9 * right.norm()) {
        Some(y) => DVector::from_fn(n, |i, _| if i < moving { rates[i] } else { y[i - moving] }),
        // The followers move on their own.
        None => complex(bound.clone()) * right.rows(0, m),
    }
}

/// The equations with coordinates and time scaled such that no entry is large only because of its unit.
struct Scaled {
    linear: Linear,
    /// x = scales · scaled x, powers of 2.
    scales: DVector<f64>,
    /// The unit of scaled time: about one radian of the fastest oscillation, as a rate in 1/s.
    rate: f64,
}

impl Scaled {
    fn of(mut linear: Linear) -> Scaled {
        let (n, moving) = linear.len();
        let mut scales = DVector::from_element(n, 1.0);
        // Before balancing, the largest entry does not show how fast the machine is: a force on an angle may be
        // arbitrarily large in a large unit of length. So K and C are balanced first as if they were equally large, then
        // by their actual sizes.
        let largest = |m: &DMatrix<f64>| if m.is_empty() { 0.0 } else { m.amax() };
        let (mut from_k, mut from_c) = (largest(&linear.k), largest(&linear.c));
        let mut from_p = largest(&linear.p);
        for _ in 0..2 {
            let sizes = [from_k, from_c, from_p].map(|size| if size > 0.0 { size } else { 1.0 });
            let step = balance_parlett_reinsch(&mut linear.sizes(sizes));
            let balance = |m: &mut DMatrix<f64>, row: usize| {
                for ((i, j), x) in indices(m) {
                    m[(i, j)] = x * step[j] / step[i + row];
                }
            };
            balance(&mut linear.k, 0);
            balance(&mut linear.c, 0);
            balance(&mut linear.p, moving);
            balance(&mut linear.b, moving);
            balance(&mut linear.k_bounds, 0);
            balance(&mut linear.c_bounds, 0);
            scales.component_mul_assign(&step);
            let rate = largest(&linear.k).sqrt().max(largest(&linear.c));
            let rate = rate.max(largest(&linear.p));
            (from_k, from_c, from_p) = (rate * rate, rate, rate);
        }
        let rate = if from_c > 0.0 { from_c } else { 1.0 };
        for _ in 0..2 {
            linear.k /= rate;
            linear.k_bounds.rows_mut(0, moving).apply(|x| *x /= rate);
        }
        linear
            .k_bounds
            .rows_mut(moving, n - moving)
            .apply(|x| *x /= rate);
        linear.c /= rate;
        linear.c_bounds /= rate;
        linear.p /= rate;
        Scaled {
            linear,
            scales,
            rate,
        }
    }
}

/// All entries with their indices.
fn indices(m: &DMatrix<f64>) -> Vec<((usize, usize), f64)> {
    let places = (0..m.nrows()).flat_map(|i| (0..m.ncols()).map(move |j| (i, j)));
    places.map(|place| (place, m[place])).collect()
}

/// A direction without restoring force.
struct Free {
    direction: DVector<f64>,
    /// Rounding may hide a restoring force; the motion is then slower than this.
    slowest: f64,
}

/// Directions along which a displacement persists, and their complement.
///
/// These are the directions that K and P map to zero. Where coordinates follow, those that P maps into the
/// directions found so far are added, such as a heading that lets a position change steadily: the staircase of the
/// Jordan blocks of 0.
struct Split {
    /// Those of them along which the machine may move, each with as few coordinates as possible.
    free: Vec<Free>,
    /// How many there are in total.
    count: usize,
    /// An orthonormal basis of the complement.
    bound: DMatrix<f64>,
    /// The number of independent motions at other constant rates, which nothing brakes.
    drifts: usize,
}

impl Split {
    fn of(linear: &Linear) -> Option<Split> {
        let (n, moving) = linear.len();
        let by_places = linear.by_places();
        let (free, bound): (Vec<_>, Vec<_>) =
            rank::directions_beyond(&by_places, &linear.k_bounds)?
                .into_iter()
                .partition(rank::Direction::is_free);
        let bound = if free.is_empty() {
            DMatrix::identity(n, n) // this is exact
        } else {
            let rights: Vec<DVector<f64>> = bound.into_iter().map(|one| one.right).collect();
            linear.without_driven(columns(n, &rights))?
        };
        // The directions, in moving coordinates, along which the machine may move.
        let along = linear.along();
        let may: Vec<DVector<f64>> = if moving == n {
            free.iter()
                .map(|direction| direction.right.clone())
                .collect()
        } else {
            let across = bound.transpose() * &along;
            null_space(&across, rank::tolerance(n) * along.norm())?[0].clone()
        };
        let drifts = if linear.is_driven() {
            linear.balanced_rates(&bound)?
        } else {
            let lefts: Vec<DVector<f64>> = free.iter().map(|one| one.left.clone()).collect();
            linear.unbraked(&columns(n, &lefts), &columns(moving, &may))?
        };
        let slowest = |z: &DVector<f64>| {
            if (linear.k.abs() * z.abs()).iter().all(|x| *x == 0.0) {
                return 0.0;
            }
            let overlaps = |d: &&rank::Direction| d.part.iter().any(|&i| z[i] != 0.0);
            let hidden = free.iter().filter(overlaps).map(|d| d.rounding);
            hidden.fold(0.0, f64::max).sqrt()
        };
        let free = sparse(may).into_iter().map(|direction| {
            let direction = &along * direction;
            Free {
                slowest: slowest(&direction),
                direction,
            }
        });
        Some(Split {
            free: free.collect(),
            count: n - bound.ncols(),
            bound,
            drifts,
        })
    }
}

impl Linear {
    /// Whether coordinates follow others, at rates that depend on these.
    fn is_driven(&self) -> bool {
        self.p.iter().any(|x| *x != 0.0)
    }

    /// A basis without the directions that P maps into the complement of the basis and K to zero, repeated until there are none.
    fn without_driven(&self, mut bound: DMatrix<f64>) -> Option<DMatrix<f64>> {
        let (n, _) = self.len();
        while self.is_driven() && bound.ncols() > 0 {
            let rates = bound.transpose() * self.driven() * &bound;
            let left = stacked(&rates, &(&self.k * &bound));
            let [nothing, rest] = null_space(&left, rank::tolerance(n) * left.norm())?;
            if nothing.is_empty() {
                break;
            }
            bound = &bound * columns(bound.ncols(), &rest);
        }
        Some(bound)
    }

    /// The number of independent constant rates `s` that some displacement `w` balances, `P w + B s = 0`, `K w + C s = 0`. Only the
    /// part outside the range of `w` restricts `s`.
    fn balanced_rates(&self, bound: &DMatrix<f64>) -> Option<usize> {
        let (n, _) = self.len();
        let driven = bound.transpose() * self.driven() * bound;
        let by_place = stacked(&driven, &(&self.k * bound));
        let by_rate = stacked(&(bound.transpose() * self.along()), &self.c);
        let [across, _] = null_space(&by_place.transpose(), rank::tolerance(n) * by_place.norm())?;
        let across = columns(by_place.nrows(), &across);
        let projected = across.tr_mul(&by_rate);
        let terms = across.abs().tr_mul(&by_rate.abs());
        Some(null_space(&projected, rank::tolerance(n) * terms.norm())?[0].len())
    }

    /// The number of independent motions along the directions `right` that damping does not brake, of a machine without followers.
    fn unbraked(&self, left: &DMatrix<f64>, right: &DMatrix<f64>) -> Option<usize> {
        let (n, moving) = self.len();
        let left = left.rows(0, moving);
        let brakes = left.tr_mul(&(&self.c * right));
        // The size of the terms of the damping.
        let terms = left.abs().tr_mul(&(self.c.abs() * right.abs()));
        let limit = rank::tolerance(n) * terms.norm();
        if brakes.is_empty() {
            return Some(right.ncols());
        }
        let braked = brakes.try_svd(false, false, f64::EPSILON, 10_000)?;
        Some(right.ncols() - braked.rank(limit))
    }
}

/// One matrix above another.
fn stacked(above: &DMatrix<f64>, below: &DMatrix<f64>) -> DMatrix<f64> {
    let (rows, further) = (above.nrows(), below.nrows());
    let mut both = DMatrix::zeros(rows + further, above.ncols());
    both.rows_mut(0, rows).copy_from(above);
    both.rows_mut(rows, further).copy_from(below);
    both
}

fn columns(rows: usize, vectors: &[DVector<f64>]) -> DMatrix<f64> {
    if vectors.is_empty() {
        DMatrix::zeros(rows, 0)
    } else {
        DMatrix::from_columns(vectors)
    }
}

/// Orthonormal vectors that a matrix maps to at most `limit`, and their complement. `None` where the iterations
/// do not converge.
fn null_space(matrix: &DMatrix<f64>, limit: f64) -> Option<[Vec<DVector<f64>>; 2]> {
    let (rows, n) = matrix.shape();
    if n == 0 {
        return Some([Vec::new(), Vec::new()]);
    }
    // Padded with zero rows, so that the decomposition returns all right vectors.
    let mut square = DMatrix::zeros(rows.max(n), n);
    square.rows_mut(0, rows).copy_from(matrix);
    let svd = square.try_svd(false, true, f64::EPSILON, 10_000)?;
    let v_t = svd.v_t?;
    let all = svd.singular_values.iter().enumerate();
    let (nothing, rest): (Vec<_>, Vec<_>) = all.partition(|(_, value)| **value <= limit);
    let vectors = |list: Vec<(usize, &f64)>| {
        let vector = |(i, _): (usize, &f64)| v_t.row(i).transpose();
        list.into_iter().map(vector).collect()
    };
    Some([vectors(nothing), vectors(rest)])
}

/// A basis of the same space with many zeros, by Gauss–Jordan elimination: each pivot coordinate occurs in one vector only.
fn sparse(mut rows: Vec<DVector<f64>>) -> Vec<DVector<f64>> {
    let n = rows.first().map_or(0, DVector::len);
    for i in 0..rows.len() {
        let (row, column) = (i..rows.len())
            .map(|r| (r, rows[r].icamax()))
            .max_by(|a, b| rows[a.0][a.1].abs().total_cmp(&rows[b.0][b.1].abs()))
            .unwrap_or((i, 0));
        rows.swap(i, row);
        let pivot = rows[i].clone() / rows[i][column];
        for (r, other) in rows.iter_mut().enumerate() {
            if r == i {
                *other = pivot.clone();
            } else {
                let factor = other[column];
                *other -= &pivot * factor;
            }
        }
    }
    for row in &mut rows {
        let limit = rank::tolerance(n) * row.amax();
        row.iter_mut()
            .filter(|x| x.abs() <= limit)
            .for_each(|x| *x = 0.0);
    }
    rows.sort_by_key(|row| row.iter().position(|x| *x != 0.0));
    rows
}

/// The amplitudes in the original coordinates, scaled to a largest one of 1.
///
/// Round-off is recognized in the balanced amplitudes: in a large unit a length may be 1e-13 beside an angle of 1
/// and matter as much.
fn shape(balanced: &Vector, scales: &DVector<f64>) -> Vec<Complex<f64>> {
    let largest = |amplitudes: &mut dyn Iterator<Item = Complex<f64>>| {
        amplitudes.map(|x| x.norm()).fold(0.0, f64::max)
    };
    let own = |(x, d): (&Complex<f64>, &f64)| x * *d;
    // Of several amplitudes that are equal within round-off, the first.
    let limit = (1.0 - 1e-9) * largest(&mut balanced.iter().zip(scales).map(own));
    let first = balanced.iter().zip(scales).map(own);
    let unit = first.filter(|x| x.norm() > 0.0).find(|x| x.norm() >= limit);
    let unit = unit.unwrap_or(Complex::new(1.0, 0.0));
    let rounding = 1e-12 * largest(&mut balanced.iter().copied()) / unit.norm();
    let settle = |x: f64| if x.abs() <= rounding { 0.0 } else { x };
    balanced
        .iter()
        .map(|x| x / unit)
        .zip(scales)
        .map(|(x, d)| Complex::new(settle(x.re) * *d, settle(x.im) * *d))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fixed sequence of pseudorandom numbers between −1 and 1.
    fn random(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
        }
    }

    /// Every mode obeys the equation of motion, and the sum of all eigenvalues is the trace of C. The matrices are
    /// random, in units that differ by many powers of ten.
    #[test]
    fn modes_obey_the_equations_that_they_come_from() {
        for seed in 0..40 {
            let mut next = random(seed);
            let n = 1 + seed as usize % 7;
            let units: Vec<f64> = (0..n)
                .map(|i| 10.0_f64.powi(6 * (i as i32 % 3) - 6))
                .collect();
            let mut matrix =
                |size: f64| DMatrix::from_fn(n, n, |i, j| size * next() * units[i] / units[j]);
            let (k, c) = (matrix(1e4), matrix(30.0));
            let modes = modes(&Linear::of(&k, &c)).expect("an end").modes;
            let mut trace = 0.0;
            for Mode { lambda, shape, .. } in &modes {
                trace += if lambda.im > 0.0 {
                    2.0 * lambda.re
                } else {
                    lambda.re
                };
                for i in 0..n {
                    let mut left = lambda * lambda * shape[i];
                    let mut size = left.norm();
                    for j in 0..n {
                        let term = (Complex::new(k[(i, j)], 0.0) + lambda * c[(i, j)]) * shape[j];
                        left -= term;
                        size += term.norm();
                    }
                    // The backward error of a 2n × 2n problem, plus amplitudes that were set to 0 in a shape.
                    // The test goes row by row, since each row has its own unit: the rows of a balanced matrix
                    // are of one size.
                    let bound = rank::tolerance(2 * n) + 1e-12;
                    assert!(left.norm() <= bound * size, "seed {seed}: {left} of {size}");
                }
            }
            assert!(
                (trace - c.trace()).abs() <= 1e-10 * (30.0 * n as f64 + 100.0),
                "seed {seed}: {trace}"
            );
        }
    }

    #[test]
    fn what_nothing_pulls_back_is_free_exactly() {
        // Two masses and a spring, and an uncoupled third mass: 0, 0 and √2.
        let k = DMatrix::from_row_slice(3, 3, &[-1.0, 1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0]);
        let modes = modes(&Linear::of(&k, &DMatrix::zeros(3, 3)))
            .expect("an end")
            .modes;
        let lambdas: Vec<Complex<f64>> = modes.iter().map(|mode| mode.lambda).collect();
        assert_eq!(lambdas[..2], [Complex::new(0.0, 0.0); 2]);
        assert_eq!(lambdas[2].re, 0.0);
        assert!((lambdas[2].im - 2.0_f64.sqrt()).abs() <= 1e-14);
        let real = |mode: &Mode| -> Vec<f64> { mode.shape.iter().map(|x| x.re).collect() };
        assert_eq!(real(&modes[1]), [0.0, 0.0, 1.0]);
        assert!(
            real(&modes[0])
                .iter()
                .zip([1.0, 1.0, 0.0])
                .all(|(x, y)| (x - y).abs() <= 1e-14)
        );
    }

    #[test]
    fn equal_frequencies_have_shapes_of_their_own() {
        let k = DMatrix::from_diagonal_element(3, 3, -4.0);
        let modes = modes(&Linear::of(&k, &DMatrix::zeros(3, 3)))
            .expect("an end")
            .modes;
        assert_eq!(modes.len(), 3);
        let shapes = DMatrix::from_fn(3, 3, |i, j| modes[j].shape[i]);
        assert!(shapes.determinant().norm() > 0.1, "{shapes}");
    }

    /// A double eigenvalue with one eigenvector comes out as two that are √ε apart, with the eigenvector repeated.
    #[test]
    fn critical_damping_is_no_trouble() {
        let k = DMatrix::from_element(1, 1, -9.0);
        let c = DMatrix::from_element(1, 1, -6.0);
        let modes = modes(&Linear::of(&k, &c)).expect("an end").modes;
        for mode in &modes {
            assert!(
                (mode.lambda - Complex::new(-3.0, 0.0)).norm() <= 1e-6,
                "{}",
                mode.lambda
            );
        }
        assert_eq!(modes.len(), 2);
    }
}
