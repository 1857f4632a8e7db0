//! Requests: answered from a snapshot when the version they ask about is there.
use super::Owner;
use crate::{
    analysis::Version,
    document::Document,
    event::Work,
    folder::Folder,
    snapshot::{Need, Snapshot},
};
use core::ops::Range;
use std::sync::Arc;
use tower_lsp::lsp_types::Url;

/// A request that waits for its document's version.
pub(super) struct Waiting {
    uri: Url,
    version: Version,
    need: Need,
    near: Option<Range<usize>>,
    work: Work,
}

impl Owner {
    pub(super) fn folder(&self) -> Folder {
        let parsed = |(uri, document): (&Url, &Document)| Some((uri.clone(), document.parsed.clone()?));
        Folder {
            open: Arc::new(self.documents.iter().filter_map(parsed).collect()),
            ..self.folder.clone()
        }
    }

    /// What a request may see now, if that is enough for it.
    pub(super) fn snapshot(&self, uri: &Url, need: Need) -> Option<Snapshot> {
        let document = self.documents.get(uri)?;
        let parsed = document.parsed.clone().filter(|_| document.is_parsed())?;
        let analysed = document.analysed.clone().filter(|_| document.is_fresh());
        if need == Need::Analysed && analysed.is_none() && parsed.toml.is_none() {
            return None;
        }
        Some(Snapshot {
            parsed,
            analysed,
            encoding: self.encoding,
            shown: self.shown,
            folder: self.folder(),
        })
    }

    /// Answers a request from the document's version, now or when it is there. Answering may take time: not on the owner's thread.
    pub(super) fn ask(&mut self, uri: &Url, need: Need, near: Option<Range<usize>>, work: Work) {
        let Some(document) = self.documents.get(uri) else {
            return work(None);
        };
        let version = document.version;
        if let Some(snapshot) = self.snapshot(uri, need) {
            drop(self.runtime.spawn_blocking(move || work(Some(snapshot))));
        } else {
            let waiting = Waiting {
                uri: uri.clone(),
                version,
                need,
                near,
                work,
            };
            self.waiting.push(waiting);
            self.hurry(uri, need);
        }
    }

    /// Who asks for what the analysis finds does not wait for the pause.
    fn hurry(&mut self, uri: &Url, need: Need) {
        if self.documents.get(uri).is_some_and(|document| document.large.is_some()) {
            // what a key changes in a long one is judged after the pause
            if need == Need::Parsed {
                self.start_large(uri);
            }
        } else if need == Need::Analysed {
            if let Some(document) = self.documents.get_mut(uri) {
                document.due = true;
            }
            self.start_analysis(uri);
        }
    }

    /// Answers the requests about a document that now have what they need.
    pub(super) fn answer(&mut self, uri: &Url) {
        for waiting in std::mem::take(&mut self.waiting) {
            if waiting.uri == *uri {
                self.ask_near(&waiting.uri, waiting.need, waiting.near, waiting.work);
            } else {
                self.waiting.push(waiting);
            }
        }
    }

    /// Requests on a version that is no longer the newest get "content modified".
    pub(super) fn drop_stale(&mut self, uri: &Url, newest: Option<Version>) {
        let (stale, rest) = std::mem::take(&mut self.waiting)
            .into_iter()
            .partition(|w: &Waiting| w.uri == *uri && Some(w.version) != newest);
        self.waiting = rest;
        for waiting in stale {
            (waiting.work)(None);
        }
    }
}
