//! Workspaces of evaluations within systems that threads may share.

use core::fmt::{self, Debug};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A workspace that one thread uses at a time. Its contents are written before they are read, so it stays usable after a
/// thread has panicked with it.
#[derive(Default)]
pub(crate) struct SharedWorkspace<T>(Mutex<T>);

impl<T> SharedWorkspace<T> {
    pub fn new(value: T) -> Self {
        Self(Mutex::new(value))
    }

    /// Waits until no other thread uses the workspace.
    #[inline]
    pub fn lock(&self) -> MutexGuard<'_, T> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T: Clone> Clone for SharedWorkspace<T> {
    fn clone(&self) -> Self {
        Self::new(self.lock().clone())
    }
}

impl<T: Debug> Debug for SharedWorkspace<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.lock().fmt(f)
    }
}
