//! The command as a user calls it: its output, the channel of each output, and the exit status.

mod engines;
mod kept;
mod told;

use std::io::Write;
use std::process::{Command, Output, Stdio};

use crate::support::{Scratch, lagrangian, number, root};
use serde_json::Value;

fn with_input(arguments: &[&str], input: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
    command.current_dir(root()).args(arguments);
    let pipes = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = pipes.spawn().expect("the command runs");
    child
        .stdin
        .take()
        .expect("a pipe")
        .write_all(input.as_bytes())
        .expect("it reads");
    child.wait_with_output().expect("it ends")
}

fn status(output: &Output) -> i32 {
    output.status.code().expect("no signal")
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).expect("text")
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("text")
}

fn json(output: &Output) -> Value {
    serde_json::from_str(&out(output)).unwrap_or_else(|error| panic!("{error}: {}", out(output)))
}

#[test]
fn what_was_chosen_stands_before_what_it_would_have_cost_otherwise() {
    let output = lagrangian(&["derive", "machines/chain.machine", "--json"]);
    let choices = &json(&output)["choices"]["accelerations"];
    let ways = choices.as_array().expect("several ways");
    let rounding = |way: &Value| number(&way["rounding"]);
    let cycles = |way: &Value| number(&way["cycles_alone"]) + number(&way["cycles_among_others"]);
    let least = ways.iter().map(rounding).fold(f64::INFINITY, f64::min);
    let exact: Vec<&Value> = ways
        .iter()
        .filter(|way| rounding(way) <= 2.0 * least)
        .collect();
    assert_eq!(exact[0], &ways[0]);
    assert!(exact.iter().all(|way| cycles(&ways[0]) <= cycles(way)));
}

#[test]
fn the_library_is_without_mistakes() {
    for entry in std::fs::read_dir(root().join("machines")).expect("the library") {
        let path = entry.expect("an entry").path();
        if path.extension().is_none_or(|ending| ending != "machine") {
            continue;
        }
        let output = lagrangian(&["check", path.to_str().expect("text"), "--deny-warnings"]);
        assert_eq!(status(&output), 0, "{}: {}", path.display(), err(&output));
    }
}

#[test]
fn mistakes_are_shown_where_they_are_all_at_once() {
    let spec = Scratch::new(
        "mistakes.machine",
        "machine Ball in plane {\n    parameters { m: kg = 1, g: m/s^2 = 9.81 }\n    coordinates { x: m }\n    \
         bodies { ball { mass: mq, at: (x, 0) } }\n    springs { s { stiffness: 3, stretch: x + g } }\n}\n",
    );
    let output = lagrangian(&["check", spec.path()]);
    assert_eq!(status(&output), 1);
    let text = err(&output);
    for words in ["[unknown-name]", "`m`", "4 |", "^^", "5 |", "m/s^2"] {
        assert!(text.contains(words), "no {words} in\n{text}");
    }
    let document = json(&lagrangian(&["check", spec.path(), "--json"]));
    let diagnostics = document["diagnostics"].as_array().expect("a list");
    assert_eq!(diagnostics.len(), 2);
    assert_eq!(diagnostics[0]["code"], "unknown-name");
    assert_eq!(
        (&diagnostics[0]["line"], &diagnostics[0]["column"]),
        (&4.into(), &27.into())
    );
    assert!(
        diagnostics[0]["file"]
            .as_str()
            .is_some_and(|file| file.ends_with("mistakes.machine"))
    );
}

#[test]
fn a_wrong_print_is_mended_and_a_right_one_agrees() {
    let spec = Scratch::new(
        "published.machine",
        "machine Ball in plane {\n    parameters { m: kg = 1, g: m/s^2 = 9.81 }\n    coordinates { x: m, y: m }\n    \
         bodies { ball { mass: m, at: (x, y) } }\n    gravity (0, -g);\n    \
         published \"Book\" {\n        kinetic_energy = 1/2*m*(der(x)^2 + der(y)^2),\n        \
         equation y: m*der(der(y)) - m*g = 0,\n    }\n}\n",
    );
    let document = json(&lagrangian(&["check", spec.path(), "--json"]));
    let published = document["published"].as_array().expect("a list");
    assert_eq!(published[0]["agrees"], true);
    assert_eq!(published[1]["agrees"], false);
    assert_eq!(published[1]["item"], "equation y");
    assert_eq!(published[1]["drop"].as_array().expect("a list").len(), 1);
    assert_eq!(published[1]["add"].as_array().expect("a list").len(), 1);
    // The sign is a misprint, and its two terms appear in both lists.
    let change = &published[1]["change"][0];
    assert_eq!(change["from"], published[1]["drop"][0]);
    assert_eq!(change["to"], published[1]["add"][0]);
    assert_eq!(published[0]["change"], Value::Array(Vec::new()));
    assert_eq!(published[1]["remarks"], Value::Array(Vec::new()));
    // A misprint is a result, not an error of the spec.
    assert_eq!(status(&lagrangian(&["check", spec.path()])), 0);
}

