//! Dependent constraints with coordinates without inertia: the angle of a pendulum that is given as a particle.
//!
//! Whatever the order of the constraints and the start, the particle moves as the pendulum in one coordinate does, with the
//! constraint forces of Newton's equations.

use std::time::{SystemTime, UNIX_EPOCH};

use crate::support::{Scratch, lagrangian, number};
use serde_json::Value;

const G: f64 = 9.81;
const LENGTH: f64 = 0.8;
const MASS: f64 = 2.0;
const UNTIL: f64 = 2.0;

/// The random number generator SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn uniform(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

fn json(arguments: &[&str], what: &str) -> Value {
    let output = lagrangian(arguments);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, said) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{what}: {said}{out}");
    serde_json::from_str(&out).unwrap_or_else(|_| panic!("{what}: {out}{said}"))
}

/// Starts for a sweep, as a list.
fn listed(name: &str, values: impl Iterator<Item = f64>) -> String {
    let values: Vec<String> = values.map(|value| format!("{value:?}")).collect();
    format!("{name}={}", values.join(","))
}

/// The angles at the end of runs from these starts.
fn angles(spec: &Scratch, starts: &[(f64, f64)], tolerance: &str, what: &str) -> Vec<f64> {
    let rows = spec.0.with_file_name("rows.csv");
    let until = UNTIL.to_string();
    let angles = listed("a0", starts.iter().map(|start| start.0));
    let rates = listed("w", starts.iter().map(|start| start.1));
    let output = lagrangian(&[
        "sweep",
        spec.path(),
        "--until",
        &until,
        "--tolerance",
        tolerance,
        "--vary",
        &angles,
        "--vary",
        &rates,
        "--together",
        "a0,w",
        "--fresh",
        "--out",
        rows.to_str().expect("text"),
    ]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{what}: {said}");
    let table = std::fs::read_to_string(rows).expect("a table");
    let mut lines = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().expect("a head");
    let column = head
        .iter()
        .position(|name| *name == "a")
        .expect("the angle");
    lines
        .map(|line| {
            assert!(line.contains(&"ended"), "{what}, {tolerance}: {line:?}");
            line[column].parse().expect("a number")
        })
        .collect()
}

#[test]
fn rows_that_depend_on_each_other_hold_what_has_no_inertia() {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let clock = now.expect("a time after 1970").as_nanos() as u64;
    let seed = std::env::var("SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    let seed: u64 = seed.unwrap_or(clock);
    println!("SEED={seed}");
    let mut random = Random(seed);
    // Includes hanging, horizontal and upright poses, where some rows coincide or vanish.
    let poses = [0.0, std::f64::consts::FRAC_PI_2, std::f64::consts::PI];
    let poses = poses
        .into_iter()
        .chain((0..5).map(|_| random.uniform(-3.0, 3.0)));
    let poses: Vec<f64> = poses.collect();
    let mut starts: Vec<(f64, f64)> = Vec::new();
    for angle in poses {
        starts.push((angle, random.uniform(-4.0, 4.0)));
    }
    starts[3].1 = 0.0;
    let parameters = format!(
        "l: m = {LENGTH:?}, m: kg = {MASS:?}, g: m/s^2 = {G:?}, a0: rad = 0.3, w: rad/s = 0"
    );
    let pendulum = format!(
        "machine Pendulum in plane {{ parameters {{ {parameters} }} coordinates {{ a: rad = a0, der(a): rad/s = w }}
            bodies {{ bob {{ mass: m, at: l*(sin(a), -cos(a)) }} }} gravity (0, -g); }}"
    );
    let pendulum = Scratch::new("pendulum.machine", &pendulum);
    let known = angles(&pendulum, &starts, "1e-13", "a pendulum");

    for _ in 0..2 {
        let mut rows = vec![
            "right: x = l*sin(a)".to_owned(),
            "up: y = -l*cos(a)".to_owned(),
        ];
        let factor = random.uniform(0.1, 10.0);
        let more = [
            "rod: x^2 + y^2 = l^2".to_owned(),
            format!("again: {factor:?}*(x^2 + y^2)/l = {factor:?}*l"),
            "across: x*cos(a) + y*sin(a) = 0".to_owned(),
            "along: x*sin(a) - y*cos(a) = l".to_owned(),
        ];
        let chosen = random.next() % 15 + 1;
        let more = more.into_iter().enumerate();
        rows.extend(
            more.filter(|(k, _)| chosen >> k & 1 == 1)
                .map(|(_, row)| row),
        );
        for i in (1..rows.len()).rev() {
            rows.swap(i, (random.next() % (i as u64 + 1)) as usize);
        }
        let spec = format!(
            "machine Particle in plane {{
                parameters {{ {parameters} }}
                coordinates {{
                    x: m = l*sin(a0), y: m = -l*cos(a0), a: rad = a0,
                    der(x): m/s = w*l*cos(a0), der(y): m/s = w*l*sin(a0), der(a): rad/s = w,
                }}
                bodies {{ bob {{ mass: m, at: (x, y) }} }}
                gravity (0, -g);
                constraints {{ {} }}
            }}",
            rows.join(", ")
        );
        let what = format!("seed {seed}, {starts:?}, {rows:?}");
        let spec = Scratch::new("particle.machine", &spec);

        let point = |&(angle, rate): &(f64, f64)| {
            let (sin, cos) = angle.sin_cos();
            let q = [LENGTH * sin, -LENGTH * cos, angle];
            let v = [rate * LENGTH * cos, rate * LENGTH * sin, rate];
            serde_json::json!({ "q": q, "v": v })
        };
        let points = Value::Array(starts.iter().map(point).collect());
        let points = Scratch::new("points.json", &points.to_string());
        let there = json(&["evaluate", spec.path(), "--at", points.path()], &what);
        for (k, (angle, rate)) in starts.iter().enumerate() {
            // a'' = -(g/l) sin a; the total constraint force is m times the acceleration minus the weight, and zero
            // on the angle.
            let (sin, cos) = angle.sin_cos();
            let turn = -G / LENGTH * sin;
            let accelerations = [
                LENGTH * (turn * cos - rate * rate * sin),
                LENGTH * (turn * sin + rate * rate * cos),
                turn,
            ];
            let pushes = [MASS * accelerations[0], MASS * (accelerations[1] + G), 0.0];
            // Their terms are up to 20 m/s² and 60 N, times the largest factor, with a rounding of 1e-13; in a basis of rows
            // that differ by a tenth the error is ten times that, and for the reactions the square.
            for (name, known, bound) in [
                ("accelerations", accelerations, 1e-12),
                ("reactions", pushes, 1e-11),
            ] {
                for (j, known) in known.iter().enumerate() {
                    let found = number(&there[k][name][j]);
                    assert!(
                        (found - known).abs() <= bound,
                        "{what}, {angle}: {name} {found} {known}"
                    );
                }
            }
        }
        for tolerance in [1e-5, 1e-13] {
            let found = angles(&spec, &starts, &format!("{tolerance:e}"), &what);
            for (found, known) in found.iter().zip(&known) {
                // About twenty steps, each with an error of the tolerance; neighbouring motions separate by at
                // most exp(t √(g/l)).
                let bound = 20.0 * (UNTIL * (G / LENGTH).sqrt()).exp() * tolerance + 1e-10;
                let error = (found - known).abs();
                assert!(error <= bound, "{what}, {tolerance:e}: {error:e}");
            }
        }
        let until = UNTIL.to_string();
        let call = [
            "simulate",
            spec.path(),
            "--until",
            &until,
            "--set",
            "w=3",
            "--json",
        ];
        let residual = number(&json(&call, &what)["constraint_residual"]);
        assert!(residual <= 1e-13, "{what}: {residual:e}");
    }
}
