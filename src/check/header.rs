//! A rule file's own header as text: `//!` lines become Markdown, at compile time, so that code, page, hover and test
//! cannot drift. The rest of the file is not in the binary.

/// Length of the header of `source` without comment marks: the leading lines that begin with `//!`.
pub const fn docs_len(source: &str) -> usize {
    let bytes = source.as_bytes();
    let (mut at, mut len) = (0, 0);
    while is_header_line(bytes, at) {
        at = text_start(bytes, at);
        while at < bytes.len() && bytes[at] != b'\n' {
            at += 1;
            len += 1;
        }
        at += 1;
        len += 1;
    }
    len
}

/// The header of `source` without comment marks, `LEN` bytes of it.
pub const fn docs_bytes<const LEN: usize>(source: &str) -> [u8; LEN] {
    let bytes = source.as_bytes();
    let mut out = [b'\n'; LEN];
    let (mut at, mut to) = (0, 0);
    while is_header_line(bytes, at) {
        at = text_start(bytes, at);
        while at < bytes.len() && bytes[at] != b'\n' {
            out[to] = bytes[at];
            at += 1;
            to += 1;
        }
        at += 1;
        to += 1;
    }
    out
}

/// `name` with `-` for `_`.
pub const fn dashed<const LEN: usize>(name: &str) -> [u8; LEN] {
    let bytes = name.as_bytes();
    let mut out = [b'-'; LEN];
    let mut at = 0;
    while at < LEN {
        if bytes[at] != b'_' {
            out[at] = bytes[at];
        }
        at += 1;
    }
    out
}

/// Bytes that are known to be UTF-8 because they were cut from a `str` at line ends.
pub const fn text(bytes: &[u8]) -> &str {
    match core::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(_) => panic!("a rule's header and name are UTF-8"),
    }
}

const fn is_header_line(bytes: &[u8], at: usize) -> bool {
    at + 2 < bytes.len() && bytes[at] == b'/' && bytes[at + 1] == b'/' && bytes[at + 2] == b'!'
}

/// After `//!` and the one blank that follows it.
const fn text_start(bytes: &[u8], at: usize) -> usize {
    if at + 3 < bytes.len() && bytes[at + 3] == b' ' {
        at + 4
    } else {
        at + 3
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOURCE: &str = "//! One.\n//!\n//! # Why\n//! two µm\nuse x;\n//! not this\n";

    #[test]
    fn header_is_cut_and_unmarked() {
        const LEN: usize = docs_len(SOURCE);
        const BYTES: [u8; LEN] = docs_bytes(SOURCE);
        assert_eq!(text(&BYTES), "One.\n\n# Why\ntwo µm\n");
    }

    #[test]
    fn names_get_dashes() {
        assert_eq!(text(&dashed::<9>("pole_flip")), "pole-flip");
    }
}
