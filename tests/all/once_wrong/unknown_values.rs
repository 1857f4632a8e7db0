//! Programs whose offsets, lengths or words come from values that are not known: none of them may pass in silence.
use super::items::{HEAD, Item, KLARTEXT};

pub(super) const UNKNOWN_VALUES: &[Item] = &[
    (
        "a zero point set where the machine stands",
        ["linuxcnc", "mill-3axis"],
        [
            "",
            "G21 G90 G54 G17 G94\nG10 L20 P1 X0 Y0 Z0\nG0 X5000 Y5 Z5\nS100 M3\nG1 X-5000 F100\nM2\n",
        ],
        &["2 unknown not-modelled", "5 unknown position-unknown"],
        [2, 2],
    ),
    (
        "G92 where the machine stands",
        ["linuxcnc", "mill-3axis"],
        ["", "G21 G90 G54 G17 G94\nG92 Z0\nG0 X0 Y0 Z500\nM2\n"],
        &["2 unknown not-modelled"],
        [1, 1],
    ),
    (
        "a zero point from the length of the tool",
        ["linuxcnc", "mill-3axis"],
        ["", "G21 G90 G54 G17 G94\nG10 L2 P1 Z#5422\nG0 X5 Y5 Z500\nM2\n"],
        &["2 unknown not-modelled", "2 unknown not-modelled"],
        [1, 1],
    ),
    (
        "a word from a value of the machine",
        ["linuxcnc", ""],
        ["", "G21 G90 G54 G17 G94\n#1=#5420\nG0 X[#1+5] Y5 Z5\nM2\n"],
        &["3 unknown not-modelled"],
        [0, 1],
    ),
    (
        "the tool that is in the spindle",
        ["linuxcnc", ""],
        [
            "",
            "G21 G90 G54 G17 G94\no1 if [#<_current_tool> ne 5]\nM3 S1000\no1 endif\nG0 X0 Y0 Z5\nG1 Z-1 F100\nM2\n",
        ],
        &["2 unknown not-decided"],
        [0, 0],
    ),
    (
        "DL comes on top of a length that is assumed",
        ["heidenhain-klartext", "mill-3axis"],
        [
            "",
            "BEGIN PGM A MM\nTOOL CALL 1 Z S1000 DL+600\nL X+0 Y+0 Z+5 R0 FMAX M3\nM30\nEND PGM A MM\n",
        ],
        &["3 error axis-limit"],
        [1, 1],
    ),
    (
        "wear comes on top of a length that is assumed",
        ["fanuc-30i", "mill-3axis"],
        [
            "",
            "G21 G17 G40 G49 G80 G90 G94\nG10 L11 P1 R600.\nG54 G0 X0 Y0\nG43 H1 Z0\nM30\n",
        ],
        &["4 error axis-limit"],
        [1, 2],
    ),
    (
        "G43.2 adds a length that nothing declares",
        ["linuxcnc", ""],
        ["", "G21 G90 G54 G17 G94\nT1 M6\nG43.2 H2\nG0 X0 Y0 Z5\nM2\n"],
        &[],
        [1, 1],
    ),
    (
        "STOP interrupts the run, and nothing says that the spindle stops",
        ["heidenhain-klartext", ""],
        [KLARTEXT, "STOP\nL X+10 F100\nM30\nEND PGM A MM\n"],
        &["5 unknown spindle-off-cut"],
        [2, 2],
    ),
    (
        "a loop around a program that is missing",
        ["fanuc-30i", ""],
        [HEAD, "N10 G0 X10.\nM98 P9000\nGOTO 10\nM30\n"],
        &["6 unknown not-decided", "7 error missing-subprogram"],
        [2, 500_006],
    ),
    (
        "an alarm of the program ends it",
        ["linuxcnc", ""],
        [
            "",
            "G21 G90 G54 G17 G94\nG0 X1 Y1 Z1\n(ABORT, no tool)\nG2 X5 Y5 R0\nM2\n",
        ],
        &["3 warning program-alarm"],
        [1, 1],
    ),
    (
        "two axes are a whole end where the third is never named",
        ["linuxcnc", ""],
        ["", "G21 G90 G18 G94\nM3 S100\nG0 X5 Z5\nG1 Z-5 F100\nX6 Z#100\nM2\n"],
        &["5 unknown not-modelled"],
        [2, 3],
    ),
    (
        "cycle 208 has no Q202",
        ["heidenhain-klartext", ""],
        [
            KLARTEXT,
            "CYCL DEF 208 A ~\nQ200=2 ~\nQ201=-5 ~\nQ206=100 ~\nQ334=1 ~\nQ203=+0 ~\nQ204=20 ~\nQ335=20 ~\nQ342=0\nL X+5 FMAX M99\nL Z+100 FMAX\nM30\nEND PGM A MM\n",
        ],
        &["13 unknown not-modelled"],
        [6, 7],
    ),
    (
        "two codes of one group where the last one wins",
        ["fanuc-30i", ""],
        [HEAD, "G90 G91 G28 Z0\nM30\n"],
        &["6 warning modal-group-conflict", "6 info not-modelled"],
        [1, 3],
    ),
];
