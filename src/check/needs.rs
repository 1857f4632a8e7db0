//! What a leg must be like for a rule to have anything to say of it: most rules are not asked about most legs.
use crate::trail::Trail;
use crate::view::{leads_tip, turns};
use core::f64::consts::PI;
use trunnion_interp::Orientation;
use trunnion_machine::{Leg, Machine};

/// Things that must hold of a leg, all of them, before a rule is asked; without one of them the rule says nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs(u16);

impl Needs {
    /// Nothing: the rule looks at all legs.
    pub const NOTHING: Self = Self(0);
    /// A feed motion.
    pub const FEED: Self = Self(1);
    /// A rotary joint that turns by more than rounding.
    pub const TURNS: Self = Self(1 << 1);
    /// A rotary joint that turns by more than half a turn.
    pub const TURNS_FAR: Self = Self(1 << 2);
    /// X Y Z of the tip.
    pub const LEADS_TIP: Self = Self(1 << 3);
    /// Tool vectors instead of rotary words.
    pub const VECTORS: Self = Self(1 << 4);
    /// No stance at the end.
    pub const LOST: Self = Self(1 << 5);
    /// A posture that is open.
    pub const OPEN: Self = Self(1 << 6);
    /// More rotary travel than the posture before would need.
    pub const EXCESS: Self = Self(1 << 7);
    /// The pole's cone.
    pub const NEAR_POLE: Self = Self(1 << 8);
    /// Another sign of the posture at the end than before.
    pub const CROSSES: Self = Self(1 << 9);
    /// Rapid motions that led to this one.
    pub const ARRIVES: Self = Self(1 << 10);
    /// A machine with an axis that winds up a cable.
    pub const CABLE: Self = Self(1 << 11);
    /// A machine with an axis that must not turn while cutting, or that codes clamp.
    pub const CLAMP: Self = Self(1 << 12);
    /// A machine whose file says how well an axis is known.
    pub const UNCERTAIN: Self = Self(1 << 13);

    /// This and that.
    pub const fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Whether all of them are among what holds.
    #[inline]
    pub(crate) fn are_met(self, facts: Self) -> bool {
        self.0 & !facts.0 == 0
    }

    #[inline]
    fn when(self, holds: bool) -> u16 {
        if holds { self.0 } else { 0 }
    }

    /// What holds of all legs of a machine.
    pub(crate) fn of_machine(machine: &Machine) -> Self {
        let any = |holds: fn(&trunnion_machine::Axis) -> bool| machine.axes.iter().any(holds);
        let uncertain =
            any(|axis| axis.extra.point_uncertainty.is_some() || axis.extra.direction_uncertainty.is_some());
        Self(
            Self::CABLE.when(any(|axis| axis.extra.cable))
                | Self::CLAMP.when(any(|axis| axis.extra.clamp || axis.extra.clamp_codes.is_some()))
                | Self::UNCERTAIN.when(uncertain),
        )
    }

    /// What holds of a leg, beside what holds of its machine. `posture_before` as in [`crate::LegView`].
    #[inline]
    pub(crate) fn of_leg(self, machine: &Machine, leg: &Leg, posture_before: i8, trail: &Trail) -> Self {
        let motion = &leg.motion;
        let [first, second] = leg.rotary_change;
        let (mut lost, mut crosses) = (true, false);
        if let Ok(end) = &leg.end {
            lost = false;
            crosses = leg.start.as_ref().is_some_and(|start| {
                let before = if start.branch == 0 {
                    posture_before
                } else {
                    start.branch
                };
                before * end.branch < 0
            });
        }
        let near_pole = machine.rotary.len() == 2 && leg.pole_angle_min < machine.tolerances.pole_cone;
        Self(
            self.0
                | Self::FEED.when(motion.is_feed())
                | Self::TURNS.when(turns(leg))
                | Self::TURNS_FAR.when(first > PI || second > PI)
                | Self::LEADS_TIP.when(leads_tip(motion))
                | Self::VECTORS.when(matches!(motion.orientation, Orientation::Vector(..)))
                | Self::LOST.when(lost)
                | Self::OPEN.when(leg.open.is_some())
                | Self::EXCESS.when(leg.rotary_excess > 0.0)
                | Self::NEAR_POLE.when(near_pole)
                | Self::CROSSES.when(crosses)
                | Self::ARRIVES.when(trail.rapids().is_some()),
        )
    }
}
