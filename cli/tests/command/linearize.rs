//! `lagrangian linearize` against textbooks: matrices typed by hand, poles and zeros in closed form, and files compared
//! byte by byte.

use std::f64::consts::TAU;

use crate::support::{Scratch, json, lagrangian, number, root};
use serde_json::Value;

/// Derivatives are exact, and the equilibrium is known to 20 digits, so errors are some roundings of the numbers typed here.
const CLOSE: f64 = 1e-14;

fn linearize(arguments: &[&str]) -> Value {
    json(&[&["linearize"], arguments, &["--json"]].concat())
}

/// The message of a call that fails, and its exit status.
fn refused(arguments: &[&str]) -> (i32, String) {
    let output = lagrangian(&[&["linearize"], arguments].concat());
    let said = String::from_utf8(output.stderr).expect("text");
    (output.status.code().expect("no signal"), said)
}

fn rows(value: &Value) -> Vec<Vec<f64>> {
    let rows = value.as_array().expect("rows");
    let row = |row: &Value| row.as_array().expect("a row").iter().map(number).collect();
    rows.iter().map(row).collect()
}

fn assert_matrix(found: &Value, exact: &[&[f64]]) {
    let found = rows(found);
    assert_eq!(found.len(), exact.len(), "{found:?}");
    for (row, exact) in found.iter().zip(exact) {
        assert_eq!(row.len(), exact.len(), "{found:?}");
        for (x, exact) in row.iter().zip(*exact) {
            let is_close = (x - exact).abs() <= CLOSE * exact.abs();
            assert!(is_close, "{x:?}, not {exact:?} in {found:?}");
        }
    }
}

fn assert_values(found: &Value, exact: &[(f64, f64)]) {
    let found = found.as_array().expect("a list");
    assert_eq!(found.len(), exact.len(), "{found:?}");
    for (value, (re, im)) in found.iter().zip(exact) {
        let off = (number(&value["re"]) - re).hypot(number(&value["im"]) - im);
        assert!(off <= 1e-12 * re.hypot(*im), "{value}, not {re} + {im}i");
    }
}

fn names(labels: &Value) -> Vec<&str> {
    let labels = labels.as_array().expect("a list");
    labels
        .iter()
        .map(|label| label["name"].as_str().expect("a name"))
        .collect()
}

const OSCILLATOR: &str = "machine Oscillator in plane {
    parameters { m: kg = 2, k: N/m = 4, c: N*s/m = 1 }
    coordinates { x: m = 0.3 }
    inputs { push: N = 0 }
    bodies { block { mass: m, at: (x, 0) } }
    springs { spring { stiffness: k, stretch: x } }
    dampers { damper { damping: c, stretch: x } }
    forces { push { on: x, value: push } }
}";

#[test]
fn an_oscillator_has_the_matrices_of_the_textbook() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let found = linearize(&[spec.path(), "--outputs", "x,der(x),der(x,2)"]);
    assert_matrix(&found["A"], &[&[0.0, 1.0], &[-2.0, -0.5]]);
    assert_matrix(&found["B"], &[&[0.0], &[0.5]]);
    assert_matrix(&found["C"], &[&[1.0, 0.0], &[0.0, 1.0], &[-2.0, -0.5]]);
    assert_matrix(&found["D"], &[&[0.0], &[0.0], &[0.5]]);
    assert_eq!(names(&found["states"]), ["x", "der(x)"]);
    assert_eq!(names(&found["inputs"]), ["push"]);
    assert_eq!(names(&found["outputs"]), ["x", "der(x)", "der(x,2)"]);
    assert_eq!(found["outputs"][2]["unit"], "m/s^2");
    assert!(found["basis"].is_null());
    assert_eq!(found["drift"], serde_json::json!([0.0, 0.0]));
    let im = (2.0_f64 - 0.0625).sqrt();
    assert_values(&found["eigenvalues"], &[(-0.25, im), (-0.25, -im)]);
    // A constant push only shifts the equilibrium.
    let pushed = linearize(&[spec.path(), "--set", "push=3"]);
    assert!((number(&pushed["at"]["q"]["x"]) - 0.75).abs() <= CLOSE);
    assert_eq!(number(&pushed["at"]["u"]["push"]), 3.0);
    assert_matrix(&pushed["A"], &[&[0.0, 1.0], &[-2.0, -0.5]]);
    // About the start as given, with its constant rates besides x = 0, v = 0.
    let here = linearize(&[spec.path(), "--here", "--rate", "x=2", "--set", "push=3"]);
    assert_matrix(&here["A"], &[&[0.0, 1.0], &[-2.0, -0.5]]);
    let drift = here["drift"].as_array().expect("a list");
    assert_eq!(number(&drift[0]), 2.0);
    let exact = (3.0 - 4.0 * 0.3 - 2.0) / 2.0;
    assert!((number(&drift[1]) - exact).abs() <= CLOSE, "{drift:?}");
}

