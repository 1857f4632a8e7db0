//! What a block does to the spindle apart from M3 and M4: before its motion, and after it.
use super::Iso;
use crate::FaultKind;
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::reader::Reader;
use crate::words::Words;
use trunnion_dialect::Role;
use trunnion_syntax::{TextRange, Value, Word};

/// M codes that turn, orient or load the spindle that their number names.
const OF_SPINDLE: [f64; 5] = [3.0, 4.0, 5.0, 6.0, 19.0];

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// `S1=900`, `M1=3` of a Sinumerik: those of the spindle with that number. S0= and M0= are the main spindle's (SINUMERIK ONE Programming
    /// Manual, 12/2019, p. 372); which number it has is machine data (20090; Function Manual W1, 11/2006, 2.2.5). False: other words.
    pub(crate) fn spindle_word(&mut self, role: Role, (letter, index): (u8, u16), word: &Word) -> bool {
        let Some(own) = self.own.as_ref().filter(|own| !own.is_task) else {
            return false;
        };
        let main = own.main_spindle;
        let of_spindle = match word.value {
            _ if role == Role::Speed => true,
            Value::Number(number) => OF_SPINDLE.contains(&number.to_f64()),
            _ => false,
        };
        if !of_spindle {
            return false;
        }
        if index == 0 || main == Some(u32::from(index)) {
            self.role_word(role, letter, word);
            return true;
        }
        self.words.has_values = true;
        if main.is_some() {
            // of another spindle: it moves nothing
            self.not_modelled(word.range);
            return true;
        }
        match role {
            Role::Speed => self.words.speed = crate::words::WordValue::Unread,
            _ => self.words.other_spindle = true,
        }
        let what = format!(
            "{}: whether spindle {index} is the main spindle (declare [control] main_spindle)",
            self.text(word.range).trim()
        );
        (self.report)(word.range, FaultKind::NotModelled { what });
        true
    }
}

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

    /// SETMS(n): S and M3 to M5 are those of spindle n from here on; SETMS: those of the machine's main spindle again (SINUMERIK ONE
    /// Programming Manual, 12/2019, p. 372).
    pub(crate) fn names_main_spindle(&mut self, found: &Found<'_>, report: &Report<'_>) {
        let text = report.program.text(found.range);
        let number = match text.split_once('(') {
            None => self.core.setup.control.main_spindle,
            Some((_, number)) => number
                .trim_end()
                .strip_suffix(')')
                .and_then(|number| number.trim().parse().ok()),
        };
        let before = std::mem::replace(&mut self.memory.own.main_spindle, number);
        if before.is_none() || before != number {
            self.core.state.spindle.forget();
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
