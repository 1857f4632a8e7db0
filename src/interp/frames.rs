//! Coordinates that the program shifts, rotates, scales, mirrors or gives as radius and angle. Shifts are part of the zero point; the
//! rest is a [`Shape`] between the words and the work coordinates in which motions are expressed.
#[cfg(test)]
mod agree_tests;
mod axial_shift;
mod data_entry;
mod feature;
mod increments;
mod linear;
mod points;
mod polar;
mod programmable;
mod reference;
mod shape;
mod shift;
mod solid;
mod swivel;
mod swivel_call;
mod tilt;
mod turn;

pub(crate) use axial_shift::ShiftParts;
pub(crate) use data_entry::OffsetValues;
pub(crate) use linear::Linear;
pub(crate) use polar::Polar;
pub(crate) use reference::Return;
pub(crate) use shape::{Rotation, Scaling, Shape, sin_cos_degrees};
pub(crate) use solid::{FrameValue, angles_of, by_traces, is_rigid};
pub(crate) use tilt::Tilted;

use crate::codes::{BlockCodes, Found};
use crate::core::Report;
use crate::cycles::Pattern;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, MotionKind, Position};
use std::collections::BTreeMap;
use trunnion_dialect::Action;
use trunnion_geometry::Vec3;

/// X, Y, Z in [`crate::AXIS_LETTERS`].
pub(crate) const XYZ: u16 = 0b111;

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frames {
    /// Whether coordinates of words are not work coordinates, or not simply.
    pub(crate) active: bool,
    /// Turned, scaled, mirrored.
    pub(crate) shape: Shape,
    /// Radius and angle.
    pub(crate) polar: Option<Polar>,
    /// The tilted working plane in whose coordinates everything is expressed until motions are emitted.
    pub(crate) tilt: Option<Tilted>,
    /// The tilted plane in whose axes the shift of the program acts, without that shift: of CYCLE800, and of PLANE once cycle 7 follows it.
    pub(crate) swivel: Option<Tilted>,
    /// A tilted plane of which some points or vectors are still to come.
    pub(crate) pending: Option<points::Pending>,
    /// The position in the coordinates of the words, while a shape is active; valid as long as the work position is `synced`.
    programmed: Position,
    synced: Position,
    /// Axes of a plane that was turned and that no word has given since.
    pub(crate) fresh: u16,
    /// Axes whose next coordinate must be absolute, since a turned plane has ended.
    pub(crate) must_be_absolute: u16,
    /// What the zero point and the frames of a Sinumerik have moved, for the next incremental coordinates.
    pub(crate) frame_moves: increments::Moved,
    /// The same of tool lengths.
    pub(crate) length_moves: increments::Moved,
    /// Zero point that is selected (G54), without shifts.
    pub(crate) selected: [f64; 9],
    /// G92.
    pub(crate) shift: [f64; 9],
    /// G52.
    pub(crate) local: [f64; 9],
    /// How that is divided on a Sinumerik.
    pub(crate) parts: ShiftParts,
    /// Offset of all zero points, written by G10 L2 P0.
    pub(crate) external: [f64; 9],
    /// Axes in which the program has written it, bits as in [`crate::Position::known`].
    pub(crate) external_written: u16,
    /// Declared offset of a lathe's tool.
    pub(crate) turret: [f64; 9],
    /// Work offsets that the program has written, by name.
    pub(crate) written: Vec<(Box<str>, OffsetValues)>,
    /// Tool offsets that the program has written.
    pub(crate) tool_offsets: BTreeMap<u32, data_entry::ToolOffset>,
    /// Blocks hold data until G11.
    pub(crate) entering_data: bool,
    /// The intermediate point of the last return to a reference point, work coordinates.
    pub(crate) intermediate: Option<Position>,
    /// Reference points that the program has stored, machine coordinates.
    pub(crate) stored_reference: [Option<Position>; 2],
    /// Where the axes stood at G254.
    pub(crate) dynamic: Option<Position>,
    /// The missing reference points were reported.
    pub(crate) reference_said: bool,
}

impl Frames {
    /// How many entries of lists that grow with the program a clone copies.
    pub(crate) fn copied(&self) -> usize {
        self.written.len() + self.tool_offsets.len()
    }

