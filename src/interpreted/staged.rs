//! The accelerations of an interpreted machine, in stages that are evaluated again only where their arguments change.

use std::vec;
use std::vec::Vec;

use lagrangian_program::Role;

use super::named::Named;
use super::running::at;
use super::system::{InterpretedSystem, singular_row};
use crate::{Singular, Staged, accelerations_with_friction};

impl Staged for InterpretedSystem {
    type AtTime = Stage;
    type AtPosition = Stage;

    fn at_time(&self, t: f64) -> Stage {
        let mut stage = Stage {
            values: vec![t],
            q: Vec::new(),
        };
        if self.program.stages.time {
            stage.values = self.values_of(Role::AtTime);
            // Values that depend on time alone cannot be singular.
            let _ = self.call(Role::AtTime, at(t, &[], &[], &[]), &mut stage.values);
        }
        stage
    }

    fn at_position(&self, before: &Stage, q: &Vec<f64>) -> Result<Stage, Singular> {
        if !self.program.stages.coordinates {
            let (values, q) = (before.values.clone(), q.clone());
            return Ok(Stage { values, q });
        }
        let mut values = self.values_of(Role::AtPosition);
        let stage = (Role::AtTime, before.values.as_slice());
        self.call_after(stage, (Role::AtPosition, [q, &[], &[]]), &mut values)?;
        let q = Vec::new();
        Ok(Stage { values, q })
    }

    fn accelerations_at(
        &self,
        Stage { values, q }: &Stage,
        v: &Vec<f64>,
        u: &Named,
        a: &mut Vec<f64>,
    ) -> Result<(), Singular> {
        if !self.program.contacts.is_empty() {
            return accelerations_with_friction(self, values[0], q, v, u, a);
        }
        let role = if self.program.stages.is_empty() {
            Role::Accelerations
        } else {
            Role::AccelerationsAt
        };
        let before = if self.program.stages.coordinates {
            Role::AtPosition
        } else {
            Role::AtTime
        };
        self.call_after((before, values), (role, [q, v, &u.values]), a)
    }
}

/// The results of one stage of the accelerations of an [`InterpretedSystem`] that the next one needs.
#[derive(Clone, Debug)]
pub struct Stage {
    /// The results of the stage, or the time if there is no such stage.
    values: Vec<f64>,
    /// The coordinates if they are not a stage.
    q: Vec<f64>,
}

impl InterpretedSystem {
    /// Zeros, one for each value that a stage computes for later ones.
    fn values_of(&self, role: Role) -> Vec<f64> {
        let function = self.program.function(role);
        vec![0.0; function.map_or(0, |function| function.results.len())]
    }

    /// Calls a function with the results of a stage, or with the time if that is not a stage. Both happen under one lock,
    /// because otherwise another thread could set its own results in between.
    fn call_after(
        &self,
        (stage, left): (Role, &[f64]),
        (role, [q, v, u]): (Role, [&[f64]; 3]),
        results: &mut [f64],
    ) -> Result<(), Singular> {
        let mut running = self.running.lock();
        let t = if stage == Role::AtTime && !self.program.stages.time {
            left[0]
        } else {
            running.interpreter.set_stage_results(stage, left);
            running.compiled.set_stage_results(stage, left);
            f64::NAN // the time is not used
        };
        let called = running.call(role, at(t, q, v, u), results);
        called.map_err(|singular| singular_row(&self.program, singular))
    }
}
