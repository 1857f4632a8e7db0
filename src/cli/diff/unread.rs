//! Blocks whose values nobody knows: what they say stands in their words alone.
use trunnion_interp::{AxisLetter, Interpreter, Motion};
use trunnion_syntax::{Address, Block, Item};

/// Whether a block that has just run names an axis whose end is not known (an increment from where nobody knows, a variable without
/// value), reads or sets a variable whose value is not known, or hands variables on to a call, where they go by other names.
pub(super) fn reads_unknown<'m>(
    block: &Block<'_>,
    interpreter: &Interpreter<'_>,
    motions: impl Iterator<Item = &'m Motion>,
) -> bool {
    let program = block.program();
    let mut unknown_axes = 0;
    for motion in motions {
        unknown_axes |= !motion.end.known;
    }
    let mut hands_on = false;
    let mut has_variables = false;
    for item in block.items() {
        let range = match item {
            Item::Word(word) => {
                if let Address::Letter(letter) = word.address
                    && unknown_axes & axes(letter) != 0
                {
                    return true;
                }
                hands_on |= matches!(word.address, Address::Letter(b'P'));
                word.range
            }
            Item::Call(call) => {
                hands_on = true;
                call.range
            }
            Item::Other(range) => range,
            _ => continue,
        };
        let names = names(&program.text(range));
        has_variables |= !names.is_empty();
        if names
            .iter()
            .any(|name| interpreter.variable(name).is_some_and(f64::is_nan))
        {
            return true;
        }
    }
    hands_on && has_variables
}

/// The axes that a letter may name, bits as in `Position::known`: U, V, W, H are increments of X, Y, Z, C on a lathe.
fn axes(letter: u8) -> u16 {
    let bit = |letter| AxisLetter::new(letter).map_or(0, |axis| 1 << axis.0);
    let of = match letter {
        b'U' => b'X',
        b'V' => b'Y',
        b'W' => b'Z',
        b'H' => b'C',
        _ => letter,
    };
    bit(letter) | bit(of)
}

/// The variables that a text names: `#1`, `#<name>`; of a computed number (`#[#1+2]`) what it is computed from.
fn names(text: &str) -> Vec<String> {
    let packed: String = text.chars().filter(|c| !c.is_ascii_whitespace()).collect();
    let mut found = Vec::new();
    for (at, _) in packed.match_indices('#') {
        let rest = &packed[at + 1..];
        let length = if rest.starts_with('<') {
            rest.find('>').map_or(0, |end| end + 1)
        } else {
            rest.len() - rest.trim_start_matches(|c: char| c.is_ascii_digit()).len()
        };
        if length > 0 {
            found.push(format!("#{}", &rest[..length]));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    #[test]
    fn names_of_variables() {
        assert_eq!(super::names("X[# 5061 + #<a b>]#[#1+2]"), ["#5061", "#<ab>", "#1"]);
        assert_eq!(super::names("#"), [] as [&str; 0]);
    }
}
