//! Motion of frames and bodies: their angular velocities, and the velocities of points fixed to them.

use lagrangian_symbolic::Expr;

use super::Resolver;
use super::value::{MemberId, Scalar, Scope, Value, Vector};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::circles::terms;
use crate::model::{PoseId, Rotation, Space};
use crate::source::Span;
use crate::syntax::Link;
use crate::unit::Unit;

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// `f.spin`, or `f.velocity(point)`, of a frame.
    pub(super) fn motion_of_frame(
        &mut self,
        frame: PoseId,
        link: &'a Link,
        scope: Scope<'a>,
    ) -> Value<'d> {
        if link.name.text == "spin" {
            self.no_arguments(link);
            let spin = self.spin(frame, link.span);
            return self.spin_value(spin);
        }
        let point = self.point_of_link(link, scope);
        let spin = self.spin(frame, link.span);
        let (Some(point), Some(spin)) = (point, spin) else {
            return Value::Unknown;
        };
        let lever = match &point.local {
            Some((local, along)) if *local == frame => self.vector_of(frame, along),
            _ => vector_between(&self.pose(frame).origin, &point.components),
        };
        let origin = self.pose(frame).origin.clone();
        self.velocity_at(&origin, &spin, &lever, link.span)
    }

    /// `body.spin`, or `body.velocity(point)`, of a body without a frame: in the plane it may have an angle.
    pub(super) fn motion_of_body(
        &mut self,
        body: MemberId,
        link: &'a Link,
        span: Span,
        scope: Scope<'a>,
    ) -> Value<'d> {
        let is_spin = link.name.text == "spin";
        let point = if is_spin {
            self.no_arguments(link);
            None
        } else {
            match self.point_of_link(link, scope) {
                Some(point) => Some(point),
                None => return Value::Unknown,
            }
        };
        let record = self.record(body);
        let angle = match record.and_then(|record| self.rotation(body, record)) {
            Some(Rotation::Angle(angle)) => angle,
            Some(_) => {
                let name = self.name(body);
                let message = format!("the rotation of the body `{name}` is not given");
                let diagnostic = Diagnostic::new(Code::MissingRotation, span, message);
                let help = format!(
                    "give it an `angle` or a `frame`; its mass centre moves at `der({name}.at)`"
                );
                self.push(diagnostic.help(help));
                return Value::Unknown;
            }
            None => return Value::Unknown,
        };
        let spin = self.rate(angle, span).map(|rate| vec![rate]);
        let Some(point) = point else {
            return self.spin_value(spin);
        };
        let (Value::Vector(at), Some(spin)) = (self.value_of(body, span), spin) else {
            return Value::Unknown;
        };
        let lever = vector_between(&at.components, &point.components);
        self.velocity_at(&at.components, &spin, &lever, span)
    }

    /// The angular velocity of a frame: one number in the plane, three in ground axes in space.
    pub fn spin(&mut self, frame: PoseId, span: Span) -> Option<Vec<Expr<'d>>> {
        if self.space == Space::Plane {
            let angle = self.pose(frame).angle;
            return Some(vec![self.rate(angle, span)?]);
        }
        let mut turning = vec![Vec::new(); 3];
        let mut at = frame;
        while at != PoseId::GROUND {
            let pose = self.pose(at);
            let (parent, step, axes) = (pose.parent, pose.step.clone(), pose.axes.clone());
            // A turn leaves its own axis unchanged.
            for (axis, rate) in step.angular_velocity_parts(|x| self.rate(x, span))? {
                for (terms, &along) in turning.iter_mut().zip(&axes[axis]) {
                    terms.push(rate * along);
                }
            }
            at = parent;
        }
        Some(
            turning
                .into_iter()
                .map(|terms| self.dag.sum(terms))
                .collect(),
        )
    }

    fn spin_value(&self, spin: Option<Vec<Expr<'d>>>) -> Value<'d> {
        let unit = Some(Unit::RADIAN.rate());
        match spin {
            None => Value::Unknown,
            Some(spin) if self.space == Space::Plane => Value::Scalar(Scalar {
                expr: spin[0],
                unit,
                number: None,
            }),
            Some(spin) => Value::Vector(Vector::new(spin, unit)),
        }
    }

    /// The velocity at the end of a lever that turns about a moving point.
    fn velocity_at(
        &mut self,
        origin: &[Expr<'d>],
        spin: &[Expr<'d>],
        lever: &[Expr<'d>],
        span: Span,
    ) -> Value<'d> {
        let rates = origin.iter().map(|&x| self.rate(x, span));
        let Some(rates) = rates.collect::<Option<Vec<_>>>() else {
            return Value::Unknown;
        };
        let swept = rotational_velocity(spin, lever);
        let sums = rates.into_iter().zip(swept);
        let components = sums.map(|(rate, swept)| rate + swept).collect();
        Value::Vector(Vector::new(components, Some(Unit::METRE.rate())))
    }

    /// The point that is the only argument of a link.
    pub(super) fn point_of_link(&mut self, link: &'a Link, scope: Scope<'a>) -> Option<Vector<'d>> {
        let arguments = link.arguments.as_deref().unwrap_or(&[]);
        let [point] = arguments else {
            let word = &link.name.text;
            let found = arguments.len();
            let message = format!("`.{word}` takes a point, found {found} arguments");
            let diagnostic = Diagnostic::new(Code::WrongArguments, link.span, message);
            let help = format!("write `.{word}(body.at)`, or any other point");
            self.push(diagnostic.help(help));
            return None;
        };
        let scope = scope.with_expected_unit(Unit::METRE);
        self.vector_in(point, "a point", Unit::METRE, "a point is in m", scope)
    }

    /// A point in a frame: its coordinates in the axes of the frame, from its origin.
    pub(super) fn local_coordinates(&self, frame: PoseId, point: &Vector<'d>) -> Vec<Expr<'d>> {
        match &point.local {
            Some((local, along)) if *local == frame => along.clone(),
            _ => {
                let pose = self.pose(frame);
                let line = vector_between(&pose.origin, &point.components);
                let along = pose.axes.iter().map(|axis| {
                    let parts = axis.iter().zip(&line).map(|(&e, &x)| e * x);
                    self.dag.sum(parts)
                });
                along.collect()
            }
        }
    }
}

/// ω × r: in the plane ω is one number.
pub(crate) fn rotational_velocity<'d>(spin: &[Expr<'d>], lever: &[Expr<'d>]) -> Vec<Expr<'d>> {
    match (spin, lever) {
        (&[spin], &[x, y]) => vec![-spin * y, spin * x],
        (&[a, b, c], &[x, y, z]) => vec![b * z - c * y, c * x - a * z, a * y - b * x],
        _ => Vec::new(),
    }
}

/// The vector from one point to another, with common terms cancelled.
pub(crate) fn vector_between<'d>(from: &[Expr<'d>], to: &[Expr<'d>]) -> Vec<Expr<'d>> {
    let less = |(&to, &from): (&Expr<'d>, &Expr<'d>)| {
        let from = terms(from).into_iter().map(|term| -term);
        to.dag().sum(terms(to).into_iter().chain(from))
    };
    to.iter().zip(from).map(less).collect()
}
