//! Block numbers to which a program that is missing may return: M99 P50 of a called program continues its caller at N50 (Fanuc and controls with
//! its macro language). Such numbers are part of what the caller does.
use crate::iso::Iso;
use crate::{Argument, Effect, Fault, FaultKind, Motion, Reach, Setup, Sink};
use memchr::memmem;
use trunnion_dialect::Dialect;
use trunnion_syntax::{Address, Block, BlockId, Program, Value};

/// The first program that a run calls and does not find, if it could name a block number of its caller. It is followed as far as a
/// comparison follows it (`steps` of the limits): what is called later is not compared.
pub fn may_return_to_numbers(program: &Program, dialect: &Dialect, setup: &Setup) -> Option<String> {
    if !dialect.quirks.macro_b() || !has_calls(program) {
        return None;
    }
    let mut found = Missing::default();
    let mut setup = setup.clone();
    setup.limits = setup.limits.of_steps();
    crate::run(program, dialect, &setup, &mut found);
    found.0
}

/// Block numbers of a program, in the order of the text.
pub fn block_numbers(program: &Program) -> impl Iterator<Item = (BlockId, String)> + '_ {
    program
        .blocks()
        .filter_map(|block| Some((block.id(), number_of(&block)?)))
}

impl Iso<'_> {
    /// The number of a block, where it counts.
    pub(crate) fn number_effect(&mut self, view: &Block<'_>) {
        if !self.core.effects.numbers_wanted() {
            return;
        }
        if let Some(number) = number_of(view) {
            let effect = Effect::Unmodelled(vec![Argument::code(format!("{number}{MARK}"))]);
            let block = self.core.main_block(view.id());
            self.core.effects.add_with(block, effect, Reach::Itself);
        }
    }
}

/// Ends the name of a block number among effects; no code of a control ends so.
const MARK: &str = " (a missing program may return to it)";

/// Whether a word of an effect is a block number.
pub fn is_block_number(word: &Argument) -> bool {
    word.name.ends_with(MARK)
}

/// `N50`, without leading zeros.
fn number_of(block: &Block<'_>) -> Option<String> {
    block.words().find_map(|word| match (word.address, word.value) {
        (Address::Letter(b'N'), Value::Number(value)) => Some(format!("N{}", value.to_f64())),
        _ => None,
    })
}

/// Whether a block of a program [`calls`]. Only blocks are read in which a letter M or G stands before digits of such a code: a proof asks this of each
/// program that it compares.
fn has_calls(program: &Program) -> bool {
    let text = program.source();
    let after_letter = |at: &usize| {
        let number =
            |byte: &&u8| byte.is_ascii_digit() || byte.is_ascii_whitespace() || matches!(byte, b'.' | b'+' | b'-');
        let letter = text[..*at].iter().rev().find(|byte| !number(byte));
        letter.is_some_and(|letter| matches!(letter.to_ascii_uppercase(), b'M' | b'G'))
    };
    let calls_at = |at: usize| {
        let block = program.block_at(at as u32);
        block.is_some_and(|block| calls(&program.block(block)))
    };
    let digits = [b"98", b"65", b"66"];
    digits
        .iter()
        .any(|digits| memmem::find_iter(text, *digits).filter(after_letter).any(calls_at))
}

/// Whether a block has a code of a call: M98, M198, G65, G66, G66.1.
fn calls(block: &Block<'_>) -> bool {
    block.words().any(|word| {
        let Value::Number(value) = word.value else { return false };
        match word.address {
            Address::Letter(b'M') => matches!(value.to_integer(), Some(98 | 198)),
            Address::Letter(b'G') => matches!((value.to_f64() * 10.0).round() as i64, 650 | 660 | 661),
            _ => false,
        }
    })
}

#[derive(Default)]
struct Missing(Option<String>);

impl Sink for Missing {
    fn motion(&mut self, _: &Motion, _: &crate::ModalState) {}
    fn fault(&mut self, fault: Fault) {
        if let FaultKind::MissingSubprogram { name, .. } = fault.kind {
            self.0.get_or_insert(name);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// What is not read would not have been a call.
        #[test]
        fn each_call_is_seen(parts in prop::collection::vec(
            prop::sample::select(vec!["M", "m", "G", "N", "9", "98", "1", "0", "65", "66", ".", " ", "-", "\n", "(", ")", "X", "P", "%", "/", "\t", "#"]), 0..20,
        )) {
            let dialect = trunnion_dialect::builtin("fanuc-30i").expect("embedded");
            let program = trunnion_syntax::parse(parts.concat().into_bytes(), dialect.lex);
            prop_assert_eq!(has_calls(&program), program.blocks().any(|block| calls(&block)));
        }
    }
}
