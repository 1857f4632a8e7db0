//! The words of one motion in Klartext: the path function first, coordinates with their signs, then the feed.
//!
//! Source: HEIDENHAIN TNC 640, user's manual Klartext programming (L, CC, C, CP, FMAX).
use crate::Refused;
use crate::clamps::Step;
use crate::emit_code::{WORDS, Writer};
use crate::plan::{Move, Shape};
use trunnion_geometry::{arc::Arc, deg};
use trunnion_interp::Feed;
use trunnion_syntax::BlockId;

/// Arcs with less height are flat, mm.
const FLAT: f64 = 1e-6;

impl Writer<'_> {
    /// A coordinate as the control shows it: with its sign.
    pub(crate) fn signed(&self, text: String) -> String {
        if self.klartext && !text.starts_with('-') {
            format!("+{text}")
        } else {
            text
        }
    }

    pub(crate) fn sentence(&mut self, one: &Move, block: BlockId) -> Result<(), Refused> {
        let mut words = Vec::new();
        let turns = if let Shape::Arc(arc) = one.shape {
            self.arc_sentence(one, &arc, &mut words)
        } else {
            words.push("L".to_owned());
            let turns = self.coordinates(one, None, &mut words);
            if words.len() == 1 {
                // nothing changes: a coordinate makes it a motion
                words.push(format!("X{}", self.signed(self.length(one.xyz.x))));
            }
            turns
        };
        if one.feed == Feed::Rapid {
            words.push("FMAX".to_owned());
        } else {
            self.feed(one, &mut words);
        }
        let cuts = one.shape != Shape::Rapid;
        self.clamp(Step::Motion { turns, cuts }, block)?;
        self.line(&words.join(" "));
        self.moved.push(self.lines);
        Ok(())
    }

    /// The centre in a block of its own, and the words of the arc up to its direction.
    fn arc_sentence(&mut self, one: &Move, arc: &Arc, words: &mut Vec<String>) -> u16 {
        let normal = (0..3).find(|axis| arc.normal[*axis].abs() > 0.5).unwrap_or(2);
        let [first, second] = [(normal + 1) % 3, (normal + 2) % 3];
        let coordinate = |writer: &Self, axis: usize, value: f64| {
            let text = writer.signed(writer.length(value));
            format!("{}{text}", WORDS[axis])
        };
        let centre = [first, second].map(|axis| coordinate(self, axis, arc.centre[axis]));
        self.line(&format!("CC {} {}", centre[0], centre[1]));
        let turn = arc.sweep * arc.normal[normal].signum();
        let direction = if turn < 0.0 { "DR-" } else { "DR+" };
        let height = coordinate(self, normal, one.xyz[normal]);
        // a full circle says its angle: C would depend on an end that is exactly the start
        let full = arc.sweep.abs() > core::f64::consts::TAU - 1e-9;
        let turns = if arc.height().abs() < FLAT && !full {
            words.push("C".to_owned());
            // the start is there already
            self.modal.set(WORDS[normal], height);
            self.coordinates(one, Some(normal), words)
        } else {
            let angle = self.signed(crate::number::number(deg(turn), self.post.angle, self.post.point));
            words.push(format!("CP IPA{angle}"));
            if arc.height().abs() < FLAT {
                self.modal.set(WORDS[normal], height);
            } else {
                words.extend(self.modal.change(WORDS[normal], height));
            }
            self.modal.forget(WORDS[first]);
            self.modal.forget(WORDS[second]);
            0
        };
        words.push(direction.to_owned());
        turns
    }
}

/// Letters of the longest program name that is written: so much of a title says what it is.
const NAME: usize = 24;

/// The name of a program in BEGIN PGM: one word.
pub(crate) fn program_name(text: &str) -> String {
    let letter = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    let name: String = text.chars().map(letter).take(NAME).collect();
    let name = name.trim_matches('_');
    if name.is_empty() {
        "PROGRAM".to_owned()
    } else {
        name.to_owned()
    }
}
