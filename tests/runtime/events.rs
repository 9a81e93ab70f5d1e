//! Events are found at the right time and in order, and end a run where they should.

use crate::by_hand::toy::{Toy, ball, oscillator};
use lagrangian::{
    Crossing, Ending, Error, METHODS, Method, RADAU_OF_HIGH_ORDER, Simulation, State,
};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A falling ball may travel 490 m in one step of 10 s; this bounds the round-off of its positions.
const ROUNDOFF_OF_FALL: f64 = 16.0 * f64::EPSILON * 490.0;

#[test]
fn a_ball_touches_the_ground_on_time_by_every_method() {
    // h = g t² / 2; every method is exact for a polynomial of degree 2.
    let fall_time = (2.0 * 2.0 / 9.81_f64).sqrt();
    for method in &METHODS {
        let ball = ball();
        let run = Simulation::new(&ball)
            .method(method)
            .until(10.0)
            .until_event("ground", Crossing::Falling, |state| state.q[0])
            .run(ball.start())
            .unwrap();
        assert_eq!(*run.ending(), Ending::Event("ground".into()));
        let [event] = run.events() else {
            panic!("{:?}", run.events())
        };
        assert_eq!(event.crossing, Crossing::Falling);
        // The ball passes at 6 m/s.
        assert!((event.state.t - fall_time).abs() <= ROUNDOFF_OF_FALL / 6.0);
        assert_eq!(run.end().t, event.state.t);
        assert!(run.end().q[0].abs() <= ROUNDOFF_OF_FALL);
        assert!((run.end().v[0] + 9.81 * fall_time).abs() <= ROUNDOFF_OF_FALL);
    }
}

#[test]
fn a_ball_bounces_from_run_to_run() {
    // Each run starts on the ground: leaving it is no event, returning to it is.
    let ball = ball();
    let mut state = ball.start();
    let fall_time = (2.0 * 2.0 / 9.81_f64).sqrt();
    for bounce in 0..5 {
        let run = Simulation::new(&ball)
            .until(state.t + 10.0)
            .until_event("ground", Crossing::Falling, |state| state.q[0])
            .run(state)
            .unwrap();
        let exact = fall_time * f64::from(1 + 2 * bounce);
        assert!(
            (run.end().t - exact).abs() <= 20.0 * ROUNDOFF_OF_FALL,
            "{bounce}"
        );
        state = State {
            q: [0.0],
            v: [-run.end().v[0]],
            ..*run.end()
        };
    }
}

#[test]
fn crossings_are_told_apart_and_come_in_order() {
    // x = cos t: x falls through 0 at π/2, rises at 3π/2; v = −sin t falls at 2π, rises at π.
    for method in &METHODS {
        let oscillator = oscillator();
        let run = Simulation::new(&oscillator)
            .method(method)
            .tolerance(1e-9)
            .until(10.0)
            .event("x falls", Crossing::Falling, |state| state.q[0])
            .event("x rises", Crossing::Rising, |state| state.q[0])
            .event("any turn", Crossing::Any, |state| state.v[0])
            .run(oscillator.start())
            .unwrap();
        let expected = [
            ("x falls", FRAC_PI_2),
            ("any turn", PI),
            ("x rises", 3.0 * FRAC_PI_2),
            ("any turn", 2.0 * PI),
            ("x falls", 5.0 * FRAC_PI_2),
            ("any turn", 3.0 * PI),
        ];
        assert_eq!(
            run.events().len(),
            expected.len(),
            "{}",
            method.tableau.name
        );
        // At a rate of 1, errors of state and time are equal; dense output errs by as much as a few steps.
        let limit = (run.statistics().steps as f64 + 10.0) * 1e-9;
        for (event, (name, t)) in run.events().iter().zip(expected) {
            assert_eq!(event.name, name);
            assert!(
                (event.state.t - t).abs() <= limit,
                "{name}: {:e}",
                event.state.t - t
            );
        }
        assert_eq!(run.events()[1].crossing, Crossing::Rising);
        assert_eq!(run.events()[3].crossing, Crossing::Falling);
    }
}

