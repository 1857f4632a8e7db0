//! Constants of a chain for forward and inverse kinematics, computed once when the machine is loaded.
use crate::kinematics::held_axes::Carried;
use crate::{Axis, AxisKind, MAX_AXES};
use trunnion_geometry::math::{angle_between, atan2};
use trunnion_geometry::{Mat3, Vec3};

/// One rotary axis in the form of the formulas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RotaryAxis {
    /// Index of the joint.
    pub joint: usize,
    /// e: unit direction at home, machine frame.
    pub direction: Vec3,
    /// c: a point of the axis at home, machine frame, mm.
    pub point: Vec3,
    /// s: +1 (ISO 841) or -1.
    pub sign: f64,
}

/// One linear axis in the form of the formulas.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearAxis {
    /// Index of the joint.
    pub joint: usize,
    /// Sign times unit direction at home, machine frame: tip motion per mm of joint, before the rotary axes turn it.
    pub motion: Vec3,
    /// How many rotary axes are between the workpiece and this axis: 0, 1 or 2.
    pub segment: usize,
}

/// Constants of the orientation solver (docs/kinematics.md#two-postures); only for machines with two rotary axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PairConstants {
    /// c = e1 . e2.
    pub c: f64,
    /// D = 1 - c^2.
    pub d: f64,
    /// y = e2 . k0.
    pub y: f64,
    /// n = e1 x e2 (length sqrt D).
    pub n: Vec3,
    /// Unit vector of e2's part orthogonal to e1.
    pub f2: Vec3,
    /// n / sqrt D = e1 x f2.
    pub m: Vec3,
    /// Unit vector of e1's part orthogonal to e2.
    pub f1: Vec3,
    /// Azimuth of k0 about e2, counted from `f1` towards `-m`, rad.
    pub k_azimuth: f64,
    /// y - c and y + c: zero where the tool can point along +e1, along -e1.
    pub y_minus_c: f64,
    /// See `y_minus_c`.
    pub y_plus_c: f64,
    /// Smallest angle between tool axis and e1 that can be reached, rad.
    pub reach_min: f64,
    /// Largest angle between tool axis and e1 that can be reached, rad.
    pub reach_max: f64,
}

/// Precomputed kinematics of a chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constants {
    /// Rotary axes, workpiece side first; only the first `rotary_count` are meaningful.
    pub rotary: [RotaryAxis; 2],
    /// 0, 1 or 2.
    pub rotary_count: usize,
    /// Linear axes, workpiece side first; only the first `linear_count` are meaningful.
    pub linear: [LinearAxis; MAX_AXES],
    /// Number of linear axes.
    pub linear_count: usize,
    /// The three entries of `linear` that inverse kinematics solves for; further ones (a quill) keep their value.
    pub solved: [usize; 3],
    /// Whether there are linear axes in each segment of the chain.
    pub occupied: [bool; 3],
    /// The segment with all linear axes; `None` when they are in different ones.
    pub only_segment: Option<usize>,
    /// The segment shared by the three solved axes; `None` when they are in different ones.
    pub shared_segment: Option<usize>,
    /// Inverse of the matrix whose columns are the motions of the three solved axes.
    pub inverse_motion: Mat3,
    /// Whether `inverse_motion` is a permutation of the coordinate axes with signs (the fast case).
    pub cartesian: Option<[(usize, f64); 3]>,
    /// Constants of the orientation solver; `None` with fewer than two rotary axes.
    pub(crate) pair: Option<PairConstants>,
}

const NO_ROTARY: RotaryAxis = RotaryAxis {
    joint: 0,
    direction: Vec3::new(0.0, 0.0, 1.0),
    point: Vec3::new(0.0, 0.0, 0.0),
    sign: 1.0,
};
const NO_LINEAR: LinearAxis = LinearAxis {
    joint: 0,
    motion: Vec3::new(0.0, 0.0, 0.0),
    segment: 0,
};

