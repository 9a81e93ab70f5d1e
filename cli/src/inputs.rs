//! `--input`: the laws of inputs.

use std::path::Path;

use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::model::Model;
use lagrangian_spec::source::Sources;
use lagrangian_sweep::plan::Law;
use lagrangian_sweep::signals::{self, InputArgument};

use crate::call::{self, Assignment};
use crate::failure::Failure;

/// Parses each `--input`, in order.
///
/// # Errors
/// If the call is invalid.
pub fn parse(given: &[Assignment]) -> Result<Vec<(String, InputArgument)>, Failure> {
    let one = |input: &Assignment| {
        let written = signals::parse_input(&input.value);
        let written = written.map_err(|why| {
            Failure::Call(format!("--input {}={}: {why}", input.name, input.value))
        })?;
        Ok((input.name.clone(), written))
    };
    given.iter().map(one).collect()
}

/// The files from which inputs are read; they must not be overwritten.
pub fn files(written: &[(String, InputArgument)]) -> impl Iterator<Item = (&Path, &'static str)> {
    let files = written.iter().filter_map(|(_, written)| written.file());
    files.map(|path| (path, "the table of an input"))
}

/// The laws of a machine's inputs.
///
/// # Errors
/// If there is no such input, or a table is invalid.
pub fn laws(
    written: &[(String, InputArgument)],
    model: &Model<'_>,
) -> Result<Vec<(String, Law)>, Failure> {
    let laws = signals::laws(written, model).map_err(Failure::Call)?;
    let names = laws.iter().map(|(name, _)| name.as_str());
    call::refuse_twice("--input", names).map_err(Failure::Call)?;
    Ok(laws)
}

/// Converts a failure of the spec to one of the call, if all errors are in formulas of the call.
pub fn as_call_failure(failure: Failure) -> Failure {
    match failure {
        Failure::Spec(wrong) => {
            let (report, sources) = *wrong;
            formula(&report, &sources).unwrap_or_else(|| Failure::Spec(Box::new((report, sources))))
        }
        other => other,
    }
}

/// The errors in formulas of the call, if there are no others.
pub fn formula(report: &Report, sources: &Sources) -> Option<Failure> {
    let messages = report.diagnostics().into_iter().map(|wrong| {
        let source = wrong.span.source;
        let option = sources.name(source);
        let help = wrong.help.iter().map(|help| format!("; {help}"));
        let help: String = help.collect();
        option.starts_with("--").then(|| {
            let text = sources.text(source);
            format!("{option}: {} in `{text}`{help}", wrong.message)
        })
    });
    let messages: Option<Vec<String>> = messages.collect();
    Some(Failure::Call(messages?.join("\n       ")))
}
