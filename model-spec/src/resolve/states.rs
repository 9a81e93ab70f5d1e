//! First-order states: `i: A = 0`, with `der(i) = (U - R*i)/L`.
//!
//! A state is treated as the rate of a coordinate on which nothing depends, its time integral. So the
//! equations, their proof and every method treat it like any rate, with a start, an error and derivatives.

use lagrangian_symbolic::Expr;
use rustc_hash::FxHashMap;

use super::Resolver;
use super::names::{Namespace, declared_measure, suggestion, with_help};
use super::published::variable;
use super::value::{Limit, MemberId, Scope, limit, limits};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Coordinate, stage};
use crate::source::Span;
use crate::syntax::{Index, Item, Quantity, SectionKind, Spec};
use crate::unit::Unit;

/// The limit of the expression for the rate of a state.
static RATE: Limit = limit(
    stage::INPUT,
    "the rate of a state",
    "it may depend on states, coordinates, velocities, inputs, parameters and `t`",
);

const SECOND: Unit = Unit::base(0, 0, 1);

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// The states, in their order, each with its rate. A rate of a variant replaces that of its base; if a
    /// variant removes a state, its rate in the base is dropped too.
    pub fn states(&mut self, layers: &'a [Spec]) -> Vec<Coordinate<'d>> {
        let members = self.members_of(SectionKind::States);
        let mut states = self.resolve_each(SectionKind::States, |resolver, member| {
            Some((member, resolver.first_order(member)?))
        });
        let mut rates: FxHashMap<MemberId, Expr<'d>> = FxHashMap::default();
        let mut failed = states.len() != members.len();
        for (layer, spec) in layers.iter().enumerate() {
            let is_inherited = layer + 1 < layers.len();
            let mut span_of: FxHashMap<MemberId, Span> = FxHashMap::default();
            for item in &spec.state_rates {
                let range = match &item.name.index {
                    Index::Range(range) => Some(range),
                    _ => None,
                };
                for index in self.unrolled(range) {
                    let scope = Scope {
                        index: variable(range, index),
                        limit: &RATE,
                        expected_unit: None,
                    };
                    let found = self.repeat_until_resolved(|resolver| {
                        resolver.state_rate(item, index, scope, is_inherited)
                    });
                    failed |= found.is_none();
                    for (member, rate) in found.into_iter().flatten() {
                        if let Some(first) = span_of.insert(member, item.span) {
                            self.duplicate_state_rate(item, first);
                        }
                        rates.insert(member, rate);
                    }
                }
            }
        }
        for (member, state) in &mut states {
            state.rate = rates.get(member).copied();
            if state.rate.is_none() && !failed {
                let name = self.name(*member);
                let message = format!("the rate of the state `{name}` is not given");
                let missing = Diagnostic::new(Code::MissingValue, state.span, message);
                self.push(missing.help(format!("write `der({name}) = …` among the states")));
            }
        }
        states.into_iter().map(|(_, state)| state).collect()
    }

    /// A state, without its rate.
    fn first_order(&mut self, member: MemberId) -> Option<Coordinate<'d>> {
        let quantity = self.quantity(member)?;
        let measure = declared_measure(quantity);
        let unit = measure.as_ref().map(|measure| measure.unit);
        self.check_symbol_name(member);
        let is_si = self.is_unit_of_state(quantity, unit);
        let scope = self.scope(member, &limits::START);
        let start = match &quantity.value {
            Some(value) => self.quantity_value(value, measure.as_ref(), scope)?.expr,
            None => self.dag.zero(),
        };
        if !is_si {
            return None;
        }
        let [q, v, a] = self.members[member].symbols?;
        let unit_text = match self.unit_text(member, unit?).as_str() {
            "1" => "s".to_owned(),
            unit => format!("{unit}*s"),
        };
        Some(Coordinate {
            name: self.name(member).integral(),
            docs: self.docs(member),
            unit: unit?.times(SECOND),
            unit_text,
            start: self.dag.zero(),
            start_rate: start,
            rate: None,
            q,
            v,
            a,
            span: self.span(member),
        })
    }

    /// The states of an item `der(i) = …`, and their rate. Without an index the item applies to every
    /// member of a family.
    fn state_rate(
        &mut self,
        item: &'a Item<Quantity>,
        index: Option<i64>,
        scope: Scope<'a>,
        is_inherited: bool,
    ) -> Option<Vec<(MemberId, Expr<'d>)>> {
        let name = &item.name.base;
        let index = match &item.name.index {
            Index::One(one) => Some(self.integer(one, Some(scope))?),
            _ => index,
        };
        let Some(group) = self.find_group(Namespace::Values, &name.text) else {
            if is_inherited {
                return Some(Vec::new());
            }
            self.unknown_state(item);
            return None;
        };
        let is_state = |resolver: &Self, member: MemberId| {
            resolver.declaration(member).section == SectionKind::States
        };
        let members = self.members_under(group, index);
        if is_inherited && !members.iter().any(|&member| is_state(self, member)) {
            return Some(Vec::new());
        }
        self.check_members(&members, group, (&name.text, index), item.name.span);
        let mut rates = Vec::new();
        for member in members {
            if !is_state(self, member) {
                let section = self.declaration(member).section;
                let found = section.item();
                let message = format!("a state is expected here, and `{}` is {found}", name.text);
                let wrong = Diagnostic::new(Code::WrongKind, name.span, message);
                self.push(match section {
                    SectionKind::Coordinates => wrong.help(
                        "the equations of motion determine how a rate changes; its start value \
                         is given under `coordinates`",
                    ),
                    _ => wrong,
                });
                return None;
            }
            let rate = self.unit_of(member)?.rate();
            if let Some(written) = &item.content.unit {
                let unit = declared_measure(&item.content).map(|measure| measure.unit);
                let reason = "the rate of a state has its unit over s";
                self.require_unit(unit, rate, written.span, reason);
            }
            let value = item.content.value.as_ref()?;
            let reason = "the units of a state and its rate must agree";
            rates.push((member, self.scalar_in(value, rate, reason, scope)?.expr));
        }
        Some(rates)
    }

    fn unknown_state(&mut self, item: &'a Item<Quantity>) {
        let name = &item.name.base;
        if self.incomplete || name.text.is_empty() {
            return;
        }
        let states = self
            .declarations
            .iter()
            .filter(|declaration| declaration.section == SectionKind::States)
            .map(|declaration| declaration.name.base.text.as_str());
        let help = suggestion(&name.text, states)
            .or_else(|| Some(format!("declare it: `{}: 1 = 0`", name.text)));
        let message = format!("no state is named `{}`", name.text);
        let unknown = Diagnostic::new(Code::UnknownName, name.span, message);
        self.push(with_help(unknown, help));
    }

    fn duplicate_state_rate(&mut self, item: &Item<Quantity>, first: Span) {
        let message = format!("the rate of `{}` is given twice", item.name.base.text);
        let diagnostic = Diagnostic::new(Code::SaidTwice, item.name.span, message);
        self.push(diagnostic.note(first, "it is given here"));
    }

    /// Refuses an expression that contains the rate of a coordinate where states are allowed; returns true
    /// if it does.
    pub fn refuse_rates(
        &mut self,
        expression: Expr<'d>,
        span: Span,
        noun: &str,
        help: &'static str,
    ) -> bool {
        let what = format!("{noun} cannot depend on the rate of");
        self.refuse_within(expression, span, (SectionKind::Coordinates, &what, help))
    }

    /// Refuses an expression that contains a state where none is allowed; returns true if it does.
    pub fn refuse_states(
        &mut self,
        expression: Expr<'d>,
        span: Span,
        noun: &str,
        help: &'static str,
    ) -> bool {
        let what = format!("{noun} cannot depend on the state");
        self.refuse_within(expression, span, (SectionKind::States, &what, help))
    }

    /// Refuses an expression with a coordinate whose rate it contains, or with a state: `what` is the message, before its name.
    fn refuse_within(
        &mut self,
        expression: Expr<'d>,
        span: Span,
        (section, what, help): (SectionKind, &str, &'static str),
    ) -> bool {
        let Some(member) = self.rate_within(expression, section) else {
            return false;
        };
        let message = format!("{what} `{}`", self.name(member));
        self.push(Diagnostic::new(Code::ForbiddenDependence, span, message).help(help));
        true
    }

    /// The first coordinate whose rate an expression contains, or the first state, whose value stands where a coordinate has its rate.
    fn rate_within(&self, expression: Expr<'d>, section: SectionKind) -> Option<MemberId> {
        self.members_of(section).into_iter().find(|&member| {
            let symbols = self.members[member].symbols;
            let symbol = symbols.and_then(|[_, rate, _]| rate.as_symbol());
            symbol.is_some_and(|symbol| expression.depends_on(symbol))
        })
    }
}
