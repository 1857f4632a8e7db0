//! The names of the files in a folder, read once for all programs that lie in it.
use std::{
    collections::{BTreeMap, BTreeSet},
    fs, io,
    path::{Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, SystemTime},
};

/// A folder with more entries than these is not searched.
const MOST_ENTRIES: usize = 1_000_000;

/// So many folders are remembered.
const REMEMBERED: usize = 8;

/// A folder that changed less than this before it was read may have changed again within the tick of its clock: it is read again.
const SETTLED: Duration = Duration::from_secs(2);

/// Extensions that are tried, in this order; the first is none.
const EXTENSIONS: &[&str] = &["", "ngc", "nc", "tap", "mpf", "spf", "cnc", "eia", "gcode"];

/// File names of a folder.
#[derive(Debug, Default)]
pub(crate) struct Listing {
    /// By their lower-case forms, each list sorted, so that the answer does not depend on the file system's order.
    names: BTreeMap<String, Vec<String>>,
    /// The lower-case forms without the extensions that are tried: most names that are asked for are none of these.
    stems: BTreeSet<String>,
    /// How many names are no UTF-8: they are compared with nothing.
    not_utf8: usize,
}

impl Listing {
    /// Reads a folder.
    ///
    /// # Errors
    /// Why it is not searched, as a sentence without its name.
    fn read(folder: &Path, most: usize) -> Result<Self, String> {
        let mut listing = Self::default();
        let unreadable = |error: io::Error| format!("cannot be listed ({error})");
        let entries = match fs::read_dir(folder) {
            // what is not there holds nothing
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(listing),
            entries => entries.map_err(unreadable)?,
        };
        for (count, entry) in entries.enumerate() {
            if count == most {
                return Err(format!("has more than {most} entries and is not searched"));
            }
            match entry.map_err(unreadable)?.file_name().into_string() {
                Ok(name) => listing.add(name),
                Err(_) => listing.not_utf8 += 1,
            }
        }
        for alike in listing.names.values_mut() {
            alike.sort();
        }
        Ok(listing)
    }

    /// Of files that are given as texts.
    pub(crate) fn of_names(names: impl IntoIterator<Item = String>) -> Self {
        let mut listing = Self::default();
        for name in names {
            listing.add(name);
        }
        listing.names.values_mut().for_each(|alike| alike.sort());
        listing
    }

    fn add(&mut self, name: String) {
        let lower = name.to_ascii_lowercase();
        for extension in EXTENSIONS {
            let stem = if extension.is_empty() {
                Some(lower.as_str())
            } else {
                lower.strip_suffix(extension).and_then(|stem| stem.strip_suffix('.'))
            };
            self.stems.extend(stem.map(str::to_owned));
        }
        self.names.entry(lower).or_default().push(name);
    }

    /// The file named like one of `stems`: as written before other cases, without an extension before with one.
    pub(crate) fn find(&self, stems: &[String], folder: &Path) -> Option<PathBuf> {
        self.named(stems, |name| folder.join(name).is_file())
            .map(|name| folder.join(name))
    }

    /// The name of that file, if it is a file.
    pub(crate) fn named(&self, stems: &[String], is_file: impl Fn(&str) -> bool) -> Option<&str> {
        for stem in stems {
            if !self.stems.contains(&stem.to_ascii_lowercase()) {
                continue;
            }
            for extension in EXTENSIONS {
                let wanted = if extension.is_empty() {
                    stem.clone()
                } else {
                    format!("{stem}.{extension}")
                };
                let alike = self.names.get(&wanted.to_ascii_lowercase());
                let found = alike.and_then(|alike| alike.iter().find(|name| **name == wanted).or(alike.first()));
                if let Some(name) = found.filter(|name| is_file(name)) {
                    return Some(name);
                }
            }
        }
        None
    }

    /// What was not looked at, to be shown behind the folder's name.
    pub(crate) fn remark(&self) -> String {
        match self.not_utf8 {
            0 => String::new(),
            1 => " (1 file whose name is not UTF-8 was skipped)".to_owned(),
            count => format!(" ({count} files whose names are not UTF-8 were skipped)"),
        }
    }
}

