//! Rows as files: comma-separated text, and Parquet.

use std::io::{self, Write};
use std::path::Path;

use crate::rows::{Rows, Values};

/// The file formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated text; numbers in the shortest form that reads back to the same bits.
    Csv,
    /// Parquet.
    Parquet,
}

impl Format {
    /// The extension of a file name.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Csv => "csv",
            Format::Parquet => "parquet",
        }
    }

    /// Whether this build can write it.
    pub fn is_available(self) -> bool {
        self == Format::Csv || cfg!(feature = "parquet")
    }
}

/// The header line of comma-separated text.
pub(crate) fn csv_header(rows: &Rows) -> String {
    let names = rows.columns.iter().map(|column| quoted(&column.name));
    names.collect::<Vec<_>>().join(",") + "\n"
}

/// Reads the rows of a file of comma-separated text whose columns are like these. `has_names` says whether there is a header
/// line; files of chunks have none.
///
/// # Errors
/// If the file is invalid: what is wrong with it.
pub fn read_csv(path: &Path, like: &Rows, has_names: bool) -> io::Result<Rows> {
    let wrong = |why: &str| io::Error::other(why.to_owned());
    let text = std::fs::read_to_string(path)?;
    let mut cells = csv_cells(&text).map_err(io::Error::other)?.into_iter();
    if has_names {
        let names = like.columns.iter().map(|column| &column.name);
        if !cells.next().unwrap_or_default().iter().eq(names) {
            return Err(wrong("it has different columns"));
        }
    }
    let mut rows = Rows::new(like.columns.clone());
    for row in cells {
        if row.len() != like.columns.len() {
            return Err(wrong("a row has the wrong number of cells"));
        }
        let is_there = |cell: &String| !cell.is_empty();
        for (values, cell) in rows.values.iter_mut().zip(row) {
            let number = |cell: &str| cell.parse().map_err(|_| wrong("a cell is not a number"));
            match values {
                Values::Count(values) => {
                    values.push(cell.parse().map_err(|_| wrong("a cell is not a number"))?);
                }
                Values::Number(values) => {
                    let cell = Some(cell).filter(is_there);
                    values.push(cell.map(|cell| number(&cell)).transpose()?);
                }
                Values::Text(values) => values.push(Some(cell).filter(is_there)),
            }
        }
    }
    Ok(rows)
}

/// A line of comma-separated text for each row.
pub(crate) fn csv_lines(rows: &Rows, to: &mut dyn Write) -> io::Result<()> {
    for row in 0..rows.len() {
        for (place, values) in rows.values.iter().enumerate() {
            if place > 0 {
                to.write_all(b",")?;
            }
            match values {
                Values::Count(values) => write!(to, "{}", values[row])?,
                Values::Number(values) => {
                    if let Some(value) = values[row] {
                        write!(to, "{value:?}")?;
                    }
                }
                Values::Text(values) => {
                    if let Some(text) = &values[row] {
                        to.write_all(quoted(text).as_bytes())?;
                    }
                }
            }
        }
        to.write_all(b"\n")?;
    }
    Ok(())
}

/// A text with the quotes that comma-separated text requires (RFC 4180).
fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// The cells of lines of comma-separated text, without quotes.
///
/// # Errors
/// If a quote is not closed.
pub fn csv_cells(text: &str) -> Result<Vec<Vec<String>>, String> {
    let mut rows = Vec::new();
    let (mut row, mut cell) = (Vec::new(), String::new());
    let mut is_quoted = false;
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        match (c, is_quoted) {
            ('"', true) if characters.peek() == Some(&'"') => {
                cell.push('"');
                characters.next();
            }
            ('"', _) => is_quoted = !is_quoted,
            (',', false) => row.push(std::mem::take(&mut cell)),
            ('\n', false) => {
                row.push(std::mem::take(&mut cell));
                rows.push(std::mem::take(&mut row));
            }
            ('\r', false) if characters.peek() == Some(&'\n') => {}
            _ => cell.push(c),
        }
    }
    if is_quoted {
        return Err("a quote is not closed".into());
    }
    if !cell.is_empty() || !row.is_empty() {
        row.push(cell);
        rows.push(row);
    }
    Ok(rows)
}

#[cfg(feature = "parquet")]
pub(crate) use with_parquet::Writer;
#[cfg(feature = "parquet")]
pub use with_parquet::{cells, metadata, numbers, read};

#[cfg(not(feature = "parquet"))]
mod without_parquet {
    use super::*;

