//! Runs in lanes: machine code on several runs side by side gives the rows of the interpreter on one run after the other, in every bit.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use lagrangian::interpreted::Engine;
use lagrangian_sweep::design::{Distribution, Factor, Sampling};
use lagrangian_sweep::plan::{Function, Law, Reduction, SpecText, Watch};
use lagrangian_sweep::rows::Values;
use lagrangian_sweep::{Plan, Sweep};

fn plan(text: &str, until: f64, design: Vec<Factor>) -> Plan {
    let spec = SpecText {
        name: "machine".into(),
        text: text.into(),
        ..SpecText::default()
    };
    Plan {
        design,
        ..Plan::new(spec, until)
    }
}

fn library(name: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../machines");
    std::fs::read_to_string(root.join(name).with_extension("machine")).expect("a machine")
}

fn grid(name: &str, from: f64, to: f64, count: u64) -> Factor {
    Factor::Grid {
        name: name.into(),
        from,
        to,
        count,
        log: false,
    }
}

fn reduce(name: &str, function: Function, of: &str) -> Reduction {
    Reduction {
        name: name.into(),
        function,
        of: of.into(),
    }
}

fn watch(name: &str, formula: &str, ends: bool) -> Watch {
    Watch {
        name: name.into(),
        formula: formula.into(),
        ends,
    }
}

/// All rows and samples, computed in pieces of `piece` runs and printed with enough digits to tell any two numbers apart.
fn rows(sweep: &Sweep, piece: u64) -> (String, u64) {
    let (mut all, mut samples) = (sweep.empty_rows(), sweep.empty_samples());
    let (stop, runs) = (AtomicBool::new(false), sweep.plan().runs());
    let (mut from, mut failed) = (0, 0);
    while from < runs {
        let to = runs.min(from + piece);
        let chunk = sweep
            .run(from..to, &stop, &|_| ())
            .expect("nobody stops it");
        failed += chunk.failed;
        all.extend(chunk.rows);
        if let (Some(all), Some(more)) = (&mut samples, chunk.samples) {
            all.extend(more);
        }
        from = to;
    }
    (format!("{all:?} {samples:?}"), failed)
}

/// Compares lanes, in pieces of several sizes, with the interpreter, and returns how many runs failed. Without
/// machine code it compares nothing.
fn compare(plan: &Plan) -> u64 {
    // One run alone, too few for lanes, fewer than lanes, as many, more, and lanes that are filled again.
    compare_in_pieces(plan, &[1, 2, 5, 8, 13, plan.runs()])
}

fn compare_in_pieces(plan: &Plan, pieces: &[u64]) -> u64 {
    let alone = Sweep::new(plan.clone(), Engine::Interpreter).expect("a plan");
    let (truth, failed) = rows(&alone, plan.runs());
    if let Ok(in_lanes) = Sweep::new(plan.clone(), Engine::Jit) {
        assert!(in_lanes.may_run_in_lanes(), "{plan:?}");
        for &piece in pieces {
            let (found, also_failed) = rows(&in_lanes, piece);
            assert!(found == truth, "pieces of {piece}: {plan:?}");
            assert_eq!(also_failed, failed);
        }
    }
    if let Ok(automatic) = Sweep::new(plan.clone(), Engine::Auto) {
        // The automatic engine changes to machine code during the sweep.
        assert!(rows(&automatic, plan.runs()).0 == truth, "{plan:?}");
    }
    failed
}

