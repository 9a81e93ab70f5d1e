//! Volumes and moments of inertia of simple solids.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

/// Entries of sums with cancellation below this fraction of the largest entry are round-off.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Shapes with the numbers of `size`, in m: half lengths, and radii.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    Sphere {
        radius: f64,
    },
    /// The half length is that of the cylinder between the hemispheres.
    Capsule {
        radius: f64,
        half: f64,
    },
    Cylinder {
        radius: f64,
        half: f64,
    },
    Ellipsoid {
        radii: [f64; 3],
    },
    Box {
        halves: [f64; 3],
    },
}

impl Shape {
    /// The volume in m³.
    pub fn volume(self) -> f64 {
        match self {
            Shape::Sphere { radius } => 4.0 / 3.0 * PI * radius.powi(3),
            Shape::Capsule { radius, half } => {
                PI * radius * radius * (4.0 / 3.0 * radius + 2.0 * half)
            }
            Shape::Cylinder { radius, half } => 2.0 * PI * radius * radius * half,
            Shape::Ellipsoid { radii: [a, b, c] } => 4.0 / 3.0 * PI * a * b * c,
            Shape::Box { halves: [a, b, c] } => 8.0 * a * b * c,
        }
    }

    /// Moments about the shape's own axes for a mass of 1 kg, in m².
    pub fn moments(self) -> [f64; 3] {
        let of_ellipsoid = |[a, b, c]: [f64; 3]| {
            [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| sum / 5.0)
        };
        match self {
            Shape::Sphere { radius } => of_ellipsoid([radius; 3]),
            Shape::Ellipsoid { radii } => of_ellipsoid(radii),
            Shape::Box { halves: [a, b, c] } => {
                [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| sum / 3.0)
            }
            Shape::Cylinder { radius, half } => {
                let across = radius * radius / 4.0 + half * half / 3.0;
                [across, across, radius * radius / 2.0]
            }
            Shape::Capsule { radius, half } => {
                // Two hemispheres, whose centres of mass are 3/8 of the radius from their flat sides.
                let ball = 4.0 * radius / (4.0 * radius + 6.0 * half);
                let tube = 1.0 - ball;
                let [square, length] = [radius * radius, half * half];
                let across = tube * (square / 4.0 + length / 3.0)
                    + ball * (0.4 * square + length + 0.75 * radius * half);
                let along = tube * square / 2.0 + ball * 0.4 * square;
                [across, across, along]
            }
        }
    }
}

/// A solid in a body: its mass, its centre of mass, and the tensor about it in the axes of the body.
#[derive(Clone, Debug)]
pub struct Solid {
    pub mass: f64,
    pub centre: Vector3<f64>,
    pub tensor: Matrix3<f64>,
}

impl Solid {
    /// A shape with the columns of `axes` as its axes.
    pub fn of(shape: Shape, mass: f64, centre: Vector3<f64>, axes: &Matrix3<f64>) -> Solid {
        let moments = Matrix3::from_diagonal(&Vector3::from(shape.moments()));
        Solid {
            mass,
            centre,
            tensor: axes * moments * axes.transpose() * mass,
        }
    }

    /// Combines several solids, about their common centre (Steiner).
    pub fn combine(parts: &[Solid]) -> Solid {
        if let [only] = parts {
            return Solid {
                tensor: without_roundoff(only.tensor),
                ..only.clone()
            };
        }
        let mass = parts.iter().map(|part| part.mass).sum::<f64>();
        let moment: Vector3<f64> = parts.iter().map(|part| part.centre * part.mass).sum();
        let extent = parts
            .iter()
            .fold(0.0, |m: f64, part| m.max(part.centre.amax()));
        let centre = (moment / mass).map(|x| if x.abs() <= ROUNDING * extent { 0.0 } else { x });
        let shifted = |part: &Solid| {
            let d = part.centre - centre;
            let about = Matrix3::identity() * d.norm_squared() - d * d.transpose();
            part.tensor + about * part.mass
        };
        Solid {
            mass,
            centre,
            tensor: without_roundoff(parts.iter().map(shifted).sum()),
        }
    }
}

fn without_roundoff(tensor: Matrix3<f64>) -> Matrix3<f64> {
    let largest = tensor.amax();
    tensor.map(|entry| {
        if entry.abs() <= ROUNDING * largest {
            0.0
        } else {
            entry
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums over a grid of points: an independent way to compute the integrals, with a moderately fine grid.
    #[test]
    fn shapes_weigh_what_sums_over_points_say() {
        const POINTS: i32 = 60;
        type IsInside = fn(Vector3<f64>) -> bool;
        let shapes: [(Shape, IsInside); 5] = [
            (Shape::Sphere { radius: 0.9 }, |x| x.norm() <= 0.9),
            (
                Shape::Capsule {
                    radius: 0.3,
                    half: 0.6,
                },
                |x| {
                    let off = x.z - x.z.clamp(-0.6, 0.6);
                    Vector3::new(x.x, x.y, off).norm() <= 0.3
                },
            ),
            (
                Shape::Cylinder {
                    radius: 0.5,
                    half: 0.8,
                },
                |x| x.x.hypot(x.y) <= 0.5 && x.z.abs() <= 0.8,
            ),
            (
                Shape::Ellipsoid {
                    radii: [0.4, 0.6, 0.9],
                },
                |x| Vector3::new(x.x / 0.4, x.y / 0.6, x.z / 0.9).norm() <= 1.0,
            ),
            (
                Shape::Box {
                    halves: [0.2, 0.5, 0.7],
                },
                |x| x.x.abs() <= 0.2 && x.y.abs() <= 0.5 && x.z.abs() <= 0.7,
            ),
        ];
        for (shape, is_inside) in shapes {
            let cell = 2.0 / f64::from(POINTS);
            let (mut volume, mut moments) = (0.0, Vector3::zeros());
            let middle = |i: i32| (f64::from(i) + 0.5) * cell - 1.0;
            for (i, j) in (0..POINTS).flat_map(|i| (0..POINTS).map(move |j| (i, j))) {
                for k in 0..POINTS {
                    let x = Vector3::new(middle(i), middle(j), middle(k));
                    if is_inside(x) {
                        volume += cell.powi(3);
                        let square = x.component_mul(&x);
                        moments += (Vector3::repeat(square.sum()) - square) * cell.powi(3);
                    }
                }
            }
            // A cell at the surface counts as inside or outside: the error is half a cell on all sides at the
            // smallest radius, and less because errors average out.
            let share = cell / 0.2 / 4.0;
            assert!((volume / shape.volume() - 1.0).abs() < share, "{shape:?}");
            for (sum, exact) in moments.iter().zip(shape.moments()) {
                assert!(
                    (sum / volume / exact - 1.0).abs() < 2.0 * share,
                    "{shape:?}"
                );
            }
        }
    }
}
