//! Integrates powers over a step that is too long for the weights of its method.

use std::vec::Vec;

use super::Stepper;
use crate::balance::Quadratures;
use crate::interpolant::Interpolant;
use crate::{InputLaw, StepError, System, Vector};

/// The Gauss–Legendre rule with four points on [0, 1], exact for polynomials of degree 7: points and weights. M. Abramowitz, I. A.
/// Stegun, *Handbook of Mathematical Functions*, 1964, table 25.4.
const GAUSS: [[f64; 2]; 4] = [
    [0.069_431_844_202_973_71, 0.173_927_422_568_726_93],
    [0.330_009_478_207_571_9, 0.326_072_577_431_273_07],
    [0.669_990_521_792_428_1, 0.326_072_577_431_273_07],
    [0.930_568_155_797_026_3, 0.173_927_422_568_726_93],
];

/// The largest number of parts into which a step is divided: some 5 for each turn of a drive that turns ten thousand
/// times in the step.
const MOST_PARTS: usize = 1 << 16;

/// A stage whose rates are not needed after a step: those of the first stage are needed for the next step, and those of the last
/// for undoing it.
const FREE: usize = 1;

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Integrates the powers over the last step along its dense output, by the Gauss–Legendre rule in 1, 2, 4 … parts, until work and
    /// losses change by at most `bound`, in J, and the integral of the absolute work rate by at most as much or a hundredth. After each
    /// attempt that `failed` in this run half as many parts are the most, so that all of them together cost no more than twice the first.
    ///
    /// The step was as long as the motion allows. If the machine is at rest, a drive may turn many times during the step, and the
    /// stages of the method do not represent its work. If no division of the step suffices, or if `counts` returns false for the changes of
    /// work and losses, in J, the integrals stay unchanged and the result is false.
    pub(crate) fn integrate_along(
        &mut self,
        interpolant: &Interpolant<S::Vector>,
        (bound, failed): (f64, usize),
        counts: impl FnOnce(f64, f64) -> bool,
    ) -> Result<bool, StepError> {
        let mut is_known = false;
        let mut before = std::vec![[f64::NAN; 3]];
        let mut parts = 1;
        while parts <= MOST_PARTS >> failed.min(MOST_PARTS.ilog2() as usize) {
            let refined = self.integrals_in_parts(interpolant, parts)?;
            let change = |i: usize| (refined[0][i] - before[0][i]).abs();
            let (work, to_and_fro, lost) = (change(0), change(1), change(2));
            if work + lost <= bound && to_and_fro <= bound.max(0.01 * refined[0][1].abs()) {
                if let Some(integrals) = self.quadratures.integrals_mut() {
                    let [work, _, dissipated] = integrals.change_of_last(&refined);
                    is_known = counts(work, dissipated);
                    if is_known {
                        integrals.replace_last(&refined);
                    }
                }
                break;
            }
            before = refined;
            parts *= 2;
        }
        let Self { model, now, .. } = self;
        model.set_inputs(now.t, &now.q, &now.v);
        Ok(is_known)
    }

    /// The integrals over the last step of work rate, its absolute value, and dissipation rate, and of the shares of each unilateral
    /// contact, in J.
    fn integrals_in_parts(
        &mut self,
        interpolant: &Interpolant<S::Vector>,
        parts: usize,
    ) -> Result<Vec<[f64; 3]>, StepError> {
        let mut integrals = Vec::new();
        let length = self.control.last_step / parts as f64;
        let mut a = self.now.q.zeros_like();
        for part in 0..parts {
            for [point, weight] in GAUSS {
                let theta = (part as f64 + point) / parts as f64;
                let t = interpolant.time_at(theta);
                let (mut q, mut v) = interpolant.state_at(theta);
                self.project(t, &mut q, &mut v)?;
                let Self {
                    model,
                    quadratures,
                    control,
                    ..
                } = self;
                model.accelerations(t, &q, &v, &mut a, &mut control.work)?;
                model.take_rates(quadratures, FREE, (t, &q, &v, &a));
                if let Some(balance) = quadratures.integrals() {
                    for (k, rates) in balance.rates(FREE).enumerate() {
                        if k == integrals.len() {
                            integrals.push([0.0; 3]);
                        }
                        for (integral, rate) in integrals[k].iter_mut().zip(rates) {
                            *integral += weight * length * rate;
                        }
                    }
                }
            }
        }
        Ok(integrals)
    }
}
