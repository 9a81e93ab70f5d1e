//! The fastest motion of a machine whose masses, forces and friction depend on where it is and how fast: outside of the
//! conditions (17).
//!
//! With `A(q) = a + d` and everything else that resists in `R(q, v)` (inertia forces, less applied ones, friction of what
//! presses without accelerations), control forces that do no work leave
//!
//! ```text
//! v·A(q) v̇ + v·R(q, v) = 0                                                                    (8)
//! ```
//!
//! A transcription whose unknowns are speeds could gain from turns that it does not resolve: `v·A v̇` contains the change of
//! the direction. So the speed is measured by what a sudden turn leaves alone (`hamiltonian`), the direction becomes a
//! control without a rate, and Pontryagin's conditions, a boundary value problem, are collocated at Gauss points
//! (`collocation`): with s of them the error at the ends of stretches is of the order 2 s.
//!
//! The way to the answer starts at a machine with frozen coefficients, whose closed form is known, and ends at the machine
//! itself; the stretches are halved until the time settles.

mod collocation;
mod hamiltonian;
mod motion;
mod pontryagin;
mod rule;

use std::string::String;
use std::vec::Vec;

use lagrangian_scalar::Scalar;

use super::error::Unsolved;
use super::linear::{Cholesky, Matrix, dot, times};
use super::problem::Problem;
use super::solution::Contact;
use collocation::Path;
use hamiltonian::Driven;
use pontryagin::Pontryagin;

pub use motion::Sought;

/// `½ (A_αβ − A_βα)` below this part of the inertia of both is rounding.
const SKEW: f64 = 1e-13;

/// Stretches at first, where these lose the motion, and at most.
const STRETCHES: [usize; 3] = [8, 32, 256];

/// The time is settled when halving changes it by less than this part; at order 8 it is then good to the last digits.
const SETTLED: f64 = 1e-12;

/// The least step on the way from the frozen machine to the real one.
const LEAST_STEP: f64 = 1.0 / 64.0;

/// A machine without constraints and without explicit time.
///
/// Over any numbers, as derivatives are taken with dual ones.
pub trait Terrain {
    /// How many coordinates there are.
    fn coordinates(&self) -> usize;

    /// `A(q) = a + d` by rows: inertia, and friction that grows with the accelerations.
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N>;

    /// `R(q, v)`: what resists without accelerations, a covector.
    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N>;

    /// `a(q)` by rows, where that is not the symmetric part of `A`.
    fn mass(&self, q: &[f64]) -> Vec<f64> {
        let (n, inertia) = (self.coordinates(), self.inertia(q));
        let even = |k: usize| 0.5 * (inertia[k] + inertia[k % n * n + k / n]);
        (0..n * n).map(even).collect()
    }

    /// Names of the guides.
    fn guides(&self) -> Vec<String> {
        Vec::new()
    }

    /// What the guides do, and the power of their friction, in W.
    fn contacts(&self, _q: &[f64], _v: &[f64], _a: &[f64]) -> (Vec<Contact>, f64) {
        (Vec::new(), 0.0)
    }
}

/// A part θ of the way from constant coefficients to those of a machine.
struct Blend<'a, T> {
    terrain: &'a T,
    inertia: Vec<f64>,
    resistance: Vec<f64>,
    part: f64,
}

impl<T: Terrain> Terrain for Blend<'_, T> {
    fn coordinates(&self) -> usize {
        self.terrain.coordinates()
    }

    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        let real = match self.part == 0.0 {
            true => std::vec![N::ZERO; self.inertia.len()],
            false => self.terrain.inertia(q),
        };
        self.between(&self.inertia, real)
    }

    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        let real = match self.part == 0.0 {
            true => std::vec![N::ZERO; self.resistance.len()],
            false => self.terrain.resistance(q, v),
        };
        self.between(&self.resistance, real)
    }
}

impl<T> Blend<'_, T> {
    fn between<N: Scalar>(&self, frozen: &[f64], real: Vec<N>) -> Vec<N> {
        if self.part == 1.0 {
            return real;
        }
        let (part, rest) = (N::from_f64(self.part), 1.0 - self.part);
        let pairs = frozen.iter().zip(real);
        pairs
            .map(|(frozen, real)| part * real + N::from_f64(rest * frozen))
            .collect()
    }
}

/// The fastest motion of a machine from rest at one place to another.
///
/// # Errors
/// Why there is none, or none that was found; see [`Unsolved`].
pub fn solve<T: Terrain>(terrain: T, from: &[f64], to: &[f64]) -> Result<Sought<T>, Unsolved> {
    solve_in(terrain, from, to, STRETCHES)
}

