//! Forces that the equations of motion leave undetermined: whether contacts that depend on each other hold with some of them.
//!
//! Contacts at rest that depend on each other determine only sums of their forces: which of two blocks on a rod holds how much does not
//! follow from rigid bodies. They all hold if and only if *some* forces that satisfy the equations are admissible for every contact. With
//! the undetermined forces `y`, normal forces `Nᵢ(y)` and friction forces `Tᵢ(y)` are affine, and the shared margin
//!
//! ```text
//! s = max over y of min over i of  Nᵢ − |Tᵢ|/μ₀ᵢ     (Nᵢ where i does not stick)
//! ```
//!
//! is found by a programme, (E78). It is the force by which all normal forces could be smaller, it is a continuous function of time, and it
//! changes its sign where the contacts cease to hold. The contacts whose conditions have positive multipliers are those that limit it. (Limit
//! analysis: W. Prager, P. G. Hodge, *Theory of Perfectly Plastic Solids*, 1951, chapter 8; for friction R. K. Livesley, Int. J. Numer.
//! Methods Eng. 12 (1978) 1853–1871.)
//!
//! Where friction acts along one tangent the programme is linear. It is solved by the simplex method with the rule of R. G. Bland (Math. Oper.
//! Res. 2 (1977) 103–107), with which it does not cycle, in memory of the caller. Where it acts along two, it is solved by [`cones`].

mod cones;

/// What an undetermined force adds to the forces of a contact: along its normal and along two tangents, of which the plane has only the first.
pub(crate) const PARTS: usize = 3;

/// What counts as zero among coefficients about as large as 1.
const ZERO: f64 = 1e-11;

/// A friction force above this, relative to the greatest force, is more than rounding.
const MORE_THAN_ROUNDING: f64 = 1e-10;

/// What a row or a column is of: nothing that enters or leaves.
const NOTHING: usize = usize::MAX;

/// A force that has to be 0: the friction of a contact that has none.
const NO_FORCE: usize = usize::MAX - 1;

/// A contact among those that may share forces.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sharer {
    /// The coefficient of static friction, if it sticks.
    pub static_friction: Option<f64>,
    /// Whether it only presses, to the side of `normal`: if not, a contact without friction has no condition.
    pub presses: bool,
    /// Its normal force, positive where it presses, and its friction force, where the undetermined forces are 0.
    pub normal: f64,
    pub tangential: [f64; 2],
}

impl Sharer {
    /// The friction with which it sticks, if it has any.
    fn friction(&self) -> Option<f64> {
        self.static_friction.filter(|friction| *friction > 0.0)
    }

    /// Whether it sticks without friction, so that its friction force has to be 0.
    fn is_smooth(&self) -> bool {
        self.static_friction.is_some() && self.friction().is_none()
    }

    /// Its force along the normal (0) or a tangent.
    fn force(&self, part: usize) -> f64 {
        match part {
            0 => self.normal,
            part => self.tangential[part - 1],
        }
    }

    /// The normal force that its forces need where the undetermined ones are 0, for the size of the margin.
    fn size(&self) -> f64 {
        let [x, y] = self.tangential;
        let tangential = crate::math::sqrt(x * x + y * y);
        let by_friction = self
            .friction()
            .map_or(0.0, |friction| tangential / friction);
        self.normal.abs() + by_friction
    }
}

/// The limit that a contact sets to the shared margin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Limit {
    /// Its friction, which acts in this direction.
    Friction([f64; 2]),
    /// Its normal force.
    Pressing,
}

/// Gives each undetermined force the number of the first one with which it is shared. `by` holds what each undetermined force adds to
/// the forces of the contacts, so that no two groups are in one contact.
pub(crate) fn group(by: &[f64], groups: &mut [usize]) {
    let free = groups.len();
    groups.iter_mut().enumerate().for_each(|(i, g)| *g = i);
    // All forces of a contact.
    for own in by.chunks_exact(PARTS * free) {
        let mut known = None;
        for (i, x) in own.iter().enumerate() {
            if *x == 0.0 {
                continue;
            }
            let here = groups[i % free];
            let first = *known.get_or_insert(here);
            let (to, from) = (first.min(here), first.max(here));
            groups
                .iter_mut()
                .filter(|g| **g == from)
                .for_each(|g| *g = to);
            known = Some(to);
        }
    }
}

