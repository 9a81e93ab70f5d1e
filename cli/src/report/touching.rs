//! The points at which contact forces act, and the directions there: where a circle, a sphere or a point touches.

use lagrangian_spec::model::circles::{centre_and_axes, distance};
use lagrangian_spec::model::polygons::{self, Corner};
use lagrangian_spec::model::{Circle, Model, Surface, spheres};
use lagrangian_symbolic::Expr;

/// A contact point, in ground axes.
pub struct Site<'d> {
    /// The point.
    pub point: Vec<Expr<'d>>,
    /// Unit vectors along which forces act on the circle: the normal, in the direction of opening, and one tangent in the plane or
    /// two in space, in the directions of slip. The force on the circle is the sum of its components times these.
    pub directions: Vec<Vec<Expr<'d>>>,
}

/// Where a circle or sphere, possibly a point, touches a surface.
pub fn site<'d>(model: &Model<'d>, circle: &Circle<'d>, surface: Surface) -> Site<'d> {
    let (centre, _) = centre_and_axes(model, circle);
    let (other, is_inside) = match surface {
        Surface::Along(pose) => {
            let mut axes = model.poses[pose.index()].axes.clone();
            // The last axis is the normal; the others are tangents.
            axes.rotate_right(1);
            let below = centre.iter().zip(&axes[0]);
            return Site {
                point: below.map(|(&c, &n)| c - circle.radius * n).collect(),
                directions: axes,
            };
        }
        Surface::Inside(other) => (&model.circles[other], true),
        Surface::Outside(other) => (&model.circles[other], false),
    };
    let (middle, _) = centre_and_axes(model, other);
    let line: Vec<Expr<'d>> = centre.iter().zip(&middle).map(|(&a, &b)| a - b).collect();
    let facts = model.assumptions.iter().map(|fact| fact.excess);
    let facts: Vec<_> = facts.map(|fact| (fact, fact.symbols())).collect();
    let length = distance(&line, &facts);
    let outward: Vec<Expr<'d>> = line.iter().map(|&c| c / length).collect();
    let normal: Vec<Expr<'d>> = if is_inside {
        outward.iter().map(|&e| -e).collect()
    } else {
        outward.clone()
    };
    let tangents: Vec<Vec<Expr<'d>>> = match outward.as_slice() {
        // The normal points from the centre of the other circle to that of this one; the tangent is rotated to the left.
        &[x, y] => vec![vec![-y, x]],
        _ => spheres::tangents(&normal).map(|t| t.to_vec()).to_vec(),
    };
    let rim = middle.iter().zip(&outward);
    Site {
        point: rim.map(|(&c, &e)| c + other.radius * e).collect(),
        directions: [normal].into_iter().chain(tangents).collect(),
    }
}

/// Where a corner of a polygon touches another polygon.
pub fn site_of_corner<'d>(model: &Model<'d>, corner: &Corner<'d>) -> Site<'d> {
    let polygons::ContactFrame { point, directions } = polygons::contact_frame(model, corner);
    Site {
        point,
        directions: directions.into(),
    }
}

#[cfg(test)]
mod tests {
    use lagrangian::interpreted::InterpretedMachine;
    use lagrangian::{Machine, System};
    use lagrangian_mechanics::Compiled;
    use lagrangian_spec::diagnostic::Report;
    use lagrangian_spec::model::ContactGeometry;
    use lagrangian_spec::source::{InMemory, Sources};
    use lagrangian_symbolic::{Dag, evaluate};

    use super::*;

