//! Axes that are too fast.
use crate::fixture::assert_drawn;

/// C turns 90 deg in 60/F s and reaches 120 deg/s: 0.75 s are enough, F80.
#[test]
fn inverse_time_is_judged_where_the_tip_stands_still() {
    let text = |feed: u32| format!("TRAORI\nG0 X0 Y0 Z50 A0 C0\nG93 G1 C90 F{feed}\nM30\n");
    let found = |feed| {
        let fixture = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text(feed));
        let report = fixture.check().unwrap();
        let own = report.findings().filter(|found| found.rule == "axis-overspeed");
        own.map(|found| found.message.clone()).collect::<Vec<_>>()
    };
    assert_eq!(found(79), [] as [&str; 0]);
    let message = "C would have to run at 122 deg/s in the 0.741 s of this block, but its maximum is 120 deg/s";
    assert_eq!(found(81), [message]);
}

#[test]
fn where_only_rotary_axes_turn_the_feed_is_in_degrees() {
    let text = "N10 G0 X0 Y0 Z50 A30 C0\nN20 G1 C90 F7200\nN30 C180 F7300\n";
    let report = crate::fixture::Fixture::parse("gcode mikron-ucp710", text)
        .check()
        .unwrap();
    let found: Vec<_> = report.findings().filter(|d| d.rule == "axis-overspeed").collect();
    assert_eq!((found.len(), found[0].block.as_deref()), (1, Some("N30")));
    assert_eq!(found[0].notes, ["the highest feed for this block is 7200 deg/min"]);
    assert!(
        found[0]
            .values
            .contains(&("feed_deg_min", crate::ValueKey::Number(7300.0)))
    );
}

/// On a Haas F of a turn is the speed along a circle of a set diameter, so that C may run faster than by F in degrees: 7100 are within its speed.
#[test]
fn on_a_haas_the_feed_of_a_turn_is_a_setting() {
    let said = |info: &str, block: &str| -> Vec<String> {
        let text = format!("G0 X0. Y0. Z50. A30. C0.\n{block}\nM30\n");
        let report = crate::fixture::Fixture::parse(info, &text).check().unwrap();
        let own = report.findings().filter(|d| d.rule == "axis-overspeed");
        own.map(|d| format!("{:?} {}", d.status, &d.message[..24])).collect()
    };
    let haas = "gcode haas-ngc mikron-ucp710";
    for feed in ["F7100.", "F7300."] {
        assert_eq!(
            said(haas, &format!("G1 C90. {feed}")),
            ["Unknown only rotary axes move: t"]
        );
    }
    assert_eq!(said(haas, "G93 G1 C90. F2."), [""; 0]);
    assert_eq!(said(haas, "G1 X1. C9. F1000."), ["Unknown linear and rotary axes m"]);
    // declared: degrees
    let declared = "gcode haas-ngc mikron-ucp710+control.feed=\"xyz\"";
    assert_eq!(said(declared, "G1 C90. F7100."), [""; 0]);
    assert_eq!(said(declared, "G1 C90. F7300.").len(), 1);
}

#[test]
fn a_standing_tip_under_tcp_is_unknown_once() {
    let report = assert_drawn(
        "gcode sinumerik-840d mikron-ucp710",
        "N10 TRAORI\nN20 G0 X0 Y0 Z50 A30 C0\nN30 G1 C90 F500\n;   ^^^^^^^^^^^ axis-overspeed: it is not known whether an axis is too fast: the tip does not move\nN40 C0\nN50 M30\n",
    );
    assert_eq!(report.diagnostics[0].count, 2);
}

#[test]
fn linear_and_rotary_axes_together_are_unknown_where_a_parameter_says_what_f_means() {
    let found = |info: &str, last: &str| {
        let second = if info.contains("ferrari") { 'B' } else { 'A' };
        let text = format!("N10 G17 G21 G90 G94\nN20 G0 X0.1 Y0.1 Z50. {second}30. C0.1\n{last}\nN50 M30\n");
        let report = crate::fixture::Fixture::parse(info, &text).check().unwrap();
        assert!(report.findings().all(|d| d.rule != "feed-drop") || report.summary.unknown == 0);
        report
            .diagnostics
            .into_iter()
            .filter(|d| d.rule == "axis-overspeed")
            .map(|d| (d.status, d.count))
            .collect::<Vec<_>>()
    };
    let fast = "N30 G1 X1. C9. F9000.\nN40 X2. C20.";
    assert_eq!(
        found("gcode fanuc-30i mikron-ucp710", fast),
        [(crate::Status::Unknown, 2)]
    );
    assert_eq!(found("gcode ferrari-bc", fast), [(crate::Status::Unknown, 2)]);
    assert_eq!(
        found("gcode linuxcnc mikron-ucp710", fast),
        [(crate::Status::Fail, 1), (crate::Status::Fail, 1)]
    );
    // along all axes the block only takes longer: what keeps the limits along X Y Z keeps them anyway
    assert_eq!(found("gcode fanuc-30i mikron-ucp710", "N30 G1 X1. C9. F300."), []);
}

