//! First-order states: motors, filters, controllers and heat, against closed forms and equivalent specs.

use crate::support::{Scratch, json, lagrangian, number};
use serde_json::Value;

/// A run with a tolerance of 1e-11.
fn run(spec: &str, until: &str, more: &[&str]) -> Value {
    let own = [
        "simulate",
        spec,
        "--until",
        until,
        "--tolerance",
        "1e-11",
        "--json",
    ];
    json(&[&own[..], more].concat())
}

fn close(found: f64, expected: f64, by: f64, what: &str) {
    let size = expected.abs().max(1e-3);
    assert!(
        (found - expected).abs() <= by * size,
        "{what}: {found} and not {expected}"
    );
}

/// `e^{A t} x`, by Taylor's series in steps that are short enough for 30 terms to be exact in f64.
fn exponential<const N: usize>(a: [[f64; N]; N], t: f64, mut x: [f64; N]) -> [f64; N] {
    let largest: f64 = a.iter().flatten().map(|x| x.abs()).sum();
    let steps = (largest * t).ceil().max(1.0);
    let h = t / steps;
    for _ in 0..steps as usize {
        let mut term = x;
        for k in 1..=30 {
            let mut next = [0.0; N];
            for (next, row) in next.iter_mut().zip(&a) {
                let product: f64 = row.iter().zip(&term).map(|(a, x)| a * x).sum();
                *next = product * h / f64::from(k);
            }
            term = next;
            x.iter_mut().zip(term).for_each(|(x, term)| *x += term);
        }
    }
    x
}

const MOTOR_SPEC: &str = "machines/dc_motor.machine";

// The parameters of the spec.
const J: f64 = 2e-4;
const B: f64 = 1e-4;
const L: f64 = 2e-3;
const R: f64 = 0.5;
const K: f64 = 0.05;
const U: f64 = 12.0;

/// The matrix of the rates of φ, ω, i, the charge ∫ i dt, and 1.
const MOTOR: [[f64; 5]; 5] = [
    [0.0, 1.0, 0.0, 0.0, 0.0],
    [0.0, -B / J, K / J, 0.0, 0.0],
    [0.0, -K / L, -R / L, 0.0, U / L],
    [0.0, 0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 0.0],
];

#[test]
fn a_motor_runs_up_as_the_exponential_of_its_matrix_says() {
    let spec = MOTOR_SPEC;
    for (method, by) in [("dop853", 1e-8), ("radau5", 1e-7), ("taylor", 1e-8)] {
        let found = run(spec, "0.05", &["--start", "i=0.5", "--method", method]);
        let [phi, omega, i, ..] = exponential(MOTOR, 0.05, [0.0, 0.0, 0.5, 0.0, 1.0]);
        // A tolerance of 1e-11 in each of some hundred steps.
        close(number(&found["q"]["phi"]), phi, by, method);
        close(number(&found["v"]["phi"]), omega, by, method);
        close(number(&found["states"]["i"]), i, by, method);
        assert!(found["q"].get("integral(i)").is_none(), "{found}");
        // The sum of J ω², L i² and the supplied energy is about 30 J.
        assert!(number(&found["energy_residual"]).abs() < 1e-7, "{found}");
    }
}

