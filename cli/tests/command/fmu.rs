//! `lagrangian fmu`: importers in C, and FMPy where it is installed, get from a unit what `evaluate` and `simulate` print.

use std::collections::BTreeMap;
use std::fs;
use std::io::{Read as _, Write as _};
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use super::support::{Scratch, lagrangian, root};

/// The files in a unit.
pub(super) fn files(unit: &Path) -> BTreeMap<String, Vec<u8>> {
    let file = fs::File::open(unit).expect("a unit");
    let mut archive = zip::ZipArchive::new(file).expect("an archive");
    let mut files = BTreeMap::new();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).expect("a file");
        let mut content = Vec::new();
        file.read_to_end(&mut content).expect("its bytes");
        let name = file.name().expect("a name").into_owned();
        files.insert(name, content);
    }
    files
}

pub(super) fn text(files: &BTreeMap<String, Vec<u8>>, name: &str) -> String {
    String::from_utf8(files[name].clone()).expect("text")
}

/// Makes a unit; returns the JSON that the command prints.
pub(super) fn unit(spec: &str, at: &Scratch, options: &[&str]) -> Value {
    let arguments = [&["fmu", spec, "--out", at.path(), "--json"], options].concat();
    let output = lagrangian(&arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{spec}: {said}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

/// The value of an attribute on the line of the variable with this reference.
pub(super) fn attribute(description: &str, reference: usize, name: &str) -> Option<String> {
    let mark = format!("valueReference=\"{reference}\"");
    let mut lines = description.lines();
    let line = lines.find(|line| line.contains(&mark))?;
    let (_, rest) = line.split_once(&format!(" {name}=\""))?;
    Some(rest.split('"').next()?.to_owned())
}

pub(super) fn run(command: &mut Command, input: &str) -> String {
    let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = pipes.stderr(Stdio::piped()).spawn().expect("it runs");
    let mut pipe = child.stdin.take().expect("a pipe");
    pipe.write_all(input.as_bytes()).expect("a reader");
    drop(pipe);
    let output = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{command:?}: {} {said}",
        output.status
    );
    String::from_utf8(output.stdout).expect("text")
}

/// What an importer does with a machine: values off the defaults, a state, and the end of a run from it.
struct Case<'a> {
    machine: &'a str,
    constants: &'a [&'a str],
    until: f64,
    method: &'a str,
    /// The parameters and starts that FMPy sets.
    set: &'a [(&'a str, f64)],
    start: &'a [(&'a str, f64)],
}

const CASES: &[Case<'_>] = &[
    Case {
        machine: "double_pendulum",
        constants: &[],
        until: 1.0,
        method: "dop853",
        set: &[("l2", 0.8), ("m1", 1.5)],
        start: &[("theta2", -0.7)],
    },
    // Driven at 100 rad/s, with facts.
    Case {
        machine: "crusher9",
        constants: &[],
        until: 0.2,
        method: "dop853",
        set: &[("w", 90.0), ("e", 0.035)],
        start: &[],
    },
    Case {
        machine: "heavy_top",
        constants: &[],
        until: 1.0,
        method: "dop853",
        set: &[("C", 0.5)],
        start: &[],
    },
    Case {
        machine: "chain",
        constants: &["--const", "N=4"],
        until: 1.0,
        method: "dopri5",
        set: &[("m", 0.6)],
        start: &[("q[2]", -0.1)],
    },
    // With an input and outputs, one of which depends on accelerations.
    Case {
        machine: "cart_pole",
        constants: &[],
        until: 1.0,
        method: "dop853",
        set: &[("l", 0.6)],
        start: &[],
    },
];

/// Machines with holonomic and with nonholonomic constraints.
const CONSTRAINED: &[Case<'_>] = &[
    Case {
        machine: "four_bar",
        constants: &[],
        until: 1.0,
        method: "dop853",
        set: &[("m2", 1.5)],
        start: &[],
    },
    Case {
        machine: "slider_crank",
        constants: &[],
        until: 0.5,
        method: "dop853",
        set: &[("m3", 1.5)],
        start: &[],
    },
    Case {
        machine: "chaplygin_sleigh",
        constants: &[],
        until: 1.0,
        method: "dop853",
        set: &[("J", 0.06)],
        start: &[],
    },
];

/// Further machines that FMPy runs: one with a first-order state, and one rotated by a quaternion.
const FURTHER: &[Case<'_>] = &[
    Case {
        machine: "dc_motor",
        constants: &[],
        until: 0.1,
        method: "dop853",
        set: &[("L", 3e-3), ("U", 10.0)],
        start: &[("phi", 0.5)],
    },
    Case {
        machine: "upright_top",
        constants: &[],
        until: 1.0,
        method: "dop853",
        set: &[("spin", 50.0)],
        start: &[],
    },
    Case {
        machine: "elastic_pendulum",
        constants: &[],
        until: 1.0,
        method: "dop853",
        set: &[("k", 50.0)],
        start: &[],
    },
];

