//! When and how contacts change within a step: gaps that close, forces that vanish, slips that stop or begin.
//!
//! Each step is sampled several times. The instant is searched for on the dense output only where a sample shows that something may have changed since the
//! previous one.

use std::boxed::Box;
use std::vec;
use std::vec::Vec;

use super::{LastInterpolant, Model, Run, VectorOf};
use crate::at::At;
use crate::balance::Quadratures;
use crate::contact::{Clearance, ContactMemory, Margins, Mode, UnilateralState};
use crate::event::{self, Triple, step_motion};
use crate::inputs::InputLaw;
use crate::stepper::Cause;
use crate::{Error, Interpolant, Machine, Stepper, System, roots};

/// Where several contacts share a load in ways that only all together can tell, a change is looked for so far
/// behind the place where it is seen, as a part of the step.
const BEYOND: f64 = 1e-9;

/// Between two looks at a gap no angle that it depends on turns further than this, in rad.
const TURN_BETWEEN_SAMPLES: f64 = 0.5;

/// Between two looks a gap falls no faster than this many times the greatest of its rates at looks.
const MOST_RATE_GROWTH: f64 = 2.0;

/// A gap that falls below zero for less than this part of the time between two looks is taken not to.
const NARROWEST_DIP: f64 = 1e-8;

/// Where a gap is found below zero, it is open this part of the time between two looks before that, or less.
const SHORT_FALL: f64 = 1.0 / 64.0;

/// The most values of a gap between two looks that tell whether it falls below zero.
const MOST_VALUES_OF_GAP: usize = 2000;

/// What opens at a look is looked at from this part of the way to the next one on.
const OPENED: f64 = 1e-3;

/// A flight that begins at a look with no rate beyond rounding is found if it takes at least this part of the step. A gap that does not
/// open falls by more than its rounding by then.
const LEAST_FLIGHT: f64 = 1e-6;

/// The most looks at a step.
const MOST_SAMPLES: f64 = 1e6;

/// Where nothing yet pulls at a contact that begins to slip, the next place to look at is so many times as far.
const LATER: f64 = 4.0;

/// A slip in space that comes to rest, or turns by a right angle, is followed in a step of its own from this part of the way on; and
/// no further where that part of the step is less than the second.
pub(super) const APPROACH: f64 = 0.9;
pub(super) const LEAST_APPROACH: f64 = 1e-9;

/// A change of contacts that is found in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct FoundChange {
    pub cause: Cause,
    /// The contact that changes, or one of several.
    pub contact: usize,
    /// Whether its gap closes.
    pub closes: bool,
}

/// How often the part of a step by series before a change is looked at again, and up to which part of it: at the change itself the gap is 0.
const MOST_REPETITIONS: usize = 8;
const BEFORE_CHANGE: f64 = 0.99;

/// A change after this part of what was looked at needs no second look: about as many looks are before it as in a step of another method.
const ENOUGH: f64 = 0.4;

/// What a look at an instant of a step shows of the contacts.
#[derive(Clone, Debug, Default)]
struct Look {
    /// Where it is in the step, as a part of it.
    theta: f64,
    /// How far every contact is from closing.
    clearances: Vec<Clearance>,
    /// By how much the states of closed contacts hold; not asked of the first look at a step.
    margins: Margins,
}

/// Memory for looks at contacts, which allocate nothing after the first step in which no contact shares its load.
#[derive(Clone, Debug)]
pub(super) struct ContactLooks<V, M> {
    before: Look,
    now: Look,
    /// For each corner of a polygon the greatest rate at which its gap changes at looks at the step; 0 for other contacts.
    falls: Vec<f64>,
    /// Which contacts with two tangents have slipped faster than errors of rates since they began to.
    faster: Vec<bool>,
    memory: Option<Box<ContactMemory<V, M>>>,
}

impl<V, M> Default for ContactLooks<V, M> {
    fn default() -> Self {
        ContactLooks {
            before: Look::default(),
            now: Look::default(),
            falls: Vec::new(),
            faster: Vec::new(),
            memory: None,
        }
    }
}

/// The interval between two looks at a step.
struct Interval<'a> {
    touching: &'a UnilateralState,
    before: &'a Look,
    now: &'a Look,
    falls: &'a [f64],
    /// The length of the step, in s.
    step: f64,
}

