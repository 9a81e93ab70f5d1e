//! Runs by Taylor series of machines with unilateral contacts: while all contacts are open a run goes by series, and otherwise too where the motion has one. Impacts, their
//! instants and the ends of runs are those of closed forms in double-doubles, and of runs by `dop853`.

use crate::support::library;
use lagrangian::interpreted::{Engine, InterpretedMachine, Named};
use lagrangian::{
    ContactEventKind, Machine, Method, MethodReason, Simulation, Solution, State, TAYLOR,
};
use lagrangian_scalar::{DoubleDouble, Scalar};

type Run = Solution<InterpretedMachine>;

/// A double pendulum before a wall, which both bobs may hit.
const WALL: &str = include_str!("../data/flights/wall.machine");

/// A ball that bounces from a floor and a ceiling that yields.
const YIELDING: &str = include_str!("../data/flights/yielding.machine");

/// The text of a machine with its series.
fn machine(text: &str) -> InterpretedMachine {
    let machine = InterpretedMachine::from_text(text).with_series().build();
    machine.unwrap_or_else(|error| panic!("{error}"))
}

fn of_library(name: &str) -> InterpretedMachine {
    machine(&library::text(&format!("contacts/{name}")))
}

fn simulation<'m>(
    machine: &'m InterpretedMachine,
    method: &'static Method,
    (tolerance, until): (f64, f64),
) -> Simulation<'m, InterpretedMachine> {
    Simulation::new(machine)
        .method(method)
        .tolerance(tolerance)
        .until(until)
        .energy_balance(true)
}

fn run(machine: &InterpretedMachine, method: &'static Method, to: (f64, f64)) -> Run {
    let run = simulation(machine, method, to).run(machine.start());
    run.unwrap_or_else(|error| panic!("{error}"))
}

/// The methods of a run, one after the other.
fn methods(run: &Run) -> Vec<&'static str> {
    let choices = run.choices().iter();
    choices.map(|choice| choice.method.tableau.name).collect()
}

/// How far the instants of contact events and the ends of two runs are apart, which must have the same events in the same order.
fn distance(one: &Run, other: &Run) -> [f64; 2] {
    let [events, others] = [one, other].map(Solution::contact_events);
    assert_eq!(events.len(), others.len());
    let mut of_times = 0.0_f64;
    for (one, other) in events.iter().zip(others) {
        assert_eq!((&one.contact, one.kind), (&other.contact, other.kind));
        of_times = of_times.max((one.state.t - other.state.t).abs());
    }
    [of_times, distance_of_states(one.end(), other.end())]
}

