//! The search for an equilibrium or a steady motion: Newton's method on the forces r of (E39), with exact derivatives.
//!
//! The machine is displaced by `T ζ`, which the constraints allow, with `ζᵀ (Tᵀ M T) ζ` as small as possible, so inertia
//! defines distance. A coordinate on which r does not depend is not moved. Directions in which r changes only by round-off are
//! free, and steps have no component along them, nor along those in which r itself is round-off. So a machine that is already
//! in equilibrium is not moved.
//!
//! Rates that are to be found balance as much of r as they can; coordinates are displaced only for what remains.
//!
//! On the way to one of a continuum of equilibria, the stiffness along the others is not yet 0, but as small as the
//! remaining forces; a stiffness below these is meaningless. So steps are damped as in the method of Levenberg and
//! Marquardt, in proportion to these forces, which keeps quadratic convergence where equilibria are not isolated (N.
//! Yamashita and M. Fukushima, *On the rate of convergence of the Levenberg–Marquardt method*, Computing Suppl. 15 (2001)
//! 239–249). A step is accepted if r falls by a fraction of the reduction that its linearization predicts, or if the next
//! step, taken with the same matrix, is shorter: the natural monotonicity test (P. Deuflhard, *Newton Methods for Nonlinear
//! Problems*, 2004, section 3.3).
//!
//! Between two branches of equilibria |r| may have a positive minimum, about which steps oscillate. From there the machine is
//! moved along its accelerations, as if it fell, and Newton's method starts again.

use lagrangian_eigen::rank::{self, Direction};
use lagrangian_scalar::DoubleDouble;
use nalgebra::{DMatrix, DVector};

use crate::reduced::{Choice, Fault, Linearized, Reduced, ReducedState, largest_relative_change};

/// The most steps; Newton's method takes about five, and a few more for each radian of displacement.
pub const MOST_STEPS: usize = 200;

/// The most halvings of one step.
const MOST_HALVINGS: usize = 30;

/// The greatest length of a step, in rad, m, or relative to the coordinate.
const LONGEST_STEP: f64 = 1.0;

/// The search ends where the next step changes no coordinate by more than this, in rad, m, or relative to the
/// coordinate: the error after that step is about the square of this.
const TOLERANCE: f64 = 1e-10;

/// The damping relative to the largest stiffness, where the remaining forces would displace the machine by a
/// length of 1 or more.
const DAMPING: f64 = 0.1;

/// A force that no step can remove counts as zero if it is at most this many times the round-off of its terms.
const BALANCED: f64 = 1e3;

/// The length of a fall, a displacement along the accelerations, where forces do not change with position; in rad,
/// m, or relative to the coordinate.
const FALL: f64 = 0.25;

/// How much further than to a contact the machine falls, so that the contact presses.
const LANDING: f64 = 1.0 + 1e-6;

/// The most falls of this kind in a search.
const MOST_FALLS: usize = 8;

/// The search is stalled when the forces have not decreased by a tenth in this many steps.
const STALLED: usize = 15;

/// How many falls follow each other where the search is stalled, and how many times this is repeated.
const FALLS_AT_ONCE: usize = 4;
const MOST_STALLS: usize = 8;

/// What is known about a steady motion before the search.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// Coordinates that move steadily, at the rates of the start unless their rates are to be found.
    pub steady: Vec<bool>,
    /// Those of them whose rates are to be found.
    pub solved: Vec<bool>,
    /// Rates of all coordinates at the start.
    pub rates: Vec<f64>,
    /// The most steps.
    pub steps: usize,
}

impl Wanted {
    /// This request with states of first order, which are the rates of these coordinates, added.
    pub fn with_states(&self, integrals: &[bool]) -> Wanted {
        let mut wanted = self.clone();
        for (j, _) in integrals.iter().enumerate().filter(|(_, is)| **is) {
            wanted.solved[j] |= !wanted.steady[j];
            wanted.steady[j] = true;
        }
        wanted
    }

