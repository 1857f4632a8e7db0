//! What a program requests of the choice between postures in addition to the tool vector, and its meaning by the machine file.
//!
//! * SEQ+ and SEQ- of a Heidenhain: the sign of the primary rotary axis, which is the first seen from the tool, or seen from the table the
//!   last (TNC7 user's manual, tilting solution). If no posture with it is within the travel, the control stops with an error.
//! * G53.1 P1 and P2: the machine file declares which solution the number means.
//! * STAT and TU of a Sinumerik in point-to-point motions: bits of TU are the signs of the rotary axes, 0 for 0 <= value < 360 deg, 1 for
//!   -360 < value < 0 deg, counted by the channel's axis numbers; an axis whose travel is more than 360 deg either way takes the shortest
//!   path regardless of them (840D sl Function Manual, Extended Functions, 03/2013, section 6.6.2; Programming Manual, Job Planning, 03/2013,
//!   section 6.9). What the bits of STAT mean depends on the transformation: the machine file declares it.
use crate::file::raw::{Number, RawPostureWords, Word};
use crate::file::validate::Fault;
use crate::follow::posture_rule::TIE;
use crate::{Axis, AxisKind, Follower, Joints, Limits, Machine, Open, OpenCause, PostureRule};
use core::f64::consts::TAU;
use trunnion_interp::{AXIS_LETTERS, Motion, Orientation, Posture};

/// The sign of a rotary axis that a posture must have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisSign {
    /// Letter.
    pub letter: u8,
    /// Below zero, else above it; zero itself fits both.
    pub negative: bool,
}

/// What words that choose a posture mean on a machine.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PostureWords {
    /// Bit numbers of TU: letter of the rotary axis, bit.
    pub turn: Vec<(u8, u8)>,
    /// The bit of STAT that selects the posture, and the sign that it means when it is set (the other one when it is not).
    pub status: Option<(u8, AxisSign)>,
    /// Solutions by number (G53.1 P1).
    pub solutions: Vec<(u8, AxisSign)>,
}

/// The constraints of a choice.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Requested {
    /// For each rotary axis, workpiece side first, whether TU asks for a value below zero.
    turns: [Option<bool>; 2],
    /// Index of the rotary axis and whether its value has to be below zero.
    signs: [Option<(usize, bool)>; 2],
    /// The program selects a posture by a word whose meaning is not declared.
    pub(crate) unsaid: bool,
}

/// Index of the rotary axis with a letter, workpiece side first.
fn index(machine: &Machine, letter: u8) -> Option<usize> {
    let rotary = machine.constants.rotary();
    rotary
        .iter()
        .position(|rotary| machine.axes[rotary.joint].letter == letter)
}

impl Requested {
    pub(crate) fn of(machine: &Machine, wish: Posture) -> Self {
        let (mut asked, words) = (Self::default(), &machine.control.posture_words);
        let sign = |sign: AxisSign, reversed: bool| Some((index(machine, sign.letter)?, sign.negative != reversed));
        match wish {
            Posture::Lower | Posture::Higher => {}
            Posture::ByRule => {
                let branch = &machine.control.branch;
                if let (Some(PostureRule::Heidenhain), Some(negative)) = (branch.rule, branch.solution_negative) {
                    // nearest the tool in a head, last from the workpiece on a table
                    asked.signs[0] = Some((machine.constants.rotary_count.saturating_sub(1), negative));
                }
            }
            Posture::Numbered(number) => match words.solutions.iter().find(|(known, _)| *known == number) {
                Some(&(_, said)) => asked.signs[0] = sign(said, false),
                None => asked.unsaid = true,
            },
            Posture::Bits { status, turn } => {
                if let Some(mask) = turn {
                    asked.turns(machine, mask);
                }
                match (status, words.status) {
                    (Some(mask), Some((bit, said))) => asked.signs[0] = sign(said, mask & (1 << bit) == 0),
                    (Some(_), None) => asked.unsaid = true,
                    (None, _) => {}
                }
            }
        }
        asked
    }

    fn turns(&mut self, machine: &Machine, mask: u16) {
        let words = &machine.control.posture_words;
        for (slot, rotary) in self.turns.iter_mut().zip(machine.constants.rotary()) {
            let axis = &machine.axes[rotary.joint];
            match words.turn.iter().find(|(letter, _)| *letter == axis.letter) {
                Some(&(_, bit)) if within_a_turn(axis) => *slot = Some(mask & (1 << bit) != 0),
                Some(_) => {}
                None => self.unsaid = true,
            }
        }
    }

    /// The limits of a rotary axis narrowed to what TU requests.
    pub(crate) fn narrow(&self, index: usize, limits: Limits) -> Limits {
        let Some(negative) = self.turns[index] else {
            return limits;
        };
        let (low, high) = if negative { (-TAU + TIE, -TIE) } else { (0.0, TAU - TIE) };
        match limits {
            Limits::Unbounded => Limits::Range(low, high),
            Limits::Range(least, most) => Limits::Range(low.max(least), high.min(most)),
        }
    }

    /// Whether TU requests anything.
    pub(crate) fn narrows(&self) -> bool {
        self.turns != [None; 2]
    }

    /// Whether rotary values have the requested signs; modulo a turn, half a turn being neither.
    pub(crate) fn fits(&self, q: &[f64; 2]) -> bool {
        self.signs.iter().flatten().all(|&(index, negative)| {
            let value = q[index] - TAU * (q[index] / TAU).round();
            if negative { value <= TIE } else { value >= -TIE }
        })
    }
}

