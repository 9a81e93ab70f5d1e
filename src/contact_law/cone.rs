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
//! (P. Alart, A. Curnier, Comput. Methods Appl. Mech. Eng. 92 (1991) 353–375.) Sweeps over the contacts, each solved exactly with
//! the others as they are, find which of them are open, stick and slip (M. Jean, Comput. Methods Appl. Mech. Eng. 177 (1999)
//! 235–257); Newton's method on Φ then finds the numbers to rounding. Both are repeated, with more and more sweeps, until Φ is
//! rounding, or it is said that it is not.

use std::vec;
use std::vec::Vec;

use super::lcp::{self, Unsolved};

/// What Φ is of a solution, relative to the size of the terms.
const GOOD: f64 = 1e-13;

/// With how much of it a solution is still one: what rounding leaves where contacts depend on each other.
const TOLERABLE: f64 = 1e-10;

/// Sweeps before the first try of Newton's method; each further time there are twice as many.
const FIRST_SWEEPS: usize = 8;

/// How often sweeps and Newton's method follow each other: some 4000 sweeps in all.
const ROUNDS: usize = 9;

/// After so many of these, with 120 sweeps in all, a solution is followed from a small friction.
const ROUNDS_BEFORE_FRICTION_IS_FOLLOWED: usize = 4;

/// A solution that is good enough is not improved further if a round leaves more than this share of Φ.
const LESS: f64 = 0.1;

/// The most steps of Newton's method in one round.
const STEPS: usize = 40;

/// In so many steps friction grows where a solution is followed from a small one, with at most so many sweeps in each.
const FRICTIONS: usize = 16;
const SWEEPS_OF_FRICTION: usize = 64;

/// Directions in which the friction of one contact is looked for first.
const DIRECTIONS: usize = 48;

/// The cosine and the sine of the angle between two of these.
const TURN: [f64; 2] = [0.991_444_861_373_810_4, 0.130_526_192_220_051_57];

/// The most estimates of a direction between two of these.
const MOST_ESTIMATES: usize = 60;

/// A normal direction, or the tangent or both tangents of a contact.
#[derive(Clone, Debug)]
pub(super) enum Part {
    /// The place of a normal force among the unknowns.
    Normal(usize),
    /// The places of one or two tangential forces, which together are no greater than `μ` times the force at `on`, if there is
    /// one, and `known_normal` that.
    Disc {
        places: Vec<usize>,
        friction: f64,
        on: Option<usize>,
        known_normal: f64,
    },
}

/// Unknown forces `z`, of which `γ = A z + b`. `A` has ones, or numbers about as large, on its diagonal, and `b` is at most 1.
#[derive(Clone, Debug)]
pub(super) struct Problem {
    pub matrix: Vec<f64>,
    pub b: Vec<f64>,
    pub parts: Vec<Part>,
}

/// Forces that solve the problem, and by how much they miss a condition. The search begins with the forces `z`.
pub(super) fn solve(problem: &Problem, mut z: Vec<f64>) -> Result<(Vec<f64>, f64), Unsolved> {
    let is_finite = |values: &[f64]| values.iter().all(|x| x.is_finite());
    if !is_finite(&problem.b) || !is_finite(&problem.matrix) {
        return Err(Unsolved);
    }
    let mut best = (problem.relative_residual(&z), z.clone());
    // Of several solutions the one that is near: sweeps may leave it.
    if z.iter().any(|z| *z != 0.0) {
        problem.polish(&z, &mut best);
        if best.0 <= GOOD {
            return Ok((best.1, best.0));
        }
    }
    for round in 0..ROUNDS {
        // Where some hundred sweeps have found nothing, thousands seldom do.
        if round == ROUNDS_BEFORE_FRICTION_IS_FOLLOWED && best.0 > TOLERABLE {
            problem.follow_friction(&mut best);
            if best.0 <= GOOD {
                break;
            }
        }
        let known = best.0;
        for _ in 0..FIRST_SWEEPS << round {
            let moved = problem.sweep(&mut z);
            if moved <= f64::EPSILON {
                break;
            }
        }
        problem.polish(&z, &mut best);
        // Where contacts depend on each other, rounding may leave more than is good, which no further sweeps change.
        let is_stalled = best.0 <= TOLERABLE && best.0 > LESS * known;
        if best.0 <= GOOD || is_stalled {
            break;
        }
    }
    if best.0 <= TOLERABLE {
        Ok((best.1, best.0))
    } else {
        Err(Unsolved)
    }
}

