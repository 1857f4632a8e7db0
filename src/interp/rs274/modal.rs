//! The modal state for rules.
use super::frames::Shift;
use crate::{Beside, FeedMode, ModalState};
use trunnion_dialect::Action;
use trunnion_ngc::{DistanceMode, Side, State};

/// The motion code in effect; 800 is G80.
fn motion(code: i16) -> Option<Action> {
    Some(match code {
        0 => Action::Rapid,
        10 => Action::Linear,
        20 => Action::ArcClockwise,
        30 => Action::ArcCounterClockwise,
        730 | 740 | 810..=890 => Action::CannedCycle,
        _ if code < 0 || code == 800 => return None,
        _ => Action::NotModelled,
    })
}

/// Compensation with a radius of zero that the program does not give: nothing declares the tool.
pub(super) fn lacks_radius(state: &State) -> bool {
    state.side != Side::Off && state.radius == 0.0 && !state.radius_given
}

/// Copies the modal state of the interpreter except feed, spindle, tool and offsets, which calls set in step with motions.
pub(super) fn refresh(modal: &mut ModalState, state: &State, shift: &Shift) {
    modal.motion = motion(state.motion);
    modal
        .coordinates
        .set_incremental(state.distance == DistanceMode::Incremental);
    modal
        .coordinates
        .set_arc_centre_absolute(state.arc_distance == DistanceMode::Absolute);
    modal.feed.set_mode(match state.feed_mode {
        trunnion_ngc::FeedMode::InverseTime => FeedMode::InverseTime,
        trunnion_ngc::FeedMode::PerMinute => FeedMode::PerMinute,
        trunnion_ngc::FeedMode::PerRevolution => FeedMode::PerRevolution,
    });
    refresh_feed(modal, state);
    modal.compensation = match state.side {
        Side::Off => 0,
        Side::Left => 41,
        Side::Right => 42,
    };
    modal.beside = if lacks_radius(state) {
        Beside::Radius
    } else {
        Beside::Computed
    };
    modal.zero.set(shift.zero);
}

/// The same after a line of a motion and its F only.
#[inline]
pub(super) fn refresh_motion(modal: &mut ModalState, state: &State) {
    modal.motion = motion(state.motion);
    refresh_feed(modal, state);
}

fn refresh_feed(modal: &mut ModalState, state: &State) {
    if modal.feed.mode() == FeedMode::InverseTime {
        modal.feed.set((state.inverse_time > 0.0).then_some(state.inverse_time));
    }
}
