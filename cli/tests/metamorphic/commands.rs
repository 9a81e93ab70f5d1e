//! Tests of what the command prints and generates: `evaluate`, `modes`, C and shared libraries.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use lagrangian_emit as emit;
use lagrangian_languages as languages;
use lagrangian_mechanics::Proved;
use lagrangian_program::{FrictionLayout, FrictionResponse, Role};
use lagrangian_scalar::{DoubleDouble, Scalar};
use nalgebra::{Complex, DMatrix};
use serde_json::{Value, json};

use super::evaluation::{Case, Expected, compile, rewrite, write};
use super::generate::Kind;
use super::machine::{Elastic, Expr, Machine, Stretch, num, q, sum};
use super::random::Random;
use super::rewrite::Rewritten;
use super::text;
use super::truth::{State, Variable, World, on_constraints};
use super::{Tally, seed};

/// A folder that is removed when the test ends.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("lagrangian-{}-{name}", std::process::id()));
        fs::create_dir_all(&path).expect("a temporary folder");
        Folder(path)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).expect("the folder can be written");
    }

    /// Runs a program in the folder; returns its output, or its error message.
    fn run(&self, program: &str, arguments: &[&str]) -> Result<String, String> {
        let output = Command::new(program)
            .args(arguments)
            .current_dir(&self.0)
            .stdin(Stdio::null())
            .output()
            .map_err(|error| error.to_string())?;
        if output.status.success() {
            Ok(String::from_utf8_lossy(&output.stdout).into_owned())
        } else {
            Err(String::from_utf8_lossy(&output.stderr).into_owned())
        }
    }

    fn lagrangian(&self, arguments: &[&str]) -> Result<Value, String> {
        let text = self.run(env!("CARGO_BIN_EXE_lagrangian"), arguments)?;
        serde_json::from_str(&text).map_err(|error| error.to_string())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0); // a remaining folder does no harm
    }
}

/// A machine that can be at rest: time is constant, and every coordinate has a spring.
fn still(random: &mut Random, kind: Kind) -> Option<Case> {
    let mut machine = Case::random(random, kind)?.machine;
    machine.replace(&mut |e| {
        if *e == Expr::Time {
            *e = num(0.5);
        }
    });
    // Powers of speeds that are not squares have no derivative at rest.
    machine
        .dissipations
        .retain(|e| !e.any(|e| matches!(e, Expr::Power(_, halves) if halves % 2 != 0)));
    machine.approximations.clear();
    for i in 0..machine.coordinates.len() {
        let start = (machine.coordinates[i].start * 64.0).round() / 64.0;
        machine.coordinates[i].start = start;
        machine.coordinates[i].rate = 0.0;
        let stretch = sum(vec![q(i), num(-start)]);
        machine.springs.push(Elastic {
            name: format!("e{i}"),
            factor: num(random.number(30.0, 60.0)),
            stretch: Stretch::Number(stretch),
        });
    }
    let wide = |f: fn(&super::machine::Coordinate) -> f64| {
        machine
            .coordinates
            .iter()
            .map(|c| DoubleDouble::from_f64(f(c)))
            .collect()
    };
    let state = State {
        t: DoubleDouble::ZERO,
        q: wide(|c| c.start),
        v: wide(|c| c.rate),
    };
    let state = on_constraints(&machine, &state)?;
    Case::at(machine, state)
}

/// The eigenvalues that `modes` prints, both of each conjugate pair.
fn eigenvalues(result: &Value) -> Vec<Complex<f64>> {
    let modes = result["modes"].as_array().into_iter().flatten();
    let mut list = Vec::new();
    for mode in modes {
        let part = |name: &str| mode[name].as_f64().unwrap_or(f64::NAN);
        let value = Complex::new(part("re"), part("im"));
        list.push(value);
        if value.im != 0.0 {
            list.push(value.conj());
        }
    }
    list
}

/// The distance of two sets: each number of one is matched with the nearest unmatched number of the other.
fn distance(a: &[Complex<f64>], b: &[Complex<f64>]) -> f64 {
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    let mut left = b.to_vec();
    let mut worst: f64 = 0.0;
    for x in a {
        let far = |y: &Complex<f64>| (x - y).norm();
        let nearest = (0..left.len()).min_by(|i, j| far(&left[*i]).total_cmp(&far(&left[*j])));
        if let Some(nearest) = nearest {
            worst = worst.max(far(&left[nearest]));
            left.swap_remove(nearest);
        }
    }
    worst
}

