//! What prescribed motion does against the forces of contacts.
//!
//! A force `λ` along a rate `γ = w v + ∂g/∂t` of a contact adds `u = M⁻¹ (wᵀ λ + Gᵀ ν)` to the accelerations, where `ν` keeps the constraints,
//! and so `p·u` to the power, where `p = ∂T/∂v` is the momentum. Of this the contact takes `−λ γ`, by friction or by yielding. The rest,
//!
//! ```text
//! P = p·u − λ γ,
//! ```
//!
//! is done by what moves as prescribed: walls, bodies that are driven, and moving constraints. Where only a wall moves, `p·u = λ w v` and
//! `P = −λ ∂g/∂t`. If the same machine has coordinates relative to this wall, `γ` is free of `t` and the momentum is not `M v`; P is the same, since
//! energies, forces and rates are. All this holds for impulses as well, with the means of `v` and `γ` before and after.

use super::kinematics::ContactKinematics;
use crate::math::sqrt;
use crate::{System, Vector};

/// What moves as prescribed in a machine at an instant.
pub(super) struct Drives<'a, S: System> {
    system: &'a S,
    t: f64,
    q: &'a S::Vector,
    /// Whether anything but walls moves while all rates are 0.
    pub is_moving: bool,
}

/// A contact with its forces or impulses and its rates, or their means.
pub(super) struct ActingContact {
    pub contact: usize,
    pub forces: [f64; 2],
    pub rates: [f64; 2],
}

impl<'a, S: System> Drives<'a, S> {
    pub fn new(system: &'a S, (t, q): (f64, &'a S::Vector)) -> Self {
        let rest = q.zeros_like();
        // Not so if the energy is unknown, which is not a number.
        let mut is_moving = system.kinetic_energy(t, q, &rest) > 0.0;
        let m = system.constraints().len();
        if m > 0 && system.kinetic_energy(t, q, &rest).is_finite() {
            let mut rates = std::vec![0.0; m];
            system.constraint_rates(t, q, &rest, &mut rates);
            is_moving |= rates.iter().any(|rate| *rate != 0.0);
        }
        Self {
            system,
            t,
            q,
            is_moving,
        }
    }

    /// What prescribed motion does against the forces of a contact while the rates are `v`, in W, or against its impulses, in J. `response` is what
    /// they add to the accelerations, or to the rates.
    pub fn work(
        &self,
        here: &ContactKinematics,
        acting: &ActingContact,
        v: &S::Vector,
        response: impl FnOnce() -> std::vec::Vec<f64>,
    ) -> f64 {
        let ActingContact {
            contact,
            forces,
            rates,
        } = *acting;
        if !self.is_moving {
            return here.work_of_walls(contact, forces);
        }
        let u = response();
        let along = |part: usize| {
            let row = here.row(2 * contact + part).iter();
            forces[part] * row.zip(&u).map(|(w, u)| w * u).sum::<f64>()
        };
        // `½ u·M u`, since the reactions of the constraints do nothing along u.
        let energy_of_response = 0.5 * (along(0) + along(1));
        self.power(v, &u, energy_of_response) - forces[0] * rates[0] - forces[1] * rates[1]
    }

    /// `p·u`. T is of second degree in the rates, so `p·u = (T(v + u) − T(v − u))/2`; with u scaled to the energy of v no digits are lost.
    fn power(&self, v: &S::Vector, u: &[f64], energy_of_response: f64) -> f64 {
        let energy = |scale: f64| {
            let mut rates = v.clone();
            for (rate, u) in rates.as_mut_slice().iter_mut().zip(u) {
                *rate += scale * u;
            }
            self.system.kinetic_energy(self.t, self.q, &rates)
        };
        let own = energy(0.0);
        if own <= 0.0 || energy_of_response <= 0.0 {
            return 0.0;
        }
        let scale = sqrt(own / energy_of_response);
        0.5 * (energy(scale) - energy(-scale)) / scale
    }
}
