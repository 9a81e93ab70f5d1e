//! Coulomb friction: bodies that stick stay in place, sliding bodies lose the right energy, and where
//! the law does not determine the motion the run reports that.

mod many;
mod shared;
mod shared_in_space;
mod space;
mod spelling;
mod surface;

use std::f64::consts::PI;

use crate::support::library::{interpreted, machine};
use crate::support::random::SplitMix;
use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{At, Crossing, Error, Machine, Simulation, Solution, State, System};

/// Runs a machine with the given parameters, coordinates and rates.
fn run(
    machine: &InterpretedMachine,
    set: &[(&str, f64)],
    start: &[(&str, f64, f64)],
    (tolerance, until): (f64, f64),
) -> Result<Solution<InterpretedMachine>, Error> {
    let mut machine = machine.clone();
    for (name, value) in set {
        machine.set(name, *value).expect("a parameter");
    }
    let mut state: State<Named> = machine.start();
    for (name, q, v) in start {
        state.q.set(name, *q).expect("a coordinate");
        state.v.set(name, *v).expect("a coordinate");
    }
    Simulation::new(&machine)
        .tolerance(tolerance)
        .energy_balance(true)
        .until(until)
        .run(state)
}

fn value(numbers: &Named, name: &str) -> f64 {
    numbers.get(name).expect("a name of the machine")
}

#[track_caller]
fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} for {expected}, to {tolerance:e}"
    );
}

/// The events of a run: names and times.
fn events(run: &Solution<InterpretedMachine>) -> Vec<(String, f64)> {
    let events = run.events().iter();
    events.map(|e| (e.name.clone(), e.state.t)).collect()
}

#[test]
fn a_block_that_sticks_does_not_creep() {
    let run = run(&interpreted("block_on_incline"), &[], &[], (1e-9, 1000.0)).expect("it runs");
    assert_eq!(value(&run.end().q, "s"), 0.0);
    assert_eq!(value(&run.end().v, "s"), 0.0);
    assert!(run.events().is_empty());
    let [face] = run.observe(500.0).expect("in the run").contacts[..] else {
        panic!("one contact");
    };
    assert!(face.sticks);
    let (m, g, alpha) = (2.0, 9.81, 0.3_f64);
    assert_near(face.normal, m * g * alpha.cos(), 1e-13);
    assert_near(face.friction, -m * g * alpha.sin(), 1e-13);
}

#[test]
fn a_block_that_is_pushed_comes_to_rest_and_stays_there() {
    let (g, alpha, mu) = (9.81, 0.3_f64, 0.4);
    let run = run(
        &interpreted("block_on_incline"),
        &[],
        &[("s", 0.0, 1.5)],
        (1e-10, 1000.0),
    )
    .expect("it runs");
    let braking = g * (mu * alpha.cos() - alpha.sin());
    let (stop, way) = (1.5 / braking, 1.5 * 1.5 / (2.0 * braking));
    let [(name, t)] = &events(&run)[..] else {
        panic!("{:?}", run.events());
    };
    assert_eq!(name, "face sticks");
    assert_eq!(run.events()[0].crossing, Crossing::Falling);
    assert_near(*t, stop, 1e-12 * stop);
    let rest = value(&run.events()[0].state.q, "s");
    assert_near(rest, way, 1e-12 * way);
    // The block stays in place to the last bit.
    assert_eq!(value(&run.end().q, "s"), rest);
    // All its energy was dissipated.
    let balance = run.energy_balance().expect("kept");
    assert!(balance.relative().abs() < 1e-12, "{balance:?}");
    let fallen = 0.5 * 2.0 * 1.5 * 1.5 + 2.0 * g * alpha.sin() * way;
    assert_near(balance.dissipated, fallen, 1e-12 * fallen);
}

#[test]
fn a_block_slides_where_the_incline_is_too_steep() {
    let (g, alpha, mu) = (9.81, 0.6_f64, 0.4);
    let set = [("alpha", alpha)];
    let run = run(&interpreted("block_on_incline"), &set, &[], (1e-10, 2.0)).expect("it runs");
    let way = 0.5 * g * (alpha.sin() - mu * alpha.cos()) * 4.0;
    assert_near(value(&run.end().q, "s"), way, 1e-12 * way);
}

