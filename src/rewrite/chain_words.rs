//! Edits that write lines and arcs in the place of a chain of lines: the first block of each piece is changed, the others are deleted.
use crate::pieces::{Beside, Piece, WrittenArc};
use crate::polyline::Chain;
use crate::style::newline;
use trunnion_dialect::Plane;
use trunnion_geometry::arc::Turning;
use trunnion_syntax::{Address, Block, BlockId, Program, TextEdit, TextRange, Value, Word};

/// How the program writes codes and blanks.
pub(crate) struct Hand {
    /// `G01`.
    two_digits: bool,
    /// Of line ends.
    newline: &'static str,
}

impl Hand {
    pub(crate) fn of(program: &Program) -> Self {
        let two_digits = program
            .blocks()
            .flat_map(|block| block.words().collect::<Vec<_>>())
            .find_map(|word| {
                let text = program.text(word.value_range);
                (word.address == Address::Letter(b'G') && is_number(&word, 1)).then(|| text.starts_with('0'))
            });
        Self {
            two_digits: two_digits.unwrap_or(false),
            newline: newline(program.source()),
        }
    }

    pub(crate) fn code(&self, number: u8, lower: bool) -> String {
        let letter = if lower { 'g' } else { 'G' };
        if self.two_digits {
            format!("{letter}{number:02}")
        } else {
            format!("{letter}{number}")
        }
    }
}

pub(crate) fn is_number(word: &Word, number: i64) -> bool {
    matches!(word.value, Value::Number(value) if value.to_integer() == Some(number))
}

fn plane_code(plane: Plane) -> u8 {
    match plane {
        Plane::Xy => 17,
        Plane::Zx => 18,
        Plane::Yz => 19,
    }
}

/// So many edits are made for one block at most before its other lines are deleted.
const LATEST: usize = 32;

/// Edits of one block: insertions at one place stay in their order.
#[derive(Default)]
pub(crate) struct Edits(Vec<TextEdit>);

impl Edits {
    pub(crate) fn replace(&mut self, program: &Program, range: TextRange, new_text: &str) {
        if program.text(range) != new_text {
            self.0.push(TextEdit {
                range,
                new_text: new_text.to_owned(),
            });
        }
    }

    pub(crate) fn delete_blocks(&mut self, program: &Program, blocks: &[BlockId]) {
        self.0.extend(blocks.iter().map(|block| TextEdit {
            range: TextRange::new(program.block(*block).range().start, start_of_next(program, *block)),
            new_text: String::new(),
        }));
    }

    pub(crate) fn delete(&mut self, range: TextRange) {
        self.0.push(TextEdit {
            range,
            new_text: String::new(),
        });
    }

    /// All, in the order of the text.
    pub(crate) fn sorted(mut self) -> Vec<TextEdit> {
        self.0.sort_by_key(|edit| (edit.range.start, edit.range.end));
        self.0
    }

    fn insert(&mut self, at: u32, new_text: &str) {
        let range = TextRange::new(at, at);
        // other insertions at this place were made just before: a search of all would take quadratic time
        match self.0.iter_mut().rev().take(LATEST).find(|edit| edit.range == range) {
            Some(edit) => edit.new_text.push_str(new_text),
            None => self.0.push(TextEdit {
                range,
                new_text: new_text.to_owned(),
            }),
        }
    }
}