impl Interval<'_> {
    /// How far a gap may fall between both looks at this rate.
    fn may_fall(&self, rate: f64) -> f64 {
        MOST_RATE_GROWTH * rate * (self.step * (self.now.theta - self.before.theta))
    }

    /// Whether a contact is looked at for whether it closes.
    fn may_close(&self, k: usize) -> bool {
        self.touching.modes()[k] == Mode::Open && self.touching.carrier(k).is_none()
    }

    /// Whether the looks themselves show that a gap closes, or may have closed and opened again.
    fn closes(&self, k: usize) -> bool {
        let (from, to) = (self.before.clearances[k], self.now.clearances[k]);
        let may_reach = || from.value <= self.may_fall(to.rate.max(-from.rate));
        to.value < 0.0 || self.turns_back(k) && may_reach()
    }

    /// Whether a gap falls at the first look, and opens and is open at the second.
    fn turns_back(&self, k: usize) -> bool {
        let (from, to) = (self.before.clearances[k], self.now.clearances[k]);
        to.value >= 0.0 && from.rate < 0.0 && to.rate > 0.0
    }

    /// Whether a gap begins and ends within its rounding and does not fall by more at first. What has just opened, slowly, is open or closed by rounding for a
    /// while, and what it does can be told when it has left that.
    fn stays_within(&self, rounding: f64, k: usize) -> bool {
        let (from, to) = (self.before.clearances[k], self.now.clearances[k]);
        let falls = self.may_fall((-from.rate).max(0.0));
        from.value.abs() <= rounding && to.value.abs() <= rounding && falls <= rounding
    }

    /// Whether the gap of a corner may have been closed in between.
    fn may_dip(&self, k: usize) -> bool {
        let least = (self.before.clearances[k].value).min(self.now.clearances[k].value);
        let fall = self.may_fall(self.falls[k]);
        fall > 0.0 && least < fall
    }

    /// The margins of closed contacts that are lost at the second look, each with its kind.
    fn doubtful_margins(&self) -> impl Iterator<Item = (usize, usize)> {
        let each = &self.now.margins.each;
        let of_contact = move |k: usize| {
            let own: [crate::contact::Margin; 4] = each[k];
            (0..4).filter_map(move |kind| (own[kind].value < 0.0).then_some((k, kind)))
        };
        (self.touching.in_order().filter(move |k| *k < each.len())).flat_map(of_contact)
    }

    /// Whether something may have changed.
    fn is_suspicious(&self) -> bool {
        let may_close = |k: usize| self.may_close(k) && (self.closes(k) || self.may_dip(k));
        (0..self.touching.modes().len()).any(may_close) || self.doubtful_margins().next().is_some()
    }
}

