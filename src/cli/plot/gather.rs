//! Runs a program for a picture: its record, and the blocks that a check finds.
use crate::cli::legs::each_leg;
use crate::cli::load::Loaded;
use trunnion_check::Status;
use trunnion_machine::Machine;
use trunnion_plot::{Mark, Record, Recorder};
use trunnion_syntax::LineIndex;

/// The record of the program, or of the blocks between two lines.
pub(crate) fn gather(loaded: &Loaded, machine: &Machine, lines: Option<(u32, u32)>) -> Record {
    let index = LineIndex::new(loaded.program.source());
    let mut recorder = Recorder::new(machine);
    each_leg(loaded, machine, &index, lines, |leg, line, _| recorder.leg(leg, line));
    recorder.finish()
}

/// Rules about the machine's motion: those that a picture of joints or of the tool axis can show.
const SHOWN: [&str; 12] = [
    "pole-flip",
    "fast-pole",
    "pole-crossing",
    "branch-swap",
    "axis-limit",
    "axis-overspeed",
    "axis-acceleration",
    "feed-drop",
    "winding-limit",
    "angle-wrap",
    "excess-rotary-travel",
    "unreachable-orientation",
];

/// The blocks that a check finds, one mark a block and rule.
pub(crate) fn marks(loaded: &Loaded, lines: Option<(u32, u32)>) -> Vec<Mark> {
    let report = trunnion_check::check(&loaded.program, &loaded.resolved.settings());
    let index = LineIndex::new(loaded.program.source());
    let line = |at: u32| index.line_column(loaded.program.source(), at).0;
    let mut marks = Vec::new();
    for found in &report.diagnostics {
        if found.status != Status::Fail || !SHOWN.contains(&found.rule) {
            continue;
        }
        let (from, to) = (line(found.range.start), line(found.last.start));
        for line in from..=to.max(from) {
            if lines.is_none_or(|(first, last)| (first..=last).contains(&line)) {
                marks.push(Mark {
                    line,
                    rule: found.rule.to_owned(),
                });
            }
        }
    }
    marks
}
