//! Steps of Gauss methods: collocation of the equations in momenta,
//!
//! ```text
//! Qᵢ = q₀ + h Σⱼ aᵢⱼ Vⱼ,   M(Qᵢ) Vᵢ = p₀ + h Σⱼ aᵢⱼ Fⱼ,   F = dp/dt at (Q, V)
//! q₁ = q₀ + h Σⱼ bⱼ Vⱼ,    M(q₁) v₁ = p₀ + h Σⱼ bⱼ Fⱼ
//! ```
//!
//! E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, 2nd ed., 2006, sections II.1.3 and VI.4. The
//! equations are solved by fixed-point iteration to rounding, section VIII.6.1, since the remaining error of an iteration
//! is not symplectic. With constraints of positions, reactions act at the nodes of Lobatto's quadrature, where the constraints hold
//! ([`lobatto`](super::lobatto)):
//!
//! ```text
//! M(Qᵢ) Vᵢ = p₀ + h Σⱼ aᵢⱼ Fⱼ + h Σⱼ ãᵢⱼ G(Q̃ⱼ)ᵀ ψⱼ,      Q̃ₖ = q₀ + h Σⱼ āₖⱼ Vⱼ,  g(Q̃ₖ) = 0
//! M(q₁) v₁ = p₀ + h Σⱼ bⱼ Fⱼ + h Σⱼ b̃ⱼ G(Q̃ⱼ)ᵀ ψⱼ,      G(q₁) v₁ + ∂g/∂t = 0
//! ```
//!
//! The multipliers are found with the iteration, by the matrix `G M⁻¹ Gᵀ` at the beginning of the step.

use std::vec::Vec;

use super::canonical::{Canonical, ConvergenceTest, dot};
use super::lobatto::Lobatto;
use super::reactions::Reactions;
use super::{Fixed, Stepper, add, check_finite};
use crate::at::At;
use crate::balance::Quadratures;
use crate::methods::{Method, Tableau};
use crate::stages::Point;
use crate::stepper::Model;
use crate::{InputLaw, Singular, StepError, System, Vector};

/// Memory for the stages.
#[derive(Clone, Debug)]
pub(crate) struct Gauss<V, M> {
    canonical: Canonical<V, M>,
    places: Vec<V>,
    rates: Vec<V>,
    forces: Vec<V>,
    momenta: V,
    scratch: V,
    constraints: Option<Constraints<V>>,
}

/// The constraints of a machine at the nodes of a step.
#[derive(Clone, Debug)]
struct Constraints<V> {
    lobatto: Lobatto,
    reactions: Reactions,
    place: V,
    /// One constraint at all nodes.
    across_nodes: Vec<f64>,
}

impl<V: Vector, M: Vector> Gauss<V, M> {
    pub fn new<S: System<Vector = V, Matrix = M>>(
        system: &S,
        now: &Point<V>,
        (method, redundant): (&Method, bool),
    ) -> Result<Self, StepError> {
        let canonical = Canonical::new(system, (now.t, &now.q))?;
        let zeros = now.q.zeros_like();
        let constraints = if system.constraints().len() == 0 {
            None
        } else {
            let Some(lobatto) = Lobatto::of(&method.tableau) else {
                let reason = "it has constraints, which this method does not support";
                return Err(StepError::Unsuited { reason, t: now.t });
            };
            let nodes = lobatto.nodes.len();
            Some(Constraints {
                reactions: Reactions::new(system, now, (redundant, nodes))?,
                place: zeros.clone(),
                across_nodes: std::vec![0.0; nodes - 1],
                lobatto,
            })
        };
        let stages = || std::vec![zeros.clone(); method.tableau.stages - 1];
        Ok(Self {
            canonical,
            places: stages(),
            rates: stages(),
            forces: stages(),
            momenta: zeros.clone(),
            scratch: zeros.clone(),
            constraints,
        })
    }
}

impl<V: Vector> Constraints<V> {
    /// Sets the place at a node, given the rates at the stages.
    fn place_at(&mut self, node: usize, (before, h): (&Point<V>, f64), rates: &[V]) -> f64 {
        let weights = &self.lobatto.places[node];
        for (j, place) in self.place.as_mut_slice().iter_mut().enumerate() {
            let change = weighted(weights, rates, j);
            *place = before.q.as_slice()[j] + (before.q_low.as_slice()[j] + h * change);
        }
        before.t + (before.t_low + self.lobatto.nodes[node] * h)
    }

    /// Evaluates the rows within the step, given the rates at the stages.
    fn set_rows<S: System<Vector = V>>(
        &mut self,
        system: &S,
        (before, h): (&Point<V>, f64),
        rates: &[V],
    ) {
        for node in 1..self.across_nodes.len() {
            let t = self.place_at(node, (before, h), rates);
            system.constraint_matrix(t, &self.place, &mut self.reactions.rows[node]);
        }
    }

