//! Tokens and blocks cover every text, and problems lie inside it.
use crate::show::{APT, CORE, FANUC, KLARTEXT, NGC, OSP, SINUMERIK};
use proptest::prelude::*;
use trunnion_syntax::{BlockId, Item, Program, TextRange, TokenKind, parse};

fn inside(program: &Program, outer: TextRange, range: TextRange, what: &str) {
    let ordered = outer.start <= range.start && range.start <= range.end && range.end <= outer.end;
    assert!(
        ordered,
        "{what} {range:?} inside {outer:?} of {:?}",
        program.text(outer)
    );
}

/// All promises about ranges, on one program.
pub(crate) fn check(program: &Program) {
    let length = program.source().len() as u32;
    let mut at = 0;
    for id in 0..program.tokens().len() as u32 {
        let range = program.tokens().range(id);
        assert_eq!(range.start, at, "token {id} starts where the one before ends");
        assert!(range.end > range.start, "token {id} is not empty");
        at = range.end;
    }
    assert_eq!(at, length, "the tokens reach the end");
    let mut last = 0;
    for error in program.errors() {
        inside(program, TextRange::new(0, length), error.range, "problem");
        assert!(error.range.start < error.range.end, "the problem {error:?} has a place");
        assert!(error.range.start >= last, "problems are sorted");
        last = error.range.start;
    }
    blocks(program);
    assert_eq!(program.block_at(length + 1), None);
}

fn blocks(program: &Program) {
    let mut at = 0;
    for (index, block) in program.blocks().enumerate() {
        let range = block.range();
        assert_eq!(range.start, at, "block {index} starts where the one before ends");
        let found = Some(BlockId(index as u32));
        assert_eq!(program.block_at(range.start), found);
        for near in [0, index.saturating_sub(1), index, index + 1, index + 2] {
            assert_eq!(program.block_near(range.start, BlockId(near as u32)), found);
        }
        let last = block.tokens().end - 1;
        at = program.tokens().range(last).end;
        assert_eq!(program.block_at(at - 1), Some(BlockId(index as u32)));
        let mut reached = range.start;
        for item in block.items() {
            let (whole, parts) = ranges(item);
            inside(program, range, whole, "item");
            assert!(
                whole.start >= reached && whole.end > whole.start,
                "items follow each other: {item:?}"
            );
            reached = whole.end;
            for part in parts.into_iter().flatten() {
                inside(program, whole, part, "part of an item");
            }
        }
        if let Some(record) = block.record() {
            inside(program, range, record.range, "record");
            inside(program, record.range, record.major, "major word");
            let mut reached = record.major.end;
            for argument in record.args() {
                let (trunnion_syntax::AptArg::Number(_, part)
                | trunnion_syntax::AptArg::Word(part)
                | trunnion_syntax::AptArg::Other(part)) = argument;
                inside(program, record.range, part, "argument");
                assert!(part.start >= reached, "arguments follow each other");
                reached = part.end;
            }
        }
        let _ = block.number();
        block
            .comments()
            .for_each(|comment| inside(program, comment.range, comment.inner, "inner text"));
    }
    assert_eq!(at, program.source().len() as u32, "the blocks reach the end");
}

fn ranges(item: Item) -> (TextRange, [Option<TextRange>; 2]) {
    match item {
        Item::Word(word) => {
            let address = if let trunnion_syntax::Address::Named(range) = word.address {
                Some(range)
            } else {
                None
            };
            (word.range, [Some(word.value_range), address])
        }
        Item::Call(call) => (call.range, [Some(call.name), call.arguments]),
        Item::Comment(comment) => (comment.range, [Some(comment.inner), None]),
        Item::Skip(_, range) | Item::Percent(range) | Item::Label(range) | Item::Other(range) => (range, [None, None]),
    }
}

/// Checks one text under all options.
pub(crate) fn check_all(source: &[u8]) {
    for options in [CORE, SINUMERIK, FANUC, NGC, APT, KLARTEXT, OSP] {
        check(&parse(source.to_vec(), options));
    }
}

/// Texts made of the pieces that mean something together.
pub(crate) fn pieces() -> impl Strategy<Value = Vec<u8>> {
    let piece = prop_oneof![
        4 => proptest::sample::select(vec![
            "G1", "X1.5", "Y-.5", " ", "\n", "\r\n", "\r", "(", ")", "[", "]", "#", "#<a>", "=", "+", "-", "*", "/", "%", ":",
            ";", "/*", "*/", "$", "$$", "$$->", "\"", "'", ",", ".", "1", "2.", "R1", "IF", "GOTO", "DEF", "CYCLE800", "AND",
            "SIN", "DC", "GOTO/", "PARTNO", "N10", "o<x>", "X", "<", ">", "\t", "\u{feff}", "ä", "EX", "@", "_A", "DO", "!",
            "~\n", "~", "BEGIN PGM", "L ", "CYCL DEF 200", "Q1", "QS2", "FN 0:", "X+1,5", "* -", "LBL ", "||", "\n$ Y1", "$A.MIN%", "NLAP1 ",
        ]).prop_map(|text| text.as_bytes().to_vec()),
        1 => proptest::collection::vec(any::<u8>(), 1..3),
    ];
    proptest::collection::vec(piece, 0..40).prop_map(|pieces| pieces.concat())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn random_pieces(source in pieces()) {
        check_all(&source);
    }

    #[test]
    fn random_bytes(source in proptest::collection::vec(any::<u8>(), 0..200)) {
        check_all(&source);
    }
}

#[test]
fn deep_nesting_and_long_lines_take_linear_time_and_no_stack() {
    for piece in [
        "[",
        "(",
        "#",
        "#<",
        "X[",
        "AB1",
        "-",
        "GOTO1",
        "/*",
        ")",
        "%",
        "X ",
        "'",
        "$",
        "GOTO/(",
        "1,",
        "o<",
        "IF1",
        "\"A\"",
        "~ ",
        "()",
        "/**/",
        "\u{2018}",
        "\u{2018}A\u{2019}",
        "\u{c}\u{b}\u{85}",
    ] {
        let source = piece.repeat(60_000 / piece.len());
        check_all(source.as_bytes());
    }
}

#[test]
fn tokens_keep_their_kind_whatever_follows() {
    use TokenKind::{Blank, Comment, Word};
    let program = parse(b"G1X-.5 Y 2 (c) ;d".to_vec(), CORE);
    let kinds: Vec<_> = (0..program.tokens().len() as u32)
        .map(|id| program.tokens().kind(id))
        .collect();
    assert_eq!(kinds, [Word, Word, Blank, Word, Blank, Comment, Blank, Comment]);
}
