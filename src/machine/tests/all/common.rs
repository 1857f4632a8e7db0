//! Motions built by hand for tests.
use trunnion_geometry::Vec3;
use trunnion_interp::{Feed, Motion, Orientation, Position};

/// A linear feed motion with nothing known.
pub(crate) fn motion() -> Motion {
    Motion {
        feed: Feed::PerMinute(2000.0),
        spindle_on: Some(true),
        ..Motion::line(Position::default(), Position::default())
    }
}

/// A position from letters and values (mm, deg).
pub(crate) fn position(words: &[(u8, f64)]) -> Position {
    let mut position = Position::default();
    for &(letter, value) in words {
        let axis = trunnion_interp::AxisLetter::new(letter).expect("an axis letter");
        position.set(usize::from(axis.0), value);
    }
    position
}

/// A linear motion along words.
pub(crate) fn words(start: Position, end: Position) -> Motion {
    Motion { start, end, ..motion() }
}

/// A motion to a tip with a tool vector.
pub(crate) fn vector(start: Position, tip: [f64; 3], axis: Vec3) -> Motion {
    let mut end = start;
    for (i, value) in tip.into_iter().enumerate() {
        end.set(i, value);
    }
    Motion {
        start,
        end,
        orientation: Orientation::Vector(None, axis.normalize()),
        tcp: true,
        ..motion()
    }
}
