//! One pass over a program: takes what the run finds and shows it to the rules.
use crate::assumed::Assumed;
use crate::config::Scope;
use crate::coverage::Tally;
use crate::cuts::{Cuts, Started, report_still};
use crate::datum::{Assume, Datum};
use crate::look::Looker;
use crate::pace::Pace;
use crate::report::Summary;
use crate::sink::{Active, Reporter, active};
use crate::start::Start;
use crate::suppress::Suppressions;
use crate::told::text_rule_reported;
use crate::trail::{Trail, axes_chord};
use crate::view::{InForce, LegView, MotionView};
use crate::visited::Visited;
use crate::waiting::Waiting;
use crate::wake::{Ending, Wake, possible_of_leg, possible_of_motion};
use crate::{Report, Settings};
use trunnion_dialect::Dialect;
use trunnion_interp::{ChainId, Fault, Interpreter, LengthOf, ModalState, Motion, Placed, ProgramRun, Sink};
use trunnion_machine::{Follower, Leg, Sine};
use trunnion_syntax::{BlockId, Program};

mod partial;
mod text;

pub(crate) use partial::PassMemory;
use partial::weigh;

/// One pass over a program.
pub(crate) struct Pass<'a> {
    reporter: Reporter<'a>,
    dialect: &'a Dialect,
    /// Rules of the text, of the program and of faults.
    rules: Vec<Active>,
    motions: Waiting,
    legs: Waiting,
    /// The modal state of the last motion.
    in_force: Option<InForce>,
    /// The tool of the last feed motion.
    last_cut: Option<u32>,
    last_length: Option<LengthOf>,
    last_approach: Option<u32>,
    looker: Option<Looker<'a>>,
    assume: Assume,
    datum: Option<Datum>,
    suppressions: &'a Suppressions,
    ported: bool,
    follower: Option<Follower<'a>>,
    /// The last leg, kept for its storage.
    leg: Option<Box<Leg>>,
    /// Sign of the last posture off the pole.
    posture: i8,
    trail: Trail,
    pace: Option<Pace<'a>>,
    summary: Summary,
    visited: Visited,
    /// The block that ran last.
    last_ran: Option<BlockId>,
    executed: u64,
    tally: Tally,
    assumed: Assumed,
    /// `None` where motions are not judged.
    cuts: Option<Cuts>,
    start: Start,
    /// Only a part of the program is checked; whether the rest decides how it goes on.
    part: Option<bool>,
}

impl<'a> Pass<'a> {
    pub(crate) fn new(program: &'a Program, settings: &Settings<'a>, suppressions: &'a Suppressions) -> Self {
        let (legs, rest): (Vec<_>, Vec<_>) = active(&settings.rules)
            .into_iter()
            .partition(|rule| rule.wake.level() == "machine");
        let (mut motions, rules): (Vec<_>, _) = rest.into_iter().partition(|rule| rule.wake.reads_motions());
        // a unit that is assumed is listed among the assumptions
        motions.retain(|rule| !(settings.assume.power_on && rule.name == "units-unset"));
        if settings.scope() < Scope::Motion {
            motions.clear();
        }
        let waiting = |rules| Waiting {
            rules,
            awake: (None, Vec::new()),
        };
        Self {
            reporter: Reporter::new(program, settings.dialect, suppressions)
                .judging_machine(settings.judged_machine().is_some())
                .knowing_control(settings.control_known)
                .powered_on_with(settings.setup.control.power_on.as_deref()),
            dialect: settings.dialect,
            rules,
            motions: waiting(motions),
            legs: waiting(legs),
            in_force: None,
            last_cut: None,
            last_length: None,
            last_approach: None,
            looker: settings.judged_machine().map(Looker::new),
            assume: settings.assume,
            datum: settings
                .judged_machine()
                .map(|machine| Datum::new(machine, settings.assume)),
            suppressions,
            ported: !settings.port_to.is_empty(),
            follower: settings.judged_machine().map(Follower::new),
            leg: None,
            posture: 0,
            trail: Trail::default(),
            pace: settings
                .judged_machine()
                .map(|machine| Pace::new(machine, settings.dialect)),
            summary: Summary::default(),
            visited: Visited::new(program.block_count()),
            last_ran: None,
            executed: 0,
            tally: Tally::new(settings.dialect),
            assumed: Assumed::default(),
            start: Start::new(settings),
            part: None,
            cuts: (settings.scope() >= Scope::Motion).then(Cuts::default),
        }
    }

