//! Closed and full standard streams, and what a terminal is shown.
use super::folder;
use crate::cli::tools::{FLIP, status, str, text, trunnion, write};
use std::{
    fs,
    path::Path,
    process::{Command, Stdio},
};

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
        (
            format!("$T report {bad} --machine mikron-ucp710 -o - 2>/dev/null | true; exit ${{PIPESTATUS[0]}}"),
            1,
        ),
        (
            format!("$T report {bad} --machine mikron-ucp710 -o - >/dev/full 2>/dev/null"),
            2,
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

/// Every command, with arguments that it can work with; `P` and `Q` are programs.
const COMMANDS: [&str; 43] = [
    "check P",
    "check --format json P",
    "check --format pretty P",
    "check nothing.nc",
    "trace P",
    "trace --format json P",
    "canon P",
    "fix P",
    "certify P P",
    "certify P Q",
    "convert P --to apt",
    "convert P --to sinumerik-840d",
    "fmt --check P",
    "fmt --diff P",
    "fmt --stdout P",
    "diff P Q",
    "diff P P",
    "diff --format json P Q",
    "stats P",
    "stats --format json P",
    "explain pole-flip",
    "rules",
    "rules --format json",
    "machine list",
    "machine show mikron-ucp710",
    "machine check mikron-ucp710",
    "plot P --kind joints",
    "plot P --kind path",
    "surface P --required r.toml",
    "sample grid",
    "parse P",
    "parse --format json P",
    "parse --tokens P",
    "report P -o -",
    "check P -o -",
    "servo P --at 8 --kv 50 --acc 2000",
    "machine compare mikron-ucp710 mikron-ucp710 P",
    "schema check",
    "completions bash",
    "man",
    "lsp",
    "--help",
    "bogus",
];

/// A folder with the programs P and Q, whose names and texts hold what a terminal obeys, and what the commands need beside them.
fn programs() -> tempfile::TempDir {
    const HOSTILE: &str = "\u{1b}[31m\u{9b}2J\u{202e}";
    let folder = folder();
    let program = |x: u32| {
        format!(
            "(c {HOSTILE})\nG21 G90 G17 G54 G94\nT1 M6\nS100 M3\nG43 H1\nG0 X0 Y0 Z0 A0 C0\nG1 X{x} F100\nG1 X1 A30 C{x}0\n(MSG, {HOSTILE})\nM2\n"
        )
    };
    write(&folder, "p\u{1b}[2J.ngc", &program(10));
    write(&folder, "q\u{1b}[2J.ngc", &program(11));
    let required =
        "schema = \"trunnion-surface/1\"\n[[grid]]\nrows = [[[0, 0, 0], [100, 0, 0]], [[0, 100, 0], [100, 100, 0]]]\n";
    write(&folder, "r.toml", required);
    let settings = "machine = \"mikron-ucp710\"\n[work_offsets]\nG54 = { X = 0, Y = 0, Z = 0 }\n[[tool]]\nnumber = 1\nshape = \"ball\"\ndiameter = 10\nlength = 100\n";
    write(&folder, "trunnion.toml", settings);
    folder
}

fn words(command: &str) -> Vec<&str> {
    let names = |word| match word {
        "P" => "p\u{1b}[2J.ngc",
        "Q" => "q\u{1b}[2J.ngc",
        word => word,
    };
    command.split(' ').map(names).collect()
}

#[test]
fn no_command_minds_a_stream_that_is_closed_or_full() {
    let folder = programs();
    // `T` in the folder, with the command's words as arguments
    let run = |words: &[&str], script: &str| {
        let output = Command::new("bash")
            .args(["-c", script, "bash"])
            .args(words)
            .env("T", env!("CARGO_BIN_EXE_trunnion"))
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .output()
            .expect("bash runs");
        assert!(
            !text(&output.stderr).contains("panicked"),
            "{words:?}: {}",
            text(&output.stderr)
        );
        output.status.code().expect("not killed")
    };
    for command in COMMANDS {
        let words = words(command);
        let expected = run(&words, "\"$T\" \"$@\" >/dev/null 2>/dev/null");
        assert!((0..=2).contains(&expected), "{command}: {expected}");
        for gone in [
            "\"$T\" \"$@\" 2>/dev/null | true; exit ${PIPESTATUS[0]}",
            "\"$T\" \"$@\" 2>&1 >/dev/null | true; exit ${PIPESTATUS[0]}",
            "\"$T\" \"$@\" >&- 2>&-",
            "\"$T\" \"$@\" >/dev/null 2>/dev/full",
        ] {
            assert_eq!(run(&words, gone), expected, "{command} with {gone}");
        }
        // lost data are an error of the commands that write data
        for full in ["\"$T\" \"$@\" >/dev/full", "\"$T\" \"$@\" >/dev/full 2>/dev/full"] {
            let status = run(&words, full);
            assert!(status == expected || status == 2, "{command} with {full}: {status}");
        }
    }
}

#[test]
fn no_command_shows_a_control_character() {
    let folder = programs();
    for command in COMMANDS {
        // what they write is a program's own text, or data: JSON, and the canonical calls as the control prints them
        let is_data = ["convert", "fix", "fmt --stdout", "fmt --diff", "canon", "json", "lsp"]
            .iter()
            .any(|data| command.contains(data));
        let output = Command::new(env!("CARGO_BIN_EXE_trunnion"))
            .args(words(command))
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .output()
            .expect("runs");
        for (stream, is_data) in [(text(&output.stdout), is_data), (text(&output.stderr), false)] {
            let hidden = |c: &char| c.is_control() && !matches!(c, '\n' | '\t') || *c == '\u{202e}';
            let found = stream.chars().find(hidden).filter(|_| !is_data);
            assert_eq!(found, None, "{command}: {stream}");
        }
    }
}

#[test]
fn the_header_of_a_diff_shows_the_file_name() {
    let folder = folder();
    write(&folder, "x\u{1b}[2J.ngc", "g1   x1 f100\nm2\n");
    let output = Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args(["fmt", "--diff", "--dialect", "linuxcnc", "x\u{1b}[2J.ngc"])
        .current_dir(folder.path())
        .output()
        .expect("runs");
    let header: String = text(&output.stdout).lines().take(2).collect();
    assert!(
        header.contains("x\\x1b[2J.ngc") && !header.contains('\u{1b}'),
        "{header:?}"
    );
}

/// A reader of the program that goes away does not keep the command from writing its certificate.
#[test]
fn a_closed_stream_does_not_keep_other_outputs_from_being_written() {
    let folder = folder();
    let piece = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/programs/apt/small-piece.apt");
    let certificate = folder.path().join("proof.json");
    let script = format!(
        "$T convert {} --to fanuc-30i --machine mikron-ucp710 --certificate {} 2>/dev/null | true; exit ${{PIPESTATUS[0]}}",
        str(&piece),
        str(&certificate)
    );
    assert_eq!(shell(&script), 0);
    assert!(fs::metadata(&certificate).is_ok_and(|file| file.len() > 100));
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
