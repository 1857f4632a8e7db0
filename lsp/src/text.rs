//! The text of a document in pieces, so that an edit copies one of them and not the file; also where the file is one line.
use crate::position::{Encoding, Lines, offset};
use core::ops::Range;
use std::sync::Arc;
use tower_lsp::lsp_types::Position;
use trunnion_syntax::line_starts;

/// Pieces have about this many bytes, and at most twice as many.
const PIECE: usize = 1 << 15;

/// Whole lines, or a part of a long one.
#[derive(Debug)]
struct Piece {
    text: String,
    /// How many line ends it has.
    ends: usize,
    /// What stands behind its last line end, bytes and UTF-16 code units.
    tail: (u32, u32),
}

impl Piece {
    fn new(text: &str) -> Self {
        let starts = line_starts(text.as_bytes());
        let tail = &text[starts.last().map_or(0, |start| *start as usize)..];
        let units: usize = tail.chars().map(char::len_utf16).sum();
        Self {
            text: text.to_owned(),
            ends: starts.len() - 1,
            tail: (tail.len() as u32, units as u32),
        }
    }
}

/// See the module. No line end of two bytes is cut. A clone shares the pieces.
#[derive(Clone, Debug)]
pub(crate) struct Text {
    pieces: Vec<Arc<Piece>>,
}

/// Cuts a text after line feeds; a line that is too long, between two characters.
fn cut(mut text: &str) -> Vec<Arc<Piece>> {
    let mut pieces = Vec::with_capacity(text.len() / PIECE + 1);
    while !text.is_empty() {
        let bytes = text.as_bytes();
        let most = text.len().min(2 * PIECE);
        let end = match memchr::memchr(b'\n', &bytes[PIECE.min(most)..most]) {
            Some(at) => PIECE + at + 1,
            None if text.len() <= 2 * PIECE => text.len(),
            None => text.floor_char_boundary(PIECE),
        };
        let (piece, rest) = text.split_at(end);
        pieces.push(Arc::new(Piece::new(piece)));
        text = rest;
    }
    pieces
}

impl Text {
    pub(crate) fn new(text: &str) -> Self {
        Self { pieces: cut(text) }
    }

    /// Bytes.
    pub(crate) fn len(&self) -> usize {
        self.pieces.iter().map(|piece| piece.text.len()).sum()
    }

    /// Lines; the empty one after the last line end counts.
    pub(crate) fn lines(&self) -> usize {
        self.pieces.iter().map(|piece| piece.ends).sum::<usize>() + 1
    }

    /// The piece in which a line starts, perhaps at its end, its first byte and its first line; the end of the text for a line behind it.
    fn piece_of(&self, line: usize) -> (usize, usize, usize) {
        let (mut byte, mut first) = (0, 0);
        for (index, piece) in self.pieces.iter().enumerate() {
            if line <= first + piece.ends {
                return (index, byte, first);
            }
            byte += piece.text.len();
            first += piece.ends;
        }
        (self.pieces.len(), byte, first)
    }

    /// First byte of a line; the end of the text for a line behind it.
    pub(crate) fn start_of(&self, line: usize) -> usize {
        let (index, byte, first) = self.piece_of(line);
        let Some(piece) = self.pieces.get(index) else {
            return byte;
        };
        byte + line_starts(piece.text.as_bytes())[line - first] as usize
    }

    /// Byte of a position; beyond the end of a line or text it is that end.
    pub(crate) fn offset(&self, position: Position, encoding: Encoding) -> usize {
        let (index, mut byte, first) = self.piece_of(position.line as usize);
        let mut inside = Position::new(position.line - first as u32, position.character);
        for (index, piece) in self.pieces.iter().enumerate().skip(index) {
            let width = match encoding {
                Encoding::Utf8 => piece.tail.0,
                Encoding::Utf16 => piece.tail.1,
            };
            // a long line goes on in the next piece
            let goes_on = inside.line as usize == piece.ends && index + 1 < self.pieces.len();
            if !goes_on || inside.character < width {
                let text = piece.text.as_bytes();
                return byte + offset(text, &Lines::new(text), inside, encoding);
            }
            inside = Position::new(0, inside.character - width);
            byte += piece.text.len();
        }
        byte
    }

    /// Whole lines.
    pub(crate) fn of_lines(&self, lines: Range<usize>) -> String {
        self.of_bytes(self.start_of(lines.start)..self.start_of(lines.end.max(lines.start)))
    }

    /// A part of the text. Its ends must be those of characters.
    fn of_bytes(&self, bytes: Range<usize>) -> String {
        let mut out = String::with_capacity(bytes.len());
        let mut at = 0;
        for piece in &self.pieces {
            let end = at + piece.text.len();
            let (from, to) = (bytes.start.clamp(at, end), bytes.end.clamp(at, end));
            out.push_str(&piece.text[from - at..to - at]);
            at = end;
            if at >= bytes.end {
                break;
            }
        }
        out
    }

    /// The text from a line on.
    pub(crate) fn behind(&self, line: usize) -> impl Iterator<Item = &str> {
        let mut skip = self.start_of(line);
        self.pieces.iter().map(move |piece| {
            let left = skip.min(piece.text.len());
            skip -= left;
            &piece.text[left..]
        })
    }

