//! Compliant contacts: their force, the energy that they store and lose, and when they open.
//!
//! ```text
//! d = −g,  N = k d + b ḋ,  K d^(3/2),  K d^(3/2) (1 + c ḋ),  k₁ d or k₂ (d − d₀)  with d₀ = d* (1 − k₁/k₂)
//! ```
//!
//! A contact presses as long as it is penetrated and N > 0. If its force vanishes while it is still penetrated, the stored energy
//! is lost. A layer loses the power `(1 − k₁/k₂) k₁ d ḋ` while it is loaded, so that crushing it takes `½ (1 − k₁/k₂) k₁ d*²`.

use std::vec;
use std::vec::Vec;

use super::super::kinematics::ContactKinematics;
use super::{Margin, Mode, UnilateralState};
use crate::balance::ContactShare;
use crate::{Compliance, ContactEnergies, ContactQuantity, System, Vector};

/// The law of a contact that yields, and what it remembers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ComplianceState {
    law: Compliance,
    /// Of a layer: how deep it was pressed at most, in m, and whether it is loaded further now.
    depth: f64,
    is_loaded: bool,
}

/// A contact that yields at a state.
#[derive(Clone, Copy, Debug)]
pub(super) struct CompliantForce {
    /// By its formula, in N; negative where it would pull.
    pub force: f64,
    /// In J.
    pub stored: f64,
    /// In W.
    pub lost: f64,
}

/// How far a contact is from closing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clearance {
    /// Positive where it is open: the gap, in m; of a contact that yields what is still open before it presses.
    pub value: f64,
    /// How fast the gap opens, in m/s.
    pub rate: f64,
    /// Whether `rate` is that of `value`.
    pub is_rate_of_value: bool,
}

impl ComplianceState {
    pub fn new(law: Compliance) -> ComplianceState {
        ComplianceState {
            law,
            depth: 0.0,
            is_loaded: false,
        }
    }

    /// The thickness of a layer that has been lost.
    fn crushed_thickness(self, [loading, unloading]: [f64; 2]) -> f64 {
        self.depth * (1.0 - loading / unloading)
    }

    fn compliant_force(self, parameters: [f64; 2], [depth, rate]: [f64; 2]) -> CompliantForce {
        let [first, second] = parameters;
        let root = depth.abs().sqrt();
        match self.law {
            Compliance::Linear => CompliantForce {
                force: first * depth + second * rate,
                stored: 0.5 * first * depth * depth,
                lost: second * rate * rate,
            },
            Compliance::Hertz | Compliance::HuntCrossley => {
                // The second parameter of Hertz's law is 0.
                let force = first * depth * root;
                CompliantForce {
                    force: force * (1.0 + second * rate),
                    stored: 0.4 * force * depth,
                    lost: force * second * rate * rate,
                }
            }
            Compliance::Layer if self.is_loaded => {
                let force = first * depth;
                CompliantForce {
                    force,
                    stored: 0.5 * force * force / second,
                    lost: force * rate * (1.0 - first / second),
                }
            }
            Compliance::Layer => {
                let yielded = depth - self.crushed_thickness(parameters);
                CompliantForce {
                    force: second * yielded,
                    stored: 0.5 * second * yielded * yielded,
                    lost: 0.0,
                }
            }
        }
    }

    /// How much is missing to it being pressed, in m; negative where it is.
    fn missing(self, parameters: [f64; 2], [depth, rate]: [f64; 2]) -> f64 {
        let [first, second] = parameters;
        match self.law {
            Compliance::Layer if !self.is_loaded => self.crushed_thickness(parameters) - depth,
            Compliance::Linear if depth > 0.0 => -depth.min(depth + second / first * rate),
            Compliance::HuntCrossley if depth > 0.0 => -depth * (1.0 + second * rate).min(1.0),
            _ => -depth,
        }
    }
}

impl UnilateralState {
    /// Whether a contact yields.
    pub fn is_compliant(&self, contact: usize) -> bool {
        self.compliance[contact].is_some()
    }

