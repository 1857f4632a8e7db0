//! The piece that the options describe; options that it does not have are refused.
use super::{Kind, Sample, WallSide};
use crate::cli::failure::Failure;
use trunnion_pieces::{
    CircleDiamondSquare, Cone, Piece, SWall, TurnedAxes, circle, circle_diamond_square, cone, corner_set, fixed_tip,
    s_wall, saddle, staircase,
};

/// The piece with its zero at the origin.
pub(super) fn piece(command: &Sample) -> Result<Piece, Failure> {
    foreign_options(command)?;
    let feed = command.feed.unwrap_or(500.0);
    let segments = command.segments.unwrap_or(360);
    let turned = |axes| {
        let (radius, tilt) = (command.radius.unwrap_or(60.0), command.tilt.unwrap_or(20.0));
        circle(axes, radius, tilt, segments, feed)
    };
    let made = match command.piece {
        Kind::Cone => cone(&cone_sizes(command)),
        Kind::SWall => s_wall(&wall_sizes(command)),
        Kind::CircleC => turned(TurnedAxes::Turn),
        Kind::CircleA => turned(TurnedAxes::Tilt),
        Kind::CircleAc => turned(TurnedAxes::Both),
        Kind::FixedTip => {
            let (radius, tilt) = (command.radius.unwrap_or(40.0), command.tilt.unwrap_or(20.0));
            fixed_tip(radius, tilt, segments, feed)
        }
        Kind::Saddle => saddle(command.columns.unwrap_or(20), command.rows.unwrap_or(20), feed),
        Kind::CornerSet => corner_set(command.size.unwrap_or(30.0), command.feed.unwrap_or(1000.0)),
        Kind::Staircase => staircase(
            command.size.unwrap_or(0.02),
            command.segments.unwrap_or(1000),
            command.feed.unwrap_or(5000.0),
        ),
        Kind::CircleDiamondSquare => circle_diamond_square(&CircleDiamondSquare {
            side: command.size.unwrap_or(100.0),
            tool_diameter: command.tool_diameter.unwrap_or(10.0),
            feed_mm_min: feed,
        }),
    };
    made.map_err(|error| Failure::new(error.0))
}

/// Sizes of the cone.
pub(super) fn cone_sizes(command: &Sample) -> Cone {
    Cone {
        half_angle_deg: command.half_angle.unwrap_or(15.0),
        tilt_deg: command.tilt.unwrap_or(10.0),
        radius: command.radius.unwrap_or(80.0),
        tool_diameter: command.tool_diameter.unwrap_or(20.0),
        segments: command.segments.unwrap_or(360),
        feed_mm_min: command.feed.unwrap_or(500.0),
    }
}

/// Sizes of the S-wall.
pub(super) fn wall_sizes(command: &Sample) -> SWall {
    SWall {
        lean_deg: command.lean.unwrap_or(15.0),
        waves: command.waves.unwrap_or(2),
        height: 30.0,
        tool_diameter: command.tool_diameter.unwrap_or(20.0),
        chord: command.chord.unwrap_or(0.01),
        tilt_deg: command.tilt.unwrap_or(0.0),
        right: command.side == Some(WallSide::Right),
        feed_mm_min: command.feed.unwrap_or(500.0),
    }
}

fn foreign_options(command: &Sample) -> Result<(), Failure> {
    use Kind::{CircleA, CircleAc, CircleC, CircleDiamondSquare, Cone, CornerSet, FixedTip, SWall, Saddle, Staircase};
    let round = [Cone, CircleC, CircleA, CircleAc, FixedTip];
    let table: [(&str, bool, &[Kind]); 11] = [
        ("half-angle", command.half_angle.is_some(), &[Cone]),
        (
            "tilt",
            command.tilt.is_some(),
            &[Cone, CircleC, CircleA, CircleAc, FixedTip, SWall],
        ),
        ("radius", command.radius.is_some(), &round),
        (
            "segments",
            command.segments.is_some(),
            &[Cone, CircleC, CircleA, CircleAc, FixedTip, Staircase],
        ),
        ("columns", command.columns.is_some(), &[Saddle]),
        ("rows", command.rows.is_some(), &[Saddle]),
        (
            "size",
            command.size.is_some(),
            &[CornerSet, Staircase, CircleDiamondSquare],
        ),
        ("lean", command.lean.is_some(), &[SWall]),
        ("waves", command.waves.is_some(), &[SWall]),
        ("side", command.side.is_some(), &[SWall]),
        ("chord", command.chord.is_some(), &[SWall]),
    ];
    for (name, given, kinds) in table {
        if given && !kinds.contains(&command.piece) {
            return Err(Failure::new(format!(
                "--{name} has no meaning for this piece; `trunnion sample --help` lists the pieces that use it"
            )));
        }
    }
    if command.tool_diameter.is_some() && ![Cone, SWall, CircleDiamondSquare].contains(&command.piece) {
        return Err(Failure::new("--tool-diameter: this piece defines its own tool"));
    }
    Ok(())
}
