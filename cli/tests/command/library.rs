//! `lagrangian library`: a C program gets from the library what `lagrangian evaluate` prints, both for one state and in lanes.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::{Value, json};

/// Reads parameters and inputs, then a state, the index of an angle among its coordinates, and the index of a coordinate that makes the
/// mass matrix singular at 0, if there is one. It prints the accelerations of the state alone, and of the state as one of four and of
/// eight lanes whose neighbours are NaN. Then it compares every lane of different states with the same state alone: with all states
/// regular, with one singular, far away, or NaN, and before parameters are set.
const PROGRAM: &str = r#"
#include "libmachine.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void several(int lanes, int lane, const double *y, double t, const double *p) {
    double all[2 * COORDINATES * 8], times[8], a[COORDINATES * 8];
    for (int i = 0; i < 2 * COORDINATES * 8; ++i) all[i] = NAN;
    for (int i = 0; i < 8; ++i) times[i] = 1e300;
    for (int i = 0; i < 2 * COORDINATES; ++i) all[lanes * i + lane] = y[i];
    times[lane] = t;
    (lanes == 4 ? eval4 : eval8)(all, times, p, a);
    for (int i = 0; i < COORDINATES; ++i) printf("%.17g\n", a[lanes * i + lane]);
}

enum Case { WELL, SINGULAR, FAR, UNDEFINED, CASES };

/* The same bits, or both undefined. */
static int same(double a, double b) { return isnan(a) ? isnan(b) : !memcmp(&a, &b, sizeof a); }

static void each_as_alone(int lanes, int odd, enum Case what, int place, const double *y, double t, const double *p) {
    double all[2 * COORDINATES * 8], times[8], a[COORDINATES * 8], states[8][2 * COORDINATES], alone[COORDINATES];
    for (int lane = 0; lane < lanes; ++lane) {
        times[lane] = t + 0.1 * lane;
        for (int i = 0; i < 2 * COORDINATES; ++i) states[lane][i] = y[i] * (1 + 0.01 * lane);
        if (lane == odd && what != WELL) states[lane][place] = what == SINGULAR ? 0 : what == FAR ? -1e300 : NAN;
        for (int i = 0; i < 2 * COORDINATES; ++i) all[lanes * i + lane] = states[lane][i];
    }
    (lanes == 4 ? eval4 : eval8)(all, times, p, a);
    for (int lane = 0; lane < lanes; ++lane) {
        const int is_odd = lane == odd && what != WELL;
        eval(states[lane], times[lane], p, alone);
        for (int i = 0; i < COORDINATES; ++i) {
            const double got = a[lanes * i + lane];
            const int must_be = !is_odd || what == FAR ? isfinite(got) : what == UNDEFINED || isnan(got);
            if (same(got, alone[i]) && must_be) continue;
            fprintf(stderr, "case %d in lane %d of %d: lane %d, component %d is %.17g, alone %.17g\n", what, odd, lanes,
                    lane, i, got, alone[i]);
            exit(6);
        }
    }
}

int main(void) {
    double p[PARAMETERS + INPUTS + 1], y[2 * COORDINATES], t, a[COORDINATES], all[8 * COORDINATES];
    int places[CASES] = {0};
    if (coordinates() != COORDINATES || parameters() != PARAMETERS || inputs() != INPUTS) return 2;
    if (parameter_name(PARAMETERS) || parameter_name(-1) || !isnan(input_default(INPUTS))) return 3;
    for (int i = 0; i < PARAMETERS + INPUTS; ++i)
        if (scanf("%lf", &p[i]) != 1) return 4;
    for (int i = 0; i < 2 * COORDINATES; ++i)
        if (scanf("%lf", &y[i]) != 1) return 4;
    if (scanf("%lf", &t) != 1) return 4;
    if (scanf("%d %d", &places[FAR], &places[SINGULAR]) != 2) return 4;
    places[UNDEFINED] = places[FAR];
    eval(y, t, p, a);
    for (int i = 0; i < COORDINATES; ++i)
        if (!isnan(a[i])) return 5; /* nothing is set up */
    double none[2 * COORDINATES * 8] = {0};
    eval8(none, none, p, all);
    for (int i = 0; i < COORDINATES * 8; ++i)
        if (!isnan(all[i])) return 5;
    eval_setup(p);
    eval(y, t, p, a);
    for (int i = 0; i < COORDINATES; ++i) printf("%.17g\n", a[i]);
    several(4, 2, y, t, p);
    several(8, 5, y, t, p);
    for (int what = WELL; what < CASES; ++what)
        for (int lanes = 4; lanes <= 8 && places[what] >= 0; lanes *= 2)
            for (int odd = 0; odd < lanes; ++odd) each_as_alone(lanes, odd, what, places[what], y, t, p);
    return 0;
}
"#;

