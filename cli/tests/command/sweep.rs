//! `lagrangian sweep`: many runs as a user sees them, against closed forms and `simulate`, and with the process killed
//! on the way.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::support::{Scratch, lagrangian, root};
use serde_json::Value;

/// A mass of 1 kg on a spring, with a force as input.
const OSCILLATOR: &str = "machine Oscillator in plane {
    parameters { m: kg = 1, k: N/m = 4 }
    coordinates { x: m = 0.1 }
    inputs { push: N = 0 }
    bodies { block { mass: m, at: (x, 0) } }
    springs { spring { stiffness: k, stretch: x } }
    forces { push { on: x, value: push } }
    outputs { pull: N = k*x, speed: km/h = der(x) }
}
";

/// The output of a call, and its exit status.
struct Said {
    status: i32,
    out: String,
    error: String,
}

fn sweep(spec: &str, out: &Path, arguments: &[&str]) -> Said {
    let out = out.to_str().expect("text");
    let output = lagrangian(&[&["sweep", spec, "--out", out], arguments].concat());
    let text = |bytes| String::from_utf8(bytes).expect("text");
    Said {
        status: output.status.code().expect("no signal"),
        out: text(output.stdout),
        error: text(output.stderr),
    }
}

/// The columns of a table, as texts.
fn read(path: &Path) -> BTreeMap<String, Vec<String>> {
    let text = std::fs::read_to_string(path).expect("a table");
    // A comma within quotes is part of a message.
    let cells = |line: &str| {
        let mut is_quoted = false;
        let cells = line.split(move |c: char| {
            is_quoted ^= c == '"';
            c == ',' && !is_quoted
        });
        cells
            .map(|cell| cell.trim_matches('"').to_owned())
            .collect::<Vec<_>>()
    };
    let mut rows = text.lines().map(cells);
    let names: Vec<String> = rows.next().expect("a head");
    let mut columns: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for row in rows {
        for (name, cell) in names.iter().zip(row) {
            columns.entry(name.clone()).or_default().push(cell);
        }
    }
    columns
}

fn numbers(columns: &BTreeMap<String, Vec<String>>, name: &str) -> Vec<f64> {
    let column = columns.get(name);
    let column = column.unwrap_or_else(|| panic!("no column {name} in {:?}", columns.keys()));
    column
        .iter()
        .map(|cell| cell.parse().expect("a number"))
        .collect()
}

/// x = x₀ cos ωt with ω = √(k/m): all reductions in closed form.
#[test]
fn reductions_are_those_of_a_cosine() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let out = spec.0.with_file_name("rows.csv");
    let said = sweep(
        spec.path(),
        &out,
        &[
            "--until",
            "10",
            "--tolerance",
            "1e-12",
            "--after",
            "1",
            "--vary",
            "k=1..9:3",
            "--vary",
            "start(x)=0.1,-0.2",
            "--reduce",
            "peak = max(abs(x))",
            "--reduce",
            "highest = max(x)",
            "--reduce",
            "lowest = min(x)",
            "--reduce",
            "width = range(der(x))",
            "--reduce",
            "mean = mean(x)",
            "--reduce",
            "rms = rms(x)",
            "--reduce",
            "integral = integral(x)",
            "--reduce",
            "first = first(x)",
            "--reduce",
            "last = last(pull)",
            "--reduce",
            "when = when_max(x)",
            "--reduce",
            "pull = max(abs(m*der(der(x))))",
            "--reduce",
            "dip = min(abs(x))",
            "--event",
            "middle = x",
            "--reduce",
            "crossings = count(middle)",
            "--reduce",
            "early = first(middle)",
            "--reduce",
            "late = last(middle)",
            "--record",
            "at=0,2.5,10",
        ],
    );
    assert_eq!(said.status, 0, "{}", said.error);
    assert!(said.out.starts_with("6 runs, 0 failed, "), "{}", said.out);
    assert!(!out.with_file_name("rows.csv.part").exists());
    let rows = read(&out);
    let column = |name: &str| numbers(&rows, name);
    assert_eq!(column("run"), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    assert_eq!(column("k"), [1.0, 1.0, 5.0, 5.0, 9.0, 9.0]);
    assert_eq!(column("start(x)"), [0.1, -0.2, 0.1, -0.2, 0.1, -0.2]);
    assert!(rows["status"].iter().all(|status| status == "ended"));
    for run in 0..6 {
        let (k, start) = (column("k")[run], column("start(x)")[run]);
        let omega = k.sqrt();
        let (from, to) = (1.0, 10.0);
        let x = |t: f64| start * (omega * t).cos();
        let v = |t: f64| -start * omega * (omega * t).sin();
        // A step with tolerance 1e-12 has that error relative to 1 m; the errors of some hundred steps accumulate.
        let near = |name: &str, known: f64, tolerance: f64| {
            let found = column(name)[run];
            assert!(
                (found - known).abs() <= tolerance,
                "{name} of run {run}: {found}, not {known}"
            );
        };
        let close = 2e-10;
        near("x", x(to), close);
        near("der(x)", v(to), 3.0 * close);
        near("x@0", start, 0.0);
        near("x@2.5", x(2.5), close);
        near("der(x)@2.5", v(2.5), 3.0 * close);
        near("x@10", column("x")[run], 0.0);
        near("first", x(from), close);
        near("last", k * x(to), 9.0 * close);
        // The interval from 1 s to 10 s contains more than a whole period.
        near("peak", start.abs(), close);
        near("highest", start.abs(), close);
        near("lowest", -start.abs(), close);
        near("dip", 0.0, close);
        near("width", 2.0 * start.abs() * omega, 6.0 * close);
        near("pull", k * start.abs(), 9.0 * close);
        let integral = start / omega * ((omega * to).sin() - (omega * from).sin());
        near("integral", integral, 9.0 * close);
        near("mean", integral / (to - from), close);
        let square = |t: f64| 0.5 * t + (2.0 * omega * t).sin() / (4.0 * omega);
        let rms = (start * start * (square(to) - square(from)) / (to - from)).sqrt();
        near("rms", rms, close);
        // The maximum is at every second multiple of half a period. Near it x is flat, so t is only known to the square root of
        // the error, 1e-5.
        let phase = omega * column("when")[run] / std::f64::consts::PI;
        let is_even = (phase.round() as i64) % 2 == 0;
        assert!(
            (phase - phase.round()).abs() < 1e-4 && is_even == (start > 0.0),
            "{phase}"
        );
        let crossing = |n: f64| (n + 0.5) * std::f64::consts::PI / omega;
        let all: Vec<f64> = (0..20)
            .map(|n| crossing(f64::from(n)))
            .filter(|t| (from..to).contains(t))
            .collect();
        assert_eq!(column("crossings")[run], all.len() as f64);
        near("early", all[0], 1e-8);
        near("late", all[all.len() - 1], 1e-8);
        near("energy residual", 0.0, 1e-10);
    }
}

