//! Names of Klartext: labels (`LBL 1`, `LBL "NAME"`, `CALL LBL`, `GOTO LBL`) and parameters (`Q12`, `QL3`, `QR4`, `QS5`). Parameters of cycles and of
//! the control (Q100 to Q1599) have a meaning of their own and are not listed.
use super::{Kind, Names, Role, Scope};
use trunnion_syntax::{Program, TextRange};

pub(super) fn read(program: &Program, found: &mut Names) {
    for block in program.blocks() {
        let range = block.range();
        let text = program.bytes(range);
        let mut at = 0;
        let mut quoted = false;
        while at < text.len() {
            match text[at] {
                b'"' => quoted = !quoted,
                b';' if !quoted => {
                    let end = text[at..].iter().position(|byte| *byte == b'\n');
                    at += end.unwrap_or(text.len() - at);
                }
                b'Q' | b'q' if !quoted => {
                    let end = parameter(text, at, range.start, found);
                    at = end.max(at + 1);
                    continue;
                }
                b'L' | b'l' if !quoted && is_word(text, at, b"LBL") => {
                    at = label(text, at, range.start, found);
                    continue;
                }
                _ => {}
            }
            at += 1;
        }
    }
}

/// Whether a word stands here, by itself.
fn is_word(text: &[u8], at: usize, word: &[u8]) -> bool {
    let ends = |byte: Option<&u8>| byte.is_none_or(|byte| !byte.is_ascii_alphanumeric());
    text[at..].len() >= word.len()
        && text[at..at + word.len()].eq_ignore_ascii_case(word)
        && ends(text.get(at + word.len()))
        && (at == 0 || ends(text.get(at - 1)))
}

/// The label behind LBL; returns where it ends. LBL 0 ends a section and is no name.
fn label(text: &[u8], at: usize, start: u32, found: &mut Names) -> usize {
    let blanks = |from: usize| {
        text[from..]
            .iter()
            .take_while(|byte| byte.is_ascii_whitespace())
            .count()
    };
    let mut from = at + 3;
    from += blanks(from);
    let quoted = text.get(from) == Some(&b'"');
    from += usize::from(quoted);
    let length = text[from..]
        .iter()
        .take_while(|byte| {
            if quoted {
                **byte != b'"' && **byte != b'\n'
            } else {
                byte.is_ascii_digit()
            }
        })
        .count();
    let name = String::from_utf8_lossy(&text[from..from + length]).to_ascii_lowercase();
    if length > 0 && name != "0" {
        let before = text[..at].trim_ascii_end().to_ascii_uppercase();
        let used = before.ends_with(b"CALL") || before.ends_with(b"GOTO");
        let role = if used { Role::Read } else { Role::Definition };
        let range = TextRange::new(start + from as u32, start + (from + length) as u32);
        found.add(range, Kind::Label, role, &name, Scope::Part(0));
    }
    from + length + usize::from(quoted)
}

/// A parameter; returns where it ends.
fn parameter(text: &[u8], at: usize, start: u32, found: &mut Names) -> usize {
    let letters = 1 + usize::from(matches!(
        text.get(at + 1),
        Some(b'L' | b'R' | b'S' | b'l' | b'r' | b's')
    ));
    let digits = text[at + letters..]
        .iter()
        .take_while(|byte| byte.is_ascii_digit())
        .count();
    let end = at + letters + digits;
    // behind an address: FQ5, IX-Q1
    let address = text[..at]
        .iter()
        .rev()
        .take_while(|byte| byte.is_ascii_alphabetic())
        .count();
    let whole = digits > 0 && address <= 2 && text.get(end).is_none_or(|byte| !byte.is_ascii_alphanumeric());
    let number: u32 = std::str::from_utf8(&text[at + letters..end])
        .ok()
        .and_then(|digits| digits.parse().ok())
        .unwrap_or(u32::MAX);
    let own = letters == 2 || number < 100 || (1600..2000).contains(&number);
    if whole && own {
        let name = String::from_utf8_lossy(&text[at..end]).to_ascii_lowercase();
        let assigned = address == 0 && text[end..].trim_ascii_start().first() == Some(&b'=') && begins(text, at);
        let role = if assigned { Role::Write } else { Role::Read };
        let scope = if name.starts_with("ql") {
            Scope::Part(0)
        } else {
            Scope::Shared
        };
        let range = TextRange::new(start + at as u32, start + end as u32);
        found.add(range, Kind::Variable, role, &name, scope);
    }
    end
}

/// Whether a parameter is the one that a block writes: only a block number, or `FN 4:`, stands before it.
fn begins(text: &[u8], at: usize) -> bool {
    let line = text[..at]
        .rsplit(|byte| *byte == b'\n')
        .next()
        .unwrap_or_default()
        .trim_ascii();
    line.ends_with(b":")
        || line
            .iter()
            .all(|byte| byte.is_ascii_digit() || *byte == b'/' || *byte == b' ')
}
