//! Items: what a machine is made of, each field in its unit and of its kind.

use lagrangian_symbolic::{Expr, Id, Node, Rational, nearest};

use super::Resolver;
use super::expression::unit_text;
use super::names::{Content, Namespace, declared_measure, declared_unit, suggestion, with_help};
use super::value::{Limit, MemberId, Scalar, Scope, Value, Vector, limits};
use super::work::{Need, State};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::bounds::BoundKind;
use crate::model::circles;
use crate::model::{
    Action, Approximation, ApproximationKind, Body, Circle, Constant, Constraint, Contact,
    ContactGeometry, Coordinate, Elastic, Force, Frame, Inertia, Input, Local, Output, Parameter,
    Place, Rolling, Rotation, Sliding, Space, Surface, Term, Torque, Touching, stage,
};
use crate::source::Span;
use crate::syntax::{self, Expression, ExpressionKind, Quantity, Record, SectionKind};
use crate::unit::{Measure, Unit};

const STIFFNESS: Unit = Unit::base(1, 0, -2);
const DAMPING: Unit = Unit::base(1, 0, -1);
const INERTIA: Unit = Unit::base(1, 2, 0);
const VELOCITY: Unit = Unit::base(0, 1, -1);

/// The two energies that an elastic element has a share in: ½ c x², ½ b ẋ².
#[derive(Clone, Copy)]
struct ElasticKind {
    /// The field of the coefficient.
    coefficient: &'static str,
    /// The unit of the coefficient for a stretch in m.
    linear: Unit,
    /// The unit of coefficient times stretch squared.
    product: Unit,
    limit: &'static Limit,
}

impl ElasticKind {
    fn bound<'d>(self) -> BoundKind<'d> {
        match self.coefficient {
            "damping" => BoundKind::Damping,
            _ => BoundKind::Stiffness,
        }
    }
}

const SPRING: ElasticKind = ElasticKind {
    coefficient: "stiffness",
    linear: STIFFNESS,
    product: Unit::JOULE,
    limit: &limits::STIFFNESS,
};

const DAMPER: ElasticKind = ElasticKind {
    coefficient: "damping",
    linear: DAMPING,
    product: Unit::base(1, 2, -1),
    limit: &limits::DAMPING,
};

