//! One hole: where it is and how the tool gets there.
use super::Work;
use crate::{Canon, Plane, Pose};

/// Places of first, second and hole axis in a pose, and how the plane and the axis are called.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axes {
    pub(super) places: [usize; 3],
    pub(super) plane: &'static str,
    pub(super) axis: &'static str,
}

/// The hole axis of a plane. The letter cases are those of the control's messages.
pub(super) fn axes(plane: Plane) -> Axes {
    let (places, plane, axis) = match plane {
        Plane::Xy => ([0, 1, 2], "xy", "z"),
        Plane::Xz => ([2, 0, 1], "xz", "y"),
        Plane::Yz => ([1, 2, 0], "yz", "x"),
        Plane::Uv => ([6, 7, 8], "UV", "W"),
        Plane::Uw => ([8, 6, 7], "UW", "V"),
        Plane::Vw => ([7, 8, 6], "VW", "U"),
    };
    Axes { places, plane, axis }
}

/// One hole of a cycle; coordinates of the program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hole {
    pub(super) places: [usize; 3],
    /// First and second coordinate.
    pub(super) at: [f64; 2],
    pub(super) bottom: f64,
    /// Where the feed begins.
    pub(super) r: f64,
    /// Where the tool retracts to.
    pub(super) clear: f64,
}

impl Hole {
    /// The pose over the hole, all other axes where they are.
    pub(super) fn pose(&self, work: &Work<'_>, at: [f64; 2], level: f64) -> Pose {
        let mut pose = work.engine.state.current;
        let [first, second, third] = self.places;
        (pose[first], pose[second], pose[third]) = (at[0], at[1], level);
        pose
    }
    /// Rapid to a level over the hole.
    pub(super) fn rapid(&self, work: &mut Work<'_>, level: f64) {
        self.rapid_beside(work, self.at, level);
    }
    /// Rapid to a level next to the hole.
    pub(super) fn rapid_beside(&self, work: &mut Work<'_>, at: [f64; 2], level: f64) {
        let pose = self.pose(work, at, level);
        work.engine.state.current = pose;
        work.emit(Canon::Traverse(pose));
    }
    /// Feed to a level.
    pub(super) fn feed(&self, work: &mut Work<'_>, level: f64) {
        let pose = self.pose(work, self.at, level);
        work.engine.state.current = pose;
        work.emit(Canon::Feed(pose));
    }
}