impl Problem {
    fn n(&self) -> usize {
        self.b.len()
    }

    fn row(&self, i: usize) -> &[f64] {
        &self.matrix[i * self.n()..][..self.n()]
    }

    /// The rate of a direction with these forces.
    fn rate(&self, i: usize, z: &[f64]) -> f64 {
        let terms = self.row(i).iter().zip(z);
        terms.fold(self.b[i], |sum, (a, z)| sum + a * z)
    }

    fn radius(friction: f64, on: Option<usize>, known_normal: f64, z: &[f64]) -> f64 {
        (friction * (on.map_or(0.0, |on| z[on]) + known_normal)).max(0.0)
    }

    /// `Φ`, in the order of the unknowns.
    fn residual(&self, z: &[f64]) -> Vec<f64> {
        let mut phi = vec![0.0; self.n()];
        for part in &self.parts {
            match part {
                Part::Normal(i) => phi[*i] = z[*i] - (z[*i] - self.rate(*i, z)).max(0.0),
                Part::Disc {
                    places,
                    friction,
                    on,
                    known_normal,
                } => {
                    let radius = Self::radius(*friction, *on, *known_normal, z);
                    let towards = places.iter().map(|&i| z[i] - self.rate(i, z));
                    let towards: Vec<f64> = towards.collect();
                    let length = norm(&towards);
                    let factor = if length > radius {
                        radius / length
                    } else {
                        1.0
                    };
                    for (&i, y) in places.iter().zip(&towards) {
                        phi[i] = z[i] - factor * y;
                    }
                }
            }
        }
        phi
    }

    /// The greatest part of `Φ`, relative to the size of forces and rates.
    fn relative_residual(&self, z: &[f64]) -> f64 {
        let size = z.iter().fold(1.0_f64, |size, z| size.max(z.abs()));
        let phi = self.residual(z);
        phi.iter().fold(0.0_f64, |most, phi| most.max(phi.abs())) / size
    }

    /// Newton's method from `z`; `best` is the best that has been found so far.
    fn polish(&self, z: &[f64], best: &mut (f64, Vec<f64>)) {
        let mut z = z.to_vec();
        let mut note = |z: &[f64]| {
            let missed = self.relative_residual(z);
            if missed < best.0 {
                *best = (missed, z.to_vec());
            }
            missed
        };
        let mut missed = note(&z);
        let mut stalled = 0;
        for _ in 0..STEPS {
            if missed == 0.0 || stalled > 3 {
                return;
            }
            let mut phi = self.residual(&z);
            let mut slopes = self.slopes(&z);
            let (by, _) = lcp::solve(&mut slopes, &mut phi);
            // The whole step, or as much of it as makes Φ smaller.
            let mut factor = 1.0;
            let (mut next, mut then) = (z.clone(), f64::INFINITY);
            for _ in 0..6 {
                next = z.iter().zip(&by).map(|(z, by)| z - factor * by).collect();
                then = note(&next);
                if then < missed {
                    break;
                }
                factor *= 0.5;
            }
            if !then.is_finite() {
                return;
            }
            stalled = if then < missed { 0 } else { stalled + 1 };
            (z, missed) = (next, then);
        }
    }

    /// Follows a solution as friction grows from a part of what it is to all of it: without friction sweeps always converge. `best` is the best that has been
    /// found so far.
    fn follow_friction(&self, best: &mut (f64, Vec<f64>)) {
        let mut z = vec![0.0; self.n()];
        for part in 1..=FRICTIONS {
            let mut some = self.clone();
            for part_of_contact in &mut some.parts {
                if let Part::Disc { friction, .. } = part_of_contact {
                    *friction *= part as f64 / FRICTIONS as f64;
                }
            }
            let mut own = (some.relative_residual(&z), z.clone());
            some.polish(&z, &mut own);
            for _ in 0..SWEEPS_OF_FRICTION {
                if own.0 <= GOOD || some.sweep(&mut z) <= f64::EPSILON {
                    break;
                }
            }
            some.polish(&z, &mut own);
            z = own.1;
        }
        let missed = self.relative_residual(&z);
        if missed < best.0 {
            *best = (missed, z);
        }
    }

