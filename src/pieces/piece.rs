//! What a test piece is: moves of the tool tip with the tool axis, in the frame of the part.
use trunnion_geometry::Vec3;

/// How the tip moves to a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Rapid.
    Rapid,
    /// Feed along a line.
    Line,
    /// Feed along an arc about `centre`, counter-clockwise seen with `normal` pointing to the viewer; the tool axis stays.
    Arc {
        /// Centre, mm.
        centre: Vec3,
        /// Unit normal.
        normal: Vec3,
    },
}

/// One move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move {
    /// How.
    pub kind: Kind,
    /// Tool tip at its end, mm.
    pub tip: Vec3,
    /// Unit tool axis at its end, tip to spindle.
    pub axis: Vec3,
}

/// The tool a piece is made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tool {
    /// mm.
    pub diameter: f64,
    /// Ball end; else flat.
    pub ball: bool,
}

/// A test piece.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// `cone`.
    pub name: &'static str,
    /// For people, with its sizes.
    pub title: String,
    /// Feed of the tip, mm/min.
    pub feed_mm_min: f64,
    /// Tool.
    pub tool: Tool,
    /// Moves; the first is a rapid.
    pub moves: Vec<Move>,
}

/// Why there is no such piece: what is wrong with its sizes and what is allowed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PieceError(pub String);

impl core::fmt::Display for PieceError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for PieceError {}

/// How far above the first and the last point the tool waits, mm along the tool axis.
const CLEARANCE: f64 = 20.0;

impl Piece {
    /// A piece that cuts along `points` (tip, unit axis): approach and retract along the tool axis.
    pub(crate) fn along(
        name: &'static str,
        title: String,
        feed_mm_min: f64,
        tool: Tool,
        points: &[(Vec3, Vec3)],
    ) -> Self {
        let mut moves = Vec::with_capacity(points.len() + 2);
        let place = |kind, tip, axis| Move { kind, tip, axis };
        if let (Some(first), Some(last)) = (points.first(), points.last()) {
            moves.push(place(Kind::Rapid, first.0 + first.1 * CLEARANCE, first.1));
            moves.extend(points.iter().map(|(tip, axis)| place(Kind::Line, *tip, *axis)));
            moves.push(place(Kind::Rapid, last.0 + last.1 * CLEARANCE, last.1));
        }
        Self {
            name,
            title,
            feed_mm_min,
            tool,
            moves,
        }
    }

    /// The piece with its zero moved by `by`, mm.
    pub fn shifted(mut self, by: Vec3) -> Self {
        for step in &mut self.moves {
            step.tip += by;
            if let Kind::Arc { centre, .. } = &mut step.kind {
                *centre += by;
            }
        }
        self
    }

    /// Whether every tool axis is +Z: a machine with three axes can make it.
    pub fn is_three_axis(&self) -> bool {
        self.moves.iter().all(|step| step.axis == Vec3::z())
    }
}

/// A count within `low..=high`.
pub(crate) fn count(what: &str, value: usize, low: usize, high: usize) -> Result<usize, PieceError> {
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        Err(PieceError(format!("{what} {value}: must be from {low} to {high}")))
    }
}

/// A number within `low..=high`.
pub(crate) fn within(what: &str, value: f64, low: f64, high: f64, unit: &str) -> Result<f64, PieceError> {
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        Err(PieceError(format!(
            "{what} {value} {unit}: must be from {low} to {high} {unit}"
        )))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_is_entered_and_left_along_the_tool_axis() {
        let tool = Tool {
            diameter: 10.0,
            ball: false,
        };
        let axis = Vec3::new(0.6, 0.0, 0.8);
        let piece = Piece::along(
            "p",
            String::new(),
            1.0,
            tool,
            &[(Vec3::zeros(), axis), (Vec3::x(), Vec3::z())],
        );
        assert_eq!(piece.moves.len(), 4);
        assert_eq!(piece.moves[0].tip, axis * CLEARANCE);
        assert_eq!(piece.moves[3].tip, Vec3::x() + Vec3::z() * CLEARANCE);
        assert!(!piece.is_three_axis());
        let moved = piece.shifted(Vec3::new(0.0, 0.0, 50.0));
        assert_eq!(moved.moves[1].tip, Vec3::new(0.0, 0.0, 50.0));
    }

    #[test]
    fn sizes_out_of_range_are_refused_with_the_range() {
        assert_eq!(
            count("segments", 2, 3, 10).expect_err("refused").0,
            "segments 2: must be from 3 to 10"
        );
        assert!(within("tilt", f64::NAN, 0.0, 90.0, "deg").is_err());
    }
}
