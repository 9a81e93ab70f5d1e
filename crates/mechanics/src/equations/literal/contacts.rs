//! Gaps, slips and faces of contacts and guides, literally.

use std::rc::Rc;

use super::values::Values;
use super::vector::{difference, dot, ground, quotient, scaled};
use super::{
    Lagrange, LiteralSliding, LiteralUnilateral, Moving, SmoothContact, State, Varied, carried,
    centre_and_angular_velocity, here, of_position, of_rate, point_and_angular_velocity,
    touching_point, turned_left,
};
use super::{in_space, vector};
use lagrangian_scalar::{Dual, Scalar};
use lagrangian_spec::model::element::Sliding;
use lagrangian_spec::model::polygons::{Corner, Polygon};
use lagrangian_spec::model::{
    Circle, Contact, ContactGeometry, FrameOrBody, Model, PoseId, Rotation, Space, Surface,
};
use lagrangian_symbolic::Expr;

impl<'d> Lagrange<'_, 'd> {
    /// The contacts of a point or a circle; `pair` is that of the corner before, since the corners of a polygon follow one another.
    pub(super) fn unilateral<R: Scalar>(
        &self,
        contact: &Contact<'d>,
        x: &Values<'_, Varied<R>>,
        pair: &mut Option<PolygonPair<'d, R>>,
    ) -> Vec<LiteralUnilateral<R>> {
        let touch = self.touch(contact, x, |corner| {
            let known = pair.take().filter(|pair| pair.is_of(corner));
            let of_corner = known.unwrap_or_else(|| PolygonPair::new(self.model, corner, x));
            let corner_motion = of_corner.corner(corner);
            *pair = Some(of_corner);
            Some(Touch {
                gap: corner_motion.height,
                slip: corner_motion.slip,
                across: None,
                face: (!corner.yields).then_some((corner_motion.opening, corner_motion.beyond)),
            })
        });
        touch.map_or_else(Vec::new, |touch| self.of_touch(contact, touch, x))
    }

    /// The rigid contacts whose gaps are smooth, and `None` for others, in the order of the unilateral contacts of a machine. Numbers that only these need (power
    /// series) are not instantiated for polygons.
    pub fn smooth_contacts<R: Scalar>(
        &self,
        at: &State<R>,
        w: &[R],
    ) -> Vec<Option<SmoothContact<R>>> {
        let x = self.along(self.roots.len(), |symbol| self.moving(symbol, at, w));
        let mut all = Vec::new();
        for contact in &self.model.contacts {
            let Some(touch) = self.touch(contact, &x, |_| None) else {
                all.push(None);
                continue;
            };
            let of_contact = self.of_touch(contact, touch, &x);
            all.extend(of_contact.into_iter().enumerate().map(|(part, contact)| {
                Some(SmoothContact {
                    contact,
                    is_carried: part > 0,
                })
            }));
        }
        all
    }

    fn of_touch<R: Scalar>(
        &self,
        contact: &Contact<'d>,
        touch: Touch<R>,
        x: &Values<'_, Varied<R>>,
    ) -> Vec<LiteralUnilateral<R>> {
        let model = self.model;
        let here = |e: Expr<'d>| x.value(e).value.value;
        let known = |e: Option<Expr<'d>>| e.map_or(R::ZERO, here);
        let friction = contact.friction;
        let nothing = Varied::<R>::ZERO;
        let [first, second] = contact.response.coefficients();
        let mut all = vec![LiteralUnilateral {
            opening: of_position(touch.face.map_or(touch.gap, |(opening, _)| opening)),
            gap: of_position(touch.gap),
            face: touch.face.map(|(_, beyond)| {
                let rate = beyond.derivative.value.value;
                [touch.gap.value.value.value, beyond.value.value.value, rate]
            }),
            // Without friction the slip is not used.
            slip: of_rate(friction.map_or(nothing, |_| touch.slip)),
            coefficients: [
                here(first),
                here(second),
                known(friction),
                known(contact.static_friction.or(friction)),
            ],
        }];
        if let (Some(_), Some(across)) = (friction, touch.across) {
            all.push(LiteralUnilateral {
                slip: of_rate(across),
                ..all[0]
            });
        }
        if let (ContactGeometry::Circles(touching), Some(resistance)) =
            (&contact.geometry, contact.rolling_resistance)
        {
            let angular_velocity =
                |circle: usize| centre_and_angular_velocity(model, &model.circles[circle], x).1;
            let own = angular_velocity(touching.circle);
            let other = match touching.surface {
                Surface::Inside(other) | Surface::Outside(other) => angular_velocity(other),
                Surface::Along(pose) => x.rate(model.poses[pose.index()].angle),
            };
            all.push(LiteralUnilateral {
                opening: of_position(touch.gap),
                gap: of_position(touch.gap),
                face: None,
                slip: of_rate(own - other),
                coefficients: [R::ZERO, R::ZERO, here(resistance), here(resistance)],
            });
        }
        all
    }

    /// The relative motion of what touches in a contact; that of a corner of a polygon is given by the function.
    fn touch<R: Scalar>(
        &self,
        contact: &Contact<'d>,
        x: &Values<'_, Varied<R>>,
        of_corner: impl FnOnce(&Corner<'d>) -> Option<Touch<R>>,
    ) -> Option<Touch<R>> {
        let model = self.model;
        let yields = contact.response.compliance().is_some();
        let of_round = |round: &Circle<'d>, surface: Surface| {
            let (gap, slip, across) = match model.space {
                Space::Plane => {
                    let [gap, slip] = on_surface(model, round, surface, yields, x);
                    (gap, slip.value, None)
                }
                Space::Space => {
                    let (gap, [slip, across]) =
                        in_space::gap_and_slip(model, round, surface, yields, x);
                    (gap, slip, Some(across))
                }
            };
            Touch {
                gap,
                slip,
                across,
                face: None,
            }
        };
        match &contact.geometry {
            ContactGeometry::Corner(corner) => of_corner(corner),
            ContactGeometry::Circles(touching) => {
                Some(of_round(&model.circles[touching.circle], touching.surface))
            }
            ContactGeometry::Point { point, surface } => Some(of_round(point, *surface)),
            ContactGeometry::Expressions { gap, slip, across } => Some(Touch {
                gap: x.at(*gap),
                slip: x.value(*slip),
                across: across.map(|across| x.value(across)),
                face: None,
            }),
        }
    }

    pub(super) fn sliding<R: Scalar>(
        &self,
        sliding: &Sliding<'d>,
        x: &Values<'_, Varied<R>>,
    ) -> LiteralSliding<R> {
        match self.model.space {
            Space::Plane => self.sliding_along::<R, 2>(sliding, x),
            Space::Space => self.sliding_along::<R, 3>(sliding, x),
        }
    }

    /// A guided contact in a space of this dimension.
    fn sliding_along<R: Scalar, const N: usize>(
        &self,
        sliding: &Sliding<'d>,
        x: &Values<'_, Varied<R>>,
    ) -> LiteralSliding<R> {
        let model = self.model;
        let body = &model.bodies[sliding.body];
        let at = x.vector::<N>(match body.rotation {
            Rotation::Frame(pose) => &model.poses[pose.index()].origin,
            Rotation::Angle(_) | Rotation::Unspecified => &body.at,
        });
        let origin = x.vector::<N>(match sliding.on {
            FrameOrBody::Frame(pose) => &model.poses[pose.index()].origin,
            FrameOrBody::Body(on) => &model.bodies[on].at,
        });
        let arm = difference(at, origin);
        let carried = carried(model, model.rotation(sliding.on), vector::value(arm), x);
        let velocity = difference(vector::rate(arm), carried);
        let direction = vector::value(x.vector::<N>(&sliding.direction));
        let along = quotient(direction, dot(direction, direction).sqrt());
        let slip = dot(along, velocity);
        let axes: Vec<[Varied<R>; N]> = match model.space {
            Space::Plane => vec![turned_left(along)],
            Space::Space => ground::<Varied<R>, N>().to_vec(),
        };
        let side = match &sliding.normal {
            Some(normal) if model.space == Space::Plane => {
                let normal = vector::value(x.vector::<N>(normal));
                dot(normal, axes[0]).value.value
            }
            _ => R::ONE,
        };
        let reference_direction = match (sliding.tangent, &sliding.normal) {
            (Some(_), Some(normal)) => {
                let normal = here(vector::value(x.vector::<N>(normal)));
                quotient(normal, dot(normal, normal).sqrt())
            }
            _ => here(along),
        };
        let mut off_along = Vec::with_capacity(axes.len());
        let mut axes_here = Vec::with_capacity(axes.len());
        for &axis in &axes {
            off_along.push(dot(axis, velocity).value.derivative);
            axes_here.push(here(axis).to_vec());
        }
        let friction = sliding.friction;
        let static_friction = sliding.static_friction.unwrap_or(friction);
        LiteralSliding {
            reference_direction: reference_direction.to_vec(),
            slip: slip.value.value,
            slip_rate: slip.derivative.value,
            slip_along: slip.value.derivative,
            off_along,
            axes: axes_here,
            side,
            coefficients: here(vector::value(x.vector(&[friction, static_friction]))),
        }
    }
}

