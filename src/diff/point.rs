//! Where a motion ends, and whether two end at the same position.
use std::hash::{Hash, Hasher};
use trunnion_geometry::deg;
use trunnion_geometry::math::angle_between;
use trunnion_interp::{AXIS_LETTERS, AxisLetter, Motion, MotionKind, Orientation};
use trunnion_machine::{AxisKind, Leg, Machine};

/// What is still the same: mm and degrees.
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// mm.
    pub mm: f64,
    /// Degrees.
    pub deg: f64,
}

/// The kind of a motion, with what its path needs in addition to its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PathKind {
    /// A rapid motion.
    Rapid,
    /// A feed along a line.
    Linear,
    /// Centre (mm) and signed sweep (deg) with the axis it turns about; `None` where the centre is not known.
    Arc(Option<([f64; 3], [f64; 3], f64)>),
    /// Seconds; `None`: unknown.
    Dwell(Option<f64>),
    /// It is not modelled.
    Unknown,
}

impl PathKind {
    /// Whether something moves.
    pub fn is_a_move(self) -> bool {
        !matches!(self, Self::Dwell(_))
    }

    /// As `trace` names it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rapid => "rapid",
            Self::Linear => "linear",
            Self::Arc(_) => "arc",
            Self::Dwell(_) => "dwell",
            Self::Unknown => "unknown motion",
        }
    }
}

/// The end of a motion: programmed coordinates, or with a machine its joints. mm and degrees, in the order of the letters.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// How.
    pub way: PathKind,
    /// mm or deg; 0 where it is unknown.
    pub values: [f64; 9],
    /// Bit mask of those that are known.
    pub known: u16,
    /// Tool axis, where it is programmed as a vector or the machine gives it.
    pub axis: Option<[f64; 3]>,
    /// Tip in the workpiece frame; without a machine X Y Z as programmed.
    pub tip: Option<[f64; 3]>,
    /// Length of the path along X Y Z, mm.
    pub length_mm: Option<f64>,
    /// Words are coordinates of the tip, or of the machine: bits 0 and 1.
    frame: u8,
}

impl Point {
    /// As programmed; joints and tip from the machine, where one is given.
    pub fn new(motion: &Motion, machine: Option<(&Machine, &Leg)>) -> Self {
        let way = way(motion);
        let length_mm = match &motion.kind {
            MotionKind::Arc(Some(arc)) => Some(arc.length()),
            MotionKind::Rapid | MotionKind::Linear => motion
                .start
                .xyz()
                .zip(motion.end.xyz())
                .map(|(start, end)| (end - start).norm()),
            _ => None,
        };
        let mut point = Self {
            way,
            values: motion.end.values,
            known: motion.end.known,
            axis: match motion.orientation {
                Orientation::Vector(_, end) => Some(end.into()),
                Orientation::Words => None,
            },
            tip: motion.end.xyz().map(Into::into),
            length_mm,
            frame: u8::from(motion.tcp) | u8::from(motion.machine_coordinates) << 1,
        };
        if let Some((machine, leg)) = machine {
            point.take_joints(machine, leg);
        }
        for axis in 0..9 {
            // never negative zero, and no leftovers where nothing is known
            let known = point.known & (1 << axis) != 0 && point.values[axis].is_finite();
            point.known = if known { point.known } else { point.known & !(1 << axis) };
            point.values[axis] = if known { point.values[axis] + 0.0 } else { 0.0 };
        }
        point
    }

    fn take_joints(&mut self, machine: &Machine, leg: &Leg) {
        let (joints, known) = match &leg.end {
            Ok(stance) => {
                self.axis = Some(stance.axis.into());
                self.tip = Some(stance.tip.into());
                (stance.joints, u16::MAX)
            }
            // joints that are unknown say nothing; the words still do
            Err(_) => return,
        };
        (self.values, self.known, self.frame) = ([0.0; 9], 0, 0);
        for (index, axis) in machine.axes.iter().enumerate() {
            let Some(letter) = AxisLetter::new(axis.letter).filter(|_| known & (1 << index) != 0) else {
                continue;
            };
            let value = if axis.kind == AxisKind::Rotary {
                deg(joints[index])
            } else {
                joints[index]
            };
            self.values[usize::from(letter.0)] = value;
            self.known |= 1 << letter.0;
        }
    }

