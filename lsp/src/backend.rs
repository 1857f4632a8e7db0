//! The handlers: they put events into the owner's inbox and await answers, nothing else.
//!
//! Notification handlers contain no `.await`: tower-lsp polls handlers in wire order, so nothing yields before the event
//! is in the inbox and edits cannot overtake each other.
mod asking;

use crate::{
    backplot::{self, Backplot, BackplotParams},
    call_hierarchy,
    capabilities::capabilities,
    code_action,
    coloured::Coloured,
    edits::{self, EditAnswer, EditParams},
    event::Event,
    hover, navigate,
    outbox::{self, Outbox},
    owner::Owner,
    position::Encoding,
    rewrites::{self, RewriteAnswer, RewriteParams},
    snapshot::{Need, Snapshot},
    structure, to_proto, writing,
};
use std::sync::{
    Arc,
    atomic::{AtomicBool, AtomicUsize, Ordering},
};
use tokio::sync::{mpsc, oneshot};
use tower_lsp::{
    Client, LanguageServer,
    jsonrpc::{Error, Result},
    lsp_types::{
        CallHierarchyIncomingCall, CallHierarchyIncomingCallsParams, CallHierarchyItem, CallHierarchyOutgoingCall,
        CallHierarchyOutgoingCallsParams, CallHierarchyPrepareParams, CodeActionParams, CodeActionResponse, CodeLens,
        CodeLensParams, CompletionParams, CompletionResponse, DidChangeConfigurationParams,
        DidChangeTextDocumentParams, DidChangeWatchedFilesParams, DidCloseTextDocumentParams,
        DidOpenTextDocumentParams, DocumentDiagnosticParams, DocumentDiagnosticReport, DocumentDiagnosticReportResult,
        DocumentFormattingParams, DocumentHighlight, DocumentHighlightParams, DocumentLink, DocumentLinkParams,
        DocumentOnTypeFormattingParams, DocumentRangeFormattingParams, DocumentSymbolParams, DocumentSymbolResponse,
        FoldingRange, FoldingRangeParams, FullDocumentDiagnosticReport, GotoDefinitionParams, GotoDefinitionResponse,
        Hover, HoverParams, InitializeParams, InitializeResult, InlayHint, InlayHintParams, Location,
        PositionEncodingKind, PrepareRenameResponse, ReferenceParams, RelatedFullDocumentDiagnosticReport,
        RenameParams, SelectionRange, SelectionRangeParams, SemanticTokens, SemanticTokensDeltaParams,
        SemanticTokensFullDeltaResult, SemanticTokensParams, SemanticTokensRangeParams, SemanticTokensRangeResult,
        SemanticTokensResult, ServerInfo, SignatureHelp, SignatureHelpParams, SymbolInformation,
        TextDocumentPositionParams, TextEdit, WorkspaceEdit, WorkspaceSymbolParams,
    },
};

/// The handlers.
pub(crate) struct Backend {
    inbox: mpsc::UnboundedSender<Event>,
    shutdown: Arc<AtomicBool>,
    coloured: Coloured,
    /// How many regions the client folds.
    folds: AtomicUsize,
}

impl Backend {
    /// Starts the owner's thread and the sender's task.
    pub(crate) fn start(client: Client, shutdown: Arc<AtomicBool>) -> Self {
        let (inbox, events) = mpsc::unbounded_channel();
        let messages = Outbox::default();
        tokio::spawn(outbox::run(client, messages.clone()));
        let owner = Owner::new(inbox.clone(), messages, tokio::runtime::Handle::current());
        std::thread::spawn(move || owner.run(events));
        let coloured = Coloured::default();
        Self {
            inbox,
            shutdown,
            coloured,
            folds: AtomicUsize::new(structure::MOST_FOLDS),
        }
    }

    /// The owner lives as long as the process; when it is gone there is no one to notify.
    fn post(&self, event: Event) {
        let _ = self.inbox.send(event);
    }
}

/// Requests of our own clients.
impl Backend {
    /// `trunnion/backplot`.
    pub(crate) async fn backplot(&self, params: BackplotParams) -> Result<Backplot> {
        let uri = params.text_document.uri.clone();
        self.ask(&uri, Need::Analysed, move |snapshot| {
            backplot::backplot(snapshot, &params)
        })
        .await
    }

    /// `trunnion/edit`.
    pub(crate) async fn edit(&self, params: EditParams) -> Result<EditAnswer> {
        let uri = params.text_document.uri.clone();
        self.ask(&uri, Need::Parsed, move |snapshot| edits::answer(snapshot, &params))
            .await
    }

