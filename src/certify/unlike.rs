//! Pairs of motions that are not compared by the paths of their joints, but by their words, or as arcs.
use crate::compare::{Both, Compared, Pair, above};
use crate::path::Apart;
use crate::{Claim, Outcome};
use trunnion_interp::{Motion, MotionKind};
use trunnion_machine::Stance;
use trunnion_same::{Judge, Near, Verdict};

/// The bound of two arcs exceeds their distance by no more than this, mm: less than a certificate shows.
const SHOWN_MM: f64 = 1e-7;

impl Pair<'_> {
    /// Where the position of the machine is unknown in both programs, the programmed coordinates are compared: both begin at the same place.
    pub(super) fn by_words(&self) -> Result<Compared, Outcome> {
        let (mm, deg) = self.claim.tolerances();
        match (Near { mm, deg }).pair(self.before, self.after) {
            Ok(()) | Err(Verdict::Same) => Ok(Compared::UnknownAlike),
            Err(Verdict::Unknown(gap)) => Err(self.unknown(&gap.what)),
            Err(Verdict::Differs(found)) => self.refute(found.what),
        }
    }

    /// Where both programs name rotary axes, and more than the path is claimed, these end where they did.
    pub(super) fn same_rotary_words(&self, old: &Motion, new: &Motion) -> Result<(), Outcome> {
        let Claim::SameToolPath { tolerance_deg, .. } = self.claim else {
            return Ok(());
        };
        let words = |motion: &Motion| {
            matches!(motion.orientation, trunnion_interp::Orientation::Words) && motion.tilt.normal.is_none()
        };
        if !words(old) || !words(new) {
            return Ok(());
        }
        for axis in 3..6 {
            if let (Some(from), Some(to)) = (old.end.get(axis), new.end.get(axis)) {
                let off = (from + old.zero[axis] - to - new.zero[axis]).abs();
                if above(off, *tolerance_deg) {
                    let letter = char::from(trunnion_interp::AXIS_LETTERS[axis]);
                    return self.refute(format!("{letter} ends at {from} deg and at {to} deg"));
                }
            }
        }
        Ok(())
    }

    /// Two arcs while no rotary axis moves: then the arcs in the part are as they are programmed, turned and shifted as a whole.
    pub(super) fn arcs(&self, start: Both<'_>, end: Both<'_>) -> Result<Apart, Outcome> {
        let (a, b) = (&self.before.motion, &self.after.motion);
        let stand = |from: &Stance, to: &Stance| {
            self.machine
                .rotary
                .iter()
                .all(|&joint| from.joints[joint] == to.joints[joint])
        };
        let still = stand(start.0, end.0) && stand(start.1, end.1) && stand(start.0, start.1);
        let (MotionKind::Arc(Some(from)), MotionKind::Arc(Some(to))) = (&a.kind, &b.kind) else {
            return Err(self.unknown("the distance between an arc and a motion of another kind is not modelled"));
        };
        if !still || a.tcp != b.tcp {
            return Err(self.unknown("the distance between two different arcs is not modelled while rotary axes move"));
        }
        let off = trunnion_same::arcs_apart(from, to, [a, b], SHOWN_MM);
        Ok(Apart {
            sampled_mm: off,
            bound_mm: off,
            sampled_axis: 0.0,
            bound_axis: 0.0,
        })
    }
}