#[test]
fn what_is_supplied_to_a_motor_is_voltage_by_charge() {
    let spec = MOTOR_SPEC;
    let output = lagrangian(&["simulate", spec, "--until", "0.05", "--tolerance", "1e-11"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let after = |word: &str| -> f64 {
        let rest = said
            .split(word)
            .nth(1)
            .unwrap_or_else(|| panic!("{word} in {said}"));
        let number = rest.split([',', '\n']).next().unwrap_or_default().trim();
        number
            .parse()
            .unwrap_or_else(|_| panic!("{number} in {said}"))
    };
    let [_, omega, i, charge, _] = exponential(MOTOR, 0.05, [0.0, 0.0, 0.0, 0.0, 1.0]);
    let stored = J * omega * omega / 2.0 + L * i * i / 2.0;
    // Seven digits are printed.
    close(
        after("work of drives and forces "),
        U * charge,
        1e-6,
        "work",
    );
    close(after("dissipated "), U * charge - stored, 1e-6, "losses");
}

#[test]
fn the_linear_model_of_a_motor_has_its_states() {
    let found = json(&["linearize", MOTOR_SPEC, "--set", "U=0", "--json"]);
    let names: Vec<&str> = found["states"]
        .as_array()
        .expect("states")
        .iter()
        .map(|state| state["name"].as_str().expect("a name"))
        .collect();
    assert_eq!(names, ["phi", "der(phi)", "i"]);
    assert_eq!(found["states"][2]["unit"], "A");
    for (row, expected) in MOTOR[..3].iter().enumerate() {
        for (column, expected) in expected[..3].iter().enumerate() {
            let entry = number(&found["A"][row][column]);
            close(entry, *expected, 1e-14, "A");
        }
    }
    close(number(&found["B"][2][0]), 1.0 / L, 1e-14, "B");
    assert!(found["left_out"].as_array().expect("a list").is_empty());
    // λ² + (b/J + R/L) λ + (b R + k²)/(J L)
    let (p, q) = (B / J + R / L, (B * R + K * K) / (J * L));
    let found = json(&["modes", MOTOR_SPEC, "--set", "U=0", "--json"]);
    let modes = found["modes"].as_array().expect("modes");
    assert_eq!(modes.len(), 3, "{found}");
    assert_eq!(found["equilibrium"]["free"], 1);
    let fast = modes.last().expect("a mode");
    let re = -p / 2.0 - (p * p / 4.0 - q).sqrt();
    close(number(&fast["re"]), re, 1e-12, "re");
    assert_eq!(number(&fast["im"]), 0.0);
    assert!(fast["shape"].get("i").is_some(), "{fast}");
}

#[test]
fn a_servo_stands_where_its_controller_wants_it() {
    let spec = "machines/position_servo.machine";
    let found = json(&["modes", spec, "--json"]);
    // At the equilibrium m g a cos θ = n k i, and the integrator supplies the voltage R i.
    let (weight, wanted) = (1.2 * 9.81 * 0.25, 0.0_f64);
    let i = weight * wanted.cos() / (40.0 * 0.05);
    let at = &found["equilibrium"];
    assert!(number(&at["q"]["theta"]).abs() < 1e-12, "{at}");
    close(number(&at["states"]["i"]), i, 1e-12, "i");
    assert!(number(&at["states"]["seen"]).abs() < 1e-12, "{at}");
    close(
        number(&at["states"]["error"]),
        0.5 * i / 40.0,
        1e-12,
        "error",
    );
    assert_eq!((&at["free"], &at["drifts"]), (&0.into(), &0.into()), "{at}");
    // The run reaches that equilibrium.
    let run = run(spec, "20", &[]);
    assert!(number(&run["q"]["theta"]).abs() < 1e-6, "{run}");
    close(number(&run["states"]["i"]), i, 1e-5, "i");
}

/// A brake whose friction heats a disc that is cooled by air.
const BRAKE: &str = "
machine Brake in plane {
    parameters { J: kg*m^2 = 0.4, b: N*m*s = 0.1, C: J/K = 4.5, h: W/K = 2, T0: K = 293 }
    coordinates { phi: rad, der(phi): rad/s = 100 }
    states { T: K = T0, der(T) = (b*der(phi)^2 - h*(T - T0))/C }
    bodies { disc { mass: 10, inertia: J, at: (0, 0), angle: phi } }
    torques { pads { on: disc, torque: -b*der(phi) } }
    energies { disc: C*(T - T0) }
    losses { air: h*(T - T0) }
    gravity none;
}";

#[test]
fn what_a_brake_takes_is_in_the_disc_or_in_the_air() {
    let spec = Scratch::new("brake.machine", BRAKE);
    let t = 3.0;
    let found = run(spec.path(), "3", &[]);
    let (slow, cool) = (2.0 * 0.1 / 0.4, 2.0 / 4.5);
    let heat = 0.1 * 1e4 / 4.5 * (f64::exp(-slow * t) - f64::exp(-cool * t)) / (cool - slow);
    close(
        number(&found["v"]["phi"]),
        100.0 * f64::exp(-slow * t / 2.0),
        1e-9,
        "rate",
    );
    close(
        number(&found["states"]["T"]),
        293.0 + heat,
        1e-9,
        "temperature",
    );
    // Relative to 2000 J.
    assert!(number(&found["energy_residual"]).abs() < 1e-6, "{found}");
}

/// Heat conduction through three plates, with a flywheel without brake.
const FAMILY: &str = "
machine Plates in plane {
    constants { N = 3 }
    parameters { J: kg*m^2 = 1, c: J/K = 2, g: W/K = 3, hot: K = 400 }
    coordinates { phi: rad, der(phi): rad/s = 1 }
    states {
        T[1..N]: K = 300,
        der(T[1]) = (g*(hot - T[1]) - g*(T[1] - T[2]))/c,
        der(T[i in 2..N-1]) = (g*(T[i-1] - T[i]) - g*(T[i] - T[i+1]))/c,
        der(T[N]) = g*(T[N-1] - T[N])/c,
    }
    bodies { wheel { mass: 1, inertia: J, at: (0, 0), angle: phi } }
    gravity none;
}";

const APART: &str = "
machine Plates in plane {
    parameters { J: kg*m^2 = 1, c: J/K = 2, g: W/K = 3, hot: K = 400 }
    coordinates { phi: rad, der(phi): rad/s = 1 }
    define { first = g*(T1 - T2), second = g*(T2 - T3) }
    states {
        der(T3): K/s = second/c,
        der(T1) = (g*(hot - T1) - first)/c,
        T1: K = 300, T2: K = 300, T3: K = 300,
        der(T2) = (first - second)/c,
    }
    bodies { wheel { mass: 1, inertia: J, at: (0, 0), angle: phi } }
    gravity none;
}";

#[test]
fn a_family_of_states_is_the_states_one_by_one() {
    let (family, apart) = (
        Scratch::new("family.machine", FAMILY),
        Scratch::new("apart.machine", APART),
    );
    let together = run(
        family.path(),
        "0.7",
        &["--start", "T=310", "--start", "T[2]=305"],
    );
    let single = [
        "--start", "T1=310", "--start", "T2=305", "--start", "T3=310",
    ];
    let single = run(apart.path(), "0.7", &single);
    let a = 3.0 / 2.0;
    let matrix = [
        [-2.0 * a, a, 0.0, 400.0 * a],
        [a, -2.0 * a, a, 0.0],
        [0.0, a, -a, 0.0],
        [0.0; 4],
    ];
    let expected = exponential(matrix, 0.7, [310.0, 305.0, 310.0, 1.0]);
    for k in 0..3 {
        let [one, other] = [
            number(&together["states"][format!("T[{}]", k + 1)]),
            number(&single["states"][format!("T{}", k + 1)]),
        ];
        assert_eq!(one, other, "plate {k}");
        close(one, expected[k], 1e-9, "temperature");
    }
}

/// A bob on a rod with a filtered force, where the rod is a constraint or the radius of an angle.
fn pendulum(is_closed: bool) -> String {
    let (coordinates, body, rod, force) = if is_closed {
        (
            "x: m = 0.6, y: m = -0.8",
            "bob { mass: m, at: (x, y) }",
            "constraints { rod: x^2 + y^2 = l^2 }",
            "pushes { on: x, value: c*u }",
        )
    } else {
        (
            "phi: rad = 0.6435011087932844",
            "bob { mass: m, at: (l*sin(phi), -l*cos(phi)) }",
            "",
            "pushes { at: bob.at, force: (c*u, 0) }",
        )
    };
    let place = if is_closed { "x" } else { "l*sin(phi)" };
    format!(
        "machine Pushed in plane {{
            parameters {{
                m: kg = 2, l: m = 1, g: m/s^2 = 9.81, c: N = 5, tau: s = 0.3, w: rad/s = 3,
            }}
            coordinates {{ {coordinates} }}
            states {{ u: 1 = 0.2, der(u) = (cos(w*t) - u - {place}/l)/tau }}
            bodies {{ {body} }}
            forces {{ {force} }}
            gravity (0, -g);
            {rod}
        }}"
    )
}

