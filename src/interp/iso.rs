//! ISO blocks to motions.

mod engine;
mod grbl;
mod put_out;
mod signs;
mod spindle;
mod whole;

pub(crate) use engine::Iso;
pub(crate) use signs::below_zero;

use crate::Sink;
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::diameter::XWords;
use crate::words::Words;
use crate::{FaultKind, Motion};
use trunnion_dialect::Action;
use trunnion_syntax::{Block, BlockId, Item};

/// Whether a block begins with `/`.
fn is_deleted(block: &Block<'_>) -> bool {
    let begins = |item: &Item| matches!(item, Item::Word(_) | Item::Label(_) | Item::Skip(..));
    // OSP takes it behind the number of the block too
    let mut first = block.items().take(2).take_while(begins);
    first.any(|item| matches!(item, Item::Skip(..)))
}

impl<'d> Iso<'d> {
    /// Runs one ISO block. Blocks that begin with `/` are skipped where the switch for that is known to be on.
    pub(crate) fn step_iso(&mut self, block: &Block<'_>, sink: &mut impl Sink) {
        if self.core.setup.control.block_delete == Some(true) && is_deleted(block) {
            return;
        }
        if self.memory.passed_over.is_some() && self.is_passed_over(block.id()) {
            if self.core.effects.wanted() {
                self.contour_effects(block, sink);
            }
            return;
        }
        if self.core.dialect.quirks.dollar_commands && self.grbl_line(block, sink) {
            return;
        }
        let mut codes = std::mem::take(&mut self.codes);
        codes.clear();
        let (mut has_other_effects, mut ambiguous) = (false, false);
        let mut words = Words::default();
        let motion = {
            let mut report = Report {
                program: block.program(),
                block: block.id(),
                record: None,
                faults: &mut |fault| {
                    has_other_effects |= crate::effects::has_other_effects(&fault.kind);
                    ambiguous |= fault.kind == FaultKind::AmbiguousDecimal;
                    sink.fault(fault);
                },
            };
            self.read(block, &mut codes, &mut words, &mut report);
            self.percent(&words);
            if words.has_content {
                self.core.last_content = Some(block.id());
            }
            if words.has_content && !self.core.state.ended {
                let switches = |found: &Found<'_>| XWords::is_set_by(found.code.action);
                if self.core.dialect.quirks.diameter
                    || self.core.setup.control.implicit_decimals.is_some()
                    || self.memory.x_words != XWords::AsDeclared
                    || codes.iter().any(switches)
                {
                    self.adjust(&codes, &mut words, &mut report);
                }
                self.run_block(&mut codes, &words, &mut report)
            } else {
                None
            }
        };
        if self.core.effects.wanted() && (self.refused_text(block) | words.has_content) {
            self.collect(
                block,
                (&codes, &words),
                motion.as_ref(),
                (has_other_effects, ambiguous),
                sink,
            );
        }
        self.put_out(motion.as_ref(), block, sink);
        if self.memory.zero_after.is_some() {
            self.restore_zero();
        }
        self.codes = codes;
    }

