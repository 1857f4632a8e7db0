//! S as it is compared: under constant cutting speed in m/min, whichever the unit is.
use super::sort::said;
use crate::iso::Iso;
use crate::words::{WordValue, Words};
use crate::{Argument, Effect, Reach};
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

    /// The unit is another one than that in which S of G96 was given: whether its number or its speed stays is not known.
    pub(super) fn kept_cutting_speed(&mut self, block: BlockId) {
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
