//! Accelerations that jump where a step begins, as that of a body at rest does with a force through `sign(der(x))`.
//!
//! The acceleration at the beginning itself then belongs to neither side of the jump, and differences across it are no derivatives. The
//! motion leaves the jump at once, so methods that use either take them from a little later.

use super::Stepper;
use crate::balance::Quadratures;
use crate::{InputLaw, System, Vector};

/// How far ahead, in steps: so little that a smooth acceleration hardly changes, and so much that rounding does not hide the motion.
const LOOK_AHEAD: f64 = 1e-10;

/// Looks again at this fraction of it: a smooth change is then as many times smaller, and a jump is not.
const SECOND_LOOK_AHEAD: f64 = 1.0 / 16.0;

/// A change of a rate in the step by less than this fraction of the tolerance does not matter.
const NEGLIGIBLE_CHANGE: f64 = 1e-6;

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Replaces the acceleration at the beginning of a step of length `h` by the one just after it, if it jumps there, and returns how far
    /// ahead that is, in s; 0 if it does not jump. It costs an evaluation, and two more where the acceleration changes fast. The other
    /// accelerations of the step are scratch memory.
    ///
    /// Where every motion is pushed back into the jump, as a body at rest that dry friction holds, there is no side to continue on, and
    /// nothing is replaced.
    pub(super) fn look_beyond_jump(&mut self, h: f64) -> f64 {
        let Self {
            model,
            tolerance,
            before,
            k: [here, there, nearer, confirmed, ..],
            stage: (q, v),
            control,
            ..
        } = self;
        let ahead = LOOK_AHEAD * h;
        let mut evaluate = |ahead: f64, along: &S::Vector, a: &mut S::Vector| {
            before.state_ahead(ahead, along, [&mut *q, &mut *v]);
            let t = before.t + (before.t_low + ahead);
            model.accelerations(t, q, v, a, &mut control.work).is_ok()
        };
        let change = |from: &S::Vector, to: &S::Vector| {
            let pairs = from.as_slice().iter().zip(to.as_slice());
            let of_each = pairs.enumerate().map(|(i, (from, to))| {
                let rate = before.v.as_slice()[i].abs();
                let tolerable = tolerance.absolute.as_slice()[i] + tolerance.relative * rate;
                h.abs() * (to - from).abs() / tolerable
            });
            of_each.fold(0.0, f64::max)
        };
        if !evaluate(ahead, here, there) {
            return 0.0;
        }
        let jump = change(here, there);
        let jumps = jump > NEGLIGIBLE_CHANGE
            && evaluate(SECOND_LOOK_AHEAD * ahead, here, nearer)
            && change(here, nearer) > 0.5 * jump
            && evaluate(ahead, there, confirmed)
            && change(there, confirmed) < 0.5 * jump;
        if !jumps {
            return 0.0;
        }
        here.clone_from(there);
        ahead
    }
}
