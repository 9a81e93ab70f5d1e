//! Nonlinear least squares within bounds, by the method of Levenberg and Marquardt with a trust region.
//!
//! Sought are numbers x within bounds for which `½ |r(x)|²` is least. A step δ makes the linear model `|r + J δ|` least among
//! those with `|D δ| ≤ Δ`; the radius Δ follows how well the model told what the step would do, and D, the greatest norms that the
//! columns of J have had, makes all of it independent of units (J. J. Moré, *The Levenberg–Marquardt algorithm: implementation
//! and theory*, Lecture Notes in Mathematics 630 (1978) 105–116). The linear problem is solved by singular values, in which
//! directions that the residuals do not depend on are seen and left alone.
//!
//! Numbers at a bound from which the sum of squares falls only outward stay there. What a step would carry over its bound
//! is put on it, and the step of the others is found anew with it there; short enough, such a step lessens the sum wherever x
//! can move (C. Kanzow, N. Yamashita, M. Fukushima, *Levenberg–Marquardt methods with strong local convergence properties for
//! solving nonlinear equations with convex constraints*, J. Comput. Appl. Math. 172 (2004) 375–397).

use nalgebra::{DMatrix, DVector};

/// Why there are no residuals.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// There are none at these numbers; a shorter step may have some. Why, as a sentence.
    NoValue(String),
    /// Somebody asked to stop.
    Stopped,
}

/// Residuals and how they change.
pub trait Problem {
    /// The residuals at x, in an order that is always the same.
    ///
    /// # Errors
    /// If there are none there.
    fn residuals(&mut self, x: &[f64]) -> Result<Vec<f64>, Trouble>;

    /// Their derivatives at x, a column for each number of x.
    ///
    /// # Errors
    /// If there are none there.
    fn jacobian(&mut self, x: &[f64]) -> Result<DMatrix<f64>, Trouble>;

    /// The residuals with what they are differences of, by which their rounding is measured; by default they themselves.
    fn size(&self, residuals: &[f64]) -> f64 {
        norm(residuals)
    }
}

/// When a search ends.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Where the part of the residuals that a step could still take away is this share of the rest, each by degree of
    /// freedom: how far x is from the minimum, in standard errors of it (D. M. Bates, D. G. Watts, *A relative offset
    /// orthogonality convergence criterion for nonlinear least squares*, Technometrics 23 (1981) 179–183).
    pub offset: f64,
    /// Where a step is this share of x, in the norm of D.
    pub step: f64,
    /// Where a step promises to lessen the sum of squares by no more than this share of it, and does not lessen the offset.
    pub reduction: f64,
    /// How exact the derivatives are, as a share of each column's norm: directions whose singular values are below this
    /// are ones that the residuals do not depend on.
    pub derivatives: f64,
    /// The first radius, as a share of |D x|.
    pub first_radius: f64,
    /// The most steps that are tried.
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

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// Nothing of the residuals can be taken away any more: [`Options::offset`].
    Offset,
    /// Steps no longer change x: [`Options::step`].
    Step,
    /// Steps no longer change the sum: [`Options::reduction`].
    Reduction,
    /// The residuals are 0 to rounding.
    Zero,
    /// No number is free: all are at bounds.
    Bounds,
    /// More steps than allowed: this is no minimum.
    TooManySteps,
}

impl Ending {
    /// Whether a minimum was found.
    pub fn is_minimum(self) -> bool {
        self != Ending::TooManySteps
    }

    /// As the end of a sentence that begins with the search.
    pub fn words(self) -> &'static str {
        match self {
            Ending::Offset => "ended where no step takes anything away from the residuals",
            Ending::Step => "ended where steps no longer change what is fitted",
            Ending::Reduction => "ended where steps no longer change the sum of squares",
            Ending::Zero => "ended where the residuals are zero to rounding",
            Ending::Bounds => "ended where everything that is fitted is at a bound",
            Ending::TooManySteps => "did not converge",
        }
    }
}

