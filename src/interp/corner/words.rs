//! The words of a corner.
use crate::FaultKind;
use crate::codes::BlockCodes;
use crate::iso::Iso;
use crate::reader::Reader;
use crate::values::number;
use crate::words::{Number, WordValue, Words};
use trunnion_dialect::Action;
use trunnion_syntax::{TextRange, Value, Word};

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// `,R5.` and `,C2.`, where the control has them.
    pub(crate) fn corner(&mut self, name: &[u8], word: &Word) -> bool {
        let letter = match name {
            [b',', letter @ (b'R' | b'C' | b'r' | b'c')] => letter.to_ascii_uppercase(),
            _ => return false,
        };
        let (true, Value::Number(decimal)) = (self.dialect.quirks.corner_words, word.value) else {
            return false;
        };
        let WordValue::Number(number) = number(decimal, word.range) else {
            return false;
        };
        self.words.has_values = true;
        self.words.corner = Some((letter, number));
        true
    }
}

impl Iso<'_> {
    /// R, I or K with a straight cut of a lathe along one axis: a rounded or chamfered corner (Fanuc Series 30i operator's manual, lathe
    /// system, chamfering and corner R; with parameter 3405.4 CCR, C instead of I and K). The sign gives the direction of the next block, which
    /// is known from that block.
    pub(crate) fn turned_corner(&self, words: &Words) -> Option<(u8, Number)> {
        let quirks = &self.core.dialect.quirks;
        if !(quirks.diameter && quirks.corner_words) || self.core.state.motion != Some(Action::Linear) {
            return None;
        }
        let sized = |kind: u8, value: f64| {
            let number = Number {
                value: value.abs(),
                has_point: true,
                range: TextRange::default(),
            };
            (kind, number)
        };
        let of_radius = words.radius.number().map_or(f64::NAN, |number| number.value);
        let round = words.radius.is_given().then(|| sized(b'R', of_radius));
        let cut = || words.centre.get(0).or(words.centre.get(2));
        let unread = (words.centre.unread & 0b101 != 0).then_some(f64::NAN);
        round.or_else(|| cut().or(unread).map(|value| sized(b'C', value)))
    }

    /// CHF, CHR, RND of the block, or RNDM.
    pub(crate) fn corner_word(&mut self, words: &Words, block: &BlockCodes) {
        self.memory.corners.word = words
            .corner
            .or_else(|| self.turned_corner(words).filter(|_| words.axes.any()))
            .filter(|_| !block.takes_coordinates)
            .map(|(letter, number)| (letter, number.value * self.core.state.coordinates.unit_mm()));
        let rounding = self.memory.own.contour.rounding;
        self.memory.corners.feed = self.memory.own.contour.corner_feed;
        if rounding == 0.0 && !self.memory.own.path.any() || block.takes_coordinates {
            return;
        }
        let unit = self.core.state.coordinates.unit_mm();
        let own = self.memory.own.path.corner();
        let modal = (rounding != 0.0 && words.axes.any()).then_some((b'R', rounding));
        let word = own.map(|(letter, size)| (letter, size * unit)).or(modal);
        self.memory.corners.word = word.filter(|(_, size)| *size != 0.0 && !words.forgets_all);
        if let Some(feed) = self.memory.own.path.corner_feed() {
            self.memory.corners.feed = Some(feed);
        }
    }
}
