//! Modes and linear models of machines with unilateral contacts, against closed forms.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{At, Evaluation, Machine, System};
use lagrangian_linear::model::{self, Request, about};
use lagrangian_linear::search::{MOST_STEPS, Wanted};
use lagrangian_linear::steady::{self, Options};

use crate::{of, slopes};

const OPTIONS: Options = Options {
    start: "--start",
    steady: "--steady",
};

/// The coordinates of an equilibrium and λ of each mode about it, or why there is none.
type Found = Result<(Vec<f64>, Vec<(f64, f64)>), String>;

/// λ of each mode about the equilibrium near the start, or why there is none.
fn modes(machine: &InterpretedMachine, steady: &[bool]) -> Found {
    let start = machine.start();
    let wanted = Wanted {
        solved: vec![false; steady.len()],
        steady: steady.to_vec(),
        rates: start.v.values.clone(),
        steps: MOST_STEPS,
    };
    let system = machine.prepare();
    if let Err(names) = steady::drives(machine, &start.q.values, &wanted) {
        return Err(format!("driven: {names:?}"));
    }
    let motion = steady::motion(machine, &start.q.values, &wanted)
        .map_err(|none| none.in_words(&system, &wanted, OPTIONS))?;
    model::check_smooth(machine, &motion).map_err(|none| none.in_words(&system, OPTIONS))?;
    let modes = motion.modes.modes.iter();
    Ok((
        motion.found.place.q(),
        modes.map(|mode| (mode.lambda.re, mode.lambda.im)).collect(),
    ))
}

fn at_rest(text: &str) -> Found {
    let machine = of("contacts", text);
    let still = vec![false; machine.start().q.values.len()];
    modes(&machine, &still)
}

/// A ball above a floor, from the height `y`.
fn ball(y: f64, floor: &str) -> String {
    format!(
        "machine Ball in plane {{
            parameters {{
                m: kg = 2, g: m/s^2 = 10, r: m = 0.1, k: N/m = 800, k2: N/m = 1600, b: N*s/m = 4,
                K: N/m^(3/2) = 1e6, c: s/m = 0.2,
            }}
            coordinates {{ y: m = {y:?} }}
            bodies {{ ball {{ mass: m, at: (0, y) }} }}
            gravity (0, -g);
            contacts {{ floor {{ gap: y - r, {floor} }} }}
        }}"
    )
}

/// Some roundings of a number, of the few operations that lead to it.
fn assert_near(found: f64, exact: f64) {
    assert!(
        (found - exact).abs() <= 64.0 * f64::EPSILON * exact.abs().max(1.0),
        "{found:?}, not {exact:?}"
    );
}

/// `m ÿ = k d + b ḋ − m g`: d = m g/k, λ² + (b/m) λ + k/m = 0. The search finds it from above, where nothing but gravity acts.
#[test]
fn a_ball_on_a_linear_floor_oscillates_as_on_a_spring() {
    for y in [5.0, 0.1001, 0.05] {
        let (q, modes) = at_rest(&ball(y, "compliance: linear(k, b)")).expect("an equilibrium");
        assert_near(q[0], 0.1 - 20.0 / 800.0);
        let [(re, im)] = modes[..] else {
            panic!("{modes:?}")
        };
        assert_near(re, -1.0);
        assert_near(im, (400.0_f64 - 1.0).sqrt());
    }
}

/// `N = K d^(3/2) (1 + c ḋ)`: d = (m g/K)^(2/3), the stiffness is 3/2 K √d, and the damping m g c.
#[test]
fn a_ball_on_a_curved_floor_has_the_stiffness_of_its_depth() {
    for (law, damping) in [("hertz(K)", 0.0), ("hunt_crossley(K, c)", 4.0)] {
        for y in [1.0, 0.09] {
            let (q, modes) = at_rest(&ball(y, &format!("compliance: {law}"))).expect("one");
            let depth = (20.0_f64 / 1e6).powf(2.0 / 3.0);
            assert_near(q[0], 0.1 - depth);
            let stiffness = 1.5e6 * depth.sqrt();
            let [(re, im)] = modes[..] else {
                panic!("{modes:?}")
            };
            let half = damping / 4.0;
            // The search leaves what is within four roundings of the coordinates; damping changes with the depth to the power 3/2, ω with its fourth root.
            let rounding = 4.0 * f64::EPSILON / depth;
            assert!((re + half).abs() <= 1.5 * rounding * half, "{re:?}");
            let exact = (stiffness / 2.0 - half * half).sqrt();
            assert!((im / exact - 1.0).abs() < rounding, "{im:?}, not {exact:?}");
        }
    }
}

