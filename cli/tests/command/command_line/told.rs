//! Errors are reported in terms of the call, and before anything runs.

use super::kept::Folder;
use super::{err, json, out, status, with_input};
use crate::support::lagrangian;

const PENDULUM: &str = "machines/double_pendulum.machine";
const CART: &str = "machines/cart_pole.machine";

#[test]
fn settings_that_make_no_sense_are_errors_of_their_option() {
    for (option, value) in [
        ("--every", "0"),
        ("--every", "-0.1"),
        ("--every", "nan"),
        ("--tolerance", "0"),
        ("--tolerance", "-1e-9"),
        ("--tolerance", "1e-17"),
        ("--tolerance", "1"),
        ("--tolerance", "nan"),
        ("--max-steps", "0"),
        ("--max-steps", "2.5"),
    ] {
        let output = lagrangian(&["simulate", PENDULUM, "--until", "1", option, value]);
        assert_eq!(status(&output), 2, "{option} {value}: {}", err(&output));
        assert!(err(&output).contains(option), "{}", err(&output));
        assert_eq!(out(&output), "");
    }
    for until in ["nan", "inf", "-inf", "1e999", "soon"] {
        let output = lagrangian(&["simulate", PENDULUM, "--until", until]);
        assert_eq!(status(&output), 2, "{until}: {}", err(&output));
    }
}

#[test]
fn a_run_of_too_many_steps_names_the_option() {
    let call = ["simulate", PENDULUM, "--until", "1e3", "--max-steps", "20"];
    let output = lagrangian(&call);
    assert_eq!(status(&output), 1);
    assert!(err(&output).contains("--max-steps"), "{}", err(&output));
    assert!(out(&output).contains("20 steps"), "{}", out(&output));
    // However large the end time, no number is printed with a hundred digits.
    let call = [
        "simulate",
        PENDULUM,
        "--until",
        "1e300",
        "--max-steps",
        "20",
    ];
    let output = lagrangian(&call);
    assert!(err(&output).contains("of 1e300 s"), "{}", err(&output));
}

#[test]
fn what_is_said_twice_is_an_error_and_families_come_before_their_members() {
    let chain = "machines/chain.machine";
    for twice in [
        &["evaluate", chain, "--const", "N=3", "--const", "N=4"][..],
        &["evaluate", PENDULUM, "--set", "m1=1", "--set", "m1=2"],
        &[
            "evaluate", PENDULUM, "--start", "theta1=1", "--start", "theta1=1",
        ],
        &[
            "evaluate", PENDULUM, "--rate", "theta1=1", "--rate", "theta1=2",
        ],
        &["evaluate", PENDULUM, "--keep", "theta1,der(theta2),theta1"],
    ] {
        let output = lagrangian(twice);
        assert_eq!(status(&output), 2, "{twice:?}: {}", err(&output));
        assert!(err(&output).contains("more than once"), "{}", err(&output));
    }
    let of = |options: [&str; 2]| {
        let call = [
            "evaluate", chain, "--const", "N=3", "--start", options[0], "--start", options[1],
        ];
        json(&lagrangian(&call))[0]["accelerations"].clone()
    };
    assert_eq!(of(["q=0", "q[2]=0.5"]), of(["q[2]=0.5", "q=0"]));
}

#[test]
fn names_of_another_kind_are_told_which_option_sets_them() {
    for (option, set, words) in [
        ("--set", "theta=1", "--start"),
        ("--start", "pole=1", "--set"),
        ("--rate", "pole=1", "--set"),
        ("--start", "der(theta)=1", "--rate"),
        ("--set", "poel=1", "did you mean `pole`?"),
        ("--rate", "teta=1", "did you mean `theta`?"),
        ("--set", "pole=two", "nothing is named `two`"),
        ("--set", "pole=1e999", "number"),
        ("--start", "=1", "expected a name"),
    ] {
        let output = lagrangian(&["evaluate", CART, option, set]);
        assert_eq!(status(&output), 2, "{set}: {}", err(&output));
        assert!(err(&output).contains(words), "{set}: {}", err(&output));
    }
}

