//! Each error that the reference lists for a section is raised by that section: there is one spec for each pair.

use std::collections::BTreeSet;

use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{InMemory, Sources};
use lagrangian_spec::syntax::SectionKind;

use crate::page::Page;

/// A section, an error, and a variant of `tests/ui/cart.machine` that raises the error in the section: the contents of its
/// braces, or a whole machine.
fn mistakes() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    let lines = include_str!("mistakes.txt").lines();
    lines.filter(|line| !line.is_empty()).map(|line| {
        let (of, body) = line.split_once(": ").expect("a colon");
        let (section, code) = of.split_once(' ').expect("a section and an error");
        (section, code, body)
    })
}

/// Two circles, for errors about circles.
const CIRCLES: &str = "circles { tyre { on: beam, center: (0, 0), radius: l }, \
                       ring { on: ground, center: (0, 0), radius: l } }";

/// All messages for a spec.
fn said(text: &str) -> (BTreeSet<&'static str>, String) {
    let cart = Page::open("tests/ui/cart.machine").text;
    let mut files = InMemory::new().with("cart.machine", &cart);
    let (dag, mut sources, mut report) = (Default::default(), Sources::new(), Report::new());
    let name = "variant.machine";
    let model =
        lagrangian_spec::model(&dag, name, text, &[], &mut files, &mut sources, &mut report);
    model.and_then(|model| Compiled::new(model, &mut report));
    let diagnostics = report.diagnostics();
    let codes = diagnostics.iter().map(|message| message.code.as_str());
    (codes.collect(), report.render(&sources))
}

#[test]
fn the_errors_of_an_entry_are_raised_by_its_section() {
    let mut wrong = Vec::new();
    for (section, code, body) in mistakes() {
        assert!(body.contains(section), "{section}: {body}");
        let body = body.replace("{circles}", CIRCLES);
        let text = if body.starts_with("machine ") {
            body
        } else {
            format!("machine Variant extends \"cart.machine\" {{ {body} }}")
        };
        let (codes, printed) = said(&text);
        if !codes.contains(code) {
            wrong.push(format!("{section}: no {code} in\n{text}\n{printed}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_entries_list_these_errors_and_no_others() {
    let page = Page::open("docs/reference.md");
    for section in SectionKind::ALL {
        let entry = page.entry(&format!("### `{section}`"));
        let (_, errors) = entry
            .and_then(|entry| entry.split_once("**Errors.**"))
            .unwrap_or_else(|| panic!("{section}: no errors"));
        let listed = errors.split("[`").skip(1);
        let listed: BTreeSet<&str> = listed.filter_map(|rest| rest.split('`').next()).collect();
        let raised = mistakes()
            .filter(|(of, ..)| *of == section.as_str())
            .map(|(_, code, _)| code);
        assert_eq!(listed, raised.collect(), "{section}");
    }
}