    /// Adds the impulses of the reactions with these weights to `p`.
    fn add_reactions(&self, weights: &[f64], h: f64, p: &mut V) {
        for (node, weight) in weights.iter().enumerate().take(self.across_nodes.len()) {
            let multipliers = &self.reactions.multipliers[node];
            self.reactions.add(node, weight * h, multipliers, p);
        }
    }

    /// A Newton step for the multipliers, with the matrix of the beginning: the residuals at the nodes, given the rates at the stages, would
    /// vanish if the rows did not change in the step.
    fn correct<S: System<Vector = V>>(
        &mut self,
        system: &S,
        (before, h): (&Point<V>, f64),
        rates: &[V],
    ) {
        let s = self.across_nodes.len();
        for node in 1..=s {
            let t = self.place_at(node, (before, h), rates);
            let residuals = &mut self.reactions.residuals[node];
            system.constraint_positions(t, &self.place, residuals);
            self.reactions.solve(node);
        }
        for constraint in 0..self.reactions.multipliers[0].len() {
            let residuals = self.reactions.residuals[1..].iter();
            for (x, residuals) in self.across_nodes.iter_mut().zip(residuals) {
                *x = residuals[constraint];
            }
            self.lobatto.effect.solve([&mut self.across_nodes]);
            let multipliers = self.reactions.multipliers.iter_mut();
            for (multipliers, x) in multipliers.zip(&self.across_nodes) {
                multipliers[constraint] -= x / (h * h);
            }
        }
    }
}

impl<V: Vector, M: Vector> Gauss<V, M> {
    /// Sets the momenta at the beginning of a step of length `h`, and rates at the stages with the accelerations there, where the iterations
    /// start. Returns the effect of round-off in the constraints on the rates, or `None` if they do not determine their multipliers.
    fn begin<S: System<Vector = V, Matrix = M>>(
        &mut self,
        system: &S,
        (before, a): (&Point<V>, &V),
        (tableau, h): (&Tableau, f64),
    ) -> Result<Option<f64>, Singular> {
        self.canonical.go_to(system, before.t, &before.q)?;
        self.momenta.as_mut_slice().fill(0.0);
        self.canonical
            .add_momenta(1.0, &before.v, &mut self.momenta);
        self.canonical
            .add_momenta(1.0, &before.v_low, &mut self.momenta);
        for (i, rates) in self.rates.iter_mut().enumerate() {
            rates.clone_from(&before.v);
            for (rate, a) in rates.as_mut_slice().iter_mut().zip(a.as_slice()) {
                *rate += tableau.c[i + 1] * h * a;
            }
        }
        let Some(constraints) = &mut self.constraints else {
            return Ok(Some(0.0));
        };
        let reactions = &mut constraints.reactions;
        system.constraint_matrix(before.t, &before.q, &mut reactions.rows[0]);
        for multipliers in &mut reactions.multipliers {
            multipliers.fill(0.0);
        }
        if !reactions.factor(0, &self.canonical, 1.0) {
            return Ok(None);
        }
        let rounding = reactions.rounding(&self.canonical, (before, h), &mut self.scratch);
        Ok(Some(constraints.lobatto.amplification * rounding))
    }

    /// An iteration for the rates at the stages. Returns their change and their size, in the metric of inertia.
    fn iterate<S: System<Vector = V, Matrix = M>, L: InputLaw<S>>(
        &mut self,
        model: &mut Model<'_, S, L>,
        before: &Point<V>,
        (tableau, h): (&Tableau, f64),
    ) -> Result<[f64; 2], Singular> {
        let Self {
            canonical,
            places,
            rates,
            forces,
            momenta,
            scratch,
            constraints,
        } = self;
        let time = |stage: usize| stage_time(before, tableau, stage, h);
        for (i, (place, force)) in places.iter_mut().zip(&mut *forces).enumerate() {
            for j in 0..before.q.as_slice().len() {
                let change = weighted(&tableau.a[i + 1][1..], rates, j);
                place.as_mut_slice()[j] =
                    before.q.as_slice()[j] + (before.q_low.as_slice()[j] + h * change);
            }
            let t = time(i + 1);
            model.set_inputs(t, place, &rates[i]);
            let at = At {
                t,
                q: &*place,
                v: &rates[i],
                u: &model.inputs,
            };
            canonical.force(model.system.get(), at, force);
        }
        if let Some(constraints) = constraints {
            constraints.set_rows(model.system.get(), (before, h), rates);
        }
        let (mut change, mut size) = (0.0, 0.0);
        for (i, place) in places.iter().enumerate() {
            canonical.go_to(model.system.get(), time(i + 1), place)?;
            // The residual of the equation of this stage, and the resulting change of its rates.
            scratch.clone_from(momenta);
            for (j, p) in scratch.as_mut_slice().iter_mut().enumerate() {
                *p += h * weighted(&tableau.a[i + 1][1..], forces, j);
            }
            if let Some(constraints) = constraints {
                constraints.add_reactions(&constraints.lobatto.reactions[i], h, scratch);
            }
            size += dot(scratch, &rates[i]).abs();
            canonical.add_momenta(-1.0, &rates[i], scratch);
            let mut by = scratch.clone();
            canonical.to_rates(by.as_mut_slice());
            change += dot(scratch, &by).abs();
            for (rate, by) in rates[i].as_mut_slice().iter_mut().zip(by.as_slice()) {
                *rate += by;
            }
        }
        if let Some(constraints) = constraints {
            constraints.correct(model.system.get(), (before, h), rates);
        }
        Ok([change, size])
    }
}

