//! The single owner of all state: one thread, one inbox, events in order.
use crate::{
    analysis::{Analysed, Parsed, Version, analyse, parse},
    backend::wants_utf8,
    cheap,
    document::Document,
    event::Event,
    folder::Folder,
    large::Large,
    outbox::{Message, Outbox},
    position::Encoding,
    settings::{self, Shown},
    status::status,
    to_proto,
};
use std::{
    collections::BTreeMap,
    path::PathBuf,
    sync::{Arc, atomic::Ordering},
};
use tokio::{
    runtime::Handle,
    sync::{mpsc, oneshot},
};
use tower_lsp::lsp_types::{InitializeParams, Url};

/// The check of a program with more blocks is shown as work in progress.
const LONG: usize = 20_000;

pub(crate) struct Owner {
    inbox: mpsc::UnboundedSender<Event>,
    outbox: Outbox,
    runtime: Handle,
    documents: BTreeMap<Url, Document>,
    /// How many versions there were, of all documents.
    versions: u64,
    waiting: Vec<asked::Waiting>,
    folder: Folder,
    encoding: Encoding,
    shown: Shown,
    /// The client shows work in progress; hints and lenses can be asked for again.
    progress: bool,
    refresh: bool,
    works: i32,
    long: long::Worker,
}

mod asked;
mod long;
#[cfg(test)]
mod tests;

impl Owner {
    pub(crate) fn new(inbox: mpsc::UnboundedSender<Event>, outbox: Outbox, runtime: Handle) -> Self {
        Self {
            inbox,
            outbox,
            runtime,
            documents: BTreeMap::new(),
            versions: 0,
            waiting: Vec::new(),
            folder: Folder::default(),
            encoding: Encoding::Utf16,
            shown: Shown::default(),
            progress: false,
            refresh: false,
            works: 0,
            long: long::Worker::start(),
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
            Event::Initialize(params) => self.initialize(&params),
            Event::Open { uri, version, text } => {
                let version = self.version(version);
                let document = Document::open(&uri, text, version);
                if let Some(before) = self.documents.insert(uri.clone(), document) {
                    before.newest.store(u64::MAX, Ordering::SeqCst);
                    self.drop_stale(&uri, Some(version));
                }
                self.start_parsing(&uri);
            }
            Event::Change { uri, version, changes } => {
                let version = self.version(version);
                self.change(&uri, version, changes);
            }
            Event::Close { uri } => self.close(&uri),
            Event::Configure(value) => {
                self.folder.overrides = settings::overrides(&value);
                let commands = self.shown.commands;
                self.shown = settings::Shown {
                    commands,
                    ..settings::shown(&value)
                };
                self.read_all();
            }
            Event::FilesChanged => self.read_all(),
            Event::Due { uri, version } => {
                if let Some(document) = self.documents.get_mut(&uri).filter(|d| d.version == version) {
                    document.due = true;
                    if document.large.is_some() && !document.is_parsed() {
                        self.start_parsing(&uri);
                    }
                    self.start_analysis(&uri);
                }
            }
            Event::Part { uri, version, part } => self.take_part(&uri, version, part),
            Event::Parsed(parsed) => self.take_parsed(&parsed),
            Event::Cheap(parsed, found) => self.take_cheap(&parsed, found),
            Event::Analysed(analysed) => self.take(&analysed),
            Event::Ask { uri, need, near, work } => self.ask_near(&uri, need, near, work),
            Event::AskWhole {
                uri,
                version,
                need,
                work,
            } => self.ask_whole(&uri, version, need, work),
            Event::AskAll(work) => {
                let (folder, encoding) = (self.folder(), self.encoding);
                self.runtime.spawn_blocking(move || work(folder, encoding));
            }
        }
    }

    /// A version that there was not before.
    fn version(&mut self, client: i32) -> Version {
        self.versions += 1;
        let own = self.versions;
        Version { client, own }
    }

