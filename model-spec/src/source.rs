//! Source texts of a spec: files, positions in them, and the files that `extends` names.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The longest source that is read, in bytes.
///
/// A spec of a thousand bodies has 100 kB. A larger file is not a spec, and refusing it early
/// bounds the memory and time of every later stage.
pub const SOURCE_LIMIT: usize = 4 << 20;

/// One of the texts of a compilation; an index into [`Sources`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SourceId(pub u16);

/// A stretch of one source, `start..end`: bytes of a file, or ordinals of tokens in a macro body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Span {
    /// The text.
    pub source: SourceId,
    /// The first byte, or the first token.
    pub start: u32,
    /// One past the last.
    pub end: u32,
}

impl Span {
    /// The stretch `start..end` of `source`.
    pub fn new(source: SourceId, start: u32, end: u32) -> Span {
        Span { source, start, end }
    }

    /// From the beginning of `self` to the end of `last`, if both are in one source.
    pub fn to(self, last: Span) -> Span {
        if self.source != last.source {
            return self;
        }
        Span {
            source: self.source,
            start: self.start.min(last.start),
            end: self.end.max(last.end),
        }
    }

    /// Whether `other` lies within this stretch.
    pub fn encloses(self, other: Span) -> bool {
        self.source == other.source && self.start <= other.start && other.end <= self.end
    }

    /// The empty stretch right after this one, the place of something missing.
    pub fn after(self) -> Span {
        Span {
            start: self.end,
            ..self
        }
    }
}

/// Every text of a compilation: the spec, and those that it extends.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    list: Vec<Source>,
}

#[derive(Clone, Debug)]
struct Source {
    name: String,
    content: Content,
}

#[derive(Clone, Debug)]
enum Content {
    /// A file, and the byte at which each of its lines begins.
    Text { text: String, lines: Vec<u32> },
    /// The body of a macro: line and column of each token, both from 1.
    Tokens { positions: Vec<(usize, usize)> },
}

impl Sources {
    /// No texts yet.
    pub fn new() -> Sources {
        Sources::default()
    }

    /// Adds a file; messages refer to it as `name`.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<String>) -> SourceId {
        let text = text.into();
        let after_newlines = text.match_indices('\n').map(|(at, _)| at as u32 + 1);
        let lines = std::iter::once(0).chain(after_newlines).collect();
        self.push(Source {
            name: name.into(),
            content: Content::Text { text, lines },
        })
    }

    /// Adds the body of a macro, whose spans count tokens; `positions` are the line and column of
    /// each token, from 1, in the file `name`.
    pub fn add_tokens(
        &mut self,
        name: impl Into<String>,
        positions: Vec<(usize, usize)>,
    ) -> SourceId {
        self.push(Source {
            name: name.into(),
            content: Content::Tokens { positions },
        })
    }

    fn push(&mut self, source: Source) -> SourceId {
        // A chain of 65 536 files is not a spec: the last ones share a number, and nothing panics.
        let id = SourceId(u16::try_from(self.list.len()).unwrap_or(u16::MAX));
        self.list.push(source);
        id
    }

    /// The name of this source in messages.
    pub fn name(&self, id: SourceId) -> &str {
        self.get(id).map_or("", |source| &source.name)
    }

    /// The text of a file; empty for a macro body.
    pub fn text(&self, id: SourceId) -> &str {
        match self.get(id).map(|source| &source.content) {
            Some(Content::Text { text, .. }) => text,
            _ => "",
        }
    }

    /// The text that a span covers; empty in a macro body.
    pub fn words(&self, span: Span) -> &str {
        self.text(span.source)
            .get(span.start as usize..span.end as usize)
            .unwrap_or("")
    }

    /// True for the body of a macro, whose spans count tokens instead of bytes.
    pub fn is_tokens(&self, id: SourceId) -> bool {
        matches!(
            self.get(id).map(|source| &source.content),
            Some(Content::Tokens { .. })
        )
    }

    /// The number of texts.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// True before the first text is added.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// The line and column at which a span begins, both from 1; a column counts characters.
    pub fn line_column(&self, span: Span) -> (usize, usize) {
        match self.get(span.source).map(|source| &source.content) {
            Some(Content::Text { text, lines }) => {
                let line = lines.partition_point(|&begin| begin <= span.start).max(1);
                let begin = lines.get(line - 1).map_or(0, |&begin| begin as usize);
                let before = text.get(begin..span.start as usize).unwrap_or("");
                (line, before.chars().count() + 1)
            }
            Some(Content::Tokens { positions }) => {
                let last = positions.last().copied().unwrap_or((1, 1));
                positions.get(span.start as usize).copied().unwrap_or(last)
            }
            None => (1, 1),
        }
    }

    /// The line with this number (from 1), without its line break; empty in a macro body.
    pub fn line(&self, id: SourceId, number: usize) -> &str {
        match self.get(id).map(|source| &source.content) {
            Some(Content::Text { text, lines }) => {
                let begin = number.checked_sub(1).and_then(|line| lines.get(line));
                let begin = begin.map_or(text.len(), |&begin| begin as usize);
                let end = lines.get(number).map_or(text.len(), |&end| end as usize);
                text.get(begin..end)
                    .unwrap_or("")
                    .trim_end_matches(['\n', '\r'])
            }
            _ => "",
        }
    }

    fn get(&self, id: SourceId) -> Option<&Source> {
        self.list.get(id.0 as usize)
    }
}

/// The source of the texts that a spec names with `extends`.
pub trait Files {
    /// Reads the file `path`, relative to the file `from` that names it.
    ///
    /// Returns the canonical name of the file (the same name for different paths to it) and its
    /// text; or the reason for a failure, as a sentence without the path.
    fn read(&mut self, path: &str, from: Option<&str>) -> Result<(String, String), String>;
}

