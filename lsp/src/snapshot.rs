//! What a request sees: one version of a document, and places in the client's units.
use crate::{
    analysis::{Analysed, Parsed, Source},
    folder::{Folder, Other},
    position::{self, Encoding},
    settings::Shown,
};
use std::sync::Arc;
use tower_lsp::lsp_types::{Location, Position, Range, TextEdit, Url};
use trunnion_syntax::TextRange;

/// How much of a document a request needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Need {
    /// The parsed text.
    Parsed,
    /// The findings and check-points too.
    Analysed,
}

/// See the module.
pub(crate) struct Snapshot {
    pub(crate) parsed: Arc<Parsed>,
    pub(crate) analysed: Option<Arc<Analysed>>,
    pub(crate) encoding: Encoding,
    pub(crate) shown: Shown,
    pub(crate) folder: Folder,
}

impl Snapshot {
    /// Of a file that may or may not be open.
    pub(crate) fn of_file(uri: &Url, folder: Folder, encoding: Encoding) -> Option<Self> {
        let parsed = match folder.open.get(uri) {
            Some(parsed) => Arc::clone(parsed),
            None => folder.on_disk(uri)?,
        };
        Some(Self {
            parsed,
            analysed: None,
            encoding,
            shown: Shown::default(),
            folder,
        })
    }

    /// The program with its settings, if the document is one and they can be used.
    pub(crate) fn source(&self) -> Option<&Source> {
        self.parsed.outcome.as_ref().ok()
    }

    /// Byte of a position.
    pub(crate) fn offset(&self, position: Position) -> u32 {
        position::offset(&self.parsed.text, &self.parsed.starts, position, self.encoding) as u32
    }

    /// Bytes of a range.
    pub(crate) fn bytes(&self, range: Range) -> TextRange {
        let start = self.offset(range.start);
        TextRange::new(start, self.offset(range.end).max(start))
    }

    /// Range of bytes.
    pub(crate) fn range(&self, bytes: TextRange) -> Range {
        position::range(&self.parsed.text, &self.parsed.starts, bytes, self.encoding)
    }

    /// The same in this document's file.
    pub(crate) fn location(&self, bytes: TextRange) -> Location {
        Location::new(self.parsed.uri.clone(), self.range(bytes))
    }

    /// A place in another file of the folder.
    pub(crate) fn elsewhere(&self, other: &Other, bytes: TextRange) -> Location {
        Location::new(other.uri.clone(), other.range(bytes, self.encoding))
    }

    /// Edits of this document.
    pub(crate) fn edits(&self, edits: impl IntoIterator<Item = trunnion_syntax::TextEdit>) -> Vec<TextEdit> {
        edits
            .into_iter()
            .map(|edit| TextEdit::new(self.range(edit.range), edit.new_text))
            .collect()
    }

    /// The other programs of the document's folder.
    pub(crate) fn others(&self) -> Vec<Arc<Other>> {
        self.folder.beside(&self.parsed.uri)
    }
}
