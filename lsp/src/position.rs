//! LSP positions and bytes: here and nowhere else.
use tower_lsp::lsp_types::{Position, Range};
use trunnion_syntax::TextRange;
pub(crate) use trunnion_syntax::line_starts;

/// How the client counts columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    /// UTF-16 code units (the protocol's default).
    Utf16,
    /// Bytes.
    Utf8,
}

/// The text of a piece of a document, which is UTF-8. A piece of a line costs as much as it is long, the whole text too.
fn utf8(bytes: &[u8]) -> &str {
    core::str::from_utf8(bytes).unwrap_or_default()
}

/// Byte offset of a position in a text, which is UTF-8; beyond the end of a line or text it is that end.
pub(crate) fn offset(text: &[u8], starts: &[u32], position: Position, encoding: Encoding) -> usize {
    let Some(&start) = starts.get(position.line as usize) else {
        return text.len();
    };
    let end = starts
        .get(position.line as usize + 1)
        .map_or(text.len(), |&next| next as usize);
    let line = utf8(&text[start as usize..end]).trim_end_matches(['\n', '\r']);
    let mut units = 0;
    for (at, character) in line.char_indices() {
        if units >= position.character {
            return start as usize + at;
        }
        units += units_of(character, encoding);
    }
    start as usize + line.len()
}

/// Position of a byte offset.
pub(crate) fn position(text: &[u8], starts: &[u32], offset: usize, encoding: Encoding) -> Position {
    let mut offset = offset.min(text.len());
    // inside a character: 10xxxxxx
    while text.get(offset).is_some_and(|byte| byte & 0xc0 == 0x80) {
        offset -= 1;
    }
    let line = starts
        .partition_point(|&start| start as usize <= offset)
        .saturating_sub(1);
    let start = starts.get(line).copied().unwrap_or(0) as usize;
    let character = utf8(&text[start..offset]).chars().map(|c| units_of(c, encoding)).sum();
    Position {
        line: line as u32,
        character,
    }
}

/// LSP range of a range of bytes.
pub(crate) fn range(text: &[u8], starts: &[u32], bytes: TextRange, encoding: Encoding) -> Range {
    Range {
        start: position(text, starts, bytes.start as usize, encoding),
        end: position(text, starts, bytes.end as usize, encoding),
    }
}

fn units_of(character: char, encoding: Encoding) -> u32 {
    match encoding {
        Encoding::Utf16 => character.len_utf16() as u32,
        Encoding::Utf8 => character.len_utf8() as u32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf16_columns_count_code_units() {
        let text = "(\u{1f527}\u{e4}) G1\r\nX2\rY3";
        let g = text.find('G').expect("there");
        let text = text.as_bytes();
        let starts = line_starts(text);
        assert_eq!(starts, [0, 13, 16]);
        let at = position(text, &starts, g, Encoding::Utf16);
        assert_eq!((at.line, at.character), (0, 6), "the wrench counts two, the umlaut one");
        assert_eq!(offset(text, &starts, at, Encoding::Utf16), g);
        assert_eq!(position(text, &starts, g, Encoding::Utf8).character, g as u32);
        let past = Position { line: 0, character: 99 };
        assert_eq!(
            offset(text, &starts, past, Encoding::Utf16),
            11,
            "clamped before the line end"
        );
        assert_eq!(
            offset(text, &starts, Position { line: 9, character: 0 }, Encoding::Utf16),
            text.len()
        );
    }
}
