//! The complementarity problem of contacts with friction in space, where friction obeys a disc.
//!
//! ```text
//! γ = G Λ + b,    0 ≤ Λₙ ⊥ γₙ ≥ 0,    |Λₜ| ≤ r,  Λₜ = −r γₜ/|γₜ| where γₜ ≠ 0,    r = μ (Λₙ + Λ₀)
//! ```
//!
//! In units in which the diagonal of G is 1 this is `Φ(Λ) = 0` with
//!
//! ```text
//! Φₙ = Λₙ − max(0, Λₙ − γₙ),    Φₜ = Λₜ − proj(Λₜ − γₜ, disc of radius r)
//! ```
//!
//! (P. Alart, A. Curnier, Comput. Methods Appl. Mech. Eng. 92 (1991) 353–375.) The search takes three ways, each of which ends with Newton's method on Φ, which finds
//! the numbers to rounding:
//!
//! 1. Newton's method itself, from forces that are near, as those of the step before are in time stepping.
//! 2. Some sweeps over the contacts, each solved exactly with the others as they are, find which of them are open, stick and slip (M. Jean, Comput. Methods Appl.
//!    Mech. Eng. 177 (1999) 235–257).
//! 3. A sequence of convex problems (`interior`), which contacts that depend on each other do not slow down.
//!
//! Where all fail, or the problem has no convex form, sweeps and Newton's method are repeated, with more and more sweeps. Φ alone decides whether a solution is
//! one, and it is returned.

mod interior;
mod newton;
mod single;
mod sweeps;

use std::vec;
use std::vec::Vec;

use super::lcp::Unsolved;
use crate::implicit::lu::Lu;
use interior::Interior;
use newton::{Newton, Pace};

/// What Φ is of a solution, relative to the size of the terms.
const GOOD: f64 = 1e-13;

/// With how much of it a solution is still one: what rounding leaves where contacts depend on each other.
const TOLERABLE: f64 = 1e-10;

/// Sweeps before the first try of Newton's method; each further time there are twice as many.
const FIRST_SWEEPS: usize = 8;

/// How often sweeps and Newton's method follow each other: some 4000 sweeps in all.
const ROUNDS: usize = 9;

/// After so many of these the sequence of convex problems is tried.
const ROUNDS_BEFORE_CONVEX_PROBLEMS: usize = 1;

/// How often sweeps and Newton's method follow each other if that fails, which they seldom mend: 500 sweeps.
const ROUNDS_AFTER_CONVEX_PROBLEMS: usize = 6;

/// The most convex problems of a sequence, and at least this many if they are so large that these would take more than so many multiplications: each of them takes
/// some sixty for the third power of the number of forces, those of Newton's method included.
const CONVEX_PROBLEMS: usize = 40;
const FEWEST_CONVEX_PROBLEMS: usize = 4;
const MOST_MULTIPLICATIONS: f64 = 2e9;
const MULTIPLICATIONS: f64 = 60.0;

/// After so many rounds, with 120 sweeps in all, a solution is followed from a small friction.
const ROUNDS_BEFORE_FRICTION_IS_FOLLOWED: usize = 4;

/// A solution that is good enough is not improved further if a round leaves more than this share of Φ.
const LESS: f64 = 0.1;

/// The most steps of Newton's method in one round.
const STEPS: usize = 40;

/// The most where another search follows that costs less than more of them.
const FEW_STEPS: usize = 16;

/// In so many steps friction grows where a solution is followed from a small one, with at most so many sweeps in each.
const FRICTIONS: usize = 16;
const SWEEPS_OF_FRICTION: usize = 64;

/// A normal direction, or the tangent or both tangents of a contact.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    /// The place of a normal force among the unknowns.
    Normal(usize),
    /// Tangential forces.
    Disc(Disc),
}

/// One or two (`count`) tangential forces, which together are no greater than `μ` times the force at `on`, if there is one, and `known_normal` that.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    /// Their places among the unknowns.
    pub places: [usize; 2],
    pub count: usize,
    pub friction: f64,
    pub on: Option<usize>,
    pub known_normal: f64,
}

