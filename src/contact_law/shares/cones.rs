//! The shared margin of contacts whose friction acts along two tangents: a cone programme, (E78).
//!
//! ```text
//! greatest s  with  (μᵢ (Nᵢ(y) − s), Tᵢ(y)) ∈ K,    K = {(x, u) : x ≥ |u|}
//! ```
//!
//! K is a cone of revolution, so this is no linear programme. It is solved together with its dual, `least bᵀz with Aᵀz = −c and z ∈ K`, by a
//! primal-dual interior-point method, whose scaling and steps are those of [`revolution`](super::super::revolution).
//!
//! A sequence of linear programmes with planes that touch the cones would do it, too. But where all contacts of a body are at their limits
//! together, the greatest margin is at a place where the cones curve in as many directions as there are undetermined forces: each programme
//! then finds a corner of its planes on another side of it, and the number of planes for a number of digits grows like a power of that
//! dimension. An interior-point method needs some 15 steps whatever the dimension, and its dual solution is a proof: no forces have a margin
//! above `bᵀz`.
//!
//! Slacks are computed from y at each step, so that they contain no error of the steps before, and the margin that is returned is that of
//! the forces that are returned. By how much it may be below that of the dual solution is its residual.

use super::super::revolution::{
    SHARE_OF_WAY, Scaling, Triple, corrected_right_side, determinant, length_of, way_to_edge,
};
use super::{Limit, MORE_THAN_ROUNDING, PARTS, SharedMargin, Sharer, is_in};
use crate::math::sqrt;

/// Entries of a cone: along its axis, and along both tangents. Of a contact without friction only the first is not 0.
const ENTRIES: usize = 3;

/// Vectors with an entry for each of those of the cones: slacks, multipliers, their scaling, what they are scaled, and four of directions.
const VECTORS: usize = 8;

/// The greatest sum of the undetermined normal forces, relative to the greatest force without undetermined ones: what presses itself as hard as
/// it likes has bounds that are far from those of the others.
const GREATEST_FORCE: f64 = 1e4;

/// The greatest margin, relative to the greatest force without undetermined ones. A margin that has a bound is a mean of these, so that it
/// is less.
const GREATEST_MARGIN: f64 = 8.0;

/// A margin above this has no bound.
const ENDLESS: f64 = 4.0;

/// The most steps.
const STEPS: usize = 60;

/// How many steps may fail to halve the gap before rounding is taken to prevent it.
const VAIN_STEPS: usize = 4;

/// The distance from the dual margin at which the programme is solved, relative to the greatest force: the rounding of a few dozen operations.
const SOLVED: f64 = 1e-14;

/// The greatest distance from the dual margin of a solution, relative to the greatest force. Where contacts that limit the margin press with
/// nothing, rounding of the multipliers leaves more of it than of the margin.
const TOLERABLE: f64 = 1e-8;

/// How often the solution is refined with the residual of the conditions of the multipliers.
const REFINEMENTS: usize = 2;

/// What counts as zero among coefficients about as large as 1.
const ZERO: f64 = 1e-11;

/// Above this a multiplier limits the margin. Their sum is 1, and those of contacts that do not limit it are as small as the distance from the
/// dual margin, relative to what they have in reserve.
const LIMITS: f64 = 1e-6;

/// The length of the workspace.
pub(super) const fn length(sharers: usize, free: usize) -> usize {
    let (cones, n) = (sharers + 2, free + 1);
    ENTRIES * cones * (n + 1 + VECTORS) + 3 * cones + 2 * n * (n + 1) + (ENTRIES + 6) * n
}

