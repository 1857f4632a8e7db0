//! Names of Okuma programs: programs (`OPART`), sequence names (`NLOOP`), variables (`V1`, `VC5`, and the names that the program writes). Names are
//! compared as text: N0123 is not N123.
use super::{Kind, Names, Role, Scope};
use std::collections::BTreeSet;
use trunnion_dialect::Dialect;
use trunnion_syntax::{Program, TextRange};

/// A word of letters and digits: where it lies, and whether `=` follows.
struct Word {
    range: TextRange,
    name: String,
    assigned: bool,
}

pub(super) fn read(program: &Program, dialect: &Dialect, found: &mut Names) {
    let blocks: Vec<(u32, Vec<Word>)> = program
        .blocks()
        .map(|block| (block.id().0, words(program, block.range())))
        .collect();
    let calls = |words: &[Word]| words.iter().any(|word| matches!(word.name.as_str(), "CALL" | "MODIN"));
    let is_own = |word: &Word| {
        word.name.len() > 1
            && word.name[1..]
                .bytes()
                .next()
                .is_some_and(|byte| byte.is_ascii_alphabetic())
            && dialect.named_role(word.name.as_bytes()).is_none()
    };
    let of = |with_calls: bool| -> BTreeSet<&str> {
        let some = blocks.iter().filter(|(_, words)| !with_calls || calls(words));
        let all = some.flat_map(|(_, words)| words);
        all.filter(|word| word.assigned && is_own(word))
            .map(|word| word.name.as_str())
            .collect()
    };
    let (written, handed) = (of(false), of(true));
    for (id, words) in &blocks {
        let mut rest = words.as_slice();
        if let Some(head) = rest.first().filter(|word| is_name(word) && begins(program, word)) {
            let kind = if head.name.starts_with('O') {
                Kind::Program
            } else {
                Kind::Label
            };
            if kind == Kind::Program && found.all.iter().any(|one| one.kind == Kind::Program) {
                found.begin(trunnion_syntax::BlockId(*id));
            }
            add(found, *id, head, kind, Role::Definition);
            rest = &rest[1..];
        }
        let call = calls(rest);
        let jump = rest.iter().any(|word| matches!(word.name.as_str(), "GOTO" | "IF"));
        for word in rest {
            if call && word.name.starts_with('O') && is_name(word) && !word.assigned {
                add(found, *id, word, Kind::Program, Role::Read);
            } else if jump && word.name.starts_with('N') && is_name(word) && word.name != "NE" {
                add(found, *id, word, Kind::Label, Role::Read);
            } else if numbered(&word.name) || written.contains(word.name.as_str()) {
                let role = if word.assigned { Role::Write } else { Role::Read };
                let part = Scope::Part(found.part_of(trunnion_syntax::BlockId(*id)));
                let shared = numbered(&word.name) || handed.contains(word.name.as_str());
                let scope = if shared { Scope::Shared } else { part };
                found.add(word.range, Kind::Variable, role, &word.name, scope);
            }
        }
    }
    // a sequence name that nothing refers to is a number of its block
    let asked: BTreeSet<(Box<str>, Scope)> = (found
        .all
        .iter()
        .filter(|one| one.kind == Kind::Label && one.role == Role::Read))
    .map(|one| (one.name.clone(), one.scope))
    .collect();
    let digits = |name: &str| name.bytes().all(|byte| byte.is_ascii_digit());
    found
        .all
        .retain(|one| one.kind != Kind::Label || !digits(&one.name) || asked.contains(&(one.name.clone(), one.scope)));
}

/// Without its letter.
fn add(found: &mut Names, block: u32, word: &Word, kind: Kind, role: Role) {
    let range = TextRange::new(word.range.start + 1, word.range.end);
    let scope = match kind {
        Kind::Program => Scope::Shared,
        _ => Scope::Part(found.part_of(trunnion_syntax::BlockId(block))),
    };
    found.add(range, kind, role, &word.name[1..], scope);
}

/// `V1`, `VC12`.
fn numbered(name: &str) -> bool {
    let digits = name
        .strip_prefix("VC")
        .or_else(|| name.strip_prefix('V'))
        .unwrap_or_default();
    !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
}

/// A name behind N or O: at most four letters and digits, or a number.
fn is_name(word: &Word) -> bool {
    let rest = &word.name[1..];
    matches!(word.name.as_bytes()[0], b'N' | b'O')
        && !rest.is_empty()
        && (rest.len() <= 4 || rest.bytes().all(|byte| byte.is_ascii_digit()))
        && !matches!(word.name.as_str(), "NE" | "OR" | "NOT" | "NCYL" | "NOEX" | "OMIT")
}

/// Whether a word is the first of its line.
fn begins(program: &Program, word: &Word) -> bool {
    let before = program.bytes(TextRange::new(0, word.range.start));
    let line = before.rsplit(|byte| *byte == b'\n').next().unwrap_or_default();
    line.iter().all(|byte| byte.is_ascii_whitespace() || *byte == b'/')
}

/// The words of a block, without its comments.
fn words(program: &Program, range: TextRange) -> Vec<Word> {
    let text = program.bytes(range);
    let (mut found, mut at) = (Vec::new(), 0);
    while at < text.len() {
        match text[at] {
            b'(' => {
                let end = text[at..].iter().position(|byte| matches!(byte, b')' | b'\n'));
                at += end.unwrap_or(text.len() - at) + 1;
            }
            byte if byte.is_ascii_alphabetic() => {
                let length = text[at..]
                    .iter()
                    .take_while(|byte| byte.is_ascii_alphanumeric())
                    .count();
                let range = TextRange::new(range.start + at as u32, range.start + (at + length) as u32);
                at += length;
                found.push(Word {
                    range,
                    name: program.text(range).to_ascii_uppercase(),
                    assigned: text[at..].trim_ascii_start().first() == Some(&b'='),
                });
            }
            byte if byte.is_ascii_digit() || byte == b'#' => {
                at += 1 + text[at + 1..]
                    .iter()
                    .take_while(|byte| byte.is_ascii_digit() || **byte == b'.')
                    .count();
            }
            _ => at += 1,
        }
    }
    found
}
