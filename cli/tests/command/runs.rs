//! `lagrangian compare`, `spectrum`, `peaks`, `section` and `sensitivities` against closed forms.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

use crate::support::{Scratch, json, lagrangian, number};
use serde_json::Value;

/// Runs a command that must succeed; returns its JSON.
fn answer(arguments: &[&str]) -> Value {
    json(&[arguments, &["--json"]].concat())
}

/// The message of a call that fails, and its exit status.
fn refused(arguments: &[&str]) -> (i32, String) {
    let output = lagrangian(arguments);
    let said = String::from_utf8(output.stderr).expect("text");
    (output.status.code().expect("no signal"), said)
}

fn list(value: &Value) -> Vec<f64> {
    value
        .as_array()
        .unwrap_or_else(|| panic!("no list: {value}"))
        .iter()
        .map(number)
        .collect()
}

/// The quantity of this name.
fn quantity<'a>(found: &'a Value, name: &str) -> &'a Value {
    let all = found["quantities"].as_array().expect("a list");
    let own = all.iter().find(|one| one["name"] == name);
    own.unwrap_or_else(|| panic!("no {name}: {found:#}"))
}

/// A damped oscillator: x = e^{−δt} (cos ωt + δ/ω sin ωt) from 1 m at rest, with δ = d/2 and ω² = k − δ².
const OSCILLATOR: &str = "machine Oscillator in plane {
    parameters { k: N/m = 39.47841760435743, d: N*s/m = 0.2 }
    coordinates { x: m = 1 }
    bodies { ball { mass: 1, at: (x, 0) } }
    springs { back { stiffness: k, stretch: x } }
    dampers { oil { damping: d, stretch: x } }
    outputs { force: N = k*x }
}";

const STIFFNESS: f64 = 39.478_417_604_357_43;

fn oscillation(t: f64, d: f64, k: f64) -> f64 {
    let delta = d / 2.0;
    let omega = (k - delta * delta).sqrt();
    (-delta * t).exp() * ((omega * t).cos() + delta / omega * (omega * t).sin())
}

/// A table of some columns.
fn table(name: &str, header: &str, rows: impl Iterator<Item = Vec<f64>>) -> Scratch {
    let mut text = format!("{header}\n");
    for row in rows {
        let cells: Vec<String> = row.iter().map(|x| format!("{x:?}")).collect();
        let _ = writeln!(text, "{}", cells.join(","));
    }
    Scratch::new(name, &text)
}

#[test]
fn a_spec_is_as_far_from_a_table_as_the_closed_form_says() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    // In other units, and at uneven intervals.
    let rows = (0..=400).map(|k| {
        let t = 5.0 * (f64::from(k) / 400.0).powf(1.3);
        vec![1e3 * t, 1e3 * (oscillation(t, 0.2, STIFFNESS) + 1e-3 * t)]
    });
    let data = table("data.csv", "t [ms],x [mm]", rows);
    let found = answer(&["compare", data.path(), spec.path(), "--tolerance", "1e-11"]);
    let x = quantity(&found, "x");
    // The spec is evaluated at the times of the rows, so there is no interpolation. The tolerance is 1e-11 per step.
    assert_eq!(x["unit"], "mm");
    assert!((number(&x["largest"]) - 5.0).abs() < 1e-6, "{x:#}");
    assert!((number(&x["at"]) - 5.0).abs() < 1e-12);
    // ∫ (1e-3 t)² dt over 5 s is 25e-6/3 · 5, so the root mean square is 5e-3/√3; the error of the trapezoidal rule is h²/6 of it.
    assert!(
        (number(&x["rms"]) - 5.0 / 3.0_f64.sqrt()).abs() < 1e-4,
        "{x:#}"
    );
    assert!(x["between_rows"][0].is_null() && x["between_rows"][1].is_null());
    let status = |within: &str| {
        refused(&[
            "compare",
            data.path(),
            spec.path(),
            "--tolerance",
            "1e-11",
            "--within",
            within,
        ])
        .0
    };
    // The range of x is about 1.79.
    let share = number(&x["relative"]);
    assert_eq!(status(&format!("{}", 1.01 * share)), 0);
    assert_eq!(status(&format!("{}", 0.99 * share)), 1);
}

