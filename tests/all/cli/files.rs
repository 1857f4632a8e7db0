//! The user's files: what commands read, replace and leave alone. Promises: docs/files.md.
#![cfg(unix)]
mod killed;
mod streams;
mod walking;
mod writers;

use super::tools::{FLIP, status, str, text, trunnion, trunnion_in, write};
use std::{
    fs,
    os::unix::fs::{FileTypeExt, symlink},
    path::Path,
};
use tempfile::TempDir;

/// A program whose layout changes.
const LOOSE: &str = "%\nO1\nG21G90G17\nG54\nT1M6\nS1000M3\nG0X1Y2\nG1Z-1F100\nX5\nM30\n%\n";
const MACHINE: &str = "mikron-ucp710";

fn folder() -> TempDir {
    TempDir::new().expect("a folder")
}

fn content(path: &Path) -> String {
    fs::read_to_string(path).expect("readable")
}

/// Names in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("a folder")
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn fifo(path: &Path) {
    let made = std::process::Command::new("mkfifo").arg(path).status().expect("runs");
    assert!(made.success());
}

#[test]
fn no_output_replaces_an_input() {
    let folder = folder();
    let program = write(&folder, "p.nc", FLIP);
    let settings = write(&folder, "trunnion.toml", &format!("machine = \"{MACHINE}\"\n"));
    let p = str(&program);
    let link = folder.path().join("link.nc");
    symlink(&program, &link).expect("a link");
    let commands: &[&[&str]] = &[
        &["plot", p, "--kind", "joints", "-o", p],
        &["plot", p, "--kind", "joints", "-o", str(&link)],
        &["plot", p, "--kind", "joints", "-o", str(&settings)],
        &["convert", p, "--to", "apt", "-o", p],
        &["fix", p, "-o", p],
        &["edit", p, "--mirror", "X", "-o", p],
        &["fix", p, "--certificate", p],
        &["canon", p, "--parameters", p],
        &["canon", p, "-o", p],
        &["trace", p, "-o", p],
    ];
    for arguments in commands {
        let output = trunnion(arguments);
        assert_eq!(status(&output), 2, "{arguments:?}: {}", text(&output.stderr));
        assert!(
            text(&output.stderr).contains("also an input"),
            "{arguments:?}: {}",
            text(&output.stderr)
        );
    }
    assert_eq!(content(&program), FLIP);
    assert_eq!(names(folder.path()), ["link.nc", "p.nc", "trunnion.toml"]);
}

#[test]
fn two_outputs_of_one_command_are_two_files() {
    let folder = folder();
    let program = write(&folder, "p.nc", FLIP);
    let out = folder.path().join("out");
    let arguments = [
        "fix",
        str(&program),
        "--machine",
        MACHINE,
        "-o",
        str(&out),
        "--certificate",
        str(&out),
    ];
    let output = trunnion(&arguments);
    assert_eq!(status(&output), 2);
    assert!(
        text(&output.stderr).contains("also the output of -o"),
        "{}",
        text(&output.stderr)
    );
    assert!(!out.exists());
}

/// The file of `-o` holds what standard output would, whole or not at all.
#[test]
fn lists_go_into_a_file() {
    let folder = folder();
    write(&folder, "p.nc", FLIP);
    write(&folder, "p.ngc", "G21\nG1 X1 F100\nM2\n");
    let commands: [&[&str]; 3] = [
        &["trace", "p.nc", "--machine", MACHINE],
        &["trace", "p.nc", "--machine", MACHINE, "--format", "json"],
        &["canon", "p.ngc"],
    ];
    for command in commands {
        let shown = trunnion_in(folder.path(), command);
        let written = trunnion_in(folder.path(), &[command, &["-o", "out"]].concat());
        assert_eq!(status(&written), status(&shown), "{}", text(&written.stderr));
        assert!(written.stdout.is_empty() && !shown.stdout.is_empty(), "{command:?}");
        assert_eq!(content(&folder.path().join("out")), text(&shown.stdout), "{command:?}");
    }
    // a run that does not end leaves the old file
    write(&folder, "p.ngc", "o1 while [1]\no1 endwhile\nM2\n");
    let before = content(&folder.path().join("out"));
    let output = trunnion_in(folder.path(), &["canon", "p.ngc", "-o", "out"]);
    assert_eq!(status(&output), 2, "{}", text(&output.stderr));
    assert_eq!(content(&folder.path().join("out")), before);
}