/// A pendulum that hangs away from its stops has the modes of one without them.
#[test]
fn contacts_that_are_open_change_nothing() {
    let pendulum = |stops: &str| {
        format!(
            "machine Pendulum in plane {{
                parameters {{ m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81, b: N*m*s = 0.1, k: N/m = 500, c: N*s/m = 0 }}
                coordinates {{ phi: rad = 0.3 }}
                inputs {{ tau: N*m = 0 }}
                bodies {{ bob {{ mass: m, at: l*(sin(phi), -cos(phi)) }} }}
                gravity (0, -g);
                dissipations {{ hinge: b*der(phi)^2/2 }}
                forces {{ motor {{ on: phi, value: tau }} }}
                {stops}
            }}"
        )
    };
    let stops = "contacts {
        left  { gap: l/2 + l*sin(phi), restitution: 0.5 },
        right { gap: l/2 - l*sin(phi), slip: l*der(phi), compliance: linear(k, c), friction: 0.3 },
    }";
    let [with, without] = [stops, ""].map(|stops| at_rest(&pendulum(stops)).expect("it hangs"));
    assert_eq!(with, without);
    let [with, without] = [stops, ""].map(|stops| of("pendulum", &pendulum(stops)));
    let request = crate::everything(&with);
    let [with, without] = [with, without]
        .map(|machine| about(&machine, (0.0, &[0.2], &[0.4]), &request).expect("it is smooth"));
    assert_eq!((with.a, with.b, with.c), (without.a, without.b, without.c));
}

/// A box on two compliant corners bounces and rocks: ω² = 2k/m, and k w²/(2 I) − … of a box whose centre is at its base line.
#[test]
fn a_plank_on_two_corners_bounces_and_rocks() {
    let text = "machine Plank in plane {
        parameters { m: kg = 2, w: m = 0.4, I: kg*m^2 = 0.03, g: m/s^2 = 10, k: N/m = 5000, b: N*s/m = 0 }
        coordinates { y: m = 0.3, phi: rad = 0.01 }
        frames { plank = ground.shift(0, y).turn(phi) }
        bodies { plank { mass: m, inertia: I, frame: plank } }
        gravity (0, -g);
        contacts { foot { corners: ((-w, 0*w), (w, 0*w)), on: plank, along: ground, compliance: linear(k, b) } }
    }";
    let (q, modes) = at_rest(text).expect("it lies on its corners");
    assert_near(q[0], -2.0 * 10.0 / 10000.0);
    // The search ends where the next step would be shorter than 1e-10.
    assert!(q[1].abs() < 1e-12, "{q:?}");
    let exact = [
        (2.0 * 5000.0 / 2.0_f64).sqrt(),
        (2.0 * 5000.0 * 0.16 / 0.03_f64).sqrt(),
    ];
    assert_eq!(modes.len(), 2);
    for ((re, im), exact) in modes.into_iter().zip(exact) {
        assert_eq!(re, 0.0);
        assert!((im / exact - 1.0).abs() < 1e-12, "{im:?}, not {exact:?}");
    }
}

/// A wheel that turns steadily between pads that it presses: friction brakes it, and a motor holds its rate.
#[test]
fn a_contact_that_slips_steadily_has_a_model() {
    let text = "machine Brake in plane {
        parameters { m: kg = 1, J: kg*m^2 = 0.2, r: m = 0.3, k: N/m = 2000, mu: 1 = 0.4, s: N/m = 500, b: N*m*s = 0.5, c: N*s/m = 0 }
        coordinates { x: m = 0.31, phi: rad, der(phi): rad/s = 10 }
        inputs { tau: N*m = 0 }
        bodies { wheel { mass: m, inertia: J, at: (x, 0), angle: phi } }
        springs { spring { stiffness: s, stretch: x } }
        dissipations { hinge: b*der(phi)^2/2 }
        contacts { pad { gap: 1.2*r - x, slip: r*der(phi) + 0*der(x), compliance: linear(k, c), friction: mu } }
    }";
    let machine = of("brake", text);
    // At a state where it slips and is pressed in, against differences of the closed form.
    let nothing = Request {
        inputs: Vec::new(),
        outputs: Vec::new(),
    };
    let found = about(&machine, (0.0, &[0.4, 0.7], &[0.0, 10.0]), &nothing).expect("it slips");
    // m ẍ = −s x − k (x − 1.2 r), J φ̈ = −μ r k (x − 1.2 r) − b φ̇.
    let exact = [
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
        [-2500.0, 0.0, 0.0, 0.0],
        [-0.4 * 0.3 * 2000.0 / 0.2, 0.0, 0.0, -2.5],
    ];
    for (i, row) in exact.iter().enumerate() {
        for (j, exact) in row.iter().enumerate() {
            assert_near(found.a[(i, j)] / 1000.0, exact / 1000.0);
        }
    }
    // The other way around friction changes sides, and at rest it has no linearization.
    let back = about(&machine, (0.0, &[0.4, 0.7], &[0.0, -10.0]), &nothing).expect("it slips");
    assert_near(back.a[(3, 0)] / 1000.0, 1.2);
    let stuck = about(&machine, (0.0, &[0.4, 0.7], &[0.0, 0.0]), &nothing);
    let words = stuck
        .expect_err("it may stick")
        .in_words(&machine.prepare(), OPTIONS);
    assert!(
        words.contains("the contact `pad` presses and does not slip there"),
        "{words}"
    );
}

