//! At the programmed feed an axis would need more acceleration in a bend of the path than it has.
//!
//! # Why
//! On a small arc, or where a rotary axis changes its speed, even a constant feed needs acceleration. The control slows down there, or the axis
//! lags behind and the arc becomes smaller than programmed.
//!
//! # Example
//! ```gcode fanuc-30i mill-3axis
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z0.
//! N30 S9000 M3
//! N40 G1 X5. F3000.
//! N50 G2 X5.4 I0.2 J0.
//! ;   ^^^^^^^^^^^^^^^^ axis-acceleration: in this bend
//! N60 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i mill-3axis
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z0.
//! N30 S9000 M3
//! N40 G1 X5. F1000.
//! N50 G2 X5.4 I0.2 J0.
//! N60 M30
//! ```
//!
//! # Guarantee
//! Silence proves nothing. An axis that moves in a cut and declares no acceleration is reported as unknown, once; what depends on it
//! (`dwell-mark`, `feed-oscillation`, `stats --time`) is then unknown too. Feed motions with the spindle on are judged. A bend may use the whole
//! acceleration of an axis. Where the tip is guided while rotary axes turn, the bend is sampled. Consecutive blocks with the same axis are one finding.
//!
//! # Thresholds
//! `amax` of each axis in the machine file; 70 % of the programmed feed.
//!
//! # Sources
//! * docs/kinematics.md#time
use crate::pace::{PaceKind, Place};
use crate::prelude::*;
use trunnion_machine::Machine;

pub(super) const RULE: Body = Body::heuristic(
    Warning,
    &[
        Wake::Pace(PaceKind::Bend, report),
        Wake::Pace(PaceKind::NoAcceleration, undeclared),
    ],
)
.follows_pole_event();

fn report(place: &Place, machine: &Machine, out: &mut Reporter<'_>) {
    let name = machine
        .axes
        .get(usize::from(place.joint))
        .map_or_else(String::new, |axis| letter(axis.letter));
    let (unit, keys) = place.unit();
    out.event(|draft| {
        draft
            .say(format!(
                "in this bend {name} reaches its acceleration at {} {unit}; {} {unit} is programmed",
                number(place.value.round()),
                number(place.feed)
            ))
            .help("reduce the feed here, or make the bend wider")
            .value_text("axis", name)
            .value(keys[0], place.feed)
            .value(keys[1], place.value)
            .fix_feed()
            .spans(place.count, place.last);
    });
}

fn undeclared(place: &Place, machine: &Machine, out: &mut Reporter<'_>) {
    let Some(axis) = machine.axes.get(usize::from(place.joint)) else {
        return;
    };
    let name = letter(axis.letter);
    out.event(|draft| {
        draft
            .at_axis(axis.letter)
            .say(format!(
                "machine {} declares no acceleration for {name}: whether a bend asks for more, where the feed falls in the cut and how long the program takes is not known",
                machine.id
            ))
            .help("declare it in the machine file: dyn = { amax = ... }, in mm/s^2 or deg/s^2")
            .value_text("axis", name)
            .unknown();
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::check_on;
    use crate::{Diagnostic, Status};

    const CUT: &str = "G21 G17 G90 G94\nG0 X0. Y0. Z0.\nS900 M3\nG1 X5. F300.\nY5.\nX9. Y7.\nM30\n";

    fn found(axes: &str) -> Vec<Diagnostic> {
        let text = format!("schema = \"ncmachine/1\"\naxis = [{axes}]\n[control]\nfamily = \"fanuc-30i\"\n");
        let machine = trunnion_machine::load("m", &text).expect("valid");
        let own = |d: &Diagnostic| d.rule == "axis-acceleration";
        let report = check_on(&machine, "fanuc-30i", CUT);
        report.diagnostics.into_iter().filter(own).collect()
    }

    #[test]
    fn an_axis_without_an_acceleration_is_unknown_once() {
        let all = "{letter=\"X\", sign=1, dyn={vmax=200, amax=900}}, {letter=\"Y\", sign=1, dyn={vmax=200, amax=900}}, {letter=\"Z\", sign=1, dyn={vmax=200}}";
        assert_eq!(found(all), [], "Z does not move in a cut");
        let found = found(&all.replacen(
            "dyn={vmax=200, amax=900}}, {letter=\"Z\"",
            "dyn={vmax=200}}, {letter=\"Z\"",
            1,
        ));
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].status, Status::Unknown);
        assert!(
            found[0].message.contains("no acceleration for Y"),
            "{}",
            found[0].message
        );
    }
}