fn distance_of_states(one: &State<Named>, other: &State<Named>) -> f64 {
    let numbers = |of: &State<Named>| [of.q.values.clone(), of.v.values.clone()].concat();
    let pairs = numbers(one).into_iter().zip(numbers(other));
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// A step by series in free fall is as long as the flight, and exact to rounding at every tolerance.
#[test]
fn a_bouncing_ball_rests_when_its_bounces_are_over() {
    let ball = of_library("bouncing_ball");
    let (h, e, g) = (1.0, 0.8, 9.81);
    let fall: f64 = f64::sqrt(2.0 * h / g);
    for tolerance in [1e-4, 1e-8, 1e-12] {
        let run = run(&ball, &TAYLOR, (tolerance, 6.0));
        let impacts = run.contact_events().iter();
        let impacts = impacts.filter(|event| event.kind == ContactEventKind::Impact);
        let (mut t, mut flight, mut count) = (fall, 2.0 * e * fall, 0);
        for impact in impacts {
            // An impact has the rounding of its own time and of those before it, which the rate does not magnify.
            assert!(
                (impact.state.t - t).abs() < 1e-14 * f64::from(3 + count),
                "{t}"
            );
            (t, flight, count) = (t + flight, e * flight, count + 1);
        }
        assert!(count > 50, "{count}");
        let over = fall * (1.0 + e) / (1.0 - e);
        let rests = run.contact_events().last().expect("it comes to rest");
        assert_eq!(rests.kind, ContactEventKind::Closes);
        assert!((rests.state.t - over).abs() <= rests.time_error + 1e-13);
        assert_eq!(methods(&run), ["taylor"]);
        assert_eq!(run.choices()[0].reason, MethodReason::Open);
        assert!(run.choices()[0].t == 0.0);
        let residual = run
            .energy_balance()
            .map_or(f64::NAN, |balance| balance.residual());
        assert!(residual.abs() < 1e-14, "{residual:e}");
        // Between impacts: 0.3 of the way of the second flight.
        let at = fall * (1.0 + 0.6 * e);
        let (speed, after) = (e * g * fall, 0.6 * e * fall);
        let y = speed * after - 0.5 * g * after * after;
        assert!((run.at(at).unwrap().q.values[0] - y).abs() < 1e-14);
    }
}

/// Positions and rates of a driven oscillator without damper in flights, in closed form, and its impacts by Newton's method, in double-doubles.
struct Oscillator {
    /// Time, position and rate at the last impact, or at the start.
    t: DoubleDouble,
    x: DoubleDouble,
    v: DoubleDouble,
}

impl Oscillator {
    const STOP: f64 = -0.2;
    const RESTITUTION: f64 = 0.8;
    const DRIVE: f64 = 2.8;

    fn at(&self, t: DoubleDouble) -> [DoubleDouble; 2] {
        let number = DoubleDouble::from_f64;
        let (own, drive) = (number(2.0), number(Self::DRIVE));
        let forced = number(1.0) / (own * own - drive * drive);
        let [(sin_then, cos_then), (sin_now, cos_now)] = [self.t, t].map(|t| (drive * t).sin_cos());
        let a = self.x - forced * cos_then;
        let b = (self.v + forced * drive * sin_then) / own;
        let (sin, cos) = (own * (t - self.t)).sin_cos();
        [
            a * cos + b * sin + forced * cos_now,
            own * (b * cos - a * sin) - forced * drive * sin_now,
        ]
    }

    /// Goes through the next impact and returns its time.
    fn bounce(&mut self) -> f64 {
        let number = DoubleDouble::from_f64;
        let mut ahead = 1e-3;
        while self.at(self.t + number(ahead))[0].to_f64() > Self::STOP {
            ahead += 1e-3;
        }
        let mut t = self.t + number(ahead);
        for _ in 0..6 {
            let [x, v] = self.at(t);
            t = t - (x - number(Self::STOP)) / v;
        }
        let [_, v] = self.at(t);
        *self = Self {
            t,
            x: number(Self::STOP),
            v: number(-Self::RESTITUTION) * v,
        };
        t.to_f64()
    }
}

#[test]
fn an_impact_oscillator_bounces_when_closed_forms_say() {
    let mut oscillator = of_library("impact_oscillator");
    for (name, value) in [("F", 1.0), ("stop", Oscillator::STOP)] {
        oscillator.set(name, value).unwrap();
    }
    let until = 40.0;
    for (tolerance, most) in [(1e-6, 1e-5), (1e-9, 1e-8), (1e-12, 1e-11), (1e-14, 1e-12)] {
        let run = run(&oscillator, &TAYLOR, (tolerance, until));
        let number = DoubleDouble::from_f64;
        let mut exact = Oscillator {
            t: number(0.0),
            x: number(1.0),
            v: number(0.0),
        };
        let mut worst = 0.0_f64;
        for event in run.contact_events() {
            assert_eq!(event.kind, ContactEventKind::Impact);
            worst = worst.max((event.state.t - exact.bounce()).abs());
        }
        let [x, v] = exact.at(number(until)).map(|number| number.to_f64());
        let end = run.end();
        worst = worst
            .max((end.q.values[0] - x).abs())
            .max((end.v.values[0] - v).abs());
        println!(
            "{tolerance:e}: {} impacts, {} steps, error {worst:.1e}",
            run.contact_events().len(),
            run.statistics().steps
        );
        assert!(run.contact_events().len() > 15);
        assert!(worst < most, "{tolerance:e}: {worst:e}");
        assert_eq!(methods(&run), ["taylor"]);
        let balance = run.energy_balance().unwrap();
        assert!(balance.residual().abs() < 100.0 * tolerance, "{balance:?}");
    }
}

/// Both methods have the same impacts: at fine tolerances their instants differ by what either may err.
#[test]
fn impacts_are_those_of_runs_by_dop853() {
    let wall = machine(WALL);
    let yielding = machine(YIELDING);
    let crusher = of_library("colliding_crusher");
    let woodpecker = of_library("woodpecker");
    let cradle = of_library("newtons_cradle");
    let pair = of_library("impact_pair");
    for (name, machine, until, most) in [
        ("wall", &wall, 3.0, 1e-9),
        ("yielding", &yielding, 3.0, 1e-9),
        ("crusher", &crusher, 0.4, 1e-9),
        ("woodpecker", &woodpecker, 0.6, 1e-9),
        ("cradle", &cradle, 4.0, 1e-13),
        ("pair", &pair, 3.0, 1e-13),
    ] {
        let explicit = run(machine, Method::DOP853, (1e-13, until));
        let by_series = run(machine, &TAYLOR, (1e-13, until));
        let [of_times, of_ends] = distance(&explicit, &by_series);
        println!(
            "{name}: {} events, instants differ by {of_times:.1e} s and ends by {of_ends:.1e}, {:?}",
            explicit.contact_events().len(),
            by_series.choices().len()
        );
        assert!(!explicit.contact_events().is_empty(), "{name}");
        assert!(of_times < most && of_ends < 100.0 * most, "{name}");
        assert!(explicit.choices().is_empty());
        for choice in by_series.choices() {
            let expected = match choice.reason {
                MethodReason::Open | MethodReason::ClosedInSeries => "taylor",
                _ => "dop853",
            };
            assert_eq!(choice.method.tableau.name, expected, "{name}");
        }
        let [one, other] = [&explicit, &by_series].map(|run| run.energy_balance().unwrap());
        let exchanged = one.exchanged.max(1e-3);
        for balance in [one, other] {
            assert!(
                balance.residual().abs() < 1e-9 * exchanged,
                "{name}: {balance:?}"
            );
        }
        // Losses of each contact are the same.
        assert!(
            (one.dissipated - other.dissipated).abs() < 1e-7 * exchanged,
            "{name}"
        );
    }
    let by_series = run(&yielding, &TAYLOR, (1e-9, 3.0));
    let has = |reason| {
        by_series
            .choices()
            .iter()
            .any(|choice| choice.reason == reason)
    };
    assert!(has(MethodReason::Open) && has(MethodReason::Closed));
}

/// Powers of contacts that were closed before a flight are not those of the flight, in a machine that has none of its own.
#[test]
fn energies_balance_where_flights_follow_friction() {
    for (name, until) in [("dropped_box", 1.0), ("woodpecker", 1.0), ("dimer", 1.0)] {
        let machine = of_library(name);
        let run = run(&machine, &TAYLOR, (1e-10, until));
        assert!(methods(&run).contains(&"taylor"));
        // Corners of a box that slip in space have no series; the two ends on a plate that stick share their load, and have one.
        assert_eq!(methods(&run).contains(&"dop853"), name == "dropped_box");
        let balance = run.energy_balance().unwrap();
        assert!(
            balance.residual().abs() < 1e-8 * balance.exchanged,
            "{name}: {balance:?}"
        );
        assert!(
            run.warnings()
                .iter()
                .all(|of| !of.to_string().contains("energ"))
        );
    }
}

/// A run that comes to rest hands over to time stepping and returns, whose steps are kept beside those by series.
#[test]
fn a_pile_hands_over_to_time_stepping() {
    let text = library::text("contacts/pile").replace("N = 20", "N = 8");
    let pile = machine(&text);
    let made = |method| {
        let run = simulation(&pile, method, (1e-8, 0.6)).hand_over();
        run.run(pile.start()).unwrap()
    };
    let (explicit, by_series) = (made(Method::DOP853), made(&TAYLOR));
    println!("{:?} {:?}", explicit.handovers(), by_series.handovers());
    assert!(methods(&by_series).contains(&"taylor"));
    assert_eq!(
        explicit.handovers().is_empty(),
        by_series.handovers().is_empty()
    );
    for k in 0..=60 {
        let t = 0.01 * f64::from(k);
        let [one, other] = [&explicit, &by_series].map(|run| run.at(t).unwrap());
        // Before the first impact they are the same; afterwards a pile is sensitive.
        let most = if t < 0.05 { 1e-7 } else { 0.5 };
        let heights = one.q.values.iter().zip(&other.q.values);
        assert!(
            heights.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < most,
            "{t}"
        );
    }
}

/// The series of a damper whose force depends on the speed's root has no value at rest; the flight begins with `dop853`.
#[test]
fn a_flight_without_a_series_goes_by_dop853() {
    let dragged = machine(
        "machine Dragged in plane {
            parameters { m: kg = 1, e: 1 = 0.5, area: m^2 = 0.1, rho: kg/m^3 = 1.2, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m = 2, der(x): m/s = 1, der(y): m/s = 3 }
            bodies { ball { mass: m, at: (x, y) } }
            gravity (0, -g);
            drag { air { at: ball.at, coefficient: 0.5, area: area, density: rho } }
            contacts { floor { gap: y, slip: der(x), restitution: e, friction: 10 } }
        }",
    );
    for start_at_rest in [false, true] {
        let mut start = dragged.start();
        if start_at_rest {
            start.v.values.fill(0.0);
        }
        let made = |method| {
            let run = simulation(&dragged, method, (1e-11, 2.0)).run(start.clone());
            run.unwrap_or_else(|error| panic!("{}, {start_at_rest}: {error}", method.tableau.name))
        };
        let (explicit, by_series) = (made(Method::DOP853), made(&TAYLOR));
        let [of_times, of_ends] = distance(&explicit, &by_series);
        assert!(
            of_times < 1e-8 && of_ends < 1e-8,
            "{of_times:e} {of_ends:e}"
        );
        let fails = |of: &lagrangian::MethodChoice| of.reason == MethodReason::NoSeries;
        assert_eq!(by_series.choices().iter().any(fails), start_at_rest);
    }
}