    /// To be called after any change.
    pub(crate) fn refresh(&mut self, work: &Position) {
        self.active = self.is_needed();
        self.programmed = self.shape.to_words(work);
        self.synced = *work;
    }
    fn is_needed(&self) -> bool {
        !self.shape.is_identity() || self.polar.is_some() || self.fresh != 0 || self.must_be_absolute != 0
    }
    /// The position in the coordinates of the words.
    pub(crate) fn programmed(&mut self, work: &Position) -> Position {
        if !self.active {
            return *work;
        }
        if self.synced != *work {
            self.programmed = self.shape.to_words(work);
            self.synced = *work;
        }
        self.programmed
    }
    /// The work position of a position in the coordinates of the words, which the tool then has.
    pub(crate) fn arrive(&mut self, programmed: Position) -> Position {
        if !self.active {
            return programmed;
        }
        let work = self.shape.to_work(&programmed);
        self.programmed = programmed;
        self.synced = work;
        self.active = self.is_needed();
        work
    }
    /// By how much a short way may grow from the coordinates of the words to work coordinates: 1 unless something is scaled.
    pub(crate) fn most_growth(&self) -> f64 {
        let columns = self.scaled_directions();
        columns.map_or(1.0, |columns| {
            columns.iter().map(Vec3::norm_squared).sum::<f64>().sqrt()
        })
    }
    /// Whether lengths in the words have others in work coordinates.
    pub(crate) fn scales(&self) -> bool {
        self.scaled_directions().is_some()
    }
    /// Where the directions of the words lead in work coordinates, if lengths or right angles change.
    fn scaled_directions(&self) -> Option<[Vec3; 3]> {
        if !self.active {
            return None;
        }
        let at = |axis: Option<usize>| {
            let mut words = Position::default();
            (0..3).for_each(|index| words.set(index, if Some(index) == axis { 1.0 } else { 0.0 }));
            let work = self.shape.to_work(&words);
            Vec3::new(work.values[0], work.values[1], work.values[2])
        };
        let middle = at(None);
        let columns = [0, 1, 2].map(|axis| at(Some(axis)) - middle);
        let square = |pair: [usize; 2]| columns[pair[0]].dot(&columns[pair[1]]).abs() <= 1e-9;
        let rigid = columns.iter().all(|column| (column.norm() - 1.0).abs() <= 1e-9)
            && [[0, 1], [0, 2], [1, 2]].into_iter().all(square);
        (!rigid).then_some(columns)
    }
    /// The kind of a motion in work coordinates.
    pub(crate) fn kind_to_work(&self, kind: MotionKind) -> MotionKind {
        match kind {
            MotionKind::Arc(Some(arc)) if self.active => MotionKind::Arc(self.shape.arc_to_work(&arc)),
            kind => kind,
        }
    }
    /// Where four points of the words are in the workpiece, and what polar coordinates continue from; empty where nothing is active.
    pub(crate) fn turned(&self) -> Vec<f64> {
        if self.shape.is_identity() && self.polar.is_none() && self.tilt.is_none() {
            return Vec::new();
        }
        let mut numbers = Vec::new();
        for place in [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]] {
            let mut point = Position {
                known: XYZ,
                ..Position::default()
            };
            point.values[..3].copy_from_slice(&place);
            let shaped = self.shape.to_work(&point);
            let work = self.tilt.map_or(shaped, |tilt| tilt.to_work(&shaped));
            numbers.extend(&work.values[..3]);
        }
        if let Some(polar) = &self.polar {
            numbers.extend(polar.last());
        }
        numbers
    }
    /// Everything that is added to the selected zero point.
    pub(crate) fn added(&self, axis: usize) -> f64 {
        self.external[axis] + self.shift[axis] + self.outer_local(axis) + self.turret[axis]
    }
    /// The shift of the program as far as it moves the zero point: inside a plane it moves the plane's.
    pub(crate) fn outer_local(&self, axis: usize) -> f64 {
        if self.swivel.is_some() && axis < 3 {
            0.0
        } else {
            self.local[axis]
        }
    }
    /// Whether the program has shifted, turned, scaled or mirrored inside a tilted plane.
    pub(crate) fn inside_plane(&self) -> bool {
        self.swivel.is_some() && (self.local[..3] != [0.0; 3] || self.shape.linear.is_some())
    }
    /// The shift of the program moves the zero of the plane in which it acts; the machine stays where it is, so its position moves.
    pub(crate) fn shift_plane(&mut self, position: &mut Position) {
        let (Some(plane), Some(now)) = (self.swivel, self.tilt) else {
            return;
        };
        let shifted = plane.then(&Tilted::new(
            Vec3::new(self.local[0], self.local[1], self.local[2]),
            &[],
        ));
        let by = plane.turn.transpose() * (shifted.origin - now.origin);
        for (value, by) in position.values.iter_mut().zip(by.iter()) {
            *value -= by;
        }
        self.tilt = Some(shifted);
    }
}