#[test]
fn a_block_breaks_away_when_the_incline_is_raised_to_its_angle_of_friction() {
    let set = [("rate", 0.01)];
    let run = run(&interpreted("block_on_incline"), &set, &[], (1e-10, 20.0)).expect("it runs");
    // The block is at the axis, so raising the incline does not move it.
    let away = (0.5_f64.atan() - 0.3) / 0.01;
    let [(name, t)] = &events(&run)[..] else {
        panic!("{:?}", run.events());
    };
    assert_eq!(name, "face slides");
    assert_near(*t, away, 1e-10 * away);
    assert_eq!(value(&run.events()[0].state.q, "s"), 0.0);
    assert!(value(&run.end().q, "s") > 1.0);
}

#[test]
fn a_block_on_a_belt_sticks_and_slips_with_the_period_of_the_closed_form() {
    let machine = interpreted("stick_slip");
    let run = run(&machine, &[], &[("x", 0.0, 0.2)], (1e-11, 40.0)).expect("it runs");
    // m = k = 1, v_b = 0.2, F_s = 1, F_k = 0.5.
    let (v_b, jump) = (0.2_f64, 0.5);
    let slip = 2.0 * (PI - (jump / v_b).atan());
    let period = 2.0 * jump / v_b + slip;
    let known = events(&run);
    assert!(known.len() > 7, "{known:?}");
    for (k, (name, t)) in known.iter().enumerate() {
        // It breaks loose at x = 1, where the spring pulls with F_s; it starts at x = 0 at t = 0.
        let cycle = period * (k / 2) as f64;
        let (expected, after) = match k % 2 {
            0 => ("belt slides", 1.0 / v_b),
            _ => ("belt sticks", 1.0 / v_b + slip),
        };
        assert_eq!(name, expected);
        assert_near(*t, after + cycle, 1e-9);
    }
    // While it slips it oscillates about F_k/k with the amplitude set when it broke loose.
    let amplitude = (jump * jump + v_b * v_b).sqrt();
    let states = run.every(0.001).expect("in the run");
    let x = states
        .iter()
        .filter(|s| s.t > period)
        .map(|s| value(&s.q, "x"));
    let (least, most) = x.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| {
        (a.min(x), b.max(x))
    });
    // Between two samples the maximum exceeds the samples by at most x'' dt²/8.
    assert_near(most, 0.5 + amplitude, 1e-6);
    assert_near(least, 0.5 - amplitude, 1e-6);
    // The belt does work, and friction dissipates part of it.
    let balance = run.energy_balance().expect("kept");
    assert!(balance.work > 1.0 && balance.dissipated > 1.0);
    assert!(balance.relative().abs() < 1e-9, "{balance:?}");
}

#[test]
fn an_oscillator_with_friction_stops_in_finite_time() {
    // m = 1, k = 4, F = 0.3, x₀ = 1: each half cycle reduces the amplitude by 2 F/k.
    let set = [("k", 4.0), ("mu", 0.3), ("mu0", 0.3), ("v_b", 0.0)];
    let start = [("x", 1.0, 0.0)];
    let run = run(&interpreted("stick_slip"), &set, &start, (1e-11, 20.0)).expect("it runs");
    let known = events(&run);
    let (name, t) = known.last().expect("it stops");
    assert_eq!(name, "belt sticks");
    assert_near(*t, 7.0 * PI / 2.0, 1e-9);
    assert_near(value(&run.end().q, "x").abs(), 0.05, 1e-9);
    assert_eq!(value(&run.end().v, "x"), 0.0);
    assert_eq!(run.end().q, run.events().last().expect("it stops").state.q);
}

