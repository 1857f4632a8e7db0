//! What shops write that was once read wrongly: words that were dropped, cycles without a number, blocks that the control refuses.
use crate::klartext::{NAME, program};
use crate::support::{faults, line, lines, run_bytes, run_text};

/// Whether the run of a program reports something with this text.
fn says(dialect: &str, text: &str, wanted: &str) -> bool {
    faults(dialect, text).iter().any(|fault| fault.contains(wanted))
}

#[test]
fn an_axis_by_its_place_and_by_a_distance() {
    for dialect in ["fanuc-30i-lathe-a", "haas-lathe"] {
        let text = "G21 G18 G99 T0101\nG0 X62. Z5.\nG1 Z-40. W-10. F0.2\n";
        assert!(says(dialect, text, "Z and W in one block"), "{dialect}");
        assert_eq!(run_text(dialect, text).motions[1].end.get(2), None, "{dialect}");
        assert!(says(dialect, "G0 X62. Z5.\nG1 U4. X40. F0.2\n", "X and U in one block"));
        assert!(!says(dialect, "G0 X62. Z5.\nG1 X40. W-10. F0.2\n", "in one block"));
    }
}

#[test]
fn the_feed_of_a_tool_call_holds() {
    let text = "BEGIN PGM T MM\nTOOL CALL 1 Z S1000 F6000\nL X+0 Y+0 Z+5 R0 FMAX M3\nL Z-1\nL X+10 F300\nTOOL CALL S2000 F500\nL X+20\nEND PGM T MM\n";
    assert_eq!(
        lines(NAME, text),
        [
            "R X0 Y0 Z5",
            "L X0 Y0 Z-1 F6000",
            "L X10 Y0 Z-1 F300",
            "L X20 Y0 Z-1 F500"
        ]
    );
    let per_turn = text.replace("F6000", "FU0.2");
    assert!(says(NAME, &per_turn, "FU or FZ of TOOL CALL"));
}

#[test]
fn a_hole_needs_its_step_and_its_second_clearance() {
    let hole = |number: u32, words: &str| {
        program(&format!(
            "CYCL DEF {number} DRILLING Q200=2 Q201=-20 Q206=150 Q203=+0 Q211=0 {words}\nL X+1 Y+1 Z+50 R0 FMAX M3\nCYCL CALL\n"
        ))
    };
    assert_eq!(
        faults(NAME, &hole(200, "Q202=20 Q204=50")).len(),
        1,
        "the length of the tool"
    );
    for (number, words, wanted) in [
        (200, "Q204=50", "Q202 is not known"),
        (200, "Q202=-8 Q204=50", "Q202 is negative"),
        (203, "Q204=50", "Q202 is not known"),
        (205, "Q204=50", "Q202 is not known"),
        (200, "Q202=20", "Q204 is not known"),
        (200, "Q202=20 Q204=-5", "Q204 is negative"),
        (201, "", "Q204 is not known"),
        (207, "Q239=1 Q204=-1", "Q204 is negative"),
    ] {
        assert!(says(NAME, &hole(number, words), wanted), "{number} {words}");
    }
    assert!(!says(NAME, &hole(201, "Q204=50"), "Q202"));
}

#[test]
fn a_cycle_at_a_place_and_a_single_axis_after_m94() {
    let cycle =
        "CYCL DEF 200 DRILLING Q200=2 Q201=-10 Q206=100 Q202=10 Q203=+0 Q204=20 Q211=0\nL X+0 Y+0 Z+50 R0 FMAX M3\n";
    let at = |words: &str| program(&format!("{cycle}CYCL CALL POS {words} FMAX\n"));
    assert!(!says(NAME, &at("X+10 Y+10 Z+0"), "all three axes"));
    assert!(says(NAME, &at("X+10 Y+10"), "all three axes"));
    let text = program("L X+0 Y+0 Z+50 B+10 C+400 FMAX M3\nL M94 C\nL X+5\n");
    assert!(!says(NAME, &text, "a word has no value"));
    let end = run_text(NAME, &text).motions.last().expect("a motion").end;
    assert_eq!((end.get(4), end.get(5)), (Some(10.0), None));
}

