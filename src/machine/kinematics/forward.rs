//! Joints to tool pose.
use crate::{Constants, Joints, Machine};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::sin_cos;

/// Where the tool is, in the workpiece frame (the frame of the part, which at home is the machine frame).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Tool tip, mm.
    pub tip: Vec3,
    /// Unit tool axis, tip -> spindle.
    pub axis: Vec3,
}

/// A rotation about a fixed unit vector whose sine and cosine are known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    pub(crate) axis: Vec3,
    pub(crate) sin: f64,
    pub(crate) cos: f64,
}

impl Turn {
    /// No turn.
    pub(crate) const NONE: Self = Self {
        axis: Vec3::new(0.0, 0.0, 1.0),
        sin: 0.0,
        cos: 1.0,
    };

    /// Turn of rotary axis `index` (0 = nearest the workpiece) at joint value `q`, rad.
    #[inline]
    pub(crate) fn new(constants: &Constants, index: usize, q: f64) -> Self {
        let rotary = &constants.rotary[index];
        let (sin, cos) = sin_cos(rotary.sign * q);
        Self {
            axis: rotary.direction,
            sin,
            cos,
        }
    }
    /// The turned vector (Rodrigues' formula).
    #[inline]
    pub(crate) fn apply(&self, v: &Vec3) -> Vec3 {
        self.by(self.sin, v)
    }
    /// The vector turned back.
    #[inline]
    pub(crate) fn undo(&self, v: &Vec3) -> Vec3 {
        self.by(-self.sin, v)
    }
    /// By the angle with this sine.
    #[inline]
    fn by(&self, sin: f64, v: &Vec3) -> Vec3 {
        Along::of(&self.axis).turn(&self.axis, (sin, self.cos), v)
    }
}

/// The direction of the axis of a turn: most are parallel to a coordinate axis, whose component the turn leaves unchanged.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Along {
    /// Its direction along X, 1 or -1.
    X(f64),
    Y(f64),
    Z(f64),
    Askew,
}

impl Along {
    /// Of a unit vector.
    #[inline]
    pub(crate) fn of(e: &Vec3) -> Self {
        if e.x == 0.0 && e.y == 0.0 {
            Self::Z(e.z)
        } else if e.y == 0.0 && e.z == 0.0 {
            Self::X(e.x)
        } else if e.x == 0.0 && e.z == 0.0 {
            Self::Y(e.y)
        } else {
            Self::Askew
        }
    }

    /// A vector turned about the axis `e`, which this describes, by the angle with this sine and cosine (Rodrigues' formula).
    #[inline]
    pub(crate) fn turn(self, e: &Vec3, (sin, cos): (f64, f64), v: &Vec3) -> Vec3 {
        match self {
            Self::Z(direction) => about_z((sin * direction, cos), v),
            Self::X(direction) => about_x((sin * direction, cos), v),
            Self::Y(direction) => about_y((sin * direction, cos), v),
            Self::Askew => askew(e, (sin, cos), v),
        }
    }

    /// The same of two vectors.
    #[inline]
    pub(crate) fn turn_both(self, e: &Vec3, (sin, cos): (f64, f64), a: &Vec3, b: &Vec3) -> (Vec3, Vec3) {
        match self {
            Self::Z(direction) => {
                let turn = (sin * direction, cos);
                (about_z(turn, a), about_z(turn, b))
            }
            Self::X(direction) => {
                let turn = (sin * direction, cos);
                (about_x(turn, a), about_x(turn, b))
            }
            Self::Y(direction) => {
                let turn = (sin * direction, cos);
                (about_y(turn, a), about_y(turn, b))
            }
            Self::Askew => (askew(e, (sin, cos), a), askew(e, (sin, cos), b)),
        }
    }
}

#[inline]
fn about_x((sin, cos): (f64, f64), v: &Vec3) -> Vec3 {
    Vec3::new(v.x, v.y * cos - v.z * sin, v.y * sin + v.z * cos)
}

#[inline]
fn about_y((sin, cos): (f64, f64), v: &Vec3) -> Vec3 {
    Vec3::new(v.x * cos + v.z * sin, v.y, v.z * cos - v.x * sin)
}

