//! Runs of machines with a second chart, against closed forms and the same machines written in Cartesian coordinates.

use std::f64::consts::{PI, TAU};
use std::fs;

use crate::support::{Scratch, json, lagrangian, number};
use serde_json::Value;

/// A particle of 2 kg on springs of 8 N/m and 18 N/m: x = cos 2t, and y is a multiple of sin 3t.
const PARTICLE: &str = "machine Particle in plane {
    parameters { m: kg = 2, kx: N/m = 8, ky: N/m = 18 }
    coordinates { s: m = 1, phi: rad, der(phi): rad/s = 3e-9 }
    bodies { particle { mass: m, at: polar(s, phi) } }
    gravity none;
    springs { along { stiffness: kx, stretch: s*cos(phi) }, across { stiffness: ky, stretch: s*sin(phi) } }
    charts { particle: polar(s, phi) | cartesian(x, y) }
    outputs { height: m = s*sin(phi), momentum: kg*m^2/s = m*s^2*der(phi) }
}";

fn particle() -> Scratch {
    Scratch::new("particle.machine", PARTICLE)
}

fn close(found: f64, expected: f64, by: f64, what: &str) {
    if found.is_nan() && expected.is_nan() {
        return;
    }
    let size = expected.abs().max(1.0);
    assert!(
        (found - expected).abs() <= by * size,
        "{what}: {found} and not {expected}"
    );
}

/// The columns of a table by name, without units.
fn columns(path: &str) -> Vec<(String, Vec<f64>)> {
    let text = fs::read_to_string(path).expect("a table");
    let mut lines = text.lines();
    let headers = lines.next().expect("headers").split(',');
    let mut columns: Vec<(String, Vec<f64>)> = headers
        .map(|header| {
            let name = header.split(" [").next().unwrap_or(header);
            (name.trim_matches('"').to_owned(), Vec::new())
        })
        .collect();
    for line in lines {
        for ((_, values), cell) in columns.iter_mut().zip(line.split(',')) {
            values.push(cell.parse().unwrap_or(f64::NAN));
        }
    }
    columns
}

fn column<'c>(columns: &'c [(String, Vec<f64>)], name: &str) -> &'c [f64] {
    let found = columns.iter().find(|(of, _)| of == name);
    &found.unwrap_or_else(|| panic!("no column {name}")).1
}

/// The closed form of the particle, for `y = width sin 3t`: distance, angle with its turns, and their rates.
fn closed_form(width: f64, t: f64) -> [f64; 4] {
    let (x, y) = ((2.0 * t).cos(), width * (3.0 * t).sin());
    let (vx, vy) = (-2.0 * (2.0 * t).sin(), 3.0 * width * (3.0 * t).cos());
    // The path crosses x = 0 at odd multiples of π/4, on the side of the sign of y there. From one crossing to the next the angle
    // is that of the direction, on the branch that is reached by going over that side.
    let mut turned = 0.0;
    for k in 0.. {
        let crossing = PI / 4.0 * f64::from(2 * k + 1);
        if crossing > t {
            break;
        }
        let is_above = width * (3.0 * crossing).sin() > 0.0;
        let goes_left = k % 2 == 0;
        turned += if is_above == goes_left { PI } else { -PI };
    }
    // The direction is within a quarter turn of ±x on either side of a crossing.
    let sign = x.signum();
    let angle = turned + (sign * y).atan2(sign * x);
    let s = x.hypot(y);
    [s, angle, (x * vx + y * vy) / s, (x * vy - y * vx) / (s * s)]
}

