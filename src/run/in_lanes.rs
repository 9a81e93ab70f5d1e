//! Makes many runs, several at a time in vector lanes: a lane whose run is over takes the next one.
//!
//! A run in a lane is the same as alone, step by step; only the attempts of steps are made for all lanes together
//! (`src/stepper/in_lanes.rs`). So a run has the bits that it has alone, whatever its neighbours do. Each has its own events and contacts. A run
//! that changes its method goes on with others that have changed to the same one; steps that are neither explicit nor by series are made alone.

use std::collections::VecDeque;
use std::iter::Enumerate;
use std::slice::IterMut;
use std::vec::Vec;

use super::{BetweenSteps, Finished, Prepared, RunOf};
use crate::settings::TaskWithStart;
use crate::solution::{Ending, RunResult};
use crate::step_error::StepError;
use crate::stepper::in_lanes::{Attempts, Evaluate, LaneMask, StepAttempt, WIDTH};
use crate::{Error, Inputs, Machine};

/// Fewer runs than this are made one after the other, which is faster than in lanes of which most are idle.
const FEWEST_RUNS: u32 = 3;

/// The machines of all lanes.
pub(crate) trait Machines<M: Machine>: Evaluate {
    /// Puts a machine with its inputs into a lane, if it is of the same kind as the others.
    fn put(&mut self, lane: usize, system: &M::System, inputs: &Inputs<M>) -> bool;
}

/// A run that is under way in a lane.
struct Lane<'r, 'a, 'l, M: Machine> {
    index: usize,
    run: RunOf<'r, 'a, 'l, M>,
    between: BetweenSteps,
    next: Option<StepAttempt>,
}

/// How a run ends.
type End = Result<Ending, Error>;

/// A run that has ended, or the error for which it could not begin.
type Ended<M> = Result<Finished<M>, Error>;

/// Prepares and makes all these runs, and returns their results in the same order.
pub(crate) fn run_tasks<M: Machine>(
    tasks: Vec<TaskWithStart<'_, '_, M>>,
    machines: &mut impl Machines<M>,
) -> Vec<RunResult<M>> {
    let mut all = Vec::new();
    let mut results: Vec<Option<RunResult<M>>> = Vec::new();
    for (task, start) in tasks {
        match Prepared::new(task, start) {
            Ok(prepared) => {
                all.push(prepared);
                results.push(None);
            }
            Err(error) => results.push(Some(Err(error))),
        }
    }
    let ended = run_all(&mut all, machines);
    let solutions = all.into_iter().zip(ended);
    let mut solutions =
        solutions.map(|(prepared, ended)| ended.map(|finished| prepared.results(finished)));
    let results = results.into_iter();
    results
        .filter_map(|made| made.or_else(|| solutions.next()))
        .collect()
}

/// The runs that wait for a lane, and the results of those that have ended.
struct Runs<'r, 'a, 'l, M: Machine> {
    queue: Enumerate<IterMut<'r, Prepared<'a, 'l, M>>>,
    /// Runs that have begun and whose method is another one than that of the lanes now.
    parked: VecDeque<Lane<'r, 'a, 'l, M>>,
    ended: Vec<Option<Ended<M>>>,
    attempts: Option<Attempts>,
}

/// Makes all these runs, and returns their results in the same order.
///
/// All lanes have one method at a time. A run that changes its method leaves its lane, and waits until no run by the method of the lanes is left.
fn run_all<M: Machine>(
    prepared: &mut [Prepared<'_, '_, M>],
    machines: &mut impl Machines<M>,
) -> Vec<Ended<M>> {
    let mut runs = Runs {
        ended: prepared.iter().map(|_| None).collect(),
        queue: prepared.iter_mut().enumerate(),
        parked: VecDeque::new(),
        attempts: None,
    };
    let mut lanes: [_; WIDTH] = std::array::from_fn(|_| None);
    loop {
        for (number, lane) in lanes.iter_mut().enumerate() {
            runs.refill((number, lane), machines);
        }
        if lanes.iter().all(Option::is_none) {
            match runs.parked.front() {
                Some(Lane { run, .. }) => runs.attempts = Some(Attempts::new(&run.stepper)),
                None => break,
            }
            continue;
        }
        let Some(attempts) = runs.attempts.as_mut() else {
            break;
        };
        let mut together: LaneMask = 0;
        for (number, lane) in lanes.iter_mut().enumerate() {
            if let Some(Lane { run, next, .. }) = lane
                && let Some(next) = next
            {
                attempts.put(number, &mut run.stepper, *next);
                together |= 1 << number;
            }
        }
        match together.count_ones() {
            few if few < FEWEST_RUNS => attempts.skip(),
            _ => attempts.attempt(together, machines),
        }
        for (number, lane) in lanes.iter_mut().enumerate() {
            let attempted = |lane: &mut Lane<'_, '_, '_, M>| lane.finish_attempt(number, attempts);
            if let Some(ending) = lane.as_mut().and_then(attempted) {
                end(lane, ending, &mut runs.ended);
            }
        }
    }
    // Each run was begun, and a lane is empty only if its run has ended.
    runs.ended.into_iter().flatten().collect()
}

