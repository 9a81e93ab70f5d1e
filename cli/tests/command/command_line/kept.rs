//! No data is lost: input files are never overwritten, files are written completely or not at all, and a failure to
//! write is reported.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::{err, json, out, status};
use crate::support::{lagrangian, root};

/// A falling ball, whose runs take almost no time.
const BALL: &str = "machine Ball in plane {\n    parameters { m: kg = 1, g: m/s^2 = 9.81 }\n    \
     coordinates { x: m, y: m }\n    bodies { ball { mass: m, at: (x, y) } }\n    gravity (0, -g);\n}\n";

/// A folder that is removed when the test ends.
pub struct Folder(tempfile::TempDir);

impl Folder {
    pub fn new() -> Folder {
        Folder(tempfile::tempdir().expect("a folder"))
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn file(&self, name: &str, text: &str) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, text).expect("a file");
        path
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("a file")
    }

    /// The sorted names of its files.
    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("a folder");
        let names = entries.map(|entry| entry.expect("an entry").file_name());
        let mut names: Vec<String> = names
            .map(|name| name.into_string().expect("text"))
            .collect();
        names.sort();
        names
    }

    /// The command, with this folder as its working directory.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
        command.current_dir(self.0.path()).args(arguments);
        command.stdin(Stdio::null());
        command
    }

    pub fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().expect("the command runs")
    }
}

fn machine(name: &str) -> String {
    let path = root().join(format!("machines/{name}.machine"));
    let path = path.canonicalize().expect("a machine");
    path.to_str().expect("text").to_owned()
}

#[test]
fn no_output_is_what_is_read_or_another_output() {
    let folder = Folder::new();
    folder.file("ball.machine", BALL);
    folder.file(
        "middle.machine",
        "machine Middle extends \"ball.machine\" { parameters { m: kg = 2 } }",
    );
    folder.file(
        "top.machine",
        "machine Top extends \"middle.machine\" { parameters { g: m/s^2 = 1 } }",
    );
    assert_eq!(status(&folder.run(&["check", "top.machine"])), 0);
    // Links with known extensions that give the same file several names.
    let link = |name: &str, of: &str| fs::hard_link(folder.path(of), folder.path(name));
    link("spec.csv", "top.machine").expect("a link");
    link("base.csv", "ball.machine").expect("a link");
    link("base.html", "ball.machine").expect("a link");
    std::os::unix::fs::symlink("ball.machine", folder.path("base.svg")).expect("a link");
    folder.file("a.csv", "older");
    link("b.svg", "a.csv").expect("a link");
    fs::create_dir(folder.path("sub")).expect("a folder");
    let before = (
        folder.read("ball.machine"),
        folder.read("top.machine"),
        folder.names(),
    );

    let simulate = ["simulate", "top.machine", "--until", "0.01"];
    for outputs in [
        &["--out", "spec.csv"][..],
        &["--out", "base.csv"],
        &["--plot", "base.svg"],
        &["--report", "./sub/../base.html"],
        &["--out", "a.csv", "--plot", "b.svg"],
        &[
            "--out",
            "new.csv",
            "--plot",
            "new.svg",
            "--report",
            "base.html",
        ],
    ] {
        let output = folder.run(&[&simulate[..], outputs].concat());
        assert_eq!(status(&output), 2, "{outputs:?}: {}", err(&output));
    }
    for call in [
        &["derive", "top.machine", "--out", "top.machine"][..],
        &["derive", "top.machine", "--out", "middle.machine"],
        &[
            "brachistochrone",
            "ball.machine",
            "--to",
            "x=1,y=-1",
            "--out",
            "base.csv",
        ],
        &[
            "library",
            "ball.machine",
            "--out",
            "a.so",
            "--source",
            "link.rs",
        ],
    ] {
        let _ = fs::hard_link(folder.path("ball.machine"), folder.path("link.rs"));
        let output = folder.run(call);
        assert_eq!(status(&output), 2, "{call:?}: {}", err(&output));
        let _ = fs::remove_file(folder.path("link.rs"));
    }
    assert_eq!(folder.read("ball.machine"), before.0);
    assert_eq!(folder.read("top.machine"), before.1);
    assert_eq!(folder.read("a.csv"), "older");
    assert_eq!(folder.names(), before.2);
}