/// The same on so many equal stretches of time, for those who look at the error.
///
/// # Errors
/// As [`solve`].
pub fn solve_on<T: Terrain>(
    terrain: T,
    from: &[f64],
    to: &[f64],
    stretches: usize,
) -> Result<Sought<T>, Unsolved> {
    solve_in(terrain, from, to, [stretches.max(1); 3])
}

fn solve_in<T: Terrain>(
    terrain: T,
    from: &[f64],
    to: &[f64],
    stretches: [usize; 3],
) -> Result<Sought<T>, Unsolved> {
    let n = terrain.coordinates();
    for (what, list) in [("the start", from), ("the end", to)] {
        let found = list.len();
        if found != n || n == 0 {
            let expected = n.max(1);
            return Err(Unsolved::Size {
                what,
                expected,
                found,
            });
        }
        if !list.iter().all(|x| x.is_finite()) {
            return Err(Unsolved::NotFinite { what });
        }
    }
    let way: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
    if way.iter().all(|x| *x == 0.0) {
        return Err(Unsolved::SameEnds);
    }
    let frame = frame(&terrain, from)?;
    refuse_loops(&terrain, from, to)?;
    let driven = |part, frozen: &Frozen| {
        let blend = Blend {
            terrain: &terrain,
            inertia: frozen.inertia.clone(),
            resistance: frozen.resistance.clone(),
            part,
        };
        Driven::new(blend, frame.clone())
    };
    let mut reached = 0.0_f64;
    let mut path = None;
    let frozen = frozen(&terrain, from, to);
    // An end that is not below on the straight way is hardly below on another, and not looked for twice.
    let rise = rise(&terrain, from, to);
    let starts = stretches[..if rise < 0.0 { 2 } else { 1 }].iter();
    let starts = starts.flat_map(|count| frozen.iter().map(move |frozen| (count, frozen)));
    for (count, frozen) in starts {
        let Ok(motion) = frozen.problem.solve(from, to) else {
            continue;
        };
        let Some(start) = Path::guess(&driven(0.0, frozen), &motion, *count) else {
            continue;
        };
        let (found, part) = carried(start, from, to, |part| driven(part, frozen));
        reached = reached.max(part);
        if let Some(found) = found {
            path = settled(&driven(1.0, frozen), found, [from, to], stretches[2]);
        }
        if path.is_some() {
            break;
        }
    }
    let (path, change) = path.ok_or(match rise >= 0.0 {
        true => Unsolved::NotBelow { rise },
        false => Unsolved::NotFound { part: reached },
    })?;
    let system = Driven::new(terrain, frame);
    Sought::new(system, path, change, from, to)
}

/// Columns orthonormal in the metric `sym A` of the start, in which directions are measured.
fn frame(terrain: &impl Terrain, from: &[f64]) -> Result<Matrix, Unsolved> {
    let n = from.len();
    let even = rows(&symmetric(terrain.inertia(from), n), n);
    let factor = Cholesky::new(&even)
        .map_err(|(coordinate, ratio)| Unsolved::FrictionOutweighsInertia { coordinate, ratio })?;
    // Columns of L⁻ᵀ: solutions of Lᵀ f = e.
    Ok((0..n)
        .map(|k| {
            let mut unit = std::vec![0.0; n];
            unit[k] = 1.0;
            factor.solve_upper(&unit)
        })
        .collect())
}

/// With three coordinates or more, no fastest motion survives friction that makes `A` skew.
fn refuse_loops(terrain: &impl Terrain, from: &[f64], to: &[f64]) -> Result<(), Unsolved> {
    let n = from.len();
    let mut most = ([0, 0], 0.0_f64);
    for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
        let inertia = terrain.inertia(&between(from, to, part));
        for i in 0..n {
            for j in 0..i {
                let skew = 0.5 * (inertia[i * n + j] - inertia[j * n + i]).abs();
                let skew = skew / (inertia[i * n + i] * inertia[j * n + j]).abs().sqrt();
                if skew > most.1 {
                    most = ([j, i], skew);
                }
            }
        }
    }
    let (coordinates, skew) = most;
    match n > 2 && skew > SKEW {
        true => Err(Unsolved::LoopsFeed { coordinates, skew }),
        false => Ok(()),
    }
}

/// A machine with constant coefficients to start from.
struct Frozen {
    inertia: Vec<f64>,
    resistance: Vec<f64>,
    problem: Problem,
}

