//! A run of an interpreted machine that chooses its method derives the series of the machine once it has proved long, and not before.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use crate::support::known_ends::{REGULAR_AT_100, REGULAR_START};
use crate::support::library;
use lagrangian::interpreted::{Engine, InterpretedMachine, Named};
use lagrangian::{Machine, Method, Simulation, Solution, State, System, TAYLOR};
use lagrangian_mechanics::Compiled;
use lagrangian_mechanics::series::{ProvedSeries, SeriesText};
use lagrangian_program::series::NoSeries;
use lagrangian_spec::diagnostic::Report;
use lagrangian_spec::source::{Disk, Recorder, Sources};
use lagrangian_symbolic::Dag;

type Run = Solution<InterpretedMachine>;

/// A machine of the library that counts how often its series is derived.
fn counted(name: &str) -> (InterpretedMachine, Arc<AtomicUsize>) {
    let (machine, text) = read(name);
    let count = Arc::new(AtomicUsize::new(0));
    let counting = count.clone();
    let derive = move || {
        counting.fetch_add(1, Ordering::Relaxed);
        text.derive()
    };
    (machine.with_series_on_demand(derive), count)
}

/// A machine of the library without its series, and the texts from which that is derived.
fn read(name: &str) -> (InterpretedMachine, SeriesText) {
    let (path, text) = (library::path(name), library::text(name));
    let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
    let mut disk = Disk;
    let mut files = Recorder::new(&mut disk);
    let sources = &mut sources;
    let model = lagrangian_spec::model(&dag, &path, &text, &[], &mut files, sources, &mut report);
    let texts = SeriesText {
        name: path,
        text,
        files: files.read,
        ..SeriesText::default()
    };
    match model.and_then(|model| Compiled::new(model, &mut report)) {
        Some(compiled) => (InterpretedMachine::new(compiled.program), texts),
        None => panic!("{}", report.render_short(sources)),
    }
}

/// The start of the double pendulum whose end is known.
fn regular_start(machine: &InterpretedMachine) -> State<Named> {
    let mut start = machine.start();
    start.q.values.copy_from_slice(&REGULAR_START);
    start.v.values.fill(0.0);
    start
}

fn automatic(machine: &InterpretedMachine, until: f64) -> Simulation<'_, InterpretedMachine> {
    Simulation::new(machine)
        .automatic()
        .tolerance(1e-12)
        .until(until)
}

/// The times and names of the methods of a run.
fn methods(run: &Run) -> Vec<(f64, &'static str)> {
    let choices = run.choices().iter();
    choices
        .map(|choice| (choice.t, choice.method.tableau.name))
        .collect()
}

#[test]
fn a_long_run_continues_by_series_and_is_as_accurate_as_one_by_series_alone() {
    let (machine, count) = counted("double_pendulum");
    let run = automatic(&machine, 100.0)
        .run(regular_start(&machine))
        .unwrap();
    assert_eq!(count.load(Ordering::Relaxed), 1);
    let [(first, dop853), (second, taylor)] = methods(&run)[..] else {
        panic!("{:?}", methods(&run));
    };
    assert_eq!((first, dop853, taylor), (0.0, "dop853", "taylor"));
    assert!(second > 0.0 && second < 20.0, "{second}");
    // The bound for runs by series alone (`taylor.rs`): ten tolerances.
    let end = run.end().q.values.iter().chain(&run.end().v.values);
    for (y, exact) in end.zip(&REGULAR_AT_100) {
        assert!(
            (y - exact).abs() <= 1e-11 * (1.0 + exact.abs()),
            "{y} {exact}"
        );
    }
    // Dense output in steps of both methods.
    let series = TAYLOR.tableau.name;
    for t in [0.5 * second, second, 0.5 * (second + 100.0)] {
        let state = run.at(t).unwrap();
        let exact = Simulation::new(&machine)
            .method(&TAYLOR)
            .tolerance(1e-14)
            .until(t);
        let exact = exact.run(regular_start(&machine)).unwrap();
        for (one, other) in state.q.values.iter().zip(&exact.end().q.values) {
            assert!((one - other).abs() <= 1e-10, "{series} {t}: {one} {other}");
        }
    }
}