    /// `trunnion/rewrite`.
    pub(crate) async fn rewrite(&self, params: RewriteParams) -> Result<RewriteAnswer> {
        let uri = params.text_document.uri.clone();
        self.ask(&uri, Need::Parsed, move |snapshot| rewrites::answer(snapshot, &params))
            .await
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
            Encoding::Utf8
        } else {
            Encoding::Utf16
        };
        let text_document = params.capabilities.text_document.as_ref();
        let folding = text_document.and_then(|document| document.folding_range.as_ref());
        if let Some(limit) = folding.and_then(|folding| folding.range_limit) {
            self.folds.fetch_min(limit as usize, Ordering::Relaxed);
        }
        self.post(Event::Initialize(Box::new(params)));
        Ok(InitializeResult {
            capabilities: capabilities(encoding),
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
        self.coloured.forget(&params.text_document.uri);
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
        let at = params.text_document_position_params;
        let line = at.position.line as usize;
        let work = move |snapshot: &Snapshot| Ok(hover::at(snapshot, at.position));
        self.ask_near(&at.text_document.uri, Need::Analysed, Some(line..line + 1), work)
            .await
    }

    async fn code_action(&self, params: CodeActionParams) -> Result<Option<CodeActionResponse>> {
        let uri = params.text_document.uri.clone();
        let work = move |snapshot: &Snapshot| {
            let encoding = snapshot.encoding;
            if let Some(analysed) = &snapshot.analysed {
                return code_action::code_actions(analysed, &params, encoding, snapshot.shown.commands);
            }
            let found = to_proto::of_toml(&snapshot.parsed, encoding);
            Some(code_action::of_settings(&snapshot.parsed, &found, encoding))
        };
        self.show(&uri, Need::Analysed, work).await
    }

    async fn diagnostic(&self, params: DocumentDiagnosticParams) -> Result<DocumentDiagnosticReportResult> {
        let work = |snapshot: &Snapshot| {
            let items = match &snapshot.analysed {
                Some(analysed) => to_proto::diagnostics(analysed, snapshot.encoding),
                None => to_proto::of_toml(&snapshot.parsed, snapshot.encoding),
            };
            let full = FullDocumentDiagnosticReport { result_id: None, items };
            DocumentDiagnosticReportResult::Report(DocumentDiagnosticReport::Full(
                RelatedFullDocumentDiagnosticReport {
                    related_documents: None,
                    full_document_diagnostic_report: full,
                },
            ))
        };
        self.show(&params.text_document.uri, Need::Analysed, work).await
    }

    async fn completion(&self, params: CompletionParams) -> Result<Option<CompletionResponse>> {
        let at = params.text_document_position;
        let work =
            move |snapshot: &Snapshot| Some(CompletionResponse::Array(writing::completion(snapshot, at.position)));
        self.show(&at.text_document.uri, Need::Parsed, work).await
    }

    async fn signature_help(&self, params: SignatureHelpParams) -> Result<Option<SignatureHelp>> {
        let at = params.text_document_position_params;
        let work = move |snapshot: &Snapshot| writing::signature_help(snapshot, at.position);
        self.show(&at.text_document.uri, Need::Parsed, work).await
    }

    async fn goto_definition(&self, params: GotoDefinitionParams) -> Result<Option<GotoDefinitionResponse>> {
        let at = params.text_document_position_params;
        let work =
            move |snapshot: &Snapshot| navigate::definition(snapshot, at.position).map(GotoDefinitionResponse::Array);
        self.show(&at.text_document.uri, Need::Parsed, work).await
    }

    async fn references(&self, params: ReferenceParams) -> Result<Option<Vec<Location>>> {
        let (at, declaration) = (params.text_document_position, params.context.include_declaration);
        let work = move |snapshot: &Snapshot| navigate::references(snapshot, at.position, declaration);
        self.ask(&at.text_document.uri, Need::Parsed, work).await
    }

    async fn document_highlight(&self, params: DocumentHighlightParams) -> Result<Option<Vec<DocumentHighlight>>> {
        let at = params.text_document_position_params;
        let work = move |snapshot: &Snapshot| navigate::highlights(snapshot, at.position);
        self.show(&at.text_document.uri, Need::Parsed, work).await
    }

    async fn prepare_rename(&self, at: TextDocumentPositionParams) -> Result<Option<PrepareRenameResponse>> {
        let work = move |snapshot: &Snapshot| navigate::prepare(snapshot, at.position);
        self.show(&at.text_document.uri, Need::Parsed, work).await
    }

    async fn rename(&self, params: RenameParams) -> Result<Option<WorkspaceEdit>> {
        let at = params.text_document_position;
        let work = move |snapshot: &Snapshot| navigate::renamed(snapshot, at.position, &params.new_name);
        self.ask(&at.text_document.uri, Need::Parsed, work).await
    }

    async fn document_symbol(&self, params: DocumentSymbolParams) -> Result<Option<DocumentSymbolResponse>> {
        let work = |snapshot: &Snapshot| Some(DocumentSymbolResponse::Nested(structure::document_symbols(snapshot)));
        self.show(&params.text_document.uri, Need::Parsed, work).await
    }

    async fn symbol(&self, params: WorkspaceSymbolParams) -> Result<Option<Vec<SymbolInformation>>> {
        let (sender, answer) = oneshot::channel();
        self.post(Event::AskAll(Box::new(move |folder, encoding| {
            if !sender.is_closed() {
                let _ = sender.send(structure::workspace_symbols(&folder, &params.query, encoding));
            }
        })));
        answer.await.map(Some).map_err(|_| Error::internal_error())
    }

    async fn folding_range(&self, params: FoldingRangeParams) -> Result<Option<Vec<FoldingRange>>> {
        let most = self.folds.load(Ordering::Relaxed);
        let work = move |snapshot: &Snapshot| Some(structure::folding(snapshot, most));
        self.show(&params.text_document.uri, Need::Parsed, work).await
    }

    async fn selection_range(&self, params: SelectionRangeParams) -> Result<Option<Vec<SelectionRange>>> {
        let positions = params.positions;
        let work = move |snapshot: &Snapshot| Some(structure::selection(snapshot, &positions));
        self.show(&params.text_document.uri, Need::Parsed, work).await
    }

    async fn semantic_tokens_full(&self, params: SemanticTokensParams) -> Result<Option<SemanticTokensResult>> {
        let (uri, coloured) = (params.text_document.uri.clone(), self.coloured.clone());
        let work = move |snapshot: &Snapshot| {
            let data = writing::all_colours(snapshot)?;
            Some(SemanticTokensResult::Tokens(coloured.whole(&uri, data)))
        };
        self.show(&params.text_document.uri, Need::Parsed, work).await
    }

    async fn semantic_tokens_full_delta(
        &self,
        params: SemanticTokensDeltaParams,
    ) -> Result<Option<SemanticTokensFullDeltaResult>> {
        let (uri, coloured) = (params.text_document.uri.clone(), self.coloured.clone());
        let work = move |snapshot: &Snapshot| {
            let data = writing::all_colours(snapshot)?;
            Some(coloured.since(&uri, &params.previous_result_id, data))
        };
        self.show(&params.text_document.uri, Need::Parsed, work).await
    }

    async fn semantic_tokens_range(
        &self,
        params: SemanticTokensRangeParams,
    ) -> Result<Option<SemanticTokensRangeResult>> {
        let range = params.range;
        let work = move |snapshot: &Snapshot| {
            let data = writing::colours(snapshot, range);
            Ok(Some(SemanticTokensRangeResult::Tokens(SemanticTokens {
                result_id: None,
                data,
            })))
        };
        let lines = range.start.line as usize..range.end.line as usize + 1;
        self.ask_near(&params.text_document.uri, Need::Parsed, Some(lines), work)
            .await
    }

    async fn inlay_hint(&self, params: InlayHintParams) -> Result<Option<Vec<InlayHint>>> {
        let range = params.range;
        let work = move |snapshot: &Snapshot| Some(writing::inlay_hints(snapshot, range));
        self.show(&params.text_document.uri, Need::Analysed, work).await
    }

    async fn code_lens(&self, params: CodeLensParams) -> Result<Option<Vec<CodeLens>>> {
        let work = |snapshot: &Snapshot| Some(structure::lenses(snapshot));
        self.show(&params.text_document.uri, Need::Parsed, work).await
    }

    async fn formatting(&self, params: DocumentFormattingParams) -> Result<Option<Vec<TextEdit>>> {
        let work = |snapshot: &Snapshot| writing::formatting(snapshot, None);
        self.ask(&params.text_document.uri, Need::Parsed, work).await
    }

    async fn range_formatting(&self, params: DocumentRangeFormattingParams) -> Result<Option<Vec<TextEdit>>> {
        let range = params.range;
        let work = move |snapshot: &Snapshot| writing::formatting(snapshot, Some(range));
        self.ask(&params.text_document.uri, Need::Parsed, work).await
    }

    async fn on_type_formatting(&self, params: DocumentOnTypeFormattingParams) -> Result<Option<Vec<TextEdit>>> {
        let at = params.text_document_position;
        let work = move |snapshot: &Snapshot| writing::on_type(snapshot, at.position);
        self.show(&at.text_document.uri, Need::Parsed, work).await
    }

    async fn document_link(&self, params: DocumentLinkParams) -> Result<Option<Vec<DocumentLink>>> {
        let work = |snapshot: &Snapshot| Some(structure::links(snapshot));
        self.show(&params.text_document.uri, Need::Parsed, work).await
    }

    async fn prepare_call_hierarchy(
        &self,
        params: CallHierarchyPrepareParams,
    ) -> Result<Option<Vec<CallHierarchyItem>>> {
        let at = params.text_document_position_params;
        let work = move |snapshot: &Snapshot| call_hierarchy::prepare(snapshot, at.position);
        self.show(&at.text_document.uri, Need::Parsed, work).await
    }

    async fn incoming_calls(
        &self,
        params: CallHierarchyIncomingCallsParams,
    ) -> Result<Option<Vec<CallHierarchyIncomingCall>>> {
        let (uri, of) = (params.item.uri.clone(), params.item);
        self.near(&uri, move |snapshot| call_hierarchy::incoming(snapshot, &of))
            .await
    }

    async fn outgoing_calls(
        &self,
        params: CallHierarchyOutgoingCallsParams,
    ) -> Result<Option<Vec<CallHierarchyOutgoingCall>>> {
        let (uri, of) = (params.item.uri.clone(), params.item);
        self.near(&uri, move |snapshot| call_hierarchy::outgoing(snapshot, &of))
            .await
    }
}