    /// The given rates of coordinates that move steadily; 0 for all others.
    pub fn given(&self) -> Vec<f64> {
        let rates = self.rates.iter().zip(&self.steady);
        rates
            .map(|(rate, is_steady)| if *is_steady { *rate } else { 0.0 })
            .collect()
    }
}

/// A state in which nothing accelerates.
#[derive(Clone)]
pub struct Stationary {
    /// The coordinates and rates.
    pub place: ReducedState,
    /// Which coordinates follow from which constraints.
    pub choice: Choice,
    /// The equations there.
    pub here: Linearized,
    /// Bounds on the effect of rounding on each entry of them.
    pub bounds: Linearized,
    /// How many steps it took.
    pub steps: usize,
}

/// Why the search found no state.
pub enum Lost {
    /// The equations cannot be evaluated at a state on the way.
    Fault(Fault),
    /// No step of Newton's method removes this acceleration, of a coordinate by its index.
    Accelerates(usize, f64),
    /// The search did not converge within this many steps.
    NoEnd(usize),
}

impl From<Fault> for Lost {
    fn from(fault: Fault) -> Lost {
        Lost::Fault(fault)
    }
}

/// Searches from `q` by Newton's method for a state without accelerations.
///
/// # Errors
/// If the search does not converge, or the equations cannot be evaluated on its way.
pub fn find(reduced: &mut Reduced<'_>, q: &[f64], wanted: &Wanted) -> Result<Stationary, Lost> {
    let mut q: Vec<DoubleDouble> = q.iter().map(|x| (*x).into()).collect();
    reduced.project(&mut q, &|_| true)?;
    let near: Vec<f64> = q.iter().map(|x| x.hi()).collect();
    let mut rates = wanted.rates.clone();
    let choice = reduced.choose(&near, &wanted.steady)?;
    let mut here = Point::new(reduced, choice, q, &rates, wanted)?;
    let mut falls = 0;
    let (mut least, mut least_at, mut stalls) = (f64::INFINITY, 0, 0);
    for steps in 0..wanted.steps {
        let norm = here.scaled.norm();
        if norm < 0.9 * least {
            (least, least_at) = (norm, steps);
        }
        if steps - least_at >= STALLED && stalls < MOST_STALLS {
            for _ in 0..FALLS_AT_ONCE {
                match here.displaced_by_forces(reduced, &here.scaled, (&mut rates, wanted), None) {
                    Some(there) => here = there,
                    None => break,
                }
            }
            (least, least_at, stalls) = (f64::INFINITY, steps, stalls + 1);
        }
        // As for a pendulum held level: the stiffness gives no direction, only the force does.
        if falls < MOST_FALLS && here.is_dominated_by_irreducible_forces() {
            match here.point_after_fall(reduced, &mut rates, wanted) {
                Some(there) => {
                    (here, falls) = (there, falls + 1);
                    continue;
                }
                None => falls = MOST_FALLS,
            }
        }
        let step = here.step();
        let longest = here.longest(&step);
        if longest <= TOLERANCE {
            // The last step is taken too, unless that would move a state that is exact already.
            if longest > 0.0 {
                match here.after_step(reduced, &step, 1.0, &mut rates.clone(), wanted) {
                    Ok(there) if there.scaled.norm() < here.scaled.norm() => here = there,
                    // The coordinates are singular at the end of this step, so a state beside it is meaningless.
                    Err(lost @ Lost::Fault(Fault::Singular(_))) => return Err(lost),
                    _ => {}
                }
            }
            return here.balanced(steps);
        }
        let mut part = (LONGEST_STEP / longest).min(1.0);
        let (mut next, mut fault) = (None, None);
        for _ in 0..MOST_HALVINGS {
            let mut moved_rates = rates.clone();
            match here.after_step(reduced, &step, part, &mut moved_rates, wanted) {
                Ok(there) if here.is_better(&there, &step, part) => {
                    next = Some((there, moved_rates));
                    break;
                }
                Ok(_) => {}
                // A step at whose end the equations cannot be evaluated is too long.
                Err(lost) => fault = fault.or(Some(lost)),
            }
            part /= 2.0;
        }
        match next {
            Some(next) => (here, rates) = next,
            None if here.largest_irreducible_force().is_some() => return here.balanced(steps),
            None => return Err(fault.unwrap_or(Lost::NoEnd(steps))),
        }
    }
    if here.is_dominated_by_irreducible_forces() {
        here.balanced(wanted.steps)
    } else {
        Err(Lost::NoEnd(wanted.steps))
    }
}

