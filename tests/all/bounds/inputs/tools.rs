//! Tools, as many as there are lines: declared, defined, with offsets.
use super::{Input, cut, lines};

pub(super) fn inputs() -> Vec<Input> {
    vec![
        Input::new("offsets-of-many-tools", |n| {
            cut(&lines(n / 2, |i| format!("G10 L10 P{i} R{}.\nG43 H{i} Z1.", i % 90)))
        }),
        Input::new("declared-tools", |n| {
            let declared = lines(n / 2, |i| format!("(trunnion: tool {i} ball diameter 10 length 90)"));
            let used = lines(n / 4, |i| format!("T{i} M6\nG43 H{i} Z1."));
            cut(&format!("{declared}{used}"))
        }),
        Input::of("heidenhain-klartext", "klartext-tools", |n| {
            let body = lines(n / 3, |i| {
                format!("TOOL DEF {i} L+{} R+5\nTOOL CALL {i} Z S1000\nL Z+50 R0 FMAX", i % 90)
            });
            format!("BEGIN PGM P MM\n{body}M30\nEND PGM P MM\n").into_bytes()
        }),
    ]
}
