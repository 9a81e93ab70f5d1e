//! The part of the residual of an energy balance that tolerance and rounding explain.

use std::vec;
use std::vec::Vec;

use crate::inputs::InputLaw;
use crate::math::sqrt;
use crate::stepper::Stepper;
use crate::{Energies, Quadratures, System, Vector};

/// Safety factor, since errors of steps are estimates, energies are nonlinear, and bounds are evaluated at the ends of steps only.
const MARGIN: f64 = 20.0;

/// Roundings of an energy and of its integrals in each step, in units in the last place.
const ROUNDINGS: f64 = 16.0;

/// Contributions so far.
#[derive(Clone, Debug)]
pub(crate) struct ExplainedResidual<V> {
    steps: usize,
    /// The sum over all steps, in J.
    by_tolerance: f64,
    /// Round-off of the potential energy by rounding of coordinates, and the largest energies, in J.
    by_rounding: f64,
    greatest_energy: f64,
    /// `√Mᵢᵢ`, from the last step whose number was a power of two.
    inertia: Vec<f64>,
    /// Memory of each step: the tolerable errors of coordinates and of rates, and the applied forces.
    tolerable: [Vec<f64>; 2],
    applied: Option<V>,
}

impl<V> Default for ExplainedResidual<V> {
    fn default() -> Self {
        Self {
            steps: 0,
            by_tolerance: 0.0,
            by_rounding: 0.0,
            greatest_energy: 0.0,
            inertia: Vec::new(),
            tolerable: [Vec::new(), Vec::new()],
            applied: None,
        }
    }
}

impl<V: Vector> ExplainedResidual<V> {
    /// Adds the contribution of the last step, given the energies at its end. Returns the part of the residual of this step that
    /// tolerance and rounding explain, in J.
    pub fn take<S: System<Vector = V>, L: InputLaw<S>, A: Quadratures<S>>(
        &mut self,
        system: &S,
        stepper: &Stepper<'_, S, L, A>,
        energies: &Energies,
    ) -> f64 {
        let (t, q, v, a) = (stepper.t(), stepper.q(), stepper.v(), stepper.a());
        let u = stepper.inputs();
        let n = q.as_slice().len();
        self.steps += 1;
        let of_states = system.state_energy(t, q, v).abs();
        self.greatest_energy = (self.greatest_energy)
            .max(energies.kinetic.abs() + energies.potential.abs() + of_states)
            .max(energies.work.abs() + energies.dissipated.abs());
        if self.steps.is_power_of_two() {
            self.update_costly_bounds(system, (t, q, u), energies.potential);
        }
        for (tolerable, of) in self.tolerable.iter_mut().zip([q, v]) {
            tolerable.clear();
            let of = of.as_slice().iter().enumerate();
            tolerable.extend(of.map(|(i, x)| stepper.tolerable(i, *x)));
        }
        let [of_q, of_v] = [&self.tolerable[0], &self.tolerable[1]];
        let length = |of: &[f64]| {
            let each = self.inertia.iter().zip(of);
            each.map(|(d, x)| d * x.abs()).sum::<f64>()
        };
        let applied = self.applied.get_or_insert_with(|| q.zeros_like());
        system.applied(t, q, v, u, applied);
        let work = applied.as_slice().iter().zip(of_q);
        let mut change = work.map(|(force, by)| (force * by).abs()).sum::<f64>();
        let (by_q, by_v) = (length(of_q), length(of_v));
        change += length(a.as_slice()) * by_q
            + (sqrt(2.0 * (energies.kinetic.abs() + of_states)) + by_v) * by_v;
        if stepper.is_implicit() {
            let power = |q: &S::Vector, v: &S::Vector| {
                system.work_rate(t, q, v, a, u) - system.dissipation_rate(t, q, v, u)
            };
            let here = power(q, v);
            let mut most = 0.0_f64;
            for alternating in [1.0, -1.0] {
                let moved = |of: &V, by: &[f64]| {
                    let (mut moved, mut sign) = (of.clone(), 1.0);
                    for (x, by) in moved.as_mut_slice().iter_mut().zip(by) {
                        *x += sign * by;
                        sign *= alternating;
                    }
                    moved
                };
                let (q, v) = (moved(q, of_q), moved(v, of_v));
                most = most.max((power(&q, &v) - here).abs());
                change += (system.potential_energy(t, &q, u) - energies.potential).abs();
            }
            change += most * stepper.last_step().abs();
        }
        let of_step = sqrt((2 * n) as f64) * change;
        self.by_tolerance += of_step;
        MARGIN * of_step + ROUNDINGS * (f64::EPSILON * self.greatest_energy + self.by_rounding)
    }

    /// Updates the quantities that take many evaluations.
    fn update_costly_bounds<S: System<Vector = V>>(
        &mut self,
        system: &S,
        (t, q, u): (f64, &S::Vector, &S::Inputs),
        here: f64,
    ) {
        let n = q.as_slice().len();
        self.inertia = vec![0.0; n];
        let rest = q.zeros_like();
        let energy = |v: &S::Vector| system.kinetic_energy(t, q, v) + system.state_energy(t, q, v);
        let of_rest = energy(&rest);
        for (i, inertia) in self.inertia.iter_mut().enumerate() {
            // T is of second degree in the rates.
            let mut doubled = -2.0 * of_rest;
            for rate in [1.0, -1.0] {
                let mut v = rest.clone();
                v.as_mut_slice()[i] = rate;
                doubled += energy(&v);
            }
            *inertia = sqrt(doubled.max(0.0));
        }
        for times in [-3.0, -1.0, 1.0, 3.0] {
            let mut moved = q.clone();
            let mut sign = 1.0;
            for x in moved.as_mut_slice() {
                *x += sign * times * f64::EPSILON * x.abs().max(1.0);
                sign = -sign;
            }
            let by = (system.potential_energy(t, &moved, u) - here).abs();
            if by.is_finite() {
                self.by_rounding = self.by_rounding.max(by);
            }
        }
    }

    /// The total, in J. `exchanged` is the energy exchanged.
    pub fn total(&self, exchanged: f64) -> f64 {
        let each = f64::EPSILON * (self.greatest_energy + exchanged) + self.by_rounding;
        MARGIN * self.by_tolerance + ROUNDINGS * sqrt(self.steps as f64) * each
    }
}
