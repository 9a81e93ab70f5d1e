//! Where a machine stays: Newton's method on its accelerations, with their exact derivatives.
//!
//! Steps are damped by the natural monotonicity test: a step is kept if the next one, taken with the same matrix, is shorter
//! (P. Deuflhard, *Newton Methods for Nonlinear Problems*, 2004, section 3.3). It does not see in which units an acceleration
//! is measured. A matrix that is singular (a cart on a rail stays wherever it stands) gives the shortest of all steps.

use lagrangian::interpreted::{InterpretedSystem, Named};
use lagrangian::{Linearize, Singular};
use nalgebra::{DMatrix, DVector};

/// The most steps; Newton's method takes five, and a few more for each radian on the way.
const MOST_STEPS: usize = 200;

/// The most halvings of one step.
const MOST_HALVINGS: usize = 30;

/// A step is as long as this at most, in rad, m, or as a share of the coordinate.
const LONGEST_STEP: f64 = 1.0;

/// Steps end where the next one changes no coordinate by more than this, in rad, m, or as a share of the coordinate: the
/// error after it is about the square of that.
const TOLERANCE: f64 = 1e-10;

/// The share of what its own terms come to that an acceleration may be off zero: a thousand roundings, and the square of
/// [`TOLERANCE`].
const BALANCED: f64 = 1e-12;

/// How the accelerations change with the state.
pub struct Linearized {
    /// The accelerations.
    pub a: DVector<f64>,
    /// Their derivatives by the coordinates.
    pub by_coordinates: DMatrix<f64>,
    /// Their derivatives by the rates.
    pub by_rates: DMatrix<f64>,
}

/// A state in which nothing accelerates.
pub struct Equilibrium {
    /// The coordinates.
    pub q: Vec<f64>,
    /// How accelerations change near it.
    pub linearized: Linearized,
    /// How many steps it took.
    pub steps: usize,
    /// Along how many directions the machine may stand elsewhere as well.
    pub free: usize,
}

/// Why there is none.
pub enum Lost {
    /// The mass matrix is singular on the way.
    Singular(Singular),
    /// An acceleration is not finite on the way, by the index of its coordinate.
    NotFinite(usize),
    /// Nothing that Newton's method can do removes this acceleration.
    Accelerates(usize, f64),
    /// No end was reached.
    NoEnd(usize),
}

/// The accelerations and their derivatives at a state.
pub fn linearize(
    system: &InterpretedSystem,
    t: f64,
    q: &Vec<f64>,
    v: &Vec<f64>,
    u: &Named,
) -> Result<Linearized, Lost> {
    let n = q.len();
    let (mut a, mut by_q, mut by_v) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; n * n]);
    system
        .linearize(t, q, v, u, &mut a, &mut by_q, &mut by_v)
        .map_err(Lost::Singular)?;
    for (index, number) in a.iter().enumerate().chain(
        by_q.iter()
            .chain(&by_v)
            .enumerate()
            .map(|(k, x)| (k % (n * n) / n, x)),
    ) {
        if !number.is_finite() {
            return Err(Lost::NotFinite(index));
        }
    }
    Ok(Linearized {
        a: DVector::from_vec(a),
        by_coordinates: DMatrix::from_row_slice(n, n, &by_q),
        by_rates: DMatrix::from_row_slice(n, n, &by_v),
    })
}

