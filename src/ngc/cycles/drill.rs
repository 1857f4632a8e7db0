//! G73, G74, G81-G89: what all have in common, and the motion of each one in the hole.
use super::hole::{self, Axes, Hole};
use super::{Work, problems};
use crate::state::CycleWords;
use crate::{
    Canon, DistanceMode, Error, FeedMode, MotionMode, Problem, RetractMode, Side, SpindleTurn, Start, Stop, Switch,
    Units, exec,
};

/// Whether a motion code is a canned cycle of drilling.
fn is_cycle(code: i16) -> bool {
    matches!(code, 730 | 740 | 810..=890)
}

/// Runs a cycle at each of its places.
pub(super) fn run(work: &mut Work<'_>, code: i16) -> Result<(), Error> {
    let before = work.engine.state.motion;
    let axes = hole::axes(work.engine.state.plane);
    check(work, code, before, axes)?;
    let [first, second, third] = axes.places;
    let start = work.engine.state.current;
    if !is_cycle(before) {
        work.engine.state.cycle.old = start[third];
    }
    let new_code = code != before;
    let words = words(work, axes, code, new_code)?;
    let incremental = work.engine.state.distance == DistanceMode::Incremental;
    let old = words.old;
    let r = if incremental { words.r + old } else { words.r };
    let bottom = if incremental { r + words.cc } else { words.cc };
    if r < bottom {
        let text = problems::R_BELOW
            .message
            .replacen("{}", axes.axis, 1)
            .replacen("{}", axes.plane, 1);
        return Err(Error::with(&problems::R_BELOW, work.block.range_of(b'R'), text));
    }
    let clear = match work.engine.state.retract {
        // of a level that is not known the higher one is not known
        RetractMode::OldZ if old.is_nan() || r.is_nan() => f64::NAN,
        RetractMode::OldZ if old > r => old,
        _ => r,
    };
    let mut hole = Hole {
        places: axes.places,
        at: [start[first], start[second]],
        bottom,
        r,
        clear,
    };
    let mut level = start[third];
    if old < r {
        hole.rapid_beside(work, [start[first], start[second]], r);
        level = r;
    } else if level <= r {
        level = clear;
    } else if r.is_nan() {
        level = f64::NAN;
    }
    let exact = work.engine.state.motion_mode == MotionMode::ExactPath;
    if !exact {
        work.emit(Canon::MotionMode(MotionMode::ExactPath));
    }
    missing(work, code, new_code)?;
    work.engine.state.cycle = words;
    let end = exec::cycle_end(&work.engine.state, work.block)?;
    let step = if incremental {
        [end[first] - start[first], end[second] - start[second]]
    } else {
        hole.at = [end[first], end[second]];
        [0.0; 2]
    };
    let polar = incremental && (work.block.radius.is_some() || work.block.angle.is_some());
    for turn in 0..words.l {
        work.may_go_on()?;
        hole.at = if polar && turn > 0 {
            // each hole is turned and moved out from the one before
            let end = exec::end_of(&work.engine.state, work.block)?;
            [end[first], end[second]]
        } else {
            [hole.at[0] + step[0], hole.at[1] + step[1]]
        };
        hole.rapid(work, level);
        if level != r {
            hole.rapid(work, r);
        }
        drill(work, code, &hole, &words)?;
        // the control assumes the tool at the retract level even if an operator has moved it (G88)
        let pose = hole.pose(work, hole.at, clear);
        work.engine.state.current = pose;
        level = clear;
    }
    if !exact {
        path_control_again(work);
    }
    work.engine.state.motion = code;
    Ok(())
}

/// The path control before the cycle. A machine knows its tolerances in the units of now; `rs274` repeats the numbers.
fn path_control_again(work: &mut Work<'_>) {
    let state = &work.engine.state;
    let factor = match work.engine.setup.start {
        Start::Unknown => state.tolerance_units.mm() / state.units.mm(),
        Start::Zero => 1.0,
    };
    let mode = match state.motion_mode {
        MotionMode::Continuous(tolerance) => MotionMode::Continuous(tolerance * factor),
        mode => mode,
    };
    let naive = state.naive_tolerance * factor;
    work.emit(Canon::MotionMode(mode));
    work.emit(Canon::NaiveCamTolerance(naive));
}

