//! How Rust writes everything except operators: numbers, arguments, calls, variables.

use lagrangian_symbolic::{self as symbolic, Rational};

use super::Emitter;
use crate::body::{Angle, ArrayElement, Expression as Text, Language, Loops, Precedence, Rounded};
use crate::layout::{Layout, Writer};
use crate::names::{Scope, flat, word};
use lagrangian_program::{Contracted, EliminationStep, Guard, PackedOperation, Source};

/// The Rust implementation of `Language`.
pub(super) struct Rust<'a> {
    pub(super) emitter: &'a Emitter<'a>,
    /// Whether the code computes in registers: it then loads what it reads, contracts products into sums, and
    /// computes the sines of all angles at once.
    pub(super) in_registers: bool,
}

impl Rust<'_> {
    /// The type of the numbers.
    pub(super) fn number(&self) -> &str {
        if self.in_registers {
            &self.emitter.types.register
        } else {
            &self.emitter.types.scalar
        }
    }

    /// Loads a stored number.
    fn loaded(&self, place: String) -> String {
        if self.in_registers {
            format!("n({place})")
        } else {
            place
        }
    }
}

impl Language for Rust<'_> {
    fn constant(&self, value: &Rational) -> Text {
        rational(self.number(), value)
    }

    fn pi(&self) -> Text {
        Text::call(format!("{}::pi()", self.number()))
    }

    fn argument(&self, source: Source) -> Option<Text> {
        let emitter = self.emitter;
        Some(Text::leaf(match source {
            Source::Parameter(i) => format!("self.{}", emitter.parameters.paths[i as usize]),
            Source::Prepared(i) => match emitter.prepared.get(i as usize) {
                Some(name) => self.loaded(format!("p.{name}")),
                None => format!("w[{}]", i as usize - emitter.prepared.len()),
            },
            Source::Time => self.loaded("t".to_owned()),
            Source::Input(i) => self.loaded(format!("u.{}", emitter.inputs.paths[i as usize])),
            Source::AtTime(i) | Source::AtPosition(i) => self.loaded(format!("at.values[{i}]")),
            Source::Coordinate(_) | Source::Velocity(_) | Source::Acceleration(_) => return None,
        }))
    }

    fn variable(&self, source: Source) -> (String, String) {
        let name = |i: u32| flat(&self.emitter.coordinates.slots[i as usize].name);
        match source {
            Source::Coordinate(i) => (name(i), self.loaded(format!("q[{i}]"))),
            Source::Velocity(i) => (format!("{}_dot", name(i)), self.loaded(format!("v[{i}]"))),
            Source::Acceleration(i) => {
                (format!("{}_ddot", name(i)), self.loaded(format!("a[{i}]")))
            }
            // Other arguments are not variables.
            _ => ("argument".into(), "argument".into()),
        }
    }

    fn unary(&self, function: symbolic::Function, argument: &Text) -> Text {
        Text::call(format!(
            "{}.{}()",
            argument.at_least(Precedence::Atom),
            method(function)
        ))
    }

    fn binary(&self, function: symbolic::Function, a: &Text, b: &Text) -> Text {
        Text::call(format!(
            "{}.{}({})",
            a.at_least(Precedence::Atom),
            method(function),
            b.text
        ))
    }

    fn bind(&self, writer: &mut Writer, name: &str, value: &str) {
        writer.statement(&format!("let {name} ="), &format!("{value};"));
    }

    fn sin_cos(&self, writer: &mut Writer, sin: Option<&str>, cos: Option<&str>, angle: &Text) {
        let angle = angle.at_least(Precedence::Atom);
        match (sin, cos) {
            (Some(sin), Some(cos)) => {
                writer.line(format!("let ({sin}, {cos}) = {angle}.sin_cos();"))
            }
            (Some(sin), None) => writer.line(format!("let {sin} = {angle}.sin();")),
            (None, Some(cos)) => writer.line(format!("let {cos} = {angle}.cos();")),
            (None, None) => {}
        }
    }

    fn guard(&self, writer: &mut Writer, guard: &Guard, names: [&str; 2]) {
        let coordinate = guard.coordinate.to_string();
        self.guard_of(writer, guard, names, &coordinate);
    }

    fn error(&self, of: Rounded, a: &Text, b: &Text) -> Text {
        let method = match of {
            Rounded::Product => "product_error",
            Rounded::Sum => "sum_error",
        };
        Text::call(format!(
            "{}.{method}({})",
            a.at_least(Precedence::Atom),
            b.text
        ))
    }

    fn is_for_speed(&self) -> bool {
        self.in_registers
    }

    fn contraction(&self, kind: Contracted, [a, b]: [&Text; 2], c: &Text) -> Option<Text> {
        let method = match kind {
            Contracted::Add => "mul_add",
            Contracted::Sub => "mul_sub",
            Contracted::SubFrom => "neg_mul_add",
        };
        let a = a.at_least(Precedence::Atom);
        Some(Text::call(format!("{a}.{method}({}, {})", b.text, c.text)))
    }

    fn pack(&self, operation: PackedOperation, operands: &[[Text; 2]]) -> Option<String> {
        let method = match operation {
            PackedOperation::Add => "add_each",
            PackedOperation::Sub => "sub_each",
            PackedOperation::Mul => "mul_each",
            PackedOperation::Div => "div_each",
            PackedOperation::Contraction(Contracted::Add) => "mul_add_each",
            PackedOperation::Contraction(Contracted::Sub) => "mul_sub_each",
            PackedOperation::Contraction(Contracted::SubFrom) => "neg_mul_add_each",
        };
        let array = |[a, b]: &[Text; 2]| format!("[{}, {}]", a.text, b.text);
        let operands: Vec<String> = operands.iter().map(array).collect();
        Some(format!(
            "{}::{method}({})",
            self.number(),
            operands.join(", ")
        ))
    }

    fn steps(&self, writer: &mut Writer, steps: &[EliminationStep]) {
        writer.comment("//", &self.emitter.program.text_of_steps(steps));
    }

    fn sin_cos_all(&self, writer: &mut Writer, angles: &[Angle]) {
        let values = angles.iter().map(|angle| angle.angle.text.clone());
        writer.expression("let angles = ", &Layout::array(values), ";");
        let number = self.number();
        writer.line(if self.emitter.defers_angle_check {
            format!("let (circular, are_near) = {number}::sin_cos_all_near(angles);")
        } else {
            format!("let circular = {number}::sin_cos_all(angles);")
        });
        let name = |name: &Option<String>| name.clone().unwrap_or_else(|| "_".into());
        for (i, angle) in angles.iter().enumerate() {
            let (sin, cos) = (name(&angle.sin), name(&angle.cos));
            writer.line(format!("let ({sin}, {cos}) = circular[{i}];"));
        }
    }

    /// `theta1` for `n(p.theta1)`.
    fn angle_name(&self, angle: &str) -> String {
        let inner = angle
            .strip_prefix("n(")
            .and_then(|rest| rest.strip_suffix(')'))
            .filter(|_| self.in_registers);
        let plain = inner.unwrap_or(angle).trim_start_matches("r#");
        word(plain, char::is_alphanumeric)
    }

    fn identifier(&self, scope: &mut Scope, name: &str) -> String {
        scope.take(name)
    }

    fn constant_name(&self, value: &Rational) -> Option<&'static str> {
        match value.as_integer() {
            Some(0) => Some("zero"),
            Some(1) => Some("one"),
            _ => None,
        }
    }
}

