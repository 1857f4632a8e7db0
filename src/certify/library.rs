//! Called programs belong to a proof: each that a run loads is noted with its digest.
use crate::certificate::NamedDigest;
use crate::digest::hex_sha256;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use trunnion_interp::{Files, Library, Loaded, Searched, Setup};

/// In place of the digest of a program that was requested and not found.
const MISSING: &str = "missing";

/// Forwards requests and records the answers.
pub(crate) struct Recorder {
    library: Library,
    seen: Mutex<BTreeMap<String, String>>,
}

impl Recorder {
    /// The setup with a library that records what is loaded; the record is `None` where there is no library.
    pub(crate) fn wrap(setup: &Setup) -> (Setup, Option<Arc<Self>>) {
        let mut setup = setup.clone();
        let recorder = setup.library.0.is_some().then(|| {
            Arc::new(Self {
                library: setup.library.clone(),
                seen: Mutex::default(),
            })
        });
        if let Some(recorder) = &recorder {
            setup.library = Library(Some(recorder.clone()));
        }
        (setup, recorder)
    }

    /// What was loaded so far, by name as called.
    pub(crate) fn loaded(&self) -> Vec<NamedDigest> {
        let seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        seen.iter()
            .map(|(name, sha256)| NamedDigest {
                name: name.clone(),
                sha256: sha256.clone(),
            })
            .collect()
    }
}

impl Files for Recorder {
    fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
        let answer = match &self.library.0 {
            Some(files) => files.load(name),
            None => Err(Vec::new()),
        };
        let digest = match &answer {
            Ok(loaded) => hex_sha256(&loaded.bytes),
            Err(_) => MISSING.to_owned(),
        };
        let mut seen = self.seen.lock().unwrap_or_else(PoisonError::into_inner);
        seen.insert(name.to_owned(), digest);
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct One;

    impl Files for One {
        fn load(&self, name: &str) -> Result<Loaded, Vec<Searched>> {
            if name == "1" {
                Ok(Loaded {
                    path: "1.nc".into(),
                    bytes: Arc::from(&b"G0 X1\n"[..]),
                })
            } else {
                Err(vec!["here".into()])
            }
        }
    }

    #[test]
    fn what_is_loaded_and_what_is_missing_is_noted() {
        let given = Setup {
            library: Library(Some(Arc::new(One))),
            ..Setup::default()
        };
        let (setup, recorder) = Recorder::wrap(&given);
        let files = setup.library.0.expect("there is one");
        assert!(files.load("1").is_ok() && files.load("2").is_err());
        let loaded = recorder.expect("there is one").loaded();
        assert_eq!(loaded.len(), 2);
        assert_eq!((loaded[0].name.as_str(), loaded[0].sha256.len()), ("1", 64));
        assert_eq!((loaded[1].name.as_str(), loaded[1].sha256.as_str()), ("2", "missing"));
        assert!(Recorder::wrap(&Setup::default()).1.is_none());
    }
}
