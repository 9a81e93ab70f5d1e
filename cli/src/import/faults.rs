//! Errors of a robot description and of the files that it includes, with file, line and column.

/// The errors found so far.
pub struct Faults {
    sources: Vec<Source>,
    found: Vec<(usize, String)>,
}

/// A source text. Positions in it are counted from `start`, so that a position alone identifies the text.
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

    /// Adds a text; returns the position of its beginning.
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

    /// Records an error at a position.
    pub fn add(&mut self, at: usize, message: impl Into<String>) {
        self.found.push((at, message.into()));
    }

    pub fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// All errors in the order of the file, one per line, as `file:line:column: message`.
    pub fn into_message(mut self) -> String {
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
