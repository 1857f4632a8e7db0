//! Blocks between G10 and G11 that are data: `N1815 P1 R5.` after `G10 L52` is parameter 1815 of a Fanuc, and no block with that number.
//!
//! L50 (older controls) and L52 begin the entry of parameters, L51 that of pitch errors (Fanuc Series 16i and 30i operator's manuals, programmable
//! parameter input). After another L that is not done in one block, what stands before G11 is left alone too.
use crate::references::begins_program;
use core::ops::Range;
use trunnion_dialect::{Action, Dialect};
use trunnion_syntax::{Address, Block, Program, Value};

/// L of offsets, which are written in one block.
const IN_ONE_BLOCK: [i64; 11] = [1, 2, 10, 11, 12, 13, 20, 21, 110, 111, 112];

/// What a block has to do with data.
enum Says {
    /// It begins an entry; `true`: whether G11 follows or not.
    Begins(bool),
    /// G11.
    Ends,
    Nothing,
}

/// The blocks of data, the one with G10 included, in the order of the text.
pub(crate) fn data_entries(program: &Program, dialect: &Dialect) -> Vec<Range<u32>> {
    let mut found = Vec::new();
    let mut open: Option<(u32, bool)> = None;
    for block in program.blocks() {
        let here = block.id().0;
        let says = says(&block, dialect);
        let ends = matches!(says, Says::Ends);
        if let Some((from, certain)) = open
            && (ends || begins_program(&block).is_some())
        {
            if ends || certain {
                found.push(from..here);
            }
            open = None;
        }
        if let (Says::Begins(certain), None) = (says, open) {
            open = Some((here, certain));
        }
    }
    if let Some((from, true)) = open {
        found.push(from..program.block_count() as u32);
    }
    found
}

/// Whether a block is data.
pub(crate) fn is_data(entries: &[Range<u32>], block: u32) -> bool {
    let next = entries.partition_point(|entry| entry.end <= block);
    // the number in front of G10 is that of its block
    entries.get(next).is_some_and(|entry| entry.start < block)
}

fn says(block: &Block<'_>, dialect: &Dialect) -> Says {
    let (mut entry, mut level) = (false, None);
    for word in block.words() {
        match (word.address, word.value) {
            (Address::Letter(b'G'), Value::Number(number)) => {
                let tenths = number.to_f64() * 10.0;
                let code = (tenths.fract() == 0.0 && (0.0..1e5).contains(&tenths))
                    .then(|| dialect.g(tenths as u32))
                    .flatten();
                match code.map(|code| code.action) {
                    Some(Action::DataEntry) => entry = true,
                    Some(Action::DataEntryEnd) => return Says::Ends,
                    _ => {}
                }
            }
            (Address::Letter(b'L'), Value::Number(number)) => level = number.to_integer(),
            _ => {}
        }
    }
    match (entry, level) {
        (true, Some(50..=52)) => Says::Begins(true),
        (true, level) if level.is_none_or(|level| !IN_ONE_BLOCK.contains(&level)) => Says::Begins(false),
        _ => Says::Nothing,
    }
}
