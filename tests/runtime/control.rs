//! Controllers, sampled ones in one run and loops around a stepper, against recursions worked out by hand.

use std::sync::atomic::{AtomicU32, Ordering};

use crate::by_hand::double_pendulum::DoublePendulum;
use crate::by_hand::toy::{Toy, ball, oscillator};
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{
    Crossing, DefaultInputs, Ending, Error, METHODS, Machine, Method, NoBalance, Simulation,
    StepError, Stepper, System, Tolerance,
};
use lagrangian_machines::CartPole;

/// A mass of 1 kg pushed by a force.
fn mass() -> Toy<1> {
    Toy {
        work_rate: |_, _, v, u, _| u * v[0],
        ..Toy::new(([0.7], [-0.4]), |_, _, _, u, _| [u])
    }
}

/// Position and velocity of that mass at time `t`, and the force then. A controller computes `u = −k x − d v` every `period`
/// seconds, to take effect `delay` seconds later, so the force is constant between two changes.
fn by_recursion([k, d]: [f64; 2], [period, delay]: [f64; 2], t: f64) -> ([f64; 2], f64) {
    let [mut x, mut v, mut u, mut now] = [0.7, -0.4, 0.0, 0.0];
    let mut set: Vec<(f64, f64)> = Vec::new();
    let (mut looks, mut acted) = (0, 0);
    loop {
        let look = f64::from(looks) * period;
        let act = set.get(acted).map_or(f64::INFINITY, |(at, _)| *at);
        let next = look.min(act).min(t);
        let h = next - now;
        (x, v, now) = (x + v * h + u * h * h / 2.0, v + u * h, next);
        // Instants that differ only by rounding count as the same. A sample comes before the input that it sets.
        if look <= next + 1e-12 && look < t {
            set.push((look + delay, -k * x - d * v));
            looks += 1;
        } else if act <= next + 1e-12 && act < t {
            u = set[acted].1;
            acted += 1;
        } else {
            return ([x, v], u);
        }
    }
}

#[test]
fn a_sampled_controller_is_its_recursion() {
    let mass = mass();
    for delay in [0.0, 0.05, 0.1, 0.17] {
        let settings = ([3.0, 2.5], [0.1, delay]);
        for method in &METHODS {
            let run = Simulation::new(&mass)
                .method(method)
                .tolerance(1e-10)
                .until(1.98)
                .energy_balance(true)
                .sampled_with_delay(0.1, delay, |state, u| {
                    *u = -3.0 * state.q[0] - 2.5 * state.v[0]
                })
                .run(mass.start())
                .unwrap();
            // The test looks between the ends of steps as well: the motion is quadratic in time, for
            // which every method is exact.
            for t in [0.03, 0.1, 0.449, 1.0, 1.333, 1.98] {
                let ([x, v], u) = by_recursion(settings.0, settings.1, t);
                let state = run.at(t).unwrap();
                let off = (state.q[0] - x).abs().max((state.v[0] - v).abs());
                assert!(off < 1e-12, "{} {delay} {t}: {off:e}", method.tableau.name);
                // At an instant of change the run reports the inputs after it.
                let at_change = ((t - delay) / 0.1 - ((t - delay) / 0.1).round()).abs() < 1e-9;
                if !at_change {
                    assert!((run.observe(t).unwrap().inputs - u).abs() < 1e-12);
                }
            }
            let balance = run.energy_balance().unwrap();
            assert!(balance.residual().abs() < 1e-12 && balance.work < -0.05);
            assert_eq!(run.warnings(), []);
        }
    }
}

