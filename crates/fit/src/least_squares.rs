//! Nonlinear least squares with bounds, by the method of Levenberg and Marquardt with a trust region.
//!
//! The search minimizes `½ |r(x)|²` over numbers x within bounds. A step δ minimizes the linear model `|r + J δ|` subject to
//! `|D δ| ≤ Δ`. The radius Δ adapts to how well the model predicted the effect of the last step, and D, the greatest norms that
//! the columns of J have had, makes everything independent of units (J. J. Moré, *The Levenberg–Marquardt algorithm:
//! implementation and theory*, Lecture Notes in Mathematics 630 (1978) 105–116). The linear problem is solved by singular value
//! decomposition, which detects directions on which the residuals do not depend; steps have no component along them.
//!
//! A number at a bound stays there if the sum of squares falls only outward. Where a step would carry a number over its bound,
//! the number is set to the bound and the step of the others is computed anew; if short enough, such a step reduces the sum
//! wherever x can move (C. Kanzow, N. Yamashita, M. Fukushima, *Levenberg–Marquardt methods with strong local convergence
//! properties for solving nonlinear equations with convex constraints*, J. Comput. Appl. Math. 172 (2004) 375–397).

use nalgebra::{DMatrix, DVector};

/// Why residuals could not be computed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// The residuals are undefined at these numbers, though they may exist after a shorter step. The text says
    /// why, as a sentence.
    NoValue(String),
    /// The search was interrupted.
    Stopped,
}

/// Residuals and their derivatives.
pub trait Problem {
    /// The residuals at x, always in the same order.
    ///
    /// # Errors
    /// If they are undefined there.
    fn residuals(&mut self, x: &[f64]) -> Result<Vec<f64>, Trouble>;

    /// Their derivatives at x, a column for each number of x.
    ///
    /// # Errors
    /// If they are undefined there.
    fn jacobian(&mut self, x: &[f64]) -> Result<DMatrix<f64>, Trouble>;

    /// The norm of the terms of which the residuals are differences, which measures their round-off; by default the
    /// norm of the residuals.
    fn size(&self, residuals: &[f64]) -> f64 {
        norm(residuals)
    }
}

/// Stopping criteria of a search.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Stop where the part of the residuals that a step could still remove is this fraction of the rest, each per degree
    /// of freedom. It measures the distance of x from the minimum in standard errors (D. M. Bates, D. G. Watts, *A
    /// relative offset orthogonality convergence criterion for nonlinear least squares*, Technometrics 23 (1981) 179–183).
    pub offset: f64,
    /// Stop where a step is this fraction of x, in the norm of D.
    pub step: f64,
    /// Stop where the model predicts that a step reduces the sum of squares by at most this fraction, and the step
    /// does not reduce the offset.
    pub reduction: f64,
    /// The relative error of the derivatives, per norm of a column: the residuals count as independent of directions
    /// whose singular values are smaller.
    pub derivatives: f64,
    /// The initial radius, as a fraction of |D x|.
    pub first_radius: f64,
    /// The most steps tried.
    pub most_steps: usize,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            offset: 1e-6,
            step: 1e-11,
            reduction: 1e-13,
            derivatives: 1e-13,
            first_radius: 1.0,
            most_steps: 500,
        }
    }
}

/// Why a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// No step can reduce the residuals significantly: [`Options::offset`].
    Offset,
    /// Steps no longer change x: [`Options::step`].
    Step,
    /// Steps no longer change the sum of squares: [`Options::reduction`].
    Reduction,
    /// The residuals are 0 within round-off.
    Zero,
    /// All numbers are at bounds.
    Bounds,
    /// The limit on steps was reached: this is not a minimum.
    TooManySteps,
}

impl Ending {
    /// Whether a minimum was found.
    pub fn is_minimum(self) -> bool {
        self != Ending::TooManySteps
    }

    /// The reason as the end of a sentence whose subject is the search.
    pub fn words(self) -> &'static str {
        match self {
            Ending::Offset => "ended where no step reduces the residuals",
            Ending::Step => "ended where steps no longer change the fitted values",
            Ending::Reduction => "ended where steps no longer change the sum of squares",
            Ending::Zero => "ended where the residuals are zero to within rounding",
            Ending::Bounds => "ended where all fitted values are at bounds",
            Ending::TooManySteps => "did not converge",
        }
    }
}

