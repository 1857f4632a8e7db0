//! Consistency of a block, checked before it does anything.
use super::{motion, problems, unused};
use crate::block::M_GROUPS;
use crate::{Block, DistanceMode, Error, Plane, State, cycles};

/// A line has at most this many M codes.
const M_CODES: u8 = 4;

/// How many M codes there are.
pub(crate) fn codes(block: &Block) -> Result<(), Error> {
    if block.m_count > M_CODES {
        let last = (0..M_GROUPS)
            .filter(|&group| block.m[group] >= 0)
            .map(|group| block.m_range(group));
        let range = last.max_by_key(|range| range.start).unwrap_or(block.range);
        return Err(Error::new(&problems::TOO_MANY_M, range));
    }
    Ok(())
}

/// Determines which motion applies to the block: the code given, or the one in effect if there are axis words.
pub(crate) fn choose_motion(block: &mut Block, state: &State) -> Result<(), Error> {
    let polar = block.radius.is_some() || block.angle.is_some();
    if polar && state.plane != Plane::Xy {
        return Err(Error::new(&problems::POLAR_PLANE, block.range));
    }
    if polar && block.has(b'X') {
        return Err(Error::new(&problems::POLAR_X, block.range_of(b'X')));
    }
    if polar && block.has(b'Y') {
        return Err(Error::new(&problems::POLAR_Y, block.range_of(b'Y')));
    }
    let axes = block.has_axes();
    let setting = matches!(block.g[0], 100 | 280 | 300 | 520 | 920);
    let tool_offset = matches!(block.g[8], 431 | 432);
    let no_axes = matches!(block.g[0], 520 | 920) && block.given & crate::block::AXES == 0;
    block.motion = block.g[1];
    let given = block.g[1] >= 0;
    let moves = given && block.g[1] != 800;
    if moves && setting {
        return Err(Error::new(&problems::TWO_AXIS_CODES, block.g_range(1)));
    }
    let polar_setting = polar && (setting || block.g[8] == 431 && !given);
    if polar_setting && !(block.g[0] == 520 && no_axes) {
        return Err(Error::new(&problems::POLAR_NO_MOTION, block.range));
    }
    if no_axes {
        return Err(Error::new(&problems::AXES_MISSING_G92, block.g_range(0)));
    }
    if moves {
        if !axes && matches!(block.g[1], 50 | 51 | 330 | 331 | 382..=385 | 730..=790 | 810..=890) {
            return Err(Error::new(&problems::ALL_AXES_MISSING, block.g_range(1)));
        }
    } else if given {
        if axes && !setting {
            return Err(Error::new(&problems::AXES_WITH_G80, block.range));
        }
    } else if axes && block.g[8] == 432 && !setting {
        // observed: polar words move in the mode in effect, which uses the other words, too; axis words are refused later
        block.motion = state.motion;
    } else if setting || tool_offset {
        // the axis words are theirs
    } else if axes {
        if matches!(state.motion, 800 | -1) {
            return Err(Error::new(&problems::AXES_WITHOUT_CODE, first_axis(block)));
        }
        block.motion = state.motion;
    } else if matches!(state.motion, 20 | 30) && [b'I', b'J', b'K'].into_iter().any(|letter| block.has(letter)) {
        // a centre alone means another full circle
        block.motion = state.motion;
    }
    Ok(())
}

/// Axis words without a motion code, while the one in effect may not be modelled: what they do is unknown.
pub(crate) fn modelled(block: &Block, state: &State) -> Result<(), Error> {
    let Some(tenths) = state.unmodelled else { return Ok(()) };
    let setting = matches!(block.g[0], 100 | 280 | 300 | 520 | 920) || matches!(block.g[8], 431 | 432);
    if block.g[1] >= 0 || setting || !block.has_axes() {
        return Ok(());
    }
    let code = match tenths {
        u32::MAX => problems::UNMODELLED.message.to_owned(),
        whole if whole % 10 == 0 => format!("G{}", whole / 10),
        _ => format!("G{}.{}", tenths / 10, tenths % 10),
    };
    Err(Error::with(&problems::UNMODELLED, block.range, code))
}