/// The same controller, once sampled in one run, once with a run that ends at each sample and another that continues.
#[test]
fn one_sampled_run_is_as_many_runs() {
    let machine = CartPole::default();
    let law = |theta: f64, rate: f64, x: f64, v: f64| 40.0 * theta + 8.0 * rate + 1.5 * x + 3.0 * v;
    let looks = AtomicU32::new(0);
    let run = Simulation::new(&machine)
        .tolerance(1e-11)
        .until(1.0)
        .energy_balance(true)
        .sampled(0.02, |state, u| {
            looks.fetch_add(1, Ordering::Relaxed);
            u.push = law(state.q.theta, state.v.theta, state.q.x, state.v.x);
        })
        .run(machine.start())
        .unwrap();
    assert_eq!(looks.into_inner(), 50);
    let mut state = machine.start();
    for tick in 1..=50 {
        let push = law(state.q.theta, state.v.theta, state.q.x, state.v.x);
        let next = Simulation::new(&machine)
            .tolerance(1e-11)
            .until(f64::from(tick) * 0.02);
        state = *next
            .inputs(move |_, _, _, u| u.push = push)
            .run(state)
            .unwrap()
            .end();
    }
    // Errors of one tolerance each in about a hundred steps of a stabilized motion.
    assert!((run.end().q.theta - state.q.theta).abs() < 1e-8);
    assert!((run.end().v.x - state.v.x).abs() < 1e-8);
    assert_eq!(run.warnings(), []);
    // Energies between steps are those of the states there.
    let t = 0.533;
    let energies = run.energies_at_each([t]).unwrap()[0];
    let seen = run.observe(t).unwrap();
    assert!((energies.kinetic - seen.kinetic_energy).abs() < 1e-12);
    let start = run.energies()[0];
    assert!(energies.residual_since(&start).abs() < 1e-8);
}

#[test]
fn what_sticks_breaks_away_when_a_sample_pushes() {
    let text = "machine Block in plane {
        parameters { m: kg = 2, mu: 1 = 0.25, g: m/s^2 = 10 }
        coordinates { s: m }
        inputs { push: N }
        frames { seat = ground.shift(s, 0) }
        bodies { block { mass: m, frame: seat } }
        gravity (0, -g);
        forces { hand { on: s, value: push } }
        sliding { face { body: block, on: ground, direction: ground.vector(1, 0), friction: mu, static_friction: 2*mu } }
    }";
    let block = InterpretedMachine::from_text(text).build().unwrap();
    // It sticks up to 10 N and slides against 5 N: pushed with 9 N it stays, with 13 N it slides with 4 m/s².
    let run = Simulation::new(&block)
        .until(1.0)
        .energy_balance(true)
        .sampled(0.25, |state, u| {
            let push = if state.t < 0.4 { 9.0 } else { 13.0 };
            u.set("push", push).unwrap();
        })
        .run(block.start())
        .unwrap();
    assert!(run.at(0.45).unwrap().q.values[0].abs() < 1e-12);
    for t in [0.6, 0.9, 1.0_f64] {
        let exact = 0.5 * 4.0 * (t - 0.5) * (t - 0.5);
        let found = run.at(t).unwrap().q.values[0];
        assert!((found - exact).abs() < 1e-9, "{t}: {found} {exact}");
        assert!(!run.observe(t).unwrap().contacts.is_empty());
    }
    assert_eq!(run.event_count("face slides"), 1);
    assert!(run.energy_balance().unwrap().residual().abs() < 1e-9);
}

#[test]
fn what_is_closed_opens_when_a_sample_lifts() {
    let text = "machine Lifted in plane {
        parameters { m: kg = 2, g: m/s^2 = 10 }
        coordinates { y: m }
        inputs { lift: N }
        bodies { block { mass: m, at: (0, y) } }
        gravity (0, -g);
        forces { rope { on: y, value: lift } }
        contacts { floor { gap: y, restitution: 0.5 } }
    }";
    let block = InterpretedMachine::from_text(text).build().unwrap();
    let run = Simulation::new(&block)
        .until(1.0)
        .sampled(0.5, |state, u| {
            u.set("lift", if state.t < 0.4 { 15.0 } else { 25.0 })
                .unwrap();
        })
        .run(block.start())
        .unwrap();
    // A pull of 15 N leaves 5 N of its weight on the floor; 25 N lift it at 2.5 m/s².
    let seen = run.observe(0.3).unwrap().unilateral;
    assert!((seen[0].normal - 5.0).abs() < 1e-9, "{seen:?}");
    assert!((run.end().q.values[0] - 0.5 * 2.5 * 0.25).abs() < 1e-9);
    assert_eq!(run.closed_contacts(0.4), [true]);
    assert_eq!(run.closed_contacts(0.9), [false]);
}

