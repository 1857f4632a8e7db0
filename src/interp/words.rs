//! The words of one ISO block in fixed places: what a block says, without meaning yet.
use trunnion_syntax::TextRange;

/// A number as it is meant, and its place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number {
    pub(crate) value: f64,
    pub(crate) has_point: bool,
    pub(crate) range: TextRange,
}

/// What a word says.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) enum WordValue {
    /// There is no such word.
    #[default]
    Nothing,
    /// A number.
    Number(Number),
    /// A quoted name.
    Name(TextRange),
    /// Something that is not evaluated.
    Unread,
}

impl WordValue {
    pub(crate) fn number(self) -> Option<Number> {
        if let Self::Number(number) = self {
            Some(number)
        } else {
            None
        }
    }
    pub(crate) fn is_given(self) -> bool {
        !matches!(self, Self::Nothing)
    }
}

/// Values of numbered places with masks that say how each was written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Places<const N: usize> {
    pub(crate) values: [f64; N],
    /// A number is there.
    pub(crate) given: u16,
    /// A word is there, its value is unknown.
    pub(crate) unread: u16,
    /// AC(): absolute whatever is modal.
    pub(crate) absolute: u16,
    /// IC(): incremental whatever is modal.
    pub(crate) incremental: u16,
    /// DC(): absolute, in the shorter direction.
    pub(crate) shortest: u16,
    /// ACP(): absolute, turning positive.
    pub(crate) positive: u16,
    /// ACN(): absolute, turning negative.
    pub(crate) negative: u16,
    /// Written with a decimal point.
    pub(crate) point: u16,
}

impl<const N: usize> Default for Places<N> {
    fn default() -> Self {
        Self {
            values: [0.0; N],
            given: 0,
            unread: 0,
            absolute: 0,
            incremental: 0,
            shortest: 0,
            positive: 0,
            negative: 0,
            point: 0,
        }
    }
}

impl<const N: usize> Places<N> {
    pub(crate) fn any(&self) -> bool {
        self.given | self.unread != 0
    }
    pub(crate) fn get(&self, place: usize) -> Option<f64> {
        (self.given & (1 << place) != 0).then(|| self.values[place])
    }
    /// Whether every number is written with a decimal point.
    pub(crate) fn all_pointed(&self) -> bool {
        self.given & !self.point == 0
    }
    fn put(&mut self, place: usize, number: Number) {
        self.values[place] = number.value;
        self.given |= 1 << place;
        self.point |= u16::from(number.has_point) << place;
    }
}

/// The words of a block by their letters. Axes are in [`Words::axes`]; [`Words::letter`] looks at both.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Letters {
    values: [f64; 26],
    ranges: [TextRange; 26],
    /// A number is there (A is bit 0).
    given: u32,
    /// A word is there, its value is unknown.
    unread: u32,
    /// Written with a decimal point.
    point: u32,
}

impl Letters {
    /// Keeps what the word of an upper-case letter says; other addresses have no place here.
    pub(crate) fn keep(&mut self, letter: u8, said: WordValue) {
        let place = usize::from(letter.wrapping_sub(b'A'));
        if place >= self.values.len() {
            return;
        }
        match said {
            WordValue::Nothing => {}
            WordValue::Number(number) => {
                self.values[place] = number.value;
                self.ranges[place] = number.range;
                self.given |= 1 << place;
                self.point |= u32::from(number.has_point) << place;
            }
            WordValue::Name(_) | WordValue::Unread => self.unread |= 1 << place,
        }
    }
    fn get(&self, place: usize) -> WordValue {
        let bit = 1u32 << place;
        if self.given & bit != 0 {
            WordValue::Number(Number {
                value: self.values[place],
                has_point: self.point & bit != 0,
                range: self.ranges[place],
            })
        } else if self.unread & bit != 0 {
            WordValue::Unread
        } else {
            WordValue::Nothing
        }
    }
}

