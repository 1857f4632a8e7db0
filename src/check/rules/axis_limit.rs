//! An axis leaves its travel, at the end of a block or inside it.
//!
//! # Why
//! The control stops with an alarm in the middle of the cut, or the axis runs into its limit switch. With tool
//! centre point control a linear axis can leave its travel inside a block although both ends are within it.
//!
//! # Example
//! ```gcode mill-3axis
//! N10 G0 X0 Y0 Z0
//! N20 G0 X5000
//! ;      ^^^^^ axis-limit: X reaches 5000 mm
//! ```
//!
//! # Use instead
//! ```gcode mill-3axis
//! N10 G0 X0 Y0 Z0
//! N20 G0 X50
//! ```
//!
//! # Guarantee
//! Sound for axes whose position is known: inside a block it uses a bound on the motion of the axes, not samples.
//! Where a work offset or tool length is not declared, a chain of linear axes is judged by how far the path spans:
//! it fails if no zero point fits; otherwise the zero points that fit are reported and the result is unknown.
//! A block that passes a position at which the linear axes do not span space is unknown. An axis that was never positioned is not judged. A linear axis without declared travel is unknown. Travel inside a rapid block is unknown where the machine file
//! does not say whether the axes arrive together, and also where it says that they do not while the control guides
//! the tip.
//!
//! # Thresholds
//! The limits of the machine file.
//!
//! # Sources
//! * docs/kinematics.md#between-the-ends-of-a-block
//! * docs/kinematics.md#limits-inside-a-block
use crate::datum::{Missing, Open, Overrun};
use crate::prelude::*;
use trunnion_machine::{AxisKind, RapidPath, passes_singular};

pub(super) const RULE: Body = Body::sound(
    Error,
    &[
        Wake::OverTravel(check),
        Wake::NoTravel(undeclared),
        Wake::Overrun(no_zero_fits),
        Wake::Open(what_fits),
    ],
);

/// Axes that move and declare no travel.
fn undeclared(leg: &facts::NoTravel<'_>, out: &mut Reporter<'_>) {
    let axes: Vec<String> = leg.axes().map(|axis| letter(axis.letter)).collect();
    out.unknown(leg, Merge::once(UNDECLARED), |draft| {
        draft
            .say(format!(
                "{} declares no travel of {}: it is unknown whether the program stays within it",
                leg.machine.id,
                axes.join(", ")
            ))
            .help(
                "write `limits = [low, high]` of each axis into the machine file, in mm, or `limits = \"unbounded\"`",
            );
    });
}

/// The path spans more than the travel.
fn no_zero_fits(overrun: &Overrun, out: &mut Reporter<'_>) {
    let name = letter(overrun.letter);
    let missing = overrun.missing.name(out.dialect());
    let beyond = overrun.span_mm - overrun.travel_mm;
    out.event(|draft| {
        draft
            .at_axis(overrun.letter)
            .say(format!(
                "{name} spans {}, {} more than its travel of {}: no value of {missing} fits",
                mm(overrun.span_mm),
                mm(beyond),
                mm(overrun.travel_mm)
            ))
            .note(format!(
                "{missing} is not declared; this covers all motions that depend on it"
            ))
            .help("divide the program into set-ups, or use a machine with more travel")
            .value_text("axis", name)
            .value("span_mm", overrun.span_mm)
            .value("travel_mm", overrun.travel_mm)
            .value("excess_mm", beyond);
    });
}