#[test]
fn states_go_with_constraints() {
    let (closed, open) = (
        Scratch::new("closed.machine", &pendulum(true)),
        Scratch::new("open.machine", &pendulum(false)),
    );
    let closed = run(closed.path(), "3", &[]);
    let open = run(open.path(), "3", &[]);
    let phi = number(&open["q"]["phi"]);
    close(number(&closed["q"]["x"]), phi.sin(), 1e-7, "x");
    close(number(&closed["q"]["y"]), -phi.cos(), 1e-7, "y");
    close(
        number(&closed["states"]["u"]),
        number(&open["states"]["u"]),
        1e-7,
        "u",
    );
}

#[test]
fn a_state_is_known_under_its_name_everywhere() {
    let spec = MOTOR_SPEC;
    let point = r#"[{"q": [0.1], "v": {"phi": 40}, "states": {"i": 3}, "inputs": {"U": 10}},
        {"states": [1.5]}]"#;
    let points = Scratch::new("points.json", point);
    let found = json(&["evaluate", spec, "--at", points.path()]);
    let rate = (10.0 - R * 3.0 - K * 40.0) / L;
    close(number(&found[0]["state_rates"]["i"]), rate, 1e-15, "rate");
    close(
        number(&found[0]["accelerations"][0]),
        (K * 3.0 - B * 40.0) / J,
        1e-15,
        "acceleration",
    );
    assert_eq!(found[0]["mass_matrix"].as_array().map(Vec::len), Some(1));
    close(
        number(&found[1]["outputs"]["supplied"]),
        12.0 * 1.5,
        1e-15,
        "output",
    );

    let table = points.0.with_file_name("motor.csv");
    let out = table.to_str().expect("a path");
    run(spec, "0.01", &["--every", "0.005", "--out", out]);
    let text = std::fs::read_to_string(&table).expect("a table");
    let head = text.lines().next().unwrap_or_default().to_owned();
    assert!(head.contains(",i [A],"), "{head}");
    assert!(!head.contains("integral"), "{head}");

    let rows = points.0.with_file_name("rows.csv");
    let out = rows.to_str().expect("a path");
    let output = lagrangian(&[
        "sweep",
        spec,
        "--until",
        "0.01",
        "--vary",
        "start(i)=0,1,2",
        "--fresh",
        "--out",
        out,
    ]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    let text = std::fs::read_to_string(&rows).expect("rows");
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let head = lines.next().expect("a head");
    let place = |name: &str| head.iter().position(|cell| *cell == name);
    let (start, end) = (place("start(i)"), place("i"));
    for (line, asked) in lines.zip([0.0, 1.0, 2.0]) {
        let cell = |place: Option<usize>| -> f64 {
            let cell = line[place.expect("a column")];
            cell.parse().expect("a number")
        };
        assert_eq!(cell(start), asked);
        let [_, _, i, ..] = exponential(MOTOR, 0.01, [0.0, 0.0, asked, 0.0, 1.0]);
        close(cell(end), i, 1e-6, "a run of a sweep");
    }
}

