//! The HTML of the page: its text, its tables, and the files that it includes.

use lagrangian::{Machine, System};
use lagrangian_mechanics::Compiled;
use lagrangian_print::document::{Block, Document};
use lagrangian_print::html as derivation;
use lagrangian_program::{Program, Role};
use lagrangian_spec::model::{Constant, DerivedParameter};

use super::Report;
use super::html::{self, Cell, text as safe};
use super::live::{self, Live};
use super::samples::Samples;
use super::scene::Scene;
use crate::contacts::{ContactSummary, other_events};
use crate::numbers::shortest;

const PAGE: &str = include_str!("page.html");
/// The style sheet of all pages.
pub const STYLE: &str = include_str!("page.css");

/// The control that appears if there are contact forces.
const FORCES: &str =
    "<label><input type=\"checkbox\" id=\"forces\" checked> Contact forces</label>\n";

/// The most bytes for the derivation: the full equations of a large machine take megabytes.
const DERIVATION: usize = 700_000;

/// The parts of the script that draws and plots, which are concatenated to one module; the player follows them.
pub const DRAWING: [&str; 4] = [
    include_str!("motion.js"),
    include_str!("view.js"),
    include_str!("drawing.js"),
    include_str!("plots.js"),
];

const PLAYER: &str = include_str!("page.js");

/// The page of a report.
pub fn text(
    report: &Report<'_, '_>,
    scene: &Scene<'_>,
    samples: &Samples,
    data: &serde_json::Value,
    kinematics: &str,
    live: Option<&Live>,
) -> String {
    let model = &report.compiled.model;
    let name = safe(&model.name);
    html::fill(PAGE, |part| match part {
        "name" => name.clone(),
        "docs" => introduction(&model.docs),
        "alert" => alert(report, samples),
        "omitted" => omitted(&scene.picture.omitted),
        "live" => live.map_or_else(String::new, |_| live::SECTION.to_owned()),
        "live_data" => live.map_or_else(String::new, |live| live.data(report)),
        "parameters" => parameters(report),
        "start" => start(report),
        "energy" => energy(report),
        "marks" => marks(report),
        "forces" => {
            if scene.picture.contacts.is_empty() {
                String::new()
            } else {
                FORCES.to_owned()
            }
        }
        "events" => [events(report), contacts(report)].concat(),
        "statistics" => statistics(report, samples),
        "counts" => counts(&report.compiled.program),
        "equations" => equations(report.compiled),
        // The page's own style comes last, so that its colours also follow the button.
        "style" => [derivation::STYLE, STYLE].concat(),
        "data" => html::json(data),
        "script" => {
            let page = [kinematics, &DRAWING.concat(), PLAYER].join("\n");
            match live {
                Some(_) => [live::machine(report).as_str(), &page, live::SCRIPT].join("\n"),
                None => page,
            }
        }
        _ => String::new(),
    })
}

/// The documentation of the spec: the beginning is visible, the rest of a long text can be expanded.
fn introduction(docs: &str) -> String {
    /// Longer texts would push the machine off the screen.
    const SHORT: usize = 300;
    let all = paragraphs(docs);
    if docs.len() <= SHORT {
        return all;
    }
    let first: String = docs.split_whitespace().collect::<Vec<_>>().join(" ");
    let end = first.find(". ").map_or(first.len(), |at| at + 1);
    let first = first.get(..end).unwrap_or_default();
    format!(
        "<details class=\"docs\"><summary>{}</summary>\n{all}</details>\n",
        html::docs(first)
    )
}