/// Whether a contact shares forces of a group; `by` are those of this contact.
pub(crate) fn is_in(by: &[f64], groups: &[usize], group: usize) -> bool {
    let free = groups.len();
    let of_group = |(i, x): (usize, &f64)| *x != 0.0 && groups[i % free] == group;
    by.iter().enumerate().any(of_group)
}

/// Memory for a programme: numbers of the length [`numbers_length`], and places of the length [`places_length`].
pub(crate) type Memory<'w> = (&'w mut [f64], &'w mut [usize]);

pub(crate) const fn numbers_length(sharers: usize, free: usize) -> usize {
    let (planar, spatial) = (tableau_length(sharers, free), cones::length(sharers, free));
    if planar > spatial { planar } else { spatial }
}

pub(crate) const fn places_length(sharers: usize, free: usize) -> usize {
    2 * sharers + free + 1
}

/// The greatest shared margin of a group.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SharedMargin {
    /// Infinite if forces may grow without bound and all contacts hold the better.
    pub value: f64,
    /// By how much a greater one may be possible: 0 of a linear programme, whose rounding is that of the forces.
    pub residual: f64,
}

/// The shared margin of the contacts that share forces of a group. It writes the undetermined forces of the group with that margin, and how its
/// contacts limit it, to `undetermined` and `limits`. `None` if rounding prevents a solution.
///
/// `by` holds what each undetermined force adds to the forces of each contact, [`PARTS`] rows for each.
pub(crate) fn share(
    sharers: &[Sharer],
    of_group: (&[f64], &[usize], usize),
    (numbers, places): Memory<'_>,
    (undetermined, limits): (&mut [f64], &mut [Option<Limit>]),
) -> Option<SharedMargin> {
    let (by, groups, group) = of_group;
    let free = groups.len();
    let of_contact = |k: usize| &by[PARTS * free * k..][..PARTS * free];
    let members = || (0..sharers.len()).filter(|k| is_in(of_contact(*k), groups, group));
    members().for_each(|k| limits[k] = None);
    let is_planar = |k: usize| {
        let across = &of_contact(k)[2 * free..];
        sharers[k].tangential[1] == 0.0 && across.iter().all(|x| *x == 0.0)
    };
    if !members().all(is_planar) {
        return cones::solve(sharers, of_group, numbers, (undetermined, limits));
    }
    let (basic, outside) = places.split_at_mut(2 * sharers.len());
    let numbers = &mut numbers[..tableau_length(sharers.len(), free)];
    let mut tableau = Tableau::new(sharers, of_group, (numbers, basic, &mut outside[..=free]));
    let size = members().map(|k| sharers[k].size()).fold(0.0, f64::max);
    if let Some((k, force)) = tableau.take_smooth_contacts(MORE_THAN_ROUNDING * size) {
        limits[k] = Some(Limit::Friction([force.signum(), 0.0]));
        return Some(SharedMargin {
            value: -force.abs(),
            residual: 0.0,
        });
    }
    let margin = tableau.solve()?;
    for i in (0..free).filter(|i| groups[*i] == group) {
        undetermined[i] = tableau.force(i);
    }
    for k in members() {
        limits[k] = tableau.limit(k, &sharers[k]);
    }
    Some(SharedMargin {
        value: margin,
        residual: 0.0,
    })
}

/// The length of the numbers of a [`Tableau`].
const fn tableau_length(sharers: usize, free: usize) -> usize {
    2 * sharers * (free + 2)
}

/// Conditions `0 ≤ tᵢ = bᵢ + aᵢ·y − wᵢ s`, two for each contact, solved for as many of their variables.
///
/// Variables are numbered: y, then s, then the slacks t.
struct Tableau<'w> {
    free: usize,
    /// Rows of coefficients of y and s, followed by the constant.
    numbers: &'w mut [f64],
    /// The variable of each row.
    basic: &'w mut [usize],
    /// The variable of each column; all of them are 0.
    outside: &'w mut [usize],
    objective: usize,
}

