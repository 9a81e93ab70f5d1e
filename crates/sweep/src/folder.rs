//! A folder of chunks. Each chunk is there completely or not at all, so a sweep can be resumed after any interruption.
//!
//! ```text
//! plan.json            the plan
//! 00000017.parquet     runs [17 L, 18 L): written as .tmp, flushed to disk, renamed
//! lock                 locked while a process works here, with its number
//! ```

use std::collections::BTreeMap;
use std::fmt;
use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::plan::Plan;
use crate::rows::{ColumnType, Rows, Values};
use crate::sweep::{Chunk, Sweep};
use crate::table::{self, Format, Writer};

/// The number of rows in a row group of a Parquet file, whatever the length of chunks.
const GROUP: usize = 65_536;

/// The number of errors that a summary shows.
const SHOWN_ERRORS: usize = 3;

/// Why chunks cannot be stored.
#[derive(Debug)]
pub enum FolderError {
    /// A file cannot be read or written.
    File(PathBuf, io::Error),
    /// Another process uses the folder.
    InUse(String),
    /// The folder holds the chunks of another plan; lists the differences.
    OtherPlan(Vec<String>),
    /// The folder holds no sweep but other files; the name of one.
    OtherFiles(PathBuf, String),
}

impl fmt::Display for FolderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FolderError::File(path, error) => write!(f, "{}: {error}", path.display()),
            FolderError::InUse(by) => write!(f, "another sweep is using the folder ({by})"),
            FolderError::OtherPlan(differences) => {
                write!(f, "{}; --fresh begins again", differences.join("; "))
            }
            FolderError::OtherFiles(path, name) => write!(
                f,
                "the folder {} holds no sweep, but other files, such as `{name}`: name a new or an empty folder",
                path.display()
            ),
        }
    }
}

impl std::error::Error for FolderError {}

/// A folder of chunks, locked.
#[derive(Debug)]
pub struct Folder {
    path: PathBuf,
    format: Format,
    _lock: File,
}

/// The contents of the files of a chunk.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Contents {
    /// The file of rows.
    pub rows: Vec<u8>,
    /// The file of samples, if the plan asks for samples.
    pub samples: Option<Vec<u8>>,
}

/// The contents of the files of a chunk, so that it can be made on one machine and stored on another.
///
/// # Errors
/// If this build lacks the format.
pub fn contents(chunk: &Chunk, format: Format) -> io::Result<Contents> {
    let bytes = |rows: &Rows| {
        let mut bytes = Vec::new();
        write_chunk(format, rows, &mut bytes).map(|()| bytes)
    };
    Ok(Contents {
        rows: bytes(&chunk.rows)?,
        samples: chunk.samples.as_ref().map(bytes).transpose()?,
    })
}

fn write_chunk(format: Format, rows: &Rows, to: &mut (dyn Write + Send)) -> io::Result<()> {
    match format {
        Format::Csv => table::csv_lines(rows, to),
        Format::Parquet => {
            let mut writer = Writer::new(to, rows, &[])?;
            writer.write(rows)?;
            writer.end().map(drop)
        }
    }
}

/// A summary of all chunks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// The number of runs.
    pub runs: u64,
    /// The number of failed runs.
    pub failed: u64,
    /// The first errors, each with the index of its run.
    pub first_errors: Vec<(u64, String)>,
    /// How many runs used which methods, one after the other, if runs chose them: `dop853, taylor`.
    pub methods: BTreeMap<String, u64>,
}

