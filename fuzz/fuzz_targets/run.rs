//! Any program in any dialect runs to its end within its bounds, without a panic, and every fact lies inside the file.
#![no_main]
use libfuzzer_sys::fuzz_target;
use trunnion_dialect::{BUILTIN_NAMES, builtin};
use trunnion_interp::{Fault, Limits, ModalState, Motion, Setup, Sink, run};
use trunnion_syntax::parse;

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

fuzz_target!(|data: &[u8]| {
    let Some((&first, text)) = data.split_first() else { return };
    let Some(dialect) = builtin(BUILTIN_NAMES[usize::from(first) % BUILTIN_NAMES.len()]) else { return };
    let setup = Setup {
        limits: Limits { blocks: 2_000, depth: 20 },
        ..Setup::default()
    };
    let program = parse(text.to_vec(), dialect.lex);
    run(&program, dialect, &setup, &mut Inside(text.len()));
});
