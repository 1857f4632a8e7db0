//! What is kept of a long document between two whole runs: where it was edited, what is shown, and what a part of it can start from.
use crate::{
    analysis::Analysed,
    document::Document,
    part::{Base, Plan, has_directive},
    snapshot::Need,
    text::Text,
    to_proto::MOST as MOST_FINDINGS,
};
use core::ops::Range;
use std::sync::Arc;
use tower_lsp::lsp_types::{Diagnostic, Position, Url};
use trunnion_check::Diagnostic as Found;

/// The lines round an edit that are judged at once, where nothing says which lines are visible.
const ROUND: usize = 100;

/// More lines are not visible at once.
const MOST_VISIBLE: usize = 1000;

/// Edited lines with more bytes are not read at each edit.
const MOST_BYTES: usize = 1 << 16;

/// One finding as it was published.
#[derive(Clone)]
pub(crate) struct Published {
    pub(crate) diagnostic: Diagnostic,
    /// A part judges it anew where it stands: it follows from its place.
    pub(crate) of_place: bool,
}

/// See the module.
#[derive(Default)]
pub(crate) struct Large {
    /// Where parts start; `None` until the beginning is read.
    pub(crate) base: Option<Base>,
    /// The findings of the last whole run, moved with their lines.
    pub(crate) published: Vec<Published>,
    /// The first line that was edited since the last whole run.
    pub(crate) edited: Option<usize>,
    /// The line that was edited last.
    last: usize,
    /// An edit touched a comment that counts for the whole program: only the whole shows what it does.
    pub(crate) unsettled: bool,
    /// The lines that the client asked about last.
    pub(crate) visible: Option<Range<usize>>,
    /// The client was told that the check runs.
    pub(crate) told: bool,
}

impl Large {
    /// An edit of this text comes: whether it touches what counts for the whole program.
    pub(crate) fn before(&mut self, text: &Text, range: Range<usize>, new: &str) {
        let bytes = text.start_of(range.end + 1) - text.start_of(range.start);
        self.unsettled |= range.len() > MOST_VISIBLE || bytes > MOST_BYTES || has_directive(new.as_bytes());
        if !self.unsettled {
            let old = text.of_lines(range.start..range.end + 1).to_ascii_lowercase();
            self.unsettled = old.contains("trunnion");
        }
    }

    /// The lines of `range` were edited, and there are `more` lines now.
    pub(crate) fn after(&mut self, range: Range<usize>, more: i64) {
        let (first, last) = (range.start, range.end);
        self.edited = Some(self.edited.map_or(first, |edited| edited.min(first)));
        self.last = last.saturating_add_signed(more as isize);
        self.told = false;
        self.published.retain_mut(|one| {
            let at = one.diagnostic.range;
            let before = (at.end.line as usize) < first;
            let behind = at.start.line as usize > last;
            if behind {
                shift(&mut one.diagnostic, last, more);
            }
            before || behind || !one.of_place
        });
    }

    /// Takes a whole run, and what is published of it.
    pub(crate) fn take(&mut self, analysed: &Analysed, list: &[Diagnostic]) {
        let Some((source, session)) = analysed.judged() else {
            *self = Self::default();
            return;
        };
        let found = session.report.diagnostics.iter().map(Found::is_of_place);
        // the last one may say how many are not shown
        let of_place = found.chain(core::iter::repeat(false));
        let one = |(diagnostic, of_place): (&Diagnostic, bool)| Published {
            diagnostic: diagnostic.clone(),
            of_place,
        };
        self.published = list.iter().zip(of_place).map(one).collect();
        self.base = analysed.session.as_ref().map(|session| Base {
            resolved: Arc::clone(&source.resolved),
            whole: Some((Arc::clone(session), analysed.lines_are_blocks)),
        });
        (self.edited, self.unsettled) = (None, false);
    }

    /// Takes the findings of a part in place of those that stood in its lines: all that is to be published.
    pub(crate) fn with_part(&mut self, lines: &Range<usize>, of_part: Vec<Diagnostic>) -> Vec<Diagnostic> {
        let stays = |one: &Published| !one.of_place || !lines.contains(&(one.diagnostic.range.start.line as usize));
        self.published.retain(stays);
        // those of the part come first, so that they are shown where the list is full
        let of_part = of_part.into_iter().map(|diagnostic| Published {
            diagnostic,
            of_place: true,
        });
        self.published.splice(0..0, of_part);
        let shown = self.published.iter().take(MOST_FINDINGS + 1);
        let mut list: Vec<Diagnostic> = shown.map(|one| one.diagnostic.clone()).collect();
        list.sort_by_key(|one| (one.range.start, one.range.end));
        list
    }

    /// The lines to judge at once after an edit: those the client shows, if the edit is among them, else those round it.
    pub(crate) fn wanted(&self, lines: usize) -> Range<usize> {
        let round = self.last.saturating_sub(ROUND)..(self.last + ROUND).min(lines);
        match &self.visible {
            Some(visible) if visible.contains(&self.last) => {
                visible.start.min(round.start)..visible.end.max(round.end).min(lines)
            }
            _ => round,
        }
    }
}

/// Moves a finding behind line `last` by so many lines.
fn shift(found: &mut Diagnostic, last: usize, lines: i64) {
    let moved = |at: &mut Position| {
        if at.line as usize > last {
            at.line = u32::try_from(i64::from(at.line) + lines).unwrap_or_default();
        }
    };
    moved(&mut found.range.start);
    moved(&mut found.range.end);
    for related in found.related_information.iter_mut().flatten() {
        moved(&mut related.location.range.start);
        moved(&mut related.location.range.end);
    }
}

impl Document {
    /// Notes which lines the client shows.
    pub(crate) fn shows(&mut self, lines: &Range<usize>) {
        if let Some(large) = &mut self.large
            && lines.len() <= MOST_VISIBLE
        {
            large.visible = Some(lines.clone());
        }
    }

    /// How lines of a long document are read, or judged too, before the whole is.
    pub(crate) fn plan(&self, uri: &Url, lines: Range<usize>, need: Need) -> Option<Plan> {
        let large = self.large.as_ref()?;
        if need == Need::Analysed && large.unsettled {
            return None;
        }
        let base = large.base.clone()?;
        let end = lines.end.min(self.text.lines());
        (lines.start < end && lines.len() <= MOST_VISIBLE).then(|| Plan {
            uri: uri.clone(),
            version: self.version,
            text: self.text.clone(),
            base,
            edited: large.edited.unwrap_or(0),
            lines: lines.start..end,
        })
    }

    /// The lines to judge at once after an edit.
    pub(crate) fn part_after_edit(&self, uri: &Url) -> Option<Plan> {
        let lines = self.large.as_ref()?.wanted(self.text.lines());
        self.plan(uri, lines, Need::Analysed)
    }
}
