//! The fastest motion, through the command line.

use crate::support::{Page, Scratch, floats, lagrangian, root};
use serde_json::Value;

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
fn what_is_no_motion_of_the_machine_is_not_called_the_fastest() {
    let prisms = std::fs::read_to_string(root().join("machines/prisms.machine")).expect("a spec");
    let built_on = "wedge.shift(-q2, -q2*tan(alpha))";
    assert!(prisms.contains(built_on));
    // If bodies are placed by coordinates, it is not determined on which body a force on q2 acts, nor which reaction
    // the floor has.
    let unsaid = prisms.replace(built_on, "ground.shift(q1 - q2, -q2*tan(alpha))");
    for (spec, options, why) in [
        (&prisms, &["--to", "q1=-8"][..], "slides backwards"),
        (&unsaid, &[][..], "guide `floor` is not determined"),
    ] {
        let spec = Scratch::new("prisms.machine", spec);
        let arguments = [&["brachistochrone", spec.path()], options].concat();
        let output = lagrangian(&arguments);
        let text = String::from_utf8(output.stdout).expect("text");
        assert_eq!(output.status.code(), Some(1), "{text}");
        assert!(text.contains("no least time is claimed"), "{text}");
        assert!(!text.contains("is the least time"), "{text}");
        assert!(text.contains(why), "{text}");
        let output = lagrangian(&[&arguments[..], &["--json"]].concat());
        let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(document["is_motion"], false);
        assert_eq!(output.status.code(), Some(1));
    }
}

#[test]
fn a_bead_goes_along_a_cycloid_and_the_wire_does_no_work() {
    let found = solved(BEAD, &["--to", "x=1,y=-1"]);
    close(&found["time"], CYCLOID, 1e-13);
    close(&found["end"]["q"]["x"], 1.0, 1e-14);
    for moment in found["path"].as_array().expect("a path") {
        let number = |what: &str, name: &str| moment[what][name].as_f64().expect("a number");
        let work = |name: &str| number("control", name) * number("v", name);
        // Relative to forces of 20 N at 5 m/s.
        assert!((work("x") + work("y")).abs() < 100.0 * 64.0 * f64::EPSILON);
    }
    assert_eq!(found["warnings"], serde_json::json!([]));
}

#[test]
fn ends_may_be_normal_coordinates() {
    // Equation (24) for the mass 4 kg: the first coordinate along (1, 1)/√8, the second along (1, −1)/√8; (1, −1) is (0, √8).
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
fn outside_of_the_conditions_the_direct_method_says_which_fail() {
    // The bead in polar coordinates has the same motion.
    let polar = BEAD
        .replace("(x, y) }", "(x*cos(y), x*sin(y) - 2) }")
        .replace("x: m, y: m", "x: m = 2, y: rad = pi/2");
    let (r, angle) = (1.0_f64.hypot(1.0), (1.0_f64).atan2(1.0));
    let end = format!("x={r},y={angle}");
    let found = solved(&polar, &["--to", &end]);
    close(&found["time"], CYCLOID, 1e-12);
    assert_eq!(found["method"], "direct");
    let because = found["because"].to_string();
    assert!(
        because.contains("the mass a of `y` and `y` depends on `x`"),
        "{because}"
    );
    assert!(found["arrival"].as_f64().expect("a number") < 1e-8);
    let spring = BEAD.replace(
        "gravity",
        "springs { s { stiffness: 3, stretch: x } } gravity",
    );
    let found = solved(&spring, &["--to", "x=1,y=-1"]);
    let because = found["because"].to_string();
    assert!(
        because.contains("the force on `x` depends on `x`") && !because.contains("`y`"),
        "{because}"
    );
    // The spring slows the motion.
    assert!(found["time"].as_f64().expect("a time") > CYCLOID);
    let error = solved(&spring, &["--natural", "--to", "x=1,y=-1"])["error"].to_string();
    assert!(error.contains("there are no normal coordinates"), "{error}");
}

/// A spring on the wedge, and a floor whose roughness increases: the machine itself, simulated with its own law of friction
/// under the forces that the direct method found, arrives. Its steps are accurate to 1e-11.
/// Drag has a speed as factor, which has no derivative at the start, where the bead is at rest. The time is that of Pontryagin's equations, integrated
/// backward from the end with two unknowns, its speed and its direction there, by SciPy at a tolerance of 1e-13.
#[test]
fn a_bead_starts_from_rest_in_air() {
    let text = "machine Bead in plane {
        parameters { m: kg = 1.3, g: m/s^2 = 9.81, c: 1 = 0.8, area: m^2 = 1, rho: kg/m^3 = 1 }
        coordinates { x: m, y: m }
        bodies { bead { mass: m, at: (x, y) } }
        gravity (0, -g);
        drag { air { at: bead.at, coefficient: c, area: area, density: rho } }
    }";
    let found = solved(text, &["--to", "x=2,y=-1"]);
    close(&found["time"], 0.9511950406890216, 1e-11);
    assert_eq!(found["is_motion"], true, "{}", found["warnings"]);
    // It begins to fall vertically.
    let start = &found["path"][0];
    assert_eq!(start["v"]["x"], 0.0);
    assert_eq!(start["v"]["y"], 0.0);
    close(&start["a"]["y"], -9.81, 1e-9);
}

