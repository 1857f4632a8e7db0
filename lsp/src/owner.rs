//! The single owner of all state: one thread, one inbox, events in order.
use crate::{
    analysis::{Analysed, Judged, analyse},
    backend::wants_utf8,
    backplot, code_action,
    document::Document,
    event::Event,
    hover,
    outbox::{Message, Status},
    position::Encoding,
    settings, to_proto,
};
use std::{
    collections::BTreeMap,
    sync::{Arc, atomic::Ordering},
};
use tokio::{
    runtime::Handle,
    sync::{mpsc, oneshot},
};
use tower_lsp::{
    jsonrpc::{Error, Result},
    lsp_types::{Position, TextDocumentPositionParams, Url},
};
use trunnion_check::{Severity, Verdict};
use trunnion_workspace::Overrides;

/// A request that waits for the analysis of its document's version.
struct Waiting {
    uri: Url,
    version: i32,
    answer: Box<dyn FnOnce(Option<Arc<Analysed>>) + Send>,
}

/// The state.
pub(crate) struct Owner {
    inbox: mpsc::UnboundedSender<Event>,
    outbox: mpsc::UnboundedSender<Message>,
    runtime: Handle,
    documents: BTreeMap<Url, Document>,
    waiting: Vec<Waiting>,
    overrides: Overrides,
    encoding: Encoding,
}

impl Owner {
    /// With nothing open.
    pub(crate) fn new(
        inbox: mpsc::UnboundedSender<Event>,
        outbox: mpsc::UnboundedSender<Message>,
        runtime: Handle,
    ) -> Self {
        Self {
            inbox,
            outbox,
            runtime,
            documents: BTreeMap::new(),
            waiting: Vec::new(),
            overrides: Overrides::default(),
            encoding: Encoding::Utf16,
        }
    }

    /// Handles events until all senders are gone.
    pub(crate) fn run(mut self, mut events: mpsc::UnboundedReceiver<Event>) {
        while let Some(event) = events.blocking_recv() {
            self.handle(event);
        }
    }

    fn handle(&mut self, event: Event) {
        match event {
            Event::Initialize(params) => {
                if wants_utf8(&params) {
                    self.encoding = Encoding::Utf8;
                }
                if let Some(options) = &params.initialization_options {
                    self.overrides = settings::overrides(options);
                }
            }
            Event::Open { uri, version, text } => {
                self.documents.insert(uri.clone(), Document::open(text, version));
                self.start_analysis(&uri);
            }
            Event::Change { uri, version, changes } => self.change(&uri, version, changes),
            Event::Close { uri } => self.close(&uri),
            Event::Configure(value) => {
                self.overrides = settings::overrides(&value);
                self.analyse_all();
            }
            Event::FilesChanged => self.analyse_all(),
            Event::Due { uri, version } => {
                if self.documents.get(&uri).is_some_and(|d| d.version == version) {
                    self.start_analysis(&uri);
                }
            }
            Event::Analysed(analysed) => self.take(&analysed),
            Event::Hover(params, answer) => {
                let at = params.text_document_position_params;
                let encoding = self.encoding;
                let position = at.position;
                self.ask(&at, answer, move |a| Ok(hover::hover(a, position, encoding)));
            }
            Event::CodeAction(params, answer) => {
                let at = TextDocumentPositionParams::new(params.text_document.clone(), params.range.start);
                let encoding = self.encoding;
                self.ask(&at, answer, move |a| {
                    Ok(code_action::code_actions(a, &params, encoding))
                });
            }
            Event::Backplot(params, answer) => {
                let at = TextDocumentPositionParams::new(params.text_document.clone(), Position::default());
                let newest = self
                    .documents
                    .get(&at.text_document.uri)
                    .map(|d| (d.version, Arc::clone(&d.newest)));
                self.ask(&at, answer, move |a| match &a.outcome {
                    Err(error) => Err(Error::invalid_params(error.to_string())),
                    Ok(judged) => backplot::backplot(judged, &a.uri, &params, &|| {
                        newest
                            .as_ref()
                            .is_none_or(|(version, newest)| newest.load(Ordering::SeqCst) != *version)
                    }),
                });
            }
        }
    }

    fn change(&mut self, uri: &Url, version: i32, changes: Vec<tower_lsp::lsp_types::TextDocumentContentChangeEvent>) {
        let Some(document) = self.documents.get_mut(uri) else {
            return;
        };
        document.change(version, changes, self.encoding);
        let (pause, inbox, uri) = (document.pause(), self.inbox.clone(), uri.clone());
        self.drop_stale(&uri, version);
        self.runtime.spawn(async move {
            tokio::time::sleep(pause).await;
            let _ = inbox.send(Event::Due { uri, version });
        });
    }

