//! What `cargo package --workspace` asks of the manifests, and what registries show of a crate, without asking a registry.

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The lines of a manifest with the section that each stands in.
fn lines(text: &str) -> Vec<(&str, &str)> {
    let mut section = "";
    let mut lines = Vec::new();
    for line in text.lines().map(str::trim) {
        match line.strip_prefix('[') {
            Some(name) => section = name.trim_end_matches(']'),
            None => lines.push((section, line)),
        }
    }
    lines
}

/// What a crate that is to be published lacks.
fn lacks(text: &str, folder: &Path) -> Vec<String> {
    let lines = lines(text);
    let package = |key: &str| {
        let mut of_package = lines.iter().filter(|(section, _)| *section == "package");
        of_package.any(|(_, line)| line.split(['.', '=']).next().map(str::trim) == Some(key))
    };
    let keys = [
        "description",
        "version",
        "license",
        "rust-version",
        "readme",
        "include",
        "categories",
        "keywords",
        "documentation",
    ];
    let mut lacks: Vec<String> = keys
        .into_iter()
        .filter(|key| !package(key))
        .map(str::to_owned)
        .collect();
    let readme = lines.iter().find_map(|(section, line)| {
        let path = line.strip_prefix("readme = ")?.trim_matches('"');
        (*section == "package").then(|| folder.join(path))
    });
    if readme.is_some_and(|readme| !readme.is_file()) {
        lacks.push("the file that `readme` names".to_owned());
    }
    for (section, line) in &lines {
        // What tests depend on by path alone is left out of what is published.
        let is_needed = section.ends_with("dependencies") && !section.contains("dev-dependencies");
        if is_needed && line.contains("path =") && !line.contains("version =") {
            lacks.push(format!("a version of {line}"));
        }
    }
    lacks
}

#[test]
fn every_crate_is_ready_to_be_published() {
    let supporting = fs::read_dir(root().join("crates")).expect("a folder");
    let supporting = supporting.map(|entry| entry.expect("an entry").path());
    let others = [
        ".",
        "cli",
        "derive-macros",
        "generated",
        "jit",
        "lagrangian",
        "model-spec",
    ];
    let folders = supporting.chain(others.iter().map(|folder| root().join(folder)));
    let mut crates = 0;
    for folder in folders {
        let text = fs::read_to_string(folder.join("Cargo.toml")).expect("a manifest");
        let lacks = lacks(&text, &folder);
        assert!(lacks.is_empty(), "{}: {lacks:?}", folder.display());
        crates += 1;
    }
    assert!(crates >= 16, "{crates}");
}

#[test]
fn a_manifest_that_lacks_something_is_seen() {
    let text = "[package]\nversion.workspace = true\n[dependencies]\nx = { path = \"../x\" }\n\
                y = { path = \"../y\", version = \"1\" }\n[dev-dependencies]\nz = { path = \"../z\" }\n";
    let lacks = lacks(text, &root());
    assert!(lacks.contains(&"readme".to_owned()) && !lacks.contains(&"version".to_owned()));
    let versions: Vec<&String> = lacks
        .iter()
        .filter(|lack| lack.starts_with("a version"))
        .collect();
    assert_eq!(versions.len(), 1, "{lacks:?}");
}

/// The packages that the compiler depends on, and the crates of the compiler: `lagrangian-emit` and all below it, without what
/// tests alone need.
fn packages_of_the_compiler() -> Vec<String> {
    let read = |path: PathBuf| fs::read_to_string(path).expect("a file of the project");
    let lock = read(root().join("Cargo.lock"));
    let own = |name: &str| match name.strip_prefix("lagrangian-") {
        Some("spec") => Some(root().join("model-spec")),
        Some(crate_name) => Some(root().join("crates").join(crate_name)),
        None => None,
    };
    let below = |name: &str| -> Vec<String> {
        if let Some(folder) = own(name) {
            let manifest = read(folder.join("Cargo.toml"));
            return lines(&manifest)
                .into_iter()
                .filter(|(section, line)| *section == "dependencies" && line.contains('='))
                .filter(|(_, line)| !line.starts_with('#') && !line.contains("optional = true"))
                .filter_map(|(_, line)| line.split(['.', ' ', '=']).next())
                .map(str::to_owned)
                .collect();
        }
        let start = format!("name = \"{name}\"\n");
        let entry = lock
            .split("[[package]]\n")
            .find(|entry| entry.starts_with(&start));
        let list = entry.and_then(|entry| entry.split_once("dependencies = [\n"));
        list.map_or_else(Vec::new, |(_, list)| {
            list.lines()
                .take_while(|line| line.starts_with(" \""))
                .filter_map(|line| line.split('"').nth(1)?.split(' ').next())
                .map(str::to_owned)
                .collect()
        })
    };
    let mut packages = vec!["lagrangian-emit".to_owned()];
    let mut next = 0;
    while let Some(name) = packages.get(next) {
        for dependency in below(name) {
            if !packages.contains(&dependency) {
                packages.push(dependency);
            }
        }
        next += 1;
    }
    packages
}

/// A macro and what it depends on are compiled without optimization unless they are named. One package that is not named is
/// two packages, and all of the compiler above it is compiled twice: once for the macro, once for the command.
#[test]
fn the_compiler_is_compiled_once_in_every_profile() {
    // Build scripts alone need it.
    let apart = ["autocfg"];
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("a manifest");
    let packages = packages_of_the_compiler();
    assert!(packages.len() > 10, "{packages:?}");
    for profile in ["profile.dev.package", "profile.release.package"] {
        let named: Vec<&str> = lines(&manifest)
            .into_iter()
            .filter(|(section, _)| *section == profile)
            .filter(|(_, line)| line.contains("opt-level"))
            .filter_map(|(_, line)| line.split(['.', ' ', '=']).next())
            .collect();
        let missing: Vec<&String> = packages
            .iter()
            .filter(|package| {
                !apart.contains(&package.as_str()) && !named.contains(&package.as_str())
            })
            .collect();
        assert!(missing.is_empty(), "[{profile}] does not name {missing:?}");
    }
}

/// The Python package is apart from the workspace, and shares its folder of builds: where the profiles are the same, so is what
/// both depend on.
#[test]
fn the_python_package_is_built_in_the_profile_of_the_workspace() {
    let profile = |path: &str| -> Vec<(String, String)> {
        let text = fs::read_to_string(root().join(path)).expect("a manifest");
        lines(&text)
            .into_iter()
            .filter(|(section, line)| section.starts_with("profile.dev") && line.contains('='))
            .filter(|(_, line)| !line.starts_with('#'))
            .map(|(section, line)| (section.to_owned(), line.to_owned()))
            .collect()
    };
    // Tests and examples of the workspace are nothing that the package depends on.
    let lock = fs::read_to_string(root().join("python/Cargo.lock")).expect("a lock file");
    let mut of_workspace = profile("Cargo.toml");
    of_workspace.retain(|(_, line)| {
        let name = line.split_once(".opt-level").map(|(name, _)| name);
        name.is_none_or(|name| lock.contains(&format!("name = \"{name}\"\n")))
    });
    assert!(of_workspace.len() > 10, "{of_workspace:?}");
    assert_eq!(of_workspace, profile("python/Cargo.toml"));
}
