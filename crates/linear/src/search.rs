//! Where a machine stays, or moves steadily: Newton's method on the forces r of (E39), with their exact derivatives.
//!
//! The machine is displaced as it may move, by `T ζ` with `ζᵀ (Tᵀ M T) ζ` as small as can be: inertia measures what is near. A
//! coordinate on which r does not depend stays where it is. Directions in which r does not change but for rounding are free,
//! and nothing moves along them; nor along those in which r itself is nothing but rounding. So a machine that stands stays.
//!
//! Rates that are to be found balance as much of r as they can; coordinates are displaced for its residual only.
//!
//! On the way to one of many equilibria the stiffness along the others is not yet 0, but as small as the forces that remain;
//! what comes to less than those says nothing. So steps are damped as Levenberg and Marquardt do, by the size of these
//! forces, which keeps the convergence quadratic where equilibria are not alone (N. Yamashita and M. Fukushima, *On the rate of
//! convergence of the Levenberg–Marquardt method*, Computing Suppl. 15 (2001) 239–249). A step is kept if r falls by a share of
//! what its linearization promises, or if the next step, taken with the same matrix, is shorter: the natural monotonicity test
//! (P. Deuflhard, *Newton Methods for Nonlinear Problems*, 2004, section 3.3).
//!
//! Between two branches of equilibria r may have a least length that is not 0, about which steps go to and fro. From there the
//! machine falls along its accelerations, and Newton's method begins again.

use lagrangian_scalar::DoubleDouble;
use nalgebra::{DMatrix, DVector};

use crate::rank::{self, Direction};
use crate::reduced::{Choice, Fault, Linearized, Place, Reduced, share};

/// The most steps; Newton's method takes five, and a few more for each radian on the way.
pub const MOST_STEPS: usize = 200;

/// The most halvings of one step.
const MOST_HALVINGS: usize = 30;

/// A step is as long as this at most, in rad, m, or as a share of the coordinate.
const LONGEST_STEP: f64 = 1.0;

/// Steps end where the next one changes no coordinate by more than this, in rad, m, or as a share of the coordinate: the
/// error after it is about the square of that.
const TOLERANCE: f64 = 1e-10;

/// A stiffness counts if it is more than this share of what forces, off zero by a step of one, would make of it.
const DAMPING: f64 = 0.1;

/// A force that cannot be taken away is none if it comes to no more than so many roundings of its terms.
const BALANCED: f64 = 1e3;

/// How far the machine falls where forces pull and nothing changes with the place, in rad, m, or as a share of the coordinate.
const FALL: f64 = 0.25;

/// The most such falls.
const MOST_FALLS: usize = 8;

/// Forces that have not fallen by a tenth in so many steps have stopped falling.
const STALLED: usize = 15;

/// How far a machine falls then, in falls one after the other, and the most times that it does.
const FALLS_AT_ONCE: usize = 4;
const MOST_STALLS: usize = 8;

/// What is given of a steady motion.
#[derive(Clone, Debug)]
pub struct Wanted {
    /// Coordinates that move steadily, at the rates of the start, whatever is found for them.
    pub steady: Vec<bool>,
    /// Those of them whose rates are to be found.
    pub solved: Vec<bool>,
    /// Rates of all coordinates at the start.
    pub rates: Vec<f64>,
    /// The most steps.
    pub steps: usize,
}

impl Wanted {
    /// These quantities, and states of first order, which are the rates of these coordinates.
    pub fn with_states(&self, integrals: &[bool]) -> Wanted {
        let mut wanted = self.clone();
        for (j, _) in integrals.iter().enumerate().filter(|(_, is)| **is) {
            wanted.solved[j] |= !wanted.steady[j];
            wanted.steady[j] = true;
        }
        wanted
    }

    /// Rates of the coordinates that move steadily, as far as they are given, and 0 of the others.
    pub fn given(&self) -> Vec<f64> {
        let rates = self.rates.iter().zip(&self.steady);
        rates
            .map(|(rate, is_steady)| if *is_steady { *rate } else { 0.0 })
            .collect()
    }
}

/// A state in which nothing accelerates.
#[derive(Clone)]
pub struct Found {
    /// Where, and with which rates.
    pub place: Place,
    /// Which coordinates follow from which constraints.
    pub choice: Choice,
    /// The equations there.
    pub here: Linearized,
    /// What rounding may make of each number of them.
    pub bounds: Linearized,
    /// How many steps it took.
    pub steps: usize,
}

/// Why there is none.
pub enum Lost {
    /// There are no numbers on the way.
    Fault(Fault),
    /// Nothing that Newton's method can do removes this acceleration, of a coordinate by its index.
    Accelerates(usize, f64),
    /// No end was reached.
    NoEnd(usize),
}