/// The end of a search.
#[derive(Clone, Debug)]
pub struct Minimum {
    /// Where it is.
    pub x: Vec<f64>,
    /// The residuals there.
    pub residuals: Vec<f64>,
    /// Their derivatives there.
    pub jacobian: DMatrix<f64>,
    /// Why the search ended.
    pub ending: Ending,
    /// Steps that were kept.
    pub steps: usize,
    /// How often residuals were evaluated.
    pub evaluations: usize,
    /// How often derivatives were.
    pub derivatives: usize,
    /// The sum of squares at the start and after each step.
    pub sums: Vec<f64>,
}

/// A step is kept if it lessens the sum by this share of what the linear model promises.
const KEPT: f64 = 1e-4;

/// A step that lessens nothing is kept if it lessens the offset by this factor.
const CLOSER: f64 = 0.9;

/// A sum of squares is zero where residuals are so small beside what they are differences of.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// Looks for a minimum from a start, which is put within the bounds first.
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
/// If there are no residuals at the start, or no derivatives at a point that was reached.
pub fn minimize(
    problem: &mut dyn Problem,
    start: &[f64],
    bounds: &[[f64; 2]],
    options: &Options,
) -> Result<Minimum, Trouble> {
    let x: Vec<f64> = start
        .iter()
        .zip(bounds)
        .map(|(x, [low, high])| x.max(*low).min(*high))
        .collect();
    let residuals = problem.residuals(&x)?;
    if residuals.iter().any(|r| !r.is_finite()) {
        return Err(Trouble::NoValue("a residual is not finite".into()));
    }
    let jacobian = problem.jacobian(&x)?;
    let mut at = Minimum {
        sums: vec![squares(&residuals)],
        x,
        residuals,
        jacobian,
        ending: Ending::TooManySteps,
        steps: 0,
        evaluations: 1,
        derivatives: 1,
    };
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
        // So little is left that rounding, and errors of the residuals, decide whether the sum falls: a step is of Gauss and
        // Newton then, and counts if it comes nearer by what derivatives say.
        let half = 0.5 * squares(&at.residuals);
        let whole = step(
            &at,
            &free,
            bounds,
            &scale,
            f64::INFINITY,
            options.derivatives,
        );
        let is_level = promise(&at, &whole) <= options.reduction * half;
        let step = if is_level {
            whole
        } else {
            step(&at, &free, bounds, &scale, radius, options.derivatives)
        };
        let trial: Vec<f64> = (0..at.x.len())
            .map(|j| (at.x[j] + step[j]).clamp(bounds[j][0], bounds[j][1]))
            .collect();
        let taken = length(&scale, step.as_slice());
        if is_first {
            radius = radius.min(taken);
        }
        let residuals = match problem.residuals(&trial) {
            Err(Trouble::NoValue(_)) => None,
            tried => Some(tried?).filter(|all| all.iter().all(|r| r.is_finite())),
        };
        at.evaluations += 1;
        let promised = promise(&at, &step);
        let reduced = residuals.as_ref().map(|new| {
            // The difference of squares, without the cancellation of the sums.
            let pairs = at.residuals.iter().zip(new);
            0.5 * pairs
                .map(|(old, new)| (old - new) * (old + new))
                .sum::<f64>()
        });
        let ratio = match reduced {
            Some(reduced) if promised > 0.0 => reduced / promised,
            _ => f64::NEG_INFINITY,
        };
        let is_still = taken <= options.step * length(&scale, &trial) || taken == 0.0;
        if is_still || is_level {
            let ending = if is_still {
                Ending::Step
            } else {
                Ending::Reduction
            };
            let next = match residuals {
                Some(residuals) => moved(problem, &at, trial, residuals)?,
                None => at.clone(),
            };
            let free = self::free(&next, bounds);
            let better = self::offset(&next, &free, &scale, options.derivatives);
            let is_nearer = match (better, offset) {
                (Some(better), Some(offset)) => better <= CLOSER * offset,
                _ => false,
            };
            if !is_nearer {
                at.ending = ending;
                return Ok(at);
            }
            at = next;
            continue;
        }
        if ratio < 0.25 {
            radius = if ratio > 0.0 {
                0.5 * taken
            } else {
                0.2 * taken.min(radius)
            };
        } else if ratio > 0.75 {
            radius = radius.max(2.0 * taken);
        }
        if ratio > KEPT
            && let Some(residuals) = residuals
        {
            at = moved(problem, &at, trial, residuals)?;
            grow(&mut scale, &at.jacobian);
            is_first = false;
        }
    }
    Ok(at)
}

