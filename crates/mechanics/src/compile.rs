//! Runs all stages from a model to proved programs, and collects the formulas that printed pages
//! and comments show.

use std::collections::BTreeMap;

use crate::Equations;
use crate::Proved;
use crate::equations::reduction::violated_assumption;
use crate::equations::refusal::refuse_large;
use crate::formulas;
use crate::lower::lower_by;
use crate::proof::prove_charts;
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
                let stateless = violated_assumption(&model, &equations.constraints);
                report.push(stateless.unwrap_or_else(|| unproved.diagnostic(&model)));
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

    /// [`new`](Self::new) for a program that runs are made with: it has the projection onto the constraints too, by which a run projects the ends of its
    /// steps.
    pub fn for_runs(mut model: Model<'d>, report: &mut Report) -> Option<Compiled<'d>> {
        model.projects = true;
        Compiled::new(model, report)
    }

    /// Compiles a machine, and if its spec names another chart, the same machine in this one, proved to be the same: both are to be
    /// emitted. `None` if that fails, with the reasons in the report.
    pub fn in_charts(
        mut model: Model<'d>,
        report: &mut Report,
    ) -> Option<(Compiled<'d>, Option<Compiled<'d>>)> {
        // A formula of the caller may have no meaning in the other chart.
        let cartesian = model.cartesian.take();
        let cartesian = cartesian.filter(|machine| machine.uncharted.is_empty());
        let taylor = model.taylor;
        let compiled = Compiled::for_runs(model, report)?;
        let Some(mut cartesian) = cartesian else {
            return Some((compiled, None));
        };
        cartesian.taylor = taylor;
        // Its warnings would be those of the spec once more.
        let mut again = Report::new();
        let Some(cartesian) = Compiled::for_runs(*cartesian, &mut again) else {
            for diagnostic in again.messages() {
                report.push(diagnostic.clone());
            }
            return None;
        };
        compiled.check_chart(&cartesian, report)?;
        Some((compiled, Some(cartesian)))
    }

    /// Checks that a machine in its other chart is the same machine; `None` if it is not, with the reason in the report.
    pub fn check_chart(&self, cartesian: &Compiled<'_>, report: &mut Report) -> Option<()> {
        match prove_charts(&self.program, &cartesian.program, &self.chart_points()) {
            Ok(()) => Some(()),
            Err(uncharted) => {
                report.push(uncharted.diagnostic(&self.model));
                None
            }
        }
    }

    /// For each point that is given in two charts the indices of its coordinates.
    pub fn chart_points(&self) -> Vec<[usize; 2]> {
        let charts = self.model.charts.iter();
        charts.map(|charts| charts.polar).collect()
    }

    /// For each function the formulas that its documentation shows.
    pub fn formulas(&self) -> BTreeMap<Role, Vec<String>> {
        formulas::formulas(&self.program, &self.model, &self.equations)
    }
}

/// The series of a machine, as emitted code contains it.
fn emitted_series(model: &Model<'_>) -> Result<ProvedSeries, String> {
    let series = ProvedSeries::derive(model).map_err(|reason| reason.to_string())?;
    if series.is_short() {
        Ok(series)
    } else {
        Err("it is too long for emitted code".into())
    }
}
