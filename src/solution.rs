//! The result of a run.

mod choice;
pub(crate) mod handover;
mod steps;

pub use choice::{MethodChoice, MethodReason};
pub use handover::Handover;
pub(crate) use steps::Steps;

use core::fmt::{self, Debug};
use std::string::String;
use std::vec::Vec;

use crate::at::At;
use crate::constraints::Constraints;
use crate::contact::{ContactMemory, Mode};
use crate::event::{Event, state};
use crate::friction::Contacts;
use crate::inputs::{DefaultInputs, InputLaw};
use crate::interpolant::Interpolant;
use crate::methods::{Method, MethodKind};
use crate::observation::{ConstraintState, Observation};
use crate::phases::{Phase, UnilateralRecord};
use crate::piece::Piece;
use crate::settings::Settings;
use crate::step_error::StepError;
use crate::stepper::project;
use crate::{
    ContactEnergies, ContactEvent, ContactPhase, ContactTally, Coordinates, Energies,
    EnergyBalance, Error, Inputs, Machine, State, System, Vector, Warning,
};

/// The result of a run: the state of the machine at every instant, and its events.
///
/// Between the ends of a step the motion is as accurate as at them: [`at`](Self::at) evaluates the dense output of the method,
/// which is kept unless [`forget_steps`](crate::Simulation::forget_steps) is called.
pub struct Solution<M: Machine, L = DefaultInputs> {
    pub(crate) law: L,
    pub(crate) results: Results<M>,
}

/// The results of a run, apart from the law that drove it.
pub(crate) struct Results<M: Machine> {
    pub(crate) system: M::System,
    pub(crate) method: &'static Method,
    pub(crate) start: State<Coordinates<M>>,
    pub(crate) end: State<Coordinates<M>>,
    pub(crate) steps: Option<Steps<VectorOf<M>>>,
    pub(crate) samples: Vec<State<Coordinates<M>>>,
    pub(crate) events: Vec<Event<Coordinates<M>>>,
    pub(crate) energies: Vec<Energies>,
    pub(crate) balance: Option<EnergyBalance>,
    pub(crate) statistics: Statistics,
    pub(crate) warnings: Vec<Warning>,
    pub(crate) ending: Ending,
    /// The settings of the simulation, and the step length with which it would have continued.
    pub(crate) settings: Settings,
    pub(crate) next_step: f64,
    pub(crate) constraints: Option<Constraints<VectorOf<M>>>,
    /// The states of the guided contacts, each with the time from which it holds.
    pub(crate) contacts: Vec<(f64, Contacts)>,
    /// The inputs that a sampled controller set, each with the time from which they hold.
    pub(crate) sampled_inputs: Vec<(f64, Inputs<M>)>,
    /// The intervals of time in which the inputs are smooth, in the order of the run; empty if they are smooth throughout.
    pub(crate) pieces: Vec<Piece>,
    /// Record of the unilateral contacts.
    pub(crate) unilateral: UnilateralRecord<Coordinates<M>, VectorOf<M>>,
    /// When the run changed to time stepping and back.
    pub(crate) handovers: Vec<Handover>,
    /// The methods that were chosen.
    pub(crate) choices: Vec<MethodChoice>,
}

impl<M: Machine<System: Clone>, L: Clone> Clone for Solution<M, L> {
    fn clone(&self) -> Self {
        Self {
            law: self.law.clone(),
            results: self.results.clone(),
        }
    }
}

