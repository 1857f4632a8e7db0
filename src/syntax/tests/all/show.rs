//! Items and problems as short texts, so that a test is one line per form.
use trunnion_syntax::{Address, Format, Item, LexOptions, Program, Value, Word, parse};

/// All comment forms.
pub(crate) const CORE: LexOptions = LexOptions {
    format: Format::Iso,
    paren_comment: true,
    semicolon_comment: true,
    slash_star_comment: true,
    blanks_in_numbers: false,
};
/// Parentheses hold arguments, as on a Sinumerik.
pub(crate) const SINUMERIK: LexOptions = LexOptions {
    paren_comment: false,
    ..CORE
};
/// Blanks are allowed in numbers, as RS274/NGC says.
pub(crate) const NGC: LexOptions = LexOptions {
    blanks_in_numbers: true,
    ..CORE
};
/// No comments but `( )`.
pub(crate) const FANUC: LexOptions = LexOptions {
    semicolon_comment: false,
    slash_star_comment: false,
    ..CORE
};
/// Records.
pub(crate) const APT: LexOptions = LexOptions {
    format: Format::Apt,
    ..CORE
};

/// Logical blocks of a HEIDENHAIN.
pub(crate) const KLARTEXT: LexOptions = LexOptions {
    format: Format::Klartext,
    slash_star_comment: false,
    ..SINUMERIK
};
/// Words of an Okuma.
pub(crate) const OSP: LexOptions = LexOptions {
    format: Format::Osp,
    ..FANUC
};

/// Parses a text.
pub(crate) fn program(source: &str, options: LexOptions) -> Program {
    parse(source.as_bytes().to_vec(), options)
}

/// All items, separated by a blank; blocks by ` | `.
pub(crate) fn items(program: &Program) -> String {
    let block = |items: trunnion_syntax::Items<'_>| items.map(|item| show(program, item)).collect::<Vec<_>>().join(" ");
    program
        .blocks()
        .map(|each| block(each.items()))
        .collect::<Vec<_>>()
        .join(" | ")
}

/// All problems as `Kind[text]`.
pub(crate) fn errors(program: &Program) -> String {
    let all = program
        .errors()
        .iter()
        .map(|error| format!("{:?}[{}]", error.kind, program.text(error.range)));
    all.collect::<Vec<_>>().join(" ")
}

fn show(program: &Program, item: Item) -> String {
    let text = |range| program.text(range).into_owned();
    match item {
        Item::Word(word) => show_word(program, word),
        Item::Call(call) => match call.arguments {
            Some(arguments) => format!("call:{}({})", text(call.name), text(arguments)),
            None => format!("call:{}", text(call.name)),
        },
        Item::Comment(comment) => format!("comment[{}]", text(comment.inner)),
        Item::Skip(level, range) => format!("skip{level}[{}]", text(range)),
        Item::Percent(range) => format!("percent[{}]", text(range)),
        Item::Label(range) => format!("label[{}]", text(range)),
        Item::Other(range) => format!("other[{}]", text(range)),
    }
}

fn show_word(program: &Program, word: Word) -> String {
    let text = |range| program.text(range).into_owned();
    let address = match word.address {
        Address::Letter(letter) => char::from(letter).to_string(),
        Address::Indexed(letter, index) => format!("{}[{index}]", char::from(letter)),
        Address::Named(range) => format!("<{}>", text(range)),
    };
    let written = text(word.value_range);
    assert!(
        text(word.range).ends_with(&written),
        "the value {written} ends its word {}",
        text(word.range)
    );
    match word.value {
        Value::Number(number) => format!("{address}={number}"),
        Value::Call(name, number) => format!("{address}={}({number})", text(name)),
        Value::Text(range) => format!("{address}={}", text(range)),
        Value::Expression(range) => format!("{address}={{{}}}", text(range)),
        Value::Missing => format!("{address}=?"),
        Value::Bad => format!("{address}=!{written}"),
    }
}
