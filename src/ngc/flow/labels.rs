//! The names of O words and what is known about them: where a structure or a subprogram begins.
//!
//! As on the control, a label is known from the moment its opening line runs, for the rest of the program. Labels of structures
//! belong to the subprogram that runs (`o1 if` in two subprograms are two labels); names of subprograms belong to the whole run.
use crate::FileId;
use foldhash::HashMap;
use std::sync::Arc;
use trunnion_formula::Name;

/// A name in the table, `NameId::MAIN` for "no subprogram".
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct NameId(u32);

impl NameId {
    pub(crate) const MAIN: Self = Self(0);
}

/// A structure's label inside one subprogram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct LabelId(u32);

/// Where a line is, and the offset of its first byte. File and line are one number: written in one store, it can be read back at
/// once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Place {
    file_and_line: u64,
    pub(crate) offset: u32,
}

impl Place {
    /// A line (from 0) of a file, whose first byte is at `offset`.
    #[inline]
    pub(crate) fn new(file: FileId, line: u32, offset: u32) -> Self {
        Self {
            file_and_line: u64::from(file.0) << 32 | u64::from(line),
            offset,
        }
    }
    /// The line this many lines later in the same file, whose first byte is at `offset`.
    #[inline]
    pub(crate) fn further(self, lines: u32, offset: u32) -> Self {
        Self {
            // a file has fewer lines than bytes
            file_and_line: self.file_and_line + u64::from(lines),
            offset,
        }
    }
    #[inline]
    pub(crate) fn file(self) -> FileId {
        FileId((self.file_and_line >> 32) as u32)
    }
    /// From 0.
    #[inline]
    pub(crate) fn line(self) -> u32 {
        self.file_and_line as u32
    }
}

/// What opens a structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Opener {
    If,
    While,
    Do,
    Repeat,
}

impl Opener {
    /// As the control writes it.
    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::If => "if",
            Self::While => "while",
            Self::Do => "do",
            Self::Repeat => "repeat",
        }
    }
}

/// A structure whose opening line has run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Structure {
    pub(crate) opener: Opener,
    pub(crate) place: Place,
    /// Remaining rounds of a repeat, including this one; 0: it starts counting again when it is met again.
    pub(crate) rounds: i64,
    /// What was left of the bound on executed lines when it was entered from above; 0: it was not entered.
    pub(crate) fuel: u64,
    /// Its line was refused: what is inside runs once.
    pub(crate) once: bool,
}

/// How a subprogram was written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    /// `o1 sub` ... `o1 endsub`.
    Sub,
    /// `O1` ... `M99`.
    Fanuc,
}

/// A subprogram whose first line is known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Subprogram {
    pub(crate) style: Style,
    /// Its first line.
    pub(crate) place: Place,
    /// The line after it.
    pub(crate) body: Place,
}

/// Numbers below this have a place in a list.
const SMALL: u32 = 1 << 18;

#[derive(Clone, Debug, Default)]
struct Names {
    /// Of names that are whole numbers as the control writes them, which most are: the small ones in their place (0: none), the others.
    small: Vec<u32>,
    numbers: HashMap<u32, u32>,
    ids: HashMap<Name, u32>,
    texts: Vec<Name>,
    /// Of each name, the first subprogram in which it is a label, and the label; the others.
    first: Vec<Option<(u32, u32)>>,
    scoped: HashMap<(u32, u32), u32>,
}

/// All names and labels of a run. Cloning is cheap until the next new name.
#[derive(Clone, Debug)]
pub(crate) struct Labels {
    names: Arc<Names>,
    subprograms: Vec<Option<Subprogram>>,
    structures: Vec<Option<Structure>>,
    /// Grows whenever a structure or subprogram becomes known: earlier results may no longer hold.
    pub(crate) generation: u64,
}