#[test]
fn a_print_is_mended_line_by_line() {
    let spec = Scratch::new(
        "mended.machine",
        "machine Ball in plane {\n    parameters { m: kg = 1, M: kg = 2, g: m/s^2 = 9.81 }\n    coordinates { x: m, y: m }\n    \
         bodies { ball { mass: m, at: (x, y) } }\n    gravity (0, -g);\n    \
         published \"Book\" {\n        kinetic_energy = 1/2*m*(der(x)^2 + y^2) + M*g*x,\n        \
         potential_energy = m*g*y,\n    }\n}\n",
    );
    let output = lagrangian(&["check", spec.path()]);
    let text = out(&output);
    let said: Vec<&str> = text.lines().skip(1).collect();
    let [differs, change, drop, units, agrees, sum] = said.as_slice() else {
        panic!("{text}");
    };
    assert_eq!(*differs, "Book: kinetic_energy: differs");
    let mended = "    change 1/2*m*(der(x)^2 + y^2) to 1/2*m*(der(x)^2 + der(y)^2)";
    assert_eq!(*change, mended);
    assert_eq!(*drop, "    drop M*g*x");
    assert!(
        units.starts_with("    units: ") && units.contains(".machine:7:"),
        "{units}"
    );
    assert!(
        units.contains("m^2/s^2") && units.ends_with("m^2"),
        "{units}"
    );
    assert_eq!(*agrees, "Book: potential_energy: agrees");
    assert_eq!(*sum, "Book: 1 of 2 formulas differs");
}

#[test]
fn the_papers_misprints_are_told() {
    let text = out(&lagrangian(&["check", "machines/paper_crusher.machine"]));
    assert!(
        text.ends_with("Part I: 16 of 31 formulas differ\n"),
        "{text}"
    );
    for line in [
        "    change -m*y0*der(x)*der(theta) to -m0*y0*der(x)*der(theta)\n",
        "    change der(m0) to m0\n",
        "    change m0*e*omega^2*cos(omega*der(t)) to m0*e*omega^2*cos(omega*t) on the right\n",
    ] {
        assert!(text.contains(line), "{text}");
    }
    let strict = lagrangian(&["check", "machines/paper_crusher.machine", "--strict"]);
    assert_eq!(status(&strict), 1);
    let page = out(&lagrangian(&[
        "derive",
        "machines/paper_crusher.machine",
        "--as",
        "html",
    ]));
    for print in ["omega*der(t)", "der(m0)"] {
        assert!(page.contains(print), "the page loses {print}");
    }
}

#[test]
fn evaluate_answers_every_point_and_keeps_their_order() {
    let points = r#"[
        {"q": [0, 0], "v": {"theta2": 2}, "parameters": {"g": 1, "m2": 3}},
        {"q": {"theta1": 1.5707963267948966, "theta2": 0}},
        {"q": [1]},
        {"q": {"theta3": 1}},
        {"nonsense": 1},
        {}
    ]"#;
    let output = with_input(
        &["evaluate", "machines/double_pendulum.machine", "--at", "-"],
        points,
    );
    assert_eq!(status(&output), 0, "{}", err(&output));
    let results = json(&output);
    let results = results.as_array().expect("a list");
    assert_eq!(results.len(), 6);
    // m1 = 1, m2 = 3, l1 = l2 = 1: M = [[4, 3], [3, 3]] with both hanging; T = ½·3·2².
    assert_eq!(
        results[0]["mass_matrix"],
        serde_json::json!([[4.0, 3.0], [3.0, 3.0]])
    );
    assert_eq!(number(&results[0]["kinetic_energy"]), 6.0);
    // The upper rod is horizontal, the lower one hangs: the bobs fall freely.
    assert!((number(&results[1]["accelerations"][0]) + 9.81).abs() < 1e-12);
    for (index, word) in [(2, "2 coordinates"), (3, "theta3"), (4, "nonsense")] {
        let error = results[index]["error"].as_str().expect("an error");
        assert!(error.contains(word), "{error}");
    }
    assert_eq!(results[5]["outputs"], serde_json::json!({}));
    assert_eq!(results[5]["multipliers"], serde_json::json!({}));
}

/// A list gives a family its members in their order, whatever their first index is, and a name belongs to one field of a point.
#[test]
fn evaluate_refuses_what_would_go_to_another_name() {
    let spec = Scratch::new(
        "row.machine",
        "machine Row in plane {
            parameters { k[0..2]: N/m = 1, m: kg = 1 }
            coordinates { x[0..2]: m = 1 }
            inputs { F: N }
            bodies { block[i in 0..2] { mass: m, at: (x[i], 0) } }
            gravity none;
            springs { spring[i in 0..2] { stiffness: k[i], stretch: x[i] } }
            forces { push { on: x[0], value: F } }
        }",
    );
    let points = r#"[
        {"parameters": {"k": [10, 20, 30]}, "q": {"x": [1, 2, 3]}},
        {"parameters": {"k[2]": 7, "k": 5}},
        {"parameters": {"k": [10, 20]}},
        {"q": {"x": [1, 2]}},
        {"parameters": {"m": [1]}},
        {"inputs": {"m": 2}},
        {"parameters": {"F": 2}},
        {"inputs": {"F": 2}}
    ]"#;
    let output = with_input(&["evaluate", spec.path(), "--at", "-"], points);
    assert_eq!(status(&output), 0, "{}", err(&output));
    let results = json(&output);
    let forces = |index: usize| results[index]["forces"].clone();
    assert_eq!(forces(0), serde_json::json!([-10.0, -40.0, -90.0]));
    assert_eq!(forces(1), serde_json::json!([-5.0, -5.0, -7.0]));
    for (index, words) in [
        (2, "`k` has 2 numbers, and the family has 3 members"),
        (3, "`x` has 2 numbers, and the family has 3 members"),
        (4, "`m` is not a family"),
        (5, "`m` is a parameter, which \"parameters\" sets"),
        (6, "`F` is an input, which \"inputs\" sets"),
    ] {
        let error = results[index]["error"].as_str().unwrap_or_default();
        assert!(error.contains(words), "{}", results[index]);
    }
    assert_eq!(forces(7), serde_json::json!([1.0, -1.0, -1.0]));
}