impl From<Fault> for Lost {
    fn from(fault: Fault) -> Lost {
        Lost::Fault(fault)
    }
}

/// The state that Newton's method reaches from `q`.
///
/// # Errors
/// If there is none on its way.
pub fn find(reduced: &mut Reduced<'_>, q: &[f64], wanted: &Wanted) -> Result<Found, Lost> {
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
                match here.fallen_by(reduced, &here.scaled, &mut rates, wanted) {
                    Some(there) => here = there,
                    None => break,
                }
            }
            (least, least_at, stalls) = (f64::INFINITY, steps, stalls + 1);
        }
        // A pendulum that is held level: nothing that is near says where to go but the force itself.
        if falls < MOST_FALLS && here.is_stuck() {
            match here.fallen(reduced, &mut rates, wanted) {
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
            // The last step is taken too, unless it would leave what is exact already.
            if longest > 0.0 {
                match here.moved(reduced, &step, 1.0, &mut rates.clone(), wanted) {
                    Ok(there) if there.scaled.norm() < here.scaled.norm() => here = there,
                    // Where it would end the coordinates fail: beside that place they say nothing.
                    Err(lost @ Lost::Fault(Fault::Singular(_))) => return Err(lost),
                    _ => {}
                }
            }
            return here.settled(steps);
        }
        let mut part = (LONGEST_STEP / longest).min(1.0);
        let (mut next, mut fault) = (None, None);
        for _ in 0..MOST_HALVINGS {
            let mut moved_rates = rates.clone();
            match here.moved(reduced, &step, part, &mut moved_rates, wanted) {
                Ok(there) if here.is_better(&there, &step, part) => {
                    next = Some((there, moved_rates));
                    break;
                }
                Ok(_) => {}
                // A state without forces is one step too far.
                Err(lost) => fault = fault.or(Some(lost)),
            }
            part /= 2.0;
        }
        match next {
            Some(next) => (here, rates) = next,
            None if here.left_over().is_some() => return here.settled(steps),
            None => return Err(fault.unwrap_or(Lost::NoEnd(steps))),
        }
    }
    if here.is_stuck() {
        here.settled(wanted.steps)
    } else {
        Err(Lost::NoEnd(wanted.steps))
    }
}

/// How the machine is displaced: along T, and in the rates that are to be found.
struct Step {
    along: DVector<f64>,
    rates: DVector<f64>,
}

/// A state on the constraints, with what a step from it needs.
struct Point {
    place: Place,
    choice: Choice,
    here: Linearized,
    bounds: Linearized,
    /// Places in I of the rates that are to be found.
    solved: Vec<usize>,
    /// `L` with `L Lᵀ = Tᵀ M T`, and the same with coordinates that stay apart from the others.
    lower: DMatrix<f64>,
    apart: DMatrix<f64>,
    /// L⁻¹ r, and what rounding may make of it.
    scaled: DVector<f64>,
    rounding: DVector<f64>,
    /// How it changes with L̃ᵀ ζ, without what the rates take.
    stiffness: Vec<Direction>,
    /// How it changes with the rates, each in the length of its own inertia.
    by_rates: Vec<Direction>,
    matrix: DMatrix<f64>,
    matrix_of_rates: DMatrix<f64>,
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
        let place = Place { q, s };
        let (here, bounds) = reduced.linearized(&choice, &place)?;
        let count = choice.independent.len();
        let lower =
            factor(&here.mass, &bounds.mass).map_err(|k| Fault::Singular(choice.independent[k]))?;
        // A coordinate that is given, or that nothing depends on, stays.
        let displaced = here.displaced(&choice);
        let of = |here: &DMatrix<f64>, rough: &DMatrix<f64>| {
            let (displaced, off) = (displaced.abs(), bounds.displaced(&choice));
            rough * displaced + here.abs() * off
        };
        let depends = here.dependence(&choice);
        let rough = of(&here.as_balanced, &bounds.as_balanced);
        let stays = |c: usize| {
            wanted.steady[choice.independent[c]]
                || (0..count).all(|i| depends[(i, c)].abs() <= rough[(i, c)])
        };
        let stays: Vec<bool> = (0..count).map(stays).collect();
        let mass = DMatrix::from_fn(count, count, |i, j| {
            if i != j && (stays[i] || stays[j]) {
                0.0
            } else {
                here.mass[(i, j)]
            }
        });
        let apart =
            factor(&mass, &bounds.mass).map_err(|k| Fault::Singular(choice.independent[k]))?;
        let left = |m: &DMatrix<f64>| lower.solve_lower_triangular(m).unwrap_or_else(|| m.clone());
        let right = |m: &DMatrix<f64>| {
            let solved = apart.solve_lower_triangular(&m.transpose());
            solved.map_or_else(|| m.clone(), |m| m.transpose())
        };
        // Sizes pass through the same factors without their signs.
        let inverse = |l: &DMatrix<f64>| {
            let one = DMatrix::identity(count, count);
            l.solve_lower_triangular(&one).unwrap_or(one).abs()
        };
        let (size_left, size_right) = (inverse(&lower), inverse(&apart).transpose());
        let kept = |m: &DMatrix<f64>| {
            DMatrix::from_fn(count, count, |i, c| if stays[c] { 0.0 } else { m[(i, c)] })
        };
        let stiffness = here.stiffness(&choice);
        let rough = of(&here.covariant, &bounds.covariant);
        let (stiffness, rough) = (kept(&settled(&stiffness, &rough)), kept(&rough));
        let mut matrix = right(&left(&stiffness));
        let mut rough = &size_left * rough * &size_right;

