//! Ways of rotary axes to absolute words: DC(), ACP() and ACN() of a Sinumerik, M126 of a TNC.
use crate::core::{Core, ROTARY, Report};
use crate::{AXIS_LETTERS, FaultKind, Position, Ways};
use trunnion_syntax::TextRange;

/// Coordinates that differ by less are the same place, deg.
const SAME_DEG: f64 = 1e-9;

/// The value in the shorter direction from a position: at most half a turn away, which is taken forward.
pub(crate) fn shorter(before: f64, value: f64) -> f64 {
    let turn = (value - before).rem_euclid(360.0);
    before + if turn > 180.0 { turn - 360.0 } else { turn }
}

impl Core<'_> {
    /// The ways of a motion, `plain` being its absolute words without one, `said` the words and the positions before and after as the program
    /// counts them. Half a turn in the shorter direction is equally long in both: no source says which is taken.
    pub(crate) fn ways(
        &mut self,
        mut ways: Ways,
        plain: u16,
        said: impl Fn(usize) -> Option<f64>,
        [from, end]: [&Position; 2],
        report: &mut Report<'_>,
    ) -> Ways {
        let directed = ways.directed() & ROTARY;
        if (directed | self.carried) == 0 {
            return Ways::default();
        }
        ways.carried = self.carried & plain & ROTARY;
        self.carried &= !plain & end.known;
        for axis in (0..AXIS_LETTERS.len()).filter(|axis| directed & (1 << axis) != 0) {
            let bit = 1 << axis;
            let (Some(said), Some(to)) = (said(axis), end.get(axis)) else {
                continue;
            };
            self.carried &= !bit;
            if (to - said).abs() > SAME_DEG {
                self.carried |= bit;
            }
            let turn = from.get(axis).map(|from| (to - from).abs());
            if ways.shortest & bit != 0 && turn.is_some_and(|turn| (turn - 180.0).abs() <= SAME_DEG) {
                let letter = char::from(AXIS_LETTERS[axis]);
                let what = format!("{letter} turns by exactly half a turn in the shorter direction: which way");
                report.fault(TextRange::default(), FaultKind::NotModelled { what });
            }
        }
        ways
    }
}