/// The eigenvalues of ÿ = A y + B ẏ, with A and B from the evaluator.
fn true_eigenvalues(machine: &Machine, equilibrium: &[f64]) -> Option<Vec<Complex<f64>>> {
    let n = equilibrium.len();
    let state = State {
        t: 0.0,
        q: equilibrium.to_vec(),
        v: vec![0.0; n],
    };
    let world = World::new(machine, &state);
    let truth = world.truth()?;
    let mut matrix = DMatrix::<f64>::zeros(2 * n, 2 * n);
    for j in 0..n {
        matrix[(j, n + j)] = 1.0;
        let by = |variable| world.derivative(variable, &truth.accelerations, &[]);
        let (by_place, by_rate) = (by(Variable::Coordinate(j))?, by(Variable::Rate(j))?);
        for i in 0..n {
            matrix[(n + i, j)] = by_place[i];
            matrix[(n + i, n + j)] = by_rate[i];
        }
    }
    Some(matrix.complex_eigenvalues().iter().copied().collect())
}

/// The equilibrium that `modes` found.
fn places(result: &Value, machine: &Machine) -> Vec<f64> {
    let of = |c: &super::machine::Coordinate| result["equilibrium"]["q"][&c.name].as_f64();
    let places = machine
        .coordinates
        .iter()
        .map(|c| of(c).unwrap_or(f64::NAN));
    places.collect()
}

/// Compares `modes` and `evaluate` of a machine and of its rewritten form.
pub fn modes(mut random: Random, number: usize, tally: &mut Tally) {
    let kinds = [Kind::Formulas, Kind::Tree, Kind::Closed, Kind::Guided];
    let kind = kinds[number % kinds.len()];
    if kind == Kind::Guided {
        guided(&mut random, number, tally);
        return;
    }
    let Some(case) = still(&mut random, kind) else {
        return;
    };
    // With a nonholonomic constraint equilibria form a continuum, and each search finds a different one.
    if case.machine.constraints.iter().any(|one| !one.holonomic) {
        return;
    }
    let (rewritten, single) = rewrite(&case, &mut random);
    // A constraint that only fixes a rate allows equilibria anywhere, and relative to moving ground nothing is at rest.
    let other_modes = ["constraint by its rate", "ground moving"];
    if rewritten.names.is_empty()
        || rewritten
            .names
            .iter()
            .any(|name| other_modes.contains(name))
    {
        return;
    }
    let Ok(Some(expected)) = Expected::of_rewritten(&case, &rewritten, &single) else {
        return;
    };
    let folder = Folder::new(&format!("modes-{number}"));
    let written = write(&rewritten.machine, "Rewritten", &mut random);
    let first_text = text::spec(&case.machine, "Random");
    folder.write("first.machine", &first_text);
    folder.write("second.machine", &written.text);
    for (name, text) in &written.files {
        folder.write(name, text);
    }
    let first = folder.lagrangian(&["modes", "first.machine", "--json"]);
    let second = folder.lagrangian(&["modes", "second.machine", "--json"]);
    let names = format!("{:?}", rewritten.names);
    let failure = |what: String| format!("{names}: {what}\n{}of\n{first_text}", written.text);
    let steps = |result: &Value| result["equilibrium"]["steps"].as_f64().unwrap_or(0.0);
    match (first, second) {
        (Ok(first), Ok(second)) => {
            let (one, other) = (eigenvalues(&first), eigenvalues(&second));
            let largest = one.iter().map(|x| x.norm()).fold(1.0, f64::max);
            // A double eigenvalue changes by the square root of the matrix's round-off.
            let bound = f64::EPSILON.sqrt() * 64.0 * largest / case.truth.pivot.sqrt();
            let apart = distance(&one, &other);
            // If there are several equilibria, each search may have found a different one. A search stops once forces are
            // round-off, so two positions are different only if the first half of their digits differs.
            let (here, there) = (
                places(&first, &case.machine),
                places(&second, &rewritten.machine),
            );
            let state = State {
                t: 0.0,
                v: vec![0.0; here.len()],
                q: here.clone(),
            };
            let world = World::<f64>::new(&case.machine, &state);
            let [wanted, ..] = world.motion(&rewritten.coordinates, &state.v);
            let is_same = wanted.iter().zip(&there).all(|(a, b)| {
                // An angle of a point, such as a polar angle, is only known up to whole turns.
                let turns = ((a - b) / TAU).round() * TAU;
                let apart = (a - b).abs().min((a - b - turns).abs());
                apart <= bound * (1.0 + a.abs())
            });
            if apart > bound && is_same {
                tally.failures.push(failure(format!(
                    "{one:?} and {other:?}: {apart:e} apart, {bound:e} may be"
                )));
                return;
            }
            let truth = if case.machine.constraints.is_empty() {
                true_eigenvalues(&case.machine, &here)
            } else {
                None
            };
            if let Some(truth) = truth {
                let apart = distance(&one, &truth);
                if apart > bound {
                    tally.failures.push(failure(format!(
                        "{one:?}, not {truth:?}: {apart:e} apart, {bound:e} may be"
                    )));
                    return;
                }
            }
            tally.count(if is_same {
                "modes"
            } else {
                "another equilibrium"
            });
        }
        // An equilibrium that one form finds only after a long search need not be found in the other. A search in coordinates with
        // singularities may also end at one and report that.
        (Ok(first), Err(_))
            if steps(&first) >= 8.0 || rewritten.names.contains(&"polar coordinates") =>
        {
            tally.count("no equilibrium");
        }
        (Ok(_), Err(error)) => {
            tally.failures.push(failure(format!("no modes: {error}")));
        }
        (Err(_), _) => tally.count("no equilibrium"),
    }
    evaluate(&folder, &expected, tally, &names, &written.text);
}