/// The result of a search.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// The numbers at the minimum.
    pub x: Vec<f64>,
    /// The residuals there.
    pub residuals: Vec<f64>,
    /// Their derivatives there.
    pub jacobian: DMatrix<f64>,
    /// Why the search ended.
    pub ending: Ending,
    /// The number of accepted steps.
    pub steps: usize,
    /// The number of evaluations of the residuals.
    pub evaluations: usize,
    /// The number of evaluations of the derivatives.
    pub derivatives: usize,
    /// The sum of squares at the start and after each step.
    pub sums: Vec<f64>,
}

/// A step is accepted if it reduces the sum by this fraction of what the linear model predicts.
const KEPT: f64 = 1e-4;

/// A step that does not reduce the sum is accepted if it reduces the offset by this factor.
const CLOSER: f64 = 0.9;

/// A sum of squares counts as zero where the residuals are this small relative to the terms of which they are differences.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Searches for a minimum from a start, which is first moved to within the bounds.
///
/// ```
/// use lagrangian_fit::least_squares::{Options, Problem, Trouble, minimize};
/// use nalgebra::DMatrix;
///
/// /// Rosenbrock's valley.
/// struct Valley;
/// impl Problem for Valley {
///     fn residuals(&mut self, x: &[f64]) -> Result<Vec<f64>, Trouble> {
///         Ok(vec![10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]])
///     }
///     fn jacobian(&mut self, x: &[f64]) -> Result<DMatrix<f64>, Trouble> {
///         Ok(DMatrix::from_row_slice(2, 2, &[-20.0 * x[0], 10.0, -1.0, 0.0]))
///     }
/// }
/// let free = [[f64::NEG_INFINITY, f64::INFINITY]; 2];
/// let found = minimize(&mut Valley, &[-1.2, 1.0], &free, &Options::default())?;
/// assert!((found.x[0] - 1.0).abs() < 1e-12 && (found.x[1] - 1.0).abs() < 1e-12);
/// # Ok::<(), lagrangian_fit::least_squares::Trouble>(())
/// ```
///
/// # Errors
/// If the residuals are undefined at the start, or the derivatives at a point on the way.
pub fn minimize(
    problem: &mut dyn Problem,
    start: &[f64],
    bounds: &[[f64; 2]],
    options: &Options,
) -> Result<Minimum, Trouble> {
    let mut at = begin(problem, start, bounds)?;
    let mut scale = vec![0.0; at.x.len()];
    grow(&mut scale, &at.jacobian);
    let mut radius = options.first_radius * length(&scale, &at.x);
    if radius == 0.0 {
        radius = options.first_radius;
    }
    let mut is_first = true;
    while at.evaluations <= options.most_steps {
        let free = free(&at, bounds);
        let offset = offset(&at, &free, &scale, options.derivatives);
        if let Some(ending) = ended(problem, &at, &free, offset, options) {
            at.ending = ending;
            return Ok(at);
        }
        // If the full Gauss–Newton step promises next to nothing, round-off and errors of the residuals decide whether the
        // sum falls. That step is then tried, and accepted if the derivatives show that it is nearer to the minimum.
        let half = 0.5 * squares(&at.residuals);
        let full_step = step(
            &at,
            &free,
            bounds,
            &scale,
            f64::INFINITY,
            options.derivatives,
        );
        let is_level = promise(&at, &full_step) <= options.reduction * half;
        let step = if is_level {
            full_step
        } else {
            step(&at, &free, bounds, &scale, radius, options.derivatives)
        };
        let moved = at.x.iter().zip(step.iter()).zip(bounds);
        let moved = moved.map(|((x, step), [low, high])| (x + step).clamp(*low, *high));
        let trial: Vec<f64> = moved.collect();
        let taken = length(&scale, step.as_slice());
        if is_first {
            radius = radius.min(taken);
        }
        let residuals = tried(problem, &trial)?;
        at.evaluations += 1;
        let ratio = ratio(&at, &step, residuals.as_deref());
        let is_still = taken <= options.step * length(&scale, &trial) || taken == 0.0;
        if is_still || is_level {
            let next = match residuals {
                Some(residuals) => after_step(problem, &at, trial, residuals)?,
                None => at.clone(),
            };
            let free = self::free(&next, bounds);
            let better = self::offset(&next, &free, &scale, options.derivatives);
            if !is_nearer(better, offset) {
                at.ending = if is_still {
                    Ending::Step
                } else {
                    Ending::Reduction
                };
                return Ok(at);
            }
            at = next;
            continue;
        }
        radius = next_radius(radius, taken, ratio);
        if ratio > KEPT
            && let Some(residuals) = residuals
        {
            at = after_step(problem, &at, trial, residuals)?;
            grow(&mut scale, &at.jacobian);
            is_first = false;
        }
    }
    Ok(at)
}