/// The zero points with which a chain of linear axes stays within its travel.
fn what_fits(open: &Open, out: &mut Reporter<'_>) {
    if open.fits.is_empty() || !matches!(open.missing, Missing::Offset(_)) {
        return;
    }
    let dialect = out.dialect();
    let missing = open.missing.name(dialect);
    let help = open.missing.help(dialect);
    out.event(|draft| {
        draft.unknown().help(help);
        let mut ranges = Vec::new();
        for fit in &open.fits {
            let name = letter(fit.letter);
            let [low, high] = match fit.range {
                Ok(range) => range,
                Err(unclear) => {
                    draft.note(format!("{name}: unknown, because {}", unclear.why(&missing)));
                    continue;
                }
            };
            let [shown_low, shown_high] = [bound_up(low), bound_down(high)];
            if let Some(of) = fit.with_length {
                let length = Missing::Length(of).name(dialect);
                draft.note(format!(
                    "{name} of {missing} plus {length}: {shown_low} to {shown_high}"
                ));
            } else {
                ranges.push(format!("{name} {shown_low} to {shown_high}"));
                if let Some([low_key, high_key]) = fit_keys(fit.letter) {
                    draft.value(low_key, low).value(high_key, high);
                }
            }
        }
        let fits = if ranges.is_empty() {
            String::new()
        } else {
            format!("; it fits with {}", ranges.join(", "))
        };
        draft.say(format!(
            "{missing} is not declared, so it is unknown whether the program stays within the travel{fits}"
        ));
    });
}

/// A number of millimetres as the lower end of a range: rounded up to 0.001 mm, so that all that is shown fits.
fn bound_up(value: f64) -> String {
    mm((value * 1000.0).ceil() / 1000.0)
}

/// The same of the upper end.
fn bound_down(value: f64) -> String {
    mm((value * 1000.0).floor() / 1000.0)
}

/// Keys of the lowest and highest zero of an axis.
fn fit_keys(letter: u8) -> Option<[&'static str; 2]> {
    Some(match letter {
        b'X' => ["fits_x_min_mm", "fits_x_max_mm"],
        b'Y' => ["fits_y_min_mm", "fits_y_max_mm"],
        b'Z' => ["fits_z_min_mm", "fits_z_max_mm"],
        b'U' => ["fits_u_min_mm", "fits_u_max_mm"],
        b'V' => ["fits_v_min_mm", "fits_v_max_mm"],
        b'W' => ["fits_w_min_mm", "fits_w_max_mm"],
        _ => return None,
    })
}

/// Key of the unknown path; the keys of findings are letters and more.
const UNSETTLED: u64 = 0;
/// Key of a path that the linear axes cannot follow.
const SINGULAR: u64 = 2;
/// Key of travel that is not declared.
const UNDECLARED: u64 = 1;

fn check(leg: &facts::OverTravel<'_>, out: &mut Reporter<'_>) {
    if !leg.settled && leg.found.is_empty() {
        let singular = passes_singular(leg.machine, leg.leg);
        let (key, why, help) = if singular {
            (
                SINGULAR,
                "the rotary axes pass a position at which the linear axes do not span space, so that they cannot hold the tip on its path",
                "turn the rotary axes where the tool is clear of the part",
            )
        } else {
            (
                UNSETTLED,
                "the great circle does not lead to the posture at the end of the block: it passes over the pole, where the first rotary axis jumps, or past it to the other posture",
                "guide the tool axis farther from the pole, or divide the block into smaller steps",
            )
        };
        out.unknown(leg, Merge::once(key), |draft| {
            draft
                .at_orientation()
                .say("the path of the axes between the ends of this block is unknown: it is not proven that every axis stays within its travel")
                .note(why)
                .help(help);
        });
    }
    for excess in &leg.found {
        let axis = &leg.machine.axes[excess.axis];
        let beyond = (excess.value - excess.limit).abs();
        // the lower limit after the upper one is a separate finding, however close the blocks
        let key =
            u64::from(axis.letter) + 256 * u64::from(excess.value > excess.limit) + 512 * u64::from(excess.if_together);
        out.finding(leg, Merge::run(key, beyond), |draft| {
            let name = letter(axis.letter);
            let inside = if excess.inside {
                " inside the block, although both ends are within its travel"
            } else {
                ""
            };
            let together = if excess.if_together {
                ", if the axes of this rapid arrive together"
            } else {
                ""
            };
            draft
                .at_axis(axis.letter)
                .say(format!(
                    "{name} reaches {}{inside}, {} beyond its limit of {}{together}",
                    joint(axis, excess.value),
                    joint(axis, beyond),
                    joint(axis, excess.limit)
                ))
                .note(format!(
                    "values are axis positions on {}, with work offset and tool length included",
                    leg.machine.id
                ))
                .help("move the part, choose another posture, or correct the program");
            if excess.if_together {
                let dogleg = leg.machine.control.rapid == RapidPath::Dogleg;
                draft.unknown().help(if dogleg {
                    "raise the tool before it turns: it is not known whether the axes move independently (rapid = \"dogleg\") while the control guides the tip"
                } else {
                    "declare in the machine file whether they do ([control] rapid = \"synchronous\" or \"dogleg\"), or raise the tool before it turns"
                });
            }
            draft.value_text("axis", name);
            match axis.kind {
                AxisKind::Linear => draft
                    .value("value_mm", excess.value)
                    .value("limit_mm", excess.limit)
                    .value("excess_mm", beyond),
                AxisKind::Rotary => draft
                    .value("value_deg", deg(excess.value))
                    .value("limit_deg", deg(excess.limit))
                    .value("excess_deg", deg(beyond)),
            };
        });
    }
}

