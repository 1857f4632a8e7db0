//! A dialect: look-ups over a loaded table.
use crate::{Action, Role};
use trunnion_syntax::LexOptions;

/// Whether a code is a G code, an M code or a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CodeKind {
    /// G with a number.
    G,
    /// M with a number.
    M,
    /// A name such as TRAORI or CYCLE800.
    Name,
}

/// One code of a dialect.
#[derive(Clone, Debug)]
pub struct Code {
    /// As people write it: `G43.4`, `M6`, `TRAORI`.
    pub id: String,
    /// G, M or name.
    pub kind: CodeKind,
    /// Modal group's name; two codes of one group in a block contradict each other. `None`: belongs to no group.
    pub group: Option<String>,
    /// Addresses the code reads beside the axes.
    pub words: Vec<String>,
    /// What it does.
    pub action: Action,
    /// One line for people.
    pub doc: String,
    /// Where that is written down.
    pub source: String,
}

/// A loaded dialect.
#[derive(Clone, Debug)]
pub struct Dialect {
    /// Its name: `sinumerik-840d`.
    pub name: String,
    /// Title for people.
    pub title: String,
    /// How its text is cut into tokens.
    pub lex: LexOptions,
    /// An arc's end radius may differ from its start radius by this much, mm (with its source in the table).
    pub arc_tolerance_mm: f64,
    /// Feed mode at the start of a program.
    pub extensions: Vec<String>,
    pub(crate) codes: Vec<Code>,
    /// Index into `codes` plus one by number x 10 for G 0..=999.9; 0 = unknown.
    pub(crate) g: Vec<u16>,
    /// The same for M.
    pub(crate) m: Vec<u16>,
    pub(crate) roles: [Option<Role>; 26],
}

impl Dialect {
    /// The code `G` number / 10 (G43.4 is 434), O(1).
    pub fn g(&self, tenths: u32) -> Option<&Code> {
        let i = *self.g.get(tenths as usize)?;
        (i != 0).then(|| &self.codes[usize::from(i) - 1])
    }
    /// The code `M` number / 10, O(1).
    pub fn m(&self, tenths: u32) -> Option<&Code> {
        let i = *self.m.get(tenths as usize)?;
        (i != 0).then(|| &self.codes[usize::from(i) - 1])
    }
    /// A name such as TRAORI, ASCII case ignored.
    pub fn name(&self, name: &str) -> Option<&Code> {
        self.codes.iter().find(|code| code.kind == CodeKind::Name && code.id.eq_ignore_ascii_case(name))
    }
    /// What a letter (upper case) means.
    pub fn role(&self, letter: u8) -> Option<Role> {
        *self.roles.get(usize::from(letter.wrapping_sub(b'A')))?
    }
    /// All codes.
    pub fn codes(&self) -> &[Code] {
        &self.codes
    }
}
