//! Any program in any dialect: a layout that is given out is proved, and laid out again it stays as it is.
#![no_main]
use libfuzzer_sys::fuzz_target;
use trunnion_dialect::{BUILTIN_NAMES, builtin};
use trunnion_interp::{Limits, Setup};
use trunnion_layout::{Layout, Style, layout};
use trunnion_syntax::parse;

fuzz_target!(|data: &[u8]| {
    let Some((&first, text)) = data.split_first() else { return };
    let Some(dialect) = builtin(BUILTIN_NAMES[usize::from(first) % BUILTIN_NAMES.len()]) else { return };
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
