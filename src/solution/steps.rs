//! The recorded steps of a run.

use std::vec::Vec;

use crate::compensated::Sum;
use crate::inputs::InputLaw;
use crate::interpolant::{Ends, Interpolant};
use crate::methods::{MAX_STAGES, Method};
use crate::step_error::StepError;
use crate::{Quadratures, Stepper, System, Vector};

/// The steps of a run, from which dense output is made on demand.
#[derive(Clone, Debug)]
pub(crate) struct Steps<V> {
    /// Beginning and length of each step.
    pub(super) times: Vec<(Sum, f64)>,
    /// For each step, `q` and `v` at its beginning, and the accelerations at the stages that dense output needs, first the
    /// beginning; after the last step, the same three at its end.
    vectors: Vec<V>,
    /// The stages whose accelerations are kept; the first is the beginning.
    stored_stages: Vec<usize>,
    /// The methods of the steps, each with the index of its first step.
    methods: Vec<(usize, &'static Method)>,
    /// The coefficients of steps by series and by impulses.
    coefficients: Vec<V>,
    /// Where the coefficients of each step begin, and how many there are; `None` for Runge–Kutta steps. Steps after the last one with
    /// coefficients have no entry.
    series: Vec<Option<(usize, usize)>>,
}

impl<V: Vector> Steps<V> {
    /// Memory for the steps of a run that begins with `method` and may change to `others`.
    pub fn new(method: &'static Method, others: &[&'static Method]) -> Self {
        let methods = || others.iter().copied().chain([method]);
        let is_kept =
            |stage: &usize| *stage == 0 || methods().any(|method| stores_stage(method, *stage));
        Self {
            times: Vec::new(),
            vectors: Vec::new(),
            stored_stages: (0..MAX_STAGES).filter(is_kept).collect(),
            methods: [(0, method)].into(),
            coefficients: Vec::new(),
            series: Vec::new(),
        }
    }

    /// Records that the next step belongs to another method.
    pub fn begin_method(&mut self, method: &'static Method) {
        let is_known = (self.methods.last()).is_some_and(|(_, last)| core::ptr::eq(*last, method));
        if !is_known {
            self.methods.push((self.times.len(), method));
        }
    }

    /// The method of a step.
    pub(super) fn method(&self, step: usize) -> &'static Method {
        let after = self.methods.partition_point(|(first, _)| *first <= step);
        self.methods[after.saturating_sub(1)].1
    }

    /// Adds the last step.
    pub fn push<S: System<Vector = V>, L: InputLaw<S>, A: Quadratures<S>>(
        &mut self,
        stepper: &Stepper<'_, S, L, A>,
    ) {
        self.vectors.truncate(self.times.len() * self.stride());
        self.times.push((stepper.beginning(), stepper.last_step()));
        if let Some(coefficients) = stepper.coefficients() {
            self.begin_series(coefficients.len());
            self.coefficients.extend_from_slice(coefficients);
        }
        self.vectors.push(stepper.q_before().clone());
        self.vectors.push(stepper.v_before().clone());
        for &stage in &self.stored_stages {
            self.vectors.push(stepper.stages()[stage].clone());
        }
        for end in [stepper.q(), stepper.v(), stepper.a()] {
            self.vectors.push(end.clone());
        }
    }

    /// Records a jump of the accelerations as a step of length zero, which separates the end of the last step from the
    /// beginning of the next.
    pub fn jump<S: System<Vector = V>, L: InputLaw<S>, A: Quadratures<S>>(
        &mut self,
        stepper: &Stepper<'_, S, L, A>,
    ) {
        // Before the first step there is nothing to separate but that step from what happens at the start.
        let last = self.vectors.last().unwrap_or(stepper.q()).clone();
        let now = Sum {
            high: stepper.t(),
            low: 0.0,
        };
        self.times
            .push((now, 0.0_f64.copysign(stepper.last_step())));
        if let Some(coefficients) = stepper.coefficients()
            && !self.coefficients.is_empty()
        {
            // For a step by series of length zero, coordinates and rates are its only coefficients.
            let zeros = stepper.q().zeros_like();
            let state = [stepper.q().clone(), stepper.v().clone()];
            self.begin_series(coefficients.len());
            let count = self.coefficients.len() + coefficients.len();
            self.coefficients.extend(state);
            self.coefficients.resize(count, zeros);
        }
        self.vectors.resize(self.times.len() * self.stride(), last);
    }

    /// Records that this many coefficients of the newest step follow.
    fn begin_series(&mut self, count: usize) {
        self.series.resize(self.times.len(), None);
        if let Some(newest) = self.series.last_mut() {
            *newest = Some((self.coefficients.len(), count));
        }
    }

    /// The number of vectors of a step.
    fn stride(&self) -> usize {
        2 + self.stored_stages.len()
    }

    pub(super) fn count(&self) -> usize {
        self.times.len()
    }

    pub(super) fn beginning(&self, step: usize) -> (&V, &V) {
        let at = step * self.stride();
        (&self.vectors[at], &self.vectors[at + 1])
    }

    /// The step that contains `t`, which is within the run.
    pub(super) fn index(&self, t: f64) -> usize {
        let after = self.times.partition_point(|&(start, h)| {
            if h.is_sign_positive() {
                start.high <= t
            } else {
                start.high >= t
            }
        });
        after.saturating_sub(1)
    }

    pub(super) fn interpolant(
        &self,
        step: usize,
        accelerations: impl FnMut(f64, &V, &V, &mut V) -> Result<(), StepError>,
    ) -> Result<Interpolant<V>, StepError> {
        let (start, h) = self.times[step];
        if let Some(Some((from, count))) = self.series.get(step) {
            let coefficients = &self.coefficients[*from..][..*count];
            return Ok(Interpolant::of_series(start, h, coefficients));
        }
        let method = self.method(step);
        let stride = self.stride();
        let [q0, v0, stages @ ..] = &self.vectors[step * stride..][..stride] else {
            unreachable!("a step has at least three vectors");
        };
        let [q1, v1, a1] = &self.vectors[(step + 1) * stride..][..3] else {
            unreachable!("every step is followed by its end");
        };
        let mut k: [V; MAX_STAGES] = q0.several_zeros_like();
        for (&stage, a) in self.stored_stages.iter().zip(stages) {
            k[stage].clone_from(a);
        }
        k[method.tableau.stages].clone_from(a1);
        let ends = Ends {
            start,
            h,
            q: [q0, q1],
            v: [v0, v1],
        };
        if method.is_quintic() {
            return Ok(Interpolant::quintic(&ends, [&k[0], a1]));
        }
        Interpolant::new(method, &ends, &mut k, accelerations)
    }
}

/// Whether dense output of a method needs the acceleration of a stage.
fn stores_stage(method: &Method, stage: usize) -> bool {
    let (scheme, stages) = (&method.scheme, method.tableau.stages);
    let extra = scheme.rows[..scheme.length].iter().skip(stages + 1);
    let mut rows = extra.chain(&scheme.dense[..scheme.dense_length]);
    stage < stages && rows.any(|row| row.uses(stage))
}