impl Disc {
    fn places(&self) -> &[usize] {
        &self.places[..self.count]
    }

    /// What the forces are no greater than together.
    fn radius(&self, z: &[f64]) -> f64 {
        (self.friction * (self.on.map_or(0.0, |on| z[on]) + self.known_normal)).max(0.0)
    }
}

/// Unknown forces `z`, of which `γ = A z + b`. `A` has ones, or numbers about as large, on its diagonal, and `b` is at most 1.
#[derive(Clone, Debug, Default)]
pub(super) struct Problem {
    pub matrix: Vec<f64>,
    pub b: Vec<f64>,
    pub parts: Vec<Part>,
    /// The unit of each force: `A` is a symmetric matrix, if there is one, with columns multiplied by these.
    pub units: Vec<f64>,
}

/// The best forces so far, and by how much they miss a condition.
#[derive(Clone, Debug, Default)]
struct Best {
    z: Vec<f64>,
    missed: f64,
}

impl Best {
    fn begin(&mut self, z: &[f64], missed: f64) {
        self.z.clear();
        self.z.extend_from_slice(z);
        self.missed = missed;
    }

    /// Takes forces if they miss a condition by less.
    fn note(&mut self, z: &[f64], missed: f64) {
        if missed < self.missed {
            self.missed = missed;
            self.z.copy_from_slice(z);
        }
    }

    /// Whether the search is at its end, after a round before which the best forces missed a condition by `known`. Where contacts depend on each other, rounding may
    /// leave more than is good, which no further round changes.
    fn is_done_since(&self, known: f64) -> bool {
        let is_stalled = self.missed <= TOLERABLE && self.missed > LESS * known;
        self.missed <= GOOD || is_stalled
    }
}

/// Memory for the search for a solution.
#[derive(Clone, Debug, Default)]
pub(super) struct Workspace {
    best: Best,
    newton: Newton,
    interior: Interior,
    /// The forces that solve a convex problem.
    start: Vec<f64>,
}

/// Solves the problem: says by how much the forces miss a condition. The search begins with the forces `z`, and writes the solution there.
pub(super) fn solve(
    problem: &Problem,
    z: &mut [f64],
    work: &mut Workspace,
) -> Result<f64, Unsolved> {
    let is_finite = |values: &[f64]| values.iter().all(|x| x.is_finite());
    if !is_finite(&problem.b) || !is_finite(&problem.matrix) {
        return Err(Unsolved);
    }
    work.best.begin(z, problem.relative_residual(z));
    search(problem, z, work);
    if work.best.missed <= TOLERABLE {
        z.copy_from_slice(&work.best.z);
        problem.clear_open(z, &work.best.z);
        Ok(work.best.missed)
    } else {
        Err(Unsolved)
    }
}

fn search(problem: &Problem, z: &mut [f64], work: &mut Workspace) {
    // Of several solutions the one that is near: sweeps may leave it.
    if z.iter().any(|z| *z != 0.0) {
        problem.polish(z, (Pace::Bold, FEW_STEPS), work);
        if work.best.missed <= GOOD {
            return;
        }
    }
    let mut rounds = ROUNDS;
    for round in 0.. {
        if round == ROUNDS_BEFORE_CONVEX_PROBLEMS {
            if problem.solve_convex_problems(work) {
                rounds = ROUNDS_AFTER_CONVEX_PROBLEMS;
            }
            if work.best.missed <= TOLERABLE {
                return;
            }
        }
        if round == rounds {
            return;
        }
        // Where some hundred sweeps have found nothing, thousands seldom do.
        if round == ROUNDS_BEFORE_FRICTION_IS_FOLLOWED && work.best.missed > TOLERABLE {
            problem.follow_friction(work);
            if work.best.missed <= GOOD {
                return;
            }
        }
        let known = work.best.missed;
        for _ in 0..FIRST_SWEEPS << round {
            let moved = problem.sweep(z);
            if moved <= f64::EPSILON {
                break;
            }
        }
        problem.polish(z, (Pace::Bold, FEW_STEPS), work);
        let is_done = if round < ROUNDS_BEFORE_CONVEX_PROBLEMS {
            work.best.missed <= GOOD
        } else {
            work.best.is_done_since(known)
        };
        if is_done {
            return;
        }
    }
}

