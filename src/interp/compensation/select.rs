//! G40, G41, G42 and D: which side, which radius.
use super::Stage;
use crate::codes::Found;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::{WordValue, Words};
use crate::{Beside, FaultKind};
use trunnion_dialect::Action;

impl<'d> Iso<'d> {
    /// G41 (41) or G42 (42).
    pub(crate) fn compensation(&mut self, side: u8, found: &Found<'d>, words: &Words, report: &mut Report<'_>) {
        let before = self.core.state.compensation;
        self.core.state.compensation = side;
        let plane = self.core.dialect.quirks.offset_compensation && matches!(found.code.id.as_str(), "G41" | "G42");
        if !plane && let Some(nose) = self.nose(found) {
            return self.compensate_nose(nose, [before, side], report);
        }
        if !plane {
            self.core.state.beside = Beside::NotModelled;
            if !std::mem::replace(&mut self.core.compensation_reported, true) {
                let what = if self.core.dialect.quirks.diameter {
                    super::nose::UNDECLARED.to_owned()
                } else {
                    "cutter radius compensation: the programmed path is used instead".to_owned()
                };
                report.fault(found.range, FaultKind::NotModelled { what });
            }
            return;
        }
        let d = words.letter(b'D');
        let (old, given) = (self.memory.compensation.d, d.is_given());
        if given {
            self.memory.compensation.d = d.index();
        }
        let d = match d {
            WordValue::Nothing => old,
            said => said.index(),
        };
        if before != 0 {
            if before != side || d != old {
                self.lose("its side or its D changes", report);
            }
            return;
        }
        match self.cutter_radius(d) {
            Some(0.0) => {
                if d != Some(0) {
                    self.begin_unmeasured();
                }
                self.memory.compensation.stage = Stage::Off;
                self.core.state.beside = Beside::Computed;
            }
            Some(radius) => {
                let sign = if side == 41 { 1.0 } else { -1.0 };
                let compensation = &mut self.memory.compensation;
                compensation.stage = Stage::Start;
                (compensation.side, compensation.radius) = (sign * radius.signum(), radius.abs());
                compensation.tip = [0.0; 2];
                self.core.state.beside = Beside::Computed;
            }
            None if d.is_none() && !given => {
                self.memory.compensation.stage = Stage::Off;
                self.core.state.beside = Beside::NotModelled;
                let what = format!(
                    "{} without D, and no block before it has one: which radius counts (write D)",
                    found.code.id
                );
                report.fault(found.range, FaultKind::NotModelled { what });
            }
            None => {
                self.begin_unmeasured();
                self.memory.compensation.stage = Stage::Off;
                self.core.state.beside = Beside::Radius;
                if !std::mem::replace(&mut self.core.compensation_reported, true) {
                    let d = d.map_or_else(|| "D".to_owned(), |d| format!("D{d}"));
                    report.fault(found.range, FaultKind::radius_lacks(&d));
                }
            }
        }
    }

    /// A code that moves or scales the coordinates, or writes a radius, while the tool runs beside the contour: what becomes of the offset vector is in no
    /// source of this project.
    pub(crate) fn zero_in_compensation(&mut self, found: &Found<'d>, words: &Words, report: &mut Report<'_>) {
        if self.core.state.compensation == 0 || self.memory.compensation.stage != Stage::On {
            return;
        }
        let changes = match found.code.action {
            Action::WorkOffset => self.core.state.zero.offset() != Some(found.code.id.as_str()),
            Action::PositionSet => words.axes.any(),
            // radius and wear
            Action::DataEntry => matches!(words.letter(b'L').index(), Some(12 | 13)),
            Action::LocalShift | Action::PositionPreset | Action::ScalingOn | Action::ScalingOff => true,
            _ => false,
        };
        if changes {
            let why = format!(
                "{} while it is active, which leaves open what becomes of the offset",
                found.code.id
            );
            self.lose(&why, report);
        }
    }

    /// D while compensation is off: it waits for G41 or G42 (Fanuc Series 30i operator's manual, cutter compensation: D is modal).
    pub(crate) fn cutter_number_ahead(&mut self, words: &Words) {
        if let Some(number) = words.letter(b'D').index() {
            self.memory.compensation.d = Some(number);
        }
    }

    /// D in a block of its own, while compensation is on.
    pub(crate) fn cutter_number(&mut self, words: &Words, report: &mut Report<'_>) {
        let d = words.letter(b'D');
        if !d.is_given() || self.core.state.compensation == 0 || d.index() == self.memory.compensation.d {
            return;
        }
        self.memory.compensation.d = d.index();
        self.lose("its D changes", report);
    }

    /// Radius of an offset number, mm: written by the program, else half the diameter of the tool of that number.
    fn cutter_radius(&self, d: Option<u32>) -> Option<f64> {
        let number = d?;
        if number == 0 {
            return Some(0.0);
        }
        let written = self.tool_offset(number);
        if written.is_some_and(|offset| offset.radius_unclear) {
            return None;
        }
        let declared = || {
            self.core
                .tools
                .data(Some(number))
                .and_then(|tool| tool.diameter_mm)
                .map(|diameter| 0.5 * diameter)
        };
        let radius = written.and_then(|offset| offset.radius).or_else(declared)?;
        Some(radius + written.map_or(0.0, |offset| offset.radius_wear))
    }
}
