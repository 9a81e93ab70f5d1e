//! Tables as text: columns of numbers under names with units.

use core::fmt::{self, Display};
use std::format;
use std::string::{String, ToString};
use std::vec::Vec;

use lagrangian_spec::diagnostic::{Report, most_similar};
use lagrangian_spec::resolve::value_in;
use lagrangian_spec::source::Sources;

/// A table that was read: a header, `t [ms]` or `torque [N*m]`, and rows of cells.
///
/// ```
/// use lagrangian::Table;
/// use lagrangian::interpreted::TableFile;
///
/// let text = "# measured\nt [ms]; torque [kN*m]\n0; 0\n500; 0.02\n";
/// let file = TableFile::from_text("drive.csv", text)?;
/// let (times, values) = file.column("torque", "N*m")?;
/// assert_eq!((times, values), (vec![0.0, 0.5], vec![0.0, 20.0]));
///
/// let wrong = TableFile::from_text("drive.csv", "t,torque\n0,1\n0.5,\n")?;
/// let error = wrong.column("torque", "N*m").unwrap_err();
/// assert_eq!(error.to_string(), "drive.csv, line 3, column 5: the cell of `torque` is empty");
/// # Ok::<(), lagrangian::interpreted::TableFileError>(())
/// ```
#[derive(Clone, Debug)]
pub struct TableFile {
    name: String,
    header: Vec<Cell>,
    rows: Vec<Vec<Cell>>,
    /// Whether places are lines and columns of a text, or else row numbers.
    is_text: bool,
}

/// A cell of a table.
#[derive(Clone, Debug)]
struct Cell {
    text: String,
    /// Line and column in the text, from 1.
    place: (usize, usize),
}

/// An error in a table file, and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TableFileError {
    /// The name of the file.
    pub file: String,
    /// The line, from 1, and the column in it, in characters; or the row, from 1, if the file is not text.
    pub place: Option<(usize, Option<usize>)>,
    /// What is wrong.
    pub message: String,
}

impl Display for TableFileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        match self.place {
            None => {}
            Some((row, None)) => write!(f, ", row {row}")?,
            Some((line, Some(column))) => write!(f, ", line {line}, column {column}")?,
        }
        write!(f, ": {}", self.message)
    }
}

impl core::error::Error for TableFileError {}

/// Why a line would not be read as it was written, and the column of the character that causes it: it contains a line end of another kind, or
/// its cells are separated by tabs.
fn misread(line: &str, is_header_of_commas: bool) -> Option<(&'static str, usize)> {
    let at = |letter: char| {
        line.chars()
            .position(|other| other == letter)
            .map(|at| at + 1)
    };
    if let Some(at) = at('\r') {
        return Some((
            "the line ends with a carriage return alone: save the table with line feeds",
            at,
        ));
    }
    let tab = at('\t').filter(|_| is_header_of_commas && !line.contains(','))?;
    Some((
        "columns are separated by commas or semicolons, not by tabs",
        tab,
    ))
}

/// The largest number of columns that a message lists.
const MOST_LISTED: usize = 12;