/// Files on disk.
#[derive(Clone, Copy, Debug, Default)]
pub struct Disk;

impl Files for Disk {
    fn read(&mut self, path: &str, from: Option<&str>) -> Result<(String, String), String> {
        let beside = from
            .and_then(|from| Path::new(from).parent())
            .unwrap_or(Path::new(""));
        let path: PathBuf = beside.join(path);
        let file = std::fs::File::open(&path).map_err(|error| error.to_string())?;
        // One byte more than allowed shows that the file is too long, whatever size it reports.
        let mut bytes = Vec::new();
        file.take(SOURCE_LIMIT as u64 + 1)
            .read_to_end(&mut bytes)
            .map_err(|error| error.to_string())?;
        if bytes.len() > SOURCE_LIMIT {
            return Err(format!("it is larger than {} MiB", SOURCE_LIMIT >> 20));
        }
        let text = String::from_utf8(bytes)
            .map_err(|error| format!("byte {} is not UTF-8", error.utf8_error().valid_up_to()))?;
        // `a/../b.machine` and `b.machine` are one file, so that circular `extends` are detected.
        let canonical = path.canonicalize().map_err(|error| error.to_string())?;
        let shown = if is_plain(&path) { path } else { canonical };
        Ok((shown.to_string_lossy().into_owned(), text))
    }
}

/// Whether a path is already in its shortest form, relative or not, so that messages may show it.
fn is_plain(path: &Path) -> bool {
    use std::path::Component;
    path.components()
        .all(|part| matches!(part, Component::Normal(_)))
}

/// Files that exist only by name, for tests and for specs that extend nothing.
#[derive(Clone, Debug, Default)]
pub struct InMemory {
    texts: BTreeMap<String, String>,
}

impl InMemory {
    /// No files.
    pub fn new() -> InMemory {
        InMemory::default()
    }

    /// Adds a file.
    pub fn with(mut self, name: impl Into<String>, text: impl Into<String>) -> InMemory {
        self.texts.insert(name.into(), text.into());
        self
    }
}

impl Files for InMemory {
    fn read(&mut self, path: &str, _from: Option<&str>) -> Result<(String, String), String> {
        match self.texts.get(path) {
            Some(text) => Ok((path.to_owned(), text.clone())),
            None => Err("there is no such file".to_owned()),
        }
    }
}

/// What was read from files, to be read again without them: their names and texts, by the path and the file that named it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ReadTexts {
    texts: BTreeMap<(String, Option<String>), (String, String)>,
}

impl ReadTexts {
    /// Records that the file `path`, named by the file `from`, has this name and this text.
    pub fn insert(&mut self, (path, from): (&str, Option<&str>), read: (String, String)) {
        let asked = (path.to_owned(), from.map(str::to_owned));
        self.texts.insert(asked, read);
    }
}

impl Files for ReadTexts {
    fn read(&mut self, path: &str, from: Option<&str>) -> Result<(String, String), String> {
        let asked = (path.to_owned(), from.map(str::to_owned));
        let read = self.texts.get(&asked).cloned();
        read.ok_or_else(|| "it was not read before".to_owned())
    }
}

/// Reads files, and records what it reads.
pub struct Recorder<'f> {
    files: &'f mut dyn Files,
    /// What was read so far.
    pub read: ReadTexts,
}

impl<'f> Recorder<'f> {
    /// Nothing has been read yet.
    pub fn new(files: &'f mut dyn Files) -> Recorder<'f> {
        Recorder {
            files,
            read: ReadTexts::default(),
        }
    }
}

impl Files for Recorder<'_> {
    fn read(&mut self, path: &str, from: Option<&str>) -> Result<(String, String), String> {
        let read = self.files.read(path, from)?;
        self.read.insert((path, from), read.clone());
        Ok(read)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_read_is_read_again_without_its_files() {
        let mut files = InMemory::new().with("a", "one").with("b", "two");
        let mut recorder = Recorder::new(&mut files);
        assert!(recorder.read("a", None).is_ok() && recorder.read("b", Some("a")).is_ok());
        assert!(recorder.read("c", None).is_err());
        let mut read = recorder.read;
        assert_eq!(read.read("b", Some("a")), Ok(("b".into(), "two".into())));
        // The same path may be another file elsewhere.
        assert!(read.read("b", None).is_err() && read.read("c", None).is_err());
    }

    #[test]
    fn columns_count_characters_not_bytes() {
        let mut sources = Sources::new();
        let id = sources.add("a.machine", "erste\nθ = ω·t\n");
        let omega = "erste\nθ = ".len() as u32;
        assert_eq!(sources.line_column(Span::new(id, omega, omega + 2)), (2, 5));
        assert_eq!(sources.words(Span::new(id, omega, omega + 2)), "ω");
        assert_eq!(sources.line(id, 2), "θ = ω·t");
        assert_eq!(sources.line(id, 9), "");
    }

    #[test]
    fn a_position_past_the_end_is_in_the_last_line() {
        let mut sources = Sources::new();
        let id = sources.add("a.machine", "one\ntwo");
        assert_eq!(sources.line_column(Span::new(id, 7, 7)), (2, 4));
    }

    #[test]
    fn tokens_of_a_macro_have_the_positions_they_came_with() {
        let mut sources = Sources::new();
        let id = sources.add_tokens("main.rs", vec![(3, 5), (3, 9)]);
        assert_eq!(sources.line_column(Span::new(id, 1, 2)), (3, 9));
        assert_eq!(sources.line_column(Span::new(id, 7, 8)), (3, 9));
    }
}
