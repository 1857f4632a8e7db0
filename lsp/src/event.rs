//! What reaches the owner of the state.
use crate::{
    analysis::{Analysed, Parsed, Version},
    part::Part,
    snapshot::{Need, Snapshot},
};
use core::ops::Range;
use std::sync::Arc;
use tower_lsp::lsp_types::{InitializeParams, TextDocumentContentChangeEvent, Url};
use trunnion_check::Diagnostic;

/// A request: it runs on a worker, with the snapshot, or with none if the document changed before it could be answered.
pub(crate) type Work = Box<dyn FnOnce(Option<Snapshot>) + Send>;

/// One event. Edits and requests share one inbox, so that a request sees exactly the edits sent before it.
pub(crate) enum Event {
    /// What the client can do and wants.
    Initialize(Box<InitializeParams>),
    /// A document opens.
    Open { uri: Url, version: i32, text: String },
    /// A document changes.
    Change {
        uri: Url,
        version: i32,
        changes: Vec<TextDocumentContentChangeEvent>,
    },
    /// A document closes.
    Close { uri: Url },
    /// New settings of the client.
    Configure(serde_json::Value),
    /// A settings or machine file changed on disk.
    FilesChanged,
    /// The pause after an edit is over.
    Due { uri: Url, version: Version },
    /// A version is parsed.
    Parsed(Arc<Parsed>),
    /// What the text alone says is found; the rules of the machine follow.
    Cheap(Arc<Parsed>, Vec<Diagnostic>),
    /// An analysis is done.
    Analysed(Arc<Analysed>),
    /// Lines of a long document are judged before the whole is; `None` where they cannot be.
    Part {
        uri: Url,
        version: Version,
        part: Option<Box<Part>>,
    },
    /// A request about a document; `near`: it asks about these lines alone, so that they are enough of a long document.
    Ask {
        uri: Url,
        need: Need,
        near: Option<Range<usize>>,
        work: Work,
    },
    /// A request about some lines of a version, which the whole alone can answer.
    AskWhole {
        uri: Url,
        version: Version,
        need: Need,
        work: Work,
    },
    /// A request about the workspace.
    AskAll(Box<dyn FnOnce(crate::folder::Folder, crate::position::Encoding) + Send>),
}
