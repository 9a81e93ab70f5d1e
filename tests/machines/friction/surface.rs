//! Friction on surfaces in space that hold a body from both sides, tested against closed forms, equations typed by hand, the same
//! machine in other coordinates, and the same motion with a contact that may open.

use super::{assert_near, events, run, value};
use crate::support::library::{interpreted, machine};
use crate::support::random::SplitMix;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{At, ContactForce, Machine, System, contact_forces};

const G: f64 = 9.81;

#[test]
fn a_puck_that_starts_along_a_level_line_comes_to_half_its_speed_down_the_slope() {
    let alpha = 0.4_f64;
    let set = [("alpha", alpha), ("mu", alpha.tan()), ("mu0", alpha.tan())];
    // v + v cos φ stays equal to v₀, and φ decreases: dφ/dt = −g sin α sin φ/v.
    let start = [("x", 0.0, 0.0), ("y", 0.0, 3.0)];
    let machine = interpreted("puck_in_slot");
    let run = run(&machine, &set, &start, (1e-12, 20.0)).expect("it runs");
    for t in [0.1, 0.5, 1.0, 2.0, 5.0, 20.0] {
        let state = run.observe(t).expect("in the run");
        let (x, y) = (value(&state.v, "x"), value(&state.v, "y"));
        let speed = x.hypot(y);
        // 1e-12 in each of a few tens of steps.
        assert_near(speed + x, 3.0, 1e-10);
    }
    let end = run.end();
    assert_near(value(&end.v, "x"), 1.5, 1e-9);
    assert_near(value(&end.v, "y"), 0.0, 1e-9);
    assert!(run.events().is_empty(), "{:?}", run.events());
    let balance = run.energy_balance().expect("kept");
    assert!(balance.relative().abs() < 1e-10, "{balance:?}");
}

#[test]
fn a_puck_comes_to_rest_when_the_closed_form_says_and_stays_to_the_last_bit() {
    let (alpha, mu, speed) = (0.4_f64, 0.6, 3.0);
    let kappa = mu / alpha.tan();
    for phi in [2.0, 0.5, -1.0, 3.1, 0.0, std::f64::consts::PI] {
        let set = [("alpha", alpha), ("mu", mu), ("mu0", mu)];
        let start = [
            ("x", 0.0, speed * f64::cos(phi)),
            ("y", 0.0, speed * f64::sin(phi)),
        ];
        let machine = interpreted("puck_in_slot");
        let run = run(&machine, &set, &start, (1e-11, 100.0)).expect("it runs");
        // v (cos φ + κ) decreases at the rate g sin α (κ² − 1).
        let stop = speed * (phi.cos() + kappa) / (G * alpha.sin() * (kappa * kappa - 1.0));
        let [(name, t)] = &events(&run)[..] else {
            panic!("{phi}: {:?}", run.events());
        };
        assert_eq!(name, "slot sticks");
        assert_near(*t, stop, 1e-8 * stop);
        let at = &run.events()[0].state;
        for name in ["x", "y"] {
            assert_eq!(value(&run.end().q, name), value(&at.q, name));
            assert_eq!(value(&run.end().v, name), 0.0);
        }
        let balance = run.energy_balance().expect("kept");
        assert!(balance.relative().abs() < 1e-9, "{balance:?}");
        // At rest friction holds it against the slope, and no force acts across.
        let observed = run.observe(50.0).expect("in the run");
        let [along, across] = observed.contacts[..] else {
            panic!("two tangents");
        };
        assert!(along.sticks && across.sticks);
        let weight = 0.16 * G;
        assert_near(
            along.friction.hypot(across.friction),
            weight * alpha.sin(),
            1e-13,
        );
        assert_near(along.normal, weight * alpha.cos(), 1e-13);
        assert_eq!(along.normal, across.normal);
    }
}

