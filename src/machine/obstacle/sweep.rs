//! A tool that is tilted, turns, or moves on an arc past an obstacle: proved clear, proved to touch, or undecided.
//!
//! The block is cut into pieces of time and the tool into pieces of its length. In the middle of a piece the distance is exact; within the piece
//! each point of the tool moves by no more than a proven bound, axis by axis: the rate of the axis times the distance from it
//! (docs/kinematics.md#obstacles).
use super::contact::{Solid, comes_closer, distance};
use super::frame::{radii, tool_in_frame};
use super::{Footprint, Nearness, Obstacle, SLACK_MM, ToolBody};
use crate::path::joint_path::JointPath;
use crate::{AxisKind, Joints, Leg, Machine, Pose, RapidPath};
use core::cell::Cell;
use trunnion_geometry::Vec3;
use trunnion_interp::MotionKind;

/// A tool with its holder and the spindle is judged up to this height above its tip, mm.
const HIGHEST_MM: f64 = 1000.0;

/// Pieces that are looked at for one obstacle and one block.
const MOST_PIECES: usize = 20_000;

/// The same for all obstacles of a frame and one block.
const MOST_OF_BLOCK: usize = 10 * MOST_PIECES;

/// A piece is not cut where points of the tool move by less, mm.
const FINEST_MM: f64 = 1e-4;

/// A tool in one block.
pub(super) struct Sweep<'a> {
    machine: &'a Machine,
    path: JointPath<'a>,
    frame: usize,
    /// Length that is compensated or declared, mm.
    tool_length: f64,
    body: &'a ToolBody,
    /// The axes do not keep to the block's path: they arrive at their own times.
    independent: bool,
    /// How many more pieces are looked at.
    left: Cell<usize>,
}

/// A piece of time and of the tool's length.
#[derive(Clone, Copy, Debug)]
struct Piece {
    time: [f64; 2],
    height: [f64; 2],
    /// The middle of this time has not been looked at for contact.
    new: bool,
}

/// What is found for a distance to be kept.
enum Found {
    Clear,
    Closer,
    Undecided,
}

impl<'a> Sweep<'a> {
    /// `None` where the path is not known.
    pub(super) fn new(
        machine: &'a Machine,
        leg: &'a Leg,
        body: &'a ToolBody,
        (frame, tool_length): (usize, f64),
    ) -> Option<Self> {
        let independent = leg.motion.kind == MotionKind::Rapid && machine.control.rapid != RapidPath::Synchronous;
        Some(Self {
            machine,
            path: JointPath::new(machine, leg)?,
            frame,
            tool_length,
            body,
            independent,
            left: Cell::new(MOST_OF_BLOCK),
        })
    }

    /// How many more pieces are looked at.
    pub(super) fn left(&self) -> usize {
        self.left.get()
    }

    /// How near the tool comes to an obstacle.
    pub(super) fn nearness(&self, obstacle: &Obstacle, keep: f64) -> Nearness {
        let declared = self.length();
        // nothing above the tool is narrower than what it carries: as for an upright tool, its column has no upper end
        match self.search(obstacle, keep, HIGHEST_MM) {
            Found::Clear => Nearness::Clear(keep),
            _ if declared.is_none() => Nearness::Unknown("the length of the tool is not declared"),
            Found::Closer if keep <= SLACK_MM => Nearness::Through,
            Found::Closer => match self.search(obstacle, 0.0, HIGHEST_MM) {
                Found::Closer => Nearness::Through,
                Found::Clear => Nearness::Near(None),
                Found::Undecided => Nearness::Unknown("whether the tool only comes near or touches is not decided"),
            },
            Found::Undecided if self.left.get() == 0 => {
                Nearness::Unknown("too many obstacles are near to the tool in this block for all to be looked at")
            }
            Found::Undecided if self.independent => {
                Nearness::Unknown("the machine file does not say that the axes arrive together in a rapid")
            }
            Found::Undecided
                if self.body.holder_mm.is_none()
                    && declared.is_some_and(|length| matches!(self.search(obstacle, keep, length), Found::Clear)) =>
            {
                Nearness::Unknown("the tool clears it, but what holds the tool is not declared (`holder` of [[tool]])")
            }
            Found::Undecided => Nearness::Unknown("the bounds of the tool's motion do not decide it"),
        }
    }

