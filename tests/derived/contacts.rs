//! Machines from the macro whose parts collide or press on compliant walls.

use lagrangian::{
    Compliance, ContactEventKind, METHODS, Machine, Method, Simulation, Staged, System,
};

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

lagrangian::machine! {
    /// A block that slips on a belt, joined by a spring to one that sticks on the floor and to a driven one whose constraint moves.
    machine Conveyed in plane {
        parameters { m: kg = 2, k: N/m = 800, mu: 1 = 0.4, g: m/s^2 = 9.81, speed: m/s = 5, reach: m = 0.1, length: m = 1, beat: rad/s = 3 }
        coordinates { x: m, y: m, u: m = 1, w: m, z: m = 0, der(x): m/s = 0.3 }
        bodies {
            block  { mass: m, at: (x, y) },
            other  { mass: m, at: (u, w) },
            driven { mass: 1, at: (z, 0) },
            shaken { mass: 1, at: (0, reach*sin(beat*t)) },
        }
        potentials { link: k/2*((x - u + length)^2 + (x - z)^2) }
        gravity (0, -g);
        constraints { drive: z = reach/10*sin(beat*t) }
        contacts {
            belt  { gap: y, slip: der(x) - speed, restitution: 0, friction: mu },
            floor { gap: w, slip: der(u), restitution: 0, friction: 20 },
        }
    }
}

lagrangian::machine! {
    /// A puck that slips on a moving table, held by a spring.
    machine Puck in space {
        parameters { m: kg = 2, k: N/m = 80, mu: 1 = 0.2, g: m/s^2 = 9.81, speed: m/s = 5 }
        coordinates { x: m, y: m, z: m, der(y): m/s = 0.4 }
        bodies { puck { mass: m, at: (x, y, z) } }
        potentials { link: k/2*(x^2 + y^2) }
        gravity (0, 0, -g);
        contacts { table { gap: z, slip: (der(x) - speed, der(y)), restitution: 0, friction: mu } }
    }
}

/// With closed contacts that slip and stick, constraints that move and bodies that are driven, steps allocate nothing, and with an energy balance only
/// what an entry of energies takes.
#[test]
fn closed_contacts_allocate_nothing() {
    fn allocations<M: Machine>(machine: &M, method: &'static Method, balance: bool) -> [u64; 2] {
        let [(short, few), (long, many)] = [2.0, 12.0].map(|until| {
            let mut steps = 0;
            let counted = allocation_counter::measure(|| {
                let run = Simulation::new(machine)
                    .method(method)
                    .tolerance(1e-7)
                    .energy_balance(balance)
                    .forget_steps()
                    .until(until)
                    .run(machine.start())
                    .expect("it runs");
                assert!(run.contact_events().is_empty());
                steps = run.statistics().steps as u64;
            });
            (counted.count_total, steps)
        });
        assert!(many > few + 20);
        [long - short, many - few]
    }
    for method in [&Method::DOP853, &Method::DOPRI5] {
        let name = method.tableau.name;
        let (conveyed, puck) = (Conveyed::default(), Puck::default());
        assert_eq!(allocations(&conveyed, method, false)[0], 0, "{name}");
        assert_eq!(allocations(&puck, method, false)[0], 0, "{name}");
        for [count, steps] in [
            allocations(&conveyed, method, true),
            allocations(&puck, method, true),
        ] {
            assert!(
                count <= ALLOCATIONS_OF_ENTRY * (steps + MORE_ENTRIES),
                "{name}: {count} in {steps} steps"
            );
        }
    }
}

/// What an entry of energies keeps: the energies of each contact, their rates, and the crushing works that they are made of. An evaluation that allocated
/// would do so at least six times in each step.
const ALLOCATIONS_OF_ENTRY: u64 = 3;

/// How many more entries than steps the longer runs may have; they have two or three, however many steps they take.
const MORE_ENTRIES: u64 = 4;

