//! Fields of records, and the objects that they refer to.

use lagrangian_symbolic::Expr;

use super::Resolver;
use super::motion::vector_between;
use super::names::{Content, Namespace, declared_unit, suggestion, with_help};
use super::value::{Limit, MemberId, Scope, Value, limits};
use crate::diagnostic::{Code, Diagnostic};
use crate::identity;
use crate::model::bounds::BoundKind;
use crate::model::{Assumption, FrameOrBody, Rotation, Space, Surface, Touching, circles, stage};
use crate::source::Span;
use crate::syntax::{self, Equation, Expression, ExpressionKind, Quantity, Record, SectionKind};
use crate::unit::Unit;

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// What the spec says about an item.
    pub fn docs(&self, member: MemberId) -> String {
        self.declaration(member).docs.to_owned()
    }

    /// The place where the name of an item is declared.
    pub fn span(&self, member: MemberId) -> Span {
        self.declaration(member).name.span
    }

    /// The name of an item without its index.
    pub fn base_name(&self, member: MemberId) -> &'a str {
        &self.declaration(member).name.base.text
    }

    /// The phrase for an item in messages: `a spring`.
    pub fn item(&self, member: MemberId) -> &'static str {
        self.declaration(member).section.item()
    }

    /// The fields of an item, if it has any.
    pub fn record(&self, member: MemberId) -> Option<&'a Record> {
        match self.declaration(member).content {
            Content::Record(record) => Some(record),
            _ => None,
        }
    }

    /// The expression of an item, if it is one.
    pub fn expression(&self, member: MemberId) -> Option<&'a Expression> {
        match self.declaration(member).content {
            Content::Expression(expression) => Some(expression),
            _ => None,
        }
    }

    /// The equation of an item, if it is one.
    pub fn equation(&self, member: MemberId) -> Option<&'a Equation> {
        match self.declaration(member).content {
            Content::Equation(equation) => Some(equation),
            _ => None,
        }
    }

    /// The unit and value of an item, if it is a quantity.
    pub fn quantity(&self, member: MemberId) -> Option<&'a Quantity> {
        match self.declaration(member).content {
            Content::Quantity(quantity) => Some(quantity),
            _ => None,
        }
    }

    /// A required field.
    pub fn field(
        &mut self,
        member: MemberId,
        record: &'a Record,
        field: &str,
    ) -> Option<&'a Expression> {
        let found = record.get(field);
        if found.is_none() {
            let item = self.item(member);
            let base = self.base_name(member);
            self.missing_field(
                member,
                format!("{item} needs `{field}`, and `{base}` has none"),
            );
        }
        found
    }

    /// Reports an item that lacks a field, and shows how one is written.
    pub fn missing_field(&mut self, member: MemberId, message: String) {
        let diagnostic = Diagnostic::new(Code::MissingField, self.span(member), message);
        let help = match self.declaration(member).section {
            SectionKind::Element(section) => section.help,
            SectionKind::Bodies => "a body is `name { mass: …, at: … }`",
            SectionKind::Circles => "a circle is `name { on: …, center: …, radius: … }`",
            SectionKind::Spheres => "a sphere is `name { on: …, center: …, radius: … }`",
            _ => {
                "a contact is `name { circle: …, inside: …, restitution: …, friction: … }`, in space with `sphere`, \
                 with `outside`, or with `gap` and `slip` in their place"
            }
        };
        self.push(diagnostic.help(help));
    }

    /// Reports a field that conflicts with another.
    pub fn conflict(&mut self, record: &'a Record, field: &str, with: &str) {
        if let Some(field) = record.field(field) {
            let message = format!("`{}` cannot be combined with `{with}`", field.name.text);
            let diagnostic = Diagnostic::new(Code::ConflictingFields, field.name.span, message);
            self.push(diagnostic.help("give only one of them"));
        }
    }

    /// A point of the machine, in m.
    pub fn point(&mut self, member: MemberId, point: &'a Expression) -> Option<Vec<Expr<'d>>> {
        let scope = self.scope(member, &limits::POINT);
        let point = self.vector_in(point, "a point", Unit::METRE, "a point is in m", scope)?;
        Some(point.components)
    }

    /// The unit of a coordinate.
    pub fn unit_of(&self, coordinate: MemberId) -> Option<Unit> {
        declared_unit(self.quantity(coordinate)?)
    }

    /// The coordinate that an expression names.
    pub fn coordinate_at(&mut self, member: MemberId, on: &'a Expression) -> Option<MemberId> {
        let scope = self.scope(member, &limits::DEFINITION);
        let ExpressionKind::Name(reference) = &on.kind else {
            if on.kind != ExpressionKind::Error {
                let message = "the name of a coordinate is expected here";
                self.error(Code::WrongKind, on.span, message);
            }
            return None;
        };
        self.coordinate_named(&reference.base, reference.index.as_deref(), scope)
    }

    /// The coordinate with a name.
    pub fn coordinate_named(
        &mut self,
        name: &'a syntax::Ident,
        index: Option<&'a Expression>,
        scope: Scope<'a>,
    ) -> Option<MemberId> {
        let namespace = Namespace::Values;
        let Some(group) = self.find_group(namespace, &name.text) else {
            if self.find_group(Namespace::BODIES, &name.text).is_some() {
                let message = format!(
                    "a coordinate is expected here, and `{}` is a body",
                    name.text
                );
                let diagnostic = Diagnostic::new(Code::WrongKind, name.span, message);
                self.push(diagnostic.help("a torque on a body belongs under `torques`"));
            } else {
                self.unknown_coordinate(name);
            }
            return None;
        };
        let member = self.member(group, name, index, scope)?;
        let section = self.declaration(member).section;
        if section == SectionKind::Coordinates {
            return Some(member);
        }
        let found = section.item();
        let message = format!(
            "a coordinate is expected here, and `{}` is {found}",
            name.text
        );
        self.error(Code::WrongKind, name.span, message);
        None
    }

    /// Reports a name that is not that of a coordinate.
    pub fn unknown_coordinate(&mut self, name: &syntax::Ident) {
        if self.incomplete || name.text.is_empty() {
            return;
        }
        let coordinates = self
            .declarations
            .iter()
            .filter(|declaration| declaration.section == SectionKind::Coordinates)
            .map(|declaration| declaration.name.base.text.as_str());
        let help = suggestion(&name.text, coordinates);
        let message = format!("no coordinate is named `{}`", name.text);
        self.push(with_help(
            Diagnostic::new(Code::UnknownName, name.span, message),
            help,
        ));
    }

    /// The body that an expression names.
    pub fn body_at(&mut self, member: MemberId, on: &'a Expression) -> Option<MemberId> {
        let scope = self.scope(member, &limits::DEFINITION);
        match &on.kind {
            ExpressionKind::Name(reference) => {
                self.named_member(Namespace::BODIES, "no body is", reference, scope)
            }
            ExpressionKind::Error => None,
            _ => {
                self.error(
                    Code::WrongKind,
                    on.span,
                    "the name of a body is expected here",
                );
                None
            }
        }
    }

    /// The body that an expression names, which must have an orientation.
    pub fn oriented_body(&mut self, member: MemberId, on: &'a Expression) -> Option<MemberId> {
        let body = self.body_at(member, on)?;
        let turns = self.record(body).is_some_and(|record| {
            record.field("frame").is_some() || record.field("angle").is_some()
        });
        if !turns {
            let name = self.name(body);
            let message = format!("the rotation of the body `{name}` is not given");
            let diagnostic = Diagnostic::new(Code::MissingRotation, on.span, message);
            self.push(diagnostic.help("give it an `angle` or a `frame`"));
        }
        Some(body)
    }

    /// A frame, or a body with an orientation.
    pub fn oriented_place(&mut self, member: MemberId, on: &'a Expression) -> Option<FrameOrBody> {
        let place = self.place(member, on)?;
        let FrameOrBody::Body(_) = place else {
            return Some(place);
        };
        let body = self.oriented_body(member, on)?;
        let has_frame = self.record(body)?.field("frame").is_some();
        if has_frame {
            self.frame_of_body(body, on.span).map(FrameOrBody::Frame)
        } else {
            Some(place)
        }
    }

    /// The angle between two places, in the plane, with common terms cancelled.
    pub fn angle_between(&mut self, from: FrameOrBody, to: FrameOrBody) -> Option<Expr<'d>> {
        let [from, to] = [from, to].map(|place| self.angle_of_place(place));
        vector_between(&[from?], &[to?]).pop()
    }

    /// The angle of a frame or of a body that has one, in the plane.
    pub fn angle_of_place(&mut self, place: FrameOrBody) -> Option<Expr<'d>> {
        match place {
            FrameOrBody::Frame(pose) => Some(self.pose(pose).angle),
            FrameOrBody::Body(ordinal) => {
                let bodies = self.members_of(SectionKind::Bodies);
                let body = *bodies.get(ordinal)?;
                match self.rotation(body, self.record(body)?)? {
                    Rotation::Angle(angle) => Some(angle),
                    Rotation::Frame(pose) => Some(self.pose(pose).angle),
                    Rotation::Unspecified => None,
                }
            }
        }
    }

    /// A unit vector along another vector.
    pub fn direction(&mut self, along: &[Expr<'d>], span: Span) -> Option<Vec<Expr<'d>>> {
        let square = self.dag.sum(along.iter().map(|c| c.square()));
        if identity::is_zero(square) == Some(true) {
            let message = "this vector has no length, and so no direction";
            self.error(Code::DivisionByZero, span, message);
            return None;
        }
        if identity::equal(square, self.dag.one()) == Some(true) {
            return Some(along.to_vec());
        }
        let length = self.distance(along);
        Some(along.iter().map(|&c| c / length).collect())
    }

    /// A frame or a body: the base of a sliding body, or what a circle is fixed to.
    pub fn place(&mut self, member: MemberId, on: &'a Expression) -> Option<FrameOrBody> {
        let scope = self.scope(member, &limits::POINT);
        let value = match &on.kind {
            ExpressionKind::Name(reference) => {
                self.frame_or_body(reference, on.span, "origin", scope)
            }
            _ => self.value(on, scope),
        };
        match value {
            Value::Frame(pose) => Some(FrameOrBody::Frame(pose)),
            Value::Body(body) => Some(FrameOrBody::Body(self.ordinal(body)?)),
            Value::Unknown => None,
            other => {
                self.wrong_kind("a frame or a body", &other, on);
                None
            }
        }
    }

    /// The distance between two points: √(u·u), or an expression with that square that is assumed to be nonnegative.
    pub fn distance(&self, line: &[Expr<'d>]) -> Expr<'d> {
        circles::distance(line, &self.facts)
    }

    /// Adds a fact that a run checks and that the spec does not state, unless it is known or always true.
    pub fn add_fact(&mut self, fact: Assumption<'d>) {
        let mut known = self.further_facts.iter();
        let is_known = known.any(|known| known.excess == fact.excess);
        if !is_known && fact.excess.stage() > stage::CONSTANT {
            self.further_facts.push(fact);
        }
    }

    /// Left side minus right side, in one unit.
    pub fn difference(
        &mut self,
        left: &'a Expression,
        right: &'a Expression,
        scope: Scope<'a>,
    ) -> Option<Expr<'d>> {
        let ([left, right], _) = self.sides(left, right, scope)?;
        Some(left - right)
    }

    /// Both sides of a relation, and their unit; 1 for bare numbers.
    pub fn sides(
        &mut self,
        left: &'a Expression,
        right: &'a Expression,
        scope: Scope<'a>,
    ) -> Option<([Expr<'d>; 2], Unit)> {
        let first = self.scalar(left, scope);
        let hint = first.and_then(|first| first.unit);
        let second = self.scalar(right, scope.with_expected_unit(hint));
        let (first, second) = (first?, second?);
        if let Some(unit) = first.unit {
            self.require_unit(
                second.unit,
                unit,
                right.span,
                "both sides must have the same unit",
            );
        }
        let scaled = [first, second].into_iter().filter_map(|side| side.unit);
        let scaled = scaled.into_iter().find(|unit| unit.is_scaled());
        let sides = [(first.is_bare(), left.span), (second.is_bare(), right.span)];
        self.refuse_bare_numbers(sides.into_iter(), scaled);
        let unit = first.unit.or(second.unit).unwrap_or(Unit::ONE);
        Some(([first.expr, second.expr], unit))
    }

    /// A coefficient of friction, which may depend on velocities.
    pub fn friction(&mut self, member: MemberId, friction: &'a Expression) -> Option<Expr<'d>> {
        self.coefficient_of_friction(member, friction, &limits::FRICTION)
    }

    /// A coefficient of friction that may depend on whatever its place allows.
    pub fn coefficient_of_friction(
        &mut self,
        member: MemberId,
        friction: &'a Expression,
        limit: &'static Limit,
    ) -> Option<Expr<'d>> {
        let scope = self.scope(member, limit);
        let reason = "a coefficient of friction has no unit";
        let scalar = self.scalar_in(friction, Unit::ONE, reason, scope)?;
        self.bound(BoundKind::Friction, scalar.expr, friction.span);
        Some(scalar.expr)
    }

    /// The word for a round object: `circle`, or `sphere` in space.
    pub fn circle_or_sphere_word(&self) -> &'static str {
        match self.space {
            Space::Plane => "circle",
            Space::Space => "sphere",
        }
    }

    /// `circle` or `sphere` with `inside`, `outside` or `along`: the objects in contact.
    pub fn touching(&mut self, member: MemberId, record: &'a Record) -> Option<Touching> {
        let circle = self.field(member, record, self.circle_or_sphere_word());
        let circle = circle.map(|circle| self.circle_at(member, circle));
        let surface = self.surface(member, record, circle.flatten());
        Some(Touching {
            circle: self.ordinal(circle??)?,
            surface: surface?,
        })
    }

    /// `inside`, `outside` or `along`: the surface touched by a circle, a sphere or another object.
    pub fn surface(
        &mut self,
        member: MemberId,
        record: &'a Record,
        circle: Option<MemberId>,
    ) -> Option<Surface> {
        let inside = record.get("inside");
        if inside.is_some() {
            self.conflict(record, "outside", "inside");
            self.conflict(record, "along", "inside");
        } else if record.get("outside").is_some() {
            self.conflict(record, "along", "outside");
        }
        let other = inside.or(record.get("outside"));
        if let (None, Some(along)) = (other, record.get("along")) {
            let scope = self.scope(member, &limits::POINT);
            return self.frame(along, scope).map(Surface::Along);
        }
        if other.is_none() {
            let base = self.base_name(member);
            let message = format!(
                "`{base}` needs the {} that it is `inside` or `outside`, or the frame `along` which it moves",
                self.circle_or_sphere_word()
            );
            self.missing_field(member, message);
        }
        let other_member = other.and_then(|other| self.circle_at(member, other))?;
        if circle == Some(other_member) {
            let message = format!("a {} does not touch itself", self.circle_or_sphere_word());
            self.error(Code::ConflictingFields, other?.span, message);
        }
        let other = self.ordinal(other_member)?;
        Some(match inside {
            Some(_) => Surface::Inside(other),
            None => Surface::Outside(other),
        })
    }

    /// The circle, or in space the sphere, that an expression names.
    pub fn circle_at(&mut self, member: MemberId, circle: &'a Expression) -> Option<MemberId> {
        let scope = self.scope(member, &limits::DEFINITION);
        match &circle.kind {
            ExpressionKind::Name(reference) => {
                let (namespace, none) = self.circle_or_sphere_namespace();
                self.named_member(namespace, none, reference, scope)
            }
            ExpressionKind::Error => None,
            _ => {
                let message = format!(
                    "the name of a {} is expected here",
                    self.circle_or_sphere_word()
                );
                self.error(Code::WrongKind, circle.span, message);
                None
            }
        }
    }

    /// The namespace of circles or spheres, and the beginning of the message for an unknown one.
    pub(super) fn circle_or_sphere_namespace(&self) -> (Namespace, &'static str) {
        match self.space {
            Space::Plane => (Namespace::CIRCLES, "no circle is"),
            Space::Space => (Namespace::SPHERES, "no sphere is"),
        }
    }
}
