//! Solutions and simulations can be sent to other threads, and solutions can be serialized.

use std::thread;

use lagrangian::interpreted::{InterpretedMachine, InterpretedSystem};
use lagrangian::{
    Crossing, Error, Event, Machine, Sensitive, Simulation, Solution, Staged, State, System,
};
use lagrangian_machines::DoublePendulum;

lagrangian::machine! {
    #[derive(serde::Serialize, serde::Deserialize)]
    #[serde(rename_all = "UPPERCASE")]
    /// A pair of masses on springs.
    #[deny(unsafe_code)]
    machine Pair in plane {
        parameters { m: kg = 1, k[1..2]: N/m = 4 }
        coordinates { x: m = 0.25, y: m }
        inputs { push: N }
        bodies { one { mass: m, at: (x, 0) }, other { mass: m, at: (y, 0) } }
        springs { wall { stiffness: k[1], stretch: x }, link { stiffness: k[2], stretch: y - x } }
        forces { hand { on: x, value: push } }
        derivatives { coordinates, rates, m }
    }
}

fn travels<T: Send + Sync + Clone>() {}

#[test]
fn solutions_are_shared_among_threads() {
    travels::<Solution<Sensitive<'static, Pair>>>();
    travels::<Solution<InterpretedMachine>>();
    travels::<Sensitive<'static, Pair>>();
    travels::<InterpretedSystem>();
    travels::<Solution<DoublePendulum>>();
    let text = include_str!("../../machines/double_pendulum.machine");
    let machine = InterpretedMachine::from_text(text).build().unwrap();
    let run = Simulation::new(&machine)
        .until(1.0)
        .run(machine.start())
        .unwrap();
    let pair = Pair::default();
    let sensitive = Sensitive::new(&pair).by("m").unwrap();
    let varied = Simulation::new(&sensitive)
        .until(1.0)
        .run(sensitive.start())
        .unwrap();
    let observe = |t: f64| {
        let seen = run.observe(t).unwrap();
        (seen.a.values, varied.observe(t).unwrap().a.by[0].x)
    };
    let times: Vec<f64> = (0..200).map(|i| f64::from(i) / 200.0).collect();
    let alone: Vec<_> = times.iter().map(|t| observe(*t)).collect();
    thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                let together: Vec<_> = times.iter().map(|t| observe(*t)).collect();
                assert_eq!(together, alone);
            });
        }
    });
    let copy = run.clone();
    assert_eq!(copy.at(0.5).unwrap(), run.at(0.5).unwrap());
}

#[test]
fn stages_of_threads_do_not_mix() {
    let text = include_str!("../../machines/double_pendulum.machine");
    let staged = text.trim_end().trim_end_matches('}').to_owned() + "stages { coordinates } }";
    let system = InterpretedMachine::from_text(staged)
        .build()
        .unwrap()
        .prepare();
    let evaluate = |angle: f64| {
        let at = system
            .at_position(&system.at_time(0.0), &vec![angle, -angle])
            .unwrap();
        let mut a = vec![0.0; 2];
        system
            .accelerations_at(&at, &vec![0.0; 2], &system.default_inputs(), &mut a)
            .unwrap();
        a
    };
    let alone: Vec<_> = (0..100).map(|i| evaluate(f64::from(i))).collect();
    thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..20 {
                    for (i, alone) in (0..100).zip(&alone) {
                        assert_eq!(evaluate(f64::from(i)), *alone);
                    }
                }
            });
        }
    });
}

