//! Where in a block a finding is shown: the word that names the axis, the vector, or the block's code without its comments.
use trunnion_syntax::{Address, AptArg, Block, BlockId, Item, Program, TextRange};

/// The word of an axis (upper case letter); failing that, the words or numbers of the tool's orientation for a rotary letter;
/// failing that, the code of the block.
pub(crate) fn axis_word(program: &Program, block: BlockId, letter: u8) -> TextRange {
    let view = program.block(block);
    if program.options().format.has_words()
        && let Some(word) = view.words().find(|word| word.address == Address::Letter(letter))
    {
        return word.range;
    }
    if matches!(letter, b'A' | b'B' | b'C') {
        return orientation_range(program, block);
    }
    code(&view)
}

/// Whether a block has a word of an axis (upper case letter), or is not a block of words.
pub(crate) fn names_axis(program: &Program, block: BlockId, letter: u8) -> bool {
    let view = program.block(block);
    let named = |word: trunnion_syntax::Word| word.address == Address::Letter(letter);
    !program.options().format.has_words() || view.words().any(named)
}

/// The words or numbers that give the tool's orientation: A B C, A3= B3= C3=, I J K of a vector, the last three numbers of GOTO;
/// failing that, the code of the block.
pub(crate) fn orientation_range(program: &Program, block: BlockId) -> TextRange {
    let view = program.block(block);
    let found = if let Some(record) = view.record() {
        let numbers = record.args().filter_map(|arg| {
            if let AptArg::Number(_, range) = arg {
                Some(range)
            } else {
                None
            }
        });
        cover(numbers.skip(3))
    } else {
        let rotary = |word: &trunnion_syntax::Word| {
            matches!(
                word.address,
                Address::Letter(b'A' | b'B' | b'C') | Address::Indexed(b'A' | b'B' | b'C', 3)
            )
        };
        let vector = |word: &trunnion_syntax::Word| matches!(word.address, Address::Letter(b'I' | b'J' | b'K'));
        cover(view.words().filter(rotary).map(|word| word.range))
            .or_else(|| cover(view.words().filter(vector).map(|word| word.range)))
    };
    found.unwrap_or_else(|| code(&view))
}

/// The code of a block: from its first to its last word, without comments and block number; the whole block where there is none.
pub(crate) fn code_range(program: &Program, block: BlockId) -> TextRange {
    code(&program.block(block))
}

fn code(view: &Block<'_>) -> TextRange {
    if let Some(record) = view.record() {
        return record.range;
    }
    if let Some(sentence) = view.sentence() {
        return sentence.range;
    }
    let number = view.number();
    let items = view.items().filter_map(|item| match item {
        Item::Word(word) => Some(word.range),
        Item::Call(call) => Some(call.range),
        Item::Other(range) | Item::Label(range) | Item::Percent(range) => Some(range),
        Item::Comment(_) | Item::Skip(..) => None,
    });
    cover(items.filter(|range| Some(*range) != number))
        .or(number)
        .unwrap_or_else(|| view.range())
}

fn cover(ranges: impl Iterator<Item = TextRange>) -> Option<TextRange> {
    ranges.reduce(TextRange::cover)
}