    /// Whether it is a layer that is crushed.
    pub(in crate::contact) fn is_layer(&self, contact: usize) -> bool {
        self.compliance[contact].is_some_and(|own| own.law == Compliance::Layer)
    }

    /// Force and energies of a contact that yields and is closed.
    pub(super) fn compliant_force(
        &self,
        here: &ContactKinematics,
        contact: usize,
    ) -> Option<CompliantForce> {
        let own = self.compliance[contact]?;
        let is_closed = self.modes()[contact] != Mode::Open;
        is_closed.then(|| own.compliant_force(here.restitution(contact), here.depth(contact)))
    }

    /// Force and energies of a contact that yields and is about to close.
    pub(super) fn compliant_force_at_closing(
        &self,
        here: &ContactKinematics,
        contact: usize,
    ) -> Option<CompliantForce> {
        let own = self.compliance[contact]?;
        Some(own.compliant_force(here.restitution(contact), here.depth(contact)))
    }

    /// How far a contact is from closing, or how far it is closed.
    pub(in crate::contact) fn clearance(
        &self,
        here: &ContactKinematics,
        contact: usize,
    ) -> Clearance {
        let of_gap = here.clearance(contact);
        // Of a far contact nothing is known but that it is open.
        let Some(own) = self.compliance[contact].filter(|_| of_gap.value.is_finite()) else {
            return of_gap;
        };
        let is_open = of_gap.value >= -here.gap_rounding(contact);
        Clearance {
            value: own.missing(here.restitution(contact), here.depth(contact)),
            rate: of_gap.rate,
            is_rate_of_value: is_open || own.law == Compliance::Layer,
        }
    }

    /// How far every contact is from closing at a state.
    pub fn clearances<S: System>(
        &self,
        system: &S,
        place: (f64, &S::Vector, &S::Vector),
    ) -> Vec<Clearance> {
        let mut all = Vec::new();
        self.write_clearances_with(system, place, &mut self.memory_for_kinematics(), &mut all);
        all
    }

    /// How far a contact is from closing at a state.
    pub fn clearance_of<S: System>(
        &self,
        system: &S,
        place: (f64, &S::Vector, &S::Vector),
        contact: usize,
    ) -> Clearance {
        if system.single_contacts().is_none() {
            return self.clearances(system, place)[contact];
        }
        let which = [contact];
        if !self.is_compliant(contact) && !self.with_face.contains(&contact) {
            // Searches ask for this often, so that it takes no memory for the other contacts.
            let (mut gap, mut rates) = ([0.0], [0.0; 2]);
            system.of_contacts(ContactQuantity::Gap, &which, place, &mut gap);
            system.of_contacts(ContactQuantity::Rates, &which, place, &mut rates);
            return Clearance {
                value: gap[0],
                rate: rates[0],
                is_rate_of_value: true,
            };
        }
        let mut here = self.memory_for_kinematics();
        if self.is_compliant(contact) {
            here.evaluate(system, place, Some(&which));
            return self.clearance(&here, contact);
        }
        here.evaluate_gaps(system, place, Some(&which));
        here.clearance(contact)
    }

    /// Writes what [`clearances`](Self::clearances) says. `here` is memory for this.
    pub(super) fn write_clearances_with<S: System>(
        &self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        here: &mut ContactKinematics,
        all: &mut Vec<Clearance>,
    ) {
        all.clear();
        let near = self.near_at(t, q.as_slice());
        if self.any_is_compliant() {
            here.evaluate(system, (t, q, v), near);
            all.extend((0..here.gaps.len()).map(|k| self.clearance(here, k)));
            return;
        }
        here.evaluate_gaps(system, (t, q, v), near);
        all.extend((0..here.gaps.len()).map(|k| here.clearance(k)));
    }

    /// Whether any contact yields.
    pub fn any_is_compliant(&self) -> bool {
        self.compliance.iter().any(Option::is_some)
    }

