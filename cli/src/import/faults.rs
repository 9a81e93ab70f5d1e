//! What is wrong with a robot's file, and with those that it includes: each fault with its file, line and column.

/// What is wrong with a file.
pub struct Faults {
    sources: Vec<Source>,
    found: Vec<(usize, String)>,
}

/// A text that is read. Places in it are counted from `start`, so that a number alone says which text it is about.
struct Source {
    shown: String,
    text: String,
    start: usize,
}

impl Faults {
    pub fn new(shown: &str, text: &str) -> Faults {
        let mut faults = Faults {
            sources: Vec::new(),
            found: Vec::new(),
        };
        faults.include(shown, text);
        faults
    }

    /// One more text; where its places begin.
    pub fn include(&mut self, shown: &str, text: &str) -> usize {
        let end = |source: &Source| source.start + source.text.len() + 1;
        let start = self.sources.last().map_or(0, end);
        self.sources.push(Source {
            shown: shown.to_owned(),
            text: text.to_owned(),
            start,
        });
        start
    }

    /// Something is wrong at a place in the text.
    pub fn add(&mut self, at: usize, message: impl Into<String>) {
        self.found.push((at, message.into()));
    }

    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// All of it in the order of the file, a line each, as `file:line:column: message`.
    pub fn told(mut self) -> String {
        const MOST: usize = 20;
        self.found.sort();
        let mut lines: Vec<String> = Vec::new();
        for (at, message) in self.found.iter().take(MOST) {
            let reached = self.sources.iter().rev().find(|source| source.start <= *at);
            let Some(Source { shown, text, start }) = reached else {
                continue;
            };
            let before = text.get(..*at - start).unwrap_or_default();
            let line = before.matches('\n').count() + 1;
            let start = before.rfind('\n').map_or(0, |end| end + 1);
            let column = before[start..].chars().count() + 1;
            lines.push(format!("{shown}:{line}:{column}: {message}"));
        }
        if self.found.len() > MOST {
            lines.push(format!("and {} more", self.found.len() - MOST));
        }
        lines.join("\n")
    }
}