/// (M + m) ẍ + m l θ̈ = u − c ẋ, m l ẍ + (J + m l²) θ̈ = m g l θ − b θ̇, upright.
#[test]
fn a_cart_with_a_pole_has_the_matrices_of_the_textbook() {
    let found = linearize(&["machines/cart_pole.machine"]);
    let (cart, m, l, g, c, b) = (1.0, 0.1, 0.5, 9.81, 0.05, 0.001);
    let about = 0.1 / 3.0 * 0.25 + m * l * l;
    let det = (cart + m) * about - m * m * l * l;
    let by_theta = [-m * l * m * g * l / det, (cart + m) * m * g * l / det];
    let by_x = [-about * c / det, m * l * c / det];
    let by_rate = [m * l * b / det, -(cart + m) * b / det];
    let push = [about / det, -m * l / det];
    let row = |i: usize| [0.0, by_theta[i], by_x[i], by_rate[i]];
    assert_matrix(
        &found["A"],
        &[
            &[0.0, 0.0, 1.0, 0.0],
            &[0.0, 0.0, 0.0, 1.0],
            &row(0),
            &row(1),
        ],
    );
    assert_matrix(&found["B"], &[&[0.0], &[0.0], &[push[0]], &[push[1]]]);
    // The outputs of the spec: the tip's height is constant to first order, the hinge force is −m (ẍ + l θ̈).
    assert_eq!(names(&found["outputs"]), ["tip", "hinge_force"]);
    let hinge: Vec<f64> = (0..4).map(|k| -m * (row(0)[k] + l * row(1)[k])).collect();
    let c_found = rows(&found["C"]);
    assert_eq!(c_found[0], [0.0; 4]);
    for (x, exact) in c_found[1].iter().zip(&hinge) {
        assert!((x - exact).abs() <= 1e-13 * exact.abs(), "{x}, not {exact}");
    }
    let d = rows(&found["D"]);
    let exact = -m * (push[0] + l * push[1]);
    assert!(
        d[0] == [0.0] && (d[1][0] - exact).abs() <= 1e-13 * exact.abs(),
        "{d:?}"
    );
    // From the push to the position of the cart: (J + m l²) s² + b s − m g l = 0.
    let found = linearize(&["machines/cart_pole.machine", "--outputs", "x"]);
    let root = (b * b + 4.0 * about * m * g * l).sqrt();
    let zeros = [(-b - root) / (2.0 * about), (-b + root) / (2.0 * about)];
    let mut exact = zeros.map(|x| (x, 0.0));
    exact.sort_by(|x, y| x.0.abs().total_cmp(&y.0.abs()));
    let found = found["zeros"].as_array().expect("a list");
    assert_eq!(found.len(), 2, "{found:?}");
    for (zero, (re, _)) in found.iter().zip(exact) {
        assert!(
            (number(&zero["re"]) - re).abs() <= 1e-11 * re.abs(),
            "{zero}, not {re}"
        );
        assert_eq!(number(&zero["im"]), 0.0);
    }
}

