//! Numbers for each contact of a machine, as many as it has.

use core::ops::{Deref, DerefMut};
#[cfg(feature = "std")]
use std::vec::Vec;

/// The number of contacts up to which their numbers need no allocator: the most guided contacts of a machine without one.
pub(crate) const FEW_CONTACTS: usize = 6;

/// One value for each contact.
pub(crate) type PerContact<T> = Values<T, FEW_CONTACTS>;

/// A fixed number of values, which need no allocator if there are at most `FEW`.
#[derive(Clone, Debug)]
pub(crate) struct Values<T, const FEW: usize> {
    count: usize,
    few: [T; FEW],
    #[cfg(feature = "std")]
    many: Vec<T>,
}

impl<T: Copy, const FEW: usize> Values<T, FEW> {
    /// So many times the same value. Without an allocator there are at most `FEW`.
    pub fn new(count: usize, value: T) -> Self {
        Self {
            count: count.min(FEW),
            few: [value; FEW],
            #[cfg(feature = "std")]
            many: if count > FEW {
                std::vec![value; count]
            } else {
                Vec::new()
            },
        }
    }

    /// A value for each place.
    pub fn from_fn(count: usize, mut value: impl FnMut(usize) -> T) -> Self
    where
        T: Default,
    {
        let mut values = Self::new(count, T::default());
        for (place, to) in values.iter_mut().enumerate() {
            *to = value(place);
        }
        values
    }
}

impl<T, const FEW: usize> Deref for Values<T, FEW> {
    type Target = [T];

    #[inline]
    fn deref(&self) -> &[T] {
        #[cfg(feature = "std")]
        if !self.many.is_empty() {
            return &self.many;
        }
        &self.few[..self.count]
    }
}

impl<T, const FEW: usize> DerefMut for Values<T, FEW> {
    #[inline]
    fn deref_mut(&mut self) -> &mut [T] {
        #[cfg(feature = "std")]
        if !self.many.is_empty() {
            return &mut self.many;
        }
        &mut self.few[..self.count]
    }
}

impl<T: PartialEq, const FEW: usize> PartialEq for Values<T, FEW> {
    fn eq(&self, other: &Self) -> bool {
        self[..] == other[..]
    }
}