/// Machines to start from, the likeliest first: frozen half-way, at the start, half-way with the mean force of the straight
/// way, and one that falls straight to the end.
fn frozen(terrain: &impl Terrain, from: &[f64], to: &[f64]) -> Vec<Frozen> {
    let n = from.len();
    let half = between(from, to, 0.5);
    let rest = std::vec![0.0; n];
    let at_rest = |part: f64| terrain.resistance(&between(from, to, part), &rest);
    let middle = terrain.inertia(&half);
    let even = symmetric(middle.clone(), n);
    let [one, two, three] = [0.0, 0.5, 1.0].map(at_rest);
    let mean = (0..n).map(|i| (one[i] + 4.0 * two[i] + three[i]) / 6.0);
    let mean: Vec<f64> = mean.collect();
    let way: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
    let momentum = times(&rows(&even, n), &way);
    // With the acceleration that the work on the straight way gives, or else of gravity.
    let length = dot(&momentum, &way).max(f64::MIN_POSITIVE);
    let push = (dot(&mean, &way).abs() / length).max(f64::EPSILON);
    let falling = momentum.iter().map(|p| -push * p).collect();
    let candidates = [
        (middle.clone(), two),
        (terrain.inertia(from), one),
        (middle, mean.clone()),
        (even.clone(), mean),
        (even, falling),
    ];
    let known = candidates.into_iter().filter_map(|(inertia, resistance)| {
        let even = symmetric(inertia.clone(), n);
        let skew: Vec<f64> = inertia.iter().zip(&even).map(|(a, s)| a - s).collect();
        let problem = Problem::new(&rows(&even, n), &resistance)
            .and_then(|problem| problem.with_friction(&std::vec![0.0; n], &rows(&skew, n)));
        let problem = problem.ok()?;
        Some(Frozen {
            inertia,
            resistance,
            problem,
        })
    });
    known.collect()
}

/// The path of the machine itself, from that of the frozen one; and how far it came.
fn carried<P: Pontryagin>(
    start: Path,
    from: &[f64],
    to: &[f64],
    system: impl Fn(f64) -> P,
) -> (Option<Path>, f64) {
    let (mut path, mut part, mut step) = (start, 0.0_f64, 1.0_f64);
    while part < 1.0 {
        let next = (part + step).min(1.0);
        match path.clone().corrected(&system(next), from, to) {
            Some(found) => {
                (path, part) = (found, next);
                step *= 2.0;
            }
            None => {
                step /= 2.0;
                if step < LEAST_STEP {
                    return (None, part);
                }
            }
        }
    }
    (Some(path), part)
}

/// Halves the stretches until the time stays; returns by how much it changed at last, in s. `None` where the motion is lost.
fn settled<P: Pontryagin>(
    system: &P,
    mut path: Path,
    [from, to]: [&[f64]; 2],
    most: usize,
) -> Option<(Path, f64)> {
    let mut change = f64::INFINITY;
    while path.stretches() < most {
        let finer = path.halved().corrected(system, from, to)?;
        let before = change;
        change = (finer.time - path.time).abs();
        path = finer;
        // Or rounding is reached, and halving changes no more.
        if change <= SETTLED * path.time || (change >= before && change <= 1e-10 * path.time) {
            break;
        }
    }
    Some((path, change))
}

/// The work against everything that resists at rest, on the straight way, in J.
fn rise(terrain: &impl Terrain, from: &[f64], to: &[f64]) -> f64 {
    let way: Vec<f64> = to.iter().zip(from).map(|(to, from)| to - from).collect();
    let rest = std::vec![0.0; from.len()];
    let steps = 64;
    let parts = (0..steps).map(|k| {
        let part = (f64::from(k) + 0.5) / f64::from(steps);
        dot(&terrain.resistance(&between(from, to, part), &rest), &way) / f64::from(steps)
    });
    parts.sum()
}

fn between(from: &[f64], to: &[f64], part: f64) -> Vec<f64> {
    let ends = from.iter().zip(to);
    ends.map(|(from, to)| from + part * (to - from)).collect()
}

fn symmetric(matrix: Vec<f64>, n: usize) -> Vec<f64> {
    let even = |k: usize| 0.5 * (matrix[k] + matrix[k % n * n + k / n]);
    (0..n * n).map(even).collect()
}

fn rows(matrix: &[f64], n: usize) -> Matrix {
    matrix.chunks(n).map(<[f64]>::to_vec).collect()
}