impl Folder {
    /// Opens a folder, or creates it. Several processes may share it if each makes chunks of its own.
    ///
    /// # Errors
    /// If it cannot be opened, another process uses it, or it holds other files and no sweep.
    pub fn open(path: &Path, format: Format, is_shared: bool) -> Result<Folder, FolderError> {
        let at = |error| FolderError::File(path.to_owned(), error);
        fs::create_dir_all(path).map_err(at)?;
        refuse_other_files(path)?;
        let name = path.join("lock");
        let lock = OpenOptions::new()
            .read(true)
            .write(true)
            .create(true)
            .truncate(false)
            .open(&name);
        let mut lock = lock.map_err(|error| FolderError::File(name.clone(), error))?;
        let locked = if is_shared {
            lock.try_lock_shared()
        } else {
            lock.try_lock()
        };
        match locked {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => {
                let by = fs::read_to_string(&name).unwrap_or_default();
                return Err(FolderError::InUse(by.trim().to_owned()));
            }
            Err(TryLockError::Error(error)) => return Err(FolderError::File(name, error)),
        }
        // This text is shown to a process that is refused. The lock itself decides: it ends with its process.
        if !is_shared {
            let _ = lock.set_len(0);
            let _ = writeln!(lock, "process {} on {}", std::process::id(), host());
        }
        let folder = Folder {
            path: path.to_owned(),
            format,
            _lock: lock,
        };
        if !is_shared {
            folder.remove_files(is_partial)?;
        }
        Ok(folder)
    }

    /// The plan of the chunks in the folder, if there is one.
    ///
    /// # Errors
    /// If the file is not a valid plan.
    pub fn plan(&self) -> Result<Option<Plan>, FolderError> {
        let path = self.path.join("plan.json");
        match fs::read_to_string(&path) {
            Ok(text) => {
                let plan = Plan::from_json(&text);
                Ok(Some(plan.map_err(|why| {
                    FolderError::File(path, io::Error::other(why + "; --fresh begins again"))
                })?))
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(FolderError::File(path, error)),
        }
    }

    /// Removes all chunks, and writes a new plan.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn begin(&self, plan: &Plan) -> Result<(), FolderError> {
        self.clear()?;
        let text = plan.to_json() + "\n";
        self.write("plan.json", |to| to.write_all(text.as_bytes()))
    }

