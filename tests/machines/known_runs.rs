//! The references to 30 digits belong to the machines that they name: runs by methods that were not used to compute
//! them end at the same states.

use crate::support::known_ends::{CHAOTIC_AT_10, CRUSHER_AT_5, REGULAR_AT_100};
use crate::support::known_runs::KnownRun;
use crate::support::library;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::{
    DefaultInputs, METHODS, Machine, Method, NoBalance, RADAU_OF_HIGH_ORDER, Simulation, State,
    Stepper, System, Tolerance, Vector,
};
use lagrangian_machines::{Crusher9, DoublePendulum};
use lagrangian_scalar::DoubleDouble;

/// The machine of a known run, interpreted.
fn machine(known: &KnownRun) -> InterpretedMachine {
    let KnownRun {
        machine, settings, ..
    } = known;
    let (constants, parameters): (Vec<_>, Vec<_>) =
        settings.iter().partition(|(name, _)| name == "N");
    let constants: Vec<(&str, i64)> = constants
        .iter()
        .map(|(name, value)| (name.as_str(), *value as i64))
        .collect();
    let mut made = InterpretedMachine::new(library::program(machine, &constants));
    for (name, value) in parameters {
        made.set(name, *value).expect("a parameter");
    }
    made
}

/// Runs with the given tolerance and asserts that the error at the end is below `most`.
fn ends_there(name: &str, method: &'static Method, tolerance: f64, most: f64) {
    let known = KnownRun::named(name);
    let machine = machine(&known);
    let mut start = machine.start();
    let (q, v) = known.start.split_at(known.start.len() / 2);
    start.q.values.copy_from_slice(q);
    start.v.values.copy_from_slice(v);
    let run = Simulation::new(&machine)
        .method(method)
        .tolerance(tolerance)
        .forget_steps()
        .until(known.until)
        .run(start)
        .unwrap();
    let end = run.end();
    let error = known.error(end.q.values.iter().chain(&end.v.values));
    println!("{name}: {error:e}, {:?}", run.statistics());
    assert!(error < most, "{name}: {error:e}");
}

/// The rows of the squeezer's constraints are weakly independent in all poses, to 0.14 to 0.19 of their length, and never become dependent. If the run
/// took that for such a pose, its error would be measured along the motion only, with looser tolerances across it: at 1e-9 it ended 3.5e-7 away. So it must
/// end within 100 tolerances, where regular motions of this length end.
#[test]
fn weakly_independent_rows_are_no_pose_of_dependent_ones() {
    ends_there("andrews_squeezer", Method::DOP853, 1e-9, 1e-7);
}

/// The references agree with results of extrapolation in binary128, computed from other equations, to all digits given there.
#[test]
fn references_are_those_of_an_extrapolation_in_binary128() {
    for (name, ends) in [
        ("double_pendulum_regular", &REGULAR_AT_100[..]),
        ("double_pendulum_chaotic", &CHAOTIC_AT_10),
        ("crusher", &CRUSHER_AT_5),
    ] {
        let known = KnownRun::named(name);
        assert_eq!(known.error(ends).max(2e-16), 2e-16, "{name}");
    }
}

/// The test set for initial value problems, release 2.4 (2008), gives the angles of Andrews' squeezer at 0.03 s. Its last digits are
/// wrong, as the energy shows, but the first ten are right.
#[test]
fn andrews_squeezer_ends_where_the_test_set_says() {
    let published = [
        0.1581077119629904e2,
        -0.1575637105984298e2,
        0.4082224013073101e-1,
        -0.5347301163226948,
        0.5244099658805304,
        0.5347301163226948,
        0.1048080741042263e1,
    ];
    let known = KnownRun::named("andrews_squeezer");
    for (published, end) in published.iter().zip(&known.end) {
        let off = (DoubleDouble::from(*published) - *end).hi();
        assert!(off.abs() < 2e-10 * published.abs().max(1.0), "{off:e}");
    }
}

/// Each step has a tolerance of 1e-11, and motions that are not chaotic amplify the sum of a few hundred errors by at most a few
/// hundred. A wrong sign, number or term of any body would show in the fourth digit.
#[test]
fn runs_of_the_library_end_at_the_references() {
    for name in [
        "andrews_squeezer",
        "chain_16",
        "chain_8",
        "closed_pendulum",
        "crusher",
        "double_pendulum_regular",
        "elastic_pendulum",
        "flyball_governor",
        "four_bar",
        "heavy_top",
        "six_joint_arm",
        "spherical_pendulum",
        "stiff_crusher",
        "stiff_spring_pendulum",
    ] {
        ends_there(name, &METHODS[0], 1e-11, 1e-7);
    }
    // This motion amplifies errors by 10⁹.
    ends_there("double_pendulum_chaotic", &METHODS[0], 1e-14, 1e-4);
}

