//! Blocks that pass a position of the rotary axes at which the linear axes do not span space: there they cannot hold the tip on its path.
use crate::kinematics::forward::Turn;
use crate::path::joint_path::JointPath;
use crate::{Leg, Machine};
use trunnion_geometry::{Mat3, Vec3};

/// The shortest piece of a block that is looked at: nearer to such a position it counts as passing it.
const SHORTEST: f64 = 1.0 / 65_536.0;

/// Whether the linear axes cannot hold the tip on its path somewhere in a block between two known positions, or it is not proven that they can.
pub fn passes_singular(machine: &Machine, leg: &Leg) -> bool {
    JointPath::unproven(machine, leg).is_some_and(|path| path.passes_singular())
}

impl JointPath<'_> {
    /// See [`passes_singular`]. The directions of the solved axes are unit vectors u, v, w with the volume d = u . (v x w), so that
    /// |d'| <= |u'| + |v'| + |w'|: a piece of length h has no zero where |d| at its start is above h times that bound.
    pub(crate) fn passes_singular(&self) -> bool {
        if !self.tip || self.constants().shared_segment.is_some() {
            return false;
        }
        let (mut from, mut length) = (0.0, 1.0);
        let sign = self.volume(0.0).signum();
        while from < 1.0 {
            let to = f64::min(from + length, 1.0);
            let rate = self.spin_bounds(from, to).rate;
            let solved = self.constants().solved.iter();
            let fastest: f64 = solved
                .map(|&index| rate[..self.constants().linear[index].segment].iter().sum::<f64>())
                .sum();
            let volume = sign * self.volume(from);
            // NaN proves nothing
            if fastest == 0.0 || volume > fastest * (to - from) {
                (from, length) = (to, length * 2.0);
            } else if length <= SHORTEST {
                return true;
            } else {
                length *= 0.5;
            }
        }
        false
    }

    /// Signed volume of the directions of the solved axes in the workpiece frame.
    fn volume(&self, t: f64) -> f64 {
        let turns: [Turn; 2] = self.turns(t);
        let columns: [Vec3; 3] = self.constants().solved.map(|index| {
            let linear = &self.constants().linear[index];
            let turns = turns[..linear.segment].iter().rev();
            turns.fold(linear.motion, |motion, turn| turn.apply(&motion))
        });
        Mat3::from_columns(&columns).determinant()
    }
}
