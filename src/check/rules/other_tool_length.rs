//! Rotary axes turn in a cut while the control compensates a length other than that of the tool in use.
//!
//! # Why
//! The control guides the point at the compensated length below the gauge point of the spindle. Where that
//! point is not the tip (no G43, or the H number of another tool), every turn of the tool against the workpiece
//! carries the tip around that point: findings about that point's path do not hold for the tip's path.
//!
//! # Example
//! ```gcode fanuc-30i mikron-ucp710
//! (trunnion: tool 1 length 120)
//! N10 T1 M6
//! N20 M3 S5000
//! N30 G0 G43 H1 X0. Y0. Z150. A0. C0.
//! N40 G1 Z149. F200.
//! N50 G49 G0 Z150.
//! N60 G1 A0.05
//! ;   ^^^^^^^^ other-tool-length: T1 is 120 mm long, but the active length compensation is 0 mm
//! N70 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i mikron-ucp710
//! (trunnion: tool 1 length 120)
//! N10 T1 M6
//! N20 M3 S5000
//! N30 G0 G43 H1 X0. Y0. Z150. A0. C0.
//! N40 G1 Z149. F200.
//! N60 G1 A0.05
//! N70 M30
//! ```
//!
//! # Guarantee
//! Sound for tools of declared length: where the path of the tip depends on a length that is not the tool's own,
//! the verdict is unknown, once for each tool and length. Findings of other rules hold for the point that the
//! control guides. Where nothing turns, the tip moves parallel to that point, and `missing-tool-length` judges it.
//!
//! # Sources
//! * docs/kinematics.md#machine-model
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::OtherLength(check)]);

fn check(cut: &facts::OtherLength<'_>, out: &mut Reporter<'_>) {
    let (motion, own) = (cut.motion(), cut.own_mm);
    let key = u64::from(motion.tool.unwrap_or_default()) ^ motion.tool_length_mm.to_bits();
    out.unknown(cut, Merge::once(key), |draft| {
        let tool = motion
            .tool
            .map_or_else(|| "the tool".to_owned(), |tool| format!("T{tool}"));
        draft
            .say(format!(
                "{tool} is {} long, but the active length compensation is {}: the path of its tip is not judged while rotary axes turn",
                mm(own),
                mm(motion.tool_length_mm)
            ))
            .help("activate the tool's own length (G43 H), or declare the length that is meant")
            .value("tool_length_mm", own)
            .value("length_in_force_mm", motion.tool_length_mm);
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    const TOOLS: &str = "(trunnion: tool 1 length 120)\n(trunnion: tool 5 length 80.5)\n";

    /// A turn out of the cut is not judged, nor one with the tool's own length.
    #[test]
    fn told_once_for_each_length_in_force() {
        assert_drawn(
            "gcode linuxcnc mikron-ucp710",
            &format!(
                "{TOOLS}T1 M6 S100 M3\nG43 H5 G0 X0 Y0 Z200 A0 C0\nA1\nG93 G1 A1.1 F100\n;^^^^^^^^^^^^^^^ missing-tool-length: T1 is 120 mm long\n;^^^^^^^^^^^^^^^ other-tool-length: T1 is 120 mm long, but the active length compensation is 80.5 mm\nA1.2 F100\nG43 H1\nA1.3 F100\nG49\nA1.4 F100\n;^^^^^^^^ other-tool-length: T1 is 120 mm long, but the active length compensation is 0 mm\nM2\n"
            ),
        );
    }

    #[test]
    fn a_led_tip_is_led_by_the_length_in_force() {
        let report = assert_drawn(
            "gcode fanuc-30i mikron-ucp710",
            &format!(
                "{TOOLS}T1 M6\nM3 S100\nG43.4 H5\nG0 X0. Y0. Z200. A0. C0.\nG1 X40. A10. F100.\n;^^^^^^^^^^^^^^^^^ other-tool-length: T1 is 120 mm long, but the active length compensation is 80.5 mm\nM30\n"
            ),
        );
        assert_eq!(report.verdict(crate::Severity::Error), crate::Verdict::Unknown);
    }
}