#[test]
fn what_a_state_cannot_do_is_said_at_the_word() {
    let spec = |extra: &str, rate: &str| {
        format!(
            "machine Wrong in plane {{
                parameters {{ m: kg = 1, b: N*s/m = 2, tau: s = 1 }}
                coordinates {{ x: m, y: m }}
                states {{ s: m/s = 1, {rate} }}
                bodies {{ bob {{ mass: m, at: (x, y) }} }}
                gravity none;
                {extra}
            }}"
        )
    };
    let rate = "der(s) = -s/tau";
    let right = Scratch::new(
        "right.machine",
        &spec("forces { f { on: x, value: -b*s } }", rate),
    );
    let output = lagrangian(&["check", right.path()]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    for (extra, rate, word) in [
        ("", "", "the rate of the state `s` is not given"),
        ("", "der(s) = der(der(x))", "accelerations"),
        ("", "der(s) = x", "m/s^2"),
        ("", "der(s) = s/tau, der(s) = -s/tau", "given twice"),
        ("", "der(s) = s/tau, der(x) = s", "a state is expected here"),
        ("", "der(s) = s/tau, der(r) = s", "no state is named `r`"),
        ("constraints { c: der(x) = s }", rate, "the state `s`"),
        (
            "dissipations { d: 1/2*b*(der(x) - s)^2 }",
            rate,
            "the state `s`",
        ),
        ("energies { e: 1/2*m*der(x)^2 }", rate, "the rate of `x`"),
        ("potentials { v: b*x*s }", rate, "velocities"),
        ("forces { f { on: s, value: 1 } }", rate, "a state"),
    ] {
        let file = Scratch::new("wrong.machine", &spec(extra, rate));
        let output = lagrangian(&["check", file.path()]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned()
            + &String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(1), "{extra} {rate}: {said}");
        assert!(said.contains(word), "{extra} {rate}: {said}");
    }
}

