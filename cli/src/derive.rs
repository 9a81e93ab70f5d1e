//! `lagrangian derive`: the derived equations, or the code.

use clap::ValueEnum;
use lagrangian_emit as emit;
use lagrangian_languages as languages;
use lagrangian_mechanics::Compiled;
use lagrangian_print::document::Document;
use lagrangian_program::{Candidate, Counts, Program};
use lagrangian_symbolic::Dag;
use serde_json::{Map, Value, json};

use crate::call::{self, Form};
use crate::failure::Failure;
use crate::output::{
    self, Destination, Endings, PAGE, RUST, ending_is_one_of, keep_apart, keep_document_apart,
};
use crate::reading::Reading;

/// Runs the command.
///
/// # Errors
/// If the spec is invalid, or the file cannot be written.
pub fn run(call: &call::Derive) -> Result<(), Failure> {
    let out = destination(call)?;
    keep_document_apart(&out, call.spec.json)?;
    keep_apart(&out, &[(&call.spec.path, "the spec")])?;
    let dag = Dag::new();
    let reading = Reading::open(&call.spec)?;
    let (compiled, cartesian) = if call.form == Form::Rust {
        reading.compile_to_emit(&dag, &out)?
    } else {
        (reading.compile_beside(&dag, &out)?, None)
    };
    let text = text((&compiled, cartesian.as_ref()), call);
    if let Some(file) = &out {
        file.write_text(&text)?;
    }
    if call.spec.json {
        let form = name(call.form);
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

/// The name of a form for `--as`.
fn name(form: Form) -> String {
    let form = clap::ValueEnum::to_possible_value(&form);
    form.map_or_else(String::new, |form| form.get_name().to_owned())
}

/// The output file. `--as` determines the form, so any extension is accepted except those of another form.
fn destination(call: &call::Derive) -> Result<Option<Destination>, Failure> {
    let Some(path) = &call.out else {
        return Ok(None);
    };
    let others = Form::value_variants()
        .iter()
        .filter(|form| **form != call.form);
    let of = |form: &&Form| ending_is_one_of(path, endings(**form));
    if let Some(other) = others.into_iter().find(of) {
        let ending = path.extension().unwrap_or_default().to_string_lossy();
        return Err(Failure::Call(format!(
            "--out {}: the ending `.{ending}` belongs to `--as {}`, but the form is `--as {}`",
            path.display(),
            name(*other),
            name(call.form)
        )));
    }
    Destination::new("--out", path, &[]).map(Some)
}

/// The usual file extensions of a form.
fn endings(form: Form) -> Endings {
    match form {
        Form::Markdown => &["md", "markdown"],
        Form::Latex => &["tex", "latex"],
        Form::Html => PAGE,
        Form::Rust => RUST,
        Form::C => &["c", "h"],
        Form::Program => &[],
        Form::Script(dialect) => std::slice::from_ref(&dialect.extension),
    }
}

fn text((compiled, cartesian): (&Compiled, Option<&Compiled>), call: &call::Derive) -> String {
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
        Form::Script(dialect) => languages::script::file(program, dialect, &origin, &formulas()),
        Form::Rust => emit::rust::module(
            program,
            &emit::rust::Options {
                origin: origin.clone(),
                ..emit::rust::Options::of(compiled, cartesian)
            },
        ),
        Form::C => languages::c::file(program, &origin, &formulas()),
        Form::Markdown => lagrangian_print::markdown::text(&Document::new(compiled)),
        Form::Latex => lagrangian_print::latex::text(&Document::new(compiled)),
        Form::Html => lagrangian_print::html::text(&Document::new(compiled)),
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

/// For each function with several candidates, all candidates, the chosen one first.
fn choices(program: &Program) -> Value {
    let candidate = |candidate: &Candidate| {
        json!({
            "made": candidate.form.to_string(),
            "counts": by_kind(&candidate.counts),
            // Costs are in tenths of a cycle.
            "cycles_alone": candidate.cost.single_call() as f64 / 10.0,
            "cycles_among_others": candidate.cost.throughput as f64 / 10.0,
            // In units of 2⁻⁵³; null where unknown.
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