#[test]
fn evaluate_gives_multipliers_by_name_and_reactions_by_coordinate() {
    let spec = Scratch::new(
        "hung.machine",
        "machine Hung in plane {
            parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m = -l }
            bodies { bob { mass: m, at: (x, y) } }
            gravity (0, -g);
            constraints { rod: (x^2 + y^2 - l^2)/(2*l) = 0 }
        }",
    );
    let output = lagrangian(&["evaluate", spec.path(), "--rate", "x=3"]);
    assert_eq!(status(&output), 0, "{}", err(&output));
    let result = &json(&output)[0];
    // The rod carries the weight and provides the centripetal force; its gradient at the lowest point is (0, -1).
    let pull = 2.0 * (9.81 + 3.0 * 3.0 / 0.5);
    assert!((number(&result["multipliers"]["rod"]) + pull).abs() < 1e-13 * pull);
    assert!((number(&result["reactions"][1]) - pull).abs() < 1e-13 * pull);
    assert_eq!(number(&result["reactions"][0]), 0.0);
    assert!((number(&result["accelerations"][1]) - 18.0).abs() < 1e-13 * 18.0);
}

#[test]
fn a_constraint_that_is_said_twice_is_held_in_halves() {
    // The second constraint is twice the first: half of the tension is a quarter of the multiplier.
    let spec = Scratch::new(
        "twice.machine",
        "machine Twice in plane {
            parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81 }
            coordinates { x: m, y: m = -l }
            bodies { bob { mass: m, at: (x, y) } }
            gravity (0, -g);
            constraints { rod: (x^2 + y^2 - l^2)/(2*l) = 0, again: (x^2 + y^2 - l^2)/l = 0 }
        }",
    );
    let output = lagrangian(&["evaluate", spec.path(), "--rate", "x=3"]);
    assert_eq!(status(&output), 0, "{}", err(&output));
    let result = &json(&output)[0];
    let pull = 2.0 * (9.81 + 3.0 * 3.0 / 0.5);
    let near = |found: &Value, expected: f64| {
        assert!(
            (number(found) - expected).abs() < 1e-13 * pull,
            "{found} {expected}"
        );
    };
    near(&result["multipliers"]["rod"], -pull / 2.0);
    near(&result["multipliers"]["again"], -pull / 4.0);
    near(&result["reactions"][1], pull);
    near(&result["accelerations"][1], 18.0);

    // Hanging at rest, with accelerations of zero up to round-off.
    let spec = Scratch::new(
        "hanging.machine",
        "machine Hanging in plane {
            parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81 }
            coordinates { x: m = 0.3, y: m = -0.4 }
            bodies { bob { mass: m, at: (x, y) } }
            gravity (0.6*g, -0.8*g);
            constraints { rod: (x^2 + y^2 - l^2)/(2*l) = 0, again: (x^2 + y^2 - l^2)/l = 0 }
        }",
    );
    let output = lagrangian(&["evaluate", spec.path()]);
    near(&json(&output)[0]["multipliers"]["rod"], -9.81);
    let output = lagrangian(&["simulate", spec.path(), "--until", "0.1"]);
    assert_eq!(status(&output), 0, "{}", err(&output));

    // Two contradictory constraints have no solution; the error names them.
    let spec = Scratch::new(
        "torn.machine",
        "machine Torn in plane {
            parameters { m: kg = 2, w: m/s^2 = 3 }
            coordinates { x: m, y: m }
            bodies { bob { mass: m, at: (x, y) } }
            constraints { rests: y = x, leaves: y = x + w*t^2/2 }
        }",
    );
    let result = &json(&lagrangian(&["evaluate", spec.path()]))[0];
    let error = result["error"].as_str().expect("an error");
    assert!(
        error.contains("`rests`") || error.contains("`leaves`"),
        "{error}"
    );
}

#[test]
fn a_singular_state_is_an_error_of_its_point_only() {
    let points = r#"[{"q": {"s1": 0}}, {}]"#;
    let output = with_input(
        &["evaluate", "machines/crusher9.machine", "--at", "-"],
        points,
    );
    let results = json(&output);
    assert!(
        results[0]["error"]
            .as_str()
            .is_some_and(|error| error.contains("`phi1`")),
        "{results}"
    );
    assert!(results[1]["accelerations"].is_array());
    assert_eq!(status(&output), 0);
}

#[test]
fn simulate_reports_writes_and_draws() {
    let (csv, svg) = (Scratch::new("run.csv", ""), Scratch::new("run.svg", ""));
    let arguments = [
        "simulate",
        "machines/double_pendulum.machine",
        "--until",
        "1",
        "--tolerance",
        "1e-12",
        "--every",
        "0.25",
        "--out",
        csv.path(),
        "--plot",
        svg.path(),
        "--json",
    ];
    let output = lagrangian(&arguments);
    assert_eq!(status(&output), 0, "{}", err(&output));
    let document = json(&output);
    // From 120° and 90° at rest; extrapolation in binary128, docs/benchmarks.md. In this second the motion multiplies errors by
    // less than 100.
    let truth = [
        ("theta1", -0.419_157_996_853_289_1),
        ("theta2", -1.024_023_228_436_775_5),
    ];
    for (name, value) in truth {
        assert!(
            (number(&document["q"][name]) - value).abs() < 1e-9,
            "{name}"
        );
    }
    assert_eq!(number(&document["t"]), 1.0);
    for field in [
        "steps",
        "rejected",
        "evaluations",
        "seconds",
        "energy_residual",
        "constraint_residual",
    ] {
        assert!(document[field].is_number(), "{field}");
    }
    assert!(document["events"].is_array() && document["warnings"].is_array());
    let table = std::fs::read_to_string(&csv.0).expect("a table");
    assert_eq!(table.lines().count(), 6);
    assert!(
        table.starts_with("t [s],theta1 [rad],theta2 [rad],der(theta1) [rad/s],"),
        "{table}"
    );
    let drawing = std::fs::read_to_string(&svg.0).expect("a drawing");
    assert!(drawing.starts_with("<svg") && drawing.trim_end().ends_with("</svg>"));
    assert!(drawing.contains("theta2") && drawing.contains("DoublePendulum"));
}

