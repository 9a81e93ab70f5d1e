//! Changes the method of a run to another one with variable steps, and provides the data for that decision.

use super::{Stepper, Stiffness};
use crate::at::At;
use crate::balance::Quadratures;
use crate::control::shortest_step;
use crate::implicit::Implicit;
use crate::implicit::jacobian::Jacobian;
use crate::inputs::InputLaw;
use crate::methods::{MAX_STAGES, Method, MethodKind};
use crate::taylor::{GREATEST_DEFECT, ROUNDING_UNITS, Taylor, defect, size_of_rate};
use crate::tolerance::Tolerance;
use crate::{StepError, System, Vector};
use std::boxed::Box;

/// By how much the first step of an explicit method is shorter than the last one by series: steps by series are longer by up to four times.
const SHORTER: f64 = 0.25;

impl<S: System, L: InputLaw<S>, A: Quadratures<S>> Stepper<'_, S, L, A> {
    /// Continues with `method`, a Runge–Kutta method or one by series. The next step keeps its length for the first attempt.
    pub(crate) fn change_method(&mut self, method: &'static Method) -> Result<(), StepError> {
        let spectrum = method.tableau.spectrum;
        let system = self.model.system.get();
        self.implicit = spectrum.map(|spectrum| Box::new(Implicit::new(system, spectrum)));
        self.taylor = None;
        self.stiffness = Stiffness::default();
        if method.kind == MethodKind::Series {
            self.taylor = Some(Box::new(Taylor::new(&self.tolerance)));
            self.forget_powers();
            self.expand()?;
        }
        self.switch_method(method, self.longest)
    }

    /// Whether the motion has a series while contacts do what they do now, of which one is closed, and this series has a value here.
    pub(crate) fn has_closed_series(&mut self) -> bool {
        let Self {
            model,
            now,
            control,
            ..
        } = self;
        model.set_inputs(now.t, &now.q, &now.v);
        let (Some(touching), Some(constraints)) = (&model.touching, &model.constraints) else {
            return false;
        };
        // Where rows are nearly dependent, a series is not accurate.
        if constraints.at_fork {
            return false;
        }
        let at = At {
            t: now.t,
            q: &now.q,
            v: &now.v,
            u: &model.inputs,
        };
        let system = model.system.get();
        let own = system.constraints().len();
        if constraints.dependent().any(|row| row < own)
            || constraints.redundant && !touching.friction_is_known(system, at)
        {
            return false;
        }
        let mut taylor = Taylor::new(&self.tolerance);
        let expanded = taylor.expand(model.in_series(), now, &model.inputs, false);
        let has_series = !matches!(expanded, Err(StepError::NoSeries { .. }));
        control.work.evaluations += usize::from(has_series);
        expanded.is_ok() && self.is_motion(&mut taylor)
    }

    /// Whether a series through the present state has the accelerations that are known here, but for less than the error that a step by it may have.
    fn is_motion(&self, taylor: &mut Taylor<S::Vector>) -> bool {
        let Self {
            now, k, tolerance, ..
        } = self;
        let known = k[self.newest].as_slice();
        let mut found = now.v.zeros_like();
        taylor.accelerations(false, &mut found);
        let h = taylor.length(tolerance).min((self.end - now.t).abs());
        let absolute = tolerance.absolute.as_slice();
        let coordinates = known.iter().zip(found.as_slice()).enumerate();
        let coordinates = coordinates.map(|(i, (known, found))| {
            let size = size_of_rate(now.q.as_slice()[i], now.v.as_slice()[i]);
            [size, *known, known - found, absolute[i]]
        });
        let roundings = [tolerance.relative, ROUNDING_UNITS * f64::EPSILON];
        defect(h, coordinates, roundings) <= GREATEST_DEFECT
    }

    /// Continues with `method` where contacts have just changed and the accelerations are known: with an explicit one, or by series.
    pub(crate) fn change_where_contacts_did(
        &mut self,
        method: &'static Method,
    ) -> Result<(), StepError> {
        let is_series = method.kind == MethodKind::Series;
        let changes = !core::ptr::eq(self.method, method);
        if changes {
            if self.taylor.is_some() {
                self.control.step *= SHORTER;
            }
            self.taylor = is_series.then(|| Box::new(Taylor::new(&self.tolerance)));
            self.method = method;
            // There is no step of the new method yet that could be undone.
            self.k.swap(0, self.newest);
            self.newest = 0;
        }
        if changes || is_series {
            self.forget_powers();
        }
        if is_series {
            self.control.work.evaluations += 1;
            self.expand()?;
        }
        Ok(())
    }

    /// Chooses the length of the next step as at the start if tries by another method have left none that is long enough.
    pub(crate) fn lengthen_step_that_is_too_small(&mut self) {
        let left = (self.end - self.now.t) - self.now.t_low;
        if self
            .control
            .is_too_small(shortest_step::<f64>(self.now.t), left)
        {
            self.control.begin_anew();
            self.control.step = self.first_step();
        }
    }

    /// Sets the powers within the last step to 0 for steps that do not evaluate any: they may be those of contacts that were closed.
    fn forget_powers(&mut self) {
        if !self.takes_powers_now() && self.model.touching.is_some() {
            for stage in 1..MAX_STAGES {
                self.quadratures.take(stage, 0.0, 0.0);
                self.quadratures.set_contact_shares(stage, &[]);
            }
        }
    }

    /// Counts evaluations that were made for the choice of the method.
    pub(crate) fn count_evaluations(&mut self, evaluations: usize) {
        self.control.work.evaluations += evaluations;
    }

    /// Sets the number of steps between two stiffness tests.
    pub(crate) fn test_stiffness_every(&mut self, steps: usize) {
        self.between_tests = steps;
    }

    /// Whether stiffness was tested since the method began, and nothing speaks for it now.
    pub(crate) fn is_not_stiff(&self) -> bool {
        self.stiffness.is_tested && self.shows_no_stiffness()
    }

    /// Whether nothing speaks for stiffness now, tested or not.
    pub(crate) fn shows_no_stiffness(&self) -> bool {
        self.stiffness.signs == 0
    }

    /// The tolerance of steps.
    pub(crate) fn tolerance(&self) -> &Tolerance<S::Vector> {
        &self.tolerance
    }

    /// The length of the next step by series, in s, if the method is by series.
    pub(crate) fn length_in_series(&mut self) -> Option<f64> {
        let taylor = self.taylor.as_mut()?;
        Some(taylor.length(&self.tolerance))
    }

    /// The number of multiplications that the present method has taken to solve linear equations; 0 for explicit methods.
    pub(crate) fn multiplications(&self) -> f64 {
        let implicit = self.implicit.as_ref();
        implicit.map_or(0.0, |implicit| implicit.multiplications())
    }

    /// The fastest rate of the motion at the present state, in 1/s: the spectral radius of the derivatives of `(q', v')` with
    /// respect to `(q, v)`. Implicit methods use the derivatives that they keep; otherwise one evaluation and two for each
    /// coordinate are needed.
    pub(crate) fn fastest_rate(&mut self) -> Option<f64> {
        if let Some(implicit) = &mut self.implicit {
            return Some(implicit.fastest_rate());
        }
        let Self {
            model,
            now,
            control,
            ..
        } = self;
        let mut jacobian = Jacobian::new(model.system.get());
        let (mut q, mut v) = (now.q.clone(), now.v.clone());
        let (mut here, mut there) = (q.zeros_like(), q.zeros_like());
        let state = [&mut q, &mut v, &mut here, &mut there];
        let at = (now.t, control.last_step);
        let result = jacobian.find(at, state, &mut |t, q, v, a| {
            model.accelerations(t, q, v, a, &mut control.work)
        });
        model.set_inputs(now.t, &now.q, &now.v);
        result.ok().map(|()| jacobian.fastest_rate())
    }
}