#[test]
fn tables_at_other_instants_are_compared_by_cubics_with_rates() {
    let rows = |count: i32, amplitude: f64| {
        (0..=count).map(move |k| {
            let t = TAU * f64::from(k) / f64::from(count);
            vec![
                t,
                t.sin() + amplitude * (3.0 * t).sin(),
                t.cos() + 3.0 * amplitude * (3.0 * t).cos(),
            ]
        })
    };
    let one = table("one.csv", "t [s],x [m],der(x) [m/s]", rows(200, 0.0));
    let two = table("two.csv", "t [s],x [m],der(x) [m/s]", rows(170, 1e-3));
    let found = answer(&["compare", one.path(), two.path(), "--of", "x"]);
    let x = quantity(&found, "x");
    // The interpolation error: h⁴/384 times the fourth derivative, which is 1 + 81e-3 here.
    let between = (TAU / 170.0).powi(4) / 384.0 * 1.1;
    let step = TAU / 200.0;
    assert!(
        (number(&x["largest"]) - 1e-3).abs() < 1e-3 * (3.0 * step).powi(2) / 2.0 + 2.0 * between
    );
    assert!((number(&x["rms"]) - 1e-3 / 2.0_f64.sqrt()).abs() < 1e-6);
    for k in [0, 1] {
        let said = number(&x["between_rows"][k]["error"]);
        assert!(
            said < 2.0 * between && said > 0.1 * between,
            "{said:e} {between:e}"
        );
        assert_eq!(x["between_rows"][k]["interpolation"], "cubic with rates");
    }
    // A run does not differ from itself, in either order.
    let same = answer(&["compare", one.path(), one.path(), "--within", "1e-15"]);
    assert_eq!(number(&quantity(&same, "x")["largest"]), 0.0);
    assert_eq!(same["beyond"].as_array().map(Vec::len), Some(0));
}

#[test]
fn two_specs_are_compared_with_what_sets_the_second_apart() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let out = spec.0.with_file_name("apart.csv");
    let plot = spec.0.with_file_name("apart.svg");
    let found = answer(&[
        "compare",
        spec.path(),
        spec.path(),
        "--until",
        "2",
        "--every",
        "0.01",
        "--tolerance",
        "1e-11",
        "--set-second",
        "d=0.3",
        "--out",
        out.to_str().unwrap(),
        "--plot",
        plot.to_str().unwrap(),
    ]);
    let off = |k: i32| {
        let t = 0.01 * f64::from(k);
        oscillation(t, 0.3, STIFFNESS) - oscillation(t, 0.2, STIFFNESS)
    };
    let largest = (0..=200).map(|k| off(k).abs()).fold(0.0, f64::max);
    assert!((number(&quantity(&found, "x")["largest"]) - largest).abs() < 1e-8);
    let text = std::fs::read_to_string(&out).unwrap();
    let mut lines = text.lines();
    assert!(lines.next().unwrap().starts_with("t [s],x [m]"));
    for (k, line) in lines.enumerate() {
        let x: f64 = line.split(',').nth(1).unwrap().parse().unwrap();
        assert!((x - off(k as i32)).abs() < 1e-8, "{line}");
    }
    assert!(std::fs::read_to_string(&plot).unwrap().contains("</svg>"));
}

#[test]
fn spectra_have_the_frequencies_and_amplitudes_of_sines() {
    let wave = |t: f64| 0.5 + 2.0 * (TAU * 3.21 * t).cos() + 0.01 * (TAU * 7.8 * t + 1.0).cos();
    let even = table(
        "even.csv",
        "t [s],x [mm]",
        (0..1000)
            .map(|k| 0.01 * f64::from(k))
            .map(|t| vec![t, wave(t)]),
    );
    let found = answer(&["spectrum", even.path()]);
    let lines = quantity(&found, "x")["lines"].as_array().unwrap().clone();
    assert_eq!(lines.len(), 2, "{found:#}");
    // Two lines 46 frequency bins apart: the leakage of a window falls off with the cube of that distance.
    for (line, (frequency, amplitude)) in lines.iter().zip([(3.21, 2.0), (7.8, 0.01)]) {
        assert!(
            (number(&line["frequency"]) - frequency).abs() < 1e-6,
            "{line}"
        );
        assert!(
            (number(&line["amplitude"]) / amplitude - 1.0).abs() < 1e-4,
            "{line}"
        );
    }
    assert_eq!(found["resampled"], false);
    // Uneven rows are interpolated by cubics.
    let rows = (0..4000).map(|k| {
        let k = f64::from(k);
        let t = 0.0025 * (k + 0.3 * (0.1 * k).sin());
        vec![t, wave(t)]
    });
    let uneven = table("uneven.csv", "t [s],x [mm]", rows);
    let found = answer(&[
        "spectrum",
        uneven.path(),
        "--of",
        "x",
        "--window",
        "blackman-harris",
    ]);
    assert_eq!(found["resampled"], true);
    let line = &quantity(&found, "x")["lines"][0];
    assert!((number(&line["frequency"]) - 3.21).abs() < 1e-4, "{line}");
    assert!((number(&line["amplitude"]) - 2.0).abs() < 1e-3, "{line}");
}

