//! Unilateral contacts at equilibria and in linear models.
//!
//! A contact with `compliance` presses where its gap is negative, with the force of its law, which is part of f. A rigid contact counts as
//! open: where it is closed there is no linear model, because the effect of a force depends on its direction. Where contacts
//! are open by a margin, the model is that of the machine without them; where compliant contacts are closed by a margin, it
//! includes their stiffness and damping.

use lagrangian::{Compliance, System};
use lagrangian_program::Role;
use lagrangian_scalar::{Dual, Scalar};

use super::{Number, Reduced, ReducedState, constants};

/// A contact is at its boundary if a displacement by this much may open or close it, in rad, m, or relative to the coordinate: the
/// greater of the two distances at which the equations are searched for corners.
const NEAR: f64 = 1e-10;

/// A unilateral contact.
#[derive(Clone, Debug)]
pub(super) struct Contact {
    name: String,
    compliance: Option<Compliance>,
    has_friction: bool,
    resists_rolling: bool,
    is_second_tangent: bool,
}

impl Contact {
    /// Whether it only adds a direction to the contact before it.
    fn is_part(&self) -> bool {
        self.resists_rolling || self.is_second_tangent
    }
}

/// Why there is no linear model because of a contact.
#[derive(Clone, Debug, PartialEq)]
pub enum ContactFault {
    /// It is rigid and closed.
    Rigid,
    /// It is rigid and penetrated by this depth, in m.
    Penetrated(f64),
    /// It is about to close or to open.
    Boundary,
    /// It is a layer, and pressed: what it does next depends on the direction of the motion.
    Layer,
    /// It presses and has friction, and does not slip.
    Friction,
    /// Its gap changes along the steady motion, so that it may close or open.
    Moves,
}

impl ContactFault {
    /// The reason in one sentence; `start` is the option that sets another state.
    pub fn in_words(&self, contact: &str, start: &str) -> String {
        match self {
            ContactFault::Rigid => format!(
                "the rigid contact `{contact}` is closed there, and a closed contact gives way to one side only, so that there is no linearization; \
                 {start} sets another state, or `compliance` in place of `restitution` gives the contact a stiffness"
            ),
            ContactFault::Penetrated(depth) => format!(
                "the rigid contact `{contact}`, which counts as open, would be penetrated by {depth:.3e} m there; {start} sets another state, or \
                 `compliance` in place of `restitution` gives the contact a stiffness"
            ),
            ContactFault::Boundary => format!(
                "the contact `{contact}` is about to close or to open there, where its stiffness changes, so that there is no linearization; \
                 {start} sets another state"
            ),
            ContactFault::Layer => format!(
                "the layer of the contact `{contact}` is pressed there, and its stiffness depends on whether it is pressed further or released, so that \
                 there is no linearization; {start} sets another state, or `compliance: linear` gives the contact one stiffness"
            ),
            ContactFault::Friction => format!(
                "the contact `{contact}` presses and does not slip there: friction can hold the machine anywhere within a range, and has no \
                 linearization at rest; use a variant without `friction`, or choose another state with {start}"
            ),
            ContactFault::Moves => format!(
                "the gap of the contact `{contact}` changes along the steady motion, so that it may close or open; leave the contact out, or \
                 choose another motion with {start}"
            ),
        }
    }
}