#[test]
fn many_events_of_one_step_are_all_found_in_order() {
    // Free fall takes few, long steps; several heights 3 m apart are passed within one.
    let ball = Toy {
        start: ([100.0], [0.0]),
        ..ball()
    };
    let mut simulation = Simulation::new(&ball).until(4.5);
    for height in (1..=33).map(|i| 3.0 * f64::from(i)) {
        simulation = simulation.event("height", Crossing::Any, move |state| state.q[0] - height);
    }
    let run = simulation.run(ball.start()).unwrap();
    assert!(run.statistics().steps < 10);
    assert_eq!(run.events().len(), 33);
    for (i, event) in run.events().iter().enumerate() {
        let height = 99.0 - 3.0 * i as f64;
        let t = (2.0 * (100.0 - height) / 9.81).sqrt();
        // The ball passes the first height at 4.4 m/s.
        assert!(
            (event.state.t - t).abs() <= ROUNDOFF_OF_FALL / 4.0,
            "{height}"
        );
        assert_eq!(event.crossing, Crossing::Falling);
    }
}

#[test]
fn the_first_of_two_ends_ends_the_run() {
    let ball = ball();
    let run = Simulation::new(&ball)
        .until(10.0)
        .until_event("low", Crossing::Falling, |state| state.q[0] - 0.5)
        .until_event("half", Crossing::Falling, |state| state.q[0] - 1.0)
        .event("high", Crossing::Falling, |state| state.q[0] - 1.5)
        .run(ball.start())
        .unwrap();
    let names: Vec<_> = run
        .events()
        .iter()
        .map(|event| event.name.as_str())
        .collect();
    assert_eq!(names, ["high", "half"]);
    assert_eq!(*run.ending(), Ending::Event("half".into()));
    assert!((run.end().q[0] - 1.0).abs() <= ROUNDOFF_OF_FALL);
    assert!(matches!(
        run.at(run.end().t + 1e-6),
        Err(Error::OutsideRun { .. })
    ));
    // The steps that are kept end where the run ends.
    assert_eq!(run.steps().last().unwrap(), *run.end());
}

#[test]
fn backward_in_time_crossings_keep_their_names() {
    // Backward from t = 0: x = cos t is 0 at −π/2, where it rises with t.
    let oscillator = oscillator();
    let run = Simulation::new(&oscillator)
        .tolerance(1e-10)
        .until(-2.0)
        .event("x", Crossing::Rising, |state| state.q[0])
        .event("never", Crossing::Falling, |state| state.q[0])
        .run(oscillator.start())
        .unwrap();
    let [event] = run.events() else {
        panic!("{:?}", run.events())
    };
    assert_eq!(
        (event.name.as_str(), event.crossing),
        ("x", Crossing::Rising)
    );
    assert!((event.state.t + FRAC_PI_2).abs() < 1e-8);
}

#[test]
fn a_function_that_is_zero_at_the_start_is_no_event_there() {
    // v = −sin t is 0 at the start and then falls; its next zero is at π.
    let oscillator = oscillator();
    let run = Simulation::new(&oscillator)
        .until(4.0)
        .event("turn", Crossing::Any, |state| state.v[0])
        .run(oscillator.start())
        .unwrap();
    let [event] = run.events() else {
        panic!("{:?}", run.events())
    };
    assert!((event.state.t - PI).abs() < 1e-7);
}

#[test]
fn a_function_that_is_zero_throughout_is_no_event() {
    let oscillator = oscillator();
    let run = Simulation::new(&oscillator)
        .until(4.0)
        .until_event("nothing", Crossing::Any, |_| 0.0)
        .run(oscillator.start())
        .unwrap();
    assert!(run.events().is_empty());
    assert_eq!(*run.ending(), Ending::End);
}

#[test]
fn a_jump_of_the_function_is_an_event_at_the_jump() {
    let ball = ball();
    let run = Simulation::new(&ball)
        .until(3.0)
        .event("tick", Crossing::Rising, |state| {
            if state.t < 1.25 { -1.0 } else { 1.0 }
        })
        .run(ball.start())
        .unwrap();
    let [event] = run.events() else {
        panic!("{:?}", run.events())
    };
    assert!((event.state.t - 1.25).abs() <= 4.0 * f64::EPSILON);
}

#[test]
fn an_event_function_that_is_not_a_number_is_named() {
    let ball = ball();
    let error = Simulation::new(&ball)
        .until(3.0)
        .event("root", Crossing::Any, |state| state.q[0].sqrt())
        .run(ball.start())
        .unwrap_err();
    assert!(
        matches!(&error, Error::EventNotFinite { event, .. } if event == "root"),
        "{error}"
    );
}

