//! The effects of an ISO block: those of its codes and words that are neither in its motions nor in the modal state.
mod assignments;
mod collected;
mod lengths;
mod lines;
mod message;
mod moment;
mod parts;
mod situation;
mod sort;
mod speed;
mod unread;

use crate::codes::{BlockCodes, Found, dwell_reads};
use crate::iso::Iso;
use crate::words::Words;
use crate::written::{Keep, written};
use crate::{Argument, Effect, FaultKind, Motion, Reach};
pub(crate) use assignments::Names;
use assignments::{
    comments, declarations, named_effects, named_words, reads_machine_position, system_assignment, unknown_assignment,
};
pub(crate) use collected::{Effects, Settings};
pub use situation::Situation;
use sort::{
    READ_COMMENTS, Sort, all_arguments, arguments, chosen, coolant, couples, is_frame, is_modal_call, is_plain_cycle,
    letter_bit, name_of, said, sort, speed_limit, takes_axes, tells, uncouples,
};
use trunnion_dialect::{Action, Macros, Role};
use trunnion_syntax::Block;
pub(crate) use unread::refused;
use unread::{ends_unknown, has_unread};

/// Whether a fault means that its block does more than its motions and the modal state contain.
pub(crate) fn has_other_effects(kind: &FaultKind) -> bool {
    !matches!(
        kind,
        FaultKind::MissingFeed { .. }
            | FaultKind::ArcRadiusMismatch { .. }
            | FaultKind::ArcFitsAbsolute { .. }
            | FaultKind::ArcRadiusTooSmall { .. }
            | FaultKind::VectorNotUnit { .. }
            | FaultKind::AmbiguousDecimal
            | FaultKind::UnusedWord
            | FaultKind::TcpState(_)
            | FaultKind::MissingProgramEnd
            | FaultKind::CompensationLeft
            | FaultKind::AptVectorMissing
            | FaultKind::WorkOffsetUnset { .. }
            | FaultKind::ToolLengthUnset { .. }
            | FaultKind::ToolDefinedTwice { .. }
    )
}