/// Collocated input and output in a chain of two masses: the zeros are the poles of the part beyond the point, with
/// the point held.
#[test]
fn zeros_of_a_chain_are_the_poles_of_what_stays_free() {
    let spec = Scratch::new(
        "chain.machine",
        "machine Chain in plane {
            parameters { m: kg = 1, M: kg = 3, k: N/m = 12 }
            coordinates { x: m, y: m }
            inputs { push: N = 0 }
            bodies { one { mass: m, at: (x, 0) }, two { mass: M, at: (y, 0) } }
            springs { spring { stiffness: k, stretch: y - x } }
            forces { push { on: x, value: push } }
        }",
    );
    let found = linearize(&[spec.path(), "--outputs", "x"]);
    assert_values(&found["zeros"], &[(0.0, 2.0), (0.0, -2.0)]);
    assert_values(
        &found["eigenvalues"],
        &[(0.0, 0.0), (0.0, 0.0), (0.0, 4.0), (0.0, -4.0)],
    );
    // Through the spring there are no zeros.
    let found = linearize(&[spec.path(), "--outputs", "y"]);
    assert_values(&found["zeros"], &[]);
}

const ROD: &str = "machine Rod in plane {
    parameters { m: kg = 3, g: m/s^2 = 10, l: m = 2 }
    coordinates { x: m, y: m = -2 }
    inputs { push: N = 0, lift: N = 0 }
    bodies { bob { mass: m, at: (x, y) } }
    gravity (0, -g);
    constraints { rod: x^2 + y^2 = l^2 }
    forces { push { on: x, value: push }, lift { on: y, value: lift } }
}";

/// A pendulum as a particle on a rod: x'' = −(g/l + v²/l²) x to first order about the bottom, λ = (lift − m g)/(2 l).
#[test]
fn constraints_leave_the_independent_directions() {
    let spec = Scratch::new("rod.machine", ROD);
    let found = linearize(&[spec.path(), "--outputs", "y,multiplier(rod)"]);
    assert_eq!(names(&found["states"]), ["x", "der(x)"]);
    assert_matrix(&found["A"], &[&[0.0, 1.0], &[-5.0, 0.0]]);
    assert_matrix(&found["B"], &[&[0.0, 0.0], &[1.0 / 3.0, 0.0]]);
    assert_matrix(
        &found["basis"],
        &[&[1.0, 0.0], &[0.0, 0.0], &[0.0, 1.0], &[0.0, 0.0]],
    );
    assert_matrix(&found["C"], &[&[0.0, 0.0], &[0.0, 0.0]]);
    // 0 = −m g + lift + λ ∂(x² + y² − l²)/∂y.
    assert_matrix(&found["D"], &[&[0.0, 0.0], &[0.0, 0.25]]);
    assert!((number(&found["at"]["y"]["multiplier(rod)"]) + 7.5).abs() <= CLOSE);
    // In motion through the lowest point.
    let here = linearize(&[
        spec.path(),
        "--here",
        "--rate",
        "x=1.5",
        "--outputs",
        "y,der(y)",
    ]);
    assert_matrix(&here["A"], &[&[0.0, 1.0], &[-5.0 - 1.5 * 1.5 / 4.0, 0.0]]);
    assert_eq!(here["drift"], serde_json::json!([1.5, 0.0]));
    // y = −√(l² − x²), so y' = x x'/√(l² − x²).
    assert_matrix(&here["C"], &[&[0.0, 0.0], &[0.75, 0.0]]);
    assert_matrix(
        &here["basis"],
        &[&[1.0, 0.0], &[0.0, 0.0], &[0.0, 1.0], &[0.75, 0.0]],
    );
    let (status, said) = refused(&[spec.path(), "--outputs", "multiplier(road)"]);
    assert!(
        status == 2 && said.contains("did you mean `multiplier(rod)`?"),
        "{said}"
    );
}

const CONE: &str = "machine Cone in space {
    parameters { m: kg = 1, l: m = 1, g: m/s^2 = 8, T: N*m = 1 }
    coordinates { theta: rad = 1, phi: rad }
    inputs { torque: N*m = 0, aside: N = 0 }
    bodies { bob { mass: m, at: l*(sin(theta)*cos(phi), sin(theta)*sin(phi), -cos(theta)) } }
    gravity (0, 0, -g);
    forces {
        motor { on: phi, value: torque },
        wind { at: bob.at, force: (aside, 0, 0) },
    }
    outputs { height: m = -l*cos(theta), along: m = l*sin(theta)*cos(phi) }
}";