impl<M: Machine<System: Clone>> Clone for Results<M> {
    fn clone(&self) -> Self {
        Self {
            system: self.system.clone(),
            method: self.method,
            start: self.start.clone(),
            end: self.end.clone(),
            steps: self.steps.clone(),
            samples: self.samples.clone(),
            events: self.events.clone(),
            energies: self.energies.clone(),
            balance: self.balance,
            statistics: self.statistics,
            warnings: self.warnings.clone(),
            ending: self.ending.clone(),
            settings: self.settings.clone(),
            next_step: self.next_step,
            constraints: self.constraints.clone(),
            contacts: self.contacts.clone(),
            sampled_inputs: self.sampled_inputs.clone(),
            pieces: self.pieces.clone(),
            unilateral: self.unilateral.clone(),
            handovers: self.handovers.clone(),
            choices: self.choices.clone(),
        }
    }
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Ending {
    /// At the time given by `until`.
    End,
    /// At the event of this name.
    Event(String),
    /// At the end of a step after which the condition of `stop_if` held.
    Stopped,
    /// By an error.
    Error,
}

/// The cost of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Statistics {
    /// Steps taken.
    pub steps: usize,
    /// Steps that were rejected because their error was too large.
    pub rejected: usize,
    /// Evaluations of the accelerations.
    pub evaluations: usize,
    /// The greatest residual of the constraints after any step, relative to the size of their
    /// terms: see [`Stepper::constraint_residual`](crate::Stepper::constraint_residual).
    pub constraint_residual: f64,
    /// When the motion was first detected to be stiff, in s: from then on the stability of the method and not its accuracy limits the
    /// steps. `None` if it was not, or if the method is implicit or has no stiffness test.
    pub stiff_since: Option<f64>,
    /// Wall-clock time, in s.
    pub seconds: f64,
}

/// The results of a run and the error that ended it early, or an error if it could not begin.
pub(crate) type RunResult<M> = Result<(Results<M>, Option<Error>), Error>;

impl<M: Machine> Results<M> {
    /// Adds the law that drove the run.
    pub(crate) fn with_law<L>(self, law: L) -> Solution<M, L> {
        Solution { law, results: self }
    }
}

impl<M: Machine, L: InputLaw<M::System>> Solution<M, L> {
    /// The state at time `t`, from the beginning of the run to its end.
    ///
    /// For many times [`at_each`](Self::at_each) is cheaper.
    pub fn at(&self, t: f64) -> Result<State<Coordinates<M>>, Error> {
        self.sampler().at(t)
    }

    /// The states at several times; cheapest if the times are sorted.
    pub fn at_each(
        &self,
        times: impl IntoIterator<Item = f64>,
    ) -> Result<Vec<State<Coordinates<M>>>, Error> {
        let mut sampler = self.sampler();
        times.into_iter().map(|t| sampler.at(t)).collect()
    }

    /// The states at the beginning, every `interval` seconds after it, and at the end.
    pub fn every(&self, interval: f64) -> Result<Vec<State<Coordinates<M>>>, Error> {
        if !(interval > 0.0 && interval.is_finite()) {
            return Err(Error::InvalidSetting {
                setting: "every",
                value: interval,
                needed: "greater than 0",
            });
        }
        let interval = interval.copysign(self.results.end.t - self.results.start.t);
        let mut states = Vec::new();
        let mut sampler = self.sampler();
        for i in 0.. {
            let t = self.results.start.t + f64::from(i) * interval;
            if is_beyond(t, self.results.end.t, interval) {
                break;
            }
            states.push(sampler.at(t)?);
        }
        states.push(self.results.end.clone());
        Ok(states)
    }

    /// Accelerations, inputs, outputs and energies at time `t`.
    pub fn observe(&self, t: f64) -> Result<Observation<M>, Error> {
        self.observe_state(&self.at(t)?)
    }

    /// Accelerations, inputs, outputs and energies of the machine in a given state, with the inputs
    /// of this run.
    pub fn observe_state(&self, state: &State<Coordinates<M>>) -> Result<Observation<M>, Error> {
        let (q, v) = (
            self.results.system.to_vector(&state.q),
            self.results.system.to_vector(&state.v),
        );
        let inputs = self.inputs(state.t, &q, &v);
        if !self.results.unilateral.phases.is_empty() && self.phase_at(state.t).is_none() {
            return Err(Error::ContactsForgotten { t: state.t });
        }
        self.constraint_state_at(state.t)
            .observe::<M>(&self.results.system, state, inputs)
    }

