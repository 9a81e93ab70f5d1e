//! Steps of the generalized-α method,
//!
//! ```text
//! q₁ = q₀ + h v₀ + h² ((½ − β) α₀ + β α₁),   v₁ = v₀ + h ((1 − γ) α₀ + γ α₁)
//! (1 − αₘ) α₁ + αₘ α₀ = (1 − α_f) a(q₁, v₁) + α_f a(q₀, v₀)
//! ```
//!
//! with the parameters of Chung and Hulbert for `ρ∞`: `αₘ = (2 ρ − 1)/(ρ + 1)`, `α_f = ρ/(ρ + 1)`, `γ = ½ − αₘ + α_f`,
//! `β = ¼ (1 − αₘ + α_f)²`. `α` is an auxiliary acceleration, which initially equals that of the machine. The unknown `a(q₁, v₁)` is
//! found by Newton's method with a finite-difference Jacobian.

use std::vec::Vec;

use super::{Fixed, Stepper, add, check_finite};
use crate::balance::Quadratures;
use crate::implicit::jacobian::Jacobian;
use crate::implicit::lu::Lu;
use crate::methods::MAX_STAGES;
use crate::stages::Point;
use crate::{InputLaw, StepError, System, Vector};

/// The number of iterations within which Newton's method converges; otherwise the step is too long.
const MOST_ITERATIONS: usize = 12;

/// Error left by Newton's method, relative to the tolerance.
const NEWTON_TOLERANCE: f64 = 0.01;

/// Round-off left by Newton's method, in units of the last place.
const ROUNDOFF: f64 = 8.0;

/// An iteration that leaves more than this fraction of the change stagnates.
const STAGNATION: f64 = 0.5;

/// The number of halvings after which a distance is of the size of round-off.
const HALVINGS: usize = 50;

/// The acceleration jumps if its change over this small distance is more than this fraction of its change over the whole step.
const JUMP: f64 = 1e-3;

/// State that the method keeps from step to step.
#[derive(Clone, Debug)]
pub(crate) struct GeneralizedAlpha {
    weights: Weights,
    jacobian: Jacobian,
    matrix: Lu<1>,
    /// The step length of the matrix; 0 if there is none.
    factored_step: f64,
    /// Whether iterations with this matrix have converged, and not only begun with a small change.
    contracts: bool,
    /// `α` at the end of the last step and at its beginning; empty if it equals the acceleration of the machine.
    alpha: [Vec<f64>; 2],
    change: Vec<f64>,
}

/// The parameters of the method.
#[derive(Clone, Copy, Debug)]
struct Weights {
    inertia: f64,
    force: f64,
    beta: f64,
    gamma: f64,
}

impl GeneralizedAlpha {
    pub fn new<S: System>(system: &S, rho: f64) -> Self {
        let n = system.coordinates().len();
        let (inertia, force) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let ahead = 1.0 - inertia + force;
        Self {
            weights: Weights {
                inertia,
                force,
                beta: 0.25 * ahead * ahead,
                gamma: ahead - 0.5,
            },
            jacobian: Jacobian::new(system),
            matrix: Lu::new(n),
            factored_step: 0.0,
            contracts: false,
            alpha: [Vec::new(), Vec::new()],
            change: std::vec![0.0; n],
        }
    }

    pub fn retreat(&mut self) {
        let [now, before] = &mut self.alpha;
        now.clone_from(before);
    }

    pub fn forget(&mut self) {
        self.factored_step = 0.0;
        self.alpha[0].clear();
    }

    /// `α` at the end of a step in which the acceleration of the machine changes from `from` to `to`.
    fn ahead(&self, i: usize, from: f64, to: f64) -> f64 {
        let Weights { inertia, force, .. } = self.weights;
        let sum = (1.0 - force) * to + force * from - inertia * self.alpha[1][i];
        sum / (1.0 - inertia)
    }

    /// The factors by which an acceleration at the end changes the position and the rate there.
    fn factors(&self, h: f64) -> [f64; 2] {
        let Weights {
            inertia,
            force,
            beta,
            gamma,
        } = self.weights;
        let share = (1.0 - force) / (1.0 - inertia);
        [h * h * beta * share, h * gamma * share]
    }