/// A machine with guides and its rewritten form: `evaluate` must give the accelerations and the contact forces. `modes` and
/// `library` do not support sticking, so they must report that and write nothing.
fn guided(random: &mut Random, number: usize, tally: &mut Tally) {
    let Some(case) = Case::random(random, Kind::Guided) else {
        return;
    };
    let (rewritten, single) = rewrite(&case, random);
    let Ok(Some(expected)) = Expected::of_rewritten(&case, &rewritten, &single) else {
        return;
    };
    let written = write(&rewritten.machine, "Rewritten", random);
    // The forces that a guide carries may not follow from this form; another test covers that.
    if compile(&written.text, &written.files).is_err() {
        return;
    }
    let folder = Folder::new(&format!("guided-{number}"));
    folder.write("second.machine", &written.text);
    for (name, text) in &written.files {
        folder.write(name, text);
    }
    let names = format!("{:?}", rewritten.names);
    evaluate(&folder, &expected, tally, &names, &written.text);
    for (arguments, why) in [
        (&["modes", "second.machine", "--json"][..], "slid"),
        (
            &["library", "second.machine", "--out", "made.so", "--json"],
            "a library of a machine with `sliding` cannot be made",
        ),
    ] {
        let said = folder.lagrangian(arguments);
        let made = folder.0.join("made.so").exists();
        if !said.as_ref().is_err_and(|error| error.contains(why)) || made {
            let text = &written.text;
            tally
                .failures
                .push(format!("{names}: {arguments:?} says {said:?}\n{text}"));
            return;
        }
    }
    tally.count("guided");
}

/// Compares `evaluate` at the state with what is expected.
fn evaluate(folder: &Folder, expected: &Expected, tally: &mut Tally, names: &str, text: &str) {
    let State { t, q, v } = &expected.state;
    let plain = |list: &[DoubleDouble]| list.iter().map(|x| x.hi()).collect::<Vec<f64>>();
    let point = json!([{ "t": t.hi(), "q": plain(q), "v": plain(v) }]);
    folder.write("points.json", &point.to_string());
    let result = folder.lagrangian(&["evaluate", "second.machine", "--at", "points.json"]);
    let found = match &result {
        Ok(result) => result[0]["accelerations"].as_array(),
        Err(_) => None,
    };
    let Some(found) = found else {
        tally
            .failures
            .push(format!("{names}: evaluate says {result:?}\n{text}"));
        return;
    };
    let bound = f64::EPSILON * 4096.0 * expected.size * expected.size / expected.pivot;
    for (found, a) in found.iter().zip(&expected.accelerations) {
        let error = (found.as_f64().unwrap_or(f64::NAN) - a.hi()).abs();
        if error.is_nan() || error > bound {
            let a = a.hi();
            tally.failures.push(format!(
                "{names}: evaluate prints {found}, not {a} ({error:e}, {bound:e} may be)\n{text}"
            ));
            return;
        }
    }
    for (name, values) in &expected.contacts {
        let contact = &result
            .as_ref()
            .map_or(&Value::Null, |result| &result[0]["contacts"])[name];
        let parts = ["slip", "normal", "friction"];
        for (part, value) in parts.into_iter().zip(values) {
            let error = (contact[part].as_f64().unwrap_or(f64::NAN) - value.hi()).abs();
            if error.is_nan() || error > bound {
                let (found, value) = (&contact[part], value.hi());
                tally.failures.push(format!(
                    "{names}: evaluate prints the {part} {found} of {name}, not {value} ({error:e}, {bound:e} may be)\n{text}"
                ));
                return;
            }
        }
    }
    tally.count("evaluate");
}

