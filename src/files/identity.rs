//! Which file a path points to, and in which state it is.
use std::{fs::Metadata, path::Path};

/// Two paths with the same identity point to the same file.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Identity {
    /// Device and inode.
    #[cfg(unix)]
    Node(u64, u64),
    /// Where the system has no such numbers: the path after links are followed.
    #[cfg(not(unix))]
    Path(std::path::PathBuf),
}

impl Identity {
    /// Of the file that `path` points to.
    pub(crate) fn of(path: &Path, metadata: &Metadata) -> Self {
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt;
            let _ = path;
            Self::Node(metadata.dev(), metadata.ino())
        }
        #[cfg(not(unix))]
        {
            let _ = metadata;
            Self::Path(std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned()))
        }
    }
}

/// What kind of file this is, if it is not a regular one; `None` for a regular one.
pub(crate) fn special(metadata: &Metadata) -> Option<&'static str> {
    let kind = metadata.file_type();
    if kind.is_file() {
        return None;
    }
    if kind.is_dir() {
        return Some("a folder");
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if kind.is_fifo() {
            return Some("a FIFO");
        }
        if kind.is_socket() {
            return Some("a socket");
        }
        if kind.is_char_device() || kind.is_block_device() {
            return Some("a device");
        }
    }
    Some("not a regular file")
}
