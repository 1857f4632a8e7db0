//! Words that no code of their block, and no code in effect, reads: they were meant for something, and do nothing.
//!
//! Sources: grbl 1.1 documentation, error 36 (unused value words); Fanuc Series 30i operator's manual, G code list (which addresses each
//! code has); RS274/NGC Interpreter, version 3 (NIST), section 3.5.
use crate::arc::plane_axes;
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Refusal};
use trunnion_dialect::{Action, Code, CodeKind, Owner, Role};
use trunnion_syntax::Address;

/// The place of an upper-case letter in a mask of letters.
pub(crate) const fn letter_bit(letter: u8) -> u32 {
    1 << (letter - b'A')
}

/// Letters that mean something only where a code reads them.
pub(crate) const PARAMETERS: u32 = letter_bit(b'D')
    | letter_bit(b'E')
    | letter_bit(b'H')
    | letter_bit(b'I')
    | letter_bit(b'J')
    | letter_bit(b'K')
    | letter_bit(b'L')
    | letter_bit(b'P')
    | letter_bit(b'Q')
    | letter_bit(b'R');
/// I, J, K.
const CENTRE: u32 = letter_bit(b'I') | letter_bit(b'J') | letter_bit(b'K');
const ALL: u32 = u32::MAX;

/// The letters that a code reads beside the axes.
pub(crate) fn letters(code: &Code) -> u32 {
    let letter = |word: &String| match word.as_bytes() {
        [letter @ b'A'..=b'Z'] => letter_bit(*letter),
        _ => 0,
    };
    code.words.iter().map(letter).fold(0, |all, one| all | one)
}