    /// The energies at several times, if the simulation kept the energy balance; cheapest if the times are sorted.
    ///
    /// Work and dissipation since the beginning of a step are integrated over its dense output.
    pub fn energies_at_each(
        &self,
        times: impl IntoIterator<Item = f64>,
    ) -> Result<Vec<Energies>, Error> {
        let mut sampler = self.sampler();
        times.into_iter().map(|t| sampler.energies(t)).collect()
    }

    /// A sampler that evaluates the run at many times and remembers the last step that it used.
    fn sampler(&self) -> Sampler<'_, M, L> {
        Sampler {
            run: self,
            interpolant: None,
        }
    }

    fn inputs(&self, t: f64, q: &VectorOf<M>, v: &VectorOf<M>) -> Inputs<M> {
        // With contacts the change is exactly at its instant, as that of the contacts is.
        let is_from = |since: f64| since <= t || (!self.has_contacts() && is_near(since, t));
        let after = self
            .results
            .sampled_inputs
            .partition_point(|(since, _)| is_from(*since));
        let held = after
            .checked_sub(1)
            .and_then(|at| self.results.sampled_inputs.get(at));
        let mut inputs = match held {
            Some((_, held)) if !self.law.is_partial() => return held.clone(),
            Some((_, held)) => held.clone(),
            None => self.results.system.default_inputs(),
        };
        let piece = self.piece_from(t);
        self.law
            .set_in(piece, &self.results.system, t, q, v, &mut inputs);
        inputs
    }

    /// Whether states of contacts are known, which change at exact instants.
    fn has_contacts(&self) -> bool {
        !self.results.contacts.is_empty() || !self.results.unilateral.phases.is_empty()
    }

    /// The piece that contains a time. At the end of the run it is the one that follows there, so that the values after a jump hold as at every
    /// other instant; but forces of contacts are those of the state in which the run leaves them, with the inputs before the jump.
    fn piece_from(&self, t: f64) -> Piece {
        let piece = self.piece_at(t);
        let forward = self.results.end.t >= self.results.start.t;
        let end = piece.end(forward);
        if t != self.results.end.t || self.has_contacts() || !end.is_finite() || !is_near(end, t) {
            return piece;
        }
        let order = self.results.method.tableau.order;
        let following = self.law.piece(end, forward, order).ok();
        // What is not known after the last row of a table is known at this row.
        let at_row = || self.law.piece(t, !forward, order).ok().map(|_| Piece::ALL);
        following.or_else(at_row).unwrap_or(piece)
    }

    /// Whether inputs change during the run.
    #[cfg(feature = "interpreter")]
    pub(crate) fn is_driven(&self) -> bool {
        !self.results.sampled_inputs.is_empty() || !self.law.is_constant()
    }

    /// The piece that contains a time; the later one if two pieces meet there to rounding.
    fn piece_at(&self, t: f64) -> Piece {
        let pieces = &self.results.pieces;
        let is_from = |piece: &Piece| piece.from <= t || is_near(piece.from, t);
        let is_forward = pieces.first().zip(pieces.last());
        let index = if is_forward.is_none_or(|(first, last)| first.from <= last.from) {
            pieces.partition_point(is_from).checked_sub(1)
        } else {
            Some(pieces.partition_point(|piece| !is_from(piece)))
        };
        let containing = index.and_then(|place| pieces.get(place));
        let containing = containing.filter(|piece| t <= piece.to || is_near(piece.to, t));
        containing.copied().unwrap_or(Piece::ALL)
    }

    /// The constraints and contacts that were in force at a time.
    fn constraint_state_at(&self, t: f64) -> ConstraintState<'_, VectorOf<M>> {
        ConstraintState {
            constraints: &self.results.constraints,
            contacts: self.contacts_at(t),
            touching: self.phase_at(t).map(|phase| &phase.touching),
        }
    }

    fn accelerations(
        &self,
        t: f64,
        q: &VectorOf<M>,
        v: &VectorOf<M>,
        a: &mut VectorOf<M>,
    ) -> Result<Inputs<M>, StepError> {
        let u = self.inputs(t, q, v);
        self.constraint_state_at(t).accelerations(
            &self.results.system,
            At { t, q, v, u: &u },
            a,
        )?;
        Ok(u)
    }

    /// The states of the guided contacts at a time within the run.
    fn contacts_at(&self, t: f64) -> Option<&Contacts> {
        let after = self
            .results
            .contacts
            .partition_point(|(since, _)| *since <= t);
        let (_, known) = self.results.contacts.get(after.saturating_sub(1))?;
        Some(known)
    }

    /// Projects a state within the run onto the constraints.
    fn project(&self, t: f64, (mut q, mut v): Pair<M>) -> Result<Pair<M>, Error> {
        if M::System::MAY_COLLIDE
            && let Some(phase) = self.phase_at(t)
        {
            let constrained = phase.touching.machine(&self.results.system);
            project(&constrained, &phase.constraints, t, &mut q, &mut v)
                .map_err(|error| phase.touching.explain(&self.results.system, error))
                .map_err(|error| Error::of_step(error, &self.results.system))?;
            return Ok((q, v));
        }
        project(
            &self.results.system,
            &self.results.constraints,
            t,
            &mut q,
            &mut v,
        )
        .map_err(|error| Error::of_step(error, &self.results.system))?;
        Ok((q, v))
    }
}

