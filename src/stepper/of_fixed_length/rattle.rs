//! Steps of RATTLE: the Störmer–Verlet method in momenta, with constraints of positions,
//!
//! ```text
//! p½ = p₀ + h/2 (F(q₀, v₀*) + G(q₀)ᵀ λ),   v₀* = M(q₀)⁻¹ p½
//! q₁ = q₀ + h/2 (v₀* + v₁*),               v₁* = M(q₁)⁻¹ p½,   g(q₁) = 0
//! p₁ = p½ + h/2 (F(q₁, v₁*) + G(q₁)ᵀ μ),   G(q₁) M(q₁)⁻¹ p₁ + ∂g/∂t = 0
//! ```
//!
//! E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, 2nd ed., 2006, section VII.1.4, eq. (1.26). `F` is dp/dt
//! without the forces of constraints.

use super::canonical::{Canonical, ConvergenceTest, dot};
use super::reactions::Reactions;
use super::{Fixed, Stepper, add};
use crate::at::At;
use crate::balance::Quadratures;
use crate::stages::Point;
use crate::stepper::Model;
use crate::{InputLaw, Singular, StepError, System, Vector};

/// Memory for both ends of a step.
#[derive(Clone, Debug)]
pub(crate) struct Rattle<V, M> {
    /// The mass matrices and forces at the beginning and at the end.
    ends: [Canonical<V, M>; 2],
    /// `v₀*` and `v₁*`.
    rates: [V; 2],
    force: V,
    momenta: V,
    half_way: V,
    scratch: V,
    /// The constraints at both ends.
    reactions: Reactions,
}

impl<V: Vector, M: Vector> Rattle<V, M> {
    pub fn new<S: System<Vector = V, Matrix = M>>(
        system: &S,
        now: &Point<V>,
        redundant: bool,
    ) -> Result<Self, StepError> {
        let reactions = Reactions::new(system, now, (redundant, 2))?;
        let canonical = Canonical::new(system, (now.t, &now.q))?;
        let zeros = now.q.zeros_like();
        Ok(Self {
            ends: [canonical.clone(), canonical],
            rates: [zeros.clone(), zeros.clone()],
            force: zeros.clone(),
            momenta: zeros.clone(),
            half_way: zeros.clone(),
            scratch: zeros,
            reactions,
        })
    }
}

impl<V: Vector, M: Vector> Rattle<V, M> {
    /// Sets the momenta at the beginning of a step of length `h`, and factorizes the matrix from which the constraints at its end determine
    /// the multipliers. Returns whether this matrix is invertible.
    fn begin<S: System<Vector = V, Matrix = M>>(
        &mut self,
        system: &S,
        before: &Point<V>,
        h: f64,
    ) -> Result<bool, Singular> {
        let [start, _] = &mut self.ends;
        start.go_to(system, before.t, &before.q)?;
        self.momenta.as_mut_slice().fill(0.0);
        start.add_momenta(1.0, &before.v, &mut self.momenta);
        start.add_momenta(1.0, &before.v_low, &mut self.momenta);
        let reactions = &mut self.reactions;
        if reactions.is_empty() {
            return Ok(true);
        }
        system.constraint_matrix(before.t, &before.q, &mut reactions.rows[0]);
        reactions.multipliers[0].fill(0.0);
        Ok(reactions.factor(0, start, 0.5 * h * h))
    }

    /// Takes the rates half a step ahead with the accelerations at the beginning, where the iterations start.
    fn predict(&mut self, before: &Point<V>, a: &V, half: f64) {
        let [here, there] = &mut self.rates;
        here.clone_from(&before.v);
        for (rate, a) in here.as_mut_slice().iter_mut().zip(a.as_slice()) {
            *rate += half * a;
        }
        there.clone_from(here);
    }

    /// An iteration for `p½`, `q₁` and the multipliers. Returns the change of the rates and their size, in the metric of inertia.
    fn iterate<S: System<Vector = V, Matrix = M>, L: InputLaw<S>>(
        &mut self,
        model: &mut Model<'_, S, L>,
        (before, now): (&Point<V>, &mut Point<V>),
        half: f64,
    ) -> Result<[f64; 2], Singular> {
        let Self {
            ends: [start, ahead],
            rates: [here, there],
            force,
            momenta,
            half_way,
            scratch,
            reactions,
        } = self;
        model.set_inputs(before.t, &before.q, here);
        let system = model.system.get();
        let at = At {
            t: before.t,
            q: &before.q,
            v: &*here,
            u: &model.inputs,
        };
        start.force(system, at, force);
        half_way.clone_from(momenta);
        for (p, force) in half_way.as_mut_slice().iter_mut().zip(force.as_slice()) {
            *p += half * force;
        }
        reactions.add(0, half, &reactions.multipliers[0], half_way);
        let mut change = 0.0;
        let mut size = dot(half_way, here).abs();
        // The resulting change of the rates at the beginning, then of those at the end.
        set_rates(start, half_way, here, scratch, &mut change);
        for j in 0..before.q.as_slice().len() {
            let rates = here.as_slice()[j] + there.as_slice()[j];
            now.q.as_mut_slice()[j] =
                before.q.as_slice()[j] + (before.q_low.as_slice()[j] + half * rates);
        }
        ahead.go_to(system, now.t, &now.q)?;
        size += dot(half_way, there).abs();
        set_rates(ahead, half_way, there, scratch, &mut change);
        if !reactions.is_empty() {
            system.constraint_positions(now.t, &now.q, &mut reactions.residuals[0]);
            reactions.solve(0);
            let residuals = reactions.residuals[0].iter();
            for (multiplier, residual) in reactions.multipliers[0].iter_mut().zip(residuals) {
                *multiplier -= residual;
            }
            // The resulting change of the rates at both ends, so that the next iteration begins on the constraints.
            for (at, rates) in [(&*start, &mut *here), (&*ahead, &mut *there)] {
                scratch.as_mut_slice().fill(0.0);
                reactions.add(0, -half, &reactions.residuals[0], scratch);
                force.clone_from(scratch);
                at.to_rates(scratch.as_mut_slice());
                change += dot(force, scratch).abs();
                for (rate, by) in rates.as_mut_slice().iter_mut().zip(scratch.as_slice()) {
                    *rate += by;
                }
            }
        }
        Ok([change, size])
    }