#[test]
fn a_damped_oscillation_has_its_period_and_decrement() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let found = answer(&[
        "peaks",
        spec.path(),
        "--until",
        "8",
        "--tolerance",
        "1e-11",
        "--every",
        "0.002",
    ]);
    let x = quantity(&found, "x");
    let (delta, period) = (0.1, TAU / (STIFFNESS - 0.01_f64).sqrt());
    // Extremes are those of cubics between rows: their times have an error of about h³/100, and their values of h⁴/384 ω⁴.
    assert!((number(&x["period"]) - period).abs() < 1e-7, "{x:#}");
    assert!((number(&x["decrement"]) - delta * period).abs() < 1e-7);
    let damping = delta / STIFFNESS.sqrt();
    assert!((number(&x["damping"]) - damping).abs() < 1e-7);
    for (k, extreme) in x["extremes"].as_array().unwrap().iter().enumerate() {
        let t = 0.5 * period * (k + 1) as f64;
        let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
        assert!((number(&extreme["t"]) - t).abs() < 1e-7);
        assert!((number(&extreme["value"]) - sign * (-delta * t).exp()).abs() < 1e-8);
    }
}

/// The maxima and minima of the quantity with this name, by `peaks`.
fn turns(spec: &Scratch, name: &str, more: &[&str]) -> Vec<f64> {
    let found = answer(&[&["peaks", spec.path(), "--of", name], more].concat());
    let quantity = quantity(&found, name);
    assert!(number(&quantity["ripple"]) > 0.0, "{quantity:#}");
    let extremes = quantity["extremes"].as_array().expect("a list");
    extremes.iter().map(|one| number(&one["t"])).collect()
}

#[test]
fn what_a_run_is_not_exact_enough_for_is_no_extreme() {
    // By the addition theorem the first output is 0, and only the round-off of its terms is left. The second is as small, but is not round-off.
    let spec = OSCILLATOR.replace(
        "outputs {",
        "outputs {
            zero: 1 = sin(x/(1*m) + 1) - sin(x/(1*m))*cos(1) - cos(x/(1*m))*sin(1),
            tiny: m = 1e-15*x,",
    );
    let spec = Scratch::new("oscillator.machine", &spec);
    assert!(turns(&spec, "zero", &["--until", "8"]).is_empty());
    let shown = turns(&spec, "zero", &["--until", "8", "--ripple", "1e-300"]);
    assert!(shown.len() > 100, "{shown:?}");
    let half = PI / (STIFFNESS - 0.01_f64).sqrt();
    let tiny = turns(&spec, "tiny", &["--until", "8"]);
    assert_eq!(tiny.len(), (8.0 / half) as usize);
    for (k, t) in tiny.iter().enumerate() {
        assert!((t - half * (k + 1) as f64).abs() < 1e-4, "{t}");
    }
    // With so much damping the oscillator is overdamped and x decreases all the time; at the end by less than the error of steps.
    for until in ["20", "40", "60"] {
        let creeping = ["--set", "d=20", "--until", until];
        assert!(turns(&spec, "x", &creeping).is_empty());
    }
    let output = lagrangian(&["peaks", spec.path(), "--set", "d=20", "--until", "40"]);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(text.contains("x: 0 maxima, 0 minima; "), "{text}");
    assert!(text.contains(" ripples of no more than "), "{text}");
}

/// A ball that falls by 1 m with g = 8 m/s² reaches the floor after √(2/8) s, and with e = 1/2 its impacts are at 0.5, 1, 1.25, … s.
#[test]
fn extremes_next_to_impacts_are_said_to_be_those_of_a_smooth_curve() {
    let ball = "machines/contacts/bouncing_ball.machine";
    let given = ["--set", "e=0.5", "--set", "g=8", "--of", "y"];
    for (until, after, count) in [
        ("0.4", "0", 0),
        ("0.9", "0", 1),
        ("1.1", "0", 2),
        ("1.1", "0.7", 1),
    ] {
        let call = ["peaks", ball, "--until", until, "--after", after];
        let output = lagrangian(&[&call[..], &given].concat());
        assert!(output.status.success());
        let said = String::from_utf8(output.stderr).expect("text");
        let expected = match count {
            1 => "there is 1 impact, at which rates jump",
            _ => &format!("there are {count} impacts, at which rates jump"),
        };
        assert_eq!(said.contains(expected), count > 0, "{until}: {said}");
        assert_eq!(said.contains("impact"), count > 0, "{until}: {said}");
    }
}

/// cos 2πt: with rows 0.7 s apart it seems to have a period of 2.3 s, and with rows h = 0.6π apart in phase the cubics over
/// two intervals are off by 1 − cos h − h/2 sin h = 0.41 at a maximum; a sixteenth of this is the estimate for one interval.
#[test]
fn rows_too_far_apart_for_an_oscillation_are_told() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    for (command, every, words) in [
        ("peaks", "0.7", "oscillates more than once in two rows"),
        ("spectrum", "0.7", "oscillates more than once in two rows"),
        ("peaks", "0.3", "between rows `x` is known to some 2.6e-2 m"),
        ("spectrum", "0.3", ""),
        ("peaks", "0.02", ""),
    ] {
        let call = [
            command,
            spec.path(),
            "--set",
            "d=0",
            "--until",
            "60",
            "--every",
            every,
        ];
        let output = lagrangian(&call);
        assert!(output.status.success());
        let said = String::from_utf8(output.stderr).expect("text");
        assert!(said.contains(words), "{command} {every}: {said}");
        assert_eq!(
            said.is_empty(),
            words.is_empty(),
            "{command} {every}: {said}"
        );
    }
}

