//! Which bytes of two texts differ: numbers of coordinate words, or more than that.
use crate::certificate::TextChange;
use trunnion_dialect::{Dialect, Role};
use trunnion_interp::{AxisLetter, turned_deg};
use trunnion_syntax::{Address, AptArg, Block, Format, Program, TextRange, Value};

/// A coordinate word of a block: its name, its bytes, and those of its number.
struct Coordinate {
    name: (u8, u16),
    word: TextRange,
    number: TextRange,
}

/// Coordinates of a block: words of axes and tool vectors with plain numbers; APT: the numbers of GOTO.
fn coordinates(block: &Block<'_>, dialect: &Dialect) -> Vec<Coordinate> {
    if dialect.lex.format == Format::Apt {
        let Some(record) = block.record().filter(|record| record.is("GOTO")) else {
            return Vec::new();
        };
        let numbers = record.args().filter_map(|arg| {
            if let AptArg::Number(_, range) = arg {
                Some(range)
            } else {
                None
            }
        });
        return numbers
            .zip(0u16..)
            .map(|(range, i)| Coordinate {
                name: (0, i),
                word: range,
                number: range,
            })
            .collect();
    }
    let words = block.words().filter(|word| matches!(word.value, Value::Number(_)));
    words
        .filter_map(|word| {
            let name = coordinate_name(word.address, dialect)?;
            Some(Coordinate {
                name,
                word: word.range,
                number: word.value_range,
            })
        })
        .collect()
}

/// Letter and index of a coordinate word; `None` for other words.
fn coordinate_name(address: Address, dialect: &Dialect) -> Option<(u8, u16)> {
    match address {
        Address::Letter(letter) => match dialect.role(letter)? {
            Role::Axis => AxisLetter::new(letter).map(|axis| (axis.letter(), 0)),
            Role::ArcCentre => Some((letter, 0)),
            _ => None,
        },
        Address::Indexed(letter, 3) if matches!(letter, b'A' | b'B' | b'C') => Some((letter, 3)),
        _ => None,
    }
}

/// Compares two texts block by block.
pub(crate) fn text_change(before: &Program, after: &Program, dialect: &Dialect) -> TextChange {
    let mut change = TextChange {
        rest_identical: true,
        ..TextChange::default()
    };
    if before.source() == after.source() {
        return change;
    }
    if before.block_count() != after.block_count() {
        return TextChange::default();
    }
    for (old, new) in before.blocks().zip(after.blocks()) {
        let (old_bytes, new_bytes) = (bytes(before, old.range()), bytes(after, new.range()));
        if old_bytes != new_bytes && !compare_block(&old, &new, dialect, &mut change) {
            return TextChange::default();
        }
    }
    // line ends lie between the blocks
    if line_ends(before) == line_ends(after) {
        change
    } else {
        TextChange::default()
    }
}

fn bytes(program: &Program, range: TextRange) -> &[u8] {
    &program.source()[range.as_usize()]
}

/// The text between the blocks, before the first and after the last.
fn line_ends(program: &Program) -> Vec<u8> {
    let mut out = Vec::new();
    let mut at = 0;
    for block in program.blocks() {
        let range = block.range().as_usize();
        out.extend_from_slice(program.source().get(at..range.start).unwrap_or_default());
        at = range.end;
    }
    out.extend_from_slice(program.source().get(at..).unwrap_or_default());
    out
}

/// The comment of a block that says how far tool axes were turned (`trunnion: turned`): its bytes with one blank before it, and the angle, deg.
fn turned(block: &Block<'_>) -> Option<(TextRange, f64)> {
    let program = block.program();
    let comments = block.comments();
    let mut found = comments.filter_map(|comment| Some((comment.range, turned_deg(&program.text(comment.inner))?)));
    let (range, deg) = found.next()?;
    let before = &program.source()[block.range().start as usize..range.start as usize];
    let start = range.start - u32::from(before.last() == Some(&b' '));
    Some((TextRange::new(start, range.end), deg))
}

