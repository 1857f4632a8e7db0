//! Any bytes, any options: the tokens concatenate to the file, items and records lie inside their block.
#![no_main]
use libfuzzer_sys::fuzz_target;
use trunnion_dialect::{BUILTIN_NAMES, builtin};
use trunnion_syntax::{BlockId, parse};

fuzz_target!(|data: &[u8]| {
    let Some((&first, text)) = data.split_first() else { return };
    let dialect = builtin(BUILTIN_NAMES[usize::from(first) % BUILTIN_NAMES.len()]).expect("built in");
    let program = parse(text.to_vec(), dialect.lex);
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
            assert!(word.range.start >= last && word.range.end <= range.end, "words lie in order inside their block");
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
});