/// A loudspeaker driven by a sine: a membrane of 20 g, half of which is the coil, which is either tied to
/// it by a constraint or part of it.
fn loudspeaker(is_tied: bool) -> String {
    let (coordinates, parts, tie) = if is_tied {
        (
            "x: m, z: m",
            "membrane { mass: m/2, at: (x, 0) }, coil { mass: m/2, at: (z, 0) }",
            "constraints { glue: z = x }",
        )
    } else {
        ("x: m", "membrane { mass: m, at: (x, 0) }", "")
    };
    format!(
        "machine Loudspeaker in plane {{
            parameters {{ m: kg = 0.02, k: N/m = 2e3, b: N*s/m = 1, Bl: N/A = 5, R: ohm = 6, L: H = 2e-3, U: V = 4, Omega: rad/s = 400 }}
            coordinates {{ {coordinates} }}
            states {{ i: A = 0, der(i) = (U*sin(Omega*t) - R*i - Bl*der(x))/L }}
            bodies {{ {parts} }}
            gravity none;
            springs {{ back {{ stiffness: k, stretch: x }} }}
            dampers {{ air {{ damping: b, stretch: x }} }}
            forces {{ magnet {{ on: x, value: Bl*i }} }}
            {tie}
        }}"
    )
}

#[test]
fn a_period_of_a_machine_with_a_state_is_the_exponential_of_its_matrix() {
    let (m, k, b, bl, r, l, u, omega) = (0.02, 2e3, 1.0, 5.0, 6.0, 2e-3, 4.0, 400.0);
    // x, v, i, and the sine and cosine of the drive.
    let matrix = [
        [0.0, 1.0, 0.0, 0.0, 0.0],
        [-k / m, -b / m, bl / m, 0.0, 0.0],
        [0.0, -bl / l, -r / l, u / l, 0.0],
        [0.0, 0.0, 0.0, 0.0, omega],
        [0.0, 0.0, 0.0, -omega, 0.0],
    ];
    let period = std::f64::consts::TAU / omega;
    for is_tied in [false, true] {
        let spec = Scratch::new("loudspeaker.machine", &loudspeaker(is_tied));
        let found = json(&["orbit", spec.path(), "--period", "2*pi/Omega", "--json"]);
        let states: Vec<&str> = found["states"]
            .as_array()
            .expect("a list")
            .iter()
            .filter_map(Value::as_str)
            .collect();
        // With the constraint, the result may contain either of the two coordinates.
        let is_of = |name: &str, of: &str| name.replace('z', "x") == of;
        assert!(
            states.len() == 3
                && is_of(states[0], "x")
                && is_of(states[1], "der(x)")
                && states[2] == "i",
            "{states:?}"
        );
        // Steps have an error of 1e-11 of the largest number, and rates are about 200 times as large as
        // positions; there are a hundred steps.
        for column in 0..3 {
            let mut unit = [0.0; 5];
            unit[column] = 1.0;
            let expected = exponential(matrix, period, unit);
            for row in 0..3 {
                let value = number(&found["monodromy"][row][column]);
                close(
                    value,
                    expected[row],
                    1e-7,
                    &format!("{row} {column} {is_tied}"),
                );
            }
        }
        // The orbit returns to its start.
        let at = &found["at"];
        let start = [
            number(&at["q"]["x"]),
            number(&at["v"]["x"]),
            number(&at["states"]["i"]),
            0.0,
            1.0,
        ];
        let there = exponential(matrix, period, start);
        for (from, to) in start.iter().zip(there) {
            close(to, *from, 1e-8, "the start");
        }
        assert!(start[2].abs() > 0.1, "{start:?}");
    }
}

/// A current that decays through a resistance, i = i₀ e^{−Rt/L}, and a block without influence.
const WINDING: &str = "machine Winding in plane {
    parameters { R: ohm = 2, L: H = 0.5, first: A = 3 }
    coordinates { x: m }
    states { i: A = first, der(i) = -R*i/L }
    bodies { block { mass: 1, at: (x, 0) } }
    gravity none;
}
";

