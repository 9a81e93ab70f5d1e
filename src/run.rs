//! Makes a run: takes step after step, and after each one looks for events, samples, changes of contacts, and ends of assumptions.

mod assumptions;
mod choosing;
mod comparing;
mod contact_search;
pub(crate) mod contacts;
mod explained;
mod handing_over;
pub(crate) mod in_lanes;
pub(crate) mod sampled;
mod stepping;

use sampled::Sampling;
use std::string::String;
use std::time::Instant;
use std::vec::Vec;

use crate::at::At;
use crate::balance::{Energies, EnergyBalance, EnergyIntegrals, Quadratures};
use crate::constraints::{Constraints, Violation, closest};
use crate::contact::Mode;
use crate::equations::check_equations;
use crate::error::{KeptContradiction, constraint_name};
use crate::event::{self, Crossing, EndOfStep, Event, Terminal, Triple, state, step_motion};
use crate::friction::{Cause, Change, Contacts, Motion};
use crate::inputs::{InputLaw, Law, LawInPiece};
use crate::interpolant::Interpolant;
use crate::methods::{Method, MethodKind};
use crate::names::rate_name;
use crate::observation::{ConstraintState, ObservedSystem};
use crate::phases::UnilateralRecord;
use crate::piece::Piece;
use crate::settings::{Callbacks, Progress, Settings, Subject, Task};
use crate::solution::{
    Ending, Handover, MethodChoice, MethodReason, RunResult, Solution, Statistics, Steps, handover,
    is_beyond,
};
use crate::stages::Point;
use crate::step_error::StepError;
use crate::stepper::{BorrowedOrOwned, Stepper};
use crate::tolerance::{LEAST_RELATIVE_TOLERANCE, Tolerance};
use crate::{
    ContactTrouble, Coordinates, Error, Inputs, Machine, Pivot, Singular, State, StepMotion,
    System, Vector, Warning,
};
use assumptions::Held;
use choosing::{Beginning, CANDIDATES, Choosing};
use contact_search::ContactLooks;
use contacts::PendingChange;
use explained::ExplainedResidual;
use handing_over::ContactActivity;

/// Makes the run of a simulation, and returns it with the error that ended it early, if any.
///
/// # Errors
/// Only if the run could not begin.
///
/// It depends neither on the type of the law nor on whether a balance is kept, so a run is compiled once for a machine.
pub(crate) fn run<M: Machine>(
    task: Task<'_, M, Law<'_, M::System>>,
    start: State<Coordinates<M>>,
) -> RunResult<M> {
    let mut prepared = Prepared::new(task, start)?;
    let mut run = prepared.begin()?;
    let ending = run.go_to_end();
    let finished = run.end(ending);
    Ok(prepared.solution(finished))
}

/// A run before its first step. It owns everything that the run borrows.
pub(crate) struct Prepared<'a, 'l, M: Machine> {
    clock: Instant,
    law: Law<'l, M::System>,
    settings: Settings,
    callbacks: Callbacks<'a, M>,
    system: M::System,
    start: State<Coordinates<M>>,
    q: VectorOf<M>,
    v: VectorOf<M>,
    until: f64,
    tolerance: Tolerance<VectorOf<M>>,
    piece: Piece,
    chosen: Option<Beginning>,
    /// Whether it resumes another run, and the event that ended that run there.
    is_resumed: bool,
    ended: Option<String>,
    /// Warnings about the start.
    start_warnings: Vec<Warning>,
}

/// The results of a run that has ended, without what it borrowed.
pub(crate) struct Finished<M: Machine> {
    end: State<Coordinates<M>>,
    ending: Ending,
    error: Option<Error>,
    record: Record<M>,
    statistics: Statistics,
    balance: Option<EnergyBalance>,
    warnings: Vec<Warning>,
    next_step: f64,
    constraints: Option<Constraints<VectorOf<M>>>,
    choices: Vec<MethodChoice>,
}

/// A run that borrows from a [`Prepared`] one: with a law of any kind, with an energy balance or without.
pub(crate) type RunOf<'r, 'a, 'l, M> =
    Run<'r, 'a, M, Law<'l, <M as Machine>::System>, Option<EnergyIntegrals>>;

impl<'a, 'l, M: Machine> Prepared<'a, 'l, M> {
    /// Checks the settings of a run and projects its start onto the constraints.
    pub(crate) fn new(
        task: Task<'a, M, Law<'l, M::System>>,
        start: State<Coordinates<M>>,
    ) -> Result<Self, Error> {
        let clock = Instant::now();
        let Task {
            subject,
            law,
            mut settings,
            callbacks,
            resumed,
        } = task;
        let until = settings.check()?;
        stepping::check_length(settings.method.has_fixed_steps(), settings.longest_step)?;
        let system = match subject {
            Subject::Machine(machine) => {
                check_parameters(machine)?;
                machine.prepare()
            }
            // Its equations were checked when the run began that this one resumes.
            Subject::System(system) => system,
        };
        let is_resumed = resumed.is_some();
        if system.contacts().len() + system.unilateral_contacts().len() != 0 && until < start.t {
            return Err(Error::InvalidSetting {
                setting: "until",
                value: until,
                needed: "after the start: what friction or an impact has stopped cannot be run backward",
            });
        }
        if let Some(sampled) = &callbacks.sampled {
            sampled.check(start.t, until, law.is_constant() || law.is_partial())?;
        }
        let tolerance = settings.tolerance(&system)?;
        let (mut q, mut v) = (system.to_vector(&start.q), system.to_vector(&start.v));
        check_start(&system, start.t, &q, &v)?;
        let (mut start, mut start_warnings) = (start, Vec::new());
        if <M::System as System>::MAY_BE_CONSTRAINED && system.constraints().len() != 0 {
            let kept = settings.kept_start_values(&system, is_resumed)?;
            start_warnings = project_start(&system, start.t, &mut q, &mut v, kept)?;
            start = state(&system, (start.t, q.clone(), v.clone()));
        }
        let ended = resumed.filter(|resumed| resumed.t == start.t);
        let ended = ended.and_then(|resumed| resumed.event);
        let inputs_stay = law.is_constant() && callbacks.sampled.is_none();
        let at = (start.t, &q, &v);
        let ahead = (until - start.t, inputs_stay);
        let chosen = (settings.automatic).then(|| choosing::first(&system, at, &tolerance, ahead));
        if let Some(beginning) = chosen {
            settings.method = beginning.method;
        }
        let forward = until >= start.t;
        let order = settings.method.tableau.order;
        let piece = law.piece(start.t, forward, order);
        let piece = piece.map_err(|none| none.error(start.t))?;
        Ok(Self {
            clock,
            law,
            settings,
            callbacks,
            system,
            start,
            q,
            v,
            until,
            tolerance,
            piece,
            chosen,
            is_resumed,
            ended,
            start_warnings,
        })
    }