/// The error of the first step of a run with each method, as root mean square in units of the tolerance, for tolerances from 1e-4 to 1e-10.
fn errors_of_first_step(name: &str, method: &'static Method) -> Vec<f64> {
    let known = KnownRun::named(name);
    let machine = machine(&known);
    let system = machine.prepare();
    let to_vector = |numbers: &[f64]| {
        let mut vector =
            <<InterpretedMachine as Machine>::System as System>::Vector::zeros(numbers.len());
        vector.as_mut_slice().copy_from_slice(numbers);
        vector
    };
    let (q, v) = known.start.split_at(known.start.len() / 2);
    let begin = |method, tolerance: f64| {
        let mut absolute = to_vector(q);
        absolute.as_mut_slice().fill(tolerance);
        let tolerance = Tolerance {
            relative: tolerance,
            absolute,
        };
        let start = (0.0, to_vector(q), to_vector(v));
        let until = known.until;
        Stepper::new(
            &system,
            DefaultInputs,
            NoBalance,
            method,
            tolerance,
            start,
            until,
        )
        .unwrap()
    };
    // The truth comes from a method of another kind, at a thousandth of the finest of these tolerances.
    let other = match method.tableau.spectrum {
        None => &RADAU_OF_HIGH_ORDER[1],
        Some(_) => Method::DOP853,
    };
    let tolerances = [1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10];
    let errors = tolerances.map(|tolerance| {
        let mut stepper = begin(method, tolerance);
        stepper.step().unwrap();
        let mut exact = begin(other, 1e-13);
        exact.set_end(stepper.t());
        while !exact.is_done() {
            exact.step().unwrap();
        }
        let levels = [[stepper.q(), exact.q()], [stepper.v(), exact.v()]];
        let sums = levels.map(|[y, exact]| -> f64 {
            let pairs = y.as_slice().iter().zip(exact.as_slice());
            let ratios = pairs.map(|(y, exact)| (y - exact) / (tolerance * (1.0 + exact.abs())));
            ratios.map(|ratio| ratio * ratio).sum()
        });
        ((sums[0] + sums[1]) / known.start.len() as f64).sqrt()
    });
    errors.to_vec()
}

/// The error of a step is meant to be within a factor of 10 of the tolerance. That of the first one was up to 70 tolerances on chains that start straight
/// and at rest, where the combination of both estimates of `dop853` is far too small; nothing about it is special in other methods.
#[test]
fn the_first_step_of_a_run_is_as_accurate_as_the_others() {
    for method in METHODS.iter().chain(&RADAU_OF_HIGH_ORDER) {
        for name in [
            "chain_16",
            "chain_8",
            "closed_pendulum",
            "crusher",
            "double_pendulum_regular",
            "elastic_pendulum",
            "flyball_governor",
            "heavy_top",
            "six_joint_arm",
        ] {
            let errors = errors_of_first_step(name, method);
            println!("{name}, {}: {errors:.2?}", method.tableau.name);
            assert!(
                errors.iter().all(|error| *error <= 10.0),
                "{name}, {}: {errors:?}",
                method.tableau.name
            );
        }
    }
}

/// On springs of 2e9 N/m the crusher's steps are limited by stability now and then, but those of a Radau method are limited by accuracy and are more. A run
/// that chooses its method tries it for 16 steps after no less than 115 explicit ones, and less and less often: a tenth of the work.
#[test]
fn a_run_that_chooses_its_method_leaves_one_that_costs_more() {
    let known = KnownRun::named("stiff_crusher");
    let machine = machine(&known);
    let mut start = machine.start();
    let (q, v) = known.start.split_at(known.start.len() / 2);
    start.q.values.copy_from_slice(q);
    start.v.values.copy_from_slice(v);
    for tolerance in [1e-3, 1e-4] {
        let simulation = || {
            let simulation = Simulation::new(&machine).tolerance(tolerance);
            simulation.forget_steps().until(known.until)
        };
        let explicit = simulation().method(Method::DOP853).run(start.clone());
        let chosen = simulation().automatic().run(start.clone()).unwrap();
        let count = chosen.statistics().evaluations as f64;
        let limit = 1.1 * explicit.unwrap().statistics().evaluations as f64;
        let choices = chosen.choices();
        let described = choices
            .iter()
            .map(|choice| (choice.t, choice.method.tableau.name));
        let described: Vec<_> = described.collect();
        assert!(
            count <= limit,
            "{tolerance}: {count} of {limit}, {described:?}"
        );
        let ends = choices.iter().skip(1).map(|next| next.t);
        let pieces = choices.iter().zip(ends.chain([known.until]));
        let by_radau = pieces.filter(|(choice, _)| choice.method.tableau.name == "radau5");
        let share: f64 = by_radau.map(|(choice, end)| end - choice.t).sum();
        assert!(share < 0.1 * known.until, "{tolerance}: {described:?}");
    }
}

