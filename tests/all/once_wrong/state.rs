//! Programs that rest on a state that the program did not set: the spindle, a length, a plane; and words that were misread.
use super::items::{HEAD, Item, KLARTEXT, SINUMERIK};

pub(super) const STATE: &[Item] = &[
    (
        "M6 of a Fanuc may stop the spindle",
        ["fanuc-30i", ""],
        [HEAD, "T2 M6\nG43 H2 Z5.\nG1 Z-1. F100.\nM30\n"],
        &["8 unknown spindle-off-cut"],
        [1, 4],
    ),
    (
        "M0 of a Haas stops the spindle",
        ["haas-ngc", ""],
        [HEAD, "G1 Z-1. F100.\nM0\nX10.\nM30\n"],
        &["8 error spindle-off-cut"],
        [3, 4],
    ),
    (
        "a tap may leave the spindle off",
        ["fanuc-30i", ""],
        [HEAD, "G84 X10. Y10. Z-10. R2. F100.\nG80\nG1 X20.\nM30\n"],
        &["8 unknown spindle-off-cut"],
        [7, 8],
    ),
    (
        "tip control on a machine without rotary axes",
        ["fanuc-30i", "mill-3axis"],
        [HEAD, "G49\nG43.4 H1\nG0 X0. Y0. Z50.\nG1 X10. F100.\nM30\n"],
        &["8 error tcp-state"],
        [4, 4],
    ),
    (
        "a hole with a tilted tool under tip control",
        ["fanuc-30i", ""],
        [
            HEAD,
            "G49\nG43.4 H1\nG0 X0. Y0. Z50. A30. C0.\nG81 X5. Z-5. R5. F100.\nG80\nM30\n",
        ],
        &["9 unknown not-modelled"],
        [2, 4],
    ),
    (
        "the letter O in a word of a Fanuc",
        ["fanuc-30i", ""],
        [HEAD, "G0X9O.593Y25.\nG1 Z-1. F100.\nM30\n"],
        &["6 error unknown-word"],
        [1, 4],
    ),
    (
        "the letter O in a word of a Sinumerik",
        ["sinumerik-840d", ""],
        [SINUMERIK, "G1 X2O.969\nX5\nM30\n"],
        &["5 error not-modelled"],
        [1, 3],
    ),
    (
        "a name that no DEF defines",
        ["sinumerik-840d", ""],
        [SINUMERIK, "FOO=3\nG1 X5\nM30\n"],
        &["5 unknown not-modelled"],
        [2, 2],
    ),
    (
        "a length in G18",
        ["sinumerik-840d", ""],
        [
            "; trunnion: tool 1 length 80\n",
            "G17 G90 G94 G54 G71\nT1 D1 M6\nS1000 M3 F100\nG0 X0 Y0 Z10\nG18 G2 X10 I5 K0\nM30\n",
        ],
        &["6 unknown not-modelled"],
        [2, 2],
    ),
    (
        "a cut before M3",
        ["fanuc-30i", ""],
        [
            "G21 G17 G40 G49 G80 G90 G94 G54\nT1 M6\nG0 X0 Y0\nG43 H1 Z50.\n",
            "G1 X9. F100. S100\nM3\nX5.\nM30\n",
        ],
        &["5 warning spindle-unset"],
        [3, 4],
    ),
    (
        "F of a steep helix",
        ["fanuc-30i", ""],
        [HEAD, "G2 X0. Y0. Z-50. I5. F1000.\nM30\n"],
        &["6 unknown not-modelled"],
        [2, 3],
    ),
    (
        "TOOL DEF and the settings differ",
        ["heidenhain-klartext", ""],
        [
            "BEGIN PGM A MM\n; trunnion: tool 1 length 80\nTOOL DEF 1 L+120 R+3\n",
            "TOOL CALL 1 Z S1000 F300\nL X+0 Y+0 Z+50 R0 FMAX M3\nM30\nEND PGM A MM\n",
        ],
        &["3 warning tool-defined-twice"],
        [1, 1],
    ),
    (
        "P of a dwell with a decimal point",
        ["fanuc-30i", ""],
        [HEAD, "G4 P2.5\nG4 X2.5\nG4 P2500\nM30\n"],
        &["6 error bad-number"],
        [4, 5],
    ),
    (
        "TABLE ROT with a free rotary axis",
        ["heidenhain-klartext", "mikron-ucp710"],
        [
            KLARTEXT,
            "PLANE SPATIAL SPA+0 SPB+0 SPC+30 TURN FMAX TABLE ROT\nM30\nEND PGM A MM\n",
        ],
        &["4 unknown not-modelled"],
        [1, 3],
    ),
    (
        "CYCLE87 stops the spindle",
        ["sinumerik-840d", ""],
        [
            "G17 G90 G94 G54\nT1 D1\nM6\nS1000 M3\nG0 X0 Y0 Z50\nG1 Z5 F100\n",
            "CYCLE87(10,0,2,-5,0,3)\nG1 X5\nM30\n",
        ],
        &["8 unknown spindle-off-cut"],
        [6, 6],
    ),
    (
        "H0 between two cuts",
        ["fanuc-30i", ""],
        [HEAD, "G1 Z0. F100.\nG0 Z50.\nG43 H0\nG0 Z5.\nG1 X5.\nM30\n"],
        &["10 warning missing-tool-length"],
        [5, 6],
    ),
    (
        "a negative time of a dwell in X",
        ["fanuc-30i", ""],
        [HEAD, "G4 X-1.\nM30\n"],
        &["6 error bad-number"],
        [2, 3],
    ),
];
