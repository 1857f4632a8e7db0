//! The programs.

/// The head of a program for a mill with a macro B control.
pub(super) const HEAD: &str = "G21 G17 G40 G49 G80 G90 G94 G54\nT1 M6\nM3 S1000\nG0 X0 Y0\nG43 H1 Z50.\n";

/// The head of a Sinumerik program.
pub(super) const SINUMERIK: &str = "G17 G90 G94 G54 G71\nT1 D1 M6\nS1000 M3 F100\nG0 X0 Y0 Z10\n";

/// The head of a Klartext program, whose TOOL CALL has no feed.
pub(super) const KLARTEXT: &str = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+50 R0 FMAX M3\n";

/// The head of a program for a Haas lathe.
const LATHE: &str = "G21 G18 G99 G40\nT0101\nG97 S1000 M3\nG0 X40. Z2.\n";

/// What it was about; dialect and machine; the head and the rest; the findings as `line level rule` without those of every program; motions
/// with a known end of all motions.
pub(super) type Item = (
    &'static str,
    [&'static str; 2],
    [&'static str; 2],
    &'static [&'static str],
    [u64; 2],
);

pub(super) const ITEMS: &[Item] = &[
    (
        "a full circle without its code",
        ["fanuc-30i", ""],
        [HEAD, "G2 I-10. J0 F100\nI-15. J0\nM30\n"],
        &[],
        [3, 4],
    ),
    (
        "a full circle without its code on a Sinumerik",
        ["sinumerik-840d", ""],
        [SINUMERIK, "G2 I-10 J0\nI-15 J0\nM30\n"],
        &[],
        [3, 3],
    ),
    (
        "C is a chamfer on a lathe with two axes",
        ["fanuc-30i-lathe-a", ""],
        [
            "",
            "G21 G18 G99\nT0101\nG97 S1000 M3\nG0 X-80. Z-5.\nG1 Z-20. C1. F0.2\nX-40.\nM30\n",
        ],
        &[],
        [4, 4],
    ),
    (
        "the spindle number of M3",
        ["linuxcnc", ""],
        ["", "G21 G17 G90 G94\nM3 S100 $0\nG0 X0 Y0 Z0\nG1 X1 F100\nM2\n"],
        &[],
        [2, 2],
    ),
    (
        "a further spindle, without an INI file",
        ["linuxcnc", ""],
        ["", "G21 G17 G90 G94\nM3 $1 S100\nG0 X0 Y0 Z0\nG1 X1 F100\nM5 $1\nM2\n"],
        &["2 unknown not-modelled"],
        [2, 2],
    ),
    (
        "axes U and W, without a machine",
        ["linuxcnc", ""],
        ["", "G21 G17 G90 G94\nM3 S100\nG0 X0 Y0 Z0\nG1 X1 W2 F100\nX2 U3\nM2\n"],
        &["4 unknown not-modelled"],
        [3, 3],
    ),
    (
        "axis W on a machine without it",
        ["linuxcnc", "mill-3axis"],
        ["", "G21 G17 G90 G94\nM3 S100\nG0 X0 Y0 Z0\nG1 X1 W2 F100\nM2\n"],
        &["4 error unknown-word"],
        [1, 1],
    ),
    (
        "an M code above 199 is a remap",
        ["linuxcnc", ""],
        ["", "G21 G17 G90 G94\nM400\nG0 X0 Y0 Z0\nM2\n"],
        &["2 unknown unknown-code"],
        [1, 1],
    ),
    (
        "notes after the end",
        ["linuxcnc", ""],
        ["", "G21 G17 G90 G94\nG0 X0 Y0 Z0\nM2\n\nThese are: notes, others\n"],
        &["5 unknown syntax-error"],
        [1, 1],
    ),
    (
        "#5070 after a probe",
        ["linuxcnc", ""],
        [
            "",
            "G21 G17 G90 G94\nG0 X0 Y0 Z0\nG38.2 Z-10 F50\no1 if [#5070 EQ 1]\nG0 Z5\no1 endif\nM2\n",
        ],
        &["3 unknown not-modelled"],
        [2, 3],
    ),
    (
        "the point where a probe touched",
        ["linuxcnc", ""],
        [
            "",
            "G21 G17 G90 G94\nG0 X0 Y0 Z0\nG38.2 Z-10 F50\n#1=#5063\nG0 Z[#1+5]\nM2\n",
        ],
        &["3 unknown not-modelled", "5 unknown not-modelled"],
        [1, 3],
    ),
    (
        "no NaN in what is said after a probe",
        ["linuxcnc", "mill-4axis-a"],
        [
            "",
            "G21 G17 G90 G94\nM3 S100\nG0 X0 Y0 Z0 A0\nG38.2 Z-10 F50\nG1 A10 F100\nM2\n",
        ],
        &["4 unknown not-modelled", "5 unknown position-unknown"],
        [1, 3],
    ),
    (
        "DIAMON on a machine whose X words are no diameters",
        ["sinumerik-840d", "mill-4axis-a"],
        [
            "",
            "G18 G90 G95 G71 G54\nDIAMON\nS1000 M3\nG0 X40 Z2\nG1 Z-10 F0.2\nM30\n",
        ],
        &[
            "2 unknown not-modelled",
            "4 unknown position-unknown",
            "5 unknown position-unknown",
        ],
        [0, 2],
    ),
    (
        "G291 and G290",
        ["sinumerik-840d", ""],
        [SINUMERIK, "G291\nG0 X1\nG290\nG0 X2\nM30\n"],
        &["5 unknown not-modelled"],
        [1, 3],
    ),
    (
        "S2= and M2=3",
        ["sinumerik-840d", ""],
        [SINUMERIK, "S2=1000 M2=3\nG0 X1\nM30\n"],
        &["5 unknown not-modelled", "5 unknown not-modelled"],
        [2, 2],
    ),
    (
        "RET at the end of a subprogram",
        ["sinumerik-840d", ""],
        ["", "PROC EDGE\nG17 G90 G71 G94\nG1 X10 F100\nRET\n"],
        &[],
        [1, 1],
    ),
    (
        "F is given by the caller",
        ["sinumerik-840d", ""],
        ["", "PROC EDGE\nG17 G90 G71\nG1 X10\nM17\n"],
        &["3 unknown missing-feed"],
        [1, 1],
    ),
    (
        "CYCLE81 with its modes",
        ["sinumerik-840d", ""],
        [SINUMERIK, "MCALL CYCLE81(10,0,2,-10,0,0,0,1,12)\nX10 Y10\nMCALL\nM30\n"],
        &[],
        [5, 5],
    ),
    (
        "CYCLE82 with its modes",
        ["sinumerik-840d", ""],
        [SINUMERIK, "CYCLE82(10,0,2,-10,0,1,0,1,12)\nM30\n"],
        &[],
        [5, 5],
    ),
    (
        "CYCLE83 with its modes",
        ["sinumerik-840d", ""],
        [
            SINUMERIK,
            "CYCLE83(10,0,3,,20,,5,100,0,0.5,100,1,0,1.2,1.4,0,1.6,0,1,11211111)\nM30\n",
        ],
        &["5 unknown not-modelled"],
        [3, 4],
    ),
    (
        "G82 of a Haas without R",
        ["haas-ngc", ""],
        [HEAD, "G91 G82 Z-10. P0.5 L3 X10. F100.\nG80\nG90\nM30\n"],
        &["6 unknown not-modelled"],
        [1, 3],
    ),
    (
        "G82 of a Haas with L",
        ["haas-ngc", ""],
        [HEAD, "G91 G82 R-48. Z-10. P0.5 L3 X10. F100.\nG80\nG90\nM30\n"],
        &[],
        [16, 17],
    ),
    (
        "G15, G112, G113 and G195 of a Haas lathe",
        ["haas-lathe", ""],
        [LATHE, "G15\nG112\nG113\nG195 S100 R5. F1.\nG80\nM30\n"],
        &["6 unknown not-modelled", "8 unknown not-modelled"],
        [1, 1],
    ),
    (
        "G241 of a Haas lathe",
        ["haas-lathe", ""],
        [LATHE, "G241 X10. Z-5. R1. F0.1\nG80\nM30\n"],
        &["5 unknown not-modelled"],
        [1, 2],
    ),
    (
        "the rapid back into the hole of G83",
        ["fanuc-30i", "fork-head-ca"],
        [
            "G21 G17 G90 G94 G54\nT1 M6\nM3 S1000\nG43 H1\nG0 X0 Y0 Z50. A0 C0\n",
            "G83 X0 Y0 Z-10. R2. Q5. F100\nG80\nM30\n",
        ],
        &["6 unknown position-unknown"],
        [8, 10],
    ),
    (
        "a great circle that leaves the reach, in rapid",
        ["sinumerik-840d", "mikron-ucp710"],
        [
            "G17 G90 G94 G54 G71\nT1 D1 M6\nS1000 M3\nTRAORI\nORIVECT\n",
            "G0 X100 Y0 Z150 A3=0.87 B3=0 C3=-0.1\nG0 X100 Y0 Z150 A3=-0.87 B3=0 C3=-0.1\nTRAFOOF\nM30\n",
        ],
        &["7 error axis-limit"],
        [2, 2],
    ),
    (
        "L140(1)",
        ["sinumerik-840d", ""],
        [SINUMERIK, "L140(1)\nM30\n"],
        &["5 unknown not-modelled"],
        [1, 1],
    ),
    (
        ",R and ,C on a mill",
        ["fanuc-30i", ""],
        [HEAD, "G1 X20. ,R3. F100\nG1 Y20. ,C2.\nG1 X0\nM30\n"],
        &[],
        [6, 7],
    ),
    (
        "#13001, a tool offset",
        ["fanuc-30i", ""],
        [HEAD, "#1=#13001\nG0 X#1\nM30\n"],
        &["7 unknown not-modelled"],
        [1, 3],
    ),
    (
        "SUPA under tool centre point control",
        ["sinumerik-840d", ""],
        [SINUMERIK, "TRAORI\nG0 X0 Y0 Z100 A0 C0\nG0 SUPA Z0 D0\nTRAFOOF\nM30\n"],
        &["7 unknown not-modelled", "7 warning tcp-state"],
        [2, 3],
    ),
    (
        "G53 under tool centre point control",
        ["fanuc-30i", ""],
        [
            "",
            "G21 G17 G90 G94 G54\nT1 M6\nG43.4 H1\nG0 X0 Y0 Z50. A0 C0\nG53 Z0\nG49\nM30\n",
        ],
        &["5 unknown not-modelled", "5 warning tcp-state"],
        [1, 2],
    ),
    (
        "S0 M3",
        ["fanuc-30i", ""],
        ["", "G21 G17 G90 G94\nS0 M3\nG0 X0 Y0 Z5.\nG1 Z-1. F100\nM30\n"],
        &["4 error spindle-off-cut"],
        [2, 2],
    ),
    (
        "M3 without S",
        ["fanuc-30i", ""],
        ["", "G21 G17 G90 G94\nM3\nG0 X0 Y0 Z5.\nG1 Z-1. F100\nM30\n"],
        &["4 warning spindle-unset"],
        [2, 2],
    ),
    (
        "a program that starts no spindle",
        ["fanuc-30i", ""],
        ["", "G21 G17 G90 G94\nG0 X0 Y0 Z5.\nG1 Z-1. F100\nM30\n"],
        &["3 warning spindle-unset"],
        [2, 2],
    ),
    (
        "G43.4 without H",
        ["fanuc-30i", ""],
        [
            "",
            "G21 G17 G90 G94 G54\nT1 M6\nM3 S1000\nG43.4\nG0 X0 Y0 Z50. A0 C0\nG1 Z1. F100\nG49\nM30\n",
        ],
        &["4 warning tcp-state"],
        [2, 2],
    ),
    (
        "M13 of a builder",
        ["fanuc-30i", ""],
        ["", "G21 G17 G90 G94\nM13 S1000\nG0 X0 Y0 Z5.\nG1 Z-1. F100\nM30\n"],
        &["2 unknown unknown-code"],
        [2, 2],
    ),
    (
        "M133 of a builder",
        ["fanuc-30i", ""],
        ["", "G21 G17 G90 G94\nM133 S1000\nG0 X0 Y0 Z5.\nG1 Z-1. F100\nM30\n"],
        &["2 unknown unknown-code"],
        [2, 2],
    ),
    (
        "text before the first percent sign",
        ["fanuc-30i", ""],
        [
            "From: shop, 2020-01-01\nBracket (rev. 3): X5,5\n%\n",
            "O1\nG21 G17 G90 G94 G54\nG0 X0. Y0. Z5.\nM30\n%\n",
        ],
        &[],
        [1, 1],
    ),
    (
        "DEF REAL H2 and a shorter assignment",
        ["sinumerik-840d", ""],
        ["DEF REAL H2\n", "G17 G90 G94 G54 G71\nH2=5\nG0 X=H2 Y0 Z0\nM30\n"],
        &[],
        [1, 1],
    ),
    (
        "M6 of a Haas stops the spindle",
        ["haas-ngc", ""],
        [HEAD, "T2 M6\nG43 H2 Z5.\nG1 Z-1. F100.\nM30\n"],
        &["8 error spindle-off-cut"],
        [1, 4],
    ),
    (
        "M5 acts after the motion of its block",
        ["fanuc-30i", ""],
        [HEAD, "G1 X10. F100. M5\nX20.\nM30\n"],
        &["7 error spindle-off-cut"],
        [3, 4],
    ),
    (
        "R below the bottom of the hole",
        ["fanuc-30i", ""],
        [HEAD, "G81 X10. Y10. Z-10. R-20. F100.\nG80\nM30\n"],
        &["6 error canned-cycle"],
        [1, 3],
    ),
    (
        "SPOS stops the spindle",
        ["sinumerik-840d", ""],
        [SINUMERIK, "SPOS=0\nG1 X10\nM30\n"],
        &["6 error spindle-off-cut"],
        [2, 2],
    ),
    (
        "a program that ends in an alarm",
        ["fanuc-30i", ""],
        [HEAD, "#3000=1(NO PROBE)\nG1 Z-5. F100.\nM30\n"],
        &["6 warning program-alarm"],
        [1, 2],
    ),
    (
        "IF without GOTO or THEN",
        ["fanuc-30i", ""],
        [HEAD, "#1=1\nIF[#1EQ2]\nG0 X3.\nM30\n"],
        &["7 error bad-expression"],
        [2, 3],
    ),
    (
        "a tap turns a spindle that stands",
        ["haas-ngc", ""],
        [HEAD, "G1 Z49. F100.\nM5\nG84 X10. Z-15. R5. F100.\nG80\nM30\n"],
        &[],
        [7, 8],
    ),
    (
        "F AUTO where TOOL CALL has no F",
        ["heidenhain-klartext", ""],
        [KLARTEXT, "L X+10 F AUTO\nM30\nEND PGM A MM\n"],
        &["4 error missing-feed"],
        [2, 2],
    ),
];
