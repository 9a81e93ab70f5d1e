//! Functions that are zero, or jump, exactly where contacts change: the truth is the closed form of a ball that falls from a height `h` and keeps the fraction
//! `e` of its speed. With `t₁ = √(2h/g)` its impacts are at `t₁ (1 + 2e + 2e² + …)`, and it is highest `eᵏ t₁` after the k-th of them.

use lagrangian::interpreted::{InterpretedMachine, Named};
use lagrangian::{Crossing, Ending, Machine, Method, Simulation, Solution, State};

const G: f64 = 9.81;

/// Its centre is at the height z, so that the height of its lowest point, z − r, is a difference whose rounding differs from ball to ball.
fn ball(r: f64, h: f64, e: f64) -> InterpretedMachine {
    let text = format!(
        "machine Ball in plane {{
            parameters {{ m: kg = 0.1, r: m = {r:?}, e: 1 = {e:?}, g: m/s^2 = {G:?} }}
            coordinates {{ z: m = r + {h:?} }}
            bodies {{ ball {{ mass: m, at: (0, z) }} }}
            circles {{ rim {{ on: ball, center: (0, 0), radius: r }} }}
            gravity (0, -g);
            contacts {{ floor {{ circle: rim, along: ground, restitution: e }} }}
        }}"
    );
    InterpretedMachine::from_text(&text)
        .build()
        .expect("a good spec")
}

/// The instants of the first impacts and of the highest places between them.
fn instants(h: f64, e: f64, count: i32) -> (Vec<f64>, Vec<f64>) {
    let first = (2.0 * h / G).sqrt();
    let impacts: Vec<f64> = (0..count)
        .scan(first, |t, k| {
            let impact = *t;
            *t += 2.0 * e.powi(k + 1) * first;
            Some(impact)
        })
        .collect();
    let tops = (1..)
        .zip(&impacts)
        .map(|(k, impact)| impact + e.powi(k) * first);
    (impacts.clone(), tops.collect())
}

type Run = Solution<InterpretedMachine>;

/// Runs with the height above the floor, its rate, the product of both, and the height above a level as events.
fn run(machine: &InterpretedMachine, r: f64, level: f64, until: f64, method: &str) -> Run {
    let simulation = Simulation::new(machine)
        .method(Method::named(method).expect("a method"))
        .tolerance(1e-11)
        .until(until);
    let simulation = match method {
        "moreau" => simulation.longest_step(1e-3),
        _ => simulation,
    };
    let height = move |state: &State<Named>| state.q.values[0] - r;
    let rate = |state: &State<Named>| state.v.values[0];
    simulation
        .event("height", Crossing::Any, height)
        .event("rate", Crossing::Any, rate)
        .event("product", Crossing::Any, move |state| {
            height(state) * rate(state)
        })
        .event("level", Crossing::Any, move |state| height(state) - level)
        .run_interpreted(machine.start())
        .expect("a run")
}

fn of(run: &Run, name: &str) -> Vec<(f64, Crossing)> {
    let events = run.events().iter().filter(|event| event.name == name);
    events
        .map(|event| (event.state.t, event.crossing))
        .collect()
}

#[track_caller]
fn are(found: &[(f64, Crossing)], expected: &[(f64, Crossing)], within: f64) {
    let ways = |all: &[(f64, Crossing)]| all.iter().map(|(_, way)| *way).collect::<Vec<_>>();
    assert_eq!(
        ways(found),
        ways(expected),
        "{found:?} instead of {expected:?}"
    );
    for ((found, _), (expected, _)) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() <= within,
            "{found} instead of {expected}"
        );
    }
}

fn merged(rising: &[f64], falling: &[f64]) -> Vec<(f64, Crossing)> {
    let rising = rising.iter().map(|t| (*t, Crossing::Rising));
    let falling = falling.iter().map(|t| (*t, Crossing::Falling));
    let mut all: Vec<_> = rising.chain(falling).collect();
    all.sort_by(|one, other| one.0.total_cmp(&other.0));
    all
}

/// The balls: radius, height, restitution.
const BALLS: [(f64, f64, f64); 6] = [
    (0.02, 1.0, 0.8),
    (0.3, 1.0, 0.8),
    (1.0 / 3.0, 0.7, 0.9),
    (0.1, 0.123, 0.5),
    (7.7, 2.0, 0.8),
    (1e3, 1.0, 0.75),
];

