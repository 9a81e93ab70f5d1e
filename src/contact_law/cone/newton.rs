//! Newton's method on Φ.

use std::vec::Vec;

use super::{Best, Part, Problem, Workspace, factor_rows};
use crate::implicit::lu::Lu;

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

/// Memory for Newton's method.
#[derive(Clone, Debug, Default)]
pub(super) struct Newton {
    z: Vec<f64>,
    next: Vec<f64>,
    phi: Vec<f64>,
    slopes: Vec<f64>,
    by: Vec<f64>,
    lu: Lu<1>,
}

impl Newton {
    fn begin(&mut self, z: &[f64]) {
        let Self {
            z: now, next, phi, ..
        } = self;
        now.clear();
        now.extend_from_slice(z);
        next.clear();
        next.resize(z.len(), 0.0);
        phi.clear();
        phi.resize(z.len(), 0.0);
    }

    /// Finds the step from Φ and its derivatives at the forces of now; whether there is one.
    fn find_step(&mut self, problem: &Problem, yielding: f64) -> bool {
        let Self {
            z,
            phi,
            slopes,
            by,
            lu,
            ..
        } = self;
        problem.write_slopes(z, yielding, slopes);
        by.clear();
        by.extend_from_slice(phi);
        if !factor_rows(slopes, z.len(), lu) {
            return false;
        }
        lu.solve([by]);
        by.iter().all(|x| x.is_finite())
    }

    /// Takes the whole step, or as much of it as makes Φ smaller than `missed`: Φ after it.
    fn shorten_step(&mut self, problem: &Problem, missed: f64, best: &mut Best) -> f64 {
        let Self {
            z, next, phi, by, ..
        } = self;
        let mut factor = 1.0;
        let mut then = f64::INFINITY;
        for _ in 0..HALVINGS {
            for ((next, now), by) in next.iter_mut().zip(&*z).zip(&*by) {
                *next = now - factor * by;
            }
            then = problem.residual(next, phi);
            best.note(next, then);
            if then < missed {
                break;
            }
            factor *= 0.5;
        }
        then
    }
}

/// How Newton's method goes on where a step makes Φ no smaller.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Pace {
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

impl Problem {
    /// Newton's method from `z`; the best that has been found so far is that of `work`.
    ///
    /// Where contacts depend on each other the equations have no single solution: the diagonal of `A` is enlarged by a multiple of Φ, as if every contact yielded a
    /// little from where it is, which leaves the forces as they are that change nothing. (D. H. Li, M. Fukushima, L. Qi, N. Yamashita, Comput. Optim. Appl. 28 (2004)
    /// 131–147.)
    pub(super) fn polish(&self, z: &[f64], (pace, steps): (Pace, usize), work: &mut Workspace) {
        let Workspace { best, newton, .. } = work;
        newton.begin(z);
        let mut missed = self.residual(&newton.z, &mut newton.phi);
        best.note(&newton.z, missed);
        let (mut yielding, mut stalled) = (YIELDING * missed, 0);
        let (most_yielding, most_stalled) = pace.limits();
        for _ in 0..steps {
            if missed <= ENOUGH || stalled > most_stalled {
                return;
            }
            yielding = yielding.clamp(LEAST_YIELDING, most_yielding);
            if !newton.find_step(self, yielding) {
                return;
            }
            let then = newton.shorten_step(self, missed, best);
            if !then.is_finite() {
                return;
            }
            let is_less = then < missed;
            stalled = if is_less { 0 } else { stalled + 1 };
            if pace == Pace::Cautious && !is_less && yielding < most_yielding {
                yielding = MORE_YIELDING * yielding.max(FIRST_YIELDING);
                self.residual(&newton.z, &mut newton.phi);
                continue;
            }
            let of_residual = YIELDING * then;
            yielding = match pace {
                Pace::Bold => of_residual,
                Pace::Cautious if is_less => of_residual.min(LESS_YIELDING * yielding),
                Pace::Cautious => yielding,
            };
            core::mem::swap(&mut newton.z, &mut newton.next);
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
                Part::Disc(disc) => {
                    let (places, towards) = (disc.places(), self.towards(&disc, z));
                    let radius = towards.radius;
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
                        if let Some(on) = disc.on {
                            row[on] -= disc.friction * unit(k);
                        }
                    }
                }
            }
        }
    }
}
