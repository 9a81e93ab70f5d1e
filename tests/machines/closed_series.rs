//! Runs by Taylor series while contacts are closed: against closed forms, a pendulum in double-doubles, and runs by `dop853`.

use crate::support::library;
use lagrangian::interpreted::{InterpretedMachine, SeriesStepper};
use lagrangian::{ContactEventKind, Machine, Method, MethodReason, Simulation, Solution, TAYLOR};
use lagrangian_scalar::{DoubleDouble, Scalar};

type Run = Solution<InterpretedMachine>;

const G: f64 = 9.81;

/// A disc that rolls in a trough that is shaken, and a point that slides in it.
const ROLLING: &str = include_str!("../data/flights/rolling.machine");
const RUBBING: &str = include_str!("../data/flights/rubbing.machine");

/// A box that glides on three feet, of which two would carry it, with a pendulum on it.
const FEET: &str = include_str!("../data/flights/feet.machine");

fn machine(text: &str) -> InterpretedMachine {
    let machine = InterpretedMachine::from_text(text).with_series().build();
    machine.unwrap_or_else(|error| panic!("{error}"))
}

fn of_library(name: &str) -> InterpretedMachine {
    machine(&library::text(&format!("contacts/{name}")))
}

fn run(machine: &InterpretedMachine, method: &'static Method, to: (f64, f64)) -> Run {
    let (tolerance, until) = to;
    let run = Simulation::new(machine)
        .method(method)
        .tolerance(tolerance)
        .until(until)
        .energy_balance(true)
        .run(machine.start());
    run.unwrap_or_else(|error| panic!("{}: {error}", method.tableau.name))
}

/// The methods of a run, one after the other.
fn methods(run: &Run) -> Vec<&'static str> {
    let choices = run.choices().iter();
    choices.map(|choice| choice.method.tableau.name).collect()
}

/// Time, coordinates and rates at the first event of a kind.
fn first(run: &Run, kind: ContactEventKind) -> (f64, Vec<f64>, Vec<f64>) {
    let mut events = run.contact_events().iter();
    let event = events.find(|event| event.kind == kind);
    let event = event.unwrap_or_else(|| panic!("{kind:?} among {:?}", run.contact_events()));
    let state = &event.state;
    (state.t, state.q.values.clone(), state.v.values.clone())
}

/// Where a function that is positive at the first of two places and negative at the second is 0.
fn root([mut from, mut to]: [f64; 2], of: impl Fn(f64) -> f64) -> f64 {
    assert!(of(from) > 0.0 && of(to) < 0.0);
    loop {
        let middle = 0.5 * (from + to);
        if middle <= from || middle >= to {
            return middle;
        }
        *(if of(middle) > 0.0 { &mut from } else { &mut to }) = middle;
    }
}

fn residual_of_energy(run: &Run) -> f64 {
    let balance = run.energy_balance();
    balance.map_or(f64::NAN, |balance| {
        balance.residual().abs() / balance.exchanged
    })
}

/// Friction μ m g slows the ball and turns it until it rolls, at 5/7 of its speed at the start. All of this is polynomials, so each phase is exact to rounding.
#[test]
fn a_bowling_ball_slips_until_it_rolls() {
    let ball = of_library("bowling_ball");
    let (speed, r, mu, until) = (8.0, 0.108, 0.1, 5.0);
    let rolls = 2.0 * speed / (7.0 * mu * G);
    let there = speed * rolls - 0.5 * mu * G * rolls * rolls;
    for tolerance in [1e-6, 1e-12] {
        let run = run(&ball, &TAYLOR, (tolerance, until));
        let (t, q, v) = first(&run, ContactEventKind::Sticks);
        assert!(
            (t - rolls).abs() < 1e-13 && (q[0] - there).abs() < 1e-12,
            "{t} {q:?}"
        );
        assert!((v[2] * r + v[0]).abs() < 1e-12);
        let end = run.end();
        let distance = there + 5.0 / 7.0 * speed * (until - rolls);
        assert!((end.q.values[0] - distance).abs() < 1e-12);
        assert_eq!(methods(&run), ["taylor"]);
        assert!(residual_of_energy(&run) < 1e-13);
    }
}