#[test]
fn a_run_that_ends_early_says_when_and_why_and_keeps_what_there_is() {
    let table = Scratch::new("early.csv", "");
    // The pestle flies through the mortar's centre: the assumption s2 > 0 fails after half a second.
    let arguments = [
        "simulate",
        "machines/vibrating_crusher.machine",
        "--until",
        "1",
        "--set",
        "e=0",
        "--start",
        "s2=0.5",
        "--rate",
        "s2=-1",
        "--out",
        table.path(),
    ];
    let output = lagrangian(&arguments);
    assert_eq!(status(&output), 1);
    assert!(
        err(&output).contains("`s2 > 0`") && err(&output).contains("t = 0.5"),
        "{}",
        err(&output)
    );
    let table = std::fs::read_to_string(&table.0).expect("a table");
    assert!(table.lines().count() > 400);
}

#[test]
fn parameters_without_a_value_are_named() {
    let spec = Scratch::new(
        "bare.machine",
        "machine Ball in plane {\n    parameters { m: kg }\n    coordinates { x: m }\n    \
         bodies { ball { mass: m, at: (x, 0) } }\n}\n",
    );
    let output = lagrangian(&["simulate", spec.path(), "--until", "1"]);
    assert_eq!(status(&output), 1);
    assert!(err(&output).contains("m has no value"), "{}", err(&output));
    assert_eq!(
        status(&lagrangian(&[
            "simulate",
            spec.path(),
            "--until",
            "1",
            "--set",
            "m=2"
        ])),
        0
    );
}

#[test]
fn a_wrong_call_has_status_2_and_a_near_name() {
    let machine = "machines/cart_pole.machine";
    for (arguments, word) in [
        (vec!["simulate", machine], "--until"),
        (
            vec!["simulate", machine, "--until", "1", "--set", "pol=2"],
            "`pole`",
        ),
        (
            vec!["simulate", machine, "--until", "1", "--start", "thet=2"],
            "`theta`",
        ),
        (
            vec!["simulate", machine, "--until", "1", "--method", "dop85"],
            "`dop853`",
        ),
        (
            vec!["simulate", machine, "--until", "1", "--tolerance", "-1"],
            "tolerance",
        ),
        (
            vec!["evaluate", machine, "--at", "no-such.json"],
            "no-such.json",
        ),
        (vec!["check", "no-such.machine"], "no-such.machine"),
        (vec!["derive", machine, "--as", "fortran"], "markdown"),
    ] {
        let output = lagrangian(&arguments);
        assert_eq!(status(&output), 2, "{arguments:?}: {}", err(&output));
        assert!(
            err(&output).contains(word),
            "{arguments:?}: {}",
            err(&output)
        );
    }
}

#[test]
fn what_is_not_finite_is_named() {
    let machine = "machines/cart_pole.machine";
    for (option, assignment, word) in [
        ("--set", "pole=nan", "pole"),
        ("--set", "push=inf", "push"),
        ("--start", "theta=nan", "theta"),
        ("--rate", "x=-inf", "x"),
    ] {
        let output = lagrangian(&["simulate", machine, "--until", "1", option, assignment]);
        assert_eq!(status(&output), 2, "{assignment}: {}", err(&output));
        assert!(
            err(&output).contains(word),
            "{assignment}: {}",
            err(&output)
        );
    }
}

#[test]
fn every_form_of_a_derivation_holds_what_it_should() {
    for (form, words) in [
        (
            "markdown",
            vec!["# CartPole", r"\ddot{\theta}", "| `accelerations` |"],
        ),
        (
            "latex",
            vec![r"\documentclass", r"\ddot{x}", r"\end{document}"],
        ),
        (
            "html",
            vec!["<!DOCTYPE html>", "<math display=\"block\">", "</html>"],
        ),
        (
            "rust",
            vec!["@generated", "pub struct CartPole", "accelerations"],
        ),
        (
            "program",
            vec!["program CartPole", "accelerations(", "sin_cos"],
        ),
        ("c", vec!["accelerations", "double"]),
    ] {
        let output = lagrangian(&["derive", "machines/cart_pole.machine", "--as", form]);
        assert_eq!(status(&output), 0, "{form}: {}", err(&output));
        for word in words {
            assert!(
                out(&output).contains(word),
                "{form} has no {word}:\n{}",
                out(&output)
            );
        }
    }
}

#[test]
fn a_family_takes_another_size() {
    let arguments = [
        "evaluate",
        "machines/chain.machine",
        "--const",
        "N=3",
        "--start",
        "q=0",
        "--start",
        "q[2]=0.5",
    ];
    let results = json(&lagrangian(&arguments));
    assert_eq!(
        results[0]["accelerations"].as_array().map(Vec::len),
        Some(3)
    );
}

#[test]
fn a_run_that_is_stiff_says_so_at_once() {
    let spec = "machine Stiff in plane {\n\
        parameters { c: N*s/m = 1e5 }\n\
        coordinates { x: m = 0 }\n\
        bodies { block { mass: 1, at: (x, 0) } }\n\
        dissipations { drag: 1/2*c*der(x)^2 }\n}\n";
    let scratch = Scratch::new("stiff.machine", spec);
    let arguments = [
        "simulate",
        scratch.path(),
        "--until",
        "0.5",
        "--rate",
        "x=1",
        "--tolerance",
        "1e-6",
    ];
    let by = |method: &str| lagrangian(&[&arguments[..], &["--method", method]].concat());
    let output = by("dop853");
    let said = err(&output);
    assert_eq!(status(&output), 0, "{said}");
    assert!(
        said.contains("stiff") && said.contains("--method radau5"),
        "{said}"
    );
    // The advice appears once, and also among the warnings of the summary.
    assert_eq!(said.matches("--method radau5").count(), 1, "{said}");
    assert!(out(&output).contains("warning: the machine is stiff"));
    let implicit = by("radau5");
    assert_eq!(err(&implicit), "");
}

