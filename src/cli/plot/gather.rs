//! Runs a program for a picture: its record, and the blocks that a check finds.
use crate::cli::{
    failure::remark,
    legs::{each_leg_in, flat_setup},
    load::Loaded,
};
use std::collections::{BTreeMap, VecDeque};
use trunnion_check::{Diagnostic, Report, RuleLevel, Status, ValueKey};
use trunnion_interp::{ModalState, MotionKind, Setup};
use trunnion_machine::{AxisKind, BlockPath, Leg, Machine};
use trunnion_planner::{Listener, Timed, time};
use trunnion_plot::{AxisLetters, Mark, PlannedFeed, Record, Recorder, Shows, Unit};
use trunnion_syntax::LineIndex;

/// The record of the program, or of the blocks between two lines.
pub(crate) fn gather(loaded: &Loaded, machine: &Machine, lines: Option<(u32, u32)>, shows: Shows) -> Record {
    gather_in(loaded, (machine, &loaded.resolved.setup), lines, shows)
}

/// The same of its path alone: a linear axis that the program never names stands at 0.
pub(crate) fn gather_path(loaded: &Loaded, machine: &Machine, lines: Option<(u32, u32)>) -> Record {
    let shows = Shows {
        deviation: true,
        feed: false,
    };
    gather_in(loaded, (machine, &flat_setup(loaded, machine)), lines, shows)
}

fn gather_in(loaded: &Loaded, (machine, setup): (&Machine, &Setup), lines: Option<(u32, u32)>, shows: Shows) -> Record {
    let index = LineIndex::new(loaded.program.source());
    let mut recorder = Recorder::new(machine, shows);
    let mut inch = false;
    let given_up = each_leg_in(loaded, (machine, setup), &index, lines, |leg, line, state| {
        inch |= state.coordinates.is_inch();
        recorder.leg(leg, line);
    });
    if let Some(why) = given_up {
        remark(false, &format!("{why}; the picture ends there"));
    }
    let mut record = recorder.finish();
    record.unit = Unit::of_inch(inch);
    record
}

/// Adds the planned feeds to the blocks of a record.
pub(crate) fn plan(loaded: &Loaded, machine: &Machine, record: &mut Record) {
    let mut planned = Planned {
        loaded,
        machine,
        index: LineIndex::new(loaded.program.source()),
        waiting: VecDeque::new(),
        feeds: BTreeMap::new(),
    };
    let resolved = &loaded.resolved;
    time(
        &loaded.program,
        resolved.dialect,
        &resolved.setup,
        machine,
        &mut planned,
    );
    for block in &mut record.blocks {
        block.planned = planned
            .feeds
            .get_mut(&block.line)
            .and_then(VecDeque::pop_front)
            .flatten();
    }
}

/// The planned feeds of motions with a path, by line, in the order of the run.
struct Planned<'a> {
    loaded: &'a Loaded,
    machine: &'a Machine,
    index: LineIndex,
    /// Lines of motions whose time is not known yet; `None`: the motion has no path.
    waiting: VecDeque<Option<u32>>,
    feeds: BTreeMap<u32, VecDeque<Option<PlannedFeed>>>,
}

impl Listener for Planned<'_> {
    fn leg(&mut self, leg: &Leg, _: &ModalState, _: u32) {
        let drawn = !matches!(leg.motion.kind, MotionKind::Dwell(_)) && BlockPath::new(self.machine, leg).is_some();
        let program = &self.loaded.program;
        let start = program.block(leg.motion.block).range().start;
        let line = self.index.line_column(program.source(), start).0;
        self.waiting.push_back(drawn.then_some(line));
    }
    fn timed(&mut self, timed: &Timed, wait: bool) {
        if wait {
            return;
        }
        if let Some(Some(line)) = self.waiting.pop_front() {
            let plan = match (timed.reached, timed.leaves, timed.seconds[1]) {
                (Some(most), Some(end), Some(seconds)) if !timed.turns_only => Some(PlannedFeed {
                    most,
                    end,
                    length: timed.length,
                    seconds,
                }),
                _ => None,
            };
            self.feeds.entry(line).or_default().push_back(plan);
        }
    }
    fn reads_faults(&self) -> bool {
        false
    }
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
    let mut settings = loaded.resolved.settings();
    // what is not drawn is not looked for
    let others = trunnion_check::rules().iter().map(|rule| rule.name);
    let others = others.filter(|name| !SHOWN.contains(name));
    settings
        .rules
        .extend(others.map(|name| (name.to_owned(), RuleLevel::Allow)));
    let report = trunnion_check::check(&loaded.program, &settings);
    marks_of(&report, loaded, lines)
}

/// The same of a check that is done.
pub(crate) fn marks_of(report: &Report, loaded: &Loaded, lines: Option<(u32, u32)>) -> Vec<Mark> {
    let index = LineIndex::new(loaded.program.source());
    let line = |at: u32| index.line_column(loaded.program.source(), at).0;
    let mut spans = BTreeMap::<(&'static str, AxisLetters), Vec<(u32, u32)>>::new();
    for found in report.findings() {
        if found.status == Status::Fail && SHOWN.contains(&found.rule) {
            let (from, to) = (line(found.range.start), line(found.last.start));
            let of = (found.rule, axes(found, loaded.resolved.machine.as_ref()));
            spans.entry(of).or_default().push((from, to.max(from)));
        }
    }
    let mut marks = Vec::new();
    for ((rule, axes), mut spans) in spans {
        spans.sort_unstable();
        // findings overlap: a line is marked once
        let mut next = 0;
        for (from, to) in spans {
            let seen =
                (from.max(next)..=to).filter(|line| lines.is_none_or(|(first, last)| (first..=last).contains(line)));
            marks.extend(seen.map(|line| Mark { line, rule, axes }));
            next = next.max(to + 1);
        }
    }
    marks.sort_by_key(|mark| (mark.rule, mark.line));
    marks.dedup_by(|mark, kept| {
        let same = (mark.rule, mark.line) == (kept.rule, kept.line);
        if same {
            kept.axes = kept.axes.and(mark.axes);
        }
        same
    });
    marks
}

/// The axes that a finding is about.
fn axes(found: &Diagnostic, machine: Option<&Machine>) -> AxisLetters {
    let named = found.values.iter().find_map(|(key, value)| match value {
        ValueKey::Text(name) if *key == "axis" => Some(name.as_str()),
        _ => None,
    });
    let mut letters = named.unwrap_or_default().chars();
    if let (Some(letter), None) = (letters.next(), letters.next()) {
        return AxisLetters::one(letter);
    }
    let turns = matches!(found.rule, "pole-crossing" | "branch-swap" | "excess-rotary-travel");
    let rotary = machine.into_iter().filter(|_| turns).flat_map(Machine::own_axes);
    let rotary = rotary.filter(|(_, axis)| axis.kind == AxisKind::Rotary);
    let letters = rotary.map(|(_, axis)| AxisLetters::one(char::from(axis.letter)));
    letters.reduce(AxisLetters::and).unwrap_or_default()
}
