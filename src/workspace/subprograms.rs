//! Programs that a program calls: searched in its folder, then in the folders of `subprogram_path`, and nowhere else.
use crate::Texts;
use crate::listing::{Listing, Listings};
use std::{
    fs::{self, File},
    io::Read,
    path::{Path, PathBuf},
    sync::{
        Arc, OnceLock,
        atomic::{AtomicBool, Ordering},
    },
};
use trunnion_interp::{Files, Loaded, Searched};

/// A larger file is not a subprogram, bytes.
const LARGEST: u64 = 64 << 20;

/// The folders that were read last by this process.
static LISTINGS: Listings = Listings::new();

/// A folder that is searched, and what it held when it was first needed.
struct Folder {
    path: PathBuf,
    listing: OnceLock<Result<Arc<Listing>, String>>,
}

impl Folder {
    fn new(path: PathBuf) -> Self {
        Self {
            path,
            listing: OnceLock::new(),
        }
    }

    fn listing(&self) -> &Result<Arc<Listing>, String> {
        self.listing.get_or_init(|| LISTINGS.of(&self.path))
    }
}

/// Finds programs among texts that were given, then in folders, in their order.
pub struct Subprograms {
    /// Texts by name; `None` where none were given.
    texts: Option<(Listing, Texts)>,
    folders: Vec<Folder>,
    looked: AtomicBool,
}

impl Subprograms {
    /// Searches these folders, the first first.
    pub fn new(folders: impl IntoIterator<Item = PathBuf>) -> Self {
        Self {
            texts: None,
            folders: folders.into_iter().map(Folder::new).collect(),
            looked: AtomicBool::new(false),
        }
    }

    /// Searches these texts before the folders.
    #[must_use]
    pub fn with_texts(mut self, texts: &Texts) -> Self {
        let names = texts.0.keys().map(|path| path.display().to_string());
        self.texts = (!texts.0.is_empty()).then(|| (Listing::of_names(names), texts.clone()));
        self
    }

    /// Whether a program was looked for.
    pub fn looked(&self) -> bool {
        self.looked.load(Ordering::Relaxed)
    }
}

/// The names that a file of a program may have: as called, and for a number with and without `O` and leading zeros (`M98 P50` calls
/// `O0050`). `None` if the name is not a plain file name: it must not point outside the folders.
fn stems(name: &str) -> Option<Vec<String>> {
    let name = name.trim();
    let plain = !name.is_empty()
        && !name.starts_with('.')
        && !name.chars().any(|c| matches!(c, '/' | '\\' | ':') || c.is_control());
    if !plain {
        return None;
    }
    let mut stems = vec![name.to_owned()];
    let digits = name.strip_prefix(['O', 'o']).unwrap_or(name);
    if digits.len() <= 9 && !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()) {
        let number: u32 = digits.parse().ok()?;
        for stem in [
            format!("O{number:04}"),
            format!("O{number}"),
            format!("O{number:08}"),
            number.to_string(),
            format!("{number:04}"),
        ] {
            if !stems.contains(&stem) {
                stems.push(stem);
            }
        }
    }
    Some(stems)
}

/// The bytes of a file that is in `folder` after links are followed; otherwise the reason.
fn read(path: &Path, folder: &Path) -> Result<Arc<[u8]>, &'static str> {
    const UNREADABLE: &str = "cannot be read";
    let real = fs::canonicalize(path).map_err(|_| UNREADABLE)?;
    let home = fs::canonicalize(folder).map_err(|_| UNREADABLE)?;
    if !real.starts_with(home) {
        return Err("is a link to outside the folder");
    }
    let file = File::open(real).map_err(|_| UNREADABLE)?;
    let mut bytes = Vec::new();
    // one byte more than allowed shows that there is more
    file.take(LARGEST + 1).read_to_end(&mut bytes).map_err(|_| UNREADABLE)?;
    if bytes.len() as u64 > LARGEST {
        return Err("is larger than 64 MB");
    }
    Ok(bytes.into())
}

impl Files for Subprograms {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        self.looked.store(true, Ordering::Relaxed);
        let mut searched = Vec::new();
        let stems = stems(name);
        if let Some((listing, texts)) = &self.texts {
            let found = stems.as_ref().and_then(|stems| listing.named(stems, |_| true));
            if let Some((name, text)) = found.and_then(|name| Some((name, texts.0.get(Path::new(name))?))) {
                return Ok(Loaded {
                    path: name.to_owned(),
                    bytes: text.as_bytes().into(),
                });
            }
            searched.push("the files that were given".to_owned().into());
        }
        for folder in &self.folders {
            let shown = folder.path.display().to_string();
            let listing = match folder.listing() {
                Ok(listing) => listing,
                // the program may be in it
                Err(why) => {
                    let why = format!("{shown} {why}");
                    searched.push(Searched::refused(shown, why));
                    return Err(searched);
                }
            };
            let Some(path) = stems.as_ref().and_then(|stems| listing.find(stems, &folder.path)) else {
                searched.push((shown + &listing.remark()).into());
                continue;
            };
            match read(&path, &folder.path) {
                Ok(bytes) => {
                    return Ok(Loaded {
                        path: path.display().to_string(),
                        bytes,
                    });
                }
                // the control would take this file, so one of another folder is not taken in its place
                Err(why) => {
                    searched.push(Searched::refused(shown, format!("{} {why}", path.display())));
                    return Err(searched);
                }
            }
        }
        Err(searched)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder with a folder `subs` in it.
    struct Temporary(tempfile::TempDir);

