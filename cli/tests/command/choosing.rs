//! `--method auto`: the methods that a run takes, against closed forms, against each method alone, and against repetition.

use serde_json::Value;

use crate::support::{Scratch, json, lagrangian};

/// Runs a command that must succeed; returns its JSON.
fn answer(arguments: &[&str]) -> Value {
    json(&[&["simulate"], arguments, &["--json"]].concat())
}

/// The methods of a run.
fn methods(run: &Value) -> Vec<&str> {
    let methods = run["methods"].as_array().expect("a list");
    methods
        .iter()
        .filter_map(|of| of["method"].as_str())
        .collect()
}

fn evaluations(run: &Value) -> f64 {
    run["evaluations"].as_f64().expect("a number")
}

/// A slow oscillation, x = cos t, and a mass that creeps back in a viscous oil: y ~ exp(−t/2). The fast mode, at 2e4/s, decays at once.
const DAMPED: &str = "machine Damped in plane {
    parameters { k: N/m = 1, c: N*s/m = 2e4 }
    coordinates { x: m = 1, y: m = 1 }
    bodies { a { mass: 1, at: (x, 0) }, b { mass: 1, at: (0, y) } }
    springs { slow { stiffness: k, stretch: x }, fast { stiffness: 1e4*k, stretch: y } }
    dissipations { oil: 1/2*c*der(y)^2 }
}";

#[test]
fn what_is_not_stiff_is_run_by_dop853_to_its_bits() {
    for (spec, until) in [
        ("machines/double_pendulum.machine", "10"),
        ("machines/crusher9.machine", "2"),
        ("machines/four_bar.machine", "3"),
        ("machines/block_on_incline.machine", "1"),
    ] {
        let [free, fixed] =
            ["auto", "dop853"].map(|method| answer(&[spec, "--until", until, "--method", method]));
        assert_eq!(methods(&free), ["dop853"], "{spec}");
        for name in ["q", "v", "steps", "evaluations"] {
            assert_eq!(free[name], fixed[name], "{spec}: {name}");
        }
    }
}

#[test]
fn what_is_stiff_goes_on_by_a_method_of_radau_whose_order_the_tolerance_asks_for() {
    let scratch = Scratch::new("damped.machine", DAMPED);
    let until = 30.0_f64;
    for (tolerance, method) in [("1e-5", "radau5"), ("1e-8", "radau9"), ("1e-11", "radau13")] {
        let call = [scratch.path(), "--until", "30", "--tolerance", tolerance];
        let run = answer(&call);
        assert_eq!(methods(&run), ["dop853", method], "{run:#}");
        let since = run["methods"][1]["t"].as_f64().expect("a number");
        // About 110 steps of 6.1/c.
        assert!(since < 200.0 * 6.1 / 2e4, "{since}");
        let bound = 1e3 * tolerance.parse::<f64>().expect("a number");
        let x = run["q"]["x"].as_f64().expect("a number");
        assert!((x - until.cos()).abs() < bound, "{tolerance}: {x}");
        let alone = answer(&[&call[..], &["--method", method]].concat());
        // The cost of the detection: a hundred steps, and those of the test.
        assert!(
            evaluations(&run) < evaluations(&alone) + 150.0 * 12.0,
            "{tolerance}: {} and {}",
            run["evaluations"],
            alone["evaluations"]
        );
    }
}

/// As before, but the viscosity decreases, so the machine does not stay stiff.
const THINNING: &str = "machine Thinning in plane {
    parameters { k: N/m = 1, c: N*s/m = 2e4 }
    coordinates { x: m = 1, y: m = 1 }
    bodies { a { mass: 1, at: (x, 0) }, b { mass: 1, at: (0, y) } }
    springs { slow { stiffness: k, stretch: x }, other { stiffness: k, stretch: y } }
    dissipations { oil: 1/2*c*exp(-2*t/(1*s))*der(y)^2 }
}";

#[test]
fn what_is_stiff_no_more_goes_back() {
    let scratch = Scratch::new("thinning.machine", THINNING);
    let run = answer(&[scratch.path(), "--until", "60"]);
    assert_eq!(methods(&run), ["dop853", "radau9", "dop853"], "{run:#}");
    let back = run["methods"][2]["t"].as_f64().expect("a number");
    // c exp(−2t) falls below the rate of a step of dop853, about 10/s, at 3.8 s.
    assert!((3.0..20.0).contains(&back), "{back}");
    let x = run["q"]["x"].as_f64().expect("a number");
    assert!((x - 60.0_f64.cos()).abs() < 1e-6, "{x}");
}