/// What is refused before anything happens, in the control's order.
fn check(work: &Work<'_>, code: i16, before: i16, axes: Axes) -> Result<(), Error> {
    let block = work.block;
    let state = &work.engine.state;
    if state.feed_rate == 0.0 {
        return Err(work.refuse(&problems::ZERO_FEED));
    }
    if state.feed_mode == FeedMode::InverseTime {
        return Err(work.refuse(&problems::INVERSE_TIME));
    }
    if state.side != Side::Off {
        return Err(work.refuse(&problems::COMPENSATED));
    }
    if code != before && !block.has(b'R') {
        return Err(work.refuse(&problems::NO_R));
    }
    if block.word(b'L') == Some(0.0) {
        return Err(Error::new(&problems::ZERO_REPEATS, block.range_of(b'L')));
    }
    let foreign = if axes.places[0] < 3 { b"UVW" } else { b"XYZ" };
    for &letter in foreign {
        if block.has(letter) {
            let article = if letter == b'X' {
                "an X".to_owned()
            } else {
                format!("a {}", char::from(letter))
            };
            let plane = axes.plane.to_uppercase();
            let text = problems::FOREIGN
                .message
                .replacen("{}", &article, 1)
                .replacen("{}", &plane, 1);
            return Err(Error::with(&problems::FOREIGN, block.range_of(letter), text));
        }
    }
    Ok(())
}

/// The words of the block, or those of the blocks before it. They keep the meaning of the distance mode in effect.
fn words(work: &Work<'_>, axes: Axes, code: i16, new_code: bool) -> Result<CycleWords, Error> {
    let block = work.block;
    let mut words = work.engine.state.cycle;
    let letter = b"XYZABCUVW"[axes.places[2]];
    match exec::axis_word(&work.engine.state, block, letter) {
        Some(value) => words.cc = value,
        None if new_code => {
            let axis = axes.axis.to_uppercase();
            let text = problems::NO_BOTTOM
                .message
                .replacen("{}", &axis, 1)
                .replacen("{}", axes.plane, 1);
            return Err(Error::with(&problems::NO_BOTTOM, work.code_range(), text));
        }
        None => {}
    }
    let take = |letter: u8, place: &mut f64| {
        if let Some(value) = block.word(letter) {
            *place = value;
        }
    };
    take(b'R', &mut words.r);
    take(b'P', &mut words.p);
    take(b'Q', &mut words.q);
    if code == 870 {
        take(b'I', &mut words.i);
        take(b'J', &mut words.j);
        take(b'K', &mut words.k);
    }
    words.l = block.word(b'L').map_or(1, |l| l as i32);
    Ok(words)
}

/// Words that a cycle needs when its code is new. The control marks an absent P or Q by -1, so that -1 is taken as absent.
fn missing(work: &Work<'_>, code: i16, new_code: bool) -> Result<(), Error> {
    if !new_code {
        return Ok(());
    }
    let absent = |letter: u8| work.block.word(letter).is_none_or(|value| value == -1.0);
    let without = |letter: u8, problem: &'static Problem| {
        if absent(letter) {
            Err(work.refuse(problem))
        } else {
            Ok(())
        }
    };
    match code {
        730 => without(b'Q', &problems::NO_Q_G73),
        830 => without(b'Q', &problems::NO_Q_G83),
        820 => without(b'P', &problems::NO_P_G82),
        860 => without(b'P', &problems::NO_P_G86),
        880 => without(b'P', &problems::NO_P_G88),
        890 => without(b'P', &problems::NO_P_G89),
        870 => [
            (b'I', &problems::NO_I_G87),
            (b'J', &problems::NO_J_G87),
            (b'K', &problems::NO_K_G87),
        ]
        .into_iter()
        .find(|(letter, _)| !work.block.has(*letter))
        .map_or(Ok(()), |(_, problem)| Err(work.refuse(problem))),
        _ => Ok(()),
    }
}

/// The path in one hole, from the R plane.
fn drill(work: &mut Work<'_>, code: i16, hole: &Hole, words: &CycleWords) -> Result<(), Error> {
    match code {
        730 | 830 => return peck(work, code, hole, words.q),
        740 | 840 => return tap(work, code, hole, words.p),
        870 => return back_bore(work, hole, words),
        _ => {}
    }
    let (spindle, turning) = work.turning();
    if turning == 0 && matches!(code, 860 | 880) {
        return Err(work.refuse(if code == 860 {
            &problems::STILL_G86
        } else {
            &problems::STILL_G88
        }));
    }
    hole.feed(work, hole.bottom);
    if matches!(code, 820 | 860 | 880 | 890) {
        work.emit(Canon::Dwell(words.p));
    }
    if matches!(code, 860 | 880) {
        work.emit(Canon::Spindle(spindle, SpindleTurn::Stop));
    }
    match code {
        850 => {
            hole.feed(work, hole.r);
            hole.rapid(work, hole.clear);
        }
        880 => work.emit(Canon::Stop(Stop::Program)),
        890 => hole.feed(work, hole.clear),
        _ => hole.rapid(work, hole.clear),
    }
    if matches!(code, 860 | 880) {
        work.emit(Canon::Spindle(spindle, direction(turning)));
    }
    Ok(())
}

/// How a spindle that turns is started again.
fn direction(turning: i8) -> SpindleTurn {
    if turning < 0 {
        SpindleTurn::CounterClockwise
    } else {
        SpindleTurn::Clockwise
    }
}

