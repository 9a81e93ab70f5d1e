//! Machines driven by tables, tested against closed forms; and tables, tested against their definitions.

use crate::by_hand::toy::Toy;
use lagrangian::{
    Crossing, Error, Extrapolation, Interpolation, METHODS, Method, Piece, Simulation, State,
    Table, TableError,
};

/// A mass of 1 kg pushed by a force.
fn mass() -> Toy<1> {
    Toy {
        work_rate: |_, _, v, u, _| u * v[0],
        ..Toy::new(([0.25], [-0.5]), |_, _, _, u, _| [u])
    }
}

/// A mass of 1 kg on a spring of 9 N/m, pushed by a force.
fn oscillator() -> Toy<1> {
    Toy {
        potential_energy: |q, _| 4.5 * q[0] * q[0],
        work_rate: |_, _, v, u, _| u * v[0],
        ..Toy::new(([0.25], [-0.5]), |_, q, _, u, _| [u - 9.0 * q[0]])
    }
}

const TIMES: [f64; 6] = [0.0, 0.31, 0.77, 1.0, 1.83, 2.4];
const VALUES: [f64; 6] = [1.0, -2.0, 3.5, 0.25, 0.25, -4.0];

/// Pseudorandom numbers from a linear congruential generator.
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn seed() -> u64 {
    let clock = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    let clock = clock.map_or(1, |since| since.as_nanos() as u64);
    let seed = std::env::var("SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    let seed = seed.unwrap_or(clock);
    println!("SEED={seed}");
    seed
}

/// Position and velocity of the mass under a piecewise linear force: the integrals of that force.
fn pushed(t: f64) -> [f64; 2] {
    let [mut x, mut v] = [0.25, -0.5];
    for (row, from) in TIMES.iter().enumerate() {
        let to = TIMES.get(row + 1).copied().unwrap_or(f64::INFINITY);
        let value = VALUES[row];
        let slope = VALUES
            .get(row + 1)
            .map_or(0.0, |next| (next - value) / (to - from));
        let h = t.min(to) - from;
        x += v * h + value * h * h / 2.0 + slope * h * h * h / 6.0;
        v += value * h + slope * h * h / 2.0;
        if t <= to {
            break;
        }
    }
    [x, v]
}

/// Position and velocity are cubic and quadratic between knots. Every method is exact for these at any tolerance
/// if its steps end at the knots.
#[test]
fn a_mass_under_a_force_on_straight_lines_moves_on_cubics() {
    let mass = mass();
    for method in &METHODS {
        let name = method.tableau.name;
        let table = Table::linear(TIMES, VALUES).unwrap();
        let run = Simulation::new(&mass)
            .method(method)
            .tolerance(1e-4)
            .until(3.0)
            .energy_balance(true)
            .every(0.1)
            .event("where it was", Crossing::Any, |state| state.q[0] - 0.1)
            .table(table.clone(), |u, value| *u = value)
            .run(mass.start())
            .unwrap();
        // The bound allows for sums of a hundred terms of size 1 and for the iteration of implicit methods.
        let off = |state: &State<[f64; 1]>| {
            let [x, v] = pushed(state.t);
            (state.q[0] - x).abs().max((state.v[0] - v).abs())
        };
        let rounding = if method.tableau.spectrum.is_some() {
            1e-9
        } else {
            1e-13
        };
        for state in run.samples().iter().chain([run.end()]) {
            assert!(off(state) < rounding, "{name} {state:?}: {:e}", off(state));
        }
        for t in TIMES.into_iter().chain([0.5, 0.9, 1.4, 2.9]) {
            let state = run.at(t).unwrap();
            assert!(off(&state) < rounding, "{name} {t}: {:e}", off(&state));
            assert_eq!(run.observe(t).unwrap().inputs, table.value(t), "{name} {t}");
        }
        assert!(!run.events().is_empty());
        for event in run.events() {
            assert!(
                (pushed(event.state.t)[0] - 0.1).abs() < 10.0 * rounding,
                "{name}"
            );
        }
        let balance = run.energy_balance().unwrap();
        assert!(
            balance.residual().abs() < 10.0 * rounding,
            "{name} {balance:?}"
        );
        // The run backward in time.
        let back = Simulation::new(&mass)
            .method(method)
            .tolerance(1e-4)
            .until(0.0)
            .table(table, |u, value| *u = value)
            .run(*run.end())
            .unwrap();
        assert!((back.end().q[0] - 0.25).abs() < 10.0 * rounding, "{name}");
        assert!((back.at(1.4).unwrap().v[0] - pushed(1.4)[1]).abs() < 10.0 * rounding);
        assert_eq!(back.observe(1.83).unwrap().inputs, 0.25);
    }
}

/// The oscillator under a piecewise constant force: x = u/9 + C cos 3τ + S sin 3τ from each knot on.
fn held(t: f64) -> [f64; 2] {
    let [mut x, mut v] = [0.25, -0.5];
    for (row, from) in TIMES.iter().enumerate() {
        let to = TIMES.get(row + 1).copied().unwrap_or(f64::INFINITY);
        let (middle, tau) = (VALUES[row] / 9.0, t.min(to) - from);
        let (c, s) = (x - middle, v / 3.0);
        let (sin, cos) = (3.0 * tau).sin_cos();
        [x, v] = [middle + c * cos + s * sin, 3.0 * (s * cos - c * sin)];
        if t <= to {
            break;
        }
    }
    [x, v]
}

/// The error at the end with steps of at most `h` and a tolerance so coarse that it rejects none.
fn error_of(method: &'static Method, h: f64, lands: bool) -> f64 {
    let machine = oscillator();
    let table = Table::hold(TIMES, VALUES).unwrap();
    let simulation = Simulation::new(&machine)
        .method(method)
        .tolerance(0.9)
        .first_step(h)
        .longest_step(h)
        .until(2.7);
    let end = if lands {
        let simulation = simulation.table(table, |u, value| *u = value);
        *simulation.run(machine.start()).unwrap().end()
    } else {
        let simulation = simulation.inputs(move |t, _, _, u| *u = table.value(t));
        *simulation.run(machine.start()).unwrap().end()
    };
    let [x, v] = held(2.7);
    (end.q[0] - x).abs().max((end.v[0] - v).abs())
}

/// Halving the steps divides the error by 2 to the power of the order, although the force jumps ten times on the way. Steps that
/// do not end at the jumps are of first order.
#[test]
fn every_method_keeps_its_order_across_jumps() {
    for (method, h) in [
        (Method::BS32, 0.02),
        (Method::DOPRI5, 0.04),
        (Method::DOP853, 0.15),
        (Method::RADAU5, 0.1),
    ] {
        let order = f64::from(method.tableau.order);
        let [one, half] = [h, h / 2.0].map(|h| error_of(method, h, true));
        let found = (one / half).log2();
        // Knots cut steps, so the pieces are not exactly halved.
        assert!(found > order - 0.7, "{}: {found}", method.tableau.name);
        // Where in a step a jump falls is chance, so errors with several step lengths are added.
        let together = |h: f64| {
            [1.0, 0.93, 0.87]
                .map(|share| error_of(method, share * h, false))
                .iter()
                .sum::<f64>()
        };
        let found = (together(h) / together(h / 7.7)).log2() / 7.7_f64.log2();
        assert!(
            found < 2.0,
            "{} without landing: {found}",
            method.tableau.name
        );
    }
}

/// The force is one cubic polynomial between two knots, so the mass moves on a polynomial of degree five, and a spline through
/// values of a cubic reproduces that cubic.
#[test]
fn a_spline_finds_a_cubic_again_and_the_mass_its_quintic() {
    let cubic = |t: f64| 1.0 + t * (-2.0 + t * (0.5 + t * 0.75));
    let table = Table::cubic(TIMES, TIMES.map(cubic)).unwrap();
    for t in [0.0, 0.1, 0.31, 0.6, 1.7, 2.39, 2.4] {
        assert!((table.value(t) - cubic(t)).abs() < 1e-14, "{t}");
    }
    let mass = mass();
    for method in [Method::DOPRI5, Method::DOP853, Method::BS32] {
        let run = Simulation::new(&mass)
            .method(method)
            .tolerance(1e-8)
            .until(2.4)
            .table(table.clone(), |u, value| *u = value)
            .run(mass.start())
            .unwrap();
        let t = 2.4_f64;
        let x = 0.25 - 0.5 * t + t * t / 2.0 - t.powi(3) / 3.0
            + 0.5 * t.powi(4) / 12.0
            + 0.75 * t.powi(5) / 20.0;
        let bound = if method.tableau.order < 5 {
            1e-6
        } else {
            1e-13
        };
        assert!(
            (run.end().q[0] - x).abs() < bound,
            "{}",
            method.tableau.name
        );
        // A method of low order, which loses no order at inner knots, does not stop there.
        let ends: Vec<f64> = run.steps().map(|state| state.t).collect();
        let lands = TIMES.iter().all(|knot| ends.contains(knot));
        assert_eq!(lands, method.tableau.order >= 5, "{}", method.tableau.name);
    }
}

/// Tests the definition of the splines: the values at knots, two continuous derivatives, and a third derivative that is
/// continuous at the second and the last but one knot; for periodic tables, periodicity instead of that last condition.
#[test]
fn splines_are_smooth() {
    let mut random = noise(seed());
    for round in 0..60 {
        let count = 4 + round % 9;
        let mut t = -1.0;
        let times: Vec<f64> = (0..count)
            .map(|_| {
                t += 0.2 + random();
                t
            })
            .collect();
        let mut values: Vec<f64> = (0..count).map(|_| random() - 0.5).collect();
        let repeats = round % 2 == 1;
        let beyond = if repeats {
            Extrapolation::Repeat
        } else {
            Extrapolation::Hold
        };
        if repeats {
            values[count - 1] = values[0];
        }
        let table =
            Table::new(Interpolation::Cubic, beyond, times.clone(), values.clone()).unwrap();
        // The derivatives of the cubic on an interval, at one of its ends, from four of its values.
        let derivatives = |row: usize, at_end: bool| {
            let (from, h) = (times[row], times[row + 1] - times[row]);
            let piece = Piece {
                from,
                to: times[row + 1],
                jumps: false,
            };
            let y = [0.0, 1.0, 2.0, 3.0].map(|third: f64| {
                let value = table.value_in(piece, from + h * third / 3.0);
                // The ends belong to two intervals, and their values are those of the rows.
                match third {
                    0.0 => values[row],
                    3.0 => values[row + 1],
                    _ => value,
                }
            });
            let x = if at_end { 3.0 } else { 0.0 };
            let (d1, d2, d3) = (
                y[1] - y[0],
                y[2] - 2.0 * y[1] + y[0],
                y[3] - 3.0 * y[2] + 3.0 * y[1] - y[0],
            );
            let step = h / 3.0;
            // Newton's form of the interpolation polynomial in s = 3 (t − from)/h.
            let first = d1 + d2 * (2.0 * x - 1.0) / 2.0 + d3 * (3.0 * x * x - 6.0 * x + 2.0) / 6.0;
            let second = d2 + d3 * (x - 1.0);
            [first / step, second / (step * step), d3 / step.powi(3)]
        };
        for (time, value) in times.iter().zip(&values) {
            assert!((table.value(*time) - value).abs() < 1e-14);
        }
        let inner = (1..count - 1).map(|row| (row - 1, row));
        let ring = repeats.then_some((count - 2, 0));
        for (before, after) in inner.chain(ring) {
            let (left, right) = (derivatives(before, true), derivatives(after, false));
            for (one, other) in left.iter().zip(right).take(2) {
                let scale = 1e-10 * (1.0 + one.abs());
                assert!((one - other).abs() < scale, "{left:?} {right:?}");
            }
            let is_not_a_knot = !repeats && (before == 0 || after == count - 2);
            if is_not_a_knot {
                assert!((left[2] - right[2]).abs() < 1e-7 * (1.0 + left[2].abs()));
            }
        }
    }
}

/// A table that repeats gives the same run as the same rows written out.
#[test]
fn what_repeats_is_the_same_as_written_out() {
    let machine = oscillator();
    for between in [Interpolation::Hold, Interpolation::Linear] {
        for start in [-3.3, 0.0, 0.1, 0.7] {
            let times = [start, start + 0.31, start + 0.7];
            let table =
                Table::new(between, Extrapolation::Repeat, times, [1.0, -2.0, 3.0]).unwrap();
            let (mut rows, mut values) = (Vec::new(), Vec::new());
            for round in -10..15 {
                let from = start + f64::from(round) * 0.7;
                let last = from + 0.7 - 1e-9;
                rows.extend([from, from + 0.31, last]);
                // The value jumps at the end of a round; with `Hold` the last value is not used.
                values.extend(match between {
                    Interpolation::Hold => [1.0, -2.0, -2.0],
                    _ => [1.0, -2.0, 3.0],
                });
            }
            let long = Table::new(between, Extrapolation::Hold, rows, values).unwrap();
            for until in [3.9, -2.6] {
                let ends = [&table, &long].map(|table| {
                    let run = Simulation::new(&machine)
                        .tolerance(1e-11)
                        .until(until)
                        .table(table.clone(), |u, value| *u = value)
                        .run(machine.start());
                    *run.unwrap().end()
                });
                // The difference is a force of 5 N for 1e-9 s, six times.
                let off = (ends[0].v[0] - ends[1].v[0]).abs();
                assert!(off < 4e-8, "{between:?} {start} {until}: {off:e}");
            }
            // Values on either side of each jump, although rounding shifts its time: the period is known to 4e-16 s.
            for round in 0..40_i32 {
                let t = start + f64::from(round) * 0.7;
                let piece = table.piece(t + 0.01, true, 8).unwrap();
                assert!((piece.from - t).abs() < 1e-13 && (piece.to - t - 0.31).abs() < 1e-13);
                let entered = table.piece(piece.from, true, 8).unwrap();
                assert_eq!(entered, piece, "{round}");
                assert!(piece.jumps);
                assert_eq!(table.value_in(piece, piece.from).round(), 1.0);
                let before = table.piece(piece.from, false, 8).unwrap();
                assert_eq!(before.to, piece.from);
                let left = table.value_in(before, before.to);
                let known = if between == Interpolation::Hold {
                    -2.0
                } else {
                    3.0
                };
                assert!((left - known).abs() < 1e-12, "{round} {left}");
            }
        }
    }
    let ring = Table::new(
        Interpolation::Cubic,
        Extrapolation::Repeat,
        [0.0, 0.2, 0.5, 1.0],
        [0.0, 1.0, -1.0, 0.0],
    );
    let ring = ring.unwrap();
    assert!((ring.value(7.35) - ring.value(0.35)).abs() < 1e-13);
}

#[test]
fn a_run_ends_with_the_table_that_ends() {
    let mass = mass();
    let table = Table::linear(TIMES, VALUES)
        .unwrap()
        .with_extrapolation(Extrapolation::Error);
    let table = table.unwrap().named("the table push.csv");
    let run = |until: f64| {
        let simulation = Simulation::new(&mass).until(until);
        let simulation = simulation.table(table.clone(), |u, value| *u = value);
        simulation.run_as_far_as_possible(mass.start())
    };
    let (run_to_end, error) = run(2.4).unwrap();
    assert_eq!((run_to_end.end().t, error), (2.4, None));
    let (broken, error) = run(2.5).unwrap();
    assert_eq!(broken.end().t, 2.4);
    assert!((broken.end().q[0] - pushed(2.4)[0]).abs() < 1e-13);
    let said = error.unwrap().to_string();
    assert!(
        said.contains("the table push.csv covers only a part of the run") && said.contains("2.4 s"),
        "{said}"
    );
    // Backward in time, the table ends at its first row.
    assert!(matches!(run(-1.0), Err(Error::InputEnded { t: 0.0, .. })));
    assert!(table.value(2.5).is_nan());
    // A table whose period is too short for the resolution of the run's time is refused.
    let fast = Table::linear([0.0, 1e-9, 3e-9], [0.0, 1.0, 0.0]).unwrap();
    let fast = fast.with_extrapolation(Extrapolation::Repeat).unwrap();
    assert!(fast.piece(1e-3, true, 8).is_ok() && fast.piece(1e9, true, 8).is_err());
}

#[test]
fn what_is_no_table_is_refused() {
    let linear = |times: &[f64], values: &[f64]| Table::linear(times, values).map(|_| ());
    assert_eq!(linear(&[], &[]), Err(TableError::Empty));
    assert_eq!(
        linear(&[0.0], &[1.0, 2.0]),
        Err(TableError::Lengths {
            times: 1,
            values: 2
        })
    );
    assert_eq!(
        linear(&[0.0, 0.0], &[1.0, 2.0]),
        Err(TableError::NotLater { row: 1 })
    );
    assert_eq!(
        linear(&[0.0, f64::NAN], &[1.0, 2.0]),
        Err(TableError::NotFinite { row: 1 })
    );
    assert_eq!(linear(&[0.0], &[1.0]), Ok(()));
    let one = Table::linear([0.0], [1.0]).unwrap();
    assert_eq!(
        one.clone().with_extrapolation(Extrapolation::Repeat),
        Err(TableError::NoPeriod)
    );
    assert_eq!([-5.0, 0.0, 5.0].map(|t| one.value(t)), [1.0; 3]);
    let cubic = Table::cubic([0.0, 1.0], [1.0, 2.0]).unwrap();
    assert_eq!(
        cubic.with_extrapolation(Extrapolation::Repeat),
        Err(TableError::NotPeriodic)
    );
    let steep = Table::cubic([0.0, 1e-300, 2e-300], [0.0, 1e100, 0.0]);
    assert_eq!(steep, Err(TableError::TooSteep));
}

/// With a table beside a sampled controller, one input is the sum of what both set.
#[test]
fn a_table_stands_beside_a_controller() {
    use lagrangian::interpreted::{InterpretedMachine, Signal, SignalError, Signals};
    let text = "machine Pushed in plane {
        parameters { mass: kg = 1 }
        coordinates { x: m = 0.7 }
        inputs { hand: N, wind: N, both: N, off: N = 3 }
        bodies { block { mass: mass, at: (x, 0) } }
        forces { all { on: x, value: hand + wind } }
        outputs {
            law: N = -3*N/m*x - 2.5*N*s/m*der(x), sum: N = hand + wind, twice: N = 2*both, own: N = hand + both, a: N = mass*der(der(x)),
            constant: N = 7*off
        }
    }";
    let machine = InterpretedMachine::from_text(text).build().unwrap();
    let wind = || {
        Signal::Table(
            Table::hold([0.0, 0.35, 0.8], [1.0, -2.0, 0.5])
                .unwrap()
                .into(),
        )
    };
    let signals = Signals::new(&machine, [(1, wind()), (2, Signal::Output(1))]).unwrap();
    assert_eq!(signals.first_varying(), None);
    let signals = signals
        .and_sampled(&machine, [(0, Signal::Output(0))], [0.1, 0.03])
        .unwrap();
    let simulation = Simulation::new(&machine).until(0.995).energy_balance(true);
    let run = signals
        .drive(simulation, &machine)
        .run(lagrangian::Machine::start(&machine));
    let run = run.unwrap();
    // The motion by hand: constant forces between the instants at which one of them changes.
    let [mut x, mut v, mut hand, mut now] = [0.7, 0.0, 0.0, 0.0_f64];
    let mut pending = Vec::new();
    let wind_at = |t: f64| {
        if t < 0.35 {
            1.0
        } else if t < 0.8 {
            -2.0
        } else {
            0.5
        }
    };
    let mut instants: Vec<f64> = (0..10)
        .flat_map(|k| [0.1 * f64::from(k), 0.1 * f64::from(k) + 0.03])
        .collect();
    instants.extend([0.35, 0.8 - 1e-13, 0.995]);
    instants.sort_by(f64::total_cmp);
    for t in instants {
        let (h, a) = (t - now, hand + wind_at(0.5 * (now + t)));
        (x, v, now) = (x + v * h + a * h * h / 2.0, v + a * h, t);
        let ticks = t / 0.1;
        if (ticks - ticks.round()).abs() < 1e-9 {
            pending.push(-3.0 * x - 2.5 * v);
        } else if (ticks - 0.3 - (ticks - 0.3).round()).abs() < 1e-9 {
            hand = pending.pop().unwrap();
        }
    }
    assert!(
        (run.end().q.values[0] - x).abs() < 1e-12,
        "{} {x}",
        run.end().q.values[0]
    );
    assert!((run.end().v.values[0] - v).abs() < 1e-12);
    assert!(run.energy_balance().unwrap().residual().abs() < 1e-12);
    let seen = run.observe(0.9).unwrap().inputs;
    assert_eq!(seen.values[1], 0.5);
    assert_eq!(seen.values[2], seen.values[0] + seen.values[1]);
    // Signals that depend on themselves are refused, whatever their order.
    let circle = Signals::new(&machine, [(0, Signal::Output(2)), (2, Signal::Output(3))]);
    let names = ["hand", "both"].map(String::from).to_vec();
    assert_eq!(circle.unwrap_err(), SignalError::Circle(names));
    let own = Signals::new(&machine, [(1, wind()), (0, Signal::Output(1))]);
    assert_eq!(own.unwrap_err(), SignalError::Circle(vec!["hand".into()]));
    let accelerations = Signals::new(&machine, [(0, Signal::Output(4))]).unwrap_err();
    assert_eq!(accelerations, SignalError::Accelerations("hand".into()));
    let twice = Signals::new(&machine, [(1, wind()), (1, wind())]).unwrap_err();
    assert_eq!(twice, SignalError::Twice("wind".into()));
    let constant = Signals::new(&machine, [(0, Signal::Output(5))]).unwrap();
    assert_eq!(constant.first_varying(), None);
    let varying = Signals::new(&machine, [(0, Signal::Output(2)), (2, Signal::Output(0))]);
    assert_eq!(varying.unwrap().first_varying(), Some(0));
}

