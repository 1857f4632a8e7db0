//! Which posture the machine takes.
use super::{Cut, over_view};
use crate::look::Look;
use crate::view::LegView;
use core::f64::consts::TAU;
use trunnion_machine::{Limits, Machine, Open, Orientations, Stance, orientations, windings};

/// More rotary travel than the posture before would need.
pub(crate) struct PostureSwap<'v> {
    view: &'v LegView<'v>,
    /// How much more, rad.
    pub(crate) excess: f64,
}

impl<'v> PostureSwap<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.leg.rotary_excess > 0.0
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let excess = view.leg.rotary_excess;
        (excess > view.machine.tolerances.swap_excess).then_some(Self { view, excess })
    }
}

/// An undecided posture.
pub(crate) struct OpenPosture<'v> {
    view: &'v LegView<'v>,
    pub(crate) open: Open,
}

impl<'v> OpenPosture<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.leg.open.is_some()
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        Some(Self {
            view,
            open: view.leg.open?,
        })
    }
}

/// A turning cut with a guided tip, at whose end only one posture is left; at its start there were two.
pub(crate) struct OneSidedCut<'v> {
    view: &'v LegView<'v>,
    /// The joint that makes the other posture illegal.
    pub(crate) joint: usize,
    /// The value it would need, rad.
    pub(crate) value: f64,
}
over_view!(PostureSwap, OpenPosture, OneSidedCut);

impl<'v> OneSidedCut<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.turning_cut && trunnion_machine::leads_tip(&look.leg.motion)
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let (cut, machine) = (Cut::turning(view)?, view.machine);
        let full = |axis: &usize| match machine.axes[*axis].limits {
            Limits::Unbounded => true,
            Limits::Range(low, high) => high - low >= TAU,
        };
        if machine.rotary.len() != 2 || !view.leads_tip() || machine.rotary.iter().all(full) {
            return None;
        }
        let (joint, value) = missing_posture(machine, cut.end)?;
        let new = missing_posture(machine, cut.start).is_none();
        new.then_some(Self { view, joint, value })
    }
}

/// The axis that makes the other posture of a stance illegal, and the value it would need, rad; `None` where two postures are
/// legal or there is only one anyway.
fn missing_posture(machine: &Machine, stance: &Stance) -> Option<(usize, f64)> {
    let Orientations::Postures(postures) = orientations(machine, &stance.axis) else {
        return None;
    };
    let other = postures.iter().find(|posture| posture.branch * stance.branch < 0)?;
    machine.rotary.iter().zip(other.q).find_map(|(&axis, q)| {
        windings(machine, axis, q, stance.joints[axis])
            .is_empty()
            .then_some((axis, q))
    })
}
