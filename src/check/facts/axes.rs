//! What single axes do.
use super::over_view;
use crate::look::Look;
use crate::view::LegView;
use core::f64::consts::PI;
use trunnion_machine::{Axis, AxisKind, Excess, Machine, Stance, limit_excess};
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
over_view!(LongTurn, OverTravel, CableAxis, ClampedTurn, IdleTip, NoTravel);

/// Linear axes move whose travel the machine file does not declare.
pub(crate) struct NoTravel<'v> {
    view: &'v LegView<'v>,
}

impl<'v> NoTravel<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.of.no_travel
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let fact = Self { view };
        let moves = fact.axes().next().is_some();
        moves.then_some(fact)
    }
    /// Whether a machine has such an axis.
    pub(crate) fn on(machine: &Machine) -> bool {
        machine.axes.iter().any(Self::undeclared)
    }
    fn undeclared(axis: &Axis) -> bool {
        axis.kind == AxisKind::Linear && !axis.extra.limits_declared
    }
    /// The axes.
    pub(crate) fn axes(&self) -> impl Iterator<Item = &Axis> {
        let leg = self.view.leg;
        let start = leg.start.as_ref().map(|start| start.joints);
        let end = leg.end.as_ref().ok().map(|end| end.joints);
        let axes = self.view.machine.axes.iter().enumerate();
        axes.filter(move |(joint, axis)| {
            let moves = start
                .zip(end)
                .is_some_and(|(start, end)| (end[*joint] - start[*joint]).abs() > 1e-9);
            moves && Self::undeclared(axis)
        })
        .map(|(_, axis)| axis)
    }
}

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