#[test]
fn a_machine_with_friction_outside_of_the_conditions_arrives() {
    let rough = "machine Rough in plane {
        parameters { m: kg = 1, mu: 1 = 0.1, g: m/s^2 = 9.81, h: m = 1 }
        coordinates { s: m, q: m }
        frames { wedge = ground.shift(s, 0), slider = wedge.shift(q, -q) }
        bodies { wedge { mass: m, frame: wedge }, slider { mass: m, frame: slider } }
        gravity (0, -g);
        springs { back { stiffness: 3, stretch: s } }
        sliding {
            floor {
                body: wedge, on: ground, direction: (-1, 0), normal: (0, 1),
                friction: mu*(1 + (s/h)^2),
            },
            incline {
                body: slider, on: wedge, direction: (sqrt(1/2), -sqrt(1/2)),
                normal: (sqrt(1/2), sqrt(1/2)), friction: mu,
            },
        }
        brachistochrone { s = -h/2, q = 3/2*h }
    }";
    let found = solved(rough, &[]);
    assert_eq!(found["method"], "direct");
    assert_eq!(found["warnings"], serde_json::json!([]));
    assert!(found["arrival"].as_f64().expect("a number") < 1e-9);
    let because = found["because"].to_string();
    assert!(
        because.contains("the coefficient of friction of `floor` depends on `s`"),
        "{because}"
    );
}

#[test]
fn what_has_no_fastest_motion_says_why() {
    let error = |spec: &str, to: &str| solved(spec, &["--to", to])["error"].to_string();
    let found = error(BEAD, "x=1,y=1");
    assert!(found.contains("cannot be reached from rest"), "{found}");
    let driven = BEAD
        .replace("g: m/s^2", "w: rad/s = 1, g: m/s^2")
        .replace("(0, -g)", "(g*sin(w*t), -g)");
    let found = error(&driven, "x=1,y=-1");
    assert!(found.contains("depends on `t`"), "{found}");
    let held = BEAD.replace("gravity", "constraints { c: x = y } gravity");
    let found = error(&held, "x=1,y=-1");
    assert!(found.contains("has constraints"), "{found}");
    // This violates the conditions (17).
    let spring = BEAD.replace(
        "gravity",
        "springs { s { stiffness: 3, stretch: x } } gravity",
    );
    for (to, why) in [
        ("x=0,y=0", "start and end are the same"),
        ("x=1,y=1", "cannot be reached from rest"),
        ("x=10,y=-1", "cannot be reached from rest"),
    ] {
        let found = error(&spring, to);
        assert!(found.contains(why), "{to}: {found}");
    }
}

#[test]
fn the_end_is_the_specs_the_calls_or_of_both() {
    let bead = BEAD
        .replace("gravity", "brachistochrone { x = 2*w, y = -1 } gravity")
        .replace("m: kg = 1", "m: kg = 1, w: m = 1");
    let time = |options: &[&str]| solved(&bead, options)["time"].as_f64().expect("a time");
    assert_eq!(time(&[]), time(&["--to", "x=2,y=-1"]));
    assert_eq!(time(&["--set", "w=0.5"]), time(&["--to", "x=1"]));
    assert!((time(&["--to", "x=1"]) / CYCLOID - 1.0).abs() < 1e-13);
    // Along (1, 1)/√2 and (1, −1)/√2 the end (2, −1) is (1/√2, 3/√2).
    let second = format!("y={}", 4.5_f64.sqrt());
    assert!((time(&["--natural", "--to", &second]) / time(&[]) - 1.0).abs() < 1e-13);
    let error = solved(BEAD, &[])["error"].to_string();
    assert!(
        error.contains("it is not specified where the motion ends"),
        "{error}"
    );
}