impl Loops for Rust<'_> {
    fn places(&self, source: Source) -> Vec<ArrayElement> {
        let emitter = self.emitter;
        let element = |array: &str, index: u32| {
            let element = self.loaded(format!("{array}[@]"));
            let (before, after) = element.split_once('@').unwrap_or((&element, ""));
            ArrayElement::new(before, index as usize, after)
        };
        match source {
            Source::Coordinate(i) => vec![element("q", i)],
            Source::Velocity(i) => vec![element("v", i)],
            Source::Acceleration(i) => vec![element("a", i)],
            Source::Prepared(i) => {
                let families = emitter.prepared_families.iter();
                let places = families.filter_map(|family| {
                    let at = family.slots.iter().position(|slot| *slot == i as usize)?;
                    Some(element(&format!("p.{}", family.ident), at as u32))
                });
                places.collect()
            }
            Source::Parameter(i) => {
                let mut families = emitter.parameters.fields.iter();
                let place = families.find_map(|field| {
                    let at = field.slots.iter().position(|slot| *slot == i as usize)?;
                    let array = format!("self.{}", field.ident);
                    field.is_family.then(|| element(&array, at as u32))
                });
                place.into_iter().collect()
            }
            _ => Vec::new(),
        }
    }

    fn array(&self, writer: &mut Writer, name: &str, items: Layout) {
        writer.expression(&format!("let {name} = "), &items, ";");
    }

    fn array_to_set(&self, writer: &mut Writer, name: &str, number: &str, count: usize) {
        writer.line(format!("let mut {name} = [{number}; {count}];"));
    }

    fn variable_to_set(&self, writer: &mut Writer, name: &str, value: &str) {
        writer.statement(&format!("let mut {name} ="), &format!("{value};"));
    }

    fn set(&self, writer: &mut Writer, target: &str, value: &str) {
        writer.statement(&format!("{target} ="), &format!("{value};"));
    }

    fn open_loop(&self, writer: &mut Writer, counter: Option<&str>, count: usize) {
        writer.open(format!("for {} in 0..{count} {{", counter.unwrap_or("_")));
    }

    fn guard_of(
        &self,
        writer: &mut Writer,
        guard: &Guard,
        [pivot, scale]: [&str; 2],
        coordinate: &str,
    ) {
        let constant = self.emitter.pivots_of(guard);
        writer.line(format!(
            "{constant}.check([({coordinate}, {pivot}, {scale})])?;"
        ));
    }

    fn all_circular(
        &self,
        writer: &mut Writer,
        name: &str,
        angles: &str,
        at: usize,
    ) -> [ArrayElement; 2] {
        writer.line(format!(
            "let {name} = {}::sin_cos_all({angles});",
            self.number()
        ));
        [0, 1].map(|which| ArrayElement::new(format!("{name}["), at, format!("].{which}")))
    }
}

