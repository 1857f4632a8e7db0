//! What the fuzz targets do with any bytes. `cargo test --test all fuzz_targets` runs the same functions on the seeds and on mutations of them
//! without a fuzzer, so that the targets stay true on a stable toolchain.

use std::sync::Arc;
use trunnion_certify::Certificate;
use trunnion_check::Config;
use trunnion_dialect::{BUILTIN_NAMES, Dialect, builtin};
use trunnion_interp::{Fault, Limits, ModalState, Motion, Setup, Sink, run as interpret};
use trunnion_layout::{Layout, Style, layout};
use trunnion_syntax::{BlockId, parse as parse_text};

/// The dialect that the first byte selects, and the text.
fn program(data: &[u8]) -> Option<(&'static Dialect, &[u8])> {
    let (&first, text) = data.split_first()?;
    Some((builtin(dialect_of(first))?, text))
}

/// A is the first dialect of the list, B the second; other bytes go round.
pub(crate) fn dialect_of(first: u8) -> &'static str {
    BUILTIN_NAMES[usize::from(first.wrapping_sub(b'A')) % BUILTIN_NAMES.len()]
}

/// Any bytes, any options: the tokens concatenate to the file, items and records lie inside their block.
pub(crate) fn parse(data: &[u8]) {
    let Some((dialect, text)) = program(data) else { return };
    let program = parse_text(text.to_vec(), dialect.lex);
    let tokens = program.tokens();
    let mut at = 0;
    for id in 0..tokens.len() as u32 {
        let range = tokens.range(id);
        assert_eq!(range.start, at, "tokens leave no gap");
        at = range.end;
    }
    assert_eq!(at as usize, text.len(), "tokens concatenate to the file");
    for id in 0..program.block_count() as u32 {
        let block = program.block(BlockId(id));
        let range = block.range();
        let mut last = range.start;
        for word in block.words() {
            assert!(
                word.range.start >= last && word.range.end <= range.end,
                "words lie in order inside their block"
            );
            last = word.range.start;
        }
        block.items().for_each(drop);
        if let Some(record) = block.record() {
            std::hint::black_box(record);
        }
    }
    for error in program.errors() {
        assert!(error.range.start <= error.range.end && error.range.end as usize <= text.len());
    }
}

struct Inside(usize);

impl Sink for Inside {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        for axis in 0..9 {
            if let Some(value) = motion.end.get(axis) {
                assert!(value.is_finite(), "a known coordinate is a number");
            }
        }
    }
    fn fault(&mut self, fault: Fault) {
        assert!(fault.range.start <= fault.range.end && fault.range.end as usize <= self.0);
    }
}

fn setup(blocks: u64, depth: u32) -> Setup {
    let limits = Limits {
        blocks,
        // two texts are compared as far as this: an endless loop must not end the search
        steps: blocks,
        depth,
        ..Limits::default()
    };
    Setup {
        limits: limits.of_steps(),
        ..Setup::default()
    }
}

/// Any program in any dialect runs to its end within its bounds, without a panic, and every fact lies inside the file.
pub(crate) fn run(data: &[u8]) {
    let Some((dialect, text)) = program(data) else { return };
    let program = parse_text(text.to_vec(), dialect.lex);
    interpret(&program, dialect, &setup(2_000, 20), &mut Inside(text.len()));
}

/// Any program in any dialect: a layout that is given out is proved, and laid out again it stays as it is.
pub(crate) fn fmt(data: &[u8]) {
    let Some((dialect, text)) = program(data) else { return };
    let setup = setup(500, 10);
    let style = Style::default();
    let program = parse_text(text.to_vec(), dialect.lex);
    if let Layout::Changed(after) = layout(&program, dialect, &setup, &style) {
        let again = parse_text(after, dialect.lex);
        assert!(
            matches!(layout(&again, dialect, &setup, &style), Layout::Unchanged),
            "a layout is stable"
        );
    }
}

struct InsideFile(usize);

impl trunnion_ngc::Sink for InsideFile {
    fn call(&mut self, call: &trunnion_ngc::Canon, _at: trunnion_ngc::At, _state: &trunnion_ngc::State) {
        std::hint::black_box(call);
    }
    fn error(&mut self, error: &trunnion_ngc::Error, _at: trunnion_ngc::At) {
        assert!(!error.message().is_empty(), "an error has words");
        if error.file == trunnion_ngc::FileId::MAIN {
            assert!(error.range.start <= error.range.end && error.range.end as usize <= self.0);
        }
    }
}

/// Any bytes as a LinuxCNC program: it ends within its bounds, every error lies inside the file, the listing can be written.
pub(crate) fn canon(data: &[u8]) {
    use trunnion_ngc::{Engine, Limits, Setup, Source, Start};
    let Some((&first, text)) = data.split_first() else {
        return;
    };
    let start = if first.is_multiple_of(2) {
        Start::Zero
    } else {
        Start::Unknown
    };
    let setup = Setup {
        start,
        limits: Limits {
            blocks: 2_000,
            depth: 10,
            ..Limits::default()
        },
        ..Setup::default()
    };
    let mut engine = Engine::new(Arc::new(Source::new(String::new(), text.into())), &setup);
    engine.run(first % 4 < 2, &mut InsideFile(text.len()));
    engine.read_rest(&mut InsideFile(text.len()));
}

/// Any bytes as each file beside a program: a machine, settings, a dialect table, a certificate, a surface, an STL, an INI file, a FreeCAD
/// machine. Each is read or refused; nothing panics.
pub(crate) fn formats(data: &[u8]) {
    let Some((&format, bytes)) = data.split_first() else {
        return;
    };
    if format % 8 == 5 {
        let _ = trunnion_surface::required_stl(bytes);
        return;
    }
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match format % 8 {
        0 => drop(trunnion_machine::load("m", text)),
        1 => drop(Config::parse(text)),
        2 => drop(Dialect::from_table(text, "t")),
        3 => drop(Certificate::from_json(text)),
        4 => drop(trunnion_surface::required(text, false, 0.001)),
        6 => drop(trunnion_machine::import_linuxcnc("m.ini", text, &[])),
        _ => drop(trunnion_machine::import_freecad("m.fcm", text)),
    }
}
