//! Every place where a program names something of its own: programs, labels, block numbers, variables.
mod apt;
mod klartext;
mod numbered;
mod osp;
mod sinumerik;
mod variables;

use crate::text::{codes, significant};
use trunnion_dialect::{Dialect, Language};
use trunnion_layout::Obstacle;
use trunnion_syntax::{Block, BlockId, Format, Item, Program, TextRange, TokenKind};

/// What is named.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Kind {
    /// A program or subprogram: O1000, `o<name> sub`, PROC.
    Program,
    /// A label, also the O-word of a loop.
    Label,
    /// A block by its number.
    Block,
    /// A variable.
    Variable,
}

/// What happens to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It is defined here.
    Definition,
    /// It gets a value.
    Write,
    /// It is read, called or jumped to.
    Read,
}

/// How far a name is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Scope {
    /// In one program of the file, by its number from 0.
    Part(u32),
    /// In all programs: other files of the folder may use it.
    Shared,
}

/// One place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Occurrence {
    /// Bytes of the name alone, without its marks: `100` of `#100`, `N100`, `O100`.
    pub range: TextRange,
    /// What is named.
    pub kind: Kind,
    /// What happens here.
    pub role: Role,
    /// The name as it is compared.
    pub name: Box<str>,
    /// Where it is known.
    pub scope: Scope,
}

impl Occurrence {
    /// Whether both name the same thing.
    pub fn same_as(&self, other: &Self) -> bool {
        self.kind == other.kind && self.scope == other.scope && self.name == other.name
    }
}

/// All places of a program, sorted.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// The places.
    pub all: Vec<Occurrence>,
    /// Places that may name anything, because the name is computed: nothing of this kind can be renamed.
    pub obstacles: Vec<(Kind, Obstacle)>,
    /// Where another program of the file begins or goes on: the first block, and the number of the program.
    pub parts: Vec<(BlockId, u32)>,
    /// The number of the last program that began.
    last_part: u32,
}

impl Names {
    /// The name at a byte; a cursor behind it touches it too.
    pub fn at(&self, offset: u32) -> Option<&Occurrence> {
        let until = self.all.partition_point(|one| one.range.start <= offset);
        self.all[..until]
            .iter()
            .rev()
            .take(4)
            .find(|one| one.range.touches(offset))
    }

    /// Every place that names the same thing.
    pub fn same<'n>(&'n self, wanted: &'n Occurrence) -> impl Iterator<Item = &'n Occurrence> {
        self.all.iter().filter(|one| one.same_as(wanted))
    }

    /// Where the thing is defined: its definitions, or the first place that gives it a value.
    pub fn definitions<'n>(&'n self, wanted: &'n Occurrence) -> Vec<&'n Occurrence> {
        let defined: Vec<_> = self.same(wanted).filter(|one| one.role == Role::Definition).collect();
        if !defined.is_empty() {
            return defined;
        }
        self.same(wanted)
            .find(|one| one.role == Role::Write)
            .into_iter()
            .collect()
    }

    /// The number of the program that a block belongs to.
    pub(crate) fn part_of(&self, block: BlockId) -> u32 {
        let until = self.parts.partition_point(|(first, _)| *first <= block);
        self.parts[..until].last().map_or(0, |(_, part)| *part)
    }

    /// A further program begins.
    fn begin(&mut self, block: BlockId) {
        self.last_part += 1;
        self.parts.push((block, self.last_part));
    }

    pub(crate) fn add(&mut self, range: TextRange, kind: Kind, role: Role, name: &str, scope: Scope) {
        self.all.push(Occurrence {
            range,
            kind,
            role,
            name: name.into(),
            scope,
        });
    }

    fn blocked(&mut self, kind: Kind, range: TextRange, why: String) {
        self.obstacles.push((kind, Obstacle { range, why }));
    }
}

/// Reads all names of a program.
pub fn names(program: &Program, dialect: &Dialect) -> Names {
    let mut found = Names::default();
    match program.options().format {
        Format::Apt => apt::read(program, &mut found),
        Format::Klartext => klartext::read(program, &mut found),
        Format::Osp => osp::read(program, dialect, &mut found),
        Format::Iso => {
            match dialect.quirks.language {
                Language::Sinumerik => sinumerik::read(program, dialect, &mut found),
                Language::Linuxcnc => o_words(program, &mut found),
                _ => programs(program, dialect, &mut found),
            }
            numbered::read(program, dialect, &mut found);
            variables::read(program, dialect, &mut found);
        }
    }
    let place = |one: &Occurrence| (one.range.start, one.range.end);
    // sorting needs half as much room again, and a program may have a name in each word
    if !found.all.is_sorted_by_key(place) {
        found.all.sort_by_key(place);
    }
    found.all.dedup_by(|one, other| one.range == other.range);
    found.all.shrink_to_fit();
    found
}