/// The spec's defaults are the paper's example; its time is published to six digits, and was recomputed to forty elsewhere.
#[test]
fn the_prisms_take_the_papers_time() {
    let arguments = ["brachistochrone", "machines/prisms.machine", "--json"];
    let found = |options: &[&str]| -> Value {
        let output = lagrangian(&[&arguments[..], options].concat());
        serde_json::from_slice(&output.stdout).expect("JSON")
    };
    let natural = found(&["--natural", "--to", "q1=12,q2=6"]);
    close(&natural["time"], 1.637369712040567, 1e-13);
    let found = found(&[]);
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
    // The machine itself, with its own law of friction, under the computed forces; steps are accurate to 1e-11.
    assert!(found["arrival"].as_f64().expect("a number") < 1e-9);
    assert!(found["control_power"].as_f64().expect("a number") < 1e-10);
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

#[test]
fn a_page_shows_the_fastest_motion_beside_that_of_the_machine_left_to_itself() {
    let page = Scratch::new("fastest.html", "");
    let arguments = ["brachistochrone", "machines/prisms.machine", "--report"];
    let output = lagrangian(&[&arguments[..], &[page.path()]].concat());
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let page = Page::read(0, &page);
    let number = |runner: &str, what: &str| page.data[runner][what].as_f64().expect("a number");
    for runner in ["fastest", "free"] {
        close(&page.data[runner]["to"], 1.637369712040567, 1e-13);
        assert_eq!(number(runner, "coordinates"), 2.0);
    }
    let last = |runner: &str| {
        let states = floats(page.data[runner]["states"].as_str().expect("text"));
        states[states.len() - 4..].to_vec()
    };
    let [fastest, free] = ["fastest", "free"].map(last);
    assert!((fastest[0] - 8.0).abs() < 1e-5 && (fastest[1] - 4.75).abs() < 1e-5);
    // Two equations typed in by hand: a q̈ = −c − friction of (57), with both bodies sliding forwards.
    let (m, w, g) = (32.0 / 13.0, 20.0 / 13.0, 9.81);
    let a = [[m + w, -m - 0.02 * m], [-m - 0.1 * m, 2.0 * m]];
    let f = [-0.02 * (m + w) * g, m * g - 0.1 * m * g];
    let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    let half = 0.5 * 1.637369712040567_f64.powi(2) / det;
    let q = [
        half * (a[1][1] * f[0] - a[0][1] * f[1]),
        half * (a[0][0] * f[1] - a[1][0] * f[0]),
    ];
    for (found, q) in free.iter().zip(q) {
        assert!((f64::from(*found) / q - 1.0).abs() < 1e-6, "{free:?} {q}");
    }
    assert_eq!(page.html.matches("{{").count(), 0);
    assert!(page.html.contains("<svg") && page.html.contains("normal reaction of floor"));
    let rest = page.html.replace("http://www.w3.org/", "");
    assert!(!rest.contains("http://") && !rest.contains("https://"));
}

const HILL: &str = "machine Hill in space {
    parameters { m: kg = 1, g: m/s^2 = 9.81, h: m = 0.6, w: m = 0.5, far: 1 = 1 }
    coordinates { x: m = -1, y: m }
    bodies { p { mass: m, at: (x, y, h*exp(-(x^2 + far*y^2)/w^2) - x/2) } }
    gravity (0, 0, -g);
}";

