//! APT: frames in remarks, arcs in the forms of NX and CATIA, TLDATA, records that are not read, and real CL data beside the programs that
//! were posted from them.
use crate::support::{faults, lines, run_bytes, run_text, shared};
use trunnion_dialect::builtin;
use trunnion_interp::{Motion, MotionKind, Setup, ToolShape, ignored_records};

fn catia(rows: [&str; 3]) -> String {
    let [a, b, c] = rows;
    format!("$$*CATIA0\n$$*AXS1\n$$ {a}\n$$ {b}\n$$ {c}\n")
}

/// The example of the CATIA help: one path, written in two machining axis systems.
#[test]
fn a_machining_axis_of_catia_puts_points_into_the_part() {
    let first = catia(["1.00000 0.00000 0.00000 0.00000", "0 1 0 0", "0 0 1 0"]);
    let second = catia(["1.00000 0.00000 0.00000 0.00000", "0 1 0 0", "0 0 1 20.00000"]);
    let text = format!("FEDRAT/9\n{first}GOTO/-40,-30,20\n{second}GOTO/-40,-30,0\nGODLTA/0,60,0\n");
    assert_eq!(
        lines("apt", &text),
        [
            "L X-40 Y-30 Z20 F9 tcp <0 0 1>",
            "L X-40 Y-30 Z20 F9 tcp <0 0 1>",
            "L X-40 Y30 Z20 F9 tcp <0 0 1>"
        ]
    );
    assert_eq!(faults("apt", &text), [""; 0]);
    let turned = catia(["0 0 1 5", "1 0 0 0", "0 1 0 0"]);
    assert_eq!(
        lines("apt", &format!("FEDRAT/9\n{turned}GOTO/1,2,3\n")),
        ["L X8 Y1 Z2 F9 tcp <1 0 0>"]
    );
    for broken in [
        catia(["1 0 0 0", "0 1 0 0", "0 0 -1 0"]),
        "$$*CATIA0\n$$ A\n$$ 1 0 0 0\n$$ 0 1 0 0\n".to_owned(),
        "$$*CATIA0\n$$ A\n$$ 1 0 0 0\n$$ B\n".to_owned(),
    ] {
        let text = format!("FEDRAT/9\n{broken}GOTO/1,2,3\n");
        assert_eq!(faults("apt", &text).len(), 1, "{broken}");
        assert!(faults("apt", &text)[0].contains("CATIA0"), "{broken}");
        assert!(run_text("apt", &text).motions[0].end.xyz().is_none(), "{broken}");
    }
}

/// What a `$$-> CSYS` that is not the unit frame means for the points is in no source.
#[test]
fn a_system_of_a_pro_clfile_is_followed_only_where_it_is_the_unit_frame() {
    let text = |rows: &str| format!("FEDRAT/9\n$$-> CSYS / {rows}\nGOTO/1,2,3\n");
    let unit = text("1.0, 0.0, 0.0, 0.0, $\n 0.0, 1.0, 0.0, 0.0, $\n 0.0, 0.0, 1.0, 0.0");
    assert_eq!(lines("apt", &unit), ["L X1 Y2 Z3 F9 tcp <0 0 1>"]);
    assert_eq!(faults("apt", &unit), [""; 0]);
    for rows in ["0,-1,0,0,1,0,0,0,0,0,1,0", "1,0,0,5,0,1,0,0,0,0,1,0", "1,0,0"] {
        let moved = text(rows);
        assert!(run_text("apt", &moved).motions[0].end.xyz().is_none(), "{rows}");
        assert!(faults("apt", &moved)[0].contains("$$-> CSYS"), "{rows}");
        let back = format!("{moved}{}", text("1,0,0,0,0,1,0,0,0,0,1,0"));
        assert!(run_text("apt", &back).motions[1].end.xyz().is_some(), "{rows}");
    }
}

#[test]
fn a_circle_of_nx_has_eleven_numbers() {
    let arc = "FEDRAT/9\nGOTO/30,0,0\nCIRCLE/0,0,0,0,0,1,30,0.06,0.5,30,0\nGOTO/0,30,0\n";
    assert_eq!(lines("apt", arc)[1], "A(0 0 0; 90) X0 Y30 Z0 F9 tcp <0 0 1>");
    assert_eq!(faults("apt", arc), [""; 0]);
    // as a parser of posts has it in its tests: the last four numbers do not change the arc
    let other = "FEDRAT/9\nGOTO/236.4575,-30,0\nCIRCLE/206.4575,-30,0,0,0,1,30,0.06,0.5,30,0\nGOTO/206.4575,0,0\n";
    assert_eq!(
        lines("apt", other)[1],
        "A(206.4575 -30 0; 90) X206.4575 Y0 Z0 F9 tcp <0 0 1>"
    );
    let off = arc.replace(",30,0.06", ",31,0.06");
    assert!(
        faults("apt", &off)[0].contains("ArcRadiusMismatch"),
        "{:?}",
        faults("apt", &off)
    );
}

