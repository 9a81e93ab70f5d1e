//! `lagrangian import` against stored results of Pinocchio and MuJoCo, and against a recursive Newton–Euler algorithm typed from a book.

use std::collections::hash_map::RandomState;
use std::f64::consts::PI;
use std::fmt::Write as _;
use std::hash::BuildHasher;
use std::path::Path;

use crate::support::{Scratch, lagrangian, root};
use nalgebra::{DMatrix, DVector, Matrix3, Matrix6, Vector3, Vector6};
use serde_json::{Value, json};

/// Tolerance relative to the largest number of a kind: about a thousand roundings.
const CLOSE: f64 = 1e-11;

const ROBOTS: [&str; 7] = [
    "arm",
    "leg",
    "hand",
    "slider",
    "floating",
    "planar",
    "quadruped",
];

fn robot(name: &str) -> String {
    format!("cli/tests/command/import/{name}.urdf")
}

/// Imports a file; returns the spec.
fn imported(path: &str, options: &[&str]) -> Scratch {
    let machine = Scratch::new("robot.machine", "");
    let output = lagrangian(&[&["import", path, "--out", machine.path()], options].concat());
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{path}: {said}");
    machine
}

/// Imports a text; returns the spec.
fn imported_text(text: &str, options: &[&str]) -> Scratch {
    imported(Scratch::new("robot.urdf", text).path(), options)
}

/// The results of `evaluate` at some points.
fn evaluated(machine: &Scratch, points: &Value) -> Vec<Value> {
    let at = Scratch::new("points.json", &points.to_string());
    let output = lagrangian(&["evaluate", machine.path(), "--at", at.path()]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// The names that an imported spec declares in a section.
fn names_under(section: &str, spec: &str) -> Vec<String> {
    let start = format!("    {section} {{\n");
    let inside = spec.split_once(&start).map_or("", |(_, rest)| rest);
    let inside = inside.split_once("    }").map_or("", |(inside, _)| inside);
    let entries = inside
        .lines()
        .filter(|line| !line.contains("///"))
        .flat_map(|line| line.split(','));
    entries
        .filter_map(|entry| entry.split_once(':'))
        .map(|(name, _)| name.trim().to_owned())
        .collect()
}

/// All numbers of a vector or a matrix.
fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(parts) => parts.iter().flat_map(numbers).collect(),
        value => vec![
            value
                .as_f64()
                .unwrap_or_else(|| panic!("no number: {value}")),
        ],
    }
}

fn assert_close(found: &[f64], truth: &[f64], scale: f64, what: &str) {
    assert_eq!(found.len(), truth.len(), "{what}");
    for (found, truth) in found.iter().zip(truth) {
        let off = (found - truth).abs();
        assert!(off <= CLOSE * scale, "{what}: {found:?}, not {truth:?}");
    }
}

fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |m, x| m.max(x.abs()))
}

/// The numbers were computed with Pinocchio 4.1.0; see `import/by_pinocchio.py`.
#[test]
fn robots_move_as_pinocchio_moves_them() {
    let path = root().join("cli/tests/command/import/pinocchio.json");
    let stored = std::fs::read_to_string(path).expect("a file");
    let stored: Value = serde_json::from_str(&stored).expect("JSON");
    for name in ROBOTS {
        let machine = imported(&robot(name), &[]);
        let states = stored[name].as_array().expect("states");
        let points: Vec<Value> = states
            .iter()
            .map(|state| json!({ "q": state["q"], "v": state["v"] }))
            .collect();
        let found = evaluated(&machine, &json!(points));
        assert_eq!(found.len(), 4, "{name}");
        for (found, truth) in found.iter().zip(states) {
            for quantity in ["mass_matrix", "bias", "applied", "accelerations"] {
                let truth = numbers(&truth[quantity]);
                let what = format!("{quantity} of {name}");
                assert_close(&numbers(&found[quantity]), &truth, largest(&truth), &what);
            }
        }
    }
}

/// The files of `import/real`, whose origins and licences are listed in its `README.md`: whether the base floats, further options for the import,
/// and the number of coordinates.
const REAL: [(&str, bool, &[&str], usize); 7] = [
    (
        "panda",
        false,
        &["--ignore", "D,K,mu_coulomb,mu_viscous"],
        8,
    ),
    ("baxter", false, &[], 17),
    ("two_dofs", false, &[], 2),
    ("borinot", true, &[], 8),
    ("hextilt", true, &[], 11),
    ("alexander", true, &[], 19),
    (
        "simple_humanoid",
        true,
        &["--ignore", "collision_checking"],
        35,
    ),
];

/// Tolerance for the difference from Pinocchio, relative to the largest acceleration. A rounding of 1.1e-16 in every entry of a mass matrix
/// changes the accelerations by its condition number, at most 1.8e3 there, which gives 2e-13; with as much again from the forces on either side it
/// is five times that. Pinocchio's own two algorithms differ by up to 2.6e-14.
const CLOSE_TO_PINOCCHIO: f64 = 1e-12;

/// The numbers were computed with Pinocchio 4.1.0; see `import/real/by_pinocchio.py`.
#[test]
fn real_robots_move_as_pinocchio_moves_them() {
    let folder = "cli/tests/command/import/real";
    let path = root().join(folder).join("pinocchio.json");
    let stored = std::fs::read_to_string(path).expect("a file");
    let stored: Value = serde_json::from_str(&stored).expect("JSON");
    assert_eq!(stored.as_object().expect("robots").len(), REAL.len());
    for (name, floats, options, count) in REAL {
        let base: &[&str] = if floats { &["--base", "floating"] } else { &[] };
        let shared = ["--friction", "none", "--drop-massless"];
        let options = [&shared, base, options].concat();
        let machine = imported(&format!("{folder}/{name}.urdf"), &options);
        let text = std::fs::read_to_string(&machine.0).expect("a file");
        let coordinates = names_under("coordinates", &text);
        assert_eq!(coordinates.len(), count, "{name}");
        // Pinocchio orders joints by name.
        let theirs = stored[name]["coordinates"].as_array().expect("names");
        assert_eq!(theirs.len(), count, "{name}");
        let place = |of: &String| {
            let mut names = theirs.iter();
            names.position(|name| name == of).expect("a coordinate")
        };
        let places: Vec<usize> = coordinates.iter().map(place).collect();
        let ordered = |values: &Value| -> Vec<f64> {
            let values = numbers(values);
            assert_eq!(values.len(), count, "{name}");
            places.iter().map(|&place| values[place]).collect()
        };
        let states = stored[name]["states"].as_array().expect("states");
        assert_eq!(states.len(), 20, "{name}");
        let points: Vec<Value> = states
            .iter()
            .map(|state| json!({ "q": ordered(&state["q"]), "v": ordered(&state["v"]) }))
            .collect();
        let found = evaluated(&machine, &json!(points));
        assert_eq!(found.len(), states.len(), "{name}");
        for (found, truth) in found.iter().zip(states) {
            let truth = ordered(&truth["accelerations"]);
            let found = numbers(&found["accelerations"]);
            assert_eq!(found.len(), count, "{name}");
            for ((a, b), coordinate) in found.iter().zip(&truth).zip(&coordinates) {
                let off = (a - b).abs() / largest(&truth);
                assert!(
                    off <= CLOSE_TO_PINOCCHIO,
                    "{coordinate} of {name}: {a:?}, not {b:?}, off by {off:.1e}"
                );
            }
        }
    }
}

/// Converts yaw, pitch and roll of the base and their rates to a quaternion and its rates; also returns the angular acceleration in body axes that
/// follows from these accelerations of the angles.
fn base_by_quaternion(
    angles: &[f64],
    rates: &[f64],
    second: &[f64],
) -> ([f64; 4], [f64; 4], [f64; 3]) {
    let half = |k: usize| (angles[k] / 2.0).sin_cos();
    let ((sy, cy), (sp, cp), (sr, cr)) = (half(0), half(1), half(2));
    // The product of the rotations about z, y and x.
    let e = [
        cy * cp * cr + sy * sp * sr,
        cy * cp * sr - sy * sp * cr,
        cy * sp * cr + sy * cp * sr,
        sy * cp * cr - cy * sp * sr,
    ];
    let ((sp, cp), (sr, cr)) = (angles[1].sin_cos(), angles[2].sin_cos());
    let [[y, p, r], [dy, dp, dr]] = [rates, second].map(|x| [x[0], x[1], x[2]]);
    let spin = [r - sp * y, cr * p + sr * cp * y, cr * cp * y - sr * p];
    let faster = [
        dr - sp * dy - cp * p * y,
        cr * dp + sr * cp * dy - sr * r * p + (cr * r * cp - sr * sp * p) * y,
        cr * cp * dy - sr * dp - (sr * r * cp + cr * sp * p) * y - cr * r * p,
    ];
    let [a, b, c] = spin.map(|w| w / 2.0);
    let rate = [
        -e[1] * a - e[2] * b - e[3] * c,
        e[0] * a + e[2] * c - e[3] * b,
        e[0] * b + e[3] * a - e[1] * c,
        e[0] * c + e[1] * b - e[2] * a,
    ];
    (e, rate, faster)
}

