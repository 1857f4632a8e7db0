//! Other files that a program calls: each is loaded and parsed once.
use crate::Key;
use std::collections::HashMap;
use std::sync::Arc;
use trunnion_syntax::{LexOptions, Program, parse};
use trunnion_vocabulary::Searched;

/// Another file that is called.
#[derive(Debug)]
pub struct Called {
    /// The name it was called by.
    pub name: Key,
    /// Where it was found, for messages.
    pub path: String,
    /// Its text.
    pub program: Program,
}

/// Files by number: file 0 is the main program's, which is not here.
#[derive(Clone, Debug, Default)]
pub struct Library {
    files: Vec<Arc<Called>>,
    /// Names that are not there, with the folders that were searched.
    missing: HashMap<Key, Vec<Searched>>,
}

impl Library {
    /// A file by its number.
    pub fn file(&self, number: u16) -> Option<Arc<Called>> {
        self.files.get(usize::from(number).checked_sub(1)?).map(Arc::clone)
    }

    /// The file of a program: one that was called before, else the first that `load` finds of the file names `tried`.
    ///
    /// # Errors
    /// The folders that were searched.
    pub fn find<T>(
        &mut self,
        name: &Key,
        tried: impl FnOnce() -> Vec<String>,
        lex: LexOptions,
        load: impl Fn(&str) -> Result<(String, T), Vec<Searched>>,
    ) -> Result<u16, Vec<Searched>>
    where
        T: AsRef<[u8]>,
    {
        if let Some(place) = self.files.iter().position(|called| called.name == *name) {
            return Ok(place as u16 + 1);
        }
        if let Some(searched) = self.missing.get(name) {
            return Err(searched.clone());
        }
        let mut searched = Vec::new();
        for file in tried() {
            match load(&file) {
                Ok((path, bytes)) if self.files.len() < usize::from(u16::MAX) - 1 => {
                    self.files.push(Arc::new(Called {
                        name: name.clone(),
                        path,
                        program: parse(bytes.as_ref().to_vec(), lex),
                    }));
                    return Ok(self.files.len() as u16);
                }
                Ok(_) => break,
                Err(folders) => {
                    searched = folders;
                    // the control would take that file: another name is not tried
                    if searched.iter().any(|place| place.refused.is_some()) {
                        break;
                    }
                }
            }
        }
        self.missing.insert(name.clone(), searched.clone());
        Err(searched)
    }
}