/// A cart on a spring, in workshop units, and in SI units.
const WORKSHOP: &str = "machine Cart in plane {
    parameters { m: g = 500, k: N/mm = 0.2, d: mm = 5, n: rpm = 1500 }
    inputs { pull: kN = 0.001 }
    coordinates { x: m = 20*mm, phi: rad = 30*deg, der(phi): rad/s = 60*rpm }
    bodies { cart { mass: m, at: (x, 0) }, wheel { mass: m, inertia: m*d^2, at: (x, d), angle: phi } }
    springs { wall { stiffness: k, stretch: x - d } }
    torsion_springs { shaft { stiffness: 2*N*mm/deg, twist: phi - n*t } }
    forces { rope { on: x, value: pull } }
    outputs { far: cm = x - d, turned: deg = phi, speed: km/h = der(x), turns: Hz = der(phi)/(2*pi) }
    derivatives { d, coordinates }
}";

const IN_SI: &str = "machine Cart in plane {
    parameters { m: kg = 0.5, k: N/m = 200, d: m = 0.005, n: rad/s = 50*pi }
    inputs { pull: N = 1 }
    coordinates { x: m = 0.02, phi: rad = pi/6, der(phi): rad/s = 2*pi }
    bodies { cart { mass: m, at: (x, 0) }, wheel { mass: m, inertia: m*d^2, at: (x, d), angle: phi } }
    springs { wall { stiffness: k, stretch: x - d } }
    torsion_springs { shaft { stiffness: 0.36/pi, twist: phi - n*t } }
    forces { rope { on: x, value: pull } }
    outputs { far: m = x - d, turned: rad = phi, speed: m/s = der(x), turns: Hz = der(phi)/(2*pi) }
    derivatives { d, coordinates }
}";

#[test]
fn a_declared_unit_is_what_numbers_are_measured_in_outside() {
    let workshop = Scratch::new("workshop.machine", WORKSHOP);
    let si = Scratch::new("si.machine", IN_SI);
    let pi = std::f64::consts::PI;
    for (theirs, ours) in [
        (vec![], vec![]),
        (
            vec![
                "--set",
                "d=7",
                "--set",
                "pull=0.003",
                "--set",
                "n=60",
                "--rate",
                "x=2",
            ],
            vec![
                "--set", "d=0.007", "--set", "pull=3", "--set", "n=2*pi", "--rate", "x=2",
            ],
        ),
    ] {
        let run = |spec: &Scratch, more: &[&str]| {
            json(&lagrangian(&[&["evaluate", spec.path()], more].concat()))[0].clone()
        };
        let (theirs, ours) = (run(&workshop, &theirs), run(&si, &ours));
        // The results differ by at most ten operations.
        let same = |a: f64, b: f64| {
            assert!(
                (a - b).abs() <= 10.0 * f64::EPSILON * b.abs(),
                "{a} and {b}: {theirs} {ours}"
            );
        };
        for k in 0..2 {
            same(
                number(&theirs["accelerations"][k]),
                number(&ours["accelerations"][k]),
            );
        }
        let outputs = |name: &str| [&theirs, &ours].map(|run| number(&run["outputs"][name]));
        for (name, factor) in [
            ("far", 100.0),
            ("turned", 180.0 / pi),
            ("speed", 3.6),
            ("turns", 1.0),
        ] {
            let [theirs, ours] = outputs(name);
            same(theirs, factor * ours);
        }
    }
    // Also in a list of points, and in generated code.
    let points = |d: &str| format!("[{{\"parameters\": {{\"d\": {d}}}}}]");
    let at = |spec: &Scratch, d: &str| {
        let output = with_input(&["evaluate", spec.path(), "--at", "-"], &points(d));
        number(&json(&output)[0]["accelerations"][0])
    };
    let (theirs, ours) = (at(&workshop, "7"), at(&si, "0.007"));
    assert!((theirs - ours).abs() <= 10.0 * f64::EPSILON * ours.abs());
    let code = out(&lagrangian(&["derive", workshop.path(), "--as", "rust"]));
    assert!(code.contains("/// `d`. Unit: `mm`. Default: 5."), "{code}");
    let page = out(&lagrangian(&["derive", workshop.path()]));
    assert!(page.contains("mm"), "{page}");
}

