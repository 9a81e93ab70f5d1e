//! Machines from the macro whose parts collide or press on compliant walls.

use lagrangian::{Compliance, ContactEventKind, METHODS, Simulation, System};

lagrangian::machine! {
    /// A mass between a compliant wall and a wall from which it bounces.
    machine Between in plane {
        parameters { m: kg = 2, k: N/m = 800, e: 1 = 0.5 }
        coordinates { x: m = -1, der(x): m/s = 3 }
        bodies { block { mass: m, at: (x, 0) } }
        contacts {
            spring { gap: -x, compliance: linear(k, 0) },
            wall   { gap: x + 2, restitution: e, order: sequence },
        }
    }
}

/// The mass reaches the compliant wall after 1/3 s, leaves it after half a period of π/20 s, reaches the other wall 2/3 s later and
/// leaves that with half its speed. Every method reproduces this to its tolerance.
#[test]
fn a_machine_of_a_macro_yields_and_bounces() {
    let machine = Between::default();
    let system = machine.prepare();
    let laws: Vec<_> = system.unilateral_contacts().map(|c| c.compliance).collect();
    assert_eq!(laws, [Some(Compliance::Linear), None]);
    for method in &METHODS {
        let run = Simulation::new(&machine)
            .method(method)
            .tolerance(1e-10)
            .energy_balance(true)
            .until(1.5)
            .run(machine.start())
            .expect("it runs");
        let half = std::f64::consts::PI / 20.0;
        let expected = [
            (ContactEventKind::Closes, 1.0 / 3.0),
            (ContactEventKind::Opens, 1.0 / 3.0 + half),
            (ContactEventKind::Impact, 1.0 + half),
        ];
        let events = run.contact_events();
        assert_eq!(
            events.len(),
            expected.len(),
            "{}: {events:?}",
            method.tableau.name
        );
        for (event, (kind, t)) in events.iter().zip(expected) {
            assert_eq!(event.kind, kind);
            let error = event.state.t - t;
            // At most 10⁴ steps, each within the tolerance, at speeds of 3 m/s.
            assert!(
                error.abs() < 1e-6,
                "{}: {kind:?} {error:e}",
                method.tableau.name
            );
        }
        assert!(
            (run.end().v.x - 1.5).abs() < 3e-6,
            "{}",
            method.tableau.name
        );
        let balance = run.energy_balance().expect("it was kept");
        assert!(
            balance.residual().abs() < 2e-5,
            "{}: {balance:?}",
            method.tableau.name
        );
    }
}

lagrangian::machine! {
    /// A ball on a table that slips until it rolls.
    machine Cue in space {
        parameters { m: kg = 0.2, r: m = 0.03, mu: 1 = 0.2, g: m/s^2 = 9.81 }
        coordinates {
            x: m, y: m, z: m = r, a: rad, b: rad, c: rad,
            der(x): m/s = 1, der(a): rad/s = 30, der(c): rad/s = 8,
        }
        frames { ball = ground.shift(x, y, z).turn(x, a).turn(y, b).turn(z, c) }
        bodies { ball { mass: m, inertia: (2/5*m*r^2, 2/5*m*r^2, 2/5*m*r^2), frame: ball } }
        spheres { ball { on: ball, center: (0, 0, 0), radius: r } }
        gravity (0, 0, -g);
        contacts { cloth { sphere: ball, along: ground, restitution: 0.5, friction: mu } }
    }
}

