//! Cuts near the pole, where the first rotary axis turns far for a small change of the tool axis.
use super::{Cut, over_view};
use crate::look::Look;
use crate::trail::axes_chord;
use crate::view::LegView;
use core::f64::consts::FRAC_PI_2;
use trunnion_geometry::math::angle_between;
use trunnion_interp::Feed;
use trunnion_machine::{Axis, Leg, Machine};

/// A cut that comes into the pole's cone on a machine with two rotary axes.
pub(crate) struct NearPole<'v> {
    view: &'v LegView<'v>,
}

impl<'v> NearPole<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        let machine = look.of.machine;
        look.cut && machine.rotary.len() == 2 && look.leg.pole_angle_min < machine.tolerances.pole_cone
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        Cut::of(view).filter(|cut| cut.near_pole()).map(|_| Self { view })
    }
}

/// A cut in which the posture changes its sign.
pub(crate) struct PoleCrossing<'v> {
    view: &'v LegView<'v>,
}

impl<'v> PoleCrossing<'v> {
    fn crosses(leg: &Leg, posture_before: i8) -> bool {
        let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
            return false;
        };
        let before = if start.branch == 0 {
            posture_before
        } else {
            start.branch
        };
        before * end.branch < 0
    }
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.cut && Self::crosses(look.leg, look.posture_before)
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let crosses = view.motion().is_feed() && Self::crosses(view.leg, view.posture_before);
        crosses.then_some(Self { view })
    }
}

/// A cut past the pole, nearer than the first rotary axis can follow at the programmed feed.
pub(crate) struct PolePass<'v> {
    view: &'v LegView<'v>,
    /// The first rotary axis.
    pub(crate) axis: &'v Axis,
    /// How long the block takes, s.
    pub(crate) seconds: f64,
    /// Between the tool axes at both ends, rad.
    pub(crate) angle: f64,
    /// How far from the pole the tool axis would have to stay, rad.
    pub(crate) distance: f64,
}
over_view!(NearPole, PoleCrossing, PolePass);

/// Where the first axis turns less than this many times as far as the tool axis the pole is not the cause.
const AMPLIFIED: f64 = 5.0;

/// A tool axis that turns less than this does not turn, rad: 1e-4 deg.
const STILL: f64 = 1.7e-6;

/// Peak acceleration of the first axis on a straight pass is this times w^2 / d^2 (docs/kinematics.md#how-fast-the-first-axis-turns-near-the-pole).
const PASS: f64 = 0.6495;

/// Seconds that an axis needs for a pass at 1 rad from the pole, per rad that the tool axis turns (docs/kinematics.md#how-fast-the-first-axis-turns-near-the-pole).
fn pass(axis: &Axis) -> f64 {
    let by_speed = axis.max_speed.map_or(0.0, |speed| 1.0 / speed);
    let by_acceleration = axis.max_acceleration.map_or(0.0, |limit| (PASS / limit).sqrt());
    by_speed.max(by_acceleration)
}

/// [`pass`] of the first rotary axis.
pub(crate) fn first_pass(machine: &Machine) -> f64 {
    let first = machine.rotary.first();
    first.map_or(0.0, |&first| pass(&machine.axes[first]))
}

/// Whether the pole may be too near, by the chord between the tool axes instead of the angle; `pass` is that of the first rotary axis.
/// Also where the block's time is not a number.
#[inline]
fn may_hurry(leg: &Leg, chord: f64, pass: f64, seconds: f64) -> bool {
    let turn = leg.rotary_change[0];
    if turn == 0.0 {
        return false;
    }
    // an arc is at least its chord, at most pi / 2 times as long, and at most 1.0472 times where the chord is no longer than 1
    let longest = if chord <= 1.0 { 1.05 } else { FRAC_PI_2 };
    let far = leg.pole_angle_min * seconds >= pass * chord * longest * (1.0 + 1e-9);
    !far && turn > AMPLIFIED * chord * (1.0 - 1e-9)
}

impl<'v> PolePass<'v> {
    #[inline]
    pub(crate) fn may(look: &Look<'_>) -> bool {
        look.cut && look.leaves(|_| may_hurry(look.leg, look.chord, look.of.pole_pass, look.seconds))
    }
    pub(crate) fn of(view: &'v LegView<'v>) -> Option<Self> {
        let cut = Cut::of(view)?;
        let turn = view.leg.rotary_change[0];
        if turn == 0.0 || !view.machine.constants.has_pair() {
            return None;
        }
        let axis = &view.machine.axes[view.machine.rotary[0]];
        let (seconds, pass) = (duration(view)?, pass(axis));
        if !may_hurry(view.leg, axes_chord(view.leg), pass, seconds) {
            return None;
        }
        let angle = angle_between(&cut.start.axis, &cut.end.axis);
        let distance = pass * angle / seconds;
        let too_near = view.leg.pole_angle_min < distance && angle > STILL && turn > AMPLIFIED * angle;
        too_near.then_some(Self {
            view,
            axis,
            seconds,
            angle,
            distance,
        })
    }
}

/// How long the block takes at the programmed feed, s.
fn duration(view: &LegView<'_>) -> Option<f64> {
    let seconds = match view.motion().feed {
        Feed::InverseTime(per_minute) => 60.0 / per_minute,
        _ if view.leg.length > 0.0 => view.leg.length / view.programmed_feed()? * 60.0,
        _ => return None,
    };
    (seconds > 0.0 && seconds.is_finite()).then_some(seconds)
}
