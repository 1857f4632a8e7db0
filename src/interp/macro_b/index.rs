//! Where jumps of a program may lead: sequence numbers, programs in the file, loops. Built once, when the first jump needs it.
use super::ProgramName;
use super::alarms::Mistake;
use trunnion_syntax::{Address, Block, BlockId, Call, Item, Program, TextRange, Value};

/// A loop: the blocks of its DO and of its END.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Loop {
    pub(crate) open: u32,
    pub(crate) close: u32,
}

/// A mistake in the structure of the file, with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Broken {
    pub(crate) block: u32,
    pub(crate) range: TextRange,
    pub(crate) mistake: Mistake,
    pub(crate) message: String,
}

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Index {
    /// Sequence number and block, sorted.
    labels: Vec<(u32, u32)>,
    /// First block and name of each program of the file.
    programs: Vec<(u32, ProgramName)>,
    /// Sorted by the opening block.
    loops: Vec<Loop>,
    /// Place in `loops` of the loop around each loop.
    around: Vec<Option<usize>>,
    /// Closing and opening block of each loop, sorted.
    ends: Vec<(u32, u32)>,
    /// What is wrong with DO and END.
    pub(crate) broken: Vec<Broken>,
    blocks: u32,
}

/// A DO that waits for its END.
struct Open {
    number: u32,
    block: u32,
    range: TextRange,
}

impl Index {
    /// Reads the whole file once.
    pub(crate) fn of(program: &Program) -> Self {
        let mut index = Self {
            blocks: program.block_count() as u32,
            ..Self::default()
        };
        let mut open = Vec::new();
        for block in program.blocks() {
            index.block(program, &block, &mut open);
        }
        index.unclosed(&mut open);
        index.labels.sort_unstable();
        index.loops.sort_unstable_by_key(|found| found.open);
        index.ends = index.loops.iter().map(|found| (found.close, found.open)).collect();
        index.ends.sort_unstable();
        index.nest();
        index
    }

    /// Finds the loop around each loop.
    fn nest(&mut self) {
        let mut stack: Vec<usize> = Vec::new();
        for (at, inner) in self.loops.iter().enumerate() {
            while stack.last().is_some_and(|&outer| self.loops[outer].close < inner.open) {
                stack.pop();
            }
            self.around.push(stack.last().copied());
            stack.push(at);
        }
    }

    fn block(&mut self, program: &Program, block: &Block<'_>, open: &mut Vec<Open>) {
        let BlockId(at) = block.id();
        for item in block.items() {
            match item {
                Item::Word(word) => match (word.address, word.value) {
                    (Address::Letter(b'N'), Value::Number(number)) => {
                        if let Some(number) = whole(number) {
                            self.labels.push((number, at));
                        }
                    }
                    (Address::Letter(b'O'), Value::Number(number)) => {
                        self.unclosed(open);
                        self.programs
                            .extend(whole(number).map(|number| (at, ProgramName::Number(number))));
                    }
                    (Address::Letter(b'O'), Value::Expression(range)) => {
                        self.unclosed(open);
                        let name = ProgramName::bracketed(program.bytes(range));
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
                        self.programs.push((at, ProgramName::Number(number)));
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
                let message = format!("DO{number} stands inside a loop of the same number; its END{number} is missing");
                self.broken(at, range, Mistake::EndMissing, message);
            }
            (false, Some(place)) if place + 1 == open.len() => {
                let block = open[place].block;
                open.truncate(place);
                self.loops.push(Loop { open: block, close: at });
            }
            (false, Some(place)) => {
                let inner = open[place + 1].number;
                let message =
                    format!("loops cross: END{number} stands inside the loop DO{inner}, which is not ended yet");
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

    /// The blocks of the program, among those of the file, in which a block stands: first, and one past the last.
    pub(crate) fn section(&self, block: u32) -> (u32, u32) {
        let behind = self.programs.partition_point(|program| program.0 <= block);
        let end = match behind {
            // what stands before the first program number belongs to the first program
            0 => self.programs.get(1).map_or(self.blocks, |program| program.0),
            _ => self.programs.get(behind).map_or(self.blocks, |program| program.0),
        };
        let start = match behind {
            0 | 1 => 0,
            _ => self.programs[behind - 1].0,
        };
        (start, end)
    }

    /// First block of the program of a number or name.
    pub(crate) fn program(&self, name: &ProgramName) -> Option<u32> {
        self.programs
            .iter()
            .find(|program| program.1 == *name)
            .map(|program| program.0)
    }

    /// The block of a sequence number as the control finds it: forward from `from`, then from the start of the program.
    pub(crate) fn label(&self, number: u32, from: u32, section: (u32, u32)) -> Option<u32> {
        let first = self.labels.partition_point(|label| *label < (number, section.0));
        let found = self.labels[first..]
            .iter()
            .take_while(|label| label.0 == number && label.1 < section.1)
            .map(|label| label.1);
        let mut earliest = None;
        for block in found {
            if block > from {
                return Some(block);
            }
            earliest = earliest.or(Some(block));
        }
        earliest
    }

    /// The loop that a block opens.
    pub(crate) fn opened_by(&self, block: u32) -> Option<Loop> {
        let at = self.loops.binary_search_by_key(&block, |found| found.open).ok()?;
        Some(self.loops[at])
    }

    /// The block that opens the loop that a block ends.
    pub(crate) fn ended_by(&self, block: u32) -> Option<u32> {
        let at = self.ends.binary_search_by_key(&block, |end| end.0).ok()?;
        Some(self.ends[at].1)
    }

    /// Whether a jump leads from outside into a loop.
    pub(crate) fn enters_loop(&self, from: u32, to: u32) -> bool {
        let mut at = self.loops.partition_point(|found| found.open < to).checked_sub(1);
        while let Some(place) = at {
            let found = self.loops[place];
            if to <= found.close && !(found.open..=found.close).contains(&from) {
                return true;
            }
            at = self.around[place];
        }
        false
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
