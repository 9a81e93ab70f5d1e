//! Products, quotients and powers.

use super::units::{first_name, power_of_pi};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::stage;
use crate::resolve::Resolver;
use crate::resolve::value::{Scalar, Scope, Value, Vector};
use crate::source::Span;
use crate::syntax::{Expression, Factor, Ident};
use crate::unit::{Measure, Unit};
use lagrangian_symbolic::Expr;

impl<'a, 'd> Resolver<'a, 'd, '_> {
    pub(super) fn product(
        &mut self,
        factors: &'a [Factor],
        span: Span,
        scope: Scope<'a>,
    ) -> Value<'d> {
        let mut product = Product {
            number: Some(1.0),
            ..Product::default()
        };
        let mut complete = true;
        // Whether there are only numbers and units so far, so that a unit may follow.
        let mut measured = true;
        // The name that ended them, if a unit has the same name.
        let mut hides: Option<&Ident> = None;
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
                    self.refuse_unit_after_name(name, &declared.text);
                }
                complete = false;
                continue;
            }
            if measured && place > 0 && measure.is_none() {
                let name = first_name(&factor.value);
                hides = name.filter(|name| Measure::named(&name.text).is_some());
            }
            let value = match &measure {
                Some(measure) => Value::Scalar(Scalar {
                    expr: measure.in_si(self.dag),
                    unit: Some(measure.unit),
                    number: Some(measure.to_f64()),
                }),
                None => self.value(&factor.value, scope),
            };
            if let (true, Some(name), Some(unit)) = (measured, hides, value.unit()) {
                self.note_hidden_unit(factor, name, unit);
            }
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
    pub(super) fn check_divisor(&mut self, divisor: &Scalar<'d>, span: Span) -> bool {
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

    pub(super) fn power(
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
}

/// The largest exponent of a non-constant: nothing in mechanics grows with a higher power, and its
/// code would be a page long.
const LARGEST_EXPONENT: i64 = 64;

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