/// `O1000` and `:1000` that begin a program.
fn programs(program: &Program, dialect: &Dialect, found: &mut Names) {
    for block in program.blocks() {
        if !begins_with(&block, b"oO:%") {
            continue;
        }
        let mut items = block.items().filter(|item| !matches!(item, Item::Comment(_)));
        let range = match items.next() {
            Some(Item::Word(word)) if word.address == trunnion_syntax::Address::Letter(b'O') => word.value_range,
            Some(Item::Label(range)) => TextRange::new(range.start + 1, range.end),
            _ => continue,
        };
        let text = program.text(range);
        let Some(name) = number_of(&text) else { continue };
        if found.all.iter().any(|one| one.kind == Kind::Program)
            || block.id().0 > 0 && runs_before(program, dialect, &block)
        {
            found.begin(block.id());
        }
        found.add(range, Kind::Program, Role::Definition, &name, Scope::Shared);
    }
}

/// Whether a block before this one has a code: then it belongs to another program.
fn runs_before(program: &Program, dialect: &Dialect, block: &Block<'_>) -> bool {
    (0..block.id().0).any(|id| !codes(dialect, &program.block(BlockId(id))).is_empty())
}

/// A whole number as names compare it: without leading zeros.
pub(crate) fn number_of(text: &str) -> Option<String> {
    let text = text.trim();
    let digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    digits.then(|| match text.trim_start_matches('0') {
        "" => "0".to_owned(),
        rest => rest.to_owned(),
    })
}

/// Whether the first byte of a block that is not blank is one of these.
pub(crate) fn begins_with(block: &Block<'_>, wanted: &[u8]) -> bool {
    let bytes = block.program().bytes(block.range());
    bytes
        .iter()
        .find(|byte| !byte.is_ascii_whitespace())
        .is_some_and(|byte| wanted.contains(byte))
}

/// The O-words of RS274/NGC: `o100 sub`, `o<name> call`.
fn o_words(program: &Program, found: &mut Names) {
    let mut lines = Vec::new();
    for block in program.blocks() {
        if begins_with(&block, b"oO")
            && let Some((range, name, keyword)) = o_word(&block)
        {
            lines.push((block.id(), range, name, keyword));
        }
    }
    let of_program = |keyword: &str| matches!(keyword, "sub" | "endsub" | "call" | "return");
    let programs: std::collections::BTreeSet<String> = lines
        .iter()
        .filter(|(_, _, _, keyword)| of_program(keyword))
        .map(|(_, _, name, _)| name.clone())
        .collect();
    let mut seen = std::collections::BTreeSet::new();
    for (block, range, name, keyword) in lines {
        match keyword.as_str() {
            "sub" => found.begin(block),
            "endsub" => found.parts.push((BlockId(block.0 + 1), 0)),
            _ => {}
        }
        let kind = if programs.contains(&name) {
            Kind::Program
        } else {
            Kind::Label
        };
        let part = found.part_of(block);
        let first = seen.insert((name.clone(), part));
        let role = match kind {
            Kind::Program if keyword == "sub" => Role::Definition,
            Kind::Label if first => Role::Definition,
            _ => Role::Read,
        };
        let scope = if kind == Kind::Program {
            Scope::Shared
        } else {
            Scope::Part(part)
        };
        found.add(range, kind, role, &name, scope);
    }
}

/// The O-word of a block: bytes of its number or name, the name as it is compared, the keyword after it in lower case.
pub(crate) fn o_word(block: &Block<'_>) -> Option<(TextRange, String, String)> {
    let program = block.program();
    let (tokens, end) = (program.tokens(), block.tokens().end);
    let first = significant(program, block.tokens().start, end)?;
    let range = tokens.range(first);
    let (inner, after) = match tokens.kind(first) {
        TokenKind::Word => (TextRange::new(range.start + 1, range.end), first + 1),
        TokenKind::Letter => {
            let next = significant(program, first + 1, end)?;
            let name = tokens.range(next);
            if tokens.kind(next) != TokenKind::Less {
                return None;
            }
            (TextRange::new(name.start + 1, name.end.saturating_sub(1)), next + 1)
        }
        _ => return None,
    };
    let text: String = program
        .text(inner)
        .split_whitespace()
        .collect::<String>()
        .to_ascii_lowercase();
    let keyword = significant(program, after, end)?;
    if tokens.kind(keyword) != TokenKind::Name {
        return None;
    }
    let name = number_of(&text).unwrap_or(text);
    Some((inner, name, program.text(tokens.range(keyword)).to_ascii_lowercase()))
}
