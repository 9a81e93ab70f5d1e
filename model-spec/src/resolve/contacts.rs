//! Unilateral contacts: their geometry, their response and their friction.

use std::rc::Rc;

use super::Resolver;
use super::value::{MemberId, Vector, is_linear, limits};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::bounds::BoundKind;
use crate::model::polygons::{Corner, MOST_CORNERS, Polygon};
use crate::model::{
    Circle, Compliance, Contact, ContactGeometry, FrameOrBody, ImpactLaw, ImpactOrder,
    MOST_UNILATERAL, Name, Painleve, Response, Space, Surface, Touching, stage,
};
use crate::syntax::{Expression, ExpressionKind, Record};
use crate::unit::Unit;
use lagrangian_symbolic::Expr;

const VELOCITY: Unit = Unit::base(0, 1, -1);

/// The fields that give the geometry.
const GEOMETRY_FIELDS: [&str; 7] = [
    "circle", "sphere", "point", "on", "inside", "outside", "along",
];

/// The fields that describe the impact, which a compliant contact does not have.
const IMPACT_FIELDS: [&str; 5] = [
    "restitution",
    "tangential_restitution",
    "law",
    "order",
    "painleve",
];

/// A force law as it is written in a spec.
fn form(law: Compliance) -> &'static str {
    match law {
        Compliance::Linear => "linear(k, b)",
        Compliance::Hertz => "hertz(K)",
        Compliance::HuntCrossley => "hunt_crossley(K, c)",
        Compliance::Layer => "layer(k1, k2)",
    }
}