#[test]
fn prisms_move_as_their_equations_typed_by_hand() {
    let machine = interpreted("prisms");
    let (m, big, mu1, mu2, g) = (32.0 / 13.0, 20.0 / 13.0, 0.1, 0.02, 9.81);
    let tan = 1.0;
    // Equations (56) and (57) of the paper, derived for the case that both bodies slide forward
    // and press:
    // (m+M) q1'' − m q2'' = −μ2 [(m+M) g − m q2'' tan α]
    // −m q1'' + m (1 + tan²α) q2'' = m g tan α − μ1 m (g − q1'' tan α)
    let (a11, a12) = (m + big, -m - mu2 * m * tan);
    let (a21, a22) = (-m - mu1 * m * tan, m * (1.0 + tan * tan));
    let (b1, b2) = (-mu2 * (m + big) * g, m * g * tan - mu1 * m * g);
    let determinant = a11 * a22 - a12 * a21;
    let expected = [
        (b1 * a22 - a12 * b2) / determinant,
        (a11 * b2 - a21 * b1) / determinant,
    ];
    let system = machine.prepare();
    let (q, v) = (vec![0.3, 0.7], vec![1.0, 2.0]);
    let mut a = vec![0.0; 2];
    let u = system.default_inputs();
    system
        .accelerations(0.0, &q, &v, &u, &mut a)
        .expect("it moves");
    for (found, expected) in a.iter().zip(expected) {
        assert_near(*found, expected, 1e-14 * expected.abs());
    }
    // From rest, the floor sticks if the push of the slider is less than its friction.
    let run = run(&machine, &[("mu2", 0.9)], &[], (1e-10, 1.0)).expect("it runs");
    assert_eq!(value(&run.end().q, "q1"), 0.0);
    let slide = g * (1.0 - 0.1) / 2.0;
    assert_near(value(&run.end().q, "q2"), 0.5 * slide, 1e-12 * slide);
    let [floor, incline] = run.observe(0.5).expect("in the run").contacts[..] else {
        panic!("two contacts");
    };
    assert!(floor.sticks && !incline.sticks);
    let cos = (PI / 4.0).cos();
    assert_near(incline.normal, m * g * cos, 1e-12);
    let (push, load) = (
        m * g * cos * (cos - 0.1 * cos),
        m * g * cos * (cos + 0.1 * cos),
    );
    assert_near(floor.friction.abs(), push, 1e-12);
    assert_near(floor.normal, big * g + load, 1e-12);
}

#[test]
fn a_wedge_and_its_block_move_in_absolute_coordinates_too() {
    // The same bodies, with the wedge described as in `prisms`: q2 = s cos α, q1 = x.
    let (alpha, mu1, mu2) = (PI / 6.0, 0.1, 0.02);
    let set = [
        ("alpha", alpha),
        ("mu1", mu1),
        ("mu2", mu2),
        ("m", 1.0),
        ("M", 3.0),
    ];
    let wedge = run(&interpreted("wedge_and_block"), &set, &[], (1e-11, 1.0)).expect("it runs");
    let mirrored = run(&interpreted("prisms"), &set, &[], (1e-11, 1.0)).expect("it runs");
    // In this machine the block slides to the right, in the other to the left.
    let [x, s] = ["x", "s"].map(|name| value(&wedge.end().q, name));
    let [q1, q2] = ["q1", "q2"].map(|name| value(&mirrored.end().q, name));
    assert!(x < -1e-2 && s > 1.0, "{x} {s}");
    assert_near(-x, q1, 1e-10);
    assert_near(s * alpha.cos(), q2, 1e-10);
}

/// Painlevé's rod, whose tip slides in a guide.
const ROD: &str = "machine Rod in plane {
    parameters { m: kg = 1, l: m = 1, mu: 1 = 0.5, g: m/s^2 = 9.81 }
    coordinates { x: m, theta: rad = 1.1 }
    frames { tip = ground.shift(x, 0), rod = tip.turn(theta) }
    bodies { rod { mass: m, inertia: m*l^2/12, frame: rod, at: rod.point(l/2, 0) } }
    gravity (0, -g);
    sliding { rail { body: rod, on: ground, direction: (1, 0), friction: mu } }
}";

/// The effect of friction on the normal reaction of the rod, from Coulomb's law in the equations of
/// translation and rotation: `N (1 + B) = N₀`, for a tip that slides in the direction `sign`.
fn rod(theta: f64, omega: f64, mu: f64, sign: f64) -> [f64; 2] {
    let (m, l, g) = (1.0, 1.0, 9.81);
    let (sin, cos) = theta.sin_cos();
    let (r, inertia) = (0.5 * l, m * l * l / 12.0);
    // m y'' = N − m g, I θ'' = −N r cos θ + F r sin θ, F = −sign μ N, y = r sin θ:
    // y'' = r cos θ θ'' − r sin θ ω².
    let by_n = 1.0 / m + r * cos * (r * cos + sign * mu * r * sin) / inertia;
    let rest = g - r * sin * omega * omega;
    [rest, by_n]
}

