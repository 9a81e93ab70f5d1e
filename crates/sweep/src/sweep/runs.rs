//! The runs of a plan: each with its values, its simulation, and what becomes of it.

use std::sync::atomic::{AtomicBool, Ordering};

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem, Named, Signals};
use lagrangian::{Crossing, Ending, Machine, Observation, Simulation, Solution, State, System};
use lagrangian_spec::diagnostic::Severity;
use lagrangian_spec::model::Model;

use super::outcome::{Outcome, Recorder, sample};
use super::varied::VariedQuantity;
use super::{ReductionSource, Sweep, chosen};
use crate::charts::{self, Charts};
use crate::plan::{Function, Plan};
use crate::reduce::StateCache;
use crate::rows::Cell;
use crate::verdict;

/// The motion of a run.
type Motion = Solution<InterpretedMachine, Signals>;

/// A run before its simulation: its machine with the varied values, its start, and its observers.
struct PreparedRun {
    machine: InterpretedMachine,
    /// Evaluates formulas while the run uses its own system.
    system: InterpretedSystem,
    start: State<Named>,
    /// How the run is shown in the coordinates of the spec, if it is in others.
    charts: Option<Charts>,
    recorder: Recorder,
    /// Why the spec refuses these numbers, if it does.
    refused: Option<String>,
}

impl Sweep {
    /// Makes these runs, in lanes where the machine has code for that; `None` if they were stopped.
    pub(super) fn run_group(
        &self,
        runs: &[(u64, Vec<f64>)],
        refuses: Option<&Model<'_>>,
        stop: &AtomicBool,
    ) -> Option<Vec<Outcome>> {
        let mut begun: Vec<PreparedRun> = runs
            .iter()
            .map(|(_, values)| self.prepare_run(values, refuses))
            .collect();
        let mut simulations = Vec::new();
        for ((run, _), begun) in runs.iter().zip(&mut begun) {
            if begun.refused.is_none() {
                let start = begun.start.clone();
                simulations.push((self.simulation(*run, begun, stop), start));
            }
        }
        let made = Simulation::run_interpreted_in_lanes(simulations);
        let mut made = made.into_iter();
        let outcomes = runs.iter().zip(begun).map(|((run, _), begun)| {
            let (instants, reductions) = (begun.recorder.at.len(), self.reductions.len());
            let charts = begun.charts.as_ref();
            let start = charts::shown(charts, &begun.start);
            let failed = Outcome::failed(start, instants, reductions);
            if let Some(error) = begun.refused {
                let error = Some(error);
                return Some(Outcome { error, ..failed });
            }
            match made.next()? {
                Ok((solution, error)) => {
                    self.outcome(*run, (&solution, error), (begun.recorder, charts), failed)
                }
                Err(error) => {
                    let error = Some(self.message_of(&error));
                    Some(Outcome { error, ..failed })
                }
            }
        });
        outcomes.collect()
    }

    /// A run with its varied values, ready to start.
    fn prepare_run(&self, values: &[f64], refuses: Option<&Model<'_>>) -> PreparedRun {
        let plan = &self.plan;
        let mut machine = self.machine.clone();
        let mut cartesian = self.cartesian.as_ref().map(|of| of.machine.clone());
        let mut coordinates = [(&plan.start, Vec::new()), (&plan.rate, Vec::new())];
        for is_member in [false, true] {
            if is_member {
                // Of a family that is varied, members keep the values of their own.
                let members = plan.set.iter().filter(|(name, _)| name.contains('['));
                for (name, value) in members {
                    for machine in [Some(&mut machine), cartesian.as_mut()]
                        .into_iter()
                        .flatten()
                    {
                        drop(machine.set(name, *value)); // all names were checked
                    }
                }
            }
            let varied = self.varied.iter().zip(values);
            for (place, value) in varied.filter(|(place, _)| place.is_member() == is_member) {
                match place {
                    // All names were checked.
                    VariedQuantity::Set(name) => {
                        for machine in [Some(&mut machine), cartesian.as_mut()]
                            .into_iter()
                            .flatten()
                        {
                            drop(machine.set(name, *value));
                        }
                    }
                    VariedQuantity::Start(name) => coordinates[0].1.push((name, *value)),
                    VariedQuantity::Rate(name) => coordinates[1].1.push((name, *value)),
                }
            }
        }
        let mut start = machine.start();
        for ((given, varied), numbers) in coordinates.iter().zip([&mut start.q, &mut start.v]) {
            for is_member in [false, true] {
                let given = given.iter().map(|(name, value)| (name, *value));
                let varied = varied.iter().map(|(name, value)| (*name, *value));
                let both = given.chain(varied);
                for (name, value) in both.filter(|(name, _)| name.contains('[') == is_member) {
                    let _ = numbers.set(name, value); // the name was checked
                }
            }
        }
        let trackers = self.reductions.iter().map(|made| match made {
            ReductionSource::Along(tracker) => Some(tracker.clone()),
            ReductionSource::Of(..) => None,
        });
        let recorder = Recorder {
            trackers: trackers.collect(),
            at: vec![None; plan.at.len()],
            samples: self.empty_samples(),
            due: 0,
            cache: StateCache::default(),
        };
        let refused = refuses.and_then(|model| {
            let diagnostics = model.parameter_diagnostics(machine.parameter_values());
            let error = diagnostics
                .iter()
                .find(|diagnostic| diagnostic.code.severity() == Severity::Error)?;
            Some(format!("{} [{}]", error.message, error.code))
        });
        let mut charts = None;
        // A start at a negative distance exists only in the coordinates of the spec.
        if let (Some(in_other), Some(of)) = (cartesian, &self.cartesian)
            && let Ok((made, begun)) = Charts::begin(&of.points, in_other.start(), &start)
        {
            (machine, start, charts) = (in_other, begun, Some(made));
        }
        PreparedRun {
            system: machine.prepare(),
            machine,
            start,
            charts,
            recorder,
            refused,
        }
    }

