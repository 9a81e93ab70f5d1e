//! Tables for other programs: comma-separated text, and Parquet.

use std::io::{self, Write};

use crate::failure::Failure;
use crate::output::Destination;
use crate::recording::Recording;

/// Writes a recording in the format that the file's ending names.
///
/// # Errors
/// What the file system says.
pub fn write(recording: &Recording, to: &Destination) -> Result<(), Failure> {
    to.write(|file| match to.ending() {
        "parquet" => parquet(recording, file),
        _ => csv(recording, file),
    })
}

/// One line for each instant. Numbers are in the shortest form that reads back to the same bits.
fn csv(recording: &Recording, to: &mut dyn Write) -> io::Result<()> {
    let headers: Vec<String> = recording.headers().collect();
    writeln!(to, "{}", headers.join(","))?;
    for (row, time) in recording.times.iter().enumerate() {
        write!(to, "{time:?}")?;
        for column in &recording.columns {
            match column.values.get(row) {
                Some(value) => write!(to, ",{value:?}")?,
                None => write!(to, ",")?,
            }
        }
        writeln!(to)?;
    }
    Ok(())
}

/// One row group, one required column of doubles for each quantity.
#[cfg(feature = "parquet")]
fn parquet(recording: &Recording, to: &mut (dyn Write + Send)) -> io::Result<()> {
    use std::sync::Arc;

    use parquet::basic::{Repetition, Type as Physical};
    use parquet::data_type::DoubleType;
    use parquet::file::properties::WriterProperties;
    use parquet::file::writer::SerializedFileWriter;
    use parquet::schema::types::Type;

    let fields: Result<Vec<_>, _> = recording
        .headers()
        .map(|header| {
            let field = Type::primitive_type_builder(&header, Physical::DOUBLE);
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
    let columns = recording.columns.iter().map(|column| &column.values);
    for values in std::iter::once(&recording.times).chain(columns) {
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
fn parquet(_: &Recording, _: &mut (dyn Write + Send)) -> io::Result<()> {
    Err(io::Error::new(
        io::ErrorKind::Unsupported,
        "this build of the command has no feature `parquet`",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recording::{Column, Kind};

    fn recording() -> Recording {
        let values = vec![0.1, -1e-300, 1.0 / 3.0];
        Recording {
            times: vec![0.0, 0.5, 1.0],
            columns: vec![Column {
                name: "s1".into(),
                unit: "m".into(),
                kind: Kind::Coordinate,
                values,
            }],
        }
    }

    #[test]
    fn text_reads_back_to_the_same_bits() {
        let mut text = Vec::new();
        csv(&recording(), &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("t [s],s1 [m]"));
        let read: Vec<f64> = lines
            .map(|line| line.split(',').nth(1).unwrap().parse().unwrap())
            .collect();
        assert_eq!(read, recording().columns[0].values);
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