#[test]
fn the_start_of_a_state_is_varied_and_fitted_under_its_name() {
    let spec = Scratch::new("winding.machine", WINDING);
    let found = json(&[
        "sensitivities",
        spec.path(),
        "--by",
        "start(i),R,first",
        "--until",
        "0.5",
        "--tolerance",
        "1e-11",
        "--of",
        "i",
        "--json",
    ]);
    let left = f64::exp(-2.0);
    // The derivatives by the start, by R, −(t/L) i, and by the parameter that determines the start.
    for (k, known) in [left, -3.0 * left, left].into_iter().enumerate() {
        let values = found["derivatives"][k]["values"]
            .as_array()
            .expect("a list");
        close(
            number(&values[values.len() - 1]),
            known,
            1e-8,
            "sensitivity",
        );
    }
    let named = |k: usize| found["derivatives"][k]["name"].as_str().expect("a name");
    assert_eq!([named(0), named(1)], ["i by start(i)", "i by R"]);
    assert_eq!(found["derivatives"][0]["unit"], "A/A");

    // A start that the call sets no longer follows the parameter.
    let set = json(&[
        "sensitivities",
        spec.path(),
        "--by",
        "first,R",
        "--until",
        "0.5",
        "--tolerance",
        "1e-11",
        "--start",
        "i=3",
        "--json",
    ]);
    for (k, known) in [0.0, -3.0 * left].into_iter().enumerate() {
        let values = set["derivatives"][2 + k]["values"].as_array();
        let last = values.and_then(|values| values.last()).expect("a list");
        assert_eq!(
            set["derivatives"][2 + k]["name"]
                .as_str()
                .map(|name| &name[..4]),
            Some("i by")
        );
        close(number(last), known, 1e-8, "sensitivity");
    }

    // Measurements in closed form with 4 A and 3 ohm.
    let mut rows = String::from("t,i [A]\n");
    for k in 0..=20 {
        let t = f64::from(k) / 40.0;
        rows.push_str(&format!("{t},{:e}\n", 4.0 * f64::exp(-6.0 * t)));
    }
    let data = Scratch::new("data.csv", &rows);
    let out = data.0.with_file_name("fitted.machine");
    let out = out.to_str().expect("text");
    let call = [
        "fit",
        spec.path(),
        "--data",
        data.path(),
        "--fit",
        "start(i),R",
    ];
    let found = json(&[&call[..], &["--json", "--out", out]].concat());
    close(number(&found["fitted"][0]["value"]), 4.0, 1e-6, "start");
    close(number(&found["fitted"][1]["value"]), 3.0, 1e-6, "R");
    assert_eq!(found["fitted"][0]["name"], "start(i)");
    assert_eq!(found["fitted"][0]["unit"], "A");
    // The variant starts at the fitted value.
    let found = run(out, "0.5", &[]);
    close(
        number(&found["states"]["i"]),
        4.0 * f64::exp(-3.0),
        1e-6,
        "fitted",
    );
    // An experiment with a start of its own: from 4 A the same current has the resistance of 3 ohm.
    let own = format!("{},start(i)=4000*mA", data.path());
    let found = json(&["fit", spec.path(), "--data", &own, "--fit", "R", "--json"]);
    close(number(&found["fitted"][0]["value"]), 3.0, 1e-6, "R");
    for name in ["start(j)", "rate(integral(i))", "start(integral(i))"] {
        let call = ["fit", spec.path(), "--data", data.path(), "--fit", name];
        let output = lagrangian(&call);
        assert_eq!(output.status.code(), Some(2), "{name}");
    }
}

/// A state is kept by its own name, whether or not there are constraints for whose sake the others are changed.
#[test]
fn a_state_is_kept_by_its_name() {
    const COIL: &str = "machine Coil in plane {
        parameters { R: ohm = 1, L: H = 0.1, K: N/A = 0.2 }
        coordinates { x: m = 1, y: m = 0.2 }
        states { i: A = 0.5, der(i) = -R*i/L }
        bodies { bead { mass: 1, at: (x, y) } }
        forces { coil { on: x, value: K*i } }
        constraints { ring: norm(bead.at) = 1 }
    }";
    let at = |text: &str, keep: &str| {
        let spec = Scratch::new("coil.machine", text);
        let arguments = [
            "simulate",
            spec.path(),
            "--until",
            "0.1",
            "--json",
            "--keep",
            keep,
        ];
        let output = lagrangian(&arguments);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{error}");
        let document: serde_json::Value =
            serde_json::from_slice(&output.stdout).expect("a document");
        document["states"]["i"].as_f64().expect("a number")
    };
    let expected = 0.5 * (-1.0_f64).exp();
    for text in [
        COIL.to_owned(),
        COIL.replace("constraints { ring: norm(bead.at) = 1 }", ""),
    ] {
        for keep in ["i", "y,i", "none"] {
            let current = at(&text, keep);
            // A hundred steps, each within the tolerance of 1e-9.
            assert!((current - expected).abs() < 1e-7, "{keep}: {current}");
        }
    }
}