/// The search at its start, moved to within the bounds.
fn begin(
    problem: &mut dyn Problem,
    start: &[f64],
    bounds: &[[f64; 2]],
) -> Result<Minimum, Trouble> {
    let x: Vec<f64> = start
        .iter()
        .zip(bounds)
        .map(|(x, [low, high])| x.max(*low).min(*high))
        .collect();
    let residuals = problem.residuals(&x)?;
    if let Some(why) = has_no_sum(&residuals) {
        return Err(Trouble::NoValue(why.into()));
    }
    let jacobian = problem.jacobian(&x)?;
    Ok(Minimum {
        sums: vec![squares(&residuals)],
        x,
        residuals,
        jacobian,
        ending: Ending::TooManySteps,
        steps: 0,
        evaluations: 1,
        derivatives: 1,
    })
}

/// The residuals of a trial, if the sum of their squares is a number.
fn tried(problem: &mut dyn Problem, trial: &[f64]) -> Result<Option<Vec<f64>>, Trouble> {
    match problem.residuals(trial) {
        Err(Trouble::NoValue(_)) => Ok(None),
        tried => Ok(Some(tried?).filter(|all| squares(all).is_finite())),
    }
}

/// Why the sum of the squares of these residuals is no measure of them, if it is none.
fn has_no_sum(residuals: &[f64]) -> Option<&'static str> {
    let sum = squares(residuals);
    if residuals.iter().any(|r| !r.is_finite()) {
        Some("a residual is not finite")
    } else if !sum.is_finite() {
        Some("the residuals are so large that their squares are beyond all numbers")
    } else if sum == 0.0 && residuals.iter().any(|r| *r != 0.0) {
        Some("the residuals are so small that their squares vanish")
    } else {
        None
    }
}

/// Whether an offset from the minimum is so much less than the one before that the step is accepted without a lower sum.
fn is_nearer(now: Option<f64>, before: Option<f64>) -> bool {
    matches!((now, before), (Some(now), Some(before)) if now <= CLOSER * before)
}

/// The reduction by a step relative to the one that the linear model predicts; `-∞` where it predicts none, or there are no residuals.
fn ratio(at: &Minimum, step: &DVector<f64>, residuals: Option<&[f64]>) -> f64 {
    let promised = promise(at, step);
    match residuals {
        Some(new) if promised > 0.0 => reduction(&at.residuals, new) / promised,
        _ => f64::NEG_INFINITY,
    }
}

/// By how much half the sum of squares falls, as a sum of factored differences, which avoids cancellation between the sums.
fn reduction(old: &[f64], new: &[f64]) -> f64 {
    let pairs = old.iter().zip(new);
    0.5 * pairs
        .map(|(old, new)| (old - new) * (old + new))
        .sum::<f64>()
}

/// The radius of the trust region after a step of the length `taken`, whose reduction was `ratio` of what the linear model predicts.
fn next_radius(radius: f64, taken: f64, ratio: f64) -> f64 {
    if ratio < 0.25 {
        if ratio > 0.0 {
            0.5 * taken
        } else {
            0.2 * taken.min(radius)
        }
    } else if ratio > 0.75 {
        radius.max(2.0 * taken)
    } else {
        radius
    }
}

/// The search after an accepted step.
fn after_step(
    problem: &mut dyn Problem,
    at: &Minimum,
    x: Vec<f64>,
    residuals: Vec<f64>,
) -> Result<Minimum, Trouble> {
    let mut sums = at.sums.clone();
    sums.push(squares(&residuals));
    Ok(Minimum {
        jacobian: problem.jacobian(&x)?,
        x,
        residuals,
        ending: at.ending,
        steps: at.steps + 1,
        evaluations: at.evaluations,
        derivatives: at.derivatives + 1,
        sums,
    })
}