    /// All of it.
    pub(crate) fn whole(&self) -> String {
        self.of_bytes(0..self.len())
    }

    /// Replaces bytes.
    pub(crate) fn replace(&mut self, bytes: Range<usize>, new: &str) {
        let (mut at, mut index) = (0, 0);
        while let Some(piece) = self.pieces.get(index)
            && at + piece.text.len() < bytes.start
        {
            at += piece.text.len();
            index += 1;
        }
        let first = index;
        let mut text = String::new();
        // the pieces that the range touches; the next one may begin with the rest of a line end
        while let Some(piece) = self.pieces.get(index)
            && (at <= bytes.end || text.ends_with('\r') && piece.text.starts_with('\n'))
        {
            let end = at + piece.text.len();
            if (at..=end).contains(&bytes.start) && index == first {
                text.push_str(&piece.text[..bytes.start - at]);
                text.push_str(new);
            }
            text.push_str(&piece.text[bytes.end.clamp(at, end) - at..]);
            at = end;
            index += 1;
        }
        if index == first {
            // behind the last piece, or there is none
            text.push_str(new);
        }
        drop(self.pieces.splice(first..index, cut(&text)));
    }
}

#[cfg(test)]
mod tests {
    use super::{PIECE, Piece, Text};
    use crate::position::{Encoding, Lines, offset};
    use std::sync::Arc;
    use tower_lsp::lsp_types::Position;

    fn compare(text: &Text, plain: &str) {
        assert_eq!(text.whole(), plain);
        let starts = Lines::new(plain.as_bytes());
        assert_eq!(text.lines(), starts.len());
        let half = starts.len() / 2;
        assert_eq!(text.behind(half).collect::<String>(), plain[starts[half] as usize..]);
        let lines = [0, 1, starts.len() / 2, starts.len() - 1, starts.len(), starts.len() + 5];
        for line in lines {
            let start = starts.get(line).map_or(plain.len(), |start| *start as usize);
            assert_eq!(text.start_of(line), start, "{line}");
            for character in [0, 3, 99, 40_000, 2_000_000] {
                let at = Position::new(line as u32, character);
                let expected = offset(plain.as_bytes(), &starts, at, Encoding::Utf16);
                assert_eq!(text.offset(at, Encoding::Utf16), expected, "{at:?}");
            }
            let end = starts.get(line + 2).map_or(plain.len(), |start| *start as usize);
            assert_eq!(text.of_lines(line..line + 2), plain[start..end.max(start)]);
        }
        assert!(text.pieces.iter().all(|piece| piece.text.len() <= 2 * PIECE));
        let cut = |pair: &[Arc<Piece>]| pair[0].text.ends_with('\r') && pair[1].text.starts_with('\n');
        assert!(!text.pieces.windows(2).any(cut));
    }

    #[test]
    fn edits_are_those_of_a_plain_text() {
        let mut plain = "N1 G1 X1 (\u{e4}\u{1f527})\r\nX2\rX3\n".repeat(9000);
        let mut text = Text::new(&plain);
        assert!(text.pieces.len() > 5);
        compare(&text, &plain);
        let mut seed = 7_u64;
        let mut random = |below: usize| {
            seed = seed
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) as usize % (below + 1)
        };
        let long = "Y1\n".repeat(PIECE);
        let line = "X1 \u{e4}\u{1f527}".repeat(PIECE / 4);
        let new = ["", "\n", "\r", "X1", "\r\n", "G1\nG2\n", &long, &line];
        for turn in 0..300 {
            let mut start = random(plain.len());
            // the ends of pieces are where mistakes are
            if turn % 3 == 0 {
                let piece = random(text.pieces.len());
                start = text.pieces[..piece].iter().map(|piece| piece.text.len()).sum();
                start = (start + random(2)).saturating_sub(1).min(plain.len());
            }
            let mut end = (start + random(if turn % 7 == 0 { 3 * PIECE } else { 4 })).min(plain.len());
            while !plain.is_char_boundary(start) {
                start -= 1;
            }
            while !plain.is_char_boundary(end) {
                end += 1;
            }
            let new = new[random(new.len() - 1)];
            text.replace(start..end, new);
            plain.replace_range(start..end, new);
            compare(&text, &plain);
        }
        text.replace(0..plain.len(), "");
        compare(&text, "");
        text.replace(0..0, "G1");
        compare(&text, "G1");
    }

    #[test]
    fn an_edit_copies_few_bytes_of_a_long_line() {
        let mut text = Text::new(&"X1 ".repeat(30 * PIECE));
        for turn in 0..1000 {
            let before = text.clone();
            let at = text.offset(Position::new(0, 40 * PIECE as u32), Encoding::Utf16);
            assert_eq!(at, 40 * PIECE);
            text.replace(at..at + turn % 2, "X\r");
            text.replace(at + 1..at + 2, "");
            let copied = text
                .pieces
                .iter()
                .filter(|piece| !before.pieces.iter().any(|old| Arc::ptr_eq(old, piece)));
            assert!(copied.map(|piece| piece.text.len()).sum::<usize>() <= 4 * PIECE);
        }
        assert!(text.pieces.len() < 100, "{}", text.pieces.len());
    }
}