impl TableFile {
    /// Reads comma-separated text, or text with semicolons, with a point as decimal mark. Lines may be empty; a `#`
    /// begins a comment.
    ///
    /// # Errors
    /// If there is no header, or a quote is not closed.
    pub fn from_text(name: &str, text: &str) -> Result<TableFile, TableFileError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut file = TableFile {
            name: name.into(),
            header: Vec::new(),
            rows: Vec::new(),
            is_text: true,
        };
        let mut separator = ',';
        for (number, line) in text.lines().enumerate() {
            let line = uncommented(line);
            if line.trim().is_empty() {
                continue;
            }
            let is_header = file.header.is_empty();
            if is_header && cells(line, ';', true).is_some_and(|cells| cells.len() > 1) {
                separator = ';';
            }
            let place = |column: usize| (number + 1, column);
            if let Some((message, at)) = misread(line, is_header && separator == ',') {
                return Err(file.wrong(Some(place(at)), message));
            }
            let Some(cells) = cells(line, separator, is_header) else {
                return Err(file.wrong(Some(place(1)), "a quote is not closed"));
            };
            let cells = cells.into_iter().map(|(text, column)| Cell {
                text,
                place: place(column),
            });
            if is_header {
                file.header = cells.collect()
            } else {
                file.rows.push(cells.collect())
            }
        }
        if file.header.is_empty() {
            Err(file.wrong(None, "it is empty; its first line must name its columns"))
        } else {
            Ok(file)
        }
    }

    /// Reads a table from bytes, which must be UTF-8.
    ///
    /// # Errors
    /// As [`from_text`](Self::from_text), and if the bytes are not UTF-8.
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<TableFile, TableFileError> {
        match core::str::from_utf8(bytes) {
            Ok(text) => Self::from_text(name, text),
            Err(error) => {
                let before = bytes.get(..error.valid_up_to()).unwrap_or_default();
                let line = before.iter().filter(|byte| **byte == b'\n').count() + 1;
                let since = before.rsplit(|byte| *byte == b'\n').next();
                let since = since.map_or("".into(), String::from_utf8_lossy);
                Err(TableFileError {
                    file: name.into(),
                    place: Some((line, Some(since.chars().count() + 1))),
                    message: "this is not UTF-8: save the table as text in UTF-8".into(),
                })
            }
        }
    }

    /// Makes a table from cells that were read by other means, the header first.
    ///
    /// # Errors
    /// If there is no header.
    pub fn from_cells(name: &str, rows: Vec<Vec<String>>) -> Result<TableFile, TableFileError> {
        let mut rows = rows.into_iter().enumerate().map(|(row, cells)| {
            let cells = cells.into_iter().enumerate();
            let cells = cells.map(|(column, text)| Cell {
                text,
                place: (row, column + 1),
            });
            cells.collect::<Vec<Cell>>()
        });
        let header = rows.next().unwrap_or_default();
        let file = TableFile {
            name: name.into(),
            header,
            rows: rows.collect(),
            is_text: false,
        };
        if file.header.is_empty() {
            Err(file.wrong(None, "it has no columns"))
        } else {
            Ok(file)
        }
    }

    /// Times in seconds, from the column `t`, and the values of a column in a unit. The unit in the header is checked and converted;
    /// a column without one is assumed to be in that unit.
    ///
    /// # Errors
    /// If there is no such column, if a unit does not match, if a cell is not a number, or if times do not increase.
    pub fn column(&self, name: &str, unit: &str) -> Result<(Vec<f64>, Vec<f64>), TableFileError> {
        let times = self.find("t", "s")?;
        self.read(times, (name, self.find(name, unit)?), &[])
    }

    /// The names of the columns except that of times, each with the unit in its header.
    pub fn columns(&self) -> Vec<(String, Option<String>)> {
        let all = self.header.iter().map(split);
        all.filter(|(name, _)| name != "t").collect()
    }

    /// Times in seconds, from the column `t`, and the numbers of a column as they are, in the unit of its header if it has one. An
    /// empty cell, or `NaN`, is NaN: nothing was measured there; so is `inf` or `-inf`, which runs write where an output has no
    /// finite value.
    ///
    /// ```
    /// use lagrangian::interpreted::TableFile;
    ///
    /// let file = TableFile::from_text("run.csv", "t,level\n0,-inf\n1,2\n")?;
    /// let (times, levels) = file.column_with_gaps("level")?;
    /// assert_eq!((times, levels[1]), (vec![0.0, 1.0], 2.0));
    /// assert!(levels[0].is_nan());
    /// # Ok::<(), lagrangian::interpreted::TableFileError>(())
    /// ```
    ///
    /// # Errors
    /// As [`column`](Self::column), except for empty cells.
    pub fn column_with_gaps(&self, name: &str) -> Result<(Vec<f64>, Vec<f64>), TableFileError> {
        let times = self.find("t", "s")?;
        self.read(
            times,
            (name, (self.place(name)?, 1.0)),
            &["", "NaN", "nan", "inf", "-inf"],
        )
    }

    /// Times in seconds and the numbers of a column, converted from the unit of its header to the given one.
    ///
    /// ```
    /// use lagrangian::interpreted::TableFile;
    ///
    /// let file = TableFile::from_text("run.csv", "t,angle [deg]\n0,180\n1,\n")?;
    /// let (times, angles) = file.measured("angle", "rad")?;
    /// assert_eq!((times, angles[0]), (vec![0.0, 1.0], std::f64::consts::PI));
    /// assert!(angles[1].is_nan());
    /// # Ok::<(), lagrangian::interpreted::TableFileError>(())
    /// ```
    ///
    /// # Errors
    /// As [`column_with_gaps`](Self::column_with_gaps), and if the header has another unit.
    pub fn measured(&self, name: &str, unit: &str) -> Result<(Vec<f64>, Vec<f64>), TableFileError> {
        let times = self.find("t", "s")?;
        self.read(times, (name, self.find(name, unit)?), &["", "NaN", "nan"])
    }

    /// Times and the numbers of a column at an index, each with its factor. `gaps` are the texts that stand for no number; if there
    /// are any, a missing cell is a gap too.
    fn read(
        &self,
        (t, seconds): (usize, f64),
        (name, (place, factor)): (&str, (usize, f64)),
        gaps: &[&str],
    ) -> Result<(Vec<f64>, Vec<f64>), TableFileError> {
        let (mut times, mut values) = (Vec::new(), Vec::new());
        for row in &self.rows {
            let beyond = row.iter().skip(self.header.len());
            if let Some(cell) = beyond.into_iter().find(|cell| !cell.text.is_empty()) {
                let message = format!(
                    "the row has more cells than the header, which has {}",
                    self.header.len()
                );
                return Err(self.wrong(Some(cell.place), message));
            }
            let time = seconds * self.number(row, t, "t")?;
            if times.last().is_some_and(|before| time <= *before) {
                let at = row.get(t).map(|cell| cell.place);
                return Err(self.wrong(at, "this time is not later than the one before it"));
            }
            times.push(time);
            let is_gap = |cell: &Cell| gaps.contains(&cell.text.trim());
            values.push(if !gaps.is_empty() && row.get(place).is_none_or(is_gap) {
                f64::NAN
            } else {
                factor * self.number(row, place, name)?
            });
        }
        if times.is_empty() {
            Err(self.wrong(None, "it has no rows below its header"))
        } else {
            Ok((times, values))
        }
    }

    /// The index of a column, and the factor of its numbers.
    fn find(&self, name: &str, unit: &str) -> Result<(usize, f64), TableFileError> {
        let place = self.place(name)?;
        match split(&self.header[place]).1.as_deref() {
            Some(own) if own != unit => {
                let factor = factor(own, unit).map_err(|why| {
                    let at = self.header.get(place).map(|cell| cell.place);
                    self.wrong(at, format!("the unit `{own}` of `{name}`: {why}"))
                })?;
                Ok((place, factor))
            }
            Some(_) => Ok((place, 1.0)),
            None => {
                match without_brackets(name) {
                    Some(meant) => {
                        let at = self.header.get(place).map(|cell| cell.place);
                        Err(self.wrong(at, format!("the unit of `{name}` is written in brackets, after a space: `{meant}`")))
                    }
                    None => Ok((place, 1.0)),
                }
            }
        }
    }

    /// The index of a column.
    fn place(&self, name: &str) -> Result<usize, TableFileError> {
        let columns: Vec<String> = self.header.iter().map(|cell| split(cell).0).collect();
        let mut found = (0..columns.len()).filter(|place| columns[*place] == name);
        let Some(place) = found.next() else {
            let names = || columns.iter().map(String::as_str);
            let mut meant = names().filter_map(without_brackets);
            let meant =
                meant.find(|meant| meant.rsplit_once(" [").is_some_and(|(own, _)| own == name));
            let help = match (meant, most_similar(name, names())) {
                (Some(meant), _) => {
                    format!("units are written in brackets, after a space: `{meant}`")
                }
                (None, Some(near)) => format!("did you mean `{near}`?"),
                (None, None) => {
                    let shown: Vec<&str> = names().take(MOST_LISTED).collect();
                    let more = if names().count() > MOST_LISTED {
                        ", …"
                    } else {
                        ""
                    };
                    format!("there are: {}{more}", shown.join(", "))
                }
            };
            let at = self.header.first().map(|cell| cell.place);
            return Err(self.wrong(at, format!("no column is named `{name}`; {help}")));
        };
        if let Some(other) = found.next() {
            let at = self.header.get(other).map(|cell| cell.place);
            return Err(self.wrong(at, format!("a second column is named `{name}`")));
        }
        Ok(place)
    }

    fn number(&self, row: &[Cell], place: usize, name: &str) -> Result<f64, TableFileError> {
        let Some(cell) = row.get(place) else {
            let at = row.last().map(|cell| cell.place);
            let message = format!("the row ends before its cell of `{name}`");
            return Err(self.wrong(at, message));
        };
        let text = cell.text.trim();
        if text.is_empty() {
            let message = format!("the cell of `{name}` is empty");
            return Err(self.wrong(Some(cell.place), message));
        }
        match text.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(number),
            _ => {
                let help = if text.contains(',') {
                    "; the decimal mark is a point"
                } else {
                    ""
                };
                let message = format!("`{text}` in `{name}` is not a finite number{help}");
                Err(self.wrong(Some(cell.place), message))
            }
        }
    }

    fn wrong(&self, place: Option<(usize, usize)>, message: impl Into<String>) -> TableFileError {
        let place = place.map(|(line, column)| (line, self.is_text.then_some(column)));
        // The header of a file that is not text has no row number.
        let place = place.filter(|(line, _)| self.is_text || *line > 0);
        TableFileError {
            file: self.name.clone(),
            place,
            message: message.into(),
        }
    }
}