/// TLON,GOFWD/(CIRCLE/...): the direction is that of INDIRV, the end where the line crosses.
#[test]
fn arcs_as_catia_writes_them() {
    let arc =
        |direction: &str, drive: &str| format!("FEDRAT/9\nGOTO/40,20,5\nINDIRV/{direction}\n{drive}\nGODLTA/0,0,1\n");
    let up = "TLON,GOFWD/ (CIRCLE/   10.,   20.,    5.,$\n   30.),ON,(LINE/  10.,20.,5.,$\n  10.,50.,5.)";
    let found = lines("apt", &arc("0,1,0", up));
    assert_eq!(
        found[1..],
        [
            "A(10 20 5; 90) X10 Y50 Z5 F9 tcp <0 0 1>",
            "L X10 Y50 Z6 F9 tcp <0 0 1>"
        ]
    );
    assert_eq!(faults("apt", &arc("0,1,0", up)), [""; 0]);
    // the other way round the first crossing is below the centre
    assert_eq!(
        lines("apt", &arc("0,-1,0", up))[1],
        "A(10 20 5; 90) X10 Y-10 Z5 F9 tcp <0 0 1>"
    );
    let second = up.replace("ON,(", "ON,2,INTOF,(");
    assert_eq!(
        lines("apt", &arc("0,-1,0", &second))[1],
        "A(10 20 5; 270) X10 Y50 Z5 F9 tcp <0 0 1>"
    );
    let off = up.replace("30.)", "31.)");
    assert!(faults("apt", &arc("0,1,0", &off))[0].contains("ArcRadiusMismatch"));
    for (direction, drive) in [
        // neither way round
        ("1,0,0", up),
        // the line misses the circle, or begins where the tool is
        ("0,1,0", "TLON,GOFWD/(CIRCLE/10,20,5,30),ON,(LINE/100,0,5,100,9,5)"),
        ("0,1,0", "TLON,GOFWD/(CIRCLE/10,20,5,30),ON,(LINE/10,20,5,40,20,5)"),
        ("0,1,0", "TLON,GOFWD/C1,ON,L1"),
        ("0,1,0", "TLLFT,GOLFT/L1"),
    ] {
        let text = arc(direction, drive);
        assert_eq!(
            run_text("apt", &text)
                .motions
                .last()
                .and_then(|motion| motion.end.xyz()),
            None,
            "{drive}"
        );
        assert!(!faults("apt", &text).is_empty(), "{drive}");
    }
    let alone = "FEDRAT/9\nGOTO/40,20,5\nTLON,GOFWD/(CIRCLE/10,20,5,30),ON,(LINE/10,20,5,10,50,5)\n";
    assert!(faults("apt", alone)[0].contains("TLON"), "without a direction");
}

#[test]
fn tool_data_of_nx() {
    let shape = |text: &str| {
        let text = format!("{text}\nLOAD/TOOL,2\nFEDRAT/9\nGOTO/1,2,3\n");
        run_text("apt", &text).state.expect("a record ran").tool.shape()
    };
    assert_eq!(
        shape("TLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000"),
        Some((ToolShape::Flat, 10.0))
    );
    assert_eq!(shape("TLDATA/MILL,10,5,75,0,0"), Some((ToolShape::Ball, 10.0)));
    assert_eq!(
        shape("UNITS/INCHES\nTLDATA/MILL,1,.25,3,0,0"),
        Some((ToolShape::Bull(6.35), 25.4))
    );
    assert_eq!(shape("TLDATA/MILL,10,1,75,15,0"), None, "tapered");
    assert_eq!(shape("CUTTER/10\nTLDATA/DRILL,MILL,6,0,50,59,40"), None, "another tool");
}