    fn none<T>() -> io::Result<T> {
        Err(io::Error::new(
            io::ErrorKind::Unsupported,
            "this build has no feature `parquet`",
        ))
    }

    /// A writer of Parquet files, which this build cannot make.
    pub(crate) struct Writer<W>(std::marker::PhantomData<W>);

    impl<W: Write + Send> Writer<W> {
        pub fn new(_: W, _: &Rows, _: &[(&str, String)]) -> io::Result<Self> {
            none()
        }

        pub fn write(&mut self, _: &Rows) -> io::Result<()> {
            none()
        }

        pub fn end(self) -> io::Result<W> {
            none()
        }
    }

    /// The rows of a Parquet file.
    ///
    /// # Errors
    /// Always: this build cannot read Parquet.
    pub fn read(_: &Path, _: &Rows) -> io::Result<Rows> {
        none()
    }

    /// The columns of numbers of a Parquet file.
    ///
    /// # Errors
    /// Always: this build cannot read Parquet.
    pub fn numbers(_: &Path) -> io::Result<(Vec<String>, Vec<Vec<f64>>)> {
        none()
    }

    /// The columns and rows of a Parquet file as texts.
    ///
    /// # Errors
    /// Always: this build cannot read Parquet.
    pub fn cells(_: &Path) -> io::Result<Vec<Vec<String>>> {
        none()
    }

    /// A metadata value of a Parquet file; this build reads none.
    pub fn metadata(_: &Path, _: &str) -> Option<String> {
        None
    }
}

#[cfg(not(feature = "parquet"))]
pub(crate) use without_parquet::Writer;
#[cfg(not(feature = "parquet"))]
pub use without_parquet::{cells, metadata, numbers, read};

#[cfg(feature = "parquet")]
mod with_parquet {
    use std::fs::File;
    use std::sync::Arc;

