//! Where a run is: the open calls and loops, and the bounds of both.
use crate::{ChainId, Chains, Frame, Ran};
use std::collections::HashMap;
use std::sync::Arc;
use trunnion_syntax::{BlockId, TextRange};
use trunnion_vocabulary::Work;

/// Where the run is.
#[derive(Clone, Copy, Debug, Default)]
pub struct Place {
    /// 0: the main program's file.
    pub file: u16,
    /// Blocks of the program that runs, among those of its file: first, one past the last. Not known before the first jump.
    pub section: Option<(u32, u32)>,
    /// The block of the main program's file that runs, or whose call is running.
    pub main: BlockId,
    /// Its text.
    pub main_range: TextRange,
}

/// What ends a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// A statement that returns, or the end of the program's text.
    Return,
    /// Its last block: a section of the program that runs is repeated.
    Section {
        /// The last block.
        last: u32,
    },
}

/// A call that is about to run. `L`: what the language keeps for the caller.
#[derive(Clone, Debug)]
pub struct PendingCall<L> {
    /// The block that calls.
    pub from: u32,
    /// The block that runs after the call.
    pub back: u32,
    /// The file that is called.
    pub file: u16,
    /// First block of what is called.
    pub start: u32,
    /// The blocks of the program that contains it, if they are known.
    pub section: Option<(u32, u32)>,
    /// How often it runs; at least once.
    pub times: u32,
    /// What ends it.
    pub ends: Ends,
    /// What the language keeps.
    pub level: L,
}

/// One call.
#[derive(Clone, Debug)]
pub struct Call<L> {
    /// The block after the call.
    pub back: u32,
    /// Where the caller was.
    pub place: Place,
    /// The calls in which the caller runs.
    pub chain: ChainId,
    /// What the language keeps.
    pub level: L,
    start: u32,
    times: u32,
    ends: Ends,
}

/// Turns of a loop.
#[derive(Clone, Copy, Debug, Default)]
struct Turns {
    count: u64,
    /// What the language counted as changes when the last one began.
    changes: u64,
}

/// Whether a run may continue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BlockBudget {
    /// It may.
    Left,
    /// A loop runs forever, or the bound of executed blocks is reached.
    Out {
        /// The loop that is proved endless, or was repeated most often: file, opening block.
        most: Option<(u16, u32)>,
        /// It is proved.
        proved: bool,
        /// Blocks that were executed.
        blocks: u64,
    },
}

/// A call stores as much as so many entries of other lists: its variables.
const CALL: usize = 16;

/// What a chain of calls counts among copied entries: it stores two texts and its key.
const CHAIN: usize = 8;

/// Loops that are counted; others are named by the block that ran last.
const LOOPS: usize = 1 << 16;

/// See the module. The language hands over, as `changes`, a number that grows with everything that may change the outcome of a
/// decision (assignments, values of the control): a loop that starts again without any change never ends.
#[derive(Clone, Debug)]
pub struct Course<L> {
    calls: Vec<Call<L>>,
    place: Place,
    ran: Ran,
    chains: Arc<Chains>,
    executed: u64,
    /// Bytes of the blocks that were executed.
    bytes: u64,
    /// The opening block to which the end of a loop has just gone back.
    again: Option<u32>,
    /// How often each loop, by file and opening block, began again since it was entered.
    turns: HashMap<(u16, u32), Turns>,
    endless: Option<(u16, u32)>,
}

impl<L> Default for Course<L> {
    fn default() -> Self {
        Self {
            calls: Vec::new(),
            place: Place::default(),
            ran: Ran::default(),
            chains: Arc::default(),
            executed: 0,
            bytes: 0,
            again: None,
            turns: HashMap::new(),
            endless: None,
        }
    }
}

impl<L> Course<L> {
    /// Where the run is.
    pub fn place(&self) -> Place {
        self.place
    }

    /// The blocks of the program that runs, found once by `section`.
    pub fn section(&mut self, section: impl FnOnce() -> (u32, u32)) -> (u32, u32) {
        *self.place.section.get_or_insert_with(section)
    }

    /// Whether a called program runs.
    pub fn is_called(&self) -> bool {
        self.programs().next().is_some()
    }

    /// What the language keeps of the calls of programs, outermost first.
    pub fn programs(&self) -> impl Iterator<Item = &L> {
        let of_program = |call: &&Call<L>| call.ends == Ends::Return;
        self.calls.iter().filter(of_program).map(|call| &call.level)
    }

    /// How many calls and repeated sections are open.
    pub fn depth(&self) -> usize {
        self.calls.len()
    }

    /// How many entries of lists that grow with the program a clone copies.
    pub fn copied(&self) -> usize {
        // a clone shares the chains until the next new one
        let chains = self.chains.count() * CHAIN;
        self.calls.len() * CALL + self.turns.len() + self.ran.copied() + chains
    }

    /// Whether a block of the main program's file ran before the current range.
    pub fn has_run(&self, block: u32) -> bool {
        self.ran.has(block)
    }

