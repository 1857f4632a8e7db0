//! The same finding in a later pass of a loop, or in a later call: it is counted at the first one, not reported again.
use crate::{Diagnostic, Severity, Status};
use std::collections::HashMap;
use trunnion_interp::{ChainId, Frame};
use trunnion_syntax::TextRange;

/// Calls shown at either end of a long chain.
const SHOWN: usize = 3;

/// Rule, key of merging, whether it is unknown, and bytes in the file.
type Place = (&'static str, u64, bool, TextRange);

/// What later passes found at the place of a finding.
#[derive(Default)]
struct Later {
    count: u32,
    severity: Option<Severity>,
    /// A finding of a higher severity than the first.
    worse: Option<Box<Diagnostic>>,
}

/// All findings of first passes by their place.
#[derive(Default)]
pub(crate) struct Passes {
    places: HashMap<Place, u32>,
    later: Vec<Later>,
}

impl Passes {
    fn place(diagnostic: &Diagnostic, key: u64) -> Place {
        let unknown = diagnostic.status == Status::Unknown;
        (diagnostic.rule, key, unknown, diagnostic.range)
    }

    /// Notes a reported finding, so that later ones at its place are counted there.
    pub(crate) fn told(&mut self, diagnostic: &mut Diagnostic, key: u64) {
        let next = self.later.len() as u32;
        let slot = *self.places.entry(Self::place(diagnostic, key)).or_insert(next);
        if slot == next {
            self.later.push(Later {
                count: 0,
                severity: Some(diagnostic.severity),
                worse: None,
            });
            diagnostic.origin.later = Some(slot);
        }
    }

    /// The counter of the finding that was reported at this place before.
    pub(crate) fn find(&self, diagnostic: &Diagnostic, key: u64) -> Option<u32> {
        self.places.get(&Self::place(diagnostic, key)).copied()
    }

    /// Whether a finding of this severity is no news for a counter; then it is counted.
    pub(crate) fn count(&mut self, slot: u32, severity: Severity) -> bool {
        let Some(later) = self.later.get_mut(slot as usize) else {
            return false;
        };
        let known = later.severity >= Some(severity);
        later.count += u32::from(known);
        known
    }

    /// Counts a finding of a later pass; where it is worse than all before, its words are kept.
    pub(crate) fn add(&mut self, slot: u32, diagnostic: Diagnostic) {
        if self.count(slot, diagnostic.severity) {
            return;
        }
        if let Some(later) = self.later.get_mut(slot as usize) {
            later.count += diagnostic.count;
            later.severity = Some(diagnostic.severity);
            later.worse = Some(Box::new(diagnostic));
        }
    }

    /// Puts what later passes found into the finding of the first, and the calls that led to it.
    pub(crate) fn complete(&mut self, diagnostic: &mut Diagnostic, chain: &dyn Fn(ChainId) -> Vec<Frame>) {
        let later = diagnostic
            .origin
            .later
            .and_then(|slot| self.later.get_mut(slot as usize));
        let mut origin = diagnostic.origin;
        if let Some(later) = later {
            if let Some(worse) = later.worse.take() {
                diagnostic.severity = worse.severity;
                origin = worse.origin;
                diagnostic.take_words(*worse);
            }
            if later.count > 0 {
                diagnostic.count = diagnostic.count.saturating_add(later.count);
                diagnostic.notes.push(format!(
                    "the block runs more than once: this occurs {} times in all and is reported only the first time",
                    diagnostic.count
                ));
            }
        }
        if origin.chain != ChainId::MAIN {
            diagnostic.notes.extend(calls(&chain(origin.chain)));
        }
    }
}

/// A chain of calls in words, outermost first; the middle of a long one is left out.
fn calls(frames: &[Frame]) -> Vec<String> {
    let mut notes = Vec::new();
    for (i, frame) in frames.iter().enumerate() {
        let left = frames.len() - i;
        if i == SHOWN && left > SHOWN {
            notes.push(format!("... {} more calls ...", left - SHOWN));
        }
        if i >= SHOWN && left > SHOWN {
            continue;
        }
        let file = if frame.file.is_empty() {
            String::new()
        } else {
            format!("{} ", frame.file)
        };
        let how = if frame.is_place { "in" } else { "called from" };
        notes.push(format!("{how} {file}line {}: {}", frame.line, frame.what.trim()));
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(count: u32) -> Vec<Frame> {
        let frame = |line| Frame {
            file: if line == 1 { String::new() } else { "sub.nc".to_owned() },
            line,
            what: "M98 P1 ".to_owned(),
            is_place: false,
        };
        (1..=count).map(frame).collect()
    }

    #[test]
    fn short_chains_are_told_whole() {
        assert_eq!(
            calls(&frames(2)),
            ["called from line 1: M98 P1", "called from sub.nc line 2: M98 P1"]
        );
        assert_eq!(calls(&frames(6)).len(), 6);
    }

    #[test]
    fn the_place_in_another_file_comes_last() {
        let mut frames = frames(2);
        frames[1].is_place = true;
        assert_eq!(
            calls(&frames),
            ["called from line 1: M98 P1", "in sub.nc line 2: M98 P1"]
        );
    }

    #[test]
    fn the_middle_of_a_long_chain_is_counted() {
        let notes = calls(&frames(100));
        assert_eq!(notes.len(), 7);
        assert_eq!(notes[3], "... 94 more calls ...");
        assert_eq!(notes[6], "called from sub.nc line 100: M98 P1");
    }
}