/// The equilibrium that Newton's method reaches from `q`, the rates `v` being held.
///
/// # Errors
/// If there is none on its way.
pub fn find(
    system: &InterpretedSystem,
    q: &[f64],
    v: &Vec<f64>,
    u: &Named,
) -> Result<Equilibrium, Lost> {
    let mut q = q.to_vec();
    let mut here = linearize(system, 0.0, &q, v, u)?;
    for steps in 0..MOST_STEPS {
        let inverse = Inverse::of(&here.by_coordinates);
        let step = inverse.step(&here.a);
        let relative = |x: f64, q: f64| x.abs() / q.abs().max(1.0);
        let longest = |step: &DVector<f64>, q: &[f64]| {
            let shares = step.iter().zip(q).map(|(x, q)| relative(*x, *q));
            shares.fold(0.0, f64::max)
        };
        let longest = longest(&step, &q);
        if longest <= TOLERANCE {
            // The last step is taken too, unless it would leave what is exact already.
            let moved: Vec<f64> = q.iter().zip(step.iter()).map(|(q, x)| q + x).collect();
            let there = linearize(system, 0.0, &moved, v, u)?;
            if there.a.norm() < here.a.norm() {
                (q, here) = (moved, there);
            }
            if let Some((index, left)) = unbalanced(&here, &q, v) {
                return Err(Lost::Accelerates(index, left));
            }
            return Ok(Equilibrium {
                free: q.len() - inverse.rank,
                q,
                linearized: here,
                steps,
            });
        }
        let mut share = (LONGEST_STEP / longest).min(1.0);
        let mut next = None;
        for _ in 0..MOST_HALVINGS {
            let moved: Vec<f64> = q
                .iter()
                .zip(step.iter())
                .map(|(q, x)| q + share * x)
                .collect();
            // A state without accelerations is one step too far.
            if let Ok(there) = linearize(system, 0.0, &moved, v, u)
                && inverse.step(&there.a).norm() <= (1.0 - share / 4.0) * step.norm()
            {
                next = Some((moved, there));
                break;
            }
            share /= 2.0;
        }
        match next {
            Some(next) => (q, here) = next,
            None => {
                return Err(match unbalanced(&here, &q, v) {
                    Some((index, left)) => Lost::Accelerates(index, left),
                    None => Lost::NoEnd(steps),
                });
            }
        }
    }
    Err(Lost::NoEnd(MOST_STEPS))
}

/// Of the accelerations that no step would remove the one that is most off zero, if one is by more than rounding.
fn unbalanced(here: &Linearized, q: &[f64], v: &[f64]) -> Option<(usize, f64)> {
    let left = Inverse::of(&here.by_coordinates).rest(&here.a);
    let scale = |i: usize| -> f64 {
        let by_q = here.by_coordinates.row(i);
        let by_v = here.by_rates.row(i);
        let terms = by_q.iter().zip(q).map(|(k, q)| k.abs() * q.abs().max(1.0));
        terms
            .chain(by_v.iter().zip(v).map(|(c, v)| (c * v).abs()))
            .sum()
    };
    // What comes to nothing in one coordinate may be rounded in another, that is coupled to it.
    let rounding =
        super::spectrum::rank_tolerance(q.len()) * (0..q.len()).map(scale).fold(0.0, f64::max);
    let share = |i: usize| {
        let (left, scale) = (left[i].abs(), scale(i));
        let limit = rounding.max(BALANCED * scale);
        if left <= limit { 0.0 } else { left / scale }
    };
    let worst = (0..q.len()).max_by(|&i, &j| share(i).total_cmp(&share(j)))?;
    (share(worst) > 0.0).then(|| (worst, left[worst]))
}

/// The pseudoinverse of a matrix, from its singular values.
struct Inverse {
    u: DMatrix<f64>,
    v_t: DMatrix<f64>,
    inverses: Vec<f64>,
    rank: usize,
}

impl Inverse {
    fn of(matrix: &DMatrix<f64>) -> Inverse {
        let svd = matrix.clone().svd(true, true);
        let limit = super::spectrum::rank_tolerance(matrix.nrows()) * svd.singular_values.max();
        let inverses: Vec<f64> = svd
            .singular_values
            .iter()
            .map(|&s| if s > limit { 1.0 / s } else { 0.0 })
            .collect();
        Inverse {
            rank: inverses.iter().filter(|s| **s != 0.0).count(),
            u: svd.u.unwrap_or_default(),
            v_t: svd.v_t.unwrap_or_default(),
            inverses,
        }
    }

    /// The part of these accelerations that no step removes.
    fn rest(&self, a: &DVector<f64>) -> DVector<f64> {
        let mut along = self.u.tr_mul(a);
        for (x, inverse) in along.iter_mut().zip(&self.inverses) {
            if *inverse == 0.0 {
                *x = 0.0;
            }
        }
        a - &self.u * along
    }

    /// The shortest step that removes these accelerations as far as any does.
    fn step(&self, a: &DVector<f64>) -> DVector<f64> {
        let mut along = self.u.tr_mul(a);
        for (x, inverse) in along.iter_mut().zip(&self.inverses) {
            *x *= -inverse;
        }
        self.v_t.tr_mul(&along)
    }
}
