//! The docs and the help of the command name the same commands and options.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use crate::links;
use crate::page::Page;

/// What the command prints about itself, or about one of its commands.
fn help(of: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
    let output = command.args(of).arg("--help").output();
    String::from_utf8(output.expect("the command runs").stdout).expect("text")
}

/// The options of each command, without `--help`.
fn options() -> BTreeMap<String, BTreeSet<String>> {
    let general = help(&[]);
    let lines = general.lines().skip_while(|line| *line != "Commands:");
    let commands = lines.skip(1).take_while(|line| !line.is_empty());
    let names = commands.filter_map(|line| line.split_whitespace().next());
    let with_options = names.map(|command| {
        let help = help(&[command]);
        let options = help.lines().filter_map(|line| {
            let line = line.trim_start();
            let line = line.strip_prefix("-h, ").unwrap_or(line);
            line.strip_prefix("--")?.split([' ', '.', ',']).next()
        });
        let options = options.filter(|option| *option != "help");
        let options = options.map(|option| format!("--{option}")).collect();
        (command.to_owned(), options)
    });
    with_options.collect()
}

#[test]
fn every_option_is_in_the_docs() {
    let page = Page::open("docs/command-line.md").text;
    let all = options();
    for command in all.keys() {
        let row = format!("| `lagrangian {command} ");
        assert!(page.contains(&row), "no row for `lagrangian {command}`");
    }
    let options: BTreeSet<&String> = all.values().flatten().collect();
    assert!(options.len() > 8, "{options:?}");
    for option in options {
        assert!(
            page.contains(&format!("`{option}"))
                || page.contains(&format!("[{option}"))
                || page.contains(&format!("{option} ")),
            "docs/command-line.md does not tell of {option}"
        );
    }
}

/// The words of a text that begin like an option.
fn named(text: &str) -> impl Iterator<Item = String> {
    let words = text.match_indices("--").filter_map(|(at, _)| {
        let before = text[..at].chars().next_back();
        let is_start = before.is_none_or(|c| !c.is_alphanumeric() && c != '-');
        let word: String = text[at + 2..]
            .chars()
            .take_while(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || *c == '-')
            .collect();
        let is_option = word.starts_with(|c: char| c.is_ascii_lowercase());
        (is_start && is_option).then(|| format!("--{word}"))
    });
    words.collect::<Vec<_>>().into_iter()
}

/// Every call in the docs, in a block or within a sentence, names a command and options that this command has.
#[test]
fn every_option_in_the_docs_exists() {
    let all = options();
    let (mut wrong, mut calls) = (Vec::new(), 0);
    for page in links::pages() {
        let text = Page::open(&page).text;
        for (number, line) in text.lines().enumerate() {
            // Code within a sentence ends at a backquote; forms with alternatives write `\|` in tables.
            for call in line.split("lagrangian ").skip(1) {
                let call = call.split('`').next().unwrap_or_default();
                let command = call.split_whitespace().next().unwrap_or_default();
                let Some(known) = all.get(command) else {
                    continue;
                };
                calls += 1;
                for option in named(call) {
                    if option != "--help" && !known.contains(&option) {
                        let number = number + 1;
                        wrong.push(format!("{page}:{number}: `lagrangian {command}` {option}"));
                    }
                }
            }
        }
    }
    assert!(calls > 100, "the search finds calls");
    assert!(wrong.is_empty(), "no such options:\n{}", wrong.join("\n"));
}

#[test]
fn options_begin_with_two_dashes() {
    let found: Vec<String> = named("[--fit 'a,b'] --one-of=2 a--b -- -x---").collect();
    assert_eq!(found, ["--fit", "--one-of"]);
}