/// What the friction force of a contact is projected from: `Λₜ − γₜ`, its length, and the radius of the disc.
struct Towards {
    y: [f64; 2],
    length: f64,
    radius: f64,
}

impl Towards {
    fn slips(&self) -> bool {
        self.length > self.radius
    }
}

impl Problem {
    fn n(&self) -> usize {
        self.b.len()
    }

    /// Sets the forces of contacts that open to 0 itself: a solution has less than Φ there, which others would take for a contact that presses.
    fn clear_open(&self, z: &mut [f64], solution: &[f64]) {
        for part in &self.parts {
            match *part {
                Part::Normal(i) if solution[i] <= self.rate(i, solution) => z[i] = 0.0,
                Part::Normal(_) => {}
                Part::Disc(disc) => {
                    if disc.radius(z) == 0.0 {
                        disc.places().iter().for_each(|i| z[*i] = 0.0);
                    }
                }
            }
        }
    }

    fn row(&self, i: usize) -> &[f64] {
        &self.matrix[i * self.n()..][..self.n()]
    }

    /// The rate of a direction with these forces.
    fn rate(&self, i: usize, z: &[f64]) -> f64 {
        self.b[i] + dot(self.row(i), z)
    }

    fn towards(&self, disc: &Disc, z: &[f64]) -> Towards {
        let mut y = [0.0; 2];
        for (y, &i) in y.iter_mut().zip(disc.places()) {
            *y = z[i] - self.rate(i, z);
        }
        Towards {
            y,
            length: norm(&y),
            radius: disc.radius(z),
        }
    }

    /// Writes `Φ`, in the order of the unknowns, and its greatest part, relative to the size of forces and rates.
    fn residual(&self, z: &[f64], phi: &mut [f64]) -> f64 {
        let (mut most, size) = (0.0_f64, size_of(z));
        self.each_residual(z, |i, value| {
            phi[i] = value;
            most = greater(most, value);
        });
        most / size
    }

    /// The greatest part of `Φ`, relative to the size of forces and rates.
    fn relative_residual(&self, z: &[f64]) -> f64 {
        let mut most = 0.0_f64;
        self.each_residual(z, |_, value| most = greater(most, value));
        most / size_of(z)
    }

    fn each_residual(&self, z: &[f64], mut write: impl FnMut(usize, f64)) {
        for part in &self.parts {
            match *part {
                Part::Normal(i) => write(i, z[i] - (z[i] - self.rate(i, z)).max(0.0)),
                Part::Disc(disc) => {
                    let towards = self.towards(&disc, z);
                    let factor = if towards.slips() {
                        towards.radius / towards.length
                    } else {
                        1.0
                    };
                    for (&i, y) in disc.places().iter().zip(towards.y) {
                        write(i, z[i] - factor * y);
                    }
                }
            }
        }
    }

    /// Newton's method from the solutions of convex problems; whether there are such problems.
    fn solve_convex_problems(&self, work: &mut Workspace) -> bool {
        if !work.interior.begin(self) {
            return false;
        }
        let mut z = core::mem::take(&mut work.start);
        z.clear();
        z.resize(self.n(), 0.0);
        let most = MOST_MULTIPLICATIONS / (MULTIPLICATIONS * (self.n() as f64).powi(3));
        let most = most.clamp(FEWEST_CONVEX_PROBLEMS as f64, CONVEX_PROBLEMS as f64) as usize;
        for round in 0..most {
            let known = work.best.missed;
            work.interior.next(&mut z, round == 0);
            self.polish(&z, (Pace::Bold, STEPS), work);
            if work.best.missed > GOOD {
                self.polish(&z, (Pace::Cautious, STEPS), work);
            }
            if work.best.is_done_since(known) {
                break;
            }
        }
        work.start = z;
        true
    }

