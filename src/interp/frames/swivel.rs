//! Codes of tilted working planes: G68.2, G68.4, G53.1, G53.6 of a Fanuc; CYCLE800 of a Sinumerik.
use super::swivel_call::{SwivelCall, deselects, follows_modal_call, may_move, why_not_read};
use super::{Tilted, XYZ};
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::core::{LINEAR, ROTARY};
use crate::iso::Iso;
use crate::words::{WordValue, Words};
use crate::{FaultKind, Feed, ImplicitDecimals, Motion, MotionKind, Orientation, Posture, RollPitchYaw, Swivel};
use trunnion_dialect::Action;
use trunnion_geometry::Vec3;

impl<'d> Iso<'d> {
    /// A motion as it is emitted: in the workpiece frame.
    #[inline]
    pub(crate) fn untilted(&self, motion: &Motion) -> Motion {
        match &self.memory.frames.tilt {
            Some(tilt) if !motion.machine_coordinates && !self.core.state.zero.is_lost() => tilt.motion_to_work(motion),
            // a turn onto a plane of a system that is not known
            Some(_) if self.core.state.zero.is_lost() && matches!(motion.orientation, Orientation::Vector(None, _)) => {
                Motion {
                    kind: MotionKind::Unknown,
                    orientation: Orientation::Words,
                    ..*motion
                }
            }
            _ => *motion,
        }
    }

    /// Positions are expressed in the coordinates of another plane from here on. The machine stays where it is; rotary axes that were set by
    /// a vector are not known.
    pub(super) fn tilt_to(&mut self, tilt: Option<Tilted>, report: &mut Report<'_>) {
        if self.memory.compensation.is_busy() || self.memory.corners.is_busy() {
            let what = "a tilted plane starts or ends under cutter compensation".to_owned();
            report.fault(report.whole(), FaultKind::NotModelled { what });
            self.core.forget_position();
            self.forget_pending(report);
        }
        let mut position = self.core.state.position;
        if let Some(old) = self.memory.frames.tilt {
            position = old.to_work(&position);
        }
        if let Some(new) = tilt {
            position = new.to_plane(&position);
        }
        (self.memory.frames.tilt, self.memory.frames.swivel) = (tilt, None);
        if !self.core.state.tool_axis.tcp() {
            // without tool centre point control words are not positions of the tip if a rotary axis is turned, or if the tool is off the
            // zero of the axes; only the machine gives the position of the tip
            position.known &= !XYZ;
        }
        self.core.state.position = position;
        self.core.state.orientation = Orientation::Words;
        self.memory.frames.refresh(&position);
    }

    /// G69 and the like.
    pub(crate) fn end_tilt(&mut self, report: &mut Report<'_>) {
        if self.memory.frames.tilt.is_some_and(|tilt| !tilt.programmed) {
            self.tilt_to(None, report);
        }
    }

    /// G68.2 X Y Z I J K: zero of the plane, and Euler angles about Z, the turned X, the turned Z (Series 30i operator's manual, tilted
    /// working plane). P1 gives turns about X, Y, Z with their order in Q; a parameter of the run decides between fixed and turned axes;
    /// it makes no difference where at most one is not zero. The other kinds of P are not modelled. G68.4 is relative to the active plane.
    pub(crate) fn tilted_plane(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let adds = found.code.id == "G68.4";
        let is_feature = found.code.id == "G268";
        if let (false, Some(kind @ (2 | 3))) = (adds || is_feature, words.letter(b'P').index()) {
            self.plane_part((kind == 3, found), words, block, report);
            return;
        }
        let turns = if is_feature {
            self.feature_turns(words, report)
                .filter(|_| self.memory.frames.dynamic.is_none() && !self.core.state.tool_axis.tcp())
        } else {
            self.plane_turns(words, report)
        };
        let clear = words.axes.unread == 0
            && !self.core.state.coordinates.incremental()
            && self.memory.frames.shape.is_identity();
        let outer = self.memory.frames.tilt.filter(|_| adds);
        let (Some(turns), true) = (
            turns,
            clear && adds == outer.is_some() && !self.core.state.zero.is_lost(),
        ) else {
            self.end_tilt(report);
            let why = (!is_feature && turns.is_none())
                .then(|| self.why_no_turns(words))
                .flatten();
            let Some(why) = why else {
                self.frame_change(found, words, block, report);
                return;
            };
            let what = format!("{}: {why}", found.code.id);
            report.fault(found.range, FaultKind::NotModelled { what });
            self.frame_begins(found, words, block);
            return;
        };
        block.takes_coordinates = true;
        let origin = Vec3::from_fn(|axis, _| self.axis_value(words, axis).unwrap_or(0.0));
        let plane = Tilted::new(origin, &turns);
        self.tilt_to(Some(outer.map_or(plane, |outer| outer.then(&plane))), report);
    }