/// Asserts that the method that a run chooses reaches each error, at whatever tolerance, with at most 1.2 times the work of `dop853` and of Taylor series.
///
/// The work of a step by series is what it is estimated to be, [`System::series_cost`]: with 12 coefficients where the sum of both tolerances is above 3e-5.
fn costs_hardly_more<M: Machine>(name: &str, machine: &M) {
    let known = KnownRun::named(name);
    let system = machine.prepare();
    let vector = |numbers: &[f64]| {
        let mut vector = <M::System as System>::Vector::zeros(numbers.len());
        vector.as_mut_slice().copy_from_slice(numbers);
        system.to_coordinates(&vector)
    };
    let (q, v) = known.start.split_at(known.start.len() / 2);
    let start = State {
        t: 0.0,
        q: vector(q),
        v: vector(v),
    };
    let costs = system.series_cost().expect("a series");
    // The work and the error at each tolerance.
    let points = |method: Option<&'static Method>| {
        let run = |power: i32| {
            let tolerance = 10_f64.powi(-power);
            let simulation = Simulation::new(machine).tolerance(tolerance);
            let simulation = match method {
                Some(method) => simulation.method(method),
                None => simulation.automatic(),
            };
            let simulation = simulation.forget_steps().until(known.until);
            let run = simulation.run(start.clone()).expect("a run");
            let chosen = run.choices();
            assert!(chosen.len() <= 1, "{name}, {tolerance}: {chosen:?}");
            let method = method.unwrap_or_else(|| chosen[0].method);
            let (steps, evaluations) = (run.statistics().steps, run.statistics().evaluations);
            let of_series = if method.tableau.name == "taylor" {
                (costs[usize::from(power > 4)] - 1.0) * steps as f64
            } else {
                0.0
            };
            let end = [&run.end().q, &run.end().v].map(|x| system.to_vector(x));
            let error = known.error(end.iter().flat_map(Vector::as_slice));
            (evaluations as f64 + of_series, error)
        };
        (2..=12).map(run).collect::<Vec<_>>()
    };
    let chosen = points(None);
    let others = [Method::DOP853, Method::TAYLOR].map(|method| points(Some(method)));
    println!("{name}: chosen {chosen:?}, dop853 and taylor {others:?}");
    for error in [1e-3, 1e-5, 1e-7, 1e-9, 1e-11] {
        let least = |points: &[(f64, f64)]| {
            let reached = points.iter().filter(|(_, other)| *other <= error);
            reached.fold(f64::INFINITY, |least, (work, _)| work.min(least))
        };
        let best = others.iter().map(|points| least(points));
        let best = best.fold(f64::INFINITY, f64::min);
        let ratio = least(&chosen) / best;
        assert!(
            best.is_infinite() || ratio <= 1.2,
            "{name}, {error}: {ratio}"
        );
    }
}

#[test]
fn a_chosen_method_costs_hardly_more_than_the_best_one_at_the_same_error() {
    let pendulum = DoublePendulum::default();
    let crusher = Crusher9::default();
    costs_hardly_more("double_pendulum_regular", &pendulum);
    costs_hardly_more("crusher", &crusher);
    let on_stiff_springs = Crusher9 {
        cx: 2e9,
        cy: 1.6e9,
        ..crusher
    };
    costs_hardly_more("stiff_crusher", &on_stiff_springs);
}

/// The state that Kepler's equation gives after 1000 turns has the energy and the areal velocity of the start to all digits of
/// double-doubles, and the run ends there.
#[test]
fn an_orbit_of_a_thousand_turns_closes() {
    let known = KnownRun::named("kepler");
    let number = DoubleDouble::from;
    let constants = |[r, _, radial, turning]: [DoubleDouble; 4]| {
        let sweep = r * r * turning;
        let energy = (radial * radial + sweep * turning) * number(0.5) - number(4.0) / r;
        [energy, sweep]
    };
    let start: [f64; 4] = known.start.as_slice().try_into().expect("two coordinates");
    let end: [DoubleDouble; 4] = known.end.as_slice().try_into().expect("two coordinates");
    let [before, after] = [start.map(number), end].map(constants);
    for (before, after) in before.into_iter().zip(after) {
        // About ten operations with errors of 2⁻¹⁰⁴ each.
        assert!((before - after).hi().abs() < 1e-29, "{before:?} {after:?}");
    }
    // Each of about 10⁵ steps errs by its tolerance, and an error of the energy shifts the position on the orbit in all later turns.
    ends_there("kepler", &METHODS[0], 1e-12, 1e-4);
}