lagrangian::machine! {
    /// A box that stands on four feet and is pushed, less than its friction can hold, while a weight falls beside it and comes to rest.
    machine Standing in space {
        parameters { m: kg = 2, a: m = 0.3, c: m = 0.1, mu: 1 = 0.5, push: N = 4, g: m/s^2 = 9.81 }
        coordinates { x: m, y: m, z: m = c, yaw: rad, pitch: rad, roll: rad, h: m = 1 }
        frames { held = ground.shift(x, y, z).turn(z, yaw).turn(y, pitch).turn(x, roll) }
        bodies {
            box { mass: m, inertia: (m/3*(a^2 + c^2), m/3*(a^2 + c^2), m/3*2*a^2), frame: held },
            weight { mass: m/10, at: (2, 0, h) },
        }
        gravity (0, 0, -g);
        forces { push { at: held.point(0, 0, 0), force: (push, push/2, 0) } }
        contacts {
            feet { corners: ((a, a, -c), (a, -a, -c), (-a, a, -c), (-a, -a, -c)), on: held, along: ground, restitution: 0, friction: mu },
            floor { gap: h, restitution: 0 },
        }
    }
}

/// Steps of time stepping allocate nothing, whether contacts slip or stick on more feet than are needed, and whether constraints move: what a step needs is there from
/// the steps before.
#[test]
fn time_stepping_allocates_nothing() {
    fn allocations<M: Machine>(machine: &M) -> u64 {
        let [(short, few), (long, many)] = [1.0, 3.0].map(|until| {
            let mut steps = 0;
            let counted = allocation_counter::measure(|| {
                let run = Simulation::new(machine)
                    .method(Method::MOREAU)
                    .longest_step(2e-3)
                    .forget_steps()
                    .forget_contact_phases()
                    .forget_contact_events()
                    .until(until)
                    .run(machine.start())
                    .expect("it runs");
                steps = run.statistics().steps;
            });
            (counted.count_total, steps)
        });
        assert_eq!(many - few, 1000);
        long - short
    }
    assert_eq!(allocations(&Conveyed::default()), 0);
    assert_eq!(allocations(&Puck::default()), 0);
    assert_eq!(allocations(&Standing::default()), 0);
}

lagrangian::machine! {
    /// A disc that falls onto the floor while it turns as if it rolled, and is slowed down by rolling resistance.
    machine Rolling in plane {
        parameters { m: kg = 2, r: m = 0.1, speed: m/s = 1, rho: m = 0.004, h: m = 0.05, g: m/s^2 = 9.81 }
        coordinates { x: m, y: m = r + h, theta: rad, der(x): m/s = speed, der(theta): rad/s = -speed/r }
        bodies { disc { mass: m, inertia: m*r^2/2, at: (x, y), angle: theta } }
        circles { rim { on: disc, center: (0, 0), radius: r } }
        gravity (0, -g);
        contacts { floor { circle: rim, along: ground, restitution: 0, friction: 0.5, rolling_resistance: rho } }
    }
}

/// The same disc in other units of length comes to rest at the same place. With `k = 2 ρ/(3 r)` the impact takes `k √(2 g h)` of its speed, and it then slows
/// down by `k g`.
#[test]
fn a_disc_rolls_alike_in_all_units_of_length() {
    for unit in [1.0, 1e-3, 1e-6, 1e-9, 1e6] {
        let mut machine = Rolling::default();
        for (name, value) in [
            ("r", 0.1),
            ("speed", 1.0),
            ("rho", 0.004),
            ("h", 0.05),
            ("g", 9.81),
        ] {
            machine.set(name, value * unit).expect("a parameter");
        }
        let run = Simulation::new(&machine)
            .tolerance(1e-10)
            .until(5.0)
            .run(machine.start())
            .unwrap_or_else(|error| panic!("{unit}: {error}"));
        let k = 2.0 * 0.004 / (3.0 * 0.1);
        let fall = (2.0 * 0.05 / 9.81_f64).sqrt();
        let speed = 1.0 - k * 9.81 * fall;
        let expected = fall + speed * speed / (2.0 * k * 9.81);
        let found = run.end().q.x / unit;
        assert!(
            (found - expected).abs() < 1e-9,
            "{unit}: {found} {expected}"
        );
        let kinds: Vec<_> = run
            .contact_events()
            .iter()
            .map(|event| event.kind)
            .collect();
        use ContactEventKind::{Closes, Impact, Sticks};
        assert_eq!(kinds, [Impact, Closes, Sticks], "{unit}");
    }
}