#[test]
fn a_rod_slides_with_the_reaction_of_its_equations_typed_by_hand() {
    let machine = machine(ROD);
    let system = machine.prepare();
    let u = system.default_inputs();
    for (theta, omega, sign) in [(1.1, 0.0, 1.0), (0.7, 2.0, -1.0), (2.0, -1.0, 1.0)] {
        let [rest, by_n] = rod(theta, omega, 0.5, sign);
        let (q, v) = (vec![0.0, theta], vec![sign, omega]);
        let mut a = vec![0.0; 2];
        let mut forces = [lagrangian::ContactForce::default()];
        lagrangian::contact_forces(
            &system,
            At {
                t: 0.0,
                q: &q,
                v: &v,
                u: &u,
            },
            &mut a,
            &mut [],
            &mut forces,
        )
        .expect("it moves");
        let normal = rest / by_n;
        assert_near(forces[0].normal, normal, 1e-13 * normal.abs());
        assert_near(
            forces[0].friction,
            -sign * 0.5 * normal.abs(),
            1e-13 * normal.abs(),
        );
    }
}

#[test]
fn where_no_motion_or_several_have_a_friction_the_state_is_said() {
    // Pushed against the side to which it leans: 1 + 3 cos θ (cos θ − μ sin θ) < 0
    // for μ above 4/3, at tan θ = 2.
    let theta = 2.0_f64.atan();
    for (mu, is_left) in [(1.2, false), (1.4, true)] {
        let [_, by_n] = rod(theta, 0.0, mu, -1.0);
        assert_eq!(by_n < 0.0, is_left);
        let start = [("x", 0.0, -1.0), ("theta", theta, 0.0)];
        let result = run(&machine(ROD), &[("mu", mu)], &start, (1e-9, 1e-3));
        match (result, is_left) {
            (Ok(_), false) => {}
            (
                Err(Error::FrictionParadox {
                    contact,
                    several,
                    t,
                    q,
                    v,
                }),
                true,
            ) => {
                assert_eq!((contact.as_str(), several, t), ("rail", false, 0.0));
                assert_eq!((q, v), (vec![0.0, theta], vec![-1.0, 0.0]));
            }
            (other, _) => panic!("μ = {mu}: {:?}", other.map(|run| run.end().t)),
        }
    }
    // Sliding the same way, but rotating so fast that the rod lifts, it has two possible motions.
    let start = [("x", 0.0, -1.0), ("theta", theta, 6.0)];
    let result = run(&machine(ROD), &[("mu", 1.4)], &start, (1e-9, 1e-3));
    let Err(Error::FrictionParadox { several: true, .. }) = result else {
        panic!("{:?}", result.map(|run| run.end().t));
    };
}

#[test]
fn a_cart_with_a_pendulum_moves_alike_with_and_without_a_constraint() {
    let head = "parameters { M: kg = 2, m: kg = 1, l: m = 1, mu: 1 = 0.2, g: m/s^2 = 9.81 }
        gravity (0, -g);";
    let cart = "cart { mass: M, frame: cart }";
    let rail = "sliding { rail { body: cart, on: ground, direction: (1, 0), friction: mu } }";
    let fewest = machine(&format!(
        "machine Fewest in plane {{ {head} {rail}
            coordinates {{ x: m, phi: rad = 1.2 }}
            frames {{ cart = ground.shift(x, 0) }}
            bodies {{ {cart}, bob {{ mass: m, at: cart.origin + l*(sin(phi), -cos(phi)) }} }}
        }}"
    ));
    let held = machine(&format!(
        "machine Held in plane {{ {head} {rail}
            coordinates {{ x: m, a: m = l*sin(1.2), b: m = -l*cos(1.2) }}
            frames {{ cart = ground.shift(x, 0) }}
            bodies {{ {cart}, bob {{ mass: m, at: (a, b) }} }}
            constraints {{ rod: norm(bob.at - cart.at) = l }}
        }}"
    ));
    let one = run(&fewest, &[], &[], (1e-11, 6.0)).expect("it runs");
    let other = run(&held, &[], &[], (1e-11, 6.0)).expect("it runs");
    let (one_events, other_events) = (events(&one), events(&other));
    assert!(one_events.len() > 3, "{one_events:?}");
    assert_eq!(one_events.len(), other_events.len());
    for ((name, t), (other_name, other_t)) in one_events.iter().zip(&other_events) {
        assert_eq!(name, other_name);
        assert_near(*t, *other_t, 1e-8);
    }
    for t in [0.5, 2.0, 4.0, 6.0] {
        let [a, b] = [one.at(t), other.at(t)].map(|state| state.expect("in the run"));
        assert_near(value(&a.q, "x"), value(&b.q, "x"), 1e-8);
        let [a, b] = [one.observe(t), other.observe(t)].map(|o| o.expect("in the run").contacts[0]);
        assert_eq!(a.sticks, b.sticks);
        assert_near(a.normal, b.normal, 1e-6);
        assert_near(a.friction, b.friction, 1e-6);
    }
    assert!(other.statistics().constraint_residual < 1e-13);
    let balance = one.energy_balance().expect("kept");
    assert!(balance.relative().abs() < 1e-9, "{balance:?}");
}