/// A step: a displacement along T, and a change of the rates that are to be found.
struct Step {
    along: DVector<f64>,
    rates: DVector<f64>,
}

/// A state on the constraints with all that a step from it needs.
struct Point {
    place: ReducedState,
    choice: Choice,
    here: Linearized,
    bounds: Linearized,
    /// Indices in I of the rates that are to be found.
    solved: Vec<usize>,
    /// `L` with `L Lᵀ = Tᵀ M T`, and the same with coordinates that stay decoupled from the others.
    lower: DMatrix<f64>,
    apart: DMatrix<f64>,
    /// L⁻¹ r, and a bound on the effect of rounding on it.
    scaled: DVector<f64>,
    rounding: DVector<f64>,
    /// The derivative of L⁻¹ r by L̃ᵀ ζ, without the components that the rates balance.
    stiffness: Vec<Direction>,
    /// The derivative of L⁻¹ r by the rates, each scaled by its own inertia.
    by_rates: Vec<Direction>,
    matrix: DMatrix<f64>,
    matrix_of_rates: DMatrix<f64>,
}

/// The coordinates that are not displaced: those that are given, and those on which nothing depends.
fn stays([here, bounds]: [&Linearized; 2], choice: &Choice, wanted: &Wanted) -> Vec<bool> {
    let count = choice.independent.len();
    let depends = here.dependence(choice);
    let rough = along_displacements([here, bounds], choice, |one| &one.as_balanced);
    let stays = |c: usize| {
        wanted.steady[choice.independent[c]]
            || (0..count).all(|i| depends[(i, c)].abs() <= rough[(i, c)])
    };
    (0..count).map(stays).collect()
}

/// A bound on the effect of rounding on the derivative of forces by displacements, from that of their derivative by positions.
fn along_displacements(
    [here, bounds]: [&Linearized; 2],
    choice: &Choice,
    by_places: impl Fn(&Linearized) -> &DMatrix<f64>,
) -> DMatrix<f64> {
    let (displaced, off) = (here.displaced(choice).abs(), bounds.displaced(choice));
    by_places(bounds) * displaced + by_places(here).abs() * off
}

/// A matrix without its components along the forces that rates balance.
fn without_balanced(mut matrix: DMatrix<f64>, by_rates: &[Direction]) -> DMatrix<f64> {
    for direction in by_rates.iter().filter(|d| !d.is_free()) {
        let share = direction.left.transpose() * &matrix;
        matrix -= &direction.left * share;
    }
    matrix
}

/// Cholesky factors of the inertia `Tᵀ M T`.
struct Factors {
    lower: DMatrix<f64>,
    /// The factor of the inertia in which coordinates that are decoupled from the others stay so.
    apart: DMatrix<f64>,
    /// The absolute values of `L⁻¹` and `L̃⁻ᵀ`, through which bounds propagate.
    size_left: DMatrix<f64>,
    size_right: DMatrix<f64>,
}