/// A wheel that rotates uniformly allows long steps, and is upright many times in one: also if its coordinate is a pure number, or
/// the distance rolled.
#[test]
fn what_turns_many_times_in_a_step_is_found_each_time() {
    let wheels = [
        ("phi: rad = 0.3, der(phi): rad/s = 10", "phi", "0"),
        ("phi: 1 = 0.3, der(phi): 1/s = 10", "phi", "0"),
        ("x: m = 0.03, der(x): m/s = 1", "x/r", "x"),
    ];
    for (coordinate, angle, way) in wheels {
        let spec = format!(
            "machine Wheel in plane {{
                parameters {{ J: kg*m^2 = 1, m: kg = 1, r: m = 0.1 }}
                coordinates {{ {coordinate} }}
                frames {{ wheel = ground.shift({way}, 0).turn({angle}) }}
                bodies {{ wheel {{ mass: m, inertia: J, frame: wheel }} }}
                gravity none;
            }}"
        );
        let spec = Scratch::new("wheel.machine", &spec);
        for method in ["dop853", "dopri5", "radau5"] {
            for until in [10.0, 100.0, 1000.0] {
                let last = f64::to_string(&until);
                let run = ["--until", &last, "--method", method];
                let upright = format!("cos({angle})");
                let asked = ["--crossing", &upright, "--direction", "both"];
                let found = answer(&[&["section", spec.path()], &asked[..], &run].concat());
                let times = list(&found["t"]);
                let count = ((0.3 + 10.0 * until) / PI - 0.5).floor() as usize + 1;
                assert_eq!(times.len(), count, "{coordinate} {method} {until}");
                for (k, t) in times.iter().enumerate() {
                    let exact = ((k as f64 + 0.5) * PI - 0.3) / 10.0;
                    // The rounding of a large angle.
                    assert!(
                        (t - exact).abs() < 64.0 * f64::EPSILON * (1.0 + until),
                        "{t} {exact}"
                    );
                }
            }
        }
    }
}

#[test]
fn sections_are_where_the_closed_form_has_them() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let run = ["--until", "5", "--tolerance", "1e-12"];
    let omega = (STIFFNESS - 0.01_f64).sqrt();
    // x = 0 where tan ωt = −ω/δ; the first crossing is downward.
    let first = (PI - (omega / 0.1).atan()) / omega;
    let found = answer(
        &[
            &[
                "section",
                spec.path(),
                "--crossing",
                "x",
                "--direction",
                "down",
            ],
            &run[..],
        ]
        .concat(),
    );
    let times = list(&found["t"]);
    assert!(times.len() >= 4, "{times:?}");
    for (k, t) in times.iter().enumerate() {
        assert!((t - first - k as f64 * TAU / omega).abs() < 1e-9, "{t}");
    }
    // The motion with the signal of a table, with the accuracy of cubics, and at a nonzero value.
    let rows = (0..=2500)
        .map(|k| 0.002 * f64::from(k))
        .map(|t| vec![t, oscillation(t, 0.2, STIFFNESS)]);
    let data = table("data.csv", "t [s],x [m]", rows);
    let found = answer(&[
        "section",
        data.path(),
        "--crossing",
        "x=0*mm",
        "--direction",
        "down",
    ]);
    for (one, other) in list(&found["t"]).iter().zip(&times) {
        assert!((one - other).abs() < 1e-7, "{one} {other}");
    }
    // Once per period of the drive: x at multiples of the period.
    let period = answer(
        &[
            &[
                "section",
                spec.path(),
                "--every-period",
                "2*pi*sqrt(1*kg/k)",
            ],
            &run[..],
        ]
        .concat(),
    );
    let values = list(&quantity(&period, "x")["values"]);
    for (k, x) in values.iter().enumerate() {
        let t = k as f64 * TAU / STIFFNESS.sqrt();
        assert!((x - oscillation(t, 0.2, STIFFNESS)).abs() < 1e-9);
    }
    assert_eq!(values.len(), 6);
    // A bare number is in the unit of an output: 150 mm.
    let scaled = OSCILLATOR.replace("outputs {", "outputs { far: mm = x,");
    let scaled = Scratch::new("scaled.machine", &scaled);
    for value in ["far=150", "far=0.15*m", "far=150*mm"] {
        let at = ["--crossing", value, "--of", "far"];
        let found = answer(&[&["section", scaled.path()], &at[..], &run].concat());
        let values = list(&quantity(&found, "far")["values"]);
        assert!(!values.is_empty(), "{value}");
        for far in values {
            assert!((far - 150.0).abs() < 1e-9, "{value}: {far}");
        }
    }
    // What --after leaves out does not change the phase, also of a table.
    let after = ["--every-period", "0.5", "--after", "1.2"];
    let made = answer(&[&["section", spec.path()], &after[..], &run].concat());
    let read = answer(&[&["section", data.path()], &after[..]].concat());
    assert_eq!(list(&read["t"])[..2], [1.5, 2.0]);
    assert_eq!(list(&made["t"]), list(&read["t"]));
}