#[test]
fn library_machines_by_every_explicit_method() {
    for (name, varied, until) in [
        ("double_pendulum", grid("start(theta1)", 0.2, 3.0, 21), 2.0),
        ("vibrating_crusher", grid("omega", 100.0, 180.0, 19), 0.2),
        ("kapitza_pendulum", grid("start(theta)", 2.0, 3.1, 19), 0.2),
        ("elastic_pendulum", grid("rate(theta)", 0.0, 1.0, 18), 1.0),
        (
            "gyroscope_in_gimbals",
            grid("rate(gamma)", 9.0, 90.0, 18),
            0.5,
        ),
        ("spring_mass_train", grid("pull", 0.0, 300.0, 17), 1.0),
        ("cart_pole", grid("start(theta)", 0.1, 3.0, 18), 1.0),
    ] {
        for method in ["dop853", "dopri5", "bs32"] {
            let mut plan = plan(&library(name), until, vec![varied.clone()]);
            plan.method = method.into();
            plan.tolerance = 1e-7;
            plan.at = vec![0.3 * until, until];
            assert_eq!(compare(&plan), 0, "{name}");
        }
    }
}

/// Constraints of positions and of rates; redundant constraints, whose runs are made alone; mechanisms that pass poses where their
/// constraints become redundant.
#[test]
fn constraints_hold_in_lanes() {
    for (name, varied, until) in [
        ("four_bar", grid("omega", 1.0, 8.0, 19), 0.6),
        ("slider_crank", grid("omega", 5.0, 20.0, 18), 0.3),
        ("closed_pendulum", grid("rate(q[1])", -0.5, 0.5, 17), 0.5),
        (
            "andrews_squeezer",
            grid("start(beta)", -0.07, -0.05, 9),
            0.01,
        ),
        ("chaplygin_sleigh", grid("rate(phi)", 1.0, 6.0, 19), 1.0),
        ("rattleback", grid("rate(psi)", -6.0, -4.0, 10), 0.2),
        ("rolling_coin", grid("rate(roll)", 7.0, 9.0, 18), 0.3),
        ("bricard", grid("start(q[1])", 0.1, 1.0, 9), 0.3),
        ("four_bars", grid("v0", -1.5, -0.5, 9), 2.5),
    ] {
        for method in ["dop853", "dopri5"] {
            let mut plan = plan(&library(name), until, vec![varied.clone()]);
            plan.method = method.into();
            plan.tolerance = 1e-7;
            plan.at = vec![0.3 * until, until];
            compare(&plan);
        }
    }
}

/// Runs that choose their methods, each of them too short for a series alone: as one of all runs of the plan they go by series, after some steps or, if
/// there are enough of them, from their start on. Which runs are made together, and which are made at all, makes no difference.
#[test]
fn runs_that_share_the_derivation_of_a_series_have_the_same_bits_in_every_piece() {
    let expected = [(40, "dop853, taylor"), (4000, "taylor")];
    for (name, varied, until) in [
        ("double_pendulum", ("start(theta1)", 0.2, 3.0), 5.0),
        ("crusher9", ("start(x)", 0.0, 0.01), 3.0),
        ("four_bar", ("omega", 4.0, 8.0), 1.0),
    ] {
        for (count, methods) in expected {
            let (varied, from, to) = varied;
            let design = vec![grid(varied, from, to, count)];
            let plan = plan(&library(name), until, design);
            let alone = Sweep::new(plan.clone(), Engine::Interpreter).expect("a plan");
            let stop = AtomicBool::new(false);
            let some = |sweep: &Sweep, from: u64, to: u64| {
                let made = sweep
                    .run(from..to, &stop, &|_| ())
                    .expect("nobody stops it");
                assert_eq!(made.failed, 0, "{name}");
                made.rows
            };
            let truth = some(&alone, 20, 40);
            let Some(Values::Text(told)) = truth.column("methods") else {
                panic!("{name}: no methods");
            };
            let without_reasons = |of: &String| {
                let names = of
                    .split(", ")
                    .map(|one| one.split(' ').next().unwrap_or(""));
                names.collect::<Vec<_>>().join(", ")
            };
            for told in told.iter().flatten() {
                assert_eq!(without_reasons(told), methods, "{name}, {count} runs");
            }
            let truth = format!("{truth:?}");
            if let Ok(in_lanes) = Sweep::new(plan.clone(), Engine::Jit) {
                for piece in [1, 5, 20] {
                    let mut found = in_lanes.empty_rows();
                    for from in (20..40).step_by(piece as usize) {
                        found.extend(some(&in_lanes, from, from + piece));
                    }
                    assert!(format!("{found:?}") == truth, "{name}: pieces of {piece}");
                }
            }
        }
    }
}

