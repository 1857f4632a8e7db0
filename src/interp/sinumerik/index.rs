//! Targets of the jumps of a Sinumerik file: labels, block numbers, programs after `%_N_NAME_SPF`, control structures.
use super::names::program_key;
use crate::flow::{Broken, Index};
use crate::macro_b::Mistake;
use trunnion_flow::{Key, Loop, Loops};
use trunnion_syntax::{Address, Block, BlockId, Item, Program, TextRange, Value};

/// A control structure that is open.
struct Open {
    keyword: &'static str,
    block: u32,
    range: TextRange,
    other: Option<u32>,
}

/// What opens a structure and what closes it.
const PAIRS: [(&str, &str); 5] = [
    ("IF", "ENDIF"),
    ("LOOP", "ENDLOOP"),
    ("WHILE", "ENDWHILE"),
    ("FOR", "ENDFOR"),
    ("REPEAT", "UNTIL"),
];

#[derive(Default)]
struct Builder {
    labels: Vec<(Key, u32)>,
    programs: Vec<(u32, Key)>,
    open: Vec<Open>,
    loops: Vec<Loop>,
    broken: Vec<Broken>,
}

/// Reads the whole file once.
pub(crate) fn index(program: &Program) -> Index {
    let mut found = Builder::default();
    for block in program.blocks() {
        found.block(program, &block);
    }
    found.unclosed();
    let Builder {
        labels,
        programs,
        loops,
        broken,
        ..
    } = found;
    Index::of(labels, programs, Loops::of(loops), broken, program.block_count() as u32)
}

/// The label that an item writes, `NEXT:` or `:100`.
fn label(text: &str) -> Key {
    let text = text.trim();
    match text.strip_prefix(':').and_then(|number| number.trim().parse().ok()) {
        Some(number) => Key::Number(number),
        None => Key::Name(text.trim_end_matches(':').trim().to_ascii_uppercase().into()),
    }
}

impl Builder {
    fn block(&mut self, program: &Program, block: &Block<'_>) {
        let BlockId(at) = block.id();
        let mut skipped = false;
        for item in block.items() {
            match item {
                Item::Skip(..) => skipped = true,
                Item::Label(range) => self.labels.push((label(&program.text(range)), at)),
                Item::Percent(range) if range.end - range.start > 1 => {
                    self.unclosed();
                    self.programs.push((at, program_key(&program.text(range))));
                }
                Item::Word(word) => match (word.address, word.value) {
                    (Address::Letter(b'N'), Value::Number(number)) => {
                        let number = number.to_f64();
                        if number >= 0.0 && number.fract() == 0.0 && number <= f64::from(u32::MAX) {
                            self.labels.push((Key::Number(number as u32), at));
                        }
                    }
                    _ => return,
                },
                Item::Call(call) => return self.keyword(program, block, program.bytes(call.name), call.range, skipped),
                Item::Comment(_) | Item::Percent(_) => {}
                Item::Other(_) => return,
            }
        }
    }

    fn keyword(&mut self, program: &Program, block: &Block<'_>, name: &[u8], range: TextRange, skipped: bool) {
        let at = block.id().0;
        let is = |keyword: &str| name.eq_ignore_ascii_case(keyword.as_bytes());
        let is_jump = |item: &Item| matches!(item, Item::Call(call) if is_goto(program.bytes(call.name)));
        if let Some(&(keyword, _)) = PAIRS.iter().find(|(open, _)| is(open)) {
            let jumps = keyword == "IF" && block.items().any(|item| is_jump(&item));
            let behind = |item: &Item| match item {
                Item::Call(call) => call.range.start > range.start,
                Item::Word(word) => word.range.start > range.start,
                Item::Other(other) => other.start > range.start,
                _ => false,
            };
            let repeats = keyword == "REPEAT" && block.items().any(|item| behind(&item));
            if jumps || repeats {
                return;
            }
            if skipped {
                let message = format!("{keyword} in a block with `/`: control structures cannot be skipped");
                return self.broken(at, range, message);
            }
            self.open.push(Open {
                keyword,
                block: at,
                range,
                other: None,
            });
        } else if is("ELSE") {
            match self.open.last_mut() {
                Some(open) if open.keyword == "IF" && open.other.is_none() => open.other = Some(at),
                _ => self.broken(at, range, "ELSE without its IF".to_owned()),
            }
        } else if let Some(&(keyword, close)) = PAIRS.iter().find(|(_, close)| is(close)) {
            if self.open.last().is_some_and(|open| open.keyword == keyword) && !skipped {
                let Some(open) = self.open.pop() else { return };
                self.loops.push(Loop {
                    open: open.block,
                    close: at,
                    other: open.other,
                });
            } else {
                self.broken(at, range, format!("{close} without its {keyword}"));
            }
        }
    }

    fn unclosed(&mut self) {
        for open in std::mem::take(&mut self.open) {
            let close = PAIRS.iter().find(|(keyword, _)| *keyword == open.keyword);
            let close = close.map_or("", |pair| pair.1);
            let message = format!("the {close} of this {} is missing", open.keyword);
            self.broken(open.block, open.range, message);
        }
    }

    fn broken(&mut self, block: u32, range: TextRange, message: String) {
        self.broken.push(Broken {
            block,
            range,
            mistake: Mistake::Unnumbered,
            message,
        });
    }
}

fn is_goto(name: &[u8]) -> bool {
    let known: [&[u8]; 5] = [b"GOTO", b"GOTOF", b"GOTOB", b"GOTOC", b"GOTOS"];
    known.iter().any(|known| name.eq_ignore_ascii_case(known))
}
