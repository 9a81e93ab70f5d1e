//! Runs of machines with constraints, as a user sees them.

mod support;

use serde_json::Value;
use support::{Scratch, lagrangian};

/// A pendulum of 1 kg and 1 m as a particle, from the level, with constraints.
fn pendulum(constraints: &str) -> Scratch {
    let text = format!(
        "machine Bob in plane {{\n    parameters {{ m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }}\n    \
         coordinates {{ x: m = -1, y: m = 0 }}\n    bodies {{ bob {{ mass: m, at: (x, y) }} }}\n    \
         gravity (0, -g);\n    constraints {{ {constraints} }}\n}}\n"
    );
    Scratch::new("bob.machine", &text)
}

const ROD: &str = "rod: (x^2 + y^2)/2 = l^2/2";

fn simulate(spec: &Scratch, arguments: &[&str]) -> (i32, String, String) {
    let call = ["simulate", spec.path(), "--until", "10"];
    let output = lagrangian(&[&call, arguments].concat());
    let text = |bytes| String::from_utf8(bytes).expect("text");
    let status = output.status.code().expect("no signal");
    (status, text(output.stdout), text(output.stderr))
}

fn document(spec: &Scratch, arguments: &[&str]) -> Value {
    let arguments = [arguments, &["--tolerance", "1e-12", "--json"]].concat();
    let (_, out, error) = simulate(spec, &arguments);
    serde_json::from_str(&out).unwrap_or_else(|_| panic!("{out}{error}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The place at 10 s: IFToMM library of benchmarks A01, by Jacobi's functions.
fn assert_at_the_end(document: &Value) {
    assert!((number(&document["q"]["x"]) + 0.275_087_462_576_116_9).abs() < 2e-11);
    assert!((number(&document["q"]["y"]) + 0.961_419_205_099_125).abs() < 2e-11);
    let residual = number(&document["constraint_residual"]);
    assert!(residual > 0.0 && residual <= 1e-13);
}

#[test]
fn what_is_left_of_constraints_is_reported_and_multipliers_are_recorded() {
    let spec = pendulum(ROD);
    let table = Scratch::new("run.csv", "");
    let document = document(&spec, &["--every", "5", "--out", table.path()]);
    assert_at_the_end(&document);
    assert_eq!(document["warnings"], Value::Array(vec![]));

    let table = std::fs::read_to_string(&table.0).expect("a table");
    let mut rows = table.lines().map(|row| row.split(',').collect::<Vec<_>>());
    let head = rows.next().expect("a head");
    let column = head
        .iter()
        .position(|name| *name == "multiplier(rod) [N/m]")
        .expect("the multiplier");
    // The rod pulls by 28.29… N at the end: R = λ (x, y).
    let last: f64 = rows.next_back().expect("rows")[column]
        .parse()
        .expect("a number");
    assert!((last + 28.294_567_206_067_25).abs() < 1e-9);

    let (status, out, _) = simulate(&spec, &[]);
    assert_eq!(status, 0);
    assert!(out.contains("constraints: left over"), "{out}");
}

#[test]
fn redundant_constraints_are_named_and_change_no_motion() {
    let spec = pendulum(&format!("{ROD}, again: x^2 + y^2 = l^2"));
    let document = document(&spec, &[]);
    assert_at_the_end(&document);
    let warnings = document["warnings"].as_array().expect("a list");
    assert_eq!(warnings.len(), 1);
    let text = warnings[0].as_str().expect("text");
    assert!(text.contains("`again` is redundant beside `rod`"), "{text}");
}

#[test]
fn contradicting_constraints_are_named() {
    let spec = pendulum(&format!("{ROD}, wide: x^2 + y^2 = 4*l^2"));
    let (status, _, error) = simulate(&spec, &[]);
    assert_eq!(status, 1);
    assert!(error.contains("`wide` contradicts `rod`"), "{error}");
}

#[test]
fn a_start_off_the_constraints_is_moved_onto_them_and_told() {
    let spec = pendulum(ROD);
    let document = document(&spec, &["--start", "x=-1.25"]);
    assert_at_the_end(&document);
    let warnings = document["warnings"].as_array().expect("a list");
    assert_eq!(warnings.len(), 1);
    let text = warnings[0].as_str().expect("text");
    let told = text.strip_prefix("the start was moved onto the constraints: `x` from -1.25 to ");
    let moved: f64 = told.expect(text).parse().expect("a number");
    // Newton's method ends where no more than 10⁻¹³ is left.
    assert!((moved + 1.0).abs() <= 1e-13, "{text}");
}
