//! Small programs in the style of many controls: which control each is taken for. Most of these controls are not supported.
use super::detection::{content, named};
use crate::{Foreign, detect};

#[test]
fn controls_that_are_not_read() {
    for (text, name) in [
        ("%A G71 *\nN10 G30 G17 X+0 Y+0 Z-20*\nN20 G00 X+5*\n", "heidenhain-iso"),
        ("OHOME\nG0 X60.\nG20 HP=4\nRTS\n", "okuma-osp-lathe"),
        ("$PART.MIN%\nG50 S2000\nT010101\nG0 X50 Z2\nM2\n", "okuma-osp-lathe"),
        ("IF #4201 || #4202 THEN GOTO 1000\n#29952 = #25012\nN1000\n", "centroid"),
        ("Sub user_1\n    DlgMsg \"a\" \"b\" 1\nEndSub\n", "eding"),
        ("E001=10 16 15 09 08\nH1=0.1670\nG92 X0 Y0\nE1\nG1 X3.\n", "wire-edm"),
        ("G92 X0 Y0\nG60\nG38\nG39\nG41 D0\nG1 X5\n", "wire-edm"),
        (
            "PARTNO TEST\nCUTTER/10\nP1=POINT/1,2,3\nL1 = LINE/P1,P2\nFROM/P1\nGO/TO,L1\nTLLFT,GOLFT/L1,PAST,L2\nFINI\n",
            "apt-source",
        ),
        (
            "PARTNO A\nMAC1=MACRO/X=5\nGOTO/X,0,0\nTERMAC\nCALL/MAC1,X=3\nFINI\n",
            "apt-source",
        ),
        (
            "PARTNO A\nC1=CIRCLE/0,0,5\nID1)GOTO/P5\nJUMPTO/ID1\nFINI\n",
            "apt-source",
        ),
        (
            "$;\nG13\nG140\nT0101\nG50 S3000\nG96 S200 M3\nG0 X100 Z100\nG1 X90 F0.2\nM2\n",
            "okuma-osp-lathe",
        ),
        (
            "%BRACKET,MX--,\n;FAGOR 8055\nN10 G90 G71\nN30 M6\nN60 G0 X0 Y0\nN110 M30\n",
            "fagor",
        ),
        (
            "N10 G0 G90 X0\nN20 (P100=10)\nN40 (IF P100 GT 0 GOTO N60)\nN60 (RPT N10,N40) N3\nM30\n",
            "fagor",
        ),
        (
            "#CS DEF [1] [MODE 1,0,0,0,0,30,0]\nG90 G0 X0\n$FOR P1=1,5,1\nG1 X[P1]\n$ENDFOR\nM30\n",
            "fagor",
        ),
        (
            "%101\nN10 G0 G52 Z0\nN20 G16 R+\nN50 L1=10 L2=L1*2\nN60 G0 X-50 Y0\nN80 G77 N200 N240 S3\nN90 G79 L1>0 N60\nN110 M2\nN200 G91 Z-2\n",
            "num",
        ),
        (
            "%1234\nN10 E80000=5\nN20 $0 OUTIL SUIVANT\nN30 G0 X10 Y10\nN40 G77 H567\nN50 G81 X0 Y0 Z-10 ER2 F100\nN60 M02\n",
            "num",
        ),
        (
            "%\nO1000(PART)\nG0G90G54G17G40G49G80\nG100T1X0.Y0.Z50.G43H1S8000M3L2\nG81X0.Y0.Z-5.R2.F500.\nM30\n%\n",
            "brother",
        ),
        (
            "O1\nG91 G28 Z0\nG54 G90 G43 H2 Z50.\nG77 Z-10. R3. I1. S1000\nM30\n",
            "brother",
        ),
        ("G291\nO0010\nG90 G21 G54\nG43 H1 Z100.\nM30\n", "sinumerik-iso"),
        (";FLAVOR:Marlin\nM104 S200\nG28\nG92 E0\nG1 X5 E0.2 F1200\n", "marlin"),
    ] {
        let found = detect(Some("a.nc"), text.as_bytes(), None);
        let control = match found.foreign {
            Some(Foreign::Control(control)) => control.name,
            other => panic!("{text}: {} {other:?} {}", found.dialect.name, found.reason),
        };
        assert_eq!(control, name, "{text}: {}", found.reason);
    }
}

/// Posts for Mach3 and LinuxCNC write G28 G91 and G43 H as posts for a Fanuc do, and G91.1, which those have not.
#[test]
fn centres_by_g91_1_are_no_fanuc() {
    let text =
        "(T1 D=6.)\nG90 G94 G91.1 G17\nG21\nG28 G91 Z0.\nG90\nT1 M6\nS18000 M3\nG54\nG43 Z15. H1\nG1 X60. F500.\nM30\n";
    assert_eq!(content(text).0, "iso-6983");
    assert_eq!(named(Some("a.ngc"), text, None).0, "linuxcnc");
    assert_eq!(content(&text.replace("G91.1 ", "")).0, "fanuc-30i");
    assert_eq!(content(&format!("%\nO1001\n{text}")).0, "fanuc-30i");
    assert_eq!(content("%\n<BRACKET>\nG90 G54\nM30\n%\n").0, "fanuc-30i");
}

/// What an APT processor writes is read, also arcs as CATIA writes them.
#[test]
fn cl_data_are_no_apt_source() {
    for text in [
        "PARTNO A\nINDIRV/0,1,0\nTLON,GOFWD/(CIRCLE/0,0,0,5),ON,(LINE/0,0,0,0,5,0)\nFINI\n",
        "PARTNO/A\nCIRCLE/0,0,0,0,0,1,5\nGOTO/0,5,0\nFINI\n",
        "TOOL PATH/A,TOOL,B\nGOTO/8.,0,0\nEND-OF-PATH\n",
    ] {
        let found = detect(Some("a.apt"), text.as_bytes(), None);
        assert!(
            found.foreign.is_none() && found.dialect.name == "apt",
            "{text}: {}",
            found.reason
        );
    }
}