/// With a base rotated by a quaternion the same robots have the same accelerations: those of the joints, of the base's position, and of its
/// rotation. The angular acceleration of the base is twice the vector part of `ē∘ë` if the norm is constantly 1.
#[test]
fn real_robots_on_quaternions_move_as_pinocchio_moves_them() {
    let folder = "cli/tests/command/import/real";
    let path = root().join(folder).join("pinocchio.json");
    let stored = std::fs::read_to_string(path).expect("a file");
    let stored: Value = serde_json::from_str(&stored).expect("JSON");
    for (name, _, options, count) in REAL.into_iter().filter(|(_, floats, ..)| *floats) {
        let shared = [
            "--friction",
            "none",
            "--drop-massless",
            "--base",
            "floating",
        ];
        let options = [&shared[..], &["--ball", "quaternion"], options].concat();
        let machine = imported(&format!("{folder}/{name}.urdf"), &options);
        let text = std::fs::read_to_string(&machine.0).expect("a file");
        let coordinates = names_under("coordinates", &text);
        assert_eq!(coordinates.len(), count + 1, "{name}");
        let theirs = stored[name]["coordinates"].as_array().expect("names");
        let place = |of: &str| theirs.iter().position(|name| *name == of);
        let base = coordinates
            .iter()
            .find_map(|name| name.strip_suffix("_e0"))
            .expect("a base");
        let turn = ["yaw", "pitch", "roll"]
            .map(|word| place(&format!("{base}_{word}")).expect("an angle"));
        let states = stored[name]["states"].as_array().expect("states");
        let of_state = |state: &Value| {
            let [q, v, a] = ["q", "v", "accelerations"].map(|key| numbers(&state[key]));
            let angles = [&q, &v, &a].map(|x| turn.map(|k| x[k]));
            let (e, rate, faster) = base_by_quaternion(&angles[0], &angles[1], &angles[2]);
            let whole = |old: &[f64], four: &[f64; 4]| -> Vec<f64> {
                let mut four = four.iter();
                let one = |name: &String| match place(name) {
                    Some(k) => old[k],
                    None => *four.next().expect("one of four"),
                };
                coordinates.iter().map(one).collect()
            };
            (whole(&q, &e), whole(&v, &rate), a, e, faster)
        };
        let points: Vec<Value> = states
            .iter()
            .map(|state| {
                let (q, v, ..) = of_state(state);
                json!({ "q": q, "v": v })
            })
            .collect();
        let found = evaluated(&machine, &json!(points));
        for (found, state) in found.iter().zip(states) {
            let (_, _, truth, e, faster) = of_state(state);
            let found = numbers(&found["accelerations"]);
            let scale = largest(&truth).max(largest(&faster));
            let mut second = Vec::new();
            for (a, coordinate) in found.iter().zip(&coordinates) {
                match place(coordinate) {
                    Some(k) => {
                        let off = (a - truth[k]).abs() / scale;
                        assert!(
                            off <= CLOSE_TO_PINOCCHIO,
                            "{coordinate} of {name}: off by {off:.1e}"
                        );
                    }
                    None => second.push(*a),
                }
            }
            let [dw, dx, dy, dz] = [0, 1, 2, 3].map(|k| 2.0 * second[k]);
            let [w, x, y, z] = e;
            let turned = [
                w * dx - x * dw + z * dy - y * dz,
                w * dy - y * dw + x * dz - z * dx,
                w * dz - z * dw + y * dx - x * dy,
            ];
            for (a, b) in turned.iter().zip(faster) {
                let off = (a - b).abs() / scale;
                assert!(
                    off <= CLOSE_TO_PINOCCHIO,
                    "the base of {name}: {a:?}, not {b:?}, off by {off:.1e}"
                );
            }
        }
    }
}

/// Tolerance for the difference from MuJoCo, relative to the largest acceleration: MuJoCo computes principal axes to 1e-12 (`mju_eig3`).
const CLOSE_TO_MUJOCO: f64 = 1e-12;

/// The models of `import/mujoco`, and the number of coordinates of each.
const MODELS: [(&str, usize); 6] = [
    ("ant", 14),
    ("crane", 8),
    ("gripper", 5),
    ("half_cheetah", 9),
    ("hopper", 6),
    ("walker2d", 9),
];

/// The numbers were computed with MuJoCo 4.0.0; see `import/mujoco/by_mujoco.py`.
#[test]
fn models_move_as_mujoco_moves_them() {
    let folder = "cli/tests/command/import/mujoco";
    let path = root().join(folder).join("mujoco.json");
    let stored = std::fs::read_to_string(path).expect("a file");
    let stored: Value = serde_json::from_str(&stored).expect("JSON");
    for (name, coordinates) in MODELS {
        let machine = imported(&format!("{folder}/{name}.xml"), &[]);
        let states = stored[name].as_array().expect("states");
        let text = std::fs::read_to_string(&machine.0).expect("a file");
        let inputs = names_under("inputs", &text);
        let points: Vec<Value> = states
            .iter()
            .map(|state| {
                let values = numbers(&state["inputs"]);
                let set = inputs.iter().zip(values);
                let set: serde_json::Map<String, Value> = set
                    .map(|(name, value)| (name.clone(), json!(value)))
                    .collect();
                json!({ "q": state["q"], "v": state["v"], "inputs": set })
            })
            .collect();
        let found = evaluated(&machine, &json!(points));
        assert_eq!(found.len(), 3, "{name}");
        for (found, truth) in found.iter().zip(states) {
            assert_eq!(inputs.len(), numbers(&truth["inputs"]).len(), "{name}");
            let truth = numbers(&truth["accelerations"]);
            let found = numbers(&found["accelerations"]);
            assert_eq!(found.len(), coordinates, "{name}");
            for (a, b) in found.iter().zip(&truth) {
                let off = (a - b).abs() / largest(&truth);
                assert!(
                    off <= CLOSE_TO_MUJOCO,
                    "{name}: {a:?}, not {b:?}, off by {off:.1e}"
                );
            }
        }
    }
}

