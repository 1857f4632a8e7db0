//! `--cache FOLDER`: results of files that did not change. A key is a digest of everything that a result depends on, so an entry is
//! never out of date; a result that depends on other programs is not kept.
use super::one::Checked;
use crate::cli::failure::Failure;
use sha2::{Digest, Sha256};
use std::{
    fmt::Write,
    path::{Path, PathBuf},
};
use trunnion_files::{read, sweep_beside, write_kept};

/// Entries larger than this are not read, bytes.
const LARGEST: u64 = 64 << 20;

/// A folder of results.
pub(super) struct Cache {
    folder: PathBuf,
}

impl Cache {
    /// The folder is made if it is not there.
    pub(super) fn open(folder: &Path) -> Result<Self, Failure> {
        std::fs::create_dir_all(folder).map_err(|error| Failure::io(folder, "make the folder of the cache", &error))?;
        // what killed runs left there
        sweep_beside(&folder.join("entry"));
        Ok(Self {
            folder: folder.to_owned(),
        })
    }

    fn path(&self, key: &str) -> PathBuf {
        self.folder.join(format!("{key}.json"))
    }

    /// The result under a key. An entry that is not whole does not count.
    pub(super) fn get(&self, key: &str) -> Option<Checked> {
        let input = read(&self.path(key), LARGEST).ok()??;
        let end = input.bytes.iter().position(|&byte| byte == b'\n')?;
        let (digest, text) = (&input.bytes[..end], &input.bytes[end + 1..]);
        (digest == hex(&Sha256::digest(text)).as_bytes()).then(|| serde_json::from_slice(text).ok())?
    }

    /// Keeps a result. What cannot be kept is checked again the next time.
    pub(super) fn put(&self, key: &str, checked: &Checked) {
        let Ok(text) = serde_json::to_vec(checked) else { return };
        let mut bytes = hex(&Sha256::digest(&text)).into_bytes();
        bytes.push(b'\n');
        bytes.extend(text);
        let _ = write_kept(&self.path(key), &bytes);
    }
}

/// A digest of what a result depends on.
pub(super) struct Key(Sha256);

impl Key {
    /// With this build of the program, its arguments and the folder it runs in.
    pub(super) fn new() -> Self {
        let mut key = Self(Sha256::new());
        key.add(b"trunnion-cache/1");
        key.add(env!("CARGO_PKG_VERSION").as_bytes());
        let own = std::env::current_exe().ok();
        let build = own.and_then(|path| std::fs::metadata(path).ok());
        let changed = build.as_ref().and_then(|build| build.modified().ok());
        let changed = changed.and_then(|time| time.duration_since(std::time::UNIX_EPOCH).ok());
        key.add(&build.map_or(0, |build| build.len()).to_le_bytes());
        key.add(&changed.unwrap_or_default().as_nanos().to_le_bytes());
        for argument in std::env::args_os() {
            key.add(argument.as_encoded_bytes());
        }
        let here = std::env::current_dir().unwrap_or_default();
        key.add(here.as_os_str().as_encoded_bytes());
        key
    }
    /// Adds a part; parts do not run into each other.
    pub(super) fn add(&mut self, bytes: &[u8]) {
        self.0.update((bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
    }
    /// The name of the entry.
    pub(super) fn finish(self) -> String {
        hex(&self.0.finalize())
    }
}

fn hex(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(2 * bytes.len());
    for byte in bytes {
        let _ = write!(text, "{byte:02x}");
    }
    text
}
