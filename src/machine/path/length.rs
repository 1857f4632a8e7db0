//! The length of a block's path, along which F is the speed.
use crate::follow::follower::has_tip_words;
use crate::{FeedMeaning, Follower, Leg, Machine};
use trunnion_geometry::math::hypot;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{Feed, MotionKind};

/// A shorter path is taken as none, mm: rounding of increments, unit conversions and changes of the frame at coordinates of up to 100
/// m. No control resolves it, and a speed along it would be noise.
const NO_WAY: f64 = 1e-9;

/// The length of a path, 0 where there is none.
#[inline]
pub(crate) fn way(length: f64) -> f64 {
    if length < NO_WAY { 0.0 } else { length }
}

/// What the rotary axes add to the path along which F is the speed, deg: nothing unless F includes all axes.
pub(crate) fn rotary_part(machine: &Machine, leg: &Leg) -> f64 {
    let motion = &leg.motion;
    let combined = machine.control.feed == Some(FeedMeaning::Combined);
    let by_way = matches!(motion.feed, Feed::PerMinute(_) | Feed::PerRevolution(_));
    if !(combined && by_way && motion.is_feed()) || has_tip_words(motion) {
        return 0.0;
    }
    let [first, second] = leg.rotary_change.map(deg);
    hypot(first, second)
}

impl Follower<'_> {
    /// Length along which F is the speed, mm: [`Self::length`], or on a control whose F includes all axes the root of mm2 + deg2.
    pub(crate) fn feed_length(&self, leg: &Leg) -> f64 {
        let turned = rotary_part(self.machine, leg);
        if turned > 0.0 && leg.length > 0.0 {
            hypot(leg.length, turned)
        } else {
            leg.length
        }
    }

    /// Length of the tip path (TCP) or of the programmed X Y Z path, mm; 0 where it is unknown.
    pub(crate) fn length(&self, leg: &Leg) -> f64 {
        let motion = &leg.motion;
        match &motion.kind {
            MotionKind::Dwell(_) | MotionKind::Unknown | MotionKind::Arc(None) => 0.0,
            MotionKind::Arc(Some(arc)) => arc.length(),
            MotionKind::Rapid | MotionKind::Linear => {
                if let (true, Some(start), Ok(end)) = (has_tip_words(motion), &leg.start, &leg.end) {
                    return way((end.point - start.point_with(end.tool_length)).norm());
                }
                match (
                    self.words.point(motion, &motion.start),
                    self.words.point(motion, &motion.end),
                ) {
                    (Some(from), Some(to)) => way((to - from).norm()),
                    _ => self.joint_length(leg),
                }
            }
        }
    }

    /// Length of the X Y Z path by the joints of these letters, mm, where the program does not know all coordinates but the machine
    /// knows the joints; else 0.
    fn joint_length(&self, leg: &Leg) -> f64 {
        let both = self.state.known_joints.1 & leg.known_joints.1;
        let mut way = Vec3::zeros();
        for (letter, joint) in self.machine.joint_of_letter.iter().take(3).enumerate() {
            let Some(joint) = joint.map(usize::from) else { continue };
            if both & (1 << joint) == 0 {
                return 0.0;
            }
            way[letter] = leg.known_joints.0[joint] - self.state.known_joints.0[joint];
        }
        self::way(way.norm())
    }
}