/// Row i equals the result of `simulate` with the same numbers bit for bit, whatever the thread, chunk, engine or format.
#[test]
fn rows_are_those_of_simulate_in_every_bit() {
    let spec = "machines/double_pendulum.machine";
    let folder = Scratch::new("a", "");
    let at = |name: &str| folder.0.with_file_name(name);
    let design = [
        "--until",
        "2",
        "--vary",
        "start(theta1)=1..3:40",
        "--vary",
        "m2=0.5,1.5",
        "--reduce",
        "fast = max(abs(der(theta2)))",
    ];
    let mut tables = Vec::new();
    for (name, further) in [
        ("one.csv", &["--threads", "1"][..]),
        ("many.csv", &["--threads", "3"]),
        ("interpreted.csv", &["--engine", "interpreter"]),
        // In lanes from the first run.
        ("compiled.csv", &["--engine", "jit"]),
    ] {
        let said = sweep(spec, &at(name), &[&design, further].concat());
        assert_eq!(said.status, 0, "{}", said.error);
        tables.push(std::fs::read(at(name)).expect("a table"));
    }
    assert!(tables.iter().all(|table| *table == tables[0]));
    let rows = read(&at("one.csv"));
    for run in (0..80).step_by(9) {
        let theta = format!("theta1={}", rows["start(theta1)"][run]);
        let mass = format!("m2={}", rows["m2"][run]);
        let output = lagrangian(&[
            "simulate", spec, "--until", "2", "--one-of", "80", "--json", "--start", &theta,
            "--set", &mass,
        ]);
        let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        for (name, value) in [
            ("theta1", &document["q"]["theta1"]),
            ("theta2", &document["q"]["theta2"]),
            ("der(theta1)", &document["v"]["theta1"]),
            ("der(theta2)", &document["v"]["theta2"]),
            ("steps", &document["steps"]),
            ("energy residual", &document["energy_residual"]),
        ] {
            assert_eq!(
                numbers(&rows, name)[run],
                value.as_f64().expect("a number"),
                "{name} of run {run}"
            );
        }
    }
}