    /// Sets the rates at the end of the step, which obey the constraints there. Returns whether these are independent.
    fn arrive<S: System<Vector = V, Matrix = M>, L: InputLaw<S>>(
        &mut self,
        model: &mut Model<'_, S, L>,
        (before, now): (&Point<V>, &mut Point<V>),
        half: f64,
    ) -> bool {
        let Self {
            ends: [_, ahead],
            rates: [_, there],
            force,
            half_way,
            scratch,
            reactions,
            ..
        } = self;
        model.set_inputs(now.t, &now.q, there);
        let system = model.system.get();
        let at = At {
            t: now.t,
            q: &now.q,
            v: &*there,
            u: &model.inputs,
        };
        ahead.force(system, at, force);
        for (p, force) in half_way.as_mut_slice().iter_mut().zip(force.as_slice()) {
            *p += half * force;
        }
        ahead.add_momenta(-1.0, &before.v, half_way);
        ahead.add_momenta(-1.0, &before.v_low, half_way);
        ahead.to_rates(half_way.as_mut_slice());
        for (j, by) in half_way.as_slice().iter().enumerate() {
            add(&mut now.v, &mut now.v_low, j, *by);
        }
        if reactions.is_empty() {
            return true;
        }
        system.constraint_matrix(now.t, &now.q, &mut reactions.rows[1]);
        if !reactions.factor(1, ahead, 1.0) {
            return false;
        }
        system.constraint_rates(now.t, &now.q, &now.v, &mut reactions.residuals[1]);
        reactions.solve(1);
        reactions.subtract_rates(1, ahead, scratch, |j, by| {
            add(&mut now.v, &mut now.v_low, j, -by);
        });
        true
    }
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Takes a step of length `h` from `before` to `now`.
    pub(super) fn attempt_by_rattle(&mut self, h: f64, last: bool) -> Result<(), StepError> {
        let Self {
            model,
            before,
            now,
            k,
            control,
            end,
            fixed,
            ..
        } = self;
        let Some(Fixed::Rattle(rattle)) = fixed.as_deref_mut() else {
            return Ok(());
        };
        let t = before.t;
        let singular = |singular| StepError::Singular { singular, t };
        let not_solved = StepError::NotSolved { t, step: h };
        let half = 0.5 * h;
        now.set_time(before, h, (*end, &[last]));
        let is_regular = rattle.begin(model.system.get(), before, h);
        if !is_regular.map_err(singular)? {
            return Err(not_solved);
        }
        let Rattle {
            ends: [start, _],
            scratch,
            reactions,
            ..
        } = &mut *rattle;
        let rounding = reactions.rounding(start, (before, h), scratch);
        rattle.predict(before, &k[0], half);
        let mut rounds = ConvergenceTest::START;
        loop {
            control.work.evaluations += 1;
            let iterated = rattle.iterate(model, (&*before, &mut *now), half);
            let [change, size] = iterated.map_err(singular)?;
            match rounds.is_last(change, (size, rounding)) {
                Some(true) => break,
                Some(false) => {}
                None => return Err(not_solved),
            }
        }
        let [here, there] = &rattle.rates;
        for (j, (here, there)) in here.as_slice().iter().zip(there.as_slice()).enumerate() {
            now.q.as_mut_slice()[j] = before.q.as_slice()[j];
            add(&mut now.q, &mut now.q_low, j, half * (here + there));
        }
        control.work.evaluations += 1;
        if !rattle.arrive(model, (&*before, &mut *now), half) {
            return Err(not_solved);
        }
        self.arrive_without_stages(h)
    }
}

/// Sets the rates to those of the momenta `p`, and adds the square of the change in the metric of inertia to `change`.
fn set_rates<V: Vector, M: Vector>(
    at: &Canonical<V, M>,
    p: &V,
    rates: &mut V,
    scratch: &mut V,
    change: &mut f64,
) {
    scratch.clone_from(p);
    at.add_momenta(-1.0, rates, scratch);
    let residual = scratch.clone();
    at.to_rates(scratch.as_mut_slice());
    *change += dot(&residual, scratch).abs();
    for (rate, by) in rates.as_mut_slice().iter_mut().zip(scratch.as_slice()) {
        *rate += by;
    }
}
