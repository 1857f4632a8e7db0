//! Throwaway.
use std::time::Instant;
use trunnion_syntax::*;
fn main() {
    let path = std::env::args().nth(1).unwrap();
    let source = std::fs::read(&path).unwrap();
    let n = source.len() as f64;
    let mode = std::env::args().nth(2).is_none();
    for _ in 0..5 {
        let copy = source.clone();
        let t = Instant::now();
        let lines = memchr::memchr_iter(b'\n', &copy).count();
        let tl = t.elapsed();
        let t = Instant::now();
        let program = parse(copy, LexOptions::default());
        let tp = t.elapsed();
        let t = Instant::now();
        let (mut count, mut sum) = (0u64, 0.0);
        for block in program.blocks() {
            for item in block.items() {
                if let Item::Word(Word {
                    value: Value::Number(d),
                    ..
                }) = item
                {
                    count += 1;
                    if mode {
                        sum += d.to_f64();
                    } else {
                        sum += d.mantissa as f64;
                    }
                }
            }
        }
        let tw = t.elapsed();
        let b = program.block_count() as f64;
        let t = Instant::now();
        let again = program
            .relex(&[TextEdit {
                range: TextRange::new(source.len() as u32 / 2, source.len() as u32 / 2 + 1),
                new_text: "7".into(),
            }])
            .unwrap();
        let tr = t.elapsed();
        println!(
            "lines {lines} {:?}; parse {:?} {:.0} MB/s {:.3} us/block; words {count} {sum:.3} {:.3} us/block; relex {:?} {} errors {}",
            tl,
            tp,
            n / tp.as_secs_f64() / 1e6,
            tp.as_secs_f64() * 1e6 / b,
            tw.as_secs_f64() * 1e6 / b,
            tr,
            again.block_count(),
            program.errors().len()
        );
    }
}
