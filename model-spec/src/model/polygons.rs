//! Convex polygons in the plane: contact of the corners of one with the faces of another.
//!
//! Two convex polygons are disjoint if and only if one of their faces separates them: all corners of the other polygon are outside its
//! line. (S. Gottschalk, M. C. Lin, D. Manocha, *OBBTree*, Proc. SIGGRAPH 1996, 171–180.) If they touch, a corner of one of them lies
//! on the other. So contact is described corner by corner; if a face lies on a face, two corners touch, the ends of the common part.
//!
//! The distance of a corner `p` from the line of face `k` of the other polygon is `dₖ(p)`, positive outside. The corner is
//! outside the polygon if it is outside any face, and its gap is `maxₖ dₖ(p)`: whichever feature is nearest, the gap is
//! negative inside and only there, so nothing slips in between two features. The corner touches the face that separates best,
//!
//! ```text
//! k* = argmaxₖ min_c dₖ(c)        over all corners c of the polygon that p is a corner of
//! ```
//!
//! since a corner that passes the end of a face is near that face and the next one, and neither must be taken for a collision.
//! `p` is on the face while it is outside no other one: its distance beyond the ends, `max dⱼ(p)` over the other faces `j`, is
//! negative there.
//!
//! A corner that yields is pressed out by its own depth: it touches the face whose line it is least deep behind, `argmaxₖ dₖ(p)`, for
//! which its distance is the gap itself. So the force is the derivative of an energy, and needs no ends of faces: where a corner passes
//! from one face to the next, the depth is that of both. (Faces and corners as features: M. C. Lin, J. F. Canny, *A fast algorithm for incremental distance
//! calculation*, Proc. IEEE ICRA 1991, 1008–1014.)

use std::rc::Rc;

use lagrangian_symbolic::{Expr, Tangent};

use super::circles::{difference, point_and_axes};
use crate::model::{FrameOrBody, Model};

/// The largest number of corners of a polygon that touches another: each is compared with every face, and the choices among
/// faces are written out.
pub const MOST_CORNERS: usize = 24;

/// A convex polygon.
#[derive(Clone)]
pub struct Polygon<'d> {
    /// What it is fixed to.
    pub on: FrameOrBody,
    /// Its corners, in the axes of `on`, in counterclockwise order.
    pub corners: Vec<Vec<Expr<'d>>>,
}

/// A corner of a polygon that may touch another polygon.
#[derive(Clone)]
pub struct Corner<'d> {
    /// The index of the corner in its polygon.
    pub corner: usize,
    /// The polygon that it is a corner of.
    pub polygon: Rc<Polygon<'d>>,
    /// The polygon that it may touch.
    pub other_polygon: Rc<Polygon<'d>>,
    /// Whether it yields: then it touches the face that it is least deep behind.
    pub yields: bool,
}

/// The position and motion of a corner relative to a polygon.
pub struct RelativeMotion<'d> {
    /// The distance of the corner outside the polygon, in m.
    pub gap: Expr<'d>,
    /// The distance of the corner outside the face that it touches, in m; equal to the gap if it touches.
    pub height: Expr<'d>,
    /// The rate of that distance.
    pub rate: Expr<'d>,
    /// The distance of the corner beyond the ends of that face, in m; negative between them.
    pub beyond: Expr<'d>,
    /// The velocity of the corner relative to the polygon's point that it touches, along the face, in the direction
    /// that points outwards if turned left.
    pub slip: Expr<'d>,
}

/// The faces of a polygon: outward unit normals in its axes, and the offsets of the faces along them.
struct Faces<'d> {
    normals: Vec<[Expr<'d>; 2]>,
    offsets: Vec<Expr<'d>>,
}

impl<'d> Polygon<'d> {
    /// The distance of each corner to the left of each face that it is not on, times the length of that face.
    pub fn turns(&self) -> Vec<Expr<'d>> {
        let count = self.corners.len();
        let mut turns = Vec::new();
        for k in 0..count {
            let next = (k + 1) % count;
            let face = self.edge(k);
            for other in (0..count).filter(|other| *other != k && *other != next) {
                let to = |i: usize| self.corners[other][i] - self.corners[k][i];
                turns.push(face[0] * to(1) - face[1] * to(0));
            }
        }
        turns
    }

    /// The vector from a corner to the next one.
    fn edge(&self, k: usize) -> [Expr<'d>; 2] {
        let next = (k + 1) % self.corners.len();
        [0, 1].map(|i| self.corners[next][i] - self.corners[k][i])
    }

    fn faces(&self) -> Faces<'d> {
        let normals: Vec<[Expr<'d>; 2]> = (0..self.corners.len())
            .map(|k| {
                let [x, y] = self.edge(k);
                let length = (x.square() + y.square()).sqrt();
                [y / length, -x / length]
            })
            .collect();
        let offsets = normals.iter().zip(&self.corners);
        let offsets = offsets.map(|(n, at)| n[0] * at[0] + n[1] * at[1]).collect();
        Faces { normals, offsets }
    }
}

