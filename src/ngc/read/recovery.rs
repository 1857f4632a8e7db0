//! Where reading continues after a wrong value, so that all mistakes of a line are reported at once.
//!
//! The control strips blanks before it reads, and so nothing here may depend on them.

/// One past the closed brackets that hold the place `from`; else where the next word, assignment or comment begins from there on; else
/// `end`. `start` is the first byte of the word or assignment whose value is wrong.
pub(super) fn next_item(source: &[u8], start: u32, from: u32, end: u32) -> u32 {
    let text = &source[start as usize..end as usize];
    let from = (from - start) as usize;
    start + behind_brackets(text, from).unwrap_or_else(|| item(text, from)) as u32
}

/// One past the `]` that closes the outermost bracket that is open at `from`; `None` where none is open or it is not closed.
fn behind_brackets(text: &[u8], from: usize) -> Option<usize> {
    let mut depth = 0u32;
    for (place, byte) in text.iter().enumerate() {
        if place == from && depth == 0 {
            return None;
        }
        match byte {
            b'[' => depth += 1,
            b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if place >= from && depth == 0 {
            return Some(place + 1);
        }
    }
    None
}

/// The first place from `from` on that looks like the start of something: a comment; `#` after a value; a letter that is alone. Letters
/// beside each other are an unknown name, except two at the start of `text`: there a word has no value, and the next one follows.
fn item(text: &[u8], from: usize) -> usize {
    let solid = |byte: &u8| !matches!(byte, b' ' | b'\t' | b'\r');
    let mut letters = 0u32;
    let mut first_run = true;
    let mut last = b' ';
    for (place, &byte) in text.iter().enumerate().filter(|(_, byte)| solid(byte)) {
        if byte.is_ascii_alphabetic() {
            letters += 1;
        } else {
            first_run = false;
            letters = 0;
        }
        let begins = match byte {
            b';' | b'(' => true,
            b'#' => matches!(last, b'0'..=b'9' | b'.' | b']' | b'>' | b')'),
            byte if byte.is_ascii_alphabetic() => {
                let next = text[place + 1..].iter().find(|byte| solid(byte)).copied();
                match letters {
                    1 => !next.is_some_and(|next| next.is_ascii_alphabetic()),
                    2 => first_run && matches!(next, Some(b'0'..=b'9' | b'.' | b'+' | b'-' | b'#' | b'[')),
                    _ => false,
                }
            }
            _ => false,
        };
        if begins && place >= from {
            return place;
        }
        last = byte;
    }
    text.len()
}