impl<'w> Tableau<'w> {
    /// The conditions of the contacts that share forces of a group. `numbers` has the length [`tableau_length`], `basic` two entries for
    /// each contact, and `outside` one more than there are undetermined forces.
    fn new(
        sharers: &[Sharer],
        (by, groups, group): (&[f64], &[usize], usize),
        (numbers, basic, outside): (&'w mut [f64], &'w mut [usize], &'w mut [usize]),
    ) -> Tableau<'w> {
        let free = groups.len();
        let width = free + 2;
        numbers.fill(0.0);
        basic.fill(NOTHING);
        for (i, variable) in outside.iter_mut().enumerate() {
            *variable = i;
        }
        for (k, (sharer, by)) in sharers
            .iter()
            .zip(by.chunks_exact(PARTS * free))
            .enumerate()
        {
            if !is_in(by, groups, group) {
                continue;
            }
            let (normal, tangential) = (&by[..free], &by[free..2 * free]);
            // Row 2k + second: `first` times the normal force and `other` times the friction, less `weight` times s.
            let mut set = |second: usize, variable: usize, [first, other, weight]: [f64; 3]| {
                let row = 2 * k + second;
                let own = &mut numbers[row * width..][..width];
                for (x, (n, t)) in own.iter_mut().zip(normal.iter().zip(tangential)) {
                    *x = first * n + other * t;
                }
                own[free] = -weight;
                own[free + 1] = first * sharer.normal + other * sharer.tangential[0];
                let most = own[..=free]
                    .iter()
                    .fold(0.0_f64, |most, x| most.max(x.abs()));
                own.iter_mut().for_each(|x| *x /= most);
                basic[row] = variable;
            };
            let slack = |second: usize| free + 1 + 2 * k + second;
            match sharer.static_friction {
                Some(friction) if friction > 0.0 => {
                    set(0, slack(0), [friction, -1.0, friction]);
                    set(1, slack(1), [friction, 1.0, friction]);
                }
                without => {
                    if without.is_some() && tangential.iter().any(|x| *x != 0.0) {
                        set(0, NO_FORCE, [0.0, 1.0, 0.0]);
                    }
                    if sharer.presses && normal.iter().any(|x| *x != 0.0) {
                        set(1, slack(1), [1.0, 0.0, 1.0]);
                    }
                }
            }
        }
        Tableau {
            free,
            numbers,
            basic,
            outside,
            objective: 0,
        }
    }

    /// Solves for undetermined forces with which contacts without friction have none. Where there are none, with more than this rounding, it returns such a
    /// contact and the friction force that it would need.
    fn take_smooth_contacts(&mut self, rounding: f64) -> Option<(usize, f64)> {
        let (rows, width) = (self.basic.len(), self.free + 2);
        for row in 0..rows {
            if self.basic[row] != NO_FORCE {
                continue;
            }
            let entry = |c: &usize| self.numbers[row * width + c].abs();
            let is_free = |c: &usize| self.outside[*c] < self.free;
            let columns = (0..self.free).filter(is_free);
            let largest = columns.max_by(|a, b| entry(a).total_cmp(&entry(b)));
            if let Some(column) = largest.filter(|c| entry(c) > ZERO) {
                self.pivot(row, column);
                self.outside[column] = NOTHING;
                continue;
            }
            let force = self.numbers[row * width + self.free + 1];
            if force.abs() > rounding {
                return Some((row / 2, force));
            }
        }
        None
    }

    /// The shared margin; infinite if forces may grow without bound and all contacts hold the better. `None` if rounding prevents a solution.
    fn solve(&mut self) -> Option<f64> {
        let (rows, width) = (self.basic.len(), self.free + 2);
        // With y = 0 the greatest s that is possible.
        let ratio = |row: &usize| {
            let own = &self.numbers[row * width..][..width];
            -own[self.free + 1] / own[self.free]
        };
        let conditions = (0..rows).filter(|row| self.is_slack(self.basic[*row]));
        let Some(row) = conditions.min_by(|a, b| ratio(a).total_cmp(&ratio(b))) else {
            return Some(f64::INFINITY);
        };
        self.pivot(row, self.free);
        self.objective = row;
        for _ in 0..50 * (rows + width) + 200 {
            let Some(column) = self.entering() else {
                return Some(self.numbers[row * width + self.free + 1]);
            };
            let way = self.numbers[row * width + column].signum();
            let Some(leaving) = self.blocking(column, way) else {
                return Some(f64::INFINITY);
            };
            self.pivot(leaving, column);
        }
        None
    }

