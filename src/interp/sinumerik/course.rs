//! The path of a spline whose points are all read, as lines.
//!
//! A reading that the settings have to declare: BSPLINE has evenly spaced knots, CSPLINE and ASPLINE run over the lengths of their chords, and CSPLINE
//! has no curvature at its ends. Source: nc-gcode-interpreter (CEAD), flatten.rs; the manuals name the kinds of splines only.
//!
//! The lines leave the path by at most the bound of POLY, by the same proof: see [`super::polynomial`].
use super::Spline;
use super::polynomial::{CHORD_MM, N, Piece, lines};
use crate::{Feed, ModalState, Motion, MotionKind};
use trunnion_geometry::{Vec3, spline};

/// Why a path is given up that bends too much.
const TOO_MANY: &str = "more than 20 000 lines";

/// A point as it is programmed.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// The straight motion to it.
    pub(super) motion: Motion,
    /// What was in effect there.
    pub(super) state: ModalState,
    /// PW.
    pub(super) weight: f64,
}

/// The points of a spline, up to its end.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    pub(super) kind: Spline,
    /// SD.
    pub(super) degree: f64,
    pub(super) points: Vec<Point>,
}

/// A cubic piece as one of degree 5.
fn raised(cubic: &spline::Cubic) -> Piece {
    let mut piece: Piece = [[0.0; 4]; N];
    piece[..4].copy_from_slice(cubic);
    for degree in 3..N - 1 {
        let before = piece;
        let share = |at: usize| at as f64 / (degree + 1) as f64;
        for at in 1..=degree {
            piece[at] =
                core::array::from_fn(|axis| share(at) * before[at - 1][axis] + (1.0 - share(at)) * before[at][axis]);
        }
        piece[degree + 1] = before[degree];
    }
    piece
}

impl Course {
    pub(super) fn new(kind: Spline) -> Self {
        Self {
            kind,
            degree: 3.0,
            points: Vec::new(),
        }
    }

    /// Its lines, each with the point to whose block it belongs, or why there are none. `growth`: how much a frame stretches
    /// lengths at most; `looked_at` counts the pieces.
    pub(super) fn lines(&self, growth: f64, looked_at: &mut u64) -> Result<Vec<(Motion, usize)>, &'static str> {
        const UNKNOWN: &str = "a point that is not known";
        let first = self.points.first().ok_or(UNKNOWN)?;
        let mut places: Vec<Vec3> = vec![first.motion.start.xyz().ok_or(UNKNOWN)?];
        for point in &self.points {
            places.push(point.motion.end.xyz().ok_or(UNKNOWN)?);
        }
        let pieces = match self.kind {
            Spline::Akima => spline::akima(&places).ok_or("two points at one place")?,
            Spline::Cubic => spline::natural(&places).ok_or("two points at one place")?,
            Spline::Poles => {
                let weights = core::iter::once(1.0).chain(self.points.iter().map(|point| point.weight));
                let degree = [2_usize, 3].into_iter().find(|degree| *degree as f64 == self.degree);
                let degree = degree.ok_or("SD other than 2 and 3, or not known")?;
                spline::b_spline(&places.iter().copied().zip(weights).collect::<Vec<_>>(), degree)
                    .ok_or("fewer points than its degree needs")?
            }
        };
        let beyond = self.points.len() - pieces.len();
        let feed = self.common_feed();
        let mut from = first.motion.start;
        let mut out = Vec::new();
        for (at, cubic) in pieces.iter().enumerate() {
            // a piece of a B-spline ends with the last pole that bends it
            let point = at + beyond;
            for place in lines(&raised(cubic), looked_at).ok_or(TOO_MANY)? {
                let mut motion = self.points[point].motion;
                motion.kind = MotionKind::Linear;
                if self.kind == Spline::Poles {
                    motion.feed = feed;
                }
                motion.start = from;
                for axis in 0..3 {
                    from.set(axis, place[axis]);
                }
                motion.end = from;
                motion.slack_mm = CHORD_MM * growth;
                out.push((motion, point));
            }
            if out.len() > super::polynomial::MOST_LINES {
                return Err(TOO_MANY);
            }
        }
        // exactly where the program says
        if let (Some((last, _)), Some(point)) = (out.last_mut(), self.points.last()) {
            last.end = point.motion.end;
        }
        Ok(out)
    }

    /// The feed of all points; unknown where they differ: which part of a B-spline belongs to which block is not known.
    fn common_feed(&self) -> Feed {
        let first = self.points[0].motion.feed;
        if self.points.iter().all(|point| point.motion.feed == first) {
            first
        } else {
            Feed::Unknown
        }
    }
}
