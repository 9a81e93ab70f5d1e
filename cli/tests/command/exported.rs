//! `derive --as sympy|matlab|julia|javascript`: the text, run in its own language, gives what `evaluate` prints.
//!
//! Each language is tested where it is installed: Python with SymPy (the variable LAGRANGIAN_PYTHON, or `python3`), Octave,
//! Node. For Julia only the grammar is checked, if Python has `tree_sitter_julia`.

use std::io::Write as _;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use crate::support::{Scratch, lagrangian, root};

/// With inputs and outputs that depend on accelerations; with constraints; with facts and time; a top in space; functions
/// of every kind.
const MACHINES: &[&str] = &[
    "cart_pole",
    "four_bar",
    "crusher9",
    "heavy_top",
    "chaplygin_sleigh",
];

const FUNCTIONS: &str = "machine Functions in plane {
    parameters { m: kg = 2, l: m = 0.4, k: N/m = 30, e: 1 = 2.5, g: m/s^2 = 9.8, w: rad/s = 3 }
    coordinates { x: m = 0.3, phi: rad = 0.4 }
    inputs { u: N = 1 }
    bodies { cart { mass: m, at: (x, 0) }, bob { mass: m, at: (x + l*sin(phi), -l*cos(phi)) } }
    gravity (0, -g);
    forces {
        push { on: x, value: u*tanh(x/l) + k*l*(atan(phi) + asin(sin(phi)/2) + acos(x/(4*l)) + sinh(x/l) + cosh(phi) + tan(phi/3)) },
        turn { on: phi, value: k*l^2*(exp(-phi) + ln(2 + sin(phi)) + sqrt(2 + phi^2) + abs(x/l - 2)^e + atan2(x, l)
            + min(phi, x/l) + max(phi, 2*x/l) + cos(w*t) + sign(x/l)) },
    }
    outputs { pull: N = m*der(der(x)) + k*abs(x) }
}";

fn text(spec: &str, form: &str) -> String {
    let output = lagrangian(&["derive", spec, "--as", form]);
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{spec} {form}: {said}");
    String::from_utf8(output.stdout).expect("text")
}

/// What the command itself computes at the start with every rate changed, and the point in the order of the program.
fn expected(spec: &str) -> (Value, Value) {
    let output = lagrangian(&["simulate", spec, "--until", "0", "--json"]);
    let start: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let moved = |of: &str, by: f64| -> Vec<f64> {
        let values = start[of].as_object().expect("numbers").values();
        let values = values.map(|x| x.as_f64().expect("a number"));
        values
            .enumerate()
            .map(|(i, x)| x + by * (1.0 + 0.3 * i as f64))
            .collect()
    };
    let (q, v, t) = (moved("q", 0.01), moved("v", 0.2), 0.35);
    let point = json!([{ "t": t, "q": q, "v": v }]).to_string();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
    command
        .current_dir(root())
        .args(["evaluate", spec, "--at", "-"]);
    let values: Value = serde_json::from_str(&run(&mut command, &point)).expect("JSON");
    (values[0].clone(), json!({ "t": t, "q": q, "v": v }))
}

fn run(command: &mut Command, input: &str) -> String {
    let pipes = command.stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut child = pipes.stderr(Stdio::piped()).spawn().expect("it runs");
    let mut pipe = child.stdin.take().expect("a pipe");
    pipe.write_all(input.as_bytes()).expect("a reader");
    drop(pipe);
    let output = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {said}");
    String::from_utf8(output.stdout).expect("text")
}

fn is_there(command: &mut Command) -> bool {
    let output = command.stdin(Stdio::null()).output();
    output.is_ok_and(|output| output.status.success())
}

fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(values) => values.iter().flat_map(flat).collect(),
        Value::Object(values) => values.values().flat_map(flat).collect(),
        Value::Number(x) => vec![x.as_f64().expect("a number")],
        _ => vec![],
    }
}

