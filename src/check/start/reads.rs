//! Which codes of the power-on state a program asks for before it programs one of their group: `#4003`, `#<_absolute>`, `$P_GG[14]`.
use super::{DISTANCES, FEEDS, MOTIONS, PLANES, UNITS, actions};
use trunnion_dialect::{Action, Dialect};
use trunnion_syntax::Program;

/// The groups in the order of [`reads_first`], and the names of what is in effect, without blanks and in lower case (Fanuc Series 30i operator's
/// manual, modal information; LinuxCNC documentation, predefined named parameters; Sinumerik system variables, G groups).
const ASKED: [(&[Action], &[&str]); 5] = [
    (&MOTIONS, &["#4001", "#<_motion_mode>", "$p_gg[1]"]),
    (&PLANES, &["#4002", "#<_plane>", "$p_gg[6]"]),
    (&DISTANCES, &["#4003", "#<_absolute>", "#<_incremental>", "$p_gg[14]"]),
    (
        &FEEDS,
        &[
            "#4005",
            "#<_inverse_time>",
            "#<_units_per_minute>",
            "#<_units_per_rev>",
            "$p_gg[15]",
        ],
    ),
    (&UNITS, &["#4006", "#<_metric>", "#<_imperial>", "$p_gg[13]"]),
];

/// For motion, plane, distance, feed and unit: the program asks before it programs, in the order of its text.
pub(super) fn reads_first(program: &Program, dialect: &Dialect) -> [bool; 5] {
    let mut reads = [false; 5];
    let source = program.source();
    let asks = |needle: &[u8]| memchr::memmem::find(source, needle).is_some();
    if ![&b"#400"[..], b"#<_", b"$P_GG", b"$p_gg"].into_iter().any(asks) {
        return reads;
    }
    let mut open = [true; 5];
    for block in program.blocks() {
        let mut text = program.bytes(block.range()).to_ascii_lowercase();
        let start = block.range().start;
        for comment in block.comments() {
            let range = (comment.range.start - start) as usize..(comment.range.end - start) as usize;
            text[range].fill(b' ');
        }
        text.retain(|byte| !byte.is_ascii_whitespace());
        let codes = actions(&block, dialect);
        for (group, (of_group, names)) in ASKED.into_iter().enumerate() {
            if !open[group] {
                continue;
            }
            reads[group] = names.iter().any(|name| memchr::memmem::find(&text, name.as_bytes()).is_some());
            open[group] = !reads[group] && !codes.iter().any(|code| of_group.contains(code));
        }
        if open == [false; 5] {
            break;
        }
    }
    reads
}