    /// What contacts that yield hold, in J.
    pub fn stored<S: System>(&self, system: &S, t: f64, q: &S::Vector, v: &S::Vector) -> f64 {
        self.stored_by_each(system, t, q, v).iter().sum()
    }

    /// What each contact that yields holds, in J; nothing where none does.
    pub fn stored_by_each<S: System>(
        &self,
        system: &S,
        t: f64,
        q: &S::Vector,
        v: &S::Vector,
    ) -> Vec<f64> {
        if !self.any_is_compliant() || self.is_free() {
            return Vec::new();
        }
        let here = self.kinematics(system, (t, q, v));
        let of_each = (0..self.compliance.len()).map(|k| self.compliant_force(&here, k));
        of_each
            .map(|pressed| pressed.map_or(0.0, |pressed| pressed.stored))
            .collect()
    }

    /// The work that has crushed the layer of a contact so far, in J; 0 where it has none.
    pub(in crate::contact) fn crushing_work(
        &self,
        here: &ContactKinematics,
        contact: usize,
    ) -> f64 {
        let [loading, unloading] = here.restitution(contact);
        match self.compliance[contact] {
            Some(own) if own.law == Compliance::Layer => {
                let depth = if own.is_loaded {
                    own.depth.max(here.depth(contact)[0])
                } else {
                    own.depth
                };
                0.5 * (1.0 - loading / unloading) * loading * depth * depth
            }
            _ => 0.0,
        }
    }

    /// Where energy went in a contact. What a layer takes as it yields is what crushes it.
    pub fn energies(
        &self,
        contact: usize,
        part: ContactShare,
        impact_loss: f64,
        crushing_work: f64,
    ) -> ContactEnergies {
        ContactEnergies {
            impact_loss,
            friction_loss: part.friction,
            damping_loss: if self.is_layer(contact) {
                0.0
            } else {
                part.compliance_loss
            },
            crushing_work,
            work: part.work,
        }
    }

    /// The work that has crushed each layer so far, in J.
    pub fn crushing_works<S: System>(
        &self,
        system: &S,
        place: (f64, &S::Vector, &S::Vector),
    ) -> Vec<f64> {
        let mut works = vec![0.0; self.compliance.len()];
        // No other layer has been pressed yet.
        let is_pressed = |own: &ComplianceState| {
            own.law == Compliance::Layer && (own.is_loaded || own.depth > 0.0)
        };
        let layers = self.compliance.iter().enumerate();
        let pressed: Vec<usize> = layers
            .filter_map(|(k, own)| own.as_ref().is_some_and(is_pressed).then_some(k))
            .collect();
        if pressed.is_empty() {
            return works;
        }
        let mut here = self.memory_for_kinematics();
        let is_single = system.single_contacts().is_some();
        here.evaluate(system, place, is_single.then_some(&*pressed));
        for k in pressed {
            works[k] = self.crushing_work(&here, k);
        }
        works
    }

    /// Whether it goes on being pressed, and being loaded or unloaded as it is, of a contact that yields.
    pub(super) fn margins_of_compliance(
        &self,
        here: &ContactKinematics,
        contact: usize,
    ) -> Option<[Margin; 2]> {
        let own = self.compliance[contact]?;
        let parameters = here.restitution(contact);
        let (depth, rounding) = (here.depth(contact), here.gap_rounding(contact));
        let rate_rounding = here.rate_rounding(2 * contact);
        let of_rate = match own.law {
            Compliance::Linear => parameters[1] / parameters[0] * rate_rounding,
            Compliance::HuntCrossley => depth[0].abs() * parameters[1] * rate_rounding,
            _ => 0.0,
        };
        let presses = Margin {
            value: -own.missing(parameters, depth),
            rounding: rounding + of_rate,
        };
        let loads = match own.law {
            Compliance::Layer if own.is_loaded => Margin {
                value: depth[1],
                rounding: rate_rounding,
            },
            Compliance::Layer => Margin {
                value: own.depth - depth[0],
                rounding,
            },
            _ => Margin::ENDLESS,
        };
        Some([presses, loads])
    }