/// The relative motion of what touches in a contact.
struct Touch<R> {
    gap: Moving<R>,
    slip: Varied<R>,
    /// The other component of the slip, in space.
    across: Option<Varied<R>>,
    /// Of a corner of a polygon its distance outside the other polygon, and its distance beyond the ends of the face.
    face: Option<(Moving<R>, Moving<R>)>,
}

/// The position of a corner of a polygon relative to another polygon.
struct CornerOnPolygon<R> {
    /// Its distance outside the polygon.
    opening: Moving<R>,
    /// Its distance outside the face that separates best.
    height: Moving<R>,
    /// Its distance beyond the ends of that face.
    beyond: Moving<R>,
    /// Its slip velocity along the face, in the direction that points outwards if it is turned left.
    slip: Varied<R>,
}

/// A polygon relative to another one, in ground axes.
pub(super) struct PolygonPair<'d, R> {
    polygons: [Rc<Polygon<'d>>; 2],
    /// The corners of the first.
    points: Vec<[Moving<R>; 2]>,
    /// The corners of the other, at which its faces begin.
    ends: Vec<[Moving<R>; 2]>,
    /// Unit vectors along these faces.
    edges: Vec<[Moving<R>; 2]>,
    /// 1 for the face that separates best, else 0.
    weights: Vec<Moving<R>>,
    /// The angular velocity of the other.
    turning: Varied<R>,
}