    fn close(&mut self, uri: &Url) {
        if let Some(document) = self.documents.remove(uri) {
            document.newest.store(i32::MAX, Ordering::SeqCst);
            self.drop_stale(uri, i32::MAX);
            let _ = self.outbox.send(Message::Diagnostics(uri.clone(), Vec::new(), None));
        }
    }

    fn analyse_all(&mut self) {
        let uris: Vec<Url> = self.documents.keys().cloned().collect();
        for uri in uris {
            if let Some(document) = self.documents.get_mut(&uri) {
                // A run with the old settings must not be taken as the answer for the new ones.
                document.analysed = None;
                document.newest.store(i32::MIN, Ordering::SeqCst);
                document.newest = Arc::new(std::sync::atomic::AtomicI32::new(document.version));
            }
            self.start_analysis(&uri);
        }
    }

    fn start_analysis(&mut self, uri: &Url) {
        let Some(document) = self.documents.get_mut(uri) else {
            return;
        };
        let (uri, version, text) = (uri.clone(), document.version, Arc::clone(&document.text));
        let (newest, overrides, inbox) = (Arc::clone(&document.newest), self.overrides.clone(), self.inbox.clone());
        self.runtime.spawn_blocking(move || {
            let cancelled = || newest.load(Ordering::SeqCst) != version;
            if let Some(analysed) = analyse(uri, version, text, &overrides, &cancelled)
                && !cancelled()
            {
                let _ = inbox.send(Event::Analysed(Arc::new(analysed)));
            }
        });
    }

    /// Takes an analysis, publishes it, and answers the requests that waited for it.
    fn take(&mut self, analysed: &Arc<Analysed>) {
        let Some(document) = self.documents.get_mut(&analysed.uri) else {
            return;
        };
        if document.version != analysed.version {
            return;
        }
        document.last_run = analysed.took;
        document.analysed = Some(Arc::clone(analysed));
        let diagnostics = to_proto::diagnostics(analysed, self.encoding);
        let message = Message::Diagnostics(analysed.uri.clone(), diagnostics, Some(analysed.version));
        let _ = self.outbox.send(message);
        let _ = self.outbox.send(Message::Status(Box::new(status(analysed))));
        let (ready, rest) = std::mem::take(&mut self.waiting)
            .into_iter()
            .partition(|w: &Waiting| w.uri == analysed.uri && w.version == analysed.version);
        self.waiting = rest;
        for waiting in ready {
            (waiting.answer)(Some(Arc::clone(analysed)));
        }
    }

    /// Answers a request from the analysis of the document's version, now or when it is there.
    fn ask<T: Send + 'static>(
        &mut self,
        at: &TextDocumentPositionParams,
        answer: oneshot::Sender<Result<T>>,
        work: impl FnOnce(&Analysed) -> Result<T> + Send + 'static,
    ) {
        let uri = &at.text_document.uri;
        let runtime = self.runtime.clone();
        let reply = move |analysed: Option<Arc<Analysed>>| match analysed {
            // Answering may take time: not on the owner's thread. A closed channel means the client cancelled.
            Some(analysed) => drop(runtime.spawn_blocking(move || {
                if !answer.is_closed() {
                    let _ = answer.send(work(&analysed));
                }
            })),
            None => drop(answer.send(Err(Error::content_modified()))),
        };
        match self.documents.get(uri) {
            None => reply(None),
            Some(document) if document.is_fresh() => reply(document.analysed.clone()),
            Some(document) => {
                let waiting = Waiting {
                    uri: uri.clone(),
                    version: document.version,
                    answer: Box::new(reply),
                };
                self.waiting.push(waiting);
            }
        }
    }

    /// Requests on a version that is no longer the newest get "content modified".
    fn drop_stale(&mut self, uri: &Url, newest: i32) {
        let (stale, rest) = std::mem::take(&mut self.waiting)
            .into_iter()
            .partition(|w: &Waiting| w.uri == *uri && w.version != newest);
        self.waiting = rest;
        for waiting in stale {
            (waiting.answer)(None);
        }
    }
}

fn status(analysed: &Analysed) -> Status {
    let uri = analysed.uri.clone();
    match &analysed.outcome {
        Ok(Judged { resolved, session, .. }) => {
            let summary = &session.report.summary;
            let verdict = match session.report.verdict(Severity::Error) {
                Verdict::Pass => "pass",
                Verdict::Fail => "fail",
                Verdict::Unknown => "unknown",
            };
            Status {
                uri,
                machine: resolved.machine.as_ref().map(|m| m.id.clone()),
                dialect: Some(resolved.dialect.name.clone()),
                reason: resolved.dialect_reason.clone(),
                verdict: verdict.into(),
                errors: summary.errors,
                warnings: summary.warnings,
                unknown: summary.unknown,
            }
        }
        Err(error) => Status {
            uri,
            machine: None,
            dialect: None,
            reason: error.to_string(),
            verdict: "unknown".into(),
            errors: 1,
            warnings: 0,
            unknown: 0,
        },
    }
}
