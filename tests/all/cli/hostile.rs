//! Deliberately bad input: every command ends with its exit status and a message, whatever it reads.

use super::tools::{status, str, text};
use std::{
    fs,
    path::Path,
    process::{Command, Output, Stdio},
};
use tempfile::TempDir;

/// Brackets inside brackets, and letters of one line.
const MANY: usize = 100_000;

/// Runs in `folder` without settings from above it.
fn run(folder: &TempDir, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args(arguments)
        .current_dir(folder.path())
        .stdin(Stdio::null())
        .output()
        .expect("runs")
}

/// Name, bytes, and what `check` says of it (empty: nothing is asked).
#[expect(clippy::too_many_lines, reason = "it is one list")]
fn inputs() -> Vec<(&'static str, Vec<u8>, &'static str)> {
    let deep = format!("{}1{}", "[".repeat(MANY), "]".repeat(MANY));
    let words = "X1 Y2 ".repeat(MANY);
    vec![
        (
            "deep.ngc",
            format!("g21 g90\ng0 x{deep}\nm2\n").into(),
            "at most 253 bytes long",
        ),
        (
            "deep.nc",
            format!("O1\nG21 G90\n#1={deep}\nG0 X#1\nM30\n").into(),
            "nested deeper than 5 levels",
        ),
        (
            "hash.nc",
            format!("O1\nG21 G90\n#1={}1\nM30\n", "#".repeat(MANY)).into(),
            "",
        ),
        (
            "deep.mpf",
            format!("G90 G71\nR1={}\nM30\n", deep.replace('[', "(").replace(']', ")")).into(),
            "",
        ),
        ("deep.apt", format!("PARTNO\nGOTO/{deep}\nFINI\n").into(), ""),
        (
            "wide.ngc",
            format!("g21 g90\ng0 {words}\nm2\n").into(),
            "at most 253 bytes long",
        ),
        (
            "wide.nc",
            format!("O1\nG21 G90\n{words}\nM30\n").into(),
            "repeats a word",
        ),
        (
            "digits.nc",
            format!("O1\nG21 G90\nG0 X{}\nM30\n", "1".repeat(MANY)).into(),
            "is not a number",
        ),
        (
            "comment.nc",
            format!("O1\nG21 G90\n({}\nM30\n", "(".repeat(MANY)).into(),
            "",
        ),
        (
            "self.ngc",
            "o100 sub\no100 call\no100 endsub\no100 call\nm2\n".into(),
            "Too many subroutine levels",
        ),
        (
            "self.nc",
            "O1\nM98 P1\nM30\n".into(),
            "calls are nested deeper than 10 levels",
        ),
        ("macro.nc", "O1\nG65 P1 A#1\nM30\n".into(), "are nested deeper than"),
        (
            "while.ngc",
            "g21 g90 f100\no1 while [1]\ng1 x1\ng1 x2\no1 endwhile\nm2\n".into(),
            "did not end within",
        ),
        (
            "repeat.ngc",
            "g21\no1 repeat [1000000000]\no1 endrepeat\nm2\n".into(),
            "did not end within",
        ),
        (
            "while.nc",
            "O1\nG21 G90 G94 F100.\nWHILE[1EQ1]DO1\nG1X1.\nEND1\nM30\n".into(),
            "this never ends",
        ),
        (
            "count.nc",
            "O1\nG21\nWHILE[1EQ1]DO1\n#1=#1+1\nEND1\nM30\n".into(),
            "did not end within",
        ),
        (
            "goto.nc",
            "O1\nG21 G90 G94 F100.\nN10 G1 X1.\n#1=#1+1\nGOTO10\nM30\n".into(),
            "did not end within",
        ),
        (
            "times.nc",
            "O1\nM98 P2 L99999999\nM30\nO2\nM98 P3 L99999999\nM99\nO3\nM99\n".into(),
            "",
        ),
        ("nul.ngc", b"g21 g90\n\0g0 x1\0\n\0\0\0\nm2\n".to_vec(), ""),
        ("nul.nc", b"G21 G90\n\0G0 X1.\0\n\0\0\0\nM30\n".to_vec(), ""),
        (
            "latin.nc",
            b"G21 G90\n(Gr\xf6\xdfe)\nG0 X1. \xe4\nM30\n".to_vec(),
            "does not belong to any word",
        ),
        (
            "latin.ngc",
            b"g21 g90\n(Gr\xf6\xdfe)\ng0 x1 \xe4\nm2\n".to_vec(),
            "does not belong to any word",
        ),
        ("return.nc", b"G21 G90\rG0 X1.\rM30\r".to_vec(), ""),
        ("return.ngc", b"g21 g90\rg0 x1\rm2\r".to_vec(), ""),
        ("lines.ngc", vec![b'\n'; 10 * MANY], ""),
        (
            "random.nc",
            (0..MANY as u32)
                .map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8)
                .collect(),
            "",
        ),
    ]
}

