//! Edits that write curves in the place of lines: the first block of each curve is changed, the others are deleted.
use crate::chain_words::{Edits, Hand, is_axis, is_number, with_blanks, write_line_code};
use crate::pieces::parsed;
use crate::polyline::Chain;
use crate::spline::{Form, Spline};
use crate::style::NumberStyle;
use trunnion_syntax::{Address, Block, BlockId, Program, TextEdit, TextRange, Word};

/// How curves are written in a program.
pub(crate) struct Pen<'a> {
    pub program: &'a Program,
    pub hand: &'a Hand,
    pub form: Form,
    /// How X, Y and Z are written.
    pub style: NumberStyle,
}

impl Pen<'_> {
    /// Whether the lines between two points of a chain can be written as one block: it has words of an axis to put the curve at, and the point at which
    /// it ends can be written.
    pub(crate) fn takes(&self, chain: &Chain, from: usize, to: usize) -> bool {
        let Some(line) = chain.lines.get(from) else {
            return false;
        };
        let leads = self.program.block(line.block).words().any(|word| is_axis(&word));
        let said = (0..3).all(|axis| {
            let moves = self.form == Form::Handles && axis < 2 || chain.point(from)[axis] != chain.point(to)[axis];
            !moves || self.end(chain, (from, to), axis).is_some()
        });
        leads && said
    }

    /// The number of an axis at the end of a curve: the last one that its lines say, or else that of the point.
    fn end(&self, chain: &Chain, (from, to): (usize, usize), axis: usize) -> Option<String> {
        let letter = Address::Letter(b'X' + axis as u8);
        let mut blocks = chain.lines[from..to]
            .iter()
            .rev()
            .map(|line| self.program.block(line.block));
        let said = blocks.find_map(|block| {
            let word = block.words().filter(|word| word.address == letter).last()?;
            Some(self.program.text(word.value_range).into_owned())
        });
        said.or_else(|| {
            let at = chain.point(to)[axis];
            let text = self.style.write(at / chain.unit_mm, false);
            let read = parsed(&text)? * chain.unit_mm;
            ((read - at).abs() <= 1e-9 * (1.0 + at.abs())).then_some(text)
        })
    }

    /// The edits for chains that follow each other directly, sorted. Empty where nothing changes.
    pub(crate) fn write(&self, chains: &[(&Chain, Vec<Spline>)]) -> Vec<TextEdit> {
        let mut edits = Edits::default();
        // a curve takes the code of a line away
        let mut bends = false;
        for (chain, splines) in chains {
            let mut at = 0;
            for spline in splines {
                if bends && spline.from > at {
                    write_line_code(self.program, self.hand, chain.lines[at].block, &mut edits);
                }
                self.block(chain, spline, &mut edits);
                (at, bends) = (spline.to, true);
            }
            if bends && at < chain.lines.len() {
                write_line_code(self.program, self.hand, chain.lines[at].block, &mut edits);
                bends = false;
            }
        }
        if let (Some(block), true) = (chains.last().and_then(|(chain, _)| chain.next_line), bends) {
            write_line_code(self.program, self.hand, block, &mut edits);
        }
        edits.sorted()
    }

    fn block(&self, chain: &Chain, spline: &Spline, edits: &mut Edits) {
        let blocks: Vec<BlockId> = chain.lines[spline.from..spline.to]
            .iter()
            .map(|line| line.block)
            .collect();
        let Some((&first, rest)) = blocks.split_first() else {
            return;
        };
        let block = self.program.block(first);
        let words: Vec<Word> = block.words().collect();
        let Some(leading) = words.iter().find(|word| is_axis(word)) else {
            return;
        };
        let lower = self.program.source()[leading.range.start as usize].is_ascii_lowercase();
        let text = self.words(chain, spline, lower);
        for word in &words {
            let own_code = word.address == Address::Letter(b'G') && is_number(word, 1);
            if own_code || is_axis(word) && word.range != leading.range {
                edits.delete(with_blanks(self.program, &block, block.range().start, word.range));
            }
        }
        edits.replace(
            self.program,
            leading.range,
            &self.apart_from_others(&block, leading.range, &text),
        );
        edits.delete_blocks(self.program, rest);
    }

    /// A name such as POLY needs a blank to the words beside it.
    fn apart_from_others(&self, block: &Block<'_>, range: TextRange, text: &str) -> String {
        let source = self.program.source();
        let (begin, end) = (block.range().start as usize, block.range().end as usize);
        let (start, stop) = (range.start as usize, range.end as usize);
        let is_word = |byte: Option<&u8>| byte.is_some_and(u8::is_ascii_alphanumeric);
        let before = if is_word(source[begin..start].last()) { " " } else { "" };
        let after = if is_word(source[stop..end].first()) { " " } else { "" };
        format!("{before}{text}{after}")
    }

    fn words(&self, chain: &Chain, spline: &Spline, lower: bool) -> String {
        let ends = (spline.from, spline.to);
        let mut words = Vec::new();
        match self.form {
            Form::Powers => {
                words.push("POLY".to_owned());
                for axis in 0..3 {
                    let letter = char::from(b'X' + axis as u8);
                    let numbers = &spline.numbers[axis];
                    let moves = chain.point(spline.from)[axis] != chain.point(spline.to)[axis];
                    let end = self.end(chain, ends, axis).filter(|_| moves || !numbers.is_empty());
                    match end {
                        Some(end) if numbers.is_empty() => words.push(format!("{letter}{end}")),
                        Some(end) => words.push(format!("PO[{letter}]=({end},{})", numbers.join(","))),
                        None => {}
                    }
                }
            }
            Form::Handles => {
                let case = |letter: char| if lower { letter.to_ascii_lowercase() } else { letter };
                words.push(self.hand.code(5, lower));
                for (axis, letter) in ['X', 'Y'].into_iter().enumerate() {
                    words.extend(self.end(chain, ends, axis).map(|end| format!("{}{end}", case(letter))));
                }
                for (place, letters) in [['I', 'J'], ['P', 'Q']].into_iter().enumerate() {
                    for (axis, letter) in letters.into_iter().enumerate() {
                        words.extend(
                            spline.numbers[axis]
                                .get(place)
                                .map(|number| format!("{}{number}", case(letter))),
                        );
                    }
                }
            }
        }
        words.join(" ")
    }
}
