//! Forces that the equations of motion leave undetermined: whether contacts that depend on each other hold with some of them.
//!
//! If contacts at rest depend on each other, the equations determine only sums of their forces: for two blocks on a rod, the share of each does not
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
mod tests;
