//! Programs for machines with two rotary axes: the tool axis, turns of rotary axes, positions that the linear axes cannot reach.
use super::items::Item;
use trunnion::machine::{Machine, builtin_source, load};

/// X and C carry the part, and Y and Z the head with A: at C90 X and Y are parallel.
const SLIDE: &str = "schema = \"ncmachine/1\"\nname = \"slide on a rotary table\"\n[control]\nunits = \"mm\"\nrapid = \"synchronous\"\n\
    tcp = { path = \"tip-linear\", orientation = \"joint\", feed = \"tip\" }\n";

/// The axes of [`SLIDE`]: letter, side, travel, speed.
const SLIDE_AXES: [(&str, &str, u32, u32); 5] = [
    ("X", "table", 300, 200),
    ("C", "table", 360, 90),
    ("Y", "head", 300, 200),
    ("Z", "head", 300, 200),
    ("A", "head", 100, 90),
];

/// A table-table machine of which the file is changed, by a name: `modulo-sign` and `shortest` say how words of C turn; or [`SLIDE`].
pub(super) fn machine(name: &str) -> Option<Machine> {
    if name == "slide" {
        let axes = SLIDE_AXES.map(|(letter, side, travel, speed)| {
            format!(
                "[[axis]]\nletter = \"{letter}\"\nside = \"{side}\"\nsign = 1\nlimits = [-{travel}, {travel}]\ndyn = {{ vmax = {speed}, amax = 1000 }}\n"
            )
        });
        return Some(load(name, &(SLIDE.to_owned() + &axes.concat())).expect("valid"));
    }
    let source = builtin_source("mikron-ucp710").expect("built in");
    // the rows that check the file say that words are literal
    let source = source.split("[[check]]").next().expect("a part");
    let text = match name {
        "modulo-sign" | "shortest" => source.replace("wrap = \"literal\"", &format!("wrap = \"{name}\"")),
        _ => return None,
    };
    Some(load(name, &text).expect("valid"))
}

/// Preset, tool and spindle of a Klartext program under M128.
const M128: &str = "BEGIN PGM A MM\n; preset 1 is at the centre of the table\n; trunnion: tool 1 length 80\nTOOL CALL 1 Z S1000\nCYCL DEF 247 DATUM SETTING ~\n Q339=+1\nM3\nM128\nL X+0 Y+0 Z+50 A+20 C+30 R0 FMAX\n";

/// The same of a Sinumerik program under TRAORI.
const TRAORI: &str = "; G54 is at the centre of the table\n; trunnion: tool 1 length 80\nG17 G54 G90 G94 G71 G40\nT1 D1\nM6\nTRAORI\nG0 X10 Y0 Z50 A10 C10 M3 S1000\n";

/// The same without a position.
const SLID: &str =
    "; G54 is at the centre of the table\n; trunnion: tool 1 length 80\nG17 G54 G90 G94 G71 G40\nT1 D1\nM6\nTRAORI\n";

pub(super) const FIVE_AXES: &[Item] = &[
    (
        "LN with a normal alone under M128 turns the tool to it",
        ["heidenhain-klartext", "mikron-ucp710"],
        [M128, "LN X+10 Y+0 Z+50 NX+0 NY+0.8 NZ-0.6 F500\nM30\nEND PGM A MM\n"],
        &["10 error unreachable-orientation"],
        [2, 2],
    ),
    (
        "LN with a normal and words of rotary axes",
        ["heidenhain-klartext", "mikron-ucp710"],
        [M128, "LN X+10 Y+0 Z+50 NX+0 NY+0 NZ+1 A+10 F500\nM30\nEND PGM A MM\n"],
        &["10 unknown not-modelled", "10 unknown position-unknown"],
        [2, 2],
    ),
    (
        "LN with a tool vector and words of rotary axes",
        ["heidenhain-klartext", "mikron-ucp710"],
        [
            M128,
            "LN X+10 Y+0 Z+50 TX+0 TY+0.6 TZ+0.8 A+10 C+200 F500\nM30\nEND PGM A MM\n",
        ],
        &["10 unknown not-modelled", "10 unknown position-unknown"],
        [2, 2],
    ),
    (
        "M91 under M128",
        ["heidenhain-klartext", "mikron-ucp710"],
        [M128, "L Z+300 FMAX M91\nL X+20 F500\nM30\nEND PGM A MM\n"],
        &[
            "10 unknown not-modelled",
            "10 warning tcp-state",
            "11 unknown position-unknown",
        ],
        [1, 3],
    ),
    (
        "a tool vector and words of rotary axes of a Sinumerik",
        ["sinumerik-840d", "mikron-ucp710"],
        [TRAORI, "G1 X20 A3=0 B3=0.1 C3=1 C200 A100 F500\nM30\n"],
        &["8 unknown position-unknown", "8 unknown not-modelled"],
        [2, 2],
    ),
    (
        "half a turn under M126",
        ["heidenhain-klartext", "mikron-ucp710"],
        [M128, "M126\nL X+10 C+210 F500\nM30\nEND PGM A MM\n"],
        &["11 warning axis-overspeed", "11 unknown not-modelled"],
        [2, 2],
    ),
    (
        "half a turn by DC",
        ["sinumerik-840d", "mikron-ucp710"],
        [TRAORI, "G1 X20 C=DC(190) F500\nM30\n"],
        &["8 unknown not-modelled", "8 warning axis-overspeed"],
        [2, 2],
    ),
    (
        "DC after a word whose sign is the direction",
        ["sinumerik-840d", "modulo-sign"],
        [TRAORI, "G0 X20 C-20\nG1 X30 C=DC(200) F500\nM30\n"],
        &[
            "9 unknown ambiguous-posture",
            "9 warning axis-overspeed",
            "9 warning excess-linear-travel",
        ],
        [3, 3],
    ),
    (
        "a word after M126 has carried the axis over 360",
        ["heidenhain-klartext", "mikron-ucp710"],
        [
            M128,
            "L C+350 FMAX\nM126\nL X+10 C+10 F500\nM127\nL X+20 C+20\nM30\nEND PGM A MM\n",
        ],
        &[
            "10 info angle-wrap",
            "14 unknown ambiguous-posture",
            "14 unknown position-unknown",
        ],
        [4, 4],
    ),
    (
        "a word after DC has carried the axis over 360",
        ["sinumerik-840d", "mikron-ucp710"],
        [TRAORI, "C350\nC=DC(10)\nG1 X20 C20 F500\nM30\n"],
        &[
            "8 info angle-wrap",
            "10 unknown position-unknown",
            "10 unknown ambiguous-posture",
        ],
        [4, 4],
    ),
    (
        "a word after DC has carried an axis whose words take the shorter way",
        ["sinumerik-840d", "shortest"],
        [TRAORI, "C350\nC=DC(10)\nG1 X20 C20 F500\nM30\n"],
        &["10 warning excess-rapid-travel"],
        [4, 4],
    ),
    (
        "a position at which the linear axes do not span space",
        ["sinumerik-840d", "slide"],
        [SLID, "G0 X10 Y20 Z50 A0 C90 M3 S1000\nG1 X20 F500\nM30\n"],
        &["7 unknown position-unknown"],
        [2, 2],
    ),
    (
        "a block that passes such a position",
        ["sinumerik-840d", "slide"],
        [SLID, "G0 X10 Y20 Z50 A0 C80 M3 S1000\nG1 X20 C100 F500\nM30\n"],
        &[
            "8 unknown axis-overspeed",
            "8 unknown axis-limit",
            "8 warning pole-flip",
        ],
        [2, 2],
    ),
];
