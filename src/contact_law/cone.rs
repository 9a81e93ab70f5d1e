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

use std::vec;
use std::vec::Vec;

use super::lcp::{self, Unsolved};
use crate::implicit::lu::Lu;
use interior::Interior;

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

/// Φ that is rounding of a few operations: Newton's method ends.
const ENOUGH: f64 = f64::EPSILON;

/// By how much the diagonal of A is enlarged in Newton's method, for each unit of Φ, and at least.
const YIELDING: f64 = 0.01;
const LEAST_YIELDING: f64 = 1e-10;

/// By what that is multiplied in cautious steps, after one that makes Φ smaller, and after another one, from at least this.
const LESS_YIELDING: f64 = 0.1;
const MORE_YIELDING: f64 = 100.0;
const FIRST_YIELDING: f64 = 1e-8;

/// How often a step is halved.
const HALVINGS: usize = 6;

/// In so many steps friction grows where a solution is followed from a small one, with at most so many sweeps in each.
const FRICTIONS: usize = 16;
const SWEEPS_OF_FRICTION: usize = 64;

/// Directions in which the friction of one contact is looked for first.
const DIRECTIONS: usize = 48;

/// The cosine and the sine of the angle between two of these.
const TURN: [f64; 2] = [0.991_444_861_373_810_4, 0.130_526_192_220_051_57];

/// The most estimates of a direction between two of these.
const MOST_ESTIMATES: usize = 60;

/// The most corrections of a direction by Newton's method, and the greatest correction, in rad.
const MOST_CORRECTIONS: usize = 10;
const GREATEST_CORRECTION: f64 = 0.5;

/// Directions of a contact of whose inertia elimination leaves less than this depend on each other.
const DEPENDENT: f64 = 1e-9;

/// A normal direction, or the tangent or both tangents of a contact.
#[derive(Clone, Copy, Debug)]
pub(super) enum Part {
    /// The place of a normal force among the unknowns.
    Normal(usize),
    /// The places of one or two (`count`) tangential forces, which together are no greater than `μ` times the force at `on`, if there is
    /// one, and `known_normal` that.
    Disc {
        places: [usize; 2],
        count: usize,
        friction: f64,
        on: Option<usize>,
        known_normal: f64,
    },
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

/// Memory for the search for a solution.
#[derive(Clone, Debug, Default)]
pub(super) struct Workspace {
    /// The best forces so far, and by how much they miss a condition.
    best: Vec<f64>,
    missed: f64,
    newton: Newton,
    interior: Interior,
    /// The forces that solve a convex problem.
    start: Vec<f64>,
}

impl Workspace {
    /// Whether the search is at its end, after a round before which the best forces missed a condition by `known`. Where contacts depend on each other, rounding may
    /// leave more than is good, which no further round changes.
    fn is_done_since(&self, known: f64) -> bool {
        let is_stalled = self.missed <= TOLERABLE && self.missed > LESS * known;
        self.missed <= GOOD || is_stalled
    }
}

/// Memory for Newton's method.
#[derive(Clone, Debug, Default)]
struct Newton {
    z: Vec<f64>,
    next: Vec<f64>,
    phi: Vec<f64>,
    slopes: Vec<f64>,
    by: Vec<f64>,
    lu: Lu<1>,
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
    work.best.clear();
    work.best.extend_from_slice(z);
    work.missed = problem.relative_residual(z);
    search(problem, z, work);
    if work.missed <= TOLERABLE {
        z.copy_from_slice(&work.best);
        problem.clear_open(z, &work.best);
        Ok(work.missed)
    } else {
        Err(Unsolved)
    }
}

fn search(problem: &Problem, z: &mut [f64], work: &mut Workspace) {
    // Of several solutions the one that is near: sweeps may leave it.
    if z.iter().any(|z| *z != 0.0) {
        problem.polish(z, (Pace::Bold, FEW_STEPS), work);
        if work.missed <= GOOD {
            return;
        }
    }
    let mut rounds = ROUNDS;
    for round in 0.. {
        if round == ROUNDS_BEFORE_CONVEX_PROBLEMS {
            if problem.solve_convex_problems(work) {
                rounds = ROUNDS_AFTER_CONVEX_PROBLEMS;
            }
            if work.missed <= TOLERABLE {
                return;
            }
        }
        if round == rounds {
            return;
        }
        // Where some hundred sweeps have found nothing, thousands seldom do.
        if round == ROUNDS_BEFORE_FRICTION_IS_FOLLOWED && work.missed > TOLERABLE {
            problem.follow_friction(work);
            if work.missed <= GOOD {
                return;
            }
        }
        let known = work.missed;
        for _ in 0..FIRST_SWEEPS << round {
            let moved = problem.sweep(z);
            if moved <= f64::EPSILON {
                break;
            }
        }
        problem.polish(z, (Pace::Bold, FEW_STEPS), work);
        let is_done = if round < ROUNDS_BEFORE_CONVEX_PROBLEMS {
            work.missed <= GOOD
        } else {
            work.is_done_since(known)
        };
        if is_done {
            return;
        }
    }
}

/// How Newton's method goes on where a step makes Φ no smaller.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pace {
    /// From where the step leads: Φ has kinks, behind which it may fall.
    Bold,
    /// From where it was, with contacts that yield more, so that the step is shorter.
    Cautious,
}

