//! Coordinate systems of APT records: CSYS, TRACUT, TRANS and ORIGIN put points and vectors into the frame of the part.
//!
//! Under TRNTYP/WORLD (SolidWorks CAM) points and vectors are in the part already, and CSYS/ (rows of [R | t], 12 numbers) only says along
//! which axis the tool is where no vector is written: the third column of R. Without it a point p of a record is at R p in the part; what
//! t is then, no source says. MSYS/ of NX says where the machine coordinate system is in the model (origin, x axis, y axis): a post-processor takes it
//! as a remark, and the points are those of that system, where the program zero is. Another one after points is not followed. The three rows of [R | t] after
//! `$$*CATIA0` and a name put a point at R p + t, as does a TRACUT with numbers. TRANS/x,y,z adds, and ORIGIN/x,y,z takes off, what follows them; each replaces
//! the one before. What `$$-> CSYS` of a Pro/CLfile means for the points is in no source that was found: if it is not the unit frame, they are not
//! known.
//!
//! Sources: SolidWorks CAM output with the programs that were posted from it (all places of two set-ups each of two parts, and the tool axes
//! of seven set-ups); CATIA V5 help, Machining Axis Change (one path written in two systems); ICAM CAM-POST manual,
//! MSYS command; trade knowledge of post-processors for TRANS and ORIGIN.
use crate::apt::{Apt, Args};
use crate::core::Report;
use crate::{FaultKind, Orientation};
use trunnion_geometry::{Mat3, Vec3};
use trunnion_syntax::Record;

/// How far a written rotation may be from one: records round to five or six digits.
const ROUNDING: f64 = 1e-3;

/// A rotation and a shift.
#[derive(Clone, Copy, Debug, PartialEq)]
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
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    system: Placed,
    /// The system of NX in which the points are.
    msys: Option<Placed>,
    cut: Placed,
    trans: Vec3,
    origin: Vec3,
    /// TRNTYP/WORLD: the records are in the part, whatever CSYS says.
    world: bool,
    /// Under TRNTYP/WORLD: where the axes of CSYS point in the part.
    axes: Mat3,
    /// One of them could not be read.
    pub(crate) unread: bool,
    /// A `$$->` remark names a system, and what it means for the points is not known.
    remark_unread: bool,
}

impl Default for Frame {
    fn default() -> Self {
        Self {
            system: Placed::default(),
            msys: None,
            cut: Placed::default(),
            trans: Vec3::zeros(),
            origin: Vec3::zeros(),
            world: false,
            axes: Mat3::identity(),
            unread: false,
            remark_unread: false,
        }
    }
}

impl Frame {
    /// Where the records are is not known.
    pub(crate) fn is_lost(&self) -> bool {
        self.unread || self.remark_unread
    }
    /// Whether a TRANS or ORIGIN before shifts what follows. That a word such as NOMORE ends it is in no source that was found.
    pub(crate) fn is_shifted_by(&self, record: &Record<'_>) -> bool {
        record.is("TRANS") && self.trans != Vec3::zeros() || record.is("ORIGIN") && self.origin != Vec3::zeros()
    }
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
    /// Where a tool points that is along Z, and for which no vector is written.
    pub(crate) fn tool(&self) -> Vec3 {
        self.turn() * self.axes * Vec3::z()
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
        if record.is("MSYS") {
            let placed = origin_and_axes(numbers, unit);
            let first = frame.msys.is_none() && self.core.state.position.known.trailing_zeros() >= 3;
            let same = placed.is_some_and(|placed| placed == frame.msys.unwrap_or_default());
            frame.unread = placed.is_none() || !(first || same);
            if frame.unread {
                let why = if placed.is_some() {
                    ", another one after points: in which of them the next points are"
                } else {
                    ""
                };
                let what = report.program.text(record.major).to_ascii_uppercase() + why;
                report.fault(record.range, FaultKind::NotModelled { what });
            } else {
                frame.msys = placed;
            }
        } else if record.is("CSYS") {
            let placed = rows(numbers, unit);
            let in_part = frame.world;
            let unclear = placed.filter(|placed| !in_part && placed.shift != Vec3::zeros());
            frame.unread = placed.is_none() || unclear.is_some();
            frame.axes = placed
                .filter(|_| in_part)
                .map_or_else(Mat3::identity, |placed| placed.turn);
            frame.system = placed.filter(|_| !in_part).unwrap_or_default();
            if frame.unread {
                let shift = if unclear.is_some() {
                    " with a shift, without TRNTYP/WORLD: where its origin is"
                } else {
                    ""
                };
                let what = report.program.text(record.major).to_ascii_uppercase() + shift;
                report.fault(record.range, FaultKind::NotModelled { what });
            }
        } else if record.is("TRNTYP") {
            let plain = args.numbers().iter().all(|number| *number == 0.0) && !args.odd;
            frame.world = plain && args.words().len() == 1 && args.has(report.program, "WORLD");
            if !frame.world {
                frame.unread = true;
                let what = report.program.text(record.range).into_owned();
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
        self.turned_frame(before.tool());
        true
    }

    /// The machining axis of CATIA, three rows of [R | t]; `None`: it could not be read.
    pub(crate) fn machining_axis(&mut self, numbers: Option<&[f64]>) -> bool {
        let unit = self.core.state.coordinates.unit_mm();
        let before = self.kept.frame.tool();
        let placed = numbers.and_then(|numbers| rows(numbers, unit));
        self.kept.frame.unread = placed.is_none();
        self.kept.frame.system = placed.unwrap_or_default();
        self.turned_frame(before);
        placed.is_some()
    }

    /// `$$-> CSYS` of Creo: whether it is the one in which the records are anyway.
    pub(crate) fn creo_system(&mut self, numbers: Option<&[f64]>) -> bool {
        let before = self.kept.frame.tool();
        let placed = numbers.and_then(|numbers| rows(numbers, 1.0));
        let is_plain =
            placed.is_some_and(|placed| (placed.turn - Mat3::identity()).norm() <= 1e-9 && placed.shift.norm() <= 1e-9);
        self.kept.frame.remark_unread = !is_plain;
        self.turned_frame(before);
        is_plain
    }

    /// In a frame that is turned, a tool along Z points elsewhere in the part. Where vectors are written (MULTAX), the last one holds.
    fn turned_frame(&mut self, before: Vec3) {
        let now = self.kept.frame.tool();
        let unread = self.kept.frame.is_lost();
        if unread {
            self.core.forget_position();
        }
        self.core.state.zero.lose(self.core.unknown.any() || unread);
        // a system that is named again says where Z is, also after the tool axis was lost
        let told = now != before || self.kept.axis_lost;
        if told && !self.core.state.tool_axis.multax() && !unread {
            self.kept.axis_lost = false;
            let last = match self.core.state.orientation {
                Orientation::Vector(_, last) => Some(last),
                Orientation::Words => None,
            };
            self.kept.axis = Some(Orientation::Vector(last, now));
        }
    }
}
