//! Compares a step by series with steps of `dop853` at a state.

use crate::attempt;
use crate::math::{power, sqrt};
use crate::methods::Method;
use crate::stages::Point;
use crate::taylor::{self, Taylor};
use crate::tolerance::Tolerance;
use crate::{System, Vector};
use std::vec;

/// A run must be at least as long as so many steps by series for a comparison to pay off, which costs about two of them.
const LEAST_STEPS: f64 = 16.0;

/// What a comparison found.
pub(super) struct Comparison {
    /// The number of steps of `dop853` with the same error in the same time as one step by series.
    pub steps: f64,
    /// The evaluations that it took, of the accelerations and of their series.
    pub evaluations: usize,
}

/// Takes a step of `dop853` from a state and compares it with the series of 20 coefficients, whose error is negligible there. The error of the step by
/// series follows from the accelerations at its end. `left` is the signed time to the end of the run, and `assumed` a guess of the
/// number of steps. `None` if nothing can be measured.
///
/// The error of a step of `dop853` of length h is proportional to h⁹. If it is e, and that of a step by series of length H is E, then steps of the
/// length h ((E/H)/(e/h))^(1/8) err as much in the same time as one by series.
pub(super) fn compare<S: System>(
    system: &S,
    (t, q, v): (f64, &S::Vector, &S::Vector),
    tolerance: &Tolerance<S::Vector>,
    (finest_tolerance, left, assumed): (f64, f64, f64),
) -> Option<Comparison> {
    let inputs = system.default_inputs();
    let mut coefficients = vec![q.zeros_like(); taylor::rows(0.0)];
    let expanded = system.series([t, 0.0], q, v, &inputs, &mut coefficients);
    expanded.ok()?;
    let of_step = &coefficients[..taylor::rows(finest_tolerance)];
    let length = Taylor::of(of_step).length(tolerance);
    let is_worth_it = LEAST_STEPS * length < left.abs() && length > 0.0;
    if !is_worth_it {
        return None;
    }
    let length = length.copysign(left);
    let norm = |errors: &dyn Fn(usize) -> [f64; 2]| {
        let mut sum = 0.0;
        for (i, absolute) in tolerance.absolute.as_slice().iter().enumerate() {
            let sizes = [q.as_slice()[i], v.as_slice()[i]];
            for (error, size) in errors(i).into_iter().zip(sizes) {
                let error = error / (absolute + tolerance.relative * size.abs());
                sum += error * error;
            }
        }
        sqrt(sum / (2 * q.as_slice().len()) as f64)
    };

    // The first missing term of a rate, e = c H^p, has the derivative p e/H, by which the accelerations differ at the end.
    let (q_end, v_end) = taylor::state(of_step, length);
    let (mut of_series, mut there) = (q.zeros_like(), q.zeros_like());
    taylor::accelerations(of_step, length, &mut of_series);
    let found = system.accelerations(t + length, &q_end, &v_end, &inputs, &mut there);
    found.ok()?;
    let missing = length / (of_step.len() - 1) as f64;
    let error_of_series = norm(&|i| {
        [
            0.0,
            missing * (there.as_slice()[i] - of_series.as_slice()[i]),
        ]
    });

    // At coarse tolerances a step by series reaches most of the way to the radius of convergence, where 20 coefficients are not enough either.
    let is_coarse = finest_tolerance > taylor::FINE;
    let h = length / (assumed * if is_coarse { 2.0 } else { 1.0 });
    let method = Method::DOP853;
    let stages = method.tableau.stages;
    let start = Point::new(t, q.clone(), v.clone());
    let mut k = q.several_zeros_like();
    taylor::accelerations(&coefficients, 0.0, &mut k[0]);
    let (mut q_stage, mut v_stage) = (q.zeros_like(), q.zeros_like());
    for i in 1..stages {
        let to = [&mut q_stage, &mut v_stage];
        let t = attempt::go_to_stage::<f64, _, _>((method, i), (&start, h), &k, to);
        let found = system.accelerations(t, &q_stage, &v_stage, &inputs, &mut k[i]);
        found.ok()?;
    }
    let mut end = start.clone();
    attempt::arrive::<f64, _, _>(method, (&start, h), &k, &mut end, (0.0, &[false]));
    let (q_exact, v_exact) = taylor::state(&coefficients, h);
    let error = norm(&|i| {
        let pairs = [[&end.q, &q_exact], [&end.v, &v_exact]];
        pairs.map(|[one, other]| one.as_slice()[i] - other.as_slice()[i])
    });

    // Errors below round-off are not known.
    let rounding = norm(&|i| [q, v].map(|y| f64::EPSILON * y.as_slice()[i]));
    let rate = error.max(rounding) / h.abs();
    let rate_of_series = error_of_series.max(rounding) / length.abs();
    let steps = length / h * power(rate / rate_of_series, 1.0 / 8.0);
    (steps > 0.0 && steps.is_finite()).then_some(Comparison {
        steps,
        evaluations: stages + 1,
    })
}