/// Runs choose their methods as `simulate` does, and rows tell which ones and why, whatever the engine and the number of threads.
#[test]
fn rows_of_long_and_of_stiff_runs_are_those_of_simulate() {
    let spec = "machines/double_pendulum.machine";
    let folder = Scratch::new("a", "");
    let at = |name: &str| folder.0.with_file_name(name);
    let design = [
        "--until",
        "150",
        "--tolerance",
        "1e-12",
        "--vary",
        "start(theta1)=0.2..0.6:9",
    ];
    let mut tables = Vec::new();
    for (name, further) in [
        ("one.csv", &["--threads", "1"][..]),
        ("many.csv", &["--threads", "3"]),
        ("compiled.csv", &["--engine", "jit"]),
    ] {
        let said = sweep(spec, &at(name), &[&design, further].concat());
        assert_eq!(said.status, 0, "{}", said.error);
        tables.push(std::fs::read(at(name)).expect("a table"));
    }
    assert!(tables.iter().all(|table| *table == tables[0]));
    let rows = read(&at("one.csv"));
    for run in [0, 5, 8] {
        let theta = format!("theta1={}", rows["start(theta1)"][run]);
        let output = lagrangian(&[
            "simulate",
            spec,
            "--until",
            "150",
            "--tolerance",
            "1e-12",
            "--one-of",
            "9",
            "--json",
            "--start",
            &theta,
        ]);
        let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        for (name, value) in [
            ("theta1", &document["q"]["theta1"]),
            ("der(theta2)", &document["v"]["theta2"]),
            ("steps", &document["steps"]),
            ("energy residual", &document["energy_residual"]),
        ] {
            let value = value.as_f64().expect("a number");
            assert_eq!(numbers(&rows, name)[run], value, "{name} of run {run}");
        }
        let methods = document["methods"].as_array().expect("methods");
        let told = &rows["methods"][run];
        assert_eq!(methods[1]["method"], "taylor", "{document:#}");
        let since = methods[1]["t"].as_f64().expect("a number");
        let expected = format!("dop853, taylor from {since} s (");
        assert!(told.starts_with(&expected) && told.ends_with(')'), "{told}");
    }
    let said = sweep(spec, &at("told.csv"), &[&design[..], &["--json"]].concat());
    let document: Value = serde_json::from_str(&said.out).expect("JSON");
    assert_eq!(
        document["methods"],
        serde_json::json!({"dop853, taylor": 9})
    );
    let said = sweep(spec, &at("told.csv"), &design);
    assert!(
        said.out.contains("  dop853, taylor: 9 runs"),
        "{}",
        said.out
    );

    let said = sweep(
        spec,
        &at("wrong.csv"),
        &["--until", "1", "--method", "aut", "--vary", "m2=1,2"],
    );
    assert!(
        said.status != 0 && said.error.contains("did you mean `auto`?"),
        "{}",
        said.error
    );

    // A method that is given is not told in the rows.
    let said = sweep(
        spec,
        &at("given.csv"),
        &["--until", "1", "--method", "dop853", "--vary", "m2=1,2"],
    );
    assert_eq!(said.status, 0, "{}", said.error);
    assert!(!read(&at("given.csv")).contains_key("methods"));
}

/// Runs that are too short for a series each share its derivation: all of them go by series from the start if they are many, whatever chunk they are made
/// in and when. Each is the run that `simulate` makes as one of so many, and that by series, in every bit.
#[test]
fn many_short_runs_share_the_derivation_of_the_series() {
    let spec = "machines/double_pendulum.machine";
    let folder = Scratch::new("a", "");
    let at = |name: &str| folder.0.with_file_name(name);
    let design = ["--until", "1", "--vary", "start(theta1)=0.2..0.6:4000"];
    let out = at("rows.csv");
    // In two calls, with one thread and with two.
    let said = sweep(
        spec,
        &out,
        &[&design[..], &["--limit", "300", "--threads", "1"]].concat(),
    );
    assert_eq!(said.status, 0, "{}", said.error);
    let said = sweep(spec, &out, &[&design[..], &["--threads", "2"]].concat());
    assert_eq!(said.status, 0, "{}", said.error);
    assert!(said.out.contains("  taylor: 4000 runs"), "{}", said.out);
    let rows = read(&out);
    assert!(rows["methods"].iter().all(|methods| methods == "taylor"));
    for run in [0, 137, 3999] {
        let theta = format!("theta1={}", rows["start(theta1)"][run]);
        for further in [&["--one-of", "4000"], &["--method", "taylor"]] {
            let call = [
                "simulate", spec, "--until", "1", "--json", "--start", &theta,
            ];
            let output = lagrangian(&[&call, &further[..]].concat());
            let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
            for (name, value) in [
                ("theta2", &document["q"]["theta2"]),
                ("der(theta1)", &document["v"]["theta1"]),
                ("steps", &document["steps"]),
            ] {
                let value = value.as_f64().expect("a number");
                assert_eq!(
                    numbers(&rows, name)[run],
                    value,
                    "{name} of run {run}, {further:?}"
                );
            }
        }
    }
    // One run of these stays with the usual method, and others do not choose.
    let alone = lagrangian(&["simulate", spec, "--until", "1", "--json"]);
    let document: Value = serde_json::from_slice(&alone.stdout).expect("JSON");
    assert_eq!(document["methods"][0]["method"], "dop853", "{document:#}");
    for wrong in [
        &["--one-of", "9", "--method", "taylor"][..],
        &["--one-of", "9", "--precision", "dd"],
        &["--one-of", "9", "--validated"],
        &["--one-of", "0"],
        &["--one-of", "1.5"],
    ] {
        let output = lagrangian(&[&["simulate", spec, "--until", "1"], wrong].concat());
        let error = String::from_utf8(output.stderr).expect("text");
        assert!(
            !output.status.success() && error.contains("--one-of"),
            "{wrong:?}: {error}"
        );
    }
}

