//! Over ten feed blocks the rotary axes turn much farther than the tool axis.
//!
//! # Why
//! Close to the pole, or in a posture that does not suit the part, the rotary axes turn back and forth for small
//! changes of direction. The feed drops in block after block, the axes heat up and wear, and the surface shows it.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A2.5 C0
//! N30 G1 X5 C4 F100
//! N31 X10 C0
//! N32 X15 C4
//! N33 X20 C0
//! N34 X25 C4
//! N35 X30 C0
//! N36 X35 C4
//! N37 X40 C0
//! N38 X45 C4
//! N39 X50 C0
//! ;       ^^ excess-rotary-travel: the rotary axes turned 40 deg in ten blocks while the tool axis turned 1.744 deg
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A12.5 C0
//! N30 G1 X5 C4 F100
//! N31 X10 C0
//! N32 X15 C4
//! N33 X20 C0
//! N34 X25 C4
//! N35 X30 C0
//! N36 X35 C4
//! N37 X40 C0
//! N38 X45 C4
//! N39 X50 C0
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for machines with two rotary axes: the turns of the last ten feed blocks between known positions are added
//! up, leaving out rapids in between. Fewer than ten blocks are not judged; a single block that turns far is
//! `pole-flip` or `branch-swap`. A turn of the tool axis below 0.1 deg counts as 0.1 deg. Without tool centre point
//! control, blocks in which the tool axis does not turn are left out: there a rotary table feeds the part under the
//! tool. Consecutive blocks are reported as one.
//!
//! # Thresholds
//! `rotary_ratio`: 20, the turn of both rotary axes divided by the turn of the tool axis.
//!
//! # Sources
//! * docs/kinematics.md#travel-ratios
use crate::prelude::*;
use trunnion_geometry::rad;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::WindingCut(check)]).follows_pole_event();

fn check(cut: &facts::WindingCut<'_>, out: &mut Reporter<'_>) {
    const LEAST_DEG: f64 = facts::WindingCut::LEAST_DEG;
    let ratio = cut.machine.tolerances.rotary_ratio;
    let times = cut.turned / cut.tilted.max(rad(LEAST_DEG));
    out.finding(cut, Merge::run(0, times), |draft| {
        draft
            .at_orientation()
            .say(format!(
                "the rotary axes turned {} in ten blocks while the tool axis turned {}",
                degrees(cut.turned),
                degrees(cut.tilted)
            ))
            .note(format!(
                "{} times as far; up to {} times is allowed, and a turn of the tool axis below {LEAST_DEG} deg counts as {LEAST_DEG} deg",
                number(times),
                number(ratio)
            ))
            .help("tilt the path away from the pole, or program the rotary positions of the posture that turns less")
            .value("rotary_change_deg", deg(cut.turned))
            .value("tool_axis_change_deg", deg(cut.tilted))
            .value("limit_deg", ratio * deg(cut.tilted).max(LEAST_DEG))
            .fix_pole(cut)
            .fix_turns(cut)
            .fix_posture(cut);
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::Fixture;
    use std::fmt::Write;

    fn count(before: &str, blocks: u32) -> usize {
        let mut text = String::from(before);
        for i in 1..=blocks {
            let _ = writeln!(text, "G1 X{} C{} F100", i * 5, 4 * (i % 2));
        }
        let report = Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text)
            .check()
            .unwrap();
        let own = report.diagnostics.iter().filter(|d| d.rule == "excess-rotary-travel");
        own.map(|d| d.count as usize).sum()
    }

    #[test]
    fn ten_blocks_make_a_window() {
        let tcp = "TRAORI\nG0 X0 Y0 Z50 A2.5 C0\n";
        assert_eq!(count(tcp, 9), 0);
        assert_eq!(count(tcp, 10), 1);
        assert_eq!(count(tcp, 12), 3);
        // 4 deg of C at a tilt of 2.866 deg turn the tool axis by 0.2 deg: 20 times
        assert_eq!(count("TRAORI\nG0 X0 Y0 Z50 A2.87 C0\n", 10), 0);
    }

    #[test]
    fn a_table_that_turns_under_a_standing_tool_is_a_feed() {
        assert_eq!(count("G0 X0 Y0 Z50 A0 C0\n", 12), 0);
        assert_eq!(count("TRAORI\nG0 X0 Y0 Z50 A0 C0\n", 12), 3);
    }
}
