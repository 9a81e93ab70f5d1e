//! Frames that are rotated by four numbers (quaternions), against the same machines with angles, against closed forms, and with uses that
//! must be refused.

use std::collections::HashMap;

use serde_json::Value;

use crate::support::{Scratch, lagrangian, number, root};

/// A body with three different moments of inertia, spinning about the middle axis: the machine `asymmetric_top` with a quaternion, with the
/// same start and outputs. At the start yaw and pitch are 0, and the quaternion has the norm `long`.
fn free_top(long: f64) -> String {
    let (sin, cos) = 0.005_f64.sin_cos();
    // The initial rates: half the product of the quaternion with the angular velocity along the body's axes.
    let [y, z] = [10.0 * 0.01_f64.sin(), 10.0 * 0.01_f64.cos()];
    let rates = [cos * y - sin * z, cos * z + sin * y].map(|rate| rate * long / 2.0);
    format!(
        "machine Tumbling in space {{
            parameters {{ m: kg = 2, A: kg*m^2 = 0.02, B: kg*m^2 = 0.04, C: kg*m^2 = 0.03 }}
            coordinates {{
                e[0]: 1 = {}, e[1]: 1 = {}, e[2..3]: 1,
                der(e[2]): 1/s = {}, der(e[3]): 1/s = {},
            }}
            frames {{ body = ground.turn(e[0], e[1], e[2], e[3]) }}
            bodies {{ body {{ mass: m, inertia: (A, B, C), frame: body }} }}
            define {{
                wx = dot(body.spin, body.vector(1, 0, 0)),
                wy = dot(body.spin, body.vector(0, 1, 0)),
                wz = dot(body.spin, body.vector(0, 0, 1)),
                momentum = body.vector(A*wx, B*wy, C*wz),
            }}
            outputs {{
                momentum_x: J*s = dot(momentum, (1, 0, 0)),
                momentum_y: J*s = dot(momentum, (0, 1, 0)),
                momentum_z: J*s = dot(momentum, (0, 0, 1)),
                upright: 1 = dot(body.vector(0, 0, 1), (0, 0, 1)),
                square: 1 = e[0]^2 + e[1]^2 + e[2]^2 + e[3]^2,
            }}
        }}",
        long * cos,
        long * sin,
        rates[0],
        rates[1],
    )
}

/// A run, and its table: rows by the names of their columns.
fn simulate(spec: &str, options: &[&str]) -> (Value, Vec<HashMap<String, f64>>) {
    let table = Scratch::new("run.csv", "");
    let output = lagrangian(
        &[
            &["simulate", spec, "--json", "--out", table.path()],
            options,
        ]
        .concat(),
    );
    let errors = String::from_utf8_lossy(&output.stderr);
    let run: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{errors}"));
    assert_eq!(run["error"], Value::Null, "{run:#}{errors}");
    let text = std::fs::read_to_string(&table.0).expect("a table");
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let name = |word: &str| word.split(" [").next().unwrap_or(word).to_owned();
    let names: Vec<String> = lines.next().expect("names").split(',').map(name).collect();
    let rows = lines.map(|line| {
        let numbers = line.split(',').map(|x| x.parse::<f64>().expect("a number"));
        names.iter().cloned().zip(numbers).collect()
    });
    (run, rows.collect())
}

#[track_caller]
fn close(found: f64, exact: f64, most: f64) {
    let off = (found - exact).abs();
    assert!(off <= most, "{found} and not {exact}: {off:e}");
}

/// Two descriptions of the same motion. The one by angles is compared with Jacobi's functions elsewhere. A wobble grows by about exp(5 t)
/// until the top stands on its head, at 1.3 s: the error of a step of 1e-13 is below 1e-9 then.
#[test]
fn a_free_top_tumbles_as_by_angles() {
    let call = ["--until", "2", "--tolerance", "1e-13"];
    let (_, by_angles) = simulate("machines/asymmetric_top.machine", &call);
    let exact = by_angles.last().expect("rows");
    for long in [1.0, 0.3, 3.0] {
        let spec = Scratch::new("tumbling.machine", &free_top(long));
        let (run, rows) = simulate(spec.path(), &call);
        let end = rows.last().expect("rows");
        for name in ["momentum_x", "momentum_y", "momentum_z", "upright"] {
            close(end[name], exact[name], 1e-9);
        }
        assert!(number(&run["energy_residual"]).abs() < 1e-11, "{run:#}");
    }
}

