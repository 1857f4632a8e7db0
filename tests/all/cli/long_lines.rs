//! One line of megabytes.
use super::tools::{status, text, trunnion_in};
#[cfg(target_os = "linux")]
use crate::bounds::measure;
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

/// Each byte of a file may be a part of one line: the parts are written one by one. A document of all of them took almost a kilobyte for each byte.
#[cfg(target_os = "linux")]
#[test]
fn the_parts_of_one_line_are_not_held_as_a_document() {
    const BYTES: u64 = 300_000;
    let folder = TempDir::new().expect("works");
    fs::write(folder.path().join("bytes.nc"), vec![0xff; BYTES as usize]).expect("writable");
    let command = ["parse", "--format", "json", "--dialect", "sinumerik-840d", "bytes.nc"].map(String::from);
    let measured = measure::run(folder.path(), &command, Vec::new(), std::time::Duration::from_mins(5));
    assert!(measured.is_json());
    assert!(measured.bytes < 300 * BYTES, "{} bytes", measured.bytes);
}

/// Changes that `diff` lists for programs are made and written one by one: a document of all of them took 6 kB for each line.
#[cfg(target_os = "linux")]
#[test]
fn the_changes_of_two_programs_are_not_held_as_a_document() {
    const LINES: u64 = 20_000;
    let folder = TempDir::new().expect("works");
    let program = |x: u32| {
        format!(
            "G21 G90 G94 F100\nG1 X0 Y0 Z50\n{}M30\n",
            format!("G1 X{x}.\nX3.\n").repeat(LINES as usize / 2)
        )
    };
    fs::write(folder.path().join("a.nc"), program(1)).expect("writable");
    fs::write(folder.path().join("b.nc"), program(2)).expect("writable");
    let command = ["diff", "--format", "json", "--dialect", "fanuc-30i", "a.nc", "b.nc"].map(String::from);
    let measured = measure::run(folder.path(), &command, Vec::new(), std::time::Duration::from_mins(5));
    assert!(
        measured.is_json() && measured.printed() > 100 * LINES,
        "{} bytes",
        measured.printed()
    );
    assert!(measured.bytes < 2500 * LINES, "{} bytes", measured.bytes);
}
