//! A change of the path: where it puts points, directions and whole motions.
use crate::input::Input;
use crate::item::Step;
use crate::process::Process;
use trunnion_dialect::Plane;
use trunnion_geometry::Vec3;
use trunnion_interp::{Motion, MotionKind, Orientation};
use trunnion_syntax::{Address, BlockId};

/// Blocks of the program before, from the first to the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// The first block.
    pub first: BlockId,
    /// The last block, which is one of them.
    pub last: BlockId,
}

impl Part {
    /// Whether a block is one of them.
    pub fn has(&self, block: BlockId) -> bool {
        (self.first..=self.last).contains(&block)
    }
}

/// What the program after does with the motions of the program before, and how near it must come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Rows of the matrix by which points of the work frame are multiplied: a turn, a mirror image, one factor for all axes, or the identity.
    pub linear: [[f64; 3]; 3],
    /// What is added to them after that, mm.
    pub shift: [f64; 3],
    /// The lengths of the program after are in another unit: what the programs say apart from motions must be no length.
    pub other_unit: bool,
    /// How far the ends of motions may be off, mm: rounding of the words.
    pub end_mm: f64,
    /// How far the inside of arcs and the steps of drilling cycles may be off, mm: they are made of several rounded words.
    pub arc_mm: f64,
    /// By which part feeds may differ.
    pub feed_share: f64,
    /// Only the motions of these blocks are moved; all others go where they went. `None`: all are moved.
    pub part: Option<Part>,
}

const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

impl Change {
    /// The same path, within rounding.
    pub fn nothing(end_mm: f64, arc_mm: f64, feed_share: f64) -> Self {
        Self {
            linear: IDENTITY,
            shift: [0.0; 3],
            other_unit: false,
            end_mm,
            arc_mm,
            feed_share,
            part: None,
        }
    }

    /// Whether lengths change.
    pub fn scales(&self) -> bool {
        (self.determinant().abs() - 1.0).abs() > 1e-9
    }

    pub(crate) fn is_shift(&self) -> bool {
        self.linear == IDENTITY
    }

    pub(crate) fn is_nothing(&self) -> bool {
        self.is_shift() && self.shift == [0.0; 3]
    }

    /// Whether a block is one that is moved.
    pub(crate) fn moves(&self, block: BlockId) -> bool {
        self.part.is_none_or(|part| part.has(block))
    }

    pub(crate) fn direction(&self, vector: &Vec3) -> Vec3 {
        Vec3::from(
            self.linear
                .map(|row| row[0] * vector.x + row[1] * vector.y + row[2] * vector.z),
        )
    }

    /// Whether a direction stays as it is.
    pub(crate) fn keeps(&self, along: [f64; 3]) -> bool {
        let along = Vec3::from(along);
        (self.direction(&along) - along).norm() <= 1e-12
    }

    pub(crate) fn point(&self, point: &Vec3) -> Vec3 {
        self.direction(point) + Vec3::from(self.shift)
    }

    pub(crate) fn determinant(&self) -> f64 {
        let [a, b, c] = self.linear;
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    }

    /// Whether left and right change sides in a plane, seen from its normal.
    pub(crate) fn mirrors(&self, plane: Plane) -> bool {
        let (u, v) = match plane {
            Plane::Xy => (0, 1),
            Plane::Zx => (2, 0),
            Plane::Yz => (1, 2),
        };
        self.linear[u][u] * self.linear[v][v] - self.linear[u][v] * self.linear[v][u] < 0.0
    }

    /// Whether a coordinate changes.
    pub(crate) fn touches(&self, axis: usize) -> bool {
        self.linear[axis] != IDENTITY[axis] || self.shift[axis] != 0.0
    }

    /// The axes that are mixed with each other.
    pub(crate) fn groups(&self) -> Vec<Vec<usize>> {
        let mixed = |a: usize, b: usize| self.linear[a][b] != 0.0 || self.linear[b][a] != 0.0;
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for axis in 0..3 {
            match groups
                .iter_mut()
                .find(|group| group.iter().any(|other| mixed(*other, axis)))
            {
                Some(group) => group.push(axis),
                None => groups.push(vec![axis]),
            }
        }
        groups
    }

    /// A motion of the program before where the change puts it.
    pub(crate) fn moved(&self, step: &Step) -> Step {
        let mut step = step.clone();
        let change = self;
        let motion = &mut step.motion;
        if !motion.machine_coordinates {
            for position in [&mut motion.start, &mut motion.end] {
                let values = [position.values[0], position.values[1], position.values[2]];
                let moved = change.point(&Vec3::from(values));
                for axis in 0..3 {
                    position.values[axis] = moved[axis];
                }
            }
        }
        if let Orientation::Vector(start, end) = motion.orientation {
            let turn = |axis: Vec3| {
                let turned = change.direction(&axis);
                let length = turned.norm();
                if length > 0.0 { turned / length } else { turned }
            };
            motion.orientation = Orientation::Vector(start.map(turn), turn(end));
        }
        if let MotionKind::Arc(Some(arc)) = &mut motion.kind {
            let size = change.determinant().abs().cbrt();
            (arc.start, arc.end, arc.centre) = (
                change.point(&arc.start),
                change.point(&arc.end),
                change.point(&arc.centre),
            );
            (arc.radius_start, arc.radius_end) = (arc.radius_start * size, arc.radius_end * size);
            // the sweep is counted about the normal, which the program after has on the same side of the plane
            let normal = change.direction(&arc.normal) / size;
            let side = if normal.dot(&arc.normal) < -0.5 { -1.0 } else { 1.0 };
            arc.normal = normal * side;
            arc.sweep *= side * change.determinant().signum();
        }
        if change.mirrors(step.held.plane) {
            step.process = Process::on_other_side(&step.process);
            step.held.compensation = match step.held.compensation {
                41 => 42,
                42 => 41,
                other => other,
            };
        }
        step
    }
}

/// Whether a word of a program begins with the letter of a rotary axis.
pub(crate) fn names_rotary(input: &Input<'_>) -> bool {
    let mut words = input.program.blocks().flat_map(|block| block.words());
    words.any(|word| match word.address {
        Address::Letter(letter) => matches!(letter, b'A'..=b'C'),
        Address::Indexed(..) | Address::Named(_) => true,
    })
}

/// Whether a motion goes to a place of the machine; LinuxCNC says so in what is in effect.
pub(crate) fn in_machine_coordinates(step: &Step) -> bool {
    step.motion.machine_coordinates || !step.process.get("coordinates").is_empty()
}

/// Whether it is no dwell.
pub(crate) fn is_motion(motion: &Motion) -> bool {
    !matches!(motion.kind, MotionKind::Dwell(_))
}
