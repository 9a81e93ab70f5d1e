//! Friction along curves in space, where a guide presses in two directions, tested against closed forms, equations typed by hand,
//! and the same machine in the plane.

use super::{assert_near, events, run, value};
use crate::support::library::{interpreted, machine};
use crate::support::random::SplitMix;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{At, ContactForce, Error, Machine, System, contact_forces};

/// The distance that a bead travels on a helix from rest to a given speed, or from a speed to rest. With `κ = r/L²` and
/// `L² = r² + h²` the wire presses on it with `|N| = m √(κ²w⁴ + g² cos²β)`, so that
///
/// ```text
/// ½ d(w²)/ds = g sin β − μ √(κ²w⁴ + g² cos²β)
/// s = (cos β/2κ) ∫ cosh u du/(A − B cosh u),    κ w² = g cos β sinh u,  A = sin β,  B = μ cos β.
/// ```
struct Helix {
    radius: f64,
    length: f64,
    sin: f64,
    cos: f64,
    mu: f64,
}

const G: f64 = 9.81;

impl Helix {
    fn new(radius: f64, down: f64, mu: f64) -> Helix {
        let length = radius.hypot(down);
        Helix {
            radius,
            length,
            sin: down / length,
            cos: radius / length,
            mu,
        }
    }

    fn curvature(&self) -> f64 {
        self.radius / (self.length * self.length)
    }

    /// The integral from rest to a given speed.
    fn way(&self, speed: f64) -> f64 {
        let (a, b) = (self.sin, self.mu * self.cos);
        let u = (self.curvature() * speed * speed / (G * self.cos)).asinh();
        let half = (0.5 * u).tanh();
        let inner = if a > b {
            let root = ((a - b) * (a + b)).sqrt();
            2.0 / root * (half * ((a + b) / (a - b)).sqrt()).atanh()
        } else {
            let root = ((b - a) * (b + a)).sqrt();
            -2.0 / root * (half * ((b + a) / (b - a)).sqrt()).atan()
        };
        self.cos / (2.0 * self.curvature()) * (a / b * inner - u / b)
    }
}

#[test]
fn a_bead_on_a_helix_gains_speed_as_the_closed_form_says() {
    let helix = Helix::new(0.2, 0.1, 0.3);
    let run = run(&interpreted("bead_on_helix"), &[], &[], (1e-12, 3.0)).expect("it runs");
    for t in [0.05, 0.3, 1.0, 3.0] {
        let state = run.observe(t).expect("in the run");
        let speed = helix.length * value(&state.v, "theta");
        let way = helix.length * value(&state.q, "theta");
        // An error of the speed causes an error of the distance by ds/dw, which grows towards the terminal speed; the speed errs
        // by 1e-12 in each of a few tens of steps.
        let (more, less) = (
            helix.way(speed * (1.0 + 1e-10)),
            helix.way(speed * (1.0 - 1e-10)),
        );
        assert_near(way, helix.way(speed), (more - less) + 1e-10 * way);
    }
    // It never reaches the terminal speed, at which friction balances gravity.
    let tan = helix.sin / helix.cos;
    let last = (G * helix.cos / helix.curvature()).sqrt()
        * ((tan / helix.mu) * (tan / helix.mu) - 1.0).sqrt().sqrt();
    let speed = helix.length * value(&run.end().v, "theta");
    assert!(speed < last && speed > 0.99 * last, "{speed} of {last}");
    let balance = run.energy_balance().expect("kept");
    assert!(balance.relative().abs() < 1e-10, "{balance:?}");
}

#[test]
fn a_bead_comes_to_rest_on_a_flat_helix_and_stays() {
    for down in [0.04, 0.0] {
        let helix = Helix::new(0.2, down, 0.3);
        let start = [("theta", 0.0, 12.0)];
        let run = run(
            &interpreted("bead_on_helix"),
            &[("h", down)],
            &start,
            (1e-12, 100.0),
        )
        .expect("it runs");
        let [(name, _)] = &events(&run)[..] else {
            panic!("{:?}", run.events());
        };
        assert_eq!(name, "wire sticks");
        let speed = 12.0 * helix.length;
        let way = -helix.way(speed);
        if down == 0.0 {
            // On a circle, the distance is an inverse hyperbolic sine.
            let turned = (speed * speed / (G * 0.2)).asinh() / (2.0 * 0.3);
            assert_near(way, 0.2 * turned, 1e-14 * way);
        }
        let rest = value(&run.events()[0].state.q, "theta");
        assert_near(helix.length * rest, way, 1e-10 * way);
        // It stays in place to the last bit.
        assert_eq!(value(&run.end().q, "theta"), rest);
        assert_eq!(value(&run.end().v, "theta"), 0.0);
        // All its energy was dissipated.
        let balance = run.energy_balance().expect("kept");
        let had = 0.5 * 0.01 * speed * speed + 0.01 * G * down * rest;
        assert!(balance.relative().abs() < 1e-10, "{balance:?}");
        assert_near(balance.dissipated, had, 1e-10 * had);
        // Friction equals the downhill force, and the wire carries the other component of the weight.
        let [wire] = run.observe(50.0).expect("in the run").contacts[..] else {
            panic!("one contact");
        };
        assert!(wire.sticks);
        assert_near(wire.friction, -0.01 * G * helix.sin, 1e-14);
        assert_near(wire.normal, 0.01 * G * helix.cos, 1e-14);
    }
}

