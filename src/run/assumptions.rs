//! Whether the assumptions of a description hold throughout a step, and where one of them ends.

use std::boxed::Box;
use std::string::String;
use std::vec::Vec;

use super::{LastInterpolant, Model, Run};
use crate::balance::Quadratures;
use crate::event::{self, Places, ShallStop, Triple, Unsearched, step_motion};
use crate::inputs::{InputLaw, LawInPiece};
use crate::interpolant::Interpolant;
use crate::roots;
use crate::settings::asked_to_stop;
use crate::stepper::Stepper;
use crate::taylor::MotionBounds;
use crate::{Error, Machine, System, Vector};

/// Bounds within which all assumptions were found to hold in this run, if any were sought.
pub(super) type Held<V> = Option<Box<HeldBounds<V>>>;

/// Bounds within which all assumptions are known to hold.
///
/// Whether they hold is found by interval arithmetic, which takes as long as some evaluations of the machine. A motion that repeats stays within the bounds
/// of its earlier steps, and others leave bounds that grow in proportion to their width only now and then.
#[derive(Debug)]
pub(super) struct HeldBounds<V> {
    known: Option<([f64; 2], MotionBounds<V>)>,
    of_step: MotionBounds<V>,
    wider: MotionBounds<V>,
    /// By how many of their widths bounds are widened on the sides on which a step leaves them. Where assumptions are not known to hold within the wider ones,
    /// a quarter of this is used from then on, and at last 0, which only joins the bounds of steps; `None` if not even these hold.
    widening: Option<f64>,
    /// Whether rates may matter to the assumptions, as soon as this was examined. They do not where these are known to hold for rates of any size;
    /// all bounds of rates are infinite then.
    rates_matter: Option<bool>,
}

/// All times.
const ANY_TIME: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// By how many of their widths bounds are widened at first, and at least.
const WIDENING: [f64; 2] = [4.0, 0.25];

impl<V: Vector> HeldBounds<V> {
    fn none(q: &V) -> Self {
        Self {
            known: None,
            of_step: MotionBounds::like(q),
            wider: MotionBounds::like(q),
            widening: Some(WIDENING[0]),
            rates_matter: None,
        }
    }

    /// Whether all assumptions are known to hold throughout a step whose bounds are known, and throughout wider ones, for rates of any size; at any time, if
    /// they do not depend on it. `hold` tells whether they are known to hold at all times and states within bounds.
    fn hold_for_any_rates(
        &mut self,
        hold: &impl Fn([f64; 2], &MotionBounds<V>) -> bool,
        t: [f64; 2],
    ) -> bool {
        let Self {
            known,
            of_step,
            wider,
            widening,
            ..
        } = self;
        let [low, high] = &mut wider.v;
        low.as_mut_slice().fill(f64::NEG_INFINITY);
        high.as_mut_slice().fill(f64::INFINITY);
        let mut hold_within = |widening: f64, wider_t: [f64; 2]| {
            for i in 0..of_step.q[0].as_slice().len() {
                let at = [0, 1].map(|end: usize| of_step.q[end].as_slice()[i]);
                let wide = widened(None, at, widening);
                for (wider, wide) in wider.q.iter_mut().zip(wide) {
                    wider.as_mut_slice()[i] = wide;
                }
            }
            let holds = hold(wider_t, wider);
            if holds {
                of_step.v.clone_from(&wider.v);
                take(known, wider_t, wider);
            }
            holds
        };
        let wide = widening.unwrap_or(0.0);
        let mut holds = hold_within(wide, ANY_TIME);
        if !holds && hold_within(0.0, ANY_TIME) {
            holds = true;
            // Somewhat wider ones save looks at later steps.
            let mut by = narrower(wide);
            while let Some(more) = by.filter(|by| *by > 0.0) {
                *widening = by;
                if hold_within(more, ANY_TIME) {
                    break;
                }
                by = narrower(more);
                *widening = by;
            }
        }
        holds = holds || hold_within(wide, widened(None, t, wide)) || hold_within(0.0, t);
        if holds {
            self.rates_matter = Some(false);
            return true;
        }
        self.rates_matter = Some(true);
        false
    }