/// A point that slides down a fixed circle without friction leaves it where cos θ is 2/3 of its value at the start.
#[test]
fn a_point_leaves_a_circle_at_two_thirds_of_its_height() {
    let hill = machine(
        "machine Hill in plane {
            parameters { m: kg = 0.4, R: m = 0.7, tilt: rad = 0.1, g: m/s^2 = 9.81 }
            coordinates { x: m = R*sin(tilt), y: m = R*cos(tilt) }
            bodies { point { mass: m, at: (x, y) } }
            gravity (0, -g);
            contacts { hill { gap: sqrt(x^2 + y^2) - R, restitution: 0 } }
        }",
    );
    let (radius, tilt) = (0.7, 0.1_f64);
    let cos = 2.0 / 3.0 * tilt.cos();
    let speed = (2.0 * G * radius * (tilt.cos() - cos)).sqrt();
    for tolerance in [1e-7, 1e-10, 1e-13] {
        let run = run(&hill, &TAYLOR, (tolerance, 1.5));
        let (t, q, v) = first(&run, ContactEventKind::Lifts);
        let errors = [
            q[1] / radius - cos,
            q[0].hypot(q[1]) - radius,
            v[0].hypot(v[1]) - speed,
        ];
        println!("{tolerance:e}: leaves at {t}, errors {errors:?}");
        // The time to fall from near the top magnifies errors of the start by e^(t √(g/R)), less than 1e3.
        let most = 1e3 * tolerance;
        assert!(errors.iter().all(|error| error.abs() < most), "{errors:?}");
        assert_eq!(methods(&run), ["taylor"]);
        assert!(residual_of_energy(&run) < 10.0 * tolerance);
    }
}

/// Checks that a run by series has fewer steps than one by `dop853`, a small error, and a closed energy balance.
#[track_caller]
fn assert_fewer_steps(
    tolerance: f64,
    [explicit, by_series]: [&Run; 2],
    error: impl Fn(&Run) -> f64,
) {
    println!(
        "{tolerance:e}: dop853 {} steps, error {:.1e}; taylor {} steps, error {:.1e}",
        explicit.statistics().steps,
        error(explicit),
        by_series.statistics().steps,
        error(by_series)
    );
    assert!(error(by_series) < 100.0 * tolerance);
    assert_eq!(methods(by_series), ["taylor"]);
    assert!(by_series.statistics().steps < explicit.statistics().steps);
    assert!(residual_of_energy(by_series) < 100.0 * tolerance);
}

/// In a round trough without friction a point is the bob of a pendulum.
#[test]
fn a_point_in_a_trough_is_a_pendulum() {
    let trough = machine(
        "machine Trough in plane {
            parameters { m: kg = 0.4, R: m = 0.7, tilt: rad = 1.2, g: m/s^2 = 9.81 }
            coordinates { x: m = R*sin(tilt), y: m = -R*cos(tilt) }
            bodies { point { mass: m, at: (x, y) } }
            gravity (0, -g);
            contacts { trough { gap: R - sqrt(x^2 + y^2), restitution: 0 } }
        }",
    );
    let pendulum = machine(
        "machine Pendulum in plane {
            parameters { m: kg = 0.4, R: m = 0.7, tilt: rad = 1.2, g: m/s^2 = 9.81 }
            coordinates { theta: rad = tilt }
            bodies { point { mass: m, at: R*(sin(theta), -cos(theta)) } }
            gravity (0, -g);
        }",
    );
    let until = 10.0;
    let mut exact = SeriesStepper::<DoubleDouble>::new(&pendulum, 1e-28).unwrap();
    exact.advance_to(DoubleDouble::from_f64(until)).unwrap();
    let theta = exact.q()[0].to_f64();
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let [explicit, by_series] =
            [Method::DOP853, &TAYLOR].map(|method| run(&trough, method, (tolerance, until)));
        let error = |run: &Run| {
            let q = &run.end().q.values;
            (q[0] - 0.7 * theta.sin()).hypot(q[1] + 0.7 * theta.cos())
        };
        assert_fewer_steps(tolerance, [&explicit, &by_series], error);
    }
}