    /// The derivatives of `Φ`, row after row.
    fn slopes(&self, z: &[f64]) -> Vec<f64> {
        let n = self.n();
        let mut slopes = vec![0.0; n * n];
        for part in &self.parts {
            match part {
                Part::Normal(i) => {
                    let presses = z[*i] - self.rate(*i, z) > 0.0;
                    let row = &mut slopes[i * n..][..n];
                    if presses {
                        row.copy_from_slice(self.row(*i))
                    } else {
                        row[*i] = 1.0
                    }
                }
                Part::Disc {
                    places,
                    friction,
                    on,
                    known_normal,
                } => {
                    let radius = Self::radius(*friction, *on, *known_normal, z);
                    let towards = places.iter().map(|&i| z[i] - self.rate(i, z));
                    let towards: Vec<f64> = towards.collect();
                    let length = norm(&towards);
                    for (k, &i) in places.iter().enumerate() {
                        let row = i * n;
                        if length <= radius {
                            slopes[row..][..n].copy_from_slice(self.row(i));
                            continue;
                        }
                        slopes[row + i] = 1.0;
                        if radius == 0.0 {
                            continue;
                        }
                        let unit = |k: usize| towards[k] / length;
                        // z − r y/|y| with y = z − γ.
                        for (l, &j) in places.iter().enumerate() {
                            let same = if k == l { 1.0 } else { 0.0 };
                            let turns = radius / length * (same - unit(k) * unit(l));
                            slopes[row + j] -= turns;
                            for (slope, a) in slopes[row..][..n].iter_mut().zip(self.row(j)) {
                                *slope += turns * a;
                            }
                        }
                        if let Some(on) = on {
                            slopes[row + on] -= friction * unit(k);
                        }
                    }
                }
            }
        }
        slopes
    }

    /// Solves every contact once, with the others as they are. By how much that changes the forces.
    fn sweep(&self, z: &mut [f64]) -> f64 {
        let mut moved = 0.0_f64;
        let mut solved = vec![false; self.n()];
        for (index, part) in self.parts.iter().enumerate() {
            match part {
                Part::Normal(i) => {
                    let own = self.parts.get(index + 1).and_then(|next| match next {
                        Part::Disc {
                            places,
                            friction,
                            on: Some(on),
                            known_normal,
                        } if on == i => Some((places, *friction, *known_normal)),
                        _ => None,
                    });
                    let (places, friction, known_normal) = match &own {
                        Some((places, friction, known_normal)) => {
                            (places.as_slice(), *friction, *known_normal)
                        }
                        None => (&[][..], 0.0, 0.0),
                    };
                    let mut all = [*i; 3];
                    all[1..=places.len()].copy_from_slice(places);
                    let all = &all[..=places.len()];
                    let found = self.single_contact_forces(all, friction, known_normal, z);
                    for (&i, value) in all.iter().zip(found) {
                        moved = moved.max((value - z[i]).abs());
                        (z[i], solved[i]) = (value, true);
                    }
                }
                Part::Disc {
                    places,
                    friction,
                    on,
                    known_normal,
                } if !solved[places[0]] => {
                    let radius = Self::radius(*friction, *on, *known_normal, z);
                    let found = self.on_disc(places, radius, z);
                    for (&i, value) in places.iter().zip(found) {
                        moved = moved.max((value - z[i]).abs());
                        z[i] = value;
                    }
                }
                Part::Disc { .. } => {}
            }
        }
        moved
    }

    /// The rates of up to three directions without the forces along these.
    fn rates_without(&self, places: &[usize], z: &[f64]) -> [f64; 3] {
        let own = |i: usize| {
            let row = self.row(i);
            places.iter().map(|&j| row[j] * z[j]).sum::<f64>()
        };
        let mut rates = [0.0; 3];
        for (rate, &i) in rates.iter_mut().zip(places) {
            *rate = self.rate(i, z) - own(i);
        }
        rates
    }