    /// Begins the run at its start.
    pub(crate) fn begin<'r>(&'r mut self) -> Result<RunOf<'r, 'a, 'l, M>, Error> {
        let Self {
            law,
            settings,
            callbacks,
            system,
            start,
            q,
            v,
            until,
            tolerance,
            piece,
            chosen,
            is_resumed,
            ended,
            ..
        } = self;
        let (law, system, until, piece) = (&*law, &*system, *until, *piece);
        let quadratures = settings.energy_balance.then(EnergyIntegrals::default);
        let sampling = callbacks.sampled.as_ref().map(|of| of.begin(system));
        let sampled_inputs = sampling.is_some().then(|| system.default_inputs());
        let model = Model {
            system,
            observed_system: ObservedSystem {
                system,
                law: LawInPiece {
                    law,
                    sampled: sampled_inputs.clone(),
                    piece,
                },
            },
            start: (start.t, &*q),
        };
        if let Some((_, assumption)) = model.ended_assumption((start.t, q.clone(), v.clone())) {
            return Err(Error::AssumptionEnded {
                assumption,
                t: start.t,
            });
        }
        let begun = |method| {
            Stepper::begun(
                BorrowedOrOwned::Borrowed(system),
                model.observed_system.law.clone(),
                quadratures.clone(),
                method,
                tolerance.clone(),
                (start.t, q.clone(), v.clone()),
                until,
            )
        };
        let mut begun_by = begun(settings.method);
        if begun_by.is_err() && chosen.is_some() && settings.method.kind == MethodKind::Series {
            *chosen = Some(Beginning::with(Method::DOP853, MethodReason::NoSeries));
            settings.method = Method::DOP853;
            begun_by = begun(settings.method);
        }
        let mut stepper = begun_by.map_err(|error| model.explain(error, q, v))?;
        if !*is_resumed {
            check_equations(
                system,
                At {
                    t: start.t,
                    q,
                    v,
                    u: stepper.inputs(),
                },
            )?;
        }
        stepper.set_longest_step(settings.longest_step);
        if let Some(step) = settings.first_step {
            stepper.set_first_step(step);
        }
        if let Some(beginning) = *chosen {
            stepper.count_evaluations(beginning.evaluations);
        }
        for watch in &mut callbacks.watches {
            let observe = || model.observed_system.observe::<M, _>(&stepper, start);
            watch.begin(start, ended.as_ref() == Some(&watch.name), &observe)?;
        }
        for stream in &mut callbacks.streams {
            stream.begin(start);
        }

        let activity = ContactActivity::new(
            settings.hands_over && settings.method.kind == MethodKind::RungeKutta,
            system.unilateral_contacts().len(),
        );
        let choosing = match *chosen {
            Some(choice) => {
                let may_change = system.unilateral_contacts().len() == 0;
                Choosing::begun(start.t, choice, may_change)
            }
            None => Choosing::none(),
        };
        let others: &[_] = if settings.automatic { &CANDIDATES } else { &[] };
        let mut run = Run {
            model,
            stepper,
            callbacks,
            start: start.t,
            until,
            stop: until,
            sampling,
            next_step: None,
            activity,
            contact_looks: ContactLooks::default(),
            held: None,
            choosing,
            record: Record {
                sampled_inputs: sampled_inputs
                    .map(|inputs| (start.t, inputs))
                    .into_iter()
                    .collect(),
                pieces: (piece != Piece::ALL).then_some(piece).into_iter().collect(),
                steps: (settings.keep_steps).then(|| Steps::new(settings.method, others)),
                samples: settings.every.map(|_| start.clone()).into_iter().collect(),
                events: Vec::new(),
                energies: Vec::new(),
                contacts: Vec::new(),
                unilateral: UnilateralRecord::default(),
                handovers: Vec::new(),
                kinetic_energy: 0.0,
                explained: ExplainedResidual::default(),
                is_unexplained: false,
            },
            settings,
        };
        let contacts = run
            .stepper
            .contacts()
            .iter()
            .map(Contacts::for_later_observation);
        run.record
            .contacts
            .extend(contacts.map(|known| (start.t, known)));
        run.record_energies();
        if (run.record.energies.first()).is_some_and(|of| (of.kinetic + of.potential).is_nan()) {
            return Err(Error::EnergiesUnknown { t: start.t });
        }
        if <M::System as System>::MAY_COLLIDE {
            run.resolve_contacts_at_start()?;
        }
        run.begin_choosing()?;
        Ok(run)
    }

    /// Makes the solution from a run that has ended.
    pub(crate) fn solution(mut self, finished: Finished<M>) -> (Solution<M, ()>, Option<Error>) {
        let Finished {
            end,
            ending,
            error,
            record,
            statistics,
            balance,
            warnings,
            next_step,
            constraints,
            choices,
        } = finished;
        let Record {
            sampled_inputs,
            pieces,
            steps,
            samples,
            events,
            energies,
            contacts,
            unilateral,
            handovers,
            ..
        } = record;
        self.start_warnings.extend(warnings);
        let solution = Solution {
            method: self.settings.method,
            balance,
            statistics: Statistics {
                seconds: self.clock.elapsed().as_secs_f64(),
                ..statistics
            },
            warnings: self.start_warnings,
            next_step,
            constraints,
            contacts,
            unilateral,
            handovers,
            choices,
            sampled_inputs,
            pieces,
            start: self.start,
            end,
            steps,
            samples,
            events,
            energies,
            ending,
            settings: self.settings,
            law: (),
            system: self.system,
        };
        (solution, error)
    }
}

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Ends the run: returns its results with the energy balance and the warnings.
    pub(crate) fn end(mut self, ending: Result<Ending, Error>) -> Finished<M> {
        if ending.is_ok() {
            self.change_inputs_at_end();
        }
        let (ending, error) = match ending {
            Ok(ending) => (ending, None),
            Err(error) => (Ending::Error, Some(error)),
        };
        let Self {
            model,
            stepper,
            settings,
            mut record,
            next_step,
            callbacks,
            choosing,
            ..
        } = self;
        let system = model.system;
        let end = state(
            system,
            (stepper.t(), stepper.q().clone(), stepper.v().clone()),
        );
        if settings.every.is_some() && end.t != model.start.0 {
            record.samples.push(end.clone());
        }
        for stream in &mut callbacks.streams {
            stream.end(&end);
        }
        if !record.unilateral.events.is_empty() {
            // The time of a contact event may include the rest of its bounces, within which other events happen.
            let events = &mut record.events;
            events.sort_by(|one, other| one.state.t.total_cmp(&other.state.t));
        }
        let work = stepper.work();
        let has_fixed_steps = settings.method.has_fixed_steps() || !record.handovers.is_empty();
        let balance = balance(
            &stepper,
            &record.energies,
            &record.explained,
            (record.kinetic_energy, has_fixed_steps),
        );
        let mut warnings = warnings(settings, &stepper);
        if <M::System as System>::MAY_COLLIDE {
            warnings.extend(record.unilateral.warnings(system));
            warnings.extend(handover::warning(&record.handovers));
        }
        if let Some(balance) = &balance
            && error.is_none()
            && balance.residual().abs() > balance.explained
        {
            warnings.push(Warning::EnergyUnexplained {
                residual: balance.residual(),
                explained: balance.explained,
                relative: balance.relative(),
            });
        }
        Finished {
            end,
            ending,
            error,
            record,
            statistics: Statistics {
                steps: work.steps,
                rejected: work.rejected,
                evaluations: work.evaluations,
                constraint_residual: stepper.constraint_residual(),
                stiff_since: stepper.stiff_since(),
                seconds: 0.0,
            },
            balance,
            warnings,
            next_step: next_step.unwrap_or(stepper.next_step()).abs(),
            constraints: stepper.constraints().clone(),
            choices: choosing.choices,
        }
    }
}

