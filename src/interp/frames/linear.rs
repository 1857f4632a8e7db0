//! Turns, scales and mirrors about the zero point, chained in any order.
use super::XYZ;
use super::shape::sin_cos_degrees;
use crate::Position;
use trunnion_geometry::{Mat3, Vec3};

/// A matrix from the coordinates of the words to work coordinates. It never mixes the plane's third axis with the other two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Linear(Mat3);

impl Default for Linear {
    fn default() -> Self {
        Self(Mat3::identity())
    }
}

impl Linear {
    /// By degrees, counter-clockwise from the first axis of a plane to the second; `plane`: first, second and third axis.
    pub(crate) fn turn(plane: [usize; 3], degrees: f64) -> Self {
        let (sin, cos) = sin_cos_degrees(degrees);
        let mut matrix = Mat3::identity();
        let [a, b, _] = plane;
        (matrix[(a, a)], matrix[(b, b)]) = (cos, cos);
        (matrix[(a, b)], matrix[(b, a)]) = (-sin, sin);
        Self(matrix)
    }
    /// A factor for each axis, none is zero; a negative one mirrors.
    pub(crate) fn diagonal(factors: [f64; 3]) -> Self {
        Self(Mat3::from_diagonal(&Vec3::from(factors)))
    }
    /// This frame with another one inside.
    pub(crate) fn then(&self, inner: &Self) -> Self {
        Self(self.0 * inner.0)
    }
    pub(crate) fn matrix(&self) -> Mat3 {
        self.0
    }
    /// A matrix that does not mix the plane's third axis with the other two.
    pub(crate) fn from_matrix(matrix: Mat3) -> Self {
        Self(matrix)
    }
    pub(crate) fn apply(&self, point: [f64; 3]) -> [f64; 3] {
        (self.0 * Vec3::from(point)).into()
    }
    /// Whether it mixes the plane's third axis with the other two.
    pub(crate) fn leaves(&self, normal: usize) -> bool {
        let others = [(normal + 1) % 3, (normal + 2) % 3];
        others
            .into_iter()
            .any(|axis| self.0[(axis, normal)] != 0.0 || self.0[(normal, axis)] != 0.0)
    }
    /// Whether a coordinate of the words moves more than one axis.
    pub(crate) fn couples(&self) -> bool {
        (0..3).any(|row| (0..3).any(|column| row != column && self.0[(row, column)] != 0.0))
    }
    /// The factor of all lengths in the plane across an axis that is not turned, where it is one and the angles stay.
    pub(crate) fn size(&self, normal: usize) -> Option<f64> {
        let (a, b) = ((normal + 1) % 3, (normal + 2) % 3);
        let square = self.0.transpose() * self.0;
        let size = square[(a, a)];
        let off = (square[(b, b)] - size).abs().max(square[(a, b)].abs());
        (off <= 1e-12 * size).then(|| size.sqrt())
    }
    /// Whether left and right change places, seen against an axis that is not turned.
    pub(crate) fn flips(&self, normal: usize) -> bool {
        self.0.determinant() * self.0[(normal, normal)] < 0.0
    }
    pub(crate) fn to_work(self, words: &Position) -> Position {
        carry(&self.0, words)
    }
    pub(crate) fn to_words(self, work: &Position) -> Position {
        match self.0.try_inverse() {
            Some(back) => carry(&back, work),
            None => Position {
                known: work.known & !XYZ,
                ..*work
            },
        }
    }
}

/// A coordinate is known where all that it depends on is.
fn carry(matrix: &Mat3, from: &Position) -> Position {
    let mut to = *from;
    for row in 0..3 {
        let needed = (0..3).filter(|column| matrix[(row, *column)] != 0.0);
        let (mut sum, mut known) = (0.0, true);
        for column in needed {
            known &= from.known & (1 << column) != 0;
            sum += matrix[(row, column)] * from.values[column];
        }
        to.values[row] = sum;
        to.known = if known {
            to.known | 1 << row
        } else {
            to.known & !(1 << row)
        };
    }
    to
}