#[test]
fn a_puck_that_is_held_from_both_sides_goes_as_one_that_lies_on_the_slope() {
    let (slot, slope) = (
        interpreted("puck_in_slot"),
        interpreted("contacts/puck_on_slope"),
    );
    let held = run(&slot, &[], &[], (1e-12, 2.0)).expect("it runs");
    let lies = run(&slope, &[], &[], (1e-12, 2.0)).expect("it runs");
    for t in [0.2, 0.7, 1.3, 2.0] {
        let [held, lies] = [held.observe(t), lies.observe(t)].map(|seen| seen.expect("in the run"));
        for name in ["x", "y"] {
            assert_near(value(&held.q, name), value(&lies.q, name), 1e-9);
            assert_near(value(&held.v, name), value(&lies.v, name), 1e-8);
        }
    }
}

/// Springs written in coordinates act along the surface and do not press
/// on it: a puck on springs moves like one on a table that it may leave.
#[test]
fn springs_along_a_surface_do_not_press_on_it() {
    let common = "parameters { m: kg = 1, k: N/m = 40, mu: 1 = 0.05, g: m/s^2 = 9.81 }
        gravity (0, 0, -g);
        springs { along { stiffness: k, stretch: x }, across { stiffness: k, stretch: y } }";
    let held = machine(&format!(
        "machine Held in space {{ {common}
            coordinates {{ x: m, y: m }}
            bodies {{ puck {{ mass: m, at: (x, y, 0) }} }}
            sliding {{ slot {{ body: puck, on: ground, normal: (0, 0, 2), friction: mu }} }}
        }}"
    ));
    let lies = machine(&format!(
        "machine Lies in space {{ {common}
            coordinates {{ x: m, y: m, z: m }}
            frames {{ puck = ground.shift(x, y, z) }}
            bodies {{ puck {{ mass: m, frame: puck }} }}
            contacts {{ table {{ point: (0, 0, 0), on: puck, along: ground, restitution: 0, friction: mu }} }}
        }}"
    ));
    let start = [("x", 0.3, 0.0), ("y", 0.0, 1.0)];
    let [held, lies] = [held, lies].map(|machine| {
        let run = run(&machine, &[], &start, (1e-12, 3.0)).expect("it runs");
        let seen = run.observe(1.0).expect("in the run");
        ["x", "y"].map(|name| [value(&run.end().q, name), value(&seen.q, name)])
    });
    for (held, lies) in held.as_flattened().iter().zip(lies.as_flattened()) {
        assert_near(*held, *lies, 1e-8);
    }
}

/// The accelerations and contact forces at a state, for a machine with one surface.
fn at(
    machine: &InterpretedMachine,
    q: &[f64],
    v: &[f64],
) -> Result<(Vec<f64>, [ContactForce; 2]), ()> {
    let system = machine.prepare();
    let mut a = vec![0.0; q.len()];
    let mut multipliers = vec![0.0; system.constraints().len()];
    let mut forces = [ContactForce::default(); 2];
    let state = At {
        t: 0.0,
        q: &q.to_vec(),
        v: &v.to_vec(),
        u: &system.default_inputs(),
    };
    contact_forces(&system, state, &mut a, &mut multipliers, &mut forces).map_err(|_| ())?;
    Ok((a, forces))
}

