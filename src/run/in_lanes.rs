//! Makes many runs, several at a time in vector lanes: a lane whose run is over takes the next one.
//!
//! A run in a lane is the same as alone, step by step; only the tries of steps are made for all lanes together
//! (`src/stepper/in_lanes.rs`). So a run has the bits that it has alone, whatever its neighbours do.

use std::vec::Vec;

use super::{BetweenSteps, Finished, Prepared, RunOf};
use crate::solution::Ending;
use crate::step_error::StepError;
use crate::stepper::in_lanes::{Evaluate, LaneMask, Tries, Try, WIDTH};
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
    next: Option<Try>,
}

/// How a run ends.
type End = Result<Ending, Error>;

/// A run that has ended, or the error for which it could not begin.
type Ended<M> = Result<Finished<M>, Error>;

/// Makes all these runs, and returns their results in the same order.
pub(crate) fn run_all<'a, 'l, M: Machine>(
    prepared: &mut [Prepared<'a, 'l, M>],
    machines: &mut impl Machines<M>,
) -> Vec<Ended<M>> {
    let mut ended: Vec<Option<Ended<M>>> = prepared.iter().map(|_| None).collect();
    let mut queue = prepared.iter_mut().enumerate();
    let mut lanes: [Option<Lane<'_, 'a, 'l, M>>; WIDTH] = std::array::from_fn(|_| None);
    let mut tries: Option<Tries> = None;
    loop {
        let mut is_any_under_way = false;
        for (number, lane) in lanes.iter_mut().enumerate() {
            while lane.is_none()
                && let Some((index, prepared)) = queue.next()
            {
                let mut run = match prepared.begin() {
                    Ok(run) => run,
                    Err(error) => {
                        ended[index] = Some(Err(error));
                        continue;
                    }
                };
                let is_plain = run.sampling.is_none() && !run.settings.automatic;
                let steps = &run.stepper;
                let goes = is_plain && steps.may_run_in_lanes() && {
                    let tries = tries.get_or_insert_with(|| Tries::new(steps));
                    tries.is_compatible_with(steps)
                        && machines.put(number, run.model.system, steps.inputs())
                };
                if !goes {
                    let ending = run.go_to_end();
                    ended[index] = Some(Ok(run.end(ending)));
                    continue;
                }
                let mut lane_begun = Lane {
                    index,
                    run,
                    between: BetweenSteps::new(),
                    next: None,
                };
                match lane_begun.begin_step() {
                    Some(ending) => ended[index] = Some(Ok(lane_begun.run.end(ending))),
                    None => *lane = Some(lane_begun),
                }
            }
            is_any_under_way |= lane.is_some();
        }
        let Some(tries) = tries.as_mut().filter(|_| is_any_under_way) else {
            break;
        };
        let mut together: LaneMask = 0;
        for (number, lane) in lanes.iter().enumerate() {
            if let Some(Lane { run, next, .. }) = lane
                && let Some(next) = next
                && run.stepper.may_try_in_lanes()
            {
                tries.put(number, &run.stepper, *next);
                together |= 1 << number;
            }
        }
        if together.count_ones() < FEWEST_RUNS {
            tries.skip()
        } else {
            tries.attempt(together, machines)
        }
        for (number, lane) in lanes.iter_mut().enumerate() {
            let ending = lane
                .as_mut()
                .and_then(|lane_begun| lane_begun.finish_try(number, tries));
            if let Some(ending) = ending
                && let Some(Lane { index, run, .. }) = lane.take()
            {
                ended[index] = Some(Ok(run.end(ending)));
            }
        }
    }
    // Each run was begun, and a lane is empty only if its run has ended.
    ended.into_iter().flatten().collect()
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

    /// Continues after a try of its step.
    fn finish_try(&mut self, lane: usize, tries: &Tries) -> Option<End> {
        let stepped = match self.next.take() {
            None => Ok(()),
            Some(of) => match self.run.stepper.end_in_lanes(lane, of, tries) {
                Ok(Some(next)) => {
                    self.next = Some(next);
                    return None;
                }
                Ok(None) => Ok(()),
                Err(error) => Err(error),
            },
        };
        self.observe_step(stepped).or_else(|| self.begin_step())
    }

    fn observe_step(&mut self, stepped: Result<(), StepError>) -> Option<End> {
        let looked = self.run.examine_step(&mut self.between, stepped);
        looked.transpose()
    }
}
