//! The tool's orientation: rotary words or a programmed vector.
use crate::codes::Found;
use crate::core::ROTARY;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::{Places, Words};
use crate::{FaultKind, Orientation};
use trunnion_dialect::Action;
use trunnion_geometry::Vec3;

impl Iso<'_> {
    /// ORIMKS and ORIWKS of a Sinumerik: whether tool vectors are in the axes of the machine.
    pub(crate) fn vectors_of_machine(&mut self, codes: &[Found<'_>]) {
        for found in codes.iter().filter(|found| found.code.id.starts_with("ORI")) {
            match found.code.id.as_str() {
                "ORIMKS" => self.memory.own.machine_vectors = true,
                "ORIWKS" => self.memory.own.machine_vectors = false,
                _ => {}
            }
        }
    }

    /// The orientation of a motion, from the vector or the rotary words of its block; else it stays as it is.
    pub(crate) fn orientation(&mut self, words: &Words, report: &mut Report<'_>) -> Orientation {
        let is_arc = matches!(
            self.core.state.motion,
            Some(Action::ArcClockwise | Action::ArcCounterClockwise)
        );
        let rotary = (words.axes.given | words.axes.unread) & ROTARY != 0;
        let centre = self.core.state.tool_axis.vectors() && !is_arc && words.centre.any();
        let orientation = if rotary && (words.vector.any() || centre) {
            // 840D sl Programming Manual, Job Planning, 6FC5398-2BP10-1BA0, p. 7-14: they exclude each other, mixed values give an alarm
            let what = "a tool vector and words of rotary axes in one block: which of them turn the tool".to_owned();
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
            self.core.unknown_orientation()
        } else if words.vector.any() && self.memory.own.machine_vectors && self.memory.frames.active {
            let what = "ORIMKS: a tool vector in the axes of the machine, in a frame of the program".to_owned();
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
            self.core.unknown_orientation()
        } else if words.vector.any() {
            if self.core.state.tool_axis.tcp() {
                self.vector(&words.vector, false, report, words)
            } else {
                let what = "tool vector without tool centre point control".to_owned();
                report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
                self.core.unknown_orientation()
            }
        } else if centre {
            self.vector(&words.centre, self.core.dialect.quirks.unit_vectors, report, words)
        } else if rotary {
            Orientation::Words
        } else {
            self.core.held_orientation()
        };
        self.core.state.orientation = orientation;
        orientation
    }

    fn vector(&mut self, places: &Places<3>, unit: bool, report: &mut Report<'_>, words: &Words) -> Orientation {
        if places.unread != 0 {
            return self.core.unknown_orientation();
        }
        // components that are not programmed are 0
        let vector = Vec3::from(places.values);
        self.core
            .unit_vector(vector, unit, words.first.unwrap_or_default(), report)
    }
}
