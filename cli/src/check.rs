//! `lagrangian check`: everything that is wrong with a spec, and printed equations against the
//! derived ones.

use lagrangian_spec::compare::{self, Comparison};
use lagrangian_spec::compile::Compiled;
use lagrangian_spec::source::Sources;
use lagrangian_symbolic::Dag;
use serde::Serialize;
use serde_json::json;

use crate::call;
use crate::diagnostics::{self, Entry};
use crate::failure::Failure;
use crate::output;
use crate::reading::Reading;

/// One printed formula, in `check --json`.
#[derive(Debug, Serialize)]
struct Published {
    block: String,
    item: String,
    agrees: bool,
    /// Terms to add to the print, in the spec's syntax.
    add: Vec<String>,
    /// Terms to drop from the print.
    drop: Vec<String>,
    /// Those of the terms to drop that become one of the terms to add by a slip.
    change: Vec<Change>,
    /// Where the print adds what has different units.
    remarks: Vec<Entry>,
}

/// A term of the print with a slip in it.
#[derive(Debug, Serialize)]
struct Change {
    /// The term, which is among those to drop.
    from: String,
    /// The term as it should be, which is among those to add.
    to: String,
}

/// Runs the command.
///
/// # Errors
/// If the spec is wrong. A print that is wrong is a result, and no error.
pub fn run(call: &call::Check) -> Result<(), Failure> {
    let dag = Dag::new();
    let mut reading = Reading::open(&call.spec)?;
    let model = reading.model(&dag);
    let compiled = model.and_then(|model| Compiled::new(model, &mut reading.report));
    let comparisons = match &compiled {
        Some(compiled) => compare::compare(&compiled.model, &compiled.equations),
        None => Vec::new(),
    };
    let published: Vec<Published> = comparisons
        .into_iter()
        .map(|comparison| Published::new(comparison, &reading.sources))
        .collect();
    if call.spec.json {
        let entries = diagnostics::entries(&reading.report, &reading.sources);
        output::line(format_args!(
            "{:#}",
            json!({ "diagnostics": entries, "published": published })
        ));
    } else {
        diagnostics::print(&reading.report, &reading.sources);
        if let Some(compiled) = &compiled {
            summarize(compiled);
        }
        for block in published.chunk_by(|a, b| a.block == b.block) {
            block.iter().for_each(print);
            conclude(block);
        }
    }
    if reading.report.has_errors() {
        Err(Failure::Said)
    } else {
        Ok(())
    }
}

fn summarize(compiled: &Compiled) {
    let model = &compiled.model;
    output::line(format_args!(
        "{}: {}, {}, {}; nothing is wrong",
        model.name,
        counted(model.coordinates.len(), "coordinate", "coordinates"),
        counted(model.bodies.len(), "body", "bodies"),
        counted(model.parameters.len(), "parameter", "parameters"),
    ));
}

fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

impl Published {
    fn new(comparison: Comparison<'_>, sources: &Sources) -> Published {
        let (add, drop) = (comparison.add(), comparison.drop());
        let change = |(from, to): (usize, usize)| Change {
            from: drop[from].clone(),
            to: add[to].clone(),
        };
        let remarks = comparison.remarks.iter();
        Published {
            change: comparison.changes().into_iter().map(change).collect(),
            remarks: remarks
                .map(|remark| diagnostics::entry(remark, sources))
                .collect(),
            add,
            drop,
            block: comparison.block,
            item: comparison.item,
            agrees: comparison.agrees,
        }
    }

    /// Terms of a list that no change accounts for.
    fn left<'a>(
        &'a self,
        list: &'a [String],
        side: fn(&Change) -> &String,
    ) -> impl Iterator<Item = &'a String> {
        let is_changed = move |term: &String| self.change.iter().any(|c| side(c) == term);
        list.iter().filter(move |term| !is_changed(term))
    }
}

fn print(published: &Published) {
    let Published { block, item, .. } = published;
    let verdict = if published.agrees {
        "agrees"
    } else {
        "differs"
    };
    output::line(format_args!("{block}: {item}: {verdict}"));
    for Change { from, to } in &published.change {
        output::line(format_args!("    change {from} to {to}"));
    }
    for term in published.left(&published.drop, |change| &change.from) {
        output::line(format_args!("    drop {term}"));
    }
    for term in published.left(&published.add, |change| &change.to) {
        output::line(format_args!("    add {term}"));
    }
    for remark in &published.remarks {
        output::line(format_args!("    units: {remark}"));
    }
}

/// How many formulas of a block are wrong.
fn conclude(block: &[Published]) {
    let Some(Published { block: title, .. }) = block.first() else {
        return;
    };
    let wrong = block.iter().filter(|formula| !formula.agrees).count();
    let all = counted(block.len(), "formula", "formulas");
    match wrong {
        0 => output::line(format_args!("{title}: {all}, nothing to mend")),
        1 => output::line(format_args!("{title}: 1 of {all} differs")),
        _ => output::line(format_args!("{title}: {wrong} of {all} differ")),
    }
}
