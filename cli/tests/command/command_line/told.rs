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

/// An option that the rest of the call makes ineffective is an error that names it.
#[test]
fn options_without_effect_are_errors() {
    let folder = Folder::new();
    let at = |name: &str| folder.path(name).to_str().expect("text").to_owned();
    let (unit, plan, rows) = (at("a.fmu"), at("a.json"), at("a.csv"));
    let sweep = ["sweep", CART, "--until", "1", "--vary", "cart=1,2"];
    let output = lagrangian(&[&sweep[..], &["--plan", &plan]].concat());
    assert_eq!(status(&output), 0, "{}", err(&output));
    let stepped = ["simulate", PENDULUM, "--until", "1"];
    let units = ["fmu", CART, "--out", &unit, "--sources-only"];
    let orbits = ["orbit", PENDULUM, "--along", "g=9..10:2"];
    let planned = ["sweep", &plan, "--out", &rows];
    for (call, more, words) in [
        (
            &stepped[..],
            &[
                "--method",
                "rk4",
                "--longest-step",
                "0.1",
                "--tolerance",
                "1e-6",
            ][..],
            "`rk4` has no --tolerance",
        ),
        (
            &units,
            &["--kind", "me", "--method", "dopri5"],
            "--method is that of co-simulation",
        ),
        (
            &units,
            &["--kind", "me,me"],
            "--kind names `me` more than once",
        ),
        (
            &units,
            &["--outputs", "x,theta,x"],
            "--outputs names `x` more than once",
        ),
        (&orbits, &["--set", "g=5"], "both give `g` a value"),
        (&sweep, &["--plan", &plan, "--out", &rows], "--out"),
        (&sweep, &["--plan", &plan, "--limit", "1"], "--limit"),
        (&planned, &["--tolerance", "1e-3"], "is a plan"),
        (&planned, &["--method", "dopri5"], "is a plan"),
        (&planned, &["--max-steps", "9"], "is a plan"),
        (&planned, &["--seed", "9"], "is a plan"),
        (&planned, &["--keep", "none"], "is a plan"),
    ] {
        let output = lagrangian(&[call, more].concat());
        assert_eq!(status(&output), 2, "{call:?} {more:?}: {}", err(&output));
        let said = err(&output);
        assert!(said.contains(words), "{call:?} {more:?}: {said}");
    }
    assert!(!folder.path("a.fmu").exists() && !folder.path("a.csv").exists());
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

/// Two oscillators without coupling: x = x₀ cos √k t, with masses of 1 kg.
const PAIR: &str = "machine Pair in plane {
    parameters { k[1..2]: N/m = 1 }
    coordinates { x[1..2]: m = 1 }
    bodies { block[i in 1..2] { mass: 1, at: (x[i], 0) } }
    gravity none;
    springs { spring[i in 1..2] { stiffness: k[i], stretch: x[i] } }
}";

