//! One pass over a program: takes what the run finds and shows it to the rules.
use crate::needs::{Facts, Needs};
use crate::report::Summary;
use crate::rule::{EndRule, Ending, FaultRule, InForce, LegRule, MotionRule, ProgramRule, TextRule};
use crate::sink::{Active, Reporter, active};
use crate::suppress::Suppressions;
use crate::time::CycleTime;
use crate::trail::{Trail, axes_chord};
use crate::view::{LegView, Overview};
use crate::visited::Visited;
use crate::{Level, Report, Settings};
use trunnion_interp::{ChainId, Fault, FaultKind, Interpreter, ModalState, Motion, ProgramRun, Refusal, Sink};
use trunnion_machine::{Follower, Leg, Sine};
use trunnion_syntax::{BlockId, Program, SyntaxErrorKind};

/// One pass over a program.
pub(crate) struct Pass<'a> {
    reporter: Reporter<'a>,
    text: Vec<Active<TextRule>>,
    whole: Vec<Active<ProgramRule>>,
    faults: Vec<Active<FaultRule>>,
    motions: Vec<Active<(Needs, MotionRule)>>,
    /// What held of the last motion, where it gave none of them anything to look at.
    silent: Option<Needs>,
    /// What is in force with the last motion.
    in_force: Option<InForce>,
    /// The tool of the last feed motion.
    last_cut: Option<u32>,
    legs: Vec<Active<(Needs, LegRule)>>,
    /// What shows for a leg which of them can have anything to report.
    facts: Option<Facts<'a>>,
    /// Those that the last leg asked, and what held of it.
    asked: (Option<Needs>, Vec<Active<LegRule>>),
    ends: Vec<Active<EndRule>>,
    suppressions: &'a Suppressions,
    ported: bool,
    follower: Option<Follower<'a>>,
    /// The last leg, kept for its storage.
    leg: Option<Box<Leg>>,
    /// Sign of the last posture off the pole.
    posture: i8,
    trail: Trail,
    time: CycleTime,
    summary: Summary,
    visited: Visited,
    /// The block that ran last.
    last_ran: Option<BlockId>,
    executed: u64,
}

impl<'a> Pass<'a> {
    pub(crate) fn new(program: &'a Program, settings: &Settings<'a>, suppressions: &'a Suppressions) -> Self {
        let levels = &settings.rules;
        Self {
            reporter: Reporter::new(program, &settings.dialect.name, suppressions),
            text: active(levels, |level| match level {
                Level::Text(run) | Level::TextAndFault(run, _) => Some(run),
                _ => None,
            }),
            whole: active(levels, |level| match level {
                Level::Program(run) => Some(run),
                _ => None,
            }),
            faults: active(levels, |level| match level {
                Level::Fault(run) | Level::TextAndFault(_, run) => Some(run),
                _ => None,
            }),
            motions: active(levels, |level| match level {
                Level::Motion(needs, run) => Some((needs, run)),
                _ => None,
            }),
            silent: None,
            in_force: None,
            last_cut: None,
            legs: active(levels, |level| match level {
                Level::Leg(needs, run) => Some((needs, run)),
                _ => None,
            }),
            ends: active(levels, |level| match level {
                Level::End(run) => Some(run),
                _ => None,
            }),
            suppressions,
            ported: !settings.port_to.is_empty(),
            facts: settings.machine.map(Facts::new),
            asked: (None, Vec::new()),
            follower: settings.machine.map(Follower::new),
            leg: None,
            posture: 0,
            trail: Trail::default(),
            time: CycleTime::default(),
            summary: Summary::default(),
            visited: Visited::new(program.block_count()),
            last_ran: None,
            executed: 0,
        }
    }