/// Documentation as HTML; text indented by four spaces is preformatted, as in Markdown.
fn paragraphs(docs: &str) -> String {
    let mut html = String::new();
    let lines: Vec<&str> = docs.lines().collect();
    let is_code = |line: &str| line.starts_with("    ");
    let together =
        |a: &&str, b: &&str| a.trim().is_empty() == b.trim().is_empty() && is_code(a) == is_code(b);
    for block in lines.chunk_by(together) {
        let text: Vec<&str> = block.iter().map(|line| line.trim()).collect();
        let text = text.join("\n");
        match block.first() {
            Some(line) if line.trim().is_empty() => {}
            Some(line) if is_code(line) => {
                html.push_str(&format!("<pre class=\"docs\">{}</pre>\n", safe(&text)));
            }
            _ => html.push_str(&format!("<p class=\"docs\">{}</p>\n", html::docs(&text))),
        }
    }
    html
}

fn words(docs: &str) -> Cell {
    let docs = docs.split_whitespace().collect::<Vec<_>>().join(" ");
    if docs.is_empty() {
        Cell::Words(docs)
    } else {
        Cell::Raw(html::docs(&docs))
    }
}

fn figure(x: f64) -> Cell {
    Cell::Figure(shortest(rounded(x)).replace('-', "−"))
}

/// A unit in typeset form: `kg*m^2` as kg·m².
fn unit(text: &str) -> String {
    let powers = [("^-", "⁻"), ("^2", "²"), ("^3", "³"), ("^4", "⁴")];
    let text = text.replace('*', "·");
    let text = powers
        .iter()
        .fold(text, |text, (from, to)| text.replace(from, to));
    match text.as_str() {
        "1" => String::new(),
        _ => text
            .replace("⁻1", "⁻¹")
            .replace("⁻2", "⁻²")
            .replace('-', "−"),
    }
}

/// A number rounded to nine digits, for display.
fn rounded(x: f64) -> f64 {
    format!("{x:.8e}").parse().unwrap_or(x)
}

fn name(name: impl ToString) -> Cell {
    Cell::Raw(format!("<code>{}</code>", safe(&name.to_string())))
}

/// A number that was set, with its default.
fn changed(value: f64, otherwise: Option<f64>) -> Cell {
    let shown = shortest(rounded(value)).replace('-', "−");
    match otherwise {
        Some(otherwise) if otherwise.to_bits() == value.to_bits() => Cell::Figure(shown),
        otherwise => {
            let before = otherwise.map_or_else(|| "none".to_owned(), |x| shortest(rounded(x)));
            Cell::Raw(format!(
                "<strong class=\"changed\">{}</strong> <span class=\"default\">default {}</span>",
                safe(&shown),
                safe(&before.replace('-', "−"))
            ))
        }
    }
}

/// Notes in a box: the first one is visible, the others can be expanded.
fn folded(notes: &[String]) -> String {
    match notes {
        [] => String::new(),
        [one] => format!("<p class=\"alert\">{one}</p>\n"),
        [first, more @ ..] => {
            let more: Vec<String> = more.iter().map(|note| format!("<p>{note}</p>")).collect();
            format!(
                "<details class=\"alert\"><summary>{first} <span class=\"more\">and {} more</span></summary>{}</details>\n",
                more.len(),
                more.concat()
            )
        }
    }
}

/// Why the run ended early, and other warnings.
fn alert(report: &Report<'_, '_>, samples: &Samples) -> String {
    /// The smallest visible error.
    const COARSE: f64 = 0.01;
    let mut alert = String::new();
    if let Some(error) = &report.error {
        alert.push_str(&format!(
            "<p class=\"alert\" role=\"alert\"><strong>The run ended early, at t = {} s:</strong> {}</p>\n",
            shortest(report.run.end.t),
            safe(error)
        ));
    }
    let t = shortest(report.run.end.t);
    if report.is_interrupted {
        alert.push_str(&format!(
            "<p class=\"alert\" role=\"alert\"><strong>The run was interrupted, at t = {t} s.</strong></p>\n",
        ));
    }
    let mut notes: Vec<String> = Vec::new();
    if samples.error > COARSE {
        notes.push(format!(
            "<strong>The run is long for one page:</strong> between the {} states that it holds, \
             coordinates are interpolated to within {:.0} % of the range of those with the same unit.",
            samples.count,
            (100.0 * samples.error).ceil()
        ));
    }
    let warnings = report.run.warnings.iter().map(ToString::to_string);
    let contacts = report.contacts.iter().flat_map(ContactSummary::warnings);
    let warnings = warnings.chain(contacts);
    notes.extend(warnings.map(|warning| format!("<strong>Warning:</strong> {}", safe(&warning))));
    alert.push_str(&folded(&notes));
    alert
}

