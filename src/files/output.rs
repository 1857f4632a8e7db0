//! Writes files: regular files are replaced whole, anything else is written to.
use crate::error::FileError;
use crate::identity::{Identity, special};
use crate::patient::Patient;
use crate::read::{Seen, read};
use crate::temporary;
use crate::used::Used;
use std::{
    fs::{self, File, Metadata, OpenOptions},
    io::{self, Write},
    path::{Path, PathBuf},
};

/// The files of one command: what it reads and what it will write. It refuses an output that is an input, and two outputs that are one
/// file, before anything is computed.
#[derive(Debug, Default)]
pub struct Outputs {
    used: Used,
}

/// Where one output goes.
#[derive(Debug)]
pub struct Target {
    /// As the user gave it.
    path: PathBuf,
    kind: Kind,
}

#[derive(Debug)]
enum Kind {
    Standard,
    /// A device, FIFO or socket: written to.
    Stream,
    /// A regular file at `place`, links followed: replaced. `before` is its state when the command began, `None` where it did not exist.
    Regular {
        place: PathBuf,
        before: Option<Seen>,
    },
}

impl Outputs {
    /// Without any files yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// A file that the command reads: no output may replace it.
    pub fn input(&mut self, path: &Path) {
        if path == Path::new("-") {
            return;
        }
        let metadata = fs::metadata(path).ok();
        if metadata.as_ref().is_some_and(|metadata| special(metadata).is_some()) {
            return;
        }
        let identity = metadata.map(|metadata| Identity::of(path, &metadata));
        self.used
            .add(resolved(path), identity, "also an input of this command".to_owned());
    }

    /// Standard output, where `what` goes: no output option may name it too.
    pub fn standard(&mut self, what: &str) {
        self.used
            .add(PathBuf::from("-"), None, format!("also where {what} goes"));
    }

    /// The file next to `original` that keeps it, named as it is with `.bak` behind; `option` asked for it.
    ///
    /// # Errors
    /// As of [`Self::output`].
    pub fn backup(&mut self, option: &str, original: &Path) -> Result<Target, FileError> {
        let mut path = original.as_os_str().to_owned();
        path.push(".bak");
        self.output(option, Path::new(&path))
    }

    /// An output named by `option` (`-o`, `--certificate`); `-` is standard output. Files that killed runs left next to it are removed.
    ///
    /// # Errors
    /// It is an input, or the file of another output; it is a folder; its folder does not exist; it cannot be replaced (read-only,
    /// several hard links, another owner).
    pub fn output(&mut self, option: &str, path: &Path) -> Result<Target, FileError> {
        let target = Target::new(path)?;
        let clash = |what: &str| {
            let shown = match target.kind {
                Kind::Standard => Path::new("standard output"),
                _ => path,
            };
            FileError::new(
                shown,
                format!("{option} names a file that is {what}; nothing was written, name another file"),
            )
        };
        match &target.kind {
            Kind::Stream => {}
            Kind::Standard => {
                if let Some(other) = self.used.role(Path::new("-"), None) {
                    return Err(clash(other));
                }
                self.used
                    .add(PathBuf::from("-"), None, format!("also the output of {option}"));
            }
            Kind::Regular { place, before } => {
                let identity = before.as_ref().map(|seen| &seen.identity);
                if let Some(other) = self.used.role(place, identity) {
                    return Err(clash(other));
                }
                self.used
                    .add(place.clone(), identity.cloned(), format!("also the output of {option}"));
            }
        }
        Ok(target)
    }
}

/// The path after links are followed, also where the file does not exist yet.
fn resolved(path: &Path) -> PathBuf {
    let mut path = path.to_owned();
    // a broken link: its target will be created
    for _ in 0..40 {
        let Ok(to) = fs::read_link(&path) else { break };
        path = folder_of(&path).join(to);
    }
    match (fs::canonicalize(folder_of(&path)), path.file_name()) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path,
    }
}

fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