#[test]
fn a_height_touches_the_floor_and_its_rate_jumps() {
    for (r, h, e) in BALLS {
        let machine = ball(r, h, e);
        let (impacts, tops) = instants(h, e, 4);
        let until = 0.5 * (impacts[3] + tops[3]);
        for method in ["dop853", "bs32", "radau5"] {
            let run = run(&machine, r, 0.05 * h, until, method);
            // Position and rate are polynomials, so that time is known to rounding and to the tolerance of a few steps.
            let within = 1e-9;
            are(&of(&run, "height"), &[], within);
            let expected = merged(&impacts, &tops[..3]);
            are(&of(&run, "rate"), &expected, within);
            are(&of(&run, "product"), &expected, within);
            // Up and down between the impacts, except where the ball does not come to that height.
            let first = (2.0 * h / G).sqrt();
            let mut levels = vec![((2.0 * 0.95 * h / G).sqrt(), Crossing::Falling)];
            for (k, impact) in (1..).zip(&impacts) {
                let speed = e.powi(k) * G * first;
                let root = (speed * speed - 0.1 * G * h).sqrt();
                let passes = [
                    (speed - root, Crossing::Rising),
                    (speed + root, Crossing::Falling),
                ];
                levels.extend(passes.map(|(v, way)| (impact + v / G, way)));
            }
            levels.retain(|(t, _)| *t < until);
            are(&of(&run, "level"), &levels, 1e-8);
        }
    }
}

#[test]
fn a_run_ends_at_an_impact_where_the_sign_changes_and_not_where_it_stays() {
    for (r, h, e) in BALLS {
        let machine = ball(r, h, e);
        let (impacts, _) = instants(h, e, 4);
        let until = impacts[2] + 1e-3;
        let begun = || Simulation::new(&machine).tolerance(1e-11).until(until);
        let height = move |state: &State<Named>| state.q.values[0] - r;
        let product = move |state: &State<Named>| (state.q.values[0] - r) * state.v.values[0];
        let to_end = begun().until_event("height", Crossing::Any, height);
        let to_end = to_end.run_interpreted(machine.start()).expect("a run");
        assert_eq!(*to_end.ending(), Ending::End, "{r}");
        let ended = begun().until_event("product", Crossing::Rising, product);
        let ended = ended.run_interpreted(machine.start()).expect("a run");
        assert_eq!(*ended.ending(), Ending::Event("product".into()), "{r}");
        let impact = ended.contact_events().first().expect("an impact").state.t;
        assert_eq!(ended.end().t, impact);
        assert!(ended.end().v.values[0] > 0.0);
        // What goes on from there does not find it again.
        let resumed = ended.resume().until(impacts[1] - 1e-3);
        let resumed = resumed.run_interpreted(ended.end().clone());
        if let Ok(resumed) = resumed {
            assert_eq!(of(&resumed, "product"), []);
        }
    }
}

#[test]
fn what_stays_at_zero_after_an_impact_becomes_zero_once() {
    for (r, h, _) in BALLS {
        let machine = ball(r, h, 0.0);
        let (impacts, _) = instants(h, 0.0, 1);
        let run = run(&machine, r, 0.05 * h, 3.0, "dop853");
        are(
            &of(&run, "height"),
            &[(impacts[0], Crossing::Falling)],
            1e-9,
        );
        are(&of(&run, "rate"), &[(impacts[0], Crossing::Rising)], 1e-9);
    }
}

#[test]
fn bounces_that_accumulate_end_on_the_floor_once() {
    for (r, h, e) in BALLS {
        let machine = ball(r, h, e);
        let last = (2.0 * h / G).sqrt() * (1.0 + e) / (1.0 - e);
        let run = run(&machine, r, 0.05 * h, last + 1.0, "dop853");
        // Bounces lower than twice the rounding of the height, 1e-12 of the coordinate and what time has, are no bounces; from there on they take
        // 2v/(g (1 − e)) with v² = 2g times that height.
        let least = 2.0 * (1e-12 * (r + h) + 1e-14);
        let within = 2.0 * (2.0 * least / G).sqrt() / (1.0 - e) + 1e-8;
        are(&of(&run, "height"), &[(last, Crossing::Falling)], within);
    }
}

#[test]
fn time_stepping_counts_the_same() {
    for (r, h, e) in BALLS {
        let machine = ball(r, h, e);
        let (impacts, tops) = instants(h, e, 4);
        let until = 0.5 * (impacts[3] + tops[3]);
        let run = run(&machine, r, 0.05 * h, until, "moreau");
        are(&of(&run, "height"), &[], 0.0);
        // An impact is up to a step late, and its rate wrong by g times a step, which later flights add up.
        let within = 0.02;
        let expected = merged(&impacts, &tops[..3]);
        for name in ["rate", "product"] {
            // In the first step the rate 0 of the start is the difference of two heights by the step, with the rounding of these.
            let mut found = of(&run, name);
            found.retain(|(t, _)| *t > 1e-3);
            are(&found, &expected, within);
        }
    }
}
