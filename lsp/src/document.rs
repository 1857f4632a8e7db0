//! One open document: its text, kept by the client's edits.
use crate::{
    analysis::{Analysed, Parsed},
    position::{Encoding, line_starts, offset},
};
use std::{
    borrow::Cow,
    sync::{
        Arc,
        atomic::{AtomicI32, Ordering},
    },
    time::Duration,
};
use tower_lsp::lsp_types::TextDocumentContentChangeEvent;
use trunnion_check::Diagnostic;
use trunnion_syntax::TextRange;

/// Shortest and longest pause between an edit and its analysis.
const SHORTEST_PAUSE: Duration = Duration::ZERO;
const LONGEST_PAUSE: Duration = Duration::from_millis(500);

/// One open document.
pub(crate) struct Document {
    /// Text.
    pub(crate) text: Arc<str>,
    /// The client's version of it.
    pub(crate) version: i32,
    /// The newest version, for work that wants to know whether it is still wanted; `i32::MAX` when closed.
    pub(crate) newest: Arc<AtomicI32>,
    /// Newest parsed version, perhaps of an older text.
    pub(crate) parsed: Option<Arc<Parsed>>,
    /// The pause after the last edit is over.
    pub(crate) due: bool,
    /// The analysis of this version has begun: it begins once.
    pub(crate) started: bool,
    /// Newest analysis, perhaps of an older version.
    pub(crate) analysed: Option<Arc<Analysed>>,
    /// The edits since the newest analysis, bytes: start, end before, end after.
    pub(crate) since: Vec<(u32, u32, u32)>,
    /// Its check is shown as work in progress until this is dropped.
    pub(crate) progress: Option<tokio::sync::oneshot::Sender<()>>,
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
            parsed: None,
            due: true,
            started: false,
            analysed: None,
            since: Vec::new(),
            progress: None,
            last_run: Duration::ZERO,
        }
    }

    /// Applies the client's edits in their order.
    pub(crate) fn change(&mut self, version: i32, changes: Vec<TextDocumentContentChangeEvent>, encoding: Encoding) {
        let mut text = String::from(&*self.text);
        let mut known = self
            .parsed
            .as_ref()
            .filter(|parsed| parsed.version == self.version)
            .map(|parsed| &*parsed.starts);
        for change in changes {
            let Some(range) = change.range else {
                self.since = vec![(0, u32::MAX, u32::MAX)];
                text = change.text;
                known = None;
                continue;
            };
            // the lines of the parsed version are those of the text until the first edit
            let starts = known
                .take()
                .map_or_else(|| Cow::Owned(line_starts(&text)), Cow::Borrowed);
            let start = offset(&text, &starts, range.start, encoding);
            let end = offset(&text, &starts, range.end, encoding).max(start);
            self.since
                .push((start as u32, end as u32, (start + change.text.len()) as u32));
            text.replace_range(start..end, &change.text);
        }
        self.text = text.into();
        self.version = version;
        self.newest.store(version, Ordering::SeqCst);
    }

    /// A finding of the newest analysis where it stands now; `None` where its place was edited.
    pub(crate) fn moved(&self, found: &Diagnostic) -> Option<Diagnostic> {
        let place = |mut range: TextRange| {
            for &(start, end, now) in &self.since {
                if range.start >= end {
                    range = TextRange::new(range.start - end + now, range.end - end + now);
                } else if range.end >= start {
                    return None;
                }
            }
            Some(range)
        };
        let mut found = found.clone();
        found.range = place(found.range)?;
        found.last = place(found.last).unwrap_or(found.range);
        found.related = found
            .related
            .into_iter()
            .filter_map(|(range, text)| Some((place(range)?, text)))
            .collect();
        found.also = found.also.iter().filter_map(|led| self.moved(led)).collect();
        Some(found)
    }

    /// How long to wait for the next key before analysing.
    pub(crate) fn pause(&self) -> Duration {
        self.last_run.clamp(SHORTEST_PAUSE, LONGEST_PAUSE)
    }

    /// Whether the newest analysis is of the newest text.
    pub(crate) fn is_fresh(&self) -> bool {
        self.analysed.as_ref().is_some_and(|a| a.parsed.version == self.version)
    }

    /// Whether the newest parsed version is of the newest text.
    pub(crate) fn is_parsed(&self) -> bool {
        self.parsed
            .as_ref()
            .is_some_and(|parsed| parsed.version == self.version)
    }
}
