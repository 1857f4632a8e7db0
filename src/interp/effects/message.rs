//! MSG of a Sinumerik: what the operator reads.
use super::sort::name_of;
use crate::codes::Found;
use crate::iso::Iso;
use crate::written::{call_argument, resolved};
use crate::{Argument, Effect};
use trunnion_syntax::{Block, BlockId};

impl Iso<'_> {
    /// The message with its values. One with a second argument may be a block of its own, at which the axes stop: what it does there is not taken
    /// from a source.
    pub(super) fn message_effect(&mut self, found: &Found<'_>, view: &Block<'_>, block: BlockId) {
        let text = view.program().text(found.range);
        let to = if found.with_arguments {
            call_argument(&found.code.id, &resolved(self, &text))
        } else {
            name_of(found, view)
        };
        self.core.effects.add(block, Effect::set("message", [to]));
        let after_text = text.rsplit_once('"').map_or("", |(_, rest)| rest);
        if after_text.contains(',') {
            let said = Argument::text("", &crate::canonical_text(&text));
            self.core.effects.add(block, Effect::Unmodelled(vec![said]));
        }
    }
}
