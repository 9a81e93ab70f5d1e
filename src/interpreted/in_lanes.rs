//! Runs of interpreted machines in lanes: the evaluation of their machines.

use std::sync::Arc;
use std::vec::Vec;

use lagrangian_jit::{Library, SeriesCode, SeriesSeveral, Several, SeveralArguments};
use lagrangian_native::Lanes;
use lagrangian_program::{Program, Role};

use super::engine::MachineCode;
use super::{InterpretedMachine, InterpretedSystem, Named, RunTask};
use crate::run::in_lanes::{self, Machines};
use crate::run::run;
use crate::settings::Subject;
use crate::solution::RunResult;
use crate::stepper::in_lanes::{Evaluate, LaneMask, WIDTH, Wide};

/// The machines of all lanes, executed by machine code.
struct InLanes {
    /// The engine of the machines, from which the code comes.
    engine: MachineCode,
    /// `None` as long as it does not pay.
    library: Option<Arc<Library>>,
    /// The code of the series, `None` as long as it does not pay. The series may be derived while these runs are made.
    code_of_series: Option<Arc<SeriesCode>>,
    program: Arc<Program>,
    /// Created with the first machine.
    several: Option<Several<WIDTH>>,
    /// Created with the first machine whose run is by series.
    series: Option<SeriesSeveral<WIDTH>>,
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
    let mut machines = InLanes {
        engine: machine.machine_code.clone(),
        library: None,
        code_of_series: None,
        program: machine.program.clone(),
        several: None,
        series: None,
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
        // Lanes without a run have the numbers of the first one, so that they hold a valid machine.
        if self.several.is_none() && self.series.is_none() {
            self.inputs = inputs.values.iter().map(|u| Lanes::splat(*u)).collect();
        }
        if self.library.is_none() {
            self.library = self.engine.of_lanes(&self.program, WIDTH);
        }
        if self.code_of_series.is_none() {
            let known = system.series.if_known();
            let code = known.and_then(|known| known.code.of_lanes(&self.engine, WIDTH));
            self.code_of_series = code;
        }
        if let Some(library) = &self.library {
            let running = system.running.lock();
            match &mut self.several {
                Some(several) => several.put(lane, &running.interpreter),
                none => *none = Several::each_from(library.clone(), &running.interpreter),
            }
        }
        let expanding = system.expanding.lock();
        if let (Some(code), Some(expander)) = (&self.code_of_series, expanding.expander()) {
            match &mut self.series {
                Some(series) => series.put(lane, expander),
                none => *none = SeriesSeveral::new(code.clone(), expander),
            }
        }
        for (row, u) in self.inputs.iter_mut().zip(&inputs.values) {
            row[lane] = *u;
        }
        self.several.is_some() || self.series.is_some()
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

    fn series(
        &mut self,
        (t, q, v): ([Wide; 2], &[Wide], &[Wide]),
        coefficients: &mut [Vec<Wide>],
    ) -> LaneMask {
        let state = [q, v, self.inputs.as_slice()];
        let series = self.series.as_mut();
        series.map_or(0, |series| series.expand(t, state, coefficients))
    }
}
