//! Haas: the feature coordinate system (G268, G253, G269) and the dynamic work offset (G254, G255).
//!
//! G268 X Y Z I J K Q123: zero of the plane, and turns by I, J, K about the fixed X, Y and Z; G253 turns the spindle along its normal. G254: the zero of
//! the work offset follows the part on its turned table, X Y Z keep the directions of the machine; not together with G234 or G268, and G255 comes
//! before the next turn. Source: FreeCAD, Path/Post/scripts/hass_next_generation_post.py. Other orders than Q123 have no source.
use super::Tilted;
use crate::codes::{BlockCodes, Found};
use crate::core::{ROTARY, Report};
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Position};
use trunnion_geometry::Vec3;

impl<'d> Iso<'d> {
    /// Axis and degrees of the turns of G268.
    pub(super) fn feature_turns(&self, words: &Words, report: &mut Report<'_>) -> Option<[(usize, f64); 3]> {
        let angles = self.plane_angles(words, report)?;
        let order = words.letter(b'Q').index()?;
        let turn = |axis: usize| (axis, angles[axis]);
        let alone = angles.iter().filter(|angle| **angle != 0.0).count() <= 1;
        let names_each = matches!(order, 123 | 132 | 213 | 231 | 312 | 321);
        // the last turn about a fixed axis is the outermost
        (order == 123 || alone && names_each).then(|| [turn(2), turn(1), turn(0)])
    }

    /// G254: a plane in the directions of the machine, as they lie on the turned table.
    pub(crate) fn dynamic_offset(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let plain = !words.axes.any()
            && self.memory.frames.tilt.is_none()
            && self.memory.frames.shape.is_identity()
            && !self.core.state.tool_axis.tcp();
        let Some(turn) = self.table_turned().filter(|_| plain) else {
            self.end_tilt(report);
            return self.frame_change(found, words, block, report);
        };
        let ended = self.core.unknown.end(found.code);
        self.core.forget_if(ended);
        block.takes_coordinates = true;
        self.memory.frames.dynamic = Some(self.core.state.position);
        self.tilt_to(Some(turn), report);
    }

    /// The directions of the machine on a table that has turned; `None` where an axis, its position or a zero is not known, or a head turns.
    fn table_turned(&self) -> Option<Tilted> {
        let state = &self.core.state;
        let axes = self.core.setup.control.rotary_turns.as_deref()?;
        let zero = state.zero.values();
        // with a zero in the middle of the table G254 changes nothing, so one that is not declared is not taken for zero
        let declared = state.zero.undeclared() & super::XYZ == 0;
        if state.zero.is_lost() || axes.is_empty() || !declared {
            return None;
        }
        let turns: Option<Vec<(usize, f64)>> = axes
            .iter()
            .map(|axis| {
                let stand = state.position.get(axis.letter)?;
                let (along, sense) = axis.along()?;
                (axis.on_table && zero[axis.letter] == 0.0).then_some((along, stand * sense))
            })
            .collect();
        Some(Tilted::new(Vec3::zeros(), &turns?))
    }

    /// Before the motion of a block under G254: a rotary axis that has turned, or turns in the block, makes positions unknown until G255, and so
    /// does a zero of its own that a work offset brings.
    #[cold]
    pub(crate) fn dynamic_offset_holds(&mut self, at: &Position, words: &Words, report: &mut Report<'_>) {
        let now = self.core.state.position;
        let zero = self.core.state.zero.values();
        let stands = |axis: usize| now.get(axis) == at.get(axis) && zero[axis] == 0.0;
        let asks = |axis: usize| {
            let bit = 1 << axis;
            let same = words.axes.incremental & bit == 0
                && !self.core.state.coordinates.incremental()
                && words.axes.get(axis) == at.get(axis);
            (words.axes.given | words.axes.unread) & bit != 0 && !same
        };
        let rotary = (0..9).filter(|axis| ROTARY & (1 << axis) != 0);
        if rotary.clone().all(stands) && !rotary.clone().any(asks) {
            return;
        }
        self.memory.frames.dynamic = None;
        self.end_tilt(report);
        let what = "G254: a rotary axis turns while the dynamic work offset is on; G255 comes before it".to_owned();
        report.fault(report.whole(), FaultKind::NotModelled { what });
        if let Some(code) = self.core.dialect.g(2540) {
            self.core.unknown.begin(code, false);
        }
        self.core.forget_position();
    }
}
