//! The start and end of an arc are at different distances from its centre, or no circle of the given radius connects them.
//!
//! # Why
//! The control stops with an alarm, or cuts a spiral without a message. The larger the mismatch, the deeper the
//! gouge.
//!
//! # Example
//! ```gcode
//! N10 G17 G90 G0 X0 Y0
//! N20 G2 X10 Y0 I4 J0 F300
//! ;      ^^^ arc-radius-mismatch: the arc starts 4 mm from its centre and ends 6 mm from it
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G17 G90 G0 X0 Y0
//! N20 G2 X10 Y0 I5 J0 F300
//! ```
//!
//! # Guarantee
//! Sound for arcs whose start is known.
//!
//! # Thresholds
//! `arc_tolerance` of the dialect's table, which names its source.
//!
//! # Sources
//! * NISTIR 6556 (2000), section 3.5.3 on arcs at feed rate (G2, G3).
use crate::prelude::*;
use trunnion_dialect::Action;

const FITS: &str =
    "the end points fit when I J K are coordinates of the centre; here they are distances from the start";

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check), Wake::Refused(Refusal::ArcRadius, refused)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    match fault.kind {
        FaultKind::ArcRadiusMismatch { start, end, tolerance } => {
            out.report(
                fault.range,
                format!(
                    "the arc starts {} from its centre and ends {} from it",
                    mm(start),
                    mm(end)
                ),
            )
            .note(format!(
                "the end point is not on the circle; the two distances may differ by {}",
                mm(tolerance)
            ))
            .help("correct the end point or the centre")
            .value("radius_start_mm", start)
            .value("radius_end_mm", end)
            .value("limit_mm", tolerance);
        }
        FaultKind::ArcFitsAbsolute { start, end } => {
            let absolute = out
                .dialect()
                .codes()
                .iter()
                .any(|code| code.action == Action::ArcCentreAbsolute);
            out.report(
                fault.range,
                format!(
                    "this arc fits absolute I J: as distances they give a start {} and an end {} from the centre",
                    mm(start),
                    mm(end)
                ),
            )
            .note(FITS)
            .help(if absolute {
                "program G90.1 first, or set the post processor to incremental arc centres"
            } else {
                "set the post processor to incremental arc centres: this control has no code for absolute ones"
            })
            .value("radius_start_mm", start)
            .value("radius_end_mm", end)
            .merge(Merge::once(1));
        }
        FaultKind::ArcRadiusTooSmall { radius, half_chord } => {
            out.report(
                fault.range,
                format!(
                    "no circle of radius {} connects two points {} apart",
                    mm(radius),
                    mm(2.0 * half_chord)
                ),
            )
            .note(format!("the radius must be at least half of that, {}", mm(half_chord)))
            .help("correct the end point or the radius")
            .value("radius_mm", radius)
            .value("chord_mm", 2.0 * half_chord)
            .value("limit_mm", half_chord);
        }
        _ => {}
    }
}

/// LinuxCNC names the points; with the centre's words as coordinates the arc may fit.
fn refused(draft: &mut Draft<'_>) {
    if fits_absolute(draft.message()) == Some(true) {
        draft
            .say("this arc fits absolute I J: as distances they give no circle")
            .note(FITS)
            .help("program G90.1 first, or set the post processor to incremental arc centres")
            .merge(Merge::once(1));
    }
}

/// Whether the arc of a message with `start=(X1,Y2) center=(X3,Y4) end=(X5,Y6)` has one radius about the point that its centre's words
/// give as coordinates. `None`: the message has no points, or the arc has no radius.
fn fits_absolute(message: &str) -> Option<bool> {
    /// The limit of LinuxCNC, inch; messages are in the units of the program, and rounded.
    const SAME: f64 = 0.005;
    let point = |name: &str| {
        let (_, rest) = message.split_once(name)?;
        let (inside, _) = rest.split_once(')')?;
        let (first, second) = inside.split_once(',')?;
        Some([
            first.get(1..)?.parse::<f64>().ok()?,
            second.get(1..)?.parse::<f64>().ok()?,
        ])
    };
    let (start, centre, end) = (point("start=(")?, point("center=(")?, point("end=(")?);
    let words = [centre[0] - start[0], centre[1] - start[1]];
    let radius = |from: [f64; 2]| trunnion_geometry::math::hypot(from[0] - words[0], from[1] - words[1]);
    let (start, end) = (radius(start), radius(end));
    (start > SAME).then_some((start - end).abs() <= SAME.max(start * 1e-3))
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn arcs_with_absolute_centres_are_one_finding() {
        let text = "G21 G17 G90 G94\nG0 X10. Y0. Z0.\nG2 X0. Y-10. I0. J0. F100.\n;  ^^^ arc-radius-mismatch: this arc fits absolute I J\nG2 X-10. Y0. I0. J0.\nX0. Y10. I0. J0.\nX10. Y0. I0. J0.\n";
        for dialect in ["iso-6983", "fanuc-30i", "haas-ngc", "grbl"] {
            let report = assert_drawn(&format!("gcode {dialect}"), text);
            assert_eq!(report.diagnostics[0].count, 4, "{dialect}");
        }
        let text = "G21 G17 G90 G94 F100\nG0 X30 Y20 Z0\nG3 X10 Y20 I20 J20\n;          ^^^ arc-radius-mismatch: this arc fits absolute I J\nG3 X30 Y20 I20 J20\nG3 X10 I20 J20\nM2\n";
        let report = assert_drawn("gcode linuxcnc", text);
        // the second is a full circle about another centre
        assert_eq!(report.diagnostics[0].count, 2);
    }

    #[test]
    fn a_radius_too_small_for_its_chord() {
        let report = assert_drawn(
            "gcode",
            "N10 G17 G90 G0 X0 Y0\nN20 G2 X10 Y0 R4 F300\n;      ^^^ arc-radius-mismatch: no circle of radius 4 mm connects two points 10 mm apart\n",
        );
        assert_eq!(report.summary.errors, 1);
    }
}