#[test]
fn grbl_refuses_whole_blocks() {
    let head = "G21 G90 G94 G17 G54\nM3 S1000\nG0 X0 Y0 Z5\nF100\n";
    for (block, alarm) in [
        ("G4 X2", "28"),
        ("G4", "28"),
        ("G4 P-1", "4"),
        ("S-1", "4"),
        ("F-1", "4"),
        ("N-5 G1 X1", "4"),
        ("G28 G1 X1", "24"),
        ("G49 G1 X1", "24"),
        ("G53 G2 X1 Y1 I1", "30"),
        ("G92", "26"),
        ("T300", "38"),
    ] {
        let text = format!("{head}{block}\nG1 X5\n");
        assert!(
            says("grbl", &text, &format!("error:{alarm}")),
            "{block}: {:?}",
            faults("grbl", &text)
        );
        assert_eq!(lines("grbl", &text), ["R X0 Y0 Z5", "L X5 Y0 Z5 F100"], "{block}");
    }
    let fine = format!("{head}N5 G4 P1\nG53 G1 Z0\nG92 X0\nT255\nG28 Z9\nG80 G49\n");
    assert!(!says("grbl", &fine, "error:"), "{:?}", faults("grbl", &fine));
}

#[test]
fn taps_turn_the_spindle_where_it_is_known() {
    let head = "G21 G17 G90 G94 G54\nG0 X0. Y0. Z20. S500 M3\n";
    let on = |text: &str| {
        let motions = run_text("fanuc-30i", text).motions;
        motions
            .iter()
            .filter(|motion| motion.is_feed())
            .map(|motion| motion.spindle_on)
            .collect::<Vec<_>>()
    };
    let two = format!("{head}G84 X10. Z-9. R2. F500.\nX20.\nG80\n");
    assert_eq!(on(&two), [Some(true); 4]);
    let off = format!("{head}M5\nG84 X10. Z-9. R2. F500.\nX20.\nG80\n");
    assert!(says("fanuc-30i", &off, "G84 with the spindle off"));
    assert_eq!(on(&off), [None; 4]);
    let rigid = off.replace("G84", "M29 S500\nG84");
    assert!(!says("fanuc-30i", &rigid, "with the spindle off"));
    assert_eq!(on(&rigid), [Some(true); 4]);
    // G80 ends what M29 announced, and a change of the tool what the tap before it says
    let after = format!("{rigid}M5\nG84 X30. Z-9. R2.\n");
    assert!(says("fanuc-30i", &after, "G84 with the spindle off"));
    let changed = format!("{head}G84 X10. Z-9. R2. F500.\nG80\nT2 M6\nG0 X0. Y0. Z20.\nG84 X10. Z-9. R2.\n");
    assert_eq!(on(&changed)[2..], [None; 2]);
}

#[test]
fn compensation_without_d_and_at_the_end() {
    let text = "G17 G90\nG0 X0. Y0. Z0.\nG41 G1 X10. F100.\nY30.\nG40 X0.\nM30\n";
    assert!(says("fanuc-30i", text, "G41 without D"));
    let with = text.replace("G41", "D1\nG41");
    assert!(!says("fanuc-30i", &with, "without D"));
    assert!(!says("fanuc-30i", &with, "CompensationLeft"));
    assert!(says("fanuc-30i", &with.replace("G40", "G1"), "CompensationLeft"));
}

#[test]
fn drilling_in_another_plane_of_a_fanuc() {
    for plane in ["G18", "G19"] {
        let text = format!("{plane} G90\nG0 X0. Y0. Z20.\nG81 X10. Y30. Z-5. R2. F100.\n");
        assert!(says("fanuc-30i", &text, "which axis drills"), "{plane}");
        let end = run_text("fanuc-30i", &text).motions.last().expect("a motion").end;
        assert_eq!(end.get(2), None, "{plane}");
    }
}

#[test]
fn drilling_in_another_plane_follows_the_declared_axis() {
    let text = "G90 G18\nG0 X0. Y20. Z20.\nG81 X10. Y3. Z-5. R2. F100.\nX20.\nG80\n";
    let run = |axis| {
        let mut setup = trunnion_interp::Setup::default();
        setup.control.drilling_axis = Some(axis);
        run_bytes("fanuc-30i", text.as_bytes(), &setup)
            .1
            .motions
            .iter()
            .map(line)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        run(trunnion_interp::DrillingAxis::Z),
        [
            "R X0 Y20 Z20",
            "R X10 Y3 Z20",
            "R X10 Y3 Z2",
            "L X10 Y3 Z-5 F100",
            "R X10 Y3 Z20",
            "R X20 Y3 Z20",
            "R X20 Y3 Z2",
            "L X20 Y3 Z-5 F100",
            "R X20 Y3 Z20",
        ]
    );
    assert_eq!(
        run(trunnion_interp::DrillingAxis::AcrossPlane)[..5],
        [
            "R X0 Y20 Z20",
            "R X10 Y20 Z-5",
            "R X10 Y2 Z-5",
            "L X10 Y3 Z-5 F100",
            "R X10 Y20 Z-5",
        ]
    );
}

