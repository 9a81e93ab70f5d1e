//! Taylor series of compiled machines, and runs by them, equal those of the interpreter bit for bit.

use crate::support::library;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{
    Batch, Batched, Error, LaneVector, Lanes, Machine, Simulation, State, System, TAYLOR, Vector,
};
use lagrangian_machines::{Crusher9, DoublePendulum, SimplePendulum};
use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Sources};
use lagrangian_symbolic::Dag;

/// Interprets a machine whose spec requests series.
fn interpreted(text: &str) -> InterpretedMachine {
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let path = library::path("test");
    let (sources, files) = (&mut sources, &mut Disk);
    let model = lagrangian_spec::model(&dag, &path, text, &[], files, sources, &mut report);
    match model.and_then(|model| Compiled::for_runs(model, &mut report)) {
        Some(Compiled {
            program,
            series: Some(series),
            ..
        }) => InterpretedMachine::new(program).with_series(Ok(series)),
        _ => panic!("{}", report.render_short(sources)),
    }
}

lagrangian::machine! {
    machine FourBar extends "../../machines/four_bar.machine" { methods { taylor } }
}
lagrangian::machine! {
    machine ClosedPendulum extends "../../machines/closed_pendulum.machine" { methods { taylor } }
}

lagrangian::machine! {
    machine ElasticPendulum extends "../../machines/elastic_pendulum.machine" { methods { taylor } }
}
lagrangian::machine! {
    machine Chain extends "../../machines/chain.machine" { methods { taylor } }
}
lagrangian::machine! {
    machine HeavyTop extends "../../machines/heavy_top.machine" { methods { taylor } }
}
lagrangian::machine! {
    machine SphericalPendulum extends "../../machines/spherical_pendulum.machine" { methods { taylor } }
}
lagrangian::machine! {
    machine SlowOscillator in plane {
        parameters { m: kg = 1, k: N/m = 9, most: m/s = 3.0001 }
        coordinates { x: m = 1 }
        bodies { block { mass: m, at: (x, 0) } }
        springs { spring { stiffness: k, stretch: x } }
        assume { most^3 - der(x)^3 > 0 }
        methods { taylor }
    }
}
lagrangian::machine! {
    machine FlyballGovernor extends "../../machines/flyball_governor.machine" { methods { taylor } }
}
lagrangian::machine! {
    machine TwoBodyOrbit extends "../../machines/two_body_orbit.machine" { methods { taylor } }
}
lagrangian::machine! {
    machine AndrewsSqueezer extends "../../machines/andrews_squeezer.machine" { methods { taylor } }
}

macro_rules! machine_here {
    ($($text:tt)*) => { lagrangian::machine! { $($text)* } };
}

/// Forces by every function that has a recurrence, of positions, of rates, and of both; the kinetic energy is a sum of products of rates.
macro_rules! pushed {
    ($use:ident) => {
        $use! {
            machine Pushed in plane {
                parameters { m: kg = 1.25, c: 1 = 0.75, k: N = 1, w: 1/s = 3, l: m = 1, beat: s = 1 }
                inputs { u: 1 = 0.5 }
                coordinates { x: rad = 0.5, y: rad = 0.25 }
                bodies {
                    ball { mass: m, at: l*(2 + sinh(x))*(cos(y), sin(y)) },
                }
                forces {
                    roots { on: x, value: k*l*(sqrt(2 + x^2) + (2 + cos(x))^c + 1/(2 + y^2)^3 + u) },
                    angles { on: y, value: k*l*(asin(c*sin(x)) + acos(c*y/4) + atan(x*y) + atan2(y + 2, cos(x))) },
                    growth { on: x, value: k*l*(exp(-x)*y + ln(2 + sin(x)) - cosh(y)^3 + tanh(x + y)) },
                    rates { on: y, value: -k*l*(tanh(beat*der(x))*u + sqrt(1 + (beat*der(y) - beat*w)^2)*exp(-beat*der(x))) },
                    drive { on: x, value: -k*l*(sin(w*t)*x + (beat*der(y))^2*sin(y) + (beat*der(x))^3/(2 + cos(x))) },
                }
                methods { taylor }
            }
        }
    };
}
pushed! { machine_here }