/// The norm of the quaternion returns to 1 from any start, and stays there over a million radians, in steps whose error is at most a
/// thousandth of its square; the motion is not affected.
#[test]
fn the_length_of_four_numbers_stays_what_it_is() {
    for tolerance in ["1e-6", "1e-9"] {
        let spec = Scratch::new("tumbling.machine", &free_top(1.0));
        let call = ["--until", "1e4", "--every", "100", "--tolerance", tolerance];
        let (_, rows) = simulate(spec.path(), &call);
        assert!(rows.len() > 99);
        for row in &rows {
            close(row["square"], 1.0, 1e-3);
        }
    }
    let spec = Scratch::new("tumbling.machine", &free_top(2.0));
    let (_, rows) = simulate(spec.path(), &["--until", "30", "--every", "1"]);
    close(rows[0]["square"], 4.0, 1e-12);
    close(rows.last().expect("rows")["square"], 1.0, 1e-6);
}

/// The angular momenta about the top's own axis and about the vertical are both `p = C w`, so the energy determines where a top that starts
/// upright turns back: at the u = cos θ below 1 with `p²/(2 A) (1 − u)/(1 + u) = A push²/2 + m g l (1 − u)`, A about the fixed point. (F.
/// Klein, A. Sommerfeld, *Über die Theorie des Kreisels*, 1897, chapter IV.)
#[test]
fn a_top_passes_through_the_upright_again_and_again() {
    let (m, l, g, c) = (0.2, 0.05, 9.81, 2e-4);
    let a = 1.5e-4 + m * l * l;
    for (spin, push) in [(60.0, 1.0), (60.0, 0.01), (100.0, 2.0), (0.0, 1.0)] {
        let set = [format!("spin={spin:?}"), format!("push={push:?}")];
        let call = ["--set", &set[0], "--set", &set[1], "--until", "6"];
        let exactly = ["--every", "0.001", "--tolerance", "1e-12"];
        let (run, rows) = simulate(
            "machines/upright_top.machine",
            &[&call[..], &exactly].concat(),
        );
        assert!(number(&run["energy_residual"]).abs() < 1e-10, "{run:#}");
        let p = c * spin;
        for row in &rows {
            close(row["vertical_momentum"], p, 1e-12);
            close(row["axial_momentum"], p, 1e-12);
        }
        // With x = 1 − u: (p²/(2 A)) x = (E + m g l x)(2 − x).
        let (k, e, w) = (p * p / (2.0 * a), a * push * push / 2.0, m * g * l);
        let half = (2.0 * w - e - k) / (2.0 * w);
        let lean = half + (half * half + 2.0 * e / w).sqrt();
        let lowest = rows.iter().map(|row| row["upright"]).fold(1.0, f64::min);
        let turned = spin == 0.0;
        // Between two rows it may lean further by less than half its greatest acceleration times the square of half a
        // row's interval, 1e-3·200.
        close(lowest, if turned { -1.0 } else { 1.0 - lean }, 1e-4);
        let passes = rows.windows(3).filter(|three| {
            let [before, here, after] = [0, 1, 2].map(|k| three[k]["upright"]);
            before < here && here >= after && here > 0.99
        });
        assert!(turned || passes.count() > 1, "{spin} {push}");
    }
}

/// A library machine with some words replaced, each of which must occur.
fn rewritten(machine: &str, words: &[(&str, &str)]) -> Scratch {
    let path = root().join("machines").join(machine);
    let mut text = std::fs::read_to_string(&path).expect("a machine");
    for (from, to) in words {
        assert!(text.contains(from), "{machine} has no {from}");
        text = text.replace(from, to);
    }
    Scratch::new("rewritten.machine", &text)
}