#[test]
fn sensitivities_are_the_derivatives_of_the_closed_form() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let found = answer(&[
        "sensitivities",
        spec.path(),
        "--by",
        "k,d,start(x),rate(x)",
        "--of",
        "x,der(x),force",
        "--until",
        "2",
        "--every",
        "0.5",
        "--tolerance",
        "1e-12",
    ]);
    let times = list(&found["t"]);
    let column = |name: &str| {
        let all = found["derivatives"].as_array().unwrap();
        let own = all.iter().find(|one| one["name"] == name);
        list(&own.unwrap_or_else(|| panic!("no {name}: {found:#}"))["values"])
    };
    // Central differences of the closed form: their own error is h²/6 times the third derivative, and 1e-16/h.
    let h = 1e-5;
    for (k, &t) in times.iter().enumerate() {
        let by_d =
            (oscillation(t, 0.2 + h, STIFFNESS) - oscillation(t, 0.2 - h, STIFFNESS)) / (2.0 * h);
        let by_k =
            (oscillation(t, 0.2, STIFFNESS + h) - oscillation(t, 0.2, STIFFNESS - h)) / (2.0 * h);
        assert!((column("x by d")[k] - by_d).abs() < 1e-9, "{t}");
        assert!((column("x by k")[k] - by_k).abs() < 1e-9, "{t}");
        // The machine is linear, so the derivative by its start is the motion from 1 m.
        let x = oscillation(t, 0.2, STIFFNESS);
        assert!((column("x by start(x)")[k] - x).abs() < 1e-9);
        // The output k x also depends on k directly.
        assert!(
            (column("force by k")[k] - (x + STIFFNESS * by_k)).abs() < 1e-7,
            "{t}"
        );
        assert!((column("force by d")[k] - STIFFNESS * by_d).abs() < 1e-7);
    }
    let unit = |name: &str| {
        let all = found["derivatives"].as_array().unwrap();
        all.iter().find(|one| one["name"] == name).unwrap()["unit"]
            .as_str()
            .unwrap()
            .to_owned()
    };
    assert_eq!(unit("x by k"), "m/(N/m)");
    assert_eq!(unit("x by start(x)"), "m/m");
}

#[test]
fn a_start_that_follows_a_parameter_is_differentiated_too() {
    // x = A cos ωt with the parameter A: ∂x/∂A = cos ωt; a start that is set by the call does not follow the parameter.
    let spec = Scratch::new(
        "start.machine",
        "machine Follows in plane {
            parameters { A: m = 0.3 }
            coordinates { x: m = A }
            bodies { ball { mass: 1, at: (x, 0) } }
            springs { back { stiffness: 1, stretch: x } }
        }",
    );
    let run = [
        "--by",
        "A",
        "--until",
        "1",
        "--every",
        "1",
        "--tolerance",
        "1e-12",
    ];
    let end = |more: &[&str]| {
        let found = answer(&[&["sensitivities", spec.path()], &run[..], more].concat());
        let values = list(&found["derivatives"][0]["values"]);
        values[values.len() - 1]
    };
    assert!((end(&[]) - 1.0_f64.cos()).abs() < 1e-10);
    assert_eq!(end(&["--start", "x=0.5"]), 0.0);
}

/// A pendulum in the coordinates of its bob, on a rod, compared with the same pendulum by its angle, which has no constraints.
#[test]
fn on_a_constraint_sensitivities_are_those_of_independent_coordinates() {
    let held = Scratch::new(
        "held.machine",
        "machine Held in plane {
            parameters { l: m = 0.8, g: m/s^2 = 9.81 }
            coordinates { x: m = 0.5, y: m = -sqrt(l^2 - 0.25*m^2) }
            bodies { bob { mass: 0.3, at: (x, y) } }
            gravity (0, -g);
            dampers { air { damping: 0.1, stretch: x } }
            constraints { rod: x^2 + y^2 = l^2 }
            outputs { height: m = y }
        }",
    );
    let free = Scratch::new(
        "free.machine",
        "machine Free in plane {
            parameters { l: m = 0.8, g: m/s^2 = 9.81, side: m = 0.5 }
            coordinates { theta: rad = asin(side/l) }
            bodies { bob { mass: 0.3, at: (l*sin(theta), -l*cos(theta)) } }
            gravity (0, -g);
            dampers { air { damping: 0.1, stretch: l*sin(theta) } }
            outputs { height: m = -l*cos(theta) }
        }",
    );
    let run = ["--until", "2", "--every", "0.5", "--tolerance", "1e-12"];
    let of = |call: &[&str]| {
        let found = answer(&[&["sensitivities"], call, &run[..]].concat());
        let all = found["derivatives"].as_array().unwrap().clone();
        let all: Vec<Vec<f64>> = all.iter().map(|one| list(&one["values"])).collect();
        all
    };
    // A start of the bob further to the side corresponds to a larger angle at constant length of the rod: y follows.
    let by = "--by";
    let on_rod = of(&[
        held.path(),
        by,
        "l,g,start(x)",
        "--of",
        "height",
        "--keep",
        "x",
    ]);
    let by_angle = of(&[free.path(), by, "l,g,side", "--of", "height"]);
    for (own, other) in on_rod.iter().zip(&by_angle) {
        assert_eq!(own.len(), 5);
        for (own, other) in own.iter().zip(other) {
            // Some hundred steps at 1e-12, whose errors grow with time on the rod; the start is known to 1e-10.
            assert!((own - other).abs() < 1e-8, "{on_rod:?} {by_angle:?}");
        }
    }
    // The spec's start follows a parameter and no coordinate is kept: the smallest projection has no first-order effect.
    let on_rod = of(&[held.path(), by, "l", "--of", "height"]);
    for (own, other) in on_rod[0].iter().zip(&by_angle[0]) {
        assert!((own - other).abs() < 1e-8);
    }
}

