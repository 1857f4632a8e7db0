//! Targets of the jumps of a program: sequence numbers, programs in the file, loops.
use super::alarms::Mistake;
use super::name::bracketed;
use crate::flow::{Broken, Index};
use trunnion_flow::{Key, Loop, Loops};
use trunnion_syntax::{Address, Block, BlockId, Call, Item, Program, TextRange, Value};

/// What is found while a file is read.
#[derive(Default)]
struct Builder {
    labels: Vec<(Key, u32)>,
    programs: Vec<(u32, Key)>,
    loops: Vec<Loop>,
    broken: Vec<Broken>,
}

/// A DO whose END was not read yet.
struct Open {
    number: u32,
    block: u32,
    range: TextRange,
}

/// Reads the whole file once.
pub(crate) fn index(program: &Program) -> Index {
    let mut found = Builder::default();
    let mut open = Vec::new();
    for block in program.blocks() {
        found.block(program, &block, &mut open);
    }
    found.unclosed(&mut open);
    let Builder {
        labels,
        programs,
        loops,
        broken,
    } = found;
    Index::of(labels, programs, Loops::of(loops), broken, program.block_count() as u32)
}

impl Builder {
    fn block(&mut self, program: &Program, block: &Block<'_>, open: &mut Vec<Open>) {
        let BlockId(at) = block.id();
        // O begins a program at the beginning of a block alone: within it O is a slip for 0
        let mut first = true;
        for item in block.items() {
            let is_first = first;
            first &= match item {
                Item::Word(word) => word.address == Address::Letter(b'N'),
                Item::Comment(_) | Item::Skip(..) | Item::Percent(_) => true,
                _ => false,
            };
            match item {
                Item::Word(word) if word.address == Address::Letter(b'O') && !is_first => {}
                Item::Word(word) => match (word.address, word.value) {
                    (Address::Letter(b'N'), Value::Number(number)) => {
                        if let Some(number) = whole(number) {
                            self.labels.push((Key::Number(number), at));
                        }
                    }
                    (Address::Letter(b'O'), Value::Number(number)) => {
                        self.unclosed(open);
                        self.programs
                            .extend(whole(number).map(|number| (at, Key::Number(number))));
                    }
                    (Address::Letter(b'O'), Value::Expression(range)) => {
                        self.unclosed(open);
                        let name = bracketed(program.bytes(range));
                        self.programs.extend(name.map(|name| (at, name)));
                    }
                    _ => {}
                },
                Item::Label(range) => {
                    let number = core::str::from_utf8(program.bytes(range))
                        .ok()
                        .and_then(|text| text.strip_prefix(':')?.parse().ok());
                    if let Some(number) = number {
                        self.unclosed(open);
                        self.programs.push((at, Key::Number(number)));
                    }
                }
                Item::Call(call) => self.call(program, at, &call, open),
                _ => {}
            }
        }
    }

    fn call(&mut self, program: &Program, at: u32, call: &Call, open: &mut Vec<Open>) {
        let name = program.bytes(call.name);
        let opens = name.eq_ignore_ascii_case(b"DO");
        if !opens && !name.eq_ignore_ascii_case(b"END") {
            return;
        }
        let range = call.range;
        let Some(number) = loop_number(program, call) else {
            let message = "loops have the numbers 1, 2 and 3".to_owned();
            self.broken(at, range, Mistake::LoopNumber, message);
            return;
        };
        let inside = open.iter().position(|open| open.number == number);
        match (opens, inside) {
            (true, None) => open.push(Open {
                number,
                block: at,
                range,
            }),
            (true, Some(_)) => {
                let message =
                    format!("DO{number} is inside a loop of the same number; the END{number} of that loop is missing");
                self.broken(at, range, Mistake::EndMissing, message);
            }
            (false, Some(place)) if place + 1 == open.len() => {
                let block = open[place].block;
                open.truncate(place);
                self.loops.push(Loop {
                    open: block,
                    close: at,
                    other: None,
                });
            }
            (false, Some(place)) => {
                let inner = open[place + 1].number;
                let message = format!("loops cross: END{number} is inside the loop DO{inner}, which has not ended yet");
                open.truncate(place);
                self.broken(at, range, Mistake::EndMissing, message);
            }
            (false, None) => {
                let message = format!("END{number} without DO{number}");
                self.broken(at, range, Mistake::Unnumbered, message);
            }
        }
    }

    fn unclosed(&mut self, open: &mut Vec<Open>) {
        for open in open.drain(..) {
            let message = format!("the END{0} of this DO{0} is missing", open.number);
            self.broken(open.block, open.range, Mistake::EndMissing, message);
        }
    }

    fn broken(&mut self, block: u32, range: TextRange, mistake: Mistake, message: String) {
        self.broken.push(Broken {
            block,
            range,
            mistake,
            message,
        });
    }
}

fn loop_number(program: &Program, call: &Call) -> Option<u32> {
    let text = core::str::from_utf8(program.bytes(call.arguments?)).ok()?;
    text.trim().parse().ok().filter(|number| (1..=3).contains(number))
}

/// A number without fraction.
fn whole(number: trunnion_syntax::Decimal) -> Option<u32> {
    let value = number.to_f64();
    (value >= 0.0 && value.fract() == 0.0 && value <= f64::from(u32::MAX)).then_some(value as u32)
}