/// A conical pendulum, cos θ = g/(l ω²) = 1/2: θ'' = −ω² sin²θ δθ + 2 ω sin θ cos θ δφ', φ'' = −2 ω cot θ δθ' + torque/(m l²
/// sin²θ); together ω_n² = ω² (1 + 3 cos²θ), as for Watt's governor with arms without a hub.
#[test]
fn a_steady_motion_has_the_model_of_what_turns_with_it() {
    let spec = Scratch::new("cone.machine", CONE);
    let steady = [spec.path(), "--steady", "phi=4"];
    let found = linearize(
        &[
            &steady[..],
            &["--inputs", "torque", "--outputs", "height,phi"],
        ]
        .concat(),
    );
    let (sin, cos) = (0.75_f64.sqrt(), 0.5);
    assert_eq!(
        names(&found["states"]),
        ["theta", "phi", "der(theta)", "der(phi)"]
    );
    let a = rows(&found["A"]);
    let exact = [
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, 0.0, 1.0],
        [-16.0 * sin * sin, 0.0, 0.0, 8.0 * sin * cos],
        [0.0, 0.0, -8.0 * cos / sin, 0.0],
    ];
    for (row, exact) in a.iter().zip(exact) {
        for (x, exact) in row.iter().zip(exact) {
            assert!((x - exact).abs() <= CLOSE * exact.abs(), "{a:?}");
        }
    }
    assert_matrix(&found["B"], &[&[0.0], &[0.0], &[0.0], &[1.0 / 0.75]]);
    assert_matrix(&found["C"], &[&[sin, 0.0, 0.0, 0.0], &[0.0, 1.0, 0.0, 0.0]]);
    assert_eq!(found["drift"], serde_json::json!([0.0, 0.0, 0.0, 0.0]));
    let omega = 4.0 * 1.75_f64.sqrt();
    assert_values(
        &found["eigenvalues"],
        &[(0.0, 0.0), (0.0, 0.0), (0.0, omega), (0.0, -omega)],
    );
    // An input or output with a fixed direction in space rotates relative to the motion, so its matrix would not be constant.
    for (option, name) in [("--inputs", "aside"), ("--outputs", "along")] {
        let other = if option == "--inputs" {
            "--outputs"
        } else {
            "--inputs"
        };
        let fine = if option == "--inputs" {
            "height"
        } else {
            "torque"
        };
        let (status, said) = refused(&[&steady[..], &[option, name, other, fine]].concat());
        assert_eq!(status, 1, "{said}");
        assert!(
            said.contains(&format!("`{name}`")) && said.contains("as `phi` moves"),
            "{said}"
        );
    }
}

/// A coin that rolls upright and straight; ω² of its wobble is 12/5 Ω² − 4 g/(5 r) for a thin disc (E. J. Routh, *Advanced Rigid
/// Dynamics*, 1884). For a coin that rolls in a circle the position only records its path: it is neither a state nor an output.
#[test]
fn what_only_records_is_no_state() {
    let coin = "machines/rolling_coin.machine";
    let straight = [coin, "--steady", "roll=9", "--start", "lean=0"];
    let found = linearize(&[&straight[..], &["--outputs", "y,lean"]].concat());
    assert_eq!(found["left_out"], serde_json::json!([]));
    let all = [
        "x",
        "y",
        "heading",
        "lean",
        "roll",
        "der(heading)",
        "der(lean)",
        "der(roll)",
    ];
    assert_eq!(names(&found["states"]), all);
    // y follows from the heading at the speed of the coin, and x from the roll.
    let a = rows(&found["A"]);
    let exact = [0.0, 0.0, 0.9, 0.0, 0.0, 0.0, 0.0, 0.0];
    assert!(
        a[1].iter()
            .zip(exact)
            .all(|(x, exact)| (x - exact).abs() <= CLOSE),
        "{:?}",
        a[1]
    );
    let eigenvalues = found["eigenvalues"].as_array().expect("a list");
    let fastest = eigenvalues.iter().map(|x| number(&x["im"]));
    let fastest = fastest.fold(0.0, f64::max);
    let exact = (2.4 * 81.0 - 0.8 * 98.1_f64).sqrt();
    assert!(
        (fastest - exact).abs() <= 1e-12 * exact,
        "{fastest}, not {exact}"
    );

    let round = [coin, "--steady", "roll=9", "--steady", "heading=solve"];
    let found = linearize(&[&round[..], &["--outputs", "lean"]].concat());
    assert_eq!(found["left_out"], serde_json::json!(["x", "y"]));
    assert_eq!(names(&found["states"]), all[2..]);
    let (status, said) = refused(&[&round[..], &["--outputs", "y"]].concat());
    assert!(status == 1 && said.contains("the output `y`"), "{said}");
}

