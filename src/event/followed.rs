//! The sign of a function, followed through the looks at it within a step.

use crate::Error;

/// A function that is zero for at most this fraction of a step and has the same sign on both sides only touches zero.
const TOUCH: f64 = 1e-6;

/// The sign of a number, which 0 has not.
pub(super) fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

/// A function has another sign after one fraction of a step than it had before another; it jumps, or leaves zero, where both are the same.
pub(super) struct Change {
    /// Its sign before.
    pub side_before: f64,
    /// The fractions.
    pub between: [f64; 2],
}

impl Change {
    /// At the instant at which the step begins, where contacts changed.
    fn at_start(side_before: f64) -> Self {
        Self {
            side_before,
            between: [0.0; 2],
        }
    }
}

/// A function that has become zero: that may be a touch.
#[derive(Clone, Copy)]
struct Zeros {
    /// The last look before.
    before: f64,
    /// The first and the last look at which it was zero.
    first: f64,
    last: f64,
}

/// What is known of the sign of a function, up to a fraction of a step. The letters of [`Watch`](super::Watch).
pub(super) struct FollowedSign {
    pub side: f64,
    pub touched: f64,
    pub leave: f64,
    /// The fraction of the last look.
    theta: f64,
    zeros: Option<Zeros>,
}

impl FollowedSign {
    /// At the start of a step.
    pub fn new(side: f64, touched: f64, leave: f64) -> Self {
        Self {
            side,
            touched,
            leave,
            theta: 0.0,
            zeros: None,
        }
    }

    /// Continues to the next value of the function, and calls `found` with the changes of its sign, in order.
    pub fn look(
        &mut self,
        theta: f64,
        value: f64,
        mut found: impl FnMut(Change) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let now = if self.side == 0.0 && value.abs() <= self.leave {
            0.0
        } else {
            self.leave = 0.0;
            sign(value)
        };
        if self.touched != 0.0 && now != 0.0 {
            // It was zero where contacts changed just before the step.
            if now != self.touched {
                found(Change::at_start(self.touched))?;
            }
            self.touched = 0.0;
        }
        let side_before = self.side;
        if let Some(zeros) = self.zeros {
            if now == 0.0 && theta - zeros.first <= TOUCH {
                self.zeros = Some(Zeros {
                    last: theta,
                    ..zeros
                });
            } else {
                self.zeros = None;
                if now != side_before || zeros.last - zeros.first > TOUCH {
                    let between = [zeros.before, zeros.first];
                    found(Change {
                        side_before,
                        between,
                    })?;
                    self.side = now;
                }
            }
        } else if side_before != 0.0 && now == 0.0 {
            self.zeros = Some(Zeros {
                before: self.theta,
                first: theta,
                last: theta,
            });
        } else {
            if side_before != 0.0 && now != side_before {
                let between = [self.theta, theta];
                found(Change {
                    side_before,
                    between,
                })?;
            }
            self.side = now;
        }
        self.theta = theta;
        Ok(())
    }

    /// Ends the step, after the last look. `ending` is what the function must exceed before its sign counts again, where the step ends
    /// with a change of contacts and the function is zero to rounding there.
    pub fn end(
        &mut self,
        ending: Option<f64>,
        is_known_at_end: bool,
        mut found: impl FnMut(Change) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let touched = core::mem::take(&mut self.touched);
        if touched != 0.0 && is_known_at_end && ending.is_some() {
            // It is evaluated at the ends of steps only, and may leave zero in the next step.
            (self.touched, self.leave) = (touched, ending.unwrap_or(self.leave));
        } else if touched != 0.0 {
            // It stays at zero.
            found(Change::at_start(touched))?;
        }
        if let Some(zeros) = self.zeros.take() {
            match ending {
                // What it does from there on is not known yet.
                Some(to_leave) => (self.touched, self.leave) = (self.side, to_leave),
                None => found(Change {
                    side_before: self.side,
                    between: [zeros.before, zeros.first],
                })?,
            }
            self.side = 0.0;
        }
        Ok(())
    }
}
