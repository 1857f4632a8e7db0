//! Cycles that act where they are defined: datum shift 7, preset 247, mirror 8, rotation 10, working plane 19, dwell 9.
//!
//! An axis that a datum shift leaves out keeps its shift; mirror without axes, rotation by 0 and scaling by 1 end them (TNC 640 cycle
//! manuals, coordinate transformations). Shifts inside a tilted plane are in `plane_shift`.
use super::path_words::PathWords;
use super::reason::Reason;
use super::words::{Said, Words};
use super::{Klartext, values::Value};
use crate::core::{LINEAR, ROTARY, Report};
use crate::{Feed, MotionKind, Refusal, Undeclared};
use trunnion_syntax::TextRange;

impl Klartext<'_> {
    /// Coordinates say nothing from here on, for a reason.
    pub(crate) fn lose(&mut self, reason: Reason) {
        self.memory.lost.add(reason);
        self.memory.shifted = 0;
        self.memory.shift_unknown |= reason == Reason::Datum;
        self.core.forget_linear();
        self.core.state.zero.lose(true);
    }

    /// A datum is unknown in all axes.
    pub(super) fn lose_datum(&mut self) {
        self.turned(0, ROTARY);
        self.lose(Reason::Datum);
    }

    /// Rotary axes whose zero is unknown by a shift (0) or by a preset (1).
    fn turned(&mut self, by: usize, axes: u16) {
        self.memory.turned[by] = axes;
        let [shift, preset] = self.memory.turned;
        self.core.state.position.known &= !(self.core.turned ^ (shift | preset));
        self.core.turned = shift | preset;
    }

    /// The reason has ended.
    pub(crate) fn found(&mut self, reason: Reason) {
        if self.memory.lost.has(reason) {
            self.memory.lost.remove(reason);
            self.core.forget_linear();
            self.core.state.zero.lose(self.memory.lost.any());
        }
    }

    /// CYCL DEF and CYCL CALL.
    pub(crate) fn cycle_block(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        let Some(kind) = words.next() else {
            return Self::rejected(Refusal::MissingWord, "CYCL needs DEF or CALL", report);
        };
        if kind.is("CALL") {
            return self.call_cycle(words, report);
        }
        // `7.1`: the number of the cycle, and that of its line
        let start = kind.start;
        let text = words.text.get(start..).unwrap_or_default();
        let digits = text.iter().position(u8::is_ascii_digit).filter(|_| kind.is("DEF"));
        let Some(first) = digits else {
            return Self::rejected(Refusal::Syntax, "CYCL DEF needs the number of its cycle", report);
        };
        let number = text[first..]
            .iter()
            .take_while(|byte| byte.is_ascii_digit() || **byte == b'.');
        let length = number.count();
        let written = String::from_utf8_lossy(&text[first..first + length]).into_owned();
        let (cycle, line) = written
            .split_once('.')
            .map_or((written.as_str(), None), |(a, b)| (a, Some(b)));
        let (Ok(cycle), Ok(line)) = (cycle.parse::<u32>(), line.unwrap_or("0").parse::<u32>()) else {
            return Self::rejected(Refusal::Number, "CYCL DEF needs the number of its cycle", report);
        };
        words.at = start + first + length;
        self.flush(report);
        let opened = self.memory.opened_cycle.replace(cycle);
        if line != 0 && opened != Some(cycle) {
            let message = format!("CYCL DEF {cycle}.{line} needs CYCL DEF {cycle}.0 before it");
            Self::rejected(Refusal::Syntax, message, report);
        }
        match cycle {
            7 => self.datum_shift(line, words, report),
            8 => self.mirror(line, words, report),
            9 => self.dwell_cycle(line, words, report),
            10 => self.rotation(line, words, report),
            11 => self.scaling(line, words, report),
            19 => self.working_plane(line, words, report),
            247 => self.preset(words, report),
            26 => self.axis_scaling(line, words, report),
            27 | 28 | 29 | 39 => {
                if line == 0 {
                    Self::not_modelled(format!("cycle {cycle}"), report);
                    self.lose(Reason::Shape);
                }
            }
            // tolerance, oriented stop, contour data
            13 | 14 | 20 | 32 | 270..=272 => {}
            220 | 221 => self.pattern_cycle(cycle, words, report),
            _ => {
                if line == 0 && !waits_for_its_call(cycle) {
                    Self::not_modelled(format!("cycle {cycle}: whether it acts where it is defined"), report);
                    self.core.forget_position();
                    self.lose(Reason::Other);
                }
                self.define_cycle(cycle, line, words, report);
            }
        }
    }

    /// Axis words of a line.
    fn axes_of(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) -> PathWords {
        self.path_words(words, report)
    }

    /// 7.1 X.. and so on; #n: from a table.
    fn datum_shift(&mut self, line: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        if line == 0 {
            return;
        }
        if words.takes(b'#') {
            Self::not_modelled("cycle 7: a datum from a table", report);
            return self.lose_datum();
        }
        let found = self.axes_of(words, report);
        if found.no_number {
            return self.lose_datum();
        }
        if found.given == 0 {
            return;
        }
        self.shift_datum("cycle 7", &found, report);
    }

    /// Axes that are not given keep their shift.
    pub(super) fn shift_datum(&mut self, name: &str, found: &PathWords, report: &mut Report<'_>) {
        let unit = self.core.state.coordinates.unit_mm();
        let mut local = self.memory.frames.local;
        let mut unknown = 0;
        for (axis, shift) in local.iter_mut().enumerate() {
            let bit = 1 << axis;
            if found.given & bit == 0 {
                continue;
            }
            let scale = if LINEAR & bit != 0 { unit } else { 1.0 };
            match found.values[axis] {
                Some(value) if found.incremental & bit != 0 => *shift += value * scale,
                Some(value) => *shift = value * scale,
                None => unknown |= bit,
            }
        }
        // where several shifts are possible the same value again is not the same shift
        let shifts = found.given & 7 != 0;
        let zero = local[..3] == [0.0; 3];
        if shifts && local[..3] != self.memory.frames.local[..3] {
            self.scaled_system_shifts();
        }
        let turned = self.memory.turned[0] & !(found.given & !found.incremental) | unknown & ROTARY;
        self.turned(0, turned);
        if unknown != 0 {
            // the value was reported; the zero of a rotary axis with a value is known
            self.memory.frames.local[3..6].copy_from_slice(&local[3..6]);
            self.refresh_zero();
            return self.lose(Reason::Datum);
        }
        if shifts && !zero && self.is_shaped() {
            self.not_modelled_once(&format!("{name} in a turned, mirrored or scaled system"), report);
            self.memory.frames.local = local;
            self.refresh_zero();
            let unknown = self.memory.shift_unknown;
            self.lose(Reason::Datum);
            // the shift itself is known: taking it back ends it
            self.memory.shift_unknown = unknown;
            return;
        }
        let tilted = self.is_tilted();
        if shifts && tilted && !self.shifts_in_plane() {
            let what = "in a tilted plane, with a shift from before the plane: which of both it replaces";
            self.not_modelled_once(&format!("{name} {what}"), report);
            self.memory.frames.local = local;
            self.refresh_zero();
            return self.lose(Reason::Inside);
        }
        self.memory.frames.local = local;
        let level = shifts && !tilted && self.memory.frames.tilt.is_some();
        self.memory.level_shift = !zero && (level || self.memory.level_shift);
        self.memory.shifted |= found.given & !found.incremental & 7;
        self.memory.shift_unknown &= self.memory.shifted != 7;
        if (zero || self.memory.shifted == 7) && !self.memory.shift_unknown {
            self.found(Reason::Datum);
            if !tilted {
                self.found(Reason::Inside);
            }
        }
        self.refresh_zero();
    }

    /// The machine stays where it is, so the position moves against the zero point.
    pub(crate) fn refresh_zero(&mut self) {
        let mut zero = self.memory.frames.selected;
        for (axis, value) in zero.iter_mut().enumerate() {
            *value += self.memory.frames.outer_local(axis);
        }
        self.shift_plane();
        let before = self.core.state.zero.values();
        if zero == before {
            return;
        }
        let plain = !self.is_tilted() && self.memory.frames.shape.is_identity();
        for (value, (old, new)) in self.core.state.position.values.iter_mut().zip(before.iter().zip(zero)) {
            *value += old - new;
        }
        if !plain {
            self.core.forget_linear();
        }
        self.core.state.zero.set(zero);
        let position = self.core.state.position;
        self.memory.frames.refresh(&position);
        self.memory.pole = [None; 3];
    }

    /// CYCL DEF 247 Q339=n: a preset of the table.
    fn preset(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        let number = self.parameter_of(339, words, report);
        let Some(number) = number
            .flatten()
            .filter(|number| number.fract() == 0.0 && *number >= 0.0)
        else {
            Self::not_modelled("cycle 247: which preset", report);
            self.turned(1, ROTARY);
            return self.lose(Reason::Preset);
        };
        self.scaled_preset_changes();
        self.shifted_preset_changes(report);
        self.found(Reason::Preset);
        self.turned(1, 0);
        let name = format!("preset {number}");
        let declared = self.core.setup.work_offset(&name).map(|offset| offset.values);
        if declared.is_none() && self.core.offsets_reported.first(&name) {
            let kind = crate::FaultKind::WorkOffsetUnset { name: name.clone() };
            report.fault(TextRange::default(), kind);
        }
        let undeclared = if declared.is_some() { 0 } else { Undeclared::ALL_ZEROS };
        // the machine stays, so nothing is known of the position in the new system
        let same = self.core.state.zero.offset() == Some(name.as_str());
        self.core.state.zero.choose(Some(name.into()), undeclared);
        self.memory.frames.selected = declared.unwrap_or_default();
        if !same && declared.is_none() {
            self.core.forget_linear();
        }
        self.refresh_zero();
    }

    /// Whether a shift, a mirror image and a rotation stay when a preset is chosen is not taken from a source.
    fn shifted_preset_changes(&mut self, report: &mut Report<'_>) {
        let shape = &self.memory.frames.shape;
        let (turned, mirrored) = (shape.rotation.is_some(), shape.mirror != [None; 3]);
        let shifted = self.memory.frames.local.iter().any(|shift| *shift != 0.0);
        for (holds, reason, what) in [
            (
                shifted,
                Reason::Datum,
                "cycle 247 after cycle 7: whether the shift stays (reset it before)",
            ),
            (
                turned,
                Reason::Rotation,
                "cycle 247 after cycle 10: whether the rotation stays (reset it before)",
            ),
            (
                mirrored,
                Reason::Mirror,
                "cycle 247 after cycle 8: whether the mirror image stays (reset it before)",
            ),
        ] {
            if holds {
                self.not_modelled_once(what, report);
                self.lose(reason);
            }
        }
    }

    /// The value of `Qn=` among the words; `None`: it is not there.
    pub(crate) fn parameter_of(&mut self, number: u32, words: &Words<'_>, report: &mut Report<'_>) -> Option<Value> {
        let mut ahead = words.clone();
        while let Some(word) = ahead.next() {
            let is = matches!(word.value, Said::Parameter(_, found) if found.number == number);
            if is && word.name().is_empty() && ahead.takes(b'=') {
                ahead.blanks();
                let said = ahead.value();
                return Some(self.said(said, report));
            }
        }
        None
    }

    /// 9.1 DWELL 5: the last number of the line, seconds.
    fn dwell_cycle(&mut self, line: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        if line == 0 {
            return;
        }
        let said = words
            .map(|word| word.value)
            .filter(|said| !matches!(said, Said::Nothing | Said::Sign(_)))
            .last();
        let seconds = said.and_then(|said| self.said(said, report));
        let seconds = Self::from_zero("the time of a dwell", seconds, report);
        self.dwell(seconds, report);
    }

    /// A dwell where the tool is.
    pub(crate) fn dwell(&mut self, seconds: Option<f64>, report: &mut Report<'_>) {
        let position = self.core.state.position;
        let orientation = self.core.held_orientation();
        let kind = MotionKind::Dwell(seconds);
        let motion = self
            .core
            .motion_in_frame(kind, [position; 2], orientation, Feed::Unknown, report);
        self.emit(&motion, report);
    }

    /// Any other cycle waits for its call.
    fn define_cycle(&mut self, cycle: u32, line: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        // a new cycle ends M89
        self.memory.runs_after_each = false;
        self.memory.cycle_unit = self.core.state.coordinates.unit_mm();
        if cycle >= 200 {
            self.memory.cycle = self.read_cycle(cycle, words, report);
        } else {
            self.old_cycle_line(cycle, line, words, report);
        }
    }
}

/// Cycles that do nothing where they are defined (TNC 640 cycle manuals, overviews of the cycles: CALL-active; TNC 426 for 1 to 6, 12 and 210 to 215).
/// Turning systems (800, 801), patterns of codes (224), measurements of the machine (238, 239) and cycles of the machine builder act there.
fn waits_for_its_call(cycle: u32) -> bool {
    matches!(
        cycle,
        1..=6 | 12 | 15..=18 | 21..=25 | 30 | 200..=215 | 225 | 230..=233 | 240 | 241 | 251..=258 | 262..=265 | 267 | 273..=278
    )
}
