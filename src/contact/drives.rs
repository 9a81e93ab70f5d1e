//! The work of prescribed motion against the forces of contacts.
//!
//! A force `λ` along a rate `γ = w v + ∂g/∂t` of a contact adds `u = M⁻¹ (wᵀ λ + Gᵀ ν)` to the accelerations, where `ν` keeps the constraints,
//! and so `p·u` to the power, where `p = ∂T/∂v` is the momentum. Of this the contact takes `−λ γ`, by friction or by yielding. The rest,
//!
//! ```text
//! P = p·u − λ γ,
//! ```
//!
//! is the power of prescribed motion: of walls, driven bodies and moving constraints. Where only a wall moves, `p·u = λ w v` and
//! `P = −λ ∂g/∂t`. If the same machine has coordinates relative to this wall, `γ` is free of `t` and the momentum is not `M v`; P is the same, since
//! energies, forces and rates are. All this holds for impulses as well, with the means of `v` and `γ` before and after.

use std::vec::Vec;

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
    /// Whether constraints of the machine do.
    pub constraints_move: bool,
    memory: &'a mut DrivesMemory<S::Vector>,
}

/// Memory for [`Drives`].
#[derive(Clone, Debug)]
pub(super) struct DrivesMemory<V> {
    rates: V,
    of_constraints: Vec<f64>,
}

impl<V: Vector> DrivesMemory<V> {
    pub fn new(q: &V) -> Self {
        Self {
            rates: q.zeros_like(),
            of_constraints: Vec::new(),
        }
    }
}

/// A contact with its forces or impulses and its rates, or their means.
pub(super) struct ActingContact {
    pub contact: usize,
    pub forces: [f64; 2],
    pub rates: [f64; 2],
}

impl<'a, S: System> Drives<'a, S> {
    pub fn new(
        system: &'a S,
        (t, q): (f64, &'a S::Vector),
        memory: &'a mut DrivesMemory<S::Vector>,
    ) -> Self {
        let rest = &mut memory.rates;
        rest.as_mut_slice().fill(0.0);
        let energy = system.kinetic_energy(t, q, rest);
        let m = system.constraints().len();
        let mut constraints_move = false;
        if m > 0 {
            let rates = &mut memory.of_constraints;
            rates.resize(m, 0.0);
            system.constraint_rates(t, q, rest, rates);
            constraints_move = rates.iter().any(|rate| *rate != 0.0);
        }
        Self {
            system,
            t,
            q,
            // Nothing is known to move where the energy is not a number.
            is_moving: energy > 0.0 || (constraints_move && energy.is_finite()),
            constraints_move,
            memory,
        }
    }

    /// What prescribed motion does against the forces of a contact while the rates are `v`, in W, or against its impulses, in J. `response` is what
    /// they add to the accelerations, or to the rates.
    pub fn work<U: AsRef<[f64]>>(
        &mut self,
        here: &ContactKinematics,
        acting: &ActingContact,
        v: &S::Vector,
        response: impl FnOnce() -> U,
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
        let u = u.as_ref();
        let along = |part: usize| {
            let row = here.row(2 * contact + part).iter();
            forces[part] * row.zip(u).map(|(w, u)| w * u).sum::<f64>()
        };
        // `½ u·M u`, since the reactions of the constraints do nothing along u.
        let energy_of_response = 0.5 * (along(0) + along(1));
        self.power(v, u, energy_of_response) - forces[0] * rates[0] - forces[1] * rates[1]
    }

    /// `p·u`. T is of second degree in the rates, so `p·u = (T(v + u) − T(v − u))/2`; with u scaled to the energy of v no digits are lost.
    fn power(&mut self, v: &S::Vector, u: &[f64], energy_of_response: f64) -> f64 {
        let rates = &mut self.memory.rates;
        let mut energy = |scale: f64| {
            let pairs = v.as_slice().iter().zip(u);
            for (rate, (v, u)) in rates.as_mut_slice().iter_mut().zip(pairs) {
                *rate = v + scale * u;
            }
            self.system.kinetic_energy(self.t, self.q, rates)
        };
        let own = energy(0.0);
        if own <= 0.0 || energy_of_response <= 0.0 {
            return 0.0;
        }
        let scale = sqrt(own / energy_of_response);
        0.5 * (energy(scale) - energy(-scale)) / scale
    }
}
