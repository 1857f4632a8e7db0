//! Coordinate systems of APT records: CSYS, MSYS, TRACUT, TRANS and ORIGIN put points and vectors into the frame of the part.
//!
//! A point p of a record is at R p + t there. CSYS/ holds the rows of [R | t] (12 numbers), and so does a TRACUT with numbers; MSYS/ holds
//! the origin, the x axis and the y axis (9 numbers). TRANS/x,y,z adds, and ORIGIN/x,y,z takes off, what follows them; each replaces the
//! one before. Sources: SolidWorks CAM output with the programs that were posted from it (the tool axes of seven set-ups, and two set-ups
//! of one plate whose features fall together); NX CLSF; trade knowledge of post-processors for TRANS and ORIGIN.
use crate::apt::{Apt, Args};
use crate::core::Report;
use crate::{FaultKind, Orientation};
use trunnion_geometry::{Mat3, Vec3};
use trunnion_syntax::Record;

/// How far a written rotation may be from one: records round to five or six digits.
const ROUNDING: f64 = 1e-3;

/// A rotation and a shift.
#[derive(Clone, Copy, Debug)]
struct Placed {
    turn: Mat3,
    shift: Vec3,
}

impl Default for Placed {
    fn default() -> Self {
        Self {
            turn: Mat3::identity(),
            shift: Vec3::zeros(),
        }
    }
}

/// Where the coordinates of the records are in the part.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Frame {
    system: Placed,
    cut: Placed,
    trans: Vec3,
    origin: Vec3,
    /// One of them could not be read.
    pub(crate) unread: bool,
}

impl Frame {
    /// A point of a record, mm, in the part.
    pub(crate) fn point(&self, point: Vec3) -> Vec3 {
        self.cut.turn * (self.system.turn * point + self.system.shift) + self.cut.shift + self.trans - self.origin
    }
    /// A vector of a record in the part.
    pub(crate) fn vector(&self, vector: Vec3) -> Vec3 {
        self.turn() * vector
    }
    fn turn(&self) -> Mat3 {
        self.cut.turn * self.system.turn
    }
}

/// The nearest thing to a rotation that a record can hold: right-handed, its axes of length 1 and square within the digits written.
fn rotation(turn: Mat3) -> Option<Mat3> {
    let square = (turn.transpose() * turn - Mat3::identity()).norm() <= ROUNDING;
    (square && turn.determinant() > 0.0).then(|| {
        // the digits that are missing would scale the path
        let x = turn.column(0).normalize();
        let z = x.cross(&turn.column(1)).normalize();
        Mat3::from_columns(&[x, z.cross(&x), z])
    })
}

/// Rows of [R | t], lengths in `unit` mm.
fn rows(numbers: &[f64], unit: f64) -> Option<Placed> {
    let &[a, b, c, x, d, e, f, y, g, h, i, z] = numbers else {
        return None;
    };
    Some(Placed {
        turn: rotation(Mat3::new(a, b, c, d, e, f, g, h, i))?,
        shift: Vec3::new(x, y, z) * unit,
    })
}

/// Origin, x axis, y axis, lengths in `unit` mm.
fn origin_and_axes(numbers: &[f64], unit: f64) -> Option<Placed> {
    let &[x, y, z, a, b, c, d, e, f] = numbers else {
        return None;
    };
    let (along_x, along_y) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
    Some(Placed {
        turn: rotation(Mat3::from_columns(&[along_x, along_y, along_x.cross(&along_y)]))?,
        shift: Vec3::new(x, y, z) * unit,
    })
}

impl Apt<'_> {
    /// A record that sets a part of the frame; `false`: it is none, or none that can be followed.
    pub(crate) fn frame_record(&mut self, record: &Record<'_>, args: &Args, report: &mut Report<'_>) -> bool {
        let unit = self.core.state.coordinates.unit_mm();
        let before = self.kept.frame;
        let frame = &mut self.kept.frame;
        let numbers = if args.odd || !args.words().is_empty() {
            &[]
        } else {
            args.numbers()
        };
        let point = match numbers {
            &[x, y, z] => Some(Vec3::new(x, y, z) * unit),
            _ => None,
        };
        if record.is("CSYS") || record.is("MSYS") {
            let read = if record.is("CSYS") { rows } else { origin_and_axes };
            let placed = read(numbers, unit);
            frame.unread = placed.is_none();
            frame.system = placed.unwrap_or_default();
            if placed.is_none() {
                let what = report.program.text(record.major).to_ascii_uppercase();
                report.fault(record.range, FaultKind::NotModelled { what });
            }
        } else if record.is("TRANS") && point.is_some() {
            frame.trans = point.unwrap_or_default();
        } else if record.is("ORIGIN") && point.is_some() {
            frame.origin = point.unwrap_or_default();
        } else if record.is("TRACUT") && args.has(report.program, "NOMORE") {
            frame.cut = Placed::default();
            // one that could not be read ends too
            return false;
        } else if let (true, Some(placed)) = (record.is("TRACUT"), rows(numbers, unit)) {
            frame.cut = placed;
        } else {
            return false;
        }
        self.turned_frame(before.turn());
        true
    }

    /// In a frame that is turned, a tool along Z points elsewhere in the part. Where vectors are written (MULTAX), the last one holds.
    fn turned_frame(&mut self, before: Mat3) {
        let now = self.kept.frame.turn();
        let unread = self.kept.frame.unread;
        if unread {
            self.core.forget_position();
        }
        self.core.state.zero.lose(self.core.unknown.any() || unread);
        if (now - before).norm() > 0.0 && !self.core.state.tool_axis.multax() && !unread {
            self.kept.axis_lost = false;
            let last = match self.core.state.orientation {
                Orientation::Vector(_, last) => Some(last),
                Orientation::Words => None,
            };
            self.kept.axis = Some(Orientation::Vector(last, now * Vec3::z()));
        }
    }
}