/// Machines with friction, constraints and collisions use the same code path.
#[test]
fn every_kind_of_machine_is_swept_as_it_is_simulated() {
    for (spec, vary, name) in [
        ("machines/stick_slip.machine", "rate(x)=0.1,0.3", "x"),
        ("machines/four_bar.machine", "rate(crank)=1,2", "crank"),
        (
            "machines/contacts/bouncing_ball.machine",
            "start(y)=1,2",
            "y",
        ),
    ] {
        let folder = Scratch::new("a", "");
        let out = folder.0.with_file_name("rows.csv");
        let said = sweep(spec, &out, &["--until", "0.7", "--vary", vary]);
        assert_eq!(said.status, 0, "{spec}: {}", said.error);
        let rows = read(&out);
        for run in 0..2 {
            let (option, _) = vary.split_once('(').expect("a bracket");
            let value = &rows[vary.split_once('=').expect("a sign").0][run];
            let given = format!("{name}={value}");
            let option = format!("--{option}");
            let output = lagrangian(&[
                "simulate", spec, "--until", "0.7", "--one-of", "2", "--json", &option, &given,
            ]);
            let document: Value = serde_json::from_slice(&output.stdout).expect("JSON");
            assert_eq!(
                numbers(&rows, name)[run],
                document["q"][name].as_f64().expect("a number"),
                "{spec}"
            );
            assert_eq!(
                numbers(&rows, "steps")[run],
                document["steps"].as_f64().expect("a number")
            );
        }
    }
}

/// A sweep that is killed at any instant and resumed until it is done writes the same file, byte for byte, as one that
/// is not interrupted.
#[test]
fn what_is_killed_goes_on_to_the_same_bytes() {
    let spec = "machines/double_pendulum.machine";
    let folder = Scratch::new("a", "");
    for ending in ["csv", "parquet"] {
        let alone = folder.0.with_file_name(format!("alone.{ending}"));
        let killed = folder.0.with_file_name(format!("killed.{ending}"));
        let design = [
            "--until",
            "20",
            "--vary",
            "start(theta1)=0.5..3:96",
            "--record",
            "every=5",
            "--reduce",
            "turns = last(theta2)",
            "--threads",
            "2",
        ];
        let began = Instant::now();
        let said = sweep(spec, &alone, &design);
        assert_eq!(said.status, 0, "{}", said.error);
        let whole = began.elapsed();
        // The random number generator only has to make the instants differ from run to run.
        let mut state = u64::from(std::process::id()) ^ began.elapsed().as_nanos() as u64 | 1;
        println!("seed {state}");
        let part = killed.with_file_name(format!("killed.{ending}.part"));
        for kill in 0..5 {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let after = whole.mul_f64((state >> 40) as f64 / (1u64 << 24) as f64);
            let mut child = Command::new(env!("CARGO_BIN_EXE_lagrangian"))
                .current_dir(root())
                .args(["sweep", spec, "--out", killed.to_str().expect("text")])
                .args(design)
                .stdin(Stdio::null())
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .spawn()
                .expect("the command runs");
            let until = Instant::now() + after.min(Duration::from_secs(5));
            while Instant::now() < until && child.try_wait().expect("a status").is_none() {
                std::thread::sleep(Duration::from_millis(2));
            }
            child.kill().expect("it may be killed"); // SIGKILL; nothing happens if the process has ended
            child.wait().expect("a status");
            println!(
                "kill {kill} after {after:?}, {} of it there",
                if part.exists() {
                    "a part"
                } else {
                    "nothing or all"
                }
            );
        }
        let said = sweep(spec, &killed, &design);
        assert_eq!(said.status, 0, "{}", said.error);
        assert!(!part.exists());
        for suffix in ["", "samples."] {
            let bytes = |name: &str| {
                let path = folder.0.with_file_name(format!("{name}.{suffix}{ending}"));
                std::fs::read(path).expect("a table")
            };
            assert!(bytes("alone") == bytes("killed"), "{suffix}{ending}");
        }
    }
}

/// A plan may have more runs than will ever be made: the first ones are made as of any other plan, and the same call continues.
#[test]
fn a_plan_without_end_is_begun_and_continued() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let out = spec.0.with_file_name("endless.csv");
    let began = Instant::now();
    let mut kept = 0;
    for _ in 0..2 {
        let call = ["--until", "1e-3", "--vary", "start(x)=0..1:1000000000000"];
        let settings = ["--limit", "1", "--json", "--threads", "2000"];
        let said = sweep(spec.path(), &out, &[&call[..], &settings].concat());
        assert_eq!(said.status, 0, "{}", said.error);
        let document: Value = serde_json::from_str(&said.out).expect("a document");
        assert_eq!(document["of"], 1_000_000_000_000_u64, "{document}");
        let runs = document["runs"].as_u64().expect("a number");
        assert!(runs > kept, "{runs} after {kept}");
        kept = runs;
    }
    // To look for each of the 15 million chunks would take minutes.
    assert!(
        began.elapsed() < Duration::from_secs(60),
        "{:?}",
        began.elapsed()
    );
}

