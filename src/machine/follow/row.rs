//! One row of a trace: what the machine does in one motion, in the units of messages.
use crate::follow::follower::has_tip_words;
use crate::follow::words::Words;
use crate::path::speed::feed_limit_tight;
use crate::{AxisKind, Leg, Machine, block_duration_s, tip_deviation};
use trunnion_geometry::deg;
use trunnion_interp::{Feed, MotionKind};
use trunnion_syntax::BlockId;

/// One row of `trace`. mm, deg, mm/min, s.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Block.
    pub block: BlockId,
    /// rapid, linear, arc, dwell, unknown.
    pub motion: &'static str,
    /// TCP on.
    pub tcp: bool,
    /// Tip in the workpiece frame, without work offset; empty also under a work offset that turns a rotary axis.
    pub tip_mm: Option<[f64; 3]>,
    /// Tool axis; empty also under a work offset that turns a rotary axis.
    pub axis: Option<[f64; 3]>,
    /// Programmed feed.
    pub feed_mm_min: Option<f64>,
    /// Duration.
    pub duration_s: Option<f64>,
    /// Posture sign.
    pub branch: Option<i8>,
    /// Angle to the pole at the end of the block.
    pub pole_angle_deg: Option<f64>,
    /// Proven bound.
    pub tip_deviation_mm: Option<f64>,
    /// Highest feed.
    pub feed_limit_mm_min: Option<f64>,
    /// Letter of the limiting axis.
    pub limiting_axis: Option<char>,
    /// Joint values in chain order, mm or deg; `None` where unknown.
    pub joints: Vec<Option<f64>>,
    /// The other posture that the control may take at the end of the block: the reason in one word, and its rotary values, workpiece side
    /// first, deg; `None` if the posture is certain.
    pub open: Option<(&'static str, [f64; 2])>,
}

/// Deviations up to this need no tighter bound in a trace, mm.
const TRACE_TOLERANCE_MM: f64 = 5e-5;

/// The row of a leg. Branch and pole angle are empty for machines without two rotary axes, deviation and feed limit where nothing moves
/// along a path (dwell) or where they are not known.
pub fn row(machine: &Machine, leg: &Leg) -> Row {
    let motion = &leg.motion;
    let stance = leg.end.as_ref().ok();
    // an offset in a rotary axis turns the workpiece frame in a way that is not modelled
    let in_frame = stance.filter(|_| Words::new(machine).turned_frame(machine, motion).is_none());
    let posture = stance.filter(|_| machine.constants.pair.is_some());
    let limit = feed_limit_tight(machine, leg).filter(|limit| limit.feed_mm_min.is_finite());
    let axes = machine.own_axes();
    let joint = |(index, axis): (usize, &crate::Axis)| {
        (leg.known_joints.1 & (1 << index) != 0).then(|| match axis.kind {
            AxisKind::Linear => leg.known_joints.0[index],
            AxisKind::Rotary => deg(leg.known_joints.0[index]),
        })
    };
    Row {
        block: motion.block,
        motion: match motion.kind {
            MotionKind::Rapid => "rapid",
            MotionKind::Linear => "linear",
            MotionKind::Arc(_) => "arc",
            MotionKind::Dwell(_) => "dwell",
            MotionKind::Unknown => "unknown",
        },
        tcp: has_tip_words(motion),
        tip_mm: in_frame.map(|s| s.tip.into()),
        axis: in_frame.map(|s| s.axis.into()),
        feed_mm_min: match motion.feed {
            _ if !motion.is_feed() => None,
            Feed::PerMinute(feed) => Some(feed),
            Feed::PerRevolution(feed) => motion.mean_rpm().map(|rpm| feed * rpm),
            Feed::InverseTime(per_minute) => (leg.length > 0.0).then_some(per_minute * leg.length),
            Feed::Unknown | Feed::Rapid => None,
        },
        duration_s: block_duration_s(machine, leg),
        branch: posture.map(|s| s.branch),
        pole_angle_deg: posture.map(|s| deg(s.pole_angle)),
        tip_deviation_mm: tip_deviation(machine, leg, TRACE_TOLERANCE_MM).map(|d| d.bound_mm),
        feed_limit_mm_min: limit.map(|limit| limit.feed_mm_min),
        limiting_axis: limit.map(|limit| char::from(machine.axes[limit.axis].letter)),
        joints: axes.map(joint).collect(),
        open: leg.open.map(|open| (open.cause.name(), open.other.map(deg))),
    }
}
