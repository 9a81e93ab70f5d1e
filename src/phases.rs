//! What unilateral contacts did in a run, from one change to the next.

use std::vec::Vec;

use crate::constraints::Constraints;
use crate::contact::Touching;
use crate::{ContactEvent, System, Warning};

/// What contacts did from some instant on.
#[derive(Clone, Debug)]
pub(crate) struct Phase<V> {
    pub since: f64,
    pub touching: Touching,
    /// What is known of what they hold.
    pub constraints: Option<Constraints<V>>,
}

/// What a run keeps of its contacts.
#[derive(Clone, Debug)]
pub(crate) struct Kept<C, V> {
    pub phases: Vec<Phase<V>>,
    pub events: Vec<ContactEvent<C>>,
    /// For each contact how much energy its impacts took, in J.
    pub losses: Vec<f64>,
    /// In time stepping, for each contact whether it is closed and lasts.
    pub last: Vec<bool>,
    /// Impacts that created energy: how many, and the worst.
    pub gains: usize,
    pub worst: Option<(usize, f64, f64)>,
}

impl<C, V> Default for Kept<C, V> {
    fn default() -> Self {
        Kept {
            phases: Vec::new(),
            events: Vec::new(),
            losses: Vec::new(),
            last: Vec::new(),
            gains: 0,
            worst: None,
        }
    }
}

impl<C, V> Kept<C, V> {
    /// What the user should know.
    pub fn warning<S: System>(&self, system: &S) -> Option<Warning> {
        let (contact, t, gain) = self.worst?;
        let mut contacts = system.unilateral_contacts();
        Some(Warning::ImpactGains {
            contact: contacts.nth(contact).map_or("?", |of| of.name).into(),
            t,
            gain,
            impacts: self.gains,
        })
    }
}