    /// The blocks up to `end` (not included) have run; nothing follows.
    pub fn stop(&mut self, end: u32) {
        if self.place.file == 0 {
            self.ran.jump(end, end);
        }
    }

    /// Counts a block of `bytes` bytes that is about to run, and says whether it may.
    pub fn count(&mut self, bytes: u64, most: Work) -> BlockBudget {
        self.executed += 1;
        self.bytes += bytes;
        if self.executed <= most.blocks && self.bytes <= most.bytes && self.endless.is_none() {
            return BlockBudget::Left;
        }
        #[expect(
            clippy::disallowed_methods,
            reason = "of loops that began again equally often the first one wins, whatever the order"
        )]
        let most = self.turns.iter();
        let most = most.max_by_key(|(place, turns)| (turns.count, std::cmp::Reverse(**place)));
        BlockBudget::Out {
            most: self.endless.or(most.map(|most| *most.0)),
            proved: self.endless.is_some(),
            blocks: self.executed - 1,
        }
    }

    /// The run continues at `to`, which is returned; `end`: one past the last block that has run.
    pub fn jump(&mut self, end: u32, to: u32) -> u32 {
        if self.place.file == 0 {
            self.ran.jump(end, to);
        }
        to
    }

    /// The same to a block before the jump, which may run forever.
    pub fn jump_back(&mut self, end: u32, to: u32, changes: u64) -> u32 {
        let key = (self.place.file, to);
        if self.turns.len() < LOOPS || self.turns.contains_key(&key) {
            let turns = self.turns.entry(key).or_default();
            if turns.count > 0 && turns.changes == changes {
                // nothing that a decision depends on has changed: every further turn is the same
                self.endless = Some(key);
            }
            turns.count += 1;
            turns.changes = changes;
        }
        self.jump(end, to)
    }

    /// A block opens a loop. Unless the run comes from its own end, counting starts.
    pub fn open_loop(&mut self, open: u32) {
        if self.again.take() != Some(open) {
            self.turns.remove(&(self.place.file, open));
        }
    }

    /// Whether the end of the loop that a block opens has just led there.
    pub fn is_again(&self, open: u32) -> bool {
        self.again == Some(open)
    }

    /// The end of a loop leads back to the block that opens it.
    pub fn close_loop(&mut self, end: u32, open: u32, changes: u64) -> u32 {
        let to = self.jump_back(end, open, changes);
        self.again = Some(open);
        to
    }

    /// Begins a call in the chain `chain`; `range` is the text of the calling block. Returns the chain of the call.
    pub fn enter(
        &mut self,
        going: PendingCall<L>,
        chain: ChainId,
        range: TextRange,
        frame: impl FnOnce() -> Frame,
    ) -> ChainId {
        let caller = self.place;
        let inner = match going.ends {
            Ends::Return => Arc::make_mut(&mut self.chains).enter(chain, caller.file, going.from, frame),
            Ends::Section { .. } => chain,
        };
        if caller.file == 0 {
            self.ran.jump(going.back, going.start);
        }
        self.ran.begin(going.start);
        let (main, main_range) = match caller.file {
            0 => (BlockId(going.from), range),
            _ => (caller.main, caller.main_range),
        };
        self.place = Place {
            file: going.file,
            section: going.section,
            main,
            main_range,
        };
        self.calls.push(Call {
            back: going.back,
            place: caller,
            chain,
            level: going.level,
            start: going.start,
            times: going.times - 1,
            ends: going.ends,
        });
        inner
    }

    /// Starts the called program again, if it is repeated: its first block, and what the language keeps of the call.
    pub fn once_more(&mut self) -> Option<(u32, &mut L)> {
        let call = self.calls.last_mut().filter(|call| call.times > 0)?;
        call.times -= 1;
        Some((call.start, &mut call.level))
    }

    /// The last call ends; `end`: one past the last block that has run. The run continues at [`Call::back`].
    pub fn leave(&mut self, end: u32) -> Option<Call<L>> {
        let call = self.calls.pop()?;
        if self.place.file == 0 {
            self.ran.jump(end, call.back);
        }
        if call.place.file == 0 {
            self.ran.begin(call.back);
        }
        self.place = call.place;
        Some(call)
    }

    /// First and last block of the section that is repeated where the run is.
    pub fn repeated(&self) -> Option<(u32, u32)> {
        let call = self.calls.last()?;
        match call.ends {
            Ends::Section { last } => Some((call.start, last)),
            Ends::Return => None,
        }
    }

    /// The chain of a block of the called file, whose calls are those of `chain`.
    pub fn stand(&mut self, chain: ChainId, block: u32, frame: impl FnOnce() -> Frame) -> ChainId {
        let file = self.place.file;
        Arc::make_mut(&mut self.chains).stand(chain, file, block, frame)
    }

    /// The calls of a chain, outermost first.
    pub fn frames(&self, chain: ChainId) -> Vec<Frame> {
        self.chains.frames(chain)
    }
}

#[cfg(test)]
mod tests;