/// Bytes of the first axis word of the line.
fn first_axis(block: &Block) -> trunnion_syntax::TextRange {
    super::ends::AXES
        .into_iter()
        .filter(|&letter| block.has(letter))
        .map(|letter| block.range_of(letter))
        .min_by_key(|range| range.start)
        .unwrap_or(block.range)
}

/// Combinations of G codes, M codes and words.
pub(crate) fn check(block: &Block, state: &State) -> Result<(), Error> {
    cycles::check_between(block)?;
    match block.g[0] {
        // the control marks an absent P by -1, and takes all other numbers
        40 if block.word(b'P').is_none_or(|p| p == -1.0) => {
            return Err(Error::new(&problems::G4_NO_P, block.g_range(0)));
        }
        40 if matches!(block.g[1], 20 | 30) => return Err(Error::new(&problems::G4_ARC, block.g_range(0))),
        100 => check_g10(block)?,
        530 => {
            if block.g[1] == 52 {
                return Err(Error::new(&problems::G53_SPLINE, block.g_range(0)));
            }
            if !matches!(block.motion, 0 | 10) {
                return Err(Error::new(&problems::G53_MOTION, block.g_range(0)));
            }
            let incremental = match block.g[3] {
                900 => false,
                910 => true,
                _ => state.distance == DistanceMode::Incremental,
            };
            if incremental {
                return Err(Error::new(&problems::G53_INCREMENTAL, block.g_range(0)));
            }
        }
        _ => {}
    }
    unused::check(block)?;
    if block.g[14] == 960 && !block.has(b'S') {
        return Err(Error::new(&problems::G96_NO_S, block.g_range(14)));
    }
    if matches!(block.motion, 330 | 331) {
        if !block.has(b'K') {
            return Err(Error::new(&problems::G33_NO_K, motion::code_range(block)));
        }
        if block.has(b'F') {
            return Err(Error::new(&problems::G33_F, block.range_of(b'F')));
        }
    }
    cycles::check_thread(block)
}

/// A value this near a whole number is taken as whole (observed: within 0.0001 it is, at 0.0005 it is not).
pub(super) const WHOLE: f64 = 0.0002;

fn check_g10(block: &Block) -> Result<(), Error> {
    let written = block.word(b'P');
    let p = written.map(f64::round);
    let p_range = if block.has(b'P') {
        block.range_of(b'P')
    } else {
        block.g_range(0)
    };
    let at_least = |least: f64| p.is_some_and(|p| p.is_nan() || p >= least);
    let code = block.word(b'L').map_or(-1, |l| l as i32);
    // observed: a little less than a whole number is accepted, a little more is not
    let above = written.zip(p).is_some_and(|(written, whole)| written - whole > WHOLE);
    if above && matches!(code, 0 | 1 | 2 | 10 | 11 | 20) {
        return Err(Error::new(&problems::G10_P, p_range));
    }
    match code {
        2 if !at_least(0.0) || p.is_some_and(|p| p > 9.0) => return Err(Error::new(&problems::G10_L2_P, p_range)),
        20 if !at_least(0.0) || p.is_some_and(|p| p > 9.0) => return Err(Error::new(&problems::G10_L20_P, p_range)),
        0 | 2 | 20 => {}
        1 if !at_least(1.0) => return Err(Error::new(&problems::G10_L1_P, p_range)),
        10 if !at_least(1.0) => return Err(Error::new(&problems::G10_L10_P, p_range)),
        11 if !at_least(1.0) => return Err(Error::new(&problems::G10_L11_P, p_range)),
        1 | 10 | 11 => {
            let written = [b'R', b'I', b'J', b'Q'].into_iter().any(|letter| block.has(letter));
            if !written && block.given & crate::block::AXES == 0 {
                return Err(Error::new(&problems::G10_NOTHING, block.g_range(0)));
            }
        }
        _ => return Err(Error::new(&problems::G10_NO_L, block.g_range(0))),
    }
    Ok(())
}