/// Acceleration and contact force at a state, for a machine with one coordinate and one guide.
fn at(machine: &InterpretedMachine, t: f64, q: f64, v: f64) -> Result<(f64, ContactForce), ()> {
    let system = machine.prepare();
    let mut a = vec![0.0];
    let mut forces = [ContactForce::default()];
    let state = At {
        t,
        q: &vec![q],
        v: &vec![v],
        u: &system.default_inputs(),
    };
    contact_forces(&system, state, &mut a, &mut [], &mut forces).map_err(|_| ())?;
    Ok((a[0], forces[0]))
}

#[test]
fn a_bead_on_a_hoop_that_is_turned_obeys_the_equations_typed_by_hand() {
    let machine = interpreted("bead_on_hoop");
    let (m, r, omega, mu) = (0.01, 0.2, 10.0, 0.2);
    let mut draws = SplitMix::new(8);
    let (mut resting, mut sliding) = (0, 0);
    for _ in 0..400 {
        let t = draws.uniform(0.0, 3.0);
        let theta: f64 = draws.uniform(-3.2, 3.2);
        let (sin, cos) = theta.sin_cos();
        for rate in [draws.uniform(-20.0, 20.0), 0.0] {
            // The normal forces in the plane of the hoop, and across it.
            let within = m * (r * rate * rate + omega * omega * r * sin * sin + G * cos);
            let across = 2.0 * m * omega * r * cos * rate;
            let normal = within.hypot(across);
            let pulls = m * (omega * omega * r * sin * cos - G * sin);
            let (a, wire) = at(&machine, t, theta, rate).expect("it moves");
            let size = m * (G + r * rate * rate + omega * omega * r) + across.abs();
            assert_near(wire.normal, normal, 1e-13 * size);
            let friction = if rate == 0.0 && pulls.abs() <= mu * normal {
                resting += 1;
                assert!(wire.sticks, "{theta}");
                -pulls
            } else {
                sliding += 1;
                assert!(!wire.sticks, "{theta} {rate}");
                let way = if rate == 0.0 { pulls } else { rate };
                -mu * normal * way.signum()
            };
            assert_near(wire.friction, friction, 1e-13 * size);
            assert_near(a, (pulls + friction) / (m * r), 1e-12 * size / (m * r));
        }
    }
    assert!(resting > 50 && sliding > 400, "{resting} {sliding}");
}

#[test]
fn friction_on_a_hoop_takes_what_its_motor_gives() {
    // It starts near the height of its equilibrium without friction, slides, and sticks.
    let start = [("theta", 0.3, 0.0)];
    let run = run(&interpreted("bead_on_hoop"), &[], &start, (1e-11, 20.0)).expect("it runs");
    let names: Vec<String> = events(&run).into_iter().map(|(name, _)| name).collect();
    assert_eq!(
        names.last().map(String::as_str),
        Some("wire sticks"),
        "{names:?}"
    );
    assert_eq!(value(&run.end().v, "theta"), 0.0);
    // Where it sticks, the friction that it needs is available.
    let theta = value(&run.end().q, "theta");
    let (sin, cos) = theta.sin_cos();
    let pulls = 100.0 * 0.2 * sin * cos - G * sin;
    assert!(pulls.abs() <= 0.2 * (100.0 * 0.2 * sin * sin + G * cos).abs());
    let balance = run.energy_balance().expect("kept");
    assert!(balance.relative().abs() < 1e-9, "{balance:?}");
}