    fn initialize(&mut self, params: &InitializeParams) {
        if wants_utf8(params) {
            self.encoding = Encoding::Utf8;
        }
        if let Some(options) = &params.initialization_options {
            self.folder.overrides = settings::overrides(options);
            self.shown = settings::shown(options);
        }
        let window = params.capabilities.window.as_ref();
        self.progress = window.and_then(|window| window.work_done_progress).unwrap_or(false);
        let workspace = params.capabilities.workspace.as_ref();
        self.refresh = workspace
            .and_then(|workspace| workspace.inlay_hint.as_ref())
            .and_then(|hint| hint.refresh_support)
            .unwrap_or(false);
        let folders = params.workspace_folders.iter().flatten().map(|folder| &folder.uri);
        let paths = folders
            .chain(params.root_uri.iter())
            .filter_map(|uri| uri.to_file_path().ok());
        let mut roots: Vec<PathBuf> = paths.collect();
        roots.dedup();
        self.folder.roots = Arc::new(roots);
    }

    fn change(
        &mut self,
        uri: &Url,
        version: Version,
        changes: Vec<tower_lsp::lsp_types::TextDocumentContentChangeEvent>,
    ) {
        let Some(document) = self.documents.get_mut(uri) else {
            return;
        };
        document.change(version, changes, self.encoding);
        (document.due, document.started) = (false, false);
        let (pause, inbox, due) = (document.pause(), self.inbox.clone(), uri.clone());
        let large = document.large.as_ref().map(|large| large.base.is_some());
        self.drop_stale(uri, Some(version));
        match large {
            Some(true) => self.start_part(uri),
            // its beginning is read again
            Some(false) | None => self.start_parsing(uri),
        }
        self.runtime.spawn(async move {
            tokio::time::sleep(pause).await;
            let _ = inbox.send(Event::Due { uri: due, version });
        });
    }

    fn close(&mut self, uri: &Url) {
        if let Some(document) = self.documents.remove(uri) {
            document.newest.store(u64::MAX, Ordering::SeqCst);
            self.drop_stale(uri, None);
            self.outbox.send(Message::Diagnostics(uri.clone(), Vec::new(), None));
        }
    }

    /// Everything anew: settings, machines or other files are different.
    fn read_all(&mut self) {
        self.folder.forget();
        let uris: Vec<Url> = self.documents.keys().cloned().collect();
        for uri in uris {
            self.versions += 1;
            if let Some(document) = self.documents.get_mut(&uri) {
                // A run with the old settings must not be taken as the answer for the new ones.
                (document.parsed, document.analysed, document.due) = (None, None, true);
                (document.started, document.parsing) = (false, None);
                document.since.clear();
                if let Some(large) = &mut document.large {
                    *large = Large::default();
                }
                document.version.own = self.versions;
                document.newest.store(self.versions, Ordering::SeqCst);
            }
            self.start_parsing(&uri);
        }
    }

    fn start_parsing(&mut self, uri: &Url) {
        let Some(document) = self.documents.get_mut(uri) else {
            return;
        };
        if document.large.is_some() {
            return self.start_large(uri);
        }
        let (uri, version) = (uri.clone(), document.version);
        let (opened, text) = (document.opened.take(), document.text.clone());
        let (newest, overrides) = (Arc::clone(&document.newest), self.folder.overrides.clone());
        let inbox = self.inbox.clone();
        let read = move || {
            let cancelled = || newest.load(Ordering::SeqCst) != version.own;
            if cancelled() {
                return;
            }
            let text = opened.unwrap_or_else(|| text.whole());
            let parsed = Arc::new(parse(uri, version, text, &overrides, 1));
            if cancelled() {
                return;
            }
            let _ = inbox.send(Event::Parsed(Arc::clone(&parsed)));
            if let Some(found) = cheap::findings(&parsed, &cancelled)
                && !cancelled()
            {
                let _ = inbox.send(Event::Cheap(parsed, found));
            }
        };
        let pool = &self.runtime;
        document
            .reading
            .run(version.own, |turn| drop(pool.spawn_blocking(turn)), read);
    }