/// Random values of these names, each between two ends.
fn random(seed: u64, count: u64, of: &[(&str, f64, f64)]) -> Factor {
    let variable = |&(name, from, to): &(&str, f64, f64)| {
        let name: String = name.into();
        (name, Distribution::Uniform(from, to))
    };
    Factor::Sample {
        design: Sampling::Random,
        count,
        seed,
        variables: of.iter().map(variable).collect(),
    }
}

/// A block that a spring drives against a layer, which it crushes, and a compliant wall.
const LAYER: &str = "machine Layer in plane {
    parameters { m: kg = 1, k: N/m = 5000, k1: N/m = 2e4, k2: N/m = 8e4, w: rad/s = 60, A: m = 0.02 }
    coordinates { x: m = 0 }
    bodies { block { mass: m, at: (x, 0) } }
    gravity none;
    springs { drive { stiffness: k, stretch: x - A*sin(w*t) } }
    contacts {
        bed { gap: x + 0.01, compliance: layer(k1, k2) },
        wall { gap: 0.03 - x, compliance: linear(2e4, 5) },
    }
}";

/// A pendulum in Cartesian coordinates that swings against a wall and rests there.
const ROD: &str = "machine Rod in plane {
    parameters { m: kg = 1, l: m = 1, e: 1 = 0.5, mu: 1 = 0.2, g: m/s^2 = 9.81 }
    coordinates { x: m = 1, y: m = 0 }
    bodies { bob { mass: m, at: (x, y) } }
    gravity (0, -g);
    constraints { rod: x^2 + y^2 = l^2 }
    contacts { wall { gap: x + 0.3, slip: der(y), restitution: e, friction: mu } }
}";

/// Each run has its own impacts, and contacts that stay closed for a while or for good: bounces that end, friction that sticks and slips,
/// compliance, layers, polygons, contacts of machines with constraints.
#[test]
fn contacts_hold_in_lanes() {
    for (name, varied, contact, until) in [
        (
            "bouncing_ball",
            vec![("start(y)", 0.1, 1.0), ("e", 0.3, 0.9)],
            "floor",
            3.0,
        ),
        (
            "shaken_box",
            vec![("w", 20.0, 60.0), ("e", 0.5, 1.0)],
            "left",
            1.0,
        ),
        (
            "impact_pair",
            vec![("w", 5.0, 20.0), ("e", 0.5, 0.9)],
            "left",
            2.0,
        ),
        (
            "impact_oscillator",
            vec![("w", 2.0, 4.0), ("F", 0.1, 1.0), ("d", 0.01, 0.4)],
            "stop",
            10.0,
        ),
        (
            "colliding_crusher",
            vec![("w", 80.0, 160.0), ("mu", 0.1, 0.5)],
            "outer",
            0.08,
        ),
        (
            "woodpecker",
            vec![("rate(y)", -0.4, -0.2), ("mu", 0.2, 0.4)],
            "beak",
            0.3,
        ),
        (
            "slider_crank_clearance",
            vec![("e", 0.3, 0.9)],
            "upper_left",
            0.04,
        ),
        ("dropped_box", vec![("pitch", 0.05, 0.6)], "", 0.3),
        ("cue_ball", vec![("mu", 0.1, 0.4)], "cloth", 0.2),
        ("layer", vec![("w", 30.0, 90.0)], "bed", 0.3),
        ("rod", vec![("e", 0.3, 0.9), ("mu", 0.0, 0.5)], "wall", 4.0),
    ] {
        let text = match name {
            "layer" => LAYER.into(),
            "rod" => ROD.into(),
            name => library(&format!("contacts/{name}")),
        };
        for method in ["dop853", "bs32"] {
            let mut plan = plan(&text, until, vec![random(16, 13, &varied)]);
            plan.method = method.into();
            plan.tolerance = if method == "bs32" { 1e-5 } else { 1e-8 };
            plan.at = vec![0.3 * until, until];
            if !contact.is_empty() {
                plan.reduce = vec![reduce("power", Function::Power, contact)];
            }
            assert_eq!(compare_in_pieces(&plan, &[5, 13]), 0, "{name}");
        }
    }
}