/// The earlier of a change that is known and another one.
fn earlier(known: &mut Option<(f64, FoundChange)>, theta: f64, change: FoundChange) {
    if known.is_none_or(|(known, _)| theta < known) {
        *known = Some((theta, change));
    }
}

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// When contacts change in the last step, and how.
    pub(super) fn contact_found(
        &mut self,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<Option<(f64, FoundChange)>, Error> {
        let mut looks = core::mem::take(&mut self.contact_looks);
        let found = self.first_change(&mut looks, interpolant);
        self.contact_looks = looks;
        found
    }

    /// [`contact_found`](Self::contact_found) with this memory. A step by series may be many times as long as the motion up to the change, with few looks before it:
    /// that part is then looked at again.
    fn first_change(
        &mut self,
        looks: &mut ContactLooks<VectorOf<M>, <M::System as System>::Matrix>,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<Option<(f64, FoundChange)>, Error> {
        let mut first = self.contact_found_with(looks, interpolant, 1.0)?;
        if self.stepper.coefficients().is_none() {
            return Ok(first);
        }
        let mut looked_at = 1.0;
        for _ in 0..MOST_REPETITIONS {
            let Some((t, _)) = first else {
                break;
            };
            let until = (t - self.stepper.t_before()) / self.stepper.last_step();
            if until > ENOUGH * looked_at {
                break;
            }
            looked_at = until;
            let earlier = self.contact_found_with(looks, interpolant, BEFORE_CHANGE * until)?;
            if earlier.is_none_or(|(earlier, _)| earlier >= t) {
                break;
            }
            first = earlier;
        }
        Ok(first)
    }

    /// When contacts change in this part of the last step, from its beginning on.
    fn contact_found_with(
        &mut self,
        looks: &mut ContactLooks<VectorOf<M>, <M::System as System>::Matrix>,
        interpolant: &mut LastInterpolant<M>,
        part: f64,
    ) -> Result<Option<(f64, FoundChange)>, Error> {
        let ContactLooks {
            before,
            now,
            falls,
            faster,
            memory,
        } = looks;
        let system = self.model.system;
        self.stepper.keep_near();
        let Some(touching) = self.stepper.touching() else {
            return Ok(None);
        };
        let memory = memory
            .get_or_insert_with(|| Box::new(ContactMemory::new(touching, self.stepper.q_before())));
        before.theta = 0.0;
        let place = (
            self.stepper.t_before(),
            self.stepper.q_before(),
            self.stepper.v_before(),
        );
        touching.write_clearances(system, place, memory, &mut before.clearances);
        let count = count_of_looks(system, &self.stepper, memory);
        let thetas = (1..=count).map(|look| part * (look as f64 / count as f64));
        self.write_falls(
            thetas.clone(),
            (&before.clearances, &mut now.clearances),
            memory,
            falls,
        );
        for theta in thetas {
            now.theta = theta;
            self.look(now, memory)?;
            let Some(touching) = self.stepper.touching() else {
                return Ok(None);
            };
            let step = self.stepper.last_step().abs();
            let interval = Interval {
                touching,
                before,
                now,
                falls,
                step,
            };
            if interval.is_suspicious() {
                // The stepper is asked for dense output meanwhile, which evaluates the contacts.
                let touching = touching.clone();
                let interval = Interval {
                    touching: &touching,
                    before,
                    now,
                    falls,
                    step,
                };
                let found = self.change_between(&interval, interpolant)?;
                if found.is_some() {
                    return Ok(found);
                }
            }
            core::mem::swap(before, now);
        }
        if part < 1.0 {
            return Ok(None);
        }
        let faded = self.stepper.faded_slip(memory, faster);
        let faded = faded
            .map_err(|error| (self.model).explain(error, self.stepper.q(), self.stepper.v()))?;
        Ok(faded.map(|k| {
            let change = FoundChange {
                cause: Cause::Stops(k),
                contact: k,
                closes: false,
            };
            (self.stepper.t(), change)
        }))
    }

    /// Looks at an instant of the last step.
    fn look(
        &self,
        look: &mut Look,
        memory: &mut ContactMemory<VectorOf<M>, <M::System as System>::Matrix>,
    ) -> Result<(), Error> {
        let Self { model, stepper, .. } = self;
        let Some(touching) = stepper.touching() else {
            return Ok(());
        };
        let (t, q, v) = event::interpolated_at(stepper, look.theta);
        touching.write_clearances(model.system, (t, &q, &v), memory, &mut look.clearances);
        if touching.is_free() {
            look.margins.each.clear();
            return Ok(());
        }
        let inputs = model.inputs(t, &q, &v);
        let at = At {
            t,
            q: &q,
            v: &v,
            u: &inputs,
        };
        touching
            .write_margins(model.system, at, memory, &mut look.margins)
            .map_err(|error| model.explain(error, &q, &v))
    }

    /// The gap of polygons is a greatest distance: it may fall below zero and come back between two looks. How far it may fall is told by
    /// the greatest of its rates, for which the whole step is looked at first.
    fn write_falls(
        &self,
        thetas: impl Iterator<Item = f64>,
        (before, now): (&[Clearance], &mut Vec<Clearance>),
        memory: &mut ContactMemory<VectorOf<M>, <M::System as System>::Matrix>,
        falls: &mut Vec<f64>,
    ) {
        let Self { model, stepper, .. } = self;
        let system = model.system;
        falls.clear();
        falls.resize(before.len(), 0.0);
        let Some(touching) = stepper.touching() else {
            return;
        };
        let corners = || {
            let contacts = system.unilateral_contacts().enumerate();
            let is_open = |k: usize| touching.modes()[k] == Mode::Open;
            contacts.filter_map(move |(k, one)| (one.has_face && is_open(k)).then_some(k))
        };
        if corners().next().is_none() {
            return;
        }
        for theta in thetas {
            let (t, q, v) = event::interpolated_at(stepper, theta);
            touching.write_clearances(system, (t, &q, &v), memory, now);
            for k in corners() {
                falls[k] = falls[k].max(now[k].rate.abs()).max(before[k].rate.abs());
            }
        }
    }

    /// When contacts change first between two looks, and how.
    fn change_between(
        &mut self,
        interval: &Interval<'_>,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<Option<(f64, FoundChange)>, Error> {
        let mut earliest = None;
        for k in interval.touching.in_order() {
            if interval.may_close(k)
                && let Some((theta, change)) = self.closing_found(interval, interpolant, k)?
            {
                earlier(&mut earliest, theta, change);
            }
        }
        self.find_lost_margins(interval, interpolant, &mut earliest)?;
        let Self { model, stepper, .. } = self;
        Ok(match earliest {
            None => None,
            Some((0.0, change)) => Some((stepper.t_before(), change)),
            Some((theta, change)) => {
                let interpolant = step_motion(interpolant, stepper, model.system)?;
                Some((interpolant.time_at(theta), change))
            }
        })
    }

    /// When an open contact closes between two looks, if it does.
    fn closing_found(
        &mut self,
        interval: &Interval<'_>,
        interpolant: &mut LastInterpolant<M>,
        k: usize,
    ) -> Result<Option<(f64, FoundChange)>, Error> {
        let Self { model, stepper, .. } = self;
        let (system, touching) = (model.system, interval.touching);
        let roundoff = event::theta_roundoff(stepper);
        let beginning = (stepper.t_before(), stepper.q_before(), stepper.v_before());
        let mut between = [interval.before.theta, interval.now.theta];
        let mut closes = interval.closes(k);
        if interval.may_dip(k) {
            let gap = |theta: f64| {
                let (t, q, v) = event::interpolated_at(stepper, theta);
                Ok(touching.clearance_of(system, (t, &q, &v), k).value)
            };
            let fall_of_step = MOST_RATE_GROWTH * interval.falls[k] * stepper.last_step().abs();
            let rounding = touching.gap_rounding(system, beginning, k);
            if let Some(fallen) = find_penetration(between, (fall_of_step, rounding), gap)? {
                (between, closes) = (fallen, true);
            }
        }
        if !closes {
            return Ok(None);
        }
        let rounding = touching.gap_rounding(system, beginning, k);
        if !touching.is_compliant(k) && interval.stays_within(rounding, k) {
            return Ok(None);
        }
        let interpolant = step_motion(interpolant, stepper, system)?;
        let stepper = &*stepper;
        if !touching.is_compliant(k) && interval.turns_back(k) {
            let (t, q, v) = state_within(system, stepper, interpolant, between[0])?;
            if touching.rests_at_gap(system, (t, &q, &v), k) {
                // Forces have opened it, and open it further: the rate at which it falls at first is what rounding makes of rest, however slowly the forces grow.
                return Ok(None);
            }
        }
        let at = |theta: f64| {
            let (t, q, v) = state_within(system, stepper, interpolant, theta)?;
            let near = touching.clearance_of(system, (t, &q, &v), k);
            Ok([near.value, near.rate])
        };
        let is_compliant = touching.is_compliant(k);
        let found = if is_compliant {
            find_loading_start(between, roundoff, at)?
        } else {
            closing(between, (roundoff, rounding), at)?
        };
        let change = FoundChange {
            cause: if is_compliant {
                Cause::Presses(k)
            } else {
                Cause::Unspecified
            },
            contact: k,
            closes: true,
        };
        Ok(found.map(|found| (found, change)))
    }

    /// When margins of closed contacts are lost between two looks, if that is before the `earliest` change.
    fn find_lost_margins(
        &mut self,
        interval: &Interval<'_>,
        interpolant: &mut LastInterpolant<M>,
        earliest: &mut Option<(f64, FoundChange)>,
    ) -> Result<(), Error> {
        if interval.doubtful_margins().next().is_none() {
            return Ok(());
        }
        let Self { model, stepper, .. } = self;
        let roundoff = event::theta_roundoff(stepper);
        let interpolant = step_motion(interpolant, stepper, model.system)?;
        let search = MarginSearch {
            model,
            stepper,
            interpolant,
            touching: interval.touching,
            between: [interval.before.theta, interval.now.theta],
            roundoff,
        };
        // At both looks, the same for all margins that are doubtful.
        let ends = search.between.map(|theta| search.margins(theta));
        let [at_first, at_second] = ends;
        let (at_first, at_second) = (at_first?, at_second?);
        for (k, kind) in interval.doubtful_margins() {
            let [first, second] = [&at_first, &at_second].map(|margins| margins.each[k][kind]);
            let slips = kind == 1 && matches!(interval.touching.modes()[k], Mode::Slides(_));
            // A slip that has turned may still have its former direction, by the error with which the instant of that is known. It then loses this first.
            let is_turning = slips && first.value < 0.0 && second.value > first.value;
            if second.is_lost_since(first) && !is_turning {
                let (found, cause) = search.lost(k, kind, at_second.shares[k])?;
                let change = FoundChange {
                    cause,
                    contact: k,
                    closes: false,
                };
                earlier(earliest, found, change);
            }
        }
        Ok(())
    }
}

/// A search for the instants at which margins of closed contacts are lost between two looks.
struct MarginSearch<'a, 'r, 's, S: System, L, R, A> {
    model: &'a Model<'r, S, L>,
    stepper: &'a Stepper<'s, S, R, A>,
    interpolant: &'a Interpolant<S::Vector>,
    touching: &'a UnilateralState,
    between: [f64; 2],
    roundoff: f64,
}