    /// Whether all assumptions are known to hold throughout a step with these coefficients and of this length, from a state. `hold` tells whether they are
    /// known to hold at all times and states within bounds.
    fn hold_throughout(
        &mut self,
        hold: &impl Fn([f64; 2], &MotionBounds<V>) -> bool,
        (coefficients, h): (&[V], f64),
        (t, q, v): (f64, &V, &V),
    ) -> bool {
        if let Some((known_t, known)) = &self.known
            && contain(*known_t, [t.min(t + h), t.max(t + h)])
            && match self.rates_matter {
                Some(false) => known.contain::<false>(coefficients, h, [q, v]),
                _ => known.contain::<true>(coefficients, h, [q, v]),
            }
        {
            return true;
        }
        let are_finite = match self.rates_matter {
            Some(false) => self.of_step.of_step::<false>(coefficients, h, [q, v]),
            _ => self.of_step.of_step::<true>(coefficients, h, [q, v]),
        };
        if !are_finite {
            return false;
        }
        let t = [t.min(t + h), t.max(t + h)];
        if self.rates_matter.is_none() && self.hold_for_any_rates(hold, t) {
            return true;
        }
        let Self {
            known,
            of_step,
            wider,
            widening,
            ..
        } = self;
        if let Some((known_t, known)) = known
            && contain(*known_t, t)
            && contain_all(known, of_step)
        {
            return true;
        }
        while let Some(by) = *widening {
            let known_t = known.as_ref().map(|(t, _)| *t);
            let wider_t = widened(known_t, t, by);
            for i in 0..of_step.q[0].as_slice().len() {
                let pairs = [
                    (
                        &of_step.q,
                        &mut wider.q,
                        known.as_ref().map(|(_, of)| &of.q),
                    ),
                    (
                        &of_step.v,
                        &mut wider.v,
                        known.as_ref().map(|(_, of)| &of.v),
                    ),
                ];
                for (of_step, wider, known) in pairs {
                    let at = |of: &[V; 2]| [of[0].as_slice()[i], of[1].as_slice()[i]];
                    let [low, high] = widened(known.map(at), at(of_step), by);
                    wider[0].as_mut_slice()[i] = low;
                    wider[1].as_mut_slice()[i] = high;
                }
            }
            if hold(wider_t, wider) {
                take(known, wider_t, wider);
                return true;
            }
            *widening = narrower(by);
        }
        let holds = hold(t, of_step);
        if holds {
            take(known, t, of_step);
        }
        holds
    }
}

/// The widening of bounds after one within which assumptions are not known to hold.
fn narrower(widening: f64) -> Option<f64> {
    match 0.25 * widening {
        _ if widening == 0.0 => None,
        quarter if quarter < WIDENING[1] => Some(0.0),
        quarter => Some(quarter),
    }
}

/// Exchanges the known bounds for others.
fn take<V: Vector>(
    known: &mut Option<([f64; 2], MotionBounds<V>)>,
    t: [f64; 2],
    bounds: &mut MotionBounds<V>,
) {
    match known {
        Some((known_t, known)) => {
            *known_t = t;
            std::mem::swap(known, bounds);
        }
        None => *known = Some((t, bounds.clone())),
    }
}

/// Whether bounds contain others.
fn contain(known: [f64; 2], of_step: [f64; 2]) -> bool {
    known[0] <= of_step[0] && of_step[1] <= known[1]
}

/// Whether bounds of a motion contain others.
fn contain_all<V: Vector>(known: &MotionBounds<V>, of_step: &MotionBounds<V>) -> bool {
    let pairs = [(&known.q, &of_step.q), (&known.v, &of_step.v)];
    pairs.into_iter().all(|(known, of_step)| {
        let [known, of_step] = [known, of_step].map(|of| [of[0].as_slice(), of[1].as_slice()]);
        (0..known[0].len())
            .all(|i| contain([known[0][i], known[1][i]], [of_step[0][i], of_step[1][i]]))
    })
}

