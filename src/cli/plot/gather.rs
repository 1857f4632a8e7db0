//! Runs a program for a picture: its record, and the blocks that a check finds.
use crate::cli::{failure::remark, legs::each_leg, load::Loaded};
use std::collections::BTreeMap;
use trunnion_check::Status;
use trunnion_machine::Machine;
use trunnion_plot::{Mark, Record, Recorder};
use trunnion_syntax::LineIndex;

/// The record of the program, or of the blocks between two lines.
pub(crate) fn gather(loaded: &Loaded, machine: &Machine, lines: Option<(u32, u32)>) -> Record {
    let index = LineIndex::new(loaded.program.source());
    let mut recorder = Recorder::new(machine);
    let given_up = each_leg(loaded, machine, &index, lines, |leg, line, _| recorder.leg(leg, line));
    if let Some(why) = given_up {
        remark(false, &format!("{why}; the picture ends there"));
    }
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

/// The blocks that a check finds, one mark per block and rule.
pub(crate) fn marks(loaded: &Loaded, lines: Option<(u32, u32)>) -> Vec<Mark> {
    let report = trunnion_check::check(&loaded.program, &loaded.resolved.settings());
    let index = LineIndex::new(loaded.program.source());
    let line = |at: u32| index.line_column(loaded.program.source(), at).0;
    let mut spans = BTreeMap::<&str, Vec<(u32, u32)>>::new();
    for found in report.findings() {
        if found.status == Status::Fail && SHOWN.contains(&found.rule) {
            let (from, to) = (line(found.range.start), line(found.last.start));
            spans.entry(found.rule).or_default().push((from, to.max(from)));
        }
    }
    let mut marks = Vec::new();
    for (rule, mut spans) in spans {
        spans.sort_unstable();
        // findings overlap: a line is marked once
        let mut next = 0;
        for (from, to) in spans {
            for line in from.max(next)..=to {
                if lines.is_none_or(|(first, last)| (first..=last).contains(&line)) {
                    let rule = rule.to_owned();
                    marks.push(Mark { line, rule });
                }
            }
            next = next.max(to + 1);
        }
    }
    marks
}