/// Name and unit of a header, `torque [N*m]`.
fn split(cell: &Cell) -> (String, Option<String>) {
    let text = cell.text.trim();
    match text
        .strip_suffix(']')
        .and_then(|text| text.rsplit_once(" ["))
    {
        Some((name, unit)) => (name.trim_end().to_string(), Some(unit.trim().to_string())),
        None => (text.to_string(), None),
    }
}

/// How a header is written whose unit is not in brackets after a space: `t [s]` for `t/s`, `t (s)` and `t[s]`; `None` for any other.
fn without_brackets(name: &str) -> Option<String> {
    let in_parentheses = || name.strip_suffix(')')?.split_once(" (");
    let in_brackets = || name.strip_suffix(']')?.split_once('[');
    let (own, unit) = in_parentheses()
        .or_else(in_brackets)
        .or_else(|| name.split_once('/'))?;
    let [own, unit] = [own, unit].map(str::trim);
    // The index of a member, `q[1]`, is not a unit.
    let is_unit = unit.contains(char::is_alphabetic) && factor(unit, unit).is_ok();
    (is_unit && !own.is_empty()).then(|| format!("{own} [{unit}]"))
}

/// The factor from one unit to another.
fn factor(of: &str, unit: &str) -> Result<f64, String> {
    if !of.chars().any(char::is_alphabetic) && of != "1" {
        return Err("expected a unit, as in [N*m], [deg] or [1]".into());
    }
    let (mut sources, mut report) = (Sources::new(), Report::new());
    // The factors keep a bare number from being read in the other unit.
    let text = format!("1*({of})*s/s");
    let factor = value_in(&text, unit, &mut sources, &mut report);
    let factor = factor.filter(|factor| factor.is_finite() && *factor != 0.0);
    factor.ok_or_else(|| {
        let messages = report.diagnostics().into_iter();
        let messages: Vec<String> = messages.map(|wrong| wrong.message.clone()).collect();
        if messages.is_empty() {
            "it cannot be converted".into()
        } else {
            messages.join("; ")
        }
    })
}

