//! A motion followed from one machine to another, in steps as long as Newton's method allows.

use super::budget::Budget;
use super::collocation::Path;

/// The first step, of the whole way; the next is twice as long where one succeeds, and half as long where one fails.
const FIRST_STEP: f64 = 0.25;

/// The least step, of the whole way.
const LEAST_STEP: f64 = 1.0 / 256.0;

/// The path at the end of the way, from that at its start; and how far it came. `corrected` makes a path one of the machine at
/// a part of the way, from 0 to 1. It is given the straight continuation of the two paths before.
pub fn followed(
    start: Path,
    corrected: impl Fn(Path, f64) -> Option<Path>,
    budget: &Budget,
) -> (Option<Path>, f64) {
    let (mut path, mut part, mut step) = (start, 0.0_f64, FIRST_STEP);
    let mut before: Option<(Path, f64)> = None;
    while part < 1.0 {
        let next = (part + step).min(1.0);
        let guess = match &before {
            Some((other, at)) => path.beyond(other, (next - part) / (part - at)),
            None => path.clone(),
        };
        match corrected(guess, next) {
            Some(found) => {
                before = Some((std::mem::replace(&mut path, found), part));
                part = next;
                step *= 2.0;
            }
            None => {
                step = 0.5 * (next - part);
                if step < LEAST_STEP || budget.is_spent() {
                    return (None, part);
                }
            }
        }
    }
    (Some(path), part)
}
