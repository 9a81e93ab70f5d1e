//! Tests of the direct method: closed forms in other coordinates, machines outside of the conditions (17),
//! and its order of convergence.
pub mod friction;
pub mod hill;

use std::f64::consts::PI;

use lagrangian_brachistochrone::Unsolved;
use lagrangian_brachistochrone::direct::{Sought, Terrain, solve_on};
use lagrangian_scalar::Scalar;

use crate::terrains::{Any, solve};

const G: f64 = 9.81;

/// Times to (1, 1) without friction and with a friction of 0.1; the closed forms are in `closed_form.rs`.
const CYCLOID: f64 = 0.582895463154743;
const ASHBY: f64 = 0.610344506565018;

#[track_caller]
fn close(name: &str, value: f64, expected: f64, relative: f64) {
    let error = (value - expected).abs() / expected.abs();
    assert!(
        error <= relative,
        "{name} is {value}, not {expected}: {error:.1e} off"
    );
}

/// A particle of 1 kg on a rough wire, x to the right, y down: `A = 1 + d`, `R = (μ g, −g)`.
#[derive(Clone, Debug)]
pub struct Wire {
    friction: f64,
}

impl Terrain for Wire {
    fn coordinates(&self) -> usize {
        2
    }
    fn inertia<N: Scalar>(&self, _: &[N]) -> Vec<N> {
        let mu = N::from_f64(self.friction);
        vec![N::ONE, -mu, mu, N::ONE]
    }
    fn resistance<N: Scalar>(&self, _: &[N], _: &[N]) -> Vec<N> {
        vec![N::from_f64(self.friction * G), N::from_f64(-G)]
    }
    fn with_friction(&self, share: f64) -> Option<Wire> {
        let friction = share * self.friction;
        Some(Wire { friction })
    }
}

#[test]
fn a_machine_with_constant_coefficients_has_its_closed_form() {
    let [smooth, rough] = [0.0, 0.1].map(|friction| {
        let found = solve(Wire { friction }, &[0.0, 0.0], &[1.0, 1.0]);
        found.unwrap_or_else(|error| panic!("{error}"))
    });
    close("cycloid", smooth.time(), CYCLOID, 1e-13);
    close("Ashby", rough.time(), ASHBY, 1e-13);
}

/// The wire in polar coordinates r, φ about a point: `A` becomes `Jᵀ A J`, and `R` becomes `Jᵀ (A J̇ v + R)`.
#[derive(Clone, Debug)]
pub struct Polar {
    wire: Wire,
    centre: [f64; 2],
}

impl Polar {
    fn of(&self, x: f64, y: f64) -> [f64; 2] {
        let [x, y] = [x - self.centre[0], y - self.centre[1]];
        [x.hypot(y), y.atan2(x)]
    }
}

impl Terrain for Polar {
    fn coordinates(&self) -> usize {
        2
    }
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        // J is a rotation by φ times diag(1, r), and the wire's A is isotropic.
        let [r, mu] = [q[0], N::from_f64(self.wire.friction)];
        vec![N::ONE, -mu * r, mu * r, r * r]
    }
    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        let (sin, cos) = q[1].sin_cos();
        let mu = N::from_f64(self.wire.friction);
        // J̇ v in the directions of r and φ.
        let [ahead, aside] = [-q[0] * v[1] * v[1], v[0] * v[1] + v[0] * v[1]];
        let force = self.wire.resistance(q, v);
        let along = ahead - mu * aside + force[0] * cos + force[1] * sin;
        let across = mu * ahead + aside - force[0] * sin + force[1] * cos;
        vec![along, q[0] * across]
    }
    fn with_friction(&self, share: f64) -> Option<Polar> {
        let (wire, centre) = (self.wire.with_friction(share)?, self.centre);
        Some(Polar { wire, centre })
    }
}

#[test]
fn the_same_in_polar_coordinates() {
    for (friction, time) in [(0.0, CYCLOID), (0.1, ASHBY)] {
        for centre in [[2.0, -1.0], [-0.5, 3.0]] {
            let polar = Polar {
                wire: Wire { friction },
                centre,
            };
            let (from, to) = (polar.of(0.0, 0.0), polar.of(1.0, 1.0));
            let found = solve(polar, &from, &to).unwrap_or_else(|error| panic!("{error}"));
            close("time", found.time(), time, 1e-12);
            assert!(found.residual() < 1e-10, "{}", found.residual());
            obeys_energy(&found);
        }
    }
}

