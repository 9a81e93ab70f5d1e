//! Events of unilateral contacts, as a run reports them.

use std::string::String;

use crate::State;

/// What happened to a unilateral contact.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactEvent<C> {
    /// The contact.
    pub contact: String,
    /// What happened.
    pub kind: ContactEventKind,
    /// Time, and the state after it.
    pub state: State<C>,
    /// The direction of the slip that begins, 1 or −1; 0 where none does. In space the component of it along the first tangent.
    pub direction: f64,
    /// In space the component of that direction along the second tangent; 0 elsewhere.
    pub across: f64,
    /// A bound on the error of the time, in s, if bounces were ended at the sum of all that remained, and for events that follow within this time; otherwise
    /// 0.
    pub time_error: f64,
    /// What an impact did.
    pub impact: Option<ContactImpact>,
}

/// What happens to unilateral contacts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum ContactEventKind {
    /// It takes part in an impact.
    Impact,
    /// A contact that lasts begins; also where bounces accumulate.
    Closes,
    /// A contact that lasted ends.
    Lifts,
    /// A contact that yields ceases to press.
    Opens,
    /// A layer is unloaded: its depth was greatest.
    Turns,
    /// A layer comes back to its greatest depth, and is crushed further.
    Crushes,
    /// It stops slipping.
    Sticks,
    /// It begins to slip.
    Slips,
    /// Its slip changes direction.
    Reverses,
    /// A guide that slides comes to press to its other side.
    Switches,
}

impl ContactEventKind {
    /// All of them.
    pub const ALL: [ContactEventKind; 10] = [
        Self::Impact,
        Self::Closes,
        Self::Lifts,
        Self::Opens,
        Self::Turns,
        Self::Crushes,
        Self::Sticks,
        Self::Slips,
        Self::Reverses,
        Self::Switches,
    ];

    /// One word for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Impact => "impact",
            Self::Closes => "closes",
            Self::Lifts => "lifts",
            Self::Opens => "opens",
            Self::Turns => "turns",
            Self::Crushes => "crushes",
            Self::Sticks => "sticks",
            Self::Slips => "slips",
            Self::Reverses => "reverses",
            Self::Switches => "switches",
        }
    }
}

/// How often a unilateral contact took part in impacts, and when it closed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactTally {
    /// The number of its impacts.
    pub impacts: usize,
    /// When it closed last, in s.
    pub closed_at: Option<f64>,
    /// By how much this time may be off, in s, as in [`ContactEvent::time_error`].
    pub time_error: f64,
}

/// What an impact did to a contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ContactImpact {
    /// The rate at which the gap opens before and after, in m/s.
    pub gap_rate: [f64; 2],
    /// The slip before and after, in m/s.
    pub slip: [f64; 2],
    /// The impulse along the normal and along the tangent, in N s.
    pub impulse: [f64; 2],
    /// The energy lost in it, in J: `−½ Λ·(γ⁺ + γ⁻)`.
    pub loss: f64,
    /// What it did along the second tangent, in space.
    pub across: Option<ImpactAcross>,
}

/// What an impact in space did to a contact along its second tangent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct ImpactAcross {
    /// The slip before and after, in m/s.
    pub slip: [f64; 2],
    /// The impulse, in N s.
    pub impulse: f64,
}
