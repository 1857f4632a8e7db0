//! Rotary axes that a vector sets: the control's choice between postures, and turns onto a tilted plane and positions in it.
use crate::follow::choice::choose;
use crate::follow::reference::{Before, Reference};
use crate::follow::words::{XYZ, zero_point};
use crate::kinematics::pole;
use crate::path::joint_path::on_great_circle;
use crate::path::rotary_path::NO_TURN;
use crate::{Follower, Joints, Leg, NoStance, Open, OpenCause, POLE_TOLERANCE, PoleAction, Stance};
use core::f64::consts::FRAC_PI_2;
use trunnion_geometry::Vec3;
use trunnion_interp::{Motion, Orientation, Swivel};

impl Follower<'_> {
    /// Sets the rotary axes for the unit tool axis `axis`; returns what is undecided about it.
    pub(crate) fn aim(
        &self,
        motion: &Motion,
        axis: &Vec3,
        start: Option<&Stance>,
        into: &mut (Joints, u16),
    ) -> Result<Option<Open>, NoStance> {
        let machine = self.machine;
        let continuous = start.is_some_and(|start| {
            on_great_circle(machine, motion)
                && pole::pole_angle_min_great_circle(machine, &start.axis, axis, start.pole_angle) > POLE_TOLERANCE
        });
        let before = Before {
            q: self.state.rotary,
            reference: match (self.state.rotary_known, self.state.rotary_lost) {
                (true, _) => Reference::Known,
                (false, 0) => Reference::Assumed,
                (false, _) => Reference::Lost,
            },
            sign: self.state.sign,
            pole_angle: start.map_or(FRAC_PI_2, |start| start.pole_angle),
            continuous,
            wish: motion.tilt.posture,
        };
        let chosen = choose(machine, axis, &before)?;
        for (value, rotary) in chosen.q.iter().zip(machine.constants.rotary()) {
            into.0[rotary.joint] = *value;
            into.1 |= 1 << rotary.joint;
        }
        Ok(chosen.open)
    }

    /// The rotary axes turn to the motion's vector or words; the linear axes stay, or move to an unknown position.
    pub(crate) fn swivel(
        &self,
        motion: &Motion,
        start: Option<&Stance>,
        into: &mut (Joints, u16),
        open: &mut Option<Open>,
    ) -> Result<Stance, NoStance> {
        // with words it turns to their angles (PLANE RESET TURN)
        if let Orientation::Vector(_, axis) = motion.orientation {
            let length = axis.norm();
            if !(1e-6..f64::INFINITY).contains(&length) {
                return Err(NoStance::NotModelled);
            }
            *open = self.aim(motion, &(axis / length), start, into)?;
        }
        if motion.tilt.swivel == Swivel::AxesLost {
            let rotary = self.machine.constants.rotary().iter();
            into.1 &= rotary.fold(0, |mask, rotary| mask | 1 << rotary.joint);
        }
        if into.1 != self.words.all() {
            return Err(self.unknown(into.1));
        }
        Ok(self.stand(motion, &into.0, start, None))
    }

    /// The tip in a tilted plane if the program knows only the height, or all but the height: the rest stays.
    pub(crate) fn tip_in_plane(&self, motion: &Motion, start: Option<&Stance>) -> Option<Vec3> {
        let (stance, normal) = (start.filter(|_| self.knows_turns(motion))?, motion.tilt.normal?);
        let mut end = motion.end;
        end.known |= XYZ;
        let named = self.words.point(motion, &end)? + zero_point(motion);
        let now = stance.point_with(motion.tool_length_mm);
        let height = normal * normal.dot(&(now - named));
        Some(if motion.tilt.free & (1 << 2) != 0 {
            named + height
        } else {
            now - height
        })
    }

    /// Whether the program still knows the rotary coordinates that it named.
    pub(crate) fn knows_turns(&self, motion: &Motion) -> bool {
        self.state.named & !motion.start.known & !XYZ == 0
    }

    /// A control that holds the first rotary axis near the pole, or stops there with an alarm: if a vector passes through its cone,
    /// the control does not do what is followed.
    pub(crate) fn held_at_pole(&self, leg: &Leg) -> Option<Open> {
        let control = &self.machine.control;
        let cause = match control.pole_action {
            PoleAction::Through => return None,
            PoleAction::Hold => OpenCause::PoleHeld,
            PoleAction::Alarm => OpenCause::PoleAlarm,
        };
        let by_vector =
            matches!(leg.motion.orientation, Orientation::Vector(..)) && leg.motion.tilt.swivel == Swivel::No;
        let inside = leg.pole_angle_min < control.pole_cone? && leg.rotary_change[0] > NO_TURN;
        let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
        let (from, taken) = (start.rotary(self.machine), end.rotary(self.machine));
        (by_vector && inside).then_some(Open {
            cause,
            taken,
            other: [from[0], taken[1]],
        })
    }
}
