//! Makes a run: takes step after step, and after each one looks for events, samples, changes of contacts, and ends of assumptions.

mod assumptions;
mod choosing;
mod comparing;
mod contact_search;
pub(crate) mod contacts;
mod ending;
mod explained;
mod flights;
mod guides;
mod handing_over;
pub(crate) mod in_lanes;
pub(crate) mod in_pieces;
mod reasons;
mod recording;
pub(crate) mod sampled;
mod start;
mod stepping;

use sampled::Sampling;
use std::boxed::Box;
use std::string::String;
use std::time::Instant;
use std::vec::Vec;

use crate::at::At;
use crate::balance::{Energies, EnergyBalance, EnergyIntegrals, Quadratures};
use crate::constraints::Constraints;
use crate::contact::Mode;
use crate::equations::check_equations;
use crate::event::{self, EndOfStep, Event, Terminal, Unsearched, state};
use crate::friction::{Change, Contacts};
use crate::inputs::{InputLaw, Law, LawInPiece};
use crate::interpolant::Interpolant;
use crate::methods::{Method, MethodKind};
use crate::observation::ObservedSystem;
use crate::phases::UnilateralRecord;
use crate::piece::Piece;
use crate::settings::{Callbacks, Settings, Task, asked_to_stop};
use crate::solution::{Ending, Handover, MethodChoice, MethodReason, RunResult, Statistics, Steps};
use crate::step_error::StepError;
use crate::stepper::{BorrowedOrOwned, Stepper};
use crate::tolerance::Tolerance;
use crate::{Coordinates, Error, Inputs, Machine, State, System, Warning};
use assumptions::Held;
use choosing::{Ahead, Beginning, CANDIDATES, Choosing};
use contact_search::ContactLooks;
use contacts::PendingChange;
use explained::ExplainedResidual;
use flights::{Flights, explicit_for};
use handing_over::ContactActivity;
use start::{check_start, prepared, project_start};

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
    Ok(prepared.results(finished))
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
    /// What is known of the constraints at the start, if it was on them as it was given.
    constraints: Option<Constraints<VectorOf<M>>>,
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
///
/// In a box: a run is large, and moved several times, which would take as long as a step of a small machine.
pub(crate) type RunOf<'r, 'a, 'l, M> =
    Box<Run<'r, 'a, M, Law<'l, <M as Machine>::System>, Option<EnergyIntegrals>>>;

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
        let system = prepared(subject)?;
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
        let (mut start, mut start_warnings, mut constraints) = (start, Vec::new(), None);
        if <M::System as System>::MAY_BE_CONSTRAINED && system.constraints().len() != 0 {
            let kept = settings.kept_start_values(&system, is_resumed)?;
            (start_warnings, constraints) = project_start(&system, start.t, &mut q, &mut v, kept)?;
            start = state(&system, (start.t, q.clone(), v.clone()));
        } else if settings.keeps_by_name() {
            // Nothing moves the start, but a name that does not exist is a mistake.
            settings.kept_start_values(&system, is_resumed)?;
        }
        let ended = resumed.filter(|resumed| resumed.t == start.t);
        let ended = ended.and_then(|resumed| resumed.event);
        let inputs_stay = law.is_constant() && callbacks.sampled.is_none();
        let chosen = (settings.automatic).then(|| {
            if !inputs_stay {
                return Beginning::explicit();
            }
            let ahead = Ahead {
                left: until - start.t,
                keeps_balance: settings.energy_balance,
            };
            choosing::first(
                &system,
                (start.t, &q, &v),
                &tolerance,
                (ahead, settings.one_of),
            )
        });
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
            constraints,
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
        let (system, start, q, v) = (&self.system, &self.start, &self.q, &self.v);
        let (until, piece) = (self.until, self.piece);
        let (settings, callbacks) = (&mut self.settings, &mut self.callbacks);
        let chosen = &mut self.chosen;
        let quadratures = settings.energy_balance.then(EnergyIntegrals::default);
        let sampling = callbacks.sampled.as_ref().map(|of| of.begin(system));
        let sampled_inputs = sampling.is_some().then(|| system.default_inputs());
        let law = LawInPiece {
            law: &self.law,
            sampled: sampled_inputs.clone(),
            piece,
        };
        let model = Model {
            system,
            observed_system: ObservedSystem { system, law },
            start: (start.t, q),
        };
        model.check_assumptions((start.t, q.clone(), v.clone()))?;
        let has_contacts = system.unilateral_contacts().len() != 0;
        let flies_by_series = has_contacts && settings.method.kind == MethodKind::Series;
        let begun = |mut method: &'static Method| {
            if flies_by_series {
                // Whether it begins with a flight is known once contacts are resolved.
                let law = &model.observed_system.law;
                Stepper::<_, _, Option<EnergyIntegrals>>::check_series(system, law, start.t)?;
                method = explicit_for(method);
            }
            let stepper = Stepper::begun(
                BorrowedOrOwned::Borrowed(system),
                model.observed_system.law.clone(),
                quadratures.clone(),
                method,
                self.tolerance.clone(),
                ((start.t, q.clone(), v.clone()), self.constraints.clone()),
                until,
            );
            stepper.map(Box::new)
        };
        let begun = begun_by_choice(begun, &mut settings.method, chosen);
        let mut stepper = begun.map_err(|error| model.explain(error, q, v))?;
        if !self.is_resumed {
            let (t, u) = (start.t, stepper.inputs());
            check_equations(system, At { t, q, v, u })?;
        }
        stepper.set_longest_step(settings.longest_step);
        if let Some(step) = settings.first_step {
            stepper.set_first_step(step);
        }
        if let Some(beginning) = *chosen {
            stepper.count_evaluations(beginning.evaluations);
        }
        let begun = |choice| Choosing::begun(start.t, choice, !has_contacts, settings.one_of);
        let choosing = chosen.map_or_else(Choosing::none, begun);
        let mut run = Box::new(Run {
            model,
            stepper,
            callbacks,
            start: start.t,
            until,
            stop: until,
            most_steps: settings.max_steps,
            sampling,
            next_step: None,
            activity: activity(system, settings),
            contact_looks: ContactLooks::default(),
            held: None,
            flights: Flights::new(flies_by_series, chosen.filter(|_| has_contacts)),
            choosing,
            shown: None,
            record: Record::begun(settings, start, sampled_inputs, piece),
            settings,
        });
        run.begin_at(start, self.ended.as_deref())?;
        Ok(run)
    }
}