/// Compares `found`, a list of the mass matrix, accelerations, both energies and the outputs.
fn compare(spec: &str, expected: &Value, found: &Value) {
    let parts = [
        "mass_matrix",
        "accelerations",
        "kinetic_energy",
        "potential_energy",
        "outputs",
    ];
    let known: Vec<f64> = parts
        .iter()
        .flat_map(|part| flat(&expected[*part]))
        .collect();
    let found = flat(found);
    assert_eq!(found.len(), known.len(), "{spec}: {found:?} {known:?}");
    // The interpreter fuses some operations, and sines differ in the last place: thousands of roundings.
    let largest = known.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    for (k, (x, y)) in found.iter().zip(&known).enumerate() {
        assert!((x - y).abs() <= 1e-12 * largest, "{spec} {k}: {x} {y}");
    }
}

/// Checks every machine with a program that gets the text and the point.
fn check(form: &str, ending: &str, runner: &dyn Fn(&Scratch, &Value) -> Value) {
    let functions = Scratch::new("functions.machine", FUNCTIONS);
    let library = MACHINES
        .iter()
        .map(|name| format!("machines/{name}.machine"));
    for spec in library.chain([functions.path().to_owned()]) {
        let (expected, point) = expected(&spec);
        let file = Scratch::new(&format!("machine_text.{ending}"), &text(&spec, form));
        compare(&spec, &expected, &runner(&file, &point));
    }
}

#[test]
fn sympy_computes_what_evaluate_prints() {
    let python = std::env::var("LAGRANGIAN_PYTHON").unwrap_or_else(|_| "python3".into());
    if !is_there(Command::new(&python).args(["-c", "import sympy"])) {
        println!("skipped: {python} has no SymPy");
        return;
    }
    check("sympy", "py", &|file, point| {
        let mut command = Command::new(&python);
        command.args(["-c", include_str!("exported/sympy.py"), file.path()]);
        serde_json::from_str(&run(&mut command, &point.to_string())).expect("JSON")
    });
}

#[test]
fn node_computes_what_evaluate_prints() {
    if !is_there(Command::new("node").arg("--version")) {
        println!("skipped: there is no Node");
        return;
    }
    check("javascript", "js", &|file, point| {
        let mut command = Command::new("node");
        command.args(["-e", include_str!("exported/node.js"), file.path()]);
        serde_json::from_str(&run(&mut command, &point.to_string())).expect("JSON")
    });
}

#[test]
fn octave_computes_what_evaluate_prints() {
    if !is_there(Command::new("octave-cli").arg("--version")) {
        println!("skipped: there is no Octave");
        return;
    }
    check("matlab", "m", &|file, point| {
        // The file must have the name of its function.
        let text = std::fs::read_to_string(&file.0).expect("the text");
        let line = text
            .lines()
            .find(|line| line.starts_with("function machine = "));
        let name = line.and_then(|line| line.strip_prefix("function machine = "));
        let name = name
            .and_then(|name| name.strip_suffix("()"))
            .expect("a name");
        let folder = file.0.parent().expect("a folder");
        std::fs::write(folder.join(format!("{name}.m")), &text).expect("a file");
        let column = |of: &str| -> String {
            let numbers: Vec<String> = flat(&point[of]).iter().map(|x| format!("{x:?}")).collect();
            format!("[{}]", numbers.join("; "))
        };
        let script = include_str!("exported/octave.m")
            .replace("MACHINE", name)
            .replace("TIME", &point["t"].to_string())
            .replace("PLACES", &column("q"))
            .replace("RATES", &column("v"));
        let mut command = Command::new("octave-cli");
        command
            .current_dir(folder)
            .args(["--no-init-file", "--quiet", "--eval", &script]);
        let numbers = run(&mut command, "");
        let numbers = numbers
            .split_whitespace()
            .map(|x| x.parse::<f64>().expect("a number"));
        json!(numbers.collect::<Vec<f64>>())
    });
}

#[test]
fn the_text_of_julia_is_julia() {
    let python = std::env::var("LAGRANGIAN_PYTHON").unwrap_or_else(|_| "python3".into());
    if !is_there(Command::new(&python).args(["-c", "import tree_sitter_julia"])) {
        println!("skipped: {python} has no grammar of Julia");
        return;
    }
    let functions = Scratch::new("functions.machine", FUNCTIONS);
    let library = MACHINES
        .iter()
        .map(|name| format!("machines/{name}.machine"));
    for spec in library.chain([functions.path().to_owned()]) {
        let script = "import sys, tree_sitter_julia as j\nfrom tree_sitter import Language, Parser\n\
            tree = Parser(Language(j.language())).parse(sys.stdin.buffer.read())\n\
            assert not tree.root_node.has_error, str(tree.root_node)[:2000]";
        run(
            Command::new(&python).args(["-c", script]),
            &text(&spec, "julia"),
        );
    }
}