    /// The simulation of a run.
    fn simulation<'r>(
        &'r self,
        run: u64,
        begun: &'r mut PreparedRun,
        stop: &'r AtomicBool,
    ) -> Simulation<'r, InterpretedMachine, Signals> {
        let plan = &self.plan;
        let PreparedRun {
            machine,
            system,
            recorder,
            charts,
            ..
        } = begun;
        let (system, charts) = (&*system, charts.as_ref());
        let mut simulation = self.with_events(self.settings(machine), system);
        let records_steps = self
            .reductions
            .iter()
            .any(|made| matches!(made, ReductionSource::Along(_)))
            || !plan.at.is_empty()
            || plan.every.is_some();
        if records_steps || charts.is_some() {
            // States are shown at instants that are not known before, or only at the end.
            let is_recorded = plan.has_samples() || !plan.at.is_empty();
            let marked_every = if is_recorded { 0.0 } else { f64::INFINITY };
            simulation = simulation.each_step(move |step| {
                if let Some(charts) = charts {
                    charts.follow(step, marked_every)?;
                }
                recorder.record_step(plan, run, (system, charts), step)
            });
        }
        simulation.stop_if(|_| stop.load(Ordering::Relaxed))
    }

    /// A simulation with the method, the tolerance, the inputs and the end of the plan.
    fn settings<'r>(
        &'r self,
        machine: &'r InterpretedMachine,
    ) -> Simulation<'r, InterpretedMachine, Signals> {
        let plan = &self.plan;
        let simulation = Simulation::new(machine)
            .tolerance(plan.tolerance)
            .until(plan.until)
            .max_steps(usize::try_from(plan.max_steps).unwrap_or(usize::MAX))
            .energy_balance(true)
            .forget_steps();
        let simulation = match self.method {
            Some(method) => simulation.method(method),
            None => simulation.automatic().one_of(plan.runs()),
        };
        let asks_for_power = (plan.reduce.iter()).any(|of| of.function == Function::Power);
        let simulation = if asks_for_power && plan.after.is_some() {
            simulation
        } else {
            simulation.forget_energies()
        };
        let mut simulation = self.signals.drive(simulation, machine);
        if let Some(keep) = &plan.keep {
            simulation = simulation.keep_none();
            for name in keep {
                simulation = simulation.keep(name);
            }
        }
        simulation
    }

    /// Adds the events of the plan, whose formulas `system` evaluates.
    fn with_events<'r>(
        &'r self,
        mut simulation: Simulation<'r, InterpretedMachine, Signals>,
        system: &'r InterpretedSystem,
    ) -> Simulation<'r, InterpretedMachine, Signals> {
        let function = move |output: usize, state: &State<Named>| {
            let mut u = system.default_inputs();
            let State { t, q, v } = state;
            lagrangian::InputLaw::set(&self.signals, system, *t, &q.values, &v.values, &mut u);
            system.output(output, *t, &q.values, &v.values, &[], &u.values)
        };
        for (watch, &output) in self.plan.events.iter().zip(&self.events) {
            if self.signals.is_sampled() {
                // This copy evaluates formulas; the run itself knows the held values of controllers.
                let system = system.clone();
                let output_of = move |seen: &Observation<InterpretedMachine>| {
                    let (q, v, u) = (&seen.q.values, &seen.v.values, &seen.inputs.values);
                    system.output(output, seen.t, q, v, &[], u)
                };
                simulation = if watch.ends {
                    simulation.until_event_on(&watch.name, Crossing::Any, output_of)
                } else {
                    simulation.event_on(&watch.name, Crossing::Any, output_of)
                };
                continue;
            }
            let function = move |state: &State<Named>| function(output, state);
            simulation = if watch.ends {
                simulation.until_event(&watch.name, Crossing::Any, function)
            } else {
                simulation.event(&watch.name, Crossing::Any, function)
            };
        }
        simulation
    }

    /// The outcome of a run that was started; `None` if it was stopped.
    fn outcome(
        &self,
        run: u64,
        (solution, error): (&Motion, Option<lagrangian::Error>),
        (mut recorder, charts): (Recorder, Option<&Charts>),
        mut outcome: Outcome,
    ) -> Option<Outcome> {
        let plan = &self.plan;
        if *solution.ending() == Ending::Stopped {
            return None;
        }
        let error = error.as_ref().map(|error| self.message_of(error));
        outcome.error = error.or_else(|| verdict::energy_error(solution));
        outcome.status = match (&outcome.error, solution.ending()) {
            (Some(_), _) => "failed".to_owned(),
            (None, Ending::Event(name)) => format!("event {name}"),
            (None, _) => "ended".to_owned(),
        };
        outcome.end = charts::shown(charts, solution.end());
        outcome.steps = solution.statistics().steps as u64;
        if self.method.is_none() {
            outcome.methods = Some(chosen::methods(solution.choices(), solution.handovers()));
        }
        outcome.residual = solution.energy_balance().map(|balance| balance.residual());
        let start = charts::shown(charts, solution.start());
        recorder.record_ends(plan, (run, &start, &outcome.end));
        if let Some(samples) = &mut recorder.samples {
            let events = solution.events().iter();
            for event in events.filter(|event| {
                plan.at_events.contains(&event.name) && self.is_evaluated(event.state.t)
            }) {
                let mut cells = sample(run, &charts::shown(charts, &event.state));
                cells.push(Cell::Text(Some(event.name.clone())));
                samples.push(cells);
            }
        }
        outcome.at = recorder.at;
        outcome.samples = recorder.samples;
        if outcome.error.is_none() {
            let made = self.reductions.iter().zip(&recorder.trackers);
            outcome.reductions = made
                .map(|(made, tracker)| match (made, tracker) {
                    (ReductionSource::Of(Function::Power, contact), _) => {
                        self.mean_loss(solution, contact)
                    }
                    (ReductionSource::Of(function, name), _) => {
                        self.of_events(solution, *function, name)
                    }
                    (_, Some(tracker)) => tracker.result(),
                    (_, None) => None,
                })
                .collect();
        }
        Some(outcome)
    }

    /// Whether what happens at this time is evaluated.
    fn is_evaluated(&self, t: f64) -> bool {
        let Plan { after, until, .. } = &self.plan;
        after.is_none_or(|after| (t - after) * until.signum() >= 0.0)
    }

    /// The mean power that a contact takes from a run, in W.
    fn mean_loss(&self, solution: &Motion, contact: &str) -> Option<f64> {
        let mut names = solution.system().unilateral_contacts();
        let k = names.position(|of| of.name == contact)?;
        let since = self.plan.after.unwrap_or(solution.start().t);
        let before = match self.plan.after {
            Some(after) => solution.contact_energies_at(after)?.get(k)?.lost(),
            None => 0.0,
        };
        let taken = solution.contact_energies().get(k)?.lost() - before;
        Some(taken / (solution.end().t - since))
    }

    /// A reduction of the instants of an event or of a contact.
    fn of_events(&self, solution: &Motion, function: Function, name: &str) -> Option<f64> {
        let since = self.plan.after.unwrap_or(solution.start().t);
        let events = solution.events().iter();
        let mut times = events
            .filter(|event| event.name == name && self.is_evaluated(event.state.t))
            .map(|event| event.state.t);
        match function {
            Function::Count => Some(times.count() as f64),
            Function::Frequency => {
                let length = (solution.end().t - since).abs();
                Some(times.count() as f64 / length)
            }
            Function::FirstEvent => times.next(),
            _ => times.next_back(),
        }
    }
}
