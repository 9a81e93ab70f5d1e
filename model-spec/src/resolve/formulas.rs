//! Output formulas supplied by the caller: `max(abs(x))` for a sweep.

use std::collections::{BTreeMap, BTreeSet};

use super::names::RESERVED_VALUES;
use crate::diagnostic::{Code, Diagnostic, Report};
use crate::source::Sources;
use crate::syntax::{
    Call, Declared, Expression, ExpressionKind, Factor, Ident, Index, Item, Quantity, Spec,
};
use crate::token::lex;
use crate::unit::Measure;

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
///
/// These become definitions under names that no text can contain, because a definition under the name of an output would also have
/// a meaning in the spec: there `planet` may be the angle of a frame, and `10*N` ten newtons.
pub(super) fn add(mut formulas: Vec<Item<Quantity>>, layers: &mut [Spec], report: &mut Report) {
    let mut outputs = Outputs::of(layers);
    for formula in &mut formulas {
        if let Some(value) = &mut formula.content.value {
            outputs.redirect(value, report);
        }
    }
    for layer in &mut *layers {
        let shared = layer.outputs.iter().filter_map(|item| {
            let name = outputs.used.get(&item.name.base.text)?;
            let mut shared = item.clone();
            shared.name.base.text.clone_from(name);
            Some(shared)
        });
        layer.shared_outputs = shared.collect();
    }
    if let Some(last) = layers.last_mut() {
        last.outputs.extend(formulas);
    }
}

/// The outputs of a spec, as formulas of the caller refer to them.
struct Outputs {
    /// For the name of each output the name of its definition. This is the same if something else that formulas may contain has
    /// this name, so that the definition is reported as a duplicate.
    names: BTreeMap<String, String>,
    /// Those of them that formulas contain.
    used: BTreeMap<String, String>,
}

impl Outputs {
    fn of(layers: &[Spec]) -> Outputs {
        let named = |items: &[Item<Quantity>]| -> Vec<String> {
            let names = items.iter().map(|item| item.name.base.text.clone());
            names.collect()
        };
        let others = layers.iter().flat_map(|layer| {
            let definitions = layer.define.iter();
            let definitions = definitions.map(|item| item.name.base.text.clone());
            let quantities = [&layer.parameters, &layer.constants, &layer.inputs];
            let quantities = quantities.into_iter().flat_map(|items| named(items));
            quantities.chain(definitions)
        });
        let reserved = RESERVED_VALUES.iter().map(|(word, _)| (*word).to_owned());
        let others: BTreeSet<String> = others.chain(reserved).collect();
        let outputs = layers.iter().flat_map(|layer| named(&layer.outputs));
        let names = outputs.map(|name| {
            let definition = if others.contains(&name) {
                name.clone()
            } else {
                format!("{name} (output)")
            };
            (name, definition)
        });
        Outputs {
            names: names.collect(),
            used: BTreeMap::new(),
        }
    }

    /// Makes an expression refer to definitions where it contains outputs.
    fn redirect(&mut self, expression: &mut Expression, report: &mut Report) {
        match &mut expression.kind {
            ExpressionKind::Number(_) | ExpressionKind::Text(_) | ExpressionKind::Error => {}
            ExpressionKind::Name(reference) => self.redirect_name(&mut reference.base),
            ExpressionKind::Sum(terms) => {
                let values = terms.iter_mut().map(|term| &mut term.value);
                values.for_each(|value| self.redirect(value, report));
            }
            ExpressionKind::Product(factors) => {
                self.refuse_units(factors, report);
                let values = factors.iter_mut().map(|factor| &mut factor.value);
                values.for_each(|value| self.redirect(value, report));
            }
            ExpressionKind::Negative(value) => self.redirect(value, report),
            ExpressionKind::Power(base, exponent) => {
                self.redirect(base, report);
                self.redirect(exponent, report);
            }
            ExpressionKind::Call(Call { arguments, .. }) | ExpressionKind::Tuple(arguments) => {
                let arguments = arguments.iter_mut();
                arguments.for_each(|argument| self.redirect(argument, report));
            }
            ExpressionKind::Chain(chain) => {
                // A name before a dot is that of a frame or a body.
                if !matches!(chain.root.kind, ExpressionKind::Name(_)) {
                    self.redirect(&mut chain.root, report);
                }
                let links = chain.links.iter_mut();
                let arguments = links.flat_map(|link| link.arguments.iter_mut().flatten());
                arguments.for_each(|argument| self.redirect(argument, report));
            }
        }
    }

    fn redirect_name(&mut self, name: &mut Ident) {
        if let Some(definition) = self.names.get(&name.text) {
            self.used.insert(name.text.clone(), definition.clone());
            name.text.clone_from(definition);
        }
    }

    /// Refuses an output after a number if a unit has the same name: either could be meant.
    fn refuse_units(&self, factors: &[Factor], report: &mut Report) {
        let unit_in = |factor: &Factor| -> Option<Ident> {
            let value = match &factor.value.kind {
                ExpressionKind::Power(base, _) => &base.kind,
                other => other,
            };
            let ExpressionKind::Name(reference) = value else {
                return None;
            };
            Measure::named(&reference.base.text).map(|_| reference.base.clone())
        };
        let is_number = |factor: &&Factor| match &factor.value.kind {
            ExpressionKind::Number(_) => true,
            ExpressionKind::Name(reference) => reference.base.text == "pi",
            _ => false,
        };
        let numbers = factors.iter().take_while(is_number).count();
        if numbers == 0 {
            return;
        }
        let units = factors[numbers..].iter().map_while(unit_in);
        for unit in units.filter(|unit| self.names.contains_key(&unit.text)) {
            let name = &unit.text;
            let message = format!("`{name}` is an output, and a unit that may stand here too");
            let diagnostic = Diagnostic::new(Code::ReservedName, unit.span, message);
            report.push(diagnostic.help(format!(
                "write `{name}*…` if the output is meant, or else the number without this unit, in SI units"
            )));
        }
    }
}
