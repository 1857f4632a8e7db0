//! The first pass over a program: a key per motion, 16 bytes each.
use crate::changes::Found;
use crate::event::Tech;
use crate::point::{Point, Tolerance};
use crate::run::Events;
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use trunnion_interp::Value;
use trunnion_same::{Input, Item, Step};

/// What the first pass keeps of a program.
#[derive(Default)]
pub(crate) struct Keys {
    pub(crate) hashes: Vec<u64>,
    /// Index into the common list of what is in effect; `u32::MAX` for statements.
    pub(crate) techs: Vec<u32>,
    pub(crate) blocks: Vec<u32>,
}

/// What was in effect in any motion, each once.
#[derive(Default)]
pub(crate) struct Techs {
    pub(crate) list: Vec<Tech>,
    index: HashMap<Tech, u32>,
}

/// Whether a motion ends at a place that is not known in numbers.
pub(crate) fn place_unknown(step: &Step, input: &Input<'_>) -> bool {
    is_unknown(&Point::new(&step.motion, input.machine.zip(step.leg.as_ref())))
}

fn is_unknown(point: &Point) -> bool {
    point.known & 7 != 7 && point.way.is_a_move()
}

/// Runs a program and keeps its keys; `to`: which of the two it is, and where its motions are counted.
pub(crate) fn keys(input: Input<'_>, tolerance: Tolerance, techs: &mut Techs, to: (usize, &mut Found)) -> Keys {
    let (side, found) = to;
    let mut keys = Keys::default();
    let mut events = Events::new(input);
    while let Some(item) = events.next_item() {
        let mut state = DefaultHasher::new();
        let tech = match &item {
            Item::Motion(step) => {
                let (point, tech) = events.motion(step);
                found.motions[side] += 1;
                found.unknown += u64::from(side == 0 && is_unknown(&point));
                point.hash(tolerance, &mut state);
                techs.number(&tech)
            }
            Item::Happens { words, .. } => {
                // two that hash alike are put into the same words
                for word in words {
                    word.name.hash(&mut state);
                    match &word.value {
                        Value::Nothing => 0.hash(&mut state),
                        Value::Number(value) => (1, value.to_bits()).hash(&mut state),
                        Value::Text(text) => (2, text).hash(&mut state),
                    }
                }
                u32::MAX
            }
        };
        keys.hashes.push(state.finish());
        keys.techs.push(tech);
        keys.blocks.push(item.block().0);
    }
    found.stops[side] = events.stop().cloned();
    keys
}

impl Techs {
    fn number(&mut self, tech: &Tech) -> u32 {
        if let Some(&known) = self.index.get(tech) {
            return known;
        }
        let number = self.list.len() as u32;
        self.list.push(tech.clone());
        self.index.insert(tech.clone(), number);
        number
    }
}