/// A bob on a rod without gravity, whose start is off the rod: by symmetry the projection goes along the radius and leaves the rate
/// across it, so θ = atan2(y, x) + ω t with ω = (cos θ ẏ − sin θ ẋ)/l at the start.
#[test]
fn a_start_off_a_constraint_is_differentiated_before_it_is_projected() {
    let spec = Scratch::new(
        "off_the_rod.machine",
        "machine OffTheRod in plane {
            parameters { l: m = 1 }
            coordinates { x: m = 0.9, y: m = 1.2, der(x): m/s = 1, der(y): m/s = 0.5 }
            bodies { bob { mass: 0.3, at: (x, y) } }
            gravity none;
            constraints { rod: x^2 + y^2 = l^2 }
            outputs { angle: rad = atan2(y, x) }
        }",
    );
    let found = answer(&[
        "sensitivities",
        spec.path(),
        "--by",
        "start(x),start(y),rate(x),l",
        "--until",
        "2",
        "--every",
        "0.5",
        "--tolerance",
        "1e-12",
    ]);
    let all = found["derivatives"].as_array().unwrap();
    let (x, y, vx, vy) = (0.9, 1.2, 1.0, 0.5);
    let r = f64::hypot(x, y);
    let (sin, cos) = (y / r, x / r);
    let along = cos * vx + sin * vy;
    for (k, t) in list(&found["t"]).into_iter().enumerate() {
        let turned = |by_angle: f64| by_angle * (1.0 - along * t);
        for (own, expected) in all.iter().zip([
            turned(-y / (r * r)),
            turned(x / (r * r)),
            -sin * t,
            -(cos * vy - sin * vx) * t,
        ]) {
            // Some hundred steps at 1e-12; the start is known to some 1e-9.
            let off = list(&own["values"])[k] - expected;
            assert!(off.abs() < 1e-8, "{} at {t}: {off}", own["name"]);
        }
    }
}

/// Friction by a sign jumps where the block turns; a force by an absolute value has a kink there, across which derivatives are continuous. The block starts at
/// rest at 1 m; after half a period, `π √(m/k)`, it turns at `−(1 − 2 f/k)`.
#[test]
fn sensitivities_across_jumps_of_forces_are_refused() {
    let spec = |force: &str| {
        let text = format!(
            "machine Dry in plane {{
                parameters {{ m: kg = 1, k: N/m = 40, f: N = 1.5, c: N*s^2/m^2 = 0.1 }}
                coordinates {{ x: m = 1 }}
                bodies {{ block {{ mass: m, at: (x, 0) }} }}
                springs {{ spring {{ stiffness: k, stretch: x }} }}
                forces {{ friction {{ on: x, value: {force} }} }}
                gravity none;
            }}"
        );
        Scratch::new("dry.machine", &text)
    };
    let call = |spec: &Scratch, until: &str, by: &str| -> Vec<String> {
        let words = ["sensitivities", spec.path(), "--by", by, "--until", until];
        words.map(String::from).into()
    };
    let words = |call: &[String]| -> (i32, String) {
        refused(&call.iter().map(String::as_str).collect::<Vec<_>>())
    };
    let dry = spec("-f*sign(der(x))");
    // The instant depends on both of them.
    for by in ["k", "m"] {
        let (status, said) = words(&call(&dry, "0.8", by));
        assert!(
            status == 1 && said.contains("as where a force jumps"),
            "{by}: {said}"
        );
    }
    // Before the block turns, x = f/k + (1 − f/k) cos ωt.
    let early = call(&dry, "0.4", "f");
    let early = answer(&early.iter().map(String::as_str).collect::<Vec<_>>());
    let exact = (1.0 - (40.0_f64.sqrt() * 0.4).cos()) / 40.0;
    let found = list(&early["derivatives"][0]["values"]);
    // The tolerance of a few steps, 1e-9 each.
    assert!((found.last().expect("a number") - exact).abs() < 1e-8);
    // A wall that the block hits before it turns, and after it.
    let text = "machine Dry in plane {
        parameters { m: kg = 1, k: N/m = 40, f: N = 1.5, e: 1 = 0.8, w: m = -0.5 }
        coordinates { x: m = 1 }
        bodies { block { mass: m, at: (x, 0) } }
        springs { spring { stiffness: k, stretch: x } }
        forces { friction { on: x, value: -f*sign(der(x)) } }
        contacts { wall { gap: x - w, restitution: e } }
        gravity none;
    }";
    let struck = Scratch::new("struck.machine", text);
    let (status, said) = words(&call(&struck, "1.2", "e"));
    assert!(
        status == 1 && said.contains("as where a force jumps"),
        "{said}"
    );
    let smooth = spec("-c*abs(der(x))*der(x)");
    let drag = call(&smooth, "0.8", "c,k");
    answer(&drag.iter().map(String::as_str).collect::<Vec<_>>());
}

