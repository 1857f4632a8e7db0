//! Words that are lengths without being coordinates, in mm: of stored data, of cycles, of codes whose table names them.
use super::sort::{arguments, letter_bit};
use crate::codes::Found;
use crate::iso::Iso;
use crate::words::Words;
use crate::{Argument, FeedMode, Value};
use trunnion_dialect::{Action, Code};
use trunnion_syntax::{Address, Block};

/// Whether the numbers of a data entry are lengths where they are not angles: work offsets, and offsets of tools.
fn in_lengths(codes: &[&&Found<'_>], words: &Words) -> bool {
    let entry = |found: &&&Found<'_>| found.code.action == Action::DataEntry;
    codes.iter().all(entry) && matches!(words.letter(b'L').index(), Some(2 | 20 | 10..=13))
}

/// A length in programmed units becomes one in mm.
fn to_mm(argument: &mut Argument, unit_mm: f64) {
    if let (b"X" | b"Y" | b"Z" | b"U" | b"V" | b"W" | b"R", Value::Number(value)) =
        (argument.name.as_bytes(), &mut argument.value)
    {
        *value *= unit_mm;
    }
}

/// Whether the unit may change what codes do: M29 without numbers does the same in both.
fn may_read_unit(codes: &[&&Found<'_>], event: &[Argument]) -> bool {
    let plain = codes.iter().all(|found| found.code.action == Action::NoMotion);
    !plain || event.iter().any(|word| !matches!(word.value, Value::Nothing))
}

/// The letters of a code that are lengths: those that its table names, and what cycles that stop, turn or couple the spindle read. Q of a thread is an
/// angle, its K a lead; Q, I and J of boring say how far the tool moves away from the wall (Fanuc Series 30i operator's manual, G73, G74, G76, G84, G87).
fn length_letters(code: &Code) -> u32 {
    let named = code.lengths.iter().flatten().filter_map(|name| match name.as_bytes() {
        [letter @ b'A'..=b'Z'] => Some(letter_bit(*letter)),
        _ => None,
    });
    let of_action = match code.action {
        Action::Thread | Action::VariableThread => letter_bit(b'K'),
        Action::TapCycle | Action::TapLeftCycle => letter_bit(b'Q'),
        Action::BoreStopCycle | Action::BoreManualCycle | Action::FineBoreCycle | Action::BackBoreCycle => {
            letter_bit(b'Q') | letter_bit(b'I') | letter_bit(b'J')
        }
        _ => 0,
    };
    named.fold(of_action, |all, one| all | one)
}

/// Whether the table says of each word of an event whether it is a length.
fn says_lengths(codes: &[&&Found<'_>], event: &[Argument]) -> bool {
    let [found] = codes else { return false };
    let is_said = |argument: &Argument| match argument.value {
        Value::Nothing => true,
        Value::Number(_) => found.code.words.iter().any(|word| *word == argument.name),
        Value::Text(_) => false,
    };
    found.code.lengths.is_some() && event.iter().all(is_said)
}

impl Iso<'_> {
    /// The words of some letters in alphabetical order, those that are lengths of the code in mm.
    pub(super) fn arguments_in_mm(&self, code: &Code, words: &Words, letters: u32) -> Vec<Argument> {
        let mut found: Vec<Argument> = arguments(words, letters).collect();
        self.lengths_to_mm(code, words, &mut found);
        found
    }

    /// The words of codes that read them as data: lengths in mm, and where it is not known which are some, the unit.
    pub(super) fn in_one_unit(&self, codes: &[&&Found<'_>], words: &Words, event: &mut Vec<Argument>) {
        let unit_mm = self.core.state.coordinates.unit_mm();
        if in_lengths(codes, words) {
            for argument in event {
                to_mm(argument, unit_mm);
            }
        } else if says_lengths(codes, event) {
            self.lengths_to_mm(codes[0].code, words, event);
        } else if unit_mm != 1.0 && may_read_unit(codes, event) {
            event.push(Argument::number("mm per unit", unit_mm));
        }
    }

    /// Lengths of a code become mm.
    fn lengths_to_mm(&self, code: &Code, words: &Words, arguments: &mut [Argument]) {
        let lengths = length_letters(code);
        for argument in arguments {
            if let (&[letter @ b'A'..=b'Z'], Value::Number(value)) = (argument.name.as_bytes(), &mut argument.value)
                && lengths & letter_bit(letter) != 0
                && let Some(mm) = self.length_word(words, letter)
            {
                *value = mm;
            }
        }
    }

    /// Words in a cycle of holes that are lengths and feeds, in mm: those with a decimal point, since a parameter of the control may decide what a number
    /// without one means.
    pub(super) fn hole_words_in_mm(&self, view: &Block<'_>, arguments: &mut [Argument]) {
        let state = &self.core.state;
        let unit_mm = state.coordinates.unit_mm();
        if unit_mm == 1.0 || !state.motion.is_some_and(Action::is_hole_cycle) {
            return;
        }
        let taps = matches!(state.motion, Some(Action::TapCycle | Action::TapLeftCycle));
        for argument in arguments {
            let (&[letter], Value::Number(value)) = (argument.name.as_bytes(), &mut argument.value) else {
                continue;
            };
            let factor = match letter {
                b'X' | b'Y' | b'Z' | b'U' | b'V' | b'W' | b'R' | b'Q' => unit_mm,
                // J of a tap counts how many times faster it goes out
                b'I' | b'J' if !taps => unit_mm,
                b'F' if state.feed.mode() != FeedMode::InverseTime => state.feed.unit_mm(),
                _ => continue,
            };
            let mut same = view
                .words()
                .filter(|word| matches!(word.address, Address::Letter(of) if of.eq_ignore_ascii_case(&letter)));
            if same.all(|word| view.program().text(word.value_range).contains('.')) {
                *value *= factor;
            }
        }
    }
}
