//! The S-wall "trunnion-S": a ruled wall along an S whose lean changes sign, milled with the flank. Our own shape, not a standard's.
use crate::piece::{Piece, PieceError, Tool, count, within};
use core::f64::consts::TAU;
use trunnion_geometry::math::{rotate, sin, sin_cos};
use trunnion_geometry::{Vec3, rad};

/// Radius of the two arcs, mm.
const ARC_RADIUS: f64 = 30.0;
/// Length of each arc, mm.
const ARC: f64 = 50.0;
/// Length over which the curvature changes evenly from 0 to that of an arc (a clothoid), mm.
const JOIN: f64 = 15.0;
/// Length of the lower edge, mm.
const LENGTH: f64 = 4.0 * JOIN + 2.0 * ARC;
/// Thickness of the wall, across its lower edge, mm.
const THICKNESS: f64 = 3.0;

/// Sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SWall {
    /// Largest lean of the wall, deg.
    pub lean_deg: f64,
    /// How often the lean swings to both sides along the wall; its sign changes 2 waves - 1 times.
    pub waves: usize,
    /// Height of the wall, mm.
    pub height: f64,
    /// Diameter of the tool, mm.
    pub tool_diameter: f64,
    /// How far the path of the tip may be from its chords, mm.
    pub chord: f64,
    /// The whole part turned about X, deg: 0 puts every change of sign on the pole.
    pub tilt_deg: f64,
    /// The face to the right of the edge instead of the left one. It is milled from the other end, so that both are milled in the same direction.
    pub right: bool,
    /// mm/min.
    pub feed_mm_min: f64,
}

impl SWall {
    /// Length of the lower edge, mm.
    pub fn length(&self) -> f64 {
        LENGTH
    }

    /// Lower edge, unit ruling (also the tool axis) and the direction off the face at the arc length `s` of the left edge, 0..=length; not
    /// tilted. Ruling: cos b z + sin b n with the lean b = b0 sin(2 pi k s / L) and n to the left of the edge. The right face has the same
    /// rulings, its edge is next to the left one.
    fn upright(&self, edge: &Edge, s: f64) -> (Vec3, Vec3, Vec3) {
        let (point, heading) = edge.at(s);
        let lean = rad(self.lean_deg) * sin(TAU * self.waves as f64 * s / LENGTH);
        let (sin_h, cos_h) = sin_cos(heading);
        let left = Vec3::new(-sin_h, cos_h, 0.0);
        let (sin_b, cos_b) = sin_cos(lean);
        let off = left * cos_b - Vec3::z() * sin_b;
        let ruling = Vec3::z() * cos_b + left * sin_b;
        if self.right {
            (point - left * THICKNESS, ruling, -off)
        } else {
            (point, ruling, off)
        }
    }

    /// Point of the wall at arc length `s` and share `h` of the height (0: lower edge), mm.
    pub fn wall(&self, s: f64, h: f64) -> Vec3 {
        let (point, ruling, _) = self.upright(&Edge::new(), s);
        self.tilted(&(point + ruling * (h * self.height / ruling.z)))
    }

    /// Tip and tool axis after the length `s` along the edge: the flank touches the wall at its lower edge.
    pub fn at(&self, s: f64) -> (Vec3, Vec3) {
        self.place(&Edge::new(), s)
    }

    fn place(&self, edge: &Edge, s: f64) -> (Vec3, Vec3) {
        let s = if self.right { LENGTH - s } else { s };
        let (point, ruling, side) = self.upright(edge, s);
        let tip = point + side * (0.5 * self.tool_diameter);
        (self.tilted(&tip), self.tilted(&ruling).normalize())
    }

    fn tilted(&self, v: &Vec3) -> Vec3 {
        if self.tilt_deg == 0.0 {
            return *v;
        }
        rotate(&Vec3::x(), rad(self.tilt_deg), v)
    }

    /// The wall as a grid: `along` + 1 points in each of two rows, lower edge first.
    pub fn grid(&self, along: usize) -> Vec<Vec<Vec3>> {
        let edge = Edge::new();
        let row = |h: f64| {
            (0..=along)
                .map(|i| {
                    let (point, ruling, _) = self.upright(&edge, LENGTH * i as f64 / along as f64);
                    self.tilted(&(point + ruling * (h * self.height / ruling.z)))
                })
                .collect()
        };
        vec![row(0.0), row(1.0)]
    }
}

/// The lower edge: curvature 0, up to 1/R, there, down to -1/R, there, back to 0, with its middle at the origin.
struct Edge {
    /// Points at every millimetre of arc length.
    points: Vec<Vec3>,
}