/// The units of its parameters, with the reasons for messages.
fn units(law: Compliance) -> Vec<(Unit, &'static str)> {
    let stiffness = (Unit::base(1, 0, -2), "a stiffness is in N/m");
    let of_hertz = Unit::base(2, -1, -4).power(1, 2).unwrap_or(Unit::ONE);
    let of_hertz = (of_hertz, "the stiffness of Hertz's law is in N/m^(3/2)");
    match law {
        Compliance::Linear => vec![
            stiffness,
            (Unit::base(1, 0, -1), "a damping coefficient is in N*s/m"),
        ],
        Compliance::Hertz => vec![of_hertz],
        Compliance::HuntCrossley => vec![
            of_hertz,
            (
                Unit::base(0, -1, 1),
                "the damping of Hunt and Crossley's law is in s/m",
            ),
        ],
        Compliance::Layer => vec![stiffness; 2],
    }
}

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// The contacts of an item: one, or those of all circles of a family, or of all corners of a body.
    pub fn contacts(&mut self, member: MemberId) -> Option<Vec<Contact<'d>>> {
        let record = self.record(member)?;
        let (one, family, [other, other_family]) = match self.space {
            Space::Plane => ("circle", "circles", ["sphere", "spheres"]),
            Space::Space => ("sphere", "spheres", ["circle", "circles"]),
        };
        for (foreign, here) in [(other, one), (other_family, family)] {
            if let Some(field) = record.field(foreign) {
                let message = format!("`{foreign}` has no meaning here");
                let diagnostic = Diagnostic::new(Code::WrongSpace, field.name.span, message);
                self.push(diagnostic.help(format!(
                    "use `{here}`: circles exist in the plane, spheres in space"
                )));
                return None;
            }
        }
        let geometries = self.geometries(member, record, [one, family]);
        let response = match record.get("compliance") {
            Some(written) => {
                for field in IMPACT_FIELDS {
                    self.conflict(record, field, "compliance");
                }
                self.compliance(member, written)
            }
            None => self.rigid(member, record),
        };
        let (friction, sticking) = self.friction_coefficients(member, record);
        let rolling = self.rolling_resistance(member, record);
        // A field that is present but wrong has been reported.
        let good = |written: Option<Option<Expr<'d>>>| match written {
            Some(value) => value.map(Some),
            None => Some(None),
        };
        let (response, friction, static_friction) = (response?, good(friction)?, good(sticking)?);
        let rolling_resistance = good(rolling)?;
        let span = self.span(member);
        let contact = |(name, geometry)| Contact {
            name,
            geometry,
            response,
            friction,
            static_friction,
            rolling_resistance,
            span,
        };
        Some(geometries?.into_iter().map(contact).collect())
    }

    /// The geometry of each contact of an item, with its name; `one` and `family` are the fields of round bodies in this space.
    fn geometries(
        &mut self,
        member: MemberId,
        record: &'a Record,
        [one, family]: [&str; 2],
    ) -> Option<Vec<(Name, ContactGeometry<'d>)>> {
        let name = self.name(member);
        if record.field(family).is_some() {
            for field in ["gap", "slip", "corners", "against", "of"]
                .iter()
                .chain(&GEOMETRY_FIELDS)
            {
                self.conflict(record, field, family);
            }
            self.pairs(member, record, family)
        } else if record.field("against").is_some() {
            for field in ["gap", "slip", one, "point", "inside", "outside", "along"] {
                self.conflict(record, field, "against");
            }
            self.polygons(member, record)
        } else if record.field("corners").is_some() {
            for field in ["gap", "slip", one, "point", "of"] {
                self.conflict(record, field, "corners");
            }
            self.corners(member, record)
        } else if ["gap", "slip"]
            .iter()
            .any(|field| record.field(field).is_some())
        {
            for field in GEOMETRY_FIELDS.iter().chain(&["of"]) {
                self.conflict(record, field, "gap");
            }
            let geometry = self.gap_and_slip(member, record);
            geometry.map(|geometry| vec![(name, geometry)])
        } else if record.field("point").is_some() {
            self.conflict(record, one, "point");
            self.conflict(record, "of", "point");
            let geometry = self.touching_point(member, record);
            geometry.map(|geometry| vec![(name, geometry)])
        } else {
            self.conflict(record, "on", one);
            self.conflict(record, "of", one);
            let touching = self.touching(member, record);
            touching.map(|touching| vec![(name, ContactGeometry::Circles(touching))])
        }
    }

    /// The coefficients of friction and of static friction, if they are given; `Some(None)` where one is wrong.
    fn friction_coefficients(
        &mut self,
        member: MemberId,
        record: &'a Record,
    ) -> (Option<Option<Expr<'d>>>, Option<Option<Expr<'d>>>) {
        let friction = record
            .get("friction")
            .map(|written| self.friction(member, written));
        for field in ["tangential_restitution", "static_friction"] {
            if let (None, Some(field)) = (&friction, record.field(field)) {
                let name = &field.name.text;
                let message = format!("`{name}` has no effect without `friction`");
                let diagnostic = Diagnostic::new(Code::MissingField, field.name.span, message);
                self.push(diagnostic.help("add `friction`, or leave it out"));
            }
        }
        let sticking = record.get("static_friction").map(|written| {
            let sticking = self.friction(member, written);
            if let (Some(sticking), Some(Some(friction))) = (sticking, friction) {
                self.bound(BoundKind::StaticFriction(friction), sticking, written.span);
            }
            sticking
        });
        (friction, sticking)
    }

    /// The coefficient of rolling resistance, if it is given; `Some(None)` where it is wrong.
    fn rolling_resistance(
        &mut self,
        member: MemberId,
        record: &'a Record,
    ) -> Option<Option<Expr<'d>>> {
        record.get("rolling_resistance").map(|written| {
            for other in [
                "gap", "slip", "point", "corners", "against", "sphere", "spheres",
            ] {
                if record.field(other).is_some() {
                    self.conflict(record, "rolling_resistance", other);
                }
            }
            let scope = self.scope(member, &limits::FRICTION);
            let reason = "a coefficient of rolling resistance is a length, in m";
            let scalar = self.scalar_in(written, Unit::METRE, reason, scope)?;
            self.bound(BoundKind::RollingResistance, scalar.expr, written.span);
            Some(scalar.expr)
        })
    }

    /// The contacts of `circles` or `spheres`, each of which may touch each other from outside.
    fn pairs(
        &mut self,
        member: MemberId,
        record: &'a Record,
        family: &str,
    ) -> Option<Vec<(Name, ContactGeometry<'d>)>> {
        let written = self.field(member, record, family)?;
        let one = self.circle_or_sphere_word();
        let reference = match &written.kind {
            ExpressionKind::Name(reference) if reference.index.is_none() => reference,
            ExpressionKind::Error => return None,
            _ => {
                let message = format!("the name of a family of {family} is expected here");
                self.error(Code::WrongKind, written.span, message);
                return None;
            }
        };
        let (namespace, none) = self.circle_or_sphere_namespace();
        let group = self.known_group(namespace, none, &reference.base)?;
        let mut circles: Vec<(Option<i64>, usize)> = Vec::new();
        for circle in self.members_under(group, None) {
            circles.push((self.name(circle).index, self.ordinal(circle)?));
        }
        let count = circles.len() * circles.len().saturating_sub(1) / 2;
        if count > MOST_UNILATERAL {
            let message = format!("{} {family} make {count} pairs", circles.len());
            let diagnostic = Diagnostic::new(Code::TooLarge, written.span, message);
            let help = format!("a machine may have at most {MOST_UNILATERAL} contacts");
            self.push(diagnostic.help(help));
            return None;
        }
        // A family may have one member, or none, and then has no pairs.
        if circles.len() < 2 && circles.iter().any(|(index, _)| index.is_none()) {
            let message = format!(
                "`{}` is one {one}, and a pair needs two",
                reference.base.text
            );
            let diagnostic = Diagnostic::new(Code::WrongKind, written.span, message);
            self.push(diagnostic.help(format!(
                "`{family}` names a family: `disc`, where `disc[i in 1..N]` are {family}"
            )));
            return None;
        }
        let base = self.name(member);
        let mut pairs = Vec::with_capacity(count);
        for (k, &(first, circle)) in circles.iter().enumerate() {
            for &(second, other) in &circles[..k] {
                let name = Name {
                    base: format!("{base}[{}]", first.unwrap_or_default()),
                    index: second,
                };
                let surface = Surface::Outside(other);
                let touching = Touching { circle, surface };
                pairs.push((name, ContactGeometry::Circles(touching)));
            }
        }
        Some(pairs)
    }

    /// The contacts of `corners` of a convex polygon, each a point; or of `outline`, the corners of
    /// the body that `on` names.
    fn corners(
        &mut self,
        member: MemberId,
        record: &'a Record,
    ) -> Option<Vec<(Name, ContactGeometry<'d>)>> {
        let written = self.field(member, record, "corners")?;
        let base = self.name(member).to_string();
        let points = match &written.kind {
            ExpressionKind::Tuple(corners) => self.points_on(member, record, corners)?,
            ExpressionKind::Name(name) if name.index.is_none() && name.base.text == "outline" => {
                self.outline_on(member, record, written.span)?
            }
            ExpressionKind::Error => return None,
            _ => {
                let message = match self.space {
                    Space::Plane => {
                        "corners are a list of points, `((-b, -h), (b, -h))`, or `outline`, those of the body"
                    }
                    Space::Space => "corners are a list of points, `((-a, -b, -c), (a, -b, -c))`",
                };
                self.error(Code::WrongKind, written.span, message);
                return None;
            }
        };
        let named = points.into_iter().zip(1..).map(|(geometry, k)| {
            let name = Name {
                base: base.clone(),
                index: Some(k),
            };
            (name, geometry)
        });
        Some(named.collect())
    }

    /// The contacts of `corners` of a convex polygon fixed to the place named by `on` with those of another, `against`, on the
    /// place named by `of`: each corner of either polygon is a contact with the other polygon.
    fn polygons(
        &mut self,
        member: MemberId,
        record: &'a Record,
    ) -> Option<Vec<(Name, ContactGeometry<'d>)>> {
        if self.space == Space::Space {
            let field = record.field("against")?;
            let message = "polygons touch each other only in the plane";
            let diagnostic = Diagnostic::new(Code::WrongSpace, field.name.span, message);
            self.push(diagnostic.help(
                "in space `corners` touch planes and spheres: `along`, `inside` or `outside`",
            ));
            return None;
        }
        let first = self.polygon(member, record, ["corners", "on"]);
        let second = self.polygon(member, record, ["against", "of"]);
        let (first, second) = (first?, second?);
        if let (Some(of), true) = (record.get("of"), first.on == second.on) {
            let message = "a polygon does not touch what is fixed to the same body or frame";
            self.error(Code::ConflictingFields, of.span, message);
            return None;
        }
        let base = self.name(member).to_string();
        let yields = record.get("compliance").is_some();
        let corners_of = |polygon: &Rc<Polygon<'d>>, other: &Rc<Polygon<'d>>| {
            let corner = |corner| {
                ContactGeometry::Corner(Corner {
                    corner,
                    polygon: polygon.clone(),
                    other_polygon: other.clone(),
                    yields,
                })
            };
            (0..polygon.corners.len()).map(corner).collect::<Vec<_>>()
        };
        let mut all = corners_of(&first, &second);
        all.extend(corners_of(&second, &first));
        let named = all.into_iter().zip(1..).map(|(geometry, k)| {
            let name = Name {
                base: base.clone(),
                index: Some(k),
            };
            (name, geometry)
        });
        Some(named.collect())
    }

    /// A convex polygon: its corners, and what it is fixed to.
    fn polygon(
        &mut self,
        member: MemberId,
        record: &'a Record,
        [corners, field]: [&str; 2],
    ) -> Option<Rc<Polygon<'d>>> {
        let written = self.field(member, record, corners);
        let place = self.field(member, record, field);
        let place = place.and_then(|on| self.place(member, on));
        let (written, on) = (written?, place?);
        let corners: Vec<Vec<Expr<'d>>> = match &written.kind {
            ExpressionKind::Tuple(points) => {
                let scope = self.scope(member, &limits::OUTLINE);
                let points: Vec<_> = (points.iter())
                    .map(|at| self.vector_in(at, "a point", Unit::METRE, "a point is in m", scope))
                    .collect();
                let points = points.into_iter().map(|point| Some(point?.components));
                points.collect::<Option<_>>()?
            }
            ExpressionKind::Name(name) if name.index.is_none() && name.base.text == "outline" => {
                self.outline_at(on, field, written.span)?
            }
            ExpressionKind::Error => return None,
            _ => {
                let message = "corners are a list of points, `((-b, -h), (b, -h), (0, h))`, or `outline`, those of the body";
                self.error(Code::WrongKind, written.span, message);
                return None;
            }
        };
        if corners.len() < 3 {
            let message = format!(
                "a polygon has at least three corners, found {}",
                corners.len()
            );
            let diagnostic = Diagnostic::new(Code::WrongKind, written.span, message);
            self.push(diagnostic.help("a single point of a body can be in contact as a `point`"));
            return None;
        }
        if corners.len() > MOST_CORNERS {
            let message = format!("a polygon with {} corners is too large", corners.len());
            let diagnostic = Diagnostic::new(Code::TooLarge, written.span, message);
            self.push(diagnostic.help(format!(
                "it may have at most {MOST_CORNERS}: use a circle for rounder shapes"
            )));
            return None;
        }
        let polygon = Polygon { on, corners };
        for turn in polygon.turns() {
            self.bound(BoundKind::Convex, turn, written.span);
        }
        Some(Rc::new(polygon))
    }

    /// The contact of `point`, fixed to the place named by `on`, with `inside`, `outside` or `along`.
    fn touching_point(
        &mut self,
        member: MemberId,
        record: &'a Record,
    ) -> Option<ContactGeometry<'d>> {
        let point = record.get("point")?;
        let points = self.points_on(member, record, std::slice::from_ref(point));
        points?.pop()
    }

    /// A point that is fixed to this place.
    pub fn point_on(
        &self,
        member: MemberId,
        on: FrameOrBody,
        center: Vec<Expr<'d>>,
        surface: Surface,
    ) -> ContactGeometry<'d> {
        ContactGeometry::Point {
            point: Circle {
                name: self.name(member),
                on,
                center,
                radius: self.dag.zero(),
                span: self.span(member),
            },
            surface,
        }
    }

    /// Contacts of points fixed to the place named by `on`, with `inside`, `outside` or `along`.
    fn points_on(
        &mut self,
        member: MemberId,
        record: &'a Record,
        points: &'a [Expression],
    ) -> Option<Vec<ContactGeometry<'d>>> {
        let on = self.field(member, record, "on");
        let on = on.and_then(|on| self.place(member, on));
        let scope = self.scope(member, &limits::RADIUS);
        let centers: Vec<_> = (points.iter())
            .map(|point| self.vector_in(point, "a point", Unit::METRE, "a point is in m", scope))
            .collect();
        let surface = self.surface(member, record, None)?;
        let on = on?;
        let geometry = |center: Option<Vector<'d>>| {
            Some(self.point_on(member, on, center?.components, surface))
        };
        centers.into_iter().map(geometry).collect()
    }

    fn gap_and_slip(
        &mut self,
        member: MemberId,
        record: &'a Record,
    ) -> Option<ContactGeometry<'d>> {
        let gap = self.field(member, record, "gap");
        let scope = self.scope(member, &limits::GAP);
        let place = gap.map(|gap| gap.span);
        let gap = gap.and_then(|gap| self.scalar_in(gap, Unit::METRE, "a gap is in m", scope));
        if let (Some(gap), Some(place)) = (&gap, place)
            && gap.expr.stage() < stage::POSITION
        {
            let message = "this gap depends on no coordinate, so the contact cannot close by a motion or press";
            let diagnostic = Diagnostic::new(Code::NoCoordinates, place, message);
            self.push(diagnostic.help("give a distance that depends on coordinates"));
            return None;
        }
        // Without friction nothing depends on the slip.
        let (slip, across) = match (record.get("slip"), record.field("friction")) {
            (None, None) => (Some(self.dag.zero()), None),
            (None, Some(_)) => {
                self.field(member, record, "slip");
                (None, None)
            }
            (Some(written), _) => match &written.kind {
                ExpressionKind::Tuple(parts) => {
                    if self.space == Space::Plane || parts.len() != 2 {
                        let message = "a slip is one velocity, and in space one or two: `(a, b)`";
                        self.error(Code::WrongDimension, written.span, message);
                        return None;
                    }
                    let [slip, across] = [0, 1].map(|k| self.slip(member, &parts[k]));
                    (slip, Some(across?))
                }
                _ => (self.slip(member, written), None),
            },
        };
        Some(ContactGeometry::Expressions {
            gap: gap?.expr,
            slip: slip?,
            across,
        })
    }

    /// A slip velocity in one direction.
    fn slip(&mut self, member: MemberId, written: &'a Expression) -> Option<Expr<'d>> {
        let scope = self.scope(member, &limits::SLIP);
        let reason = "a slip is a velocity, in m/s";
        let slip = self.scalar_in(written, VELOCITY, reason, scope)?.expr;
        let help = "a slip is a sum of terms a(q, t)*der(q)";
        if self.refuse_states(slip, written.span, "a slip", help) {
            return None;
        }
        if !is_linear(slip) {
            let message = "this slip is not linear in the velocities";
            let diagnostic = Diagnostic::new(Code::NotLinear, written.span, message);
            self.push(diagnostic.help(help));
        }
        Some(slip)
    }

    /// The response of a rigid contact.
    fn rigid(&mut self, member: MemberId, record: &'a Record) -> Option<Response<'d>> {
        let normal = self.field(member, record, "restitution");
        let normal = normal.and_then(|value| self.restitution(member, value));
        let tangential = match record.get("tangential_restitution") {
            Some(value) => self.restitution(member, value),
            None => Some(self.dag.zero()),
        };
        let law = match record.get("law") {
            Some(law) => self.keyword(law, "law of impact", &ImpactLaw::ALL, ImpactLaw::name),
            None => Some(ImpactLaw::default()),
        };
        let order = match record.get("order") {
            Some(written) => self.keyword(
                written,
                "order of impacts",
                &ImpactOrder::ALL,
                ImpactOrder::name,
            ),
            None => Some(ImpactOrder::default()),
        };
        let painleve = match record.get("painleve") {
            Some(written) => self.keyword(
                written,
                "treatment of paradoxes",
                &Painleve::ALL,
                Painleve::name,
            ),
            None => Some(Painleve::default()),
        };
        Some(Response::Rigid {
            law: law?,
            order: order?,
            painleve: painleve?,
            restitution: [normal?, tangential?],
        })
    }

    /// `linear(k, b)`: a force law with its parameters.
    fn compliance(&mut self, member: MemberId, written: &'a Expression) -> Option<Response<'d>> {
        let call = match &written.kind {
            ExpressionKind::Error => return None,
            ExpressionKind::Call(call) => Some(call),
            _ => None,
        };
        let named = call.and_then(|call| {
            let mut all = Compliance::ALL.into_iter();
            all.find(|law| law.name() == call.function.text)
        });
        let (Some(call), Some(law)) = (call, named) else {
            let (span, message) = match call {
                Some(call) => {
                    let name = &call.function.text;
                    (
                        call.function.span,
                        format!("no force law is called `{name}`"),
                    )
                }
                None => (written.span, "a force law is expected here".to_owned()),
            };
            let forms = Compliance::ALL.map(|law| format!("`{}`", form(law)));
            let diagnostic = Diagnostic::new(Code::UnknownName, span, message);
            self.push(diagnostic.help(format!("the laws are {}", forms.join(", "))));
            return None;
        };
        let units = units(law);
        if call.arguments.len() != units.len() {
            let message = format!(
                "`{}` takes {}, found {}",
                law.name(),
                if units.len() == 1 {
                    "one argument"
                } else {
                    "two arguments"
                },
                call.arguments.len()
            );
            let diagnostic = Diagnostic::new(Code::WrongArguments, written.span, message);
            self.push(diagnostic.help(format!("write `{}`", form(law))));
            return None;
        }
        let mut parameters = [Some(self.dag.zero()); 2];
        let places = parameters.iter_mut().zip(&call.arguments);
        let words = units.iter().zip(law.parameters());
        for ((parameter, argument), ((unit, reason), kind)) in places.zip(words) {
            let scope = self.scope(member, &limits::COMPLIANCE);
            let scalar = self.scalar_in(argument, *unit, reason, scope);
            *parameter = scalar.map(|scalar| scalar.expr);
            if let Some(value) = *parameter
                && *kind != "unloading"
            {
                let kind = match *kind {
                    "damping" => BoundKind::ContactDamping,
                    _ => BoundKind::ContactStiffness,
                };
                self.bound(kind, value, argument.span);
            }
        }
        let [first, second] = parameters;
        if let (Compliance::Layer, Some(loading), Some(unloading)) = (law, first, second)
            && let Some(argument) = call.arguments.last()
        {
            self.bound(BoundKind::Unloading(loading), unloading, argument.span);
        }
        Some(Response::Compliant {
            law,
            parameters: [first?, second?],
        })
    }

    fn restitution(&mut self, member: MemberId, value: &'a Expression) -> Option<Expr<'d>> {
        let scope = self.scope(member, &limits::RESTITUTION);
        let reason = "a coefficient of restitution has no unit";
        let scalar = self.scalar_in(value, Unit::ONE, reason, scope)?;
        self.bound(BoundKind::Restitution, scalar.expr, value.span);
        Some(scalar.expr)
    }

    /// One of the words that a field allows.
    fn keyword<T: Copy>(
        &mut self,
        written: &'a Expression,
        noun: &str,
        all: &[T],
        name: fn(T) -> &'static str,
    ) -> Option<T> {
        let word = match &written.kind {
            ExpressionKind::Name(reference) if reference.index.is_none() => {
                reference.base.text.as_str()
            }
            ExpressionKind::Error => return None,
            _ => "",
        };
        let known = all.iter().copied().find(|one| name(*one) == word);
        if known.is_none() {
            let message = match word {
                "" => format!("the name of a {noun} is expected here"),
                word => format!("no {noun} is called `{word}`"),
            };
            let names: Vec<String> = all.iter().map(|one| format!("`{}`", name(*one))).collect();
            let diagnostic = Diagnostic::new(Code::UnknownName, written.span, message);
            self.push(diagnostic.help(format!("it is one of {}", names.join(", "))));
        }
        known
    }
}