/// Round-off as of large numbers: it is constant in the first part of the finest division of a step from 0 to 1, from which nothing follows for the others.
fn round_off(t: f64) -> f64 {
    if t < 1e-4 {
        return 0.5;
    }
    let hash = t.to_bits().wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (hash >> 62) as f64 - 1.5
}

#[test]
fn an_event_function_that_is_round_off_is_named_after_a_budget_of_values() {
    let ball = ball();
    let values = AtomicUsize::new(0);
    let error = Simulation::new(&ball)
        .first_step(1.0)
        .until(1.0)
        .event("far", Crossing::Any, |state| {
            values.fetch_add(1, Ordering::Relaxed);
            round_off(state.t)
        })
        .run(ball.start())
        .unwrap_err();
    // As many as interpolants of degree 64 take in 2^14 parts, with two values in each that test slopes, and 65 for each length of parts.
    const MOST: usize = (1 << 14) * 67 + 14 * 65;
    assert!(
        matches!(&error, Error::ZerosNotIsolated { watched, t: 0.0, values: MOST } if watched == "far"),
        "{error}"
    );
    // Eight more decide whether to search, some are asked to know its sign at the start.
    assert!(values.into_inner() < MOST + 100);
}

#[test]
fn a_run_is_stopped_during_a_long_search_for_events() {
    let ball = ball();
    let values = AtomicUsize::new(0);
    let run = Simulation::new(&ball)
        .first_step(1.0)
        .until(1.0)
        .event("far", Crossing::Any, |state| {
            values.fetch_add(1, Ordering::Relaxed);
            round_off(state.t)
        })
        .stop_if(|_| values.load(Ordering::Relaxed) > 100_000)
        .run(ball.start())
        .unwrap();
    assert_eq!(*run.ending(), Ending::Stopped);
    assert!(run.events().is_empty());
    // It ends where the step began, of which nothing is known.
    let start = ball.start();
    assert_eq!(
        (run.end().t, run.end().q, run.end().v),
        (start.t, start.q, start.v)
    );
    assert!(values.load(Ordering::Relaxed) < 100_000 + 4096 + 100);
}

#[test]
fn a_condition_stops_a_run_after_a_step() {
    let ball = ball();
    let run = Simulation::new(&ball)
        .longest_step(0.1)
        .until(10.0)
        .stop_if(|state| state.q[0] < 0.0)
        .run(ball.start())
        .unwrap();
    assert_eq!(*run.ending(), Ending::Stopped);
    let states: Vec<_> = run.steps().collect();
    assert!(states[states.len() - 1].q[0] < 0.0 && states[states.len() - 2].q[0] >= 0.0);
}

#[test]
fn the_end_of_a_run_is_the_state_of_its_event() {
    // x = cos t equals c at arccos c. The event function is 0 up to rounding of its terms and of time, at the rate sin t; and the end of the run is as
    // accurate as any other step.
    for method in &METHODS {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            for level in [-0.9, -0.31, 0.0, 0.2, 0.77] {
                let oscillator = oscillator();
                let run = Simulation::new(&oscillator)
                    .method(method)
                    .tolerance(tolerance)
                    .until(10.0)
                    .until_event("level", Crossing::Any, |state| state.q[0] - level)
                    .run(oscillator.start())
                    .unwrap();
                let name = method.tableau.name;
                let [event] = run.events() else {
                    panic!("{name}: {:?}", run.events())
                };
                assert_eq!(event.state, *run.end(), "{name}");
                let left = (run.end().q[0] - level).abs();
                assert!(left <= 8.0 * f64::EPSILON, "{name} {level}: {left:e}");
                let limit = (run.statistics().steps as f64 + 1.0) * 10.0 * tolerance;
                let late = run.end().t - level.acos();
                assert!(late.abs() <= limit, "{name} {level}: {late:e}");
            }
        }
    }
}

/// Continues from event to event, from each end with a new run or by resuming.
fn passages(level: f64, count: usize, resumes: bool) -> Vec<(f64, Crossing)> {
    let oscillator = oscillator();
    let mut found = Vec::new();
    let mut last: Option<lagrangian::Solution<Toy<1>>> = None;
    while found.len() < count {
        let start = last.as_ref().map_or(oscillator.start(), |run| *run.end());
        let simulation = match &last {
            Some(run) if resumes => run.resume(),
            _ => Simulation::new(&oscillator).tolerance(1e-10).until(1e4),
        };
        let run = simulation
            .until_event("level", Crossing::Any, |state| state.q[0] - level)
            .run(start)
            .unwrap();
        let [event] = run.events() else {
            panic!("{level}: {:?}", run.events())
        };
        assert!(run.end().t > start.t, "{level}: stuck at {} s", start.t);
        found.push((event.state.t, event.crossing));
        last = Some(run);
    }
    found
}

