//! Colours: what each piece of a text is, from its tokens and the dialect's table.
use trunnion_dialect::{Dialect, Language, Role};
use trunnion_syntax::{Format, Item, LexOptions, Program, TextRange, TokenId, TokenKind, parse};

/// The kinds of pieces, as the protocol names them; [`Token::kind`] is an index.
pub const TOKEN_TYPES: [&str; 10] = [
    "comment",
    "string",
    "number",
    "keyword",
    "function",
    "macro",
    "variable",
    "parameter",
    "label",
    "operator",
];

const COMMENT: u32 = 0;
const STRING: u32 = 1;
const NUMBER: u32 = 2;
const KEYWORD: u32 = 3;
const FUNCTION: u32 = 4;
const MACRO: u32 = 5;
const VARIABLE: u32 = 6;
const PARAMETER: u32 = 7;
const LABEL: u32 = 8;
const OPERATOR: u32 = 9;

/// One piece of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// Its bytes; it may span lines.
    pub range: TextRange,
    /// Index into [`TOKEN_TYPES`].
    pub kind: u32,
}

/// The pieces of whole lines of a text; offsets count from their start. Only a comment over several lines that begins before them is not
/// seen as one.
pub fn tokens(lines: &[u8], lex: LexOptions, dialect: &Dialect) -> Vec<Token> {
    let program = parse(lines.to_vec(), lex);
    let table = program.tokens();
    let mut found = Vec::with_capacity(table.len() / 2);
    for id in 0..table.len() as u32 {
        let range = table.range(id);
        let text = program.bytes(range);
        let kind = match table.kind(id) {
            TokenKind::Comment | TokenKind::UnclosedComment | TokenKind::FreeText => COMMENT,
            TokenKind::Text => STRING,
            TokenKind::Number => NUMBER,
            TokenKind::Word | TokenKind::Letter => letter(dialect, text[0].to_ascii_uppercase()),
            TokenKind::Name if is_osp_name(&program, id, text) => LABEL,
            TokenKind::Name => name(dialect, lex, &program.text(range)),
            TokenKind::Hash => VARIABLE,
            TokenKind::Less | TokenKind::Greater if text.len() > 1 => LABEL,
            TokenKind::Equals
            | TokenKind::Star
            | TokenKind::Plus
            | TokenKind::Minus
            | TokenKind::Less
            | TokenKind::Greater => OPERATOR,
            TokenKind::Percent => LABEL,
            _ => continue,
        };
        // the number of a word is a number, but for codes, tools and labels, which are one piece
        let whole = matches!(kind, KEYWORD | FUNCTION | LABEL | MACRO | VARIABLE);
        if table.kind(id) == TokenKind::Word && !whole {
            found.push(Token {
                range: TextRange::new(range.start, range.start + 1),
                kind,
            });
            found.push(Token {
                range: TextRange::new(range.start + 1, range.end),
                kind: NUMBER,
            });
        } else {
            found.push(Token { range, kind });
        }
    }
    found
}

/// Whether a name is that of an OSP block or program, at the start of its block.
fn is_osp_name(program: &Program, id: TokenId, text: &[u8]) -> bool {
    if program.options().format != Format::Osp || !matches!(text[0], b'N' | b'n' | b'O' | b'o') {
        return false;
    }
    let range = program.tokens().range(id);
    let label = |item: Item| matches!(item, Item::Label(label) if label.start == range.start);
    let block = program.block_at(range.start).map(|block| program.block(block));
    block.is_some_and(|block| block.items().take(2).any(label))
}

fn letter(dialect: &Dialect, letter: u8) -> u32 {
    match dialect.role(letter) {
        Some(Role::G) => KEYWORD,
        Some(Role::M) => FUNCTION,
        Some(Role::BlockNumber | Role::ProgramNumber) => LABEL,
        Some(Role::Variable) => VARIABLE,
        _ if letter == b'O' && dialect.quirks.language == Language::Linuxcnc => LABEL,
        _ => PARAMETER,
    }
}

fn name(dialect: &Dialect, lex: LexOptions, text: &str) -> u32 {
    match dialect.name(text) {
        Some(_) if lex.format == Format::Apt => KEYWORD,
        Some(_) => MACRO,
        None if dialect.named_role(text.as_bytes()).is_some() => PARAMETER,
        None if text.starts_with('%') => LABEL,
        None => VARIABLE,
    }
}