/// The greatest shared margin of the contacts of a group, with the forces of the group and the limits of its contacts. `None` if rounding
/// prevents a solution.
pub(super) fn solve(
    sharers: &[Sharer],
    (by, groups, group): (&[f64], &[usize], usize),
    work: &mut [f64],
    (undetermined, limits): (&mut [f64], &mut [Option<Limit>]),
) -> Option<SharedMargin> {
    let group = Group::new(sharers, (by, groups, group))?;
    let unit = group.unit;
    let mut programme = Programme::new(sharers.len() + 2, group.unknowns(), work);
    group.put_units(programme.units);
    if let Some((contact, slip, value)) = group.put_smooth(&mut programme) {
        limits[contact] = Some(Limit::Friction(slip));
        return Some(SharedMargin {
            value,
            residual: 0.0,
        });
    }
    group.put_cones(&mut programme);
    programme.close();
    let residual = programme.run()?;
    let margin = programme.margin;
    if residual > TOLERABLE {
        return None;
    }
    programme.put_forces();
    for (column, i) in group.columns().enumerate() {
        undetermined[i] = programme.units[column] * programme.forces[column] * unit;
    }
    for cone in 0..programme.cones - 2 {
        limits[programme.contact(cone)] = programme.limit(cone);
    }
    Some(SharedMargin {
        value: if margin < ENDLESS {
            margin * unit
        } else {
            f64::INFINITY
        },
        residual: residual * unit,
    })
}

/// The contacts of a group, with the undetermined forces that they share.
struct Group<'a> {
    sharers: &'a [Sharer],
    /// By how much each force of a contact changes with each undetermined force.
    by: &'a [f64],
    /// The group of each undetermined force, and this group.
    groups: &'a [usize],
    group: usize,
    /// The unit of forces.
    unit: f64,
}

impl<'a> Group<'a> {
    /// A group whose forces are finite.
    fn new(
        sharers: &'a [Sharer],
        (by, groups, group): (&'a [f64], &'a [usize], usize),
    ) -> Option<Self> {
        let mut group = Self {
            sharers,
            by,
            groups,
            group,
            unit: 1.0,
        };
        let sizes = group.members().map(|k| sharers[k].size());
        let unit = sizes.fold(0.0, f64::max);
        if unit > 0.0 {
            group.unit = unit;
        }
        unit.is_finite().then_some(group)
    }

    fn of_contact(&self, k: usize) -> &[f64] {
        let free = self.groups.len();
        &self.by[PARTS * free * k..][..PARTS * free]
    }

    /// Its contacts.
    fn members(&self) -> impl Iterator<Item = usize> {
        let is_member = |k: &usize| is_in(self.of_contact(*k), self.groups, self.group);
        (0..self.sharers.len()).filter(is_member)
    }

    /// Its undetermined forces.
    fn columns(&self) -> impl Iterator<Item = usize> {
        (0..self.groups.len()).filter(|i| self.groups[*i] == self.group)
    }

    /// The number of unknowns: the undetermined forces, and the margin.
    fn unknowns(&self) -> usize {
        1 + self.columns().count()
    }

    /// Undetermined forces are multiples of what adds the unit of force somewhere.
    fn put_units(&self, units: &mut [f64]) {
        let (by, free) = (self.by, self.groups.len());
        for (column, i) in self.columns().enumerate() {
            let members = self.members();
            let most =
                members.flat_map(|k| [0, 1, 2].map(|part| by[(PARTS * k + part) * free + i]));
            let most = most.fold(0.0_f64, |most, x| most.max(x.abs()));
            units[column] = if most > 0.0 { 1.0 / most } else { 0.0 };
        }
    }

    /// Writes the force of a contact along its normal (0) or a tangent, as a row of coefficients and a constant.
    fn put_force(&self, (k, part): (usize, usize), units: &[f64], row: &mut [f64]) {
        let (n, free) = (self.unknowns(), self.groups.len());
        for (column, i) in self.columns().enumerate() {
            row[column] = units[column] * self.by[(PARTS * k + part) * free + i];
        }
        row[n - 1] = 0.0;
        row[n] = self.sharers[k].force(part) / self.unit;
    }

    /// Contacts without friction hold nothing along their tangents. If one would have to, it is returned with the direction of its slip and the margin that is
    /// missing, in N.
    fn put_smooth(&self, programme: &mut Programme<'_>) -> Option<(usize, [f64; 2], f64)> {
        let n = self.unknowns();
        for k in self.members().filter(|k| self.sharers[*k].is_smooth()) {
            for part in [1, 2] {
                let (row, units) = programme.next_equation();
                self.put_force((k, part), units, row);
                let depends = row[..n].iter().any(|x| *x != 0.0);
                let left = programme.take_equation();
                if depends && left.abs() > MORE_THAN_ROUNDING {
                    // Its friction would have to hold, and there is none.
                    let mut direction = [0.0; 2];
                    direction[part - 1] = left.signum();
                    return Some((k, direction, -left.abs() * self.unit));
                }
            }
        }
        None
    }