#[test]
fn runs_that_go_on_from_events_find_each_of_them_once() {
    // x = cos t passes c at ±arccos c + 2πk, falling and rising in turn. That makes 400 runs each way.
    for resumes in [false, true] {
        for i in 0..20 {
            let level = -0.95 + 0.1 * f64::from(i);
            let found = passages(level, 20, resumes);
            for (k, (t, crossing)) in found.iter().enumerate() {
                let turns = 2.0 * PI * k.div_ceil(2) as f64;
                let exact = match k % 2 {
                    0 => level.acos() + turns,
                    _ => turns - level.acos(),
                };
                // Local errors of about 20 steps per period, at a rate of at least 0.3.
                let limit = 1e-10 * (20.0 * exact + 20.0) / 0.3;
                assert!((t - exact).abs() <= limit, "{level} {k}: {:e}", t - exact);
                let expected = [Crossing::Falling, Crossing::Rising][k % 2];
                assert_eq!(*crossing, expected, "{level} {k}");
            }
        }
    }
}

#[test]
fn a_start_beside_a_zero_by_rounding_is_no_event() {
    // The start of a run may differ from the end of the one before by rounding: on either side of the zero, moving either way.
    let ball = ball();
    for side in [-1.0, 1.0] {
        for (v, t_back) in [(6.0, Some(2.0 * 6.0 / 9.81)), (-6.0, None)] {
            let start = State {
                t: 5.0,
                q: [side * 4.0 * f64::EPSILON],
                v: [v],
            };
            let run = Simulation::new(&ball)
                .until(8.0)
                .until_event("ground", Crossing::Any, |state| state.q[0])
                .run(start)
                .unwrap();
            match t_back {
                Some(t_back) => {
                    let late = run.end().t - 5.0 - t_back;
                    assert!(late.abs() <= 16.0 * f64::EPSILON * 8.0, "{side}: {late:e}");
                }
                None => assert_eq!(*run.ending(), Ending::End, "{side}"),
            }
        }
    }
}

#[test]
fn a_start_that_is_not_at_a_zero_finds_the_one_close_ahead() {
    // 10⁻¹⁰ m above the ground at 6 m/s: far above rounding, far below a step.
    let ball = ball();
    let start = State {
        t: 5.0,
        q: [1e-10],
        v: [-6.0],
    };
    let run = Simulation::new(&ball)
        .until(8.0)
        .until_event("ground", Crossing::Any, |state| state.q[0])
        .run(start)
        .unwrap();
    assert_eq!(*run.ending(), Ending::Event("ground".into()));
    assert!((run.end().t - 5.0 - 1e-10 / 6.0).abs() <= 8.0 * f64::EPSILON * 5.0);
}

#[test]
fn a_flight_much_shorter_than_a_step_is_found() {
    // In a run whose steps may be 10 s long: flights of duration 2v/g, from 1 s down to about a thousand rounding units of time.
    let ball = ball();
    for exponent in 0..12 {
        let flight = 0.1_f64.powi(exponent);
        let run = Simulation::new(&ball)
            .first_step(10.0)
            .until(10.0)
            .until_event("ground", Crossing::Falling, |state| state.q[0])
            .run(State {
                t: 0.0,
                q: [0.0],
                v: [0.5 * 9.81 * flight],
            })
            .unwrap();
        assert_eq!(*run.ending(), Ending::Event("ground".into()), "{flight:e}");
        let late = run.end().t - flight;
        assert!(
            late.abs() <= 16.0 * f64::EPSILON * flight.max(0.1),
            "{flight:e}: {late:e}"
        );
    }
}

