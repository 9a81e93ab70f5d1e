//! Units of machines whose motion depends on more than their state: which contacts are closed, and what sticks.
//!
//! Such a unit contains a run of the runtime, the same as in every other use of the project. `rustc` compiles the runtime, whose text the command
//! contains, the module of the machine, and the functions between this and the C part (`run/unit.rs`), to a static library.

use std::ffi::OsString;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use lagrangian::System;
use lagrangian_emit as emit;
use lagrangian_mechanics::Compiled;
use lagrangian_program::Program;

use super::{Unit, tables};
use crate::call::UnitMethod;
use crate::failure::Failure;

/// The quantities of each contact, in the order in which a run writes them.
pub const OF_CONTACTS: [&str; 4] = ["gap", "normal", "friction", "slip"];

/// The names of the contacts of a run: the unilateral ones with the guides beside them, or those of `sliding`.
pub fn contacts(system: &impl System) -> Vec<String> {
    let guided = system.contacts().map(str::to_owned);
    let unilateral = system.unilateral_contacts();
    guided
        .chain(unilateral.map(|contact| contact.name.to_owned()))
        .collect()
}

/// Whether a machine moves only by a run.
pub fn is_needed(program: &Program) -> bool {
    !program.contacts.is_empty() || !program.unilateral.is_empty()
}

/// A crate that a unit is compiled from.
struct Part {
    name: &'static str,
    files: &'static [(&'static str, &'static str)],
    /// The crates that it depends on.
    on: &'static [&'static str],
    has_std: bool,
}

/// The crates, each after those that it depends on.
const PARTS: [Part; 5] = [
    Part {
        name: "libm",
        files: &[("lib.rs", include_str!("run/libm.rs"))],
        on: &[],
        has_std: false,
    },
    Part {
        name: "strsim",
        files: &[("lib.rs", include_str!("run/strsim.rs"))],
        on: &[],
        has_std: false,
    },
    Part {
        name: "lagrangian_scalar",
        files: lagrangian::scalar::files::FILES,
        on: &["libm"],
        has_std: false,
    },
    Part {
        name: "lagrangian_native",
        files: lagrangian::native::files::FILES,
        on: &["lagrangian_scalar"],
        has_std: true,
    },
    Part {
        name: "lagrangian",
        files: lagrangian::files::FILES,
        on: &["lagrangian_scalar", "lagrangian_native", "strsim"],
        has_std: true,
    },
];

/// The text of the crate of a unit.
pub fn text(compiled: &Compiled<'_>, method: UnitMethod, contacts: usize) -> String {
    let program = &compiled.program;
    let options = emit::rust::Options {
        // There is no debug information.
        longest_whole: 12_000,
        ..emit::rust::Options::default()
    };
    let module = emit::rust::module(program, &options);
    let names = emit::rust::names_of_module(program);
    let method = match method {
        UnitMethod::Dop853 => "DOP853",
        UnitMethod::Dopri5 => "DOPRI5",
    };
    let mut text = String::from(include_str!("run/unit.rs"));
    let _ = write!(
        text,
        "\nmod machine {{\n{module}}}\n\n\
         type Described = machine::{}<f64>;\n\n\
         const METHOD: &Method = Method::{method};\n\
         const STATES: usize = {};\n\
         const PARAMETERS: usize = {};\n\
         const INPUTS: usize = {};\n\
         const CONSTRAINTS: usize = {};\n\
         const CONTACTS: usize = {contacts};\n\n\
         #[allow(unused_variables)]\n\
         fn of_parameters(p: &[f64]) -> Described {{\n    machine::{}\n}}\n\n\
         #[allow(unused_variables)]\n\
         fn of_inputs(u: &[f64]) -> Inputs<Described> {{\n    machine::{}\n}}\n",
        names.machine,
        2 * program.coordinates.len(),
        program.parameters.len(),
        program.inputs.len(),
        program.constraints.len(),
        names.of_parameters.trim(),
        names.of_inputs.trim(),
    ); // writing to a String cannot fail
    text
}

/// The name of the static library.
pub const LIBRARY: &str = "libunit_run.a";

/// Compiles the crate of a unit in a folder, to [`LIBRARY`]; returns the libraries of the system to link it with.
///
/// # Errors
/// If there is no `rustc`, or it fails.
pub fn compile(text: &str, folder: &Path) -> Result<Vec<String>, Failure> {
    let runtime = runtime(folder)?;
    write(&folder.join("unit_run.rs"), text)?;
    let arguments = [
        "--crate-type=staticlib",
        "--print=native-static-libs",
        "-o",
        LIBRARY,
    ];
    let arguments = arguments.map(str::to_owned);
    let crate_of_unit = ("unit_run", "unit_run.rs");
    let said = rustc(folder, &runtime, crate_of_unit, &arguments, &["lagrangian"])?;
    let mut lines = said.lines();
    let libraries = lines.find_map(|line| line.split_once("native-static-libs: "));
    let words = libraries.map_or("", |(_, words)| words).split_whitespace();
    Ok(words.map(str::to_owned).collect())
}