#[test]
fn what_cannot_be_is_said() {
    let twice = Scratch::new(
        "twice.machine",
        "machine Twice in plane {
            parameters { l: m = 1 }
            coordinates { x: m = 0.6, y: m = -0.8 }
            bodies { bob { mass: 1, at: (x, y) } }
            gravity none;
            constraints { rod: x^2 + y^2 = l^2, again: 2*x^2 + 2*y^2 = 2*l^2 }
        }",
    );
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let data = Scratch::new("data.csv", "t,x [m]\n0,1\n1,\n2,3\n3,4\n4,5\n");
    let other = Scratch::new("other.csv", "t,x [N]\n0,1\n1,2\n");
    let later = Scratch::new("later.csv", "t,x\n7,1\n8,2\n");
    let (spec, data, other, later) = (spec.path(), data.path(), other.path(), later.path());
    let unmeasured = Scratch::new("unmeasured.csv", "t,x,y\n0,1,\n1,2,\n2,3,\n3,4,\n");
    let unmeasured = unmeasured.path();
    for (arguments, status, words) in [
        (&["compare", spec, spec][..], 2, &["--until"][..]),
        (&["compare", data, other], 1, &["`x`", "m", "N"]),
        (&["compare", data, later], 1, &["no time in common"]),
        (&["compare", data, data, "--of", "y"], 2, &["--of y", "x"]),
        (
            &["compare", data, data, "--of", "x", "--of", "x"],
            2,
            &["--of names `x` more than once"],
        ),
        (
            &["peaks", spec, "--until", "1", "--of", "x,x"],
            2,
            &["--of names `x` more than once"],
        ),
        // The run would be recorded at these instants instead of those of the table, and interpolated between them.
        (
            &["compare", data, spec, "--every", "0.5"],
            2,
            &["--every", "rows of the table"],
        ),
        (
            &["spectrum", spec, "--until", "1", "--method", "rk4"],
            2,
            &["--method rk4", "`simulate`", "--longest-step"],
        ),
        (
            &["compare", data, data, "--engine", "jit"],
            2,
            &["--engine", "table"],
        ),
        (
            &["compare", data, data, "--set", "k=1"],
            2,
            &["--set", "table"],
        ),
        (
            &["compare", spec, data, "--set-second", "k=1"],
            2,
            &["--set-second", "table"],
        ),
        (&["compare", data, "run.txt"], 2, &["run.txt", ".machine"]),
        (&["compare", data, data, "--out", data], 2, &["overwrite"]),
        (&["spectrum", data], 1, &["`x`", "without a value"]),
        (&["spectrum", other], 1, &["4 instants"]),
        (
            &["peaks", unmeasured, "--of", "y"],
            1,
            &["`y` has no value at any instant"],
        ),
        (
            &["section", unmeasured, "--crossing", "y=2"],
            1,
            &["`y` has no value at any instant"],
        ),
        (&["section", data], 2, &["--every-period", "--crossing"]),
        (
            &["section", spec, "--until", "1", "--crossing", "y"],
            2,
            &["--crossing", "y"],
        ),
        (
            &["section", spec, "--until", "1", "--crossing", "5"],
            2,
            &["--crossing 5", "never crosses 0"],
        ),
        (
            &["section", spec, "--until", "1", "--crossing", "k=3"],
            2,
            &["--crossing", "never crosses 0"],
        ),
        (
            &["section", spec, "--until", "1", "--every-period", "x"],
            2,
            &["--every-period"],
        ),
        (
            &["section", spec, "--until", "1", "--every-period", "1e-9"],
            2,
            &["--every-period", "instants"],
        ),
        (
            &["section", data, "--every-period", "1e-300"],
            2,
            &["--every-period", "instants"],
        ),
        (
            &["spectrum", spec, "--until", "1", "--every", "1e-9"],
            2,
            &["--every", "instants"],
        ),
        // As many instants as are allowed, with the rates and angles of 24 links at each.
        (
            &[
                "spectrum",
                "machines/chain.machine",
                "--const",
                "N=24",
                "--until",
                "1",
                "--every",
                "2.1e-7",
            ],
            2,
            &["--every", "numbers"],
        ),
        (
            &[
                "sensitivities",
                spec,
                "--until",
                "1",
                "--by",
                "k",
                "--every",
                "1e-9",
            ],
            2,
            &["--every", "instants"],
        ),
        (
            &["section", data, "--every-period", "1", "--direction", "up"],
            2,
            &["--every-period", "--direction"],
        ),
        (
            &["sensitivities", spec, "--until", "1", "--by", "k,k"],
            2,
            &["--by names `k` more than once"],
        ),
        (
            &[
                "sensitivities",
                spec,
                "--until",
                "1",
                "--by",
                "k",
                "--of",
                "x,der(x),x",
            ],
            2,
            &["--of names `x` more than once"],
        ),
        (
            &["sensitivities", spec, "--until", "1", "--by", "m"],
            2,
            &["--by m", "start(x)"],
        ),
        (
            &["sensitivities", twice.path(), "--until", "1", "--by", "l"],
            1,
            &["constraint `again`", "leave it out"],
        ),
        (
            &[
                "sensitivities",
                "machines/stick_slip.machine",
                "--until",
                "1",
                "--by",
                "m",
            ],
            1,
            &["sliding"],
        ),
    ] {
        let (found, said) = refused(arguments);
        assert_eq!(found, status, "{arguments:?}: {said}");
        for word in words {
            assert!(said.contains(word), "{arguments:?}: {said}");
        }
    }
}

