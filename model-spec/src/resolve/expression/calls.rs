//! Functions, of numbers and of vectors.

use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Space, stage};
use crate::resolve::Resolver;
use crate::resolve::names::{Namespace, suggestion, with_help};
use crate::resolve::value::{Scope, Value, dependence};
use crate::resolve::work::{Need, State};
use crate::source::Span;
use crate::syntax::{Call, Expression, Ident, SectionKind};
use crate::unit::Unit;
use lagrangian_symbolic::{Expr, Function, Symbol, Tangent};

impl<'a, 'd> Resolver<'a, 'd, '_> {
    pub(super) fn call(&mut self, call: &'a Call, span: Span, scope: Scope<'a>) -> Value<'d> {
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
            // An angle, also that of a bare number, so that it is converted where degrees are declared.
            Function::Asin | Function::Acos | Function::Atan => {
                self.require_dimensionless(x.unit, "a pure number", argument.span);
                Some(Unit::RADIAN)
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
            Function::Atan2 => Some(Unit::RADIAN),
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
            scope.with_limit(&crate::resolve::value::limits::DEFINITION),
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

    pub(super) fn norm(
        &mut self,
        argument: &'a Expression,
        span: Span,
        scope: Scope<'a>,
    ) -> Value<'d> {
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

    pub(super) fn vector_product(
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
    pub(super) fn polar(
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

/// Functions of vectors, and others that the language has besides [`Function`].
const VECTOR_FUNCTIONS: [&str; 7] = ["dot", "cross", "norm", "direction", "polar", "der", "table"];

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
        Function::Sign if x == 0.0 => 0.0, // `signum` of 0 is 1
        Function::Sign => x.signum(),
        Function::Atan2 | Function::Min | Function::Max | Function::Pow => f64::NAN,
    }
}