    /// The cones of the contacts that press or have friction.
    fn put_cones(&self, programme: &mut Programme<'_>) {
        let (n, free) = (self.unknowns(), self.groups.len());
        for k in self.members() {
            let friction = self.sharers[k].friction();
            let by_normal = &self.of_contact(k)[..free];
            let presses = self.sharers[k].presses && by_normal.iter().any(|x| *x != 0.0);
            if friction.is_none() && !presses {
                continue;
            }
            let (rows, units) = programme.next_cone();
            let width = n + 1;
            self.put_force((k, 0), units, &mut rows[..width]);
            rows[n - 1] = -1.0;
            if let Some(friction) = friction {
                rows[..width].iter_mut().for_each(|x| *x *= friction);
                self.put_force((k, 1), units, &mut rows[width..2 * width]);
                self.put_force((k, 2), units, &mut rows[2 * width..]);
            }
            programme.take_cone(k);
        }
    }
}

/// `slack = b + A x ∈ K`, with `x` the undetermined forces and the margin s, which is to be great.
struct Programme<'w> {
    /// Unknowns: the forces of the group, and s.
    n: usize,
    cones: usize,
    /// Equations by which some of the forces follow from the others.
    equations: usize,
    /// Three rows of A for each cone, each followed by its entry of b.
    rows: &'w mut [f64],
    slack: &'w mut [f64],
    multiplier: &'w mut [f64],
    /// The multipliers that are nearest to a solution.
    best_multiplier: &'w mut [f64],
    /// The axis of the scaling of each cone, and its factor.
    axis: &'w mut [f64],
    factor: &'w mut [f64],
    /// Slacks and multipliers scaled, which are then the same.
    scaled: &'w mut [f64],
    /// Scaled changes of slacks and multipliers, and the right side.
    slack_change: &'w mut [f64],
    multiplier_change: &'w mut [f64],
    right: &'w mut [f64],
    /// The contact of each cone, and the weight of its multiplier in their sum.
    contacts: &'w mut [f64],
    weights: &'w mut [f64],
    /// `Aᵀ W⁻² A`, and its factor.
    matrix: &'w mut [f64],
    /// The forces that follow from others: the column and the row of each.
    following: &'w mut [f64],
    scaled_rows: &'w mut [f64],
    units: &'w mut [f64],
    x: &'w mut [f64],
    change: &'w mut [f64],
    correction: &'w mut [f64],
    forces: &'w mut [f64],
    columns: &'w mut [f64],
    /// The best margin so far.
    margin: f64,
}

/// The first part of a slice, which the rest then lacks.
fn take<'w>(rest: &mut &'w mut [f64], length: usize) -> &'w mut [f64] {
    let (own, left) = core::mem::take(rest).split_at_mut(length);
    *rest = left;
    own
}

