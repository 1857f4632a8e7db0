//! Parts of a block that are effects of their own: reference points, what block delete may leave out, words that nothing reads.
use crate::codes::{BlockCodes, Found};
use crate::deleted::skip_level;
use crate::iso::Iso;
use crate::words::Words;
use crate::written::calls_program;
use crate::{Argument, Effect, Reach};
use trunnion_dialect::{Action, CodeKind};
use trunnion_syntax::{Block, Item};

impl Iso<'_> {
    /// A return to a reference point: which point it is, and that it is a return. Where no axis is named the machine decides which move.
    pub(super) fn reference_effects(&mut self, codes: &[Found<'_>], words: &Words, block: trunnion_syntax::BlockId) {
        let reference = |action| {
            matches!(
                action,
                Action::ReferenceCheck
                    | Action::ReferenceReturn
                    | Action::ReferenceReturnOther
                    | Action::ReferenceFrom
                    | Action::FixedPoint
            )
        };
        let mut to = Vec::new();
        for found in codes.iter().filter(|found| reference(found.code.action)) {
            to.push(Argument::code(found.code.id.clone()));
            if found.code.action == Action::ReferenceReturnOther {
                // without P it is the second
                to.push(Argument::number("P", words.p.number().map_or(2.0, |p| p.value)));
            }
            if found.code.action == Action::FixedPoint && !found.code.words.is_empty() {
                to.push(Argument::number("FP", words.p.number().map_or(1.0, |p| p.value)));
            }
        }
        let checks = codes.iter().any(|found| found.code.action == Action::ReferenceCheck);
        let moves = words.axes.any() || to.is_empty();
        if checks {
            // the control stops with an alarm where the axes do not stand at the reference point
            self.core.effects.add(block, Effect::Event(to));
        } else if moves {
            self.core.effects.add(block, Effect::set("reference point", to));
        } else {
            self.core.effects.add(block, Effect::Unmodelled(to));
        }
    }

    /// What the switch for block delete may leave out: the block, or its end.
    pub(super) fn deleted_parts(&mut self, view: &Block<'_>, block: trunnion_syntax::BlockId) {
        let mut after_slash = false;
        let mut rest = String::new();
        for item in view.items() {
            if calls_program(view, self, item) {
                // the slashes after it are those of a path
                break;
            }
            match item {
                Item::Skip(level, range) => {
                    // the switch decides whether the block runs at all
                    let level = skip_level(level, &view.program().text(range), self.core.dialect);
                    let words = vec![Argument::number("/", f64::from(level))];
                    self.core.effects.add_with(block, Effect::Event(words), Reach::Itself);
                }
                Item::Other(range) if view.program().text(range).starts_with('/') => {
                    after_slash = true;
                    rest.push_str(&view.program().text(range));
                }
                Item::Word(word) if after_slash => rest.push_str(&view.program().text(word.range)),
                _ => {}
            }
        }
        if after_slash {
            let words = vec![Argument::text("", &crate::canonical_text(&rest))];
            self.core.effects.add(block, Effect::Event(words));
        }
    }

    /// A block that the control refuses; false: it has none of such text.
    pub(crate) fn refused_text(&mut self, view: &Block<'_>) -> bool {
        let Some(effect) = super::unread::refused(view) else {
            return false;
        };
        self.core.effects.add(self.core.main_block(view.id()), effect);
        true
    }

    /// Parameters of the block that neither its codes nor the active codes read. The machine, or a macro that a code calls, may read them.
    pub(super) fn untaken(&self, codes: &[Found<'_>], words: &Words, taken: &BlockCodes) -> u32 {
        let opaque = words.builder_code || words.unknown_code || words.forgets_all || words.flow;
        if opaque || self.core.dialect.quirks.declares_names() {
            return 0;
        }
        // knots and weights of a curve that is not modelled, in blocks of their own
        let is_open = matches!(self.core.state.motion, Some(Action::NotModelled));
        let in_force = if is_open && !words.axes.any() {
            0
        } else {
            self.read_in_force(words, taken)
        };
        let read = codes
            .iter()
            .filter(|found| !(found.code.kind == CodeKind::M && found.code.action == Action::NoMotion))
            .fold(in_force, |read, found| {
                read | if found.code.kind == CodeKind::M {
                    crate::unused::letters(found.code)
                } else {
                    self.read_by(found.code)
                }
            });
        words.letters & crate::unused::PARAMETERS & !read
    }
}

impl Iso<'_> {
    /// Under a mirror G41 is on the right: the side that matters where the radius is unknown, and motions are the programmed ones.
    pub(super) fn mirrored_compensation(&mut self, block: trunnion_syntax::BlockId) {
        let state = &self.core.state;
        let mirrored = state.compensation != 0 && self.memory.frames.shape.flips(state.coordinates.plane());
        if std::mem::replace(&mut self.memory.compensation.mirrored, mirrored) != mirrored {
            let to: Vec<Argument> = mirrored.then(|| Argument::code("mirrored")).into_iter().collect();
            let effect = Effect::set("side of the compensation", to);
            self.core.effects.add(block, effect);
        }
    }
}