    /// The forces of one contact, normal and tangents, with all others as they are: as many as it has places.
    fn single_contact_forces(
        &self,
        places: &[usize],
        friction: f64,
        known_normal: f64,
        z: &[f64],
    ) -> [f64; 3] {
        let m = places.len();
        let w = |i: usize, j: usize| self.matrix[places[i] * self.n() + places[j]];
        let q = self.rates_without(places, z);
        // What is beside the normal force rubs even where the contact opens.
        if q[0] >= 0.0 {
            let mut found = [0.0; 3];
            if known_normal > 0.0 && m > 1 {
                let mut open = z.to_vec();
                open[places[0]] = 0.0;
                let rest = self.on_disc(&places[1..], friction * known_normal, &open);
                found[1..].copy_from_slice(&rest);
                let rate = (1..m).fold(q[0], |rate, j| rate + w(0, j) * found[j]);
                if rate >= 0.0 {
                    return found;
                }
            } else {
                return found;
            }
        }
        if m == 1 {
            return [(-q[0] / w(0, 0)).max(0.0), 0.0, 0.0];
        }
        // Nothing slips.
        let held = self.held(places, &q);
        let most = friction * (held[0] + known_normal);
        if held[0] >= 0.0 && norm(&held[1..m]) <= most {
            return held;
        }
        // It slips in a direction e: with Λₜ = −r e and γₙ = 0, γₜ is to lie along e.
        let slipping = |e: [f64; 2]| -> Option<([f64; 3], [f64; 2])> {
            let against = |i: usize| (1..m).map(|j| w(i, j) * e[j - 1]).sum::<f64>();
            let given = friction * known_normal;
            let own = w(0, 0) - friction * against(0);
            let normal = -(q[0] - given * against(0)) / own;
            if own <= 0.0 || normal < 0.0 {
                return None;
            }
            let radius = friction * normal + given;
            let (mut forces, mut slip) = ([normal, 0.0, 0.0], [0.0; 2]);
            for i in 1..m {
                forces[i] = -radius * e[i - 1];
                slip[i - 1] = q[i] + w(i, 0) * normal - radius * against(i);
            }
            Some((forces, slip))
        };
        slipping_direction(m - 1, true, slipping).unwrap_or_else(|| {
            // None is found: a small step towards one.
            let normal = (z[places[0]] - 0.5 * self.rate(places[0], z)).max(0.0);
            let radius = friction * (normal + known_normal);
            let mut found = [normal, 0.0, 0.0];
            for (towards, &i) in found[1..].iter_mut().zip(&places[1..]) {
                *towards = z[i] - 0.5 * self.rate(i, z);
            }
            let length = norm(&found[1..m]);
            if length > radius {
                let factor = radius / length;
                found[1..].iter_mut().for_each(|y| *y *= factor);
            }
            found
        })
    }

    /// The forces of one contact with which none of its directions moves at these rates without them.
    fn held(&self, places: &[usize], q: &[f64; 3]) -> [f64; 3] {
        let m = places.len();
        let mut left = [0.0; 9];
        for (k, entry) in left[..m * m].iter_mut().enumerate() {
            *entry = self.matrix[places[k / m] * self.n() + places[k % m]];
        }
        let mut right = q.map(|q| -q);
        let (found, _) = lcp::solve(&mut left[..m * m], &mut right[..m]);
        let mut held = [0.0; 3];
        held[..m].copy_from_slice(&found);
        held
    }

