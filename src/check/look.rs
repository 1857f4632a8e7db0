//! A first look at a leg: what is cheap to see, and rules out most facts of most legs.
use crate::facts::{ClampedTurn, NoTravel, first_pass};
use crate::trail::Trail;
use trunnion_interp::Feed;
use trunnion_machine::{Allowances, Leg, Machine, QuickBounds, RotaryRadii, quick_bounds};

/// What holds for all legs of one machine, and storage for values computed from them.
pub(crate) struct Looker<'m> {
    pub(crate) machine: &'m Machine,
    allowances: Allowances,
    near: RotaryRadii,
    /// The machine has an axis that winds up a cable.
    pub(crate) cable: bool,
    /// It has an axis that must not turn while cutting, or that codes clamp.
    pub(crate) clamp: bool,
    /// It has a linear axis without declared travel.
    pub(crate) no_travel: bool,
    /// Its file says how well an axis is known.
    pub(crate) uncertain: bool,
    /// Seconds that the first rotary axis needs for a pass at 1 rad from the pole, per rad.
    pub(crate) pole_pass: f64,
}

/// See the module. An unknown number rules nothing out.
pub(crate) struct Look<'l> {
    pub(crate) of: &'l Looker<'l>,
    pub(crate) leg: &'l Leg,
    pub(crate) trail: &'l Trail,
    /// As in [`crate::view::LegView`].
    pub(crate) posture_before: i8,
    /// Chord between the tool axes at both ends, see [`Trail::add`].
    pub(crate) chord: f64,
    /// A feed motion between known positions.
    pub(crate) cut: bool,
    /// The same, and a rotary joint turns.
    pub(crate) turning_cut: bool,
    /// For a line along which all joints move linearly.
    pub(crate) bounds: Option<QuickBounds>,
    /// How long the block takes at the programmed feed, s; NaN where the first look cannot decide what F means.
    pub(crate) seconds: f64,
}

impl<'m> Looker<'m> {
    pub(crate) fn new(machine: &'m Machine) -> Self {
        let any = |holds: fn(&trunnion_machine::Axis) -> bool| machine.axes.iter().any(holds);
        Self {
            machine,
            allowances: Allowances::of(machine),
            near: RotaryRadii::default(),
            cable: any(|axis| axis.extra.cable),
            clamp: ClampedTurn::on(machine),
            no_travel: NoTravel::on(machine),
            uncertain: any(|axis| axis.extra.point_uncertainty.is_some() || axis.extra.direction_uncertainty.is_some()),
            pole_pass: first_pass(machine),
        }
    }

    #[inline]
    pub(crate) fn look<'l>(&'l mut self, leg: &'l Leg, posture_before: i8, trail: &'l Trail, chord: f64) -> Look<'l> {
        let bounds = quick_bounds(self.machine, &self.allowances, &mut self.near, leg);
        let cut = leg.motion.is_feed() && leg.start.is_some() && leg.end.is_ok();
        let seconds = match leg.motion.feed {
            Feed::PerMinute(feed) if feed > 0.0 && leg.length > 0.0 => leg.length / feed * 60.0,
            Feed::InverseTime(per_minute) if per_minute > 0.0 && leg.length > 0.0 => 60.0 / per_minute,
            _ => f64::NAN,
        };
        Look {
            of: self,
            leg,
            trail,
            posture_before,
            chord,
            cut,
            turning_cut: cut && trunnion_machine::turns(leg),
            bounds,
            seconds,
        }
    }
}

impl Look<'_> {
    /// Whether the bounds leave something possible; without bounds everything is.
    #[inline]
    pub(crate) fn leaves(&self, possible: impl FnOnce(&QuickBounds) -> bool) -> bool {
        self.bounds.as_ref().is_none_or(possible)
    }
}

/// Whether a number is known to be at most another.
#[inline]
pub(crate) fn at_most(value: f64, most: f64) -> bool {
    value <= most
}
