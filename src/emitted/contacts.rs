//! Numbers of single contacts of an emitted machine.

use crate::ContactQuantity;
use crate::scalar::Interval;

/// How a quantity of a contact is computed: by which function, of which arguments, and where its results stand among the
/// numbers of the contact, of which the others are 0. An argument is a number of `q`, of `v` or of [`ContactParts::prepared`], counted in this
/// order. A part without results has no function.
pub type ContactPart = (u32, &'static [u32], &'static [u32]);

/// The parts of the contacts of a machine whose functions have `L` arguments.
pub struct ContactParts<'a, const L: usize> {
    /// For each quantity, in the order of [`ContactQuantity`], the part of each contact.
    pub parts: &'static [&'static [ContactPart]],
    /// The prepared values that are arguments.
    pub prepared: &'a [f64],
    /// Calls a function at a time, and puts its results into places among numbers.
    pub call: fn(u32, f64, &[f64; L], &[u32], &mut [f64]),
}

impl<const L: usize> ContactParts<'_, L> {
    /// Writes a quantity of some contacts, one after the other; each has as many numbers.
    pub fn write(
        &self,
        quantity: ContactQuantity,
        which: &[usize],
        (t, q, v): (f64, &[f64], &[f64]),
        numbers: &mut [f64],
    ) {
        numbers.fill(0.0);
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
            let mut values = [0.0; L];
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
                *value = source.copied().unwrap_or(f64::NAN);
            }
            (self.call)(*function, t, &values, places, numbers);
        }
    }
}

/// Puts results into their places.
pub fn put(results: &[f64], places: &[u32], numbers: &mut [f64]) {
    for (result, place) in results.iter().zip(places) {
        if let Some(number) = numbers.get_mut(*place as usize) {
            *number = *result;
        }
    }
}

/// Writes the lower bounds of intervals.
pub fn fill_least(to: &mut [f64], from: &[Interval]) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = from.lo();
    }
}