/// Checks that the control forces do no work, and that the velocity is the rate of the coordinates.
fn obeys_energy(found: &Sought<Any>) {
    let n = found.terrain().coordinates();
    for step in 1..40 {
        let t = found.time() * f64::from(step) / 40.0;
        let m = found.at(t);
        let work: f64 = (0..n).map(|i| m.control[i] * m.v[i]).sum();
        let size: f64 = (0..n).map(|i| (m.control[i] * m.v[i]).abs()).sum();
        assert!(work.abs() <= 1e-10 * size.max(1.0), "{work} W of {size} W");
        let h = 1e-4 * found.time();
        let [before, after] = [t - h, t + h].map(|t| found.at(t));
        for i in 0..n {
            let rate = (after.q[i] - before.q[i]) / (2.0 * h);
            assert!(
                (rate - m.v[i]).abs() < 1e-5 * (1.0 + m.v[i].abs()),
                "{rate} {}",
                m.v[i]
            );
            let rate = (after.v[i] - before.v[i]) / (2.0 * h);
            assert!(
                (rate - m.a[i]).abs() < 1e-5 * (1.0 + m.a[i].abs()),
                "{rate} {}",
                m.a[i]
            );
        }
    }
}

/// With s = 4 Gauss points the error of the time is of order 8.
#[test]
fn the_time_converges_at_its_order() {
    let polar = Polar {
        wire: Wire { friction: 0.1 },
        centre: [2.0, -1.0],
    };
    let (from, to) = (polar.of(0.0, 0.0), polar.of(1.0, 1.0));
    let errors: Vec<f64> = [1, 2, 4]
        .iter()
        .map(|&stretches| {
            let found = solve_on(Any::from(polar.clone()), &from, &to, stretches);
            (found.expect("a motion").time() / ASHBY - 1.0).abs()
        })
        .collect();
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 7.0, "{errors:?}");
    }
}

/// A particle in a potential of the distance from the origin, in `dimension` Cartesian coordinates.
#[derive(Clone, Debug)]
pub struct Central {
    dimension: usize,
    /// Selects `Π′(r)/r` for `Π = −1/r` instead of `Π = r²/2`.
    attracts: bool,
}

impl Terrain for Central {
    fn coordinates(&self) -> usize {
        self.dimension
    }
    fn inertia<N: Scalar>(&self, _: &[N]) -> Vec<N> {
        let n = self.dimension;
        (0..n * n)
            .map(|k| if k % (n + 1) == 0 { N::ONE } else { N::ZERO })
            .collect()
    }
    fn resistance<N: Scalar>(&self, q: &[N], _: &[N]) -> Vec<N> {
        let square = q.iter().fold(N::ZERO, |sum, x| sum + *x * *x);
        let slope = if self.attracts {
            N::ONE / (square * square.sqrt())
        } else {
            N::ONE
        };
        q.iter().map(|x| *x * slope).collect()
    }
}

/// Inside a uniform sphere of radius 1, where a body would oscillate as cos t, the fastest path is a hypocycloid, made by a
/// circle of radius a that rolls inside. To its deepest point, at `1 − 2a` and the angle `π a`, it takes `π √(a (1 − a))`; the
/// whole path, which takes twice that, is in G. Venezian, *Terrestrial brachistochrone*, Am. J. Phys. 34 (1966) 701.
#[test]
fn through_a_sphere_along_a_hypocycloid() {
    for a in [0.05, 0.2, 0.4] {
        let (sin, cos) = (PI * a).sin_cos();
        let depth = 1.0 - 2.0 * a;
        for dimension in [2, 3] {
            // In space the motion is in an inclined plane.
            let place = |x: f64, y: f64| match dimension {
                2 => vec![x, y],
                _ => vec![x, 0.6 * y, 0.8 * y],
            };
            let sphere = Central {
                dimension,
                attracts: false,
            };
            let found = solve(sphere, &place(1.0, 0.0), &place(depth * cos, depth * sin));
            let found = found.unwrap_or_else(|error| panic!("{dimension}: {a}: {error}"));
            close("time", found.time(), PI * (a * (1.0 - a)).sqrt(), 1e-12);
            obeys_energy(&found);
        }
    }
}

