//! Functions that a simulation was given, and what becomes of them where it is copied.
//!
//! What steers a run (events, conditions, sampled controllers) is copied with it, so that each run has its own. What only looks
//! (observers, progress) is shared by the copies.

use std::boxed::Box;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::{Coordinates, Error, Inputs, Machine, Observation, State};

/// Everything about a machine in a state, if it is asked for.
pub(crate) type Observe<'x, M> = &'x dyn Fn() -> Result<Observation<M>, Error>;

/// Functions of one kind that can be copied.
macro_rules! copied {
    ($(#[$docs:meta])* $name:ident, $function:path) => {
        $(#[$docs])*
        pub(crate) trait $name<'a, M: Machine>: $function + Send {
            /// A copy of the function, with a state of its own.
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
    /// A function that is watched: of a state, and of what can be observed in it.
    Watched, FnMut(&State<Coordinates<M>>, Observe<'_, M>) -> Result<f64, Error>
}

copied! {
    /// A condition on the state.
    Condition, FnMut(&State<Coordinates<M>>) -> bool
}

copied! {
    /// What looks at a state and sets inputs.
    Controller, FnMut(&State<Coordinates<M>>, &mut Inputs<M>)
}

/// A function that copies share.
pub(crate) struct Shared<F: ?Sized>(Arc<Mutex<Box<F>>>);

impl<F: ?Sized> Shared<F> {
    pub fn new(function: Box<F>) -> Self {
        Self(Arc::new(Mutex::new(function)))
    }

    /// The function, for a call. One that has panicked before is called again like any other.
    pub fn lock(&self) -> MutexGuard<'_, Box<F>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<F: ?Sized> Clone for Shared<F> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}