#[test]
fn a_ball_bounces_a_hundred_thousand_times() {
    // v ← −e v at each bounce. A flight takes 2v/g, and each is shorter than the previous one by the factor e.
    let (restitution, count) = (0.9999_f64, 100_000);
    let ball = Toy {
        start: ([2e-4], [0.0]),
        ..ball()
    };
    let floor = |state: &State<[f64; 1]>| state.q[0];
    let fall = (2.0 * 2e-4 / 9.81_f64).sqrt();
    let mut exact = fall;
    let mut run = Simulation::new(&ball)
        .until(1e3)
        .until_event("floor", Crossing::Falling, floor)
        .run(ball.start())
        .unwrap();
    let mut share = 1.0;
    for bounce in 0..count {
        assert_eq!(*run.ending(), Ending::Event("floor".into()), "{bounce}");
        // Each impact time has an error of a few rounding units ε t, which causes an error of 4 ε t g in speed and of 8 ε t in each later flight.
        let bounces = f64::from(bounce);
        let limit = f64::EPSILON * exact * (4.0 + 8.0 * bounces + 4.0 * bounces * bounces);
        let late = run.end().t - exact;
        assert!(late.abs() <= limit, "{bounce}: {late:e}");
        let mut start = *run.end();
        start.v[0] *= -restitution;
        share *= restitution;
        exact += 2.0 * fall * share;
        run = run
            .resume()
            .until_event("floor", Crossing::Falling, floor)
            .run(start)
            .unwrap();
    }
}

#[test]
fn bounces_that_come_to_an_end_do_not_hold_a_run_up() {
    // Each bounce halves the speed, so all bounces are over after 3 times the time of the fall.
    let ball = ball();
    let floor = |state: &State<[f64; 1]>| state.q[0];
    let fall = (2.0 * 2.0 / 9.81_f64).sqrt();
    let mut run = Simulation::new(&ball)
        .until(5.0)
        .until_event("floor", Crossing::Falling, floor)
        .run(ball.start())
        .unwrap();
    let (mut exact, mut share, mut bounces) = (fall, 1.0, 0);
    while *run.ending() != Ending::End {
        assert!((run.end().t - exact).abs() <= 64.0 * f64::EPSILON * 5.0);
        let mut start = *run.end();
        start.v[0] *= -0.5;
        share *= 0.5;
        exact += 2.0 * fall * share;
        bounces += 1;
        assert!(bounces < 200);
        run = run
            .resume()
            .until_event("floor", Crossing::Falling, floor)
            .run(start)
            .unwrap();
    }
    // The last flight that is resolved takes at most 2⁻⁴⁰ of the first: 10⁻¹² s.
    assert!(bounces >= 40, "{bounces}");
}

/// `x'' = u`, pushed by the force of a relay.
fn pushed() -> Toy<1> {
    Toy::new(([0.0], [0.0]), |_, _, _, u, _| [u])
}

/// An input law that holds the input constant.
fn held(force: f64) -> impl Fn(f64, &[f64; 1], &[f64; 1], &mut f64) + Clone {
    move |_, _, _, u| *u = force
}

#[test]
fn a_relay_switches_a_hundred_thousand_times() {
    // x'' = −A sgn x: each half swing takes 2v/A, with the same v at each passage. The relay switches where x = 0, and the sign of x just after is decided
    // by v, not by the new force.
    let (force, v, count) = (1e4, 1.0, 100_000);
    let machine = pushed();
    let zero = |state: &State<[f64; 1]>| state.q[0];
    let start = State {
        t: 0.0,
        q: [0.0],
        v: [v],
    };
    let mut side = 1.0;
    let mut run = Simulation::new(&machine)
        .inputs(held(-force))
        .until(100.0)
        .until_event("relay", Crossing::Any, zero)
        .run(start)
        .unwrap();
    for switch in 1..=count {
        let (switches, half) = (f64::from(switch), 2.0 * v / force);
        let exact = half * switches;
        // Each passage has an error of 4 ε t in time, which causes an error of 4 ε t A in speed and of 8 ε t in each later half swing.
        let limit = f64::EPSILON * exact * (4.0 + 8.0 * switches + 4.0 * switches * switches);
        let late = run.end().t - exact;
        assert!(late.abs() <= limit, "{switch}: {late:e}");
        assert_eq!(*run.ending(), Ending::Event("relay".into()), "{switch}");
        let crossing = run.events()[0].crossing;
        assert_eq!(crossing == Crossing::Falling, side > 0.0, "{switch}");
        side = -side;
        run = run
            .resume()
            .inputs(held(-side * force))
            .until_event("relay", Crossing::Any, zero)
            .run(*run.end())
            .unwrap();
    }
}

