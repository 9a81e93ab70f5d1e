//! The C compiler, and the platforms that a unit may have binaries for.

use std::env::consts::{ARCH, OS};
use std::io;
use std::process::{Command, Stdio};

use super::{Unit, Version};
use crate::failure::Failure;

/// Where a library is for.
pub struct Platform {
    /// The folder in `binaries/`.
    pub folder: &'static str,
    /// What its libraries end with.
    pub ending: &'static str,
}

/// The platform that the command itself runs on.
fn own(version: Version) -> Option<Platform> {
    let (three, two, ending) = match (OS, ARCH) {
        ("linux", "x86_64") => ("x86_64-linux", "linux64", "so"),
        ("linux", "aarch64") => ("aarch64-linux", "aarch64-linux", "so"),
        ("macos", "x86_64") => ("x86_64-darwin", "darwin64", "dylib"),
        ("macos", "aarch64") => ("aarch64-darwin", "darwin64", "dylib"),
        ("windows", "x86_64") => ("x86_64-windows", "win64", "dll"),
        _ => return None,
    };
    let folder = match version {
        Version::Three => three,
        Version::Two => two,
    };
    Some(Platform { folder, ending })
}

/// Compiles the unit for this platform; the bytes of the library.
///
/// # Errors
/// If there is no compiler, or it does not compile the unit.
pub fn library(
    unit: &Unit<'_>,
    sources: &[(&'static str, String)],
    named: Option<&str>,
) -> Result<(Platform, Vec<u8>), Failure> {
    let platform = own(unit.version).ok_or_else(|| {
        Failure::run(format!(
            "units have no folder for {ARCH} on {OS}: --sources-only makes one without a library"
        ))
    })?;
    let compiler = match named {
        Some(named) => named.to_owned(),
        None => std::env::var("CC").unwrap_or_else(|_| "cc".into()),
    };
    let mut words = compiler.split_whitespace();
    let program = words
        .next()
        .ok_or_else(|| Failure::Call("--cc names no compiler".into()))?;
    let unkept =
        |error: io::Error| Failure::run(format!("cannot keep the unit for a while: {error}"));
    let folder = tempfile::tempdir().map_err(unkept)?;
    for (name, text) in sources {
        std::fs::write(folder.path().join(name), text).map_err(unkept)?;
    }
    let library = format!("{}.{}", unit.identifier, platform.ending);
    let mut command = Command::new(program);
    command.args(words);
    // Paths are relative, so that no name of the folder is in the library.
    command.current_dir(folder.path());
    command.args(["-std=c99", "-O2", "-fPIC", "-shared", "-s"]);
    command.args(["-ffp-contract=off", "-fvisibility=hidden", "-w"]);
    command.args(["-o", &library, unit.version.source(), "-lm"]);
    command.stdin(Stdio::null()).stdout(Stdio::null());
    let output = command.output().map_err(|error| {
        Failure::run(format!(
            "cannot run the C compiler {program}: {error}; --cc names another, --sources-only makes a unit without a library"
        ))
    })?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        return Err(Failure::run(format!(
            "{compiler} does not compile the unit:\n{}",
            said.trim_end()
        )));
    }
    let bytes = std::fs::read(folder.path().join(&library)).map_err(unkept)?;
    Ok((platform, bytes))
}
