//! The combinations of features: every command on a small machine of each kind either works or is refused with an error. The rows are in
//! `audit/rows.txt`, and the table of `docs/limits.md` is generated from them.

use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;

use super::support::{Scratch, lagrangian, root};

/// The machines, and their names in the table.
const KINDS: [(&str, &str); 11] = [
    ("plain", "plain"),
    ("states", "`states`"),
    ("charts", "`charts`"),
    ("constrained", "constraints"),
    ("redundant", "that others imply"),
    ("nonholonomic", "of rates"),
    ("sliding", "`sliding`"),
    ("surface", "on a surface"),
    ("contact", "`contacts`"),
    ("compliant", "that yield"),
    ("in_space", "in space"),
];

/// The outcome of a command on a machine.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Outcome<'t> {
    Works,
    /// It works, with a warning about the machine.
    Told(&'t str),
    /// It works differently, with a warning that says so.
    Warned(&'t str),
    /// It works, but whether it finds a result depends on the machine; if not, these words give advice.
    Searched(&'t str),
    Refused(&'t str),
}

struct Row<'t> {
    name: &'t str,
    command: &'t str,
    outcomes: Vec<Outcome<'t>>,
}

fn rows(text: &str) -> Vec<Row<'_>> {
    let mut rows: Vec<Row<'_>> = Vec::new();
    for line in text
        .lines()
        .filter(|line| !line.starts_with('#') && !line.is_empty())
    {
        let Some(rest) = line.strip_prefix("    ") else {
            let (name, command) = line.split_once(" = ").expect("`name = command`");
            let outcomes = vec![Outcome::Works; KINDS.len()];
            rows.push(Row {
                name,
                command,
                outcomes,
            });
            continue;
        };
        let (machines, words) = rest.split_once(": ").expect("`machines: words`");
        let (machines, outcome) = if let Some(machines) = machines.strip_prefix("warned ") {
            (machines, Outcome::Warned(words))
        } else if let Some(machines) = machines.strip_prefix("told ") {
            (machines, Outcome::Told(words))
        } else if let Some(machines) = machines.strip_prefix("searched ") {
            (machines, Outcome::Searched(words))
        } else {
            (machines, Outcome::Refused(words))
        };
        let row = rows.last_mut().expect("a command stands before");
        for machine in machines.split(' ') {
            let kind = KINDS.iter().position(|(name, _)| *name == machine);
            let kind = kind.unwrap_or_else(|| panic!("no machine is called {machine}"));
            assert_eq!(
                row.outcomes[kind],
                Outcome::Works,
                "{machine} stands twice: {line}"
            );
            row.outcomes[kind] = outcome;
        }
    }
    rows
}

/// The table for the docs.
fn table(rows: &[Row<'_>]) -> String {
    let mut table = String::from("| command |");
    for (_, kind) in KINDS {
        let _ = write!(table, " {kind} |");
    }
    let _ = write!(table, "\n|{}", " --- |".repeat(1 + KINDS.len()));
    for row in rows {
        let _ = write!(table, "\n| {} |", row.name.replace("--", "\\-\\-"));
        for outcome in &row.outcomes {
            table.push_str(match outcome {
                Outcome::Works | Outcome::Told(_) | Outcome::Searched(_) => " yes |",
                Outcome::Warned(_) => " warned |",
                Outcome::Refused(_) => " – |",
            });
        }
    }
    table
}

/// A folder that is removed when the test ends.
struct Folder(PathBuf);

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0); // a remaining folder does no harm
    }
}

