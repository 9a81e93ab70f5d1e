//! `lagrangian library`: a machine as a shared library for C and languages that can call C.
//!
//! A single call of `rustc` compiles one file without dependencies: the module of the machine, the exported functions
//! (`library/export.rs`), and the text of the required parts of the crates `lagrangian-scalar` and `lagrangian-native`.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::io::{self, Write as _};
use std::path::Path;
use std::process::{Command, Stdio};

use lagrangian::Machine;
use lagrangian::interpreted::InterpretedMachine;
use lagrangian::native::text::{
    CIRCULAR, FAST_FUNCTION, LANES, PLAIN, REGISTER, SINCOS, VECTOR, X86,
};
use lagrangian::scalar::text::{KERNEL, LIB, REAL, SERIES};
use lagrangian_emit as emit;
use lagrangian_emit::names::word;
use lagrangian_linear::starts::dependent_constraint;
use lagrangian_mechanics::Proved;
use lagrangian_program::{LONGEST_SCHEDULED, Program, Role, Slot};
use lagrangian_spec::diagnostic::most_similar;
use lagrangian_symbolic::Dag;
use serde_json::json;

use crate::call;
use crate::failure::Failure;
use crate::output::{self, Destination, LIBRARY, RUST, keep_apart, keep_document_apart};
use crate::progress;
use crate::reading::Reading;

/// Warns if constraints are dependent: the library solves for all multipliers and has no solution then.
fn warn_of_constraints(program: &Proved) {
    let machine = InterpretedMachine::new(program.clone());
    let start = machine.start();
    let are_known = machine
        .parameter_values()
        .iter()
        .all(|value| value.is_finite())
        && start.q.values.iter().all(|value| value.is_finite());
    if program.constraints.is_empty() || !are_known {
        return;
    }
    if let Some(constraint) = dependent_constraint(&machine, &start) {
        output::print_error(format_args!(
            "warning: the constraint `{constraint}` follows from others at the start, and the library, which solves for the multipliers of \
             all of them, has no accelerations there: if it follows from them everywhere, leave it out in a \
             variant, `remove constraints.{constraint};`"
        ));
    }
}

/// The most unilateral contacts of a library, which returns the rows of all of them in one array on the stack.
const MOST_CONTACTS: usize = 250;

/// Runs the command.
///
/// # Errors
/// If the spec is invalid, a file cannot be written, or `rustc` is missing.
pub fn run(call: &call::Library) -> Result<(), Failure> {
    let header = call.out.with_extension("h");
    let of_library = Destination::new("--out", &call.out, LIBRARY)?;
    let of_header = Destination::new("the header of --out", &header, &["h"])?;
    let of_source = Destination::of("--source", call.source.as_ref(), RUST)?;
    let files = || [&of_library, &of_header].into_iter().chain(&of_source);
    keep_document_apart(files(), call.spec.json)?;
    keep_apart(files(), &[(&call.spec.path, "the spec")])?;
    check_processor(call)?;
    let dag = Dag::new();
    let reading = Reading::open(&call.spec)?;
    let program = reading.compile_beside(&dag, files())?.program;
    if !program.contacts.is_empty() || program.sizes().guides > 0 {
        return Err(Failure::run(
            "whether a contact sticks or slides is not a function of q and v alone: a library of a machine with \
             `sliding` cannot be made; use a variant with a constraint in place of each guide, or run it with `lagrangian simulate`, the \
             crate, or a unit of `lagrangian fmu`, which C programs can call",
        ));
    }
    warn_of_constraints(&program);
    if program.unilateral.len() > MOST_CONTACTS {
        return Err(Failure::run(format!(
            "a library evaluates all contacts of a machine at once, and has at most {MOST_CONTACTS}; this machine has {}: run it with `lagrangian simulate` \
             or the crate, which evaluate those that are near",
            program.unilateral.len()
        )));
    }
    if !program.unilateral.is_empty() {
        output::print_error(
            "warning: whether contacts are closed is not a function of q and v alone: `eval` gives the accelerations with all of them open, and \
             its caller has to determine which of them are closed, and how they bounce, from `eval_contacts` and `eval_inertia`",
        );
    }
    let mut lanes = call.lanes.clone();
    lanes.sort_unstable();
    lanes.dedup();
    let is_in_pairs = is_in_pairs(&program);
    let source = source(&program, &lanes, call.straight, is_in_pairs)?;
    if let Some(file) = &of_source {
        file.write_text(&source)?;
    }
    progress::now("compiling the library");
    let library = compile(&source, is_in_pairs, call)?;
    of_library.write_executable(&library)?;
    let text = self::header(&program, &lanes, &file_name(&call.spec.path));
    of_header.write_text(&text)?;
    let Program {
        coordinates,
        parameters,
        inputs,
        ..
    } = &*program;
    if call.spec.json {
        let names = |slots: &[Slot]| -> Vec<String> {
            slots.iter().map(|slot| slot.name.to_string()).collect()
        };
        output::line(format_args!(
            "{:#}",
            json!({
                "library": call.out.to_string_lossy(),
                "header": header.to_string_lossy(),
                "coordinates": names(coordinates),
                "parameters": names(parameters),
                "inputs": names(inputs),
            })
        ));
    } else {
        output::line(format_args!(
            "{} and {}: {}, {}, {}",
            call.out.display(),
            header.display(),
            count(coordinates.len(), "coordinate"),
            count(parameters.len(), "parameter"),
            count(inputs.len(), "input"),
        ));
    }
    Ok(())
}

fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

fn file_name(path: &Path) -> String {
    path.file_name()
        .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

/// The exported functions, and the definitions that they need.
const EXPORT: &str = include_str!("library/export.rs");

/// The additional functions of machines with unilateral contacts.
const EXPORT_OF_CONTACTS: &str = include_str!("library/export_of_contacts.rs");

/// Up to this number of operations, eight states use two registers for each number where a register holds four: one computes while
/// the other waits for a result, which saves up to a quarter of the time of latency-bound programs. Longer programs gain a tenth,
/// and take rustc much longer (a chain of 32 links 14 s instead of 3, one of 128 links more than four minutes instead of 10 s).
const LONGEST_IN_PAIRS: usize = 1000;

/// The options with which the module of the machine is written.
fn options(is_straight: bool, is_in_pairs: bool) -> emit::rust::Options {
    let default = emit::rust::Options::default();
    emit::rust::Options {
        shortest_rolled: if is_straight {
            usize::MAX
        } else {
            // In the order of time little repeats except loads, and a loop of these would prevent checking all
            // conditions together at the end.
            LONGEST_SCHEDULED + 1
        },
        shortest_packed: if is_in_pairs {
            default.shortest_packed
        } else {
            usize::MAX
        },
        runtime: "crate".into(),
        // There is no debug information, and whole functions compile faster than pieces, which pass hundreds of values
        // through memory: a chain of 32 links takes half the time.
        longest_whole: 12_000,
        ..default
    }
}

/// Whether the accelerations of one state are computed in pairs. In lanes this gains nothing, because two limbs at once need
/// twice the registers.
fn is_in_pairs(program: &Proved) -> bool {
    let accelerations = program.function(Role::Accelerations);
    let is_long = |function| emit::rust::in_pairs(function, &options(false, true)).is_some();
    program.unilateral.is_empty() && accelerations.is_some_and(is_long)
}

/// The modules of a library: those of the crate of numbers that it needs, and the machine.
fn modules(machine: String) -> [(&'static str, String); 13] {
    // From the crate of numbers only the trait is used, which follows its list of modules; from the plain numbers `f64`,
    // which precedes `f32`, with the functions of the C library.
    let after = |text: &'static str, mark: &str| text.find(mark).map_or(text, |at| &text[at..]);
    let before = |text: &'static str, mark: &str| text.find(mark).map_or(text, |at| &text[..at]);
    let scalar = after(LIB, "use core::fmt::Debug;");
    let real = before(REAL, "scalar_by_libm!(\n    f32").replacen(
        "use crate::Scalar;",
        "use crate::{Scalar, libm};",
        1,
    );
    // Arrays of C are aligned as single numbers.
    let lanes_of_c = LANES.replacen("#[repr(C, align(16))]", "#[repr(C)]", 1);
    [
        (
            "scalar",
            format!("pub use crate::kernel::{{Kernel, Piece}};\nuse crate::series;\n{scalar}"),
        ),
        ("kernel", KERNEL.to_owned()),
        ("fast_function", FAST_FUNCTION.to_owned()),
        ("series", SERIES.to_owned()),
        ("real", real),
        ("lanes", lanes_of_c),
        ("plain", PLAIN.to_owned()),
        ("circular", CIRCULAR.to_owned()),
        ("register", REGISTER.to_owned()),
        ("sincos", SINCOS.to_owned()),
        ("vector", VECTOR.to_owned()),
        ("x86", X86.to_owned()),
        ("machine", machine),
    ]
}

/// The whole library as one file of Rust.
fn source(
    program: &Proved,
    lanes: &[u8],
    is_straight: bool,
    is_in_pairs: bool,
) -> Result<String, Failure> {
    let module = |is_in_pairs| {
        let options = options(is_straight, is_in_pairs);
        emit::rust::library(program, &options).map_err(Failure::run)
    };
    let machine = module(false)?;
    let mut source = String::from(
        "#![allow(dead_code, unused_imports, unused_macros)]\n\
         #![allow(clippy::all)]\n",
    );
    let alone = if is_in_pairs {
        format!("mod alone {{\n{}}}\n\n", module(true)?)
    } else {
        "use machine as alone;\n\n".to_owned()
    };
    for (name, text) in modules(machine) {
        let condition = match name {
            "x86" => "#[cfg(target_arch = \"x86_64\")]\n",
            _ => "",
        };
        let _ = writeln!(source, "{condition}mod {name} {{\n{text}}}\n"); // writing to a String cannot fail
    }
    source.push_str(&alone);
    source.push_str(EXPORT);
    if !program.unilateral.is_empty() {
        source.push_str(EXPORT_OF_CONTACTS);
        let _ = writeln!(
            source,
            "\nconst CONSTRAINTS: usize = {};",
            program.constraints.len()
        ); // cannot fail
        // A machine without constraints has no constraint rows.
        source.push_str(if program.constraints.is_empty() {
            "use no_rows as constraint_rows;\n"
        } else {
            "use machine::constraint_matrix_of as constraint_rows;\n"
        });
    }
    let operations = program
        .function(Role::Accelerations)
        .map_or(0, |function| function.code.len());
    let several = lanes.iter().map(|n| match n {
        8 if operations > LONGEST_IN_PAIRS => "eval8: 8 by IN_A_REGISTER;".to_owned(),
        n => format!("eval{n}: {n} by {n};"),
    });
    let several = several.collect::<Vec<_>>().join(" ");
    let _ = writeln!(source, "\nseveral! {{ {several} }}");
    Ok(source)
}

/// `rustc`, or the compiler that `RUSTC` names.
fn rustc() -> OsString {
    std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into())
}

fn missing(error: io::Error) -> Failure {
    Failure::run(format!("cannot run {}: {error}", rustc().to_string_lossy()))
}

/// Refuses a processor that the compiler does not know: rustc would only warn, and compile for another.
fn check_processor(call: &call::Library) -> Result<(), Failure> {
    let processor = call.target_cpu.as_str();
    if processor == "native" {
        return Ok(());
    }
    let mut words = Command::new(rustc());
    let output = words.args(["--print", "target-cpus"]).output();
    let list = String::from_utf8_lossy(&output.map_err(missing)?.stdout).into_owned();
    // After a title, one processor per line, some followed by remarks.
    let lines = list.lines().skip(1);
    let known: Vec<&str> = lines
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    // If the compiler lists none, the name is not checked.
    if known.is_empty() || known.contains(&processor) {
        return Ok(());
    }
    let help = match most_similar(processor, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`? "),
        None => String::new(),
    };
    Err(Failure::Call(format!(
        "--target-cpu {processor}: rustc knows no processor with this name; {help}`rustc --print target-cpus` lists all, such as {}",
        examples(&known).join(", ")
    )))
}

/// A few representative processors: levels of an architecture if there are any, otherwise the first ones.
fn examples<'a>(known: &[&'a str]) -> Vec<&'a str> {
    let levels = known
        .iter()
        .copied()
        .filter(|name| name.starts_with("x86-64"));
    let levels: Vec<&str> = std::iter::once("native")
        .filter(|processor| known.contains(processor))
        .chain(levels)
        .collect();
    match levels.len() {
        0 | 1 => known.iter().copied().take(5).collect(),
        _ => levels,
    }
}

/// Calls the compiler; returns the bytes of the library.
fn compile(source: &str, is_in_pairs: bool, call: &call::Library) -> Result<Vec<u8>, Failure> {
    let unkept =
        |error: io::Error| Failure::run(format!("cannot store the library temporarily: {error}"));
    let folder = tempfile::tempdir().map_err(unkept)?;
    // Compiled under its final name, because some systems store that name in it.
    let library = folder.path().join(file_name(&call.out));
    let mut words = Command::new(rustc());
    words.args([
        "--edition=2024",
        "--crate-type=cdylib",
        "--crate-name=machine",
    ]);
    words.args(["--cfg", "feature=\"std\"", "--cap-lints=allow"]);
    // A single codegen unit, because there is only one essential function for each arithmetic.
    for option in [
        "opt-level=3",
        "codegen-units=1",
        "panic=abort",
        "debuginfo=0",
        "strip=symbols",
    ] {
        words.args(["-C", option]);
    }
    if is_in_pairs {
        // Pairs follow from the structure of the machine; a compiler that looks for its own pairs would split some of them.
        words.args(["-C", "no-vectorize-slp"]);
    }
    words.arg(format!("-Ctarget-cpu={}", call.target_cpu));
    words.arg("-o").arg(&library).arg("-");
    words
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    let mut child = words.spawn().map_err(missing)?;
    if let Some(mut input) = child.stdin.take() {
        // A compiler that stops reading prints the reason.
        let _ = input.write_all(source.as_bytes());
    }
    let output = child.wait_with_output().map_err(missing)?;
    if output.status.success() {
        return std::fs::read(&library).map_err(unkept);
    }
    let stderr = String::from_utf8_lossy(&output.stderr);
    Err(Failure::run(format!(
        "rustc failed to compile the library:\n{}",
        stderr.trim_end()
    )))
}

/// The prototype of the function for several states at once.
fn prototype_of_several(n: u8) -> String {
    format!(
        "/* The same of {n} states. Component i of state k is at `y[{n}*i + k]`, and so for the accelerations; `t[k]` \
         is its\n * time. Inputs are common to all. A state at which the mass matrix is singular does not affect the \
         others. */\n\
         void eval{n}(const double *y, const double *t, const double *p, double *qdd);\n\n"
    )
}

/// The header for C.
fn header(program: &Program, lanes: &[u8], spec: &str) -> String {
    let Program {
        name,
        coordinates,
        parameters,
        inputs,
        constraints,
        unilateral,
        ..
    } = program;
    let guard = format!(
        "LAGRANGIAN_{}_H",
        emit::rust::module_name(name).to_uppercase()
    );
    let guard = word(&guard, |c| c.is_ascii_alphanumeric());
    let list = |slots: &[Slot]| {
        let mut lines = String::new();
        for (i, slot) in slots.iter().enumerate() {
            let _ = write!(lines, "\n *   [{i}] {} in {}", slot.name, slot.unit_text); // cannot fail
            if let Some(default) = &slot.default {
                let _ = write!(lines, " = {:?}", default.value);
            }
        }
        lines
    };
    let several: String = lanes.iter().map(|n| prototype_of_several(*n)).collect();
    let mut interface = INTERFACE.replacen("LANES\n", &several, 1);
    let mut counts = String::new();
    if !unilateral.is_empty() {
        interface.push('\n');
        interface.push_str(INTERFACE_OF_CONTACTS);
        let _ = write!(
            counts,
            ", CONTACTS = {}, CONSTRAINTS = {}",
            unilateral.len(),
            constraints.len()
        ); // cannot fail
    }
    let of_contacts = if unilateral.is_empty() {
        String::new()
    } else {
        let names = unilateral.iter().enumerate();
        let names: String = names
            .map(|(i, contact)| format!("\n *   [{i}] {}", contact.name))
            .collect();
        format!("\n *\n * Contacts:{names}")
    };
    let (n, p, u) = (coordinates.len(), parameters.len(), inputs.len());
    let of_inputs = match u {
        0 => String::new(),
        _ => format!("\n *\n * Inputs, after the parameters:{}", list(inputs)),
    };
    format!(
        "/* The machine {name}: its accelerations. Made from {spec} by `lagrangian library`.\n \
         *\n \
         * Numbers are in the units listed, rates and accelerations in these per s and s^2. Coordinates:{}\n \
         *\n \
         * Parameters:{}{of_inputs}{of_contacts}\n \
         */\n\
         #ifndef {guard}\n#define {guard}\n\n\
         #ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n\
         enum {{ COORDINATES = {n}, PARAMETERS = {p}, INPUTS = {u}{counts} }};\n\n\
         {interface}\n\
         #ifdef __cplusplus\n}}\n#endif\n\n#endif\n",
        list(coordinates),
        list(parameters),
    )
}

/// The interface of every library.
const INTERFACE: &str = include_str!("library/interface.h");

/// The additional interface for machines with unilateral contacts.
const INTERFACE_OF_CONTACTS: &str = include_str!("library/interface_of_contacts.h");