    /// Tangential forces of which is known how large they may be together, with all others as they are: as many as there are places.
    fn on_disc(&self, places: &[usize], radius: f64, z: &[f64]) -> [f64; 2] {
        let m = places.len();
        let w = |i: usize, j: usize| self.matrix[places[i] * self.n() + places[j]];
        let q = self.rates_without(places, z);
        let [first, second, _] = self.held(places, &q);
        let held = [first, second];
        if norm(&held[..m]) <= radius {
            return held;
        }
        let slipping = |e: [f64; 2]| {
            let (mut forces, mut slip) = ([0.0; 3], [0.0; 2]);
            for (force, e) in forces[..m].iter_mut().zip(e) {
                *force = -radius * e;
            }
            for i in 0..m {
                slip[i] = (0..m).fold(q[i], |slip, j| slip + w(i, j) * forces[j]);
            }
            Some((forces, slip))
        };
        match slipping_direction(m, false, slipping) {
            Some([first, second, _]) => [first, second],
            None => {
                let length = norm(&held[..m]);
                held.map(|held| held * radius / length)
            }
        }
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().fold(0.0_f64, |length, x| length.hypot(*x))
}

/// The direction `e` in which a contact slips along itself, of those with the least normal force if there are several and its normal force depends on them: what
/// its forces then are. `slipping` gives these for a direction, and how the contact then slips.
fn slipping_direction(
    dimension: usize,
    has_normal: bool,
    slipping: impl Fn([f64; 2]) -> Option<([f64; 3], [f64; 2])>,
) -> Option<[f64; 3]> {
    if dimension == 1 {
        let along = |sign: f64| {
            let (forces, slip) = slipping([sign, 0.0])?;
            (sign * slip[0] >= 0.0).then_some(forces)
        };
        return along(1.0).or_else(|| along(-1.0));
    }
    // How far the slip is to the left of the direction: 0 where it is along it, or against it.
    let aside = |e: [f64; 2]| {
        let (_, slip) = slipping(e)?;
        Some(e[0] * slip[1] - e[1] * slip[0])
    };
    let mut best: Option<[f64; 3]> = None;
    let mut from = [1.0, 0.0];
    let mut before = aside(from);
    for _ in 0..DIRECTIONS {
        let to = [
            from[0] * TURN[0] - from[1] * TURN[1],
            from[0] * TURN[1] + from[1] * TURN[0],
        ];
        let after = aside(to);
        let sector = [from, to];
        let values = (before, after);
        (from, before) = (to, after);
        let (Some(low), Some(high)) = values else {
            continue;
        };
        if low != 0.0 && (low > 0.0) == (high > 0.0) {
            continue;
        }
        let e = zero_between(sector, [low, high], aside);
        let Some((forces, slip)) = slipping(e) else {
            continue;
        };
        let is_along = e[0] * slip[0] + e[1] * slip[1] >= 0.0;
        let is_less = best.as_ref().is_none_or(|best| forces[0] < best[0]);
        if is_along && (!has_normal || is_less) {
            best = Some(forces);
        }
    }
    best
}

/// The direction between two, at which a function has these values of different signs, where it is 0. By the regula falsi, in which the value at an end that
/// stays twice is halved (M. Dowell, P. Jarratt, BIT 11 (1971) 168–174), to rounding: what is found is the start of Newton's method, or a contact alone.
fn zero_between(
    ends: [[f64; 2]; 2],
    [mut low, mut high]: [f64; 2],
    function: impl Fn([f64; 2]) -> Option<f64>,
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
        let Some(value) = function(direction(found)) else {
            break;
        };
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
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let v: Vec<f64> = (0..rank).map(|_| drawn(seed)).collect();
        let parts = (0..count).flat_map(|k| {
            [
                Part::Normal(3 * k),
                Part::Disc {
                    places: vec![3 * k + 1, 3 * k + 2],
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
        }
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
            let found = solve(&problem, vec![0.0; problem.n()]);
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

    /// A point mass on a table: what friction takes of its slip is along the slip, and no more than there is.
    #[test]
    fn a_point_is_stopped_or_braked_along_its_slip() {
        for (slip, presses) in [([0.3, 0.4], 2.0), ([0.3, 0.4], 0.5), ([0.0, -0.7], 0.2)] {
            let mut matrix = vec![0.0; 9];
            (0..3).for_each(|i| matrix[4 * i] = 1.0);
            let disc = Part::Disc {
                places: vec![1, 2],
                friction: 0.5,
                on: Some(0),
                known_normal: 0.0,
            };
            let problem = Problem {
                matrix,
                b: vec![-presses, slip[0], slip[1]],
                parts: vec![Part::Normal(0), disc],
            };
            let (z, _) = solve(&problem, vec![0.0; problem.n()]).expect("there is one solution");
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
        };
        assert!(solve(&problem, vec![0.0; problem.n()]).is_err());
    }
}