/// Loops closed by `connect` and `weld`, with an offset and an angle between the bodies; the keyframe `home` is the start. The numbers
/// were computed as `import/mujoco/loops/by_mujoco.py` describes, to about 1e-10 of the largest; finite differences of the gradients have
/// the largest error.
#[test]
fn loops_move_as_mujoco_says() {
    let folder = "cli/tests/command/import/mujoco/loops";
    let stored = std::fs::read_to_string(root().join(folder).join("loops.json")).expect("a file");
    let stored: Value = serde_json::from_str(&stored).expect("JSON");
    let machine = imported(&format!("{folder}/arms.xml"), &[]);
    let states = stored["arms"].as_array().expect("states");
    let points: Vec<Value> = states
        .iter()
        .map(|state| {
            let u = numbers(&state["inputs"]);
            let inputs = json!({ "drive": u[0], "hold": u[1] });
            json!({ "q": state["q"], "v": state["v"], "inputs": inputs })
        })
        .collect();
    let found = evaluated(&machine, &json!(points));
    assert_eq!(found.len(), 3);
    for (found, truth) in found.iter().zip(states) {
        let truth = numbers(&truth["accelerations"]);
        let found = numbers(&found["accelerations"]);
        assert_eq!(found.len(), 12);
        for (a, b) in found.iter().zip(&truth) {
            let off = (a - b).abs() / largest(&truth);
            assert!(off <= 1e-10, "{a:?}, not {b:?}, off by {off:.1e}");
        }
    }
    let text = std::fs::read_to_string(&machine.0).expect("a file");
    for line in [
        "qa1: rad = 0.1,",
        "qa3: rad = 0.25,",
        "der(qa2): rad/s = 0.5,",
        "der(c3): rad/s = -0.25,",
        "drive: N*m = 0.5,",
        "hold: rad = 0.125,",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
    // Without the keyframe the machine starts with all joints at zero.
    let machine = imported(&format!("{folder}/arms.xml"), &["--ignore", "keyframe"]);
    let text = std::fs::read_to_string(&machine.0).expect("a file");
    assert!(text.contains("qa3: rad = 0.15,") && text.contains("1 element `keyframe`"));
}

/// Two bodies of a weld that start rotated by 180° from `relpose`: right angles between their axes hold there too, but the residual
/// `efc_pos` of MuJoCo 4.0.0 is not zero. By 120° they do not hold, and no small change restores them. Rotated as `relpose` states,
/// the bodies move.
#[test]
fn a_weld_holds_in_one_orientation_only() {
    let model = |relpose: &str| {
        format!(
            "<mujoco><worldbody><body name=\"door\"><joint name=\"hinge\" axis=\"0 1 0\"/><geom size=\"0.1\" pos=\"0.1 0 0\"/></body>\
             <body name=\"brick\" pos=\"1 0 0\"><freejoint/><geom type=\"box\" size=\"0.1 0.2 0.3\"/></body></worldbody>\
             <equality><weld body1=\"door\" body2=\"brick\" relpose=\"1 0 0 {relpose}\"/></equality></mujoco>"
        )
    };
    for (relpose, start, error) in [
        ("0 1 0 0", &[][..], "the machine assumes"),
        ("1 1 1 1", &[], "cannot be met near the state at t = 0 s"),
        ("1 0 0 0", &[], ""),
        (
            "0 1 0 0",
            &["--start", "brick_joint_e0=0", "--start", "brick_joint_e1=1"],
            "",
        ),
    ] {
        let machine = imported_model(&model(relpose), &[], &["--ball", "quaternion"]);
        let call = ["simulate", machine.path(), "--until", "0.1"];
        let run = lagrangian(&[&call, start].concat());
        let said = String::from_utf8_lossy(&run.stderr);
        let is_met = error.is_empty();
        assert_eq!(run.status.success(), is_met, "{relpose} {start:?}: {said}");
        assert!(said.contains(error), "{relpose} {start:?}: {said}");
    }
}

/// A parallelogram whose cranks fall over: across its plane its pins always meet. With moments 2·0.0325 kg m² about the pivots and a coupler
/// of 2 kg that moves on a circle of 0.3 m, (0.065 + 2·0.3²) α = g (2·0.15 + 2·0.3) sin φ.
#[test]
fn conditions_of_a_loop_that_always_hold_are_left_out() {
    let crank = "<inertial pos=\"0 0 0.15\" mass=\"1\" diaginertia=\"0.01 0.01 0.001\"/>";
    let text = format!(
        "<mujoco><worldbody>\
         <body name=\"a\"><joint name=\"first\" axis=\"0 1 0\"/>{crank}\
         <body name=\"b\" pos=\"0 0 0.3\"><joint name=\"second\" axis=\"0 1 0\"/>\
         <inertial pos=\"0.25 0 0\" mass=\"2\" diaginertia=\"0.01 0.04 0.04\"/></body></body>\
         <body name=\"c\" pos=\"0.5 0 0\"><joint name=\"third\" axis=\"0 1 0\"/>{crank}</body></worldbody>\
         <equality><connect body1=\"b\" body2=\"c\" anchor=\"0.5 0 0\"/></equality></mujoco>"
    );
    let machine = imported_model(&text, &[], &[]);
    let check = lagrangian(&["check", machine.path(), "--deny-warnings"]);
    let said = String::from_utf8_lossy(&check.stdout);
    let freedom = "3 coordinates, 2 constraints, 1 degree of freedom";
    assert!(check.status.success() && said.contains(freedom), "{said}");
    let angle = 0.2_f64;
    let point =
        json!([{ "q": { "first": angle, "second": -angle, "third": angle }, "v": [0, 0, 0] }]);
    let found = numbers(&evaluated(&machine, &point)[0]["accelerations"]);
    let expected = 9.81 * 0.9 * angle.sin() / 0.245;
    for (found, sign) in found.iter().zip([1.0, -1.0, 1.0]) {
        // Some hundred roundings.
        assert!(
            (found - sign * expected).abs() < 1e-13 * expected,
            "{found} {expected}"
        );
    }
}

/// A free body starts at the pose of `home`, whether it is rotated by some choice of angles or by a quaternion.
#[test]
fn a_free_body_starts_where_home_says() {
    let text = "<mujoco><worldbody><body name=\"brick\" pos=\"0 0 3\"><freejoint/>\
                <inertial pos=\"0 0 0\" mass=\"2\" diaginertia=\"1 2 3\"/></body></worldbody>\
                <keyframe><key name=\"home\" qpos=\"1 2 0.5 2 0 0 2\"/></keyframe></mujoco>";
    for (ball, starts) in [
        ("zyx", &["brick_joint_yaw: rad = pi/2,"][..]),
        (
            "quaternion",
            &["e0: 1 = 0.7071067811865475", "e3: 1 = 0.7071067811865475"],
        ),
    ] {
        let machine = imported_model(text, &[], &["--ball", ball]);
        let spec = std::fs::read_to_string(&machine.0).expect("a file");
        for start in ["x: m = 1,", "y: m = 2,", "z: m = 0.5,"]
            .iter()
            .chain(starts)
        {
            assert!(spec.contains(start), "{start}: {spec}");
        }
    }
}

#[test]
fn specs_are_whole_and_always_the_same() {
    for name in ROBOTS {
        for options in [&[][..], &["--limits", "assume"], &["--limits", "stop"]] {
            let machine = imported(&robot(name), options);
            let check = lagrangian(&["check", machine.path(), "--deny-warnings"]);
            let said = String::from_utf8_lossy(&check.stderr);
            assert!(check.status.success(), "{name} {options:?}: {said}");
            let text = std::fs::read(&machine.0).expect("a file");
            let printed = lagrangian(&[&["import", &robot(name)], options].concat());
            assert_eq!(printed.stdout, text, "{name}");
        }
    }
}

/// The random number generator Splitmix64.
struct Draw(u64);

impl Draw {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, bound: usize) -> usize {
        (self.bits() % bound as u64) as usize
    }

    /// A random number between two numbers, rounded to the decimals that files contain.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        let text = format!("{:.3}", low + unit * (high - low));
        text.parse().expect("a number")
    }

    fn vector(&mut self, size: f64) -> Vector3<f64> {
        Vector3::from_fn(|_, _| self.between(-size, size))
    }
}

fn about(u: &Vector3<f64>, angle: f64) -> Matrix3<f64> {
    // Rodrigues' formula.
    let k = u.cross_matrix();
    Matrix3::identity() + k * angle.sin() + k * k * (1.0 - angle.cos())
}

fn of_rpy(rpy: &Vector3<f64>) -> Matrix3<f64> {
    let about = |axis: usize| about(&Vector3::ith(axis, 1.0), rpy[axis]);
    about(2) * about(1) * about(0)
}

/// A link on a joint with at most one coordinate, and the pose of the joint's frame relative to the parent.
struct Link {
    parent: Option<usize>,
    turned: Matrix3<f64>,
    at: Vector3<f64>,
    motion: Motion,
    coordinate: String,
    damping: f64,
    inertia: Matrix6<f64>,
}

#[derive(Clone, Copy)]
enum Motion {
    None,
    Turn(Vector3<f64>),
    Slide(Vector3<f64>),
}

impl Link {
    /// Featherstone, *Rigid Body Dynamics Algorithms* (2008), eq. 2.24: the transform of motion vectors from the parent's axes to the link's.
    fn transform(&self, q: f64) -> Matrix6<f64> {
        let (turn, slide) = match self.motion {
            Motion::None => (Matrix3::identity(), Vector3::zeros()),
            Motion::Turn(u) => (about(&u, q), Vector3::zeros()),
            Motion::Slide(u) => (Matrix3::identity(), u * q),
        };
        let e = (self.turned * turn).transpose();
        let at = self.at + self.turned * slide;
        blocks(e, Matrix3::zeros(), -e * at.cross_matrix(), e)
    }

