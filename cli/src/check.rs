//! `lagrangian check`: all errors of a spec, and its published equations compared with the derived ones.

mod accuracy;

use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::{Freedom, Independent, contradictions, freedom as freedom_of};
use lagrangian_print::compare::{self, Comparison, Quoted};
use lagrangian_spec::source::Sources;
use lagrangian_symbolic::Dag;
use serde::Serialize;
use serde_json::json;

use crate::call;
use crate::diagnostics::{self, Entry, counted};
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
    /// The side of the equals sign for each of `add`, with the sign that the term has there; empty where there
    /// are no two sides.
    add_side: Vec<&'static str>,
    /// The side of the equals sign for each of `drop`.
    drop_side: Vec<&'static str>,
    /// Terms to drop that become terms to add by correcting a misprint.
    change: Vec<Change>,
    /// Warnings about printed sums of different units.
    remarks: Vec<Entry>,
}

/// A printed term with a misprint.
#[derive(Debug, Serialize)]
struct Change {
    /// The printed term, which is among those to drop; or a superfluous dot over a constant.
    from: String,
    /// The corrected term, which is among those to add.
    to: String,
    /// Its side of the equals sign; `None` where there are no two sides.
    side: Option<&'static str>,
}

/// Runs the command.
///
/// # Errors
/// If the spec is invalid. Wrong published equations and warnings are results, unless the call treats them as errors.
pub fn run(call: &call::Check) -> Result<(), Failure> {
    let dag = Dag::new();
    let mut reading = Reading::open(&call.spec)?;
    let model = reading.model(&dag);
    let compiled = model.and_then(|model| Compiled::new(model, &mut reading.report));
    if let Some(compiled) = &compiled {
        contradictions(&compiled.model, &compiled.equations, &mut reading.report);
    }
    let freedom = compiled.as_ref();
    let freedom = freedom.map(|compiled| {
        let mut freedom = freedom_of(&compiled.model, &compiled.equations);
        // A state of first order is not a degree of freedom.
        let states = compiled.model.coordinates.iter();
        freedom.coordinates -= states.filter(|c| c.rate.is_some()).count();
        freedom
    });
    let comparisons = match &compiled {
        Some(compiled) => compare::compare(&compiled.model, &compiled.equations),
        None => Vec::new(),
    };
    let published: Vec<Published> = comparisons
        .into_iter()
        .map(|comparison| Published::new(comparison, &reading.sources))
        .collect();
    let accuracy = compiled.as_ref().filter(|_| call.accuracy);
    let accuracy = accuracy.map(|compiled| (compiled, accuracy::evaluate(compiled)));
    if call.spec.json {
        let entries = diagnostics::entries(&reading.report, &reading.sources);
        let mut all = json!({
            "diagnostics": entries,
            "freedom": freedom.map(Degrees::new),
            "published": published,
        });
        if let Some((compiled, found)) = &accuracy {
            all["accuracy"] = found.json(&compiled.program);
        }
        output::line(format_args!("{all:#}"));
    } else {
        diagnostics::print(&reading.report, &reading.sources);
        if let (Some(compiled), Some(freedom)) = (&compiled, freedom) {
            summarize(compiled, freedom, reading.report.warnings().len());
        }
        for block in published.chunk_by(|a, b| a.block == b.block) {
            block.iter().for_each(print);
            conclude(block);
        }
        if let Some((compiled, found)) = &accuracy {
            found.print(&compiled.program);
        }
    }
    let differs = published.iter().any(|formula| !formula.agrees);
    let is_denied =
        (call.strict && differs) || (call.deny_warnings && !reading.report.warnings().is_empty());
    if reading.report.has_errors() || is_denied {
        Err(Failure::AlreadyReported)
    } else {
        Ok(())
    }
}

fn summarize(compiled: &Compiled, freedom: Freedom, warnings: usize) {
    let model = &compiled.model;
    let states = model.coordinates.len() - freedom.coordinates;
    let states = match states {
        0 => String::new(),
        states => counted(states, "state", "states") + ", ",
    };
    output::line(format_args!(
        "{}: {}, {states}{}{}, {}; {}",
        model.name,
        counted(freedom.coordinates, "coordinate", "coordinates"),
        constrained(freedom),
        counted(model.bodies.len(), "body", "bodies"),
        counted(model.parameters.len(), "parameter", "parameters"),
        match warnings {
            0 => "nothing is wrong".to_owned(),
            warnings => counted(warnings, "warning", "warnings"),
        },
    ));
}

