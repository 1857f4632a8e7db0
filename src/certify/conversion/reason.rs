//! Why a motion has no pose, in words.
use trunnion_machine::NoStance;

/// Why there is no pose.
pub(super) fn reason(why: &NoStance) -> String {
    let deg = trunnion_geometry::deg;
    match why {
        NoStance::PositionUnknown(letters) => format!("the position of {letters} is unknown"),
        NoStance::Unreachable(off) => format!(
            "the machine cannot point the tool there: the nearest tool axis it reaches is {:.4} deg away",
            deg(*off)
        ),
        NoStance::OutsideLimits { axis, value, limit } => format!(
            "{} would have to go to {:.4} deg, its limit is {:.4} deg",
            char::from(*axis),
            deg(*value),
            deg(*limit)
        ),
        NoStance::PostureRefused { axis, value } => format!(
            "no posture is the one that the program asks for: {} would be {:.4} deg",
            char::from(*axis),
            deg(*value)
        ),
        NoStance::Singular => "the linear axes do not span space at this position of the rotary axes".to_owned(),
        NoStance::NotModelled => "the motion is not modelled".to_owned(),
        NoStance::HeldElsewhere { axis, .. } => {
            format!("the machine file holds axis {} at another position", char::from(*axis))
        }
        NoStance::PlaneMisaligned(off) => {
            format!("the tool is {:.4} deg off the normal of the tilted plane", deg(*off))
        }
        NoStance::TurnsSpent(most) => turns_spent(*most),
        NoStance::NoSuchAxis(letter) => format!("the machine has no axis {}", char::from(*letter)),
        NoStance::RotaryOffset(letter) => format!(
            "a work offset in {} under tool centre point control is not modelled",
            char::from(*letter)
        ),
    }
}

/// The run has turned the rotary axes too much.
pub(crate) fn turns_spent(most: u64) -> String {
    format!(
        "its path is not computed: motions with turns of more than 8 deg take more than {most} pieces of 2 deg, half of [limits] steps"
    )
}