#[test]
fn settings_of_samples_are_checked() {
    let mass = mass();
    let with = |period: f64, delay: f64, until: f64| {
        let run = Simulation::new(&mass)
            .until(until)
            .sampled_with_delay(period, delay, |_, _| ());
        run.run(mass.start()).map(|_| ())
    };
    assert_eq!(with(0.1, 0.0, 1.0), Ok(()));
    for wrong in [
        with(0.0, 0.0, 1.0),
        with(-1.0, 0.0, 1.0),
        with(f64::NAN, 0.0, 1.0),
        with(1e-300, 0.0, 1.0),
        with(0.1, -1.0, 1.0),
        with(0.1, f64::INFINITY, 1.0),
        with(0.1, 0.0, -1.0),
    ] {
        assert!(
            matches!(wrong, Err(Error::InvalidSetting { .. })),
            "{wrong:?}"
        );
    }
    let both = Simulation::new(&mass)
        .until(1.0)
        .inputs(|_, _, _, u| *u = 1.0);
    let both = both.sampled(0.1, |_, _| ()).run(mass.start()).map(|_| ());
    assert!(
        matches!(
            both,
            Err(Error::InvalidSetting {
                setting: "sampled",
                ..
            })
        ),
        "{both:?}"
    );
    let error = Simulation::new(&mass)
        .until(1.0)
        .observe(-1.0, |_| ())
        .run(mass.start());
    assert!(matches!(
        error.map(|_| ()),
        Err(Error::InvalidSetting {
            setting: "observe",
            ..
        })
    ));
    // A value that is not finite is reported from a controller as from an input function.
    let wrong = Simulation::new(&mass)
        .until(1.0)
        .sampled(0.1, |_, u| *u = f64::NAN);
    let wrong = wrong.run(mass.start()).map(|_| ());
    assert!(
        matches!(wrong, Err(Error::InputNotFinite { t: 0.0, .. })),
        "{wrong:?}"
    );
}

#[test]
fn an_owned_system_is_stepped_to_the_same_bits() {
    let machine = DoublePendulum::default();
    let system = machine.prepare();
    let start = machine.start();
    for method in [Method::DOP853, Method::DOPRI5, Method::BS32, Method::RADAU5] {
        let tolerance = Tolerance {
            relative: 1e-8,
            absolute: [1e-8; 2],
        };
        let at = (0.0, system.to_vector(&start.q), system.to_vector(&start.v));
        let mut borrowed = Stepper::new(
            &system,
            DefaultInputs,
            NoBalance,
            method,
            tolerance,
            at,
            3.0,
        )
        .unwrap();
        while !borrowed.is_done() {
            borrowed.step().unwrap();
        }
        let owned = Stepper::builder(machine.prepare())
            .method(method)
            .tolerance(1e-8);
        let mut owned = owned.start(start).unwrap();
        owned.advance_to(3.0).unwrap();
        assert_eq!((owned.q(), owned.v()), (borrowed.q(), borrowed.v()));
        assert_eq!(owned.work(), borrowed.work());
    }
}

#[test]
fn within_the_last_step_the_state_is_known() {
    let oscillator = oscillator();
    let mut stepper = Stepper::builder(oscillator)
        .tolerance(1e-12)
        .start(oscillator.start())
        .unwrap();
    stepper.advance_to(1.0).unwrap();
    let (from, to) = (stepper.t_before(), stepper.t());
    assert!(from < to && to == 1.0);
    for theta in [0.0, 0.3, 0.9, 1.0] {
        let t = from + theta * (to - from);
        let state = stepper.state_at(t).unwrap();
        assert!((state.q[0] - t.cos()).abs() < 1e-9 && (state.v[0] + t.sin()).abs() < 1e-9);
    }
    let outside = stepper.state_at(1.1).unwrap_err();
    assert!(matches!(outside, StepError::OutsideStep { to: 1.0, .. }));
    for t in [f64::NAN, f64::INFINITY] {
        assert!(matches!(
            stepper.advance_to(t),
            Err(StepError::NoTime { .. })
        ));
    }
    assert_eq!(stepper.t(), 1.0);
    // Backward again.
    stepper.advance_to(0.0).unwrap();
    assert!((stepper.q()[0] - 1.0).abs() < 1e-9);
}