#[test]
fn what_is_recorded_on_the_way() {
    let text = library("double_pendulum");
    let mut plan = plan(
        &text,
        4.0,
        vec![grid("start(theta1)", 0.5, 3.0, 9), grid("m2", 0.5, 1.5, 3)],
    );
    plan.events = vec![
        watch("down", "theta1", false),
        watch("over", "theta2^2 - 9.8", true),
    ];
    plan.reduce = vec![
        reduce("fast", Function::Max, "abs(der(theta2))"),
        reduce("mean", Function::Mean, "der(der(theta1))"),
        reduce("downs", Function::Count, "down"),
    ];
    plan.after = Some(0.5);
    plan.every = Some(0.25);
    assert_eq!(compare(&plan), 0);
    // Samples at events instead, and backward in time.
    plan.every = None;
    plan.at_events = vec!["down".into()];
    assert_eq!(compare(&plan), 0);
    plan.until = -2.0;
    plan.after = None;
    assert_eq!(compare(&plan), 0);
}

/// Heights that differ from the highest point of a throw by less than a step covers are passed twice or not at all, alone and in lanes.
#[test]
fn what_comes_and_goes_within_a_step_is_the_same_in_lanes() {
    let text = "machine Throw in plane {
        parameters { m: kg = 1, g: m/s^2 = 9.81, level: m = 1 }
        coordinates { y: m = 0 }
        bodies { ball { mass: m, at: (0, y) } }
        gravity (0, -g);
    }";
    let highest = 12.5 / 9.81;
    for method in ["dop853", "dopri5"] {
        let levels = grid("level", highest - 9e-9, highest + 9e-9, 18);
        let mut plan = plan(text, 2.0, vec![levels]);
        plan.rate = vec![("y".into(), 5.0)];
        plan.method = method.into();
        plan.events = vec![watch("level", "y - level", false)];
        plan.reduce = vec![
            reduce("times", Function::Count, "level"),
            reduce("when", Function::First, "level"),
        ];
        assert_eq!(compare(&plan), 0);
    }
}

/// The pendulum released at 0.1 swings for a minute; all others turn over within seconds and free their lanes.
#[test]
fn one_run_is_far_longer_than_the_others() {
    let text = library("double_pendulum");
    let mut starts = vec![vec![0.1]];
    starts.extend((0..40).map(|i| vec![2.0 + 0.025 * f64::from(i)]));
    let design = vec![Factor::List {
        names: vec!["start(theta1)".into()],
        rows: starts,
    }];
    let mut plan = plan(&text, 60.0, design);
    plan.events = vec![watch("over", "theta2^2 - 9.8", true)];
    assert_eq!(compare(&plan), 0);
}

/// Events of the call, samples at them and reductions along runs with impacts; some runs end at an event just when a contact closes.
#[test]
fn events_between_impacts() {
    let mut plan = plan(
        &library("contacts/bouncing_ball"),
        3.0,
        vec![random(7, 37, &[("start(y)", 0.1, 1.0), ("e", 0.3, 0.9)])],
    );
    plan.events = vec![
        watch("rises or falls", "der(y)", false),
        watch("fast", "der(y) - 3.5", true),
    ];
    plan.reduce = vec![
        reduce("highest", Function::Max, "y"),
        reduce("mean", Function::Mean, "abs(der(y))"),
        reduce("bounces", Function::Count, "rises or falls"),
    ];
    plan.after = Some(0.5);
    plan.at_events = vec!["rises or falls".into()];
    assert_eq!(compare(&plan), 0);
}

