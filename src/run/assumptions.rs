//! Whether the assumptions of a description hold throughout a step, and where one of them ends.

use std::string::String;
use std::vec::Vec;

use super::{LastInterpolant, Model, Run};
use crate::balance::Quadratures;
use crate::event::{self, Places, Triple, step_motion};
use crate::inputs::{InputLaw, LawInPiece};
use crate::interpolant::Interpolant;
use crate::roots;
use crate::stepper::Stepper;
use crate::{Error, Machine, System, Vector};

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// The time at which an assumption of the description ended in the last step, and its text. It may hold again at the end of the step,
    /// so assumptions are searched like events.
    pub(super) fn assumption_ended(
        &mut self,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<Option<(f64, String)>, Error> {
        let Self { model, stepper, .. } = self;
        let Some(looks) = model.isolating_fractions_of_assumptions(stepper, interpolant)? else {
            return Ok(None);
        };
        let interpolant = step_motion(interpolant, stepper, model.system)?;
        let at = |theta| event::state_at(model.system, stepper, interpolant, theta);
        for theta in looks {
            let Some((index, text)) = model.ended_assumption(at(theta)?) else {
                continue;
            };
            let margin = |theta| at(theta).map(|state| model.margin(index, state));
            // It held at the beginning of the step.
            let roundoff = event::theta_roundoff(stepper);
            let theta = event::root([0.0, theta], roundoff, &mut &margin)?;
            return Ok(Some((at(theta)?.0, text)));
        }
        Ok(None)
    }
}