#[test]
fn warnings_are_told_and_denied_on_demand() {
    let text = "machine Drop in plane { parameters { m: kg = 1, k: N/m = 2, w: rad = 90 } constants { l: m = 0.1 } \
                coordinates { y: m } bodies { block { mass: m, at: (l*sin(w), y) } } \
                springs { s { stiffness: -k, stretch: y } } inputs { u: N } }";
    let spec = Scratch::new("drop.machine", text);
    let output = lagrangian(&["check", spec.path()]);
    assert_eq!(status(&output), 0);
    for code in [
        "unused",
        "looks-like-degrees",
        "no-gravity",
        "negative-coefficient",
    ] {
        assert!(
            err(&output).contains(&format!("[{code}]")),
            "{}",
            err(&output)
        );
    }
    assert!(out(&output).ends_with("; 4 warnings\n"), "{}", out(&output));
    assert_eq!(
        status(&lagrangian(&["check", spec.path(), "--deny-warnings"])),
        1
    );
    let document = json(&lagrangian(&["check", spec.path(), "--json"]));
    let diagnostics = document["diagnostics"].as_array().expect("a list");
    assert_eq!(diagnostics.len(), 4);
    assert!(
        diagnostics
            .iter()
            .all(|diagnostic| diagnostic["severity"] == "warning")
    );
    // Other commands succeed, and print the warning on the other channel.
    let output = lagrangian(&["evaluate", spec.path()]);
    assert_eq!(status(&output), 0);
    assert!(json(&output)[0]["accelerations"][0].is_number());
    assert!(err(&output).contains("warning: "));
    // Every warning has a correction.
    let meant = text
        .replace("w: rad = 90", "w: rad = 90*rad")
        .replace("u: N", "_u: N");
    let open = meant.strip_suffix('}').expect("a brace");
    let meant = format!("{open} gravity none; assume {{ -k < 0 }} }}");
    let spec = Scratch::new("meant.machine", &meant);
    let output = lagrangian(&["check", spec.path(), "--deny-warnings"]);
    assert_eq!(status(&output), 0, "{}", err(&output));
}

/// `√(1 + w²) − w` loses digits for large w, and `1/(√(1 + w²) + w)`, the same number, keeps them: it has six operations and no
/// difference, each with an error of at most half a unit. Half a unit of the result is unavoidable, and at most as much for w
/// and for τ.
#[test]
fn a_formula_that_loses_digits_is_told_from_one_that_keeps_them() {
    let text = "machine Wheel in plane { parameters { tau: s = 1 } coordinates { phi: rad, der(phi): rad/s = 3 } \
                bodies { wheel { mass: 1, inertia: 1, at: (0, 0), angle: phi } } gravity none; assume { der(phi) > 0 } \
                outputs { poor: 1 = sqrt(1 + (tau*der(phi))^2) - tau*der(phi), good: 1 = 1/(sqrt(1 + (tau*der(phi))^2) + tau*der(phi)) } }";
    let spec = Scratch::new("wheel.machine", text);
    let found = json(&lagrangian(&["check", spec.path(), "--accuracy", "--json"]));
    let quantity = |name: &str| {
        let all = found["accuracy"].as_array().expect("a list");
        let is_it = |found: &&Value| found["quantity"] == format!("output {name}").as_str();
        all.iter().find(is_it).expect("the output").clone()
    };
    let number = |value: &Value| value.as_f64().expect("a number");
    let good = quantity("good");
    assert!(number(&good["worst"]) <= 6.0, "{good}");
    let poor = quantity("poor");
    assert_eq!(poor["kind"], "extreme");
    let w = number(&poor["state"]["v"]["phi"]);
    assert!(w > 1e4, "{poor}");
    // The value that the command reports at that state, compared with the number computed without a difference.
    let point = Scratch::new("point.json", &format!("[{}]", poor["state"]));
    let there = json(&lagrangian(&[
        "evaluate",
        spec.path(),
        "--at",
        point.path(),
    ]));
    let exact = 1.0 / ((1.0 + w * w).sqrt() + w);
    let error = (number(&there[0]["outputs"]["poor"]) - exact).abs();
    let half_unit = f64::EPSILON / 2.0 * exact;
    assert!(
        (number(&poor["error"]) - error).abs() <= 8.0 * half_unit,
        "{poor}"
    );
    let share = number(&poor["worst"]);
    assert!(
        (error / (4.0 * half_unit)..=1.001 * error / half_unit).contains(&share),
        "{poor}"
    );
    // The readable table names the formula and the state.
    let text = out(&lagrangian(&["check", spec.path(), "--accuracy"]));
    assert!(
        text.contains("the worst state, for output poor: {\"t\":"),
        "{text}"
    );
}

#[test]
fn the_freedom_that_constraints_leave_is_told() {
    let check = |name: &str| lagrangian(&["check", name, "--json"]);
    let freedom = &json(&check("machines/slider_crank.machine"))["freedom"];
    assert_eq!(freedom["coordinates"], 3);
    assert_eq!(freedom["independent"], 2);
    assert_eq!(freedom["degrees_of_freedom"], 1);
    let text = out(&lagrangian(&["check", "machines/slider_crank.machine"]));
    assert!(
        text.contains("3 coordinates, 2 constraints, 1 degree of freedom, "),
        "{text}"
    );
    let chapter = out(&lagrangian(&["derive", "machines/slider_crank.machine"]));
    let said = "It has three generalized coordinates and two constraints: one degree of freedom.";
    assert!(chapter.contains(said), "{chapter}");
}

