//! The archive of a unit. Its files are stored uncompressed: a unit has some tens of kilobytes, and compression would need
//! four more crates.

use std::io::{self, Cursor, Write};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

/// A file in the archive.
pub struct Entry {
    /// Its path, with `/` between names.
    pub name: String,
    /// Its bytes.
    pub content: Vec<u8>,
}

impl Entry {
    /// A file of text.
    pub fn text(name: &str, content: String) -> Entry {
        Entry {
            name: name.to_owned(),
            content: content.into_bytes(),
        }
    }
}

/// The archive.
///
/// # Errors
/// If it exceeds the size limit of an archive.
pub fn bytes(entries: &[Entry]) -> io::Result<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    // No time stamps, so that one machine always gives the same bytes.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default());
    for entry in entries {
        archive.start_file(entry.name.as_str(), options)?;
        archive.write_all(&entry.content)?;
    }
    Ok(archive.finish()?.into_inner())
}