    impl Temporary {
        fn new() -> Self {
            let folder = tempfile::tempdir().expect("a folder");
            fs::create_dir(folder.path().join("subs")).expect("a folder");
            Self(folder)
        }
        fn path(&self) -> PathBuf {
            self.0.path().to_owned()
        }
        fn write(&self, name: &str, text: &str) {
            fs::write(self.path().join(name), text).expect("written");
        }
        fn files(&self) -> Subprograms {
            Subprograms::new([self.path(), self.path().join("subs")])
        }
    }

    fn text(files: &Subprograms, name: &str) -> Option<String> {
        let loaded = files.load(name).ok()?;
        Some(String::from_utf8_lossy(&loaded.bytes).into_owned())
    }

    #[test]
    fn beside_the_program_goes_before_the_configured_folders() {
        let folder = Temporary::new();
        folder.write("subs/1000.nc", "far");
        folder.write("subs/2000.nc", "only far");
        folder.write("1000.ngc", "near");
        let files = folder.files();
        assert_eq!(text(&files, "1000").as_deref(), Some("near"));
        assert_eq!(text(&files, "2000").as_deref(), Some("only far"));
    }

    #[test]
    fn given_texts_go_before_folders() {
        let folder = Temporary::new();
        folder.write("1000.nc", "on the disk");
        folder.write("2000.nc", "only on the disk");
        let given = [("O1000.NC", "given"), ("3000", "three")];
        let texts = Texts(given.map(|(name, text)| (PathBuf::from(name), text.to_owned())).into());
        let files = folder.files().with_texts(&texts);
        assert_eq!(text(&files, "1000").as_deref(), Some("given"));
        assert_eq!(text(&files, "2000").as_deref(), Some("only on the disk"));
        assert_eq!(text(&files, "3000").as_deref(), Some("three"));
        let searched = Subprograms::new([])
            .with_texts(&texts)
            .load("4")
            .expect_err("not given");
        assert_eq!(searched, ["the files that were given".to_owned().into()]);
    }

    #[test]
    fn names_are_found_in_any_case_with_and_without_extension_and_zeros() {
        let folder = Temporary::new();
        folder.write("O0050.NC", "fifty");
        folder.write("O9010", "probe");
        folder.write("Helper.NGC", "help");
        let files = folder.files();
        for name in ["50", "O50", "o0050", "0050"] {
            assert_eq!(text(&files, name).as_deref(), Some("fifty"), "{name}");
        }
        assert_eq!(text(&files, "9010").as_deref(), Some("probe"));
        assert_eq!(text(&files, "helper").as_deref(), Some("help"));
        assert_eq!(text(&files, "help"), None);
    }

    #[test]
    fn what_is_missing_names_the_folders() {
        let folder = Temporary::new();
        let searched = folder.files().load("77").expect_err("not there");
        let folders = [folder.path(), folder.path().join("subs")].map(|path| path.display().to_string().into());
        assert_eq!(searched, folders);
    }

    #[test]
    fn no_name_leads_out_of_the_folders() {
        let folder = Temporary::new();
        folder.write("secret", "outside of subs");
        let files = Subprograms::new([folder.path().join("subs")]);
        for name in ["../secret", "..\\secret", "..", ".", "/etc/passwd", "a\0b", "", "C:x"] {
            assert_eq!(text(&files, name), None, "{name:?}");
        }
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(folder.path().join("secret"), folder.path().join("subs/link.nc"))
                .expect("a link");
            let searched = Subprograms::new([folder.path().join("subs")])
                .load("link")
                .expect_err("it leads out");
            let why = searched[0].refused.as_deref().expect("a reason");
            assert!(why.ends_with("is a link to outside the folder"), "{searched:?}");
        }
    }

    #[test]
    fn a_file_of_more_than_64_mb_is_refused_and_said_to_be() {
        let folder = Temporary::new();
        let file = File::create(folder.path().join("1.nc")).expect("created");
        file.set_len(LARGEST + 1).expect("sparse");
        // the control would not look further
        fs::write(folder.path().join("subs/1.nc"), "G0 X1\n").expect("written");
        let searched = folder.files().load("1").expect_err("too large");
        let why = searched[0].refused.as_deref().expect("a reason");
        assert!(why.ends_with("1.nc is larger than 64 MB"), "{searched:?}");
        assert_eq!(searched.len(), 1);
    }
}
