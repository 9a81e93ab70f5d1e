//! Tables of numbers as text: a header, then rows of cells.

/// A table as it stands in a text: cells are separated by commas, or by semicolons if the header has any. A `#` begins a comment, and
/// lines without cells are left out.
pub struct TextTable<'t> {
    /// The cells of the header.
    pub headers: Vec<&'t str>,
    /// The other lines without their comments, each with its number.
    lines: Vec<(usize, &'t str)>,
    separator: char,
}

impl<'t> TextTable<'t> {
    /// The table in a text; without headers if there are no lines.
    pub fn new(text: &'t str) -> TextTable<'t> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let uncommented = |line: &'t str| line.split('#').next().unwrap_or_default();
        let lines = (1..).zip(text.lines().map(uncommented));
        let mut lines = lines.filter(|(_, line)| !line.trim().is_empty());
        let header = lines.next().map_or("", |(_, line)| line);
        let separator = if header.contains(';') { ';' } else { ',' };
        TextTable {
            headers: header.split(separator).map(unquoted).collect(),
            lines: lines.collect(),
            separator,
        }
    }

    /// Checks that its columns are not separated by tabs, which would make one of them.
    ///
    /// # Errors
    /// If they are.
    pub fn check_separator(&self) -> Result<(), String> {
        match self.headers.as_slice() {
            [all] if all.contains('\t') => {
                Err("columns are separated by commas or semicolons, not by tabs".into())
            }
            _ => Ok(()),
        }
    }

    /// The number and the cells of each line after the header.
    ///
    /// # Errors
    /// If a line has more cells than the header.
    pub fn rows(&self) -> impl Iterator<Item = Result<(usize, Vec<&'t str>), String>> {
        let count = self.headers.len();
        self.lines.iter().map(move |(number, line)| {
            let cells: Vec<&str> = line.split(self.separator).map(unquoted).collect();
            let mut more = cells.iter().skip(count);
            if more.any(|cell| !cell.is_empty()) {
                return Err(format!(
                    "line {number}: the row has more cells than the header, which has {count}; the decimal mark is a point"
                ));
            }
            Ok((*number, cells))
        })
    }
}

/// A cell without the quotes around it, which some programs write.
fn unquoted(cell: &str) -> &str {
    let cell = cell.trim();
    let inner = cell
        .strip_prefix('"')
        .and_then(|cell| cell.strip_suffix('"'));
    inner.unwrap_or(cell)
}