    fn search(&self, obstacle: &Obstacle, keep: f64, length: f64) -> Found {
        let solids = self.solids();
        let mut pieces = vec![Piece {
            time: [0.0, 1.0],
            height: [0.0, length],
            new: true,
        }];
        let mut looked = 0;
        let mut undecided = false;
        while let Some(piece) = pieces.pop() {
            looked += 1;
            let Some(left) = self.left.get().checked_sub(1).filter(|_| looked <= MOST_PIECES) else {
                return Found::Undecided;
            };
            self.left.set(left);
            let [t0, t1] = piece.time;
            let joints = self.path.joints(f64::midpoint(t0, t1));
            let pose = tool_in_frame(self.machine, &joints, self.tool_length, self.frame);
            let [low, high] = piece.height;
            let (middle, half) = (f64::midpoint(low, high), 0.5 * (high - low));
            let moves = self.displacement(&joints, piece.time, (middle, half));
            if self.is_above(obstacle, keep, &pose, &joints, piece.time) {
                continue;
            }
            let centre = pose.tip + pose.axis * middle;
            let distance = distance(obstacle, &centre);
            let radius = self.radius(piece.height);
            if distance - moves - (radius * radius + half * half).sqrt() >= keep {
                continue;
            }
            let touches = self.touches(middle, distance, keep)
                || piece.new && comes_closer(obstacle, &pose, &solids, middle, keep);
            if touches && !self.independent {
                return Found::Closer;
            }
            if self.independent && t1 - t0 >= 1.0 && half <= 0.5 || moves + half <= FINEST_MM {
                undecided = true;
                if self.independent {
                    return Found::Undecided;
                }
                continue;
            }
            // what adds more to the bound is cut
            if half >= moves || self.independent {
                // where the holder begins, so that its radius does not count for what is below it
                let holder = self.body.holder_mm.map(|(_, above)| above);
                let cut = holder.filter(|above| low < *above && *above < high).unwrap_or(middle);
                for height in [[low, cut], [cut, high]] {
                    let new = false;
                    pieces.push(Piece { height, new, ..piece });
                }
            } else {
                let between = f64::midpoint(t0, t1);
                for time in [[t0, between], [between, t1]] {
                    let new = true;
                    pieces.push(Piece { time, new, ..piece });
                }
            }
        }
        if undecided { Found::Undecided } else { Found::Clear }
    }

    /// How far the tool reaches above its tip, where that is known, mm.
    fn length(&self) -> Option<f64> {
        let compensated = (self.tool_length > 0.0).then_some(self.tool_length);
        self.body.length_mm.or(compensated)
    }

    /// The cylinders that are certainly there. The end of the tool may be round or pointed, so its own begins at the height of its radius.
    fn solids(&self) -> Vec<Solid> {
        let radius = self.body.radius_mm;
        let tool = self.length().filter(|length| *length > radius);
        let holder = self.body.length_mm.and(self.body.holder_mm);
        let tool = tool.map(|length| Solid::new(radius, [radius, length]));
        let holder = holder.map(|(radius, above)| Solid::new(radius, [above, HIGHEST_MM]));
        tool.into_iter().chain(holder).collect()
    }

    /// Whether a point of the tool's axis is so near to the obstacle that the tool, even one with a ball end, is inside it or nearer than `keep`, mm: the
    /// sphere about the point that reaches the obstacle is inside the tool.
    fn touches(&self, height: f64, distance: f64, keep: f64) -> bool {
        self.length().is_some_and(|length| {
            let beside = height >= distance && length - height >= distance;
            height <= length && distance == 0.0 || beside && distance < self.body.radius_mm + keep - SLACK_MM
        })
    }

    /// The largest radius of the tool between two heights, mm.
    fn radius(&self, [_, high]: [f64; 2]) -> f64 {
        let holder = self.body.holder_mm.filter(|(_, above)| high > *above);
        holder.map_or(self.body.radius_mm, |(radius, _)| radius.max(self.body.radius_mm))
    }