    /// What is not known of the turns, where one word is the reason.
    fn why_no_turns(&self, words: &Words) -> Option<&'static str> {
        match words.letter(b'P').index() {
            Some(4) => Some("no source states how the angles of P4 turn"),
            Some(1) if self.core.setup.control.roll_pitch_yaw.is_none() => {
                Some("whether P1 turns about fixed or turned axes: declare roll_pitch_yaw under [control]")
            }
            _ if words.radius.is_given() => Some("how R turns the plane"),
            _ => None,
        }
    }

    /// Axis and degrees of the turns that I J K give.
    fn plane_turns(&self, words: &Words, report: &mut Report<'_>) -> Option<[(usize, f64); 3]> {
        let [i, j, k] = self.plane_angles(words, report)?;
        match words.letter(b'P') {
            WordValue::Nothing => {}
            said => match said.index()? {
                0 => {}
                1 => return self.roll_pitch_yaw([i, j, k], words.letter(b'Q')),
                _ => return None,
            },
        }
        (!words.letter(b'Q').is_given()).then_some([(2, i), (0, j), (2, k)])
    }

    /// I J K in degrees; R is not followed.
    pub(super) fn plane_angles(&self, words: &Words, report: &mut Report<'_>) -> Option<[f64; 3]> {
        let implicit = self.core.setup.control.implicit_decimals;
        let angle = |letter| match words.letter(letter) {
            WordValue::Nothing => Some(0.0),
            said => said.number().map(|number| match implicit {
                Some(ImplicitDecimals::LeastIncrement) if !number.has_point => number.value / 1000.0,
                _ => number.value,
            }),
        };
        let [i, j, k] = [angle(b'I')?, angle(b'J')?, angle(b'K')?];
        let mut said = [b'I', b'J', b'K']
            .into_iter()
            .filter_map(|letter| words.letter(letter).number());
        if let (None, Some(whole)) = (implicit, said.find(|number| !number.has_point && number.value != 0.0)) {
            report.fault(whole.range, FaultKind::AmbiguousDecimal);
        }
        (!words.radius.is_given()).then_some([i, j, k])
    }

    /// G68.2 P1: turns about X, Y, Z by I, J, K in the order that Q gives (Q123: first X).
    fn roll_pitch_yaw(&self, angles: [f64; 3], order: WordValue) -> Option<[(usize, f64); 3]> {
        let turn = |axis: usize| (axis, angles[axis]);
        if angles.iter().filter(|angle| **angle != 0.0).count() <= 1 {
            return Some([turn(0), turn(1), turn(2)]);
        }
        let order = order.index()?;
        let digit = |place: u32| usize::try_from(order / 10u32.pow(place) % 10).ok()?.checked_sub(1);
        let axes = [digit(2)?, digit(1)?, digit(0)?];
        if order > 333 || axes.iter().fold(0, |mask, axis| mask | 1 << axis) != 0b111 {
            return None;
        }
        match self.core.setup.control.roll_pitch_yaw? {
            RollPitchYaw::Turned => Some(axes.map(turn)),
            // the last turn about a fixed axis is the outermost
            RollPitchYaw::Fixed => Some([turn(axes[2]), turn(axes[1]), turn(axes[0])]),
        }
    }

    /// G53.1: the rotary axes turn the tool perpendicular to the plane; the linear axes stay. G53.6: the tip stays.
    pub(crate) fn tilted_plane_turn(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let posture = match words.letter(b'P') {
            WordValue::Nothing => Some(Posture::ByRule),
            // the machine file declares which of the solutions a number means
            said => said
                .index()
                .and_then(|number| u8::try_from(number).ok())
                .map(Posture::Numbered),
        };
        let plain = !words.axes.any();
        let Some(posture) = posture.filter(|_| plain) else {
            self.unmodelled_code(found, words, block, report);
            self.turns_to_nowhere(report);
            return;
        };
        // G254 is no plane onto which the tool turns
        let turned_table = self.memory.frames.dynamic.is_some();
        if self.memory.frames.tilt.is_none() || self.core.state.tool_axis.tcp() || turned_table {
            self.unmodelled_code(found, words, block, report);
            self.turns_to_nowhere(report);
            return;
        }
        block.takes_coordinates = true;
        let swivel = if found.code.action == Action::TiltedPlaneTurnTip {
            Swivel::TipStays
        } else if found.code.id == "G253" {
            // no source says whether the linear axes stay
            Swivel::AxesLost
        } else {
            Swivel::AxesStay
        };
        self.swivel(swivel, posture, report);
    }

    /// The swivelled plane ends; where the call may move the axes, none of them is known after it.
    fn end_swivel(&mut self, moves: bool, found: &Found<'d>, report: &mut Report<'_>) {
        let inside = self.memory.frames.inside_plane();
        self.end_tilt(report);
        let ended = self.core.unknown.end(found.code);
        self.core.forget_if(ended);
        if inside {
            self.frame_is_left(found, report);
        }
        self.core.state.zero.lose(self.core.unknown.any());
        if moves {
            let what = "CYCLE800: the path on which it retracts and turns back when it ends".to_owned();
            report.fault(found.range, FaultKind::NotModelled { what });
            self.turns_to_nowhere(report);
        }
    }

    /// The axes turn, and where they end is not known.
    fn turns_to_nowhere(&mut self, report: &mut Report<'_>) {
        let mut motion = self.unknown_motion(&Words::default(), report);
        self.core.forget_position();
        motion.end = self.core.state.position;
        self.memory.out.push(motion);
    }

    /// A swivelled plane ends inside which the program has set a frame: whether the frame stays is not taken from a source.
    fn frame_is_left(&mut self, found: &Found<'d>, report: &mut Report<'_>) {
        let what = "the frame that TRANS, ROT, SCALE or MIRROR has set in the swivelled plane, once the plane ends (write TRANS alone before it)";
        report.fault(found.range, FaultKind::NotModelled { what: what.to_owned() });
        self.end_programmable();
        if let Some(code) = self.core.dialect.name("TRANS") {
            self.core.unknown.begin(code, false);
        }
        self.core.forget_position();
    }

    /// Turns the rotary axes onto the plane's normal.
    fn swivel(&mut self, swivel: Swivel, posture: Posture, report: &Report<'_>) {
        let start = self.core.state.position;
        // also where the tip stays: X Y Z from before it was guided are not a position of the tip
        self.core.forget_linear();
        self.core.state.position.known &= !ROTARY;
        let mut end = self.core.state.position;
        end.known &= !LINEAR;
        let orientation = Orientation::Vector(None, Vec3::z());
        let mut motion = self
            .core
            .new_motion(MotionKind::Rapid, start, end, orientation, Feed::Rapid, report);
        (motion.tilt.swivel, motion.tilt.posture, motion.tcp) = (swivel, posture, false);
        self.memory.out.push(motion);
    }

    /// CYCLE800(retract, data record, state, mode, X0, Y0, Z0, A, B, C, X1, Y1, Z1, direction, retract distance): shift, turns about the axes
    /// that the mode names in their order, shift in the turned plane; direction -1 or 1 turns the rotary axes, 0 does not (Sinumerik
    /// 840D sl Programming Manual, Cycles).
    pub(crate) fn swivel_cycle(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let text = report.program.text(found.range).into_owned();
        if follows_modal_call(&report.program.block(report.block)) {
            self.end_tilt(report);
            let why = "after MCALL: whether it swivels after each motion is not taken from a source";
            return self.frame_unknown(why, found, words, block, report);
        }
        let value = |text: &str| self.memory.own.value(text);
        let moves = may_move(&text, found.with_arguments, value);
        if moves && self.modal_call_unclear(found, report) {
            block.takes_coordinates = true;
            return;
        }
        let value = |text: &str| self.memory.own.value(text);
        if let Some(retracts) = deselects(&text, found.with_arguments, value) {
            block.takes_coordinates = true;
            self.end_swivel(retracts, found, report);
            return;
        }
        let outer = self.memory.frames.tilt;
        // whether a frame of the program ends with it, or is inside it, is not modelled
        let shifted = self.memory.frames.local != [0.0; 9] || outer.is_some_and(|outer| outer.programmed);
        let plain = self.memory.frames.shape.is_identity() && !self.memory.compensation.is_busy() && !shifted;
        let read = SwivelCall::read(&text, value);
        let is_read = read.is_some();
        let Some(call) = read.filter(|call| plain && (!call.adds || outer.is_some())) else {
            let why = if is_read {
                "with a frame of the program or radius compensation before it, or added to a plane that there is not"
            } else {
                why_not_read(&text, value)
            };
            self.end_tilt(report);
            return self.frame_unknown(why, found, words, block, report);
        };
        let ended = self.core.unknown.end(found.code);
        self.core.forget_if(ended);
        block.takes_coordinates = true;
        let unit = self.core.state.coordinates.unit_mm();
        let shifted = |by: [f64; 3]| Tilted::new(Vec3::from(by) * unit, &[]);
        let plane = shifted(call.before)
            .then(&Tilted::new(Vec3::zeros(), &call.turns))
            .then(&shifted(call.behind));
        let plane = outer.filter(|_| call.adds).map_or(plane, |outer| outer.then(&plane));
        self.tilt_to(Some(plane), report);
        self.memory.frames.swivel = Some(plane);
        let posture = match call.direction {
            0 => return,
            1 => Posture::Higher,
            _ => Posture::Lower,
        };
        let swivel = match (call.retracts, call.holds_tip) {
            (true, _) => Swivel::AxesLost,
            (false, true) => Swivel::TipStays,
            (false, false) => Swivel::AxesStay,
        };
        self.core.state.zero.lose(self.core.unknown.any());
        self.swivel(swivel, posture, report);
    }
}