/// A folder that is removed when the test ends.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("lagrangian-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a temporary folder");
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0); // a remaining folder does no harm
    }
}

fn machine(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../machines/{name}.machine"))
}

fn lagrangian(arguments: &[&str], folder: &Folder) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
    command.args(arguments).current_dir(&folder.0);
    command
}

/// The output of a command with a text as its input.
fn answer(mut command: Command, text: &str) -> String {
    let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = pipes.spawn().expect("the command runs");
    let mut input = child.stdin.take().expect("a pipe");
    input.write_all(text.as_bytes()).expect("a reader");
    drop(input);
    let output = child.wait_with_output().expect("the command ends");
    assert!(output.status.success(), "{command:?}: {}", output.status);
    String::from_utf8(output.stdout).expect("text")
}

/// Calls the library of a machine with parameters slightly off their defaults, and compares it with the interpreter.
///
/// `angle` is the index of a coordinate whose sine is computed, `distance` that of one whose zero makes the mass matrix singular.
fn check(name: &str, constants: &[&str], angle: usize, distance: Option<usize>) {
    let folder = Folder::new(name);
    let near_one = |k: usize| 1.0 + number(k);
    let places = [Some(angle), distance];
    // Code with loops has the same operations in the same arithmetic.
    let is_exact = !constants.is_empty();
    check_of(
        &folder,
        &machine(name),
        constants,
        places,
        &near_one,
        is_exact,
    );
}

/// A pseudo-random number in [0, 1).
fn number(k: usize) -> f64 {
    ((k * 37 + 11) % 101) as f64 / 101.0
}