    /// The force on the touching body and its reaction must agree with the rows of the contact: the derivatives of the rates of gap
    /// and slip by the velocity of a body are the force on it, those by its angular velocity the moment about its centre. Bodies
    /// have three coordinates each in the plane and six in space, with angles 0, and touch at the start.
    #[track_caller]
    fn assert_forces_act(text: &str) {
        let dag = Dag::new();
        let (mut sources, mut report) = (Sources::new(), Report::new());
        let files = &mut InMemory::new();
        let model = lagrangian_spec::model(&dag, "m", text, &[], files, &mut sources, &mut report);
        let Some(model) = model else {
            panic!("{}", report.render(&sources));
        };
        let compiled = Compiled::new(model, &mut report).expect("derivable");
        let model = &compiled.model;
        let machine = InterpretedMachine::new(compiled.program.clone());
        let (system, start) = (machine.prepare(), machine.start());
        let n = start.q.values.len();
        let value = |symbol| {
            let mut coordinates = model.coordinates.iter();
            let place = coordinates.position(|of| of.q.as_symbol() == Some(symbol));
            start.q.values[place.expect("a coordinate")]
        };
        let numbers = |of: &[Expr<'_>]| evaluate(model.dag, of, value);
        let mut gaps = vec![f64::NAN; system.unilateral_contacts().len()];
        system.gaps(0.0, &start.q.values, &mut gaps);
        let mut matrix = vec![f64::NAN; 2 * gaps.len() * n];
        system.contact_matrix(0.0, &start.q.values, &mut matrix);
        let rows: Vec<&[f64]> = matrix.chunks(n).collect();
        // The normal and the tangent of the contact; the repeated normal is skipped, then the other tangent follows.
        let rows: Vec<&[f64]> = (0..rows.len())
            .filter(|k| *k != 2)
            .map(|k| rows[k])
            .collect();
        let site = match &model.contacts[0].geometry {
            ContactGeometry::Circles(circles) => {
                site(model, &model.circles[circles.circle], circles.surface)
            }
            ContactGeometry::Point { point, surface } => site(model, point, *surface),
            ContactGeometry::Corner(corner) => site_of_corner(model, corner),
            ContactGeometry::Expressions { .. } => panic!("no place"),
        };
        // Further rows belong to other contacts.
        let rows = &rows[..site.directions.len()];
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{a}, not {b}: {text}");
        near(gaps[0], 0.0);
        let point = numbers(&site.point);
        for (direction, row) in site.directions.iter().zip(rows) {
            let direction = numbers(direction);
            for (body, sign) in model.bodies.iter().zip([1.0, -1.0]) {
                let centre = numbers(&body.at);
                let of_body = row.chunks(n / model.bodies.len());
                let of_body = of_body
                    .clone()
                    .nth(usize::from(sign < 0.0))
                    .expect("a body");
                let arm: Vec<f64> = point.iter().zip(&centre).map(|(p, c)| p - c).collect();
                let turning = |i: usize, j: usize| arm[i] * direction[j] - arm[j] * direction[i];
                let moment = match direction.len() {
                    2 => vec![turning(0, 1)],
                    _ => vec![turning(1, 2), turning(2, 0), turning(0, 1)],
                };
                let expected = direction.iter().chain(&moment);
                assert_eq!(of_body.len(), direction.len() + moment.len());
                for (seen, expected) in of_body.iter().zip(expected) {
                    near(*seen, sign * expected);
                }
            }
        }
    }

    #[test]
    fn forces_act_where_circles_touch() {
        // In the direction (0.3, 0.4)/0.5, at the distance of the centres: 1.5 − 0.5 inside, 2 outside.
        for (way, x, y) in [("inside", 0.6, 0.8), ("outside", 1.2, 1.6)] {
            assert_forces_act(&format!(
                "machine Circles in plane {{
                    coordinates {{ x: m = {x} + 2, y: m = {y} - 1, a: rad, u: m = 2, w: m = -1, b: rad }}
                    bodies {{ one {{ mass: 1, inertia: 1, at: (x, y), angle: a }}, other {{ mass: 2, inertia: 3, at: (u, w), angle: b }} }}
                    circles {{ rim {{ on: one, center: (0, 0), radius: 0.5 }}, bore {{ on: other, center: (0, 0), radius: 1.5 }} }}
                    contacts {{ touch {{ circle: rim, {way}: bore, restitution: 0, friction: 0.3 }} }}
                }}"
            ));
        }
    }

    #[test]
    fn forces_act_where_something_touches_a_line() {
        let touching = |geometry: &str, height: &str| {
            assert_forces_act(&format!(
                "machine Line in plane {{
                    coordinates {{ x: m = 3/5*2 - 4/5*({height}), y: m = 1 + 4/5*2 + 3/5*({height}), a: rad }}
                    frames {{ slope = ground.shift(0, 1).turn(asin(4/5)) }}
                    bodies {{ one {{ mass: 1, inertia: 1, at: (x, y), angle: a }} }}
                    circles {{ rim {{ on: one, center: (0.1, 0), radius: 0.5 }} }}
                    contacts {{ touch {{ {geometry}, along: slope, restitution: 0, friction: 0.3 }} }}
                }}"
            ));
        };
        // The centre of the circle is 0.1 further along x, and a corner is 0.2 further along x and 0.3 below.
        touching("circle: rim", "0.5 + 0.1*4/5");
        touching("point: (0.2, -0.3), on: one", "0.2*4/5 + 0.3*3/5");
    }

    /// A corner of a triangle on the upper face of a box that is rotated by the angle whose sine is 4/5.
    #[test]
    fn forces_act_where_a_corner_touches_a_face() {
        assert_forces_act(
            "machine Polygons in plane {
                coordinates { x: m = 2 - 4/5*0.5 + 3/5*0.1, y: m = -1 + 3/5*0.5 + 4/5*0.1, a: rad = asin(4/5), u: m = 2, w: m = -1, b: rad = asin(4/5) }
                bodies { one { mass: 1, inertia: 1, at: (x, y), angle: a }, other { mass: 2, inertia: 3, at: (u, w), angle: b } }
                contacts {
                    touch {
                        corners: ((0, 0), (0.3, 1), (-0.4, 1.2)), on: one, against: ((-1, -0.5), (1, -0.5), (1, 0.5), (-1, 0.5)), of: other,
                        restitution: 0, friction: 0.3,
                    },
                }
            }",
        );
    }

    #[test]
    fn forces_act_where_spheres_touch() {
        // Along (2, 3, 6)/7, and along (2, 3, −6)/7, where the tangents differ.
        for (way, apart, sign) in [
            ("inside", 1, 1),
            ("outside", 2, 1),
            ("inside", 1, -1),
            ("outside", 2, -1),
        ] {
            assert_forces_act(&format!(
                "machine Spheres in space {{
                    coordinates {{
                        x: m = 2*{apart}/7, y: m = 3*{apart}/7, z: m = 6*{apart}*({sign})/7, a: rad, b: rad, c: rad,
                        u: m, v: m, w: m, d: rad, e: rad, f: rad,
                    }}
                    frames {{
                        first = ground.shift(x, y, z).turn(x, a).turn(y, b).turn(z, c),
                        second = ground.shift(u, v, w).turn(x, d).turn(y, e).turn(z, f),
                    }}
                    bodies {{ one {{ mass: 1, inertia: (1, 1, 1), frame: first }}, other {{ mass: 2, inertia: (3, 3, 3), frame: second }} }}
                    spheres {{ rim {{ on: one, center: (0, 0, 0), radius: 0.5 }}, bore {{ on: other, center: (0, 0, 0), radius: 1.5 }} }}
                    contacts {{ touch {{ sphere: rim, {way}: bore, restitution: 0, friction: 0.3 }} }}
                }}"
            ));
        }
    }

    #[test]
    fn forces_act_where_something_touches_a_plane() {
        for (geometry, height) in [
            ("sphere: ball", "0.5"),
            ("point: (0.2, 0.1, -0.3), on: one", "0.3"),
        ] {
            assert_forces_act(&format!(
                "machine Plane in space {{
                    coordinates {{ x: m = 1, y: m = 2, z: m = {height}, a: rad, b: rad, c: rad }}
                    frames {{ held = ground.shift(x, y, z).turn(x, a).turn(y, b).turn(z, c), floor = ground.turn(z, 1) }}
                    bodies {{ one {{ mass: 1, inertia: (1, 1, 1), frame: held }} }}
                    spheres {{ ball {{ on: one, center: (0, 0, 0), radius: 0.5 }} }}
                    contacts {{ touch {{ {geometry}, along: floor, restitution: 0, friction: 0.3 }} }}
                }}"
            ));
        }
    }
}
