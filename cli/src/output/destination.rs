//! An output file: checked before a run, and afterwards either complete or unchanged.
//!
//! The content is written to a temporary file in the same folder, which is renamed when it is complete and flushed to
//! disk. If the command ends before, a file of that name is the old one, or there is none.

use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

use super::ending::{self, Endings, SVG};
use super::{FAILED, IS_TAKEN, RedirectedOutput};
use crate::failure::Failure;

/// The most symbolic links that are followed, as in Linux.
const MOST_LINKS: usize = 40;

/// The destination of an output.
#[derive(Debug)]
pub struct Destination {
    /// The option that names it.
    option: &'static str,
    /// The path as given in the call.
    path: PathBuf,
    ending: &'static str,
    target: Target,
    identity: Option<Identity>,
}

#[derive(Debug)]
enum Target {
    /// A regular file, existing or not, after resolving all links.
    File(PathBuf),
    /// A device or a pipe, which is written directly.
    Device,
    /// Standard output, by one of its names.
    Output,
    /// Standard error.
    Error,
}

/// The identity of a file: two paths lead to the same file if these are equal.
#[derive(Debug, PartialEq, Eq)]
enum Identity {
    /// An existing file: device and inode.
    #[cfg(unix)]
    Inode(u64, u64),
    /// A new file: the canonical path of its folder, and its name.
    Path(PathBuf),
    /// Standard output or standard error.
    Stream(&'static str),
}

impl Destination {
    /// Checks whether the path given by an option can be written, and has a known extension. Nothing is changed.
    ///
    /// # Errors
    /// If the path cannot be written, or the extension is not among those given, the call is invalid.
    pub fn new(
        option: &'static str,
        path: &Path,
        endings: Endings,
    ) -> Result<Destination, Failure> {
        let known = ending::known(path, endings);
        let (target, identity) = place(path).map_err(|why| refused(option, path, &why))?;
        let ending = match (known, &target) {
            (Some(ending), _) => ending,
            (None, Target::File(_)) if !endings.is_empty() => {
                return Err(ending::unknown(option, path, endings));
            }
            (None, _) => endings.first().copied().unwrap_or(""),
        };
        if let Target::File(path_of_file) = &target {
            try_folder(path_of_file).map_err(|why| refused(option, path, &why))?;
        }
        Ok(Destination {
            option,
            path: path.to_owned(),
            ending,
            target,
            identity,
        })
    }

    /// The destination of an optional option.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn of(
        option: &'static str,
        path: Option<&PathBuf>,
        endings: Endings,
    ) -> Result<Option<Destination>, Failure> {
        path.map(|path| Destination::new(option, path, endings))
            .transpose()
    }

    /// The destinations of `--out` and `--plot`, which are not where a document of `--json` goes.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new), or if a file and the document would be mixed.
    pub fn out_and_plot(
        (out, endings): (Option<&PathBuf>, Endings),
        plot: Option<&PathBuf>,
        is_document: bool,
    ) -> Result<[Option<Destination>; 2], Failure> {
        let files = [
            Destination::of("--out", out, endings)?,
            Destination::of("--plot", plot, SVG)?,
        ];
        keep_document_apart(files.iter().flatten(), is_document)?;
        Ok(files)
    }

    /// The extension, one of those that the option accepts.
    pub fn ending(&self) -> &'static str {
        self.ending
    }

    /// The path after resolving all links, if it is a regular file and not a device.
    pub fn file(&self) -> Option<&Path> {
        match &self.target {
            Target::File(path) => Some(path),
            Target::Device | Target::Output | Target::Error => None,
        }
    }

    /// Writes a text.
    ///
    /// # Errors
    /// The errors of [`write`](Self::write).
    pub fn write_text(&self, text: &str) -> Result<(), Failure> {
        self.write(|to| to.write_all(text.as_bytes()))
    }

    /// Writes what `content` writes. The new file replaces the old one only when it is complete and on disk.
    ///
    /// # Errors
    /// Errors of the file system; the old file is then unchanged.
    pub fn write(
        &self,
        content: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
    ) -> Result<(), Failure> {
        self.write_with_mode(0o666, content)
    }

    /// Writes an executable file, with the permissions that linkers give to libraries.
    ///
    /// # Errors
    /// The errors of [`write`](Self::write).
    pub fn write_executable(&self, bytes: &[u8]) -> Result<(), Failure> {
        self.write_with_mode(0o777, |to| to.write_all(bytes))
    }

    fn write_with_mode(
        &self,
        mode: u32,
        content: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let written = match &self.target {
            Target::File(path) => replace(path, mode, content),
            Target::Device => {
                let device = OpenOptions::new().write(true).open(&self.path);
                device.and_then(|device| buffered(device, content).map(drop))
            }
            Target::Output => {
                IS_TAKEN.store(true, Ordering::Relaxed);
                match buffered(RedirectedOutput, content) {
                    // The error is reported once, at the end.
                    Err(_) if FAILED.get().is_some() => Ok(()),
                    written => written.map(drop),
                }
            }
            Target::Error => buffered(io::stderr(), content).map(drop),
        };
        written
            .map_err(|error| Failure::Run(format!("cannot write {}: {error}", self.path.display())))
    }
}