#[cfg(test)]
mod tests {
    use crate::Status;
    use crate::fixture::assert_drawn;
    use trunnion_machine::RapidPath;

    #[test]
    fn a_run_of_blocks_is_told_once_with_the_worst() {
        let report = assert_drawn(
            "gcode mill-3axis",
            "N1 G0 X0 Y0 Z0\nN2 G0 X5000\n;     ^^^^^ axis-limit: X reaches 6000 mm\nN3 X6000\nN4 X5500\nN5 X0\n",
        );
        assert_eq!(report.diagnostics[0].count, 3);
        assert_eq!(report.diagnostics[0].related.len(), 1);
    }

    /// Z stands where it was in G54, which nobody declared, while X alone goes to its machine position.
    #[test]
    fn an_axis_that_stands_is_not_in_machine_coordinates() {
        for (fence, head) in [
            (
                "gcode haas-lathe lathe-2axis undeclared",
                "G21 G18 G99 G40\nT0101\nG0 G54 X40. Z2.\n",
            ),
            (
                "gcode fanuc-30i mill-3axis undeclared",
                "G21 G17 G90 G54\nG0 X40. Z2000.\n",
            ),
            (
                "gcode linuxcnc mill-3axis undeclared",
                "G21 G17 G90 G54\nG0 X40 Z2000\n",
            ),
        ] {
            let text = format!("{head}G53 G0 X0\nM30\n");
            let report = crate::fixture::Fixture::parse(fence, &text).check().unwrap();
            let fails = |found: &&crate::Diagnostic| found.rule == "axis-limit" && found.status == Status::Fail;
            assert_eq!(
                report.diagnostics.iter().find(fails).map(|found| &found.message),
                None,
                "{fence}"
            );
            let text = format!("{head}G53 G0 X90000.\nM30\n");
            let report = crate::fixture::Fixture::parse(fence, &text).check().unwrap();
            assert_eq!(report.diagnostics.iter().filter(fails).count(), 1, "{fence}");
        }
    }

    #[test]
    fn a_way_over_the_pole_that_is_not_known_is_no_pass() {
        let text = "TRAORI\nORIVECT\nG0 X0 Y0 Z200 A-25 C0\nG0 X10 A60 C0\nG0 X20 A61\nM30\n";
        let fixture = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", text);
        let report = fixture.check().unwrap();
        let unknown = |d: &&crate::Diagnostic| d.rule == "axis-limit" && d.status == crate::Status::Unknown;
        assert_eq!(
            report.diagnostics.iter().filter(unknown).count(),
            1,
            "{:?}",
            report.diagnostics
        );
    }