/// A mass falls into an attracting centre, where the force is undefined; from other starts it swings past.
const FALLING: &str = "machine Falling in plane {
    parameters { m: kg = 1, k: J*m = 1 }
    coordinates { x: m = 1, y: m = 0 }
    bodies { block { mass: m, at: (x, y) } }
    potentials { attraction: -k/sqrt(x^2 + y^2) }
}";

/// The inertia of `s` is 0 where `s` is 0, so accelerations are undefined there.
const CUSP: &str = "machine Cusp in plane {
    parameters { m: kg = 1, g: m/s^2 = 9.81, l: m = 1, top: m = 1 }
    coordinates { s: m = 1 }
    bodies { bead { mass: m, at: (s^2/(2*l), s^3/(3*l^2)) } }
    gravity (-g, -g);
    assume { s < top }
}";

#[test]
fn runs_that_fail_in_the_middle_of_others() {
    let mut falling = plan(FALLING, 3.0, vec![grid("rate(y)", -0.5, 0.5, 21)]);
    assert!(compare(&falling) >= 1);
    // Runs that pass near the centre need more steps than permitted, of this method: as 21 runs that share the derivation they would go by series, in fewer.
    falling.method = "dop853".into();
    falling.max_steps = 90;
    let failed = compare(&falling);
    assert!((2..21).contains(&failed), "{failed} failed");

    // Some runs meet the cusp, some reach the end that the spec sets, and some neither; a negative mass is refused.
    let mut cusp = plan(
        CUSP,
        0.3,
        vec![grid("start(s)", 0.1, 2.0, 20), grid("m", -1.0, 1.0, 3)],
    );
    cusp.set = vec![("top".into(), 1.7)];
    let failed = compare(&cusp);
    assert!((40..60).contains(&failed), "{failed} failed");
    // Backward in time the beads rise, and end later.
    cusp.until = -0.3;
    compare(&cusp);
}

/// A mass of 1 kg on a spring, pushed by an input.
const OSCILLATOR: &str = "machine Oscillator in plane {
    parameters { m: kg = 1, k: N/m = 4, c: N*s/m = 0.1 }
    coordinates { x: m = 0.1 }
    inputs { push: N = 0 }
    bodies { block { mass: m, at: (x, 0) } }
    springs { spring { stiffness: k, stretch: x } }
    dampers { damper { damping: c, stretch: x } }
    forces { push { on: x, value: push } }
}";

#[test]
fn inputs_that_stay_and_inputs_that_change() {
    let mut plan = plan(
        OSCILLATOR,
        3.0,
        vec![grid("push", -1.0, 1.0, 11), grid("k", 1.0, 9.0, 3)],
    );
    assert_eq!(compare(&plan), 0);
    plan.design.remove(0);
    plan.design.push(grid("m", 0.5, 2.0, 7));
    for law in [
        Law::Formula("2*N".into()),
        Law::Formula("0.5*N*cos(3*rad/s*t) - k*x".into()),
        Law::Sampled {
            formula: "-k*x".into(),
            every: 0.1,
            delay: 0.0,
        },
    ] {
        plan.inputs = vec![("push".into(), law)];
        assert_eq!(compare(&plan), 0);
    }
}