/// Values of members hold whatever option gives a value to their family.
#[test]
fn members_keep_their_values_where_their_family_varies() {
    let folder = Folder::new();
    let spec = folder.file("pair.machine", PAIR);
    let spec = spec.to_str().expect("text");
    let rows = folder.path("rows.csv");
    let rows = rows.to_str().expect("text");
    let done = |arguments: &[&str]| {
        let output = lagrangian(arguments);
        assert_eq!(status(&output), 0, "{arguments:?}: {}", err(&output));
        out(&output)
    };
    let is_near = |found: f64, known: f64| {
        assert!((found - known).abs() < 1e-7, "{found} instead of {known}");
    };
    // The last columns of a row of a sweep: x[1], x[2], their rates, steps, the residual.
    let ends = |more: &[&str]| -> Vec<[f64; 2]> {
        done(
            &[
                &["sweep", spec, "--until", "1", "--out", rows, "--fresh"],
                more,
            ]
            .concat(),
        );
        let table = std::fs::read_to_string(rows).expect("a table");
        let row = |line: &str| {
            let cells: Vec<f64> = line.split(',').filter_map(|x| x.parse().ok()).collect();
            [cells[cells.len() - 6], cells[cells.len() - 5]]
        };
        table.lines().skip(1).map(row).collect()
    };
    for (set, varied) in [
        (["--set", "k[1]=9"], "k=4,16"),
        (["--set", "k[2]=9"], "k=4,16"),
    ] {
        let found = ends(&[&set[..], &["--vary", varied]].concat());
        for (found, family) in found.iter().zip([2.0_f64, 4.0]) {
            let (own, other) = match set[1] {
                "k[1]=9" => (0, 1),
                _ => (1, 0),
            };
            is_near(found[own], 3.0_f64.cos());
            is_near(found[other], family.cos());
        }
    }
    let found = ends(&["--start", "x[1]=0.5", "--vary", "start(x)=2,3"]);
    for (found, family) in found.iter().zip([2.0, 3.0]) {
        is_near(found[0], 0.5 * 1.0_f64.cos());
        is_near(found[1], family * 1.0_f64.cos());
    }
    // The greatest frequency is that of the member.
    let modes = [
        "modes", spec, "--json", "--set", "k[1]=100", "--vary", "k=4..9:2",
    ];
    let found: serde_json::Value = serde_json::from_str(&done(&modes)).expect("JSON");
    for (motion, family) in found["motions"]
        .as_array()
        .expect("a list")
        .iter()
        .zip([2.0, 3.0])
    {
        let frequencies = motion["modes"].as_array().expect("a list").iter();
        let mut frequencies: Vec<f64> =
            frequencies.filter_map(|mode| mode["im"].as_f64()).collect();
        frequencies.sort_by(f64::total_cmp);
        is_near(frequencies[0], family);
        is_near(frequencies[1], 10.0);
    }
    // What the second run sets takes precedence, also over members.
    let compare = [
        "compare", spec, spec, "--until", "1", "--of", "x[1]", "--json",
    ];
    let sets = ["--set", "k[1]=9", "--set-second", "k=4"];
    let found: serde_json::Value =
        serde_json::from_str(&done(&[&compare[..], &sets].concat())).expect("JSON");
    let largest = found["quantities"][0]["largest"]
        .as_f64()
        .expect("a number");
    assert!(largest > 0.5, "{found:#}");
    // In experiments, in whichever order, and a family of which all members are fitted is refused.
    let times = (0..=20).map(|i| f64::from(i) * 0.1);
    let lines = times.map(|t| format!("{t},{},{}\n", (3.0 * t).cos(), (2.0 * t).cos()));
    let data = format!("t,x[1],x[2]\n{}", lines.collect::<String>());
    let data = folder.file("data.csv", &data);
    let data = data.to_str().expect("text");
    for sets in ["k[1]=9,k=4", "k=4,k[1]=9"] {
        let data = format!("{data},{sets}");
        let fit = ["fit", spec, "--data", &data, "--fit", "start(x)", "--json"];
        let found: serde_json::Value = serde_json::from_str(&done(&fit)).expect("JSON");
        let residual = found["columns"][0]["residual"].as_f64().expect("a number");
        assert!(residual < 1e-8, "{sets}: {found:#}");
    }
    let data = format!("{data},k=4");
    let output = lagrangian(&["fit", spec, "--data", &data, "--fit", "k"]);
    assert_eq!(status(&output), 2);
    let said = err(&output);
    assert!(said.contains("`k` is fitted"), "{said}");
}

/// An input has one law, also as a member of a family.
#[test]
fn members_of_a_driven_family_have_no_other_value() {
    let folder = Folder::new();
    let text = PAIR.replace(
        "gravity none;",
        "gravity none; inputs { u[1..2]: N } forces { f[i in 1..2] { on: x[i], value: u[i] } }",
    );
    let spec = folder.file("pair.machine", &text);
    let spec = spec.to_str().expect("text");
    let run = ["simulate", spec, "--until", "1"];
    for (more, words) in [
        (
            ["--input", "u=1*N", "--set", "u[1]=5"],
            "`u[1]` is driven by --input",
        ),
        (
            ["--input", "u=1*N", "--input", "u[1]=5*N"],
            "--input names `u[1]` more than once",
        ),
    ] {
        let output = lagrangian(&[&run[..], &more].concat());
        assert_eq!(status(&output), 2, "{more:?}: {}", err(&output));
        assert!(err(&output).contains(words), "{more:?}: {}", err(&output));
    }
    // An input of both runs of a comparison cannot have a value in the second one.
    let compare = ["compare", spec, spec, "--until", "1"];
    let output = lagrangian(&[&compare[..], &["--input", "u=1*N", "--set-second", "u=5"]].concat());
    assert_eq!(status(&output), 2, "{}", out(&output));
    let said = err(&output);
    assert!(
        said.contains("`u` is driven by --input and also set to a constant by --set-second"),
        "{said}"
    );
    // The value of a family is that of the members that are not driven.
    let more = ["--input", "u[1]=1*N", "--set", "u=5", "--json"];
    let output = lagrangian(&[&run[..], &more].concat());
    // x = u + (1 − u) cos t
    let found = json(&output)["q"]["x[2]"].as_f64().expect("a number");
    assert!(
        (found - (5.0 - 4.0 * 1.0_f64.cos())).abs() < 1e-7,
        "{found}"
    );
}

/// The name of a family selects all its members, also inside `der(…)`.
#[test]
fn the_rates_of_a_family_are_those_of_its_members() {
    let folder = Folder::new();
    let spec = folder.file("pair.machine", PAIR);
    let spec = spec.to_str().expect("text");
    let output = lagrangian(&[
        "compare", spec, spec, "--until", "1", "--of", "der(x),x", "--json",
    ]);
    assert_eq!(status(&output), 0, "{}", err(&output));
    let found = json(&output);
    let quantities = found["quantities"].as_array().expect("a list").iter();
    let names: Vec<&str> = quantities.filter_map(|one| one["name"].as_str()).collect();
    assert_eq!(names, ["der(x[1])", "der(x[2])", "x[1]", "x[2]"]);
}
