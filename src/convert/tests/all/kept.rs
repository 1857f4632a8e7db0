//! Nothing that a block asks for vanishes without a word: it is written, listed as left out, or the conversion is refused by name.
use crate::support::{refusal, text, to};
use trunnion_convert::{Options, Units};

/// A few blocks before and after those that are tried, in the words of a dialect.
pub(crate) fn around(dialect: &str, blocks: &str) -> String {
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

/// Each is refused on line 6, by name.
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

/// F per revolution is small: it has six digits, and what they cannot hold is refused.
#[test]
fn feeds_per_revolution_keep_their_digits() {
    let program = |feed: &str| {
        format!(
            "%\nO1\nG21 G17 G90 G94 G54 G40 G80\nT1 M6\nS1000 M3\nG0 X0. Y0. Z2.\nG95 G1 Z-5. F{feed}\nX100.\nG94\nG0 Z50.\nM5\nM30\n%\n"
        )
    };
    let inch = Options {
        units: Units::Inch,
        ..Options::default()
    };
    let to_inch = |feed: &str| {
        let text = program(feed);
        to((&text, "fanuc-30i", "mill-3axis"), "fanuc-30i", "mill-3axis", &inch)
    };
    let made = text(to_inch("0.1"));
    assert!(made.contains("F0.003937"), "{made}");
    let refused = refusal(to_inch("0.001"));
    assert!(refused.message.contains("mm/rev"), "{refused}");
}

/// Inverse time becomes the feed per minute that takes as long, where the target has no inverse time.
#[test]
fn inverse_time_becomes_a_feed_per_minute() {
    let program = "%\nO1\nG21 G17 G90 G94 G54 G40 G80\n(trunnion: tool 1 length 80)\nT1 M6\nS1000 M3\nG0 G43 H1 X0. Y0. Z50.\nG93 G1 X40. F10.\nG94\nM5\nM30\n%\n";
    let made = text(to(
        (program, "fanuc-30i", "mill-3axis"),
        "heidenhain-klartext",
        "mill-3axis",
        &Options::default(),
    ));
    assert!(made.contains("F400"), "{made}");
}