    /// The current position of the machine.
    pub(crate) fn follower(&self) -> Option<&Follower<'a>> {
        self.follower.as_ref()
    }

    /// How many blocks of the file have content.
    pub(crate) fn count_blocks(&mut self, blocks: u64) {
        self.summary.blocks = blocks;
    }

    /// A block ran; whether for the first time.
    pub(crate) fn ran(&mut self, block: BlockId) -> bool {
        self.executed += 1;
        self.last_ran = Some(block);
        self.visited.add(block)
    }

    pub(crate) fn read_text(&mut self, program: &Program) {
        // the block whose comment ends too early: to its author the text after that end is still comment
        let mut nested = None;
        for error in program.errors() {
            let block = program.block_at(error.range.start).unwrap_or_default();
            if nested == Some(block) {
                continue;
            }
            nested = (error.kind == SyntaxErrorKind::NestedComment).then_some(block);
            for rule in &self.text {
                self.reporter.enter(rule, Some(block), u64::from(block.0));
                (rule.run)(error, &mut self.reporter);
                self.reporter.leave();
            }
        }
    }

    /// Says that the file is UTF-16; false where the rule that says so is allowed.
    pub(crate) fn tell_utf16(&mut self) -> bool {
        let Some(rule) = self.text.iter().find(|rule| rule.name == "syntax-error") else {
            return false;
        };
        self.reporter.enter(rule, None, 0);
        crate::rules::report_utf16(&mut self.reporter);
        self.reporter.leave();
        true
    }

    pub(crate) fn read_whole(&mut self, overview: &Overview<'_>) {
        for rule in &self.whole {
            self.reporter.enter(rule, None, 0);
            (rule.run)(overview, &mut self.reporter);
            self.reporter.leave();
        }
    }

    /// `next`: see [`Self::take_line`].
    #[inline]
    fn read_leg(&mut self, leg: &Leg, next: bool) {
        let (Some(follower), Some(facts)) = (&self.follower, &mut self.facts) else {
            return;
        };
        let machine = follower.machine();
        let chord = axes_chord(leg);
        self.trail.add(machine, leg, chord);
        let holds = facts.of_leg(leg, next, self.posture, &self.trail, chord);
        if self.asked.0 != Some(holds) {
            // one leg is like the other in most programs
            let (of, asked) = &mut self.asked;
            *of = Some(holds);
            asked.clear();
            let met = self.legs.iter().filter(|rule| rule.run.0.are_met(holds));
            asked.extend(met.map(|rule| rule.with(rule.run.1)));
        }
        // for most blocks no rule has anything to look at
        if !self.asked.1.is_empty() || self.time.is_known() || cfg!(debug_assertions) {
            let view = LegView::new(machine, leg, self.posture, &self.trail);
            for rule in &self.asked.1 {
                self.reporter.enter(rule, Some(leg.motion.block), self.summary.motions);
                (rule.run)(&view, &mut self.reporter);
                self.reporter.leave();
            }
            if cfg!(debug_assertions) {
                see_silent(&self.legs, &mut self.reporter, &view, (holds, self.summary.motions));
            }
            self.time.add(&view, self.reporter.dialect());
        }
        match &leg.end {
            Ok(end) if end.branch != 0 => self.posture = end.branch,
            Ok(_) => {}
            Err(_) => self.posture = 0,
        }
    }

    /// Whether the rules of the text have already reported this place.
    fn text_has_told(&self, fault: &Fault) -> bool {
        let refused = matches!(
            fault.kind,
            FaultKind::Rejected {
                refusal: Refusal::Syntax | Refusal::Number | Refusal::Expression,
                ..
            }
        );
        refused && {
            let program = self.reporter.program();
            let errors = program.errors();
            // the missing value is expected where it should begin, after the blanks
            let before = &program.source()[..fault.range.start as usize];
            let blanks = before.iter().rev().take_while(|byte| matches!(byte, b' ' | b'\t'));
            let start = fault.range.start - blanks.count() as u32;
            let from = errors.partition_point(|error| error.range.end < start);
            errors[from..].iter().any(|error| error.range.start <= fault.range.end)
        }
    }

    /// Whether a rule was looked for, so that its silence says something.
    fn looked_for(&self, name: &str) -> bool {
        let motion =
            self.faults.iter().any(|rule| rule.name == name) || self.motions.iter().any(|rule| rule.name == name);
        let text = self.text.iter().any(|rule| rule.name == name) || self.whole.iter().any(|rule| rule.name == name);
        let machine = self.follower.is_some() && self.legs.iter().any(|rule| rule.name == name);
        (motion || text || machine) && (name != "porting" || self.ported)
    }

    /// What was found; `interpreter` is at its end and knows the call chains.
    pub(crate) fn finish(self, interpreter: &Interpreter<'_>) -> Report {
        let cycle_time_s = if self.follower.is_some() {
            self.time.interval()
        } else {
            None
        };
        let looked_for = |name: &str| self.looked_for(name);
        let ending = Ending {
            unused: self.suppressions.unused(&looked_for),
        };
        let mut reporter = self.reporter;
        reporter.origin(false, ChainId::MAIN);
        for rule in &self.ends {
            reporter.enter(rule, None, 0);
            (rule.run)(&ending, &mut reporter);
            reporter.leave();
        }
        if let Some(follower) = &self.follower {
            reporter.word_worst(follower.machine(), &self.legs);
        }
        let diagnostics = reporter.finish(&|chain| interpreter.chain(chain));
        let mut summary = self.summary;
        summary.count(&diagnostics);
        Report {
            diagnostics,
            summary,
            cycle_time_s,
        }
    }
}

