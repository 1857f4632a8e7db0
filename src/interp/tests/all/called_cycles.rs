//! Sinumerik: variables of the program's own, and drilling cycles that are called with numbers.
use crate::support::{faults, line, lines, run_text};

const HEAD: &str = "G17 G90 G94 F100\nS1000 M3\nG0 X0 Y0 Z50\n";

fn cycle(text: &str) -> Vec<String> {
    lines("sinumerik-840d", &format!("{HEAD}{text}\n"))[1..].to_vec()
}

#[test]
fn cycle81_goes_down_in_feed_and_out_in_rapid() {
    let hole = ["R X0 Y0 Z3", "L X0 Y0 Z-20 F100", "R X0 Y0 Z10"];
    assert_eq!(cycle("CYCLE81(10,0,3,-20)"), hole);
    assert_eq!(cycle("CYCLE81(10,0,3,,20)"), hole, "depth below the surface");
    assert_eq!(cycle("CYCLE81(10,0,3,-5,20)"), hole, "the last depth counts");
    assert_eq!(cycle("R1=10 R2=-20\nCYCLE81(R1,,3.,R2)"), hole);
}

/// The control takes the depth on the other side of RFP than RTP; RTP may be RFP where the depth is absolute.
#[test]
fn a_hole_may_go_up_and_end_on_its_surface() {
    assert_eq!(
        cycle("CYCLE81(0,0,2,-5)"),
        ["R X0 Y0 Z2", "L X0 Y0 Z-5 F100", "R X0 Y0 Z0"]
    );
    assert_eq!(
        cycle("G0 Z-20\nCYCLE81(-10,0,2,5)")[1..],
        ["R X0 Y0 Z-2", "L X0 Y0 Z5 F100", "R X0 Y0 Z-10"]
    );
    assert_eq!(
        cycle("G0 Z-20\nCYCLE81(-10,0,2,,5)")[1..],
        ["R X0 Y0 Z-2", "L X0 Y0 Z5 F100", "R X0 Y0 Z-10"]
    );
    // RFP is DP: nothing moves
    assert_eq!(cycle("CYCLE81(10,5,2,5)\nX1"), ["R X1 Y0 Z50"]);
}

/// SST1 is the speed on the way out; which of both stays is not known.
#[test]
fn cycle84_comes_out_at_its_own_speed() {
    let speeds = |call: &str| -> Vec<_> {
        let log = run_text("sinumerik-840d", &format!("{HEAD}{call}\nG1 X5\n"));
        log.motions[1..].iter().map(|motion| motion.spindle_rpm).collect()
    };
    let tap = [Some(500.0), Some(500.0), Some(1000.0)];
    assert_eq!(speeds("CYCLE84(10,0,2,-15,,0,3,,1.5,0,500,1000)")[..3], tap);
    assert_eq!(speeds("CYCLE84(10,0,2,-15,,0,3,,1.5,0,500,1000)").last(), Some(&None));
    let same = [Some(500.0), Some(500.0), Some(500.0)];
    assert_eq!(speeds("CYCLE84(10,0,2,-15,,0,3,,1.5,0,500,0)")[..3], same);
}

#[test]
fn mcall_runs_the_cycle_behind_every_motion_until_it_stands_alone() {
    assert_eq!(
        cycle("MCALL CYCLE82(10,0,3,-20,,0.5)\nX5\nG4 F1\nX7\nMCALL\nX9"),
        [
            "R X5 Y0 Z50",
            "R X5 Y0 Z3",
            "L X5 Y0 Z-20 F100",
            "D0.5 X5 Y0 Z-20",
            "R X5 Y0 Z10",
            "D1 X5 Y0 Z10",
            "R X7 Y0 Z10",
            "R X7 Y0 Z3",
            "L X7 Y0 Z-20 F100",
            "D0.5 X7 Y0 Z-20",
            "R X7 Y0 Z10",
            "R X9 Y0 Z10"
        ]
    );
}

