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
    /// How many pieces of the motion were looked at; 0: boxes about the motion and the obstacle settled it.
    pub pieces: u64,
}

/// How near a tool comes to each obstacle of the machine while it makes a motion between known positions; `keep`: the distance that it is to keep, mm.
///
/// An upright tool on a straight line is judged exactly, as a column without upper end; where the axes do not certainly arrive together in a rapid, all
/// that they may pass is judged. Otherwise the tool is a cylinder of its length, and the result is proved by bounds or unknown.
/// The part is left out. The distance of what is far may be stated lower than it is.
pub fn nearness(machine: &Machine, leg: &Leg, body: &ToolBody, keep: f64) -> Vec<Near> {
    passed(machine, leg, (body, keep), |obstacle, seen| {
        let judge = |seen: &Seen<'_>| {
            let far = seen.far(obstacle).map(|far| (far, 0));
            far.unwrap_or_else(|| seen.nearness(obstacle))
        };
        (!obstacle.is_part()).then(|| seen.map(judge))
    })
}

/// [`nearness`] of the part, too, and with the distance of what is far.
pub fn nearness_with_part(machine: &Machine, leg: &Leg, body: &ToolBody, keep: f64) -> Vec<Near> {
    passed(machine, leg, (body, keep), |obstacle, seen| {
        Some(seen.map(|seen| seen.nearness(obstacle)))
    })
}

/// What `judge` says of each obstacle as the tool passes it, if it says something, and how many pieces it looked at; it gets the motion as the obstacle sees it.
fn passed<'a>(
    machine: &'a Machine,
    leg: &'a Leg,
    (body, keep): (&'a ToolBody, f64),
    judge: impl Fn(&Obstacle, Option<&Seen<'a>>) -> Option<Option<(Nearness, u64)>>,
) -> Vec<Near> {
    let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
        return Vec::new();
    };
    if matches!(leg.motion.kind, MotionKind::Dwell(_)) {
        return Vec::new();
    }
    // most obstacles move with the same frame
    let mut frames: Vec<Seen<'a>> = Vec::new();
    let mut found = Vec::new();
    for (index, obstacle) in machine.obstacles.iter().enumerate() {
        let seen = obstacle.frame(machine).map(|frame| {
            let known = frames.iter().position(|seen| seen.frame == frame);
            known.unwrap_or_else(|| {
                frames.push(Seen::new(machine, leg, (body, keep), (start, end), frame));
                frames.len() - 1
            })
        });
        if let Some(judged) = judge(obstacle, seen.map(|seen| &frames[seen])) {
            let (nearness, pieces) = judged.unwrap_or((Nearness::Unknown("the machine has no such axis"), 0));
            found.push(Near {
                obstacle: index,
                nearness,
                pieces,
            });
        }
    }
    found
}

/// A motion as the obstacles see it that move with a frame.
struct Seen<'a> {
    machine: &'a Machine,
    body: &'a ToolBody,
    keep: f64,
    frame: usize,
    way: Way<'a>,
}

/// How the tool moves in a frame.
enum Way<'a> {
    /// Upright, its tip in a straight line.
    Straight {
        ends: [Vec3; 2],
        /// The moves of the single axes, where these do not certainly arrive together.
        moves: Option<Vec<Vec3>>,
        /// Lowest and highest coordinates of all places of the tip.
        extent: [Vec3; 2],
    },
    /// In another way; `None`: the path is not known.
    Swept(Option<Box<Sweep<'a>>>),
}

impl<'a> Seen<'a> {
    fn new(
        machine: &'a Machine,
        leg: &'a Leg,
        (body, keep): (&'a ToolBody, f64),
        (start, end): (&Stance, &Stance),
        frame: usize,
    ) -> Self {
        // the length that the tool has, where that is declared
        let tool_length = body.length_mm.unwrap_or(end.tool_length);
        let poses = [start, end].map(|stance| tool_in_frame(machine, &stance.joints, tool_length, frame));
        let turns = (0..machine.axes.len())
            .any(|joint| machine.axes[joint].kind == AxisKind::Rotary && start.joints[joint] != end.joints[joint]);
        let upright = poses.iter().all(|pose| (pose.axis - Vec3::z()).norm() <= UPRIGHT);
        let straight = matches!(leg.motion.kind, MotionKind::Rapid | MotionKind::Linear);
        let way = if turns || !upright || !straight {
            Way::Swept(Sweep::new(machine, leg, body, (frame, tool_length)).map(Box::new))
        } else {
            let ends = poses.map(|pose| pose.tip);
            let independent = leg.motion.kind == MotionKind::Rapid && machine.control.rapid != RapidPath::Synchronous;
            let joints = (&start.joints, &end.joints);
            let moves: Option<Vec<Vec3>> =
                independent.then(|| linear_steps(machine, joints, tool_length, frame).collect());
            let none = Vec3::zeros();
            let steps = moves.iter().flatten();
            let [low, high] = steps.fold([ends[0]; 2], |[low, high], step| {
                [low + step.inf(&none), high + step.sup(&none)]
            });
            Way::Straight {
                extent: [low.inf(&ends[1]), high.sup(&ends[1])],
                ends,
                moves,
            }
        };
        Self {
            machine,
            body,
            keep,
            frame,
            way,
        }
    }

    /// Whether boxes about the motion and an obstacle show that the tool keeps its distance: the distance of the boxes.
    fn far(&self, obstacle: &Obstacle) -> Option<Nearness> {
        let Way::Straight { extent, .. } = &self.way else {
            return None;
        };
        let [from, to] = obstacle.footprint.extent();
        let [low, high] = extent;
        let apart = (from - high.xy()).sup(&(low.xy() - to)).max();
        let mm = apart - self.body.widest();
        let above = low.z >= obstacle.top + self.keep - SLACK_MM;
        let far = mm >= self.keep + SLACK_MM;
        (above || far).then_some(Nearness::Clear(if above { f64::INFINITY } else { mm }))
    }

    /// How near the tool comes to an obstacle, and how many pieces of the motion were looked at.
    fn nearness(&self, obstacle: &Obstacle) -> (Nearness, u64) {
        match &self.way {
            Way::Straight { ends, moves, .. } => (self.straight(obstacle, ends, moves.as_deref()), 1),
            Way::Swept(None) => (Nearness::Unknown("the path is not known"), 0),
            Way::Swept(Some(sweep)) => {
                let before = sweep.left();
                let nearness = sweep.nearness(obstacle, self.keep);
                (nearness, (before - sweep.left()) as u64)
            }
        }
    }

    fn straight(&self, obstacle: &Obstacle, [from, to]: &[Vec3; 2], moves: Option<&[Vec3]>) -> Nearness {
        let all = || {
            let obstacles = self.machine.obstacles.iter();
            obstacles
                .filter(|other| other.kind == obstacle.kind && other.frame(self.machine) == Some(self.frame))
                .collect()
        };
        let judged = self.judge(straight_gap(obstacle, all, self.body, (from, to), self.keep));
        let Some(moves) = moves.filter(|_| matches!(judged, Nearness::Clear(_))) else {
            return judged;
        };
        match self.judge(corridor_gap(obstacle, self.body, (from, moves), self.keep)) {
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
