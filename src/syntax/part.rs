//! Some lines of a text as a program of their own, whose blocks have the numbers that they have in the whole.
use crate::builder::Builder;
use crate::halves::join;
use crate::plain::goes_on;
use crate::program::lex;
use crate::{LexOptions, Program, TokenKind, parse};

/// Parses `text` with this many empty lines before it: the program is that of [`parse`] for both together. A part of a longer text, which
/// begins with a block, so keeps the numbers of its blocks and lines, and what is before it costs a byte a line.
pub fn parse_after(lines: u32, text: &[u8], options: LexOptions) -> Program {
    let mut source = vec![b'\n'; lines as usize];
    source.extend_from_slice(text);
    if lines == 0 || options.format == crate::Format::Apt || goes_on(text, 0, options) {
        return parse(source, options);
    }
    let mut behind = Builder::with_room(text.len() / 2 + 16, text.len() / 16 + 16);
    lex(text, options, false, &mut behind);
    let mut out = Builder::with_room(
        lines as usize + behind.table.len(),
        lines as usize + behind.blocks.len(),
    );
    out.table.kinds.resize(lines as usize, TokenKind::Newline);
    let starts: Vec<u32> = (0..lines).collect();
    out.table.starts.extend(&starts);
    out.blocks.extend(&starts);
    join(&mut out, &behind, lines);
    Program::of(source, options, out)
}

#[cfg(test)]
mod tests {
    use super::parse_after;
    use crate::{Format, LexOptions, parse};

    #[test]
    fn a_part_is_parsed_as_the_same_text_after_empty_lines() {
        let texts = [
            "G1 X1\nX2 (a)\n\nX3",
            "/* a\n*/ X1\n",
            "\u{feff}G1\r\nX[1\r\n",
            "%\nO1\n#1=[2\n",
            "$ Y2\nN1 X1\n",
            "\n",
            "",
            "L X+1 ; a\nCALL LBL 1\n",
            "GOTO/1,$\n2,3\n",
            "G1 X5.5.5\n",
        ];
        for format in [Format::Iso, Format::Osp, Format::Klartext, Format::Apt] {
            for lines in [0, 1, 15, 16, 17, 300] {
                for text in texts {
                    let options = LexOptions {
                        format,
                        ..LexOptions::default()
                    };
                    let whole = format!("{}{text}", "\n".repeat(lines));
                    let part = parse_after(lines as u32, text.as_bytes(), options);
                    assert_eq!(part, parse(whole.into_bytes(), options), "{format:?} {lines} {text:?}");
                }
            }
        }
    }
}