#[test]
fn every_command_ends_with_a_word_of_its_own() {
    let folder = TempDir::new().expect("works");
    fs::write(folder.path().join("trunnion.toml"), "[limits]\nblocks = 20000\n").expect("writable");
    for (name, bytes, said) in inputs() {
        fs::write(folder.path().join(name), bytes).expect("writable");
        let mut commands = vec![
            vec!["check", "--format", "short", name],
            vec!["check", "--format", "pretty", name],
            vec!["fmt", "--check", name],
            vec!["parse", name],
            vec!["stats", name],
            vec!["diff", name, name],
        ];
        // canon has no bound below ten million blocks: it lists what it runs, and is asked for what is short
        if Path::new(name).extension().is_some_and(|end| end == "ngc") && !said.contains("did not end within") {
            commands.push(vec!["canon", name]);
        }
        for command in commands {
            let output = run(&folder, &command);
            let errors = text(&output.stderr);
            assert!(matches!(status(&output), 0..=2), "{command:?}: {errors}");
            assert!(!errors.contains("panicked"), "{command:?}: {errors}");
            if command[0] == "check" && command[2] == "short" {
                let found = text(&output.stdout);
                assert!(found.contains(said), "{name}: `{said}` is not in {found}");
                let longest = found.lines().map(str::len).max().unwrap_or(0);
                assert!(longest < 1000, "{name}: a message of {longest} bytes");
            }
        }
    }
}

#[test]
fn a_comparison_that_was_not_followed_to_the_end_is_not_the_same() {
    let folder = TempDir::new().expect("works");
    fs::write(folder.path().join("trunnion.toml"), "[limits]\nblocks = 20000\n").expect("writable");
    let probe = "O1\nG21 G90 G94 F100.\nG0X0.Y0.Z0.\nIF[#5061GT0]GOTO10\nG1 X1.\nN10 M30\n";
    let count = "O1\nG21 G90 G94 F100.\nG0X0.\nWHILE[1EQ1]DO1\n#1=#1+1\nEND1\nG1 X1.\nM30\n";
    for (program, line, why) in [(probe, 4, "#5061"), (count, 4, "end within")] {
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("writable");
        write("a.nc", program);
        write("b.nc", &program.replace("G1 X1.", "G1 X9."));
        let output = run(&folder, &["diff", "a.nc", "b.nc"]);
        let shown = text(&output.stdout);
        assert_eq!(status(&output), 1, "{shown}");
        let places = ["a", "b"].map(|name| format!("{name}.nc:{line}: not followed from here: "));
        assert!(
            shown.starts_with("UNKNOWN ") && places.iter().all(|place| shown.contains(place)),
            "{shown}"
        );
        assert!(shown.contains(why) && !shown.contains("SAME"), "{shown}");
        let output = run(&folder, &["stats", "a.nc"]);
        let shown = text(&output.stdout);
        assert!(
            shown.contains(&format!("from line {line}: ")) && shown.contains(why),
            "{shown}"
        );
        // a program is the same as itself, wherever it goes
        assert_eq!(status(&run(&folder, &["diff", "a.nc", "a.nc"])), 0);
    }
}

