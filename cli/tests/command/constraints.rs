//! Runs of machines with constraints, as a user sees them.

use crate::support::{Scratch, lagrangian, number};
use serde_json::Value;

/// A pendulum of 1 kg and 1 m as a particle, released from the horizontal, with these constraints.
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

/// The position at 10 s: IFToMM library of benchmarks A01, by Jacobi's functions.
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
    // The rod's tension at the end is 28.29… N: R = λ (x, y).
    let last: f64 = rows.next_back().expect("rows")[column]
        .parse()
        .expect("a number");
    assert!((last + 28.294_567_206_067_25).abs() < 1e-9);

    let (status, out, _) = simulate(&spec, &[]);
    assert_eq!(status, 0);
    assert!(out.contains("constraints: residual"), "{out}");
}

#[test]
fn redundant_constraints_are_named_and_change_no_motion() {
    let spec = pendulum(&format!("{ROD}, again: x^2 + y^2 = l^2"));
    let document = document(&spec, &[]);
    assert_at_the_end(&document);
    let warnings = document["warnings"].as_array().expect("a list");
    assert_eq!(warnings.len(), 1);
    let text = warnings[0].as_str().expect("text");
    assert!(text.contains("`again` is redundant given `rod`"), "{text}");
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
    // Newton's method ends when the residual is at most 10⁻¹³.
    assert!((moved + 1.0).abs() <= 1e-13, "{text}");
}

/// A pendulum of 1 m that starts off its rod, with a `keep` section.
fn kept(keep: &str) -> Scratch {
    let text = format!(
        "machine Bob in plane {{ parameters {{ m: kg = 1, l: m = 1, g: m/s^2 = 9.81 }} \
         coordinates {{ x: m = 0.6, y: m = -0.9, der(x): m/s = 0.5 }} bodies {{ bob {{ mass: m, at: (x, y) }} }} \
         gravity (0, -g); constraints {{ rod: norm((x, y)) = l }} {keep} }}"
    );
    Scratch::new("kept.machine", &text)
}

/// Checks that positions and rates are those of a triangle with the sides 3, 4 and 5, where x ẋ + y
/// ẏ = 0.
fn assert_kept(state: &Value) {
    for (of, name, known) in [
        ("q", "x", 0.6),
        ("q", "y", -0.8),
        ("v", "x", 0.5),
        ("v", "y", 0.375),
    ] {
        let found = number(&state[of][name]);
        // The guaranteed residual, divided by the derivative of the constraint by `y`.
        assert!((found - known).abs() < 1e-13 / 0.8, "{of} {name}: {found}");
    }
}

#[test]
fn what_spec_and_call_keep_of_a_start_stays() {
    let spec = kept("keep { x, der(x) }");
    let none = kept("");
    let start = |spec: &Scratch, arguments: &[&str]| -> Value {
        let call = ["simulate", spec.path(), "--until", "0", "--json"];
        let output = lagrangian(&[&call, arguments].concat());
        serde_json::from_slice(&output.stdout).expect("a document")
    };
    assert_kept(&start(&spec, &[]));
    assert_kept(&start(&none, &["--keep", "x,der(x)"]));
    // The call's `keep` replaces that of the spec.
    let least = start(&none, &[]);
    assert_eq!(start(&spec, &["--keep", "none"])["q"], least["q"]);
    assert_ne!(least["q"]["x"], 0.6);
    assert_eq!(start(&spec, &["--keep", "y"])["q"]["y"], -0.9);

    // A variant removes some of it.
    let base = spec.path();
    let text = format!("machine Less extends \"{base}\" {{ remove keep.der(x); remove keep.x; }}");
    let less = Scratch::new("less.machine", &text);
    assert_eq!(start(&less, &[])["q"], least["q"]);

    // The values at the states with which a run would begin.
    let evaluate = |spec: &Scratch, arguments: &[&str]| -> Value {
        let output = lagrangian(&[&["evaluate", spec.path()], arguments].concat());
        serde_json::from_slice(&output.stdout).expect("a document")
    };
    let point = &evaluate(&none, &["--keep", "x,der(x)"])[0];
    assert_kept(point);
    // λ of the rod: m (|v|² + g·q) on the unit circle, with y = −0.8.
    let tension = -(0.25 + 0.375 * 0.375) - 9.81 * 0.8;
    assert!((number(&point["multipliers"]["rod"]) - tension).abs() < 1e-12);
    // Without the option a point is not projected.
    assert!(evaluate(&spec, &[])[0].get("q").is_none());
}

#[test]
fn what_cannot_be_kept_is_told() {
    let spec = kept("");
    for (keep, status, words) in [
        ("x,y", 1, "with `x` and `y` kept, `rod` is 8.1665e-2 m off"),
        (
            "x,z",
            2,
            "--keep z: no coordinate named `z`; there are: x, y",
        ),
        ("der(z)", 2, "--keep der(z): no coordinate named `z`"),
        ("der(x", 2, "--keep der(x: no coordinate named `der(x`"),
    ] {
        for command in [&["simulate", "--until", "1"][..], &["evaluate"]] {
            let call = [
                &command[..1],
                &[spec.path()],
                &command[1..],
                &["--keep", keep],
            ]
            .concat();
            let output = lagrangian(&call);
            let said = [output.stdout, output.stderr].concat();
            let said = String::from_utf8(said).expect("text");
            assert!(said.contains(words), "{keep}: {said}");
            // For `evaluate` a point without accelerations is a result.
            let status = if command[0] == "evaluate" && status == 1 {
                0
            } else {
                status
            };
            assert_eq!(output.status.code(), Some(status), "{keep}: {said}");
        }
    }
}

/// Two carts that a bar keeps together, each with a spring: y is substituted, and the start is not on the constraint.
const TIED: &str = "machine Tied in plane {
    coordinates { x: m = 0.2, y: m }
    bodies { a { mass: 8, at: (x, 0) }, b { mass: 1, at: (y, 1) } }
    springs { a { stiffness: 30, stretch: x }, b { stiffness: 1, stretch: y } }
    constraints { bar: y = x }
}
";

#[test]
fn a_point_off_a_constraint_that_determines_a_coordinate_is_told_as_such() {
    let spec = Scratch::new("tied.machine", TIED);
    let evaluate = |more: &[&str]| -> Value {
        let output = lagrangian(&[&["evaluate", spec.path()], more].concat());
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    let found = evaluate(&[]);
    let error = found[0]["error"].as_str().expect("an error");
    assert!(error.contains("`bar` is off by -2e-1"), "{error}");
    assert!(error.contains("--keep none"), "{error}");
    // The nearest point in the metric of inertia, x = y = 8·0.2/9, where 9 ẍ = −31 x.
    let x = 1.6 / 9.0;
    for found in [
        evaluate(&["--keep", "none"]),
        evaluate(&[
            "--start",
            &format!("x={x:?}"),
            "--start",
            &format!("y={x:?}"),
        ]),
    ] {
        let exact = -31.0 * x / 9.0;
        for a in found[0]["accelerations"].as_array().expect("two") {
            assert!((number(a) - exact).abs() < 1e-14, "{a} {exact}");
        }
    }
}
