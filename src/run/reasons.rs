//! Why a run stops: errors of steps, with the names of the spec and their causes.

use std::string::String;
use std::vec::Vec;

use super::{Model, Run};
use crate::balance::Quadratures;
use crate::constraints::Constraints;
use crate::contact::Mode;
use crate::error::constraint_name;
use crate::inputs::InputLaw;
use crate::step_error::StepError;
use crate::{ContactTrouble, Error, Machine, System, Vector};

/// If the independent part of a constraint is shorter than this when a run stops, it is the cause: round-off in the residuals of positions
/// is amplified in the rates by its inverse square, which costs ten digits here.
const NEAR_FORK: f64 = 1e-2;

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// The error of a run that stops because the gap of a closed contact hardly depends on the coordinates any more: the force that holds
    /// it shut grows without bound, and steps shrink.
    pub(super) fn vanishing_gradient_error(&self, error: &StepError) -> Option<StepError> {
        let StepError::StepTooSmall { t, .. } = *error else {
            return None;
        };
        self.contact_with_small_gradient(NEAR_FORK, |_| true)
            .map(|contact| StepError::Contact {
                contact,
                trouble: ContactTrouble::NotHeld,
                t,
            })
    }

    /// The first closed contact among those that `counts` selects whose gap has a gradient of less than `share` times its length
    /// at the start.
    pub(super) fn contact_with_small_gradient(
        &self,
        share: f64,
        counts: impl Fn(usize) -> bool,
    ) -> Option<usize> {
        let (touching, system) = (self.stepper.touching().as_ref()?, self.model.system);
        let is_closed = |contact: &usize| touching.modes()[*contact] != Mode::Open;
        let closed = (0..touching.modes().len()).filter(|k| counts(*k) && is_closed(k));
        let mut closed = closed.peekable();
        closed.peek()?;
        let (begun, start) = self.model.start;
        let n = start.as_slice().len();
        let rows = |t, q| {
            let mut rows = std::vec![0.0; 2 * touching.modes().len() * n];
            system.contact_matrix(t, q, &mut rows);
            rows
        };
        let (before, now) = (rows(begun, start), rows(self.stepper.t(), self.stepper.q()));
        let length = |rows: &[f64], contact: usize| {
            let row = &rows[2 * contact * n..][..n];
            row.iter().map(|w| w * w).sum::<f64>().sqrt()
        };
        closed.find(|contact| length(&now, *contact) < share * length(&before, *contact))
    }
}

impl<S: System, L: InputLaw<S>> Model<'_, S, L> {
    /// Converts the error of a step; `q` and `v` are the state at its beginning.
    pub(super) fn explain(&self, error: StepError, q: &S::Vector, v: &S::Vector) -> Error {
        if let StepError::NotFinite { t, .. } = error {
            let inputs = self.inputs(t, q, v);
            let mut values = self.system.input_values(&inputs);
            if let Some((input, value)) = values.find(|(_, value)| !value.is_finite()) {
                return Error::InputNotFinite {
                    input: input.name.into(),
                    value,
                    t,
                };
            }
        }
        match self.fork(&error, q, v) {
            Some(fork) => fork,
            None => contradiction(error, self.system, q, v),
        }
    }

    /// The error of a run that stops because constraints become linearly dependent.
    fn fork(&self, error: &StepError, q: &S::Vector, v: &S::Vector) -> Option<Error> {
        let (StepError::StepTooSmall { t, .. }
        | StepError::Inconsistent { t, .. }
        | StepError::Singular { t, .. }) = *error
        else {
            return None;
        };
        if !S::MAY_BE_CONSTRAINED {
            return None;
        }
        let mut known = Constraints::new(self.system, q, v);
        let weakest = known.weakest(self.system, self.start, (t, q)).ok()??;
        let (row, left) = weakest;
        (left < NEAR_FORK).then(|| Error::Fork {
            constraint: constraint_name(self.system, row),
            left,
            t,
        })
    }
}

/// The constraints that were not chosen at a state, by name, each with those that it depends on.
pub(super) fn dependences<S: System>(
    known: &Constraints<S::Vector>,
    system: &S,
    t: f64,
    q: &S::Vector,
) -> Vec<(String, Vec<String>)> {
    let names = |index: &usize| constraint_name(system, *index);
    let dependences = known.dependences(system, t, q).unwrap_or_default();
    let named = |(row, on): (usize, Vec<usize>)| (names(&row), on.iter().map(names).collect());
    dependences.into_iter().map(named).collect()
}

/// The error of a step; if constraints contradict each other, with their names.
pub(super) fn contradiction<S: System>(
    error: StepError,
    system: &S,
    q: &S::Vector,
    v: &S::Vector,
) -> Error {
    let mut error_of_run = Error::of_step(error, system);
    if let Error::FrictionParadox {
        q: at, v: rates, ..
    }
    | Error::Contact {
        q: at, v: rates, ..
    } = &mut error_of_run
    {
        (*at, *rates) = (q.as_slice().to_vec(), v.as_slice().to_vec());
    }
    if S::MAY_BE_CONSTRAINED
        && let Error::InconsistentConstraints {
            constraint,
            with,
            t,
            ..
        } = &mut error_of_run
    {
        let mut known = Constraints::new(system, q, v);
        if known.choose_again(system, *t, q).is_ok() {
            let on = dependences(&known, system, *t, q);
            let own = on.into_iter().find(|(name, _)| name == constraint);
            *with = own.map_or_else(Vec::new, |(_, on)| on);
        }
    }
    error_of_run
}