#[test]
fn what_a_spec_may_not_say_may_not_be_set() {
    let text = "machine Block in plane { parameters { m: kg = 2, mu: 1 = 0.3, hold: 1 = 0.4, k: N/m = 5 } \
                coordinates { x: m } frames { block = ground.shift(x, 0) } \
                bodies { block { mass: m, frame: block } } gravity (0, -9.81); \
                springs { s { stiffness: k, stretch: x } } \
                sliding { floor { body: block, on: ground, direction: (1, 0), friction: mu, \
                static_friction: hold } } }";
    let spec = Scratch::new("block.machine", text);
    assert_eq!(status(&lagrangian(&["evaluate", spec.path()])), 0);
    for (set, default, words) in [
        ("m=-2", "m: kg = 2", "a mass must be positive, found -2"),
        (
            "mu=-0.1",
            "mu: 1 = 0.3",
            "a coefficient of friction must not be negative, found -0.1",
        ),
        (
            "hold=0.2",
            "hold: 1 = 0.4",
            "the coefficient of static friction must not be less than that of sliding friction, found 0.2 below 0.3",
        ),
    ] {
        let (name, value) = set.split_once('=').expect("an assignment");
        // The messages are the same for the call and for the spec.
        let output = lagrangian(&["simulate", spec.path(), "--until", "0.1", "--set", set]);
        assert_eq!(status(&output), 2, "{set}");
        assert!(err(&output).contains(words), "{set}: {}", err(&output));
        let said = format!("{} = {value}", default.split(" =").next().expect("a name"));
        let wrong = Scratch::new("wrong.machine", &text.replace(default, &said));
        let output = lagrangian(&["check", wrong.path()]);
        assert_eq!(status(&output), 1, "{said}");
        assert!(err(&output).contains(words), "{said}: {}", err(&output));
        let point = format!("[{{\"parameters\": {{\"{name}\": {value}}}}}]");
        let output = with_input(&["evaluate", spec.path(), "--at", "-"], &point);
        let error = json(&output)[0]["error"].to_string();
        assert!(error.contains(words), "{error}");
    }
    let output = lagrangian(&["evaluate", spec.path(), "--set", "k=-5"]);
    assert_eq!(status(&output), 0);
    assert!(err(&output).contains(
        "warning: a spring with negative stiffness pushes away from its rest position, found -5"
    ));
    let output = lagrangian(&["evaluate", spec.path(), "--set", "x=1"]);
    assert_eq!(status(&output), 2);
    assert!(err(&output).contains("--start"), "{}", err(&output));
}

#[test]
fn a_name_is_one_in_both_spellings() {
    let text = "machine One in plane { parameters { m\u{e9}: kg = 2 } coordinates { x: m } \
                bodies { block { mass: me\u{301}, at: (x, 0) } } forces { f { on: x, value: 6*N } } }";
    let spec = Scratch::new("one.machine", text);
    for set in ["m\u{e9}=3", "me\u{301}=3"] {
        let output = lagrangian(&["evaluate", spec.path(), "--set", set]);
        assert_eq!(
            number(&json(&output)[0]["accelerations"][0]),
            2.0,
            "{}",
            err(&output)
        );
    }
}

/// Names with an accent, which the call types in the other Unicode normalization, and values with units.
#[test]
fn names_and_values_from_outside_are_read_as_those_of_a_spec() {
    let text = "machine Outside in plane { parameters { caf\u{e9}: kg = 1, speed: rpm = 60, tilt: rad = 1 } \
                inputs { pull: kN } coordinates { \u{fc}: m } \
                bodies { b { mass: caf\u{e9}, at: (\u{fc}, 0) } } forces { f { on: \u{fc}, value: pull } } \
                outputs { w: rad/s = speed, s: 1 = sin(tilt), here: m = \u{fc}, rate: m/s = der(\u{fc}) } }";
    let spec = Scratch::new("outside.machine", text);
    let point = Scratch::new(
        "outside.json",
        "[{\"q\": {\"u\u{308}\": 0.25}, \"parameters\": {\"cafe\u{301}\": 4}}]",
    );
    let evaluate = |arguments: &[&str]| {
        let output = lagrangian(&[&["evaluate", spec.path()], arguments].concat());
        let text = [&output.stdout[..], &output.stderr].concat();
        (output.status.code(), String::from_utf8(text).expect("text"))
    };
    let numbers = |arguments: &[&str]| -> Value {
        let (status, text) = evaluate(arguments);
        assert_eq!(status, Some(0), "{text}");
        let document: Value = serde_json::from_str(&text).expect("a document");
        document[0].clone()
    };
    let found = numbers(&[
        "--set",
        "cafe\u{301}=500*g",
        "--set",
        "pull=-3*N",
        "--set",
        "speed=pi*rad/s",
        "--set",
        "tilt=30*deg",
        "--start",
        "u\u{308}=-3*cm",
        "--rate",
        "u\u{308}=36*km/h",
    ]);
    let near = |found: &Value, known: f64| {
        let found = found.as_f64().expect("a number");
        assert!(
            (found - known).abs() <= 4.0 * f64::EPSILON * known.abs(),
            "{found} {known}"
        );
    };
    near(&found["accelerations"][0], -6.0);
    near(&found["outputs"]["w"], std::f64::consts::PI);
    near(&found["outputs"]["s"], 0.5);
    near(&found["outputs"]["here"], -0.03);
    near(&found["outputs"]["rate"], 10.0);
    // Bare numbers are in the unit that the spec declares: 60 rpm, 3 kN.
    let found = numbers(&["--set", "pull=3", "--at", point.path()]);
    near(&found["accelerations"][0], 750.0);
    near(&found["outputs"]["w"], std::f64::consts::TAU);
    near(&found["outputs"]["here"], 0.25);

    for (arguments, words) in [
        (
            ["--set", "speed=3*m"],
            "--set speed=3*m: expected rad/s, found m; the expected unit is that of the declaration",
        ),
        (
            ["--set", "speed=50*Hz"],
            "--set speed=50*Hz: expected rad/s, found Hz",
        ),
        (["--start", "\u{fc}=2*s"], "expected m, found s"),
        (["--rate", "\u{fc}=2*m"], "expected m/s, found m"),
        (["--set", "tilt=30 deg"], "30*deg"),
        (["--set", "tilt=1500*rmp"], "rpm"),
        (["--set", "speed=many"], "nothing is named `many`"),
        (
            ["--set", "nothing=3*m"],
            "no parameter or input named `nothing`",
        ),
    ] {
        let (status, text) = evaluate(&arguments);
        assert_eq!(status, Some(2), "{arguments:?}: {text}");
        assert!(text.contains(words), "{arguments:?}: {text}");
    }
    // A variant without changes is its base under another name.
    let text = format!("machine Same extends \"{}\" {{ }}", spec.path());
    let same = Scratch::new("same.machine", &text);
    let output = lagrangian(&["check", same.path()]);
    assert_eq!(output.status.code(), Some(0));
}