#[test]
fn an_event_may_be_on_what_is_observed() {
    // Released at the bottom with v² = 4 g l, a bob swings up until the rod no longer pulls, at cos θ = −2/3.
    let text = "machine Bob in plane {
        parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 10 }
        coordinates { x: m, y: m = -l, der(x): m/s = sqrt(4*g*l) }
        bodies { bob { mass: m, at: (x, y) } }
        gravity (0, -g);
        constraints { rod: (x^2 + y^2 - l^2)/(2*l) = 0 }
        outputs { pull: N = m*(der(x)^2 + der(y)^2)/l - m*g*y/l }
    }";
    let bob = InterpretedMachine::from_text(text).build().unwrap();
    for output in [false, true] {
        let run = Simulation::new(&bob)
            .tolerance(1e-11)
            .until(2.0)
            .until_event_on("slack", Crossing::Any, |seen| {
                if output {
                    seen.outputs.get("pull").unwrap()
                } else {
                    // The multiplier is the compressive force in the rod.
                    seen.multipliers[0]
                }
            })
            .run(bob.start())
            .unwrap();
        assert_eq!(*run.ending(), Ending::Event("slack".into()));
        let height = run.end().q.get("y").unwrap();
        assert!((height - 0.5 * 2.0 / 3.0).abs() < 1e-9, "{height}");
    }
}

#[test]
fn events_are_counted_and_the_nth_ends_the_run() {
    let oscillator = oscillator();
    let run = Simulation::new(&oscillator)
        .tolerance(1e-12)
        .until(100.0)
        .event("up", Crossing::Rising, |state| state.q[0])
        .until_nth_event(5, "through", Crossing::Any, |state| state.q[0])
        .run(oscillator.start())
        .unwrap();
    // cos t is 0 at (n − 1/2) π, and rises at every second zero.
    assert_eq!((run.event_count("through"), run.event_count("up")), (5, 2));
    assert!((run.end().t - 4.5 * std::f64::consts::PI).abs() < 1e-9);
    assert_eq!(*run.ending(), Ending::Event("through".into()));
}

#[test]
fn observers_see_what_samples_keep() {
    let ball = ball();
    for until in [0.5, 0.47, -0.3] {
        let (mut seen, mut rarely) = (Vec::new(), 0);
        let run = Simulation::new(&ball)
            .until(until)
            .every(0.125)
            .observe(0.125, |state| seen.push(*state))
            .observe(0.3, |_| rarely += 1)
            .run(ball.start())
            .unwrap();
        assert_eq!(run.samples(), seen);
        assert_eq!(rarely, if until > 0.0 { 3 } else { 2 });
    }
    // An end that has already been observed is not observed again.
    let mut times = Vec::new();
    let run = Simulation::new(&ball)
        .until(1.0)
        .observe(0.5, |state| times.push(state.t))
        .until_event("half", Crossing::Rising, |state| state.t - 0.5)
        .run(ball.start())
        .unwrap();
    assert_eq!((times, run.end().t), (vec![0.0, 0.5], 0.5));
}

#[test]
fn the_first_look_is_no_event_and_later_ones_may_be() {
    // The acceleration is −1 from the first sample on, and +1 from 0.5 s on.
    let mass = mass();
    let run = Simulation::new(&mass)
        .until(1.0)
        .sampled(0.5, |state, u| *u = if state.t < 0.4 { -1.0 } else { 1.0 })
        .event_on("pushed", Crossing::Any, |seen| seen.a[0] + 0.25)
        .run(mass.start())
        .unwrap();
    let times: Vec<f64> = run.events().iter().map(|event| event.state.t).collect();
    assert_eq!(times, [0.5]);
    assert_eq!(run.events()[0].crossing, Crossing::Rising);
}
