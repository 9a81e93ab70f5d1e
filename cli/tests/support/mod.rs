//! Runs the command, and parses the page that it writes.
#![allow(dead_code, reason = "no test uses all of it")]

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};

use serde_json::Value;

/// The root of the repository, where the command runs.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// Runs the command.
pub fn lagrangian(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lagrangian"));
    command
        .current_dir(root())
        .args(arguments)
        .env("LAGRANGIAN_CACHE", env!("CARGO_TARGET_TMPDIR"))
        .stdin(Stdio::null());
    command.output().expect("the command runs")
}

/// What the command prints if it succeeds, as JSON.
#[track_caller]
pub fn json(arguments: &[&str]) -> Value {
    let output = lagrangian(arguments);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, errors) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(
        output.status.code(),
        Some(0),
        "{arguments:?}: {errors}{out}"
    );
    serde_json::from_str(&out).unwrap_or_else(|_| panic!("{arguments:?}: {out}{errors}"))
}

#[track_caller]
pub fn number(value: &Value) -> f64 {
    value
        .as_f64()
        .unwrap_or_else(|| panic!("no number: {value}"))
}

/// A file in its own folder, which is removed when the test ends.
pub struct Scratch(pub PathBuf);

impl Scratch {
    pub fn new(name: &str, text: &str) -> Scratch {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let folder = format!("lagrangian-{}-{number}", std::process::id());
        let folder = std::env::temp_dir().join(folder);
        std::fs::create_dir_all(&folder).expect("a folder");
        let path = folder.join(name);
        std::fs::write(&path, text).expect("a file");
        Scratch(path)
    }

    pub fn path(&self) -> &str {
        self.0.to_str().expect("text")
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        if let Some(folder) = self.0.parent() {
            let _ = std::fs::remove_dir_all(folder);
        }
    }
}

/// A page, and the data in it.
pub struct Page {
    /// The exit status of the command that wrote it.
    pub status: i32,
    pub html: String,
    pub data: Value,
}

impl Page {
    /// The page of a run.
    pub fn of(spec: &str, options: &[&str]) -> Page {
        let html = Scratch::new("run.html", "");
        let arguments = ["simulate", spec, "--report", html.path()];
        let output = lagrangian(&[&arguments, options].concat());
        let status = output.status.code().expect("no signal");
        assert!(status < 2, "{}", String::from_utf8_lossy(&output.stderr));
        Page::read(status, &html)
    }

    pub fn read(status: i32, file: &Scratch) -> Page {
        let html = std::fs::read_to_string(&file.0).expect("a page");
        let start = "<script type=\"application/json\" id=\"data\">";
        let data = html
            .split_once(start)
            .and_then(|(_, rest)| rest.split_once("</script>"));
        let data = data.map(|(data, _)| serde_json::from_str(data).expect("JSON"));
        Page {
            status,
            data: data.expect("data"),
            html,
        }
    }

    /// The drawing.
    pub fn picture(&self) -> &Value {
        &self.data["picture"]
    }

    /// `q` and `v` of every stored state.
    pub fn states(&self) -> Vec<Vec<f32>> {
        let width = 2 * self.data["coordinates"].as_u64().expect("a number") as usize;
        let numbers = floats(self.data["states"].as_str().expect("text"));
        let bases = &self.data["bases"];
        let base = |k: usize| bases.get(k).and_then(Value::as_f64).unwrap_or(0.0);
        let state = |stored: &[f32]| -> Vec<f32> {
            let stored = stored.iter().enumerate();
            stored
                .map(|(k, x)| (base(k) + f64::from(*x)) as f32)
                .collect()
        };
        let states: Vec<Vec<f32>> = numbers.chunks_exact(width).map(state).collect();
        assert_eq!(self.data["count"].as_u64(), Some(states.len() as u64));
        states
    }

    /// The time of a stored state.
    pub fn time(&self, index: usize) -> f64 {
        let number = |name: &str| self.data[name].as_f64().expect("a number");
        if index + 1 == number("count") as usize {
            number("to")
        } else {
            number("from") + index as f64 * number("interval")
        }
    }
}

/// Decodes 32-bit numbers from base64; independent of the decoder that runs in the browser.
pub fn floats(text: &str) -> Vec<f32> {
    let value = |letter: u8| match letter {
        b'A'..=b'Z' => Some(letter - b'A'),
        b'a'..=b'z' => Some(letter - b'a' + 26),
        b'0'..=b'9' => Some(letter - b'0' + 52),
        b'+' => Some(62),
        b'/' => Some(63),
        b'=' => None,
        other => panic!("{} is no letter of base 64", char::from(other)),
    };
    let (mut bits, mut held) = (0_u32, 0);
    let mut bytes = Vec::new();
    for six in text.bytes().filter_map(value) {
        bits = bits << 6 | u32::from(six);
        held += 6;
        if held >= 8 {
            held -= 8;
            bytes.push((bits >> held & 0xff) as u8);
        }
    }
    let numbers = bytes
        .chunks_exact(4)
        .map(|four| <[u8; 4]>::try_from(four).expect("four"));
    numbers.map(f32::from_le_bytes).collect()
}