impl Target {
    /// Examines what `path` points to.
    fn new(path: &Path) -> Result<Self, FileError> {
        let path = path.to_owned();
        if path == Path::new("-") {
            let kind = Kind::Standard;
            return Ok(Self { path, kind });
        }
        let kind = match fs::metadata(&path) {
            Ok(metadata) => match special(&metadata) {
                Some(kind @ "a folder") => {
                    return Err(FileError::new(&path, format!("is {kind}; name a file in it")));
                }
                Some(_) => Kind::Stream,
                None => {
                    let place =
                        fs::canonicalize(&path).map_err(|error| FileError::io(&path, "find the file", &error))?;
                    replaceable(&path, &place, &metadata)?;
                    Kind::Regular {
                        before: Some(Seen::of(&place, &metadata)),
                        place,
                    }
                }
            },
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                let place = resolved(&path);
                if !folder_of(&place).is_dir() {
                    let folder = folder_of(&place).display();
                    return Err(FileError::new(
                        &path,
                        format!("cannot be written: there is no folder {folder}"),
                    ));
                }
                Kind::Regular { place, before: None }
            }
            Err(error) => return Err(FileError::io(&path, "write the file", &error)),
        };
        if let Kind::Regular { place, .. } = &kind {
            temporary::sweep(folder_of(place));
        }
        Ok(Self { path, kind })
    }

    /// The file itself, read before as `seen` with the bytes `read`, to be replaced in place.
    ///
    /// # Errors
    /// It changed since; it cannot be replaced, as in [`Outputs::output`].
    pub fn in_place(path: &Path, seen: &Seen, read: &[u8]) -> Result<Self, FileError> {
        let mut target = Self::new(path)?;
        let Kind::Regular { before, .. } = &mut target.kind else {
            return Err(FileError::new(
                path,
                "is not a regular file and was not replaced; use -o FILE",
            ));
        };
        *before = Some(seen.clone());
        target.unchanged(Some(read))?;
        Ok(target)
    }

    /// Whether this is standard output.
    pub fn is_standard_output(&self) -> bool {
        matches!(self.kind, Kind::Standard)
    }

    /// Writes all of `bytes`, as [`Self::fill`]. With `read`, the file must still hold these bytes.
    ///
    /// # Errors
    /// As of [`Self::fill`].
    pub fn write(&self, bytes: &[u8], read: Option<&[u8]>) -> Result<(), FileError> {
        self.written(read, |out| {
            // the writer keeps its errors for the end
            let _ = out.write_all(bytes);
            Ok(())
        })
    }

    /// Writes what `fill` puts, while it does. A regular file is replaced whole, when all is there: its content is the old one or the new one
    /// at any moment. `fill` sees no errors of writing.
    ///
    /// # Errors
    /// That of `fill`, or one of writing. Nothing was replaced: `fill` failed, the file changed since it was read or since the command began,
    /// the disk is full, the folder is read-only.
    pub fn fill<T, E: From<FileError>>(&self, fill: impl FnOnce(&mut dyn Write) -> Result<T, E>) -> Result<T, E> {
        self.written(None, fill)
    }

    fn written<T, E: From<FileError>>(
        &self,
        read: Option<&[u8]>,
        fill: impl FnOnce(&mut dyn Write) -> Result<T, E>,
    ) -> Result<T, E> {
        match &self.kind {
            Kind::Standard => {
                let mut out = Patient::new(io::stdout());
                let filled = fill(&mut out)?;
                unless_closed(out.finish())
                    .map_err(|error| FileError::io(Path::new("standard output"), "write", &error))?;
                Ok(filled)
            }
            Kind::Stream => {
                let failed = |error: &io::Error| FileError::io(&self.path, "write to it", error);
                let opened = OpenOptions::new().write(true).open(&self.path);
                let mut out = Patient::new(opened.map_err(|error| failed(&error))?);
                let filled = fill(&mut out)?;
                unless_closed(out.finish()).map_err(|error| failed(&error))?;
                Ok(filled)
            }
            Kind::Regular { place, before } => self.replace(place, before.as_ref(), read, fill),
        }
    }

    fn replace<T, E: From<FileError>>(
        &self,
        place: &Path,
        before: Option<&Seen>,
        read: Option<&[u8]>,
        fill: impl FnOnce(&mut dyn Write) -> Result<T, E>,
    ) -> Result<T, E> {
        let failed = |error: &io::Error| {
            let note = if before.is_some() {
                "; the file was not changed"
            } else {
                ""
            };
            let mut failure = FileError::io(&self.path, "write the file", error);
            failure.message.push_str(note);
            failure
        };
        let folder = folder_of(place);
        let mut file = temporary::create(folder, place, before.is_none()).map_err(|error| failed(&error))?;
        let mut out = Patient::new(file.as_file_mut());
        let filled = fill(&mut out)?;
        out.finish().map_err(|error| failed(&error))?;
        drop(out);
        if let Ok(old) = fs::metadata(place) {
            replaceable(&self.path, place, &old)?;
            take_owner(&self.path, &old, file.as_file())?;
            file.as_file()
                .set_permissions(old.permissions())
                .map_err(|error| failed(&error))?;
        }
        file.as_file().sync_all().map_err(|error| failed(&error))?;
        // the last check before the rename; docs/files.md describes the gap that remains
        self.unchanged(read)?;
        file.persist(place).map_err(|error| failed(&error.error))?;
        if let Ok(folder) = File::open(folder) {
            // makes the rename itself durable; not every file system can, and the file is whole either way
            let _ = folder.sync_all();
        }
        Ok(filled)
    }

    /// An error if the file changed, or no longer contains the bytes `read`.
    fn unchanged(&self, read_before: Option<&[u8]>) -> Result<(), FileError> {
        let Kind::Regular { place, before } = &self.kind else {
            return Ok(());
        };
        let now = fs::symlink_metadata(place).ok();
        let same = match (before, &now) {
            (None, None) => true,
            (Some(seen), Some(metadata)) => *seen == Seen::of(place, metadata),
            _ => false,
        };
        let same = same
            && read_before.is_none_or(|bytes| {
                read(place, bytes.len() as u64).is_ok_and(|now| now.is_some_and(|now| now.bytes == bytes))
            });
        if same {
            return Ok(());
        }
        let what = if before.is_none() {
            "was created while the command ran"
        } else {
            "changed since it was read"
        };
        Err(FileError::new(
            &self.path,
            format!("{what}, and was not overwritten; run the command again"),
        ))
    }
}

