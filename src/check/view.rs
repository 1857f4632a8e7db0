//! What rules read: a leg with the values computed from it at most once, and the program as a whole.
use crate::Settings;
use crate::datum::OffsetName;
use crate::trail::Trail;
use core::cell::OnceCell;
use core::f64::consts::TAU;
use trunnion_dialect::{Dialect, Plane};
use trunnion_geometry::{deg, math};
use trunnion_interp::{AxisLetter, Clamps, Directive, Feed, LengthOf, ModalState, Motion, MotionKind, Tilt, Tool};
use trunnion_machine::{
    AxisKind, Deviation, Excess, FeedLimit, Leg, Limits, Machine, Orientations, Stance, feed_limit, orientations,
    tip_deviation, windings,
};
use trunnion_syntax::{Program, TextRange};

/// Joint motion that is rounding only, rad or mm.
pub(crate) const NO_TURN: f64 = trunnion_machine::NO_TURN;

/// The program as a whole.
pub(crate) struct Overview<'a> {
    /// The program.
    pub(crate) program: &'a Program,
    /// What it is checked with.
    pub(crate) settings: &'a Settings<'a>,
    /// Comments that address Trunnion.
    pub(crate) directives: &'a [(TextRange, Directive)],
}

/// One leg, shared by all rules that read it: costly numbers are computed when first asked for, and once.
pub(crate) struct LegView<'a> {
    /// The machine.
    pub(crate) machine: &'a Machine,
    /// The dialect of the program.
    pub(crate) dialect: &'a Dialect,
    /// What it does.
    pub(crate) leg: &'a Leg,
    /// Sign of the last posture that was not at the pole, before this leg; 0 when there was none.
    pub(crate) posture_before: i8,
    /// What is known about the legs up to this one.
    pub(crate) trail: &'a Trail,
    feed_limit: OnceCell<Option<FeedLimit>>,
    deviation: OnceCell<Option<Deviation>>,
}

/// A motion as programmed, and what is in effect with it.
pub(crate) struct MotionView<'a> {
    /// The motion.
    pub(crate) motion: &'a Motion,
    /// What is in effect.
    pub(crate) in_force: &'a InForce,
    /// The tool of the last feed motion.
    pub(crate) last_cut: Option<u32>,
    /// Which tool's length was compensated in the last feed motion, where one was.
    pub(crate) last_length: Option<LengthOf>,
    /// The tool of the last rapid to another Z, or feed motion.
    pub(crate) last_approach: Option<u32>,
    /// The dialect of the program.
    pub(crate) dialect: &'a Dialect,
}

/// What is active for a motion without being written in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct InForce {
    /// Compensated tool length, mm; `None`: off.
    pub(crate) tool_length_mm: Option<f64>,
    /// Declared length of the tool in use, mm.
    pub(crate) own_length_mm: Option<f64>,
    /// What is declared about the tool in use.
    pub(crate) tool: Option<Tool>,
    /// Coordinates are in a frame that is not modelled.
    pub(crate) frame_unknown: bool,
    /// The working plane.
    pub(crate) plane: Plane,
    /// S is a cutting speed (G96).
    pub(crate) surface_speed: bool,
    /// Limit of the spindle's speed, 1/min.
    pub(crate) spindle_limit_rpm: Option<f64>,
    /// Something says whether lengths are inch or mm.
    pub(crate) unit_programmed: bool,
    /// The program has given an S.
    pub(crate) speed_programmed: bool,
    /// Something that is not modelled may have switched the spindle or given S.
    pub(crate) spindle_unread: bool,
    /// The spindle turned before a tool change, a stop or a tap that may have stopped it.
    pub(crate) spindle_left: bool,
    /// The program has started a spindle before.
    pub(crate) spindle_started: bool,
    /// Clamps of rotary axes.
    pub(crate) clamps: Clamps,
    /// Work offset.
    pub(crate) offset: OffsetName,
    /// Which tool's length is compensated.
    pub(crate) length_of: LengthOf,
}

impl InForce {
    /// Of the modal state.
    #[inline]
    pub(crate) fn of(state: &ModalState) -> Self {
        Self {
            tool_length_mm: state.length.mm(),
            own_length_mm: state.tool.own_length_mm(),
            tool: state.tool.data(),
            frame_unknown: state.zero.is_lost(),
            plane: state.coordinates.plane(),
            surface_speed: state.spindle.surface_speed(),
            spindle_limit_rpm: state.spindle.limit_rpm(),
            unit_programmed: state.coordinates.unit_programmed(),
            speed_programmed: state.spindle.speed_programmed(),
            spindle_unread: state.spindle.is_unread(),
            spindle_started: state.spindle.was_started(),
            spindle_left: state.spindle.is_left_to_machine(),
            clamps: state.clamps,
            offset: state.zero.offset().map(OffsetName::new).unwrap_or_default(),
            length_of: state.length.of(),
        }
    }
}

