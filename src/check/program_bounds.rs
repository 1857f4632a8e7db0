//! The first and the last block of a Klartext program.
use trunnion_dialect::Dialect;
use trunnion_syntax::{Block, Format};

/// BEGIN PGM (true) or END PGM, and what stands after it.
pub(crate) fn bound(text: &[u8]) -> Option<(bool, String)> {
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
pub(crate) fn is_end(block: &Block<'_>, dialect: &Dialect) -> bool {
    let end = |text: &[u8]| bound(text).is_some_and(|(begins, _)| !begins);
    dialect.lex.format == Format::Klartext && block.sentence().is_some_and(|sentence| end(&sentence.text()))
}

#[cfg(test)]
mod tests {
    use crate::fixture::Fixture;

    /// M30 ends the program; what stands between it and END PGM is left out all the same.
    #[test]
    fn the_end_after_m30_is_not_left_out() {
        let blocks = |text: &str| {
            let found = Fixture::parse("gcode heidenhain-klartext", text).check();
            let coverage = found.expect("checked").coverage;
            (coverage.blocks, coverage.blocks_run, coverage.not_run.len())
        };
        assert_eq!(
            blocks("0 BEGIN PGM A MM\n1 L X+1 FMAX\n2 M30\n3 END PGM A MM\n"),
            (3, 3, 0)
        );
        assert_eq!(
            blocks("0 BEGIN PGM A MM\n1 M30\n2 L X+1 FMAX\n3 END PGM A MM\n"),
            (3, 2, 1)
        );
    }
}