impl Edge {
    fn new() -> Self {
        let pieces = LENGTH.round() as usize;
        let mut points = vec![Vec3::zeros()];
        for i in 0..pieces {
            let from = i as f64;
            points.push(points[i] + stretch(from, from + 1.0));
        }
        let middle = points[pieces / 2];
        for point in &mut points {
            *point -= middle;
        }
        Self { points }
    }

    /// Point and heading (rad from X) at the arc length `s`.
    fn at(&self, s: f64) -> (Vec3, f64) {
        let s = s.clamp(0.0, LENGTH);
        let i = (s.floor() as usize).min(self.points.len() - 2);
        (self.points[i] + stretch(i as f64, s), heading(s))
    }
}

/// Heading at the arc length `s`, rad: the integral of the curvature, turned so that the S runs along X.
fn heading(s: f64) -> f64 {
    // by symmetry about the middle, where the curvature changes sign
    let s = if s > 0.5 * LENGTH { LENGTH - s } else { s };
    let rise = |x: f64| x * x / (2.0 * JOIN * ARC_RADIUS);
    let turned = if s < JOIN {
        rise(s)
    } else if s < JOIN + ARC {
        rise(JOIN) + (s - JOIN) / ARC_RADIUS
    } else {
        2.0 * rise(JOIN) + ARC / ARC_RADIUS - rise((2.0 * JOIN + ARC - s).max(0.0))
    };
    turned - 0.5 * (2.0 * rise(JOIN) + ARC / ARC_RADIUS)
}

/// The displacement from arc length `from` to `to` (at most 1 mm): five-point Gauss-Legendre, exact beyond double precision here.
fn stretch(from: f64, to: f64) -> Vec3 {
    const NODES: [(f64, f64); 5] = [
        (0.0, 0.568_888_888_888_888_9),
        (-0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_5),
        (-0.906_179_845_938_664, 0.236_926_885_056_189_1),
        (0.906_179_845_938_664, 0.236_926_885_056_189_1),
    ];
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    NODES
        .iter()
        .map(|(node, weight)| {
            let (sin_h, cos_h) = sin_cos(heading(middle + half * node));
            Vec3::new(cos_h, sin_h, 0.0) * (weight * half)
        })
        .sum()
}

/// One pass along one side of the wall with points as close together as the chord error requires.
///
/// # Errors
/// Sizes out of range.
pub fn s_wall(sizes: &SWall) -> Result<Piece, PieceError> {
    within("lean", sizes.lean_deg, 0.1, 45.0, "deg")?;
    count("waves", sizes.waves, 1, 8)?;
    within("height", sizes.height, 1.0, 200.0, "mm")?;
    within("tool diameter", sizes.tool_diameter, 0.0, 29.0, "mm")?;
    within("chord error", sizes.chord, 1e-6, 5.0, "mm")?;
    within("tilt", sizes.tilt_deg, -60.0, 60.0, "deg")?;
    within("feed", sizes.feed_mm_min, 0.001, 1e6, "mm/min")?;
    let edge = Edge::new();
    // ends, changes of sign and the middle of the S are always points
    let stops = (4 * sizes.waves).max(8);
    let mut points = vec![sizes.place(&edge, 0.0)];
    for stop in 0..stops {
        let at = |i: usize| LENGTH * i as f64 / stops as f64;
        divide(sizes, &edge, at(stop), at(stop + 1), &mut points);
    }
    let title = format!(
        "S-wall, {} side, lean {} deg, {} waves, part tilted {} deg, chord error {} mm, {} blocks",
        if sizes.right { "right" } else { "left" },
        sizes.lean_deg,
        sizes.waves,
        sizes.tilt_deg,
        sizes.chord,
        points.len() - 1
    );
    let tool = Tool {
        diameter: sizes.tool_diameter,
        ball: false,
    };
    Ok(Piece::along("s-wall", title, sizes.feed_mm_min, tool, &points))
}