/// Friction acts against the velocity of the point of contact, which depends on the rotation: a struck ball described by a quaternion
/// sticks at the same time and place as one by three angles, with the same velocity.
#[test]
fn a_cue_ball_slips_and_rolls_as_by_angles() {
    let spec = rewritten(
        "contacts/cue_ball.machine",
        &[
            ("a: rad, b: rad, c: rad,", "q[0]: 1 = 1, q[1..3]: 1,"),
            (
                "der(a): rad/s = wx, der(b): rad/s = wy, der(c): rad/s = wz,",
                "der(q[1]): 1/s = wx/2, der(q[2]): 1/s = wy/2, der(q[3]): 1/s = wz/2,",
            ),
            (
                ".turn(x, a).turn(y, b).turn(z, c)",
                ".turn(q[0], q[1], q[2], q[3])",
            ),
        ],
    );
    let call = ["--until", "0.8", "--tolerance", "1e-12"];
    let (by_angles, _) = simulate("machines/contacts/cue_ball.machine", &call);
    let (run, _) = simulate(spec.path(), &call);
    let sticks = |run: &Value| {
        let all = run["contact_events"].as_array().expect("events").clone();
        let mut all = all.into_iter().filter(|event| event["kind"] == "sticks");
        all.next().expect("it rolls in the end")
    };
    let (found, exact) = (sticks(&run), sticks(&by_angles));
    close(number(&found["t"]), number(&exact["t"]), 1e-10);
    for name in ["x", "y", "z"] {
        close(number(&found["q"][name]), number(&exact["q"][name]), 1e-10);
        close(
            number(&run["v"][name]),
            number(&by_angles["v"][name]),
            1e-10,
        );
    }
    close(
        number(&run["dissipated"]),
        number(&by_angles["dissipated"]),
        1e-10,
    );
}

/// The centre of a ball that rolls on a turntable moves on a circle at 2/7 of its rate, whatever the ball's own rotation (E. J. Routh,
/// *Advanced Rigid Dynamics*, 1905, ch. V): with constraints on the velocity of the point of contact.
#[test]
fn a_ball_rolls_round_on_a_turntable() {
    let spec = Scratch::new(
        "turntable.machine",
        "machine Turntable in space {
            parameters { m: kg = 0.2, r: m = 0.03, J: kg*m^2 = 0.000072, Omega: rad/s = 3, g: m/s^2 = 9.81 }
            coordinates { x: m = 0.2, y: m, e[0]: 1 = 0.8, e[1]: 1 = 0.6, e[2..3]: 1, der(y): m/s = 0.3, der(e[1]): 1/s = -5 }
            frames {
                table = ground.turn(z, Omega*t),
                ball = ground.shift(x, y, r).turn(e[0], e[1], e[2], e[3]),
            }
            bodies { ball { mass: m, inertia: (J, J, J), frame: ball } }
            gravity (0, 0, -g);
            wheels { ball { wheel: ball, radius: r, on: table } }
        }",
    );
    let (_, rows) = simulate(
        spec.path(),
        &["--until", "8", "--every", "0.1", "--tolerance", "1e-12"],
    );
    let [x, y] = ["der(x)", "der(y)"];
    let first = [rows[0][x], rows[0][y]];
    for row in &rows {
        let (sin, cos) = (2.0 / 7.0 * 3.0 * row["t"]).sin_cos();
        close(row[x], cos * first[0] - sin * first[1], 1e-9);
        close(row[y], sin * first[0] + cos * first[1], 1e-9);
    }
    // The centre moves in two directions and the ball turns in three, of which rolling ties two.
    let output = lagrangian(&["derive", spec.path()]);
    let chapter = String::from_utf8_lossy(&output.stdout);
    let said = "It has six generalized coordinates and two constraints: three degrees of freedom.";
    assert!(chapter.contains(said), "{chapter}");
}

/// A top that hangs at rest swings at √(m g l/A) in both directions and rotates freely about its axis; the norm of the quaternion is not
/// among its modes.
#[test]
fn a_hanging_top_has_the_frequencies_of_a_spherical_pendulum() {
    let spec = rewritten(
        "upright_top.machine",
        &[("top.point(0, 0, l)", "top.point(0, 0, -l)")],
    );
    let still = ["--set", "spin=0", "--set", "push=0"];
    let exact = (0.2_f64 * 9.81 * 0.05 / (1.5e-4 + 0.2 * 0.05 * 0.05)).sqrt();
    let output = lagrangian(&[&["modes", spec.path(), "--json"], &still[..]].concat());
    let errors = String::from_utf8_lossy(&output.stderr);
    let found: Value =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{errors}"));
    let modes = found["modes"].as_array().expect("modes");
    let moving: Vec<f64> = modes
        .iter()
        .map(|mode| number(&mode["im"]).abs())
        .filter(|im| *im > 0.0)
        .collect();
    assert!(moving.len() == 2 || moving.len() == 4, "{found:#}");
    for im in &moving {
        close(*im, exact, 1e-11);
    }
    for mode in modes {
        close(number(&mode["re"]), 0.0, 1e-11);
    }
    // Three degrees of freedom have six states.
    let output = lagrangian(&[&["linearize", spec.path(), "--json"], &still[..]].concat());
    let errors = String::from_utf8_lossy(&output.stderr);
    let model: Value =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{errors}"));
    assert_eq!(
        model["states"].as_array().map(Vec::len),
        Some(6),
        "{model:#}"
    );
}