/// A sine of which the samples about its maximum are missing: neither the maximum nor the crossings there can be found, which is said.
#[test]
fn what_gaps_of_a_table_hide_is_told() {
    let mut text = "t,x,y\n".to_owned();
    for k in 0..=24 {
        let t = f64::from(k) / 4.0;
        // y has not been measured before the first second.
        let x = if (4..=8).contains(&k) {
            String::new()
        } else {
            t.sin().to_string()
        };
        let y = if k < 4 {
            "nan".to_owned()
        } else {
            t.cos().to_string()
        };
        let _ = writeln!(text, "{t},{x},{y}");
    }
    let table = Scratch::new("gaps.csv", &text);
    let peaks = ["peaks", table.path()];
    let section = ["section", table.path(), "--crossing", "x=0.9"];
    for call in [&peaks[..], &section[..]] {
        let output = lagrangian(call);
        let said = String::from_utf8(output.stderr).expect("text");
        assert!(output.status.success(), "{said}");
        assert!(
            said.contains("`x` has no value at 5 instants between others"),
            "{said}"
        );
        assert!(!said.contains("`y` has no value"), "{said}");
    }
}

/// In short steps round-off in the constraints, divided by the length of the step, is the greatest change of the rates at the stages: steps of
/// Gauss methods must not wait for smaller ones. The bounds are 100 times `(ω h)^p` with ω = 10 rad/s, or round-off of 250 steps.
#[test]
fn short_steps_of_gauss_methods_are_solved_with_constraints() {
    let spec = Scratch::new(
        "four_bar.machine",
        "machine FourBar in plane {
            coordinates {
                crank: rad = 1.3683266141045787, coupler: rad = 0.18755703835531493, rocker: rad = -1.2625303635637894,
                der(crank): rad/s = -0.6425629613598558, der(coupler): rad/s = 0.1617152327823428, der(rocker): rad/s = -0.41102161738496235,
            }
            frames {
                one = ground.turn(crank),
                two = one.shift(0.71875, 0).turn(coupler - crank),
                three = two.shift(1.40625, 0).turn(rocker - coupler),
                tip = three.shift(1.046875, 0),
            }
            bodies {
                a { mass: 1.5, inertia: 0.625, frame: one, at: one.point(0.609375, -0.03125) },
                b { mass: 1.5, inertia: 0.453125, frame: two, at: two.point(0.4375, -0.25) },
                c { mass: 1.5, frame: three, at: three.point(0.640625, 0.0625) },
            }
            gravity (-2.46875, -3.4375);
            define { gap = tip.origin - (1.84375, -0.03125) }
            constraints { across: dot(gap, (1, 0)) = 0, up: dot(gap, (0, 1)) = 0 }
        }",
    );
    let at_end = |settings: &[&str]| {
        let call = ["simulate", spec.path(), "--until", "0.25"];
        let run = answer(&[&call, settings].concat());
        let of = |kind: &str| ["crank", "coupler", "rocker"].map(|name| number(&run[kind][name]));
        [of("q"), of("v")].concat()
    };
    let exact = at_end(&["--tolerance", "1e-13"]);
    for (method, bound) in [("gauss4", 1e-6), ("gauss6", 1e-10), ("gauss8", 1e-12)] {
        let found = at_end(&["--method", method, "--longest-step", "0.001"]);
        for (found, exact) in found.iter().zip(&exact) {
            let error = (found - exact).abs();
            assert!(error < bound, "{method}: {error:e}");
        }
    }
}
