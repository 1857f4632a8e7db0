//! Calls that shift the zero point: work offsets, G92, rotation and the tool length; what is known of them.
use super::bridge::Bridge;
use super::frames::Shift;
use super::setup::{FIRST_SYSTEM, SYSTEMS};
use crate::{FaultKind, LengthOf, Sink};
use trunnion_ngc::{At, Canon, Pose, State};
use trunnion_syntax::TextRange;

impl<S: Sink> Bridge<'_, '_, '_, S> {
    pub(super) fn tool_offset(&mut self, offset: &Pose, at: At, state: &State) {
        let on = offset.iter().any(|value| *value != 0.0) || state.tool != 0;
        self.calls.tool_offset = Shift::metric(offset, state.units.mm());
        let length = self.calls.tool_offset[2];
        let of = match state.length_of {
            Some(0) => LengthOf::Tool(self.core.state.tool.number()),
            Some(number) => u32::try_from(number).map_or(LengthOf::Other, |number| LengthOf::Tool(Some(number))),
            None => LengthOf::Nothing,
        };
        // a row of zeros that nothing declares: whether one was set is not known
        let unset = |number: Option<i32>| {
            let number = number.and_then(|number| u32::try_from(number).ok());
            let named = number.filter(|number| *number != 0);
            let data = match named {
                Some(_) => self.core.tools.data(named),
                None => self.core.state.tool.data(),
            };
            data.and_then(|tool| tool.length_mm).is_none()
        };
        let added = state.length_added.filter(|number| is_zero_row(state, *number));
        let in_force = (on && length.is_finite()).then_some(length);
        let undeclared = in_force == Some(0.0) && unset(state.length_of) || added.is_some() && unset(added);
        if offset.iter().any(|value| !value.is_finite()) {
            self.unknown_value("the tool offset", at, (430, 432));
        }
        if undeclared && of != LengthOf::Nothing {
            self.core.state.length.set_undeclared(in_force.unwrap_or(0.0), of);
        } else if !length.is_finite() {
            self.core.state.length.set_declared(None, of);
        } else {
            self.core.state.length.set(in_force, of);
        }
        if undeclared {
            let tool = match added.or(state.length_of) {
                Some(number @ 1..) => format!("H{number}"),
                _ => self.core.tools.name(),
            };
            if self.core.tools.first_report_of_length(&tool) {
                let range = self.code_range(at, b'G', |code| (430..=432).contains(&code));
                self.fault(at, range, FaultKind::ToolLengthUnset { tool });
            }
        }
    }

    /// A shift or rotation is set from a value that is not known, or at such a position.
    pub(super) fn report_unknown_shift(&mut self, call: &Canon, at: At) {
        let unknown = |offset: &Pose| offset.iter().any(|value| !value.is_finite());
        match call {
            Canon::G92Offset(offset) if unknown(offset) => self.unknown_value("G92", at, (920, 923)),
            Canon::XyRotation(angle) if !angle.is_finite() => {
                self.unknown_value("the rotation of the coordinate system", at, (100, 100));
            }
            Canon::G5xOffset(index, offset) if unknown(offset) => {
                let name = usize::try_from(*index - 1).ok().and_then(|index| SYSTEMS.get(index));
                self.unknown_value(name.unwrap_or(&"the zero point"), at, (100, 100));
            }
            _ => {}
        }
    }

    /// An offset is computed from a value that is not known: where the machine goes from here on is not known either.
    fn unknown_value(&mut self, offset: &str, at: At, codes: (i64, i64)) {
        let what = format!("{offset} is set from a value, or at a position, that is not known");
        let range = self.code_range(at, b'G', |code| (codes.0..=codes.1).contains(&code));
        self.fault(at, range, FaultKind::NotModelled { what });
    }

    /// Reports compensation that begins with a radius of zero, because the tool is not declared.
    pub(super) fn radius_unset(&mut self, state: &State, at: At) {
        let on = state.side != trunnion_ngc::Side::Off;
        let was = std::mem::replace(&mut self.calls.compensated, on);
        if on
            && !was
            && super::modal::lacks_radius(state)
            && !std::mem::replace(&mut self.core.compensation_reported, true)
        {
            let d = self.code_range(at, b'D', |_| true);
            let tool = if d == TextRange::default() {
                let name = self.core.tools.known_name();
                name.unwrap_or_else(|| "the tool".to_owned())
            } else {
                self.program.text(d).into_owned()
            };
            let range = self.code_range(at, b'G', |code| (410..=422).contains(&code));
            self.fault(at, range, FaultKind::radius_lacks(&tool));
        }
    }

    /// Says whether the zero point was set where the machine stands.
    pub(super) fn zero_set_here(&mut self) {
        let here = self.calls.set_here || self.calls.g92 != [0.0; 9];
        self.core.state.zero.set_here(here);
    }

    pub(super) fn work_offset(&mut self, index: i32, offset: &Pose, at: At, state: &State) {
        let Some(name) = usize::try_from(index - 1).ok().and_then(|index| SYSTEMS.get(index)) else {
            return;
        };
        let changed = self.core.state.zero.offset() != Some(*name);
        let declared = self
            .core
            .setup
            .work_offsets
            .iter()
            .any(|known| known.name.eq_ignore_ascii_case(name));
        let zero = offset.iter().all(|value| *value == 0.0);
        let undeclared = if declared {
            0
        } else {
            // what was taken from the position of the machine is as undeclared as this position
            let from_position = state
                .set_from_position
                .get(index.unsigned_abs() as usize)
                .copied()
                .unwrap_or_default();
            let known = if changed { 0 } else { !self.core.state.zero.undeclared() };
            let rests = from_position & !known;
            self.calls.set_here = rests != 0;
            self.zeros_without_value(index, offset) | rests
        };
        self.zero_set_here();
        self.core.state.zero.choose(Some((*name).into()), undeclared);
        let begun = self.core.last_content.is_some();
        if begun && changed && zero && !declared && self.core.offsets_reported.first(name) {
            let name = (*name).to_owned();
            let range = self.code_range(at, b'G', |code| (540..=593).contains(&code));
            self.fault(at, range, FaultKind::WorkOffsetUnset { name });
        }
    }

    /// Axes of a work offset that is not known to be declared: the control does not distinguish a zero that was set from one that was never
    /// set.
    fn zeros_without_value(&self, index: i32, offset: &Pose) -> u16 {
        let first = FIRST_SYSTEM + 20 * (index - 1).max(0).unsigned_abs();
        let given = |axis: usize| {
            let number = first + axis as u32;
            let variables = &self.core.setup.variables;
            offset[axis] != 0.0
                || variables
                    .iter()
                    .any(|(known, value)| *known == number && value.is_some())
        };
        (0..offset.len())
            .filter(|axis| !given(*axis))
            .fold(0, |mask, axis| mask | 1 << axis)
    }
}

/// Whether a row of the tool table has no offset along Z.
fn is_zero_row(state: &State, number: i32) -> bool {
    let rows = || (1..).map_while(|row| state.tools.get(row));
    rows()
        .find(|row| row.number == number)
        .is_none_or(|row| row.offset[2] == 0.0)
}
