//! Calls, plans, tables and folders that are mistaken are refused at the word that is wrong, and nothing of the user's is lost.

use std::path::Path;

use crate::support::{Scratch, lagrangian, root};
use serde_json::{Value, json};

const PENDULUM: &str = "machine Pendulum in plane {
    parameters { mass: kg = 1, l: m = 0.5, g: m/s^2 = 9.81 }
    coordinates { theta: rad = 0.9 }
    bodies { bob { mass: mass, at: l*(sin(theta), -cos(theta)) } }
    gravity (0, -g);
    outputs { x: m = l*sin(theta) }
}";

/// The exit status of a call and what it prints on standard error.
fn call(arguments: &[&str]) -> (i32, String) {
    let output = lagrangian(arguments);
    let status = output.status.code().expect("no signal");
    (status, String::from_utf8(output.stderr).expect("text"))
}

/// Runs a call that must be refused as a call, with these words.
fn refused(arguments: &[&str], needed: &str) {
    let (status, error) = call(arguments);
    assert_eq!(status, 2, "{arguments:?}: {error}");
    assert!(error.contains(needed), "{arguments:?}: {error}");
}

/// Names and instants in a plan are checked like those of a call, also where no run would use them.
#[test]
fn a_plan_is_refused_at_the_word() {
    let spec = Scratch::new("pendulum.machine", PENDULUM);
    let at = |name: &str| spec.0.with_file_name(name);
    let (plan, rows) = (at("mistaken.json"), at("mistaken.csv"));
    let [path, out] = [&plan, &rows].map(|path| path.to_str().expect("text"));
    let design = ["sweep", spec.path(), "--until", "1", "--vary", "l=1,2"];
    assert_eq!(call(&[&design[..], &["--plan", path]].concat()).0, 0);
    let text = std::fs::read_to_string(&plan).expect("a plan");
    let right: Value = serde_json::from_str(&text).expect("JSON");
    let with = |field: &str, value: Value| {
        let mut changed = right.clone();
        changed[field] = value;
        // A byte order mark, which some editors write, changes nothing.
        std::fs::write(&plan, format!("\u{feff}{changed}")).expect("a plan");
    };
    let constant = json!([{ "name": "e", "formula": "l - g*(1*s^2)", "ends": false }]);
    for (field, value, needed) in [
        (
            "keep",
            json!(["nope"]),
            "--keep nope: no coordinate named `nope`",
        ),
        (
            "keep",
            json!(["der(nope)"]),
            "--keep der(nope): no coordinate named `nope`",
        ),
        (
            "keep",
            json!(["theta", "theta"]),
            "--keep names `theta` more than once",
        ),
        (
            "at",
            json!([0.25, 0.5, 0.5]),
            "--record at=0.5: 0.5 s is given more than once",
        ),
        (
            "at_events",
            json!(["nope"]),
            "--record event=nope: there is no such event",
        ),
        ("events", constant, "never changes its sign"),
        (
            "tolerance",
            json!(0.0),
            "--tolerance 0: a tolerance must be",
        ),
        ("tolerance", json!(1e-30), "the limit of round-off"),
        ("max_steps", json!(0), "--max-steps 0"),
        (
            "set",
            json!([["g", 1.0], ["g", 2.0]]),
            "`g` is set more than once",
        ),
        (
            "design",
            json!([{ "grid": { "name": "l", "from": 0.0, "to": 1.0, "count": 3, "log": true } }]),
            "l: both ends of a geometric grid must have the same sign",
        ),
        (
            "design",
            json!([{ "sample": { "design": "sobol", "count": 3, "seed": 0, "variables": [["l", { "normal": [1.0, -1.0] }]] } }]),
            "l: a standard deviation must be greater than 0",
        ),
        (
            "design",
            json!([{ "list": { "names": [], "rows": [[]] } }]),
            "a factor of the design varies nothing",
        ),
        (
            "reduce",
            json!([{ "name": "", "function": "max", "of": "theta" }]),
            "--reduce: a name is empty",
        ),
    ] {
        with(field, value);
        refused(&["sweep", path, "--out", out], needed);
        assert!(!rows.exists());
    }
    with("keep", json!(["theta", "der(theta)"]));
    let (status, error) = call(&["sweep", path, "--out", out]);
    assert_eq!(status, 0, "{error}");
}

