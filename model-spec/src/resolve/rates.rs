//! Rates of coordinates at the start: `der(phi): rad/s = 30`.

use lagrangian_symbolic::Expr;
use rustc_hash::FxHashMap;

use super::Resolver;
use super::names::{Namespace, declared_measure};
use super::published::variable;
use super::value::{MemberId, Scope, limits};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::Coordinate;
use crate::source::Span;
use crate::syntax::{Index, Item, Quantity, SectionKind, Spec};

/// Appends the documentation of a rate to that of its coordinate.
fn append_docs(docs: &mut String, more: &str) {
    if !docs.is_empty() && !more.is_empty() {
        docs.push('\n');
    }
    docs.push_str(more);
}

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// Gives the coordinates their rates. Those of a variant replace those of its base; if a
    /// variant removes a coordinate, its rate in the base is dropped too.
    pub fn start_rates(&mut self, layers: &'a [Spec], coordinates: &mut [Coordinate<'d>]) {
        for (layer, spec) in layers.iter().enumerate() {
            let is_inherited = layer + 1 < layers.len();
            let mut span_of: FxHashMap<usize, Span> = FxHashMap::default();
            for item in &spec.rates {
                let range = match &item.name.index {
                    Index::Range(range) => Some(range),
                    _ => None,
                };
                for index in self.unrolled(range) {
                    let scope = Scope {
                        index: variable(range, index),
                        limit: &limits::START_RATE,
                        expected_unit: None,
                    };
                    let rates = self.repeat_until_resolved(|resolver| {
                        resolver.start_rate(item, index, scope, is_inherited)
                    });
                    for (coordinate, rate) in rates.into_iter().flatten() {
                        if let Some(first) = span_of.insert(coordinate, item.span) {
                            self.duplicate_rate(item, first);
                        }
                        if let Some(coordinate) = coordinates.get_mut(coordinate) {
                            coordinate.start_rate = rate;
                            append_docs(&mut coordinate.docs, &item.docs);
                        }
                    }
                }
            }
        }
    }

    /// The coordinates of an item, and their rate. Without an index the item applies to every
    /// member of a family.
    fn start_rate(
        &mut self,
        item: &'a Item<Quantity>,
        index: Option<i64>,
        scope: Scope<'a>,
        is_inherited: bool,
    ) -> Option<Vec<(usize, Expr<'d>)>> {
        let name = &item.name.base;
        let index = match &item.name.index {
            Index::One(one) => Some(self.integer(one, Some(scope))?),
            _ => index,
        };
        let Some(group) = self.find_group(Namespace::Values, &name.text) else {
            if !is_inherited {
                self.unknown_coordinate(name);
            }
            return None;
        };
        let members = self.members_under(group, index);
        if is_inherited && !members.iter().any(|&member| self.is_coordinate(member)) {
            return None;
        }
        self.check_members(&members, group, (&name.text, index), item.name.span);
        let measure = declared_measure(&item.content);
        let unit = measure.as_ref().map(|measure| measure.unit);
        if !self.is_unit_of_state(&item.content, unit) {
            return None;
        }
        let mut rates = Vec::new();
        for member in members {
            if !self.is_coordinate(member) {
                let found = self.declaration(member).section.item();
                let message = format!(
                    "a coordinate is expected here, and `{}` is {found}",
                    name.text
                );
                self.error(Code::WrongKind, name.span, message);
                continue;
            }
            let rate = self.unit_of(member)?.rate();
            if let Some(written) = &item.content.unit {
                let reason = "a rate has the unit of its coordinate over s";
                self.require_unit(unit, rate, written.span, reason);
            }
            let value = item.content.value.as_ref()?;
            let reason = "the expected unit is that of the declaration";
            let value = self.scalar_in(value, rate, reason, scope)?.expr;
            rates.extend(self.ordinal(member).map(|coordinate| (coordinate, value)));
        }
        Some(rates)
    }

    fn is_coordinate(&self, member: MemberId) -> bool {
        self.declaration(member).section == SectionKind::Coordinates
    }

    fn duplicate_rate(&mut self, item: &Item<Quantity>, first: Span) {
        let message = format!("the rate of `{}` is given twice", item.name.base.text);
        let diagnostic = Diagnostic::new(Code::SaidTwice, item.name.span, message);
        self.push(diagnostic.note(first, "it is given here"));
    }
}
