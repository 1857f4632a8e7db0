//! An implementation that was thought out separately (tests/independent, Python) runs random programs and must find what `trunnion` finds.
use std::path::Path;
use std::process::Command;

/// Seeds of each theme: few enough for a debug build to take less than half a minute.
const SEEDS: &str = "12";

#[test]
#[expect(clippy::print_stderr, reason = "a test that is skipped says so")]
fn trunnion_and_the_independent_implementation_agree() {
    let is_new_enough = Command::new("python3")
        .args(["-c", "import sys; sys.exit(sys.version_info < (3, 11))"])
        .status();
    if !is_new_enough.is_ok_and(|status| status.success()) {
        eprintln!("skipped: there is no python3, 3.11 or newer");
        return;
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/independent");
    let run = Command::new("python3")
        .arg("-B")
        .arg(folder.join("run.py"))
        .args([env!("CARGO_BIN_EXE_trunnion"), "--seed", "1", "--count", SEEDS])
        .output()
        .expect("python3 runs");
    let said = String::from_utf8_lossy(&run.stdout);
    let errors = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{said}\n{errors}");
    // a comparison of nothing would agree too
    let compared = said
        .split_ascii_whitespace()
        .next_back()
        .and_then(|word| word.parse().ok());
    assert!(compared.is_some_and(|known: u32| known >= 300), "{said}");
}
