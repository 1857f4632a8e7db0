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

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check), Wake::Refused(Refusal::ArcRadius, plain)]);

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

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn a_radius_too_small_for_its_chord() {
        let report = assert_drawn(
            "gcode",
            "N10 G17 G90 G0 X0 Y0\nN20 G2 X10 Y0 R4 F300\n;      ^^^ arc-radius-mismatch: no circle of radius 4 mm connects two points 10 mm apart\n",
        );
        assert_eq!(report.summary.errors, 1);
    }
}
