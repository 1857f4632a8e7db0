//! What "expand selection" takes: value, word, block, operation, program.
use crate::text::trimmed;
use crate::{Names, Node};
use std::collections::BTreeMap;
use trunnion_syntax::{BlockId, Item, Program, TextRange};

/// What can be selected in a program, for any number of places: each block is read once, and a place is searched for.
pub struct Selections<'p> {
    program: &'p Program,
    names: &'p Names,
    /// The entries of the outline; those in one entry of a level are in the next level.
    levels: Vec<Ranges>,
    /// The blocks that were asked about: what they are made of, and what goes round that.
    blocks: BTreeMap<BlockId, [Ranges; 2]>,
}

/// Ranges in the order of their starts, each with the farthest end up to it.
struct Ranges(Vec<(TextRange, u32)>);

impl Ranges {
    fn new(mut ranges: Vec<TextRange>) -> Self {
        ranges.sort_by_key(|range| range.start);
        let mut end = 0;
        let with_end = |range: TextRange| {
            end = range.end.max(end);
            (range, end)
        };
        Self(ranges.into_iter().map(with_end).collect())
    }

    /// Those that may touch a byte: none before them does, and none behind.
    fn near(&self, offset: u32) -> &[(TextRange, u32)] {
        let behind = self.0.partition_point(|(range, _)| range.start <= offset);
        let before = self.0.partition_point(|(_, end)| *end < offset);
        &self.0[before.min(behind)..behind]
    }

    fn touching(&self, offset: u32) -> impl Iterator<Item = TextRange> {
        let near = self.near(offset).iter().map(|(range, _)| *range);
        near.filter(move |range| range.touches(offset))
    }
}

impl<'p> Selections<'p> {
    /// Of a program with its names and its outline.
    pub fn new(program: &'p Program, names: &'p Names, outline: &[Node]) -> Self {
        let mut levels = Vec::new();
        let mut level: Vec<&Node> = outline.iter().collect();
        while !level.is_empty() {
            levels.push(Ranges::new(level.iter().map(|node| node.range).collect()));
            level = level.iter().flat_map(|node| &node.children).collect();
        }
        Self {
            program,
            names,
            levels,
            blocks: BTreeMap::new(),
        }
    }

    /// The ranges around a byte, from the smallest to the whole text; each holds the one before.
    pub fn at(&mut self, offset: u32) -> Vec<TextRange> {
        let mut found: Vec<TextRange> = self.names.at(offset).map(|name| name.range).into_iter().collect();
        if let Some(id) = self.program.block_at(offset) {
            let block = self.blocks.entry(id).or_insert_with(|| of_block(self.program, id));
            found.extend(block.iter().flat_map(|ranges| ranges.touching(offset)));
        }
        found.extend(self.levels.iter().flat_map(|level| level.touching(offset)));
        found.push(TextRange::new(0, self.program.source().len() as u32));
        found.retain(|range| range.start < range.end && range.touches(offset));
        found.sort_by_key(|range| range.end - range.start);
        let mut nested: Vec<TextRange> = Vec::new();
        for range in found {
            if nested
                .last()
                .is_none_or(|inner| range != *inner && range.start <= inner.start && inner.end <= range.end)
            {
                nested.push(range);
            }
        }
        nested
    }
}

/// What can be selected in a block.
fn of_block(program: &Program, id: BlockId) -> [Ranges; 2] {
    let block = program.block(id);
    let mut found = Vec::new();
    for item in block.items() {
        match item {
            Item::Word(word) => found.extend([word.value_range, word.range]),
            Item::Call(call) => found.extend(
                [Some(call.name), call.arguments, Some(call.range)]
                    .into_iter()
                    .flatten(),
            ),
            Item::Comment(comment) => found.extend([comment.inner, comment.range]),
            Item::Skip(_, range) | Item::Percent(range) | Item::Label(range) | Item::Other(range) => {
                found.push(range);
            }
        }
    }
    let record = block.record().map(|record| [record.major, record.range]);
    let mut round: Vec<TextRange> = record.into_iter().flatten().collect();
    round.extend([trimmed(program, block.range()), block.range()]);
    [Ranges::new(found), Ranges::new(round)]
}

#[cfg(test)]
mod tests {
    use super::{Ranges, Selections};
    use crate::{names, outline};
    use trunnion_syntax::{TextRange, parse};

    #[test]
    fn ranges_round_a_byte_are_nested() {
        let text = "O1 (part)\nT1 M6\nN10 G1 X12.5 (there)\nM30\n";
        let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
        let program = parse(text.into(), dialect.lex);
        let names = names(&program, dialect);
        let outline = outline(&program, dialect, &names);
        let mut selections = Selections::new(&program, &names, &outline);
        let mut at = |place: &str| {
            let ranges = selections.at(text.find(place).expect("there") as u32);
            let texts = ranges
                .iter()
                .map(|range| &text[range.start as usize..range.end as usize]);
            texts.map(str::to_owned).collect::<Vec<_>>()
        };
        let block = "N10 G1 X12.5 (there)";
        let operation = text[text.find("T1").expect("there")..].trim_end();
        for (place, inner) in [("2.5", ["12.5", "X12.5"]), ("here", ["there", "(there)"])] {
            let found = at(place);
            assert_eq!(found[..2], inner, "{found:?}");
            assert_eq!(found[2], block, "{found:?}");
            assert!(found.iter().any(|range| range == operation), "{found:?}");
            assert_eq!(found.last().map(String::as_str), Some(text));
        }
    }

    #[test]
    fn few_ranges_are_looked_at_for_a_place_of_a_large_program() {
        let blocks = (1..400).map(|number| format!("T{number} M6\nN{number} G1 X{number}\nGOTO{number}\n"));
        let text = format!("O1\n{}{}", blocks.collect::<Vec<_>>().concat(), "X1 ".repeat(2000));
        let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
        let program = parse(text.clone().into(), dialect.lex);
        let names = names(&program, dialect);
        let outline = outline(&program, dialect, &names);
        let mut selections = Selections::new(&program, &names, &outline);
        for offset in 0..=text.len() as u32 {
            assert!(selections.at(offset).len() > 1);
        }
        let blocks = selections.blocks.values().flatten();
        for ranges in selections.levels.iter().chain(blocks) {
            let most = (0..=text.len() as u32)
                .step_by(7)
                .map(|offset| ranges.near(offset).len());
            assert!(most.max() <= Some(8), "{:?}", ranges.0.len());
        }
        assert!(selections.levels[1].0.len() > 390);
    }

    #[test]
    fn what_may_touch_a_byte_is_found_between_the_ends() {
        let range = TextRange::new;
        let ranges = Ranges::new(vec![range(0, 2), range(2, 9), range(3, 4), range(5, 6), range(10, 12)]);
        let at = |offset| ranges.touching(offset).collect::<Vec<_>>();
        assert_eq!(at(2), [range(0, 2), range(2, 9)]);
        assert_eq!(at(6), [range(2, 9), range(5, 6)]);
        assert_eq!(at(11), [range(10, 12)]);
        assert_eq!(at(13), []);
    }
}
