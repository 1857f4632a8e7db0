//! G33 and G33.1: motion coupled to the spindle.
use super::{Work, problems};
use crate::{Canon, Error, Pose, Problem, Side, SyncedFeed, comp, exec};

/// A feed per revolution of the spindle.
pub(super) fn coupled(per_revolution: f64) -> Canon {
    Canon::StartSync(SyncedFeed {
        per_revolution,
        velocity: false,
    })
}

/// What both need: K, no F.
fn pitch(work: &Work<'_>) -> Result<f64, Error> {
    let Some(pitch) = work.block.word(b'K') else {
        return Err(work.refuse(&problems::NO_PITCH));
    };
    if work.block.has(b'F') {
        return Err(Error::new(&problems::FEED_WITH_PITCH, work.block.range_of(b'F')));
    }
    Ok(pitch)
}

/// The spindle turns.
fn turns(work: &Work<'_>, still: &'static Problem) -> Result<(), Error> {
    if work.turning().1 == 0 {
        Err(work.refuse(still))
    } else {
        Ok(())
    }
}

/// Whether compensation guides the tool next to the contour.
pub(super) fn is_held(work: &Work<'_>) -> bool {
    work.engine.state.side != Side::Off && work.engine.state.radius != 0.0
}

/// A thread under compensation: the control takes G33, G33.1 and G76 as a line along the contour, and refuses it at outside corners.
pub(super) fn along_contour(work: &mut Work<'_>, code: i16, end: Pose) -> Result<(), Error> {
    work.engine.state.motion = code;
    comp::along(work.engine, comp::Kind::Thread, end, work.block, work.at, work.sink)
}

/// G33: one straight motion. Under compensation of the cutter radius the control moves without coupling the feed.
pub(super) fn synchronized(work: &mut Work<'_>) -> Result<(), Error> {
    let pitch = pitch(work)?;
    let end = exec::end_of(&work.engine.state, work.block)?;
    if is_held(work) {
        return along_contour(work, 330, end);
    }
    work.choose_spindle(&problems::SPINDLE_G33)?;
    turns(work, &problems::STILL_G33)?;
    work.engine.state.motion = 330;
    work.emit(coupled(pitch));
    work.engine.state.current = end;
    work.engine.state.exit_pending = false;
    work.emit(Canon::Feed(end));
    work.emit(Canon::StopSync);
    Ok(())
}

/// G33.1: down and back with the spindle reversed; I is how much faster it turns on the retract. The tool ends where it began in X Y Z.
pub(super) fn rigid(work: &mut Work<'_>) -> Result<(), Error> {
    let pitch = pitch(work)?;
    if is_held(work) {
        let end = exec::end_of(&work.engine.state, work.block)?;
        return along_contour(work, 331, end);
    }
    work.choose_spindle(&problems::SPINDLE_G33_1)?;
    turns(work, &problems::STILL_G33_1)?;
    let end = exec::end_of(&work.engine.state, work.block)?;
    let ratio = work.block.word(b'I').unwrap_or(1.0);
    work.engine.state.motion = 331;
    work.emit(coupled(pitch));
    work.emit(Canon::RigidTap([end[0], end[1], end[2]], ratio));
    work.emit(Canon::StopSync);
    // the tool comes back in X Y Z; the other axes are assumed at their end
    let start = work.engine.state.current;
    work.engine.state.current = end;
    work.engine.state.current[..3].copy_from_slice(&start[..3]);
    Ok(())
}
