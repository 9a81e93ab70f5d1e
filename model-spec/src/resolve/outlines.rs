//! The outlines of bodies: polygons that are drawn, and whose corners may take part in contacts.

use super::Resolver;
use super::value::{MemberId, limits};
use crate::diagnostic::{Code, Diagnostic};
use crate::model::{Body, ContactGeometry, FrameOrBody, Rotation, Space};
use crate::source::Span;
use crate::syntax::{ExpressionKind, Record};
use crate::unit::Unit;
use lagrangian_symbolic::Expr;

/// The corners of a body, in the axes of its frame, or in its own axes from its mass centre.
pub struct Outline<'d> {
    body: usize,
    rotation: Rotation<'d>,
    corners: Vec<Vec<Expr<'d>>>,
}

impl<'d> Outline<'d> {
    /// The outline of the body with this index; `None` if it has none.
    pub fn of((index, body): (usize, &Body<'d>)) -> Option<Outline<'d>> {
        (!body.outline.is_empty()).then(|| Outline {
            body: index,
            rotation: body.rotation,
            corners: body.outline.clone(),
        })
    }

    /// Whether it is the outline of the body at this place.
    fn is_of(&self, place: FrameOrBody) -> bool {
        match (place, &self.rotation) {
            (FrameOrBody::Frame(pose), Rotation::Frame(frame)) => pose == *frame,
            (FrameOrBody::Body(body), _) => body == self.body,
            _ => false,
        }
    }
}

impl<'a, 'd> Resolver<'a, 'd, '_> {
    /// The corners of the polygon that is drawn for a body.
    pub fn outline(&mut self, member: MemberId, record: &'a Record) -> Option<Vec<Vec<Expr<'d>>>> {
        let Some(field) = record.field("outline") else {
            return Some(Vec::new());
        };
        if self.space == Space::Space {
            let message = "outlines exist only in the plane";
            self.error(Code::WrongSpace, field.name.span, message);
            return None;
        }
        let written = &field.value;
        let corners = match &written.kind {
            ExpressionKind::Tuple(corners) => corners,
            ExpressionKind::Error => return None,
            _ => {
                let message = "an outline is a list of points, `((0, 0), (b, 0), (0, h))`";
                self.error(Code::WrongKind, written.span, message);
                return None;
            }
        };
        let scope = self.scope(member, &limits::OUTLINE);
        let points: Vec<_> = (corners.iter())
            .map(|corner| self.vector_in(corner, "a point", Unit::METRE, "a point is in m", scope))
            .collect();
        points
            .into_iter()
            .map(|point| Some(point?.components))
            .collect()
    }

    /// The contacts of the corners of the outline of the body named by `on`, with `inside`, `outside` or `along`.
    pub fn outline_on(
        &mut self,
        member: MemberId,
        record: &'a Record,
        span: Span,
    ) -> Option<Vec<ContactGeometry<'d>>> {
        let on = self.field(member, record, "on");
        let on = on.and_then(|on| self.place(member, on));
        let surface = self.surface(member, record, None)?;
        let on = on?;
        let corners = self.outline_at(on, "on", span)?.into_iter();
        let points = corners.map(|corner| self.point_on(member, on, corner, surface));
        Some(points.collect())
    }

    /// The corners of the outline of the body at a place.
    pub fn outline_at(
        &mut self,
        on: FrameOrBody,
        field: &str,
        span: Span,
    ) -> Option<Vec<Vec<Expr<'d>>>> {
        let outlines = self.outlines.iter();
        let mut matching = outlines.filter(|outline| outline.is_of(on));
        let (corners, message, help) = match [matching.next(), matching.next()] {
            [Some(outline), None] => (Some(outline.corners.clone()), String::new(), ""),
            [None, _] => (
                None,
                format!("`{field}` does not name a body with an `outline`"),
                "give the body `outline: ((0, 0), (b, 0), (0, h))`, or write the corners here",
            ),
            _ => (
                None,
                "several bodies on this frame have an `outline`".to_owned(),
                "write the corners here, or give each body a frame of its own",
            ),
        };
        if corners.is_none() {
            let diagnostic = Diagnostic::new(Code::WrongKind, span, message);
            self.push(diagnostic.help(help));
        }
        corners
    }
}