#[test]
fn a_file_over_the_bound_is_refused_and_the_flag_named() {
    let folder = TempDir::new().expect("works");
    let file = folder.path().join("big.ngc");
    fs::write(&file, vec![b'\n'; 1_000_001]).expect("writable");
    let name = str(&file);
    for command in [
        &["check", name][..],
        &["fmt", "--check", name],
        &["parse", name],
        &["stats", name],
        &["diff", name, name],
        &["trace", name],
        &["fix", name],
    ] {
        let output = run(&folder, &[command, &["--max-file-mb", "1"]].concat());
        let errors = text(&output.stderr);
        assert_eq!(status(&output), 2, "{command:?}: {errors}");
        assert!(
            errors.contains("larger than 1 MB") && errors.contains("--max-file-mb"),
            "{errors}"
        );
    }
    // one byte less is read
    fs::write(&file, vec![b'\n'; 1_000_000]).expect("writable");
    let tokens = ["parse", "--tokens", name, "--max-file-mb", "1"];
    assert_eq!(status(&run(&folder, &tokens)), 0);
    // a sparse file of a terabyte costs nothing
    let sparse = fs::File::create(folder.path().join("huge.nc")).expect("created");
    if sparse.set_len(1 << 40).is_ok() {
        for command in ["check", "canon"] {
            let output = run(&folder, &[command, "huge.nc"]);
            assert_eq!(status(&output), 2, "{command}");
            assert!(
                text(&output.stderr).contains("is larger than"),
                "{}",
                text(&output.stderr)
            );
        }
    }
}

#[test]
fn lines_over_the_bound_are_refused_whatever_ends_them() {
    let folder = TempDir::new().expect("works");
    for (name, end) in [("lf.nc", "\n"), ("crlf.nc", "\r\n"), ("cr.nc", "\r")] {
        fs::write(folder.path().join(name), format!("G1 X1.{end}").repeat(1000)).expect("writable");
        for command in ["check", "parse", "canon"] {
            let limited = |most: &str| run(&folder, &[command, name, "--max-lines", most]);
            let refused = limited("999");
            let errors = text(&refused.stderr);
            assert_eq!(status(&refused), 2, "{command} {name}: {errors}");
            assert!(
                errors.contains("1000 lines") && errors.contains("--max-lines"),
                "{errors}"
            );
            assert!(
                !text(&limited("1000").stderr).contains("--max-lines"),
                "{command} {name}"
            );
        }
    }
}

#[test]
fn what_compares_or_changes_programs_reads_smaller_ones_and_says_how_to_read_larger_ones() {
    let folder = TempDir::new().expect("works");
    fs::write(folder.path().join("many.nc"), "G1X1.\n".repeat(400_001)).expect("writable");
    fs::write(folder.path().join("more.nc"), "G1\n".repeat(600_001)).expect("writable");
    for (name, lines) in [("large.nc", 160_001), ("larger.nc", 320_001)] {
        let text = format!("(a)G1X1.{}\n", " ".repeat(92)).repeat(lines);
        fs::write(folder.path().join(name), text).expect("writable");
    }
    let lays_out: &[&[&str]] = &[&["fmt", "--check"]];
    let changes = [&["fix"][..], &["edit", "--unit", "inch"]];
    let reports = [&["report", "-o", "-"][..]];
    let machines = ["machine", "compare", "mikron-ucp710", "mikron-ucp710"];
    let compares = [&["diff", "many.nc"][..], &["certify", "many.nc"], &machines];
    let lists = [&["trace"][..], &["parse"], &["parse", "--tree"]];
    let (lines, megabytes) = ("--max-lines", "--max-file-mb");
    for (name, said, option, most, commands) in [
        ("many.nc", "400001 lines, more than 300000", lines, "400001", lays_out),
        ("many.nc", "400001 lines, more than 200000", lines, "400001", &changes),
        ("many.nc", "400001 lines, more than 100000", lines, "400001", &reports),
        ("many.nc", "400001 lines, more than 250000", lines, "400001", &compares),
        ("more.nc", "600001 lines, more than 600000", lines, "600001", &lists),
        ("large.nc", "larger than 16 MB", megabytes, "17", lays_out),
        ("large.nc", "larger than 16 MB", megabytes, "17", &changes),
        ("large.nc", "larger than 16 MB", megabytes, "17", &reports),
        ("larger.nc", "larger than 32 MB", megabytes, "33", &compares[2..]),
    ] {
        for command in commands {
            let refused = run(&folder, &[*command, &[name]].concat());
            let errors = text(&refused.stderr);
            assert_eq!(status(&refused), 2, "{errors}");
            assert!(
                errors.contains(said) && errors.contains(option),
                "{command:?}: {errors}"
            );
        }
        let read = run(&folder, &["fmt", "--check", name, option, most, "--dialect", "apt"]);
        assert!(!text(&read.stderr).contains(option), "{}", text(&read.stderr));
        let parsed = run(&folder, &["parse", "--tokens", name]);
        assert_eq!(status(&parsed), 0, "{}", text(&parsed.stderr));
    }
}