impl<'w> Programme<'w> {
    fn new(most_cones: usize, n: usize, mut work: &'w mut [f64]) -> Programme<'w> {
        work.fill(0.0);
        let work = &mut work;
        let entries = ENTRIES * most_cones;
        Programme {
            n,
            cones: 0,
            equations: 0,
            rows: take(work, entries * (n + 1)),
            slack: take(work, entries),
            multiplier: take(work, entries),
            best_multiplier: take(work, entries),
            axis: take(work, entries),
            scaled: take(work, entries),
            slack_change: take(work, entries),
            multiplier_change: take(work, entries),
            right: take(work, entries),
            factor: take(work, most_cones),
            contacts: take(work, most_cones),
            weights: take(work, most_cones),
            matrix: take(work, n * n),
            following: take(work, n * (n + 1)),
            scaled_rows: take(work, ENTRIES * n),
            units: take(work, n),
            x: take(work, n),
            change: take(work, n),
            correction: take(work, n),
            forces: take(work, n),
            columns: take(work, n),
            margin: f64::NEG_INFINITY,
        }
    }

    /// Room for an equation `0 = b + a·y`, and the units of the forces.
    fn next_equation(&mut self) -> (&mut [f64], &[f64]) {
        let width = self.n + 1;
        (&mut self.rows[..width], self.units)
    }

    /// Solves the equation for one of its forces; if it depends on none, the answer is its residual.
    fn take_equation(&mut self) -> f64 {
        let (n, width) = (self.n, self.n + 1);
        let row = &mut self.rows[..width];
        let before = row[..n].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        substitute(row, &self.following[..self.equations * width], self.columns);
        let largest = (0..n - 1).max_by(|a, b| row[*a].abs().total_cmp(&row[*b].abs()));
        let Some(column) = largest.filter(|c| row[*c].abs() > ZERO * before) else {
            return row[n];
        };
        let by = row[column];
        let known = &mut self.following[self.equations * width..][..width];
        for (c, (known, own)) in known.iter_mut().zip(&*row).enumerate() {
            *known = if c == column { 0.0 } else { -own / by };
        }
        self.columns[self.equations] = column as f64;
        self.equations += 1;
        0.0
    }

    /// Room for the rows of a cone, and the units of the forces.
    fn next_cone(&mut self) -> (&mut [f64], &[f64]) {
        let length = ENTRIES * (self.n + 1);
        let rows = &mut self.rows[self.cones * length..][..length];
        rows.fill(0.0);
        (rows, self.units)
    }

    /// Takes the cone of a contact.
    fn take_cone(&mut self, contact: usize) {
        let width = self.n + 1;
        let rows = &mut self.rows[self.cones * ENTRIES * width..][..ENTRIES * width];
        for row in rows.chunks_exact_mut(width) {
            substitute(row, &self.following[..self.equations * width], self.columns);
        }
        let coefficients = rows.chunks_exact(width).flat_map(|row| &row[..self.n]);
        let most = coefficients.fold(0.0_f64, |most, x| most.max(x.abs()));
        rows.iter_mut().for_each(|x| *x /= most);
        self.weights[self.cones] = -rows[self.n - 1];
        self.contacts[self.cones] = contact as f64;
        self.cones += 1;
    }

    fn contact(&self, cone: usize) -> usize {
        self.contacts[cone] as usize
    }

    /// Adds the bounds of the margin and of the forces, and begins.
    fn close(&mut self) {
        let (n, width) = (self.n, self.n + 1);
        let of_contacts = self.cones * ENTRIES * width;
        let (contacts, bounds) = self.rows.split_at_mut(of_contacts);
        let (margin, forces) = bounds[..2 * ENTRIES * width].split_at_mut(ENTRIES * width);
        margin.fill(0.0);
        forces.fill(0.0);
        (margin[n - 1], margin[n]) = (-1.0, GREATEST_MARGIN);
        for row in contacts.chunks_exact(ENTRIES * width) {
            for (sum, x) in forces[..n - 1].iter_mut().zip(row) {
                *sum -= x;
            }
        }
        forces[n] = GREATEST_FORCE;
        self.weights[self.cones] = 1.0;
        // A margin with which all slacks are positive, where the undetermined forces are 0.
        let mut start = 0.0_f64;
        for (rows, weight) in contacts.chunks_exact(ENTRIES * width).zip(&*self.weights) {
            let b = [rows[n], rows[width + n], rows[2 * width + n]];
            start = start.min((b[0] - length_of([b[1], b[2]])) / weight);
        }
        self.cones += 2;
        self.x.fill(0.0);
        self.x[n - 1] = start - 1.0;
        self.put_slacks();
        // Multipliers that are inverse to the slacks, with the right sum.
        let mut sum = 0.0;
        for cone in 0..self.cones {
            let slack = of_cone(self.slack, cone);
            let size = determinant(slack);
            let inverse = [slack[0] / size, -slack[1] / size, -slack[2] / size];
            self.multiplier[ENTRIES * cone..ENTRIES * (cone + 1)].copy_from_slice(&inverse);
            sum += self.weights[cone] * inverse[0];
        }
        let entries = ENTRIES * self.cones;
        self.multiplier[..entries]
            .iter_mut()
            .for_each(|z| *z /= sum);
    }

    fn put_slacks(&mut self) {
        let n = self.n;
        for (slack, row) in self.slack.iter_mut().zip(self.rows.chunks_exact(n + 1)) {
            let terms = row[..n].iter().zip(&*self.x);
            *slack = terms.fold(row[n], |sum, (a, x)| sum + a * x);
        }
    }

    /// Steps until the margin is that of the dual solution. The answer is how far it may be from it.
    fn run(&mut self) -> Option<f64> {
        let (mut best, mut least_gap, mut vain) = (f64::INFINITY, f64::INFINITY, 0);
        for _ in 0..STEPS {
            let (distance, gap) = (self.distance(), self.gap());
            if distance < best {
                best = distance;
                self.best_multiplier.copy_from_slice(self.multiplier);
            }
            // Rounding of the multipliers may keep the distance from what the gap falls to, and the margin comes nearer all the same.
            vain = if gap < 0.5 * least_gap { 0 } else { vain + 1 };
            least_gap = least_gap.min(gap);
            if best.max(gap) <= SOLVED || vain > VAIN_STEPS || !self.scale() {
                break;
            }
            self.factorize();
            // As far as a step goes with which all products would vanish.
            for (right, scaled) in self.right.iter_mut().zip(&*self.scaled) {
                *right = -scaled;
            }
            self.solve_step();
            let way = self.way().min(1.0);
            let after = self.gap_after(way) / gap;
            let aim = (after * after * after).clamp(0.0, 1.0) * gap / self.cones as f64;
            self.put_corrected_right_side(aim);
            self.solve_step();
            let way = (SHARE_OF_WAY * self.way()).min(1.0);
            if !self.go(way) {
                break;
            }
        }
        (best < f64::INFINITY).then_some(best)
    }

    fn gap(&self) -> f64 {
        let pairs = self.slack.iter().zip(&*self.multiplier);
        pairs.fold(0.0, |sum, (s, z)| sum + s * z)
    }

    /// `Aᵀz + c` for an unknown.
    fn dual_residual(&self, column: usize) -> f64 {
        let start = if column == self.n - 1 { 1.0 } else { 0.0 };
        let rows = self.rows.chunks_exact(self.n + 1);
        let terms = rows.zip(&*self.multiplier);
        terms.fold(start, |sum, (row, z)| sum + row[column] * z)
    }

    /// How far the margin of the present forces may be below the greatest one; keeps the best forces and their margin.
    fn distance(&mut self) -> f64 {
        let n = self.n;
        let s = self.x[n - 1];
        // The margin of these forces is greater than s by what all slacks leave.
        let mut margin = f64::INFINITY;
        for (slack, weight) in self.slack.chunks_exact(ENTRIES).zip(&*self.weights) {
            if *weight > 0.0 {
                let left = slack[0] - length_of([slack[1], slack[2]]);
                margin = margin.min(left / weight);
            }
        }
        let off = (0..n).map(|c| (self.dual_residual(c) * self.x[c]).abs());
        let off: f64 = off.sum();
        let distance = self.gap() - margin + off;
        let margin = s + margin;
        if margin > self.margin {
            self.margin = margin;
            self.forces.copy_from_slice(self.x);
        }
        (distance - (self.margin - margin)).max(0.0)
    }

    /// The scaling with which slacks and multipliers are the same; false if rounding prevents one.
    fn scale(&mut self) -> bool {
        for cone in 0..self.cones {
            let multiplier = of_cone(self.multiplier, cone);
            let Some(scaling) = Scaling::new(of_cone(self.slack, cone), multiplier) else {
                return false;
            };
            let entries = ENTRIES * cone..ENTRIES * (cone + 1);
            self.axis[entries.clone()].copy_from_slice(&scaling.axis);
            self.factor[cone] = scaling.factor;
            self.scaled[entries].copy_from_slice(&scaling.times(multiplier));
        }
        true
    }

    fn scaling(&self, cone: usize) -> Scaling {
        Scaling {
            factor: self.factor[cone],
            axis: of_cone(self.axis, cone),
        }
    }

    /// `W⁻¹ s` of a cone.
    fn scaled_back(&self, cone: usize, s: Triple) -> Triple {
        self.scaling(cone).inverse_times(s)
    }

    /// `W⁻¹ A` of a cone, row by row.
    fn put_scaled_rows(&mut self, cone: usize) {
        let (n, width) = (self.n, self.n + 1);
        for column in 0..n {
            let own = [0, 1, 2].map(|entry| self.rows[(ENTRIES * cone + entry) * width + column]);
            let scaled = if own == [0.0; ENTRIES] {
                own
            } else {
                self.scaled_back(cone, own)
            };
            for (entry, x) in scaled.into_iter().enumerate() {
                self.scaled_rows[entry * n + column] = x;
            }
        }
    }

    /// The factor L of `Aᵀ W⁻² A = L Lᵀ`. A force that nothing depends on has no pivot, and does not change.
    fn factorize(&mut self) {
        let n = self.n;
        self.matrix.fill(0.0);
        for cone in 0..self.cones {
            self.put_scaled_rows(cone);
            for row in self.scaled_rows.chunks_exact(n) {
                for (i, x) in row.iter().enumerate().filter(|(_, x)| **x != 0.0) {
                    let entries = &mut self.matrix[i * n..][..=i];
                    for (entry, y) in entries.iter_mut().zip(row) {
                        *entry += x * y;
                    }
                }
            }
        }
        for j in 0..n {
            let diagonal = self.matrix[j * n + j];
            let (done, rest) = self.matrix.split_at_mut((j + 1) * n);
            let own = &mut done[j * n..];
            let left = diagonal - own[..j].iter().map(|x| x * x).sum::<f64>();
            let pivot = if left > f64::EPSILON * diagonal {
                sqrt(left)
            } else {
                0.0
            };
            own[j] = pivot;
            for row in rest.chunks_exact_mut(n) {
                let terms = row[..j].iter().zip(&own[..j]);
                let open = terms.fold(row[j], |sum, (x, y)| sum - x * y);
                row[j] = if pivot > 0.0 { open / pivot } else { 0.0 };
            }
        }
    }

    /// The changes with which scaled slacks and multipliers change by the right side together, and with which `Aᵀz = −c`. The matrix is
    /// ill-conditioned near the solution, so that the solution is refined with the residual of this condition.
    fn solve_step(&mut self) {
        let n = self.n;
        self.change.fill(0.0);
        self.multiplier_change.copy_from_slice(self.right);
        self.slack_change.fill(0.0);
        for _ in 0..=REFINEMENTS {
            self.put_open_dual_residual();
            self.solve_for_correction();
            for cone in 0..self.cones {
                let mut of_slack = [0.0; ENTRIES];
                for (entry, sum) in of_slack.iter_mut().enumerate() {
                    let row = &self.rows[(ENTRIES * cone + entry) * (n + 1)..][..n];
                    *sum = row.iter().zip(&*self.correction).map(|(a, x)| a * x).sum();
                }
                let of_slack = self.scaled_back(cone, of_slack);
                for (entry, x) in of_slack.into_iter().enumerate() {
                    let place = ENTRIES * cone + entry;
                    self.slack_change[place] += x;
                    self.multiplier_change[place] -= x;
                }
            }
            for (x, by) in self.change.iter_mut().zip(&*self.correction) {
                *x += by;
            }
        }
    }

    /// `Aᵀz + c` with the present change of the multipliers, for each unknown.
    fn put_open_dual_residual(&mut self) {
        let n = self.n;
        for column in 0..n {
            self.correction[column] = self.dual_residual(column);
        }
        for cone in 0..self.cones {
            let back = self.scaled_back(cone, of_cone(self.multiplier_change, cone));
            for (entry, back) in back.into_iter().enumerate() {
                let row = &self.rows[(ENTRIES * cone + entry) * (n + 1)..][..n];
                for (sum, a) in self.correction.iter_mut().zip(row) {
                    *sum += a * back;
                }
            }
        }
    }

    /// Solves `L Lᵀ x = correction`, in place.
    fn solve_for_correction(&mut self) {
        let n = self.n;
        for i in 0..n {
            let row = &self.matrix[i * n..][..=i];
            let terms = row[..i].iter().zip(&self.correction[..i]);
            let open = terms.fold(self.correction[i], |sum, (l, x)| sum - l * x);
            self.correction[i] = if row[i] > 0.0 { open / row[i] } else { 0.0 };
        }
        for i in (0..n).rev() {
            let pivot = self.matrix[i * n + i];
            let below = (i + 1..n).map(|j| self.matrix[j * n + i] * self.correction[j]);
            let open = below.fold(self.correction[i], |sum, x| sum - x);
            self.correction[i] = if pivot > 0.0 { open / pivot } else { 0.0 };
        }
    }

    /// How far slacks and multipliers may go.
    fn way(&self) -> f64 {
        (0..self.cones).fold(f64::INFINITY, |way, cone| {
            let lambda = of_cone(self.scaled, cone);
            let ways = [&*self.slack_change, &*self.multiplier_change]
                .map(|change| way_to_edge(lambda, of_cone(change, cone)));
            way.min(ways[0]).min(ways[1])
        })
    }

    /// The sum of the products after a step.
    fn gap_after(&self, way: f64) -> f64 {
        let changes = self.slack_change.iter().zip(&*self.multiplier_change);
        let pairs = self.scaled.iter().zip(changes);
        pairs.fold(0.0, |sum, (own, (s, z))| {
            sum + (own + way * s) * (own + way * z)
        })
    }

    /// The right side with which all products become equal, with those of the changes of the first step.
    fn put_corrected_right_side(&mut self, aim: f64) {
        for cone in 0..self.cones {
            let changes =
                [&*self.slack_change, &*self.multiplier_change].map(|change| of_cone(change, cone));
            let right = corrected_right_side(of_cone(self.scaled, cone), aim, changes);
            self.right[ENTRIES * cone..ENTRIES * (cone + 1)].copy_from_slice(&right);
        }
    }

    /// Takes the step; false if its length is zero or not a number, or the change is not finite.
    fn go(&mut self, way: f64) -> bool {
        if way.is_nan() || way <= 0.0 || self.change.iter().any(|x| !x.is_finite()) {
            return false;
        }
        for (x, by) in self.x.iter_mut().zip(&*self.change) {
            *x += way * by;
        }
        for cone in 0..self.cones {
            let change = self.scaled_back(cone, of_cone(self.multiplier_change, cone));
            let own = &mut self.multiplier[ENTRIES * cone..ENTRIES * (cone + 1)];
            for (z, by) in own.iter_mut().zip(change) {
                *z += way * by;
            }
        }
        self.put_slacks();
        true
    }

    /// Writes the forces that follow from others.
    fn put_forces(&mut self) {
        let (n, width) = (self.n, self.n + 1);
        for equation in (0..self.equations).rev() {
            let row = &self.following[equation * width..][..width];
            let terms = row[..n - 1].iter().zip(&*self.forces);
            let value = terms.fold(row[n], |sum, (a, x)| sum + a * x);
            self.forces[self.columns[equation] as usize] = value;
        }
    }

    /// How the contact of a cone limits the margin, if it does: where nothing is left of its cone, it presses no more.
    fn limit(&self, cone: usize) -> Option<Limit> {
        let own = &self.best_multiplier[ENTRIES * cone..][..ENTRIES];
        if own[0] * self.weights[cone] <= LIMITS {
            return None;
        }
        let size = length_of([own[1], own[2]]);
        Some(if size < (1.0 - LIMITS) * own[0] {
            Limit::Pressing
        } else {
            Limit::Friction([-own[1] / size, -own[2] / size])
        })
    }
}

/// Puts forces that follow from others into a row.
fn substitute(row: &mut [f64], following: &[f64], columns: &[f64]) {
    for (known, column) in following.chunks_exact(row.len()).zip(columns) {
        let column = *column as usize;
        let factor = core::mem::take(&mut row[column]);
        if factor != 0.0 {
            for (x, known) in row.iter_mut().zip(known) {
                *x += factor * known;
            }
        }
    }
}

/// The numbers of a cone.
fn of_cone(numbers: &[f64], cone: usize) -> Triple {
    let own = &numbers[ENTRIES * cone..][..ENTRIES];
    [own[0], own[1], own[2]]
}
