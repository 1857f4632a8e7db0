//! Which motions have a feed that belongs to the speed of the spindle: taps, threads, and the tapping mode of a control.
use std::collections::VecDeque;
use trunnion_interp::{Effect, Placed};
use trunnion_same::{COUPLING_KEYS, couples_feed};

/// Reads the effects of a run, which must be watched.
#[derive(Default)]
pub(crate) struct Pitches {
    effects: u32,
    /// Which setting couples the feed to the spindle.
    couples: [bool; COUPLING_KEYS.len()],
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
        let Some(at) = COUPLING_KEYS.iter().position(|known| known == key) else {
            return;
        };
        self.couples[at] = couples_feed(key, to);
        self.changes.push_back((self.effects, self.couples.contains(&true)));
    }

    /// Whether the feed of the next motion is one; `effects`: how many effects come before it.
    pub(crate) fn holds(&mut self, effects: u32) -> bool {
        while let Some((_, pitch)) = self.changes.pop_front_if(|(after, _)| *after <= effects) {
            self.now = pitch;
        }
        self.now
    }
}
