//! Values supplied by the caller: `--set w=1500*rpm`.

use lagrangian_symbolic::{Dag, nearest};

use super::layers::Layers;
use super::names::declared_measure;
use super::value::{Scope, limits};
use super::{Language, Resolver};
use crate::diagnostic::Report;
use crate::source::Sources;
use crate::syntax::Quantity;
use crate::token::lex;

/// The value that a text gives to a parameter, a coordinate or an input of a unit, read like its default in
/// a spec: it consists of numbers and units, is checked against the unit and returned in it. Bare numbers
/// are in that unit already.
///
/// Errors are reported as for a spec, and no value is returned.
///
/// ```
/// # use lagrangian_spec::{diagnostic::Report, resolve::value_in, source::Sources};
/// let (mut sources, mut report) = (Sources::new(), Report::new());
/// let mut value = |text, unit| value_in(text, unit, &mut sources, &mut report);
/// assert_eq!(value("3*cm", "mm"), Some(30.0));
/// assert_eq!(value("3", "mm"), Some(3.0));
/// assert_eq!(value("60*rpm", "rad/s"), Some(std::f64::consts::TAU));
/// assert_eq!(value("3*s", "mm"), None);
/// assert!(report.render_short(&sources).contains("expected m, found s"));
/// ```
pub fn value_in(text: &str, unit: &str, sources: &mut Sources, report: &mut Report) -> Option<f64> {
    let texts = [("the unit", unit), ("the value", text)];
    let [unit, value] = texts.map(|(name, text)| {
        let source = sources.add(name, text);
        (source, lex(source, text, report))
    });
    let content = Quantity::parse([(unit.0, &unit.1), (value.0, &value.1)], report);
    if report.has_errors() {
        return None;
    }
    let measure = declared_measure(&content)?;
    let layers = Layers {
        specs: Vec::new(),
        incomplete: false,
    };
    let dag = Dag::new();
    let mut resolver = Resolver::new(&layers, Language::WITHOUT_SECTIONS, &dag, &[], report);
    let scope = Scope {
        index: None,
        limit: &limits::DEFAULT,
        expected_unit: None,
    };
    let written = content.value.as_ref()?;
    let value = resolver
        .repeat_until_resolved(|resolver| resolver.quantity_value(written, Some(&measure), scope));
    let value = value.map(|value| nearest(value.expr))?;
    (!report.has_errors()).then_some(value)
}