    /// Reports errors and what is undecided only: see [`crate::check_objections`].
    pub(crate) fn objections_only(&mut self) {
        self.reporter.objections_only();
        let objects = |rule: &Active| matches!(rule.wake, Wake::Pace(..)) && rule.may_be_error();
        if !self.legs.rules.iter().any(objects) {
            self.pace = None;
        }
    }

    /// Whether the time depends on what the program does apart from its motions: path control, M codes.
    pub(crate) fn wants_effects(&self) -> bool {
        self.pace
            .as_ref()
            .is_some_and(|pace| pace.wants_effects(self.reporter.program()))
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

    #[inline]
    fn read_leg(&mut self, leg: &Leg) {
        let (Some(follower), Some(looker)) = (&self.follower, &mut self.looker) else {
            return;
        };
        let machine = follower.machine();
        if let (Some(datum), Some(in_force)) = (&mut self.datum, &self.in_force) {
            datum.add(leg, in_force, self.reporter.program());
        }
        let chord = axes_chord(leg);
        self.trail.add(machine, leg, chord);
        self.assumed.swivels((machine, self.dialect), leg);
        let possible = possible_of_leg(&looker.look(leg, self.posture, &self.trail, chord));
        let awake = self.legs.awake(possible);
        let view = LegView::new((machine, self.dialect), leg, self.posture, &self.trail);
        let (block, number) = (leg.motion.block, self.summary.motions);
        for rule in awake {
            self.reporter.enter(rule, Some(block), number);
            rule.wake.read_leg(&view, &mut self.reporter);
            self.reporter.leave();
        }
        self.legs
            .assert_silent(&mut self.reporter, (block, number), |wake, out| {
                wake.read_leg(&view, out);
            });
        self.pace.iter_mut().for_each(|pace| pace.add(&view));
        match &leg.end {
            Ok(end) if end.branch == 0 => {}
            end => self.posture = end.as_ref().map_or(0, |end| end.branch),
        }
    }

    /// Whether a rule was checked, so that its silence means something.
    fn was_checked(&self, name: &str) -> bool {
        let has = |rules: &[Active]| rules.iter().any(|rule| rule.name == name);
        let asked = |rule: &Active| match rule.wake {
            Wake::End(_) | Wake::Coverage(_) => false,
            Wake::Port(_) => self.ported,
            _ => true,
        };
        let machine = self.follower.is_some() && has(&self.legs.rules);
        machine || has(&self.motions.rules) || self.rules.iter().any(|rule| rule.name == name && asked(rule))
    }

    /// What was found; `interpreter` is at its end and knows the call chains.
    pub(crate) fn finish(mut self, interpreter: &Interpreter<'_>) -> Report {
        let cycle_time_s = self.pace.as_mut().and_then(Pace::finish);
        let was_checked = |name: &str| self.was_checked(name);
        let ending = Ending {
            unused: self.suppressions.unused(&was_checked),
            of_caller: self.start.of_caller(&self.reporter),
        };
        let assumed = self.datum.iter().flat_map(Datum::assumed);
        let listed = assumed.map(|missing| missing.assumption(self.dialect));
        let [unit, relied] = self.start.assumptions(self.reporter.program(), self.dialect);
        let others = listed.chain(self.assumed.listed()).chain(relied);
        let assumptions = unit.into_iter().chain(others).collect();
        let mut reporter = self.reporter;
        if let Some(cuts) = &self.cuts {
            let spindle = interpreter.state().spindle;
            let started = Started::of(spindle.was_started(), spindle.is_unread());
            report_still(cuts, &self.rules, &mut reporter, started);
        }
        reporter.origin(false, ChainId::MAIN);
        ask(&self.rules, &mut reporter, (None, 0), |wake, out| {
            if let Wake::End(rule) = wake {
                rule(&ending, out);
            }
        });
        if let Some(follower) = &self.follower {
            reporter.word_worst(follower.machine(), &self.legs.rules);
        }
        self.pace
            .iter()
            .for_each(|pace| pace.report(&self.legs.rules, &mut reporter));
        if let Some(datum) = &self.datum {
            for overrun in datum.overruns() {
                reporter.origin(false, overrun.chain);
                let block = (Some(overrun.block), 0);
                ask(&self.legs.rules, &mut reporter, block, |wake, out| {
                    if let Wake::Overrun(rule) = wake {
                        rule(overrun, out);
                    }
                });
            }
            for open in datum.open() {
                reporter.origin(false, open.chain);
                ask(&self.legs.rules, &mut reporter, (Some(open.block), 0), |wake, out| {
                    if let Wake::Open(rule) = wake {
                        rule(&open, out);
                    }
                });
            }
        }
        let mut diagnostics = reporter.finish(&|chain| interpreter.chain(chain));
        self.assumed.relies_on_caller(ending.of_caller.is_some());
        weigh(&self.assumed, self.follower.as_ref(), &mut diagnostics);
        let mut summary = self.summary;
        summary.count(&diagnostics);
        let mut report = Report {
            diagnostics,
            summary,
            cycle_time_s,
            coverage: self.tally.coverage(summary.motions, self.visited, self.last_ran),
            assumptions,
        };
        if interpreter.state().coordinates.is_inch() {
            report.tell_inches();
        }
        report
    }
}

/// Asks rules one after the other. `at`: the block they look at, and its number in the run.
pub(crate) fn ask(
    rules: &[Active],
    reporter: &mut Reporter<'_>,
    at: (Option<BlockId>, u64),
    mut ask: impl FnMut(Wake, &mut Reporter<'_>),
) {
    for rule in rules {
        reporter.enter(rule, at.0, at.1);
        ask(rule.wake, reporter);
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
            "what is in effect changed with a line"
        );
        if self.in_force.is_none() {
            return self.motion(motion, state);
        }
        self.take_line(motion);
    }

    fn effect(&mut self, effect: Placed) {
        if let Some(pace) = &mut self.pace {
            pace.effect(&effect);
        }
    }

    fn fault(&mut self, fault: Fault) {
        if text_rule_reported(self.reporter.program(), &fault) || self.leaves_part(&fault) {
            return;
        }
        if self.assumed.takes(&fault, &self.reporter, self.assume.tool_length) {
            return;
        }
        self.tally.fault(&fault);
        self.reporter.origin(self.visited.has(fault.block), ChainId::MAIN);
        let at = (Some(fault.block), self.executed);
        self.reporter.place.clone_from(&fault.place);
        ask(&self.rules, &mut self.reporter, at, |wake, out| {
            wake.read_fault(&fault, out);
        });
        self.reporter.place = None;
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

    /// Sets the predicted sine of a rotary axis.
    #[inline]
    pub(crate) fn set_predicted_sine(&mut self, index: usize, sine: Sine) {
        if let Some(follower) = &mut self.follower {
            follower.set_predicted_sine(index, sine);
        }
    }

    /// `next`: it is a line as [`Self::take_line`] wants it.
    fn judge(&mut self, motion: &Motion, in_force: &InForce, next: bool) {
        self.summary.motions += 1;
        self.tally.motion(motion);
        // cutter compensation emits a motion when the next block is known: that is not a further pass of its block
        let late = motion.chain == ChainId::MAIN && self.last_ran == Some(motion.block);
        self.reporter
            .origin(self.visited.has(motion.block) && !late, motion.chain);
        let view = MotionView {
            motion,
            in_force,
            last_cut: self.last_cut,
            last_length: self.last_length,
            last_approach: self.last_approach,
            dialect: self.dialect,
        };
        if motion.is_feed() {
            self.last_cut = motion.tool;
            self.last_length = in_force.tool_length_mm.map(|_| in_force.length_of);
        }
        if motion.is_feed() || view.approaches() {
            self.last_approach = motion.tool;
        }
        let (block, number) = (motion.block, self.summary.motions);
        if let Some(cuts) = &mut self.cuts {
            let allowed = || self.suppressions.allows("spindle-off-cut", block);
            cuts.add(motion, in_force, allowed);
        }
        self.start.add(&view);
        for rule in self.motions.awake(possible_of_motion(&view)) {
            self.reporter.enter(rule, Some(block), number);
            rule.wake.read_motion(&view, &mut self.reporter);
            self.reporter.leave();
        }
        self.motions
            .assert_silent(&mut self.reporter, (block, number), |wake, out| {
                wake.read_motion(&view, out);
            });
        if let Some(follower) = &mut self.follower {
            self.trail.clamps = in_force.clamps;
            self.trail.own_length_mm = in_force.own_length_mm;
            self.trail.tool = in_force.tool;
            self.trail.undeclared = self.assume.leaves(motion.undeclared);
            let mut leg = self.leg.take();
            if next {
                follower.follow_line_into(motion, &mut leg);
            } else {
                follower.follow_into(motion, &mut leg);
            }
            if let Some(leg) = &leg {
                self.read_leg(leg);
            }
            self.leg = leg;
        }
    }
}
