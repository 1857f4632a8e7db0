//! What F means where rotary axes move, and where a parameter of the control decides that.
use crate::{Leg, Machine, NO_TURN};
use trunnion_dialect::RotaryFeed;
use trunnion_interp::{Feed, Motion, Orientation, Swivel};

/// Whether X Y Z are the position of the tip in the workpiece frame: tool centre point control, or vectors.
pub fn leads_tip(motion: &Motion) -> bool {
    let led = motion.tcp || matches!(motion.orientation, Orientation::Vector(..)) || motion.tilt.normal.is_some();
    led && matches!(motion.tilt.swivel, Swivel::No | Swivel::TipStays)
}

/// Whether a rotary joint turns, by more than rounding.
#[inline]
pub fn turns(leg: &Leg) -> bool {
    leg.rotary_change.iter().any(|change| *change > NO_TURN)
}

/// Whether F is a speed along a path: neither a duration nor unknown.
fn feed_is_along_path(motion: &Motion) -> bool {
    matches!(motion.feed, Feed::PerMinute(_) | Feed::PerRevolution(_))
}

/// Whether rotary axes move under an F whose meaning a parameter of the control decides. Together with linear axes: mm/min of
/// X Y Z, or of the root of mm2 + deg2; the dialect (`rotary_feed`) or the machine file may say which. Tool centre point control means the tip,
/// inverse time a duration. On a Haas also where only they turn, see [`turns_by_diameter`]. Source: docs/kinematics.md#axis-speed-and-feed.
pub fn feed_is_ambiguous(machine: &Machine, rotary_feed: RotaryFeed, leg: &Leg) -> bool {
    let motion = &leg.motion;
    if leads_tip(motion) && !motion.machine_coordinates || !turns(leg) {
        return false;
    }
    if leg.length <= 0.0 {
        return turns_by_diameter(machine, rotary_feed, leg);
    }
    let control = &machine.control;
    let says_which = match rotary_feed {
        RotaryFeed::Language => true,
        RotaryFeed::Family => matches!(control.family.as_str(), "linuxcnc" | "sinumerik-840d"),
        RotaryFeed::Parameter | RotaryFeed::Diameters => false,
    };
    feed_is_along_path(motion) && !says_which && control.feed.is_none()
}

/// Whether only rotary axes turn on a Haas, where F is the speed along circles whose diameters are its settings 34 and 79, so that they
/// may turn faster than by F in degrees. Source: Haas mill operator's manual, G93, where these settings are not needed.
pub fn turns_by_diameter(machine: &Machine, rotary_feed: RotaryFeed, leg: &Leg) -> bool {
    let motion = &leg.motion;
    let only_turns = leg.length <= 0.0 && !leads_tip(motion) && motion.is_feed() && turns(leg);
    let by_diameter = rotary_feed == RotaryFeed::Diameters && machine.control.feed.is_none();
    by_diameter && only_turns && feed_is_along_path(motion)
}
