//! Units of expressions: what they must be, and what is said where they are not.

use crate::diagnostic::{Code, Diagnostic};
use crate::model::stage;
use crate::resolve::Resolver;
use crate::resolve::items::equals_unit;
use crate::resolve::names::{Namespace, with_help};
use crate::resolve::value::{Scalar, Scope, Value};
use crate::source::Span;
use crate::syntax::{Expression, ExpressionKind, Factor, Ident};
use crate::unit::{Measure, Unit};
use lagrangian_symbolic::{Expr, Node};

/// A quantity after a number whose name is that of a unit too.
pub(crate) struct HiddenUnit<'a> {
    name: &'a Ident,
    /// By what the unit of the product changes if the name is that of the unit.
    instead: Unit,
}

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// Reports a unit other than the one required; a bare number takes any unit.
    pub fn require_unit(&mut self, found: Option<Unit>, expected: Unit, span: Span, reason: &str) {
        if let Some(found) = found.filter(|found| !found.fits(expected)) {
            let diagnostic = self.unit_mismatch(found, expected, span, reason);
            self.push(diagnostic);
        }
    }

    /// The error that an expression is in another unit than its place requires, for the reason given.
    pub fn unit_mismatch(
        &self,
        found: Unit,
        expected: Unit,
        span: Span,
        reason: &str,
    ) -> Diagnostic {
        let message = format!(
            "expected {}, found {}",
            unit_text(expected),
            unit_text(found)
        );
        let diagnostic = Diagnostic::new(Code::UnitMismatch, span, message);
        let diagnostic = diagnostic.help(unit_factor_help(reason, found, expected));
        self.explain_hidden_unit(diagnostic, found, expected, span)
    }

    /// Adds to an error about units that a quantity in an expression of the unit `found` has the name of a unit, if the expression would
    /// be in `expected` if that unit was meant.
    fn explain_hidden_unit(
        &self,
        diagnostic: Diagnostic,
        found: Unit,
        expected: Unit,
        span: Span,
    ) -> Diagnostic {
        let would_fit = |hidden: &&HiddenUnit<'_>| {
            span.encloses(hidden.name.span) && found.times(hidden.instead).fits(expected)
        };
        let hidden = self.hidden_units.iter().find(would_fit);
        let declared = hidden.and_then(|hidden| {
            let group = self.find_group(Namespace::Values, &hidden.name.text)?;
            let first = *self.groups[group].declarations.first()?;
            Some((&hidden.name.text, self.declarations[first].name.span))
        });
        let Some((name, declared)) = declared else {
            return diagnostic;
        };
        let hint = format!(
            "`{name}` is declared in this machine, and therefore is not the unit: {}",
            in_place_of_hidden(name)
        );
        let help = match &diagnostic.help {
            Some(help) => format!("{help}; {hint}"),
            None => hint,
        };
        let note = format!("this is `{name}`");
        diagnostic.help(help).note(declared, note)
    }

    /// Remembers that a factor of a product, a quantity in `unit`, hides the unit `name`.
    pub(super) fn note_hidden_unit(&mut self, factor: &'a Factor, name: &'a Ident, unit: Unit) {
        let meant = unit_of(&factor.value, &|_| true);
        if let Some(meant) = meant {
            let instead = meant.unit.over(unit);
            let instead = if factor.divides {
                Unit::ONE.over(instead)
            } else {
                instead
            };
            self.hidden_units.push(HiddenUnit { name, instead });
        }
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
                let diagnostic = self.unit_mismatch(other, unit, span, reason);
                let diagnostic = self.explain_hidden_unit(diagnostic, unit, other, example);
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

    /// Refuses a value without a unit that varies, such as a component of a vector of bare numbers in a frame that turns, where a unit
    /// other than that of the SI is declared. Only of a constant can it be said that somebody has written it in the declared unit.
    pub fn refuse_varying_number(&mut self, value: &Scalar<'d>, declared: Unit, span: Span) {
        let varies = value.is_bare() && value.expr.stage() != stage::CONSTANT;
        self.refuse_bare_numbers([(varies, span)].into_iter(), Some(declared));
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
    pub(super) fn unit_factor(
        &mut self,
        factor: &'a Expression,
        scope: Scope<'a>,
    ) -> Option<Measure> {
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
    pub(super) fn equals_unit_of_same_name(&mut self, name: &'a Ident) -> bool {
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
    pub(super) fn refuse_unit_after_name(&mut self, name: &'a Ident, declared: &str) {
        let message = format!("nothing is named `{}`", name.text);
        let diagnostic = Diagnostic::new(Code::UnknownName, name.span, message);
        self.push(diagnostic.help(format!(
            "`{}` is a unit only after a number or another unit, and `{declared}` is declared here and therefore is not a unit: {}",
            name.text,
            in_place_of_hidden(declared)
        )));
    }

    pub(super) fn unit_of_power(
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

    pub(super) fn unit_of_root(&mut self, unit: Option<Unit>, span: Span) -> Option<Unit> {
        let unit = unit?;
        let root = unit.power(1, 2);
        if root.is_none() {
            let message = format!("the root of {} is not a unit", unit_text(unit));
            self.error(Code::UnitOfPower, span, message);
        }
        root
    }

    pub(super) fn require_dimensionless(&mut self, unit: Option<Unit>, expected: &str, span: Span) {
        if let Some(unit) = unit.filter(|unit| !unit.is_one()) {
            let message = format!("expected {expected}, found {}", unit_text(unit));
            let diagnostic = Diagnostic::new(Code::UnitMismatch, span, message);
            self.push(with_help(diagnostic, cycles_help(unit, Unit::ONE)));
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
pub(super) fn names_of(unit: &Expression) -> Vec<&Ident> {
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
pub(super) fn first_name(factor: &Expression) -> Option<&Ident> {
    match &factor.kind {
        ExpressionKind::Name(reference) if reference.index.is_none() => Some(&reference.base),
        ExpressionKind::Power(base, _) => first_name(base),
        ExpressionKind::Product(factors) => first_name(&factors.first()?.value),
        _ => None,
    }
}

/// The help for cycles where radians are expected, or vice versa.
pub(super) fn cycles_help(found: Unit, expected: Unit) -> Option<String> {
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
pub(super) fn unit_factor_help(reason: &str, found: Unit, expected: Unit) -> String {
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

/// What to write in place of a unit whose name a quantity of the machine has.
fn in_place_of_hidden(name: &str) -> String {
    let prefixed = ["m", "k"].map(|prefix| format!("{prefix}{name}"));
    match prefixed.iter().find(|unit| Measure::named(unit).is_some()) {
        Some(unit) => format!(
            "write another unit, such as `{unit}`, or only the number, in SI units, where it stands alone"
        ),
        None => "write another unit, or only the number, in SI units, where it stands alone".into(),
    }
}

/// A unit in the words of a message.
pub(crate) fn unit_text(unit: Unit) -> String {
    match unit.to_string() {
        one if one == "1" => "a pure number".to_owned(),
        text => text,
    }
}

/// The power of π in a constant.
pub(super) fn power_of_pi(constant: Expr<'_>) -> i32 {
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
