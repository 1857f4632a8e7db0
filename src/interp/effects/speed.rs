//! S as it is compared: under constant cutting speed in m/min, whichever the unit is.
use super::sort::said;
use crate::codes::Found;
use crate::iso::Iso;
use crate::words::{WordValue, Words};
use crate::{Argument, Effect, Reach};
use trunnion_dialect::Action;
use trunnion_syntax::BlockId;

/// mm per unit of lengths while no S of G96 was given in another one.
const METRIC: f64 = 1.0;

impl Iso<'_> {
    /// S of a block. Under G96 it is in m/min, or in feet per minute where lengths are in inches; of a Sinumerik it is not known for
    /// which of G70 and G700 that holds.
    pub(super) fn speed_effects(&mut self, words: &Words, block: BlockId) {
        let mut to = said("S", words.speed);
        let unit = self.core.state.coordinates.unit_mm();
        if self.core.state.spindle.surface_speed() {
            if self.core.dialect.quirks.user_names() && unit != METRIC {
                self.cutting_unit_unknown(unit, block);
            }
            if let (WordValue::Number(_), Some(speed)) = (words.speed, self.core.state.spindle.cutting_speed_m_min()) {
                to = Argument::number("S", speed);
            }
            self.core.effects.set_cutting_unit(unit);
        }
        self.core.effects.add(block, Effect::set("speed", [to]));
    }

    /// A block without S. G96 after G97, or G97 after G96: which speed it goes on with is not in the program. And where the unit is another one than
    /// that in which S of G96 was given, it is not known whether its number or its speed stays.
    pub(super) fn kept_speed(&mut self, codes: &[Found<'_>], block: BlockId) {
        let switches = |found: &&Found<'_>| {
            matches!(
                found.code.action,
                Action::ConstantSurfaceSpeed | Action::ConstantSpindleSpeed
            )
        };
        if let Some(found) = codes.iter().find(switches) {
            let before = self.core.effects.settings().get("speed mode");
            let before = before
                .and_then(|to| to.first())
                .map_or("G97", |first| first.name.as_ref());
            if before != found.code.id {
                self.core.effects.add(block, Effect::left("speed"));
            }
        }
        if !self.core.state.spindle.surface_speed() {
            return;
        }
        let unit = self.core.state.coordinates.unit_mm();
        if self.core.effects.cutting_unit() != unit {
            self.core.effects.set_cutting_unit(unit);
            self.cutting_unit_unknown(unit, block);
        }
    }

    fn cutting_unit_unknown(&mut self, unit: f64, block: BlockId) {
        let words = vec![Argument::code("S of G96"), Argument::number("mm per unit", unit)];
        self.core
            .effects
            .add_with(block, Effect::Unmodelled(words), Reach::Itself);
    }
}