#[test]
fn a_reaction_that_changes_its_side_is_an_event() {
    // A block on a rail that is shaken vertically with more than the acceleration of
    // gravity: N = m (g − a w² cos w t).
    let shaken = machine(
        "machine Shaken in plane {
            parameters { m: kg = 1, a: m = 0.01, w: rad/s = 40, mu: 1 = 0.3, g: m/s^2 = 9.81 }
            coordinates { x: m, der(x): m/s = 3 }
            frames { rail = ground.shift(0, a*cos(w*t)), seat = rail.shift(x, 0) }
            bodies { block { mass: m, frame: seat } }
            gravity (0, -g);
            sliding { rail { body: block, on: rail, direction: (1, 0), friction: mu } }
        }",
    );
    let run = run(&shaken, &[], &[], (1e-11, 0.15)).expect("it runs");
    let (g, most, w) = (9.81_f64, 16.0, 40.0);
    let turn = (g / most).acos() / w;
    let known = events(&run);
    assert_eq!(known.len(), 2, "{known:?}");
    for ((name, t), expected) in known.iter().zip([turn, 2.0 * PI / w - turn]) {
        assert_eq!(name, "rail presses the other way");
        assert_near(*t, expected, 1e-10);
    }
    // v = 3 − μ ∫ |g − a w² cos w t| dt, in parts between the sign changes of the integrand.
    let primitive = |t: f64| g * t - most * (w * t).sin() / w;
    let ends = [0.0, turn, 2.0 * PI / w - turn, 0.15];
    let pressed: f64 = ends
        .windows(2)
        .map(|p| (primitive(p[1]) - primitive(p[0])).abs())
        .sum();
    assert_near(value(&run.end().v, "x"), 3.0 - 0.3 * pressed, 1e-10);
}

/// A block on a rail, pulled by a constant force and pressed up and down by an oscillating one.
fn pressed(gravity: &str) -> InterpretedMachine {
    machine(&format!(
        "machine Pressed in plane {{
            parameters {{ m: kg = 1, mu: 1 = 0.2, p: N = 3, P: N = 15, w: rad/s = 2, g: m/s^2 = 9.81 }}
            coordinates {{ z: m }}
            bodies {{ block {{ mass: m, at: (z, 0) }} }}
            {gravity}
            forces {{ press {{ at: block.at, force: (p, P*sin(w*t)) }} }}
            sliding {{ rail {{ body: block, on: ground, direction: (1, 0), friction: mu }} }}
        }}"
    ))
}