/// A machine of one of these kinds and its rewritten form, each with what is expected of it.
fn pair(random: &mut Random, kind: Kind) -> Option<[(Machine, Expected); 2]> {
    let case = Case::random(random, kind)?;
    let (rewritten, single) = rewrite(&case, random);
    if rewritten.names.is_empty() || rewritten.constraints.len() > single.constraints.len() {
        return None;
    }
    let expected = Expected::of_rewritten(&case, &rewritten, &single).ok()??;
    let first = Expected::of(&case);
    let Rewritten { machine, .. } = rewritten;
    Some([(case.machine, first), (machine, expected)])
}

/// All kinds but machines with guides.
const WITHOUT_GUIDES: [Kind; 4] = [Kind::Formulas, Kind::Tree, Kind::Closed, Kind::Rolling];

/// Generates machines of these kinds in turn, with their programs, until there are enough; each is named by this name
/// and a number.
fn several(name: &str, count: usize, tag: u64, kinds: &[Kind]) -> Vec<(Machine, Proved, Expected)> {
    let mut list = Vec::new();
    let mut random = Random(seed() ^ tag);
    for number in 0..40 * count {
        if list.len() >= count {
            break;
        }
        let kind = kinds[number % kinds.len()];
        for (machine, expected) in pair(&mut random, kind).into_iter().flatten() {
            let name = format!("{name}{}", list.len());
            if let Ok(program) = compile(&text::spec(&machine, &name), &[]) {
                list.push((machine, program, expected));
            }
        }
    }
    list
}

fn numbers(values: &[DoubleDouble]) -> String {
    let values: Vec<String> = values.iter().map(|x| format!("{:?}", x.hi())).collect();
    values.join(", ")
}

/// Checks the printed results, machine after machine, one number per line: the accelerations, or for machines with guides the
/// quantities that depend on friction.
fn hold_printed(printed: &str, list: &[(Machine, Proved, Expected)], what: &str) {
    let mut lines = printed
        .lines()
        .map(|line| line.parse::<f64>().unwrap_or(f64::NAN));
    for (machine, program, expected) in list {
        if let Some(layout) = friction_layout(program) {
            let parts: Vec<f64> = lines.by_ref().take(layout.len()).collect();
            let failures = friction_failures(program, layout, &parts, expected);
            let text = text::spec(machine, &program.name);
            assert!(failures.is_empty(), "{what}: {failures:?}\n{text}");
            continue;
        }
        let bound = f64::EPSILON * 4096.0 * expected.size * expected.size / expected.pivot;
        for (i, a) in expected.accelerations.iter().enumerate() {
            let found = lines.next().unwrap_or(f64::NAN);
            let error = (found - a.hi()).abs();
            assert!(
                error <= bound,
                "{what}: acceleration {i} is {found}, not {} (off by {error:e}, may be {bound:e})\n{}",
                a.hi(),
                text::spec(machine, &program.name)
            );
        }
    }
}

/// The layout of the quantities that depend on friction, if there are any.
fn friction_layout(program: &Proved) -> Option<FrictionLayout> {
    let layout = program.sizes().friction_layout();
    (layout.contacts > 0).then_some(layout)
}