#[test]
fn a_bead_in_a_shell_obeys_the_equations_typed_by_hand() {
    let machine = interpreted("bead_in_shell");
    let (m, r, mu, mu0) = (0.05, 0.4, 0.2, 0.3);
    let mut draws = SplitMix::new(11);
    let (mut rests, mut slides) = (0, 0);
    for round in 0..400 {
        let (theta, phi) = (draws.uniform(0.05, 3.0), draws.uniform(-3.0, 3.0));
        let (sin, cos) = f64::sin_cos(theta);
        let [of_theta, of_phi] = match round % 4 {
            0 => [0.0; 2],
            _ => [draws.uniform(-9.0, 9.0), draws.uniform(-9.0, 9.0)],
        };
        // Along the meridian, upwards from the lowest point, and along the parallel.
        let slip = [r * of_theta, r * sin * of_phi];
        let speed = slip[0].hypot(slip[1]);
        let normal = (m * (speed * speed / r + G * cos)).abs();
        let weight = -m * G * sin;
        let (a, [first, second]) =
            at(&machine, &[theta, phi], &[of_theta, of_phi]).expect("it moves");
        let size = m * (G + speed * speed / r);
        assert_near(first.normal, normal, 1e-12 * size);
        assert_near(first.slip.hypot(second.slip), speed, 1e-13 * (1.0 + speed));
        let friction = if speed != 0.0 {
            slip.map(|w| -mu * normal * w / speed)
        } else if weight.abs() <= mu0 * normal {
            rests += 1;
            assert!(first.sticks && second.sticks, "{theta}");
            [-weight, 0.0]
        } else {
            [mu * normal * -weight.signum(), 0.0]
        };
        slides += usize::from(!first.sticks);
        assert_near(
            first.friction.hypot(second.friction),
            friction[0].hypot(friction[1]),
            1e-12 * size,
        );
        let rate = (m * r * sin * cos * of_phi * of_phi + weight + friction[0]) / (m * r);
        let around = (friction[1] / (m * r) - 2.0 * cos * of_theta * of_phi) / sin;
        let scale = (size / (m * r) + 400.0) / sin;
        assert_near(a[0], rate, 1e-11 * scale);
        assert_near(a[1], around, 1e-11 * scale);
    }
    assert!(rests > 5 && slides > 250, "{rests} {slides}");
}

/// The bead of the shell described by two of its Cartesian coordinates, below the centre.
const IN_PLACES: &str = "machine InPlaces in space {
    parameters { m: kg = 0.05, R: m = 0.4, mu: 1 = 0.2, mu0: 1 = 0.3, g: m/s^2 = 9.81 }
    coordinates { x: m, y: m }
    assume { R^2 - x^2 - y^2 > 0 }
    bodies { bead { mass: m, at: (x, y, -sqrt(R^2 - x^2 - y^2)) } }
    gravity (0, 0, -g);
    sliding { shells { body: bead, on: ground, normal: (x, y, -sqrt(R^2 - x^2 - y^2)), friction: mu, static_friction: mu0 } }
}";

/// The same bead pressed outwards on a single sphere, with three Cartesian coordinates, so that it may fall inwards.
const MAY_OPEN: &str = "machine MayOpen in space {
    parameters { m: kg = 0.05, R: m = 0.4, mu: 1 = 0.2, mu0: 1 = 0.3, g: m/s^2 = 9.81 }
    coordinates { x: m, y: m, z: m }
    frames { bead = ground.shift(x, y, z) }
    bodies { bead { mass: m, frame: bead } }
    spheres { shell { on: ground, center: (0, 0, 0), radius: R } }
    gravity (0, 0, -g);
    contacts { shells { point: (0, 0, 0), on: bead, inside: shell, restitution: 0, friction: mu, static_friction: mu0 } }
}";

#[test]
fn a_spherical_pendulum_with_dry_friction_is_one_machine_in_angles_in_places_and_as_a_contact() {
    let (r, sin, cos) = (0.4, 1.0_f64.sin(), 1.0_f64.cos());
    let speed = 2.5;
    let in_angles = run(
        &interpreted("bead_in_shell"),
        &[],
        &[("theta", 1.0, 0.0), ("phi", 0.0, speed / (r * sin))],
        (1e-12, 3.0),
    )
    .expect("it runs");
    let in_places = run(
        &machine(IN_PLACES),
        &[],
        &[("x", r * sin, 0.0), ("y", 0.0, speed)],
        (1e-12, 3.0),
    )
    .expect("it runs");
    let start = [("x", r * sin, 0.0), ("y", 0.0, speed), ("z", -r * cos, 0.0)];
    let may_open = run(&machine(MAY_OPEN), &[], &start, (1e-12, 3.0)).expect("it runs");
    for t in [0.1, 0.3, 0.6, 1.0, 3.0] {
        let angles = in_angles.observe(t).expect("in the run");
        let (theta, phi) = (value(&angles.q, "theta"), value(&angles.q, "phi"));
        let expected = [r * theta.sin() * phi.cos(), r * theta.sin() * phi.sin()];
        for other in [&in_places, &may_open] {
            let other = other.observe(t).expect("in the run");
            // 1e-12 in each of a few hundred steps, amplified near the stop, where a small slip velocity turns fast.
            assert_near(value(&other.q, "x"), expected[0], 1e-8);
            assert_near(value(&other.q, "y"), expected[1], 1e-8);
        }
    }
    for run in [&in_angles, &in_places] {
        let names: Vec<String> = events(run).into_iter().map(|(name, _)| name).collect();
        assert_eq!(
            names.last().map(String::as_str),
            Some("shells sticks"),
            "{names:?}"
        );
        let balance = run.energy_balance().expect("kept");
        assert!(balance.relative().abs() < 1e-9, "{balance:?}");
    }
    assert_near(events(&in_angles)[0].1, events(&in_places)[0].1, 1e-7);
}