/// Compares a unit with the command, by an importer in C.
fn check(case: &Case<'_>, version: &str, driver: &str, header: &str) {
    let spec = format!("machines/{}.machine", case.machine);
    let at = Scratch::new("Machine.fmu", "");
    let folder = at.0.parent().expect("a folder");
    let made = unit(
        &spec,
        &at,
        &[&["--fmi", version, "--method", case.method], case.constants].concat(),
    );
    let files = files(&at.0);
    let description = text(&files, "modelDescription.xml");
    for (name, content) in &files {
        let name = name.rsplit('/').next().expect("a name");
        fs::write(folder.join(name), content).expect("a file");
    }
    fs::write(folder.join("driver.c"), driver).expect("a file");
    fs::write(folder.join("many.h"), include_str!("fmu/many.h")).expect("a file");
    // Linking fails unless every function of the standard exists.
    let declared = text(&files, &format!("sources/{header}"));
    let declared = declared
        .lines()
        .filter(|line| line.contains("_Export fmi") && line.trim_end().ends_with(';'));
    let names = declared.filter_map(|line| line.trim_end_matches([';', ' ']).rsplit(' ').next());
    let names: Vec<&str> = names.collect();
    assert_eq!(names.len(), if version == "3" { 75 } else { 44 });
    let all: String = names
        .iter()
        .map(|name| format!("(void (*)(void)){name},"))
        .collect();
    let all = format!("#include \"{header}\"\nvoid (*const all[])(void) = {{{all}}};\n");
    fs::write(folder.join("all.c"), all).expect("a file");
    let token = made["token"].as_str().expect("a token");
    let mut cc = Command::new("cc");
    cc.current_dir(folder)
        .args(["-std=gnu11", "-Wall", "-Werror"]);
    cc.arg(format!("-DTOKEN=\"{token}\"")).arg("-DRATE=0.5");
    cc.args(["driver.c", "all.c", "./Machine.so", "-o", "driver", "-lm"]);
    run(cc.args(["-Wl,-rpath,.", "-pthread"]), "");

    let count = |name: &str| usize::try_from(made[name].as_u64().expect("a count")).expect("few");
    let n = count("states") / 2;
    let (parameters, inputs) = (count("parameters"), count("inputs"));
    let evaluated = |options: &[&str], input: &str| -> Value {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
        command.current_dir(root()).args(["evaluate", &spec]);
        command.args(options).args(case.constants);
        serde_json::from_str(&run(&mut command, input)).expect("JSON")
    };
    let outputs = evaluated(&[], "")[0]["outputs"]
        .as_object()
        .map_or(0, |outputs| outputs.len());
    // Every value a little off its default, without a pattern.
    let off = |k: usize| 1.0 + 0.1 * ((k * 37 + 11) % 101) as f64 / 101.0;
    let line_of = |reference: usize, name: &str| match version {
        "3" => attribute(&description, reference, name),
        // Start and unit are on the next line.
        _ => {
            let mark = format!("valueReference=\"{reference}\"");
            let mut lines = description.lines().skip_while(|line| !line.contains(&mark));
            let line = lines.nth(usize::from(name != "name"))?;
            let (_, rest) = line.split_once(&format!(" {name}=\""))?;
            Some(rest.split('"').next()?.to_owned())
        }
    };
    let start = |k: usize| -> f64 {
        let start = line_of(k, "start").expect("a start");
        start.parse().expect("a number")
    };
    let name = |k: usize| line_of(k, "name").expect("a name");
    let value = |k: usize| start(k) * off(k);
    let range = |from: usize, count: usize| from..from + count;
    let given = range(1 + 3 * n, parameters);
    let driven = range(1 + 3 * n + parameters, inputs);
    let p: Vec<f64> = given.clone().map(value).collect();
    let u: Vec<f64> = driven.clone().map(|k| 0.3 * off(k)).collect();
    let q: Vec<f64> = range(1, n).map(|k| value(k) + 0.01 * off(k)).collect();
    let v: Vec<f64> = range(1 + n, n).map(|k| value(k) + 0.1 * off(k)).collect();
    let t = 0.25;
    let map = |names: std::ops::Range<usize>, values: &[f64]| -> Value {
        let entries = names.map(name).zip(values.iter().map(|x| json!(x)));
        entries.collect::<serde_json::Map<_, _>>().into()
    };
    let point = json!([{
        "t": t, "q": q, "v": v,
        "parameters": map(given.clone(), &p), "inputs": map(driven.clone(), &u),
    }]);
    let at_point = &evaluated(&["--at", "-"], &point.to_string())[0];
    let numbers = |value: &Value| -> Vec<f64> {
        let values: Vec<&Value> = match value {
            Value::Array(values) => values.iter().collect(),
            Value::Object(values) => values.values().collect(),
            value => vec![value],
        };
        let values = values.into_iter();
        values.map(|x| x.as_f64().expect("a number")).collect()
    };
    let mut expected = numbers(&at_point["accelerations"]);
    expected.extend(numbers(&at_point["outputs"]));
    expected.extend(numbers(&at_point["kinetic_energy"]));
    expected.extend(numbers(&at_point["potential_energy"]));
    let evaluations = expected.len();

    // The run of the command starts at 0, so machines that depend on time are compared from there.
    let words = |values: &mut dyn Iterator<Item = f64>| -> String {
        values.map(|x| format!("{x:?} ")).collect()
    };
    let sizes = format!("{n} {parameters} {inputs} {outputs} ");
    let given_to = |t: f64| {
        let mut all = p.iter().chain(&u).chain(&q).chain(&v).copied();
        format!("{sizes}{} {t:?} {:?}\n", words(&mut all), t + case.until)
    };
    let driver = || {
        let mut command = Command::new("./driver");
        command.current_dir(folder);
        command
    };
    let read = |text: String| -> Vec<f64> {
        text.lines()
            .map(|line| line.parse().expect("a number"))
            .collect()
    };
    let found = read(run(&mut driver(), &given_to(t)));
    for (k, (x, known)) in found.iter().zip(&expected).enumerate() {
        // Compiled C rounds each operation, while the interpreter fuses some: 1e-12 of the largest is thousands of roundings.
        let largest = expected.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        let bound = 1e-12 * largest;
        assert!(
            (x - known).abs() <= bound,
            "{} {k}: {x} {known}",
            case.machine
        );
    }
    let found = read(run(&mut driver(), &given_to(0.0)));
    // There are no uninitialized reads, no accesses out of bounds, and no leaks.
    if version == "2" {
        let mut valgrind = Command::new("valgrind");
        match valgrind.arg("--version").output() {
            Ok(output) if output.status.success() => {
                let mut valgrind = Command::new("valgrind");
                valgrind
                    .current_dir(folder)
                    .args(["-q", "--leak-check=full"]);
                valgrind.args(["--error-exitcode=99", "./driver"]);
                run(&mut valgrind, &given_to(0.0));
            }
            _ => println!("skipped: there is no valgrind"),
        }
    }
    let set = |option: &str, names: std::ops::Range<usize>, values: &[f64]| -> Vec<String> {
        let values = names.map(name).zip(values);
        let words = values.flat_map(|(name, x)| [option.to_owned(), format!("{name}={x:?}")]);
        words.collect()
    };
    let mut options = [
        set("--set", given, &p),
        set("--start", range(1, n), &q),
        set("--rate", range(1, n), &v),
    ]
    .concat();
    let until = format!("{:?}", case.until);
    options.extend(["--until", &until, "--tolerance", "1e-12", "--json"].map(str::to_owned));
    // Inputs are constant; in 2.0 there are also inputs that grow by 0.5 per second.
    let grow = driven.clone().zip(&u).flat_map(|(k, x)| {
        let unit = line_of(k, "unit").expect("a unit");
        let formula = format!("{}={x:?}*({unit})+0.5*({unit})/s*t", name(k));
        ["--input".to_owned(), formula]
    });
    let mut ways = vec![set("--set", driven.clone(), &u)];
    if version == "2" {
        ways.push(grow.collect());
    }
    assert_eq!(found.len(), evaluations + ways.len() * 2 * n);
    for (way, found) in ways.iter().zip(found[evaluations..].chunks(2 * n)) {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
        command.current_dir(root()).args(["simulate", &spec]);
        command.args(&options).args(way).args(case.constants);
        let end: Value = serde_json::from_str(&run(&mut command, "")).expect("JSON");
        let end = [numbers(&end["q"]), numbers(&end["v"])].concat();
        let largest = end.iter().fold(0.0f64, |most, x| most.max(x.abs()));
        for (x, known) in found.iter().zip(&end) {
            let bound = 1e-7 * largest;
            assert!(
                (x - known).abs() <= bound,
                "{}: {x} {known} {way:?}",
                case.machine
            );
        }
    }
}