/// The times of other local solutions, and the number of tries, are reported; the times themselves are compared with rays in
/// the library's tests.
#[test]
fn what_was_tried_is_said() {
    let spec = Scratch::new("hill.machine", HILL);
    let arguments = ["brachistochrone", spec.path(), "--to", "x=1,y=0"];
    let output = lagrangian(&arguments);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success(), "{text}");
    assert!(
        text.contains("the fastest found from 5 starts; others take 1.338777"),
        "{text}"
    );
    let found = solved(HILL, &["--to", "x=1,y=0"]);
    let tried = found["tried"].as_array().expect("a list");
    let of = |what: &str| {
        tried
            .iter()
            .filter(|trial| trial["outcome"] == what)
            .collect::<Vec<_>>()
    };
    assert_eq!(tried[0]["start"], "straight");
    assert_eq!(tried[0]["outcome"], "lacks energy");
    let [one, other] = of("found")[..] else {
        panic!("{tried:?}");
    };
    // To the left and to the right of the hill.
    close(&one["time"], other["time"].as_f64().expect("a time"), 1e-12);
    assert_eq!(
        one["aside"]["y"].as_f64(),
        other["aside"]["y"].as_f64().map(|y| -y)
    );
    for trial in of("same") {
        let index = trial["same"].as_u64().expect("an index") as usize;
        assert_eq!(tried[index]["outcome"], "found");
    }
    // An endless ridge.
    let ridge = ["--set", "far=0", "--to", "x=1,y=0"];
    let failed = solved(HILL, &ridge);
    let tried = failed["tried"].as_array().expect("a list");
    assert_eq!(tried.len(), 6);
    let error = failed["error"].as_str().expect("words");
    for trial in tried {
        assert!(
            error.contains(trial["words"].as_str().expect("words")),
            "{error}"
        );
    }
    assert!(error.contains("a path displaced in y by 0.7"), "{error}");
    assert_eq!(
        solved(BEAD, &["--to", "x=1,y=-1"])["tried"],
        serde_json::json!([])
    );
}

#[test]
fn a_guess_is_a_table() {
    // A guess on the near side of the hill, for the solution on the far side.
    let spec = Scratch::new("guessed.machine", HILL);
    let way = Scratch::new("way.csv", "");
    let arguments = [
        "brachistochrone",
        spec.path(),
        "--to",
        "x=1,y=-0.3",
        "--out",
        way.path(),
    ];
    assert!(lagrangian(&arguments).status.success());
    let guessed = solved(HILL, &["--to", "x=1,y=0.3", "--guess", way.path()]);
    let alone = solved(HILL, &["--to", "x=1,y=0.3"]);
    assert_eq!(guessed["time"], alone["time"]);
    let [first, tried] = [&guessed["tried"][0], &alone["tried"]];
    assert_eq!(first["start"], "guess");
    let times = tried.as_array().expect("a list").iter();
    let slowest = times
        .filter_map(|trial| trial["time"].as_f64())
        .fold(0.0, f64::max);
    assert!(slowest > alone["time"].as_f64().expect("a time") + 0.05);
    close(&first["time"], slowest, 1e-10);
    // The same path in centimetres and millimetres: what the search finds from it is the same motion.
    let written = std::fs::read_to_string(&way.0).expect("a table");
    let mut lines = written.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let column = |name: &str| {
        let found = names
            .iter()
            .position(|of| of.split(' ').next() == Some(name));
        found.expect("a column")
    };
    let (x, y) = (column("x"), column("y"));
    let mut converted = "x [cm],y [mm]\n".to_owned();
    for line in lines {
        let cells: Vec<f64> = line.split(',').flat_map(str::parse).collect();
        converted += &format!("{},{}\n", 100.0 * cells[x], 1000.0 * cells[y]);
    }
    std::fs::write(&way.0, converted).expect("a file");
    let in_other_units = solved(HILL, &["--to", "x=1,y=0.3", "--guess", way.path()]);
    close(&in_other_units["tried"][0]["time"], slowest, 1e-10);
    for (text, why) in [
        ("x,z\n0,0\n", "no column is named `y`"),
        (
            "x,y\n0,a\n",
            "line 2: `a` in column `y` is not a finite number",
        ),
        ("x,y\n0,0\n", "a path needs at least two rows of positions"),
        (
            "x [m],y [kg]\n0,0\n1,0.3\n",
            "column `y`: expected a unit like m, found kg",
        ),
    ] {
        std::fs::write(&way.0, text).expect("a file");
        let error =
            solved(HILL, &["--to", "x=1,y=0.3", "--guess", way.path()])["error"].to_string();
        assert!(error.contains(why), "{error}");
    }
    let error = solved(BEAD, &["--to", "x=1,y=-1", "--guess", "nowhere.csv"])["error"].to_string();
    assert!(error.contains("nowhere.csv"), "{error}");
    std::fs::write(&way.0, "x,y\n0,0\n1,-1\n").expect("a file");
    let error = solved(BEAD, &["--to", "x=1,y=-1", "--guess", way.path()])["error"].to_string();
    assert!(error.contains("closed form"), "{error}");
    // No output may overwrite the guess.
    let files = [
        "--to",
        "x=1,y=0.3",
        "--guess",
        way.path(),
        "--out",
        way.path(),
    ];
    let output = lagrangian(&[&["brachistochrone", spec.path()][..], &files].concat());
    assert_eq!(output.status.code(), Some(2));
}