/// A failure to write is reported, and existing results stay: a limit on the size of files simulates a full disk.
#[cfg(unix)]
#[test]
fn a_full_disk_ends_a_sweep_that_goes_on_later() {
    let folder = Scratch::new("a", "");
    let out = folder.0.with_file_name("rows.csv");
    let spec = "machines/simple_pendulum.machine";
    let design = [
        "--until",
        "1",
        "--vary",
        "start(theta)=0.1..1:3000",
        "--threads",
        "1",
    ];
    // Blocks of 512 or 1024 bytes: the table has about 200 kB, and a chunk is a part of it.
    let script = "trap '' XFSZ; ulimit -f 100; exec \"$@\"";
    let output = Command::new("sh")
        .current_dir(root())
        .args([
            "-c",
            script,
            "sh",
            env!("CARGO_BIN_EXE_lagrangian"),
            "sweep",
            spec,
            "--out",
            out.to_str().expect("text"),
        ])
        .args(design)
        .output()
        .expect("a shell");
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(
        error.contains("cannot write") && error.contains("the same command resumes the sweep"),
        "{error}"
    );
    assert!(!out.exists());
    let said = sweep(spec, &out, &design);
    assert_eq!(said.status, 0, "{}", said.error);
    assert_eq!(read(&out)["run"].len(), 3000);
}

#[test]
fn a_run_that_fails_is_a_row() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let out = spec.0.with_file_name("rows.csv");
    let design = [
        "--until",
        "1",
        "--vary",
        "m=1,-1,2",
        "--reduce",
        "peak = max(x)",
        "--json",
    ];
    let said = sweep(spec.path(), &out, &design);
    assert_eq!(said.status, 0, "{}", said.error);
    let document: Value = serde_json::from_str(&said.out).expect("JSON");
    assert_eq!(
        (&document["runs"], &document["failed"]),
        (&3.into(), &1.into())
    );
    assert_eq!(document["first_errors"][0]["run"], 1);
    let rows = read(&out);
    assert_eq!(rows["status"], ["ended", "failed", "ended"]);
    assert!(rows["error"][1].contains("mass"), "{:?}", rows["error"]);
    assert_eq!(rows["peak"][1], "");
    assert_eq!(rows["x"][1], "0.1");
    assert_eq!(rows["peak"][0], "0.1");
    // Too few steps are a failure during the run: the results up to that point are kept.
    let strict = [
        "--until",
        "9",
        "--vary",
        "m=1",
        "--max-steps",
        "5",
        "--strict",
        "--fresh",
    ];
    let said = sweep(spec.path(), &out, &strict);
    assert_eq!(said.status, 1);
    let rows = read(&out);
    assert!(
        rows["error"][0].contains("--max-steps"),
        "{:?}",
        rows["error"]
    );
    let t = numbers(&rows, "t")[0];
    assert!(t > 0.0 && t < 9.0 && rows["steps"][0] == "5");
}

/// A free fall of 1 m takes √(2h/g), whatever force acts sideways; inputs may be formulas or tables.
#[test]
fn events_end_runs_and_inputs_follow_formulas_and_tables() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let out = spec.0.with_file_name("rows.csv");
    // x'' = push − x·k with k = 0: push = 6 t gives x = x₀ + t³.
    let table = spec.0.with_file_name("push.csv");
    std::fs::write(&table, "t [s],push [N]\n0,0\n10,60\n").expect("a file");
    let from_table = format!("push={}", table.display());
    for input in ["push=6*N/s*t", &from_table] {
        let said = sweep(
            spec.path(),
            &out,
            &[
                "--until",
                "5",
                "--vary",
                "k=0",
                "--vary",
                "start(x)=0,-1",
                "--input",
                input,
                "--until-event",
                "far = x - 8",
                "--fresh",
            ],
        );
        assert_eq!(said.status, 0, "{}", said.error);
        let rows = read(&out);
        assert_eq!(rows["status"], ["event far", "event far"]);
        for (t, known) in numbers(&rows, "t").into_iter().zip([2.0, 9.0_f64.cbrt()]) {
            // A relative tolerance of 1e-9 in at most a hundred steps, relative to 8 m at a rate of 12 m/s.
            assert!((t - known).abs() < 1e-7, "{t} {known}");
        }
    }
}