    /// Emits the effects of a block.
    #[cold]
    fn collect(
        &mut self,
        block: &Block<'_>,
        (codes, words): (&[Found<'d>], &Words),
        motion: Option<&Motion>,
        (has_other_effects, ambiguous): (bool, bool),
        sink: &mut impl Sink,
    ) {
        let several: Vec<Motion>;
        let motions = if self.memory.out.is_empty() {
            motion.map_or(&[][..], core::slice::from_ref)
        } else {
            several = self.memory.out.iter().chain(motion).copied().collect();
            &several
        };
        let has_other_effects = has_other_effects || self.memory.frames.entering_data && codes.is_empty();
        self.late_effects(block, codes, words, motions, (has_other_effects, ambiguous));
        self.core.emit_effects(sink);
    }

    /// Whether a block belongs to the contour of the turning cycle before it, which has run it.
    pub(crate) fn passes_over(&self, block: BlockId) -> bool {
        let contour = self.memory.passed_over;
        contour.is_some_and(|(from, to)| from < block.0 && block.0 <= to)
    }

    /// The same; behind it the contour is forgotten.
    #[cold]
    fn is_passed_over(&mut self, block: BlockId) -> bool {
        let over = self.passes_over(block);
        if !over {
            self.memory.passed_over = None;
        }
        over
    }

    /// The second `%`, or one after content, ends the text.
    fn percent(&mut self, words: &Words) {
        if words.percent.is_some() {
            let ends = self.memory.percent_seen || self.core.last_content.is_some();
            self.memory.percent_seen = true;
            if ends {
                self.core.state.ended = true;
                self.core.proper_end |= self.core.dialect.quirks.percent_ends_program;
            }
        }
    }

    fn run_block(&mut self, codes: &mut [Found<'d>], words: &Words, report: &mut Report<'_>) -> Option<Motion> {
        if words.declares || self.core.dialect.quirks.dollar_commands && self.grbl_refuses(codes, words, report) {
            return None;
        }
        if let (Some(range), true) = (
            words.program_number,
            words.forgets_all || !codes.is_empty() && words.first.is_none(),
        ) {
            // O100 SUB, O100 CALL: the flow of the program is not followed
            let calls = codes
                .iter()
                .any(|found| found.code.kind == trunnion_dialect::CodeKind::Name);
            if calls {
                let what = report.program.text(range).into_owned();
                report.fault(range, FaultKind::NotModelled { what });
                self.core.forget_everything();
                return None;
            }
        }
        let ends_data = |found: &Found<'_>| matches!(found.code.action, Action::DataEntryEnd | Action::ProgramEnd);
        if self.memory.frames.entering_data && !codes.iter().any(ends_data) {
            if self.core.effects.wanted() {
                self.data_effect(&report.program.block(report.block));
            }
            return None;
        }
        self.spline_before(codes, words, report);
        let block = self.apply(codes, words, report);
        let replaced;
        let words = if self.memory.own.path.any() {
            replaced = self.with_path_words(words, &block, report);
            &replaced
        } else {
            words
        };
        if words.letters & self.judged_letters() != 0 {
            self.unused_words(codes, words, &block, report);
        }
        self.corner_word(words, &block);
        if self.core.state.compensation != 0 && self.core.dialect.quirks.offset_compensation {
            self.cutter_number(words, report);
        }
        self.spindle_before(words);
        if self.core.dialect.quirks.macro_b() {
            self.signs(words, &block, report);
        } else if self.core.dialect.quirks.declares_names() {
            self.numbers_from_zero(words, block.dwell, report);
        } else if block.dwell {
            self.dwell_sign(words, report);
        }
        if self.core.effects.wanted() {
            self.code_effects(codes, words, &block, &report.program.block(report.block));
        }
        self.length_travels(words, &block, report);
        let open = self.core.state.length.is_open();
        let returned = open.then(|| self.after_return(words, &block, report));
        self.vectors_of_machine(codes);
        let mut motion = self.motion(codes, returned.flatten().as_ref().unwrap_or(words), &block, report);
        self.judge_unmeasured(motion.as_ref(), report);
        self.memory.length_base = None;
        if block.machine_coordinates {
            self.length_after_return(words.axes.given | words.axes.unread);
        }
        self.called_motions(codes, words, &block, &mut motion, report);
        self.block_rules(codes, words, report);
        self.spindle_after(&block);
        if words.forgets_all {
            self.core.losses += 1;
            self.core.forget_position();
            // what is not understood may be a call
            self.core.state.clamps.lose();
        }
        if words.writes_system {
            self.system_changed();
        }
        if block.end {
            if self.core.state.compensation != 0 {
                report.fault(report.whole(), FaultKind::CompensationLeft);
            }
            self.core.state.ended = true;
            self.core.proper_end = true;
        }
        motion
    }

    /// The block's motion, if it has one.
    fn motion(
        &mut self,
        codes: &[Found<'d>],
        words: &Words,
        block: &BlockCodes,
        report: &mut Report<'_>,
    ) -> Option<Motion> {
        if block.dwell {
            let dwell = self.dwell(codes, words, report);
            let beside = Self::axes_beside_dwell(codes, words);
            if beside == 0 {
                return Some(dwell);
            }
            self.memory.out.push(dwell);
            if !self.core.dialect.quirks.dwell_then_moves {
                return Some(self.moved_with_dwell(beside, words, report));
            }
        }
        let modal = self.core.state.motion;
        let is_arc = matches!(modal, Some(Action::ArcClockwise | Action::ArcCounterClockwise));
        let begins = is_arc && (words.centre.any() || words.radius.is_given()) && block.motion.is_some();
        let circle = begins || self.circle_goes_on(codes, words, block);
        if let Some(repeated) = block.repeated {
            if self.core.dialect.quirks.whole_numbers.lengths_ambiguous() && repeated.has_coordinates(words) {
                self.whole_numbers(words, report);
            }
            self.repeated_cycle(repeated, words, report);
            return None;
        }
        if block.returns.is_some() || block.pattern.is_some() || block.pocket {
            return self.special_motion(words, block, report);
        }
        if words.radius.is_given()
            && modal.is_some_and(Action::is_hole_cycle)
            && !block.takes_coordinates
            && !block.not_modelled
        {
            return self.cycle_motion(words, report);
        }
        let by_vector = words.vector.any() || (self.core.state.tool_axis.vectors() && !is_arc && words.centre.any());
        if block.takes_coordinates || !(words.axes.any() || by_vector || circle) {
            return None;
        }
        let unmodelled = block.not_modelled || words.unknown_code || words.forgets_all || words.polynomial;
        if modal == Some(Action::NotModelled)
            && let Some(spline) = self.spline(codes, words, block)
        {
            return self.spline_motion(spline, words, block, report);
        }
        self.memory.own.splines.pole = None;
        if modal == Some(Action::Polynomial) && !by_vector {
            return Some(self.polynomial_motion(words, block, report));
        }
        if words.polynomial {
            let what = "PO: a polynomial where POLY is not in effect".to_owned();
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
        }
        match modal {
            Some(
                Action::Rapid
                | Action::Linear
                | Action::ArcClockwise
                | Action::ArcCounterClockwise
                | Action::ArcThroughPoint
                | Action::ArcTangent
                | Action::Thread
                | Action::VariableThread,
            ) if !unmodelled => {
                if self.core.dialect.quirks.whole_numbers.lengths_ambiguous() {
                    self.whole_numbers(words, report);
                }
                Some(self.modelled_motion(words, block, report))
            }
            Some(motion) if !unmodelled && (motion.is_hole_cycle() || motion.is_pass_cycle()) => {
                self.cycle_motion(words, report)
            }
            _ if unmodelled || modal.is_some() => Some(self.unknown_motion(words, report)),
            _ => {
                let what = "coordinates before any motion code".to_owned();
                report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
                Some(self.unknown_motion(words, report))
            }
        }
    }

    /// Motions of a canned cycle.
    fn cycle_motion(&mut self, words: &Words, report: &mut Report<'_>) -> Option<Motion> {
        if self.core.dialect.quirks.whole_numbers.lengths_ambiguous() {
            self.whole_numbers(words, report);
        }
        if self.core.state.motion.is_some_and(Action::is_pass_cycle) {
            self.pass_cycle(words, report);
        } else {
            self.hole_cycle(words, report);
        }
        None
    }

    /// Motions of codes that apply to one block.
    fn special_motion(&mut self, words: &Words, block: &BlockCodes, report: &mut Report<'_>) -> Option<Motion> {
        if self.core.dialect.quirks.whole_numbers.lengths_ambiguous() {
            self.whole_numbers(words, report);
        }
        if let Some((returns, range)) = block.returns {
            self.returns(returns, range, words, report);
        }
        if let Some(pattern) = block.pattern {
            self.pattern(pattern, words, report);
        }
        if block.pocket {
            self.pocket(words, report);
        }
        None
    }
}
