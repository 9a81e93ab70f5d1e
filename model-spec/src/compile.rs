//! The whole chain behind the model, and what a printed page or a comment shows of it.

use std::collections::BTreeMap;

use crate::diagnostic::Report;
use crate::emit::formulas;
use crate::mechanics::Equations;
use crate::model::Model;
use crate::program::{Counts, Program, Role};

/// A machine, through every stage.
#[derive(Clone)]
pub struct Compiled<'d> {
    /// What it is.
    pub model: Model<'d>,
    /// Its equations of motion.
    pub equations: Equations<'d>,
    /// How they are computed.
    pub program: Program,
}

impl<'d> Compiled<'d> {
    /// Derives the equations of a model and lowers them; `None` where the report says why not.
    pub fn new(model: Model<'d>, report: &mut Report) -> Option<Compiled<'d>> {
        let equations = Equations::derive(&model, report)?;
        if report.has_errors() {
            return None;
        }
        let (equations, program) = cheapest(&model, equations);
        Some(Compiled {
            model,
            equations,
            program,
        })
    }

    /// For each function the formulas that its documentation shows.
    pub fn formulas(&self) -> BTreeMap<Role, Vec<String>> {
        formulas::formulas(&self.model, &self.equations)
    }
}

/// The equations as they were derived, or multiplied out, whichever makes the cheaper program.
fn cheapest<'d>(model: &Model<'d>, equations: Equations<'d>) -> (Equations<'d>, Program) {
    let program = Program::lower(model, &equations);
    let other = equations.expanded().map(|expanded| {
        let program = Program::lower(model, &expanded);
        (expanded, program)
    });
    match other {
        Some((expanded, other)) if cycles(&other) < cycles(&program) => (expanded, other),
        _ => (equations, program),
    }
}

/// About how many cycles the accelerations take where independent operations run side by side: 2.5
/// multiplications or additions in one cycle, 4.5 cycles for a division, 3 for an angle among
/// others.
fn cycles(program: &Program) -> f64 {
    let accelerations = program
        .functions
        .iter()
        .filter(|f| f.role == Role::Accelerations);
    let cost = |function| {
        let counts = Counts::of(function);
        counts.ops() as f64 / 2.5 + counts.divisions as f64 * 4.5 + counts.sincos as f64 * 3.0
    };
    accelerations.map(cost).sum()
}
