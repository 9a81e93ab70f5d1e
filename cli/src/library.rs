//! `lagrangian library`: a machine as a shared library for C, and whatever can call it.
//!
//! One file is compiled, by one call of `rustc` and without dependencies: the module of the machine, the exports
//! (`library/export.rs`), and the parts of the crates `lagrangian-scalar` and `lagrangian-native` that it needs, as text.

use std::fmt::Write as _;
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};

use lagrangian_spec::emit;
use lagrangian_spec::program::{LONGEST_SCHEDULED, Program, Slot};
use serde_json::json;

use crate::call;
use crate::failure::Failure;
use crate::output;
use crate::reading;

/// Runs the command.
///
/// # Errors
/// If the spec is wrong, a file cannot be written, or `rustc` is missing.
pub fn run(call: &call::Library) -> Result<(), Failure> {
    let program = reading::program(&call.spec)?;
    if !program.contacts.is_empty() {
        return Err(Failure::run(
            "what sticks and slides has a state that a function of q and v alone does not know: a library of a machine with \
             `sliding` cannot be made",
        ));
    }
    let mut lanes = call.lanes.clone();
    lanes.sort_unstable();
    lanes.dedup();
    let source = source(&program, &lanes, call.straight);
    if let Some(path) = &call.source {
        write(path, &source)?;
    }
    let header = call.out.with_extension("h");
    write(
        &header,
        &self::header(&program, &lanes, &file_name(&call.spec.path)),
    )?;
    compile(&source, call)?;
    let Program {
        coordinates,
        parameters,
        inputs,
        ..
    } = &program;
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

fn count(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

fn file_name(path: &Path) -> String {
    path.file_name()
        .map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}

fn write(path: &Path, text: &str) -> Result<(), Failure> {
    std::fs::write(path, text)
        .map_err(|error| Failure::Call(format!("cannot write {}: {error}", path.display())))
}

/// The exports, and what stands beside them.
const EXPORT: &str = include_str!("library/export.rs");
const SCALAR: &str = include_str!("../../scalar/src/lib.rs");
const KERNEL: &str = include_str!("../../scalar/src/kernel.rs");
const REAL: &str = include_str!("../../scalar/src/real.rs");
const LANES: &str = include_str!("../../native/src/lanes.rs");
const REGISTER: &str = include_str!("../../native/src/register.rs");
const SINCOS: &str = include_str!("../../native/src/sincos.rs");
const VECTOR: &str = include_str!("../../native/src/vector.rs");
const X86: &str = include_str!("../../native/src/x86.rs");

/// The whole library as one file of Rust.
fn source(program: &Program, lanes: &[u8], is_straight: bool) -> String {
    let options = emit::rust::Options {
        shortest_rolled: match is_straight {
            true => usize::MAX,
            // What is in the order of time repeats little but its reads, and a loop of these would keep all from being
            // checked at once, at the end.
            false => LONGEST_SCHEDULED + 1,
        },
        runtime: "crate".into(),
        // Nothing is described to a debugger here, and whole functions compile faster than pieces, which pass hundreds of
        // values through memory: a chain of 32 links in half the time.
        longest_whole: 12_000,
        ..Default::default()
    };
    let machine = emit::rust::library(program, &options);
    // Of the crate of numbers the trait, behind its list of modules; of the plain numbers `f64`, before `f32`, and with the
    // functions of the C library.
    let after = |text: &'static str, mark: &str| text.find(mark).map_or(text, |at| &text[at..]);
    let before = |text: &'static str, mark: &str| text.find(mark).map_or(text, |at| &text[..at]);
    let scalar = after(SCALAR, "use core::fmt::Debug;");
    let real = before(REAL, "scalar_by_libm!(\n    f32").replacen(
        "use crate::Scalar;",
        "use crate::{Scalar, libm};",
        1,
    );
    // In C, numbers side by side are aligned as numbers.
    let lanes_of_c = LANES.replacen("#[repr(C, align(16))]", "#[repr(C)]", 1);
    let mut source = String::from(
        "#![allow(dead_code, unused_imports, unused_macros)]\n\
         #![allow(clippy::all)]\n",
    );
    let modules = [
        (
            "scalar",
            format!("pub use crate::kernel::{{Kernel, Piece}};\n{scalar}"),
        ),
        ("kernel", KERNEL.to_owned()),
        ("real", real),
        ("lanes", lanes_of_c),
        ("register", REGISTER.to_owned()),
        ("sincos", SINCOS.to_owned()),
        ("vector", VECTOR.to_owned()),
        ("x86", X86.to_owned()),
        ("machine", machine),
    ];
    for (name, text) in modules {
        let condition = match name {
            "x86" => "#[cfg(target_arch = \"x86_64\")]\n",
            _ => "",
        };
        let _ = writeln!(source, "{condition}mod {name} {{\n{text}}}\n"); // writing to a String cannot fail
    }
    source.push_str(EXPORT);
    let several = lanes.iter().map(|n| format!("eval{n}: {n};"));
    let several = several.collect::<Vec<_>>().join(" ");
    let _ = writeln!(source, "\nseveral! {{ {several} }}");
    source
}

/// Calls `rustc`, or what `RUSTC` names.
fn compile(source: &str, call: &call::Library) -> Result<(), Failure> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let mut words = Command::new(&rustc);
    words.args([
        "--edition=2024",
        "--crate-type=cdylib",
        "--crate-name=machine",
    ]);
    words.args(["--cfg", "feature=\"std\"", "--cap-lints=allow"]);
    // One unit: there is one function to speak of in each arithmetic.
    for option in [
        "opt-level=3",
        "codegen-units=1",
        "panic=abort",
        "debuginfo=0",
        "strip=symbols",
    ] {
        words.args(["-C", option]);
    }
    words.arg(format!("-Ctarget-cpu={}", call.target_cpu));
    words.arg("-o").arg(&call.out).arg("-");
    words
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::piped());
    let missing = |error: std::io::Error| {
        Failure::run(format!("cannot run {}: {error}", rustc.to_string_lossy()))
    };
    let mut child = words.spawn().map_err(missing)?;
    if let Some(mut input) = child.stdin.take() {
        // One that stops reading says why.
        let _ = input.write_all(source.as_bytes());
    }
    let output = child.wait_with_output().map_err(missing)?;
    if output.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    Err(Failure::run(format!(
        "rustc does not compile the library:\n{}",
        said.trim_end()
    )))
}

