//! JSON for people's programs: the document of `check` (its files are made by `document`), and how any document is written.
use super::failure::Failure;
use serde::{Deserialize, Serialize, Serializer, ser::SerializeMap};
use serde_json::Value;
use std::io::Write;
pub(super) use trunnion_document::{File, Item, tidy};

/// A file or folder that could not be checked; the exit status is 2.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct NotChecked {
    /// Path, with the line where it is known.
    pub(super) place: String,
    /// What is wrong, and what to do.
    pub(super) message: String,
}

impl NotChecked {
    pub(super) fn of(failure: &Failure) -> Self {
        Self {
            place: failure.place().to_owned(),
            message: failure.message().to_owned(),
        }
    }
    /// Both in one text.
    pub(super) fn text(&self) -> String {
        let Self { place, message } = self;
        if place.is_empty() {
            message.clone()
        } else {
            format!("{place}: {message}")
        }
    }
}

/// A document with a long list, which is made and written item by item: a whole list of JSON values takes many times the bytes that are written.
pub(super) struct Listed<F> {
    /// The document, with any value under the key of the list.
    pub(super) document: serde_json::Map<String, Value>,
    /// The key.
    pub(super) key: &'static str,
    /// Makes the items.
    pub(super) items: F,
}

impl<I: Iterator<Item = Value>, F: Fn() -> I> Serialize for Listed<F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.document.len()))?;
        for (key, value) in &self.document {
            if key == self.key {
                map.serialize_entry(key, &Items(&self.items))?;
            } else {
                map.serialize_entry(key, value)?;
            }
        }
        map.end()
    }
}

struct Items<'a, F>(&'a F);

impl<I: Iterator<Item = Value>, F: Fn() -> I> Serialize for Items<'_, F> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((self.0)())
    }
}

/// Writes any document, pretty, with a line end.
pub(super) fn write_json(out: &mut impl Write, document: &impl Serialize) -> Result<(), Failure> {
    serde_json::to_writer_pretty(&mut *out, document).map_err(|error| Failure::from(std::io::Error::from(error)))?;
    writeln!(out)?;
    Ok(())
}