/// Bounds that contain known ones and those of a step, and more on the sides on which the step left the known ones, by so many of their widths.
fn widened(known: Option<[f64; 2]>, [low, high]: [f64; 2], by: f64) -> [f64; 2] {
    let Some([known_low, known_high]) = known else {
        let more = by * (high - low);
        return [low - more, high + more];
    };
    let more = by * (high.max(known_high) - low.min(known_low));
    [
        if low < known_low {
            low - more
        } else {
            known_low
        },
        if high > known_high {
            high + more
        } else {
            known_high
        },
    ]
}

/// How many states of a step are kept at most for the searches after the first one.
const MOST_STATES: usize = 512;

/// States of a step at some of its fractions, in their order. Several searches along one step begin with the same fractions, which are few, and go on with others of their own: the first ones are
/// kept, and all others are evaluated again.
struct KnownStates<V> {
    most: usize,
    states: Vec<(f64, Triple<V>)>,
}

impl<V: Vector> KnownStates<V> {
    /// For so many searches: one alone evaluates no state twice.
    fn of_searches(searches: usize) -> Self {
        Self {
            most: if searches > 1 { MOST_STATES } else { 0 },
            states: Vec::new(),
        }
    }

    /// The state at a fraction of the step, which is evaluated if it is not known.
    fn at<E>(
        &mut self,
        theta: f64,
        evaluate: impl FnOnce(f64) -> Result<Triple<V>, E>,
    ) -> Result<Triple<V>, E> {
        let place = (self.states).binary_search_by(|(other, _)| other.total_cmp(&theta));
        match place {
            Ok(place) => Ok(self.states[place].1.clone()),
            Err(place) => {
                let state = evaluate(theta)?;
                if self.states.len() < self.most {
                    self.states.insert(place, (theta, state.clone()));
                }
                Ok(state)
            }
        }
    }
}

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// The time at which an assumption of the description ended in the last step, and its text. It may hold again at the end of the step,
    /// so assumptions are searched like events.
    pub(super) fn assumption_ended(
        &mut self,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<Option<(f64, String)>, Unsearched> {
        let Self {
            model,
            stepper,
            held,
            callbacks,
            ..
        } = self;
        let mut shall_stop = asked_to_stop::<M>(&mut callbacks.stop, model.system);
        let looks = model.isolating_fractions_of_assumptions(
            stepper,
            (interpolant, &mut shall_stop),
            held,
        )?;
        let Some(looks) = looks else {
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
        (interpolant, shall_stop): (
            &mut Option<Interpolant<S::Vector>>,
            ShallStop<'_, '_, S::Vector>,
        ),
        held: &mut Held<S::Vector>,
    ) -> Result<Option<Vec<f64>>, Unsearched> {
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
                let held = held.get_or_insert_with(|| Box::new(HeldBounds::none(q)));
                let h = stepper.last_step();
                let from = (stepper.t_before(), stepper.q_before(), stepper.v_before());
                let hold = |t: [f64; 2], MotionBounds { q, v }: &MotionBounds<S::Vector>| {
                    (self.system).assumptions_hold_within(t, [&q[0], &q[1]], [&v[0], &v[1]])
                };
                held.hold_throughout(&hold, (coefficients, h), from)
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
        let mut known = KnownStates::of_searches(count);
        for index in (0..count).filter(|index| places[*index] == Some(Places::All)) {
            let margin = |theta: f64| Ok(self.margin(index, known.at(theta, at)?));
            let may_continue = || event::go_on_unless(shall_stop(event::beginning(stepper)));
            let found = roots::isolating_fractions(margin, may_continue);
            looks.extend(found.map_err(|why| {
                let (t, q, v) = event::beginning(stepper);
                let mut assumptions = self.system.assumptions(t, &q, &v, stepper.inputs());
                let text = assumptions
                    .nth(index)
                    .map_or("?", |assumption| assumption.text);
                why.explain(text, t)
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

    /// Checks that all assumptions hold.
    ///
    /// # Errors
    /// [`Error::AssumptionEnded`], of the first that does not.
    pub(super) fn check_assumptions(&self, state: Triple<S::Vector>) -> Result<(), Error> {
        let t = state.0;
        match self.ended_assumption(state) {
            Some((_, assumption)) => Err(Error::AssumptionEnded { assumption, t }),
            None => Ok(()),
        }
    }

    /// The margin by which an assumption holds; NaN counts as violated.
    fn margin(&self, index: usize, state: Triple<S::Vector>) -> f64 {
        let (t, q, v) = &state;
        let inputs = self.inputs(*t, q, v);
        let margin = self.system.assumptions(*t, q, v, &inputs).nth(index);
        margin.map_or(0.0, |assumption| assumption.margin.max(f64::NEG_INFINITY))
    }
}

#[cfg(test)]
mod tests {
    use core::cell::Cell;
    use std::vec::Vec;

    use super::{HeldBounds, KnownStates, MOST_STATES};
    use crate::taylor::MotionBounds;

    /// Three searches begin with the same 129 fractions and go on with 100 000 of their own. Each evaluates its own, the first one also the common ones, and what is kept is bounded.
    #[test]
    fn states_that_several_searches_share_are_evaluated_once_and_few_are_kept() {
        let (common, own) = (129, 100_000);
        for searches in [1, 3] {
            let mut known = KnownStates::<[f64; 1]>::of_searches(searches);
            let evaluated = Cell::new(0);
            for search in 0..searches {
                let theta_of_common = |k: usize| k as f64 / 128.0;
                // No two of these are the same, and none is a common one.
                let theta_of_own = |k: usize| ((3 * k + search) as f64 + 0.5) / (4 * own) as f64;
                let all = (0..common).map(theta_of_common);
                for theta in all.chain((0..own).map(theta_of_own)) {
                    let found: Result<_, ()> = known.at(theta, |theta| {
                        evaluated.set(evaluated.get() + 1);
                        Ok((theta, [2.0 * theta], [3.0 * theta]))
                    });
                    assert_eq!(found, Ok((theta, [2.0 * theta], [3.0 * theta])));
                }
            }
            let kept = if searches == 1 { 0 } else { MOST_STATES };
            assert_eq!(known.states.len(), kept);
            assert!(known.states.is_sorted_by(|(a, _), (b, _)| a < b));
            assert_eq!(evaluated.get(), common + searches * own);
        }
    }

    /// A motion that swings within bounds of which some are near, `x = middle + size sin t`, in steps of a quarter of a radian: looks are few, since the
    /// bounds of all steps are kept, however little they can be widened.
    #[test]
    fn a_motion_that_repeats_is_looked_at_a_few_times() {
        // By how many of its size the bounds exceed the motion.
        for margin in [100.0, 3.0, 0.5, 0.1] {
            let looks = Cell::new(0);
            let hold = |_: [f64; 2], bounds: &MotionBounds<[f64; 1]>| {
                looks.set(looks.get() + 1);
                let reach = 2.0 + 2.0 * margin;
                -reach < bounds.q[0][0] && bounds.q[1][0] < reach
            };
            let mut held = HeldBounds::none(&[0.0]);
            let h = 0.25;
            for step in 0..1000 {
                let t = h * f64::from(step);
                // c_j = 2 sin(t + j π/2)/j!
                let (mut factorial, mut rows) = (1.0, Vec::new());
                for j in 0..14 {
                    factorial *= f64::from(j.max(1));
                    let phase = t + f64::from(j) * core::f64::consts::FRAC_PI_2;
                    rows.push([2.0 * phase.sin() / factorial]);
                }
                let from = (t, &rows[0], &rows[1]);
                assert!(held.hold_throughout(&hold, (&rows, h), from));
            }
            // The first, one for each of four widenings that fail, and one for each step from one end of the swing to the other. Steps meet each end in another
            // phase every time, and reach farther than ever before in some ln 40 = 4 of 40 swings, to within rounding.
            let most = 1 + 4 + 13 + 2 * 4;
            assert!(looks.get() <= most, "{margin}: {} looks", looks.get());
        }
    }
}