#[test]
fn what_has_no_linearization_is_refused_with_the_reason() {
    let block = |force: &str| {
        Scratch::new(
            "block.machine",
            &format!(
                "machine Block in plane {{
                    parameters {{ m: kg = 1, k: N/m = 4, mu: N = 1, eps: m/s = 0.01 }}
                    coordinates {{ x: m }}
                    bodies {{ block {{ mass: m, at: (x, 0) }} }}
                    springs {{ spring {{ stiffness: k, stretch: x }} }}
                    forces {{ friction {{ on: x, value: {force} }} }}
                }}"
            ),
        )
    };
    for force in [
        "-mu*sign(der(x))",
        "-mu*abs(der(x))/eps",
        "-mu*max(der(x)/eps, 0)",
        "-mu*min(der(x)/eps, 1 + abs(der(x)/eps) - 1)",
    ] {
        let spec = block(force);
        let (status, said) = refused(&[spec.path()]);
        assert!(
            status == 1 && said.contains("corner or a jump in `der(x)`"),
            "{force}: {said}"
        );
        // There are no modes at this point either.
        let modes = lagrangian(&["modes", spec.path()]);
        assert_eq!(modes.status.code(), Some(1), "{force}");
        let said = String::from_utf8_lossy(&modes.stderr).into_owned();
        assert!(said.contains("corner or a jump in `der(x)`"), "{said}");
        // Away from the corner the derivatives exist.
        let found = linearize(&[spec.path(), "--here", "--rate", "x=0.5"]);
        assert_eq!(rows(&found["A"])[1][0], -4.0);
    }
    // In polar coordinates the angle has no inertia at the origin; the order of the coordinates must not matter.
    for coordinates in ["r: m, phi: rad", "phi: rad, r: m"] {
        let polar = Scratch::new(
            "polar.machine",
            &format!(
                "machine Polar in plane {{
                    coordinates {{ {coordinates} }}
                    bodies {{ p {{ mass: 1*kg, at: r*(cos(phi), sin(phi)) }} }}
                }}"
            ),
        );
        let (status, said) = refused(&[polar.path(), "--here"]);
        assert_eq!(status, 1);
        assert!(said.contains("singular in `phi`"), "{coordinates}: {said}");
    }
    // The square is smooth enough: v |v| has the slope 0 there. A steep but smooth bend is accepted as well.
    let smooth = linearize(&[block("-mu*abs(der(x))*der(x)/eps^2").path()]);
    assert_matrix(&smooth["A"], &[&[0.0, 1.0], &[-4.0, 0.0]]);
    let bent = linearize(&[block("-mu*tanh(der(x)/eps)").path()]);
    assert_matrix(&bent["A"], &[&[0.0, 1.0], &[-4.0, -100.0]]);
    for (spec, words) in [
        (
            "machines/block_on_incline.machine",
            "`sliding` has no linear model",
        ),
        (
            "machines/contacts/bouncing_ball.machine",
            "rigid contacts, as `floor`, count as open",
        ),
        ("machines/kapitza_pendulum.machine", "changes with time"),
    ] {
        let (status, said) = refused(&[spec]);
        let is_said = said.contains(words) || said.contains("change with time");
        assert!(status == 1 && is_said, "{spec}: {said}");
    }
    let cart = "machines/cart_pole.machine";
    for (arguments, words) in [
        (&["--inputs", "pull"][..], "there are: push"),
        (&["--outputs", "tips"], "did you mean `tip`?"),
        (&["--outputs", "der(x,3)"], "no output named"),
        (&["--outputs", "x,x"], "more than once"),
        (&["--inputs", "push,push"], "more than once"),
        (&["--out", "model.txt"], "`.json` or `.npz`"),
        (&["--here", "--steady", "x"], "cannot be used with"),
        (&["--along", "l=1..2:3"], "--out"),
    ] {
        let (status, said) = refused(&[&[cart], arguments].concat());
        assert!(status == 2 && said.contains(words), "{arguments:?}: {said}");
    }
}

