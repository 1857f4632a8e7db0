//! What reaches the owner of the state.
use crate::analysis::Analysed;
use crate::backplot::{Backplot, BackplotParams};
use std::sync::Arc;
use tokio::sync::oneshot;
use tower_lsp::{
    jsonrpc::Result,
    lsp_types::{
        CodeActionOrCommand, CodeActionParams, Hover, HoverParams, InitializeParams, TextDocumentContentChangeEvent,
        Url,
    },
};

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
    Due { uri: Url, version: i32 },
    /// An analysis is done.
    Analysed(Arc<Analysed>),
    /// A hover.
    Hover(HoverParams, oneshot::Sender<Result<Option<Hover>>>),
    /// Quick fixes.
    CodeAction(
        Box<CodeActionParams>,
        oneshot::Sender<Result<Option<Vec<CodeActionOrCommand>>>>,
    ),
    /// The path for a viewer.
    Backplot(BackplotParams, oneshot::Sender<Result<Backplot>>),
}
