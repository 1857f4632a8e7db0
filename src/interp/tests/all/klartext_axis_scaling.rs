//! Cycle 26 of Klartext. Ends are worked out by hand: 15 + (10 - 15) 1.4 = 8.
use crate::klartext_scaling::{BACK, BY_AXIS, HALF, SHIFT, WHOLE, arc, ends, last, near, run, unknown};
use crate::support::run_bytes;
use trunnion_interp::{MotionKind, ScaledAxes, Setup};

#[test]
fn cycle_26_scales_each_axis_about_its_centre() {
    near(ends(None, &format!("{BY_AXIS}L X+10 Y+30 Z+5")), [8.0, 26.0, 5.0]);
    near(ends(None, &format!("{BY_AXIS}L X+15 Y+20 Z+5")), [15.0, 20.0, 5.0]);
    // increments are scaled without the centre
    near(
        ends(None, &format!("{BY_AXIS}L X+10 Y+30 Z+5\nL IX+10 IY+10 IZ+10")),
        [22.0, 32.0, 15.0],
    );
    // polar coordinates are positions: the point of the pole 10, 30 with radius 5 along X
    near(
        ends(None, &format!("{BY_AXIS}L Z+5\nCC X+10 Y+30\nLP PR+5 PA+0")),
        [15.0, 26.0, 5.0],
    );
    // the coordinates of the centre are in the unit of the program, and in the shifted system
    near(
        ends(None, &format!("{SHIFT}{BY_AXIS}L X+10 Y+30 Z+5")),
        [8.0, 26.0, 5.0],
    );
    let inch = "0 BEGIN PGM A INCH\nCYCL DEF 26.0 S\nCYCL DEF 26.1 X2 CCX+1\nL X+3 Y+1 Z+1\nEND PGM A INCH\n";
    let (_, log) = run_bytes("heidenhain-klartext", inch.as_bytes(), &Setup::default());
    near(last(&log), [127.0, 25.4, 25.4]);
    // an axis that only has a factor of 1 needs no centre, and Q parameters have values
    let blocks = "Q1 = +2\nCYCL DEF 26.0 S\nCYCL DEF 26.1 X+Q1 Y1 CCX+10\nL X+20 Y+5 Z+5";
    near(ends(None, blocks), [30.0, 5.0, 5.0]);
    near(
        ends(None, "CYCL DEF 26.0 S\nCYCL DEF 26.1 Z 1.01 CCZ+100\nL X+1 Y+2 Z+0"),
        [1.0, 2.0, -1.0],
    );
}

#[test]
fn a_factor_of_1_ends_cycle_26() {
    let off = "CYCL DEF 26.0 S\nCYCL DEF 26.1 X1 Y1\n";
    near(
        ends(None, &format!("{BY_AXIS}L X+10 Y+30 Z+5\n{off}L X+10 Y+30")),
        [10.0, 30.0, 5.0],
    );
    let half = "CYCL DEF 26.0 S\nCYCL DEF 26.1 X1 Y2 CCY+20\n";
    near(
        ends(None, &format!("{BY_AXIS}{half}L X+10 Y+30 Z+5")),
        [10.0, 40.0, 5.0],
    );
    // whether an axis that is left out keeps its factor is not stated; naming it ends that
    let left_out = "CYCL DEF 26.0 S\nCYCL DEF 26.1 Y1\n";
    unknown(
        None,
        &format!("{BY_AXIS}{left_out}L X+10 Y+30 Z+5"),
        "leaves out an axis",
    );
    unknown(
        None,
        &format!("{BY_AXIS}{left_out}{left_out}L X+10 Y+30 Z+5"),
        "leaves out an axis",
    );
    let (log, _) = run(None, &format!("{BY_AXIS}{left_out}{off}L X+10 Y+30 Z+5"));
    near(last(&log), [10.0, 30.0, 5.0]);
}

