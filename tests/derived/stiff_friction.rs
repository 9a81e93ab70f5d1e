//! Contacts that stick and slide in stiff machines, integrated by `radau5`.

use std::f64::consts::PI;

use lagrangian::{Coordinates, Machine, Method, Simulation, Solution, State};

lagrangian::machine! {
    /// A block on a belt that carries a load along by a stiff spring. As the stiffness grows, the machine
    /// tends to the stick-slip oscillator of their total mass.
    machine InertiaNodes in plane {
        parameters {
            m: kg = 0.5, load: kg = 0.5, k: N/m = 1, stiff: N/m = 1e6, settling: s = 0.01,
            v_b: m/s = 0.2, mu: 1 = 0.5, mu0: 1 = 1, g: m/s^2 = 2,
        }
        coordinates { x: m = 0, y: m = 0 }
        frames { belt = ground.shift(v_b*t, 0), seat = ground.shift(x, 0) }
        bodies { block { mass: m, frame: seat }, carried { mass: load, at: (y, 0) } }
        gravity (0, -g);
        springs { spring { stiffness: k, stretch: x }, joint { stiffness: stiff, stretch: y - x } }
        dampers { joint { damping: settling*stiff, stretch: y - x } }
        sliding {
            belt { body: block, on: belt, direction: (1, 0), friction: mu, static_friction: mu0 },
        }
    }
}

lagrangian::machine! {
    /// A block on an incline too flat for it to slide.
    machine Incline in plane {
        parameters { m: kg = 2, alpha: rad = 0.3, mu: 1 = 0.4, mu0: 1 = 0.5, g: m/s^2 = 9.81 }
        coordinates { s: m }
        frames { incline = ground.turn(-alpha), seat = incline.shift(s, 0) }
        bodies { block { mass: m, frame: seat } }
        gravity (0, -g);
        sliding {
            face {
                body: block, on: incline,
                direction: incline.vector(1, 0),
                friction: mu, static_friction: mu0,
            },
        }
    }
}

fn run<M: Machine>(
    machine: &M,
    start: State<Coordinates<M>>,
    (tolerance, until): (f64, f64),
) -> Solution<M> {
    Simulation::new(machine)
        .method(Method::named("radau5").expect("it is listed"))
        .tolerance(tolerance)
        .energy_balance(true)
        .until(until)
        .run(start)
        .expect("it runs")
}

#[test]
fn a_block_that_sticks_does_not_creep() {
    let incline = Incline::default();
    let run = run(&incline, incline.start(), (1e-9, 1000.0));
    assert_eq!((run.end().q.s, run.end().v.s), (0.0, 0.0));
    assert!(run.events().is_empty());
}

#[test]
fn a_block_that_is_pushed_comes_to_rest_and_stays_there() {
    let incline = Incline::default();
    let mut start = incline.start();
    start.v.s = 1.5;
    let run = run(&incline, start, (1e-10, 1000.0));
    let (g, alpha, mu) = (9.81, 0.3_f64, 0.4);
    let braking = g * (mu * alpha.cos() - alpha.sin());
    let (stop, way) = (1.5 / braking, 1.5 * 1.5 / (2.0 * braking));
    let [event] = run.events() else {
        panic!("{:?}", run.events());
    };
    assert_eq!(event.name, "face sticks");
    // The method is exact for constant deceleration.
    assert!((event.state.t - stop).abs() <= 1e-12 * stop);
    assert!((event.state.q.s - way).abs() <= 1e-12 * way);
    assert_eq!(run.end().q.s, event.state.q.s);
}

#[test]
fn what_carries_a_load_stiffly_sticks_and_slips_like_one_block() {
    let mut steps = Vec::new();
    // Whether the block sticks depends on the force in the joint, whose error is the stiffness times the
    // error of the stretch: at 1e6 N/m and this tolerance it is below 0.01 N, against the 0.5 N of
    // friction in reserve.
    for stiff in [1e4, 1e5, 1e6] {
        let carrier = InertiaNodes {
            stiff,
            ..Default::default()
        };
        let mut start = carrier.start();
        (start.v.x, start.v.y) = (0.2, 0.2);
        let tolerance = 1e-8;
        let run = run(&carrier, start, (tolerance, 40.0));
        // The closed form of one block, m = 1 kg, k = 1 N/m, v_b = 0.2 m/s, F_s = 1 N, F_k = 0.5 N.
        let (v_b, jump) = (0.2_f64, 0.5);
        let slip = 2.0 * (PI - (jump / v_b).atan());
        let period = 2.0 * jump / v_b + slip;
        // The first term bounds the error of the state at rates of 0.2 m/s and more; the second the
        // compression of the joint by a force of 1 N over the same number of cycles.
        let limit = 5.0 * run.statistics().steps as f64 * tolerance + 40.0 / stiff;
        assert!(run.events().len() > 7, "{:?}", run.events());
        for (i, event) in run.events().iter().enumerate() {
            let cycle = period * (i / 2) as f64;
            let (name, after) = match i % 2 {
                0 => ("belt slides", 1.0 / v_b),
                _ => ("belt sticks", 1.0 / v_b + slip),
            };
            assert_eq!(event.name, name);
            let late = event.state.t - after - cycle;
            assert!(late.abs() <= limit, "{stiff:e} {i}: {late:e} > {limit:e}");
        }
        let balance = run.energy_balance().expect("kept");
        assert!(balance.work > 1.0 && balance.dissipated > 1.0);
        assert!(balance.relative().abs() <= limit, "{balance:?}");
        steps.push(run.statistics().steps);
    }
    // The number of steps does not grow with the stiffness.
    assert!(
        steps.iter().all(|n| *n <= steps[0] + steps[0] / 10),
        "{steps:?}"
    );
}