/// The contents of a file beside another one.
fn beside(file: &Scratch, name: &str) -> Vec<u8> {
    std::fs::read(file.0.with_file_name(name)).expect("a file")
}

#[test]
fn every_ending_holds_the_same_model() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let path = |name: &str| {
        spec.0
            .with_file_name(name)
            .to_str()
            .expect("text")
            .to_owned()
    };
    for ending in ["json", "npz", "mat", "csv"] {
        let out = path(&format!("model.{ending}"));
        linearize(&[spec.path(), "--outputs", "x,der(x,2)", "--out", &out]);
    }
    let json: Value = serde_json::from_slice(&beside(&spec, "model.json")).expect("JSON");
    assert_matrix(&json["C"], &[&[1.0, 0.0], &[-2.0, -0.5]]);
    let text = |name: &str| String::from_utf8(beside(&spec, name)).expect("text");
    assert_eq!(
        text("model.A.csv"),
        ",x,der(x)\nx,0.0,1.0\nder(x),-2.0,-0.5\n"
    );
    assert_eq!(text("model.B.csv"), ",push\nx,0.0\nder(x),0.5\n");
    assert_eq!(
        text("model.C.csv"),
        ",x,der(x)\nx,1.0,0.0\n\"der(x,2)\",-2.0,-0.5\n"
    );
    assert_eq!(text("model.D.csv"), ",push\nx,0.0\n\"der(x,2)\",0.5\n");
    assert_eq!(text("model.drift.csv"), ",drift\nx,0.0\nder(x),0.0\n");
    assert_eq!(
        text("model.basis.csv"),
        ",x,der(x)\nx,1.0,0.0\nder(x),0.0,1.0\n"
    );
    assert!(!spec.0.with_file_name("model.csv").exists());
    // Bytes that NumPy 2 and SciPy 1.17 have read, by
    //   python -c "import numpy, scipy.io; print(dict(numpy.load('model.npz')), scipy.io.loadmat('model.mat'))"
    for name in ["model.npz", "model.mat"] {
        let read = root().join("cli/tests/command/linearize").join(name);
        let read = std::fs::read(read).expect("a file");
        assert!(beside(&spec, name) == read, "{name}");
    }
    // One of the output files would overwrite an input.
    let taken = Scratch::new("model.A.csv", OSCILLATOR);
    let out = taken.0.with_file_name("model.csv");
    let (status, said) = refused(&[taken.path(), "--out", out.to_str().expect("text")]);
    assert!(status == 2 && said.contains("the spec"), "{said}");
}

#[test]
fn frequency_responses_are_drawn() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let path = |name: &str| {
        spec.0
            .with_file_name(name)
            .to_str()
            .expect("text")
            .to_owned()
    };
    let (bode, nyquist) = (path("bode.svg"), path("nyquist.svg"));
    linearize(&[spec.path(), "--bode", &bode, "--nyquist", &nyquist]);
    for (name, words) in [
        (
            "bode.svg",
            ["gain [dB]", "phase [°]", "frequency [Hz]", "x / push"],
        ),
        ("nyquist.svg", ["Re G", "Im G", "x / push", "Oscillator"]),
    ] {
        let svg = String::from_utf8(beside(&spec, name)).expect("text");
        assert!(words.iter().all(|word| svg.contains(word)), "{name}");
    }
    let (status, said) = refused(&["machines/double_pendulum.machine", "--bode", &bode]);
    assert!(status == 1 && said.contains("no inputs"), "{said}");
}