#[test]
fn every_command_works_on_every_kind_of_machine_or_is_refused_at_the_word() {
    let text = include_str!("audit/rows.txt");
    let of_machines = root().join("cli/tests/command/audit");
    let folder = std::env::temp_dir().join(format!("lagrangian-{}-audit", std::process::id()));
    fs::create_dir_all(&folder).expect("a temporary folder");
    let folder = Folder(folder);
    let mut failures = Vec::new();
    let rows = rows(text);
    for (kind, (name, _)) in KINDS.iter().enumerate() {
        let machine = of_machines.join(format!("{name}.machine"));
        let machine = machine.to_str().expect("a path in UTF-8");
        let data = folder.0.join(format!("{name}.csv"));
        let data = data.to_str().expect("a path in UTF-8");
        let measured = [
            "simulate", machine, "--until", "0.5", "--every", "0.01", "--set", "m=1.3", "--out",
            data,
        ];
        assert!(lagrangian(&measured).status.success(), "{name} runs");
        let whole = fs::read_to_string(data).expect("it was written");
        // The times and the first coordinate.
        let columns = whole
            .lines()
            .map(|line| line.splitn(3, ',').take(2).collect::<Vec<_>>().join(","));
        fs::write(data, columns.collect::<Vec<_>>().join("\n")).expect("it can be written");
        for (number, row) in rows.iter().enumerate() {
            let out = folder.0.join(format!("{name}-{number}"));
            let out = out.to_str().expect("a path in UTF-8");
            let argument = |word: &str| match word {
                "M" => machine.to_owned(),
                "DATA" => data.to_owned(),
                word => word.replace("OUT", out),
            };
            let arguments: Vec<String> = row.command.split(' ').map(argument).collect();
            let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
            let output = lagrangian(&arguments);
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            let printed = String::from_utf8_lossy(&output.stdout);
            let is_as_told = match row.outcomes[kind] {
                Outcome::Works => output.status.success() && !said.contains("warning"),
                Outcome::Told(words) | Outcome::Warned(words) => {
                    output.status.success() && said.contains(words)
                }
                Outcome::Searched(words) => output.status.success() || said.contains(words),
                // Redundant constraints are only detected by the run, so there may already be output.
                Outcome::Refused(words) => {
                    matches!(output.status.code(), Some(1 | 2))
                        && said.contains(words)
                        && (printed.is_empty() || *name == "redundant")
                }
            };
            let is_plain = ["panicked", "`?`", "todo"]
                .iter()
                .all(|word| !said.contains(word));
            if !is_as_told || !is_plain {
                failures.push(format!(
                    "{} on {name}: {:?} was told, and it ended with {:?}\n{said}",
                    row.command,
                    row.outcomes[kind],
                    output.status.code()
                ));
            }
            // A refused command leaves no files.
            let is_refused = matches!(row.outcomes[kind], Outcome::Refused(_));
            let made = ["html", "csv", "fmu", "so"].map(|ending| format!("{out}.{ending}"));
            if let (true, Some(made)) = (
                is_refused,
                made.iter().find(|made| fs::exists(made).unwrap_or(true)),
            ) {
                failures.push(format!("{} on {name} left {made}", row.command));
            }
        }
    }
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn the_table_of_the_docs_is_that_of_the_rows() {
    let table = table(&rows(include_str!("audit/rows.txt")));
    let docs = fs::read_to_string(root().join("docs/limits.md")).expect("the docs are there");
    assert!(
        docs.contains(&table),
        "docs/limits.md is to have\n\n{table}\n"
    );
}

/// A contact that cannot be kept closed is named, and without friction the message does not mention friction.
#[test]
fn a_contact_that_nothing_holds_shut_is_named() {
    let of = |start: &str, constraints: &str, gap: &str| {
        let text = format!(
            "machine Held in plane {{
                parameters {{ m: kg = 1, g: m/s^2 = 9.81, l: m = 1, w: m/s = 1 }}
                coordinates {{ x: m, y: m = {start}, der(x): m/s = w }}
                bodies {{ b {{ mass: m, at: (x, y) }} }}
                gravity (0, -g);
                {constraints}
                contacts {{ floor {{ gap: {gap}, restitution: 0 }} }}
            }}"
        );
        let spec = Scratch::new("held.machine", &text);
        let output = lagrangian(&["simulate", spec.path(), "--until", "1"]);
        assert_eq!(output.status.code(), Some(1), "{gap}");
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    // The derivative of the gap by y vanishes as y approaches 0. How close y comes to 0 depends on round-off: of starts that differ by one rounding
    // some reach 0, and others do not.
    let ulps = (0..128).map(|k| f64::from_bits(0.1_f64.to_bits() + k));
    let vanishing = ulps.map(|start| of(&format!("l*{start:?}"), "", "y^3/l^2"));
    // It is driven into the floor.
    let driven = of("l/2", "constraints { drive: y - l/2 + w*t = 0 }", "y");
    for said in vanishing.chain([driven]) {
        assert!(said.contains("the contact `floor` at t = "), "{said}");
        assert!(
            said.contains("no force along its normal keeps it closed here"),
            "{said}"
        );
        assert!(!said.contains("friction") && !said.contains('?'), "{said}");
    }
}
