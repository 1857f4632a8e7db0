//! The three working planes of ISO G-code.
use crate::Vec3;

/// The plane that arcs lie in (G17, G18, G19). Its two axes and its normal are right-handed in this order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Plane {
    /// G17: X, Y; normal +Z.
    #[default]
    Xy,
    /// G18: Z, X; normal +Y.
    Zx,
    /// G19: Y, Z; normal +X.
    Yz,
}

impl Plane {
    /// Indices (0 = X, 1 = Y, 2 = Z) of the first axis, the second axis and the normal.
    pub fn axes(self) -> [usize; 3] {
        match self {
            Self::Xy => [0, 1, 2],
            Self::Zx => [2, 0, 1],
            Self::Yz => [1, 2, 0],
        }
    }
    /// Unit normal; an arc is counter-clockwise (G3) as seen from its tip.
    pub fn normal(self) -> Vec3 {
        match self {
            Self::Xy => Vec3::z(),
            Self::Zx => Vec3::y(),
            Self::Yz => Vec3::x(),
        }
    }
}
