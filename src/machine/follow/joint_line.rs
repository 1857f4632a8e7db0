//! The short path for the most frequent motion: a line in words of the joints, from one known stance to the next.
use crate::follow::choice::cheapest_in_posture;
use crate::follow::line_cache::LineCache;
use crate::follow::words::Words;
use crate::kinematics::pole;
use crate::path::length::way;
use crate::{Follower, Leg, Sine};
use trunnion_interp::{Motion, MotionKind, Orientation, Posture, Swivel};

impl Follower<'_> {
    /// [`Self::follow`] into the storage of the leg before, which is made where there is none.
    #[inline]
    pub fn follow_into(&mut self, motion: &Motion, leg: &mut Option<Box<Leg>>) {
        self.relocate(motion);
        match leg {
            Some(leg) if self.is_straight(motion) => {
                if !self.lines.as_ref().is_some_and(|lines| lines.hold(motion)) {
                    self.lines = Some(LineCache::of(self.machine, &self.words, motion));
                }
                leg.motion = *motion;
                self.straight(leg);
            }
            Some(leg) => **leg = self.general(motion),
            None => *leg = Some(Box::new(self.general(motion))),
        }
    }

    /// [`Self::follow_into`] for a line that differs from the motion of the leg before in what [`trunnion_interp::Sink::next_line`] names and in
    /// nothing else.
    #[inline]
    pub fn follow_line_into(&mut self, motion: &Motion, leg: &mut Option<Box<Leg>>) {
        match leg {
            Some(leg) if self.lines.is_some() && self.goes_on(motion) => {
                debug_assert!(
                    self.is_straight(motion),
                    "a line that is not straight after one that is"
                );
                let own = &mut leg.motion;
                (own.block, own.chain, own.feed) = (motion.block, motion.chain, motion.feed);
                // the larger kinds need not be written
                if matches!(motion.kind, MotionKind::Rapid) {
                    own.kind = MotionKind::Rapid;
                } else {
                    own.kind = MotionKind::Linear;
                }
                own.start = own.end;
                own.end = motion.end;
                debug_assert_eq!(format!("{own:?}"), format!("{motion:?}"), "more than a line differs");
                self.straight(leg);
            }
            _ => self.follow_into(motion, leg),
        }
    }

    /// Sets the predicted sine of a rotary axis, 0 being that nearest the workpiece.
    #[inline]
    pub fn set_predicted_sine(&mut self, index: usize, sine: Sine) {
        if let Some(own) = self.sines.get_mut(index) {
            *own = sine;
        }
    }

    /// Whether [`Self::straight`] applies to a motion: the words name all axes, and words differ from axis positions only by offsets.
    #[inline]
    pub(crate) fn is_straight(&self, motion: &Motion) -> bool {
        let tilt = &motion.tilt;
        self.words.literal
            && self.state.stance.is_some()
            && !(motion.tcp || motion.machine_coordinates || motion.ways.carried != 0)
            && matches!(motion.orientation, Orientation::Words)
            && tilt.normal.is_none()
            && tilt.swivel == Swivel::No
            && tilt.posture == Posture::ByRule
            && Words::has_offsets(motion)
            && self.goes_on(motion)
    }

    /// The part of [`Self::is_straight`] that depends on the end of a motion and on its kind: the rest is unchanged if the motion before was straight
    /// and no more differs.
    #[inline]
    fn goes_on(&self, motion: &Motion) -> bool {
        matches!(motion.kind, MotionKind::Rapid | MotionKind::Linear)
            && motion.start.xyz().is_some()
            && self.words.names_all(&motion.end)
            && self.words.foreign(motion).is_none()
    }

    /// Follows the motion in a leg's storage, for which [`Self::is_straight`] holds, as the general path would (a test compares both).
    /// [`Self::lines`] are those of the motion.
    #[inline]
    fn straight(&mut self, leg: &mut Leg) {
        let all = self.words.all();
        leg.start = self.state.stance;
        leg.start_given = false;
        leg.taken_away = false;
        leg.open = None;
        leg.rotary_excess = 0.0;
        if let (Some(start), Err(_)) = (&leg.start, &leg.end) {
            leg.end = Ok(*start);
        }
        let (Some(start), Ok(end), Some(lines)) = (&leg.start, &mut leg.end, &self.lines) else {
            return;
        };
        self.words
            .put_literal_joints(&leg.motion.end, &lines.added, &mut end.joints);
        if !lines.stand(self.machine, &self.sines, start, end) {
            let joints = end.joints;
            *end = self.stand(&leg.motion, &joints, Some(start), None);
        }
        leg.known_joints = (end.joints, all);
        let rotary = end.rotary(self.machine);
        self.measure_straight(leg, rotary);
        let Ok(end) = &leg.end else { return };
        let state = &mut self.state;
        state.known_joints = leg.known_joints;
        state.rotary = rotary;
        state.rotary_known = true;
        state.rotary_lost = 0;
        state.led = false;
        if end.branch != 0 {
            state.sign = end.branch;
        }
        state.aimed &= all;
        state.named = leg.motion.end.known;
        state.tip_words = false;
        state.stance = Some(*end);
    }

    /// `to`: the rotary joints at the end.
    #[inline]
    fn measure_straight(&self, leg: &mut Leg, to: [f64; 2]) {
        leg.rotary_change = [0.0; 2];
        leg.length = 0.0;
        let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
            return;
        };
        leg.pole_angle_min = end.pole_angle;
        let from = self.state.rotary;
        debug_assert_eq!(from, start.rotary(self.machine), "the machine is at another position");
        leg.rotary_change = [(to[0] - from[0]).abs(), (to[1] - from[1]).abs()];
        if let (Some(from), Some(to)) = (leg.motion.start.xyz(), leg.motion.end.xyz()) {
            leg.length = way((to - from).norm());
        }
        if self.machine.control.feed.is_some() {
            leg.length = self.feed_length(leg);
        }
        let constants = &self.machine.constants;
        let Some(pair) = &constants.pair else { return };
        leg.pole_angle_min =
            pole::pole_angle_min(constants, pair, (from[1], start.pole_angle), (to[1], end.pole_angle));
        if self.state.sign * end.branch < 0 {
            let cheapest = cheapest_in_posture(self.machine, &end.axis, self.state.sign, from);
            let total = leg.rotary_change[0] + leg.rotary_change[1];
            leg.rotary_excess = cheapest.map_or(0.0, |least| (total - least).max(0.0));
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use crate::{BUILTIN_MACHINES, Follower, Leg, Machine, Open, OpenCause, builtin};
    use proptest::prelude::*;
    use trunnion_interp::{AXIS_LETTERS, Feed, Motion, MotionKind, Position};

    /// The built-in machines, and one with its axes off the origin and reversed, whose linear axes are in each part of the chain.
    pub(crate) fn machines() -> Vec<Machine> {
        let own = BUILTIN_MACHINES
            .iter()
            .map(|name| builtin(name).expect("built in").clone());
        let source = crate::builtin_source("mikron-ucp710").expect("built in");
        let (axes, control) = source.split_once("[control]").expect("a control");
        let (control, _) = control
            .split_once("[[check]]")
            .expect("rows that hold for the axes as they are");
        let mut pieces = axes.split("[[axis]]");
        let head = pieces
            .next()
            .expect("the head")
            .replace("gauge_point = [0, 0, 0]", "gauge_point = [1, -2, 3]");
        let [c, a, x, y, z]: [&str; 5] = pieces.collect::<Vec<_>>().try_into().expect("five axes");
        let c = c.replace("point = [0, 0, 0]", "point = [10, -20, 5]");
        let a = a
            .replace("point = [0, 0, 0]", "point = [-3, 40, 7]")
            .replace("sign = 1", "sign = -1");
        let (x, z) = (x.replace("sign = 1", "sign = -1"), z.replace("sign = 1", "sign = -1"));
        let table = |axis: &str| axis.replace("side = \"head\"", "side = \"table\"");
        let (c_head, a_head) = (c.replace("\"table\"", "\"head\""), a.replace("\"table\"", "\"head\""));
        let chains = [
            [c.clone(), a.clone(), x.clone(), y.into(), z.clone()],
            [c, table(&z), table(y), table(&x), a],
            [table(y), table(&x), table(&z), c_head, a_head],
        ];
        let others = chains.map(|axes| {
            let text = axes.iter().fold(head.clone(), |text, axis| text + "[[axis]]" + axis);
            crate::load("turned", &(text + "[control]" + control)).expect("valid")
        });
        own.chain(others).collect()
    }

    #[test]
    fn linear_axes_lie_in_each_piece_of_the_chain() {
        let machines = machines();
        let pieces = machines[BUILTIN_MACHINES.len()..].iter();
        let pieces: Vec<_> = pieces.map(|machine| machine.constants.only_segment).collect();
        assert_eq!(pieces, [Some(2), Some(1), Some(0)]);
    }

    /// A motion in joint words, with offsets in X and A and a tool.
    pub(crate) fn motion(start: Position, end: Position, kind: MotionKind, offset: f64) -> Motion {
        let mut zero = [0.0; 9];
        (zero[0], zero[3]) = (offset, offset * 0.1);
        Motion {
            kind,
            feed: Feed::PerMinute(500.0),
            spindle_on: Some(true),
            zero,
            tool_length_mm: offset * 2.0,
            ..Motion::line(start, end)
        }
    }

    proptest! {
        /// On every machine both paths give the same legs and leave the same state.
        #[test]
        fn the_short_way_is_the_general_way(
            machine in proptest::sample::select(machines()),
            offset in prop_oneof![Just(0.0), -50.0..50.0],
            places in proptest::collection::vec((proptest::array::uniform9(-120.0..120.0), 0..12_u8, any::<(bool, bool)>()), 2..8),
        ) {
            let mut short = Follower::new(&machine);
            let (mut at, mut leg): (_, Option<Box<Leg>>) = (Position::default(), None);
            // emitted line by line from its first motion on
            let (mut lines, mut line, mut before) = (short.clone(), None, f64::NAN);
            for (values, held, (rapid, shifted)) in places {
                let offset = if shifted && held < 5 { 3.0 - offset } else { offset };
                let mut to = at;
                for (axis, value) in values.into_iter().enumerate() {
                    // rarely an axis that the machine lacks, or one that does not move
                    let own = machine.axes.iter().any(|own| own.letter == AXIS_LETTERS[axis]);
                    if at.known & (1 << axis) == 0 || ((own || held == 11) && axis != usize::from(held)) {
                        to.set(axis, value);
                    }
                }
                let kind = if rapid { MotionKind::Rapid } else { MotionKind::Linear };
                let mut motion = motion(at, to, kind, offset);
                motion.block = trunnion_syntax::BlockId(u32::from(held));
                motion.feed = Feed::PerMinute(values[0]);
                let mut general = short.clone();
                let expected = general.general(&motion);
                if let Some(leg) = &mut leg {
                    // nothing of the leg before may be left
                    leg.rotary_excess = 7.0;
                    leg.pole_angle_min = 7.0;
                    leg.length = 7.0;
                    leg.rotary_change = [7.0; 2];
                    leg.start_given = true;
                    leg.open = Some(Open { cause: OpenCause::Tie, taken: [7.0; 2], other: [7.0; 2] });
                }
                // emitted as a difference if nothing else differs
                let next = leg.as_deref().is_some_and(|leg| leg.motion.end == at) && offset == before;
                before = offset;
                if next {
                    lines.follow_line_into(&motion, &mut line);
                } else {
                    lines.follow_into(&motion, &mut line);
                }
                prop_assert_eq!(format!("{:?}", line.as_deref()), format!("{:?}", Some(&expected)));
                prop_assert_eq!(format!("{:?}", lines.state), format!("{:?}", general.state));
                let mut told = (short.clone(), leg.clone());
                short.follow_into(&motion, &mut leg);
                if next {
                    told.0.follow_line_into(&motion, &mut told.1);
                    prop_assert_eq!(format!("{:?}", told.1), format!("{:?}", leg));
                    prop_assert_eq!(format!("{:?}", told.0.state), format!("{:?}", short.state));
                }
                prop_assert_eq!(format!("{:?}", leg.as_deref()), format!("{:?}", Some(&expected)));
                prop_assert_eq!(format!("{:?}", short.state), format!("{:?}", general.state));
                at = to;
            }
        }
    }
}