    /// The joint's motion subspace: the spatial velocity per unit rate of the coordinate.
    fn subspace(&self) -> Vector6<f64> {
        match self.motion {
            Motion::None => Vector6::zeros(),
            Motion::Turn(u) => Vector6::new(u[0], u[1], u[2], 0.0, 0.0, 0.0),
            Motion::Slide(u) => Vector6::new(0.0, 0.0, 0.0, u[0], u[1], u[2]),
        }
    }
}

fn blocks(a: Matrix3<f64>, b: Matrix3<f64>, c: Matrix3<f64>, d: Matrix3<f64>) -> Matrix6<f64> {
    let parts = [[a, b], [c, d]];
    Matrix6::from_fn(|i, j| parts[i / 3][j / 3][(i % 3, j % 3)])
}

/// Featherstone, eq. 2.63, from mass, mass centre, and the tensor about it.
fn spatial_inertia(mass: f64, centre: &Vector3<f64>, tensor: &Matrix3<f64>) -> Matrix6<f64> {
    let c = centre.cross_matrix();
    blocks(
        tensor + mass * c * c.transpose(),
        mass * c,
        mass * c.transpose(),
        Matrix3::identity() * mass,
    )
}

/// Featherstone, eq. 2.31: the matrix v ×; that of v ×* is the negative of its transpose.
fn cross(v: &Vector6<f64>) -> Matrix6<f64> {
    let (angular, linear) = (
        Vector3::new(v[0], v[1], v[2]),
        Vector3::new(v[3], v[4], v[5]),
    );
    let (w, l) = (angular.cross_matrix(), linear.cross_matrix());
    blocks(w, Matrix3::zeros(), l, w)
}

/// Featherstone, table 5.1: the forces along the coordinates that produce these accelerations under gravity `g`, one number per link.
fn newton_euler(links: &[Link], q: &[f64], v: &[f64], a: &[f64], g: f64) -> Vec<f64> {
    let ground = Vector6::new(0.0, 0.0, 0.0, 0.0, 0.0, g);
    let mut velocity: Vec<Vector6<f64>> = Vec::new();
    let mut acceleration: Vec<Vector6<f64>> = Vec::new();
    let mut force: Vec<Vector6<f64>> = Vec::new();
    for (i, link) in links.iter().enumerate() {
        let (x, s) = (link.transform(q[i]), link.subspace());
        let above = link
            .parent
            .map_or(Vector6::zeros(), |parent| velocity[parent]);
        let pulled = link.parent.map_or(ground, |parent| acceleration[parent]);
        let own = x * above + s * v[i];
        let gained = x * pulled + s * a[i] + cross(&own) * s * v[i];
        force.push(link.inertia * gained - cross(&own).transpose() * link.inertia * own);
        velocity.push(own);
        acceleration.push(gained);
    }
    let mut along = vec![0.0; links.len()];
    for (i, link) in links.iter().enumerate().rev() {
        along[i] = link.subspace().dot(&force[i]);
        if let Some(parent) = link.parent {
            let passed = link.transform(q[i]).transpose() * force[i];
            force[parent] += passed;
        }
    }
    along
}

fn spoken(v: &Vector3<f64>) -> String {
    format!("{} {} {}", v[0], v[1], v[2])
}

/// A random robot as a file, and its links.
fn tree(draw: &mut Draw) -> (String, Vec<Link>) {
    let mut text = "<robot name=\"tree\"><link name=\"ground\"/>\n".to_owned();
    // For each joint of the file, its last link and its name.
    let mut ends: Vec<(Option<usize>, String)> = vec![(None, "ground".to_owned())];
    let mut links = Vec::new();
    for number in 0..2 + draw.below(3) {
        let (parent, parent_name) = ends[draw.below(ends.len())].clone();
        let kind = match draw.below(10) {
            _ if number == 0 => "continuous",
            0..=4 => "continuous",
            5..=7 => "prismatic",
            8 => "fixed",
            _ => "spherical",
        };
        let axis = match draw.below(3) {
            // An axis of the frame, or one in a coordinate plane.
            0 => Vector3::ith(draw.below(3), if draw.below(2) == 0 { 2.0 } else { -1.0 }),
            1 => {
                let mut axis = draw.vector(1.0);
                axis[draw.below(3)] = 0.0;
                axis
            }
            _ => draw.vector(1.0),
        };
        let axis = if axis.norm() < 0.1 {
            Vector3::z()
        } else {
            axis
        };
        let (at, rpy) = (draw.vector(0.5), draw.vector(3.0));
        let (mass, centre, turned) = (draw.between(0.2, 3.0), draw.vector(0.2), draw.vector(2.0));
        // Every physical tensor comes from second moments: trace 1 - S, with S from three points.
        let spread = draw.vector(0.3);
        let cross_spread = draw.vector(0.1);
        let s = Matrix3::from_diagonal(&spread.map(|x| x * x + 0.01))
            + cross_spread * cross_spread.transpose();
        let tensor = (Matrix3::identity() * s.trace() - s).map(|entry| {
            let text = format!("{entry:.6}");
            text.parse::<f64>().expect("a number")
        });
        let damping = if kind == "continuous" {
            draw.between(0.0, 0.5)
        } else {
            0.0
        };
        let _ = writeln!(
            text,
            "<link name=\"l{number}\"><inertial><origin xyz=\"{}\" rpy=\"{}\"/><mass value=\"{mass}\"/><inertia ixx=\"{}\" iyy=\"{}\" \
             izz=\"{}\" ixy=\"{}\" ixz=\"{}\" iyz=\"{}\"/></inertial></link>\n<joint name=\"j{number}\" type=\"{kind}\"><origin \
             xyz=\"{}\" rpy=\"{}\"/><parent link=\"{parent_name}\"/><child link=\"l{number}\"/><axis xyz=\"{}\"/>{}</joint>",
            spoken(&centre),
            spoken(&turned),
            tensor[(0, 0)],
            tensor[(1, 1)],
            tensor[(2, 2)],
            tensor[(0, 1)],
            tensor[(0, 2)],
            tensor[(1, 2)],
            spoken(&at),
            spoken(&rpy),
            spoken(&axis),
            if damping == 0.0 {
                String::new()
            } else {
                format!("<dynamics damping=\"{damping}\"/>")
            },
        );
        let u = axis.normalize();
        let own = |suffix: &str| format!("j{number}{suffix}");
        let motions = match kind {
            "continuous" => vec![(Motion::Turn(u), own(""))],
            "prismatic" => vec![(Motion::Slide(u), own(""))],
            "fixed" => vec![(Motion::None, String::new())],
            _ => ["x", "y", "z"]
                .into_iter()
                .enumerate()
                .map(|(axis, name)| {
                    (
                        Motion::Turn(Vector3::ith(axis, 1.0)),
                        own(&format!("_about_{name}")),
                    )
                })
                .collect(),
        };
        let count = motions.len();
        let axes = of_rpy(&turned);
        let inertia = spatial_inertia(mass, &centre, &(axes * tensor * axes.transpose()));
        for (place, (motion, coordinate)) in motions.into_iter().enumerate() {
            links.push(Link {
                parent: if place == 0 {
                    parent
                } else {
                    Some(links.len() - 1)
                },
                turned: if place == 0 {
                    of_rpy(&rpy)
                } else {
                    Matrix3::identity()
                },
                at: if place == 0 { at } else { Vector3::zeros() },
                motion,
                coordinate,
                damping,
                inertia: if place + 1 == count {
                    inertia
                } else {
                    Matrix6::zeros()
                },
            });
        }
        ends.push((Some(links.len() - 1), format!("l{number}")));
    }
    text.push_str("</robot>\n");
    (text, links)
}

/// The coordinates in the order of the spec: depth first, and siblings in the order of the file.
fn in_order(links: &[Link], parent: Option<usize>, order: &mut Vec<usize>) {
    for (index, link) in links
        .iter()
        .enumerate()
        .filter(|(_, link)| link.parent == parent)
    {
        if !link.coordinate.is_empty() {
            order.push(index);
        }
        in_order(links, Some(index), order);
    }
}

