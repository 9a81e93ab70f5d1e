//! Evaluates expressions from the syntax tree to values, and checks every unit.
//!
//! An error is reported at the smallest part that is wrong. An expression with a wrong unit only
//! keeps its value, so that further errors are found too; after any other error the value is
//! [`Value::Unknown`], and nothing more is reported about it.

mod calls;
mod product;
mod units;

use lagrangian_symbolic::{Expr, Rational};

use super::Resolver;
use super::names::{Namespace, with_help};
use super::value::{Scalar, Scope, Value, Vector, dependence, dimension_text};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{PoseId, Space};
use crate::source::Span;
use crate::syntax::{Expression, ExpressionKind, Reference, Term};
use crate::unit::Unit;
pub(crate) use units::{HiddenUnit, unit_text};

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// The value of an expression.
    pub fn value(&mut self, expression: &'a Expression, scope: Scope<'a>) -> Value<'d> {
        if !self.step(expression.span) {
            return Value::Unknown;
        }
        let span = expression.span;
        match &expression.kind {
            ExpressionKind::Number(text) => self.number(text, span),
            ExpressionKind::Name(reference) => self.name_value(reference, span, scope),
            ExpressionKind::Sum(terms) => self.sum(terms, scope),
            ExpressionKind::Product(factors) => {
                self.product(factors, span, scope.with_expected_unit(None))
            }
            ExpressionKind::Negative(inner) => self.negative(inner, scope),
            ExpressionKind::Power(base, exponent) => {
                self.power(base, exponent, span, scope.with_expected_unit(None))
            }
            ExpressionKind::Call(call) => self.call(call, span, scope.with_expected_unit(None)),
            ExpressionKind::Chain(chain) => self.chain(chain, span, scope.with_expected_unit(None)),
            ExpressionKind::Tuple(components) => self.tuple(components, span, scope),
            ExpressionKind::Text(_) => {
                let message = "a file name is allowed only in `table(\"…\", x)`";
                self.error(Code::WrongKind, span, message);
                Value::Unknown
            }
            ExpressionKind::Error => Value::Unknown,
        }
    }

    /// A number, or an error that says what was found instead.
    pub fn scalar(&mut self, expression: &'a Expression, scope: Scope<'a>) -> Option<Scalar<'d>> {
        match self.value(expression, scope) {
            Value::Scalar(scalar) => Some(scalar),
            Value::Unknown => None,
            other => {
                self.wrong_kind("a number", &other, expression);
                None
            }
        }
    }

    /// A vector or a point, or an error that says what was found instead.
    pub fn vector(
        &mut self,
        expression: &'a Expression,
        noun: &str,
        scope: Scope<'a>,
    ) -> Option<Vector<'d>> {
        match self.value(expression, scope) {
            Value::Vector(vector) => Some(vector),
            Value::Unknown => None,
            other => {
                self.wrong_kind(noun, &other, expression);
                None
            }
        }
    }

    /// A number in a unit.
    pub fn scalar_in(
        &mut self,
        expression: &'a Expression,
        unit: Unit,
        reason: &str,
        scope: Scope<'a>,
    ) -> Option<Scalar<'d>> {
        let scalar = self.scalar(expression, scope.with_expected_unit(unit))?;
        self.require_unit(scalar.unit, unit, expression.span, reason);
        self.refuse_hidden_unit(expression, scalar.unit, unit);
        if scalar.unit.is_none() {
            self.warn_about_degrees(&scalar, unit, expression.span);
        }
        Some(scalar)
    }

    /// A vector or a point in a unit.
    pub fn vector_in(
        &mut self,
        expression: &'a Expression,
        noun: &str,
        unit: Unit,
        reason: &str,
        scope: Scope<'a>,
    ) -> Option<Vector<'d>> {
        let vector = self.vector(expression, noun, scope.with_expected_unit(unit))?;
        self.require_unit(vector.unit, unit, expression.span, reason);
        self.refuse_hidden_unit(expression, vector.unit, unit);
        Some(vector)
    }

    /// Reports a kind of value that is not allowed in this place.
    pub fn wrong_kind(&mut self, expected: &str, found: &Value<'d>, at: &'a Expression) {
        let message = format!("{expected} is expected here, found {}", found.kind());
        let name = match &at.kind {
            ExpressionKind::Name(reference) => shown_reference(reference),
            _ => "…".to_owned(),
        };
        let help = match found {
            Value::Frame(_) => Some(format!("its origin is the point `{name}.origin`")),
            Value::Body(_) => Some(format!("its mass centre is the point `{name}.at`")),
            Value::Vector(_) if expected == "a number" => Some(
                "`norm(u)` is the length of a vector, `dot(u, v)` its part along another".into(),
            ),
            Value::Scalar(_) if expected == "a vector" || expected == "a point" => {
                let written = match self.space {
                    Space::Plane => "`(a, b)`",
                    Space::Space => "`(a, b, c)`",
                };
                Some(format!(
                    "a vector is written {written}, in the ground frame"
                ))
            }
            _ => None,
        };
        self.push(with_help(
            Diagnostic::new(Code::WrongKind, at.span, message),
            help,
        ));
    }

    /// A finished number, or an error if it has no value.
    pub(super) fn finish(
        &mut self,
        expr: Expr<'d>,
        unit: Option<Unit>,
        number: Option<f64>,
        span: Span,
    ) -> Value<'d> {
        let exact = expr.as_constant();
        let number = exact.as_ref().map(Rational::to_f64).or(number);
        let lost = number == Some(0.0) && exact.as_ref().is_some_and(|exact| !exact.is_zero());
        if expr.is_undefined() || lost || number.is_some_and(|number| !number.is_finite()) {
            let message = "this number is beyond what a floating-point number can hold";
            self.error(Code::NumberOutOfRange, span, message);
            return Value::Unknown;
        }
        Value::Scalar(Scalar { expr, unit, number })
    }

    /// A finished vector, or an error if a component has no value.
    fn finish_vector(
        &mut self,
        components: Vec<Expr<'d>>,
        unit: Option<Unit>,
        span: Span,
    ) -> Value<'d> {
        for &component in &components {
            if self.finish(component, unit, None, span).is_unknown() {
                return Value::Unknown;
            }
        }
        Value::Vector(Vector::new(components, unit))
    }

    /// The value, if its place admits its dependencies.
    pub fn check_stage(&mut self, value: Value<'d>, span: Span, scope: Scope<'a>) -> Value<'d> {
        let (found, limit) = (value.stage(), scope.limit);
        if found <= limit.stage {
            return value;
        }
        let message = format!("{} cannot depend on {}", limit.subject, dependence(found));
        let diagnostic = Diagnostic::new(limit.code, span, message);
        self.push(diagnostic.help(limit.help));
        Value::Unknown
    }

    fn number(&mut self, text: &str, span: Span) -> Value<'d> {
        match Rational::parse_decimal(text) {
            Some(value) => self.finish(self.dag.constant(value), None, None, span),
            None => Value::Unknown, // the lexer has reported the malformed number
        }
    }

    fn name_value(&mut self, reference: &'a Reference, span: Span, scope: Scope<'a>) -> Value<'d> {
        let name = &reference.base;
        let word = name.text.as_str();
        let known = match scope.index {
            Some((variable, index)) if variable == word => {
                Some(Value::Scalar(self.bare_number(Rational::from(index))))
            }
            _ if word == "t" => Some(Value::Scalar(Scalar {
                expr: self.time,
                unit: Some(Unit::SECOND),
                number: None,
            })),
            _ if word == "pi" => Some(Value::Scalar(Scalar {
                expr: self.dag.pi(),
                unit: None,
                number: Some(std::f64::consts::PI),
            })),
            _ => None,
        };
        if let Some(value) = known {
            if let Some(index) = &reference.index {
                self.not_a_family(name, index.span);
                return Value::Unknown;
            }
            return self.check_stage(value, span, scope);
        }
        let group = [Namespace::Values, Namespace::FRAMES, Namespace::BODIES]
            .into_iter()
            .find_map(|namespace| self.find_group(namespace, word));
        match group {
            Some(group) => {
                let index = reference.index.as_deref();
                let Some(member) = self.member(group, name, index, scope) else {
                    return Value::Unknown;
                };
                let value = match self.groups[group].namespace {
                    Namespace::BODIES => Value::Body(member),
                    _ => self.value_of(member, span),
                };
                self.check_stage(value, span, scope)
            }
            None if word == "ground" => Value::Frame(PoseId::GROUND),
            None => {
                self.unknown_name("nothing is", name, &[Namespace::Values]);
                Value::Unknown
            }
        }
    }

    /// A bare number.
    pub fn bare_number(&self, value: Rational) -> Scalar<'d> {
        let number = Some(value.to_f64());
        Scalar {
            expr: self.dag.constant(value),
            unit: None,
            number,
        }
    }

    fn negative(&mut self, inner: &'a Expression, scope: Scope<'a>) -> Value<'d> {
        match self.value(inner, scope) {
            Value::Unknown => Value::Unknown,
            Value::Scalar(scalar) => Value::Scalar(Scalar {
                expr: -scalar.expr,
                unit: scalar.unit,
                number: scalar.number.map(|number| -number),
            }),
            Value::Vector(vector) => {
                let components = vector.components.iter().map(|&c| -c).collect();
                Value::Vector(Vector::new(components, vector.unit))
            }
            other => {
                self.wrong_kind("a number", &other, inner);
                Value::Unknown
            }
        }
    }

    fn sum(&mut self, terms: &'a [Term], scope: Scope<'a>) -> Value<'d> {
        let mut values: Vec<(Value<'d>, &'a Term)> = Vec::with_capacity(terms.len());
        for term in terms {
            values.push((self.value(&term.value, scope), term));
        }
        let vectors = self.kind_of_sum(&values);
        let unit = self.common_unit(
            values
                .iter()
                .map(|(value, term)| (value.unit(), term.value.span)),
            scope.expected_unit,
            "terms that are added or subtracted must have the same unit",
        );
        let parts = values.iter();
        self.refuse_bare_numbers(
            parts.map(|(value, term)| (value.is_bare(), term.value.span)),
            unit,
        );
        if let Some(unit) = unit {
            for (value, term) in &values {
                if !value.is_unknown() {
                    self.refuse_hidden_unit(&term.value, value.unit(), unit);
                }
            }
        }
        let (Some((_, first)), Some((_, last)), Some(vectors)) =
            (values.first(), values.last(), vectors)
        else {
            return Value::Unknown;
        };
        let span = first.value.span.to(last.value.span);
        let sign = |term: &Term, expr: Expr<'d>| if term.negative { -expr } else { expr };
        if vectors {
            let component = |k: usize| {
                self.dag
                    .sum(values.iter().filter_map(|(value, term)| match value {
                        Value::Vector(vector) => Some(sign(term, *vector.components.get(k)?)),
                        _ => None,
                    }))
            };
            let components = (0..self.space.dimension()).map(component).collect();
            return self.finish_vector(components, unit, span);
        }
        let scalars = || {
            values.iter().filter_map(|(value, term)| match value {
                Value::Scalar(scalar) => Some((scalar, *term)),
                _ => None,
            })
        };
        let expr = self
            .dag
            .sum(scalars().map(|(scalar, term)| sign(term, scalar.expr)));
        let number = scalars()
            .map(|(scalar, term)| {
                let number = scalar.number?;
                Some(if term.negative { -number } else { number })
            })
            .sum();
        self.finish(expr, unit, number, span)
    }

    /// Whether a sum is one of vectors, according to the first term that is known; nothing if a term is
    /// unknown, or of another kind, which is reported.
    fn kind_of_sum(&mut self, values: &[(Value<'d>, &'a Term)]) -> Option<bool> {
        let mut complete = true;
        let mut vectors = None;
        for (value, term) in values {
            let is_vector = match value {
                Value::Scalar(_) => Some(false),
                Value::Vector(_) => Some(true),
                Value::Unknown | Value::Frame(_) | Value::Body(_) => None,
            };
            let is_alike = is_vector.is_some() && vectors.is_none_or(|all| Some(all) == is_vector);
            if !is_alike && !value.is_unknown() {
                let expected = match vectors {
                    Some(true) => "a vector",
                    _ => "a number",
                };
                self.wrong_kind(expected, value, &term.value);
            }
            complete &= is_alike;
            vectors = vectors.or(is_vector);
        }
        vectors.filter(|_| complete)
    }

    fn tuple(&mut self, components: &'a [Expression], span: Span, scope: Scope<'a>) -> Value<'d> {
        if components.len() != self.space.dimension() {
            let expected = dimension_text(self.space);
            let message = format!("a vector has {expected}, found {}", components.len());
            self.error(Code::WrongDimension, span, message);
            for component in components {
                self.scalar(component, scope);
            }
            return Value::Unknown;
        }
        let values: Vec<Option<Scalar<'d>>> = components
            .iter()
            .map(|component| self.scalar(component, scope))
            .collect();
        let parts = values.iter().zip(components);
        let unit = self.common_unit(
            parts.map(|(value, part)| (value.and_then(|value| value.unit), part.span)),
            scope.expected_unit,
            "the components of a vector must have the same unit",
        );
        let parts = values.iter().zip(components);
        let is_bare = |value: &Option<Scalar<'d>>| value.is_some_and(|value| value.is_bare());
        self.refuse_bare_numbers(parts.map(|(value, part)| (is_bare(value), part.span)), unit);
        if let Some(unit) = unit {
            for (value, part) in values.iter().zip(components) {
                if let Some(value) = value {
                    self.refuse_hidden_unit(part, value.unit, unit);
                }
            }
        }
        let components: Option<Vec<Expr<'d>>> =
            values.iter().map(|value| Some((*value)?.expr)).collect();
        match components {
            Some(components) => Value::Vector(Vector::new(components, unit)),
            None => Value::Unknown,
        }
    }
}

impl Value<'_> {
    /// Its unit, if it has one that is known.
    fn unit(&self) -> Option<Unit> {
        match self {
            Value::Scalar(scalar) => scalar.unit,
            Value::Vector(vector) => vector.unit,
            _ => None,
        }
    }
}

impl Scalar<'_> {
    /// Whether it is a number without a unit, and not 0.
    pub fn is_bare(&self) -> bool {
        self.unit.is_none() && !self.expr.is_zero()
    }
}

impl Value<'_> {
    /// Whether it is a number or a vector without a unit, and not 0.
    fn is_bare(&self) -> bool {
        match self {
            Value::Scalar(scalar) => scalar.is_bare(),
            Value::Vector(vector) => {
                vector.unit.is_none() && vector.components.iter().any(|c| !c.is_zero())
            }
            _ => false,
        }
    }
}

/// A reference in a message: `x` or `q[…]`.
fn shown_reference(reference: &Reference) -> String {
    match reference.index {
        Some(_) => format!("{}[…]", reference.base.text),
        None => reference.base.text.clone(),
    }
}
