//! G2 and G3: centre or radius format, in the three planes, with turns and a straight third coordinate.
use super::{ends, motion, problems};
use crate::{
    At, Block, Canon, Class, DistanceMode, Engine, Error, FeedMode, Plane, Pose, Problem, Side, Sink, Units, comp,
};
use std::f64::consts::{PI, SQRT_2};
use trunnion_geometry::math;

macro_rules! problems {
    ($($name:ident $class:ident $message:literal $help:literal)*) => {
        $(const $name: Problem = Problem { class: Class::$class, message: $message, help: $help };)*
    };
}

problems! {
    NO_CENTRE ArcCentre "R i j k words all missing for arc" "Add the centre (I, J, K) or the radius (R)."
    MIXED ArcCentre "Mixed radius ijk format for arc" "Write either the centre or the radius."
    NO_END_XY ArcCentre "X and y words missing for arc in xy plane" "With R the end must be a different point: write X or Y, or write the centre for a full circle."
    NO_END_XZ ArcCentre "X and z words missing for arc in xz plane" "With R the end must be a different point: write X or Z, or write the centre for a full circle."
    NO_END_YZ ArcCentre "Y and z words missing for arc in yz plane" "With R the end must be a different point: write Y or Z, or write the centre for a full circle."
    I_IN_YZ UnusedWord "I word given for arc in yz plane" "In G19 the centre is written as J and K."
    J_IN_XZ UnusedWord "J word given for arc in xz plane" "In G18 the centre is written as I and K."
    K_IN_XY UnusedWord "K word given for arc in xy plane" "In G17 the centre is written as I and J."
    I_MISSING ArcCentre "I word missing in absolute center arc" "Under G90.1 both coordinates of the centre are needed."
    J_MISSING ArcCentre "J word missing in absolute center arc" "Under G90.1 both coordinates of the centre are needed."
    K_MISSING ArcCentre "K word missing in absolute center arc" "Under G90.1 both coordinates of the centre are needed."
    SAME_POINT ArcRadius "Current point same as end point of arc" "Write the centre instead of R for a full circle."
    TOO_SMALL ArcRadius "Arc radius too small to reach end point" "R must be at least half the distance between start and end."
    DIFFERENT ArcRadius "Radius to end of arc differs from radius to start: {}" "Correct the end point or the centre, or write more decimals."
    ZERO ArcRadius "Zero-radius arc: {}" "Correct the centre."
    BEHIND_COMPENSATION Compensation "The move just after exiting cutter compensation mode must be straight, not an arc"
        "Write a straight move after G40 first."
    OTHER_PLANE Other "Cannot do an arc in planes G17.1, G18.1, or G19.1" "Write G17, G18 or G19."
}

