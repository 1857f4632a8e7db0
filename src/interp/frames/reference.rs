//! G27 to G30: returns to reference points; G75 of a Sinumerik: to fixed points.
use crate::codes::Found;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Feed, LengthOf, MotionKind, Position};
use trunnion_dialect::{Action, LengthAfterReturn};
use trunnion_syntax::TextRange;

/// All axes.
const ALL: u16 = (1 << 9) - 1;

/// A return in the current block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Return {
    /// G27.
    Check,
    /// G28, G30: number of the point, from 1.
    To(u32),
    /// G29.
    From,
    /// G75: number of the fixed point, from 1; `None`: not read.
    Fixed(Option<u32>),
    /// G74: homing.
    Home,
}

impl Return {
    pub(crate) fn of(found: &Found<'_>, words: &Words) -> Self {
        match found.code.action {
            Action::ReferenceCheck => Self::Check,
            Action::ReferenceFrom => Self::From,
            Action::FixedPoint if found.code.id == "G74" => Self::Home,
            Action::FixedPoint if words.p.is_given() => Self::Fixed(words.p.index()),
            Action::FixedPoint => Self::Fixed(Some(1)),
            Action::ReferenceReturnOther => Self::To(words.p.index().unwrap_or(2)),
            _ => Self::To(1),
        }
    }
}

