//! Where cuts at a level meet a contour: geometry in the plane of roughing, free of axes and signs.
//!
//! `depth` grows into the work from the start of the cycle, `along` grows in the direction of the cuts; both in mm.
use crate::{Motion, MotionKind, Position};
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::Arc;

/// Levels nearer than this to a part of the contour along the cut may or may not be the same to a control, mm: below its least increment.
const SAME: f64 = 1e-4;
/// How far rounded ends and centres of arcs may be off, mm.
const ROUNDED: f64 = 2e-3;

/// Axes, directions and origin of the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// The axis into the work and the one along the cuts.
    pub(super) axes: [usize; 2],
    /// 1 or -1: the direction in which depth and distance along increase.
    pub(super) signs: [f64; 2],
    /// Where both are 0, mm.
    pub(super) origin: [f64; 2],
}

impl Frame {
    fn of(&self, values: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|i| (values[i] - self.origin[i]) * self.signs[i])
    }
    fn of_position(&self, position: &Position) -> [f64; 2] {
        self.of(self.axes.map(|axis| position.values[axis]))
    }
    fn of_point(&self, point: &Vec3) -> [f64; 2] {
        self.of(self.axes.map(|axis| point[axis]))
    }
    /// A position in the plane, as coordinates of the two axes, mm.
    pub(super) fn coordinates(&self, depth: f64, along: f64) -> [f64; 2] {
        let place = [depth, along];
        [0, 1].map(|i| self.origin[i] + self.signs[i] * place[i])
    }
}

struct Piece {
    from: [f64; 2],
    to: [f64; 2],
    arc: Option<Arc>,
}

/// A contour that rises from its deepest point and goes along the cuts, never back in either.
pub(super) struct Path {
    frame: Frame,
    pieces: Vec<Piece>,
}

impl Path {
    /// The path of motions; else why roughing down to it is unknown.
    pub(super) fn new(motions: &[Motion], frame: Frame) -> Result<Self, &'static str> {
        let mut pieces = Vec::with_capacity(motions.len());
        for motion in motions {
            let arc = match motion.kind {
                MotionKind::Arc(None) => return Err("an arc of its contour is unknown"),
                MotionKind::Arc(arc) => arc,
                _ => None,
            };
            let piece = Piece {
                from: frame.of_position(&motion.start),
                to: frame.of_position(&motion.end),
                arc,
            };
            let [rise, way] = [piece.from[0] - piece.to[0], piece.to[1] - piece.from[1]];
            if rise < -1e-9 || way < -1e-9 {
                return Err("its contour has a pocket, or does not rise and advance steadily");
            }
            if let Some(arc) = arc {
                in_a_quadrant(&arc, &piece, &frame)?;
            }
            pieces.push(piece);
        }
        Ok(Self { frame, pieces })
    }

    /// Where a cut at this depth, which is above the contour's first point, meets the contour. `None` where it does not, and where it runs
    /// along a part of it, so that the first and the last point that they share differ.
    pub(super) fn meet(&self, depth: f64) -> Option<f64> {
        let at = self.pieces.partition_point(|piece| piece.to[0] > depth + SAME);
        let piece = self.pieces.get(at)?;
        if piece.to[0] < depth - SAME {
            return Some(self.along(piece, depth));
        }
        let next = self.pieces.get(at + 1);
        let leaves = next.is_none_or(|next| next.to[0] < depth - SAME || next.to[1] - next.from[1] < SAME);
        leaves.then_some(piece.to[1])
    }

    /// The position of a depth on a piece that crosses it.
    fn along(&self, piece: &Piece, depth: f64) -> f64 {
        let [from, to] = [piece.from, piece.to];
        let Some(arc) = piece.arc else {
            return from[1] + (to[1] - from[1]) * (from[0] - depth) / (from[0] - to[0]);
        };
        let (mut deep, mut shallow) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (deep + shallow);
            let [there, _] = self.frame.of_point(&arc.point_at(middle));
            if there > depth { deep = middle } else { shallow = middle }
        }
        self.frame.of_point(&arc.point_at(shallow))[1]
    }
}

/// An arc rises and goes along evenly where it stays in one quadrant of its circle.
fn in_a_quadrant(arc: &Arc, piece: &Piece, frame: &Frame) -> Result<(), &'static str> {
    if arc.normal.y.abs() < 0.5 {
        return Err("an arc of its contour is in another plane");
    }
    if (arc.radius_start - arc.radius_end).abs() > ROUNDED {
        return Err("the radii of an arc of its contour differ");
    }
    let centre = frame.of_point(&arc.centre);
    let stays = |i: usize| {
        let [a, b] = [piece.from[i] - centre[i], piece.to[i] - centre[i]];
        a * b >= 0.0 || a.abs().min(b.abs()) <= ROUNDED
    };
    let quarter = core::f64::consts::FRAC_PI_2 + 2.0 * ROUNDED / arc.radius_start.max(ROUNDED);
    if stays(0) && stays(1) && arc.sweep.abs() <= quarter {
        Ok(())
    } else {
        Err("an arc of its contour turns back, as in a pocket")
    }
}