/// Checks the library of any spec; parameters and inputs are identified by their index.
fn check_of(
    folder: &Folder,
    spec: &Path,
    constants: &[&str],
    [angle, distance]: [Option<usize>; 2],
    parameter: &dyn Fn(usize) -> f64,
    is_exact: bool,
) {
    let name = spec.display();
    let spec = spec.to_str().expect("a path in UTF-8");
    let arguments = [
        "library",
        spec,
        "--out",
        "libmachine.so",
        "--lanes",
        "4,8",
        "--json",
    ];
    let arguments = [&arguments, constants].concat();
    let made: Value =
        serde_json::from_str(&answer(lagrangian(&arguments, folder), "")).expect("JSON");
    let names = |list: &str| -> Vec<String> {
        let names = made[list].as_array().expect("a list").iter();
        names
            .map(|name| name.as_str().expect("a name").to_owned())
            .collect()
    };
    let (coordinates, parameters, inputs) =
        (names("coordinates"), names("parameters"), names("inputs"));
    fs::write(folder.0.join("program.c"), PROGRAM).expect("a temporary file");
    let mut cc = Command::new("cc");
    cc.args([
        "program.c",
        "-o",
        "program",
        "-L.",
        "-lmachine",
        "-Wl,-rpath,.",
        "-lm",
    ]);
    answer(
        {
            cc.current_dir(&folder.0);
            cc
        },
        "",
    );

    let p: Vec<f64> = (0..parameters.len() + inputs.len())
        .map(parameter)
        .collect();
    let y: Vec<f64> = (0..2 * coordinates.len())
        .map(|k| 0.5 + number(k + 50))
        .collect();
    let t = 0.75;
    let (named, set) = p.split_at(parameters.len());
    let map = |names: &[String], values: &[f64]| -> Value {
        names
            .iter()
            .cloned()
            .zip(values.iter().map(|x| json!(x)))
            .collect::<serde_json::Map<_, _>>()
            .into()
    };
    let (q, v) = y.split_at(coordinates.len());
    let point = json!([{"t": t, "q": q, "v": v, "parameters": map(&parameters, named), "inputs": map(&inputs, set)}]);
    let expected = answer(
        lagrangian(
            &[&["evaluate", spec, "--at", "-"], constants].concat(),
            folder,
        ),
        &point.to_string(),
    );
    let expected: Value = serde_json::from_str(&expected).expect("JSON");
    let expected: Vec<f64> = expected[0]["accelerations"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|a| a.as_f64().expect("a number"))
        .collect();

    let given: Vec<String> = p
        .iter()
        .chain(&y)
        .chain([&t])
        .map(|x| format!("{x:e}"))
        .chain([angle, distance].map(|place| place.map_or("-1".to_owned(), |x| x.to_string())))
        .collect();
    let program = Command::new(folder.0.join("program"));
    let printed = answer(
        {
            let mut program = program;
            program.current_dir(&folder.0);
            program
        },
        &given.join(" "),
    );
    let printed: Vec<f64> = printed
        .lines()
        .map(|line| line.parse().expect("a number"))
        .collect();
    let n = coordinates.len();
    assert_eq!(printed.len(), 3 * n);
    let greatest = expected.iter().fold(0.0, |most, a: &f64| a.abs().max(most));
    for (i, (ours, expected)) in printed[..n].iter().zip(&expected).enumerate() {
        // Both are stable; they differ by the rounding of at most 2000 operations, amplified by the condition number of these mass
        // matrices, which is below 1e3.
        let limit = if is_exact {
            0.0
        } else {
            2000.0 * 1e3 * f64::EPSILON * greatest
        };
        assert!(
            (ours - expected).abs() <= limit,
            "{name} {i}: {ours} for {expected}"
        );
    }
    assert_eq!(printed[n..2 * n], printed[..n], "{name}: one of four");
    assert_eq!(printed[2 * n..], printed[..n], "{name}: one of eight");
}

#[test]
fn a_driven_machine_is_what_the_interpreter_says() {
    check("crusher9", &[], 4, Some(3));
}

/// The chain is so long that its repeated links are compiled to loops.
#[test]
fn a_chain_of_128_links_has_the_bits_of_the_straight_program() {
    check("chain", &["--const", "N=128"], 0, None);
}

/// Left and right limbs are evaluated in pairs.
#[test]
fn a_humanoid_whose_limbs_are_in_pairs_has_the_bits_of_the_program() {
    use lagrangian::interpreted::InterpretedMachine;
    let folder = Folder::new("humanoid");
    let file = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/command/import/real/simple_humanoid.urdf");
    let file = file.to_str().expect("a path in UTF-8");
    let import = ["import", file, "--base", "floating", "--ball", "zyx"];
    let rest = [
        "--friction",
        "none",
        "--drop-massless",
        "--ignore",
        "collision_checking",
    ];
    let out = ["--out", "humanoid.machine"];
    answer(
        lagrangian(&[&import[..], &rest, &out].concat(), &folder),
        "",
    );
    let spec = folder.0.join("humanoid.machine");
    let source = [
        "library",
        "humanoid.machine",
        "--out",
        "a.so",
        "--source",
        "a.rs",
    ];
    answer(lagrangian(&source, &folder), "");
    let source = fs::read_to_string(folder.0.join("a.rs")).expect("the source");
    let pairs = source.matches("_each([").count();
    assert!(pairs > 1000, "{pairs} pairs");

    let machine = InterpretedMachine::from_file(&spec).expect("a good spec");
    let parameters = &machine.program().parameters;
    let default = |k: usize| parameters[k].default.as_ref().expect("a value").value;
    check_of(&folder, &spec, &[], [Some(6), None], &default, true);
}

