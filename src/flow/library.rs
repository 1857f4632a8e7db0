//! Other files that a program calls: each is loaded and parsed once.
use crate::Key;
use std::collections::HashMap;
use std::sync::Arc;
use trunnion_syntax::{LexOptions, Program, parse};
use trunnion_vocabulary::Searched;

/// When so many different programs are missing, no further one is looked for. No real program calls so many that do not exist.
const MOST_MISSING: usize = 4096;

/// What a missing program counts among copied entries: its name and the folders that were searched.
const MISSING: usize = 4;

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
    /// Numbers of the files by the names that they were called by.
    known: HashMap<Key, u16>,
    /// Names that are not there, with the folders that were searched.
    missing: HashMap<Key, Vec<Searched>>,
}

impl Library {
    /// How many entries of other lists a clone copies: names and the folders that were searched.
    pub fn copied(&self) -> usize {
        2 * self.files.len() + self.missing.len() * MISSING
    }

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
        if let Some(known) = self.known.get(name) {
            return Ok(*known);
        }
        if let Some(searched) = self.missing.get(name) {
            return Err(searched.clone());
        }
        if self.missing.len() >= MOST_MISSING {
            let why = format!("{MOST_MISSING} other programs that are called do not exist");
            return Err(vec![Searched::skipped(why)]);
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
                    let number = self.files.len() as u16;
                    self.known.insert(name.clone(), number);
                    return Ok(number);
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

#[cfg(test)]
mod tests {
    use super::{Library, MOST_MISSING};
    use crate::Key;
    use core::cell::Cell;
    use trunnion_vocabulary::Searched;

    /// A program of a million calls of different programs looked for each under many names, and kept the answer.
    #[test]
    fn missing_programs_are_looked_for_once_and_not_without_bound() {
        let (mut library, asked) = (Library::default(), Cell::new(0_usize));
        let mut find = |number: usize| {
            let load = |_: &str| {
                asked.set(asked.get() + 1);
                Err::<(String, Vec<u8>), _>(vec![Searched::from("programs")])
            };
            let tried = || vec![format!("O{number}"), format!("O{number}.nc")];
            let lex = trunnion_syntax::LexOptions::default();
            library
                .find(&Key::Number(number as u32), tried, lex, load)
                .expect_err("missing")
        };
        for number in 0..MOST_MISSING + 100 {
            let searched = find(number);
            let again = find(number);
            assert_eq!(searched.len(), 1);
            assert_eq!(searched[0].skipped.is_some(), number >= MOST_MISSING, "{number}");
            assert!(searched == again);
        }
        assert_eq!(asked.get(), 2 * MOST_MISSING);
    }

    /// Each file is loaded once and keeps its number, however many others were called before it. They were searched one after the other
    /// for each call.
    #[test]
    fn a_file_that_was_called_is_known_by_its_name() {
        let (mut library, loaded) = (Library::default(), Cell::new(0_usize));
        let mut find = |number: u32| {
            let load = |file: &str| {
                loaded.set(loaded.get() + 1);
                Ok::<_, Vec<Searched>>((file.to_owned(), Vec::<u8>::new()))
            };
            let tried = || vec![format!("O{number}")];
            let lex = trunnion_syntax::LexOptions::default();
            library.find(&Key::Number(number), tried, lex, load).expect("loaded")
        };
        for number in 0..60_000 {
            assert_eq!(find(number), number as u16 + 1);
        }
        for number in (0..60_000).rev() {
            assert_eq!(find(number), number as u16 + 1);
        }
        assert_eq!(loaded.get(), 60_000);
        assert_eq!(library.copied(), 120_000);
    }
}