#[test]
fn prisms_in_space_are_those_in_the_plane() {
    let plane = interpreted("prisms");
    let in_space = machine(
        "machine Prisms in space {
            parameters { m: kg = 32/13, M: kg = 20/13, alpha: rad = pi/4, mu1: 1 = 1/10, mu2: 1 = 1/50, g: m/s^2 = 9.81 }
            coordinates { q1: m, q2: m }
            frames { wedge = ground.shift(0, q1, 0), slider = wedge.shift(0, -q2, -q2*tan(alpha)) }
            bodies { wedge { mass: M, frame: wedge }, slider { mass: m, frame: slider } }
            gravity (0, 0, -g);
            sliding {
                floor { body: wedge, on: ground, direction: (0, 1, 0), friction: mu2 },
                incline { body: slider, on: wedge, direction: (0, -cos(alpha), -sin(alpha)), friction: mu1 },
            }
        }",
    );
    let mut draws = SplitMix::new(5);
    for _ in 0..100 {
        let mu = [draws.uniform(0.0, 0.5), draws.uniform(0.0, 0.5)];
        let v = [draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0)].to_vec();
        let q = [draws.uniform(-1.0, 1.0), draws.uniform(-1.0, 1.0)].to_vec();
        let of = |machine: &InterpretedMachine| {
            let mut machine = machine.clone();
            machine.set("mu1", mu[0]).expect("a parameter");
            machine.set("mu2", mu[1]).expect("a parameter");
            let system = machine.prepare();
            let mut a = vec![0.0; 2];
            let mut forces = [ContactForce::default(); 2];
            let state = At {
                t: 0.0,
                q: &q,
                v: &v,
                u: &system.default_inputs(),
            };
            contact_forces(&system, state, &mut a, &mut [], &mut forces).expect("it moves");
            (a, forces)
        };
        let ((a, forces), (a_in_space, in_space)) = (of(&plane), of(&in_space));
        for (a, in_space) in a.iter().zip(a_in_space) {
            assert_near(in_space, *a, 1e-12 * G);
        }
        for (force, in_space) in forces.iter().zip(in_space) {
            assert_near(in_space.normal, force.normal.abs(), 1e-12 * 40.0);
            assert_near(in_space.friction, force.friction, 1e-12 * 40.0);
            assert_near(in_space.slip, force.slip, 1e-15);
        }
    }
}

/// Springs, forces and potentials written in coordinates act along the guide and do not press on it.
#[test]
fn what_acts_along_a_guide_in_space_does_not_press_on_it() {
    let of = |space: &str, at: &str, gravity: &str, direction: &str| {
        machine(&format!(
            "machine OnSpring in {space} {{
                parameters {{ m: kg = 1, k: N/m = 40, mu: 1 = 0.05, g: m/s^2 = 9.81 }}
                coordinates {{ x: m = 0.3 }}
                bodies {{ block {{ mass: m, at: {at} }} }}
                gravity {gravity};
                springs {{ spring {{ stiffness: k, stretch: x }} }}
                sliding {{ table {{ body: block, on: ground, direction: {direction}, friction: mu }} }}
            }}"
        ))
    };
    let (plane, space) = (
        of("plane", "(x, 0)", "(0, -g)", "(1, 0)"),
        of("space", "(0.6*x, 0.8*x, 0)", "(0, 0, -g)", "(3, 4, 0)"),
    );
    let [plane, space] = [plane, space].map(|machine| {
        let run = run(&machine, &[], &[("x", 0.3, 0.0)], (1e-11, 3.0)).expect("it runs");
        let seen = run.observe(0.2).expect("in the run");
        assert_near(seen.contacts[0].normal, 9.81, 1e-12);
        assert_near(seen.contacts[0].friction, 0.05 * 9.81, 1e-12);
        [value(&run.end().q, "x"), value(&seen.q, "x")]
    });
    for (plane, space) in plane.into_iter().zip(space) {
        assert_near(space, plane, 1e-9);
    }
}

/// Two beads on crossing perpendicular rails, joined by a rod.
const TIED: &str = "machine Tied in space {
    parameters { m1: kg = 1, m2: kg = 2, mu1: 1 = 0.3, mu2: 1 = 0.4, a: m = 0.3, l: m = 1, g: m/s^2 = 9.81 }
    coordinates { x: m, y: m }
    bodies { lower { mass: m1, at: (x, 0, 0) }, upper { mass: m2, at: (0, y, a) } }
    gravity (0, 0, -g);
    constraints { rod: norm(upper.at - lower.at) = l }
    sliding {
        first { body: lower, on: ground, direction: (1, 0, 0), friction: mu1 },
        second { body: upper, on: ground, direction: (0, 1, 0), friction: mu2 },
    }
}";

