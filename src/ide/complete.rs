//! Completion by dialect and context: codes, names, words of the code in the block, labels, programs and variables.
use crate::names::{Kind, Names};
use crate::signature::meaning;
use crate::text::{codes, in_name};
use std::collections::BTreeSet;
use trunnion_dialect::{CodeKind, Dialect, Language};
use trunnion_syntax::{Format, Program, TextRange};

/// What an entry is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompletionKind {
    /// A G or M code.
    Code,
    /// A word of the control: TRAORI, WHILE.
    Name,
    /// The letter of a word.
    Address,
    /// A variable of the program.
    Variable,
    /// A label or block number.
    Label,
    /// A program.
    Program,
}

/// One entry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// What people read and what is inserted.
    pub label: String,
    /// What it is.
    pub kind: CompletionKind,
    /// One line.
    pub detail: String,
    /// Markdown.
    pub docs: String,
    /// The text that it takes the place of.
    pub replace: TextRange,
}

/// The entries at a byte; `programs`: names of programs in the folder.
pub fn completions(
    program: &Program,
    dialect: &Dialect,
    names: &Names,
    programs: &[String],
    offset: u32,
) -> Vec<Completion> {
    let source = program.source();
    let offset = (offset as usize).min(source.len());
    let line = source[..offset]
        .iter()
        .rposition(|byte| matches!(byte, b'\n' | b'\r'))
        .map_or(0, |at| at + 1);
    let before = &source[line..offset];
    if inside_comment(program, offset as u32) {
        return Vec::new();
    }
    let piece = |length: usize| TextRange::new((offset - length) as u32, offset as u32);
    let typed = before
        .iter()
        .rev()
        .take_while(|byte| in_name(**byte) || **byte == b'.')
        .count();
    let text = String::from_utf8_lossy(&before[before.len() - typed..]).to_ascii_uppercase();
    let sharp = before[..before.len() - typed].last().copied();
    if sharp == Some(b'#') || sharp == Some(b'<') && before[..before.len() - typed].ends_with(b"#<") {
        let named = sharp == Some(b'<');
        return variables(names, piece(typed), |name| {
            name.bytes().all(|byte| byte.is_ascii_digit()) != named
        });
    }
    let heads = String::from_utf8_lossy(&before[..before.len() - typed]).to_ascii_uppercase();
    let heads = heads.trim_end();
    if ["GOTO", "GOTOF", "GOTOB", "GOTOC", "REPEAT", "REPEATB", "JUMPTO/"]
        .iter()
        .any(|jump| heads.ends_with(jump))
    {
        return labels(names, piece(typed));
    }
    let calls = ["M98", "M98 ", "G65", "M198"]
        .iter()
        .any(|call| heads.contains(call.trim()));
    if calls && text.starts_with('P') {
        return own_programs(names, programs, piece(typed - 1), |name| {
            name.bytes().all(|byte| byte.is_ascii_digit())
        });
    }
    words(program, dialect, (names, programs), line as u32, (piece(typed), text))
}

/// Codes, names of the control and of the program, and the words that the codes of the block read.
fn words(
    program: &Program,
    dialect: &Dialect,
    (names, programs): (&Names, &[String]),
    line: u32,
    (typed_range, text): (TextRange, String),
) -> Vec<Completion> {
    let typed = text.len();
    let piece = |length: usize| TextRange::new(typed_range.end - length as u32, typed_range.end);
    let mut list = Vec::new();
    let letters = text.bytes().take_while(u8::is_ascii_alphabetic).count();
    // `G1X5`: what follows a number is a word of its own
    let tail = text.len()
        - text
            .rfind(|c: char| c.is_ascii_digit() || c == '.')
            .map_or(0, |at| at + 1);
    let (typed, text) = if letters < text.len() && tail > 0 {
        (tail, text[text.len() - tail..].to_owned())
    } else {
        (typed, text)
    };
    let starts = |id: &str| id.to_ascii_uppercase().starts_with(&text);
    for code in dialect.codes() {
        let wanted = match code.kind {
            CodeKind::G | CodeKind::M => !text.is_empty() || typed == 0,
            CodeKind::Name => true,
        };
        if wanted && starts(&code.id) && !code.id.contains("..") {
            list.push(Completion {
                label: code.id.clone(),
                kind: if code.kind == CodeKind::Name {
                    CompletionKind::Name
                } else {
                    CompletionKind::Code
                },
                detail: code.doc.clone(),
                docs: code.hover(),
                replace: piece(typed),
            });
        }
    }
    list.extend(read_words(program, dialect, line, piece(typed), &starts));
    if dialect.quirks.language == Language::Sinumerik || program.options().format == Format::Apt {
        // what is being typed is no name yet
        let starts = |name: &str| starts(name) && !name.eq_ignore_ascii_case(&text);
        list.extend(variables(names, piece(typed), starts));
        list.extend(own_programs(names, programs, piece(typed), |name| {
            starts(name) && name.starts_with(|c: char| c.is_ascii_alphabetic())
        }));
    }
    list
}

