//! What single axes do.
use super::over_view;
use crate::look::Look;
use crate::view::LegView;
use core::f64::consts::PI;
use trunnion_machine::{Axis, Excess, Machine, Stance, limit_excess};
use trunnion_syntax::Format;

/// A rotary axis turns by more than half a turn.
pub(crate) struct LongTurn<'v> {
    view: &'v LegView<'v>,
    pub(crate) start: &'v Stance,
    pub(crate) end: &'v Stance,
}

impl<'v> LongTurn<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        let [first, second] = look.leg.rotary_change;
        first > PI || second > PI
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let (start, end) = view.stances()?;
        view.turns_far().then_some(Self { view, start, end })
    }
}

/// A joint leaves its travel, or may leave it.
pub(crate) struct OverTravel<'v> {
    view: &'v LegView<'v>,
    /// Joints that do.
    pub(crate) found: Vec<Excess>,
    /// Whether no other joint does.
    pub(crate) settled: bool,
}

impl<'v> OverTravel<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.leaves(|bounds| !bounds.inside)
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let mut found = Vec::new();
        let settled = limit_excess(view.machine, view.leg, &mut found) || view.lever_is_undeclared();
        found.retain(|excess| !view.rests_on_undeclared(excess.axis));
        (!settled || !found.is_empty()).then_some(Self { view, found, settled })
    }
}

/// An axis that winds up a cable, at a known position.
pub(crate) struct CableAxis<'v> {
    view: &'v LegView<'v>,
}

impl<'v> CableAxis<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.of.cable
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let fact = Self { view };
        let known = fact.joints().next().is_some();
        known.then_some(fact)
    }
    /// The joints of such axes and their values, rad.
    pub(crate) fn joints(&self) -> impl Iterator<Item = (usize, f64)> {
        let (joints, known) = (&self.leg.known_joints.0, self.leg.known_joints.1);
        let winds = move |joint: &usize| self.machine.axes[*joint].extra.cable && known & (1 << joint) != 0;
        let rotary = self.machine.rotary.iter().copied().filter(winds);
        rotary.map(|joint| (joint, joints[joint]))
    }
}

/// Any leg on a machine with an axis that must not turn while cutting, or that codes clamp.
pub(crate) struct ClampedTurn<'v> {
    view: &'v LegView<'v>,
}
over_view!(LongTurn, OverTravel, CableAxis, ClampedTurn, IdleTip);

/// The tip is led on a machine without a rotary axis, by a code of the program: APT always speaks of the tip, and needs none.
pub(crate) struct IdleTip<'v> {
    view: &'v LegView<'v>,
}

impl<'v> IdleTip<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.leg.motion.tcp && look.of.machine.rotary.is_empty()
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let by_code = view.dialect.lex.format != Format::Apt;
        (by_code && view.leg.motion.tcp && view.machine.rotary.is_empty()).then_some(Self { view })
    }
}

impl<'v> ClampedTurn<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.of.clamp
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        Self::on(view.machine).then_some(Self { view })
    }
    /// Whether a machine has such an axis.
    pub(crate) fn on(machine: &Machine) -> bool {
        let clamps = |axis: &Axis| axis.extra.clamp || axis.extra.clamp_codes.is_some();
        machine.axes.iter().any(clamps)
    }
}