/// Constraints and degrees of freedom, where there are constraints.
fn constrained(freedom: Freedom) -> String {
    if freedom.constraints == 0 {
        // The four numbers of a quaternion are three degrees of freedom.
        return match freedom.degrees().filter(|_| freedom.lengths > 0) {
            Some(degrees) => counted(degrees, "degree", "degrees") + " of freedom, ",
            None => String::new(),
        };
    }
    let mut text = counted(freedom.constraints, "constraint", "constraints");
    if let (Some(Independent { generic, at_start }), Some(degrees)) =
        (freedom.independent, freedom.degrees())
    {
        if generic < freedom.constraints {
            text.push_str(&format!(" ({generic} independent)"));
        }
        if at_start < generic {
            text.push_str(&format!(" ({at_start} independent at the start)"));
        }
        let degrees = counted(degrees, "degree", "degrees");
        text.push_str(&format!(", {degrees} of freedom"));
    }
    text + ", "
}

/// The degrees of freedom of a machine, in `check --json`; null where unknown.
#[derive(Debug, Serialize)]
struct Degrees {
    coordinates: usize,
    constraints: usize,
    independent: Option<usize>,
    independent_at_start: Option<usize>,
    degrees_of_freedom: Option<usize>,
}

impl Degrees {
    fn new(freedom: Freedom) -> Degrees {
        let (independent, at_start) = match (freedom.constraints, freedom.independent) {
            (0, _) => (Some(0), Some(0)),
            (_, known) => (
                known.map(|known| known.generic),
                known.map(|known| known.at_start),
            ),
        };
        Degrees {
            coordinates: freedom.coordinates,
            constraints: freedom.constraints,
            independent,
            independent_at_start: at_start,
            degrees_of_freedom: freedom.degrees(),
        }
    }
}

impl Published {
    fn new(comparison: Comparison<'_>, sources: &Sources) -> Published {
        let terms = comparison.terms();
        let has_sides = comparison.has_two_sides();
        let side = |term: &Quoted| if term.on_the_right { "right" } else { "left" };
        let sides = |terms: &[Quoted]| {
            if has_sides {
                terms.iter().map(side).collect()
            } else {
                Vec::new()
            }
        };
        let [add_side, drop_side] = [sides(&terms[0]), sides(&terms[1])];
        let [add, drop] = terms.map(|terms| {
            let texts = terms.into_iter().map(|term| term.text);
            texts.collect::<Vec<String>>()
        });
        let change = |(from, to): (usize, usize)| Change {
            from: drop[from].clone(),
            to: add[to].clone(),
            side: drop_side.get(from).copied(),
        };
        let undotted = comparison.superfluous_dots.iter().map(|undotted| Change {
            from: undotted.from.clone(),
            to: undotted.to.clone(),
            side: None,
        });
        let remarks = comparison.remarks.iter();
        Published {
            change: undotted
                .chain(comparison.changes().into_iter().map(change))
                .collect(),
            remarks: remarks
                .map(|remark| diagnostics::entry(remark, sources))
                .collect(),
            add,
            drop,
            add_side,
            drop_side,
            block: comparison.block,
            item: comparison.item,
            agrees: comparison.agrees,
        }
    }

    /// Terms of a list that are not part of a change, with the side on which they are.
    fn left<'a>(
        &'a self,
        list: &'a [String],
        sides: &'a [&'static str],
        of: fn(&Change) -> &String,
    ) -> impl Iterator<Item = (&'a String, String)> {
        let is_changed = move |term: &String| self.change.iter().any(|c| of(c) == term);
        let list = list.iter().enumerate();
        list.filter(move |(_, term)| !is_changed(term))
            .map(|(k, term)| (term, on(sides.get(k).copied())))
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
    for Change { from, to, side } in &published.change {
        let on = on(*side);
        output::line(format_args!("    change {from} to {to}{on}"));
    }
    for (term, on) in published.left(&published.drop, &published.drop_side, |c| &c.from) {
        output::line(format_args!("    drop {term}{on}"));
    }
    for (term, on) in published.left(&published.add, &published.add_side, |c| &c.to) {
        output::line(format_args!("    add {term}{on}"));
    }
    for remark in &published.remarks {
        output::line(format_args!("    units: {remark}"));
    }
}

/// The side of a term, in words.
fn on(side: Option<&str>) -> String {
    side.map_or_else(String::new, |side| format!(" on the {side}"))
}

/// Prints how many formulas of a block are wrong.
fn conclude(block: &[Published]) {
    let Some(Published { block: title, .. }) = block.first() else {
        return;
    };
    let wrong = block.iter().filter(|formula| !formula.agrees).count();
    let all = counted(block.len(), "formula", "formulas");
    match wrong {
        0 => output::line(format_args!("{title}: {all}, nothing to correct")),
        1 => output::line(format_args!("{title}: 1 of {all} differs")),
        _ => output::line(format_args!("{title}: {wrong} of {all} differ")),
    }
}
