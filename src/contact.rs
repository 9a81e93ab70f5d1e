//! Unilateral contacts: open and closed gaps, impacts, and Coulomb friction of closed contacts.
//!
//! ```text
//! open      g > 0,  λ = 0
//! closed    g = 0,  0 ≤ λₙ ⊥ dγₙ/dt ≥ 0,  −λₜ ∈ μ λₙ Sgn γₜ,  at rest −λₜ ∈ μ₀ λₙ Sgn dγₜ/dt
//! guide     never open, presses with N = N⁺ − N⁻,  0 ≤ N⁺ ⊥ N⁻ ≥ 0,  −λₜ ∈ μ |N| Sgn γₜ
//! impact    M (v⁺ − v⁻) = Σ wₙ Λₙ + Σ wₜ Λₜ + Gᵀ Λ_G,  and a law of impact
//! compliant g < 0,  λₙ = N(−g, −γₙ) ≥ 0,  friction as above
//! ```
//!
//! A machine provides the gaps of its contacts, the rates `γ` at which they open and slip, and the dependence of these on
//! the rates of its coordinates ([`System::gaps`](crate::System::gaps) and the methods after it). Which contacts are closed,
//! slip and stick is a state of the run. Between two events this state is constant, the motion is smooth, and
//! closed contacts are additional constraints, which are kept like those of the machine. Where a gap closes, a force vanishes,
//! or a slip stops, the new state of all closed contacts follows from one linear complementarity problem, which is solved by
//! pivoting, or in space, where friction has two directions, from one on cones (`contact_law`). (F. Pfeiffer, C. Glocker, *Multibody Dynamics with Unilateral Contacts*, 1996; D. E. Stewart,
//! J. C. Trinkle, Int. J. Numer. Methods Eng. 39 (1996) 2673–2691.)
//!
//! In time stepping the impulses of all contacts are solved for once in each step, wherever in the step they meet (`stepping`).
//!
//! This module is for runs, which may allocate. Code that runs in every step allocates only the first time, in memory that is kept (`ContactMemory`, and
//! `SteppingMemory` in time stepping), unless contacts share their load in several ways.

/// Writes [`Clone`] for a struct whose fields are all named here. In time stepping states are cloned in each step, into memory that is there.
macro_rules! clone_into_memory {
    ($name:ident { $($field:ident),* $(,)? }) => {
        impl Clone for $name {
            fn clone(&self) -> Self {
                Self { $($field: self.$field.clone()),* }
            }

            fn clone_from(&mut self, from: &Self) {
                $(self.$field.clone_from(&from.$field);)*
            }
        }
    };
}

mod delassus;
mod drives;
mod event;
mod force;
mod guides;
mod impact;
mod jam;
mod kinematics;
mod nearby;
mod routh;
mod stepping;
mod touching;
mod undetermined;

pub use crate::unilateral::ContactMode as Mode;
pub use event::{ContactEvent, ContactEventKind, ContactImpact, ContactTally, ImpactAcross};
pub use force::{UnilateralForce, loads_shared_otherwise, penetrations, unilateral_forces};
pub(crate) use impact::{Bounce, Impact, ParadoxResolution, Told};
pub(crate) use kinematics::ROUNDING;
pub(crate) use nearby::{StateBox, StepEnds};
pub(crate) use stepping::{SteppedContacts, SteppingMemory};
pub(crate) use touching::{Clearance, ContactMemory, Margin, Margins, UnilateralState};

use crate::contact_law::{lcp, problem};
use crate::{ContactTrouble, ImpactLaw, ImpactOrder, Painleve};