impl Factors {
    /// The factors, or the index of a coordinate whose remaining inertia is round-off.
    fn of(mass: &DMatrix<f64>, bounds: &DMatrix<f64>, stays: &[bool]) -> Result<Factors, usize> {
        let count = stays.len();
        let lower = factor(mass, bounds)?;
        let decoupled = DMatrix::from_fn(count, count, |i, j| {
            if i != j && (stays[i] || stays[j]) {
                0.0
            } else {
                mass[(i, j)]
            }
        });
        let apart = factor(&decoupled, bounds)?;
        let size = |l: &DMatrix<f64>| {
            let one = DMatrix::identity(count, count);
            l.solve_lower_triangular(&one).unwrap_or(one).abs()
        };
        Ok(Factors {
            size_left: size(&lower),
            size_right: size(&apart).transpose(),
            lower,
            apart,
        })
    }

    /// `L⁻¹ m`.
    fn left(&self, m: &DMatrix<f64>) -> DMatrix<f64> {
        let solved = self.lower.solve_lower_triangular(m);
        solved.unwrap_or_else(|| m.clone())
    }

    /// `m L̃⁻ᵀ`.
    fn right(&self, m: &DMatrix<f64>) -> DMatrix<f64> {
        let solved = self.apart.solve_lower_triangular(&m.transpose());
        solved.map_or_else(|| m.clone(), |m| m.transpose())
    }
}

impl Point {
    fn new(
        reduced: &mut Reduced<'_>,
        choice: Choice,
        q: Vec<DoubleDouble>,
        rates: &[f64],
        wanted: &Wanted,
    ) -> Result<Point, Lost> {
        let rate = |j: &usize| if wanted.steady[*j] { rates[*j] } else { 0.0 };
        let s = choice.independent.iter().map(|j| rate(j).into()).collect();
        let place = ReducedState { q, s };
        let (here, bounds) = reduced.linearized(&choice, &place)?;
        let count = choice.independent.len();
        let stays = stays([&here, &bounds], &choice, wanted);
        let factors = Factors::of(&here.mass, &bounds.mass, &stays)
            .map_err(|k| Fault::Singular(choice.independent[k]))?;
        // A coordinate that stays has no displacement.
        let kept = |m: &DMatrix<f64>| {
            DMatrix::from_fn(count, count, |i, c| if stays[c] { 0.0 } else { m[(i, c)] })
        };
        let stiffness = here.stiffness(&choice);
        let rough = along_displacements([&here, &bounds], &choice, |one| &one.covariant);
        let (stiffness, rough) = (kept(&without_roundoff(&stiffness, &rough)), kept(&rough));
        let original = factors.right(&factors.left(&stiffness));
        let mut rough = &factors.size_left * rough * &factors.size_right;

        let solved: Vec<usize> = (0..count)
            .filter(|c| wanted.solved[choice.independent[*c]])
            .collect();
        let columns = |m: &DMatrix<f64>| {
            DMatrix::from_fn(count, count, |i, c| {
                // Padded to a square matrix, which the rank computation requires.
                solved
                    .get(c)
                    .map_or(0.0, |j| m[(i, *j)] / factors.lower[(*j, *j)])
            })
        };
        let (by_rates, rough_rates) = (columns(&here.by_rates), columns(&bounds.by_rates));
        let matrix_of_rates = factors.left(&without_roundoff(&by_rates, &rough_rates));
        let not_finite = || {
            Lost::Fault(Fault::NotFinite(
                choice.independent.first().copied().unwrap_or(0),
            ))
        };
        let rough_rates = &factors.size_left * rough_rates;
        let by_rates = rank::directions_beyond(&matrix_of_rates, &rough_rates);
        let by_rates = by_rates.ok_or_else(not_finite)?;
        let mut matrix = without_balanced(original.clone(), &by_rates);
        if !solved.is_empty() {
            // Projecting out the components that the rates balance leaves round-off of the size of the whole matrix.
            let size = rank::tolerance(count) * original.norm();
            rough += DMatrix::from_element(count, count, size);
            matrix = without_roundoff(&matrix, &rough);
        }
        let stiffness = rank::directions_beyond(&matrix, &rough).ok_or_else(not_finite)?;
        let forces = here.forces.column(0).into_owned();
        let Factors {
            lower,
            apart,
            size_left,
            ..
        } = factors;
        Ok(Point {
            scaled: lower.solve_lower_triangular(&forces).unwrap_or(forces),
            rounding: &size_left * bounds.forces.column(0),
            matrix: original,
            stiffness,
            matrix_of_rates,
            by_rates,
            lower,
            apart,
            place,
            choice,
            here,
            bounds,
            solved,
        })
    }

