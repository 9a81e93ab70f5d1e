//! Tables for other programs: comma-separated text, and Parquet.

use std::io::{self, Write};

use crate::failure::Failure;
use crate::heading::name_and_unit;
use crate::output::Destination;
use crate::recording::Recording;
use crate::text_table::TextTable;

/// Writes a recording in the format of the file's extension.
///
/// # Errors
/// Errors of the file system.
pub fn write(recording: &Recording, to: &Destination) -> Result<(), Failure> {
    write_columns(&columns(recording), to)
}

/// Writes columns, each with its header.
///
/// # Errors
/// Errors of the file system.
pub fn write_columns(columns: &[(String, &[f64])], to: &Destination) -> Result<(), Failure> {
    to.write(|file| match to.ending() {
        "parquet" => parquet(columns, file),
        _ => csv(columns, file),
    })
}

/// The instants, then the quantities.
fn columns(recording: &Recording) -> Vec<(String, &[f64])> {
    let columns = recording
        .columns
        .iter()
        .map(|column| column.values.as_slice());
    let all = std::iter::once(recording.times.as_slice()).chain(columns);
    recording.headers().zip(all).collect()
}

/// One line for each row. Numbers have the shortest form that reads back to the same bits.
fn csv(columns: &[(String, &[f64])], to: &mut dyn Write) -> io::Result<()> {
    let headers: Vec<&str> = columns.iter().map(|(header, _)| header.as_str()).collect();
    writeln!(to, "{}", headers.join(","))?;
    for row in 0..columns.first().map_or(0, |(_, values)| values.len()) {
        for (index, (_, values)) in columns.iter().enumerate() {
            let comma = if index > 0 { "," } else { "" };
            match values.get(row) {
                Some(value) => write!(to, "{comma}{value:?}")?,
                None => write!(to, "{comma}")?,
            }
        }
        writeln!(to)?;
    }
    Ok(())
}

/// One row group, one required column of doubles for each quantity.
#[cfg(feature = "parquet")]
fn parquet(columns: &[(String, &[f64])], to: &mut (dyn Write + Send)) -> io::Result<()> {
    use std::sync::Arc;

    use parquet::basic::{Repetition, Type as Physical};
    use parquet::data_type::DoubleType;
    use parquet::file::properties::WriterProperties;
    use parquet::file::writer::SerializedFileWriter;
    use parquet::schema::types::Type;

    let fields: Result<Vec<_>, _> = columns
        .iter()
        .map(|(header, _)| {
            let field = Type::primitive_type_builder(header, Physical::DOUBLE);
            field
                .with_repetition(Repetition::REQUIRED)
                .build()
                .map(Arc::new)
        })
        .collect();
    let schema = Type::group_type_builder("run")
        .with_fields(fields?)
        .build()?;
    let properties = Arc::new(WriterProperties::builder().build());
    let mut writer = SerializedFileWriter::new(to, Arc::new(schema), properties)?;
    let mut rows = writer.next_row_group()?;
    for (_, values) in columns {
        if let Some(mut column) = rows.next_column()? {
            column
                .typed::<DoubleType>()
                .write_batch(values, None, None)?;
            column.close()?;
        }
    }
    rows.close()?;
    writer.close()?;
    Ok(())
}

#[cfg(not(feature = "parquet"))]
fn parquet(_: &[(String, &[f64])], _: &mut (dyn Write + Send)) -> io::Result<()> {
    Err(io::Error::new(
        io::ErrorKind::Unsupported,
        "this build of the command lacks the feature `parquet`",
    ))
}

