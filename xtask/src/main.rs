//! Tasks for developers of the project.
//!
//! `cargo xtask generate` compiles the machine library into `generated/`; `cargo xtask generate --check` fails if the committed
//! files differ. `cargo xtask api` writes the public interface of the library into `docs/api/`.

use std::path::Path;
use std::process::ExitCode;

use xtask::{Generated, generate};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .unwrap_or(Path::new("."));
    let done = match arguments.as_slice() {
        ["generate"] => generate(root).and_then(|files| write(root, &files)),
        ["generate", "--check"] => generate(root).and_then(|files| check(root, &files)),
        ["api"] => xtask::api::write(root),
        _ => {
            eprintln!("usage: cargo xtask generate [--check] | api");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(message) => {
            println!("{message}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

fn write(root: &Path, files: &[Generated]) -> Result<String, String> {
    let stale = xtask::stale(root, files)?;
    for path in &stale {
        let absolute = root.join(path);
        let written = match files.iter().find(|file| file.path == *path) {
            Some(file) => std::fs::write(&absolute, &file.text),
            None => std::fs::remove_file(&absolute),
        };
        written.map_err(|error| format!("{}: {error}", absolute.display()))?;
    }
    Ok(format!(
        "{} files, {} of them changed",
        files.len(),
        stale.len()
    ))
}

fn check(root: &Path, files: &[Generated]) -> Result<String, String> {
    let stale = xtask::stale(root, files)?;
    if stale.is_empty() {
        return Ok(format!("{} files, all up to date", files.len()));
    }
    let list: Vec<String> = stale
        .iter()
        .map(|path| format!("  {}", path.display()))
        .collect();
    Err(format!(
        "these files differ from what `cargo xtask generate` writes:\n{}",
        list.join("\n")
    ))
}