/// An assumption that does not hold at the start, and one that ends within a run, are underlined in the spec.
#[test]
fn an_assumption_that_does_not_hold_is_underlined() {
    const TOP: &str = "machines/heavy_top.machine";
    let line = std::fs::read_to_string(root().join(TOP)).expect("a spec");
    let line = line.lines().position(|line| line.contains("assume {"));
    let place = format!("{TOP}:{}:14", line.expect("it assumes something") + 1);
    let start = ["simulate", TOP, "--until", "1", "--start", "theta=0"];
    // A ball that falls from half a metre.
    let fall = "machine Fall in plane {
    coordinates { x: m = 0.5 }
    bodies { ball { mass: 1, at: (x, 0) } }
    gravity (-9.81, 0);
    assume { x > 0 }
}";
    let fall = Scratch::new("fall.machine", fall);
    let end = ["simulate", fall.path(), "--until", "1"];
    let peaks = ["peaks", TOP, "--until", "1", "--start", "theta=0"];
    let fallen = format!("{}:5:14", fall.path());
    for (call, assumption, place) in [
        (&start[..], "sin(theta) > 0", &place),
        (&peaks[..], "sin(theta) > 0", &place),
        (&end[..], "x > 0", &fallen),
    ] {
        let output = lagrangian(call);
        assert_eq!(status(&output), 1, "{call:?}");
        let said = err(&output);
        let message =
            format!("error: the machine assumes `{assumption}`, which does not hold at t = ");
        assert!(said.contains(&message), "{said}");
        assert!(said.contains(place.as_str()), "{place} is not in {said}");
        assert!(said.contains(&"^".repeat(assumption.len())), "{said}");
        let output = lagrangian(&[call, &["--json"]].concat());
        assert_eq!(json(&output)["place"], place.as_str(), "{call:?}");
    }
}

/// The error of a search that a run ends because of an assumption underlines that as well.
#[test]
fn searches_underline_an_assumption_that_ends_their_runs() {
    let fall = "machine Fall in plane {
    parameters { g: m/s^2 = 9.81 }
    coordinates { x: m = 0.5 }
    bodies { ball { mass: 1, at: (x, 0) } }
    gravity (-g, 0);
    assume { x > 0 }
}";
    let fall = Scratch::new("fall.machine", fall);
    let data = Scratch::new("fall.csv", "t [s],x [m]\n0,0.5\n0.5,0.1\n1,0.05\n");
    for call in [
        &["orbit", fall.path(), "--near", "1"][..],
        &[
            "sensitivities",
            fall.path(),
            "--until",
            "1",
            "--by",
            "g",
            "--of",
            "x",
        ],
        &["fit", fall.path(), "--data", data.path(), "--fit", "g"],
    ] {
        let output = lagrangian(call);
        assert_eq!(status(&output), 1, "{call:?}");
        let said = err(&output);
        let place = format!("{}:6:14", fall.path());
        let words = "the machine assumes `x > 0`, which does not hold at t = ";
        assert!(
            said.contains(words) && said.contains(&place),
            "{call:?}: {said}"
        );
        assert!(said.contains("^^^^^"), "{call:?}: {said}");
        let output = lagrangian(&[call, &["--json"]].concat());
        assert_eq!(json(&output)["place"], place.as_str(), "{call:?}");
    }
    let rows = Scratch::new("rows.csv", "");
    let vary = ["--vary", "g=5,9.81", "--fresh", "--out", rows.path()];
    lagrangian(&[&["sweep", fall.path(), "--until", "1"][..], &vary].concat());
    let rows = std::fs::read_to_string(rows.path()).expect("rows");
    let place = format!("({}:6:14)", fall.path());
    assert_eq!(rows.matches(&place).count(), 2, "{rows}");
}

/// A value in a wrong unit is shown with the declaration that it does not fit.
#[test]
fn a_value_in_a_wrong_unit_shows_the_declaration() {
    let spec = "machine Fall in plane {
    parameters { g: m/s^2 = 9.81 }
    coordinates { x: m = 0.5 }
    inputs { F: N }
    bodies { ball { mass: 1, at: (x, 0) } }
    gravity (-g, 0);
    forces { push { on: x, value: F } }
}";
    let spec = Scratch::new("fall.machine", spec);
    for (option, value, words, place) in [
        ("--set", "g=3*kg", "expected m/s^2, found kg", "2:18"),
        ("--set", "F=3*kg", "expected N, found kg", "4:14"),
        ("--start", "x=3*kg", "expected m, found kg", "3:19"),
        ("--rate", "x=3*kg", "expected m/s, found kg", "3:19"),
    ] {
        for command in [
            &["simulate", "--until", "1"][..],
            &["evaluate"],
            &["modes"],
            &["linearize", "--here"],
            &["peaks", "--until", "1"],
            &["orbit", "--near", "1"],
            &["sensitivities", "--until", "1", "--by", "g", "--of", "x"],
        ] {
            let call = [command, &[spec.path(), option, value]].concat();
            let output = lagrangian(&call);
            assert_eq!(status(&output), 2, "{call:?}");
            let said = err(&output);
            assert!(said.contains(words), "{call:?}: {said}");
            let place = format!("{}:{place}", spec.path());
            assert!(
                said.contains(&place) && said.contains("declared here"),
                "{call:?}: {said}"
            );
            let output = lagrangian(&[&call[..], &["--json"]].concat());
            assert_eq!(json(&output)["place"], place.as_str(), "{call:?}");
        }
    }
}
