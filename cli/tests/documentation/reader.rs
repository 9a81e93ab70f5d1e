//! A simulated reader, who reads a page from top to bottom, saves its specs and types its commands.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use lagrangian_mechanics::Compiled;
use lagrangian_spec::diagnostic::{Code, Report};
use lagrangian_spec::source::{Disk, Sources};

use crate::page::{Block, root};

/// Commands that the test does not run because they build, install or test.
const LEFT_TO_READERS: [&str; 4] = [
    "cargo test --workspace",
    "cargo install --path cli",
    "cargo xtask generate",
    "cargo new",
];

/// The expected result of a spec.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It can be derived.
    Sound,
    /// It is valid, but cannot be derived yet.
    NotSupported,
    /// It has errors.
    Wrong,
}

/// A reader with a temporary folder.
pub struct Reader {
    folder: PathBuf,
}

impl Drop for Reader {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.folder); // a remaining folder does no harm
    }
}

impl Reader {
    /// A reader of a page; the folder contains the library of machines.
    pub fn new(page: &str) -> Reader {
        let name = page.replace(['/', '.'], "-");
        let name = format!("lagrangian-{}-{name}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let machines = folder.join("machines");
        copy(&root().join("machines"), &machines);
        Reader { folder }
    }

    /// Saves a spec, and checks that it has the `expected` result.
    pub fn save(&self, block: &Block, expected: Verdict, at: &str) {
        let path = self.folder.join(name_of(&block.text, at));
        std::fs::write(&path, &block.text).expect("a temporary file");
        let (dag, mut sources, mut report) = (Default::default(), Sources::new(), Report::new());
        let (path, text, disk) = (path.to_string_lossy(), &block.text, &mut Disk);
        let model = lagrangian_spec::model(&dag, &path, text, &[], disk, &mut sources, &mut report);
        let compiled = model.and_then(|model| Compiled::new(model, &mut report));
        let mut codes = report.diagnostics().into_iter().map(|message| message.code);
        let verdict = match compiled {
            Some(_) => Verdict::Sound,
            None if codes.all(|code| code == Code::NotSupported) => Verdict::NotSupported,
            None => Verdict::Wrong,
        };
        let said = report.render(&sources);
        assert_eq!(verdict, expected, "{at}: this is said:\n{said}");
    }

    /// Saves a program under the name in its first line.
    pub fn save_program(&self, block: &Block, at: &str) {
        let first = block.text.lines().next().unwrap_or_default();
        let name = first.trim_start_matches(['/', '#', ' ', '<', '!', '-']);
        let name = name.trim_end_matches(" -->");
        let is_name = name.contains('.') && !name.contains(['/', ' ']);
        assert!(is_name, "{at}: the first line names the file");
        std::fs::write(self.folder.join(name), &block.text).expect("a temporary file");
    }

    /// Runs the commands of a `console` block and compares their output with the lines below them.
    pub fn compare(&self, block: &Block, at: &str) {
        let mut commands: Vec<(&str, Vec<&str>)> = Vec::new();
        for line in block.text.lines() {
            match (line.strip_prefix("$ "), commands.last_mut()) {
                (Some(command), _) => commands.push((command, Vec::new())),
                (None, Some((_, shown))) => shown.push(line),
                (None, None) => panic!("{at}: a console begins with a command"),
            }
        }
        for (command, shown) in commands {
            // Python is optional; with it the pages are checked completely.
            if command.starts_with("python3 ") && Command::new("python3").output().is_err() {
                continue;
            }
            let (printed, succeeded) = self.type_in(command, at);
            let fails = shown.iter().any(|line| line.starts_with("error"));
            assert!(
                succeeded != fails,
                "{at}: `{command}` ends otherwise:\n{printed}"
            );
            let printed = printed.lines().map(str::trim_end);
            let printed: Vec<&str> = printed.filter(|line| !is_progress(line)).collect();
            assert!(
                lines_match(&shown, &printed),
                "{at}: `{command}` prints now:\n{}",
                printed.join("\n")
            );
        }
    }

    /// Runs the commands of an `sh` block, which must succeed.
    pub fn run(&self, block: &Block, at: &str) {
        for command in block.text.lines() {
            let left = LEFT_TO_READERS
                .iter()
                .any(|known| command.starts_with(known));
            if !left && !command.starts_with('#') && !command.is_empty() {
                let (printed, succeeded) = self.type_in(command, at);
                assert!(succeeded, "{at}: `{command}` fails:\n{printed}");
            }
        }
    }

    /// The output of a command, errors first, and whether it succeeds.
    fn type_in(&self, command: &str, at: &str) -> (String, bool) {
        let words = words(command);
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        match words[..] {
            ["lagrangian", ref arguments @ ..]
            | ["cargo", "run", "--release", "--", ref arguments @ ..] => {
                run(Command::new(env!("CARGO_BIN_EXE_lagrangian"))
                    .args(arguments)
                    .current_dir(&self.folder))
            }
            // rustc links with a C compiler, so there is one; its results are run as well.
            [program, ref arguments @ ..]
                if program == "cc" || program == "python3" || program.starts_with("./") =>
            {
                let path = match program.strip_prefix("./") {
                    Some(name) => self.folder.join(name),
                    None => PathBuf::from(program),
                };
                run(Command::new(path).args(arguments).current_dir(&self.folder))
            }
            // Examples are run by the library's tests.
            ["cargo", "run", "--release", .., "--example", name] => {
                let path = root().join("examples").join(name).with_extension("rs");
                (String::new(), path.exists())
            }
            ["cat", file] => (self.read(file, at), true),
            ["head", count, file] => {
                let count = count.strip_prefix('-').and_then(|n| n.parse().ok());
                let text = self.read(file, at);
                let lines = text.lines().take(count.expect("`head -3 FILE`"));
                (lines.collect::<Vec<_>>().join("\n"), true)
            }
            _ => panic!("{at}: this test does not know how to run `{command}`"),
        }
    }

    fn read(&self, file: &str, at: &str) -> String {
        let read = std::fs::read_to_string(self.folder.join(file));
        read.unwrap_or_else(|error| panic!("{at}: {file}: {error}"))
    }
}

/// The file name under which a spec is saved: the name in its first line, `// NAME.machine`, or else the name of its
/// machine in snake case.
fn name_of(spec: &str, at: &str) -> String {
    let first = spec.lines().next().unwrap_or_default();
    if let Some(name) = first.strip_prefix("// ") {
        let path = Path::new(name);
        assert!(
            path.extension()
                .is_some_and(|extension| extension == "machine"),
            "{at}: the first line of a spec may name its file, and nothing else"
        );
        return name.to_owned();
    }
    let line = spec.lines().find_map(|line| line.strip_prefix("machine "));
    let line = line.unwrap_or_else(|| panic!("{at}: no machine"));
    let name = line.split_whitespace().next().unwrap_or_default();
    let mut snake = String::new();
    for letter in name.chars() {
        if letter.is_uppercase() && !snake.is_empty() {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake + ".machine"
}

/// The words of a command; quoted text is one word.
fn words(command: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quote = None;
    for letter in command.chars() {
        match (letter, quote) {
            ('\'' | '"', None) => quote = Some(letter),
            (letter, Some(open)) if letter == open => quote = None,
            (' ', None) => words.push(String::new()),
            (letter, _) => words.last_mut().expect("never empty").push(letter),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// Whether lines match those shown, where a line `…` stands for any number of lines.
fn lines_match(shown: &[&str], lines: &[&str]) -> bool {
    match (shown, lines) {
        ([], []) => true,
        ([first, rest @ ..], _) if first.trim() == "…" => {
            (0..=lines.len()).any(|skipped| lines_match(rest, &lines[skipped..]))
        }
        ([first, shown @ ..], [line, lines @ ..]) => {
            line_matches(first, line) && lines_match(shown, lines)
        }
        _ => false,
    }
}

/// Whether a line matches the one shown, where `…` stands for any text.
fn line_matches(shown: &str, line: &str) -> bool {
    let Some((before, after)) = shown.split_once('…') else {
        return shown == line;
    };
    let Some(rest) = line.strip_prefix(before) else {
        return false;
    };
    let ends = rest.char_indices().map(|(at, _)| at).chain([rest.len()]);
    ends.into_iter().any(|at| line_matches(after, &rest[at..]))
}

#[test]
fn an_ellipsis_stands_for_what_changes() {
    assert!(line_matches("took … s, … steps", "took 0.01 s, 12 steps"));
    assert!(!line_matches("took … s", "took 0.01 s, 12 steps"));
    assert!(lines_match(&["a", "…", "d"], &["a", "b", "c", "d"]));
    assert!(lines_match(&["a", "…"], &["a"]));
    assert!(!lines_match(&["a", "…", "d"], &["a", "b"]));
    assert!(!lines_match(&["a"], &["a", "b"]));
}

/// The output of a command, errors first, and whether it succeeds.
fn run(command: &mut Command) -> (String, bool) {
    let output = command.stdin(Stdio::null()).output();
    let output = output.expect("the command runs");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    let printed = text(output.stderr) + &text(output.stdout);
    (printed, output.status.success())
}

/// Whether a line is a progress message, which any command may print on a busy machine.
fn is_progress(line: &str) -> bool {
    // Of sweeps, with the time that they will take.
    if line.contains(" runs, ") && line.ends_with(" left") {
        return true;
    }
    let seconds = line
        .strip_suffix(" s")
        .and_then(|line| line.rsplit_once(", "));
    seconds.is_some_and(|(what, seconds)| {
        seconds.parse::<u64>().is_ok() && !what.is_empty() && !what.contains(['|', '{', '"'])
    })
}

/// Copies all files of a folder and of the folders in it.
fn copy(folder: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("a temporary folder");
    for entry in std::fs::read_dir(folder).expect("the library") {
        let from = entry.expect("an entry").path();
        let to = to.join(from.file_name().expect("a name"));
        if from.is_dir() {
            copy(&from, &to)
        } else {
            std::fs::copy(from, to).map(|_| ()).expect("a copy")
        }
    }
}
