//! Tables in formulas of a spec: a motor whose torque is measured as a function of its speed,
//! against closed forms.

use crate::support::{Scratch, lagrangian};
use serde_json::Value;

/// A rotor driven by a torque from a table over its speed, and by a constant one.
const ROTOR: &str = "machine Rotor in plane {
    parameters { J: kg*m^2 = 2e-3, push: N*m = 0 }
    coordinates { phi: rad }
    bodies { rotor { mass: 1, inertia: J, at: (0, 0), angle: phi } }
    torques {
        magnet { on: rotor, torque: table(\"TABLE\", der(phi)) },
        push { on: rotor, torque: push },
    }
    gravity none;
}
";

/// A straight line from 0.6 N m at rest to nothing at 2000 rpm.
const LINE: &str = "speed [rpm]; torque [N*m]; loss [W]\n0; 0.6; 1\n500; 0.45; 2\n2000; 0; 9\n";

/// The speed at which the motor torque is zero, in rad/s.
const IDLE: f64 = 2000.0 * std::f64::consts::TAU / 60.0;

/// The time constant with which the speed approaches that: J ω / M, in s.
const TAU: f64 = 2e-3 * IDLE / 0.6;

/// Writes the spec with its table beside it.
fn rotor(table: &str, text: &str) -> Scratch {
    let spec = Scratch::new("rotor.machine", &ROTOR.replace("TABLE", table));
    std::fs::write(spec.0.with_file_name("motor.csv"), text).expect("a file");
    spec
}

fn said(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = lagrangian(arguments);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.code(),
        text(&output.stdout),
        text(&output.stderr),
    )
}

/// Angle and speed after this time.
fn end(spec: &Scratch, until: f64, more: &[&str]) -> [f64; 2] {
    let until = until.to_string();
    let run = ["simulate", spec.path(), "--until", &until];
    let run = [&run[..], &["--tolerance", "1e-11", "--json"], more].concat();
    let (status, out, error) = said(&run);
    assert_eq!(status, Some(0), "{out}{error}");
    let found: Value = serde_json::from_str(&out).expect("JSON");
    ["q", "v"].map(|of| found[of]["phi"].as_f64().expect("a number"))
}

/// A tolerance of 1e-11 in each of about twenty steps, for speeds of about 200 rad/s.
const CLOSE: f64 = 1e-7;

#[test]
fn a_motor_with_a_torque_from_a_table_runs_up_exponentially() {
    let spec = rotor("motor.csv:torque", LINE);
    for t in [0.1, 1.0, 3.0] {
        let [phi, omega] = end(&spec, t, &[]);
        let gone = 1.0 - f64::exp(-t / TAU);
        assert!((omega - IDLE * gone).abs() < CLOSE, "{t}: {omega}");
        assert!((phi - IDLE * (t - TAU * gone)).abs() < CLOSE, "{t}: {phi}");
    }
}

#[test]
fn a_run_ends_where_its_table_does_unless_that_is_held() {
    // With half of the torque added, the speed tends to 3/2 of the last speed of the table, and reaches the
    // latter at τ ln 3.
    let push = ["--set", "push=0.3"];
    let last = TAU * 3.0_f64.ln();
    let spec = rotor("motor.csv:torque", LINE);
    let [_, omega] = end(&spec, 0.99 * last, &push);
    assert!((omega - 1.5 * IDLE * (1.0 - f64::exp(-0.99 * last / TAU))).abs() < CLOSE);
    let run = ["simulate", spec.path(), "--until", "2"];
    let (status, _, error) = said(&[&run[..], &push].concat());
    assert_eq!(status, Some(1), "{error}");
    assert!(error.contains("2000 rpm, the end of motor.csv"), "{error}");
    let time = error
        .split("t = ")
        .nth(1)
        .and_then(|rest| rest.split(' ').next());
    let time: f64 = time.expect("a time").parse().expect("a number");
    assert!((time - last).abs() < 1e-6, "{time} {last}");
    // With constant extrapolation the last torque, 0, holds beyond the table: there only the
    // constant torque accelerates.
    let text = ROTOR.replace(
        "table(\"TABLE\", der(phi))",
        "table(\"motor.csv:torque\", der(phi), hold)",
    );
    let spec = Scratch::new("rotor.machine", &text);
    std::fs::write(spec.0.with_file_name("motor.csv"), LINE).expect("a file");
    let [_, omega] = end(&spec, 2.0, &push);
    let known = IDLE + 0.3 / 2e-3 * (2.0 - last);
    // The step across the kink of the torque has a larger error than a smooth one.
    assert!((omega - known).abs() < 1e-5, "{omega} {known}");
}

#[test]
fn what_is_no_table_is_told_and_none_is_overwritten() {
    for (table, text, words) in [
        ("mtor.csv", LINE, "cannot read `mtor.csv`"),
        ("motor.csv:tork", LINE, "no column `tork`"),
        (
            "motor.csv:torque",
            "a; b\n0; 1\n1; 2\n",
            "no column `torque`",
        ),
        ("motor.csv", "speed; torque\n0; 1\n1; x\n", "`x`"),
        ("motor.csv", "speed; torque\n0; 1\n0; 2\n", "line 3"),
        ("motor.csv", "", "motor.csv"),
    ] {
        let spec = rotor(table, text);
        let (status, out, error) = said(&["simulate", spec.path(), "--until", "1"]);
        assert_eq!(status, Some(1), "{table}: {out}{error}");
        assert!(error.contains(words), "{table}: {error}");
    }
    let spec = rotor("motor.csv:torque", LINE);
    let table = spec.0.with_file_name("motor.csv");
    let table = table.to_str().expect("text");
    for call in [
        &["simulate", spec.path(), "--until", "1", "--out", table][..],
        &["derive", spec.path(), "--as", "c", "--out", table],
        &[
            "sweep",
            spec.path(),
            "--vary",
            "J=1e-3,2e-3",
            "--until",
            "1",
            "--out",
            table,
        ],
    ] {
        let (status, _, error) = said(call);
        assert_eq!(status, Some(2), "{call:?}: {error}");
        assert!(error.contains("which the spec reads"), "{call:?}: {error}");
        assert_eq!(std::fs::read_to_string(table).expect("the table"), LINE);
    }
}