#[inline]
fn about_z((sin, cos): (f64, f64), v: &Vec3) -> Vec3 {
    Vec3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z)
}

#[inline(never)]
fn askew(e: &Vec3, (sin, cos): (f64, f64), v: &Vec3) -> Vec3 {
    v * cos + e.cross(v) * sin + e * (e.dot(v) * (1.0 - cos))
}

/// Sum of the linear motions in each of the three segments of the chain: before, between and after the rotary axes.
#[inline]
pub(crate) fn segment_shifts(constants: &Constants, joints: &Joints) -> [Vec3; 3] {
    let mut shifts = [Vec3::zeros(); 3];
    if let Some(segment) = constants.only_segment {
        let mut shift = Vec3::zeros();
        for linear in constants.linear() {
            shift += linear.motion * joints[linear.joint];
        }
        shifts[segment] = shift;
        return shifts;
    }
    for linear in constants.linear() {
        shifts[linear.segment] += linear.motion * joints[linear.joint];
    }
    shifts
}

/// Forward kinematics: docs/kinematics.md#machine-model (product of the chain's motions, workpiece to tool). `tool_length` in mm. A held axis is used
/// with its value in `joints`.
pub fn forward(machine: &Machine, joints: &Joints, tool_length: f64) -> Pose {
    if let Some(other) = machine.held_elsewhere(joints) {
        return forward(&other, joints, tool_length);
    }
    let constants = &machine.constants;
    let shifts = segment_shifts(constants, joints);
    let mut tip = machine.gauge_point - machine.tool_axis * tool_length + shifts[constants.rotary_count];
    let mut axis = machine.tool_axis;
    for index in (0..constants.rotary_count).rev() {
        let rotary = &constants.rotary[index];
        let turn = Turn::new(constants, index, joints[rotary.joint]);
        tip = turn.apply(&(tip - rotary.point)) + rotary.point + shifts[index];
        axis = turn.apply(&axis);
    }
    Pose { tip, axis }
}

/// The tool axis of [`forward`] alone, workpiece frame.
pub fn tool_axis(machine: &Machine, joints: &Joints) -> Vec3 {
    if let Some(other) = machine.held_elsewhere(joints) {
        return tool_axis(&other, joints);
    }
    let rotary = &machine.constants.rotary;
    tool_axis_at(machine, [joints[rotary[0].joint], joints[rotary[1].joint]])
}

/// Tool axis in the workpiece frame for two rotary joint values, rad (a missing one is ignored): u = R1 R2 k0, docs/kinematics.md#machine-model.
pub fn tool_axis_at(machine: &Machine, q: [f64; 2]) -> Vec3 {
    let constants = &machine.constants;
    let mut axis = machine.tool_axis;
    for index in (0..constants.rotary_count).rev() {
        axis = Turn::new(constants, index, q[index]).apply(&axis);
    }
    axis
}

#[cfg(test)]
mod tests {
    use super::Turn;
    use proptest::prelude::*;
    use trunnion_geometry::Vec3;
    use trunnion_geometry::math::{rotate, sin_cos};

    proptest! {
        /// Along each coordinate, in both directions, and skewed: same as the formula without its short cuts, and back again.
        #[test]
        fn turns_are_those_of_rodrigues(
            axis in prop_oneof![
                (0..3_usize, any::<bool>()).prop_map(|(axis, back)| Vec3::ith(axis, if back { -1.0 } else { 1.0 })),
                // skewed by so little that its length along the coordinate is 1 to the last bit
                (0..3_usize).prop_map(|axis| Vec3::ith(axis, 1.0) + Vec3::ith((axis + 1) % 3, 9e-9)),
                proptest::array::uniform3(-1.0..1.0).prop_map(|v: [f64; 3]| Vec3::from(v).normalize()),
            ],
            angle in -7.0..7.0,
            v in proptest::array::uniform3(-1e3..1e3),
        ) {
            let v = Vec3::from(v);
            let (sin, cos) = sin_cos(angle);
            let turn = Turn { axis, sin, cos };
            let turned = turn.apply(&v);
            prop_assert!((turned - rotate(&axis, angle, &v)).norm() < 1e-11, "{turned}");
            prop_assert!((turn.undo(&turned) - v).norm() < 1e-11);
        }
    }
}