/// What depends on the plane: indices of first, second and third coordinate in a pose, letters, centre letters, problems.
pub(super) struct Axes {
    pub(super) places: [usize; 3],
    centre: [u8; 2],
    foreign: u8,
    foreign_problem: &'static Problem,
    no_end: &'static Problem,
    missing: [&'static Problem; 2],
    /// Order in which missing centre words are found.
    first_missing: usize,
}

pub(super) fn axes(plane: Plane) -> Option<Axes> {
    Some(match plane {
        Plane::Xy => Axes {
            places: [0, 1, 2],
            centre: [b'I', b'J'],
            foreign: b'K',
            foreign_problem: &K_IN_XY,
            no_end: &NO_END_XY,
            missing: [&I_MISSING, &J_MISSING],
            first_missing: 0,
        },
        Plane::Xz => Axes {
            places: [2, 0, 1],
            centre: [b'K', b'I'],
            foreign: b'J',
            foreign_problem: &J_IN_XZ,
            no_end: &NO_END_XZ,
            missing: [&K_MISSING, &I_MISSING],
            first_missing: 1,
        },
        Plane::Yz => Axes {
            places: [1, 2, 0],
            centre: [b'J', b'K'],
            foreign: b'I',
            foreign_problem: &I_IN_YZ,
            no_end: &NO_END_YZ,
            missing: [&J_MISSING, &K_MISSING],
            first_missing: 0,
        },
        Plane::Uv | Plane::Uw | Plane::Vw => return None,
    })
}

/// G2, G3.
pub(crate) fn run(engine: &mut Engine, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let range = motion::code_range(block);
    if engine.state.exit_pending {
        return Err(Error::new(&BEHIND_COMPENSATION, range));
    }
    let Some(axes) = axes(engine.state.plane) else {
        return Err(Error::new(&OTHER_PLANE, range));
    };
    let by_radius = block.has(b'R');
    let centre_word = [b'I', b'J', b'K'].into_iter().find(|&letter| block.has(letter));
    match (by_radius, centre_word) {
        (false, None) => return Err(Error::new(&NO_CENTRE, range)),
        (true, Some(letter)) => return Err(Error::new(&MIXED, block.range_of(letter))),
        _ => {}
    }
    motion::check_feed(engine, block, &problems::INVERSE_ARC, &problems::ZERO_FEED_ARC)?;
    if block.has(axes.foreign) {
        return Err(Error::new(axes.foreign_problem, block.range_of(axes.foreign)));
    }
    let [first, second, _] = axes.places;
    let named = |place: usize| block.has(ends::AXES[place]);
    let polar = block.radius.is_some() || block.angle.is_some();
    if by_radius && !named(first) && !named(second) && !polar {
        return Err(Error::new(axes.no_end, range));
    }
    engine.state.motion = block.motion;
    let end = ends::end(&engine.state, block)?;
    let start = engine.state.current;
    let (from, to) = ([start[first], start[second]], [end[first], end[second]]);
    let clockwise = block.motion == 20;
    comp::check_entry_arc(engine, &end, clockwise, block)?;
    let centre = if by_radius {
        by_radius_format(engine.state.units, block, from, to, clockwise)?
    } else {
        by_centre_format(engine, block, &axes, from, to)?
    };
    let turns = block.word(b'P').map_or(1, |p| p.round() as i32);
    let turns = if clockwise { -turns } else { turns };
    sweep(engine, end, centre, turns, block, at, sink)
}

/// One arc in the plane in effect to `end` (program coordinates, contour).
pub(crate) fn sweep(
    engine: &mut Engine,
    end: Pose,
    centre: [f64; 2],
    turns: i32,
    block: &Block,
    at: At,
    sink: &mut dyn Sink,
) -> Result<(), Error> {
    let places = axes(engine.state.plane).map_or([0, 1, 2], |axes| axes.places);
    let length = length(&engine.state.current, &end, centre, turns, places);
    if engine.state.side != Side::Off {
        let arc = comp::Arc {
            end,
            centre,
            turns,
            length,
        };
        return comp::arc(engine, &arc, block, at, sink);
    }
    if engine.state.feed_mode == FeedMode::InverseTime {
        motion::inverse_time(engine, block, length, at, sink);
    }
    engine.state.current = end;
    let [first, second, third] = places;
    let call = Canon::Arc {
        end: [end[first], end[second]],
        centre,
        turns,
        axis_end: end[third],
        others: std::array::from_fn(|axis| end[axis + 3]),
    };
    engine.emit(call, at, sink);
    engine.state.told.reach(&end);
    Ok(())
}

/// Length of a helix, program units.
pub(crate) fn length(from: &Pose, to: &Pose, centre: [f64; 2], turns: i32, places: [usize; 3]) -> f64 {
    let [first, second, third] = places;
    let angle = |pose: &Pose| math::atan2(pose[second] - centre[1], pose[first] - centre[0]);
    let radius = math::hypot(from[first] - centre[0], from[second] - centre[1]);
    let mut swept = angle(to) - angle(from);
    if turns > 0 && swept <= 0.0 {
        swept += 2.0 * PI;
    } else if turns < 0 && swept >= 0.0 {
        swept -= 2.0 * PI;
    }
    swept += 2.0 * PI * f64::from(turns - turns.signum());
    math::hypot(swept * radius, to[third] - from[third])
}

/// The centre from R: the short arc for a positive radius, the long one for a negative one.
fn by_radius_format(
    units: Units,
    block: &Block,
    from: [f64; 2],
    to: [f64; 2],
    clockwise: bool,
) -> Result<[f64; 2], Error> {
    let radius = block.word(b'R').unwrap_or(0.0);
    let size = radius.abs();
    if from == to {
        return Err(Error::new(&SAME_POINT, block.range_of(b'R')));
    }
    let middle = [f64::midpoint(from[0], to[0]), f64::midpoint(from[1], to[1])];
    let half = math::hypot(middle[0] - to[0], middle[1] - to[1]);
    // a chord that is longer by the rounding of the last decimal is a half circle
    let tolerance = if units == Units::Inch { 5e-5 } else { 5e-5 * 25.4 };
    if half - size > tolerance {
        return Err(Error::new(&TOO_SMALL, block.range_of(b'R')));
    }
    let left = clockwise == (radius < 0.0);
    let quarter = if left { PI / 2.0 } else { -PI / 2.0 };
    let direction = math::atan2(to[1] - from[1], to[0] - from[0]) + quarter;
    let ratio = half / size;
    let offset = size * math::cos(if ratio > 1.0 { PI / 2.0 } else { math::asin(ratio) });
    let (sin, cos) = math::sin_cos(direction);
    Ok([middle[0] + offset * cos, middle[1] + offset * sin])
}

/// The centre from I, J, K, with the control's own tolerance between the two radii.
fn by_centre_format(
    engine: &Engine,
    block: &Block,
    axes: &Axes,
    from: [f64; 2],
    to: [f64; 2],
) -> Result<[f64; 2], Error> {
    let state = &engine.state;
    let words = axes.centre.map(|letter| block.word(letter));
    let centre = if state.arc_distance == DistanceMode::Absolute {
        for place in [axes.first_missing, 1 - axes.first_missing] {
            if words[place].is_none() {
                return Err(Error::new(axes.missing[place], motion::code_range(block)));
            }
        }
        words.map(|word| word.unwrap_or(0.0))
    } else {
        [from[0] + words[0].unwrap_or(0.0), from[1] + words[1].unwrap_or(0.0)]
    };
    check_radii(state.units, block, axes, from, to, centre)?;
    Ok(centre)
}

pub(super) fn check_radii(
    units: Units,
    block: &Block,
    axes: &Axes,
    from: [f64; 2],
    to: [f64; 2],
    centre: [f64; 2],
) -> Result<(), Error> {
    let start_radius = math::hypot(centre[0] - from[0], centre[1] - from[1]);
    let end_radius = math::hypot(centre[0] - to[0], centre[1] - to[1]);
    let (absolute, tiny) = match units {
        Units::Inch => (0.002 * SQRT_2, 5e-5),
        Units::Millimetre => (0.02 * SQRT_2, 5e-5 * 25.4),
    };
    let [first, second] = [axes.places[0], axes.places[1]].map(|place| char::from(ends::AXES[place]));
    let point = |p: [f64; 2]| format!("({first}{:.4},{second}{:.4})", p[0], p[1]);
    let points = || {
        format!(
            "start={} center={} end={} r1={start_radius:.4} r2={end_radius:.4}",
            point(from),
            point(centre),
            point(to)
        )
    };
    let range = [axes.centre[0], axes.centre[1]]
        .into_iter()
        .find(|&letter| block.has(letter))
        .map_or(block.range, |letter| block.range_of(letter));
    if start_radius < tiny || end_radius < tiny {
        return Err(Error::with(&ZERO, range, ZERO.message.replace("{}", &points())));
    }
    let error = (start_radius - end_radius).abs();
    let relative = error / start_radius.max(end_radius);
    if error > absolute * 100.0 || (error > absolute && relative > 0.001) {
        let detail = format!(
            "{} abs_err={} rel_err={:.4}%",
            points(),
            general(error),
            relative * 100.0
        );
        return Err(Error::with(&DIFFERENT, range, DIFFERENT.message.replace("{}", &detail)));
    }
    Ok(())
}

/// Four significant digits as C's `%.4g` prints them.
fn general(value: f64) -> String {
    let text = format!("{value:.3e}");
    let exponent = text
        .split_once('e')
        .and_then(|(_, e)| e.parse::<i32>().ok())
        .unwrap_or(0);
    if !(-4..4).contains(&exponent) {
        let (digits, _) = text.split_once('e').unwrap_or((&text, ""));
        let digits = digits.trim_end_matches('0').trim_end_matches('.');
        let sign = if exponent < 0 { '-' } else { '+' };
        return format!("{digits}e{sign}{:02}", exponent.abs());
    }
    let fixed = format!("{value:.*}", (3 - exponent).max(0) as usize);
    if fixed.contains('.') {
        fixed.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        fixed
    }
}
