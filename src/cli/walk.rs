//! Files to check: arguments as they are, folders walked. What is left out of a folder is listed with its reason.
use super::failure::{Failure, remark};
use ignore::{
    Match,
    gitignore::{Gitignore, GitignoreBuilder},
};
use std::{
    collections::BTreeSet,
    fs,
    io::Read,
    path::{Path, PathBuf},
};

/// How much of a file without an extension is read to recognise it, bytes.
const HEAD: u64 = 8192;

/// What a command runs on.
#[derive(Debug, Default)]
pub(crate) struct Found {
    /// Files, folders walked in name order.
    pub(crate) files: Vec<PathBuf>,
    /// Files and folders that were skipped, with the reason.
    pub(crate) left_out: Vec<(PathBuf, &'static str)>,
    /// Folders and files that could not be inspected.
    pub(crate) failures: Vec<Failure>,
    /// A folder was among the arguments.
    pub(crate) walked: bool,
}

impl Found {
    /// Nothing, because the job cannot be done.
    pub(crate) fn failed(failure: Failure) -> Self {
        Self {
            failures: vec![failure],
            ..Self::default()
        }
    }

    /// Leaves out links to files that were found under their own names: no file is checked, or written, twice.
    fn drop_links_to_found(&mut self, first: usize) {
        let is_link = |path: &PathBuf| fs::symlink_metadata(path).is_ok_and(|metadata| metadata.is_symlink());
        let (links, mut files): (Vec<_>, Vec<_>) = self.files.drain(first..).partition(is_link);
        if !links.is_empty() {
            let mut real: BTreeSet<PathBuf> = files.iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
            for link in links {
                if fs::canonicalize(&link).is_ok_and(|target| real.insert(target)) {
                    files.push(link);
                } else {
                    self.left_out
                        .push((link, "a link to a file that is in the list already"));
                }
            }
            files.sort();
        }
        self.files.extend(files);
    }

    /// Baselines in the folders, which are no programs.
    pub(crate) fn baselines(&self) -> impl Iterator<Item = &Path> {
        let paths = self.left_out.iter().map(|(path, _)| path.as_path());
        paths.filter(|path| own_document(path).is_some_and(|schema| schema.starts_with("baseline/")))
    }

    /// Reports what was left out: each with `verbose`, otherwise how many. Settings are read with the programs, and baselines and reports
    /// are written by this program: they are not counted.
    pub(crate) fn remark(&self, quiet: bool, verbose: bool) {
        let is_own = |path: &Path| path.ends_with("trunnion.toml") || own_document(path).is_some();
        let count = self.left_out.iter().filter(|(path, _)| !is_own(path)).count();
        if verbose {
            for (path, why) in self.left_out.iter().filter(|(path, _)| !is_own(path)) {
                remark(false, &format!("{}: left out: {why}", path.display()));
            }
        } else if count > 0 {
            let what = if count == 1 {
                "1 file or folder was"
            } else {
                &format!("{count} files or folders were")
            };
            remark(quiet, &format!("{what} left out; -v lists them with the reasons"));
        }
    }
}

/// Files named by `paths`; folders are walked for programs, which are recognised by their names or, without an extension, by their first lines. Links are
/// followed inside the folder; hidden files and what `.gitignore` names are left out. A folder without any program is a failure.
pub(crate) fn programs(paths: &[PathBuf]) -> Result<Found, Failure> {
    let (found, empty) = search(paths);
    let Some(folder) = empty else { return Ok(found) };
    let known = trunnion_dialect::program_extensions().join(" .");
    found.remark(false, true);
    Err(Failure::file(
        folder,
        format!(
            "no program in this directory (looked for .{known}, and for programs without an extension); name the file itself if it \
             has another extension"
        ),
    ))
}

/// The same without a word: what was found before the first folder without a program, and that folder.
pub(crate) fn search(paths: &[PathBuf]) -> (Found, Option<&PathBuf>) {
    let mut found = Found::default();
    for path in paths {
        if !path.is_dir() {
            found.files.push(path.clone());
            continue;
        }
        let before = found.files.len();
        found.walked = true;
        Walk::new(path, &mut found).folder(path);
        found.drop_links_to_found(before);
        if found.files.len() == before && found.failures.is_empty() {
            return (found, Some(path));
        }
    }
    (found, None)
}

/// A walk through one folder.
struct Walk<'f> {
    root: PathBuf,
    /// Folders that were walked, links followed: links cannot form an endless loop.
    seen: BTreeSet<PathBuf>,
    /// `.gitignore` files in effect, the outermost first.
    ignores: Vec<Gitignore>,
    found: &'f mut Found,
}