#[test]
fn a_particle_passes_the_centre_in_closed_form() {
    let (spec, table) = (particle(), Scratch::new("run.csv", ""));
    let (spec, table) = (spec.path(), table.path());
    for width in [1e-9, 1e-4, 0.5] {
        let rate = format!("phi={:e}", 3.0 * width);
        let run = json(&[
            "simulate",
            spec,
            "--until",
            "7",
            "--every",
            "0.013",
            "--tolerance",
            "1e-13",
            "--rate",
            &rate,
            "--out",
            table,
            "--json",
        ]);
        // Two oscillators, with as many steps however near they pass.
        assert!(number(&run["steps"]) < 300.0, "{}", run["steps"]);
        let columns = columns(table);
        let of = |name| column(&columns, name);
        assert_eq!(of("s")[0], 1.0);
        for (row, t) in of("t").iter().enumerate() {
            let [s, angle, rate, turning] = closed_form(width, *t);
            // Errors of 1e-12 in the components, which an angle sees from its distance.
            let what = format!("width {width}, t = {t}");
            close(of("s")[row], s, 1e-11, &what);
            close(of("phi")[row], angle, 1e-11 / s, &what);
            close(of("der(s)")[row], rate, 1e-10 / s, &what);
            close(of("der(phi)")[row], turning, 1e-10 / (s * s), &what);
            close(of("height")[row], width * (3.0 * t).sin(), 1e-11, &what);
        }
        let [s, angle, ..] = closed_form(width, 7.0);
        close(number(&run["q"]["s"]), s, 1e-11, "at the end");
        close(number(&run["q"]["phi"]), angle, 1e-11 / s, "at the end");
        // ½ m (vx² + vy²) + ½ kx x² + ½ ky y² stays.
        assert!(number(&run["energy_residual"]).abs() < 1e-11);
    }
}

#[test]
fn a_particle_goes_exactly_through_the_centre_and_rests_there() {
    let spec = particle();
    let at = |until: &str, more: &[&str]| {
        let own = [
            "simulate",
            spec.path(),
            "--until",
            until,
            "--tolerance",
            "1e-13",
            "--json",
        ];
        json(&[&own[..], more].concat())
    };
    // On the line y = 0 it turns by half a turn at each passage.
    let run = at("2", &["--rate", "phi=0"]);
    close(number(&run["q"]["s"]), 4_f64.cos().abs(), 1e-11, "s");
    close(number(&run["q"]["phi"]).abs() % TAU, PI, 1e-11, "phi");
    // From the centre along φ = 0.7 rad with 1 m/s: x = cos 0.7 sin(2t)/2, y = sin 0.7 sin(3t)/3.
    let start = [
        "--start", "s=0", "--start", "phi=0.7", "--rate", "s=1", "--rate", "phi=0",
    ];
    let run = at("0.4", &start);
    let (x, y) = (
        0.7_f64.cos() * 0.8_f64.sin() / 2.0,
        0.7_f64.sin() * 1.2_f64.sin() / 3.0,
    );
    close(number(&run["q"]["s"]), x.hypot(y), 1e-11, "s");
    close(number(&run["q"]["phi"]), y.atan2(x), 1e-11, "phi");
    // At rest at the centre it stays there.
    let run = at("1", &["--start", "s=0", "--rate", "phi=0"]);
    assert_eq!(number(&run["q"]["s"]), 0.0);
    assert_eq!(number(&run["v"]["phi"]), 0.0);
}

#[test]
fn turns_are_counted_forward_and_backward_however_rarely_they_are_recorded() {
    // A particle that nothing holds but a rail around the centre turns uniformly; here, equal springs on a circle: s = 1, φ̇ = 2 rad/s.
    let (spec, table) = (particle(), Scratch::new("run.csv", ""));
    let (spec, table) = (spec.path(), table.path());
    for (until, every, method) in [
        ("100", "9", "dop853"),
        ("-100", "9", "dop853"),
        ("100", "0.37", "taylor"),
        ("20", "7", "radau5"),
    ] {
        let run = json(&[
            "simulate",
            spec,
            "--until",
            until,
            "--every",
            every,
            "--set",
            "ky=8",
            "--rate",
            "phi=2",
            "--tolerance",
            "1e-11",
            "--method",
            method,
            "--out",
            table,
            "--json",
        ]);
        let end: f64 = until.parse().expect("a number");
        close(number(&run["q"]["phi"]), 2.0 * end, 1e-6, method);
        let columns = columns(table);
        let (times, angles) = (column(&columns, "t"), column(&columns, "phi"));
        for (t, angle) in times.iter().zip(angles) {
            close(*angle, 2.0 * t, 1e-6, method);
        }
    }
}

