//! Programs of lathes are recognised, and those of mills are not taken for them.
use super::detection::content;
use crate::{Foreign, Surroundings, detect, detect_on};

#[test]
fn programs_of_mills_are_none_of_lathes() {
    let mill = "%\nO1\nT1 M6\nG0 X5. Y5.\nG43 H1 Z9.\n";
    for code in ["G92 S2000\n", "G50 S2000\n"] {
        assert_eq!(content(&format!("{mill}{code}M30\n")).0, "fanuc-30i", "{code}");
    }
    let lathe = "%\nO1\nG50 S2000\nT0101\nG96 S200 M3\nG0 X50. Z2.\nG1 Z-9. F.2\nM30\n";
    assert_eq!(content(lathe).0, "fanuc-30i-lathe-a");
    assert_eq!(content(&lathe.replace("G50 S", "G92 S")).0, "fanuc-30i-lathe-b");
    let on_mill = Surroundings {
        turns: Some(false),
        ..Surroundings::default()
    };
    assert_eq!(
        detect_on(None, lathe.as_bytes(), on_mill).dialect.name,
        "fanuc-30i",
        "the machine contradicts"
    );
    let haas = lathe.replace("O1\n", "O12345\n");
    assert_eq!(content(&haas).0, "haas-lathe");
}

/// A turret's T0101 with G97 or G18 and motions in X and Z alone is a lathe program, and so is one in X and Z alone on a machine without Y.
#[test]
fn programs_of_lathes_without_their_own_codes() {
    let lathe = "%\nO0001\nT0101\nG97 S1000 M3\nG0 X80. Z5.\nG1 Z-20. C1. F0.2\nX100.\nM30\n";
    assert_eq!(content(lathe).1, "content: T with an offset, G97, X and Z alone");
    assert_eq!(content(lathe).0, "fanuc-30i-lathe-a");
    assert_eq!(
        content(&lathe.replace("G97 S1000", "G18 G99 S1000")).0,
        "fanuc-30i-lathe-a"
    );
    assert_eq!(content(&lathe.replace("O0001", "O00001")).0, "haas-lathe");
    // a second word of a mill, or no second sign of a lathe
    assert_eq!(content(&lathe.replace("X100.", "X100. Y5.")).0, "fanuc-30i");
    assert_eq!(content(&lathe.replace("X100.", "G43 H1 X100.")).0, "fanuc-30i");
    let plain = lathe.replace("T0101", "T1").replace("G97 ", "");
    assert_eq!(content(&plain).0, "fanuc-30i");
    let on_lathe = Surroundings {
        turns: Some(true),
        no_y: true,
        ..Surroundings::default()
    };
    assert_eq!(
        detect_on(None, plain.as_bytes(), on_lathe).dialect.name,
        "fanuc-30i-lathe-a"
    );
}

/// With motions in X and Z alone, surface speed or a turret's T0101 is enough; where they show no control, the text only may be one of a lathe.
#[test]
fn one_sign_and_the_motions() {
    let lathe = "G96 S150 M3\nG0 X50. Z2.\nG1 Z-5. F.1\nX52.\nM30\n";
    for (text, wanted) in [
        (format!("%\nO0007\n{lathe}"), "fanuc-30i-lathe-a"),
        (format!("%\nO00007\n{lathe}"), "haas-lathe"),
        (format!("G21 G99\n{lathe}"), "fanuc-30i-lathe-a"),
        (
            "G99\nT0101\nM3 S500\nG0 X50. Z2.\nG1 Z-5. F.1\nM30\n".to_owned(),
            "fanuc-30i-lathe-a",
        ),
        (
            "%\nO7\nT0101\nM3 S500\nG0 X50. Z2.\nG1 Z-5. F.1\nM30\n".to_owned(),
            "fanuc-30i-lathe-a",
        ),
        // no control is shown
        (lathe.to_owned(), "iso-6983"),
        (format!("G17 G80 G99\n{lathe}"), "iso-6983"),
        // Y, or a tool that M6 changes
        (format!("%\nO0007\n{}", lathe.replace("X52.", "X52. Y1.")), "fanuc-30i"),
        (
            "%\nO7\nT1201\nM6\nG0 X50. Z2.\nG1 Z-5. F.1\nM30\n".to_owned(),
            "fanuc-30i",
        ),
    ] {
        assert_eq!(content(&text).0, wanted, "{text}");
    }
    let reason = crate::possible_lathe(lathe.as_bytes());
    assert_eq!(reason.as_deref(), Some("G96 on line 1, X and Z alone"));
    assert_eq!(crate::possible_lathe(b"G0 X1 Z2\nG1 X5\nM30\n"), None);
}

