//! The words of one ISO block in fixed places: what a block says, without meaning yet.
use trunnion_syntax::TextRange;

/// A number as it is meant, and where it stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number {
    pub(crate) value: f64,
    pub(crate) has_point: bool,
    pub(crate) range: TextRange,
}

/// What a word says.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) enum Said {
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

impl Said {
    pub(crate) fn number(self) -> Option<Number> {
        if let Self::Number(number) = self {
            Some(number)
        } else {
            None
        }
    }
    pub(crate) fn is_said(self) -> bool {
        !matches!(self, Self::Nothing)
    }
}

/// Values of numbered places with masks that say how each was written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Places<const N: usize> {
    pub(crate) values: [f64; N],
    /// A number is there.
    pub(crate) given: u16,
    /// A word is there, its value is not known.
    pub(crate) unread: u16,
    /// AC(): absolute whatever is modal.
    pub(crate) absolute: u16,
    /// IC(): incremental whatever is modal.
    pub(crate) incremental: u16,
    /// DC(): absolute, by the shorter way.
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

/// The words of one block.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Words {
    pub(crate) axes: Places<9>,
    pub(crate) centre: Places<3>,
    pub(crate) vector: Places<3>,
    pub(crate) radius: Said,
    pub(crate) turns: Said,
    pub(crate) feed: Said,
    pub(crate) speed: Said,
    pub(crate) tool: Said,
    pub(crate) length_offset: Said,
    pub(crate) edge: Said,
    /// P, the only parameter that a modelled code reads (dwell, turns of an arc).
    pub(crate) p: Said,
    /// The first word that is a coordinate, centre, radius or vector component.
    pub(crate) first: Option<TextRange>,
    /// A word with a letter beside N, O, G, M: distinguishes `TRANS X1` from `TRANS`.
    pub(crate) has_values: bool,
    /// A program number stands in the block.
    pub(crate) program_number: Option<TextRange>,
    /// The block declares names: nothing in it is a position.
    pub(crate) declares: bool,
    /// The block holds something that may move anything: a call, a jump, an unknown name.
    pub(crate) forgets_all: bool,
    /// `M1=4`: a function for a spindle by number, which may or may not be the one with the tool.
    pub(crate) other_spindle: bool,
    /// Zero points or tools of the control are written: from here on coordinates say nothing about the machine.
    pub(crate) writes_system: bool,
    /// A G code without meaning stands in the block.
    pub(crate) unknown_code: bool,
    /// `%` without a name.
    pub(crate) percent: Option<TextRange>,
    /// Any word, name or code at all.
    pub(crate) has_content: bool,
    /// Letters seen (A is bit 0).
    pub(crate) letters: u32,
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
pub(crate) fn put<const N: usize>(places: &mut Places<N>, place: usize, (said, reading): (Said, Reading)) {
    let bit = 1u16 << place;
    match said {
        Said::Number(number) => {
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
        _ => places.unread |= bit,
    }
}