#[test]
fn random_trees_move_as_newton_and_euler_say() {
    let seed = std::env::var("IMPORT_SEED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    let seed = seed.unwrap_or_else(|| RandomState::new().hash_one(0));
    println!("IMPORT_SEED={seed}");
    let mut draw = Draw(seed);
    for number in 0..30 {
        let (text, links) = tree(&mut draw);
        let mut order = Vec::new();
        in_order(&links, None, &mut order);
        let [q, v] = [(); 2]
            .map(|()| -> Vec<f64> { links.iter().map(|_| draw.between(-1.2, 1.2)).collect() });
        let named = |values: &[f64]| -> Value {
            order
                .iter()
                .map(|i| (links[*i].coordinate.clone(), json!(values[*i])))
                .collect()
        };
        let machine = imported_text(&text, &[]);
        let found = evaluated(&machine, &json!([{ "q": named(&q), "v": named(&v) }])).remove(0);
        let along = |values: Vec<f64>| -> Vec<f64> { order.iter().map(|i| values[*i]).collect() };
        let zero = vec![0.0; links.len()];
        let n = order.len();
        let columns: Vec<f64> = order
            .iter()
            .flat_map(|i| {
                let mut unit = zero.clone();
                unit[*i] = 1.0;
                along(newton_euler(&links, &q, &zero, &unit, 0.0))
            })
            .collect();
        let bias = along(newton_euler(&links, &q, &v, &zero, 0.0));
        let weight = along(newton_euler(&links, &q, &zero, &zero, 9.81));
        let applied: Vec<f64> = order
            .iter()
            .zip(weight)
            .map(|(i, weight)| -weight - links[*i].damping * v[*i])
            .collect();
        let what = |quantity: &str| format!("{quantity} of tree {number} of seed {seed}\n{text}");
        let mass = numbers(&found["mass_matrix"]);
        assert_close(&mass, &columns, largest(&columns), &what("mass matrix"));
        assert_close(
            &numbers(&found["bias"]),
            &bias,
            largest(&bias).max(1.0),
            &what("bias"),
        );
        let forces = largest(&applied).max(1.0);
        assert_close(
            &numbers(&found["applied"]),
            &applied,
            forces,
            &what("applied"),
        );
        // Compares forces instead of solving the equations, so that no condition number enters.
        let a = numbers(&found["accelerations"]);
        let needed = DMatrix::from_vec(n, n, columns.clone()) * DVector::from_vec(a.clone());
        let given: Vec<f64> = applied.iter().zip(&bias).map(|(f, h)| f - h).collect();
        let scale = largest(&columns) * largest(&a) + forces + largest(&bias);
        assert_close(needed.as_slice(), &given, scale, &what("accelerations"));
    }
}

/// A pendulum of mass 2 at 0.5 below its joint, with additional contents of the joint element.
fn pendulum(kind: &str, inner: &str) -> String {
    format!(
        "<robot name=\"pendulum\">\n<link name=\"base\"/>\n<link name=\"bob\"><inertial><origin xyz=\"0 0 -0.5\"/><mass \
         value=\"2\"/><inertia ixx=\"0\" iyy=\"0\" izz=\"0\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n<joint \
         name=\"pivot\" type=\"{kind}\"><parent link=\"base\"/><child link=\"bob\"/>\n{inner}</joint>\n</robot>\n"
    )
}

/// The message with which a text is refused; no file may be written.
fn refused(text: &str, options: &[&str]) -> String {
    let file = Scratch::new("robot.urdf", text);
    let machine = file.0.with_file_name("robot.machine");
    let out = machine.to_str().expect("text");
    let output = lagrangian(&[&["import", file.path(), "--out", out], options].concat());
    let said = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(1), "{text}\n{said}");
    assert!(!machine.exists(), "{text}");
    said
}

#[test]
fn friction_is_refused_left_out_or_smooth() {
    let text = pendulum(
        "continuous",
        "<axis xyz=\"0 1 0\"/><dynamics friction=\"0.3\"/>",
    );
    let said = refused(&text, &[]);
    assert!(
        said.contains("robot.urdf:4:1: joint \"pivot\" has friction"),
        "{said}"
    );
    let points = json!([{ "q": [0.4], "v": [0.002] }, { "q": [0.4], "v": [-7.0] }]);
    let weight = -2.0 * 9.81 * 0.5 * 0.4_f64.sin();
    for (option, friction) in [("none", 0.0), ("smooth=2e-3", 0.3)] {
        let machine = imported_text(&text, &["--friction", option]);
        for (found, v) in evaluated(&machine, &points).iter().zip([0.002, -7.0_f64]) {
            let exact = weight - friction * v / v.hypot(2e-3);
            assert_close(&numbers(&found["applied"]), &[exact], 10.0, option);
        }
    }
    let slides = pendulum("prismatic", "<dynamics friction=\"0.3\"/>");
    let machine = imported_text(&slides, &["--friction", "smooth=0.5"]);
    let found = evaluated(&machine, &json!([{ "v": [0.5] }])).remove(0);
    assert_close(
        &numbers(&found["applied"]),
        &[-0.3 / 2_f64.sqrt()],
        1.0,
        "a slide",
    );
}

#[test]
fn limits_are_comments_facts_or_stops() {
    let inner =
        "<axis xyz=\"0 1 0\"/><limit lower=\"0.5\" upper=\"2\" effort=\"3\" velocity=\"4\"/>";
    let text = pendulum("revolute", inner);
    let run = |options: &[&str], start: &[&str]| {
        let machine = imported_text(&text, options);
        let call = [
            &["simulate", machine.path(), "--until", "3", "--json"],
            start,
        ]
        .concat();
        let output = lagrangian(&call);
        let result: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        (result, std::fs::read_to_string(&machine.0).expect("a file"))
    };
    let start = ["--start", "pivot=1.5"];
    let (result, spec) = run(&[], &start);
    assert!(
        spec.contains("between 0.5 and 2 rad; velocity up to 4"),
        "{spec}"
    );
    assert_eq!(result["events"], json!([]));
    let (result, spec) = run(&["--limits", "assume"], &start);
    assert!(spec.contains("pivot: rad = 0.5,"), "{spec}");
    assert!(
        result.to_string().contains("pivot >= pivot_lower"),
        "{result}"
    );
    // The stop dissipates its energy, and its weight holds it against the stop.
    let (result, _) = run(&["--limits", "stop"], &start);
    let pivot = result["q"]["pivot"].as_f64().expect("a number");
    assert!((pivot - 0.5).abs() <= 1e-9, "{result}");
}

#[test]
fn what_moves_no_mass_is_refused_or_dropped() {
    let joint = "<link name=\"end\"/><link name=\"tip\"/><joint name=\"flap\" type=\"continuous\"><parent link=\"bob\"/><child \
                 link=\"end\"/></joint><joint name=\"fix\" type=\"fixed\"><parent link=\"end\"/><child link=\"tip\"/></joint></robot>";
    let text = pendulum("continuous", "<axis xyz=\"0 1 0\"/>").replace("</robot>", joint);
    let said = refused(&text, &[]);
    assert!(said.contains("joint \"flap\" moves no mass"), "{said}");
    let machine = imported_text(&text, &["--drop-massless"]);
    let found = evaluated(&machine, &json!([{ "q": [PI / 2.0] }])).remove(0);
    // m l² and m g l.
    assert_close(&numbers(&found["mass_matrix"]), &[0.5], 0.5, "inertia");
    assert_close(
        &numbers(&found["accelerations"]),
        &[-9.81 / 0.5],
        20.0,
        "acceleration",
    );
}