#[test]
fn what_has_no_linearization_names_the_contact() {
    let check = |result: Found, words: &str| {
        let said = result.expect_err(words);
        assert!(said.contains(words), "{said}");
    };
    check(
        at_rest(&ball(0.1, "restitution: 0.5")),
        "rigid contacts, as `floor`, count as open",
    );
    check(
        at_rest(&ball(0.3, "compliance: layer(k, k2)")),
        "the layer of the contact `floor` is pressed there",
    );
    let between = |wall: &str| {
        format!(
            "machine Between in plane {{
                parameters {{ m: kg = 2, k: N/m = 800, A: m = 0.01, w: rad/s = 3, c: N*s/m = 0, K: N/m^(3/2) = 1e5 }}
                coordinates {{ x: m = 0.3, y: m }}
                bodies {{ block {{ mass: m, at: (x, y) }} }}
                springs {{ spring {{ stiffness: k, stretch: x }}, other {{ stiffness: k, stretch: y }} }}
                contacts {{ wall {{ {wall} }} }}
            }}"
        )
    };
    for (wall, words) in [
        (
            "gap: x, restitution: 0.5",
            "the rigid contact `wall` is closed there",
        ),
        (
            "gap: x - A, restitution: 0.5",
            "the rigid contact `wall`, which counts as open, would be penetrated by 1.000e-2 m there",
        ),
        (
            "gap: x, compliance: linear(k, c)",
            "the contact `wall` is about to close or to open there",
        ),
        (
            "gap: x, compliance: hertz(K)",
            "the contact `wall` is about to close or to open there",
        ),
        (
            "gap: x - A, slip: der(y), compliance: linear(k, c), friction: 0.1",
            "the contact `wall` presses and does not slip there",
        ),
        (
            "gap: x + A*cos(w*t) + 2*A, restitution: 0.5",
            "driven: [\"A\", \"w\"]",
        ),
    ] {
        check(at_rest(&between(wall)), words);
    }
}

/// Along a steady motion the gap of an open contact must not change.
#[test]
fn a_gap_that_changes_along_a_steady_motion_is_named() {
    let rotor = |gap: &str| {
        let text = format!(
            "machine Rotor in plane {{
                parameters {{ m: kg = 2, J: kg*m^2 = 0.1, k: N/m = 800, A: m = 0.01 }}
                coordinates {{ x: m, phi: rad, der(phi): rad/s = 5 }}
                bodies {{ rotor {{ mass: m, inertia: J, at: (x, 0), angle: phi }} }}
                springs {{ spring {{ stiffness: k, stretch: x }} }}
                contacts {{ wall {{ gap: {gap}, restitution: 0.5 }} }}
            }}"
        );
        modes(&of("rotor", &text), &[false, true])
    };
    assert!(rotor("x + A").is_ok());
    let said = rotor("x + A*(2 + cos(phi))").expect_err("it may close");
    assert!(
        said.contains("the gap of the contact `wall` changes along the steady motion"),
        "{said}"
    );
}

/// The derivatives of accelerations are those with all contacts open, with `derivatives` in the spec and without.
#[test]
fn derivatives_of_accelerations_are_those_of_open_contacts() {
    let text = |further: &str| {
        format!(
            "machine Cart in plane {{
                parameters {{ m: kg = 1, M: kg = 2, l: m = 0.5, k: N/m = 40, g: m/s^2 = 9.81, e: 1 = 0.6 }}
                coordinates {{ x: m = 0.2, phi: rad = 1.2 }}
                bodies {{ cart {{ mass: M, at: (x, 0) }}, bob {{ mass: m, at: (x + l*sin(phi), -l*cos(phi)) }} }}
                gravity (0, -g);
                springs {{ s {{ stiffness: k, stretch: x }} }}
                {further}
            }}"
        )
    };
    let contacts = "contacts { stop { gap: x + l, restitution: e } }";
    let derivatives = "derivatives { coordinates, rates, m } stages { time, coordinates }";
    let at = |further: &str| slopes(&of("cart", &text(further)), &[0.3, 0.9], &[0.2, -1.0]);
    let free = at("");
    for further in [contacts, &format!("{contacts} {derivatives}")] {
        crate::assert_close(&at(further), &free, further);
    }
}