/// Empties a lane whose run has ended.
fn end<M: Machine>(
    lane: &mut Option<Lane<'_, '_, '_, M>>,
    ending: End,
    ended: &mut [Option<Ended<M>>],
) {
    if let Some(Lane { index, run, .. }) = lane.take() {
        ended[index] = Some(Ok(run.end(ending)));
    }
}

impl<'r, 'a, 'l, M: Machine> Runs<'r, 'a, 'l, M> {
    /// Brings the run in a lane, or else the next ones, to an attempt that can be made together with others. Attempts that have to be made alone are
    /// made at once, so that lanes stay full. The lane is empty if no run is left for the method of the lanes.
    fn refill(
        &mut self,
        (number, lane): (usize, &mut Option<Lane<'r, 'a, 'l, M>>),
        machines: &mut impl Machines<M>,
    ) {
        loop {
            if let Some(begun) = lane {
                match begun.go_on_alone() {
                    Some(ending) => end(lane, ending, &mut self.ended),
                    None if self.fits(begun) => return,
                    None => self.parked.extend(lane.take()),
                }
            }
            if let Some(place) = self.parked.iter().position(|run| self.fits(run)) {
                let Some(mut parked) = self.parked.remove(place) else {
                    return;
                };
                let (system, inputs) = (parked.run.model.system, parked.run.stepper.inputs());
                if machines.put(number, system, inputs) {
                    *lane = Some(parked);
                } else {
                    let ending = parked.go_to_end_alone();
                    end(&mut Some(parked), ending, &mut self.ended);
                }
                continue;
            }
            let Some((index, prepared)) = self.queue.next() else {
                return;
            };
            let mut run = match prepared.begin() {
                Ok(run) => run,
                Err(error) => {
                    self.ended[index] = Some(Err(error));
                    continue;
                }
            };
            if !(run.sampling.is_none() && run.stepper.may_run_in_lanes()) {
                let ending = run.go_to_end();
                self.ended[index] = Some(Ok(run.end(ending)));
                continue;
            }
            // The first run decides with which method the lanes begin.
            self.attempts
                .get_or_insert_with(|| Attempts::new(&run.stepper));
            let mut begun = Lane {
                index,
                run,
                between: BetweenSteps::new(),
                next: None,
            };
            match begun.begin_step() {
                Some(ending) => end(&mut Some(begun), ending, &mut self.ended),
                None => self.parked.push_front(begun),
            }
        }
    }

    /// Whether the next attempt of a run is by the method of the lanes.
    fn fits(&self, lane: &Lane<'_, '_, '_, M>) -> bool {
        let attempts = self.attempts.as_ref();
        attempts.is_some_and(|attempts| attempts.is_compatible_with(&lane.run.stepper))
    }
}

impl<M: Machine> Lane<'_, '_, '_, M> {
    /// Begins the next step, or returns how the run ended.
    fn begin_step(&mut self) -> Option<End> {
        loop {
            if self.run.stepper.is_done() {
                let between = std::mem::replace(&mut self.between, BetweenSteps::new());
                return Some(between.ending);
            }
            if let Err(error) = self.run.check_count() {
                return Some(Err(error));
            }
            if !self.run.stepper.may_run_in_lanes() {
                let stepped = self.run.stepper.step();
                if let Some(ending) = self.observe_step(stepped) {
                    return Some(ending);
                }
                continue;
            }
            match self.run.stepper.begin_in_lanes() {
                Ok(next) => {
                    self.next = Some(next);
                    return None;
                }
                Err(error) => {
                    if let Some(ending) = self.observe_step(Err(error)) {
                        return Some(ending);
                    }
                }
            }
        }
    }

    /// Makes all further steps.
    fn go_to_end_alone(&mut self) -> End {
        loop {
            let ended = match self.next.take() {
                Some(of) => {
                    let attempted = self.run.stepper.end_alone(of);
                    self.continue_after(attempted)
                }
                None => self.begin_step(),
            };
            if let Some(ending) = ended {
                return ending;
            }
        }
    }

    /// Makes attempts for as long as they have to be made alone; returns how the run ended if it did.
    fn go_on_alone(&mut self) -> Option<End> {
        while !self.run.stepper.may_try_in_lanes()
            && let Some(of) = self.next.take()
        {
            let attempted = self.run.stepper.end_alone(of);
            if let Some(ending) = self.continue_after(attempted) {
                return Some(ending);
            }
        }
        None
    }

    /// Ends an attempt that was made in lanes; returns how the run ended if it did.
    fn finish_attempt(&mut self, lane: usize, attempts: &mut Attempts) -> Option<End> {
        let of = self.next.take()?;
        let attempted = self.run.stepper.end_in_lanes(lane, of, attempts);
        self.continue_after(attempted)
    }

    /// Continues after an attempt: with the next one, or the next step if this one was taken.
    fn continue_after(&mut self, attempted: Result<Option<StepAttempt>, StepError>) -> Option<End> {
        let stepped = match attempted {
            Ok(Some(next)) => {
                self.next = Some(next);
                return None;
            }
            Ok(None) => Ok(()),
            Err(error) => Err(error),
        };
        self.observe_step(stepped).or_else(|| self.begin_step())
    }

    fn observe_step(&mut self, stepped: Result<(), StepError>) -> Option<End> {
        let looked = self.run.examine_step(&mut self.between, stepped);
        looked.transpose()
    }
}