#[test]
fn an_importer_of_3_gets_what_the_command_prints() {
    // A driven machine with facts, a family of coordinates, and an input with outputs that depend on accelerations.
    for case in [&CASES[1], &CASES[3], &CASES[4]] {
        check(case, "3", include_str!("fmu/driver3.c"), "fmi3Functions.h");
    }
}

#[test]
fn an_importer_of_2_gets_what_the_command_prints() {
    check(
        &CASES[4],
        "2",
        include_str!("fmu/driver2.c"),
        "fmi2Functions.h",
    );
}

/// The archive: its files; identical bytes for the same spec; another token for another machine; and only text without a compiler.
#[test]
fn the_same_machine_is_the_same_unit() {
    let spec = "machines/double_pendulum.machine";
    let units = [(), ()].map(|()| Scratch::new("Pendulum.fmu", ""));
    let tokens = units
        .each_ref()
        .map(|at| unit(spec, at, &[])["token"].to_string());
    assert_eq!(tokens[0], tokens[1]);
    let bytes = units.each_ref().map(|at| fs::read(&at.0).expect("a unit"));
    assert!(bytes[0] == bytes[1], "other bytes");
    let names: Vec<String> = files(&units[0].0).into_keys().collect();
    let sources = [
        "buildDescription.xml",
        "fmi3.c",
        "fmi3FunctionTypes.h",
        "fmi3Functions.h",
        "fmi3PlatformTypes.h",
        "machine.c",
        "method.c",
        "runtime.c",
    ];
    let sources = sources.map(|name| format!("sources/{name}"));
    assert_eq!(
        names[1..],
        [&["modelDescription.xml".to_owned()], &sources[..]].concat()
    );
    assert!(names[0].starts_with("binaries/") && names[0].contains("/Pendulum."));
    let other = Scratch::new("Pendulum.fmu", "");
    let said = unit(spec, &other, &["--set", "m1=2", "--sources-only"]);
    assert_ne!(said["token"].to_string(), tokens[0]);
    assert_eq!(said["platforms"], json!([]));
    let files = files(&other.0);
    assert!(files.keys().all(|name| !name.starts_with("binaries")));
    let description = text(&files, "modelDescription.xml");
    // q, v and a of two angles, then the parameters: references are consecutive.
    assert_eq!(attribute(&description, 7, "name").as_deref(), Some("m1"));
    assert_eq!(attribute(&description, 7, "start").as_deref(), Some("2.0"));
    assert_eq!(
        attribute(&description, 7, "variability").as_deref(),
        Some("tunable")
    );
    assert_eq!(
        attribute(&description, 6, "name").as_deref(),
        Some("der(theta2,2)")
    );
    assert_eq!(
        attribute(&description, 6, "derivative").as_deref(),
        Some("4")
    );
    assert_eq!(
        attribute(&description, 1, "causality").as_deref(),
        Some("output")
    );
}

