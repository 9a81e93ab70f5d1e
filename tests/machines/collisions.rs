//! Runs with very many impacts whose energy balance must close: kinetic and potential energy plus the losses in impacts and friction equal the
//! initial energy plus the drive's work, to what tolerance and rounding of all steps explain.

use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{
    At, ContactEventKind, Crossing, Error, Machine, Method, Simulation, Solution, System, Vector,
    unilateral_forces,
};

/// The tolerance of a step, relative and absolute.
const TOLERANCE: f64 = 1e-9;

fn machine(name: &str, settings: &[(&str, f64)]) -> InterpretedMachine {
    let path = format!(
        "{}/../machines/contacts/{name}.machine",
        env!("CARGO_MANIFEST_DIR")
    );
    let mut machine = InterpretedMachine::from_file(path).expect("a good spec");
    for (parameter, value) in settings {
        machine.set(parameter, *value).expect("a parameter");
    }
    machine
}

/// Runs a machine without keeping its steps, by a method that never hands over to time stepping.
fn run(machine: &InterpretedMachine, until: f64) -> Solution<InterpretedMachine> {
    Simulation::new(machine)
        .method(Method::named("dop853").expect("the default method"))
        .tolerance(TOLERANCE)
        .until(until)
        .max_steps(usize::MAX)
        .forget_steps()
        .energy_balance(true)
        .run_interpreted(machine.start())
        .unwrap_or_else(|error| panic!("{error}"))
}

fn impacts(run: &Solution<InterpretedMachine>) -> usize {
    let all = run.contact_events().iter();
    all.filter(|event| event.kind == ContactEventKind::Impact)
        .count()
}

/// Checks that tolerance and rounding of all steps explain the residual of the energy balance, and returns that residual.
fn is_booked(run: &Solution<InterpretedMachine>) -> f64 {
    let balance = run.energy_balance().expect("a balance");
    let residual = balance.residual();
    assert!(
        residual.abs() <= balance.explained,
        "{residual:e} of {:e}",
        balance.explained
    );
    // The tolerance in each step, times the energy exchanged.
    let of_steps = TOLERANCE * run.statistics().steps as f64 * balance.exchanged;
    assert!(residual.abs() <= of_steps, "{residual:e} of {of_steps:e}");
    assert_eq!(run.warnings(), []);
    residual
}

/// A ball that falls from h keeps the fraction e of its speed in each impact. The k-th impact is at √(2h/g) (1 + 2e(1 − e^(k−1))/(1 − e)), and n
/// impacts take m g h (1 − e^(2n)). Here e = 1 − 1/n, so that they take about 1 − 1/e² of all, with Euler's number e.
///
/// Each flight takes one or a few steps, which are exact but for rounding. A step has about 300 operations (12 stages, each a sum of the ones
/// before), each of which changes the energy by at most half a unit in the last place.
fn ball(n: i32) {
    let e = 1.0 - 1.0 / f64::from(n);
    let machine = machine("bouncing_ball", &[("e", e)]);
    let (energy, fall) = (0.1 * 9.81, (2.0_f64 / 9.81).sqrt());
    let of_n = e.powi(n);
    // 1 − e is 1/n. The run ends half a flight after the n-th impact.
    let last = fall * (1.0 + 2.0 * e * (1.0 - e.powi(n - 1)) * f64::from(n));
    let run = run(&machine, last + fall * of_n);
    assert_eq!(impacts(&run), n as usize);
    let residual = is_booked(&run);
    let lost: f64 = run.impact_losses().iter().sum();
    let truth = energy * (1.0 - of_n * of_n);
    let rounding = 300.0 * f64::from(n) * 0.5 * f64::EPSILON * energy;
    assert!(
        (lost - truth).abs() <= rounding,
        "{lost}, not {truth}: {rounding:e}"
    );
    assert!(residual.abs() <= rounding, "{residual:e}: {rounding:e}");
    println!(
        "{n} impacts of a ball: {} steps, {:.1} s, {lost:.12} J lost, off by {:.1e}, residual {residual:.1e} J",
        run.statistics().steps,
        run.statistics().seconds,
        lost - truth
    );
}

#[test]
fn ten_thousand_impacts_of_a_ball_are_booked() {
    ball(10_000);
}

#[test]
#[ignore = "a million impacts take minutes"]
fn a_million_impacts_of_a_ball_are_booked() {
    ball(1_000_000);
}