/// The header for C.
fn header(program: &Program, lanes: &[u8], spec: &str) -> String {
    let Program {
        name,
        coordinates,
        parameters,
        inputs,
        ..
    } = program;
    let guard = format!(
        "LAGRANGIAN_{}_H",
        emit::rust::module_name(name).to_uppercase()
    );
    let guard: String = guard
        .chars()
        .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
        .collect();
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
    let several: String = lanes
        .iter()
        .map(|n| {
            format!(
                "/* The same of {n} states. Component i of state k stands at `y[{n}*i + k]`, and so do the accelerations; `t[k]` \
                 is its\n * time. Inputs are common to all. A state at which the mass matrix is singular leaves the others \
                 alone. */\n\
                 void eval{n}(const double *y, const double *t, const double *p, double *qdd);\n\n"
            )
        })
        .collect();
    let interface = INTERFACE.replacen("LANES\n", &several, 1);
    let (n, p, u) = (coordinates.len(), parameters.len(), inputs.len());
    let of_inputs = match u {
        0 => String::new(),
        _ => format!("\n *\n * Inputs, behind the parameters:{}", list(inputs)),
    };
    format!(
        "/* The machine {name}: its accelerations. Made from {spec} by `lagrangian library`.\n \
         *\n \
         * SI units, angles in radians. Coordinates:{}\n \
         *\n \
         * Parameters:{}{of_inputs}\n \
         */\n\
         #ifndef {guard}\n#define {guard}\n\n\
         #ifdef __cplusplus\nextern \"C\" {{\n#endif\n\n\
         enum {{ COORDINATES = {n}, PARAMETERS = {p}, INPUTS = {u} }};\n\n\
         {interface}\n\
         #ifdef __cplusplus\n}}\n#endif\n\n#endif\n",
        list(coordinates),
        list(parameters),
    )
}

/// What every library exports.
const INTERFACE: &str = include_str!("library/interface.h");