impl<'f> Walk<'f> {
    fn new(path: &Path, found: &'f mut Found) -> Self {
        let root = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        // those of the folders above, up to the repository's
        let above: Vec<&Path> = root.ancestors().skip(1).collect();
        let repository = above.iter().position(|folder| folder.join(".git").exists());
        let inside = root.join(".git").exists();
        let above = repository.filter(|_| !inside).map_or(&[][..], |last| &above[..=last]);
        let ignores = above.iter().rev().filter_map(|folder| rules(folder, folder)).collect();
        Self {
            root,
            seen: BTreeSet::new(),
            ignores,
            found,
        }
    }

    fn folder(&mut self, path: &Path) {
        let real = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        if !self.seen.insert(real.clone()) {
            self.leave(path, "a link to a folder that was searched already");
            return;
        }
        let entries = fs::read_dir(path).and_then(Iterator::collect::<Result<Vec<_>, _>>);
        let mut entries = match entries {
            Ok(entries) => entries,
            Err(error) => {
                self.found.failures.push(Failure::io(path, "read the folder", &error));
                return;
            }
        };
        entries.sort_by_key(fs::DirEntry::file_name);
        let own = rules(path, &real);
        let depth = self.ignores.len();
        self.ignores.extend(own);
        for entry in entries {
            self.entry(&entry.path(), &real);
        }
        self.ignores.truncate(depth);
    }

    fn entry(&mut self, path: &Path, folder: &Path) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let Ok(metadata) = fs::metadata(path) else {
            return self.leave(path, "a broken link, or a file that cannot be inspected");
        };
        if name.starts_with('.') {
            // git's own files are not mentioned
            if name != ".git" && name != ".gitignore" {
                self.leave(path, "hidden");
            }
            return;
        }
        if self.ignored(&folder.join(&name), metadata.is_dir()) {
            return self.leave(path, "named in .gitignore");
        }
        let linked = fs::symlink_metadata(path).is_ok_and(|metadata| metadata.is_symlink());
        if linked && !fs::canonicalize(path).is_ok_and(|real| real.starts_with(&self.root)) {
            return self.leave(path, "a link to outside the folder");
        }
        if metadata.is_dir() {
            self.folder(path);
        } else if !metadata.is_file() {
            self.leave(path, "a device, FIFO or socket");
        } else if trunnion_dialect::is_program_file_name(&name) {
            self.found.files.push(path.to_owned());
        } else if path.extension().is_some() {
            self.leave(path, "its extension is not one of a program");
        } else {
            match head(path) {
                Ok(head) if trunnion_dialect::looks_like_program(&head) => self.found.files.push(path.to_owned()),
                Ok(_) => self.leave(
                    path,
                    "it has no extension, and its first lines do not look like a program",
                ),
                Err(error) => self.found.failures.push(Failure::io(path, "read the file", &error)),
            }
        }
    }

    fn leave(&mut self, path: &Path, why: &'static str) {
        self.found.left_out.push((path.to_owned(), why));
    }

    fn ignored(&self, path: &Path, is_folder: bool) -> bool {
        for rules in self.ignores.iter().rev() {
            match rules.matched(path, is_folder) {
                Match::Ignore(_) => return true,
                Match::Whitelist(_) => return false,
                Match::None => {}
            }
        }
        false
    }
}

/// The rules of a folder's `.gitignore`, for paths below `real`.
fn rules(folder: &Path, real: &Path) -> Option<Gitignore> {
    let file = folder.join(".gitignore");
    if !file.is_file() {
        return None;
    }
    let mut builder = GitignoreBuilder::new(real);
    // a rule that is not understood is ignored, as git does
    let _ = builder.add(file);
    builder.build().ok()
}

fn head(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut head = Vec::new();
    fs::File::open(path)?.take(HEAD).read_to_end(&mut head)?;
    Ok(head)
}

/// The schema of a JSON document that this program wrote, without `trunnion-`, or `cache`; `None` for other files.
fn own_document(path: &Path) -> Option<String> {
    let is_json = path.extension().is_some_and(|extension| extension == "json");
    if !is_json || !path.is_file() {
        return None;
    }
    let stem = path.file_stem().unwrap_or_default().as_encoded_bytes();
    if stem.len() == 64 && stem.iter().all(u8::is_ascii_hexdigit) {
        return Some("cache".to_owned());
    }
    let head = head(path).ok()?;
    let text = String::from_utf8_lossy(&head);
    let schema = text
        .trim_start()
        .strip_prefix('{')?
        .trim_start()
        .strip_prefix("\"schema\"")?;
    let name = schema
        .trim_start()
        .strip_prefix(':')?
        .trim_start()
        .strip_prefix("\"trunnion-")?;
    Some(name.split('"').next().unwrap_or_default().to_owned())
}
