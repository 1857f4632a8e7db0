//! Rapids of which only some axes are known, compared by their words.
use super::Posed;
use trunnion_geometry::Vec3;
use trunnion_interp::{MotionKind, Orientation, Tilt};
use trunnion_machine::{Joints, MAX_AXES, Machine, forward};

/// The axes that a rapid moves to known places, by index (X Y Z A B C U V W), with the place in mm or deg. `None`: it is not a plain rapid
/// in words (machine coordinates, a tilted plane), or it moves an axis to an unknown position.
pub fn moved_axes(posed: &Posed) -> Option<Vec<(usize, f64)>> {
    let motion = &posed.motion;
    let plain = motion.kind == MotionKind::Rapid
        && !motion.machine_coordinates
        && motion.orientation == Orientation::Words
        && motion.tilt == Tilt::default()
        // a path that a word defines itself, or an axis that moves to an unknown position
        && motion.says_way == 0;
    plain.then(|| {
        let moved = |axis: &usize| motion.end.get(*axis).is_some() && motion.start.get(*axis) != motion.end.get(*axis);
        let axes = (0..9).filter(moved);
        axes.filter_map(|axis| Some((axis, motion.end.get(axis)?))).collect()
    })
}

/// Whether words of axes mean the same on both machines: on the same one, or where X Y Z are the tip and nothing turns.
pub fn same_words(before: Option<&Machine>, after: Option<&Machine>) -> bool {
    match (before, after) {
        (Some(one), Some(other)) if one.axes == other.axes && one.home == other.home => true,
        (one, other) => one.is_none_or(is_plain) && other.is_none_or(is_plain),
    }
}

/// Whether nothing turns and X Y Z move the tip along X Y Z.
fn is_plain(machine: &Machine) -> bool {
    let at = |joints: &Joints| forward(machine, joints, 0.0).tip;
    let origin = at(&[0.0; MAX_AXES]);
    let units = [Vec3::x(), Vec3::y(), Vec3::z()];
    machine.rotary.is_empty()
        && machine.axes.iter().all(|axis| !axis.extra.diameter)
        && machine.joint_of_letter.iter().zip(units).all(|(joint, unit)| {
            joint.is_some_and(|joint| {
                let mut joints = [0.0; MAX_AXES];
                joints[usize::from(joint)] = 1.0;
                (at(&joints) - origin - unit).norm() < 1e-12
            })
        })
}

/// How far the words of two such rapids lie apart, mm and deg; `None`: they do not move the same axes.
pub(super) fn words_apart(old: &Posed, new: &Posed) -> Option<(f64, f64)> {
    let (was, is) = (moved_axes(old)?, moved_axes(new)?);
    if old.motion.tcp != new.motion.tcp {
        return None;
    }
    let mut apart = (0.0f64, 0.0f64);
    // an axis that is moved to where it already is does not move
    let stands = |axis: usize, value: f64| old.motion.start.get(axis) == Some(value);
    for (axis, value) in &is {
        let wanted = was.iter().find(|(known, _)| known == axis);
        let wanted = wanted
            .map(|(_, value)| *value)
            .or_else(|| old.motion.start.get(*axis))?;
        let off = (value - wanted).abs();
        if (3..6).contains(axis) {
            apart.1 = apart.1.max(off);
        } else {
            apart.0 = apart.0.max(off);
        }
    }
    let all = was
        .iter()
        .all(|(axis, value)| stands(*axis, *value) || is.iter().any(|(known, _)| known == axis));
    all.then_some(apart)
}