/// A series is expanded anew at each jump: the oscillator under a piecewise constant force is exact to rounding.
#[test]
fn a_series_goes_on_across_jumps() {
    use lagrangian::interpreted::{InterpretedMachine, Signal, Signals};
    use lagrangian::{Machine, TAYLOR};
    let text = "machine Driven in plane {
        parameters { m: kg = 1, k: N/m = 9 }
        coordinates { x: m = 0.25 }
        inputs { push: N }
        bodies { block { mass: m, at: (x, 0) } }
        springs { spring { stiffness: k, stretch: x } }
        forces { hand { on: x, value: push } }
    }";
    let machine = InterpretedMachine::from_text(text)
        .with_series()
        .build()
        .unwrap();
    let table = Table::hold(TIMES, VALUES).unwrap();
    let signals = Signals::new(&machine, [(0, Signal::Table(table.into()))]).unwrap();
    let mut start = machine.start();
    start.v.values[0] = -0.5;
    let simulation = Simulation::new(&machine)
        .method(&TAYLOR)
        .tolerance(1e-14)
        .until(2.7);
    let run = signals
        .drive(simulation.energy_balance(true), &machine)
        .run(start)
        .unwrap();
    for t in [0.2, 0.31, 0.5, 0.9, 1.9, 2.7] {
        let (state, [x, v]) = (run.at(t).unwrap(), held(t));
        let off = (state.q.values[0] - x)
            .abs()
            .max((state.v.values[0] - v).abs());
        assert!(off < 4e-14, "{t}: {off:e}");
    }
    assert!(run.energy_balance().unwrap().residual().abs() < 1e-13);
    assert!(run.statistics().steps < 20);
}
