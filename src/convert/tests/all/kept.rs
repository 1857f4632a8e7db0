//! Nothing that a block asks for vanishes without a word: it is written, listed as left out, or the conversion is refused by name.
use crate::support::{refusal, text, to};
use trunnion_convert::Options;

/// A few blocks before and after those that are tried, in the words of a dialect.
fn around(dialect: &str, blocks: &str) -> String {
    let (head, tail) = match dialect {
        "sinumerik-840d" => (
            "G710 G17 G90 G94 G54\nT1 M6\nD1\nS500 M3\nG0 X10 Y0 Z5\n",
            "G1 X5 F100\nM5\nM30\n",
        ),
        "linuxcnc" => (
            "G21 G17 G90 G94 G54\nT1 M6\nG43 H1\nS500 M3\nG0 X10 Y0 Z5\n",
            "G1 X5 F100\nM5\nM2\n",
        ),
        "fanuc-30i-lathe-a" => (
            "G21 G18 G98 G54\nT0101\nG97 S500 M3\nG0 X50. Z5.\nG0 X40.\n",
            "G1 X30. F100.\nM5\nM30\n",
        ),
        _ => (
            "G21 G17 G90 G94 G54\nT1 M6\nG43 H1\nS500 M3\nG0 X10. Y0. Z5.\n",
            "G1 X5. F100.\nM5\nM30\n",
        ),
    };
    format!("{head}{blocks}\n{tail}")
}

/// Each is refused in line 6, by name.
fn refused(dialect: &str, targets: &[&str], all: &[(&str, &str)]) {
    for (blocks, name) in all {
        for target in targets {
            let text = around(dialect, blocks);
            let refused = refusal(to((&text, dialect, ""), target, "", &Options::default()));
            assert!(
                refused.message.contains(name),
                "{dialect} to {target}, {blocks}: {refused}"
            );
            let line = 6 + blocks.matches('\n').count() as u32;
            assert_eq!(
                refused.place.map(|(line, _)| line),
                Some(line),
                "{dialect} to {target}, {blocks}: {refused}"
            );
        }
    }
}

#[test]
fn a_fanuc_asks_for_more_than_motions() {
    let all = [
        ("G84 Z-5. R2. F500.", "G84"),
        ("M29 S500\nG84 Z-5. R2. F500.", "G84"),
        ("G84.2 Z-5. R2. F500.", "G84.2"),
        ("G74 Z-5. R2. F500.", "G74"),
        ("G33 Z-5. F1.", "G33"),
        ("G34 Z-5. F1. K0.1", "G34"),
        ("G63", "G63"),
        ("G76 Z-5. R2. Q1. F100.", "G76"),
        ("G88 Z-5. R2. P100 F100.", "G88"),
        ("G96 S100", "G96"),
        ("G92 S3000", "G92 S3000"),
        ("G92 X3.", "G92"),
        ("G10 L2 P1 X3. Y0. Z0.", "G10 L2"),
        ("G10 L10 P2 R90.", "G10 L10"),
        ("#500=1", "#500"),
        ("#[499+1]=1", "#["),
        ("#3006=1(CHECK)", "#3006"),
        ("#3000=1(STOP)", "#3000"),
        ("#1101=1", "#1101"),
        ("M19", "M19"),
        ("M29 S500", "M29"),
        ("M62", "M62"),
        ("M60", "M60"),
        ("G61", "G61"),
        ("G9 G1 X8. F100.", "G9"),
        ("G62", "G62"),
        ("G64 P1", "P1"),
        ("G5.1 Q1", "G5.1 Q1"),
        ("G5 P10000", "G5 P10000"),
        ("G8 P1", "G8 P1"),
        ("G26", "G26"),
        ("G22", "G22"),
        ("/M8", "block delete"),
        ("G1 X8. /Y2. F100.", "depends on a switch"),
        ("DPRNT[X#1[53]]", "DPRNT"),
    ];
    refused("fanuc-30i", &["sinumerik-840d", "apt"], &all);
}

