//! The path of the tool between the ends of one motion, on any machine or none, and how much it can bend.
use super::Posed;
use crate::curve::{great_circle, joint_bend};
use trunnion_geometry::math::angle_between;
use trunnion_geometry::{Vec3, arc::Arc};
use trunnion_interp::MotionKind;
use trunnion_machine::{Joints, Machine, Pose, forward, tool_axis_at};

/// What moves between the ends.
#[derive(Clone, Debug)]
enum Kind<'m> {
    /// The tip on its line or arc; the tool axis by rotary joints that run linearly, or on the great circle.
    Tip {
        arc: Option<Arc>,
        rotary: Option<(&'m Machine, [f64; 2], [f64; 2])>,
    },
    /// All joints linearly.
    Joints { machine: &'m Machine, ends: [Joints; 2] },
    /// Linear joints along an arc while no rotary one moves: the programmed X Y Z and the joints they drive.
    JointArc {
        machine: &'m Machine,
        arc: Arc,
        end: Joints,
    },
}

/// The path of the tool in one motion.
#[derive(Clone, Debug)]
pub struct Track<'m> {
    kind: Kind<'m>,
    ends: [Pose; 2],
    tool_length: f64,
    /// Work offset of X Y Z, mm.
    zero: Vec3,
}

impl<'m> Track<'m> {
    /// The path of a motion that was read with `machine` (as [`super::Run::machine`]). `None`: an end is unknown, or the path between is
    /// not modelled (an arc without tool centre point control on which rotary axes move).
    pub fn new(posed: &Posed, machine: Option<&'m Machine>) -> Option<Self> {
        let (start, end) = (posed.start?, *posed.end.as_ref().ok()?);
        let motion = &posed.motion;
        let arc = match motion.kind {
            MotionKind::Rapid | MotionKind::Linear => None,
            MotionKind::Arc(Some(arc)) => Some(arc),
            MotionKind::Arc(None) | MotionKind::Dwell(_) | MotionKind::Unknown => return None,
        };
        let machine = machine.filter(|_| posed.leg.is_some());
        let stances = posed
            .leg
            .as_ref()
            .and_then(|leg| Some((leg.start.as_ref()?.joints, leg.end.as_ref().ok()?.joints)));
        let kind = match (machine, stances) {
            (Some(machine), Some((from, to))) if !posed.tip_words() => match arc {
                None => Kind::Joints {
                    machine,
                    ends: [from, to],
                },
                Some(_) if rotary(machine, &from) != rotary(machine, &to) => return None,
                Some(arc) => Kind::JointArc { machine, arc, end: to },
            },
            (Some(machine), Some((from, to))) => {
                let circle = motion.great_circle.unwrap_or(machine.control.tcp_great_circle);
                let linear = machine.rotary.len() < 2 || !circle;
                Kind::Tip {
                    arc,
                    rotary: linear.then(|| (machine, rotary(machine, &from), rotary(machine, &to))),
                }
            }
            (Some(_), None) => return None,
            (None, _) => Kind::Tip { arc, rotary: None },
        };
        Some(Self {
            kind,
            ends: [start, end],
            tool_length: posed.tool_length,
            zero: Vec3::new(motion.zero[0], motion.zero[1], motion.zero[2]),
        })
    }

    /// The pose at the share `t`, 0..=1.
    pub fn at(&self, t: f64) -> Pose {
        let [start, end] = &self.ends;
        if t <= 0.0 {
            return *start;
        }
        if t >= 1.0 {
            return *end;
        }
        match &self.kind {
            Kind::Tip { arc, rotary } => Pose {
                tip: match arc {
                    Some(arc) => arc.point_at(t),
                    None => start.tip + (end.tip - start.tip) * t,
                },
                axis: match rotary {
                    Some((machine, from, to)) => tool_axis_at(machine, [0, 1].map(|i| from[i] + (to[i] - from[i]) * t)),
                    None => great_circle(&start.axis, &end.axis, t),
                },
            },
            Kind::Joints { machine, ends } => {
                let mut joints = ends[0];
                for (joint, to) in joints.iter_mut().zip(&ends[1]) {
                    *joint += (to - *joint) * t;
                }
                self.pose(machine, &joints)
            }
            Kind::JointArc { machine, arc, end } => {
                let mut joints = *end;
                let off = arc.point_at(t) - arc.end;
                for (letter, joint) in machine.joint_of_letter.iter().take(3).enumerate() {
                    if let Some(joint) = joint {
                        joints[usize::from(*joint)] += off[letter];
                    }
                }
                self.pose(machine, &joints)
            }
        }
    }

    /// Rotary joints at the share `t`, rad, workpiece side first; `None` without a machine or on a great circle.
    pub fn rotary_at(&self, t: f64) -> Option<[f64; 2]> {
        let between = |from: [f64; 2], to: [f64; 2]| [0, 1].map(|i| from[i] + (to[i] - from[i]) * t);
        match &self.kind {
            Kind::Tip { rotary, .. } => rotary.map(|(_, from, to)| between(from, to)),
            Kind::Joints { machine, ends } => Some(between(rotary(machine, &ends[0]), rotary(machine, &ends[1]))),
            Kind::JointArc { machine, end, .. } => Some(rotary(machine, end)),
        }
    }

