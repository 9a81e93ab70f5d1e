//! Links between pages lead to existing files, and to existing headings in them.

use std::path::{Component, Path, PathBuf};

use crate::page::{Page, root};

/// Every page of the repository.
fn pages() -> Vec<String> {
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