    /// Factorizes the matrix `I − h γ' ∂a/∂v − h² β' ∂a/∂q`. Returns whether it is invertible.
    fn factor(&mut self, h: f64) -> bool {
        let n = self.change.len();
        let [by_position, by_rate] = self.factors(h);
        let jacobian = &self.jacobian;
        let factored = self.matrix.factor(|j, [column]| {
            let of_coordinate = &jacobian.by_coordinates[j * n..][..n];
            let of_rate = &jacobian.by_rates[j * n..][..n];
            for (entry, (by_q, by_v)) in column.iter_mut().zip(of_coordinate.iter().zip(of_rate)) {
                *entry = -by_rate * by_v - by_position * by_q;
            }
            column[j] += 1.0;
        });
        self.factored_step = if factored { h } else { 0.0 };
        self.contracts = false;
        factored
    }
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Takes a step of length `h` from `before` to `now`.
    pub(super) fn attempt_by_alpha(&mut self, h: f64, last: bool) -> Result<(), StepError> {
        let begins = match self.fixed.as_deref() {
            Some(Fixed::GeneralizedAlpha(alpha)) => alpha.alpha[0].is_empty(),
            _ => false,
        };
        let ahead = if begins {
            self.look_beyond_jump(h)
        } else {
            0.0
        };
        let Some(Fixed::GeneralizedAlpha(alpha)) = self.fixed.as_deref_mut() else {
            return Ok(());
        };
        let [now, before] = &mut alpha.alpha;
        if now.is_empty() {
            now.extend_from_slice(self.k[0].as_slice());
        }
        before.clone_from(now);
        // An old Jacobian is used as long as Newton's method converges with it.
        let is_fresh = alpha.factored_step != h;
        let solved = (!is_fresh && self.newton_of_alpha(h)?)
            || (self.renew_jacobian_of_alpha(h, ahead)? && self.newton_of_alpha(h)?);
        if !solved {
            let (t, step) = (self.before.t, h);
            return Err(if self.jumps_at_end(h) {
                StepError::Jump { t, step }
            } else {
                StepError::NotSolved { t, step }
            });
        }

        let Self {
            method,
            model,
            quadratures,
            before,
            now,
            k,
            end,
            fixed,
            ..
        } = self;
        let Some(Fixed::GeneralizedAlpha(alpha)) = fixed.as_deref_mut() else {
            return Ok(());
        };
        let stages = method.tableau.stages;
        for i in 0..alpha.change.len() {
            let ahead = alpha.ahead(i, k[0].as_slice()[i], k[stages].as_slice()[i]);
            let [by_q, by_v] = alpha.increments(i, h, before.v.as_slice()[i], ahead);
            let low = before.v_low.as_slice()[i];
            add(&mut now.q, &mut now.q_low, i, by_q + h * low);
            add(&mut now.v, &mut now.v_low, i, by_v);
            alpha.alpha[0][i] = ahead;
        }
        now.set_time(before, h, (*end, &[last]));
        check_finite(now)?;
        model.set_inputs(now.t, &now.q, &now.v);
        model.project(now)?;
        // The acceleration is the solution of the iteration, since an evaluation would amplify the round-off of the state by the
        // stiffness of the machine.
        model.take_rates(quadratures, stages, (now.t, &now.q, &now.v, &k[stages]));
        self.take_rates_in_middle(h)
    }

    /// Finds the Jacobian this far ahead of the beginning of a step, and factorizes the matrix of Newton's method. Returns whether it is invertible.
    fn renew_jacobian_of_alpha(&mut self, h: f64, ahead: f64) -> Result<bool, StepError> {
        let Self {
            model,
            before,
            k,
            stage: (q, v),
            control,
            fixed,
            ..
        } = self;
        let Some(Fixed::GeneralizedAlpha(alpha)) = fixed.as_deref_mut() else {
            return Ok(false);
        };
        let [start, .., here, there] = k;
        before.state_ahead(ahead, start, [&mut *q, &mut *v]);
        let mut accelerations = |t: f64, q: &S::Vector, v: &S::Vector, a: &mut S::Vector| {
            model.accelerations(t, q, v, a, &mut control.work)
        };
        let scratch = [&mut *q, &mut *v, here, there];
        let at = (before.t + ahead, h);
        alpha.jacobian.find(at, scratch, &mut accelerations)?;
        Ok(alpha.factor(h))
    }