/// The number of changes of contact states at one instant beyond which they are considered not to settle: each contact has three states.
const MOST_CHANGES_AT_ONCE: usize = 3 * crate::MOST_CONTACTS;

/// A run in progress.
pub(crate) struct Run<'r, 'a, M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> {
    model: Model<'r, M::System, L>,
    stepper: Stepper<'r, M::System, LawInPiece<'r, L, Inputs<M>>, A>,
    settings: &'r Settings,
    callbacks: &'r mut Callbacks<'a, M>,
    start: f64,
    until: f64,
    /// Where the stepper stops next: where the inputs are not smooth, at a sample or a delayed action of a controller, or at the end.
    stop: f64,
    /// The inputs of a sampled controller, if there is one.
    sampling: Option<Sampling<Inputs<M>>>,
    /// The length of the step within which the run ended at an event.
    next_step: Option<f64>,
    /// How frequently contacts change.
    activity: ContactActivity,
    /// Memory for looks at unilateral contacts.
    contact_looks: ContactLooks<VectorOf<M>, <M::System as System>::Matrix>,
    /// Bounds within which all assumptions hold.
    held: Held<VectorOf<M>>,
    /// The choice of the method, if the run makes it.
    choosing: Choosing,
    record: Record<M>,
}

/// State between two steps, until the run stops at `stop`.
struct BetweenSteps {
    /// The reason for which the run will end once the stepper has reached its end.
    ending: Result<Ending, Error>,
    /// A contact state that ends where the stepper will stop, and the step length to continue with.
    pending: Option<(Change, f64)>,
    /// Time of the last change of contacts, and the number of changes at that time.
    last_change: (f64, usize),
    /// A change of unilateral contacts at which the stepper will stop.
    pending_change: Option<PendingChange>,
}

impl BetweenSteps {
    fn new() -> Self {
        Self {
            ending: Ok(Ending::End),
            pending: None,
            last_change: (f64::NAN, 0),
            pending_change: None,
        }
    }
}

/// The records of a run.
struct Record<M: Machine> {
    /// The inputs that a sampled controller set, each with the time from which they hold.
    sampled_inputs: Vec<(f64, Inputs<M>)>,
    /// The intervals of time in which the inputs are smooth, in the order of the run; empty if they are smooth throughout.
    pieces: Vec<Piece>,
    steps: Option<Steps<VectorOf<M>>>,
    samples: Vec<State<Coordinates<M>>>,
    events: Vec<Event<Coordinates<M>>>,
    energies: Vec<Energies>,
    /// The states of the guided contacts, each with the time from which it holds.
    contacts: Vec<(f64, Contacts)>,
    /// Record of the unilateral contacts.
    unilateral: UnilateralRecord<Coordinates<M>, VectorOf<M>>,
    /// When the run changed to time stepping and back.
    handovers: Vec<Handover>,
    /// The largest kinetic energy so far, in J.
    kinetic_energy: f64,
    /// The part of the residual of the energy balance that tolerance and rounding explain.
    explained: ExplainedResidual,
    /// Whether a step had a residual that remained unexplained.
    is_unexplained: bool,
}

type VectorOf<M> = <<M as Machine>::System as System>::Vector;

impl<M: Machine> Record<M> {
    /// Records an event of a watched function.
    fn push_watched(&mut self, event: Event<Coordinates<M>>) {
        self.unilateral.last_watched = event.state.t;
        self.events.push(event);
    }
}

