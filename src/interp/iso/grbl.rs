//! Blocks that grbl 1.1 refuses as a whole: nothing of them is done. Source: grbl 1.1, gcode.c (checks of words and commands).
use super::Iso;
use crate::codes::Found;
use crate::core::Report;
use crate::words::Words;
use crate::{FaultKind, Refusal};
use trunnion_dialect::Action;
use trunnion_syntax::{Address, Value};

/// MAX_TOOL_NUMBER of grbl's config.h, as it is delivered.
const MOST_TOOLS: f64 = 255.0;

/// The sort of a code that takes the axis words of its block for itself; a block has one at most.
fn axis_command(action: Action, id: &str) -> Option<u8> {
    match action {
        Action::Rapid | Action::Linear | Action::ArcClockwise | Action::ArcCounterClockwise => Some(0),
        _ if id.starts_with("G38") => Some(0),
        Action::DataEntry | Action::ReferenceReturn | Action::ReferenceReturnOther | Action::PositionSet => Some(1),
        Action::ToolLengthOff => Some(2),
        _ if id == "G43.1" => Some(2),
        _ => None,
    }
}

impl Iso<'_> {
    /// Whether grbl refuses the block; says why.
    pub(super) fn grbl_refuses(&self, codes: &[Found<'_>], words: &Words, report: &mut Report<'_>) -> bool {
        let has = |action: Action| codes.iter().any(|found| found.code.action == action);
        let mut sorts: Vec<u8> = codes
            .iter()
            .filter_map(|found| axis_command(found.code.action, &found.code.id))
            .collect();
        sorts.sort_unstable();
        sorts.dedup();
        let motion = codes
            .iter()
            .find(|found| axis_command(found.code.action, &found.code.id) == Some(0))
            .map(|found| found.code.action)
            .or(self.core.state.motion.filter(|_| !has(Action::CycleOff)));
        let straight = matches!(motion, Some(Action::Rapid | Action::Linear));
        let refused = if let Some(letter) = Self::negative_word(report) {
            Some((
                Refusal::Number,
                format!("{letter} is negative: grbl takes no negative F, N, P, S or T"),
                "negative-value",
            ))
        } else if words.tool.number().is_some_and(|tool| tool.value > MOST_TOOLS) {
            let message = "a tool number above 255".to_owned();
            Some((Refusal::Number, message, "tool-number"))
        } else if sorts.len() > 1 {
            let message = "two codes of the block use its axis words (G0 to G3, G38; G10, G28, G30, G92; G43.1, G49): write them in two blocks";
            Some((Refusal::GroupConflict, message.to_owned(), "axis-conflict"))
        } else if has(Action::Dwell) && !words.p.is_given() {
            let message = "G4 without P, its time in seconds".to_owned();
            Some((Refusal::MissingWord, message, "dwell-time-missing"))
        } else if has(Action::PositionSet) && !words.axes.any() {
            let message = "G92 without an axis word".to_owned();
            Some((Refusal::MissingWord, message, "axis-missing"))
        } else if has(Action::MachineCoordinates) && !straight {
            let message = "G53 needs G0 or G1".to_owned();
            Some((Refusal::Other, message, "machine-motion"))
        } else {
            None
        };
        let Some((refusal, message, mistake)) = refused else {
            return false;
        };
        let alarm = self.core.dialect.alarm(mistake).map(|alarm| alarm.number.clone());
        let message = format!("{message}: the whole block is not done");
        report.fault(
            report.whole(),
            FaultKind::Rejected {
                refusal,
                message,
                alarm,
            },
        );
        true
    }

    /// The first negative word among those that must not be.
    fn negative_word(report: &Report<'_>) -> Option<char> {
        let block = report.program.block(report.block);
        block.words().find_map(|word| match (word.address, word.value) {
            (Address::Letter(letter @ (b'F' | b'N' | b'P' | b'S' | b'T')), Value::Number(number)) => {
                (number.to_f64() < 0.0).then_some(char::from(letter))
            }
            _ => None,
        })
    }
}