/// A plan that is run in parts by several calls gives the same table as one sweep.
#[test]
fn chunks_of_a_plan_make_the_same_table() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let at = |name: &str| spec.0.with_file_name(name);
    let (whole, joined, plan) = (at("whole.csv"), at("joined.csv"), at("plan.json"));
    let design = [
        "--until",
        "1",
        "--samples",
        "40",
        "--design",
        "latin",
        "--seed",
        "3",
        "--vary",
        "k~normal(4,0.5)",
        "--vary",
        "start(x)=0.1..0.2",
    ];
    assert_eq!(sweep(spec.path(), &whole, &design).status, 0);
    let path = plan.to_str().expect("text");
    let output = lagrangian(&[&["sweep", spec.path(), "--plan", path], &design[..]].concat());
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = std::fs::read_to_string(&plan).expect("a plan");
    let mut value: Value = serde_json::from_str(&text).expect("JSON");
    value["chunk"] = 16.into();
    std::fs::write(&plan, value.to_string()).expect("a plan");
    for chunk in ["2", "0", "1"] {
        let said = sweep(path, &joined, &["--chunk", chunk]);
        assert_eq!(said.status, 0, "{}", said.error);
    }
    assert_eq!(sweep(path, &joined, &["--chunk", "3"]).status, 2);
    let said = sweep(path, &joined, &[]);
    assert_eq!(said.status, 0, "{}", said.error);
    let bytes = |path: &Path| std::fs::read(path).expect("a table");
    assert!(bytes(&whole) == bytes(&joined));
}

#[test]
fn a_table_says_runs_and_lists_go_together() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let at = |name: &str| spec.0.with_file_name(name);
    let (crossed, tabled) = (at("together.csv"), at("tabled.csv"));
    let design = [
        "--until",
        "1",
        "--vary",
        "m=1,2",
        "--vary",
        "k=3..5:2",
        "--together",
        "m,k",
        "--vary",
        "start(x)=0.1,0.3",
    ];
    let said = sweep(spec.path(), &crossed, &design);
    assert_eq!(said.status, 0, "{}", said.error);
    let rows = read(&crossed);
    assert_eq!(numbers(&rows, "m"), [1.0, 1.0, 2.0, 2.0]);
    assert_eq!(numbers(&rows, "k"), [3.0, 3.0, 5.0, 5.0]);
    assert_eq!(numbers(&rows, "start(x)"), [0.1, 0.3, 0.1, 0.3]);
    let sets = at("sets.csv");
    std::fs::write(
        &sets,
        "m [kg],k [N/m],start(x) [m]\n1,3,0.1\n1,3,0.3\n2,5,0.1\n2,5,0.3\n",
    )
    .expect("a file");
    let said = sweep(
        spec.path(),
        &tabled,
        &["--until", "1", "--table", sets.to_str().expect("text")],
    );
    assert_eq!(said.status, 0, "{}", said.error);
    assert_eq!(
        std::fs::read(&crossed).expect("a table"),
        std::fs::read(&tabled).expect("a table")
    );
}

/// A header says in which unit its column is, whatever unit the spec declares, and of what the spec has a formula for.
#[test]
fn a_table_of_runs_may_have_other_units_than_the_spec() {
    let spec = "machine Oscillator in plane {
        parameters { m: g = 1000, l: mm = 500, J: kg*m^2 = m*l^2, k: N*m = 4 }
        coordinates { phi: rad = 0.1 }
        bodies { wheel { mass: m, inertia: J, at: (0, 0), angle: phi } }
        gravity none;
        torsion_springs { spring { stiffness: k, twist: phi } }
    }";
    let spec = Scratch::new("oscillator.machine", spec);
    let at = |name: &str| spec.0.with_file_name(name);
    let run = |table: &str| {
        let sets = at("sets.csv");
        std::fs::write(&sets, table).expect("a file");
        let sets = sets.to_str().expect("text").to_owned();
        let out = at("units.csv");
        let more = ["--until", "1", "--fresh", "--table", &sets];
        let said = sweep(spec.path(), &out, &more);
        (said, out)
    };
    let (said, out) = run("l [m],m,start(phi) [deg],rate(phi) [rpm]\n0.4,2000,3,1\n0.5,1e3,0,6\n");
    assert_eq!(said.status, 0, "{}", said.error);
    let rows = read(&out);
    assert_eq!(numbers(&rows, "l"), [400.0, 500.0]);
    let degree = std::f64::consts::PI / 180.0;
    // phi = φ₀ cos ωt + (ω₀/ω) sin ωt with ω = √(k/J), J = m l².
    let expected = |inertia: f64, start: f64, rate: f64| {
        let omega = (4.0 / inertia).sqrt();
        start * omega.cos() + rate / omega * omega.sin()
    };
    let found = numbers(&rows, "phi");
    let exact = [
        expected(2.0 * 0.16, 3.0 * degree, 6.0 * degree),
        expected(0.25, 0.0, 36.0 * degree),
    ];
    for (found, exact) in found.iter().zip(exact) {
        // The default tolerance is 1e-9 in each of some ten steps.
        assert!((found - exact).abs() < 1e-8, "{found} {exact}");
    }
    // A value for what has a formula.
    let (said, out) = run("J [kg*m^2]\n0.32\n0.25\n");
    assert_eq!(said.status, 0, "{}", said.error);
    for (found, inertia) in numbers(&read(&out), "phi").iter().zip([0.32, 0.25]) {
        assert!(
            (found - expected(inertia, 0.1, 0.0)).abs() < 1e-8,
            "{found}"
        );
    }
    let (said, _) = run("l [s]\n0.4\n");
    assert_eq!(said.status, 2);
    assert!(said.error.contains("column `l`"), "{}", said.error);
}