/// Starts that are formulas of parameters follow them until somebody sets the starts; units, factors and outputs are those requested.
#[test]
fn a_description_says_what_was_asked_for() {
    let spec = "machine Mm in plane {
        parameters { l: mm = 500, w: rpm = 30, m: kg = 1, g: m/s^2 = 9.81, a: rad = 0.5 }
        coordinates { phi: rad = 2*a, 's': m = l }
        inputs { torque: N*m = 0 }
        bodies {
            b { mass: m, at: l*(sin(phi), -cos(phi)) },
            c { mass: m, at: (s, 0) },
        }
        gravity (0, -g);
        forces { motor { on: phi, value: torque*sin(w*t) } }
        outputs { h: mm = -l*cos(phi) }
    }"
    .replace("'s'", "s");
    let spec = Scratch::new("mm.machine", &spec);
    let at = Scratch::new("mm.fmu", "");
    let options = [
        "--sources-only",
        "--outputs",
        "phi,der(s,2)",
        "--start",
        "s=0.25",
    ];
    unit(spec.path(), &at, &options);
    let description = text(&files(&at.0), "modelDescription.xml");
    let of = |reference, name| attribute(&description, reference, name);
    assert_eq!(of(1, "start").as_deref(), Some("1.0"));
    assert_eq!(of(2, "start").as_deref(), Some("0.25"));
    let outputs = (1..=13).filter(|k| of(*k, "causality").as_deref() == Some("output"));
    assert_eq!(outputs.collect::<Vec<_>>(), [1, 6]);
    assert_eq!(of(7, "unit").as_deref(), Some("mm"));
    assert!(description.contains("<Unit name=\"mm\">\n      <BaseUnit m=\"1\" factor=\"0.001\"/>"));
    assert!(description.contains("<BaseUnit m=\"1\" s=\"-2\"/>"));
    assert!(description.contains("name=\"rad/s\""));
    // An importer may connect an input in rpm to an output in rad/s: both have the same powers of base units.
    for unit in [
        "<Unit name=\"rad/s\">\n      <BaseUnit s=\"-1\" rad=\"1\"/>",
        "<Unit name=\"rpm\">\n      <BaseUnit s=\"-1\" rad=\"1\" factor=\"0.10471975511965978\"/>",
    ] {
        assert!(description.contains(unit), "{unit}: {description}");
    }
    let machine = text(&files(&at.0), "sources/machine.c");
    assert!(machine.contains("START_IS_SET[] = {0, 1, 0, 0, 0};"));
}

/// Starts follow parameters until somebody sets them. A fact that ceases to hold is reported once; missing accelerations are reported
/// with the cause.
#[test]
fn a_unit_says_what_is_wrong() {
    let spec = "machine Pole in plane {
        parameters { l: m = 1 }
        coordinates { s: m = 2*l, phi: rad = 0.5 }
        assume { s > 0 }
        bodies { b { mass: 2*kg, at: polar(s, phi) } }
    }";
    let spec = Scratch::new("pole.machine", spec);
    let at = Scratch::new("Machine.fmu", "");
    let made = unit(spec.path(), &at, &["--rate", "s=-1"]);
    let folder = at.0.parent().expect("a folder");
    for (name, content) in &files(&at.0) {
        let name = name.rsplit('/').next().expect("a name");
        fs::write(folder.join(name), content).expect("a file");
    }
    fs::write(folder.join("driver.c"), include_str!("fmu/messages.c")).expect("a file");
    let mut cc = Command::new("cc");
    cc.current_dir(folder)
        .args(["-std=c99", "-Wall", "-Werror"]);
    cc.arg(format!("-DTOKEN={}", made["token"]));
    run(
        cc.args(["driver.c", "./Machine.so", "-o", "driver", "-Wl,-rpath,."]),
        "",
    );
    let said = run(Command::new("./driver").current_dir(folder), "");
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), 4, "{said}");
    for (line, words) in lines.iter().zip([
        &["3 logStatusError", "the reference 1"][..],
        &["1 logStatusWarning", "it no longer holds that s > 0"],
        &["2 logStatusDiscard", "no acceleration of phi"],
        &["3 logStatusError", "only in co-simulation"],
    ]) {
        assert!(words.iter().all(|words| line.contains(words)), "{line}");
    }
}