    /// The shortest step that reduces r as far as possible.
    fn step(&self) -> Step {
        self.step_for(&self.scaled)
    }

    /// The step for other forces, with the damping that the forces of this point require.
    fn step_for(&self, forces: &DVector<f64>) -> Step {
        let count = self.scaled.len();
        let mut along = DVector::zeros(count);
        // Removes the components that the rates balance.
        let without = |forces: &DVector<f64>| {
            let mut left = forces.clone();
            for direction in self.by_rates.iter().filter(|d| !d.is_free()) {
                left -= &direction.left * direction.left.dot(forces);
            }
            left
        };
        let (left, damping) = (without(forces), without(&self.scaled));
        let q = &self.place.q;
        for direction in self.stiffness.iter().filter(|d| !d.is_free()) {
            let rounding = direction.left.abs().dot(&self.rounding);
            let force = direction.left.dot(&left);
            if force.abs() <= rounding {
                continue;
            }
            // How far the whole remaining force would displace the stiffest direction of this block, at most 1.
            let shares = direction.part.iter().map(|&i| {
                let yields = damping[i] / direction.largest / self.lower[(i, i)];
                yields.abs() / q[self.choice.independent[i]].hi().abs().max(1.0)
            });
            let damping = DAMPING * direction.largest * shares.fold(0.0, f64::max).min(1.0);
            let value = direction.value;
            // About 1/σ where σ is large beside the damping.
            let inverse = 1.0 / (value + damping * (damping / value));
            along -= &direction.right * (force * inverse);
        }
        let mut rates = DVector::zeros(count);
        let remains = forces + &self.matrix * &along;
        for direction in self.by_rates.iter().filter(|d| !d.is_free()) {
            let force = direction.left.dot(&remains);
            if force.abs() > direction.left.abs().dot(&self.rounding) {
                rates -= &direction.right * (force / direction.value);
            }
        }
        Step { along, rates }
    }

    /// A step as a change of the coordinates.
    fn in_coordinates(&self, step: &Step) -> DVector<f64> {
        let along = self.apart.transpose().solve_upper_triangular(&step.along);
        &self.here.along * along.unwrap_or_else(|| step.along.clone())
    }

    fn rates_of(&self, step: &Step) -> DVector<f64> {
        let rate = |(k, c): (usize, &usize)| step.rates[k] / self.lower[(*c, *c)];
        DVector::from_iterator(self.solved.len(), self.solved.iter().enumerate().map(rate))
    }

    /// The largest change, each in rad, m, or relative to its coordinate.
    fn longest(&self, step: &Step) -> f64 {
        let rates: Vec<f64> = self.solved.iter().map(|c| self.place.s[*c].hi()).collect();
        let change = largest_relative_change(&self.rates_of(step), &rates);
        largest_relative_change(&self.in_coordinates(step), &self.place.q()).max(change)
    }

