//! Steps of implicit methods.

use super::Stepper;
use crate::attempt::{self, not_finite};
use crate::balance::Quadratures;
use crate::control::Control;
use crate::implicit::StepProblem;
use crate::stages::stage_state;
use crate::{InputLaw, StepError, System};

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Tries a step of length `h` from `before` to `now`. Returns its error relative to the
    /// tolerance, which is infinite if its stages could not be found.
    pub(super) fn attempt_implicitly(&mut self, h: f64, last: bool) -> Result<f64, StepError> {
        let ahead = match &self.implicit {
            Some(implicit) if implicit.begins_anew() => self.look_beyond_jump(h),
            _ => 0.0,
        };
        let Self {
            method,
            tolerance,
            model,
            before,
            now,
            k,
            stage,
            control: Control { work, is_retry, .. },
            implicit,
            ..
        } = self;
        let Some(implicit) = implicit else {
            return Ok(f64::INFINITY);
        };
        if ahead != 0.0 {
            implicit.begin_beyond_jump(ahead);
        }
        let task = StepProblem {
            method,
            before,
            h,
            tolerance,
        };
        let (q, v) = (&mut stage.0, &mut stage.1);
        let has_converged = implicit.solve(&task, k, [q, v], |t, q, v, a| {
            model.accelerations(t, q, v, a, work)
        })?;
        if !has_converged {
            return Ok(f64::INFINITY);
        }

        let stages = method.tableau.stages;
        attempt::arrive::<f64, _, _>(method, (before, h), k, now, (self.end, &[last]));
        let again = *is_retry || work.steps == 0;
        let error = implicit.error_of_step(&task, (k, now), [q, v], again, |t, q, v, a| {
            model.accelerations(t, q, v, a, work)
        });
        let [is_finite] = attempt::are_finite(&now.q, &now.v);
        if !(error.is_finite() && is_finite) {
            return match not_finite(&now.q, &now.v, 0) {
                Some(coordinate) => Err(StepError::NotFinite {
                    coordinate,
                    t: now.t,
                }),
                None => Ok(f64::INFINITY),
            };
        }
        if error > 1.0 {
            return Ok(error);
        }
        implicit.smooth_start(&task, k);

        self.take_powers_of_stages(h);
        let Self {
            model,
            quadratures,
            now,
            k,
            ..
        } = self;
        // The last stage is the end. Its acceleration is the slope of the polynomial there, since an
        // evaluation would amplify the round-off of the state by the stiffness of the machine.
        let (known, end) = k.split_at_mut(stages);
        end[0].clone_from(&known[stages - 1]);
        model.set_inputs(now.t, &now.q, &now.v);
        let moved = model.project(now)?;
        // The integrals do without the powers at the end, but those of contacts are interpolated with them.
        if S::MAY_COLLIDE && model.touching.is_some() && quadratures.integrals().is_some() {
            model.take_rates(quadratures, stages, (now.t, &now.q, &now.v, &end[0]));
        }
        Ok(if moved {
            error.max(self.error_of_move())
        } else {
            error
        })
    }

    /// Evaluates the powers at the stages of a step of length `h`, if they are integrated.
    fn take_powers_of_stages(&mut self, h: f64) {
        let Self {
            method,
            model,
            quadratures,
            before,
            k,
            stage: (q, v),
            ..
        } = self;
        if quadratures.integrals().is_none() {
            return;
        }
        for i in 1..method.tableau.stages {
            let c = method.tableau.c[i];
            let t = before.t + (before.t_low + c * h);
            let row = &method.scheme.rows[i];
            stage_state::<f64, _>((row, c * h, h), [&before.q, &before.v], k, [q, v]);
            model.set_inputs(t, q, v);
            model.take_rates(quadratures, i, (t, q, v, &k[i]));
        }
    }
}
