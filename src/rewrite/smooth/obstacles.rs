//! Why a motion near the pole cannot be turned.
use crate::Change;
use crate::survey::{Point, Tip};
use trunnion_machine::NoStance;

/// A refusal.
pub(crate) fn refused(why: impl Into<String>) -> Change {
    Change::Refused(why.into())
}

/// Why a tool or its coordinates cannot be turned.
pub(crate) fn tool_obstacle(point: &Point) -> Option<Change> {
    match point.tip {
        Tip::Undeclared => Some(Change::Possible(
            "the tool shape is not declared, and only a ball keeps its contact point: declare it by (trunnion: tool 1 ball diameter 10), by [[tool]] in trunnion.toml, or by --tool ball:10"
                .into(),
        )),
        Tip::Other => Some(Change::Refused("the tool is not a ball: its contact with the surface would move, and the surface normal is not known".into())),
        Tip::Ball(_) if point.incremental => Some(Change::Refused("coordinates are incremental (G91)".into())),
        Tip::Ball(_) => None,
    }
}

/// Why a steep motion cannot be changed.
pub(crate) fn obstacle(point: &Point) -> Option<Change> {
    let why = if !point.tcp {
        "tool centre point control is off, so turning the table would move the tip"
    } else if !point.linear {
        "the motion is an arc: the rewrite handles straight motions"
    } else if !point.from_known {
        "the position before the motion is unknown"
    } else if point.many_turns() {
        "the motion turns the table by more than a whole turn, which is left as it is"
    } else if point.swap {
        "the motion swaps the posture far from the pole (branch-swap), which turns the tool axis between its ends"
    } else {
        return tool_obstacle(point);
    };
    Some(refused(why))
}

/// The first feed motion whose pose is unknown: a flip there would not be seen.
pub(crate) fn unknown_position(points: &[Point], line: impl Fn(usize) -> u32) -> Option<String> {
    let unknown = |point: &Point| {
        let unknown = |why: &NoStance| {
            matches!(
                why,
                NoStance::PositionUnknown(_)
                    | NoStance::NotModelled
                    | NoStance::Singular
                    | NoStance::RotaryOffset(_)
                    | NoStance::HeldElsewhere { .. }
                    | NoStance::PlaneMisaligned(_)
                    | NoStance::TurnsSpent(_)
            )
        };
        point.feed && point.end.as_ref().is_err_and(unknown)
    };
    let index = points.iter().position(unknown)?;
    let why = match &points[index].end {
        Err(NoStance::PositionUnknown(letters)) => format!(
            "the position of {} is unknown",
            letters.chars().map(String::from).collect::<Vec<_>>().join(", ")
        ),
        Err(NoStance::RotaryOffset(letter)) => format!("the work offset turns {}", char::from(*letter)),
        Err(NoStance::HeldElsewhere { axis, .. }) => {
            format!(
                "the machine file holds axis {} at a different position",
                char::from(*axis)
            )
        }
        _ => "the motion is not modelled".into(),
    };
    Some(format!(
        "line {}: {why}, so it is unknown whether the table flips at the pole",
        line(index)
    ))
}
