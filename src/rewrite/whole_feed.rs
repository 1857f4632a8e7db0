//! Feeds without a decimal point, on controls where a setting decides what such a number is.
use trunnion_dialect::Dialect;
use trunnion_syntax::{Address, Block, Value};

/// Whether a block has an F of which a setting of the control decides how much it is. Such a block stays as it is, and nothing is put together with it: what it
/// does is known only as its text.
pub(crate) fn has_whole_feed(block: &Block<'_>, dialect: &Dialect) -> bool {
    let whole = |value| matches!(value, Value::Number(number) if !number.has_point && number.to_f64() != 0.0);
    dialect.quirks.whole_numbers.feeds_ambiguous()
        && block
            .words()
            .any(|word| word.address == Address::Letter(b'F') && whole(word.value))
}