impl Constants {
    /// From the axes (workpiece to tool) and the tool axis at home. Held axes are not joints here: they only move what follows them in the chain.
    /// `None` when the linear axes do not span space, when more than two rotary axes move, or when both of them are parallel.
    pub(crate) fn new(axes: &[Axis], tool_axis: &Vec3) -> Option<Self> {
        let (mut rotary, mut rotary_count) = ([NO_ROTARY; 2], 0);
        let (mut linear, mut linear_count) = ([NO_LINEAR; MAX_AXES], 0);
        let mut carried = Carried::default();
        for (joint, axis) in axes.iter().enumerate() {
            match axis.kind {
                AxisKind::Rotary if axis.extra.hold.is_some() => carried.hold(axis),
                AxisKind::Rotary => {
                    *rotary.get_mut(rotary_count)? = RotaryAxis {
                        joint,
                        direction: carried.turn(&axis.direction),
                        point: carried.place(&axis.point),
                        sign: axis.sign,
                    };
                    rotary_count += 1;
                }
                AxisKind::Linear => {
                    *linear.get_mut(linear_count)? = LinearAxis {
                        joint,
                        motion: carried.turn(&(axis.direction * axis.sign)),
                        segment: rotary_count,
                    };
                    linear_count += 1;
                }
            }
        }
        let solved = choose_solved(axes, &linear[..linear_count])?;
        let motions = Mat3::from_columns(&solved.map(|i| linear[i].motion));
        let inverse_motion = motions.try_inverse()?;
        let segment = linear[solved[0]].segment;
        let shared = solved.iter().all(|&i| linear[i].segment == segment);
        let pair = if rotary_count == 2 {
            Some(PairConstants::new(&rotary, &carried.turn(tool_axis))?)
        } else {
            None
        };
        let shared_segment = shared.then_some(segment);
        let mut occupied = [false; 3];
        for axis in &linear[..linear_count] {
            occupied[axis.segment] = true;
        }
        let mut inhabited = (0..3).filter(|&segment| occupied[segment]);
        let only_segment = inhabited.next().filter(|_| inhabited.next().is_none());
        let cartesian = cartesian(&inverse_motion);
        Some(Self {
            rotary,
            rotary_count,
            linear,
            linear_count,
            solved,
            occupied,
            only_segment,
            shared_segment,
            inverse_motion,
            cartesian,
            pair,
        })
    }

    /// The linear axes.
    pub fn linear(&self) -> &[LinearAxis] {
        &self.linear[..self.linear_count]
    }

    /// Condition number of the directions of the three solved linear axes (Frobenius norm, divided so that a right-angled set has 1).
    pub fn condition(&self) -> f64 {
        let motions = Mat3::from_columns(&self.solved.map(|index| self.linear[index].motion));
        motions.norm() * self.inverse_motion.norm() / 3.0
    }
    /// Whether two rotary axes move: then the chain has a pole and up to two postures for a tool axis.
    #[inline]
    pub fn has_pair(&self) -> bool {
        self.pair.is_some()
    }

    /// The rotary axes that move.
    pub fn rotary(&self) -> &[RotaryAxis] {
        &self.rotary[..self.rotary_count]
    }
}

impl PairConstants {
    /// `None` when the axes are parallel (within 1e-6 rad).
    fn new(rotary: &[RotaryAxis; 2], tool_axis: &Vec3) -> Option<Self> {
        let [e1, e2] = [rotary[0].direction, rotary[1].direction];
        let c = snap(e1.dot(&e2));
        let n = e1.cross(&e2);
        let root_d = n.norm();
        if root_d < 1e-6 {
            return None;
        }
        let m = n / root_d;
        let (f2, f1) = (m.cross(&e1), e2.cross(&m));
        let y = snap(e2.dot(tool_axis));
        let (alpha, beta) = (angle_between(&e1, &e2), angle_between(&e2, tool_axis));
        let sum = alpha + beta;
        let pi = core::f64::consts::PI;
        Some(Self {
            c,
            d: root_d * root_d,
            y,
            n,
            f2,
            m,
            f1,
            k_azimuth: atan2(-m.dot(tool_axis), f1.dot(tool_axis)),
            y_minus_c: snap(y - c),
            y_plus_c: snap(y + c),
            reach_min: (alpha - beta).abs(),
            reach_max: if sum > pi { 2.0 * pi - sum } else { sum },
        })
    }
}

/// Rounding residues of unit vectors become exactly zero, so that an exact pole is one.
fn snap(value: f64) -> f64 {
    if value.abs() < 1e-15 { 0.0 } else { value }
}

/// Volume of three unit vectors (area of two) up to which they count as flat.
pub(crate) const NEARLY_FLAT: f64 = 1e-3;

/// Three linear axes that span space: X, Y, Z if they do, else the first three (in the order XYZUVW) that do; of several choices
/// the first one with a volume above 1e-3.
fn choose_solved(axes: &[Axis], linear: &[LinearAxis]) -> Option<[usize; 3]> {
    let rank = |i: &usize| {
        b"XYZUVW"
            .iter()
            .position(|&l| l == axes[linear[*i].joint].letter)
            .unwrap_or(6)
    };
    let mut order: Vec<usize> = (0..linear.len()).collect();
    order.sort_by_key(rank);
    for (n, &a) in order.iter().enumerate() {
        for (m, &b) in order.iter().enumerate().skip(n + 1) {
            for &c in order.iter().skip(m + 1) {
                let volume = linear[a].motion.cross(&linear[b].motion).dot(&linear[c].motion).abs();
                if volume > NEARLY_FLAT {
                    return Some([a, b, c]);
                }
            }
        }
    }
    None
}

/// Row i of a signed permutation matrix picks coordinate `.0` with sign `.1`.
fn cartesian(inverse: &Mat3) -> Option<[(usize, f64); 3]> {
    let mut rows = [(0, 0.0); 3];
    for (row, out) in rows.iter_mut().enumerate() {
        let column = (0..3).find(|&column| inverse[(row, column)].abs() == 1.0)?;
        if (0..3).any(|other| other != column && inverse[(row, other)] != 0.0) {
            return None;
        }
        *out = (column, inverse[(row, column)]);
    }
    Some(rows)
}