    /// The point after a fraction of a step.
    fn after_step(
        &self,
        reduced: &mut Reduced<'_>,
        step: &Step,
        part: f64,
        rates: &mut [f64],
        wanted: &Wanted,
    ) -> Result<Point, Lost> {
        let displaced = self.in_coordinates(step);
        let mut q = self.place.q.clone();
        for (q, x) in q.iter_mut().zip(displaced.iter()) {
            *q = *q + DoubleDouble::from(part * x);
        }
        // Coordinates that are given or that stay are not moved by the projection onto the constraints.
        let gives = |j: usize| displaced[j] != 0.0 || self.choice.position_dependent.contains(&j);
        let alone = q.clone();
        if reduced.project_near(&mut q, &gives).is_err() {
            q = alone;
            reduced.project_near(&mut q, &|_| true)?;
        }
        for (c, x) in self.solved.iter().zip(self.rates_of(step).iter()) {
            rates[self.choice.independent[*c]] += part * x;
        }
        let near: Vec<f64> = q.iter().map(|x| x.hi()).collect();
        let choice = reduced.choose(&near, &wanted.steady)?;
        Point::new(reduced, choice, q, rates, wanted)
    }

    fn is_better(&self, there: &Point, step: &Step, part: f64) -> bool {
        let predicted = &self.scaled
            + (&self.matrix * &step.along + &self.matrix_of_rates * &step.rates) * part;
        let (before, after) = (self.scaled.norm(), there.scaled.norm());
        let promised = before - predicted.norm();
        if promised > 0.0 && after <= before - 0.25 * promised {
            return true;
        }
        // The next step is measured in the metric of this point, if the same coordinates are independent there.
        if there.choice.independent != self.choice.independent {
            return false;
        }
        let forces = there.here.forces.column(0).into_owned();
        let Some(forces) = self.lower.solve_lower_triangular(&forces) else {
            return false;
        };
        let length = |step: &Step| step.along.norm() + step.rates.norm();
        let norm = length(step);
        length(&self.step_for(&forces)) <= (1.0 - part / 4.0) * norm
            || length(&self.step_for(&(forces - predicted))) <= 0.75 * part * norm
    }

    /// Whether forces that no step can remove are most of the remaining forces.
    fn is_dominated_by_irreducible_forces(&self) -> bool {
        self.largest_irreducible_force().is_some()
            && self.remaining().norm() >= 0.5 * self.scaled.norm()
    }

    /// The point after a fall along the forces that no step can remove, provided that these change there.
    fn point_after_fall(
        &self,
        reduced: &mut Reduced<'_>,
        rates: &mut [f64],
        wanted: &Wanted,
    ) -> Option<Point> {
        self.largest_irreducible_force()?;
        // A contact that yields may take up the forces: the machine falls onto the first one in its way.
        if let Some(there) = self.landed(reduced, rates, wanted) {
            return Some(there);
        }
        let remaining = self.remaining();
        let there = self.displaced_by_forces(reduced, &remaining, (rates, wanted), None)?;
        let is_other = there.choice != self.choice || {
            let (now, then) = (&self.here.forces, &there.here.forces);
            let bounds = &self.bounds.forces + &there.bounds.forces;
            (0..now.nrows()).any(|i| (now[i] - then[i]).abs() > bounds[i])
        };
        is_other.then_some(there)
    }

    /// The point where the forces that no step can remove press the machine on a contact that yields and that was open.
    fn landed(
        &self,
        reduced: &mut Reduced<'_>,
        rates: &mut [f64],
        wanted: &Wanted,
    ) -> Option<Point> {
        let forces = self.remaining();
        let along = self.pulled(&forces, wanted)?;
        let displaced = &self.here.along * &along;
        let after = reduced.closes_after(&self.place, displaced.as_slice())?;
        self.displaced_by_forces(reduced, &forces, (rates, wanted), Some(after * LANDING))
    }

    /// The accelerations that forces cause, of the coordinates that are not prescribed.
    fn pulled(&self, forces: &DVector<f64>, wanted: &Wanted) -> Option<DVector<f64>> {
        let along = self.lower.transpose().solve_upper_triangular(forces)?;
        let is_prescribed = |c: usize| wanted.steady[self.choice.independent[c]];
        Some(DVector::from_fn(along.len(), |c, _| {
            if is_prescribed(c) { 0.0 } else { along[c] }
        }))
    }

