//! The first and the last block of a Klartext program.
use trunnion_dialect::Dialect;
use trunnion_syntax::{Block, Format};

/// BEGIN PGM (true) or END PGM, and what stands after it.
pub fn program_bound(text: &[u8]) -> Option<(bool, String)> {
    // most blocks begin otherwise
    if !matches!(text.first(), Some(b'B' | b'b' | b'E' | b'e')) {
        return None;
    }
    let text = String::from_utf8_lossy(text);
    let mut words = text.split_whitespace();
    let first = words.next()?;
    let begins = first.eq_ignore_ascii_case("BEGIN");
    if !begins && !first.eq_ignore_ascii_case("END") || !words.next()?.eq_ignore_ascii_case("PGM") {
        return None;
    }
    Some((begins, words.collect::<Vec<_>>().join(" ")))
}

/// Whether a block is END PGM, which does nothing after an M30.
pub fn is_program_end(block: &Block<'_>, dialect: &Dialect) -> bool {
    let end = |text: &[u8]| program_bound(text).is_some_and(|(begins, _)| !begins);
    dialect.lex.format == Format::Klartext && block.sentence().is_some_and(|sentence| end(&sentence.text()))
}
