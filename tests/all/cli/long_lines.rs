//! One line of megabytes.
use super::tools::{status, text, trunnion_in};
use std::fs;
use tempfile::TempDir;

/// One line of many words that all have something wrong with them: a finding shows a part of the line. What is printed for people does not grow
/// with the line, and documents for programs grow as the line does, not with its square.
#[test]
fn what_is_said_about_one_line_does_not_grow_with_it() {
    let folder = TempDir::new().expect("works");
    let line = |words: usize| format!("O1\nG21 G90\n{}\nM30\n", "X1. Z2. U3. W4. G99 Q7 ".repeat(words));
    fs::write(folder.path().join("short.nc"), line(500)).expect("writable");
    fs::write(folder.path().join("long.nc"), line(10_000)).expect("writable");
    for dialect in trunnion::dialect::BUILTIN_NAMES
        .iter()
        .filter(|name| name.contains("lathe"))
    {
        for format in ["pretty", "json", "sarif"] {
            let said = |file: &str| {
                let arguments = ["check", "--dialect", dialect, "--format", format, file];
                let output = trunnion_in(folder.path(), &arguments);
                assert!(status(&output) < 2, "{}", text(&output.stderr));
                output.stdout.len()
            };
            let (short, long) = (said("short.nc"), said("long.nc"));
            let most = if format == "pretty" { short + 1000 } else { 20 * short };
            assert!(long < most, "{dialect} {format}: {short} and {long} bytes");
        }
    }
}
