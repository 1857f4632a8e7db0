//! Any program in any dialect: a layout that is given out is proved, and laid out again it stays as it is.
#![no_main]
use libfuzzer_sys::fuzz_target;
use trunnion::dialect::builtin;
use trunnion::interp::{Limits, Setup};
use trunnion::layout::{Layout, Style, layout};
use trunnion::syntax::parse;

const DIALECTS: [&str; 7] = [
    "iso-6983",
    "linuxcnc",
    "fanuc-30i",
    "haas-ngc",
    "grbl",
    "sinumerik-840d",
    "apt",
];

fuzz_target!(|data: &[u8]| {
    let Some((&first, text)) = data.split_first() else { return };
    let Some(dialect) = builtin(DIALECTS[usize::from(first) % DIALECTS.len()]) else { return };
    let setup = Setup {
        limits: Limits { blocks: 500, depth: 10 },
        ..Setup::default()
    };
    let style = Style::default();
    let program = parse(text.to_vec(), dialect.lex);
    if let Layout::Changed(after) = layout(&program, dialect, &setup, &style) {
        let again = parse(after, dialect.lex);
        assert!(
            matches!(layout(&again, dialect, &setup, &style), Layout::Unchanged),
            "a layout is stable"
        );
    }
});
