//! Circle, diamond, square and a square turned by 3 deg: the classic contour of a machining centre's test piece, in our own sizes.
use crate::piece::{Kind, Move, Piece, PieceError, Tool, within};
use core::f64::consts::SQRT_2;
use trunnion_geometry::math::rotate;
use trunnion_geometry::{Vec3, rad};

/// Sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CircleDiamondSquare {
    /// Side of the outer square, mm; the others follow from it.
    pub side: f64,
    /// mm; the tip runs outside of each contour by half of it.
    pub tool_diameter: f64,
    /// mm/min.
    pub feed_mm_min: f64,
}

/// From the bottom up: a square turned by 3 deg, a square, the diamond inside it, the circle inside that, each one level higher.
///
/// # Errors
/// Sizes out of range.
pub fn circle_diamond_square(sizes: &CircleDiamondSquare) -> Result<Piece, PieceError> {
    let side = within("side", sizes.side, 10.0, 2_000.0, "mm")?;
    let off = 0.5 * within("tool diameter", sizes.tool_diameter, 0.0, 0.2 * side, "mm")?;
    within("feed", sizes.feed_mm_min, 0.001, 1e6, "mm/min")?;
    let level = 0.1 * side;
    let mut path = Path {
        moves: Vec::new(),
        above: 4.0 * level,
    };
    path.square(0.6 * side + off, rad(3.0), 0.0);
    path.square(0.5 * side + off, 0.0, level);
    // the corners of the diamond are at the middles of the square's sides
    path.square(0.25 * side * SQRT_2 + off, rad(45.0), 2.0 * level);
    // the circle lies inside the diamond
    path.circle(0.25 * side * SQRT_2 + off, 3.0 * level);
    Ok(Piece {
        name: "circle-diamond-square",
        title: format!("circle, diamond, square of {side} mm and 3 deg square"),
        feed_mm_min: sizes.feed_mm_min,
        tool: Tool {
            diameter: sizes.tool_diameter,
            ball: false,
        },
        moves: path.moves,
    })
}

struct Path {
    moves: Vec<Move>,
    above: f64,
}

impl Path {
    fn go(&mut self, kind: Kind, tip: Vec3) {
        self.moves.push(Move {
            kind,
            tip,
            axis: Vec3::z(),
        });
    }

    /// Down next to the contour's first point, around it, up again.
    fn contour(&mut self, first: Vec3, outwards: Vec3, round: impl FnOnce(&mut Self)) {
        let lift = Vec3::new(0.0, 0.0, self.above - first.z);
        let beside = first + outwards * 20.0;
        self.go(Kind::Rapid, beside + lift);
        self.go(Kind::Rapid, beside);
        self.go(Kind::Line, first);
        round(self);
        self.go(Kind::Line, beside);
        self.go(Kind::Rapid, beside + lift);
    }

    /// A square with the half side `half`, turned by `turn` rad, at the height `z`.
    fn square(&mut self, half: f64, turn: f64, z: f64) {
        let corner = |x: f64, y: f64| rotate(&Vec3::z(), turn, &Vec3::new(x * half, y * half, 0.0)) + Vec3::z() * z;
        let outwards = rotate(&Vec3::z(), turn, &Vec3::x());
        self.contour(corner(1.0, 0.0), outwards, |path| {
            for (x, y) in [(1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, 0.0)] {
                path.go(Kind::Line, corner(x, y));
            }
        });
    }

    fn circle(&mut self, radius: f64, z: f64) {
        let centre = Vec3::new(0.0, 0.0, z);
        let normal = -Vec3::z();
        self.contour(centre + Vec3::x() * radius, Vec3::x(), |path| {
            path.go(Kind::Arc { centre, normal }, centre - Vec3::x() * radius);
            path.go(Kind::Arc { centre, normal }, centre + Vec3::x() * radius);
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contours_nest() {
        let sizes = CircleDiamondSquare {
            side: 100.0,
            tool_diameter: 10.0,
            feed_mm_min: 500.0,
        };
        let piece = circle_diamond_square(&sizes).expect("a piece");
        let at = |z: f64| {
            piece
                .moves
                .iter()
                .filter(move |step| step.tip.z == z && step.kind == Kind::Line)
        };
        // side from side: 120 mm at the bottom, 100, 70.7 (diamond); tool radius 5
        let widest = |z: f64| at(z).map(|step| step.tip.y.abs()).fold(0.0, f64::max);
        assert!((widest(10.0) - 55.0).abs() < 1e-9);
        assert!((widest(20.0) - (25.0 * SQRT_2 + 5.0) * SQRT_2).abs() < 1e-9);
        assert_eq!(
            piece
                .moves
                .iter()
                .filter(|step| matches!(step.kind, Kind::Arc { .. }))
                .count(),
            2
        );
        assert!(piece.is_three_axis());
        assert!(circle_diamond_square(&CircleDiamondSquare { side: 1.0, ..sizes }).is_err());
    }
}