fn omitted(names: &[String]) -> String {
    if names.is_empty() {
        return String::new();
    }
    format!(
        "<p class=\"note\">Not drawn, since the spec gives no position for them: {}.</p>\n",
        safe(&names.join(", "))
    )
}

fn parameters(report: &Report<'_, '_>) -> String {
    let tables = [
        ("Parameters", declared_parameters(report)),
        ("Derived parameters", derived_parameters(report)),
        ("Constants", constants(report)),
        (
            if report.asked.inputs.is_empty() {
                "Inputs, held constant"
            } else {
                "Inputs"
            },
            inputs(report),
        ),
    ];
    let head = ["name", "value", "unit", "meaning"];
    let filled = tables.iter().filter(|(_, rows)| !rows.is_empty());
    let html: String = filled
        .map(|(title, rows)| html::table(title, &head, rows))
        .collect();
    if html.is_empty() {
        return "<p>The machine has no parameters.</p>".to_owned();
    }
    html
}

fn declared_parameters(report: &Report<'_, '_>) -> Vec<Vec<Cell>> {
    let slots = report.compiled.program.parameters.iter();
    slots
        .zip(report.machine.parameter_values())
        .map(|(slot, value)| {
            let default = slot.default.as_ref().map(|default| default.value);
            vec![
                name(&slot.name),
                changed(*value, default),
                Cell::Words(unit(&slot.unit_text)),
                words(&slot.docs),
            ]
        })
        .collect()
}

fn derived_parameters(report: &Report<'_, '_>) -> Vec<Vec<Cell>> {
    let model = &report.compiled.model;
    let known = |symbol| {
        let values = report.machine.parameter_values();
        let mut known = model.parameters.iter().zip(values);
        let found = known.find(|(parameter, _)| parameter.symbol.as_symbol() == Some(symbol));
        found.map_or(f64::NAN, |(_, value)| *value)
    };
    let row = |parameter: &DerivedParameter<'_>| {
        let value = lagrangian_symbolic::evaluate(model.dag, &[parameter.value], known);
        vec![
            name(&parameter.name),
            figure(value[0]),
            Cell::Words(unit(&parameter.unit_text)),
            words(&parameter.docs),
        ]
    };
    model.derived_parameters.iter().map(row).collect()
}

fn constants(report: &Report<'_, '_>) -> Vec<Vec<Cell>> {
    let model = &report.compiled.model;
    let row = |constant: &Constant<'_>| {
        let value = lagrangian_symbolic::evaluate(model.dag, &[constant.value], |_| f64::NAN);
        let is_set = report.asked.constants.contains(&constant.name.base);
        vec![
            name(&constant.name),
            if is_set {
                Cell::Raw(format!(
                    "<strong class=\"changed\">{}</strong> <span class=\"default\">set</span>",
                    safe(&shortest(value[0]).replace('-', "−"))
                ))
            } else {
                figure(value[0])
            },
            Cell::Words(unit(&constant.unit_text)),
            words(&constant.docs),
        ]
    };
    model.constants.iter().map(row).collect()
}