/// Begins a stepper with a method, or with `dop853` if the run has chosen series and there are none at its start.
fn begun_by_choice<T>(
    begun: impl Fn(&'static Method) -> Result<T, StepError>,
    method: &mut &'static Method,
    chosen: &mut Option<Beginning>,
) -> Result<T, StepError> {
    let stepper = begun(method);
    if stepper.is_ok() || chosen.is_none() || method.kind != MethodKind::Series {
        return stepper;
    }
    *chosen = Some(Beginning::with(Method::DOP853, MethodReason::NoSeries));
    *method = Method::DOP853;
    begun(method)
}

/// How frequently contacts change: nothing yet.
fn activity<S: System>(system: &S, settings: &Settings) -> ContactActivity {
    let may_hand_over = matches!(
        settings.method.kind,
        MethodKind::RungeKutta | MethodKind::Series
    );
    let contacts = system.unilateral_contacts();
    ContactActivity::new(
        settings.hands_over && may_hand_over,
        system.guides(),
        contacts.map(|contact| contact.is_second_tangent).collect(),
    )
}

/// A run in progress.
pub(crate) struct Run<'r, 'a, M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> {
    model: Model<'r, M::System, L>,
    /// In a box for the same reason.
    stepper: Box<StepperOf<'r, M, L, A>>,
    settings: &'r Settings,
    callbacks: &'r mut Callbacks<'a, M>,
    start: f64,
    until: f64,
    /// Where the stepper stops next: where the inputs are not smooth, at a sample or a delayed action of a controller, or at the end.
    stop: f64,
    /// The largest number of steps of the run so far, and to its end.
    most_steps: usize,
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
    /// How it goes on while all unilateral contacts are open.
    flights: Flights,
    /// The choice of the method, if the run makes it.
    choosing: Choosing,
    /// Memory of the state that is shown to the function that may stop the run.
    shown: Option<State<Coordinates<M>>>,
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
    explained: ExplainedResidual<VectorOf<M>>,
    /// The number of steps whose residual remained unexplained.
    unexplained: usize,
}

type VectorOf<M> = <<M as Machine>::System as System>::Vector;

/// The stepper of a run.
type StepperOf<'r, M, L, A> = Stepper<'r, <M as Machine>::System, LawInPiece<'r, L, Inputs<M>>, A>;

impl<M: Machine> Record<M> {
    /// The records at the start of a run.
    fn begun(
        settings: &Settings,
        start: &State<Coordinates<M>>,
        sampled_inputs: Option<Inputs<M>>,
        piece: Piece,
    ) -> Self {
        let is_series = settings.method.kind == MethodKind::Series;
        let others: &[_] = if settings.automatic {
            &CANDIDATES
        } else if is_series && M::System::MAY_COLLIDE {
            &CANDIDATES[..1] // With unilateral contacts it is used while one is closed.
        } else {
            &[]
        };
        let sampled_inputs = sampled_inputs.map(|inputs| (start.t, inputs));
        Self {
            sampled_inputs: sampled_inputs.into_iter().collect(),
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
            unexplained: 0,
        }
    }

    /// Records an event of a watched function.
    fn push_watched(&mut self, event: Event<Coordinates<M>>) {
        self.unilateral.last_watched = event.state.t;
        self.events.push(event);
    }
}

/// The motion within the last step, computed on first use.
type LastInterpolant<M> = Option<Interpolant<VectorOf<M>>>;

impl<M: Machine, L: InputLaw<M::System>, A: Quadratures<M::System>> Run<'_, '_, M, L, A> {
    /// Looks at the start of the run: watched functions, observers, energies, contacts and the choice of the method. `ended` is the event
    /// that ended there the run that this one resumes.
    fn begin_at(
        &mut self,
        start: &State<Coordinates<M>>,
        ended: Option<&str>,
    ) -> Result<(), Error> {
        let Self {
            model,
            stepper,
            callbacks,
            ..
        } = self;
        for watch in &mut callbacks.watches {
            let observe = || model.observed_system.observe::<M, _>(stepper, start);
            watch.begin(start, ended == Some(&watch.name), &observe)?;
        }
        for stream in &mut callbacks.streams {
            stream.begin(start);
        }
        let contacts = self.stepper.contacts().iter();
        let contacts = contacts.map(|known| (start.t, known.for_later_observation()));
        self.record.contacts.extend(contacts);
        self.record_energies();
        if (self.record.energies.first()).is_some_and(|of| (of.kinetic + of.potential).is_nan()) {
            return Err(Error::EnergiesUnknown { t: start.t });
        }
        if <M::System as System>::MAY_COLLIDE {
            self.resolve_contacts_at_start()?;
        }
        self.begin_choosing()
    }

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
        if self.stepper.work().steps == self.most_steps {
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
        match self.examine_unless_stopped(between, stepped) {
            Ok(ending) => Ok(ending),
            Err(Unsearched::Failed(error)) => Err(error),
            Err(Unsearched::Stopped) => {
                // What happened in this step is not known: the run ends where it began.
                self.stepper.retreat(self.stepper.t_before());
                Ok(Some(Ending::Stopped))
            }
        }
    }

    /// [`examine_step`](Self::examine_step), unless the run is stopped during a search within the step.
    #[inline(always)]
    fn examine_unless_stopped(
        &mut self,
        between: &mut BetweenSteps,
        stepped: Result<(), StepError>,
    ) -> Result<Option<Ending>, Unsearched> {
        let BetweenSteps {
            ending,
            pending,
            last_change,
            pending_change,
        } = between;
        if let Err(error) = stepped {
            self.examine_failure(ending, error)?;
            return Ok(None);
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
                return Ok(self.change(pending, last_change)?);
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
            return Ok(Some(self.end_at(found)?));
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

    /// Examines a step that failed: the run may go on by another method.
    #[cold]
    fn examine_failure(
        &mut self,
        ending: &mut Result<Ending, Error>,
        error: StepError,
    ) -> Result<(), Error> {
        // Where an assumption ends there may be no accelerations to go on with; then the end of the assumption is the reason.
        std::mem::replace(ending, Ok(Ending::End))?;
        if self.leave_series(&error) {
            return Ok(());
        }
        let error = self.vanishing_gradient_error(&error).unwrap_or(error);
        let (q, v) = (self.stepper.q(), self.stepper.v());
        Err(self.model.explain(error, q, v))
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
    ) -> Result<Option<Terminal>, Unsearched> {
        let Self {
            model,
            stepper,
            callbacks,
            record,
            ..
        } = self;
        let known = record.events.len();
        let Callbacks { watches, stop, .. } = callbacks;
        let mut shall_stop = asked_to_stop::<M>(stop, model.system);
        let found = event::find(
            watches,
            (end, &mut shall_stop),
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

    /// Whether the last step was one of time stepping, whose length follows from no error estimate.
    fn is_stepped(&self) -> bool {
        <M::System as System>::MAY_COLLIDE && self.stepper.is_time_stepping()
    }

    fn shall_stop(&mut self) -> bool {
        let Self {
            model,
            stepper,
            callbacks,
            shown,
            ..
        } = self;
        let Some(stop) = &mut callbacks.stop else {
            return false;
        };
        let (t, q, v) = (stepper.t(), stepper.q(), stepper.v());
        match shown {
            Some(shown) => {
                shown.t = t;
                model.system.copy_to_coordinates(q, &mut shown.q);
                model.system.copy_to_coordinates(v, &mut shown.v);
                stop(shown)
            }
            none => stop(none.insert(state(model.system, (t, q.clone(), v.clone())))),
        }
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
}