/// About an attracting centre: Snell's law `r² φ̇/V² = K` with `V² = 2 (1/r − 1)`, and two quadratures.
fn kepler(angle: f64, depth: f64) -> f64 {
    // r = 1 − (1 − depth) σ² removes the square root at the start; three-point Gauss quadrature on many intervals.
    let integrals = |k: f64| -> [f64; 2] {
        let (steps, mut sums) = (4000, [0.0; 2]);
        for step in 0..steps {
            for (z, weight) in [
                (-0.6_f64.sqrt(), 5.0 / 18.0),
                (0.0, 8.0 / 18.0),
                (0.6_f64.sqrt(), 5.0 / 18.0),
            ] {
                let sigma = (f64::from(step) + 0.5 + 0.5 * z) / f64::from(steps);
                let r = 1.0 - (1.0 - depth) * sigma * sigma;
                let speed = (2.0 * (1.0 / r - 1.0)).sqrt();
                let by_sigma = 2.0 * (1.0 - depth) * sigma * weight / f64::from(steps);
                let root = (r * r - k * k * speed * speed).sqrt();
                sums[0] += by_sigma * k * speed / (r * root);
                sums[1] += by_sigma * r / (speed * root);
            }
        }
        sums
    };
    let greatest = depth / (2.0 * (1.0 / depth - 1.0)).sqrt();
    let (mut low, mut high) = (0.0, greatest);
    for _ in 0..60 {
        let k = (low + high) / 2.0;
        if integrals(k)[0] < angle {
            low = k
        } else {
            high = k
        }
    }
    integrals(low)[1]
}

#[test]
fn about_an_attracting_centre() {
    for (angle, depth) in [(0.3_f64, 0.5), (0.5, 0.4)] {
        let sun = Central {
            dimension: 2,
            attracts: true,
        };
        let (sin, cos) = angle.sin_cos();
        let found = solve(sun, &[1.0, 0.0], &[depth * cos, depth * sin]);
        let found = found.unwrap_or_else(|error| panic!("{error}"));
        close("time", found.time(), kepler(angle, depth), 1e-10);
    }
}

/// A particle with air drag of the dissipation function `½ k v²`, in the plane or in an inclined plane in space: two formulations.
#[derive(Clone, Debug)]
pub struct Drag {
    dimension: usize,
    drag: f64,
}

impl Terrain for Drag {
    fn coordinates(&self) -> usize {
        self.dimension
    }
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        Central {
            dimension: self.dimension,
            attracts: false,
        }
        .inertia(q)
    }
    fn resistance<N: Scalar>(&self, _: &[N], v: &[N]) -> Vec<N> {
        let mut resistance: Vec<N> = v.iter().map(|v| N::from_f64(self.drag) * *v).collect();
        resistance[0] = resistance[0] - N::from_f64(G);
        resistance
    }
}

#[test]
fn drag_is_the_same_in_the_plane_and_in_space() {
    let time = |drag: f64, to: &[f64]| {
        let air = Drag {
            dimension: to.len(),
            drag,
        };
        let found = solve(air, &vec![0.0; to.len()], to).unwrap_or_else(|error| panic!("{error}"));
        obeys_energy(&found);
        found.time()
    };
    let plane = time(0.7, &[1.0, 1.0]);
    close("in space", time(0.7, &[1.0, 0.28, 0.96]), plane, 1e-12);
    close(
        "without drag",
        time(0.0, &[1.0, 0.28, 0.96]),
        CYCLOID,
        1e-12,
    );
    assert!(plane > CYCLOID);
    // Straight down, V̇ = g − k V: distance and time of the fall have closed forms.
    let k = 0.7;
    let fall = |t: f64| G / k * (t - (1.0 - (-k * t).exp()) / k);
    for to in [vec![2.0, 0.0], vec![2.0, 0.0, 0.0], vec![2.0]] {
        close("way", fall(time(k, &to)), 2.0, 1e-12);
    }
}