/// A crusher whose debalance turns at 40 rad/s, slowly enough that its parts never come to roll on each other for good. Its impacts go on in
/// sequences that accumulate, with phases of rolling and slipping between them.
/// A ball that loses nothing falls for √(2h/g) and then hits the floor after every two of these. What is known of it without its impacts is their number.
#[test]
fn a_run_keeps_no_more_of_its_impacts_than_it_is_asked_for() {
    let ball = machine("bouncing_ball", &[("e", 1.0)]);
    let simulation = |until: f64| {
        Simulation::new(&ball)
            .method(Method::named("dop853").expect("the default method"))
            .tolerance(TOLERANCE)
            .until(until)
            .energy_balance(true)
            .forget_steps()
            .forget_energies()
            .forget_contact_phases()
    };
    let until = 200.0;
    let fall = (2.0_f64 / 9.81).sqrt();
    let expected = ((until / fall + 1.0) / 2.0).floor() as usize;
    let full = simulation(until)
        .run_interpreted(ball.start())
        .expect("a run");
    assert_eq!(impacts(&full), expected);
    let counted = simulation(until)
        .forget_contact_events()
        .run_interpreted(ball.start())
        .expect("a run");
    for run in [&full, &counted] {
        assert_eq!(run.contact_tallies()[0].impacts, expected);
        assert_eq!(run.contact_tallies()[0].closed_at, None);
        // The first and the last.
        assert_eq!(run.contact_phases().len(), 2);
        assert_eq!(run.energies().len(), 2);
        assert_eq!(run.end(), full.end());
        assert_eq!(run.closed_contacts(until), [false]);
        assert!(run.closed_contacts(0.5 * until).is_empty());
        let mut before = run.end().clone();
        before.t = 0.5 * until;
        let forgotten = Error::ContactsForgotten { t: before.t };
        assert_eq!(run.observe_state(&before).unwrap_err(), forgotten);
    }
    assert!(counted.contact_events().is_empty() && counted.events().is_empty());
    // What samples and other events need is kept.
    let sampled = simulation(10.0)
        .every(1.0)
        .event("top", Crossing::Falling, |state| state.v.values[0] - 1e-3)
        .run_interpreted(ball.start())
        .expect("a run");
    let tops = sampled.events().iter().filter(|event| event.name == "top");
    let states = sampled
        .samples()
        .iter()
        .chain(tops.map(|event| &event.state));
    for state in states {
        let seen = sampled.observe_state(state).expect("it is kept");
        assert_eq!(seen.unilateral[0].normal, 0.0);
        assert!((seen.a.values[0] + 9.81).abs() < 1e-12);
    }
    assert!(sampled.contact_phases().len() <= 2 + 11 + 12);
}

fn crusher(until: f64, least: usize) {
    let run = run(&machine("colliding_crusher", &[("w", 40.0)]), until);
    let count = impacts(&run);
    assert!(count >= least, "{count}");
    let residual = is_booked(&run);
    let balance = run.energy_balance().expect("a balance");
    let taken: f64 = run.contact_energies().iter().map(|of| of.lost()).sum();
    println!(
        "{count} impacts of the crusher in {until} s: {} steps, {:.1} s, work {:.6e} J, contacts took {taken:.6e} J, residual {residual:.1e} J, {:.1e} explained",
        run.statistics().steps,
        run.statistics().seconds,
        balance.work,
        balance.explained
    );
    // All losses are in the contacts and in the suspension, and both are positive.
    assert!(taken > 0.0 && taken < balance.dissipated);
}

#[test]
fn hundreds_of_impacts_of_the_crusher_are_booked() {
    crusher(3.0, 400);
}

#[test]
#[ignore = "ten thousand impacts take minutes"]
fn ten_thousand_impacts_of_the_crusher_are_booked() {
    crusher(200.0, 10_000);
}

/// A compiled machine collides as the interpreted one does, event by event, to the last bit.
#[test]
fn compiled_machines_collide_as_interpreted_ones_do() {
    fn check<M: Machine>(compiled: &M, name: &str, until: f64) {
        let interpreted = machine(name, &[]);
        let run = |machine: &InterpretedMachine| run(machine, until);
        let expected = run(&interpreted);
        let found = Simulation::new(compiled)
            .method(Method::named("dop853").expect("the default method"))
            .tolerance(TOLERANCE)
            .until(until)
            .run(compiled.start())
            .unwrap_or_else(|error| panic!("{error}"));
        let (ours, theirs) = (found.contact_events(), expected.contact_events());
        assert_eq!(ours.len(), theirs.len(), "{name}");
        assert!(!ours.is_empty(), "{name}");
        for (ours, theirs) in ours.iter().zip(theirs) {
            assert_eq!(ours.contact, theirs.contact);
            assert_eq!(ours.kind, theirs.kind);
            assert_eq!(ours.state.t.to_bits(), theirs.state.t.to_bits());
            assert_eq!(ours.impact, theirs.impact);
        }
        let bits = |state: &[f64]| state.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
        let system = compiled.prepare();
        let q = system.to_vector(&found.end().q);
        assert_eq!(bits(q.as_slice()), bits(&expected.end().q.values), "{name}");
    }
    check(
        &lagrangian_machines::BowlingBall::default(),
        "bowling_ball",
        3.0,
    );
    check(&lagrangian_machines::CueBall::default(), "cue_ball", 1.0);
    check(
        &lagrangian_machines::CollidingCrusher::default(),
        "colliding_crusher",
        0.3,
    );
}

