//! What a motion or leg must be like for a rule to have anything to say of it: most rules are not asked about most of them.
use crate::rule::InForce;
use crate::rules::{excess_linear_travel, excess_rotary_travel, fast_pole, position_unknown};
use crate::trail::Trail;
use crate::view::{leads_tip, turns};
use core::f64::consts::PI;
use trunnion_interp::{Feed, Motion, Orientation};
use trunnion_machine::{Allowances, Leg, Machine, RotaryRadii, quick_bounds};

/// Things that must hold of a motion or leg, all of them, before a rule is asked; without one of them the rule says nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Needs(u32);

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
    /// No stance at the end, or an arc from where nobody knows.
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

    /// A joint that may leave its travel.
    pub const BEYOND: Self = Self(1 << 14);
    /// A tip that may leave its segment by more than the tolerance.
    pub const STRAYS: Self = Self(1 << 15);
    /// An axis that may have to hold the feed back, or one without a declared speed.
    pub const HURRIES: Self = Self(1 << 16);
    /// Linear joints that may run farther than their ratio to the tip's way allows.
    pub const TRAVELS: Self = Self(1 << 17);
    /// Rotary joints that may have turned farther in the last blocks than their ratio to the tool axis allows.
    pub const WINDS: Self = Self(1 << 18);
    /// A pole that may be too near for the first rotary axis.
    pub const POLE_HURRIES: Self = Self(1 << 19);

    /// A spindle that is off.
    pub const SPINDLE_OFF: Self = Self(1 << 20);
    /// Lengths of which nothing says whether they are inch or mm.
    pub const UNITS_UNSAID: Self = Self(1 << 21);
    /// S as a cutting speed.
    pub const SURFACE_SPEED: Self = Self(1 << 22);
    /// A feed motion with another tool than the feed motion before it.
    pub const FIRST_CUT: Self = Self(1 << 23);
    /// A tool of another length than the control reckons with.
    pub const OTHER_LENGTH: Self = Self(1 << 24);

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
    fn when(self, holds: bool) -> u32 {
        if holds { self.0 } else { 0 }
    }
    /// What holds of a motion as programmed; `last_cut`: the tool of the last feed motion.
    #[inline]
    pub(crate) fn of_motion(motion: &Motion, in_force: &InForce, last_cut: Option<u32>) -> Self {
        Self(
            Self::FEED.when(motion.is_feed())
                | Self::SPINDLE_OFF.when(motion.spindle_on == Some(false))
                | Self::UNITS_UNSAID.when(!in_force.units_said)
                | Self::SURFACE_SPEED.when(in_force.surface_speed)
                | Self::FIRST_CUT.when(motion.is_feed() && motion.tool != last_cut),
        )
    }
}

/// What holds of the legs of one machine.
pub(crate) struct Facts<'m> {
    machine: &'m Machine,
    allowances: Allowances,
    near: RotaryRadii,
    /// What holds of all of them.
    always: u32,
    /// What the words of the last leg are.
    words: u32,
    /// Seconds that the first rotary axis needs for a pass at 1 rad from the pole, per rad.
    pole_pass: f64,
}

impl<'m> Facts<'m> {
    pub(crate) fn new(machine: &'m Machine) -> Self {
        let any = |holds: fn(&trunnion_machine::Axis) -> bool| machine.axes.iter().any(holds);
        let uncertain =
            any(|axis| axis.extra.point_uncertainty.is_some() || axis.extra.direction_uncertainty.is_some());
        Self {
            machine,
            allowances: Allowances::of(machine),
            near: RotaryRadii::default(),
            words: 0,
            always: Needs::CABLE.when(any(|axis| axis.extra.cable))
                | Needs::CLAMP.when(any(|axis| axis.extra.clamp || axis.extra.clamp_codes.is_some()))
                | Needs::UNCERTAIN.when(uncertain),
            pole_pass: machine
                .rotary
                .first()
                .map_or(0.0, |&first| fast_pole::pass(&machine.axes[first])),
        }
    }

    /// What holds of a leg; `next`: its motion differs from that of the leg before as a next line does. `chord`: see [`Trail::add`],
    /// `posture_before` as in [`crate::LegView`].
    #[inline]
    pub(crate) fn of_leg(&mut self, leg: &Leg, next: bool, posture_before: i8, trail: &Trail, chord: f64) -> Needs {
        let machine = self.machine;
        let motion = &leg.motion;
        if !next {
            self.words = Needs::LEADS_TIP.when(leads_tip(motion))
                | Needs::VECTORS.when(matches!(motion.orientation, Orientation::Vector(..)))
                | Needs::OTHER_LENGTH.when(motion.other_length(trail.own_length_mm).is_some());
        }
        let [first, second] = leg.rotary_change;
        let (mut lost, mut crosses) = (true, false);
        if let Ok(end) = &leg.end {
            lost = position_unknown::is_arc_from_nowhere(motion);
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
        Needs(
            self.always
                | Needs::FEED.when(motion.is_feed())
                | Needs::TURNS.when(turns(leg))
                | Needs::TURNS_FAR.when(first > PI || second > PI)
                | self.words
                | Needs::LOST.when(lost)
                | Needs::OPEN.when(leg.open.is_some())
                | Needs::EXCESS.when(leg.rotary_excess > 0.0)
                | Needs::NEAR_POLE.when(near_pole)
                | Needs::CROSSES.when(crosses)
                | Needs::ARRIVES.when(trail.rapids().is_some())
                | self.at_a_glance(leg, trail, chord),
        )
    }

    /// What a look at a line along which all joints run straight cannot rule out; of other legs everything.
    #[inline]
    fn at_a_glance(&mut self, leg: &Leg, trail: &Trail, chord: f64) -> u32 {
        const ALL: u32 = Needs::BEYOND.0
            | Needs::STRAYS.0
            | Needs::HURRIES.0
            | Needs::TRAVELS.0
            | Needs::WINDS.0
            | Needs::POLE_HURRIES.0;
        let machine = self.machine;
        let Some(seen) = quick_bounds(machine, &self.allowances, &mut self.near, leg) else {
            return ALL;
        };
        let tolerances = &machine.tolerances;
        let seconds = match leg.motion.feed {
            Feed::PerMinute(feed) if feed > 0.0 && leg.length > 0.0 => leg.length / feed * 60.0,
            Feed::InverseTime(per_minute) if per_minute > 0.0 && leg.length > 0.0 => 60.0 / per_minute,
            // a look does not do for what F means then
            _ => f64::NAN,
        };
        let held_back = tolerances.feed_drop_warning > 1.0;
        let travels = seen.linear_mm <= excess_linear_travel::allowed(machine, seen.tip_mm);
        // what is not a number rules nothing out
        Needs::BEYOND.when(!seen.inside)
            | Needs::STRAYS.when(!at_most(seen.stray_mm, tolerances.tip_mm))
            | Needs::HURRIES.when(held_back || !at_most(seen.axes_s, seconds))
            | Needs::TRAVELS.when(!travels)
            | Needs::WINDS.when(excess_rotary_travel::winds(machine, trail))
            | Needs::POLE_HURRIES.when(fast_pole::may_hurry(leg, chord, self.pole_pass, seconds))
    }
}

/// Whether a number is known to be at most another.
#[inline]
fn at_most(value: f64, most: f64) -> bool {
    value <= most
}
