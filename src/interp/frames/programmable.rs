//! Programmable frames of a Sinumerik: TRANS, ROT, SCALE and MIRROR replace all of them, ATRANS, AROT, ASCALE and AMIRROR chain behind what
//! is there, each word alone ends all (Sinumerik 840D sl Programming Manual, Fundamentals, frames). The shift is part of the zero point, what
//! turns, scales and mirrors in the plane is a [`super::Shape`]. A frame that turns out of the plane, or that turns under tool centre point
//! control, is a [`super::Tilted`] plane of the program: see [`solid`](super::solid).
//!
//! Inside the plane of CYCLE800 they act in its axes: the frames of swivelling come before the programmable one in the chain of all frames
//! (SINUMERIK ONE Programming Manual, 12/2019, p. 631). One that turns out of that plane is not followed there.
use super::Linear;
use crate::arc::plane_axes;
use crate::codes::{BlockCodes, Found};
use crate::core::{LINEAR, ROTARY, Report};
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Position};

impl<'d> Iso<'d> {
    /// Regardless of G91, the words of the block are those of the frame.
    pub(crate) fn programmable_frame(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        let position = self.core.state.position;
        let before = self.memory.frames.programmed(&position);
        let (coupled, solid) = (self.is_coupled(), self.is_solid());
        self.frames_move(|iso| iso.change_frame(found, words, block, report));
        if coupled || self.is_coupled() {
            self.unsay_moved(&before, solid);
        }
    }

    /// An axis that the next block does not name: in a turned plane the sources do not say which of its positions stays.
    fn unsay_moved(&mut self, before: &Position, was_solid: bool) {
        let position = self.core.state.position;
        let now = self.memory.frames.programmed(&position);
        let [a, b, c] = plane_axes(self.core.state.coordinates.plane());
        let stays = |axis: usize| {
            before
                .get(axis)
                .zip(now.get(axis))
                .is_some_and(|(old, new)| (old - new).abs() <= 1e-9)
        };
        let known = before.get(c).is_some() && now.get(c).is_some();
        let solid = was_solid || self.is_solid();
        let normal = Some(c).filter(|_| known || solid);
        for axis in [Some(a), Some(b), normal]
            .into_iter()
            .flatten()
            .filter(|axis| !stays(*axis))
        {
            self.memory.frames.fresh |= if solid { LINEAR & super::XYZ } else { 1 << axis };
        }
        self.memory.frames.refresh(&position);
    }

    fn is_coupled(&self) -> bool {
        self.memory.frames.shape.linear.is_some_and(|linear| linear.couples()) || self.is_solid()
    }

    fn change_frame(&mut self, found: &Found<'d>, words: &Words, block: &mut BlockCodes, report: &mut Report<'_>) {
        block.takes_coordinates = true;
        if matches!(found.code.id.as_str(), "G58" | "G59") {
            return self.axial_shift(found, words, block, report);
        }
        let added = found.code.id.starts_with('A');
        let keeps_part = !added && self.replaces_fine_part();
        let in_swivel = self.memory.frames.swivel.is_some();
        if in_swivel && (self.memory.compensation.is_busy() || self.memory.corners.is_busy()) {
            let what = "a frame in a swivelled plane under cutter compensation, or inside a corner".to_owned();
            report.fault(found.range, FaultKind::NotModelled { what });
            self.core.forget_position();
        }
        if !added {
            let ended = self.core.unknown.end(found.code);
            self.core.forget_if(ended);
            self.end_programmable();
        }
        let angle = self.memory.own.path.frame_angle();
        if !words.axes.any() && angle.is_none() {
            return;
        }
        let turns = (words.axes.given | words.axes.unread) & ROTARY != 0;
        let tcp = self.core.state.tool_axis.tcp();
        let is_shift = matches!(found.code.id.as_str(), "TRANS" | "ATRANS");
        let plain = words.axes.unread == 0
            && !keeps_part
            && !((tcp || in_swivel) && turns)
            && (is_shift || !turns)
            && !self.core.unknown.any()
            && self.memory.frames.tilt.is_none_or(|tilt| tilt.programmed || in_swivel);
        let step = self.frame_step(found, words, angle).filter(|_| plain);
        let Some(step) = step.filter(|step| self.solid_step(step) != Some(false)) else {
            if found.code.id.ends_with("ROT") && (words.axes.given & LINEAR).count_ones() > 1 {
                let what = format!(
                    "{} about several axes: machine data 10600 decides in which order it turns (declare [control] frame_angles)",
                    found.code.id
                );
                report.fault(found.range, FaultKind::NotModelled { what });
                self.frame_begins(found, words, block);
            } else {
                self.frame_change(found, words, block, report);
            }
            return;
        };
        if let (true, FrameStep::Shift(by)) = (added, &step) {
            let plain = self.memory.frames.shape.linear.is_none() && !self.is_solid();
            self.memory.frames.parts.add(by, plain);
        }
        if self.is_solid() {
            self.memory.frames.must_be_absolute |= LINEAR;
            let position = self.core.state.position;
            return self.memory.frames.refresh(&position);
        }
        let before = self.memory.frames.shape.linear.unwrap_or_default();
        match step {
            FrameStep::Shift(by) => {
                let moved = before.apply([by[0], by[1], by[2]]);
                for (axis, value) in self.memory.frames.local.iter_mut().enumerate() {
                    *value += moved.get(axis).copied().unwrap_or(by[axis]);
                }
            }
            FrameStep::Linear(next) => self.set_linear(Some(before.then(&next))),
        }
        self.refresh_zero();
        let position = self.core.state.position;
        self.memory.frames.refresh(&position);
    }