#[test]
fn wrong_points_are_told_where_they_are() {
    let call = ["evaluate", PENDULUM, "--at", "-"];
    // The text is malformed, so there is no list of results.
    let output = with_input(&call, "[\n  {\"q\": [0, 1},\n]");
    assert_eq!(status(&output), 2);
    let said = err(&output);
    assert!(
        said.contains("standard input: line 2, column 14: "),
        "{said}"
    );
    // One point is wrong; the others have results.
    let output = with_input(&call, "[\n  {},\n  {\"v\": {\"theta1\": \"fast\"}}\n]");
    assert_eq!(status(&output), 0, "{}", err(&output));
    let results = json(&output);
    assert!(results[0]["accelerations"].is_array());
    assert_eq!(
        results[1]["error"],
        "standard input: line 3, column 20: point 2: \"v\": \"theta1\": expected a number, found a string"
    );
    for wrong in ["", "7", "[7]", "[{\"q\": [true]}]", "[{\"q\": {}}", "[{]"] {
        let output = with_input(&call, wrong);
        let said = format!("{}{}", out(&output), err(&output));
        for word in [
            "serde",
            "invalid type",
            "untagged",
            "variant",
            "EOF",
            "expected struct",
            "f64",
        ] {
            assert!(!said.contains(word), "{wrong}: {said}");
        }
        assert!(said.contains("line 1, column "), "{wrong}: {said}");
    }
}

/// (1e200)² overflows, and so does the energy.
#[test]
fn an_energy_that_overflows_is_told() {
    let folder = Folder::new();
    let spec = "machine Ball in plane {\n    parameters { m: kg = 1 }\n    coordinates { x: m }\n    \
                bodies { ball { mass: m, at: (x, 0) } }\n}\n";
    folder.file("ball.machine", spec);
    let rate = ["--rate", "x=1e200"];
    let output = folder.run(&[&["evaluate", "ball.machine"][..], &rate].concat());
    let error = json(&output)[0]["error"].to_string();
    assert!(error.contains("kinetic energy"), "{error}");
    let simulate = ["simulate", "ball.machine", "--until", "1"];
    let output = folder.run(&[&simulate[..], &rate].concat());
    assert_eq!(status(&output), 1, "{}", out(&output));
    assert!(err(&output).contains("kinetic energy"), "{}", err(&output));
    let output = folder.run(&[&simulate[..], &rate, &["--json"]].concat());
    assert_eq!(status(&output), 1);
    assert!(json(&output)["error"].is_string());
}

#[test]
fn a_processor_that_nobody_knows_is_refused() {
    let folder = Folder::new();
    let spec = "machine Ball in plane {\n    coordinates { x: m }\n    bodies { ball { mass: 1, at: (x, 0) } }\n}\n";
    folder.file("ball.machine", spec);
    let call = ["library", "ball.machine", "--out", "a.so", "--target-cpu"];
    let output = folder.run(&[&call[..], &["nonsense"]].concat());
    assert_eq!(status(&output), 2, "{}", err(&output));
    let said = err(&output);
    assert!(
        said.contains("`rustc --print target-cpus`") && !said.contains("LLVM"),
        "{said}"
    );
    assert!(!folder.path("a.so").exists() && !folder.path("a.h").exists());
}

/// Two seconds is the longest time without a progress message.
#[test]
fn a_long_run_says_how_far_it_is() {
    let began = std::time::Instant::now();
    let folder = Folder::new();
    let spec = crate::support::root().join(PENDULUM);
    let spec = spec.to_str().expect("text");
    let mut command = folder.command(&["simulate", spec, "--until", "1e300"]);
    let mut child = command
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("the command runs");
    let mut line = String::new();
    let mut said = std::io::BufReader::new(child.stderr.take().expect("a pipe"));
    std::io::BufRead::read_line(&mut said, &mut line).expect("text");
    let waited = began.elapsed().as_secs_f64();
    child.kill().expect("a process");
    let _ = child.wait();
    assert!(
        line.starts_with("simulating: t = ")
            && line.contains(" s of 1e300 s, ")
            && line.contains(" steps, 2 s"),
        "{line}"
    );
    // A busy machine may delay it.
    assert!((1.9..10.0).contains(&waited), "{waited}");
}