/// Refuses a file that two options name, or that the command also reads; each is given with its description.
///
/// # Errors
/// If there is such a file, the call is invalid.
pub fn keep_apart<'a>(
    destinations: impl IntoIterator<Item = &'a Destination>,
    read: &[(&Path, &str)],
) -> Result<(), Failure> {
    let destinations: Vec<&Destination> = destinations.into_iter().collect();
    for (k, destination) in destinations.iter().enumerate() {
        let Destination { option, path, .. } = destination;
        let path = path.display();
        let Some(identity) = &destination.identity else {
            continue;
        };
        let mut before = destinations.iter().take(k);
        if let Some(other) = before.find(|other| other.identity.as_ref() == Some(identity)) {
            return Err(Failure::Call(format!(
                "{} {} and {option} {path} are the same file",
                other.option,
                other.path.display(),
            )));
        }
        let is_read = |(read, _): &&(&Path, &str)| identity_of(read).as_ref() == Some(identity);
        if let Some((read, what)) = read.iter().find(is_read) {
            return Err(Failure::Call(format!(
                "{option} {path} would overwrite {}, {what}",
                read.display()
            )));
        }
    }
    Ok(())
}

/// Refuses standard output as a file if the result is a JSON document, which must be alone there.
///
/// # Errors
/// If so, the call is invalid.
pub fn keep_document_apart<'a>(
    destinations: impl IntoIterator<Item = &'a Destination>,
    json: bool,
) -> Result<(), Failure> {
    let mut destinations = destinations.into_iter();
    match destinations.find(|destination| json && matches!(destination.target, Target::Output)) {
        None => Ok(()),
        Some(Destination { option, path, .. }) => Err(Failure::Call(format!(
            "{option} {} is standard output, where --json prints its document",
            path.display()
        ))),
    }
}

fn refused(option: &str, path: &Path, why: &str) -> Failure {
    Failure::Call(format!("cannot write {option} {}: {why}", path.display()))
}

/// The target of a path, which may not exist yet.
fn place(path: &Path) -> Result<(Target, Option<Identity>), String> {
    let end = end_of_links(path);
    for (name, target) in [("stdout", Target::Output), ("stderr", Target::Error)] {
        let number = if name == "stdout" { "1" } else { "2" };
        let names = ["/dev/", "/dev/fd/", "/proc/self/fd/"].into_iter();
        let mut names = names.zip([name, number, number]);
        if names.any(|(folder, name)| end == Path::new(&format!("{folder}{name}"))) {
            return Ok((target, Some(Identity::Stream(name))));
        }
    }
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err("it is a folder".to_owned()),
        Ok(found) if found.is_file() => {
            if is_standard_output(&found) {
                return Err("standard output goes to the same file".to_owned());
            }
            let path = path.canonicalize().map_err(|error| error.to_string())?;
            // A file without write permission is not replaced either.
            let opened = OpenOptions::new().write(true).open(&path);
            opened.map_err(|error| error.to_string())?;
            let identity = identity_of(&path);
            Ok((Target::File(path), identity))
        }
        // Several outputs may go to /dev/null or a terminal, but the reader of a pipe expects only one.
        Ok(found) => Ok((
            Target::Device,
            identity_of(path).filter(|_| is_pipe(&found)),
        )),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let path = new_file(&end)?;
            Ok((Target::File(path.clone()), Some(Identity::Path(path))))
        }
        Err(error) => Err(error.to_string()),
    }
}

/// The target of a path after following symbolic links, as far as they lead. Links to open files are kept as names.
fn end_of_links(path: &Path) -> PathBuf {
    let mut path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    for _ in 0..MOST_LINKS {
        if path.starts_with("/dev/fd") || path.starts_with("/proc/self/fd") {
            break;
        }
        if path == Path::new("/dev/stdout") || path == Path::new("/dev/stderr") {
            break;
        }
        let Ok(next) = fs::read_link(&path) else {
            break;
        };
        path = path.parent().unwrap_or(Path::new("")).join(next);
    }
    path
}