    /// The point to which the forces pull the machine: after `times` their accelerations, or after a fall of the usual length.
    fn displaced_by_forces(
        &self,
        reduced: &mut Reduced<'_>,
        forces: &DVector<f64>,
        (rates, wanted): (&mut [f64], &Wanted),
        times: Option<f64>,
    ) -> Option<Point> {
        let along = self.pulled(forces, wanted)?;
        let displaced = &self.here.along * &along;
        let longest = largest_relative_change(&displaced, &self.place.q());
        if !(longest > 0.0 && longest.is_finite()) {
            return None;
        }
        let step = Step {
            along: self.apart.transpose() * along,
            rates: DVector::zeros(self.scaled.len()),
        };
        let times = times.unwrap_or(FALL / longest);
        self.after_step(reduced, &step, times, rates, wanted).ok()
    }

    /// The part of the forces that no step can remove.
    fn remaining(&self) -> DVector<f64> {
        let mut left = self.scaled.clone();
        for directions in [&self.by_rates, &self.stiffness] {
            for direction in directions.iter().filter(|d| !d.is_free()) {
                left -= &direction.left * direction.left.dot(&left);
            }
        }
        left
    }

    /// Of the forces that no step can remove, the one furthest from zero, if any exceeds round-off.
    fn largest_irreducible_force(&self) -> Option<usize> {
        let left = self.remaining();
        // A force that cancels in one coordinate may leave round-off in another one that is coupled to it.
        let together = self.rounding.norm();
        let share = |i: usize| {
            let limit = together.max(BALANCED * self.rounding[i]);
            if left[i].abs() <= limit {
                0.0
            } else {
                left[i].abs()
            }
        };
        let worst = (0..left.len()).max_by(|&i, &j| share(i).total_cmp(&share(j)))?;
        (share(worst) > 0.0).then_some(worst)
    }

    /// The result at the end of the search, if forces are in balance there.
    fn balanced(self, steps: usize) -> Result<Stationary, Lost> {
        if let Some(worst) = self.largest_irreducible_force() {
            let a = self.lower.transpose().solve_upper_triangular(&self.scaled);
            let a = a.unwrap_or_else(|| self.scaled.clone());
            // Through inertia the force may show as the acceleration of another coordinate.
            let share = |i: &usize| (a[*i] * self.lower[(*i, *i)]).abs();
            let index = (0..a.len()).max_by(|i, j| share(i).total_cmp(&share(j)));
            let index = index.unwrap_or(worst);
            return Err(Lost::Accelerates(self.choice.independent[index], a[index]));
        }
        Ok(Stationary {
            place: self.place,
            choice: self.choice,
            here: self.here,
            bounds: self.bounds,
            steps,
        })
    }
}

/// `L` of a positive definite matrix, or the index of the pivot that is not positive.
///
/// `bounds` bounds the effect of rounding on each entry.
fn factor(mass: &DMatrix<f64>, bounds: &DMatrix<f64>) -> Result<DMatrix<f64>, usize> {
    let n = mass.nrows();
    let mut lower = DMatrix::zeros(n, n);
    for j in 0..n {
        for i in j..n {
            let known: f64 = (0..j).map(|k| lower[(i, k)] * lower[(j, k)]).sum();
            let left = mass[(i, j)] - known;
            if i == j {
                // The remaining pivot is round-off.
                let rounding = bounds[(j, j)].max(rank::tolerance(n) * mass[(j, j)].abs());
                if left.is_nan() || left <= rounding {
                    return Err(j);
                }
                lower[(j, j)] = left.sqrt();
            } else {
                lower[(i, j)] = left / lower[(j, j)];
            }
        }
    }
    Ok(lower)
}

/// Sets entries within their bounds to 0.
pub fn without_roundoff(matrix: &DMatrix<f64>, bounds: &DMatrix<f64>) -> DMatrix<f64> {
    matrix.zip_map(bounds, |x, bound| if x.abs() <= bound { 0.0 } else { x })
}