/// The text of a machine that extends one of the library and asks for its series.
fn asking(name: &str, spec: &str) -> String {
    format!("machine {name} extends \"{spec}.machine\" {{ methods {{ taylor }} }}")
}

/// Random numbers between −1 and 1.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        // xorshift64*, S. Vigna, An experimental exploration of Marsaglia's xorshift generators, 2016.
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        let bits = self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11;
        bits as f64 / (1u64 << 52) as f64 - 1.0
    }
}

fn vector<V: Vector>(numbers: &[f64]) -> V {
    let mut vector = V::zeros(numbers.len());
    vector.as_mut_slice().copy_from_slice(numbers);
    vector
}

/// Compares the coefficients of a compiled machine with those of the interpreter at many states, at times that are rounded, and for
/// any number of coefficients.
fn agrees<M: Machine + Default>(text: &str) {
    let machine = interpreted(text);
    let (ours, theirs) = (M::default().prepare(), machine.prepare());
    assert_eq!(ours.check_series(), Ok(()));
    assert_eq!(theirs.check_series(), Ok(()));
    let n = ours.coordinates().len();
    let seed = u64::from(std::process::id()) | 1;
    println!("seed {seed}");
    let mut numbers = Numbers(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let mut good = 0;
    for rows in [3, 4, 5, 14, 22, 24].repeat(5) {
        let t = [10.0 * numbers.next(), 1e-15 * numbers.next()];
        let [q, v]: [Vec<f64>; 2] =
            std::array::from_fn(|_| (0..n).map(|_| numbers.next()).collect());
        let mut emitted = vec![<M::System as System>::Vector::zeros(n); rows];
        let (own_q, own_v) = (vector(&q), vector(&v));
        let one = ours.series(t, &own_q, &own_v, &ours.default_inputs(), &mut emitted);
        let mut expected = vec![vec![0.0; n]; rows];
        let two = theirs.series(t, &q, &v, &theirs.default_inputs(), &mut expected);
        assert_eq!(one, two, "{q:?} {v:?}");
        if one.is_err() {
            continue;
        }
        good += 1;
        for (order, (row, expected)) in emitted.iter().zip(&expected).enumerate() {
            for (i, (x, y)) in row.as_slice().iter().zip(expected).enumerate() {
                // The emitted code leaves out terms that are 0, so a zero may have another sign.
                assert!(
                    x == y && x.is_finite(),
                    "{}: coordinate {i}, order {order} of {rows}: {x:e} {y:e} at {q:?} {v:?}",
                    machine.name()
                );
            }
        }
    }
    assert!(good > 20, "{good}");
}

#[test]
fn coefficients_are_those_of_the_interpreter() {
    agrees::<DoublePendulum>(&library::text("double_pendulum"));
    agrees::<Crusher9>(&library::text("crusher9"));
}

/// Multipliers are unknowns beside the accelerations; the matrix of the five bars contains entries that are −1 from the start.
#[test]
fn coefficients_of_closed_loops_are_those_of_the_interpreter() {
    agrees::<FourBar>(&asking("FourBar", "four_bar"));
    agrees::<ClosedPendulum>(&asking("ClosedPendulum", "closed_pendulum"));
}

/// The equations of these machines are derivatives of momenta, which are one order ahead of accelerations.
#[test]
fn coefficients_by_momenta_are_those_of_the_interpreter() {
    agrees::<HeavyTop>(&asking("HeavyTop", "heavy_top"));
    agrees::<TwoBodyOrbit>(&asking("TwoBodyOrbit", "two_body_orbit"));
}

/// Quotients, roots and all other functions, of positions and of rates.
#[test]
fn coefficients_of_all_functions_are_those_of_the_interpreter() {
    agrees::<FlyballGovernor>(&asking("FlyballGovernor", "flyball_governor"));
    agrees::<AndrewsSqueezer>(&asking("AndrewsSqueezer", "andrews_squeezer"));
    agrees::<Pushed>(pushed!(stringify));
}

/// More products than one pack holds.
#[test]
fn coefficients_in_several_packs_are_those_of_the_interpreter() {
    agrees::<ElasticPendulum>(&asking("ElasticPendulum", "elastic_pendulum"));
    agrees::<Chain>(&asking("Chain", "chain"));
}

/// The coefficients of several states at once equal those of each state alone, in every bit, whatever the lists held before.
fn agrees_in_lanes<M: Machine + Default, const W: usize>()
where
    M::System: Batched<W>,
{
    let system = M::default().prepare();
    let n = system.coordinates().len();
    let batch = Batch::<_, W>::of(&system);
    let (inputs, own_inputs) = (batch.default_inputs(&system), system.default_inputs());
    let mut lists = <M::System as Batched<W>>::SeriesLists::default();
    let seed = u64::from(std::process::id()) | 1;
    println!("seed {seed}");
    let mut numbers = Numbers(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
    let mut good = 0;
    for rows in [24, 3, 4, 5, 14, 22].repeat(4) {
        let t = [10.0, 1e-15].map(|scale| Lanes([0.0; W].map(|_| scale * numbers.next())));
        let mut states = || {
            std::array::from_fn::<_, W, _>(|_| {
                let numbers: Vec<f64> = (0..n).map(|_| numbers.next()).collect();
                vector::<<M::System as System>::Vector>(&numbers)
            })
        };
        let [q, v] = [states(), states()];
        let mut found = vec![<M::System as Batched<W>>::Vectors::ZEROS; rows];
        let [all_q, all_v] = [&q, &v].map(|of| batch.vectors(of.each_ref()));
        let result = batch.series(t, &all_q, &all_v, &inputs, &mut lists, &mut found);
        let singular = result.map_or_else(|some| some.lanes, |()| [None; W]);
        for lane in 0..W {
            let mut alone = vec![<M::System as System>::Vector::zeros(n); rows];
            let own_t = t.map(|t| t[lane]);
            let one = system.series(own_t, &q[lane], &v[lane], &own_inputs, &mut alone);
            assert_eq!(one.err(), singular[lane]);
            if singular[lane].is_some() {
                continue;
            }
            good += 1;
            for (order, (found, alone)) in found.iter().zip(&alone).enumerate() {
                let found = found.lane(lane);
                let bits = |of: &[f64]| of.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
                assert!(
                    bits(found.as_slice()) == bits(alone.as_slice()),
                    "order {order} of {rows}, lane {lane} of {W}: {found:?} {alone:?}"
                );
            }
        }
    }
    assert!(good > 20 * W, "{good}");
}

#[test]
fn coefficients_in_lanes_are_those_of_one_state() {
    // Each number of lanes of a machine is code of its own, which takes seconds to compile.
    agrees_in_lanes::<DoublePendulum, 2>();
    agrees_in_lanes::<DoublePendulum, 8>();
    agrees_in_lanes::<Crusher9, 4>();
    agrees_in_lanes::<Crusher9, 8>();
    agrees_in_lanes::<ClosedPendulum, 4>();
    agrees_in_lanes::<ElasticPendulum, 2>();
    agrees_in_lanes::<Chain, 8>();
    agrees_in_lanes::<HeavyTop, 4>();
    agrees_in_lanes::<Pushed, 4>();
}

#[test]
fn a_compiled_run_is_an_interpreted_run() {
    let interpreted = interpreted(&library::text("crusher9"));
    let compiled = Crusher9::default();
    let prepared = compiled.prepare();
    let start = compiled.start();
    let named = interpreted.start();
    let again = State {
        t: 0.0,
        q: prepared.to_coordinates(&vector(&named.q.values)),
        v: prepared.to_coordinates(&vector(&named.v.values)),
    };
    assert_eq!(start, again);
    let run = Simulation::new(&compiled).method(&TAYLOR).until(2.0);
    let run = run.run(start).unwrap();
    let other = Simulation::new(&interpreted).method(&TAYLOR).until(2.0);
    let other = other.run(named).unwrap();
    assert_eq!(run.statistics().steps, other.statistics().steps);
    assert!(run.statistics().steps > 50);
    let [q, v] = [&run.end().q, &run.end().v].map(|of| prepared.to_vector(of).to_vec());
    assert_eq!([&q, &v], [&other.end().q.values, &other.end().v.values]);
}

/// `sin(theta) > 0` is decided by the bounds of the coordinates. A pendulum without angular momentum swings through the vertical, where it fails.
#[test]
fn an_assumption_is_decided_by_bounds() {
    let system = HeavyTop::default().prepare();
    let holds_within = |low: f64, high: f64| {
        let [low, high] = [[0.0, low, 0.0], [0.0, high, 0.0]];
        system.assumptions_hold_within([0.0, 1.0], [&low, &high], [&[-1e3; 3], &[1e3; 3]])
    };
    assert!(holds_within(0.1, 3.0) && holds_within(7.0, 9.0));
    assert!(!holds_within(-0.1, 1.0) && !holds_within(3.0, 3.5) && !holds_within(1.0, 8.0));
    assert!(!holds_within(1.0, f64::NAN));
    // Whatever the rates, on which it does not depend.
    let [low, high] = [f64::NEG_INFINITY, f64::INFINITY].map(|end| [end; 3]);
    let within = [0.1, 3.0].map(|theta| [0.0, theta, 0.0]);
    assert!(system.assumptions_hold_within([0.0, 1.0], [&within[0], &within[1]], [&low, &high]));

    let machine = SphericalPendulum::default();
    let run = |speed: f64| {
        let mut start = machine.start();
        start.v.phi = speed;
        let run = Simulation::new(&machine).method(&TAYLOR).tolerance(1e-12);
        run.until(20.0).run(start).map(|run| run.end().t)
    };
    assert_eq!(run(3.0), Ok(20.0));
    let ended = run(0.0);
    // A quarter of the period from 60 degrees, K(sin 30°) √(l/g).
    let quarter = 1.685_750_354_812_596 * (1.0_f64 / 9.81).sqrt();
    let Err(Error::AssumptionEnded { t, .. }) = ended else {
        panic!("{ended:?}");
    };
    assert!((t - quarter).abs() < 1e-9, "{t} {quarter}");
}

/// The rate of x = cos 3t has its maximum, 3 m/s, at 3t = 3π/2. An assumption that it is less than 3 cos 0.01 fails for a moment.
#[test]
fn an_assumption_about_rates_is_decided_by_their_bounds() {
    let run = |most: f64| {
        let machine = SlowOscillator {
            most,
            ..SlowOscillator::default()
        };
        let run = Simulation::new(&machine).method(&TAYLOR).tolerance(1e-13);
        run.until(20.0).run(machine.start()).map(|run| run.end().t)
    };
    assert_eq!(run(3.0001), Ok(20.0));
    let ended = run(3.0 * 0.01_f64.cos());
    let Err(Error::AssumptionEnded { t, .. }) = ended else {
        panic!("{ended:?}");
    };
    // The rate changes by 0.09 m/s² there, so an error of 1e-12 m/s is one of 1e-11 s.
    let exact = (1.5 * std::f64::consts::PI - 0.01) / 3.0;
    assert!((t - exact).abs() < 1e-10, "{t} {exact}");
}

#[test]
fn who_does_not_ask_has_none() {
    let system = SimplePendulum::default().prepare();
    assert!(system.check_series().is_err());
    // For more coefficients than emitted code has space for, it gives none.
    let system = DoublePendulum::default().prepare();
    let mut rows = [[1.0; 2]; 26];
    let (q, v) = ([0.1, 0.2], [0.3, 0.4]);
    system
        .series([0.0; 2], &q, &v, &system.default_inputs(), &mut rows)
        .unwrap();
    assert!(rows[23][0].is_finite() && rows[24][0].is_nan() && rows[25][1].is_nan());
}