        let solved: Vec<usize> = (0..count)
            .filter(|c| wanted.solved[choice.independent[*c]])
            .collect();
        let columns = |m: &DMatrix<f64>| {
            DMatrix::from_fn(count, count, |i, c| {
                // Square, as the ranks of matrices are found.
                solved.get(c).map_or(0.0, |j| m[(i, *j)] / lower[(*j, *j)])
            })
        };
        let (by_rates, rough_rates) = (columns(&here.by_rates), columns(&bounds.by_rates));
        let matrix_of_rates = left(&settled(&by_rates, &rough_rates));
        let not_finite = || {
            Lost::Fault(Fault::NotFinite(
                choice.independent.first().copied().unwrap_or(0),
            ))
        };
        let by_rates = rank::directions_beyond(&matrix_of_rates, &(&size_left * rough_rates));
        let by_rates = by_rates.ok_or_else(not_finite)?;
        let whole = matrix.clone();
        for direction in by_rates.iter().filter(|d| !d.is_free()) {
            let share = direction.left.transpose() * &matrix;
            matrix -= &direction.left * share;
        }
        if !solved.is_empty() {
            // What the rates take from a row leaves roundings of the whole row.
            let size = rank::tolerance(count) * whole.norm();
            let size = DMatrix::from_element(count, count, size);
            rough += size;
            matrix = settled(&matrix, &rough);
        }
        let stiffness = rank::directions_beyond(&matrix, &rough).ok_or_else(not_finite)?;
        let forces = here.forces.column(0).into_owned();
        Ok(Point {
            scaled: lower.solve_lower_triangular(&forces).unwrap_or(forces),
            rounding: &size_left * bounds.forces.column(0),
            matrix: whole,
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

    /// The shortest step that removes r as far as any does.
    fn step(&self) -> Step {
        self.step_for(&self.scaled)
    }

    /// The step for other forces, with the damping that these ask for.
    fn step_for(&self, forces: &DVector<f64>) -> Step {
        let count = self.scaled.len();
        let mut along = DVector::zeros(count);
        // What the rates do not take.
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
            // How far the stiffest direction of this part would yield to the whole residual of its forces, at most 1.
            let shares = direction.part.iter().map(|&i| {
                let yields = damping[i] / direction.largest / self.lower[(i, i)];
                yields.abs() / q[self.choice.independent[i]].hi().abs().max(1.0)
            });
            let damping = DAMPING * direction.largest * shares.fold(0.0, f64::max).min(1.0);
            let value = direction.value;
            // 1/σ where σ is large.
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

    /// A step in the coordinates themselves.
    fn in_coordinates(&self, step: &Step) -> DVector<f64> {
        let along = self.apart.transpose().solve_upper_triangular(&step.along);
        &self.here.along * along.unwrap_or_else(|| step.along.clone())
    }

    fn rates_of(&self, step: &Step) -> DVector<f64> {
        let rate = |(k, c): (usize, &usize)| step.rates[k] / self.lower[(*c, *c)];
        DVector::from_iterator(self.solved.len(), self.solved.iter().enumerate().map(rate))
    }

    /// The largest of the changes, each in rad, m, or as a share.
    fn longest(&self, step: &Step) -> f64 {
        let rates: Vec<f64> = self.solved.iter().map(|c| self.place.s[*c].hi()).collect();
        let change = share(&self.rates_of(step), &rates);
        share(&self.in_coordinates(step), &self.place.q()).max(change)
    }

    /// A part of a step further.
    fn moved(
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
        // What is given and what stays does not give way to the constraints.
        let gives = |j: usize| displaced[j] != 0.0 || self.choice.tied.contains(&j);
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
        // In the same lengths as here, if the same coordinates are independent.
        if there.choice.independent != self.choice.independent {
            return false;
        }
        let forces = there.here.forces.column(0).into_owned();
        let Some(forces) = self.lower.solve_lower_triangular(&forces) else {
            return false;
        };
        let length = |step: &Step| step.along.norm() + step.rates.norm();
        let whole = length(step);
        length(&self.step_for(&forces)) <= (1.0 - part / 4.0) * whole
            || length(&self.step_for(&(forces - predicted))) <= 0.75 * part * whole
    }

    /// Whether forces that no step would remove are most of what there is.
    fn is_stuck(&self) -> bool {
        self.left_over().is_some() && self.remaining().norm() >= 0.5 * self.scaled.norm()
    }

    /// Where forces that no step would remove pull it, if they are others there.
    fn fallen(
        &self,
        reduced: &mut Reduced<'_>,
        rates: &mut [f64],
        wanted: &Wanted,
    ) -> Option<Point> {
        self.left_over()?;
        let there = self.fallen_by(reduced, &self.remaining(), rates, wanted)?;
        let is_other = there.choice != self.choice || {
            let (now, then) = (&self.here.forces, &there.here.forces);
            let bounds = &self.bounds.forces + &there.bounds.forces;
            (0..now.nrows()).any(|i| (now[i] - then[i]).abs() > bounds[i])
        };
        is_other.then_some(there)
    }

    /// Where forces pull it.
    fn fallen_by(
        &self,
        reduced: &mut Reduced<'_>,
        forces: &DVector<f64>,
        rates: &mut [f64],
        wanted: &Wanted,
    ) -> Option<Point> {
        let along = self.lower.transpose().solve_upper_triangular(forces)?;
        let given = |c: usize| wanted.steady[self.choice.independent[c]];
        let along = DVector::from_fn(along.len(), |c, _| if given(c) { 0.0 } else { along[c] });
        let displaced = &self.here.along * &along;
        let longest = share(&displaced, &self.place.q());
        if !(longest > 0.0 && longest.is_finite()) {
            return None;
        }
        let step = Step {
            along: self.apart.transpose() * along,
            rates: DVector::zeros(self.scaled.len()),
        };
        self.moved(reduced, &step, FALL / longest, rates, wanted)
            .ok()
    }

    /// What no step would remove of the forces.
    fn remaining(&self) -> DVector<f64> {
        let mut left = self.scaled.clone();
        for directions in [&self.by_rates, &self.stiffness] {
            for direction in directions.iter().filter(|d| !d.is_free()) {
                left -= &direction.left * direction.left.dot(&left);
            }
        }
        left
    }

    /// Of the forces that no step would remove the one that is most off zero, if one is by more than rounding.
    fn left_over(&self) -> Option<usize> {
        let left = self.remaining();
        // What comes to nothing in one coordinate may be rounded in another, that is coupled to it.
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

    /// The end of the way, if forces are in balance there.
    fn settled(self, steps: usize) -> Result<Found, Lost> {
        if let Some(worst) = self.left_over() {
            let a = self.lower.transpose().solve_upper_triangular(&self.scaled);
            let a = a.unwrap_or_else(|| self.scaled.clone());
            // Inertia may hand the force on to another coordinate.
            let share = |i: &usize| (a[*i] * self.lower[(*i, *i)]).abs();
            let index = (0..a.len()).max_by(|i, j| share(i).total_cmp(&share(j)));
            let index = index.unwrap_or(worst);
            return Err(Lost::Accelerates(self.choice.independent[index], a[index]));
        }
        Ok(Found {
            place: self.place,
            choice: self.choice,
            here: self.here,
            bounds: self.bounds,
            steps,
        })
    }
}

/// `L` of a positive definite matrix, or the index at which it is not.
///
/// `bounds` is what rounding may make of each number of it.
fn factor(mass: &DMatrix<f64>, bounds: &DMatrix<f64>) -> Result<DMatrix<f64>, usize> {
    let n = mass.nrows();
    let mut lower = DMatrix::zeros(n, n);
    for j in 0..n {
        for i in j..n {
            let known: f64 = (0..j).map(|k| lower[(i, k)] * lower[(j, k)]).sum();
            let left = mass[(i, j)] - known;
            if i == j {
                // The remainder is rounding.
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

/// What may be rounding is 0.
pub fn settled(matrix: &DMatrix<f64>, bounds: &DMatrix<f64>) -> DMatrix<f64> {
    matrix.zip_map(bounds, |x, bound| if x.abs() <= bound { 0.0 } else { x })
}
