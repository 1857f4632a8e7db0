//! Cuts in which axes travel far for little motion of the tool.
use super::{Cut, over_view};
use crate::look::Look;
use crate::view::LegView;
use trunnion_geometry::rad;
use trunnion_machine::{LinearTravel, Machine, linear_travel};

/// A cut in which the linear axes may travel farther than the allowed ratio to the tip's travel.
pub(crate) struct FarCut<'v> {
    view: &'v LegView<'v>,
    /// Travel of the tip on the part, mm.
    pub(crate) tip_mm: f64,
    /// How far the linear axes may travel, mm.
    pub(crate) allowed_mm: f64,
    /// How far they travel, between bounds; the upper one is above what is allowed.
    pub(crate) travel: LinearTravel,
}

impl<'v> FarCut<'v> {
    /// A shorter tip path is taken as this, mm.
    pub(crate) const LEAST_MM: f64 = 0.1;

    /// How far the linear joints may run while the tip runs `tip_mm`, mm.
    #[inline]
    fn allowed(machine: &Machine, tip_mm: f64) -> f64 {
        machine.tolerances.linear_ratio * tip_mm.max(Self::LEAST_MM)
    }
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        let near = |linear_mm: f64, tip_mm: f64| linear_mm <= Self::allowed(look.of.machine, tip_mm);
        look.turning_cut && look.leaves(|bounds| !near(bounds.linear_mm, bounds.tip_mm))
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let cut = Cut::turning(view).filter(|cut| !cut.lever_is_undeclared())?;
        let tip_mm = if view.leads_tip() && !view.motion().machine_coordinates {
            view.leg.length
        } else {
            cut.start.tip_distance_to(cut.end)
        };
        let allowed_mm = Self::allowed(view.machine, tip_mm);
        let travel = linear_travel(view.machine, view.leg, allowed_mm)?;
        let kept = travel.most_mm <= allowed_mm;
        (!kept).then_some(Self {
            view,
            tip_mm,
            allowed_mm,
            travel,
        })
    }
}

/// A cut after which the rotary axes have turned farther in ten blocks than the allowed ratio to the tool axis.
pub(crate) struct WindingCut<'v> {
    view: &'v LegView<'v>,
    /// Turn of the rotary axes, rad.
    pub(crate) turned: f64,
    /// Turn of the tool axis, rad.
    pub(crate) tilted: f64,
}
over_view!(FarCut, WindingCut);

impl<'v> WindingCut<'v> {
    /// A smaller turn of the tool axis is taken as this, deg.
    pub(crate) const LEAST_DEG: f64 = 0.1;

    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        let ratio = look.of.machine.tolerances.rotary_ratio;
        look.turning_cut && look.trail.may_exceed(ratio, rad(Self::LEAST_DEG))
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        Cut::turning(view)?;
        let ratio = view.machine.tolerances.rotary_ratio;
        let (turned, tilted) = view.trail.excess_turn(ratio, rad(Self::LEAST_DEG))?;
        Some(Self { view, turned, tilted })
    }
}