/// A point slides up a rough trough from its bottom. With the angle θ from there, u = v² obeys du/dθ = −2 g R sin θ − 2 μ (g R cos θ + u), which is linear.
#[test]
fn friction_in_a_trough_grows_with_the_speed() {
    let (mu, radius, speed) = (0.3_f64, 0.7, 3.0);
    let trough = machine(
        "machine Trough in plane {
            parameters { m: kg = 0.4, R: m = 0.7, mu: 1 = 0.3, speed: m/s = 3, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m = -R, der(x): m/s = speed }
            bodies { point { mass: m, at: (x, y) } }
            gravity (0, -g);
            contacts {
                trough {
                    gap: R - sqrt(x^2 + y^2), slip: (x*der(y) - y*der(x))/sqrt(x^2 + y^2),
                    restitution: 0, friction: mu,
                }
            }
        }",
    );
    let over = 2.0 * G * radius / (1.0 + 4.0 * mu * mu);
    let (a, b) = (over * (1.0 - 2.0 * mu * mu), -3.0 * mu * over);
    let square = |theta: f64| {
        let by_start = (speed * speed - a) * f64::exp(-2.0 * mu * theta);
        by_start + a * theta.cos() + b * theta.sin()
    };
    let turns = root([0.0, 1.5], square);
    // It is steeper there than friction holds, so it slides back.
    assert!(turns.tan() > mu);
    for tolerance in [1e-7, 1e-10, 1e-13] {
        let run = run(&trough, &TAYLOR, (tolerance, 1.0));
        let (t, q, _) = first(&run, ContactEventKind::Reverses);
        let found = q[0].atan2(-q[1]);
        println!("{tolerance:e}: turns at {t}, error {:.1e}", found - turns);
        assert!((found - turns).abs() < 100.0 * tolerance);
        assert_eq!(methods(&run), ["taylor"]);
        assert!(residual_of_energy(&run) < 100.0 * tolerance);
    }
}

/// A block on a table that is shaken sticks until the table would accelerate it by more than μ g, and slips until both are equally fast.
#[test]
fn a_block_on_a_shaken_table_sticks_and_slips() {
    let (amplitude, w, mu) = (0.1, 10.0, 0.5);
    let table = machine(
        "machine Table in plane {
            parameters { m: kg = 0.4, A: m = 0.1, w: rad/s = 10, mu: 1 = 0.5, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m, der(x): m/s = A*w }
            bodies { block { mass: m, at: (x, y) } }
            gravity (0, -g);
            contacts { table { gap: y, slip: der(x) - A*w*cos(w*t), restitution: 0, friction: mu } }
        }",
    );
    let slips = f64::asin(mu * G / (amplitude * w * w)) / w;
    let table_rate = |t: f64| amplitude * w * f64::cos(w * t);
    let rate = |t: f64| table_rate(slips) - mu * G * (t - slips);
    let stops = root([slips + 0.1, slips + 0.6], |t| rate(t) - table_rate(t));
    for tolerance in [1e-8, 1e-12] {
        let run = run(&table, &TAYLOR, (tolerance, 0.8));
        let (t, q, _) = first(&run, ContactEventKind::Slips);
        println!("{tolerance:e}: slips {:.1e}", t - slips);
        assert!((t - slips).abs() < 10.0 * tolerance + 1e-12);
        assert!((q[0] - amplitude * f64::sin(w * slips)).abs() < 10.0 * tolerance + 1e-12);
        let events = run.contact_events();
        let place = events
            .iter()
            .position(|one| one.kind == ContactEventKind::Slips)
            .unwrap();
        let next = &events[place + 1];
        assert!(matches!(
            next.kind,
            ContactEventKind::Sticks | ContactEventKind::Reverses
        ));
        println!("{:?} {:.1e}", next.kind, next.state.t - stops);
        assert!((next.state.t - stops).abs() < 10.0 * tolerance + 1e-12);
        assert_eq!(methods(&run), ["taylor"]);
    }
}

