//! An interactive page: the machine's program as JavaScript, with sliders that run it again.

use std::collections::BTreeMap;

use lagrangian::interpreted::Named;
use lagrangian::methods::Method;
use lagrangian::{Machine, State, System, Warning};
use lagrangian_languages::script::{self, JAVASCRIPT};
use lagrangian_program::Program;
use lagrangian_units::{rate_name, state_of};
use serde_json::{Value, json};

use super::Report;
use super::html;

/// The script that runs the machine and shows it.
pub const SCRIPT: &str = include_str!("live.js");

/// The section with the sliders.
pub const SECTION: &str = r#"<section id="live" aria-labelledby="live-title">
<style>
#sliders { display: grid; grid-template-columns: repeat(auto-fill, minmax(22rem, 1fr)); gap: 0.3rem 1.5rem; }
.slider { display: grid; grid-template-columns: 7rem 1fr 7rem 4rem; gap: 0.5rem; align-items: center; }
.slider input { min-width: 0; }
@media print { #live { display: none; } }
</style>
<h2 id="live-title">Run it again</h2>
<p class="note">This page contains the machine: moving a slider, or editing the number beside it, runs it again from the start, with the same method and tolerance. Start values that have not been changed follow the parameters.</p>
<div id="sliders"></div>
<div><button type="button" id="again">Reset</button> <span id="live-status" role="status"></span></div>
</section>
"#;

/// The methods that the page supports: embedded explicit Runge–Kutta pairs.
const EXPLICIT: [&str; 3] = ["dop853", "dopri5", "bs32"];

/// Why a page cannot run a machine; `None` if it can.
pub fn reason_not_live(
    program: &Program,
    method: &Method,
    is_driven: bool,
    kept: &[String],
) -> Option<String> {
    let without = "leave out --live, and the page shows the run of the command; for other values, run it again with --set";
    let message = if let Some(contact) = program.contacts.first() {
        format!(
            "the page does not determine whether `{contact}` of `sliding` sticks or slides: {without}"
        )
    } else if let Some(contact) = program.unilateral.first() {
        format!(
            "the page does not determine whether `{}` of `contacts` is closed: {without}",
            contact.name
        )
    } else if let Some(name) = kept.first() {
        format!(
            "the page keeps only the start values that the spec keeps: write `keep {{ {name} }}` in place of --keep"
        )
    } else if is_driven {
        "the page holds inputs constant, at the values of its sliders: leave out --input, or leave out --live, and the page shows \
         the run with these inputs"
            .to_owned()
    } else if !EXPLICIT.contains(&method.tableau.name) {
        format!(
            "the page supports only explicit methods with step-size control, and `{}` is not one: use --method dop853",
            method.tableau.name
        )
    } else {
        return None;
    };
    Some(format!("--live: {message}"))
}

/// Advice for dependent constraints: the page solves for the multipliers of all constraints.
pub fn without_constraint(warning: &Warning, machine: &str, file: &str) -> String {
    let help = match warning {
        Warning::RedundantConstraint { constraint, .. } => format!(
            ", so where the others imply it everywhere, leave it out in a variant: \
             `machine {machine}Page extends \"{file}\" {{ remove constraints.{constraint}; }}`"
        ),
        _ => String::new(),
    };
    format!("--live: {warning}; the page solves for the multipliers of all constraints{help}")
}

/// The settings of the integration on the page.
pub struct Live<'a> {
    /// Relative and absolute tolerance of a step.
    pub tolerance: f64,
    /// The most steps of a run.
    pub most_steps: usize,
    /// The start as the spec and the call state it, before it is projected onto the constraints.
    pub stated: &'a State<Named>,
}

/// The machine as a script. It contains names of the spec, which must not end the element.
pub fn machine(report: &Report<'_, '_>) -> String {
    let program = &report.compiled.program;
    let text = script::file(program, &JAVASCRIPT, &[], &BTreeMap::new());
    text.replace("</", "<\\/").replace("<!--", "<\\!--")
}

impl Live<'_> {
    /// The element with the data that the script reads.
    pub fn data(&self, report: &Report<'_, '_>) -> String {
        let program = &report.compiled.program;
        let tableau = &report.method.tableau;
        let start = report.run.start;
        let default_start = report.machine.start();
        // Values given in the call are fixed; the others follow from the parameters.
        let stated = self.stated.q.values.iter().chain(&self.stated.v.values);
        let usual = default_start.q.values.iter().chain(&default_start.v.values);
        let changed: Vec<Option<f64>> = stated
            .zip(usual)
            .map(|(value, usual)| (value.to_bits() != usual.to_bits()).then_some(*value))
            .collect();
        let names = program
            .coordinates
            .iter()
            .map(|slot| (slot.name.to_string(), slot.unit.to_string()));
        let rates = program.coordinates.iter().map(|slot| {
            (
                rate_name(&slot.name.to_string(), ""),
                slot.unit.rate().to_string(),
            )
        });
        let states: Vec<Value> = names
            .chain(rates)
            .zip(start.q.values.iter().chain(&start.v.values))
            .map(|((name, unit), value)| {
                // Nothing depends on the integral of a state of first order.
                let is_hidden = state_of(&name).is_some();
                json!({ "name": name, "unit": unit, "value": value, "hidden": is_hidden })
            })
            .collect();
        let kept = states.iter().map(|state| {
            let name = state["name"].as_str().unwrap_or_default();
            program.kept.iter().any(|kept| kept == name)
        });
        let kept: Vec<bool> = kept.collect();
        let value = json!({
            "parameters": report.machine.parameter_values(),
            "inputs": report.machine.prepare().default_inputs().values,
            "start": changed,
            "states": states,
            "constraints": {
                "holonomic": program.constraints.iter().map(|it| it.holonomic).collect::<Vec<_>>(),
                "kept": kept,
            },
            "facts": program
                .assumptions
                .iter()
                .map(|fact| json!({ "text": fact.text, "strict": fact.strict }))
                .collect::<Vec<_>>(),
            "tolerance": self.tolerance,
            "steps": self.most_steps,
            "method": {
                "stages": tableau.stages,
                "a": tableau.a,
                "c": tableau.c,
                "error": tableau.error,
                "coarse": tableau.coarse_error,
                "power": tableau.error_power,
                "change": [tableau.step_change.0, tableau.step_change.1],
            },
        });
        format!(
            "<script type=\"application/json\" id=\"live-data\">{}</script>",
            html::json(&value)
        )
    }
}