#[test]
fn what_cannot_be_written_is_refused_before_anything_runs() {
    let folder = Folder::new();
    folder.file("ball.machine", BALL);
    fs::create_dir(folder.path("folder.csv")).expect("a folder");
    for (option, path, words) in [
        ("--out", "a.json", "`.csv`"),
        ("--out", "a.csv.gz", "`.gz`"),
        ("--out", "a", "no ending"),
        ("--plot", "a.png", "`.svg`"),
        ("--report", "a.txt", "`.html`"),
        ("--out", "missing/a.csv", "no folder"),
        ("--out", "folder.csv", "folder"),
    ] {
        // A run so long that the test would notice if it started.
        let output = folder.run(&["simulate", "ball.machine", "--until", "1e9", option, path]);
        assert_eq!(status(&output), 2, "{path}: {}", err(&output));
        assert!(err(&output).contains(words), "{path}: {}", err(&output));
    }
    let wrong = [
        &["derive", "ball.machine", "--as", "html", "--out", "a.tex"][..],
        &["library", "ball.machine", "--out", "a.h"],
        &[
            "library",
            "ball.machine",
            "--out",
            "a.so",
            "--source",
            "a.c",
        ],
        &[
            "brachistochrone",
            "ball.machine",
            "--to",
            "x=1,y=-1",
            "--plot",
            "a.pdf",
        ],
    ];
    for call in wrong {
        assert_eq!(status(&folder.run(call)), 2, "{call:?}");
    }
    assert_eq!(folder.names(), ["ball.machine", "folder.csv"]);
    // The case of an extension is ignored.
    let output = folder.run(&[
        "simulate",
        "ball.machine",
        "--until",
        "0.01",
        "--out",
        "A.CSV",
        "--plot",
        "A.Svg",
    ]);
    assert_eq!(status(&output), 0, "{}", err(&output));
    assert!(folder.read("A.CSV").starts_with("t [s],x [m],"));
    assert_eq!(
        folder.names(),
        ["A.CSV", "A.Svg", "ball.machine", "folder.csv"]
    );
}

#[test]
fn a_run_whose_files_cannot_be_written_is_summarized() {
    let machine = machine("double_pendulum");
    let simulate = ["simulate", &machine, "--until", "0.1"];
    for option in ["--out", "--plot", "--report"] {
        let output = lagrangian(&[&simulate[..], &[option, "/dev/full"]].concat());
        assert_eq!(status(&output), 1, "{option}: {}", err(&output));
        assert!(out(&output).contains("at the end"), "{}", out(&output));
        assert!(
            err(&output).contains("cannot write /dev/full"),
            "{}",
            err(&output)
        );
    }
    // The other files are written anyway, and the document reports the failure.
    let folder = Folder::new();
    let files = ["--out", "/dev/full", "--plot", "a.svg", "--json"];
    let output = folder.run(&[&simulate[..], &files].concat());
    assert_eq!(status(&output), 1);
    let document = json(&output);
    assert!(
        document["error"]
            .as_str()
            .is_some_and(|e| e.contains("/dev/full")),
        "{document}"
    );
    assert_eq!(document["t"], 0.1);
    assert_eq!(folder.names(), ["a.svg"]);
}

#[test]
fn standard_output_that_cannot_be_written_is_an_error() {
    let spec = machine("double_pendulum");
    for call in [
        &["check", &spec][..],
        &["derive", &spec],
        &["evaluate", &spec],
        &["simulate", &spec, "--until", "0.1"],
        &["simulate", &spec, "--until", "0.1", "--json"],
        &["simulate", &spec, "--until", "0.1", "--out", "/dev/stdout"],
        &["modes", &spec, "--start", "theta1=0.1"],
        &["--help"],
        &["--version"],
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
        let full = fs::OpenOptions::new().write(true).open("/dev/full");
        command.args(call).stdin(Stdio::null());
        command.stdout(full.expect("a full device"));
        let output = command.output().expect("the command runs");
        assert_eq!(status(&output), 1, "{call:?}: {}", err(&output));
        let said = err(&output);
        assert!(
            said.contains("cannot write to standard output"),
            "{call:?}: {said}"
        );
        assert_eq!(said.matches("error: ").count(), 1, "{call:?}: {said}");
    }
    // Errors that cannot be written are no reason to crash.
    let full = fs::OpenOptions::new().write(true).open("/dev/full");
    let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
    command
        .args(["check", "no-such.machine"])
        .stdin(Stdio::null());
    let output = command.stderr(full.expect("a full device")).output();
    assert_eq!(status(&output.expect("the command runs")), 2);
}

/// As in a shell: the status is 128 plus the number of SIGPIPE, without a message.
#[test]
fn a_closed_pipe_ends_quietly() {
    let spec = machine("cart_pole");
    for call in [
        &["derive", &spec][..],
        &["simulate", &spec, "--until", "0.1", "--out", "/dev/stdout"],
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
        let pipes = command.args(call).stdin(Stdio::null());
        let mut child = pipes
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the command runs");
        drop(child.stdout.take()); // nobody reads
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(status(&output), 141, "{call:?}");
        assert_eq!(err(&output).matches("error").count(), 0, "{}", err(&output));
    }
}

