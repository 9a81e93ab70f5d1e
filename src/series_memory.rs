//! Memory for the series of a machine, kept from one step to the next.

use core::fmt;

#[cfg(feature = "std")]
use std::{any::Any, boxed::Box, cell::Cell, thread_local};

#[cfg(feature = "std")]
type Lists = Box<dyn Any + Send + Sync>;

#[cfg(feature = "std")]
thread_local! {
    /// What the last run of this thread has left, for the next one: to allocate and clear it takes as long as a step of a small machine.
    static LEFT: Cell<Option<Lists>> = const { Cell::new(None) };
}

/// What the series of a machine writes while it is computed: a value of a type of the machine's own, made once. Clearing it in each step would take a
/// twentieth of the step. What it holds before does not matter, so that it may be of another run.
#[derive(Default)]
pub struct SeriesMemory {
    #[cfg(feature = "std")]
    lists: Option<Lists>,
}

impl SeriesMemory {
    /// The value of this type, made if there is none or one of another type; `None` without `std`.
    #[cfg(feature = "std")]
    #[inline(always)]
    pub fn lists<L: Default + Send + Sync + 'static>(&mut self) -> Option<&mut L> {
        if !self.lists.as_ref().is_some_and(|lists| lists.is::<L>()) {
            self.lists = Some(left::<L>().unwrap_or_else(|| Box::new(L::default())));
        }
        self.lists.as_mut()?.downcast_mut()
    }

    /// The value of this type, made if there is none or one of another type; `None` without `std`.
    #[cfg(not(feature = "std"))]
    #[inline(always)]
    pub fn lists<L: Default + Send + Sync + 'static>(&mut self) -> Option<&mut L> {
        None
    }
}

/// What an earlier run of this thread has left, if it is of this type.
#[cfg(feature = "std")]
#[cold]
fn left<L: 'static>() -> Option<Lists> {
    let left = LEFT.try_with(Cell::take).ok().flatten();
    left.filter(|lists| lists.is::<L>())
}

#[cfg(feature = "std")]
impl Drop for SeriesMemory {
    fn drop(&mut self) {
        if let Some(lists) = self.lists.take() {
            // Where the thread ends, there is no next run.
            let _ = LEFT.try_with(|left| left.set(Some(lists)));
        }
    }
}

/// What is in it does not matter, so a clone has nothing yet.
impl Clone for SeriesMemory {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl fmt::Debug for SeriesMemory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("SeriesMemory")
    }
}
