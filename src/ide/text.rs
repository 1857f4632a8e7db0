//! Small readers of text that several features share.
use trunnion_dialect::{Code, Dialect};
use trunnion_syntax::{Address, Block, Item, Program, TextRange, TokenId, TokenKind, Value, Word};

/// The code that a word names: `G1`, `M06`.
pub(crate) fn code_of<'d>(dialect: &'d Dialect, word: &Word) -> Option<&'d Code> {
    let Value::Number(number) = word.value else { return None };
    let tenths = number.to_f64() * 10.0;
    if tenths < 0.0 || tenths.fract() != 0.0 {
        return None;
    }
    match word.address {
        Address::Letter(b'G') => dialect.g(tenths as u32),
        Address::Letter(b'M') => dialect.m(tenths as u32),
        _ => None,
    }
}

/// The codes of a block in order, with their bytes: G and M words, names, and the major word of an APT record.
pub(crate) fn codes<'d>(dialect: &'d Dialect, block: &Block<'_>) -> Vec<(&'d Code, TextRange)> {
    let program = block.program();
    if let Some(record) = block.record() {
        let code = dialect.name(&program.text(record.major));
        return code.map(|code| (code, record.major)).into_iter().collect();
    }
    let one = |item| match item {
        Item::Word(word) => Some((code_of(dialect, &word)?, word.range)),
        Item::Call(call) => Some((dialect.name(&program.text(call.name))?, call.name)),
        _ => None,
    };
    block.items().filter_map(one).collect()
}

/// The next token of the block from `at` on that is neither blank nor comment.
pub(crate) fn significant(program: &Program, at: TokenId, end: TokenId) -> Option<TokenId> {
    (at..end).find(|&id| {
        !matches!(
            program.tokens().kind(id),
            TokenKind::Blank | TokenKind::Comment | TokenKind::UnclosedComment | TokenKind::Newline
        )
    })
}

/// Bytes without the blanks around them.
pub(crate) fn trimmed(program: &Program, range: TextRange) -> TextRange {
    let bytes = program.bytes(range);
    let from = bytes.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
    let inner = bytes[from..].trim_ascii_end();
    TextRange::new(range.start + from as u32, range.start + (from + inner.len()) as u32)
}

/// Whether a byte belongs to an identifier.
pub(crate) fn in_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_' || byte == b'$'
}