    /// Writes a plan if there is none. Other processes may do so at the same time with the same plan.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn begin_shared(&self, plan: &Plan) -> Result<(), FolderError> {
        if self.path.join("plan.json").is_file() {
            Ok(())
        } else {
            let text = plan.to_json() + "\n";
            self.write("plan.json", |to| to.write_all(text.as_bytes()))
        }
    }

    /// The chunks that are there, in ascending order.
    ///
    /// Lists the folder, since a plan may have far more chunks than were ever made.
    pub fn chunks(&self, sweep: &Sweep) -> Vec<u64> {
        let entries = fs::read_dir(&self.path).into_iter().flatten();
        let numbers = entries.filter_map(|entry| {
            let name = entry.ok()?.file_name();
            let (number, _) = name.to_str()?.split_once('.')?;
            number.parse().ok()
        });
        let all = sweep.plan().chunks();
        let mut numbers: Vec<u64> = numbers.filter(|&number| number < all).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers.retain(|&number| self.has_chunk(sweep, number));
        numbers
    }

    /// The number of runs in the chunks that are there.
    pub fn runs(&self, sweep: &Sweep) -> u64 {
        let there = self.chunks(sweep).into_iter();
        let runs = there.map(|chunk| sweep.plan().runs_of(chunk));
        runs.map(|runs| runs.end - runs.start).sum()
    }

    /// Removes the plan and all chunks.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn clear(&self) -> Result<(), FolderError> {
        // The plan goes first: chunks without a plan are never used.
        self.remove_files(|name| name == "plan.json")?;
        self.remove_files(is_chunk)
    }

    /// Whether a chunk is there.
    pub fn has_chunk(&self, sweep: &Sweep, chunk: u64) -> bool {
        let runs = sweep.plan().runs_of(chunk);
        let path = self.chunk(chunk, "");
        let is_there = match self.format {
            Format::Csv => path.is_file(),
            Format::Parquet => table::read(&path, &sweep.empty_rows())
                .is_ok_and(|rows| rows.len() as u64 == runs.end - runs.start),
        };
        is_there && (sweep.empty_samples().is_none() || self.chunk(chunk, ".samples").is_file())
    }

    /// Stores a chunk.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn store(&self, number: u64, chunk: &Chunk) -> Result<(), FolderError> {
        // The file of rows is written last: where it exists the chunk is complete.
        if let Some(samples) = &chunk.samples {
            self.write_rows(&self.name(number, ".samples"), samples)?;
        }
        self.write_rows(&self.name(number, ""), &chunk.rows)
    }

    fn write_rows(&self, name: &str, rows: &Rows) -> Result<(), FolderError> {
        self.write(name, |to| write_chunk(self.format, rows, to))
    }

    /// Stores a chunk that was made elsewhere, with rows and samples as returned by [`contents`].
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn store_contents(&self, number: u64, contents: &Contents) -> Result<(), FolderError> {
        // The file of rows is written last: where it exists the chunk is complete.
        if let Some(samples) = &contents.samples {
            self.write(&self.name(number, ".samples"), |to| to.write_all(samples))?;
        }
        self.write(&self.name(number, ""), |to| to.write_all(&contents.rows))
    }

    /// All rows of the stored chunks in order, and their samples if the plan asks for samples.
    ///
    /// # Errors
    /// Errors of the file system, or a file that does not belong to this sweep.
    pub fn rows(&self, sweep: &Sweep) -> Result<(Rows, Option<Rows>), FolderError> {
        let all = |suffix: &str, empty: Rows| {
            let mut rows = empty.clone();
            for number in 0..sweep.plan().chunks() {
                let path = self.chunk(number, suffix);
                let part = match self.format {
                    Format::Csv => table::read_csv(&path, &empty, false),
                    Format::Parquet => table::read(&path, &empty),
                };
                rows.extend(part.map_err(|error| FolderError::File(path, error))?);
            }
            Ok(rows)
        };
        let samples = sweep.empty_samples().map(|empty| all(".samples", empty));
        Ok((all("", sweep.empty_rows())?, samples.transpose()?))
    }

    /// Reads a chunk.
    ///
    /// # Errors
    /// Errors of the file system.
    fn read(&self, empty: &Rows, number: u64) -> Result<Rows, FolderError> {
        let path = self.chunk(number, "");
        table::read(&path, empty).map_err(|error| FolderError::File(path, error))
    }

    /// A summary of all chunks.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn summary(&self, sweep: &Sweep) -> Result<Summary, FolderError> {
        let mut summary = Summary::default();
        for number in 0..sweep.plan().chunks() {
            match self.format {
                Format::Csv => {
                    let path = self.chunk(number, "");
                    let text = fs::read_to_string(&path);
                    let text = text.map_err(|error| FolderError::File(path, error))?;
                    summary.count_lines(&text, &sweep.empty_rows());
                }
                Format::Parquet => summary.count(&self.read(&sweep.empty_rows(), number)?),
            }
        }
        Ok(summary)
    }

    /// Joins all chunks in order into one file, and their samples into another beside it.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn join(&self, sweep: &Sweep, out: &Path) -> Result<(), FolderError> {
        if let Some(empty) = sweep.empty_samples() {
            self.join_one(sweep, &samples_beside(out), ".samples", empty)?;
        }
        self.join_one(sweep, out, "", sweep.empty_rows())
    }

    fn join_one(
        &self,
        sweep: &Sweep,
        out: &Path,
        suffix: &str,
        empty: Rows,
    ) -> Result<(), FolderError> {
        let chunks = 0..sweep.plan().chunks();
        let mut chunks = chunks.map(|number| self.chunk(number, suffix));
        write_whole(out, |to| match self.format {
            Format::Csv => {
                to.write_all(table::csv_header(&empty).as_bytes())?;
                chunks.try_for_each(|path| io::copy(&mut File::open(path)?, to).map(drop))
            }
            Format::Parquet => {
                let mut writer = Writer::new(to, &empty, &metadata(sweep.plan(), &empty))?;
                let mut waiting = empty.clone();
                for path in chunks {
                    waiting.extend(table::read(&path, &empty)?);
                    while waiting.len() >= GROUP {
                        writer.write(&waiting.take(GROUP))?;
                    }
                }
                if !waiting.is_empty() {
                    writer.write(&waiting)?;
                }
                writer.end().map(drop)
            }
        })
        .map_err(|error| FolderError::File(out.to_owned(), error))
    }

    /// Removes the folder with everything that a sweep has stored there.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn remove(self) -> Result<(), FolderError> {
        self.clear()?;
        self.remove_files(|name| name == "lock")?;
        match fs::remove_dir(&self.path) {
            Ok(()) => Ok(()),
            // The folder also holds files that are not ours.
            Err(error) if error.kind() == io::ErrorKind::DirectoryNotEmpty => Ok(()),
            Err(error) => Err(FolderError::File(self.path.clone(), error)),
        }
    }

    fn name(&self, number: u64, suffix: &str) -> String {
        format!("{number:08}{suffix}.{}", self.format.extension())
    }

    fn chunk(&self, number: u64, suffix: &str) -> PathBuf {
        self.path.join(self.name(number, suffix))
    }

    /// Writes a file under a temporary name and renames it when it is complete and flushed to disk.
    fn write(
        &self,
        name: &str,
        content: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
    ) -> Result<(), FolderError> {
        let path = self.path.join(name);
        let partial = self.path.join(format!("{name}.{}.tmp", std::process::id()));
        let written = write_as(&partial, &path, content);
        written.map_err(|error| FolderError::File(path, error))
    }

    /// Removes the files that are meant.
    fn remove_files(&self, is_meant: impl Fn(&str) -> bool) -> Result<(), FolderError> {
        let at = |error| FolderError::File(self.path.clone(), error);
        for entry in fs::read_dir(&self.path).map_err(at)? {
            let entry = entry.map_err(at)?;
            if entry.file_name().to_str().is_some_and(&is_meant) {
                let path = entry.path();
                fs::remove_file(&path).map_err(|error| FolderError::File(path, error))?;
            }
        }
        Ok(())
    }
}