/// The folder of the compiled runtime: within `folder`, or where `LAGRANGIAN_CACHE` keeps it for every unit that this command and this compiler make.
fn runtime(folder: &Path) -> Result<PathBuf, Failure> {
    let Some(cache) = std::env::var_os("LAGRANGIAN_CACHE").filter(|cache| !cache.is_empty()) else {
        compile_runtime(folder)?;
        return Ok(folder.to_owned());
    };
    let compiler = answer(Command::new(compiler()).arg("-vV"))?;
    let files = PARTS.iter().flat_map(|part| part.files);
    let texts = files.flat_map(|(name, text)| [*name, *text]);
    let texts: Vec<&str> = texts.chain([compiler.as_str()]).collect();
    let name = tables::token(&texts).replace(['{', '}'], "");
    let cache = std::path::absolute(cache).map_err(unkept)?;
    let kept = cache.join(format!("lagrangian-{name}"));
    if !kept.is_dir() {
        // Compiled beside it and renamed, so that it is complete wherever it is; another command may have been faster.
        std::fs::create_dir_all(&cache).map_err(unkept)?;
        let new = tempfile::tempdir_in(&cache).map_err(unkept)?;
        compile_runtime(new.path())?;
        if let Err(error) = std::fs::rename(new.path(), &kept)
            && !kept.is_dir()
        {
            return Err(unkept(error));
        }
    }
    Ok(kept)
}

/// Compiles the crates that a unit depends on.
fn compile_runtime(folder: &Path) -> Result<(), Failure> {
    for part in &PARTS {
        for (name, text) in part.files {
            write(&folder.join(part.name).join(name), text)?;
        }
        let root = format!("{}/lib.rs", part.name);
        let mut arguments = vec!["--crate-type=rlib".to_owned()];
        if part.has_std {
            arguments.extend(["--cfg", "feature=\"std\""].map(str::to_owned));
        }
        rustc(
            folder,
            Path::new("."),
            (part.name, &root),
            &arguments,
            part.on,
        )?;
    }
    Ok(())
}

fn unkept(error: std::io::Error) -> Failure {
    Failure::run(format!("cannot store the unit temporarily: {error}"))
}

fn write(file: &Path, text: &str) -> Result<(), Failure> {
    let folder = file.parent().unwrap_or(file);
    std::fs::create_dir_all(folder)
        .and_then(|()| std::fs::write(file, text))
        .map_err(unkept)
}

/// `rustc`, or the compiler that `RUSTC` names.
fn compiler() -> OsString {
    std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into())
}

/// Calls the compiler for a crate; returns what it says. Paths are relative, so that the library does not contain the name of the folder.
fn rustc(
    folder: &Path,
    runtime: &Path,
    (name, root): (&str, &str),
    arguments: &[String],
    on: &[&str],
) -> Result<String, Failure> {
    let mut command = Command::new(compiler());
    command.current_dir(folder);
    command.args(["--edition=2024", "--cap-lints=allow", "--crate-name", name]);
    command
        .args(["-C", "opt-level=2", "-C", "debuginfo=0", "-L"])
        .arg(runtime);
    for crate_name in on {
        let mut place = OsString::from(format!("{crate_name}="));
        place.push(runtime.join(format!("lib{crate_name}.rlib")));
        command.arg("--extern").arg(place);
    }
    command.args(arguments).arg(root);
    answer(&mut command)
}

/// Calls the compiler; returns what it prints and says.
fn answer(command: &mut Command) -> Result<String, Failure> {
    command.stdin(Stdio::null());
    let output = command.output().map_err(|error| {
        Failure::run(format!(
            "cannot run {}: {error}; the run of a unit with `contacts` or `sliding` is compiled by rustc, which the variable RUSTC may name",
            compiler().to_string_lossy()
        ))
    })?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let said = text(&output.stdout) + &text(&output.stderr);
    if output.status.success() {
        return Ok(said);
    }
    Err(Failure::run(format!(
        "rustc failed to compile the unit:\n{}",
        said.trim_end()
    )))
}

impl Unit<'_> {
    /// Whether its motion is that of a run in it.
    pub fn has_run(&self) -> bool {
        self.run.is_some()
    }
}