    use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
    use parquet::column::reader::ColumnReader;
    use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
    use parquet::file::metadata::KeyValue;
    use parquet::file::properties::WriterProperties;
    use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};
    use parquet::file::writer::SerializedFileWriter;
    use parquet::record::Field;
    use parquet::schema::types::Type;

    use super::*;
    use crate::rows::ColumnType;

    /// A writer of a Parquet file.
    pub(crate) struct Writer<W: Write + Send>(SerializedFileWriter<W>);

    impl<W: Write + Send> Writer<W> {
        /// Starts a file with columns like those of these rows, and with metadata.
        pub fn new(to: W, rows: &Rows, entries: &[(&str, String)]) -> io::Result<Self> {
            let field = |column: &crate::rows::Column| {
                let (physical, logical) = match column.kind {
                    ColumnType::Count => (Physical::INT64, Some(LogicalType::integer(64, false))),
                    ColumnType::Number => (Physical::DOUBLE, None),
                    ColumnType::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
                };
                let repetition = match column.kind {
                    ColumnType::Count => Repetition::REQUIRED,
                    ColumnType::Number | ColumnType::Text => Repetition::OPTIONAL,
                };
                Type::primitive_type_builder(&column.name, physical)
                    .with_logical_type(logical)
                    .with_repetition(repetition)
                    .build()
                    .map(Arc::new)
            };
            let fields: Result<Vec<_>, _> = rows.columns.iter().map(field).collect();
            let schema = Type::group_type_builder("sweep")
                .with_fields(fields?)
                .build()?;
            let metadata = entries
                .iter()
                .map(|(name, value)| KeyValue::new((*name).to_owned(), value.clone()));
            let properties = WriterProperties::builder()
                .set_key_value_metadata(Some(metadata.collect()))
                .build();
            let writer = SerializedFileWriter::new(to, Arc::new(schema), Arc::new(properties))?;
            Ok(Writer(writer))
        }

        /// Writes rows as one row group.
        pub fn write(&mut self, rows: &Rows) -> io::Result<()> {
            let mut group = self.0.next_row_group()?;
            for values in &rows.values {
                let Some(mut column) = group.next_column()? else {
                    break;
                };
                match values {
                    Values::Count(values) => {
                        let values: Vec<i64> = values.iter().map(|x| x.cast_signed()).collect();
                        column
                            .typed::<Int64Type>()
                            .write_batch(&values, None, None)?;
                    }
                    Values::Number(values) => {
                        let there: Vec<f64> = values.iter().flatten().copied().collect();
                        column.typed::<DoubleType>().write_batch(
                            &there,
                            Some(&levels(values)),
                            None,
                        )?;
                    }
                    Values::Text(values) => {
                        let there = values.iter().flatten();
                        let there: Vec<ByteArray> =
                            there.map(|text| ByteArray::from(text.as_str())).collect();
                        column.typed::<ByteArrayType>().write_batch(
                            &there,
                            Some(&levels(values)),
                            None,
                        )?;
                    }
                }
                column.close()?;
            }
            group.close()?;
            Ok(())
        }

        /// Finishes the file.
        pub fn end(self) -> io::Result<W> {
            Ok(self.0.into_inner()?)
        }
    }

    /// The definition level of each value: 1 if it is present, otherwise 0.
    fn levels<T>(values: &[Option<T>]) -> Vec<i16> {
        values
            .iter()
            .map(|value| i16::from(value.is_some()))
            .collect()
    }

    /// Opens a Parquet file.
    ///
    /// # Errors
    /// If the file is invalid, or compressed: what is wrong with it.
    fn opened(path: &Path) -> io::Result<SerializedFileReader<File>> {
        let reader = SerializedFileReader::new(File::open(path)?)?;
        let groups = reader.metadata().row_groups().iter();
        let mut codecs = groups.flat_map(|group| group.columns().iter().map(|it| it.compression()));
        if let Some(codec) = codecs.find(|codec| *codec != Compression::UNCOMPRESSED) {
            let codec = codec.to_string();
            let codec = codec.split('(').next().unwrap_or(&codec);
            return Err(io::Error::other(format!(
                "it is compressed by {codec}, which is not supported: write it without compression (with pandas, \
                 `compression=None`)"
            )));
        }
        Ok(reader)
    }

    /// Reads the rows of a Parquet file whose columns are like these.
    ///
    /// # Errors
    /// If the file is invalid: what is wrong with it.
    pub fn read(path: &Path, like: &Rows) -> io::Result<Rows> {
        let reader = opened(path)?;
        let fields = reader
            .metadata()
            .file_metadata()
            .schema()
            .get_fields()
            .to_vec();
        let names = fields.iter().map(|field| field.name());
        if !names.eq(like.columns.iter().map(|column| column.name.as_str())) {
            return Err(io::Error::other("it has different columns"));
        }
        let mut rows = Rows::new(like.columns.clone());
        for group in 0..reader.num_row_groups() {
            let group = reader.get_row_group(group)?;
            for (place, values) in rows.values.iter_mut().enumerate() {
                column(&*group, place, values)?;
            }
        }
        Ok(rows)
    }

    fn column(group: &dyn RowGroupReader, place: usize, to: &mut Values) -> io::Result<()> {
        let count = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
        let mut levels = Vec::new();
        match (group.get_column_reader(place)?, to) {
            (ColumnReader::Int64ColumnReader(mut reader), Values::Count(to)) => {
                let mut values = Vec::new();
                reader.read_records(count, None, None, &mut values)?;
                to.extend(values.into_iter().map(i64::cast_unsigned));
            }
            (ColumnReader::DoubleColumnReader(mut reader), Values::Number(to)) => {
                let mut values = Vec::new();
                reader.read_records(count, Some(&mut levels), None, &mut values)?;
                let mut values = values.into_iter();
                to.extend(levels.iter().map(|&level| match level {
                    0 => None,
                    _ => values.next(),
                }));
            }
            (ColumnReader::ByteArrayColumnReader(mut reader), Values::Text(to)) => {
                let mut values: Vec<ByteArray> = Vec::new();
                reader.read_records(count, Some(&mut levels), None, &mut values)?;
                let mut values = values.into_iter();
                for level in levels {
                    to.push(match level {
                        0 => None,
                        _ => match values.next() {
                            None => None,
                            Some(text) => Some(text.as_utf8()?.to_owned()),
                        },
                    });
                }
            }
            _ => return Err(io::Error::other("a column has a different type")),
        }
        Ok(())
    }

    /// The names and values of the columns of a Parquet file of numbers.
    ///
    /// # Errors
    /// If the file is invalid, or a value is not a number.
    pub fn numbers(path: &Path) -> io::Result<(Vec<String>, Vec<Vec<f64>>)> {
        rows_of(path, |row, name, field| match field {
            Field::Double(x) => Ok(*x),
            Field::Float(x) => Ok(f64::from(*x)),
            Field::Byte(x) => Ok(f64::from(*x)),
            Field::Short(x) => Ok(f64::from(*x)),
            Field::Int(x) => Ok(f64::from(*x)),
            Field::Long(x) => Ok(*x as f64),
            Field::UByte(x) => Ok(f64::from(*x)),
            Field::UShort(x) => Ok(f64::from(*x)),
            Field::UInt(x) => Ok(f64::from(*x)),
            Field::ULong(x) => Ok(*x as f64),
            _ => Err(io::Error::other(format!(
                "row {row}: column `{name}` holds a value that is not a number"
            ))),
        })
    }

    /// The column names and rows of a Parquet file, as texts like those of comma-separated text.
    ///
    /// # Errors
    /// If the file is invalid: what is wrong with it.
    pub fn cells(path: &Path) -> io::Result<Vec<Vec<String>>> {
        let (names, mut rows) = rows_of(path, |_, _, field| {
            Ok(match field {
                Field::Null => String::new(),
                Field::Str(text) => text.clone(),
                Field::Double(x) => format!("{x:?}"),
                other => other.to_string(),
            })
        })?;
        rows.insert(0, names);
        Ok(rows)
    }

    /// The column names and rows of a Parquet file; `cell` is given the number of its row, the name of its column, and the value.
    fn rows_of<T>(
        path: &Path,
        cell: impl Fn(usize, &str, &Field) -> io::Result<T>,
    ) -> io::Result<(Vec<String>, Vec<Vec<T>>)> {
        let reader = opened(path)?;
        let schema = reader.metadata().file_metadata().schema();
        let fields = schema.get_fields().iter();
        let names = fields.map(|field| field.name().to_owned()).collect();
        let mut rows = Vec::new();
        for row in reader.get_row_iter(None)? {
            let row = row?;
            let cells = row.get_column_iter();
            let cells = cells.map(|(name, field)| cell(rows.len(), name, field));
            rows.push(cells.collect::<io::Result<Vec<T>>>()?);
        }
        Ok((names, rows))
    }

    /// The metadata value under a name in a Parquet file.
    pub fn metadata(path: &Path, name: &str) -> Option<String> {
        let reader = SerializedFileReader::new(File::open(path).ok()?).ok()?;
        let metadata = reader.metadata().file_metadata().key_value_metadata()?;
        metadata
            .iter()
            .find(|entry| entry.key == name)?
            .value
            .clone()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rows::{Cell, Column, ColumnType};

    fn rows() -> Rows {
        let column = |name: &str, kind| Column {
            name: name.into(),
            unit: None,
            kind,
        };
        let mut rows = Rows::new(vec![
            column("run", ColumnType::Count),
            column("x, y", ColumnType::Number),
            column("error", ColumnType::Text),
        ]);
        for (run, x, error) in [
            (0, Some(0.1), None),
            (u64::MAX, None, Some("a \"b\",\nc")),
            (2, Some(f64::NAN), Some("")),
            (3, Some(-1e-300), None),
        ] {
            let error = error.map(str::to_owned);
            rows.push([Cell::Count(run), Cell::Number(x), Cell::Text(error)]);
        }
        rows
    }

    #[test]
    fn cells_of_text_are_what_was_written() {
        let mut text = csv_header(&rows()).into_bytes();
        csv_lines(&rows(), &mut text).unwrap();
        let cells = csv_cells(&String::from_utf8(text).unwrap()).unwrap();
        assert_eq!(cells[0], ["run", "x, y", "error"]);
        assert_eq!(cells[1], ["0", "0.1", ""]);
        assert_eq!(cells[2], ["18446744073709551615", "", "a \"b\",\nc"]);
        assert_eq!(cells[4], ["3", "-1e-300", ""]);
        assert!(csv_cells("a,\"b\n").is_err());
    }

    #[cfg(feature = "parquet")]
    #[test]
    fn parquet_reads_back_to_the_same_rows() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.parquet");
        let file = std::fs::File::create(&path).unwrap();
        let mut writer = Writer::new(file, &rows(), &[("plan", "p".into())]).unwrap();
        writer.write(&rows()).unwrap();
        writer.write(&rows().take(2)).unwrap();
        writer.end().unwrap();
        let mut expected = rows();
        expected.extend(rows().take(2));
        let found = read(&path, &rows()).unwrap();
        // Compared as text, because NaN is not equal to itself.
        assert_eq!(format!("{found:?}"), format!("{expected:?}"));
        assert_eq!(metadata(&path, "plan").as_deref(), Some("p"));
    }

    /// The file was written by PyArrow 26 with its default compression.
    #[cfg(feature = "parquet")]
    #[test]
    fn a_compressed_file_is_rejected_with_its_compression() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/snappy.parquet");
        let why = cells(&path).unwrap_err().to_string();
        assert!(
            why.contains("compressed by SNAPPY, which is not supported"),
            "{why}"
        );
    }
}