/// A geometry, load or constraint that depends on the norm of the quaternion is refused at its place in the spec, and so are
/// other invalid uses.
#[test]
fn what_depends_on_the_length_is_refused() {
    let machine = |more: &str| {
        format!(
            "machine Thrown in space {{
                parameters {{ k: N*m = 1, l: m = 1 }}
                coordinates {{ e[0]: 1 = 1, e[1..3]: 1, x: m }}
                frames {{ body = ground.shift(x, 0, 0).turn(e[0], e[1], e[2], e[3]) }}
                bodies {{ body {{ mass: 1, inertia: (1, 2, 3), frame: body, at: body.point(0.1, 0, 0) }} }}
                {more}
            }}"
        )
    };
    for (more, code, at) in [
        ("potentials { a: k*e[1]^2 }", "forbidden-dependence", "a: k"),
        (
            "springs { a { stiffness: 1*N/m, stretch: l*e[1] } }",
            "forbidden-dependence",
            "a {",
        ),
        (
            "forces { a { on: e[1], value: k } }",
            "forbidden-dependence",
            "a {",
        ),
        (
            "constraints { a: e[0]*e[1] = 0 }",
            "forbidden-dependence",
            "a: e",
        ),
        (
            "constraints { a: e[0]*der(e[0]) = 0 }",
            "forbidden-dependence",
            "a: e",
        ),
        (
            "dissipations { a: k*der(e[2])^2*l/(1*m)*(1*s) }",
            "forbidden-dependence",
            "a: k",
        ),
        (
            "bodies { other { mass: 1, at: (l*e[2], 0, 0) } }",
            "forbidden-dependence",
            "(l*e",
        ),
        (
            "frames { other = body.shift(l*e[2], 0, 0) } bodies { other { mass: 1, at: other.origin } }",
            "forbidden-dependence",
            "other =",
        ),
        (
            "frames { other = ground.turn(e[1], e[0], e[2], e[3]) } bodies { other { mass: 1, inertia: (1, 1, 1), frame: other } }",
            "wrong-arguments",
            "turn(e[1]",
        ),
        (
            "frames { other = ground.turn(1, e[0], e[2], e[3]) } bodies { other { mass: 1, inertia: (1, 1, 1), frame: other } }",
            "wrong-arguments",
            "1, e[0]",
        ),
        (
            "approximations { e[1]: small }",
            "not-supported",
            "approximations",
        ),
    ] {
        let text = machine(more);
        let spec = Scratch::new("thrown.machine", &text);
        let output = lagrangian(&["check", spec.path(), "--json"]);
        let said: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert!(!output.status.success(), "{more}");
        let all = said["diagnostics"].as_array().expect("a list").iter();
        let mut told = all.filter(|one| one["code"] != "unused");
        let first = told.next().expect("a mistake");
        assert_eq!(first["code"], code, "{more}: {said:#}");
        assert!(told.next().is_none(), "{more}: {said:#}");
        let line = text
            .lines()
            .nth(number(&first["line"]) as usize - 1)
            .expect("a line");
        let column = number(&first["column"]) as usize - 1;
        let place: String = line.chars().skip(column).collect();
        assert!(place.starts_with(at), "{more}: {place}");
    }
    // The same quantities expressed by the frame are accepted, and so are those that do not depend on the norm.
    for more in [
        "potentials { a: k*dot(body.vector(0, 0, 1), (0, 0, 1)) }",
        "torsion_springs { a { stiffness: k, twist: 2*atan2(e[1], e[0]) } }",
        "torques { a { on: body, torque: -k*body.vector(e[1], e[2], e[3]) } }",
        "constraints { a: dot(body.vector(0, 0, 1), (1, 0, 0)) = 0 }",
    ] {
        let spec = Scratch::new("thrown.machine", &machine(more));
        let output = lagrangian(&["check", spec.path()]);
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{more}: {said}");
    }
    let refused = |call: &[&str], words: &str| {
        let output = lagrangian(call);
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(!output.status.success() && said.contains(words), "{said}");
    };
    let top = "machines/upright_top.machine";
    refused(
        &["brachistochrone", top, "--to", "e[0]=0,e[1]=1"],
        "turn it by angles",
    );
    refused(
        &["simulate", top, "--until", "1", "--start", "e[0]=0"],
        "e[",
    );
}
