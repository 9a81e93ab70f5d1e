//! `lagrangian derive`: the derived equations, or the code.

use lagrangian_spec::compile::Compiled;
use lagrangian_spec::emit;
use lagrangian_spec::emit::document::Document;
use lagrangian_spec::program::{Candidate, Counts, Program};
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
            json!({
                "form": form,
                "text": text,
                "counts": counts(&compiled.program),
                "choices": choices(&compiled.program),
            })
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
    let entries =
        functions.map(|function| (program.title(function.role), by_kind(&function.counts())));
    Value::Object(entries.collect::<Map<_, _>>())
}

fn by_kind(counts: &Counts) -> Value {
    json!({
        "multiplications": counts.multiplications,
        "additions": counts.additions,
        "divisions": counts.divisions,
        "sincos": counts.sincos,
        "other": counts.other,
        "guards": counts.guards,
    })
}

/// For each function that could be made in several ways, the ways; the one that was taken first.
fn choices(program: &Program) -> Value {
    let candidate = |candidate: &Candidate| {
        json!({
            "made": candidate.form.to_string(),
            "counts": by_kind(&candidate.counts),
            // From tenths of a cycle.
            "cycles_alone": candidate.cost.alone() as f64 / 10.0,
            "cycles_among_others": candidate.cost.throughput as f64 / 10.0,
            // In units of 2⁻⁵³; null where nothing is known.
            "rounding": candidate.rounding.map(|rounding| rounding.units()),
        })
    };
    let entries = program.choices.iter().map(|choice| {
        let candidates = [choice.chosen()].into_iter().chain(choice.others());
        let candidates: Vec<Value> = candidates.map(candidate).collect();
        (program.title(choice.role()), Value::Array(candidates))
    });
    Value::Object(entries.collect::<Map<_, _>>())
}
