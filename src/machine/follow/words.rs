//! Axis words to joint values: what a program's coordinates mean for the joints of a machine.
use crate::{AxisKind, Joints, MAX_AXES, Machine, Wrap};
use core::f64::consts::PI;
use trunnion_geometry::Vec3;
use trunnion_interp::{AXIS_LETTERS, Motion, Position, Swivel};

/// Bits of X, Y, Z in a [`Position`].
pub(crate) const XYZ: u16 = 0b111;

/// How the letters of a program reach the joints of one machine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Words {
    /// Index of each joint's letter in `AXIS_LETTERS`; beyond them for a letter no program can name.
    pub(crate) letter: [u8; MAX_AXES],
    /// mm (rad) of joint per mm (degree) of word.
    pub(crate) scale: [f64; MAX_AXES],
    /// The same for work offsets, which are never diameters, and for coordinates that the control treats as radii.
    zero_scale: [f64; MAX_AXES],
    /// mm of joint per mm of tool length: the tool axis at home in terms of the linear joints.
    per_length: Joints,
    /// Number of joints.
    count: usize,
    /// Letters without an axis on the machine.
    foreign: u16,
    /// The one of them that stands at 0.
    absent: u16,
    /// X, Y, Z words to mm (diameters to radii).
    point_scale: Vec3,
    /// Whether words of some axis are diameters.
    pub(crate) diameters: bool,
    /// Whether words of some rotary axis are not taken literally.
    pub(crate) wraps: bool,
    /// Whether every joint has a letter and moves literally to its words: no diameters, no wraps, no held axes.
    pub(crate) literal: bool,
    /// The letters of the joints as a mask.
    letters: u16,
}

/// What the work offset and the length of the tool add to each joint, mm or rad.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Added {
    zero: Joints,
    length: Joints,
}

impl Words {
    pub(crate) fn new(machine: &Machine) -> Self {
        let mut words = Self {
            letter: [u8::MAX; MAX_AXES],
            scale: [1.0; MAX_AXES],
            zero_scale: [1.0; MAX_AXES],
            per_length: [0.0; MAX_AXES],
            count: machine.axes.len().min(MAX_AXES),
            foreign: (1 << AXIS_LETTERS.len()) - 1,
            absent: machine.absent_axis().map_or(0, |axis| 1 << axis),
            point_scale: Vec3::new(1.0, 1.0, 1.0),
            diameters: false,
            wraps: false,
            literal: false,
            letters: 0,
        };
        for (joint, axis) in machine.axes.iter().enumerate().take(MAX_AXES) {
            let diameter = axis.extra.diameter && axis.kind == AxisKind::Linear;
            words.zero_scale[joint] = if axis.kind == AxisKind::Rotary { PI / 180.0 } else { 1.0 };
            words.scale[joint] = if diameter { 0.5 } else { words.zero_scale[joint] };
            words.diameters |= diameter;
            words.wraps |= axis.kind == AxisKind::Rotary && axis.extra.wrap != Wrap::Literal;
            if let Some(index) = AXIS_LETTERS.iter().position(|&letter| letter == axis.letter) {
                words.letter[joint] = index as u8;
                words.foreign &= !(1 << index) | words.absent;
                words.letters |= 1 << index;
                if index < 3 {
                    words.point_scale[index] = words.scale[joint];
                }
            }
        }
        let lettered = words.letters.count_ones() as usize == machine.axes.len();
        words.literal = lettered && !words.diameters && !words.wraps && machine.all_move();
        let constants = &machine.constants;
        let along = constants.inverse_motion * machine.tool_axis;
        for (&index, value) in constants.solved.iter().zip(along.iter()) {
            words.per_length[constants.linear[index].joint] = *value;
        }
        words
    }

    /// How far 1 mm of tool length moves a joint, mm.
    pub(crate) fn joint_per_length(&self, joint: usize) -> f64 {
        self.per_length.get(joint).copied().unwrap_or(0.0)
    }

    /// Whether a position gives all axes.
    #[inline]
    pub(crate) fn names_all(&self, position: &Position) -> bool {
        position.known & self.letters == self.letters
    }

    /// Whether the work offset and the tool length of a motion are numbers.
    #[inline]
    pub(crate) fn has_offsets(motion: &Motion) -> bool {
        motion.zero.iter().sum::<f64>().is_finite() && motion.tool_length_mm.is_finite()
    }

    /// Bit mask of all joints.
    pub(crate) fn all(&self) -> u16 {
        ((1_u32 << self.count) - 1) as u16
    }

    /// The first letter that the motion gives a value or an increment to and that is not an axis of the machine. Words that do not change are not reported.
    #[inline]
    pub(crate) fn foreign(&self, motion: &Motion) -> Option<u8> {
        let mut named = motion.end.known & self.foreign;
        while named != 0 {
            let letter = named.trailing_zeros() as usize;
            // a turn back to zero names all rotary axes that a machine may have
            let may_lack = self.absent & (1 << letter) != 0 || motion.tilt.swivel != Swivel::No;
            let stands = may_lack && motion.end.values[letter] == 0.0;
            if !stands && motion.start.get(letter) != motion.end.get(letter) {
                return Some(AXIS_LETTERS[letter]);
            }
            named &= named - 1;
        }
        // an increment from an unknown place
        let moved = motion.says_way & !motion.end.known & self.foreign & !self.absent;
        (moved != 0 && motion.tilt.swivel == Swivel::No).then(|| AXIS_LETTERS[moved.trailing_zeros() as usize])
    }

