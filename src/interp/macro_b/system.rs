//! System variables: which of #1000 and above a run knows, and what the others are.
//!
//! Source: Fanuc Series 30i operator's manual, custom macro, system variables: #4001 to #4130 modal information of the block before,
//! #5001 ff. its end point, #5021 ff. machine coordinates, #5041 ff. coordinates with the tool's length, #5081 ff. that length, #5221 to #5324 work offsets.
use super::alarms::is_fanuc;
use crate::core::Report;
use crate::frames::Frames;
use crate::iso::Iso;
use crate::memory::Memory;
use crate::{FeedMode, LengthOf, ModalState, Setup};
use trunnion_dialect::{Action, Dialect, Plane};

/// What a variable of the control is, for messages about why its value is unknown.
pub(crate) fn what(number: u32) -> &'static str {
    match number {
        1000..=1999 => "a signal of the machine",
        2000..=2999 | 10_000..=19_999 => "a tool offset of the control",
        3001 | 3002 | 3011 | 3012 => "a clock",
        3901 | 3902 => "a counter of parts",
        4000..=4199 => "modal information that the run does not keep",
        5001..=5160 if is_probing(number) => "the result of probing",
        5001..=5160 => "a position that is unknown here",
        5201..=5324 | 7001..=7960 => "a work offset of the control",
        _ => "a value of the control",
    }
}

/// #5061 ff.: the position of a skip signal.
fn is_probing(number: u32) -> bool {
    (5061..=5080).contains(&number)
}

/// What the control keeps apart from the modal state.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Kept {
    /// Drilling cycles return to the R level.
    to_r: bool,
    /// Last H.
    length_offset: Option<u32>,
}

impl Kept {
    pub(crate) fn of(memory: &Memory<'_>) -> Self {
        Self {
            to_r: memory.cycle.to_r,
            length_offset: memory.length_offset,
        }
    }
}

/// The data from which system variables are read.
#[derive(Clone, Copy)]
pub(crate) struct Known<'a> {
    pub(crate) state: &'a ModalState,
    pub(crate) setup: &'a Setup,
    pub(crate) frames: &'a Frames,
    pub(crate) kept: Kept,
    /// Numbers of modal groups and offsets are Fanuc's.
    pub(crate) fanuc: bool,
    /// A lathe: which number belongs to which axis, and whether those of X are diameters, is not taken from a source.
    pub(crate) diameter: bool,
}

impl Known<'_> {
    /// The value of a system variable, NaN where it is unknown.
    pub(crate) fn read(&self, number: u32) -> f64 {
        let unknown = f64::NAN;
        match number {
            4001..=4130 => self.modal(number - 4000).unwrap_or(unknown),
            5001..=5003 => self.end(number as usize - 5001).unwrap_or(unknown),
            5021..=5023 => self.machine(number as usize - 5021).unwrap_or(unknown),
            5041..=5043 => self.with_length(number as usize - 5041).unwrap_or(unknown),
            5081..=5083 if self.fanuc => self.length_in_force(number as usize - 5081).unwrap_or(unknown),
            5201..=5323 => self.offset(number).unwrap_or(unknown),
            7001..=7960 if self.fanuc => self.offset(number).unwrap_or(unknown),
            _ => unknown,
        }
    }

    /// Modal information: codes by their group, words by the place of their letter.
    fn modal(&self, number: u32) -> Option<f64> {
        let state = self.state;
        let code = match number {
            1 => match state.motion? {
                Action::Rapid => 0.0,
                Action::Linear => 1.0,
                Action::ArcClockwise => 2.0,
                Action::ArcCounterClockwise => 3.0,
                _ => return None,
            },
            2 => match state.coordinates.plane() {
                Plane::Xy => 17.0,
                Plane::Zx => 18.0,
                Plane::Yz => 19.0,
            },
            3 => {
                if state.coordinates.incremental() {
                    91.0
                } else {
                    90.0
                }
            }
            5 => match state.feed.mode() {
                FeedMode::InverseTime => 93.0,
                FeedMode::PerMinute => 94.0,
                FeedMode::PerRevolution => 95.0,
            },
            6 => {
                if state.coordinates.unit_mm() > 1.0 {
                    20.0
                } else {
                    21.0
                }
            }
            7 => match state.compensation {
                0 => 40.0,
                side => f64::from(side),
            },
            8 if self.fanuc && !state.tool_axis.tcp() => match (state.length.mm(), state.length.of()) {
                (None, LengthOf::Nothing) => 49.0,
                (Some(_), LengthOf::Tool(_)) => 43.0,
                _ => return None,
            },
            9 if self.fanuc => match state.motion? {
                Action::ChipBreakCycle => 73.0,
                Action::TapLeftCycle => 74.0,
                Action::FineBoreCycle => 76.0,
                Action::DrillCycle => 81.0,
                Action::DrillDwellCycle => 82.0,
                Action::PeckCycle => 83.0,
                Action::TapCycle => 84.0,
                Action::BoreStopCycle => 86.0,
                Action::BackBoreCycle => 87.0,
                Action::BoreManualCycle => 88.0,
                Action::Rapid | Action::Linear | Action::ArcClockwise | Action::ArcCounterClockwise => 80.0,
                _ => return None,
            },
            10 if self.fanuc => {
                if self.kept.to_r {
                    99.0
                } else {
                    98.0
                }
            }
            12 if !self.fanuc => self.offset_code()?,
            14 if self.fanuc => self.offset_code()?,
            109 => state.feed.value()? / state.feed.unit_mm(),
            111 if self.fanuc => f64::from(self.kept.length_offset?),
            119 => state.spindle.rpm()?,
            120 => f64::from(state.tool.prepared().or(state.tool.number())?),
            _ => return None,
        };
        Some(code)
    }

    /// 54 to 59: the active work offset.
    fn offset_code(&self) -> Option<f64> {
        let name = self.state.zero.offset()?;
        name.strip_prefix('G')?.parse().ok()
    }

    /// End point of the block before, program units.
    fn end(&self, axis: usize) -> Option<f64> {
        let along = || self.setup.length_along().get(axis).is_some_and(|along| *along != 0.0);
        if self.frames.active || self.state.zero.is_lost() || self.state.length.is_open() && along() {
            return None;
        }
        Some(self.state.position.get(axis)? / self.state.coordinates.unit_mm())
    }

    /// End point of the block before with the tool's length, which lies along the tool at home while tool centre point control is off.
    fn with_length(&self, axis: usize) -> Option<f64> {
        let length = self.length(axis)?;
        Some((self.state.position.get(axis)? + length) / self.state.coordinates.unit_mm())
    }

    /// The same in machine coordinates.
    fn machine(&self, axis: usize) -> Option<f64> {
        let length = self.length(axis)?;
        if self.state.zero.undeclared() & (1 << axis) != 0 {
            return None;
        }
        Some(
            (self.state.position.get(axis)? + self.state.zero.values()[axis] + length)
                / self.state.coordinates.unit_mm(),
        )
    }

    fn length(&self, axis: usize) -> Option<f64> {
        let shifted = self.frames.active || self.state.zero.is_lost() || self.state.compensation != 0;
        // of a lathe's tool the sources do not say which variables contain its offset
        let shifted = shifted || matches!(self.state.length.of(), LengthOf::Offset(_));
        if self.state.tool_axis.tcp() || shifted {
            return None;
        }
        let along = self.setup.length_along().get(axis).copied().unwrap_or(0.0);
        if along != 0.0 && (self.state.length.is_open() || self.state.length.is_undeclared()) {
            return None;
        }
        Some(self.state.length.mm().unwrap_or(0.0) * along)
    }

    /// Length offset in force, program units.
    fn length_in_force(&self, axis: usize) -> Option<f64> {
        let length = &self.state.length;
        if self.state.length.is_open() {
            return None;
        }
        let mm = match (length.mm(), length.of()) {
            (None, LengthOf::Nothing) => 0.0,
            (_, LengthOf::Offset(_)) => return None,
            (Some(mm), _) if !length.is_undeclared() => mm,
            _ => return None,
        };
        let along = self.setup.length_along().get(axis).copied()?;
        (!self.state.tool_axis.tcp()).then(|| mm * along / self.state.coordinates.unit_mm())
    }

    /// Known where the setup declares the offset, or the program has written it.
    fn offset(&self, number: u32) -> Option<f64> {
        let (name, axis) = offset_of(number).filter(|_| !self.diameter)?;
        let value = match name {
            // nothing declares it
            None => (self.frames.external_written & (1 << axis) != 0).then_some(self.frames.external[axis])?,
            Some(name) => {
                let zero = self.frames.offset_values(&name, self.setup)?;
                (zero.known & (1 << axis) != 0).then_some(zero.values[axis])?
            }
        };
        Some(value / self.state.coordinates.unit_mm())
    }
}