impl<'a, 'd> Resolver<'a, 'd, '_> {
    fn docs(&self, member: MemberId) -> String {
        self.declaration(member).docs.to_owned()
    }

    fn span(&self, member: MemberId) -> Span {
        self.declaration(member).name.span
    }

    fn record(&self, member: MemberId) -> Option<&'a Record> {
        match self.declaration(member).content {
            Content::Record(record) => Some(record),
            _ => None,
        }
    }

    pub fn quantity(&self, member: MemberId) -> Option<&'a Quantity> {
        match self.declaration(member).content {
            Content::Quantity(quantity) => Some(quantity),
            _ => None,
        }
    }

    /// A field that must be there.
    fn field(
        &mut self,
        member: MemberId,
        record: &'a Record,
        field: &str,
    ) -> Option<&'a Expression> {
        let found = record.get(field);
        if found.is_none() {
            let item = self.declaration(member).section.item();
            let base = &self.declaration(member).name.base.text;
            self.missing_field(
                member,
                format!("{item} needs `{field}`, and `{base}` has none"),
            );
        }
        found
    }

    fn missing_field(&mut self, member: MemberId, message: String) {
        let diagnostic = Diagnostic::new(Code::MissingField, self.span(member), message);
        let help = match self.declaration(member).section {
            SectionKind::Bodies => "a body is `name { mass: …, at: … }`",
            SectionKind::Springs => {
                "a spring is `name { stiffness: …, stretch: … }` or \
                 `name { stiffness: …, from: …, to: …, length: … }`"
            }
            SectionKind::TorsionSprings => "a torsion spring is `name { stiffness: …, twist: … }`",
            SectionKind::Dampers => {
                "a damper is `name { damping: …, stretch: … }` or \
                 `name { damping: …, from: …, to: … }`"
            }
            SectionKind::Forces => {
                "a force is `name { at: point, force: vector }` or \
                 `name { on: coordinate, value: … }`"
            }
            SectionKind::Torques => "a torque is `name { on: body, torque: … }`",
            SectionKind::Sliding => {
                "a sliding contact is `name { body: …, on: …, direction: …, friction: … }`"
            }
            SectionKind::Circles => "a circle is `name { on: …, center: …, radius: … }`",
            SectionKind::Rolling => {
                "it is `name { circle: …, inside: … }` or with `outside` or `along`"
            }
            _ => {
                "a contact is `name { circle: …, inside: …, restitution: …, friction: … }`, \
                 with `outside`, or with `gap` and `slip` in their place"
            }
        };
        self.push(diagnostic.help(help));
    }

    /// Reports a field that does not go with another.
    fn conflict(&mut self, record: &'a Record, field: &str, with: &str) {
        if let Some(field) = record.field(field) {
            let message = format!("`{}` does not go with `{with}`", field.name.text);
            let diagnostic = Diagnostic::new(Code::ConflictingFields, field.name.span, message);
            self.push(diagnostic.help("give one of them"));
        }
    }

    // Values.

    /// The value of a constant: what the caller sets, or what the spec says.
    pub fn constant_value(&mut self, member: MemberId, quantity: &'a Quantity) -> Value<'d> {
        let measure = declared_measure(quantity);
        let unit = measure.as_ref().map(|measure| measure.unit);
        let name = self.name(member).to_string();
        let set = self.overrides.iter().find(|(known, _)| *known == name);
        let mut scalar = match (set, &quantity.value) {
            (Some((_, value)), _) => self.bare(value.clone()),
            (None, Some(value)) => {
                let scope = self.scope(member, &limits::CONSTANT);
                let Some(scalar) = self.quantity_value(value, measure.as_ref(), scope) else {
                    return Value::Unknown;
                };
                scalar
            }
            (None, None) => return Value::Unknown, // the parser has said that it is missing
        };
        if let Some(measure) = measure.filter(|measure| !measure.is_si()) {
            scalar.expr = measure.in_si(self.dag) * scalar.expr;
            scalar.number = scalar.number.map(|number| number * measure.to_f64());
        }
        scalar.unit = unit.or(scalar.unit);
        Value::Scalar(scalar)
    }

    /// A value, measured in the unit that is declared for it: what is made of bare numbers is, and
    /// anything else is converted.
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
        let mut scalar = self.scalar(value, scope.hinting(unit))?;
        self.demand(scalar.unit, unit, value.span, "as its declaration says");
        if scalar.unit.is_none() {
            self.notice_angle(&scalar, unit, value.span);
        } else if !measure.is_si() {
            scalar.expr = measure.of_si(self.dag) * scalar.expr;
            scalar.number = scalar.number.map(|number| number / measure.to_f64());
        }
        Some(scalar)
    }

    /// Refuses a name that is that of a unit too, where no unit would tell the two apart: with an
    /// `h: s = 5`, `2*h` could be two hours.
    fn check_unit_name(&mut self, member: MemberId, value: &Scalar<'d>) {
        let name = &self.declaration(member).name.base;
        let measure = Measure::named(&name.text);
        let Some(measure) = measure.filter(|_| self.members[member].index.is_none()) else {
            return;
        };
        let alike = value.unit.unwrap_or(Unit::ONE) == measure.unit;
        // Who has written `deg = pi/180` means what the language means.
        let is_same = value.expr.stage() == stage::CONSTANT
            && (nearest(value.expr) - measure.to_f64()).abs() <= 1e-15 * measure.to_f64();
        if alike && !is_same {
            let unit = name.text.as_str();
            let message = format!("`{unit}` is a unit of the same kind as what is declared here");
            let diagnostic = Diagnostic::new(Code::ReservedName, name.span, message);
            let help = format!("`2*{unit}` could be either: give it another name");
            self.push(diagnostic.help(help));
        }
    }

    fn unit_text(&self, member: MemberId, unit: Unit) -> String {
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
        self.check_symbol_name(member);
        let scope = self.scope(member, &limits::DEFAULT);
        let default = match &quantity.value {
            Some(value) => Some(self.quantity_value(value, measure.as_ref(), scope)?.expr),
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
        let measure = declared_measure(quantity);
        let unit = measure.as_ref().map(|measure| measure.unit);
        let scope = self.scope(member, &limits::OUTPUT);
        let value = self.quantity_value(quantity.value.as_ref()?, measure.as_ref(), scope)?;
        let unit = unit?;
        Some(Output {
            name: self.name(member),
            docs: self.docs(member),
            unit,
            unit_text: self.unit_text(member, unit),
            value: value.expr,
            span: self.span(member),
        })
    }

    /// A definition is worked out even if nothing uses it: what is wrong in it is wrong.
    pub fn definition(&mut self, member: MemberId) {
        if let Value::Scalar(scalar) = self.value_of(member, self.span(member)) {
            self.check_unit_name(member, &scalar);
        }
    }

    fn check_symbol_name(&mut self, member: MemberId) {
        if let Value::Scalar(scalar) = self.members[member].value.clone() {
            self.check_unit_name(member, &scalar);
        }
    }

    /// Whether a coordinate, or its rate, is declared in an SI unit. The state of a run is in SI
    /// units: tolerances, matrices and modes of it are.
    pub fn is_unit_of_state(&mut self, quantity: &'a Quantity, unit: Option<Unit>) -> bool {
        let (Some(written), Some(unit)) = (&quantity.unit, unit) else {
            return true; // which has been reported
        };
        if !unit.is_scaled() {
            return true;
        }
        let base = unit.as_written(false);
        let message = format!("a coordinate and its rate are in SI units, here {base}");
        let diagnostic = Diagnostic::new(Code::UnitOfState, written.span, message);
        let number = match quantity.value.as_ref().map(|value| &value.kind) {
            Some(ExpressionKind::Number(number)) => number.as_str(),
            _ => "30",
        };
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

    /// The mass centre of a body: where the spec says, or at the origin of its frame.
    pub fn mass_centre(&mut self, member: MemberId, record: &'a Record) -> Value<'d> {
        if let Some(at) = record.get("at") {
            let scope = self.scope(member, &limits::POSITION);
            let why = "a point is in m";
            return match self.vector_in(at, "a point", Unit::METRE, why, scope) {
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
            let message = "this body has an inertia, and nothing says how it turns";
            let diagnostic = Diagnostic::new(Code::MissingRotation, inertia.name.span, message);
            self.push(diagnostic.help(match self.space {
                Space::Plane => "give it an `angle` or a `frame`; without inertia it is a particle",
                Space::Space => "give it a `frame`; without inertia it is a particle",
            }));
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
            local: at.local.map(|(pose, point)| Local { pose, point }),
            rotation: rotation?,
            span,
            place: record
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
                // A number here is the planar habit, and worth more than «found a number».
                match self.value(inertia, scope.hinting(INERTIA)) {
                    Value::Vector(moments) => {
                        self.demand(
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
        // A thin rod has none about its axis; so zero is fine.
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
        Some(Inertia::Tensor(entries?.try_into().ok()?))
    }

    fn rotation(&mut self, member: MemberId, record: &'a Record) -> Option<Rotation<'d>> {
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
            let message = "in space a body is not turned by one angle";
            let diagnostic = Diagnostic::new(Code::WrongSpace, angle.name.span, message);
            self.push(diagnostic.help("give it a frame: `frame: ground.turn(z, angle)`"));
            return None;
        }
        let scope = self.scope(member, &limits::ROTATION);
        let why = "a body turns by an angle in rad";
        let angle = self.scalar_in(&angle.value, Unit::RADIAN, why, scope)?;
        Some(Rotation::Angle(angle.expr))
    }

    // What stores and what dissipates energy.

    pub fn spring(&mut self, member: MemberId) -> Option<Elastic<'d>> {
        self.elastic(member, SPRING)
    }

    pub fn damper(&mut self, member: MemberId) -> Option<Elastic<'d>> {
        self.elastic(member, DAMPER)
    }

    fn elastic(&mut self, member: MemberId, kind: ElasticKind) -> Option<Elastic<'d>> {
        let record = self.record(member)?;
        let coefficient = self.field(member, record, kind.coefficient);
        let coefficient = coefficient.map(|coefficient| {
            let scope = self.scope(member, kind.limit).hinting(kind.linear);
            (self.scalar(coefficient, scope), coefficient.span)
        });
        let mut ends = None;
        let stretch = match (record.get("stretch"), record.get("from"), record.get("to")) {
            (Some(stretch), ..) => {
                for field in ["from", "to", "length"] {
                    self.conflict(record, field, "stretch");
                }
                let scope = self.scope(member, &limits::STRETCH).hinting(Unit::METRE);
                self.scalar(stretch, scope)
                    .map(|scalar| (scalar, stretch.span))
            }
            (None, Some(from), Some(to)) => {
                let from_end = self.point(member, from);
                let to_end = self.point(member, to);
                let length = self.free_length(member, record);
                match (from_end, to_end, length) {
                    (Some(from_end), Some(to_end), Some(length)) => {
                        let line: Vec<Expr<'d>> = to_end
                            .iter()
                            .zip(&from_end)
                            .map(|(&to, &from)| to - from)
                            .collect();
                        ends = Some([from_end, to_end]);
                        let stretch = Scalar {
                            expr: self.stretch(&line, length),
                            unit: Some(Unit::METRE),
                            number: None,
                        };
                        Some((stretch, from.span.to(to.span)))
                    }
                    _ => None,
                }
            }
            (None, from, to) => {
                let base = &self.declaration(member).name.base.text;
                let item = self.declaration(member).section.item();
                let message = match (from, to) {
                    (Some(_), None) => format!("`{base}` has a `from` and no `to`"),
                    (None, Some(_)) => format!("`{base}` has a `to` and no `from`"),
                    _ => {
                        format!("{item} needs `stretch`, or `from` and `to`; `{base}` has neither")
                    }
                };
                self.missing_field(member, message);
                None
            }
        };
        let (stretch, stretch_span) = stretch?;
        let (coefficient, coefficient_span) = coefficient?;
        let coefficient = coefficient?;
        self.check_elastic(kind, &coefficient, coefficient_span, &stretch, stretch_span);
        self.bound(kind.bound(), coefficient.expr, coefficient_span);
        Some(Elastic {
            name: self.name(member),
            docs: self.docs(member),
            coefficient: coefficient.expr,
            stretch: stretch.expr,
            ends,
            torsional: false,
            span: self.span(member),
        })
    }

    /// How far apart two points are, less a free length: √(u·u), or what is assumed not to be
    /// negative and has that square.
    ///
    /// So the ends of a spring in polar coordinates are `r` apart, and points of one line `b − a`: no
    /// root is left, and no quotient by it in the force. The run checks what is assumed.
    fn stretch(&self, line: &[Expr<'d>], free: Expr<'d>) -> Expr<'d> {
        let length = circles::distance(line, &self.facts);
        match length.node() {
            // Added up as one sum, so that a free length in it cancels.
            Node::Sum(terms) => {
                let term = |(id, factor): &(Id, Rational)| self.dag.expr(*id) * factor.clone();
                self.dag.sum(terms.iter().map(term).chain([-free]))
            }
            _ => length - free,
        }
    }

    /// A point of the machine, in m.
    fn point(&mut self, member: MemberId, point: &'a Expression) -> Option<Vec<Expr<'d>>> {
        let scope = self.scope(member, &limits::POINT);
        let point = self.vector_in(point, "a point", Unit::METRE, "a point is in m", scope)?;
        Some(point.components)
    }

    /// The free length of a spring between two points: zero if it is not given.
    fn free_length(&mut self, member: MemberId, record: &'a Record) -> Option<Expr<'d>> {
        let Some(length) = record.get("length") else {
            return Some(self.dag.zero());
        };
        let scope = self.scope(member, &limits::STRETCH);
        let length = self.scalar_in(length, Unit::METRE, "a length is in m", scope)?;
        Some(length.expr)
    }

    /// Coefficient times stretch squared is an energy, or a power over the rates. If it is not, the
    /// one that is unlike any spring or damper is wrong.
    fn check_elastic(
        &mut self,
        kind: ElasticKind,
        coefficient: &Scalar<'d>,
        coefficient_span: Span,
        stretch: &Scalar<'d>,
        stretch_span: Span,
    ) {
        let (Some(c), Some(x)) = (coefficient.unit, stretch.unit) else {
            return; // a bare number takes any unit
        };
        if c.times(x).times(x) == kind.product {
            return;
        }
        let why = format!("`{}` is in N/m for a stretch in m", kind.coefficient);
        let why = why.replace("N/m", &kind.linear.to_string());
        if c == kind.linear {
            self.demand(Some(x), Unit::METRE, stretch_span, &why);
        } else {
            let expected = kind.product.over(x.times(x));
            let expected = if x == Unit::METRE {
                kind.linear
            } else {
                expected
            };
            let message = format!("expected {}, found {}", unit_text(expected), unit_text(c));
            let diagnostic = Diagnostic::new(Code::UnitMismatch, coefficient_span, message);
            let note = format!("the stretch is in {}", unit_text(x));
            self.push(diagnostic.help(why).note(stretch_span, note));
        }
    }

    pub fn torsion_spring(&mut self, member: MemberId) -> Option<Elastic<'d>> {
        let record = self.record(member)?;
        let stiffness = self.field(member, record, "stiffness");
        let twist = self.field(member, record, "twist");
        let scope = self.scope(member, &limits::STIFFNESS);
        let why = "a torsional stiffness is in N*m, per radian";
        let stiffness = stiffness.and_then(|k| {
            let scalar = self.scalar_in(k, Unit::JOULE, why, scope)?;
            self.bound(BoundKind::Stiffness, scalar.expr, k.span);
            Some(scalar)
        });
        let scope = self.scope(member, &limits::STRETCH);
        let why = "a twist is an angle in rad";
        let twist = twist.and_then(|angle| self.scalar_in(angle, Unit::RADIAN, why, scope));
        Some(Elastic {
            name: self.name(member),
            docs: self.docs(member),
            coefficient: stiffness?.expr,
            stretch: twist?.expr,
            ends: None,
            torsional: true,
            span: self.span(member),
        })
    }

    pub fn potential(&mut self, member: MemberId) -> Option<Term<'d>> {
        self.term(member, Unit::JOULE, "an energy is in J", &limits::POTENTIAL)
    }

    pub fn dissipation(&mut self, member: MemberId) -> Option<Term<'d>> {
        let why = "a dissipation function is in W: 1/2*b*der(x)^2";
        self.term(member, Unit::WATT, why, &limits::DISSIPATION)
    }

    fn term(
        &mut self,
        member: MemberId,
        unit: Unit,
        why: &str,
        limit: &'static Limit,
    ) -> Option<Term<'d>> {
        let Content::Expression(value) = self.declaration(member).content else {
            return None;
        };
        let value = self.scalar_in(value, unit, why, self.scope(member, limit))?;
        Some(Term {
            name: self.name(member),
            docs: self.docs(member),
            value: value.expr,
            span: self.span(member),
        })
    }

    // What acts.

    pub fn force(&mut self, member: MemberId) -> Option<Force<'d>> {
        let record = self.record(member)?;
        let at_point = ["at", "force"]
            .iter()
            .any(|field| record.field(field).is_some());
        let on_coordinate = ["on", "value"]
            .iter()
            .any(|field| record.field(field).is_some());
        let action = if at_point {
            if on_coordinate {
                let with = if record.field("at").is_some() {
                    "at"
                } else {
                    "force"
                };
                self.conflict(record, "on", with);
                self.conflict(record, "value", with);
            }
            let at = self.field(member, record, "at");
            let force = self.field(member, record, "force");
            let at = at.and_then(|at| self.point(member, at));
            let scope = self.scope(member, &limits::FORCE);
            let why = "a force is in N";
            let force =
                force.and_then(|force| self.vector_in(force, "a vector", Unit::NEWTON, why, scope));
            Action::Point {
                at: at?,
                force: force?.components,
            }
        } else if on_coordinate {
            let on = self.field(member, record, "on");
            let value = self.field(member, record, "value");
            let coordinate = on.and_then(|on| self.coordinate_at(member, on));
            let scope = self.scope(member, &limits::FORCE);
            let unit = coordinate.and_then(|coordinate| self.unit_of(coordinate));
            let value = value.and_then(|value| match unit {
                Some(unit) => {
                    let why = "a generalized force does work along its coordinate";
                    self.scalar_in(value, Unit::JOULE.over(unit), why, scope)
                }
                None => self.scalar(value, scope),
            });
            Action::Coordinate {
                coordinate: self.ordinal(coordinate?)?,
                value: value?.expr,
            }
        } else {
            let base = &self.declaration(member).name.base.text;
            let message = format!(
                "a force needs `at` and `force`, or `on` and `value`; `{base}` has neither"
            );
            self.missing_field(member, message);
            return None;
        };
        Some(Force {
            name: self.name(member),
            docs: self.docs(member),
            action,
            span: self.span(member),
        })
    }

    /// The unit of a coordinate.
    pub fn unit_of(&self, coordinate: MemberId) -> Option<Unit> {
        declared_unit(self.quantity(coordinate)?)
    }

    /// The coordinate that an expression names.
    fn coordinate_at(&mut self, member: MemberId, on: &'a Expression) -> Option<MemberId> {
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
                self.push(diagnostic.help("a torque on a body stands under `torques`"));
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

    pub fn torque(&mut self, member: MemberId) -> Option<Torque<'d>> {
        let record = self.record(member)?;
        let on = self.field(member, record, "on");
        let torque = self.field(member, record, "torque");
        let body = on.and_then(|on| self.turning_body(member, on));
        let scope = self.scope(member, &limits::FORCE);
        let why = "a torque is in N*m";
        let torque = torque.and_then(|torque| match self.space {
            Space::Plane => {
                let scalar = self.scalar_in(torque, Unit::JOULE, why, scope)?;
                Some(vec![scalar.expr])
            }
            Space::Space => {
                let vector = self.vector_in(torque, "a vector", Unit::JOULE, why, scope)?;
                Some(vector.components)
            }
        });
        Some(Torque {
            name: self.name(member),
            docs: self.docs(member),
            body: self.ordinal(body?)?,
            torque: torque?,
            span: self.span(member),
        })
    }

    /// The body that an expression names.
    fn body_at(&mut self, member: MemberId, on: &'a Expression) -> Option<MemberId> {
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

    /// The body that an expression names, which must be known to turn.
    fn turning_body(&mut self, member: MemberId, on: &'a Expression) -> Option<MemberId> {
        let body = self.body_at(member, on)?;
        let turns = self.record(body).is_some_and(|record| {
            record.field("frame").is_some() || record.field("angle").is_some()
        });
        if !turns {
            let name = self.name(body);
            let message = format!("nothing says how the body `{name}` turns");
            let diagnostic = Diagnostic::new(Code::MissingRotation, on.span, message);
            self.push(diagnostic.help("give it an `angle` or a `frame`"));
        }
        Some(body)
    }

    /// A frame or a body: what something slides on, or a circle is fixed to.
    fn place(&mut self, member: MemberId, on: &'a Expression) -> Option<Place> {
        let scope = self.scope(member, &limits::POINT);
        let value = match &on.kind {
            ExpressionKind::Name(reference) => {
                self.frame_or_body(reference, on.span, "origin", scope)
            }
            _ => self.value(on, scope),
        };
        match value {
            Value::Frame(pose) => Some(Place::Frame(pose)),
            Value::Body(body) => Some(Place::Body(self.ordinal(body)?)),
            Value::Unknown => None,
            other => {
                self.wrong_kind("a frame or a body", &other, on);
                None
            }
        }
    }

    // Constraints and contacts.

    pub fn constraint(&mut self, member: MemberId) -> Option<Constraint<'d>> {
        let Content::Equation(equation) = self.declaration(member).content else {
            return None;
        };
        let scope = self.scope(member, &limits::CONSTRAINT);
        let ([left, right], unit) = self.sides(&equation.left, &equation.right, scope)?;
        let expression = left - right;
        let span = equation.left.span.to(equation.right.span);
        if expression.stage() < stage::POSITION {
            let message = "this constrains no coordinate";
            self.error(Code::NoCoordinates, span, message);
        } else if expression.stage() == stage::VELOCITY && !self.is_linear(expression) {
            let message = "this constraint is not linear in the velocities";
            let diagnostic = Diagnostic::new(Code::NotLinear, span, message);
            self.push(
                diagnostic.help("a nonholonomic constraint is a sum of terms a(q, t)*der(q)"),
            );
        }
        Some(Constraint {
            name: self.name(member),
            expression,
            unit,
            span: self.span(member),
        })
    }

    /// Left side less right side, of one unit.
    pub fn difference(
        &mut self,
        left: &'a Expression,
        right: &'a Expression,
        scope: Scope<'a>,
    ) -> Option<Expr<'d>> {
        let ([left, right], _) = self.sides(left, right, scope)?;
        Some(left - right)
    }

    /// Both sides of a relation, and their unit; of bare numbers it is 1.
    pub fn sides(
        &mut self,
        left: &'a Expression,
        right: &'a Expression,
        scope: Scope<'a>,
    ) -> Option<([Expr<'d>; 2], Unit)> {
        let first = self.scalar(left, scope);
        let hint = first.and_then(|first| first.unit);
        let second = self.scalar(right, scope.hinting(hint));
        let (first, second) = (first?, second?);
        if let Some(unit) = first.unit {
            self.demand(second.unit, unit, right.span, "both sides have one unit");
        }
        let scaled = [first, second].into_iter().filter_map(|side| side.unit);
        let scaled = scaled.into_iter().find(|unit| unit.is_scaled());
        let sides = [(first.is_bare(), left.span), (second.is_bare(), right.span)];
        self.no_bare_number(sides.into_iter(), scaled);
        let unit = first.unit.or(second.unit).unwrap_or(Unit::ONE);
        Some(([first.expr, second.expr], unit))
    }

    /// Whether no derivative with respect to a velocity depends on a velocity.
    fn is_linear(&self, expression: Expr<'d>) -> bool {
        expression
            .symbols()
            .into_iter()
            .filter(|&symbol| self.dag.stage_of(symbol) == stage::VELOCITY)
            .all(|symbol| expression.diff(symbol).stage() < stage::VELOCITY)
    }

    pub fn sliding(&mut self, member: MemberId) -> Option<Sliding<'d>> {
        let record = self.record(member)?;
        let body = self.field(member, record, "body");
        let on = self.field(member, record, "on");
        let direction = self.field(member, record, "direction");
        let friction = self.field(member, record, "friction");
        let body = body.and_then(|body| self.body_at(member, body));
        let on = on.and_then(|on| self.place(member, on));
        let scope = self.scope(member, &limits::DIRECTION);
        let direction = direction.and_then(|direction| self.vector(direction, "a vector", scope));
        let normal = record.get("normal");
        let normal = normal.map(|normal| self.vector(normal, "a vector", scope));
        let friction = friction.and_then(|friction| self.friction(member, friction));
        let sticking = record.get("static_friction");
        let sticking = sticking.map(|said| {
            let sticking = self.friction(member, said);
            if let (Some(sticking), Some(friction)) = (sticking, friction) {
                self.bound(BoundKind::StaticFriction(friction), sticking, said.span);
            }
            sticking
        });
        Some(Sliding {
            name: self.name(member),
            body: self.ordinal(body?)?,
            on: on?,
            direction: direction?.components,
            // What is said and wrong has been reported.
            normal: match normal {
                Some(normal) => Some(normal?.components),
                None => None,
            },
            friction: friction?,
            static_friction: match sticking {
                Some(friction) => Some(friction?),
                None => None,
            },
            span: self.span(member),
        })
    }

    fn friction(&mut self, member: MemberId, friction: &'a Expression) -> Option<Expr<'d>> {
        self.coefficient_of_friction(member, friction, &limits::FRICTION)
    }

    fn coefficient_of_friction(
        &mut self,
        member: MemberId,
        friction: &'a Expression,
        limit: &'static Limit,
    ) -> Option<Expr<'d>> {
        let scope = self.scope(member, limit);
        let why = "a coefficient of friction has no unit";
        let scalar = self.scalar_in(friction, Unit::ONE, why, scope)?;
        self.bound(BoundKind::Friction, scalar.expr, friction.span);
        Some(scalar.expr)
    }

    pub fn circle(&mut self, member: MemberId) -> Option<Circle<'d>> {
        let record = self.record(member)?;
        if self.space == Space::Space {
            let message = "circles exist only in the plane";
            self.error(Code::WrongSpace, self.span(member), message);
            return None;
        }
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

    /// `circle` with `inside`, `outside` or `along`: what touches what.
    fn touching(&mut self, member: MemberId, record: &'a Record) -> Option<Touching> {
        let circle = self.field(member, record, "circle");
        let inside = record.get("inside");
        if inside.is_some() {
            self.conflict(record, "outside", "inside");
            self.conflict(record, "along", "inside");
        } else if record.get("outside").is_some() {
            self.conflict(record, "along", "outside");
        }
        let other = inside.or(record.get("outside"));
        if let (None, Some(along)) = (other, record.get("along")) {
            let circle = circle.and_then(|circle| self.circle_at(member, circle));
            let scope = self.scope(member, &limits::POINT);
            let pose = self.frame(along, scope);
            return Some(Touching {
                circle: self.ordinal(circle?)?,
                surface: Surface::Along(pose?),
            });
        }
        if other.is_none() {
            let base = &self.declaration(member).name.base.text;
            let message = format!(
                "`{base}` needs the circle that it is `inside` or `outside`, or the frame `along` which it moves"
            );
            self.missing_field(member, message);
        }
        let circle_member = circle.and_then(|circle| self.circle_at(member, circle));
        let other_member = other.and_then(|other| self.circle_at(member, other));
        let (circle_member, other_member) = (circle_member?, other_member?);
        if circle_member == other_member {
            let message = "a circle does not touch itself";
            self.error(Code::ConflictingFields, other?.span, message);
        }
        Some(Touching {
            circle: self.ordinal(circle_member)?,
            surface: {
                let other = self.ordinal(other_member)?;
                match inside {
                    Some(_) => Surface::Inside(other),
                    None => Surface::Outside(other),
                }
            },
        })
    }

    fn circle_at(&mut self, member: MemberId, circle: &'a Expression) -> Option<MemberId> {
        let scope = self.scope(member, &limits::DEFINITION);
        match &circle.kind {
            ExpressionKind::Name(reference) => {
                self.named_member(Namespace::CIRCLES, "no circle is", reference, scope)
            }
            ExpressionKind::Error => None,
            _ => {
                let message = "the name of a circle is expected here";
                self.error(Code::WrongKind, circle.span, message);
                None
            }
        }
    }

    pub fn rolling(&mut self, member: MemberId) -> Option<Rolling<'d>> {
        let record = self.record(member)?;
        let friction = record.get("friction").map(|friction| {
            self.coefficient_of_friction(member, friction, &limits::FRICTION_OF_ROLLING)
        });
        Some(Rolling {
            circles: self.touching(member, record)?,
            friction: match friction {
                Some(friction) => Some(friction?),
                None => None,
            },
            name: self.name(member),
            span: self.span(member),
        })
    }

    pub fn contact(&mut self, member: MemberId) -> Option<Contact<'d>> {
        let record = self.record(member)?;
        let by_expressions = ["gap", "slip"]
            .iter()
            .any(|field| record.field(field).is_some());
        let geometry = if by_expressions {
            for field in ["circle", "inside", "outside", "along"] {
                self.conflict(record, field, "gap");
            }
            self.gap_and_slip(member, record)
        } else {
            self.touching(member, record).map(ContactGeometry::Circles)
        };
        let restitution = self.field(member, record, "restitution");
        let restitution = restitution.and_then(|value| self.restitution(member, value));
        let friction = match record.get("friction") {
            Some(friction) => self.friction(member, friction),
            None => Some(self.dag.zero()),
        };
        Some(Contact {
            name: self.name(member),
            geometry: geometry?,
            restitution: restitution?,
            friction: friction?,
            span: self.span(member),
        })
    }

    fn gap_and_slip(
        &mut self,
        member: MemberId,
        record: &'a Record,
    ) -> Option<ContactGeometry<'d>> {
        let gap = self.field(member, record, "gap");
        let scope = self.scope(member, &limits::GAP);
        let gap = gap.and_then(|gap| self.scalar_in(gap, Unit::METRE, "a gap is in m", scope));
        // Without friction nothing depends on the slip.
        let slip = match (record.get("slip"), record.field("friction")) {
            (None, None) => Some(self.dag.zero()),
            (None, Some(_)) => {
                self.field(member, record, "slip");
                None
            }
            (Some(slip), _) => {
                let scope = self.scope(member, &limits::SLIP);
                let why = "a slip is a velocity, in m/s";
                self.scalar_in(slip, VELOCITY, why, scope)
                    .map(|slip| slip.expr)
            }
        };
        Some(ContactGeometry::Expressions {
            gap: gap?.expr,
            slip: slip?,
        })
    }

    fn restitution(&mut self, member: MemberId, value: &'a Expression) -> Option<Expr<'d>> {
        let scope = self.scope(member, &limits::RESTITUTION);
        let why = "a coefficient of restitution has no unit";
        let scalar = self.scalar_in(value, Unit::ONE, why, scope)?;
        self.bound(BoundKind::Restitution, scalar.expr, value.span);
        Some(scalar.expr)
    }

    // The rest.

    /// The coordinates that an approximation is about: one, or all of a family.
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
                let why = "`frozen` puts sin θ → 0 and cos θ → 1, which is about angles";
                self.demand(self.unit_of(coordinate), Unit::RADIAN, span, why);
            }
            found.extend(self.ordinal(coordinate).map(|coordinate| Approximation {
                coordinate,
                kind,
                span,
            }));
        }
        found
    }

    /// The coordinates that bear the name of an item: one, or all of a family.
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
