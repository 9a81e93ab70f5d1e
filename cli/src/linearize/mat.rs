//! Writer of `.mat` files: MATLAB variables in level 5 format, without compression (The MathWorks, *MAT-File Format*, R2023a,
//! chapter 1). Text is stored as a column of cells.

use super::arrays::{Array, Content};

/// Data types, tables 1-1 and 1-3.
const INT8: u32 = 1;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
const CELL_CLASS: u32 = 1;
const CHAR_CLASS: u32 = 4;
const DOUBLE_CLASS: u32 = 6;

/// The bytes of the file.
pub fn bytes(arrays: &[Array]) -> Vec<u8> {
    // A text of 116 bytes, 8 unused bytes, the version, and the byte order mark.
    let mut bytes = format!("{:<116}", "MATLAB 5.0 MAT-file, written by lagrangian").into_bytes();
    bytes.extend([0; 8]);
    bytes.extend(0x0100_u16.to_le_bytes());
    bytes.extend(b"IM");
    for Array { name, content } in arrays {
        bytes.extend(match content {
            Content::Matrix(matrix) => {
                let columns: Vec<f64> = matrix.iter().copied().collect();
                numbers(name, (matrix.nrows(), matrix.ncols()), &columns)
            }
            Content::Vector(values) => numbers(name, (values.len(), 1), values),
            Content::Text(texts) => {
                let mut content = head(name, CELL_CLASS, (texts.len(), 1));
                for text in texts {
                    let letters: Vec<u16> = text.encode_utf16().collect();
                    let rows = usize::from(!letters.is_empty());
                    let mut cell = head("", CHAR_CLASS, (rows, letters.len()));
                    let letters: Vec<u8> = letters.into_iter().flat_map(u16::to_le_bytes).collect();
                    cell.extend(element(UINT16, &letters));
                    content.extend(element(MATRIX, &cell));
                }
                element(MATRIX, &content)
            }
        });
    }
    bytes
}

/// A matrix of numbers, stored by column.
fn numbers(name: &str, shape: (usize, usize), columns: &[f64]) -> Vec<u8> {
    let mut content = head(name, DOUBLE_CLASS, shape);
    let data: Vec<u8> = columns.iter().flat_map(|x| x.to_le_bytes()).collect();
    content.extend(element(DOUBLE, &data));
    element(MATRIX, &content)
}

/// The fields before the data of an array: its class, its shape, its name.
fn head(name: &str, class: u32, (rows, columns): (usize, usize)) -> Vec<u8> {
    let flags: Vec<u8> = [class, 0].into_iter().flat_map(u32::to_le_bytes).collect();
    let shape = [rows, columns].map(|count| count as i32);
    let shape: Vec<u8> = shape.into_iter().flat_map(i32::to_le_bytes).collect();
    [
        element(UINT32, &flags),
        element(INT32, &shape),
        element(INT8, name.as_bytes()),
    ]
    .concat()
}

/// Data preceded by its type and length, and padded to 8 bytes.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(data.len() + 16);
    bytes.extend(kind.to_le_bytes());
    bytes.extend((data.len() as u32).to_le_bytes());
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}
