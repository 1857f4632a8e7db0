//! Where a motion ends: axis words, polar words, G90/G91, G53, diameters.
use super::{frame, problems};
use crate::{Block, DistanceMode, Error, Pose, State};
use trunnion_geometry::math;

/// Letters in the order of a pose.
pub(crate) const AXES: [u8; 9] = *b"XYZABCUVW";

/// A full turn, deg.
const TURN: f64 = 360.0;

/// The end of a motion of this block in program coordinates.
pub(crate) fn end(state: &State, block: &Block) -> Result<Pose, Error> {
    if block.g[0] == 530 {
        return machine_end(state, block);
    }
    let mut end = state.current;
    let incremental = state.distance == DistanceMode::Incremental;
    for (place, letter) in AXES.into_iter().enumerate() {
        let Some(value) = word(state, block, letter) else {
            continue;
        };
        end[place] = if incremental {
            end[place] + value
        } else {
            absolute(state, block, place, state.current[place], value)?
        };
    }
    if block.radius.is_some() || block.angle.is_some() {
        (end[0], end[1]) = polar(state, block)?;
    }
    Ok(end)
}

/// Where an absolute word leads from `here`: on a wrapped rotary axis the way round that its sign says.
fn absolute(state: &State, block: &Block, place: usize, here: f64, value: f64) -> Result<f64, Error> {
    if !(3..6).contains(&place) || !state.wrapped[place - 3] {
        return Ok(value);
    }
    let letter = AXES[place];
    if value.abs() >= TURN {
        let text = format!(
            "Invalid absolute position {value:5.2} for wrapped rotary axis {}",
            char::from(letter)
        );
        return Err(Error::with(&problems::WRAPPED, block.range_of(letter), text));
    }
    let end = (here / TURN).floor() * TURN + value.abs();
    Ok(if value.is_sign_negative() && end > here {
        end - TURN
    } else if !value.is_sign_negative() && end < here {
        end + TURN
    } else {
        end
    })
}

/// An axis word in program units; an X diameter becomes a radius.
pub(crate) fn word(state: &State, block: &Block, letter: u8) -> Option<f64> {
    let value = block.word(letter)?;
    Some(if letter == b'X' && state.lathe_diameter {
        value / 2.0
    } else {
        value
    })
}

/// G53: words are machine coordinates; axes without a word stay where the machine is.
fn machine_end(state: &State, block: &Block) -> Result<Pose, Error> {
    if block.radius.is_some() || block.angle.is_some() {
        return Err(Error::new(&problems::POLAR_G53, block.range));
    }
    let mut machine = frame::to_machine(state, &state.current);
    for (place, letter) in AXES.into_iter().enumerate() {
        if let Some(value) = word(state, block, letter) {
            machine[place] = absolute(state, block, place, machine[place], value)?;
        }
    }
    let program = frame::named_point(state, &machine);
    // an axis that is not named stays exactly; X and Y mix where the coordinate system is turned
    let mixed = state.rotation_xy != 0.0 && (block.has(b'X') || block.has(b'Y'));
    Ok(std::array::from_fn(|place| {
        if block.has(AXES[place]) || (mixed && place < 2) {
            program[place]
        } else {
            state.current[place]
        }
    }))
}

/// `@` and `^`: X and Y of the end.
fn polar(state: &State, block: &Block) -> Result<(f64, f64), Error> {
    let (x, y) = (state.current[0], state.current[1]);
    let at_origin = x == 0.0 && y == 0.0;
    let radius_here = math::hypot(x, y);
    let angle_here = math::atan2(y, x);
    let given_angle = block.angle.map(f64::to_radians);
    let (radius, angle) = if state.distance == DistanceMode::Incremental {
        if at_origin {
            return Err(Error::new(&problems::POLAR_INCREMENTAL, block.range));
        }
        (
            radius_here + block.radius.unwrap_or(0.0),
            angle_here + given_angle.unwrap_or(0.0),
        )
    } else {
        if at_origin && given_angle.is_none() {
            return Err(Error::new(&problems::POLAR_ORIGIN, block.range));
        }
        (block.radius.unwrap_or(radius_here), given_angle.unwrap_or(angle_here))
    };
    let (sin, cos) = math::sin_cos(angle);
    Ok((radius * cos, radius * sin))
}