/// In free fall the error of a series allows steps of any length, but a thin peg on the way is met all the same, on the way up or down.
#[test]
fn a_ball_does_not_miss_a_peg_in_a_long_flight() {
    let g = 9.81;
    for (rate, at) in [
        (19.0, 0.7),
        (19.0, 3.1),
        (31.0, 0.2),
        (31.0, 6.0),
        (3.0, 0.5),
        (3.0, 2.0),
    ] {
        let height = |t: f64| rate * t - 0.5 * g * t * t;
        // It passes the middle at 2 cm.
        let peg = [at + 0.02, height(at)];
        let ball = machine(&format!(
            "machine Thrown in plane {{
                parameters {{ m: kg = 1, g: m/s^2 = {g} }}
                coordinates {{ x: m, y: m, der(x): m/s = 1, der(y): m/s = {rate} }}
                bodies {{ ball {{ mass: m, at: (x, y) }} }}
                gravity (0, -g);
                contacts {{ peg {{ gap: sqrt((x - {:?})^2 + (y - {:?})^2) - 0.05, restitution: 1 }} }}
            }}",
            peg[0], peg[1]
        ));
        let gap = |t: f64| f64::hypot(t - peg[0], height(t) - peg[1]) - 0.05;
        let (mut before, mut after) = (0.0, 0.0);
        while gap(after) > 0.0 {
            (before, after) = (after, after + 1e-4);
        }
        while after - before > 1e-15 * after {
            let middle = 0.5 * (before + after);
            if middle == before || middle == after {
                break;
            }
            *(if gap(middle) > 0.0 {
                &mut before
            } else {
                &mut after
            }) = middle;
        }
        for tolerance in [1e-4, 1e-9] {
            let run = run(&ball, &TAYLOR, (tolerance, 100.0));
            let impact = run.contact_events().first();
            let t = impact.map_or(f64::NAN, |impact| impact.state.t);
            assert!(
                (t - after).abs() < 1e-12 * after.max(1.0),
                "{rate} {at} {tolerance:e}: {t} {after}"
            );
        }
    }
}

