//! Lines, modes, units, feeds, dwells and offsets of ISO programs.
use crate::support::{faults, line, lines, run_bytes, run_text};
use trunnion_interp::{Setup, WorkOffset};

#[test]
fn modal_motion_and_unknown_start() {
    let got = lines("iso-6983", "G0 Z5\nG1 X1 Y2 F100\nX3\nG0 Y0\nM30\nX9\n");
    assert_eq!(got, ["R Z5", "L X1 Y2 Z5 F100", "L X3 Y2 Z5 F100", "R X3 Y0 Z5"]);
}

#[test]
fn the_start_of_the_first_motion_is_unknown() {
    let log = run_text("iso-6983", "G0 X1 Y2 Z3\n");
    assert_eq!(log.motions[0].start.known, 0);
    assert_eq!(log.motions[0].end.known, 0b111);
}

#[test]
fn incremental_from_an_unknown_position_stays_unknown() {
    let got = lines("iso-6983", "G91 G0 X5\nG90 X1\nG91 X5 Y1\n");
    assert_eq!(got, ["R -", "R X1", "R X6"]);
}

#[test]
fn coordinates_per_word() {
    let got = lines(
        "sinumerik-840d",
        "G0 X10 Y10 Z10 C350\nG91 X1 Y=AC(3)\nG90 X=IC(-2) C=DC(10)\nC=ACN(20)\nC=ACP(10)\nC=DC(190)\n",
    );
    assert_eq!(
        got,
        [
            "R X10 Y10 Z10 C350",
            "R X11 Y3 Z10 C350",
            "R X9 Y3 Z10 C370",
            "R X9 Y3 Z10 C20",
            "R X9 Y3 Z10 C370",
            "R X9 Y3 Z10 C550",
        ]
    );
}

#[test]
fn inch_scales_lengths_and_feeds_but_no_angles() {
    let got = lines("iso-6983", "G20 G1 X1 C90 F10\nG21 X1 F10\n");
    assert_eq!(got, ["L X25.4 C90 F254", "L X1 C90 F10"]);
}

#[test]
fn sinumerik_g70_leaves_f_alone_and_g700_does_not() {
    let got = lines("sinumerik-840d", "G70 G1 X1 F100\nG700 X2 F100\nG710 X2 F100\n");
    assert_eq!(got, ["L X25.4 F100", "L X50.8 F2540", "L X2 F100"]);
}

#[test]
fn feed_modes() {
    let got = lines(
        "linuxcnc",
        "S500 M3 G1 X1 F100\nG93 G1 X2 F4\nX3 F2\nG95 X4 F0.1\nG94 X5 F60\n",
    );
    assert_eq!(
        got,
        ["L X1 F100", "L X2 F1/4", "L X3 F1/2", "L X4 F0.1/rev", "L X5 F60"]
    );
}

#[test]
fn feed_spindle_and_tool_of_a_block_come_before_its_motion() {
    let log = run_text("iso-6983", "X1 M3 T7 S500 M6 G1 F200\n");
    let motion = &log.motions[0];
    assert_eq!(line(motion), "L X1 F200");
    assert_eq!(
        (motion.tool, motion.spindle_on, motion.spindle_rpm),
        (Some(7), Some(true), Some(500.0))
    );
    assert!(motion.is_engaged());
}

#[test]
fn spindle_is_unknown_before_any_word() {
    let log = run_text("iso-6983", "G1 X1 F1\nM5\nX2\nM4\nX3\n");
    let on: Vec<_> = log.motions.iter().map(|motion| motion.spindle_on).collect();
    assert_eq!(on, [None, Some(false), Some(true)]);
}

#[test]
fn constant_cutting_speed_leaves_the_turns_unknown() {
    let log = run_text("iso-6983", "S500 M3 G1 X1 F1\nG96 S180\nX2\nG97 S700\nX3\n");
    let rpm: Vec<_> = log.motions.iter().map(|motion| motion.spindle_rpm).collect();
    assert_eq!(rpm, [Some(500.0), None, Some(700.0)]);
}

#[test]
fn dwells() {
    assert_eq!(lines("linuxcnc", "G4 P1.5\n"), ["D1.5 -"]);
    assert_eq!(
        lines("fanuc-30i", "G4 P500\nG4 X2.5\nG4 X2500\n"),
        ["D0.5 -", "D2.5 -", "D? -"],
        "2500 s or 2.5 s, as a parameter says"
    );
    assert_eq!(
        lines("sinumerik-840d", "G4 F0.5\nS60 M3\nG4 S30\n"),
        ["D0.5 -", "D30 -"]
    );
    let log = run_text("sinumerik-840d", "F200 S1000\nG4 F0.5\nG4 S3\n");
    let state = log.state.expect("a block ran");
    assert_eq!(
        (state.feed.value(), state.spindle.rpm()),
        (Some(200.0), Some(1000.0)),
        "the dwell's F and S are its own"
    );
}