#[test]
fn motors_of_an_arm_are_read_behind_its_parameters() {
    check("six_joint_arm", &[], 1, None);
}

#[test]
fn machines_that_constraints_close_accelerate_as_these_allow() {
    check("closed_pendulum", &[], 1, None);
    check("rolling_coin", &[], 1, None);
}

/// Reads a state and a time, and prints everything that a library computes about contacts. Before that it checks that pointers may be
/// null, and that no results are available before parameters are set.
const OF_CONTACTS: &str = r#"
#include "libmachine.h"
#include <math.h>
#include <stdio.h>

int main(void) {
    enum { N = COORDINATES, C = CONTACTS, K = CONSTRAINTS };
    double y[2 * N], t, numbers[N + C + 2 * C + 2 * C * N + 2 * C + 4 * C + N * N + K * N + 1];
    double *gaps = numbers + N, *rates = gaps + C, *rows = rates + 2 * C, *bias = rows + 2 * C * N, *coefficients = bias + 2 * C;
    double *mass = coefficients + 4 * C, *constraints = mass + N * N, *end = constraints + K * N;
    if (contacts() != C || contact_name(C) || contact_law(-1) || contact_leans(C) != -1) return 2;
    for (int i = 0; i < 2 * N; ++i)
        if (scanf("%lf", &y[i]) != 1) return 3;
    if (scanf("%lf", &t) != 1) return 3;
    eval_contacts(y, t, gaps, NULL, NULL, NULL, NULL);
    eval_inertia(y, t, mass, NULL);
    if (!isnan(gaps[0]) || !isnan(mass[0])) return 4;
    eval_setup(NULL);
    *end = 123;
    eval(y, t, NULL, numbers);
    eval_contacts(y, t, gaps, rates, rows, bias, coefficients);
    eval_contacts(y, t, NULL, NULL, NULL, NULL, NULL);
    eval_inertia(y, t, mass, constraints);
    if (*end != 123) return 5;
    for (double *number = numbers; number < end; ++number) printf("%.17g\n", *number);
    for (int i = 0; i < C; ++i) printf("%s %s %d\n", contact_name(i), contact_law(i), contact_leans(i));
    return 0;
}
"#;