#[test]
fn a_haas_asks_for_more_than_motions() {
    let all = [
        ("G84 Z-5. R2. F500.", "G84"),
        ("G84 Z-5. R2. F500. J2", "G84"),
        ("G74 Z-5. R2. F500.", "G74"),
        ("G184 Z-5. F500.", "G184"),
        ("G187 P3 E0.01", "G187 P3 E0.01"),
        ("G187", "G187"),
        ("G61", "G61"),
        ("G103 P1", "G103 P1"),
        ("M19 P90", "M19 P90"),
        ("M59 P1105", "M59 P1105"),
        ("M51", "M51"),
        ("M36", "M36"),
        ("M109 P501", "M109"),
        ("M10", "M10"),
        ("#3006=1(CHECK)", "#3006"),
        ("#501=1", "#501"),
    ];
    refused("haas-ngc", &["fanuc-30i", "apt"], &all);
}

#[test]
fn a_sinumerik_asks_for_more_than_motions() {
    let all = [
        ("G331 Z-5 K1 S500", "G331"),
        ("G332 Z5 K1", "G332"),
        ("G33 Z-5 K1", "G33"),
        ("G63 Z-5 F100", "G63"),
        ("CYCLE84(5,0,2,-5,,1,5,,1,0,500,500)", "CYCLE84"),
        ("CYCLE840(5,0,2,-5,,1,4,3,0,,1)", "CYCLE840"),
        ("MCALL CYCLE84(5,0,2,-5,,1,5,,1,0,500,500)", "CYCLE84"),
        ("CYCLE86(5,0,2,-5,,1,3,1,1,1,90)", "CYCLE86"),
        ("SPOS=90", "SPOS"),
        ("SPOSA=90", "SPOSA"),
        ("SPOS[1]=90", "SPOS"),
        ("M19", "M19"),
        ("M70", "M70"),
        ("M2=3", "M2=3"),
        ("S2=1000", "S2"),
        ("H5", "H5"),
        ("H2=5", "H2"),
        ("M41", "M41"),
        ("M77", "M77"),
        ("R1=5", "R1"),
        ("LIMS=3000", "LIMS"),
        ("G26 S3000", "G26"),
        ("G96 S100", "G96"),
        ("G97 S100", "G97"),
        ("G60", "G60"),
        ("G9 G1 X8 F100", "G9"),
        ("G641 ADIS=0.5", "G641"),
        ("ADIS=0.5", "ADIS"),
        ("CTOL=0.01", "CTOL"),
        ("OTOL=0.01", "OTOL"),
        ("CYCLE832(0.01,1,1)", "CYCLE832"),
        ("COMPCAD", "COMPCAD"),
        ("COMPON", "COMPON"),
        ("SOFT", "SOFT"),
        ("BRISK", "BRISK"),
        ("FFWON", "FFWON"),
        ("DYNFINISH", "DYNFINISH"),
        ("SETAL(65000)", "SETAL"),
        ("$A_OUT[1]=1", "$A_OUT"),
        ("GUD_COUNT=3", "GUD_COUNT"),
        ("/G1 X8 F100", "block delete"),
    ];
    refused("sinumerik-840d", &["fanuc-30i", "apt", "sinumerik-840d"], &all);
}

#[test]
fn a_linuxcnc_asks_for_more_than_motions() {
    let all = [
        ("G33 Z-5 K1", "G33"),
        ("G33.1 Z-5 K1", "G33.1"),
        ("G76 Z-5 I-1 J0.2 K1 P1.5", "G76"),
        ("G84 Z-5 R2 F500", "G84"),
        ("G74 Z-5 R2 F500", "G74"),
        ("M19 R90", "M19 R90"),
        ("M62 P1", "M62 P1"),
        ("M63 P1", "M63 P1"),
        ("M64 P1", "M64 P1"),
        ("M65 P1", "M65 P1"),
        ("M66 P0 L0", "M66 P0 L0"),
        ("M67 E0 Q1", "M67 E0 Q1"),
        ("M68 E0 Q1", "M68 E0 Q1"),
        ("M50 P0", "M50 P0"),
        ("M100 P1 Q2", "M100 P1 Q2"),
        ("G64 P0.1 Q0.05", "G64 P0.1 Q0.05"),
        ("G61", "G61"),
        ("G61.1", "G61.1"),
        ("G10 L2 P2 X5", "G10 L2 P2"),
        ("G10 L1 P1 Z5", "G10 L1 P1"),
        ("G92 X3", "G92"),
        ("G28.1", "G28.1"),
        ("#100=1", "#100"),
        ("#<_kept>=1", "#<_KEPT>"),
        ("G96 D1000 S100", "G96"),
        ("(LOGOPEN,log.txt)", "LOGOPEN"),
    ];
    refused("linuxcnc", &["fanuc-30i", "apt"], &all);
}