#[test]
fn the_other_cycles_are_what_the_manual_says() {
    // pitch 1.5 mm, in and out along the thread, the spindle turns on with M3
    let tap = format!("{HEAD}CYCLE84(10,0,3,-20,,0,3,0,1.5,0,300,300)\n");
    let log = run_text("sinumerik-840d", &tap);
    let got: Vec<_> = log.motions[1..].iter().map(line).collect();
    assert_eq!(
        got,
        [
            "R X0 Y0 Z3",
            "L X0 Y0 Z-20 F1.5/rev",
            "L X0 Y0 Z3 F1.5/rev",
            "R X0 Y0 Z10"
        ]
    );
    assert_eq!(log.motions[2].spindle_rpm, Some(300.0));
    assert_eq!(log.state.expect("ran").spindle.on(), Some(true));
    assert_eq!(
        cycle("CYCLE85(10,0,3,-20,,0,60,120)"),
        ["R X0 Y0 Z3", "L X0 Y0 Z-20 F60", "L X0 Y0 Z3 F120", "R X0 Y0 Z10"]
    );
    let bore = format!("{HEAD}CYCLE86(10,0,3,-20,,0,3,-0.2,0,0,0)\n");
    let log = run_text("sinumerik-840d", &bore);
    let got: Vec<_> = log.motions[1..].iter().map(line).collect();
    assert_eq!(
        got,
        [
            "R X0 Y0 Z3",
            "L X0 Y0 Z-20 F100",
            "R X-0.2 Y0 Z-20",
            "R X-0.2 Y0 Z10",
            "R X0 Y0 Z10"
        ]
    );
    assert_eq!(log.motions[3].spindle_on, Some(false));
    assert_eq!(
        cycle("CYCLE89(10,0,3,-20,,1)"),
        [
            "R X0 Y0 Z3",
            "L X0 Y0 Z-20 F100",
            "D1 X0 Y0 Z-20",
            "L X0 Y0 Z3 F100",
            "R X0 Y0 Z10"
        ]
    );
}

#[test]
fn what_a_cycle_does_not_tell_is_unknown() {
    for (text, told) in [
        ("CYCLE83(10,0,3,-20,,,,2,0,0,1,0)", "the steps in the hole"),
        ("CYCLE83(10,0,3,-20,,-5,5,2,0,0,1,2)", "the steps in the hole"),
        // from RFP 29 mm, from the level above it 32: which of both the limit of 30 mm means is not sourced
        ("CYCLE83(10,0,3,-29,,,5,2,0,0,1,1)", "the steps in the hole"),
        (
            "CYCLE83(10,0,3,-20,,-5,,2,0,0,1,0,0,0,0,0,0,0,1,12)",
            "the steps in the hole",
        ),
        (
            "CYCLE84(10,0,3,-20,,0,3,0,1.5,0,300,300,0,1,0,1,2,1)",
            "the steps in the hole",
        ),
        ("CYCLE84(10,0,3,-20,,0,3,8.2)", "the pitch"),
        ("CYCLE81(10,0,3,R7)", "without known levels"),
        ("CYCLE81(-10,0,3,-20)", "RTP -10 is not above RFP 0"),
        ("CYCLE81(10,0,3,-20,,0,1)", "numbers that select other meanings"),
        (
            "CYCLE83(10,0,3,-20,,-5,,2,0,0,1,0,1)",
            "numbers that select other meanings",
        ),
    ] {
        let got = faults("sinumerik-840d", &format!("{HEAD}{text}\n"));
        assert!(got.iter().any(|fault| fault.contains(told)), "{text}: {got:?}");
    }
    // the position after a hole in steps is known
    assert_eq!(
        cycle("CYCLE83(10,0,3,-20,,,,2,0,0,1,0)"),
        ["R X0 Y0 Z3", "U X0 Y0 Z-20", "R X0 Y0 Z10"]
    );
    assert_eq!(cycle("CYCLE81(10,0,3,R7)\nX5"), ["U -", "R X5"]);
}