impl Summary {
    fn count(&mut self, rows: &Rows) {
        self.runs += rows.len() as u64;
        if let Some(Values::Text(methods)) = rows.column("methods") {
            methods.iter().flatten().for_each(|of| self.add_methods(of));
        }
        let (Some(Values::Text(errors)), Some(Values::Count(runs))) =
            (rows.column("error"), rows.column("run"))
        else {
            return;
        };
        for (run, error) in runs.iter().zip(errors) {
            if let Some(error) = error {
                self.add(*run, error);
            }
        }
    }

    fn count_lines(&mut self, text: &str, like: &Rows) {
        let place = |name: &str| {
            let mut columns = like.columns.iter();
            // Varied quantities, which may have any name, are numbers.
            columns.position(|column| column.name == name && column.kind == ColumnType::Text)
        };
        let (place, of_methods) = (place("error"), place("methods"));
        for row in table::csv_cells(text).unwrap_or_default() {
            self.runs += 1;
            let methods = of_methods.and_then(|place| row.get(place));
            if let Some(methods) = methods.filter(|methods| !methods.is_empty()) {
                self.add_methods(methods);
            }
            let error = place.and_then(|place| row.get(place));
            if let Some(error) = error.filter(|error| !error.is_empty()) {
                let run = row.first().and_then(|run| run.parse().ok());
                self.add(run.unwrap_or(0), error);
            }
        }
    }

    /// Counts the methods of a run, without the times and reasons of their choice.
    fn add_methods(&mut self, methods: &str) {
        let names = methods.split(", ");
        let names = names.map(|one| one.split(' ').next().unwrap_or_default());
        let names: Vec<&str> = names.collect();
        *self.methods.entry(names.join(", ")).or_default() += 1;
    }