impl Follower<'_> {
    /// The turns that TU gives to rotary words of a point-to-point motion: C270 goes to 270 deg or to -90 deg. If the bits are not
    /// declared the word is taken as it is, and another turn of it is possible.
    #[inline]
    pub(crate) fn asked_turns(&self, motion: &Motion, into: &mut (Joints, u16), open: &mut Option<Open>) {
        if let (Posture::Bits { turn: Some(mask), .. }, Orientation::Words) = (motion.tilt.posture, motion.orientation)
        {
            self.turn_words(motion, mask, into, open);
        }
    }

    fn turn_words(&self, motion: &Motion, mask: u16, into: &mut (Joints, u16), open: &mut Option<Open>) {
        let machine = self.machine;
        let before = self.state.rotary;
        for (index, rotary) in machine.constants.rotary().iter().enumerate().take(2) {
            let axis = &machine.axes[rotary.joint];
            let programmed = AXIS_LETTERS
                .iter()
                .position(|letter| *letter == axis.letter)
                .is_some_and(|letter| motion.start.get(letter) != motion.end.get(letter));
            if !programmed || into.1 & (1 << rotary.joint) == 0 {
                continue;
            }
            let value = into.0[rotary.joint];
            let positive = value.rem_euclid(TAU);
            let negative = if positive > TIE { positive - TAU } else { positive };
            let bit = machine
                .control
                .posture_words
                .turn
                .iter()
                .find(|(letter, _)| *letter == axis.letter);
            into.0[rotary.joint] = match bit {
                Some(_) if !within_a_turn(axis) => {
                    let nearest = value + TAU * ((before[index] - value) / TAU).round();
                    if self.state.rotary_lost & (1 << rotary.joint) != 0 {
                        *open = open.or(Some(turn_lost(index, before, (nearest, axis))));
                    }
                    nearest
                }
                Some((_, bit)) if mask & (1 << bit) != 0 => negative,
                Some(_) => positive,
                None => {
                    let (mut taken, mut other) = (before, before);
                    taken[index] = value;
                    other[index] = if (value - positive).abs() < TIE {
                        negative
                    } else {
                        positive
                    };
                    *open = open.or(Some(Open {
                        cause: OpenCause::WordsNotDeclared,
                        taken,
                        other,
                    }));
                    value
                }
            };
        }
    }
}

/// The turn of an axis of several turns is the nearest to where it stands, and that is lost: a turn beside it is as possible.
fn turn_lost(index: usize, before: [f64; 2], (nearest, axis): (f64, &Axis)) -> Open {
    let beside = match axis.limits {
        Limits::Range(_, high) if nearest + TAU > high => nearest - TAU,
        Limits::Range(..) | Limits::Unbounded => nearest + TAU,
    };
    let at = |value: f64| {
        let mut both = before;
        both[index] = value;
        both
    };
    Open {
        cause: OpenCause::StartUnknown,
        taken: at(nearest),
        other: at(beside),
    }
}

/// Whether an axis cannot leave -360 to 360 deg.
fn within_a_turn(axis: &Axis) -> bool {
    matches!(axis.limits, Limits::Range(low, high) if low >= -TAU - TIE && high <= TAU + TIE)
}

/// Reads the part `posture_words` of a machine file.
pub(crate) fn posture_words(raw: &RawPostureWords, axes: &[Axis]) -> Result<PostureWords, Fault> {
    let rotary = |word: &Word| {
        let axis = axes.iter().find(|axis| word.get_ref().as_bytes() == [axis.letter]);
        match axis {
            Some(axis) if axis.kind == AxisKind::Rotary => Ok(axis.letter),
            _ => Err(fault(
                word,
                format!("{:?} is not a rotary axis of this machine", word.get_ref()),
            )),
        }
    };
    let mut words = PostureWords::default();
    for (letter, number) in &raw.turn {
        words.turn.push((rotary(letter)?, bit(number)?));
    }
    if let Some(status) = &raw.status {
        let negative = sign(&status.set)?;
        let letter = rotary(&status.axis)?;
        words.status = Some((bit(&status.bit)?, AxisSign { letter, negative }));
    }
    for (number, said) in &raw.solutions {
        let Ok(value) = number.get_ref().parse::<u8>() else {
            return Err(fault(
                number,
                "name a solution by its number, for example \"1\"".to_owned(),
            ));
        };
        let text = said.get_ref();
        let known = text.split_at_checked(1).and_then(|(letter, sign)| {
            let axis = axes.iter().find(|axis| letter.as_bytes() == [axis.letter])?;
            let negative = match sign {
                "+" => false,
                "-" => true,
                _ => return None,
            };
            (axis.kind == AxisKind::Rotary).then_some(AxisSign {
                letter: axis.letter,
                negative,
            })
        });
        let Some(sign) = known else {
            return Err(fault(
                said,
                format!("{text:?} is not the sign of a rotary axis: write its letter and + or -, for example \"A+\""),
            ));
        };
        words.solutions.push((value, sign));
    }
    Ok(words)
}

fn fault(word: &Word, message: String) -> Fault {
    Fault {
        message,
        span: word.span(),
    }
}

fn sign(word: &Word) -> Result<bool, Fault> {
    match word.get_ref().as_str() {
        "negative" => Ok(true),
        "positive" => Ok(false),
        other => Err(fault(
            word,
            format!("unknown sign {other:?}; known: negative, positive"),
        )),
    }
}

fn bit(number: &Number) -> Result<u8, Fault> {
    let value = *number.get_ref();
    if value.fract() == 0.0 && (0.0..16.0).contains(&value) {
        return Ok(value as u8);
    }
    Err(Fault {
        message: format!("{value} is not a bit number: write 0 to 15"),
        span: number.span(),
    })
}