    /// The tip is 410 mm above A: Z is 371.6 mm at A-25 and 314.1 mm at A40, and 410 mm in between, where A passes 0.
    #[test]
    fn a_limit_broken_between_two_legal_ends_is_found() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "TRAORI\nG0 X0 Y0 Z410 A-25 C0\nG1 X200 A40 F500\n;^^^^^^^^^^^^^^^ axis-limit: Z reaches 410 mm inside the block, although both ends are within its travel, 10 mm beyond its limit of 400 mm\n;       ^^^ only-one-posture: \n;       ^^^ pole-crossing: \nM30\n",
        );
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "TRAORI\nG0 X0 Y0 Z399 A-25 C0\nG1 X200 A40 F500\n;       ^^^ only-one-posture: \n;       ^^^ pole-crossing: \nM30\n",
        );
    }

    /// The same in a rapid: whether a Sinumerik moves its axes together then depends on G-code group 55 and machine data.
    #[test]
    fn a_limit_between_the_ends_of_a_rapid_is_a_matter_of_its_path() {
        let text = "TRAORI\nG0 X0 Y0 Z410 A-25 C0\nG0 X200 A40\nM30\n";
        let mut machine = crate::fixture::machine("mikron-ucp710").unwrap();
        let dialect = trunnion_dialect::builtin("sinumerik-840d").unwrap();
        for (rapid, wanted) in [
            (RapidPath::Undeclared, vec![Status::Unknown]),
            (RapidPath::Synchronous, vec![Status::Fail]),
            // it is not declared that this holds while the tip is guided
            (RapidPath::Dogleg, vec![Status::Unknown]),
        ] {
            machine.control.rapid = rapid;
            let program = trunnion_syntax::parse(text.into(), dialect.lex);
            let setup = trunnion_interp::Setup::default();
            let settings = crate::Settings {
                assume: crate::Assume::ALL,
                ..crate::Settings::new(dialect, Some(&machine), setup)
            };
            let report = crate::check(&program, &settings);
            let found = report.diagnostics.iter().filter(|found| found.rule == "axis-limit");
            let found: Vec<Status> = found.map(|found| found.status).collect();
            assert_eq!(found, wanted, "{rapid:?}");
        }
    }

    #[test]
    fn the_limit_itself_is_legal_and_each_axis_has_its_own_run() {
        assert_drawn(
            "gcode mikron-ucp710",
            "N1 G0 X0 Y0 Z0 A120 C0\nN2 G0 A-30\nN3 G0 C99999\n",
        );
        assert_drawn(
            "gcode mikron-ucp710",
            "N1 G0 X0 Y0 Z0 A0 C0\nN2 G0 A-30.001\n;     ^^^^^^^^ axis-limit: A reaches -30\n",
        );
    }

    #[test]
    fn the_lower_limit_is_told_beside_the_upper_one() {
        let text = "TRAORI\nG1 X0 Y0 Z0 A121 C0 F600\nG1 X10 A122 C1\nG1 X20 A-31\n";
        let report = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", text)
            .check()
            .unwrap();
        let found: Vec<_> = report
            .diagnostics
            .iter()
            .filter(|d| d.rule == "axis-limit")
            .map(|d| (d.message.as_str(), d.count))
            .collect();
        assert_eq!(
            found,
            [
                ("A reaches 122 deg, 2 deg beyond its limit of 120 deg", 2),
                ("A reaches -31 deg, 1 deg beyond its limit of -30 deg", 1)
            ]
        );
    }

    #[test]
    fn known_joints_are_judged_before_all_axes_are_positioned() {
        assert_drawn(
            "gcode mill-3axis",
            "N1 G0 X5000\n;     ^^^^^ axis-limit: X reaches 5000 mm\n",
        );
    }

    #[test]
    fn what_lies_below_is_told_as_a_distance_and_the_lowest_is_the_worst() {
        let report = assert_drawn(
            "gcode mikron-ucp710",
            "N1 G0 X0 Y0 Z0 A0 C0\nN2 G0 A-31\n;     ^^^^ axis-limit: A reaches -33 deg, 3 deg beyond its limit of -30 deg\nN3 A-33\nN4 A-32\n",
        );
        assert_eq!(report.diagnostics[0].count, 3);
    }

    #[test]
    fn a_legal_block_between_ends_the_run() {
        assert_drawn(
            "gcode mill-3axis",
            "N1 G0 X0 Y0 Z0\nN2 G0 X5000\n;     ^^^^^ axis-limit: X reaches 5000 mm\nN3 X0\nN4 X6000\n;  ^^^^^ axis-limit: X reaches 6000 mm\n",
        );
    }
}
