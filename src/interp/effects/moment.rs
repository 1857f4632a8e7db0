//! When the codes of a block act that also moves.
use super::sort::{Sort, sort};
use crate::codes::Found;
use crate::iso::Iso;
use crate::words::Words;
use crate::{Argument, Effect, Motion, MotionKind};
use trunnion_dialect::{Action, CodeKind};

impl Iso<'_> {
    /// Codes of a block that moves, of which the control or the machine builder decides whether they act before the motion, with it or after it: they are
    /// not the same as in a block of their own.
    pub(super) fn moment_effects(
        &mut self,
        codes: &[Found<'_>],
        words: &Words,
        motions: &[Motion],
        block: trunnion_syntax::BlockId,
    ) {
        if motions.iter().all(|motion| matches!(motion.kind, MotionKind::Dwell(_))) {
            return;
        }
        let cuts = motions.iter().any(Motion::is_feed);
        let unsettled = |found: &Found<'_>| match found.code.action {
            // a rapid does not mind when the spindle stops; an oriented stop (M19) is there for what moves with it
            Action::SpindleStop => cuts || found.code.id != "M5",
            Action::ToolChange => true,
            Action::NoMotion => found.code.kind == CodeKind::M && matches!(sort(found, words), Sort::Before),
            _ => false,
        };
        let mut names: Vec<Argument> = codes
            .iter()
            .filter(|found| unsettled(found))
            .map(|found| Argument::code(found.code.id.clone()))
            .collect();
        if words.builder_code {
            names.push(Argument::code("M of the machine builder"));
        }
        if words.tool.is_given() && self.core.dialect.quirks.tool_word.changes() {
            names.push(Argument::code("T"));
        }
        if !names.is_empty() {
            names.sort_by(|a, b| a.name.cmp(&b.name));
            names.push(Argument::code("in the block of a motion"));
            self.core.effects.add(block, Effect::Unmodelled(names));
        }
    }

    /// The spindle and the coolant stop, or may do so.
    pub(super) fn stop_effects(&mut self, stop: bool, block: trunnion_syntax::BlockId) {
        let off: &[Argument] = if stop { &[Argument::code("M5")] } else { &[] };
        for (key, off) in [("spindle", off), ("flood coolant", &[]), ("mist coolant", &[])] {
            let effect = if stop { Effect::set(key, off) } else { Effect::left(key) };
            self.core.effects.add(block, effect);
        }
    }
}