#[test]
fn records_that_are_not_read_are_counted() {
    let text = b"PARTNO A\nSEQNO/1\nCUTTER/5\nSEQNO/2\nCLAMP/X\nGOTO/1,2,3\nFOO/1\nCOOLNT/ON\nFINI\n";
    let (program, _) = run_bytes("apt", text, &Setup::default());
    let found: Vec<(String, u32)> = ignored_records(&program, builtin("apt").expect("built in"))
        .into_iter()
        .map(|records| (records.name, records.count))
        .collect();
    assert_eq!(found, [("SEQNO".to_owned(), 2), ("CLAMP".to_owned(), 1)]);
}

/// The places of feed motions to 0.001 mm, without repetitions.
fn places(motions: &[Motion]) -> Vec<[f64; 3]> {
    let mut places: Vec<[f64; 3]> = motions
        .iter()
        .filter(|motion| matches!(motion.kind, MotionKind::Linear | MotionKind::Arc(_)))
        .filter_map(|motion| motion.end.xyz())
        .map(|end| [end.x, end.y, end.z].map(|value| (value * 1e3).round() / 1e3))
        .collect();
    places.dedup();
    places
}

/// The text of CL data without its hole cycles, and the records of one system alone.
fn milling(text: &str, system: &str) -> String {
    let (mut here, mut hole) = (true, false);
    let mut own = String::new();
    for line in text.lines() {
        if line.starts_with("CSYS/") {
            here = line == system;
        }
        hole = (hole || line.starts_with("CYCLE/")) && !line.starts_with("CYCLE/OFF");
        let moves = line.starts_with("GOTO") || line.starts_with("CIRCLE");
        if here && !hole && !line.starts_with("CYCLE")
            || !moves && !line.starts_with("CYCLE") && !line.starts_with("CSYS/")
        {
            own += &line.replace("INSERT/", "PPRINT/");
            own.push('\n');
        }
    }
    own
}

/// rot and tilt of `;axis 1.000 0.000 0.000 rot 0.000 tilt 90.000`, deg: how the post turned the part so that the tool is along Z.
fn turned(posted: &str) -> [f64; 2] {
    let words: Vec<&str> = posted.split_whitespace().collect();
    let after = |name: &str| {
        let at = words
            .iter()
            .position(|word| *word == name)
            .expect("the line with the axis");
        words[at + 1].parse::<f64>().unwrap_or(0.0)
    };
    [after("rot"), after("tilt")]
}