/// The ball first slips with u = (1, 0.9) m/s for a time 2|u|/(7 μ g), then rolls with its initial velocity less 2/7 u. Every method that
/// finds events reproduces this to its tolerance.
#[test]
fn a_ball_of_a_macro_slips_in_two_directions() {
    let machine = Cue::default();
    let system = machine.prepare();
    let across: Vec<_> = system
        .unilateral_contacts()
        .map(|c| c.is_second_tangent)
        .collect();
    assert_eq!(across, [false, true]);
    let slip = [1.0_f64, 0.9];
    let rolls = 2.0 * slip[0].hypot(slip[1]) / (7.0 * 0.2 * 9.81);
    for method in &METHODS {
        let run = Simulation::new(&machine)
            .method(method)
            .tolerance(1e-10)
            .energy_balance(true)
            .until(0.4)
            .run(machine.start())
            .expect("it runs");
        let [event] = run.contact_events() else {
            panic!("{}: {:?}", method.tableau.name, run.contact_events());
        };
        assert_eq!(event.kind, ContactEventKind::Sticks);
        // At most 10⁴ steps, each within the tolerance.
        let error = event.state.t - rolls;
        assert!(error.abs() < 1e-6, "{}: {error:e}", method.tableau.name);
        let after = [1.0 - 2.0 / 7.0 * slip[0], -2.0 / 7.0 * slip[1]];
        let v = run.end().v;
        assert!((v.x - after[0]).abs() < 1e-6 && (v.y - after[1]).abs() < 1e-6);
        let balance = run.energy_balance().expect("it was kept");
        assert!(
            balance.residual().abs() < 1e-6,
            "{}: {balance:?}",
            method.tableau.name
        );
    }
}

lagrangian::machine! {
    /// A box that falls flat on a polygon fixed to the ground.
    machine Landing in plane {
        parameters { m: kg = 2, b: m = 0.1, h: m = 0.05, drop: m = 0.2, speed: m/s = 0.5, g: m/s^2 = 9.81 }
        coordinates { x: m, y: m = h + drop, theta: rad, der(x): m/s = speed }
        frames { held = ground.shift(x, y).turn(theta) }
        bodies {
            box { mass: m, inertia: m*(b^2 + h^2)/3, frame: held, outline: ((b, h), (-b, h), (-b, -h), (b, -h)) },
        }
        gravity (0, -g);
        contacts {
            plate {
                corners: outline, on: box, against: ((-1, -1), (1, -1), (1, 0), (-1, 0)), of: ground,
                restitution: 0, friction: 0.5,
            },
        }
    }
}

/// It lands on two corners at once after √(2 d/g). The impulse of friction, which may reach half the impulse that stops the fall, stops
/// its sliding there. Every method reproduces this.
#[test]
fn a_box_of_a_macro_lands_on_a_polygon() {
    let machine = Landing::default();
    let system = machine.prepare();
    assert_eq!(system.unilateral_contacts().len(), 8);
    assert!(system.unilateral_contacts().all(|contact| contact.has_face));
    let lands = (2.0 * 0.2_f64 / 9.81).sqrt();
    for method in &METHODS {
        let run = Simulation::new(&machine)
            .method(method)
            .tolerance(1e-10)
            .energy_balance(true)
            .until(0.4)
            .run(machine.start())
            .expect("it runs");
        let name = method.tableau.name;
        let impacts = run.contact_events().iter();
        let impacts: Vec<_> = impacts
            .filter(|event| event.kind == ContactEventKind::Impact)
            .collect();
        let names: Vec<&str> = impacts.iter().map(|event| event.contact.as_str()).collect();
        assert_eq!(names, ["plate[3]", "plate[4]"], "{name}");
        // At most 10⁴ steps, each within the tolerance.
        assert!((impacts[0].state.t - lands).abs() < 1e-6, "{name}");
        let (q, v) = (run.end().q, run.end().v);
        assert!(
            (q.x - 0.5 * lands).abs() < 1e-6 && (q.y - 0.05).abs() < 1e-6,
            "{name}: {q:?}"
        );
        assert!(
            q.theta.abs() < 1e-6 && v.x.abs() < 1e-6,
            "{name}: {q:?} {v:?}"
        );
        let balance = run.energy_balance().expect("it was kept");
        assert!(balance.residual().abs() < 1e-6, "{name}: {balance:?}");
    }
}