    fn start_analysis(&mut self, uri: &Url) {
        let Some(document) = self.documents.get_mut(uri) else {
            return;
        };
        let Some(parsed) = document
            .parsed
            .clone()
            .filter(|_| document.due && !document.started && document.is_parsed())
        else {
            return;
        };
        document.started = true;
        let long = parsed
            .outcome
            .as_ref()
            .is_ok_and(|source| source.program.block_count() > LONG);
        if self.progress && long && document.progress.is_none() {
            let (running, done) = oneshot::channel();
            document.progress = Some(running);
            self.works += 1;
            self.outbox
                .send(Message::Progress(self.works, "Checking the program".to_owned(), done));
        }
        let (newest, inbox, version) = (Arc::clone(&document.newest), self.inbox.clone(), document.version);
        let is_long = document.large.is_some();
        let job = move || {
            let cancelled = || newest.load(Ordering::SeqCst) != version.own;
            if let Some(analysed) = analyse(parsed, &cancelled)
                && !cancelled()
            {
                let _ = inbox.send(Event::Analysed(Arc::new(analysed)));
            }
        };
        let (long, pool) = (&self.long, &self.runtime);
        let spawn = |turn| {
            if is_long {
                long.run(turn);
            } else {
                pool.spawn_blocking(turn);
            }
        };
        document.judging.run(version.own, spawn, job);
    }

    /// Takes a parsed version, answers the requests that waited for it, and goes on to its analysis. The rules that need no machine wait
    /// for no pause.
    fn take_parsed(&mut self, parsed: &Arc<Parsed>) {
        let Some(document) = self.documents.get_mut(&parsed.uri) else {
            return;
        };
        let current =
            document.version == parsed.version && document.newest.load(Ordering::SeqCst) == parsed.version.own;
        if !current || document.is_parsed() {
            return;
        }
        document.parsed = Some(Arc::clone(parsed));
        if parsed.toml.is_some() {
            let found = to_proto::of_toml(parsed, self.encoding);
            if self.shown.push {
                let message = Message::Diagnostics(parsed.uri.clone(), found, Some(parsed.version));
                self.outbox.send(message);
            }
            self.answer(&parsed.uri.clone());
            return;
        }
        if parsed
            .outcome
            .as_ref()
            .map_or(true, |source| source.resolved.machine.is_none())
        {
            document.due = true;
        }
        let uri = parsed.uri.clone();
        self.answer(&uri);
        self.start_analysis(&uri);
    }

    /// Publishes what the text alone says, with the other findings where they stand now.
    fn take_cheap(&mut self, parsed: &Arc<Parsed>, mut found: Vec<trunnion_check::Diagnostic>) {
        let Some(document) = self.documents.get(&parsed.uri) else {
            return;
        };
        if document.version != parsed.version || document.is_fresh() || !self.shown.push {
            return;
        }
        let before = document.analysed.as_ref().and_then(|analysed| analysed.judged());
        let others = before
            .map(|(_, session)| session.report.diagnostics.as_slice())
            .unwrap_or_default();
        found.extend(
            others
                .iter()
                .filter(|one| !cheap::is_cheap(one))
                .filter_map(|one| document.moved(one)),
        );
        found.sort_by_key(|one| one.range);
        let list = to_proto::of(parsed, &found, self.encoding);
        self.outbox
            .send(Message::Diagnostics(parsed.uri.clone(), list, Some(parsed.version)));
    }

    /// Takes an analysis, publishes it, and answers the requests that waited for it.
    fn take(&mut self, analysed: &Arc<Analysed>) {
        let parsed = &analysed.parsed;
        let Some(document) = self.documents.get_mut(&parsed.uri) else {
            return;
        };
        if !document.parsed.as_ref().is_some_and(|known| Arc::ptr_eq(known, parsed)) || !document.is_parsed() {
            return;
        }
        document.last_run = analysed.took;
        document.analysed = Some(Arc::clone(analysed));
        document.since.clear();
        document.progress = None;
        let diagnostics = to_proto::diagnostics(analysed, self.encoding);
        if let Some(large) = &mut document.large {
            large.take(analysed, &diagnostics);
        }
        if self.shown.push {
            let message = Message::Diagnostics(parsed.uri.clone(), diagnostics, Some(parsed.version));
            self.outbox.send(message);
        }
        self.outbox
            .send(Message::Status(Box::new(status(analysed)), parsed.version));
        if self.refresh {
            self.outbox.send(Message::Refresh);
        }
        self.answer(&parsed.uri.clone());
    }
}
