//! Work offsets, tool lengths and cutting edges, and their effect on the programmed position.
use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::frames::OffsetValues;
use crate::iso::Iso;
use crate::tools::Chosen;
use crate::words::{WordValue, Words};
use crate::{FaultKind, LengthOf, Refusal, Tool, Undeclared};
use std::sync::Arc;
use trunnion_dialect::Action;
use trunnion_syntax::TextRange;

/// When the work offset in effect got values that do not act yet for certain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rewritten {
    /// In this block: whether its own code comes first is not known.
    Here,
    Before,
}

impl<'d> Iso<'d> {
    /// Selects a work offset by the code's own name, with P where the code reads one (G54.1 P3).
    pub(crate) fn work_offset(&mut self, found: &Found<'_>, words: &Words, report: &mut Report<'_>) {
        let mut name = found.code.id.clone();
        if let Some(p) = words
            .p
            .index()
            .filter(|_| found.code.words.iter().any(|word| word == "P"))
        {
            // G54 P5 is G54.1 P5 (Series 30i operator's manual, additional workpiece coordinate systems)
            let code = self
                .additional_offsets()
                .filter(|code| code.split('.').next() == Some(&name));
            let code = code.unwrap_or(&name);
            // Series 30i operator's manual, additional workpiece coordinate systems: P1 to P48, or to P300; Haas 96-8210, G154
            let most = if code == "G154" { 99 } else { 300 };
            if !(1..=most).contains(&p) {
                let message = format!("{code} P{p}: P names an additional work offset, 1 to {most}");
                let kind = FaultKind::Rejected {
                    refusal: Refusal::Other,
                    message,
                    alarm: None,
                };
                report.fault(found.range, kind);
                self.set_zero(None, OffsetValues::default());
                self.core.forget_position();
                return;
            }
            name = format!("{code} P{p}");
        }
        let zero = self.offset_values(&name);
        if zero.is_none() && self.core.offsets_reported.first(&name) {
            report.fault(found.range, FaultKind::WorkOffsetUnset { name: name.clone() });
        }
        self.set_zero(Some(name.into()), zero.unwrap_or_default());
    }

    /// Okuma G15 H and G16 H: the work coordinate system of that number, named as it is written: `G15 H1`. G16 holds for its block. What H0
    /// means with G15 is not stated by a source; with G16 it is the machine's.
    pub(crate) fn work_system(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let once = found.code.action == Action::WorkSystemOnce;
        let number = match words.length_offset.index() {
            Some(0) if once => {
                block.machine_coordinates = true;
                return;
            }
            Some(number @ 1..) => number,
            _ => {
                let h = match words.length_offset {
                    WordValue::Nothing => "without H".to_owned(),
                    WordValue::Number(number) => format!("H{}", number.value),
                    _ => "H with a value that is unknown".to_owned(),
                };
                let what = format!("{} {h}: which coordinate system it is", found.code.id);
                report.fault(found.range, FaultKind::NotModelled { what });
                self.core.unknown.begin(found.code, true);
                self.core.unknown.turns_axes(found.code);
                self.core.forget_position();
                return;
            }
        };
        if once {
            let zero = &self.core.state.zero;
            self.memory.zero_after = Some((zero.offset_name(), self.memory.frames.selected, zero.undeclared()));
        }
        let name = format!("G15 H{number}");
        let zero = self.offset_values(&name);
        if zero.is_none() && self.core.offsets_reported.first(&name) {
            report.fault(found.range, FaultKind::WorkOffsetUnset { name: name.clone() });
        }
        self.set_zero(Some(name.into()), zero.unwrap_or_default());
    }

    /// After the block of G16 the system of before is in effect again.
    pub(crate) fn restore_zero(&mut self) {
        if let Some((name, values, undeclared)) = self.memory.zero_after.take() {
            let zero = &self.core.state.zero;
            let other = zero.offset() != name.as_deref();
            let unclear = if other { zero.undeclared() | undeclared } else { 0 };
            self.core.state.zero.choose(name, undeclared);
            self.memory.frames.selected = values;
            self.refresh_zero();
            // how far the two systems are apart is not declared
            self.core.state.position.known &= !unclear;
        }
    }

