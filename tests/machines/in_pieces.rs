//! Runs that their caller takes from one instant to the next: with the bits of a sampled controller, which does the same from within a run.

use crate::support::random::SplitMix;
use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Ending, Error, Machine, Simulation, State};

/// Blocks on a rail and on the floor between stops, with friction, and a layer that is crushed: whatever a run keeps beside its state.
const YARD: &str = "machine Yard in plane {
    parameters { m: kg = 2, L: m = 0.4, e: 1 = 0.6, mu: 1 = 0.2, g: m/s^2 = 9.81, k1: N/m = 2e3, k2: N/m = 8e3 }
    coordinates { x: m = 0.1, s: m = -0.1, h: m = 0.3, y: m = 0.05 }
    inputs { push: N = 0, pull: N = 0 }
    bodies {
        block { mass: m, at: (x, 0) },
        slider { mass: m, at: (s, y) },
        ram { mass: m, at: (3*L, h) },
    }
    gravity (0, -g);
    forces { motor { on: x, value: push }, winch { on: s, value: pull } }
    sliding { rail { body: block, on: ground, direction: (1, 0), friction: mu } }
    contacts {
        right { gap: L - x, restitution: e },
        left { gap: L + x, restitution: e },
        floor { gap: y, slip: der(s), restitution: 0, friction: mu, static_friction: 1.5*mu },
        bed { gap: h, compliance: layer(k1, k2) },
    }
}";

fn yard() -> InterpretedMachine {
    InterpretedMachine::from_text(YARD)
        .build()
        .unwrap_or_else(|error| panic!("{error}"))
}

const PERIOD: f64 = 0.1;

/// Pushes of two motors, which change at every sample.
fn pushes() -> Vec<[f64; 2]> {
    let seed = std::env::var("SEED")
        .ok()
        .and_then(|seed| seed.parse().ok())
        .unwrap_or(1);
    println!("SEED={seed}");
    let mut random = SplitMix::new(seed);
    (0..30)
        .map(|_| [random.uniform(-30.0, 30.0), random.uniform(-15.0, 15.0)])
        .collect()
}

/// Everything that it keeps between the instants continues: which contacts are closed, what sticks, how deep the layer was, and the length of the next step.
#[test]
fn a_run_in_pieces_has_the_bits_of_a_sampled_one() {
    let machine = yard();
    let pushes = pushes();
    let until = PERIOD * pushes.len() as f64;
    let of = pushes.clone();
    let mut count = 0;
    let whole = Simulation::new(&machine)
        .tolerance(1e-9)
        .until(until)
        .sampled(PERIOD, move |_, inputs| {
            inputs.values.copy_from_slice(&of[count.min(of.len() - 1)]);
            count += 1;
        })
        .run(machine.start())
        .expect("it runs");
    let mut prepared = Simulation::new(&machine)
        .tolerance(1e-9)
        .prepare(machine.start())
        .expect("a start");
    let mut run = prepared.begin().expect("it begins");
    let mut events = 0;
    for (k, push) in pushes.iter().enumerate() {
        let mut inputs = run.observe().expect("known").inputs;
        inputs.values.copy_from_slice(push);
        run.set_inputs(inputs).expect("it goes on");
        if k > 0 {
            // Where inputs jump, a solution has the state after what that does to contacts.
            let state = run.state();
            let known = whole.at(state.t).expect("in the run");
            assert_eq!(
                (state.q.values, state.v.values),
                (known.q.values, known.v.values),
                "{}",
                state.t
            );
        }
        let t = PERIOD * (k + 1) as f64;
        assert_eq!(run.advance_to(t), Ok(Ending::End));
        events += run.take_contact_events().len();
    }
    let (state, end) = (run.state(), whole.end().clone());
    assert_eq!(
        (state.q.values, state.v.values),
        (end.q.values, end.v.values)
    );
    assert_eq!(events, whole.contact_events().len());
    assert!(events > 10, "{events}");
    let crushing: f64 = run
        .observe()
        .expect("known")
        .unilateral
        .iter()
        .map(|of| of.crushing_work)
        .sum();
    assert!(
        crushing > 0.0
            && (crushing - whole.crushing_work().iter().sum::<f64>()).abs() < 1e-12 * crushing
    );
}

/// A run that is over stays over, an instant before the present one changes nothing, and a start in a wall is refused.
#[test]
fn a_run_in_pieces_says_what_it_cannot_do() {
    let machine = yard();
    let at = |h: f64, x: f64| {
        let mut start: State<Named> = machine.start();
        (start.q.values[0], start.q.values[2]) = (x, h);
        start
    };
    let simulation = || Simulation::new(&machine).max_steps(1000);
    let mut inside = simulation().prepare(at(0.3, 0.5)).expect("a start");
    assert!(inside.begin().is_err());
    let mut prepared = simulation().prepare(at(0.3, 0.1)).expect("a start");
    let mut run = prepared.begin().expect("it begins");
    assert_eq!(run.advance_to(0.1), Ok(Ending::End));
    for t in [0.05, f64::NAN, f64::INFINITY] {
        assert!(
            matches!(run.advance_to(t), Err(Error::InvalidSetting { .. })),
            "{t}"
        );
    }
    assert_eq!(run.advance_to(0.1), Ok(Ending::End));
    // Inputs that are no numbers leave no motion; the error stays.
    let mut inputs = run.observe().expect("known").inputs;
    inputs.values[0] = f64::NAN;
    let failed = run
        .set_inputs(inputs)
        .and_then(|()| run.advance_to(0.2).map(|_| ()));
    // A number that is none differs from itself.
    let words = |made: Result<(), Error>| made.map_err(|error| error.to_string());
    let (failed, again) = (words(failed), words(run.advance_to(0.3).map(|_| ())));
    assert!(failed.is_err() && again == failed, "{failed:?} {again:?}");
    // An event that ends it.
    let mut prepared = simulation()
        .until_event("low", lagrangian::Crossing::Falling, |state| {
            state.q.values[2] - 0.2
        })
        .prepare(at(0.3, 0.1))
        .expect("a start");
    let mut run = prepared.begin().expect("it begins");
    assert_eq!(run.advance_to(1.0), Ok(Ending::Event("low".into())));
    // √(2·0.1/9.81)
    assert!((run.state().t - (0.2_f64 / 9.81).sqrt()).abs() < 1e-9);
    assert_eq!(run.advance_to(2.0), Ok(Ending::Event("low".into())));
    // Steps are counted anew for each instant.
    let mut prepared = Simulation::new(&machine)
        .max_steps(20)
        .longest_step(0.01)
        .prepare(at(0.3, 0.1))
        .expect("a start");
    let mut run = prepared.begin().expect("it begins");
    for k in 1..=10 {
        assert_eq!(run.advance_to(0.01 * f64::from(k)), Ok(Ending::End));
    }
    assert!(matches!(
        run.advance_to(5.0),
        Err(Error::TooManySteps { .. })
    ));
}