/// The motion within the last step, computed on first use.
type LastInterpolant<M> = Option<Interpolant<VectorOf<M>>>;

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Runs to the end, or until something ends the run earlier.
    fn go_to_end(&mut self) -> Result<Ending, Error> {
        loop {
            if let Some(ending) = self.change_inputs()? {
                return Ok(ending);
            }
            let ending = self.step_until()?;
            if ending != Ending::End || self.stepper.t() == self.until {
                return Ok(ending);
            }
        }
    }

    /// Steps until `stop`, or until something ends the run earlier.
    fn step_until(&mut self) -> Result<Ending, Error> {
        self.forget_values();
        let mut between = BetweenSteps::new();
        while !self.stepper.is_done() {
            self.check_count()?;
            let stepped = self.stepper.step();
            if let Some(ending) = self.examine_step(&mut between, stepped)? {
                return Ok(ending);
            }
        }
        between.ending
    }

    /// Forgets the last values of the watched functions, since something that they depend on may have jumped.
    fn forget_values(&mut self) {
        for watch in &mut self.callbacks.watches {
            watch.latest = None;
        }
    }

    /// Checks that one more step may be taken.
    #[inline(always)]
    fn check_count(&self) -> Result<(), Error> {
        if self.stepper.work().steps == self.settings.max_steps {
            Err(Error::TooManySteps {
                steps: self.settings.max_steps,
                t: self.stepper.t(),
                until: self.until,
            })
        } else {
            Ok(())
        }
    }

    /// Examines a step that was taken or failed. Returns the reason if the run ends.
    #[inline(always)]
    fn examine_step(
        &mut self,
        between: &mut BetweenSteps,
        stepped: Result<(), StepError>,
    ) -> Result<Option<Ending>, Error> {
        let BetweenSteps {
            ending,
            pending,
            last_change,
            pending_change,
        } = between;
        if let Err(error) = stepped {
            // Where an assumption ends there may be no accelerations to go on with; then the end of the assumption is the reason.
            std::mem::replace(ending, Ok(Ending::End))?;
            if self.leave_series(&error) {
                return Ok(None);
            }
            let error = self.vanishing_gradient_error(&error).unwrap_or(error);
            return Err(self
                .model
                .explain(error, self.stepper.q(), self.stepper.v()));
        }

        if <M::System as System>::MAY_COLLIDE && self.is_stepped() && self.undo_step_into_motion() {
            return Ok(None);
        }
        let mut interpolant = None;
        if <M::System as System>::MAY_SLIDE
            && pending.is_none()
            && ending.is_ok()
            && let Some((t, change)) = self.contact_changed(&mut interpolant)?
        {
            let step = self.stepper.last_step();
            self.stepper.retreat(t);
            *pending = Some((change, step));
            if self.stepper.is_done() {
                return self.change(pending, last_change);
            }
            return Ok(None);
        }
        if <M::System as System>::MAY_COLLIDE
            && self.stepper.touching().is_some()
            && !self.stepper.is_time_stepping()
        {
            let looks = ending.is_ok();
            let next =
                self.follow_contacts(pending_change, &mut interpolant, looks, last_change)?;
            match next {
                contacts::AfterContacts::Step => return Ok(None),
                contacts::AfterContacts::End(ending) => return Ok(Some(ending)),
                contacts::AfterContacts::Keep => {}
            }
        }
        // To end the run within a step, the step is repeated up to that time. So the end and the energy balance are as accurate as at
        // every other step.
        if ending.is_ok()
            && let Some((t, assumption)) = self.assumption_ended(&mut interpolant)?
        {
            self.stepper.retreat(t);
            *ending = Err(Error::AssumptionEnded { assumption, t });
            *pending = None;
            *pending_change = None;
            return Ok(None);
        }
        let end = self.end_of_step(pending.is_some() || pending_change.is_some());
        if let Some(found) = self.find_events(end, &mut interpolant)? {
            return self.end_at(found).map(Some);
        }
        self.record_last_step(&mut interpolant)?;
        if self.shall_stop() {
            return Ok(Some(Ending::Stopped));
        }
        if <M::System as System>::MAY_COLLIDE && self.is_stepped() {
            self.continue_after_time_step()?;
        }
        if pending.is_none() && pending_change.is_none() && ending.is_ok() {
            self.choose_again()?;
        }
        if <M::System as System>::MAY_SLIDE
            && self.stepper.is_done()
            && let Some(ending) = self.change(pending, last_change)?
        {
            return Ok(Some(ending));
        }
        if <M::System as System>::MAY_COLLIDE
            && self.stepper.is_done()
            && let Some(ending) = self.resolve_pending_change(pending_change, last_change)?
        {
            return Ok(Some(ending));
        }
        Ok(None)
    }

    /// The error of a run that stops because the gap of a closed contact hardly depends on the coordinates any more: the force that holds
    /// it shut grows without bound, and steps shrink.
    fn vanishing_gradient_error(&self, error: &StepError) -> Option<StepError> {
        let StepError::StepTooSmall { t, .. } = *error else {
            return None;
        };
        self.contact_with_small_gradient(NEAR_FORK, |_| true)
            .map(|contact| StepError::Contact {
                contact,
                trouble: ContactTrouble::NotHeld,
                t,
            })
    }

    /// The first closed contact among those that `counts` selects whose gap has a gradient of less than `share` times its length
    /// at the start.
    fn contact_with_small_gradient(
        &self,
        share: f64,
        counts: impl Fn(usize) -> bool,
    ) -> Option<usize> {
        let (touching, system) = (self.stepper.touching().as_ref()?, self.model.system);
        let is_closed = |contact: &usize| touching.modes()[*contact] != Mode::Open;
        let closed = (0..touching.modes().len()).filter(|k| counts(*k) && is_closed(k));
        let mut closed = closed.peekable();
        closed.peek()?;
        let (begun, start) = self.model.start;
        let n = start.as_slice().len();
        let rows = |t, q| {
            let mut rows = std::vec![0.0; 2 * touching.modes().len() * n];
            system.contact_matrix(t, q, &mut rows);
            rows
        };
        let (before, now) = (rows(begun, start), rows(self.stepper.t(), self.stepper.q()));
        let length = |rows: &[f64], contact: usize| {
            let row = &rows[2 * contact * n..][..n];
            row.iter().map(|w| w * w).sum::<f64>().sqrt()
        };
        closed.find(|contact| length(&now, *contact) < share * length(&before, *contact))
    }

    /// The time at which the state of a contact ended in the last step, and the change.
    fn contact_changed(
        &mut self,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<Option<(f64, Change)>, Error> {
        let Self { model, stepper, .. } = self;
        let Some(contacts) = stepper.contacts().clone() else {
            return Ok(None);
        };
        let margins = |(t, q, v): &Triple<VectorOf<M>>| {
            let inputs = model.inputs(*t, q, v);
            contacts
                .margins(
                    model.system,
                    At {
                        t: *t,
                        q,
                        v,
                        u: &inputs,
                    },
                )
                .map_err(|error| model.explain(error, q, v))
        };
        let mut earliest: Option<(f64, f64, Change)> = None;
        let mut theta_before = 0.0;
        let theta_roundoff = event::theta_roundoff(stepper);
        for theta in event::SAMPLE_FRACTIONS {
            let ended =
                contacts.ended_by_margins(&margins(&event::interpolated_at(stepper, theta))?);
            for (change, kind) in ended.into_iter().flatten() {
                let interpolant = step_motion(interpolant, stepper, model.system)?;
                let at = |theta| event::state_at(model.system, stepper, interpolant, theta);
                let exactly = |theta| Ok(margins(&at(theta)?)?[change.contact][kind]);
                if !exactly(theta)?.is_lost_since(exactly(theta_before)?) {
                    continue;
                }
                let margin = |theta| exactly(theta).map(|margin| margin.value);
                let mut root =
                    event::last_positive([theta_before, theta], theta_roundoff, &mut &margin)?;
                let mut change = change;
                if root > contact_search::LEAST_APPROACH {
                    let (t, q, v) = at(root)?;
                    if contacts.still_slips(model.system, (t, &q, &v), change) {
                        root *= contact_search::APPROACH;
                        change.cause = Cause::Veered;
                    }
                }
                if earliest.is_none_or(|(known, ..)| root < known) {
                    earliest = Some((root, at(root)?.0, change));
                }
            }
            if let Some((_, t, change)) = earliest {
                return Ok(Some((t, change)));
            }
            theta_before = theta;
        }
        let (t, q, v) = (stepper.t(), stepper.q(), stepper.v());
        let inputs = model.inputs(t, q, v);
        contacts
            .check(
                model.system,
                At {
                    t,
                    q,
                    v,
                    u: &inputs,
                },
            )
            .map_err(|error| model.explain(error, q, v))?;
        Ok(None)
    }

    /// Puts contacts into other states if the stepper is at the end of one of their states. The answer is the event that ends the run.
    fn change(
        &mut self,
        pending: &mut Option<(Change, f64)>,
        (last_t, times): &mut (f64, usize),
    ) -> Result<Option<Ending>, Error> {
        let Some((change, step)) = pending.take() else {
            return Ok(None);
        };
        let t = self.stepper.t();
        let is_at_once = *last_t == t;
        (*last_t, *times) = (t, if is_at_once { *times + 1 } else { 0 });
        if *times > MOST_CHANGES_AT_ONCE {
            let singular = Singular {
                at: Pivot::Contact(change.contact),
                ratio: 0.0,
            };
            let error = StepError::Singular { singular, t };
            return Err(self
                .model
                .explain(error, self.stepper.q(), self.stepper.v()));
        }
        let before = self.stepper.contacts().clone();
        self.forget_values();
        let changed = self.stepper.change(change, is_at_once, self.stop, step);
        if let Err(error) = changed {
            return Err(self
                .model
                .explain(error, self.stepper.q(), self.stepper.v()));
        }
        if let Some(steps) = &mut self.record.steps {
            steps.jump(&self.stepper);
            self.record_energies();
        }
        self.record_contacts(before);
        let v = self.stepper.v().clone();
        self.watch_jumps(&v)
    }

    /// Records the states of the contacts with friction.
    fn record_contacts(&mut self, before: Option<Contacts>) {
        let t = self.stepper.t();
        let Some(now) = self.stepper.contacts() else {
            return;
        };
        let names = self.model.system.contacts().enumerate();
        let seconds = self.model.system.second_tangents();
        // Both tangents of a surface are reported under the name of the first.
        for (k, name) in names.filter(|(k, _)| seconds >> k & 1 == 0) {
            let Some(was) = before.as_ref().map(|before| before.mode) else {
                continue;
            };
            let (word, crossing) = match now.mode.motion[k] {
                Motion::Sticks if was.motion[k] == Motion::Sticks => continue,
                motion if motion == was.motion[k] => match now.mode.press[k] {
                    press if press == was.press[k] => continue,
                    press if press > 0.0 => ("presses the other way", Crossing::Rising),
                    _ => ("presses the other way", Crossing::Falling),
                },
                Motion::Sticks => ("sticks", Crossing::Falling),
                Motion::Slides(_) | Motion::SlidesAlong => ("slides", Crossing::Rising),
            };
            let at = (t, self.stepper.q().clone(), self.stepper.v().clone());
            self.record.events.push(Event {
                name: std::format!("{name} {word}"),
                crossing,
                state: state(self.model.system, at),
            });
        }
        self.record.contacts.push((t, now.for_later_observation()));
    }

    /// How the last step ends, if `is_pending` says that contacts change where the stepper stops.
    #[inline(always)]
    fn end_of_step(&self, is_pending: bool) -> EndOfStep {
        if !self.is_stepped() {
            return if is_pending && self.stepper.is_done() {
                EndOfStep::Change
            } else {
                EndOfStep::Smooth
            };
        }
        let closes = self.stepper.stepped().is_some_and(|(stepped, before)| {
            let modes = before.modes();
            let mut hit = stepped.impacts.iter();
            hit.any(|impact| modes[impact.contact] == Mode::Open)
        });
        if closes {
            EndOfStep::Impacts
        } else {
            EndOfStep::Change
        }
    }

    /// Records the events of the last step; returns the one that ends the run.
    fn find_events(
        &mut self,
        end: EndOfStep,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<Option<Terminal>, Error> {
        let Self {
            model,
            stepper,
            callbacks,
            record,
            ..
        } = self;
        let known = record.events.len();
        let found = event::find(
            &mut callbacks.watches,
            end,
            &model.observed_system,
            stepper,
            interpolant,
            &mut record.events,
        );
        if let Some(newest) = record.events[known..].last() {
            record.unilateral.last_watched = newest.state.t;
        }
        found
    }

    /// Ends the run at an event within the last step, by repeating the step up to the event. So the end and the energy balance are as
    /// accurate as at every other step. The function must be 0 at the end of that step and not on the dense output of the longer one:
    /// Newton's method corrects the length of the step until only rounding of time or state remains.
    fn end_at(&mut self, found: Terminal) -> Result<Ending, Error> {
        self.next_step = Some(self.stepper.last_step());
        let to = self.stepper.t();
        let mut corrected = f64::INFINITY;
        let mut t = found.t;
        loop {
            self.stepper.retreat(t);
            let mut is_step = false;
            while !self.stepper.is_done() {
                if is_step {
                    self.record_last_step(&mut None)?;
                }
                let (q, v) = (self.stepper.q().clone(), self.stepper.v().clone());
                let step = self.stepper.step();
                step.map_err(|error| self.model.explain(error, &q, &v))?;
                is_step = true;
            }
            let state = state(
                self.model.system,
                (t, self.stepper.q().clone(), self.stepper.v().clone()),
            );
            let watch = &mut self.callbacks.watches[found.watch];
            let observe = || {
                self.model
                    .observed_system
                    .observe::<M, A>(&self.stepper, &state)
            };
            let correction = match found.slope {
                Some(slope) if is_step => -watch.value(&state, &observe)? / slope,
                _ => 0.0,
            };
            let next = t + correction;
            let from = self.stepper.t_before();
            let is_within = (next - from) * (to - next) > 0.0;
            // A correction that is not at most half of the last one is rounding, or the function is not linear there.
            if next == t || correction.abs() > 0.5 * corrected || !is_within {
                let name = watch.name.clone();
                if is_step {
                    self.record_last_step(&mut None)?;
                }
                // Events that the dense output placed later, by its error, happened at the same time.
                let events = self.record.events.iter_mut().rev();
                for event in events.take_while(|event| (event.state.t - t) * (to - t) > 0.0) {
                    event.state = state.clone();
                }
                self.record.push_watched(Event {
                    name: name.clone(),
                    crossing: found.crossing,
                    state,
                });
                return Ok(Ending::Event(name));
            }
            corrected = correction.abs();
            t = next;
        }
    }

    /// Records and shows what the settings request of the last step.
    fn record_last_step(&mut self, interpolant: &mut LastInterpolant<M>) -> Result<(), Error> {
        self.keep_samples(interpolant)?;
        self.show_step(interpolant)?;
        if <M::System as System>::MAY_COLLIDE && self.is_stepped() {
            self.record_step();
        }
        let before = self.record.energies.last().copied();
        let explained = self.record_energies();
        if let Some(before) = before {
            self.explain_residual(&before, explained, interpolant);
        }
        if let Some(steps) = &mut self.record.steps {
            steps.push(&self.stepper);
        }
        if let Some(progress) = &self.callbacks.progress {
            let t = self.stepper.t();
            (progress.lock())(Progress {
                t,
                fraction: (t - self.start) / (self.until - self.start),
                steps: self.stepper.work().steps,
                step: (t - self.stepper.t_before()).abs(),
                stiff_since: (self.stepper.stiff_since()).filter(|_| !self.choosing.is_free()),
            });
        }
        Ok(())
    }

    /// Shows the last step to the observer of steps, if there is one.
    fn show_step(&mut self, interpolant: &mut LastInterpolant<M>) -> Result<(), Error> {
        let Self {
            model,
            stepper,
            callbacks,
            ..
        } = self;
        match &callbacks.observer {
            None => Ok(()),
            Some(observer) => (observer.lock())(&mut LastStep {
                model,
                stepper,
                interpolant,
            }),
        }
    }

    /// The samples within the last step, to be kept or shown. The sample at the end of the run is added when the run ends.
    fn keep_samples(&mut self, interpolant: &mut LastInterpolant<M>) -> Result<(), Error> {
        if let Some(interval) = self.settings.every {
            while let Some(t) = self.next_sample(interval, self.record.samples.len()) {
                let state = self.state_within(t, interpolant)?;
                self.record.samples.push(state);
            }
        }
        for number in 0..self.callbacks.streams.len() {
            loop {
                let stream = &self.callbacks.streams[number];
                let Some(t) = self.next_sample(stream.interval, stream.count) else {
                    break;
                };
                let state = self.state_within(t, interpolant)?;
                self.callbacks.streams[number].show(&state);
            }
        }
        Ok(())
    }

    /// The time of the next sample after `count` ones, if it is within the last step.
    fn next_sample(&self, interval: f64, count: usize) -> Option<f64> {
        let interval = interval.copysign(self.until - self.start);
        let t = self.start + count as f64 * interval;
        let is_later = (t - self.stepper.t()) * interval > 0.0;
        (!is_beyond(t, self.until, interval) && !is_later).then_some(t)
    }

    /// The state at a time within the last step.
    fn state_within(
        &mut self,
        t: f64,
        interpolant: &mut LastInterpolant<M>,
    ) -> Result<State<Coordinates<M>>, Error> {
        let system = self.model.system;
        let (q, v) = if t == self.stepper.t() {
            (self.stepper.q().clone(), self.stepper.v().clone())
        } else {
            let (mut q, mut v) = step_motion(interpolant, &mut self.stepper, system)?.state(t);
            self.stepper
                .project(t, &mut q, &mut v)
                .map_err(|error| Error::of_step(error, system))?;
            (q, v)
        };
        Ok(state(system, (t, q, v)))
    }

    /// Records the present energies, if their balance is kept. Returns the part of the residual of the last step that tolerance and
    /// rounding explain, in J.
    fn record_energies(&mut self) -> f64 {
        let Some(energies) = self.energies_now() else {
            return f64::INFINITY;
        };
        let stored = self.stored_now();
        let Self {
            model,
            stepper,
            record,
            ..
        } = self;
        record.kinetic_energy = record.kinetic_energy.max(energies.kinetic);
        let explained = record.explained.take(model.system, stepper, &energies);
        if !self.settings.keep_energies
            && record.energies.len() > 1
            && record.energies.last().is_some_and(Energies::are_finite)
        {
            record.energies.pop();
            record.unilateral.energy_entries.pop();
        }
        record.energies.push(Energies {
            potential: energies.potential + stored,
            ..energies
        });
        if <M::System as System>::MAY_COLLIDE && self.stepper.touching().is_some() {
            let energy_entry = self.energy_entry();
            self.record.unilateral.energy_entries.push(energy_entry);
        }
        explained
    }

    /// Whether the last step was one of time stepping, whose length follows from no error estimate.
    fn is_stepped(&self) -> bool {
        <M::System as System>::MAY_COLLIDE && self.stepper.is_time_stepping()
    }

    /// Repeats the quadrature of work and losses along the last step if its energy balance has an unexplained residual. The step may be too
    /// long for the quadrature, since its length was chosen for the motion alone. Steps of implicit methods are excluded: they are longer
    /// than fast transients that have decayed, which their dense output does not represent.
    fn explain_residual(
        &mut self,
        before: &Energies,
        explained: f64,
        interpolant: &mut LastInterpolant<M>,
    ) {
        let is_unexplained =
            |now: &Energies| now.are_finite() && now.residual_since(before).abs() > explained;
        if self.record.is_unexplained
            || self.settings.method.has_fixed_steps()
            || self.is_stepped()
            || self.stepper.is_implicit()
            || !self.record.energies.last().is_some_and(is_unexplained)
        {
            return;
        }
        let bound = 0.1 * explained;
        let known = step_motion(interpolant, &mut self.stepper, self.model.system)
            .is_ok_and(|of_step| matches!(self.stepper.integrate_along(of_step, bound), Ok(true)));
        // If this did not help once, it is not tried again: the residual stays, and the run reports it.
        self.record.is_unexplained = !known;
        if known
            && let Some(integrals) = self.stepper.quadratures().integrals()
            && let Some(now) = self.record.energies.last_mut()
        {
            (now.work, now.dissipated) = (integrals.work(), integrals.dissipated());
            self.correct_energy_entry();
        }
    }

    /// Present kinetic and potential energy and the integrals so far, if their balance is kept; without [`stored_now`](Self::stored_now).
    fn energies_now(&self) -> Option<Energies> {
        let Self { model, stepper, .. } = self;
        let integrals = stepper.quadratures().integrals()?;
        let (t, q, v) = (stepper.t(), stepper.q(), stepper.v());
        Some(Energies {
            t,
            kinetic: model.system.kinetic_energy(t, q, v),
            potential: model.system.potential_energy(t, q, &model.inputs(t, q, v)),
            work: integrals.work(),
            dissipated: integrals.dissipated(),
        })
    }

    /// Energy that first-order states and compliant contacts store now, in J.
    fn stored_now(&self) -> f64 {
        let Self { model, stepper, .. } = self;
        let (t, q, v) = (stepper.t(), stepper.q(), stepper.v());
        let mut stored = model.system.state_energy(t, q, v);
        if <M::System as System>::MAY_COLLIDE
            && let Some(touching) = stepper.touching()
        {
            stored += touching.stored(model.system, t, q, v);
        }
        stored
    }

    fn shall_stop(&mut self) -> bool {
        let Self {
            model,
            stepper,
            callbacks,
            ..
        } = self;
        let Some(stop) = &mut callbacks.stop else {
            return false;
        };
        stop(&state(
            model.system,
            (stepper.t(), stepper.q().clone(), stepper.v().clone()),
        ))
    }
}

/// The last step, as an observer sees it.
struct LastStep<'w, 'r, 's, S: System, L, K, A> {
    model: &'w Model<'r, S, L>,
    stepper: &'w mut Stepper<'s, S, K, A>,
    interpolant: &'w mut Option<Interpolant<S::Vector>>,
}

