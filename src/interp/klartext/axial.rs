//! PLANE AXIAL: a plane by positions of the rotary axes.
//!
//! A table that turns takes the part with it, and the coordinate system keeps the directions of the machine; a head that turns takes the coordinate
//! system with it (TNC 320 34055x-06, p. 425, and TNC 407 280 580, p. 8-56, tilting the working plane; TNC7 81762x-19, notes on machine kinematics:
//! the linear axes of a machine with table axes move in the tilted system as in the basic one). So its axes in the workpiece are the product of
//! the turns of the chain, workpiece side first. Both pages show axes along X, Y and Z; for others the directions of X and Y stay open.
use super::Klartext;
use super::positioning::Positioning;
use super::values::Value;
use super::words::{Kind, Parameter};
use crate::core::Report;
use crate::frames::Tilted;
use crate::{AXIS_LETTERS, Refusal, RotaryTurn};
use trunnion_geometry::{Mat3, Vec3};

/// A plane by its axes: what they make of the machine's directions, and where A, B and C stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axial {
    pub(super) turn: Mat3,
    pub(super) stands: [Option<f64>; 3],
}

impl Klartext<'_> {
    /// PLANE AXIAL: the plane, and with MOVE or TURN the way of the rotary axes to their positions.
    pub(super) fn plane_by_axes(
        &mut self,
        numbers: &[(String, Value)],
        positioning: Positioning,
        report: &mut Report<'_>,
    ) {
        match self.axial(numbers, report) {
            Ok(axial) => {
                if axial.turn != Mat3::identity() && self.memory.frames.local[..3] != [0.0; 3] {
                    let what = "PLANE AXIAL after a datum shift: whether the plane turns about the shifted datum";
                    self.not_modelled_once(what, report);
                    self.unknown_plane(report);
                } else {
                    self.set_plane(axial.turn, None, report);
                }
                self.set_angles(axial.stands);
                self.memory.angles_wait = None;
                if let Some(swivel) = positioning.swivel {
                    self.turn_axes((swivel, positioning.feed), axial.stands, report);
                }
            }
            Err(why) => {
                Self::not_modelled(format!("PLANE AXIAL: {why}"), report);
                self.memory.angles_wait = None;
                self.unknown_plane(report);
                self.unknown_turn(positioning, report);
            }
        }
    }

    /// The plane of the numbers of a block; what is not known about it otherwise.
    pub(super) fn axial(&self, numbers: &[(String, Value)], report: &mut Report<'_>) -> Result<Axial, String> {
        let Some(axes) = self.core.setup.control.rotary_turns.as_deref() else {
            return Err("the plane follows from the rotary axes of the machine, which is not known here".to_owned());
        };
        let zero = &self.core.state.zero;
        if zero.is_lost() || zero.values()[3..6].iter().any(|shift| *shift != 0.0) {
            return Err("the zero of a rotary axis is shifted or not known".to_owned());
        }
        let mut stands = [None; 3];
        for (name, value) in numbers {
            let letter = AXIS_LETTERS.iter().position(|letter| name.as_bytes() == [*letter]);
            let Some(place) = letter
                .and_then(|letter| letter.checked_sub(3))
                .filter(|place| *place < 3)
            else {
                return Err(format!("{name}: only positions of A, B and C are followed"));
            };
            if !axes.iter().any(|axis| axis.letter == place + 3) {
                let message = format!("PLANE AXIAL: the machine has no rotary axis {name}");
                Self::rejected(Refusal::UnknownWord, message, report);
                return Err(format!("the machine has no rotary axis {name}"));
            }
            stands[place] = Some(value.ok_or_else(|| format!("the value of {name} is not known"))?);
        }
        let mut turn = Mat3::identity();
        for axis in axes {
            let letter = char::from(AXIS_LETTERS[axis.letter]);
            let stand = axis.letter.checked_sub(3).and_then(|place| *stands.get(place)?);
            let degrees = stand.ok_or_else(|| format!("{letter} has no position in the block"))?;
            turn *= turned(axis, degrees).ok_or_else(|| format!("{letter} is not parallel to X, Y or Z"))?;
        }
        if axes.is_empty() {
            return Err("the machine has no rotary axis".to_owned());
        }
        Ok(Axial { turn, stands })
    }

    /// Q120 to Q122 are those of the last plane; `None`: not known.
    pub(super) fn set_angles(&mut self, stands: [Option<f64>; 3]) {
        for (number, value) in (120..).zip(stands) {
            let kind = Kind::Global;
            let parameter = Parameter { kind, number };
            if value.is_some() || self.memory.parameters.get(parameter).is_some() {
                self.memory.parameters.set(parameter, value);
            }
        }
    }
}

/// The turn of one axis, exact for quarter turns; `None` where it is not parallel to X, Y or Z.
fn turned(axis: &RotaryTurn, degrees: f64) -> Option<Mat3> {
    let (along, sense) = axis.along()?;
    Some(Tilted::new(Vec3::zeros(), &[(along, degrees * sense)]).turn)
}