/// The columns of a table.
fn columns(text: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().skip(1);
    lines
        .map(|line| {
            line.split(',')
                .map(|cell| cell.parse().expect("a number"))
                .collect()
        })
        .collect()
}

/// A disc that spins on a flexible shaft: A w² ∓ C Ω w − k = 0 for forward and backward whirl.
#[test]
fn whirls_keep_their_numbers_along_the_speed() {
    let spec = Scratch::new(
        "disc.machine",
        "machine Disc in space {
            parameters { m: kg = 1, A: kg*m^2 = 1, C: kg*m^2 = 1.5, k: N*m = 100 }
            coordinates { alpha: rad, beta: rad, phi: rad }
            frames { disc = ground.turn(x, alpha).turn(y, beta).turn(z, phi) }
            bodies { disc { mass: m, inertia: (A, A, C), frame: disc } }
            springs { one { stiffness: k, stretch: alpha }, two { stiffness: k, stretch: beta } }
        }",
    );
    let out = spec.0.with_file_name("campbell.csv");
    let out = out.to_str().expect("text");
    let found = linearize(&[spec.path(), "--along", "phi=1..31:31", "--out", out]);
    assert_eq!(found["lost"], 0);
    let table = std::fs::read_to_string(out).expect("a table");
    let header = "phi [rad/s],mode,re [1/s],im [1/s],frequency [Hz],damping";
    assert_eq!(table.lines().next(), Some(header));
    let rows = columns(&table);
    assert_eq!(rows.len(), 93);
    let whirl = |speed: f64, sign: f64| {
        let a = 1.5 * speed / 2.0;
        (a * a + 100.0).sqrt() + sign * a
    };
    let number_of = |speed: f64, sign: f64| {
        let exact = whirl(speed, sign);
        let same = |row: &&Vec<f64>| row[0] == speed && (row[3] - exact).abs() <= 1e-12 * exact;
        let row = rows.iter().find(same);
        let row = row.unwrap_or_else(|| panic!("no {exact} at {speed}"));
        assert_eq!((row[2], row[5]), (0.0, 0.0));
        assert!((row[4] - row[3] / TAU).abs() <= 1e-15 * row[3]);
        row[1]
    };
    let [backward, forward] = [number_of(1.0, -1.0), number_of(1.0, 1.0)];
    assert_ne!(backward, forward);
    for speed in 2..=31 {
        let speed = f64::from(speed);
        let found = [number_of(speed, -1.0), number_of(speed, 1.0)];
        assert_eq!(found, [backward, forward], "{speed}");
    }
}

/// Two uncoupled oscillators: where their frequencies cross, each keeps its number.
#[test]
fn modes_that_cross_keep_their_numbers() {
    let spec = Scratch::new(
        "two.machine",
        "machine Two in plane {
            parameters { m: kg = 1, k: N/m = 4, s: N/m = 1 }
            coordinates { x: m, y: m }
            bodies { block { mass: m, at: (x, y) } }
            springs { one { stiffness: k, stretch: x }, two { stiffness: s, stretch: y } }
        }",
    );
    let out = spec.0.with_file_name("campbell.csv");
    let out = out.to_str().expect("text");
    linearize(&[spec.path(), "--along", "s=1..9:12", "--out", out]);
    let rows = columns(&std::fs::read_to_string(out).expect("a table"));
    assert_eq!(rows.len(), 24);
    for row in rows {
        let exact = if row[1] == 1.0 { row[0].sqrt() } else { 2.0 };
        assert!((row[3] - exact).abs() <= 1e-13 * exact, "{row:?}");
    }
}

#[test]
fn what_is_printed_can_be_read() {
    let output = lagrangian(&["linearize", "machines/cart_pole.machine", "--outputs", "x"]);
    let text = String::from_utf8(output.stdout).expect("text");
    for words in [
        "equilibrium,",
        "4 states: x [m], theta [rad], der(x) [m/s]",
        "A =",
        "poles:",
        "zeros:",
    ] {
        assert!(text.contains(words), "{words}: {text}");
    }
}