#[test]
fn a_chattering_relay_switches_a_hundred_thousand_times() {
    // x'' = u keeps v within ±b: u = −1 from v = b on, 1 from v = −b on. Just after a switch the switching function goes back to the side it came from; v
    // changes by 2b from one switch to the next.
    let (band, count) = (1e-3, 100_000);
    let machine = pushed();
    let upper = move |state: &State<[f64; 1]>| state.v[0] - band;
    let lower = move |state: &State<[f64; 1]>| state.v[0] + band;
    let mut run = Simulation::new(&machine)
        .inputs(held(1.0))
        .until(1e3)
        .until_event("upper", Crossing::Any, upper)
        .until_event("lower", Crossing::Any, lower)
        .run(machine.start())
        .unwrap();
    for switch in 0..count {
        let is_upper = switch % 2 == 0;
        let name = if is_upper { "upper" } else { "lower" };
        assert_eq!(*run.ending(), Ending::Event(name.into()), "{switch}");
        let exact = band * (1.0 + 2.0 * f64::from(switch));
        // Each switch has an error of a few rounding units of time.
        let limit = 8.0 * f64::EPSILON * exact * (1.0 + f64::from(switch));
        let late = run.end().t - exact;
        assert!(late.abs() <= limit, "{switch}: {late:e}");
        run = run
            .resume()
            .inputs(held(if is_upper { -1.0 } else { 1.0 }))
            .until_event("upper", Crossing::Any, upper)
            .until_event("lower", Crossing::Any, lower)
            .run(*run.end())
            .unwrap();
    }
}

#[test]
fn a_resumed_run_has_the_settings_of_the_first() {
    let oscillator = oscillator();
    let run = Simulation::new(&oscillator)
        .method(&METHODS[1])
        .tolerance(1e-6)
        .longest_step(0.125)
        .every(0.5)
        .energy_balance(true)
        .until(3.0)
        .until_event("half", Crossing::Falling, |state| state.q[0] - 0.5)
        .run(oscillator.start())
        .unwrap();
    let resumed = run.resume().run(*run.end()).unwrap();
    assert_eq!((resumed.start(), resumed.end().t), (run.end(), 3.0));
    let times: Vec<f64> = resumed.steps().map(|state| state.t).collect();
    assert!(
        times
            .windows(2)
            .all(|pair| pair[1] - pair[0] <= 0.125 * 1.01)
    );
    assert!(resumed.energy_balance().unwrap().relative().abs() < 1e-4);
    assert_eq!(resumed.samples()[1].t, run.end().t + 0.5);
    assert!((resumed.end().q[0] - 3.0_f64.cos()).abs() < 1e-4);
}

#[test]
fn a_jump_that_ends_a_run_ends_it_once() {
    // The function has no zero, only a jump: the run ends beside it to rounding, and the next run continues past it.
    let ball = ball();
    let tick = |state: &State<[f64; 1]>| if state.t < 1.25 { -1.0 } else { 1.0 };
    let run = Simulation::new(&ball)
        .until(3.0)
        .until_event("tick", Crossing::Rising, tick)
        .run(ball.start())
        .unwrap();
    assert!((run.end().t - 1.25).abs() <= 4.0 * f64::EPSILON);
    let resumed = run
        .resume()
        .until_event("tick", Crossing::Any, tick)
        .until_event("tock", Crossing::Rising, |state| state.t - 2.0)
        .run(*run.end())
        .unwrap();
    assert_eq!(*resumed.ending(), Ending::Event("tock".into()));
    assert!((resumed.end().t - 2.0).abs() <= 4.0 * f64::EPSILON);
}

/// A ball with the velocity `v` at the start: it is highest at t = v/9.81 s, which may be before the start.
fn thrown(v: f64) -> Toy<1> {
    Toy::new(([0.0], [v]), |_, _, _, _, _| [-9.81])
}

