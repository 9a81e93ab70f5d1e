//! Room that evaluations write to, in systems that threads may share.

use core::fmt::{self, Debug};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Something that a call writes to, of one thread at a time. Whatever it holds is written before it is read, so what a thread
/// that panicked has left there does no harm.
#[derive(Default)]
pub(crate) struct Room<T>(Mutex<T>);

impl<T> Room<T> {
    pub fn new(value: T) -> Self {
        Self(Mutex::new(value))
    }

    /// Waits until no other thread uses it.
    #[inline]
    pub fn enter(&self) -> MutexGuard<'_, T> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T: Clone> Clone for Room<T> {
    fn clone(&self) -> Self {
        Self::new(self.enter().clone())
    }
}

impl<T: Debug> Debug for Room<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.enter().fmt(f)
    }
}
