//! What a program does, independent of any language: events in order, including motions.
use std::collections::{BTreeMap, BTreeSet};
pub(crate) use trunnion_certify::conversion::Coolant;
use trunnion_dialect::PathMode;
use trunnion_interp::Tool;
use trunnion_syntax::BlockId;

/// One event of a program.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Event {
    /// A comment for people.
    Comment(String),
    /// A text for the operator's screen.
    Message(String),
    /// A tool is loaded into the spindle.
    Tool(u32),
    /// The spindle turns: counter-clockwise, and its speed, 1/min.
    SpindleOn(bool, f64),
    /// Its speed, 1/min, where it is not known whether it turns.
    Speed(f64),
    /// It stops.
    SpindleOff,
    Coolant(Coolant),
    /// What the control does at the end of each block from here on.
    Path(PathMode),
    /// Codes of the control for which the original was written, for the same control.
    Own(String),
    /// The program waits for the operator; optional: only where the switch is set.
    Stop(bool),
    /// An M code without meaning to the control itself (APT AUXFUN).
    Auxiliary(u32),
    /// A work offset by its name.
    WorkOffset(String),
    /// A motion, by its index.
    Motion(usize),
}

/// An event and its place.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Placed {
    pub(crate) event: Event,
    pub(crate) block: BlockId,
}

/// A program's events.
#[derive(Debug, Default)]
pub(crate) struct Job {
    pub(crate) name: Option<String>,
    pub(crate) events: Vec<Placed>,
    /// Tools in the order of their first use, with what is declared of them.
    pub(crate) tools: Vec<(u32, Option<Tool>)>,
    /// Places in `tools` by number.
    pub(crate) places: BTreeMap<u32, usize>,
    /// What is left out, once each, with its place.
    pub(crate) left_out: Vec<(String, BlockId)>,
    /// A zero point that the target cannot name, and the work offset that stands for it.
    pub(crate) renamed_offset: Option<(String, String)>,
    /// The names in it.
    pub(crate) known_left_out: BTreeSet<String>,
}

impl Job {
    pub(crate) fn push(&mut self, event: Event, block: BlockId) {
        self.events.push(Placed { event, block });
    }
    /// What is declared of a tool of the program.
    pub(crate) fn tool(&self, number: u32) -> Option<&(u32, Option<Tool>)> {
        self.places.get(&number).map(|&place| &self.tools[place])
    }
    /// The same, to write; the tool is added where it is new.
    pub(crate) fn tool_mut(&mut self, number: u32) -> &mut Option<Tool> {
        let next = self.tools.len();
        let place = *self.places.entry(number).or_insert(next);
        if place == next {
            self.tools.push((number, None));
        }
        &mut self.tools[place].1
    }
    pub(crate) fn leave_out(&mut self, what: &str, block: BlockId) {
        if self.known_left_out.insert(what.to_owned()) {
            self.left_out.push((what.to_owned(), block));
        }
    }
}