impl<S, L, R, A> MarginSearch<'_, '_, '_, S, L, R, A>
where
    S: System,
    L: InputLaw<S>,
    R: InputLaw<S>,
    A: Quadratures<S>,
{
    fn state(&self, theta: f64) -> Result<Triple<S::Vector>, Error> {
        state_within(self.model.system, self.stepper, self.interpolant, theta)
    }

    fn margins(&self, theta: f64) -> Result<Margins, Error> {
        let (t, q, v) = self.state(theta)?;
        let at = At {
            t,
            q: &q,
            v: &v,
            u: &self.model.inputs(t, &q, &v),
        };
        let margins = self.touching.margins(self.model.system, at);
        margins.map_err(|error| self.model.explain(error, &q, &v))
    }

    /// The direction in which a contact that sticks is pulled, if anything pulls it.
    fn pull(&self, k: usize, theta: f64) -> Result<Option<[f64; 2]>, Error> {
        let (t, q, v) = self.state(theta)?;
        let at = At {
            t,
            q: &q,
            v: &v,
            u: &self.model.inputs(t, &q, &v),
        };
        let pull = self.touching.pull_along(self.model.system, at, k);
        pull.map_err(|error| self.model.explain(error, &q, &v))
    }

    /// When a margin of this kind of a contact is lost, and what that means. `shares` tells whether the contact shares its load.
    fn lost(&self, k: usize, kind: usize, shares: bool) -> Result<(f64, Cause), Error> {
        let [_, end] = self.between;
        let margin = |theta| Ok(self.margins(theta)?.each[k][kind].value);
        let found = event::last_positive(self.between, self.roundoff, &mut &margin)?;
        // Where a face ends and when a slip stops is seen in the motion itself, however a load is shared.
        let mode = self.touching.modes()[k];
        let is_of_motion = kind == 3 || kind == 1 && matches!(mode, Mode::Slides(_));
        if shares && !is_of_motion && (kind == 1 || !self.touching.is_compliant(k)) {
            return Ok(((found + BEYOND).min(end), Cause::Unspecified));
        }
        let cause = match (mode, kind) {
            (_, 3) => Cause::Leaves(k),
            (_, 0) if self.touching.is_guide(k) => Cause::Switches(k),
            (_, 0) => Cause::Lifts(k),
            (_, 2) => Cause::Turns(k),
            (Mode::Slides(_) | Mode::SlidesAlong(_), _) => Cause::Stops(k),
            _ => {
                let pull = |theta| self.pull(k, theta);
                Cause::Breaks(k, beginning_slip([found, end], self.roundoff, pull)?)
            }
        };
        if cause == Cause::Stops(k) && found > LEAST_APPROACH {
            let (t, q, v) = self.state(found)?;
            if !self.touching.is_slow(self.model.system, (t, &q, &v), k) {
                // It has turned, or stops where the step is too long to tell: up to shortly before.
                return Ok((APPROACH * found, Cause::Unspecified));
            }
        }
        Ok((found, cause))
    }
}

