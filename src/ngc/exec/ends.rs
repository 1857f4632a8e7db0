//! Where a motion ends: axis words, polar words, G90/G91, G53, diameters.
use super::{frame, problems};
use crate::{Block, DistanceMode, Error, Pose, State};
use trunnion_geometry::math;

/// Letters in the order of a pose.
pub(crate) const AXES: [u8; 9] = *b"XYZABCUVW";

/// The place of each axis letter in a pose; counted from A.
const PLACES: [usize; 26] = {
    let mut places = [0; 26];
    let mut place = 0;
    while place < AXES.len() {
        places[(AXES[place] - b'A') as usize] = place;
        place += 1;
    }
    places
};

/// A full turn, deg.
const TURN: f64 = 360.0;

/// The end of a motion of this block in program coordinates.
pub(crate) fn end(state: &State, block: &Block) -> Result<Pose, Error> {
    let at_origin = state.current[0] == 0.0 && state.current[1] == 0.0;
    if at_origin && block.radius.is_some() && block.angle.is_none() && state.distance == DistanceMode::Absolute {
        if block.g[0] == 530 {
            return Err(Error::new(&problems::POLAR_G53, block.range));
        }
        return Err(Error::new(&problems::POLAR_ORIGIN, block.range));
    }
    cycle_end(state, block)
}

/// The same of a canned cycle: at the origin a radius without angle is along X.
pub(crate) fn cycle_end(state: &State, block: &Block) -> Result<Pose, Error> {
    if block.g[0] == 530 {
        return machine_end(state, block);
    }
    let mut end = state.current;
    let incremental = state.distance == DistanceMode::Incremental;
    if takes_words(state, block) {
        put_words(&mut end, block);
        return Ok(end);
    }
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

/// Whether axis words, if not under G53, are coordinates of the end as they are.
#[inline]
pub(crate) fn takes_words(state: &State, block: &Block) -> bool {
    state.distance == DistanceMode::Absolute
        && !state.lathe_diameter
        && state.wrapped == [false; 3]
        && !block.is_polar()
}

/// Puts the axis words in their places of a pose.
#[inline]
pub(crate) fn put_words(pose: &mut Pose, block: &Block) {
    let mut given = block.given & crate::block::AXES;
    while given != 0 {
        let letter = given.trailing_zeros() as usize;
        pose[PLACES[letter]] = block.words[letter];
        given &= given - 1;
    }
}

/// The target of an absolute word from `here`: on a wrapped rotary axis in the direction of its sign.
fn absolute(state: &State, block: &Block, place: usize, here: f64, value: f64) -> Result<f64, Error> {
    if !is_wrapped(state, place) {
        return Ok(value);
    }
    wrapped_range(block, place, value)?;
    Ok(turned_to(here, value.is_sign_negative(), value.abs()))
}

/// From `here` forward or backward to the next position at `size` deg after a full turn.
fn turned_to(here: f64, backward: bool, size: f64) -> f64 {
    let end = (here / TURN).floor() * TURN + size;
    if backward && end > here {
        end - TURN
    } else if !backward && end < here {
        end + TURN
    } else {
        end
    }
}

/// The target of an axis that moves to a machine position (G28, G30, G53), `end` in program coordinates: on a wrapped rotary axis the sign of the
/// machine coordinate gives the direction, and the program coordinate is used without its sign. Observed from `rs274`.
pub(crate) fn named_end(
    state: &State,
    block: &Block,
    place: usize,
    here: f64,
    machine: f64,
    end: f64,
) -> Result<f64, Error> {
    if !is_wrapped(state, place) {
        return Ok(end);
    }
    wrapped_range(block, place, machine)?;
    Ok(turned_to(here, machine.is_sign_negative(), end.abs()))
}

/// Whether an axis is a wrapped rotary one.
pub(crate) fn is_wrapped(state: &State, place: usize) -> bool {
    (3..6).contains(&place) && state.wrapped[place - 3]
}

fn wrapped_range(block: &Block, place: usize, value: f64) -> Result<(), Error> {
    if value.abs() < TURN || value.is_nan() {
        return Ok(());
    }
    let letter = AXES[place];
    let text = format!(
        "Invalid absolute position {value:5.2} for wrapped rotary axis {}",
        char::from(letter)
    );
    let range = if block.has(letter) {
        block.range_of(letter)
    } else {
        block.range
    };
    Err(Error::with(&problems::WRAPPED, range, text))
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
            machine[place] = value;
        }
    }
    let program = frame::named_point(state, &machine);
    // an axis that is not named stays exactly; X and Y mix where the coordinate system is turned
    let mixed = state.rotation_xy != 0.0 && (block.has(b'X') || block.has(b'Y'));
    let mut end = state.current;
    for place in 0..9 {
        if block.has(AXES[place]) || (mixed && place < 2) {
            end[place] = named_end(state, block, place, end[place], machine[place], program[place])?;
        }
    }
    Ok(end)
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
            let cycle = matches!(block.motion, 730 | 740 | 810..=890);
            let problem = match block.radius {
                None if !cycle => &problems::POLAR_INCREMENTAL_ANGLE,
                _ => &problems::POLAR_INCREMENTAL,
            };
            return Err(Error::new(problem, block.range));
        }
        (
            radius_here + block.radius.unwrap_or(0.0),
            angle_here + given_angle.unwrap_or(0.0),
        )
    } else {
        (block.radius.unwrap_or(radius_here), given_angle.unwrap_or(angle_here))
    };
    let (sin, cos) = math::sin_cos(angle);
    Ok((radius * cos, radius * sin))
}