/// A floating root is equivalent to a root on a floating joint.
#[test]
fn a_base_may_float() {
    let body = "<link name=\"box\"><inertial><origin xyz=\"0.1 0 0\"/><mass value=\"2\"/><inertia ixx=\"0.1\" iyy=\"0.2\" izz=\"0.25\" \
                ixy=\"0\" ixz=\"0\" iyz=\"0.01\"/></inertial></link>";
    let alone = format!("<robot name=\"r\">{body}</robot>");
    let joined = format!(
        "<robot name=\"r\"><link name=\"w\"/>{body}<joint name=\"box\" type=\"floating\"><parent link=\"w\"/><child \
         link=\"box\"/></joint></robot>"
    );
    assert!(refused(&alone, &[]).contains("nothing moves"));
    let points = json!([{ "q": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6], "v": [1, 2, 3, 4, 5, 6] }]);
    let energy =
        |text: &str, options: &[&str]| evaluated(&imported_text(text, options), &points).remove(0);
    for ball in ["xyz", "zyx", "zxz"] {
        let found = energy(&alone, &["--base", "floating", "--ball", ball]);
        assert_eq!(found, energy(&joined, &["--ball", ball]));
        // The centre is in free fall, however the body rotates.
        let mass = numbers(&found["mass_matrix"]);
        let weight = numbers(&found["applied"]);
        assert_close(
            &[mass[0], mass[7], mass[14], weight[2]],
            &[2.0, 2.0, 2.0, -19.62],
            1.0,
            ball,
        );
    }
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let base = pendulum("continuous", "<axis xyz=\"0 1 0\"/>");
    let with = |from: &str, to: &str| base.replacen(from, to, 1);
    for (text, words) in [
        (with("\"2\"", "\"2,5\""), "3:65: `value` of link \"bob\": `2,5` is not a number"),
        (with("\"2\"", "\"-2\""), "the mass of link \"bob\" is negative"),
        (with("\"2\"", "\"nan\""), "is not a number"),
        (with("0 0 -0.5", "0 -0.5"), "three numbers are expected, but there are 2"),
        (with("izz=\"0\"", "izz=\"0.1\""), "for a body none can exceed the sum of the other two"),
        (with("izz=\"0\" ", ""), "`inertia` of link \"bob\" lacks `izz`"),
        (with("<mass value=\"2\"/>", ""), "`inertial` of link \"bob\" lacks `mass`"),
        (with("continuous", "hinge"), "4:27: the type \"hinge\" of joint \"pivot\" is not known: there are revolute"),
        (with("<child link=\"bob\"/>", ""), "joint \"pivot\" has no child"),
        (with("<child link=\"bob\"/>", "<child link=\"b\"/>"), "there is no such link"),
        (with("<link name=\"base\"/>", "<link name=\"base\"/><link name=\"bob\"/>"), "there are two links \"bob\""),
        (with("<link name=\"base\"/>", "<link name=\"base\"/><link name=\"c\"/>"), "both have no parent"),
        (with("0 1 0", "0 0 0"), "has no direction"),
        (with("0 1 0\"/>", "0 1 0\"/><spring k=\"1\"/>"), "5:20: `spring` of joint \"pivot\" is not known"),
        (with("0 1 0\"/>", "0 1 0\"/><dynamics armature=\"1\"/>"), "`armature` of `dynamics` of joint \"pivot\""),
        (with("0 1 0\"/>", "0 1 0\"/><mimic joint=\"p\"/>"), "mimics \"p\", but there is no such joint"),
        (with("0 1 0\"/>", "0 1 0\"/><mimic joint=\"pivot\"/>"), "in a closed loop"),
        (with("<robot", "<mujoco"), "invalid XML"),
        ("<mujoco/>".to_owned(), "this is MJCF: give its file the ending `.xml`"),
        ("<robot name=\"r\"><link name=\"a\"".to_owned(), "1:"),
        (String::new(), "invalid XML"),
        (
            format!("<robot name=\"r\">\n<link{}/></robot>", " a='1'".repeat(1001)),
            "2:1: an element has more than 1000 attributes",
        ),
        ("<robot name=\"r\"/>".to_owned(), "the robot has no links"),
        (
            "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\"><xacro:include filename=\"a\"/></robot>".to_owned(),
            "macros",
        ),
        ("<!DOCTYPE a [<!ENTITY b \"c\">]><robot/>".to_owned(), "invalid XML"),
        (
            "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child \
             link=\"b\"/></joint><joint name=\"k\" type=\"fixed\"><parent link=\"b\"/><child link=\"a\"/></joint></robot>"
                .to_owned(),
            "form a closed loop without a root",
        ),
    ] {
        let said = refused(&text, &[]);
        assert!(said.contains(words), "{words:?} is not in {said:?}");
    }
    let spring = with("0 1 0\"/>", "0 1 0\"/><spring k=\"1\"/>");
    // A joint that mimics one that is omitted, with a massive link.
    let hanging = |name: &str, parent: &str, inner: &str| {
        format!(
            "<link name=\"{name}\"/><joint name=\"{name}\" type=\"continuous\"><parent link=\"{parent}\"/><child \
             link=\"{name}\"/>{inner}</joint>"
        )
    };
    let led = with("<axis xyz=\"0 1 0\"/>", "<mimic joint=\"second\"/>");
    let led = led.replace(
        "</robot>",
        &format!(
            "{}{}</robot>",
            hanging("first", "base", ""),
            hanging("second", "first", "")
        ),
    );
    let said = refused(&led, &["--drop-massless"]);
    assert!(
        said.contains("\"pivot\" mimics \"second\", which is attached to"),
        "{said}"
    );
    for (gazebo, is_refused) in [
        ("<gravity>true</gravity>", false),
        ("<gravity>0</gravity>", true),
        ("<turnGravityOff>false</turnGravityOff>", false),
        ("<springStiffness>2</springStiffness>", true),
        ("<plugin name=\"p\"><rate>5</rate></plugin>", false),
    ] {
        let text = base.replace("</robot>", &format!("<gazebo>{gazebo}</gazebo></robot>"));
        if is_refused {
            assert!(
                refused(&text, &[]).contains("--ignore gazebo leaves it out"),
                "{gazebo}"
            );
        }
        let options = if is_refused {
            &["--ignore", "gazebo"][..]
        } else {
            &[]
        };
        let spec = std::fs::read_to_string(&imported_text(&text, options).0).expect("a file");
        assert!(
            spec.contains("/// Not carried over: 1 element `gazebo`."),
            "{spec}"
        );
    }
    let machine = imported_text(&spring, &["--ignore", "spring"]);
    let spec = std::fs::read_to_string(&machine.0).expect("a file");
    assert!(
        spec.contains("/// Not carried over: 1 element `spring`."),
        "{spec}"
    );
}

/// A MuJoCo model with this content within its body, and after it.
fn model(body: &str, rest: &str) -> String {
    format!("<mujoco>\n<worldbody><body name=\"bob\">{body}</body></worldbody>\n{rest}</mujoco>\n")
}

/// Imports a MuJoCo model, with files beside it.
fn imported_model(text: &str, files: &[(&str, &[u8])], options: &[&str]) -> Scratch {
    let model = Scratch::new("model.xml", text);
    for (name, content) in files {
        std::fs::write(model.0.with_file_name(name), content).expect("a file");
    }
    imported(model.path(), options)
}

const SWING: &str = "<joint name=\"pivot\" axis=\"0 1 0\"/>";

const WEIGHT: &str = "<inertial pos=\"0 0 -0.5\" mass=\"2\" diaginertia=\"0 0 0\"/>";

