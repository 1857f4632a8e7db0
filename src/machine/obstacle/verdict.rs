//! How near a tool comes to the obstacles of a machine in one motion.
use super::column::{Gap, corridor_gap, straight_gap};
use super::sweep::Sweep;
use super::{Obstacle, SLACK_MM, ToolBody, linear_steps, tool_in_frame};
use crate::{AxisKind, Leg, Machine, RapidPath, Stance};
use trunnion_geometry::Vec3;
use trunnion_interp::MotionKind;

/// A tool axis is upright in a frame if it differs by no more from it.
const UPRIGHT: f64 = 1e-9;

/// How near a tool comes to an obstacle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Nearness {
    /// Farther than the distance to be kept: by what is known the distance is at least this, mm (infinite: it passes above).
    Clear(f64),
    /// Nearer than that, without touching it, mm; `None`: by an amount that is not known.
    Near(Option<f64>),
    /// It touches or enters it.
    Through,
    /// Undecided, and why.
    Unknown(&'static str),
}

/// An obstacle and how near the tool comes to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Near {
    /// Index in [`Machine::obstacles`].
    pub obstacle: usize,
    /// How near.
    pub nearness: Nearness,
}

/// How near a tool comes to each obstacle of the machine while it makes a motion between known positions; `keep`: the distance that it is to keep, mm.
///
/// An upright tool on a straight line is judged exactly, as a column without upper end; where the axes do not certainly arrive together in a rapid, all
/// that they may pass is judged. Otherwise the tool is a cylinder of its length, and the result is proved by bounds or unknown.
/// The part is left out.
pub fn nearness(machine: &Machine, leg: &Leg, body: &ToolBody, keep: f64) -> Vec<Near> {
    let mut found = nearness_with_part(machine, leg, body, keep);
    found.retain(|near| !machine.obstacles[near.obstacle].is_part());
    found
}

/// [`nearness`] of the part, too.
pub fn nearness_with_part(machine: &Machine, leg: &Leg, body: &ToolBody, keep: f64) -> Vec<Near> {
    let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
        return Vec::new();
    };
    if matches!(leg.motion.kind, MotionKind::Dwell(_)) {
        return Vec::new();
    }
    let mut found = Vec::new();
    for (index, obstacle) in machine.obstacles.iter().enumerate() {
        let near = obstacle
            .frame(machine)
            .map_or(Nearness::Unknown("the machine has no such axis"), |frame| {
                let of = One {
                    machine,
                    leg,
                    body,
                    keep,
                    frame,
                    index,
                };
                of.nearness(start, end)
            });
        found.push(Near {
            obstacle: index,
            nearness: near,
        });
    }
    found
}

/// A motion past one obstacle.
struct One<'a> {
    machine: &'a Machine,
    leg: &'a Leg,
    body: &'a ToolBody,
    keep: f64,
    frame: usize,
    index: usize,
}

impl One<'_> {
    fn nearness(&self, start: &Stance, end: &Stance) -> Nearness {
        // the length that the tool has, where that is declared
        let tool_length = self.body.length_mm.unwrap_or(end.tool_length);
        let obstacle = &self.machine.obstacles[self.index];
        let poses = [start, end].map(|stance| tool_in_frame(self.machine, &stance.joints, tool_length, self.frame));
        let turns = (0..self.machine.axes.len())
            .any(|joint| self.machine.axes[joint].kind == AxisKind::Rotary && start.joints[joint] != end.joints[joint]);
        let upright = poses.iter().all(|pose| (pose.axis - Vec3::z()).norm() <= UPRIGHT);
        let straight = matches!(self.leg.motion.kind, MotionKind::Rapid | MotionKind::Linear);
        if turns || !upright || !straight {
            let sweep = Sweep::new(self.machine, self.leg, self.body, (self.frame, tool_length));
            return sweep.map_or(Nearness::Unknown("the path is not known"), |sweep| {
                sweep.nearness(obstacle, self.keep)
            });
        }
        let [from, to] = poses.map(|pose| pose.tip);
        let obstacles = self.machine.obstacles.iter();
        let others: Vec<&Obstacle> = obstacles
            .filter(|other| other.kind == obstacle.kind && other.frame(self.machine) == Some(self.frame))
            .collect();
        let own = others
            .iter()
            .position(|other| core::ptr::eq(*other, obstacle))
            .unwrap_or(0);
        let gap = straight_gap(&others, own, self.body, (&from, &to), self.keep);
        let judged = self.judge(gap);
        let independent =
            self.leg.motion.kind == MotionKind::Rapid && self.machine.control.rapid != RapidPath::Synchronous;
        if !independent || !matches!(judged, Nearness::Clear(_)) {
            return judged;
        }
        let joints = (&start.joints, &end.joints);
        let moves: Vec<Vec3> = linear_steps(self.machine, joints, tool_length, self.frame).collect();
        match self.judge(corridor_gap(obstacle, self.body, (&from, &moves), self.keep)) {
            Nearness::Clear(mm) => Nearness::Clear(mm),
            _ if moves.len() < 2 => judged,
            _ => Nearness::Unknown("the axes may not arrive together in a rapid, and then the tool may pass nearer"),
        }
    }

    fn judge(&self, gap: Option<Gap>) -> Nearness {
        match gap {
            None => Nearness::Clear(f64::INFINITY),
            Some(gap) if gap.through => Nearness::Through,
            Some(gap) if gap.mm < self.keep - SLACK_MM => Nearness::Near(Some(gap.mm.max(0.0))),
            Some(gap) => Nearness::Clear(gap.mm),
        }
    }
}
