//! The levels of a drilling cycle with its numbers, and what is wrong with them.
use super::called::{Given, HoleCall};
use super::modes::Modes;

impl HoleCall {
    /// Levels of retraction, beginning of the feed and bottom in program units. `None`: one is not known, or they make no hole.
    pub(super) fn levels(&self) -> Option<[f64; 3]> {
        let [retract, surface, clearance, bottom] = self.given_levels()?;
        (retract > surface && bottom < surface).then_some([retract, surface + clearance, bottom])
    }

    /// Which of the levels is wrong, where all are known: the tool goes from RTP down to RFP, and from there down to the depth.
    pub(super) fn wrong_level(&self) -> Option<String> {
        let [retract, surface, _, bottom] = self.given_levels()?;
        let id = &self.id;
        if retract <= surface {
            return Some(format!(
                "{id}: RTP {retract} is not above RFP {surface}: write the retract plane, the first number, above the surface"
            ));
        }
        (bottom > surface).then(|| {
            format!("{id}: the depth {bottom} is above RFP {surface}: write DP, the fourth number, below the surface")
        })
    }

    /// RTP, RFP, SDIS and the bottom as they are given.
    fn given_levels(&self) -> Option<[f64; 4]> {
        let Given::Number(retract) = self.number(0) else {
            return None;
        };
        let (surface, clearance) = (self.number(1).or_zero()?, self.number(2).or_zero()?.abs());
        let depths = match self.modes {
            Modes::Depth { incremental: true, .. } => (Given::Nothing, self.number(4)),
            Modes::Depth { incremental: false, .. } => (self.number(3), Given::Nothing),
            _ => (self.number(3), self.number(4)),
        };
        let bottom = match depths {
            (Given::Unread, _) | (_, Given::Unread) | (Given::Nothing, Given::Nothing) => return None,
            (_, Given::Number(depth)) if depth != 0.0 => surface - depth.abs(),
            (Given::Number(bottom), _) => bottom,
            (Given::Nothing, Given::Number(_)) => return None,
        };
        Some([retract, surface, clearance, bottom])
    }
}