/// Accelerations with the forces of contacts as `evaluate` computes them, by the complementarity problem.
fn accelerations(machine: &InterpretedMachine, q: &[f64], v: &[f64]) -> Vec<f64> {
    let system = machine.prepare();
    let (q, v, u) = (q.to_vec(), v.to_vec(), system.default_inputs());
    let at = At {
        t: 0.0,
        q: &q,
        v: &v,
        u: &u,
    };
    Evaluation::of(&system, at).expect("a state").accelerations
}

/// The model at random states against differences of the accelerations that another code computes: a ball that slips in two directions on a
/// floor that yields, and a disc that slips and resists rolling in a groove.
#[test]
fn models_with_pressed_contacts_are_those_of_the_forces_of_a_run() {
    let ball = "machine Ball in space {
        parameters { m: kg = 0.2, r: m = 0.1, mu: 1 = 0.3, K: N/m^(3/2) = 4e4, c: s/m = 0.3, g: m/s^2 = 9.81 }
        coordinates { x: m, y: m, z: m = r, a: rad, b: rad, c1: rad }
        frames { ball = ground.shift(x, y, z).turn(x, a).turn(y, b).turn(z, c1) }
        bodies { ball { mass: m, inertia: (2/5*m*r^2, 2/5*m*r^2, 2/5*m*r^2), frame: ball } }
        spheres { surface { on: ball, center: (0, 0, 0), radius: r } }
        gravity (0, 0, -g);
        contacts { cloth { sphere: surface, along: ground, compliance: hunt_crossley(K, c), friction: mu } }
    }";
    let disc = "machine Disc in plane {
        parameters {
            m: kg = 2, r: m = 0.1, R: m = 0.5, rho: m = 0.004, mu: 1 = 0.5, k: N/m = 3000, b: N*s/m = 5, g: m/s^2 = 9.81, l: m = 0.2,
        }
        coordinates { x: m, y: m, theta: rad, psi: rad }
        bodies {
            disc { mass: m, inertia: m*r^2/2, at: (x, y), angle: theta },
            bob { mass: m/2, at: (x + l*sin(psi), y - l*cos(psi)) },
        }
        circles { rim { on: disc, center: (0, 0), radius: r }, bowl { on: ground, center: (0, 0), radius: R } }
        gravity (0, -g);
        contacts {
            groove { circle: rim, inside: bowl, compliance: linear(k, b), friction: mu, rolling_resistance: rho },
            lid { gap: 2*R - y, restitution: 0.5 },
        }
    }";
    let mut next = crate::random();
    for (name, text) in [("ball", ball), ("disc", disc)] {
        let machine = of(name, text);
        let n = machine.start().q.values.len();
        for _ in 0..4 {
            let mut q: Vec<f64> = (0..n).map(|_| 0.3 * next()).collect();
            let mut v: Vec<f64> = (0..n).map(|_| next()).collect();
            match name {
                // Pressed by some millimetres, and slipping by its spin.
                "ball" => {
                    q[2] = 0.096 + 0.001 * next();
                    v[3] = 30.0 + 5.0 * next();
                }
                _ => {
                    let (angle, distance) = (0.8 * next(), 0.405 + 0.001 * next());
                    (q[0], q[1]) = (distance * angle.sin(), -distance * angle.cos());
                    v[2] = 30.0 + 5.0 * next();
                }
            }
            let nothing = Request {
                inputs: Vec::new(),
                outputs: Vec::new(),
            };
            let model = about(&machine, (0.0, &q, &v), &nothing).expect("it slips");
            let here = accelerations(&machine, &q, &v);
            let size = here.iter().fold(1.0_f64, |size, a| size.max(a.abs()));
            for (i, a) in here.iter().enumerate() {
                let error = (model.drift[n + i] - a).abs();
                assert!(
                    error <= 1e4 * f64::EPSILON * size,
                    "{name}: {a} is off by {error:e}"
                );
            }
            let largest = model.a.amax();
            for j in 0..2 * n {
                // The error of a central difference is h²/6 f''' and ε f/h: some 1e-10 of derivatives that change within the depth, 4 mm.
                let h = 1e-6;
                let moved = |by: f64| {
                    let (mut q, mut v) = (q.clone(), v.clone());
                    if j < n {
                        q[j] += by;
                    } else {
                        v[j - n] += by;
                    }
                    accelerations(&machine, &q, &v)
                };
                let (above, below) = (moved(h), moved(-h));
                for i in 0..n {
                    let slope = (above[i] - below[i]) / (2.0 * h);
                    let error = (model.a[(n + i, j)] - slope).abs();
                    assert!(
                        error <= 1e-6 * largest,
                        "{name}: {i} by {j}: {slope} is off by {error:e}"
                    );
                }
            }
        }
    }
}
