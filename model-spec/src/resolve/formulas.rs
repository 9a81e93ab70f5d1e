//! Output formulas supplied by the caller: `max(abs(x))` for a sweep.

use crate::diagnostic::Report;
use crate::source::Sources;
use crate::syntax::{Declared, Ident, Index, Item, Quantity, Spec};
use crate::token::{lex, normalized};

/// A formula that is computed in addition to the outputs of a spec.
#[derive(Clone, Copy, Debug)]
pub struct Formula<'a> {
    /// The name of the output; not a valid name in a spec, so that it cannot clash with other outputs.
    pub name: &'a str,
    /// The name of the text in messages.
    pub source_name: &'a str,
    /// An expression in anything that an output may depend on, and in the outputs of the spec, which are in SI units.
    pub text: &'a str,
    /// The required unit; if none is given, the formula's own unit in SI.
    pub unit: Option<&'a str>,
}

/// Formulas, as items of a spec.
pub(crate) fn items(
    formulas: &[Formula<'_>],
    sources: &mut Sources,
    report: &mut Report,
) -> Vec<Item<Quantity>> {
    let item = |formula: &Formula<'_>| {
        let texts = [
            ("the unit", formula.unit.unwrap_or("1")),
            (formula.source_name, formula.text),
        ];
        let [unit, value] = texts.map(|(name, text)| {
            let source = sources.add(name, text);
            (source, lex(source, text, report))
        });
        let mut content = Quantity::parse([(unit.0, &unit.1), (value.0, &value.1)], report);
        if formula.unit.is_none() {
            content.unit = None;
        }
        let span = content.value.as_ref().map(|value| value.span);
        let span = span.unwrap_or_default();
        let text = formula.name.to_owned();
        Item {
            docs: String::new(),
            name: Declared {
                base: Ident { text, span },
                index: Index::default(),
                span,
            },
            content,
            span,
        }
    };
    formulas.iter().map(item).collect()
}

/// Appends formulas to the outputs of the last layer, and lets them use the outputs that they name.
pub(super) fn add(formulas: Vec<Item<Quantity>>, layers: &mut [Spec], sources: &Sources) {
    let text = |item: &Item<Quantity>| {
        let span = item.content.value.as_ref().map(|value| value.span);
        span.map_or("", |span| sources.text(span.source))
    };
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    let words = formulas
        .iter()
        .flat_map(|item| text(item).split(|c: char| !is_part(c)));
    let words: Vec<String> = words.map(|word| normalized(word).into_owned()).collect();
    for layer in &mut *layers {
        let named = layer
            .outputs
            .iter()
            .filter(|item| words.contains(&item.name.base.text));
        let shared = named.filter_map(|item| {
            let content = item.content.value.clone()?;
            Some(Item {
                docs: String::new(),
                name: item.name.clone(),
                content,
                span: item.span,
            })
        });
        let shared: Vec<_> = shared.collect();
        layer.define.extend(shared);
    }
    if let Some(last) = layers.last_mut() {
        last.outputs.extend(formulas);
    }
}