/// Lanes give the bits of single runs.
#[test]
fn flights_in_lanes_have_the_bits_of_single_runs() {
    for text in [WALL, YIELDING, &library::text("contacts/woodpecker")] {
        let mut machine = machine(text);
        if machine.set_engine(Engine::Jit).is_err() {
            return;
        }
        let machines: Vec<_> = (0..11)
            .map(|k| {
                let mut one = machine.clone();
                one.set("e", 0.5 + 0.03 * f64::from(k)).unwrap();
                one
            })
            .collect();
        let of = |machine| simulation(machine, &TAYLOR, (1e-9, 1.0));
        let runs = machines
            .iter()
            .map(|machine| (of(machine), machine.start()));
        let together = Simulation::run_interpreted_in_lanes(runs.collect());
        for (machine, made) in machines.iter().zip(together) {
            let (run, error) = made.unwrap();
            let alone = of(machine).run(machine.start()).unwrap();
            assert!(error.is_none());
            assert_eq!(run.end(), alone.end());
            assert_eq!(run.contact_events(), alone.contact_events());
            assert_eq!(run.energies(), alone.energies());
            assert_eq!(methods(&run), methods(&alone));
        }
    }
}

/// A run that chooses its method goes on by series in flights where that costs less, and ends where other runs do.
#[test]
fn a_run_that_chooses_goes_by_series_in_flights() {
    let mut oscillator = of_library("impact_oscillator");
    for (name, value) in [("F", 1.0), ("stop", Oscillator::STOP)] {
        oscillator.set(name, value).unwrap();
    }
    let made = |until: f64| {
        let run = Simulation::new(&oscillator).tolerance(1e-11).automatic();
        run.until(until).run(oscillator.start()).unwrap()
    };
    let short = made(0.5);
    assert_eq!(methods(&short), ["dop853"]);
    let long = made(40.0);
    assert_eq!(methods(&long), ["dop853", "taylor"]);
    let reason = long.choices()[1].reason;
    assert!(
        matches!(reason, MethodReason::SeriesPays { cost, saved } if cost < saved),
        "{reason:?}"
    );
    let explicit = run(&oscillator, Method::DOP853, (1e-11, 40.0));
    let [of_times, of_ends] = distance(&explicit, &long);
    assert!(
        of_times < 1e-8 && of_ends < 1e-8,
        "{of_times:e} {of_ends:e}"
    );
    assert!(3 * long.statistics().evaluations < explicit.statistics().evaluations);
}

/// A machine whose contacts are closed for good, in a way that has no series, costs what it costs by `dop853`.
#[test]
fn what_never_flies_goes_by_dop853() {
    let ball = of_library("ball_in_turning_bowl");
    let [explicit, by_series] = [Method::DOP853, &TAYLOR].map(|of| run(&ball, of, (1e-9, 1.0)));
    assert_eq!(methods(&by_series), ["dop853"]);
    assert_eq!(explicit.end(), by_series.end());
    assert_eq!(explicit.statistics().steps, by_series.statistics().steps);
}