fn inputs(report: &Report<'_, '_>) -> Vec<Vec<Cell>> {
    let system = report.run.system;
    let values = system.default_inputs();
    let slots = report.compiled.program.inputs.iter();
    slots
        .zip(system.input_values(&values))
        .map(|(slot, (_, value))| {
            let default = slot.default.as_ref().map_or(0.0, |default| default.value);
            let input = slot.name.to_string();
            let family = input.split_once('[').map(|(family, _)| family);
            let mut given = report.asked.inputs.iter();
            let driven = given.find(|(name, _)| *name == input || Some(name.as_str()) == family);
            vec![
                name(&slot.name),
                match driven {
                    Some((_, what)) => name(what),
                    None => changed(value, Some(default)),
                },
                Cell::Words(unit(&slot.unit_text)),
                words(&slot.docs),
            ]
        })
        .collect()
}

/// A table of the start and the end of the run.
fn start(report: &Report<'_, '_>) -> String {
    let Report { machine, run, .. } = report;
    let default = machine.start();
    let (start, end) = (run.start, run.end);
    let rows: Vec<Vec<Cell>> = report
        .compiled
        .program
        .coordinates
        .iter()
        .enumerate()
        .map(|(i, slot)| {
            let at = |values: &[f64]| values.get(i).copied().unwrap_or(f64::NAN);
            vec![
                name(&slot.name),
                changed(at(&start.q.values), Some(at(&default.q.values))),
                changed(at(&start.v.values), Some(at(&default.v.values))),
                figure(at(&end.q.values)),
                figure(at(&end.v.values)),
                Cell::Words(unit(&slot.unit_text)),
                words(&slot.docs),
            ]
        })
        .collect();
    let head = [
        "coordinate",
        "start",
        "its rate",
        "end",
        "its rate",
        "unit",
        "meaning",
    ];
    html::table("Coordinates at the start and at the end", &head, &rows)
}

/// An energy with seven digits.
fn joules(x: f64) -> Cell {
    let rounded = format!("{x:.6e}").parse().unwrap_or(x);
    Cell::Figure(shortest(rounded).replace('-', "−"))
}

fn energy(report: &Report<'_, '_>) -> String {
    let Some(balance) = report.run.energy else {
        return String::new();
    };
    let row = |label: &str, value: Cell| vec![Cell::Words(label.into()), value];
    let share = format!("{:.1e}", balance.relative()).replace('-', "−");
    let mut rows = vec![
        row(
            "kinetic and potential energy at the start",
            joules(balance.start),
        ),
        row("work of drives, forces and inputs", joules(balance.work)),
        row("dissipated", joules(balance.dissipated)),
        row(
            "kinetic and potential energy at the end",
            joules(balance.end),
        ),
        row(
            "residual: the error of the balance",
            joules(balance.residual()),
        ),
        row(
            "residual, as a fraction of the energy exchanged",
            Cell::Figure(share),
        ),
    ];
    for (words, taken) in &report.run.taken_by_contacts {
        rows.push(row(words, joules(*taken)));
    }
    html::table("Energy balance", &["", "J"], &rows)
}

/// The marks of events on the time line, linked to their instants; empty without events. Of many events closer together than the
/// width of a mark only one is marked, preferably an impact, with their number.
fn marks(report: &Report<'_, '_>) -> String {
    let (from, to) = (report.run.start.t, report.run.end.t);
    if from == to {
        return String::new();
    }
    /// The events at one position.
    struct Mark {
        t: f64,
        text: String,
        is_impact: bool,
        others: usize,
    }
    let share = |t: f64| ((t - from) / (to - from)).clamp(0.0, 1.0);
    let mut marks: std::collections::BTreeMap<u16, Mark> = std::collections::BTreeMap::new();
    let impacts = impacts(report);
    for event in other_events(report.run.events, report.contacts) {
        let t = event.state.t;
        let impact = impacts.get(&(t.to_bits(), event.name.as_str()));
        let of_impact = impact.map_or_else(String::new, |impact| format!(": {impact}"));
        let text = format!("{} at t = {} s{of_impact}", event.name, shortest(t));
        let is_impact = impact.is_some();
        // The position from 0 to 1000.
        let place = (1000.0 * share(t)).round() as u16;
        let first = Mark {
            t,
            text,
            is_impact,
            others: 0,
        };
        match marks.get_mut(&place) {
            None => {
                marks.insert(place, first);
            }
            Some(mark) if is_impact && !mark.is_impact => {
                let others = mark.others + 1;
                *mark = Mark { others, ..first };
            }
            Some(mark) => mark.others += 1,
        }
    }
    let marks: String = marks
        .into_values()
        .map(|mark| {
            let text = match mark.others {
                0 => mark.text,
                others => format!("{}, and {others} more here", mark.text),
            };
            let (text, t) = (safe(&text), mark.t);
            let class = if mark.is_impact { " class=\"impact\"" } else { "" };
            format!(
                "<a{class} href=\"#t={t:?}\" style=\"left:{:.1}%\" title=\"{text}\" aria-label=\"{text}\"></a>",
                100.0 * share(t)
            )
        })
        .collect();
    if marks.is_empty() {
        marks
    } else {
        format!("<div class=\"marks\">{marks}</div>\n")
    }
}

