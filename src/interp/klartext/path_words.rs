//! The words of a path block.
use super::words::{Kind, Parameter, Said, Word, Words};
use super::{Klartext, values::Value};
use crate::core::Report;
use crate::{AxisLetter, FaultKind, Refusal};
use trunnion_syntax::TextRange;

/// F of a block.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum FeedSaid {
    #[default]
    Nothing,
    /// FMAX.
    Rapid,
    /// FAUTO: that of TOOL CALL.
    Auto,
    Value(Value),
    /// FU, mm per turn.
    PerTurn(Value),
    /// FZ: the number of teeth is in the tool table.
    PerTooth,
}

/// M codes of a block, at most.
const MOST_CODES: usize = 8;

/// See the module. Lengths in the program's unit.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PathWords {
    /// Bits of [`crate::AXIS_LETTERS`].
    pub(crate) given: u16,
    pub(crate) incremental: u16,
    pub(crate) values: [Value; 9],
    /// Axes that M94 names.
    pub(crate) reduced: u16,
    /// Rotary words that are `+Q120`, `+Q121`, `+Q122` of their letter.
    pub(crate) plane_angles: u16,
    pub(crate) feed: FeedSaid,
    /// F behind M103, M128 and M140.
    pub(crate) own_feed: FeedSaid,
    codes: [u32; MOST_CODES],
    code_count: usize,
    /// R0, RL, RR: 0, 41, 42.
    pub(crate) compensation: Option<u8>,
    /// R with a number.
    pub(crate) radius: Option<Value>,
    /// DR-: clockwise.
    pub(crate) clockwise: Option<bool>,
    pub(crate) polar_radius: Option<Value>,
    /// Value, and whether it is incremental.
    pub(crate) polar_angle: Option<(Value, bool)>,
    pub(crate) polar_radius_adds: bool,
    /// NX NY NZ, TX TY TZ.
    pub(crate) normal: [Option<Value>; 3],
    pub(crate) tool: [Option<Value>; 3],
    pub(crate) length: Option<Value>,
    pub(crate) centre_angle: Option<Value>,
    /// The distance of MB; none for MAX.
    pub(crate) back: Value,
    pub(crate) delta: bool,
    /// `nan` stands in the block.
    pub(crate) no_number: bool,
}

impl PathWords {
    pub(crate) fn codes(&self) -> &[u32] {
        &self.codes[..self.code_count]
    }
    /// F, FMAX and the like say the feed once: of two of them no source says which one counts.
    fn take_feed(&mut self, feed: FeedSaid, report: &mut Report<'_>) {
        if feed != FeedSaid::Nothing && self.feed != FeedSaid::Nothing {
            report.fault(TextRange::default(), FaultKind::RepeatedWord);
            self.feed = FeedSaid::Value(None);
        } else if feed != FeedSaid::Nothing {
            self.feed = feed;
        }
    }
    pub(crate) fn has(&self, code: u32) -> bool {
        self.codes().contains(&code)
    }
    pub(crate) fn moves(&self) -> bool {
        self.given != 0
    }
    /// How many axes have a coordinate.
    pub(crate) fn axes_given(&self) -> u32 {
        self.given.count_ones()
    }
}

