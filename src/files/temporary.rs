//! Temporary files next to the files that they will replace, and those that a killed run left.
//!
//! A run holds a lock on each of its temporary files. The lock ends with the process, however it ends: a temporary file without a lock
//! is left over, and the next run that writes to the folder removes it.
use std::{
    collections::BTreeSet,
    fs::{self, File, TryLockError},
    io::{self, Write},
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
    time::Duration,
};
use tempfile::{Builder, NamedTempFile};

/// Ending of the names of temporary files.
pub(crate) const ENDING: &str = ".trunnion-tmp";
/// Where locks are not supported, a temporary file of this age is left over.
const OLD: Duration = Duration::from_hours(24);
/// A new temporary file may be mistaken for a leftover before it is locked; then another is made.
const ATTEMPTS: usize = 16;

/// A locked temporary file in `folder`, named after `target`. `shared`: with the permissions that new files have.
pub(crate) fn create(folder: &Path, target: &Path, shared: bool) -> io::Result<NamedTempFile> {
    let name: String = target
        .file_name()
        .map(|name| name.to_string_lossy().chars().take(60).collect())
        .unwrap_or_default();
    let prefix = format!(".{name}.");
    let mut builder = Builder::new();
    builder.prefix(&prefix).suffix(ENDING).rand_bytes(8);
    #[cfg(unix)]
    if shared {
        use std::os::unix::fs::PermissionsExt;
        // the umask of the process removes what the user does not want
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    #[cfg(not(unix))]
    let _ = shared;
    for _ in 0..ATTEMPTS {
        let file = builder.tempfile_in(folder)?;
        // where locks are not supported, only the age of a file shows that it is left over
        let _ = file.as_file().try_lock();
        if file.path().exists() {
            return Ok(file);
        }
    }
    Err(io::Error::other("another process keeps removing the temporary file"))
}

/// Replaces a file of our own that can be made anew, such as an entry of a cache: whole or not at all, but without waiting for the disk.
///
/// # Errors
/// The folder cannot be written to.
pub fn write_kept(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut file = create(folder, path, true)?;
    file.write_all(bytes)?;
    file.persist(path).map(drop).map_err(|error| error.error)
}

/// Removes what killed runs left in the folder of the file that `path` points to, whether or not this run writes there.
pub fn sweep_beside(path: &Path) {
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if let Some(folder) = place.parent() {
        sweep(folder);
    }
}

/// Removes what killed runs left in `folder`; once for each folder and process.
pub(crate) fn sweep(folder: &Path) {
    static SWEPT: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());
    let new = SWEPT
        .lock()
        .unwrap_or_else(PoisonError::into_inner)
        .insert(folder.to_owned());
    if new {
        sweep_now(folder);
    }
}

fn sweep_now(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let ours = name.starts_with('.') && name.ends_with(ENDING);
        if ours && entry.file_type().is_ok_and(|kind| kind.is_file()) && is_left(&entry.path()) {
            // another run may have removed it meanwhile
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Whether the run that made the file is over.
fn is_left(path: &Path) -> bool {
    let Ok(file) = File::open(path) else { return false };
    match file.try_lock() {
        Ok(()) => true,
        Err(TryLockError::WouldBlock) => false,
        Err(TryLockError::Error(_)) => file
            .metadata()
            .and_then(|metadata| metadata.modified())
            .is_ok_and(|time| time.elapsed().is_ok_and(|age| age > OLD)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_left_temporary_file_is_removed_and_one_in_use_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let live = create(folder.path(), Path::new("a.nc"), true).expect("created");
        let left = folder.path().join(".a.nc.12345678.trunnion-tmp");
        fs::write(&left, "half").expect("written");
        let foreign = folder.path().join("notes.trunnion-tmp");
        fs::write(&foreign, "not ours").expect("written");
        sweep_now(folder.path());
        assert!(!left.exists());
        assert!(live.path().exists());
        assert!(foreign.exists());
    }

    #[test]
    fn a_name_of_the_greatest_length_has_a_temporary_file_too() {
        let folder = tempfile::tempdir().expect("a folder");
        let name = "ü".repeat(127);
        assert!(create(folder.path(), Path::new(&name), true).is_ok());
    }
}
