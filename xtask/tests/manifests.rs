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
    if !folder.join("README.md").is_file() {
        lacks.push("README.md".to_owned());
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