impl<M, L, K, A> StepMotion<M> for LastStep<'_, '_, '_, M::System, L, K, A>
where
    M: Machine,
    L: InputLaw<M::System>,
    K: InputLaw<M::System>,
    A: Quadratures<M::System>,
{
    fn span(&self) -> [f64; 2] {
        [self.stepper.t_before(), self.stepper.t()]
    }

    fn is_series(&self) -> bool {
        self.stepper.coefficients().is_some()
    }

    fn state_at(
        &mut self,
        theta: f64,
        q: &mut VectorOf<M>,
        v: &mut VectorOf<M>,
    ) -> Result<f64, Error> {
        let Self { model, stepper, .. } = self;
        if theta == 0.0 {
            q.clone_from(stepper.q_before());
            v.clone_from(stepper.v_before());
            return Ok(stepper.t_before());
        }
        let interpolant = step_motion(self.interpolant, stepper, model.system)?;
        event::state_into(model.system, stepper, interpolant, theta, [q, v])
    }

    fn state(&mut self, t: f64) -> Result<State<Coordinates<M>>, Error> {
        let Self { model, stepper, .. } = self;
        let [from, to] = [stepper.t_before(), stepper.t()];
        let system = model.system;
        let (q, v) = match t {
            _ if t == to => (stepper.q().clone(), stepper.v().clone()),
            _ if t == from => (stepper.q_before().clone(), stepper.v_before().clone()),
            _ => {
                let (mut q, mut v) = step_motion(self.interpolant, stepper, system)?.state(t);
                stepper
                    .project(t, &mut q, &mut v)
                    .map_err(|error| Error::of_step(error, system))?;
                (q, v)
            }
        };
        Ok(state(system, (t, q, v)))
    }

    fn inputs(&self, t: f64, q: &VectorOf<M>, v: &VectorOf<M>) -> Inputs<M> {
        self.model.inputs(t, q, v)
    }

    fn accelerations(
        &self,
        (t, q, v): (f64, &VectorOf<M>, &VectorOf<M>),
        u: &Inputs<M>,
        a: &mut VectorOf<M>,
    ) -> Result<(), Error> {
        let system = self.model.system;
        ConstraintState::of(self.stepper)
            .accelerations(system, At { t, q, v, u }, a)
            .map_err(|error| Error::of_step(error, system))
    }
}