impl<'d> Iso<'d> {
    /// Codes of frames, returns and cycles.
    pub(crate) fn apply_frame(
        &mut self,
        found: &Found<'d>,
        words: &Words,
        block: &mut BlockCodes,
        report: &mut Report<'_>,
    ) {
        match found.code.action {
            Action::LocalShift => self.local_shift(found, words, block, report),
            Action::ProgrammableShift | Action::ProgrammableFrame => {
                if block.count > 1 {
                    // whether the words are those of the frame or of a motion (SINUMERIK 840D sl Programming Manual, Fundamentals: frame instructions)
                    let message = format!("{} must stand alone in its block", found.code.id);
                    self.refuse(words, crate::Refusal::GroupConflict, message, None, report);
                }
                self.programmable_frame(found, words, block, report);
            }
            Action::Pole => self.pole(found, words, block, report),
            Action::PositionSet => self.position_set(found, words, block, report),
            Action::PositionPreset => self.position_preset(found, words, block),
            Action::RotationOn => self.rotation_on(found, words, block, report),
            Action::RotationOff => {
                // the dynamic work offset of a Haas ends with G255 only
                if self.memory.frames.dynamic.is_none() {
                    self.end_tilt(report);
                }
                self.rotation_off(found);
            }
            Action::TiltedPlane => self.tilted_plane(found, words, block, report),
            Action::TiltedPlaneTurn | Action::TiltedPlaneTurnTip => self.tilted_plane_turn(found, words, block, report),
            Action::SwivelCycle => self.swivel_cycle(found, words, block, report),
            Action::ScalingOn => self.scaling_on(found, words, block, report),
            Action::ScalingOff => self.scaling_off(found),
            Action::MirrorOn => self.mirror_on(found, words, block, report),
            Action::MirrorOff => self.mirror_off(found, words, block),
            Action::PolarOn => self.polar(true),
            Action::PolarOff => self.polar(false),
            Action::DataEntry => self.data_entry(found, words, block, report),
            Action::DataEntryEnd => self.memory.frames.entering_data = false,
            Action::ReferenceCheck
            | Action::ReferenceReturn
            | Action::ReferenceReturnOther
            | Action::ReferenceFrom
            | Action::FixedPoint => {
                block.returns = Some((Return::of(found, words), found.range));
            }
            Action::ReferenceStore => self.store_reference(0),
            Action::ReferenceStoreOther => self.store_reference(1),
            Action::FeedGroup => self.feed_group(found, report),
            Action::DiameterOn | Action::DiameterAbsolute | Action::DiameterOff => {
                self.diameter_code(found, words, block, report);
            }
            Action::DiameterSwitch => self.diameter_switch(found, words, block, report),
            Action::ReturnInitial => self.memory.cycle.to_r = false,
            Action::ReturnToR => (self.memory.cycle.to_r, self.memory.cycle.to_level) = (true, false),
            Action::ReturnLevel => self.return_level(words, block),
            Action::ReturnToLevel => (self.memory.cycle.to_r, self.memory.cycle.to_level) = (false, true),
            Action::BoltCircle | Action::BoltArc | Action::BoltLine => block.pattern = Pattern::of(found),
            Action::FinishCycle
            | Action::RoughTurnCycle
            | Action::RoughFaceCycle
            | Action::PatternRepeatCycle
            | Action::ThreadRepeatCycle
            | Action::FacePeckCycle
            | Action::GroovePeckCycle => {
                block.takes_coordinates = true;
                block.repeated = Some(self.take_repeated(found));
            }
            Action::CirclePocket => {
                block.pocket = true;
                let what = format!("{}: the path inside the pocket", found.code.id);
                report.fault(found.range, FaultKind::NotModelled { what });
            }
            action if action.is_hole_cycle() || action.is_pass_cycle() => {
                self.begin_cycle(found);
                block.motion = Some(action);
                if block.not_modelled {
                    self.memory.cycle.hole.not_read();
                }
            }
            _ => self.unmodelled_code(found, words, block, report),
        }
    }
}