/// CL data with one or two systems (CSYS), and the Klartext programs that were posted from them. The post says by which angles it turned the
/// part; so the points in the part, turned by these, are those of the posted program.
#[test]
fn cl_data_have_the_targets_of_the_programs_posted_from_them() {
    let mut compared = 0;
    for (part, setups) in [
        ("boss", &["11", "12"][..]),
        ("wall-holes", &["11", "12"]),
        ("basemach", &["11"]),
        ("Teflon-gasket", &["11"]),
        ("Dem-target2", &["11"]),
    ] {
        let folder = format!("apt/solidworks-cam/{part}");
        let Some(records) = shared(&format!("{folder}/{part}.apt")) else {
            return;
        };
        let text = String::from_utf8_lossy(&records).replace("\r\n", "\n");
        let mut systems: Vec<&str> = text.lines().filter(|line| line.starts_with("CSYS/")).collect();
        systems.dedup();
        let mut known = std::collections::BTreeSet::new();
        systems.retain(|system| known.insert(*system));
        assert_eq!(systems.len(), setups.len(), "{part}");
        for (system, setup) in systems.iter().zip(setups) {
            let motions = run_text("apt", &milling(&text, system)).motions;
            let posted = shared(&format!("{folder}/{setup}.h")).expect("posted beside its records");
            let posted = String::from_utf8_lossy(&posted).into_owned();
            let [rot, tilt] = turned(&posted).map(|degrees| trunnion_geometry::math::sin_cos(degrees.to_radians()));
            let posted: Vec<&str> = posted
                .lines()
                .filter(|line| !line.contains("CYCL") && !line.contains("M99"))
                .collect();
            let klartext = run_text("heidenhain-klartext", &posted.join("\n")).motions;
            let own: Vec<[f64; 3]> = places(&motions)
                .into_iter()
                .map(|[x, y, z]| {
                    let (x, y) = (rot.1 * x - rot.0 * y, rot.0 * x + rot.1 * y);
                    [tilt.1 * x - tilt.0 * z, y, tilt.0 * x + tilt.1 * z]
                })
                .collect();
            let theirs = places(&klartext);
            if own.len() != theirs.len() {
                // a hole that the post writes in another way
                eprintln!(
                    "{part} {setup}: {} and {} places, not compared",
                    own.len(),
                    theirs.len()
                );
                assert!(
                    !matches!((part, *setup), ("boss", _) | ("wall-holes", "12")),
                    "{part} {setup}"
                );
                continue;
            }
            for (at, (a, b)) in own.iter().zip(&theirs).enumerate() {
                // both round to 0.001 mm
                let off = (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
                assert!(off <= 0.001 + 1e-6, "{part} {setup}, place {at}: {a:?} and {b:?}");
            }
            compared += own.len();
        }
    }
    eprintln!("{compared} places of posted programs");
    assert!(compared > 9_000, "{compared}");
}

/// OFF and MODAL are words of one post-processor.
#[test]
fn words_of_rapid_make_the_motions_after_it_unknown() {
    for words in ["OFF", "MODAL", "1"] {
        let text = format!("FEDRAT/9,MMPM\nGOTO/0,0,0\nRAPID/{words}\nGOTO/1,2,3\nGOTO/2,2,3\n");
        assert_eq!(
            lines("apt", &text)[1..],
            ["U X1 Y2 Z3 <0 0 1>", "U X2 Y2 Z3 <0 0 1>"].map(|line| line.replace(" <", " tcp <")),
            "{words}"
        );
        assert_eq!(faults("apt", &text).len(), 1, "{words}");
    }
    assert!(lines("apt", "RAPID/\nGOTO/1,2,3\n")[0].starts_with("R X1"));
}

#[test]
fn a_feed_without_its_unit_is_per_minute_unless_another_unit_was_named() {
    for (before, known) in [
        ("", true),
        ("FEDRAT/100,MMPM\n", true),
        ("FEDRAT/100,PERMIN\n", true),
        ("FEDRAT/0.1,MMPR\n", false),
        ("FEDRAT/5,IPM\n", false),
        ("FEDRAT/5,INVERS\n", false),
    ] {
        for record in ["FEDRAT/9\nGOTO/1,2,3\n", "GOTO/1,2,3,0,0,1,9\n"] {
            let found = lines("apt", &format!("{before}{record}"));
            assert_eq!(found[0].contains(" F9 "), known, "{before}{record}: {found:?}");
            let told = faults("apt", &format!("{before}{record}")).len();
            assert_eq!(told, usize::from(!known), "{before}{record}");
        }
    }
}

/// A TRANS without numbers is unknown, and NOMORE ends that; one with numbers goes on, as far as any source says.
#[test]
fn nomore_ends_no_shift_that_is_followed() {
    for record in ["TRANS", "ORIGIN"] {
        let text = format!("FEDRAT/9,MMPM\n{record}/5,0,0\nGOTO/1,2,3\n{record}/NOMORE\nGOTO/1,2,3\n");
        let ends: Vec<_> = run_text("apt", &text)
            .motions
            .iter()
            .map(|motion| motion.end.xyz())
            .collect();
        assert!(ends[0].is_some() && ends[1].is_none(), "{record}");
        assert_eq!(faults("apt", &text).len(), 1, "{record}");
        let plain = format!("FEDRAT/9,MMPM\n{record}/NOMORE\nGOTO/1,2,3\n");
        assert!(run_text("apt", &plain).motions[0].end.xyz().is_some(), "{record}");
        assert_eq!(faults("apt", &plain), [""; 0], "{record}");
    }
}

#[test]
fn an_auxiliary_code_does_what_its_number_does() {
    let after = |record: &str| {
        let log = run_text(
            "apt",
            &format!("SPINDL/500,CLW\nFEDRAT/9,MMPM\nGOTO/0,0,0\n{record}\nGODLTA/1,0,0\n"),
        );
        let motion = log.motions.last().copied().expect("a motion");
        (log.motions.len(), motion.spindle_on, motion.end.xyz().is_some())
    };
    assert_eq!(after("AUXFUN/5"), (2, Some(false), true));
    assert_eq!(after("AUXFUN/0"), (2, None, true));
    assert_eq!(after("AUXFUN/8"), (2, Some(true), true));
    assert_eq!(after("AUXFUN/77"), (2, Some(true), true));
    assert_eq!(after("SPINDL/OFF\nAUXFUN/77"), (2, None, true));
    assert_eq!(after("SPINDL/OFF\nAUXFUN/3"), (2, Some(true), true));
    assert_eq!(after("AUXFUN/30"), (1, Some(true), true));
    for unknown in ["AUXFUN/6", "AUXFUN/7,8", "AUXFUN/7,NEXT", "PALLET/2", "RESET/ALL"] {
        assert!(!after(unknown).2, "{unknown}");
    }
}