/// A ball and a pendulum with events whose instants have closed forms, as a unit of this version of FMI.
fn eventful(version: &str, method: &str, further: &[&str]) -> (Scratch, Value) {
    let spec = "machine Two in plane {
        parameters { g: m/s^2 = 9.81, high: m = 2.3 }
        coordinates { y: m = 2, theta: rad = 1 }
        assume { y > -1000*m }
        bodies {
            ball { mass: 1*kg, at: (0, y) },
            bob { mass: 2*kg, at: 0.5*m*(sin(theta), -cos(theta)) },
        }
        gravity (0, -g);
    }";
    let spec = Scratch::new("two.machine", spec);
    let at = Scratch::new("Machine.fmu", "");
    let options = [
        &["--fmi", version, "--method", method, "--rate", "y=3"][..],
        &["--event", "high=y-high", "--event", "low=y-1*m"],
        // Zero at the start up to round-off, whose sign differs from the one a little later.
        &["--event", "begin=y/3-0.6666666666666667*m"],
        &["--event", "bottom=theta"],
        further,
    ];
    let made = unit(spec.path(), &at, &options.concat());
    assert_eq!(made["events"], json!(4 + further.len() / 2));
    (at, made)
}

/// Instants, counts, ends of steps and saved states, by an importer in C; and the contents of the descriptions.
#[test]
fn a_unit_finds_its_events() {
    let cases = [
        ("3", "dop853", &[][..], include_str!("fmu/events3.c")),
        ("3", "dopri5", &[], include_str!("fmu/events3.c")),
        ("2", "dop853", &[], include_str!("fmu/events2.c")),
        (
            "3",
            "dop853",
            &["--event", "lost=sqrt(y+9*m)"],
            concat!("#define LOST 1\n", include_str!("fmu/events3.c")),
        ),
    ];
    for (version, method, further, driver) in cases {
        let (at, made) = eventful(version, method, further);
        let folder = at.0.parent().expect("a folder");
        let files = files(&at.0);
        for (name, content) in &files {
            let name = name.rsplit('/').next().expect("a name");
            fs::write(folder.join(name), content).expect("a file");
        }
        fs::write(folder.join("events.h"), include_str!("fmu/events.h")).expect("a file");
        fs::write(folder.join("must.h"), include_str!("fmu/must.h")).expect("a file");
        fs::write(folder.join("driver.c"), driver).expect("a file");
        let mut cc = Command::new("cc");
        cc.current_dir(folder)
            .args(["-std=c99", "-Wall", "-Werror"]);
        cc.arg(format!("-DTOKEN={}", made["token"]));
        cc.args(["driver.c", "./Machine.so", "-o", "driver", "-lm"]);
        run(cc.arg("-Wl,-rpath,."), "");
        run(Command::new("./driver").current_dir(folder), "");
        if !further.is_empty() {
            continue; // the references after the formulas differ
        }
        let description = text(&files, "modelDescription.xml");
        let wanted: &[&str] = match version {
            "3" => &[
                "<EventIndicator valueReference=\"11\" dependencies=\"1\"",
                "<EventIndicator valueReference=\"15\" dependencies=\"2\"",
                "needsCompletedIntegratorStep=\"true\"",
                "hasEventMode=\"true\"",
                "<Int32 name=\"event.bottom\" valueReference=\"19\"",
                "<Float64 name=\"'indicator(low)'\" valueReference=\"13\" description=\"Changes sign at the event low: y-1*m\" \
                 causality=\"local\" variability=\"continuous\" initial=\"calculated\" unit=\"m\"/>",
            ],
            _ => &["numberOfEventIndicators=\"5\"", "<Integer/>"],
        };
        for words in wanted {
            assert!(description.contains(words), "{words}: {description}");
        }
    }
    // Without events none of these exist.
    let at = Scratch::new("Pendulum.fmu", "");
    let made = unit("machines/double_pendulum.machine", &at, &["--sources-only"]);
    assert_eq!(made["events"], json!(0));
    let description = text(&files(&at.0), "modelDescription.xml");
    for words in ["Int32", "EventIndicator", "hasEventMode", "needsCompleted"] {
        assert!(!description.contains(words), "{words}: {description}");
    }
}

/// Two sign changes within one step are found, of events and of facts; those of facts also have their instants.
#[test]
fn a_unit_finds_what_comes_and_goes_within_a_step() {
    let spec = "machine Two in plane {
        parameters { g: m/s^2 = 9.81 }
        coordinates { y: m = 2, theta: rad = 1 }
        assume { y < 2.4587*m, theta > -0.99999*rad, y >= 1*m }
        bodies {
            ball { mass: 1*kg, at: (0, y) },
            bob { mass: 2*kg, at: 0.5*m*(sin(theta), -cos(theta)) },
        }
        gravity (0, -g);
    }";
    let spec = Scratch::new("two.machine", spec);
    for method in ["dop853", "dopri5"] {
        let at = Scratch::new("Machine.fmu", "");
        let options = [
            &["--method", method, "--rate", "y=3"][..],
            &[
                "--event",
                "top=y-2.4585*m",
                "--event",
                "edge=theta+0.9999*rad",
            ],
        ];
        let made = unit(spec.path(), &at, &options.concat());
        drive(&at, &made, include_str!("fmu/grazing3.c"));
    }
}