impl<S: System, L: InputLaw<S>> Model<'_, S, L> {
    /// The fractions of the last step at which to evaluate the assumptions: between neighbours none of them fails and holds again. `None`
    /// if all are known to hold throughout, which a few values decide for most of them. A machine without assumptions pays nothing.
    #[inline]
    fn isolating_fractions_of_assumptions<A: Quadratures<S>>(
        &self,
        stepper: &mut Stepper<'_, S, LawInPiece<'_, L, S::Inputs>, A>,
        interpolant: &mut Option<Interpolant<S::Vector>>,
    ) -> Result<Option<Vec<f64>>, Error> {
        let (t, q, v) = (stepper.t(), stepper.q(), stepper.v());
        let count = self.system.assumptions(t, q, v, stepper.inputs()).len();
        if count == 0 {
            return Ok(None);
        }
        let series = stepper.coefficients();
        if let Some(coefficients) = series {
            let holds = |t: f64, q: &S::Vector, v: &S::Vector| {
                // Assumptions do not depend on inputs, so the present ones will do.
                let mut facts = self.system.assumptions(t, q, v, stepper.inputs());
                facts.all(|fact| fact.holds())
            };
            let hold = if self.system.has_linear_assumptions() {
                holds(t, q, v) && self.hold_throughout_series(stepper, coefficients, holds)
            } else {
                self.hold_within_bounds(stepper, coefficients)
            };
            if hold {
                return Ok(None);
            }
        }
        let places = if series.is_some() {
            std::vec![Some(Places::All); count]
        } else {
            self.places_of_assumptions(count, stepper, interpolant)?
        };
        if places.iter().all(Option::is_none) {
            return Ok(None);
        }
        let interpolant = step_motion(interpolant, stepper, self.system)?;
        let at = |theta| event::state_at(self.system, stepper, interpolant, theta);
        let mut looks = if places.contains(&Some(Places::Few)) {
            event::SAMPLE_FRACTIONS.to_vec()
        } else {
            Vec::new()
        };
        // All searches begin with the same fractions.
        let mut known: Vec<(f64, Triple<S::Vector>)> = Vec::new();
        for index in (0..count).filter(|index| places[*index] == Some(Places::All)) {
            looks.extend(roots::isolating_fractions(|theta| {
                let found = known.iter().find(|(other, _)| *other == theta);
                let state = match found {
                    Some((_, state)) => state.clone(),
                    None => {
                        let state = at(theta)?;
                        if count > 1 {
                            known.push((theta, state.clone()));
                        }
                        state
                    }
                };
                Ok(self.margin(index, state))
            })?);
        }
        looks.sort_by(f64::total_cmp);
        looks.dedup();
        Ok(Some(looks))
    }

    /// Where to search the last step for the end of each assumption, by a few values of its margin; `None` if it holds throughout.
    fn places_of_assumptions<A: Quadratures<S>>(
        &self,
        count: usize,
        stepper: &mut Stepper<'_, S, LawInPiece<'_, L, S::Inputs>, A>,
        interpolant: &mut Option<Interpolant<S::Vector>>,
    ) -> Result<Vec<Option<Places>>, Error> {
        let is_long = event::is_long(self.system, stepper);
        let mut values = std::vec![[0.0; roots::FRACTIONS.len()]; count];
        let mut hold = true;
        let states = event::at_fractions(self.system, stepper, interpolant)?;
        for (node, (t, q, v)) in states.iter().enumerate() {
            let facts = self.system.assumptions(*t, q, v, stepper.inputs());
            for (values, fact) in values.iter_mut().zip(facts) {
                values[node] = fact.margin;
                hold &= fact.holds();
            }
        }
        let places = values
            .iter()
            .map(|values| match roots::sign_changes(values) {
                // A margin that does not vary needs no search.
                _ if is_long && values.iter().any(|value| *value != values[0]) => Some(Places::All),
                Some(0) if hold => None,
                Some(0 | 1) if values[4] <= 0.0 => Some(Places::Few),
                // A margin that is 0 throughout holds.
                None if hold && *values == [0.0; roots::FRACTIONS.len()] => None,
                _ => Some(Places::All),
            });
        Ok(places.collect())
    }

    /// Whether facts that are linear in time, coordinates and rates hold throughout a step by series.
    ///
    /// The motion is `Σ cⱼ θʲ` with `1 ≥ θ ≥ θ² ≥ …`, which is a convex combination of the partial sums `Σ cⱼ` over `j ≤ k`. So a fact that
    /// holds at each partial sum holds along the step.
    fn hold_throughout_series<A: Quadratures<S>>(
        &self,
        stepper: &Stepper<'_, S, LawInPiece<'_, L, S::Inputs>, A>,
        coefficients: &[S::Vector],
        holds: impl Fn(f64, &S::Vector, &S::Vector) -> bool,
    ) -> bool {
        let t = stepper.t_before() + stepper.last_step();
        if !holds(stepper.t_before(), stepper.q_before(), stepper.v_before()) {
            return false;
        }
        self.all_partial_sums(stepper, coefficients, |q, v| holds(t, q, v))
    }

    /// Whether facts are known to hold at all states that are within the bounds of the same partial sums.
    fn hold_within_bounds<A: Quadratures<S>>(
        &self,
        stepper: &Stepper<'_, S, LawInPiece<'_, L, S::Inputs>, A>,
        coefficients: &[S::Vector],
    ) -> bool {
        let [mut low_q, mut high_q] = [(); 2].map(|()| stepper.q_before().clone());
        let [mut low_v, mut high_v] = [(); 2].map(|()| stepper.v_before().clone());
        let extend = |low: &mut S::Vector, high: &mut S::Vector, by: &S::Vector| {
            let all = low.as_mut_slice().iter_mut().zip(high.as_mut_slice());
            for ((low, high), x) in all.zip(by.as_slice()) {
                // A sum that is not a number must not be ignored.
                *low = if *low <= *x { *low } else { *x };
                *high = if *high >= *x { *high } else { *x };
            }
        };
        self.all_partial_sums(stepper, coefficients, |q, v| {
            extend(&mut low_q, &mut high_q, q);
            extend(&mut low_v, &mut high_v, v);
            true
        });
        let (start, end) = (stepper.t_before(), stepper.t_before() + stepper.last_step());
        let t = [start.min(end), start.max(end)];
        self.system
            .assumptions_hold_within(t, [&low_q, &high_q], [&low_v, &high_v])
    }

    /// Whether something is true of all partial sums of the coordinates and rates in the series of the last step, at its end.
    #[inline]
    fn all_partial_sums<A: Quadratures<S>>(
        &self,
        stepper: &Stepper<'_, S, LawInPiece<'_, L, S::Inputs>, A>,
        coefficients: &[S::Vector],
        mut is_true: impl FnMut(&S::Vector, &S::Vector) -> bool,
    ) -> bool {
        let h = stepper.last_step();
        let (mut q, mut v) = (stepper.q_before().clone(), stepper.v_before().clone());
        let mut power = h;
        for (k, row) in coefficients.iter().enumerate().skip(1) {
            let add = |sum: &mut S::Vector, row: &S::Vector, by: f64| {
                let (sum, row) = (sum.as_mut_slice(), row.as_slice());
                for i in 0..sum.len().min(row.len()) {
                    sum[i] += by * row[i];
                }
            };
            add(&mut q, row, power);
            if let Some(next) = coefficients.get(k + 1) {
                add(&mut v, next, (k + 1) as f64 * power);
            }
            if !is_true(&q, &v) {
                return false;
            }
            power *= h;
        }
        true
    }

    /// The first assumption that does not hold: its index and text.
    #[inline]
    pub(super) fn ended_assumption(&self, state: Triple<S::Vector>) -> Option<(usize, String)> {
        let (t, q, v) = &state;
        self.system
            .assumptions(*t, q, v, &self.inputs(*t, q, v))
            .enumerate()
            .find(|(_, assumption)| !assumption.holds())
            .map(|(index, assumption)| (index, assumption.text.into()))
    }

    /// The margin by which an assumption holds; NaN counts as violated.
    fn margin(&self, index: usize, state: Triple<S::Vector>) -> f64 {
        let (t, q, v) = &state;
        let inputs = self.inputs(*t, q, v);
        let margin = self.system.assumptions(*t, q, v, &inputs).nth(index);
        margin.map_or(0.0, |assumption| assumption.margin.max(f64::NEG_INFINITY))
    }
}
