//! One open document: its text, kept by the client's edits.
use crate::{
    analysis::Analysed,
    position::{Encoding, line_starts, offset},
};
use std::{
    sync::{
        Arc,
        atomic::{AtomicI32, Ordering},
    },
    time::Duration,
};
use tower_lsp::lsp_types::TextDocumentContentChangeEvent;

/// Shortest and longest pause between an edit and its analysis.
const SHORTEST_PAUSE: Duration = Duration::from_millis(50);
const LONGEST_PAUSE: Duration = Duration::from_millis(500);

/// One open document.
pub(crate) struct Document {
    /// Text.
    pub(crate) text: Arc<str>,
    /// The client's version of it.
    pub(crate) version: i32,
    /// The newest version, for work that wants to know whether it is still wanted; `i32::MAX` when closed.
    pub(crate) newest: Arc<AtomicI32>,
    /// Newest analysis, perhaps of an older version.
    pub(crate) analysed: Option<Arc<Analysed>>,
    /// How long the last analysis took: the pause after an edit follows it.
    pub(crate) last_run: Duration,
}

impl Document {
    /// A document as opened.
    pub(crate) fn open(text: String, version: i32) -> Self {
        Self {
            text: text.into(),
            version,
            newest: Arc::new(AtomicI32::new(version)),
            analysed: None,
            last_run: Duration::ZERO,
        }
    }

    /// Applies the client's edits in their order.
    pub(crate) fn change(&mut self, version: i32, changes: Vec<TextDocumentContentChangeEvent>, encoding: Encoding) {
        let mut text = String::from(&*self.text);
        for change in changes {
            let Some(range) = change.range else {
                text = change.text;
                continue;
            };
            let starts = line_starts(&text);
            let start = offset(&text, &starts, range.start, encoding);
            let end = offset(&text, &starts, range.end, encoding).max(start);
            text.replace_range(start..end, &change.text);
        }
        self.text = text.into();
        self.version = version;
        self.newest.store(version, Ordering::SeqCst);
    }

    /// How long to wait for the next key before analysing.
    pub(crate) fn pause(&self) -> Duration {
        self.last_run.clamp(SHORTEST_PAUSE, LONGEST_PAUSE)
    }

    /// Whether the newest analysis is of the newest text.
    pub(crate) fn is_fresh(&self) -> bool {
        self.analysed.as_ref().is_some_and(|a| a.version == self.version)
    }
}