lagrangian::machine! {
    /// A pendulum on a shaken pivot between two stops, with its accelerations in stages and their derivatives.
    machine Clapper in plane {
        parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81, e: 1 = 0.7, A: m = 0.02, w: rad/s = 9 }
        coordinates { phi: rad = 0.4 }
        bodies { bob { mass: m, at: (A*sin(w*t) + l*sin(phi), -l*cos(phi)) } }
        gravity (0, -g);
        contacts {
            left  { gap: l/4 + l*sin(phi), restitution: e },
            right { gap: l/2 - l*sin(phi), restitution: e },
        }
        derivatives { coordinates, rates, l }
        stages { time, coordinates }
    }
}

lagrangian::machine! {
    /// The machine without derivatives and stages.
    machine PlainClapper in plane {
        parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81, e: 1 = 0.7, A: m = 0.02, w: rad/s = 9 }
        coordinates { phi: rad = 0.4 }
        bodies { bob { mass: m, at: (A*sin(w*t) + l*sin(phi), -l*cos(phi)) } }
        gravity (0, -g);
        contacts {
            left  { gap: l/4 + l*sin(phi), restitution: e },
            right { gap: l/2 - l*sin(phi), restitution: e },
        }
    }
}

/// `φ̈ = −g/l sin φ + A w²/l sin wt cos φ` with both contacts open: at once, in stages, and differentiated. Stages and derivatives leave a
/// run and its impacts as they are.
#[test]
fn stages_and_derivatives_are_those_of_open_contacts() {
    let clapper = Clapper::default();
    let system = clapper.prepare();
    let Clapper { l, g, w, .. } = clapper;
    let (t, phi, rate) = (0.3_f64, 0.2_f64, -1.1);
    let shake = clapper.A * w * w / l * (w * t).sin();
    let exact = -g / l * phi.sin() + shake * phi.cos();
    let close = |found: f64, exact: f64| {
        let size = g / l + shake.abs();
        assert!(
            (found - exact).abs() <= 64.0 * f64::EPSILON * size,
            "{found}, {exact}"
        );
    };
    let u = system.default_inputs();
    let mut a = [0.0];
    assert_eq!(system.accelerations(t, &[phi], &[rate], &u, &mut a), Ok(()));
    close(a[0], exact);
    let at = system
        .at_position(&system.at_time(t), &[phi])
        .expect("it has inertia");
    assert_eq!(system.accelerations_at(&at, &[rate], &u, &mut a), Ok(()));
    close(a[0], exact);
    let found = clapper::derivatives(&system, t, &[phi], &[rate]).expect("it has inertia");
    close(found.accelerations[0], exact);
    close(
        found.by_coordinates[0][0],
        -g / l * phi.cos() - shake * phi.sin(),
    );
    close(found.by_rates[0][0], 0.0);
    close(found.by_parameters[0][0] * l, -exact);

    let run = |tolerance: f64| {
        Simulation::new(&clapper)
            .tolerance(tolerance)
            .energy_balance(true)
            .until(5.0)
            .run(clapper.start())
            .expect("it runs")
    };
    let plain = PlainClapper::default();
    let other = Simulation::new(&plain)
        .tolerance(1e-11)
        .until(5.0)
        .run(plain.start())
        .expect("it runs");
    let run = run(1e-11);
    let (events, others) = (run.contact_events(), other.contact_events());
    assert!(events.len() > 3, "{events:?}");
    assert_eq!(events.len(), others.len());
    for (one, other) in events.iter().zip(others) {
        // Each impact may multiply errors of 1e-11 by some tens.
        assert_eq!((one.kind, &one.contact), (other.kind, &other.contact));
        assert!((one.state.t - other.state.t).abs() < 1e-7);
    }
    let balance = run.energy_balance().expect("it was kept");
    assert!(balance.residual().abs() < 1e-9, "{balance:?}");
}