#[test]
fn a_short_run_derives_nothing() {
    let (machine, count) = counted("double_pendulum");
    let start = regular_start(&machine);
    let run = automatic(&machine, 1.0).run(start.clone()).unwrap();
    assert_eq!(methods(&run), [(0.0, "dop853")]);
    let alone = Simulation::new(&machine)
        .method(Method::DOP853)
        .tolerance(1e-12)
        .until(1.0);
    assert_eq!(run.end(), alone.run(start.clone()).unwrap().end());
    // One that might be long but is stopped early.
    let stopped = automatic(&machine, 1e6).stop_if(|state| state.t > 1.0);
    let run = stopped.run(start).unwrap();
    assert!(run.end().t < 2.0, "{}", run.end().t);
    assert_eq!(count.load(Ordering::Relaxed), 0);
}

#[test]
fn what_ran_before_the_engine_and_what_is_recorded_change_no_bit() {
    let (machine, count) = counted("double_pendulum");
    let start = || regular_start(&machine);
    let first = automatic(&machine, 200.0).run(start()).unwrap();
    let [_, (since, _)] = methods(&first)[..] else {
        panic!("{:?}", methods(&first));
    };
    let same = |other: &Run| {
        assert_eq!(
            (other.end(), methods(other)),
            (first.end(), methods(&first))
        );
    };
    // Its series is known now.
    same(&automatic(&machine, 200.0).run(start()).unwrap());
    let sampled = automatic(&machine, 200.0)
        .every(0.01)
        .energy_balance(true)
        .forget_steps();
    same(&sampled.run(start()).unwrap());
    let mut jitted = machine.clone();
    if jitted.set_engine(Engine::Jit).is_ok() {
        same(&automatic(&jitted, 200.0).run(start()).unwrap());
    }
    // Threads that need it at the same time.
    let (machine, again) = counted("double_pendulum");
    thread::scope(|scope| {
        for _ in 0..3 {
            scope.spawn(|| same(&automatic(&machine, 200.0).run(start()).unwrap()));
        }
    });
    assert_eq!(
        [&count, &again].map(|count| count.load(Ordering::Relaxed)),
        [1, 1]
    );
    // It is backward in time as well.
    let back = Simulation::new(&machine)
        .automatic()
        .tolerance(1e-12)
        .until(-200.0);
    let back = back.run(first.end().clone()).unwrap();
    assert!(
        since > 0.0 && methods(&back).len() == 2,
        "{:?}",
        methods(&back)
    );
}

/// Of the derivation, each of many runs counts its part: the more runs, the earlier they go on by series, from their start on if a single step is worth
/// that.
#[test]
fn the_more_runs_share_a_derivation_the_earlier_they_go_by_series() {
    let until = 5.0;
    let made = |machine: &InterpretedMachine, runs: u64| {
        let run = automatic(machine, until).one_of(runs);
        run.run(machine.start()).unwrap()
    };
    let (machine, count) = counted("crusher9");
    let alone = made(&machine, 1);
    assert_eq!(methods(&alone), [(0.0, "dop853")]);
    assert_eq!(made(&machine, 0).end(), alone.end());
    assert_eq!(count.load(Ordering::Relaxed), 0);
    let mut before = until;
    for runs in [16, 128] {
        let shared = made(&machine, runs);
        let [_, (since, "taylor")] = methods(&shared)[..] else {
            panic!("{runs}: {:?}", methods(&shared));
        };
        assert!(since > 0.0 && since < before, "{runs}: {since}");
        // That the series is known by now changes nothing.
        let again = made(&machine, runs);
        assert_eq!(
            (again.end(), methods(&again)),
            (shared.end(), methods(&shared))
        );
        before = since;
    }
    // The derivation takes as long as some hundreds to ten thousand evaluations, and a step as long as twelve.
    let many = made(&machine, 100_000);
    assert_eq!(methods(&many), [(0.0, "taylor")]);
    let given = automatic(&machine, until).method(&TAYLOR);
    let given = given.run(machine.start()).unwrap();
    assert_eq!(
        (many.end(), many.statistics().steps),
        (given.end(), given.statistics().steps)
    );
    // The series was derived once.
    assert_eq!(count.load(Ordering::Relaxed), 1);
    assert!(many.statistics().evaluations < alone.statistics().evaluations / 4);
}

