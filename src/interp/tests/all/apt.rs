//! APT / CL records.
use crate::support::{faults, line, lines, run_bytes, run_text};
use trunnion_interp::{Motion, MotionKind, Setup, Tool, ToolShape};

#[test]
fn goto_from_rapid_and_feeds() {
    let source = "FROM/0,0,100\nRAPID\nGOTO/1,2,3\nFEDRAT/200,MMPM\nGOTO/4,5,6\nGODLTA/0,0,-1\nGODLTA/5\nFEDRAT/IPM,10\nGOTO/0,0,0\n";
    assert_eq!(
        lines("apt", source),
        [
            "R X1 Y2 Z3 tcp <0 0 1>",
            "L X4 Y5 Z6 F200 tcp <0 0 1>",
            "L X4 Y5 Z5 F200 tcp <0 0 1>",
            "L X4 Y5 Z10 F200 tcp <0 0 1>",
            "L X0 Y0 Z0 F254 tcp <0 0 1>",
        ]
    );
    assert_eq!(run_text("apt", source).motions[0].start.xyz().map(|p| p.z), Some(100.0));
}

#[test]
fn vectors() {
    let source = "FEDRAT/100\nMULTAX/ON\nGOTO/0,0,0, 0,0.6,0.8\nGOTO/1,0,0\nMULTAX/OFF\nGOTO/2,0,0\nGOTO/3,0,0,0,0,2\nTLAXIS/1,0,0\nGOTO/4,0,0\nGOTO/5,0,0,0,0,0\nGOTO/6,0,0\n";
    assert_eq!(
        lines("apt", source),
        [
            "L X0 Y0 Z0 F100 tcp <0 0.6 0.8>",
            "L X1 Y0 Z0 F100 tcp <0 0.6 0.8>",
            "L X2 Y0 Z0 F100 tcp",
            "L X3 Y0 Z0 F100 tcp",
            "L X4 Y0 Z0 F100 tcp <1 0 0>",
            "L X5 Y0 Z0 F100 tcp",
            "L X6 Y0 Z0 F100 tcp",
        ]
    );
    assert_eq!(
        faults("apt", source),
        [
            "4: 1,0,0: AptVectorMissing",
            "6: 2,0,0: NotModelled { what: \"a point without a tool axis after MULTAX/OFF: whether the tool stays tilted\" }",
            "7: 3,0,0,0,0,2: VectorNotUnit { norm: 2.0 }",
            "7: 3,0,0,0,0,2: NotModelled { what: \"a tool axis after MULTAX/OFF: whether the postprocessor follows it\" }",
            "10: 5,0,0,0,0,0: VectorNotUnit { norm: 0.0 }",
        ]
    );
}

#[test]
fn units() {
    let source = "UNITS/INCHES\nFEDRAT/10\nGOTO/1,0,0\nUNITS/MM\nFEDRAT/0.1,MMPR\nGOTO/1,0,0\n";
    assert_eq!(
        lines("apt", source),
        ["L X25.4 Y0 Z0 F254 tcp <0 0 1>", "L X1 Y0 Z0 F0.1/rev tcp <0 0 1>"]
    );
    assert_eq!(faults("apt", "UNITS/FURLONG\n").len(), 1);
}

#[test]
fn circles() {
    let source =
        "FEDRAT/100\nGOTO/10,0,0\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\nCIRCLE/0,0,0,0,0,-1\nGOTO/10,0,0\nGOTO/0,0,0\n";
    let log = run_text("apt", source);
    let sweeps: Vec<_> = log
        .motions
        .iter()
        .map(|motion| {
            if let MotionKind::Arc(Some(arc)) = motion.kind {
                arc.sweep.to_degrees() * arc.normal.z
            } else {
                0.0
            }
        })
        .map(f64::round)
        .collect();
    assert_eq!(sweeps, [0.0, 90.0, -90.0, 0.0], "the right hand about the axis");
    assert_eq!(log.faults, []);
}