#[test]
fn switching_tool_centre_point_control_off_is_no_standing_tip() {
    for end in [
        "TRAFOOF\nN40 G1 X0 Y0 Z50 F500",
        "TRAFOOF\nN40 G1 X10 F500",
        "TRAFOOF\nN40 G1 Z50 A30 C0 F500",
    ] {
        let text = format!("N10 TRAORI\nN20 G0 X0 Y0 Z50 A30 C0\nN30 {end}\nN50 M30\n");
        let report = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text)
            .check()
            .unwrap();
        assert!(
            report.findings().all(|d| !d.message.contains("does not move")),
            "{:?}",
            report.diagnostics
        );
    }
}

#[test]
fn feed_per_revolution_needs_the_spindle() {
    assert_drawn(
        "gcode mill-3axis",
        "N10 G0 X0 Y0 Z50\nN20 G95 G1 X10 F0.1\n;   ^^^^^^^^^^^^^^^ axis-overspeed: it is not known whether an axis is too fast: the feed is per revolution\nN30 S1000 M3\nN40 X0\n",
    );
}

/// `blocks` feed motions in each of which C turns 9 deg in 1 mm.
fn program(blocks: u32) -> String {
    let line = |i: u32| format!("G1 X{i} C{} F1000\n", 9 * i);
    let lines: String = (1..=blocks).map(line).collect();
    format!("TRAORI\nG0 X0 Y0 Z50 A30 C0\n{lines}M30\n")
}

#[test]
fn short_runs_are_told_block_by_block_and_long_ones_once() {
    let found = |blocks| {
        let fixture = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &program(blocks));
        let report = fixture.check().unwrap();
        report
            .diagnostics
            .into_iter()
            .filter(|d| d.rule == "axis-overspeed")
            .collect::<Vec<_>>()
    };
    assert_eq!(found(8).len(), 8);
    let long = found(20);
    assert_eq!((long.len(), long[0].count), (1, 20));
}

#[test]
fn the_worst_of_a_long_run_is_worded_wherever_it_lies() {
    use core::fmt::Write;
    // the fewer mm for 9 deg of C, the lower the feed: worst in block 15
    let mut text = String::from("TRAORI\nG0 X0 Y0 Z50 A30 C0\n");
    let mut x = 0.0;
    for i in 1..=20_i32 {
        x += 0.5 + f64::from((i - 15).abs()) / 100.0;
        let _ = writeln!(text, "N{i} G1 X{x:.3} C{} F1000", 9 * i);
    }
    let report = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text)
        .check()
        .unwrap();
    for rule in ["axis-overspeed", "feed-drop"] {
        let found: Vec<_> = report.findings().filter(|d| d.rule == rule).collect();
        assert_eq!(
            (found.len(), found[0].count, found[0].block.as_deref()),
            (1, 20, Some("N1"))
        );
        let limit = found[0].values.iter().find_map(|(key, value)| match value {
            crate::ValueKey::Number(limit) if *key == "feed_limit_mm_min" => Some(*limit),
            _ => None,
        });
        assert!((limit.unwrap() - 400.0).abs() < 0.5, "{rule}: {limit:?}");
        let worst = found[0].related[0].0;
        assert!(
            text[..worst.start as usize].lines().last().unwrap().starts_with("N15 "),
            "{rule}"
        );
        assert!(
            text[..found[0].last.start as usize]
                .lines()
                .last()
                .unwrap()
                .starts_with("N20 "),
            "{rule}"
        );
    }
}

#[test]
fn fixes_are_offered_where_they_may_help() {
    let fixes = |words: &str| {
        let text = format!("TRAORI\nG0 X0 Y0 Z50 A30 C0\nG1 {words} F2000\nM30\n");
        let report = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text)
            .check()
            .unwrap();
        report
            .findings()
            .find(|d| d.rule == "axis-overspeed")
            .map(|d| d.fixes.clone())
    };
    assert_eq!(fixes("X1 C90"), Some(vec!["adapt-feed"]));
    assert_eq!(fixes("X1 C350"), Some(vec!["unwind-rotary", "adapt-feed"]));
    assert_eq!(fixes("X1 C90 A-1"), Some(vec!["smooth-pole", "adapt-feed"]));
}
