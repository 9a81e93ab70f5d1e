//! Ends level with the start, which the closed form does not cover: no energy may be lost, and the motion ends at rest.

use std::f64::consts::PI;

use lagrangian_brachistochrone::Unsolved;
use lagrangian_brachistochrone::direct::{Sought, Terrain};
use lagrangian_scalar::Scalar;

use crate::terrains::{Any, solve};

const G: f64 = 9.81;

#[derive(Clone, Copy, Debug)]
pub enum Field {
    /// Inside a uniform sphere of radius 1 m, where a body would oscillate as cos t.
    Sphere,
    /// Uniform gravity along the second coordinate, downwards.
    Weight,
}

/// A particle of 1 kg in Cartesian coordinates, with air drag of the dissipation function `½ drag v²`.
#[derive(Clone, Debug)]
pub struct Particle {
    dimension: usize,
    field: Field,
    drag: f64,
}

impl Terrain for Particle {
    fn coordinates(&self) -> usize {
        self.dimension
    }
    fn inertia<N: Scalar>(&self, _: &[N]) -> Vec<N> {
        let n = self.dimension;
        let entry = |k: usize| {
            if k.is_multiple_of(n + 1) {
                N::ONE
            } else {
                N::ZERO
            }
        };
        (0..n * n).map(entry).collect()
    }
    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        let drag = v.iter().map(|v| N::from_f64(self.drag) * *v);
        let mut resistance: Vec<N> = match self.field {
            Field::Sphere => drag.zip(q).map(|(drag, x)| drag + *x).collect(),
            Field::Weight => drag.collect(),
        };
        if let Field::Weight = self.field {
            resistance[1] = resistance[1] + N::from_f64(G);
        }
        resistance
    }
}

/// A particle under gravity in polar coordinates r, φ, with φ from the downward vertical.
#[derive(Clone, Debug)]
pub struct Weight;

impl Terrain for Weight {
    fn coordinates(&self) -> usize {
        2
    }
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        vec![N::ONE, N::ZERO, N::ZERO, q[0] * q[0]]
    }
    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        let (sin, cos) = q[1].sin_cos();
        let (r, g, two) = (q[0], N::from_f64(G), N::from_f64(2.0));
        vec![
            -(r * v[1] * v[1] + g * cos),
            two * r * v[0] * v[1] + r * g * sin,
        ]
    }
}

#[track_caller]
fn takes(what: &str, found: Result<Sought<Any>, Unsolved>, expected: f64) {
    let found = found.unwrap_or_else(|error| panic!("{what}: {error}"));
    let error = (found.time() / expected - 1.0).abs();
    let time = found.time();
    assert!(error < 1e-11, "{what}: {time}, not {expected}: {error:.1e}");
    // It is at rest at the end, and H is 1 during the motion.
    let end = found.at(found.time());
    let half = found.at(0.5 * found.time());
    let speed = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>().sqrt();
    assert!(
        speed(&end.v) < 1e-10 * speed(&half.v),
        "{what}: {:?}",
        end.v
    );
    assert!(found.residual() < 1e-9, "{what}: {:.1e}", found.residual());
}

/// The whole hypocycloid of a circle of radius a in one of radius 1 m takes `2π √(a (1 − a))` s to the angle 2π a; G. Venezian,
/// *Terrestrial brachistochrone*, Am. J. Phys. 34 (1966) 701.
#[test]
fn across_a_sphere_along_a_whole_hypocycloid() {
    for (dimension, a) in [(2, 0.05), (2, 0.2), (2, 0.4), (3, 0.2)] {
        let sphere = Particle {
            dimension,
            field: Field::Sphere,
            drag: 0.0,
        };
        let (sin, cos) = (2.0 * PI * a).sin_cos();
        let [from, to] = match dimension {
            2 => [vec![1.0, 0.0], vec![cos, sin]],
            _ => [vec![1.0, 0.0, 0.0], vec![cos, 0.6 * sin, 0.8 * sin]],
        };
        let what = format!("{a} in {dimension} coordinates");
        takes(
            &what,
            solve(sphere, &from, &to),
            2.0 * PI * (a * (1.0 - a)).sqrt(),
        );
    }
}

/// One arch of a cycloid of width d takes `√(2π d/g)`.
#[test]
fn along_a_whole_cycloid() {
    for d in [0.3, 2.0] {
        let time = (2.0 * PI * d / G).sqrt();
        for dimension in [2, 3] {
            let weight = Particle {
                dimension,
                field: Field::Weight,
                drag: 0.0,
            };
            let mut to = vec![0.0; dimension];
            to[0] = d;
            let what = format!("{d} m in {dimension} coordinates");
            takes(&what, solve(weight, &vec![0.0; dimension], &to), time);
        }
        // About a point 0.7 m above the middle, and one 1 m to the side of it.
        for (x, y) in [(0.0, 0.7), (1.0, 0.9)] {
            let place = |side: f64| {
                let from_point = [side * d / 2.0 - x, y];
                vec![
                    from_point[0].hypot(from_point[1]),
                    from_point[0].atan2(from_point[1]),
                ]
            };
            let what = format!("{d} m about a point at {x}, {y}");
            takes(&what, solve(Weight, &place(-1.0), &place(1.0)), time);
        }
    }
}

#[test]
fn what_loses_energy_does_not_get_there() {
    let air = Particle {
        dimension: 2,
        field: Field::Weight,
        drag: 0.2,
    };
    let found = solve(air, &[0.0, 0.0], &[1.0, 0.0]).map(|found| found.time());
    assert!(matches!(found, Err(Unsolved::NotBelow { .. })), "{found:?}");
}
