//! Numbers of single contacts of an emitted machine.

use crate::ContactQuantity;
use crate::scalar::{Interval, Scalar};

/// How a quantity of a contact is computed: by which function, of which arguments, and where its results stand among the
/// numbers of the contact, of which the others are 0. An argument is a number of `q`, of `v` or of [`ContactParts::prepared`], counted in this
/// order. A part without results has no function.
pub type ContactPart = (u32, &'static [u32], &'static [u32]);

/// The parts of the contacts of a machine whose functions have `L` arguments, in numbers of one type.
pub struct ContactParts<'a, N, const L: usize> {
    /// For each quantity, in the order of [`ContactQuantity`], the part of each contact.
    pub parts: &'static [&'static [ContactPart]],
    /// The prepared values that are arguments.
    pub prepared: &'a [N],
    /// Calls a function at a time, and puts its results into places among numbers.
    pub call: fn(u32, N, &[N; L], &[u32], &mut [N]),
}

impl<N: Scalar, const L: usize> ContactParts<'_, N, L> {
    /// Writes a quantity of some contacts, one after the other; each has as many numbers.
    pub fn write(
        &self,
        quantity: ContactQuantity,
        which: &[usize],
        (t, q, v): (N, &[N], &[N]),
        numbers: &mut [N],
    ) {
        numbers.fill(N::ZERO);
        let Some(parts) = self.parts.get(quantity as usize) else {
            return;
        };
        let width = numbers.len() / which.len().max(1);
        for (numbers, contact) in numbers.chunks_exact_mut(width.max(1)).zip(which) {
            let Some((function, arguments, places)) = parts.get(*contact) else {
                continue;
            };
            if places.is_empty() {
                continue;
            }
            let mut values = [N::ZERO; L];
            for (value, argument) in values.iter_mut().zip(*arguments) {
                let argument = *argument as usize;
                let (of_rates, of_prepared) = (q.len(), q.len() + v.len());
                let source = if argument < of_rates {
                    q.get(argument)
                } else if argument < of_prepared {
                    v.get(argument - of_rates)
                } else {
                    self.prepared.get(argument - of_prepared)
                };
                // Not a number, or an interval of all numbers, if the table of another machine were used.
                let zero = N::ZERO;
                *value = source.copied().unwrap_or(N::ZERO / zero);
            }
            (self.call)(*function, t, &values, places, numbers);
        }
    }
}

impl<const L: usize> ContactParts<'_, Interval, L> {
    /// Writes a lower bound of the gap of each contact.
    pub fn write_least_gaps(&self, (t, q): (Interval, &[Interval]), least: &mut [f64]) {
        for (contact, least) in least.iter_mut().enumerate() {
            let mut gap = [Interval::UNKNOWN];
            // Gaps do not depend on rates.
            self.write(ContactQuantity::Gap, &[contact], (t, q, q), &mut gap);
            *least = gap[0].lo();
        }
    }
}

/// Puts results into their places.
pub fn put<N: Copy>(results: &[N], places: &[u32], numbers: &mut [N]) {
    for (result, place) in results.iter().zip(places) {
        if let Some(number) = numbers.get_mut(*place as usize) {
            *number = *result;
        }
    }
}