    /// Solves for the acceleration at the end of a step, in `k` after the stages. Returns whether it was found.
    fn newton_of_alpha(&mut self, h: f64) -> Result<bool, StepError> {
        let Self {
            method,
            model,
            tolerance,
            before,
            k,
            stage: (q, v),
            control,
            fixed,
            ..
        } = self;
        let Some(Fixed::GeneralizedAlpha(alpha)) = fixed.as_deref_mut() else {
            return Ok(false);
        };
        let stages = method.tableau.stages;
        let [by_position, by_rate] = alpha.factors(h);
        let t = before.t + (before.t_low + h);
        let (first, rest) = k.split_at_mut(1);
        let (from, rest) = (&first[0], &mut rest[stages - 1..]);
        let (to, rest) = rest.split_at_mut(1);
        let (to, scratch) = (&mut to[0], &mut rest[MAX_STAGES - 2 - stages]);
        to.clone_from(from);
        let mut size_before = f64::INFINITY;
        for round in 1..=MOST_ITERATIONS {
            alpha.end((before, h), [from, &*to], [&mut *q, &mut *v]);
            model.accelerations(t, q, v, scratch, &mut control.work)?;
            let pairs = scratch.as_slice().iter().zip(to.as_slice());
            for (change, (a, to)) in alpha.change.iter_mut().zip(pairs) {
                *change = a - to;
            }
            // A small change alone does not show that the acceleration is found: where a force jumps, its difference quotient is as large
            // as that of a very stiff part, and any residual causes hardly a change.
            let is_small = |(i, residual): (usize, &f64)| {
                let relative = tolerance.relative * before.v.as_slice()[i].abs();
                let tolerable = NEWTON_TOLERANCE * (tolerance.absolute.as_slice()[i] + relative);
                let roundoff = 4.0 * f64::EPSILON * alpha.jacobian.noise[i];
                residual.abs() <= (tolerable / h.abs()).max(roundoff)
            };
            let are_small = alpha.change.iter().enumerate().all(is_small);
            alpha.matrix.solve([&mut alpha.change]);
            let mut size = 0.0_f64;
            for (i, change) in alpha.change.iter().enumerate() {
                to.as_mut_slice()[i] += change;
                let absolute = tolerance.absolute.as_slice()[i];
                let moves = [
                    (by_position * change, q.as_slice()[i]),
                    (by_rate * change, v.as_slice()[i]),
                ];
                for (by, y) in moves {
                    let tolerable = NEWTON_TOLERANCE * (absolute + tolerance.relative * y.abs());
                    let least = tolerable.max(ROUNDOFF * f64::EPSILON * y.abs());
                    let ratio = by.abs() / least;
                    // NaN must not count as zero.
                    size = if ratio > size || ratio.is_nan() {
                        ratio
                    } else {
                        size
                    };
                }
            }
            if !size.is_finite() {
                return Ok(false);
            }
            alpha.contracts |= round > 1 && size <= STAGNATION * size_before;
            let is_confirmed = are_small || alpha.contracts;
            let stagnates = round > 2 && size > STAGNATION * size_before;
            if is_confirmed && (size <= 1.0 || (stagnates && NEWTON_TOLERANCE * size <= 1.0)) {
                return Ok(true);
            }
            if stagnates {
                return Ok(false);
            }
            size_before = size;
        }
        Ok(false)
    }

    /// Whether the acceleration jumps between the end of a step that could not be solved and the end with the acceleration there. Then no
    /// acceleration may satisfy the equations, however short the step is: on each side of the jump they lead to the other one.
    fn jumps_at_end(&mut self, h: f64) -> bool {
        let Self {
            method,
            model,
            before,
            k,
            stage: (q, v),
            control,
            fixed,
            ..
        } = self;
        let Some(Fixed::GeneralizedAlpha(alpha)) = fixed.as_deref_mut() else {
            return false;
        };
        let t = before.t + (before.t_low + h);
        let (from, to) = (&k[0], k[method.tableau.stages].clone());
        let mut at = |to: &S::Vector| {
            let mut a = to.zeros_like();
            alpha.end((before, h), [from, to], [&mut *q, &mut *v]);
            let result = model.accelerations(t, q, v, &mut a, &mut control.work);
            result.ok().map(|()| a)
        };
        let change = |one: &S::Vector, other: &S::Vector| {
            let pairs = one.as_slice().iter().zip(other.as_slice());
            pairs.fold(0.0_f64, |most, (one, other)| most.max((other - one).abs()))
        };
        let mut find = || {
            let here = at(&to)?;
            let there = at(&here)?;
            let total = change(&here, &there);
            let mut ends = [(to.clone(), here.clone()), (here.clone(), there)];
            for _ in 0..HALVINGS {
                let mut middle = ends[0].0.clone();
                let pairs = middle.as_mut_slice().iter_mut().zip(ends[1].0.as_slice());
                pairs.for_each(|(x, other)| *x = 0.5 * (*x + other));
                let a = at(&middle)?;
                let is_first = change(&ends[0].1, &a) > change(&a, &ends[1].1);
                ends[usize::from(is_first)] = (middle, a);
            }
            let [(_, before), (_, after)] = &ends;
            Some(total > 0.0 && change(before, after) > JUMP * total)
        };
        find().unwrap_or(false)
    }
}

impl GeneralizedAlpha {
    /// The state at the end of a step in which the acceleration of the machine changes from `from` to `to`.
    fn end<V: Vector>(
        &self,
        (before, h): (&Point<V>, f64),
        [from, to]: [&V; 2],
        [q, v]: [&mut V; 2],
    ) {
        let pairs = from.as_slice().iter().zip(to.as_slice());
        for (i, (from, to)) in pairs.enumerate() {
            let ahead = self.ahead(i, *from, *to);
            let [by_q, by_v] = self.increments(i, h, before.v.as_slice()[i], ahead);
            q.as_mut_slice()[i] = before.q.as_slice()[i] + (before.q_low.as_slice()[i] + by_q);
            v.as_mut_slice()[i] = before.v.as_slice()[i] + (before.v_low.as_slice()[i] + by_v);
        }
    }

    /// The changes of a position and its rate in a step that ends with `ahead`.
    fn increments(&self, i: usize, h: f64, rate: f64, ahead: f64) -> [f64; 2] {
        let Weights { beta, gamma, .. } = self.weights;
        let behind = self.alpha[1][i];
        [
            h * (rate + h * ((0.5 - beta) * behind + beta * ahead)),
            h * ((1.0 - gamma) * behind + gamma * ahead),
        ]
    }
}
