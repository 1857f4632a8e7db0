//! One open document: its text, kept by the client's edits.
use crate::{
    analysis::{Analysed, Parsed, Version, toml_file},
    large::Large,
    latest::Latest,
    moved::Moves,
    part::LARGE,
    position::Encoding,
    text::Text,
};
use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::Duration,
};
use tower_lsp::lsp_types::{TextDocumentContentChangeEvent, Url};
use trunnion_check::Diagnostic;
use trunnion_syntax::TextRange;

/// Shortest and longest pause between an edit and its analysis.
const SHORTEST_PAUSE: Duration = Duration::ZERO;
const LARGE_PAUSE: Duration = Duration::from_millis(200);
const LONGEST_PAUSE: Duration = Duration::from_millis(500);

/// One open document.
pub(crate) struct Document {
    /// Text.
    pub(crate) text: Text,
    /// The same as it was opened, until it is parsed.
    pub(crate) opened: Option<String>,
    /// What is kept of a long one.
    pub(crate) large: Option<Large>,
    /// Its version.
    pub(crate) version: Version,
    /// The server's number of the newest version, for work that wants to know whether it is still wanted; `u64::MAX` when closed.
    pub(crate) newest: Arc<AtomicU64>,
    /// The work that parses it; of a long one, that judges its beginning.
    pub(crate) reading: Latest,
    /// The work that parses the whole of a long one.
    pub(crate) whole: Latest,
    /// The work that judges the visible lines of a long one.
    pub(crate) visible: Latest,
    /// The work that judges the whole.
    pub(crate) judging: Latest,
    /// Newest parsed version, perhaps of an older text.
    pub(crate) parsed: Option<Arc<Parsed>>,
    /// The pause after the last edit is over.
    pub(crate) due: bool,
    /// The version whose parse has begun, of a long text.
    pub(crate) parsing: Option<Version>,
    /// The analysis of this version has begun: it begins once.
    pub(crate) started: bool,
    /// Newest analysis, perhaps of an older version.
    pub(crate) analysed: Option<Arc<Analysed>>,
    /// The edits since the newest analysis. Not kept of a long text.
    pub(crate) since: Moves,
    /// Its check is shown as work in progress until this is dropped.
    pub(crate) progress: Option<tokio::sync::oneshot::Sender<()>>,
    /// How long the last analysis took: the pause after an edit follows it.
    pub(crate) last_run: Duration,
}

impl Document {
    /// A document as opened.
    pub(crate) fn open(uri: &Url, text: String, version: Version) -> Self {
        let large = text.len() > LARGE && toml_file(uri, &text).is_none();
        Self {
            text: Text::new(&text),
            opened: Some(text),
            large: large.then(Large::default),
            version,
            newest: Arc::new(AtomicU64::new(version.own)),
            reading: Latest::default(),
            whole: Latest::default(),
            visible: Latest::default(),
            judging: Latest::default(),
            parsed: None,
            due: true,
            parsing: None,
            started: false,
            analysed: None,
            since: Moves::default(),
            progress: None,
            last_run: Duration::ZERO,
        }
    }

    /// Applies the client's edits in their order.
    pub(crate) fn change(
        &mut self,
        version: Version,
        changes: Vec<TextDocumentContentChangeEvent>,
        encoding: Encoding,
    ) {
        for change in changes {
            let Some(range) = change.range else {
                self.since.clear();
                self.text = Text::new(&change.text);
                self.large = (self.text.len() > LARGE).then(Large::default);
                (self.parsed, self.analysed) = (None, None);
                continue;
            };
            let start = self.text.offset(range.start, encoding);
            let end = self.text.offset(range.end, encoding).max(start);
            if let Some(large) = &mut self.large {
                let lines = range.start.line as usize..range.end.line.max(range.start.line) as usize;
                large.before(&self.text, lines.clone(), &change.text);
                let before = self.text.lines();
                self.text.replace(start..end, &change.text);
                large.after(lines, self.text.lines() as i64 - before as i64);
            } else {
                self.since.edit(start as u32..end as u32, change.text.len() as u32);
                self.text.replace(start..end, &change.text);
            }
        }
        self.opened = None;
        self.version = version;
        self.newest.store(version.own, Ordering::SeqCst);
        if self.large.is_some() {
            // the memory of a second whole version is not spent
            (self.parsed, self.analysed) = (None, None);
        }
    }

    /// A finding of the newest analysis where it stands now; `None` where its place was edited.
    pub(crate) fn moved(&self, found: &Diagnostic) -> Option<Diagnostic> {
        let place = |range: TextRange| self.since.moved(range);
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
        let shortest = if self.large.is_some() {
            LARGE_PAUSE
        } else {
            SHORTEST_PAUSE
        };
        self.last_run.clamp(shortest, LONGEST_PAUSE)
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