/// Integrals of what is not smooth, and of what oscillates many times in a step: a wheel turns uniformly, in a few steps.
#[test]
fn integrals_see_kinks_jumps_and_many_turns_in_a_step() {
    let spec = "machine Wheel in plane {
        parameters { J: kg*m^2 = 2 }
        coordinates { phi: rad = 0.2, der(phi): rad/s = 7 }
        bodies { wheel { mass: 1*kg, inertia: J, at: (0, 0), angle: phi } }
        gravity none;
    }";
    let spec = Scratch::new("wheel.machine", spec);
    let out = spec.0.with_file_name("rows.csv");
    let reductions = [
        "rms = rms(cos(phi))",
        "size = integral(abs(cos(phi)))",
        "upper = mean(max(cos(phi), 0))",
        "share = mean(sign(cos(phi)))",
    ];
    let mut more = vec!["--until", "100", "--vary", "J=2"];
    more.extend(reductions.iter().flat_map(|one| ["--reduce", one]));
    let said = sweep(spec.path(), &out, &more);
    assert_eq!(said.status, 0, "{}", said.error);
    let rows = read(&out);
    assert!(numbers(&rows, "steps")[0] < 20.0);
    // From φ = 0.2 to 700.2: ∫ cos² = (φ + sin φ cos φ)/2; ∫ |cos| = 2n + sin(φ − nπ) with n = ⌊φ/π + ½⌋;
    // ∫ sign(cos) is the triangle wave of slope ±1 with extremes at odd multiples of π/2.
    let (from, to) = (0.2_f64, 700.2_f64);
    let between = |f: &dyn Fn(f64) -> f64| f(to) - f(from);
    let turns = |x: f64| (x / std::f64::consts::PI + 0.5).floor();
    let beside = |x: f64| x - turns(x) * std::f64::consts::PI;
    let size = between(&|x| 2.0 * turns(x) + beside(x).sin());
    let sine = between(&f64::sin);
    let square = between(&|x| 0.5 * (x + x.sin() * x.cos()));
    let triangle = between(&|x| beside(x) * if turns(x) % 2.0 == 0.0 { 1.0 } else { -1.0 });
    let exact = [
        ("rms", (square / 700.0).sqrt()),
        ("size", size / 7.0),
        ("upper", 0.5 * (size + sine) / 700.0),
        ("share", triangle / 700.0),
    ];
    for (name, exact) in exact {
        let found = numbers(&rows, name)[0];
        // Some hundred intervals with a kink or a jump, of 1e-11 of the integral each.
        assert!(
            (found - exact).abs() < 1e-8 * exact.abs().max(1.0),
            "{name}: {found} {exact}"
        );
    }
}

