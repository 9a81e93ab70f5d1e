//! Items, the parts of a machine: resolves each field and checks its unit and kind.

use lagrangian_symbolic::{Expr, nearest};

use super::Resolver;
use super::names::{Content, Namespace, declared_measure};
use super::value::{MemberId, Scalar, Scope, Value, Vector, limits};
use super::work::{Need, State};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::bounds::BoundKind;
use crate::model::{
    Approximation, ApproximationKind, Body, Circle, Constant, Coordinate, Frame, Inertia, Input,
    Local, Output, Parameter, Rotation, Space, stage,
};
use crate::source::Span;
use crate::syntax::{self, Expression, ExpressionKind, Quantity, Record, SectionKind};
use crate::unit::{Measure, Unit};

const INERTIA: Unit = Unit::base(1, 2, 0);

/// Whether a value is a constant that equals a unit, to rounding.
pub(super) fn equals_unit(value: Expr<'_>, measure: &Measure) -> bool {
    value.stage() == stage::CONSTANT
        && (nearest(value) - measure.to_f64()).abs() <= 1e-15 * measure.to_f64()
}

impl<'a, 'd> Resolver<'a, 'd, '_> {
    // Values.

    /// The value of a constant: the one that the caller sets, or the one in the spec.
    pub fn constant_value(&mut self, member: MemberId, quantity: &'a Quantity) -> Value<'d> {
        let measure = declared_measure(quantity);
        let name = self.name(member).to_string();
        let set = self.overrides.iter().find(|(known, _)| *known == name);
        let mut scalar = match (set, &quantity.value) {
            (Some((_, value)), _) => self.bare_number(value.clone()),
            (None, Some(value)) => {
                let scope = self.scope(member, &limits::CONSTANT);
                let Some(scalar) = self.quantity_value(value, measure.as_ref(), scope) else {
                    return Value::Unknown;
                };
                scalar
            }
            (None, None) => return Value::Unknown, // the parser has reported that it is missing
        };
        self.convert_to_si(&mut scalar, measure);
        Value::Scalar(scalar)
    }

    /// Converts a value in a declared unit to SI units, which formulas use.
    pub(super) fn convert_to_si(&self, scalar: &mut Scalar<'d>, measure: Option<Measure>) {
        let unit = measure.as_ref().map(|measure| measure.unit);
        if let Some(measure) = measure.filter(|measure| !measure.is_si()) {
            scalar.expr = measure.in_si(self.dag) * scalar.expr;
            scalar.number = scalar.number.map(|number| number * measure.to_f64());
        }
        scalar.unit = unit.or(scalar.unit);
    }

    /// A value in the unit declared for it: bare numbers are in that unit already, anything else is converted.
    pub fn quantity_value(
        &mut self,
        value: &'a Expression,
        measure: Option<&Measure>,
        scope: Scope<'a>,
    ) -> Option<Scalar<'d>> {
        let Some(measure) = measure else {
            return self.scalar(value, scope);
        };
        let unit = measure.unit;
        let mut scalar = self.scalar(value, scope.with_expected_unit(unit))?;
        self.require_unit(
            scalar.unit,
            unit,
            value.span,
            "the expected unit is that of the declaration",
        );
        self.refuse_hidden_unit(value, scalar.unit, unit);
        self.refuse_varying_number(&scalar, unit, value.span);
        if scalar.unit.is_none() {
            self.warn_about_degrees(&scalar, unit, value.span);
        } else if !measure.is_si() {
            scalar.expr = measure.of_si(self.dag) * scalar.expr;
            scalar.number = scalar.number.map(|number| number / measure.to_f64());
        }
        Some(scalar)
    }

    /// Refuses a name that is also the name of a unit of the same kind, because no unit could tell
    /// the two apart: with `h: s = 5`, `2*h` could be two hours.
    fn check_unit_name(&mut self, member: MemberId, value: &Scalar<'d>) {
        let name = &self.declaration(member).name.base;
        let measure = Measure::named(&name.text);
        let Some(measure) = measure.filter(|_| self.members[member].index.is_none()) else {
            return;
        };
        let alike = value.unit.unwrap_or(Unit::ONE) == measure.unit;
        // A declaration `deg = pi/180` agrees with the meaning of the unit.
        if alike && !equals_unit(value.expr, &measure) {
            let unit = name.text.as_str();
            let message = format!(
                "`{unit}` is also the name of a unit of the same kind as the quantity declared here"
            );
            let diagnostic = Diagnostic::new(Code::ReservedName, name.span, message);
            let help = format!("`2*{unit}` could be either: give it another name");
            self.push(diagnostic.help(help));
        }
    }

    pub(super) fn unit_text(&self, member: MemberId, unit: Unit) -> String {
        let written = self
            .quantity(member)
            .and_then(|quantity| quantity.unit.as_ref());
        written.map_or_else(|| unit.to_string(), |unit| unit.to_string())
    }

    pub fn constant(&mut self, member: MemberId) -> Option<Constant<'d>> {
        let Value::Scalar(scalar) = self.value_of(member, self.span(member)) else {
            return None;
        };
        self.check_unit_name(member, &scalar);
        let unit = scalar.unit.unwrap_or(Unit::ONE);
        let measure = self.quantity(member).and_then(declared_measure);
        let measure = measure.filter(|measure| !measure.is_si());
        Some(Constant {
            name: self.name(member),
            docs: self.docs(member),
            unit,
            unit_text: self.unit_text(member, unit),
            value: match measure {
                Some(measure) => measure.of_si(self.dag) * scalar.expr,
                None => scalar.expr,
            },
            span: self.span(member),
        })
    }

    pub fn parameter(&mut self, member: MemberId) -> Option<Parameter<'d>> {
        let quantity = self.quantity(member)?;
        let measure = declared_measure(quantity);
        let unit = measure.as_ref().map(|measure| measure.unit);
        if self.is_derived(member) {
            return None;
        }
        self.check_symbol_name(member);
        let default = match &quantity.value {
            // A formula is checked even if the caller gives the parameter a value.
            Some(_) if self.has_formula(member) => {
                self.derived_value(member, quantity);
                self.given_value(member)
            }
            Some(value) => {
                let scope = self.scope(member, &limits::DEFAULT);
                Some(self.quantity_value(value, measure.as_ref(), scope)?.expr)
            }
            None => None,
        };
        let [symbol, ..] = self.members[member].symbols?;
        Some(Parameter {
            name: self.name(member),
            docs: self.docs(member),
            unit: unit?,
            unit_text: self.unit_text(member, unit?),
            default,
            symbol,
            span: self.span(member),
        })
    }

    pub fn coordinate(&mut self, member: MemberId) -> Option<Coordinate<'d>> {
        let quantity = self.quantity(member)?;
        let measure = declared_measure(quantity);
        let unit = measure.as_ref().map(|measure| measure.unit);
        self.check_symbol_name(member);
        let is_state = self.is_unit_of_state(quantity, unit);
        let scope = self.scope(member, &limits::START);
        let start = match &quantity.value {
            Some(value) => self.quantity_value(value, measure.as_ref(), scope)?.expr,
            None => self.dag.zero(),
        };
        if !is_state {
            return None;
        }
        let [q, v, a] = self.members[member].symbols?;
        Some(Coordinate {
            name: self.name(member),
            docs: self.docs(member),
            unit: unit?,
            unit_text: self.unit_text(member, unit?),
            start,
            start_rate: self.dag.zero(),
            rate: None,
            q,
            v,
            a,
            span: self.span(member),
        })
    }

    pub fn input(&mut self, member: MemberId) -> Option<Input<'d>> {
        let quantity = self.quantity(member)?;
        let measure = declared_measure(quantity);
        let unit = measure.as_ref().map(|measure| measure.unit);
        self.check_symbol_name(member);
        let scope = self.scope(member, &limits::DEFAULT);
        let default = match &quantity.value {
            Some(value) => self.quantity_value(value, measure.as_ref(), scope)?.expr,
            None => self.dag.zero(),
        };
        let [symbol, ..] = self.members[member].symbols?;
        Some(Input {
            name: self.name(member),
            docs: self.docs(member),
            unit: unit?,
            unit_text: self.unit_text(member, unit?),
            default,
            symbol,
            span: self.span(member),
        })
    }

    pub fn output(&mut self, member: MemberId) -> Option<Output<'d>> {
        let quantity = self.quantity(member)?;
        self.check_output_name(member);
        let measure = declared_measure(quantity);
        let unit = measure.as_ref().map(|measure| measure.unit);
        let scope = self.scope(member, &limits::OUTPUT);
        let value = self.quantity_value(quantity.value.as_ref()?, measure.as_ref(), scope)?;
        // Only a formula from the caller has no declared unit, and takes its own.
        let unit = match quantity.unit {
            Some(_) => unit?,
            None => value.unit.unwrap_or(Unit::ONE),
        };
        Some(Output {
            name: self.name(member),
            docs: self.docs(member),
            unit,
            unit_text: self.unit_text(member, unit),
            value: value.expr,
            span: self.span(member),
        })
    }

    /// The value of an output in formulas of the caller, in SI units. A bare number is in the unit of the output.
    pub fn shared_output(&mut self, member: MemberId, quantity: &'a Quantity) -> Value<'d> {
        let scope = self.scope(member, &limits::DEFINITION);
        let scalar = quantity
            .value
            .as_ref()
            .and_then(|value| self.scalar(value, scope));
        let Some(mut scalar) = scalar else {
            return Value::Unknown;
        };
        if let (None, Some(measure)) = (scalar.unit, declared_measure(quantity)) {
            scalar.expr = measure.in_si(self.dag) * scalar.expr;
            scalar.number = scalar.number.map(|number| number * measure.to_f64());
            scalar.unit = Some(measure.unit);
        }
        Value::Scalar(scalar)
    }

    /// Resolves a definition even if nothing uses it, so that errors in it are reported.
    pub fn definition(&mut self, member: MemberId) {
        if let Value::Scalar(scalar) = self.value_of(member, self.span(member)) {
            self.check_unit_name(member, &scalar);
        }
    }

    pub(super) fn check_symbol_name(&mut self, member: MemberId) {
        if let Value::Scalar(scalar) = self.members[member].value.clone() {
            self.check_unit_name(member, &scalar);
        }
    }

    /// Whether a coordinate, or its rate, is declared in an SI unit. The state of a run is in SI
    /// units, and so are its tolerances, matrices and modes.
    pub fn is_unit_of_state(&mut self, quantity: &'a Quantity, unit: Option<Unit>) -> bool {
        let (Some(written), Some(unit)) = (&quantity.unit, unit) else {
            return true; // an unknown unit has been reported
        };
        if !unit.is_scaled() {
            return true;
        }
        let base = unit.as_written(false);
        let message = format!("a coordinate and its rate must be in SI units, here {base}");
        let diagnostic = Diagnostic::new(Code::UnitOfState, written.span, message);
        let number = |value: &Expression| match &value.kind {
            ExpressionKind::Number(number) => Some(number.clone()),
            _ => None,
        };
        let signed = |value: &Expression| match &value.kind {
            ExpressionKind::Negative(inner) => number(inner).map(|number| format!("-{number}")),
            _ => number(value),
        };
        let number = quantity.value.as_ref().and_then(signed);
        let number = number.unwrap_or_else(|| "30".to_owned());
        let help = match written.factors.first() {
            Some(first) if first.power > 0 => format!("write `{base} = {number}*{written}`"),
            _ => format!("write `{base}`, and convert the value"),
        };
        self.push(diagnostic.help(help));
        false
    }

    // Frames and bodies.

    pub fn named_frame(&mut self, member: MemberId) -> Option<Frame> {
        let Value::Frame(pose) = self.value_of(member, self.span(member)) else {
            return None;
        };
        Some(Frame {
            name: self.name(member),
            docs: self.docs(member),
            pose,
            span: self.span(member),
        })
    }

    /// The mass centre of a body: as given, or at the origin of its frame.
    pub fn mass_centre(&mut self, member: MemberId, record: &'a Record) -> Value<'d> {
        if let Some(at) = record.get("at") {
            let scope = self.scope(member, &limits::POSITION);
            let reason = "a point is in m";
            return match self.vector_in(at, "a point", Unit::METRE, reason, scope) {
                Some(centre) => Value::Vector(self.relaxed_centre(
                    member,
                    Vector {
                        unit: Some(Unit::METRE),
                        ..centre
                    },
                )),
                None => Value::Unknown,
            };
        }
        let Some(frame) = record.get("frame") else {
            let base = &self.declaration(member).name.base.text;
            self.missing_field(
                member,
                format!("a body needs `at` or `frame`, and `{base}` has neither"),
            );
            return Value::Unknown;
        };
        match self.frame_of_body(member, frame.span) {
            Some(pose) => Value::Vector(self.origin(pose)),
            None => Value::Unknown,
        }
    }

    /// The frame that a body is fixed to.
    pub fn body_frame(&mut self, member: MemberId) -> Value<'d> {
        let frame = self.record(member).and_then(|record| record.get("frame"));
        let scope = self.scope(member, &limits::FRAME);
        match frame.and_then(|frame| self.frame(frame, scope)) {
            Some(pose) => Value::Frame(pose),
            None => Value::Unknown,
        }
    }

    pub fn body(&mut self, member: MemberId) -> Option<Body<'d>> {
        let record = self.record(member)?;
        let span = self.span(member);
        let mass = self.mass(member, record);
        let inertia = self.inertia(member, record);
        let at = self.value_of(member, span);
        let rotation = self.rotation(member, record);
        let has_inertia = record.field("inertia");
        if let (Some(inertia), Some(Rotation::Unspecified)) = (has_inertia, &rotation) {
            let message = "this body has an inertia, but its rotation is not given";
            let diagnostic = Diagnostic::new(Code::MissingRotation, inertia.name.span, message);
            self.push(diagnostic.help(match self.space {
                Space::Plane => "give it an `angle` or a `frame`; without inertia it is a particle",
                Space::Space => "give it a `frame`; without inertia it is a particle",
            }));
        }
        let outline = self.outline(member, record);
        if let (Some(outline), Some(Rotation::Unspecified)) = (record.field("outline"), &rotation) {
            let message = "this body has an outline, but its rotation is not given";
            let diagnostic = Diagnostic::new(Code::MissingRotation, outline.name.span, message);
            self.push(diagnostic.help("give it an `angle` or a `frame`"));
        }
        let Value::Vector(at) = at else {
            return None;
        };
        Some(Body {
            name: self.name(member),
            docs: self.docs(member),
            mass: mass?,
            inertia: inertia?,
            at: at.components,
            local: if self.guides.is_empty() {
                at.local.map(|(pose, point)| Local { pose, point })
            } else {
                // A relaxed guide moves origins of frames, which no step from frame to frame accounts for.
                None
            },
            rotation: rotation?,
            outline: outline?,
            span,
            position_span: record
                .get("at")
                .or_else(|| record.get("frame"))
                .map_or(span, |place| place.span),
        })
    }

    fn mass(&mut self, member: MemberId, record: &'a Record) -> Option<Expr<'d>> {
        let mass = self.field(member, record, "mass")?;
        let scope = self.scope(member, &limits::MASS);
        let scalar = self.scalar_in(mass, Unit::KILOGRAM, "a mass is in kg", scope)?;
        self.bound(BoundKind::Mass, scalar.expr, mass.span);
        Some(scalar.expr)
    }

    fn inertia(&mut self, member: MemberId, record: &'a Record) -> Option<Inertia<'d>> {
        let Some(inertia) = record.get("inertia") else {
            return Some(Inertia::Particle);
        };
        let scope = self.scope(member, &limits::INERTIA);
        match (self.space, &inertia.kind) {
            (Space::Plane, ExpressionKind::Tuple(_)) => {
                let message = "in the plane an inertia is one number, found several";
                self.error(Code::WrongSpace, inertia.span, message);
                None
            }
            (Space::Plane, _) => {
                let moment = self.moment(inertia, true, scope)?;
                Some(Inertia::Planar(moment))
            }
            (Space::Space, ExpressionKind::Tuple(parts)) => self.tensor(inertia.span, parts, scope),
            (Space::Space, _) => {
                // A single number is a habit from the plane, and deserves a better message than
                // "found a number".
                match self.value(inertia, scope.with_expected_unit(INERTIA)) {
                    Value::Vector(moments) => {
                        self.require_unit(
                            moments.unit,
                            INERTIA,
                            inertia.span,
                            "an inertia is in kg*m^2",
                        );
                        let [a, b, c] = moments.components[..] else {
                            return None;
                        };
                        for moment in [a, b, c] {
                            self.bound(BoundKind::Moment, moment, inertia.span);
                        }
                        let zero = self.dag.zero();
                        let others = [b, c, zero, zero, zero];
                        self.bound(BoundKind::Tensor(others), a, inertia.span);
                        Some(Inertia::Tensor([a, b, c, zero, zero, zero]))
                    }
                    Value::Scalar(_) => {
                        let message = "in space an inertia is three moments or six entries, found \
                                       one number";
                        let diagnostic = Diagnostic::new(Code::WrongSpace, inertia.span, message);
                        self.push(diagnostic.help(
                            "write `(A, B, C)` about the body's own axes, or \
                             `(A, B, C, Ixy, Ixz, Iyz)`",
                        ));
                        None
                    }
                    Value::Unknown => None,
                    other => {
                        self.wrong_kind("three moments of inertia", &other, inertia);
                        None
                    }
                }
            }
        }
    }

    fn moment(
        &mut self,
        part: &'a Expression,
        diagonal: bool,
        scope: Scope<'a>,
    ) -> Option<Expr<'d>> {
        let scalar = self.scalar_in(part, INERTIA, "an inertia is in kg*m^2", scope)?;
        // A thin rod has no inertia about its axis, so zero is allowed.
        if diagonal {
            self.bound(BoundKind::Moment, scalar.expr, part.span);
        }
        Some(scalar.expr)
    }

    fn tensor(
        &mut self,
        span: Span,
        parts: &'a [Expression],
        scope: Scope<'a>,
    ) -> Option<Inertia<'d>> {
        let mut entries = Vec::with_capacity(6);
        for (k, part) in parts.iter().enumerate() {
            entries.push(self.moment(part, k < 3, scope));
        }
        if entries.len() != 3 && entries.len() != 6 {
            let message = format!(
                "in space an inertia is three moments or six entries, found {}",
                parts.len()
            );
            let diagnostic = Diagnostic::new(Code::WrongDimension, span, message);
            let help = "write `(A, B, C)`, or `(A, B, C, Ixy, Ixz, Iyz)`";
            self.push(diagnostic.help(help));
            return None;
        }
        entries.resize(6, Some(self.dag.zero()));
        let entries: Option<Vec<Expr<'d>>> = entries.into_iter().collect();
        let entries: [Expr<'d>; 6] = entries?.try_into().ok()?;
        let [first, others @ ..] = entries;
        self.bound(BoundKind::Tensor(others), first, span);
        Some(Inertia::Tensor(entries))
    }

    pub(super) fn rotation(
        &mut self,
        member: MemberId,
        record: &'a Record,
    ) -> Option<Rotation<'d>> {
        if record.field("frame").is_some() {
            self.conflict(record, "angle", "frame");
            if self.members[member].frame_state != State::Done {
                self.need(Need::Frame(member), self.span(member));
            }
            return match self.members[member].frame {
                Value::Frame(pose) => Some(Rotation::Frame(pose)),
                _ => None,
            };
        }
        let Some(angle) = record.field("angle") else {
            return Some(Rotation::Unspecified);
        };
        if self.space == Space::Space {
            let message = "in space one angle does not determine the orientation of a body";
            let diagnostic = Diagnostic::new(Code::WrongSpace, angle.name.span, message);
            self.push(diagnostic.help("give it a frame: `frame: ground.turn(z, angle)`"));
            return None;
        }
        let scope = self.scope(member, &limits::ROTATION);
        let reason = "a body turns by an angle in rad";
        let angle = self.scalar_in(&angle.value, Unit::RADIAN, reason, scope)?;
        Some(Rotation::Angle(angle.expr))
    }

    // Circles, spheres and contacts.

    pub fn circle(&mut self, member: MemberId) -> Option<Circle<'d>> {
        let record = self.record(member)?;
        if self.space == Space::Space {
            let message = "circles exist only in the plane";
            let diagnostic = Diagnostic::new(Code::WrongSpace, self.span(member), message);
            self.push(
                diagnostic
                    .help("in space it is `spheres { name { on: …, center: …, radius: … } }`"),
            );
            return None;
        }
        self.circle_or_sphere(member, record)
    }

    pub fn sphere(&mut self, member: MemberId) -> Option<Circle<'d>> {
        let record = self.record(member)?;
        if self.space == Space::Plane {
            let message = "spheres exist only in space";
            let diagnostic = Diagnostic::new(Code::WrongSpace, self.span(member), message);
            self.push(
                diagnostic
                    .help("in the plane it is `circles { name { on: …, center: …, radius: … } }`"),
            );
            return None;
        }
        self.circle_or_sphere(member, record)
    }

    /// A circle or a sphere.
    fn circle_or_sphere(&mut self, member: MemberId, record: &'a Record) -> Option<Circle<'d>> {
        let on = self.field(member, record, "on");
        let center = self.field(member, record, "center");
        let radius = self.field(member, record, "radius");
        let on = on.and_then(|on| self.place(member, on));
        let scope = self.scope(member, &limits::RADIUS);
        let center = center.and_then(|center| {
            self.vector_in(center, "a point", Unit::METRE, "a point is in m", scope)
        });
        let radius = radius.and_then(|radius| {
            let scalar = self.scalar_in(radius, Unit::METRE, "a radius is in m", scope)?;
            self.bound(BoundKind::Radius, scalar.expr, radius.span);
            Some(scalar.expr)
        });
        Some(Circle {
            name: self.name(member),
            on: on?,
            center: center?.components,
            radius: radius?,
            span: self.span(member),
        })
    }

    // Other items.

    /// The coordinates of an approximation: one, or all of a family.
    pub fn approximation(&mut self, member: MemberId) -> Vec<Approximation> {
        let declaration = self.declaration(member);
        let Content::Approximation(content) = declaration.content else {
            return Vec::new();
        };
        let kind = match content.value {
            syntax::Approximation::Frozen => ApproximationKind::Frozen,
            syntax::Approximation::Small => ApproximationKind::Small,
        };
        let span = declaration.name.span;
        let mut found = Vec::new();
        for coordinate in self.coordinates_named(member) {
            if kind == ApproximationKind::Frozen {
                let reason =
                    "`frozen` replaces sin θ by 0 and cos θ by 1, so it applies only to angles";
                self.require_unit(self.unit_of(coordinate), Unit::RADIAN, span, reason);
            }
            found.extend(self.ordinal(coordinate).map(|coordinate| Approximation {
                coordinate,
                kind,
                span,
            }));
        }
        found
    }

    /// The coordinates with the name of an item: one, or all of a family.
    pub fn coordinates_named(&mut self, member: MemberId) -> Vec<MemberId> {
        let name = self.declaration(member).name;
        let Some(group) = self.find_group(Namespace::Values, &name.base.text) else {
            self.unknown_coordinate(&name.base);
            return Vec::new();
        };
        let index = self.members[member].index;
        let mut members = self.members_under(group, index);
        self.check_members(&members, group, (&name.base.text, index), name.span);
        members.retain(|&member| {
            let section = self.declaration(member).section;
            if section != SectionKind::Coordinates {
                let message = format!(
                    "a coordinate is expected here, and `{}` is {}",
                    name.base.text,
                    section.item()
                );
                self.error(Code::WrongKind, name.span, message);
            }
            section == SectionKind::Coordinates
        });
        members
    }
}
