//! The functions of a simulation, and their treatment when it is cloned.
//!
//! Functions that act on a run (events, conditions, sampled controllers) are cloned with it, so that each run has its own.
//! Functions that only watch (observers, progress) are shared by the clones.

use std::boxed::Box;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::{Coordinates, Error, Inputs, Machine, Observation, State};

/// Evaluates everything that can be observed of a machine in a state, on demand.
pub(crate) type Observe<'x, M> = &'x dyn Fn() -> Result<Observation<M>, Error>;

/// Declares a trait of functions that can be cloned.
macro_rules! copied {
    ($(#[$docs:meta])* $name:ident, $function:path) => {
        $(#[$docs])*
        pub(crate) trait $name<'a, M: Machine>: $function + Send {
            /// A copy of the function with its own state.
            fn copy(&self) -> Box<dyn $name<'a, M> + 'a>;
        }

        impl<'a, M: Machine, F: $function + Clone + Send + 'a> $name<'a, M> for F {
            fn copy(&self) -> Box<dyn $name<'a, M> + 'a> {
                Box::new(self.clone())
            }
        }

        impl<'a, M: Machine> Clone for Box<dyn $name<'a, M> + 'a> {
            fn clone(&self) -> Self {
                (**self).copy()
            }
        }
    };
}

copied! {
    /// A function that is watched, of a state and its observation.
    Watched, FnMut(&State<Coordinates<M>>, Observe<'_, M>) -> Result<f64, Error>
}

copied! {
    /// A condition on the state.
    Condition, FnMut(&State<Coordinates<M>>) -> bool
}

copied! {
    /// A function that reads a state and sets inputs.
    Controller, FnMut(&State<Coordinates<M>>, &mut Inputs<M>)
}

/// A function that clones share.
pub(crate) struct Shared<F: ?Sized>(Arc<Mutex<Box<F>>>);

impl<F: ?Sized> Shared<F> {
    pub fn new(function: Box<F>) -> Self {
        Self(Arc::new(Mutex::new(function)))
    }

    /// Locks the function for a call. If it has panicked before, it is called again like any other.
    pub fn lock(&self) -> MutexGuard<'_, Box<F>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<F: ?Sized> Clone for Shared<F> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}