/// Runs an importer in C, which checks a unit of FMI 3.0.
fn drive(at: &Scratch, made: &Value, driver: &str) {
    let folder = at.0.parent().expect("a folder");
    for (name, content) in &files(&at.0) {
        let name = name.rsplit('/').next().expect("a name");
        fs::write(folder.join(name), content).expect("a file");
    }
    for (name, content) in [
        ("events.h", include_str!("fmu/events.h")),
        ("must.h", include_str!("fmu/must.h")),
        ("steps3.h", include_str!("fmu/steps3.h")),
        ("driver.c", driver),
    ] {
        fs::write(folder.join(name), content).expect("a file");
    }
    let mut cc = Command::new("cc");
    // The header contains functions for other importers.
    let flags = ["-std=c99", "-Wall", "-Werror", "-Wno-unused-function"];
    cc.current_dir(folder).args(flags);
    cc.arg(format!("-DTOKEN={}", made["token"]));
    cc.args(["driver.c", "./Machine.so", "-o", "driver", "-lm"]);
    run(cc.arg("-Wl,-rpath,."), "");
    run(Command::new("./driver").current_dir(folder), "");
}

/// A wheel that rotates uniformly allows long steps: each event of its angle is found in a step with hundreds of revolutions, also if its
/// coordinate is a pure number or the distance rolled.
#[test]
fn a_unit_finds_what_happens_at_each_turn() {
    let wheels = [
        (
            "coordinates { phi: rad = 0.3, der(phi): rad/s = 10 }",
            "phi",
            "0",
        ),
        (
            "coordinates { phi: 1 = 0.3, der(phi): 1/s = 10 }",
            "phi",
            "0",
        ),
        ("coordinates { x: m = 0.03, der(x): m/s = 1 }", "x/r", "x"),
    ];
    for (coordinates, angle, way) in wheels {
        let spec = format!(
            "machine Wheel in plane {{
                parameters {{ J: kg*m^2 = 1, m: kg = 1, r: m = 0.1 }}
                {coordinates}
                assume {{ sin({angle}) > -0.5 }}
                frames {{ wheel = ground.shift({way}, 0).turn({angle}) }}
                bodies {{ wheel {{ mass: m, inertia: J, frame: wheel }} }}
                gravity none;
            }}"
        );
        let spec = Scratch::new("wheel.machine", &spec);
        for method in ["dop853", "dopri5"] {
            let at = Scratch::new("Machine.fmu", "");
            let event = format!("upright=cos({angle})");
            let made = unit(spec.path(), &at, &["--method", method, "--event", &event]);
            drive(&at, &made, include_str!("fmu/turns3.c"));
        }
    }
}

/// Two sign changes about a turning point are found in a step that is symmetric about it, so that the odd terms of the motion vanish.
#[test]
fn a_unit_finds_what_comes_and_goes_in_the_middle_of_a_step() {
    let spec = "machine Two in plane {
        parameters { M: kg = 1, k: N/m = 1, stiff: N/m = 4, depth: m = 0.1 }
        coordinates { x: m, y: m }
        bodies { one { mass: M, at: (x, 0) }, two { mass: M, at: (y, 1*m) } }
        gravity none;
        springs { left { stiffness: k, stretch: x }, right { stiffness: stiff, stretch: y } }
    }";
    let spec = Scratch::new("two.machine", spec);
    for method in ["dop853", "dopri5"] {
        let at = Scratch::new("Machine.fmu", "");
        let options = [
            ["--method", method, "--event", "one=x-(1*m-depth)"],
            ["--fmi", "3", "--event", "both=x+y-(1.3*m-depth)"],
        ];
        let made = unit(spec.path(), &at, &options.concat());
        drive(&at, &made, include_str!("fmu/symmetric3.c"));
    }
}

#[test]
fn events_that_are_none_are_refused() {
    let at = Scratch::new("machine.fmu", "older");
    let pendulum = "machines/double_pendulum.machine";
    for (events, status, words) in [
        (&["low=theta3"][..], 1, "did you mean `theta1`?"),
        (&["low=theta1+1*m"], 1, "expected rad, found m"),
        (&["low=(1, 2)"], 1, "found a vector"),
        (&["low=theta1 <"], 1, "--event low"),
        (&["low"], 2, "expected NAME=VALUE"),
        (&["low="], 2, "expected a value after `=`"),
        (&["low=theta1", "low=theta2"], 2, "more than once"),
        (&["so low=theta1"], 2, "letters a to z"),
        (&["θ=theta1"], 2, "letters a to z"),
        (&["low=m1-1*kg"], 2, "does not change"),
        (&["low=der(der(theta1))"], 2, "accelerations"),
    ] {
        let events = events.iter().flat_map(|event| ["--event", event]);
        let events: Vec<&str> = events.collect();
        let output = lagrangian(&[&["fmu", pendulum, "--out", at.path()], &events[..]].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{events:?}: {said}");
        assert!(said.contains(words), "{events:?}: {said}");
        assert_eq!(fs::read_to_string(&at.0).expect("a file"), "older");
    }
}

#[test]
fn what_no_unit_can_be_is_refused() {
    let at = Scratch::new("machine.fmu", "older");
    for (spec, options, status, words) in [
        (
            "block_on_incline",
            &["--kind", "me"][..],
            1,
            "write --kind cs",
        ),
        (
            "contacts/colliding_crusher",
            &["--sources-only"],
            1,
            "the run is no C",
        ),
        (
            "double_pendulum",
            &["--outputs", "theta3"],
            2,
            "did you mean `theta1`?",
        ),
        (
            "bricard",
            &["--sources-only"],
            1,
            "`machine BricardUnit extends \"bricard.machine\" { remove constraints.",
        ),
        (
            "double_pendulum",
            &["--method", "rk4"],
            2,
            "[possible values: dop853, dopri5]",
        ),
        ("double_pendulum", &["--fmi", "1"], 2, "1 is not in 2..=3"),
        (
            "double_pendulum",
            &["--cc", "/no/compiler"],
            1,
            "--sources-only builds a unit without a library",
        ),
        (
            "double_pendulum",
            &["--set", "m1=1", "--set", "m1=2"],
            2,
            "more than once",
        ),
    ] {
        let spec = format!("machines/{spec}.machine");
        let output = lagrangian(&[&["fmu", &spec, "--out", at.path()], options].concat());
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{spec}: {said}");
        assert!(said.contains(words), "{spec}: {said}");
        assert_eq!(fs::read_to_string(&at.0).expect("a file"), "older");
    }
}

/// Values without a default must be given to the command, and then are the defaults.
#[test]
fn everything_in_a_unit_has_a_start_value() {
    let spec = "machine M in plane {
        parameters { m: kg, k: N/m = 1 }
        coordinates { x: m = 1 }
        bodies { b { mass: m, at: (x, 0) } }
        springs { s { stiffness: k, stretch: x } }
    }";
    let spec = Scratch::new("m.machine", spec);
    let at = Scratch::new("m.fmu", "");
    let arguments = ["fmu", spec.path(), "--out", at.path(), "--sources-only"];
    let output = lagrangian(&arguments);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("give it by --set m=VALUE"), "{said}");
    let output = lagrangian(&[&arguments[..], &["--set", "m=2"]].concat());
    assert!(output.status.success());
}