    fn add(&mut self, run: u64, error: &str) {
        self.failed += 1;
        if self.first_errors.len() < SHOWN_ERRORS {
            self.first_errors.push((run, error.to_owned()));
        }
    }
}

/// The path of the file of samples for a file of rows: `a.samples.parquet` for `a.parquet`.
pub fn samples_beside(out: &Path) -> PathBuf {
    let ending = out.extension().unwrap_or_default().to_string_lossy();
    out.with_extension(format!("samples.{ending}"))
}

/// The metadata of a file: the plan without the length of chunks, and the units of the columns.
fn metadata(plan: &Plan, rows: &Rows) -> Vec<(&'static str, String)> {
    let mut plan = serde_json::to_value(plan).unwrap_or_default();
    if let Some(plan) = plan.as_object_mut() {
        plan.shift_remove("chunk");
    }
    let units = rows.columns.iter().filter_map(|column| {
        let unit = column.unit.clone()?;
        Some((column.name.clone(), serde_json::Value::from(unit)))
    });
    let units = serde_json::Value::Object(units.collect());
    vec![
        ("lagrangian.plan", plan.to_string()),
        ("lagrangian.units", units.to_string()),
    ]
}

fn is_chunk(name: &str) -> bool {
    let stem = name.split_once('.').filter(|(stem, ending)| {
        let endings = ["csv", "parquet", "samples.csv", "samples.parquet"];
        stem.len() >= 8 && endings.contains(ending)
    });
    stem.is_some_and(|(stem, _)| stem.bytes().all(|byte| byte.is_ascii_digit()))
}

/// Whether a file is one that a process that was killed has not completed.
fn is_partial(name: &str) -> bool {
    let name = name.strip_suffix(".tmp");
    let name = name.and_then(|name| name.rsplit_once('.'));
    name.is_some_and(|(name, process)| {
        (name == "plan.json" || is_chunk(name)) && process.bytes().all(|byte| byte.is_ascii_digit())
    })
}

/// Refuses a folder that is used for something else: it has no plan, and files that no sweep writes.
fn refuse_other_files(path: &Path) -> Result<(), FolderError> {
    let at = |error| FolderError::File(path.to_owned(), error);
    if path.join("plan.json").is_file() {
        return Ok(());
    }
    for entry in fs::read_dir(path).map_err(at)? {
        let name = entry.map_err(at)?.file_name();
        let name = name.to_string_lossy();
        // File managers leave hidden files in folders that are empty for their users.
        let is_hidden = name.starts_with('.');
        if !is_hidden && name != "lock" && !is_chunk(&name) && !is_partial(&name) {
            return Err(FolderError::OtherFiles(path.to_owned(), name.into_owned()));
        }
    }
    Ok(())
}

/// Writes a file under a temporary name beside its destination, which it replaces when it is complete.
fn write_whole(
    path: &Path,
    content: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<()> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".tmp");
    write_as(Path::new(&partial), path, content)
}

fn write_as(
    partial: &Path,
    path: &Path,
    content: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<()> {
    let attempt = || {
        let mut file = BufWriter::with_capacity(1 << 16, File::create(partial)?);
        content(&mut file)?;
        file.into_inner()
            .map_err(|error| error.into_error())?
            .sync_all()?;
        fs::rename(partial, path)
    };
    let written = attempt();
    if written.is_err() {
        let _ = fs::remove_file(partial); // a file that does not exist need not be removed
    }
    written?;
    // Flushes the folder too, so that the new name is on disk, where the system supports that.
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    let _ = File::open(folder.unwrap_or(Path::new("."))).and_then(|folder| folder.sync_all());
    Ok(())
}

/// The name of this computer, for messages only.
fn host() -> String {
    let name = fs::read_to_string("/etc/hostname").unwrap_or_default();
    match name.trim() {
        "" => "this host".to_owned(),
        name => name.to_owned(),
    }
}
