//! Targets of the jumps and calls of an OSP file: names after N and O, compared as text (N0123 is not N123).
use crate::flow::Index;
use trunnion_flow::{Key, Loops};
use trunnion_syntax::{Address, Block, Item, Program};

/// Reads the whole file once.
pub(crate) fn index(program: &Program) -> Index {
    let (mut labels, mut programs) = (Vec::new(), Vec::new());
    for block in program.blocks() {
        let at = block.id().0;
        match head(&block) {
            Some(name) if name.starts_with('O') => programs.push((at, Key::Name(name.into()))),
            Some(name) => labels.push((Key::Name(name.into()), at)),
            None => {}
        }
    }
    Index::of(
        labels,
        programs,
        Loops::default(),
        Vec::new(),
        program.block_count() as u32,
    )
}

/// The name at the start of a block with its letter, in upper case: `NLOOP`, `N0123`, `OPART`.
pub(super) fn head(block: &Block<'_>) -> Option<String> {
    let mut items = block
        .items()
        .filter(|item| !matches!(item, Item::Comment(_) | Item::Skip(..)));
    let range = match items.next()? {
        Item::Label(range) => range,
        Item::Word(word) if matches!(word.address, Address::Letter(b'N' | b'O')) => word.range,
        _ => return None,
    };
    Some(block.program().text(range).trim().to_ascii_uppercase())
}

/// File names in which a subprogram may be.
pub(crate) fn files(name: &Key) -> Vec<String> {
    let Key::Name(name) = name else { return Vec::new() };
    let lower = name.to_ascii_lowercase();
    let endings = ["SUB", "SSB", "LIB", "MIN"];
    let upper = endings.iter().map(|ending| format!("{name}.{ending}"));
    let small = endings
        .iter()
        .map(|ending| format!("{lower}.{}", ending.to_ascii_lowercase()));
    let mixed = endings
        .iter()
        .map(|ending| format!("{name}.{}", ending.to_ascii_lowercase()));
    upper.chain(mixed).chain(small).collect()
}
