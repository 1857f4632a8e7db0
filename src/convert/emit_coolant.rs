//! Coolant in G-code.
use crate::Refused;
use crate::emit_code::Writer;
use crate::job::Coolant;
use trunnion_syntax::BlockId;

impl Writer<'_> {
    pub(crate) fn coolant(&mut self, coolant: Coolant, block: Option<BlockId>) -> Result<(), Refused> {
        if coolant == Coolant::ThruOff && !self.coolant_outside && self.post.template("coolant-thru-off").is_none() {
            // nothing else is on
            return self.template("coolant-off", block, |_| None);
        }
        match coolant {
            Coolant::Flood | Coolant::Mist | Coolant::Air => self.coolant_outside = true,
            Coolant::Off => self.coolant_outside = false,
            Coolant::Thru | Coolant::ThruOff => {}
        }
        let key = match coolant {
            Coolant::Flood => "coolant-flood",
            Coolant::Mist => "coolant-mist",
            Coolant::Thru => "coolant-thru",
            Coolant::Air => "coolant-air",
            Coolant::ThruOff => "coolant-thru-off",
            Coolant::Off => "coolant-off",
        };
        self.template(key, block, |_| None)
    }
}