/// A block on a table, tied along y by a rope over a pulley to a load, so that its inertia is greater along y than
/// along x. A force pulls along x.
const UNLIKE: &str = "machine Unlike in space {
    parameters { m: kg = 1, M: kg = 0.6, mu: 1 = 0.3, mu0: 1 = 0.35, l: m = 2, p: N = 2, g: m/s^2 = 9.81 }
    coordinates { x: m, y: m, s: m = 2 }
    bodies { block { mass: m, at: (x, y, 0) }, load { mass: M, at: (0, 3, -s) } }
    gravity (0, 0, -g);
    forces { pull { at: block.at, force: (p, 0, 0) } }
    constraints { rope: s - y = l }
    sliding { table { body: block, on: ground, normal: (0, 0, 1), friction: mu, static_friction: mu0 } }
}";

#[test]
fn what_is_heavier_in_one_direction_slides_off_where_friction_lets_it() {
    let machine = machine(UNLIKE);
    let mut draws = SplitMix::new(6);
    let (mut rests, mut slides) = (0, 0);
    for _ in 0..200 {
        let (p, mass) = (draws.uniform(-6.0, 6.0), draws.uniform(0.05, 1.5));
        let mut machine = machine.clone();
        machine.set("p", p).expect("a parameter");
        machine.set("M", mass).expect("a parameter");
        let (a, [first, second]) = at(&machine, &[0.0, 0.0, 2.0], &[0.0; 3]).expect("it moves");
        let pull = [p, mass * G];
        let normal = G;
        assert_near(first.normal, normal, 1e-13);
        let friction = [first.friction, second.friction];
        if pull[0].hypot(pull[1]) <= 0.35 * normal {
            rests += 1;
            assert!(first.sticks);
            assert_near(friction[0], -pull[0], 1e-12);
            assert_near(friction[1], -pull[1], 1e-12);
            continue;
        }
        slides += 1;
        assert!(!first.sticks && !second.sticks);
        // Newton's law along x, and along y for both bodies; friction is μ N opposite to the direction in which the block starts.
        assert_near(a[0], pull[0] + friction[0], 1e-12 * (1.0 + p.abs()));
        assert_near(
            (1.0 + mass) * a[1],
            pull[1] + friction[1],
            1e-11 * (1.0 + mass),
        );
        assert_near(friction[0].hypot(friction[1]), 0.3 * normal, 1e-12);
        let sets_off = a[0].hypot(a[1]);
        assert_near(friction[0], -0.3 * normal * a[0] / sets_off, 1e-10);
        assert_near(friction[1], -0.3 * normal * a[1] / sets_off, 1e-10);
    }
    assert!(rests > 10 && slides > 100, "{rests} {slides}");
}