#[test]
fn what_is_wrong_with_a_model_is_told_with_its_place() {
    let swing = format!("{SWING}{WEIGHT}");
    let mut missed = Vec::new();
    for (text, words) in [
        (
            model(&swing.replace("\"2\"", "\"2,5\""), ""),
            "2:94: `mass` of body \"bob\": `2,5` is not a number",
        ),
        (
            model(&swing.replace("0 1 0", "0 0 0"), ""),
            "the axis of joint \"pivot\" has no direction",
        ),
        (
            model(&swing.replace("name", "type=\"screw\" name"), ""),
            "the type \"screw\" of joint \"pivot\" is not known",
        ),
        (
            model(&swing.replace("name", "class=\"c\" name"), ""),
            "there is no class \"c\"",
        ),
        (
            model(&swing.replace("name", "quat=\"1 0 0 0\" name"), ""),
            "`quat` of `joint` of joint \"pivot\" is not supported",
        ),
        (
            model(&swing.replace("name", "frictionloss=\"1\" name"), ""),
            "joint \"pivot\" has friction",
        ),
        (
            model(&format!("{SWING}<freejoint/>{WEIGHT}"), ""),
            "it must be the only joint of a body of the world",
        ),
        (
            model(&format!("<joint type=\"ball\" damping=\"1\"/>{WEIGHT}"), ""),
            "`damping` of a joint without a name belongs to a ball joint",
        ),
        (model(SWING, ""), "joint \"pivot\" moves no mass"),
        (
            model(&format!("{SWING}<geom size=\"-1\"/>"), ""),
            "1 positive numbers are expected for a sphere",
        ),
        (
            model(&format!("{SWING}<geom type=\"mesh\" mesh=\"m\"/>"), ""),
            "there is no mesh \"m\"",
        ),
        (
            model(
                &format!("{SWING}<geom type=\"mesh\" mesh=\"m\"/>"),
                "<asset><mesh name=\"m\" file=\"m.stl\"/></asset>",
            ),
            "cannot read",
        ),
        (
            model(&swing, "<option density=\"1.2\"/>"),
            "`density` of a fluid changes the motion",
        ),
        (
            model(&swing, "<option><flag damper=\"disable\"/></option>"),
            "`damper` is switched off",
        ),
        (
            model(&swing, "<actuator><motor joint=\"p\"/></actuator>"),
            "is \"p\", but there is no such joint",
        ),
        (
            model(&swing, "<actuator><muscle joint=\"pivot\"/></actuator>"),
            "`muscle` of the actuators is not supported",
        ),
        (
            model(
                &swing,
                "<actuator><general joint=\"pivot\" dyntype=\"filter\"/></actuator>",
            ),
            "`dyntype` of a general without a name is \"filter\"",
        ),
        (
            model(&swing, "<equality><flex flex=\"bob\"/></equality>"),
            "3:11: `flex` of the equality constraints is not supported",
        ),
        (
            model(&swing, "<equality><connect body1=\"bob\"/></equality>"),
            "a connect without a name lacks `anchor`",
        ),
        (
            model(&swing, "<equality><weld body1=\"bib\"/></equality>"),
            "`body1` of a weld without a name is \"bib\", but there is no such body",
        ),
        (
            model(
                &swing,
                "<equality><weld site1=\"a\" site2=\"b\"/></equality>",
            ),
            "write `body1`, `body2` and `anchor`; --ignore weld leaves it out",
        ),
        (
            model(
                &swing,
                "<keyframe><key name=\"home\" qpos=\"1 2\"/></keyframe>",
            ),
            "`qpos` of key \"home\": 1 numbers are expected, but there are 2",
        ),
        // MuJoCo 4.0.0 puts the mass centre of such a body at the origin of its frame before it reads `qpos` and anchors.
        (
            model(
                &format!("<freejoint align=\"true\"/>{WEIGHT}"),
                "<keyframe><key name=\"home\" qpos=\"0 0 0 1 0 0 0\"/></keyframe>",
            ),
            "a freejoint without a name is aligned with the axes of inertia of its body",
        ),
        (
            model(
                &format!("<joint name=\"float\" type=\"free\"/>{WEIGHT}"),
                "<compiler alignfree=\"true\"/><equality><connect body1=\"bob\" anchor=\"0 0 1\"/></equality>",
            ),
            "joint \"float\" is aligned with the axes of inertia of its body",
        ),
        (
            model(
                &swing,
                "<equality><weld body1=\"bob\" relpose=\"0 0.1 0 1 0 0 0\"/></equality>",
            ),
            "a weld without a name cannot be satisfied",
        ),
        (
            model(&swing, "<equality><joint joint1=\"q\"/></equality>"),
            "there is no such joint",
        ),
        (
            model(&swing, "<include file=\"missing.xml\"/>"),
            "cannot read",
        ),
        (
            model(&swing, "<deformable/>"),
            "`deformable` of a model is not supported",
        ),
        (
            model(&swing, "<compiler eulerseq=\"abc\"/>"),
            "`eulerseq` must consist of three of the letters",
        ),
        (model(&"<body>".repeat(5), ""), "invalid XML"),
        (
            model(
                &format!("{}{}", "<body>".repeat(250), "</body>".repeat(250)),
                "",
            ),
            "elements are nested more than 200 deep",
        ),
        (
            "<robot/>".to_owned(),
            "this is URDF: give its file the ending `.urdf`",
        ),
        ("<sdf/>".to_owned(), "an MJCF file begins with `<mujoco>`"),
        ("<mujoco/>".to_owned(), "nothing moves"),
    ] {
        let file = Scratch::new("model.xml", &text);
        let output = lagrangian(&["import", file.path()]);
        let said = String::from_utf8_lossy(&output.stderr);
        if output.status.code() != Some(1) || !said.contains(words) {
            missed.push(format!("{words:?} is not in {said:?}"));
        }
    }
    assert!(missed.is_empty(), "{missed:#?}");
    let left_out = model(&swing, "<equality><weld body1=\"bob\"/></equality>");
    let machine = imported_model(&left_out, &[], &["--ignore", "weld"]);
    let spec = std::fs::read_to_string(&machine.0).expect("a file");
    assert!(
        spec.contains("/// Not carried over: 1 element `weld`."),
        "{spec}"
    );
}

/// The accelerations are those of MuJoCo 4.0.0, without contacts.
#[test]
fn what_an_element_leaves_out_is_that_of_the_nearest_class() {
    let box_of_class = format!(
        "{SWING}<geom class=\"inner\" type=\"box\" size=\"0.1 0.2 0.4\" pos=\"0.3 0 0\" mass=\"2\"/>"
    );
    let ball =
        |attributes: &str| format!("{SWING}<geom size=\"0.1\" pos=\"0.5 0 0\" {attributes}/>");
    let in_frame = "<frame pos=\"0.3 0 0\" euler=\"0 0 40\"><inertial pos=\"0.1 0 0\" mass=\"1\" diaginertia=\"1 1.5 2\"/></frame>";
    for (text, push, acceleration) in [
        // A class and the class above it give an orientation by different attributes.
        (
            model(
                &box_of_class,
                "<default><geom axisangle=\"0 1 0 30\"/><default class=\"inner\"><geom zaxis=\"1 1 0\"/></default></default>",
            ),
            None,
            21.766_879_645_135_422,
        ),
        // An element gives the first numbers of a list, and its class the others.
        (
            model(
                &ball("mass=\"2\""),
                "<default><general gainprm=\"3\" biastype=\"affine\" biasprm=\"0 -30 -10\"/></default>
                <actuator><general name=\"push\" joint=\"pivot\" biasprm=\"0.2\"/></actuator>",
            ),
            Some(1.0),
            5.062_698_736_854_712,
        ),
        (
            model(&ball(""), "<default><geom type=\"capsule\" size=\"0.2 0.4\"/></default>"),
            None,
            14.392_926_000_056_027,
        ),
        // The pose of a frame is also that of an `inertial` in it.
        (
            model(&format!("{SWING}{in_frame}"), ""),
            None,
            2.459_152_102_213_521,
        ),
    ] {
        let machine = imported_model(&text, &[], &[]);
        let inputs = push.map_or_else(|| json!({}), |push| json!({ "push": push }));
        let found = evaluated(
            &machine,
            &json!([{ "q": [0.3], "v": [0.1], "inputs": inputs }]),
        );
        let found = numbers(&found[0]["accelerations"]);
        assert_close(&found, &[acceleration], acceleration, &text);
    }
    // Coefficients that are not given are those of the identity; an equality is active unless its class says otherwise.
    let swing = format!("{SWING}{WEIGHT}");
    let follows = "<equality><joint joint1=\"pivot\" polycoef=\"0.2\"/></equality>";
    let spec = |text: &str| {
        let machine = imported_model(text, &[], &[]);
        std::fs::read_to_string(&machine.0).expect("a file")
    };
    let pair = "<body name=\"next\" pos=\"0 0 -1\"><joint name=\"other\" axis=\"0 1 0\"/><geom size=\"0.1\" pos=\"0.2 0 0\"/></body>";
    let both = follows.replace("joint1", "joint2=\"other\" joint1");
    let tied = spec(&model(&format!("{swing}{pair}"), &both));
    assert!(tied.contains("pivot = pivot_follows_c0 + other"), "{tied}");
    let inactive = format!("<default><equality active=\"false\"/></default>{follows}");
    let loose = spec(&model(&swing, &inactive));
    assert!(!loose.contains("constraints {"), "{loose}");
    // The defaults of tendons are those of the element `tendon`.
    let tendon = "<default><tendon stiffness=\"3\"/></default><tendon><fixed><joint joint=\"pivot\" coef=\"1\"/></fixed></tendon>";
    let file = Scratch::new("model.xml", &model(&swing, tendon));
    let output = lagrangian(&["import", file.path()]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("`stiffness` of the tendon"), "{said}");
}