    /// Rates of a joint in a part of the block, mm or rad per block.
    fn rate(&self, joint: usize, [t0, t1]: [f64; 2]) -> f64 {
        let rotary = self
            .machine
            .constants
            .rotary()
            .iter()
            .position(|rotary| rotary.joint == joint);
        match rotary {
            Some(slot) => self.path.spin_bounds(t0, t1).rate[slot],
            None => (self.path.end.joints[joint] - self.path.start.joints[joint]).abs(),
        }
    }

    /// Upper bound of how far points of the tool, up to `half` (mm) from `middle` along it, are in the piece from where they are in the middle of
    /// the time, as the obstacle sees them, mm.
    fn displacement(&self, joints: &Joints, time: [f64; 2], (middle, half): (f64, f64)) -> f64 {
        // independent axes may be anywhere between their ends at any time
        let share = if self.independent {
            1.0
        } else {
            0.5 * (time[1] - time[0])
        };
        let is_linear = |joint: &usize| self.machine.axes[*joint].kind == AxisKind::Linear;
        let count = self.machine.axes.len();
        let (mut fixed, mut turned) = (0.0, 0.0);
        let path = self.path.track.bounds().0;
        if self.path.tip && !self.independent {
            fixed += path * share;
            for (joint, radius) in radii(self.machine, joints, (self.tool_length, middle), 0) {
                let turn = self.rate(joint, time) * share;
                // about the tip, and about the axes that carry the obstacle
                let own = if joint < self.frame { middle + radius } else { middle };
                fixed += turn * (own + 2.0 * half);
                turned += turn;
            }
            // their rates are not bounded here
            let carried = (0..self.frame)
                .filter(is_linear)
                .any(|joint| self.rate(joint, time) > 0.0);
            if carried {
                return f64::INFINITY;
            }
        } else {
            let lines = (self.frame..count)
                .filter(is_linear)
                .map(|joint| self.rate(joint, time));
            // the sum of three components is at most the root of 3 times their length
            fixed += (lines.sum::<f64>() + 1.75 * path) * share;
            for (joint, radius) in radii(self.machine, joints, (self.tool_length, middle), self.frame) {
                let turn = self.rate(joint, time) * share;
                fixed += turn * (radius + half);
                turned += turn;
            }
        }
        // points come nearer to an axis or leave it while they move
        if turned < 0.5 {
            fixed / (1.0 - turned) * (1.0 + 1e-9)
        } else {
            f64::INFINITY
        }
    }

    /// Whether the plane through the tip at right angles to the tool has the whole obstacle below it during the piece of time.
    fn is_above(&self, obstacle: &Obstacle, keep: f64, pose: &Pose, joints: &Joints, time: [f64; 2]) -> bool {
        let share = if self.independent {
            1.0
        } else {
            0.5 * (time[1] - time[0])
        };
        let turn: f64 = (0..self.machine.axes.len())
            .filter(|joint| self.machine.axes[*joint].kind == AxisKind::Rotary)
            .map(|joint| self.rate(joint, time) * share)
            .sum();
        let moves = self.displacement(joints, time, (0.0, 0.0));
        corners(obstacle).iter().all(|(corner, around)| {
            let arm = corner - pose.tip;
            let sine = pose.axis.xy().norm();
            arm.dot(&pose.axis) + around * sine + moves + (arm.norm() + around) * turn <= -keep
        })
    }
}

/// Points whose convex hull holds the obstacle, each with the radius of a horizontal circle about it, mm.
fn corners(obstacle: &Obstacle) -> Vec<(Vec3, f64)> {
    let heights = [obstacle.bottom, obstacle.top];
    let at = |x: f64, y: f64, around: f64| heights.map(|z| (Vec3::new(x, y, z), around));
    match &obstacle.footprint {
        Footprint::Polygon(polygon) => polygon
            .corners()
            .iter()
            .flat_map(|corner| at(corner.x, corner.y, 0.0))
            .collect(),
        Footprint::Circle { centre, radius } => at(centre.x, centre.y, *radius).to_vec(),
    }
}
