//! Motions to joints, block by block along one posture: the machine re-runs the program.
use crate::follow::choice::cheapest_in_posture;
use crate::follow::line_cache::LineCache;
use crate::follow::state::State;
use crate::follow::words::{Words, XYZ, zero_point};
use crate::kinematics::held_axes::settle_held;
use crate::kinematics::inverse::inverse_turned;
use crate::kinematics::pole;
use crate::{Joints, Leg, Machine, NoStance, Open, Sine, Stance};
use core::f64::consts::FRAC_PI_2;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::angle_between;
use trunnion_interp::{Motion, MotionKind, Orientation, Position, Swivel};

/// How far the tool may be off the normal of a tilted plane, rad: 0.01 deg (kinematics notes 5, TWP-ALIGN).
const PLANE_TOLERANCE: f64 = 0.01 * core::f64::consts::PI / 180.0;

/// Turn of a piece of a guided motion, rad: 2 deg, as the plan of the speed divides it.
const PIECE: f64 = 2.0 * core::f64::consts::PI / 180.0;
/// The most pieces of one motion.
const MOST_PIECES: f64 = 24.0;
/// A motion with no more pieces takes little more work than one that does not turn: 8 deg.
const FREE_PIECES: u64 = 4;

/// Follows motions; cloning it makes a check-point.
#[derive(Clone)]
pub struct Follower<'m> {
    pub(crate) machine: &'m Machine,
    pub(crate) state: State,
    pub(crate) words: Words,
    /// Where the last motion was a straight one: what it has in common with the next.
    pub(crate) lines: Option<LineCache>,
    /// Predicted sines of the rotary axes.
    pub(crate) sines: [Sine; 2],
}

