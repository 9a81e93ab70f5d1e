//! Events are found on time, in order, and end a run where they should.
#![cfg(feature = "std")]

mod by_hand;

use by_hand::toy::{Toy, ball, oscillator};
use lagrangian::{Crossing, Ending, Error, METHODS, Simulation, State};
use std::f64::consts::{FRAC_PI_2, PI};

/// A ball that falls may go 490 m in one step of 10 s; its positions are known to the roundoff of
/// that.
const ROUNDOFF_OF_FALL: f64 = 16.0 * f64::EPSILON * 490.0;

#[test]
fn a_ball_touches_the_ground_on_time_by_every_method() {
    // h = g t² / 2; a polynomial of degree 2 is exact for every method.
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
        // At 6 m/s.
        assert!((event.state.t - fall_time).abs() <= ROUNDOFF_OF_FALL / 6.0);
        assert_eq!(run.end().t, event.state.t);
        assert!(run.end().q[0].abs() <= ROUNDOFF_OF_FALL);
        assert!((run.end().v[0] + 9.81 * fall_time).abs() <= ROUNDOFF_OF_FALL);
    }
}

#[test]
fn a_ball_bounces_from_run_to_run() {
    // Each run starts on the ground: leaving it is no event, coming back is.
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
        // Errors of state and time are the same, at rate 1; dense output errs like a few steps.
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
    // Free fall takes few, long steps; heights of 3 m apart are passed within them.
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
        // The first height is passed at 4.4 m/s.
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
    // The steps that were kept end with the run.
    assert_eq!(run.steps().last().unwrap(), *run.end());
}

#[test]
fn backward_in_time_crossings_keep_their_names() {
    // From t = 0 back: x = cos t is 0 at −π/2, where it rises with t.
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
    // v = −sin t is 0 at the start, then falls; its next zero is at π.
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
