//! Effects that a run has collected.
use crate::{Argument, Effect, Placed, Reach};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// Settings by their key.
pub(crate) type Settings = BTreeMap<Cow<'static, str>, Vec<Argument>>;

/// Blocks of shifts and turns whose words a later motion may need.
const MOST_FRAMES: usize = 1000;

/// Effects of the current block, collected only if they are requested.
#[derive(Clone, Debug, Default)]
pub(crate) struct Effects {
    wanted: bool,
    /// Block numbers are effects too.
    numbers: bool,
    /// How many there were so far in the run.
    count: u32,
    /// Words of blocks that shift or turn the coordinates and were held by known positions so far.
    frames: Vec<Vec<Argument>>,
    /// Not emitted yet.
    ready: Vec<Placed>,
    /// The settings in effect, by their keys.
    settings: Settings,
    /// mm per unit of lengths where S of G96 was given last; `None`: nowhere so far.
    cutting_unit: Option<f64>,
}

impl Effects {
    /// Asks for them.
    pub(crate) fn watch(&mut self) {
        self.wanted = true;
    }
    /// Asks for block numbers too.
    pub(crate) fn watch_numbers(&mut self) {
        self.numbers = true;
    }
    /// Whether block numbers are requested.
    pub(crate) fn numbers_wanted(&self) -> bool {
        self.numbers
    }
    /// Whether they are requested.
    #[inline]
    pub(crate) fn wanted(&self) -> bool {
        self.wanted
    }
    /// How many there were so far in the run.
    #[inline]
    pub(crate) fn count(&self) -> u32 {
        self.count
    }
    pub(crate) fn add(&mut self, block: trunnion_syntax::BlockId, effect: Effect) {
        let reach = effect.usual_reach();
        self.add_with(block, effect, reach);
    }
    /// One that may change more, or less, than others of its kind.
    pub(crate) fn add_with(&mut self, block: trunnion_syntax::BlockId, effect: Effect, reach: Reach) {
        self.count += 1;
        if let Effect::Set { key, to } = &effect {
            self.settings.insert(key.clone(), to.clone());
        }
        self.ready.push(Placed { block, effect, reach });
    }
    /// A parameter of the control decides what a number of the block means; once for each block.
    pub(crate) fn ambiguous_number(&mut self, block: trunnion_syntax::BlockId) {
        let effect = Effect::Unmodelled(vec![Argument::code("a number with or without decimal point")]);
        let known = |placed: &Placed| placed.block == block && placed.effect == effect;
        if self.wanted && !self.ready.iter().any(known) {
            self.add(block, effect);
        }
    }
    /// One that was emitted already.
    pub(crate) fn skip(&mut self) {
        self.count += 1;
    }
    /// Those that were not emitted yet.
    pub(crate) fn take(&mut self) -> Vec<Placed> {
        std::mem::take(&mut self.ready)
    }
    /// The settings in effect that were not those of the start.
    pub(crate) fn settings(&self) -> &Settings {
        &self.settings
    }
    /// mm per unit of lengths in which S of G96 is; a control begins in mm.
    pub(crate) fn cutting_unit(&self) -> f64 {
        self.cutting_unit.unwrap_or(1.0)
    }
    /// See [`Self::cutting_unit`].
    pub(crate) fn set_cutting_unit(&mut self, mm: f64) {
        self.cutting_unit = Some(mm);
    }
    /// Keeps the words of a block that shifts or turns the coordinates.
    pub(crate) fn keep_frame(&mut self, words: Vec<Argument>) {
        self.frames.push(words);
    }
    /// Where a motion's end is unknown, or too many are kept, they are compared by their words.
    pub(crate) fn release_frames(&mut self, block: trunnion_syntax::BlockId, unknown_end: bool) {
        if unknown_end || self.frames.len() > MOST_FRAMES {
            for words in std::mem::take(&mut self.frames) {
                self.add(block, Effect::Unmodelled(words));
            }
        }
    }
}