/// The search after a step that is kept.
fn moved(
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

/// Which numbers are at a bound from which the sum of squares falls outward only.
pub fn held(at: &Minimum, bounds: &[[f64; 2]]) -> Vec<bool> {
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
    let held = held(at, bounds).into_iter().enumerate();
    held.filter(|(_, held)| !held).map(|(j, _)| j).collect()
}

/// Whether x is a minimum as far as the residuals tell.
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

/// What a step of the free numbers could take away of the residuals, relative to the rest of them, each by degree of freedom:
/// [`Options::offset`]. None where all of them could be taken away.
fn offset(at: &Minimum, free: &[usize], scale: &[f64], exact: f64) -> Option<f64> {
    // All numbers are at their bounds.
    if free.is_empty() {
        return Some(0.0);
    }
    let parts = Parts::of(at, free, scale, &at.residuals, exact);
    let along: f64 = parts.along.iter().map(|b| b * b).sum();
    let rest = at.residuals.len().checked_sub(parts.kept)?;
    match (parts.kept, rest) {
        // Nothing moves the residuals.
        (0, _) => Some(0.0),
        (_, 0) => None,
        (kept, rest) => {
            let across = (squares(&at.residuals) - along).max(0.0);
            Some((along / kept as f64 / (across / rest as f64)).sqrt())
        }
    }
}

/// The residuals in the directions of the singular vectors of `J D⁻¹`, some columns of it.
struct Parts {
    /// Singular values, and the residuals along their vectors.
    values: Vec<f64>,
    along: Vec<f64>,
    /// The vectors on the right, a row for each.
    right: DMatrix<f64>,
    /// How many there are.
    kept: usize,
}

impl Parts {
    fn of(at: &Minimum, columns: &[usize], scale: &[f64], residuals: &[f64], exact: f64) -> Parts {
        let matrix = DMatrix::from_fn(at.residuals.len(), columns.len(), |i, j| {
            at.jacobian[(i, columns[j])] / unit(scale[columns[j]])
        });
        let mut right = DVector::from_column_slice(residuals);
        // The small triangle has the same singular values, and as many rows as there are columns.
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

    /// The step of the linear problem with `|δ| ≤ radius`, in units of the scale.
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
            // |δ(λ)| falls with λ, and is below |J' r| / λ.
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
                // Newton's method on 1/|δ|, which is nearly linear.
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

/// The step within the radius and the bounds.
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
            let gone = scale[j] * step[j];
            left = (left * left - gone * gone).max(0.0).sqrt();
        }
        for j in &within {
            step[*j] = 0.0;
        }
        open = within;
    }
    step
}

/// By how much the linear model has half the sum of squares fall.
fn promise(at: &Minimum, step: &DVector<f64>) -> f64 {
    let change = &at.jacobian * step;
    let pairs = at.residuals.iter().zip(change.iter());
    pairs.map(|(r, c)| -c * (r + 0.5 * c)).sum()
}

/// Lets the scale be the greatest norms of columns so far.
fn grow(scale: &mut [f64], jacobian: &DMatrix<f64>) {
    for (scale, column) in scale.iter_mut().zip(jacobian.column_iter()) {
        let norm = column.norm();
        if norm.is_finite() {
            *scale = scale.max(norm);
        }
    }
}

/// A scale to divide by: a number on which nothing depends has none.
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
