//! Feed motions between known positions.
use super::over_view;
use crate::look::{Look, at_most};
use crate::view::LegView;
use trunnion_interp::{MotionKind, Orientation, Swivel};
use trunnion_machine::Stance;

/// A feed motion between two known positions.
pub(crate) struct Cut<'v> {
    pub(super) view: &'v LegView<'v>,
    pub(crate) start: &'v Stance,
    pub(crate) end: &'v Stance,
}

impl<'v> Cut<'v> {
    #[inline]
    pub(super) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let (start, end) = view.stances()?;
        view.motion().is_feed().then_some(Self { view, start, end })
    }
    /// The same, where a rotary axis turns.
    pub(super) fn turning(view: &'v LegView<'v>) -> Option<Self> {
        Self::of(view).filter(|cut| cut.rotary_turns())
    }
}

/// Cuts for which a full condition holds, after a cheap first test.
macro_rules! cuts {
    ($($(#[$doc:meta])* $fact:ident: |$look:ident| $may:expr, |$cut:ident| $holds:expr;)*) => {$(
        $(#[$doc])*
        pub(crate) struct $fact<'v>(Cut<'v>);

        impl<'v> $fact<'v> {
            #[inline]
            pub(crate) fn may($look: &Look<'_>) -> bool {
                $may
            }
            pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
                Cut::of(view).filter(|$cut| $holds).map(Self)
            }
        }

        impl<'v> core::ops::Deref for $fact<'v> {
            type Target = Cut<'v>;
            fn deref(&self) -> &Self::Target {
                &self.0
            }
        }
    )*};
}

cuts! {
    /// A cut that may leave the programmed segment by more than the tolerance, or that runs point to point; not an arc whose centre a fault removed.
    StrayingCut:
        |look| look.cut && look.leaves(|bounds| !at_most(bounds.stray_mm, look.of.machine.tolerances.tip_mm)),
        |cut| !matches!(cut.motion().kind, MotionKind::Arc(None)) && !cut.lever_is_undeclared();
    /// A cut that an axis may have to hold back, or in which one without a declared speed may move.
    HeldBackCut:
        |look| look.cut && look.leaves(|bounds| {
            look.of.machine.tolerances.feed_drop_warning > 1.0 || !at_most(bounds.axes_s, look.seconds)
        }),
        |_cut| true;
    /// A turning cut between tool vectors, whose path between them the program prescribes.
    VectorCut:
        |look| look.turning_cut && matches!(look.leg.motion.orientation, Orientation::Vector(..)),
        |cut| {
            let led = cut.motion().tilt.swivel != Swivel::PointToPoint;
            led && cut.rotary_turns() && matches!(cut.motion().orientation, Orientation::Vector(..))
        };
    /// A cut on a machine whose file says how well an axis is known.
    UncertainCut: |look| look.cut && look.of.uncertain, |cut| !cut.lever_is_undeclared();
}

/// A turning cut with a tool of a length other than the active compensation.
pub(crate) struct OtherLength<'v> {
    view: &'v LegView<'v>,
    /// Declared length of the tool, mm.
    pub(crate) own_mm: f64,
}
over_view!(Cut, OtherLength);

impl<'v> OtherLength<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.turning_cut && look.leg.motion.other_length(look.trail.own_length_mm).is_some()
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let own_mm = view.motion().other_length(view.trail.own_length_mm)?;
        Cut::turning(view).map(|_| Self { view, own_mm })
    }
}