/// The edits that write the pieces of chains that follow each other directly, sorted. Empty where nothing changes.
pub(crate) fn write(program: &Program, hand: &Hand, chains: &[(&Chain, Vec<Piece>)]) -> Vec<TextEdit> {
    let mut edits = Edits::default();
    // an arc is the modal motion: the next line needs a G1
    let mut turns = false;
    for (chain, pieces) in chains {
        let mut plane = chain.plane;
        let mut before: Option<&Beside> = None;
        for (index, piece) in pieces.iter().enumerate() {
            let blocks: Vec<BlockId> = chain.lines[piece.from..piece.to]
                .iter()
                .map(|line| line.block)
                .collect();
            let (mut codes, mut centre) = (Vec::new(), &[][..]);
            if let Some(WrittenArc {
                plane: own,
                turning,
                centre: words,
            }) = &piece.arc
            {
                if *own != plane {
                    codes.push(plane_code(*own));
                    plane = *own;
                }
                codes.push(if *turning == Turning::Clockwise { 2 } else { 3 });
                centre = words;
                turns = true;
            } else {
                if index + 1 == pieces.len() && plane != chain.plane {
                    codes.push(plane_code(chain.plane));
                    plane = chain.plane;
                }
                if turns {
                    codes.push(1);
                    turns = false;
                }
            }
            let at = |index: usize, beside: Option<&Beside>| beside.map_or(chain.point(index), |beside| beside.at);
            let ends = (at(piece.from, before), at(piece.to, piece.beside.as_ref()));
            let still = [0, 1, 2].map(|axis| ends.0[axis] == ends.1[axis]);
            before = piece.beside.as_ref();
            write_block(program, hand, &blocks, (&codes, centre, still), before, &mut edits);
        }
        if let (Some(last), true) = (chain.lines.last(), plane != chain.plane) {
            let line = format!("{}{}", hand.code(plane_code(chain.plane), false), hand.newline);
            edits.insert(start_of_next(program, last.block), &line);
        }
    }
    if let (Some(block), true) = (chains.last().and_then(|(chain, _)| chain.next_line), turns) {
        write_block(program, hand, &[block], (&[1], &[], [false; 3]), None, &mut edits);
    }
    edits.sorted()
}

/// The edits that write `pieces` of a chain, all lines, without words that repeat what is in effect, sorted.
pub(crate) fn lean(program: &Program, hand: &Hand, chain: &Chain, pieces: &[Piece]) -> Vec<TextEdit> {
    let mut edits = Edits::default();
    for piece in pieces {
        let blocks: Vec<BlockId> = chain.lines[piece.from..piece.to]
            .iter()
            .map(|line| line.block)
            .collect();
        let still = chain.still(piece.from, piece.to);
        let first = program.block(blocks[0]);
        let words: Vec<Word> = first.words().collect();
        if still == [true; 3] && piece.from > 0 {
            edits.delete_blocks(program, &blocks);
            continue;
        }
        let mut own = Edits::default();
        write_block(program, hand, &blocks, (&[], &[], still), None, &mut own);
        let repeats = |word: &&Word| match word.address {
            Address::Letter(letter @ b'X'..=b'Z') => still[usize::from(letter - b'X')],
            // at the first line of a chain they may say something new
            Address::Letter(b'F') => piece.from > 0,
            Address::Letter(b'G') => piece.from > 0 && is_number(word, 1),
            _ => false,
        };
        let axis_stays = words.iter().any(|word| is_axis(word) && !repeats(&word))
            || own.0.iter().any(|edit| edit.range.start == edit.range.end);
        if axis_stays {
            let mut deleted = first.range().start;
            for word in words.iter().filter(repeats) {
                own.0.retain(|edit| edit.range != word.value_range);
                let range = with_blanks(program, &first, deleted, word.range);
                deleted = range.end;
                own.0.push(TextEdit {
                    range,
                    new_text: String::new(),
                });
            }
        }
        edits.0.append(&mut own.0);
    }
    edits.0.sort_by_key(|edit| (edit.range.start, edit.range.end));
    edits.0
}

/// Gives a line the code of a line, which another motion code before it has taken away.
pub(crate) fn write_line_code(program: &Program, hand: &Hand, block: BlockId, edits: &mut Edits) {
    write_block(program, hand, &[block], (&[1], &[], [false; 3]), None, edits);
}

/// The word with the blanks before it; at the start of a block with those after it. What is before `deleted` is deleted already.
pub(crate) fn with_blanks(program: &Program, block: &Block<'_>, deleted: u32, range: TextRange) -> TextRange {
    let source = program.source();
    let is_blank = |byte: &&u8| **byte == b' ' || **byte == b'\t';
    let (begin, end) = (deleted as usize, block.range().end as usize);
    let before = source[begin..range.start as usize]
        .iter()
        .rev()
        .take_while(is_blank)
        .count() as u32;
    if range.start - before > deleted || deleted > block.range().start && before > 0 {
        return TextRange::new(range.start - before, range.end);
    }
    let after = source[range.end as usize..end].iter().take_while(is_blank).count() as u32;
    TextRange::new(range.start, range.end + after)
}

/// Where the block after this one begins.
fn start_of_next(program: &Program, block: BlockId) -> u32 {
    let tokens = program.block(block).tokens();
    program.tokens().range(tokens.end - 1).end
}