#[test]
fn wrong_levels_and_an_address_without_its_sign() {
    let cycle = |call: &str| format!("G17 G90\nG0 X0 Y0 Z60\nS100 M3 F100\n{call}\nM30\n");
    let name = "sinumerik-840d";
    for (call, wanted) in [
        ("CYCLE81(50,0,2,12)", "the depth 12 is above RFP 0"),
        ("CYCLE81(-5,0,2,-12)", "RTP -5 is not above RFP 0"),
        ("CYCLE83(-1,0,2,-12,,-5,,1)", "RTP -1 is not above RFP 0"),
        ("CYCLE81(0,0,2,,12)", "61101"),
        ("CYCLE81(0,0,2,5)", "the depth 5 is above RFP 0"),
        ("CYCLE81(50,0,2)", "without known levels"),
        ("G2 X10 Y40 CR10", "write CR=10"),
    ] {
        let found = faults(name, &cycle(call));
        assert!(found.iter().any(|fault| fault.contains(wanted)), "{call}: {found:?}");
    }
    assert!(!says(name, &cycle("CYCLE81(50,0,2,-12)"), "CYCLE81"));
}

/// X is a radius in the setup, and the offset of each tool shifts the zero point.
#[test]
fn declared_offsets_of_a_lathes_tools() {
    let text = "G21 G18 G99 G54\nT0202\nG0 X62. Z5.\nG1 Z-40. F0.2\nT0303\nG0 X62. Z5.\nG10 L10 P3 R0.4\nT0303\nG0 X60. Z4.\nT0200\nG0 X62. Z5.\nM30\n";
    let mut setup = trunnion_interp::Setup::default();
    let offset = |x, z| [x, 0.0, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    setup.tool_offsets.0 = vec![(2, offset(-100.0, -50.0)), (3, offset(-90.0, -70.0))];
    let log = run_bytes("fanuc-30i-lathe-a", text.as_bytes(), &setup).1;
    let found: Vec<_> = log
        .motions
        .iter()
        .map(|motion| {
            (
                motion.zero[0],
                motion.zero[2],
                motion.undeclared.length,
                motion.end.get(2),
            )
        })
        .collect();
    assert_eq!(
        found,
        [
            (-100.0, -50.0, false, Some(5.0)),
            (-100.0, -50.0, false, Some(-40.0)),
            (-90.0, -70.0, false, Some(5.0)),
            // the program has written it
            (0.0, 0.0, true, Some(4.0)),
            (0.0, 0.0, false, Some(5.0)),
        ]
    );
}

#[test]
fn what_a_fanuc_does_with_further_numbers() {
    let name = "fanuc-30i";
    let head = "G21 G90 G17 G94\nG0 X0. Y0. Z50.\n";
    let run = |blocks: &str| faults(name, &format!("{head}{blocks}\nG0 X1.\n"));
    assert!(says(name, "G54.1 P301\n", "1 to 300") && says(name, "G54 P0\n", "1 to 300"));
    assert!(!says(name, "G54.1 P300\n", "P names") && says("haas-ngc", "G154 P100\n", "1 to 99"));
    for code in ["G5 P10001", "G50.2", "G51.2 P1 Q1", "G80.4", "G81.4 T20 L1"] {
        let found = run(code);
        assert!(
            found.iter().any(|fault| fault.contains("NotModelled")),
            "{code}: {found:?}"
        );
        assert!(
            !found.iter().any(|fault| fault.contains("UnknownCode")),
            "{code}: {found:?}"
        );
    }
    assert!(run("G5 P10000\nG5 P0").is_empty(), "{:?}", run("G5 P10000\nG5 P0"));
    let end = run_text(name, &format!("{head}G5 P10005\nG1 Y1. F100.\n"))
        .motions
        .last()
        .expect("a motion")
        .end;
    assert_eq!((end.get(0), end.get(1)), (None, Some(1.0)));
}

/// No source says which of them a control takes.
#[test]
fn a_jump_to_a_number_that_occurs_twice() {
    let text = "G90 G21 G17 G94\n#1=0\nN20 #1=#1+1\nG0 X#1\nN20 G0 Y#1\nIF[#1 LT 2]GOTO20\n";
    for dialect in ["fanuc-30i", "haas-ngc"] {
        assert!(says(dialect, text, "which of the blocks N20"), "{dialect}");
        assert!(
            !says(dialect, &text.replacen("N20", "N21", 1), "which of the blocks"),
            "{dialect}"
        );
    }
}

/// An undeclared length concerns only the axis along the tool.
#[test]
fn positions_with_offsets_across_the_tool() {
    let text = "G90 G21 G17 G94 G54\nT1 M6\nG43 H1 G0 X1. Y2. Z50.\n#1=#5041\n#2=#5042\nG0 X[#1+1.] Y[#2+1.]\n#3=#5043\nG0 Z#3\n";
    let log = run_text("fanuc-30i", text);
    let last = log.motions.last().expect("a motion").end;
    assert_eq!((last.get(0), last.get(1), last.get(2)), (Some(2.0), Some(3.0), None));
}

#[test]
fn mod_of_an_okuma_is_a_function() {
    let text = "G15 H1\nG90 G17 G94\nVC1=MOD[7,3]\nG0 X=VC1 Y=MOD[VC1+4,2]*3 Z50\n";
    assert_eq!(lines("okuma-osp", text), ["R X1 Y3 Z50"]);
    assert!(!says("okuma-osp", text, "MOD"));
}

/// Where a tool change leaves Z is declared; X and Y stay, and the next tool is 20 mm longer.
#[test]
fn a_tool_change_of_a_klartext_program() {
    let text = "BEGIN PGM T MM\nTOOL CALL 1 Z S1000\nL X+10 Y+20 Z+100 R0 FMAX M3\nTOOL CALL 2 Z S1000\nL IZ-30 FMAX\nEND PGM T MM\n";
    let mut setup = trunnion_interp::Setup::default();
    let mut place = trunnion_interp::Position::default();
    place.set(2, 300.0);
    setup.control.tool_change = Some(place);
    for (number, length) in [(1, 50.0), (2, 70.0)] {
        setup.tools.push(trunnion_interp::Tool {
            number,
            shape: None,
            diameter_mm: None,
            length_mm: Some(length),
            holder_mm: None,
        });
    }
    let ends = |setup: &trunnion_interp::Setup| -> Vec<String> {
        let log = run_bytes(NAME, text.as_bytes(), setup).1;
        log.motions.iter().map(line).collect()
    };
    assert_eq!(ends(&setup), ["R X10 Y20 Z100", "R X10 Y20 Z200"]);
    setup.control.tool_change = Some(trunnion_interp::Position::default());
    assert_eq!(ends(&setup), ["R X10 Y20 Z100", "R X10 Y20 Z50"]);
}

/// No source says whether the tool stays tilted where the program ends its tool axes.
#[test]
fn points_after_the_end_of_tool_axes() {
    let text = |axis: &str| {
        format!("UNITS/MM\nMULTAX/ON\nFEDRAT/100\nGOTO/0,0,10,{axis}\nMULTAX/OFF\nGOTO/0,0,0\nGOTO/10,0,0\n")
    };
    let wanted = "whether the tool stays tilted";
    assert!(says("apt", &text("0.6,0,0.8"), wanted));
    assert!(!says("apt", &text("0,0,1"), wanted));
    let last = run_text("apt", &text("0.6,0,0.8"))
        .motions
        .last()
        .expect("a motion")
        .orientation;
    assert_eq!(last, trunnion_interp::Orientation::Words);
}

/// From the last M91 position; where the axis has left it, the distance may count from either place.
#[test]
fn distances_in_machine_coordinates() {
    let start = "L X+0 Y+0 Z+5 R0 FMAX\n";
    let last = |blocks: &str| lines(NAME, &program(&format!("{start}{blocks}"))).pop();
    assert_eq!(
        last("L X+10 FMAX M91\nL IX+2 FMAX M91\n").as_deref(),
        Some("R X12 Y0 Z5 machine")
    );
    assert_eq!(
        last("L X+10 FMAX M91\nL Y+1 FMAX\nL IX+2 FMAX M91\nL IX+2 FMAX M91\n").as_deref(),
        Some("R X14 Y1 Z5 machine")
    );
    for blocks in [
        "L IX+2 FMAX M91\n",
        "L X+10 FMAX M91\nL X+11 FMAX\nL IX+2 FMAX M91\n",
        "L X+10 FMAX M91\nL IX+2 FMAX M92\n",
        "L Y+10 FMAX M91\nL IX+2 FMAX M91\n",
    ] {
        let end = last(blocks).expect("a motion");
        assert!(!end.contains('X'), "{blocks}: {end}");
    }
}

/// What is not followed has a name: the limit of the axis, functions of texts.
#[test]
fn reasons_of_klartext() {
    let plane = "L X+0 Y+0 Z+5 A+0 C+0 R0 FMAX\nPLANE SPATIAL SPA+10 SPB+0 SPC+0 TURN MB MAX FMAX\n";
    assert!(says(NAME, &program(plane), "MB MAX: where the retract"));
    assert!(!says(NAME, &program(&plane.replace("MAX FMAX", "50 FMAX")), "MB MAX"));
    let text = "QS1 = \"AB\"\nQS2 = QS1 || \"CD\"\nQ1 = STRLEN ( SRC_QS2 )\nL X+Q1 R0 FMAX\n";
    assert!(says(NAME, &program(text), "QS2: functions of texts are not followed"));
    assert!(!says(NAME, &program(text), "does not set its value"));
}