impl<M: Machine, L> Solution<M, L> {
    /// The state at the beginning.
    pub fn start(&self) -> &State<Coordinates<M>> {
        &self.results.start
    }

    /// The state at the end.
    pub fn end(&self) -> &State<Coordinates<M>> {
        &self.results.end
    }

    /// How the run ended.
    pub fn ending(&self) -> &Ending {
        &self.results.ending
    }

    /// The states at the beginning and at the end of every step; empty if the steps were forgotten.
    pub fn steps(&self) -> impl Iterator<Item = State<Coordinates<M>>> {
        let beginnings = self.results.steps.iter().flat_map(|steps| {
            let is_step = |i: &usize| steps.times[*i].1 != 0.0;
            (0..steps.count()).filter(is_step).map(|i| {
                let (q, v) = steps.beginning(i);
                state(
                    &self.results.system,
                    (steps.times[i].0.high, q.clone(), v.clone()),
                )
            })
        });
        beginnings.chain(
            self.results
                .steps
                .is_some()
                .then(|| self.results.end.clone()),
        )
    }

    /// The states requested by `every` of the simulation.
    pub fn samples(&self) -> &[State<Coordinates<M>>] {
        &self.results.samples
    }

    /// The events, in order.
    pub fn events(&self) -> &[Event<Coordinates<M>>] {
        &self.results.events
    }

    /// The number of events of this name.
    pub fn event_count(&self, name: &str) -> usize {
        self.results
            .events
            .iter()
            .filter(|event| event.name == name)
            .count()
    }

    /// The events of the unilateral contacts, in order.
    pub fn contact_events(&self) -> &[ContactEvent<Coordinates<M>>] {
        &self.results.unilateral.events
    }

    /// For each unilateral contact the number of its impacts and when it closed last, also if its events were not kept; empty if nothing happened.
    pub fn contact_tallies(&self) -> &[ContactTally] {
        &self.results.unilateral.tallies
    }

    /// The phase of the unilateral contacts at a time within the run; at a change, the phase after it. Nothing if it was not kept.
    fn phase_at(&self, t: f64) -> Option<&Phase<VectorOf<M>>> {
        let phases = &self.results.unilateral.phases;
        let after = phases.partition_point(|phase| phase.since <= t);
        let phase = phases.get(after.saturating_sub(1))?;
        (t < phase.until).then_some(phase)
    }