#[test]
fn cycle_26_that_is_not_clear_is_unknown() {
    let cycle = |words: &str| format!("CYCL DEF 26.0 S\nCYCL DEF 26.1 {words}\nL X+10 Y+30 Z+5");
    for (words, reason) in [
        ("X1.4 Y0.6", "without the centre"),
        ("X1.4 Y0.6 CCX+15", "without the centre"),
        ("X0 CCX+15", "above 0"),
        ("X-1 CCX+15", "above 0"),
        ("X CCX+15", "a word has no value"),
        ("XQ77 CCX+15", "Q77"),
        ("X2 CCX+Q77", "Q77"),
        ("X2 X2 CCX+15", "other words"),
        ("X2 CCX+15 A2", "other words"),
        ("IX2 CCX+15", "other words"),
        ("U2", "other words"),
        ("CCX+15", "needs the factor"),
        ("", "needs the factor"),
    ] {
        unknown(None, &cycle(words), reason);
    }
    let text = "CYCL DEF 26.0 S\nCYCL DEF 26.1 X2 CCX+15\nCYCL DEF 26.2 Y2 CCY+15\nL X+10 Y+30 Z+5";
    unknown(None, text, "other words");
    // the next complete one makes it known
    let (log, _) = run(
        None,
        &format!(
            "{}\n{BY_AXIS}CYCL DEF 26.1 X2 Y2 Z1 CCX+0 CCY+0\nL X+1 Y+2 Z+3",
            cycle("A2")
        ),
    );
    near(last(&log), [2.0, 4.0, 3.0]);
}

#[test]
fn arcs_need_equal_factors_of_their_two_axes() {
    let half = "CYCL DEF 26.0 S\nCYCL DEF 26.1 X0.5 Y0.5 Z2 CCX+10 CCY+0 CCZ+0\n";
    let (log, told) = run(None, &format!("{half}L X+10 Y+0 Z+5\nCC X+20 Y+0\nC X+20 Y+10 DR-"));
    let found = arc(log.motions.last().expect("a motion")).expect("an arc");
    near(Some(found.centre.into()), [15.0, 0.0, 10.0]);
    near(Some(found.end.into()), [15.0, 5.0, 10.0]);
    assert!(
        (found.radius_start - 5.0).abs() < 1e-12 && found.sweep < 0.0,
        "{found:?} {told:?}"
    );
    for path in [
        "CR X+20 Y+10 R+10 DR-",
        "L X+12\nCT X+20 Y+10",
        "CC X+20 Y+0\nCP PA+90 DR-",
    ] {
        let (log, told) = run(None, &format!("{BY_AXIS}L X+10 Y+0 Z+5\n{path}"));
        let last = log.motions.last().expect("a motion");
        assert!(matches!(last.kind, MotionKind::Arc(None)), "{path}");
        near(last.end.xyz().map(Into::into), [22.0, 14.0, 5.0]);
        assert!(
            told.iter().any(|told| told.contains("the same factor for both")),
            "{path}: {told:?}"
        );
    }
}

#[test]
fn cycle_26_together_with_others_is_unknown_while_both_hold() {
    let line = "L X+10 Y+30 Z+5";
    for (with, ends, reason) in [
        (
            "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+90\n",
            "CYCL DEF 10.0 R\nCYCL DEF 10.1 ROT+0\n",
            "together with cycle 10",
        ),
        (
            "CYCL DEF 8.0 M\nCYCL DEF 8.1 X\n",
            "CYCL DEF 8.0 M\nCYCL DEF 8.1\n",
            "together with cycle 8",
        ),
        (HALF, WHOLE, "together with cycle 11"),
        ("M128\n", "M129\n", "cycle 26 under M128"),
    ] {
        for both in [format!("{BY_AXIS}{with}"), format!("{with}{BY_AXIS}")] {
            unknown(Some(ScaledAxes::Plane), &format!("{both}{line}"), reason);
            let (log, told) = run(Some(ScaledAxes::Plane), &format!("{both}{ends}{line}"));
            let last = last(&log);
            assert_eq!(
                last.map(|end| end.map(f64::round)),
                Some([8.0, 26.0, 5.0]),
                "{both}{ends}: {told:?}"
            );
        }
    }
    unknown(
        None,
        &format!("PLANE SPATIAL SPA+0 SPB+90 SPC+0 STAY\n{BY_AXIS}{line}"),
        "in a tilted plane",
    );
    unknown(
        None,
        &format!("{BY_AXIS}PLANE SPATIAL SPA+0 SPB+90 SPC+0 STAY\n{line}"),
        "a tilted plane in a turned",
    );
    // a shift that changes: where the centre is then
    unknown(None, &format!("{SHIFT}{BY_AXIS}{BACK}{line}"), "with another datum");
    unknown(
        None,
        &format!("{BY_AXIS}{SHIFT}{line}"),
        "in a turned, mirrored or scaled system",
    );
    unknown(
        None,
        &format!("{BY_AXIS}CYCL DEF 247 Q339=1\n{line}"),
        "with another datum",
    );
    let off = "CYCL DEF 26.0 S\nCYCL DEF 26.1 X1 Y1\n";
    let (log, _) = run(None, &format!("{SHIFT}{BY_AXIS}{BACK}{off}{line}"));
    near(last(&log), [10.0, 30.0, 5.0]);
}
