//! `lagrangian derive`: the derived equations, or the code.

use lagrangian_spec::compile::Compiled;
use lagrangian_spec::emit;
use lagrangian_spec::emit::document::Document;
use lagrangian_spec::program::Program;
use lagrangian_symbolic::Dag;
use serde_json::{Map, Value, json};

use crate::call::{self, Form};
use crate::failure::Failure;
use crate::output;
use crate::reading::Reading;

/// Runs the command.
///
/// # Errors
/// If the spec is wrong or the file cannot be written.
pub fn run(call: &call::Derive) -> Result<(), Failure> {
    let dag = Dag::new();
    let compiled = Reading::open(&call.spec)?.compile(&dag)?;
    let text = text(&compiled, call);
    if let Some(path) = &call.out {
        let written = std::fs::write(path, &text);
        written
            .map_err(|error| Failure::Call(format!("cannot write {}: {error}", path.display())))?;
    }
    if call.spec.json {
        let form = clap::ValueEnum::to_possible_value(&call.form);
        let form = form.map_or_else(String::new, |form| form.get_name().to_owned());
        output::line(format_args!(
            "{:#}",
            json!({ "form": form, "text": text, "counts": counts(&compiled.program) })
        ));
    } else if call.out.is_none() {
        output::text(&text);
    }
    Ok(())
}

fn text(compiled: &Compiled, call: &call::Derive) -> String {
    let Compiled { program, .. } = compiled;
    let file = call
        .spec
        .path
        .file_name()
        .map_or_else(String::new, |name| name.to_string_lossy().into_owned());
    let origin = vec![format!("@generated from {file} by `lagrangian derive`.")];
    let formulas = || compiled.formulas();
    match call.form {
        Form::Program => program.to_string(),
        Form::Rust => emit::rust::module(
            program,
            &emit::rust::Options {
                origin,
                formulas: formulas(),
                ..Default::default()
            },
        ),
        Form::C => emit::c::file(program, &origin, &formulas()),
        Form::Markdown => emit::markdown::text(&Document::new(compiled)),
        Form::Latex => emit::latex::text(&Document::new(compiled)),
        Form::Html => emit::html::text(&Document::new(compiled)),
    }
}

/// The operations of each function, by kind.
fn counts(program: &Program) -> Value {
    let functions = program
        .all_functions()
        .filter(|function| !function.results.is_empty());
    let entries = functions.map(|function| {
        let counts = function.counts();
        let entry = json!({
            "multiplications": counts.multiplications,
            "additions": counts.additions,
            "divisions": counts.divisions,
            "sincos": counts.sincos,
            "other": counts.other,
            "guards": counts.guards,
        });
        (program.title(function.role), entry)
    });
    Value::Object(entries.collect::<Map<_, _>>())
}
