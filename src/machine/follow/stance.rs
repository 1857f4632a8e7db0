//! The position of the machine between two blocks, and what it does in one.
use crate::kinematics::forward::{Turn, segment_shifts};
use crate::kinematics::inverse::place;
use crate::kinematics::pole;
use crate::{Joints, Machine};
use core::f64::consts::FRAC_PI_2;
use trunnion_geometry::Vec3;
use trunnion_interp::Motion;

/// The position of the machine between two blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// Joint values, mm or rad.
    pub joints: Joints,
    /// Tip in the workpiece frame without work offset, i.e. in programmed coordinates (also after a motion in machine coordinates), mm.
    pub tip: Vec3,
    /// Unit tool axis in the workpiece frame.
    pub axis: Vec3,
    /// S of the posture (see `Solution::branch`), signed.
    pub s: f64,
    /// +1, -1, 0 at the pole (|S| below 1e-9); 0 also for machines with fewer than two rotary axes.
    pub branch: i8,
    /// Angle between tool axis and first rotary axis (0..pi/2, the nearer end of the axis), rad; pi/2 for machines without two rotaries.
    pub pole_angle: f64,
    /// Tool length used, mm.
    pub tool_length: f64,
    /// Tip in the workpiece frame with the work offset, mm.
    pub(crate) point: Vec3,
    /// Sine and cosine of the turns of the two rotary axes (0, 1 for missing ones).
    pub(crate) turns: [(f64, f64); 2],
}

impl Stance {
    /// With the given joints (mm, rad; all of them), a tool of this length (mm) and the work offset's X Y Z (mm, workpiece frame).
    pub fn at(machine: &Machine, joints: &Joints, tool_length: f64, zero: &Vec3) -> Self {
        Self::of_joints(machine, joints, (tool_length, zero), None, None)
    }

    /// With the given joints (without `tip`) or with the given rotary joints and tip (linear joints left to be solved). `start`: the stance
    /// before, whose sines are taken where an axis does not move. The tool is in the spindle even if the words are machine coordinates.
    #[inline]
    pub(crate) fn of_joints(
        machine: &Machine,
        joints: &Joints,
        (tool_length, zero): (f64, &Vec3),
        start: Option<&Self>,
        tip: Option<Vec3>,
    ) -> Self {
        let constants = &machine.constants;
        let mut turns = [Turn::NONE; 2];
        for (index, rotary) in constants.rotary().iter().enumerate() {
            turns[index] = match start {
                // a rotary axis that does not move needs no sine
                Some(before) if before.joints[rotary.joint] == joints[rotary.joint] => {
                    let (sin, cos) = before.turns[index];
                    Turn {
                        axis: rotary.direction,
                        sin,
                        cos,
                    }
                }
                _ => Turn::new(constants, index, joints[rotary.joint]),
            };
        }
        let point = tip.unwrap_or_else(|| {
            let tool = machine.gauge_point - machine.tool_axis * tool_length;
            place(constants, &turns, &segment_shifts(constants, joints), &tool)
        });
        let (axis, s, branch, pole_angle) = if let Some(pair) = &constants.pair {
            let w = turns[1].apply(&machine.tool_axis);
            let (s, branch) = pole::posture(pair, &w);
            (
                turns[0].apply(&w),
                s,
                branch,
                pole::pole_angle(constants, pair, &w, joints[constants.rotary[1].joint]),
            )
        } else {
            (turns[0].apply(&machine.tool_axis), 0.0, 0, FRAC_PI_2)
        };
        Self {
            joints: *joints,
            tip: point - zero,
            axis,
            s,
            branch,
            pole_angle,
            tool_length,
            point,
            turns: turns.map(|turn| (turn.sin, turn.cos)),
        }
    }

    /// The rotary turns of this stance.
    #[inline]
    pub(crate) fn turns(&self, machine: &Machine) -> [Turn; 2] {
        let rotary = &machine.constants.rotary;
        let turn = |i: usize| Turn {
            axis: rotary[i].direction,
            sin: self.turns[i].0,
            cos: self.turns[i].1,
        };
        [turn(0), turn(1)]
    }
    /// Tip in the workpiece frame with another tool length, mm.
    #[inline]
    pub(crate) fn point_with(&self, tool_length: f64) -> Vec3 {
        if tool_length == self.tool_length {
            self.point
        } else {
            self.point + self.axis * (self.tool_length - tool_length)
        }
    }
    /// How far the tip is from it in another stance, with that one's tool, mm: in the workpiece, independent of the work offset of each.
    #[inline]
    pub fn tip_distance_to(&self, end: &Self) -> f64 {
        (end.point - self.point_with(end.tool_length)).norm()
    }
    /// Rotary joints, workpiece side first, rad; 0 for missing ones.
    #[inline]
    pub(crate) fn rotary(&self, machine: &Machine) -> [f64; 2] {
        rotary_joints(machine, &self.joints)
    }
}

#[inline]
fn rotary_joints(machine: &Machine, joints: &Joints) -> [f64; 2] {
    let [first, second] = &machine.constants.rotary;
    match machine.constants.rotary_count {
        0 => [0.0; 2],
        1 => [joints[first.joint], 0.0],
        _ => [joints[first.joint], joints[second.joint]],
    }
}

