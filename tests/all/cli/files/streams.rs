//! Closed and full standard streams, and what a terminal is shown.
use super::folder;
use crate::cli::tools::{FLIP, status, str, text, trunnion, write};
use std::process::{Command, Stdio};

fn shell(script: &str) -> i32 {
    let output = Command::new("bash")
        .args(["-c", script])
        .env("T", env!("CARGO_BIN_EXE_trunnion"))
        .stdin(Stdio::null())
        .output()
        .expect("bash runs");
    assert!(
        !text(&output.stderr).contains("panicked"),
        "{script}: {}",
        text(&output.stderr)
    );
    output.status.code().expect("not killed")
}

#[test]
fn closed_and_full_streams_keep_the_status_of_the_verdict() {
    let folder = folder();
    let bad = write(&folder, "bad.nc", FLIP);
    let good = write(&folder, "good.nc", "G21 G90 G54\nG0 X1\nM30\n");
    let (bad, good) = (str(&bad), str(&good));
    let scripts = [
        (
            format!("$T check {bad} --machine mikron-ucp710 2>/dev/null | true; exit ${{PIPESTATUS[0]}}"),
            1,
        ),
        (
            format!("$T check {bad} --machine mikron-ucp710 >/dev/full 2>/dev/null"),
            1,
        ),
        (
            format!("$T check {bad} --machine mikron-ucp710 >/dev/null 2>/dev/full"),
            1,
        ),
        (format!("$T check {bad} --machine mikron-ucp710 >&- 2>&-"), 1),
        (format!("$T check {good} --machine nothing-like-it 2>/dev/full"), 2),
        (
            format!("$T diff {bad} {good} 2>/dev/null | true; exit ${{PIPESTATUS[0]}}"),
            1,
        ),
        (format!("$T fmt --check {good} > /dev/full 2>/dev/full"), 0),
        (
            format!("$T trace {bad} --machine mikron-ucp710 2>/dev/null | true; exit ${{PIPESTATUS[0]}}"),
            0,
        ),
        ("$T rules 2>/dev/null | true; exit ${PIPESTATUS[0]}".to_owned(), 0),
        ("$T --help >/dev/full 2>/dev/full; [ $? -lt 3 ]".to_owned(), 0),
    ];
    for (script, expected) in &scripts {
        assert_eq!(shell(script), *expected, "{script}");
    }
}

#[test]
fn output_that_is_lost_is_an_error_of_commands_that_write_data() {
    let folder = folder();
    let program = write(&folder, "p.nc", FLIP);
    let script = format!(
        "$T plot {} --machine mikron-ucp710 --kind joints >/dev/full 2>/dev/null",
        str(&program)
    );
    assert_eq!(shell(&script), 2);
}

#[test]
fn control_characters_are_shown_as_escapes() {
    let folder = folder();
    let program = write(
        &folder,
        "p\u{1b}[2J.nc",
        "G21 G90\nG1 X1 \u{1b}[31m\u{9b}2J F100\nM30\n",
    );
    for arguments in [
        vec!["check", "--format", "short", str(&program)],
        vec!["check", "--format", "pretty", str(&program)],
        vec!["stats", str(&program)],
        vec!["check", "--machine", "x\u{1b}[2J", str(&program)],
        vec!["check", "/missing\u{1b}[2J.nc"],
    ] {
        let output = trunnion(&arguments);
        assert!(status(&output) <= 2);
        for stream in [text(&output.stdout), text(&output.stderr)] {
            let control = stream.chars().find(|c| c.is_control() && !matches!(c, '\n' | '\t'));
            assert_eq!(control, None, "{arguments:?}: {stream}");
        }
    }
}