/// Checks the quantities that depend on friction: with the true friction forces they must give the true accelerations, multipliers
/// and normal reactions, and the friction of a sliding contact must be μ times the normal reaction.
fn friction_failures(
    program: &Proved,
    layout: FrictionLayout,
    parts: &[f64],
    expected: &Expected,
) -> Vec<String> {
    if parts.len() != layout.len() {
        return vec![format!("{} numbers, not {}", parts.len(), layout.len())];
    }
    let known = |name: &String| expected.contacts.iter().find(|(known, _)| known == name);
    let contacts = program.contacts.iter();
    let contacts: Option<Vec<[f64; 3]>> = contacts
        .map(|name| known(name).map(|(_, values)| values.map(|x| x.hi())))
        .collect();
    let Some(contacts) = contacts else {
        return vec!["a contact has another name".to_owned()];
    };
    let response = FrictionResponse {
        layout,
        values: parts,
    };
    let mut wanted: Vec<(String, usize, f64)> = Vec::new();
    for (i, a) in expected.accelerations.iter().enumerate() {
        wanted.push((format!("acceleration {i}"), i, a.hi()));
    }
    for (name, value) in &expected.multipliers {
        match program.constraints.iter().position(|one| one.name == *name) {
            Some(k) => {
                let place = layout.multiplier(k);
                wanted.push((format!("multiplier of {name}"), place, value.hi()));
            }
            None => return vec![format!("there is no constraint {name}")],
        }
    }
    for (k, [_, normal, _]) in contacts.iter().enumerate() {
        let name = &program.contacts[k];
        wanted.push((
            format!("normal reaction of {name}"),
            layout.normal(k).start,
            *normal,
        ));
    }
    let mut failures = Vec::new();
    for (what, place, value) in wanted {
        let terms = contacts.iter().enumerate();
        let terms = terms.map(|(k, [.., friction])| friction * response.at(1 + k, place));
        let terms: Vec<f64> = [response.at(0, place)].into_iter().chain(terms).collect();
        // Terms may be larger than their sum, so they determine the round-off.
        let size = terms
            .iter()
            .fold(expected.size, |size, term| size.max(term.abs()));
        let bound = f64::EPSILON * 4096.0 * size * size / expected.pivot;
        let found: f64 = terms.iter().sum();
        let error = (found - value).abs();
        if error.is_nan() || error > bound {
            failures.push(format!(
                "{what} is {found}, not {value} (off by {error:e}, may be {bound:e})"
            ));
        }
    }
    for (k, [slip, normal, friction]) in contacts.iter().enumerate() {
        // A slip within round-off counts as rest; static friction is the force that maintains it, at most μ₀ times
        // the normal reaction.
        let slides = slip.abs() >= 1e-12;
        let coefficient = if slides {
            response.friction(k)
        } else {
            response.static_friction(k)
        };
        let most = normal.abs() * coefficient;
        let bound = f64::EPSILON * 4096.0 * expected.size * expected.size / expected.pivot;
        let error = if slides {
            (friction + slip.signum() * most).abs()
        } else {
            (friction.abs() - most).max(0.0)
        };
        if error.is_nan() || error > bound {
            let name = &program.contacts[k];
            failures.push(format!(
                "{name} rubs with {friction}, and μ N is {most} (off by {error:e}, may be {bound:e})"
            ));
        }
    }
    failures
}

/// Compiles C for many machines with one call of the compiler.
pub fn as_c() {
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let folder = Folder::new("metamorphic-c");
    if folder.run(&compiler, &["--version"]).is_err() {
        eprintln!("there is no C compiler; nothing is tested");
        return;
    }
    let mut list = several("Free", 24, 0xC, &WITHOUT_GUIDES);
    assert!(list.len() >= 24);
    let guided = several("Guided", 8, 0x6C, &[Kind::Guided]);
    assert!(guided.len() >= 8);
    list.extend(guided);
    let (mut calls, mut prototypes) = (String::new(), String::new());
    let mut files = vec!["main.c".to_owned()];
    for (k, (_, program, expected)) in list.iter().enumerate() {
        folder.write(
            &format!("machine{k}.c"),
            &languages::c::file(program, &[], &BTreeMap::new()),
        );
        folder.write(&format!("call{k}.c"), &c_call(k, program, expected));
        files.push(format!("call{k}.c"));
        let _ = writeln!(prototypes, "int call{k}(void);"); // writing to a String cannot fail
        let _ = writeln!(calls, "    if (call{k}()) return {};", 1 + k); // as above
    }
    folder.write(
        "main.c",
        &format!("{prototypes}\nint main(void) {{\n{calls}    return 0;\n}}\n"),
    );
    let mut arguments = vec!["-std=c99", "-O1"];
    arguments.extend(files.iter().map(String::as_str));
    arguments.extend(["-o", "all", "-lm"]);
    if let Err(error) = folder.run(&compiler, &arguments) {
        panic!("{error}");
    }
    let program = folder.0.join("all");
    let printed = folder.run(&program.to_string_lossy(), &[]);
    hold_printed(&printed.expect("all machines can be called"), &list, "C");
}

