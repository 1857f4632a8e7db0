//! Parsing on two threads: each lexes one half of the text.
//!
//! A lexer that starts at a block start needs nothing from before it. So the halves are those of the whole where
//! the first of them ends with a line end of its own, and not inside a comment or statement of several lines.
use crate::builder::Builder;
use crate::plain::goes_on;
use crate::program::{lex, room};
use crate::{LexOptions, Program, SyntaxError, TokenKind, parse};

/// Shorter texts are not worth a second thread, bytes.
const WORTH: usize = 1 << 20;

/// Parses any bytes on at most this many threads (no more than two are used). The program is that of [`parse`], whatever the number.
pub fn parse_on(source: Vec<u8>, options: LexOptions, threads: usize) -> Program {
    let middle = source.len() / 2;
    let line_end = memchr::memchr(b'\n', &source[middle..]);
    match line_end {
        Some(at) if threads > 1 && source.len() >= WORTH => in_halves(source, options, middle + at + 1),
        _ => parse(source, options),
    }
}

/// Parses what is before the byte `cut`, after a line feed, and what is after it in parallel.
fn in_halves(source: Vec<u8>, options: LexOptions, cut: usize) -> Program {
    if source.len() >= u32::MAX as usize || goes_on(&source, cut, options) {
        return parse(source, options);
    }
    let (front, back) = source.split_at(cut);
    let (mut out, behind) = std::thread::scope(|scope| {
        let behind = scope.spawn(|| {
            let mut out = room(back, options);
            lex(back, options, false, &mut out);
            out
        });
        // the second half is added to the same table
        let mut out = room(&source, options);
        lex(front, options, true, &mut out);
        match behind.join() {
            Ok(behind) => (out, behind),
            Err(panic) => std::panic::resume_unwind(panic),
        }
    });
    if out.table.kinds.last() != Some(&TokenKind::Newline) {
        // what began in the first half continues after it
        return parse(source, options);
    }
    join(&mut out, &behind, cut as u32);
    Program::of(source, options, out)
}

/// Adds blocks that were lexed as a separate text, which begins at byte `cut`. Touching fresh memory costs more than writing to it, so both
/// threads share that work.
pub(crate) fn join(out: &mut Builder, behind: &Builder, cut: u32) {
    let first = out.table.kinds.len() as u32;
    let (kinds, starts) = (&mut out.table.kinds, &mut out.table.starts);
    std::thread::scope(|scope| {
        scope.spawn(|| starts.extend_moved(&behind.table.starts, 0, behind.table.len(), cut));
        kinds.extend_from_slice(&behind.table.kinds);
        out.blocks.extend(behind.blocks.iter().map(|token| token + first));
    });
    out.table.end = behind.table.end + cut;
    out.errors.extend(behind.errors.iter().map(|error| SyntaxError {
        range: error.range.shifted(cut),
        ..*error
    }));
    out.sort_errors();
}

#[cfg(test)]
mod tests {
    use super::{WORTH, in_halves, parse_on};
    use crate::{Format, LexOptions, parse};
    use proptest::prelude::*;

    /// Cut after each of its line feeds, a text is parsed as in one piece.
    fn compare(source: &[u8]) -> Result<(), TestCaseError> {
        let core = LexOptions::default();
        let no_comments = LexOptions {
            paren_comment: false,
            slash_star_comment: false,
            ..core
        };
        let apt = LexOptions {
            format: Format::Apt,
            ..core
        };
        let osp = LexOptions {
            format: Format::Osp,
            ..core
        };
        for options in [core, no_comments, apt, osp] {
            let whole = parse(source.to_vec(), options);
            for cut in memchr::memchr_iter(b'\n', source) {
                prop_assert_eq!(
                    &in_halves(source.to_vec(), options, cut + 1),
                    &whole,
                    "{} {:?}",
                    cut,
                    options
                );
            }
        }
        Ok(())
    }

    #[test]
    fn what_goes_on_behind_the_cut_is_parsed_in_one_piece() {
        for source in [
            "G1\nX1\nX2",
            "G1\r\nX1\r\n\r\n",
            "/* G1\nX1\n*/ X2\nX3\n",
            "X1 */\n/*\nX2\n",
            "GOTO / 1, $\n2, 3\nGOTO / 1, 2\n",
            "G1 X\nG1 [\n(\n\"\nX5.5.5\n",
            "\u{feff}G1\n\u{feff}X1\n",
            "%\n%\n",
            "$A.MIN%\nN1 X1\n$ Y2\n$\n$Z3\nNA X4\n",
            "\n",
        ] {
            compare(source.as_bytes()).expect(source);
        }
    }

    #[test]
    fn long_texts_are_parsed_on_two_threads() {
        let line = "N10 G1 X1.5 Y-20 (there) A=[1+#2] Q\n";
        let source = line.repeat(WORTH / line.len() + 9).into_bytes();
        for threads in [1, 2, 3] {
            let program = parse_on(source.clone(), LexOptions::default(), threads);
            assert!(program == parse(source.clone(), LexOptions::default()), "{threads}");
            assert_eq!(program.errors().len(), program.block_count());
        }
        assert_eq!(parse_on(Vec::new(), LexOptions::default(), 2).block_count(), 0);
    }

    proptest! {
        #[test]
        fn halves_are_those_of_the_whole(source in "([GXY]-?[0-9]{0,3}\\.?[0-9]?| |\\(|\\)|/\\*|\\*/|;|\\$|\\[|\"|,|%|#|=|\r|\n|\n){0,40}") {
            compare(source.as_bytes())?;
        }
    }
}