/// SymPy does not evaluate sines of exact numbers, such as the constant angles between the axes of this arm.
#[test]
fn sympy_computes_numbers_from_numbers() {
    let python = std::env::var("LAGRANGIAN_PYTHON").unwrap_or_else(|_| "python3".into());
    if !is_there(Command::new(&python).args(["-c", "import sympy"])) {
        println!("skipped: {python} has no SymPy");
        return;
    }
    let spec = "machine Arm in space {
        coordinates { a: rad, b: rad = 0.2, c: rad, x: m }
        frames {
            f = ground.turn(x, 0.3).turn(z, a).shift(0.1, x, 0.2).turn(y, 0.4).turn(x, b).shift(0.2, 0, 0).turn(z, 0.7).turn(y, c),
        }
        bodies { p { mass: 1, inertia: (0.1, 0.2, 0.25, 0.01, 0.02, 0.03), frame: f } }
        gravity (0, 0, -9.81);
    }";
    let spec = Scratch::new("arm.machine", spec);
    let file = Scratch::new("machine_text.py", &text(spec.path(), "sympy"));
    let (expected, point) = expected(spec.path());
    let mut command = Command::new(&python);
    let script = include_str!("exported/sympy.py");
    let script = format!("{script}\nassert all(x.is_Float for x in a), a\n");
    command.args(["-c", &script, file.path()]);
    let found = run(&mut command, &point.to_string());
    compare(
        spec.path(),
        &expected,
        &serde_json::from_str(&found).expect("JSON"),
    );
}

/// With symbols the functions return formulas: those of a pendulum by hand.
#[test]
fn sympy_gives_the_formulas_of_a_pendulum() {
    let python = std::env::var("LAGRANGIAN_PYTHON").unwrap_or_else(|_| "python3".into());
    if !is_there(Command::new(&python).args(["-c", "import sympy"])) {
        println!("skipped: {python} has no SymPy");
        return;
    }
    let spec = "machine Pendulum in plane {
        parameters { m: kg = 2, l: m = 0.5, g: m/s^2 = 9.81 }
        coordinates { theta: rad = 0.3 }
        bodies { bob { mass: m, at: l*(sin(theta), -cos(theta)) } }
        gravity (0, -g);
    }";
    let spec = Scratch::new("pendulum.machine", spec);
    let file = Scratch::new("machine_text.py", &text(spec.path(), "sympy"));
    let script = "import runpy, sys, sympy as sp\nm = runpy.run_path(sys.argv[1])\nx = sp.symbols('m l g', positive=True)\n\
        q, v = sp.symbols('q v')\na = m['accelerations'](m['prepare'](x), 0, [q], [v], [])[0]\n\
        assert sp.simplify(a + x[2]/x[1]*sp.sin(q)) == 0, a\n\
        t = m['kinetic_energy'](m['prepare'](x), 0, [q], [v])\nassert sp.simplify(t - x[0]*x[1]**2*v**2/2) == 0, t";
    run(Command::new(&python).args(["-c", script, file.path()]), "");
}

/// Two outputs whose names are the same with `_` in place of brackets have two functions, in every language.
#[test]
fn outputs_with_similar_names_have_different_functions() {
    let spec = Scratch::new(
        "row.machine",
        "machine Row in plane {
            coordinates { x: m, y: m }
            bodies { block { mass: 1, at: (x, y) } }
            gravity none;
            outputs { o[1..2]: m = x, o_1: m = y }
        }",
    );
    for form in ["sympy", "matlab", "julia", "javascript", "c", "rust"] {
        let text = text(spec.path(), form);
        let calls = |name: &str| {
            let of_function = format!("{name}(");
            text.matches(&of_function).count()
        };
        let own = calls("output_o_1");
        assert!(own > 0, "{form}");
        assert_eq!(calls("output_o_1_"), own, "{form}");
        assert_eq!(calls("output_o_2"), own, "{form}");
    }
}