    /// The phases of the unilateral contacts, from one change to the next; those that were kept.
    pub fn contact_phases(&self) -> impl ExactSizeIterator<Item = ContactPhase<'_>> {
        self.results
            .unilateral
            .phases
            .iter()
            .map(Phase::public_view)
    }

    /// The energy stored in compliant unilateral contacts, in J.
    fn stored(&self, t: f64, q: &VectorOf<M>, v: &VectorOf<M>) -> f64 {
        if M::System::MAY_COLLIDE
            && let Some(phase) = self.phase_at(t)
        {
            return phase.touching.stored(&self.results.system, t, q, v);
        }
        0.0
    }

    /// Which unilateral contacts are closed at a time within the run, in their order; empty if that was not kept.
    pub fn closed_contacts(&self, t: f64) -> Vec<bool> {
        let modes = self.phase_at(t).map(|phase| phase.touching.modes());
        let modes = modes.unwrap_or_default().iter();
        modes.map(|mode| *mode != Mode::Open).collect()
    }

    /// The times at which the run changed to time stepping and back to locating every event, in order; empty if
    /// [`hand_over`](crate::Simulation::hand_over) was not requested or not needed.
    pub fn handovers(&self) -> &[Handover] {
        &self.results.handovers
    }

    /// The methods that the run used, with times and reasons, in order; empty unless [`automatic`](crate::Simulation::automatic) was requested, or
    /// [`TAYLOR`](crate::TAYLOR) for a machine with unilateral contacts.
    pub fn choices(&self) -> &[MethodChoice] {
        &self.results.choices
    }

    /// For each unilateral contact the energy lost in its impacts, in J.
    pub fn impact_losses(&self) -> &[f64] {
        &self.results.unilateral.losses
    }

    /// The energies of each unilateral contact, if the simulation kept the energy balance; otherwise empty.
    pub fn contact_energies(&self) -> &[ContactEnergies] {
        (self.results.unilateral.energy_entries.last()).map_or(&[], |book| book.of_each.as_slice())
    }

    /// For each unilateral contact the work that crushed its layer until the end, in J; 0 for contacts without a layer.
    pub fn crushing_work(&self) -> Vec<f64> {
        let Some(phase) = self.results.unilateral.phases.last() else {
            return Vec::new();
        };
        if !M::System::MAY_COLLIDE {
            return Vec::new();
        }
        let system = &self.results.system;
        let (q, v) = (
            system.to_vector(&self.results.end.q),
            system.to_vector(&self.results.end.v),
        );
        (phase.touching).crushing_works(system, (self.results.end.t, &q, &v))
    }

    /// The energy balance of the run, if the simulation kept it.
    pub fn energy_balance(&self) -> Option<EnergyBalance> {
        self.results.balance
    }

    /// [`contact_energies`](Self::contact_energies) until a time within the run; at an impact, including it, but at the start before
    /// any. They are recorded at the ends of steps and interpolated between them by cubic Hermite polynomials. `None` if the energies
    /// at the ends of steps were not kept.
    pub fn contact_energies_at(&self, t: f64) -> Option<Vec<ContactEnergies>> {
        let energy_entries = &self.results.unilateral.energy_entries;
        if !self.results.settings.keep_energies
            || energy_entries.len() != self.results.energies.len()
        {
            return (t == self.results.end.t && !energy_entries.is_empty())
                .then(|| self.contact_energies().to_vec());
        }
        if t == self.results.start.t {
            return energy_entries.first().map(|of| of.of_each.clone());
        }
        let after = self.results.energies.partition_point(|of| of.t <= t);
        let (before, next) = (
            energy_entries.get(after.checked_sub(1)?)?,
            energy_entries.get(after),
        );
        let from = self.results.energies[after - 1].t;
        let Some(next) = next else {
            return (from == t).then(|| before.of_each.clone());
        };
        let h = self.results.energies[after].t - from;
        let of_each = (0..before.of_each.len()).map(|k| before.towards(next, k, h, (t - from) / h));
        Some(of_each.collect())
    }

    /// The energies at the beginning and after every step, if the simulation kept the energy balance.
    pub fn energies(&self) -> &[Energies] {
        &self.results.energies
    }

    /// The cost of the run.
    pub fn statistics(&self) -> Statistics {
        self.results.statistics
    }

    /// Warnings about a run that did not fail.
    pub fn warnings(&self) -> &[Warning] {
        &self.results.warnings
    }

    /// The equations of motion that were integrated.
    pub fn system(&self) -> &M::System {
        &self.results.system
    }
}