/// A line without its comment.
fn uncommented(line: &str) -> &str {
    let mut is_quoted = false;
    let end = line.find(|c: char| {
        is_quoted ^= c == '"';
        c == '#' && !is_quoted
    });
    end.and_then(|end| line.get(..end)).unwrap_or(line)
}

/// The cells of a line, each with its column in characters from 1; `None` if a quote is not closed. In a header a separator within
/// brackets does not separate: `q[1,2]`.
fn cells(line: &str, separator: char, is_header: bool) -> Option<Vec<(String, usize)>> {
    let mut cells = Vec::new();
    let (mut cell, mut from) = (String::new(), 1);
    let (mut is_quoted, mut depth) = (false, 0_usize);
    let mut characters = line.chars().enumerate().peekable();
    let ended = |cell: &mut String, from: usize| {
        let text = core::mem::take(cell);
        let blank = text.chars().take_while(|c| c.is_whitespace()).count();
        // The column of an empty cell is where it begins.
        let blank = if text.trim().is_empty() { 0 } else { blank };
        (text.trim().to_string(), from + blank)
    };
    while let Some((at, c)) = characters.next() {
        match c {
            '"' if is_quoted && characters.peek().is_some_and(|(_, next)| *next == '"') => {
                cell.push('"');
                characters.next();
            }
            '"' => is_quoted = !is_quoted,
            _ if is_quoted => cell.push(c),
            _ if c == separator && depth == 0 => {
                cells.push(ended(&mut cell, from));
                from = at + 2;
            }
            _ => {
                match c {
                    '[' if is_header => depth += 1,
                    ']' if is_header => depth = depth.saturating_sub(1),
                    _ => {}
                }
                cell.push(c);
            }
        }
    }
    cells.push(ended(&mut cell, from));
    (!is_quoted).then_some(cells)
}