/// A system with its inputs.
struct Model<'r, S: System, L> {
    system: &'r S,
    observed_system: ObservedSystem<'r, S, L>,
    /// Time and coordinates at the start of the run.
    start: (f64, &'r S::Vector),
}

impl<S: System, L: InputLaw<S>> Model<'_, S, L> {
    fn inputs(&self, t: f64, q: &S::Vector, v: &S::Vector) -> S::Inputs {
        self.observed_system.inputs(t, q, v)
    }

    /// Converts the error of a step; `q` and `v` are the state at its beginning.
    fn explain(&self, error: StepError, q: &S::Vector, v: &S::Vector) -> Error {
        if let StepError::NotFinite { t, .. } = error {
            let inputs = self.inputs(t, q, v);
            let mut values = self.system.input_values(&inputs);
            if let Some((input, value)) = values.find(|(_, value)| !value.is_finite()) {
                return Error::InputNotFinite {
                    input: input.name.into(),
                    value,
                    t,
                };
            }
        }
        match self.fork(&error, q, v) {
            Some(fork) => fork,
            None => contradiction(error, self.system, q, v),
        }
    }

    /// The error of a run that stops because constraints become linearly dependent.
    fn fork(&self, error: &StepError, q: &S::Vector, v: &S::Vector) -> Option<Error> {
        let (StepError::StepTooSmall { t, .. }
        | StepError::Inconsistent { t, .. }
        | StepError::Singular { t, .. }) = *error
        else {
            return None;
        };
        if !S::MAY_BE_CONSTRAINED {
            return None;
        }
        let mut known = Constraints::new(self.system, q, v);
        let weakest = known.weakest(self.system, self.start, (t, q)).ok()??;
        let (row, left) = weakest;
        (left < NEAR_FORK).then(|| Error::Fork {
            constraint: constraint_name(self.system, row),
            left,
            t,
        })
    }
}

