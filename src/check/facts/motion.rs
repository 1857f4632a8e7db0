//! Facts about a motion as programmed.
use crate::view::MotionView;
use core::ops::Deref;
use trunnion_dialect::{Macros, Plane};
use trunnion_interp::{Feed, MotionKind};

/// Facts that add nothing to the view: the rule is woken where the condition holds.
macro_rules! plain {
    ($($(#[$doc:meta])* $fact:ident = |$view:ident| $holds:expr;)*) => {$(
        $(#[$doc])*
        pub(crate) struct $fact<'v>(&'v MotionView<'v>);

        impl<'v> $fact<'v> {
            #[inline]
            pub(crate) fn may($view: &MotionView<'_>) -> bool {
                $holds
            }
            pub(crate) fn of(view: &'v MotionView<'v>) -> Option<Self> {
                Self::may(view).then_some(Self(view))
            }
        }

        impl<'v> Deref for $fact<'v> {
            type Target = MotionView<'v>;
            fn deref(&self) -> &Self::Target {
                self.0
            }
        }
    )*};
}

plain! {
    /// The first feed motion after the tool of the feed motions changed.
    FirstCut = |view| view.motion.is_feed() && view.motion.tool != view.last_cut;
    /// A feed motion with the tool of the one before, which had a length that is not in effect any more.
    LengthLeft = |view| view.motion.is_feed()
        && view.motion.tool == view.last_cut
        && view.last_length.is_some_and(|last| view.in_force.tool_length_mm.is_none() || view.in_force.length_of != last);
    /// The first rapid to another Z with a tool, before its first feed motion.
    FirstApproach = |view| view.motion.tool != view.last_approach && view.approaches();
    /// A motion in G18 or G19 with a length, where the plane says along which axis the length acts.
    LengthOffZ = |view| view.in_force.plane != Plane::Xy
        && view.in_force.tool_length_mm.is_some_and(|length| length != 0.0)
        && !view.motion.tcp
        && !view.motion.machine_coordinates
        && view.dialect.quirks.edge_at_tool_change
        && !view.dialect.quirks.diameter;
    /// A feed motion under constant surface speed without a limit of the spindle speed, where the control wants one.
    CutSpindleUnlimited = |view| view.in_force.surface_speed
        && view.in_force.spindle_limit_rpm.is_none()
        && view.motion.is_feed()
        && view.motion.spindle_on != Some(false)
        && view.dialect.advice.spindle_limit.is_some();
    /// A length of which nothing says whether it is inch or mm.
    UnsaidUnits = |view| !view.in_force.unit_programmed && view.changes_a_length();
}

/// A helix whose F may be that of its arc alone, where a parameter of the control decides.
pub(crate) struct SteepHelix<'v> {
    view: &'v MotionView<'v>,
    /// How much longer the helix is than its arc.
    pub(crate) ratio: f64,
}

impl<'v> SteepHelix<'v> {
    /// A helix that is longer than its arc by less is none here: a feed is not known better.
    const LEAST: f64 = 1.01;

    #[inline]
    pub(crate) fn may(view: &MotionView<'_>) -> bool {
        matches!(view.motion.kind, MotionKind::Arc(_)) && view.dialect.quirks.macros == Macros::Fanuc
    }
    pub(crate) fn of(view: &'v MotionView<'v>) -> Option<Self> {
        let MotionKind::Arc(Some(arc)) = view.motion.kind else {
            return None;
        };
        let by_path = matches!(view.motion.feed, Feed::PerMinute(_) | Feed::PerRevolution(_));
        let along = (arc.end - arc.start).dot(&arc.normal);
        let around = arc.sweep.abs() * 0.5 * (arc.radius_start + arc.radius_end);
        let ratio = trunnion_geometry::math::hypot(along, around) / around;
        (Self::may(view) && by_path && ratio.is_finite() && ratio > Self::LEAST).then_some(Self { view, ratio })
    }
}

impl<'v> Deref for SteepHelix<'v> {
    type Target = MotionView<'v>;
    fn deref(&self) -> &Self::Target {
        self.view
    }
}
