//! Reads a regular file whole.
use crate::error::FileError;
use crate::identity::{Identity, special};
use std::{
    fs::{File, Metadata},
    io::Read,
    path::Path,
    time::SystemTime,
};

/// The state in which a file was read: while it does not change, the bytes that were read are still those of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Seen {
    pub(crate) identity: Identity,
    pub(crate) length: u64,
    pub(crate) modified: Option<SystemTime>,
}

impl Seen {
    pub(crate) fn of(path: &Path, metadata: &Metadata) -> Self {
        Self {
            identity: Identity::of(path, metadata),
            length: metadata.len(),
            modified: metadata.modified().ok(),
        }
    }
}

/// The contents of a file as read.
#[derive(Debug)]
pub struct Input {
    /// All of its bytes.
    pub bytes: Vec<u8>,
    /// Its state when they were read.
    pub seen: Seen,
}

/// Reads the regular file that `path` leads to; `None` where it has more than `most` bytes. Symbolic links are followed.
///
/// # Errors
/// The file is missing or unreadable; it is a folder, FIFO, socket or device (nothing is opened then, so no call waits for a writer);
/// it changed while it was read.
pub fn read(path: &Path, most: u64) -> Result<Option<Input>, FileError> {
    let failed = |error: &std::io::Error| FileError::io(path, "read the file", error);
    let metadata = std::fs::metadata(path).map_err(|error| failed(&error))?;
    if let Some(kind) = special(&metadata) {
        return Err(FileError::new(
            path,
            format!(
                "is {kind}, not a regular file, and was not read; name a file (`-` reads standard input where a program is expected)"
            ),
        ));
    }
    let mut file = File::open(path).map_err(|error| failed(&error))?;
    let before = file.metadata().map_err(|error| failed(&error))?;
    if before.len() > most {
        return Ok(None);
    }
    let mut bytes = Vec::new();
    bytes.reserve_exact(before.len() as usize + 1);
    // one byte more than allowed shows that the file grew
    (&mut file)
        .take(most.saturating_add(1))
        .read_to_end(&mut bytes)
        .map_err(|error| failed(&error))?;
    let after = file.metadata().map_err(|error| failed(&error))?;
    if bytes.len() as u64 > most {
        return Ok(None);
    }
    let seen = Seen::of(path, &after);
    // files of the system (/proc) report no length
    let grew = before.len() != 0 && bytes.len() as u64 != after.len();
    if Seen::of(path, &before) != seen || grew {
        return Err(FileError::new(path, "changed while it was read; run the command again"));
    }
    Ok(Some(Input { bytes, seen }))
}

/// Largest text of certificates and of machines of other programs, MiB.
const MOST_TEXT: u64 = 64;

/// Largest text of settings, machines, dialect tables and posts, MiB: what is read of them takes up to 60 times as much memory, and each entry is compared
/// with others. People write them; 2 MiB are 30 000 tools.
const MOST_SETTINGS: u64 = 2;

/// Reads a text file (certificate, machine of another program) of at most 64 MiB. A mark of the encoding at its start is left out.
///
/// # Errors
/// As [`read`]; the file is larger, or is not UTF-8, with the byte where that shows.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    text_up_to(path, MOST_TEXT, "")
}

/// Reads settings, a machine, a dialect table or a post of at most 2 MiB, likewise.
///
/// # Errors
/// As [`read_text`].
pub fn read_settings(path: &Path) -> Result<String, FileError> {
    text_up_to(path, MOST_SETTINGS, ": keep in it only what these programs need")
}

fn text_up_to(path: &Path, most: u64, remedy: &str) -> Result<String, FileError> {
    let Some(input) = read(path, most << 20)? else {
        let what =
            format!("is larger than {most} MiB, the largest size for a file of this kind; it was not read{remedy}");
        return Err(FileError::new(path, what));
    };
    let mut bytes = input.bytes;
    // a mark of the encoding, which editors write, is no part of the text
    if bytes.starts_with(b"\xef\xbb\xbf") {
        bytes.drain(..3);
    }
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to() + 1;
        FileError::new(path, format!("is not UTF-8 text (from byte {at} on); save it as UTF-8"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_file_is_read_whole_or_said_to_be_too_large() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("p.nc");
        fs::write(&path, b"G0 X1\n").expect("written");
        let input = read(&path, 6).expect("readable").expect("small enough");
        assert_eq!(input.bytes, b"G0 X1\n");
        assert!(read(&path, 5).expect("readable").is_none());
    }

    #[test]
    fn settings_are_small() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("trunnion.toml");
        let text = "#".repeat(2 << 20);
        fs::write(&path, &text).expect("written");
        assert_eq!(read_settings(&path).expect("small enough").len(), text.len());
        fs::write(&path, text + "#").expect("written");
        let error = read_settings(&path).expect_err("too large");
        assert!(error.message.starts_with("is larger than 2 MiB"), "{error}");
        assert!(read_text(&path).is_ok());
    }

    #[test]
    fn folders_and_devices_are_refused_at_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let error = read(folder.path(), 100).expect_err("a folder");
        assert!(error.message.starts_with("is a folder"), "{error}");
        #[cfg(unix)]
        {
            let error = read(Path::new("/dev/zero"), 100).expect_err("a device");
            assert!(error.message.starts_with("is a device"), "{error}");
        }
    }

    #[test]
    fn a_mark_of_the_encoding_is_no_part_of_the_text() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("m.ini");
        fs::write(&path, "\u{feff}[EMC]\n").expect("written");
        assert_eq!(read_text(&path).expect("read"), "[EMC]\n");
        assert_eq!(read_settings(&path).expect("read"), "[EMC]\n");
    }

    #[test]
    fn text_that_is_not_utf_8_names_the_byte() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("m.toml");
        fs::write(&path, b"ab\xff").expect("written");
        let error = read_text(&path).expect_err("not UTF-8");
        assert!(error.message.contains("from byte 3 on"), "{error}");
    }
}
