//! Steps of Gauss methods: collocation of the equations in momenta,
//!
//! ```text
//! Qᵢ = q₀ + h Σⱼ aᵢⱼ Vⱼ,   M(Qᵢ) Vᵢ = p₀ + h Σⱼ aᵢⱼ Fⱼ,   F = dp/dt at (Q, V)
//! q₁ = q₀ + h Σⱼ bⱼ Vⱼ,    M(q₁) v₁ = p₀ + h Σⱼ bⱼ Fⱼ
//! ```
//!
//! E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, 2nd ed., 2006, sections II.1.3 and VI.4. The
//! equations are solved by fixed-point iteration to rounding, section VIII.6.1, since the remaining error of an iteration
//! is not symplectic.

use std::vec::Vec;

use super::canonical::{Canonical, ConvergenceTest};
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
}

impl<V: Vector, M: Vector> Gauss<V, M> {
    pub fn new<S: System<Vector = V, Matrix = M>>(
        system: &S,
        now: &Point<V>,
        method: &Method,
    ) -> Result<Self, StepError> {
        let canonical = Canonical::new(system, (now.t, &now.q))?;
        let zeros = now.q.zeros_like();
        let stages = || std::vec![zeros.clone(); method.tableau.stages - 1];
        Ok(Self {
            canonical,
            places: stages(),
            rates: stages(),
            forces: stages(),
            momenta: zeros.clone(),
            scratch: zeros.clone(),
        })
    }
}

impl<V: Vector, M: Vector> Gauss<V, M> {
    /// Sets the momenta at the beginning of a step of length `h`, and rates at the stages with the accelerations there, where the iterations
    /// start.
    fn begin<S: System<Vector = V, Matrix = M>>(
        &mut self,
        system: &S,
        (before, a): (&Point<V>, &V),
        (tableau, h): (&Tableau, f64),
    ) -> Result<(), Singular> {
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
        Ok(())
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
        let (mut change, mut size) = (0.0, 0.0);
        for (i, place) in places.iter().enumerate() {
            canonical.go_to(model.system.get(), time(i + 1), place)?;
            // The residual of the equation of this stage, and the resulting change of its rates.
            scratch.clone_from(momenta);
            for (j, p) in scratch.as_mut_slice().iter_mut().enumerate() {
                *p += h * weighted(&tableau.a[i + 1][1..], forces, j);
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
        gauss
            .begin(model.system.get(), (before, &k[0]), (tableau, h))
            .map_err(singular)?;
        let mut rounds = ConvergenceTest::START;
        loop {
            control.work.evaluations += stages - 1;
            let iterated = gauss.iterate(model, before, (tableau, h));
            let [change, size] = iterated.map_err(singular)?;
            match rounds.is_last(change, size) {
                Some(true) => break,
                Some(false) => {}
                None => return Err(StepError::NotSolved { t, step: h }),
            }
        }

        let Gauss {
            canonical,
            places,
            rates,
            forces,
            momenta,
            scratch,
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
        canonical.add_momenta(-1.0, &before.v, scratch);
        canonical.add_momenta(-1.0, &before.v_low, scratch);
        canonical.to_rates(scratch.as_mut_slice());
        for (j, by) in scratch.as_slice().iter().enumerate() {
            add(&mut now.v, &mut now.v_low, j, *by);
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

pub(super) fn dot<V: Vector>(x: &V, y: &V) -> f64 {
    let pairs = x.as_slice().iter().zip(y.as_slice());
    pairs.map(|(x, y)| x * y).sum()
}