/// A sweep does not write among the files of another folder, and removes none of them.
#[test]
fn a_folder_with_other_files_is_not_used() {
    let spec = Scratch::new("pendulum.machine", PENDULUM);
    let folder = spec.0.with_file_name("mine");
    std::fs::create_dir(&folder).expect("a folder");
    std::fs::write(folder.join("notes.tmp"), "mine").expect("a file");
    let design = ["sweep", spec.path(), "--until", "1", "--vary", "l=1,2"];
    let out = folder.to_str().expect("text");
    let plain = [&design[..], &["--out", out]].concat();
    let fresh = [&plain[..], &["--fresh"]].concat();
    for arguments in [&plain, &fresh] {
        refused(
            arguments,
            "holds no sweep, but other files, such as `notes.tmp`",
        );
        assert_eq!(names(&folder), ["notes.tmp"]);
    }
    // Beside a sweep other files stay as they are.
    std::fs::remove_file(folder.join("notes.tmp")).expect("a file");
    assert_eq!(call(&plain).0, 0);
    std::fs::write(folder.join("notes.tmp"), "mine").expect("a file");
    std::fs::write(folder.join("00000000.csv.17.tmp"), "partial").expect("a file");
    assert_eq!(call(&fresh).0, 0);
    let left = names(&folder);
    assert!(left.contains(&"notes.tmp".to_owned()), "{left:?}");
    assert!(
        !left.contains(&"00000000.csv.17.tmp".to_owned()),
        "{left:?}"
    );
}

/// The names of the files in a folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<String> = names
        .map(|name| name.to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

/// A negative number after an option is a value of this option.
#[test]
fn negative_values_are_refused_as_values() {
    let spec = Scratch::new("pendulum.machine", PENDULUM);
    let path = spec.path();
    for arguments in [
        &["orbit", path, "--near", "-1"][..],
        &["peaks", path, "--until", "1", "--ripple", "-1"],
        &["compare", path, path, "--until", "1", "--within", "-1"],
        &[
            "sweep",
            path,
            "--until",
            "1",
            "--vary",
            "l=1,2",
            "--threads",
            "-1",
        ],
        &[
            "sweep", path, "--until", "1", "--vary", "l=1,2", "--seed", "-1",
        ],
    ] {
        refused(arguments, "invalid value '-1' for '--");
    }
}

/// A table of measurements that cannot be what was meant is refused with the reason, and does not appear as a whole in the message.
#[test]
fn a_table_without_measurements_says_why() {
    let spec = Scratch::new("pendulum.machine", PENDULUM);
    for (text, needed) in [
        ("t\n0\n1\n", "it has no column besides `t`"),
        (
            "t\ttheta\n0\t1\n",
            "line 1, column 2: columns are separated by commas or semicolons, not by tabs",
        ),
        (
            "t,theta\n0,nan\n1,\n",
            "there is no number in `theta`; quantities of the machine are: theta",
        ),
        (
            "t,theta\r0,1\r1,2\r",
            "line 1, column 8: the line ends with a carriage return alone",
        ),
        (
            "t,nope\n0,1\n1,2\n",
            "none of its columns, `nope`, is among the quantities of the machine: theta",
        ),
    ] {
        let data = Scratch::new("data.csv", text);
        let arguments = ["fit", spec.path(), "--data", data.path(), "--fit", "l"];
        refused(&arguments, needed);
    }
    let data = Scratch::new("data.csv", "t,theta\n0,1\n1,0.5\n2,0.2\n");
    let fit = ["fit", spec.path(), "--data", data.path()];
    for (more, needed) in [
        (&["--fit", ""][..], "--fit: expected a name"),
        (
            &["--fit", "l", "--columns", ""],
            "--columns: expected a name",
        ),
        (
            &["--fit", "l", "--starts", "10001"],
            "expected a whole number from 1 to 10000",
        ),
    ] {
        refused(&[&fit[..], more].concat(), needed);
    }
    let sets = Scratch::new("sets.csv", "");
    let arguments = [
        "sweep",
        spec.path(),
        "--until",
        "1",
        "--table",
        sets.path(),
        "--out",
        "unused.csv",
    ];
    refused(
        &arguments,
        "it is empty; its first line must name its columns",
    );
    assert!(!root().join("unused.csv").exists());
}

/// No number is smaller than all others: where terms vanish they are no scale of a residual.
#[test]
fn a_constraint_that_nothing_satisfies_is_told_without_a_scale_that_vanishes() {
    let spec = Scratch::new(
        "impossible.machine",
        "machine Impossible in plane {
            coordinates { x: m = 1 }
            bodies { bead { mass: 1, at: (x, 0) } }
            constraints { circle: x^2 = -1 }
        }",
    );
    let (status, error) = call(&["simulate", spec.path(), "--until", "1"]);
    assert_eq!(status, 1, "{error}");
    assert!(
        error.contains("`circle` cannot be met near the state at t = 0 s: where the search ended, its residual is far from 0"),
        "{error}"
    );
}