/// Serializes the results without the steps that [`Solution::at`] needs; request [`samples`](crate::Simulation::every) to
/// include the motion.
#[cfg(feature = "serde")]
impl<M: Machine<System: System<Coordinates: serde::Serialize>>, L> serde::Serialize
    for Solution<M, L>
{
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct;
        let mut fields = serializer.serialize_struct("Solution", 11)?;
        fields.serialize_field("method", self.results.method.tableau.name)?;
        fields.serialize_field("start", &self.results.start)?;
        fields.serialize_field("end", &self.results.end)?;
        fields.serialize_field("ending", &self.results.ending)?;
        fields.serialize_field("samples", &self.results.samples)?;
        fields.serialize_field("events", &self.results.events)?;
        fields.serialize_field("contact_events", &self.results.unilateral.events)?;
        fields.serialize_field("energies", &self.results.energies)?;
        fields.serialize_field("energy_balance", &self.results.balance)?;
        fields.serialize_field("statistics", &self.results.statistics)?;
        fields.serialize_field("warnings", &self.results.warnings)?;
        fields.end()
    }
}

impl<M: Machine, L> Debug for Solution<M, L> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Solution")
            .field("start", &self.results.start)
            .field("end", &self.results.end)
            .field("ending", &self.results.ending)
            .field("events", &self.results.events)
            .field("energy_balance", &self.results.balance)
            .field("statistics", &self.results.statistics)
            .field("warnings", &self.results.warnings)
            .finish_non_exhaustive()
    }
}

/// Evaluates a run at times that are mostly in order.
struct Sampler<'a, M: Machine, L> {
    run: &'a Solution<M, L>,
    interpolant: Option<(usize, Interpolant<VectorOf<M>>)>,
}

