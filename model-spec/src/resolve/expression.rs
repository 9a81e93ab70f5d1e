//! Evaluates expressions from the syntax tree to values, and checks every unit.
//!
//! An error is reported at the smallest part that is wrong. An expression with a wrong unit only
//! keeps its value, so that further errors are found too; after any other error the value is
//! [`Value::Unknown`], and nothing more is reported about it.

use lagrangian_symbolic::{Expr, Function, Node, Rational, Symbol, Tangent};

use super::Resolver;
use super::items::equals_unit;
use super::names::{Namespace, suggestion, with_help};
use super::value::{Scalar, Scope, Value, Vector, dependence, dimension_text};
use super::work::{Need, State};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{PoseId, Space, stage};
use crate::source::Span;
use crate::syntax::{
    Call, Expression, ExpressionKind, Factor, Ident, Reference, SectionKind, Term,
};
use crate::unit::{Measure, Unit};

/// The largest exponent of a non-constant: nothing in mechanics grows with a higher power, and its
/// code would be a page long.
const LARGEST_EXPONENT: i64 = 64;

/// Functions of vectors, and others that the language has besides [`Function`].
const VECTOR_FUNCTIONS: [&str; 7] = ["dot", "cross", "norm", "direction", "polar", "der", "table"];

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

    /// Reports a unit other than the one required; a bare number takes any unit.
    pub fn require_unit(&mut self, found: Option<Unit>, expected: Unit, span: Span, reason: &str) {
        if let Some(found) = found.filter(|found| !found.fits(expected)) {
            let message = format!(
                "expected {}, found {}",
                unit_text(expected),
                unit_text(found)
            );
            let diagnostic = Diagnostic::new(Code::UnitMismatch, span, message);
            self.push(diagnostic.help(unit_factor_help(reason, found, expected)));
        }
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

    /// The common unit of several parts, reporting each part with another unit: the unit that the
    /// place requires if a part has it, else the most frequent one.
    pub fn common_unit(
        &mut self,
        parts: impl Iterator<Item = (Option<Unit>, Span)>,
        hint: Option<Unit>,
        reason: &str,
    ) -> Option<Unit> {
        let parts: Vec<(Unit, Span)> = parts
            .filter_map(|(unit, span)| Some((unit?, span)))
            .collect();
        let mut counts: Vec<(Unit, usize, Span)> = Vec::new();
        for &(unit, span) in &parts {
            match counts.iter_mut().find(|(other, ..)| *other == unit) {
                Some((_, count, _)) => *count += 1,
                None => counts.push((unit, 1, span)),
            }
        }
        let hinted = counts.iter().find(|(unit, ..)| Some(*unit) == hint);
        // In case of a tie the first; `max_by_key` would take the last.
        let most = || counts.iter().rev().max_by_key(|(_, count, _)| *count);
        let &(unit, _, example) = hinted.or_else(most)?;
        for &(other, span) in &parts {
            if !other.fits(unit) {
                let message = format!("expected {}, found {}", unit_text(unit), unit_text(other));
                let diagnostic = Diagnostic::new(Code::UnitMismatch, span, message);
                let diagnostic = diagnostic.help(unit_factor_help(reason, other, unit));
                self.push(diagnostic.note(example, format!("this is in {}", unit_text(unit))));
            }
        }
        let scaled = parts.iter().any(|(unit, _)| unit.is_scaled());
        Some(unit.as_written(scaled))
    }

    /// Refuses bare numbers beside quantities that are not given in SI units, since their unit is
    /// ambiguous. Zero is zero in any unit.
    pub fn refuse_bare_numbers(
        &mut self,
        parts: impl Iterator<Item = (bool, Span)>,
        unit: Option<Unit>,
    ) {
        let Some(unit) = unit.filter(|unit| unit.is_scaled() && self.remarks.is_none()) else {
            return;
        };
        for (_, span) in parts.filter(|(bare, _)| *bare) {
            let message = "this number needs a unit next to a quantity that is not in SI units";
            let diagnostic = Diagnostic::new(Code::MissingUnit, span, message);
            let unit = unit.to_string();
            let help = match unit.as_str() {
                "1" => "write `2*rad` or `2*deg`, whichever it is".to_owned(),
                unit => format!("write its unit: `2*{unit}`"),
            };
            self.push(diagnostic.help(help));
        }
    }

    /// Warns about a number that looks like degrees where radians are expected, or vice versa.
    pub fn warn_about_degrees(&mut self, bare: &Scalar<'d>, unit: Unit, span: Span) {
        if !unit.is_angle() || self.remarks.is_some() {
            return;
        }
        let exact = bare.expr.as_constant();
        let large = bare.number.is_some_and(|x| x.abs() > std::f64::consts::TAU);
        if !unit.is_scaled() && exact.is_some() && large {
            let number = bare.number.unwrap_or(0.0);
            let message = format!("this is an angle of {number} rad, and looks like degrees");
            let diagnostic = Diagnostic::new(Code::LooksLikeDegrees, span, message);
            let help = format!("write `{number}*deg`, or `{number}*rad` if that is intended");
            self.push(diagnostic.help(help));
        } else if unit.is_scaled() && power_of_pi(bare.expr) != 0 {
            let message = "this looks like an angle in radians, but the unit here is different";
            let diagnostic = Diagnostic::new(Code::LooksLikeDegrees, span, message);
            self.push(diagnostic.help("write the value in that unit, or `…*rad`"));
        }
    }

    /// A unit after a number, `30*deg`, if no declaration has its name.
    fn unit_factor(&mut self, factor: &'a Expression, scope: Scope<'a>) -> Option<Measure> {
        let namespaces = [Namespace::Values, Namespace::FRAMES, Namespace::BODIES];
        unit_of(factor, &|word| {
            let is_index = scope.index.is_some_and(|(variable, _)| variable == word);
            let is_taken = is_index || matches!(word, "t" | "pi" | "ground");
            let is_declared = || {
                let mut found = namespaces.into_iter();
                found.any(|namespace| self.find_group(namespace, word).is_some())
            };
            !(is_taken || self.incomplete || is_declared())
        })
    }

    /// Refuses a bare number that would be a quantity in the unit of its place if a name in it were that of a unit: `5*N` with a
    /// constant `N`, where a force is expected. No unit can tell the two apart, because a bare number takes any.
    pub fn refuse_hidden_unit(
        &mut self,
        expression: &'a Expression,
        found: Option<Unit>,
        expected: Unit,
    ) {
        if found.is_some() || self.remarks.is_some() {
            return;
        }
        let names = hidden_unit(expression, expected);
        // `1500*rpm` with a constant `rpm = 2*pi/60` is the same either way.
        let Some(name) = names
            .into_iter()
            .find(|name| !self.equals_unit_of_same_name(name))
        else {
            return;
        };
        let unit = name.text.as_str();
        let message = format!("`{unit}` is a number declared here, and a unit that fits here too");
        let diagnostic = Diagnostic::new(Code::ReservedName, expression.span, message);
        let help =
            format!("give the number another name, or write `{unit}*…` if it is not the unit");
        self.push(diagnostic.help(help));
    }

    /// Whether a name is declared with the value of the unit of the same name.
    fn equals_unit_of_same_name(&mut self, name: &'a Ident) -> bool {
        let group = self.find_group(Namespace::Values, &name.text);
        let member = group.and_then(|group| self.groups[group].members.get(&None).copied());
        let (Some(member), Some(measure)) = (member, Measure::named(&name.text)) else {
            return false;
        };
        match self.value_of(member, name.span) {
            Value::Scalar(scalar) => equals_unit(scalar.expr, &measure),
            _ => false,
        }
    }

    /// Reports a unit that stands after a declared name instead of a number: the second one in `9.81*m/s^2` if `m` is a mass.
    fn refuse_unit_after_name(&mut self, name: &'a Ident, declared: &str) {
        let message = format!("nothing is named `{}`", name.text);
        let diagnostic = Diagnostic::new(Code::UnknownName, name.span, message);
        self.push(diagnostic.help(format!(
            "`{}` is a unit only after a number or another unit, and `{declared}` is declared here and therefore is not a unit: write only the number, in SI units",
            name.text
        )));
    }

    fn product(&mut self, factors: &'a [Factor], span: Span, scope: Scope<'a>) -> Value<'d> {
        let mut product = Product {
            number: Some(1.0),
            ..Product::default()
        };
        let mut complete = true;
        // Whether there are only numbers and units so far, so that a unit may follow.
        let mut measured = true;
        // The name that ended them, if a unit has the same name.
        let mut hides = None;
        for (place, factor) in factors.iter().enumerate() {
            let measure = if measured && place > 0 {
                self.unit_factor(&factor.value, scope)
            } else {
                None
            };
            if let (Some(declared), Some(name)) = (hides, first_name(&factor.value))
                && measure.is_none()
                && self.unit_factor(&factor.value, scope).is_some()
            {
                if complete {
                    self.refuse_unit_after_name(name, declared);
                }
                complete = false;
                continue;
            }
            if measured && place > 0 && measure.is_none() {
                let name = first_name(&factor.value).map(|name| name.text.as_str());
                hides = name.filter(|name| Measure::named(name).is_some());
            }
            let value = match &measure {
                Some(measure) => Value::Scalar(Scalar {
                    expr: measure.in_si(self.dag),
                    unit: Some(measure.unit),
                    number: Some(measure.to_f64()),
                }),
                None => self.value(&factor.value, scope),
            };
            measured &= measure.is_some() || value.unit().is_none();
            if measure.is_none() {
                product.count_pi(&value, factor.divides);
            }
            complete &= self.multiply(&mut product, value, factor);
        }
        if !complete {
            return Value::Unknown;
        }
        let unit = product.unit.map(|unit| unit.times_pi(product.pi));
        let scalars = product.scalars.iter();
        let scale = self.dag.product(scalars.map(|&(expr, power)| match power {
            1 => expr,
            power => expr.powi(power),
        }));
        match product.vector {
            None => self.finish(scale, unit, product.number, span),
            Some(vector) => {
                let components = vector.components.iter().map(|&c| scale * c).collect();
                self.finish_vector(components, unit, span)
            }
        }
    }

    /// Multiplies or divides a product by the value of a factor; returns false if an error was reported.
    fn multiply(
        &mut self,
        product: &mut Product<'d>,
        value: Value<'d>,
        factor: &'a Factor,
    ) -> bool {
        let divides = factor.divides;
        match value {
            Value::Unknown => false,
            Value::Scalar(scalar) => {
                product.times(&scalar, divides);
                !divides || self.check_divisor(&scalar, factor.value.span)
            }
            Value::Vector(vector) if !divides && product.vector.is_none() => {
                product.times_unit(vector.unit, false);
                product.vector = Some(vector);
                true
            }
            Value::Vector(_) if !divides => {
                let message = "two vectors have no product of this kind";
                let diagnostic = Diagnostic::new(Code::WrongKind, factor.value.span, message);
                self.push(diagnostic.help("write `dot(u, v)` or `cross(u, v)`"));
                false
            }
            other => {
                self.wrong_kind("a number", &other, &factor.value);
                false
            }
        }
    }

    /// Checks that the value may be a divisor.
    fn check_divisor(&mut self, divisor: &Scalar<'d>, span: Span) -> bool {
        let zero = divisor.expr.is_zero() || divisor.number == Some(0.0);
        if zero {
            self.error(
                Code::DivisionByZero,
                span,
                "this is zero, and nothing can be divided by it",
            );
        }
        !zero
    }

    fn power(
        &mut self,
        base: &'a Expression,
        exponent: &'a Expression,
        span: Span,
        scope: Scope<'a>,
    ) -> Value<'d> {
        let value = match self.value(base, scope) {
            Value::Vector(_) => {
                let message = "a vector has no powers";
                let diagnostic = Diagnostic::new(Code::WrongKind, base.span, message);
                self.push(diagnostic.help("the square of its length is `dot(u, u)`"));
                Value::Unknown
            }
            value => value,
        };
        let power = self.scalar_in(exponent, Unit::ONE, "an exponent is a pure number", scope);
        let value = match value {
            Value::Scalar(scalar) => scalar,
            Value::Unknown => return Value::Unknown,
            other => {
                self.wrong_kind("a number", &other, base);
                return Value::Unknown;
            }
        };
        let Some(power) = power else {
            return Value::Unknown;
        };
        let unit = self.unit_of_power(&value, &power, base.span, exponent.span);
        let large = |power: f64| power.abs() > LARGEST_EXPONENT as f64;
        if value.number.is_none() && power.number.is_some_and(large) {
            let message = format!("exponents go up to {LARGEST_EXPONENT}");
            self.error(Code::NumberOutOfRange, exponent.span, message);
            return Value::Unknown;
        }
        let number = value.number.zip(power.number).map(|(x, n)| x.powf(n));
        if power.number.is_some_and(|power| power < 0.0) && !self.check_divisor(&value, base.span) {
            return Value::Unknown;
        }
        if number.is_some_and(f64::is_nan) {
            let message = "a negative number has only integer powers";
            self.error(Code::OutsideDomain, span, message);
            return Value::Unknown;
        }
        self.finish(value.expr.pow(power.expr), unit, number, span)
    }

    fn unit_of_power(
        &mut self,
        base: &Scalar<'d>,
        power: &Scalar<'d>,
        base_span: Span,
        power_span: Span,
    ) -> Option<Unit> {
        let Some(unit) = base.unit else {
            // A bare number to a power that is a quantity of the machine is a pure number, not a bare one.
            return power.unit;
        };
        if unit.is_one() {
            return Some(Unit::ONE);
        }
        let exponent = power.expr.as_constant();
        let parts = exponent.and_then(|value| Some((value.numerator()?, value.denominator()?)));
        let found = parts.and_then(|(numerator, denominator)| unit.power(numerator, denominator));
        if found.is_none() {
            let diagnostic = match parts {
                Some(_) => {
                    let message = format!("this power of {} is not a unit", unit_text(unit));
                    Diagnostic::new(Code::UnitOfPower, power_span, message)
                        .help("a quantity can be raised only to an integer or half-integer power")
                }
                None => {
                    let message = format!(
                        "expected a pure number, found {}: the exponent is not constant",
                        unit_text(unit)
                    );
                    Diagnostic::new(Code::UnitOfPower, base_span, message)
                        .help("divide by a reference value of the same unit")
                }
            };
            self.push(diagnostic);
        }
        found
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

    fn call(&mut self, call: &'a Call, span: Span, scope: Scope<'a>) -> Value<'d> {
        let arguments = &call.arguments;
        let word = call.function.text.as_str();
        if word == "table" {
            return self.table(arguments, span, scope);
        }
        // The algebra calls the operator `^` `pow`.
        let scalar_function = Function::ALL
            .into_iter()
            .find(|function| *function != Function::Pow && function.name() == word);
        let arity = match (word, scalar_function) {
            (_, Some(function)) => function.arity(),
            ("dot" | "cross" | "polar", _) => 2,
            ("norm" | "direction" | "der", _) => 1,
            _ => {
                self.unknown_function(&call.function);
                for argument in arguments {
                    self.value(argument, scope);
                }
                return Value::Unknown;
            }
        };
        if arguments.len() != arity {
            let many = if arity == 1 {
                "one argument"
            } else {
                "two arguments"
            };
            let message = format!("`{word}` takes {many}, found {}", arguments.len());
            self.error(Code::WrongArguments, span, message);
            for argument in arguments {
                self.value(argument, scope);
            }
            return Value::Unknown;
        }
        match (scalar_function, word, arguments.as_slice()) {
            (Some(function), _, [x]) => self.function_of_one(function, x, span, scope),
            (Some(function), _, [x, y]) => self.function_of_two(function, x, y, span, scope),
            (_, "der", [x]) => self.derivative(x, span, scope),
            (_, "norm", [u]) => self.norm(u, span, scope),
            (_, "dot" | "cross", [u, v]) => self.vector_product(word, u, v, span, scope),
            (_, "direction" | "polar", [.., angle]) => {
                let radius = arguments.split_last().and_then(|(_, rest)| rest.first());
                self.polar(word, radius, angle, span, scope)
            }
            _ => Value::Unknown, // every function above has one or two arguments
        }
    }

    fn unknown_function(&mut self, name: &'a Ident) {
        if self.find_group(Namespace::Values, &name.text).is_some() {
            let message = format!("`{}` is not a function", name.text);
            let diagnostic = Diagnostic::new(Code::UnknownFunction, name.span, message);
            let help = format!("a product is written with a star: `{}*(…)`", name.text);
            return self.push(diagnostic.help(help));
        }
        let known = Function::ALL.into_iter().map(Function::name);
        let known = known
            .filter(|name| *name != Function::Pow.name())
            .chain(VECTOR_FUNCTIONS);
        let help = match name.text.as_str() {
            "pow" => Some("a power is written `x^n`".to_owned()),
            "diff" | "dot_t" | "ddt" => Some("the time derivative is `der(x)`".to_owned()),
            "turn" | "shift" | "point" => Some(format!(
                "this is an operation on a frame: `ground.{}(…)`",
                name.text
            )),
            word => suggestion(word, known),
        };
        let message = format!("there is no function `{}`", name.text);
        self.push(with_help(
            Diagnostic::new(Code::UnknownFunction, name.span, message),
            help,
        ));
    }

    fn function_of_one(
        &mut self,
        function: Function,
        argument: &'a Expression,
        span: Span,
        scope: Scope<'a>,
    ) -> Value<'d> {
        let Some(x) = self.scalar(argument, scope) else {
            return Value::Unknown;
        };
        let unit = match function {
            Function::Abs => x.unit,
            Function::Sign => x.unit.map(|_| Unit::ONE),
            Function::Sqrt => self.unit_of_root(x.unit, argument.span),
            Function::Sin | Function::Cos | Function::Tan => {
                self.require_dimensionless(x.unit, "an angle in rad", argument.span);
                if x.unit.is_none() {
                    self.warn_about_degrees(&x, Unit::RADIAN, argument.span);
                }
                x.unit.map(|_| Unit::ONE)
            }
            _ => {
                self.require_dimensionless(x.unit, "a pure number", argument.span);
                x.unit.map(|_| Unit::ONE)
            }
        };
        let number = x.number.map(|x| value_of_one(function, x));
        if number.is_some_and(f64::is_nan) || number == Some(f64::NEG_INFINITY) {
            let message = format!(
                "`{}` has no value at {}",
                function.name(),
                x.number.unwrap_or(f64::NAN)
            );
            self.error(Code::OutsideDomain, argument.span, message);
            return Value::Unknown;
        }
        let expr = self.dag.function(function, &[x.expr]);
        self.finish(expr, unit, number, span)
    }

    fn unit_of_root(&mut self, unit: Option<Unit>, span: Span) -> Option<Unit> {
        let unit = unit?;
        let root = unit.power(1, 2);
        if root.is_none() {
            let message = format!("the root of {} is not a unit", unit_text(unit));
            self.error(Code::UnitOfPower, span, message);
        }
        root
    }

    fn require_dimensionless(&mut self, unit: Option<Unit>, expected: &str, span: Span) {
        if let Some(unit) = unit.filter(|unit| !unit.is_one()) {
            let message = format!("expected {expected}, found {}", unit_text(unit));
            let diagnostic = Diagnostic::new(Code::UnitMismatch, span, message);
            self.push(with_help(diagnostic, cycles_help(unit, Unit::ONE)));
        }
    }

    fn function_of_two(
        &mut self,
        function: Function,
        first: &'a Expression,
        second: &'a Expression,
        span: Span,
        scope: Scope<'a>,
    ) -> Value<'d> {
        let (x, y) = (self.scalar(first, scope), self.scalar(second, scope));
        let (Some(x), Some(y)) = (x, y) else {
            return Value::Unknown;
        };
        let reason = format!(
            "both arguments of `{}` must have the same unit",
            function.name()
        );
        let parts = [(x.unit, first.span), (y.unit, second.span)];
        let common = self.common_unit(parts.into_iter(), None, &reason);
        let parts = [(x.is_bare(), first.span), (y.is_bare(), second.span)];
        self.refuse_bare_numbers(parts.into_iter(), common);
        let unit = match function {
            Function::Atan2 => common.map(|_| Unit::RADIAN),
            _ => common,
        };
        let number = x.number.zip(y.number).map(|(x, y)| match function {
            Function::Min => x.min(y),
            Function::Max => x.max(y),
            _ => x.atan2(y),
        });
        if function == Function::Atan2 && x.expr.is_zero() && y.expr.is_zero() {
            self.error(Code::OutsideDomain, span, "`atan2` has no value at (0, 0)");
            return Value::Unknown;
        }
        let expr = self.dag.function(function, &[x.expr, y.expr]);
        self.finish(expr, unit, number, span)
    }

    /// The total time derivative of a number or a vector.
    fn derivative(&mut self, argument: &'a Expression, span: Span, scope: Scope<'a>) -> Value<'d> {
        // An argument that is not allowed here by itself may be allowed inside `der`, and vice
        // versa: the derivative decides.
        let value = self.value(
            argument,
            scope.with_limit(&super::value::limits::DEFINITION),
        );
        let found = value.stage();
        if found >= stage::INPUT {
            let of = dependence(found);
            let message = format!("the time derivative of {of} is not known");
            let help = if found == stage::INPUT {
                "an input is an arbitrary function of time"
            } else {
                "the equations of motion give accelerations, but not their derivatives"
            };
            let diagnostic = Diagnostic::new(Code::CannotDifferentiate, argument.span, message);
            self.push(diagnostic.help(help));
            return Value::Unknown;
        }
        let derivative = match value {
            Value::Scalar(scalar) => {
                let Some(rate) = self.rate(scalar.expr, span) else {
                    return Value::Unknown;
                };
                let unit = Some(scalar.unit.unwrap_or(Unit::ONE).rate());
                self.finish(rate, unit, None, span)
            }
            Value::Vector(vector) => {
                let rates = vector.components.iter().map(|&c| self.rate(c, span));
                let Some(rates) = rates.collect::<Option<Vec<_>>>() else {
                    return Value::Unknown;
                };
                let unit = Some(vector.unit.unwrap_or(Unit::ONE).rate());
                self.finish_vector(rates, unit, span)
            }
            Value::Unknown => return Value::Unknown,
            other => {
                self.wrong_kind("a number or a vector", &other, argument);
                return Value::Unknown;
            }
        };
        self.check_stage(derivative, span, scope)
    }

    /// The total time derivative: q ↦ q̇, q̇ ↦ q̈, t ↦ 1.
    pub fn rate(&mut self, expr: Expr<'d>, span: Span) -> Option<Expr<'d>> {
        if self.tangent.is_none() {
            self.tangent = Some(Tangent::new(self.dag, &self.rates(span)?));
        }
        let rate = self.tangent.as_mut()?.of(expr);
        self.step(span).then_some(rate)
    }

    /// The rates of all symbols, once the coordinates are known.
    fn rates(&mut self, span: Span) -> Option<Vec<(Symbol, Expr<'d>)>> {
        let is_coordinate = |&group: &usize| {
            let declarations = &self.groups[group].declarations;
            let section = |&declaration: &usize| self.declarations[declaration].section;
            declarations
                .iter()
                .map(section)
                .any(|s| matches!(s, SectionKind::Coordinates | SectionKind::States))
        };
        let groups: Vec<usize> = (0..self.groups.len()).filter(is_coordinate).collect();
        let mut rates = vec![(self.time.as_symbol()?, self.dag.one())];
        let mut complete = true;
        for group in groups {
            if self.groups[group].state != State::Done {
                self.need(Need::Group(group), span);
                complete = false;
                continue;
            }
            for &member in self.groups[group].members.values() {
                let section = self.declaration(member).section;
                if !matches!(section, SectionKind::Coordinates | SectionKind::States) {
                    continue;
                }
                if let Some([q, v, a]) = self.members[member].symbols {
                    rates.push((q.as_symbol()?, v));
                    rates.push((v.as_symbol()?, a));
                }
            }
        }
        for guide in &self.guides {
            for [q, v, a] in guide.displacement.iter().copied() {
                rates.push((q.as_symbol()?, v));
                rates.push((v.as_symbol()?, a));
            }
        }
        complete.then_some(rates)
    }

    fn norm(&mut self, argument: &'a Expression, span: Span, scope: Scope<'a>) -> Value<'d> {
        let Some(u) = self.vector(argument, "a vector", scope) else {
            return Value::Unknown;
        };
        let length = self.length(&u.components);
        self.finish(length, u.unit, None, span)
    }

    /// √(u·u).
    pub fn length(&self, u: &[Expr<'d>]) -> Expr<'d> {
        self.dag.sum(u.iter().map(|c| c.square())).sqrt()
    }

    fn vector_product(
        &mut self,
        word: &str,
        first: &'a Expression,
        second: &'a Expression,
        span: Span,
        scope: Scope<'a>,
    ) -> Value<'d> {
        let u = self.vector(first, "a vector", scope);
        let v = self.vector(second, "a vector", scope);
        let (Some(u), Some(v)) = (u, v) else {
            return Value::Unknown;
        };
        let unit = match (u.unit, v.unit) {
            (None, None) => None,
            (u, v) => Some(u.unwrap_or(Unit::ONE).times(v.unwrap_or(Unit::ONE))),
        };
        let determinant = |i: usize, j: usize| {
            let (u, v) = (&u.components, &v.components);
            u[i] * v[j] - u[j] * v[i]
        };
        match (word, self.space) {
            ("dot", _) => {
                let pairs = u.components.iter().zip(&v.components);
                self.finish(self.dag.sum(pairs.map(|(&u, &v)| u * v)), unit, None, span)
            }
            (_, Space::Plane) => self.finish(determinant(0, 1), unit, None, span),
            (_, Space::Space) => {
                let components = vec![determinant(1, 2), determinant(2, 0), determinant(0, 1)];
                self.finish_vector(components, unit, span)
            }
        }
    }

    /// `direction(angle)`, and `polar(r, angle)`, which is r times that.
    fn polar(
        &mut self,
        word: &str,
        radius: Option<&'a Expression>,
        angle: &'a Expression,
        span: Span,
        scope: Scope<'a>,
    ) -> Value<'d> {
        let radius = radius.map(|radius| self.scalar(radius, scope));
        let reason = "an angle is in rad, or a pure number";
        let angle = self.scalar_in(angle, Unit::RADIAN, reason, scope);
        if self.space == Space::Space {
            let message = format!("`{word}` exists only in the plane");
            let diagnostic = Diagnostic::new(Code::WrongSpace, span, message);
            self.push(diagnostic.help("in space, write the components: `(r*cos(a), r*sin(a), 0)`"));
            return Value::Unknown;
        }
        let Some(angle) = angle else {
            return Value::Unknown;
        };
        let direction = [angle.expr.cos(), angle.expr.sin()];
        match radius {
            None => {
                let unit = angle.unit.map(|_| Unit::ONE);
                self.finish_vector(direction.to_vec(), unit, span)
            }
            Some(None) => Value::Unknown,
            Some(Some(r)) => {
                // A bare radius takes any unit, like a length in a sum.
                let unit = r.unit;
                let components = direction.iter().map(|&c| r.expr * c).collect();
                self.finish_vector(components, unit, span)
            }
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

/// An expression of names of units, `m/s^2`, as a unit; `is_free` tells whether a name may be that of a unit.
fn unit_of(factor: &Expression, is_free: &dyn Fn(&str) -> bool) -> Option<Measure> {
    match &factor.kind {
        ExpressionKind::Name(reference) if reference.index.is_none() => {
            let word = reference.base.text.as_str();
            is_free(word).then(|| Measure::named(word)).flatten()
        }
        ExpressionKind::Power(base, exponent) => {
            let (sign, exponent) = match &exponent.kind {
                ExpressionKind::Negative(inner) => (-1, &inner.kind),
                other => (1, other),
            };
            let ExpressionKind::Number(power) = exponent else {
                return None;
            };
            let power = power.parse::<i32>().ok().filter(|power| *power <= 12)?;
            unit_of(base, is_free)?.power(sign * power)
        }
        ExpressionKind::Product(factors) => {
            factors.iter().try_fold(Measure::ONE, |product, factor| {
                let next = unit_of(&factor.value, is_free)?;
                product.times(&if factor.divides {
                    next.power(-1)?
                } else {
                    next
                })
            })
        }
        _ => None,
    }
}

/// The names in a bare number that are those of units, if the number would be in `expected` by these units. All names in a bare
/// number are declared.
fn hidden_unit(expression: &Expression, expected: Unit) -> Vec<&Ident> {
    match &expression.kind {
        ExpressionKind::Negative(inner) => hidden_unit(inner, expected),
        ExpressionKind::Sum(terms) => {
            let parts = terms.iter().map(|term| &term.value);
            parts.flat_map(|part| hidden_unit(part, expected)).collect()
        }
        ExpressionKind::Tuple(parts) => {
            let parts = parts.iter();
            parts.flat_map(|part| hidden_unit(part, expected)).collect()
        }
        ExpressionKind::Product(factors) => {
            let is_number = |factor: &Factor| match &factor.value.kind {
                ExpressionKind::Number(_) => true,
                ExpressionKind::Name(name) => name.base.text == "pi",
                _ => false,
            };
            let numbers = factors.iter().take_while(|factor| is_number(factor));
            let (numbers, units) = factors.split_at(numbers.count());
            let mut measure = (!numbers.is_empty()).then_some(Measure::ONE);
            for factor in units {
                let next = unit_of(&factor.value, &|_| true);
                let power = if factor.divides { -1 } else { 1 };
                let next = next.and_then(|next| next.power(power));
                measure = measure
                    .zip(next)
                    .and_then(|(so_far, next)| so_far.times(&next));
            }
            let fits = |measure: Measure| !measure.unit.is_one() && measure.unit.fits(expected);
            if !measure.is_some_and(fits) {
                return Vec::new();
            }
            units
                .iter()
                .flat_map(|factor| names_of(&factor.value))
                .collect()
        }
        _ => Vec::new(),
    }
}

/// The names in a unit.
fn names_of(unit: &Expression) -> Vec<&Ident> {
    match &unit.kind {
        ExpressionKind::Name(reference) => vec![&reference.base],
        ExpressionKind::Power(base, _) => names_of(base),
        ExpressionKind::Product(factors) => {
            let factors = factors.iter();
            factors.flat_map(|factor| names_of(&factor.value)).collect()
        }
        _ => Vec::new(),
    }
}

/// The first name of a possible unit: `s` of `s^2`.
fn first_name(factor: &Expression) -> Option<&Ident> {
    match &factor.kind {
        ExpressionKind::Name(reference) if reference.index.is_none() => Some(&reference.base),
        ExpressionKind::Power(base, _) => first_name(base),
        ExpressionKind::Product(factors) => first_name(&factors.first()?.value),
        _ => None,
    }
}

/// A product, as far as it has been evaluated.
#[derive(Default)]
struct Product<'d> {
    /// None while all factors are bare numbers.
    unit: Option<Unit>,
    /// The number of factors π that belong to an angle.
    pi: i32,
    number: Option<f64>,
    /// Factors with their powers.
    scalars: Vec<(Expr<'d>, i32)>,
    vector: Option<Vector<'d>>,
}

impl<'d> Product<'d> {
    fn times(&mut self, scalar: &Scalar<'d>, divides: bool) {
        self.number = self.number.zip(scalar.number).map(|(product, value)| {
            if divides {
                product / value
            } else {
                product * value
            }
        });
        self.scalars
            .push((scalar.expr, if divides { -1 } else { 1 }));
        self.times_unit(scalar.unit, divides);
    }

    fn times_unit(&mut self, unit: Option<Unit>, divides: bool) {
        let Some(unit) = unit else { return };
        let so_far = self.unit.unwrap_or(Unit::ONE);
        self.unit = Some(if divides {
            so_far.over(unit)
        } else {
            so_far.times(unit)
        });
    }

    /// Counts π in a factor that is a constant without a unit.
    fn count_pi(&mut self, value: &Value<'d>, divides: bool) {
        let Value::Scalar(scalar) = value else { return };
        let is_pure = scalar
            .unit
            .is_none_or(|unit| unit.is_one() && !unit.is_angle());
        if is_pure && scalar.expr.stage() == stage::CONSTANT {
            let power = power_of_pi(scalar.expr);
            self.pi += if divides { -power } else { power };
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

/// The power of π in a constant.
fn power_of_pi(constant: Expr<'_>) -> i32 {
    let dag = constant.dag();
    let product = match constant.node() {
        Node::Sum(terms) if terms.len() == 1 => dag.expr(terms[0].0),
        _ => constant,
    };
    let pi = dag.pi();
    match product.node() {
        _ if product == pi => 1,
        Node::Product(factors) => {
            let mut powers = factors.iter();
            let found = powers.find(|(id, _)| dag.expr(*id) == pi);
            found.map_or(0, |(_, power)| *power)
        }
        _ => 0,
    }
}

/// The help for cycles where radians are expected, or vice versa.
fn cycles_help(found: Unit, expected: Unit) -> Option<String> {
    let help = match found.cycles_beyond(expected)? {
        1.. => {
            "a hertz is a cycle per second: multiply by `2*pi` for radians; a rate of anything \
             else is in `1/s`"
        }
        _ => "a hertz is a cycle per second: divide radians by `2*pi`",
    };
    Some(help.to_owned())
}

/// A help line, with a hint about the most common cause of a missing unit.
fn unit_factor_help(reason: &str, found: Unit, expected: Unit) -> String {
    if let Some(help) = cycles_help(found, expected) {
        return help;
    }
    if found.to_string() == "1" {
        format!(
            "{reason}; a bare number as a factor has no unit: declare it, `constants {{ l: m = 2 }}`"
        )
    } else {
        reason.to_owned()
    }
}

/// A unit in the words of a message.
pub(crate) fn unit_text(unit: Unit) -> String {
    match unit.to_string() {
        one if one == "1" => "a pure number".to_owned(),
        text => text,
    }
}

/// A reference in a message: `x` or `q[…]`.
fn shown_reference(reference: &Reference) -> String {
    match reference.index {
        Some(_) => format!("{}[…]", reference.base.text),
        None => reference.base.text.clone(),
    }
}

/// An approximate value of a function; only for checks.
fn value_of_one(function: Function, x: f64) -> f64 {
    match function {
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
        Function::Atan => x.atan(),
        Function::Sinh => x.sinh(),
        Function::Cosh => x.cosh(),
        Function::Tanh => x.tanh(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
        Function::Sqrt => x.sqrt(),
        Function::Abs => x.abs(),
        _ => x.signum(),
    }
}