/// The path of a file that does not exist yet, with the canonical path of its folder.
fn new_file(path: &Path) -> Result<PathBuf, String> {
    let is_folder = path.as_os_str().as_encoded_bytes().ends_with(b"/");
    let name = path.file_name().filter(|_| !is_folder);
    let name = name.ok_or_else(|| "it is the name of a folder".to_owned())?;
    let folder = path.parent().unwrap_or(Path::new("/"));
    let folder = folder.canonicalize().map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => format!("there is no folder {}", folder.display()),
        _ => error.to_string(),
    })?;
    Ok(folder.join(name))
}

#[cfg(unix)]
fn is_pipe(found: &fs::Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    found.file_type().is_fifo()
}

#[cfg(not(unix))]
fn is_pipe(_: &fs::Metadata) -> bool {
    false
}

/// The identity of an existing file.
#[cfg(unix)]
fn identity_of(path: &Path) -> Option<Identity> {
    fs::metadata(path).ok().as_ref().map(inode)
}

#[cfg(unix)]
fn inode(found: &fs::Metadata) -> Identity {
    use std::os::unix::fs::MetadataExt;
    Identity::Inode(found.dev(), found.ino())
}

/// The identity of an existing file; hard links are not recognized.
#[cfg(not(unix))]
fn identity_of(path: &Path) -> Option<Identity> {
    path.canonicalize().ok().map(Identity::Path)
}

#[cfg(unix)]
fn is_standard_output(found: &fs::Metadata) -> bool {
    use std::os::fd::AsFd;
    let handle = io::stdout().as_fd().try_clone_to_owned();
    let metadata = handle.and_then(|handle| File::from(handle).metadata());
    metadata.is_ok_and(|metadata| inode(&metadata) == inode(found))
}

#[cfg(not(unix))]
fn is_standard_output(_: &fs::Metadata) -> bool {
    false
}

fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new("/"))
}

/// Checks whether a file can be created in the folder of this path.
fn try_folder(path: &Path) -> Result<(), String> {
    let folder = folder_of(path);
    match temporary(folder, 0o600) {
        Ok(_) => Ok(()), // the temporary file has been removed
        Err(error) => Err(format!(
            "no file can be created in the folder {}: {error}",
            folder.display()
        )),
    }
}

/// A temporary file with a unique, hidden name.
fn temporary(folder: &Path, mode: u32) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".lagrangian-").suffix(".partial");
    if let Some(permissions) = permissions(mode) {
        builder.permissions(permissions);
    }
    builder.tempfile_in(folder)
}

/// The permissions of a new file, within the user's umask.
#[cfg(unix)]
fn permissions(mode: u32) -> Option<Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(Permissions::from_mode(mode))
}

#[cfg(not(unix))]
fn permissions(_: u32) -> Option<Permissions> {
    None
}