impl MotionView<'_> {
    /// Whether it is a rapid to another Z of the workpiece.
    pub(crate) fn approaches(&self) -> bool {
        const Z: usize = 2;
        let (start, end) = (self.motion.start.get(Z), self.motion.end.get(Z));
        self.motion.kind == MotionKind::Rapid
            && !self.motion.machine_coordinates
            && self.motion.tilt == Tilt::default()
            && end.is_some()
            && start != end
    }
    /// Whether a length changes to another one than zero, which is zero in any unit.
    pub(crate) fn changes_a_length(&self) -> bool {
        // X, Y, Z, U, V, W in the order of a position
        let changes = |axis: usize| {
            let end = self.motion.end.get(axis);
            end.is_some_and(|end| end != 0.0 && self.motion.start.get(axis) != Some(end))
        };
        [0, 1, 2, 6, 7, 8].into_iter().any(changes)
    }
}

impl<'a> LegView<'a> {
    /// A view of `leg`.
    pub(crate) fn new(
        (machine, dialect): (&'a Machine, &'a Dialect),
        leg: &'a Leg,
        posture_before: i8,
        trail: &'a Trail,
    ) -> Self {
        Self {
            machine,
            dialect,
            leg,
            posture_before,
            trail,
            feed_limit: OnceCell::new(),
            deviation: OnceCell::new(),
        }
    }

