//! Runs of interpreted machines in lanes: the evaluation of their machines.

use std::sync::Arc;
use std::vec::Vec;

use lagrangian_jit::{Library, Several, SeveralArguments};
use lagrangian_native::Lanes;
use lagrangian_program::{Program, Role};

use super::{InterpretedMachine, InterpretedSystem, Named, RunTask};
use crate::run::in_lanes::{self, Machines};
use crate::run::run;
use crate::settings::Subject;
use crate::solution::RunResult;
use crate::stepper::in_lanes::{Evaluate, LaneMask, WIDTH, Wide};

/// The machines of all lanes, executed by machine code.
struct InLanes {
    library: Arc<Library>,
    program: Arc<Program>,
    /// Created with the first machine.
    several: Option<Several<WIDTH>>,
    inputs: Vec<Wide>,
    /// For work and losses: whether the program has a function for them that is not identically 0.
    has_powers: [bool; 2],
}

/// Makes all these runs, in lanes if the machine of the first has code for that.
pub(super) fn run_tasks(tasks: Vec<RunTask<'_, '_>>) -> Vec<RunResult<InterpretedMachine>> {
    let first = tasks.first().map(|(task, _)| &task.subject);
    let machine = match first {
        Some(Subject::Machine(machine)) if machine.may_run_in_lanes() => *machine,
        _ => return run_one_by_one(tasks),
    };
    let Some(library) = machine.machine_code.of_lanes(&machine.program, WIDTH) else {
        return run_one_by_one(tasks);
    };
    let mut machines = InLanes {
        library,
        program: machine.program.clone(),
        several: None,
        inputs: Vec::new(),
        has_powers: machine.program.has_powers(),
    };
    in_lanes::run_tasks(tasks, &mut machines)
}

fn run_one_by_one(tasks: Vec<RunTask<'_, '_>>) -> Vec<RunResult<InterpretedMachine>> {
    let tasks = tasks.into_iter();
    tasks.map(|(task, start)| run(task, start)).collect()
}

impl Machines<InterpretedMachine> for InLanes {
    fn put(&mut self, lane: usize, system: &InterpretedSystem, inputs: &Named) -> bool {
        if !Arc::ptr_eq(&system.program, &self.program) {
            return false;
        }
        let running = system.running.lock();
        match &mut self.several {
            Some(several) => several.put(lane, &running.interpreter),
            // Lanes without a run have the numbers of the first one, so that they hold a valid machine.
            none => {
                self.inputs = inputs.values.iter().map(|u| Lanes::splat(*u)).collect();
                *none = Several::each_from(self.library.clone(), &running.interpreter);
            }
        }
        for (row, u) in self.inputs.iter_mut().zip(&inputs.values) {
            row[lane] = *u;
        }
        self.several.is_some()
    }
}

impl InLanes {
    fn call(
        &mut self,
        role: Role,
        (t, q, v): (Wide, &[Wide], &[Wide]),
        a: &[Wide],
        results: &mut [Wide],
    ) -> LaneMask {
        let u = &self.inputs;
        let arguments = SeveralArguments { t, q, v, u, a };
        let several = self.several.as_mut();
        let mask = several.and_then(|several| several.call(role, arguments, results));
        // Without code every lane is run alone.
        mask.unwrap_or(0)
    }
}

impl Evaluate for InLanes {
    fn accelerations(&mut self, at: (Wide, &[Wide], &[Wide]), a: &mut [Wide]) -> LaneMask {
        self.call(Role::Accelerations, at, &[], a)
    }

    fn powers(&mut self, at: (Wide, &[Wide], &[Wide]), a: &[Wide]) -> ([Wide; 2], LaneMask) {
        let mut powers = [Lanes::splat(0.0); 2];
        let mut mask = !0;
        let roles = [(Role::WorkRate, a), (Role::DissipationRate, &[])];
        for (k, (role, a)) in roles.into_iter().enumerate() {
            if self.has_powers[k] {
                mask &= self.call(role, at, a, &mut powers[k..=k]);
            }
        }
        (powers, mask)
    }
}