/// Compares the contact functions of a library with the machine.
#[track_caller]
fn check_contacts(name: &str, spec: &Path, names: &[&str]) {
    use lagrangian::interpreted::InterpretedMachine;
    use lagrangian::{Machine, System};
    let folder = Folder::new(name);
    let path = spec.to_str().expect("a path in UTF-8");
    let mut making = lagrangian(&["library", path, "--out", "libmachine.so"], &folder);
    let output = making.output().expect("the command runs");
    let said = String::from_utf8(output.stderr).expect("text");
    assert!(output.status.success(), "{said}");
    assert!(
        said.contains("`eval` gives the accelerations with all of them open"),
        "{said}"
    );
    fs::write(folder.0.join("program.c"), OF_CONTACTS).expect("a temporary file");
    let mut cc = Command::new("cc");
    cc.args([
        "program.c",
        "-o",
        "program",
        "-L.",
        "-lmachine",
        "-Wl,-rpath,.",
        "-lm",
    ]);
    cc.current_dir(&folder.0);
    answer(cc, "");

    let machine = InterpretedMachine::from_file(spec).expect("a good spec");
    let system = machine.prepare();
    let (n, c, k) = (
        machine.program().coordinates.len(),
        system.unilateral_contacts().len(),
        system.constraints().len(),
    );
    let number = |k: usize| ((k * 37 + 11) % 101) as f64 / 101.0; // pseudo-random, in [0, 1)
    let y: Vec<f64> = (0..2 * n).map(|k| 0.2 + number(k)).collect();
    let (q, v) = (y[..n].to_vec(), y[n..].to_vec());
    let t = 0.75;
    let mut expected: Vec<f64> = Vec::new();
    let mut tell = |count: usize, put: &dyn Fn(&mut Vec<f64>)| {
        let mut numbers = vec![0.0; count];
        put(&mut numbers);
        expected.extend(numbers);
    };
    let inputs = system.default_inputs();
    tell(n, &|to| {
        system
            .accelerations(t, &q, &v, &inputs, to)
            .expect("it accelerates")
    });
    tell(c, &|to| system.gaps(t, &q, to));
    tell(2 * c, &|to| system.contact_rates(t, &q, &v, to));
    tell(2 * c * n, &|to| system.contact_matrix(t, &q, to));
    tell(2 * c, &|to| system.contact_bias(t, &q, &v, to));
    tell(4 * c, &|to| system.contact_coefficients(t, &q, &v, to));
    tell(n * n, &|to| system.mass_matrix(t, &q, to));
    tell(k * n, &|to| system.constraint_matrix(t, &q, to));

    let mut program = Command::new(folder.0.join("program"));
    program.current_dir(&folder.0);
    let given: Vec<String> = y.iter().chain([&t]).map(|x| format!("{x:e}")).collect();
    let printed = answer(program, &given.join(" "));
    let lines: Vec<&str> = printed.lines().collect();
    let (numbers, contacts) = lines.split_at(expected.len());
    assert_eq!(contacts, names, "{name}");
    for (i, (line, expected)) in numbers.iter().zip(&expected).enumerate() {
        let found: f64 = line.parse().expect("a number");
        // About a hundred operations on numbers of this size, and accelerations from a matrix with a condition number below 1e3.
        let limit = 100.0 * 1e3 * f64::EPSILON * (1.0 + expected.abs());
        assert!(
            (found - expected).abs() <= limit,
            "{name} {i}: {found} for {expected}"
        );
    }
}

#[test]
fn contacts_of_a_library_are_those_of_the_machine() {
    let of = |name: &str| machine(&format!("contacts/{name}"));
    let outer = ["outer newton 0", "inner newton 0"];
    check_contacts("colliding", &of("colliding_crusher"), &outer);
    check_contacts(
        "cue",
        &of("cue_ball"),
        &["cloth newton 0", "cloth.across newton 2"],
    );
    let out = ["floor newton 0", "floor.rolling newton 1"];
    check_contacts("rolling", &of("rolling_out"), &out);
    let clearance = of("slider_crank_clearance");
    let clearances = ["upper_left", "upper_right", "lower_left", "lower_right"];
    let clearances = clearances.map(|name| format!("{name} newton 0"));
    let clearances = clearances.each_ref().map(String::as_str);
    check_contacts("clearance", &clearance, &clearances);
    // A compliant contact, a frictionless one, and one beside a constraint.
    let text = "machine Yields in plane {
        parameters { k: N/m = 200, d: N*s/m = 3, w: rad/s = 3, L: m = 1 }
        coordinates { x: m = 1, y: m = 1 }
        bodies { ball { mass: 2, at: (x, y) } }
        constraints { on: x^2 + y^2 = 2*L^2 }
        contacts { bed { gap: y - 0.1*sin(w*t)*x, compliance: linear(k, d) } }
    }";
    let folder = Folder::new("yielding-spec");
    let spec = folder.0.join("yields.machine");
    fs::write(&spec, text).expect("a temporary file");
    check_contacts("yields", &spec, &["bed linear 0"]);
}

#[test]
fn who_has_no_rustc_is_told() {
    let folder = Folder::new("no-rustc");
    let spec = machine("simple_pendulum");
    let spec = spec.to_str().expect("a path in UTF-8");
    let mut command = lagrangian(&["library", spec, "--out", "libmachine.so"], &folder);
    let output = command
        .env("RUSTC", "./no-such-rustc")
        .output()
        .expect("the command runs");
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8(output.stderr).expect("text");
    assert!(said.contains("cannot run ./no-such-rustc"), "{said}");
}