/// A folder for outputs, made where it does not exist; the folder that it is in must.
///
/// # Errors
/// It is a file, or it cannot be made.
pub fn folder(path: &Path) -> Result<(), FileError> {
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => Ok(()),
        Ok(_) => Err(FileError::new(path, "is not a folder; name another one")),
        Err(_) => fs::create_dir(path).map_err(|error| FileError::io(path, "make the folder", &error)),
    }
}

/// A reader that went away (`| head`) wants no more: the command goes on with its other outputs and ends with the status of its verdict.
pub fn unless_closed(written: io::Result<()>) -> io::Result<()> {
    match written {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// An error if a regular file must not be replaced.
fn replaceable(path: &Path, place: &Path, metadata: &Metadata) -> Result<(), FileError> {
    if metadata.permissions().readonly() {
        return Err(FileError::new(
            path,
            "is read-only and was not replaced; make it writable, or use -o FILE",
        ));
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let links = metadata.nlink();
        if links > 1 {
            let message = format!(
                "has {links} hard links, and a new file would separate them: not replaced; write to another file with -o FILE"
            );
            return Err(FileError::new(path, message));
        }
    }
    // opened for writing, and closed: permissions, read-only and immutable file systems
    OpenOptions::new()
        .write(true)
        .open(place)
        .map(drop)
        .map_err(|error| FileError::io(path, "write the file", &error))
}

/// Gives the new file the owner and group of the old one.
fn take_owner(path: &Path, old: &Metadata, new: &File) -> Result<(), FileError> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, fchown};
        let made = new
            .metadata()
            .map_err(|error| FileError::io(path, "write the file", &error))?;
        if (made.uid(), made.gid()) != (old.uid(), old.gid()) {
            fchown(new, Some(old.uid()), Some(old.gid())).map_err(|error| {
                FileError::new(
                    path,
                    format!("belongs to another user or group, which a new file cannot keep ({error}): not replaced; use -o FILE"),
                )
            })?;
        }
    }
    #[cfg(not(unix))]
    let _ = (path, old, new);
    Ok(())
}

#[cfg(test)]
#[path = "output_tests.rs"]
mod tests;
