//! From here on only one posture of the rotary axes is within their travel.
//!
//! # Why
//! While two postures are possible, the tool can be guided around a limit or the pole by changing from one to the
//! other. Beyond a limit of the tilting axis only one is left: there the program can neither be unwound nor take the other posture, and
//! another machine may not reach the position at all.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A25 C0
//! N30 G1 X10 A35 F500
//! ;          ^^^ only-one-posture: only one posture is left: the other would need A = -35 deg
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A25 C0
//! N30 G1 X10 A29 F500
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for feed motions under tool centre point control between known positions; reported where the second
//! posture is lost.
//!
//! # Sources
//! * docs/kinematics.md#two-postures
use crate::prelude::*;
use trunnion_machine::Limits;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::OneSidedCut(check)]);

fn check(cut: &facts::OneSidedCut<'_>, out: &mut Reporter<'_>) {
    let axis = &cut.machine.axes[cut.joint];
    out.event(|draft| {
        let name = letter(axis.letter);
        draft
            .at_orientation()
            .say(format!(
                "only one posture is left: the other would need {name} = {}, outside its travel",
                degrees(cut.value)
            ))
            .value_text("axis", name)
            .value("value_deg", deg(cut.value));
        if let Limits::Range(low, high) = axis.limits {
            draft.value("limit_deg", deg(if cut.value < low { low } else { high }));
        }
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn it_is_told_once_and_not_for_rapids() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A45 C0\nN30 G1 X10 A35 F500\nN40 G1 X20 A25\nN50 G1 X30 A31\n;          ^^^ only-one-posture: only one posture is left: the other would need A = -31 deg\nN60 G1 X40 A33\nN70 M30\n",
        );
    }
}
