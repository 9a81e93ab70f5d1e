//! What closed contacts do, and impacts: for runs, which may allocate.

mod compliant;
mod delassus;
mod event;
mod force;
mod held;
mod impact;
mod lcp;
mod problem;
mod routh;
mod touching;

pub use event::{ContactEvent, ContactEventKind, ContactImpact};
pub use force::{UnilateralForce, unilateral_forces};
use held::Held;
pub(crate) use impact::{Impact, Jam};
pub(crate) use touching::{Mode, Touching};

use super::{Compliance, ContactTrouble, ImpactLaw, ImpactOrder, Painleve, UnilateralContact};
