//! The picture of feeds.
use super::header;
use crate::cli::{failure::Failure, load::Loaded};
use std::path::Path;
use trunnion_interp::ModalState;
use trunnion_machine::{Leg, Machine};
use trunnion_planner::{Listener, Timed, time};
use trunnion_plot::{FeedSpan, feed};
use trunnion_syntax::LineIndex;

struct Spans<'a> {
    loaded: &'a Loaded,
    machine: &'a Machine,
    index: LineIndex,
    lines: Option<(u32, u32)>,
    spans: Vec<FeedSpan>,
}

impl Listener for Spans<'_> {
    fn leg(&mut self, _: &Leg, _: &ModalState, _: u32) {}

    fn timed(&mut self, timed: &Timed, _: bool) {
        let (Some(feed), Some(reached), Some(lowest), false) =
            (timed.feed, timed.reached, timed.lowest, timed.turns_only)
        else {
            return;
        };
        let program = &self.loaded.program;
        let line = self
            .index
            .line_column(program.source(), program.block(timed.block).range().start)
            .0;
        if self.lines.is_none_or(|(from, to)| (from..=to).contains(&line)) {
            self.spans.push(FeedSpan {
                line,
                length: timed.length,
                feed,
                reached: [reached, lowest],
                limited_by: timed.limited_by(self.machine),
            });
        }
    }
}

/// Runs the program and draws its feeds.
pub(super) fn draw(
    loaded: &Loaded,
    machine: &Machine,
    lines: Option<(u32, u32)>,
    file: &Path,
) -> Result<String, Failure> {
    let mut spans = Spans {
        loaded,
        machine,
        index: LineIndex::new(loaded.program.source()),
        lines,
        spans: Vec::new(),
    };
    let resolved = &loaded.resolved;
    time(&loaded.program, resolved.dialect, &resolved.setup, machine, &mut spans);
    feed(&header("Programmed and reached feed", loaded, machine), &spans.spans)
        .map_err(|error| Failure::file(file, error))
}