/// A swinging box of 0.2 by 0.4 by 0.6: as a box, as an OBJ mesh in another unit and position, and from an included file.
#[test]
fn a_mesh_weighs_what_its_shape_does() {
    let mut obj = String::new();
    for corner in 0..8 {
        let side = |bit: i32, half: i32| if corner >> bit & 1 == 1 { half } else { -half };
        obj.push_str(&format!(
            "v {} {} {}\n",
            500 + side(0, 100),
            side(1, 200),
            side(2, 300)
        ));
    }
    obj.push_str("f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
    let body = |geom: &str| format!("{SWING}{geom}");
    let exact = model(
        &body("<geom type=\"box\" size=\"0.1 0.2 0.3\" pos=\"0 0 -1\"/>"),
        "",
    );
    let mesh = "<geom type=\"mesh\" mesh=\"block\" pos=\"0 0 -1\"/>";
    let assets =
        "<asset><mesh file=\"block.obj\" scale=\"0.001 0.001 -0.001\" refpos=\"500 0 0\"/></asset>";
    let meshed = model(&body(mesh), assets);
    let included = model(&body(mesh), "<include file=\"assets.xml\"/>");
    let assets = format!("<mujocoinclude>{assets}</mujocoinclude>");
    let files = [
        ("block.obj", obj.as_bytes()),
        ("assets.xml", assets.as_bytes()),
    ];
    let points = json!([{ "q": [0.7] }]);
    // I = m (0.2² + 0.6²)/12 + m; the weight acts at a distance of 1 m.
    let inertia = 48.0 * (0.4 / 12.0 + 1.0);
    let truth = [inertia, -48.0 * 9.81 * 0.7_f64.sin() / inertia];
    for text in [exact, meshed, included] {
        let found = evaluated(&imported_model(&text, &files, &[]), &points).remove(0);
        let found = [
            numbers(&found["mass_matrix"])[0],
            numbers(&found["accelerations"])[0],
        ];
        assert_close(&found, &truth, 50.0, &text);
    }
}

/// An L-shaped mesh, parts of whose surface face its centre, scaled, shifted and rotated. The truth is printed by MuJoCo 4.0.0: mass, mass centre
/// and tensor (`body_mass`, `body_ipos`, and `body_inertia` rotated by `body_iquat`).
#[test]
fn meshes_weigh_what_mujoco_says() {
    let mesh = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 3 1\nv 0 3 1\n\
                f 6 5 4 3 2 1\nf 7 8 9 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n"
        .replace("f 6 5 4 3 2 1", "f 3 2 1\nf 4 3 1\nf 5 4 1\nf 6 5 1")
        .replace("f 7 8 9 10 11 12", "f 7 8 9\nf 7 9 10\nf 7 10 11\nf 7 11 12");
    let truths = [
        (
            "",
            [
                32.510437000813084,
                -0.158058966615645,
                0.254184363930466,
                0.366064387050333,
            ],
            [
                2.987161793092729,
                3.810619373297407,
                0.946250632735572,
                0.019832835240556,
                -0.746656934781764,
                0.103673962967364,
            ],
        ),
        (
            "inertia=\"exact\"",
            [
                31.25,
                -0.15622332859175,
                0.255298719772404,
                0.355654338549075,
            ],
            [
                2.899359904402855,
                3.721476690101819,
                0.941003346631124,
                0.021317679470907,
                -0.762353289064933,
                0.097345154666977,
            ],
        ),
    ];
    for (inertia, weight, tensor) in truths {
        let text = model(
            "<freejoint name=\"f\"/><geom type=\"mesh\" mesh=\"l\" pos=\"0.1 0.2 0.3\" quat=\"0.5 0.5 -0.5 0.6\" density=\"500\"/>",
            &format!(
                "<asset><mesh name=\"l\" file=\"l.obj\" scale=\"0.5 0.25 0.125\" refpos=\"0.5 0.25 1\" refquat=\"0.9 0.1 0.3 \
                 -0.2\" {inertia}/></asset>"
            ),
        );
        let machine = imported_model(&text, &[("l.obj", mesh.as_bytes())], &[]);
        let spec = std::fs::read_to_string(&machine.0).expect("a file");
        let value = |name: &str| -> f64 {
            let (_, rest) = spec.split_once(&format!("bob_{name}: ")).expect(name);
            let (_, rest) = rest.split_once(" = ").expect(name);
            rest.split_once(',').expect(name).0.parse().expect(name)
        };
        let found = ["mass", "com_x", "com_y", "com_z"].map(value);
        // Printed with 15 decimals.
        assert_close(&found, &weight, 40.0, "weight");
        let found = ["Ixx", "Iyy", "Izz", "Ixy", "Ixz", "Iyz"].map(value);
        // MuJoCo stores principal moments and their axes, for a mesh to about 1e-7.
        for (found, truth) in found.iter().zip(tensor) {
            assert!((found - truth).abs() <= 1e-6, "{found}, not {truth}");
        }
    }
}

/// A motor behind a URDF transmission: its torque is multiplied by n, the inertia of its rotor by n².
#[test]
fn transmissions_are_motors() {
    let motor = "<transmission name=\"t\"><type>SimpleTransmission</type><joint name=\"pivot\"/><actuator \
                 name=\"drive\"><mechanicalReduction>50</mechanicalReduction><rotorInertia>2e-4</rotorInertia></actuator></transmission>";
    let text = pendulum("continuous", "<axis xyz=\"0 1 0\"/>")
        .replace("</robot>", &format!("{motor}</robot>"));
    let machine = imported_text(&text, &[]);
    let found = evaluated(
        &machine,
        &json!([{ "q": [0.4], "inputs": { "drive": 0.3 } }]),
    )
    .remove(0);
    let inertia = 2.0 * 0.25 + 2500.0 * 2e-4;
    let torque = 50.0 * 0.3 - 2.0 * 9.81 * 0.5 * 0.4_f64.sin();
    let found = [
        numbers(&found["mass_matrix"])[0],
        numbers(&found["accelerations"])[0],
    ];
    assert_close(&found, &[inertia, torque / inertia], 20.0, "a motor");
    let machine = imported_text(&text, &["--ignore", "transmission"]);
    let found = evaluated(&machine, &json!([{ "q": [0.4] }])).remove(0);
    assert_close(&numbers(&found["mass_matrix"]), &[0.5], 1.0, "no motor");
    let said = refused(&text.replace("pivot\"/><actuator", "p\"/><actuator"), &[]);
    assert!(
        said.contains("a transmission moves joint \"p\", but there is no such joint"),
        "{said}"
    );
    let two = text.replace(
        "<joint name=\"pivot\"/>",
        "<joint name=\"pivot\"/><joint name=\"q\"/>",
    );
    assert!(refused(&two, &[]).contains("a rotor that turns with several joints is not supported"));
}

#[test]
fn calls_are_told_what_they_lack() {
    for (arguments, words) in [
        (&["scene.sdf"][..], "with the ending `.urdf`"),
        (&["missing.urdf"], "cannot read missing.urdf"),
        (
            &[
                "cli/tests/command/import/mujoco/hopper.xml",
                "--base",
                "floating",
            ],
            "itself specifies which bodies float",
        ),
        (&["a.urdf", "--out", "a.txt"], "writes `.machine`"),
        (&["a.urdf", "--friction", "smooth=0"], "a rate above 0"),
        (
            &["a.urdf", "--limits", "hard"],
            "[possible values: none, assume, stop]",
        ),
    ] {
        let output = lagrangian(&[&["import"], arguments].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(words), "{said}");
    }
}

/// Names of links and joints that are reserved or invalid in a spec.
#[test]
fn any_name_becomes_one() {
    let words = [
        "t",
        "pi",
        "g",
        "x",
        "rad",
        "m",
        "ground",
        "self",
        "sin",
        "in",
        "remove",
        "bodies",
        "machine",
        "type",
        "1st",
        "a-b",
        "a b",
        "--",
        "é",
        "b_mass",
        "b",
        "z_origin_x",
        "extends",
        "f32",
        "true",
        "name&#10;line",
        "der",
        "gravity",
    ];
    let mut text = "<robot name=\"self\"><link name=\"root\"/>".to_owned();
    let mut parent = "root";
    for word in words {
        let _ = write!(
            text,
            "<link name=\"{word}\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" \
             iyz=\"0\"/></inertial></link><joint name=\"{word}\" type=\"prismatic\"><origin xyz=\"1 0 0\"/><parent \
             link=\"{parent}\"/><child link=\"{word}\"/></joint>"
        );
        parent = word;
    }
    text.push_str("</robot>");
    let machine = imported_text(&text, &["--limits", "assume"]);
    let check = lagrangian(&["check", machine.path(), "--deny-warnings"]);
    let said = String::from_utf8_lossy(&check.stderr);
    assert!(check.status.success(), "{said}");
    assert!(Path::new(machine.path()).exists());
}