/// A slow oscillation, x = cos t, and a mass that creeps back in a viscous oil, at 2e4/s: series are left where stability limits their steps, however little of
/// their derivation the run counts.
#[test]
fn a_stiff_run_that_shares_a_derivation_leaves_series() {
    let text = "machine Damped in plane {
        parameters { k: N/m = 1, c: N*s/m = 2e4 }
        coordinates { x: m = 1, y: m = 1 }
        bodies { a { mass: 1, at: (x, 0) }, b { mass: 1, at: (0, y) } }
        springs { slow { stiffness: k, stretch: x }, fast { stiffness: 1e4*k, stretch: y } }
        dissipations { oil: 1/2*c*der(y)^2 }
    }";
    let machine = InterpretedMachine::from_text(text).build().unwrap();
    for runs in [30, 1_000_000] {
        let run = automatic(&machine, 30.0).one_of(runs);
        let run = run.run(machine.start()).unwrap();
        assert_eq!(
            methods(&run).last().map(|(_, name)| *name),
            Some("radau13"),
            "{:?}",
            methods(&run)
        );
        // A tolerance of 1e-12 in each of some hundred steps.
        assert!((run.end().q.values[0] - 30.0_f64.cos()).abs() < 1e-9);
        assert!(run.statistics().steps < 2000);
    }
}

#[test]
fn machines_without_series_run_as_before() {
    // A rolling coin has constraints of velocities, so that nothing is even tried.
    for (name, may_have_one) in [("rolling_coin", false), ("double_pendulum", true)] {
        let (machine, _) = counted(name);
        let count = Arc::new(AtomicUsize::new(0));
        let counting = count.clone();
        let machine = machine.with_series_on_demand(move || {
            counting.fetch_add(1, Ordering::Relaxed);
            Err(NoSeries::Approximations)
        });
        let mut start = machine.start();
        if may_have_one {
            start = regular_start(&machine);
        }
        let run = automatic(&machine, 200.0).run(start.clone()).unwrap();
        assert_eq!(methods(&run), [(0.0, "dop853")], "{name}");
        assert!(run.statistics().steps > 4000, "{name}");
        let many = automatic(&machine, 200.0).one_of(1_000_000);
        assert_eq!(many.run(start.clone()).unwrap().end(), run.end(), "{name}");
        assert_eq!(
            count.load(Ordering::Relaxed),
            usize::from(may_have_one),
            "{name}"
        );
        let alone = Simulation::new(&machine)
            .method(Method::DOP853)
            .tolerance(1e-12);
        let alone = alone.until(200.0).run(start).unwrap();
        assert_eq!(run.end(), alone.end(), "{name}");
    }
}

#[test]
fn a_machine_that_is_read_has_its_series_without_asking() {
    let text = library::text("double_pendulum");
    let machine = InterpretedMachine::from_text(text).build().unwrap();
    let simulation = Simulation::new(&machine)
        .method(&TAYLOR)
        .tolerance(1e-12)
        .until(100.0);
    let run = simulation.run(regular_start(&machine)).unwrap();
    let end = run.end().q.values.iter().chain(&run.end().v.values);
    for (y, exact) in end.zip(&REGULAR_AT_100) {
        assert!(
            (y - exact).abs() <= 1e-11 * (1.0 + exact.abs()),
            "{y} {exact}"
        );
    }
}

/// The series is derived from the texts in a model of its own, in which sums may have another order than in that of the program.
#[test]
fn the_series_of_the_texts_is_that_of_the_model_up_to_the_order_of_sums() {
    for name in library::MACHINES.into_iter().chain(library::CONSTRAINED) {
        let (path, text) = (library::path(name), library::text(name));
        let (dag, mut sources, mut report) = (Dag::new(), Sources::new(), Report::new());
        let (files, sources) = (&mut Disk, &mut sources);
        let model = lagrangian_spec::model(&dag, &path, &text, &[], files, sources, &mut report);
        let Some(compiled) = model.and_then(|model| Compiled::new(model, &mut report)) else {
            panic!("{name}: {}", report.render_short(sources));
        };
        let (machine, texts) = read(name);
        assert!(machine.prepare().check_series().is_err(), "{name}");
        let both = [ProvedSeries::derive(&compiled.model), texts.derive()];
        let [of_model, of_texts] = both.map(|series| {
            series.map(|series| (series.products(), series.dimension(), series.unknowns()))
        });
        assert_eq!(of_model, of_texts, "{name}");
    }
}