impl Reduced<'_> {
    /// Adds the forces of contacts that yield to f, and lets gaps count as terms of the equations.
    pub(crate) fn with_contacts(mut self, states: &[(Vec<f64>, Vec<f64>)]) -> Self {
        let contacts = self.system.unilateral_contacts().map(|contact| Contact {
            name: contact.name.to_owned(),
            compliance: contact.compliance,
            has_friction: contact.has_friction,
            resists_rolling: contact.is_rolling_resistance,
            is_second_tangent: contact.is_second_tangent,
        });
        self.contacts = contacts.collect();
        if !self.contacts.is_empty() {
            for j in 0..self.idle.len() {
                self.idle[j] &= states.iter().all(|(q, v)| !self.moves_gaps(j, q, v));
            }
        }
        self
    }

    /// Whether gaps depend on a coordinate.
    fn moves_gaps(&mut self, j: usize, q: &[f64], v: &[f64]) -> bool {
        let (mut q, v) = (constants(q), constants(v));
        q[j] = Dual {
            value: q[j].value,
            derivative: lagrangian_scalar::DoubleDouble::ONE,
        };
        let gaps = self.call(Role::Gaps, (&q, &v), self.contacts.len(), self.time);
        gaps.iter().any(|gap| gap.derivative.hi() != 0.0)
    }

    /// The gaps at a state, and the rates at which they open and slip, two for each contact; empty without contacts.
    pub(crate) fn gaps_and_rates(&mut self, q: &[Number], v: &[Number], t: f64) -> Vec<Number> {
        let contacts = self.contacts.len();
        if contacts == 0 {
            return Vec::new();
        }
        let mut all = self.call(Role::Gaps, (q, v), contacts, t);
        all.extend(self.call(Role::ContactRates, (q, v), 2 * contacts, t));
        all
    }

    /// Adds the forces of contacts that yield to the generalized forces at a state. Friction of contacts that do not slip is left out.
    pub(super) fn add_contact_forces(
        &mut self,
        (q, v): (&[Number], &[Number]),
        t: f64,
        forces: &mut [Number],
    ) {
        let (n, count) = (q.len(), self.contacts.len());
        if self.contacts.iter().all(|of| of.compliance.is_none()) {
            return;
        }
        let gaps = self.call(Role::Gaps, (q, v), count, t);
        let presses = |k: &usize| {
            let contact = &self.contacts[*k];
            !contact.is_part() && contact.compliance.is_some() && gaps[*k].value.hi() < 0.0
        };
        let pressed: Vec<usize> = (0..count).filter(presses).collect();
        if pressed.is_empty() {
            return;
        }
        let rates = self.call(Role::ContactRates, (q, v), 2 * count, t);
        let rows = self.call(Role::ContactMatrix, (q, v), 2 * count * n, t);
        let coefficients = self.call(Role::ContactCoefficients, (q, v), 4 * count, t);
        let mut push = |force: Number, direction: usize| {
            for (to, w) in forces.iter_mut().zip(&rows[direction * n..][..n]) {
                *to = *to + force * *w;
            }
        };
        for k in pressed {
            let Some(law) = self.contacts[k].compliance else {
                continue;
            };
            let (depth, rate) = (-gaps[k], -rates[2 * k]);
            let (first, second) = (coefficients[4 * k], coefficients[4 * k + 1]);
            let normal = match law {
                Compliance::Linear => first * depth + second * rate,
                Compliance::Hertz => first * depth * depth.sqrt(),
                Compliance::HuntCrossley => {
                    first * depth * depth.sqrt() * (Number::ONE + second * rate)
                }
                // In first loading; where it presses there is no linear model.
                Compliance::Layer => first * depth,
            };
            // It never pulls.
            if normal.value.hi() <= 0.0 {
                continue;
            }
            push(normal, 2 * k);
            for (slips, friction) in self.slipping(k) {
                let slips: Vec<(usize, Number)> = slips
                    .into_iter()
                    .map(|direction| (direction, rates[direction]))
                    .collect();
                let square = slips.iter().fold(Number::ZERO, |sum, (_, s)| sum + *s * *s);
                if square.value.hi() <= 0.0 {
                    continue;
                }
                let share = -(coefficients[friction] * normal) / square.sqrt();
                for (direction, slip) in slips {
                    push(share * slip, direction);
                }
            }
        }
    }

    /// The friction of a contact: the directions that slip together, and the index of their coefficient.
    fn slipping(&self, k: usize) -> Vec<(Vec<usize>, usize)> {
        let mut all = Vec::new();
        let next = self.contacts.get(k + 1);
        if self.contacts[k].has_friction {
            let mut directions = vec![2 * k + 1];
            if next.is_some_and(|next| next.is_second_tangent) {
                directions.push(2 * k + 3);
            }
            all.push((directions, 4 * k + 2));
        }
        if next.is_some_and(|next| next.resists_rolling) {
            all.push((vec![2 * k + 3], 4 * k + 6));
        }
        all
    }

    /// The shortest time after which displacements at these rates close a contact that yields and is open, to first order.
    pub(crate) fn closes_after(&mut self, place: &ReducedState, rates: &[f64]) -> Option<f64> {
        let count = self.contacts.len();
        let yields = |k: &usize| self.contacts[*k].compliance.is_some();
        let candidates: Vec<usize> = (0..count).filter(yields).collect();
        if candidates.is_empty() {
            return None;
        }
        let q: Vec<Number> = (place.q.iter().zip(rates))
            .map(|(q, rate)| Dual {
                value: *q,
                derivative: (*rate).into(),
            })
            .collect();
        let still = vec![Number::ZERO; q.len()];
        let gaps = self.call(Role::Gaps, (&q, &still), count, self.time);
        let after = candidates.into_iter().filter_map(|k| {
            let (gap, rate) = (gaps[k].value.hi(), gaps[k].derivative.hi());
            let after = -gap / rate;
            (gap > 0.0 && rate < 0.0 && after.is_finite()).then_some(after)
        });
        after.min_by(f64::total_cmp)
    }

    /// The first contact that prevents a linear model at a state, with the reason.
    pub(crate) fn barred_by(
        &mut self,
        q: &[Number],
        v: &[Number],
    ) -> Option<(usize, ContactFault)> {
        let (n, count, t) = (q.len(), self.contacts.len(), self.time);
        if count == 0 {
            return None;
        }
        let gaps = self.call(Role::Gaps, (q, v), count, t);
        let rates = self.call(Role::ContactRates, (q, v), 2 * count, t);
        let rows = self.call(Role::ContactMatrix, (q, v), 2 * count * n, t);
        let coefficients = self.call(Role::ContactCoefficients, (q, v), 4 * count, t);
        let value = |x: &Number| x.value.hi();
        let margin = |direction: usize, of: &[Number], least: f64| -> f64 {
            let row = &rows[direction * n..][..n];
            let terms = row.iter().zip(of);
            NEAR * terms
                .map(|(w, x)| (value(w) * value(x).abs().max(least)).abs())
                .sum::<f64>()
        };
        (0..count).find_map(|k| {
            let contact = &self.contacts[k];
            if contact.is_part() {
                return None;
            }
            let (gap, margin_of_gap) = (value(&gaps[k]), margin(2 * k, q, 1.0));
            let is_near = gap.abs() <= margin_of_gap;
            let fault = match contact.compliance {
                _ if gap.is_nan() => ContactFault::Boundary,
                _ if gap > margin_of_gap => return None,
                None if is_near => ContactFault::Rigid,
                None => ContactFault::Penetrated(-gap),
                Some(_) if is_near => ContactFault::Boundary,
                Some(Compliance::Layer) => ContactFault::Layer,
                Some(_) => {
                    let holds = |(slips, friction): (Vec<usize>, usize)| {
                        value(&coefficients[friction]) != 0.0
                            && (slips.iter()).all(|&d| value(&rates[d]).abs() <= margin(d, v, 0.0))
                    };
                    if !self.slipping(k).into_iter().any(holds) {
                        return None;
                    }
                    ContactFault::Friction
                }
            };
            Some((k, fault))
        })
    }

    /// The first open contact whose gap changes at these rates.
    pub(crate) fn moving_gap(&mut self, q: &[Number], v: &[Number]) -> Option<usize> {
        let (n, count, t) = (q.len(), self.contacts.len(), self.time);
        if count == 0 {
            return None;
        }
        let gaps = self.call(Role::Gaps, (q, v), count, t);
        let rates = self.call(Role::ContactRates, (q, v), 2 * count, t);
        let rows = self.call(Role::ContactMatrix, (q, v), 2 * count * n, t);
        let value = |x: &Number| x.value.hi();
        (0..count).find(|&k| {
            let row = &rows[2 * k * n..][..n];
            let terms = row.iter().zip(v);
            let size: f64 = terms.map(|(w, v)| (value(w) * value(v)).abs()).sum();
            value(&gaps[k]) > 0.0 && value(&rates[2 * k]).abs() > NEAR * size
        })
    }

    /// The name of a contact.
    pub(crate) fn contact_name(&self, contact: usize) -> String {
        self.contacts[contact].name.clone()
    }
}