/// Which numbers are at a bound such that the sum of squares falls only outward.
pub fn active_bounds(at: &Minimum, bounds: &[[f64; 2]]) -> Vec<bool> {
    let gradient = at
        .jacobian
        .tr_mul(&DVector::from_column_slice(&at.residuals));
    (0..at.x.len())
        .map(|j| {
            let [low, high] = bounds[j];
            let (x, slope) = (at.x[j], gradient[j]);
            low == high || (x <= low && slope > 0.0) || (x >= high && slope < 0.0)
        })
        .collect()
}

fn free(at: &Minimum, bounds: &[[f64; 2]]) -> Vec<usize> {
    let held = active_bounds(at, bounds).into_iter().enumerate();
    held.filter(|(_, held)| !held).map(|(j, _)| j).collect()
}

/// Whether x is a minimum as far as the residuals can tell.
fn ended(
    problem: &dyn Problem,
    at: &Minimum,
    free: &[usize],
    offset: Option<f64>,
    options: &Options,
) -> Option<Ending> {
    if norm(&at.residuals) <= ROUNDING * problem.size(&at.residuals) {
        return Some(Ending::Zero);
    }
    if free.is_empty() {
        return Some(Ending::Bounds);
    }
    let is_level = offset.is_some_and(|offset| offset <= options.offset);
    is_level.then_some(Ending::Offset)
}

/// The part of the residuals that a step of the free numbers could remove, relative to the rest, each per degree of freedom:
/// [`Options::offset`]. `None` where a step could remove all of it.
fn offset(at: &Minimum, free: &[usize], scale: &[f64], exact: f64) -> Option<f64> {
    // All numbers are held at bounds.
    if free.is_empty() {
        return Some(0.0);
    }
    let parts = Parts::of(at, free, scale, &at.residuals, exact);
    let along: f64 = parts.along.iter().map(|b| b * b).sum();
    let rest = at.residuals.len().checked_sub(parts.kept)?;
    match (parts.kept, rest) {
        // No free number affects the residuals.
        (0, _) => Some(0.0),
        (_, 0) => None,
        (kept, rest) => {
            let across = (squares(&at.residuals) - along).max(0.0);
            Some((along / kept as f64 / (across / rest as f64)).sqrt())
        }
    }
}

/// The residuals projected onto the singular vectors of some columns of `J D⁻¹`.
struct Parts {
    /// Singular values, and the residuals along the left vectors.
    values: Vec<f64>,
    along: Vec<f64>,
    /// The right singular vectors, a row for each.
    right: DMatrix<f64>,
    /// How many singular values are kept.
    kept: usize,
}

impl Parts {
    fn of(at: &Minimum, columns: &[usize], scale: &[f64], residuals: &[f64], exact: f64) -> Parts {
        let matrix = DMatrix::from_fn(at.residuals.len(), columns.len(), |i, j| {
            at.jacobian[(i, columns[j])] / unit(scale[columns[j]])
        });
        let mut right = DVector::from_column_slice(residuals);
        // The triangular factor has the same singular values and is smaller.
        let (triangle, part) = if matrix.nrows() > matrix.ncols() {
            let qr = matrix.qr();
            qr.q_tr_mul(&mut right);
            let triangle = qr.r();
            let part = right.rows(0, triangle.nrows()).into_owned();
            (triangle, part)
        } else {
            (matrix, right)
        };
        let svd = triangle.svd(true, true);
        let (Some(u), Some(v)) = (svd.u, svd.v_t) else {
            return Parts {
                values: Vec::new(),
                along: Vec::new(),
                right: DMatrix::zeros(0, columns.len()),
                kept: 0,
            };
        };
        let along = u.tr_mul(&part);
        let largest = svd.singular_values.max();
        let kept: Vec<usize> = (0..svd.singular_values.len())
            .filter(|i| svd.singular_values[*i] > exact * largest)
            .collect();
        Parts {
            values: kept.iter().map(|i| svd.singular_values[*i]).collect(),
            along: kept.iter().map(|i| along[*i]).collect(),
            right: v.select_rows(&kept),
            kept: kept.len(),
        }
    }

