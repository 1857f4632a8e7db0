//! The text of one statement, comments left out, with its place in the file.
use trunnion_syntax::{Block, Format, TextRange};

/// See the module.
pub(crate) struct Text {
    bytes: Vec<u8>,
    /// Offset of the first byte in the file.
    base: u32,
    at: usize,
}

impl Text {
    /// The block from the byte `start` of the file on.
    pub(crate) fn of(block: &Block<'_>, start: u32) -> Self {
        let range = TextRange::new(start, block.range().end.max(start));
        let mut bytes = block.program().bytes(range).to_vec();
        for comment in block.comments() {
            let inside = |offset: u32| (offset.max(start) - start) as usize;
            let (from, to) = (inside(comment.range.start), inside(comment.range.end).min(bytes.len()));
            if from < to {
                bytes[from..to].fill(b' ');
            }
        }
        if block.program().options().format == Format::Osp {
            // the `$` of lines that continue the block
            for at in 1..bytes.len() {
                if bytes[at] == b'$' && matches!(bytes[at - 1], b'\n' | b'\r') {
                    bytes[at] = b' ';
                }
            }
        }
        Self {
            bytes,
            base: start,
            at: 0,
        }
    }

    pub(crate) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    fn blanks(&mut self) {
        let blank = |byte: &&u8| matches!(byte, b' ' | b'\t' | b'\r' | b'\n' | b'&');
        self.at += self.bytes[self.at..].iter().take_while(blank).count();
    }

    /// The position of the next character in the text.
    pub(crate) fn at(&mut self) -> usize {
        self.blanks();
        self.at
    }

    pub(crate) fn go_to(&mut self, at: usize) {
        self.at = at.min(self.bytes.len());
    }

    pub(crate) fn is_at_end(&mut self) -> bool {
        self.at() == self.bytes.len()
    }

    /// The place of a part of the text in the file.
    pub(crate) fn range(&self, from: usize, to: usize) -> TextRange {
        let part = &self.bytes[from..to.max(from)];
        let blanks = part.iter().rev().take_while(|byte| byte.is_ascii_whitespace()).count();
        TextRange::new(self.base + from as u32, self.base + (to.max(from) - blanks) as u32)
    }

    /// The place of all that is not read yet.
    pub(crate) fn rest(&mut self) -> TextRange {
        let at = self.at();
        self.range(at, self.bytes.len())
    }

    /// A word of letters, digits and `_` in upper case; empty where there is none.
    pub(crate) fn word(&mut self) -> String {
        let from = self.at();
        let is_name = |byte: &&u8| byte.is_ascii_alphanumeric() || **byte == b'_';
        self.at += self.bytes[from..].iter().take_while(is_name).count();
        String::from_utf8_lossy(&self.bytes[from..self.at]).to_ascii_uppercase()
    }

    /// A path to a program without quotation marks, up to a bracket or blank: `/_N_SPF_DIR/_N_GROOVE_SPF`.
    pub(crate) fn path(&mut self) -> String {
        let from = self.at();
        let is_part = |byte: &&u8| byte.is_ascii_alphanumeric() || b"_/.:".contains(byte);
        self.at += self.bytes[from..].iter().take_while(is_part).count();
        String::from_utf8_lossy(&self.bytes[from..self.at]).into_owned()
    }

    /// Letters alone: a keyword that a number may follow directly.
    pub(crate) fn letters(&mut self) -> String {
        let from = self.at();
        let count = self.bytes[from..]
            .iter()
            .take_while(|byte| byte.is_ascii_alphabetic())
            .count();
        self.at += count;
        String::from_utf8_lossy(&self.bytes[from..self.at]).to_ascii_uppercase()
    }

    /// Takes a character if it is next.
    pub(crate) fn eat(&mut self, sign: u8) -> bool {
        let at = self.at();
        let there = self.bytes.get(at) == Some(&sign);
        self.at += usize::from(there);
        there
    }

    /// What is between the brackets at this point, up to the last one that closes.
    pub(crate) fn in_brackets(&mut self) -> Option<String> {
        let from = self.at();
        if self.bytes.get(from) != Some(&b'(') {
            return None;
        }
        let length = self.bytes[from..].iter().rposition(|&byte| byte == b')')?;
        self.at = from + length + 1;
        Some(String::from_utf8_lossy(&self.bytes[from + 1..from + length]).into_owned())
    }

    /// Takes a whole number with its sign.
    pub(crate) fn integer(&mut self) -> Option<f64> {
        let from = self.at();
        let sign = usize::from(matches!(self.bytes.get(from), Some(b'-' | b'+')));
        let digits = self.bytes[from + sign..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit())
            .count();
        let text = std::str::from_utf8(&self.bytes[from..from + sign + digits]).ok()?;
        let value = text.parse().ok().filter(|_| digits > 0)?;
        self.at = from + sign + digits;
        Some(value)
    }
}
