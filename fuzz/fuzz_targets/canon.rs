//! Any bytes as a LinuxCNC program: it ends within its bounds, every error lies inside the file, the listing can be written.
#![no_main]
use libfuzzer_sys::fuzz_target;
use std::sync::Arc;
use trunnion_ngc::{At, Canon, Engine, Error, FileId, Limits, Setup, Sink, Source, Start, State};

struct Inside(usize);

impl Sink for Inside {
    fn call(&mut self, call: &Canon, _at: At, _state: &State) {
        std::hint::black_box(call);
    }
    fn error(&mut self, error: &Error, _at: At) {
        assert!(!error.message().is_empty(), "an error has words");
        if error.file == FileId::MAIN {
            assert!(error.range.start <= error.range.end && error.range.end as usize <= self.0);
        }
    }
}

fuzz_target!(|data: &[u8]| {
    let Some((&first, text)) = data.split_first() else { return };
    let start = if first % 2 == 0 { Start::Zero } else { Start::Unknown };
    let setup = Setup {
        start,
        limits: Limits {
            blocks: 2_000,
            depth: 10,
        },
        ..Setup::default()
    };
    let mut engine = Engine::new(Arc::new(Source::new(String::new(), text.into())), &setup);
    engine.run(first % 4 < 2, &mut Inside(text.len()));
    engine.read_rest(&mut Inside(text.len()));
});