/// `M6 T0707` names a tool and its own offset: small lathes change tools so. A sign of a lathe beside it decides.
#[test]
fn a_turret_that_m6_turns() {
    let lathe = "%\nO0012\nG28\nM06 T0707\nG97 S1000 M3\nG0 X50. Z2.\nG1 Z-5. F.1\nX52.\nM30\n";
    assert_eq!(content(lathe).0, "haas-lathe");
    let fanuc = lathe.replace("G28\n", "");
    assert_eq!(content(&fanuc).0, "fanuc-30i-lathe-a");
    let cycle = fanuc.replace("G97 S1000", "G71 U1. R1.\nG71 P10 Q20 U.1 W.1 F.2\nS1000");
    assert_eq!(content(&cycle).0, "fanuc-30i-lathe-a");
    for mill in [
        fanuc.replace("X52.", "X52. Y1."),
        fanuc.replace("T0707", "T1207"),
        fanuc.replace("T0707", "T7"),
        fanuc.replace("G97 ", ""),
    ] {
        assert_eq!(content(&mill).0, "fanuc-30i", "{mill}");
    }
}

#[test]
fn okuma_mills_and_lathes() {
    for (name, text, wanted) in [
        ("a.min", "G15 H1\nT1 M6\nG56 H1\nG0 X1 Y2 Z3\nM2\n", "okuma-osp"),
        ("a.nc", "$PART.MIN%\nG15 H1\nG0 X1 Y2\nM2\n", "okuma-osp"),
        (
            "a.nc",
            "N1 V1=2\nCALL OSUB AB=V1\nIF [V1 EQ 2] NEND\nNEND M2\n",
            "okuma-osp",
        ),
        // names of sections for tools: lathes have them, and machining centres too
        (
            "a.min",
            "O100\nG15 H2\nNAT01 T5 M6\nG56 H5\nG0 X1 Y2 Z3\nM2\n",
            "okuma-osp",
        ),
        (
            "a.min",
            "G15 H2\nNAT1 G0 X1 Y2\nG81 X1 Y2 Z-3 R2 F50\nG80\nM2\n",
            "okuma-osp",
        ),
        ("a.min", "NAT1 G0 X50 Z2\nG1 Z-10 F0.2\nM2\n", "okuma-osp-lathe"),
        (
            "a.min",
            "NAT1 G50 S2000\nT010101\nG0 X50 Y0 Z2\nG81 X1 Z-3 R2\nM2\n",
            "okuma-osp-lathe",
        ),
        ("a.min", "G0 X50 Z2\nG1 Z-10 F0.2\nM2\n", "okuma-osp-lathe"),
        ("a.min", "G50 S2000\nT010101\nG0 X50 Y0 Z2\nM2\n", "okuma-osp-lathe"),
    ] {
        let found = detect(Some(name), text.as_bytes(), None);
        let lathe = matches!(found.foreign, Some(Foreign::Control(control)) if control.name == "okuma-osp-lathe");
        assert_eq!(
            if lathe { "okuma-osp-lathe" } else { &found.dialect.name },
            wanted,
            "{text}"
        );
    }
    let found = detect(
        Some("a.nc"),
        b"G0 X50 Z2\nG96 S200 M3\nG1 Z-10 F0.2\nM2\n",
        Some("okuma-osp"),
    );
    assert!(found.foreign.is_some(), "{}", found.reason);
}