/// Runs against the same motion of a machine without contacts, in double-doubles: numbers of both, in the order of the first.
fn check_against(with: &InterpretedMachine, alone: &InterpretedMachine, places: &[usize]) {
    let until = 10.0;
    let mut exact = SeriesStepper::<DoubleDouble>::new(alone, 1e-28).unwrap();
    exact.advance_to(DoubleDouble::from_f64(until)).unwrap();
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let [explicit, by_series] =
            [Method::DOP853, &TAYLOR].map(|method| run(with, method, (tolerance, until)));
        let error = |run: &Run| {
            let pairs = places.iter().zip(exact.q());
            let errors =
                pairs.map(|(place, exact)| (run.end().q.values[*place] - exact.to_f64()).abs());
            errors.fold(0.0, f64::max)
        };
        assert_fewer_steps(tolerance, [&explicit, &by_series], error);
    }
}

/// Three feet on a line share their load in several ways. Without friction the box is a cart.
#[test]
fn a_box_on_three_feet_is_a_cart() {
    let cart = machine(
        "machine Cart in plane {
            parameters { M: kg = 2, m: kg = 1, L: m = 0.5, k: N/m = 30, g: m/s^2 = 9.81 }
            coordinates { x: m = 0.2, theta: rad = 1 }
            bodies {
                cart { mass: M, at: (x, 0) },
                bob { mass: m, at: (x + L*sin(theta), -L*cos(theta)) },
            }
            gravity (0, -g);
            springs { s { stiffness: k, stretch: x } }
        }",
    );
    check_against(&machine(FEET), &cart, &[0, 3]);
}

/// Four feet that stick to a floor that is shaken: of their twelve conditions six are independent. The pendulum on the box has a pivot that is driven.
#[test]
fn a_box_on_four_feet_in_space_sticks_to_a_shaken_floor() {
    let standing = machine(
        "machine Standing in space {
            parameters {
                m: kg = 0.8, a: m = 0.1, b: m = 0.06, c: m = 0.04, M: kg = 0.1, L: m = 0.3,
                A: m = 0.01, w: rad/s = 9, mu: 1 = 0.9, g: m/s^2 = 9.81,
            }
            coordinates {
                x: m, y: m, z: m = c, yaw: rad, theta: rad, phi: rad, swing: rad = 0.5, side: rad = 0.2,
                der(x): m/s = A*w,
            }
            frames {
                held = ground.shift(x, y, z).turn(z, yaw).turn(y, theta).turn(x, phi),
                floor = ground.shift(A*sin(w*t), 0, 0),
            }
            bodies {
                box { mass: m, inertia: (m/3*(b^2 + c^2), m/3*(a^2 + c^2), m/3*(a^2 + b^2)), frame: held },
                bob {
                    mass: M,
                    at: (x + L*sin(swing), y + L*cos(swing)*sin(side), z - L*cos(swing)*cos(side)),
                },
            }
            gravity (0, 0, -g);
            contacts {
                floor {
                    corners: ((a, b, -c), (a, -b, -c), (-a, b, -c), (-a, -b, -c)),
                    on: held, along: floor, restitution: 0, friction: mu,
                },
            }
        }",
    );
    let pendulum = machine(
        "machine Driven in space {
            parameters { M: kg = 0.1, L: m = 0.3, A: m = 0.01, w: rad/s = 9, g: m/s^2 = 9.81 }
            coordinates { swing: rad = 0.5, side: rad = 0.2 }
            bodies {
                bob {
                    mass: M,
                    at: (A*sin(w*t) + L*sin(swing), L*cos(swing)*sin(side), -L*cos(swing)*cos(side)),
                },
            }
            gravity (0, 0, -g);
        }",
    );
    check_against(&standing, &pendulum, &[6, 7]);
}