/// The effects of impacts as text, by the time and the name of their events.
fn impacts<'a>(report: &'a Report<'_, '_>) -> std::collections::BTreeMap<(u64, &'a str), String> {
    let impacts = report.run.contact_events.iter().filter_map(|event| {
        let impact = event.impact?;
        let [normal, tangential] = impact.impulse;
        let across = impact.across.map_or(0.0, |across| across.impulse);
        let rubbed = tangential.hypot(across);
        let number = |x: f64| shortest(format!("{x:.3e}").parse().unwrap_or(x)).replace('-', "−");
        let mut words = format!("an impulse of {} N s", number(normal));
        if rubbed > 0.0 {
            words.push_str(&format!(", {} N s by friction", number(rubbed)));
        }
        words.push_str(&format!(", which took {} J", number(impact.loss)));
        Some(((event.state.t.to_bits(), event.contact.as_str()), words))
    });
    let impacts: std::collections::BTreeMap<(u64, &str), String> = impacts.collect();
    let events = report.run.events.iter().filter_map(|event| {
        let contact = event.name.strip_suffix(" impact")?;
        let words = impacts.get(&(event.state.t.to_bits(), contact))?;
        Some((
            (event.state.t.to_bits(), event.name.as_str()),
            words.clone(),
        ))
    });
    events.collect()
}

