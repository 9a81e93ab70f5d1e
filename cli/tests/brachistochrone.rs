//! The fastest motion as a user asks for it.

mod support;

use serde_json::Value;
use support::{Scratch, lagrangian};

const BEAD: &str = "machine Bead in plane {
    parameters { m: kg = 1, g: m/s^2 = 9.81 }
    coordinates { x: m, y: m }
    bodies { bead { mass: m, at: (x, y) } }
    gravity (0, -g);
}";

/// The time along a cycloid to (1, 1).
const CYCLOID: f64 = 0.582895463154743;

fn solved(spec: &str, options: &[&str]) -> Value {
    let spec = Scratch::new("fastest.machine", spec);
    let arguments = [&["brachistochrone", spec.path(), "--json"], options].concat();
    let output = lagrangian(&arguments);
    let text = String::from_utf8(output.stdout).expect("text");
    let value: Value =
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    assert_eq!(output.status.success(), value["error"].is_null(), "{text}");
    value
}

#[track_caller]
fn close(value: &Value, expected: f64, relative: f64) {
    let value = value
        .as_f64()
        .unwrap_or_else(|| panic!("no number: {value}"));
    assert!(
        (value / expected - 1.0).abs() < relative,
        "{value}, not {expected}"
    );
}

#[test]
fn a_bead_goes_along_a_cycloid_and_the_wire_does_no_work() {
    let found = solved(BEAD, &["--to", "x=1,y=-1"]);
    close(&found["time"], CYCLOID, 1e-13);
    close(&found["end"]["q"]["x"], 1.0, 1e-14);
    for moment in found["path"].as_array().expect("a path") {
        let number = |what: &str, name: &str| moment[what][name].as_f64().expect("a number");
        let work = |name: &str| number("control", name) * number("v", name);
        // Forces of 20 N at 5 m/s.
        assert!((work("x") + work("y")).abs() < 100.0 * 64.0 * f64::EPSILON);
    }
    assert_eq!(found["warnings"], serde_json::json!([]));
}

#[test]
fn ends_may_be_normal_coordinates() {
    // (24) for the mass 4 kg: the first along (1, 1)/√8, the second along (1, −1)/√8; (1, −1) is (0, √8).
    let found = solved(
        BEAD,
        &[
            "--set",
            "m=4",
            "--natural",
            "--to",
            "x=0,y=2.8284271247461903",
        ],
    );
    close(&found["time"], CYCLOID, 1e-13);
}

#[test]
fn the_conditions_that_fail_are_named() {
    let spring = BEAD.replace(
        "gravity",
        "springs { s { stiffness: 3, stretch: x } } gravity",
    );
    let error = solved(&spring, &["--to", "x=1,y=-1"])["error"].to_string();
    assert!(error.contains("the force on `x` depends on `x`"), "{error}");
    assert!(!error.contains("`y`"), "{error}");
    let polar = BEAD
        .replace("(x, y) }", "polar(x, y) }")
        .replace("y: m", "y: rad");
    let error = solved(&polar, &["--to", "x=1"])["error"].to_string();
    assert!(
        error.contains("the mass a of `y` and `y` depends on `x`"),
        "{error}"
    );
    let error = solved(BEAD, &["--to", "x=1,y=1"])["error"].to_string();
    assert!(error.contains("cannot be reached from rest"), "{error}");
}

/// The spec's defaults are the paper's example; published to six digits, recomputed to forty elsewhere.
#[test]
fn the_prisms_take_the_papers_time() {
    let arguments = [
        "machines/prisms.machine",
        "--json",
        "--natural",
        "--to",
        "q1=12,q2=6",
    ];
    let output = lagrangian(&[&["brachistochrone"], &arguments[..]].concat());
    let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    close(&found["time"], 1.637369712040567, 1e-13);
    let parameters = &found["parameters"];
    close(
        &parameters["epsilon_start"],
        -0.413_771_376_224_754_8,
        1e-13,
    );
    close(&parameters["epsilon_end"], 0.951_221_090_127_751_6, 1e-13);
    close(&parameters["C1"], 0.0393521181000199, 1e-13);
    close(&found["end"]["q"]["q1"], 8.0, 1e-13);
    close(&found["end"]["q"]["q2"], 4.75, 1e-13);
    assert_eq!(found["warnings"], serde_json::json!([]));
    for moment in found["path"].as_array().expect("a path") {
        for guide in ["floor", "incline"] {
            assert!(moment["reactions"][guide].as_f64().expect("a number") > 0.0);
        }
        assert!(moment["friction_power"].as_f64().expect("a number") <= 0.0);
    }
}

#[test]
fn tables_and_drawings_are_written() {
    let spec = Scratch::new("drawn.machine", BEAD);
    let table = Scratch::new("fastest.csv", "");
    let drawing = Scratch::new("fastest.svg", "");
    let files = ["--out", table.path(), "--plot", drawing.path()];
    let arguments = ["brachistochrone", spec.path(), "--to", "x=1,y=-1"];
    assert!(
        lagrangian(&[&arguments[..], &files].concat())
            .status
            .success()
    );
    let table = std::fs::read_to_string(&table.0).expect("a table");
    assert_eq!(table.lines().count(), 202);
    let last = table.lines().last().expect("rows").split(',');
    let last: Vec<f64> = last.map(|x| x.parse().expect("a number")).collect();
    assert!((last[0] - CYCLOID).abs() < 1e-13 && (last[1] - 1.0).abs() < 1e-13);
    let drawing = std::fs::read_to_string(&drawing.0).expect("a drawing");
    assert!(drawing.contains("</svg>") && drawing.contains("control forces"));
}
