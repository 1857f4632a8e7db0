//! Block numbers that count because a program that is missing may return to them.
use crate::input::Input;
use crate::item::Item;
use crate::steps::Steps;
use crate::verdict::{Difference, Verdict};
use trunnion_interp::{Interpreter, block_numbers, is_block_number, may_return_to_numbers};

/// Asks for block numbers among the effects, if a program is missing that may return to one: its name.
pub(crate) fn watch(input: &Input<'_>, interpreter: &mut Interpreter<'_>) -> Option<String> {
    let missing = may_return_to_numbers(input.program, input.dialect, input.setup)?;
    interpreter.watch_block_numbers();
    Some(missing)
}

/// Whether an item is a block number.
pub(crate) fn is_one(item: &Item) -> bool {
    let Item::Happens { words, .. } = item else {
        return false;
    };
    matches!(&words[..], [word] if is_block_number(word))
}

/// Both texts have the same numbers in the same order, also where no block runs, if a missing program may return to one.
pub(crate) fn alike(before: &Steps<'_>, after: &Steps<'_>) -> Result<(), Verdict> {
    let Some(missing) = before.returning.as_ref().or(after.returning.as_ref()) else {
        return Ok(());
    };
    let [mut old, mut new] = [before, after].map(|steps| block_numbers(steps.input().program));
    loop {
        let (was, is) = (old.next(), new.next());
        let (number, side) = match (&was, &is) {
            (None, None) => return Ok(()),
            (Some((_, was)), Some((_, is))) if was == is => continue,
            (Some((_, was)), _) => (was, "original"),
            (None, Some((_, is))) => (is, "changed"),
        };
        let p = number.trim_start_matches('N');
        return Err(Verdict::Unknown(Difference {
            before: was.as_ref().map(|(block, _)| *block),
            after: is.as_ref().map(|(block, _)| *block),
            what: format!(
                "the block number {number} of the {side} program is not in the other one, or in another place: {missing} is missing, \
                 and may return to it (M99 P{p}); keep the block numbers, or put {missing} into the folder or under `subprogram_path`"
            ),
        }));
    }
}