/// The state at a part of the last step, by dense output within it.
fn state_within<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    system: &S,
    stepper: &Stepper<'_, S, L, A>,
    interpolant: &Interpolant<S::Vector>,
    theta: f64,
) -> Result<Triple<S::Vector>, Error> {
    if theta == 0.0 {
        let (q, v) = (stepper.q_before().clone(), stepper.v_before().clone());
        return Ok((stepper.t_before(), q, v));
    }
    event::state_at(system, stepper, interpolant, theta)
}

/// The direction in which a contact begins to slip whose friction is used up `from` there: it is pulled in this direction there or, if nothing pulls it
/// yet, as where it has no friction and the force on it begins to grow, just after that. `to` is where it is seen.
fn beginning_slip(
    [from, to]: [f64; 2],
    roundoff: f64,
    mut pull: impl FnMut(f64) -> Result<Option<[f64; 2]>, Error>,
) -> Result<[f64; 2], Error> {
    if let Some(direction) = pull(from)? {
        return Ok(direction);
    }
    let mut part = roundoff;
    while part < to - from {
        if let Some(direction) = pull(from + part)? {
            return Ok(direction);
        }
        part *= LATER;
    }
    Ok(pull(to)?.unwrap_or_default())
}

/// Where a gap with kinks that is open at a look first falls below zero before another one: from where it is open to where it is below zero. It falls
/// no faster than by `fall` in a step. Values within `rounding` of zero say nothing: where a gap begins to open, they are negative and positive in turn.
///
/// The bound tells where between two values there can be none below zero, so that none is missed between the kinks (S. A. Piyavskii, USSR Comput. Math. Math.
/// Phys. 12 (1972) 57–67; B. O. Shubert, SIAM J. Numer. Anal. 9 (1972) 379–388).
fn find_penetration(
    [from, to]: [f64; 2],
    (fall, rounding): (f64, f64),
    mut gap: impl FnMut(f64) -> Result<f64, Error>,
) -> Result<Option<[f64; 2]>, Error> {
    let mut first = (from, gap(from)?);
    if first.1 <= 0.0 {
        let opened = from + OPENED * (to - from);
        first = (opened, gap(opened)?);
        if first.1 <= 0.0 {
            return Ok(None);
        }
    }
    let narrowest = NARROWEST_DIP * (to - from);
    // The ends of intervals that follow the first one, the next one last.
    let mut ends = vec![(to, gap(to)?)];
    let mut left = MOST_VALUES_OF_GAP;
    while let Some(&(end, value)) = ends.last() {
        let (start, before) = first;
        let width = end - start;
        let is_fallen = value < -rounding;
        if is_fallen && width <= SHORT_FALL * (to - from) {
            return Ok(Some([start, end]));
        }
        let least = 0.5 * (before + value - fall * width);
        if !is_fallen && (least >= -rounding || width <= narrowest) {
            first = (end, value);
            ends.pop();
            continue;
        }
        if left == 0 {
            break;
        }
        left -= 1;
        let middle = 0.5 * (start + end);
        let place = if is_fallen {
            middle
        } else {
            // Where the gap could be least.
            middle + 0.5 * (before - value) / fall
        };
        ends.push((place, gap(place)?));
    }
    match ends.last() {
        None => return Ok(None),
        Some(&(end, value)) if value < -rounding => return Ok(Some([first.0, end])),
        Some(_) => {}
    }
    // The gap is next to zero over much of the step.
    let mut extent = [None; 2];
    roots::extremes(gap, [first.0, to], &mut extent, [true, false])?;
    let least = extent[0].filter(|(least, _)| *least < -rounding);
    Ok(least.map(|(_, place)| [first.0, place]))
}

