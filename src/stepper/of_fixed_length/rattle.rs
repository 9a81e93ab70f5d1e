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

use std::vec::Vec;

use super::canonical::{Canonical, ConvergenceTest};
use super::gauss::dot;
use super::{Fixed, Stepper, add};
use crate::at::At;
use crate::balance::Quadratures;
use crate::constraints::algebra::{backward, cholesky, forward};
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
    constraints: EndConstraints,
}

/// The constraints at both ends.
#[derive(Clone, Debug)]
struct EndConstraints {
    /// `G`, row after row.
    rows: [Vec<f64>; 2],
    /// `G M⁻¹` at the beginning, then at the end.
    by_force: Vec<f64>,
    /// `G(q₁) M⁻¹ Gᵀ`, symmetric except for the change of `G` in a step, and its factor.
    matrix: Vec<f64>,
    shares: Vec<f64>,
    multipliers: Vec<f64>,
    residuals: Vec<f64>,
}

impl<V: Vector, M: Vector> Rattle<V, M> {
    pub fn new<S: System<Vector = V, Matrix = M>>(
        system: &S,
        now: &Point<V>,
        redundant: bool,
    ) -> Result<Self, StepError> {
        let unsuited = |reason| Err(StepError::Unsuited { reason, t: now.t });
        if !system.constraints().all(|constraint| constraint.holonomic) {
            return unsuited("it has constraints on rates that are not constraints on positions");
        }
        if redundant {
            return unsuited("it has constraints that depend on each other");
        }
        let canonical = Canonical::new(system, (now.t, &now.q))?;
        let zeros = now.q.zeros_like();
        let (n, m) = (zeros.as_slice().len(), system.constraints().len());
        let numbers = |count: usize| std::vec![0.0; count];
        Ok(Self {
            ends: [canonical.clone(), canonical],
            rates: [zeros.clone(), zeros.clone()],
            force: zeros.clone(),
            momenta: zeros.clone(),
            half_way: zeros.clone(),
            scratch: zeros,
            constraints: EndConstraints {
                rows: [numbers(m * n), numbers(m * n)],
                by_force: numbers(m * n),
                matrix: numbers(m * m),
                shares: numbers(m),
                multipliers: numbers(m),
                residuals: numbers(m),
            },
        })
    }
}

impl EndConstraints {
    fn is_empty(&self) -> bool {
        self.multipliers.is_empty()
    }

    /// Factorizes `scale G M⁻¹ Gᵀ` at one end. Returns whether it is invertible.
    fn factor<V: Vector, M: Vector>(
        &mut self,
        end: usize,
        canonical: &Canonical<V, M>,
        scale: f64,
    ) -> bool {
        let m = self.multipliers.len();
        let n = self.by_force.len() / m;
        let rows = &self.rows[end];
        self.by_force.copy_from_slice(rows);
        for row in self.by_force.chunks_exact_mut(n) {
            canonical.to_rates(row);
        }
        for (i, by_force) in self.by_force.chunks_exact(n).enumerate() {
            for (j, row) in rows.chunks_exact(n).enumerate() {
                let product: f64 = row.iter().zip(by_force).map(|(a, b)| a * b).sum();
                self.matrix[i * m + j] = scale * product;
            }
        }
        cholesky(&mut self.matrix, &mut self.shares).is_ok()
    }

    /// Computes the multipliers that make the residuals vanish, in `residuals`.
    fn solve(&mut self) {
        forward(&self.matrix, &mut self.residuals);
        backward(&self.matrix, &mut self.residuals);
    }

    /// Adds `scale Gᵀ x` at one end to `p`.
    fn add_forces<V: Vector>(&self, end: usize, scale: f64, of: &[f64], p: &mut V) {
        let p = p.as_mut_slice();
        for (row, x) in self.rows[end].chunks_exact(p.len()).zip(of) {
            for (p, g) in p.iter_mut().zip(row) {
                *p += scale * g * x;
            }
        }
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
        let constraints = &mut self.constraints;
        if constraints.is_empty() {
            return Ok(true);
        }
        system.constraint_matrix(before.t, &before.q, &mut constraints.rows[0]);
        constraints.multipliers.fill(0.0);
        Ok(constraints.factor(0, start, 0.5 * h * h))
    }

    /// The effect of round-off in the constraints on the rates, in the metric of inertia: they change however slow they are, and from rest it is
    /// their only change.
    fn rounding(&mut self, before: &Point<V>, h: f64) -> f64 {
        if self.constraints.is_empty() {
            return 0.0;
        }
        self.scratch.as_mut_slice().fill(0.0);
        self.ends[0].add_momenta(1.0, &before.q, &mut self.scratch);
        16.0 * f64::EPSILON * f64::EPSILON * dot(&self.scratch, &before.q).abs() / (h * h)
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
            constraints,
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
        constraints.add_forces(0, half, &constraints.multipliers, half_way);
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
        if !constraints.is_empty() {
            system.constraint_positions(now.t, &now.q, &mut constraints.residuals);
            constraints.solve();
            let residuals = constraints.residuals.iter();
            for (multiplier, residual) in constraints.multipliers.iter_mut().zip(residuals) {
                *multiplier -= residual;
            }
            // The resulting change of the rates at both ends, so that the next iteration begins on the constraints.
            for (at, rates) in [(&*start, &mut *here), (&*ahead, &mut *there)] {
                scratch.as_mut_slice().fill(0.0);
                constraints.add_forces(0, -half, &constraints.residuals, scratch);
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
            constraints,
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
        if constraints.is_empty() {
            return true;
        }
        system.constraint_matrix(now.t, &now.q, &mut constraints.rows[1]);
        if !constraints.factor(1, ahead, 1.0) {
            return false;
        }
        system.constraint_rates(now.t, &now.q, &now.v, &mut constraints.residuals);
        constraints.solve();
        scratch.as_mut_slice().fill(0.0);
        constraints.add_forces(1, 1.0, &constraints.residuals, scratch);
        ahead.to_rates(scratch.as_mut_slice());
        for (j, by) in scratch.as_slice().iter().enumerate() {
            add(&mut now.v, &mut now.v_low, j, -by);
        }
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
        let rounding = rattle.rounding(before, h);
        rattle.predict(before, &k[0], half);
        let mut rounds = ConvergenceTest::START;
        loop {
            control.work.evaluations += 1;
            let iterated = rattle.iterate(model, (&*before, &mut *now), half);
            let [change, size] = iterated.map_err(singular)?;
            match rounds.is_last_with_rounding(change, (size, rounding)) {
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