impl<'m> Follower<'m> {
    /// At an unknown position.
    pub fn new(machine: &'m Machine) -> Self {
        Self::at(machine, &State::UNKNOWN)
    }
    /// Continues from a remembered state.
    pub(crate) fn at(machine: &'m Machine, state: &State) -> Self {
        Self {
            machine,
            state: *state,
            words: Words::new(machine),
            lines: None,
            sines: [Sine::UNKNOWN; 2],
        }
    }
    /// The machine.
    pub fn machine(&self) -> &'m Machine {
        self.machine
    }

    /// Moves the machine. A motion that cannot be followed leaves it at an unknown position until the program gives one again.
    pub fn follow(&mut self, motion: &Motion) -> Leg {
        self.general(motion)
    }

    /// [`Self::follow`] for any motion.
    pub(crate) fn general(&mut self, motion: &Motion) -> Leg {
        self.lines = None;
        self.relocate(motion);
        let given = self.state.stance.is_none().then(|| self.begin(motion)).flatten();
        let mut leg = self.step(motion, given.is_some());
        if let Some(begun) = given {
            leg.open = leg.open.or(begun.open);
        }
        leg
    }

    /// Takes the stance that the program states without a motion (APT FROM): tip and tool vector where the motion starts. The posture
    /// is chosen as at a first motion. `None` where there is no such stance.
    fn begin(&mut self, motion: &Motion) -> Option<Leg> {
        let Orientation::Vector(Some(axis), _) = motion.orientation else {
            return None;
        };
        if motion.start.xyz().is_none() || matches!(motion.kind, MotionKind::Dwell(_) | MotionKind::Unknown) {
            return None;
        }
        let before = self.state;
        let way = Motion {
            kind: MotionKind::Rapid,
            start: Position::default(),
            end: motion.start,
            orientation: Orientation::Vector(None, axis),
            ..*motion
        };
        let known = self.step(&way, false);
        if known.end.is_err() {
            self.state = before;
            return None;
        }
        Some(known)
    }

    #[inline]
    fn step(&mut self, motion: &Motion, start_given: bool) -> Leg {
        let mut leg = Leg {
            motion: *motion,
            start: self.state.stance,
            start_given,
            taken_away: core::mem::take(&mut self.state.taken_away),
            end: Err(NoStance::NotModelled),
            open: None,
            known_joints: self.state.known_joints,
            rotary_change: [0.0; 2],
            pole_angle_min: FRAC_PI_2,
            rotary_excess: 0.0,
            length: 0.0,
        };
        match motion.kind {
            MotionKind::Dwell(_) => leg.end = leg.start.ok_or_else(|| self.unknown(leg.known_joints.1)),
            MotionKind::Unknown => leg.known_joints.1 = 0,
            MotionKind::Arc(_) if self.words.diameters && !motion.radii => leg.known_joints.1 = 0,
            MotionKind::Rapid | MotionKind::Linear | MotionKind::Arc(_) => {
                leg.end = self.arrive(motion, leg.start.as_ref(), &mut leg.known_joints, &mut leg.open);
            }
        }
        self.measure(&mut leg);
        self.remember(&leg);
        self.count_turn(&mut leg);
        leg
    }

    /// A guided motion takes work in proportion to the turn of its rotary axes, up to [`MOST_PIECES`]: what is beyond [`FREE_PIECES`] is
    /// counted, and the path is not computed once the run has no more. The machine is at its end all the same.
    #[inline]
    fn count_turn(&mut self, leg: &mut Leg) {
        let turn = leg.rotary_change[0].max(leg.rotary_change[1]);
        if turn <= 0.0 || leg.end.is_err() || !leads_path(&leg.motion) {
            return;
        }
        let swept = match &leg.motion.kind {
            MotionKind::Arc(Some(arc)) => arc.sweep.abs() * 0.25,
            _ => 0.0,
        };
        let pieces = (turn.max(swept) / PIECE).min(MOST_PIECES) as u64;
        if pieces <= FREE_PIECES {
            return;
        }
        let most = self.machine.most_turned;
        self.state.turned = self.state.turned.saturating_add(pieces - FREE_PIECES);
        if self.state.turned > most {
            leg.end = Err(NoStance::TurnsSpent(most));
            leg.open = None;
        }
    }

    #[inline]
    fn remember(&mut self, leg: &Leg) {
        let lost = if leg.end.is_ok() { 0 } else { self.lost_turns(leg) };
        let state = &mut self.state;
        state.rotary_lost = lost;
        let by_vector =
            matches!(leg.motion.orientation, Orientation::Vector(..)) && leg.motion.tilt.swivel == Swivel::No;
        state.led = by_vector || state.led && leg.end.is_err();
        state.stance = leg.end.as_ref().ok().copied();
        state.known_joints = leg.known_joints;
        if !matches!(leg.motion.tilt.swivel, Swivel::No | Swivel::PointToPoint) {
            let rotary = self.machine.constants.rotary().iter();
            state.aimed = rotary.fold(0, |mask, rotary| mask | 1 << rotary.joint);
        }
        state.aimed &= leg.known_joints.1;
        state.named = leg.motion.end.known;
        state.tip_words = has_tip_words(&leg.motion);
        if let Ok(stance) = &leg.end {
            state.rotary = stance.rotary(self.machine);
            state.rotary_known = true;
            if stance.branch != 0 {
                state.sign = stance.branch;
            }
            return;
        }
        state.sign = 0;
        state.rotary_known = true;
        for (slot, rotary) in state.rotary.iter_mut().zip(self.machine.constants.rotary()) {
            if leg.known_joints.1 & (1 << rotary.joint) != 0 {
                *slot = leg.known_joints.0[rotary.joint];
            } else {
                state.rotary_known = false;
            }
        }
    }

    /// The stance at the end of a motion; `into` takes the joints that are known even where there is no stance.
    #[inline]
    fn arrive(
        &self,
        motion: &Motion,
        start: Option<&Stance>,
        into: &mut (Joints, u16),
        open: &mut Option<Open>,
    ) -> Result<Stance, NoStance> {
        let tip_words = has_tip_words(motion);
        *into = self.words.joints(motion, &motion.end, tip_words);
        settle_held(self.machine, into)?;
        if into.1 != self.words.all() {
            self.keep(motion, start, into);
        }
        if self.words.wraps || motion.ways.carried != 0 {
            let from = start.map(|start| &start.joints);
            *open = self.words.wrap(self.machine, motion, from, into);
        }
        self.asked_turns(motion, into, open);
        if let Some(letter) = self.words.foreign(motion) {
            return Err(NoStance::NoSuchAxis(letter));
        }
        if motion.tilt.swivel == Swivel::AxesStay || motion.tilt.swivel == Swivel::AxesLost {
            return self.swivel(motion, start, into, open);
        }
        if !tip_words {
            if into.1 != self.words.all() {
                return Err(self.unknown(into.1));
            }
            return Ok(self.stand(motion, &into.0, start, None));
        }
        if let Some(letter) = self.words.turned_frame(self.machine, motion) {
            return Err(NoStance::RotaryOffset(letter));
        }
        if let Orientation::Vector(_, axis) = motion.orientation {
            let length = axis.norm();
            if !(1e-6..f64::INFINITY).contains(&length) {
                return Err(NoStance::NotModelled);
            }
            *open = self.aim(motion, &(axis / length), start, into)?;
        }
        let known = into.1 | self.solved();
        let tip = self.tip(motion, start).filter(|tip| tip.sum().is_finite());
        let Some(tip) = tip.filter(|_| known == self.words.all()) else {
            return Err(self.unknown_tip(motion, tip.is_some(), known));
        };
        let mut stance = self.stand(motion, &into.0, start, Some(tip));
        let turns = stance.turns(self.machine);
        if let Some(normal) = motion.tilt.normal {
            let off = angle_between(&normal, &stance.axis);
            if off > PLANE_TOLERANCE {
                into.1 &= !self.solved();
                return Err(NoStance::PlaneMisaligned(off));
            }
        }
        inverse_turned(self.machine, &turns, &mut stance.joints, &tip, stance.tool_length).ok_or(NoStance::Singular)?;
        Ok(stance)
    }

    /// The tip that tip words name, workpiece frame with the work offset, mm. If the program never named it but the position of
    /// the machine is known (TCP was just switched), it stays there.
    fn tip(&self, motion: &Motion, start: Option<&Stance>) -> Option<Vec3> {
        if let Some(point) = self.words.point(motion, &motion.end) {
            return Some(point + zero_point(motion));
        }
        if motion.tilt.free != 0 {
            return self.tip_in_plane(motion, start);
        }
        if motion.tilt.swivel == Swivel::TipStays {
            return start.map(|stance| stance.point_with(motion.tool_length_mm));
        }
        let stance = start.filter(|_| self.keeps(motion))?;
        let zero = zero_point(motion);
        let mut tip = stance.point_with(motion.tool_length_mm);
        for letter in 0..3 {
            match (motion.end.get(letter), motion.start.get(letter)) {
                (Some(value), _) => tip[letter] = value + zero[letter],
                // an increment of an unknown coordinate
                (None, None) if motion.says_way & (1 << letter) != 0 => return None,
                (None, None) => {}
                (None, Some(_)) => return None,
            }
        }
        Some(tip)
    }

    /// Whether X Y Z that the program does not know can be taken from the machine's stance: it never named them, or it forgot them
    /// because TCP was switched (but not because it lost its whole position).
    fn keeps(&self, motion: &Motion) -> bool {
        let lost = self.state.named & !motion.start.known;
        lost & XYZ == 0 || (self.state.tip_words != has_tip_words(motion) && lost & !XYZ == 0)
    }

    /// Joints that no word names keep their known positions on the machine, unless the program itself lost them.
    fn keep(&self, motion: &Motion, start: Option<&Stance>, into: &mut (Joints, u16)) {
        // joints that a turn onto a plane has set are known even if the rest is not
        let known = match start {
            None => self.state.known_joints.1 & self.state.aimed,
            Some(_) => self.state.known_joints.1,
        };
        let keeps = self.keeps(motion);
        let stays = motion.tilt.free == XYZ && self.knows_turns(motion);
        let swivels = motion.tilt.swivel == Swivel::AxesStay || stays;
        let lost = (self.state.named | motion.start.known) & !motion.end.known;
        // words that lead to no known position, or to one from an offset that is not known
        let moved = motion.says_way & !motion.end.known;
        let turns_away = self.turns_away(motion);
        let placed = motion.end.known & if has_tip_words(motion) { !XYZ } else { !0 };
        for (joint, value) in into.0.iter_mut().enumerate().take(self.words.count()) {
            let bit = 1 << joint;
            let is_lost = self.words.names(moved, joint)
                || !swivels
                    && (self.words.names(placed, joint)
                        || self.words.names(lost, joint)
                            && !(keeps && self.words.names(XYZ & !motion.start.known, joint)));
            let is_solved = has_tip_words(motion) && self.solved() & bit != 0;
            let is_given = is_solved || turns_away && self.is_rotary(joint);
            if into.1 & bit == 0 && known & bit != 0 && !is_lost && !is_given {
                *value = self.state.known_joints.0[joint];
                into.1 |= bit;
            }
        }
    }

    /// Joints that inverse kinematics solves for, as a mask.
    pub(crate) fn solved(&self) -> u16 {
        let constants = &self.machine.constants;
        constants
            .solved
            .iter()
            .fold(0, |mask, &index| mask | 1 << constants.linear[index].joint)
    }

    /// A stance with the given joints (without `tip`) or with the given rotary joints and tip (linear joints left to be solved).
    #[inline]
    pub(crate) fn stand(&self, motion: &Motion, joints: &Joints, start: Option<&Stance>, tip: Option<Vec3>) -> Stance {
        let zero = Vec3::new(motion.zero[0], motion.zero[1], motion.zero[2]);
        Stance::of_joints(self.machine, joints, (motion.tool_length_mm, &zero), start, tip)
    }

    /// What happens between start and end.
    #[inline]
    fn measure(&self, leg: &mut Leg) {
        leg.length = self.length(leg);
        let Ok(end) = &leg.end else { return };
        leg.known_joints = (end.joints, self.words.all());
        leg.pole_angle_min = end.pole_angle;
        let Some(start) = &leg.start else { return };
        let (from, to) = (start.rotary(self.machine), end.rotary(self.machine));
        leg.rotary_change = [(to[0] - from[0]).abs(), (to[1] - from[1]).abs()];
        leg.length = self.feed_length(leg);
        let constants = &self.machine.constants;
        let Some(pair) = &constants.pair else { return };
        leg.pole_angle_min = if crate::path::joint_path::on_great_circle(self.machine, &leg.motion) {
            let ends = start.pole_angle.min(end.pole_angle);
            pole::pole_angle_min_great_circle(self.machine, &start.axis, &end.axis, ends)
        } else {
            pole::pole_angle_min(constants, pair, (from[1], start.pole_angle), (to[1], end.pole_angle))
        };
        leg.open = leg.open.or_else(|| self.held_at_pole(leg));
        if self.state.sign * end.branch < 0 {
            let cheapest = cheapest_in_posture(self.machine, &end.axis, self.state.sign, from);
            let total = leg.rotary_change[0] + leg.rotary_change[1];
            leg.rotary_excess = cheapest.map_or(0.0, |least| (total - least).max(0.0));
        }
    }
}

/// Whether X Y Z are coordinates of the tip in the workpiece: TCP, or tool vectors.
#[inline]
pub(crate) fn has_tip_words(motion: &Motion) -> bool {
    let led = motion.tcp || matches!(motion.orientation, Orientation::Vector(..)) || motion.tilt.normal.is_some();
    led && !motion.machine_coordinates
        && matches!(motion.tilt.swivel, Swivel::No | Swivel::TipStays | Swivel::PointToPoint)
}

/// Whether the tip is guided between the ends too: not in point-to-point motions, whose axes move linearly.
#[inline]
pub(crate) fn leads_path(motion: &Motion) -> bool {
    has_tip_words(motion) && motion.tilt.swivel != Swivel::PointToPoint
}