/// Writes one motion in the place of those of `blocks`: with these G codes, the coordinates at which the last one ends but for those that stay, and a
/// centre; with the words of an end beside that of the last block.
fn write_block(
    program: &Program,
    hand: &Hand,
    blocks: &[BlockId],
    (codes, centre, still): (&[u8], &[(usize, String)], [bool; 3]),
    beside: Option<&Beside>,
    edits: &mut Edits,
) {
    let Some((&first, rest)) = blocks.split_first() else {
        return;
    };
    let block = program.block(first);
    let words: Vec<Word> = block.words().collect();
    let coordinates: Vec<&Word> = words.iter().filter(|word| is_axis(word)).collect();
    let Some(leading) = coordinates.first() else { return };
    let blank = blank_between(program, &block);
    let lower = program.source()[leading.range.start as usize].is_ascii_lowercase();
    let own_code = words
        .iter()
        .find(|word| word.address == Address::Letter(b'G') && is_number(word, 1));
    let codes: Vec<String> = codes
        .iter()
        .filter(|code| !(**code == 1 && own_code.is_some()))
        .map(|code| hand.code(*code, lower))
        .collect();
    match own_code {
        Some(word) if codes.last().is_some_and(|code| !code.ends_with(['7', '8', '9'])) => {
            edits.replace(program, word.range, &codes.join(blank));
        }
        _ => {
            for code in &codes {
                edits.insert(leading.range.start, &format!("{code}{blank}"));
            }
        }
    }
    // `X=10` of a Sinumerik: so are the others
    let equals = if program.bytes(leading.range).contains(&b'=') {
        "="
    } else {
        ""
    };
    // the last number of each axis
    let mut last: [Option<Word>; 3] = [None; 3];
    for word in rest.iter().flat_map(|block| program.block(*block).words()) {
        if let Address::Letter(letter @ b'X'..=b'Z') = word.address {
            last[usize::from(letter - b'X')] = Some(word);
        }
    }
    for (axis, word) in last.iter().enumerate() {
        let letter = b'X' + axis as u8;
        let own = coordinates.iter().find(|own| own.address == Address::Letter(letter));
        let aside = beside.and_then(|beside| {
            let (_, text) = beside.words.iter().find(|(other, _)| *other == axis)?;
            (!beside.is_point || word.is_none() && own.is_none()).then_some(text)
        });
        let number = match (aside, word) {
            (Some(text), _) => text.clone(),
            (None, Some(word)) => program.text(word.value_range).into_owned(),
            (None, None) => continue,
        };
        match own {
            Some(own) => edits.replace(program, own.value_range, &number),
            // where it does not change, no word says so
            None if still[axis] => {}
            None => {
                let before = coordinates
                    .iter()
                    .rev()
                    .find(|own| matches!(own.address, Address::Letter(other) if other < letter));
                let text = match word {
                    Some(word) if aside.is_none() => program.text(word.range).into_owned(),
                    _ if lower => format!("{}{equals}{number}", char::from(letter.to_ascii_lowercase())),
                    _ => format!("{}{equals}{number}", char::from(letter)),
                };
                match before {
                    Some(own) => edits.insert(own.range.end, &format!("{blank}{text}")),
                    None => edits.insert(leading.range.start, &format!("{text}{blank}")),
                }
            }
        }
    }
    if let Some(end) = coordinates.last().map(|word| word.range.end) {
        for (axis, number) in centre {
            let letter = char::from(b"IJK"[*axis]);
            let letter = if lower { letter.to_ascii_lowercase() } else { letter };
            edits.insert(end, &format!("{blank}{letter}{equals}{number}"));
        }
    }
    edits.delete_blocks(program, rest);
}

pub(crate) fn is_axis(word: &Word) -> bool {
    matches!(word.address, Address::Letter(b'X'..=b'Z' | b'A'..=b'C' | b'U'..=b'W'))
}

/// A blank where words of the block are separated, or, if it has only one, those of the program.
fn blank_between(program: &Program, block: &Block<'_>) -> &'static str {
    let ranges: Vec<TextRange> = block.words().map(|word| word.range).collect();
    let separated = match ranges.windows(2).next() {
        Some(pair) => pair[0].end != pair[1].start,
        None => program
            .source()
            .windows(2)
            .any(|pair| pair[0] == b' ' && b"XYZxyz".contains(&pair[1])),
    };
    if separated { " " } else { "" }
}
