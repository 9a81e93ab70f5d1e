//! The ends of steps by Taylor series of several steppers, in vector lanes.
//!
//! Each stepper goes to the end of its step and examines it alone. Only the motions through these ends are expanded together, which is most of the work: the
//! coefficients of a lane have the bits that they have alone.

use std::vec;
use std::vec::Vec;

use super::Stepper;
use super::in_lanes::{Evaluate, LaneMask, WIDTH, Wide, put, take};
use crate::balance::Quadratures;
use crate::inputs::InputLaw;
use crate::step_error::StepError;
use crate::{System, Vector};
use lagrangian_native::Lanes;

/// The ends of the steps that are being tried, and the motions through them.
pub(super) struct Expansions {
    t: [Wide; 2],
    q: Vec<Wide>,
    v: Vec<Wide>,
    coefficients: Vec<Vec<Wide>>,
    /// Whether the step of each lane has reached its end.
    reached: [Result<(), StepError>; WIDTH],
}

impl Expansions {
    /// For steppers like this one; `None` if its method is not by series.
    pub fn new<S: System, L: InputLaw<S>, A: Quadratures<S>>(
        of: &Stepper<'_, S, L, A>,
    ) -> Option<Self> {
        let rows = of.taylor.as_ref()?.of_step().len();
        let zeros = vec![Lanes::splat(0.0); of.now.q.as_slice().len()];
        Some(Self {
            t: [Lanes::splat(0.0); 2],
            q: zeros.clone(),
            v: zeros.clone(),
            coefficients: vec![zeros; rows],
            reached: [Ok(()); WIDTH],
        })
    }

    /// Whether a stepper computes as many coefficients.
    pub fn are_compatible_with<S: System, L, A: Quadratures<S>>(
        &self,
        of: &Stepper<'_, S, L, A>,
    ) -> bool {
        let rows = of.taylor.as_ref().map(|taylor| taylor.of_step().len());
        rows == Some(self.coefficients.len())
    }

    /// Lets a stepper go to the end of a step of length `h`, and puts this into a lane.
    pub fn put<S: System, L: InputLaw<S>, A: Quadratures<S>>(
        &mut self,
        lane: usize,
        of: &mut Stepper<'_, S, L, A>,
        (h, last): (f64, bool),
    ) {
        self.reached[lane] = of.advance_in_series(h, last);
        (self.t[0][lane], self.t[1][lane]) = (of.now.t, of.now.t_low);
        put(&mut self.q, lane, &of.now.q);
        put(&mut self.v, lane, &of.now.v);
    }

    /// Expands the motions of these lanes; returns those in which they have coefficients.
    pub fn expand(&mut self, which: LaneMask, machines: &mut impl Evaluate) -> LaneMask {
        let reached = |lane: &usize| which >> lane & 1 == 1 && self.reached[*lane].is_ok();
        let lanes: Vec<usize> = (0..WIDTH).filter(reached).collect();
        let Some(first) = lanes.first() else {
            return 0;
        };
        // A state without a series would leave all lanes without one.
        let mut mask = 0;
        for lane in 0..WIDTH {
            if lanes.contains(&lane) {
                mask |= 1 << lane;
                continue;
            }
            let rows = self.t.iter_mut().chain(&mut self.q).chain(&mut self.v);
            for row in rows {
                row[lane] = row[*first];
            }
        }
        let at = (self.t, self.q.as_slice(), self.v.as_slice());
        mask & machines.series(at, &mut self.coefficients)
    }

    /// Ends the step of a lane, whose length is `h`: with the coefficients of the lane, or else with those that it finds alone. Returns its error, like
    /// [`attempt_in_series`](Stepper::attempt_in_series).
    pub fn end<S: System, L: InputLaw<S>, A: Quadratures<S>>(
        &mut self,
        lane: usize,
        to: &mut Stepper<'_, S, L, A>,
        (h, has_coefficients): (f64, bool),
    ) -> Result<f64, StepError> {
        self.reached[lane]?;
        match &mut to.taylor {
            Some(taylor) if has_coefficients => {
                to.control.work.evaluations += 1;
                let rows = taylor.coefficients_ahead().iter_mut();
                for (to, from) in rows.zip(&self.coefficients) {
                    take(to, lane, from);
                }
            }
            _ => to.expand_ahead()?,
        }
        to.compare_in_series(h)
    }
}