    /// The minimizer of the linear problem with `|δ| ≤ radius`, in scaled numbers.
    fn step(&self, radius: f64) -> DVector<f64> {
        let of = |damping: f64| -> Vec<f64> {
            let pairs = self.values.iter().zip(&self.along);
            pairs.map(|(s, b)| -s * b / (s * s + damping)).collect()
        };
        let mut step = of(0.0);
        if norm(&step) > radius {
            let slope: Vec<f64> = self
                .values
                .iter()
                .zip(&self.along)
                .map(|(s, b)| s * b)
                .collect();
            // |δ(λ)| decreases with λ, and is below |J' r| / λ.
            let (mut low, mut high) = (0.0, norm(&slope) / radius);
            let mut damping = 1e-3 * high;
            for _ in 0..60 {
                step = of(damping);
                let long = norm(&step);
                if (long - radius).abs() <= 0.1 * radius {
                    break;
                }
                if long > radius {
                    low = damping
                } else {
                    high = damping
                }
                // Newton's method on 1/|δ|, which is nearly linear in λ.
                let pairs = self.values.iter().zip(&step);
                let bend: f64 = pairs.map(|(s, d)| d * d / (s * s + damping)).sum::<f64>() / long;
                let next = damping + (long - radius) / radius * long / bend;
                damping = if next > low && next < high {
                    next
                } else {
                    (low * high).sqrt().max(0.5 * (low + high) * 1e-3)
                };
            }
        }
        self.right.tr_mul(&DVector::from_vec(step))
    }
}

/// The step that respects the radius and the bounds.
fn step(
    at: &Minimum,
    free: &[usize],
    bounds: &[[f64; 2]],
    scale: &[f64],
    radius: f64,
    exact: f64,
) -> DVector<f64> {
    let mut step = DVector::zeros(at.x.len());
    let mut open = free.to_vec();
    let mut residuals = at.residuals.clone();
    let mut left = radius;
    while !open.is_empty() && left > 0.0 {
        let part = Parts::of(at, &open, scale, &residuals, exact).step(left);
        for (j, part) in open.iter().zip(part.iter()) {
            step[*j] = part / unit(scale[*j]);
        }
        let is_beyond = |j: &usize| {
            let [low, high] = bounds[*j];
            let to = at.x[*j] + step[*j];
            to < low || to > high
        };
        let (beyond, within): (Vec<usize>, Vec<usize>) = open.iter().partition(|j| is_beyond(j));
        if beyond.is_empty() {
            break;
        }
        for j in beyond {
            let [low, high] = bounds[j];
            step[j] = (at.x[j] + step[j]).clamp(low, high) - at.x[j];
            for (r, column) in residuals.iter_mut().zip(at.jacobian.column(j).iter()) {
                *r += column * step[j];
            }
            let step_part = scale[j] * step[j];
            left = (left * left - step_part * step_part).max(0.0).sqrt();
        }
        for j in &within {
            step[*j] = 0.0;
        }
        open = within;
    }
    step
}

/// The reduction of half the sum of squares that the linear model predicts.
fn promise(at: &Minimum, step: &DVector<f64>) -> f64 {
    let change = &at.jacobian * step;
    let pairs = at.residuals.iter().zip(change.iter());
    pairs.map(|(r, c)| -c * (r + 0.5 * c)).sum()
}

/// Raises the scale to the greatest column norms so far.
fn grow(scale: &mut [f64], jacobian: &DMatrix<f64>) {
    for (scale, column) in scale.iter_mut().zip(jacobian.column_iter()) {
        let norm = column.norm();
        if norm.is_finite() {
            *scale = scale.max(norm);
        }
    }
}

/// A scale that is safe to divide by: a number on which nothing depends has scale 0.
fn unit(scale: f64) -> f64 {
    if scale > 0.0 { scale } else { 1.0 }
}

fn length(scale: &[f64], x: &[f64]) -> f64 {
    let parts = scale.iter().zip(x);
    parts.map(|(d, x)| (d * x) * (d * x)).sum::<f64>().sqrt()
}

fn squares(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum()
}

fn norm(values: &[f64]) -> f64 {
    squares(values).sqrt()
}