    /// Selects a zero point; shifts by the program (G52, G92) are added to it.
    pub(crate) fn set_zero(&mut self, name: Option<Arc<str>>, zero: OffsetValues) {
        if self.memory.offset_open == Some(Rewritten::Before) {
            self.memory.offset_open = None;
        }
        self.frames_move(|iso| {
            iso.core.state.zero.choose(name, Undeclared::ALL_ZEROS & !zero.known);
            iso.memory.frames.selected = zero.values;
            iso.refresh_zero();
        });
    }

    /// Selects no work offset (G500): the rest of the zero point is its base, which may be declared under that name.
    pub(crate) fn no_work_offset(&mut self, name: &str) {
        let base = self.offset_values(name).unwrap_or_default();
        self.set_zero(None, base);
    }

    /// The machine stays where it is, so the programmed position moves against the zero point.
    pub(crate) fn move_zero(&mut self, zero: [f64; 9]) {
        for ((value, old), new) in self
            .core
            .state
            .position
            .values
            .iter_mut()
            .zip(self.core.state.zero.values())
            .zip(zero)
        {
            *value += old - new;
        }
        if self.memory.frames.tilt.is_some() && zero != self.core.state.zero.values() {
            self.core.forget_linear();
        }
        self.core.state.zero.set(zero);
    }

    /// G43 H: the length of the tool of that number; without H that of the tool in use.
    pub(crate) fn length_on(&mut self, offset: WordValue, range: TextRange, report: &mut Report<'_>) {
        if self.core.dialect.quirks.user_task() && !offset.is_given() {
            return self.unstated_length("a length offset without H", range, report);
        }
        if let Some(number) = offset.index() {
            self.memory.length_offset = Some(number);
        }
        let mut wear = 0.0;
        let (tool, key, of) = match (offset, self.memory.length_offset) {
            (WordValue::Nothing, None) => (
                self.core.state.tool.data(),
                self.core.tools.name(),
                LengthOf::Tool(self.core.state.tool.number()),
            ),
            (WordValue::Nothing | WordValue::Number(_), Some(0)) => {
                return self.set_length(Some(0.0), LengthOf::Nothing);
            }
            (WordValue::Nothing | WordValue::Number(_), Some(number)) => {
                let of = LengthOf::Tool(Some(number));
                if let Some(length) = self.written_length(number) {
                    return self.set_length(Some(length), of);
                }
                wear = self.tool_offset(number).map_or(0.0, |offset| offset.length_wear);
                (self.core.tools.data(Some(number)), format!("H{number}"), of)
            }
            _ => (None, "H".to_owned(), LengthOf::Other),
        };
        self.take_length(tool, (&key, of), range, report);
        if wear != 0.0 && self.core.state.length.is_undeclared() {
            // what the program has written comes on top of what nothing declares
            self.set_length(Some(wear), of);
            self.core.state.length.set_undeclared(wear, of);
        }
    }

    /// What no source states of the length offsets of an Okuma, and G43 of a Fanuc before the first H: positions are unknown until the next H.
    pub(crate) fn unstated_length(&mut self, what: &str, range: TextRange, report: &mut Report<'_>) {
        report.fault(range, FaultKind::NotModelled { what: what.to_owned() });
        self.length_after_tip_control();
    }