/// Each run by Taylor series has its own steps, with parameters of its own; some end earlier than others.
#[test]
fn steps_by_series_in_lanes() {
    for (name, varied, until) in [
        ("double_pendulum", grid("start(theta1)", 0.2, 3.0, 21), 4.0),
        ("double_pendulum", grid("m2", 0.5, 1.5, 9), 4.0),
        ("vibrating_crusher", grid("omega", 100.0, 180.0, 13), 0.2),
        ("elastic_pendulum", grid("rate(theta)", 0.0, 1.0, 18), 3.0),
        ("heavy_top", grid("rate(psi)", 0.0, 2.0, 11), 0.5),
        ("spherical_pendulum", grid("rate(phi)", 0.1, 2.0, 11), 2.0),
        ("spring_mass_train", grid("pull", 0.0, 300.0, 17), 1.0),
        ("four_bar", grid("omega", 1.0, 8.0, 12), 0.6),
        ("flyball_governor", grid("start(alpha)", 0.4, 0.6, 9), 0.3),
    ] {
        for tolerance in [1e-4, 1e-9, 1e-13] {
            let mut plan = plan(&library(name), until, vec![varied.clone()]);
            plan.method = "taylor".into();
            plan.tolerance = tolerance;
            plan.at = vec![0.3 * until, until];
            compare_in_pieces(&plan, &[2, 8, plan.runs()]);
        }
    }
}

#[test]
fn what_is_recorded_along_series_in_lanes() {
    let text = library("double_pendulum");
    let mut plan = plan(
        &text,
        4.0,
        vec![grid("start(theta1)", 0.5, 3.0, 9), grid("m2", 0.5, 1.5, 3)],
    );
    plan.method = "taylor".into();
    plan.events = vec![
        watch("down", "theta1", false),
        watch("over", "theta2^2 - 9.8", true),
    ];
    plan.reduce = vec![
        reduce("fast", Function::Max, "abs(der(theta2))"),
        reduce("downs", Function::Count, "down"),
    ];
    plan.every = Some(0.25);
    assert_eq!(compare(&plan), 0);
    plan.until = -2.0;
    assert_eq!(compare(&plan), 0);

    // Runs that come near an undefined state fail alone, and the others go on.
    let mut falling = self::plan(FALLING, 3.0, vec![grid("rate(y)", -0.5, 0.5, 21)]);
    falling.method = "taylor".into();
    assert!(compare(&falling) >= 1);
    falling.max_steps = 30;
    compare(&falling);
}

/// Long runs go on by series, and so leave the lanes of `dop853` for those of series; stiff runs go on alone; neither depends on the others.
#[test]
fn runs_that_change_their_method_among_others() {
    let mut long = plan(
        &library("double_pendulum"),
        150.0,
        vec![grid("start(theta1)", 0.2, 0.8, 13)],
    );
    long.tolerance = 1e-12;
    long.start = vec![("theta2".into(), 0.1)];
    // The last runs are too short to change; all others stay below this angle by their energy.
    long.events = vec![watch("below", "theta1 - 0.69", true)];
    assert_eq!(compare_in_pieces(&long, &[5, 13]), 0);
    let sweep = Sweep::new(long.clone(), Engine::Jit).expect("a plan");
    let (all, _) = rows(&sweep, long.runs());
    assert!(all.contains("dop853, taylor from "), "{all}");
    assert!(all.contains("Some(\"dop853\")"), "{all}");

    let stiff = plan(
        "machine Damped in plane {
            parameters { m: kg = 1, k: N/m = 1, c: N*s/m = 1 }
            coordinates { x: m = 1 }
            bodies { a { mass: m, at: (x, 0) } }
            springs { s { stiffness: k, stretch: x } }
            dampers { d { damping: c, stretch: x } }
        }",
        40.0,
        vec![Factor::List {
            names: vec!["c".into()],
            rows: [1.0, 2.0, 3.0, 1e4, 4.0, 1e5, 5.0, 6.0, 7.0, 8.0]
                .map(|c| vec![c])
                .into(),
        }],
    );
    assert_eq!(compare_in_pieces(&stiff, &[10]), 0);
    let sweep = Sweep::new(stiff.clone(), Engine::Jit).expect("a plan");
    let (all, _) = rows(&sweep, stiff.runs());
    // Some go by series first, while what is fast decays.
    assert!(all.contains(", radau"), "{all}");
}