/// The time that a unit takes for steps of a millisecond: `cargo test --workspace --test command real_time -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement"]
fn units_run_in_real_time() {
    for (machine, method) in [("crusher9", "dop853"), ("crusher9", "dopri5")] {
        let at = Scratch::new("Machine.fmu", "");
        let made = unit(
            &format!("machines/{machine}.machine"),
            &at,
            &["--method", method],
        );
        let folder = at.0.parent().expect("a folder");
        for (name, content) in &files(&at.0) {
            let name = name.rsplit('/').next().expect("a name");
            fs::write(folder.join(name), content).expect("a file");
        }
        fs::write(folder.join("driver.c"), include_str!("fmu/real_time.c")).expect("a file");
        let mut cc = Command::new("cc");
        cc.current_dir(folder).args(["-std=gnu11", "-O2"]);
        cc.arg(format!("-DTOKEN={}", made["token"]));
        cc.args(["driver.c", "./Machine.so", "-o", "driver", "-Wl,-rpath,."]);
        run(&mut cc, "");
        let said = run(Command::new("./driver").current_dir(folder), "");
        println!("{machine} by {method}: {}", said.trim());
        let median = said
            .split(' ')
            .next()
            .and_then(|word| word.parse::<f64>().ok());
        assert!(median.expect("a time") < 1000.0, "no real time: {said}");
    }
}

/// Uses FMPy in the Python that the variable LAGRANGIAN_PYTHON names, or `python3`.
#[test]
fn fmpy_validates_and_simulates() {
    let python = std::env::var("LAGRANGIAN_PYTHON").unwrap_or_else(|_| "python3".into());
    let mut probe = Command::new(&python);
    let found = probe.args(["-c", "import fmpy"]).output();
    if !found.is_ok_and(|output| output.status.success()) {
        println!("skipped: {python} has no FMPy");
        return;
    }
    for version in ["2", "3"] {
        let (at, _) = eventful(version, "dop853", &[]);
        let mut command = Command::new(&python);
        command.args(["-c", include_str!("fmu/events.py"), at.path()]);
        let said = run(&mut command, "");
        assert!(said.contains("valid"), "{version}: {said}");
    }
    // A start that violates its constraint by a hundredth, and is projected onto it along the rod.
    let rod = "machine Rod in plane {
        parameters { m: kg = 2, l: m = 1, g: m/s^2 = 9.81 }
        coordinates { x: m = 0.606, y: m = -0.808 }
        bodies { bob { mass: m, at: (x, y) } }
        gravity (0, -g);
        constraints { rod: x^2 + y^2 = l^2 }
    }";
    let rod = Scratch::new("rod.machine", rod);
    let off = [Case {
        machine: rod.path(),
        constants: &[],
        until: 1.0,
        method: "dop853",
        set: &[],
        start: &[],
    }];
    let all = CASES.iter().chain(CONSTRAINED).chain(FURTHER).chain(&off);
    for case in all {
        let spec = if case.machine.ends_with(".machine") {
            case.machine.to_owned()
        } else {
            format!("machines/{}.machine", case.machine)
        };
        let arguments = [
            "simulate",
            &spec,
            "--tolerance",
            "1e-12",
            "--json",
            "--until",
        ];
        let until = case.until.to_string();
        let words = |option: &str, values: &[(&str, f64)]| -> Vec<String> {
            let values = values.iter();
            let words = values.flat_map(|(name, x)| [option.to_owned(), format!("{name}={x:?}")]);
            words.collect()
        };
        let given = [words("--set", case.set), words("--start", case.start)].concat();
        let given: Vec<&str> = given.iter().map(String::as_str).collect();
        let arguments = [&arguments, &[until.as_str()][..], case.constants, &given];
        let output = lagrangian(&arguments.concat());
        let end: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let q = end["q"].as_object().expect("coordinates");
        let ends: serde_json::Map<String, Value> = q.clone();
        let start = case.set.iter().chain(case.start);
        let start: BTreeMap<&str, f64> = start.copied().collect();
        let wanted = json!({"until": case.until, "start": start, "end": ends});
        for version in ["2", "3"] {
            let at = Scratch::new("Machine.fmu", "");
            unit(&spec, &at, &[&["--fmi", version], case.constants].concat());
            let mut command = Command::new(&python);
            command.args(["-c", include_str!("fmu/fmpy.py"), at.path()]);
            let said = run(command.arg(wanted.to_string()), "");
            assert!(said.contains("valid"), "{} {version}: {said}", case.machine);
        }
    }
}

