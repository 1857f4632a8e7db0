//! How one token is written: case, blanks inside words, zeros before a code's number.
use crate::style::{Case, Style, Zeros};
use trunnion_syntax::TokenKind;

/// What may be done to a token's letters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Letters {
    /// They are the style's.
    Styled,
    /// They are the style's, and zeros before the number too: a G or M code.
    Code,
    /// They stay.
    Kept,
}

/// Writes a token.
pub(crate) fn write(out: &mut Vec<u8>, kind: TokenKind, text: &[u8], letters: Letters, style: &Style) {
    let from = out.len();
    match kind {
        TokenKind::Word => word(out, text, letters == Letters::Code, style.zeros),
        TokenKind::Number => out.extend(text.iter().filter(|byte| !matches!(byte, b' ' | b'\t'))),
        TokenKind::Hash => hash(out, text),
        _ => out.extend_from_slice(text),
    }
    let cased = matches!(kind, TokenKind::Word | TokenKind::Letter | TokenKind::Name);
    if cased && letters != Letters::Kept {
        match style.case {
            Case::Upper => out[from..].make_ascii_uppercase(),
            Case::Lower => out[from..].make_ascii_lowercase(),
            Case::Keep => {}
        }
    }
}

/// A letter with its number, without the blanks between.
fn word(out: &mut Vec<u8>, text: &[u8], code: bool, style: Zeros) {
    let from = out.len();
    out.extend(text.iter().filter(|byte| !matches!(byte, b' ' | b'\t')));
    let digits = &out[from + 1..];
    let whole = digits.iter().take_while(|byte| byte.is_ascii_digit()).count();
    // `G.5` and `G+1` are left alone
    if !code || whole == 0 || style == Zeros::Keep {
        return;
    }
    let zeros = digits[..whole].iter().take_while(|&&byte| byte == b'0').count();
    let shortest = whole - zeros.min(whole - 1);
    let wanted = if style == Zeros::Two { shortest.max(2) } else { shortest };
    let digits_at = from + 1;
    if wanted < whole {
        out.drain(digits_at..digits_at + whole - wanted);
    } else {
        out.splice(digits_at..digits_at, std::iter::repeat_n(b'0', wanted - whole));
    }
}

/// `#`, or `#<name>` without blanks before the name.
fn hash(out: &mut Vec<u8>, text: &[u8]) {
    out.push(b'#');
    out.extend_from_slice(text[1..].trim_ascii_start());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(text: &str, style: Style) -> String {
        let mut out = Vec::new();
        let code = matches!(text.as_bytes()[0].to_ascii_uppercase(), b'G' | b'M');
        let letters = if code { Letters::Code } else { Letters::Styled };
        write(&mut out, TokenKind::Word, text.as_bytes(), letters, &style);
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn zeros_of_codes_follow_the_style_and_no_other_zeros() {
        let with = |zeros| Style {
            zeros,
            ..Style::default()
        };
        for (text, kept, dropped, two) in [
            ("g 01", "G01", "G1", "G01"),
            ("G1", "G1", "G1", "G01"),
            ("G00", "G00", "G0", "G00"),
            ("m006", "M006", "M6", "M06"),
            ("G5.1", "G5.1", "G5.1", "G05.1"),
            ("G054.10", "G054.10", "G54.10", "G54.10"),
            ("X - 01.50", "X-01.50", "X-01.50", "X-01.50"),
            ("G.5", "G.5", "G.5", "G.5"),
            ("T01", "T01", "T01", "T01"),
        ] {
            assert_eq!(written(text, with(Zeros::Keep)), kept);
            assert_eq!(written(text, with(Zeros::Drop)), dropped);
            assert_eq!(written(text, with(Zeros::Two)), two);
        }
    }
}