#[test]
fn a_run_that_changes_its_method_has_the_same_bits_each_time_and_whatever_is_recorded() {
    let scratch = Scratch::new("thinning_again.machine", THINNING);
    let table = Scratch::new("thinning.csv", "");
    let call = [scratch.path(), "--until", "60"];
    let runs = [
        answer(&call),
        answer(&call),
        answer(&[&call[..], &["--out", table.path(), "--every", "0.5"]].concat()),
    ];
    assert_eq!(runs[1]["evaluations"], runs[0]["evaluations"]);
    // Recording costs evaluations, with `dop853` three in each step, but does not change the run.
    for run in &runs[1..] {
        for name in ["q", "v", "steps", "methods"] {
            assert_eq!(run[name], runs[0][name], "{name}");
        }
    }
    // The record between steps is equally accurate with either method.
    let text = std::fs::read_to_string(table.path()).expect("a table");
    let mut rows = text.lines();
    let columns: Vec<&str> = rows.next().expect("a header").split(',').collect();
    let x = columns
        .iter()
        .position(|name| name.split(' ').next() == Some("x"))
        .expect("a column");
    for row in rows {
        let row: Vec<f64> = row
            .split(',')
            .map(|x| x.parse().expect("a number"))
            .collect();
        assert!((row[x] - row[0].cos()).abs() < 1e-6, "{row:?}");
    }
}

/// An oscillation, x = cos t, of 300 periods.
const OSCILLATING: &str = "machine Oscillating in plane {
    parameters { k: N/m = 1 }
    coordinates { x: m = 1 }
    bodies { a { mass: 1, at: (x, 0) } }
    springs { back { stiffness: k, stretch: x } }
}";

#[test]
fn what_runs_long_goes_on_by_series_with_either_engine() {
    let scratch = Scratch::new("oscillating.machine", OSCILLATING);
    let call = [scratch.path(), "--until", "1885", "--tolerance", "1e-12"];
    let run = answer(&call);
    assert_eq!(methods(&run), ["dop853", "taylor"], "{run:#}");
    let since = run["methods"][1]["t"].as_f64().expect("a number");
    assert!((1.0..1885.0 / 4.0).contains(&since), "{since}");
    let reason = run["methods"][1]["reason"].as_str().expect("a reason");
    assert!(reason.starts_with("a step by series costs"), "{reason}");
    // Two thousand steps, with errors of the phase that add up.
    let x = run["q"]["x"].as_f64().expect("a number");
    assert!((x - 1885.0_f64.cos()).abs() < 2e3 * 1e-12, "{x}");
    let interpreted = answer(&[&call[..], &["--engine", "interpreter"]].concat());
    let table = Scratch::new("oscillating.csv", "");
    let recorded = answer(&[&call[..], &["--out", table.path(), "--every", "0.5"]].concat());
    for other in [interpreted, recorded] {
        for name in ["q", "v", "steps", "methods"] {
            assert_eq!(other[name], run[name], "{name}");
        }
    }
    // The derivation and the comparison of both methods are all that the choice costs.
    let alone = answer(&[&call[..], &["--method", "taylor"]].concat());
    let steps = |run: &Value| run["steps"].as_f64().expect("a number");
    assert!(steps(&run) < 1.2 * steps(&alone) + 1000.0, "{run:#}");
    let text = String::from_utf8(lagrangian(&[&["simulate"], &call[..]].concat()).stdout);
    let text = text.expect("text");
    assert!(text.contains("  taylor from t = "), "{text}");
}

#[test]
fn the_summary_says_what_was_chosen_and_why() {
    let scratch = Scratch::new("told.machine", DAMPED);
    let output = lagrangian(&["simulate", scratch.path(), "--until", "1"]);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(
        text.contains("dop853 from t = 0 s: nothing is known to be stiff"),
        "{text}"
    );
    assert!(text.contains("radau9 from t = 0.0"), "{text}");
    assert!(
        text.contains("limited by stability and not by accuracy; the fastest rate is 2.0e4/s"),
        "{text}"
    );
    // There is no warning.
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

/// A mass in a carriage that is shaken up and down by y = A sin ωt, at rest in the carriage.
const CARRIED: &str = "machine Carried in plane {
    parameters { m: kg = 2, k: N/m = 50, A: m = 0.3, omega: rad/s = 2, g: m/s^2 = 9.81 }
    coordinates { x: m }
    bodies { a { mass: m, at: (x, A*sin(omega*t)) } }
    springs { s { stiffness: k, stretch: x } }
    gravity (0, -g);
}";

/// Steps of methods for stiff machines are as long as the motion in the coordinates allows, and there is none. The work of what shakes the carriage
/// changes the energy by m/2 A²ω² (cos² ωt − 1) + m g A sin ωt.
#[test]
fn work_is_integrated_where_nothing_moves_in_the_coordinates() {
    let scratch = Scratch::new("carried.machine", CARRIED);
    for method in ["dop853", "radau5", "radau9", "radau13", "taylor"] {
        let run = answer(&[scratch.path(), "--until", "3.3", "--method", method]);
        assert_eq!(run["error"], Value::Null, "{method}: {run:#}");
        let residual = run["energy_residual"].as_f64().expect("a number");
        // The energies of a machine at rest are exact. The work may have an error of the tolerance, 1e-9, times the energies, of which there
        // are 6 J.
        assert!(residual.abs() < 6e-9, "{method}: {residual}");
    }
}
