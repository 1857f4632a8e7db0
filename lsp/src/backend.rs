//! The handlers: they put events into the owner's inbox and await answers, nothing else.
//!
//! Notification handlers contain no `.await`: tower-lsp polls handlers in wire order, so nothing yields before the event
//! is in the inbox and edits cannot overtake each other.
use crate::{
    backplot::{Backplot, BackplotParams},
    event::Event,
    outbox,
    owner::Owner,
};
use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};
use tokio::sync::{mpsc, oneshot};
use tower_lsp::{
    Client, LanguageServer,
    jsonrpc::{Error, Result},
    lsp_types::{
        CodeActionKind, CodeActionOptions, CodeActionParams, CodeActionProviderCapability, CodeActionResponse,
        DidChangeConfigurationParams, DidChangeTextDocumentParams, DidChangeWatchedFilesParams,
        DidCloseTextDocumentParams, DidOpenTextDocumentParams, Hover, HoverParams, HoverProviderCapability,
        InitializeParams, InitializeResult, PositionEncodingKind, ServerCapabilities, ServerInfo,
        TextDocumentSyncCapability, TextDocumentSyncKind, TextDocumentSyncOptions,
    },
};

/// The handlers.
pub(crate) struct Backend {
    inbox: mpsc::UnboundedSender<Event>,
    shutdown: Arc<AtomicBool>,
}

impl Backend {
    /// Starts the owner's thread and the sender's task.
    pub(crate) fn start(client: Client, shutdown: Arc<AtomicBool>) -> Self {
        let (inbox, events) = mpsc::unbounded_channel();
        let (messages, outgoing) = mpsc::unbounded_channel();
        tokio::spawn(outbox::run(client, outgoing));
        let owner = Owner::new(inbox.clone(), messages, tokio::runtime::Handle::current());
        std::thread::spawn(move || owner.run(events));
        Self { inbox, shutdown }
    }

    /// The owner lives as long as the process; when it is gone there is no one to notify.
    fn post(&self, event: Event) {
        let _ = self.inbox.send(event);
    }

    async fn ask<T>(&self, event: impl FnOnce(oneshot::Sender<Result<T>>) -> Event) -> Result<T> {
        let (sender, answer) = oneshot::channel();
        self.post(event(sender));
        answer.await.unwrap_or_else(|_| Err(Error::content_modified()))
    }
}

/// Requests of our own clients.
impl Backend {
    /// `trunnion/backplot`.
    pub(crate) async fn backplot(&self, params: BackplotParams) -> Result<Backplot> {
        self.ask(|answer| Event::Backplot(params, answer)).await
    }
}

/// Column encoding to use: UTF-8 where the client offers it (most of a program is ASCII), else UTF-16.
pub(crate) fn wants_utf8(params: &InitializeParams) -> bool {
    let general = params.capabilities.general.as_ref();
    let offered = general.and_then(|g| g.position_encodings.as_ref());
    offered.is_some_and(|kinds| kinds.contains(&PositionEncodingKind::UTF8))
}

#[tower_lsp::async_trait]
impl LanguageServer for Backend {
    async fn initialize(&self, params: InitializeParams) -> Result<InitializeResult> {
        let encoding = if wants_utf8(&params) {
            PositionEncodingKind::UTF8
        } else {
            PositionEncodingKind::UTF16
        };
        self.post(Event::Initialize(Box::new(params)));
        Ok(InitializeResult {
            capabilities: ServerCapabilities {
                position_encoding: Some(encoding),
                text_document_sync: Some(TextDocumentSyncCapability::Options(TextDocumentSyncOptions {
                    open_close: Some(true),
                    change: Some(TextDocumentSyncKind::INCREMENTAL),
                    ..TextDocumentSyncOptions::default()
                })),
                hover_provider: Some(HoverProviderCapability::Simple(true)),
                code_action_provider: Some(CodeActionProviderCapability::Options(CodeActionOptions {
                    code_action_kinds: Some(vec![CodeActionKind::QUICKFIX]),
                    ..CodeActionOptions::default()
                })),
                ..ServerCapabilities::default()
            },
            server_info: Some(ServerInfo {
                name: "trunnion".into(),
                version: Some(env!("CARGO_PKG_VERSION").into()),
            }),
        })
    }

    async fn shutdown(&self) -> Result<()> {
        self.shutdown.store(true, Ordering::SeqCst);
        Ok(())
    }

    async fn did_open(&self, params: DidOpenTextDocumentParams) {
        let document = params.text_document;
        self.post(Event::Open {
            uri: document.uri,
            version: document.version,
            text: document.text,
        });
    }

    async fn did_change(&self, params: DidChangeTextDocumentParams) {
        let document = params.text_document;
        self.post(Event::Change {
            uri: document.uri,
            version: document.version,
            changes: params.content_changes,
        });
    }

    async fn did_close(&self, params: DidCloseTextDocumentParams) {
        self.post(Event::Close {
            uri: params.text_document.uri,
        });
    }

    async fn did_change_configuration(&self, params: DidChangeConfigurationParams) {
        self.post(Event::Configure(params.settings));
    }

    async fn did_change_watched_files(&self, _params: DidChangeWatchedFilesParams) {
        self.post(Event::FilesChanged);
    }

    async fn hover(&self, params: HoverParams) -> Result<Option<Hover>> {
        self.ask(|answer| Event::Hover(params, answer)).await
    }

    async fn code_action(&self, params: CodeActionParams) -> Result<Option<CodeActionResponse>> {
        self.ask(|answer| Event::CodeAction(Box::new(params), answer)).await
    }
}