/// Why documentation and declarations do not decide the posture at the end of a motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OpenCause {
    /// No rule is documented for the control family, and the machine file names none.
    RuleNotDeclared,
    /// By the control's rule two postures are equal.
    Tie,
    /// A rotary axis can reach its value by half a turn in either direction.
    HalfTurn,
    /// A plain word of a rotary axis that a word with a direction has carried beyond a full turn: whether the control counts from the angle that it
    /// displays.
    TurnsCarried,
    /// Mitsubishi: the types of passing the pole give different postures, and the machine file does not say which is set.
    PassingTypeNotDeclared,
    /// Fanuc: the ranges of parameters 19741 to 19744 are not declared, and without them another posture would be taken.
    RangeNotDeclared,
    /// The control's rule compares moves from the previous posture, which is not known.
    StartUnknown,
    /// The preferred direction in the program fits both postures.
    Direction,
    /// The program requests a posture by words (STAT, TU, G53.1 P) whose meaning the machine file does not declare.
    WordsNotDeclared,
    /// Inside the cone about the pole the control holds the first rotary axis.
    PoleHeld,
    /// Inside the cone about the pole the control stops with an alarm.
    PoleAlarm,
    /// The tool axis runs on a great circle off the pole, on which the posture cannot change, and the control's rule takes another.
    GreatCircle,
}

impl OpenCause {
    /// One word for tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::RuleNotDeclared => "rule-not-declared",
            Self::Tie => "tie",
            Self::HalfTurn => "half-turn",
            Self::TurnsCarried => "turns-carried",
            Self::PassingTypeNotDeclared => "passing-type-not-declared",
            Self::RangeNotDeclared => "range-not-declared",
            Self::StartUnknown => "start-unknown",
            Self::Direction => "direction",
            Self::WordsNotDeclared => "words-not-declared",
            Self::PoleHeld => "pole-held",
            Self::PoleAlarm => "pole-alarm",
            Self::GreatCircle => "great-circle",
        }
    }
}

/// A posture that is followed although the control may take another. Rotary joints, workpiece side first, rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Open {
    /// Why.
    pub cause: OpenCause,
    /// The one that is followed.
    pub taken: [f64; 2],
    /// The other one.
    pub other: [f64; 2],
}

/// Why there is no stance.
#[derive(Clone, Debug, PartialEq)]
pub enum NoStance {
    /// Some axis was never positioned (the letters).
    PositionUnknown(String),
    /// No posture reaches the tool axis; nearest reachable cone is this far, rad.
    Unreachable(f64),
    /// Postures exist, but none inside the limits of the rotary axes: the axis letter, the value nearest to legal and the limit it breaks, rad.
    OutsideLimits {
        /// Letter.
        axis: u8,
        /// rad.
        value: f64,
        /// rad.
        limit: f64,
    },
    /// Postures exist inside the limits, but not the one that the program requests (SEQ, STAT, TU, G53.1 P): the axis and the value it would
    /// have, rad.
    PostureRefused {
        /// Letter.
        axis: u8,
        /// rad.
        value: f64,
    },
    /// A motion that is not modelled.
    NotModelled,
    /// The linear axes do not span space at the position of the rotary axes.
    Singular,
    /// The program moves an axis that the machine file holds at another position; rad.
    HeldElsewhere {
        /// Letter.
        axis: u8,
        /// Where the program has it.
        value: f64,
        /// Where the machine file holds it.
        held: f64,
    },
    /// The program names an axis that the machine does not have.
    NoSuchAxis(u8),
    /// A work offset turns the axis with this letter while X Y Z are tip coordinates: controls differ in how they turn the workpiece
    /// frame with it, so no joint follows from the words for certain.
    RotaryOffset(u8),
    /// The tool is not perpendicular to the tilted plane in which X Y Z are programmed: angle between tool axis and normal, rad.
    PlaneMisaligned(f64),
    /// The path is not computed: the long guided motions of the run have turned the rotary axes by more pieces than that
    /// ([`crate::Machine::most_turned`]).
    TurnsSpent(u64),
}

/// What the machine does in one motion.
#[derive(Clone, Debug)]
pub struct Leg {
    /// The motion.
    pub motion: Motion,
    /// Before; `None`: unknown.
    pub start: Option<Stance>,
    /// The start was stated by the program (APT FROM), not reached by a motion: no leg before this one ends there.
    pub start_given: bool,
    /// The machine was at a known place, and something that is no motion has taken it elsewhere: a tool change.
    pub taken_away: bool,
    /// After.
    pub end: Result<Stance, NoStance>,
    /// The posture at the end is one of several that the control may take.
    pub open: Option<Open>,
    /// Joint values that are known even where the stance is not: value and bit mask (machine words without TCP).
    pub known_joints: (Joints, u16),
    /// Absolute increments of the rotary joints, rad (0 for missing).
    pub rotary_change: [f64; 2],
    /// Smallest pole angle within the block, rad (pi/2 where unknown).
    pub pole_angle_min: f64,
    /// Rotary excess over the cheapest move of the start's posture, rad, when the posture sign changes; else 0.
    pub rotary_excess: f64,
    /// Length of the tip path with TCP or vectors, of the programmed X Y Z path without, mm; 0 where it is unknown. A
    /// coordinate that the program does not know at the start (first words after TCP was switched) is replaced by the travel of its axis.
    pub length: f64,
}

impl Leg {
    /// Copies another one into its own storage.
    pub fn copy_from(&mut self, other: &Self) {
        // all of them, so that none is forgotten
        let Self {
            motion,
            start,
            start_given,
            taken_away,
            end,
            open,
            known_joints,
            rotary_change,
            pole_angle_min,
            rotary_excess,
            length,
        } = other;
        self.motion = *motion;
        self.start = *start;
        self.start_given = *start_given;
        self.taken_away = *taken_away;
        match (&mut self.end, end) {
            (Ok(own), Ok(end)) => *own = *end,
            (own, end) => own.clone_from(end),
        }
        self.open = *open;
        self.known_joints = *known_joints;
        self.rotary_change = *rotary_change;
        self.pole_angle_min = *pole_angle_min;
        self.rotary_excess = *rotary_excess;
        self.length = *length;
    }
}