#[test]
fn attributes_before_a_machine_reach_its_structs() {
    let text = serde_json::to_string(&Pair::default()).unwrap();
    assert_eq!(text, r#"{"M":1.0,"K":[4.0,4.0]}"#);
    let back: Pair = serde_json::from_str(r#"{"M":2.5,"K":[1.0,3.0]}"#).unwrap();
    assert_eq!((back.m, back.k), (2.5, [1.0, 3.0]));
    let start = back.start();
    let state: State<pair::Coordinates> =
        serde_json::from_str(&serde_json::to_string(&start).unwrap()).unwrap();
    assert_eq!(state, start);
    let inputs = serde_json::to_string(&pair::Inputs { push: 2.0 }).unwrap();
    assert_eq!(inputs, r#"{"PUSH":2.0}"#);
}

#[test]
fn what_happened_is_data() {
    let pair = Pair::default();
    let run = Simulation::new(&pair)
        .until(1.0)
        .every(0.5)
        .energy_balance(true)
        .event("middle", Crossing::Falling, |state| state.q.x)
        .run(pair.start())
        .unwrap();
    let data: serde_json::Value = serde_json::to_value(&run).unwrap();
    assert_eq!(data["end"]["q"]["X"], run.end().q.x);
    assert_eq!(data["samples"].as_array().unwrap().len(), 3);
    assert_eq!(data["statistics"]["steps"], run.statistics().steps);
    let events: Vec<Event<pair::Coordinates>> =
        serde_json::from_value(data["events"].clone()).unwrap();
    assert_eq!(events, run.events());
    let text = "machine M in plane { coordinates { x: m } bodies { b { mass: 1, at: (xx, 0) } } }";
    let interpreted = InterpretedMachine::from_text(text.replace("xx", "x"))
        .build()
        .unwrap();
    let named = serde_json::to_string(&interpreted.start().q).unwrap();
    assert_eq!(named, r#"{"x":0.0}"#);
    let error = InterpretedMachine::from_text(text).build().unwrap_err();
    let data = serde_json::to_value(&error).unwrap();
    let first = &data["Spec"]["diagnostics"][0];
    assert_eq!(
        (&first["code"], &first["line"]),
        (&"unknown-name".into(), &1.into())
    );
    assert!(matches!(error, Error::Spec { .. }));
}

fn can_be_copied_and_sent<T: Clone + Send>(_: &T) {}

/// A copy of a simulation has its own copies of the events and of the controller, with their state; observers
/// are shared with the original.
#[test]
fn copies_of_a_simulation_run_on_other_threads() {
    let pair = Pair::default();
    let seen = std::sync::Mutex::new(0);
    let mut looks = 0;
    let simulation = Simulation::new(&pair)
        .until(2.0)
        .event("middle", Crossing::Any, |state| state.q.x)
        .until_event_on("far", Crossing::Rising, |seen| seen.q.x - 100.0)
        .stop_if(|state| state.q.y > 100.0)
        .observe(0.5, |_| *seen.lock().unwrap() += 1)
        // The input depends on the number of calls, so a copy that shared the count would move differently.
        .sampled(0.25, move |_, inputs| {
            looks += 1;
            inputs.push = f64::from(looks);
        });
    can_be_copied_and_sent(&simulation);
    let start = pair.start();
    let end = |simulation: Simulation<'_, Pair>| {
        let run = simulation.run(start).unwrap();
        (*run.end(), run.events().len())
    };
    let together = thread::scope(|scope| {
        let copies: Vec<_> = (0..3).map(|_| simulation.clone()).collect();
        let threads: Vec<_> = copies
            .into_iter()
            .map(|copy| scope.spawn(move || end(copy)))
            .collect();
        let ends = threads.into_iter().map(|thread| thread.join().unwrap());
        ends.collect::<Vec<_>>()
    });
    let alone = end(simulation);
    assert_eq!(together, [alone; 3]);
    // The observer is called at the start, three times on the way and at the end, in each of four runs.
    assert_eq!(*seen.lock().unwrap(), 4 * 5);
}

/// A program can choose at run time how inputs are set, and the simulation keeps one type.
#[test]
fn inputs_may_be_chosen_at_run_time() {
    let pair = Pair::default();
    let runs = [false, true].map(|is_pushed| {
        let mut simulation = Simulation::new(&pair).until(1.0).any_inputs();
        if is_pushed {
            let pushed = Simulation::new(&pair).until(1.0);
            simulation = pushed.inputs(|t, _, _, u| u.push = t).any_inputs();
        }
        can_be_copied_and_sent(&simulation);
        *simulation.run(pair.start()).unwrap().end()
    });
    let [plain, pushed] = [
        Simulation::new(&pair)
            .until(1.0)
            .run(pair.start())
            .map(|run| *run.end()),
        Simulation::new(&pair)
            .until(1.0)
            .inputs(|t, _, _, u| u.push = t)
            .run(pair.start())
            .map(|run| *run.end()),
    ]
    .map(Result::unwrap);
    assert_eq!(runs, [plain, pushed]);
    assert_ne!(plain, pushed);
}