#[test]
fn a_lathe_asks_for_more_than_motions() {
    let all = [
        ("G32 Z-20. F1.", "G32"),
        ("G34 Z-20. F1. K0.1", "G34"),
        ("G92 X28. Z-20. F1.", "G92"),
        ("G76 P010060 Q100 R0.1\nG76 X28. Z-20. P1000 Q300 F1.", "G76"),
        ("G84 Z-20. F1.", "G84"),
        ("G50 S2000", "G50 S2000"),
        ("G96 S100", "G96"),
    ];
    for (blocks, name) in all {
        let text = around("fanuc-30i-lathe-a", blocks);
        let refused = refusal(to(
            (&text, "fanuc-30i-lathe-a", ""),
            "sinumerik-840d",
            "",
            &Options::default(),
        ));
        assert!(refused.message.contains(name), "{blocks}: {refused}");
    }
}

/// What taps, threads or follows a cutting speed cannot be left out by name; what stores, stops or smooths can, and is listed.
#[test]
fn only_what_moves_nothing_can_be_left_out() {
    let drop = |name: &str| Options {
        drop: vec![name.to_owned()],
        ..Options::default()
    };
    for (blocks, name) in [
        ("G84 Z-5. R2. F500.\nG80", "G84"),
        ("G33 Z-5. F1.", "G33"),
        ("G96 S100", "G96"),
    ] {
        let text = around("fanuc-30i", blocks);
        let refused = refusal(to((&text, "fanuc-30i", ""), "sinumerik-840d", "", &drop(name)));
        assert!(
            refused.message.contains(name) && !refused.message.contains("--drop"),
            "{refused}"
        );
    }
    for (blocks, name) in [("G5.1 Q1", "G5.1"), ("#500=1", "#500"), ("M62", "M62"), ("M19", "M19")] {
        let text = around("fanuc-30i", blocks);
        let made = to((&text, "fanuc-30i", ""), "sinumerik-840d", "", &drop(name));
        let made = made.unwrap_or_else(|refused| panic!("{blocks}: {refused}"));
        assert_eq!(made.left_out, [(name.to_owned(), 6)]);
    }
}

/// What asks for nothing, what is restated, and what belongs to the program alone is no reason to refuse.
#[test]
fn what_asks_for_nothing_is_converted() {
    let all: &[(&str, &[&str])] = &[
        (
            "fanuc-30i",
            &[
                "N10 (A COMMENT)",
                "G21 G17 G90 G94 G54 G40 G80",
                "#1=5.\nG1 X#1 F100.",
                "#100=5.\nG1 X#100 F100.",
                "IF[1 EQ 1]GOTO 5\nM62\nN5",
                "#1=0\nWHILE[#1 LT 3]DO1\nG1 X#1 F100.\n#1=#1+1\nEND1",
                "G64",
                "G5.1 Q0",
                "T2",
                "M3",
                "M03 S0500",
                "G81 Z-5. R2. F100.\nX20.\nG80",
                "G82 Z-5. R2. P100 F100.\nG80",
                "G43 H1",
                "G4 P100",
                "M8\nM9",
                "M0",
                "M1",
            ],
        ),
        (
            "sinumerik-840d",
            &[
                "MSG(\"ROUGH\")",
                "MSG()",
                "G64",
                "COMPOF",
                "FNORM",
                "TRANS",
                "TRAFOOF",
                "DEF REAL COUNT\nCOUNT=5",
                "M8\nM9",
                "G1 X=IC(5) F100",
                "F100\nCYCLE81(5,0,2,-5)",
            ],
        ),
        (
            "linuxcnc",
            &[
                "(MSG,ROUGH)",
                "(DEBUG,ROUGH)",
                "G64",
                "#1=5\nG1 X#1 F100",
                "#<mine>=5\nG1 X#<mine> F100",
                "o100 sub\nG1 X7 F100\no100 endsub\no100 call",
                "G83 Z-5 R2 Q1 F100\nG80",
                "M7\nM8\nM9",
            ],
        ),
    ];
    for (dialect, programs) in all {
        let target = if *dialect == "sinumerik-840d" {
            "haas-ngc"
        } else {
            "sinumerik-840d"
        };
        for blocks in *programs {
            let source = around(dialect, blocks);
            let made = to((&source, dialect, ""), target, "", &Options::default());
            let _ = made.unwrap_or_else(|refused| panic!("{dialect}, {blocks}: {refused}"));
        }
    }
}