/// Two square plates lie on each other on a slope. Their corners can share the load in many ways; the reported forces must be one that every
/// corner permits, and together they must carry the weight.
#[test]
fn forces_that_may_be_shared_in_several_ways_are_ones_that_contacts_allow() {
    const FRICTION: f64 = 0.5;
    let corners =
        "corners: ((-0.5, -0.5, -0.01), (0.5, -0.5, -0.01), (0.5, 0.5, -0.01), (-0.5, 0.5, -0.01))";
    let law = format!("restitution: 0, friction: {FRICTION}");
    let machine = InterpretedMachine::from_text(format!(
        "machine Plates in space {{
            constants {{ N = 2 }}
            coordinates {{
                x[i in 1..N]: m, y[i in 1..N]: m, z[i in 1..N]: m = (2*i - 1)/100, a[i in 1..N]: rad, b[i in 1..N]: rad, c[i in 1..N]: rad,
            }}
            frames {{ held[i in 1..N] = ground.shift(x[i], y[i], z[i]).turn(x, a[i]).turn(y, b[i]).turn(z, c[i]), top = held[1].shift(0, 0, 0.01) }}
            bodies {{ plate[i in 1..N] {{ mass: 1, inertia: (1.0004/12, 1.0004/12, 1/6), frame: held[i] }} }}
            gravity (0.8, 0.6, -9.81);
            contacts {{ floor {{ {corners}, on: held[1], along: ground, {law} }}, seat {{ {corners}, on: held[2], along: top, {law} }} }}
        }}"
    ));
    let machine = machine.build().unwrap_or_else(|error| panic!("{error}"));
    let (system, start) = (machine.prepare(), machine.start());
    let (q, v) = (&start.q.values, &start.v.values);
    let mut a = vec![0.0; q.len()];
    let inputs = system.default_inputs();
    let forces = unilateral_forces(
        &system,
        At {
            t: 0.0,
            q,
            v,
            u: &inputs,
        },
        &mut a,
    )
    .expect("forces");
    // The accuracy to which the contact problem is solved, relative to the weight.
    let rounding = 1e-10 * 2.0 * 9.81;
    assert!(a.iter().all(|a| a.abs() < rounding), "{a:?}");
    let mut carried = [[0.0; 3]; 2];
    for (k, pair) in forces.chunks(2).enumerate() {
        let [first, across] = [pair[0], pair[1]];
        assert!(first.normal > -rounding, "{first:?}");
        let friction = first.friction.hypot(across.friction);
        assert!(
            friction < FRICTION * first.normal + rounding,
            "{first:?} {across:?}"
        );
        let sum = &mut carried[k / 4];
        for (sum, part) in sum
            .iter_mut()
            .zip([first.friction, across.friction, first.normal])
        {
            *sum += part;
        }
    }
    for (sum, plates) in carried.iter().zip([2.0, 1.0]) {
        for (sum, pull) in sum.iter().zip([-0.8, -0.6, 9.81]) {
            assert!((sum - plates * pull).abs() < 8.0 * rounding, "{carried:?}");
        }
    }
}

/// A flat box whose coordinates are all exactly 0 where it meets the floor, by impacts of one corner after the other: it comes to rest there, and not in ever smaller
/// impacts between coordinates that know no length.
#[test]
fn a_box_at_the_origin_comes_to_rest() {
    for (falling, turning) in [(-1.0, 0.0), (-1.0, 0.7), (0.0, 0.7)] {
        let machine = InterpretedMachine::from_text(format!(
            "machine Box in plane {{
                coordinates {{ x: m, y: m, theta: rad, der(y): m/s = {falling}, der(theta): rad/s = {turning} }}
                frames {{ held = ground.shift(x, y).turn(theta) }}
                bodies {{ box {{ mass: 1, inertia: 1/12, frame: held }} }}
                gravity (0, -9.81);
                contacts {{ floor {{ corners: ((-0.5, 0), (0.5, 0)), on: held, along: ground, restitution: 0.5, friction: 0.3, order: sequence }} }}
            }}"
        ));
        let machine = machine.build().unwrap_or_else(|error| panic!("{error}"));
        let run = run(&machine, 0.5);
        is_booked(&run);
        let end = run.end();
        for name in ["y", "theta"] {
            let place = [&end.q, &end.v].map(|of| of.get(name).expect("a coordinate"));
            // What contacts allow for closed gaps and for rest: 1e-12 of lengths of 0.5 m, and of rates of at most 1.4 m/s.
            assert!(place.iter().all(|x| x.abs() < 3e-12), "{name}: {place:?}");
        }
        let balance = run.energy_balance().expect("a balance");
        let at_start = 0.5 * (falling * falling + turning * turning / 12.0);
        assert!((balance.dissipated - at_start).abs() < 1e-9, "{balance:?}");
    }
}