impl<'d, R: Scalar> PolygonPair<'d, R> {
    fn new(model: &Model<'d>, corner: &Corner<'d>, x: &Values<'_, Varied<R>>) -> Self {
        let [first, other] = [&corner.polygon, &corner.other_polygon];
        let corners = |polygon: &Polygon<'_>| {
            let mut corners = Vec::with_capacity(polygon.corners.len());
            for at in &polygon.corners {
                corners.push(point_and_angular_velocity(model, polygon.on, at, x).0);
            }
            corners
        };
        let (points, ends) = (corners(first), corners(other));
        let (_, turning) = point_and_angular_velocity(model, other.on, &other.corners[0], x);
        let faces = ends.len();
        let mut edges = Vec::with_capacity(faces);
        for k in 0..faces {
            let next = (k + 1) % faces;
            // The length in the axes of the polygon, where it is a constant: in a field the root of a constant always exists, and that
            // of the same number made from angles does only for half of all polygons' faces.
            let corner = |k: usize| x.vector::<2>(&other.corners[k]);
            let side = difference(corner(next), corner(k));
            let edge = difference(ends[next], ends[k]);
            edges.push(scaled(Moving::<R>::ONE / dot(side, side).sqrt(), edge));
        }
        let mut pair = PolygonPair {
            polygons: [first.clone(), other.clone()],
            points,
            ends,
            edges,
            weights: vec![Moving::<R>::ZERO; faces],
            turning,
        };
        let mut separations = Vec::with_capacity(faces);
        for k in 0..faces {
            let mut distances = Vec::with_capacity(pair.points.len());
            for &point in &pair.points {
                distances.push(pair.distance(k, point));
            }
            separations.push(extreme(&distances, Moving::min));
        }
        pair.weights = weights(&separations);
        pair
    }

    /// Whether these are the polygons of a corner.
    fn is_of(&self, corner: &Corner<'d>) -> bool {
        let [first, other] = &self.polygons;
        Rc::ptr_eq(first, &corner.polygon) && Rc::ptr_eq(other, &corner.other_polygon)
    }

    /// The distance of a point outside the line along a face.
    fn distance(&self, face: usize, point: [Moving<R>; 2]) -> Moving<R> {
        let (arm, edge) = (difference(point, self.ends[face]), self.edges[face]);
        arm[0] * edge[1] - arm[1] * edge[0]
    }

    /// The position and motion of a corner of the first polygon.
    fn corner(&self, corner: &Corner<'d>) -> CornerOnPolygon<R> {
        let place = self.points[corner.corner];
        let faces = self.ends.len();
        let mut distances = Vec::with_capacity(faces);
        for k in 0..faces {
            distances.push(self.distance(k, place));
        }
        // A corner that yields touches the face that it is least deep behind.
        let own;
        let all = if corner.yields {
            own = weights(&distances);
            &own
        } else {
            &self.weights
        };
        let mut corner_on_polygon = CornerOnPolygon {
            opening: extreme(&distances, Moving::max),
            height: Moving::<R>::ZERO,
            beyond: Moving::<R>::ZERO,
            slip: Varied::<R>::ZERO,
        };
        for k in 0..faces {
            let weight = all[k];
            let mut others = distances.clone();
            others.remove(k);
            corner_on_polygon.height = corner_on_polygon.height + weight * distances[k];
            corner_on_polygon.beyond =
                corner_on_polygon.beyond + weight * extreme(&others, Moving::max);
            // The polygon's own point under the corner moves with the end of the face, and turns about it.
            let arm = difference(place, self.ends[k]);
            let carried = scaled(self.turning, turned_left(vector::value(arm)));
            let velocity = difference(vector::rate(arm), carried);
            let slip = dot(vector::value(self.edges[k]), velocity);
            corner_on_polygon.slip = corner_on_polygon.slip - weight.value * slip;
        }
        corner_on_polygon
    }
}

