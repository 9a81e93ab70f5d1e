//! Derived parameters, against closed forms and against the same machine with the formula typed in.

use std::fmt::Write as _;

use crate::support::{Scratch, json, lagrangian, number};
use serde_json::Value;

/// A disc on a torsion spring: φ = φ₀ cos ωt, ω² = c/J, J = m r²/2.
const DISC: &str = "machine Disc in plane {
    parameters { m: kg = 2, r: m = 0.5, c: N*m = 4, J: kg*m^2 = m*r^2/2, edge: mm = 10*r }
    coordinates { phi: rad = 0.3 }
    bodies { disc { mass: m, inertia: J, at: (0, 0), angle: phi } }
    torsion_springs { wire { stiffness: c, twist: phi } }
    outputs { travel: mm = edge*phi }
}
";

/// The disc with its inertia typed in, without derived parameters.
const TYPED: &str = "machine Disc in plane {
    parameters { m: kg = 2, r: m = 0.5, c: N*m = 4, J: kg*m^2 = 0.25 }
    coordinates { phi: rad = 0.3 }
    bodies { disc { mass: m, inertia: J, at: (0, 0), angle: phi } }
    torsion_springs { wire { stiffness: c, twist: phi } }
    outputs { travel: mm = 10*r*phi }
}
";

const START: f64 = 0.3;

fn phi(m: f64, r: f64, t: f64) -> f64 {
    START * ((4.0 / (m * r * r / 2.0)).sqrt() * t).cos()
}

fn answer(arguments: &[&str]) -> Value {
    json(&[arguments, &["--json"]].concat())
}

fn refused(arguments: &[&str]) -> String {
    let output = lagrangian(arguments);
    let said = String::from_utf8(output.stderr).expect("text");
    assert!(!output.status.success(), "{arguments:?}: {said}");
    said
}

/// The angle of the disc after a second, by `simulate`; a tolerance of 1e-12 over about forty steps.
fn end(spec: &str, more: &[&str]) -> f64 {
    let run = ["simulate", spec, "--until", "1", "--tolerance", "1e-12"];
    let found = answer(&[&run[..], more].concat());
    number(&found["q"]["phi"])
}

const CLOSE: f64 = 1e-10;

#[test]
fn a_derived_parameter_follows_what_it_depends_on() {
    let (spec, typed) = (
        Scratch::new("disc.machine", DISC),
        Scratch::new("typed.machine", TYPED),
    );
    let near = |found: f64, expected: f64| {
        assert!((found - expected).abs() < CLOSE, "{found} {expected}");
    };
    near(end(spec.path(), &[]), phi(2.0, 0.5, 1.0));
    near(end(spec.path(), &["--set", "m=3"]), phi(3.0, 0.5, 1.0));
    near(
        end(spec.path(), &["--set", "m=3", "--set", "r=0.4"]),
        phi(3.0, 0.4, 1.0),
    );
    // A derived parameter that is set no longer follows the others: J = 1 is that of a disc of 8 kg.
    near(
        end(spec.path(), &["--set", "J=1", "--set", "m=3"]),
        phi(8.0, 0.5, 1.0),
    );
    near(
        end(spec.path(), &["--const", "J=1", "--set", "m=3"]),
        phi(8.0, 0.5, 1.0),
    );
    // All of these numbers are exact in f64, so both specs use the same values.
    let bits = |spec: &Scratch, more: &[&str]| end(spec.path(), more).to_bits();
    assert_eq!(bits(&spec, &[]), bits(&typed, &[]));
    assert_eq!(
        bits(&spec, &["--set", "m=4"]),
        bits(&typed, &["--set", "m=4", "--set", "J=0.5"])
    );
    // A chain of units: 10 r is 20 m, and the output is in mm; 20 mm of edge are 20 mm.
    let travel = |set: &str| {
        let found = answer(&["evaluate", spec.path(), "--set", set]);
        number(&found[0]["outputs"]["travel"])
    };
    near(travel("r=2"), 20e3 * START);
    near(travel("edge=20"), 20.0 * START);
}

#[test]
fn runs_side_by_side_follow_too() {
    let spec = Scratch::new("disc.machine", DISC);
    let folder = Scratch::new("unused", "");
    let out = folder.0.with_file_name("out.csv");
    let end = |vary: &str| -> Vec<f64> {
        let _ = std::fs::remove_file(&out);
        answer(&[
            "sweep",
            spec.path(),
            "--vary",
            vary,
            "--until",
            "1",
            "--tolerance",
            "1e-12",
            "--out",
            out.to_str().expect("text"),
        ]);
        let text = std::fs::read_to_string(&out).expect("a table");
        let mut lines = text.lines();
        let names = lines.next().expect("a head").split(',');
        let place = names.clone().position(|name| name.starts_with("phi"));
        let place = place.unwrap_or_else(|| panic!("no phi: {text}"));
        lines
            .map(|line| line.split(',').nth(place).expect("a cell"))
            .map(|cell| cell.parse().expect("a number"))
            .collect()
    };
    for (found, m) in end("m=1,2,5").into_iter().zip([1.0, 2.0, 5.0]) {
        assert!((found - phi(m, 0.5, 1.0)).abs() < CLOSE, "{m}: {found}");
    }
    // J itself is varied: its values are those of discs of 4 and 8 kg.
    for (found, m) in end("J=0.5,1").into_iter().zip([4.0, 8.0]) {
        assert!((found - phi(m, 0.5, 1.0)).abs() < CLOSE, "{m}: {found}");
    }
}