/// The work offset and axis of #5201 to #5323: 20 numbers for each, the offset of all zero points (`None`) first, then G54 to G59; from #7001
/// the additional ones of G54.1 (of a Fanuc: P1 to P48). `None` for other axes than X Y Z, whose order is the machine's.
fn offset_of(number: u32) -> Option<(Option<String>, usize)> {
    if let Some(place) = number.checked_sub(7001).filter(|place| *place < 960) {
        let axis = (place % 20) as usize;
        return (axis < 3).then(|| (Some(format!("G54.1 P{}", place / 20 + 1)), axis));
    }
    let place = number.checked_sub(5201)?;
    let (code, axis) = (53 + place / 20, (place % 20) as usize);
    (axis < 3 && code <= 59).then(|| ((code > 53).then(|| format!("G{code}")), axis))
}

/// The L of G10 and the number of the tool offset whose radius #12001 ff. (wear) and #13001 ff. (geometry) hold on a mill (Tool offset variables,
/// docs/sources.md). What those of lengths change while one is in effect is not followed.
fn radius_of(number: u32) -> Option<(u32, u32)> {
    let (thousands, offset) = (number / 1000, number % 1000);
    match thousands {
        12 if offset > 0 => Some((13, offset)),
        13 if offset > 0 => Some((12, offset)),
        _ => None,
    }
}

/// Whether the run follows what an assignment to a system variable changes.
pub(crate) fn is_followed(number: u32, dialect: &Dialect) -> bool {
    if radius_of(number).is_some() {
        return is_fanuc(dialect) && !dialect.quirks.diameter;
    }
    (is_fanuc(dialect) || number < 7000) && offset_of(number).is_some() && !dialect.quirks.diameter
}

impl Iso<'_> {
    /// An assignment to #5201 to #5323: a zero point moves, the machine stays where it is. One to #12001 or #13001 ff. changes a radius. `value` in program units.
    pub(crate) fn system_write(&mut self, number: u32, value: f64, report: &mut Report<'_>) {
        let value = value * self.core.state.coordinates.unit_mm();
        if let Some((l, offset)) = radius_of(number) {
            self.lose("its radius is written", report);
            return self.store_tool(l, offset, value, false);
        }
        let Some((name, axis)) = offset_of(number) else { return };
        let Some(name) = name else {
            self.memory.frames.external[axis] = value;
            self.memory.frames.external_written |= 1 << axis;
            return self.refresh_zero();
        };
        let mut zero = self.offset_values(&name).unwrap_or_default();
        zero.values[axis] = value;
        zero.known |= 1 << axis;
        self.store_offset(&name, zero);
    }
}
