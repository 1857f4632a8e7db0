//! `cargo bench --bench folder`: a check of a folder of small programs, a tenth of them and all: the time that passes, processor time, memory.
//! On two cores half as much time passes as is used; a file takes as long in the large folder as in the small one. `-- 50000` sets the files.
#![expect(clippy::print_stdout, reason = "a benchmark prints its table")]
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

#[path = "../tests/all/bounds/measure.rs"]
#[expect(dead_code, reason = "the benchmark uses its part")]
mod measure;

const FILES: usize = 50_000;

/// Programs of four languages, as short as a subprogram.
const BODIES: [(&str, &str); 4] = [
    (
        "nc",
        "(trunnion: machine mikron-ucp710)\nG21 G90 G17 G54\nG43.4 H1\nG1 X1. A10. C20. F100.\nC400.\nM30\n",
    ),
    ("mpf", "G90 G71 G54\nTRAORI\nG1 X=R1 A3=0 B3=0 C3=1 F100\nM30\n"),
    (
        "ngc",
        "G21 G90\no1 while [#1 LT 3]\nG1 X#1 F100\n#1 = [#1 + 1]\no1 endwhile\nM2\n",
    ),
    ("apt", "PARTNO X\nGOTO/1,2,3\nFINI\n"),
];

fn main() {
    let asked = std::env::args().skip(1).find_map(|argument| argument.parse().ok());
    let files = asked.unwrap_or(FILES);
    println!(
        "{:>8} {:>10} {:>12} {:>12} {:>8}",
        "files", "passed/s", "processor/s", "ms a file", "MB"
    );
    for files in [files / 10, files] {
        let folder = tempfile::TempDir::new().expect("a folder");
        fill(folder.path(), files);
        let command = ["check", "--format", "json", "."].map(String::from);
        let begun = Instant::now();
        let measured = measure::run(folder.path(), &command, Vec::new(), Duration::from_hours(1));
        let passed = begun.elapsed().as_secs_f64();
        assert_eq!(measured.status, Some(1), "{}", measured.said);
        println!(
            "{files:>8} {passed:>10.1} {:>12.1} {:>12.3} {:>8}",
            measured.seconds,
            measured.seconds * 1e3 / files as f64,
            measured.bytes / 1_000_000
        );
    }
}

fn fill(folder: &Path, files: usize) {
    for file in 0..files {
        let place = folder.join(format!("lot-{}", file % 7));
        let (extension, body) = BODIES[file % BODIES.len()];
        fs::create_dir_all(&place).expect("made");
        fs::write(place.join(format!("part-{file}.{extension}")), body).expect("written");
    }
}