/// M99 at the end starts the main program again.
#[test]
fn a_program_that_starts_again_is_refused() {
    let source = around("fanuc-30i", "").replace("M30", "M99");
    let refused = refusal(to(
        (&source, "fanuc-30i", ""),
        "sinumerik-840d",
        "",
        &Options::default(),
    ));
    assert!(refused.message.contains("M99"), "{refused}");
}

/// Direction of the spindle, coolant and stops are written where they stood.
#[test]
fn spindle_coolant_and_stops_keep_their_places() {
    let source = around("fanuc-30i", "M4\nM8\nG1 X8. F100.\nM5\nM0\nM3\nG1 X7. M9\nM1");
    let written = text(to(
        (&source, "fanuc-30i", ""),
        "sinumerik-840d",
        "",
        &Options::default(),
    ));
    let lines: Vec<&str> = written
        .lines()
        .map(|line| line.split_once(' ').map_or(line, |(_, rest)| rest))
        .collect();
    let wanted = [
        "S500 M4",
        "M8",
        "G1 X8 F100",
        "M5",
        "M0",
        "S500 M3",
        "X7",
        "M9",
        "M1",
        "X5",
        "M5",
        "M30",
    ];
    assert!(lines.ends_with(&wanted), "{written}");
}

/// G0 X Y, then G43 H Z: the tool comes down where it has arrived, not along a slope.
#[test]
fn an_approach_stays_two_moves() {
    let approach = "G21 G17 G90 G94 G54\nT1 M6\nS500 M3\nG0 X10. Y20.\nG43 H1 Z5.\nG1 Z-1. F100.\nM5\nM30\n";
    for machine in ["", "mill-3axis"] {
        let from = (approach, "fanuc-30i", machine);
        for (target, first, second) in [
            ("sinumerik-840d", "G0 X10 Y20", "X10 Y20 Z5"),
            ("haas-ngc", "G0 X10. Y20.", "X10. Y20. Z5."),
            ("linuxcnc", "G0 X10 Y20", "X10 Y20 Z5"),
        ] {
            let made = to(from, target, machine, &Options::default()).unwrap_or_else(|refused| panic!("{refused}"));
            let lines: Vec<&str> = made.text.lines().collect();
            let at = lines.iter().position(|line| line.ends_with(first));
            let at = at.unwrap_or_else(|| panic!("{target}\n{}", made.text));
            assert!(
                lines[at + 1..].iter().take(2).any(|line| line.ends_with(second)),
                "{target}\n{}",
                made.text
            );
            assert_eq!(made.proof.left_out, 0);
        }
    }
}

/// The same with rotary axes: turned and positioned before the tip is led, as it was.
#[test]
fn an_approach_on_five_axes_stays_as_it_was() {
    let approach = "G21 G17 G90 G94 G54\nT1 M6\nS500 M3\nG0 A10. C20.\nX10. Y20.\nG43.4 H1 Z50.\nX10. Y20. Z5. A10. C20.\n\
        G1 Z-1. F100.\nG49\nM5\nM30\n";
    let name = "mikron-ucp710";
    let made = to(
        (approach, "fanuc-30i", name),
        "sinumerik-840d",
        name,
        &Options::default(),
    );
    let written = text(made);
    let place = |text: &str| written.find(text).unwrap_or_else(|| panic!("no {text} in\n{written}"));
    assert!(
        place("G0 A10 C20\n") < place("X10 Y20\n") && place("X10 Y20\n") < place("TRAORI\n"),
        "{written}"
    );
    // on another machine X and Y lie elsewhere: it would run in all axes at once
    let refused = refusal(to(
        (approach, "fanuc-30i", name),
        "sinumerik-840d",
        "ferrari-bc",
        &Options::default(),
    ));
    assert!(
        refused.message.contains("in all axes at once") && refused.place.is_some_and(|(line, _)| line == 5),
        "{refused}"
    );
}

