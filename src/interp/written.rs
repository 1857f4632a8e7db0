//! The words of a block as they are compared where the block's effect is not known: numbers by value, codes and names in one spelling,
//! and expressions with the known variables in them replaced.
use crate::Argument;
use crate::words::{WordValue, Words};
use trunnion_dialect::{Action, Code, Dialect, Role};
use trunnion_syntax::{Address, Block, Item, TextRange, Value, Word};

/// Which words of a block count.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Keep {
    /// All.
    All,
    /// Those that neither the motion of the block nor the settings hold.
    BesideMotion,
}

/// The words of a block, ordered by name.
pub(crate) fn written(view: &Block<'_>, run: &impl Values, words: &Words, keep: Keep) -> Vec<Argument> {
    let mut found = Vec::new();
    let text = |range: TextRange| view.program().text(range).into_owned();
    let mut statement = String::new();
    for item in view.items() {
        // a path after CALL is one name: its slashes and parts are no words of the block
        let part = call_part(view, run, item).filter(|_| !statement.is_empty() || calls_program(view, run, item));
        if let Some(part) = part {
            statement.push_str(&part);
            statement.push(' ');
            continue;
        }
        match item {
            Item::Word(word) => {
                if !(keep == Keep::BesideMotion && is_held(run, view, &word)) {
                    found.extend(word_argument(view, run, words, &word));
                }
            }
            Item::Call(call) => {
                let code = run.dialect().name(&text(call.name));
                let known = code.is_some_and(|code| !is_not_followed(code));
                if !(keep == Keep::BesideMotion && known) {
                    found.push(call_argument(
                        &packed(&text(call.name)),
                        &resolved(run, &text(call.range)),
                    ));
                }
            }
            Item::Other(range) => found.push(Argument::text("", &resolved(run, &text(range)))),
            Item::Skip(..) | Item::Comment(_) | Item::Percent(_) | Item::Label(_) => {}
        }
    }
    if !statement.is_empty() {
        found.push(Argument::text("", statement.trim_end()));
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    found
}

/// Whether an item begins a statement of a Sinumerik that calls a program by its path: CALL, PCALL, EXTCALL, ISOCALL.
pub(crate) fn calls_program(view: &Block<'_>, run: &impl Values, item: Item) -> bool {
    let Item::Call(call) = item else { return false };
    let name = view.program().bytes(call.name);
    run.dialect().quirks.declares_names()
        && [&b"CALL"[..], b"PCALL", b"EXTCALL", b"ISOCALL"]
            .iter()
            .any(|known| name.eq_ignore_ascii_case(known))
}

/// The text of an item as a part of such a statement.
fn call_part(view: &Block<'_>, run: &impl Values, item: Item) -> Option<String> {
    let range = match item {
        Item::Word(word) => word.range,
        Item::Call(call) => call.range,
        Item::Other(range) => range,
        _ => return None,
    };
    Some(resolved(run, &view.program().text(range)))
}

/// Whether the motion of the block or a setting holds the word.
fn is_held(run: &impl Values, view: &Block<'_>, word: &Word) -> bool {
    let tenths = match word.value {
        Value::Number(decimal) => crate::values::tenths(decimal),
        _ => None,
    };
    let role = match word.address {
        Address::Letter(letter) => run.dialect().role(letter),
        Address::Indexed(..) | Address::Named(_) => named_role(run, view, word),
    };
    match role {
        Some(Role::G) => tenths
            .and_then(|tenths| run.dialect().g(tenths))
            .is_some_and(|code| !is_not_followed(code)),
        Some(Role::M) => tenths
            .and_then(|tenths| run.dialect().m(tenths))
            .is_some_and(|code| !is_not_followed(code)),
        Some(role) => {
            is_geometry(role)
                || matches!(
                    role,
                    Role::Feed | Role::Speed | Role::Tool | Role::LengthOffset | Role::EdgeOffset
                )
        }
        None => false,
    }
}

/// Whether neither a motion nor a setting holds what a code does.
fn is_not_followed(code: &Code) -> bool {
    matches!(code.action, Action::NotFollowed | Action::SubprogramCall)
}

fn is_geometry(role: Role) -> bool {
    matches!(
        role,
        Role::Axis
            | Role::Increment
            | Role::ArcCentre
            | Role::ArcRadius
            | Role::ArcTurns
            | Role::ToolVector
            | Role::PathWord
    )
}

/// The name of a word that is written with `=`, upper case, without an index in brackets.
pub(crate) fn stem(view: &Block<'_>, word: &Word) -> String {
    match word.address {
        Address::Letter(letter) => char::from(letter).to_string(),
        Address::Indexed(letter, index) => format!("{}{index}", char::from(letter)),
        Address::Named(name) => {
            let name = packed(&view.program().text(name));
            name.split('[').next().unwrap_or_default().to_owned()
        }
    }
}

/// The name of a word that is written with `=`, with its index: `R[2+3]` is R5, `FIELD[N,1]` is FIELD[4,1] where N is 4. And whether the
/// index is known.
pub(crate) fn full_name(run: &impl Values, view: &Block<'_>, word: &Word) -> (String, bool) {
    let Address::Named(name) = word.address else {
        return (stem(view, word), true);
    };
    let name = packed(&view.program().text(name));
    let inside = name
        .split_once('[')
        .and_then(|(stem, rest)| Some((stem, rest.strip_suffix(']')?)));
    let Some((stem, inside)) = inside.filter(|_| run.dialect().quirks.user_names()) else {
        return (name, true);
    };
    let parts: Vec<Option<f64>> = crate::own::arguments(inside)
        .iter()
        .map(|part| run.value(part))
        .collect();
    let shown: Option<Vec<String>> = parts.iter().map(|part| part.map(|value| value.to_string())).collect();
    match shown {
        None => (format!("{stem}[{}]", resolved(run, inside)), false),
        Some(indices) if stem == "R" && indices.len() == 1 => (format!("R{}", indices[0]), true),
        Some(indices) => (format!("{stem}[{}]", indices.join(",")), true),
    }
}

pub(crate) fn named_role(run: &impl Values, view: &Block<'_>, word: &Word) -> Option<Role> {
    let role = run.dialect().named_role(stem(view, word).as_bytes());
    match (role, word.address) {
        (None, Address::Indexed(letter, _)) => run.dialect().role(letter).filter(|role| *role == Role::Variable),
        _ => role,
    }
}

/// A word with its value; `None` for block and program numbers.
fn word_argument(view: &Block<'_>, run: &impl Values, words: &Words, word: &Word) -> Option<Argument> {
    let program = view.program();
    let name = match word.address {
        Address::Letter(letter) => match run.dialect().role(letter) {
            Some(Role::BlockNumber | Role::ProgramNumber) => return None,
            _ => char::from(letter.to_ascii_uppercase()).to_string(),
        },
        Address::Named(_) | Address::Indexed(..) => full_name(run, view, word).0,
    };
    let letter = match word.address {
        Address::Letter(letter) => words.letter(letter.to_ascii_uppercase()),
        _ => WordValue::Nothing,
    };
    Some(match (word.value, letter) {
        (Value::Number(decimal), _) => Argument::number(name, decimal.to_f64()),
        (_, WordValue::Number(number)) => Argument::number(name, number.value),
        _ => {
            let text = program.text(word.value_range);
            match run.value(&text) {
                Some(value) => Argument::number(name, value),
                None => Argument::text(name, &resolved(run, &text)),
            }
        }
    })
}

/// What the texts of a program are read with.
pub(crate) trait Values {
    /// The dialect.
    fn dialect(&self) -> &Dialect;
    /// The value of an expression (Sinumerik) or of a variable as it is written; `None`: unknown, or there is none.
    fn value(&self, text: &str) -> Option<f64>;
}

/// Upper case, without blanks.
pub(crate) fn packed(text: &str) -> String {
    text.chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| c.to_ascii_uppercase())
        .collect()
}

