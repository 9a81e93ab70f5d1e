//! Writer of `.npz` files: an archive of NumPy arrays in `.npy` format version 1.0 (NumPy, *NEP 1 — A simple file format
//! for NumPy arrays*, 2007). Text has fixed width, so that it can be read without pickle.

use std::io::{self, Cursor, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::arrays::{Array, Content};

/// The bytes of the archive.
///
/// # Errors
/// If it exceeds the size limit of an archive.
pub fn bytes(arrays: &[Array]) -> io::Result<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    // No time stamps, so that one model always gives the same bytes.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default());
    for array in arrays {
        archive.start_file(format!("{}.npy", array.name), options)?;
        archive.write_all(&npy(&array.content))?;
    }
    Ok(archive.finish()?.into_inner())
}

/// The bytes of one array.
fn npy(content: &Content) -> Vec<u8> {
    let (kind, shape, data) = match content {
        Content::Matrix(matrix) => {
            let rows = matrix.row_iter();
            let data = rows.flat_map(|row| {
                row.iter()
                    .flat_map(|x| x.to_le_bytes())
                    .collect::<Vec<u8>>()
            });
            let shape = format!("({}, {})", matrix.nrows(), matrix.ncols());
            ("<f8".to_owned(), shape, data.collect::<Vec<u8>>())
        }
        Content::Vector(values) => {
            let data = values.iter().flat_map(|x| x.to_le_bytes());
            (
                "<f8".to_owned(),
                format!("({},)", values.len()),
                data.collect(),
            )
        }
        Content::Text(texts) => {
            let width = texts.iter().map(|text| text.chars().count()).max();
            let width = width.unwrap_or(0).max(1);
            let letters = texts.iter().flat_map(|text| {
                let letters = text.chars().map(u32::from).chain(std::iter::repeat(0));
                letters.take(width).flat_map(u32::to_le_bytes)
            });
            (
                format!("<U{width}"),
                format!("({},)", texts.len()),
                letters.collect(),
            )
        }
    };
    let mut header = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': {shape}, }}");
    // Magic, version and length take 10 bytes; the total is a multiple of 64 and ends with a line break.
    let padding = 63 - (10 + header.len()) % 64;
    header.push_str(&" ".repeat(padding));
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    // A header has only some dozens of characters.
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.bytes());
    bytes.extend(data);
    bytes
}