    /// The machine whose rotary joints run linearly here, if any do.
    pub(super) fn rotary_machine(&self) -> Option<&'m Machine> {
        match &self.kind {
            Kind::Tip { rotary, .. } => rotary.map(|(machine, ..)| machine),
            Kind::Joints { machine, .. } | Kind::JointArc { machine, .. } => Some(machine),
        }
    }

    /// The angle that the tool axis runs through evenly on a great circle, rad: 0 where it does not move; `None`: it moves in another way.
    pub(super) fn circle_angle(&self) -> Option<f64> {
        match &self.kind {
            Kind::Tip { rotary: None, .. } => Some(angle_between(&self.ends[0].axis, &self.ends[1].axis)),
            _ => (self.bend().1 == 0.0).then_some(0.0),
        }
    }

    /// The arc on which the tip runs in the workpiece frame; `None`: it runs on none, or the linear axes distort it.
    pub fn tip_arc(&self) -> Option<Arc> {
        match &self.kind {
            Kind::Tip { arc, .. } => *arc,
            Kind::Joints { .. } => None,
            Kind::JointArc { machine, arc, end } => carried(arc, |point| {
                let mut joints = *end;
                for (letter, joint) in machine.joint_of_letter.iter().take(3).enumerate() {
                    if let Some(joint) = joint {
                        joints[usize::from(*joint)] += point[letter] - arc.end[letter];
                    }
                }
                Some(self.pose(machine, &joints).tip)
            }),
        }
    }

    /// Whether the tip runs straight whatever the machine does.
    pub fn is_straight(&self) -> bool {
        matches!(self.kind, Kind::Tip { arc: None, .. }) || self.bend().0 == 0.0
    }

    fn pose(&self, machine: &Machine, joints: &Joints) -> Pose {
        let mut pose = forward(machine, joints, self.tool_length);
        pose.tip -= self.zero;
        pose
    }

    /// Bounds on the second derivatives by the share of tip (mm) and tool axis: a point with |W''| <= Q lies within Q h^2 / 8 of
    /// any chord over a share h (kinematics notes 3).
    pub fn bend(&self) -> (f64, f64) {
        match &self.kind {
            Kind::Tip { arc, rotary } => {
                let turn = match rotary {
                    Some((_, from, to)) => (to[0] - from[0]).abs() + (to[1] - from[1]).abs(),
                    None => angle_between(&self.ends[0].axis, &self.ends[1].axis),
                };
                (arc.as_ref().map_or(0.0, arc_bend), turn * turn)
            }
            Kind::JointArc { arc, .. } => (arc_bend(arc), 0.0),
            Kind::Joints { machine, ends } => {
                let (from, to) = (rotary(machine, &ends[0]), rotary(machine, &ends[1]));
                let turn = (to[0] - from[0]).abs() + (to[1] - from[1]).abs();
                let bend = if turn == 0.0 {
                    0.0
                } else {
                    joint_bend(machine, ends, self.tool_length)
                };
                (bend, turn * turn)
            }
        }
    }
}

/// An arc carried into another frame by a rigid map of points; `None` where the map distorts it.
pub fn carried(arc: &Arc, map: impl Fn(&Vec3) -> Option<Vec3>) -> Option<Arc> {
    let centre = map(&arc.centre)?;
    let normal = map(&(arc.centre + arc.normal))? - centre;
    let (start, end) = (map(&arc.start)?, map(&arc.end)?);
    let across = map(&(arc.centre + arc.normal.cross(&(arc.start - arc.centre))))? - centre;
    let fits = |found: f64, wanted: f64| (found - wanted).abs() <= 1e-7 * (1.0 + wanted);
    let rigid = fits(normal.norm(), 1.0)
        && fits((start - centre).norm(), arc.radius_start)
        && fits(across.norm(), arc.radius_start)
        && (start - centre).dot(&normal).abs() <= 1e-7 * (1.0 + arc.radius_start)
        && fits((end - start).norm(), (arc.end - arc.start).norm());
    // a frame whose axes are left-handed turns the arc the other way
    let hand = normal.cross(&(start - centre)).dot(&across).signum();
    rigid.then(|| Arc {
        start,
        end,
        centre,
        normal: normal.normalize(),
        sweep: arc.sweep * hand,
        ..*arc
    })
}

/// Rotary joints, workpiece side first, rad; 0 for missing ones.
pub fn rotary(machine: &Machine, joints: &Joints) -> [f64; 2] {
    let mut q = [0.0; 2];
    for (slot, &joint) in q.iter_mut().zip(&machine.rotary) {
        *slot = joints[joint];
    }
    q
}

/// |W''| on an arc whose radius and angle change evenly.
fn arc_bend(arc: &Arc) -> f64 {
    let radius = arc.radius_start.max(arc.radius_end);
    radius * arc.sweep * arc.sweep + 2.0 * ((arc.radius_end - arc.radius_start) * arc.sweep).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spiral from 10 to 25 mm by 1.1 rad: the larger radius, and the widening twice.
    #[test]
    fn a_spiral_bends_by_its_larger_radius_and_its_widening() {
        for radii in [[10.0, 25.0], [25.0, 10.0]] {
            let arc = Arc {
                start: Vec3::x() * radii[0],
                end: Vec3::x(),
                centre: Vec3::zeros(),
                normal: Vec3::z(),
                sweep: -1.1,
                radius_start: radii[0],
                radius_end: radii[1],
            };
            assert!((arc_bend(&arc) - (25.0 * 1.21 + 2.0 * 15.0 * 1.1)).abs() < 1e-12);
        }
    }
}