impl Iso<'_> {
    /// Letters that are judged: where programs declare letters as names of variables, only those of a centre, written without `=`.
    pub(crate) fn judged_letters(&self) -> u32 {
        if self.core.dialect.quirks.declares_names() {
            CENTRE
        } else {
            PARAMETERS
        }
    }

    /// Tells the words of the block that nothing reads.
    pub(crate) fn unused_words(&self, codes: &[Found<'_>], words: &Words, block: &BlockCodes, report: &mut Report<'_>) {
        let mut left = words.letters & self.judged_letters() & !self.read_in_force(words, block);
        if self.circle_goes_on(codes, words, block) {
            left &= !self.read_by_arc(words);
        }
        for found in codes {
            if left == 0 {
                return;
            }
            left &= !self.read_by(found.code);
        }
        if left == 0 || words.unknown_code || words.builder_code || words.forgets_all {
            return;
        }
        for word in report.program.block(report.block).words() {
            let Address::Letter(letter @ b'A'..=b'Z') = word.address else {
                continue;
            };
            // a vacant variable: the word counts as not written
            if left & letter_bit(letter) == 0 || !words.letter(letter).is_given() {
                continue;
            }
            let kind = match self.core.dialect.alarm("unused-word") {
                Some(alarm) => FaultKind::Rejected {
                    refusal: Refusal::UnusedWord,
                    message: format!(
                        "`{}` is not used by any code of the block",
                        report.program.text(word.range).trim()
                    ),
                    alarm: Some(alarm.number.clone()),
                },
                None => FaultKind::UnusedWord,
            };
            report.fault(word.range, kind);
        }
    }

    /// Letters that a code of the block reads. What is not modelled, and what a builder may have given a meaning, may read any.
    pub(crate) fn read_by(&self, code: &Code) -> u32 {
        let opaque = matches!(
            code.action,
            Action::NotModelled
                | Action::NotFollowed
                | Action::Skip
                | Action::SubprogramCall
                | Action::FrameChange
                | Action::FrameLost
                | Action::CannedCycle
                | Action::Declaration
                | Action::Kinematics
                | Action::HoleCall
                | Action::SwivelCycle
        );
        let of_builder = || {
            let number: Option<f64> = code.id.get(1..).and_then(|number| number.parse().ok());
            code.kind == CodeKind::M
                && number.is_some_and(|number| {
                    self.core
                        .dialect
                        .builder_may_own(CodeKind::M, (number * 10.0).round() as u32)
                })
        };
        // an auxiliary function is the machine's: where the control does not refuse its words they may be for it, and move no axis
        let auxiliary = code.kind == CodeKind::M
            && code.action == Action::NoMotion
            && self.core.dialect.alarm("unused-word").is_none();
        if opaque || auxiliary || code.owner == Owner::MachineBuilder || of_builder() {
            return ALL;
        }
        // which letters an arc reads depends on its plane
        if matches!(code.action, Action::ArcClockwise | Action::ArcCounterClockwise) {
            return 0;
        }
        letters(code)
    }

    /// Letters that what is in effect reads: arcs, cycles, tool vectors, offsets that are modal.
    pub(crate) fn read_in_force(&self, words: &Words, block: &BlockCodes) -> u32 {
        let mut read = 0;
        let role = |letter| self.core.dialect.role(letter);
        if self.core.dialect.quirks.offset_compensation || self.core.state.compensation != 0 {
            read |= letter_bit(b'D');
        }
        if role(b'D') == Some(Role::EdgeOffset) {
            read |= letter_bit(b'D');
        }
        if matches!(role(b'H'), Some(Role::LengthOffset | Role::Increment)) {
            read |= letter_bit(b'H');
        }
        if words.flow {
            read |= letter_bit(b'P') | letter_bit(b'L');
        }
        if words.reads_input {
            read |= letter_bit(b'Q');
        }
        if self.core.state.tool_axis.vectors() {
            read |= CENTRE;
        }
        let moves = !block.takes_coordinates && !block.dwell && (words.axes.any() || block.motion.is_some());
        read | match self.core.state.motion {
            Some(Action::ArcClockwise | Action::ArcCounterClockwise) if moves => self.read_by_arc(words),
            Some(Action::CannedCycle | Action::NotModelled) => ALL,
            // data of a cycle may be written alone
            Some(motion) if motion.is_hole_cycle() || motion.is_pass_cycle() => self.memory.cycle.letters,
            Some(Action::Thread | Action::VariableThread) if moves => self.memory.cycle.letters,
            Some(Action::Linear) if moves && self.turned_corner(words).is_some() => {
                letter_bit(b'R') | letter_bit(b'I') | letter_bit(b'K')
            }
            _ => 0,
        }
    }

    /// A further full circle: I, J, K alone while G2 or G3 is in effect, and nothing else in the block reads them (Fanuc Series 30i operator's
    /// manual, circular interpolation: without an end point, I, J, K give an arc of 360 deg). grbl refuses such words.
    pub(crate) fn circle_goes_on(&self, codes: &[Found<'_>], words: &Words, block: &BlockCodes) -> bool {
        let is_arc = || {
            matches!(
                self.core.state.motion,
                Some(Action::ArcClockwise | Action::ArcCounterClockwise)
            )
        };
        words.centre.any()
            && is_arc()
            && !block.takes_coordinates
            && !block.dwell
            && !words.axes.any()
            && self.core.dialect.alarm("unused-word").is_none()
            && self.read_by_arc(words) & words.letters & CENTRE != 0
            && codes.iter().all(|found| self.read_by(found.code) & CENTRE == 0)
    }

    /// An arc reads the centre's two letters of its plane, or R; a spiral all three.
    fn read_by_arc(&self, words: &Words) -> u32 {
        let code = self.core.dialect.g(20).map_or(0, letters);
        if self.is_spiral(words) {
            return code;
        }
        let [first, second, _] = plane_axes(self.core.state.coordinates.plane());
        let centre = letter_bit(b'I' + first as u8) | letter_bit(b'I' + second as u8);
        (code & !CENTRE) | centre
    }

    /// Q or L beside an arc, where the arc codes read them: a spiral or cone.
    pub(crate) fn is_spiral(&self, words: &Words) -> bool {
        let code = || self.core.dialect.g(20).map_or(0, letters);
        words.letters & code() & (letter_bit(b'Q') | letter_bit(b'L')) != 0
    }
}
