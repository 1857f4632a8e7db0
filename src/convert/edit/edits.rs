//! New words in the place of old ones.
use crate::refuse::Refused;
use std::collections::BTreeMap;
use trunnion_syntax::{Program, TextEdit, TextRange, Value, Word};

/// Changes of a text. A block that runs more than once must be changed alike each time.
#[derive(Default)]
pub(super) struct Edits(BTreeMap<(u32, u32), New>);

struct New {
    text: String,
    /// The text without regard to what was rounded before, where it is another one.
    plain: Option<Box<str>>,
}

impl Edits {
    /// A word gets another text. `plain`: the same, rounded on its own; it counts where the block runs again and is rounded otherwise then.
    pub(super) fn put(
        &mut self,
        program: &Program,
        range: TextRange,
        text: String,
        plain: String,
    ) -> Result<(), Refused> {
        let key = (range.start, range.end);
        match self.0.get_mut(&key) {
            None => {
                let plain = (plain != text).then(|| plain.into_boxed_str());
                self.0.insert(key, New { text, plain });
            }
            Some(known) if known.text == text => {}
            Some(known) if known.plain.as_deref().unwrap_or(&known.text) == plain => {
                known.plain = None;
                known.text = plain;
            }
            Some(_) => {
                let message = format!(
                    "`{}` runs more than once, and would have to be written in different ways",
                    program.text(range)
                );
                return Err(Refused::range(program, range, message));
            }
        }
        Ok(())
    }

    /// The same where nothing is rounded.
    pub(super) fn set(&mut self, program: &Program, range: TextRange, text: &str) -> Result<(), Refused> {
        self.put(program, range, text.to_owned(), text.to_owned())
    }

    /// All that change something, in the order of the text.
    pub(super) fn sorted(self, program: &Program) -> Vec<TextEdit> {
        let all = self.0.into_iter().map(|((start, end), new)| TextEdit {
            range: TextRange::new(start, end),
            new_text: new.text,
        });
        all.filter(|edit| program.text(edit.range) != edit.new_text).collect()
    }
}

/// The number of a word and its place; `None`: it has no plain number.
pub(super) fn number_of(program: &Program, word: &Word) -> Option<(f64, TextRange)> {
    match word.value {
        Value::Number(number) => Some((number.to_f64(), word.value_range)),
        Value::Call(_, number) => {
            let text = program.text(word.value_range);
            let open = text.find('(')? + 1;
            let close = text.rfind(')')?;
            let inside = text.get(open..close)?;
            let start = open + (inside.len() - inside.trim_start().len());
            let end = start + inside.trim().len();
            let at = word.value_range.start;
            Some((number.to_f64(), TextRange::new(at + start as u32, at + end as u32)))
        }
        _ => None,
    }
}

/// Digits that a number has after its point.
pub(super) fn decimals_of(text: &str) -> usize {
    text.split_once('.').map_or(0, |(_, fraction)| fraction.len())
}

/// `value` with so many digits after the point, rounded.
pub(super) fn rounded(value: f64, decimals: usize) -> f64 {
    format!("{value:.decimals$}").parse().unwrap_or(value)
}

/// `value` in the manner in which `old` is written: its sign, its zero before the point, and at least `keep` digits after it. `point`: a whole number has a
/// point.
pub(super) fn written(old: &str, value: f64, decimals: usize, keep: usize, point: bool) -> String {
    let mut text = format!("{value:.decimals$}");
    if let Some((whole, fraction)) = text.split_once('.') {
        let mut digits = fraction.trim_end_matches('0').len();
        digits = digits.max(keep).min(decimals);
        text = match (digits, point) {
            (0, true) => format!("{whole}."),
            (0, false) => whole.to_owned(),
            _ => format!("{whole}.{}", &fraction[..digits]),
        };
    } else if point {
        text.push('.');
    }
    if !text.bytes().any(|byte| (b'1'..=b'9').contains(&byte)) {
        text = text.trim_start_matches('-').to_owned();
    }
    let digits = old.trim_start_matches(['+', '-']);
    let sign = usize::from(text.starts_with('-'));
    if digits.starts_with('.') && text[sign..].starts_with("0.") && text.len() > sign + 2 {
        text.remove(sign);
    }
    if old.starts_with('+') && sign == 0 {
        text.insert(0, '+');
    }
    text
}

/// Coordinates of the program after, exact and as they are written: a step is the difference of two rounded positions, so that rounding does
/// not add up.
#[derive(Default)]
pub(super) struct Track {
    exact: [f64; 9],
    rounded: [f64; 9],
}

impl Track {
    /// A position is written.
    pub(super) fn absolute(&mut self, axis: usize, value: f64, decimals: usize) -> f64 {
        self.exact[axis] = value;
        self.rounded[axis] = rounded(value, decimals);
        self.rounded[axis]
    }

    /// A step is written.
    pub(super) fn step(&mut self, axis: usize, by: f64, decimals: usize) -> f64 {
        let was = self.rounded[axis];
        self.absolute(axis, self.exact[axis] + by, decimals) - was
    }
}

#[cfg(test)]
mod tests {
    use super::{Track, written};

    #[test]
    fn numbers_are_written_as_the_old_ones() {
        assert_eq!(written("1.5", 0.059_055_1, 4, 0, true), "0.0591");
        assert_eq!(written(".5", -0.25, 4, 0, true), "-.25");
        assert_eq!(written("+5", 2.0, 3, 0, false), "+2");
        assert_eq!(written("5.", 2.0, 3, 0, true), "2.");
        assert_eq!(written("10.000", 15.0, 3, 3, true), "15.000");
        assert_eq!(written("0", -0.00001, 3, 0, false), "0");
    }

    #[test]
    fn steps_do_not_pile_up_their_rounding() {
        let mut track = Track::default();
        let steps: f64 = (0..1000).map(|_| track.step(0, 1.0 / 3.0, 3)).sum();
        assert!((steps - 1000.0 / 3.0).abs() < 0.000_51, "{steps}");
    }
}
