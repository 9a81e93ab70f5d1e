//! Parameters that follow from others: `J: kg*m^2 = m*r^2/2`.
//!
//! Such a parameter is replaced by its formula wherever it occurs. So whatever is computed from it depends on the parameters in the
//! formula, and derivatives by these pass through it by the chain rule. It is not a parameter of the model. If the program that reads
//! the spec gives it a value ([`Spec::given`](crate::syntax::Spec::given), or as constants are given), it is a parameter like any other.

use lagrangian_symbolic::Expr;
use rustc_hash::FxHashMap;

use super::Resolver;
use super::names::{Content, Namespace, declared_measure};
use super::text::show;
use super::value::{MemberId, Value, limits};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::DerivedParameter;
use crate::model::bounds::BoundKind;
use crate::source::Span;
use crate::syntax::{Expression, ExpressionKind, Index, Quantity, SectionKind};
use crate::unit::Unit;

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// Finds the parameters whose values refer to other parameters, directly or through definitions.
    pub fn find_derived(&mut self) {
        let mut naming: FxHashMap<&str, Vec<usize>> = FxHashMap::default();
        let mut open: Vec<&str> = Vec::new();
        for (place, declaration) in self.declarations.iter().enumerate() {
            if Namespace::of(declaration.section) != Namespace::Values {
                continue;
            }
            let is_folded = [SectionKind::Constants, SectionKind::Define];
            if !is_folded.contains(&declaration.section) {
                open.push(&declaration.name.base.text);
            }
            let value = match (declaration.section, declaration.content) {
                (SectionKind::Parameters, Content::Quantity(quantity)) => quantity.value.as_ref(),
                (SectionKind::Define, Content::Expression(expression)) => Some(expression),
                _ => None,
            };
            let index = match &declaration.name.index {
                Index::Range(range) => range.variable.as_ref(),
                _ => None,
            };
            let is_index = |name: &str| index.is_some_and(|index| index.text == name);
            for name in value.map(names_in).unwrap_or_default() {
                if !is_index(name) {
                    naming.entry(name).or_default().push(place);
                }
            }
        }
        // Whatever refers to a parameter depends on parameters, and so does whatever refers to such a definition.
        while let Some(name) = open.pop() {
            for place in naming.remove(name).unwrap_or_default() {
                let declaration = &self.declarations[place];
                if declaration.section == SectionKind::Parameters {
                    self.derived.insert(place);
                } else {
                    open.push(&declaration.name.base.text);
                }
            }
        }
    }

    /// Whether the spec gives a parameter by a formula of others.
    pub fn has_formula(&self, member: MemberId) -> bool {
        self.derived.contains(&self.members[member].declaration)
    }

    /// Whether a member is a parameter that follows from others: it has a formula, and the caller gives it no value.
    pub fn is_derived(&self, member: MemberId) -> bool {
        if !self.has_formula(member) {
            return false;
        }
        let base = self.groups[self.members[member].group].base;
        let name = show(base, self.members[member].index);
        let values = self.overrides.iter().map(|(name, _)| name);
        let mut given = self.given.iter().chain(values);
        !given.any(|given| *given == name || given == base)
    }

    /// The value that the caller gives to a parameter that would otherwise be derived, in its declared unit.
    pub fn given_value(&self, member: MemberId) -> Option<Expr<'d>> {
        let name = self.name(member);
        let full = name.to_string();
        let mut values = self.overrides.iter();
        let of_member = self.overrides.iter().find(|(given, _)| *given == full);
        let found = of_member.or_else(|| values.find(|(given, _)| *given == name.base));
        found.map(|(_, value)| self.dag.constant(value.clone()))
    }

    /// The value of a parameter by its formula, in SI units.
    pub fn derived_value(&mut self, member: MemberId, quantity: &'a Quantity) -> Value<'d> {
        let measure = declared_measure(quantity);
        let scope = self.scope(member, &limits::DERIVED);
        let Some(value) = &quantity.value else {
            return Value::Unknown;
        };
        let Some(mut scalar) = self.quantity_value(value, measure.as_ref(), scope) else {
            return Value::Unknown;
        };
        self.convert_to_si(&mut scalar, measure);
        Value::Scalar(scalar)
    }

    /// A parameter that follows from others.
    pub fn derived_parameter(&mut self, member: MemberId) -> Option<DerivedParameter<'d>> {
        if !self.is_derived(member) {
            return None;
        }
        let span = self.span(member);
        let Value::Scalar(scalar) = self.value_of(member, span) else {
            return None;
        };
        self.check_symbol_name(member);
        let quantity = self.quantity(member)?;
        let written = quantity.value.as_ref().map_or(span, |value| value.span);
        self.bound(BoundKind::Derived, scalar.expr, written);
        let measure = declared_measure(quantity)?;
        let unit = scalar.unit.unwrap_or(Unit::ONE);
        Some(DerivedParameter {
            name: self.name(member),
            docs: self.docs(member),
            unit,
            unit_text: self.unit_text(member, unit),
            value: if measure.is_si() {
                scalar.expr
            } else {
                measure.of_si(self.dag) * scalar.expr
            },
            span,
        })
    }

    /// Refuses derivatives by a parameter that follows from others.
    pub fn refuse_derivative_by_derived(&mut self, member: MemberId, written: Span) {
        let name = self.name(member).to_string();
        let message =
            format!("`{name}` follows from other parameters and cannot vary independently");
        let diagnostic = Diagnostic::new(Code::WrongKind, written, message);
        let diagnostic = diagnostic.note(self.span(member), "by this formula");
        self.push(diagnostic.help(
            "name the parameters in its formula: derivatives with respect to them include it by the chain rule",
        ));
    }
}

/// All names in an expression, including those in indices.
fn names_in(expression: &Expression) -> Vec<&str> {
    let mut names = Vec::new();
    let mut open = vec![expression];
    while let Some(expression) = open.pop() {
        match &expression.kind {
            ExpressionKind::Number(_) | ExpressionKind::Text(_) | ExpressionKind::Error => {}
            ExpressionKind::Name(reference) => {
                names.push(reference.base.text.as_str());
                open.extend(reference.index.as_deref());
            }
            ExpressionKind::Sum(terms) => open.extend(terms.iter().map(|term| &term.value)),
            ExpressionKind::Product(factors) => {
                open.extend(factors.iter().map(|factor| &factor.value));
            }
            ExpressionKind::Negative(value) => open.push(value),
            ExpressionKind::Power(base, exponent) => open.extend([&**base, &**exponent]),
            ExpressionKind::Call(call) => open.extend(&call.arguments),
            ExpressionKind::Chain(chain) => {
                open.push(&chain.root);
                let links = chain.links.iter();
                open.extend(links.flat_map(|link| link.arguments.iter().flatten()));
            }
            ExpressionKind::Tuple(components) => open.extend(components),
        }
    }
    names
}