#[test]
fn modes_at_the_end_of_a_call_say_which_depth_counts() {
    let drilled = ["R X0 Y0 Z3", "L X0 Y0 Z-20 F100", "R X0 Y0 Z10"];
    for call in [
        "CYCLE81(10,0,3,-20,0,0,0,1,12)",
        "CYCLE81(10,0,3,-20,5,0,0,1,2)",
        "CYCLE81(10,0,3,,20,0,0,1,11)",
        "CYCLE81(10,0,3,-7,20,0,0,0,1)",
        "CYCLE82(10,0,3,-20,0,0,0,1,12)",
    ] {
        assert_eq!(cycle(call), drilled, "{call}");
    }
    assert_eq!(
        cycle("CYCLE83(10,0,3,,20,,5,100,0,0.5,100,1,0,1.2,1.4,0,1.6,0,1,11211111)"),
        ["R X0 Y0 Z3", "U X0 Y0 Z-20", "R X0 Y0 Z10"]
    );
    for call in [
        // another plane, a depth of the shank, revolutions, an expression
        "CYCLE81(10,0,3,-20,0,0,0,2,12)",
        "CYCLE82(10,0,3,-20,0,0,10,1,12)",
        "CYCLE82(10,0,3,-20,0,3,0,1,22)",
        "CYCLE82(10,0,3,-20,0,3,0,1,R7)",
    ] {
        let got = faults("sinumerik-840d", &format!("{HEAD}{call}\n"));
        assert!(
            got.iter().any(|fault| fault.contains("other meanings")),
            "{call}: {got:?}"
        );
    }
    let got = faults("sinumerik-840d", &format!("{HEAD}CYCLE81(10,0,3,,20,0,0,1,12)\n"));
    assert!(
        got.iter().any(|fault| fault.contains("without known levels")),
        "{got:?}"
    );
}

