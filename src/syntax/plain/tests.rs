//! The fast path beside the lexer's own rules.
use crate::{LexOptions, SyntaxError, TokenKind, iso, parse};
use proptest::prelude::*;

const OPTIONS: [LexOptions; 2] = [
    LexOptions {
        format: crate::Format::Iso,
        paren_comment: true,
        semicolon_comment: true,
        slash_star_comment: true,
        blanks_in_numbers: true,
    },
    LexOptions {
        format: crate::Format::Iso,
        paren_comment: false,
        semicolon_comment: false,
        slash_star_comment: false,
        blanks_in_numbers: false,
    },
];

/// Tokens, blocks and problems of a text.
type Read = (Vec<(TokenKind, u32)>, Vec<u32>, Vec<SyntaxError>);

fn fast(text: &str, options: LexOptions) -> Read {
    let program = parse(text.into(), options);
    let table = program.tokens();
    let tokens = (0..table.len() as u32).map(|at| (table.kind(at), table.range(at).start));
    let blocks = program.blocks().map(|block| block.tokens().start);
    (tokens.collect(), blocks.collect(), program.errors().to_vec())
}

/// The same by the general rules alone, with every odd block read by the grammar.
fn general(text: &str, options: LexOptions) -> Read {
    let mut out = crate::builder::Builder::default();
    iso::lex_by_rules(text.as_bytes(), options, true, &mut out);
    let tokens = (0..out.table.len() as u32).map(|at| (out.table.kind(at), out.table.range(at).start));
    (tokens.collect(), out.blocks, out.errors)
}

fn same(text: &str) {
    for options in OPTIONS {
        assert_eq!(fast(text, options), general(text, options), "{text:?}");
    }
}

fn pieces() -> impl Strategy<Value = String> {
    let piece = proptest::sample::select(vec![
        "#<a>",
        "#1",
        "##2",
        "#[",
        "[",
        "]",
        "[1]",
        "[#1+2]",
        "=",
        "+",
        "-",
        "*",
        "**",
        "/",
        " ",
        "  ",
        "\t",
        "G1",
        "X",
        "Y-",
        "X1.5",
        "Z-.5",
        "1",
        "2.5",
        ".5",
        "123456789012345678901",
        "SIN",
        "ATAN[1]/[2]",
        "GT",
        "MOD",
        "AND",
        "o1",
        "O<s>",
        "o",
        "sub",
        "call",
        "if",
        "IF",
        "while",
        "endif",
        "DO",
        "END",
        "GOTO",
        "DEF",
        "EX",
        "AC",
        "XSIN",
        "(c)",
        "(",
        ")",
        ";d",
        "\n",
        "\n",
        "\r\n",
        "\r",
        ",",
        "<",
        ">",
        "%",
        "N10",
        ":",
        "\"t\"",
        "_A",
        "EXISTS[#<_x>]",
        "#1=",
        "#<b> = ",
        "/*",
        "*/",
    ]);
    proptest::collection::vec(piece, 0..14).prop_map(|pieces| pieces.concat())
}

/// Whether the fast path cuts all of a line and finds that nothing is wrong with it.
fn is_sound(line: &str) -> bool {
    let mut out = crate::builder::Builder::default();
    let end = super::lex(line.as_bytes(), 0, OPTIONS[0], &mut out);
    end == line.len() && out.course.end()
}

#[test]
fn what_macros_are_full_of_is_not_read_twice() {
    for line in [
        "N10 G1 X1.5 Y-2 (c)",
        "o100 sub (pocket 1)",
        "o<pocket> call [#1] [2] [3 + #<w>]",
        "#<h> = [ABS[SIN[#3]] ** 2 + SQRT[#<w> * #<w> + 1]]",
        "#1=2.5 #2=-#3 #[#1+2] = ##4",
        "#<a> = sin[30] ; step",
        "o101 if [#<w> GT 10 AND #<h> LT 1000]",
        "o101 endif",
        "G1 X#<w> Y[#<h> - 1.25] F[500 + #4] Z-[1] A-#1",
        "o102 while [[[[[[[[[[[[#1]]]]]]]]]]]]",
    ] {
        assert!(is_sound(line), "{line}");
    }
    for line in [
        "o101 if",
        "#1 = [2 + ]",
        "#1 = 2 + 3",
        "#1 =",
        "X[1",
        "X1]",
        "#<a>",
        "X[]",
        "G1 X12345678901234567890",
        "#1 = if[2]",
        "o1 if [1] [2]",
        "X[1] = 5",
    ] {
        assert!(!is_sound(line), "{line}");
    }
}

/// How many random texts: a number that the environment may raise.
fn cases() -> u32 {
    let given = std::env::var("TRUNNION_TEXTS").ok();
    given.and_then(|text| text.parse().ok()).unwrap_or(4000)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases()))]

    #[test]
    fn the_fast_way_cuts_as_the_rules_do(text in "[GXYoO#<>a-c_0-9. \\t\n\r\\[\\]=+*/(),;-]{0,40}") {
        same(&text);
    }

    #[test]
    fn long_texts_are_cut_as_the_rules_do(texts in proptest::collection::vec(pieces(), 30..90)) {
        same(&texts.concat());
    }

    #[test]
    fn the_fast_way_reads_macros_as_the_rules_do(text in pieces()) {
        same(&text);
    }
}
