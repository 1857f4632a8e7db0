//! Names of a Sinumerik program: PROC, labels, DEF variables, R parameters, calls by name.
use super::{Kind, Names, Role, Scope, number_of};
use crate::text::{in_name, significant};
use std::collections::{BTreeMap, BTreeSet};
use trunnion_dialect::{Dialect, Role as LetterRole};
use trunnion_syntax::{Address, Block, Item, Program, TextRange, TokenKind, Value};

/// Statements whose arguments name a label.
const JUMPS: [&str; 7] = ["GOTO", "GOTOF", "GOTOB", "GOTOC", "REPEAT", "REPEATB", "CALL"];

pub(super) fn read(program: &Program, dialect: &Dialect, found: &mut Names) {
    parts(program, found);
    let mut labels = BTreeSet::new();
    let mut variables: BTreeMap<(u32, String), Vec<TextRange>> = BTreeMap::new();
    for block in program.blocks() {
        let part = found.part_of(block.id());
        for item in block.items() {
            match item {
                Item::Label(range) => {
                    let range = TextRange::new(range.start, range.end - 1);
                    labels.insert((part, program.text(range).trim().to_ascii_uppercase()));
                }
                Item::Call(call) if program.text(call.name).eq_ignore_ascii_case("DEF") => {
                    for range in declared(program, call.range) {
                        let name = program.text(range).to_ascii_uppercase();
                        variables.entry((part, name)).or_default().push(range);
                    }
                }
                _ => {}
            }
        }
    }
    for block in program.blocks() {
        let part = found.part_of(block.id());
        let mut first = true;
        for item in block.items() {
            match item {
                Item::Label(range) => {
                    let inner = TextRange::new(range.start, range.end - 1);
                    let name = program.text(inner).trim().to_ascii_uppercase();
                    found.add(inner, Kind::Label, Role::Definition, &name, Scope::Part(part));
                }
                Item::Word(word) => parameter(program, dialect, &word, found),
                Item::Call(call) => {
                    let name = program.text(call.name).to_ascii_uppercase();
                    if name == "PROC" {
                        proc(program, call.range, found);
                    } else if first && dialect.name(&name).is_none() && !variables.contains_key(&(part, name.clone())) {
                        found.add(call.name, Kind::Program, Role::Read, &name, Scope::Shared);
                    }
                    if matches!(name.as_str(), "GOTOF" | "GOTOB" | "GOTOC" | "GOTO" | "GOTOS") {
                        let text = call.arguments.map(|range| program.text(range)).unwrap_or_default();
                        if text.contains(['"', '$', '<', '[', '(']) {
                            let why = format!("the target of `{}` is computed", program.text(call.range));
                            found.blocked(Kind::Label, call.range, why);
                        }
                    }
                }
                _ => {}
            }
            first &= matches!(item, Item::Skip(..) | Item::Label(_) | Item::Comment(_))
                || matches!(item, Item::Word(word) if word.address == Address::Letter(b'N'));
        }
        if has_names(&block) {
            identifiers(program, dialect, &block, part, &labels, &variables, found);
        }
    }
}

/// `%_N_NAME_MPF` and PROC after other blocks begin a further program.
fn parts(program: &Program, found: &mut Names) {
    let mut any = false;
    for block in program.blocks() {
        match block.items().find(|item| !matches!(item, Item::Comment(_))) {
            Some(Item::Percent(range)) if range.end - range.start > 1 => {
                if any {
                    found.begin(block.id());
                }
                let name = TextRange::new(range.start + 1, range.end);
                let text = program.text(name).trim().to_ascii_uppercase();
                let plain = text.strip_prefix("_N_").unwrap_or(&text);
                let plain = plain
                    .strip_suffix("_MPF")
                    .or_else(|| plain.strip_suffix("_SPF"))
                    .unwrap_or(plain);
                found.add(name, Kind::Program, Role::Definition, plain, Scope::Shared);
                any = true;
            }
            Some(_) => any = true,
            None => {}
        }
    }
}

/// The names that `DEF REAL A=2, B[3]` declares.
fn declared(program: &Program, range: TextRange) -> Vec<TextRange> {
    let bytes = program.bytes(range);
    let mut depth = 0;
    let mut names = Vec::new();
    // the name follows the type, and each comma outside of brackets
    let (mut at, mut words, mut wanted) = (0, 0, false);
    while at < bytes.len() {
        let byte = bytes[at];
        if in_name(byte) && !byte.is_ascii_digit() {
            let length = bytes[at..].iter().take_while(|byte| in_name(**byte)).count();
            words += 1;
            if depth == 0 && (wanted || words == 3) {
                names.push(TextRange::new(
                    range.start + at as u32,
                    range.start + (at + length) as u32,
                ));
                wanted = false;
            }
            at += length;
            continue;
        }
        match byte {
            b'(' | b'[' => depth += 1,
            b')' | b']' => depth -= 1,
            b',' if depth == 0 => wanted = true,
            _ => {}
        }
        at += 1;
    }
    names
}