#[test]
fn derivatives_go_through_what_follows() {
    let spec = Scratch::new("disc.machine", DISC);
    let by = |name: &str, more: &[&str]| {
        let call = [
            "sensitivities",
            spec.path(),
            "--by",
            name,
            "--of",
            "phi",
            "--until",
            "1",
            "--tolerance",
            "1e-12",
        ];
        let found = answer(&[&call[..], more].concat());
        let values = found["derivatives"][0]["values"]
            .as_array()
            .expect("a list");
        number(values.last().expect("a value"))
    };
    // ω is proportional to m^(-1/2)/r, and ∂φ/∂ω = -φ₀ t sin ωt.
    let omega = 4.0;
    let by_omega = -START * f64::sin(omega);
    assert!((by("m", &[]) - by_omega * -omega / (2.0 * 2.0)).abs() < 1e-9);
    assert!((by("r", &[]) - by_omega * -omega / 0.5).abs() < 1e-9);
    // With J set, the mass has no effect, and J is an ordinary parameter: ω is proportional to J^(-1/2).
    assert_eq!(by("m", &["--set", "J=0.25"]), 0.0);
    let found = by("J", &["--set", "J=0.25"]);
    assert!((found - by_omega * -omega / (2.0 * 0.25)).abs() < 1e-9);
    // The squared frequency by `modes`: c/J = 16, and 4 at 8 kg.
    let frequency = |more: &[&str]| {
        let call = ["modes", spec.path(), "--start", "phi=0"];
        let found = answer(&[&call[..], more].concat());
        number(&found["modes"][0]["im"])
    };
    assert!((frequency(&[]) - 4.0).abs() < CLOSE);
    assert!((frequency(&["--set", "m=8"]) - 2.0).abs() < CLOSE);
}

#[test]
fn what_others_follow_is_fitted() {
    let spec = Scratch::new("disc.machine", DISC);
    let mut rows = String::from("t,phi\n");
    for k in 0..=20 {
        let t = f64::from(k) / 10.0;
        // The motion of a disc of 3 kg, in closed form.
        let _ = writeln!(rows, "{t},{:e}", phi(3.0, 0.5, t));
    }
    let data = Scratch::new("data.csv", &rows);
    let fitted = |name: &str, more: &[&str]| {
        let call = ["fit", spec.path(), "--data", data.path(), "--fit", name];
        let found = answer(&[&call[..], more].concat());
        number(&found["fitted"][0]["value"])
    };
    assert!((fitted("m", &[]) - 3.0).abs() < 1e-6);
    assert!((fitted("J", &["--set", "J=0.3"]) - 0.375).abs() < 1e-6);
}

/// The period of the disc is 2π √(J/c). The range gives J its values, so that no other is needed.
#[test]
fn orbits_along_a_derived_parameter() {
    let spec = Scratch::new("disc.machine", DISC);
    let range = ["--near", "1.6", "--along", "J=0.25..0.36:2"];
    let found = answer(&[&["orbit", spec.path()][..], &range].concat());
    for (k, inertia) in [0.25_f64, 0.36].into_iter().enumerate() {
        let period = number(&found["points"][k]["period"]);
        let expected = std::f64::consts::TAU * (inertia / 4.0).sqrt();
        assert!(
            (period - expected).abs() < CLOSE,
            "{period}, not {expected}"
        );
    }
}

#[test]
fn what_cannot_be_is_told() {
    let spec = Scratch::new("disc.machine", DISC);
    let run = ["simulate", spec.path(), "--until", "1"];
    // m = -1 makes J negative, r = 1e200 makes it infinite.
    let said = refused(&[&run[..], &["--set", "m=-1"]].concat());
    assert!(
        said.contains("not be negative") || said.contains("positive"),
        "{said}"
    );
    let said = refused(&[&run[..], &["--set", "r=1e200"]].concat());
    assert!(
        said.contains("a derived parameter must be a finite number"),
        "{said}"
    );
    // A sensitivity by J itself needs a value of J.
    let call = ["sensitivities", spec.path(), "--by", "J", "--until", "1"];
    let said = refused(&call);
    assert!(
        said.contains("--set J=") && said.contains("from `m`, `r`"),
        "{said}"
    );
}
