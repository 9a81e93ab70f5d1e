//! The Taylor series of a machine's motion while unilateral contacts are closed: derived when a contact of a run by series closes first, and from then on taken
//! for each set of closed contacts out of the rows of all.

use core::fmt;
use std::boxed::Box;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::vec::Vec;

use lagrangian_mechanics::series::ProvedContactSeries;
use lagrangian_program::Singular;
use lagrangian_program::series::{ContactSeries, ContactState, NoSeries};

use super::engine::MachineCode;
use super::expanding::Expanding;
use super::motion_series::Known;
use crate::ContactMode;

/// The most sets of closed contacts whose series a machine keeps. In others a run goes on without series.
const MOST_SETS: usize = 64;

/// The most of them that a system keeps ready to be expanded.
const MOST_READY: usize = 8;

/// Derives the series, in any thread.
type Derive = dyn Fn() -> Result<ProvedContactSeries, NoSeries> + Send + Sync;

/// The series of a machine while contacts are closed, shared by its clones and by their systems.
#[derive(Clone, Default)]
pub(super) struct ClosedSeries(Option<Arc<Shared>>);

/// What contacts do, and the series of the motion then, if there is one.
type Set = (Vec<ContactState>, Option<Arc<Known>>);

struct Shared {
    derive: Box<Derive>,
    /// The rows of all contacts; `None` if there are none.
    known: OnceLock<Option<Arc<ContactSeries>>>,
    sets: Mutex<Vec<Set>>,
}

impl ClosedSeries {
    /// The one that `derive` returns.
    pub(super) fn on_demand(derive: Box<Derive>) -> ClosedSeries {
        ClosedSeries(Some(Arc::new(Shared {
            derive,
            known: OnceLock::new(),
            sets: Mutex::default(),
        })))
    }

    /// The series while contacts do this, if there is one.
    fn of(&self, states: &[ContactState]) -> Option<Arc<Known>> {
        let shared = self.0.as_ref()?;
        let derived = || (shared.derive)().ok().map(|proved| (*proved).clone());
        let all = shared.known.get_or_init(derived).as_ref()?;
        let mut sets = shared.sets.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, known)) = sets.iter().find(|(set, _)| set == states) {
            return known.clone();
        }
        if sets.len() == MOST_SETS {
            return None;
        }
        let series = all.with(states);
        let known = series.map(|series| Arc::new(Known::of(Ok(Arc::new(series)))));
        sets.push((states.to_vec(), known.clone()));
        known
    }
}

impl fmt::Debug for ClosedSeries {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match &self.0 {
            None => "none",
            Some(shared) if shared.known.get().is_none() => "not derived yet",
            Some(_) => "derived",
        })
    }
}

/// The series of the sets of closed contacts that a system came to last, with the memory of their expansions.
#[derive(Clone, Debug)]
pub(super) struct ExpandingClosed {
    series: ClosedSeries,
    engine: MachineCode,
    ready: Vec<Ready>,
    /// Memory for the states of contacts.
    states: Vec<ContactState>,
}

/// The series of a set of closed contacts.
#[derive(Clone, Debug)]
struct Ready {
    states: Vec<ContactState>,
    known: Arc<Known>,
    expanding: Expanding,
}

impl ExpandingClosed {
    pub(super) fn new(series: ClosedSeries, engine: MachineCode) -> ExpandingClosed {
        ExpandingClosed {
            series,
            engine,
            ready: Vec::new(),
            states: Vec::new(),
        }
    }

    /// The series while contacts do this, if there is one.
    fn find(&mut self, (contacts, dependent): (&[ContactMode], &[usize])) -> Option<&mut Ready> {
        self.series.0.as_ref()?;
        self.states.clear();
        for (k, contact) in contacts.iter().enumerate() {
            let follows = [2 * k, 2 * k + 1].map(|direction| dependent.contains(&direction));
            self.states.push(state(*contact, follows)?);
        }
        let states = &self.states;
        if let Some(place) = self.ready.iter().position(|of| of.states == *states) {
            return self.ready.get_mut(place);
        }
        let known = self.series.of(states)?;
        if self.ready.len() == MOST_READY {
            self.ready.remove(0);
        }
        self.ready.push(Ready {
            states: states.clone(),
            known,
            expanding: Expanding::new(self.engine.clone()),
        });
        self.ready.last_mut()
    }

    /// Expands the motion while contacts do this through a state, as [`Expanding::expand`]; `None` if there is no series then.
    pub(super) fn expand(
        &mut self,
        contacts: (&[ContactMode], &[usize]),
        parameters: impl FnOnce() -> Vec<f64>,
        at: ([f64; 2], [&[f64]; 3]),
        coefficients: &mut [Vec<f64>],
    ) -> Option<Result<(), Singular>> {
        let Ready {
            known, expanding, ..
        } = self.find(contacts)?;
        Some(expanding.expand((known, parameters), at, coefficients))
    }
}

/// What a contact does of which the gap and the slip may follow from those of others; `None` if it slips in space, or slips with a normal force that other contacts share.
fn state(contact: ContactMode, follows: [bool; 2]) -> Option<ContactState> {
    Some(match (contact, follows) {
        (ContactMode::SlidesAlong(_), _) => return None,
        (ContactMode::Slides(sign), [true, _]) if sign != 0.0 => return None,
        // Nothing of it is left: a force that is 0, and conditions that others meet.
        (ContactMode::Open, _) | (ContactMode::Slides(_), [true, _]) => ContactState::Open,
        (ContactMode::Slides(sign), [false, _]) => ContactState::Slips(sign as i8),
        (ContactMode::Sticks, [false, false]) => ContactState::Sticks,
        (ContactMode::Sticks, [false, true]) => ContactState::SticksAlongNormal,
        (ContactMode::Sticks, [true, false]) => ContactState::SticksAlongTangent,
        (ContactMode::Sticks, [true, true]) => ContactState::Open,
    })
}