impl<M: Machine, L: InputLaw<M::System>> Sampler<'_, M, L> {
    fn at(&mut self, t: f64) -> Result<State<Coordinates<M>>, Error> {
        let Results {
            system, start, end, ..
        } = &self.run.results;
        if t == start.t {
            return Ok(start.clone());
        }
        if t == end.t {
            return Ok(end.clone());
        }
        let (q, v) = self.interpolant(t)?.1.state(t);
        let (q, v) = self.run.project(t, (q, v))?;
        Ok(state(system, (t, q, v)))
    }

    fn energies(&mut self, t: f64) -> Result<Energies, Error> {
        let run = self.run;
        let [first, .., last] = run.results.energies.as_slice() else {
            return match run.results.energies.first() {
                Some(only) if only.t == t => Ok(*only),
                Some(_) => Err(Error::OutsideRun {
                    t,
                    from: run.results.start.t,
                    to: run.results.end.t,
                }),
                None => Err(Error::NoEnergyBalance),
            };
        };
        if t == first.t || t == last.t {
            return Ok(if t == first.t { *first } else { *last });
        }

        let (index, interpolant) = self.interpolant(t)?;
        let before = &run.results.energies[*index];
        let (q, v) = run.project(t, interpolant.state(t))?;
        let u = run.inputs(t, &q, &v);
        let mut energies = Energies {
            t,
            kinetic: run.results.system.kinetic_energy(t, &q, &v),
            potential: run.results.system.potential_energy(t, &q, &u)
                + run.results.system.state_energy(t, &q, &v)
                + run.stored(t, &q, &v),
            ..*before
        };
        // The motion within a step of a series has a higher degree, so the integral is taken in parts.
        let is_series = |of: &Steps<_>| of.method(*index).kind == MethodKind::Series;
        let parts = if run.results.steps.as_ref().is_some_and(is_series) {
            4
        } else {
            1
        };
        let half = 0.5 * (t - before.t) / f64::from(parts);
        let nodes = (0..parts).flat_map(|part| GAUSS.map(|(x, weight)| (part, x, weight)));
        for (part, node, weight) in nodes {
            let t = before.t + half * (f64::from(2 * part) + 1.0 + node);
            let (q, v) = run.project(t, interpolant.state(t))?;
            let mut a = q.zeros_like();
            let u = run
                .accelerations(t, &q, &v, &mut a)
                .map_err(|error| Error::of_step(error, &run.results.system))?;
            energies.work += half * weight * run.results.system.work_rate(t, &q, &v, &a, &u);
            energies.dissipated +=
                half * weight * run.results.system.dissipation_rate(t, &q, &v, &u);
            if M::System::MAY_SLIDE
                && let Some(contacts) = run.contacts_at(t)
            {
                let [work, lost] = contacts.power(
                    &run.results.system,
                    At {
                        t,
                        q: &q,
                        v: &v,
                        u: &u,
                    },
                );
                energies.work += half * weight * work;
                energies.dissipated += half * weight * lost;
            }
            if M::System::MAY_COLLIDE
                && let Some(phase) = run.phase_at(t)
            {
                let at = At {
                    t,
                    q: &q,
                    v: &v,
                    u: &u,
                };
                let mut memory = ContactMemory::new(&phase.touching, &q);
                let powers = phase.touching.powers(&run.results.system, at, &mut memory);
                energies.work += half * weight * powers.work;
                energies.dissipated += half * weight * powers.lost;
            }
        }
        Ok(energies)
    }

    /// The step that contains `t`, and the motion within it.
    fn interpolant(&mut self, t: f64) -> Result<&(usize, Interpolant<VectorOf<M>>), Error> {
        let Results {
            system, start, end, ..
        } = &self.run.results;
        if !(start.t.min(end.t) <= t && t <= start.t.max(end.t)) {
            return Err(Error::OutsideRun {
                t,
                from: start.t,
                to: end.t,
            });
        }
        let steps = self
            .run
            .results
            .steps
            .as_ref()
            .ok_or(Error::StepsForgotten)?;
        let index = steps.index(t);
        let known = self.interpolant.take().filter(|(known, _)| *known == index);
        let interpolant = match known {
            Some(interpolant) => interpolant,
            None => {
                let accelerations =
                    |t, q: &_, v: &_, a: &mut _| self.run.accelerations(t, q, v, a).map(|_| ());
                let interpolant = steps
                    .interpolant(index, accelerations)
                    .map_err(|error| Error::of_step(error, system))?;
                (index, interpolant)
            }
        };
        Ok(self.interpolant.insert(interpolant))
    }
}

type VectorOf<M> = <<M as Machine>::System as System>::Vector;

/// Coordinates and rates.
type Pair<M> = (VectorOf<M>, VectorOf<M>);

/// Nodes and weights of the Gauss formula with five nodes on [−1, 1]. It is exact up to degree 9; the motion within a step
/// has degree 7.
const GAUSS: [(f64, f64); 5] = [
    (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
    (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.0, 0.568_888_888_888_888_9),
    (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
    (0.906_179_845_938_664, 0.236_926_885_056_189_1),
];

/// Whether a finite time equals another to round-off.
fn is_near(one: f64, other: f64) -> bool {
    one.is_finite() && (one - other).abs() <= 4.0 * f64::EPSILON * one.abs().max(other.abs())
}

/// Whether `t` is at or past `end`, or before it only by round-off, in the direction of `interval`.
pub(crate) fn is_beyond(t: f64, end: f64, interval: f64) -> bool {
    let roundoff = 4.0 * f64::EPSILON * end.abs().max(t.abs());
    (end - t) * interval.signum() <= roundoff
}