#[test]
fn a_reaction_goes_through_zero_and_the_motion_goes_on() {
    // m v' = p − μ |N|, N = m g − P sin w t: the motion is unique for any N.
    let (p, most, w, mu, until) = (3.0, 15.0, 2.0_f64, 0.2, 5.0);
    for (gravity, g) in [("gravity (0, -g);", 9.81_f64), ("", 0.0)] {
        let first = (g / most).asin() / w;
        let turns: Vec<f64> = (0..9)
            .flat_map(|k| {
                let period = 2.0 * PI / w * f64::from(k);
                [period + first, period + PI / w - first]
            })
            .filter(|t| *t > 0.0 && *t < until)
            .collect();
        let primitive = |t: f64| g * t + most * (w * t).cos() / w;
        let ends: Vec<f64> = [0.0]
            .into_iter()
            .chain(turns.clone())
            .chain([until])
            .collect();
        let pieces = ends.windows(2);
        let load: f64 = pieces
            .map(|e| (primitive(e[1]) - primitive(e[0])).abs())
            .sum();
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let start = [("z", 0.0, 1.0)];
            let run = run(&pressed(gravity), &[], &start, (tolerance, until)).expect("it runs");
            let mut known = events(&run);
            // Where the reaction is zero at the start, the run may begin on either side.
            known.retain(|(_, t)| *t > 0.0);
            assert_eq!(known.len(), turns.len(), "{known:?}");
            for ((name, t), turn) in known.iter().zip(&turns) {
                assert_eq!(name, "rail presses the other way");
                // The reaction depends on time alone; its terms, 9.81 N and 15 N, are rounded once each.
                assert_near(*t, *turn, 8.0 * f64::EPSILON * until);
            }
            let v = 1.0 + p * until - mu * load;
            assert_near(value(&run.end().v, "z"), v, 100.0 * tolerance);
        }
    }
}

#[test]
fn contacts_break_away_and_stop_at_the_rounding_of_time() {
    let pulled = machine(
        "machine Pulled in plane {
            parameters { m: kg = 1, mu: 1 = 0.2, mu0: 1 = 0.3, c: N/s = 1, g: m/s^2 = 9.81 }
            coordinates { z: m }
            bodies { block { mass: m, at: (z, 0) } }
            gravity (0, -g);
            forces { pull { at: block.at, force: (c*t, 0*m*g) } }
            sliding {
                rail { body: block, on: ground, direction: (1, 0), friction: mu, static_friction: mu0 },
            }
        }",
    );
    for tolerance in [1e-4, 1e-6, 1e-9, 1e-13] {
        for c in [1.0, 0.37, 5e-3] {
            let away = 0.3 * 9.81 / c;
            let set = [("c", c)];
            let run = run(&pulled, &set, &[], (tolerance, 1.5 * away)).expect("it runs");
            let known = events(&run);
            assert_eq!(known[0].0, "rail slides");
            // The rounding of 0.3, of its product with 9.81 N, of c t, and of t.
            assert_near(known[0].1, away, 4.0 * f64::EPSILON * away);
        }
        // m v' = −μ m g: it comes to rest after v/(μ g).
        let set = [("c", 0.0)];
        let run = run(&pulled, &set, &[("z", 0.0, 2.5)], (tolerance, 3.0)).expect("it runs");
        let stop = 2.5 / (0.2 * 9.81);
        // The rate is a sum over some steps, each rounded.
        assert_near(events(&run)[0].1, stop, 16.0 * f64::EPSILON * stop);
        assert_eq!(value(&run.end().v, "z"), 0.0);
    }
}

/// A block on a rail that is shaken and turned; the coordinate is its position on the rail.
const SHAKEN: &str = "machine Shaken in plane {
    parameters {
        m: kg = 1, mu: 1 = 9, a: m = 0.1, b: m = 0.05, w: rad/s = 3, u: rad/s = 5, alpha: rad = -0.85,
        c: rad = 0.2, g: m/s^2 = 9.81,
    }
    coordinates { s: m }
    frames {
        rail = ground.shift(a*sin(w*t), b*cos(u*t)).turn(alpha + c*sin(w*t)),
        seat = rail.shift(s, 0),
    }
    bodies { block { mass: m, frame: seat } }
    gravity (0, -g);
    sliding { rail { body: block, on: rail, direction: rail.vector(1, 0), friction: mu } }
}";

/// A block on a rail that two motors shake along the ground; the coordinate is
/// its position over the ground.
const CARRIED: &str = "machine Carried in plane {
    parameters {
        m: kg = 1, mu: 1 = 9, a: m = 0.1, b: m = 0.3, w: rad/s = 3, u: rad/s = 1, alpha: rad = -0.85,
        g: m/s^2 = 9.81,
    }
    coordinates { x: m }
    define { motors = a*sin(w*t) - b*sin(u*t) }
    frames { rail = ground.shift(motors, 0).turn(alpha) }
    bodies { block { mass: m, at: (x, (x - motors)*tan(alpha)) } }
    gravity (0, -g);
    sliding { rail { body: block, on: rail, direction: rail.vector(1, 0), friction: mu } }
}";

