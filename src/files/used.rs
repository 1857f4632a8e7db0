//! The files of one command, found by their place and by what they are.
use crate::identity::Identity;
use std::{
    collections::HashMap,
    path::{Path, PathBuf},
};

/// What a command reads and writes. A folder of programs has thousands of files, so nothing is searched one by one.
#[derive(Debug, Default)]
pub(crate) struct Used {
    /// `also an input of this command`, or the option that names the file.
    roles: Vec<String>,
    /// Both point into `roles`, to the first file of that place or identity.
    places: HashMap<PathBuf, usize>,
    identities: HashMap<Identity, usize>,
}

impl Used {
    pub(crate) fn add(&mut self, place: PathBuf, identity: Option<Identity>, role: String) {
        let index = self.roles.len();
        self.roles.push(role);
        self.places.entry(place).or_insert(index);
        if let Some(identity) = identity {
            self.identities.entry(identity).or_insert(index);
        }
    }

    /// What the file is used as, if it is.
    pub(crate) fn role(&self, place: &Path, identity: Option<&Identity>) -> Option<&str> {
        let by_place = self.places.get(place).copied();
        let by_identity = identity.and_then(|identity| self.identities.get(identity).copied());
        let first = by_place.into_iter().chain(by_identity).min()?;
        self.roles.get(first).map(String::as_str)
    }
}
