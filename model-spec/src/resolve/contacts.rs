//! Unilateral contacts: what touches what, how it bounces and how it rubs.

use super::Resolver;
use super::value::{MemberId, is_linear, limits};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::bounds::BoundKind;
use crate::model::{Circle, Contact, ContactGeometry, ImpactLaw, Space};
use crate::syntax::{Expression, ExpressionKind, Record};
use crate::unit::Unit;
use lagrangian_symbolic::Expr;

const VELOCITY: Unit = Unit::base(0, 1, -1);

/// The fields that say what touches what.
const GEOMETRY: [&str; 6] = ["circle", "point", "on", "inside", "outside", "along"];

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// A unilateral contact.
    pub fn contact(&mut self, member: MemberId) -> Option<Contact<'d>> {
        let record = self.record(member)?;
        let by_expressions = ["gap", "slip"]
            .iter()
            .any(|field| record.field(field).is_some());
        let geometry = if by_expressions {
            for field in GEOMETRY {
                self.conflict(record, field, "gap");
            }
            self.gap_and_slip(member, record)
        } else if record.field("point").is_some() {
            self.conflict(record, "circle", "point");
            self.touching_point(member, record)
        } else {
            self.conflict(record, "on", "circle");
            self.touching(member, record).map(ContactGeometry::Circles)
        };
        let restitution = self.field(member, record, "restitution");
        let restitution = restitution.and_then(|value| self.restitution(member, value));
        let tangential = match record.get("tangential_restitution") {
            Some(value) => self.restitution(member, value),
            None => Some(self.dag.zero()),
        };
        let friction = record
            .get("friction")
            .map(|said| self.friction(member, said));
        for field in ["tangential_restitution", "static_friction"] {
            if let (None, Some(field)) = (&friction, record.field(field)) {
                let name = &field.name.text;
                let message = format!("`{name}` says nothing where there is no `friction`");
                let diagnostic = Diagnostic::new(Code::MissingField, field.name.span, message);
                self.push(diagnostic.help("add `friction`, or leave it out"));
            }
        }
        let sticking = record.get("static_friction").map(|said| {
            let sticking = self.friction(member, said);
            if let (Some(sticking), Some(Some(friction))) = (sticking, friction) {
                self.bound(BoundKind::StaticFriction(friction), sticking, said.span);
            }
            sticking
        });
        let law = match record.get("law") {
            Some(law) => self.law(law),
            None => Some(ImpactLaw::default()),
        };
        // What is said and wrong has been reported.
        let good = |said: Option<Option<Expr<'d>>>| match said {
            Some(value) => value.map(Some),
            None => Some(None),
        };
        Some(Contact {
            name: self.name(member),
            geometry: geometry?,
            restitution: restitution?,
            tangential_restitution: tangential?,
            friction: good(friction)?,
            static_friction: good(sticking)?,
            law: law?,
            span: self.span(member),
        })
    }

    /// `point`, fixed to what is named by `on`, with `inside`, `outside` or `along`.
    fn touching_point(
        &mut self,
        member: MemberId,
        record: &'a Record,
    ) -> Option<ContactGeometry<'d>> {
        if self.space == Space::Space {
            let message = "points touch lines and circles only in the plane";
            self.error(Code::WrongSpace, self.span(member), message);
            return None;
        }
        let on = self.field(member, record, "on");
        let on = on.and_then(|on| self.place(member, on));
        let scope = self.scope(member, &limits::RADIUS);
        let point = record.get("point").and_then(|point| {
            self.vector_in(point, "a point", Unit::METRE, "a point is in m", scope)
        });
        let surface = self.surface(member, record, None);
        Some(ContactGeometry::Point {
            point: Circle {
                name: self.name(member),
                on: on?,
                center: point?.components,
                radius: self.dag.zero(),
                span: self.span(member),
            },
            surface: surface?,
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
            (Some(said), _) => {
                let scope = self.scope(member, &limits::SLIP);
                let why = "a slip is a velocity, in m/s";
                let slip = self.scalar_in(said, VELOCITY, why, scope);
                let slip = slip.map(|slip| slip.expr);
                if slip.is_some_and(|slip| !is_linear(slip)) {
                    let message = "this slip is not linear in the velocities";
                    let diagnostic = Diagnostic::new(Code::NotLinear, said.span, message);
                    self.push(diagnostic.help("a slip is a sum of terms a(q, t)*der(q)"));
                }
                slip
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

    fn law(&mut self, said: &'a Expression) -> Option<ImpactLaw> {
        let word = match &said.kind {
            ExpressionKind::Name(reference) if reference.index.is_none() => {
                reference.base.text.as_str()
            }
            ExpressionKind::Error => return None,
            _ => "",
        };
        let known = ImpactLaw::ALL.into_iter().find(|law| law.name() == word);
        if known.is_none() {
            let message = match word {
                "" => "the name of a law of impact is expected here".to_owned(),
                word => format!("no law of impact is called `{word}`"),
            };
            let names = ImpactLaw::ALL.map(|law| format!("`{}`", law.name()));
            let diagnostic = Diagnostic::new(Code::UnknownName, said.span, message);
            self.push(diagnostic.help(format!("the laws are {}", names.join(", "))));
        }
        known
    }
}
