//! Lints of words, codes and marks: what the tables of the two dialects say differently.
use super::line::Line;
use super::{Hit, Route};
use trunnion_dialect::{Code, CodeKind, Dialect, Expressions, Role};
use trunnion_syntax::{Address, Item, TextRange, Value, Word};

fn hit(range: TextRange, message: String, help: &'static str, once: Option<&'static str>) -> Hit {
    Hit {
        range,
        message,
        help,
        once,
    }
}

/// A code's number in tenths, where the word is one.
fn tenths(word: &Word) -> Option<(CodeKind, u32)> {
    let kind = match word.address {
        Address::Letter(b'G') => CodeKind::G,
        Address::Letter(b'M') => CodeKind::M,
        _ => return None,
    };
    let Value::Number(number) = word.value else { return None };
    let tenths = number.to_f64() * 10.0;
    ((0.0..10_000.0).contains(&tenths) && tenths.fract() == 0.0).then_some((kind, tenths as u32))
}

fn code<'d>(dialect: &'d Dialect, word: &Word) -> Option<&'d Code> {
    let (kind, tenths) = tenths(word)?;
    if kind == CodeKind::G {
        dialect.g(tenths)
    } else {
        dialect.m(tenths)
    }
}

/// Two codes of one group of the target: it refuses what the source lets pass, or groups otherwise.
pub(super) fn same_group(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    if route.to.quirks.last_code_wins {
        return;
    }
    let mut seen: Vec<(&Code, &str)> = Vec::new();
    for word in line.block.words() {
        let Some(found) = code(route.to, &word) else { continue };
        let Some(group) = found.group.as_deref() else { continue };
        let earlier = seen
            .iter()
            .find(|(other, known)| *known == group && other.id != found.id);
        if let Some((other, _)) = earlier
            && !clashes_here(route.from, &other.id, &word)
        {
            hits.push(hit(
                word.range,
                format!(
                    "{} and {} must not be in the same block: both belong to the group `{group}`",
                    other.id, found.id
                ),
                "write them in two blocks",
                None,
            ));
        }
        seen.push((found, group));
    }
}

/// Whether the source's own table says that the two codes exclude each other, and refuses them: then its own rule reports it.
fn clashes_here(from: &Dialect, other: &str, word: &Word) -> bool {
    let group = |code: Option<&Code>| code.and_then(|code| code.group.clone());
    let first = from.codes().iter().find(|code| code.id == other);
    let same = first.is_some() && group(first).is_some() && group(first) == group(code(from, word));
    same && !from.quirks.last_code_wins
}

/// A word twice: the last one wins here, the target refuses the block.
pub(super) fn repeated_word(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    if route.languages.1 != Expressions::Rs274Ngc || !route.from.quirks.last_code_wins {
        return;
    }
    let mut seen = 0u32;
    for word in line.block.words() {
        let Address::Letter(letter @ b'A'..=b'Z') = word.address else {
            continue;
        };
        if matches!(letter, b'G' | b'M' | b'O') {
            continue;
        }
        let bit = 1 << (letter - b'A');
        if seen & bit != 0 {
            let name = char::from(letter);
            hits.push(hit(
                word.range,
                format!("a second {name} word in a block is refused; here the last one wins"),
                "remove the one that has no effect",
                None,
            ));
        }
        seen |= bit;
    }
}

/// A code that the target's table lacks.
pub(super) fn unknown_code(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    for word in line.block.words() {
        let Some((kind, number)) = tenths(&word) else { continue };
        let (Some(here), None) = (code(route.from, &word), code(route.to, &word)) else {
            continue;
        };
        if route.to.builder_may_own(kind, number) {
            continue;
        }
        hits.push(hit(
            word.range,
            format!("there is no {}; here it means \"{}\"", here.id, here.doc),
            "find out how that control programs this",
            None,
        ));
    }
}

/// P of a dwell: milliseconds or seconds.
pub(super) fn dwell_unit(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    if route.from.quirks.dwell_in_ms == route.to.quirks.dwell_in_ms {
        return;
    }
    if !line.block.words().any(|word| tenths(&word) == Some((CodeKind::G, 40))) {
        return;
    }
    let (there, help) = if route.to.quirks.dwell_in_ms {
        (
            "P of G4 without a decimal point is in milliseconds; here it is in seconds",
            "multiply the number by 1000",
        )
    } else {
        (
            "P of G4 is in seconds; here P without a decimal point is in milliseconds",
            "divide the number by 1000",
        )
    };
    let times = line.block.words().filter(|word| word.address == Address::Letter(b'P'));
    hits.extend(times.map(|word| hit(word.range, there.to_owned(), help, None)));
}

/// `/` inside a block deletes the rest of it on Fanuc; RS274/NGC refuses it there.
pub(super) fn skip_inside(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    if route.languages.1 != Expressions::Rs274Ngc {
        return;
    }
    let mut depth = 0i32;
    let mut begun = false;
    for (at, &byte) in line.text.iter().enumerate() {
        match byte {
            b'[' => depth += 1,
            b']' => depth -= 1,
            b'/' if begun && depth == 0 => {
                hits.push(hit(
                    line.range(at, 1),
                    "`/` is allowed only at the start of a block".to_owned(),
                    "write the part that may be skipped as a separate block",
                    None,
                ));
                return;
            }
            _ => {}
        }
        begun |= !byte.is_ascii_whitespace();
    }
}

/// Coordinates without a decimal point, to a control where a parameter says what that means.
pub(super) fn implicit_decimal(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    if !route.to.quirks.whole_numbers.lengths_ambiguous() || route.from.quirks.whole_numbers.lengths_ambiguous() {
        return;
    }
    let whole = line.block.words().find(|word| {
        let sized = match word.address {
            Address::Letter(letter) => {
                matches!(
                    route.to.role(letter),
                    Some(Role::Axis | Role::ArcRadius | Role::ArcCentre)
                )
            }
            _ => false,
        };
        sized && matches!(word.value, Value::Number(number) if !number.has_point && number.mantissa != 0)
    });
    if let Some(word) = whole {
        let text = line.block.program().text(word.range).into_owned();
        hits.push(hit(
            word.range,
            format!("a parameter decides whether `{text}` means millimetres or thousandths of a millimetre"),
            "write a decimal point in every coordinate",
            Some("decimal"),
        ));
    }
}

/// Comments in marks that the target does not have.
pub(super) fn comment_marks(line: &Line<'_>, route: &Route<'_>, hits: &mut Vec<Hit>) {
    for item in line.block.items() {
        let Item::Comment(comment) = item else { continue };
        let source = line.block.program().source();
        let (strange, message, key) = match source.get(comment.range.start as usize) {
            Some(b';') => (
                !route.to.lex.semicolon_comment,
                "`;` does not begin a comment: it ends the block, and what follows is read as words",
                "semicolon",
            ),
            Some(b'(') => (!route.to.lex.paren_comment, "`( )` is not a comment", "parenthesis"),
            _ => continue,
        };
        if strange {
            let help = "use the comment marks of that control";
            hits.push(hit(comment.range, message.to_owned(), help, Some(key)));
        }
    }
}