#[test]
fn circle_faults() {
    let with = |rest: &str| faults("apt", &format!("FEDRAT/100\nGOTO/10,0,0\n{rest}\n"));
    let off = with("CIRCLE/0,0,0,0,0,1,10\nGOTO/0,12,0");
    assert_eq!(
        off,
        ["4: GOTO/0,12,0: ArcRadiusMismatch { start: 10.0, end: 12.0, tolerance: 0.01 }"]
    );
    assert_eq!(
        with("CIRCLE/0,0,0,0,0,1,11\nGOTO/0,10,0").len(),
        1,
        "the written radius is another"
    );
    assert_eq!(
        with("CIRCLE/0,0,0,0,0,1,10\nRAPID\nGOTO/0,10,0"),
        [r#"4: RAPID: NotModelled { what: "CIRCLE followed by RAPID" }"#]
    );
    assert_eq!(with("CIRCLE/C1\nGOTO/0,10,0").len(), 1);
    assert_eq!(
        lines("apt", "FEDRAT/1\nCIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\n"),
        ["A? X0 Y10 Z0 F1 tcp <0 0 1>"]
    );
}

#[test]
fn spindle_and_delay() {
    let source = "FEDRAT/1\nSPINDL/RPM,1200,CLW\nGOTO/1,0,0\nDELAY/2.5\nDELAY/10,REV\nSPINDL/OFF\nGOTO/2,0,0\nSPINDL/ON\nGOTO/3,0,0\n";
    let log = run_text("apt", source);
    let got: Vec<_> = log
        .motions
        .iter()
        .map(|motion: &Motion| (line(motion), motion.spindle_on, motion.spindle_rpm))
        .collect();
    assert_eq!((got[0].1, got[0].2), (Some(true), Some(1200.0)));
    assert!(
        got[1].0.starts_with("D2.5 ") && got[2].0.starts_with("D0.5 "),
        "{got:?}"
    );
    assert_eq!((got[3].1, got[4].1, got[4].2), (Some(false), Some(true), Some(1200.0)));
}

/// Shape and diameter in use at the end.
fn shape(source: &str) -> Option<(ToolShape, f64)> {
    run_text("apt", source).state.expect("a record ran").tool.shape()
}

#[test]
fn cutters() {
    assert_eq!(shape("CUTTER/10,5\n"), Some((ToolShape::Ball, 10.0)));
    assert_eq!(shape("CUTTER/10\n"), Some((ToolShape::Flat, 10.0)));
    assert_eq!(shape("CUTTER/6.,0,3.,0,0,0,51.\n"), Some((ToolShape::Flat, 6.0)));
    assert_eq!(shape("CUTTER/10,1,4,1,0,0,50\n"), Some((ToolShape::Bull(1.0), 10.0)));
    assert_eq!(shape("UNITS/INCHES\nCUTTER/0.5,0.25\n"), Some((ToolShape::Ball, 12.7)));
    assert_eq!(shape("CUTTER/10,1,4,1,15,0,50\n"), None, "a cone is none of the three");
    assert_eq!(shape("CUTTER/10,6\n"), None);
    assert_eq!(
        shape("CUTTER/6\nLOADTL/1\n"),
        Some((ToolShape::Flat, 6.0)),
        "for the tool that is loaded next"
    );
    assert_eq!(
        shape("CUTTER/6\nFEDRAT/1\nGOTO/1,2,3\nLOADTL/2\n"),
        None,
        "the tool before had that shape"
    );
}

#[test]
fn tools_and_lengths() {
    let tools = vec![Tool {
        number: 3,
        shape: None,
        diameter_mm: None,
        length_mm: Some(90.0),
        holder_mm: None,
    }];
    let setup = Setup {
        tools,
        ..Setup::default()
    };
    let source = b"FEDRAT/1\nLOADTL/3\nGOTO/1,2,3\nLOAD/TOOL,4\nGOTO/1,2,4\nLOADTL/4,LENGTH,55\nGOTO/1,2,5\nFINI\n";
    let (_, log) = run_bytes("apt", source, &setup);
    let got: Vec<_> = log
        .motions
        .iter()
        .map(|motion| (motion.tool, motion.tool_length_mm))
        .collect();
    assert_eq!(got, [(Some(3), 90.0), (Some(4), 0.0), (Some(4), 55.0)]);
    assert_eq!(log.faults.len(), 1, "{:?}", log.faults);
}

#[test]
fn records_that_are_not_modelled() {
    let source =
        "FEDRAT/1\nGOTO/1,2,3,1,0,0\nROTABL/30,CLW\nGOTO/1,2,3\nGOHOME\nGODLTA/1,1,1\nFROBNI/1\nPARTNO THE PART\n";
    assert_eq!(
        lines("apt", source),
        ["L X1 Y2 Z3 F1 tcp <1 0 0>", "L X1 Y2 Z3 F1 tcp", "U - tcp"],
        "after a turn of the table the axis of the tool in the part is not known"
    );
    let got = faults("apt", source);
    assert_eq!(
        got[2..],
        [
            r#"6: GODLTA/1,1,1: NotModelled { what: "GODLTA from an unknown position" }"#,
            "7: FROBNI: AptUnknownRecord",
            r#"7: FROBNI/1: NotModelled { what: "FROBNI" }"#
        ]
    );
}

#[test]
fn after_an_unknown_record_nothing_is_known() {
    for record in ["TRANSL/0,0,5", "HEAD/1", "MOVE/1,2,3", "X=5", "P1=POINT/1,2,3"] {
        let source = format!("FEDRAT/1\nGOTO/1,2,3\n{record}\nGODLTA/1,1,1\nGOTO/4,5,6,0,0,1\n");
        assert_eq!(
            lines("apt", &source),
            ["L X1 Y2 Z3 F1 tcp <0 0 1>", "U - tcp", "U - F1 tcp"],
            "{record}"
        );
        // the record, what it may be, and the GODLTA after it
        assert_eq!(faults("apt", &source).len(), 3, "{record}");
    }
    let source = "FEDRAT/1\nGOTO/1,2,3\nINSERT G0 X5\nGODLTA/1,1,1\nGOTO/4,5,6,0,0,1\n";
    assert_eq!(
        lines("apt", source),
        ["L X1 Y2 Z3 F1 tcp <0 0 1>", "U - tcp", "L X4 Y5 Z6 F1 tcp <0 0 1>"]
    );
    assert_eq!(
        faults("apt", source),
        [
            r#"3: INSERT G0 X5: NotModelled { what: "INSERT: the text that it passes to the machine is not read" }"#,
            r#"4: GODLTA/1,1,1: NotModelled { what: "GODLTA from an unknown position" }"#
        ]
    );
    let harmless = "FEDRAT/1\nGOTO/1,2,3\nPPRINT/A\nREMARK B\nSEQNO/10\nOPSKIP/ON\nGODLTA/1,1,1\n";
    assert_eq!(lines("apt", harmless)[1], "L X2 Y3 Z4 F1 tcp <0 0 1>");
    assert_eq!(faults("apt", harmless), [""; 0]);
}

#[test]
fn from_is_where_the_next_motion_starts() {
    let start = |source: &str| {
        let motion = run_text("apt", source).motions[0];
        let vector = if let trunnion_interp::Orientation::Vector(start, _) = motion.orientation {
            start.map(|v| [v.x, v.y, v.z])
        } else {
            None
        };
        (motion.start.xyz().map(|p| [p.x, p.y, p.z]), vector)
    };
    let at = Some([1.0, 2.0, 30.0]);
    assert_eq!(
        start("MULTAX/ON\nFROM/1,2,30,1,0,0\nGOTO/0,0,0,0,0,1\n"),
        (at, Some([1.0, 0.0, 0.0]))
    );
    assert_eq!(start("FROM/1,2,30\nGOTO/0,0,0\n"), (at, Some([0.0, 0.0, 1.0])));
    assert_eq!(start("MULTAX/ON\nFROM/1,2,30\nGOTO/0,0,0,0,0,1\n"), (at, None));
}

#[test]
fn cycles_and_coordinate_systems() {
    let source = "FEDRAT/1\nGOTO/1,2,3\nCYCLE/DRILL,FEDTO,10\nGOTO/2,2,3\nCYCLE/OFF\nGOTO/3,2,3\n";
    assert_eq!(
        lines("apt", source),
        [
            "L X1 Y2 Z3 F1 tcp <0 0 1>",
            "U - tcp <0 0 1>",
            "L X3 Y2 Z3 F1 tcp <0 0 1>"
        ]
    );
    let source = "FEDRAT/1\nCSYS/1,0,0,0,0,1,0,0,0,0,1,0\nGOTO/1,2,3\nCSYS/0,0,1,0,1,0,0,0,0,1,0,0\nGOTO/1,2,3\nCSYS/1,0,0,0,0,1,0,0,0,0,1,0\nGOTO/1,2,4\n";
    assert_eq!(
        lines("apt", source),
        [
            "L X1 Y2 Z3 F1 tcp <0 0 1>",
            "L X3 Y1 Z2 F1 tcp <1 0 0>",
            "L X1 Y2 Z4 F1 tcp <0 0 1>"
        ]
    );
}
