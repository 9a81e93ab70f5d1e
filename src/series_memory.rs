//! Memory for the series of a machine, kept from one step to the next.

use core::fmt;

#[cfg(feature = "std")]
use std::{any::Any, boxed::Box};

/// What the series of a machine writes while it is computed: a value of a type of the machine's own, made once. Clearing it in each step would take a
/// twentieth of the step.
#[derive(Default)]
pub struct SeriesMemory {
    #[cfg(feature = "std")]
    lists: Option<Box<dyn Any + Send + Sync>>,
}

impl SeriesMemory {
    /// The value of this type, made if there is none or one of another type; `None` without `std`.
    #[cfg(feature = "std")]
    #[inline(always)]
    pub fn lists<L: Default + Send + Sync + 'static>(&mut self) -> Option<&mut L> {
        if !self.lists.as_ref().is_some_and(|lists| lists.is::<L>()) {
            self.lists = Some(Box::new(L::default()));
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