#[test]
fn what_makes_no_sense_is_refused_before_the_first_run() {
    let spec = Scratch::new("oscillator.machine", OSCILLATOR);
    let out = spec.0.with_file_name("rows.csv");
    for (arguments, words) in [
        (&["--vary", "kk=1..2:3"][..], "did you mean `k`?"),
        (&["--vary", "x=1,2"], "whose start is `start(x)`"),
        (&["--vary", "k=1..2:0"], "a whole number from 1"),
        (&["--vary", "k=-1..2:3:log"], "the same sign"),
        (
            &[
                "--vary", "k=1,2", "--event", "low=x", "--record", "event=lo",
            ],
            "did you mean `low`?",
        ),
        (
            &[
                "--vary",
                "k=1,2",
                "--event",
                "low=x",
                "--record",
                "event=low",
                "--record",
                "every=0.1",
            ],
            "all samples must be drawn in one way",
        ),
        (
            &["--vary", "k=1,2", "--record", "event=low,low"],
            "`low` is given more than once",
        ),
        (&["--vary", "k=3*m"], "--vary k=3*m: expected N/m, found m"),
        (&["--vary", "k=1..2"], "--samples N"),
        (
            &["--vary", "k~normal(1,0)", "--samples", "3"],
            "greater than 0",
        ),
        (
            &["--vary", "k~norma(1,2)", "--samples", "3"],
            "expected uniform",
        ),
        (
            &["--vary", "k=1,2", "--vary", "k=3,4"],
            "varied more than once",
        ),
        (
            &["--vary", "k=1,2", "--set", "k=3"],
            "also has one value for all runs",
        ),
        (
            &["--vary", "k=1..2:1000000", "--vary", "m=1..2:10000000"],
            "more than 2^40 runs",
        ),
        (
            &["--vary", "k=1,2", "--together", "k,m"],
            "`m` is not varied by a list or a grid",
        ),
        (&["--reduce", "p = max(y)"], "nothing is named `y`"),
        (&["--reduce", "p = maxi(x)"], "did you mean `max`?"),
        (&["--reduce", "p = max((x, 1))"], "--reduce p"),
        (&["--reduce", "p = max(x + 1*s)"], "--reduce p"),
        (&["--reduce", "p = count(top)"], "no event named `top`"),
        (&["--reduce", "t = max(x)"], "two columns"),
        (&["--event", "e = der(der(x))"], "accelerations"),
        (&["--input", "pusch=1"], "did you mean `push`?"),
        (&["--input", "push=der(x)"], "--input push"),
        (&["--record", "at=7"], "not within the run"),
        (
            &["--after", "3", "--reduce", "p = max(x)"],
            "not within the run",
        ),
        (&["--record", "often"], "expected end"),
        (&["--method", "dop835"], "did you mean `dop853`?"),
        (&["--chunk", "3"], "write a plan by --plan"),
        (&["--seed", "3"], "--seed: nothing is sampled"),
        (
            &["--event", "x=t-0.5*s", "--reduce", "p = first(x)"],
            "`x` is an event and also a quantity",
        ),
        (
            &["--event", "e=x", "--until-event", "e=t-0.5*s"],
            "both name an event `e`",
        ),
        (&["--design", "latin"], "--design: nothing is sampled"),
        (&["--after", "0.5"], "there are none"),
    ] {
        let arguments = [&["--until", "1"], arguments].concat();
        let said = sweep(spec.path(), &out, &arguments);
        assert_eq!(said.status, 2, "{arguments:?}: {}{}", said.out, said.error);
        assert!(said.error.contains(words), "{arguments:?}: {}", said.error);
        assert!(!out.exists());
        let folder = out.with_extension("csv.part");
        assert!(!folder.exists(), "{arguments:?} leaves {folder:?}");
    }
    // Another plan instead of one that was begun.
    let begun = ["--until", "1", "--vary", "k=1..2:100", "--limit", "1"];
    let said = sweep(spec.path(), &out, &begun);
    assert_eq!(said.status, 0, "{}", said.error);
    if said.out.contains("the same command resumes the sweep") {
        let other = [
            "--until",
            "1",
            "--vary",
            "k=1..2:100",
            "--tolerance",
            "1e-8",
        ];
        let said = sweep(spec.path(), &out, &other);
        assert_eq!(said.status, 2);
        assert!(
            said.error
                .contains("tolerance: 1e-8, was 1e-9; --fresh begins again"),
            "{}",
            said.error
        );
        assert_eq!(
            sweep(spec.path(), &out, &[&other[..], &["--fresh"]].concat()).status,
            0
        );
    }
}

/// No input of a sweep is overwritten under any name, and no file gets an extension that contradicts its format.
#[test]
fn what_a_sweep_reads_it_does_not_write() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let files = [
        ("oscillator.machine", OSCILLATOR),
        (
            "top.machine",
            "machine Top extends \"oscillator.machine\" { parameters { m: kg = 2 } }\n",
        ),
        ("sets.csv", "k\n1\n2\n"),
        ("push.csv", "t,push\n0,0\n1,1\n"),
        ("rows.samples.csv", "k\n1\n2\n"),
    ];
    for (name, text) in files {
        std::fs::write(at(name), text).expect("a file");
    }
    std::fs::hard_link(at("oscillator.machine"), at("base.csv")).expect("a link");
    let path = |name: &str| at(name).to_str().expect("text").to_owned();
    let input = format!("push={}", path("push.csv"));
    let table = path("sets.csv");
    let samples = path("rows.samples.csv");
    for (out, arguments, words) in [
        ("sets.csv", &["--table", &table][..], "the table of runs"),
        (
            "rows.csv",
            &["--table", &samples, "--record", "every=0.1"],
            "the table of runs",
        ),
        (
            "push.csv",
            &["--vary", "k=1,2", "--input", &input],
            "the table of an input",
        ),
        ("base.csv", &["--vary", "k=1,2"], "which the spec extends"),
        (
            "rows.json",
            &["--vary", "k=1,2"],
            "rows go to a `.csv`, a `.parquet` or a folder",
        ),
        (
            "rows.csv.gz",
            &["--vary", "k=1,2"],
            "rows go to a `.csv`, a `.parquet` or a folder",
        ),
    ] {
        let arguments = [&["--until", "1"], arguments].concat();
        let said = sweep(&path("top.machine"), &at(out), &arguments);
        assert_eq!(said.status, 2, "{out}: {}{}", said.out, said.error);
        assert!(said.error.contains(words), "{out}: {}", said.error);
    }
    for (name, text) in files {
        assert_eq!(
            std::fs::read_to_string(at(name)).expect("a file"),
            text,
            "{name}"
        );
    }
    assert!(!at("rows.json").exists() && !at("rows.csv.gz").exists());
    // The case of an extension is ignored, and a trailing slash makes any name a folder.
    let vary = ["--until", "1", "--vary", "k=1,2"];
    for (out, made) in [("ROWS.CSV", "ROWS.CSV"), ("a.b/", "a.b/plan.json")] {
        let said = sweep(&path("top.machine"), Path::new(&path(out)), &vary);
        assert_eq!(said.status, 0, "{out}: {}", said.error);
        assert!(at(made).is_file(), "{out}");
    }
}
