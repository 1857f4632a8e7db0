//! Which motions have a feed that belongs to the speed of the spindle: taps, threads, and the tapping mode of a control.
use std::collections::VecDeque;
use trunnion_interp::{Effect, Placed};

/// Reads the effects of a run, which must be watched.
#[derive(Default)]
pub(crate) struct Pitches {
    effects: u32,
    /// A cycle or the spindle is coupled to the motions; the control is in tapping mode.
    coupled: bool,
    tapping: bool,
    /// After so many effects the feed is a pitch, or is none again.
    changes: VecDeque<(u32, bool)>,
    now: bool,
}

impl Pitches {
    /// The next effect.
    pub(crate) fn take(&mut self, placed: &Placed) {
        self.effects += 1;
        let Effect::Set { key, to } = &placed.effect else {
            return;
        };
        match key.as_ref() {
            "cycle" => self.coupled = !to.is_empty(),
            "path-control" => self.tapping = to.first().is_some_and(|code| code.name == "G63"),
            _ => return,
        }
        self.changes.push_back((self.effects, self.coupled || self.tapping));
    }

    /// Whether the feed of the next motion is one; `effects`: how many effects come before it.
    pub(crate) fn holds(&mut self, effects: u32) -> bool {
        while let Some((_, pitch)) = self.changes.pop_front_if(|(after, _)| *after <= effects) {
            self.now = pitch;
        }
        self.now
    }
}
