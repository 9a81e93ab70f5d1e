//! Unilateral contacts: gaps that stay open or closed, impacts, and Coulomb friction in what is closed.
//!
//! ```text
//! open      g > 0,  λ = 0
//! closed    g = 0,  0 ≤ λₙ ⊥ dγₙ/dt ≥ 0,  −λₜ ∈ μ λₙ Sgn γₜ,  at rest −λₜ ∈ μ₀ λₙ Sgn dγₜ/dt
//! guide     never open, presses with N = N⁺ − N⁻,  0 ≤ N⁺ ⊥ N⁻ ≥ 0,  −λₜ ∈ μ |N| Sgn γₜ
//! impact    M (v⁺ − v⁻) = Σ wₙ Λₙ + Σ wₜ Λₜ + Gᵀ Λ_G,  and a law of impact
//! yielding  g < 0,  λₙ = N(−g, −γₙ) ≥ 0,  friction as above
//! ```
//!
//! A machine says how far its contacts are open, at which rates `γ` they open and slip, and how these depend on
//! the rates of its coordinates ([`System::gaps`](crate::System::gaps) and what follows it). What is closed, what
//! slips and what sticks is a state of the run: between two events it stays as it is, the motion is smooth, and
//! closed contacts are further constraints, kept as those of the machine are. Where a gap closes, a force vanishes,
//! or a slip stops, all closed contacts are asked together, by a linear complementarity problem that is solved by
//! pivoting; in space, where friction has two directions, by one on cones (`contact_law`). (F. Pfeiffer, C. Glocker, *Multibody Dynamics with Unilateral Contacts*, 1996; D. E. Stewart,
//! J. C. Trinkle, Int. J. Numer. Methods Eng. 39 (1996) 2673–2691.)
//!
//! In time stepping contacts are asked once in each step for their impulses, whenever in it they meet (`stepping`).
//!
//! All of it is for runs, which may allocate. What is evaluated in every step does so only once, in memory of its own (`ContactMemory`, and `SteppingMemory`
//! in time stepping), unless contacts share their load in several ways.

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

pub use event::{ContactEvent, ContactEventKind, ContactImpact, ContactTally, ImpactAcross};
pub use force::{UnilateralForce, loads_shared_otherwise, penetrations, unilateral_forces};
pub(crate) use impact::{Bounce, Impact, ParadoxResolution, Told};
pub(crate) use kinematics::ROUNDING;
pub(crate) use nearby::{StateBox, StepEnds};
pub(crate) use stepping::{SteppedContacts, SteppingMemory};
pub use touching::Mode;
pub(crate) use touching::{Clearance, ContactMemory, Margin, Margins, UnilateralState};

use crate::contact_law::{lcp, problem};
use crate::{ContactTrouble, ImpactLaw, ImpactOrder, Painleve};