    /// H without a code that reads it: the number changes while the compensation is on, and else waits for it (Fanuc Series 30i
    /// operator's manual, tool length offset: H is modal).
    pub(crate) fn length_word_alone(&mut self, codes: &[Found<'_>], words: &Words, report: &mut Report<'_>) {
        let reads = |found: &Found<'_>| found.code.words.iter().any(|word| word == "H");
        if codes.iter().any(reads) || words.flow {
            return;
        }
        let range = words
            .length_offset
            .number()
            .map_or(TextRange::default(), |number| number.range);
        if self.core.dialect.quirks.user_task() {
            return self.unstated_length("H without a code that reads it", range, report);
        }
        if self.core.state.length.mm().is_some() {
            self.note_length();
            self.length_on(words.length_offset, range, report);
        } else if let Some(number) = words.length_offset.index() {
            self.memory.length_offset = Some(number);
        }
    }

    /// The length of an offset number where the program has written any part of it.
    fn written_length(&self, number: u32) -> Option<f64> {
        let offset = self.tool_offset(number)?;
        let declared = || self.core.tools.data(Some(number)).and_then(|tool| tool.length_mm);
        Some(offset.length.or_else(declared)? + offset.length_wear)
    }

    /// D: the active cutting edge. Edge 1 has the tool's declared length, 0 none.
    pub(crate) fn edge_word(&mut self, edge: WordValue, report: &mut Report<'_>) {
        let range = edge.number().map_or(TextRange::default(), |number| number.range);
        self.memory.edge = edge.index();
        match edge.index() {
            Some(0) => self.edge_length(edge.index(), range, report),
            // the tool is chosen, but not yet in the spindle: its length comes with it
            _ if self.core.tools.waits_for_change() => {}
            edge => self.edge_length(edge, range, report),
        }
    }

    /// A feed motion while T has selected the first tool and no code has loaded it: if T alone changes tools the length of the tool is active,
    /// otherwise it is not (machine data 22550 TOOL_CHANGE_MODE of a Sinumerik 840D sl: trade knowledge, not read in a manual).
    pub(crate) fn tool_never_changed(&mut self, words: &Words, report: &mut Report<'_>) {
        let waits = *self.core.tools.in_spindle() == Chosen::Nothing
            && self.core.dialect.quirks.edge_at_tool_change
            && self.core.tools.waits_for_change()
            && self.memory.edge != Some(0)
            && self.core.state.length.mm().is_none();
        if waits && !self.memory.tool_never_changed {
            self.memory.tool_never_changed = true;
            let what = "the length of a tool that T selects and no M6 loads (machine data 22550 decides whether T alone changes tools)";
            let kind = FaultKind::NotModelled { what: what.to_owned() };
            report.fault(words.first.unwrap_or_default(), kind);
        }
    }

    pub(crate) fn edge_length(&mut self, edge: Option<u32>, range: TextRange, report: &mut Report<'_>) {
        self.lengths_move(|iso| iso.take_edge(edge, range, report));
    }

    fn take_edge(&mut self, edge: Option<u32>, range: TextRange, report: &mut Report<'_>) {
        let name = match (&self.core.tools.in_spindle(), edge) {
            (Chosen::Nothing, Some(1)) => "D1".to_owned(),
            _ => self.core.tools.name(),
        };
        match edge {
            Some(0) => self.set_length(None, LengthOf::Nothing),
            Some(1) => {
                let of = LengthOf::Tool(self.core.state.tool.number());
                self.take_length(self.core.state.tool.data(), (&name, of), range, report);
            }
            Some(edge) => self.take_length(None, (&format!("{name} D{edge}"), LengthOf::Other), range, report),
            None => self.take_length(None, (&format!("{name} D"), LengthOf::Other), range, report),
        }
    }

    /// Makes a tool's length active, with its name and its tool; if it is not declared it is zero, reported once.
    pub(crate) fn take_length(
        &mut self,
        tool: Option<Tool>,
        (key, of): (&str, LengthOf),
        range: TextRange,
        report: &mut Report<'_>,
    ) {
        let length = tool.and_then(|tool| tool.length_mm);
        if length.is_none() && self.core.tools.first_report_of_length(key) {
            report.fault(range, FaultKind::ToolLengthUnset { tool: key.to_owned() });
        }
        self.set_length(Some(length.unwrap_or(0.0)), of);
        self.core.state.length.set_declared(length, of);
    }

    /// The machine stays where it is, so the programmed position moves: along the tool at home while the axes are joints; anywhere
    /// under tool centre point control.
    pub(crate) fn set_length(&mut self, length: Option<f64>, of: LengthOf) {
        let change = length.unwrap_or(0.0) - self.core.state.length.mm().unwrap_or(0.0);
        self.core.state.length.set(length, of);
        if change != 0.0 {
            if self.core.state.tool_axis.tcp() {
                self.core.forget_linear();
            } else {
                let along = self.core.setup.length_along();
                for (value, along) in self.core.state.position.values.iter_mut().zip(along) {
                    *value -= change * along;
                }
            }
        }
        if !matches!(of, LengthOf::Offset(_)) {
            self.turret_shifts([0.0; 9]);
        }
    }

    /// The offset of a lathe's tool shifts the zero point.
    pub(crate) fn turret_shifts(&mut self, by: [f64; 9]) {
        if self.memory.frames.turret != by {
            self.memory.frames.turret = by;
            self.refresh_zero();
        }
    }
}