#[test]
fn packed_lower_case_and_leading_zeros() {
    assert_eq!(
        lines("iso-6983", "n10g01x1y-.5f100\nG00Z+3.\n"),
        ["L X1 Y-0.5 F100", "R X1 Y-0.5 Z3"]
    );
}

#[test]
fn skipped_blocks_run() {
    assert_eq!(lines("iso-6983", "/G0 X1\n/2 G0 X2\n"), ["R X1", "R X2"]);
}

#[test]
fn axis_words_without_a_motion_code() {
    assert_eq!(lines("iso-6983", "X1\n"), ["U -"]);
    assert_eq!(
        faults("iso-6983", "X1\n"),
        [r#"1: X1: NotModelled { what: "coordinates before any motion code" }"#]
    );
    assert_eq!(
        lines("sinumerik-840d", "X1 F100\n"),
        ["L X1 F100"],
        "G1 is in effect at the start"
    );
}

fn offsets() -> Setup {
    let offset = |name: &str, x: f64| {
        let mut values = [0.0; 9];
        values[0] = x;
        WorkOffset {
            name: name.to_owned(),
            values,
        }
    };
    Setup {
        work_offsets: vec![offset("G54", 100.0), offset("G55", 130.0)],
        ..Setup::default()
    }
}

#[test]
fn work_offsets_move_the_programmed_position() {
    let (_, log) = run_bytes(
        "sinumerik-840d",
        b"G0 X1\nG54\nG0 Y1\nG55 G0 X0\nG500 Y2\nM30\n",
        &offsets(),
    );
    let got: Vec<_> = log
        .motions
        .iter()
        .map(|motion| (line(motion), motion.start.get(0), motion.zero[0]))
        .collect();
    let want = [
        ("R X1", None, 0.0),
        ("R X-99 Y1", Some(-99.0), 100.0),
        ("R X0 Y1", Some(-129.0), 130.0),
        ("R X130 Y2", Some(130.0), 0.0),
    ];
    let want: Vec<_> = want
        .iter()
        .map(|&(line, start, zero)| (line.to_owned(), start, zero))
        .collect();
    assert_eq!(got, want);
    assert_eq!(log.faults, []);
    assert_eq!(log.state.expect("a block ran").zero.offset(), None);
}

#[test]
fn additional_work_offsets_are_named_with_their_p() {
    let (_, log) = run_bytes("fanuc-30i", b"G54.1 P3\nG0 X1.\nM30\n", &offsets());
    let unset = trunnion_interp::FaultKind::WorkOffsetUnset {
        name: "G54.1 P3".to_owned(),
    };
    assert_eq!(log.faults.iter().map(|fault| &fault.kind).collect::<Vec<_>>(), [&unset]);
}

#[test]
fn first_offset_is_in_force_from_the_start_where_the_control_says_so() {
    let (_, log) = run_bytes("fanuc-30i", b"G0 X1\nM30\n", &offsets());
    assert_eq!(log.motions[0].zero[0], 100.0);
    assert_eq!(log.state.expect("a block ran").zero.offset(), Some("G54"));
}

#[test]
fn machine_coordinates_hold_for_one_block() {
    let (_, log) = run_bytes("fanuc-30i", b"G54 G0 X1 Y1 Z1\nG53 G0 X300\nY2\nM30\n", &offsets());
    let got: Vec<_> = log.motions.iter().map(line).collect();
    assert_eq!(got, ["R X1 Y1 Z1", "R X300 Y1 Z1 machine", "R X200 Y2 Z1"]);
    let machine = &log.motions[1];
    assert_eq!(
        (machine.start.get(0), machine.machine_coordinates, machine.zero[0]),
        // the work offset stays in effect, though these words are not meant from it
        (Some(101.0), true, 100.0)
    );
}

#[test]
fn a_tool_change_may_move_the_linear_axes() {
    assert_eq!(
        lines("iso-6983", "G0 X1 Y2 Z3 A4\nT1 M6\nG0 X5\n"),
        ["R X1 Y2 Z3 A4", "R X5 A4"]
    );
}

#[test]
fn what_is_not_modelled_is_forgotten() {
    assert_eq!(
        lines("fanuc-30i", "G0 X1 Y2 Z3\nG28 Z9\nX4\n"),
        ["R X1 Y2 Z3", "R X1 Y2 Z9", "U X1 Y2", "R X4 Y2"]
    );
    assert_eq!(
        // a parameter that nothing has set is not known; a name that nothing has set is refused
        lines("linuxcnc", "G0 X1 Y2 Z3\nX#5\nY#<a>\nX1\n"),
        ["R X1 Y2 Z3", "R Y2 Z3", "R X1 Z3"]
    );
    assert_eq!(
        lines("sinumerik-840d", "G0 X1 Y2 Z3\nMYSUB(1)\nX1\nL20\nY1\n"),
        ["R X1 Y2 Z3", "R X1", "R Y1"]
    );
    assert_eq!(
        lines("iso-6983", "G0 X1 Y2 Z3\nG777 X5\nY3\n"),
        ["R X1 Y2 Z3", "U Y2 Z3", "R Y3 Z3"]
    );
}

#[test]
fn cycles_run_until_they_end() {
    let fanuc = "G0 X1 Y2 Z9\nG81 X1 Y2 Z-3 R1 F100\nX5\nG80\nX6\nG81 Z-1 R1\nG1 Z0 F50\n";
    assert_eq!(
        lines("fanuc-30i", fanuc),
        [
            "R X1 Y2 Z9",
            "R X1 Y2 Z1",
            "L X1 Y2 Z-3 F100",
            "R X1 Y2 Z9",
            "R X5 Y2 Z9",
            "R X5 Y2 Z1",
            "L X5 Y2 Z-3 F100",
            "R X5 Y2 Z9",
            "R X6 Y2 Z9",
            "R X6 Y2 Z1",
            "L X6 Y2 Z-1 F100",
            "R X6 Y2 Z9",
            "L X6 Y2 Z0 F50"
        ]
    );
    // the 30i's list has cycles that only lathes run
    let lathe = "G0 X2. Z9.\nG83 X2. Z-3. R1. F100.\nC5.\nG80\nX6.\n";
    assert_eq!(lines("fanuc-30i-lathe-a", lathe), ["R X1 Z9", "U -", "U -", "R X3"]);
    let sinumerik = "G0 X1 Y2 Z9\nMCALL CYCLE81(5,0,2,-3)\nX5\nMCALL\nX6\n";
    assert_eq!(
        lines("sinumerik-840d", &sinumerik.replace("81", "99")),
        ["R X1 Y2 Z9", "U -", "R X6"]
    );
}

#[test]
fn frames_that_are_not_modelled_hide_the_position() {
    let source = "G0 X1 Y2 Z3\nROT X10 Y5\nX5\nG1 Y6 F10\nG0 SUPA Z100\nROT\nZ4\nX1\n";
    assert_eq!(
        lines("sinumerik-840d", source),
        ["R X1 Y2 Z3", "R -", "L - F10", "R Z100 machine", "R Z4", "R X1 Z4"]
    );
    let tilted = "G0 X1 Y2 Z3 A0\nG68.3 X0 Y0 Z0\nX5 A30\nG69\nX6 Y7 Z8\n";
    assert_eq!(lines("fanuc-30i", tilted), ["R X1 Y2 Z3 A0", "R A30", "R X6 Y7 Z8"]);
}

#[test]
fn trans_moves_the_zero_point() {
    let source = "G0 G91 X1 Y2 Z3\nG90 X1 Y2 Z3 A4\nTRANS X10 A30\nX5\nATRANS X1 Y-2\nX5\nSUPA Z100\nTRANS\nX5 Y2\n";
    let log = run_text("sinumerik-840d", source);
    let got: Vec<_> = log.motions[1..].iter().map(line).collect();
    assert_eq!(
        got,
        [
            "R X1 Y2 Z3 A4",
            "R X5 Y2 Z3 A-26",
            "R X5 Y4 Z3 A-26",
            "R X16 Y2 Z100 A4 machine",
            "R X5 Y2 Z100 A4"
        ]
    );
    let zeros: Vec<_> = log.motions[1..]
        .iter()
        .map(|motion| [motion.zero[0], motion.zero[1], motion.zero[3]])
        .collect();
    assert_eq!(zeros[1..4], [[10.0, 0.0, 30.0], [11.0, -2.0, 30.0], [11.0, -2.0, 30.0]]);
    assert_eq!(zeros[4], [0.0; 3]);
    assert_eq!(log.faults, []);
    // inside a frame that is not modelled, or after one, nothing is known
    for source in [
        "G0 X1 Y2 Z3\nROT X5 Y10\nATRANS X10\nX5 Y6\n",
        "G0 X1 Y2 Z3\nTRANS X10\nAROT Z10 Y5\nX5 Y6\n",
        "G0 X1 Y2 Z3\nTRANS X=R1\nX5 Y6\n",
        "G0 X1 Y2 Z3\nTRANS X10\nCYCLE800(1,\"T\",0,57,0,0,0,0,-15,0,0,0,0,-1,0)\nCYCLE800()\nX5 Y6\n",
    ] {
        assert_eq!(
            lines("sinumerik-840d", source).last().map(String::as_str),
            Some("R -"),
            "{source}"
        );
    }
}

#[test]
fn writing_zero_points_and_tools_of_the_control_hides_the_position() {
    for write in [
        "$P_PFRAME=CFRAME(X,1000)",
        "$P_UIFR[1,X,FI]=200",
        "$TC_DP3[1,1]=350",
        "$AA_OFF[X]=1",
    ] {
        let source = format!("G0 X1 Y2 Z3 A4\n{write}\nG0 X5 A6\nTRANS\nX6 A7\nSUPA Z9 A8\n");
        assert_eq!(
            lines("sinumerik-840d", &source),
            ["R X1 Y2 Z3 A4", "R -", "R -", "R Z9 A8 machine"],
            "{write}"
        );
        let got = faults("sinumerik-840d", &source);
        assert_eq!(got, [format!("2: {write}: NotModelled {{ what: {write:?} }}")]);
    }
    for (dialect, write) in [
        ("fanuc-30i", "#5204=100."),
        ("fanuc-30i", "#2001=100."),
        ("fanuc-30i", "#7004=100."),
    ] {
        let source = format!("G0 X1. Y2. Z3. A4.\n{write}\nG0 X5. A6.\n");
        assert_eq!(lines(dialect, &source), ["R X1 Y2 Z3 A4", "R -"], "{write}");
        assert_eq!(faults(dialect, &source).len(), 1, "{write}");
    }
    // LinuxCNC reads the parameters of a coordinate system only when it is selected again
    let source = "G0 X1 Y2 Z3 A4\n#5221=100\nG0 X5 A6\n";
    assert_eq!(lines("linuxcnc", source), ["R X1 Y2 Z3 A4", "R X5 Y2 Z3 A6"]);
    let own = [
        ("linuxcnc", "#1=2", 0),
        ("linuxcnc", "#2001=5", 0),
        ("linuxcnc", "#<depth>=5", 0),
        ("fanuc-30i", "#101=2.", 0),
        ("fanuc-30i", "#3006=1", 0),
        ("fanuc-30i", "#1101=1", 1),
        ("sinumerik-840d", "R1=5", 0),
        ("sinumerik-840d", "$AC_MARKER[0]=1", 1),
    ];
    for (dialect, write, said) in own {
        let source = format!("G0 X1. Y2. Z3. A4.\n{write}\nG0 X5. A6.\n");
        assert_eq!(lines(dialect, &source)[1], "R X5 Y2 Z3 A6", "{write}");
        assert_eq!(faults(dialect, &source).len(), said, "{write}");
    }
}

#[test]
fn a_tool_whose_data_are_written_has_no_known_length_under_supa() {
    let source = "T1 M6\n$TC_DP3[1,1]=350\nG0 SUPA Z9\nG0 SUPA Z9 D0\n";
    assert_eq!(lines("sinumerik-840d", source), ["R - machine", "R Z9 machine"]);
}

#[test]
fn a_frame_with_rotary_words_hides_rotary_axes_too() {
    let source = "G0 X1 A4\nROT A10\nG0 X5 A6\nROT\nA7\n";
    assert_eq!(lines("sinumerik-840d", source), ["R X1 A4", "R -", "R A7"]);
}

#[test]
fn a_sinumerik_program_ends_for_the_run_where_a_condition_is_not_decided() {
    let source = "G0 X1 Y1\nIF R1>3 GOTOF END\nX2\nEND:\nY3\n";
    assert_eq!(lines("sinumerik-840d", source), ["R X1 Y1"]);
}

#[test]
fn axis_words_beside_a_code_of_the_machine_are_never_dropped_in_silence() {
    let source = "G0 X1 Y2 Z3 A4\nG1 X9 F100 M428\nA5\nM2\n";
    let motions = lines("linuxcnc", source);
    assert_eq!(motions.last().map(String::as_str), Some("L A5 F100"));
    assert!(faults("linuxcnc", source)[0].contains("M428 with axis words in its block"));
}

#[test]
fn linuxcnc_nests_ten_calls() {
    let source = "o1 sub\no2 if [#1 GT 0]\no1 call [#1-1]\no2 endif\no1 endsub\no1 call [15]\nM2\n";
    assert_eq!(faults("linuxcnc", source).len(), 1);
}
