//! Calls the C compiler, for the platforms of a unit.

use std::env::consts::{ARCH, OS};
use std::io;
use std::process::{Command, Stdio};

use super::{Unit, Version, run};
use crate::failure::Failure;

/// The platform of a library.
pub struct Platform {
    /// The folder in `binaries/`.
    pub folder: &'static str,
    /// The file extension of its libraries.
    pub ending: &'static str,
}

/// The platforms of both versions: processor and system as named in a target triple, and the folders.
const PLATFORMS: [(&str, &[&str], [&str; 2], &str); 5] = [
    ("x86_64", &["linux"], ["linux64", "x86_64-linux"], "so"),
    (
        "aarch64",
        &["linux"],
        ["aarch64-linux", "aarch64-linux"],
        "so",
    ),
    (
        "x86_64",
        &["macos", "darwin"],
        ["darwin64", "x86_64-darwin"],
        "dylib",
    ),
    (
        "aarch64",
        &["macos", "darwin"],
        ["darwin64", "aarch64-darwin"],
        "dylib",
    ),
    (
        "x86_64",
        &["windows", "mingw32"],
        ["win64", "x86_64-windows"],
        "dll",
    ),
];

/// The platform of a triple such as `x86_64-linux-gnu`, or by default that of the command itself.
fn platform(version: Version, triple: &str) -> Option<Platform> {
    let mut words = triple.split('-');
    let arch = words.next().map(|arch| match arch {
        "arm64" => "aarch64",
        "amd64" => "x86_64",
        arch => arch,
    });
    let systems: Vec<&str> = words.collect();
    let is_of = |names: &[&str]| {
        let mut words = systems.iter();
        words.any(|word| names.iter().any(|name| word.starts_with(name)))
    };
    let row = PLATFORMS
        .iter()
        .find(|(of, names, ..)| arch == Some(of) && is_of(names));
    row.map(|(_, _, [two, three], ending)| Platform {
        folder: match version {
            Version::Three => three,
            Version::Two => two,
        },
        ending,
    })
}

/// Compiles the unit for each target, or for this platform if there are none; returns the bytes of the libraries.
///
/// # Errors
/// If there is no compiler, it fails to compile the unit, or the standard defines no folder for a target.
pub fn libraries(
    unit: &Unit<'_>,
    sources: &[(&'static str, String)],
    named: Option<&str>,
    targets: &[String],
) -> Result<Vec<(Platform, Vec<u8>)>, Failure> {
    if targets.is_empty() {
        let platform = platform(unit.version, &format!("{ARCH}-{OS}")).ok_or_else(|| {
            Failure::run(format!(
                "a unit has no folder for {ARCH} on {OS}: --sources-only builds one without a library"
            ))
        })?;
        return Ok(vec![library(unit, sources, named, None, platform)?]);
    }
    let mut libraries: Vec<(Platform, Vec<u8>)> = Vec::new();
    for target in targets {
        let platform = platform(unit.version, target).ok_or_else(|| {
            Failure::Call(format!(
                "--target {target}: a unit has folders for x86_64 and aarch64 on Linux and macOS and for x86_64 on Windows, as in \
                 x86_64-linux-gnu"
            ))
        })?;
        if libraries
            .iter()
            .any(|(other, _)| other.folder == platform.folder)
        {
            return Err(Failure::Call(format!(
                "--target {target}: there is already a library in binaries/{}",
                platform.folder
            )));
        }
        libraries.push(library(unit, sources, named, Some(target), platform)?);
    }
    Ok(libraries)
}

/// Compiles the unit for a platform.
fn library(
    unit: &Unit<'_>,
    sources: &[(&'static str, String)],
    named: Option<&str>,
    target: Option<&str>,
    platform: Platform,
) -> Result<(Platform, Vec<u8>), Failure> {
    let compiler = match named {
        Some(named) => named.to_owned(),
        None => std::env::var("CC").unwrap_or_else(|_| "cc".into()),
    };
    // Either a separate compiler for each target, or one that takes the target as an option.
    let option = target.map(|target| format!("--target={target}"));
    let is_named = compiler.contains("{}");
    let compiler = compiler.replace("{}", target.unwrap_or_default());
    let mut words = compiler.split_whitespace();
    let program = words
        .next()
        .ok_or_else(|| Failure::Call("--cc names no compiler".into()))?;
    let unkept =
        |error: io::Error| Failure::run(format!("cannot store the unit temporarily: {error}"));
    let folder = tempfile::tempdir().map_err(unkept)?;
    for (name, text) in sources {
        std::fs::write(folder.path().join(name), text).map_err(unkept)?;
    }
    let further = match &unit.run {
        Some(run) => run::compile(&run.text, folder.path())?,
        None => Vec::new(),
    };
    let library = format!("{}.{}", unit.identifier, platform.ending);
    let mut command = Command::new(program);
    command.args(words);
    command.args(option.filter(|_| !is_named));
    // Paths are relative, so that the library does not contain the name of the folder.
    command.current_dir(folder.path());
    command.args(["-std=c99", "-O2", "-fPIC", "-shared", "-s"]);
    command.args(["-ffp-contract=off", "-fvisibility=hidden", "-w"]);
    command.args(["-o", &library, unit.version.source()]);
    if unit.has_run() {
        // Nothing of the run is seen from outside, and only what is called stays.
        command.arg(run::LIBRARY).args(match OS {
            "macos" => &["-Wl,-dead_strip"][..],
            _ => &["-Wl,--exclude-libs,ALL", "-Wl,--gc-sections"],
        });
        command.args(further);
    }
    command.arg("-lm");
    command.stdin(Stdio::null()).stdout(Stdio::null());
    let output = command.output().map_err(|error| {
        Failure::run(format!(
            "cannot run the C compiler {program}: {error}; --cc names another one, --sources-only builds a unit without a library"
        ))
    })?;
    if !output.status.success() {
        let stderr = String::from_utf8_lossy(&output.stderr);
        return Err(Failure::run(format!(
            "{compiler} failed to compile the unit:\n{}",
            stderr.trim_end()
        )));
    }
    let bytes = std::fs::read(folder.path().join(&library)).map_err(unkept)?;
    Ok((platform, bytes))
}