/// `PROC NAME(REAL A)`.
fn proc(program: &Program, range: TextRange, found: &mut Names) {
    let bytes = program.bytes(range);
    let Some(from) = bytes
        .get(4..)
        .and_then(|rest| rest.iter().position(|byte| in_name(*byte)))
    else {
        return;
    };
    let start = 4 + from;
    let length = bytes[start..].iter().take_while(|byte| in_name(**byte)).count();
    let name = TextRange::new(range.start + start as u32, range.start + (start + length) as u32);
    let text = program.text(name).to_ascii_uppercase();
    found.add(name, Kind::Program, Role::Definition, &text, Scope::Shared);
}

/// `R5=`, and a word whose letter is that of a variable.
fn parameter(program: &Program, dialect: &Dialect, word: &trunnion_syntax::Word, found: &mut Names) {
    if let Address::Indexed(letter, number) = word.address
        && dialect.role(letter) == Some(LetterRole::Variable)
    {
        let digits = program.bytes(word.range)[1..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit())
            .count() as u32;
        let range = TextRange::new(word.range.start + 1, word.range.start + 1 + digits);
        found.add(range, Kind::Variable, Role::Write, &format!("R{number}"), Scope::Shared);
    } else if let (Address::Letter(letter), Value::Number(_)) = (word.address, word.value)
        && dialect.role(letter) == Some(LetterRole::Variable)
        && let Some(number) = number_of(&program.text(word.value_range))
    {
        found.add(
            word.value_range,
            Kind::Variable,
            Role::Read,
            &format!("R{number}"),
            Scope::Shared,
        );
    }
}

/// Whether a block may have names besides plain words.
fn has_names(block: &Block<'_>) -> bool {
    let tokens = block.program().tokens();
    block.tokens().any(|id| {
        !matches!(
            tokens.kind(id),
            TokenKind::Word | TokenKind::Blank | TokenKind::Newline | TokenKind::Comment
        )
    })
}

/// Declared variables, labels in jumps, and R parameters inside expressions, by their text outside of comments and quotes.
fn identifiers(
    program: &Program,
    dialect: &Dialect,
    block: &Block<'_>,
    part: u32,
    labels: &BTreeSet<(u32, String)>,
    variables: &BTreeMap<(u32, String), Vec<TextRange>>,
    found: &mut Names,
) {
    let (tokens, ids) = (program.tokens(), block.tokens());
    let mut jumps = false;
    let mut until = 0;
    for id in ids.clone() {
        let range = tokens.range(id);
        let hidden = matches!(
            tokens.kind(id),
            TokenKind::Comment | TokenKind::UnclosedComment | TokenKind::Text
        );
        let first = program.bytes(range).first().copied().unwrap_or(b' ');
        if hidden || range.start < until || !in_name(first) || first.is_ascii_digit() {
            continue;
        }
        let source = program.source();
        let length = source[range.start as usize..]
            .iter()
            .take_while(|byte| in_name(**byte))
            .count() as u32;
        let whole = TextRange::new(range.start, range.start + length);
        let text = program.text(whole).to_ascii_uppercase();
        let letter = text.as_bytes()[0];
        if dialect.role(letter) == Some(LetterRole::Variable)
            && let Some(number) = number_of(&text[1..])
        {
            let digits = TextRange::new(whole.start + 1, whole.end);
            let assigned =
                significant(program, id + 1, ids.end).is_some_and(|next| tokens.kind(next) == TokenKind::Equals);
            let role = if assigned { Role::Write } else { Role::Read };
            found.add(
                digits,
                Kind::Variable,
                role,
                &format!("{}{number}", letter as char),
                Scope::Shared,
            );
            until = whole.end;
            continue;
        }
        if JUMPS.contains(&text.as_str()) {
            jumps = true;
        } else if let Some(definitions) = variables.get(&(part, text.clone())) {
            let next = (id + 1..ids.end).find(|&next| tokens.range(next).start >= whole.end);
            let next = next.and_then(|next| significant(program, next, ids.end));
            // they are in the order of the text
            let role = if definitions.binary_search(&whole).is_ok() {
                Role::Definition
            } else if next.is_some_and(|next| tokens.kind(next) == TokenKind::Equals) {
                Role::Write
            } else {
                Role::Read
            };
            found.add(whole, Kind::Variable, role, &text, Scope::Part(part));
            until = whole.end;
        } else if jumps && labels.contains(&(part, text.clone())) {
            found.add(whole, Kind::Label, Role::Read, &text, Scope::Part(part));
            until = whole.end;
        }
    }
}
