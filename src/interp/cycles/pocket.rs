//! Circular pockets (Haas G12, G13): from the centre, around, and back to it. How the tool moves out to the wall is not described in the
//! manual in numbers, so the path is unknown; where it ends is known.
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{Feed, MotionKind, Refusal};

impl Iso<'_> {
    /// A pocket around the present point, or about X Y of the block, down to Z.
    pub(crate) fn pocket(&mut self, words: &Words, report: &mut Report<'_>) {
        if self.length_word(words, b'I').is_none_or(|radius| radius <= 0.0) {
            let message = "a circular pocket without I, the radius of the first circle".to_owned();
            self.refuse(words, Refusal::CannedCycle, message, None, report);
        }
        if self.length_word(words, b'K').is_some() && self.length_word(words, b'Q').is_none_or(|step| step <= 0.0) {
            let message = "a circular pocket with K, the last radius, needs Q, the step of the radius".to_owned();
            self.refuse(words, Refusal::CannedCycle, message, None, report);
        }
        self.feed_of(MotionKind::Linear, words, report);
        let position = self.core.state.position;
        let mut place = self.memory.frames.programmed(&position);
        let repeats = words.letter(b'L').index().unwrap_or(1).min(1000);
        for _ in 0..repeats {
            self.place(words, &mut place);
        }
        self.goes(MotionKind::Unknown, place, Feed::Unknown, report);
    }
}
