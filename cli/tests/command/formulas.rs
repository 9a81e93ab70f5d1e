//! Formulas of a call that contain outputs, which must not change what the spec means.

use crate::support::{Scratch, json, lagrangian, number};
use serde_json::Value;

/// A planetary gear with its ring fixed. The output `planet` has the name of the frame whose rotation the gears transmit, and is another
/// angle: that of the planet relative to its arm.
const GEAR: &str = "machine Gear in plane {
    parameters { z1: 1 = 20, z2: 1 = 30, z3: 1 = 80, r: m = 0.1, J: kg*m^2 = 0.02, m: kg = 1, M: N*m = 3 }
    coordinates { sun: rad, arm: rad, turned: rad }
    frames { carrier = ground.turn(arm), planet = carrier.shift(r, 0).turn(turned) }
    bodies {
        sun { mass: m, inertia: J, at: (0, 0), angle: sun },
        carrier { mass: m, inertia: J, frame: carrier },
        planet { mass: m, inertia: J, frame: planet },
    }
    transmissions {
        inner { turns: (planet, sun), teeth: (z2, z1), carrier: arm },
        outer { turns: (planet, 0*rad), teeth: (z2, -z3), carrier: arm },
    }
    torques { drive { on: sun, torque: M } }
    outputs { planet: rad = turned }
}
";

/// By Willis: the sun turns by 1 + z₃/z₁ = 5 turns of the arm, the planet by −z₃/z₂ = −8/3 relative to it. Reduced to the arm the
/// inertia is J (5² + 1 + (1 − 8/3)²) + m r², and the torque 5 M.
fn arm_acceleration() -> f64 {
    let inertia = 0.02 * (25.0 + 1.0 + 25.0 / 9.0) + 0.01;
    15.0 / inertia
}

/// Tolerances of 1e-9 in each of some ten steps, on angles up to a hundred.
const CLOSE: f64 = 1e-6;

#[test]
fn outputs_in_formulas_leave_frames_of_the_same_name() {
    let spec = Scratch::new("gear.machine", GEAR);
    let rows = spec.0.with_file_name("rows.csv");
    let out = rows.to_str().expect("text");
    let reduce = ["--reduce", "end = last(planet)", "--vary", "r=0.1"];
    let call = ["sweep", spec.path(), "--until", "1", "--out", out];
    let output = lagrangian(&[&call[..], &reduce].concat());
    assert!(output.status.success(), "{output:?}");
    let text = std::fs::read_to_string(&rows).expect("rows");
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let (head, row) = (lines.next().expect("a head"), lines.next().expect("a row"));
    let arm = arm_acceleration() / 2.0;
    for (name, expected) in [("arm", arm), ("sun", 5.0 * arm), ("end", -8.0 / 3.0 * arm)] {
        let place = head.iter().position(|column| *column == name);
        let found: f64 = row[place.expect("a column")].parse().expect("a number");
        assert!(
            (found - expected).abs() < CLOSE,
            "{name}: {found}, not {expected}"
        );
    }

    // 8/3·a t²/2 = 2
    let call = ["section", spec.path(), "--until", "1", "--json"];
    let falls = [
        "--crossing",
        "planet + 2",
        "--direction",
        "down",
        "--of",
        "sun",
    ];
    let found = json(&[&call[..], &falls].concat());
    let expected = (2.0 * 2.0 * 3.0 / (8.0 * arm_acceleration())).sqrt();
    let t = number(&found["t"][0]);
    assert!((t - expected).abs() < CLOSE, "{t}, not {expected}");
}

/// A block on a spring; outputs with names of units, and one that is a bare number in its unit.
const BLOCK: &str = "machine Block in plane {
    parameters { M: kg = 2, l: mm = 20 }
    coordinates { x: m = 30*mm }
    bodies { block { mass: M, at: (x, 0) } }
    gravity none;
    springs { spring { stiffness: 8*N/m, stretch: x } }
    outputs { N: N = 8*N/m*x, mm: 1 = x/(20*mm), level: mm = 12, part: mm = l*x/(20*mm) }
}
";

/// x = 30 mm·cos 2t
fn falls_to(level: f64) -> f64 {
    (level / 30.0).acos() / 2.0
}

fn crossing(spec: &Scratch, formula: &str) -> Result<f64, String> {
    let call = ["section", spec.path(), "--until", "1", "--of", "x"];
    let fall = ["--crossing", formula, "--direction", "down", "--json"];
    let call = [&call[..], &fall].concat();
    let output = lagrangian(&call);
    if output.status.success() {
        let found: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        Ok(number(&found["t"][0]))
    } else {
        Err(String::from_utf8_lossy(&output.stderr).into_owned())
    }
}

#[test]
fn outputs_in_formulas_leave_units_of_the_same_name() {
    let spec = Scratch::new("block.machine", BLOCK);
    // 0.16 N at 20 mm
    for formula in ["N = 0.16", "x - 2*cm"] {
        let t = crossing(&spec, formula).unwrap_or_else(|why| panic!("{formula}: {why}"));
        assert!((t - falls_to(20.0)).abs() < 1e-7, "{formula}: {t}");
    }
    // Either the unit could be meant or the output.
    let why = crossing(&spec, "x - 10*mm").expect_err("it is ambiguous");
    assert!(why.contains("`mm` is an output, and a unit"), "{why}");
}

/// A bare number is in the unit of its output, as it is printed.
#[test]
fn outputs_in_formulas_have_their_units() {
    let spec = Scratch::new("block.machine", BLOCK);
    for formula in ["x - level", "part = 12", "part=1.2*cm"] {
        let t = crossing(&spec, formula).unwrap_or_else(|why| panic!("{formula}: {why}"));
        assert!((t - falls_to(12.0)).abs() < 1e-7, "{formula}: {t}");
    }
    let why = crossing(&spec, "part = 12*kg").expect_err("a mass is no length");
    assert!(why.contains("kg"), "{why}");
}
