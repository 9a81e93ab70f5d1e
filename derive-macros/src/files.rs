//! Files that the macro reads: the spec, and what it extends. Cargo must track them, so that an edit triggers recompilation.

use std::env;
use std::path::{Path, PathBuf};

use lagrangian_spec::source::{Disk, Files};

/// Files on disk, with a list of those that were read.
#[derive(Default)]
pub struct Tracked {
    /// Absolute paths, without duplicates.
    pub read: Vec<PathBuf>,
}

impl Files for Tracked {
    fn read(&mut self, path: &str, from: Option<&str>) -> Result<(String, String), String> {
        let (name, text) = Disk.read(path, from)?;
        if let Ok(path) = Path::new(&name).canonicalize()
            && !self.read.contains(&path)
        {
            self.read.push(path);
        }
        Ok((name, text))
    }
}

/// Where `machine!(file = "…")` looks: beside the package's manifest, then beside the source file that invokes the macro.
///
/// Returns the first file that exists, or a message that names both.
pub fn find(file: &str, invoking: Option<&Path>) -> Result<PathBuf, String> {
    let manifest = env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from);
    let beside = invoking.and_then(Path::parent).map(absolute);
    let mut tried: Vec<PathBuf> = Vec::new();
    for folder in manifest.into_iter().chain(beside) {
        let path = folder.join(file);
        if path.is_file() {
            return Ok(shown(&path));
        }
        if !tried.contains(&path) {
            tried.push(path);
        }
    }
    let tried: Vec<String> = tried
        .iter()
        .map(|path| format!("`{}`", path.display()))
        .collect();
    Err(format!(
        "there is no file `{file}`; looked for {}",
        tried.join(" and ")
    ))
}

fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}

/// A path as the compiler shows it: relative to its working directory.
fn shown(path: &Path) -> PathBuf {
    let inside = env::current_dir()
        .ok()
        .and_then(|here| path.strip_prefix(here).ok().map(Path::to_owned));
    inside.unwrap_or_else(|| path.to_owned())
}