    /// Follows a solution as friction grows from a part of what it is to all of it: without friction sweeps always converge. The best that has been found so far is
    /// that of `work`.
    fn follow_friction(&self, work: &mut Workspace) {
        let mut z = vec![0.0; self.n()];
        let mut own = Workspace::default();
        for part in 1..=FRICTIONS {
            let mut some = self.clone();
            for part_of_contact in &mut some.parts {
                if let Part::Disc(disc) = part_of_contact {
                    disc.friction *= part as f64 / FRICTIONS as f64;
                }
            }
            own.best.begin(&z, some.relative_residual(&z));
            some.polish(&z, (Pace::Bold, STEPS), &mut own);
            for _ in 0..SWEEPS_OF_FRICTION {
                if own.best.missed <= GOOD || some.sweep(&mut z) <= f64::EPSILON {
                    break;
                }
            }
            some.polish(&z, (Pace::Bold, STEPS), &mut own);
            z.copy_from_slice(&own.best.z);
        }
        work.best.note(&z, self.relative_residual(&z));
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn norm(x: &[f64]) -> f64 {
    match x {
        [x, y] => (x * x + y * y).sqrt(),
        x => dot(x, x).sqrt(),
    }
}

/// The greater of a size and that of a value, and infinite if this is not a number.
fn greater(most: f64, value: f64) -> f64 {
    if value.is_nan() {
        f64::INFINITY
    } else {
        most.max(value.abs())
    }
}

/// The size of forces that residuals are relative to.
fn size_of(z: &[f64]) -> f64 {
    z.iter().fold(1.0_f64, |size, z| size.max(z.abs()))
}

/// Factors a matrix of rows; whether it is regular.
fn factor_rows(rows: &[f64], n: usize, lu: &mut Lu<1>) -> bool {
    lu.resize(n);
    lu.factor(|j, [column]| {
        let entries = rows.iter().skip(j).step_by(n.max(1));
        column.iter_mut().zip(entries).for_each(|(to, x)| *to = *x);
    })
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

    /// `count` contacts with friction, whose inertia is that of `rank` directions in which a machine moves.
    fn random(seed: &mut u64, count: usize, rank: usize, friction: f64) -> Problem {
        let n = 3 * count;
        let mut rows: Vec<Vec<f64>> = (0..n)
            .map(|_| (0..rank).map(|_| drawn(seed)).collect())
            .collect();
        for row in &mut rows {
            let length = norm(row);
            row.iter_mut().for_each(|x| *x /= length);
        }
        let v: Vec<f64> = (0..rank).map(|_| drawn(seed)).collect();
        let parts = (0..count).flat_map(|k| {
            [
                Part::Normal(3 * k),
                Part::Disc(Disc {
                    places: [3 * k + 1, 3 * k + 2],
                    count: 2,
                    friction,
                    on: Some(3 * k),
                    known_normal: 0.0,
                }),
            ]
        });
        Problem {
            matrix: (0..n * n)
                .map(|k| dot(&rows[k / n], &rows[k % n]))
                .collect(),
            b: rows.iter().map(|row| dot(row, &v)).collect(),
            parts: parts.collect(),
            units: vec![1.0; n],
        }
    }

    fn solved(problem: &Problem) -> Result<(Vec<f64>, f64), Unsolved> {
        let mut z = vec![0.0; problem.n()];
        let missed = solve(problem, &mut z, &mut Workspace::default())?;
        Ok((z, missed))
    }

    /// The conditions themselves, as they stand at the top, and not Φ.
    fn breach(problem: &Problem, z: &[f64]) -> f64 {
        let mut worst = 0.0_f64;
        for part in &problem.parts {
            match part {
                Part::Normal(i) => {
                    let rate = problem.rate(*i, z);
                    worst = worst.max(-z[*i]).max(-rate).max((z[*i] * rate).abs());
                }
                Part::Disc(Disc {
                    places,
                    friction,
                    on,
                    known_normal,
                    ..
                }) => {
                    let most = friction * (on.map_or(0.0, |on| z[on]) + known_normal);
                    let force: Vec<f64> = places.iter().map(|i| z[*i]).collect();
                    let slip: Vec<f64> = places.iter().map(|i| problem.rate(*i, z)).collect();
                    worst = worst.max(norm(&force) - most);
                    // Power is the most that the disc can take.
                    let power: f64 = force.iter().zip(&slip).map(|(f, s)| f * s).sum();
                    worst = worst.max((power + most * norm(&slip)).abs());
                }
            }
        }
        worst
    }

    #[test]
    fn random_contacts_of_every_rank_obey_every_condition() {
        let mut seed = 0x9e37_79b9_7f4a_7c15;
        for case in 0..400 {
            let count = 1 + case % 6;
            let rank = 3 + case % (3 * count);
            // With little friction there is a solution whatever the directions are.
            let problem = random(&mut seed, count, rank, 0.2);
            let found = solved(&problem);
            let Ok((z, missed)) = found else {
                panic!("case {case} of {count} contacts and rank {rank} was not solved");
            };
            let size = z.iter().fold(1.0_f64, |size, z| size.max(z.abs()));
            let breach = breach(&problem, &z) / (size * size);
            assert!(
                breach < 1e-9,
                "case {case} of {count}, rank {rank}: {breach:e}, Φ {missed:e}"
            );
        }
    }

    /// One contact alone, whatever its friction force was before: the conditions hold, also beside a normal force that is known.
    #[test]
    fn one_contact_is_solved_from_any_friction_force() {
        let mut seed = 5;
        let mut slips = 0;
        for case in 0..3000 {
            let mut problem = random(&mut seed, 1, 3 + case % 3, 0.4);
            let known = if case % 3 == 0 { 0.3 } else { 0.0 };
            for part in &mut problem.parts {
                if let Part::Disc(disc) = part {
                    disc.known_normal = known;
                }
            }
            let start = match case % 4 {
                0 => [0.0; 3],
                _ => [0.0, drawn(&mut seed), drawn(&mut seed)],
            };
            let found = problem.single_contact_forces(&[0, 1, 2], (0.4, known), &start);
            let size = size_of(&found);
            let breach = breach(&problem, &found) / (size * size);
            assert!(breach < 1e-12, "case {case}: {breach:e} of {found:?}");
            let radius = 0.4 * (found[0] + known);
            slips += usize::from(norm(&found[1..]) > radius * (1.0 - 1e-12));
        }
        assert!(slips > 1000, "{slips}");
    }

    /// A point mass on a table: what friction takes of its slip is along the slip, and no more than there is.
    #[test]
    fn a_point_is_stopped_or_braked_along_its_slip() {
        for (slip, presses) in [([0.3, 0.4], 2.0), ([0.3, 0.4], 0.5), ([0.0, -0.7], 0.2)] {
            let mut matrix = vec![0.0; 9];
            (0..3).for_each(|i| matrix[4 * i] = 1.0);
            let disc = Part::Disc(Disc {
                places: [1, 2],
                count: 2,
                friction: 0.5,
                on: Some(0),
                known_normal: 0.0,
            });
            let problem = Problem {
                matrix,
                b: vec![-presses, slip[0], slip[1]],
                parts: vec![Part::Normal(0), disc],
                units: vec![1.0; 3],
            };
            let (z, _) = solved(&problem).expect("there is one solution");
            let speed = norm(&slip);
            let taken = speed.min(0.5 * presses);
            assert!((z[0] - presses).abs() < 1e-14);
            for (z, slip) in z[1..].iter().zip(slip) {
                assert!((z + taken * slip / speed).abs() < 1e-14, "{z} of {slip}");
            }
        }
    }

    #[test]
    fn what_has_no_solution_is_not_solved() {
        let problem = Problem {
            matrix: vec![-1.0],
            b: vec![-1.0],
            parts: vec![Part::Normal(0)],
            units: vec![1.0],
        };
        assert!(solved(&problem).is_err());
    }
}