impl Labels {
    pub(crate) fn new() -> Self {
        let mut labels = Self {
            names: Arc::default(),
            subprograms: Vec::new(),
            structures: Vec::new(),
            generation: 0,
        };
        labels.name(&Name::new(""));
        labels
    }
    /// The number of a name.
    pub(crate) fn name(&mut self, text: &Name) -> NameId {
        if let Some(number) = number(text.as_bytes()) {
            return self.numbered(number);
        }
        if let Some(&id) = self.names.ids.get(text) {
            return NameId(id);
        }
        let (names, id) = self.new_name(text.clone());
        names.ids.insert(text.clone(), id);
        NameId(id)
    }
    /// The number of a name that is a number of up to nine digits.
    #[inline]
    pub(crate) fn numbered(&mut self, number: u32) -> NameId {
        let known = if number < SMALL {
            self.names.small.get(number as usize).filter(|id| **id != 0)
        } else {
            self.names.numbers.get(&number)
        };
        match known {
            Some(&id) => NameId(id),
            None => self.new_number(number),
        }
    }
    fn new_number(&mut self, number: u32) -> NameId {
        let (names, id) = self.new_name(Name::number(number));
        if number < SMALL {
            let place = number as usize;
            if place >= names.small.len() {
                names.small.resize((place + 1).next_multiple_of(64), 0);
            }
            names.small[place] = id;
        } else {
            names.numbers.insert(number, id);
        }
        NameId(id)
    }
    fn new_name(&mut self, text: Name) -> (&mut Names, u32) {
        self.subprograms.push(None);
        let names = Arc::make_mut(&mut self.names);
        let id = names.texts.len() as u32;
        names.texts.push(text);
        names.first.push(None);
        (names, id)
    }
    /// A name as written, blanks removed, lower case.
    pub(crate) fn text(&self, name: NameId) -> &str {
        &self.names.texts[name.0 as usize]
    }
    /// Its bytes.
    #[inline]
    pub(crate) fn name_bytes(&self, name: NameId) -> &[u8] {
        self.names.texts[name.0 as usize].as_bytes()
    }
    /// The label of a structure inside a subprogram.
    pub(crate) fn label(&mut self, sub: NameId, name: NameId) -> LabelId {
        let key = (sub.0, name.0);
        let first = self.names.first[name.0 as usize];
        match first {
            Some((own, id)) if own == sub.0 => return LabelId(id),
            Some(_) => {
                if let Some(&id) = self.names.scoped.get(&key) {
                    return LabelId(id);
                }
            }
            None => {}
        }
        let id = self.structures.len() as u32;
        let names = Arc::make_mut(&mut self.names);
        if first.is_none() {
            names.first[name.0 as usize] = Some((sub.0, id));
        } else {
            names.scoped.insert(key, id);
        }
        self.structures.push(None);
        LabelId(id)
    }
    pub(crate) fn structure(&self, label: LabelId) -> Option<&Structure> {
        self.structures[label.0 as usize].as_ref()
    }
    pub(crate) fn structure_mut(&mut self, label: LabelId) -> Option<&mut Structure> {
        self.structures[label.0 as usize].as_mut()
    }
    pub(crate) fn open(&mut self, label: LabelId, structure: Structure) {
        self.structures[label.0 as usize] = Some(structure);
        self.generation += 1;
    }
    pub(crate) fn subprogram(&self, name: NameId) -> Option<Subprogram> {
        self.subprograms[name.0 as usize]
    }
    pub(crate) fn define(&mut self, name: NameId, subprogram: Subprogram) {
        self.subprograms[name.0 as usize] = Some(subprogram);
        self.generation += 1;
    }
    /// How many there are: a copy copies each.
    pub(crate) fn count(&self) -> usize {
        self.names.texts.len().max(self.structures.len())
    }
    /// All structures that are known.
    pub(crate) fn structures(&self) -> impl Iterator<Item = &Structure> {
        self.structures.iter().flatten()
    }
}

/// A whole number of up to nine digits that can be written in one form only: without leading zeros.
#[inline]
fn number(text: &[u8]) -> Option<u32> {
    if text.is_empty() || text.len() > 9 || (text[0] == b'0' && text.len() > 1) {
        return None;
    }
    text.iter().try_fold(0, |number, byte| {
        let digit = byte.wrapping_sub(b'0');
        (digit < 10).then(|| number * 10 + u32::from(digit))
    })
}