/// A list of events, each linked to its instant.
fn events(report: &Report<'_, '_>) -> String {
    let impacts = impacts(report);
    let rows: Vec<Vec<Cell>> = other_events(report.run.events, report.contacts)
        .map(|event| {
            let t = event.state.t;
            let link = format!("<a href=\"#t={t:?}\">{}</a>", shortest(t));
            let words = match impacts.get(&(t.to_bits(), event.name.as_str())) {
                Some(impact) => format!("{}: {impact}", event.name),
                None => event.name.clone(),
            };
            vec![Cell::Raw(link), Cell::Words(words)]
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    html::table("Events", &["t [s]", "event"], &rows)
}

/// The friction that rolling contacts needed, and from when on rolling was impossible.
fn contacts(report: &Report<'_, '_>) -> String {
    let time = |t: f64| format!("<a href=\"#t={t:?}\">{}</a>", shortest(rounded(t)));
    let from = |t: Option<f64>| Cell::Raw(t.map_or_else(|| "–".to_owned(), time));
    let rows = report.contacts.iter().map(|contact| {
        let coefficient = |x: Option<f64>| match x {
            Some(x) => Cell::Figure(format!("{x:.3}")),
            None => Cell::Figure("–".into()),
        };
        let greatest = contact.greatest.filter(|_| contact.pulls.is_none());
        vec![
            name(&contact.name),
            coefficient(contact.friction),
            coefficient(greatest.map(|(demand, _)| demand)),
            from(greatest.map(|(_, t)| t)),
            from(contact.slips),
            from(contact.pulls),
        ]
    });
    let rows: Vec<Vec<Cell>> = rows.collect();
    if rows.is_empty() {
        return String::new();
    }
    let head = [
        "contact",
        "friction",
        "friction needed",
        "at t [s]",
        "would slip from t [s]",
        "pulls from t [s]",
    ];
    html::table("Rolling contacts", &head, &rows)
}

fn statistics(report: &Report<'_, '_>, samples: &Samples) -> String {
    let Report {
        asked, run, method, ..
    } = report;
    let statistics = run.statistics;
    let row = |label: &str, value: String| vec![Cell::Words(label.into()), Cell::Figure(value)];
    let rows = [
        row("spec", asked.file.clone()),
        row(
            "time",
            format!("{} s to {} s", shortest(run.start.t), shortest(run.end.t)).replace('-', "−"),
        ),
        row("method", method.tableau.title.into()),
        row(
            "tolerance of a step, relative and absolute",
            asked.tolerance.replace('-', "−"),
        ),
        row("steps", statistics.steps.to_string()),
        row("steps rejected", statistics.rejected.to_string()),
        row(
            "evaluations of the accelerations",
            statistics.evaluations.to_string(),
        ),
        row(
            "wall-clock time of the run",
            format!("{:.3} s", statistics.seconds),
        ),
        row("states on this page", samples.count.to_string()),
        row(
            "interpolation between them, greatest error as a fraction of the range of a coordinate",
            format!("{:.0e}", samples.error).replace('-', "−"),
        ),
        row(
            "written by",
            format!("lagrangian {}", env!("CARGO_PKG_VERSION")),
        ),
    ];
    html::table("The run", &[""], &rows)
}

/// The operation counts of the functions that a step needs.
fn counts(program: &Program) -> String {
    let functions = program.all_functions().filter(|function| {
        (function.role == Role::Prepare || function.role == program.solving())
            && !function.results.is_empty()
    });
    let rows: Vec<Vec<Cell>> = functions
        .map(|function| {
            let counts = function.counts();
            let numbers = [
                counts.multiplications,
                counts.additions,
                counts.divisions,
                counts.sincos,
                counts.other,
            ];
            let numbers = numbers.map(|n| Cell::Figure(n.to_string()));
            [name(program.title(function.role))]
                .into_iter()
                .chain(numbers)
                .collect()
        })
        .collect();
    let head = [
        "function",
        "multiplications",
        "additions",
        "divisions",
        "sine–cosine pairs",
        "other",
    ];
    html::table("Operations of one call", &head, &rows)
}

/// The derivation as far as it fits, with the shortest formulas first.
fn equations(compiled: &Compiled<'_>) -> String {
    let mut document = Document::new(compiled);
    let sections = document.sections.iter().enumerate();
    let mut lengths: Vec<(usize, [usize; 2])> = sections
        .flat_map(|(s, section)| {
            let blocks = section.blocks.iter().enumerate();
            blocks.map(move |(b, block)| (length(block), [s, b]))
        })
        .collect();
    lengths.sort_unstable();
    let mut left = DERIVATION;
    let mut left_out = false;
    for (length, [s, b]) in lengths {
        if length <= left {
            left -= length;
            continue;
        }
        if let Some(block) = document
            .sections
            .get_mut(s)
            .and_then(|section| section.blocks.get_mut(b))
        {
            *block = Block::Paragraph(vec!["(too long for this page)".into()]);
            left_out = true;
        }
    }
    let note = if left_out {
        "<p class=\"note\">Formulas too long for this page are printed by <code>lagrangian derive</code>.</p>\n"
    } else {
        ""
    };
    format!(
        "<h2>Derivation</h2>\n{note}{}",
        derivation::article(&document)
    )
}

/// The length of a block as HTML.
fn length(block: &Block) -> usize {
    let section = lagrangian_print::document::Section {
        title: String::new(),
        blocks: vec![block.clone()],
    };
    derivation::article(&Document {
        title: String::new(),
        sections: vec![section],
    })
    .len()
}