/// Adds the points after `from` up to `to`, halving until the chord is near enough at seven places between.
fn divide(sizes: &SWall, edge: &Edge, from: f64, to: f64, points: &mut Vec<(Vec3, Vec3)>) {
    let (a, b) = (sizes.place(edge, from).0, sizes.place(edge, to));
    let chord = b.0 - a;
    let off = |s: f64| {
        let way = sizes.place(edge, s).0 - a;
        (way - chord * (way.dot(&chord) / chord.norm_squared())).norm()
    };
    let worst = (1..8)
        .map(|i| off(from + (to - from) * f64::from(i) / 8.0))
        .fold(0.0, f64::max);
    if worst > sizes.chord && to - from > 1e-6 {
        let middle = 0.5 * (from + to);
        divide(sizes, edge, from, middle, points);
        divide(sizes, edge, middle, to, points);
    } else {
        points.push(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_geometry::deg;
    use trunnion_geometry::math::angle_between;

    fn sizes(chord: f64) -> SWall {
        SWall {
            lean_deg: 15.0,
            waves: 2,
            height: 30.0,
            tool_diameter: 20.0,
            chord,
            tilt_deg: 0.0,
            right: false,
            feed_mm_min: 500.0,
        }
    }

    /// The edge is traced at unit speed, its curvature is that of the arcs, and it is symmetric.
    #[test]
    fn the_edge_is_an_s() {
        let (edge, h) = (Edge::new(), 1e-3);
        let curvature = |s: f64| {
            let [a, b, c] = [s - h, s, s + h].map(|s| edge.at(s).0);
            let turn = (c - b).cross(&(b - a)).z / (h * h * h);
            (-turn, (c - a).norm() / (2.0 * h))
        };
        for (s, wanted) in [(40.0, 1.0), (7.5, 0.5), (80.0, 0.0), (120.0, -1.0), (152.5, -0.5)] {
            let (found, speed) = curvature(s);
            assert!((found * ARC_RADIUS - wanted).abs() < 1e-3, "{s}: {found}");
            assert!((speed - 1.0).abs() < 1e-6);
        }
        assert!((edge.at(0.0).0 + edge.at(LENGTH).0).norm() < 1e-12);
    }

    #[test]
    fn the_lean_swings_and_vanishes_where_it_should() {
        let wall = sizes(0.1);
        for i in 0..=4 {
            let (_, axis) = wall.at(LENGTH * f64::from(i) / 4.0);
            assert!(angle_between(&axis, &Vec3::z()) < 1e-12, "on the pole at {i} quarters");
        }
        let (_, axis) = wall.at(LENGTH / 8.0);
        assert!((deg(angle_between(&axis, &Vec3::z())) - 15.0).abs() < 1e-9);
        let tilted = SWall { tilt_deg: 0.1, ..wall };
        assert!((deg(angle_between(&tilted.at(0.0).1, &Vec3::z())) - 0.1).abs() < 1e-9);
    }

    /// The tip is off the wall by the tool's radius: no point of the wall near it is nearer. On either side.
    #[test]
    fn the_flank_touches_the_wall() {
        for right in [false, true] {
            let wall = SWall { right, ..sizes(0.1) };
            for s in [3.0, 33.0, 80.0, 101.0, 155.0] {
                let along = if right { LENGTH - s } else { s };
                let (tip, _) = wall.at(s);
                assert!((((tip - wall.wall(along, 0.0)).norm()) - 10.0).abs() < 1e-9);
                for (ds, h) in [(-0.5, 0.0), (0.5, 0.0), (0.0, 0.02), (-0.2, 0.01), (0.2, 0.01)] {
                    assert!((tip - wall.wall(along + ds, h)).norm() > 10.0 - 1e-9, "{s} {ds} {h}");
                }
            }
        }
    }

    /// Both faces are 3 mm apart, their tools on either side of both.
    #[test]
    fn the_wall_has_two_sides() {
        let (left, right) = (
            sizes(0.1),
            SWall {
                right: true,
                ..sizes(0.1)
            },
        );
        for s in [0.0, 20.0, 77.0, 130.0, LENGTH] {
            let across = left.wall(s, 0.0) - right.wall(s, 0.0);
            assert!((across.norm() - THICKNESS).abs() < 1e-12, "{s}");
            let (tip, axis) = right.at(LENGTH - s);
            assert!((tip - left.at(s).0).dot(&across) < 0.0 && (axis - left.at(s).1).norm() < 1e-12);
        }
    }

    #[test]
    fn points_keep_the_chord_error() {
        let mut before = 0;
        for chord in [0.5, 0.1, 0.01] {
            let wall = sizes(chord);
            let piece = s_wall(&wall).expect("a piece");
            let tips: Vec<Vec3> = piece.moves[1..piece.moves.len() - 1]
                .iter()
                .map(|step| step.tip)
                .collect();
            let mut worst = 0.0_f64;
            for i in 0..=2_000 {
                let tip = wall.at(LENGTH * f64::from(i) / 2_000.0).0;
                let off = |pair: &[Vec3]| {
                    let chord = pair[1] - pair[0];
                    let share = ((tip - pair[0]).dot(&chord) / chord.norm_squared()).clamp(0.0, 1.0);
                    (tip - pair[0] - chord * share).norm()
                };
                worst = worst.max(tips.windows(2).map(off).fold(f64::MAX, f64::min));
            }
            assert!(worst <= chord * 1.01 && worst > chord * 0.2, "{chord}: {worst}");
            assert!(tips.len() > before, "{}", tips.len());
            before = tips.len();
        }
    }
}