/// A zero point that the program shifts is not in the program after, and CL data have only one.
#[test]
fn a_shifted_zero_point_is_not_lost() {
    for blocks in ["G52 X3.\nG1 X8. F100.", "G52 X3.\nG52 X0.\nG1 X8. F100."] {
        let shifted = blocks.matches("G52").count() == 1;
        let source = format!("G21 G17 G90 G94 G54\nS500 M3\n{blocks}\n").replace("G1", "G0 X1. Y1. Z1.\nG1") + "M30\n";
        let made = to((&source, "fanuc-30i", ""), "sinumerik-840d", "", &Options::default());
        match made {
            Ok(made) => assert!(!shifted, "{}", made.text),
            Err(refused) => assert!(shifted && refused.message.contains("G52"), "{refused}"),
        }
    }
    let two = "G21 G17 G90 G94\nS500 M3\nG54 G0 X1. Y1. Z1.\nG1 X8. F100.\nG55\nG1 X9. Y1. Z1.\nM30\n";
    let refused = refusal(to((two, "fanuc-30i", ""), "apt", "", &Options::default()));
    assert!(refused.message.contains("work offset"), "{refused}");
    text(to((two, "fanuc-30i", ""), "sinumerik-840d", "", &Options::default()));
}

/// The tool axis of a program that is written in the same words is the same at every moment, and is said to be.
#[test]
fn the_bound_of_the_tool_axis_is_tight() {
    let name = "mikron-ucp710";
    let source = "G710 G90 G94 G54\nT1 M6\nD1\nS500 M3\nTRAORI\nG0 X0 Y0 Z50 A10 C0\nG1 X50 A40 C90 F500\nX0 A-20 C180\nTRAFOOF\nM5\nM30\n";
    for (target, limit) in [("sinumerik-840d", 1e-9), ("haas-ngc", 1e-9)] {
        let made = to((source, "sinumerik-840d", name), target, name, &Options::default()).expect("proved");
        assert!(made.proof.path_deg <= limit, "{target}: {}", made.proof.path_deg);
    }
    // vectors of nine digits on the same great circle
    let circle = "UNITS/MM\nMULTAX/ON\nLOADTL/1\nSPINDL/500,RPM,CLW\nRAPID\nGOTO/0,0,50,0,0.1,0.994987437\nFEDRAT/500,MMPM\n\
        GOTO/50,0,0,0,0.8,0.6\nFINI\n";
    let made = to((circle, "apt", ""), "apt", "", &Options::default()).expect("proved");
    assert!(made.proof.path_deg < 1e-6, "{}", made.proof.path_deg);
}

/// How the tool axis runs between the ends is asked for, and the machine file says that the control does otherwise by itself.
#[test]
fn the_way_of_the_tool_axis_is_not_lost() {
    let name = "mikron-ucp710";
    let at = |code: &str| {
        let source = format!(
            "G710 G90 G94 G54\nT1 M6\nD1\nS500 M3\nTRAORI\n{code}\nG0 X0 Y0 Z50 A20 C-15\nG1 X5 C15 F500\nTRAFOOF\nM5\nM30\n"
        );
        to(
            (&source, "sinumerik-840d", name),
            "sinumerik-840d",
            name,
            &Options::default(),
        )
    };
    let (one, other) = (at("ORIVECT"), at("ORIAXES"));
    let by_itself = trunnion_machine::builtin(name)
        .expect("built in")
        .control
        .tcp_great_circle;
    let (kept, lost, why) = if by_itself {
        (one, other, "ORIAXES")
    } else {
        (other, one, "ORIVECT")
    };
    text(kept);
    let refused = refusal(lost);
    assert!(refused.message.contains(why), "{refused}");
}