impl Klartext<'_> {
    /// The value of a word; a parameter without one is reported.
    #[inline]
    pub(crate) fn said(&mut self, said: Said<'_>, report: &mut Report<'_>) -> Value {
        // the usual one stays in registers
        if let Said::Number(value) = said {
            return Some(value);
        }
        self.said_otherwise(said, report)
    }

    fn said_otherwise(&mut self, said: Said<'_>, report: &mut Report<'_>) -> Value {
        match said {
            Said::Number(value) => Some(value),
            Said::Parameter(_, parameter) => {
                let value = self.memory.parameters.of(said);
                if value.is_none() {
                    self.parameter_unknown(parameter, report);
                }
                value
            }
            Said::Bad => {
                Self::rejected(Refusal::Number, "a number with two points or commas", report);
                None
            }
            Said::Nothing | Said::Sign(_) | Said::Text(_) => {
                Self::rejected(Refusal::MissingWord, "a word has no value", report);
                None
            }
        }
    }

    pub(crate) fn parameter_unknown(&mut self, parameter: Parameter, report: &mut Report<'_>) {
        let what = self.memory.parameters.cause(parameter);
        self.not_modelled_once(&what, report);
    }

    /// Reads the words that follow the path function.
    #[inline]
    pub(crate) fn path_words(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) -> PathWords {
        let mut found = PathWords::default();
        // F behind M103, M128 and M140 is theirs
        let mut own_feed = false;
        let mut word = Word::NONE;
        while words.read(&mut word) {
            own_feed = self.path_word(&word, words, &mut found, own_feed, report);
        }
        found
    }

    /// F with a number, MAX or AUTO; FMAX, FAUTO, FU, FZ.
    fn feed_word(&mut self, word: &Word<'_>, words: &mut Words<'_>, report: &mut Report<'_>) -> FeedSaid {
        match word.name() {
            b"FMAX" => return FeedSaid::Rapid,
            b"FAUTO" => return FeedSaid::Auto,
            b"FU" => return FeedSaid::PerTurn(self.said(word.value, report)),
            b"FZ" => return FeedSaid::PerTooth,
            _ => {}
        }
        match word.value {
            Said::Nothing if words.takes_word("MAX") => FeedSaid::Rapid,
            Said::Nothing if words.takes_word("AUTO") => FeedSaid::Auto,
            Said::Nothing => FeedSaid::Nothing,
            said => FeedSaid::Value(self.said(said, report)),
        }
    }

    fn path_word(
        &mut self,
        word: &Word<'_>,
        words: &mut Words<'_>,
        found: &mut PathWords,
        own_feed: bool,
        report: &mut Report<'_>,
    ) -> bool {
        match word.name() {
            [letter] | [b'I', letter]
                if word.value == Said::Nothing
                    && AxisLetter::new(*letter).is_some()
                    && (words.takes_word("NAN") || words.takes_word("INF")) =>
            {
                self.no_number(found, report);
            }
            // M94 C: its axis (HEIDENHAIN TNC 426 user's manual, p. 5-43)
            [letter @ b'A'..=b'C'] if word.value == Said::Nothing && found.has(94) => {
                found.reduced |= 1 << (3 + (letter - b'A'));
            }
            // the axes that M138 names, and the angle of M112
            [letter] if names_axis(*letter, word, found) => {}
            [letter] if AxisLetter::new(*letter).is_some() => self.axis(word, *letter, false, found, report),
            [b'I', letter] if AxisLetter::new(*letter).is_some() => self.axis(word, *letter, true, found, report),
            b"F" | b"FMAX" | b"FAUTO" | b"FU" | b"FZ" => {
                let feed = self.feed_word(word, words, report);
                if own_feed && matches!(word.name(), b"F" | b"FMAX") {
                    found.own_feed = feed;
                } else {
                    found.take_feed(feed, report);
                }
            }
            b"RL" => found.compensation = Some(41),
            b"RR" => found.compensation = Some(42),
            b"R" => match word.value {
                Said::Number(0.0) => (found.compensation, found.radius) = (Some(0), Some(Some(0.0))),
                // the compensation stays; R+ and R- belong to blocks along one axis
                Said::Nothing => {}
                Said::Sign(_) => self.not_modelled_once("R+ or R-: radius compensation along one axis", report),
                said => found.radius = Some(self.said(said, report)),
            },
            b"DR" => match word.value {
                Said::Sign(minus) => found.clockwise = Some(minus),
                _ => found.delta = true,
            },
            b"DL" | b"DR2" => found.delta = true,
            b"M" => return self.m_word(word, found, report),
            b"PR" => found.polar_radius = Some(self.said(word.value, report)),
            b"IPR" => (found.polar_radius, found.polar_radius_adds) = (Some(self.said(word.value, report)), true),
            b"PA" => found.polar_angle = Some((self.said(word.value, report), false)),
            b"IPA" => found.polar_angle = Some((self.said(word.value, report), true)),
            [b'N', letter @ b'X'..=b'Z'] => {
                found.normal[usize::from(letter - b'X')] = Some(self.said(word.value, report));
            }
            [b'T', letter @ b'X'..=b'Z'] => {
                found.tool[usize::from(letter - b'X')] = Some(self.said(word.value, report));
            }
            b"LEN" => found.length = Some(self.said(word.value, report)),
            b"CCA" => found.centre_angle = Some(self.said(word.value, report)),
            b"MB" => {
                let most = word.value == Said::Nothing && words.takes_word("MAX");
                found.back = if most { None } else { self.said(word.value, report) };
                return true;
            }
            // distances of M120 LA, M118 X Y Z, M112 T, M124 T
            b"LA" => {}
            b"T" if found.has(112) || found.has(124) => {}
            // what a computation that failed has written
            name if is_no_number(name) => self.no_number(found, report),
            b"" if matches!(word.value, Said::Parameter(..)) && found.codes().is_empty() && found.given == 0 => {
                Self::rejected(Refusal::Syntax, "a Q parameter without a word in front of it", report);
            }
            _ => {
                let start = report.whole().start;
                let plain = report.whole().end - start == words.text.len() as u32;
                let range = if plain {
                    TextRange::new(start + word.start as u32, start + word.end as u32)
                } else {
                    TextRange::default()
                };
                report.fault(range, FaultKind::UnknownWord);
                if word.name().starts_with(b"F") {
                    // a feed that is misspelt is not missing as well
                    found.feed = FeedSaid::Value(None);
                }
            }
        }
        false
    }

    /// `Xnan`: the word says nothing, and what it was meant to move is unknown.
    fn no_number(&mut self, found: &mut PathWords, report: &mut Report<'_>) {
        self.memory.unfollowed = true;
        self.core.forget_position();
        found.no_number = true;
        if self.memory.said.first("nan") {
            let message =
                "`nan` or `inf` is not a number: the program was written from values that could not be computed";
            Self::rejected(Refusal::Number, message, report);
        }
    }

    fn axis(&mut self, word: &Word<'_>, letter: u8, incremental: bool, found: &mut PathWords, report: &mut Report<'_>) {
        let Some(AxisLetter(axis)) = AxisLetter::new(letter) else {
            return;
        };
        let bit = 1 << axis;
        if let (
            Said::Parameter(
                false,
                Parameter {
                    kind: Kind::Global,
                    number: number @ 120..=122,
                },
            ),
            3..=5,
        ) = (word.value, axis)
            && number == 117 + u32::from(axis)
            && self.memory.angles_wait.is_some()
        {
            found.plane_angles |= bit;
            found.given |= bit;
            return;
        }
        // handwheel distances, beside the positions of the block
        if found.has(118) {
            return;
        }
        if found.given & bit != 0 {
            report.fault(TextRange::default(), FaultKind::RepeatedWord);
        }
        found.values[usize::from(axis)] = self.said(word.value, report);
        found.given |= bit;
        if incremental {
            found.incremental |= bit;
        }
    }

    /// Whether an F that follows is the code's own.
    fn m_word(&mut self, word: &Word<'_>, found: &mut PathWords, report: &mut Report<'_>) -> bool {
        // `M` alone is how posts write that there is none
        if word.value == Said::Nothing {
            return false;
        }
        let Some(code) = self
            .said(word.value, report)
            .filter(|code| code.fract() == 0.0 && (0.0..1000.0).contains(code))
        else {
            return false;
        };
        let code = code as u32;
        if let Some(place) = found.codes.get_mut(found.code_count) {
            *place = code;
            found.code_count += 1;
        }
        if found.code_count > 4 {
            Self::rejected(Refusal::Syntax, "a block has at most four M codes", report);
        }
        matches!(code, 103 | 128 | 140)
    }
}

/// `M138 A C` names axes; `M112 T0.01 A10` gives a distance and an angle (TNC 426 user's manual, miscellaneous functions).
fn names_axis(letter: u8, word: &Word<'_>, found: &PathWords) -> bool {
    let named = found.has(138) && word.value == Said::Nothing;
    named && AxisLetter::new(letter).is_some() || letter == b'A' && found.has(112)
}

/// A word whose value is `nan` or `inf`, with or without its letters.
pub(crate) fn is_no_number(name: &[u8]) -> bool {
    name.len() <= 6 && [&b"NAN"[..], b"INF"].iter().any(|ending| name.ends_with(ending))
}