/// G73 breaks chips, G83 clears them: pecks of depth Q, each begun a little above the last one's end.
fn peck(work: &mut Work<'_>, code: i16, hole: &Hole, peck: f64) -> Result<(), Error> {
    if peck <= 0.0 {
        return Err(Error::new(&problems::NO_PECK, work.block.range_of(b'Q')));
    }
    let above = if work.engine.state.units == Units::Inch {
        0.01
    } else {
        0.254
    };
    let mut depth = hole.r - peck;
    while depth > hole.bottom {
        // a peck too small to change the depth would never end
        work.may_go_on()?;
        hole.feed(work, depth);
        if code == 830 {
            hole.rapid(work, hole.r);
        }
        hole.rapid(work, depth + above);
        depth -= peck;
    }
    hole.feed(work, hole.bottom);
    hole.rapid(work, hole.clear);
    Ok(())
}

/// G74 and G84: feed in, reverse the spindle, feed out, without overrides. In the XZ and YZ planes the control emits the coordinates of
/// both feeds in the wrong order; the same is done here, because that is where the machine would go.
fn tap(work: &mut Work<'_>, code: i16, hole: &Hole, dwell: f64) -> Result<(), Error> {
    let (spindle, turning) = work.turning();
    let (still, wrong, expected) = if code == 740 {
        (&problems::STILL_G74, &problems::WRONG_G74, -1)
    } else {
        (&problems::STILL_G84, &problems::WRONG_G84, 1)
    };
    if turning == 0 {
        return Err(work.refuse(still));
    }
    if turning != expected {
        return Err(work.refuse(wrong));
    }
    work.emit(Canon::Switch(Switch::FeedOverride, false));
    work.emit(Canon::Switch(Switch::SpeedOverride(spindle), false));
    mixed_feed(work, hole, hole.bottom);
    work.emit(Canon::Spindle(spindle, SpindleTurn::Stop));
    work.emit(Canon::Spindle(spindle, direction(-turning)));
    work.emit(Canon::Dwell(dwell));
    mixed_feed(work, hole, hole.clear);
    work.emit(Canon::Spindle(spindle, SpindleTurn::Stop));
    work.emit(Canon::Spindle(spindle, direction(turning)));
    if work.engine.state.feed_override {
        work.emit(Canon::Switch(Switch::FeedOverride, true));
    }
    if work.engine.state.speed_override {
        work.emit(Canon::Switch(Switch::SpeedOverride(spindle), true));
    }
    Ok(())
}

/// A feed whose three coordinates are emitted as X, Y, Z in the order of [`tap`].
fn mixed_feed(work: &mut Work<'_>, hole: &Hole, level: f64) {
    let [first, second] = hole.at;
    let order = match hole.places {
        [2, 0, 1] => Some([level, first, second]),
        [1, 2, 0] => Some([second, level, first]),
        _ => None,
    };
    let Some(order) = order else {
        return hole.feed(work, level);
    };
    let mut pose = work.engine.state.current;
    pose[..3].copy_from_slice(&order);
    work.emit(Canon::Feed(pose));
}

/// G87: down next to the hole with the spindle oriented, up into the material with it turning, and out along the same path.
fn back_bore(work: &mut Work<'_>, hole: &Hole, words: &CycleWords) -> Result<(), Error> {
    let (spindle, turning) = work.turning();
    if turning == 0 {
        return Err(work.refuse(&problems::STILL_G87));
    }
    let incremental = work.engine.state.distance == DistanceMode::Incremental;
    let (shift, middle) = match hole.places {
        [2, 0, 1] => ([words.k, words.i], words.j),
        [1, 2, 0] => ([words.j, words.k], words.i),
        _ => ([words.i, words.j], words.k),
    };
    let middle = if incremental { hole.bottom + middle } else { middle };
    let beside = [hole.at[0] + shift[0], hole.at[1] + shift[1]];
    let orient = |work: &mut Work<'_>| {
        work.emit(Canon::Spindle(spindle, SpindleTurn::Stop));
        work.emit(Canon::OrientSpindle(spindle, 0.0, if turning < 0 { 3 } else { 2 }));
    };
    hole.rapid_beside(work, beside, hole.r);
    orient(work);
    hole.rapid_beside(work, beside, hole.bottom);
    hole.rapid(work, hole.bottom);
    work.emit(Canon::Spindle(spindle, direction(turning)));
    hole.feed(work, middle);
    hole.feed(work, hole.bottom);
    orient(work);
    hole.rapid_beside(work, beside, hole.bottom);
    hole.rapid_beside(work, beside, hole.clear);
    hole.rapid(work, hole.clear);
    work.emit(Canon::Spindle(spindle, direction(turning)));
    Ok(())
}