#[test]
fn variables_are_followed_until_the_flow_is_lost() {
    let source =
        "DEF REAL _HOME, _UP=2.5\n_HOME=-10 R1=4\nG0 X=_HOME+R1*2 Y=R1/8 Z=_UP\nX=IC(R1) Y=AC(R1)\nR1=R1+1\nX=R1\n";
    assert_eq!(
        lines("sinumerik-840d", source),
        ["R X-2 Y0.5 Z2.5", "R X2 Y4 Z2.5", "R X5 Y4 Z2.5"]
    );
    assert_eq!(faults("sinumerik-840d", source), [""; 0]);
    for flow in ["L20", "SOMETHING(1)", "CALL \"PART\"", "EXTCALL \"PART\""] {
        let source = format!("R1=4\nG0 X0 Y0\n{flow}\nX=R1\n");
        let got = faults("sinumerik-840d", &source);
        assert!(
            got.iter()
                .any(|fault| fault.contains(r#"what: "R1: jumps or calls before it are not followed""#)),
            "{flow}: {got:?}"
        );
    }
    // a label alone changes nothing; what cannot be decided ends the run
    let label = "R1=4\nG0 X0 Y0\nNEXT:\nX=R1\n";
    assert_eq!(lines("sinumerik-840d", label), ["R X0 Y0", "R X4 Y0"]);
    for flow in ["IF R9>3 GOTOF END", "WHILE R9<3"] {
        let source = format!("R1=4\nG0 X0 Y0\n{flow}\nX=R1\n");
        let got = faults("sinumerik-840d", &source);
        assert!(got.len() == 1 && got[0].contains("NotDecided"), "{flow}: {got:?}");
        assert_eq!(lines("sinumerik-840d", &source), ["R X0 Y0"]);
    }
}

#[test]
fn cycle83_breaks_the_chip_or_leaves_the_hole() {
    // 5, then 2 less: 3; the rest is below the amount
    assert_eq!(
        cycle("CYCLE83(10,0,3,-9,,-5,,2,0,0,0.5,0)"),
        [
            "R X0 Y0 Z3",
            "L X0 Y0 Z-5 F50",
            "R X0 Y0 Z-4",
            "L X0 Y0 Z-7 F100",
            "R X0 Y0 Z-6",
            "L X0 Y0 Z-9 F100",
            "R X0 Y0 Z10"
        ]
    );
    // out to the level above the surface, and back to 0.6 mm above the last depth; dwells DTB, DTS, DTD
    assert_eq!(
        cycle("CYCLE83(10,0,3,-9,,,5,-1,0.5,0.2,1,1,0,2,0,0.7)"),
        [
            "R X0 Y0 Z3",
            "L X0 Y0 Z-5 F100",
            "D0.5 X0 Y0 Z-5",
            "R X0 Y0 Z3",
            "D0.2 X0 Y0 Z3",
            "R X0 Y0 Z-4.4",
            "L X0 Y0 Z-9 F100",
            "D0.7 X0 Y0 Z-9",
            "R X0 Y0 Z10"
        ]
    );
    // _DIS1 and _VRT
    assert!(cycle("CYCLE83(10,0,3,-40,,,20,0,0,0,1,1,0,0,0,0,2)").contains(&"R X0 Y0 Z-18".to_owned()));
    // without _DIS1 a fiftieth of a depth above 30 mm, at most 7 mm
    assert!(cycle("CYCLE83(10,0,3,-40,,,20,0,0,0,1,1)").contains(&"R X0 Y0 Z-19.2".to_owned()));
    assert!(cycle("CYCLE83(10,0,3,-400,,,200,0,0,0,1,1)").contains(&"R X0 Y0 Z-193".to_owned()));
    assert!(cycle("CYCLE83(10,0,3,-9,,,5,0,0,0,1,0,0,0,1.5)").contains(&"R X0 Y0 Z-3.5".to_owned()));
}

#[test]
fn rows_of_holes_run_the_cycle_of_mcall() {
    let line = cycle("MCALL CYCLE81(10,0,3,-5)\nHOLES1(0,0,30,0,10,2)\nMCALL");
    assert_eq!(
        line,
        [
            "R X0 Y0 Z3",
            "L X0 Y0 Z-5 F100",
            "R X0 Y0 Z10",
            "R X8.660254 Y5 Z10",
            "R X8.660254 Y5 Z3",
            "L X8.660254 Y5 Z-5 F100",
            "R X8.660254 Y5 Z10"
        ]
    );
    let places = |text: &str| -> Vec<String> {
        cycle(&format!("MCALL CYCLE81(60,0,3,-5)\n{text}\nMCALL"))
            .into_iter()
            .filter(|line| line.starts_with('L'))
            .collect()
    };
    assert_eq!(
        places("HOLES2(0,0,10,90,0,4)"),
        [
            "L X0 Y10 Z-5 F100",
            "L X-10 Y0 Z-5 F100",
            "L X0 Y-10 Z-5 F100",
            "L X10 Y0 Z-5 F100"
        ]
    );
    assert_eq!(
        places("CYCLE801(1,1,0,10,5,2,2)"),
        [
            "L X1 Y1 Z-5 F100",
            "L X1 Y6 Z-5 F100",
            "L X11 Y6 Z-5 F100",
            "L X11 Y1 Z-5 F100"
        ]
    );
    // which end of the row comes first is not agreed
    for text in [
        "X50\nHOLES1(10,0,0,0,10,3)",
        "CYCLE801(1,1,0,5,5,2,2)",
        "HOLES1(R77,0,0,0,10,3)",
    ] {
        let got = faults("sinumerik-840d", &format!("{HEAD}MCALL CYCLE81(10,0,3,-5)\n{text}\n"));
        assert!(got.iter().any(|fault| fault.contains("NotModelled")), "{text}: {got:?}");
    }
    let got = faults("sinumerik-840d", &format!("{HEAD}HOLES2(0,0,10,0,120,4)\n"));
    assert!(got.iter().any(|fault| fault.contains("61106")), "{got:?}");
}

/// The pitch by its unit, or by the thread that MPIT names.
#[test]
fn cycle84_reads_the_pitch_in_each_form() {
    let pitch = |size_and_pitch: &str, unit: &str| {
        let call = format!("CYCLE84(10,0,3,-20,,0,3,{size_and_pitch},0,500,500,,{unit})");
        let fed = cycle(&call).into_iter().find(|line| line.starts_with("L X0 Y0 Z-20"));
        fed.map(|line| line.trim_start_matches("L X0 Y0 Z-20").trim().to_owned())
    };
    for (numbers, unit, feed) in [
        (",1.25", "", "F1.25/rev"),
        (",1.25", "1", "F1.25/rev"),
        (",20", "2", "F1.27/rev"),
        (",0.05", "3", "F1.27/rev"),
        ("8,", "", "F1.25/rev"),
        ("8,0", "1", "F1.25/rev"),
        ("8,1.25", "1", "F1.25/rev"),
        ("-24,", "", "F3/rev"),
    ] {
        assert_eq!(pitch(numbers, unit).as_deref(), Some(feed), "{numbers} {unit}");
    }
    for (numbers, unit) in [("8,1", "1"), ("8.2,", ""), (",", ""), (",0", "2"), (",1", "4")] {
        let call = format!("{HEAD}CYCLE84(10,0,3,-20,,0,3,{numbers},0,500,500,,{unit})\n");
        let told = faults("sinumerik-840d", &call);
        assert!(
            told.iter().any(|fault| fault.contains("the pitch")),
            "{numbers} {unit}: {told:?}"
        );
    }
}