/// A tall box sticks to a shaken table by both feet, whose slips are one. A foot lifts where the table is accelerated by g a/b, before friction μ g is used up.
#[test]
fn a_box_on_a_shaken_table_begins_to_tip() {
    let table = machine(
        "machine Table in plane {
            parameters {
                M: kg = 2, I: kg*m^2 = 0.05, a: m = 0.1, b: m = 0.3, A: m = 0.1, w: rad/s = 8, mu: 1 = 1,
                g: m/s^2 = 9.81,
            }
            coordinates { x: m, y: m = b, phi: rad, der(x): m/s = A*w }
            frames { table = ground.shift(A*sin(w*t), 0) }
            bodies { box { mass: M, inertia: I, at: (x, y), angle: phi } }
            gravity (0, -g);
            contacts {
                left { point: (-a, -b), on: box, along: table, restitution: 0, friction: mu },
                right { point: (a, -b), on: box, along: table, restitution: 0, friction: mu },
            }
        }",
    );
    let (amplitude, w) = (0.1, 8.0);
    let lifts = f64::asin(G * (0.1 / 0.3) / (amplitude * w * w)) / w;
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let [explicit, by_series] =
            [Method::DOP853, &TAYLOR].map(|method| run(&table, method, (tolerance, 1.0)));
        let (t, q, _) = first(&by_series, ContactEventKind::Lifts);
        println!("{tolerance:e}: lifts {:.1e}", t - lifts);
        // What contacts do that share a load is looked for 1e-9 of a step behind the place where it is seen.
        assert!((t - lifts).abs() < 1e-9 + tolerance);
        assert!((q[0] - amplitude * f64::sin(w * t)).abs() < tolerance);
        assert_eq!(by_series.contact_events()[0].contact, "left");
        let [one, other] = [&explicit, &by_series].map(|run| run.contact_events().len());
        assert_eq!(one, other);
        assert_eq!(methods(&by_series), ["taylor"]);
    }
}

/// How three feet share the load decides about their friction, by a rule that is no part of a series: the box goes by `dop853` until it has stopped after v²/(2 μ g).
#[test]
fn a_box_that_slides_on_three_feet_goes_by_series_once_it_rests() {
    let (mu, speed) = (0.2, 2.0);
    let sliding = machine(
        "machine Sliding in plane {
            parameters { M: kg = 2, I: kg*m^2 = 0.05, a: m = 0.3, b: m = 0.1, mu: 1 = 0.2, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m = b, phi: rad, der(x): m/s = 2 }
            bodies { box { mass: M, inertia: I, at: (x, y), angle: phi } }
            gravity (0, -g);
            contacts {
                left { point: (-a, -b), on: box, along: ground, restitution: 0, friction: mu },
                middle { point: (0, -b), on: box, along: ground, restitution: 0, friction: mu },
                right { point: (a, -b), on: box, along: ground, restitution: 0, friction: mu },
            }
        }",
    );
    let run = run(&sliding, &TAYLOR, (1e-9, 2.0));
    let (t, q, _) = first(&run, ContactEventKind::Sticks);
    assert!((t - speed / (mu * G)).abs() < 1e-12);
    assert!((q[0] - speed * speed / (2.0 * mu * G)).abs() < 1e-12);
    assert_eq!(methods(&run), ["dop853", "taylor"]);
    let choices = run.choices();
    assert_eq!(choices[0].reason, MethodReason::Closed);
    assert_eq!(choices[1].reason, MethodReason::ClosedInSeries);
}

