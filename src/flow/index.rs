//! Targets of the jumps of a file: labels, programs in the file, loops. Built once, when the first jump needs it.
use crate::Loops;

/// What a label or program is called by.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Key {
    /// A sequence number, or the number of a program.
    Number(u32),
    /// A name, spelt as the language compares it.
    Name(Box<str>),
}

/// How a control looks for a label.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Search {
    /// Forward from the block after the jump to the end of the program (GOTOF).
    Forward,
    /// Backward from the jump's own block to the start of the program (GOTOB).
    Backward,
    /// Forward, then backward from the jump (Sinumerik's GOTO): the nearest one before it.
    ForwardThenBackward,
    /// Forward, then from the start of the program (Macro B's GOTO): the first one of it.
    ForwardThenStart,
    /// From the start of the program.
    FromStart,
}

/// See the module. `B`: a mistake in the structure of the file, in the form of the language.
#[derive(Clone, Debug)]
pub struct Index<B> {
    /// Label and block, sorted.
    labels: Vec<(Key, u32)>,
    /// First block and name of each program of the file.
    programs: Vec<(u32, Key)>,
    /// Loops and branches.
    pub loops: Loops,
    /// What is wrong with loops and branches.
    pub broken: Vec<B>,
    blocks: u32,
}

impl<B> Index<B> {
    /// From labels in any order, and programs in the order of the file, which has so many blocks.
    pub fn of(
        mut labels: Vec<(Key, u32)>,
        programs: Vec<(u32, Key)>,
        loops: Loops,
        broken: Vec<B>,
        blocks: u32,
    ) -> Self {
        labels.sort_unstable();
        Self {
            labels,
            programs,
            loops,
            broken,
            blocks,
        }
    }

    /// The blocks of the program, among those of the file, that contain a block: first, and one past the last.
    pub fn section(&self, block: u32) -> (u32, u32) {
        let behind = self.programs.partition_point(|program| program.0 <= block);
        let end = match behind {
            // what is before the first program number belongs to the first program
            0 => self.programs.get(1).map_or(self.blocks, |program| program.0),
            _ => self.programs.get(behind).map_or(self.blocks, |program| program.0),
        };
        let start = match behind {
            0 | 1 => 0,
            _ => self.programs[behind - 1].0,
        };
        (start, end)
    }

    /// Whether the file says which programs are in it.
    pub fn names_programs(&self) -> bool {
        !self.programs.is_empty()
    }

    /// First block of the program of a number or name.
    pub fn program(&self, name: &Key) -> Option<u32> {
        self.programs
            .iter()
            .find(|program| program.1 == *name)
            .map(|program| program.0)
    }

    /// The blocks of a label in a section, first to last.
    pub fn all<'s>(&'s self, label: &'s Key, section: (u32, u32)) -> impl DoubleEndedIterator<Item = u32> + 's {
        let first = self.labels.partition_point(|(key, at)| (key, *at) < (label, section.0));
        let behind = self.labels.partition_point(|(key, at)| (key, *at) < (label, section.1));
        self.labels[first..behind.max(first)].iter().map(|(_, at)| *at)
    }

    /// The block of a label as a control finds it from the block `from` in the program `section`.
    pub fn label(&self, label: &Key, from: u32, section: (u32, u32), search: Search) -> Option<u32> {
        let split = from.saturating_add(1).clamp(section.0, section.1.max(section.0));
        let ahead = || self.all(label, (split, section.1)).next();
        let before = || self.all(label, (section.0, split)).next_back();
        match search {
            Search::Forward => ahead(),
            Search::Backward => before(),
            Search::ForwardThenBackward => ahead().or_else(before),
            Search::ForwardThenStart => ahead().or_else(|| self.all(label, section).next()),
            Search::FromStart => self.all(label, section).next(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Index, Key, Search};
    use crate::Loops;

    fn index() -> Index<()> {
        let labels = [(1, 0), (1, 4), (1, 9), (2, 6), (1, 12)];
        let labels = labels.map(|(number, at)| (Key::Number(number), at)).to_vec();
        let programs = vec![
            (2, Key::Name("A".into())),
            (8, Key::Number(7)),
            (11, Key::Name("C".into())),
        ];
        Index::of(labels, programs, Loops::default(), Vec::new(), 14)
    }

    #[test]
    fn a_label_is_found_in_each_direction() {
        let index = index();
        let find = |from, search| index.label(&Key::Number(1), from, (0, 14), search);
        assert_eq!(find(4, Search::Forward), Some(9));
        assert_eq!(find(12, Search::Forward), None);
        assert_eq!(find(4, Search::Backward), Some(4), "the jump's own block");
        assert_eq!(find(8, Search::Backward), Some(4));
        assert_eq!(find(12, Search::ForwardThenBackward), Some(12));
        assert_eq!(find(13, Search::ForwardThenBackward), Some(12));
        assert_eq!(find(13, Search::ForwardThenStart), Some(0));
        assert_eq!(find(5, Search::FromStart), Some(0));
        assert_eq!(find(u32::MAX, Search::ForwardThenStart), Some(0));
        let other = index.label(&Key::Number(3), 0, (0, 14), Search::ForwardThenStart);
        assert_eq!(other, None);
    }

    #[test]
    fn a_label_of_another_program_is_not_found() {
        let index = index();
        let section = index.section(9);
        assert_eq!(section, (8, 11));
        let find = |from, search| index.label(&Key::Number(1), from, section, search);
        assert_eq!(find(9, Search::Forward), None);
        assert_eq!(find(10, Search::ForwardThenBackward), Some(9));
        assert_eq!(find(8, Search::Backward), None);
        assert_eq!(
            (index.section(0), index.section(2), index.section(13)),
            ((0, 8), (0, 8), (11, 14))
        );
        assert_eq!(index.program(&Key::Number(7)), Some(8));
        assert_eq!(index.program(&Key::Name("B".into())), None);
    }
}