/// Numbers that overflow are told as such, not as a motion without kinetic energy: the square of the length is beyond 1.8e308.
#[test]
fn a_mass_matrix_that_overflows_is_told() {
    let spec = Scratch::new("pendulum.machine", PENDULUM);
    let (status, error) = call(&["simulate", spec.path(), "--until", "1", "--set", "l=1e200"]);
    assert_eq!(status, 1, "{error}");
    assert!(
        error.contains("no finite value in the row of the coordinate `theta` at t = 0 s, since numbers overflow"),
        "{error}"
    );
    for method in ["dop853", "taylor"] {
        let (_, error) = call(&[
            "simulate",
            spec.path(),
            "--until",
            "1",
            "--set",
            "l=0",
            "--method",
            method,
        ]);
        assert!(error.contains("no kinetic energy"), "{method}: {error}");
    }
}

/// A unit that a quantity of the machine hides is told with a way to write it.
#[test]
fn a_hidden_unit_is_told_with_another_one() {
    let spec = Scratch::new(
        "pushed.machine",
        "machine Pushed in plane {
            parameters { m: kg = 2 }
            coordinates { x: m = 0.5 }
            inputs { push: N }
            bodies { cart { mass: m, at: (x, 0) } }
            forces { hand { on: x, value: push } }
        }",
    );
    let simulate = ["simulate", spec.path(), "--until", "1", "--input"];
    refused(
        &[&simulate[..], &["push=-8*N/m*x"]].concat(),
        "write another unit, such as `mm`, or only the number, in SI units, where it stands alone",
    );
    let (status, error) = call(&[&simulate[..], &["push=-0.008*N/mm*x"]].concat());
    assert_eq!(status, 0, "{error}");
}

/// A name that is not UTF-8 cannot be written in messages and in `extends`; the file exists, and is not said to be missing.
#[cfg(target_os = "linux")]
#[test]
fn a_spec_whose_name_is_not_text_is_refused_for_it() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let spec = Scratch::new("pendulum.machine", PENDULUM);
    let name = spec.0.with_file_name(OsStr::from_bytes(b"p\xff.machine"));
    std::fs::copy(&spec.0, &name).expect("a copy");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_lagrangian"))
        .arg("check")
        .arg(&name)
        .output()
        .expect("the command runs");
    std::fs::remove_file(&name).expect("the copy");
    let error = String::from_utf8(output.stderr).expect("text");
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("must be UTF-8"), "{error}");
}