/// A folder that was read, when it had changed last.
type Remembered = (PathBuf, SystemTime, Arc<Listing>);

/// The listings of the folders that were read last, the newest first. A thousand programs in one folder would otherwise read it a
/// thousand times.
#[derive(Debug, Default)]
pub(crate) struct Listings {
    known: Mutex<Vec<Remembered>>,
    /// How many folders were read.
    #[cfg(test)]
    pub(crate) read: std::sync::atomic::AtomicUsize,
}

impl Listings {
    /// Without any.
    pub(crate) const fn new() -> Self {
        Self {
            known: Mutex::new(Vec::new()),
            #[cfg(test)]
            read: std::sync::atomic::AtomicUsize::new(0),
        }
    }

    /// What is in a folder now.
    ///
    /// # Errors
    /// Why it is not searched.
    pub(crate) fn of(&self, folder: &Path) -> Result<Arc<Listing>, String> {
        let changed = |folder: &Path| fs::metadata(folder).and_then(|metadata| metadata.modified()).ok();
        let before = changed(folder);
        // held while the folder is read: programs that are checked side by side read it once
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(before) = before
            && let Some((.., listing)) = known.iter().find(|(path, time, _)| path == folder && *time == before)
        {
            return Ok(Arc::clone(listing));
        }
        #[cfg(test)]
        self.read.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
        let now = SystemTime::now();
        let listing = Arc::new(Listing::read(folder, MOST_ENTRIES)?);
        known.retain(|(path, ..)| path != folder);
        if let Some(time) = before.filter(|time| now.duration_since(*time).is_ok_and(|since| since > SETTLED)) {
            known.insert(0, (folder.to_owned(), time, Arc::clone(&listing)));
            known.truncate(REMEMBERED);
        }
        Ok(listing)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::{fs::File, sync::atomic::Ordering};

    /// Lets a folder look as if it had last changed then.
    fn age(folder: &Path, by: Duration) {
        let handle = File::open(folder).expect("a folder");
        handle.set_modified(SystemTime::now() - by).expect("set");
    }

    #[test]
    fn a_folder_is_read_once_for_all_its_programs_and_again_when_it_changed() {
        let folder = tempfile::tempdir().expect("a folder");
        fs::write(folder.path().join("1.nc"), "").expect("written");
        age(folder.path(), Duration::from_secs(100));
        let listings = Listings::new();
        let find = |stem: &str| {
            let listing = listings.of(folder.path()).expect("listed");
            listing.find(&[stem.to_owned()], folder.path())
        };
        for _ in 0..1000 {
            assert!(find("1").is_some() && find("2").is_none());
        }
        assert_eq!(listings.read.load(Ordering::Relaxed), 1);
        fs::write(folder.path().join("2.nc"), "").expect("written");
        // it changed just now, and may change again before the clock shows it
        assert!(find("2").is_some() && find("2").is_some());
        assert_eq!(listings.read.load(Ordering::Relaxed), 3);
        // a folder that is not there holds nothing
        let nowhere = listings.of(&folder.path().join("no")).expect("listed");
        assert!(nowhere.names.is_empty());
    }

    #[test]
    fn what_is_not_looked_at_is_said() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["a.nc", "b", "c.tap"] {
            fs::write(folder.path().join(name), "").expect("written");
        }
        let all = Listing::read(folder.path(), 3).expect("three");
        assert_eq!((all.names.len(), all.remark()), (3, String::new()));
        let why = Listing::read(folder.path(), 2).expect_err("too many");
        assert_eq!(why, "has more than 2 entries and is not searched");
        #[cfg(target_os = "linux")]
        {
            use std::os::unix::ffi::OsStrExt;
            fs::write(folder.path().join(std::ffi::OsStr::from_bytes(b"\xfc.nc")), "").expect("written");
            let some = Listing::read(folder.path(), 9).expect("four");
            assert_eq!(some.remark(), " (1 file whose name is not UTF-8 was skipped)");
        }
    }
}