#[test]
fn a_table_on_standard_output_stands_there_alone() {
    let spec = machine("double_pendulum");
    let call = [
        "simulate",
        &spec,
        "--until",
        "0.1",
        "--every",
        "0.05",
        "--out",
        "/dev/stdout",
    ];
    let output = lagrangian(&call);
    assert_eq!(status(&output), 0, "{}", err(&output));
    assert_eq!(out(&output).lines().count(), 4);
    assert!(err(&output).contains("at the end"), "{}", err(&output));
    let output = lagrangian(&[&call[..], &["--json"]].concat());
    assert_eq!(status(&output), 2);
}

/// Whether a table of the ball with this number of rows is complete.
fn is_whole(table: &str, rows: usize) -> bool {
    let columns = |line: &str| line.split(',').count();
    let head = table.lines().next().map(columns);
    table.ends_with('\n')
        && table.lines().count() == rows + 1
        && table.lines().all(|line| Some(columns(line)) == head)
}

/// Waits until a condition holds; the test fails if that takes too long.
fn wait_until(what: &str, holds: impl Fn() -> bool) {
    let began = Instant::now();
    while !holds() {
        assert!(began.elapsed() < Duration::from_secs(120), "{what}");
        sleep(Duration::from_millis(2));
    }
}

/// A run that is killed while it writes leaves the older file of that name unchanged.
#[test]
fn what_is_killed_leaves_the_older_file() {
    let folder = Folder::new();
    folder.file("ball.machine", BALL);
    let rows = 100_000;
    let table = [
        "simulate",
        "ball.machine",
        "--until",
        "1",
        "--every",
        "1e-5",
        "--out",
        "a.csv",
    ];
    let is_partial = |name: &String| name.ends_with(".partial");
    let mut killed = 0;
    // Most of the time after the first kilobyte is spent writing; on a slow machine the signal may once
    // come too late.
    for _ in 0..3 {
        folder.file("a.csv", "older\n");
        let mut child = folder
            .command(&table)
            .stdout(Stdio::null())
            .spawn()
            .expect("it runs");
        let written = || {
            let parts = folder.names().into_iter().filter(is_partial);
            let sizes = parts.map(|name| fs::metadata(folder.path(&name)).map_or(0, |m| m.len()));
            sizes.sum::<u64>()
        };
        wait_until("nothing is written", || {
            written() > 100_000 || folder.read("a.csv") != "older\n"
        });
        child.kill().expect("a process"); // SIGKILL
        let status = child.wait().expect("a process");
        let now = folder.read("a.csv");
        if status.success() {
            // The run ended before the signal.
            assert!(is_whole(&now, rows + 1), "{}", now.len())
        } else {
            assert!(
                now == "older\n" || is_whole(&now, rows + 1),
                "{}",
                now.len()
            );
            killed += usize::from(now == "older\n");
        }
        for name in folder.names().iter().filter(|name| is_partial(name)) {
            fs::remove_file(folder.path(name)).expect("a file");
        }
    }
    assert!(killed > 0, "it was never killed while it wrote");
}

fn interrupt(child: &Child) {
    let sent = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(sent.expect("kill").success());
}

/// A very long run with many steps, after it has started.
fn on_its_way(folder: &Folder, more: &[&str]) -> Child {
    let spec = machine("double_pendulum");
    let call = ["simulate", &spec, "--until", "1e7", "--every", "1e4"];
    let mut command = folder.command(&[&call[..], more].concat());
    let pipes = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = pipes.spawn().expect("the command runs");
    wait_until("it does not begin", || catches_interrupts(&child));
    sleep(Duration::from_millis(300));
    child
}

/// Whether a process handles SIGINT, bit 1 of the signals that it catches.
fn catches_interrupts(child: &Child) -> bool {
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    let caught = caught.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    caught.is_some_and(|mask| mask & 0b10 != 0)
}

fn wait(mut child: Child) -> Output {
    wait_until("it does not end", || {
        let stat = fs::read_to_string(format!("/proc/{}/stat", child.id())).unwrap_or_default();
        // A zombie: a process that has ended and was not waited for.
        stat.rsplit(')')
            .next()
            .is_some_and(|rest| rest.trim_start().starts_with('Z'))
    });
    let mut output = Output {
        status: child.wait().expect("it ended"),
        stdout: Vec::new(),
        stderr: Vec::new(),
    };
    let (stdout, stderr) = (child.stdout.take(), child.stderr.take());
    stdout
        .expect("a pipe")
        .read_to_end(&mut output.stdout)
        .expect("text");
    stderr
        .expect("a pipe")
        .read_to_end(&mut output.stderr)
        .expect("text");
    output
}