/// The call of a cycle of holes: what is left out between its parentheses counts as 0.
pub(crate) fn hole_call_argument(name: &str, text: &str) -> Argument {
    let Some((before, inside)) = text.trim_end().strip_suffix(')').and_then(|text| text.split_once('(')) else {
        return call_argument(name, text);
    };
    let parts = crate::own::arguments(inside).into_iter();
    let parts = parts.map(|part| if part.parse() == Ok(0.0) { "" } else { part });
    let joined = parts.collect::<Vec<_>>().join(",");
    call_argument(name, &format!("{before}({})", joined.trim_end_matches(',')))
}

/// The text of a block without comments, blanks and block number, in upper case, its numbers in one spelling.
pub fn canonical_text(text: &str) -> String {
    let mut depth = 0;
    let bare: String = text
        .chars()
        .take_while(|c| *c != ';')
        .filter(|c| {
            depth += i32::from(*c == '(');
            let keep = depth == 0;
            depth -= i32::from(*c == ')');
            keep
        })
        .collect();
    let bare = packed(&bare);
    let after_number = bare
        .strip_prefix('N')
        .map(|rest| rest.trim_start_matches(|c: char| c.is_ascii_digit()));
    let mut rest = after_number.unwrap_or(&bare);
    let mut out = String::new();
    while let Some(first) = rest.chars().next() {
        let length = rest
            .find(|c: char| !(c.is_ascii_digit() || c == '.'))
            .unwrap_or(rest.len());
        if length == 0 {
            out.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        }
        let (token, after) = rest.split_at(length);
        match token.parse::<f64>() {
            Ok(value) => out.push_str(&value.to_string()),
            Err(_) => out.push_str(token),
        }
        rest = after;
    }
    out
}