/// The position of a corner, and the directions of the face that it touches, all in ground axes.
pub struct ContactFrame<'d> {
    /// The corner.
    pub point: Vec<Expr<'d>>,
    /// Unit vectors: out of the face, and along it in the direction of positive slip.
    pub directions: [Vec<Expr<'d>>; 2],
}

/// The site of the contact of a corner with the polygon that it may touch.
pub fn contact_frame<'d>(model: &Model<'d>, corner: &Corner<'d>) -> ContactFrame<'d> {
    let dag = model.dag;
    let (_, axes) = point_and_axes(model, corner.other_polygon.on, &[dag.zero(); 2]);
    let [x, y] = Face::of(model, corner).normal;
    let in_ground = |along: [Expr<'d>; 2]| -> Vec<Expr<'d>> {
        let pairs = axes[0].iter().zip(&axes[1]);
        pairs.map(|(&e, &f)| along[0] * e + along[1] * f).collect()
    };
    ContactFrame {
        point: point_and_axes(
            model,
            corner.polygon.on,
            &corner.polygon.corners[corner.corner],
        )
        .0,
        directions: [in_ground([x, y]), in_ground([y, -x])],
    }
}

/// The face that a corner touches, in the axes of the polygon that the face belongs to.
struct Face<'d> {
    /// The outward unit normal.
    normal: [Expr<'d>; 2],
    /// The offset of the face along it.
    offset: Expr<'d>,
    /// The corner.
    corner: [Expr<'d>; 2],
    /// The distance of the corner outside the polygon.
    gap: Expr<'d>,
    /// The distance of the corner beyond the ends of the face.
    beyond: Expr<'d>,
}

/// The contact of a corner with the polygon that it may touch.
pub fn relative_motion<'d>(
    model: &Model<'d>,
    corner: &Corner<'d>,
    rate: &mut Tangent<'d>,
) -> RelativeMotion<'d> {
    let Face {
        normal,
        offset,
        corner: place,
        gap,
        beyond,
    } = Face::of(model, corner);
    // The polygon may turn, so these are velocities relative to its own points.
    let velocity = place.map(|x| rate.of(x));
    RelativeMotion {
        gap,
        height: normal[0] * place[0] + normal[1] * place[1] - offset,
        rate: normal[0] * velocity[0] + normal[1] * velocity[1],
        beyond,
        slip: normal[1] * velocity[0] - normal[0] * velocity[1],
    }
}

impl<'d> Face<'d> {
    fn of(model: &Model<'d>, corner: &Corner<'d>) -> Self {
        let dag = model.dag;
        let Corner {
            corner,
            polygon,
            other_polygon: other,
            yields,
        } = corner;
        // All corners in the axes of the other polygon, from their origin.
        let zeros = vec![dag.zero(); 2];
        let (origin, axes) = point_and_axes(model, other.on, &zeros);
        let along = |point: &[Expr<'d>]| {
            let (at, _) = point_and_axes(model, polygon.on, point);
            let arm: Vec<Expr<'d>> = (at.iter().zip(&origin))
                .map(|(&a, &b)| difference(a, b))
                .collect();
            [0, 1].map(|k| dag.sum(axes[k].iter().zip(&arm).map(|(&e, &r)| e * r)))
        };
        let corners: Vec<[Expr<'d>; 2]> = polygon.corners.iter().map(|at| along(at)).collect();
        let Faces { normals, offsets } = other.faces();
        let faces = normals.len();
        let outside =
            |k: usize, [x, y]: [Expr<'d>; 2]| normals[k][0] * x + normals[k][1] * y - offsets[k];
        let place = corners[*corner];
        let separating = if *yields {
            std::slice::from_ref(&place)
        } else {
            &corners[..]
        };
        let least = |k: usize| {
            let mut all = separating.iter().map(|at| outside(k, *at));
            let first = all.next();
            all.fold(first.unwrap_or(dag.zero()), Expr::min)
        };
        let greatest = |all: &mut dyn Iterator<Item = Expr<'d>>| {
            let first = all.next();
            all.fold(first.unwrap_or(dag.zero()), Expr::max)
        };

        // 1 for the face that separates best, 0 for all others.
        let mut best = least(0);
        let mut chosen = vec![dag.one()];
        for k in 1..faces {
            let separation = least(k);
            let is_better = (dag.one() + (separation - best).sign()) / 2;
            for earlier in &mut chosen {
                *earlier = *earlier * (dag.one() - is_better);
            }
            chosen.push(is_better);
            best = best.max(separation);
        }
        let of_chosen = |value: &dyn Fn(usize) -> Expr<'d>| {
            dag.sum(
                chosen
                    .iter()
                    .enumerate()
                    .map(|(k, &weight)| weight * value(k)),
            )
        };
        let normal = [0, 1].map(|i| of_chosen(&|k| normals[k][i]));
        let offset = of_chosen(&|k| offsets[k]);

        let distances: Vec<Expr<'d>> = (0..faces).map(|k| outside(k, place)).collect();
        let beyond = of_chosen(&|k| {
            let others = distances.iter().enumerate().filter(|(j, _)| *j != k);
            greatest(&mut others.map(|(_, &distance)| distance))
        });
        Face {
            normal,
            offset,
            corner: place,
            gap: greatest(&mut distances.iter().copied()),
            beyond,
        }
    }
}
