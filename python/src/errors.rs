//! Exceptions of `lagrangian.errors`, with details as attributes.

use lagrangian::{Pivot, Singular, System};
use lagrangian_spec::diagnostic::{Diagnostic, Report};
use lagrangian_spec::source::Sources;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// An error of a spec: severity, code, message, help, file, line, column.
pub type Told = (String, String, String, Option<String>, String, usize, usize);

/// Makes an exception of `lagrangian.errors`.
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

/// The diagnostics of a report, whether errors or warnings.
pub fn as_values(report: &Report, sources: &Sources) -> Vec<Told> {
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

/// The errors of a report as text, with the source underlined.
pub fn as_text(report: &Report, sources: &Sources) -> String {
    let errors = report.diagnostics().into_iter();
    let mut all: Vec<String> = errors.map(|error| error.render(sources)).collect();
    if report.omitted() > 0 {
        all.push(format!("({} more errors are not shown)", report.omitted()));
    }
    all.join("\n\n")
}

/// `SpecError`.
pub fn of_spec(py: Python<'_>, text: String, told: Vec<Told>) -> PyErr {
    raise(py, "SpecError", (text, told))
}

/// `SingularError`, with an index into the batch.
pub fn of_singular<S: System>(
    py: Python<'_>,
    system: &S,
    singular: Singular,
    place: Option<usize>,
) -> PyErr {
    let name = singular.name(system).to_owned();
    let remains = |of: &str| {
        let ratio = singular.ratio;
        format!("{ratio:.1e} of its element on the diagonal of {of} remains after elimination")
    };
    let message = match singular.at {
        Pivot::Constraint(_) => format!(
            "the constraint `{name}` depends on others here: {}",
            remains("G M⁻¹ Gᵀ")
        ),
        Pivot::Coordinate(_) => format!(
            "the mass matrix is singular here, at the coordinate `{name}`: {}",
            remains("M")
        ),
        _ => format!("the accelerations are undefined here, at `{name}`"),
    };
    raise(py, "SingularError", (message, name, singular.ratio, place))
}