/// Whether the cursor is in a comment or a quoted text.
fn inside_comment(program: &Program, offset: u32) -> bool {
    let Some(block) = program.block_at(offset) else {
        return false;
    };
    program.block(block).comments().any(|comment| {
        let open = program.source().get(comment.range.end as usize - 1) != Some(&b')');
        comment.range.start < offset && (offset < comment.range.end || open && offset == comment.range.end)
    })
}

fn variables(names: &Names, replace: TextRange, wanted: impl Fn(&str) -> bool) -> Vec<Completion> {
    let known: BTreeSet<&str> = names
        .all
        .iter()
        .filter(|one| one.kind == Kind::Variable)
        .map(|one| &*one.name)
        .collect();
    let counted = |name: &str| {
        names
            .all
            .iter()
            .filter(|one| one.kind == Kind::Variable && &*one.name == name)
            .count()
    };
    known
        .into_iter()
        .filter(|name| wanted(name))
        .map(|name| Completion {
            label: name.to_owned(),
            kind: CompletionKind::Variable,
            detail: format!("variable, {} places in this file", counted(name)),
            docs: String::new(),
            replace,
        })
        .collect()
}

fn labels(names: &Names, replace: TextRange) -> Vec<Completion> {
    let known: BTreeSet<&str> = names
        .all
        .iter()
        .filter(|one| matches!(one.kind, Kind::Label | Kind::Block))
        .map(|one| &*one.name)
        .collect();
    let one = |name: &str| Completion {
        label: name.to_owned(),
        kind: CompletionKind::Label,
        detail: "label of this file".to_owned(),
        docs: String::new(),
        replace,
    };
    known.into_iter().map(one).collect()
}

fn own_programs(
    names: &Names,
    programs: &[String],
    replace: TextRange,
    wanted: impl Fn(&str) -> bool,
) -> Vec<Completion> {
    let mut known: BTreeSet<String> = programs.iter().cloned().collect();
    known.extend(
        names
            .all
            .iter()
            .filter(|one| one.kind == Kind::Program)
            .map(|one| one.name.to_string()),
    );
    let one = |name: String| Completion {
        label: name,
        kind: CompletionKind::Program,
        detail: "program".to_owned(),
        docs: String::new(),
        replace,
    };
    known.into_iter().filter(|name| wanted(name)).map(one).collect()
}

/// The words that the codes of a block read.
fn read_words(
    program: &Program,
    dialect: &Dialect,
    line: u32,
    replace: TextRange,
    starts: &dyn Fn(&str) -> bool,
) -> Vec<Completion> {
    let mut list = Vec::new();
    if let Some(block) = program.block_at(line).filter(|_| program.options().format.has_words()) {
        let mut offered = BTreeSet::new();
        for (code, _) in codes(dialect, &program.block(block)) {
            for word in code.words.iter().filter(|word| starts(word)) {
                if offered.insert(word.clone()) {
                    list.push(Completion {
                        label: word.clone(),
                        kind: CompletionKind::Address,
                        detail: format!("{} of {}", meaning(dialect, word), code.id),
                        docs: code.hover(),
                        replace,
                    });
                }
            }
        }
    }
    list
}
