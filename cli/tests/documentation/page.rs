//! A page of Markdown: its code blocks, headings and prose.

use std::path::{Path, PathBuf};

/// The folder of the repository.
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// A file of the repository, as text.
pub struct Page {
    /// Its contents, with lines ended by `\n`.
    pub text: String,
}

/// A code block.
pub struct Block {
    /// The text after the opening fence.
    pub language: String,
    /// The lines between the fences.
    pub text: String,
    /// The line of the opening fence, from 1.
    pub line: usize,
    /// The text between it and the next block or heading.
    pub after: String,
}

impl Page {
    /// Reads a file, named from the root of the repository.
    pub fn open(path: &str) -> Page {
        let text = std::fs::read_to_string(root().join(path));
        let text = text.unwrap_or_else(|error| panic!("{path}: {error}"));
        Page {
            text: text.replace("\r\n", "\n"),
        }
    }

    /// The code blocks from top to bottom.
    pub fn blocks(&self) -> Vec<Block> {
        let mut blocks: Vec<Block> = Vec::new();
        let (mut inside, mut new_heading) = (false, false);
        for (index, line) in self.text.lines().enumerate() {
            match (line.strip_prefix("```"), inside) {
                (Some(language), false) => {
                    (inside, new_heading) = (true, false);
                    blocks.push(Block {
                        language: language.to_owned(),
                        text: String::new(),
                        line: index + 1,
                        after: String::new(),
                    });
                }
                (Some(_), true) => inside = false,
                (None, true) => {
                    let block = blocks.last_mut().expect("a block is open");
                    block.text += line;
                    block.text.push('\n');
                }
                (None, false) => {
                    new_heading |= line.starts_with('#');
                    if let Some(block) = blocks.last_mut().filter(|_| !new_heading) {
                        block.after += line;
                        block.after.push('\n');
                    }
                }
            }
        }
        assert!(!inside, "a code block does not end");
        blocks
    }

    /// The lines outside code blocks, each with its number, from 1.
    pub fn prose(&self) -> Vec<(usize, &str)> {
        let mut inside = false;
        let mut lines = Vec::new();
        for (index, line) in self.text.lines().enumerate() {
            if line.starts_with("```") {
                inside = !inside;
            } else if !inside {
                lines.push((index + 1, line));
            }
        }
        lines
    }

    /// The headings with their depth: 1 for `#`.
    pub fn headings(&self) -> Vec<(usize, &str)> {
        let prose = self.prose().into_iter();
        let heading = prose.filter_map(|(_, line)| {
            let depth = line.chars().take_while(|&c| c == '#').count();
            let text = line.get(depth..)?.strip_prefix(' ')?;
            (depth > 0).then_some((depth, text))
        });
        heading.collect()
    }

    /// The text below a heading, up to the next one of the same or a higher level.
    pub fn entry(&self, heading: &str) -> Option<&str> {
        let depth = heading.chars().take_while(|&c| c == '#').count();
        let start = self.text.find(&format!("\n{heading}\n"))? + heading.len() + 2;
        let rest = &self.text[start..];
        let next = (1..=depth).filter_map(|depth| rest.find(&format!("\n{} ", "#".repeat(depth))));
        Some(&rest[..next.min().unwrap_or(rest.len())])
    }
}