/// Projects the start of a run onto the constraints. Returns warnings: how far each number was moved, and which constraints are redundant.
fn project_start<S: System>(
    system: &S,
    t: f64,
    q: &mut S::Vector,
    v: &mut S::Vector,
    kept: Option<[S::Vector; 2]>,
) -> Result<Vec<Warning>, Error> {
    let requested = [q.clone(), v.clone()];
    let mut known = Constraints::new(system, q, v);
    let mut start = Point::new(t, q.clone(), v.clone());
    let mut projected = known.begin(system, &mut start.place(), kept.clone());
    if let (Err(_), Some(kept)) = (&projected, kept) {
        start = Point::new(t, q.clone(), v.clone());
        let violations = closest(system, &mut start.place(), &kept);
        if let Some(error) = contradicts_kept(system, &start, &kept, &violations) {
            return Err(error);
        }
        // The projection converges from here, since this start is near the constraints.
        known = Constraints::new(system, q, v);
        projected = known.begin(system, &mut start.place(), Some(kept));
    }
    projected.map_err(|error| match error {
        // At rest in a state in which rows are dependent that are independent next to it.
        StepError::Singular { singular, t } => match singular.at {
            Pivot::Constraint(row) => Error::Fork {
                constraint: constraint_name(system, row),
                left: 0.0,
                t,
            },
            _ => contradiction(error, system, q, v),
        },
        _ => contradiction(error, system, q, v),
    })?;
    (*q, *v) = (start.q, start.v);

    let mut found = Vec::new();
    for (constraint, with) in dependences(&known, system, t, q) {
        found.push(Warning::RedundantConstraint { constraint, with });
    }
    for (level, now) in [&*q, &*v].into_iter().enumerate() {
        for (j, coordinate) in system.coordinates().enumerate() {
            let (from, to) = (requested[level].as_slice()[j], now.as_slice()[j]);
            if (to - from).abs() <= ROUNDING_OF_START * known.sizes(j)[level] {
                continue;
            }
            let name = coordinate_or_rate_name(coordinate.name, level);
            found.push(Warning::StartMoved { name, from, to });
        }
    }
    Ok(found)
}

/// The error of a start whose kept numbers contradict the constraints; `best` is the state that violates them least. `None` if no kept
/// number takes part in a constraint that is violated.
fn contradicts_kept<S: System>(
    system: &S,
    best: &Point<S::Vector>,
    kept: &[S::Vector; 2],
    violations: &[Violation],
) -> Option<Error> {
    let n = best.q.as_slice().len();
    let m = system.constraints().len();
    let mut rows = std::vec![0.0; m * n];
    system.constraint_matrix(best.t, &best.q, &mut rows);
    let contradiction = |&(row, level, residual): &Violation| {
        let is_kept = |j: usize| kept[level].as_slice()[j] != 0.0 && rows[row * n + j] != 0.0;
        let coordinates = system.coordinates().enumerate();
        let kept = coordinates.filter(|(j, _)| is_kept(*j));
        let constraint = system.constraints().nth(row)?;
        let of_rates = level == 1 && constraint.holonomic;
        Some(KeptContradiction {
            constraint: constraint.name.into(),
            of_rates,
            kept: kept
                .map(|(_, of)| coordinate_or_rate_name(of.name, level))
                .collect(),
            residual,
            unit: if of_rates {
                std::format!("{}/s", constraint.unit)
            } else {
                constraint.unit.into()
            },
        })
    };
    let contradictions: Vec<_> = violations.iter().filter_map(contradiction).collect();
    let is_kept = contradictions.iter().any(|of| !of.kept.is_empty());
    is_kept.then_some(Error::KeptStart {
        contradictions,
        t: best.t,
    })
}

/// The name of a coordinate or of its rate.
fn coordinate_or_rate_name(coordinate: &str, level: usize) -> String {
    match level {
        0 => coordinate.into(),
        _ => rate_name(coordinate),
    }
}

/// If the independent part of a constraint is shorter than this when a run stops, it is the cause: round-off in the residuals of positions
/// is amplified in the rates by its inverse square, which costs ten digits here.
const NEAR_FORK: f64 = 1e-2;

/// Moves of the start below this, relative to the size of a number, are not reported: they are about as large as the round-off in a formula
/// for a start value.
const ROUNDING_OF_START: f64 = 1e-12;

/// The constraints that were not chosen at a state, by name, each with those that it depends on.
fn dependences<S: System>(
    known: &Constraints<S::Vector>,
    system: &S,
    t: f64,
    q: &S::Vector,
) -> Vec<(String, Vec<String>)> {
    let names = |index: &usize| constraint_name(system, *index);
    let dependences = known.dependences(system, t, q).unwrap_or_default();
    let named = |(row, on): (usize, Vec<usize>)| (names(&row), on.iter().map(names).collect());
    dependences.into_iter().map(named).collect()
}