/// The words of one block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Words {
    pub(crate) axes: Places<9>,
    pub(crate) centre: Places<3>,
    pub(crate) vector: Places<3>,
    pub(crate) radius: WordValue,
    pub(crate) turns: WordValue,
    /// PO[X]= is in the block.
    pub(crate) polynomial: bool,
    /// STAT and TU.
    pub(crate) posture: crate::travel::PostureWords,
    pub(crate) feed: WordValue,
    /// OVR= and OVRRAP=, percent.
    pub(crate) feed_share: WordValue,
    pub(crate) rapid_share: WordValue,
    pub(crate) speed: WordValue,
    pub(crate) tool: WordValue,
    pub(crate) length_offset: WordValue,
    pub(crate) edge: WordValue,
    /// P: dwell, turns of an arc, number of a work offset; FP= of a Sinumerik.
    pub(crate) p: WordValue,
    /// Words by letter: parameters of codes (L, P, Q, R, K ...) and all others that are no axes.
    pub(crate) by_letter: Letters,
    /// The first word that is a coordinate, centre, radius or vector component.
    pub(crate) first: Option<TextRange>,
    /// A word with a letter beside N, O, G, M: distinguishes `TRANS X1` from `TRANS`.
    pub(crate) has_values: bool,
    /// The block contains a program number.
    pub(crate) program_number: Option<TextRange>,
    /// The block declares names: nothing in it is a position.
    pub(crate) declares: bool,
    /// The block holds something that may move anything: a call, a jump, an unknown name.
    pub(crate) forgets_all: bool,
    /// `M1=4`: a function for a spindle by number, which may or may not be the one with the tool.
    pub(crate) other_spindle: bool,
    /// SPOS, SPOSA: the main spindle turns to a position and stands there.
    pub(crate) positions_spindle: bool,
    /// Zero points or tools of the control are written: from here on coordinates say nothing about the machine.
    pub(crate) writes_system: bool,
    /// Another feed than F acts in the block: FB, FD, FZ.
    pub(crate) other_feed: bool,
    /// `,R` or `,C` with its value as written: the corner between this motion and the next is rounded or cut off.
    pub(crate) corner: Option<(u8, Number)>,
    /// The block contains an M code that the builder may have given a meaning.
    pub(crate) builder_code: bool,
    /// The block contains a G code without meaning.
    pub(crate) unknown_code: bool,
    /// `%` without a name.
    pub(crate) percent: Option<TextRange>,
    /// The `/` inside the block after which the rest of it is deleted.
    pub(crate) rest_deleted: Option<TextRange>,
    /// Any word, name or code at all.
    pub(crate) has_content: bool,
    /// Letters seen (A is bit 0).
    pub(crate) letters: u32,
    /// `<SUB>`: the program that a call names.
    pub(crate) program_name: Option<TextRange>,
    /// The block contains a macro statement, a call or a return.
    pub(crate) flow: bool,
    /// The block jumps by an input, whose number is Q.
    pub(crate) reads_input: bool,
}

impl Words {
    /// What the word of an upper-case letter says, whatever its role: L, P, Q, K of a cycle as well as X. G, M, N and O are not
    /// kept. The range of a coordinate is not kept: it is empty.
    pub(crate) fn letter(&self, letter: u8) -> WordValue {
        let Some(place) = letter.checked_sub(b'A').filter(|place| *place < 26) else {
            return WordValue::Nothing;
        };
        let kept = self.by_letter.get(usize::from(place));
        if kept.is_given() {
            return kept;
        }
        let Some(axis) = crate::AxisLetter::new(letter).map(|axis| usize::from(axis.0)) else {
            return WordValue::Nothing;
        };
        let bit = 1u16 << axis;
        match self.axes.get(axis) {
            Some(value) => WordValue::Number(Number {
                value,
                has_point: self.axes.point & bit != 0,
                range: TextRange::default(),
            }),
            None if self.axes.unread & bit != 0 => WordValue::Unread,
            None => WordValue::Nothing,
        }
    }
}

/// How a coordinate is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reading {
    Modal,
    Absolute,
    Incremental,
    Shortest,
    Positive,
    Negative,
}

/// Puts a word into its place.
pub(crate) fn put<const N: usize>(places: &mut Places<N>, place: usize, (said, reading): (WordValue, Reading)) {
    let bit = 1u16 << place;
    match said {
        WordValue::Number(number) => {
            places.put(place, number);
            match reading {
                Reading::Modal => {}
                Reading::Absolute => places.absolute |= bit,
                Reading::Incremental => places.incremental |= bit,
                Reading::Shortest => places.shortest |= bit,
                Reading::Positive => places.positive |= bit,
                Reading::Negative => places.negative |= bit,
            }
        }
        // a variable that is vacant: the word counts as not written
        WordValue::Nothing => {}
        _ => places.unread |= bit,
    }
}

/// A coordinate that is absolute whatever is modal.
pub(crate) fn put_absolute<const N: usize>(places: &mut Places<N>, axis: usize, value: f64) {
    let number = Number {
        value,
        has_point: true,
        range: TextRange::default(),
    };
    put(places, axis, (WordValue::Number(number), Reading::Absolute));
    places.incremental &= !(1 << axis);
}