/// The model structure lists the dependencies of each derivative. For a double pendulum, by the book, the first acceleration depends on angles and
/// rates, and the derivative of an angle only on its rate; parameters are fixed after the start, and nothing depends on time.
#[test]
fn a_description_tells_what_depends_on_what() {
    let spec = "machines/double_pendulum.machine";
    for (version, of_state, of_start) in [
        (
            "3",
            "<ContinuousStateDerivative valueReference=\"5\" dependencies=\"1 2 3 4\" dependenciesKind=\"dependent dependent \
             dependent dependent\"/>",
            "<InitialUnknown valueReference=\"5\" dependencies=\"1 2 3 4 7 8 9 10 11\"",
        ),
        (
            "2",
            "<Unknown index=\"6\" dependencies=\"2 3 4 5\" dependenciesKind=\"dependent dependent dependent dependent\"/>",
            "<Unknown index=\"6\" dependencies=\"2 3 4 5 8 9 10 11 12\"",
        ),
    ] {
        let at = Scratch::new("Pendulum.fmu", "");
        unit(spec, &at, &["--fmi", version, "--sources-only"]);
        let description = text(&files(&at.0), "modelDescription.xml");
        for line in [of_state, of_start, "dependenciesKind=\"constant\""] {
            assert!(description.contains(line), "{line}: {description}");
        }
    }
    // The acceleration of the cart does not depend on its coordinate, but on the input.
    let at = Scratch::new("Cart.fmu", "");
    unit("machines/cart_pole.machine", &at, &["--sources-only"]);
    let description = text(&files(&at.0), "modelDescription.xml");
    let of = |reference: usize| {
        let mark = format!("<ContinuousStateDerivative valueReference=\"{reference}\"");
        let line = description.lines().find(|line| line.contains(&mark));
        let (_, rest) = line?.split_once("dependencies=\"")?;
        Some(rest.split('"').next()?.to_owned())
    };
    // Coordinates are 1 and 2, the cart's first; rates 3 and 4; parameters follow the accelerations, then the input.
    let acceleration = of(5).expect("an acceleration");
    let on: Vec<&str> = acceleration.split(' ').collect();
    assert!(!on.contains(&"1") && on.contains(&"2"), "{acceleration}");
}

/// Libraries for other platforms, each in its folder, by compilers that take the target as an option or have it in their name.
#[test]
#[cfg(target_os = "linux")]
fn a_unit_has_libraries_for_the_targets_that_are_asked_for() {
    // Writes its arguments to the file that a compiler would write.
    let script = "#!/bin/sh\nout=\nfor word; do [ \"$before\" = -o ] && out=$word; before=$word; done\nprintf '%s ' \"$@\" > \"$out\"\n";
    let compiler = Scratch::new("compiler", script);
    run(Command::new("chmod").args(["+x", compiler.path()]), "");
    let named = Scratch::new("arm64-apple-darwin-cc", script);
    run(Command::new("chmod").args(["+x", named.path()]), "");
    let by_name = named.path().replace("arm64-apple-darwin", "{}");
    let spec = "machines/simple_pendulum.machine";
    let at = Scratch::new("Swing.fmu", "");
    let options = [
        "--cc",
        compiler.path(),
        "--target",
        "x86_64-w64-mingw32,aarch64-linux-gnu",
    ];
    let said = unit(spec, &at, &options);
    assert_eq!(
        said["platforms"],
        json!(["x86_64-windows", "aarch64-linux"])
    );
    let files_of = files(&at.0);
    for (name, target) in [
        (
            "binaries/x86_64-windows/Swing.dll",
            "--target=x86_64-w64-mingw32 ",
        ),
        (
            "binaries/aarch64-linux/Swing.so",
            "--target=aarch64-linux-gnu ",
        ),
    ] {
        let told = text(&files_of, name);
        assert!(
            told.starts_with(target) && told.contains(" fmi3.c "),
            "{told}"
        );
    }
    let options = [
        "--fmi",
        "2",
        "--cc",
        &by_name,
        "--target",
        "arm64-apple-darwin",
    ];
    unit(spec, &at, &options);
    let told = text(&files(&at.0), "binaries/darwin64/Swing.dylib");
    assert!(
        !told.contains("--target") && told.contains(" fmi2.c "),
        "{told}"
    );
    for (target, words) in [
        ("riscv64-linux-gnu", "a unit has folders for"),
        ("x86_64-linux-gnu,x86_64-unknown-linux-musl", "already"),
    ] {
        let arguments = [
            "fmu",
            spec,
            "--out",
            at.path(),
            "--cc",
            compiler.path(),
            "--target",
            target,
        ];
        let output = lagrangian(&arguments);
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(words), "{said}");
    }
}
