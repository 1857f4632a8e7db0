//! The levels of a drilling cycle with its numbers, and what is wrong with them.
//!
//! Source: the text of the control's own cycles (version 6): the depth lies on the other side of RFP than RTP, and alarm 61101 is RTP = RFP with DPR.
use super::called::{Given, HoleCall, Sort};
use super::modes::Modes;

impl HoleCall {
    /// Levels of retraction, beginning of the feed and bottom in program units. `None`: one is not known, or they make no hole. A hole may go up,
    /// with RTP below RFP: SDIS lies on the side of RTP.
    pub(super) fn levels(&self) -> Option<[f64; 3]> {
        let [retract, surface, clearance, bottom] = self.given_levels()?;
        let down = bottom < surface && retract >= surface;
        // the steps of a deep hole are taken from a source that goes down
        let up = bottom > surface && retract < surface && self.sort != Sort::Deep;
        let begin = if up { surface - clearance } else { surface + clearance };
        ((down || up) && !self.has_no_side()).then_some([retract, begin, bottom])
    }

    /// RFP is DP: nothing moves.
    pub(super) fn makes_no_hole(&self) -> bool {
        let relative = self.number(4).or_zero() != Some(0.0);
        !relative
            && self
                .given_levels()
                .is_some_and(|[_, surface, _, bottom]| bottom.total_cmp(&surface).is_eq())
    }

    /// RTP is RFP where the depth counts from RFP away from RTP.
    fn has_no_side(&self) -> bool {
        let relative = !matches!(self.modes, Modes::Depth { incremental: false, .. })
            && matches!(self.number(4), Given::Number(depth) if depth != 0.0);
        relative
            && self
                .given_levels()
                .is_some_and(|[retract, surface, ..]| retract.total_cmp(&surface).is_eq())
    }

    /// Which of the levels is wrong, where all are known, and the alarm of the control: the tool goes from RTP to RFP, and on to the depth.
    pub(super) fn wrong_level(&self) -> Option<(String, Option<&'static str>)> {
        let [retract, surface, _, bottom] = self.given_levels()?;
        let id = &self.id;
        if self.has_no_side() {
            let message = format!(
                "{id}: RTP {retract} is RFP, and DPR, the fifth number, is a depth away from RTP: write the retract plane, the first number, above the surface"
            );
            return Some((message, Some("61101")));
        }
        if bottom > surface && retract >= surface {
            let message = format!(
                "{id}: the depth {bottom} is above RFP {surface}: write DP, the fourth number, below the surface"
            );
            return Some((message, None));
        }
        (bottom < surface && retract < surface).then(|| {
            let message = format!(
                "{id}: RTP {retract} is not above RFP {surface}: write the retract plane, the first number, above the surface"
            );
            (message, None)
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
            (_, Given::Number(depth)) if depth != 0.0 && retract < surface => surface + depth.abs(),
            (_, Given::Number(depth)) if depth != 0.0 => surface - depth.abs(),
            (Given::Number(bottom), _) => bottom,
            (Given::Nothing, Given::Number(_)) => return None,
        };
        Some([retract, surface, clearance, bottom])
    }
}