/// The same crusher in polar coordinates with a second chart, and in relative Cartesian coordinates, from the same state: the mortar
/// crosses the axis of the cylinder, both collide and slip.
#[test]
fn a_crusher_in_two_charts_is_that_in_cartesian_coordinates() {
    let tables = ["polar.csv", "relative.csv"].map(|name| Scratch::new(name, ""));
    let run = |spec: &str, table: &str, more: &[&str]| {
        let own = [
            "simulate",
            spec,
            "--until",
            "0.1",
            "--every",
            "1e-3",
            "--tolerance",
            "1e-12",
            "--out",
            table,
            "--json",
        ];
        json(&[&own[..], more].concat())
    };
    // ξ₁ = −4 mm, towards the axis with 0.4 m/s along it.
    let polar = run(
        "machines/contacts/polar_crusher.machine",
        tables[0].path(),
        &[
            "--start", "s1=0.004", "--start", "phi1=pi", "--rate", "s1=-0.4",
        ],
    );
    let relative = run(
        "machines/contacts/relative_crusher.machine",
        tables[1].path(),
        &["--start", "xi1=-0.004", "--rate", "xi1=0.4"],
    );
    let events = |run: &Value| run["contact_events"].as_array().expect("events").clone();
    let (own, other) = (events(&polar), events(&relative));
    assert!(own.len() > 4, "{}", own.len());
    assert_eq!(own.len(), other.len());
    for (own, other) in own.iter().zip(&other) {
        assert_eq!(own["kind"], other["kind"]);
        close(number(&own["t"]), number(&other["t"]), 1e-10, "an event");
        let (own, other) = (&own["q"], &other["q"]);
        for [s, phi, xi, eta] in [["s1", "phi1", "xi1", "eta1"], ["s2", "phi2", "xi2", "eta2"]] {
            let (s, phi) = (number(&own[s]), number(&own[phi]));
            close(s * phi.cos(), number(&other[xi]), 1e-9, "at an event");
            close(s * phi.sin(), number(&other[eta]), 1e-9, "at an event");
        }
    }
    let [own, other] = tables.map(|table| columns(table.path()));
    let mut last: Option<f64> = None;
    for row in 0..column(&own, "t").len() {
        let own = |name: &str| column(&own, name)[row];
        let other = |name: &str| column(&other, name)[row];
        for [s, phi, xi, eta] in [["s1", "phi1", "xi1", "eta1"], ["s2", "phi2", "xi2", "eta2"]] {
            close(own(s) * own(phi).cos(), other(xi), 1e-9, s);
            close(own(s) * own(phi).sin(), other(eta), 1e-9, s);
            let [ds, dphi, dxi] = [s, phi, xi].map(|name| format!("der({name})"));
            let rate = own(&ds) * own(phi).cos() - own(s) * own(&dphi) * own(phi).sin();
            close(rate, other(&dxi), 1e-7, &ds);
        }
        for same in [
            "theta",
            "theta1",
            "total energy",
            "normal(outer)",
            "gap(outer)",
            "gap(inner)",
        ] {
            close(own(same), other(same), 1e-6, same);
        }
        // Its direction does not jump by a whole turn.
        let angle = own("phi1");
        assert!(
            last.is_none_or(|last: f64| (angle - last).abs() < 4.0),
            "{row}"
        );
        last = Some(angle);
    }
}

#[test]
fn sums_of_angles_loads_and_constraints_are_the_same_in_both_charts() {
    // Masses whose places contain φ + θ and 2φ + θ, a force on each polar coordinate, and a constraint.
    let polar = "machine Polar in plane {
        parameters {
            m: kg = 1.5, k: N/m = 30, b: N*s/m = 0.3, g: m/s^2 = 9.81, F: N = 0.7, w: rad/s = 3, T: N*m = 0.2,
        }
        constants { l: m = 1 }
        coordinates {
            s: m = 0.4, phi: rad = 0.3, theta: rad = 0.2, y: m = 0.2*sin(0.3),
            der(phi): rad/s = 2, der(y): m/s = 0.4*cos(0.3),
        }
        bodies {
            bob { mass: m, inertia: 0.02, at: polar(s, phi), angle: theta },
            arm { mass: m/2, at: s*direction(phi + theta) + (1, 0) },
            late { mass: m/3, at: (y, s^2*cos(2*phi + theta)/l) },
        }
        gravity (0, -g);
        springs { hanger { stiffness: k, from: bob.at, to: (0.3, 0.4) }, y { stiffness: k, stretch: y } }
        dampers { s { damping: b, stretch: s } }
        forces { radial { on: s, value: F*sin(w*t)*s/l }, turning { on: phi, value: T*s^2/l^2 } }
        constraints { tied: y = s*sin(phi)/2 }
        outputs { rate: m^2/s = s^2*der(phi), out: m/s^2 = der(der(s*cos(phi))) }
        CHARTS
    }";
    let with = "charts { bob: polar(s, phi) | cartesian(xi, eta) }";
    // Where nothing comes near the centre, the run in polar coordinates is right as well.
    let [plain, charted] = ["", with].map(|charts| {
        let spec = Scratch::new("polar.machine", &polar.replace("CHARTS", charts));
        let table = Scratch::new("run.csv", "");
        let run = json(&[
            "simulate",
            spec.path(),
            "--until",
            "0.3",
            "--every",
            "0.01",
            "--tolerance",
            "1e-12",
            "--out",
            table.path(),
            "--json",
        ]);
        assert!(number(&run["energy_residual"]).abs() < 1e-9);
        columns(table.path())
    });
    assert!(
        column(&plain, "s").iter().all(|s| *s > 0.05),
        "{:?}",
        column(&plain, "s")
    );
    for name in [
        "s",
        "phi",
        "theta",
        "y",
        "der(s)",
        "der(phi)",
        "der(theta)",
        "rate",
        "out",
        "multiplier(tied)",
        "total energy",
    ] {
        for (one, other) in column(&plain, name).iter().zip(column(&charted, name)) {
            close(*one, *other, 1e-8, name);
        }
    }
}