impl Pace {
    /// By how much contacts yield at most, and how many steps may fail in succession.
    fn limits(self) -> (f64, usize) {
        match self {
            Pace::Bold => (1e-3, 3),
            Pace::Cautious => (0.1, 8),
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
                Part::Disc {
                    places,
                    count,
                    friction,
                    on,
                    known_normal,
                } => {
                    if Self::radius(friction, on, known_normal, z) == 0.0 {
                        places[..count].iter().for_each(|i| z[*i] = 0.0);
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

    fn radius(friction: f64, on: Option<usize>, known_normal: f64, z: &[f64]) -> f64 {
        (friction * (on.map_or(0.0, |on| z[on]) + known_normal)).max(0.0)
    }

    fn towards(&self, places: &[usize], radius: f64, z: &[f64]) -> Towards {
        let mut y = [0.0; 2];
        for (y, &i) in y.iter_mut().zip(places) {
            *y = z[i] - self.rate(i, z);
        }
        Towards {
            y,
            length: norm(&y),
            radius,
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
                Part::Disc {
                    places,
                    count,
                    friction,
                    on,
                    known_normal,
                } => {
                    let places = &places[..count];
                    let radius = Self::radius(friction, on, known_normal, z);
                    let towards = self.towards(places, radius, z);
                    let factor = if towards.slips() {
                        radius / towards.length
                    } else {
                        1.0
                    };
                    for (&i, y) in places.iter().zip(towards.y) {
                        write(i, z[i] - factor * y);
                    }
                }
            }
        }
    }

    /// Newton's method from `z`; the best that has been found so far is that of `work`.
    ///
    /// Where contacts depend on each other the equations have no single solution: the diagonal of `A` is enlarged by a multiple of Φ, as if every contact yielded a
    /// little from where it is, which leaves the forces as they are that change nothing. (D. H. Li, M. Fukushima, L. Qi, N. Yamashita, Comput. Optim. Appl. 28 (2004)
    /// 131–147.)
    fn polish(&self, z: &[f64], (pace, steps): (Pace, usize), work: &mut Workspace) {
        let Workspace {
            best,
            missed: least,
            newton,
            ..
        } = work;
        let Newton {
            z: now,
            next,
            phi,
            slopes,
            by,
            lu,
        } = newton;
        let mut note = |z: &[f64], missed: f64| {
            if missed < *least {
                *least = missed;
                best.copy_from_slice(z);
            }
        };
        let n = self.n();
        now.clear();
        now.extend_from_slice(z);
        next.clear();
        next.resize(n, 0.0);
        phi.clear();
        phi.resize(n, 0.0);
        let mut missed = self.residual(now, phi);
        note(now, missed);
        let (mut yielding, mut stalled) = (YIELDING * missed, 0);
        let (most_yielding, most_stalled) = pace.limits();
        for _ in 0..steps {
            if missed <= ENOUGH || stalled > most_stalled {
                return;
            }
            yielding = yielding.clamp(LEAST_YIELDING, most_yielding);
            self.write_slopes(now, yielding, slopes);
            by.clear();
            by.extend_from_slice(phi);
            if !factor_rows(slopes, n, lu) {
                return;
            }
            lu.solve([by]);
            if by.iter().any(|x| !x.is_finite()) {
                return;
            }
            // The whole step is taken, or as much of it as makes Φ smaller.
            let mut factor = 1.0;
            let mut then = f64::INFINITY;
            for _ in 0..HALVINGS {
                for ((next, now), by) in next.iter_mut().zip(&*now).zip(&*by) {
                    *next = now - factor * by;
                }
                then = self.residual(next, phi);
                note(next, then);
                if then < missed {
                    break;
                }
                factor *= 0.5;
            }
            if !then.is_finite() {
                return;
            }
            let is_less = then < missed;
            stalled = if is_less { 0 } else { stalled + 1 };
            if pace == Pace::Cautious && !is_less && yielding < most_yielding {
                yielding = MORE_YIELDING * yielding.max(FIRST_YIELDING);
                self.residual(now, phi);
                continue;
            }
            let of_residual = YIELDING * then;
            yielding = match pace {
                Pace::Bold => of_residual,
                Pace::Cautious if is_less => of_residual.min(LESS_YIELDING * yielding),
                Pace::Cautious => yielding,
            };
            core::mem::swap(now, next);
            missed = then;
        }
    }

    /// Writes the derivatives of `Φ`, row after row, with contacts that yield.
    fn write_slopes(&self, z: &[f64], yielding: f64, slopes: &mut Vec<f64>) {
        let n = self.n();
        slopes.clear();
        slopes.resize(n * n, 0.0);
        for part in &self.parts {
            match *part {
                Part::Normal(i) => {
                    let row = &mut slopes[i * n..][..n];
                    if z[i] - self.rate(i, z) > 0.0 {
                        row.copy_from_slice(self.row(i));
                        row[i] += yielding;
                    } else {
                        row[i] = 1.0;
                    }
                }
                Part::Disc {
                    places,
                    count,
                    friction,
                    on,
                    known_normal,
                } => {
                    let places = &places[..count];
                    let radius = Self::radius(friction, on, known_normal, z);
                    let towards = self.towards(places, radius, z);
                    for (k, &i) in places.iter().enumerate() {
                        let row = &mut slopes[i * n..][..n];
                        if !towards.slips() {
                            row.copy_from_slice(self.row(i));
                            row[i] += yielding;
                            continue;
                        }
                        row[i] = 1.0;
                        if radius == 0.0 {
                            continue;
                        }
                        let unit = |k: usize| towards.y[k] / towards.length;
                        // z − r y/|y| with y = z − γ.
                        for (l, &j) in places.iter().enumerate() {
                            let same = if k == l { 1.0 } else { 0.0 };
                            let turns = radius / towards.length * (same - unit(k) * unit(l));
                            row[j] -= turns * (1.0 - yielding);
                            for (slope, a) in row.iter_mut().zip(self.row(j)) {
                                *slope += turns * a;
                            }
                        }
                        if let Some(on) = on {
                            row[on] -= friction * unit(k);
                        }
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
            let known = work.missed;
            work.interior.next(&mut z, round == 0);
            self.polish(&z, (Pace::Bold, STEPS), work);
            if work.missed > GOOD {
                self.polish(&z, (Pace::Cautious, STEPS), work);
            }
            if work.is_done_since(known) {
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
                if let Part::Disc { friction, .. } = part_of_contact {
                    *friction *= part as f64 / FRICTIONS as f64;
                }
            }
            own.best.clone_from(&z);
            own.missed = some.relative_residual(&z);
            some.polish(&z, (Pace::Bold, STEPS), &mut own);
            for _ in 0..SWEEPS_OF_FRICTION {
                if own.missed <= GOOD || some.sweep(&mut z) <= f64::EPSILON {
                    break;
                }
            }
            some.polish(&z, (Pace::Bold, STEPS), &mut own);
            z.copy_from_slice(&own.best);
        }
        let missed = self.relative_residual(&z);
        if missed < work.missed {
            work.missed = missed;
            work.best.copy_from_slice(&z);
        }
    }

    /// Solves every contact once, with the others as they are. By how much that changes the forces.
    fn sweep(&self, z: &mut [f64]) -> f64 {
        let mut moved = 0.0_f64;
        let mut replace = |z: &mut [f64], places: &[usize], found: &[f64]| {
            for (&i, value) in places.iter().zip(found) {
                moved = moved.max((value - z[i]).abs());
                z[i] = *value;
            }
        };
        // The disc that belongs to the normal force before it, which is solved with that.
        let mut solved = None;
        for (index, part) in self.parts.iter().enumerate() {
            match *part {
                Part::Normal(i) => {
                    let mut all = [i; 3];
                    let (mut count, mut law) = (1, (0.0, 0.0));
                    if let Some(&Part::Disc {
                        places,
                        count: tangents,
                        friction,
                        on: Some(on),
                        known_normal,
                    }) = self.parts.get(index + 1)
                        && on == i
                    {
                        all[1..].copy_from_slice(&places);
                        (count, law) = (1 + tangents, (friction, known_normal));
                        solved = Some(index + 1);
                    }
                    let found = self.single_contact_forces(&all[..count], law, z);
                    replace(z, &all[..count], &found);
                }
                Part::Disc { .. } if solved == Some(index) => {}
                Part::Disc {
                    places,
                    count,
                    friction,
                    on,
                    known_normal,
                } => {
                    let places = &places[..count];
                    let radius = Self::radius(friction, on, known_normal, z);
                    let own = self.local(places, z);
                    let found = own.on_disc(radius);
                    replace(z, places, &found[..count]);
                }
            }
        }
        moved
    }

    /// The problem of up to three directions alone.
    fn local(&self, places: &[usize], z: &[f64]) -> Local {
        let mut local = Local {
            dimension: places.len(),
            ..Local::default()
        };
        for (k, &i) in places.iter().enumerate() {
            let row = self.row(i);
            let mut own = 0.0;
            for (l, &j) in places.iter().enumerate() {
                local.w[k][l] = row[j];
                own += row[j] * z[j];
            }
            local.q[k] = self.rate(i, z) - own;
            local.z[k] = z[i];
        }
        local
    }

    /// The forces of one contact, normal and tangents, with all others as they are: as many as it has places.
    fn single_contact_forces(
        &self,
        places: &[usize],
        (friction, known_normal): (f64, f64),
        z: &[f64],
    ) -> [f64; 3] {
        self.local(places, z).forces(friction, known_normal)
    }
}

/// The directions of one contact: rates without their forces, what these change, and what the forces are now.
#[derive(Clone, Copy, Debug, Default)]
struct Local {
    dimension: usize,
    w: [[f64; 3]; 3],
    q: [f64; 3],
    z: [f64; 3],
}

impl Local {
    /// The forces that solve the problem of a contact whose first direction is its normal.
    fn forces(&self, friction: f64, known_normal: f64) -> [f64; 3] {
        let Local { w, q, .. } = self;
        let m = self.dimension;
        if m == 1 {
            return [(-q[0] / w[0][0]).max(0.0), 0.0, 0.0];
        }
        if known_normal <= 0.0 {
            if q[0] >= 0.0 {
                return [0.0; 3];
            }
        } else {
            // The friction of what is beside the normal force acts even where the contact opens, and may open it.
            let rest = self.without_normal().on_disc(friction * known_normal);
            let found = [0.0, rest[0], rest[1]];
            if q[0] + dot(&w[0], &found) >= 0.0 {
                return found;
            }
        }
        // Nothing slips.
        let held = self.held();
        let most = friction * (held[0] + known_normal);
        if held[0] >= 0.0 && norm(&held[1..]) <= most {
            return held;
        }
        self.slipping(friction, known_normal).unwrap_or_else(|| {
            // None is found: a small step towards one.
            let towards = |k: usize| self.z[k] - 0.5 * (q[k] + dot(&w[k], &self.z));
            let normal = towards(0).max(0.0);
            let radius = friction * (normal + known_normal);
            let mut found = [normal, 0.0, 0.0];
            (1..m).for_each(|k| found[k] = towards(k));
            let length = norm(&found[1..]);
            if length > radius {
                let factor = radius / length;
                found[1..].iter_mut().for_each(|y| *y *= factor);
            }
            found
        })
    }

    /// The same tangents alone.
    fn without_normal(&self) -> Local {
        let moved = |x: [f64; 3]| [x[1], x[2], 0.0];
        Local {
            dimension: self.dimension - 1,
            w: [moved(self.w[1]), moved(self.w[2]), [0.0; 3]],
            q: moved(self.q),
            z: moved(self.z),
        }
    }

    /// The forces with which none of the directions moves.
    fn held(&self) -> [f64; 3] {
        let m = self.dimension;
        // The matrix is a symmetric one with rows that are multiplied, so that no rows need to be exchanged.
        let mut u = self.w;
        let mut held = self.q.map(|q| -q);
        let is_regular = (0..m).all(|k| {
            let (pivot, of_pivot) = (u[k], held[k]);
            for (row, right) in u[k + 1..m].iter_mut().zip(&mut held[k + 1..m]) {
                let factor = row[k] / pivot[k];
                for (x, above) in row.iter_mut().zip(pivot).skip(k + 1) {
                    *x -= factor * above;
                }
                *right -= factor * of_pivot;
            }
            pivot[k] > DEPENDENT * self.w[k][k]
        });
        if is_regular {
            held[m..].fill(0.0);
            for i in (0..m).rev() {
                let known = dot(&u[i][i + 1..m], &held[i + 1..m]);
                held[i] = (held[i] - known) / u[i][i];
            }
            return held;
        }
        let mut left: Vec<f64> = (0..m * m).map(|k| self.w[k / m][k % m]).collect();
        let (found, _) = lcp::solve(&mut left, &mut self.q.map(|q| -q)[..m]);
        held = [0.0; 3];
        held[..m].copy_from_slice(&found);
        held
    }

    /// The forces of a contact that slips: with `Λₜ = −r e` and `γₙ = 0` its slip is along the direction e. There may be several, of which the one in the direction
    /// of now is taken, or else the one with the least normal force.
    ///
    /// With `R = Λₙ + Λ₀` and `c = wₙₙ − μ wₙₜ·e > 0` the normal condition is `R c = wₙₙ Λ₀ − qₙ`, and c times the slip is an affine function of e.
    fn slipping(&self, friction: f64, known_normal: f64) -> Option<[f64; 3]> {
        let Local { w, q, .. } = self;
        let lift = q[0] - w[0][0] * known_normal;
        let side = [1, 2].map(|i| q[i] - w[i][0] * known_normal);
        let slip = AffineSlip {
            constant: [0, 1].map(|i| side[i] * w[0][0] - lift * w[i + 1][0]),
            linear: [0, 1].map(|i| {
                [0, 1].map(|j| friction * (lift * w[i + 1][j + 1] - side[i] * w[0][j + 1]))
            }),
        };
        let share = |e: [f64; 2]| w[0][0] - friction * (w[0][1] * e[0] + w[0][2] * e[1]);
        let forces = |e: [f64; 2]| {
            let own = share(e);
            let sum = -lift / own;
            let normal = sum - known_normal;
            (own > 0.0 && normal >= 0.0)
                .then(|| [normal, -friction * sum * e[0], -friction * sum * e[1]])
        };
        slip.along_itself(self.dimension - 1, [self.z[1], self.z[2]], true, forces)
    }

    /// Tangential forces of which is known how large they may be together.
    fn on_disc(&self, radius: f64) -> [f64; 3] {
        let held = self.held();
        if norm(&held) <= radius {
            return held;
        }
        let Local { w, q, .. } = self;
        let slip = AffineSlip {
            constant: [q[0], q[1]],
            linear: [0, 1].map(|i| [0, 1].map(|j| -radius * w[i][j])),
        };
        let forces = |e: [f64; 2]| Some([-radius * e[0], -radius * e[1], 0.0]);
        slip.along_itself(self.dimension, [self.z[0], self.z[1]], false, forces)
            .unwrap_or_else(|| {
                let length = norm(&held);
                held.map(|held| held * radius / length)
            })
    }
}

/// The slip of a contact, or a positive multiple of it, as a function of a direction: friction acts against that.
struct AffineSlip {
    constant: [f64; 2],
    linear: [[f64; 2]; 2],
}

impl AffineSlip {
    fn at(&self, e: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| self.constant[i] + self.linear[i][0] * e[0] + self.linear[i][1] * e[1])
    }

    /// How far the slip is to the left of the direction: 0 where it is along it, or against it.
    fn aside(&self, e: [f64; 2]) -> f64 {
        let slip = self.at(e);
        e[0] * slip[1] - e[1] * slip[0]
    }

    /// The forces, which may exclude a direction, where the slip is along the direction. Of several solutions it is that near the friction force of now, or else
    /// that with the least of the first force, if this `has_normal`.
    fn along_itself(
        &self,
        dimension: usize,
        now: [f64; 2],
        has_normal: bool,
        forces: impl Fn([f64; 2]) -> Option<[f64; 3]>,
    ) -> Option<[f64; 3]> {
        let is_along = |e: [f64; 2]| {
            let slip = self.at(e);
            e[0] * slip[0] + e[1] * slip[1] >= 0.0
        };
        if dimension == 1 {
            let along = |sign: f64| {
                let found = forces([sign, 0.0])?;
                is_along([sign, 0.0]).then_some(found)
            };
            return along(1.0).or_else(|| along(-1.0));
        }
        if let Some(e) = self.near(now).filter(|e| is_along(*e))
            && let Some(found) = forces(e)
        {
            return Some(found);
        }
        let mut best: Option<[f64; 3]> = None;
        let mut from = [1.0, 0.0];
        let mut before = self.aside(from);
        for _ in 0..DIRECTIONS {
            let to = [
                from[0] * TURN[0] - from[1] * TURN[1],
                from[0] * TURN[1] + from[1] * TURN[0],
            ];
            let after = self.aside(to);
            let (sector, [low, high]) = ([from, to], [before, after]);
            (from, before) = (to, after);
            if low != 0.0 && (low > 0.0) == (high > 0.0) {
                continue;
            }
            let e = zero_between(sector, [low, high], |e| self.aside(e));
            let Some(found) = forces(e).filter(|_| is_along(e)) else {
                continue;
            };
            let is_less = best.as_ref().is_none_or(|best| found[0] < best[0]);
            if !has_normal || is_less {
                best = Some(found);
            }
        }
        best
    }

    /// The direction of a friction force, corrected by Newton's method so that the slip is along it or against it; none if that fails.
    fn near(&self, force: [f64; 2]) -> Option<[f64; 2]> {
        let length = norm(&force);
        if length == 0.0 {
            return None;
        }
        let mut e = force.map(|x| -x / length);
        let [[a, b], [c, d]] = self.linear;
        for _ in 0..MOST_CORRECTIONS {
            let slip = self.at(e);
            let value = e[0] * slip[1] - e[1] * slip[0];
            // A turn to the left changes the direction by `(−e₁, e₀)`.
            let turned = [-e[1], e[0]];
            let change = [a * turned[0] + b * turned[1], c * turned[0] + d * turned[1]];
            let slope =
                turned[0] * slip[1] - turned[1] * slip[0] + e[0] * change[1] - e[1] * change[0];
            let angle = -value / slope;
            if angle.is_nan() || angle.abs() > GREATEST_CORRECTION {
                return None;
            }
            e = [e[0] + angle * turned[0], e[1] + angle * turned[1]];
            let length = norm(&e);
            e = e.map(|x| x / length);
            if angle.abs() <= 4.0 * f64::EPSILON {
                return Some(e);
            }
        }
        None
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

/// The direction between two, at which a function has these values of different signs, where it is 0. By the regula falsi, in which the value at an end that
/// stays twice is halved (M. Dowell, P. Jarratt, BIT 11 (1971) 168–174), to rounding: what is found is the start of Newton's method, or a contact alone.
fn zero_between(
    ends: [[f64; 2]; 2],
    [mut low, mut high]: [f64; 2],
    function: impl Fn([f64; 2]) -> f64,
) -> [f64; 2] {
    let [from, to] = ends;
    let direction = |part: f64| {
        let e = [0, 1].map(|i| (1.0 - part) * from[i] + part * to[i]);
        let length = (e[0] * e[0] + e[1] * e[1]).sqrt();
        e.map(|e| e / length)
    };
    if low == 0.0 {
        return from;
    }
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    let mut found = 0.5;
    let mut replaced_first = None;
    for _ in 0..MOST_ESTIMATES {
        let estimate = first + (last - first) * (low / (low - high));
        let estimate = if estimate > first && estimate < last {
            estimate
        } else {
            0.5 * (first + last)
        };
        let moved = (estimate - found).abs();
        found = estimate;
        let value = function(direction(found));
        if value == 0.0 || moved <= f64::EPSILON || last - first <= f64::EPSILON {
            break;
        }
        let is_first = (value > 0.0) == (low > 0.0);
        if is_first {
            (first, low) = (found, value);
        } else {
            (last, high) = (found, value);
        }
        if replaced_first == Some(is_first) {
            let kept = if is_first { &mut high } else { &mut low };
            *kept *= 0.5;
        }
        replaced_first = Some(is_first);
    }
    direction(found)
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
                Part::Disc {
                    places: [3 * k + 1, 3 * k + 2],
                    count: 2,
                    friction,
                    on: Some(3 * k),
                    known_normal: 0.0,
                },
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
                Part::Disc {
                    places,
                    friction,
                    on,
                    known_normal,
                    ..
                } => {
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
                if let Part::Disc { known_normal, .. } = part {
                    *known_normal = known;
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
            let disc = Part::Disc {
                places: [1, 2],
                count: 2,
                friction: 0.5,
                on: Some(0),
                known_normal: 0.0,
            };
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