/// 1 for the greatest of some numbers, else 0.
fn weights<R: Scalar>(separations: &[Moving<R>]) -> Vec<Moving<R>> {
    let faces = separations.len();
    let mut weights = vec![Moving::<R>::ZERO; faces];
    let half = Moving::<R>::from_ratio(1, 2);
    // From the last face to the first: `left` is 1 as long as no later face separates better than all before it, else 0.
    let mut so_far = separations.to_vec();
    for k in 1..faces {
        so_far[k] = so_far[k - 1].max(separations[k]);
    }
    let mut left = Moving::<R>::ONE;
    for k in (1..faces).rev() {
        let is_better = half * (Moving::<R>::ONE + (separations[k] - so_far[k - 1]).sign());
        weights[k] = left * is_better;
        left = left * (Moving::<R>::ONE - is_better);
    }
    weights[0] = left;
    weights
}

/// The smallest or the largest of some numbers, compared from the last to the first; 0 of none.
fn extreme<S: Scalar>(all: &[S], pick: fn(S, S) -> S) -> S {
    let Some(&last) = all.last() else {
        return S::ZERO;
    };
    let mut extreme = last;
    for k in (0..all.len() - 1).rev() {
        extreme = pick(extreme, all[k]);
    }
    extreme
}

/// The distance of a circle from touching a surface, and the slip velocity of the touching points; if they yield, of the points of
/// both that are at one place.
pub(super) fn on_surface<R: Scalar>(
    model: &Model<'_>,
    circle: &Circle<'_>,
    surface: Surface,
    yields: bool,
    x: &Values<'_, Varied<R>>,
) -> [Moving<R>; 2] {
    match surface {
        Surface::Inside(other) => {
            on_circle(model, [circle, &model.circles[other]], (true, yields), x)
        }
        Surface::Outside(other) => {
            on_circle(model, [circle, &model.circles[other]], (false, yields), x)
        }
        Surface::Along(pose) => on_line(model, circle, (pose, yields), x),
    }
}

/// The distance of a circle from touching another, inside or outside of it, and the slip velocity
/// of the touching points, along the direction from the other's centre turned left.
fn on_circle<R: Scalar>(
    model: &Model<'_>,
    [first, other]: [&Circle<'_>; 2],
    (is_inside, yields): (bool, bool),
    x: &Values<'_, Varied<R>>,
) -> [Moving<R>; 2] {
    let (centre, omega) = centre_and_angular_velocity(model, first, x);
    let (other_centre, other_omega) = centre_and_angular_velocity(model, other, x);
    let line = difference(centre, other_centre);
    let distance = dot(line, line).sqrt();
    let (small, large) = (x.at(first.radius), x.at(other.radius));
    let gap = if is_inside {
        large - small - distance
    } else {
        distance - small - large
    };
    // The touching point: the first circle's at c ± r e, the other's at R e. At one place, `arm` from the first centre is `past` from the other.
    let e = quotient(vector::value(line), distance.value);
    let radii = [small, large].map(|r| r.value);
    // Two points have no place between them.
    let yields = yields && !(first.radius.is_zero() && other.radius.is_zero());
    let [arm, past] = touching_point(radii, distance.value, (is_inside, yields));
    let rate = dot(turned_left(e), vector::rate(line));
    let slip = rate + arm * omega - past * other_omega;
    [gap, Dual::constant(slip)]
}

/// Gap and slip of a circle on the first axis of a frame, on the side of the second axis.
fn on_line<R: Scalar>(
    model: &Model<'_>,
    circle: &Circle<'_>,
    (pose, yields): (PoseId, bool),
    x: &Values<'_, Varied<R>>,
) -> [Moving<R>; 2] {
    let frame = &model.poses[pose.index()];
    let (centre, omega) = centre_and_angular_velocity(model, circle, x);
    let line = difference(centre, x.vector(&frame.origin));
    let (along, across) = (x.vector(&frame.axes[0]), x.vector(&frame.axes[1]));
    let radius = x.at(circle.radius);
    let gap = dot(across, line) - radius;
    let rate = dot(vector::value(along), vector::rate(line));
    let nearest = rate + radius.value * omega;
    if !yields {
        return [gap, Dual::constant(nearest)];
    }
    // What turns with the frame at the circle's nearest point, the gap above the line, moves backwards there.
    let carried = -(gap.value * x.rate(frame.angle));
    [gap, Dual::constant(nearest - carried)]
}