#[test]
fn a_negative_distance_is_refused_at_the_start() {
    // The stretch of the spring would be −1.5 m as written, and 0.5 m at the opposite point.
    let spec = Scratch::new(
        "negative.machine",
        "machine Negative in plane {
            parameters { m: kg = 2, k: N/m = 80, l: m = 0.5 }
            coordinates { s: m = 1, phi: rad = 0.3 }
            bodies { p { mass: m, at: polar(s, phi) } }
            gravity none;
            springs { radial { stiffness: k, stretch: s - l } }
            charts { p: polar(s, phi) | cartesian(x, y) }
        }",
    );
    let call = ["simulate", spec.path(), "--until", "0.1", "--json"];
    json(&call);
    let output = lagrangian(&[&call[..], &["--start", "s=-1"]].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    let words = "the distance `s` is -1.0 m at the start";
    assert!(
        said.contains(words) && said.contains("`phi` changed by pi"),
        "{said}"
    );
}

#[test]
fn what_the_other_chart_cannot_say_is_refused() {
    let spec = particle();
    let folder = spec.0.parent().expect("a folder");
    let said = |arguments: &[&str]| {
        let output = lagrangian(arguments);
        assert_ne!(output.status.code(), Some(0), "{arguments:?}");
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    let words = said(&["simulate", spec.path(), "--until", "1", "--keep", "s"]);
    assert!(
        words.contains("--keep s: the run is in the Cartesian coordinates"),
        "{words}"
    );
    for (part, words) in [
        (
            "potentials { twist: kx*l^2*phi^2/2 }",
            "`twist` contains the angle `phi`",
        ),
        (
            "outputs { turned: rad = phi }",
            "the output `turned` contains the angle `phi`",
        ),
        (
            "frames { turned = ground.turn(phi) } bodies { b { mass: m, frame: turned } }",
            "the frame `turned` contains the angle `phi`",
        ),
        (
            "constraints { half: sin(phi/2) = 0.1 }",
            "`half` contains the angle `phi`",
        ),
        ("approximations { phi: small }", "`phi` is approximated"),
        ("keep { der(s) }", "a start value of `s` is kept"),
        (
            "charts { again: polar(s, phi) | cartesian(a, b) }",
            "share a coordinate",
        ),
        ("outputs { x: m = s }", "`x` has another meaning already"),
    ] {
        let text = format!(
            "machine Refused extends \"particle.machine\" {{ constants {{ l: m = 1 }} {part} }}"
        );
        let variant = folder.join("refused.machine");
        fs::write(&variant, text).expect("a file");
        let found = said(&["check", variant.to_str().expect("text")]);
        assert!(found.contains(words), "{part}: {found}");
    }
}

#[test]
fn formulas_with_the_angle_are_refused_only_by_runs_in_the_other_chart() {
    let spec = Scratch::new(
        "driven.machine",
        "machine Driven in plane {
            parameters { m: kg = 2, k: N/m = 8 }
            coordinates { s: m = 1, phi: rad = 0.25, z: m, der(phi): rad/s = 2 }
            inputs { F: N }
            bodies { p { mass: m, at: polar(s, phi) }, q { mass: m, at: (z, 0) } }
            gravity none;
            springs { origin { stiffness: k, from: (0, 0), to: p.at } }
            forces { push { on: z, value: F } }
            charts { p: polar(s, phi) | cartesian(x, y) }
        }",
    );
    let input = ["--input", "F=4*N*phi"];
    // s = 1 m and φ = 0.25 + 2t on a circle, since k/m is the square of 2 rad/s; z̈ = 2φ.
    let table = Scratch::new("rows.csv", "");
    let swept = lagrangian(
        &[
            &[
                "sweep",
                spec.path(),
                "--until",
                "1",
                "--vary",
                "m=2",
                "--event",
                "low=phi - 1.25",
            ][..],
            &[
                "--record",
                "event=low",
                "--tolerance",
                "1e-12",
                "--fresh",
                "--out",
                table.path(),
            ],
            &input,
        ]
        .concat(),
    );
    let said = String::from_utf8_lossy(&swept.stderr).into_owned();
    assert_eq!(swept.status.code(), Some(0), "{said}");
    let row = columns(table.path());
    close(column(&row, "phi")[0], 2.25, 1e-10, "phi");
    close(column(&row, "z")[0], 0.25 + 2.0 / 3.0, 1e-10, "z");
    // Without the force on it, which is another equation: φ = 1.25 at t = 0.5 s.
    let points = Scratch::new("points.csv", "");
    let section = [
        "section",
        spec.path(),
        "--until",
        "1",
        "--tolerance",
        "1e-12",
    ];
    let crossing = ["--crossing", "phi - 1.25", "--out", points.path()];
    let output = lagrangian(&[&section[..], &crossing].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    let times = columns(points.path());
    let [time] = column(&times, "t")[..] else {
        panic!("one crossing: {times:?}")
    };
    close(time, 0.5, 1e-10, "t");
    // The run of `simulate` cannot have it.
    let call = [&["simulate", spec.path(), "--until", "1"][..], &input].concat();
    let refused = lagrangian(&call);
    let said = String::from_utf8_lossy(&refused.stderr).into_owned();
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(
        said.contains("--input F: the run is in the Cartesian coordinates"),
        "{said}"
    );
    assert!(said.contains("in `4*N*phi`"), "{said}");
}

/// A particle on equal springs, let go at rest at the angle α: it goes back and forth through the centre, `x = cos α cos 2t` and
/// `y = sin α cos 2t`, which no run in polar coordinates passes.
const THROUGH_CENTRE: [&str; 8] = [
    "--set",
    "ky=8",
    "--rate",
    "phi=0",
    "--tolerance",
    "1e-12",
    "--start",
    "phi=0.7",
];

#[test]
fn every_command_that_records_a_run_goes_through_the_centre() {
    let spec = particle();
    let call = |command: &str, more: &[&str]| {
        json(
            &[
                &[command, spec.path(), "--json"][..],
                &THROUGH_CENTRE[..],
                more,
            ]
            .concat(),
        )
    };
    let values = |found: &Value, place: usize| -> Vec<f64> {
        let values = found["quantities"][place]["values"].as_array();
        values.expect("values").iter().map(number).collect()
    };
    // At equal intervals of time the distance is |cos 2t|, and the angle α or half a turn from it.
    let period = [
        "--until",
        "6",
        "--every-period",
        "1",
        "--of",
        "s,phi,height",
    ];
    let found = call("section", &period);
    let (s, phi, height) = (values(&found, 0), values(&found, 1), values(&found, 2));
    assert_eq!(s.len(), 7);
    for (t, ((s, phi), height)) in s.iter().zip(phi).zip(height).enumerate() {
        let x = (2.0 * t as f64).cos();
        close(*s, x.abs(), 1e-10, "s");
        let turns = (phi - if x > 0.0 { 0.7 } else { 0.7 + PI }) / TAU;
        close(turns - turns.round(), 0.0, 1e-9, "phi");
        close(height, 0.7_f64.sin() * x, 1e-10, "height");
    }
    // The height falls through 0.3 m where cos 2t = 0.3/sin α.
    let crossing = [
        "--until",
        "6",
        "--crossing",
        "height=0.3",
        "--direction",
        "down",
        "--of",
        "s",
    ];
    let found = call("section", &crossing);
    let level = 0.3 / 0.7_f64.sin();
    let times: Vec<f64> = found["t"]
        .as_array()
        .expect("times")
        .iter()
        .map(number)
        .collect();
    assert_eq!(times.len(), 2, "{found}");
    for (k, t) in times.iter().enumerate() {
        close(*t, 0.5 * level.acos() + k as f64 * PI, 1e-10, "time");
    }
    close(values(&found, 0)[1], level, 1e-9, "s");
    // Past the centre at a distance of 1e-9 m: y = 1e-9 m sin 3t, for 15 periods. Both equations are linear, with the same relative errors.
    let past = [
        "--rate",
        "phi=3e-9",
        "--tolerance",
        "1e-12",
        "--of",
        "height",
    ];
    let end = format!("{}", 10.0 * PI);
    let past = |command: &str| {
        let call = [command, spec.path(), "--json", "--until", &end];
        json(&[&call[..], &past].concat())["quantities"][0].clone()
    };
    let found = past("peaks");
    close(number(&found["period"]), TAU / 3.0, 1e-6, "period");
    close(number(&found["decrement"]), 0.0, 1e-10, "decrement");
    let line = past("spectrum")["lines"][0].clone();
    close(number(&line["frequency"]), 3.0 / TAU, 1e-6, "frequency");
    close(1e9 * number(&line["amplitude"]), 1.0, 1e-5, "amplitude");
    // Against a table of the closed form.
    let mut text = String::from("t [s],s [m],height [m]\n");
    for k in 0..=60 {
        let t = 0.1 * f64::from(k);
        let x = (2.0 * t).cos();
        text.push_str(&format!("{t:e},{:e},{:e}\n", x.abs(), 0.7_f64.sin() * x));
    }
    let table = Scratch::new("closed.csv", &text);
    let found = call("compare", &[table.path()]);
    let compared = found["quantities"].as_array().expect("quantities");
    assert_eq!(compared.len(), 2, "{found}");
    for one in compared {
        assert!(number(&one["largest"]) < 1e-9, "{one}");
    }
}

#[test]
fn a_sweep_goes_through_the_centre() {
    let (spec, rows) = (particle(), Scratch::new("rows.csv", ""));
    let samples = rows.path().replace(".csv", ".samples.csv");
    let swept = lagrangian(
        &[
            &[
                "sweep",
                spec.path(),
                "--until",
                "2",
                "--fresh",
                "--out",
                rows.path(),
            ][..],
            &THROUGH_CENTRE[..6],
            &[
                "--vary",
                "start(phi)=-1,0.2,0.7,4",
                "--vary",
                "start(s)=1,2",
            ],
            &[
                "--reduce",
                "low = min(abs(height))",
                "--reduce",
                "far = max(s)",
            ],
            &["--record", "at=1", "--record", "every=0.25"],
        ]
        .concat(),
    );
    let said = String::from_utf8_lossy(&swept.stderr).into_owned();
    assert_eq!(swept.status.code(), Some(0), "{said}");
    let all = columns(rows.path());
    let of = |name| column(&all, name);
    assert_eq!(of("run").len(), 8);
    for row in 0..8 {
        let (angle, length) = (of("start(phi)")[row], of("start(s)")[row]);
        // cos 2t is negative at t = 1 and 2.
        let what = format!("from {angle} and {length}");
        for (t, s, phi) in [(1.0, "s@1", "phi@1"), (2.0, "s", "phi")] {
            let x = length * (2.0_f64 * t).cos();
            close(of(s)[row], x.abs(), 1e-10, &what);
            close((of(phi)[row] - angle).abs(), PI, 1e-9, &what);
        }
        close(of("far")[row], length, 1e-10, &what);
        close(of("low")[row], 0.0, 1e-9, &what);
    }
    let all = columns(&samples);
    let of = |name| column(&all, name);
    assert_eq!(of("run").len(), 8 * 9);
    for (row, t) in of("t").iter().enumerate() {
        let length = 1.0 + f64::from(row as u32 / 9 % 2);
        close(of("s")[row], length * (2.0 * t).cos().abs(), 1e-10, "s");
    }
    std::fs::remove_file(samples).expect("samples");
}

/// What the Cartesian chart cannot express is run in the coordinates of the spec, in which a distance may be negative.
#[test]
fn other_commands_fall_back_on_the_coordinates_of_the_spec() {
    let spec = particle();
    // From s = −1 m the spring forces are those at the opposite point, and nothing passes the centre within 0.5 s.
    let from = [
        "--until",
        "0.5",
        "--every-period",
        "0.5",
        "--of",
        "s,phi",
        "--json",
    ];
    let start = ["--start", "s=-1", "--rate", "phi=0", "--tolerance", "1e-12"];
    let found = json(&[&["section", spec.path()][..], &from, &start].concat());
    close(
        number(&found["quantities"][0]["values"][1]),
        -(1.0_f64).cos(),
        1e-10,
        "s",
    );
    let kept = ["--keep", "phi", "--rate", "phi=0"];
    let found = json(&[&["section", spec.path()][..], &from, &kept].concat());
    close(
        number(&found["quantities"][1]["values"][1]),
        0.0,
        1e-12,
        "phi",
    );
    let rows = Scratch::new("rows.csv", "");
    let swept = lagrangian(
        &[
            &[
                "sweep",
                spec.path(),
                "--until",
                "0.5",
                "--fresh",
                "--out",
                rows.path(),
            ][..],
            &[
                "--vary",
                "start(s)=-1,1",
                "--rate",
                "phi=0",
                "--tolerance",
                "1e-12",
            ],
        ]
        .concat(),
    );
    assert_eq!(swept.status.code(), Some(0));
    let all = columns(rows.path());
    close(column(&all, "s")[0], -(1.0_f64).cos(), 1e-10, "s");
    close(column(&all, "s")[1], 1.0_f64.cos(), 1e-10, "s");
}

/// The particle with `x = cos 2t` and `y = w sin 3t`: the changes of `s` and `φ` at a time with the spring along x, and with the start.
fn closed_derivatives(w: f64, t: f64) -> Vec<[f64; 2]> {
    let (x, y) = ((2.0 * t).cos(), w * (3.0 * t).sin());
    let s = x.hypot(y);
    // Of x₀, ẋ₀, y₀, ẏ₀, as the derivatives of x = s cos φ, y = s sin φ and of the rates at s = 1, φ = 0, ṡ = 0, φ̇ = 3w say; the
    // frequency along x is √(kx/m).
    let starts = [
        [1.0, 0.0, 0.0, 3.0 * w],
        [0.0, -3.0 * w, 1.0, 0.0],
        [0.0, 1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
    ];
    let of_start = starts.map(|[x0, vx0, y0, vy0]| {
        let dx = x0 * (2.0 * t).cos() + vx0 * (2.0 * t).sin() / 2.0;
        let dy = y0 * (3.0 * t).cos() + vy0 * (3.0 * t).sin() / 3.0;
        [dx, dy]
    });
    let by_stiffness = [-t * (2.0 * t).sin() / 8.0, 0.0];
    let all = [by_stiffness].into_iter().chain(of_start);
    let polar = |[dx, dy]: [f64; 2]| [(x * dx + y * dy) / s, (x * dy - y * dx) / (s * s)];
    all.map(polar).collect()
}

#[test]
fn derivatives_pass_the_centre_in_closed_form() {
    let spec = particle();
    for w in [1e-4, 0.5] {
        let rate = format!("phi={:e}", 3.0 * w);
        let run = json(&[
            "sensitivities",
            spec.path(),
            "--by",
            "kx,start(s),start(phi),rate(s),rate(phi)",
            "--of",
            "s,phi,height",
            "--until",
            "7",
            "--every",
            "0.4",
            "--tolerance",
            "1e-12",
            "--rate",
            &rate,
            "--json",
        ]);
        let values =
            |part: &str, k: usize| run[part][k]["values"].as_array().expect("a list").clone();
        let times = run["t"].as_array().expect("times");
        assert_eq!(times.len(), 19);
        for (row, t) in times.iter().enumerate() {
            let t = number(t);
            let [s, angle, ..] = closed_form(w, t);
            close(number(&values("values", 0)[row]), s, 1e-10, "s");
            close(number(&values("values", 1)[row]), angle, 1e-10 / s, "phi");
            for (k, by) in closed_derivatives(w, t).into_iter().enumerate() {
                for (of, expected) in by.into_iter().enumerate() {
                    let found = number(&values("derivatives", 5 * of + k)[row]);
                    let what = format!("w = {w}, t = {t}, {of} by {k}");
                    // Errors of 1e-11 in the components and their derivatives, as the distance magnifies them.
                    close(found, expected, 1e-9 / (s * s), &what);
                }
            }
        }
    }
}

#[test]
fn a_fit_passes_the_centre() {
    // Measured without errors: both coordinates of the particle, at instants none of which is at its centre.
    let spec = particle();
    let w = 0.01;
    let mut table = "t [s],s [m],phi [rad]\n".to_owned();
    for k in 0..60 {
        let t = 0.1 * f64::from(k);
        let [s, angle, ..] = closed_form(w, t);
        table.push_str(&format!("{t:?},{s:?},{angle:?}\n"));
    }
    let data = Scratch::new("measured.csv", &table);
    let fitted = json(&[
        "fit",
        spec.path(),
        "--data",
        data.path(),
        "--fit",
        "kx,ky,start(s),rate(phi)",
        "--set",
        "kx=7.9",
        "--set",
        "ky=18.2",
        "--start",
        "s=1.02",
        "--rate",
        "phi=0.029",
        "--sigma",
        "s=1e-3",
        "--sigma",
        "phi=1e-2",
        "--tolerance",
        "1e-12",
        "--json",
    ]);
    let all = fitted["fitted"].as_array().expect("a list");
    for (one, expected) in all.iter().zip([8.0, 18.0, 1.0, 3.0 * w]) {
        // Errors of the runs, 1e-11 of the components.
        close(number(&one["value"]), expected, 1e-8, "an estimate");
    }
    assert_eq!(fitted["derivatives"], "integrated");
}

/// Modes and linear models about the centre, where polar coordinates have none, are in the Cartesian coordinates: `x = cos 2t`, `y = sin 3t`.
#[test]
fn modes_about_the_centre_are_in_cartesian_coordinates() {
    let spec = particle();
    let note = "this is in the Cartesian coordinates that `charts` names";
    let output = lagrangian(&["modes", spec.path(), "--json"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.starts_with("note: ") && said.contains(note), "{said}");
    let found = json(&["modes", spec.path(), "--json"]);
    for (k, (name, omega)) in [("x", 2.0), ("y", 3.0)].into_iter().enumerate() {
        let mode = &found["modes"][k];
        close(number(&mode["im"]), omega, 1e-12, name);
        close(number(&mode["shape"][name][0]), 1.0, 1e-12, name);
    }
    for at in [&["--here", "--start", "s=0", "--rate", "phi=0"][..], &[]] {
        let call = [
            &["linearize", spec.path(), "--json", "--outputs", "height"][..],
            at,
        ]
        .concat();
        let found = json(&call);
        let a = &found["A"];
        for (i, j, exact) in [(2, 0, -4.0), (3, 1, -9.0), (0, 2, 1.0), (2, 1, 0.0)] {
            close(number(&a[i][j]), exact, 1e-12, "A");
        }
        close(number(&found["C"][0][1]), 1.0, 1e-12, "C");
    }
    // Away from the centre the model is that in the coordinates of the spec, and a failure there is the error.
    let found = json(&["linearize", spec.path(), "--json", "--here"]);
    assert_eq!(found["states"][0]["name"], "s");
    let output = lagrangian(&["modes", spec.path(), "--steady", "phi=1"]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && !said.contains(note), "{said}");
}

/// An orbit through the centre, `x = cos 2t`: its multipliers are 1, 1 and those of `y = sin 3t` after the time π, −1 and −1.
#[test]
fn an_orbit_passes_the_centre() {
    let spec = particle();
    let found = json(&[
        "orbit",
        spec.path(),
        "--near",
        "3.14",
        "--rate",
        "phi=0",
        "--json",
    ]);
    close(number(&found["period"]), PI, 1e-8, "period");
    // There is one for each amplitude, and the search ends near the start.
    close(number(&found["at"]["q"]["x"]), 1.0, 1e-3, "x");
    let multipliers = found["multipliers"].as_array().expect("multipliers");
    let mut real: Vec<f64> = multipliers.iter().map(|of| number(&of["re"])).collect();
    real.sort_by(f64::total_cmp);
    for (found, exact) in real.into_iter().zip([-1.0, -1.0, 1.0, 1.0]) {
        close(found, exact, 1e-6, "multiplier");
    }
}