    /// The letter of a rotary axis that the active work offset turns.
    pub(crate) fn turned_frame(&self, machine: &Machine, motion: &Motion) -> Option<u8> {
        machine.constants.rotary().iter().find_map(|rotary| {
            let letter = usize::from(self.letter[rotary.joint]);
            (letter < AXIS_LETTERS.len() && motion.zero[letter] != 0.0).then(|| AXIS_LETTERS[letter])
        })
    }

    /// Joint values of the position's words: joint = word + zero, linear joints shifted by the tool length along the tool axis at home
    /// (unless the words are tip coordinates: then only rotary words are joints). The mask says which joints are known.
    #[inline]
    pub(crate) fn joints(&self, motion: &Motion, position: &Position, tip_words: bool) -> (Joints, u16) {
        let mut joints = [0.0; MAX_AXES];
        let mut known = 0;
        let (offset, length) = if motion.machine_coordinates {
            (0.0, 0.0)
        } else {
            (1.0, motion.tool_length_mm)
        };
        let count = self.count.min(MAX_AXES);
        for (joint, slot) in joints[..count].iter_mut().enumerate() {
            let letter = usize::from(self.letter[joint]);
            if letter >= AXIS_LETTERS.len()
                || position.known & (1 << letter) == 0
                || (tip_words && XYZ & (1 << letter) != 0)
            {
                continue;
            }
            let scale = if motion.radii {
                self.zero_scale[joint]
            } else {
                self.scale[joint]
            };
            let word = position.values[letter] * scale;
            let zero = motion.zero[letter] * self.zero_scale[joint] * offset;
            *slot = word + zero + self.per_length[joint] * length;
            // an offset or a length of no known value is not a number
            known |= u16::from(slot.is_finite()) << joint;
        }
        (joints, known)
    }

    /// [`Self::joints`] where words are literal, name all joints, and are not machine coordinates; `added` is that of their motion. What is
    /// after the last axis stays.
    #[inline]
    pub(crate) fn put_literal_joints(&self, end: &Position, added: &Added, joints: &mut Joints) {
        for (joint, slot) in joints.iter_mut().enumerate().take(self.count) {
            *slot = self.literal_joint(joint, end, added);
        }
    }

    /// One of them.
    #[inline]
    pub(crate) fn literal_joint(&self, joint: usize, end: &Position, added: &Added) -> f64 {
        let letter = usize::from(self.letter[joint]).min(AXIS_LETTERS.len() - 1);
        end.values[letter] * self.scale[joint] + added.zero[joint] + added.length[joint]
    }

    /// What a motion adds to its words.
    pub(crate) fn added(&self, motion: &Motion) -> Added {
        let mut added = Added {
            zero: [0.0; MAX_AXES],
            length: [0.0; MAX_AXES],
        };
        let parts = added.zero.iter_mut().zip(&mut added.length).enumerate();
        for (joint, (zero, length)) in parts.take(self.count) {
            let letter = usize::from(self.letter[joint]).min(AXIS_LETTERS.len() - 1);
            *zero = motion.zero[letter] * self.zero_scale[joint];
            *length = self.per_length[joint] * motion.tool_length_mm;
        }
        added
    }

    /// X, Y, Z of a position of the motion in mm, if all three are known.
    #[inline]
    pub(crate) fn point(&self, motion: &Motion, position: &Position) -> Option<Vec3> {
        let point = position.xyz()?;
        Some(if self.diameters && !motion.radii {
            point.component_mul(&self.point_scale)
        } else {
            point
        })
    }

    /// Whether the joint's letter is in a mask of letters.
    #[inline]
    pub(crate) fn names(&self, mask: u16, joint: usize) -> bool {
        let letter = self.letter[joint];
        letter < 16 && mask & (1 << letter) != 0
    }

    /// mm of X, Y and Z words per mm of tool length.
    pub(crate) fn length_along(&self) -> [f64; 3] {
        let mut along = [0.0; 3];
        for joint in 0..self.count {
            if let Some(slot) = along.get_mut(usize::from(self.letter[joint])) {
                *slot = self.per_length[joint] / self.scale[joint];
            }
        }
        along
    }

    /// Number of joints.
    pub(crate) fn count(&self) -> usize {
        self.count
    }
}

/// Work offset of X Y Z, mm.
#[inline]
pub(crate) fn zero_point(motion: &Motion) -> Vec3 {
    if motion.machine_coordinates {
        Vec3::zeros()
    } else {
        Vec3::new(motion.zero[0], motion.zero[1], motion.zero[2])
    }
}