/// Into how many parts the looks at contacts divide the last step: four, and more where something turns far that a gap depends on. Steps by series are longer: a harmonic
/// motion advances by up to 2.5 rad with 14 coefficients, and 4.2 rad with 22, so half as many looks as there are coefficients are taken in the longest step that the
/// tolerance allows, and as many a second in a shorter one.
fn count_of_looks<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    system: &S,
    stepper: &Stepper<'_, S, L, A>,
    memory: &mut ContactMemory<S::Vector, S::Matrix>,
) -> usize {
    let of_series = stepper.coefficients().map_or(0.0, |coefficients| {
        (0.5 * coefficients.len() as f64 * stepper.part_of_tolerable()).ceil()
    });
    let fewest = event::SAMPLE_FRACTIONS.len().max(of_series as usize);
    let at_once = fewest as f64 * TURN_BETWEEN_SAMPLES;
    if event::turn(system, stepper, |_| true) <= at_once {
        return fewest;
    }
    let place = (stepper.t(), stepper.q());
    let turn = event::turn(system, stepper, memory.gap_depends_on(system, place));
    (turn / TURN_BETWEEN_SAMPLES)
        .ceil()
        .clamp(fewest as f64, MOST_SAMPLES) as usize
}

/// Where a gap closes between two looks at an open contact, if it does: not before it has opened, where it begins
/// closed, and not where it comes near and goes away again. A gap is known up to a `rounding`.
fn closing(
    [from, to]: [f64; 2],
    (roundoff, rounding): (f64, f64),
    mut at: impl FnMut(f64) -> Result<[f64; 2], Error>,
) -> Result<Option<f64>, Error> {
    let [gap, rate] = at(from)?;
    let [gap_after, rate_after] = at(to)?;
    let mut open = from;
    if gap <= rounding && gap_after < 0.0 && rate > 0.0 && rate_after < 0.0 {
        // It opens first: up to where it is greatest.
        open = event::root([from, to], roundoff, &mut |theta| Ok(at(theta)?[1]))?;
        if at(open)?[0] <= rounding {
            // So low a flight is known by its rates only, which change evenly in it.
            return Ok(Some((2.0 * open - from).min(to)));
        }
    } else if gap <= 0.0 {
        if gap_after >= 0.0 {
            return Ok(None);
        }
        if let Some(opened) = find_open([from, to], LEAST_FLIGHT, &mut at)? {
            // It opens by its acceleration alone: the rate is rounding.
            open = opened;
        } else {
            return Ok(Some(if rate <= 0.0 { from } else { to }));
        }
    }
    if gap_after < 0.0 {
        let found = event::root([open, to], roundoff, &mut |theta| Ok(at(theta)?[0]))?;
        return Ok(Some(found));
    }
    if rate < 0.0 && rate_after > 0.0 {
        let nearest = event::root([open, to], roundoff, &mut |theta| Ok(at(theta)?[1]))?;
        // A gap that falls for at most 1e-6 of the step before it opens falls by at most 1e-12 of its later opening: its rate at the start was
        // round-off, and nothing closes.
        let is_rounding = nearest - from <= LEAST_FLIGHT;
        if !is_rounding && at(nearest)?[0] < 0.0 {
            let found = event::root([open, nearest], roundoff, &mut |theta| Ok(at(theta)?[0]))?;
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// Where what is closed at the first of two looks is open between them, if it is: at the half, quarter, eighth, … of the way, no
/// closer to its beginning than `least`.
fn find_open(
    [from, to]: [f64; 2],
    least: f64,
    at: &mut impl FnMut(f64) -> Result<[f64; 2], Error>,
) -> Result<Option<f64>, Error> {
    let mut part = 0.5 * (to - from);
    while part > least {
        if at(from + part)?[0] > 0.0 {
            return Ok(Some(from + part));
        }
        part *= 0.5;
    }
    Ok(None)
}

/// Where a contact that yields begins to press between two looks, if it does.
fn find_loading_start(
    [from, to]: [f64; 2],
    roundoff: f64,
    mut at: impl FnMut(f64) -> Result<[f64; 2], Error>,
) -> Result<Option<f64>, Error> {
    let [clearance, rate] = at(from)?;
    let [clearance_after, rate_after] = at(to)?;
    if clearance_after < 0.0 {
        let mut open = from;
        if clearance <= 0.0 {
            // It has just opened, and goes on doing so for a while; or it is pressed from here on.
            match find_open([from, to], roundoff, &mut at)? {
                Some(opened) => open = opened,
                None => return Ok(Some(from)),
            }
        }
        let found = event::root([open, to], roundoff, &mut |theta| Ok(at(theta)?[0]))?;
        return Ok(Some(found));
    }
    if clearance >= 0.0 && rate < 0.0 && rate_after > 0.0 {
        let nearest = event::root([from, to], roundoff, &mut |theta| Ok(at(theta)?[1]))?;
        if at(nearest)?[0] < 0.0 {
            let found = event::root([from, nearest], roundoff, &mut |theta| Ok(at(theta)?[0]))?;
            return Ok(Some(found));
        }
    }
    Ok(None)
}
