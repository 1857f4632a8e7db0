//! Runs a program for a picture: its record, and the blocks that a check finds.
use crate::cli::load::Loaded;
use trunnion_check::Status;
use trunnion_interp::{Fault, Interpreter, ModalState, Motion, Sink};
use trunnion_machine::{Follower, Machine};
use trunnion_plot::{Mark, Record, Recorder};
use trunnion_syntax::{BlockId, LineIndex};

/// The record of the program, or of the blocks between two lines.
pub(crate) fn gather(loaded: &Loaded, machine: &Machine, lines: Option<(u32, u32)>) -> Record {
    let index = LineIndex::new(loaded.program.source());
    let mut gathering = Gathering {
        loaded,
        index: &index,
        follower: Follower::new(machine),
        recorder: Recorder::new(machine),
        lines,
    };
    trunnion_interp::run(
        &loaded.program,
        loaded.resolved.dialect,
        &loaded.resolved.setup,
        &mut gathering,
    );
    gathering.recorder.finish()
}

struct Gathering<'a> {
    loaded: &'a Loaded,
    index: &'a LineIndex,
    follower: Follower<'a>,
    recorder: Recorder<'a>,
    lines: Option<(u32, u32)>,
}

impl Sink for Gathering<'_> {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        let leg = self.follower.follow(motion);
        let program = &self.loaded.program;
        let start = program.block(motion.block).range().start;
        let line = self.index.line_column(program.source(), start).0;
        if self.lines.is_none_or(|(from, to)| (from..=to).contains(&line)) {
            self.recorder.leg(&leg, line);
        }
    }
    fn fault(&mut self, _fault: Fault) {}
    fn block_done(&mut self, _block: BlockId, _interpreter: &Interpreter<'_>) {}
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