/// The instant of a stage.
fn stage_time<V>(before: &Point<V>, tableau: &Tableau, stage: usize, h: f64) -> f64 {
    before.t + (before.t_low + tableau.c[stage] * h)
}

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Takes a step of length `h` from `before` to `now`.
    pub(super) fn attempt_by_gauss(&mut self, h: f64, last: bool) -> Result<(), StepError> {
        let Self {
            method,
            model,
            before,
            k,
            control,
            fixed,
            ..
        } = self;
        let Some(Fixed::Gauss(gauss)) = fixed.as_deref_mut() else {
            return Ok(());
        };
        let tableau = &method.tableau;
        let t = before.t;
        let singular = |singular| StepError::Singular { singular, t };
        let not_solved = StepError::NotSolved { t, step: h };
        let begun = gauss.begin(model.system.get(), (before, &k[0]), (tableau, h));
        let Some(rounding) = begun.map_err(singular)? else {
            return Err(not_solved);
        };
        let mut rounds = ConvergenceTest::START;
        loop {
            control.work.evaluations += tableau.stages - 1;
            let iterated = gauss.iterate(model, before, (tableau, h));
            let [change, size] = iterated.map_err(singular)?;
            match rounds.is_last(change, (size, rounding)) {
                Some(true) => break,
                Some(false) => {}
                None => return Err(not_solved),
            }
        }
        self.arrive_by_gauss(h, last)
    }

    /// Goes to the end of a step whose stages are solved, and integrates the powers along it.
    fn arrive_by_gauss(&mut self, h: f64, last: bool) -> Result<(), StepError> {
        let Self {
            method,
            model,
            quadratures,
            before,
            now,
            k,
            control,
            end,
            fixed,
            ..
        } = self;
        let Some(Fixed::Gauss(gauss)) = fixed.as_deref_mut() else {
            return Ok(());
        };
        let tableau = &method.tableau;
        let (stages, n) = (tableau.stages, before.q.as_slice().len());
        let t = before.t;
        let singular = |singular| StepError::Singular { singular, t };
        let Gauss {
            canonical,
            places,
            rates,
            forces,
            momenta,
            scratch,
            constraints,
        } = gauss;
        let b = &tableau.a[stages][1..];
        for j in 0..n {
            add(&mut now.q, &mut now.q_low, j, h * weighted(b, rates, j));
        }
        now.set_time(before, h, (*end, &[last]));
        canonical
            .go_to(model.system.get(), now.t, &now.q)
            .map_err(singular)?;
        scratch.clone_from(momenta);
        for (j, p) in scratch.as_mut_slice().iter_mut().enumerate() {
            *p += h * weighted(b, forces, j);
        }
        if let Some(constraints) = constraints {
            constraints.add_reactions(constraints.lobatto.weights, h, scratch);
        }
        canonical.add_momenta(-1.0, &before.v, scratch);
        canonical.add_momenta(-1.0, &before.v_low, scratch);
        canonical.to_rates(scratch.as_mut_slice());
        for (j, by) in scratch.as_slice().iter().enumerate() {
            add(&mut now.v, &mut now.v_low, j, *by);
        }
        if let Some(Constraints { reactions, .. }) = constraints {
            let system = model.system.get();
            system.constraint_matrix(now.t, &now.q, &mut reactions.rows[stages - 1]);
            if !reactions.factor(stages - 1, canonical, 1.0) {
                return Err(StepError::NotSolved { t, step: h });
            }
            let residuals = &mut reactions.residuals[stages - 1];
            system.constraint_rates(now.t, &now.q, &now.v, residuals);
            reactions.solve(stages - 1);
            reactions.subtract_rates(stages - 1, canonical, scratch, |j, by| {
                add(&mut now.v, &mut now.v_low, j, -by);
            });
            model.project(now)?;
        }
        check_finite(now)?;
        if quadratures.integrals().is_some() {
            for (i, (place, rates)) in places.iter().zip(&*rates).enumerate() {
                let t = stage_time(before, tableau, i + 1, h);
                model.accelerations(t, place, rates, &mut k[i + 1], &mut control.work)?;
                model.take_rates(quadratures, i + 1, (t, place, rates, &k[i + 1]));
            }
        }
        model.end(now, quadratures, stages, k, &mut control.work)
    }
}

/// `Σᵢ wᵢ xᵢ` for one coordinate.
fn weighted<V: Vector>(weights: &[f64], stages: &[V], coordinate: usize) -> f64 {
    let pairs = weights.iter().zip(stages);
    pairs
        .map(|(weight, stage)| weight * stage.as_slice()[coordinate])
        .sum()
}