#[test]
fn settings_and_surfaces_have_a_size() {
    let folder = TempDir::new().expect("works");
    fs::write(folder.path().join("a.nc"), "G0 X1.\nM30\n").expect("writable");
    fs::write(folder.path().join("s.toml"), "#".repeat((2 << 20) + 1)).expect("writable");
    fs::write(folder.path().join("grids.toml"), "#".repeat((16 << 20) + 1)).expect("writable");
    for (command, said) in [
        (
            &["check", "a.nc", "--config", "s.toml"][..],
            "s.toml: is larger than 2 MiB",
        ),
        (
            &["check", "a.nc", "--machine", "s.toml"],
            "s.toml: is larger than 2 MiB",
        ),
        (&["machine", "show", "s.toml"], "s.toml: is larger than 2 MiB"),
        (
            &[
                "surface",
                "a.nc",
                "--machine",
                "mikron-ucp710",
                "--required",
                "grids.toml",
            ],
            "grids.toml: is larger than 16 MiB, the most for grids and patches; give the surface as an STL",
        ),
    ] {
        let output = run(&folder, command);
        assert_eq!(status(&output), 2, "{command:?}");
        assert!(
            text(&output.stderr).contains(said),
            "{command:?}: {}",
            text(&output.stderr)
        );
    }
}

#[cfg(unix)]
#[test]
fn input_without_an_end_is_refused() {
    let folder = TempDir::new().expect("works");
    for arguments in [["check", "/dev/zero"], ["check", "-"]] {
        let zero = fs::File::open("/dev/zero").expect("there");
        let output = Command::new(env!("CARGO_BIN_EXE_trunnion"))
            .args(arguments)
            .args(["--max-file-mb", "2"])
            .current_dir(folder.path())
            .stdin(zero)
            .output()
            .expect("runs");
        assert_eq!(status(&output), 2);
        let wanted = if arguments[1] == "-" {
            "larger than 2 MB"
        } else {
            "is a device"
        };
        assert!(text(&output.stderr).contains(wanted), "{}", text(&output.stderr));
    }
}

#[test]
fn a_called_program_that_is_too_large_is_not_said_to_be_missing() {
    let folder = TempDir::new().expect("works");
    let subs = folder.path().join("subs");
    fs::create_dir(&subs).expect("made");
    fs::write(folder.path().join("trunnion.toml"), "subprogram_path = [\"subs\"]\n").expect("writable");
    for (dialect, main, called) in [
        ("fanuc-30i", "G21 G90\nM98 P50\nM30\n", "O0050.nc"),
        ("sinumerik-840d", "G71 G90\nPOCKET\nM30\n", "POCKET.SPF"),
        ("linuxcnc", "o<pocket> call\nM2\n", "pocket.ngc"),
    ] {
        fs::write(folder.path().join("main.nc"), main).expect("writable");
        let large = fs::File::create(folder.path().join(called)).expect("created");
        large.set_len((64 << 20) + 1).expect("sparse");
        // another folder has a small one, which the control would not take
        fs::write(subs.join(called), "M17\n").expect("writable");
        let output = run(&folder, &["check", "--dialect", dialect, "main.nc"]);
        let said = text(&output.stdout);
        assert_eq!(status(&output), 1, "{dialect}: {said}");
        let lines: Vec<&str> = said
            .lines()
            .filter(|line| line.contains("missing-subprogram"))
            .collect();
        assert_eq!(lines.len(), 1, "{dialect}: {said}");
        assert!(
            lines[0].contains(called) && lines[0].contains("is larger than 64 MB"),
            "{dialect}: {said}"
        );
        assert!(!said.contains("not found"), "{dialect}: {said}");
        fs::remove_file(folder.path().join(called)).expect("removed");
    }
}
