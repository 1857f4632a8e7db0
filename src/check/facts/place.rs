//! Where a leg ends, and how it came there.
use super::over_view;
use crate::look::Look;
use crate::trail::Rapids;
use crate::view::LegView;
use trunnion_interp::{Motion, MotionKind};
use trunnion_machine::NoStance;

/// An end at which the machine's position is unknown, or that it cannot reach.
pub(crate) struct LostEnd<'v> {
    view: &'v LegView<'v>,
    pub(crate) why: &'v NoStance,
}

impl<'v> LostEnd<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.leg.end.is_err()
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let why = view.leg.end.as_ref().err()?;
        Some(Self { view, why })
    }
}

/// An arc to a known end that cannot be drawn because X, Y or Z of its start is unknown, as after a switch of tool centre point control.
pub(crate) struct LostArc<'v> {
    view: &'v LegView<'v>,
}

impl<'v> LostArc<'v> {
    fn is(motion: &Motion) -> bool {
        motion.kind == MotionKind::Arc(None) && motion.start.xyz().is_none()
    }
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.leg.end.is_ok() && Self::is(&look.leg.motion)
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        (view.leg.end.is_ok() && Self::is(view.motion())).then_some(Self { view })
    }
}

/// A feed motion to which more than one rapid motion led.
pub(crate) struct Arrival<'v> {
    view: &'v LegView<'v>,
    pub(crate) rapids: &'v Rapids,
}

/// A motion between known positions on a machine with obstacles.
pub(crate) struct Passing<'v> {
    view: &'v LegView<'v>,
}
over_view!(LostEnd, LostArc, Arrival, Passing);

impl<'v> Passing<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        !look.of.machine.obstacles.only_parts()
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let moves = view.stances().is_some() && !matches!(view.motion().kind, MotionKind::Dwell(_));
        (moves && !view.machine.obstacles.only_parts()).then_some(Self { view })
    }
}

impl<'v> Arrival<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.trail.rapids().is_some()
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let rapids = view.trail.rapids().filter(|rapids| rapids.count > 1)?;
        Some(Self { view, rapids })
    }
}
