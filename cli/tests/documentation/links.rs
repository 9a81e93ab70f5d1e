//! Links between pages lead to existing files, and to existing headings in them; the tests that pages name exist.

use std::path::{Component, Path, PathBuf};

use crate::page::{Page, root};

/// Every page of the repository, except those of its crates.
pub fn pages() -> Vec<String> {
    let mut pages = vec![];
    for folder in ["", "docs", "machines"] {
        for entry in std::fs::read_dir(root().join(folder)).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|extension| extension == "md") {
                let name = path.file_name().expect("a name").to_string_lossy();
                let page = Path::new(folder).join(&*name);
                pages.push(page.to_string_lossy().into_owned());
            }
        }
    }
    pages.sort();
    pages
}

/// The targets of links `[…](…)` and of pictures, outside code.
fn targets(line: &str) -> Vec<&str> {
    // Every second part between backquotes is code; a link around code has its brackets outside.
    let mut found = Vec::new();
    let mut rest = line;
    while let Some(at) = rest.find("](") {
        let target = &rest[at + 2..];
        let end = target.find(')').unwrap_or(target.len());
        found.push(&target[..end]);
        rest = &target[end..];
    }
    found
}

/// The anchor of a heading, as Markdown renderers generate it.
fn anchor(heading: &str) -> String {
    let kept = heading
        .chars()
        .filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.flat_map(char::to_lowercase)
        .map(|c| if c == ' ' { '-' } else { c })
        .collect()
}

/// A path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                plain.pop();
            }
            Component::CurDir => {}
            part => plain.push(part),
        }
    }
    plain
}

#[test]
fn links_lead_somewhere() {
    let mut wrong = Vec::new();
    let mut links = 0;
    for page in pages() {
        for (number, line) in Page::open(&page).prose() {
            for target in targets(line) {
                if target.contains("://") {
                    continue;
                }
                links += 1;
                let (file, section) = target.split_once('#').unwrap_or((target, ""));
                let path = match file {
                    "" => PathBuf::from(&page),
                    file => plain(&Path::new(&page).parent().expect("a folder").join(file)),
                };
                let leads = if section.is_empty() {
                    root().join(&path).exists()
                } else {
                    let path = path.to_string_lossy();
                    root().join(&*path).exists()
                        && Page::open(&path)
                            .headings()
                            .iter()
                            .any(|(_, heading)| anchor(heading) == section)
                };
                if !leads {
                    wrong.push(format!("{page}:{number}: {target}"));
                }
            }
        }
    }
    assert!(links > 20, "the search finds links");
    assert!(wrong.is_empty(), "dead links:\n{}", wrong.join("\n"));
}

#[test]
fn anchors_are_made_of_words() {
    assert_eq!(anchor("`torsion_springs`"), "torsion_springs");
    assert_eq!(anchor("What may depend on what"), "what-may-depend-on-what");
    assert_eq!(anchor("4. Two, or more"), "4-two-or-more");
}

/// The sources of a test program: `tests/NAME.rs`, or the files in `tests/NAME/`, of any crate.
fn sources_of(program: &str) -> Vec<PathBuf> {
    let mut crates = vec![root()];
    for folder in ["", "crates"] {
        let entries = std::fs::read_dir(root().join(folder)).expect("a folder");
        crates.extend(entries.map(|entry| entry.expect("an entry").path()));
    }
    let mut waiting: Vec<PathBuf> = crates
        .iter()
        .flat_map(|of| {
            let tests = of.join("tests");
            [tests.join(program), tests.join(format!("{program}.rs"))]
        })
        .filter(|path| path.exists())
        .collect();
    let mut files = Vec::new();
    while let Some(path) = waiting.pop() {
        match std::fs::read_dir(&path) {
            Ok(entries) => waiting.extend(entries.map(|entry| entry.expect("an entry").path())),
            Err(_) if path.extension().is_some_and(|of| of == "rs") => files.push(path),
            Err(_) => {}
        }
    }
    files
}

/// Whether a file, by the names of its modules, or a test in it has this in its name.
fn is_in(file: &Path, filter: &str) -> bool {
    let last = filter.rsplit("::").next().unwrap_or(filter);
    let has = |name: &str| name.contains(last);
    let modules = file.with_extension("");
    modules.iter().any(|part| has(&part.to_string_lossy())) || {
        let text = std::fs::read_to_string(file).expect("text");
        let functions = text.split("fn ").skip(1);
        let mut names = functions.filter_map(|rest| rest.split('(').next());
        names.any(has)
    }
}

/// Every `cargo test … --test PROGRAM FILTER` in the docs runs something.
#[test]
fn tests_that_pages_name_exist() {
    let (mut wrong, mut named) = (Vec::new(), 0);
    for page in pages() {
        for line in Page::open(&page).text.lines() {
            for call in line.split("cargo test ").skip(1) {
                let call = call.split(['`', '#']).next().unwrap_or_default();
                let mut words = call.split_whitespace().peekable();
                let (mut programs, mut filters) = (Vec::new(), Vec::new());
                while let Some(word) = words.next() {
                    match word {
                        "--test" => programs.extend(words.next()),
                        "-p" | "--features" => {
                            words.next();
                        }
                        _ if word.starts_with('-') || word == "NAME_OF_THE_TEST" => {}
                        _ => filters.push(word),
                    }
                }
                for program in programs {
                    named += 1;
                    let sources = sources_of(program);
                    let runs = |filter: &&str| sources.iter().any(|file| is_in(file, filter));
                    if sources.is_empty() || !(filters.is_empty() || filters.iter().any(runs)) {
                        wrong.push(format!("{page}: cargo test {call}"));
                    }
                }
            }
        }
    }
    assert!(named > 20, "the search finds tests");
    assert!(wrong.is_empty(), "these run nothing:\n{}", wrong.join("\n"));
}