#[test]
fn what_has_no_answer_says_why() {
    let wire =
        |to: &[f64]| solve(Wire { friction: 0.1 }, &[0.0, 0.0], to).map(|found| found.time());
    assert_eq!(wire(&[0.0, 0.0]), Err(Unsolved::SameEnds));
    assert!(matches!(wire(&[1.0]), Err(Unsolved::Size { .. })));
    assert!(matches!(
        wire(&[1.0, f64::NAN]),
        Err(Unsolved::NotFinite { .. })
    ));
    assert!(matches!(wire(&[1.0, -1.0]), Err(Unsolved::NotBelow { .. })));
    assert!(matches!(wire(&[1.0, 0.05]), Err(Unsolved::NotBelow { .. })));
    // Away from an attracting centre, and through it.
    let sun = |to: &[f64]| {
        let found = solve(
            Central {
                dimension: 2,
                attracts: true,
            },
            &[1.0, 0.0],
            to,
        );
        found.map(|found| found.time())
    };
    assert!(matches!(sun(&[1.5, 0.5]), Err(Unsolved::NotBelow { .. })));
    // Friction outweighs the inertia from the start.
    let jammed = Wire { friction: 0.1 };
    let jammed = Scaled {
        inner: jammed,
        by: -1.0,
    };
    let found = solve(jammed, &[0.0, 0.0], &[1.0, 1.0]).map(|found| found.time());
    assert!(
        matches!(found, Err(Unsolved::FrictionOutweighsInertia { .. })),
        "{found:?}"
    );
    // In space a skew part of `A` lets loops gain speed.
    let found = solve(Skew, &[0.0; 3], &[1.0; 3]).map(|found| found.time());
    assert!(
        matches!(
            found,
            Err(Unsolved::LoopsFeed {
                coordinates: [0, 1],
                ..
            })
        ),
        "{found:?}"
    );
}

#[derive(Clone, Debug)]
pub struct Scaled {
    inner: Wire,
    by: f64,
}

impl Terrain for Scaled {
    fn coordinates(&self) -> usize {
        2
    }
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        let inertia = self.inner.inertia(q).into_iter();
        inertia.map(|a| N::from_f64(self.by) * a).collect()
    }
    fn resistance<N: Scalar>(&self, q: &[N], v: &[N]) -> Vec<N> {
        self.inner.resistance(q, v)
    }
}

#[derive(Clone, Debug)]
pub struct Skew;

impl Terrain for Skew {
    fn coordinates(&self) -> usize {
        3
    }
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        let mut inertia = Central {
            dimension: 3,
            attracts: false,
        }
        .inertia(q);
        (inertia[1], inertia[3]) = (N::from_f64(0.1), N::from_f64(-0.1));
        inertia
    }
    fn resistance<N: Scalar>(&self, _: &[N], _: &[N]) -> Vec<N> {
        vec![N::from_f64(-G); 3]
    }
}

/// A ridge, `Π = −g x − ½ k y²`. By symmetry the straight path is an extremal, but if the ridge is sharp or the path long,
/// leaving it is faster.
#[derive(Clone, Debug)]
pub struct Ridge {
    sharpness: f64,
}

impl Terrain for Ridge {
    fn coordinates(&self) -> usize {
        2
    }
    fn inertia<N: Scalar>(&self, q: &[N]) -> Vec<N> {
        Central {
            dimension: 2,
            attracts: false,
        }
        .inertia(q)
    }
    fn resistance<N: Scalar>(&self, q: &[N], _: &[N]) -> Vec<N> {
        vec![N::from_f64(-G), N::from_f64(-self.sharpness) * q[1]]
    }
}

#[test]
fn an_extremal_beside_which_it_is_faster_is_refused() {
    let along = |sharpness: f64| {
        let found = solve(Ridge { sharpness }, &[0.0, 0.0], &[1.0, 0.0]);
        found.map(|found| found.time())
    };
    close(
        "time",
        along(1.0).expect("a motion"),
        (2.0 / G).sqrt(),
        1e-12,
    );
    // The time along y = η x (1 − x), by quadrature; on a sharp ridge it is less than along y = 0.
    let time = |sharpness: f64, eta: f64| {
        let steps = 20_000;
        let stretch = |k: u32| {
            // The substitution x = σ².
            let sigma = (f64::from(k) + 0.5) / f64::from(steps);
            let x = sigma * sigma;
            let (y, slope) = (eta * x * (1.0 - x), eta * (1.0 - 2.0 * x));
            let speed = (2.0 * G * x + sharpness * y * y).sqrt();
            (1.0 + slope * slope).sqrt() * 2.0 * sigma / speed / f64::from(steps)
        };
        (0..steps).map(stretch).sum::<f64>()
    };
    let sharp = 400.0;
    assert!(
        time(sharp, 0.05) < time(sharp, 0.0),
        "the ridge is not sharp enough"
    );
    let found = along(sharp);
    assert!(
        !matches!(found, Ok(t) if (t - (2.0 / G).sqrt()).abs() < 1e-6),
        "{found:?}"
    );
}