impl Iso<'_> {
    /// What the codes and the words S, T and D of a block set or do, before its motion.
    #[cold]
    pub(crate) fn code_effects(&mut self, codes: &[Found<'_>], words: &Words, taken: &BlockCodes, view: &Block<'_>) {
        let block = self.core.main_block(view.id());
        if self.core.setup.control.block_delete.is_none() {
            self.deleted_parts(view, block);
        }
        named_effects(self, view, block);
        // S and T act before the codes of their block
        self.word_effects(codes, words, block);
        let mut free = self.free_letters(words);
        // read by a setting below
        let mut held = 0;
        self.cycle_effects(codes, words, view);
        let mut opaque = Vec::new();
        for found in codes {
            if tells(found) {
                self.message_effect(found, view, block);
            }
            match sort(found, words) {
                Sort::Held => free &= !crate::unused::letters(found.code),
                Sort::Setting("speed limit") => {
                    let to = [Argument::code(found.code.id.clone()), said("S", words.speed)];
                    self.core.effects.add(block, Effect::set(speed_limit(found), to));
                    free = 0;
                    held = u32::MAX;
                }
                // after the motion
                Sort::Setting(_) if found.code.action == Action::SpindleStop => {
                    let own = crate::unused::letters(found.code) & words.letters;
                    (free, held) = (free & !own, held | own);
                }
                Sort::Setting(key) => {
                    let mut to = vec![Argument::code(found.code.id.clone())];
                    // S and D are settings of their own
                    let own =
                        crate::unused::letters(found.code) & words.letters & !(letter_bit(b'S') | letter_bit(b'D'));
                    to.extend(arguments(words, own));
                    free &= !own;
                    held |= own;
                    self.core.effects.add(block, Effect::set(key, to));
                }
                Sort::Group if coolant(found.code).is_some() => {
                    for (key, on) in coolant(found.code).into_iter().flatten().filter(|(_, on)| *on) {
                        let to = on.then(|| Argument::code("on")).into_iter().collect::<Vec<_>>();
                        self.core.effects.add(block, Effect::set(*key, to));
                    }
                }
                Sort::Group | Sort::Before => opaque.push(found),
                Sort::After => {}
            }
        }
        let unread = self.untaken(codes, words, taken);
        if codes.iter().any(|found| found.code.action == Action::ProgramStop) {
            let own = codes
                .iter()
                .fold(0, |all, found| all | crate::unused::letters(found.code));
            free = (free | unread) & !own;
        } else {
            free |= unread & !held;
        }
        if !self.core.dialect.quirks.declares_names() && words.letters & letter_bit(b'D') != 0 && !words.edge.is_given()
        {
            let to = [said("D", words.letter(b'D'))];
            self.core.effects.add(block, Effect::set("radius offset", to));
            free &= !letter_bit(b'D');
        }
        let mut rest: Vec<Argument> = if words.flow {
            Vec::new()
        } else {
            arguments(words, free).collect()
        };
        self.hole_words_in_mm(view, &mut rest);
        self.reference_effects(codes, words, block);
        self.mirrored_compensation(block);
        if opaque.is_empty() && !rest.is_empty() {
            self.core.effects.add(block, Effect::Event(rest));
        } else if let [found] = opaque[..]
            && matches!(sort(found, words), Sort::Group)
        {
            let key = found.code.group.clone().unwrap_or_default();
            let mut to = vec![name_of(found, view)];
            to.extend(rest);
            self.core.effects.add(block, Effect::set(key, to));
        } else if !opaque.is_empty() {
            self.several(&opaque, rest, words, view);
        }
    }

    /// Several codes that are compared by their words, or one that happens once: the codes in a fixed order, with all words that
    /// nothing else reads.
    fn several(&mut self, opaque: &[&Found<'_>], rest: Vec<Argument>, words: &Words, view: &Block<'_>) {
        let block = self.core.main_block(view.id());
        let mut alone = Vec::new();
        for found in opaque {
            let grouped = matches!(sort(found, words), Sort::Group);
            if grouped && rest.is_empty() {
                let key = found.code.group.clone().unwrap_or_default();
                let to = [name_of(found, view)];
                self.core.effects.add(block, Effect::set(key, to));
            } else {
                alone.push(found);
            }
        }
        if alone.is_empty() {
            return;
        }
        let coordinates = alone.iter().any(|found| takes_axes(found.code));
        let mut event: Vec<Argument> = alone.iter().map(|found| name_of(found, view)).collect();
        if alone
            .iter()
            .any(|found| READ_COMMENTS.contains(&found.code.id.as_str()))
        {
            event.extend(comments(view));
        }
        event.sort_by(|a, b| a.name.cmp(&b.name));
        event.extend(rest);
        if coordinates {
            event.retain(|argument| argument.name.len() > 1);
            event.extend(all_arguments(words));
            self.in_one_unit(&alone, words, &mut event);
            if self.core.state.coordinates.incremental() {
                event.push(Argument::code("incremental"));
            }
        }
        self.core.effects.add(block, Effect::Event(event));
    }

    /// The cycle that a block begins or ends.
    fn cycle_effects(&mut self, codes: &[Found<'_>], words: &Words, view: &Block<'_>) {
        let block = self.core.main_block(view.id());
        let plain = codes.iter().any(|found| is_plain_cycle(found.code));
        for found in codes {
            if is_modal_call(found.code) && (plain || !found.with_arguments && codes.len() == 1) {
                // it is in the motions, or ends
                self.core.effects.add(block, Effect::set("cycle", []));
            } else if couples(found.code.action) && !is_plain_cycle(found.code) {
                let mut to = vec![name_of(found, view)];
                let letters = match found.code.action {
                    Action::VariableThread | Action::Thread => letter_bit(b'Q') | letter_bit(b'K'),
                    Action::ThreadRepeatCycle => crate::unused::letters(found.code),
                    _ => letter_bit(b'Q') | letter_bit(b'I') | letter_bit(b'J'),
                };
                to.extend(self.arguments_in_mm(found.code, words, letters));
                // the first block of G76 only sets data for the second
                let data = found.code.action == Action::ThreadRepeatCycle && !words.axes.any();
                let key = if data { "cycle data" } else { "cycle" };
                self.core.effects.add(block, Effect::set(key, to));
            } else if uncouples(found.code.action) {
                self.core.effects.add(block, Effect::set("cycle", []));
            }
        }
    }

    /// S, T, D.
    fn word_effects(&mut self, codes: &[Found<'_>], words: &Words, block: trunnion_syntax::BlockId) {
        let limits = codes
            .iter()
            .any(|found| matches!(sort(found, words), Sort::Setting("speed limit")));
        if words.speed.is_given() && !limits && !dwell_reads(codes, "S") {
            self.speed_effects(words, block);
        } else {
            self.kept_speed(codes, block);
        }
        if words.tool.is_given() {
            // the word counts beside the tool where it says more: T0101
            let mut to = vec![chosen(self.core.tools.prepared()), said("T", words.tool)];
            to.dedup();
            self.core.effects.add(block, Effect::set("tool prepared", to));
        }
        if words.tool.is_given() || codes.iter().any(|found| found.code.action == Action::ToolChange) {
            let to = [chosen(self.core.tools.in_spindle())];
            self.core.effects.add(block, Effect::set("tool in use", to));
        }
        if codes.iter().any(|found| found.code.action == Action::ToolChange) {
            let change = vec![Argument::code("tool change")];
            self.core.effects.add(block, Effect::Event(change));
            let quirks = &self.core.dialect.quirks;
            if !quirks.tool_word.changes() {
                self.stop_effects(quirks.tool_change_stops_spindle, block);
            }
        }
        if words.edge.is_given() {
            self.core.effects.add(block, Effect::set("D", [said("D", words.edge)]));
        }
        if words.length_offset.is_given() {
            self.core
                .effects
                .add(block, Effect::set("H", [said("H", words.length_offset)]));
        }
    }

    /// Letters of parameters in the block that no active cycle reads.
    fn free_letters(&self, words: &Words) -> u32 {
        let parameters = (b'A'..=b'Z')
            .filter(|letter| self.core.dialect.role(*letter) == Some(Role::Parameter))
            .fold(0, |all, letter| all | letter_bit(letter));
        let cycle = self
            .core
            .state
            .motion
            .is_some_and(|motion| motion.is_hole_cycle() || motion.is_pass_cycle());
        let in_force = if words.builder_code {
            u32::MAX
        } else if cycle {
            self.memory.cycle.letters | letter_bit(b'R') | letter_bit(b'P') | letter_bit(b'Q')
        } else {
            0
        };
        words.letters & parameters & !in_force
    }

    /// What happens after the block's motion: stops, coolant off, the program's end, and the words of a block that does more than is
    /// modelled.
    #[cold]
    pub(crate) fn late_effects(
        &mut self,
        view: &Block<'_>,
        codes: &[Found<'_>],
        words: &Words,
        motions: &[Motion],
        (has_other_effects, ambiguous): (bool, bool),
    ) {
        let block = self.core.main_block(view.id());
        let named = words.axes.given | words.axes.unread;
        let unknown_end = motions.iter().any(|motion| ends_unknown(motion, named));
        let frame = codes.iter().any(|found| is_frame(found.code.action));
        let offset = codes
            .iter()
            .any(|found| matches!(found.code.action, Action::WorkOffset | Action::WorkSystem));
        let lost = self.core.state.zero.values().iter().any(|value| value.is_nan()) || self.core.state.zero.is_lost();
        let unknown_frame = (frame || offset) && lost || frame && self.core.state.position.xyz().is_none();
        let unread = has_unread(words);
        if frame && !unknown_frame {
            let words = written(view, self, words, Keep::All);
            self.core.effects.keep_frame(words);
        }
        self.core.effects.release_frames(block, unknown_end);
        let dwell = |found: &Found<'_>| found.code.action == Action::Dwell;
        let unclear = words.p.number().is_some_and(|p| p.has_point) && self.core.dialect.quirks.macros == Macros::Fanuc
            || words.feed.is_given() && !self.core.dialect.quirks.user_names();
        let ambiguous = ambiguous || codes.iter().any(dwell) && unclear || self.dwells_in_hole(words);
        if ambiguous {
            self.core.effects.ambiguous_number(block);
        }
        let moved = !motions.is_empty() && !unknown_end && !unread;
        self.moment_effects(codes, words, motions, block);
        if has_other_effects || unknown_end || unknown_frame || unread {
            let keep = if moved && !frame && !words.forgets_all {
                Keep::BesideMotion
            } else {
                Keep::All
            };
            let mut arguments = written(view, self, words, keep);
            self.hole_words_in_mm(view, &mut arguments);
            // the cycle that runs after each motion
            arguments.extend(
                self.memory
                    .cycle
                    .call
                    .as_ref()
                    .filter(|_| has_other_effects)
                    .map(|call| call.said.clone()),
            );
            if !arguments.is_empty()
                && codes
                    .iter()
                    .any(|found| READ_COMMENTS.contains(&found.code.id.as_str()))
            {
                arguments.extend(comments(view));
            }
            if !arguments.is_empty() {
                self.core.effects.add(block, Effect::Unmodelled(arguments));
            }
        } else if let Some(arguments) = unknown_assignment(self, view, words) {
            self.core.effects.add(block, Effect::Unmodelled(arguments));
        }
        if reads_machine_position(view) {
            // machine coordinates depend on work offsets that may not be declared
            let text = view.program().text(view.range());
            let words = vec![Argument::text("", &crate::canonical_text(&text))];
            self.core.effects.add(block, Effect::Unmodelled(words));
        }
        if words.declares && self.core.dialect.quirks.user_names() {
            let arguments = declarations(self, view);
            if !arguments.is_empty() {
                self.core.effects.add(block, Effect::Unmodelled(arguments));
            }
        }
        if let Some(effect) = system_assignment(self, view) {
            self.core.effects.add(block, effect);
        }
        self.after_motion(codes, words, view);
    }

    /// What the codes of a block do after its motion.
    fn after_motion(&mut self, codes: &[Found<'_>], words: &Words, view: &Block<'_>) {
        let block = self.core.main_block(view.id());
        if codes
            .iter()
            .any(|found| matches!(sort(found, words), Sort::Setting("coordinates")))
        {
            self.core.effects.add(block, Effect::set("coordinates", []));
        }
        for found in codes {
            match sort(found, words) {
                Sort::After => {
                    let mut event = vec![Argument::code(found.code.id.clone())];
                    event.extend(arguments(words, crate::unused::letters(found.code) & words.letters));
                    if READ_COMMENTS.contains(&found.code.id.as_str()) {
                        event.extend(comments(view));
                    }
                    // the operator may do anything at a stop; the control continues from where it was
                    self.core.effects.add_with(block, Effect::Event(event), Reach::Itself);
                    if found.code.action == Action::ProgramStop {
                        let stops = self.core.dialect.quirks.program_stop_stops_spindle && found.code.id == "M0";
                        self.stop_effects(stops, block);
                    }
                }
                Sort::Group => {
                    for (key, _) in coolant(found.code).into_iter().flatten().filter(|(_, on)| !*on) {
                        self.core.effects.add(block, Effect::set(*key, []));
                    }
                }
                _ if found.code.action == Action::SpindleStop => {
                    let mut to = vec![Argument::code(found.code.id.clone())];
                    to.extend(arguments(words, crate::unused::letters(found.code) & words.letters));
                    if found.code.id == "M19" {
                        to.extend(named_words(self, view));
                    }
                    self.core.effects.add(block, Effect::set("spindle", to));
                }
                _ if found.code.action == Action::ProgramEnd => {
                    let event = vec![Argument::code(found.code.id.clone())];
                    self.core.effects.add(block, Effect::End(event));
                }
                _ => {}
            }
        }
    }
}
