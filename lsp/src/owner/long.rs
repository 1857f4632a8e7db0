//! Long documents: the visible lines are judged at once, the whole after a pause.
use super::Owner;
use crate::{
    analysis::{Version, parse},
    event::{Event, Work},
    outbox::Message,
    part::{self, Part},
    snapshot::{Need, Snapshot},
    status::checking,
    to_proto,
};
use core::ops::Range;
use std::sync::{
    Arc,
    atomic::Ordering,
    mpsc::{Sender, channel},
};
use tower_lsp::lsp_types::Url;

/// A long text is parsed on so many threads.
const THREADS: usize = 2;

/// The thread on which long documents are read and judged as a whole, one after the other: on many threads the allocator would keep the
/// memory of each.
#[derive(Clone)]
pub(super) struct Worker(Sender<Box<dyn FnOnce() + Send>>);

impl Worker {
    pub(super) fn start() -> Self {
        let (jobs, inbox) = channel::<Box<dyn FnOnce() + Send>>();
        std::thread::spawn(move || {
            for job in inbox {
                job();
            }
        });
        Self(jobs)
    }

    /// It lives as long as the process.
    pub(super) fn run(&self, job: impl FnOnce() + Send + 'static) {
        let _ = self.0.send(Box::new(job));
    }
}

impl Owner {
    /// Parses a long document as it is now; before that its beginning is judged, where nothing is known of it.
    pub(super) fn start_large(&mut self, uri: &Url) {
        let Some(document) = self.documents.get_mut(uri) else {
            return;
        };
        if document.parsing == Some(document.version) {
            return;
        }
        document.parsing = Some(document.version);
        let (uri, version, text) = (uri.clone(), document.version, document.text.clone());
        let opened = document.opened.take();
        let begins = document.large.as_ref().is_some_and(|large| large.base.is_none());
        let (newest, overrides) = (Arc::clone(&document.newest), self.folder.overrides.clone());
        let inbox = self.inbox.clone();
        let beginning = begins.then(|| {
            (
                uri.clone(),
                text.clone(),
                overrides.clone(),
                inbox.clone(),
                Arc::clone(&newest),
            )
        });
        let whole = move || {
            let cancelled = || newest.load(Ordering::SeqCst) != version.own;
            if cancelled() {
                return;
            }
            let whole = opened.unwrap_or_else(|| text.whole());
            drop(text);
            let parsed = parse(uri, version, whole, &overrides, THREADS);
            if !cancelled() {
                let _ = inbox.send(Event::Parsed(Arc::new(parsed)));
            }
        };
        let (long, reads) = (self.long.clone(), document.whole.clone());
        let Some((uri, text, overrides, inbox, newest)) = beginning else {
            return reads.run(version.own, |turn| long.run(turn), whole);
        };
        // the whole takes all cores: it waits until the beginning is shown
        let begin = move || {
            if let Some(part) = part::first(&uri, version, &text, &overrides)
                && newest.load(Ordering::SeqCst) == version.own
            {
                let part = Some(Box::new(part));
                let _ = inbox.send(Event::Part { uri, version, part });
            }
            drop(text);
            reads.run(version.own, |turn| long.run(turn), whole);
        };
        let pool = &self.runtime;
        document
            .reading
            .run(version.own, |turn| drop(pool.spawn_blocking(turn)), begin);
    }

    /// After an edit, judges the visible lines.
    pub(super) fn start_part(&mut self, uri: &Url) {
        let Some(document) = self.documents.get(uri) else {
            return;
        };
        let (plan, newest, version) = (
            document.part_after_edit(uri),
            Arc::clone(&document.newest),
            document.version,
        );
        let (uri, inbox) = (uri.clone(), self.inbox.clone());
        let judge = move || {
            if newest.load(Ordering::SeqCst) == version.own {
                let part = plan.and_then(|plan| plan.judge()).map(Box::new);
                let _ = inbox.send(Event::Part { uri, version, part });
            }
        };
        let pool = &self.runtime;
        document
            .visible
            .run(version.own, |turn| drop(pool.spawn_blocking(turn)), judge);
    }

    /// Publishes a part with the older findings of other lines. The document has no verdict until the whole is judged.
    pub(super) fn take_part(&mut self, uri: &Url, version: Version, part: Option<Box<Part>>) {
        let (push, encoding) = (self.shown.push, self.encoding);
        let Some(document) = self.documents.get_mut(uri) else {
            return;
        };
        let Some(large) = document.large.as_mut().filter(|_| document.version == version) else {
            return;
        };
        if document
            .analysed
            .as_ref()
            .is_some_and(|analysed| analysed.parsed.version == version)
        {
            return;
        }
        let (lines, found) = match &part {
            Some(part) => (part.lines.clone(), to_proto::diagnostics(&part.analysed, encoding)),
            None => (0..0, Vec::new()),
        };
        if let Some(part) = part {
            large.base.get_or_insert(part.base);
        }
        let Some(base) = &large.base else { return };
        let status = (!large.told).then(|| checking(uri, version, &base.resolved));
        large.told = true;
        let list = large.with_part(&lines, found);
        if push {
            self.outbox.send(Message::Diagnostics(uri.clone(), list, Some(version)));
        }
        if let Some(status) = status {
            self.outbox.send(Message::Status(Box::new(status), version));
        }
        self.answer(uri);
    }

    /// Answers a request about some lines of a long document from these lines, where the whole is not there yet.
    pub(super) fn ask_near(&mut self, uri: &Url, need: Need, near: Option<Range<usize>>, work: Work) {
        let Some(lines) = near else {
            return self.ask(uri, need, None, work);
        };
        if need == Need::Parsed
            && let Some(document) = self.documents.get_mut(uri)
        {
            document.shows(&lines);
        }
        let plan = match self.documents.get(uri) {
            Some(document) if self.snapshot(uri, need).is_none() => document.plan(uri, lines.clone(), need),
            _ => None,
        };
        let Some(plan) = plan else {
            return self.ask(uri, need, Some(lines), work);
        };
        let (encoding, shown, folder) = (self.encoding, self.shown, self.folder());
        let (uri, inbox) = (uri.clone(), self.inbox.clone());
        self.runtime.spawn_blocking(move || {
            let snapshot = |parsed, analysed| Snapshot {
                parsed,
                analysed,
                encoding,
                shown,
                folder,
            };
            if need == Need::Parsed {
                return work(Some(snapshot(Arc::new(plan.read()), None)));
            }
            if let Some(part) = plan.judge().filter(|part| part.reaches(&lines)) {
                let analysed = Arc::new(part.analysed);
                work(Some(snapshot(Arc::clone(&analysed.parsed), Some(analysed))));
            } else {
                // only the whole says what runs there
                let version = plan.version;
                let _ = inbox.send(Event::AskWhole {
                    uri,
                    version,
                    need,
                    work,
                });
            }
        });
    }

    /// Waits for the whole, if the version is still the newest.
    pub(super) fn ask_whole(&mut self, uri: &Url, version: Version, need: Need, work: Work) {
        let newest = self.documents.get(uri).map(|document| document.version);
        if newest == Some(version) {
            self.ask(uri, need, None, work);
        } else {
            work(None);
        }
    }
}