#[test]
fn a_block_that_is_torn_loose_slides_as_the_formula_says() {
    // The pull grows with time. When it reaches μ₀ N the block slides in its direction, accelerated by the pull minus friction.
    let machine = machine(
        "machine Torn in space {
            parameters { m: kg = 1, mu: 1 = 0.3, mu0: 1 = 0.4, c: N/s = 2, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m }
            bodies { block { mass: m, at: (x, y, 0) } }
            gravity (0, 0, -g);
            forces { pull { at: block.at, force: (0.6*c*t, 0.8*c*t, 0) } }
            sliding { table { body: block, on: ground, normal: (0, 0, 1), friction: mu, static_friction: mu0 } }
        }",
    );
    let run = run(&machine, &[], &[], (1e-11, 4.0)).expect("it runs");
    let away = 0.4 * G / 2.0;
    let [(name, t)] = &events(&run)[..] else {
        panic!("{:?}", run.events());
    };
    assert_eq!(name, "table slides");
    assert_near(*t, away, 1e-10);
    // With the time τ since then: w' = 2 (away + τ) − μ g.
    let tau = 4.0 - away;
    let speed = 2.0 * away * tau + tau * tau - 0.3 * G * tau;
    assert_near(value(&run.end().v, "x"), 0.6 * speed, 1e-10);
    assert_near(value(&run.end().v, "y"), 0.8 * speed, 1e-10);
}

#[test]
fn two_pucks_that_slide_off_at_once_do_so_each_by_itself() {
    let machine = machine(
        "machine Two in space {
            parameters { m: kg = 1, mu: 1 = 0.2, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m, u: m, w: m }
            bodies { one { mass: m, at: (x, y, 0) }, other { mass: 2*m, at: (u, w, 1) } }
            gravity (0, 0, -g);
            forces { pull { at: one.at, force: (3, 4, 0) }, push { at: other.at, force: (-12, 5, 0) } }
            sliding {
                low { body: one, on: ground, normal: (0, 0, 1), friction: mu },
                high { body: other, on: ground, normal: (0, 0, 1), friction: mu },
            }
        }",
    );
    let run = run(&machine, &[], &[], (1e-11, 1.0)).expect("it runs");
    let [one, other] = [5.0 - 0.2 * G, 13.0 / 2.0 - 0.2 * G];
    for (name, expected) in [
        ("x", 0.6 * one),
        ("y", 0.8 * one),
        ("u", -12.0 / 13.0 * other),
        ("w", 5.0 / 13.0 * other),
    ] {
        assert_near(value(&run.end().v, name), expected, 1e-10);
    }
}

#[test]
fn a_bead_that_goes_over_the_top_presses_outwards_and_is_braked_all_the_same() {
    // Along a meridian it is a bead on a hoop: d(w²)/dθ = −2 g r sin θ − 2 μ |w² + g r cos θ|, which has a closed form while the sign
    // of the absolute value stays.
    let (r, mu) = (0.4, 0.2);
    let machine = interpreted("bead_in_shell");
    // Where the bead is 0.3125 R above the centre the tangents jump; runs must pass that point with any steps.
    for fast in [
        20.0, 20.5, 21.0, 21.25, 21.5, 22.0, 22.5, 22.75, 23.0, 25.0, 27.0,
    ] {
        let start = [("theta", 0.3, fast), ("phi", 0.0, 0.0)];
        let run = run(&machine, &[], &start, (1e-12, 0.25)).expect("it runs");
        let end = run.end();
        let (theta, rate) = (value(&end.q, "theta"), value(&end.v, "theta"));
        assert!(theta > 3.2, "{theta}");
        // w² = C e^(−2μθ) + g r (A cos θ + B sin θ), where A and B follow from the equation.
        let a = 2.0 * (1.0 - 2.0 * mu * mu) / (1.0 + 4.0 * mu * mu);
        let b = -6.0 * mu / (1.0 + 4.0 * mu * mu);
        let part = |theta: f64| G * r * (a * theta.cos() + b * theta.sin());
        let c = ((r * fast) * (r * fast) - part(0.3)) * (2.0 * mu * 0.3).exp();
        let square = c * (-2.0 * mu * theta).exp() + part(theta);
        assert_near((r * rate) * (r * rate), square, 1e-9 * square);
        assert_eq!(value(&end.q, "phi"), 0.0);
    }
}