impl Iso<'_> {
    /// The motions of a return.
    pub(crate) fn returns(&mut self, what: Return, range: TextRange, words: &Words, report: &mut Report<'_>) {
        let position = self.core.state.position;
        let mut point = self.memory.frames.programmed(&position);
        self.targets(&words.axes, false, &mut point);
        let mut named = words.axes.given | words.axes.unread;
        match what {
            Return::Check => self.rapid_to(point, report),
            Return::From => self.leave_reference(named, point, report),
            Return::Fixed(number) => self.reach_fixed(named, number, range, report),
            Return::Home => self.reach_home(named, range, report),
            Return::To(number) => {
                if named != 0 {
                    // a distance from an unknown place leads to another unknown place
                    let goes = |axis: &usize| named & (1 << axis) != 0 && point.get(*axis).is_none();
                    let still = |axis: usize| words.axes.unread & (1 << axis) == 0 && words.axes.values[axis] == 0.0;
                    if (0..9).filter(goes).all(still) {
                        self.rapid_to(point, report);
                    } else {
                        self.goes(MotionKind::Rapid, point, Feed::Rapid, report);
                        self.has_moved(named);
                    }
                    self.memory.frames.intermediate = Some(self.core.state.position);
                } else if self.core.dialect.quirks.return_moves_all {
                    named = ALL;
                    self.core.standing.end_unnamed();
                } else {
                    return;
                }
                let place = (number.max(1) - 1) as usize;
                let stored = self.memory.frames.stored_reference.get(place).copied().flatten();
                let declared = stored.or_else(|| self.core.setup.control.reference_points.get(place).copied());
                self.reach(named, declared, (FaultKind::reference_lacks(number), range), report);
                if number == 1 && self.core.dialect.quirks.length_after_return == LengthAfterReturn::CancelledByG28 {
                    self.set_length(None, LengthOf::Nothing);
                }
                self.length_after_return(named);
            }
        }
    }

    /// The present point becomes a reference point; its unknown coordinates stay unknown.
    pub(crate) fn store_reference(&mut self, place: usize) {
        let mut position = self.core.state.position;
        self.to_machine(&mut position, 1.0);
        self.memory.frames.stored_reference[place] = Some(position);
    }

    fn rapid_to(&mut self, point: Position, report: &Report<'_>) {
        let position = self.core.state.position;
        if self.memory.frames.programmed(&position) != point {
            self.goes(MotionKind::Rapid, point, Feed::Rapid, report);
        }
    }

    /// G29: the named axes go to the point of the last return first.
    fn leave_reference(&mut self, named: u16, point: Position, report: &Report<'_>) {
        let mut via = self.core.state.position;
        for axis in (0..9).filter(|axis| named & (1 << axis) != 0) {
            match self.memory.frames.intermediate.and_then(|via| via.get(axis)) {
                Some(value) => via.set(axis, value),
                None => via.forget(axis),
            }
        }
        let via = self.memory.frames.shape.to_words(&via);
        self.rapid_to(via, report);
        self.rapid_to(point, report);
    }

    /// G75: the values of the axes do not count, and neither do frames and the tool's length (SINUMERIK ONE, NC programming, 12/2019, p. 361).
    fn reach_fixed(&mut self, named: u16, number: Option<u32>, range: TextRange, report: &mut Report<'_>) {
        if named == 0 {
            // it may name them as axes of the machine (Z1=0)
            let what = "G75 without an axis of the program, so it is open which axes move (write `G75 X=0 Y=0 Z=0`)"
                .to_owned();
            report.fault(range, FaultKind::NotModelled { what });
            self.core.state.position.known = 0;
            return;
        }
        let transformed = self.core.state.tool_axis.tcp() || self.memory.frames.tilt.is_some();
        let number = number.filter(|number| *number > 0 && !transformed);
        let points = self.core.setup.control.fixed_points.as_deref().unwrap_or_default();
        let declared = number.and_then(|number| points.get(number as usize - 1).copied());
        let lacks = number.map_or_else(
            || FaultKind::NotModelled {
                what: if transformed {
                    "G75 while a transformation is active (switch it off first: TRAFOOF)".to_owned()
                } else {
                    "G75: FP is not a whole number from 1 that is known here (write `FP=1`)".to_owned()
                },
            },
            FaultKind::fixed_point_lacks,
        );
        self.reach(named, declared, (lacks, range), report);
    }

    /// G74: the machine's data say where homing ends. The axes that the block does not name stay.
    fn reach_home(&mut self, named: u16, range: TextRange, report: &mut Report<'_>) {
        let (named, what) = if self.core.state.tool_axis.tcp() || self.memory.frames.tilt.is_some() {
            (
                ALL,
                "G74 while a transformation is active (switch it off first: TRAFOOF)",
            )
        } else if named == 0 {
            // it names them as axes of the machine (Z1=0), which need not be those of the program
            (ALL, "G74 without an axis of the program, so it is open which axes move")
        } else {
            (named, "G74: where the reference point is")
        };
        let lacks = FaultKind::NotModelled { what: what.to_owned() };
        self.reach(named, None, (lacks, range), report);
    }

    /// Rapid of the named axes to a place in machine coordinates where it is declared, otherwise to an unknown position.
    fn reach(
        &mut self,
        named: u16,
        declared: Option<Position>,
        (lacks, range): (FaultKind, TextRange),
        report: &mut Report<'_>,
    ) {
        let mut start = self.core.state.position;
        self.to_machine(&mut start, 1.0);
        let mut end = start;
        // a return of all axes moves those that the machine has: of others nothing is declared, and they stay unknown
        let every = named.count_ones() == 9;
        let mut all = !every || declared.is_some();
        for axis in (0..9).filter(|axis| named & (1 << axis) != 0) {
            if let Some(value) = declared.and_then(|point| point.get(axis)) {
                end.set(axis, value);
            } else {
                end.forget(axis);
                all &= every;
            }
        }
        let orientation = self.core.held_orientation();
        if all {
            let mut motion = self
                .core
                .new_motion(MotionKind::Rapid, start, end, orientation, Feed::Rapid, report);
            motion.in_machine_coordinates(named);
            self.to_machine(&mut end, -1.0);
            self.core.state.position = end;
            self.memory.out.push(motion);
            return;
        }
        // one declaration helps all of them
        let declarable = lacks.lacks().is_some();
        if !(declarable && std::mem::replace(&mut self.memory.frames.reference_said, true)) {
            report.fault(range, lacks);
        }
        let start = self.core.state.position;
        self.core.state.position.known &= !named;
        let end = self.core.state.position;
        let motion = self
            .core
            .motion_in_frame(MotionKind::Unknown, [start, end], orientation, Feed::Unknown, report);
        self.memory.out.push(motion);
    }

    /// The axes that have a value are at that place in machine coordinates; the others stay. How they went there is no motion of the program.
    pub(crate) fn stands_at(&mut self, place: &Position) {
        let mut position = self.core.state.position;
        self.to_machine(&mut position, 1.0);
        for axis in 0..9 {
            if let Some(value) = place.get(axis) {
                position.set(axis, value);
            }
        }
        self.to_machine(&mut position, -1.0);
        self.core.state.position = position;
    }

    /// A motion to a position that is given as words give it; it is emitted with the others of the block.
    pub(crate) fn goes(&mut self, kind: MotionKind, to: Position, feed: Feed, report: &Report<'_>) {
        self.cycle_motions.add();
        let start = self.core.state.position;
        let end = self.memory.frames.arrive(to);
        self.core.state.position = end;
        let kind = self.memory.frames.kind_to_work(kind);
        let motion = self
            .core
            .motion_in_frame(kind, [start, end], self.core.held_orientation(), feed, report);
        self.memory.out.push(motion);
    }

    /// The motion that was made last moves these axes, also where its end is not known.
    pub(crate) fn has_moved(&mut self, axes: u16) {
        if let Some(motion) = self.memory.out.last_mut() {
            motion.says_way |= axes & !motion.end.known;
            self.core.moves_all(motion);
        }
    }
}