/// Writes a temporary file and renames it when it is complete and on disk.
fn replace(
    path: &Path,
    mode: u32,
    content: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<()> {
    let folder = folder_of(path);
    let (file, part) = temporary(folder, mode)?.into_parts();
    let file = buffered(file, content)?;
    if let Ok(older) = fs::metadata(path) {
        keep_owner(&file, &older);
        file.set_permissions(older.permissions())?;
    }
    file.sync_all()?;
    drop(file);
    if let Err(failed) = part.persist(path) {
        // The file is complete but could not be renamed: it must not be lost.
        let error = failed.error;
        return match failed.path.keep() {
            Ok(kept) => Err(io::Error::other(format!(
                "{error}; it is complete as {}",
                kept.display()
            ))),
            Err(_) => Err(error),
        };
    }
    // Flushes the folder too, so that the new name is on disk, where the system supports that.
    let _ = File::open(folder).and_then(|folder| folder.sync_all());
    Ok(())
}

/// Keeps the owner of the old file, as far as the user may.
#[cfg(unix)]
fn keep_owner(file: &File, older: &fs::Metadata) {
    use std::os::unix::fs::{MetadataExt, fchown};
    let owner = file.metadata().map(|owner| (owner.uid(), owner.gid()));
    if owner.is_ok_and(|owner| owner == (older.uid(), older.gid())) {
        return;
    }
    if fchown(file, Some(older.uid()), Some(older.gid())).is_err() {
        let _ = fchown(file, None, Some(older.gid()));
    }
}

#[cfg(not(unix))]
fn keep_owner(_: &File, _: &fs::Metadata) {}

/// Writes through a buffer, and returns the file when everything has been written.
fn buffered<W: Write + Send>(
    to: W,
    content: impl FnOnce(&mut (dyn Write + Send)) -> io::Result<()>,
) -> io::Result<W> {
    let mut buffer = BufWriter::with_capacity(1 << 16, to);
    content(&mut buffer)?;
    buffer.flush()?;
    buffer.into_inner().map_err(|error| error.into_error())
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    const ANY: Endings = &["txt"];

    fn folder() -> tempfile::TempDir {
        tempfile::tempdir().unwrap()
    }

    fn at(path: &Path) -> Destination {
        Destination::new("--out", path, ANY).unwrap()
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    }

    #[test]
    fn what_fails_leaves_the_older_file_and_nothing_else() {
        let folder = folder();
        let path = folder.path().join("a.txt");
        fs::write(&path, "older").unwrap();
        let destination = at(&path);
        assert_eq!(names(folder.path()), ["a.txt"]); // the trial file has been removed
        let failed = destination.write(|to| {
            to.write_all(b"half")?;
            // Readers see the old file up to this point.
            assert_eq!(fs::read_to_string(&path).unwrap(), "older");
            Err(io::Error::from(io::ErrorKind::StorageFull))
        });
        assert!(failed.is_err());
        assert_eq!(fs::read_to_string(&path).unwrap(), "older");
        assert_eq!(names(folder.path()), ["a.txt"]);
        destination.write_text("newer").unwrap();
        assert_eq!(fs::read_to_string(&path).unwrap(), "newer");
        assert_eq!(names(folder.path()), ["a.txt"]);
    }

    #[test]
    fn permissions_are_those_of_the_older_file_or_of_a_new_one() {
        let folder = folder();
        let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o7777;
        let (plain, new) = (folder.path().join("plain"), folder.path().join("new.txt"));
        fs::write(&plain, "").unwrap();
        at(&new).write_text("x").unwrap();
        assert_eq!(mode(&new), mode(&plain));
        for kept in [0o600, 0o640, 0o755] {
            fs::set_permissions(&new, Permissions::from_mode(kept)).unwrap();
            at(&new).write_text("y").unwrap();
            assert_eq!(mode(&new), kept);
        }
    }

    #[test]
    fn a_link_stays_a_link() {
        let folder = folder();
        let (file, link) = (
            folder.path().join("file.txt"),
            folder.path().join("link.txt"),
        );
        symlink("file.txt", &link).unwrap();
        for text in ["first", "second"] {
            at(&link).write_text(text).unwrap();
            assert_eq!(fs::read_to_string(&file).unwrap(), text);
            assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        }
    }

    #[test]
    fn one_file_has_many_names() {
        let folder = folder();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("a.txt"), "").unwrap();
        fs::hard_link(path("a.txt"), path("hard.txt")).unwrap();
        symlink("a.txt", path("soft.txt")).unwrap();
        symlink("later.txt", path("dangling.txt")).unwrap();
        fs::create_dir(path("sub")).unwrap();
        let same = [
            ["a.txt", "a.txt"],
            ["a.txt", "sub/../a.txt"],
            ["a.txt", "hard.txt"],
            ["soft.txt", "hard.txt"],
            ["new.txt", "./new.txt"],
            ["new.txt", "sub/../new.txt"],
            ["dangling.txt", "later.txt"],
        ];
        for [one, other] in same {
            let pair = [at(&path(one)), at(&path(other))];
            assert!(keep_apart(&pair, &[]).is_err(), "{one} {other}");
        }
        for [one, other] in [["a.txt", "b.txt"], ["new.txt", "sub/new.txt"]] {
            let pair = [at(&path(one)), at(&path(other))];
            assert!(keep_apart(&pair, &[]).is_ok(), "{one} {other}");
        }
        for name in ["a.txt", "hard.txt", "soft.txt"] {
            let read = path("sub/../a.txt");
            let read = [(read.as_path(), "the spec")];
            assert!(keep_apart(&[at(&path(name))], &read).is_err());
        }
    }

    #[test]
    fn what_cannot_be_written_is_refused_before() {
        let folder = folder();
        let path = |name: &str| folder.path().join(name);
        fs::create_dir(path("folder.txt")).unwrap();
        for name in [
            "folder.txt",
            "missing/a.txt",
            "new.txt/",
            "",
            "..",
            "a.json",
        ] {
            assert!(
                Destination::new("--out", &path(name), ANY).is_err(),
                "{name}"
            );
        }
        assert_eq!(names(folder.path()), ["folder.txt"]);
    }

    #[test]
    fn devices_are_written_as_they_are() {
        let null = Path::new("/dev/null");
        let two = [at(null), at(null)];
        assert!(keep_apart(&two, &[]).is_ok());
        two[0].write_text("x").unwrap();
        let full = at(Path::new("/dev/full"));
        assert!(full.write_text("x").is_err());
        let output = at(Path::new("/dev/stdout"));
        assert!(keep_apart(&[at(Path::new("/dev/fd/1")), output], &[]).is_err());
    }
}
