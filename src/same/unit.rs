//! What two programs in different units say apart from motions: a number that may be a length must not be the same in both.
use crate::item::{Item, Sort};
use crate::process::shown;
use crate::sentences::at;
use crate::verdict::{Difference, Verdict};
use std::collections::BTreeMap;
use trunnion_interp::{Argument, ModalState, Value, same_number};

/// Settings whose numbers are no lengths: numbers of tools and offsets, spindle speeds, what is shown.
const NO_LENGTHS: [&str; 8] = [
    "speed",
    "tool prepared",
    "tool in use",
    "D",
    "H",
    "radius offset",
    "message",
    "spindle",
];

/// Whether a word may carry a length.
fn may_be_length(word: &Argument) -> bool {
    // numbers of codes, tools and offsets, and speeds: `M1`, `T`, `S2`
    let number = word.name.strip_prefix(['M', 'T', 'H', 'D', 'S']);
    let is_number = number.is_some_and(|rest| rest.bytes().all(|byte| byte.is_ascii_digit()));
    !matches!(word.value, Value::Nothing) && !is_number
}

/// What is in effect at an item must not depend on the unit of lengths.
pub(crate) fn other_unit_settings(item: &Item, state: &ModalState) -> Result<(), Verdict> {
    let process = match item {
        Item::Motion(step) => &step.process,
        Item::Happens { process, .. } => process,
    };
    let found = process.lengthy(|key, words| {
        !NO_LENGTHS.contains(&key) && !key.starts_with("speed limit") && words.iter().any(may_be_length)
    });
    if let Some((key, words)) = found {
        let what = format!(
            "{key} is `{}`: whether that is a length, and in which unit, is not known",
            shown(words)
        );
        return Err(Verdict::Unknown(at(Some(item), None, what)));
    }
    if state.spindle.surface_speed() {
        let what = "G96: S is in m/min or feet/min, depending on the unit, and is not rewritten".to_owned();
        return Err(Verdict::Unknown(at(Some(item), None, what)));
    }
    Ok(())
}

/// Two things that happen: `true` where they are the same offsets written by the program within rounding. `in_mm`: the words of stored offsets are
/// in mm.
pub(crate) fn other_unit_event(was: &Item, is: &Item, (mm, in_mm): (f64, bool)) -> Result<bool, Verdict> {
    let (Item::Happens { sort, words, .. }, Item::Happens { words: other, .. }) = (was, is) else {
        return Ok(false);
    };
    if *sort == Sort::End || !words.iter().any(may_be_length) {
        return Ok(false);
    }
    let entry = in_mm && words.iter().any(|word| word.name == "G10") && *sort == Sort::Event;
    let lengths = entry && !words.iter().chain(other).any(|word| word.name == "mm per unit");
    let axis = |word: &Argument| matches!(word.name.as_bytes(), [b'X' | b'Y' | b'Z' | b'U' | b'V' | b'W' | b'R']);
    let near = |(a, b): (&Argument, &Argument)| match (&a.value, &b.value) {
        (Value::Number(from), Value::Number(to)) if a.name == b.name => {
            same_number(*from, *to) || axis(a) && (from - to).abs() <= 2.0 * mm
        }
        _ => a == b,
    };
    if lengths && words.len() == other.len() && words.iter().zip(other).all(near) {
        return Ok(true);
    }
    let outputs = *sort == Sort::Event
        && words
            .iter()
            .any(|word| word.name.starts_with('M') && matches!(word.value, Value::Nothing))
        && words
            .iter()
            .filter(|word| may_be_length(word))
            .all(|word| matches!(word.name.as_ref(), "P" | "Q" | "L" | "E"));
    if outputs {
        return Ok(false);
    }
    let what = format!(
        "`{}`: whether its numbers are lengths, and in which unit, is not known",
        shown(words)
    );
    Err(Verdict::Unknown(at(Some(was), Some(is), what)))
}

/// Variables that outlive the program may hold lengths.
pub(crate) fn unit_of_stores(stored: &BTreeMap<String, Value>) -> Result<(), Verdict> {
    // above #5000 are offsets and positions of the control
    let own = |(name, value): &(&String, &Value)| {
        let number = name.strip_prefix('#').and_then(|number| number.parse::<u32>().ok());
        number.is_none_or(|number| number <= 5000) && !matches!(value, Value::Number(0.0))
    };
    let Some((name, _)) = stored.iter().find(own) else {
        return Ok(());
    };
    Err(Verdict::Unknown(Difference {
        before: None,
        after: None,
        what: format!("{name} outlives the program: whether it holds a length, and in which unit, is not known"),
    }))
}