    /// A number that is the same for points that are the same to the last bit of the tolerance's grid.
    pub fn hash(&self, tolerance: Tolerance, state: &mut impl Hasher) {
        let grid = |value: f64, step: f64| {
            if step > 0.0 {
                (value / step).round() as i64
            } else {
                value.to_bits() as i64
            }
        };
        self.way.name().hash(state);
        (self.known, self.frame).hash(state);
        for axis in 0..9 {
            grid(self.values[axis], step(axis, tolerance)).hash(state);
        }
        if let Some(axis) = self.axis {
            axis.map(|part| grid(part, tolerance.deg.to_radians())).hash(state);
        }
        match self.way {
            PathKind::Arc(Some((centre, normal, sweep))) => {
                centre.map(|part| grid(part, tolerance.mm)).hash(state);
                normal.map(|part| (part * 1e6).round() as i64).hash(state);
                grid(sweep, tolerance.deg.max(1e-6)).hash(state);
            }
            PathKind::Dwell(Some(seconds)) => seconds.to_bits().hash(state),
            _ => {}
        }
    }

    /// Whether both end at the same position along the same path.
    pub fn same(&self, other: &Self, tolerance: Tolerance) -> bool {
        let ways = match (self.way, other.way) {
            (PathKind::Arc(Some(a)), PathKind::Arc(Some(b))) => {
                let near = |a: [f64; 3], b: [f64; 3], limit: f64| (0..3).all(|i| (a[i] - b[i]).abs() <= limit);
                // an arc that is off by the tolerance in its middle turns farther than the tolerance's angle
                near(a.0, b.0, tolerance.mm) && near(a.1, b.1, 1e-6) && (a.2 - b.2).abs() <= tolerance.deg.max(0.1)
            }
            (a, b) => a == b,
        };
        ways && (self.known, self.frame) == (other.known, other.frame)
            && self
                .moved(other)
                .iter()
                .all(|(axis, from, to)| (from - to).abs() <= step(*axis, tolerance))
            && self.angle_deg(other).is_none_or(|angle| angle <= tolerance.deg)
            && self.axis.is_some() == other.axis.is_some()
    }

    /// The axes known in both that differ: axis, from, to.
    pub fn moved(&self, other: &Self) -> Vec<(usize, f64, f64)> {
        let both = self.known & other.known;
        let axes = (0..AXIS_LETTERS.len()).filter(|axis| both & (1 << axis) != 0);
        axes.map(|axis| (axis, self.values[axis], other.values[axis]))
            .filter(|(_, from, to)| from != to)
            .collect()
    }

    /// Distance of the tips, mm.
    pub fn distance_mm(&self, other: &Self) -> Option<f64> {
        let (a, b) = (self.tip?, other.tip?);
        let square: f64 = (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum();
        Some(square.sqrt())
    }

    /// Angle between the tool axes, degrees.
    pub fn angle_deg(&self, other: &Self) -> Option<f64> {
        Some(deg(angle_between(&self.axis?.into(), &other.axis?.into())))
    }
}

/// The tolerance of an axis: A B C in degrees, others in mm.
pub(crate) fn step(axis: usize, tolerance: Tolerance) -> f64 {
    if (3..6).contains(&axis) {
        tolerance.deg
    } else {
        tolerance.mm
    }
}

fn way(motion: &Motion) -> PathKind {
    match &motion.kind {
        MotionKind::Rapid => PathKind::Rapid,
        MotionKind::Linear => PathKind::Linear,
        MotionKind::Arc(arc) => PathKind::Arc(
            arc.as_ref()
                .map(|arc| (arc.centre.into(), arc.normal.into(), deg(arc.sweep))),
        ),
        MotionKind::Dwell(seconds) => PathKind::Dwell(*seconds),
        MotionKind::Unknown => PathKind::Unknown,
    }
}
