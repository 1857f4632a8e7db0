//! JSON for people's programs: the document of `check` (its files are made by `document`), and how any document is written.
use super::failure::Failure;
use serde::{Deserialize, Serialize};
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

/// Writes any document, pretty, with a line end.
pub(super) fn write_json(out: &mut impl Write, document: &impl Serialize) -> Result<(), Failure> {
    serde_json::to_writer_pretty(&mut *out, document).map_err(|error| Failure::from(std::io::Error::from(error)))?;
    writeln!(out)?;
    Ok(())
}
