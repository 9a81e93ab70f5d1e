//! Continuation of a motion from one machine to another, with steps as long as Newton's method allows.

use super::budget::Budget;
use super::collocation::Path;

/// The first step, as a fraction of the whole; a step is doubled after a success and halved after a failure.
const FIRST_STEP: f64 = 0.25;

/// The smallest step, as a fraction of the whole.
const LEAST_STEP: f64 = 1.0 / 256.0;

/// Continues a path from parameter 0 to 1; returns the path at the end if it was reached, and how far the continuation came.
/// `corrected` solves for the path at a parameter, from a linear extrapolation of the last two paths.
pub fn continue_path(
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