/// The program goes into the file of `-o`, a document or a diff to standard output, and never both to one place.
#[test]
fn standard_output_holds_one_thing() {
    let folder = folder();
    let program = write(&folder, "p.nc", FLIP);
    let out = folder.path().join("out.nc");
    let on = ["--machine", MACHINE, "--dialect", "fanuc-30i"];
    let run = |command: &[&str]| trunnion(&[&[command[0], str(&program)], &command[1..], &on].concat());
    let convert = ["convert", "--to", "sinumerik-840d", "--format", "json"];
    let output = run(&[&convert[..], &["-o", str(&out)]].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(document["program"], content(&out));
    assert!(content(&out).contains("TRAORI"), "{}", content(&out));
    let output = run(&["fix", "--format", "json", "-o", str(&out)]);
    serde_json::from_slice::<serde_json::Value>(&output.stdout).expect("JSON");
    assert!(content(&out).starts_with("(trunnion: tool 1"), "{}", content(&out));
    for (command, what) in [
        (&[&convert[..], &["-o", "-"]].concat()[..], "the JSON document"),
        (&[&convert[..3], &["--certificate", "-"]].concat(), "the program"),
        (&["fix", "--format", "json", "-o", "-"], "the JSON document"),
        (&["fix", "--diff", "-o", "-"], "the diff"),
        (&["fix", "--certificate", "-"], "the diff"),
        (&["edit", "--mirror", "X", "--diff", "-o", "-"], "the diff"),
        (&["check", "--write-baseline", "-"], "the result"),
    ] {
        let output = run(command);
        let said = text(&output.stderr);
        assert_eq!(
            (status(&output), text(&output.stdout).as_str()),
            (2, ""),
            "{command:?}: {said}"
        );
        assert!(said.contains(&format!("also where {what} goes")), "{command:?}: {said}");
    }
    let output = run(&["fmt", "-", "--write"]);
    assert_eq!(status(&output), 2);
    assert!(
        text(&output.stderr).contains("standard input cannot be replaced"),
        "{}",
        text(&output.stderr)
    );
    assert_eq!(content(&program), FLIP);
}

#[test]
fn devices_and_fifos_are_not_replaced_and_not_waited_for() {
    let folder = folder();
    let program = write(&folder, "p.nc", FLIP);
    let output = trunnion(&[
        "plot",
        str(&program),
        "--machine",
        MACHINE,
        "--kind",
        "joints",
        "-o",
        "/dev/null",
    ]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    assert!(fs::metadata("/dev/null").is_ok_and(|metadata| metadata.file_type().is_char_device()));
    let pipe = folder.path().join("pipe.nc");
    fifo(&pipe);
    for command in ["check", "fmt", "stats", "parse", "trace"] {
        let output = trunnion(&[command, str(&pipe), "--machine", MACHINE]);
        assert_eq!(status(&output), 2, "{command}");
        assert!(
            text(&output.stderr).contains("is a FIFO"),
            "{command}: {}",
            text(&output.stderr)
        );
    }
}

#[test]
fn fmt_keeps_links_and_refuses_what_it_cannot_keep() {
    let folder = folder();
    let program = write(&folder, "p.nc", LOOSE);
    let link = folder.path().join("link.nc");
    symlink("p.nc", &link).expect("a link");
    assert_eq!(status(&trunnion(&["fmt", str(&link)])), 0);
    assert!(fs::symlink_metadata(&link).is_ok_and(|metadata| metadata.is_symlink()));
    assert_ne!(content(&program), LOOSE);
    let twice = write(&folder, "q.nc", LOOSE);
    fs::hard_link(&twice, folder.path().join("r.nc")).expect("a link");
    let output = trunnion(&["fmt", str(&twice)]);
    assert_eq!(status(&output), 2);
    assert!(text(&output.stderr).contains("hard links"), "{}", text(&output.stderr));
    assert_eq!(content(&twice), LOOSE);
    let locked = write(&folder, "s.nc", LOOSE);
    let mut mode = fs::metadata(&locked).expect("there").permissions();
    mode.set_readonly(true);
    fs::set_permissions(&locked, mode).expect("a mode");
    let output = trunnion(&["fmt", str(&locked)]);
    assert_eq!(status(&output), 2);
    assert!(text(&output.stderr).contains("read-only"), "{}", text(&output.stderr));
    assert_eq!(content(&locked), LOOSE);
}

#[test]
fn a_comment_opens_only_machines_beside_the_program_or_in_machine_path() {
    let folder = folder();
    let machine =
        text(&fs::read(concat!(env!("CARGO_MANIFEST_DIR"), "/samples/machines/mill-3axis.toml")).unwrap_or_default());
    let machine = if machine.is_empty() { some_machine() } else { machine };
    fs::create_dir_all(folder.path().join("programs")).expect("a folder");
    fs::create_dir_all(folder.path().join("machines/new")).expect("a folder");
    write(&folder, "machines/new/ours.toml", &machine);
    write(&folder, "programs/beside.toml", &machine);
    write(&folder, "secret.txt", "password = 1\n");
    write(&folder, "secret.toml", "password = 1\n");
    symlink(
        folder.path().join("secret.toml"),
        folder.path().join("programs/link.toml"),
    )
    .expect("a link");
    let check = |name: &str| {
        let program = write(
            &folder,
            "programs/p.nc",
            &format!("(trunnion: machine {name})\nG21 G90\nG0 X1\nM30\n"),
        );
        trunnion(&["check", str(&program), "--dialect", "fanuc-30i"])
    };
    for name in [
        "/etc/passwd",
        "/etc/shadow",
        "../secret.txt",
        "../secret.toml",
        "link.toml",
        "new/ours.toml",
    ] {
        let output = check(name);
        assert_eq!(status(&output), 2, "{name}");
        let said = text(&output.stderr);
        assert!(
            said.contains("was not opened") || said.contains("unknown machine"),
            "{name}: {said}"
        );
        assert!(!said.contains("root:") && !said.contains("password"), "{name}: {said}");
    }
    assert_ne!(status(&check("beside.toml")), 2);
    write(&folder, "trunnion.toml", "machine_path = [\"machines\"]\n");
    assert_ne!(status(&check("new/ours.toml")), 2);
    assert_eq!(status(&check("../secret.toml")), 2);
}

fn some_machine() -> String {
    let list = fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/samples/machines")).expect("samples");
    let mut files: Vec<_> = list
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|e| e == "toml"))
        .collect();
    files.sort();
    content(&files[0])
}

#[test]
fn settings_are_those_of_the_folder_in_which_the_program_is() {
    let folder = folder();
    fs::create_dir_all(folder.path().join("a/b")).expect("folders");
    write(&folder, "a/trunnion.toml", "dialect = \"haas-ngc\"\n");
    write(&folder, "a/b/trunnion.toml", "dialect = \"linuxcnc\"\n");
    write(&folder, "a/p.nc", "G0 X1\nM30\n");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args(["check", "-v", "../p.nc"])
        .current_dir(folder.path().join("a/b"))
        .output()
        .expect("runs");
    assert!(
        text(&output.stderr).contains("dialect haas-ngc"),
        "{}",
        text(&output.stderr)
    );
}