#[test]
fn two_guides_that_press_on_each_other_through_a_rod_share_it_as_typed_by_hand() {
    let machine = machine(TIED);
    let system = machine.prepare();
    let (m, mu, height, length) = ([1.0, 2.0], [0.3, 0.4], 0.3, 1.0_f64);
    let mut draws = SplitMix::new(3);
    for _ in 0..200 {
        let angle: f64 = draws.uniform(0.2, 1.3);
        let across = (length * length - height * height).sqrt();
        let (x, y) = (across * angle.cos(), across * angle.sin());
        let rate = draws.uniform(-3.0, 3.0);
        let (vx, vy) = (-y * rate, x * rate);
        // The normal force on each rail, in its two directions, for a tension T of the rod.
        let normals = |t: f64| {
            let [by_x, by_y, by_z] = [x, y, height].map(|d| t * d / length);
            [by_y.hypot(by_z - m[0] * G), by_x.hypot(by_z + m[1] * G)]
        };
        let accelerations = |t: f64| {
            let [n1, n2] = normals(t);
            let ax = (-t * x / length - mu[0] * n1 * vx.signum()) / m[0];
            let ay = (-t * y / length - mu[1] * n2 * vy.signum()) / m[1];
            [ax, ay]
        };
        // The rod keeps its length: x a_x + y a_y + v² = 0. The left side decreases with T.
        let open = |t: f64| {
            let [ax, ay] = accelerations(t);
            x * ax + y * ay + vx * vx + vy * vy
        };
        let (mut low, mut high) = (-1e3, 1e3);
        for _ in 0..200 {
            let t = 0.5 * (low + high);
            if open(t) > 0.0 { low = t } else { high = t }
        }
        let tension = 0.5 * (low + high);
        let mut a = vec![0.0; 2];
        let mut forces = [ContactForce::default(); 2];
        let state = At {
            t: 0.0,
            q: &vec![x, y],
            v: &vec![vx, vy],
            u: &system.default_inputs(),
        };
        contact_forces(&system, state, &mut a, &mut [0.0], &mut forces).expect("it moves");
        let size = 50.0 + tension.abs();
        for (found, expected) in a.iter().zip(accelerations(tension)) {
            assert_near(*found, expected, 1e-11 * size);
        }
        for (found, expected) in forces.iter().zip(normals(tension)) {
            assert_near(found.normal, expected, 1e-11 * size);
        }
    }
}

/// A shoe on a rail, and above it a load on a rod. While the shoe slides away from under the load, the rod presses it onto its
/// rail more strongly the more friction brakes it.
const PROPPED: &str = "machine Propped in space {
    parameters { m: kg = 1, M: kg = 50, mu: 1 = 0.3, l: m = 1, g: m/s^2 = 9.81 }
    coordinates { x: m, z: m }
    bodies { shoe { mass: m, at: (x, 0, 0) }, load { mass: M, at: (0, 0, z) } }
    gravity (0, 0, -g);
    constraints { rod: norm(load.at - shoe.at) = l }
    sliding { rail { body: shoe, on: ground, direction: (1, 0, 0), friction: mu } }
}";

#[test]
fn where_friction_in_space_leaves_several_motions_or_none_that_is_said() {
    // With a tension T of the rod the shoe is pressed by |m g − T z/l|, and the rod keeps its length where
    //   v² − z (g + T z/(l M)) − x (T x/l + μ |m g − T z/l|)/m = 0.
    // This decreases with T beyond T = m g l/z, and also before that if μ x z/m < x²/m + z²/M: then there is one motion.
    // Otherwise there are two if it is above 0 at T = m g l/z, and none if it is below.
    let (m, big, x) = (1.0, 50.0, 0.4_f64);
    let z = (1.0 - x * x).sqrt();
    for (mu, rate) in [(0.3, 0.1), (0.3, 9.0), (3.0, 0.1), (3.0, 9.0)] {
        let (of_x, of_z) = (rate, -x * rate / z);
        let most = of_x * of_x + of_z * of_z - z * (G + m * G / big) - x * x * G / z;
        let is_one = mu * x * z / m < x * x / m + z * z / big;
        let start = [("x", x, of_x), ("z", z, of_z)];
        let found = run(&machine(PROPPED), &[("mu", mu)], &start, (1e-9, 1e-3));
        match found {
            Ok(_) => assert!(is_one, "{mu} {rate}"),
            Err(Error::FrictionParadox { several, .. }) => {
                assert!(!is_one, "{mu} {rate}");
                assert_eq!(several, most > 0.0, "{mu} {rate}");
            }
            Err(error) => panic!("{error}"),
        }
    }
}