/// A height a billionth below the highest point is passed twice within 3·10⁻⁵ s, and one above it never. Every method finds this in one step, wherever in
/// the step the highest point lies, forward and backward in time.
#[test]
fn what_comes_and_goes_within_a_step_is_an_event() {
    let (highest, top) = (12.5 / 9.81, 5.0 / 9.81);
    let excess = 1e-9 * highest;
    let beside = (2.0 * excess / 9.81_f64).sqrt();
    let rk4 = Method::named("rk4").unwrap();
    for method in METHODS.iter().chain(&RADAU_OF_HIGH_ORDER).chain([rk4]) {
        for i in 0..40 {
            for direction in [1.0, -1.0] {
                let end = 0.52 + 0.03 * f64::from(i);
                let ball = thrown(5.0 * direction);
                let (below, above) = (highest - excess, highest + excess);
                let run = Simulation::new(&ball)
                    .method(method)
                    .first_step(end)
                    .longest_step(end)
                    .until(end * direction)
                    .event("below", Crossing::Any, move |state| state.q[0] - below)
                    .event("above", Crossing::Any, move |state| state.q[0] - above)
                    .run(ball.start())
                    .unwrap();
                let name = method.tableau.name;
                assert_eq!(run.statistics().steps, 1, "{name}");
                let [one, other] = run.events() else {
                    panic!("{name} to {end} s: {:?}", run.events())
                };
                // A thousand rounding units of the largest distance, as dense output has.
                let way = highest.max((5.0 * end - 0.5 * 9.81 * end * end).abs());
                let limit = 1e3 * f64::EPSILON * way / (9.81 * beside);
                let crossings = if direction > 0.0 {
                    [Crossing::Rising, Crossing::Falling]
                } else {
                    [Crossing::Falling, Crossing::Rising]
                };
                for (event, (at, crossing)) in [one, other]
                    .into_iter()
                    .zip([top - beside, top + beside].into_iter().zip(crossings))
                {
                    let late = event.state.t - at * direction;
                    assert!(late.abs() <= limit, "{name} to {end} s: {late:e}");
                    assert_eq!((&*event.name, event.crossing), ("below", crossing));
                }
            }
        }
    }
}

/// An event at a height that the motion barely exceeds ends the run at the first passage.
#[test]
fn a_run_ends_at_a_height_that_it_hardly_passes() {
    let highest = 12.5 / 9.81;
    let excess = 1e-9 * highest;
    let at = 5.0 / 9.81 - (2.0 * excess / 9.81_f64).sqrt();
    for method in &METHODS {
        let ball = thrown(5.0);
        let run = Simulation::new(&ball)
            .method(method)
            .first_step(1.0)
            .until(1.0)
            .until_event("height", Crossing::Any, move |state| {
                state.q[0] - (highest - excess)
            })
            .run(ball.start())
            .unwrap();
        assert_eq!(*run.ending(), Ending::Event("height".into()));
        let late = run.end().t - at;
        assert!(late.abs() <= 1e-9, "{}: {late:e}", method.tableau.name);
    }
}

/// x = cos t is beyond −1 + ε for a time 2√(2ε) at each turning point, a small part of a step, and never beyond −1 − ε.
#[test]
fn turning_points_that_hardly_pass_a_level_are_all_seen() {
    let [_, radau13] = &RADAU_OF_HIGH_ORDER;
    for (method, tolerance, excess) in [
        (&METHODS[0], 1e-13, 1e-9),
        (&METHODS[1], 1e-12, 1e-7),
        (radau13, 1e-13, 1e-9),
    ] {
        let oscillator = oscillator();
        let run = Simulation::new(&oscillator)
            .method(method)
            .tolerance(tolerance)
            .until(40.0)
            .event("below", Crossing::Any, move |state| {
                state.q[0] + 1.0 - excess
            })
            .event("above", Crossing::Any, move |state| {
                state.q[0] + 1.0 + excess
            })
            .run(oscillator.start())
            .unwrap();
        let name = method.tableau.name;
        let beside = (1.0 - excess).acos();
        let steps = run.statistics().steps as f64;
        assert!(40.0 / steps > 4.0 * beside, "{name}: {steps} steps");
        assert_eq!(run.events().len(), 12, "{name}");
        // The sum of the steps' errors, divided by the rate there.
        let limit = 10.0 * (steps + 10.0) * tolerance / beside;
        assert!(limit < beside, "{name}");
        for (k, event) in run.events().iter().enumerate() {
            let turn = PI * (2 * (k / 2) + 1) as f64;
            let at = [turn - beside, turn + beside][k % 2];
            let late = event.state.t - at;
            assert!(late.abs() <= limit, "{name}: {late:e}");
            let crossing = [Crossing::Falling, Crossing::Rising][k % 2];
            assert_eq!((&*event.name, event.crossing), ("below", crossing));
        }
    }
}

