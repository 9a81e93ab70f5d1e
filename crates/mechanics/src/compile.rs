//! The whole chain behind the model, and what a printed page or a comment shows of it.

use std::collections::BTreeMap;

use crate::Equations;
use crate::Proved;
use crate::equations::refusal::refuse_large;
use crate::formulas;
use crate::lower::lower_by;
use lagrangian_program::choose::best;
use lagrangian_program::{Basis, Role};
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;

/// A machine, through every stage.
#[derive(Clone)]
pub struct Compiled<'d> {
    /// What it is.
    pub model: Model<'d>,
    /// Its equations of motion, in the form that the accelerations are computed from.
    pub equations: Equations<'d>,
    /// How they are computed; held against Lagrange's equations of this machine.
    pub program: Proved,
}

impl<'d> Compiled<'d> {
    /// Derives the equations of a model, lowers them, and proves what comes out; `None` where the
    /// report says why not.
    pub fn new(model: Model<'d>, report: &mut Report) -> Option<Compiled<'d>> {
        let equations = Equations::derive(&model, report)?;
        if report.has_errors() {
            return None;
        }
        let expanded = equations.expanded();
        let program = lower_by(&model, &equations, expanded.as_ref(), &best);
        if program.function(program.solving()).is_none() {
            // Solving for the accelerations takes more than may be written down.
            refuse_large(&model, report);
            return None;
        }
        let program = match Proved::new(program, &model, &equations) {
            Ok(program) => program,
            Err(unproved) => {
                report.push(unproved.diagnostic(&model));
                return None;
            }
        };
        let choice = program.choice(program.solving());
        let is_expanded = choice.is_some_and(|c| {
            let form = c.chosen().form;
            form.basis == Basis::Expanded && !form.reduced
        });
        let equations = match expanded {
            Some(expanded) if is_expanded => expanded,
            _ => equations,
        };
        Some(Compiled {
            model,
            equations,
            program,
        })
    }

    /// For each function the formulas that its documentation shows.
    pub fn formulas(&self) -> BTreeMap<Role, Vec<String>> {
        formulas::formulas(&self.program, &self.model, &self.equations)
    }
}