    fn is_slack(&self, variable: usize) -> bool {
        variable > self.free && variable < NO_FORCE
    }

    /// The column whose variable makes s larger: an undetermined force, which has either sign, or the first slack.
    fn entering(&self) -> Option<usize> {
        let gains = &self.numbers[self.objective * (self.free + 2)..][..=self.free];
        let gains = || {
            gains
                .iter()
                .copied()
                .zip(self.outside.iter().copied())
                .enumerate()
        };
        let mut forces =
            gains().filter(|(_, (gain, variable))| *variable < self.free && gain.abs() > ZERO);
        if let Some((column, _)) = forces.next() {
            return Some(column);
        }
        let slacks =
            gains().filter(|(_, (gain, variable))| self.is_slack(*variable) && *gain > ZERO);
        let first = slacks.min_by_key(|(_, (_, variable))| *variable);
        first.map(|(column, _)| column)
    }

    /// The row whose slack is used up first if the variable of a column grows in this direction; none if it may grow without bound.
    fn blocking(&self, column: usize, way: f64) -> Option<usize> {
        let width = self.free + 2;
        let mut first: Option<(f64, usize)> = None;
        for (row, variable) in self.basic.iter().enumerate() {
            let loss = -way * self.numbers[row * width + column];
            if !self.is_slack(*variable) || loss <= ZERO {
                continue;
            }
            let ratio = self.numbers[row * width + self.free + 1].max(0.0) / loss;
            let is_first = first.is_none_or(|(known, other)| {
                ratio < known || (ratio == known && *variable < self.basic[other])
            });
            if is_first {
                first = Some((ratio, row));
            }
        }
        first.map(|(_, row)| row)
    }

    /// Solves a row for the variable of a column, and puts that into the other rows.
    fn pivot(&mut self, row: usize, column: usize) {
        let width = self.free + 2;
        let by = self.numbers[row * width + column];
        for c in 0..width {
            let own = &mut self.numbers[row * width + c];
            *own = if c == column { 1.0 / by } else { -*own / by };
        }
        for other in (0..self.basic.len()).filter(|other| *other != row) {
            let factor = self.numbers[other * width + column];
            if factor == 0.0 {
                continue;
            }
            self.numbers[other * width + column] = 0.0;
            for c in 0..width {
                self.numbers[other * width + c] += factor * self.numbers[row * width + c];
            }
        }
        core::mem::swap(&mut self.basic[row], &mut self.outside[column]);
    }

    /// An undetermined force of the solution.
    fn force(&self, number: usize) -> f64 {
        let row = self.basic.iter().position(|variable| *variable == number);
        row.map_or(0.0, |row| {
            self.numbers[row * (self.free + 2) + self.free + 1]
        })
    }

    /// How a contact limits the shared margin, if it does: where both directions of its friction do, it presses no more.
    fn limit(&self, contact: usize, sharer: &Sharer) -> Option<Limit> {
        let gains = &self.numbers[self.objective * (self.free + 2)..][..=self.free];
        let limits = |second: usize| {
            let slack = self.free + 1 + 2 * contact + second;
            let mut own = gains.iter().zip(self.outside.iter());
            own.any(|(gain, variable)| *variable == slack && *gain < -ZERO)
        };
        let has_friction = sharer.friction().is_some();
        match [limits(0), limits(1)] {
            [false, false] => None,
            [true, false] if has_friction => Some(Limit::Friction([1.0, 0.0])),
            [false, true] if has_friction => Some(Limit::Friction([-1.0, 0.0])),
            _ => Some(Limit::Pressing),
        }
    }
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;
    use std::vec;
    use std::vec::Vec;