#[test]
fn an_interrupted_run_is_written_as_far_as_it_came() {
    if !Path::new("/proc/self/status").exists() {
        return; // only Linux shows the signals that a process catches
    }
    let folder = Folder::new();
    let files = ["--out", "a.csv", "--plot", "a.svg", "--report", "a.html"];
    let child = on_its_way(&folder, &[&files[..], &["--json"]].concat());
    interrupt(&child);
    let output = wait(child);
    assert_eq!(status(&output), 130, "{}", err(&output));
    let document = json(&output);
    assert_eq!(document["interrupted"], true);
    let t = document["t"].as_f64().expect("a time");
    assert!(t > 0.0 && t < 1e7, "{t}");
    let warnings = document["warnings"].to_string();
    assert!(warnings.contains("interrupted"), "{warnings}");
    assert_eq!(folder.names(), ["a.csv", "a.html", "a.svg"]);
    // The table ends at the time of the summary, to the last digit.
    let table = folder.read("a.csv");
    assert!(table.ends_with('\n'));
    let last = table.lines().last().and_then(|line| line.split(',').next());
    assert_eq!(last.map(str::parse), Some(Ok(t)));

    let child = on_its_way(&folder, &[]);
    interrupt(&child);
    let output = wait(child);
    assert_eq!(status(&output), 130, "{}", err(&output));
    assert!(
        out(&output).contains("interrupted at t = "),
        "{}",
        out(&output)
    );
}

/// Ctrl-C during the estimate of the error ends the estimate; the run is written as a whole.
#[test]
fn an_interrupted_estimate_leaves_the_run() {
    if !Path::new("/proc/self/status").exists() {
        return;
    }
    let folder = Folder::new();
    // It soon rests, and then an implicit method takes few steps; a run in double-double would take hours.
    folder.file(
        "damped.machine",
        "machine Damped in plane {
            parameters { l: m = 0.5, c: N*m*s = 0.01, g: m/s^2 = 9.81 }
            coordinates { theta: rad = 0.9 }
            bodies { bob { mass: 1, at: l*(sin(theta), -cos(theta)) } }
            gravity (0, -g);
            dissipations { hinge: c*der(theta)^2/2 }
        }",
    );
    let call = [
        "simulate",
        "damped.machine",
        "--until",
        "1e7",
        "--every",
        "1e4",
        "--global-error",
        "--out",
        "a.csv",
    ];
    let mut command = folder.command(&call);
    let pipes = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = pipes.spawn().expect("the command runs");
    // Progress is told after two seconds.
    let mut stderr = child.stderr.take().expect("a pipe");
    let mut told = Vec::new();
    while !String::from_utf8_lossy(&told).contains("estimating the error") {
        let mut byte = [0];
        assert_eq!(stderr.read(&mut byte).expect("text"), 1, "it has ended");
        told.push(byte[0]);
    }
    interrupt(&child);
    child.stderr = Some(stderr);
    let output = wait(child);
    assert_eq!(status(&output), 130, "{}", err(&output));
    assert!(
        err(&output).contains("the estimate was interrupted"),
        "{}",
        err(&output)
    );
    assert!(out(&output).contains("at the end"), "{}", out(&output));
    assert!(!out(&output).contains("interrupted"), "{}", out(&output));
    let table = folder.read("a.csv");
    let last = table.lines().last().and_then(|line| line.split(',').next());
    assert_eq!(last, Some("10000000.0"));
}

/// Two interruptions: the second ends the command before the step is done, or after everything is written, always
/// with the same status.
#[test]
fn a_second_interruption_quits() {
    if !Path::new("/proc/self/status").exists() {
        return;
    }
    let folder = Folder::new();
    // Nobody reads the pipe, which is full after 64 kB, so the command blocks while writing, and only the second
    // interruption ends it.
    let spec = folder.file("pipe.machine", BALL);
    let made = Command::new("mkfifo").arg(folder.path("a.csv")).status();
    assert!(made.expect("mkfifo").success());
    let pipe = fs::OpenOptions::new()
        .read(true)
        .write(true)
        .open(folder.path("a.csv"));
    let _held = pipe.expect("a pipe with somebody at its other end");
    let spec = spec.to_str().expect("text");
    let call = [
        "simulate", spec, "--until", "1", "--every", "1e-4", "--out", "a.csv",
    ];
    let mut command = folder.command(&call);
    let pipes = command.stdout(Stdio::piped()).stderr(Stdio::piped());
    let child = pipes.spawn().expect("the command runs");
    wait_until("it does not begin", || catches_interrupts(&child));
    sleep(Duration::from_millis(1500));
    interrupt(&child);
    sleep(Duration::from_millis(300));
    interrupt(&child);
    assert_eq!(status(&wait(child)), 130);
}