/// A text without blanks in upper case, in which variables with a known value are replaced by it.
pub(crate) fn resolved(run: &impl Values, text: &str) -> String {
    let text = packed(text);
    let hash = !run.dialect().quirks.user_names();
    let mut out = String::new();
    let mut rest = text.as_str();
    // a word that is assigned keeps its name
    if let Some((name, value)) = rest.split_once('=').filter(|(name, value)| {
        !value.starts_with('=') && name.chars().all(|c| c.is_ascii_alphanumeric() || "#_$<>".contains(c))
    }) {
        out.push_str(name);
        out.push('=');
        rest = value;
    }
    while let Some(first) = rest.chars().next() {
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let length = if hash && first == '#' {
            let inside = &rest[1..];
            1 + if inside.starts_with('<') {
                inside.find('>').map_or(0, |end| end + 1)
            } else {
                inside.find(|c: char| !c.is_ascii_digit()).unwrap_or(inside.len())
            }
        } else if !hash && (first.is_ascii_alphabetic() || first == '_') {
            rest.find(|c| !is_name(c)).unwrap_or(rest.len())
        } else if first.is_ascii_digit() || first == '.' {
            rest.find(|c: char| !(c.is_ascii_digit() || c == '.'))
                .unwrap_or(rest.len())
        } else {
            out.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        };
        let (token, after) = rest.split_at(length.max(1));
        let value = if first.is_ascii_digit() || first == '.' {
            token.parse::<f64>().ok()
        } else if !hash && after.starts_with(['(', '[']) {
            None
        } else {
            run.value(token)
        };
        match value {
            Some(value) => out.push_str(&(value + 0.0).to_string()),
            None => out.push_str(token),
        }
        rest = after;
    }
    out
}

/// A name with what follows it: `CYCLE832(0.1, 1)` and `CYCLE832(0.10,1)` are the same.
pub(crate) fn call_argument(name: &str, text: &str) -> Argument {
    let name = packed(name);
    let text = packed(text);
    let rest = text.strip_prefix(name.as_str()).unwrap_or(&text);
    let Some(inside) = rest
        .strip_prefix('(')
        .map(|inside| inside.strip_suffix(')').unwrap_or(inside))
    else {
        return if rest.is_empty() {
            Argument::code(name)
        } else {
            Argument::text(name, rest)
        };
    };
    let parts = inside.split(',').map(|part| match part.parse::<f64>() {
        Ok(value) if value.is_finite() => (value + 0.0).to_string(),
        _ => part.to_owned(),
    });
    let joined = parts.collect::<Vec<_>>().join(",");
    if joined.is_empty() {
        Argument::code(name)
    } else {
        Argument::text(name, &format!("({joined})"))
    }
}

/// The variables that a text names: `#1`, `#<name>`; of a computed number (`#[#1+2]`) what it is computed from.
pub(crate) fn names(text: &str) -> Vec<String> {
    if !text.contains('#') {
        return Vec::new();
    }
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

/// The known values of the variables that a text names, as arguments named `where #1`.
pub(crate) fn values(text: &str, value: impl Fn(&str) -> Option<f64>) -> Vec<Argument> {
    let named = names(text).into_iter();
    named
        .filter_map(|name| value(&name).map(|value| Argument::number(format!("where {name}"), value)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_variables() {
        assert_eq!(names("X[# 5061 + #<a b>]#[#1+2]"), ["#5061", "#<ab>", "#1"]);
        assert_eq!(names("#"), [] as [&str; 0]);
    }

    #[test]
    fn arguments_of_calls_compare_by_value() {
        assert_eq!(
            call_argument("CYCLE832", "CYCLE832(0.10, 1,)"),
            call_argument("cycle832", "CYCLE832( .1,1.0,)")
        );
        assert_ne!(
            call_argument("CYCLE832", "CYCLE832(0.1)"),
            call_argument("CYCLE832", "CYCLE832(0.2)")
        );
        assert_eq!(call_argument("MCALL", "MCALL"), Argument::code("MCALL"));
    }
}