    /// Layers that are penetrated have been loaded to where they are, those that close now are loaded from where they
    /// were left.
    pub fn load_layers<S: System>(&mut self, system: &S, t: f64, q: &S::Vector, v: &S::Vector) {
        let here = self.kinematics(system, (t, q, v));
        for k in 0..self.compliance.len() {
            let is_closed = self.modes()[k] != Mode::Open;
            let Some(own) = &mut self.compliance[k] else {
                continue;
            };
            let [depth, rate] = here.depth(k);
            let is_at_its_depth = depth >= own.depth - here.gap_rounding(k);
            let recedes = rate < -here.rate_rounding(2 * k);
            if own.law != Compliance::Layer {
                continue;
            }
            if own.is_loaded && (recedes || !is_closed) {
                own.depth = own.depth.max(depth);
                own.is_loaded = false;
            } else if is_closed && is_at_its_depth && !recedes {
                own.is_loaded = true;
            }
        }
    }

    /// A layer is unloaded that was loaded, or the other way round; what it does now.
    pub fn switch_layer<S: System>(
        &mut self,
        system: &S,
        (t, q, v): (f64, &S::Vector, &S::Vector),
        contact: usize,
    ) -> bool {
        let here = self.kinematics(system, (t, q, v));
        let Some(own) = &mut self.compliance[contact] else {
            return false;
        };
        if own.is_loaded {
            own.depth = own.depth.max(here.depth(contact)[0]);
        }
        own.is_loaded = !own.is_loaded;
        own.is_loaded
    }

    /// Which layers are loaded further.
    pub fn loaded(&self) -> impl Iterator<Item = bool> {
        (self.compliance.iter()).map(|own| own.is_some_and(|own| own.is_loaded))
    }
}

impl ContactKinematics {
    /// How far a rigid contact is from closing.
    fn clearance(&self, contact: usize) -> Clearance {
        let rate = match self.on_face(contact) {
            Some(face) if face.beyond > face.height => face.beyond_rate,
            _ => self.rates[2 * contact],
        };
        Clearance {
            value: self.gaps[contact],
            rate,
            is_rate_of_value: true,
        }
    }

    /// How deep a contact is penetrated, and how fast that grows.
    fn depth(&self, contact: usize) -> [f64; 2] {
        [-self.gaps[contact], -self.rates[2 * contact]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ N dd along a path is what is stored and lost, whatever the law: by the trapezoidal rule, whose error is of the
    /// second order in the step.
    #[test]
    fn what_goes_in_is_stored_or_lost() {
        for (law, parameters) in [
            (Compliance::Linear, [300.0, 4.0]),
            (Compliance::Hertz, [500.0, 0.0]),
            (Compliance::HuntCrossley, [500.0, 0.3]),
            (Compliance::Layer, [200.0, 500.0]),
        ] {
            let mut own = ComplianceState::new(law);
            own.is_loaded = law == Compliance::Layer;
            // The depth is d = 0.1 sin t, from 0 to a quarter of a turn.
            let steps = 20_000_u32;
            let at = |i: u32| {
                let t = core::f64::consts::FRAC_PI_2 * f64::from(i) / f64::from(steps);
                own.compliant_force(parameters, [0.1 * t.sin(), 0.1 * t.cos()])
            };
            let by = core::f64::consts::FRAC_PI_2 / f64::from(steps);
            let (mut given, mut lost) = (0.0, 0.0);
            for i in 0..steps {
                let (from, to) = (at(i), at(i + 1));
                let rate = |i: u32| 0.1 * (by * f64::from(i)).cos();
                given += 0.5 * by * (from.force * rate(i) + to.force * rate(i + 1));
                lost += 0.5 * by * (from.lost + to.lost);
            }
            let stored = at(steps).stored - at(0).stored;
            let error = given - stored - lost;
            assert!(error.abs() < 1e-8 * given, "{law:?}: {error:e} of {given}");
        }
    }
}
