//! What a block does to the spindle apart from M3 and M4: before its motion, and after it.
use super::Iso;
use crate::codes::BlockCodes;
use crate::words::Words;

impl Iso<'_> {
    /// Before the motion of the block.
    pub(super) fn spindle_before(&mut self, words: &Words) {
        let spindle = &mut self.core.state.spindle;
        if words.other_spindle {
            spindle.lose();
        }
        if words.builder_code {
            spindle.may_start();
        }
        // it stands at its position (SINUMERIK Function Manual, 06/2019, p. 754)
        if words.positions_spindle {
            spindle.switch(false);
        }
    }

    /// After the motion of the block: M5, by ISO 6983-1 (table of miscellaneous functions: M05 begins after the motion of its block), and the
    /// stops of the program.
    pub(super) fn spindle_after(&mut self, block: &BlockCodes) {
        self.memory.cycle.tapped &= block.stops_program.is_none();
        let stops = self.core.dialect.quirks.program_stop_stops_spindle;
        let spindle = &mut self.core.state.spindle;
        if block.stops_spindle {
            spindle.switch(false);
        }
        match block.stops_program {
            Some(false) if stops => spindle.switch(false),
            Some(_) => spindle.leave_to_machine(),
            None => {}
        }
    }
}