/// Counts what differs in a block; false if it is more than numbers of coordinate words, new ones, and what is said about turned tool axes:
/// that may be added or raised.
fn compare_block(old: &Block<'_>, new: &Block<'_>, dialect: &Dialect, change: &mut TextChange) -> bool {
    let (old_words, new_words) = (coordinates(old, dialect), coordinates(new, dialect));
    let (was, is) = (old.program(), new.program());
    let added = |word: &&Coordinate| !old_words.iter().any(|other| other.name == word.name);
    let (was_turned, is_turned) = (turned(old), turned(new));
    let forgotten = was_turned.is_some_and(|(_, was)| is_turned.is_none_or(|(_, is)| is < was));
    let holes = old_words.iter().map(|word| word.number);
    let bare_old = without(was, old.range(), holes.chain(was_turned.map(|(range, _)| range)));
    let removals = new_words.iter().map(|word| {
        if added(&word) {
            with_blanks(is, word.word)
        } else {
            word.number
        }
    });
    let removals = removals.chain(is_turned.map(|(range, _)| range));
    if forgotten || bare_old != without(is, new.range(), removals) {
        return false;
    }
    let kept = new_words.iter().filter(|word| !added(word));
    for (word, other) in kept.zip(&old_words) {
        if word.name != other.name {
            return false;
        }
        if bytes(is, word.number) != bytes(was, other.number) {
            change.numbers_changed += 1;
            change.bytes_changed += u64::from(other.number.end - other.number.start);
        }
    }
    change.words_inserted += new_words.iter().filter(added).count() as u64;
    true
}

/// The range with the blanks before it.
fn with_blanks(program: &Program, range: TextRange) -> TextRange {
    let before = &program.source()[..range.start as usize];
    let blanks = before
        .iter()
        .rev()
        .take_while(|&&byte| byte == b' ' || byte == b'\t')
        .count();
    TextRange::new(range.start - blanks as u32, range.end)
}

/// The bytes of `range` without the ranges inside it.
fn without(program: &Program, range: TextRange, holes: impl Iterator<Item = TextRange>) -> Vec<u8> {
    let mut out = Vec::new();
    let mut at = range.start;
    let mut holes: Vec<TextRange> = holes.collect();
    holes.sort_by_key(|hole| hole.start);
    for hole in holes {
        if hole.start >= at && hole.end <= range.end {
            out.extend_from_slice(bytes(program, TextRange::new(at, hole.start)));
            at = hole.end;
        }
    }
    out.extend_from_slice(bytes(program, TextRange::new(at, range.end)));
    out
}

#[cfg(test)]
mod tests {
    use super::text_change;
    use trunnion_syntax::parse;

    fn rest_identical(dialect: &str, before: &str, after: &str) -> bool {
        let dialect = trunnion_dialect::builtin(dialect).expect("built in");
        let [before, after] = [before, after].map(|text| parse(text.as_bytes().to_vec(), dialect.lex));
        text_change(&before, &after, dialect).rest_identical
    }

    #[test]
    fn what_was_turned_may_be_added_and_raised_and_nothing_else() {
        let fanuc = |before: &str, after: &str| rest_identical("fanuc-30i", before, after);
        assert!(fanuc("G1 X1 Y2\n", "G1 X1.5 Y2 (trunnion: turned 0.1)\n"));
        assert!(fanuc("G1 X1 \n", "G1 X1  (trunnion: turned 0.1)\n"));
        assert!(fanuc(
            "G1 X1 (trunnion: turned 0.1)\n",
            "G1 X2 (trunnion: turned 0.2)\n"
        ));
        assert!(fanuc("G1 X1 (a)\n", "G1 X1 Z2 (a) (trunnion: turned 0.1)\n"));
        assert!(rest_identical(
            "sinumerik-840d",
            "G1 X1\nX2\n",
            "G1 X1 ; trunnion: turned 0.1\nX2\n"
        ));
        assert!(rest_identical(
            "apt",
            "GOTO/1,2,3\n",
            "GOTO/1,2,4 $$ trunnion: turned 0.1\n"
        ));
        for (before, after) in [
            ("G1 X1\n", "G1 X1 (trunnion: turned 0.1) M8\n"),
            ("G1 X1\n", "G1 X1 (trunnion: tool 1 ball diameter 10)\n"),
            ("G1 X1\n", "G1 X1 (turned 0.1)\n"),
            ("G1 X1\n", "G1 X1 (trunnion: turned 0.1 deg)\n"),
            ("G1 X1 (trunnion: turned 0.2)\n", "G1 X2 (trunnion: turned 0.1)\n"),
            ("G1 X1 (trunnion: turned 0.2)\n", "G1 X2\n"),
        ] {
            assert!(!fanuc(before, after), "{after}");
        }
    }
}
