//! Programs whose words were misread, or passed over in silence.
use super::items::{HEAD, Item, SINUMERIK};

pub(super) const WORDS: &[Item] = &[
    (
        "a centre that no arc reads on a Sinumerik",
        ["sinumerik-840d", ""],
        [SINUMERIK, "G1 X5\nI-15 J0\nM30\n"],
        &["6 warning unused-word", "6 warning unused-word"],
        [2, 2],
    ),
    (
        "M3 without S in Klartext",
        ["heidenhain-klartext", ""],
        [
            "BEGIN PGM A MM\nTOOL CALL 1 Z\nL X+0 Y+0 Z+5 R0 FMAX M3\n",
            "L X+10 F100\nL M30\nEND PGM A MM\n",
        ],
        &["4 warning spindle-unset"],
        [2, 2],
    ),
    (
        "an array whose name is a letter and a number",
        ["sinumerik-840d", ""],
        [
            "DEF REAL H2[3], Q1[3,3]\n",
            "G17 G90 G94 G54 G71\nH2[1]=5\nQ1[2,2]=6\nG0 X=H2[1] Y=Q1[2,2] Z0\nM30\n",
        ],
        &[],
        [1, 1],
    ),
    (
        "#13001 is written, a radius",
        ["fanuc-30i", ""],
        [HEAD, "#13001=5.\nG0 X10.\nG1 Z-1. F100\nM30\n"],
        &[],
        [3, 4],
    ),
];