/// The error of a step; if constraints contradict each other, with their names.
fn contradiction<S: System>(error: StepError, system: &S, q: &S::Vector, v: &S::Vector) -> Error {
    let mut error_of_run = Error::of_step(error, system);
    if let Error::FrictionParadox {
        q: at, v: rates, ..
    }
    | Error::Contact {
        q: at, v: rates, ..
    } = &mut error_of_run
    {
        (*at, *rates) = (q.as_slice().to_vec(), v.as_slice().to_vec());
    }
    if S::MAY_BE_CONSTRAINED
        && let Error::InconsistentConstraints {
            constraint,
            with,
            t,
            ..
        } = &mut error_of_run
    {
        let mut known = Constraints::new(system, q, v);
        if known.choose_again(system, *t, q).is_ok() {
            let on = dependences(&known, system, *t, q);
            let own = on.into_iter().find(|(name, _)| name == constraint);
            *with = own.map_or_else(Vec::new, |(_, on)| on);
        }
    }
    error_of_run
}

impl Settings {
    /// Checks all settings and returns the end of the run.
    fn check(&self) -> Result<f64, Error> {
        let until = self.until.ok_or(Error::NoEnd)?;
        let check = |setting, value: f64, is_good: bool, needed| {
            if is_good {
                Ok(())
            } else {
                Err(Error::InvalidSetting {
                    setting,
                    value,
                    needed,
                })
            }
        };
        let positive = |value: f64| value > 0.0 && value.is_finite();
        check("until", until, until.is_finite(), "a finite time")?;
        let is_good = self.relative >= 0.0 && self.relative < 1.0;
        if self.one_tolerance {
            let is_good = is_good && positive(self.absolute);
            let needed = "greater than 0 and less than 1";
            check("tolerance", self.absolute, is_good, needed)?;
        }
        check(
            "relative",
            self.relative,
            is_good,
            "at least 0 and less than 1",
        )?;
        check(
            "absolute",
            self.absolute,
            positive(self.absolute),
            "greater than 0",
        )?;
        for (_, value) in &self.absolute_of {
            check("absolute_of", *value, positive(*value), "greater than 0")?;
        }
        if let Some(step) = self.first_step {
            check("first_step", step, positive(step), "greater than 0")?;
        }
        check(
            "longest_step",
            self.longest_step,
            self.longest_step > 0.0,
            "greater than 0",
        )?;
        if let Some(interval) = self.every {
            check("every", interval, positive(interval), "greater than 0")?;
        }
        for interval in &self.observed_every {
            check("observe", *interval, positive(*interval), "greater than 0")?;
        }
        Ok(until)
    }

    /// Which numbers of the start are kept, coordinates and rates: those that are not 0 in the result.
    fn kept_start_values<S: System>(
        &self,
        system: &S,
        is_resumed: bool,
    ) -> Result<Option<[S::Vector; 2]>, Error> {
        let names = match &self.kept {
            Some(names) => names.clone(),
            // The description's choice refers to its own start.
            None if is_resumed => Vec::new(),
            None => system.kept_at_start().map(String::from).collect(),
        };
        if names.is_empty() {
            return Ok(None);
        }
        let zeros = || S::Vector::zeros(system.coordinates().len());
        let mut kept = [zeros(), zeros()];
        for name in &names {
            let rate = name
                .strip_prefix("der(")
                .and_then(|rest| rest.strip_suffix(')'));
            let (level, asked) = rate.map_or((0, name.as_str()), |rate| (1, rate));
            let mut is_known = false;
            for (j, coordinate) in system.coordinates().enumerate() {
                let member = coordinate.name.strip_prefix(asked);
                if member.is_some_and(|member| member.is_empty() || member.starts_with('[')) {
                    kept[level].as_mut_slice()[j] = 1.0;
                    is_known = true;
                }
            }
            if !is_known {
                return Err(Error::UnknownCoordinate { name: name.clone() });
            }
        }
        Ok(Some(kept))
    }

    fn tolerance<S: System>(&self, system: &S) -> Result<Tolerance<S::Vector>, Error> {
        let mut absolute = S::Vector::zeros(system.coordinates().len());
        absolute.as_mut_slice().fill(self.absolute);
        for (name, tolerance) in &self.absolute_of {
            let index = system
                .coordinates()
                .position(|coordinate| coordinate.name == name)
                .ok_or_else(|| Error::UnknownCoordinate { name: name.clone() })?;
            absolute.as_mut_slice()[index] = *tolerance;
        }
        Ok(Tolerance {
            relative: self.relative,
            absolute,
        })
    }
}

fn check_parameters<M: Machine>(machine: &M) -> Result<(), Error> {
    let mut parameters = machine.parameters();
    match parameters.find(|(_, value)| !value.is_finite()) {
        Some((parameter, value)) => Err(Error::ParameterNotFinite {
            parameter: parameter.name.into(),
            value,
        }),
        None => Ok(()),
    }
}

fn check_start<S: System>(system: &S, t: f64, q: &S::Vector, v: &S::Vector) -> Result<(), Error> {
    if !t.is_finite() {
        return Err(Error::StartNotFinite {
            name: "t".into(),
            value: t,
        });
    }
    let (q, v) = (q.as_slice().iter(), v.as_slice().iter());
    for (coordinate, (&q, &v)) in system.coordinates().zip(q.zip(v)) {
        let name = coordinate.name;
        if !q.is_finite() {
            return Err(Error::StartNotFinite {
                name: name.into(),
                value: q,
            });
        }
        if !v.is_finite() {
            return Err(Error::StartNotFinite {
                name: rate_name(name),
                value: v,
            });
        }
    }
    Ok(())
}

fn balance<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    stepper: &Stepper<'_, S, L, A>,
    energies: &[Energies],
    explained: &ExplainedResidual,
    (kinetic_energy, has_fixed_steps): (f64, bool),
) -> Option<EnergyBalance> {
    let integrals = stepper.quadratures().integrals()?;
    let (first, last) = (energies.first()?, energies.last()?);
    let exchanged = kinetic_energy + integrals.absolute_work() + last.dissipated;
    Some(EnergyBalance {
        explained: if has_fixed_steps {
            f64::INFINITY
        } else {
            explained.total(exchanged)
        },
        start: first.kinetic + first.potential,
        end: last.kinetic + last.potential,
        work: last.work,
        dissipated: last.dissipated,
        exchanged,
    })
}

fn warnings<S: System, L: InputLaw<S>, A: Quadratures<S>>(
    settings: &Settings,
    stepper: &Stepper<'_, S, L, A>,
) -> Vec<Warning> {
    let mut warnings = Vec::new();
    // A relative tolerance of 0 requests control by the absolute tolerance alone.
    if settings.relative > 0.0 && settings.relative < LEAST_RELATIVE_TOLERANCE {
        let (asked, used) = (settings.relative, LEAST_RELATIVE_TOLERANCE);
        warnings.push(Warning::ToleranceRaised { asked, used });
    }
    if let Some(t) = stepper.stiff_since() {
        warnings.push(Warning::Stiff { t });
    }
    warnings
}
