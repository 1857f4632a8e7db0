//! The other programs of a folder: open ones as they are in the editor, the rest from disk, kept while they do not change.
use crate::{
    analysis::{Parsed, Source, Version, parse},
    position::{self, Encoding},
};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    sync::{Arc, Mutex},
    time::SystemTime,
};
use tower_lsp::lsp_types::{Range, Url};
use trunnion_dialect::is_program_file_name;
use trunnion_syntax::TextRange;
use trunnion_workspace::Overrides;

/// At most so many files are read for one answer, and none that is larger.
const MOST_FILES: usize = 500;
const LARGEST: u64 = 4 << 20;
/// How deep the folders of a workspace are searched.
const DEEPEST: usize = 6;

/// A program of the folder.
pub(crate) struct Other {
    pub(crate) uri: Url,
    parsed: Arc<Parsed>,
}

impl Other {
    /// The program with its settings.
    pub(crate) fn source(&self) -> Option<&Source> {
        self.parsed.outcome.as_ref().ok()
    }
    /// Range of bytes.
    pub(crate) fn range(&self, bytes: TextRange, encoding: Encoding) -> Range {
        position::range(&self.parsed.text, &self.parsed.starts, bytes, encoding)
    }
}

pub(crate) type Kept = BTreeMap<PathBuf, (Option<SystemTime>, u64, Arc<Other>)>;

/// What is known of files that are not asked about themselves.
#[derive(Clone, Default)]
pub(crate) struct Folder {
    pub(crate) kept: Arc<Mutex<Kept>>,
    /// Open documents.
    pub(crate) open: Arc<BTreeMap<Url, Arc<Parsed>>>,
    pub(crate) overrides: Overrides,
    /// The folders that the client has open.
    pub(crate) roots: Arc<Vec<PathBuf>>,
}

impl Folder {
    /// Forgets the files: settings have changed.
    pub(crate) fn forget(&self) {
        if let Ok(mut kept) = self.kept.lock() {
            kept.clear();
        }
    }

    /// The programs in the folder of a document, without itself; for one that is not saved, the other open ones.
    pub(crate) fn beside(&self, uri: &Url) -> Vec<Arc<Other>> {
        let own = uri.to_file_path().ok();
        let folder = own.as_deref().and_then(Path::parent);
        let mut files = Vec::new();
        if let Some(folder) = folder {
            list(folder, 1, &mut files);
        }
        files.retain(|file| Some(file.as_path()) != own.as_deref());
        let unsaved = |open: &Url| folder.is_none() && open != uri;
        self.read(files, unsaved)
    }

    /// All programs of the workspace.
    pub(crate) fn all(&self) -> Vec<Arc<Other>> {
        let mut files = Vec::new();
        for root in self.roots.iter() {
            list(root, DEEPEST, &mut files);
        }
        self.read(files, |_| true)
    }

    /// A file that is not open.
    pub(crate) fn on_disk(&self, uri: &Url) -> Option<Arc<Parsed>> {
        let path = uri.to_file_path().ok()?;
        self.file(&path, uri.clone()).map(|other| Arc::clone(&other.parsed))
    }

    fn read(&self, files: Vec<PathBuf>, open: impl Fn(&Url) -> bool) -> Vec<Arc<Other>> {
        let mut found: Vec<Arc<Other>> = Vec::new();
        let of_open = |parsed: &Arc<Parsed>| {
            Arc::new(Other {
                uri: parsed.uri.clone(),
                parsed: Arc::clone(parsed),
            })
        };
        for path in files {
            let Ok(uri) = Url::from_file_path(&path) else { continue };
            match self.open.get(&uri) {
                Some(parsed) => found.push(of_open(parsed)),
                None => found.extend(self.file(&path, uri)),
            }
        }
        for (uri, parsed) in self.open.iter().filter(|(uri, _)| open(uri)) {
            if !found.iter().any(|known| known.uri == *uri) {
                found.push(of_open(parsed));
            }
        }
        found
    }

    fn file(&self, path: &Path, uri: Url) -> Option<Arc<Other>> {
        let about = std::fs::metadata(path).ok()?;
        let (time, size) = (about.modified().ok(), about.len());
        if size > LARGEST {
            return None;
        }
        let known = self.kept.lock().ok()?.get(path).cloned();
        if let Some((_, _, other)) = known.filter(|(then, was, _)| *then == time && *was == size) {
            return Some(other);
        }
        let text = std::fs::read_to_string(path).ok()?;
        let parsed = Arc::new(parse(uri.clone(), Version::default(), text, &self.overrides, 1));
        let other = Arc::new(Other { uri, parsed });
        self.kept
            .lock()
            .ok()?
            .insert(path.to_owned(), (time, size, Arc::clone(&other)));
        Some(other)
    }
}

/// The programs of a folder by their names, sorted, hidden folders left out.
fn list(folder: &Path, depth: usize, files: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    let mut paths: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    paths.sort();
    for path in paths {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        if files.len() >= MOST_FILES || name.starts_with('.') {
            continue;
        }
        if path.is_dir() {
            if depth > 1 && !path.is_symlink() && !matches!(name, "node_modules" | "target") {
                list(&path, depth - 1, files);
            }
        } else if is_program_file_name(name) {
            files.push(path);
        }
    }
}
