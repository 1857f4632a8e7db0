//! Signs of controls and their weights. Each sign counts once, however often it occurs.
//!
//! 10 and more: only programs for this control have it. 4 to 8: unusual elsewhere. Less: tips the scales.

/// A group of controls that share their language, or one control.
pub(super) type Name = &'static str;

/// One sign.
#[derive(Clone, Debug)]
pub(super) struct Vote {
    pub(super) name: Name,
    pub(super) weight: u32,
    /// What was seen, with its place: `G43.4 on line 1`.
    pub(super) sign: String,
}

/// All signs that were seen.
#[derive(Clone, Debug, Default)]
pub(super) struct Votes {
    seen: Vec<(Name, String)>,
    all: Vec<Vote>,
    /// The current line, from 1.
    pub(super) line: usize,
}

impl Votes {
    /// A sign of a control in the current line.
    pub(super) fn add(&mut self, name: Name, weight: u32, sign: &str) {
        if self.seen.iter().any(|(known, seen)| *known == name && seen == sign) {
            return;
        }
        self.seen.push((name, sign.to_owned()));
        self.all.push(Vote {
            name,
            weight,
            sign: format!("{sign} on line {}", self.line),
        });
    }

    /// The total weight of the signs of these controls.
    pub(super) fn weight(&self, of: &[Name]) -> u32 {
        let own = self.all.iter().filter(|vote| of.contains(&vote.name));
        own.map(|vote| vote.weight).sum()
    }

    /// The weight of one sign of a control; 0 where it was not seen.
    pub(super) fn weight_of(&self, name: Name, sign: &str) -> u32 {
        let own = self
            .all
            .iter()
            .find(|vote| vote.name == name && vote.sign.starts_with(sign));
        own.map_or(0, |vote| vote.weight)
    }

    /// The heaviest sign of these controls; of equal ones the first.
    pub(super) fn strongest(&self, of: &[Name]) -> Option<&Vote> {
        let own = self.all.iter().filter(|vote| of.contains(&vote.name));
        own.rev().max_by_key(|vote| vote.weight)
    }
}