#[test]
fn what_rests_within_rounding_rests() {
    let mut random = SplitMix::new(14);
    let (g, mut resting) = (9.81, 0);
    for draw in 0..400 {
        let mut number = |from: f64, to: f64| random.uniform(from, to);
        let (a, b, w, u) = (
            number(-0.2, 0.2),
            number(-0.2, 0.2),
            number(1.0, 9.0),
            number(1.0, 9.0),
        );
        let (alpha, c, t, place) = (
            number(-1.2, 1.2),
            number(-0.3, 0.3),
            number(0.0, 20.0),
            number(-2.0, 2.0),
        );
        let is_carried = draw % 2 == 1;
        let set = |text: &str, rest: &[(&str, f64)]| {
            let mut machine = machine(text);
            let all = [("a", a), ("b", b), ("w", w), ("u", u), ("alpha", alpha)];
            for (name, value) in all.iter().chain(rest) {
                machine.set(name, *value).expect("a parameter");
            }
            machine.prepare()
        };
        // The acceleration of the block at rest on the rail, and the direction of the rail.
        let (sin, cos) = (w * t).sin_cos();
        let (system, v, acceleration, angle) = if is_carried {
            let rate = a * (w * cos) - b * (u * (t * u).cos());
            let x = -a * w * w * sin + b * u * u * (u * t).sin();
            (set(CARRIED, &[]), rate, [x, 0.0], alpha)
        } else {
            let [theta, omega, alpha_dot] = [alpha + c * sin, c * w * cos, -c * w * w * sin];
            let e = [theta.cos(), theta.sin()];
            let shaken = [-a * w * w * sin, -b * u * u * (u * t).cos()];
            let x = shaken[0] + place * (-alpha_dot * e[1] - omega * omega * e[0]);
            let y = shaken[1] + place * (alpha_dot * e[0] - omega * omega * e[1]);
            (set(SHAKEN, &[("c", c)]), 0.0, [x, y], theta)
        };
        let inputs = system.default_inputs();
        let (q, mut a) = (vec![place], vec![0.0]);
        let mut force = |v: f64| {
            let mut forces = [lagrangian::ContactForce::default()];
            let at = At {
                t,
                q: &q,
                v: &vec![v],
                u: &inputs,
            };
            let found = lagrangian::contact_forces(&system, at, &mut a, &mut [], &mut forces);
            found.map(|()| forces[0])
        };
        let (sin, cos) = angle.sin_cos();
        let [x, y] = [acceleration[0], acceleration[1] + g];
        let [load, needed] = [y * cos - x * sin, x * cos + y * sin];
        // If it needs more friction than there is, it slides.
        if needed.abs() > 8.9 * load.abs() {
            continue;
        }
        let found = force(v).expect("it rests");
        resting += 1;
        assert!(found.sticks, "draw {draw}: {found:?}");
        assert_near(found.normal, load, 1e-11);
        assert_near(found.friction, needed, 1e-11);
        // A velocity clearly above rounding makes it slide, or jam where it would have to rise.
        if let Ok(found) = force(v + 1e-11) {
            assert!(!found.sticks, "draw {draw}: {found:?}");
        }
    }
    assert!(resting > 300, "{resting}");
}

#[test]
fn a_run_starts_from_rest_within_rounding() {
    // At t = 0 the motors drive the rail at a w − b u = 0.3 m/s − 0.3 m/s, which rounding makes nonzero.
    let start = [("x", 0.4, 0.1 * 3.0 - 0.3 * 1.0)];
    assert_ne!(start[0].2, 0.0);
    let run = run(&machine(CARRIED), &[], &start, (1e-10, 2.0)).expect("it runs");
    assert!(run.events().is_empty(), "{:?}", events(&run));
    let motors = 0.1 * 6.0_f64.sin() - 0.3 * 2.0_f64.sin();
    assert_near(value(&run.end().q, "x"), 0.4 + motors, 1e-9);
}