lagrangian::machine! {
    /// A pendulum of small angle that hits a wall.
    machine SmallClapper in plane {
        parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81, e: 1 = 0.5 }
        coordinates { phi: rad = 0.2 }
        bodies { bob { mass: m, at: (l*sin(phi), -l*cos(phi)) } }
        gravity (0, -g);
        contacts { wall { gap: l*sin(phi), restitution: e } }
        approximations { phi: small }
    }
}

/// `φ̈ = −g/l φ`, which hits the wall at φ = 0 after a quarter of a period and then every half period, each time with `e` of its rate.
#[test]
fn an_approximated_machine_bounces() {
    let clapper = SmallClapper::default();
    let omega = (clapper.g / clapper.l).sqrt();
    let half = std::f64::consts::PI / omega;
    let run = Simulation::new(&clapper)
        .tolerance(1e-11)
        .energy_balance(true)
        .until(2.0)
        .run(clapper.start())
        .expect("it runs");
    let events = run.contact_events();
    assert_eq!(events.len(), 3);
    for (k, event) in events.iter().enumerate() {
        let t = (0.5 + k as f64) * half;
        assert!((event.state.t - t).abs() < 1e-9, "{event:?}");
        let rate = 0.2 * omega * 0.5_f64.powi(k as i32 + 1);
        assert!((event.state.v.phi - rate).abs() < 1e-9, "{event:?}");
    }
    let balance = run.energy_balance().expect("it was kept");
    assert!(balance.residual().abs() < 1e-9, "{balance:?}");
}

lagrangian::machine! {
    /// A block on a rail that is braked, hits an oblique wall, and is braked again.
    machine Carriage in plane {
        parameters { m: kg = 2, L: m = 1, mu: 1 = 0.2, e: 1 = 0.7, g: m/s^2 = 9.81, v0: m/s = 3, slope: rad = 2 }
        coordinates { x: m, der(x): m/s = v0 }
        frames { seat = ground.shift(x, 0), wall = ground.shift(L, 0).turn(slope) }
        bodies { block { mass: m, frame: seat } }
        gravity (0, -g);
        sliding { rail { body: block, on: ground, direction: (1, 0), friction: mu } }
        contacts { stop { point: (0, 0), on: block, along: wall, restitution: e } }
    }
}

/// `v₁² = v₀² − 2 μ g L`, then e v₁, until that is used up after e v₁/(μ g). The rail takes the normal impulse −Λ cos β of the wall. Every method reproduces this.
#[test]
fn a_guide_of_a_macro_stands_beside_a_contact() {
    let machine = Carriage::default();
    let system = machine.prepare();
    assert_eq!((system.contacts().len(), system.guides()), (0, 1));
    let (braking, e) = (0.2 * 9.81, 0.7_f64);
    let v0 = 3.0_f64;
    let v1 = (v0 * v0 - 2.0 * braking).sqrt();
    let way = (e * v1).powi(2) / (2.0 * braking);
    let impulse = 2.0 * (1.0 + e) * v1 / (2.0_f64.sin() + 0.2 * 2.0_f64.cos());
    for method in &METHODS {
        let run = Simulation::new(&machine)
            .method(method)
            .tolerance(1e-10)
            .energy_balance(true)
            .until(3.0)
            .run(machine.start())
            .expect("it runs");
        let name = method.tableau.name;
        let x = run.end().q.x;
        assert!((x - 1.0 + way).abs() < 1e-6, "{name}: {x}");
        let kinds: Vec<_> = run
            .contact_events()
            .iter()
            .map(|event| event.kind)
            .collect();
        use ContactEventKind::{Impact, Reverses, Sticks};
        assert_eq!(kinds, [Impact, Impact, Reverses, Sticks], "{name}");
        let rail = run.contact_events()[1].impact.expect("an impact").impulse[0];
        assert!(
            (rail + impulse * 2.0_f64.cos()).abs() < 1e-6,
            "{name}: {rail}"
        );
        let balance = run.energy_balance().expect("it was kept");
        assert!(balance.residual().abs() < 1e-6, "{name}: {balance:?}");
    }
}