/// The rows of a table as text, each with the values of the columns with these names; units and other columns are ignored.
///
/// # Errors
/// If a column is missing, a row has more cells than the header, or an entry is not a finite number: which one.
pub fn rows(text: &str, names: &[String]) -> Result<Vec<Vec<f64>>, String> {
    let table = TextTable::new(text);
    table.check_separator()?;
    let headers = table.headers.iter();
    let columns: Vec<&str> = headers.map(|header| name_and_unit(header).0).collect();
    let place = |name: &String| {
        let mut found = (0..columns.len()).filter(|i| columns[*i] == name);
        match (found.next(), found.next()) {
            (Some(place), None) => Ok(place),
            (None, _) => Err(format!("no column is named `{name}`")),
            _ => Err(format!("more than one column is named `{name}`")),
        }
    };
    let places: Vec<usize> = names.iter().map(place).collect::<Result<_, _>>()?;
    let rows = table.rows().map(|row| {
        let (number, cells) = row?;
        let value = |place: &usize| {
            let cell = cells.get(*place).copied().unwrap_or_default();
            let value = cell.parse().ok().filter(|x: &f64| x.is_finite());
            value.ok_or_else(|| {
                format!(
                    "line {number}: `{cell}` in column `{}` is not a finite number",
                    columns[*place]
                )
            })
        };
        places.iter().map(value).collect()
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::{Column, ColumnKind};

    fn recording() -> Recording {
        let values = vec![0.1, -1e-300, 1.0 / 3.0];
        Recording {
            times: vec![0.0, 0.5, 1.0],
            columns: vec![Column {
                name: "s1".into(),
                unit: "m".into(),
                kind: ColumnKind::Coordinate,
                values,
            }],
        }
    }

    #[test]
    fn text_reads_back_to_the_same_bits() {
        let mut text = Vec::new();
        csv(&columns(&recording()), &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("t [s],s1 [m]"));
        let read: Vec<f64> = lines
            .map(|line| line.split(',').nth(1).unwrap().parse().unwrap())
            .collect();
        assert_eq!(read, recording().columns[0].values);
    }

    #[test]
    fn tabs_between_columns_are_named() {
        for text in ["l\t1\n0.5\t2\n", "l\n0.5\n"] {
            let found = rows(text, &["l".to_owned()]);
            let is_one_column = !text.contains('\t');
            assert_eq!(found.is_ok(), is_one_column, "{found:?}");
            if let Err(message) = found {
                assert!(message.contains("not by tabs"), "{message}");
            }
        }
    }

    #[test]
    fn rows_are_found_by_names() {
        let mut text = Vec::new();
        csv(&columns(&recording()), &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let names = ["s1".to_owned()];
        let values = &recording().columns[0].values;
        let values = values.iter().map(|x| vec![*x]).collect();
        assert_eq!(rows(&text, &names), Ok(values));
        let family = ["q[2]".to_owned(), "q[1]".to_owned()];
        assert_eq!(
            rows("q[1], q[2] [m] \n1,2\n\n3 ,4\n", &family),
            Ok(vec![vec![2.0, 1.0], vec![4.0, 3.0]])
        );
        // As spreadsheets and other programs write it.
        assert_eq!(
            rows(
                "\u{feff}# measured\r\n\"q[1]\"; q[2] [m]\r\n1;2 # first\r\n\r\n3 ;4;\r\n",
                &family
            ),
            Ok(vec![vec![2.0, 1.0], vec![4.0, 3.0]])
        );
        for (text, why) in [
            ("", "no column is named `s1`"),
            (
                "s1\n1,5\n",
                "line 2: the row has more cells than the header, which has 1; the decimal mark is a point",
            ),
            ("s1 [m],s1\n1,2\n", "more than one column is named `s1`"),
            (
                "t,s1\n0\n",
                "line 2: `` in column `s1` is not a finite number",
            ),
            (
                "s1\n1\ninf\n",
                "line 3: `inf` in column `s1` is not a finite number",
            ),
        ] {
            assert_eq!(rows(text, &names), Err(why.to_owned()), "{text}");
        }
    }

    #[cfg(feature = "parquet")]
    #[test]
    fn parquet_reads_back_to_the_same_bits() {
        use std::fs::File;

        use crate::output::TABLE;
        use parquet::file::reader::{FileReader, SerializedFileReader};
        use parquet::record::RowAccessor;

        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("RUN.PARQUET");
        let destination = Destination::new("--out", &path, TABLE).unwrap();
        write(&recording(), &destination).unwrap();
        let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
        let read: Vec<f64> = reader
            .get_row_iter(None)
            .unwrap()
            .map(|row| row.unwrap().get_double(1).unwrap())
            .collect();
        assert_eq!(read, recording().columns[0].values);
    }
}
