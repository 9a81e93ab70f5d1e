//! The sentences of errors and warnings as tables: a row for each variant, [`sentences!`].

use core::fmt::{self, Display, LowerExp};
#[cfg(feature = "std")]
use std::{string::String, vec::Vec};

/// A number in a message, with as few digits as necessary: `0.25`, `1e300`.
#[derive(Clone, Copy)]
pub(crate) struct ShortNumber(pub f64);

impl Display for ShortNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || !size.is_finite() || (1e-4..1e9).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

impl LowerExp for ShortNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        LowerExp::fmt(&self.0, f)
    }
}

/// Names in a sentence: `` `a`, `b` and `c` ``.
#[cfg(feature = "std")]
#[derive(Clone, Copy)]
pub(crate) struct Quoted<'n>(pub &'n [String]);

#[cfg(feature = "std")]
impl Quoted<'_> {
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

#[cfg(feature = "std")]
impl Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, name) in self.0.iter().enumerate() {
            let before = match i {
                0 => "",
                i if i + 1 < self.0.len() => ", ",
                _ => " and ",
            };
            write!(f, "{before}`{name}`")?;
        }
        Ok(())
    }
}

/// What a field of an error is in its sentence: numbers are [`ShortNumber`]s, lists of names are [`Quoted`].
pub(crate) trait Said {
    /// What stands in the sentence.
    type Words;

    /// The field as it stands in the sentence.
    fn said(self) -> Self::Words;
}

impl Said for &f64 {
    type Words = ShortNumber;

    fn said(self) -> ShortNumber {
        ShortNumber(*self)
    }
}

#[cfg(feature = "std")]
impl<'n> Said for &'n Vec<String> {
    type Words = Quoted<'n>;

    fn said(self) -> Quoted<'n> {
        Quoted(self)
    }
}

/// What stands in a sentence as it is.
macro_rules! said_as_it_is {
    ($($of:ty),* $(,)?) => {$(
        impl $crate::sentences::Said for &$of {
            type Words = Self;

            fn said(self) -> Self {
                self
            }
        }
    )*};
}

said_as_it_is! { usize, bool, &'static str }
#[cfg(feature = "std")]
said_as_it_is! { String, Vec<f64>, Option<f64>, Option<(usize, f64)> }

/// Writes a method `write_sentence` by a table with a row for each variant: its fields, and the sentence that they make.
///
/// In the sentence the fields are what [`Said`] makes of them. Where one sentence does not suffice, a block writes to the formatter
/// that is named at the top of the table.
macro_rules! sentences {
    (
        $of:ident, written to $f:ident:
        $(
            $(#[$attribute:meta])*
            $variant:ident $(($whole:ident))? $({ $($field:ident),* $(,)? })? => $words:tt
        )*
    ) => {
        impl $of {
            fn write_sentence(&self, $f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                match self {
                    $(
                        $(#[$attribute])*
                        Self::$variant $(($whole))? $({ $($field),* })? => {
                            $($(let $field = $crate::sentences::Said::said($field);)*)?
                            $crate::sentences::sentences!(@write $f $words)
                        }
                    )*
                }
            }
        }
    };
    (@write $f:ident $sentence:literal) => { write!($f, $sentence) };
    (@write $f:ident $writing:block) => { $writing };
}

pub(crate) use {said_as_it_is, sentences};
