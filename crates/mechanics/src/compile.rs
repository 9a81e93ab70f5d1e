//! Runs all stages from a model to proved programs, and collects the formulas that printed pages
//! and comments show.

use std::collections::BTreeMap;

use crate::Equations;
use crate::Proved;
use crate::equations::refusal::refuse_large;
use crate::formulas;
use crate::lower::lower_by;
use crate::series::ProvedSeries;
use lagrangian_program::choose::best;
use lagrangian_program::{Basis, Role};
use lagrangian_spec::diagnostic::{Code, Diagnostic, Report};
use lagrangian_spec::model::Model;

/// A machine with the results of every stage.
#[derive(Clone)]
pub struct Compiled<'d> {
    /// The model.
    pub model: Model<'d>,
    /// Its equations of motion, in the form from which the accelerations are computed.
    pub equations: Equations<'d>,
    /// Its program, proved against Lagrange's equations of this machine.
    pub program: Proved,
    /// The Taylor series of its motion, proved; if the spec asks for it.
    pub series: Option<ProvedSeries>,
}

impl<'d> Compiled<'d> {
    /// Derives the equations of a model, lowers them, and proves the program; `None` if that fails,
    /// with the reasons in the report.
    pub fn new(model: Model<'d>, report: &mut Report) -> Option<Compiled<'d>> {
        let equations = Equations::derive(&model, report)?;
        if report.has_errors() {
            return None;
        }
        let expanded = equations.expanded();
        let program = lower_by(&model, &equations, expanded.as_ref(), &best);
        if program.function(program.solving()).is_none() {
            // Solving for the accelerations takes more operations than are allowed.
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
        let series = match model.taylor.map(|span| (span, emitted_series(&model))) {
            None => None,
            Some((_, Ok(series))) => Some(series),
            Some((span, Err(reason))) => {
                let message = format!("`{}` has no Taylor series here: {reason}", model.name);
                let help = "without `taylor` it can be derived, and other methods integrate it";
                let diagnostic = Diagnostic::new(Code::NotSupported, span, message);
                report.push(diagnostic.help(help));
                return None;
            }
        };
        Some(Compiled {
            model,
            equations,
            program,
            series,
        })
    }

    /// For each function the formulas that its documentation shows.
    pub fn formulas(&self) -> BTreeMap<Role, Vec<String>> {
        formulas::formulas(&self.program, &self.model, &self.equations)
    }
}

/// The series of a machine, as emitted code contains it.
fn emitted_series(model: &Model<'_>) -> Result<ProvedSeries, String> {
    if !model.contacts.is_empty() {
        return Err("it has contacts that close and open".into());
    }
    let series = ProvedSeries::derive(model).map_err(|reason| reason.to_string())?;
    if series.is_short() {
        Ok(series)
    } else {
        Err("it is too long for emitted code".into())
    }
}
