//! TOOL CALL and TOOL DEF.
use super::Klartext;
use super::reason::Reason;
use super::values::Value;
use super::words::{Said, Words};
use crate::arc::plane_axes;
use crate::core::Report;
use crate::tools::Chosen;
use crate::{FaultKind, LengthOf, Position, Refusal, TcpMistake, Tool, ToolLength};
use trunnion_dialect::Plane;
use trunnion_syntax::TextRange;

impl Klartext<'_> {
    pub(crate) fn tool_block(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        self.flush(report);
        let Some(kind) = words.next() else {
            return Self::rejected(Refusal::MissingWord, "TOOL needs CALL or DEF", report);
        };
        if kind.is("DEF") {
            self.tool_definition(kind.value, words, report);
        } else if kind.is("CALL") {
            self.tool_call(kind.value, words, report);
        } else {
            Self::rejected(Refusal::Syntax, "TOOL needs CALL or DEF", report);
        }
    }

    /// TOOL DEF 5: prepares the tool; with L and R it defines one.
    fn tool_definition(&mut self, number: Said<'_>, words: &mut Words<'_>, report: &mut Report<'_>) {
        let number = match number {
            Said::Nothing => None,
            said => {
                let number = self.said(said, report);
                Self::from_zero("the number of the tool", number, report).filter(|number| number.fract() == 0.0)
            }
        };
        let number = number.map(|number| number as u32);
        let (mut length, mut radius) = (None, None);
        for word in words.by_ref() {
            match word.name() {
                b"L" => length = self.said(word.value, report),
                b"R" => radius = self.said(word.value, report),
                _ => {}
            }
        }
        match (number, length.or(radius)) {
            (Some(number), Some(_)) => {
                let unit = self.core.state.coordinates.unit_mm();
                let tool = Tool {
                    number,
                    shape: None,
                    diameter_mm: radius.map(|radius| 2.0 * radius * unit),
                    length_mm: length.map(|length| length * unit),
                    holder_mm: None,
                };
                self.compare_with_settings(&tool, report);
                self.core.tools.define(tool);
            }
            (number, None) => self.core.state.tool.prepare(number),
            _ => {}
        }
    }

    /// A number that has no values below 0: such a one is refused, and what the control has then is not known.
    pub(super) fn from_zero(name: &str, value: Value, report: &mut Report<'_>) -> Value {
        let is_negative = value.is_some_and(|value| value < 0.0);
        if is_negative {
            let message = format!("{name} is negative: it must be 0 or more");
            Self::rejected(Refusal::Number, message, report);
        }
        value.filter(|_| !is_negative)
    }

    /// The control uses what the program defines; where the settings say otherwise, one of both is wrong.
    fn compare_with_settings(&self, tool: &Tool, report: &mut Report<'_>) {
        let Some(known) = self.core.tools.data(Some(tool.number)) else {
            return;
        };
        let pairs = [
            (false, tool.length_mm, known.length_mm),
            (true, tool.diameter_mm, known.diameter_mm),
        ];
        for (is_diameter, program, settings) in pairs {
            if let (Some(program_mm), Some(settings_mm)) = (program, settings)
                && program_mm != settings_mm
            {
                let kind = FaultKind::ToolDefinedTwice {
                    tool: tool.number,
                    is_diameter,
                    program_mm,
                    settings_mm,
                };
                report.fault(TextRange::default(), kind);
            }
        }
    }

    /// TOOL CALL 5 Z S2000 F400 DL+0,1: without a number the values change for the tool in use.
    fn tool_call(&mut self, number: Said<'_>, words: &mut Words<'_>, report: &mut Report<'_>) {
        let chosen = match number {
            Said::Nothing => {
                let mut ahead = words.clone();
                match ahead.next().map(|word| word.value) {
                    Some(Said::Text(name)) => {
                        *words = ahead;
                        Some(Chosen::Named(String::from_utf8_lossy(name).as_ref().into()))
                    }
                    Some(Said::Parameter(..)) => {
                        *words = ahead;
                        Some(Chosen::Unread)
                    }
                    _ => None,
                }
            }
            said => {
                let value = self.said(said, report);
                let value = Self::from_zero("the number of the tool", value, report);
                // 5.1 is an index of tool 5, whose data are its own
                Some(match value {
                    Some(number) if number.fract() == 0.0 => Chosen::Number(number as u32),
                    Some(number) => Chosen::Named(number.to_string().into()),
                    None => Chosen::Unread,
                })
            }
        };
        let (mut axis, mut delta, mut feed) = (None, None, None);
        let mut deltas = chosen.is_none() && self.memory.deltas;
        for word in words.by_ref() {
            match word.name() {
                b"X" => axis = Some(Plane::Yz),
                b"Y" => axis = Some(Plane::Zx),
                b"Z" => axis = Some(Plane::Xy),
                b"S" => {
                    let rpm = self.said(word.value, report);
                    let rpm = Self::from_zero("S", rpm, report);
                    self.core.state.spindle.set_rpm(rpm);
                }
                b"VC" => self.core.state.spindle.set_rpm(None),
                b"F" if word.value == Said::Nothing => {}
                b"F" => {
                    let said = self.said(word.value, report);
                    feed = Some(Self::from_zero("F", said, report));
                }
                b"FU" | b"FZ" => {
                    let what = "FU or FZ of TOOL CALL: the feed until the next F";
                    self.not_modelled_once(what, report);
                    feed = Some(None);
                }
                b"DL" => {
                    delta = Some(self.said(word.value, report));
                    deltas |= delta != Some(Some(0.0));
                }
                b"DR" | b"DR2" => deltas |= word.value != Said::Number(0.0),
                _ => {}
            }
        }
        self.memory.deltas = deltas;
        match axis {
            Some(plane) => {
                self.core.state.coordinates.set_plane(plane);
                self.memory.has_tool_axis = true;
                self.compare_tool_axis(plane, report);
            }
            None if chosen.is_some() && !self.memory.has_tool_axis => {
                self.not_modelled_once("TOOL CALL without the tool axis: that of the previous program", report);
            }
            None => {}
        }
        if let Some(feed) = feed {
            self.memory.tool_feed = feed.map(|feed| feed * self.core.state.feed.unit_mm());
            self.memory.tool_feed_unread = feed.is_none();
            // it holds until the next F in a positioning block or a TOOL CALL (HEIDENHAIN TNC 430 user's manual, p. 108)
            self.core.state.feed.set(self.memory.tool_feed);
            self.core.feed_unread = feed.is_none();
        }
        if let Some(chosen) = chosen {
            self.change_tool(chosen, delta.unwrap_or(Some(0.0)), report);
        } else if let Some(delta) = delta {
            self.change_length(delta);
        }
    }

    /// The tool axis is the direction in which the control takes the length of the tool. Where the spindle of the machine does not point along it, an
    /// angle head may be in it, or the axis is wrong.
    fn compare_tool_axis(&mut self, plane: Plane, report: &mut Report<'_>) {
        let axis = plane_axes(plane)[2];
        let along = self.core.setup.length_along();
        if !self.core.setup.control.axes_declared || along[axis] != 0.0 {
            return self.found(Reason::ToolAxis);
        }
        let what = format!(
            "TOOL CALL with tool axis {}: the spindle of the machine does not point along it",
            char::from(crate::AXIS_LETTERS[axis])
        );
        self.not_modelled_once(&what, report);
        self.lose(Reason::ToolAxis);
    }

    /// TOOL CALL DL+0,1: the same tool, measured otherwise. The machine stays where it is, so the tip is somewhere else along the tool.
    fn change_length(&mut self, delta: Option<f64>) {
        let unit = self.core.state.coordinates.unit_mm();
        let of = LengthOf::Tool(self.core.state.tool.number());
        let before = self.core.state.length;
        self.set_length_and_delta(delta.map(|delta| delta * unit), of);
        if self.is_plain() {
            self.stands_at(&Position::default(), &before);
        } else {
            self.core.forget_linear();
        }
    }

    /// Whether the length of the tool acts along an axis of the coordinates.
    fn is_plain(&self) -> bool {
        !self.core.state.tool_axis.tcp() && self.memory.frames.tilt.is_none()
    }

    fn change_tool(&mut self, chosen: Chosen, delta: Option<f64>, report: &mut Report<'_>) {
        if self.core.state.tool_axis.tcp() {
            report.fault(TextRange::default(), FaultKind::TcpState(TcpMistake::ToolChange));
        }
        // the change may move the linear axes; M128 ends with it
        let plain = self.is_plain();
        let declared = self.core.setup.control.tool_change.filter(|_| plain);
        let before = self.core.state.length;
        self.load_tool(chosen, delta, report);
        self.core.relocate(declared.as_ref());
        match declared {
            Some(place) => self.stands_at(&place, &before),
            None => self.core.forget_linear(),
        }
    }

    fn load_tool(&mut self, chosen: Chosen, delta: Option<f64>, report: &mut Report<'_>) {
        // whether the spindle stops where the tool is in it already is left to the machine
        let stays = matches!(chosen, Chosen::Number(_) | Chosen::Named(_)) && *self.core.tools.in_spindle() == chosen;
        if !stays {
            self.core.state.spindle.switch(false);
        }
        let number = if let Chosen::Number(number) = chosen {
            Some(number)
        } else {
            None
        };
        self.core.tools.prepare(chosen);
        self.core.tools.load_prepared();
        self.core.state.tool.load(number);
        self.core.state.tool.prepare(number);
        self.core.merge_tool();
        self.memory.tool_length = None;
        if number == Some(0) {
            self.found(Reason::Length);
            self.core.state.length.set(None, LengthOf::Nothing);
            return;
        }
        let length = self.core.state.tool.data().and_then(|tool| tool.length_mm);
        self.memory.tool_length = length;
        let unit = self.core.state.coordinates.unit_mm();
        let name = self.core.tools.name();
        if length.is_none() && self.core.tools.first_report_of_length(&name) {
            report.fault(TextRange::default(), FaultKind::ToolLengthUnset { tool: name });
        }
        self.set_length_and_delta(delta.map(|delta| delta * unit), LengthOf::Tool(number));
    }

    /// The tool's own length and DL, mm, are in effect. A length that nothing declares is unknown, and DL comes on top of it.
    fn set_length_and_delta(&mut self, delta: Option<f64>, of: LengthOf) {
        let length = &mut self.core.state.length;
        match (self.memory.tool_length, delta) {
            (Some(known), Some(delta)) => length.set_declared(Some(known + delta), of),
            (None, Some(delta)) => length.set_undeclared(delta, of),
            (_, None) => length.set_declared(None, of),
        }
        match delta {
            Some(_) => self.found(Reason::Length),
            None => self.lose(Reason::Length),
        }
    }

    /// The axes that have a value are at that place in machine coordinates, the others stay; the tool may be longer or shorter than before.
    fn stands_at(&mut self, place: &Position, before: &ToolLength) {
        let zero = self.core.state.zero.values();
        let length = self.core.state.length;
        let grows = length.mm().unwrap_or(0.0) - before.mm().unwrap_or(0.0);
        let unclear = length.is_undeclared() || before.is_undeclared();
        let along = self.core.setup.length_along();
        for axis in 0..3 {
            let position = &mut self.core.state.position;
            match place.get(axis) {
                Some(value) => position.set(axis, value - zero[axis] - length.mm().unwrap_or(0.0) * along[axis]),
                None if unclear && along[axis] != 0.0 => position.forget(axis),
                None => position.values[axis] -= grows * along[axis],
            }
        }
        if self.core.state.zero.is_lost() {
            self.core.forget_linear();
        }
    }
}