/// All heights are found in order on the way up and in reverse order on the way down, all within one step.
#[test]
fn heights_are_passed_up_and_down_in_order() {
    for method in &METHODS {
        let ball = thrown(30.0);
        let heights: Vec<f64> = (1..=15).map(|i| 3.0 * f64::from(i)).collect();
        let mut simulation = Simulation::new(&ball)
            .method(method)
            .first_step(6.5)
            .until(6.5);
        for (i, &height) in heights.iter().enumerate() {
            let name = format!("{i}");
            let function = move |state: &State<[f64; 1]>| state.q[0] - height;
            simulation = simulation.event(&name, Crossing::Any, function);
        }
        let run = simulation.run(ball.start()).unwrap();
        assert_eq!(run.statistics().steps, 1);
        let order = (0..15).chain((0..15).rev());
        assert_eq!(run.events().len(), 30, "{}", method.tableau.name);
        for (place, (event, i)) in run.events().iter().zip(order).enumerate() {
            let half = (900.0 - 2.0 * 9.81 * heights[i]).sqrt();
            let t = if place < 15 { 30.0 - half } else { 30.0 + half } / 9.81;
            assert_eq!(event.name, format!("{i}"));
            // The speed is at least 4 m/s.
            assert!((event.state.t - t).abs() <= ROUNDOFF_OF_FALL);
        }
    }
}

/// A function that touches zero and returns does not change its sign. If rounding takes it beyond zero for a moment, both changes are reported.
#[test]
fn a_touch_is_no_event() {
    for method in &METHODS {
        for i in 0..40 {
            // (t − 1)².
            let ball = Toy::new(([1.0], [-2.0]), |_, _, _, _, _| [2.0]);
            let end = 1.02 + 0.05 * f64::from(i);
            let run = Simulation::new(&ball)
                .method(method)
                .first_step(end)
                .until(end)
                .event("touch", Crossing::Any, |state| state.q[0])
                .event("not quite", Crossing::Any, |state| state.q[0] + 1e-9)
                .run(ball.start())
                .unwrap();
            let crossings: Vec<_> = (run.events().iter())
                .map(|event| (&*event.name, event.crossing))
                .collect();
            let both = [("touch", Crossing::Falling), ("touch", Crossing::Rising)];
            assert!(
                crossings.is_empty() || crossings == both,
                "{} to {end} s: {crossings:?}",
                method.tableau.name
            );
        }
    }
}

/// A function that is 0 at the start and has two more zeros between two evaluations: t ((t − 0.35)² − d²).
#[test]
fn what_starts_at_zero_may_come_and_go_as_well() {
    for method in &METHODS {
        for half in [0.08, 1e-3, 1e-6] {
            let ball = ball();
            let run = Simulation::new(&ball)
                .method(method)
                .first_step(1.0)
                .until(1.0)
                .event("both", Crossing::Any, move |state: &State<[f64; 1]>| {
                    state.t * ((state.t - 0.35) * (state.t - 0.35) - half * half)
                })
                .run(ball.start())
                .unwrap();
            let found: Vec<_> = (run.events().iter())
                .map(|event| (event.state.t, event.crossing))
                .collect();
            let [one, other] = found[..] else {
                panic!("{} {half}: {found:?}", method.tableau.name)
            };
            // The function has an error of a few rounding units of 0.35³, at the rate 0.7 d.
            let limit = 64.0 * f64::EPSILON / half;
            assert!((one.0 - (0.35 - half)).abs() <= limit, "{one:?}");
            assert!((other.0 - (0.35 + half)).abs() <= limit, "{other:?}");
            assert_eq!([one.1, other.1], [Crossing::Falling, Crossing::Rising]);
        }
    }
}

/// An event function far from zero costs no evaluation of the machine and seven of its own in each step: the value at the start is known, four values
/// define the interpolant, and three check it.
#[test]
fn what_is_far_from_zero_is_asked_seven_times_a_step() {
    for method in &METHODS {
        let oscillator = oscillator();
        let simulation = || {
            Simulation::new(&oscillator)
                .method(method)
                .tolerance(1e-8)
                .until(20.0)
        };
        let without = simulation().run(oscillator.start()).unwrap();
        let count = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&count);
        let with = simulation()
            .event("far", Crossing::Any, move |state: &State<[f64; 1]>| {
                counted.fetch_add(1, Ordering::Relaxed);
                state.q[0] + 1.5
            })
            .run(oscillator.start())
            .unwrap();
        assert_eq!(with.end(), without.end());
        let (with, without) = (with.statistics(), without.statistics());
        assert_eq!(with.evaluations, without.evaluations);
        // At the start it is evaluated three times, and four times more at each of these with each number moved by its rounding.
        let asked = count.load(Ordering::Relaxed) - 7 * with.steps;
        assert_eq!(asked, 3 + 3 * 4, "{}", method.tableau.name);
    }
}
