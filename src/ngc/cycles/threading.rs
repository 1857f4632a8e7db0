//! G76: a thread cut in many passes.
use super::{Work, problems, thread};
use crate::{Block, Canon, Error, Pose, Side, Switch, exec};
use trunnion_geometry::math;

/// The words of a thread, program units, radii.
struct Thread {
    pitch: f64,
    /// From the drive line to the peak.
    peak: f64,
    /// First depth, full depth.
    first: f64,
    full: f64,
    /// Depth of pass n: first times n to the power of 1 / degression.
    degression: f64,
    /// Of the infeed against the X axis.
    tangent: f64,
    springs: i32,
    taper: f64,
    taper_in: bool,
    taper_out: bool,
    start: Pose,
    end: Pose,
}

/// G76.
pub(super) fn run(work: &mut Work<'_>) -> Result<(), Error> {
    if thread::is_held(work) {
        let end = exec::end_of(&work.engine.state, work.block)?;
        return thread::along_contour(work, 760, end);
    }
    let thread = words(work)?;
    work.engine.state.motion = 760;
    // the control counts depths from the drive line, which decides by its rounding whether one more pass is left to do
    let drive = thread.peak.abs();
    let full = thread.full;
    let mut depth = drive + thread.first;
    let mut pass = 1.0;
    while depth < drive + full {
        work.may_go_on()?;
        cut(work, &thread, depth - drive);
        pass += 1.0;
        depth = drive + thread.first * math::pow(pass, 1.0 / thread.degression);
    }
    for _ in 0..=thread.springs.max(-1) {
        work.may_go_on()?;
        cut(work, &thread, full);
    }
    rapid(work, thread.end);
    Ok(())
}

/// The words without which the block does nothing: pitch (the control marks an absent one by -1), peak, first and full depth.
fn needed(block: &Block) -> Result<[f64; 4], Error> {
    let refuse = |problem| Error::new(problem, exec::code_range(block));
    let Some(pitch) = block.word(b'P').filter(|&pitch| pitch != -1.0) else {
        return Err(refuse(&problems::NO_P_G76));
    };
    match (block.word(b'I'), block.word(b'J'), block.word(b'K')) {
        (Some(i), Some(j), Some(k)) => Ok([pitch, i, j, k]),
        _ => Err(refuse(&problems::NO_IJK_G76)),
    }
}

/// What is refused before the block does anything.
pub(super) fn check(block: &Block) -> Result<(), Error> {
    needed(block).map(|_| ())
}

/// Reads and checks the words, in the control's order.
fn words(work: &mut Work<'_>) -> Result<Thread, Error> {
    let block = work.block;
    let [pitch, i, j, k] = needed(block)?;
    work.choose_spindle(&problems::SPINDLE_G76)?;
    let state = &work.engine.state;
    let (spindle, turning) = work.turning();
    if turning == 0 {
        let text = problems::STILL_G76.message.replace("{}", &spindle.to_string());
        return Err(Error::with(&problems::STILL_G76, work.code_range(), text));
    }
    let end = exec::end_of(state, block)?;
    // observed: a rotary word that does not move is taken as none; whether one moves from an unknown position is unknown too
    let moves = |axis: usize| (end[axis] - state.current[axis]).abs() > 0.0;
    if let Some((&letter, _)) = b"ABC".iter().zip(3..).find(|&(_, axis)| moves(axis)) {
        return Err(Error::new(&problems::ROTARY_G76, block.range_of(letter)));
    }
    if state.side != Side::Off {
        return Err(work.refuse(&problems::COMPENSATED_G76));
    }
    if i == 0.0 {
        return Err(Error::new(&problems::ZERO_I_G76, block.range_of(b'I')));
    }
    if j <= 0.0 {
        return Err(Error::new(&problems::ZERO_J_G76, block.range_of(b'J')));
    }
    if k <= j {
        return Err(Error::new(&problems::SMALL_K_G76, block.range_of(b'K')));
    }
    let radius = if state.lathe_diameter { 0.5 } else { 1.0 };
    let taper = block.word(b'E').unwrap_or(0.0);
    let tapers = block.word(b'L').map_or(0, |l| l as i32);
    let degression = block.word(b'R').unwrap_or(1.0);
    let angle = block.word(b'Q').unwrap_or(0.0);
    Ok(Thread {
        pitch,
        peak: i * radius,
        first: j * radius,
        full: k * radius,
        degression: if degression < 1.0 { 1.0 } else { degression },
        tangent: math::tan(angle.to_radians()),
        springs: block.word(b'H').map_or(0, |h| h as i32),
        taper,
        // observed: a taper of zero or negative length is none
        taper_in: matches!(tapers, 1 | 3) && taper > 0.0,
        taper_out: matches!(tapers, 2 | 3) && taper > 0.0,
        start: state.current,
        end,
    })
}

/// Rapid to a pose.
fn rapid(work: &mut Work<'_>, pose: Pose) {
    work.engine.state.current = pose;
    work.emit(Canon::Traverse(pose));
}

/// One pass at a depth below the peak.
fn cut(work: &mut Work<'_>, thread: &Thread, depth: f64) {
    // outside threads (I negative) are cut toward smaller X
    let inward = if thread.peak > 0.0 { 1.0 } else { -1.0 };
    let back = thread.start[0] - inward * (thread.full - depth);
    let peak = back + thread.peak;
    let bottom = thread.start[0] + thread.peak + inward * depth;
    let forward = if thread.end[2] > thread.start[2] { 1.0 } else { -1.0 };
    let first = thread.start[2] + forward * depth * thread.tangent;
    let last = thread.end[2] - forward * (thread.full - depth) * thread.tangent;
    let along = forward * thread.taper;
    let slanted = if thread.taper == 0.0 {
        thread.pitch
    } else {
        thread.pitch * math::hypot(thread.taper, thread.full) / thread.taper
    };
    let at = |x: f64, z: f64| {
        let mut pose = thread.start;
        (pose[0], pose[2]) = (x, z);
        pose
    };
    let feed = |work: &mut Work<'_>, x: f64, z: f64| {
        work.engine.state.current = at(x, z);
        work.emit(Canon::Feed(at(x, z)));
    };
    rapid(work, at(back, first));
    if thread.taper_in {
        work.emit(Canon::Switch(Switch::FeedOverride, false));
        work.emit(thread::coupled(slanted));
        feed(work, peak, first);
        feed(work, bottom, first + along);
    } else {
        rapid(work, at(bottom, first));
        work.emit(Canon::Switch(Switch::FeedOverride, false));
    }
    work.emit(thread::coupled(thread.pitch));
    if thread.taper_out {
        feed(work, bottom, last - along);
        work.emit(thread::coupled(slanted));
        feed(work, peak, last);
    } else {
        feed(work, bottom, last);
    }
    work.emit(Canon::StopSync);
    rapid(work, at(back, last));
    work.emit(Canon::Switch(Switch::FeedOverride, true));
}