/// The method of `Scalar` for a function.
fn method(function: symbolic::Function) -> &'static str {
    match function {
        symbolic::Function::Pow => "powf",
        other => other.name(),
    }
}

/// A rational number, exact in every type that can represent it.
pub(super) fn rational(scalar: &str, value: &Rational) -> Text {
    let nearest = value.to_f64();
    Text::call(match (value.numerator(), value.denominator()) {
        (Some(0), Some(1)) => return Text::leaf(format!("{scalar}::ZERO")),
        (Some(1), Some(1)) => return Text::leaf(format!("{scalar}::ONE")),
        // Numbers that an `f64` represents exactly.
        (Some(n), Some(d)) if d.count_ones() == 1 && n.unsigned_abs() < 1 << 53 => {
            return Text::leaf(format!("{scalar}::from_f64({})", number(nearest)));
        }
        (Some(n), Some(d)) => format!("{scalar}::from_ratio({n}, {d})"),
        // Longer than 64 bits: the nearest `f64` plus the nearest `f64` to the remainder, for types with more digits.
        _ => {
            let exact = Rational::exactly(nearest);
            let rest = exact.map_or(0.0, |exact| (value - &exact).to_f64());
            if rest == 0.0 {
                format!("{scalar}::from_f64({})", number(nearest))
            } else {
                return Text::sum(format!(
                    "{scalar}::from_f64({}) + {scalar}::from_f64({})",
                    number(nearest),
                    number(rest)
                ));
            }
        }
    })
}

/// An `f64` as a literal.
pub(super) fn number(x: f64) -> String {
    if x.is_finite() {
        format!("{x:?}")
    } else if x.is_nan() {
        "::core::primitive::f64::NAN".into()
    } else if x > 0.0 {
        "::core::primitive::f64::INFINITY".into()
    } else {
        "::core::primitive::f64::NEG_INFINITY".into()
    }
}