/// A debug build asks also the rules that a leg gives nothing to look at, and sees that they are silent. `at`: what holds of the leg, and
/// its number.
fn see_silent(
    legs: &[Active<(Needs, LegRule)>],
    reporter: &mut Reporter<'_>,
    view: &LegView<'_>,
    (holds, number): (Needs, u64),
) {
    for rule in legs.iter().filter(|rule| !rule.run.0.are_met(holds)) {
        reporter.enter(rule, Some(view.leg.motion.block), number);
        (rule.run.1)(view, reporter);
        debug_assert!(reporter.is_silent(), "{} needs less", rule.name);
        reporter.leave();
    }
}

impl Sink for Pass<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        self.take_motion(motion, InForce::of(state));
    }

    #[inline]
    fn next_line(&mut self, motion: &Motion, state: &ModalState) {
        debug_assert!(
            self.in_force
                .is_none_or(|own| format!("{own:?}") == format!("{:?}", InForce::of(state))),
            "what is in force changed with a line"
        );
        if self.in_force.is_none() {
            return self.motion(motion, state);
        }
        self.take_line(motion);
    }

    fn fault(&mut self, fault: Fault) {
        if self.text_has_told(&fault) {
            return;
        }
        self.reporter.origin(self.visited.has(fault.block), ChainId::MAIN);
        for rule in &self.faults {
            self.reporter.enter(rule, Some(fault.block), self.executed);
            (rule.run)(&fault, &mut self.reporter);
            self.reporter.leave();
        }
    }
}

impl Pass<'_> {
    /// Judges a motion.
    pub(crate) fn take_motion(&mut self, motion: &Motion, in_force: InForce) {
        self.in_force = Some(in_force);
        self.judge(motion, &in_force, false);
    }

    /// Judges a line that differs from the motion before it in what [`Sink::next_line`] says and in nothing else.
    pub(crate) fn take_line(&mut self, motion: &Motion) {
        // there was a motion before it, and it carries what is active
        if let Some(in_force) = self.in_force {
            self.judge(motion, &in_force, true);
        }
    }

    /// What is foreseen of a rotary axis.
    #[inline]
    pub(crate) fn foresee(&mut self, index: usize, sine: Sine) {
        if let Some(follower) = &mut self.follower {
            follower.foresee(index, sine);
        }
    }

    /// `next`: it is a line as [`Self::take_line`] wants it.
    fn judge(&mut self, motion: &Motion, in_force: &InForce, next: bool) {
        self.summary.motions += 1;
        // cutter compensation emits a motion when the next block is known: that is not a further pass of its block
        let late = motion.chain == ChainId::MAIN && self.last_ran == Some(motion.block);
        self.reporter
            .origin(self.visited.has(motion.block) && !late, motion.chain);
        let holds = Needs::of_motion(motion, in_force, self.last_cut);
        if motion.is_feed() {
            self.last_cut = motion.tool;
        }
        if self.silent != Some(holds) || cfg!(debug_assertions) {
            self.read_motion(motion, in_force, holds);
        }
        if let Some(follower) = &mut self.follower {
            self.trail.clamps = in_force.clamps;
            self.trail.own_length_mm = in_force.own_length_mm;
            let mut leg = self.leg.take();
            if next {
                follower.follow_line_into(motion, &mut leg);
            } else {
                follower.follow_into(motion, &mut leg);
            }
            if let Some(leg) = &leg {
                self.read_leg(leg, next);
            }
            self.leg = leg;
        }
    }

    /// Shows a motion to the rules that have something to look at; `holds`: what holds of it.
    fn read_motion(&mut self, motion: &Motion, in_force: &InForce, holds: Needs) {
        // only a debug build comes here then
        let silent = self.silent == Some(holds);
        self.silent = Some(holds);
        for rule in &self.motions {
            let (needs, run) = rule.run;
            let asked = needs.are_met(holds);
            if asked {
                debug_assert!(!silent, "{} would not be asked", rule.name);
                self.silent = None;
            }
            // a debug build asks them all and sees that the others are silent
            if asked || cfg!(debug_assertions) {
                self.reporter.enter(rule, Some(motion.block), self.summary.motions);
                run(motion, *in_force, &mut self.reporter);
                debug_assert!(asked || self.reporter.is_silent(), "{} needs less", rule.name);
                self.reporter.leave();
            }
        }
    }
}
