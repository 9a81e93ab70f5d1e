//! Exceptions: those of `lagrangian.errors`, with what they tell as attributes.

use lagrangian::{Pivot, Singular, System};
use lagrangian_spec::diagnostic::{Diagnostic, Report};
use lagrangian_spec::source::Sources;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// A mistake of a spec: severity, code, message, help, file, line, column.
pub type Told = (String, String, String, Option<String>, String, usize, usize);

/// An exception of `lagrangian.errors`.
pub fn raise<'py>(
    py: Python<'py>,
    class: &str,
    arguments: impl IntoPyObject<
        'py,
        Target = PyTuple,
        Output = Bound<'py, PyTuple>,
        Error: Into<PyErr>,
    >,
) -> PyErr {
    let made = py.import("lagrangian.errors").and_then(|module| {
        let arguments = arguments.into_pyobject(py).map_err(Into::into)?;
        module.getattr(class)?.call1(arguments)
    });
    match made {
        Ok(exception) => PyErr::from_value(exception),
        Err(error) => error,
    }
}

/// What a report says, with errors or with warnings alone.
pub fn told(report: &Report, sources: &Sources) -> Vec<Told> {
    let one = |diagnostic: &Diagnostic| {
        let (line, column) = sources.line_column(diagnostic.span);
        (
            diagnostic.code.severity().as_str().to_owned(),
            diagnostic.code.as_str().to_owned(),
            diagnostic.message.clone(),
            diagnostic.help.clone(),
            sources.name(diagnostic.span.source).to_owned(),
            line,
            column,
        )
    };
    report.messages().into_iter().map(one).collect()
}

/// The report as text, with the words underlined.
pub fn shown(report: &Report, sources: &Sources) -> String {
    let mut text = String::new();
    for diagnostic in report.diagnostics() {
        let (line, column) = sources.line_column(diagnostic.span);
        let file = sources.name(diagnostic.span.source);
        let said = sources.line(diagnostic.span.source, line);
        let words = sources.words(diagnostic.span);
        // What goes on over several lines is underlined on its first.
        let width = words
            .lines()
            .next()
            .map_or(1, |first| first.chars().count());
        let number = line.to_string();
        let margin = " ".repeat(number.len());
        text.push_str(&format!(
            "{}[{}]: {}\n{margin}--> {file}:{line}:{column}\n{margin} |\n{number} | {said}\n{margin} | {}{}\n",
            diagnostic.code.severity().as_str(),
            diagnostic.code.as_str(),
            diagnostic.message,
            " ".repeat(column.saturating_sub(1)),
            "^".repeat(width.max(1)),
        ));
        if let Some(help) = &diagnostic.help {
            text.push_str(&format!("{margin} = help: {help}\n"));
        }
    }
    if report.omitted() > 0 {
        text.push_str(&format!("and {} more\n", report.omitted()));
    }
    text.trim_end().to_owned()
}

/// `SpecError`.
pub fn of_spec(py: Python<'_>, text: String, told: Vec<Told>) -> PyErr {
    raise(py, "SpecError", (text, told))
}

/// `SingularError`, at a place of a batch.
pub fn of_singular<S: System>(
    py: Python<'_>,
    system: &S,
    singular: Singular,
    place: Option<usize>,
) -> PyErr {
    let name = singular.name(system).to_owned();
    let what = match singular.at {
        Pivot::Constraint(_) => "a constraint depends on others",
        Pivot::Coordinate(_) => "the mass matrix is singular",
        _ => "the accelerations have no value",
    };
    let message = format!(
        "{what} here, at `{name}`: {:e} of its size is left",
        singular.ratio
    );
    raise(py, "SingularError", (message, name, singular.ratio, place))
}