    /// What a code of the group does with its words; `None`: that is not followed.
    fn frame_step(&self, found: &Found<'d>, words: &Words, angle: Option<f64>) -> Option<FrameStep> {
        let plane = plane_axes(self.core.state.coordinates.plane());
        let named = words.axes.given;
        if angle.is_some() != (found.code.id.ends_with("ROT") && named == 0) {
            return None;
        }
        match found.code.id.trim_start_matches('A') {
            "TRANS" => {
                let mut by = [0.0; 9];
                for (axis, value) in by.iter_mut().enumerate() {
                    *value = self.axis_value(words, axis).unwrap_or(0.0);
                }
                Some(FrameStep::Shift(by))
            }
            "ROT" => {
                let turn = match angle {
                    Some(angle) => Linear::turn(plane, Some(angle).filter(|angle| !angle.is_nan())?).matrix(),
                    None => self.turn_of([0, 1, 2].map(|axis| words.axes.get(axis)))?,
                };
                Some(FrameStep::Linear(Linear::from_matrix(turn)))
            }
            "ROTS" => Some(FrameStep::Linear(Linear::from_matrix(super::solid::by_traces(
                [0, 1, 2].map(|axis| words.axes.get(axis)),
            )?))),
            id @ ("SCALE" | "MIRROR") => {
                let mut diagonal = [1.0; 3];
                for (axis, factor) in diagonal.iter_mut().enumerate() {
                    match words.axes.get(axis) {
                        // the value of MIRROR has no meaning
                        Some(_) if id == "MIRROR" => *factor = -1.0,
                        Some(value) if value > 0.0 => *factor = value,
                        Some(_) => return None,
                        None => {}
                    }
                }
                Some(FrameStep::Linear(Linear::diagonal(diagonal)))
            }
            _ => None,
        }
    }

    /// The whole programmable frame gets another matrix, its shift being set already. As for its codes, a coordinate that the next block does
    /// not name is not known where the plane is turned.
    pub(crate) fn replace_linear(&mut self, to: Option<Linear>) {
        let position = self.core.state.position;
        let before = self.memory.frames.programmed(&position);
        let (coupled, solid) = (self.is_coupled(), self.is_solid());
        self.end_solid();
        self.set_linear(to);
        self.memory.frames.must_be_absolute |= LINEAR;
        self.refresh_zero();
        let position = self.core.state.position;
        self.memory.frames.refresh(&position);
        if coupled || self.is_coupled() {
            self.unsay_moved(&before, solid);
        }
    }

    /// The same for a frame that turns out of the plane; false: it is not followed.
    pub(crate) fn replace_solid(&mut self, frame: &super::FrameValue) -> bool {
        let position = self.core.state.position;
        let before = self.memory.frames.programmed(&position);
        if !self.set_solid(frame) {
            return false;
        }
        self.memory.frames.must_be_absolute |= LINEAR;
        self.unsay_moved(&before, true);
        true
    }

    /// What TRANS, ROT, SCALE and MIRROR have set ends.
    pub(super) fn end_programmable(&mut self) {
        self.end_solid();
        self.memory.frames.local = [0.0; 9];
        self.memory.frames.parts = super::ShiftParts::default();
        self.set_linear(None);
        self.refresh_zero();
    }

    fn set_linear(&mut self, to: Option<Linear>) {
        let frames = &mut self.memory.frames;
        let before = std::mem::replace(&mut frames.shape.linear, to);
        if before == to {
            return;
        }
        frames.must_be_absolute |= super::XYZ;
        let position = self.core.state.position;
        frames.refresh(&position);
    }
}

/// What one code does to the coordinates.
#[derive(Clone, Copy)]
pub(super) enum FrameStep {
    /// mm or deg.
    Shift([f64; 9]),
    Linear(Linear),
}