    /// The motion.
    pub(crate) fn motion(&self) -> &'a Motion {
        &self.leg.motion
    }

    /// The position of the machine before and after, when both are known.
    pub(crate) fn stances(&self) -> Option<(&'a Stance, &'a Stance)> {
        Some((self.leg.start.as_ref()?, self.leg.end.as_ref().ok()?))
    }

    /// Highest feed of the block in its unit, see [`feed_limit`] and [`Self::feed_unit`].
    pub(crate) fn feed_limit(&self) -> Option<FeedLimit> {
        *self.feed_limit.get_or_init(|| {
            let limit = feed_limit(self.machine, self.leg).or_else(|| self.turning_limit())?;
            if self.lever_is_undeclared() && self.machine.axes[limit.axis].kind == AxisKind::Linear {
                // how fast a linear axis runs is not known; a rotary one runs at its mean speed at least
                return self.mean_turn_limit();
            }
            Some(limit)
        })
    }

    /// Whether the position of a linear joint depends on an undeclared zero point or tool length.
    pub(crate) fn rests_on_undeclared(&self, joint: usize) -> bool {
        let undeclared = self.trail.undeclared;
        let axis = &self.machine.axes[joint];
        if axis.kind == AxisKind::Rotary || !undeclared.open() {
            return false;
        }
        if !self.machine.rotary.is_empty() && self.leads_tip() {
            return true;
        }
        let bit = AxisLetter::new(axis.letter).map_or(0, |letter| 1u16 << letter.0);
        // a tilted plane is none of two axes of the machine
        let tilted = undeclared.beside != 0 && self.motion().tilt.normal.is_some();
        (undeclared.zero | undeclared.by_turret | undeclared.beside) & bit != 0
            || tilted
            || undeclared.length && undeclared.by_turret == 0 && self.machine.per_length(joint) != 0.0
    }

    /// Whether the motion of the linear joints, or of the tip, depends on one: a rotary axis turns, and the distance to it is unknown.
    pub(crate) fn lever_is_undeclared(&self) -> bool {
        self.trail.undeclared.open() && self.rotary_turns()
    }

    /// Whether X Y Z are the position of the tip in the workpiece frame: tool centre point control, or vectors.
    pub(crate) fn leads_tip(&self) -> bool {
        trunnion_machine::leads_tip(self.motion())
    }

    /// Whether F is meant in degrees: no X Y Z path, without tool centre point control (RS274/NGC on feed rate).
    pub(crate) fn feed_in_degrees(&self) -> bool {
        self.leg.length <= 0.0 && !self.leads_tip()
    }

    /// Whether rotary axes move under an F whose meaning a parameter of the control decides. Together with linear axes: mm/min of
    /// X Y Z, or of the root of mm2 + deg2; the dialect or the machine file may say which. Tool centre point control means the tip,
    /// inverse time a duration. On a Haas also where only they turn, see [`Self::turns_by_diameter`].
    pub(crate) fn feed_is_ambiguous(&self) -> bool {
        trunnion_machine::feed_is_ambiguous(self.machine, self.dialect.advice.rotary_feed, self.leg)
    }

    /// Whether only rotary axes turn on a Haas, where F is the speed along circles whose diameters are its settings 34 and 79, so that they
    /// may turn faster than by F in degrees. Source: Haas mill operator's manual, G93, where these settings are not needed.
    pub(crate) fn turns_by_diameter(&self) -> bool {
        trunnion_machine::turns_by_diameter(self.machine, self.dialect.advice.rotary_feed, self.leg)
    }

    /// Whether a rotary joint turns, by more than rounding.
    pub(crate) fn rotary_turns(&self) -> bool {
        trunnion_machine::turns(self.leg)
    }

    /// `mm/min` or `deg/min`.
    pub(crate) fn feed_unit(&self) -> &'static str {
        if self.feed_in_degrees() { "deg/min" } else { "mm/min" }
    }

    /// Keys of the programmed and of the highest feed, with their unit.
    pub(crate) fn feed_keys(&self) -> [&'static str; 2] {
        if self.feed_in_degrees() {
            ["feed_deg_min", "feed_limit_deg_min"]
        } else {
            ["feed_mm_min", "feed_limit_mm_min"]
        }
    }

    /// Length along which F is the speed: of the path, mm, or of the turn, deg (root of the sum of squares, RS274/NGC).
    fn way(&self) -> f64 {
        if self.feed_in_degrees() {
            let [first, second] = self.leg.rotary_change;
            deg(math::hypot(first, second))
        } else {
            self.leg.length
        }
    }

    /// Highest feed, deg/min, of a block in which only rotary axes turn.
    fn turning_limit(&self) -> Option<FeedLimit> {
        let way = self.way();
        if !self.feed_in_degrees() || !self.motion().is_feed() || way <= 0.0 || self.stances().is_none() {
            return None;
        }
        self.mean_turn_limit()
    }

    /// The feed at which the mean speed of a rotary axis is the highest that it can turn at.
    fn mean_turn_limit(&self) -> Option<FeedLimit> {
        let way = self.way();
        let mut slowest: Option<FeedLimit> = None;
        for (axis, change) in self.machine.rotary.iter().zip(self.leg.rotary_change) {
            let Some(axis_limit) = self.machine.axes[*axis].max_speed else {
                continue;
            };
            let feed_mm_min = axis_limit * 60.0 * way / change;
            if change > 0.0 && slowest.is_none_or(|limit| feed_mm_min < limit.feed_mm_min) {
                let axis_speed = self.programmed_feed().map(|feed| change * feed / (60.0 * way));
                slowest = Some(FeedLimit {
                    feed_mm_min,
                    axis: *axis,
                    axis_speed,
                    axis_limit,
                });
            }
        }
        slowest
    }

    /// Deviation of the tip path, see [`tip_deviation`].
    pub(crate) fn deviation(&self) -> Option<Deviation> {
        *self
            .deviation
            .get_or_init(|| tip_deviation(self.machine, self.leg, self.machine.tolerances.tip_mm))
    }

    /// Programmed feed in its unit ([`Self::feed_unit`]); `None` where it is not known or the block is no feed motion.
    /// Per revolution: times the spindle speed, the highest one of the motion. Inverse time: the length of the path times F (RS274/NGC, G93).
    pub(crate) fn programmed_feed(&self) -> Option<f64> {
        match self.motion().feed {
            Feed::PerMinute(feed) => Some(feed),
            Feed::PerRevolution(feed) => Some(feed * self.motion().most_rpm()?),
            Feed::InverseTime(per_minute) => Some(per_minute * self.way()),
            Feed::Unknown | Feed::Rapid => None,
        }
    }

    /// Letters of the first and second rotary axis; `-` where there is none.
    pub(crate) fn rotary_letters(&self) -> [char; 2] {
        [0, 1].map(|i| {
            self.machine
                .rotary
                .get(i)
                .map_or('-', |at| char::from(self.machine.axes[*at].letter))
        })
    }

    /// The limit that the posture before would break in every winding at the end of this block, where the posture changes:
    /// the limit forces the change. `None` where it does not.
    pub(crate) fn forced_swap(&self) -> Option<Excess> {
        let (start, end) = self.stances()?;
        if self.posture_before * end.branch >= 0 {
            return None;
        }
        let Orientations::Postures(postures) = orientations(self.machine, &end.axis) else {
            return None;
        };
        let same = postures.iter().find(|posture| posture.branch == self.posture_before)?;
        self.machine.rotary.iter().zip(same.q).find_map(|(&axis, q)| {
            let Limits::Range(low, high) = self.machine.axes[axis].limits else {
                return None;
            };
            if !windings(self.machine, axis, q, start.joints[axis]).is_empty() {
                return None;
            }
            let below = q + TAU * ((high - q) / TAU).floor();
            let above = below + TAU;
            let (value, limit) = if low - below <= above - high {
                (below, low)
            } else {
                (above, high)
            };
            Some(Excess {
                axis,
                value,
                limit,
                inside: false,
                if_together: false,
            })
        })
    }

    /// Whether it is only assumed that the control turns the rotary axes evenly between tool vectors: neither the program nor the machine
    /// file says how the orientation runs.
    pub(crate) fn orientation_is_assumed(&self) -> bool {
        self.motion().great_circle.is_none() && !self.machine.control.tcp_declared
    }

    /// Whether a rotary axis turns by more than half a turn, so that a whole turn less may reach the same position.
    pub(crate) fn turns_far(&self) -> bool {
        self.leg
            .rotary_change
            .iter()
            .any(|change| *change > core::f64::consts::PI)
    }

    /// Whether the block comes into the pole's cone on a machine with two rotary axes.
    pub(crate) fn near_pole(&self) -> bool {
        self.machine.rotary.len() == 2 && self.leg.pole_angle_min < self.machine.tolerances.pole_cone
    }
}