/// The slips of both corners of a slider reverse at once, where crank and rod are in line: the slider's rate is l₁ ω₁ sin(θ₁ − θ₂)/cos θ₂ if it does not turn. Held rates have errors of
/// 1e-12 of the greatest ones, 40 m/s, and l₁ ω₁ is 20 m/s. At one of these instants in each of the first two runs, the slip found there was above that.
#[test]
fn slips_of_a_slider_reverse_at_dead_centres() {
    let slider = of_library("slider_crank_clearance");
    for tolerance in [1e-5, 1e-6, 1e-9] {
        let run = run(&slider, &TAYLOR, (tolerance, 1.0));
        let events = run.contact_events().iter();
        let reversals: Vec<_> = events
            .filter(|event| event.kind == ContactEventKind::Reverses)
            .collect();
        assert!(reversals.len() >= 40, "{}", reversals.len());
        for pair in reversals.chunks(2) {
            assert_eq!(pair[0].state.t, pair[1].state.t);
            assert_ne!(pair[0].contact, pair[1].contact);
            let q = &pair[0].state.q.values;
            let between = (q[0] - q[1]).sin();
            assert!(between.abs() < 1e-11, "{between:e}");
        }
        assert_eq!(methods(&run), ["taylor"]);
        assert!(residual_of_energy(&run) < 10.0 * tolerance);
    }
}

/// Events and ends of runs by both methods at fine tolerances, and where the run goes by series.
#[test]
fn runs_with_closed_contacts_are_those_by_dop853() {
    let mut in_space = 0;
    for (name, machine, until, most) in [
        ("rocking_block", of_library("rocking_block"), 3.0, 1e-9),
        ("bowling_ball", of_library("bowling_ball"), 4.0, 1e-11),
        ("disc_over_hump", of_library("disc_over_hump"), 0.9, 1e-9),
        (
            "colliding_crusher",
            of_library("colliding_crusher"),
            0.3,
            1e-9,
        ),
        ("woodpecker", of_library("woodpecker"), 0.6, 1e-9),
        ("puck_on_slope", of_library("puck_on_slope"), 2.0, 1e-11),
        (
            "slider_crank_clearance",
            of_library("slider_crank_clearance"),
            0.1,
            1e-9,
        ),
        ("rolling", machine(ROLLING), 5.0, 1e-10),
        ("rubbing", machine(RUBBING), 5.0, 1e-10),
    ] {
        let [explicit, by_series] =
            [Method::DOP853, &TAYLOR].map(|method| run(&machine, method, (1e-13, until)));
        // Contacts that change at one instant are in any order.
        let [one, other] = [&explicit, &by_series].map(|run| {
            let mut events: Vec<_> = run.contact_events().iter().collect();
            events.sort_by(|a, b| a.contact.cmp(&b.contact));
            events
        });
        assert_eq!(one.len(), other.len(), "{name}");
        let pairs = one.iter().zip(&other);
        let of_times = pairs.map(|(a, b)| {
            assert_eq!((&a.contact, a.kind), (&b.contact, b.kind), "{name}");
            (a.state.t - b.state.t).abs()
        });
        let of_times = of_times.fold(0.0, f64::max);
        let [a, b] = [&explicit, &by_series].map(|run| run.end());
        let pairs =
            (a.q.values.iter().chain(&a.v.values)).zip(b.q.values.iter().chain(&b.v.values));
        let of_ends = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!(
            "{name}: {} events, instants differ by {of_times:.1e} s, ends by {of_ends:.1e}; {} and {} steps; {:?}",
            one.len(),
            explicit.statistics().steps,
            by_series.statistics().steps,
            methods(&by_series)
        );
        assert!(of_times < most && of_ends < 100.0 * most, "{name}");
        assert!(residual_of_energy(&by_series) < 1e-9, "{name}");
        let is_closed = |of: &lagrangian::MethodChoice| of.reason == MethodReason::ClosedInSeries;
        if name == "rolling" || name == "rubbing" {
            assert_eq!(methods(&by_series), ["taylor"], "{name}");
            assert!(
                2 * by_series.statistics().steps < explicit.statistics().steps,
                "{name}"
            );
        }
        if name == "puck_on_slope" {
            in_space += by_series
                .choices()
                .iter()
                .filter(|of| is_closed(of))
                .count();
        }
    }
    assert!(in_space > 0);
}