fn c_call(k: usize, program: &Proved, expected: &Expected) -> String {
    let prefix = emit::snake_case(&program.name);
    let defaults = |slots: &[lagrangian_program::Slot]| {
        let value =
            |slot: &lagrangian_program::Slot| slot.default.as_ref().map_or(0.0, |x| x.value);
        let values: Vec<String> = slots
            .iter()
            .map(|slot| format!("{:?}", value(slot)))
            .collect();
        values.join(", ")
    };
    let layout = friction_layout(program);
    let (role, count) = match layout {
        Some(layout) => (Role::Friction, layout.len()),
        None => (Role::Accelerations, program.dimension()),
    };
    let function = program.function(role).expect("how it moves");
    let name = role.name();
    let reads = function.reads();
    let all = [
        (reads.prepared || !program.prepare.guards.is_empty(), "&p"),
        (reads.time, "t"),
        (reads.coordinates, "q"),
        (reads.velocities, "v"),
        (reads.inputs, "&u"),
        (true, "a"),
    ];
    let arguments: Vec<&str> = all
        .iter()
        .filter(|(is_read, _)| *is_read)
        .map(|(_, name)| *name)
        .collect();
    let arguments = arguments.join(", ");
    let State { t, q, v } = &expected.state;
    let n = q.len();
    let inputs = if program.inputs.is_empty() {
        String::new()
    } else {
        format!(
            "    const {prefix}_inputs u = {{{}}};\n    (void)u;\n",
            defaults(&program.inputs)
        )
    };
    format!(
        "#include <math.h>\n#include <stdio.h>\n#include \"machine{k}.c\"\n\nint call{k}(void) {{\n    \
         const {prefix}_parameters parameters = {{{}}};\n    {prefix}_prepared p;\n    \
         const double t = {:?}, q[{n}] = {{{}}}, v[{n}] = {{{}}};\n    double a[{count}];\n{inputs}    \
         (void)t, (void)q, (void)v;\n    {prefix}_prepare(&parameters, &p);\n    \
         if ({prefix}_{name}({arguments})) for (int i = 0; i < {count}; i++) a[i] = NAN;\n    \
         for (int i = 0; i < {count}; i++) printf(\"%.17g\\n\", a[i]);\n    return 0;\n}}\n",
        defaults(&program.parameters),
        t.hi(),
        numbers(q),
        numbers(v),
    )
}

/// Builds shared libraries of a few machines and calls them from one C program.
pub fn as_libraries() {
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".to_owned());
    let folder = Folder::new("metamorphic-libraries");
    if folder.run(&compiler, &["--version"]).is_err() {
        eprintln!("there is no C compiler; nothing is tested");
        return;
    }
    let list = several("Machine", 4, 0x50, &WITHOUT_GUIDES);
    let mut calls = String::new();
    for (k, (machine, _, expected)) in list.iter().enumerate() {
        folder.write(
            &format!("machine{k}.machine"),
            &text::spec(machine, "Machine"),
        );
        let (spec, library) = (format!("machine{k}.machine"), format!("lib{k}.so"));
        if let Err(error) = folder.lagrangian(&["library", &spec, "--out", &library, "--json"]) {
            panic!("{error}\n{}", text::spec(machine, "Machine"));
        }
        let State { t, q, v } = &expected.state;
        let state: Vec<DoubleDouble> = q.iter().chain(v).copied().collect();
        let _ = writeln!(
            calls,
            "    {{ const double y[] = {{{}}}; if (call(\"./{library}\", y, {:?}, {})) return {}; }}",
            numbers(&state),
            t.hi(),
            q.len(),
            1 + k
        ); // writing to a String cannot fail
    }
    folder.write(
        "main.c",
        &format!("{CALLER}\nint main(void) {{\n{calls}    return 0;\n}}\n"),
    );
    if let Err(error) = folder.run(&compiler, &["main.c", "-o", "all", "-ldl"]) {
        panic!("{error}");
    }
    let program = folder.0.join("all");
    let printed = folder.run(&program.to_string_lossy(), &[]);
    hold_printed(
        &printed.expect("the libraries can be called"),
        &list,
        "library",
    );
}

const CALLER: &str = r#"
#include <dlfcn.h>
#include <stdio.h>

static int call(const char *path, const double *y, double t, int n) {
    double a[64];
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!library) return 1;
    void (*setup)(const double *) = (void (*)(const double *))dlsym(library, "eval_setup");
    void (*eval)(const double *, double, const double *, double *) =
        (void (*)(const double *, double, const double *, double *))dlsym(library, "eval");
    if (!setup || !eval) return 1;
    setup(0);
    eval(y, t, 0, a);
    for (int i = 0; i < n; ++i) printf("%.17g\n", a[i]);
    return 0;
}
"#;
