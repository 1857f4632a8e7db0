//! What the numbers of a motion measure: whether X Y Z and F belong to the tip, and how long the motion takes.
use super::reading::Posed;
use trunnion_geometry::Vec3;
use trunnion_interp::{Feed, MotionKind, Orientation, Swivel};
use trunnion_machine::{Joints, Machine, forward};

impl Posed {
    /// Whether X Y Z are the tip: under tool centre point control, with vectors, or where no machine is needed to read them.
    pub fn tip_words(&self) -> bool {
        let motion = &self.motion;
        let tilted = motion.tilt.normal.is_some();
        let words = motion.tcp || matches!(motion.orientation, Orientation::Vector(..)) || tilted;
        let stays = matches!(motion.tilt.swivel, Swivel::No | Swivel::TipStays);
        self.leg.is_none() || words && !motion.machine_coordinates && stays
    }

    /// Whether F is the speed along the tip's path: with tip words, or where no rotary axis turns and X Y Z run as far as the tip does. Where linear
    /// axes, or a rotary axis between them, are skewed, they move farther or less far.
    pub fn feeds_the_tip(&self) -> bool {
        let (false, Some(leg)) = (self.tip_words(), &self.leg) else {
            return true;
        };
        if leg.rotary_change != [0.0; 2] {
            return false;
        }
        match (&self.motion.kind, &self.start, &self.end) {
            (MotionKind::Rapid | MotionKind::Linear, Some(start), Ok(end)) => {
                let way = (end.tip - start.tip).norm();
                (leg.length - way).abs() <= 1e-6 * way + 1e-9
            }
            (MotionKind::Arc(_), ..) => self.square,
            _ => true,
        }
    }

    /// How long the motion takes at the programmed feed, ignoring what the axes can do, s; `None`: unknown, or a rapid. Feeds
    /// apply along the path of the tip (tip words) or of X Y Z.
    pub fn duration_s(&self) -> Option<f64> {
        let way = match (&self.leg, &self.motion.kind) {
            (_, MotionKind::Arc(Some(arc))) => arc.length(),
            (Some(leg), _) => leg.length,
            (None, _) => (self.end.as_ref().ok()?.tip - self.start?.tip).norm(),
        };
        match self.motion.feed {
            Feed::PerMinute(feed) if way > 0.0 => Some(way / feed * 60.0),
            // where nothing but rotary axes moves, F counts degrees (RS274/NGC)
            Feed::PerMinute(feed) if !self.tip_words() => {
                let [first, second] = self.leg.as_ref()?.rotary_change.map(trunnion_geometry::deg);
                let turned = (first * first + second * second).sqrt();
                (turned > 0.0).then(|| turned / feed * 60.0)
            }
            Feed::PerRevolution(feed) if way > 0.0 => {
                let rpm = self.motion.spindle_rpm.filter(|rpm| *rpm > 0.0)?;
                Some(way / (feed * rpm) * 60.0)
            }
            Feed::InverseTime(per_minute) if per_minute > 0.0 => Some(60.0 / per_minute),
            _ => None,
        }
    }
}

/// Whether X, Y and Z move the tip by as much as themselves, at right angles to each other.
pub(super) fn keeps_lengths(machine: &Machine, joints: &Joints) -> bool {
    let at = |joints: &Joints| forward(machine, joints, 0.0).tip;
    let here = at(joints);
    let ways: Vec<Vec3> = machine
        .joint_of_letter
        .iter()
        .take(3)
        .flatten()
        .map(|&joint| {
            let mut moved = *joints;
            moved[usize::from(joint)] += 1.0;
            at(&moved) - here
        })
        .collect();
    let is_square = |i: usize, j: usize| (ways[i].dot(&ways[j]) - f64::from(u8::from(i == j))).abs() < 1e-9;
    (0..ways.len()).all(|i| (i..ways.len()).all(|j| is_square(i, j)))
}
