//! Where the tool is between the two ends of a motion, and how much its path can bend: the base of every bound.
//!
//! For a point that moves on W(t), 0 <= t <= 1, with |W''| <= Q, the distance of W from any chord between two moments h apart
//! is at most Q h^2 / 8 (docs/kinematics.md#between-the-ends-of-a-block). The same holds for the difference of two such points.
use crate::curve::{great_circle, joint_bend};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{angle_between, asin};
use trunnion_interp::MotionKind;
use trunnion_machine::{AxisKind, Joints, Leg, MAX_AXES, Machine, Pose, Stance, forward, tool_axis};

/// Most moments at which two paths are compared.
const MOST_SAMPLES: u32 = 512;

/// How the ends are joined.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Interpolation {
    /// Joints run linear in time.
    Joints,
    /// The tip runs straight in the part, rotary joints linear.
    TipStraight,
    /// The tip runs straight in the part, the tool axis on the great circle.
    GreatCircle,
}

/// A tool path of one motion.
pub(crate) struct Path<'m> {
    machine: &'m Machine,
    interpolation: Interpolation,
    /// Joints at both ends, mm or rad.
    joints: [Joints; 2],
    /// Tool axes at both ends.
    axes: [Vec3; 2],
    /// Tips at both ends without the work offset, mm: it cancels in every difference of two paths, but must be left out here as it is in the
    /// paths of joints.
    tips: [Vec3; 2],
    /// mm.
    tool_length: f64,
    /// Distance of the followed point from the tip along the tool axis, mm.
    height: f64,
}

impl<'m> Path<'m> {
    /// The path of the point `height` mm above the tip. `None` where the path between the ends is not modelled: arcs, unknown motions.
    pub(crate) fn new(machine: &'m Machine, leg: &Leg, start: &Stance, end: &Stance, height: f64) -> Option<Self> {
        let motion = &leg.motion;
        let vectors = matches!(motion.orientation, trunnion_interp::Orientation::Vector(..));
        let interpolation = match motion.kind {
            MotionKind::Rapid | MotionKind::Linear if !motion.tcp && !vectors => Interpolation::Joints,
            MotionKind::Rapid | MotionKind::Linear
                if motion.great_circle.unwrap_or(machine.control.tcp_great_circle) =>
            {
                Interpolation::GreatCircle
            }
            MotionKind::Rapid | MotionKind::Linear => Interpolation::TipStraight,
            MotionKind::Dwell(_) => Interpolation::Joints,
            MotionKind::Arc(_) | MotionKind::Unknown => return None,
        };
        Some(Self {
            machine,
            interpolation,
            joints: [start.joints, end.joints],
            axes: [start.axis, end.axis],
            tips: [start, end].map(|stance| forward(machine, &stance.joints, end.tool_length).tip),
            tool_length: end.tool_length,
            height,
        })
    }

    /// Point (mm) and tool axis at the share `t` of the motion, workpiece frame.
    fn at(&self, t: f64) -> (Vec3, Vec3) {
        let axis = match self.interpolation {
            Interpolation::Joints => {
                let pose = self.pose(t);
                return (pose.tip + pose.axis * self.height, pose.axis);
            }
            Interpolation::TipStraight => tool_axis(self.machine, &self.joints_at(t)),
            Interpolation::GreatCircle => great_circle(&self.axes[0], &self.axes[1], t),
        };
        let [from, to] = self.tips;
        (from + (to - from) * t + axis * self.height, axis)
    }

    /// The pose at the share `t` of the way that the joints take.
    fn pose(&self, t: f64) -> Pose {
        forward(self.machine, &self.joints_at(t), self.tool_length)
    }

    /// The joints at the share `t`, mm or rad.
    fn joints_at(&self, t: f64) -> Joints {
        let mut joints: Joints = [0.0; MAX_AXES];
        for (joint, (from, to)) in joints.iter_mut().zip(self.joints[0].iter().zip(&self.joints[1])) {
            *joint = from + (to - from) * t;
        }
        joints
    }

    /// Bounds on the second derivatives of point (mm) and tool axis.
    fn bend(&self) -> (f64, f64) {
        let turn: f64 = self.turns().iter().map(|(_, change)| change).sum();
        let axis = match self.interpolation {
            Interpolation::GreatCircle => angle_between(&self.axes[0], &self.axes[1]),
            Interpolation::Joints | Interpolation::TipStraight => turn,
        };
        let axis = axis * axis;
        match self.interpolation {
            Interpolation::Joints => (
                joint_bend(self.machine, &self.joints, self.tool_length - self.height),
                axis,
            ),
            Interpolation::TipStraight | Interpolation::GreatCircle => (self.height.abs() * axis, axis),
        }
    }

    /// Rotary joints with the size of their change, rad.
    fn turns(&self) -> Vec<(usize, f64)> {
        let rotary = |joint: &usize| self.machine.axes[*joint].kind == AxisKind::Rotary;
        let change = |joint: usize| (joint, (self.joints[1][joint] - self.joints[0][joint]).abs());
        (0..self.machine.axes.len()).filter(rotary).map(change).collect()
    }
}

/// How far two paths lie apart at the same share of the motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Apart {
    /// Largest distance found, mm.
    pub sampled_mm: f64,
    /// No distance is larger, mm.
    pub bound_mm: f64,
    /// Largest angle between the tool axes found, rad.
    pub sampled_axis: f64,
    /// No angle is larger, rad.
    pub bound_axis: f64,
}

/// Compares two paths: samples at equal moments, and a bound for all moments between them.
pub(crate) fn apart(before: &Path<'_>, after: &Path<'_>) -> Apart {
    let (bend_before, bend_after) = (before.bend(), after.bend());
    let bend = (bend_before.0 + bend_after.0, bend_before.1 + bend_after.1);
    // so many that the bound is at most 1e-6 mm (or rad) above the samples, if that is affordable
    let wanted = (bend.0.max(bend.1) / 8e-6).sqrt().ceil();
    let steps = if wanted < f64::from(MOST_SAMPLES) {
        (wanted as u32).max(1)
    } else {
        MOST_SAMPLES
    };
    let (mut distance, mut chord) = (0.0f64, 0.0f64);
    for step in 0..=steps {
        let t = f64::from(step) / f64::from(steps);
        let ((point, axis), (point_after, axis_after)) = (before.at(t), after.at(t));
        distance = distance.max((point_after - point).norm());
        chord = chord.max((axis_after - axis).norm());
    }
    let between = 1.0 / (8.0 * f64::from(steps) * f64::from(steps));
    Apart {
        sampled_mm: distance,
        bound_mm: distance + bend.0 * between,
        sampled_axis: chord_angle(chord),
        bound_axis: chord_angle(chord + bend.1 * between),
    }
}

/// The angle between two unit vectors whose tips are `chord` apart, rad.
fn chord_angle(chord: f64) -> f64 {
    2.0 * asin((0.5 * chord).min(1.0))
}

#[cfg(test)]
mod tests;