    /// Numbers between −1 and 1 that look drawn at random.
    fn drawn(seed: &mut u64) -> f64 {
        *seed ^= *seed << 13;
        *seed ^= *seed >> 7;
        *seed ^= *seed << 17;
        (*seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// The shared margin of contacts that are all in one group, the undetermined forces, and the limits.
    fn shared(sharers: &[Sharer], by: &[f64], free: usize) -> (f64, Vec<f64>, Vec<Option<Limit>>) {
        let mut groups = vec![0; free];
        group(by, &mut groups);
        let mut numbers = vec![0.0; numbers_length(sharers.len(), free)];
        let mut places = vec![0; places_length(sharers.len(), free)];
        let (mut forces, mut limits) = (vec![0.0; free], vec![None; sharers.len()]);
        let margin = share(
            sharers,
            (by, &groups, 0),
            (&mut numbers, &mut places),
            (&mut forces, &mut limits),
        );
        (margin.expect("solved").value, forces, limits)
    }

    fn sticks(static_friction: f64, normal: f64, tangential: f64) -> Sharer {
        Sharer {
            static_friction: Some(static_friction),
            presses: true,
            normal,
            tangential: [tangential, 0.0],
        }
    }

    /// Blocks in a row that hold a force P: `|Tᵢ| ≤ μᵢ (Nᵢ − s)` and `Σ Tᵢ = −P` give `s = (Σ μᵢ Nᵢ − |P|)/Σ μᵢ`, which all of them
    /// limit, as far as that is less than the least normal force.
    #[test]
    fn blocks_in_a_row_hold_up_to_the_sum_of_their_friction() {
        let blocks = [(0.5, 10.0), (0.3, 4.0), (0.2, 7.0), (0.0, 3.0)];
        for pull in [-5.0, -2.0, 0.0, 3.0, 5.0, 7.6, 9.0] {
            // The first holds everything; what another takes, it does not.
            let mut first = -pull;
            let mut sharers = Vec::new();
            for (friction, normal) in blocks {
                sharers.push(sticks(friction, normal, first));
                first = 0.0;
            }
            let mut by = vec![0.0; 4 * 9];
            for i in 0..3 {
                by[3 + i] = -1.0;
                by[9 * (i + 1) + 3 + i] = 1.0;
            }
            let (margin, forces, limits) = shared(&sharers, &by, 3);
            let expected = f64::min(7.6 - f64::abs(pull), 4.0);
            // Each of some ten operations rounds numbers of at most 10.
            assert!((margin - expected).abs() < 1e-14, "{margin} for {expected}");
            assert!(forces[2].abs() < 1e-14, "{forces:?}");
            let way = Some(Limit::Friction([if pull > 0.0 { -1.0 } else { 1.0 }, 0.0]));
            if expected < 4.0 {
                assert_eq!(limits, [way, way, way, None]);
            }
        }
    }

    /// The best of all points where as many conditions as there are unknowns are just satisfied, and all others are satisfied.
    #[test]
    fn no_corner_of_the_conditions_is_better() {
        let mut seed = 0x9e37_79b9_7f4a_7c15;
        for case in 0..400 {
            let free = 1 + case % 3;
            let count = free + 1 + case % 2;
            let mut by: Vec<f64> = (0..PARTS * free * count)
                .map(|_| drawn(&mut seed))
                .collect();
            let mut sharers = Vec::new();
            for (k, own) in by.chunks_exact_mut(PARTS * free).enumerate() {
                own[2 * free..].fill(0.0);
                // With normal forces that change little the margin is bounded; some contacts only press.
                own[..free].iter_mut().for_each(|x| *x *= 0.1);
                let mut sharer = sticks(
                    0.5 + 0.4 * drawn(&mut seed),
                    drawn(&mut seed),
                    drawn(&mut seed),
                );
                if k == count - 1 && count > free + 1 {
                    sharer.static_friction = None;
                    own[free..].fill(0.0);
                }
                sharers.push(sharer);
            }
            let mut rows: Vec<Vec<f64>> = Vec::new();
            for (sharer, own) in sharers.iter().zip(by.chunks_exact(PARTS * free)) {
                let friction = sharer.static_friction;
                let signs: &[f64] = if friction.is_some() {
                    &[1.0, -1.0]
                } else {
                    &[0.0]
                };
                for sign in signs {
                    let factor = friction.unwrap_or(1.0);
                    let mut row: Vec<f64> = (0..free)
                        .map(|i| factor * own[i] - sign * own[free + i])
                        .collect();
                    row.push(-factor);
                    row.push(factor * sharer.normal - sign * sharer.tangential[0]);
                    rows.push(row);
                }
            }
            let mut best = f64::NEG_INFINITY;
            for set in 0_u32..1 << rows.len() {
                if set.count_ones() as usize != free + 1 {
                    continue;
                }
                let chosen: Vec<&Vec<f64>> = (0..rows.len())
                    .filter(|i| set >> i & 1 == 1)
                    .map(|i| &rows[i])
                    .collect();
                let Some(point) = corner(&chosen) else {
                    continue;
                };
                let value = |row: &Vec<f64>| {
                    let terms = row.iter().zip(&point).map(|(a, x)| a * x);
                    terms.sum::<f64>() + row[free + 1]
                };
                if rows.iter().all(|row| value(row) > -1e-9) {
                    best = best.max(point[free]);
                }
            }
            let (margin, ..) = shared(&sharers, &by, free);
            // A margin without bound has no corner above all others.
            if margin.is_finite() {
                assert!(
                    (margin - best).abs() < 1e-8,
                    "case {case}: {margin}, {best}"
                );
            }
        }
    }

    /// Where rows of coefficients and a constant are 0.
    fn corner(rows: &[&Vec<f64>]) -> Option<Vec<f64>> {
        let n = rows.len();
        let mut a: Vec<Vec<f64>> = rows.iter().map(|row| (*row).clone()).collect();
        for i in 0..n {
            let pivot = (i..n).max_by(|p, q| a[*p][i].abs().total_cmp(&a[*q][i].abs()))?;
            a.swap(i, pivot);
            if a[i][i].abs() < 1e-6 {
                return None;
            }
            let own = a[i].clone();
            for (_, row) in a.iter_mut().enumerate().filter(|(j, _)| *j != i) {
                let factor = row[i] / own[i];
                row.iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
            }
        }
        Some((0..n).map(|i| -a[i][n] / a[i][i]).collect())
    }

    /// The same contacts with their friction along a direction that is turned against both tangents: what the linear programme says in the
    /// plane, the cones say in space.
    #[test]
    fn cones_of_which_only_two_edges_count_are_the_linear_programme() {
        let mut seed = 0x2545_f491_4f6c_dd1d;
        for case in 0..300 {
            let free = 1 + case % 4;
            let count = free + 1 + case % 3;
            let mut by: Vec<f64> = (0..PARTS * free * count)
                .map(|_| drawn(&mut seed))
                .collect();
            let mut sharers = Vec::new();
            for own in by.chunks_exact_mut(PARTS * free) {
                own[..free].iter_mut().for_each(|x| *x *= 0.1);
                own[2 * free..].fill(0.0);
                let friction = 0.5 + 0.4 * drawn(&mut seed);
                sharers.push(sticks(friction, drawn(&mut seed), drawn(&mut seed)));
            }
            let (sin, cos) = (3.0 * drawn(&mut seed)).sin_cos();
            let mut turned = sharers.clone();
            let mut turned_by = by.clone();
            for (sharer, own) in turned
                .iter_mut()
                .zip(turned_by.chunks_exact_mut(PARTS * free))
            {
                let along = sharer.tangential[0];
                sharer.tangential = [cos * along, sin * along];
                let (along, across) = own[free..].split_at_mut(free);
                for (along, across) in along.iter_mut().zip(across) {
                    (*along, *across) = (cos * *along, sin * *along);
                }
            }
            let (expected, _, limits) = shared(&sharers, &by, free);
            let (margin, _, turned_limits) = shared(&turned, &turned_by, free);
            if expected == f64::INFINITY {
                assert_eq!(margin, expected, "case {case}");
                continue;
            }
            // The distance from the dual margin at which the steps end, for forces of at most 3.
            assert!(
                (margin - expected).abs() < 1e-10,
                "case {case}: {margin}, {expected}"
            );
            for (limit, turned) in limits.iter().zip(&turned_limits) {
                let (Some(Limit::Friction([along, _])), Some(Limit::Friction(direction))) =
                    (limit, turned)
                else {
                    continue;
                };
                assert!((direction[0] - along * cos).abs() < 1e-6, "case {case}");
                assert!((direction[1] - along * sin).abs() < 1e-6, "case {case}");
            }
        }
    }

    /// The undetermined forces of contacts of a body: `N`, and `T` along both tangents, of each as a column of `w`, by which the body is loaded.
    fn of_body(columns: &[[f64; 6]], load: [f64; 6]) -> (Vec<f64>, Vec<Vec<f64>>) {
        let n = columns.len();
        // Gauss–Jordan elimination of `Σ columns f = −load`.
        let mut rows: Vec<Vec<f64>> = (0..6)
            .map(|i| {
                let mut row: Vec<f64> = columns.iter().map(|column| column[i]).collect();
                row.push(-load[i]);
                row
            })
            .collect();
        let mut basic = Vec::new();
        for j in 0..n {
            let done = basic.len();
            let Some(pivot) =
                (done..6).max_by(|a, b| rows[*a][j].abs().total_cmp(&rows[*b][j].abs()))
            else {
                break;
            };
            if rows[pivot][j].abs() < 1e-9 {
                continue;
            }
            rows.swap(done, pivot);
            let by = rows[done][j];
            rows[done].iter_mut().for_each(|x| *x /= by);
            let own = rows[done].clone();
            for (_, row) in rows.iter_mut().enumerate().filter(|(i, _)| *i != done) {
                let factor = row[j];
                row.iter_mut().zip(&own).for_each(|(x, y)| *x -= factor * y);
            }
            basic.push(j);
        }
        let mut forces = vec![0.0; n];
        basic
            .iter()
            .zip(&rows)
            .for_each(|(j, row)| forces[*j] = row[n]);
        let free = (0..n).filter(|j| !basic.contains(j));
        let of_unit = free.map(|free| {
            let mut of_unit = vec![0.0; n];
            of_unit[free] = 1.0;
            basic
                .iter()
                .zip(&rows)
                .for_each(|(j, row)| of_unit[*j] = -row[free]);
            of_unit
        });
        (forces, of_unit.collect())
    }

    /// The shared margin of contacts of a body: points, normals, and tangents.
    fn margin_of_body(
        contacts: &[([f64; 3], [[f64; 3]; 3])],
        frictions: &[f64],
        load: [f64; 6],
    ) -> (f64, Vec<Option<Limit>>) {
        let cross = |a: [f64; 3], b: [f64; 3]| {
            let part = |i: usize, j: usize| a[i] * b[j] - a[j] * b[i];
            [part(1, 2), part(2, 0), part(0, 1)]
        };
        let columns: Vec<[f64; 6]> = (contacts.iter())
            .flat_map(|(point, directions)| {
                directions.map(|d| {
                    let turns = cross(*point, d);
                    [d[0], d[1], d[2], turns[0], turns[1], turns[2]]
                })
            })
            .collect();
        let (forces, of_unit) = of_body(&columns, load);
        let free = of_unit.len();
        let mut by = Vec::new();
        for k in 0..columns.len() {
            by.extend(of_unit.iter().map(|of_unit| of_unit[k]));
        }
        let sharers: Vec<Sharer> = (forces.chunks_exact(3).zip(frictions))
            .map(|(own, friction)| Sharer {
                static_friction: Some(*friction),
                presses: true,
                normal: own[0],
                tangential: [own[1], own[2]],
            })
            .collect();
        let (margin, _, limits) = shared(&sharers, &by, free);
        (margin, limits)
    }

    const UPRIGHT: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    /// A table with legs around its mass centre that is pushed at the ground: `Σ |Tᵢ| ≥ P` and `|Tᵢ| ≤ μ (Nᵢ − s)` give `n s = W − P/μ`.
    #[test]
    fn a_table_holds_up_to_its_friction_in_every_direction() {
        for legs in 4..9 {
            let leg = |i: usize| {
                let angle = 0.3 + 2.0 * core::f64::consts::PI * i as f64 / legs as f64;
                ([angle.cos(), angle.sin(), 0.0], UPRIGHT)
            };
            let contacts: Vec<_> = (0..legs).map(leg).collect();
            for direction in [0.0_f64, 0.4, 2.0, -1.1] {
                for push in [0.0, 1.0, 3.9, 4.1] {
                    let (sin, cos) = direction.sin_cos();
                    let load = [push * cos, push * sin, -10.0, 0.0, 0.0, 0.0];
                    let (margin, limits) = margin_of_body(&contacts, &vec![0.4; legs], load);
                    let expected = (10.0 - push / 0.4) / legs as f64;
                    assert!((margin - expected).abs() < 1e-11, "{margin}, {expected}");
                    for limit in limits.iter().filter(|_| push > 0.0) {
                        let Some(Limit::Friction(friction)) = limit else {
                            panic!("{limits:?}");
                        };
                        // A direction with an error ε changes what limits by ε².
                        assert!((friction[0] + cos).abs() < 1e-5, "{limits:?}");
                        assert!((friction[1] + sin).abs() < 1e-5, "{limits:?}");
                    }
                }
            }
        }
    }

    /// A body in a V groove with sides at an angle β, along which it is pulled. Friction down the sides wedges it in, `N = N₀ + T tan β` with
    /// `2 N₀ cos β = W`, and `(P/2)² + T² ≤ μ² N²` has a solution T as long as `P ≤ 2 μ N₀/√(1 − μ² tan² β)`.
    #[test]
    fn a_body_in_a_groove_is_wedged_in() {
        for beta in [0.2_f64, 0.7, 1.0] {
            let (sin, cos) = beta.sin_cos();
            // One contact on each side in front and behind.
            let contact = |side: f64, x: f64| {
                let normal = [0.0, -side * sin, cos];
                let along = [1.0, 0.0, 0.0];
                let up = [0.0, side * cos, sin];
                ([x, side, 0.0], [normal, along, up])
            };
            let contacts = [(1.0, 0.5), (-1.0, 0.5), (1.0, -0.5), (-1.0, -0.5)];
            let contacts = contacts.map(|(side, x)| contact(side, x));
            for friction in [0.1, 0.36, 0.6] {
                let normal = 10.0 / (2.0 * cos);
                let wedged = friction * beta.tan();
                let most = 2.0 * friction * normal / (1.0 - wedged * wedged).sqrt();
                for (share, holds) in [(1.0 - 1e-9, true), (1.0 + 1e-9, false)] {
                    let load = [share * most, 0.0, -10.0, 0.0, 0.0, 0.0];
                    let (margin, _) = margin_of_body(&contacts, &[friction; 4], load);
                    assert_eq!(margin > 0.0, holds, "β = {beta}, μ = {friction}: {margin}");
                }
            }
        }
    }

    /// A body between two walls that press on each other as hard as they like is held by any friction.
    #[test]
    fn what_presses_itself_harder_holds() {
        let sharers = [sticks(0.1, 0.0, 3.0), sticks(0.1, 0.0, 0.0)];
        let by = [1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0];
        assert_eq!(shared(&sharers, &by, 2).0, f64::INFINITY);
    }

    /// Two contacts without friction share what one of them would have to hold: they hold nothing, but what a third one with friction leaves them.
    #[test]
    fn contacts_without_friction_hold_nothing() {
        let mut sharers = vec![sticks(0.0, 5.0, 3.0), sticks(0.0, 4.0, 0.0)];
        let by = [0.0, 1.0, 0.0, 0.0, -1.0, 0.0];
        let (margin, _, limits) = shared(&sharers, &by, 1);
        assert!(margin < 0.0, "{margin}");
        assert!(limits.contains(&Some(Limit::Friction([1.0, 0.0]))));
        sharers[0].tangential[0] = 1e-12;
        assert_eq!(shared(&sharers, &by, 1).0, f64::INFINITY);
        sharers[0].tangential[0] = 3.0;
        sharers.push(sticks(0.5, 8.0, 0.0));
        let by = [
            [0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, -1.0, 1.0, 0.0, 0.0],
            [0.0, 0.0, 0.0, -1.0, 0.0, 0.0],
        ];
        // 3 N of at most 0.5 (8 N − s).
        assert_eq!(shared(&sharers, by.as_flattened(), 2).0, 2.0);
    }

    #[test]
    fn contacts_that_share_nothing_are_in_groups_of_their_own() {
        let mut groups = [9; 3];
        // The first and the third force meet in the second contact.
        let by = [
            1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, //
            0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, //
            0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0,
        ];
        group(&by, &mut groups);
        assert_eq!(groups, [0, 1, 0]);
    }
}
