//! The tool axis passes through the pole and the posture changes its sign, without needless rotary travel.
//!
//! # Why
//! A crossing is allowed. It is worth knowing because close to it small changes of the program make the first
//! rotary axis flip, and because not every control passes through in the same way.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A5 C0
//! N30 G1 X2 A-5 F500
//! ;         ^^^ pole-crossing: the tool axis passes
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A15 C0
//! N30 G1 X1 A5 F500
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for feed motions between known positions; a stop exactly at the pole belongs to the block that leaves it.
//!
//! # Thresholds
//! `swap_excess`: above that much rotary travel more than the cheapest move of the same posture, it is
//! `branch-swap`.
//!
//! # Sources
//! * docs/kinematics.md#change-of-posture
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::PoleCrossing(check)]).follows_pole_event();

fn check(crossing: &facts::PoleCrossing<'_>, out: &mut Reporter<'_>) {
    let leg = crossing.leg;
    if leg.rotary_excess > crossing.machine.tolerances.swap_excess {
        return;
    }
    let [first, _] = crossing.rotary_letters();
    out.event(|draft| {
        draft
            .at_orientation()
            .say(format!(
                "the tool axis passes {} and the posture changes its sign",
                past_pole(leg.pole_angle_min)
            ))
            .note(format!(
                "at the pole the tool axis is parallel to {first}; {first} turns {}",
                degrees(leg.rotary_change[0])
            ))
            .value("pole_angle_deg", deg(leg.pole_angle_min))
            .value("rotary_change_deg", deg(leg.rotary_change[0]));
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn a_stop_at_the_pole_is_told_where_the_other_side_begins() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A5 C0\nN30 G1 X1 A0 F500\nN40 G1 X2 A-5\n;         ^^^ pole-crossing: \nN50 M30\n",
        );
    }

    #[test]
    fn coming_back_the_same_side_is_no_crossing() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A5 C0\nN30 G1 X1 A0 F500\nN40 G1 X2 A5\nN50 M30\n",
        );
    }
}
