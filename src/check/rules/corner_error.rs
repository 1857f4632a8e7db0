//! The servo loops cut a corner by more than the tolerance.
//!
//! # Why
//! The axes follow the reference with a lag. At a corner the lag of one axis ends before that of the other begins, and the tool cuts the
//! corner on the inside: material stays, or is gouged at a concave corner.
//!
//! # Example
//! ```gcode fanuc-30i boring-mill-w
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z100. W0. B0.
//! N30 S900 M3
//! N40 G1 X50. F3000.
//! N50 Y50.
//! ;   ^^^^ corner-error: the servo loops cut this corner by
//! N60 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i boring-mill-w
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z100. W0. B0.
//! N30 S900 M3
//! N40 G1 X50. F20.
//! N50 Y50.
//! N60 M30
//! ```
//!
//! # Guarantee
//! Silence proves nothing. A machine that declares `kv` for none of its linear axes has no model of its servo loops and is not judged (the coverage of the check says so); one that declares it for
//! some of the first three, or not the same `kv` and `kff` for all, is unknown, once. The rule needs accelerations, and judges corners
//! between feed motions with the spindle on in which no rotary axis turns. The error is that of a first-order lag, at the planned speed at the
//! corner; `trunnion servo FILE --at LINE` simulates it. Consecutive corners are one finding with the worst of them.
//!
//! # Thresholds
//! `[control] corner.tolerance` of the machine file, else 0.02 mm.
//!
//! # Sources
//! * docs/kinematics.md#servo
use crate::pace::{CORNER, PaceKind, Place};
use crate::prelude::*;
use trunnion_machine::Machine;

pub(super) const RULE: Body = Body::heuristic(
    Warning,
    &[
        Wake::Pace(PaceKind::Corner, report),
        Wake::Pace(PaceKind::UnlikeLoops, unlike),
    ],
)
.needs(|machine| {
    let declared = crate::pace::speaks_of_loops(machine);
    (!declared).then_some("dyn.kv of the first three linear axes")
});

fn report(place: &Place, machine: &Machine, out: &mut Reporter<'_>) {
    let tolerance = machine.control.planning.corner_tolerance.unwrap_or(CORNER);
    out.event(|draft| {
        draft
            .say(format!(
                "the servo loops cut this corner by {}, more than {}, at {} mm/min",
                mm(place.value),
                mm(tolerance),
                number(place.feed.round())
            ))
            .help("reduce the feed at the corner, round it, or stop there exactly; `trunnion servo FILE --at LINE --tolerance-mm MM` says what keeps it")
            .value("value_mm", place.value)
            .value("limit_mm", tolerance)
            .value("feed_mm_min", place.feed)
            .spans(place.count, place.last);
    });
}

fn unlike(_: &Place, machine: &Machine, out: &mut Reporter<'_>) {
    let loops: Vec<String> = machine
        .linear
        .iter()
        .take(3)
        .filter_map(|&joint| machine.axes.get(joint))
        .map(|axis| {
            let gain = axis.extra.position_gain.map_or_else(|| "none".to_owned(), number);
            format!("{} {gain}", letter(axis.letter))
        })
        .collect();
    out.event(|draft| {
        draft
            .say(format!(
                "it is not known by how much the servo loops cut corners: the gains kv of the linear axes are {}",
                loops.join(", ")
            ))
            .help("declare the same dyn.kv and dyn.kff for the first three linear axes; `trunnion servo FILE --at LINE` simulates others")
            .unknown();
    });
}

#[cfg(test)]
mod tests {
    use crate::Status;
    use crate::fixture::check_on;

    #[test]
    fn gains_that_differ_are_unknown_once() {
        let program =
            |feed: u32| format!("G21 G17 G90 G94\nG0 X0. Y0. Z0.\nS900 M3\nG1 X50. F{feed}.\nY50.\nX0.\nM30\n");
        let statuses_at = |y: &str, feed: u32| -> Vec<Status> {
            let axis =
                |letter: &str, kv: &str| format!("{{letter=\"{letter}\", sign=1, dyn={{vmax=200, amax=900{kv}}}}}");
            let axes = [axis("X", ", kv=20"), axis("Y", y), axis("Z", ", kv=20")].join(", ");
            let text = format!(
                "schema = \"ncmachine/1\"\naxis = [{axes}]\n[control]\nfamily = \"fanuc-30i\"\ncorner = {{ model = \"exact-stop\" }}\n"
            );
            let machine = trunnion_machine::load("m", &text).expect("valid");
            let report = check_on(&machine, "fanuc-30i", &program(feed));
            let own = report.diagnostics.iter().filter(|d| d.rule == "corner-error");
            own.map(|d| d.status).collect()
        };
        let statuses = |y: &str| statuses_at(y, 6000);
        assert_eq!(statuses(", kv=30"), [Status::Unknown]);
        assert_eq!(statuses(""), [Status::Unknown]);
        // 0.27 A/Kv^2 = 0.61 mm
        assert_eq!(statuses(", kv=20"), [Status::Fail]);
        // what follows at F20 is 0.017 mm behind, and cuts less than that
        assert_eq!(statuses_at(", kv=20", 20), []);
    }
}
